"""The solutions of a class of rows, each as a function of its free words, with the margins of its checks: one where the
words choose it, several where further facts, values that are asked for, or choices that nothing makes leave several.
"""

from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from functools import lru_cache
from itertools import product
from math import inf
from typing import Any

import numpy
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from contoursolve.diagnosis import join
from contoursolve.families.case_classes import INSTEAD, ORIGIN, CaseClass, Follows
from contoursolve.families.errors import NotClosedError
from contoursolve.families.isolate import Fineness, Signs
from contoursolve.geometry import Choice, Fact, System
from contoursolve.numeric import Array, Bounds, Chart, Following, Intervals
from contoursolve.solving import (
    Check,
    Checks,
    Construction,
    Need,
    NoClosedFormError,
    RefusalKind,
    Stage,
    Test,
    at_origin,
    check_facts,
    check_path,
    check_range,
    compile_branches,
    compile_checks,
    compile_system,
    measured_figure,
    orders_of,
    settled_by,
)
from contoursolve.tolerance import REGULAR

Bits = NDArray[numpy.bool_]

GOAL = "goal:"
"""Prefix of the inputs for the goals of coordinates."""

MOST = "most"
"""The input for how far from there they may be."""

_OF_FLOATS = (Stage.TOUCHING, Stage.EQUATIONS)
"""Checks that do not tell whether there is a contour, but what floats know of it."""


class Margins(Struct, frozen=True, eq=False):
    """All checks of a system in their order, and their margins as functions of the free words."""

    checks: tuple[Check, ...]
    chart: Chart

    @property
    def limits(self) -> Array:
        """The limits by check, as a column."""
        return numpy.array([[each.limit] for each in self.checks])

    @property
    def is_apart(self) -> Bits:
        """Mask of the checks that are about being apart from zero, as a column."""
        return numpy.array([[each.test is Test.APART] for each in self.checks])

    @property
    def is_real(self) -> Bits:
        """Mask of the checks without which there are no points: beyond them roots count as zero."""
        stages = (each.stage is Stage.CONSTRUCTION and each.test is not Test.APART for each in self.checks)
        return numpy.fromiter(stages, bool, len(self.checks))

    def failing(self, values: Array) -> Bits:
        """Mask of the checks that fail, by (check, place). NaN fails, and a margin that is just at its
        limit passes, whatever the test says of these: ends are looked at by single solves."""
        size = numpy.where(self.is_apart, numpy.abs(values), values)
        return ~numpy.where(self.is_apart, size > self.limits, size >= self.limits)

    def first_failing(self, values: Array) -> NDArray[numpy.int64]:
        """The number of the first check that fails, place by place; -1 where none does."""
        fails = self.failing(values)
        found: NDArray[numpy.int64] = numpy.where(fails.any(axis=0), fails.argmax(axis=0), -1)
        return found

    def verdicts(self, bounds: Bounds, is_level: Bits) -> tuple[Bits, Bits]:
        """In which boxes all checks are passed for certain, and in which one of them fails everywhere; `is_level` are
        the margins that are zero everywhere."""
        limits, is_apart = self.limits, self.is_apart
        bounds.low[is_level], bounds.high[is_level] = 0.0, 0.0
        passes = bounds.low >= limits
        passes = numpy.where(is_apart, (bounds.low > limits) | (bounds.high < -limits), passes)
        fails = numpy.where(is_apart, numpy.maximum(-bounds.low, bounds.high) <= limits, bounds.high < limits)
        return passes.all(axis=0) & bounds.is_defined, fails.any(axis=0) | bounds.is_undefined


@lru_cache(maxsize=256)
def compile_margins(system: System, follows: Follows) -> Margins:
    """The margins of a system that has a closed form as functions of one word."""
    checked = compile_checks(system)
    kept = {number: check for number, check in enumerate(checked.outputs.checks) if check.stage not in _OF_FLOATS}
    outputs = {str(number): checked.margins[number] for number in kept}
    return Margins(tuple(kept.values()), Chart(checked.tape, outputs, dict(follows)))


PLACES, LEVEL = 64, 1e-10
"""A margin below this, mm, at so many places drawn at random is zero everywhere: the checks are analytic between the
few places where a direction turns."""


class Branch(Struct, frozen=True, eq=False):
    """One of the solutions of a class: its checks as margins, and the values of their other inputs."""

    case: CaseClass
    margins: Margins
    fixed: tuple[float, ...]
    signs: tuple[tuple[str, float], ...] = ()

    def target(self, goals: Mapping[str, tuple[int, float]], most: float | None = None) -> tuple[Chart, list[float]]:
        """The distance of a coordinate from its goal as a function of the word, or half the rate at which the square of
        the distance of several grows; or with `most`, half of by how much the square of the distance is above its
        square; and the other inputs. See `goals.TargetCurve`."""
        # Coordinates count from the start point inside, which may follow the word.
        starts = {f"{ORIGIN}{axis}": self.case.moves.get(axis) for axis, _ in goals.values()}
        rates = {
            name: Following(float(start.factor) if start is not None else 0.0, is_angle=False)
            for name, start in starts.items()
        }
        follows = (*self.case.follows(), *rates.items())
        axes = tuple((name, axis) for name, (axis, _) in goals.items())
        aim = _Aim.BAND if most is not None else _Aim.RATE if len(axes) > 1 else _Aim.DISTANCE
        chart = _compile_target(self.case.system, follows, axes, aim, is_closed=self.case.is_closed)
        known = {**dict(self.signs), **dict.fromkeys(rates, 0.0), MOST: most or 0.0}
        for name, (axis, goal) in goals.items():
            start = self.case.moves.get(axis)
            known[GOAL + name] = goal - (float(start.base) if start is not None else self.case.start(axis))
        return chart, self.case.fixed(chart.fixed, known)

    def at(self, word: Array) -> Array:
        """The margins at these values of the word, by (check, place)."""
        return self.margins.chart.at(word, self.fixed)

    def slopes_at(self, word: Array) -> Array:
        """The derivatives of the margins by the word, by (check, place)."""
        return self.margins.chart.slopes_at(word, self.fixed)

    def verdicts(self, cells: Intervals, is_level: Bits, few: int = 0) -> tuple[Bits, Bits]:
        """Masks of the cells in which all checks are passed for certain, and in which one of them fails everywhere;
        where more cells than `few` are not decided, they are bounded better. `is_level` are the margins that are zero
        everywhere."""
        chart = self.margins.chart
        bounds = chart.between(cells, self.fixed)
        passes, fails = self.margins.verdicts(bounds, is_level)
        rest = ~(passes | fails) & bounds.is_smooth
        if rest.sum() > few:
            finer = chart.narrowed(bounds[rest], cells[rest], self.fixed)
            passes[rest], fails[rest] = self.margins.verdicts(finer, is_level)
        return passes, fails

    def sample(self, low: float, high: float) -> Array:
        """The margins at places drawn at random between two values of the word."""
        return self.at(numpy.random.default_rng(PLACES).uniform(low, high, PLACES))

    def find_level(self, low: float, high: float) -> Bits:
        """Mask of the margins that are zero everywhere between two values of the word, as far as there are points."""
        values = self.sample(low, high)
        exists = ~(values < self.margins.limits - LEVEL)[self.margins.is_real].any(axis=0)
        found: Bits = numpy.logical_and((numpy.abs(values[:, exists]) <= LEVEL).all(axis=1), exists.any())
        return found


class LeastMargin:
    """The least of all margins of a branch less its limit, as a function of the word whose zeros are sought."""

    fineness = finer = Fineness(64, 20, 1e-8)
    """A cell so narrow that is not decided lies at an end."""

    def __init__(self, branch: Branch, low: float, high: float) -> None:
        self.branch, self._is_level = branch, branch.find_level(low, high)

    def at(self, places: Array) -> Array:
        """The values: below zero where a check fails, or has no value."""
        values, is_apart = self.branch.at(places), self.branch.margins.is_apart
        excess = numpy.where(is_apart, numpy.abs(values), values) - self.branch.margins.limits
        excess = numpy.where(self.branch.margins.failing(values), numpy.minimum(excess, -LEAST), excess)
        found: Array = numpy.nan_to_num(excess, nan=-inf, posinf=inf, neginf=-inf).min(axis=0)
        return found

    def signs(self, cells: Intervals) -> Signs:
        """Signs for certain: 1 for all checks are passed, -1 for one of them fails."""
        passes, fails = self.branch.verdicts(cells, self._is_level, FEW)
        return numpy.where(passes, 1, numpy.where(fails, -1, 0)).astype(numpy.int8)

    def ways(self, cells: Intervals) -> Signs:
        """Nothing is known of where it rises: another margin may become the least."""
        return numpy.zeros(cells.low.size, numpy.int8)

    def part(self, low: float, high: float) -> "LeastMargin":
        """The same between two values: what is zero everywhere may be so on a part only."""
        return LeastMargin(self.branch, low, high)


FEW, LEAST = 12, 5e-324
"""Of no more cells it is quicker to divide them than to bound them better; and the least double above zero."""


def branches_of(case: CaseClass, low: float, high: float) -> tuple[Branch, ...]:
    """The branches of a class that is solved, between two values of its one free word. Raises NotClosedError without a
    closed form."""
    try:
        return _distinct(_branches(case), low, high)
    except NotClosedError:
        # Facts that are singular at their values may have another in their place, as in a single solve.
        for profile in orders_of(case.profile):
            try:
                return _distinct(_branches(replace(case, profile=profile)), low, high)
            except NotClosedError:
                continue
        raise


def _branches(case: CaseClass) -> tuple[Branch, ...]:
    follows = case.follows()
    if case.is_closed:
        margins = compile_margins(case.system, follows)
        return (Branch(case, margins, tuple(case.fixed(margins.chart.fixed))),)
    try:
        form, margins = _compile(case.system, follows, case.profile.choices)
    except NoClosedFormError as error:
        blamed = _texts(case, _givens(case, error.facts, error.unknowns)) or "the block"
        raise NotClosedError(f"{blamed}: {error.why}; {INSTEAD}") from None
    margins = replace(margins, checks=tuple(_named(form, margins.checks, case)))
    found = []
    for values in product((1.0, -1.0), repeat=len(form.signs)):
        signs = tuple(zip(form.signs, values, strict=True))
        found.append(Branch(case, margins, tuple(case.fixed(margins.chart.fixed, dict(signs))), signs))
    return tuple(found)


def _distinct(branches: Sequence[Branch], low: float, high: float) -> tuple[Branch, ...]:
    """The branches without those that are another one for all values, as the two places of the centre of a
    half circle. Raises NotClosedError where what is divided by is zero for all of them."""
    if branches[0].case.is_closed:
        return tuple(branches)
    form, found = compile_branches(branches[0].case.system), list[Branch]()
    for branch in branches:
        values = branch.sample(low, high)[: len(form.conditions)]
        again = False
        for condition, row in zip(form.conditions, values, strict=True):
            if condition.need is Need.REGULAR and (numpy.abs(row) <= REGULAR).all():
                blamed = _texts(branch.case, _givens(branch.case, condition.facts, condition.unknowns))
                raise NotClosedError(f"{blamed} do not fix what they speak about, whatever the value; {INSTEAD}")
            is_double = condition.need is Need.REAL and (numpy.abs(row) <= LEVEL).all()
            again = again or (is_double and dict(branch.signs)[condition.sign] < 0)
        if not again:
            found.append(branch)
    return tuple(found)


def _texts(case: CaseClass, givens: Sequence[str]) -> str:
    """The words and facts that state values, and those that ask."""
    stated = case.words(givens)
    asked = join(list(dict.fromkeys(question.word.text for question in case.profile.questions)))
    return f"{stated} with {asked}" if stated and asked else stated or asked


def _givens(case: CaseClass, facts: Sequence[Fact], unknowns: Sequence[str]) -> tuple[str, ...]:
    """The values that some facts state; where one states none, also what they build on."""
    found = [fact.given for fact in facts if fact.given]
    for name in unknowns if len(found) < len(facts) or not found else ():
        found += settled_by(case.profile, name)
    return tuple(dict.fromkeys(found))


def _named(form: Construction, checks: Sequence[Check], case: CaseClass) -> Iterator[Check]:
    """The checks, with the values that their conditions are about."""
    count = len(form.conditions)
    for condition, check in zip(form.conditions, checks[:count], strict=True):
        yield replace(check, givens=_givens(case, condition.facts, condition.unknowns))
    yield from checks[count:]


@lru_cache(maxsize=64)
def _compile(system: System, follows: Follows, choices: tuple[Choice, ...]) -> tuple[Construction, Margins]:
    """The closed form of a system, and the margins of all its branches as functions of one word."""
    form = compile_branches(system)
    tape = form.tape.copy()
    known = {name: tape.expression(name) for name in system.unknowns}
    measured = measured_figure(system, tape, known | at_origin(system.figure), form.path)
    facts = check_facts(measured, form.checks, map(tape.expression, form.compared))
    found = [*_conditions(form), *_sides(form, choices), *facts, check_range(measured), *check_path(measured)]
    outputs = {str(number): expression for number, (_, expression) in enumerate(found)}
    return form, Margins(tuple(each for each, _ in found), Chart(tape, outputs, dict(follows)))


class _Aim(Enum):
    """Aims for a distance from a goal: that it is zero, its least value, or that it has a given size."""

    DISTANCE = 1
    RATE = 2
    BAND = 3


@lru_cache(maxsize=256)
def _compile_target(
    system: System, follows: Follows, axes: tuple[tuple[str, int], ...], aim: _Aim, *, is_closed: bool
) -> Chart:
    """The distance of outputs of a system from a goal as a function of one word (see `Branch.target`)."""
    tape = (compile_system(system) if is_closed else compile_branches(system)).tape.copy()
    away = [tape.expression(name) + tape.input(f"{ORIGIN}{axis}") - tape.input(GOAL + name) for name, axis in axes]
    output = away[0] if aim is _Aim.DISTANCE else sum(each**2 for each in away) / 2
    if aim is _Aim.BAND:
        output -= tape.input(MOST) ** 2 / 2
    return Chart(tape, {"away": output}, dict(follows), is_rate=aim is _Aim.RATE)


def _conditions(form: Construction) -> Checks:
    for condition in form.conditions:
        test, limit = (Test.APART, REGULAR) if condition.need is Need.REGULAR else (Test.AT_LEAST, 0.0)
        if condition.need is Need.POSITIVE:
            limit = REGULAR
        margin = Check(RefusalKind.NO_POINT, ",".join(condition.unknowns), "", test, limit)
        yield margin, form.tape.expression(condition.output)


def _sides(form: Construction, choices: Sequence[Choice]) -> Checks:
    for choice, margin in side_margins(form, choices):
        givens = (choice.given,) if choice.given else ()
        yield Check(RefusalKind.NO_POINT, choice.point, "", Test.AT_LEAST, 0.0, givens), margin


def side_margins(form: Construction, choices: Sequence[Choice]) -> Iterator[tuple[Choice, Any]]:
    """The sides that the words or the form choose, each with a number that is positive there."""
    for choice in choices:
        if choice.point in form.sides:
            output, positive = form.sides[choice.point]
            value = form.tape.expression(output)
            yield choice, value if choice.side.value == positive else -value
