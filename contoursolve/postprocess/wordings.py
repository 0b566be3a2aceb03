"""The words with which a control can say elements of a drawn contour: every set that its own tables allow."""

from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from enum import Enum
from functools import lru_cache
from itertools import pairwise, product

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls import ChainFinder, Element, Joining, Language, compose, names_of
from contoursolve.diagnosis import legal_samples, write_word
from contoursolve.gcode import number_of, spell
from contoursolve.geometry import Length, Line, Unit
from contoursolve.postprocess.drawn_contour import (
    EXACT,
    DrawnContour,
    DrawnElement,
    begins_smoothly,
    size_as,
    value_of,
)
from contoursolve.postprocess.emit import Format, emit
from contoursolve.postprocess.post_processors import Arcs
from contoursolve.reading import ContourForm, Dialect, State, WithoutPoint, check, stated_sets
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment


REFERENCE = "@"
"""Stands on both sides of the place of an element, for the number of its block."""


class Rest(Enum):
    """The ground on which the number of a word rests."""

    DRAWING = "the drawing's own number"
    ROUND = "a number with the control's decimals"
    COMPUTED = "computed and rounded"
    NONE = "no number"


class WrittenWord(Struct, frozen=True):
    """A word, on what it rests, and by how much rounding puts it off, mm or degrees."""

    text: str
    rest: Rest = Rest.NONE
    off: float = 0.0
    is_step: bool = False
    """Whether it is an increment along an axis."""


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


class Speller:
    """The words of a control for numbers of a contour; `state` is that behind its opening."""

    def __init__(self, drawn: DrawnContour, dialect: Dialect, state: State) -> None:
        self.drawn, self.dialect, self.modes = drawn, dialect, dialect.modes
        self.plane, self.unit = state.plane, state.unit
        self.lexicon = dialect.modes.words(state)
        numbers = self.lexicon.numbers
        step = numbers.inch if self.unit is Length.INCH else numbers.mm
        decimals = -int(step.normalize().as_tuple().exponent)
        has_point = numbers.without_point is WithoutPoint.LEAST_INCREMENTS
        self.formats = [
            Format(self.plane, self.unit, decimals, has_point, arcs, radius=self.modes.radius) for arcs in Arcs
        ]
        rows = self.lexicon.addresses.values()
        self.steps = {row.axis: row.address for row in rows if row.is_increment and row.axis}

    def word(self, address: str, value: float, axis: int | None = None, text: str = "") -> WrittenWord:
        """The word for a value, mm (radius) or degrees: a coordinate along an axis, a length or an angle; or what a text
        that states it rests on."""
        row = self.lexicon.addresses[address]
        own = self.drawn.numbers.find(value, axis, row.unit)
        text = text or write_word(address, value if own is None else float(own), self.lexicon, self.unit)
        number = Decimal(number_of(text, address) or 0)
        if row.unit is not Unit.DEGREE:
            number *= self.unit.in_mm / (2 if row.is_diameter else 1)
        off = abs(float(number) - (value if own is None else float(own)))
        rest = Rest.COMPUTED if off > EXACT else Rest.ROUND if own is None else Rest.DRAWING
        return WrittenWord(text, rest, off if off > EXACT else 0.0, bool(row.axis and row.is_increment))

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
            for moves in self.moves(segment):
                own = self.attach(moves, said) if moves else ()
                if own or behind:
                    yield Wording(1, (*own, *behind), bool(behind), writes_corner=bool(behind), is_plain=not said)

    def corners(
        self, element: DrawnElement
    ) -> Iterator[tuple[WrittenWord | None, Point, tuple[WrittenBlock, ...]]]:
        """The ways to make the corner behind an element: its word, where the element ends then, and the blocks behind it,
        if it has no word."""
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


class Wordings(Speller):
    """The words of a control with G codes for elements of a contour."""

    def __init__(self, drawn: DrawnContour, dialect: Dialect, state: State) -> None:
        super().__init__(drawn, dialect, state)
        self.language = dialect.find.language if isinstance(dialect.find, ChainFinder) else None
        self.uses = () if self.language else _uses(dialect)

    def at(self, index: int, *, is_cut: bool, is_plain: bool = False) -> Iterator[Wording]:
        """All wordings of the elements from one on, which begins behind a corner that is cut or at its virtual end; or
        only lines and arcs by their ends."""
        own = self.plain(index, is_cut=is_cut)
        yield from (each for each in own if each.is_plain or not is_plain)
        if is_plain:
            return
        if self.language is not None:
            yield from self._of_language(self.language, index, is_cut=is_cut)
        for form, names in self.uses:
            yield from self._of_form(form, names, index, is_cut=is_cut)

    # Lines and arcs by their ends

    def corner_words(self, element: DrawnElement) -> Iterator[WrittenWord]:
        has_words = self.language is not None and not self.is_last(element)
        for address, shape in (self.language.corner.words if self.language and has_words else {}).items():
            size = size_as(shape, element)
            if size is not None:
                yield self.word(self.language.address_of(address) if self.language else address, size)

    def moves(self, segment: Segment) -> Iterator[tuple[WrittenBlock, ...]]:
        """An element by its end: as coordinates or as increments, an arc about its centre or by its radius."""
        axes = self.plane.axes
        if isinstance(segment, ArcSegment):
            yield from (tuple(self._written_out(segment, form)) for form in self.formats)
            return
        changed = [n for n, (a, b) in enumerate(zip(segment.start, segment.end, strict=True)) if abs(b - a) > EXACT]
        ways = list[list[WrittenWord]]()
        for axis in sorted(changed, key=lambda axis: axes[axis]):
            step, end = self.steps.get(axes[axis]), segment.end[axis]
            words = [self.word(axes[axis], end, axis), *([self.word(step, end - segment.start[axis])] if step else [])]
            ways.append([word for n, word in enumerate(words) if not n or word.rest is not Rest.COMPUTED])
        yield from ((WrittenBlock(1, self._code(1), words),) if words else () for words in product(*ways))

    def _written_out(self, arc: ArcSegment, form: Format) -> Iterator[WrittenBlock]:
        """Plain moves, rounded so that an arc stays one."""
        here = arc.start
        for move in emit(arc, here, form):
            words = list[WrittenWord]()
            for text in move.words:
                address = next(a for a in (*self.plane.axes, *self.plane.centers, form.radius) if text.startswith(a))
                if address in self.plane.axes:
                    axis = self.plane.axes.index(address)
                    words.append(self.word(address, _near(arc.end[axis], move.end[axis]), axis, text))
                else:
                    axis = self.plane.centers.index(address) if address in self.plane.centers else None
                    value = arc.radius if axis is None else arc.center[axis] - here[axis]
                    words.append(self.word(address, value, None, text))
            here = move.end
            if words:
                yield WrittenBlock(move.code, self._code(move.code), tuple(words))

    def _code(self, motion: int) -> str:
        return self.modes.codes[motion].text

    # Lines and arcs in a row

    def _of_language(self, language: Language, index: int, *, is_cut: bool) -> Iterator[Wording]:
        for kinds in self._kinds(language, index):
            yield from self._of_kinds(language, kinds, index, is_cut=is_cut)

    def _kinds(self, language: Language, index: int) -> Iterator[tuple[Element, ...]]:
        """The kinds of the elements from one on: each by itself, or several that meet in computed intersections."""
        elements = self.drawn.elements[index:]
        yield (Element(_turn(elements[0])),)
        is_arc = isinstance(elements[0].segment, ArcSegment)
        if is_arc and language.arc.tangent is not None and index and begins_smoothly(
            self.drawn.elements[index - 1], elements[0]
        ):
            yield (Element(_turn(elements[0]), is_smooth=True),)
        pairs = {
            (one.turn is None, other.turn is None, other.touches)
            for kinds in language.samples
            for one, other in pairwise(kinds)
            if other.is_over
        }
        is_chained = any(each.is_over and each.is_followed for kinds in language.samples for each in kinds)
        for count in range(2, min(len(elements), _LONGEST if is_chained else 2) + 1):
            row = elements[:count]
            for touches in product((False, True), repeat=count - 1):
                joints = zip(pairwise(row), touches, strict=True)
                if all(
                    (*(isinstance(each.segment, LineSegment) for each in pair), does) in pairs
                    and (not does or begins_smoothly(*pair))
                    for pair, does in joints
                ):
                    yield tuple(
                        Element(_turn(each), n > 0, n < count - 1, n > 0 and touches[n - 1])
                        for n, each in enumerate(row)
                    )

    def _of_kinds(
        self, language: Language, kinds: tuple[Element, ...], index: int, *, is_cut: bool
    ) -> Iterator[Wording]:
        row = self.drawn.elements[index : index + len(kinds)]
        form, names = compose(language, kinds, self.modes), names_of(kinds)
        is_open = len(kinds) > 1
        for corners in product(*(self.corners(each) for each in row)):
            if any(behind for *_, behind in corners[:-1]):
                continue
            places, radii = {names[0].tail: self.begin(index, is_cut=is_cut)}, dict[str, float]()
            for each, named, (_, end, _) in zip(row, names, corners, strict=True):
                places[named.head] = end
                if isinstance(each.segment, ArcSegment):
                    places[named.center], radii[named.radius] = each.segment.center, each.segment.radius
            facts, behind = _values(form, places, radii), corners[-1][2]
            blocks = [
                [
                    WrittenBlock(motion, self._code(motion), (*words, *((said,) if said else ())))
                    for given in form.table.combinations[number]
                    for words in self._said(language, given, facts, each, kind)
                ]
                for number, (each, kind, (said, *_)) in enumerate(zip(row, kinds, corners, strict=True))
                for motion in (_motion(language, kind),)
            ]
            for found in product(*blocks):
                needs_side = is_open and language.meeting.joining is Joining.OVER_DEFINED
                yield Wording(len(kinds), (*found, *behind), bool(behind), needs_side, writes_corner=bool(behind))

    def _said(
        self,
        language: Language,
        given: tuple[str, ...],
        facts: Mapping[str, tuple[float, int | None]],
        element: DrawnElement,
        kind: Element,
    ) -> Iterator[tuple[WrittenWord, ...]]:
        """The words of a set of givens; none if it has one that tells nothing of the element, or no number of its own
        where another set has."""
        words, addresses = list[WrittenWord](), self._addresses(language)
        is_arc = kind.turn is not None
        for name in given:
            call = name.partition(":")[2]
            if call == "turn":
                continue
            if call not in addresses or name not in facts:
                return
            value, axis = facts[name]
            if call == "R" and isinstance(element.segment, ArcSegment) and element.segment.sweep > _HALF_TURN:
                value = -value
            words.append(self.word(addresses[call], value, axis))
        is_angled = any(name.partition(":")[2] == language.angle.address for name in given)
        is_plain = not (kind.is_over or kind.is_followed)
        if is_plain and not is_arc and (len(given) == 1 or not is_angled):
            # An angle alone says no line, and ends alone are written elsewhere.
            return
        if any(word.rest is Rest.COMPUTED for word in words) and (
            (is_arc and "R" not in {name.partition(":")[2] for name in given} and not kind.is_smooth)
            or any(name.endswith("-step") for name in given)
        ):
            return
        words.sort(key=lambda word: _ORDER.get(word.text[:1], 9))
        meeting = language.meeting
        choices: tuple[str, ...] = ("",)
        if meeting.selector and kind.is_over:
            choices = ("", f"{meeting.selector}-1", f"{meeting.selector}1")
        elif meeting.picks and (kind.is_over or kind.is_followed) and not kind.touches:
            choices = ("", f"{meeting.picks}1")
        for choice in choices:
            yield (*words, *((WrittenWord(choice),) if choice else ()))

    @lru_cache(maxsize=1)  # noqa: B019 - lives as long as one search
    def _addresses(self, language: Language) -> dict[str, str]:
        """The addresses of what facts of a language are called."""
        first, second = self.plane.axes
        found = {"first": first, "second": second, "R": language.address_of("R")}
        found |= {f"{order}-step": self.steps[axis] for order, axis in (("first", first), ("second", second)) if axis in self.steps}
        found |= dict(zip(("center-first", "center-second"), self.plane.centers, strict=True))
        found |= {name: address for address, name in language.arc.centers_at(self.plane).items()}
        angle = language.address_of(language.angle.address)
        return found | ({language.angle.address: angle} if angle in self.lexicon.addresses else {})

    # Forms of one block

    def _of_form(self, form: ContourForm, names: frozenset[str], index: int, *, is_cut: bool) -> Iterator[Wording]:
        path, outline = form.outline.path, form.outline
        row = self.drawn.elements[index : index + len(path)]
        kinds = [isinstance(each, Line) for each in path]
        if kinds != [isinstance(each.segment, LineSegment) for each in row]:
            return
        code = self._code_of(form, row[-1])
        if code is None:
            return
        places, radii = {path[0].tail: self.begin(index, is_cut=is_cut)}, dict[str, float]()
        for each, drawn in zip(path, row, strict=True):
            places[each.head] = drawn.segment.end
            if not isinstance(each, Line) and isinstance(drawn.segment, ArcSegment):
                places[each.center], radii[each.radius] = drawn.segment.center, drawn.segment.radius
        behind, written_out = row[-1].corner, list[WrittenBlock]()
        rows = {each.before: each for each in outline.corners}
        sizes = list[list[tuple[WrittenWord, ...]]]()
        for each, drawn in zip(path, row, strict=True):
            words = [
                (self.word(name, size),) if name in self.lexicon.addresses else ()
                for name, shape in (rows[each.name].shapes if each.name in rows else {}).items()
                for size in (size_as(shape, drawn),)
                if size is not None
            ]
            if drawn.corner is not None and not words:
                if drawn is not row[-1]:
                    return
                places[each.head] = drawn.corner.segment.start
                written_out, behind, words = [*next(self.moves(drawn.corner.segment))], None, [()]
            sizes.append(words or [()])
        for line in outline.lines:
            if line.head not in places and behind is not None:
                places[line.head] = behind.segment.end
            places.setdefault(line.tail, places.get(line.head, places[path[0].tail]))
        values = _values(form, places, radii)
        if not names <= values.keys():
            return
        own = [self.word(name, *values[name]) for name in sorted(names)]
        if any(word.rest is Rest.COMPUTED for word in own) and any(not each for each in kinds) and len(path) == 1:
            return
        for corners in product(*sizes):
            words = (*own, *(word for each in corners for word in each))
            if check(self.dialect.rules, form.roles, {word.text[:1]: None for word in words}):
                continue
            block = WrittenBlock(code[0], code[1], words)
            is_cut = row[-1].corner is not None
            yield Wording(len(path), (block, *written_out), is_cut, writes_corner=bool(written_out))

    def _code_of(self, form: ContourForm, last: DrawnElement) -> tuple[int | None, str] | None:
        """The motion that the code of a form leaves in force, and the code; None for an arc that turns the other way."""
        number = int(form.name.removeprefix("G"))
        if number in _ARCS:
            return (number, self._code(number)) if _turn(last) is form.outline.path[0].turn else None
        return (number if number in _MODAL else None), form.name


_ARCS, _MODAL = (2, 3), (1, 11, 12)
_LONGEST = 4
"""Elements that are tried at once in a chain of computed intersections."""
_HALF_TURN = 180.0
_ORDER = {letter: place for place, letter in enumerate("XYZUVW,AIJKR")}


def _near(exact: float, rounded: float) -> float:
    """An exact coordinate, or a point on the way that was chosen where it was rounded."""
    return exact if abs(exact - rounded) < _STEP else rounded


_STEP = 0.002
"""mm. A coordinate is rounded by less."""


def _turn(element: DrawnElement):
    return element.segment.turn if isinstance(element.segment, ArcSegment) else None


def _motion(language: Language, kind: Element) -> int:
    if kind.is_smooth and language.arc.tangent is not None:
        return language.arc.tangent
    return 1 if kind.turn is None else 3 if kind.turn.sign > 0 else 2


def _values(
    form: ContourForm, places: Mapping[str, Point], radii: Mapping[str, float]
) -> dict[str, tuple[float, int | None]]:
    """The value of each word whose fact is about known points, and its axis if it is a coordinate."""
    found = dict[str, tuple[float, int | None]]()
    for fact in (row.fact for row in form.outline.facts):
        value = value_of(fact, places, radii) if fact.given and fact.given not in found else None
        if value is not None:
            placed = fact.placed
            found[fact.given] = value, placed.axis if placed is not None and not placed.origin else None
    return found


_USES: dict[tuple[ContourForm, ...], tuple[tuple[ContourForm, frozenset[str]], ...]] = {}


def _uses(dialect: Dialect) -> tuple[tuple[ContourForm, frozenset[str]], ...]:
    """The sets of words by which each form of a control may be stated, but for those of corners."""
    if dialect.forms not in _USES:
        _USES[dialect.forms] = tuple(dict.fromkeys(_sets(dialect)))
    return _USES[dialect.forms]


def _sets(dialect: Dialect) -> Iterator[tuple[ContourForm, frozenset[str]]]:
    for form in dialect.forms:
        if form.table.sample is not None:
            sets: Sequence[frozenset[str]] = [frozenset(row.addresses) for row, _ in legal_samples(form, dialect)]
        else:
            sets = [each for each in stated_sets(form) if not check(dialect.rules, form.roles, dict.fromkeys(each))]
        yield from ((form, each.difference(form.outline.shapes)) for each in sets)
