"""Findings about a program as a whole: that it has no contour, that nothing shows its control, and from what its
control is concluded."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Any, cast

from msgspec.structs import replace

from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import Context, Depth, either, join, report
from contoursolve.diagnostics import Basis, Diagnostic, Severity, Span
from contoursolve.gcode import (
    Block,
    FaultKind,
    Passage,
    find_lookalikes,
    has_lookalike_code,
    in_passages,
    motion_of,
    parse_block,
    telling,
    words_of,
)
from contoursolve.geometry import Length
from contoursolve.program.outside_contours import NEAR, findings_of_block, with_letters
from contoursolve.program.recognise import first_signs, what_shows
from contoursolve.program.request import Request
from contoursolve.program.solve_queue import Step
from contoursolve.program.tape_markers import Marks
from contoursolve.reading import (
    Control,
    PlainLines,
    ReadIssue,
    State,
    advance,
    contours_of,
    unread_state,
)

_LOOKED_AT = 1_000
"""Lines of a program in which the words of a control are looked for."""

_TRIES = 32
"""Blocks among them that are tried with a comma."""

_MOVING = frozenset("XYZUVWABCR")
"""Addresses of axes, and of what a comma makes a part of a contour."""


def conclusions(asked: Request, blocks: Iterable[Block]) -> Iterator[Diagnostic]:
    """Findings about the conclusions on the control, at the first block that shows it."""
    own = cast("Control", asked.control)
    place = next((block.span for block in telling(blocks) if own.signs(block)), Span(1, 1, 2)) if own.taken else None
    for each in own.taken:
        context = Context(asked.rules, asked.unit, place=cast("Span", place))
        yield report(context, each.about, Basis.RULE, [], **cast("dict[str, Any]", each.fields))


# A program without contours --------------------------------------------------------------------------------------


def nothing_to_solve(asked: Request, blocks: Sequence[Block]) -> Diagnostic:
    """The finding that a program has no contour block: a warning where nothing in it looks like one."""
    own = asked.control
    if own is None and asked.depth is not Depth.VERDICT:
        found = _contour_with_comma(asked, blocks[:_LOOKED_AT])
        if found is not None:
            return found
    triggers = [f"of {each.name}: {each.contours}" for each in ((own,) if own else CONTROLS.values())]
    shown = what_shows(blocks, own) if own and _lacks_motion(own, blocks, asked.unit) else ""
    notes = [f"no G code of a motion is in force at {shown}: write G01"] if shown else []
    notes += _other_controls(own, blocks) if own and not shown else []
    context = Context(asked.rules, asked.unit)
    finding = report(context, context.row(ReadIssue.NO_CONTOUR), Basis.RULE, [], triggers="; ".join(triggers))
    slight = Severity.WARNING if asked.is_strict else Severity.INFO
    return replace(finding, notes=tuple(notes)) if notes else replace(finding, severity=slight)


def _other_controls(own: Control, blocks: Sequence[Block]) -> Iterator[str]:
    """Notes that other controls are to be tried, with the words that show them."""
    by_sign: dict[str, list[str]] = {}
    for name, sign in first_signs(blocks, own.name).items():
        by_sign.setdefault(sign, []).append(name)
    for sign, names in by_sign.items():
        yield f"{sign} is for {either(names)}: try --control {names[0] if len(names) == 1 else 'with one of them'}"


def _lacks_motion(control: Control, blocks: Sequence[Block], unit: Length) -> bool:
    """Whether no motion is in force in the first block with a word of the control's contours."""
    first = next((block for block in telling(blocks) if control.signs(block)), None)
    if first is None or any(each.address not in control.modes.lexicon.addresses for each in control.signs(first)):
        return False
    state = control.initial_state(unit)
    for block in PlainLines(control.modes).among(in_passages(blocks)):
        if isinstance(block, Passage):
            motion = motion_of(words_of(block.text, block.syntax))
            state = state if motion is None else replace(state, motion=motion)
        elif block.line <= first.line:
            state = advance(state, block, control.modes)
        if block.line >= first.line:
            break
    return state.motion is None


def _contour_with_comma(asked: Request, blocks: Sequence[Block]) -> Diagnostic | None:
    """The first word that makes a contour for some control, if it has a comma."""
    slips = ((name, slip) for name, control in CONTROLS.items() for slip in _slips_as(control, blocks, asked.unit))
    for name, slip in slips:
        context = Context(asked.rules, asked.unit, place=slip.span)
        readers = _readers_of(slip.span, blocks, asked.unit)
        word = blocks[slip.span.line - 1].text[slip.span.column - 1 : slip.span.end_column - 1]
        taken = f"with {join(readers)}, {word} is a word of a contour; " if readers else ""
        told = f"{taken}with --control {name}: {slip.message}"
        row = context.row(ReadIssue.CONTROL_UNKNOWN)
        return report(context, row, Basis.RULE, [], control="|".join([*readers, name]), readings=told)
    return None


def _readers_of(place: Span, blocks: Sequence[Block], unit: Length) -> list[str]:
    """The controls that have the axes of a program and for which the word at a place belongs to a contour."""
    axes = {word.address for block in blocks for word in block.words} & {*"XYZ"}
    return [
        name
        for name, each in CONTROLS.items()
        if axes <= each.modes.lexicon.addresses.keys()
        for claim, _ in contours_of(blocks, each.find, each.modes, each.initial_state(unit))
        if any(word.span == place for word in claim.words.values())
    ]


def _slips_as(control: Control, blocks: Sequence[Block], unit: Length) -> Iterator[Diagnostic]:
    """The words that make a contour for a control with their comma, in the first lines of a program."""
    from contoursolve.diagnosis import explain_commas  # noqa: PLC0415 - few programs need it

    state, tries = control.initial_state(unit), _TRIES
    lacking = {*control.modes.lexicon.after_comma}
    for index, block in enumerate(blocks):
        before, state = state, advance(state, block, control.modes)
        # What moves in rapid traverse, or alone, is an axis that turns.
        stated = {word.address for word in block.words if word.address in _MOVING}
        # Beside both ends of a line, an angle has nothing to say: it is an axis, too.
        is_axis = len(stated) == 1 or state.motion == 0 or (block.find("A") and stated >= {*state.plane.axes})
        lacking -= stated if is_axis else set()
        if not tries or not lacking:
            return
        if lacking & stated:
            tries -= 1
            context = Context(control.rules, unit, place=block.span)
            found = explain_commas(context, control, blocks[index : index + NEAR], (before, state))
            yield from (each for each in found if each.fixes)


# A program of which nothing shows the control --------------------------------------------------------------------


def look_without_control(asked: Request, blocks: Sequence[Block]) -> Step:
    """Blocks of a program without a control, examined: their characters, their facts, and signs of contours."""
    found, marks, is_shown = list[Diagnostic](), Marks(), False
    context = Context(asked.rules, asked.unit)
    first = blocks[0].line if blocks else 1
    for block in in_passages(blocks):
        if asked.is_strict:
            marks, told = marks.look((block,), context)
            found += told
        if isinstance(block, Passage):
            continue
        is_torn = not is_shown and has_lookalike_code(block)
        is_unread = any(fault.kind is FaultKind.BLOCK_TOO_LONG for fault in block.faults)
        if asked.is_strict or block.directives or is_torn or is_unread:
            found += findings_of_block(asked, block)
        # One line is enough: with that mended, the control is known.
        control = _control_of_digits(block) if is_torn else None
        if control is not None:
            index = block.line - first
            is_shown, near = True, blocks[index : index + NEAR]
            found = [*with_letters(asked, control, near, _state_before(asked, control, blocks, index), found)]
    found += marks.finish(context)
    return Step((), unread_state(asked.unit), findings=tuple(found))


def _control_of_digits(block: Block) -> Control | None:
    """The control that a block shows if its letters are the digits that they look like."""
    meant = parse_block(" ".join(each.new for each in find_lookalikes(block)), block.line)
    return next((each for each in CONTROLS.showing(meant.text) if each.signs(meant)), None)


def _state_before(asked: Request, control: Control, blocks: Sequence[Block], index: int) -> State:
    """The state of a control before a block."""
    state = control.initial_state(asked.unit)
    for block in (*(asked.start.blocks if asked.start else ()), *islice(blocks, index)):
        state = advance(state, block, control.modes)
    return state
