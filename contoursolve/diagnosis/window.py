"""The blocks around a contour, examined as a program is: as they are, and with edits that are tried."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from functools import cached_property
from itertools import accumulate
from math import atan2, degrees

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.edits import Edit, EditKind, apply_edits, read_edits
from contoursolve.diagnosis.examine import Answer, Depth, Policy, examine
from contoursolve.diagnosis.slip_kinds import plain_code
from contoursolve.diagnostics import Diagnostic, LineChange, Severity
from contoursolve.gcode import Block
from contoursolve.geometry import Start, Unit
from contoursolve.reading import Control, Effect, ParsedContour, ReadIssue, State, advance, arc_of, faults_of, leave
from contoursolve.solving import ArcSegment, Contour, LineSegment, Point, Segment, opposes
from contoursolve.tolerance import AGREEMENT

LINE, _FEEDS = 1, (1, 2, 3)
"""The motion along a line, and those that cut."""


class WindowPart(Struct, frozen=True):
    """Blocks of a program in a row, a contour or none, as they are examined: with the states before and behind them."""

    blocks: tuple[Block, ...]
    before: State
    after: State
    reach: int
    """The number of blocks from its first one on that it rests on, one more than there are where it rests on the
    end."""
    findings: tuple[Diagnostic, ...] = ()
    answer: Answer | None = None


class Stretch(Struct, frozen=True):
    """A stretch of the path in the plane, mm; `turned` is the axis that counts diameters, if one does, and its place is
    known. It begins and ends in a direction, and turns by `sweep` between them, degrees."""

    start: Point
    end: Point
    turned: int | None
    headings: tuple[float, float]
    sweep: float = 0.0
    is_cutting: bool = True


class Seen(Struct, frozen=True):
    """The result of examining a window: the errors and warnings, the contours, and the path as far as it is known."""

    parts: tuple[WindowPart, ...]
    problems: tuple[Diagnostic, ...]
    moves: tuple[Stretch, ...]
    changed: frozenset[int] = frozenset()
    """The lines that the edits change."""

    @property
    def answers(self) -> Iterator[Answer]:
        """Those to its contours."""
        return (part.answer for part in self.parts if part.answer is not None)

    @property
    def keys(self) -> frozenset[tuple[str, int]]:
        """The problems by their code and line."""
        return frozenset((each.code, each.span.line) for each in self.problems)

    @property
    def placeless(self) -> frozenset[int]:
        """The lines of contours that have a shape and no place."""
        return frozenset(each.lines[0] for each in self.answers if each.start.is_relative)

    def has_code(self, code: str) -> bool:
        """Whether one of the problems has a code."""
        return any(each.code == code for each in self.problems)


class Window(Struct, frozen=True, dict=True):
    """The blocks of something that is wrong (`own`) with the state before them, those `ahead` of it, a contour or a
    block each, with the states before these, and those `behind` it, which are all there are with `is_end`; `examine`
    examines blocks from a state on."""

    ahead: tuple[tuple[Sequence[Block], State], ...]
    own: tuple[Block, ...]
    behind: tuple[Block, ...]
    state: State
    control: Control
    examine: Callable[[Sequence[Block], State, tuple[tuple[Sequence[Block], State], ...]], Iterable[WindowPart]]
    is_end: bool = False

    @cached_property
    def blocks(self) -> tuple[Block, ...]:
        """All of them."""
        return (*(block for blocks, _ in self.ahead for block in blocks), *self.own, *self.behind)

    @cached_property
    def first(self) -> int:
        """The index of the first of its own blocks."""
        return sum(len(blocks) for blocks, _ in self.ahead)

    @cached_property
    def lines(self) -> tuple[int, ...]:
        """The lines of its own blocks."""
        return tuple(block.line for block in self.own)

    @cached_property
    def codes(self) -> Mapping[str, Effect]:
        """The codes of the control, without zeros that lead, and what each does."""
        return {plain_code(code.text): code.effect for code in self.control.modes.codes.values()}

    @cached_property
    def before(self) -> Seen:
        """The result as it is."""
        return _seen(self._parts)

    @cached_property
    def _parts(self) -> list[WindowPart]:
        return [*self.examine(self.blocks, self.ahead[0][1] if self.ahead else self.state, ())]

    @cached_property
    def _places(self) -> list[int]:
        """The index of the first block of each part."""
        return [0, *accumulate(len(part.blocks) for part in self._parts)][:-1]

    @cached_property
    def _known(self) -> dict[int, tuple[int, object]]:
        """The number of each part by the index of its first block, and what is known before it."""
        return {place: (number, self._parts[number].before.known()) for number, place in enumerate(self._places)}

    @cached_property
    def _tried(self) -> dict[tuple[Edit, ...], Seen | None]:
        return {}

    def after(self, edits: tuple[Edit, ...]) -> Seen | None:
        """The result with edits; what was tried is kept."""
        if edits not in self._tried:
            self._tried[edits] = self._after(edits)
        return self._tried[edits]

    def _after(self, edits: Sequence[Edit]) -> Seen | None:
        """The result with edits, up to the first thing that is wrong with its own blocks; None where they change
        nothing."""
        texts = apply_edits(self.blocks, edits)
        facts = {edit.span for edit in edits if edit.span is not None and edit.span.line < 0}
        changed = [
            at
            for at, block in enumerate(self.blocks)
            if texts[at] != block.text or any(each.span in facts for each in block.directives)
        ]
        if not changed:
            return None
        parts, places = self._parts, self._places
        # What rests on nothing that is changed stays.
        kept = next(at for at, part in enumerate(parts) if places[at] + part.reach > changed[0])
        begin, seen = places[kept], parts[:kept]
        blocks = read_edits(self.blocks[begin:], edits, self.control.modes.syntax)
        own, left = {*self.lines}, len(blocks)
        ahead = tuple((part.blocks, part.before) for part in seen if any(block.words for block in part.blocks))[-1:]
        for part in self.examine(blocks, parts[kept].before, ahead):
            seen.append(part)
            if any(each.span.line in own and each.about not in _MEANT for each in _problems(part)):
                break
            left -= len(part.blocks)
            # Where as much is known as there was, all is as it was from there on.
            number, known = self._known.get(len(self.blocks) - left, (0, None))
            if number and self._places[number] > changed[-1] + 1 and known == part.after.known():
                seen += parts[number:]
                break
        lines = frozenset(self.blocks[at].line for at in changed)
        return replace(_seen(seen), changed=lines)

    def mended(self, edits: tuple[Edit, ...], meant: Collection[Enum] = ()) -> Seen | None:
        """The result with edits; None where it is no better, where one of its own contours has no path, where something
        is wrong with an arc that is left alone, or where none is left although no word is dropped."""
        seen = self.after(edits)
        if seen is None or not self.mends(seen, meant):
            return None
        is_left = self.has_contour(seen) or all(edit.kind is EditKind.DROP for edit in edits)
        return seen if is_left and all(map(self._is_drawn, self._own(seen))) else None

    def _is_drawn(self, part: WindowPart) -> bool:
        """Whether a contour has a path; of plain blocks, whether nothing is wrong with their arcs."""
        if part.answer is not None:
            return part.answer.contour is not None
        arcs = (arc_of(block, part.before, self.control.modes) for block in part.blocks)
        return not any(arc is not None and any(faults_of(arc)) for arc in arcs)

    def begins_at(self, start: Start) -> bool:
        """Whether its own blocks begin at a start; else that is assumed, and the blocks before do not lead there."""
        first = next(self._own(self.before), None)
        return first is None or first.before.start().values == start.values

    def has_contour(self, seen: Seen) -> bool:
        """Whether some of its own blocks are a contour then."""
        return any(part.answer is not None for part in self._own(seen))

    def _own(self, seen: Seen) -> Iterator[WindowPart]:
        return parts_of(seen, {*self.lines})

    def changes(self, edits: Iterable[Edit]) -> Iterator[LineChange]:
        """The lines that edits change, each with its new text."""
        for block, text in zip(self.blocks, apply_edits(self.blocks, edits), strict=True):
            if text != block.text:
                yield LineChange(block.span, text, block.text)

    @cached_property
    def _known_problems(self) -> frozenset[tuple[str, int]]:
        return self.before.keys

    @cached_property
    def _waiting(self) -> frozenset[int]:
        """The lines of contours of which nobody knows where they begin."""
        found = (each for part in self.before.parts for each in _findings(part))
        return frozenset(each.span.line for each in found if each.about in _FOLLOWING)

    def mends(self, seen: Seen, meant: Collection[Enum] = ()) -> bool:
        """Whether nothing of its own is wrong then, nothing new elsewhere, and no contour has lost its place."""
        return seen.placeless <= self.before.placeless and not self.left(seen, meant)

    def left(self, seen: Seen, meant: Collection[Enum] = ()) -> list[Diagnostic]:
        """The problems of its own blocks then, and new ones elsewhere. What is wrong with contours that waited for it
        shows only then."""
        first, last = self.lines[0], self.lines[-1]
        old, keys = self.before, self._known_problems
        lost = self._waiting - seen.changed
        # The last blocks may belong to what is not seen any more.
        end = self.behind[-1].line + self.is_end if self.behind else last + 1
        found = list[Diagnostic]()
        has_error = any(each.is_error and first <= each.span.line <= last for each in old.problems)
        extended = (answer for answer in seen.answers if has_error and answer.profile.is_extended)
        stated_more = {line for answer in extended for line in answer.lines}
        for each in seen.problems:
            line = each.span.line
            is_rule = each.about is None and each.severity is Severity.WARNING
            if is_rule and line in stated_more and (each.code, line) in keys:
                # Beside an error, rules of the manual only warn where more is stated or asked than the control reads.
                continue
            if each.about in _MEANT or each.about in meant or (agrees(each) and not old.has_code(each.code)):
                continue
            is_new = (each.code, line) not in keys and line < end and line not in lost
            found += [each] if is_new or first <= line <= last else []
        return found


def parts_of(seen: Seen, lines: Collection[int]) -> Iterator[WindowPart]:
    """The parts with blocks in some lines."""
    return (part for part in seen.parts if any(block.line in lines for block in part.blocks))


def path_of(seen: Seen, lines: Collection[int]) -> Contour | None:
    """The path of some lines: their contour, or the contours and lines into which they are parted; None where they draw
    nothing, or something else."""
    elements, contours = list[Segment](), list[Contour]()
    for part in parts_of(seen, lines):
        if part.answer is not None and part.answer.contour is not None:
            contours.append(part.answer.contour)
            elements += part.answer.contour.elements
        elif moves := [*_moves(part)]:
            if part.after.motion != LINE:
                return None
            elements += [LineSegment(f"line {len(elements) + 1}", each.start, each.end) for each in moves]
    if contours and len(elements) == len(contours[0].elements):
        return contours[0]
    if not elements:
        return None
    plane = seen.parts[0].before.plane if not contours else contours[0].plane
    return Contour(elements[0].start, elements[-1].end, {}, tuple(elements), plane)


def alone(answer: Answer, control: Control) -> Window:
    """The window of a contour around which nobody looks."""

    def examined(blocks: Sequence[Block], state: State, _: object) -> Iterator[WindowPart]:
        while blocks:
            found, before, own = control.find(blocks, 0, state, control.modes), state, None
            if isinstance(found, ParsedContour) and found.form.is_contour:
                own = examine(found, control, Policy.ENFORCE, depth=Depth.VERDICT)
                state = leave(found, own.contour.end if own.contour else None, control.modes)
            part, blocks = (
                blocks[: len(found.blocks) if own and found else 1],
                blocks[len(found.blocks) if own and found else 1 :],
            )
            state = state if own else advance(state, part[0], control.modes)
            yield WindowPart(tuple(part), before, state, len(part) + 1, (), own)

    return Window((), answer.claim.blocks, (), answer.claim.before, control, examined)


def agrees(finding: Diagnostic) -> bool:
    """Whether a finding says only that a word agrees with others that tell the same."""
    is_near = finding.values.get("off_by_mm", float("inf")) <= AGREEMENT
    return finding.severity is Severity.WARNING and is_near and not opposes(finding.values, Unit.DEGREE)


def _problems(part: WindowPart) -> list[Diagnostic]:
    return [each for each in _findings(part) if each.severity is not Severity.INFO]


def _findings(part: WindowPart) -> tuple[Diagnostic, ...]:
    return (*part.findings, *(part.answer.diagnostics if part.answer else ()))


def _seen(parts: Sequence[WindowPart]) -> Seen:
    return Seen(
        tuple(parts),
        tuple(each for part in parts for each in _problems(part)),
        tuple(move for part in parts for move in _moves(part)),
    )


_FOLLOWING = (ReadIssue.POSITION_UNKNOWN, ReadIssue.CONTOUR_WAITS)
"""Problems of contours behind one that has no path; what else is wrong with them shows later."""

_MEANT = (ReadIssue.AXIS_CROSSED, ReadIssue.START_IN_INCREMENTS)
"""Problems that no edit of the contour is about."""


def _moves(part: WindowPart) -> Iterator[Stretch]:
    plane = part.after.plane
    turned = next((number for number, is_diameter in enumerate(plane.diameters) if is_diameter), None)
    contour = part.answer.contour if part.answer else None
    if contour is not None:
        yield from moves_of(contour)
    elif part.answer is None and part.after.motion is not None and not part.after.doubts:
        ends = [state.axes[axis].value for state in (part.before, part.after) for axis in plane.axes]
        if all(each is not None for each in ends):
            first, second, third, fourth = (float(each or 0) for each in ends)
            if (first, second) != (third, fourth):
                heading = degrees(atan2(fourth - second, third - first))
                is_cutting = part.after.motion in _FEEDS
                yield Stretch((first, second), (third, fourth), turned, (heading, heading), is_cutting=is_cutting)


def moves_of(contour: Contour) -> Iterator[Stretch]:
    """The path of a contour."""
    turned = next((number for number, is_diameter in enumerate(contour.plane.diameters) if is_diameter), None)
    turned = None if any(contour.free) else turned
    for each in contour.elements:
        if isinstance(each, ArcSegment):
            sweep = degrees(each.length / each.radius) * each.turn.sign if each.radius else 0.0
            out = degrees(atan2(each.end[1] - each.center[1], each.end[0] - each.center[0])) + 90 * each.turn.sign
            yield Stretch(each.start, each.end, turned, (out - sweep, out), sweep)
        elif each.length:
            heading = degrees(atan2(each.end[1] - each.start[1], each.end[0] - each.start[0]))
            yield Stretch(each.start, each.end, turned, (heading, heading))
