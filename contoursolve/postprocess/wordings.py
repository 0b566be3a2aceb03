"""Wordings of drawn elements: words with what they rest on, and the plain lines and arcs that all controls have."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from decimal import Decimal
from enum import Enum
from itertools import product

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import write_word
from contoursolve.geometry import Arc, CornerShape, Unit, Values as Known, scalar
from contoursolve.postprocess.contour_drawing import EXACT, ContourDrawing, DrawnElement, size_as
from contoursolve.postprocess.emit import Format, emit, parts_of
from contoursolve.postprocess.post_processors import SAME, Arcs
from contoursolve.reading import ContourForm, Control, State
from contoursolve.solving import ArcSegment, Point, Segment

REFERENCE = "@"
"""Stands on both sides of the place of an element, for the number of its block."""


class NumberGround(Enum):
    """The ground on which the number of a word rests."""

    DRAWING = "the drawing's own number"
    ROUND = "a number with the control's decimals"
    COMPUTED = "computed and rounded"
    NONE = "no number"


class WrittenWord(Struct, frozen=True):
    """A word of a contour that is written for a control.

    Attributes:
        text: the word as it is written.
        ground: what its number rests on.
        off: by how much rounding puts the number off, in `unit`.
        unit: mm or degrees.
        is_indirect: whether it is an increment along an axis, or an angle that is rounded.
    """

    text: str
    ground: NumberGround = NumberGround.NONE
    off: float = 0.0
    unit: Unit = Unit.MM
    is_indirect: bool = False


class WrittenBlock(Struct, frozen=True):
    """A block of a contour that is written for a control.

    Attributes:
        motion: the motion that it leaves in force, such as 1 for G01; None if that is not said.
        code: the code with which it begins; empty for none.
        words: its words, in their order.
        place: the place of its element on the path, where other blocks may speak of it; -1 elsewhere.
    """

    motion: int | None
    code: str
    words: tuple[WrittenWord, ...]
    place: int = -1


def said(blocks: Iterable[WrittenBlock], motion: int | None = 0) -> tuple[tuple[str, ...], int, int | None]:
    """The lines of blocks where a motion is in force, the number of their codes, and the motion in force behind
    them."""
    lines, codes = list[str](), 0
    for block in blocks:
        code = [] if block.motion is not None and block.motion == motion else [*filter(None, (block.code,))]
        lines.append(" ".join((*code, *(word.text for word in block.words))))
        codes, motion = codes + len(code), motion if block.motion is None else block.motion
    return tuple(lines), codes, motion


class Wording(Struct, frozen=True):
    """Blocks that say `count` elements in a row. `is_cut` tells that the next one begins where the corner behind them
    ends, and not at its virtual intersection."""

    count: int
    blocks: tuple[WrittenBlock, ...]
    is_cut: bool = False
    needs_side: bool = False
    """Whether the control computes an intersection, which some do while a side of the contour is chosen alone."""
    writes_corner: bool = False
    """Whether the corner behind them has a block of its own."""
    is_plain: bool = False
    """Whether they are lines and arcs by their ends."""

    @property
    def words(self) -> Iterator[WrittenWord]:
        """The words of all its blocks."""
        return (word for block in self.blocks for word in block.words)


class HostProgram(Struct, frozen=True):
    """A program in which the blocks stand: where the tool is before them (mm), how numbers and arcs are written,
    whether its lines are rapid, the code that chooses a side of the contour."""

    here: Point
    form: Format
    is_rapid: bool
    side: str


class CornerWay(Struct, frozen=True):
    """One way to make the corner behind an element: its words, where the element ends then, and the blocks behind it,
    if it has no words."""

    words: tuple[WrittenWord, ...]
    end: Point
    behind: tuple[WrittenBlock, ...] = ()


Values = Mapping[str, tuple[float, int | None]]
"""The value of each word of a form, mm (radius) or degrees, and its axis if it is a coordinate."""


class Speller:
    """The words of a control for numbers of a contour; `state` is that behind its opening, `around` the program in
    which they stand, if it is there already: then each block states both coordinates."""

    def __init__(
        self, drawn: ContourDrawing, control: Control, state: State, around: HostProgram | None = None
    ) -> None:
        self.around, self.line = around, 0 if around is not None and around.is_rapid else 1
        self.drawn, self.control, self.modes = drawn, control, control.modes
        self.corner_rows: Sequence[tuple[str, int, CornerShape]] = control.corners
        """The words that make the corner behind an element, each with the sign of its number and the shape."""
        self.plane, self.unit = state.plane, state.unit
        self.lexicon = control.modes.words(state)
        rows = self.lexicon.addresses.values()
        self.steps = {row.axis: row.address for row in rows if row.is_increment and row.axis and around is None}

    def address_in(self, text: str) -> str:
        """The address with which a word begins; empty for one that is named otherwise."""
        return max(filter(text.startswith, self.lexicon.addresses), key=len, default="")

    def word(self, address: str, value: float, axis: int | None = None, text: str = "") -> WrittenWord:
        """The word for a value, mm (radius) or degrees: a coordinate along an axis, a length or an angle. Of a text
        that states it, only on what that rests."""
        row = self.lexicon.addresses[address]
        own = self.drawn.number(value, axis, row.unit)
        exact = value if own is None else float(own)
        text = text or write_word(address, exact, self.lexicon, self.unit)
        number = Decimal(self.lexicon.number_of(text, address) or 0)
        if row.unit is not Unit.DEGREE:
            number *= self.unit.in_mm / (2 if row.is_diameter else 1)
        elif row.clockwise_from is not None:
            number = row.clockwise_from - number
        off = abs(float(number) - exact)
        ground = NumberGround.COMPUTED if off > EXACT else NumberGround.ROUND if own is None else NumberGround.DRAWING
        is_turned = row.unit is Unit.DEGREE and ground is NumberGround.COMPUTED
        is_indirect = is_turned or bool(row.axis and row.is_increment)
        return WrittenWord(text, ground, off if off > EXACT else 0.0, row.unit, is_indirect)

    def place(self, at: Point) -> tuple[WrittenWord, ...]:
        """The words for both coordinates of a point."""
        return tuple(self.word(axis, at[n], n) for n, axis in enumerate(self.plane.axes))

    def at(self, index: int, *, is_cut: bool, is_plain: bool = False) -> Iterator[Wording]:
        """All wordings of the elements from one on, which begins behind a corner that is cut or at its virtual end; or
        only lines and arcs by their ends."""
        yield from (each for each in self.plain(index, is_cut=is_cut) if each.is_plain or not is_plain)
        yield from () if is_plain else self.special(index, is_cut=is_cut)

    def special(self, index: int, *, is_cut: bool) -> Iterator[Wording]:
        """The wordings that only this kind of control has, beside the plain ones."""
        raise NotImplementedError

    def begin(self, index: int, *, is_cut: bool) -> Point:
        """The place where an element begins."""
        before = self.drawn.elements[index - 1].corner if index else None
        return before.segment.end if is_cut and before else self.drawn.elements[index].segment.start

    def plain(self, index: int, *, is_cut: bool) -> Iterator[Wording]:
        """Ends, as coordinates or increments; arcs about their centre, or by their radius. A corner is written out, or
        has the control's word."""
        element, begin = self.drawn.elements[index], self.begin(index, is_cut=is_cut)
        for way in self.corners(element):
            segment = replace(element.segment, start=begin, end=way.end)
            # Of an element that its corners use up, nothing is left to be written out.
            for moves in self.moves(segment) if way.words or element.cut is not None else ((),):
                if moves or way.behind:
                    yield self.closed(1, moves, way, is_plain=not way.words)

    def closed(self, count: int, moves: tuple[WrittenBlock, ...], way: CornerWay, *, is_plain: bool = False) -> Wording:
        """The wording of elements with the corner behind the last one."""
        blocks, is_cut = self.attach(moves, way.words), bool(way.behind)
        return Wording(count, (*blocks, *way.behind), is_cut, writes_corner=is_cut, is_plain=is_plain)

    def corners(self, element: DrawnElement) -> Iterator[CornerWay]:
        """The ways to make the corner behind an element."""
        if element.corner is None:
            yield CornerWay((), element.segment.end)
            return
        yield from (CornerWay((word,), element.segment.end) for word in self.corner_words(element))
        behind = element.corner.segment
        yield from (CornerWay((), behind.start, blocks) for blocks in self.moves(behind))

    def corner_words(self, element: DrawnElement) -> Iterator[WrittenWord]:
        """The words that make the corner behind an element; none where no element follows."""
        for address, sign, shape in self.corner_rows if element is not self.drawn.elements[-1] else ():
            size = size_as(shape, element)
            if size is not None:
                yield self.word(address, sign * size)

    def attach(self, moves: tuple[WrittenBlock, ...], words: tuple[WrittenWord, ...]) -> tuple[WrittenBlock, ...]:
        """The blocks of an element with the words that make the corner behind it."""
        return (*moves[:-1], replace(moves[-1], words=(*moves[-1].words, *words))) if words else moves

    def moves(self, segment: Segment) -> Iterator[tuple[WrittenBlock, ...]]:
        """An element by its end, in each way that the control has."""
        raise NotImplementedError


class GCodeSpeller(Speller):
    """The words of a control that is programmed in G codes."""

    def moves(self, segment: Segment) -> Iterator[tuple[WrittenBlock, ...]]:
        """An element by its end: as coordinates or as increments, an arc about its centre or by its radius."""
        if isinstance(segment, ArcSegment) or self.around is not None:
            yield from (tuple(self._written_out(segment, form)) for form in self._formats())
            return
        ways, axes = list[list[WrittenWord]](), self.plane.axes
        for axis in sorted(changed_axes(segment), key=lambda axis: axes[axis]):
            step, end = self.steps.get(axes[axis]), segment.end[axis]
            words = [self.word(axes[axis], end, axis), *([self.word(step, end - segment.start[axis])] if step else [])]
            ways.append([word for n, word in enumerate(words) if not n or word.ground is not NumberGround.COMPUTED])
        yield from (
            (WrittenBlock(self.kept(self.line), self.code(self.line), words),) if words else ()
            for words in product(*ways)
        )

    def _formats(self) -> Iterator[Format]:
        """The ways to write arcs."""
        numbers = self.lexicon.numbers
        decimals, has_point = SAME.digits(self.unit, numbers), SAME.writes_point(numbers)
        own = (Format(self.plane, self.unit, decimals, has_point, arcs, radius=self.modes.radius) for arcs in Arcs)
        yield from own if self.around is None else (self.around.form,)

    def _written_out(self, segment: Segment, form: Format) -> Iterator[WrittenBlock]:
        """Plain moves, rounded so that an arc stays one; increments count from where rounding has led before."""
        here = _rounded(segment.start, form) if form.is_incremental else segment.start
        moves = emit(segment, here, form, is_rapid=not self.line)
        for part, move in zip(parts_of(segment, form), moves, strict=True):
            steps = (end - at * form.is_incremental for end, at in zip(part.end, here, strict=True))
            exact = dict(zip(self.plane.axes, steps, strict=True))
            if isinstance(segment, ArcSegment):
                center = (at - begin for at, begin in zip(segment.center, here, strict=True))
                exact |= {form.radius: segment.radius, **dict(zip(self.plane.centers, center, strict=True))}
            here, words = move.end, list[WrittenWord]()
            for address, text in ((self.address_in(text), text) for text in move.words):
                axis = self.plane.axes.index(address) if address in self.plane.axes else None
                words.append(self.word(address, exact[address], axis, text))
            if words:
                yield WrittenBlock(self.kept(move.code), self.code(move.code), tuple(words))

    def kept(self, motion: int) -> int | None:
        """The motion that a block of it leaves in force; None on a control that has each block say it."""
        return motion if self.control.has_modal_motions else None

    def code(self, motion: int) -> str:
        """The code of a motion."""
        return self.modes.codes[motion].text

    def laid(
        self,
        form: ContourForm,
        row: Sequence[DrawnElement],
        begin: Point,
        ways: Sequence[CornerWay],
        more: Mapping[str, Point] = {},
    ) -> Values:
        """The values of the words of a form whose path lies on a row of elements, which begins at a place and has
        corners made in some ways. There may be `more` known points."""
        places, radii, path = {form.outline.path[0].tail: begin, **more}, dict[str, float](), form.outline.path
        for each, element, way in zip(path, row, ways, strict=True):
            places[each.head] = way.end
            if isinstance(each, Arc) and isinstance(element.segment, ArcSegment):
                places[each.center], radii[each.radius] = element.segment.center, element.segment.radius
        # The lines beside the path, on which the last corner lands.
        corner = row[-1].corner
        for line in form.outline.lines:
            if corner is not None and not ways[-1].behind:
                places.setdefault(line.head, corner.segment.end)
            if line.head in places:
                places.setdefault(line.tail, places[line.head])
        scalars = {scalar(name, axis): at for name, place in places.items() for axis, at in enumerate(place)} | radii
        known, found = Known(scalars, {}, {}), dict[str, tuple[float, int | None]]()
        for fact in (each.fact for each in form.outline.facts if each.fact.given):
            with suppress(KeyError):
                value, placed = fact.implied(known), fact.placed
                axis = placed.axis if placed is not None and not placed.origin else None
                found |= {fact.given: (value, axis)} if value is not None and fact.given not in found else {}
        return found


def _rounded(place: Point, form: Format) -> Point:
    first, second = (
        float(form.number(at / form.mm * n)) * form.mm / n for at, n in zip(place, form.scales, strict=True)
    )
    return first, second


def changed_axes(segment: Segment) -> Iterator[int]:
    """The axes along which an element leads elsewhere."""
    return (n for n, (a, b) in enumerate(zip(segment.start, segment.end, strict=True)) if abs(b - a) > EXACT)
