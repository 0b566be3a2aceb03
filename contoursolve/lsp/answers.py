"""The answers to requests about a program, all of which is examined."""

from collections.abc import Callable, Mapping
from typing import Any

from lsprotocol import types

from contoursolve.lsp import commands
from contoursolve.lsp.findings import actions_of, fix_all, with_edit
from contoursolve.lsp.language_features import Completer, folds_of, hints_of, hover_of, signatures_of, symbols_of
from contoursolve.lsp.opened import FIX_ALL, Opened


def _actions(opened: Opened, params: types.CodeActionParams) -> list[types.CodeAction]:
    only = params.context.only

    def is_wanted(kind: str) -> bool:
        return only is None or any(kind == each or kind.startswith(f"{each}.") for each in only)

    found = [*actions_of(opened, params.range)] if is_wanted(types.CodeActionKind.QuickFix.value) else []
    found += fix_all(opened) if is_wanted(FIX_ALL) else []
    text = opened.client.text_document
    resolving = text.code_action.resolve_support if text and text.code_action else None
    is_later = resolving is not None and "edit" in resolving.properties
    return found if is_later else [with_edit(opened, each) for each in found]


def _completions(opened: Opened, params: types.CompletionParams) -> types.CompletionList:
    text = opened.client.text_document
    item = text.completion.completion_item if text and text.completion else None
    found = Completer(opened, params.position, has_snippets=bool(item and item.snippet_support)).items()
    return types.CompletionList(is_incomplete=True, items=[*found])


def _lenses(opened: Opened, _: types.CodeLensParams) -> list[types.CodeLens]:
    return [*commands.lenses_of(opened, of_client=opened.options.has_commands)] if opened.options.has_lenses else []


ANSWERS: Mapping[str, Callable[[Opened, Any], Any]] = {
    types.TEXT_DOCUMENT_CODE_ACTION: _actions,
    types.TEXT_DOCUMENT_HOVER: lambda opened, params: hover_of(opened, params.position),
    types.TEXT_DOCUMENT_INLAY_HINT: lambda opened, params: (
        [*hints_of(opened, params.range)] if opened.options.is_hinting else []
    ),
    types.TEXT_DOCUMENT_COMPLETION: _completions,
    types.TEXT_DOCUMENT_SIGNATURE_HELP: lambda opened, params: signatures_of(opened, params.position),
    types.TEXT_DOCUMENT_DOCUMENT_SYMBOL: lambda opened, _: [*symbols_of(opened)],
    types.TEXT_DOCUMENT_FOLDING_RANGE: lambda opened, _: [*folds_of(opened)],
    types.TEXT_DOCUMENT_CODE_LENS: _lenses,
}
"""Functions that answer, by what is asked."""
