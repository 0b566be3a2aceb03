"""An editor for tests: a client of the language server that applies edits as an editor does."""

import asyncio
import random
import sys
from collections.abc import Awaitable, Callable, Coroutine
from typing import Any

from fuzzing import ODD
from lsprotocol import types
from pygls.lsp.client import LanguageClient

from contoursolve.gcode import split_lines

PATIENCE = 60
"""Seconds until an answer has to be there."""

CAPABILITIES = types.ClientCapabilities(
    workspace=types.WorkspaceClientCapabilities(
        workspace_edit=types.WorkspaceEditClientCapabilities(document_changes=True), configuration=True
    ),
    text_document=types.TextDocumentClientCapabilities(
        publish_diagnostics=types.PublishDiagnosticsClientCapabilities(related_information=True, version_support=True),
        completion=types.CompletionClientCapabilities(
            completion_item=types.ClientCompletionItemOptions(snippet_support=True)
        ),
    ),
    window=types.WindowClientCapabilities(show_document=types.ShowDocumentClientCapabilities(True)),
)


class Editor:
    """One server, and the programs that are open in it. Texts are held in units of UTF-16, as the protocol counts."""

    def __init__(self, section: dict[str, Any] | None = None) -> None:
        self.client = LanguageClient("editor of a test", "1")
        self.section = section or {}
        self.texts: dict[str, str] = {}
        self.versions: dict[str, int] = {}
        self.found: dict[str, types.PublishDiagnosticsParams] = {}
        self.statuses: dict[str, Any] = {}
        self.shown: list[str] = []
        self.messages: list[str] = []
        self._told = asyncio.Condition()

    async def start(self, **options: Any) -> types.InitializeResult:
        client = self.client

        @client.feature(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        async def _(params: types.PublishDiagnosticsParams) -> None:
            self.found[params.uri] = params
            async with self._told:
                self._told.notify_all()

        @client.feature(types.WORKSPACE_CONFIGURATION)
        def _(params: types.ConfigurationParams) -> list[Any]:
            return [self.section for _ in params.items]

        @client.feature(types.WINDOW_SHOW_DOCUMENT)
        def _(params: types.ShowDocumentParams) -> types.ShowDocumentResult:
            self.shown.append(params.uri)
            return types.ShowDocumentResult(True)

        @client.feature(types.WINDOW_SHOW_MESSAGE)
        def _(params: types.ShowMessageParams) -> None:
            self.messages.append(params.message)

        @client.feature("contoursolve/status")
        async def _(params: Any) -> None:
            self.statuses[params.uri] = params
            async with self._told:
                self._told.notify_all()

        await client.start_io(sys.executable, "-W", "error", "-m", "contoursolve", "lsp")
        told = types.InitializeParams(capabilities=options.pop("capabilities", CAPABILITIES), root_uri=None)
        told.initialization_options = options or None
        answer = await self.ask(client.initialize_async(told))
        client.initialized(types.InitializedParams())
        return answer

    async def stop(self) -> None:
        await self.ask(self.client.shutdown_async(None))
        self.client.exit(None)
        await self.client.stop()

    def close(self) -> None:
        """Close all programs, and forget what was told."""
        for uri in self.texts:
            document = types.TextDocumentIdentifier(uri)
            self.client.text_document_did_close(types.DidCloseTextDocumentParams(document))
        for told in (self.texts, self.versions, self.found, self.statuses, self.shown, self.messages):
            told.clear()

    async def ask(self, answer: Awaitable[Any]) -> Any:
        return await asyncio.wait_for(answer, PATIENCE)

    def open(self, uri: str, text: str) -> None:
        self.texts[uri], self.versions[uri] = text, 1
        self.client.text_document_did_open(
            types.DidOpenTextDocumentParams(types.TextDocumentItem(uri, "gcode", 1, text))
        )

    def edit(self, uri: str, *edits: types.TextEdit) -> None:
        """Apply edits from the last to the first, and tell the server of them."""
        self.versions[uri] += 1
        changes = []
        for each in sorted(edits, key=lambda each: (each.range.start.line, each.range.start.character), reverse=True):
            changes.append(types.TextDocumentContentChangePartial(range=each.range, text=each.new_text))
            self.texts[uri] = applied(self.texts[uri], each)
        document = types.VersionedTextDocumentIdentifier(self.versions[uri], uri)
        self.client.text_document_did_change(types.DidChangeTextDocumentParams(document, changes))

    async def findings(self, uri: str) -> list[types.Diagnostic]:
        """What the server finds in the text as it is now."""
        wanted = self.versions[uri]
        await self.until(lambda: uri in self.found and self.found[uri].version == wanted)
        return [*self.found[uri].diagnostics]

    async def until(self, holds: Callable[[], bool]) -> None:
        """Wait until the server has told something."""

        def tried() -> bool:
            try:
                return holds()
            except KeyError:
                return False

        async with self._told:
            await asyncio.wait_for(self._told.wait_for(tried), PATIENCE)


def offset(text: str, position: types.Position) -> int:
    """The index of a place in a text."""
    lines = split_lines(text)
    if not lines or lines[-1].endswith(("\r", "\n")):
        lines.append("")
    before = sum(map(len, lines[: position.line]))
    units = 0
    line = lines[position.line].rstrip("\r\n") if position.line < len(lines) else ""
    for index, character in enumerate(line):
        if units >= position.character:
            return before + index
        units += 1 + (ord(character) > 0xFFFF)
    return before + len(line)


def applied(text: str, edit: types.TextEdit) -> str:
    """A text with one edit."""
    return text[: offset(text, edit.range.start)] + edit.new_text + text[offset(text, edit.range.end) :]


def edits_of(action: types.CodeAction) -> list[types.TextEdit]:
    """The edits of an action that concerns one program."""
    (change,) = action.edit.document_changes
    return change.edits


class Served:
    """A server that is kept for several uses. Programs that were opened in one of them are closed behind it."""

    def __init__(self, section: dict[str, Any] | None = None, **options: Any) -> None:
        self._runner = asyncio.Runner()
        self.editor = self._runner.run(self._start(section, options))

    async def _start(self, section: dict[str, Any] | None, options: dict[str, Any]) -> Editor:
        editor = Editor(section)
        self.answer = await editor.start(**options)
        return editor

    def __call__(self, use: Callable[[Editor], Coroutine[Any, Any, None]]) -> None:
        """Use it."""

        async def used() -> None:
            try:
                await use(self.editor)
            finally:
                self.editor.close()

        self._runner.run(used())

    def stop(self) -> None:
        self._runner.run(self.editor.stop())
        self._runner.close()


def in_editor(
    use: Callable[[Editor], Coroutine[Any, Any, None]], section: dict[str, Any] | None = None, **options: Any
) -> None:
    """Start a server, use it, and stop it."""
    served = Served(section, **options)
    try:
        served(use)
    finally:
        served.stop()


def random_edit(lines: list[str], draw: random.Random) -> tuple[tuple[int, int], tuple[int, int], str]:
    """Two places and what is put between them: mostly a word or a few characters, sometimes lines."""
    line = draw.randrange(len(lines)) + 1
    column = draw.randrange(len(lines[line - 1]) + 1) + 1
    match draw.randrange(8):
        case 0:
            return (line, column), (line, column), draw.choice(ODD)
        case 1:
            return (line, column), (line, column + draw.randrange(1, 6)), ""
        case 2:
            return (line, column), (line, column), draw.choice("0123456789.-XZAKPQRI \n")
        case 3:
            return (line, 1), (line, 1), draw.choice(lines) + draw.choice(("\n", "\r\n", "\r"))
        case 4:
            return (line, 1), (line + draw.randrange(1, 4), 1), ""
        case 5:
            return (line, column), (line, column), "\n"
        case 6:
            return (
                (line, len(lines[line - 1]) + 1),
                (line, 99_999),
                " " + draw.choice(draw.choice(lines).split() or [""]),
            )
        case _:
            return (line, column), (line, column + 1), draw.choice("0123456789.")
