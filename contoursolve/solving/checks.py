"""The conditions on a contour as one table of margins."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from functools import lru_cache, reduce
from typing import Any

from msgspec import Struct

from contoursolve.geometry import (
    FIRST,
    INCREMENT_OF,
    SECOND,
    Arc,
    Corner,
    Fact,
    Figure,
    Increments,
    Line,
    System,
    Values,
    scalar,
)
from contoursolve.numeric import (
    FLOATS,
    Compiled,
    Functions,
    Tape,
    largest,
    true,
)
from contoursolve.solving.compare import agreement
from contoursolve.solving.compile import compile_plainly, compile_system
from contoursolve.solving.construction import Construction, ConstructionStep, StepKind
from contoursolve.solving.corners import Pair
from contoursolve.solving.events import RefusalKind
from contoursolve.solving.inputs import EXPRESSIONS, input_values
from contoursolve.solving.path_outputs import PathOutputs
from contoursolve.solving.solution import Refusal
from contoursolve.solving.step_outputs import StepOutputs
from contoursolve.tolerance import LARGEST, LENGTH, REGULAR, RESIDUAL, TOUCHING


class Test(Enum):
    """When a check is passed; what is not a number fails, unless it says otherwise."""

    AT_LEAST = "at least"
    """The margin is at least the limit."""
    ABOVE = "above"
    """The margin is more than the limit."""
    NOT_BELOW = "not below"
    """The margin is not less than the limit; what is not a number passes, and fails another check."""
    APART = "apart"
    """The margin is farther from zero than the limit, on either side."""


class Stage(Enum):
    """The subjects of checks, in the order in which a contour is judged: where checks of one fail, those that follow
    are not looked at."""

    CONSTRUCTION = "construction"
    """A step of the construction has a solution."""
    TOUCHING = "touching"
    """Two solutions are apart, as far as floats can tell. There is a contour in either case."""
    RANGE = "range"
    """Words reach every point."""
    EQUATIONS = "equations"
    """The equations are satisfied, as they are by construction but for rounding. Those of corners come last,
    because a corner that does not fit may be huge."""
    FACTS = "facts"
    """A fact that was not needed agrees with the others."""
    ELEMENTS = "elements"
    """Each element runs the way that is stated."""
    CORNERS = "corners"
    """Each corner is one."""
    ROOM = "room"
    """The corners fit on the elements."""


class Check(Struct, frozen=True):
    """One check: what is refused where it fails, about which point, element or corner, and on which element."""

    kind: RefusalKind
    subject: str
    element: str
    test: Test
    limit: float
    givens: tuple[str, ...] = ()
    """The values of the facts that it is about."""
    stage: Stage = Stage.CONSTRUCTION
    is_doubtful: bool = False
    """Whether floats cannot tell what is wrong where it fails, but only the exact arithmetic of a single solve."""
    fact: str = ""
    """The value that a fact states which was not needed."""
    opposite: RefusalKind | None = None
    """The refusal instead where both directions at the corner are opposite."""


Checks = Iterator[tuple[Check, Any]]
"""Checks with their margins, mm but for turns and landings (1)."""


NO_PATH = PathOutputs({}, {}, {}, {})


class MeasuredFigure(Struct, frozen=True, eq=False):
    """The expressions or numbers that margins are made of: the coordinates, radii and angles of a figure, the measures
    of its path, and the least increment of a coordinate by its axis, or of a value by its name, mm or degrees."""

    figure: Figure
    at: Values
    path: PathOutputs
    increment: Increments

    def point(self, name: str) -> Pair:
        """The coordinates of a point, mm."""
        return self.at.coordinate(name, FIRST), self.at.coordinate(name, SECOND)

    def way(self, tail: str, head: str) -> Pair:
        """From one point to another, mm."""
        (a, b), (c, d) = self.point(tail), self.point(head)
        return c - a, d - b

    def distance(self, tail: str, head: str) -> Any:
        """The distance of two points, mm."""
        first, second = self.way(tail, head)
        return self.at.root(first**2 + second**2)


def measured_figure(
    system: System, tape: Tape, known: Mapping[str, Any], path: PathOutputs = NO_PATH
) -> MeasuredFigure:
    """The expressions of a tape, whose outputs measure a path; scalars that are not `known` are inputs."""
    at = input_values(system.headed, tape, known)
    return MeasuredFigure(system.figure, at, path.read(tape.expression), lambda name: tape.input(INCREMENT_OF + name))


class CheckOutputs(Struct, frozen=True, eq=False):
    """The checks of a contour, in the order in which they count, and the names of the outputs that tell what came of
    them."""

    checks: tuple[Check, ...]
    path: PathOutputs
    passed: str
    """The number that are passed in their order until one is not."""
    margins: Mapping[int, str]
    """The margins of those of facts, by their numbers."""


class Checked(Struct, frozen=True, eq=False):
    """The checks of a system, their margins, and a tape with the outputs of the system and of its checks."""

    outputs: CheckOutputs
    margins: tuple[Any, ...]
    tape: Tape
    worst: str
    """The name of the largest residual of the equations that were solved, mm; NaN if any is."""
    is_clear: Any
    """1 where every check is passed, else 0."""


@lru_cache(maxsize=1024)
def compile_checks(system: System) -> Checked:
    """The checks of a determined system in closed form."""
    machine = compile_system(system)
    tape, measured = _measured_of(system, machine)
    basis = largest(map(tape.expression, machine.residuals))
    corners = largest(measured.path.residuals)
    pairs = [
        *(pair for pair in _check_steps(measured, machine, tape) if not _is_half_circle(pair[0])),
        check_range(measured),
        check_residuals(basis),
        *check_facts(measured, machine.checks, map(tape.expression, machine.compared)),
        *check_path(measured),
        check_residuals(corners),
    ]
    outputs, is_clear = add_checks(tape, pairs, machine.path)
    worst = "worst"
    tape.output(worst, largest([basis, corners]))
    return Checked(outputs, tuple(margin for _, margin in pairs), tape, worst, is_clear)


@lru_cache(maxsize=1024)
def compile_checked(system: System) -> Compiled:
    """The function of a determined system in closed form with the outputs of its checks."""
    return compile_checks(system).tape.finish()


def _is_half_circle(check: Check) -> bool:
    """Whether a check is about two centres that may be one: a circle about the middle of two points is an ordinary half
    circle."""
    return check.stage is Stage.TOUCHING and check.kind is RefusalKind.RADIUS_TOO_SMALL


def _measured_of(system: System, machine: Construction) -> tuple[Tape, MeasuredFigure]:
    """The expressions of a system in closed form, and a tape of their own."""
    tape = machine.tape.copy()
    known = {name: tape.expression(name) for name in system.unknowns}
    return tape, measured_figure(system, tape, known | at_origin(system.figure), machine.path)


def plain_checks(system: System) -> tuple[Tape, MeasuredFigure, list[tuple[Check, Any]]]:
    """The checks of a determined system that a control has to make by itself, and where their margins come from."""
    machine = compile_plainly(system)
    tape, measured = _measured_of(system, machine)
    steps = (pair for pair in _check_steps(measured, machine, tape) if pair[0].stage is not Stage.TOUCHING)
    facts = check_facts(measured, machine.checks, map(tape.expression, machine.compared))
    return tape, measured, [*steps, *facts, *check_path(measured)]


def add_checks(tape: Tape, pairs: Sequence[tuple[Check, Any]], path: PathOutputs) -> tuple[CheckOutputs, Any]:
    """The outputs of checks beside those of a path, which are declared, and whether all are passed, as 1 or 0."""
    is_clear, passed = true(), 0 * true()
    margins = dict[int, str]()
    for number, (check, margin) in enumerate(pairs):
        is_clear *= is_passed(check, margin, EXPRESSIONS)
        passed += is_clear
        if check.stage is Stage.FACTS:
            margins[number] = f"margin:{number}"
            tape.output(margins[number], margin)
    outputs = CheckOutputs(tuple(check for check, _ in pairs), path, "passed", margins)
    tape.output(outputs.passed, passed)
    return outputs, is_clear


def at_origin(figure: Figure) -> dict[str, float]:
    """The coordinates of the start point, from which the others count."""
    return {scalar(figure.start, axis): 0.0 for axis in (FIRST, SECOND)}


def is_passed(check: Check, margin: Any, functions: Functions) -> Any:
    """True, or an expression that is 1, where a check is passed by its margin."""
    match check.test:
        case Test.AT_LEAST:
            return functions.at_most(check.limit, margin)
        case Test.ABOVE:
            return functions.below(check.limit, margin)
        case Test.NOT_BELOW:
            return functions.opposite(functions.below(margin, check.limit))
        case Test.APART:
            return functions.below(check.limit, functions.magnitude(margin))


def is_failing(check: Check, margin: float) -> bool:
    """Whether a check fails by its margin; what is more than its limit passes whatever the test."""
    return not margin > check.limit and not is_passed(check, margin, FLOATS)


def _check_steps(measured: MeasuredFigure, machine: Construction, tape: Tape) -> Checks:
    for step, measures in zip(machine.steps, machine.measures, strict=True):
        yield from check_step(measured, step, measures, tape.expression)


def check_step(
    measured: MeasuredFigure, step: ConstructionStep, measures: StepOutputs, out: Callable[[str], Any]
) -> Checks:
    """The checks that a step of a construction has a solution; `out` gives its measures by their names."""
    for tail, through in step.lines_through():
        yield Check(RefusalKind.POINT_IS_START, through, "", Test.ABOVE, LENGTH), measured.distance(tail, through)
    if step.kind is StepKind.AFFINE:
        givens = tuple(fact.given for fact in step.facts if fact.given)
        kind, subject = RefusalKind.LINES_PARALLEL, ",".join(step.unknowns)
        yield Check(kind, subject, "", Test.APART, REGULAR, givens, is_doubtful=True), out(measures.determinant)
        return
    if step.kind is StepKind.RADIUS:
        # What is compared with a circle of no radius at all, a single solve tells.
        kind, (circle,) = RefusalKind.CIRCLE_UNDEFINED, step.circles
        yield Check(kind, circle.center, "", Test.ABOVE, LENGTH, is_doubtful=True), measured.at.radius(circle.radius)
        return
    kind, subject, is_half = RefusalKind.CIRCLE_MISSED, step.point, step.is_equal
    if step.kind is StepKind.TWO_CIRCLES:
        kind = RefusalKind.RADIUS_TOO_SMALL if is_half else RefusalKind.CIRCLES_APART
        undefined = RefusalKind.CIRCLE_UNDEFINED if is_half else kind
        yield Check(undefined, subject, "", Test.ABOVE, LENGTH), out(measures.distance)
    offset, radius, magnitude = out(measures.offset), out(measures.radius), measured.at.functions.magnitude
    give = out(measures.scale) * TOUCHING
    meets = Check(kind, subject, "", Test.AT_LEAST, 0.0)
    yield meets, out(measures.gap) + give
    yield meets, radius + offset + give
    apart = magnitude(radius - magnitude(offset)) - give
    yield Check(kind, subject, "", Test.ABOVE, 0.0, stage=Stage.TOUCHING, is_doubtful=True), apart


def check_residuals(worst: Any) -> tuple[Check, Any]:
    """The check that equations that were solved are satisfied, by their largest residual (mm)."""
    return Check(RefusalKind.NOT_VERIFIED, "", "", Test.AT_LEAST, -RESIDUAL, stage=Stage.EQUATIONS), -worst


def unverified(off: float) -> Refusal:
    """The refusal of a result whose equations are off by so much, mm."""
    return Refusal(RefusalKind.NOT_VERIFIED, "", (), {"limit": RESIDUAL, "actual": off})


def check_range(measured: MeasuredFigure) -> tuple[Check, Any]:
    """The check that words reach every point from the start."""
    start, functions = measured.figure.start, measured.at.functions
    ways = [functions.magnitude(way) for name in measured.figure.points for way in measured.way(start, name)]
    farthest: Any = reduce(functions.larger, ways) if ways else 0.0
    return Check(RefusalKind.OUT_OF_RANGE, "", "", Test.NOT_BELOW, 0.0, stage=Stage.RANGE), LARGEST - farthest


def check_facts(measured: MeasuredFigure, facts: Iterable[Fact], residuals: Iterable[Any]) -> Checks:
    """The checks that facts that were not needed, with these residuals (mm), agree at the points of the others."""
    for fact, residual in zip(facts, residuals, strict=True):
        is_plain = fact.sizes or fact.heading or (fact.placed and fact.placed.is_stepped)
        is_doubtful = bool(fact.given) and not is_plain
        kind, subject = RefusalKind.WORDS_DISAGREE, fact.given
        if not fact.given:
            kind = RefusalKind.FACT_DISAGREES
            if fact.circle:
                kind, subject = RefusalKind.RADIUS_DIFFERENCE, fact.circle.point
        check = Check(kind, subject, "", Test.NOT_BELOW, 0.0, (), Stage.FACTS, is_doubtful, fact.given)
        for margin in agreement(fact, residual, measured.at, measured.increment, measured.figure):
            yield check, margin


def check_path(measured: MeasuredFigure) -> Checks:
    """The checks that the control can make the path: the direction of travel, and the room for each corner."""
    figure = measured.figure
    for element in figure.path:
        if not (isinstance(element, Arc) and element.may_be_full):
            yield _check_element(measured, element)
    for corner in figure.corners:
        yield from _check_corner(measured, corner)
    yield from check_room(measured)


def _check_element(measured: MeasuredFigure, element: Line | Arc) -> tuple[Check, Any]:
    name = element.name
    if isinstance(element, Arc):
        check = Check(RefusalKind.ARC_EMPTY, name, name, Test.ABOVE, LENGTH, stage=Stage.ELEMENTS)
        return check, measured.distance(element.tail, element.head)
    told = RefusalKind.CORNER_SIGN if element.is_signed else RefusalKind.LINE_REVERSED
    kind = RefusalKind.LINE_BACKWARDS if element.heading is None else told
    return Check(kind, name, name, Test.AT_LEAST, -LENGTH, stage=Stage.ELEMENTS), measured.path.lengths[name]


def _check_corner(measured: MeasuredFigure, corner: Corner) -> Checks:
    path, name, functions = measured.path, corner.name, measured.at.functions

    def check(kind: RefusalKind, test: Test, limit: float, on: str = "", opposite: RefusalKind | None = None) -> Check:
        return Check(kind, name, on, test, limit, stage=Stage.CORNERS, opposite=opposite)

    for element in elements_at(corner, path):
        yield check(RefusalKind.CORNER_TOO_LARGE, Test.ABOVE, LENGTH, element), path.lengths[element]
    if name in path.landings:
        yield check(RefusalKind.LANDING_UNKNOWN, Test.APART, 0.5), path.landings[name]
    built = path.corners[name]
    size = functions.magnitude(built.turn)
    if corner.guard:
        # Where the path goes on, the control leaves the corner out.
        ahead = functions.below(0, built.cosine)
        yield check(RefusalKind.CORNER_REVERSES, Test.ABOVE, REGULAR), functions.larger(size, ahead)
    else:
        straight, back = RefusalKind.CORNER_STRAIGHT, RefusalKind.CORNER_REVERSES
        yield check(straight, Test.APART, REGULAR, opposite=back), built.turn
    if corner.least:
        back = functions.below(built.cosine, 0)
        yield check(RefusalKind.CORNER_STRAIGHT, Test.ABOVE, corner.least), functions.larger(size, back)
    if corner.shape.share:
        for axis, margin in _inside(measured, corner):
            yield check(RefusalKind.BEVEL_OUTSIDE, Test.NOT_BELOW, -LENGTH, str(axis)), margin
        for setback in (built.setback_in, built.setback_out):
            # Not a number is a bevel that is too large for its arc.
            yield check(RefusalKind.BEVEL_IN_BAND, Test.NOT_BELOW, -LENGTH), setback


def _inside(measured: MeasuredFigure, corner: Corner) -> Iterator[tuple[int, Any]]:
    """The depth of a corner inside the rectangle spanned by the ends of its two lines along each axis, mm."""
    path, larger = {element.name: element for element in measured.figure.path}, measured.at.functions.larger
    before, after = path[corner.before], path.get(corner.after or "")
    if after is None or isinstance(before, Arc) or isinstance(after, Arc):
        return
    tail, head, at = measured.point(before.tail), measured.point(after.head), measured.point(corner.at)
    for axis in (FIRST, SECOND):
        # Either coordinate is exact to half its increment.
        give = measured.increment(str(axis))
        yield axis, larger(at[axis] - tail[axis], at[axis] - head[axis]) + give
        yield axis, larger(tail[axis] - at[axis], head[axis] - at[axis]) + give


def check_room(measured: MeasuredFigure) -> Checks:
    """The checks that each element is as long as the setbacks of the corners at its two ends. A setback on an arc that
    is not a number belongs to a corner that cannot touch the arc at all; a negative one would leave the arc beyond its
    end."""
    figure, path = measured.figure, measured.path
    for corner in figure.corners:
        for name, setback in setbacks_of(corner, path).items():
            fits = Check(RefusalKind.CORNER_TOO_LARGE, corner.name, name, Test.AT_LEAST, -LENGTH, stage=Stage.ROOM)
            yield fits, setback
            yield fits, path.lengths[name] - setback
    for element in figure.path if figure.corners else ():
        name = element.name
        yield (
            Check(RefusalKind.CORNERS_OVERLAP, name, name, Test.NOT_BELOW, -LENGTH, stage=Stage.ROOM),
            path.rooms[name],
        )


def setbacks_of(corner: Corner, path: PathOutputs) -> dict[str, Any]:
    """The length that a corner takes of each element that has two ends, mm."""
    built = path.corners[corner.name]
    return dict(zip(elements_at(corner, path), (built.setback_in, built.setback_out), strict=False))


def elements_at(corner: Corner, path: PathOutputs) -> list[str]:
    """The elements that a corner joins, as far as they have two ends."""
    after = corner.after or corner.lands_on
    return [corner.before, *([after] if after and after in path.lengths else [])]
