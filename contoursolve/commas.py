"""Finds corners and angles that lack their comma in blocks that are no contour without it."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from contoursolve.diagnosis import Edit, EditKind, apply_edits
from contoursolve.diagnostic import Applicability, Basis, Diagnostic, Fix
from contoursolve.dialects import Dialect
from contoursolve.examine import Depth, Policy, examine
from contoursolve.explain import Context, report
from contoursolve.reading import Claim, Effect, State, Trouble, codes_of
from contoursolve.spelling import respelled
from contoursolve.syntax import Block, Word, parse_block

_LINE = 1
_OF_A_LINE = (
    Effect.MOTION,
    Effect.PLANE,
    Effect.UNITS,
    Effect.COMPENSATION,
    Effect.ABSOLUTE,
    Effect.INCREMENTAL,
    Effect.NONE,
)


def explain_commas(
    context: Context, dialect: Dialect, blocks: Sequence[Block], states: tuple[State, State]
) -> Iterator[Diagnostic]:
    """Words of a line, the first of some blocks, whose address the control reads with a comma only: each with the
    comma as its fix, if that makes a contour that is solved. `states` are those before and after the block."""
    block, (before, after) = blocks[0], states
    addresses = dialect.modes.lexicon.addresses
    codes = codes_of(block, dialect.modes)
    is_line = after.motion == _LINE and not block.macro and any(map(block.find, after.plane.axes))
    if not is_line or any(isinstance(code, Word) or code.effect not in _OF_A_LINE for code in codes):
        return
    for word in block.words:
        text = "" if word.address.startswith(",") else respelled(word, addresses)
        if not text:
            continue
        finding = report(context, context.row(Trouble.COMMA_MISSING), Basis.RULE, [word], meant=text)
        edit = Edit(EditKind.CHANGE, word.address, word.span, word.text, text)
        (replacement,) = apply_edits([block], [edit])
        changed = [parse_block(replacement, block.line), *blocks[1:]]
        found = dialect.find(changed, 0, before, dialect.modes)
        if isinstance(found, Claim) and examine(found, dialect.rules, Policy.ENFORCE, depth=Depth.VERDICT).contour:
            finding = replace(finding, fixes=(Fix(str(edit), replacement, Applicability.CHANGES_CONTOUR),))
        yield finding
