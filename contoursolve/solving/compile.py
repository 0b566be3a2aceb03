"""One CasADi function for one combination of words: points, residuals, determinants and corner room."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from contoursolve.backends import ball
from contoursolve.backends.inputs import Directions, Inputs
from contoursolve.backends.numeric import (
    Compiled,
    Tape,
    affine_parts,
    is_zero,
    jacobian_parts,
    magnitude,
    sign,
    sqrt,
    symbol,
    where,
)
from contoursolve.backends.replay import Replay
from contoursolve.constraints import System, Values
from contoursolve.model import FIRST, SECOND, Corner, Line, scalar
from contoursolve.solving.corners import Pair, build_corner, unit
from contoursolve.solving.plan import AffineStep, DistanceStep, LineCircleStep, Plan, Step, TwoPointsStep, make_plan
from contoursolve.tolerance import REGULAR, TOUCHING


class _Builder:
    def __init__(self, system: System) -> None:
        self.system = system
        self.tape = Tape()
        self.scalars: dict[str, Any] = {}
        for axis in (FIRST, SECOND):
            name = scalar(system.figure.start, axis)
            self.scalars[name] = self.tape.input(name)
        self.rooms: dict[str, Any] = {}
        """What the corners leave of each line."""
        self.amounts = Inputs(self.tape, {})
        self.directions = Directions(self.tape, {})

    def at(self, scalars: dict[str, Any]) -> Values:
        return Values(scalars, self.amounts, self.directions, self.system.headed)

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
            case TwoPointsStep():
                self._two_points(step, number)

    def _affine(self, step: AffineStep, number: int) -> None:
        symbols = {name: symbol(name) for name in step.unknowns}
        lookup = self.at({**self.scalars, **symbols})
        matrix, constants = affine_parts(
            [fact.residual(lookup) for fact in step.facts], [symbols[name] for name in step.unknowns]
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
        cosine, sine = self.directions[step.heading.given]
        center, radius = self.point(step.circle.center), self.scalars[step.circle.radius]
        on_line = step.heading.head if step.heading.tail == step.circle.point else step.heading.tail
        through = self.point(on_line)
        offset = (through[0] - center[0]) * -sine + (through[1] - center[1]) * cosine
        discriminant = (radius - offset) * (radius + offset)
        side = self.tape.input(f"side:{step.circle.point}")
        scale = radius + sum(magnitude(value) for value in (*center, *through))
        half = side * self._root(discriminant, offset, radius, scale)
        self.set_point(
            step.circle.point,
            (center[0] - sine * offset + cosine * half, center[1] + cosine * offset + sine * half),
        )
        self.tape.output(f"discriminant:{number}", discriminant)
        self.tape.output(f"offset:{number}", offset)
        self.tape.output(f"scale:{number}", scale)
        self.tape.output(f"radius:{number}", radius)

    def _two_points(self, step: TwoPointsStep, number: int) -> None:
        """Middle of the chord, then along its perpendicular to the left or to the right."""
        first, second = self.point(step.first.point), self.point(step.second.point)
        radius = self.scalars[step.first.radius]
        chord = second[0] - first[0], second[1] - first[1]
        length = sqrt(chord[0] ** 2 + chord[1] ** 2)
        discriminant = (radius - length / 2) * (radius + length / 2)
        scale = radius + sum(magnitude(value) for value in (*first, *second))
        root = self._root(discriminant, length / 2, radius, scale)
        rise = self.tape.input(f"side:{step.first.center}") * root / length
        self.set_point(
            step.first.center,
            ((first[0] + second[0]) / 2 - rise * chord[1], (first[1] + second[1]) / 2 + rise * chord[0]),
        )
        self.tape.output(f"discriminant:{number}", discriminant)
        self.tape.output(f"offset:{number}", length / 2)
        self.tape.output(f"scale:{number}", scale)
        self.tape.output(f"radius:{number}", radius)

    def _root(self, discriminant: Any, offset: Any, radius: Any, scale: Any) -> Any:
        """The root of a discriminant; 0 where floats cannot tell that a line does more than touch."""
        return where(_touches(offset, radius, scale), 0, sqrt(discriminant))

    def outputs(self, plan: Plan) -> tuple[tuple[int, int, str], ...]:
        """The unknowns, the residuals of all facts, and the Jacobian of the basis."""
        for name in self.system.unknowns:
            self.tape.output(name, self.scalars[name])
        lookup = self.at(self.scalars)
        for number, fact in enumerate((*plan.basis, *plan.checks)):
            self.tape.output(f"residual:{number}", fact.residual(lookup))
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
        """Direction and length of each line, and every corner; the names of the corners' residuals."""
        residuals: list[str] = []
        lines = [element for element in self.system.figure.path if isinstance(element, Line)]
        directions = {line.name: self._direction(line) for line in lines}
        for corner in self.system.figure.corners:
            index = next(number for number, line in enumerate(lines) if line.name == corner.before)
            if corner.lands_on is not None:
                leaving = self._direction_beside(self.system.figure.line(corner.lands_on))
                arriving = directions[corner.before]
                residuals += self._corner(corner, arriving, leaving, _quadrant_between(arriving, leaving))
            elif corner.after is None:
                residuals += self._landing(corner, directions[corner.before], directions[lines[index - 1].name])
            else:
                start, end = self.point(lines[index].tail), self.point(lines[index + 1].head)
                quadrant = sign(end[FIRST] - start[FIRST]), sign(end[SECOND] - start[SECOND])
                residuals += self._corner(corner, directions[corner.before], directions[corner.after], quadrant)
        for line in lines:
            self.tape.output(f"room:{line.name}", self.rooms[line.name])
        return tuple(residuals)

    def _direction(self, line: Line) -> Pair:
        tail, head = self.point(line.tail), self.point(line.head)
        step = head[0] - tail[0], head[1] - tail[1]
        if line.heading is None:
            direction, length = unit(step), sqrt(step[0] ** 2 + step[1] ** 2)
        else:
            direction = self.directions[line.heading]
            length = step[0] * direction[0] + step[1] * direction[1]
        self.tape.output(f"length:{line.name}", length)
        self.rooms[line.name] = length
        return direction

    def _direction_beside(self, line: Line) -> Pair:
        """The direction of a line beside the path, which is stated or leads to a place."""
        if line.heading is not None:
            cosine, sine = self.directions[line.heading]
            return cosine, sine
        at = self.at(self.scalars)
        tail, head = self.point(line.tail), (at.coordinate(line.head, FIRST), at.coordinate(line.head, SECOND))
        step = head[FIRST] - tail[FIRST], head[SECOND] - tail[SECOND]
        self.tape.output(f"length:{line.name}", sqrt(step[0] ** 2 + step[1] ** 2))
        return unit(step)

    def _landing(self, corner: Corner, arriving: Pair, earlier: Pair) -> list[str]:
        """A corner onto an axis-parallel line: it goes on the way its line advances on each axis, and
        a component that is zero is taken from the line before (YASNAC LX3, Tables 2.35 and 2.36)."""
        quadrant = _quadrant(arriving, earlier)
        along_first = corner.lands_parallel_to == FIRST
        leaving = (quadrant[FIRST], 0) if along_first else (0, quadrant[SECOND])
        self.tape.output(f"landing:{corner.name}", quadrant[FIRST if along_first else SECOND])
        return self._corner(corner, arriving, leaving, quadrant)

    def _corner(self, corner: Corner, arriving: Pair, leaving: Pair, quadrant: Pair) -> list[str]:
        size, name = self.tape.input(corner.size), corner.name
        built = build_corner(corner.shape, self.point(corner.at), arriving, leaving, size, quadrant)
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


def _quadrant(arriving: Pair, earlier: Pair) -> Pair:
    """The way a line advances on each axis; a component that is zero is taken from the line before."""
    first, second = (
        where(is_zero(arriving[axis]), sign(earlier[axis]), sign(arriving[axis])) for axis in (FIRST, SECOND)
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


def _touches(offset: Any, radius: Any, scale: Any) -> Any:
    return magnitude(magnitude(offset) - radius) <= TOUCHING * scale


@dataclass(frozen=True, slots=True)
class Machine:
    """The plan of a system with its function, and the names of those outputs that come in numbers."""

    plan: Plan
    function: Compiled
    slopes: tuple[tuple[int, int, str], ...]
    """(row, column, output) of the Jacobian of the basis by the unknowns."""
    corner_residuals: tuple[str, ...]
    tape: Tape
    """All expressions, from which the proof makes a function of its own."""


@lru_cache(maxsize=4096)
def compile_system(system: System) -> Machine:
    """The function of a determined system; one for each combination of words."""
    plan = make_plan(system)
    builder = _Builder(system)
    for number, step in enumerate(plan.steps):
        builder.run(step, number)
    slopes = builder.outputs(plan)
    residuals = builder.path()
    return Machine(plan, builder.tape.finish(), slopes, residuals, builder.tape)


@dataclass(frozen=True, slots=True)
class PathMachine:
    """The path of a figure as a function of its points, whatever they were found from."""

    function: Compiled
    corner_residuals: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ProofMachine:
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
    return ProofMachine(Replay(tape.function(), Exactly, ball.exact), tape.inputs, tape.outputs)


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
    return PathMachine(builder.tape.finish(), residuals)
