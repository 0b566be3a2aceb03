"""Chains of lines and arcs with facts that are true of them, to hold the engine against: no import of the package.

A place is a complex number: real is X, imaginary is Y, both in mm. Angles are degrees, counter-clockwise from +X.

>>> chain = random_chain(Random(1), 3)
>>> facts = random_facts(chain, Random(1), swaps=3)
>>> len(facts) == chain.freedom, max(abs(measure(chain, fact)) for fact in facts) < 1e-11
(True, True)
"""

from cmath import exp, phase
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from functools import cached_property
from math import copysign, degrees, hypot, inf, pi, radians, remainder, tau
from random import Random
from typing import NamedTuple

import numpy
from records import replace

POINT_KINDS = ("x of point", "y of point")
KINDS = (
    *POINT_KINDS,
    "x of center",
    "y of center",
    "radius",
    "direction",
    "length",
    "angle",
    "tangent",
    "passes through",
    "tangent to circle",
    "tangent to line",
    "equal length",
    "equal radius",
)
"""Every kind of fact. Of the `POINT_KINDS`, `Fact.elements` holds the number of a point, of all others of elements."""


@dataclass(frozen=True)
class Line:
    """Where it runs is said by the chain's points."""


@dataclass(frozen=True)
class Arc:
    turn: str
    """`cw` or `ccw`."""
    center: complex
    radius: float

    @property
    def sign(self) -> int:
        return 1 if self.turn == "ccw" else -1


Element = Line | Arc


@dataclass(frozen=True)
class Fact:
    kind: str
    elements: tuple[int, ...]
    """Numbers of elements, from 1; of a point's coordinate, the number of the point."""
    values: tuple[float, ...]
    text: str


@dataclass(frozen=True)
class Chain:
    points: tuple[complex, ...]
    """P0 to Pn; P0 is known."""
    elements: tuple[Element, ...]

    def line(self, number: int) -> tuple[complex, complex]:
        """Start and travel (a vector, as long as the line) of a line."""
        start = self.points[number - 1]
        return start, self.points[number] - start

    def arc(self, number: int) -> Arc:
        element = self.elements[number - 1]
        assert isinstance(element, Arc)
        return element

    def is_arc(self, number: int) -> bool:
        return isinstance(self.elements[number - 1], Arc)

    @cached_property
    def numbers(self) -> range:
        return range(1, len(self.elements) + 1)

    @cached_property
    def arcs(self) -> tuple[int, ...]:
        return tuple(number for number in self.numbers if self.is_arc(number))

    @cached_property
    def lines(self) -> tuple[int, ...]:
        return tuple(number for number in self.numbers if not self.is_arc(number))

    @property
    def freedom(self) -> int:
        """How many facts determine the chain: two coordinates a point, and one more each arc."""
        return 2 * len(self.elements) + len(self.arcs)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the `variables`."""
        points = [f"{axis} of P{number}" for number in self.numbers for axis in "XY"]
        arcs = [
            name.format(number)
            for number in self.arcs
            for name in ("X of center of E{}", "Y of center of E{}", "radius of E{}")
        ]
        return (*points, *arcs)

    @property
    def variables(self) -> tuple[float, ...]:
        """Coordinates of P1 to Pn, then centre and radius of every arc."""
        found = [part for point in self.points[1:] for part in (point.real, point.imag)]
        for number in self.arcs:
            arc = self.arc(number)
            found += (arc.center.real, arc.center.imag, arc.radius)
        return tuple(found)

    def at(self, variables: Sequence[float]) -> "Chain":
        """The same form with other values of the `variables`; arcs need not meet their points."""
        count = len(self.elements)
        given = [float(value) for value in variables]
        points = (self.points[0], *(complex(given[2 * k], given[2 * k + 1]) for k in range(count)))
        elements = list(self.elements)
        for place, number in enumerate(self.arcs):
            x, y, radius = given[2 * count + 3 * place : 2 * count + 3 * place + 3]
            elements[number - 1] = replace(self.arc(number), center=complex(x, y), radius=radius)
        return Chain(points, tuple(elements))

    def heading(self, number: int, *, at_end: bool) -> complex:
        """Direction of travel where an element begins or ends, as a vector of any length."""
        if not self.is_arc(number):
            return self.line(number)[1]
        arc = self.arc(number)
        spoke = self.points[number if at_end else number - 1] - arc.center
        return spoke * 1j * arc.sign

    def length(self, number: int) -> float:
        if not self.is_arc(number):
            return abs(self.line(number)[1])
        return self.arc(number).radius * radians(self.sweep(number))

    def sweep(self, number: int) -> float:
        """Degrees that an arc turns through, above 0 and at most 360."""
        arc = self.arc(number)
        start, end = self.points[number - 1] - arc.center, self.points[number] - arc.center
        return degrees(arc.sign * phase(end * start.conjugate()) % tau) or 360.0

    @property
    def extent(self) -> float:
        """Size of a typical element in mm."""
        sizes = [self.arc(n).radius if self.is_arc(n) else self.length(n) for n in self.numbers]
        return sum(sizes) / len(sizes)

    @property
    def is_proper(self) -> bool:
        """Whether no line is without length and no arc without radius."""
        return all(self.length(n) > 0 for n in self.lines) and all(self.arc(n).radius > 0 for n in self.arcs)


def wrapped(angle: float) -> float:
    """The same angle in (-180, 180]."""
    turned = remainder(angle, 360.0)
    return 180.0 if turned <= -180.0 else turned


def offset_of(place: complex, start: complex, travel: complex) -> float:
    """Signed distance of a place from a line; positive to the left of its travel."""
    return (travel.conjugate() * (place - start)).imag / abs(travel) if travel else inf


def direction(travel: complex) -> float:
    return wrapped(degrees(phase(travel)))


def measure(chain: Chain, fact: Fact) -> float:  # noqa: C901 - a case for each kind of fact
    """By how much a chain misses a fact: mm, or degrees for the `ANGULAR` kinds. Depends on no other fact."""
    first = fact.elements[0]
    match fact.kind, fact.values:
        case "x of point", (x,):
            return chain.points[first].real - x
        case "y of point", (y,):
            return chain.points[first].imag - y
        case "x of center", (x,):
            return chain.arc(first).center.real - x
        case "y of center", (y,):
            return chain.arc(first).center.imag - y
        case "radius", (radius,):
            return chain.arc(first).radius - radius
        case "direction", (angle,):
            return wrapped(direction(chain.line(first)[1]) - angle)
        case "length", (length,):
            return chain.length(first) - length
        case "angle", (angle,):
            return wrapped(turn_between(chain, *fact.elements) - angle)
        case "tangent", ():
            return turn_between(chain, *fact.elements)
        case "passes through", (x, y):
            if chain.is_arc(first):
                arc = chain.arc(first)
                return abs(complex(x, y) - arc.center) - arc.radius
            return offset_of(complex(x, y), *chain.line(first))
        case "tangent to circle", (x, y, radius):
            if chain.is_arc(first):
                arc = chain.arc(first)
                distance = abs(complex(x, y) - arc.center)
                outside, inside = distance - (arc.radius + radius), distance - abs(arc.radius - radius)
                return outside if abs(outside) < abs(inside) else inside
            return abs(offset_of(complex(x, y), *chain.line(first))) - radius
        case "tangent to line", (x, y, angle):
            arc = chain.arc(first)
            return abs(offset_of(arc.center, complex(x, y), exp(1j * radians(angle)))) - arc.radius
        case "equal length", ():
            return chain.length(first) - chain.length(fact.elements[1])
        case "equal radius", ():
            return chain.arc(first).radius - chain.arc(fact.elements[1]).radius
    raise ValueError(fact)


def turn_between(chain: Chain, first: int, second: int) -> float:
    """Degrees by which the direction of travel changes from the end of one element to the start of another."""
    before, after = chain.heading(first, at_end=True), chain.heading(second, at_end=False)
    return wrapped(degrees(phase(after * before.conjugate())))


def form_residuals(chain: Chain) -> list[float]:
    """By how much the ends of each arc miss its circle, mm: the equations that no fact needs to say."""
    found = []
    for number in chain.arcs:
        arc = chain.arc(number)
        found += [abs(chain.points[end] - arc.center) - arc.radius for end in (number - 1, number)]
    return found


def residuals(chain: Chain, facts: Sequence[Fact]) -> list[float]:
    """Those of the form, then one for each fact."""
    return form_residuals(chain) + [measure(chain, fact) for fact in facts]


def distance_between(one: Chain, other: Chain) -> float:
    """Largest difference in mm of any coordinate or radius of two chains of one form."""
    return max(abs(a - b) for a, b in zip(one.variables, other.variables, strict=True))


# Facts, written in the engine's words


def number_text(value: float) -> str:
    """The shortest decimal that reads back as the same double, without an exponent."""
    return format(Decimal(repr(value + 0.0)), "f")


TEXTS = {
    "x of point": "X of P{0} = {v0}",
    "y of point": "Y of P{0} = {v0}",
    "x of center": "X of center of E{0} = {v0}",
    "y of center": "Y of center of E{0} = {v0}",
    "radius": "radius of E{0} = {v0}",
    "direction": "direction of E{0} = {v0}",
    "length": "length of E{0} = {v0}",
    "angle": "angle from E{0} to E{1} = {v0}",
    "tangent": "E{0} tangent to E{1}",
    "passes through": "E{0} passes through (X{v0} Y{v1})",
    "tangent to circle": "E{0} tangent to circle (X{v0} Y{v1} R{v2})",
    "tangent to line": "E{0} tangent to line (X{v0} Y{v1} A{v2})",
    "equal length": "length of E{0} = length of E{1}",
    "equal radius": "radius of E{0} = radius of E{1}",
}


def fact_of(kind: str, elements: Sequence[int], values: Sequence[float] = ()) -> Fact:
    """
    >>> fact_of("tangent to circle", (1,), (3.0, -4.5, 5e-7)).text
    'E1 tangent to circle (X3.0 Y-4.5 R0.0000005)'
    """
    named = {f"v{place}": number_text(value) for place, value in enumerate(values)}
    return Fact(kind, tuple(elements), tuple(values), TEXTS[kind].format(*elements, **named))


# Chains


def random_chain(random: Random, size: int, *, offset: float = 0.0, scale: float = 1.0, smooth: float = 0.4) -> Chain:
    """
    A chain without accidents: lines of 5 to 60 mm, radii of 5 to 40 mm, sweeps of 20 to 300 degrees, no cusp,
    nothing collinear; all of it times `scale`. The start is off by up to `offset` mm along each axis.

    About `smooth` of the junctions are; now and then a length or a radius is the one of an earlier element.
    """
    place = complex(random.uniform(-offset, offset), random.uniform(-offset, offset))
    heading = exp(1j * random.uniform(-pi, pi))
    points, elements = [place], list[Element]()
    lengths, radii = list[float](), list[float]()
    for _ in range(size):
        is_line = random.random() < 0.5
        before = elements[-1] if elements else None
        is_smooth = before is not None and random.random() < smooth and not (is_line and isinstance(before, Line))
        if before is not None and not is_smooth:
            heading *= exp(1j * radians(copysign(random.uniform(15, 150), random.uniform(-1, 1))))
        if is_line:
            length = repeated(random, lengths, 5 * scale, 60 * scale)
            place += length * heading
            elements.append(Line())
        else:
            radius = repeated(random, radii, 5 * scale, 40 * scale)
            turn = random.choice(("cw", "ccw"))
            while is_smooth and isinstance(before, Arc) and before.turn == turn and is_close(radius, before.radius):
                radius = random.uniform(5, 40) * scale
            sign = 1 if turn == "ccw" else -1
            rotation = exp(1j * sign * radians(random.uniform(20, 300)))
            center = place + 1j * sign * radius * heading
            elements.append(Arc(turn, center, radius))
            place = center + (place - center) * rotation
            heading *= rotation
        points.append(place)
    return Chain(tuple(points), tuple(elements))


def is_close(one: float, other: float) -> bool:
    return abs(one - other) < 0.05 * max(one, other)


def repeated(random: Random, earlier: list[float], low: float, high: float) -> float:
    """A new number, or now and then an earlier one."""
    if earlier and random.random() < 0.2:
        return random.choice(earlier)
    found = random.uniform(low, high)
    earlier.append(found)
    return found


# Facts that are true of a chain


def all_facts(chain: Chain, random: Random | None = None, copies: int = 1) -> list[Fact]:
    """
    Every fact of the vocabulary that is true of a chain.

    Places to pass through, and circles and lines to touch, are drawn at random: `copies` of each for an element.
    """
    return list(_all_facts(chain, random or Random(0), copies))


def _all_facts(chain: Chain, random: Random, copies: int) -> Iterator[Fact]:
    for number in chain.numbers:
        yield fact_of("x of point", (number,), (chain.points[number].real,))
        yield fact_of("y of point", (number,), (chain.points[number].imag,))
    for number in chain.arcs:
        arc = chain.arc(number)
        yield fact_of("x of center", (number,), (arc.center.real,))
        yield fact_of("y of center", (number,), (arc.center.imag,))
        yield fact_of("radius", (number,), (arc.radius,))
    for number in chain.lines:
        yield fact_of("direction", (number,), (direction(chain.line(number)[1]),))
    for number in chain.numbers:
        yield fact_of("length", (number,), (chain.length(number),))
    yield from _relations(chain)
    for number in chain.numbers:
        for _ in range(copies):
            yield from (_arc_contacts if chain.is_arc(number) else _line_contacts)(chain, number, random)


def _relations(chain: Chain) -> Iterator[Fact]:
    for first in chain.numbers:
        for second in chain.numbers[first:]:
            are_lines = not (chain.is_arc(first) or chain.is_arc(second))
            are_arcs = chain.is_arc(first) and chain.is_arc(second)
            if second == first + 1 or are_lines:
                angle = turn_between(chain, first, second)
                is_smooth = abs(angle) < 1e-6
                yield fact_of("angle", (first, second), (0.0 if is_smooth else angle,))
                if is_smooth and second == first + 1:
                    yield fact_of("tangent", (first, second))
            if are_lines and abs(chain.length(first) - chain.length(second)) < 1e-9 * chain.length(first):
                yield fact_of("equal length", (first, second))
            if are_arcs and chain.arc(first).radius == chain.arc(second).radius:
                yield fact_of("equal radius", (first, second))


def _line_contacts(chain: Chain, number: int, random: Random) -> Iterator[Fact]:
    start, travel = chain.line(number)
    place = start + travel * random.uniform(-1, 2)
    yield fact_of("passes through", (number,), (place.real, place.imag))
    radius = random.uniform(0.1, 1.0) * chain.extent
    place = start + travel * random.uniform(-1, 2) + random.choice((1j, -1j)) * radius * travel / abs(travel)
    yield fact_of("tangent to circle", (number,), (place.real, place.imag, radius))


def _arc_contacts(chain: Chain, number: int, random: Random) -> Iterator[Fact]:
    arc = chain.arc(number)
    place = arc.center + arc.radius * exp(1j * random.uniform(-pi, pi))
    yield fact_of("passes through", (number,), (place.real, place.imag))
    share = random.choice((random.uniform(0.1, 0.8), random.uniform(1.25, 2.0)))
    """Well away from 1, where the two circles would be one."""
    inward = random.choice((1, -1))
    place = arc.center + arc.radius * (1 - inward * share) * exp(1j * random.uniform(-pi, pi))
    yield fact_of("tangent to circle", (number,), (place.real, place.imag, arc.radius * share))
    spoke = exp(1j * random.uniform(-pi, pi))
    travel = spoke * random.choice((1j, -1j))
    place = arc.center + arc.radius * spoke + travel * random.uniform(-1, 1) * chain.extent
    yield fact_of("tangent to line", (number,), (place.real, place.imag, direction(travel)))


def standard_facts(chain: Chain) -> list[Fact]:
    """
    A set that determines a chain plainly, and no other chain: all points, and one coordinate of each centre.

    It is the coordinate that says where on its bisector the centre is.
    """
    found = []
    for number in chain.numbers:
        found.append(fact_of("x of point", (number,), (chain.points[number].real,)))
        found.append(fact_of("y of point", (number,), (chain.points[number].imag,)))
    for number in chain.arcs:
        chord = chain.points[number] - chain.points[number - 1]
        center = chain.arc(number).center
        if abs(chord.imag) >= abs(chord.real):
            found.append(fact_of("x of center", (number,), (center.real,)))
        else:
            found.append(fact_of("y of center", (number,), (center.imag,)))
    return found


# Whether facts determine a chain, numerically


def jacobian(chain: Chain, facts: Sequence[Fact]) -> numpy.ndarray:
    """
    Rows of the form and of the facts over the `variables`, by central differences; every row has length 1.

    A row that does not depend on anything stays zero.
    """
    variables = list(chain.variables)
    rows = numpy.zeros((2 * len(chain.arcs) + len(facts), len(variables)))
    step = 1e-5 * chain.extent
    for column, value in enumerate(variables):
        above, below = (chain.at([*variables[:column], value + s, *variables[column + 1 :]]) for s in (step, -step))
        rows[:, column] = numpy.subtract(residuals(above, facts), residuals(below, facts)) / (2 * step)
    lengths = numpy.linalg.norm(rows, axis=1, keepdims=True)
    return rows / numpy.where(lengths > 0, lengths, 1)


def ratio(rows: numpy.ndarray) -> float:
    values = numpy.linalg.svd(rows, compute_uv=False)
    return float(values[-1] / values[0])


class Pool(NamedTuple):
    """Facts with their rows of the Jacobian."""

    facts: list[Fact]
    rows: dict[Fact, numpy.ndarray]
    form: numpy.ndarray


def pool_of(chain: Chain, facts: Sequence[Fact]) -> Pool:
    rows = jacobian(chain, facts)
    count = 2 * len(chain.arcs)
    return Pool(list(facts), dict(zip(facts, rows[count:], strict=True)), rows[:count])


def random_facts(chain: Chain, random: Random, swaps: int, *, floor: float = 1e-6, copies: int = 2) -> list[Fact]:
    """
    The standard facts, of which `swaps` are replaced by others (all, if there are fewer): the right number of them,
    true of the chain, and the chain is an isolated solution, since its `condition` is above `floor`.

    Every kind of fact is as likely as any other; other solutions may exist.
    """
    standard = standard_facts(chain)
    texts = {fact.text for fact in standard}
    others = [fact for fact in all_facts(chain, random, copies) if fact.text not in texts]
    pool = pool_of(chain, [*standard, *others])
    for attempt in range(200):
        # A form may offer too few others (a single line: five): then some of the erased may come back.
        erased = set(random.sample(range(len(standard)), min(swaps, len(standard))))
        kept = [fact for place, fact in enumerate(standard) if place not in erased]
        again = [fact for place, fact in enumerate(standard) if place in erased] if attempt >= 20 else []
        found = completed(pool, kept, others, random, floor) or (
            completed(pool, kept, others + again, random, floor) if again else None
        )
        if found is not None:
            return found
    raise AssertionError(f"no determining set found for {chain}")


def completed(
    pool: Pool, kept: Sequence[Fact], others: Sequence[Fact], random: Random, floor: float
) -> list[Fact] | None:
    """As many others, in random order, as make the Jacobian square and regular; None if these do not."""
    found = list(kept)
    rows = numpy.vstack([pool.form, *(pool.rows[fact] for fact in found)])
    wanted = rows.shape[1] - rows.shape[0]
    basis = numpy.linalg.qr(rows.T)[0] if rows.size else numpy.zeros((rows.shape[1], 0))
    by_kind = defaultdict[str, list[Fact]](list)
    for fact in others:
        by_kind[fact.kind].append(fact)
    while wanted and by_kind:
        kind = random.choice(list(by_kind))
        fact = by_kind[kind].pop(random.randrange(len(by_kind[kind])))
        if not by_kind[kind]:
            del by_kind[kind]
        row = pool.rows[fact]
        new = row - basis @ (basis.T @ row)
        new -= basis @ (basis.T @ new)
        size = float(numpy.linalg.norm(new))
        if size > 1e-3:
            basis = numpy.column_stack([basis, new / size])
            rows = numpy.vstack([rows, row])
            found.append(fact)
            wanted -= 1
    return found if not wanted and ratio(rows) > floor else None


# Guesses and searches, for what solves by iteration


def perturbed(chain: Chain, random: Random, by: float = 1.0, share: float = 0.01) -> Chain:
    """Each variable moved by up to `by` mm and `share` of itself."""
    return chain.at([v + random.uniform(-1, 1) * (by + share * abs(v)) for v in chain.variables])


def newton(chain: Chain, facts: Sequence[Fact], rounds: int = 30) -> Chain | None:
    """A solution near a chain, by damped Newton steps; None if the residuals do not come down to rounding."""
    here = list(residuals(chain, facts))
    size = hypot(*here)
    for _ in range(rounds):
        if not size < 1e300:
            return None
        rows = raw_jacobian(chain, facts)
        step = numpy.linalg.lstsq(rows, -numpy.array(here), rcond=None)[0]
        share = 1.0
        while share > 1e-3:
            there = chain.at(numpy.array(chain.variables) + share * step)
            found = residuals(there, facts)
            if hypot(*found) < size:
                break
            share /= 2
        else:
            break
        chain, here, size = there, found, hypot(*found)
    return chain if size < 1e-9 * max(1.0, chain.extent) and chain.is_proper else None


def raw_jacobian(chain: Chain, facts: Sequence[Fact]) -> numpy.ndarray:
    """Rows as the residuals have them, mm or degrees per mm."""
    variables = list(chain.variables)
    step = 1e-6 * chain.extent
    columns = []
    for column, value in enumerate(variables):
        above, below = (chain.at([*variables[:column], value + s, *variables[column + 1 :]]) for s in (step, -step))
        columns.append(numpy.subtract(residuals(above, facts), residuals(below, facts)) / (2 * step))
    return numpy.column_stack(columns)


def solutions(
    chain: Chain, facts: Sequence[Fact], random: Random, starts: int = 20, spread: float = 1.0
) -> list[Chain]:
    """
    Different chains of the same form for which the facts are true, the chain itself first, found by Newton's method.

    A lower bound: more may exist. Starts are off by up to `spread` times the extent of the chain.
    """
    found = [chain]
    for _ in range(starts):
        other = newton(perturbed(chain, random, spread * chain.extent, 0.0), facts)
        if other and all(distance_between(other, known) > 1e-6 * chain.extent for known in found):
            found.append(other)
    return found
