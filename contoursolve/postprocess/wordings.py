"""Wordings of drawn elements: words with what they rest on, and the plain lines and arcs that all controls have."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from decimal import Decimal
from enum import Enum
from itertools import product

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import write_word
from contoursolve.gcode import number_of
from contoursolve.geometry import Length, Unit, Values, scalar
from contoursolve.postprocess.contour_drawing import EXACT, ContourDrawing, DrawnElement
from contoursolve.postprocess.emit import Format, emit
from contoursolve.postprocess.post_processors import Arcs
from contoursolve.reading import ContourForm, Dialect, State, WithoutPoint
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
    """A word, on what it rests, and by how much rounding puts it off, in its unit."""

    text: str
    ground: NumberGround = NumberGround.NONE
    off: float = 0.0
    unit: Unit = Unit.MM
    is_indirect: bool = False
    """Whether it is an increment along an axis, or an angle that is rounded."""


class WrittenBlock(Struct, frozen=True):
    """A block: the motion that it leaves in force, None if that is not said; its code, and its words."""

    motion: int | None
    code: str
    words: tuple[WrittenWord, ...]
    place: int = -1
    """The place of its element on the path, where other blocks may speak of it."""


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


class HostProgram(Struct, frozen=True):
    """A program in which the blocks stand: where the tool is before them (mm), how numbers and arcs are written,
    whether its lines are rapid, the code that chooses a side of the contour."""

    here: Point
    form: Format
    is_rapid: bool
    side: str


class Speller:
    """The words of a control for numbers of a contour; `state` is that behind its opening, `around` the program in
    which they stand, if it is there already: then each block states both coordinates."""

    def __init__(
        self, drawn: ContourDrawing, dialect: Dialect, state: State, around: HostProgram | None = None
    ) -> None:
        self.around, self.line = around, 0 if around is not None and around.is_rapid else 1
        self.drawn, self.dialect, self.modes = drawn, dialect, dialect.modes
        self.plane, self.unit = state.plane, state.unit
        self.lexicon = dialect.modes.words(state)
        numbers = self.lexicon.numbers
        step = numbers.inch if self.unit is Length.INCH else numbers.mm
        decimals = -int(step.normalize().as_tuple().exponent)
        has_point = numbers.without_point is WithoutPoint.LEAST_INCREMENTS
        radius = self.modes.radius
        self.formats = [Format(self.plane, self.unit, decimals, has_point, arcs, radius=radius) for arcs in Arcs]
        rows = self.lexicon.addresses.values()
        self.steps = {row.axis: row.address for row in rows if row.is_increment and row.axis}
        if around is not None:
            self.formats, self.steps = [around.form], {}

    def word(self, address: str, value: float, axis: int | None = None, text: str = "") -> WrittenWord:
        """The word for a value, mm (radius) or degrees: a coordinate along an axis, a length or an angle. Of a text
        that states it, only on what that rests."""
        row = self.lexicon.addresses[address]
        own = self.drawn.number(value, axis, row.unit)
        text = text or write_word(address, value if own is None else float(own), self.lexicon, self.unit)
        number = Decimal(number_of(text, address) or 0)
        if row.unit is not Unit.DEGREE:
            number *= self.unit.in_mm / (2 if row.is_diameter else 1)
        off = abs(float(number) - (value if own is None else float(own)))
        ground = NumberGround.COMPUTED if off > EXACT else NumberGround.ROUND if own is None else NumberGround.DRAWING
        is_turned = row.unit is Unit.DEGREE and ground is NumberGround.COMPUTED
        is_indirect = is_turned or bool(row.axis and row.is_increment)
        return WrittenWord(text, ground, off if off > EXACT else 0.0, row.unit, is_indirect)

    def at(self, index: int, *, is_cut: bool, is_plain: bool = False) -> Iterator[Wording]:
        """All wordings of the elements from one on, which begins behind a corner that is cut or at its virtual end; or
        only lines and arcs by their ends."""
        own = tuple(self.plain(index, is_cut=is_cut))
        yield from (each for each in own if each.is_plain or not is_plain)
        yield from () if is_plain else self.special(index, own, is_cut=is_cut)

    def special(self, index: int, _plain: Sequence[Wording], *, is_cut: bool) -> Iterator[Wording]:
        """The wordings that only this kind of control has, beside these plain ones."""
        raise NotImplementedError

    def begin(self, index: int, *, is_cut: bool) -> Point:
        """The place where an element begins."""
        before = self.drawn.elements[index - 1].corner if index else None
        return before.segment.end if is_cut and before else self.drawn.elements[index].segment.start

    def is_last(self, element: DrawnElement) -> bool:
        """Whether nothing follows an element."""
        return element is self.drawn.elements[-1]

    def plain(self, index: int, *, is_cut: bool) -> Iterator[Wording]:
        """Ends, as coordinates or increments; arcs about their centre, or by their radius. A corner is written out, or
        has the control's word."""
        element, begin = self.drawn.elements[index], self.begin(index, is_cut=is_cut)
        for said, end, behind in self.corners(element):
            segment = replace(element.segment, start=begin, end=end)
            # Of an element that its corners use up, nothing is left to be written out.
            for moves in self.moves(segment) if said or element.cut is not None else ((),):
                own = self.attach(moves, said) if moves else ()
                if own or behind:
                    yield Wording(1, (*own, *behind), bool(behind), writes_corner=bool(behind), is_plain=not said)

    def corners(self, element: DrawnElement) -> Iterator[tuple[WrittenWord | None, Point, tuple[WrittenBlock, ...]]]:
        """The ways to make the corner behind an element: its word, where the element ends then, and the blocks behind
        it, if it has no word."""
        corner = element.corner
        if corner is None:
            yield None, element.segment.end, ()
            return
        yield from ((word, element.segment.end, ()) for word in self.corner_words(element))
        yield from ((None, corner.segment.start, blocks) for blocks in self.moves(corner.segment))

    def attach(self, moves: tuple[WrittenBlock, ...], corner: WrittenWord | None) -> tuple[WrittenBlock, ...]:
        """The blocks of an element with the word that makes the corner behind it, if there is one."""
        if corner is None:
            return moves
        return (*moves[:-1], replace(moves[-1], words=(*moves[-1].words, corner)))

    def moves(self, segment: Segment) -> Iterator[tuple[WrittenBlock, ...]]:
        """An element by its end, in each way that the control has."""
        raise NotImplementedError

    def corner_words(self, element: DrawnElement) -> Iterator[WrittenWord]:
        """The words that make the corner behind an element."""
        raise NotImplementedError


class GCodeSpeller(Speller):
    """The words of a control that is programmed in G codes."""

    def moves(self, segment: Segment) -> Iterator[tuple[WrittenBlock, ...]]:
        """An element by its end: as coordinates or as increments, an arc about its centre or by its radius."""
        axes = self.plane.axes
        if isinstance(segment, ArcSegment) or self.around is not None:
            yield from (tuple(self._written_out(segment, form)) for form in self.formats)
            return
        changed = [n for n, (a, b) in enumerate(zip(segment.start, segment.end, strict=True)) if abs(b - a) > EXACT]
        ways = list[list[WrittenWord]]()
        for axis in sorted(changed, key=lambda axis: axes[axis]):
            step, end = self.steps.get(axes[axis]), segment.end[axis]
            words = [self.word(axes[axis], end, axis), *([self.word(step, end - segment.start[axis])] if step else [])]
            ways.append([word for n, word in enumerate(words) if not n or word.ground is not NumberGround.COMPUTED])
        yield from (
            (WrittenBlock(self.line, self.code(self.line), words),) if words else () for words in product(*ways)
        )

    def _written_out(self, segment: Segment, form: Format) -> Iterator[WrittenBlock]:
        """Plain moves, rounded so that an arc stays one; increments count from where rounding has led before."""
        here = _rounded(segment.start, form) if form.is_incremental else segment.start
        for move in emit(segment, here, form, is_rapid=not self.line):
            words = list[WrittenWord]()
            for text in move.words:
                address = next(a for a in (*self.plane.axes, *self.plane.centers, form.radius) if text.startswith(a))
                if address in self.plane.axes:
                    axis = self.plane.axes.index(address)
                    end = _near(segment.end[axis], move.end[axis])
                    word = self.word(address, end - here[axis] * form.is_incremental, axis, text)
                elif isinstance(segment, ArcSegment):
                    axis = self.plane.centers.index(address) if address in self.plane.centers else -1
                    value = segment.radius if axis < 0 else segment.center[axis] - here[axis]
                    word = self.word(address, value, None, text)
                words.append(word)
            here = move.end
            if words:
                yield WrittenBlock(move.code, self.code(move.code), tuple(words))

    def code(self, motion: int) -> str:
        """The code of a motion."""
        return self.modes.codes[motion].text


def _rounded(place: Point, form: Format) -> Point:
    first, second = (
        float(form.number(at / form.mm * n)) * form.mm / n for at, n in zip(place, form.scales, strict=True)
    )
    return first, second


def _near(exact: float, rounded: float) -> float:
    """An exact coordinate, or a point on the way that was chosen where it was rounded."""
    return exact if abs(exact - rounded) < _STEP else rounded


_STEP = 0.002
"""mm. A coordinate is rounded by less."""


def values_of(
    form: ContourForm, places: Mapping[str, Point], radii: Mapping[str, float]
) -> dict[str, tuple[float, int | None]]:
    """The value of each word whose fact is about known points, mm (radius) or degrees, and its axis if it is a
    coordinate."""
    scalars = {scalar(name, axis): at for name, place in places.items() for axis, at in enumerate(place)} | dict(radii)
    known, found = Values(scalars, {}, {}), dict[str, tuple[float, int | None]]()
    for fact in (row.fact for row in form.outline.facts if row.fact.given):
        with suppress(KeyError):
            value, placed = fact.implied(known), fact.placed
            if value is not None and fact.given not in found:
                found[fact.given] = value, placed.axis if placed is not None and not placed.origin else None
    return found
