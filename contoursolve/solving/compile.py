"""One CasADi function for one combination of words: points, residuals, determinants and corner room."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from math import tau
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Corner,
    Line,
    System,
    scalar,
)
from contoursolve.numeric import (
    SIDE,
    Functions,
    Replay,
    Tape,
    angle,
    ball,
    is_zero,
    jacobian_parts,
    larger,
    magnitude,
    sign,
    sqrt,
    symbol,
    where,
)
from contoursolve.solving.construction import (
    MOST_SIGNS,
    Builder,
    Construction,
    NoClosedFormError,
    named_steps,
    steps_of,
)
from contoursolve.solving.corners import CornerPath, Edge, Pair, build_corner, drop_straight, unit
from contoursolve.solving.determinacy import basis_of, spare_of
from contoursolve.solving.path_outputs import PathOutputs
from contoursolve.solving.senses import senses_of
from contoursolve.solving.sides import side_values
from contoursolve.solving.step_outputs import Need
from contoursolve.tolerance import LENGTH, REGULAR, TOUCHING


class _PathBuilder(Builder):
    """The same with what follows from the points: residuals, the path and its corners."""

    def __init__(self, system: System, touching: float = TOUCHING) -> None:
        super().__init__(system, touching)
        self.compared = {fact.circle[:2] for fact in spare_of(system) if fact.circle}
        """Points that are compared with a circle that others determine, with its centre."""
        self.lengths: dict[str, Any] = {}
        self.rooms: dict[str, Any] = {}
        """The rest that corners leave of each element."""

    def outputs(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """The names of the residuals of the basis, and of the facts that are not needed; unknowns are outputs."""
        for name in self.system.unknowns:
            self.tape.output(name, self.scalars[name])
        at, names = self.at(), list[str]()
        basis, spare = basis_of(self.system), spare_of(self.system)
        for fact in (*basis, *spare):
            names.append(f"residual:{len(names)}")
            self.tape.output(names[-1], fact.residual(at))
        for number, fact in enumerate(basis):
            if fact.sizes in self.short:
                names[number] = f"excess:{number}"
                self.tape.output(names[number], fact.residual(at) - self.short[fact.sizes])
        return tuple(names[: len(basis)]), tuple(names[len(basis) :])

    def slopes(self) -> tuple[tuple[int, int, str], ...]:
        """The Jacobian of the basis."""
        symbols = {name: symbol(name) for name in self.system.unknowns}
        at = self.at(symbols)
        entries = jacobian_parts(
            [fact.residual(at) for fact in basis_of(self.system)],
            list(symbols.values()),
            [self.scalars[name] for name in self.system.unknowns],
        )
        for (row, column), entry in entries.items():
            self.tape.output(f"slope:{row}:{column}", entry)
        return tuple((row, column, f"slope:{row}:{column}") for row, column in entries)

    def size_of(self, corner: Corner) -> Any:
        """The size of a corner, mm."""
        return self.tape.input(corner.size)

    def path(self) -> PathOutputs:
        """The names of the outputs of the path: direction and length of each element, and every corner."""
        corners, landings = dict[str, CornerPath](), dict[str, Any]()
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
                landings[corner.name] = quadrant[along]
            corners[corner.name] = self._corner(corner, before, after, quadrant)
        return PathOutputs(self.lengths, self.rooms, corners, landings).named(self.tape.output)

    def _edge(self, element: Line | Arc, at: str) -> Edge:
        """The edge by which an element passes one of its ends."""
        if isinstance(element, Line):
            return Edge(self._direction(element))
        center, point = self.point(element.center), self.point(at)
        spoke = point[0] - center[0], point[1] - center[1]
        outward = unit(spoke)
        turn = element.turn.sign
        radius = self.radius(element.radius)
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
        self.lengths[element.name] = self.rooms[element.name] = length

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
        at = self.at()
        tail, head = self.point(line.tail), (at.coordinate(line.head, FIRST), at.coordinate(line.head, SECOND))
        step = head[FIRST] - tail[FIRST], head[SECOND] - tail[SECOND]
        self.lengths[line.name] = sqrt(step[0] ** 2 + step[1] ** 2)
        return unit(step)

    def _corner(self, corner: Corner, before: Edge, after: Edge, quadrant: Pair) -> CornerPath:
        at = self.point(corner.at)
        built = build_corner(corner.shape, at, before, after, self.size_of(corner), quadrant)
        if corner.guard:
            built = drop_straight(built, at, corner.guard)
        self.rooms[corner.before] -= built.setback_in
        if corner.after is not None:
            self.rooms[corner.after] -= built.setback_out
        return built


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


@lru_cache(maxsize=4096)
def compile_system(system: System) -> Construction:
    """The function of a determined system; one for each combination of words.

    Raises NoClosedFormError if it has not one, ValueError if words are missing.
    """
    return _compile(_PathBuilder(system))


@lru_cache(maxsize=64)
def compile_plainly(system: System) -> Construction:
    """The same for formulas that a control evaluates: a line that touches a circle is nothing of its own."""
    return _compile(_PlainBuilder(system, touching=0.0))


class _PlainBuilder(_PathBuilder):
    def _band(self, scale: Any) -> Any:
        return 0 * scale

    def _spread(self, discriminant: Any, _is_touching: Any) -> Any:
        return sqrt(discriminant)


def _compile(builder: _PathBuilder) -> Construction:
    system, steps = builder.system, named_steps(builder.system)
    for step in steps:
        builder.run(step)
    residuals, compared = builder.outputs()
    slopes, path = builder.slopes(), builder.path()
    return Construction(
        steps=steps,
        basis=basis_of(system),
        checks=spare_of(system),
        function=builder.tape.finish(),
        measures=tuple(builder.measures),
        residuals=residuals,
        compared=compared,
        slopes=slopes,
        path=path,
        tape=builder.tape,
        signs=tuple(builder.signs),
    )


@lru_cache(maxsize=256)
def compile_branches(system: System) -> Construction:
    """The solutions of a determined system whatever its facts, one for each choice of the signs, with what must hold of
    them. Raises NoClosedFormError."""
    return _BranchBuilder(system, touching=0.0).construct()


class _BranchBuilder(_PathBuilder):
    def construct(self) -> Construction:
        system, steps = self.system, steps_of(self.system)
        for step in steps:
            self.run(step)
        self._check_senses()
        basis, spare = basis_of(system), spare_of(system)
        for fact in spare:
            if any(SIDE + side not in self.signs for side in fact.sides()):
                raise NoClosedFormError("on which side it touches follows from nothing else", (fact,), ())
        residuals, compared = self.outputs()
        sides, path = dict(self._sides()), self.path()
        if len(self.signs) > MOST_SIGNS:
            raise NoClosedFormError(f"it has {2 ** len(self.signs):,} solutions to look at", basis, ())
        return Construction(
            steps=steps,
            basis=basis,
            checks=spare,
            function=self.tape.finish(),
            measures=tuple(self.measures),
            residuals=residuals,
            compared=compared,
            slopes=(),
            path=path,
            tape=self.tape,
            signs=tuple(self.signs),
            conditions=tuple(self.conditions),
            sides=sides,
        )

    def size_of(self, corner: Corner) -> Any:
        name = f"{corner.name}.radius"
        is_stated = any(fact.sizes and fact.given == corner.size for fact in self.system.facts)
        return self.scalars[name] if name in self.scalars and not is_stated else super().size_of(corner)

    def _spread(self, discriminant: Any, _is_touching: Any) -> Any:
        # Of a half circle it is zero, and rounding may make it less.
        return sqrt(larger(discriminant, 0))

    def _check_senses(self) -> None:
        """Declare the conditions on senses."""
        at = self.at()
        for sense in senses_of(self.system):
            if sense.is_free:
                raise NoClosedFormError(f"the sense of {sense.unknowns[0]} is open", (), ())
            for value in sense.values(at):
                output = f"sense:{len(self.conditions)}"
                self.tape.output(output, value)
                self._need(Need.POSITIVE, output, sense.facts, sense.unknowns)

    def _sides(self) -> Iterator[tuple[str, tuple[str, str]]]:
        chosen = set(self.system.choices)
        for point, (value, positive, _) in side_values(self.system, self.at(), chosen).items():
            if point in chosen:
                self.tape.output(f"beside:{point}", value)
                yield point, (f"beside:{point}", positive)


class ExactFunction(Struct, frozen=True, eq=False):
    """A function of the inputs of a system in exact numbers and balls, with the names of its inputs."""

    replay: Replay
    inputs: tuple[str, ...]


class ExactOutputs(Struct, frozen=True, eq=False):
    """The closed form of a system in exact numbers and balls, with the places of its outputs."""

    function: ExactFunction
    signs: tuple[tuple[int, tuple[int, ...]], ...]
    """Of what a step divides by and takes roots of, with the signs that leave one solution."""
    residuals: tuple[int, ...]
    radii: tuple[tuple[int, str], ...]
    """With their names among the outputs in floats."""
    coordinates: tuple[tuple[int, str, int], ...]
    """The same of points and corners, with their axis: they are counted from the start point."""


@lru_cache(maxsize=4096)
def compile_proof(system: System) -> ExactOutputs:
    """The closed form of a determined system for exact numbers and balls."""
    machine, figure = compile_system(system), system.figure
    signs = dict(pair for measures in machine.measures for pair in measures.signs())
    axes = {scalar(point, axis): axis for point in figure.points for axis in (FIRST, SECOND)} | _corner_axes(machine)
    residuals = (*machine.residuals, *machine.compared)
    names = tuple(dict.fromkeys((*signs, *residuals, *figure.radii, *axes)))
    places = {name: place for place, name in enumerate(names)}
    return ExactOutputs(
        _exactly(machine.tape, names, EXACTLY),
        tuple((places[name], each) for name, each in signs.items()),
        tuple(places[name] for name in residuals),
        tuple((places[name], name) for name in figure.radii),
        tuple((places[name], name, axis) for name, axis in axes.items()),
    )


def _corner_axes(machine: Construction) -> dict[str, int]:
    """The axis of each coordinate of a corner among the outputs."""
    places = (place for each in machine.path.corners.values() for place in (each.begin, each.end, each.center) if place)
    return {name: axis for place in places for axis, name in enumerate(place)}


@lru_cache(maxsize=1024)
def compile_corners(system: System) -> tuple[ExactFunction, tuple[tuple[str, int], ...]]:
    """The places of the corners at given points for exact numbers and balls: the function, and of each output its name
    and its axis."""
    machine = compile_path(system)
    axes = _corner_axes(machine)
    return _exactly(machine.tape, tuple(axes), EXACTLY), tuple(axes.items())


def _exactly(tape: Tape, outputs: Sequence[str], functions: Functions) -> ExactFunction:
    return ExactFunction(Replay(tape.of(tape.inputs, outputs).function(), functions, ball.exact), tape.inputs)


@lru_cache(maxsize=256)
def compile_decision(system: System, number: int) -> ExactFunction:
    """The discriminant of one step of a determined system for exact numbers and balls: whether a line or a circle that
    floats cannot tell from a touching one meets the circle."""
    builder = Builder(system, touching=0.0)
    for step in compile_system(system).steps[: number + 1]:
        builder.run(step)
    return _exactly(builder.tape, [builder.measures[number].discriminant], _DECIDING)


def _told_sign(value: ball.Number) -> int:
    found = ball.sign(value)
    if found is None:
        raise ArithmeticError("a sign cannot be told")
    return found


def _surely_at_most(value: ball.Number, limit: ball.Number) -> bool:
    """Whether a value is at most so large: below that, only zero is told from it."""
    if ball.sign(value - limit) == 1:
        return False
    if ball.is_exact(value) and value == 0:
        return True
    raise ArithmeticError("two solutions are too close for floats")


EXACTLY = replace(ball.FUNCTIONS, sign=_told_sign, at_most=_surely_at_most)
"""Of exact numbers and balls; a sign that cannot be told raises ArithmeticError."""

_DECIDING = replace(
    ball.FUNCTIONS,
    sign=lambda value: ball.sign(value) or 0,
    at_most=lambda value, limit: ball.sign(value - limit) != 1,
)
"""Of balls of many bits, among which a number that may be zero is zero."""


@lru_cache(maxsize=1024)
def compile_path(system: System) -> Construction:
    """The lines and corners of a path at given points; the same outputs as of `compile_system`."""
    builder = _PathBuilder(system)
    for name in system.unknowns:
        builder.scalars[name] = builder.tape.input(name)
    path = builder.path()
    # A path of arcs alone has no outputs of its own.
    builder.tape.output("start", builder.scalars[scalar(system.figure.start, FIRST)])
    return Construction((), (), (), builder.tape.finish(), (), (), (), (), path, builder.tape)
