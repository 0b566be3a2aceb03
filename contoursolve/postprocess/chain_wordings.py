"""The words of a control whose blocks are lines and arcs in a row: every set that the tables of its language have."""

from collections.abc import Collection, Iterator, Mapping
from itertools import pairwise, product

from msgspec.structs import replace

from contoursolve.controls import ChainFinder, Element, Joining, Language, compose, names_of
from contoursolve.gcode import PLAIN
from contoursolve.geometry import Turn
from contoursolve.postprocess.contour_drawing import ContourDrawing, DrawnElement, begins_smoothly
from contoursolve.postprocess.wordings import (
    GCodeSpeller,
    HostProgram,
    NumberGround,
    Values,
    Wording,
    WrittenBlock,
    WrittenWord,
    changed_axes,
)
from contoursolve.reading import Control, State
from contoursolve.solving import ArcSegment, Segment


def language_of(target: Control) -> Language | None:
    """The language of a target that writes lines and arcs in a row; None for another target."""
    return target.find.language if isinstance(target.find, ChainFinder) else None


_LONGEST = 4
"""Elements that are tried at once in a chain of computed intersections."""
_HALF_TURN = 180.0
_ORDER = {letter: place for place, letter in enumerate("XYZUVW,AIJKR")}


class ChainWordings(GCodeSpeller):
    """The words of a language for elements of a contour."""

    def __init__(
        self, drawn: ContourDrawing, control: Control, state: State, language: Language, around: HostProgram | None
    ) -> None:
        super().__init__(drawn, control, state, around)
        self.language = language
        self.addresses = self._addresses()
        rows = ((1, language.corner.words), (-1, language.corner.negative))
        self.corner_rows = [
            (language.address_of(name), sign, shape) for sign, words in rows for name, shape in words.items()
        ]
        pairs = [pair for kinds in language.samples for pair in pairwise(kinds) if pair[1].is_over]
        self.pairs = {(one.turn is None, other.turn is None, other.touches) for one, other in pairs}
        """The pairs of elements between which an intersection or a contact is computed: lines or arcs."""
        self.longest = _LONGEST if any(pair[1].is_followed for pair in pairs) else 2

    def special(self, index: int, *, is_cut: bool) -> Iterator[Wording]:
        is_incremental = self.around is not None and self.around.form.is_incremental
        for kinds in self._kinds(index) if not is_incremental else ():
            yield from self._of_kinds(kinds, index, is_cut=is_cut)

    def _kinds(self, index: int) -> Iterator[tuple[Element, ...]]:
        """The kinds of the elements from one on: each by itself, or several that meet in computed intersections."""
        elements = self.drawn.elements[index : index + self.longest]
        turns = [each.segment.turn if isinstance(each.segment, ArcSegment) else None for each in elements]
        has_smooth = self.language.arc.tangent is not None and self.around is None
        if turns[0] is None:
            yield (Element(),)
        elif has_smooth and index and begins_smoothly(self.drawn.elements[index - 1], elements[0]):
            yield (Element(turns[0], is_smooth=True),)
        for count in range(2, len(elements) + 1):
            for touches in product((False, True), repeat=count - 1):
                found = [
                    Element(turn, n > 0, n < count - 1, touches[n - 1] if n else False)
                    for n, turn in enumerate(turns[:count])
                ]
                if all(
                    (one.turn is None, other.turn is None, other.touches) in self.pairs
                    and (not other.touches or begins_smoothly(*pair))
                    for (one, other), pair in zip(pairwise(found), pairwise(elements), strict=False)
                ):
                    yield tuple(found)

    def _of_kinds(self, kinds: tuple[Element, ...], index: int, *, is_cut: bool) -> Iterator[Wording]:
        row, last = self.drawn.elements[index : index + len(kinds)], len(kinds) - 1
        form, names = compose(self.language, kinds, self.modes), names_of(kinds)
        needs_side = last > 0 and self.language.meeting.joining is Joining.OVER_DEFINED
        through = ((named.own, self.drawn.point_on(each)) for each, named in zip(row, names, strict=True))
        points = {name: at for (name, at), named in zip(through, names, strict=True) if at and name != named.head}
        for ways in product(*(self.corners(each) for each in row)):
            if any(way.behind for way in ways[:-1]):
                continue
            facts = self.laid(form, row, self.begin(index, is_cut=is_cut), ways, points)
            blocks = [
                [
                    WrittenBlock(motion, self.code(motion), (*words, *way.words))
                    for given in form.table.combinations[number]
                    for own in self._said(given, facts, each, kind)
                    for words in self._choosing(own, kinds, number)
                ]
                for number, (each, kind, way) in enumerate(zip(row, kinds, ways, strict=True))
                for motion in (self._motion(kind),)
            ]
            for found in product(*blocks):
                yield replace(self.closed(len(kinds), found, replace(ways[-1], words=())), needs_side=needs_side)

    def _said(
        self, given: tuple[str, ...], facts: Values, element: DrawnElement, kind: Element
    ) -> Iterator[tuple[WrittenWord, ...]]:
        """The words of a set of givens; none if it has one that tells nothing of the element, or is rounded where an
        arc or an increment would lead elsewhere."""
        calls = {name: name.partition(":")[2] for name in given if not name.endswith((":turn", ":point"))}
        if not (calls.keys() <= facts.keys() and self.addresses.keys() >= {*calls.values()}):
            return
        segment, is_open = element.segment, kind.is_over or kind.is_followed
        values = {call: facts[name] for name, call in calls.items()}
        is_long = isinstance(segment, ArcSegment) and segment.sweep > _HALF_TURN
        if "R" in values and is_long and not (kind.is_over and self.language.meeting.selector):
            values["R"] = -values["R"][0], None
        words = [self.word(self.addresses[call], *value) for call, value in values.items()]
        is_free = kind.turn is not None and "R" not in values and not kind.is_smooth
        is_delicate = is_free or any(call.endswith("-step") for call in values)
        if is_delicate and any(word.ground is NumberGround.COMPUTED for word in words):
            return
        if is_open or kind.turn is not None or self._says_more(values, facts, segment):
            yield tuple(sorted(words, key=lambda word: _ORDER.get(word.text[:1], 9)))

    def _says_more(self, calls: Collection[str], facts: Values, segment: Segment) -> bool:
        """Whether the words of a line say more than its end does: an angle, and how far it goes."""
        if len(calls) == 1 or self.language.angle.address not in calls:
            return False
        axis = int(any(call.startswith("second") for call in calls))
        ends = [self.word(self.plane.axes[n], *facts[name]) for n, name in enumerate(_ENDS) if name in facts]
        is_exact = all(word.ground is not NumberGround.COMPUTED for word in ends)
        return axis in changed_axes(segment) and not (is_exact and self.around is not None)

    def _choosing(
        self, words: tuple[WrittenWord, ...], kinds: tuple[Element, ...], number: int
    ) -> Iterator[tuple[WrittenWord, ...]]:
        """Words, and with each that may choose one of two intersections."""
        kind, meeting = kinds[number], self.language.meeting
        yield words
        pair = kinds[number - 1 : number + 1] if kind.is_over else ()
        if meeting.selector and any(each.turn is not None for each in pair):
            yield from ((*words, WrittenWord(PLAIN.spell(meeting.selector, sign))) for sign in ("-1", "1"))
        is_crossed = len({each.turn is None for each in kinds}) > 1 and not any(each.touches for each in kinds)
        if meeting.picks and kind.turn is not None and is_crossed:
            yield (*words, WrittenWord(PLAIN.spell(meeting.picks, "1")))

    def _motion(self, kind: Element) -> int:
        if kind.is_smooth and self.language.arc.tangent is not None:
            return self.language.arc.tangent
        return self.line if kind.turn is None else 3 if kind.turn is Turn.CCW else 2

    def _addresses(self) -> Mapping[str, str]:
        """The addresses of what facts of the language are called."""
        language, own = self.language, (*self.plane.axes, *self.plane.centers)
        radius, angle = map(language.address_of, ("R", language.angle.address))
        steps = {
            f"{name}-step": self.steps[axis] for name, axis in zip(_PLACES, own, strict=True) if axis in self.steps
        }
        centers = {name: address for address, name in language.arc.centers_at(self.plane).items()}
        angles = {language.angle.address: angle} if angle in self.lexicon.addresses else {}
        return {"R": radius, **dict(zip(_PLACES, own, strict=True)), **steps, **centers, **angles}


_PLACES = ("first", "second", "center-first", "center-second")
_ENDS = ("1:first", "1:second")
