"""Formulas for each kind of constraint and element at claimed points: one table, without the package's equations.

A point is a complex number, mm from the start point: real is the plane's first axis, imaginary its second.
"""

from cmath import phase, rect
from collections.abc import Callable, Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import pairwise
from math import copysign, radians, tau
from typing import Any

import numpy
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from contoursolve import geometry as kinds
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Choice,
    Corner,
    CornerShape,
    Figure,
    Line,
    Side,
    line_scalars,
    scalar,
)
from contoursolve.numeric import pinv
from contoursolve.tolerance import LENGTH, RESIDUAL

Array = NDArray[numpy.float64]

STEP = 2e-4
"""mm (1 for a direction). Of central differences of fourth order."""

INDEPENDENT = 1e-7
"""1 (share of the largest). A singular value below this is zero: an angle of 0.001 degrees gives 100 times that."""

SWEEPS, SETTLED = 20, 1e-10
"""Number of passes that restore values missing in the result, and the step below which they are settled, mm."""


class Move(Struct, frozen=True):
    """A claimed element; `turn` is +1 for a counter-clockwise arc, -1 for a clockwise one, 0 for a line."""

    start: complex
    end: complex
    turn: int = 0
    center: complex = 0j
    radius: float = 0.0


class MeasuredFigure(Struct, frozen=True):
    """A figure at claimed values: scalars by name, given lengths and directions, the signs of open sides; `headed` are
    the lines whose direction is a given, each with that and a point of it."""

    figure: Figure
    scalars: Mapping[str, float]
    amounts: Mapping[str, float]
    directions: Mapping[str, complex]
    headed: Mapping[str, tuple[str, str]]
    signs: Mapping[str, int]

    def point(self, name: str) -> complex:
        return complex(self.scalars[scalar(name, FIRST)], self.scalars[scalar(name, SECOND)])

    def way(self, tail: str, head: str) -> complex:
        return self.point(head) - self.point(tail)

    def radius(self, name: str) -> float:
        return self.scalars[name] if name in self.scalars else self.amounts[name]

    def bearing(self, line: str) -> complex:
        """The direction in which a line runs."""
        if line in self.headed:
            return self.directions[self.headed[line][0]]
        return complex(self.scalars[f"{line}.cos"], self.scalars[f"{line}.sin"])

    def left(self, line: str, point: str) -> float:
        """The distance of a point from a line, mm; positive to its left."""
        if line in self.headed:
            return cross(self.bearing(line), self.way(self.headed[line][1], point))
        return cross(self.bearing(line), self.point(point)) - self.scalars[f"{line}.off"]

    def side(self, name: str | int) -> int:
        return self.signs[name] if isinstance(name, str) else name

    def travel(self, of: Any) -> complex:
        """The direction in which an element is travelled (`Along`, `Chord` or `Tangent`)."""
        if isinstance(of, kinds.Along):
            return self.bearing(of.line)
        if isinstance(of, kinds.Chord):
            return unit(self.way(of.tail, of.head))
        return complex(of.turn.sign * 1j * unit(self.way(of.center, of.point)))

    def advance(self, own: Any) -> float:
        """The advance of a path along an axis: by the lines between which it is, or by its first part that moves along
        it."""
        if getattr(own, "between", ()):
            return sum(part(self.bearing(line), own.axis) for line in own.between)
        ways = (self.way(*each) if len(each) > 1 else self.bearing(each[0]) for each in own.advance)
        return next((part(each, own.axis) for each in ways if abs(part(each, own.axis)) > LENGTH), 0.0)

    def heading(self, line: Line) -> complex:
        """The direction of a line: as stated, or from point to point."""
        if line.name in self.headed or f"{line.name}.cos" in self.scalars:
            return self.bearing(line.name)
        return unit(self.way(line.tail, line.toward or line.head))

    def with_drawn_lines(self, limit: float) -> "MeasuredFigure":
        """The same, where lines whose ends are off the stated direction, which is exact to its increment only, run from
        one end to the other."""
        scalars, headed = dict(self.scalars), dict(self.headed)
        for line in (each for each in self.figure.path if isinstance(each, Line) and each.name in headed):
            along = unit(self.way(line.tail, line.head))
            if abs(cross(self.bearing(line.name), self.way(line.tail, line.head))) > limit:
                values = along.real, along.imag, cross(along, self.point(line.tail))
                scalars.update(zip(line_scalars(line.name), values, strict=True))
                del headed[line.name]
        return replace(self, scalars=scalars, headed=headed)


def cross(a: complex, b: complex) -> float:
    """Vector product; positive where b points to the left of a."""
    return (a.conjugate() * b).imag


def dot(a: complex, b: complex) -> float:
    """Scalar product."""
    return (a.conjugate() * b).real


def unit(a: complex) -> complex:
    """The direction of a vector; 0 of none."""
    return a / abs(a) if a else 0j


def part(a: complex, axis: int) -> float:
    """One coordinate."""
    return a.imag if axis else a.real


def direction(angle: Decimal) -> complex:
    """An angle in degrees as a unit vector, exact along the axes."""
    quarters, rest = divmod(angle % 360 + (360 if angle % 360 < 0 else 0), 90)
    return (rect(1, radians(float(rest))) if rest else 1 + 0j) * (1, 1j, -1, -1j)[int(quarters) % 4]


# --- Constraints -------------------------------------------------------------------------------------


def _arc_end(f: Any, at: MeasuredFigure) -> complex:
    """The spoke at which an arc of a stated length ends."""
    return at.way(f.center, f.tail) * rect(1, f.turn.sign * at.amounts[f.given] / at.radius(f.radius))


def _touching(f: Any, at: MeasuredFigure) -> float:
    one, two = at.radius(f.first[1]), at.radius(f.second[1])
    return abs(at.way(f.first[0], f.second[0])) - (one + two if at.side(f.side) > 0 else abs(one - two))


def _beside(f: Any, at: MeasuredFigure) -> float:
    """The error of a point beside a circle, mm; the circle about the point has the distance as its radius."""
    between = abs(at.way(f.first[0], f.second[0]))
    return between - at.radius(f.second[1]) - at.side(f.side) * at.radius(f.first[1])


def _in_line(f: Any, at: MeasuredFigure) -> float:
    """The distance of a point from the line through two centres, mm. For centres that are almost one it is that of the
    second centre from the line through the first and the point."""
    spoke, between = at.way(f.first, f.point), at.way(f.first, f.second)
    return cross(between, unit(spoke)) if abs(between) <= LENGTH else cross(unit(between), spoke)


def _inside(f: Any, at: MeasuredFigure) -> float:
    """The distance between the centres of a rounding and its arc, mm; negative beyond that of the arc."""
    return float(at.radius(f.arc[1]) - f.turn.sign * at.side(f.side) * at.radius(f.radius))


Formula = Callable[[Any, MeasuredFigure], Any]

LENGTHS: Mapping[type, tuple[str, Formula]] = {
    kinds.Coordinate: ("{axis} of {point}", lambda f, at: part(at.point(f.point), f.axis)),
    kinds.Offset: ("{axis} from {origin} to {point}", lambda f, at: part(at.way(f.origin, f.point), f.axis)),
    kinds.Radius: ("radius {radius}", lambda f, at: at.radius(f.radius)),
    kinds.RadiusStep: ("{radius} less {origin}", lambda f, at: at.radius(f.radius) - at.radius(f.origin)),
    kinds.Distance: ("distance from {tail} to {head}", lambda f, at: abs(at.way(f.tail, f.head))),
    kinds.Extent: ("length of {line}", lambda f, at: dot(at.bearing(f.line), at.way(f.tail, f.head))),
}
"""Name in checks and measured length, mm, of each kind of constraint that states a length."""

ANGLES: Mapping[type, tuple[str, Formula]] = {
    kinds.Heading: ("direction of the line from {tail} to {head}", lambda f, at: (1 + 0j, at.way(f.tail, f.head))),
    kinds.Ray: ("direction from {tail} to {head}", lambda f, at: (1 + 0j, at.way(f.tail, f.head))),
    kinds.Directed: ("direction of {line}", lambda f, at: (1 + 0j, at.bearing(f.line))),
    kinds.TurnBetween: ("the angle between both elements", lambda f, at: (at.travel(f.first), at.travel(f.second))),
}
"""The same where an angle is stated: the two vectors between which it is."""

FORMS: Mapping[type, tuple[str, Formula]] = {
    kinds.ArcLength: (
        "length of the arc from {tail} to {head}",
        lambda f, at: cross(_arc_end(f, at), at.way(f.center, f.head)) / at.radius(f.radius),
    ),
    kinds.Level: ("{axis} of {point} is that of {origin}", lambda f, at: part(at.way(f.origin, f.point), f.axis)),
    kinds.Collinear: (
        "{point} is on the line from {tail} through {through}",
        lambda f, at: cross(unit(at.way(f.tail, f.through)), at.way(f.tail, f.point)),
    ),
    kinds.OnCircle: (
        "{point} is on the circle about {center}",
        lambda f, at: abs(at.way(f.center, f.point)) - at.radius(f.radius),
    ),
    kinds.EqualRadii: ("{first} is {second}", lambda f, at: at.radius(f.first) - at.radius(f.second)),
    kinds.EqualDistances: ("both are equally long", lambda f, at: abs(at.way(*f.first)) - abs(at.way(*f.second))),
    kinds.TangentCircles: ("both circles touch", _touching),
    kinds.PointBeside: ("the point is as far beside the circle as stated", _beside),
    kinds.Contact: ("{point} is in line with {first} and {second}", _in_line),
    kinds.TangentArc: (
        "the rounding about {center} touches the arc",
        lambda f, at: abs(at.way(f.arc[0], f.center)) - abs(_inside(f, at)),
    ),
    kinds.ArcContact: (
        "{point} is where the rounding touches the arc",
        lambda f, at: cross(unit(at.way(f.arc[0], f.point)), at.way(f.arc[0], f.center)),
    ),
    kinds.Setback: (
        "{point} is its size away from {corner}",
        lambda f, at: f.way * dot(at.bearing(f.line), at.way(f.point, f.corner)) - at.radius(f.size),
    ),
    kinds.ChordSetback: (
        "{point} is its size away from {corner}",
        lambda f, at: abs(at.way(f.point, f.corner)) - at.radius(f.size),
    ),
    kinds.UnitDirection: ("{line} has one direction", lambda f, at: abs(at.bearing(f.line)) - 1),
    kinds.Through: ("{line} passes through {point}", lambda f, at: at.left(f.line, f.point)),
    kinds.Foot: (
        "{point} is where {line} is touched",
        lambda f, at: dot(at.bearing(f.line), at.way(f.center, f.point)),
    ),
    kinds.Leaving: (
        "{line} leaves the circle about {center} in {point}",
        lambda f, at: dot(at.bearing(f.line), at.way(f.center, f.point)),
    ),
    kinds.Parallel: ("{line} is parallel to {axis}", lambda f, at: part(at.bearing(f.line), 1 - f.axis)),
    kinds.Spoke: (
        "direction of the radius from {center} to {point}",
        lambda f, at: part(
            at.way(f.center, f.point) - at.directions[f.given] * 1j**f.quarters * at.radius(f.radius), f.axis
        ),
    ),
    kinds.ParallelLines: (
        "{first} is parallel to {second}",
        lambda f, at: cross(at.bearing(f.first), at.bearing(f.second)),
    ),
    kinds.TangentLine: (
        "{line} touches the circle about {center}",
        lambda f, at: at.left(f.line, f.center) - at.side(f.side) * at.radius(f.radius),
    ),
    kinds.ChamferLeg: (
        "extent of the bevel from {begin} to {end} along {axis}",
        lambda f, at: part(at.way(f.begin, f.end), f.axis) - f.share * at.side(f.side) * at.radius(f.size),
    ),
}
"""The same where no value is stated, or none that is measured by itself: how far it is from being true, mm (1 for a
direction)."""

MEANINGS = {**LENGTHS, **ANGLES, **FORMS}

SENSES: Mapping[type, Formula] = {
    kinds.Ray: lambda f, at: dot(at.directions[f.given], at.way(f.tail, f.head)),
    kinds.Directed: lambda f, at: dot(at.directions[f.given], at.bearing(f.line)),
    kinds.TurnBetween: lambda f, at: dot(at.travel(f.first) * at.directions[f.given], at.travel(f.second)),
    kinds.ArcLength: lambda f, at: min(
        dot(_arc_end(f, at), at.way(f.center, f.head)), tau * at.radius(f.radius) - at.amounts[f.given]
    ),
    kinds.Contact: lambda f, at: f.side * dot(at.way(f.first, f.point), at.way(f.point, f.second)),
    kinds.ArcContact: lambda f, at: min(
        _inside(f, at) * dot(at.way(f.arc[0], f.point), at.way(f.arc[0], f.center)),
        f.way * f.turn.sign * cross(at.way(f.arc[0], f.point), at.way(f.arc[0], f.corner)),
    ),
    kinds.ChordSetback: lambda f, at: (
        f.way * f.turn.sign * cross(at.way(f.center, f.point), at.way(f.center, f.corner))
    ),
    kinds.Foot: lambda f, at: f.way * dot(at.bearing(f.line), at.way(f.point, f.corner)) if f.corner else 0.0,
    kinds.Leaving: lambda f, at: f.turn.sign * cross(at.way(f.center, f.point), at.bearing(f.line)),
    kinds.Parallel: lambda f, at: part(at.bearing(f.line), f.axis) * at.advance(f),
    kinds.ChamferLeg: lambda f, at: at.side(f.side) * at.advance(f),
}
"""Quantities that must not be negative, because the formula alone is true of the opposite as well."""


def residual(fact: Any, at: MeasuredFigure) -> float:
    """The error of a fact, mm (1 for a direction). Raises KeyError for a kind that the tables lack."""
    found = MEANINGS[type(fact)][1](fact, at)
    if type(fact) in ANGLES:
        return cross(found[0] * at.directions[fact.given], found[1])
    return float(found - at.amounts[fact.given] if type(fact) in LENGTHS else found)


def measured(fact: Any, at: MeasuredFigure) -> tuple[float, float]:
    """The true value of a fact, mm or radians. With an angle comes the length over which it is known, mm; else 0."""
    if isinstance(fact, kinds.ArcLength):
        swept = fact.turn.sign * phase(at.way(fact.center, fact.head) / at.way(fact.center, fact.tail)) % tau
        return at.radius(fact.radius) * swept, 0.0
    found = MEANINGS[type(fact)][1](fact, at)
    return (phase(found[1] * found[0].conjugate()), abs(found[1])) if type(fact) in ANGLES else (float(found), 0.0)


# --- Derivatives, and what a result does not list ---------------------------------------------------


class _Watched(dict[str, float]):
    """Values, and the names of those that were asked for."""

    def __init__(self, values: Mapping[str, float]) -> None:
        super().__init__(values)
        self.asked: dict[str, None] = {}

    def __getitem__(self, name: str) -> float:
        self.asked[name] = None
        return super().__getitem__(name)


def slopes(facts: Sequence[Any], at: MeasuredFigure, unknowns: Sequence[str]) -> Array:
    """The derivatives of facts (rows) by unknowns (columns), by central differences."""
    column, found = {name: number for number, name in enumerate(unknowns)}, numpy.zeros((len(facts), len(unknowns)))
    watched = _Watched(at.scalars)
    here = replace(at, scalars=watched)
    for row, fact in enumerate(facts):
        watched.asked = {}
        residual(fact, here)
        for name in [name for name in watched.asked if name in column]:
            own, values = watched.get(name, 0.0), list[float]()
            for step in (-2, -1, 1, 2):
                watched[name] = own + step * STEP
                values.append(residual(fact, here))
            watched[name] = own
            found[row, column[name]] = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * STEP)
    return found


def settle(facts: Sequence[Any], at: MeasuredFigure, names: Sequence[str]) -> MeasuredFigure:
    """The place with what a result does not list, such as the direction of a line, where the facts about it put that,
    one after the other; everything else stays as it is claimed."""
    scalars, owners, reads = dict(at.scalars), dict[str, list[str]](), list[tuple[Any, set[str]]]()
    for name in names:
        owners.setdefault(name.rpartition(".")[0], []).append(name)
    watched = _Watched(scalars)
    for fact in facts:
        watched.asked = {}
        residual(fact, replace(at, scalars=watched))
        reads.append((fact, set(watched.asked)))
    about = {owner: [each for each in reads if each[1] & {*own}] for owner, own in owners.items()}
    unsettled, here = set(names), replace(at, scalars=scalars)
    for _ in range(SWEEPS):
        largest = 0.0
        for owner, own in owners.items():
            known = [fact for fact, read in about[owner] if not (read & unsettled) - {*own}]
            if len(known) < len(own) and unsettled & {*own}:
                continue
            unsettled -= {*own}
            for _ in range(SWEEPS):
                off = numpy.array([residual(fact, here) for fact in known])
                step = pinv(slopes(known, here, own), rcond=INDEPENDENT) @ off
                for name, by in zip(own, step.tolist(), strict=True):
                    scalars[name] -= by
                if len(known) > len(own) and abs(step).max() <= SETTLED and abs(off).max() > RESIDUAL:
                    # What may be off, because it is known without it, or is exact to its increment only.
                    slack = [isinstance(fact, kinds.OnCircle) and not fact.given for fact in known]
                    known.pop(slack.index(True) if any(slack) else int(abs(off).argmax()))
                elif abs(step).max(initial=0.0) <= SETTLED:
                    break
                largest = max(largest, float(abs(step).max(initial=0.0)))
        if largest <= SETTLED and not unsettled:
            break
    return here


def with_sides(facts: Sequence[Any], at: MeasuredFigure) -> MeasuredFigure:
    """The place with each open side as the facts about it fit best."""
    about, signs = dict[str, list[Any]](), dict[str, int]()
    for fact in facts:
        if isinstance(getattr(fact, "side", None), str):
            about.setdefault(fact.side, []).append(fact)
    for side, own in about.items():
        off = {sign: sum(abs(residual(each, replace(at, signs={side: sign}))) for each in own) for sign in (1, -1)}
        signs[side] = min(off, key=lambda sign: off[sign])
    return replace(at, signs=signs)


# --- Elements, corners and sides ---------------------------------------------------------------------

Found = Iterator[tuple[str, float]]
"""Names of measurements, each with its error, mm; for a wrong sense, the amount by which it is wrong."""


def check_element(at: MeasuredFigure, element: Line | Arc, move: Move) -> Found:
    """A claimed element runs in its direction or sense, from its first point to its last one."""
    tail, head, name = at.point(element.tail), at.point(element.head), element.name
    if isinstance(element, Line):
        along = at.heading(element)
        yield f"{name} runs in its direction", min(0.0, dot(along, move.end - move.start))
        yield f"{name} begins behind its first point", min(0.0, dot(along, move.start - tail))
        yield f"{name} ends before its last point", min(0.0, dot(along, head - move.end))
        if element.toward:
            yield f"{name} runs towards its point", min(0.0, dot(at.way(element.tail, element.toward), head - tail))
        return
    center, radius = at.point(element.center), at.radius(element.radius)
    whole, first, own, last = (
        element.turn.sign * phase((two - center) / (one - center)) % tau if center not in (one, two) else 0.0
        for one, two in ((tail, head), (tail, move.start), (move.start, move.end), (move.end, head))
    )
    # What ends where it begins is a full turn, and the rounding of nothing none.
    whole = tau if abs(head - tail) <= LENGTH else whole
    own = tau if abs(move.end - move.start) <= LENGTH else own
    first, last = (0.0 if (tau - each) * radius <= LENGTH else each for each in (first, last))
    yield f"{name} goes from its first to its last point", (first + own + last - whole) * radius


def missing(at: MeasuredFigure, corner: Corner) -> float:
    """The size of a corner that is not there, mm; 0 where the control leaves it out, because the path hardly turns."""
    number = next(number for number, each in enumerate(at.figure.path) if each.name == corner.before)
    ways = list[complex]()
    for each in at.figure.path[number : number + 2]:
        if isinstance(each, Line):
            ways.append(at.heading(each))
        else:
            ways.append(each.turn.sign * 1j * unit(at.point(corner.at) - at.point(each.center)))
    is_out = len(ways) > 1 and abs(cross(*ways)) <= corner.guard and dot(*ways) > 0
    return 0.0 if is_out else at.scalars.get(f"{corner.name}.radius", at.amounts.get(corner.size, 0.0))


def side_of(at: MeasuredFigure, facts: Sequence[Any], choice: Choice) -> tuple[float, float] | None:
    """On which side of a choice its point is: the number is positive on the side that is meant, and next to zero where
    there is one place; with how much (mm) that leaves between the circle and what it meets. None where the figure does
    not tell."""
    figure, side, here = at.figure, choice.side, at.point(choice.point)
    circles = [fact for fact in facts if isinstance(fact, kinds.OnCircle)]
    pairs = ((one, two) for one, two in pairwise(figure.path) if one.head == choice.point)
    arcs = next(((one, two) for one, two in pairs if isinstance(one, Arc) and isinstance(two, Arc)), None)
    # The other place is the mirror image: about a line through this point in that direction.
    if side in (Side.NEARER, Side.FARTHER, Side.SHORTER, Side.LONGER):
        lines = (each for each in (*figure.path, *figure.lines) if isinstance(each, Line))
        line = next((each for each in lines if choice.point in (each.tail, each.head)), None)
        circle = next((each for each in circles if each.point == choice.point), None)
        if line is None or circle is None:
            return None
        through, along, radius = at.point(circle.center), -1j * at.heading(line), at.radius(circle.radius)
        begin = at.point(line.head if choice.point == line.tail else line.tail) if line.head else 0j
    elif arcs:
        through, begin = at.point(arcs[0].center), at.point(arcs[0].tail)
        along, radius = unit(at.point(arcs[1].center) - through), min(at.radius(each.radius) for each in arcs)
    else:
        arc = next((each for each in figure.path if isinstance(each, Arc) and each.center == choice.point), None)
        on_it = [each.point for each in circles if arc and each.center == arc.center and each.point != arc.tail]
        if arc is None or not on_it:
            return None
        stated = {fact.point for fact in facts if isinstance(fact, kinds.Coordinate | kinds.Offset)}
        through = begin = at.point(arc.tail)
        along = unit(at.point(min(on_it, key=lambda point: point not in stated)) - through)
        radius = at.radius(arc.radius)
    own = beside = cross(along, here - through)
    other = here - 2j * beside * along
    if side in (Side.SHORTER, Side.LONGER):
        own = abs(here - begin) - abs(other - begin)
    elif side in (Side.FIRST, Side.SECOND):
        one, two = (-phase((each - through) / (begin - through)) % tau for each in (here, other))
        own = copysign(beside, two - one)
    return own * side.sign, beside**2 / (2 * radius)


NEAR = 1e-3
"""mm. A claimed end that is farther from a claimed point than the least increment does not end there."""


def name_moves(figure: Figure, moves: Sequence[Move], points: Mapping[str, complex]) -> Iterator[dict[str, Move]]:
    """Claimed elements by the names of what they may be: all of the figure, or without some of no length."""
    parts = list[tuple[Line | Arc | Corner, complex | None]]()
    for element in figure.path:
        corners = [each for each in figure.corners if each.at == element.head]
        parts += [(element, None if corners else points.get(element.head))]
        parts += [(each, points.get(each.at)) for each in corners]
    stack: list[tuple[int, tuple[Move | None, ...]]] = [(0, ())]
    while stack:
        used, taken = stack.pop()
        if len(taken) == len(parts):
            yield {each.name: move for (each, _), move in zip(parts, taken, strict=True) if move}
            continue
        (each, head), spare = parts[len(taken)], len(parts) - len(taken) - len(moves) + used
        here, left_out = moves[used - 1].end if used else 0j, (used, (*taken, None))
        may_be_out = spare > 0 and (head is None or abs(here - head) <= NEAR)
        if may_be_out and not isinstance(each, Corner):
            stack.append(left_out)
        if used < len(moves):
            move, is_round = moves[used], isinstance(each, Corner) and each.shape is CornerShape.FILLET
            is_kind = bool(move.turn) if is_round else move.turn == (each.turn.sign if isinstance(each, Arc) else 0)
            if is_kind and (isinstance(each, Corner) or head is None or abs(move.end - head) <= NEAR):
                stack.append((used + 1, (*taken, move)))
        if may_be_out and isinstance(each, Corner):
            stack.append(left_out)
