"""Findings with what was meant where a slip keeps a block from being a contour."""

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from contoursolve.diagnosis.edits import Edit, EditKind, apply_edits, change, mend
from contoursolve.diagnosis.examine import Answer, Depth, Policy, examine
from contoursolve.diagnosis.explain import Context, report, spans_of
from contoursolve.diagnosis.slip_kinds import POINT_LOST, Speech, Typed, texts_of
from contoursolve.diagnosis.spelling import meant_in
from contoursolve.diagnosis.wording import join
from contoursolve.diagnostics import Applicability, Basis, Diagnostic, Fix
from contoursolve.gcode import Block, Word, lookalike_at, parse_block
from contoursolve.reading import Control, Effect, Modes, ParsedContour, ReadIssue, State, codes_of


def forgotten_codes(answer: Answer, modes: Modes) -> Iterator[tuple[Edit, ...]]:
    """The codes of contours that may have been forgotten, where words mean nothing without one."""
    words = (word for block in answer.claim.blocks for word in block.words if word.address == "G")
    lines = dict.fromkeys(word.span.line for word in answer.claim.unknown)
    codes = [f"G{number}" for number, code in modes.codes.items() if code.effect is Effect.CONTOUR]
    for line in sorted(lines.keys() - {word.span.line for word in words}):
        yield from ((Edit(EditKind.ADD, "G", text=code, line=line),) for code in codes)


def point_slips(answer: Answer) -> Iterator[tuple[Edit, ...]]:
    """Points in each of the words that are said to lack one."""
    lacking = spans_of(answer.diagnostics, ReadIssue.POINT_MISSING)
    claim, speech = answer.claim, Speech.of(answer.claim)
    words = [word for word in claim.words.values() if word.span in lacking]
    yield from ((change(word, text),) for word in words for text in texts_of(POINT_LOST, Typed.of(word, speech)))


# Blocks that are a contour but for a slip: a comma that is missing, a letter that looks like a digit -------------

_LINES = (0, 1)
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
    context: Context,
    control: Control,
    blocks: Sequence[Block],
    states: tuple[State, State],
    previous: tuple[Sequence[Block], State] | None = None,
) -> Iterator[Diagnostic]:
    """Words of a line, the first of some blocks, whose address the control reads with a comma only: each with the
    comma as its fix, if that makes a contour that is solved. `states` are those before and after the block; `previous`
    are the blocks before it, which may be part of the contour then, and the state before them."""
    block, (before, after) = blocks[0], states
    addresses = control.modes.lexicon.addresses
    codes = codes_of(block, control.modes)
    is_line = after.motion in _LINES and not block.macro
    if not is_line or any(isinstance(code, Word) or code.effect not in _OF_A_LINE for code in codes):
        return
    for word in block.words:
        text = f",{word.text.strip()}" if f",{word.address}" in addresses else ""
        if not text:
            continue
        finding = report(context, ReadIssue.COMMA_MISSING, Basis.RULE, [word], meant=text)
        edit = change(word, text)
        found, replacement = _read(control, blocks, [edit], before)
        fixes = tuple(_tried(control, blocks[0], found, [edit], replacement))
        if previous and not fixes:
            edited = parse_block(replacement, block.line, block.syntax)
            other = control.find([*previous[0], edited, *blocks[1:]], 0, previous[1], control.modes)
            other = other if other and edited in other.blocks else None
            fixes = tuple(_tried(control, block, other, [edit], replacement))
        if fixes or any(map(block.find, after.plane.axes)):
            yield replace(finding, fixes=fixes)


def explain_letters(
    context: Context, control: Control, blocks: Sequence[Block], before: State, findings: Sequence[Diagnostic]
) -> Iterator[Diagnostic]:
    """The findings about a block, the first of some, that is a contour if letters of its G code are the digits that
    they look like: with these digits as the fix, if it is solved then. `before` is the state before it."""
    meant = meant_in(blocks[0], [fault.span for fault in blocks[0].faults])
    edits = [mend(each) for each in meant]
    found, replacement = _read(control, blocks, edits, before)
    if found is None or not any(each.is_code for each in meant):
        yield from findings
        return
    fixes = tuple(_tried(control, blocks[0], found, edits, replacement))
    # A letter for a digit is no word.
    findings = [each for each in findings if each.about not in _OF_WORDS or not lookalike_at(meant, each.span)]
    blamed = [each for each in findings if lookalike_at(meant, each.span)]
    if not blamed:
        words = [Word(each.address, None, False, each.old, each.span) for each in meant]
        text = join([each.new for each in meant])
        yield replace(report(context, ReadIssue.LETTER_FOR_DIGIT, Basis.RULE, words, meant=text), fixes=fixes)
    for each in findings:
        yield replace(each, fixes=fixes) if blamed and each is blamed[0] else each


_OF_WORDS = (ReadIssue.WORD_UNKNOWN, ReadIssue.WORD_MISTYPED)


def _read(
    control: Control, blocks: Sequence[Block], edits: Sequence[Edit], before: State
) -> tuple[ParsedContour | None, str]:
    """The contour that begins with the first of some blocks when it is edited, if one does; and its text then."""
    (text,) = apply_edits(blocks[:1], edits)
    found = control.find([parse_block(text, blocks[0].line, blocks[0].syntax), *blocks[1:]], 0, before, control.modes)
    return (found if isinstance(found, ParsedContour) and found.form.is_contour else None), text


def _tried(
    control: Control, block: Block, found: ParsedContour | None, edits: Sequence[Edit], replacement: str
) -> Iterator[Fix]:
    """The edits of a block as a fix, if they make a contour that is solved."""
    if found is not None and examine(found, control, Policy.ENFORCE, depth=Depth.VERDICT).contour:
        told = "; ".join(map(str, edits))
        yield Fix(told, replacement, Applicability.CHANGES_CONTOUR, replaced=block.text)
