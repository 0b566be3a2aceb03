"""The inverse question where there is no closed form: the word is asked for, and the target stated as a fact."""

from collections.abc import Iterator
from dataclasses import replace

from contoursolve import syntax
from contoursolve.examine import Answer, Depth, answer_question, count_choices, list_alternatives
from contoursolve.families.spec import FamilyError, NotMovedError, Template, first_error, is_same, with_value, write
from contoursolve.families.targets import Goal
from contoursolve.model import Figure, Unit
from contoursolve.reading import Trouble
from contoursolve.solving import Status
from contoursolve.syntax import Word
from contoursolve.wording import unknowns_text


def asked_values(template: Template, word: str, goal: Goal, answer: Answer) -> tuple[list[float], list[str]]:
    """Every value of a word or a fact, as written, with which a point has one coordinate, and why these are not proven
    to be all; nothing if they are. `answer` is that of the block as it is. Raises NotMovedError, FamilyError."""
    typed = template.words[word]
    asking = template.typed({word: with_value(typed, "?")})
    facts = (*asking.facts, syntax.read_directive(_stated(goal, answer), -len(asking.facts) - 1))
    result = replace(asking, facts=facts).examined(Depth.VERDICT)
    unread = [each.message for each in result.diagnostics if each.about in _UNREAD]
    if unread:
        raise FamilyError(unread[0])
    if len(result.answers) != 1:
        raise FamilyError(first_error(result) or "the block is no single contour")
    status = result.answers[0].status
    if status is Status.UNDERDETERMINED and answer.contour is not None:
        # The goal says nothing of the word, which is open without its value.
        raise NotMovedError(f"{word} does not move {goal.point} in this direction")
    if status in (Status.UNDERDETERMINED, Status.REJECTED):
        raise FamilyError(first_error(result))
    return list(_values(result.answers[0], typed)), list(_doubts(result.answers[0]))


_UNREAD = (Trouble.FACT_UNREADABLE, Trouble.FACT_IMPOSSIBLE)


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
        values = [each.value for each in found.answers if each.question is question]
    else:
        values = [answer_question(question, found.profile, item.solution).value for item in alternatives.paths]
    yield from (value * scale for value in values if value is not None)


def _doubts(found: Answer) -> Iterator[str]:
    """Why the solutions are not proven to be all."""
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
    axis = 0 if goal.place[0] is not None else 1
    value, plane = goal.place[axis], answer.plane
    if value is None or goal.is_nearest:
        raise FamilyError("without a closed form, name one coordinate to bring the point to")
    shown = value * (2 if plane.diameters[axis] else 1) / float(answer.unit.in_mm)
    return f"{plane.axes[axis]} of {_point(goal.point, answer.profile.figure)} = {write(shown)}"


def _point(name: str, figure: Figure) -> str:
    """A point as facts call it."""
    element, _, part = name.rpartition(".")
    if name == "end":
        last = figure.path[-1]
        landing = next((corner.name for corner in figure.corners if corner.at == last.head), None)
        element, part = landing or last.name, "end"
    return f"{part} of {element}" if element else name
