"""Goals of points of a contour: as a function of one word whose zeros are sought, and where there is no closed form as
a fact, with the word asked for.
"""

import re
from collections.abc import Iterator, Mapping
from decimal import Decimal, InvalidOperation
from math import hypot

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import (
    Answer,
    Depth,
    answer_question,
    count_choices,
    counts_few,
    list_alternatives,
    readings,
    typed_text,
    unknowns_text,
    with_value,
)
from contoursolve.diagnostics import Span
from contoursolve.families.block_template import Template, first_error, is_same
from contoursolve.families.branches import PLACES, Branch
from contoursolve.families.case_classes import CaseClass, results_of
from contoursolve.families.errors import FamilyError, NotMovedError
from contoursolve.families.isolate import VOID, Fineness, Signs
from contoursolve.families.results import (
    ResultNames,
    base_name,
    check_text,
    coordinate_name,
    end_name,
    factors_of,
    read_point,
)
from contoursolve.gcode import Word, read_directive
from contoursolve.geometry import PATH_END, Unit
from contoursolve.numeric import Array, Intervals
from contoursolve.reading import ReadIssue, WithoutPoint
from contoursolve.solving import Contour, Point, Status

CONSTANT = 1e-10
"""mm for each unit of the word. A coordinate whose rate is less at places drawn at random never changes."""


class Goal(Struct, frozen=True):
    """Place at which a point is wanted: its name, and a value for one axis or both, mm, X of a lathe as radius."""

    point: str
    place: tuple[float | None, float | None]

    @property
    def is_nearest(self) -> bool:
        """Whether both coordinates are wanted, which one word alone may only come near to."""
        return None not in self.place

    def away(self, at: Point) -> float:
        """The distance of a point from there, mm."""
        return hypot(*(have - want for have, want in zip(at, self.place, strict=True) if want is not None))


def read_goal(text: str, answer: Answer) -> Goal:
    """The goal that a text states in words, which count as the control counts. Raises FamilyError for one that is none,
    and for words that may be meant in another way."""
    check_text("goal", text)
    plane, lexicon, unit = answer.plane, answer.claim.lexicon, answer.unit
    match = re.fullmatch(r"\s*(\S.*?)((?:\s+[A-Za-z]\s*[-+]?[\d.,]+)+)\s*", text)
    if match is None:
        raise FamilyError(f"{text!r} is no goal; write a point and where it is wanted, such as 'end Z-50.'")
    names = ResultNames(answer.profile, results_of(CaseClass(answer.profile, None, {}, is_closed=False)))
    point = read_point(match[1], names)
    place: list[float | None] = [None, None]
    for letter, number in re.findall(r"([A-Za-z])\s*([-+]?[\d.,]+)", match[2]):
        if "," in number:
            raise FamilyError(f"{letter}{number} has a decimal comma; write {letter}{number.replace(',', '.')}")
        if letter.upper() not in plane.axes:
            raise FamilyError(f"{letter}{number}: the axes of this contour are {' and '.join(plane.axes)}")
        axis = plane.axes.index(letter.upper())
        try:
            word = Word(letter.upper(), Decimal(number), "." in number, f"{letter}{number}", Span(0, 1, 2))
        except InvalidOperation:
            raise FamilyError(f"{letter}{number} is no number") from None
        if counts_few(word, lexicon):
            actual, expected, same = readings(word, lexicon, unit)
            told = f"{word.text} has no decimal point, and the control reads it as {actual}"
            raise FamilyError(f"{text!r}: {told}; write {word.text}. for {expected}, or {same} for {actual}")
        is_counted = not word.has_point and lexicon.numbers.without_point is WithoutPoint.LEAST_INCREMENTS
        written = Decimal(number) * (lexicon.numbers.step(Unit.MM, unit) if is_counted else 1)
        value = float(written) * float(unit.in_mm) / (2 if plane.diameters[axis] else 1)
        if place[axis] is not None:
            raise FamilyError(f"{text!r} states {letter.upper()} twice")
        place[axis] = value
    return Goal(point.text if point == PATH_END else base_name(point, answer.profile.figure), (place[0], place[1]))


def place_of(point: str, contour: Contour | None) -> Point | None:
    """The place of a point of a solved contour, `end` or by the name of its column; None where it has no such point, or
    there is no contour."""
    if contour is None:
        return None
    if point == PATH_END.of:
        return contour.end
    if point in contour.places:
        return contour.places[point]
    element, _, part = point.rpartition(".")
    for each in contour.elements:
        if each.name == element:
            found: Point | None = getattr(each, {"begin": "start"}.get(part, part), None)
            return found
    return None


def outputs_at(goal: Goal, branch: Branch) -> dict[str, tuple[int, float]] | None:
    """The outputs of a solution that are the coordinates of a goal, each with its axis and where it is wanted; None
    where it has no such point."""
    case, found = branch.case, dict[str, tuple[int, float]]()
    results, figure = results_of(case), case.system.figure
    point = end_name(figure) if goal.point == PATH_END.of else goal.point
    for axis, wanted in enumerate(goal.place):
        name = coordinate_name(point, case.profile.plane.axes[axis])
        if wanted is not None and name not in results:
            return None
        if wanted is not None:
            found[results[name].output] = axis, wanted
    return found


class TargetCurve:
    """A function of the word whose zeros are sought, for one solution: a coordinate less its goal, or half the rate at
    which the square of the distance to the goal grows; or with `most`, a function that is above zero where the distance
    is longer. `goals` are the outputs that are coordinates, each with its axis and its goal, mm. `within` are the
    values of the word between which the solution is the contour."""

    fineness, finer = Fineness(16, 24, 1e-9), Fineness(4, 24, 1e-13)
    """Zeros that are closer than the first tells apart count as one."""

    def __init__(
        self,
        branch: Branch,
        goals: Mapping[str, tuple[int, float]],
        within: tuple[float, float],
        *,
        most: float | None = None,
        is_part: bool = False,
    ) -> None:
        self.branch, self.goals, self.within, self.most, self.is_part = branch, goals, within, most, is_part
        self.chart, self.fixed = branch.target(goals, most)

    def is_constant(self) -> bool:
        """Whether the word does not move the point."""
        if len(self.goals) > 1 or self.most is not None:
            return all(
                TargetCurve(self.branch, {name: goal}, self.within).is_constant() for name, goal in self.goals.items()
            )
        places = numpy.random.default_rng(PLACES).uniform(*self.within, PLACES)
        return bool((numpy.abs(self.chart.slopes_at(places, self.fixed)) <= CONSTANT).all())

    def at(self, places: Array) -> Array:
        """The values."""
        found: Array = self.chart.at(places, self.fixed)[0]
        return found

    def signs(self, cells: Intervals) -> Signs:
        """Signs for certain; no zero counts where there is no contour for certain, which is asked for parts alone."""
        bounds = self.chart.narrowed(self.chart.between(cells, self.fixed), cells, self.fixed)
        signs = numpy.where(bounds.low[0] > 0, 1, numpy.where(bounds.high[0] < 0, -1, 0)).astype(numpy.int8)
        if self.is_part:
            # Bounds as they are: what is not decided by them is divided.
            fails = self.branch.verdicts(cells, self.branch.find_level(*self.within), cells.low.size)[1]
            signs[(signs == 0) & fails] = VOID
        return signs

    def ways(self, cells: Intervals) -> Signs:
        """The cells in which it only rises, or only falls, and does not jump."""
        is_smooth, slopes = self.chart.between(cells, self.fixed).is_smooth, self.slopes(cells)
        ways = numpy.where(slopes.low > 0, 1, numpy.where(slopes.high < 0, -1, 0))
        return numpy.where(is_smooth, ways, 0).astype(numpy.int8)

    def part(self, _low: float, _high: float) -> "TargetCurve":
        """The same, with what is no contour left out."""
        return TargetCurve(self.branch, self.goals, self.within, most=self.most, is_part=True)

    def slopes(self, cells: Intervals) -> Intervals:
        """Bounds of the derivatives."""
        bounds = self.chart.slopes_between(cells, self.fixed)
        return Intervals(bounds.low[0], bounds.high[0])


def asked_values(template: Template, word: str, goal: Goal, answer: Answer) -> tuple[list[float], list[str]]:
    """Every value of a word or a fact, as written, with which a point has one coordinate, and why these are not proven
    to be all; nothing if they are. `answer` is that of the block as it is. Raises NotMovedError, FamilyError."""
    typed = template.words[word]
    asking = template.typed({word: with_value(typed, "?", template.program.syntax.words)})
    facts = asking.asked.facts
    facts = (*facts, read_directive(_stated(goal, answer), -len(facts) - 1))
    result = replace(asking, asked=replace(asking.asked, facts=facts)).examined(Depth.VERDICT)
    unread = [each.message for each in result.diagnostics if each.about in _UNREAD]
    if unread:
        raise FamilyError(unread[0])
    found = template.one_of(result)
    status = found.status
    if status is Status.UNDERDETERMINED and answer.contour is not None:
        # The goal says nothing of the word, which is open without its value.
        raise NotMovedError(f"{word} does not move {goal.point} in this direction")
    if status in (Status.UNDERDETERMINED, Status.REJECTED):
        raise FamilyError(first_error(result))
    return list(_values(found, typed)), list(_doubts(found))


_UNREAD = (ReadIssue.FACT_UNREADABLE, ReadIssue.FACT_IMPOSSIBLE)


def _values(found: Answer, typed: Word) -> Iterator[float]:
    """The values in all solutions that the control could make."""
    question = next((each for each in found.profile.questions if is_same(typed, each.word)), None)
    if question is None:
        raise FamilyError(f"{typed.text} cannot be asked for here")
    scale = 1.0
    if question.unit is Unit.MM:
        scale = (2.0 if question.is_diameter else 1.0) / float(found.unit.in_mm)
    alternatives = list_alternatives(found)
    if alternatives is None:
        values = [each.value for each in found.asked if each.question is question]
    else:
        values = [answer_question(question, found.profile, item.solution).value for item in alternatives.paths]
    yield from (value * scale for value in values if value is not None)


def _doubts(found: Answer) -> Iterator[str]:
    """The reasons for which the solutions are not proven to be all."""
    alternatives = list_alternatives(found)
    if alternatives is not None:
        for doubt in alternatives.doubts:
            yield f"{unknowns_text(doubt.unknowns, found.profile) or 'the equations'}: {doubt.obstacle.value}"
        if alternatives.reach is not None:
            yield f"there is no closed form; it was searched within {alternatives.reach:.0f} mm of the start point"
    elif found.contour is not None and (choices := count_choices(found.profile)):
        yield f"the other sides of {choices} points: too many to go through"
    elif found.contour is None and found.status is Status.UNDECIDED:
        yield "no value was found, and that there is none is not proven"


def _stated(goal: Goal, answer: Answer) -> str:
    """A goal of one coordinate as a fact."""
    if goal.is_nearest:
        raise FamilyError("without a closed form, name one coordinate to bring the point to")
    return next(_facts(goal, answer))


def _facts(goal: Goal, answer: Answer) -> Iterator[str]:
    """A goal as facts, one for each coordinate."""
    plane = answer.plane
    for axis, factor, value in zip(plane.axes, factors_of(plane), goal.place, strict=True):
        if value is not None:
            shown = value * factor / float(answer.unit.in_mm)
            yield f"{coordinate_name(goal.point, axis)} = {typed_text(shown)}"


def asking_for(template: Template, goal: Goal, answer: Answer) -> Answer:
    """The answer of the block that asks for all its free words, with a goal of both coordinates as facts. `answer` is
    that of the block as it is. Raises FamilyError."""
    if not goal.is_nearest:
        raise FamilyError(f"two words need both coordinates of {goal.point}, such as 'end Z-50. X100.'")
    spelling = template.program.syntax.words
    asking = template.typed({name: with_value(word, "?", spelling) for name, word in template.words.items()})
    facts = asking.asked.facts
    more = (read_directive(text, -len(facts) - number) for number, text in enumerate(_facts(goal, answer), 1))
    return template.one_of(replace(asking, asked=replace(asking.asked, facts=(*facts, *more))).examined())
