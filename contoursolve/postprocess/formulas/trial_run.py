"""Runs the statements of a contour, and holds what comes of them against a single solve."""

from collections.abc import Iterable, Mapping
from math import dist, hypot, inf
from typing import Any

from contoursolve.diagnosis import Answer
from contoursolve.execution import Assign, Unknown, When, evaluate
from contoursolve.numeric import Term
from contoursolve.postprocess.formulas.contour_statements import SHORTEST, BlockUnits, Choose, Leg, Statement, Stop
from contoursolve.solving import ArcSegment, Point

WITHIN = 0.0005
"""mm. Half of the least increment, within which a path is the same."""


class Stopped(Exception):  # noqa: N818 - what a machine does, and no error
    """The statements stop; the message is what the machine says."""


class Runner:
    """The values of variables by name, and the legs that have been gone: X and Z as words have them."""

    def __init__(self, values: Mapping[str, float]) -> None:
        self.values: dict[str, Any] = dict(values)
        self.legs: list[tuple[str, tuple[float, float], tuple[float, float] | None, float]] = []

    def value(self, term: Term) -> float:
        """The value of a term; a machine stops where it has none."""
        found = evaluate(term, lambda name: self.values.get(name, Unknown(f"{name} has no value")))
        if not isinstance(found, float):
            raise Stopped(getattr(found, "reason", "a text"))
        return found

    def run(self, statements: Iterable[Statement]) -> None:
        """Run statements. Raises Stopped."""
        for each in statements:
            match each:
                case Assign():
                    self.values[getattr(each.variable, "name", "")] = self.value(each.value)
                case When():
                    self.run(each.then if self.value(each.condition) else ())  # type: ignore[arg-type]
                case Stop():
                    if self.value(each.condition):
                        raise Stopped(each.message)
                case Choose():
                    self.run(each.then if self.value(each.condition) else each.otherwise)
                case Leg():
                    self._go(each)

    def _go(self, leg: Leg) -> None:
        first, second = (self.value(each) for each in leg.end)
        center, turn = None, 0.0
        if leg.center is not None and leg.chord is not None and self.value(leg.chord) >= SHORTEST:
            one, two = (self.value(each) for each in leg.center)
            center, turn = (one, two), self.value(leg.turn) if leg.turn is not None else 0.0
        self.legs.append((leg.name, (first, second), center, turn))


def difference(
    statements: Iterable[Statement], values: Mapping[str, float], answer: Answer, writing: Mapping[str, BlockUnits]
) -> str:
    """The difference between statements, run at some values, and a single solve there; empty if they agree."""
    runner = Runner(values)
    try:
        runner.run(statements)
    except Stopped as stopped:
        return f"the formulas stop ({stopped}) where there is a contour" if answer.contour is not None else ""
    if answer.contour is None:
        return "the formulas do not stop where there is no contour"
    here, path = answer.contour.start, list[tuple[str, Point, Point | None, float]]()
    for name, end, center, turn in runner.legs:
        scales, is_step = writing[name].scales, writing[name].is_incremental
        one, two = (value / scale + is_step * at for value, scale, at in zip(end, scales, here, strict=True))
        if hypot(one - here[0], two - here[1]) > WITHIN:
            unit = min(scales)
            middle = (here[0] + center[0] / unit, here[1] + center[1] / unit) if center is not None else None
            path.append((name, (one, two), middle, turn))
        here = one, two
    elements = [each for each in answer.contour.elements if dist(each.start, each.end) > WITHIN]
    if [each.name for each in elements] != [name for name, *_ in path]:
        return "the formulas make other elements"
    for element, (_, end, middle, turn) in zip(elements, path, strict=True):
        off = dist(element.end, end)
        if isinstance(element, ArcSegment) and middle is not None:
            off = max(off, dist(element.center, middle)) if element.turn.sign * turn > 0 else inf
        elif isinstance(element, ArcSegment):
            off = inf
        if not off <= WITHIN:
            return f"the formulas make {element.name} another way"
    return ""
