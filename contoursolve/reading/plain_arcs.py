"""Arcs as the words of one block state them, counted from where they begin, and what is wrong with one by itself."""

import re
from bisect import bisect_right
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import accumulate
from math import hypot

from msgspec import Struct

from contoursolve.gcode import Block, Passage, Syntax, Word, late_pattern, words_of
from contoursolve.geometry import Turn
from contoursolve.reading.arc_table import ArcIssue, ArcTable, Beyond, BothStated
from contoursolve.reading.lexicon import Bearing, Code, Effect, Lexicon
from contoursolve.reading.modal_state import COMMENTED, Mode, Modes, State, apply_modes, codes_of
from contoursolve.tolerance import LENGTH

TURNS: Mapping[int, Turn] = {2: Turn.CW, 3: Turn.CCW}
"""The motions of arcs."""

Pair = tuple[float, float]


class ArcWord(Struct, frozen=True):
    """A word of an arc: its value counted from where the arc begins, mm, None where that is not known; and what to add
    to another value to have what the word states."""

    word: Word
    value: float | None
    base: float | None = 0.0


Words = tuple[ArcWord | None, ArcWord | None]


class PlainArc(Struct, frozen=True):
    """An arc: its words, by the axes of the plane where there are two of a kind, and how the control reads it."""

    block: Block
    here: State
    """The state before it, with its codes in force."""
    table: ArcTable
    lexicon: Lexicon
    ends: Words
    centers: Words
    radius: ArcWord | None = None
    outside: tuple[Word, ...] = ()
    """Words of a centre for an axis outside the plane."""
    is_whole: bool = True
    """Whether there is no word beside them that may shape it."""
    center_text: str = ""
    """The line that states its centre, where that is not its block."""
    opening: Word | None = None
    """The word of its opening angle."""
    between: Words = (None, None)
    """The words of a point between its ends."""

    @property
    def words(self) -> tuple[Word, ...]:
        """The words of its end, centre and radius."""
        shaping = (*self.ends, *self.centers, self.radius, *self.between)
        own = tuple(each.word for each in shaping if each is not None)
        return own if self.opening is None else (*own, self.opening)

    @property
    def way(self) -> Pair | None:
        """From where it begins to where it ends, mm."""
        first, second = (0.0 if each is None else each.value for each in self.ends)
        return None if first is None or second is None else (first, second)

    @property
    def spoke(self) -> Pair | None:
        """From where it begins to its centre, mm."""
        if self.centers == (None, None):
            return None
        first, second = (0.0 if each is None else each.value for each in self.centers)
        return None if first is None or second is None else (first, second)

    @property
    def size(self) -> float | None:
        """Its radius as it is stated, mm, with its sign."""
        return None if self.radius is None else self.radius.value


class ArcFault(Struct, frozen=True):
    """An issue with an arc, and the values compared, mm."""

    issue: ArcIssue
    values: Mapping[str, float] = {}


def arc_of(block: Block, before: State, modes: Modes) -> PlainArc | None:
    """The arc that a block states by itself; None where it is none, or where it is not known how it is read."""
    if modes.arcs is None or block.faults or block.macro is not None or COMMENTED in before.memory:
        return None
    return (modes.arcs.read or _arc_of_codes)(block, before, modes)


def table_in(state: State, modes: Modes) -> ArcTable:
    """The table of arcs of a control in a state, with the numbers of its settings."""
    table = (modes.arcs or ArcTable()).with_numbers(modes.settings)
    return table if table.in_force is None else table.in_force(table, state)


_DOUBTED = (Mode.MOTION, Mode.MOVE, Mode.PLANE)
_MEASURED = (Mode.UNIT, Mode.INCREMENTS, Mode.DIAMETER)
_BESIDE = (Effect.NONE, Effect.MOTION, Effect.PLANE, Effect.UNITS, Effect.ABSOLUTE, Effect.INCREMENTAL)
_OF_MOVES = frozenset({*_BESIDE, Effect.COMPENSATION, Effect.SHIFT, Effect.CANCEL})
"""Effects of codes beside which words of axes are where a motion ends."""


def _arc_of_codes(block: Block, before: State, modes: Modes) -> PlainArc | None:
    here = apply_modes(before, block, modes)
    through, table = code_through(here, modes), table_in(here, modes)
    is_arc = through is not None or here.motion in TURNS
    if not is_arc or any(mode in here.doubts for mode in _DOUBTED):
        return None
    codes = [code for code in codes_of(block, modes) if code is not through]
    is_move = all(isinstance(code, Code) and code.effect in _OF_MOVES and code.is_read for code in codes)
    if not is_move or (table.planes and here.plane.code not in table.planes) or table.others & here.memory.keys():
        return None
    if any(modes.is_call(word) or modes.is_unread_call(word) for word in block.words):
        return None
    is_measured = here.doubts.keys().isdisjoint(_MEASURED)
    arc = _Reading(block, here, modes, table, is_measured=is_measured).arc()
    if arc is None or (through is None) is (arc.between == (None, None)):
        return arc
    return None


def code_through(state: State, modes: Modes) -> Code | None:
    """The code in force of an arc through a point between its ends, if it is one."""
    code = modes.codes.get(state.motion) if state.motion is not None else None
    name = modes.arcs.through if modes.arcs is not None else ""
    return code if code is not None and name and code.name == name else None


def is_read_by_arcs(word: Word, block: Block, before: State, modes: Modes) -> bool:
    """Whether a word shapes an arc by itself, and is read there, though it is not read in contours."""
    table = modes.arcs
    if table is None or word.address not in ("G", table.opening):
        return False
    arc = arc_of(block, before, modes)
    return arc is not None and (arc.opening is word or (word.address == "G" and arc.between != (None, None)))


class _Reading:
    """The reading of the words of a block in G codes as an arc."""

    def __init__(self, block: Block, here: State, modes: Modes, table: ArcTable, *, is_measured: bool) -> None:
        self.block, self.here, self.modes, self.table, self.is_measured = block, here, modes, table, is_measured
        self.lexicon = modes.words(here)

    def arc(self) -> PlainArc | None:
        """The arc; None where a word is there twice, or leads elsewhere."""
        named = [(word, self._kind(word)) for word in self.block.words]
        kinds = [kind for _, kind in named if kind]
        if len({*kinds}) < len(kinds):
            return None
        plane, rows, table, radius = self.here.plane, self.lexicon.addresses, self.table, self.modes.radius
        found = {kind: word for word, kind in named if kind}
        beside = {kind for kind in found if kind not in (*_CENTERS, radius)} - {*plane.axes}
        outside = tuple(found[kind] for kind in _CENTERS if kind in found and kind not in plane.centers)
        ends = tuple(self._end(found[axis], at) if axis in found else None for at, axis in enumerate(plane.axes))
        centers = tuple(
            self._center(found[each], at) if each in found else None for at, each in enumerate(plane.centers)
        )
        shape = ArcWord(found[radius], self._value(found[radius])) if radius in found else None
        points = [(found.get(f"{each}1"), at) for at, each in enumerate(plane.centers)]
        between = tuple(None if word is None else self._between(word, at) for word, at in points)
        beside -= {table.opening, *(f"{each}1" for each in plane.centers)}
        is_alone = not any((*ends, *centers, *beside))
        if not found or not beside <= _linear(self.modes) or (shape and is_alone and not table.needs_end):
            return None
        others = {word.address for word, kind in named if not kind} - {"G", *table.beside}
        opening = found.get(table.opening) if table.opening else None
        # A word that the control has not may be meant for one that it has.
        is_whole = not any(each in rows or self.lexicon.bearing(each) in _SHAPING for each in others)
        outside = () if beside and table.has_pitch else outside
        return PlainArc(
            *(self.block, self.here, table, self.lexicon, _pair(ends), _pair(centers), shape, outside, is_whole),
            opening=opening,
            between=_pair(between),
        )

    def _kind(self, word: Word) -> str:
        """The axis, the letter of a centre, or the radius that a word states; empty for another word."""
        address = word.address
        row = self.lexicon.addresses.get(address)
        if row is not None and row.axis:
            return row.axis
        table = self.table
        if address and (address == table.opening or (table.through and address in _BETWEEN)):
            return address
        name = address.removesuffix(_ABSOLUTE)
        return name if name in _CENTERS or address == self.modes.radius else ""

    def _value(self, word: Word) -> float | None:
        if not self.is_measured or word.address not in self.lexicon.addresses:
            return None
        value = self.lexicon.value(word, self.here.unit)
        return None if value is None else float(value)

    def _start(self, index: int) -> float | None:
        """The place where the arc begins along an axis, mm; None where that is not known for sure."""
        at = self.here.axes[self.here.plane.axes[index]]
        return None if at.value is None or at.is_skippable else float(at.value)

    def _end(self, word: Word, index: int) -> ArcWord:
        value, row = self._value(word), self.lexicon.addresses[word.address]
        if row.is_step(is_incremental=self.here.is_incremental):
            return ArcWord(word, value)
        start = self._start(index)
        return ArcWord(word, None if value is None or start is None else value - start, start)

    def _between(self, word: Word, index: int) -> ArcWord:
        """A coordinate of a point between the ends; whether one is a diameter, no page says."""
        start = 0.0 if self.here.is_incremental else self._start(index)
        is_open = word.number is None or not self.is_measured or any(self.here.plane.diameters) or start is None
        value = None if is_open or word.number is None else float(word.number * self.here.unit.in_mm) - (start or 0.0)
        return ArcWord(word, value, start)

    def _center(self, word: Word, index: int) -> ArcWord:
        is_absolute = word.address.endswith(_ABSOLUTE)
        if is_absolute:
            # Whether a coordinate of a centre is a diameter, controls decide by a setting.
            is_open = word.number is None or not self.is_measured or any(self.here.plane.diameters)
            value = None if is_open or word.number is None else float(word.number * self.here.unit.in_mm)
        else:
            value = self._value(word)
        if not (is_absolute or self.table.counts_from_origin):
            return ArcWord(word, value)
        start = self._start(index)
        return ArcWord(word, None if value is None or start is None else value - start, start)


def _pair(words: tuple[ArcWord | None, ...]) -> Words:
    first, second = words
    return first, second


_CENTERS = ("I", "J", "K")
_BETWEEN = frozenset(f"{each}1" for each in _CENTERS)
_FULL = 360
_ABSOLUTE = "=AC"
_SHAPING = (None, Bearing.UNREAD, Bearing.END, Bearing.AXIS)


@cache
def _axes_of(codes: tuple[Code, ...]) -> frozenset[str]:
    return frozenset(axis for code in codes if code.plane for axis in code.plane.axes)


def _linear(modes: Modes) -> frozenset[str]:
    """The axes that a plane has."""
    planes = tuple(code for code in modes.codes.values() if code.plane is not None)
    return _axes_of(planes) or frozenset(modes.axes)


# What is wrong with one -----------------------------------------------------------------------------------------


def faults_of(arc: PlainArc) -> Iterator[ArcFault]:
    """The issues with an arc by itself; none that depends on what is not known."""
    table = arc.table
    if arc.outside:
        yield ArcFault(ArcIssue.OUTSIDE_PLANE)
        return
    if arc.between != (None, None):
        yield from _of_point_between(arc)
        return
    if arc.opening is not None:
        angle = arc.opening.number
        if angle is not None and not 0 < angle < _FULL:
            yield ArcFault(ArcIssue.OPENING)
        return
    has_center = arc.centers != (None, None)
    if has_center and arc.radius is not None:
        if table.both is BothStated.REFUSED:
            yield ArcFault(ArcIssue.BOTH)
            return
        if table.both is BothStated.AGREES and _disagree(arc):
            yield ArcFault(ArcIssue.BOTH)
            return
    if arc.radius is not None:
        yield from _of_radius(arc)
    elif has_center:
        yield from _of_center(arc)
    elif arc.is_whole:
        yield ArcFault(ArcIssue.RUNS_LINE if table.runs_line else ArcIssue.UNDEFINED)


def _disagree(arc: PlainArc) -> bool:
    """Whether the centre is not as far from where the arc begins as the radius says."""
    spoke, size = arc.spoke, arc.size
    return spoke is not None and size is not None and not arc.table.allows(abs(hypot(*spoke) - abs(size)), abs(size))


def _of_point_between(arc: PlainArc) -> Iterator[ArcFault]:
    """That the point between the ends lies in line with them: then there is no circle, or a full one."""
    first, second = (0.0 if each is None else each.value for each in arc.between)
    way = arc.way
    if way is None or first is None or second is None:
        return
    length = hypot(*way)
    aside = abs(way[0] * second - way[1] * first)
    if aside <= LENGTH * length or hypot(first, second) <= LENGTH:
        yield ArcFault(ArcIssue.IN_LINE)


def _of_radius(arc: PlainArc) -> Iterator[ArcFault]:
    way, size, table = arc.way, arc.size, arc.table
    if size is not None and abs(size) <= LENGTH:
        yield ArcFault(ArcIssue.EMPTY)
        return
    if way is None:
        if size is not None and size < 0 and table.refuses_negative:
            yield ArcFault(ArcIssue.OVER_HALF)
        return
    half = hypot(*way) / 2
    if half <= LENGTH and arc.is_whole:
        yield ArcFault(ArcIssue.MOVES_NOTHING if table.is_still else ArcIssue.FULL_BY_RADIUS)
    elif size is not None:
        short = half - abs(size)
        if not table.allows(short, abs(size)):
            values = {"limit": half, "actual": abs(size), "off_by_mm": short}
            yield ArcFault(ArcIssue.RADIUS_SMALL, values)
        elif size < 0 and table.refuses_negative:
            yield ArcFault(ArcIssue.OVER_HALF)


def _of_center(arc: PlainArc) -> Iterator[ArcFault]:
    way, spoke, table = arc.way, arc.spoke, arc.table
    if spoke is None:
        return
    radius = hypot(*spoke)
    if way is None:
        return
    distance = hypot(way[0] - spoke[0], way[1] - spoke[1])
    if max(radius, distance) <= LENGTH:
        yield ArcFault(ArcIssue.EMPTY)
        return
    off = abs(radius - distance)
    if table.allows(off, radius):
        return
    values = {"radius": radius, "distance": distance, "off_by_mm": off, "limit": table.limit(radius)}
    if table.beyond is Beyond.MOVES_CENTRE:
        center = moved_center(way, spoke)
        shift = hypot(center[0] - spoke[0], center[1] - spoke[1])
        if shift <= table.shift + LENGTH and shift <= table.shift_share * radius + LENGTH:
            moved = {"shift": shift, "first": center[0], "second": center[1], "actual": hypot(*center)}
            yield ArcFault(ArcIssue.CENTRE_MOVES, values | moved)
            return
    is_refused = table.beyond in (Beyond.REFUSES, Beyond.MOVES_CENTRE)
    yield ArcFault(table.issue if is_refused else ArcIssue.SPIRAL, values)


def moved_center(way: Pair, spoke: Pair) -> Pair:
    """The place nearest to a centre that is as far from both ends of an arc, counted from where it begins."""
    length = way[0] * way[0] + way[1] * way[1]
    # By how much the centre lies past the middle of the chord, along it.
    past = (spoke[0] * way[0] + spoke[1] * way[1]) / length - 0.5
    return spoke[0] - past * way[0], spoke[1] - past * way[1]


# Plain lines ----------------------------------------------------------------------------------------------------


def suspected(passage: Passage, state: State, modes: Modes) -> Iterator[int]:
    """The indices of plain lines that may be arcs with which something is wrong: all others are right, or no arcs."""
    if modes.arcs is None:
        return iter(())
    return (modes.arcs.suspects or _suspected_in_codes)(passage, state, modes)


_ARC_CODE = late_pattern(r"G0?[23](?![0-9])", re.IGNORECASE)
_LINE_CODE = late_pattern(r"G0?[01](?![0-9])", re.IGNORECASE)
_WORD = late_pattern(r"(CR|[XYZIJKR])=?(?:AC\()?([-+]?[0-9.]+)", re.IGNORECASE)
_MOVING = late_pattern(r"[XYZ]", re.IGNORECASE)


def _suspected_in_codes(passage: Passage, state: State, modes: Modes) -> Iterator[int]:
    text, syntax = passage.text, passage.syntax
    if state.motion in TURNS:
        yield from _modal_arcs(passage.lines, 0, syntax)
    found, reading = _ARC_CODE.search(text), _Quick(state, modes)
    lines = passage.lines if found is not None else ()
    begins = [*accumulate(map(len, lines), initial=0)]
    while found is not None:
        index = bisect_right(begins, found.start()) - 1
        if not reading.is_right(lines, index, syntax):
            yield index
        yield from _modal_arcs(lines, index + 1, syntax)
        found = _ARC_CODE.search(text, begins[index + 1])


def _modal_arcs(lines: tuple[str, ...], index: int, syntax: Syntax) -> Iterator[int]:
    """The lines from an index on that move while an arc is in force, without saying it."""
    for place in range(index, len(lines)):
        words = words_of(lines[place], syntax)
        if _LINE_CODE.search(words) or _ARC_CODE.search(words):
            return
        if _MOVING.search(words):
            yield place


def is_surely_right(table: ArcTable, way: Pair, shape: Pair | float) -> bool:
    """Whether an arc along a way is right within all that its control allows, by its centre, counted from where it
    begins, or by its radius."""
    if isinstance(shape, float):
        is_negative = shape < 0 and table.refuses_negative
        return LENGTH < hypot(*way) / 2 <= abs(shape) and not is_negative
    radius = hypot(*shape)
    off = abs(radius - hypot(way[0] - shape[0], way[1] - shape[1]))
    return radius > LENGTH and table.allows(off, radius)


class _Quick:
    """Reads plain lines as a glance does, to pass those that are surely right."""

    def __init__(self, state: State, modes: Modes) -> None:
        self.table, self.plane, self.radius = table_in(state, modes), state.plane, modes.radius
        words, unit = modes.words(state), float(state.unit.in_mm)
        self.is_plain = state.doubts == {} and not self.table.counts_from_origin and not self.table.planes
        self.scale = {
            name: unit * (0.5 if words.addresses[name].is_diameter else 1.0)
            for name in (*self.plane.axes, *self.plane.centers, self.radius)
            if name in words.addresses
        }
        self.state = state

    def is_right(self, lines: tuple[str, ...], index: int, syntax: Syntax) -> bool:
        """Whether the arc of a line is surely right."""
        if not self.is_plain:
            return False
        words = self._words(lines[index], syntax)
        (first, second), (one, other) = self.plane.axes, self.plane.centers
        if first not in words and second not in words:
            return False
        begin = self._before(lines, index, first, syntax), self._before(lines, index, second, syntax)
        if begin[0] is None or begin[1] is None:
            return False
        scale = self.scale
        way = (
            words[first] * scale[first] - begin[0] if first in words else 0.0,
            words[second] * scale[second] - begin[1] if second in words else 0.0,
        )
        has_center, has_radius = one in words or other in words, self.radius in words
        if has_center == has_radius or len(words.keys() & {"I", "J", "K"}) > (one in words) + (other in words):
            return False
        if has_radius:
            return is_surely_right(self.table, way, words[self.radius] * scale[self.radius])
        spoke = words.get(one, 0.0) * scale[one], words.get(other, 0.0) * scale[other]
        return is_surely_right(self.table, way, spoke)

    def _before(self, lines: tuple[str, ...], index: int, axis: str, syntax: Syntax) -> float | None:
        """The place of an axis before a line, mm."""
        for place in range(index - 1, -1, -1):
            line = lines[place]
            if axis in line or axis.lower() in line:
                number = self._words(line, syntax).get(axis)
                if number is not None:
                    return number * self.scale[axis]
        at = self.state.axes[axis]
        return None if at.value is None or at.is_skippable else float(at.value)

    def _words(self, line: str, syntax: Syntax) -> dict[str, float]:
        is_clean = "(" not in line and ";" not in line
        text = line if is_clean else words_of(line, syntax)
        return {name.upper(): float(number) for name, number in _WORD.findall(text)}
