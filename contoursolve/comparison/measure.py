"""A figure at claimed values: the residuals of its facts there, its elements, corners and sides.

The residual of a fact is that of its kind, in plain floats. A point is a complex number, mm from the start point: real
is the plane's first axis, imaginary its second.
"""

from cmath import phase
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from math import copysign, tau

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Choice,
    Corner,
    CornerShape,
    Fact,
    Figure,
    Line,
    Side,
    System,
    Values,
)
from contoursolve.numeric import Array, Functions, pinv
from contoursolve.tolerance import LENGTH, RESIDUAL

STEP = 2e-4
"""mm (1 for a direction). Of central differences of fourth order."""

INDEPENDENT = 1e-7
"""1 (share of the largest). A singular value below this is zero: an angle of 0.001 degrees gives 100 times that."""

SWEEPS, SETTLED = 20, 1e-10
"""Number of passes that restore values missing in the result, and the step below which they are settled, mm."""

PRINTED_FLOATS = Functions(vanishes=lambda value: abs(value) <= LENGTH)
"""Of numbers that were printed: a length that is zero may show the rounding of both its ends."""


class Move(Struct, frozen=True):
    """A claimed element; `turn` is +1 for a counter-clockwise arc, -1 for a clockwise one, 0 for a line."""

    start: complex
    end: complex
    turn: int = 0
    center: complex = 0j
    radius: float = 0.0


class Place(Struct, frozen=True):
    """A figure with its facts, and the values that are claimed for it."""

    system: System
    at: Values

    def point(self, name: str) -> complex:
        return complex(self.at.coordinate(name, FIRST), self.at.coordinate(name, SECOND))

    def way(self, tail: str, head: str) -> complex:
        return self.point(head) - self.point(tail)

    def heading(self, line: Line) -> complex:
        """The direction of a line: as stated, or from point to point."""
        if line.name in self.at.headed or f"{line.name}.cos" in self.at.scalars:
            return complex(*self.at.bearing(line.name))
        return unit(self.way(line.tail, line.toward or line.head))

    def error(self, fact: Fact) -> float:
        """The residual of a fact, mm (1 for a direction)."""
        try:
            return float(fact.residual(self.at))
        except ZeroDivisionError:
            return float(fact.equation(self.at))  # about something that has no size

    def sense(self, fact: Fact) -> float:
        """A number that is negative where a fact is true of the opposite of what it states."""
        return min(map(float, fact.senses(self.at)), default=0.0)

    def slopes(self, facts: Sequence[Fact], names: Sequence[str]) -> Array:
        """The derivatives of facts (rows) by unknowns (columns), by central differences."""
        column, found = {name: number for number, name in enumerate(names)}, numpy.zeros((len(facts), len(names)))
        values = dict(self.at.scalars)
        here = replace(self, at=replace(self.at, scalars=values))
        for row, fact in enumerate(facts):
            for name in column.keys() & {*self.system.unknowns_of(fact)}:
                own, errors = values[name], list[float]()
                for step in (-2, -1, 1, 2):
                    values[name] = own + step * STEP
                    errors.append(here.error(fact))
                values[name] = own
                found[row, column[name]] = (errors[0] - 8 * errors[1] + 8 * errors[2] - errors[3]) / (12 * STEP)
        return found

    def settled(self, names: Sequence[str], facts: Sequence[Fact]) -> "Place":
        """The place with what a result does not list, such as the direction of a line, where facts about it put that,
        one after the other; everything else stays as it is claimed."""
        values, unsettled, owners = dict(self.at.scalars), {*names}, dict[str, list[str]]()
        here = replace(self, at=replace(self.at, scalars=values))
        for name in names:
            owners.setdefault(name.rpartition(".")[0], []).append(name)
        reads = [(fact, {*self.system.unknowns_of(fact)}) for fact in facts]
        about = {owner: [each for each in reads if each[1] & {*own}] for owner, own in owners.items()}
        for _ in range(SWEEPS):
            largest = 0.0
            for owner, own in owners.items():
                known = [fact for fact, read in about[owner] if not (read & unsettled) - {*own}]
                if len(known) < len(own) and unsettled & {*own}:
                    continue
                unsettled -= {*own}
                for _ in range(SWEEPS):
                    off = numpy.array([here.error(fact) for fact in known])
                    step = pinv(here.slopes(known, own), rcond=INDEPENDENT) @ off
                    values.update((name, values[name] - by) for name, by in zip(own, step.tolist(), strict=True))
                    if len(known) > len(own) and abs(step).max() <= SETTLED and abs(off).max() > RESIDUAL:
                        # What may be off, because it is known without it, or is exact to its increment only.
                        slack = [fact.circle is not None and not fact.given for fact in known]
                        known.pop(slack.index(True) if any(slack) else int(abs(off).argmax()))
                    elif abs(step).max(initial=0.0) <= SETTLED:
                        break
                    largest = max(largest, float(abs(step).max(initial=0.0)))
            if largest <= SETTLED and not unsettled:
                break
        return here

    def with_sides(self) -> "Place":
        """The place with each open side as the facts about it fit best."""
        about, signs = dict[str, list[Fact]](), dict[str, int]()
        for fact in self.system.facts:
            for side in fact.sides():
                about.setdefault(side, []).append(fact)
        for side, own in about.items():
            fits = {sign: replace(self, at=replace(self.at, signs={side: sign})) for sign in (1, -1)}
            signs[side] = min(fits, key=lambda sign: sum(abs(fits[sign].error(each)) for each in own))
        return replace(self, at=replace(self.at, signs=signs))


def cross(a: complex, b: complex) -> float:
    """Vector product; positive where b points to the left of a."""
    return (a.conjugate() * b).imag


def dot(a: complex, b: complex) -> float:
    """Scalar product."""
    return (a.conjugate() * b).real


def unit(a: complex) -> complex:
    """The direction of a vector; 0 of none."""
    return a / abs(a) if a else 0j


# --- Elements, corners and sides ---------------------------------------------------------------------

FoundValues = Iterator[tuple[str, float]]
"""Names of measurements, each with its error, mm; for a wrong sense, the amount by which it is wrong."""


def check_element(place: Place, element: Line | Arc, move: Move) -> FoundValues:
    """A claimed element runs in its direction or sense, from its first point to its last one."""
    tail, head, name = place.point(element.tail), place.point(element.head), element.name
    if isinstance(element, Line):
        along = place.heading(element)
        yield f"{name} runs in its direction", min(0.0, dot(along, move.end - move.start))
        yield f"{name} begins after its first point", min(0.0, dot(along, move.start - tail))
        yield f"{name} ends before its last point", min(0.0, dot(along, head - move.end))
        if element.toward:
            yield f"{name} runs towards its point", min(0.0, dot(place.way(element.tail, element.toward), head - tail))
        return
    center, radius = place.point(element.center), place.at.radius(element.radius)
    whole, first, own, last = (
        element.turn.sign * phase((two - center) / (one - center)) % tau if center not in (one, two) else 0.0
        for one, two in ((tail, head), (tail, move.start), (move.start, move.end), (move.end, head))
    )
    # What ends where it begins is a full turn, and the rounding of nothing none.
    whole = tau if abs(head - tail) <= LENGTH else whole
    own = tau if abs(move.end - move.start) <= LENGTH else own
    first, last = (0.0 if (tau - each) * radius <= LENGTH else each for each in (first, last))
    yield f"{name} goes from its first to its last point", (first + own + last - whole) * radius


def missing(place: Place, corner: Corner) -> float:
    """The size of a corner that is not there, mm; 0 where the control leaves it out, because the path hardly turns."""
    number = next(number for number, each in enumerate(place.system.figure.path) if each.name == corner.before)
    ways = list[complex]()
    for each in place.system.figure.path[number : number + 2]:
        if isinstance(each, Line):
            ways.append(place.heading(each))
        else:
            ways.append(each.turn.sign * 1j * unit(place.point(corner.at) - place.point(each.center)))
    is_out = len(ways) > 1 and abs(cross(*ways)) <= corner.guard and dot(*ways) > 0
    return 0.0 if is_out else place.at.scalars.get(corner.radius, place.at.amounts.get(corner.size, 0.0))


def side_of(place: Place, choice: Choice) -> tuple[float, float] | None:
    """On which side of a choice its point is: the number is positive on the side that is meant, and next to zero where
    there is one place; with how much (mm) that leaves between the circle and what it meets. None where the figure does
    not tell."""
    figure, facts, side, here = place.system.figure, place.system.facts, choice.side, place.point(choice.point)
    circles = [fact.circle for fact in facts if fact.circle]
    pairs = ((one, two) for one, two in pairwise(figure.path) if one.head == choice.point)
    arcs = next(((one, two) for one, two in pairs if isinstance(one, Arc) and isinstance(two, Arc)), None)
    # The other place is the mirror image: about a line through this point in that direction.
    if side in (Side.NEARER, Side.FARTHER, Side.SHORTER, Side.LONGER):
        lines = (each for each in (*figure.path, *figure.lines) if isinstance(each, Line))
        line = next((each for each in lines if choice.point in (each.tail, each.head)), None)
        circle = next((each for each in circles if each.point == choice.point), None)
        if line is None or circle is None:
            return None
        through, along, radius = place.point(circle.center), -1j * place.heading(line), place.at.radius(circle.radius)
        begin = place.point(line.head if choice.point == line.tail else line.tail) if line.head else 0j
    elif arcs:
        through, begin = place.point(arcs[0].center), place.point(arcs[0].tail)
        along, radius = unit(place.point(arcs[1].center) - through), min(place.at.radius(each.radius) for each in arcs)
    else:
        arc = next((each for each in figure.path if isinstance(each, Arc) and each.center == choice.point), None)
        on_it = [each.point for each in circles if arc and each.center == arc.center and each.point != arc.tail]
        if arc is None or not on_it:
            return None
        stated = {fact.placed.point for fact in facts if fact.placed and fact.placed.is_stepped}
        through = begin = place.point(arc.tail)
        along = unit(place.point(min(on_it, key=lambda point: point not in stated)) - through)
        radius = place.at.radius(arc.radius)
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
