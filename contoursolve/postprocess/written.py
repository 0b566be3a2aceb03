"""A contour in the words of a control: the wordings that its rules allow, read back and proven, the best first."""

from collections.abc import Iterator, Mapping, Sequence
from heapq import heappop, heappush
from itertools import accumulate, count, islice
from typing import NamedTuple

from msgspec import Struct

from contoursolve.diagnosis import Answer
from contoursolve.postprocess.chain_wordings import ChainWordings, language_of
from contoursolve.postprocess.contour_drawing import ContourDrawing, DrawnElement, draw, with_roundings
from contoursolve.postprocess.emit import Format, MotionBlock
from contoursolve.postprocess.expansion_report import ConversionError
from contoursolve.postprocess.form_wordings import FormWordings
from contoursolve.postprocess.klartext_wordings import KlartextWordings
from contoursolve.postprocess.post_processors import MachineKind, machine_of
from contoursolve.postprocess.small_program import ReadBack, SmallProgram, says_unit
from contoursolve.postprocess.wordings import (
    HostProgram,
    NumberGround,
    Speller,
    Wording,
    WrittenBlock,
    WrittenWord,
    said,
)
from contoursolve.program import for_kind
from contoursolve.reading import Control
from contoursolve.solving import Point

MOST_CANDIDATES = 8
"""Candidates that are listed."""

MOST_READ = 60
"""Candidates that are read back."""

_SHORT = 12
"""Elements of a contour for which that holds; of a longer one, fewer candidates are listed and read back."""


class Cost(NamedTuple):
    """The cost of some blocks: less of what comes first is better."""

    computed: int = 0
    """Computed numbers."""
    words: int = 0
    """Words, with their codes."""
    blocks: int = 0
    indirect: int = 0
    """Increments, rounded angles, and elements that others end: each is farther from where its element ends."""
    round: int = 0
    """Numbers that are not of the drawing."""

    def plus(self, other: "Cost") -> "Cost":
        """The cost of both."""
        return Cost(*map(sum, zip(self, other, strict=True)))


class WrittenContour(Struct, frozen=True):
    """One way to say the contour: its blocks, and a whole small program with them.

    It was read back as the control reads it, without a finding. It is the same contour to within `deviation` mm.
    """

    blocks: tuple[WrittenBlock, ...]
    lines: tuple[str, ...]
    """The blocks as they stand in the program."""
    program: str
    deviation: float
    cost: Cost
    written_out: tuple[str, ...] = ()
    """The corners that the control has no word for, which are blocks of their own."""
    is_plain: bool = False
    """Whether all its blocks are lines and arcs by their ends."""

    def words(self, ground: NumberGround) -> tuple[WrittenWord, ...]:
        """The words whose numbers depend on something."""
        return tuple(word for block in self.blocks for word in block.words if word.ground is ground)


class WrittenContours(Struct, frozen=True):
    """A contour in the words of a control: the candidates, the best first. `reason` says what the control has no words
    for, or why it cannot make the contour at all."""

    control: str
    title: str
    candidates: tuple[WrittenContour, ...]
    reason: str = ""


def write_contour(answer: Answer, target: Control, *, most: int = MOST_CANDIDATES) -> WrittenContours:
    """The wordings of a solved contour for a control. Raises ConversionError if it has no path, or one of no length."""
    drawn = draw(answer)
    if not drawn.elements:
        raise ConversionError("the contour has no length, so that it has no words")
    kind = MachineKind.LATHE if {*drawn.plane.axes} == {"X", "Z"} else MachineKind.MILL
    target = for_kind(target, {}, kind.value)
    if machine_of(target) is not kind:
        made = {MachineKind.LATHE: "turned", MachineKind.MILL: "milled"}[kind]
        reason = f"the contour is {made}, and this control is for {machine_of(target).value}s"
        return WrittenContours(target.name, target.title, (), reason)
    if not says_unit(target, drawn.unit):
        reason = "the contour is in inch, and no word of this control says so: write it in mm"
        return WrittenContours(target.name, target.title, (), reason)
    rounded, found = with_roundings(drawn), list[WrittenContour]()
    search = _Search([drawn] if rounded == drawn else [drawn, rounded], target, answer)
    share = min(1.0, _SHORT / len(drawn.elements))
    for read, way in enumerate(search.ways(), 1):
        found += [way.written] if way else []
        if len(found) >= max(most * share, 1) or read >= MOST_READ * max(share, 1 / MOST_CANDIDATES):
            break
    if not any(each.is_plain for each in found):
        plain = _Search([drawn], target, answer, is_plain=True).first()
        found += [plain.written] if plain else []
    found.sort(key=lambda each: (each.cost, each.lines))
    return WrittenContours(target.name, target.title, tuple(found), _reason(found, search))


def _reason(found: Sequence[WrittenContour], search: "_Search") -> str:
    """That the control has no words, or why its first candidate has no words of this control alone, though some
    numbers are computed."""
    if not found:
        return "this control accepts no blocks for this contour, not even plain ones"
    best, others = found[0], sum(not each.is_plain for each in found)
    if best.written_out:
        return f"this control has no word for {' and '.join(best.written_out)}: a block of its own makes it"
    if not (best.is_plain and best.cost.computed):
        return ""
    if others:
        ways = "1 further way has" if others == 1 else f"{others} further ways have"
        return f"plain lines and arcs are the shortest; {ways} the control's own words"
    if search.refused:
        return f"these are plain lines and arcs: the control refuses its own words for this contour ({search.refused})"
    if any(not each.is_plain for several in search.kinds.values() for each in several):
        return "plain lines and arcs are the shortest"
    return "these are plain lines and arcs: the control has no other words for this contour"


Moves = Mapping[str, tuple[MotionBlock, ...]]
"""The moves for each element of a contour, by its name."""


def translate(answer: Answer, target: Control, here: Point, form: Format, *, is_rapid: bool) -> Moves | None:
    """The moves of a solved contour in the words of a target that writes lines and arcs in a row, in a program where
    the tool is really `here`; None if the target refuses it, has no words for any of it, or it has no length."""
    if language_of(target) is None or answer.contour is None:
        return None
    side, drawn = {41: "G41", 42: "G42"}.get(answer.claim.before.compensation, "G40"), draw(answer)
    way = _Search([drawn], target, answer, HostProgram(here, form, is_rapid, side)).first() if drawn.elements else None
    if way is None or way.written.is_plain:
        return None
    found = dict[str, tuple[MotionBlock, ...]]()
    for choice in way.choices:
        row, blocks = choice.elements, choice.wording.blocks
        for place, element in enumerate(row, 1):
            own = blocks[place - 1 : place if place < len(row) else None]
            end = way.end if element is drawn.elements[-1] else element.segment.end
            found[element.segment.name] = tuple(
                MotionBlock(each.motion or 0, tuple(word.text for word in each.words), end, way.written.deviation)
                for each in own
            )
    return found


class _Place(NamedTuple):
    """A place on the way through the elements of a drawing: the next one, and whether it begins behind a cut corner."""

    drawing: int
    element: int
    is_cut: bool = False


class _Choice(NamedTuple):
    """A wording at its place, and the elements that it says."""

    place: _Place
    wording: Wording
    elements: Sequence[DrawnElement]


class _Way(NamedTuple):
    """A wording of the whole contour that is proven, what it is made of, and where it ends."""

    written: WrittenContour
    choices: tuple[_Choice, ...]
    end: Point


class _Search:
    """The wordings of a whole contour in one of several drawings of it, those first that cost less."""

    def __init__(
        self,
        drawings: Sequence[ContourDrawing],
        target: Control,
        answer: Answer,
        around: HostProgram | None = None,
        *,
        is_plain: bool = False,
    ) -> None:
        self.is_plain, self.around, self.drawn = is_plain, around, drawings[0]
        self.program = SmallProgram(target, self.drawn, around)
        state, language = self.program.state(self.drawn.unit), language_of(target)
        self.spellers = list[Speller]()
        for drawn in drawings:
            if target.writing is not None:
                self.spellers.append(KlartextWordings(drawn, target, state, answer, self.program))
            elif language is not None:
                self.spellers.append(ChainWordings(drawn, target, state, language, around))
            else:
                self.spellers.append(FormWordings(drawn, target, state))
        self.start = self.spellers[0].place(self.drawn.start)
        self.refused = ""
        """The reason why the first program in the control's own words was refused."""
        self.banned = set[tuple[_Place, Wording]]()
        self.options = dict[_Place, list[Wording]]()
        self.kinds = dict[_Place, list[Wording]]()

    def first(self) -> _Way | None:
        """The first way that is proven."""
        return next(filter(None, islice(self.ways(), MOST_READ)), None)

    def ways(self) -> Iterator[_Way | None]:
        """All ways in their order, each read back: None for one that is not the same contour. What is to blame for that
        is left out from then on."""
        tried, ways = set[tuple[str, ...]](), self._in_order()
        while way := next((each for each in ways if each[1] not in tried), None):
            cost, lines, choices = way
            tried.add(lines)
            blocks = tuple(block for each in choices for block in each.wording.blocks)
            is_plain = all(each.wording.is_plain for each in choices)
            is_exact = not cost.computed and all(word.ground is not NumberGround.COMPUTED for word in self.start)
            needs_side = any(each.wording.needs_side for each in choices)
            start = [word.text for word in self.start]
            found = self.program.read(self.drawn, start, blocks, is_exact=is_exact, needs_side=needs_side)
            if found.deviation is None:
                self.refused = self.refused or found.reason * (not is_plain)
                ways = self._in_order() if self._ban(choices, found) else ways
                yield None
                continue
            cut = [each.elements[-1].corner for each in choices if each.wording.writes_corner]
            names = tuple(corner.segment.name for corner in cut if corner)
            written = WrittenContour(blocks, found.lines, found.text, found.deviation, cost, names, is_plain)
            yield _Way(written, choices, found.end)

    def _ban(self, choices: Sequence[_Choice], found: ReadBack) -> bool:
        """Leave out the wording that is to blame. With a finding about a corner word, that is every wording with this
        word; with one about a plain block, it is about the corner word before it, whatever else stands there."""
        ends = accumulate(len(each.wording.blocks) for each in choices)
        number = next((n for n, end in enumerate(ends) if found.block < end), len(choices) - 1)
        blamed, before = choices[number], choices[max(number - 1, 0)]
        has_word = before.elements[-1].corner is not None and not before.wording.writes_corner
        is_before = bool(number and found.word and blamed.wording.is_plain and has_word)
        blamed = before if is_before else blamed
        several, last = self._allowed(blamed.place), [*blamed.wording.words][-1:]
        is_corner = [word.text for word in last] == [found.word] and blamed.elements[0].corner is not None
        is_same = is_before or is_corner
        out = [each for each in several if ([*each.words][-1:] == last if is_same else each == blamed.wording)]
        if len(several) > 1:
            self.banned.update((blamed.place, each) for each in out)
            self.kinds.pop(blamed.place, None)
        return len(several) > 1

    def _allowed(self, place: _Place) -> list[Wording]:
        if place not in self.options:
            speller = self.spellers[place.drawing]
            self.options[place] = [*speller.at(place.element, is_cut=place.is_cut, is_plain=self.is_plain)]
        found = [each for each in self.options[place] if (place, each) not in self.banned]
        # A corner that has a word is written out where its word is refused, and not beside that.
        said = {each.count for each in found if not each.writes_corner}
        return [each for each in found if not each.writes_corner or each.count not in said]

    def _at(self, place: _Place) -> list[Wording]:
        """The best wording of each kind, but for those that say more words than another one. Ends and increments are
        the same kind, in whatever order the words stand."""
        if place not in self.kinds:
            speller, kinds = self.spellers[place.drawing], dict[tuple[object, frozenset[object]], Wording]()
            for each in sorted(self._allowed(place), key=_cost):
                kinds.setdefault(_kind(each, speller), each)
            self.kinds[place] = [
                each
                for (shape, words), each in kinds.items()
                if not any(shape == other and fewer < words for other, fewer in kinds)
            ]
        return self.kinds[place]

    def _rest(self) -> dict[tuple[_Place, int | None], Cost]:
        """The least cost from each place on, by the motion that is in force there."""
        rest = dict[tuple[_Place, int | None], Cost]()
        for drawing, speller in enumerate(self.spellers):
            last = len(speller.drawn.elements)
            places = [_Place(drawing, index, is_cut) for index in range(last) for is_cut in (False, True)]
            blocks = (block for place in places for each in self._at(place) for block in each.blocks)
            motions = {0, *(block.motion for block in blocks if block.motion is not None)}
            rest |= {(_Place(drawing, last, is_cut), n): Cost() for is_cut in (False, True) for n in motions}
            for place in reversed(places):
                for motion in motions:
                    steps = (_step(place, motion, each) for each in self._at(place))
                    costs = [step.plus(rest[there]) for step, there, _ in steps if there in rest]
                    rest |= {(place, motion): min(costs)} if costs else {}
        return rest

    def _in_order(self) -> Iterator[tuple[Cost, tuple[str, ...], tuple[_Choice, ...]]]:
        """Every wording of the whole contour: its cost, its lines, and what it is made of."""
        rest, number = self._rest(), count()
        begins = [(_Place(drawing, 0), 0) for drawing in range(len(self.spellers))]
        heap: list[tuple[Cost, tuple[str, ...], int, Cost, tuple[_Place, int | None], tuple[_Choice, ...]]] = []
        heap += sorted((rest[begin], (), next(number), Cost(), begin, ()) for begin in begins if begin in rest)
        while heap:
            whole, lines, _, spent, (place, motion), choices = heappop(heap)
            elements = self.spellers[place.drawing].drawn.elements
            if place.element == len(elements):
                yield whole, lines, choices
                continue
            for wording in self._at(place):
                step, there, texts = _step(place, motion, wording)
                if there in rest:
                    cost, row = spent.plus(step), elements[place.element : there[0].element]
                    more = (*lines, *texts), next(number), cost, there, (*choices, _Choice(place, wording, row))
                    heappush(heap, (cost.plus(rest[there]), *more))


def _step(
    place: _Place, motion: int | None, wording: Wording
) -> tuple[Cost, tuple[_Place, int | None], tuple[str, ...]]:
    """The cost of a wording at a place where a motion is in force, the place behind it, and its lines."""
    lines, codes, behind = said(wording.blocks, motion)
    there = _Place(place.drawing, place.element + wording.count, wording.is_cut), behind
    return _cost(wording).plus(Cost(words=codes)), there, lines


def _cost(wording: Wording) -> Cost:
    """The cost of a wording without its codes."""
    words = [*wording.words]
    rests = [word.ground for word in words]
    indirect = sum(word.is_indirect for word in words) + wording.count - 1
    computed, own = rests.count(NumberGround.COMPUTED), rests.count(NumberGround.ROUND)
    return Cost(computed, len(words), len(wording.blocks), indirect, own)


def _kind(wording: Wording, speller: Speller) -> tuple[tuple[object, ...], frozenset[tuple[int, str]]]:
    """The common part of all wordings of a kind: how many elements they say with which codes, and their words with a
    number, coordinates by their axes."""
    shape: list[object]
    shape, found = [wording.count, wording.is_cut, wording.writes_corner], set[tuple[int, str]]()
    for number, block in enumerate(wording.blocks):
        shape.append(block.code)
        for word in block.words:
            row = speller.lexicon.addresses.get(speller.address_in(word.text))
            if word.ground is NumberGround.NONE:
                shape.append(word.text)
            else:
                found.add((number, row.axis if row and row.axis in speller.plane.axes else word.text))
    return tuple(shape), frozenset(found)
