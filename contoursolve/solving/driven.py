"""Steps without a closed form: all solutions by following one unknown through all its values.

With one unknown taken as known, all but one of the equations are solved in closed form again, for a whole
interval of its values at once. The equation that is left over excludes most intervals; the others are
divided until the Krawczyk test proves that a box holds one solution or none.
"""

from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import pi

from contoursolve.analysis import Group, order
from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.constraints import System, UnitDirection
from contoursolve.model import Fact
from contoursolve.solving.elimination import Close, Limits, ObstacleError, Root, remaining, solve_step
from contoursolve.solving.kernel import Kernel, Slopes, make_kernel, make_slopes
from contoursolve.solving.krawczyk import Content, content_of, keep, refine, solve_linear
from contoursolve.solving.polynomial import Coefficient
from contoursolve.solving.search import search

EVALUATIONS = 1_500
"""How many intervals are looked at for one drawing before the search is given up as undecided; a second or three."""

LEAST = 150
"""How many intervals every search may look at, however much the ones before it used."""

STARTS = 400
"""How many of the undecided intervals are then used as starts for CasADi's root finder."""

NARROWEST = 2.0**-40
"""An interval this small, as a share of the whole range, is given up as undecided."""

DIVISION = 0.487
"""Intervals are divided away from the middle, where drawings like to have their solutions."""


@dataclass(frozen=True, slots=True)
class Drive:
    """The unknown to follow (a scalar, or a line whose direction is followed), and the steps for the others."""

    parameter: str
    is_direction: bool
    steps: tuple[Kernel, ...]
    slopes: tuple[Slopes, ...]
    """For each step, the derivatives of its equations by all unknowns of the group."""


@lru_cache(maxsize=1024)
def find_drive(system: System, group: Group) -> Drive | None:
    """How to solve a group by following one of its unknowns; None if no unknown leaves closed forms."""
    best: tuple[tuple[int, int], Drive] | None = None
    for parameter, is_direction, unknowns, facts in _candidates(group):
        for left in facts:
            if isinstance(left, UnitDirection):
                continue  # what is left of a direction without it is zero
            used = [fact for fact in facts if fact is not left]
            try:
                groups = order(system, used, unknowns)
            except ValueError:
                continue
            steps = tuple(make_kernel(system, each) for each in groups)
            sizes = [remaining(step) for step in steps]
            if all(size is not None for size in sizes):
                effort = (sum(size or 0 for size in sizes), 0 if is_direction else 1)
                if best is None or effort < best[0]:
                    slopes = tuple(make_slopes(system, step.facts, group.unknowns) for step in steps)
                    best = effort, Drive(parameter, is_direction, steps, slopes)
    return best[1] if best else None


def _candidates(group: Group) -> Iterator[tuple[str, bool, list[str], list[Fact]]]:
    for fact in group.facts:
        if isinstance(fact, UnitDirection) and set(fact.reads()) <= set(group.unknowns):
            others = [name for name in group.unknowns if name not in fact.reads()]
            yield fact.line, True, others, [each for each in group.facts if each is not fact]
    for unknown in group.unknowns:
        yield unknown, False, [name for name in group.unknowns if name != unknown], list(group.facts)


Coefficients = Callable[[Kernel, Mapping[str, Number], Mapping[str, Number]], Sequence[Coefficient]]
Inputs = Callable[[Kernel, Mapping[str, Number]], Mapping[str, Number]]


def follow(
    drive: Drive,
    whole: Kernel,
    coefficients: Coefficients,
    inputs: Inputs,
    reach: Mapping[str, tuple[float, float]],
    budget: int,
) -> tuple[list[Root], bool, int]:
    """All solutions of a group within reach, whether the list is proven to be complete, and how many intervals of
    the budget were used.

    `coefficients` gives the parameters of a step at the values of some unknowns and about an origin, `inputs` the
    arguments of a kernel; `reach` is the range of each unknown.
    """
    low, high = (-pi, pi) if drive.is_direction else reach[drive.parameter]
    pending = deque([(low, high)])
    found: list[list[Number]] = []
    known = inputs(whole, {})
    given_up: list[tuple[float, float]] = []
    used = 0
    while pending and used < budget:
        used += 1
        begin, end = pending.popleft()
        try:
            boxes = list(_branches(drive, whole, (begin, end), coefficients, inputs, reach))
            contents = [content_of(whole, box, known) for box in boxes]
        except ObstacleError:
            contents = [(Content.UNKNOWN, [])]
        for content, box in contents:
            if content is Content.ONE:
                keep(refine(whole, box, known), found)
        if any(content is Content.UNKNOWN for content, _ in contents):
            if end - begin <= NARROWEST * (high - low):
                given_up.append((begin, end))
            else:
                middle = begin + DIVISION * (end - begin)
                pending += [(begin, middle), (middle, end)]
    undecided = [*given_up, *pending]
    for begin, end in undecided[:: max(1, len(undecided) // STARTS)]:
        middle = begin + DIVISION * (end - begin)
        try:
            boxes = list(_branches(drive, whole, (middle, middle), coefficients, inputs, reach))
        except ObstacleError:
            continue
        for box in boxes:
            search(whole, [ball.middle(each) for each in box], known, found)
    return [Root(dict(enumerate(box))) for box in found], not undecided, used


@dataclass(frozen=True, slots=True)
class _Branch:
    """One way of solving the steps over an interval of the parameter.

    `wide` holds every unknown for the whole interval, `thin` for one value in it, and `slope` its derivative by
    the parameter for the whole interval. Thin values and slopes are missing where two solutions are so close
    that they were enclosed together.
    """

    wide: Mapping[str, Number]
    thin: Mapping[str, Number] | None
    slope: Mapping[str, Number] | None


def _branches(
    drive: Drive,
    whole: Kernel,
    interval: tuple[float, float],
    coefficients: Coefficients,
    inputs: Inputs,
    reach: Mapping[str, tuple[float, float]],
) -> Iterator[list[Number]]:
    """Boxes that hold all solutions whose parameter lies in an interval."""
    parameter = ball.between(*interval)
    at = ball.center(parameter)
    branches = [
        _Branch(*(_parameter(drive, value, at_slope) for value, at_slope in ((parameter, 0), (at, 0), (parameter, 1))))
    ]
    for step, slopes in zip(drive.steps, drive.slopes, strict=True):
        branches = [
            after
            for branch in branches
            for after in _extend(branch, step, slopes, parameter - at, coefficients, inputs, reach)
            if _is_within(after.wide, reach)
        ]
    for branch in branches:
        yield [branch.wide[name] for name in whole.unknowns]


def _parameter(drive: Drive, value: Number, derivative: int) -> dict[str, Number]:
    """The unknowns that the parameter stands for, or their derivatives by it."""
    if not drive.is_direction:
        return {drive.parameter: ball.exact(1.0) if derivative else value}
    cosine, sine = ball.cosine(value), ball.sine(value)
    line = drive.parameter
    return {f"{line}.cos": -sine, f"{line}.sin": cosine} if derivative else {f"{line}.cos": cosine, f"{line}.sin": sine}


def _extend(
    branch: _Branch,
    step: Kernel,
    slopes: Slopes,
    spread: Number,
    coefficients: Coefficients,
    inputs: Inputs,
    reach: Mapping[str, tuple[float, float]],
) -> Iterator[_Branch]:
    # Twice, because the unknowns are counted from an origin within reach.
    sizes = {index: 2 * max(map(abs, reach[name])) for index, name in enumerate(step.unknowns)}
    limits = Limits(sizes, Close.TOGETHER)
    thin: list[Root] = []
    if branch.thin is not None and branch.slope is not None:
        thin = solve_step(step, coefficients(step, branch.thin, {}), limits)
    origins = [{step.unknowns[index]: ball.center(value) for index, value in root.values.items()} for root in thin]
    # About its own solution a polynomial with balls for coefficients has the narrowest roots.
    solved = [solve_step(step, coefficients(step, branch.wide, origin), limits) for origin in origins or [{}]]
    for root in solved[0]:
        inside = [number for number, each in enumerate(thin) if _is_inside(each, root)]
        alone = len(inside) == 1 and sum(_is_inside(thin[inside[0]], other) for other in solved[0]) == 1
        if alone:
            again = [each for each in solved[inside[0]] if _is_inside(thin[inside[0]], each)]
            root = again[0] if len(again) == 1 else root  # noqa: PLW2901 - the same root, enclosed more narrowly
        values = {step.unknowns[index]: value for index, value in root.values.items()}
        state = {**branch.wide, **values}
        slope = _slope(step, slopes, inputs(step, state), state, branch.slope) if alone and branch.slope else None
        if slope is None or branch.thin is None or branch.slope is None:
            yield _Branch(state, None, None)
            continue
        at = {step.unknowns[index]: value for index, value in thin[inside[0]].values.items()}
        # Mean value: the unknown moves from its value in the middle by no more than its slope allows.
        moved = {name: ball.common(values[name], at[name] + slope[name] * spread) for name in step.unknowns}
        if all(value is not None for value in moved.values()):
            yield _Branch({**branch.wide, **moved}, {**branch.thin, **at}, {**branch.slope, **slope})


def _is_inside(thin: Root, wide: Root) -> bool:
    return all(ball.intersects(thin.values[index], value) for index, value in wide.values.items())


def _slope(
    step: Kernel, slopes: Slopes, given: Mapping[str, Number], state: Mapping[str, Number], before: Mapping[str, Number]
) -> dict[str, Number] | None:
    """The derivatives of a step's unknowns by the parameter, by those of the unknowns before; None if unbounded."""
    size = len(step.unknowns)
    # Unknowns of later steps do not occur; any number will do for them.
    known = {**dict.fromkeys(slopes.names, ball.exact(0.0)), **given, **state}
    values = slopes.replay([known[name] for name in slopes.arguments])
    width = len(slopes.names)
    rows = [values[number * width : (number + 1) * width] for number in range(size)]
    matrix = [[row[slopes.names.index(name)] for name in step.unknowns] for row in rows]
    right: list[Number] = []
    for row in rows:
        total: Number = ball.exact(0.0)
        for name, entry in zip(slopes.names, row, strict=True):
            if name in before:
                total = total - entry * before[name]
        right.append(total)
    found = solve_linear(matrix, right)
    return dict(zip(step.unknowns, found, strict=True)) if found else None


def _is_within(state: Mapping[str, Number], reach: Mapping[str, tuple[float, float]]) -> bool:
    """Whether a box has a part within reach."""
    return all(
        ball.sign(value - ball.exact(reach[name][1])) != 1 and ball.sign(value - ball.exact(reach[name][0])) != -1
        for name, value in state.items()
        if name in reach
    )
