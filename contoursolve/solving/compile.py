"""One CasADi function for one combination of words: points, residuals, determinants and corner room."""

from functools import lru_cache
from itertools import pairwise
from math import tau
from typing import Any

from msgspec import Struct

from contoursolve.geometry import (
    FIRST,
    INCREMENT_OF,
    SECOND,
    Arc,
    Collinear,
    Corner,
    Fact,
    Heading,
    Line,
    OnCircle,
    Radius,
    System,
    Values,
    scalar,
)
from contoursolve.numeric import (
    Compiled,
    Functions,
    Replay,
    Tape,
    affine_parts,
    angle,
    at_most,
    ball,
    cosine as cosine_of,
    is_zero,
    jacobian_parts,
    magnitude,
    sign,
    sine as sine_of,
    sqrt,
    symbol,
    where,
)
from contoursolve.solving.compare import half_circle_allowance
from contoursolve.solving.corners import Edge, Pair, build_corner, drop_straight, unit
from contoursolve.solving.determinacy import spare_of
from contoursolve.solving.inputs import given_directions, named_inputs
from contoursolve.solving.plan import AffineStep, DistanceStep, LineCircleStep, Plan, Step, TwoCirclesStep, make_plan
from contoursolve.tolerance import LENGTH, REGULAR, TOUCHING

_FUNCTIONS = Functions(sqrt, cosine_of, sine_of)


class _Builder:
    def __init__(self, system: System, touching: float = TOUCHING) -> None:
        self.system, self.touching = system, touching
        self.tape = Tape()
        self.scalars: dict[str, Any] = {}
        for axis in (FIRST, SECOND):
            name = scalar(system.figure.start, axis)
            self.scalars[name] = self.tape.input(name)
        self.compared = {(fact.point, fact.center) for fact in spare_of(system) if isinstance(fact, OnCircle)}
        """Points that are compared with a circle that others determine, with its centre."""
        self.short: dict[str, Any] = {}
        """By how much stated radii of half circles are less than their points say."""
        self.rooms: dict[str, Any] = {}
        """What the corners leave of each element."""
        self.amounts = named_inputs(self.tape)
        self.directions = given_directions(self.tape)

    def at(self, scalars: dict[str, Any]) -> Values:
        return Values(scalars, self.amounts, self.directions, self.system.headed, functions=_FUNCTIONS)

    def point(self, name: str) -> Pair:
        return self.scalars[scalar(name, FIRST)], self.scalars[scalar(name, SECOND)]

    def set_point(self, name: str, value: Pair) -> None:
        self.scalars[scalar(name, FIRST)], self.scalars[scalar(name, SECOND)] = value

    def run(self, step: Step, number: int) -> None:
        match step:
            case AffineStep():
                self._affine(step, number)
            case DistanceStep(circle):
                (x, y), (cx, cy) = self.point(circle.point), self.point(circle.center)
                self.scalars[circle.radius] = sqrt((x - cx) ** 2 + (y - cy) ** 2)
            case LineCircleStep():
                self._line_circle(step, number)
            case TwoCirclesStep():
                self._two_circles(step, number)

    def _affine(self, step: AffineStep, number: int) -> None:
        symbols = {name: symbol(name) for name in step.unknowns}
        lookup = self.at({**self.scalars, **symbols})
        matrix, constants = affine_parts(
            [_affine(fact, step).residual(lookup) for fact in step.facts], [symbols[name] for name in step.unknowns]
        )
        if len(step.unknowns) == 1:
            determinant = matrix[0][0]
            solution = [-constants[0] / determinant]
        else:
            (a, b), (c, d) = matrix
            determinant = a * d - b * c
            solution = [
                (b * constants[1] - d * constants[0]) / determinant,
                (c * constants[0] - a * constants[1]) / determinant,
            ]
        self.scalars.update(zip(step.unknowns, solution, strict=True))
        self.tape.output(f"determinant:{number}", determinant)
        for row, constant in enumerate(constants):
            self.tape.output(f"constant:{number}:{row}", constant)
            for column, entry in enumerate(matrix[row]):
                self.tape.output(f"entry:{number}:{row}:{column}", entry)

    def _line_circle(self, step: LineCircleStep, number: int) -> None:
        """Foot of the perpendicular from the centre, then half the chord forward or back."""
        through, (first, second) = self._line_of(step)
        center, radius = self.point(step.circle.center), self.scalars[step.circle.radius]
        offset = (through[0] - center[0]) * -second + (through[1] - center[1]) * first
        scale = radius + sum(magnitude(value) for value in (*center, *through))
        root = self._root((radius - offset) * (radius + offset), offset, radius, scale, number)
        half = self.tape.input(f"side:{step.circle.point}") * root
        lines = (each for each in self.system.figure.path if isinstance(each, Line) and each.counts_length)
        if any(step.circle.point in (line.tail, line.head) for line in lines):
            # The longer line leads to the point beyond the foot of the perpendicular.
            ahead = (center[0] - through[0]) * first + (center[1] - through[1]) * second
            half = half * (2 * at_most(0, ahead) - 1)
        self.set_point(
            step.circle.point,
            (center[0] - second * offset + first * half, center[1] + first * offset + second * half),
        )

    def _line_of(self, step: LineCircleStep) -> tuple[Pair, Pair]:
        """A known point of a step's line, and the line's direction."""
        if isinstance(step.line, Heading):
            other = step.line.tail if step.line.head == step.circle.point else step.line.head
            return self.point(other), self.directions[step.line.given]
        tail, through = self.point(step.line.tail), self.point(step.line.through)
        return tail, unit((through[0] - tail[0], through[1] - tail[1]))

    def _two_circles(self, step: TwoCirclesStep, number: int) -> None:
        """Along the line of centres to the common chord, then along it to the left or to the right."""
        first, second = (self.point(center) for center in step.centers)
        one, other = (self.scalars[circle.radius] for circle in (step.first, step.second))
        chord = second[0] - first[0], second[1] - first[1]
        length = sqrt(chord[0] ** 2 + chord[1] ** 2)
        # With one radius, exactly the middle.
        offset = length / 2 if step.is_equal else (length + (one - other) * (one + other) / length) / 2
        scale = one + other + sum(magnitude(value) for value in (*first, *second))
        if step.is_equal:
            one = other = self._half_circle(step.first.radius, offset, chord, scale, number)
        gap = self.tape.expression(f"gap:{number}") if f"gap:{number}" in self.tape.outputs else one - offset
        root = self._root(gap * (one + offset), offset, one, scale, number)
        along, rise = offset / length, self.tape.input(f"side:{step.point}") * self._sense(step) * root / length
        self.set_point(
            step.point,
            (first[0] + along * chord[0] - rise * chord[1], first[1] + along * chord[1] + rise * chord[0]),
        )
        self.tape.output(f"distance:{number}", length)

    def _sense(self, step: TwoCirclesStep) -> Any:
        """+1 where the positive side of an intersection is the left one, -1 where it is the right one."""
        for before, after in pairwise(self.system.figure.path):
            if isinstance(after, Arc) and after.counts_clockwise and after.tail == step.point:
                (a, b), (c, d) = self.point(before.tail), self.point(after.center)
                return 2 * at_most(self.scalars[after.radius] ** 2, (c - a) ** 2 + (d - b) ** 2) - 1
        return 1

    def _half_circle(self, name: str, half: Any, chord: Pair, scale: Any, number: int) -> Any:
        """The radius of a circle through two points, half of whose distance may be more than the radius by as little as
        the words are exact to: then it is a half circle, and as large as the points say. By how much is `short`."""
        radius = self.scalars[name]
        given = next((fact.given for fact in self.system.facts if isinstance(fact, Radius) and fact.radius == name), "")
        if not given:
            return radius
        give = half_circle_allowance(chord, 2 * half, given, lambda key: self.tape.input(INCREMENT_OF + key), magnitude)
        # From where it is a touching one for floats as well, so that no value lies between.
        rounding = self.touching * scale / 2
        short = half - radius
        is_short = magnitude(short - (give + rounding) / 2) <= (give - rounding) / 2
        self.short[name] = where(is_short, short, 0)
        self.tape.output(f"short:{number}", self.short[name])
        self.tape.output(f"gap:{number}", where(is_short, 0, radius - half))
        self.scalars[name] = where(is_short, half, radius)
        return self.scalars[name]

    def _root(self, discriminant: Any, offset: Any, radius: Any, scale: Any, number: int) -> Any:
        """The root of a discriminant; 0 where floats cannot tell that a circle is more than touched."""
        self.tape.output(f"discriminant:{number}", discriminant)
        self.tape.output(f"offset:{number}", offset)
        self.tape.output(f"scale:{number}", scale)
        self.tape.output(f"radius:{number}", radius)
        gap = f"gap:{number}"
        apart = self.tape.expression(gap) if gap in self.tape.outputs else magnitude(offset) - radius
        is_touching = magnitude(apart) <= self.touching * scale
        return where(is_touching, 0, sqrt(discriminant))

    def outputs(self, plan: Plan) -> tuple[tuple[int, int, str], ...]:
        """The unknowns, the residuals of all facts, and the Jacobian of the basis."""
        for name in self.system.unknowns:
            self.tape.output(name, self.scalars[name])
        lookup = self.at(self.scalars)
        for number, fact in enumerate((*plan.basis, *plan.checks)):
            self.tape.output(f"residual:{number}", fact.residual(lookup))
            if isinstance(fact, Radius) and fact.radius in self.short:
                self.tape.output(f"excess:{number}", fact.residual(lookup) - self.short[fact.radius])
        symbols = {name: symbol(name) for name in self.system.unknowns}
        entries = jacobian_parts(
            [fact.residual(self.at({**self.scalars, **symbols})) for fact in plan.basis],
            list(symbols.values()),
            [self.scalars[name] for name in self.system.unknowns],
        )
        slopes = tuple((row, column, f"slope:{row}:{column}") for row, column in entries)
        for row, column, name in slopes:
            self.tape.output(name, entries[row, column])
        return slopes

    def path(self) -> tuple[str, ...]:
        """Direction and length of each element, and every corner; the names of the corners' residuals."""
        residuals: list[str] = []
        path = self.system.figure.path
        leaving = {element.name: self._edge(element, element.tail) for element in path}
        arriving = {element.name: self._edge(element, element.head) for element in path}
        for element in path:
            self._measure(element, leaving[element.name])
        places = {element.name: index for index, element in enumerate(path)}
        for corner in self.system.figure.corners:
            index = places[corner.before]
            before, earlier = arriving[corner.before], arriving[path[max(index - 1, 0)].name]
            if corner.after is not None:
                after = leaving[corner.after]
                quadrant = _quadrant_between(before.direction, after.direction)
                if before.spoke is None and after.spoke is None:
                    start, end = self.point(path[index].tail), self.point(path[index + 1].head)
                    quadrant = sign(end[FIRST] - start[FIRST]), sign(end[SECOND] - start[SECOND])
            elif corner.lands_on is not None:
                after = Edge(self._direction_beside(self.system.figure.line(corner.lands_on)))
                quadrant = _quadrant_between(before.direction, after.direction)
            else:
                # It goes on the way its line advances on each axis, and a component that is zero is taken from the
                # line before (YASNAC LX3, Tables 2.35 and 2.36).
                quadrant = _quadrant(before, earlier)
                along = FIRST if corner.lands_parallel_to == FIRST else SECOND
                after = Edge((quadrant[FIRST], 0) if along == FIRST else (0, quadrant[SECOND]))
                self.tape.output(f"landing:{corner.name}", quadrant[along])
            residuals += self._corner(corner, before, after, quadrant)
        for element in path:
            self.tape.output(f"room:{element.name}", self.rooms[element.name])
        return tuple(residuals)

    def _edge(self, element: Line | Arc, at: str) -> Edge:
        """How an element passes one of its ends."""
        if isinstance(element, Line):
            return Edge(self._direction(element))
        center, point = self.point(element.center), self.point(at)
        spoke = point[0] - center[0], point[1] - center[1]
        outward = unit(spoke)
        turn = element.turn.sign
        radius = self.scalars[element.radius]
        if (at, element.center) in self.compared:
            # It may be off the circle by as much as the control allows; a corner there is cut from the arc as it ends.
            radius = sqrt(spoke[0] ** 2 + spoke[1] ** 2)
        return Edge((-turn * outward[1], turn * outward[0]), spoke, radius, turn)

    def _measure(self, element: Line | Arc, edge: Edge) -> None:
        """The length of an element; of a line along its direction, so that a reversed one is negative."""
        tail, head = self.point(element.tail), self.point(element.head)
        if isinstance(element, Line):
            step = head[0] - tail[0], head[1] - tail[1]
            length = step[0] * edge.direction[0] + step[1] * edge.direction[1]
            if element.heading is None and element.toward is None:
                length = sqrt(step[0] ** 2 + step[1] ** 2)
        else:
            (a, b), (c, d) = edge.spoke or (0, 0), self._edge(element, element.head).spoke or (0, 0)
            swept = element.turn.sign * angle(a * d - b * c, a * c + b * d)
            length = edge.radius * where(swept > 0, swept, swept + tau)
            if element.may_be_full:
                chord = sqrt((head[0] - tail[0]) ** 2 + (head[1] - tail[1]) ** 2)
                length = where(chord > LENGTH, length, edge.radius * tau)
        self.tape.output(f"length:{element.name}", length)
        self.rooms[element.name] = length

    def _direction(self, line: Line) -> Pair:
        if line.heading is not None:
            cosine, sine = self.directions[line.heading]
            return cosine, sine
        tail, head = self.point(line.tail), self.point(line.toward or line.head)
        return unit((head[0] - tail[0], head[1] - tail[1]))

    def _direction_beside(self, line: Line) -> Pair:
        """The direction of a line beside the path, which is stated or leads to a place."""
        if line.heading is not None:
            return self._direction(line)
        at = self.at(self.scalars)
        tail, head = self.point(line.tail), (at.coordinate(line.head, FIRST), at.coordinate(line.head, SECOND))
        step = head[FIRST] - tail[FIRST], head[SECOND] - tail[SECOND]
        self.tape.output(f"length:{line.name}", sqrt(step[0] ** 2 + step[1] ** 2))
        return unit(step)

    def _corner(self, corner: Corner, before: Edge, after: Edge, quadrant: Pair) -> list[str]:
        size, name = self.tape.input(corner.size), corner.name
        built = build_corner(corner.shape, self.point(corner.at), before, after, size, quadrant)
        if corner.guard:
            built = drop_straight(built, self.point(corner.at), corner.guard)
        self.tape.output(f"setback-in:{name}", built.setback_in)
        self.tape.output(f"setback-out:{name}", built.setback_out)
        self.rooms[corner.before] -= built.setback_in
        if corner.after is not None:
            self.rooms[corner.after] -= built.setback_out
        self.tape.output(f"turn:{name}", built.turn)
        self.tape.output(f"cosine:{name}", built.cosine)
        for axis in (FIRST, SECOND):
            self.tape.output(f"begin:{name}.{axis}", built.begin[axis])
            self.tape.output(f"end:{name}.{axis}", built.end[axis])
            if built.center is not None:
                self.tape.output(f"center:{name}.{axis}", built.center[axis])
        residuals = {f"corner-residual:{name}:{number}": each for number, each in enumerate(built.residuals)}
        for output, residual in residuals.items():
            self.tape.output(output, residual)
        return list(residuals)


def _affine(fact: Fact, step: AffineStep) -> Fact:
    """A fact in the form in which it is affine in the unknowns of a step."""
    if isinstance(fact, Collinear) and {scalar(fact.through, axis) for axis in (FIRST, SECOND)} & {*step.unknowns}:
        # The same line, through the point that is known.
        return Collinear(fact.tail, fact.point, fact.through)
    return fact


def _quadrant(edge: Edge, other: Edge) -> Pair:
    """The way an edge advances on each axis; a component that is zero is taken from the other edge."""
    first, second = (
        where(is_zero(edge.direction[axis]), sign(other.direction[axis]), sign(edge.direction[axis]))
        for axis in (FIRST, SECOND)
    )
    return first, second


def _quadrant_between(arriving: Pair, leaving: Pair) -> Pair:
    """The way between two directions on each axis, as `MeetsLine` says; where they cancel, that of the first."""
    between = arriving[FIRST] + leaving[FIRST], arriving[SECOND] + leaving[SECOND]
    first, second = (
        where(magnitude(between[axis]) <= REGULAR, sign(arriving[axis]), sign(between[axis]))
        for axis in (FIRST, SECOND)
    )
    return first, second


class Machine(Struct, frozen=True):
    """The plan of a system with its function, and the names of those outputs that come in numbers."""

    plan: Plan
    function: Compiled
    residuals: tuple[str, ...]
    """Of the basis, but for what the words of a half circle are exact to."""
    slopes: tuple[tuple[int, int, str], ...]
    """(row, column, output) of the Jacobian of the basis by the unknowns."""
    corner_residuals: tuple[str, ...]
    tape: Tape
    """All expressions, from which the proof makes a function of its own."""


@lru_cache(maxsize=4096)
def compile_system(system: System) -> Machine:
    """The function of a determined system; one for each combination of words."""
    return _compile(_Builder(system))


@lru_cache(maxsize=64)
def compile_plainly(system: System) -> Machine:
    """The same for formulas that a control evaluates: a line that touches a circle is nothing of its own."""
    return _compile(_PlainBuilder(system, touching=0.0))


class _PlainBuilder(_Builder):
    def _root(self, discriminant: Any, offset: Any, radius: Any, scale: Any, number: int) -> Any:
        super()._root(discriminant, offset, radius, 0 * scale, number)
        return sqrt(discriminant)


def _compile(builder: _Builder) -> Machine:
    plan = make_plan(builder.system)
    for number, step in enumerate(plan.steps):
        builder.run(step, number)
    slopes = builder.outputs(plan)
    outputs = builder.tape.outputs
    excesses = [f"excess:{number}" for number in range(len(plan.basis))]
    residuals = tuple(f"residual:{n}" if name not in outputs else name for n, name in enumerate(excesses))
    corner_residuals = builder.path()
    return Machine(plan, builder.tape.finish(), residuals, slopes, corner_residuals, builder.tape)


class PathMachine(Struct, frozen=True):
    """The path of a figure as a function of its points, whatever they were found from."""

    function: Compiled
    corner_residuals: tuple[str, ...]
    tape: Tape


class ProofMachine(Struct, frozen=True):
    """The closed form of a system in exact numbers and balls, with the names of inputs and outputs.

    Outputs that begin with `determinant:` must not be zero, those that begin with `discriminant:` or `radius:`
    must be positive, and those that begin with `residual:` must hold zero.
    """

    replay: Replay
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


@lru_cache(maxsize=4096)
def compile_proof(system: System) -> ProofMachine:
    """The closed form of a determined system for exact numbers and balls."""
    tape = compile_system(system).tape.keep(_PROOF_OUTPUTS, system.unknowns)
    return ProofMachine(Replay(tape.function(), Exactly, ball.exact), tape.inputs, tuple(tape.outputs))


@lru_cache(maxsize=256)
def compile_decision(system: System, number: int) -> ProofMachine:
    """The discriminant of one step of a determined system for exact numbers and balls: whether a line or a circle that
    floats cannot tell from a touching one meets the circle."""
    builder = _Builder(system, touching=0.0)
    for each, step in enumerate(make_plan(system).steps[: number + 1]):
        builder.run(step, each)
    tape = builder.tape.keep((), (f"discriminant:{number}",))
    return ProofMachine(Replay(tape.function(), _Deciding, ball.exact), tape.inputs, tuple(tape.outputs))


class _Deciding:
    """Functions of balls of many bits, in which a number that may be zero is zero."""

    root = staticmethod(ball.root)
    magnitude = staticmethod(ball.magnitude)

    @staticmethod
    def sign(value: ball.Number) -> int:
        """-1, 0 or 1."""
        return ball.sign(value) or 0

    @staticmethod
    def at_most(value: ball.Number, limit: ball.Number) -> bool:
        """Whether a value is at most so large."""
        return ball.sign(value - limit) != 1


class Exactly:
    """Functions of exact numbers and balls; a sign that cannot be told raises ArithmeticError."""

    root = staticmethod(ball.root)
    magnitude = staticmethod(ball.magnitude)

    @staticmethod
    def sign(value: ball.Number) -> int:
        """-1, 0 or 1."""
        found = ball.sign(value)
        if found is None:
            raise ArithmeticError("a sign cannot be told")
        return found

    @staticmethod
    def at_most(value: ball.Number, limit: ball.Number) -> bool:
        """Whether a value is at most so large: here, whether it is zero."""
        if ball.is_exact(value) and value == 0:
            return True
        if ball.sign(value - limit) == 1:
            return False
        raise ArithmeticError("two solutions are too close for floats")


_PROOF_OUTPUTS = ("determinant:", "discriminant:", "radius:", "residual:", "begin:", "end:", "center:")


@lru_cache(maxsize=1024)
def compile_path(system: System) -> PathMachine:
    """The lines and corners of a path at given points; the same outputs as of `compile_system`."""
    builder = _Builder(system)
    for name in system.unknowns:
        builder.scalars[name] = builder.tape.input(name)
    residuals = builder.path()
    # A path of arcs alone has no outputs of its own.
    builder.tape.output("start", builder.scalars[scalar(system.figure.start, FIRST)])
    return PathMachine(builder.tape.finish(), residuals, builder.tape)
