"""The construction of a contour: its unknowns, group by group in their order, each in closed form with its signs named.

A group is affine, a radius, a point of two known curves, or a conic on the line that affine equations leave; whatever
is none of these is searched for. One builder makes the expressions of all of them: a single solve, columns, balls and
formulas evaluate the same ones.
"""

from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from functools import lru_cache
from itertools import pairwise
from typing import Any

from msgspec import Struct

from contoursolve.geometry import (
    FIRST,
    INCREMENT_OF,
    SECOND,
    Arc,
    Fact,
    Line,
    OfCircle,
    System,
    Values,
    both,
    scalar,
)
from contoursolve.numeric import (
    SIDE,
    Compiled,
    Tape,
    affine_parts,
    at_most,
    is_affine,
    is_number,
    magnitude,
    quadratic_parts,
    sqrt,
    symbol,
    where,
)
from contoursolve.solving.compare import half_circle_allowance
from contoursolve.solving.conics import (
    Column,
    Matrix,
    Row,
    cofactor,
    determinant,
    or_none,
    or_zero,
    replaced,
    restrict,
    separate,
    total,
)
from contoursolve.solving.corners import Pair, unit
from contoursolve.solving.determinacy import analyse, groups_of
from contoursolve.solving.inputs import EXPRESSIONS, given_directions, input_values, named_inputs
from contoursolve.solving.partition import Group
from contoursolve.solving.path_outputs import PathOutputs
from contoursolve.solving.step_outputs import Need, StepOutputs
from contoursolve.tolerance import TOUCHING

MOST_SIGNS = 6
"""Roots and sides with two signs each; every one doubles the solutions."""

MOST_ROWS = 6
"""Affine equations that are solved at once, by determinants."""


class NoClosedFormError(Exception):
    """A group without a closed form, or that is not looked at as one: why, its facts and its unknowns."""

    def __init__(self, why: str, facts: Sequence[Fact], unknowns: Sequence[str]) -> None:
        super().__init__(f"{', '.join(map(str, facts))} for {', '.join(unknowns)}: {why}")
        self.why, self.facts, self.unknowns = why, tuple(facts), tuple(unknowns)


class StepKind(Enum):
    """The ways in which a group of a construction is closed."""

    AFFINE = "one or two unknowns from as many facts that are affine in them"
    RADIUS = "a radius as the distance from a known centre to a known point"
    LINE_CIRCLE = "a point on a known circle and on a known line: nearer or farther along the line"
    TWO_CIRCLES = "a point of two known circles, or the centre of a circle of known radius through two known points"
    """Left or right of the way from the first centre to the second."""
    GENERAL = "affine equations and at most one conic, on whichever of its places"


class ConstructionStep(Struct, frozen=True):
    """One group of a construction: its facts, its unknowns, and how it is closed."""

    kind: StepKind
    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]

    @property
    def circles(self) -> tuple[OfCircle, ...]:
        """The circles on which its point lies."""
        return tuple(fact.circle for fact in self.facts if fact.circle)

    @property
    def of_circles(self) -> tuple[Fact, ...]:
        """The facts that put it there."""
        return tuple(fact for fact in self.facts if fact.circle)

    @property
    def of_line(self) -> Fact:
        """The fact that puts its point on a line."""
        return next(fact for fact in self.facts if fact.heading or fact.collinear)

    @property
    def has_two_places(self) -> bool:
        """Whether somebody must choose between two places of its point, by the side that has a name."""
        return self.kind in (StepKind.LINE_CIRCLE, StepKind.TWO_CIRCLES)

    @property
    def point(self) -> str:
        """The point that it finds."""
        return self.unknowns[0].rpartition(".")[0]

    @property
    def centers(self) -> tuple[str, ...]:
        """The known points from which its point lies at known distances."""
        return tuple(circle.center if circle.point == self.point else circle.point for circle in self.circles)

    @property
    def is_equal(self) -> bool:
        """Whether both distances are the same radius, so that its point is a centre."""
        return self.kind is StepKind.TWO_CIRCLES and self.circles[0].radius == self.circles[1].radius

    def lines_through(self) -> Iterator[tuple[str, str]]:
        """The two known points of each line through two points on which it finds a third."""
        for fact in self.facts if self.kind in (StepKind.AFFINE, StepKind.LINE_CIRCLE) else ():
            if fact.collinear:
                tail, through, point = fact.collinear
                is_found = not set(self.unknowns).isdisjoint(both(through))
                yield tail, point if is_found else through


class SideCondition(Struct, frozen=True):
    """A condition on a solution besides the equations: the output that is compared with zero, the facts that it is
    about, the unknowns that they give, and the sign of a root."""

    need: Need
    output: str
    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]
    sign: str = ""


class Construction(Struct, frozen=True, eq=False):
    """The steps of a system with the function that takes all of them, and the names of outputs that come in numbers."""

    steps: tuple[ConstructionStep, ...]
    basis: tuple[Fact, ...]
    checks: tuple[Fact, ...]
    """The facts that are not needed."""
    function: Compiled
    measures: tuple[StepOutputs, ...]
    """The names of the outputs of each step."""
    residuals: tuple[str, ...]
    """The names of the residuals of the basis, but for what the words of a half circle are exact to."""
    compared: tuple[str, ...]
    """The names of the residuals of the facts that are not needed."""
    slopes: tuple[tuple[int, int, str], ...]
    """(row, column, output) of the Jacobian of the basis by the unknowns."""
    path: PathOutputs
    """The names of the outputs that measure the path."""
    tape: Tape
    """All expressions, from which balls, columns and formulas are made."""
    signs: tuple[str, ...] = ()
    """The inputs, each +1 or -1, that tell its solutions apart."""
    conditions: tuple[SideCondition, ...] = ()
    """The conditions on each solution, where it was built for all signs."""
    sides: Mapping[str, tuple[str, str]] = {}
    """By the point between whose places a control chooses: the output that tells on which side it lies, and the name of
    the side where that is positive."""


@lru_cache(maxsize=8192)
def steps_of(system: System) -> tuple[ConstructionStep, ...]:
    """The steps of a determined system in their order."""
    groups, counted = _starts_first(groups_of(system), system)
    kinds = (StepKind.GENERAL if group in counted else _kind(group, system) for group in groups)
    return tuple(ConstructionStep(kind, *group) for kind, group in zip(kinds, groups, strict=True))


@lru_cache(maxsize=8192)
def is_closed(system: System) -> bool:
    """Whether a determined system has one function: a closed form in which each sign has a name."""
    return not _sides_of(system) and all(step.kind is not StepKind.GENERAL for step in steps_of(system))


def named_steps(system: System) -> tuple[ConstructionStep, ...]:
    """The steps of a system that is closed.

    Raises NoClosedFormError if it is not, ValueError if the system is not determined.
    """
    verdict = analyse(system)
    if not verdict.is_determined:
        raise ValueError(f"not determined: {', '.join(verdict.free)}")
    steps = steps_of(system)
    for step in () if is_closed(system) else steps:
        if step.kind is StepKind.GENERAL:
            raise NoClosedFormError("its signs have no names", step.facts, step.unknowns)
    if not is_closed(system):
        raise NoClosedFormError("on which sides they touch is open", system.facts, system.unknowns)
    return steps


def _sides_of(system: System) -> list[str]:
    return [side for fact in system.facts for side in fact.sides()]


@lru_cache(maxsize=8192)
def points_with_two_solutions(system: System) -> tuple[str, ...]:
    """The points of a system that is closed for which somebody must choose between two solutions."""
    return tuple(step.point for step in steps_of(system) if step.has_two_places)


def _starts_first(groups: Sequence[Group], system: System) -> tuple[Sequence[Group], Sequence[Group]]:
    """The groups in such an order that the start of an arc is known where an intersection is counted from it; and those
    for which there is no such order."""
    arcs = [element for element in system.figure.path if isinstance(element, Arc)]
    starts = {second.tail: first.tail for first, second in pairwise(arcs) if second.counts_clockwise}
    if not starts:
        return groups, ()
    rest, found, known = list(groups), [], {*system.unknowns} - {name for each in groups for name in each.unknowns}
    while rest:
        for group in rest:
            needed = {name for fact in group.facts for name in system.unknowns_of(fact)}
            counted = [start for point, start in starts.items() if {*both(point)} == {*group.unknowns}]
            needed |= {name for start in counted for name in both(start) if name in system.unknowns}
            if needed - {*group.unknowns} <= known:
                break
        else:
            return groups, rest
        rest.remove(group)
        found.append(group)
        known |= {*group.unknowns}
    return found, ()


def _kind(group: Group, system: System) -> StepKind:
    circles = [fact.circle for fact in group.facts if fact.circle]
    lines = [fact for fact in group.facts if fact.heading or fact.collinear]
    unknowns, size = set(group.unknowns), len(group.facts)
    if not circles:
        # Of two, a refusal can tell what they say against each other.
        if size <= 2 and all(_is_affine(fact, unknowns, system) for fact in group.facts):  # noqa: PLR2004
            return StepKind.AFFINE
    elif size == 1 and unknowns == {circles[0].radius}:
        return StepKind.RADIUS
    elif len(circles) == len(lines) == 1 and unknowns == {*both(circles[0].point)}:
        return StepKind.LINE_CIRCLE
    elif len(circles) == size == 2:  # noqa: PLR2004
        for point in (circles[0].center, circles[0].point):
            if unknowns == {*both(point)} and point in (circles[1].center, circles[1].point):
                return StepKind.TWO_CIRCLES
    return StepKind.GENERAL


def _is_affine(fact: Fact, unknowns: set[str], system: System) -> bool:
    """Whether a fact is affine in unknowns while everything else is known."""
    if fact.placed or fact.heading:
        return True
    if fact.collinear:
        # Affine in either of two points, at which the line may be taken to end.
        tail, *others = (not unknowns.isdisjoint(both(point)) for point in fact.collinear)
        return not tail and not all(others)
    tape = Tape()
    residual = fact.residual(input_values(system.headed, tape, {}))
    return is_affine([residual], [tape.input(name) for name in sorted(unknowns)])


Measured = tuple[Sequence[Any], StepOutputs]
"""The unknowns of a step, and what is measured of it."""


class Builder:
    """The expressions of a system under construction: `run` takes a step, from the values of those before."""

    def __init__(self, system: System, touching: float = TOUCHING) -> None:
        self.system, self.touching = system, touching
        self.tape = Tape()
        self.scalars: dict[str, Any] = {}
        for axis in (FIRST, SECOND):
            name = scalar(system.figure.start, axis)
            self.scalars[name] = self.tape.input(name)
        self.amounts = named_inputs(self.tape)
        self.directions = given_directions(self.tape)
        self.short: dict[str, Any] = {}
        """By how much stated radii of half circles are less than their points say."""
        self.measures: list[StepOutputs] = []
        """The names of the outputs of each step so far."""
        self.signs: list[str] = []
        self.conditions: list[SideCondition] = []

    def at(self, symbols: Mapping[str, Any] | None = None) -> Values:
        """A lookup of all that is known so far, with symbols for other unknowns."""
        # A copy for each step of a long chain is a walk over all of it.
        scalars = {**self.scalars, **symbols} if symbols else self.scalars
        sides = named_inputs(self.tape, prefix=SIDE)
        return Values(scalars, self.amounts, self.directions, self.system.headed, sides, EXPRESSIONS)

    def point(self, name: str) -> Pair:
        """The coordinates of a point, mm."""
        at = self.at()
        return at.coordinate(name, FIRST), at.coordinate(name, SECOND)

    def radius(self, name: str) -> Any:
        """A radius, mm."""
        return self.at().radius(name)

    def run(self, step: ConstructionStep) -> None:
        """Declare the unknowns of the next step, and what must hold of it."""
        for side in dict.fromkeys(SIDE + side for fact in step.facts for side in fact.sides()):
            if side not in self.signs:
                self.signs.append(side)
        match step.kind:
            case StepKind.AFFINE:
                values, measures = self._linear(step)
            case StepKind.RADIUS:
                (circle,) = step.circles
                (x, y), (cx, cy) = self.point(circle.point), self.point(circle.center)
                values, measures = [sqrt((x - cx) ** 2 + (y - cy) ** 2)], StepOutputs()
            case StepKind.LINE_CIRCLE:
                values, measures = self._line_circle(step)
            case StepKind.TWO_CIRCLES:
                values, measures = self._two_circles(step)
            case StepKind.GENERAL:
                values, measures = self._general(step)
        named = measures.named(len(self.measures), self.tape.output)
        self.measures.append(named)
        for need, output in named.conditions():
            self._need(need, output, step.facts, step.unknowns, self.signs[-1] if need is Need.REAL else "")
        self.scalars.update(zip(step.unknowns, values, strict=True))
        for name in step.unknowns:
            if name in self.system.figure.radii:
                self.tape.output(name, self.scalars[name])
                self._need(Need.POSITIVE, name, step.facts, (name,))

    def _need(self, need: Need, output: str, facts: Sequence[Fact], unknowns: Sequence[str], sign: str = "") -> None:
        self.conditions.append(SideCondition(need, output, tuple(facts), tuple(unknowns), sign))

    def _linear(self, step: ConstructionStep) -> Measured:
        """Facts that are affine as they are, so that their determinant is that of directions."""
        symbols = {name: symbol(name) for name in step.unknowns}
        self.scalars.update(symbols)
        at = self.at()
        entries, constants = affine_parts(
            [fact.affine_in(symbols.keys()).residual(at) for fact in step.facts], list(symbols.values())
        )
        matrix = [list(map(or_none, row)) for row in entries]
        measures = StepOutputs(tuple(map(tuple, entries)), tuple(constants), or_zero(determinant(matrix)))
        return _by_determinants(matrix, list(map(or_none, constants)), measures.determinant), measures

    def _line_circle(self, step: ConstructionStep) -> Measured:
        """Foot of the perpendicular from the centre, then half the chord forward or back."""
        through, (first, second) = self._line_of(step)
        (circle,), center = step.circles, self.point(step.centers[0])
        radius = self.radius(circle.radius)
        offset = (through[0] - center[0]) * -second + (through[1] - center[1]) * first
        gap, discriminant = radius - offset, (radius - offset) * (radius + offset)
        scale = self._band(radius + sum(magnitude(value) for value in (*center, *through)))
        measures = StepOutputs(discriminant=discriminant, offset=offset, radius=radius, gap=gap, scale=scale)
        half = self._root(step, measures, magnitude(offset) - radius)
        lines = (each for each in self.system.figure.path if isinstance(each, Line) and each.counts_length)
        if any(step.point in (line.tail, line.head) for line in lines):
            # The longer line leads to the point beyond the foot of the perpendicular.
            ahead = (center[0] - through[0]) * first + (center[1] - through[1]) * second
            half = half * (2 * at_most(0, ahead) - 1)
        values = center[0] - second * offset + first * half, center[1] + first * offset + second * half
        return values, measures

    def _line_of(self, step: ConstructionStep) -> tuple[Pair, Pair]:
        """A known point of a step's line, and the line's direction."""
        line = step.of_line
        if line.heading:
            tail, head = line.heading
            return self.point(tail if head == step.point else head), self.directions[line.given]
        begin, end = map(self.point, next(step.lines_through()))
        return begin, unit((end[0] - begin[0], end[1] - begin[1]))

    def _two_circles(self, step: ConstructionStep) -> Measured:
        """Along the line of centres to the common chord, then along it to the left or to the right."""
        first, second = map(self.point, step.centers)
        one, other = (self.radius(circle.radius) for circle in step.circles)
        chord = second[0] - first[0], second[1] - first[1]
        length = sqrt(chord[0] ** 2 + chord[1] ** 2)
        # With one radius, exactly the middle.
        offset = length / 2 if step.is_equal else (length + (one - other) * (one + other) / length) / 2
        scale = one + other + sum(magnitude(value) for value in (*first, *second))
        half = self._half_circle(step.circles[0].radius, offset, chord, scale) if step.is_equal else None
        if half is None:
            short, gap, apart = None, one - offset, magnitude(offset) - one
        else:
            one, short, gap = half
            apart = gap
        measures = StepOutputs(
            short=short,
            distance=length,
            discriminant=gap * (one + offset),
            offset=offset,
            radius=one,
            gap=gap,
            scale=self._band(scale),
        )
        root = self._root(step, measures, apart)
        along, rise = offset / length, root * self._sense(step) / length
        return (first[0] + along * chord[0] - rise * chord[1], first[1] + along * chord[1] + rise * chord[0]), measures

    def _sense(self, step: ConstructionStep) -> Any:
        """+1 where the positive side of an intersection is the left one, -1 where it is the right one."""
        for before, after in pairwise(self.system.figure.path):
            if isinstance(after, Arc) and after.counts_clockwise and after.tail == step.point:
                (a, b), (c, d) = self.point(before.tail), self.point(after.center)
                return 2 * at_most(self.radius(after.radius) ** 2, (c - a) ** 2 + (d - b) ** 2) - 1
        return 1

    def _half_circle(self, name: str, half: Any, chord: Pair, scale: Any) -> tuple[Any, Any, Any] | None:
        """The radius of a circle through two points, half of whose distance may be more than the radius by as little as
        the words are exact to: then it is a half circle, and as large as the points say. By how much it is less, and
        what is left of it beyond the half. None where no word states the radius."""
        radius = self.radius(name)
        given = next((fact.given for fact in self.system.facts if fact.sizes == name), "")
        if not given:
            return None
        give = half_circle_allowance(chord, 2 * half, given, lambda key: self.tape.input(INCREMENT_OF + key), magnitude)
        # From where it is a touching one for floats as well, so that no value lies between.
        rounding = self.touching * scale / 2
        short = half - radius
        is_short = magnitude(short - (give + rounding) / 2) <= (give - rounding) / 2
        self.short[name] = where(is_short, short, 0)
        self.scalars[name] = where(is_short, half, radius)
        return self.scalars[name], self.short[name], where(is_short, 0, radius - half)

    def _band(self, scale: Any) -> Any:
        """The size of which a share may be rounding."""
        return scale

    def _root(self, step: ConstructionStep, measures: StepOutputs, apart: Any) -> Any:
        """The root of a discriminant with its sign; 0 where floats cannot tell that a circle is more than touched."""
        is_touching = magnitude(apart) <= self.touching * measures.scale
        return self._sign(SIDE + step.point) * self._spread(measures.discriminant, is_touching)

    def _spread(self, discriminant: Any, is_touching: Any) -> Any:
        """The root of a discriminant, without its sign."""
        return where(is_touching, 0, sqrt(discriminant))

    def _sign(self, name: str) -> Any:
        """The input that chooses between the two places of a step."""
        self.signs.append(name)
        return self.tape.input(name)

    def _general(self, step: ConstructionStep) -> Measured:
        """The unknowns of affine equations, and of at most one conic on the line that these leave."""
        symbols = {name: symbol(name) for name in step.unknowns}
        self.scalars.update(symbols)
        at, size = self.at(), len(step.unknowns)
        parts = quadratic_parts([fact.equation(at) for fact in step.facts], list(symbols.values()))
        if parts is None:
            raise NoClosedFormError("they have no closed form together", step.facts, step.unknowns)
        rows: list[Row] = [{} for _ in step.facts]
        for (row, monomial), value in parts.items():
            if not is_number(value, 0):
                rows[row][monomial] = value
        affine, curved = separate(rows)
        if len(curved) > 1 or size > MOST_ROWS:
            raise NoClosedFormError("they have no closed form together", step.facts, step.unknowns)
        matrix = [[row.get((column,)) for column in range(size)] for row in affine]
        constants = [row.get(()) for row in affine]
        if curved:
            return self._on_line(matrix, constants, curved[0], step)
        found = determinant(matrix)
        if found is None:
            raise NoClosedFormError("they do not fix what they speak about", step.facts, step.unknowns)
        return _by_determinants(matrix, constants, found), StepOutputs(determinant=found)

    def _on_line(self, matrix: Matrix, constants: Column, curve: Row, step: ConstructionStep) -> Measured:
        """The two places of a conic on the line on which affine equations hold."""
        size = len(step.unknowns)
        way = [cofactor(matrix, column) for column in range(size)]
        if all(each is None for each in way):
            raise NoClosedFormError("they do not fix what they speak about", step.facts, step.unknowns)
        square = total(each * each for each in way if each is not None)
        whole: Matrix = [*matrix, way]
        through = [or_zero(replaced(whole, [*constants, None], column)) / square for column in range(size)]
        along = list(map(or_zero, way))
        leading, middle, last = restrict(curve, along, through)
        half, rest = middle / (2 * leading), last / leading
        discriminant = half * half - rest
        far = self._sign(f"root:{','.join(step.unknowns)}") * self._spread(discriminant, discriminant <= 0) - half
        values = [one + far * each for one, each in zip(through, along, strict=True)]
        regular = sqrt(square) if size > 1 else None
        return values, StepOutputs(determinant=regular, leading=leading, discriminant=discriminant)


def _by_determinants(matrix: Matrix, constants: Column, found: Any) -> list[Any]:
    """The unknowns of affine equations with this determinant."""
    return [or_zero(replaced(matrix, constants, column)) / found for column in range(len(matrix))]
