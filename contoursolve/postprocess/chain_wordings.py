"""The words of a control whose blocks are lines and arcs in a row: every set that the tables of its language have."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise, product

from contoursolve.controls import ChainFinder, Element, Joining, Language, compose, names_of
from contoursolve.gcode import spell
from contoursolve.geometry import Turn
from contoursolve.postprocess.contour_drawing import EXACT, ContourDrawing, DrawnElement, begins_smoothly, size_as
from contoursolve.postprocess.wordings import (
    GCodeSpeller,
    HostProgram,
    NumberGround,
    Wording,
    WrittenBlock,
    WrittenWord,
    values_of,
)
from contoursolve.reading import Dialect, State
from contoursolve.solving import ArcSegment, LineSegment


def language_of(target: Dialect) -> Language | None:
    """The language of a target that writes lines and arcs in a row; None for another target."""
    return target.find.language if isinstance(target.find, ChainFinder) else None


_LONGEST = 4
"""Elements that are tried at once in a chain of computed intersections."""
_HALF_TURN = 180.0
_ENDS = ("1:first", "1:second")


def _call(name: str) -> str:
    """The name of a given without that of its element."""
    return name.partition(":")[2]


_ORDER = {letter: place for place, letter in enumerate("XYZUVW,AIJKR")}


class ChainWordings(GCodeSpeller):
    """The words of a language for elements of a contour."""

    def __init__(
        self,
        drawn: ContourDrawing,
        dialect: Dialect,
        state: State,
        language: Language,
        around: HostProgram | None = None,
    ) -> None:
        super().__init__(drawn, dialect, state, around)
        self.language = language

    def corner_words(self, element: DrawnElement) -> Iterator[WrittenWord]:
        for address, shape in self.language.corner.words.items() if not self.is_last(element) else ():
            size = size_as(shape, element)
            if size is not None:
                yield self.word(self.language.address_of(address), size)

    def special(self, index: int, _plain: Sequence[Wording], *, is_cut: bool) -> Iterator[Wording]:
        is_incremental = self.around is not None and self.around.form.is_incremental
        for kinds in self._kinds(self.language, index) if not is_incremental else ():
            yield from self._of_kinds(self.language, kinds, index, is_cut=is_cut)

    def _kinds(self, language: Language, index: int) -> Iterator[tuple[Element, ...]]:
        """The kinds of the elements from one on: each by itself, or several that meet in computed intersections."""
        elements = self.drawn.elements[index:]
        is_arc = isinstance(elements[0].segment, ArcSegment)
        if not is_arc:
            yield (Element(),)
        if (
            is_arc
            and language.arc.tangent is not None
            and self.around is None
            and index
            and begins_smoothly(self.drawn.elements[index - 1], elements[0])
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
                through = self.drawn.point_on(each) if named.own != named.head else None
                places |= {named.own: through} if through is not None else {}
                places[named.head] = end
                if isinstance(each.segment, ArcSegment):
                    places[named.center], radii[named.radius] = each.segment.center, each.segment.radius
            facts, behind = values_of(form, places, radii), corners[-1][2]
            blocks = [
                [
                    WrittenBlock(motion, self.code(motion), (*words, *((said,) if said else ())))
                    for given in form.table.combinations[number]
                    for own in self._said(language, given, facts, each, kind)
                    for words in self._choosing(language, own, kinds, number)
                ]
                for number, (each, kind, (said, *_)) in enumerate(zip(row, kinds, corners, strict=True))
                for motion in (self._motion(language, kind),)
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
        """The words of a set of givens; none if it has one that tells nothing of the element, or is rounded where an
        arc or an increment would lead elsewhere."""
        words, addresses, calls = list[WrittenWord](), self._addresses(language), [_call(name) for name in given]
        for name, call in zip(given, calls, strict=True):
            if call in ("turn", "point"):
                continue
            if call not in addresses or name not in facts:
                return
            value, axis = facts[name]
            is_long = isinstance(element.segment, ArcSegment) and element.segment.sweep > _HALF_TURN
            if call == "R" and is_long and not (kind.is_over and language.meeting.selector):
                value = -value
            words.append(self.word(addresses[call], value, axis))
        is_open = kind.is_over or kind.is_followed
        is_delicate = (kind.turn is not None and "R" not in calls and not kind.is_smooth) or any(
            call.endswith("-step") for call in calls
        )
        if is_delicate and any(word.ground is NumberGround.COMPUTED for word in words):
            return
        if is_open or kind.turn is not None or self._says_more(language, calls, element, facts):
            yield tuple(sorted(words, key=lambda word: _ORDER.get(word.text[:1], 9)))

    def _says_more(
        self,
        language: Language,
        calls: Sequence[str],
        element: DrawnElement,
        facts: Mapping[str, tuple[float, int | None]],
    ) -> bool:
        """Whether the words of a line say more than its end does: an angle, and how far it goes."""
        if len(calls) == 1 or language.angle.address not in calls:
            return False
        axis = int(any(call.startswith("second") for call in calls))
        is_going = abs(element.segment.end[axis] - element.segment.start[axis]) > EXACT
        ends = [self.word(self.plane.axes[n], *each) for n, name in enumerate(_ENDS) if (each := facts.get(name))]
        is_exact = all(word.ground is not NumberGround.COMPUTED for word in ends)
        return is_going and not (is_exact and self.around is not None)

    def _choosing(
        self, language: Language, words: tuple[WrittenWord, ...], kinds: tuple[Element, ...], number: int
    ) -> Iterator[tuple[WrittenWord, ...]]:
        """Words, and with each that may choose one of two intersections."""
        kind, meeting = kinds[number], language.meeting
        yield words
        pair = kinds[number - 1 : number + 1] if kind.is_over else ()
        if meeting.selector and any(each.turn is not None for each in pair):
            yield from ((*words, WrittenWord(spell(meeting.selector, sign))) for sign in ("-1", "1"))
        is_crossed = len({each.turn is None for each in kinds}) > 1 and not any(each.touches for each in kinds)
        if meeting.picks and kind.turn is not None and is_crossed:
            yield (*words, WrittenWord(spell(meeting.picks, "1")))

    def _motion(self, language: Language, kind: Element) -> int:
        if kind.is_smooth and language.arc.tangent is not None:
            return language.arc.tangent
        return self.line if kind.turn is None else 3 if kind.turn.sign > 0 else 2

    def _addresses(self, language: Language) -> dict[str, str]:
        """The addresses of what facts of a language are called."""
        first, second = self.plane.axes
        found = {"first": first, "second": second, "R": language.address_of("R")}
        found |= {
            f"{order}-step": self.steps[axis]
            for order, axis in (("first", first), ("second", second))
            if axis in self.steps
        }
        found |= dict(zip(("center-first", "center-second"), self.plane.centers, strict=True))
        found |= {name: address for address, name in language.arc.centers_at(self.plane).items()}
        angle = language.address_of(language.angle.address)
        return found | ({language.angle.address: angle} if angle in self.lexicon.addresses else {})


def _turn(element: DrawnElement) -> Turn | None:
    return element.segment.turn if isinstance(element.segment, ArcSegment) else None
