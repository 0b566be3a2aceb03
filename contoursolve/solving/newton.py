"""The facts of a contour as functions of its unknowns, and places of these at which they hold."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import cos, hypot, radians, sin

import numpy

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Fact,
    Heading,
    Line,
    Profile,
    System,
    Unit,
    Values,
    assemble,
    cross,
    dot,
    scalar,
    step,
)
from contoursolve.numeric import Array, Created, pinv, svd
from contoursolve.solving.affine import rows_at
from contoursolve.solving.natural_layout import size_of
from contoursolve.tolerance import LENGTH

ARRIVED = 1e-8
"""mm. How well a place has what is stated."""

RANK = 1e-6
"""Share of the largest singular value below which one counts as zero."""

SHORTEST = 1e-4
"""Share of the size of a drawing that every element of it is longer than."""

MOST_STEPS = 40
"""Steps of the Gauss-Newton method."""

ROUNDING, POLISHED = 1e-15, 1e-10
"""The amount that rounding alone makes, and the step below which a place is taken, both in sizes of the drawing: where
two solutions are one, facts are true too early."""


class Equations:
    """The facts of a system as functions of its unknowns, each in a scale: lengths in sizes of the drawing."""

    def __init__(self, profile: Profile, system: System | None = None, signs: Mapping[str, int] | None = None) -> None:
        self.profile, self.system = profile, system or assemble(profile)
        self.number = {name: place for place, name in enumerate(self.system.unknowns)}
        starts = [float(value or 0) for value in profile.start.values]
        self.known = {scalar(profile.figure.start, axis): starts[axis] for axis in (FIRST, SECOND)}
        self.amounts = {name: float(given.value) for name, given in profile.givens.items()}
        angles = {name: self.amounts[name] for name, given in profile.givens.items() if given.unit is Unit.DEGREE}
        self.directions = {name: direction_of(value) for name, value in angles.items()}
        lines = [each for each in self.system.figure.path if isinstance(each, Line) and each.heading]
        headings: list[tuple[str | None, tuple[str, str]]] = [(each.heading, (each.tail, each.head)) for each in lines]
        headings += [(fact.given, fact.heading) for fact in self.system.facts if isinstance(fact, Heading)]
        self.stated = {ends: self.directions[given] for given, ends in headings if given in self.directions}
        """The stated directions of lines, by their ends."""
        self.size = size_of(profile, self.amounts, angles)
        self.scales = numpy.array(
            [1.0 if name.endswith((".cos", ".sin")) else self.size for name in self.system.unknowns]
        )
        self.signs: Mapping[str, int] = signs or Created(lambda _: 1)
        """The sides on which elements lie beside others, where nothing says it: 1 is the left."""
        self.rows = 0
        """The rows of derivatives that were worked out: what finding a place takes, whatever the clock says."""

    def scalars(self, place: Array) -> dict[str, float]:
        """The values of the unknowns at a place, mm."""
        return dict(zip(self.number, (place * self.scales).tolist(), strict=True))

    def place(self, scalars: Mapping[str, float]) -> Array:
        """The place of these values of the unknowns, mm."""
        return numpy.asarray([scalars[name] for name in self.number] / self.scales)

    def at(self, place: Array) -> Values:
        """A lookup at these values of the unknowns, each in its scale."""
        values = {**self.known, **self.scalars(place)}
        return Values(values, self.amounts, self.directions, self.system.headed, self.signs)

    def residuals(self, facts: Sequence[Fact], place: Array) -> Array:
        """By how much facts are off, in the scale."""
        at = self.at(place)
        return numpy.array([float(fact.residual(at)) for fact in facts]) / self.size

    def slopes(self, facts: Sequence[Fact], place: Array) -> Array:
        """The derivatives of facts by the unknowns, exact."""
        self.rows += len(facts)
        rows = rows_at(self.system, facts, self.at(place))
        return numpy.asarray(rows.matrix_of(range(len(facts))) * self.scales / self.size)

    def has_lengths(self, place: Array) -> bool:
        """Whether every element of the path has a length at a place: of one without, the direction says nothing."""
        at, least = self.at(place), self.size * SHORTEST
        path = [each for each in self.system.figure.path if isinstance(each, Line) or not each.may_be_full]
        steps = [[at.coordinate(each.head, axis) - at.coordinate(each.tail, axis) for axis in (0, 1)] for each in path]
        return all(hypot(*step) > least for step in steps)

    def runs_right(self, facts: Iterable[Fact], place: Array) -> bool:
        """Whether facts hold in their senses, lines run in the directions that belong to them, and radii are
        positive."""
        at, path = self.at(place), self.system.figure.path
        headed = {each.name for each in path if isinstance(each, Line) and each.heading in self.directions}
        if any(at.scalars.get(each.radius, 1.0) <= 0 for each in path if isinstance(each, Arc)):
            return False
        return headed.isdisjoint(self.against(place)) and all(
            float(sense) >= -LENGTH for fact in facts for sense in fact.senses(at)
        )

    def against(self, place: Array) -> frozenset[str]:
        """The lines of the path that run against their stated directions."""
        at, path = self.at(place), self.system.figure.path
        ways = {each.name: self.stated[each.tail, each.head] for each in path if (each.tail, each.head) in self.stated}
        steps = {each.name: step(at, each.tail, each.head) for each in path if each.name in ways}
        return frozenset(name for name, way in ways.items() if dot(steps[name], way) < -LENGTH)

    def turned(self, place: Array) -> Array:
        """A place with each line that runs against its stated direction turned round, and what follows with it: facts
        need not hold there."""
        at, values, against = self.at(place), self.scalars(place), self.against(place)
        moved = {self.system.figure.start: (0.0, 0.0)}
        for element in self.system.figure.path:
            shift = moved.get(element.tail, (0.0, 0.0))
            if element.name in against:
                way = step(at, element.tail, element.head)
                shift = shift[FIRST] - 2 * way[FIRST], shift[SECOND] - 2 * way[SECOND]
            moved |= dict.fromkeys((element.head, *([element.center] if isinstance(element, Arc) else ())), shift)
        for name, shift in moved.items():
            for axis in (FIRST, SECOND):
                if scalar(name, axis) in values:
                    values[scalar(name, axis)] += shift[axis]
        return self.place(values)

    def joints_at(self, place: Array) -> Iterator[str]:
        """The points without a corner between two parts of one straight line or of one circle, at a place."""
        at, figure = self.at(place), self.system.figure
        sharp = {corner.at for corner in figure.corners}
        for first, second in pairwise(figure.path):
            if first.head in sharp:
                continue
            if isinstance(first, Line) and isinstance(second, Line):
                ways = [step(at, each.tail, each.head) for each in (first, second)]
                sizes = hypot(*ways[0]) * hypot(*ways[1])
                if abs(cross(*ways)) < RANK * sizes and not self._turns_back(first, second):
                    yield first.head
            elif isinstance(first, Arc) and isinstance(second, Arc) and first.turn is second.turn:
                apart = (
                    hypot(*step(at, first.center, second.center)),
                    at.radius(first.radius) - at.radius(second.radius),
                )
                if max(map(abs, apart)) < RANK * self.size:
                    yield first.head

    def _turns_back(self, first: Line, second: Line) -> bool:
        """Whether stated directions of two lines are opposite."""
        ways = [self.stated.get((each.tail, each.head)) for each in (first, second)]
        return ways[0] is not None and ways[1] is not None and dot(ways[0], ways[1]) < 0

    def random_place(self, seed: int) -> Array:
        """A place at random, with positive radii."""
        place = numpy.random.default_rng(seed).uniform(-1, 1, len(self.number))
        for name, number in self.number.items():
            place[number] = abs(place[number]) if name in self.system.figure.radii else place[number]
        return place

    def solve(self, facts: Sequence[Fact], place: Array, steps: int = MOST_STEPS) -> Array | None:
        """The place at which all facts are true that is found from a place; None if there is none near it."""
        for _ in range(steps):
            off = self.residuals(facts, place)
            if not numpy.isfinite(off).all():
                return None
            if not off.size or numpy.abs(off).max() * self.size < ARRIVED:
                return place
            step = pinv(self.slopes(facts, place), rcond=RANK) @ -off
            place = place + step * min(1.0, 1.0 / max(float(numpy.abs(step).max()), 1e-300))
        return None

    def polished(self, facts: Sequence[Fact], place: Array) -> Array:
        """The same place to rounding."""
        for _ in range(MOST_STEPS):
            off = self.residuals(facts, place)
            if numpy.abs(off).max(initial=0.0) < ROUNDING:
                break
            step = pinv(self.slopes(facts, place), rcond=RANK * 1e-3) @ -off
            if numpy.abs(step).max() < POLISHED:
                break
            place = place + step
        return place

    def best(self, firm: Sequence[Fact], doubted: Sequence[Fact], place: Array) -> Array:
        """The place at which firm facts hold, and of doubted ones as much as can (least squares); the same place where
        none is doubted."""
        if not doubted:
            return place
        facts = [*firm, *doubted]
        weights = numpy.array([1.0] * len(firm) + [1e-3] * len(doubted))
        for _ in range(30):
            off = self.residuals(facts, place) * weights
            step = pinv(self.slopes(facts, place) * weights[:, None], rcond=RANK * 1e-3) @ -off
            place = place + step * min(1.0, 1.0 / max(float(numpy.abs(step).max(initial=0.0)), 1e-300))
        return place

    def rows_at(self, facts: Sequence[Fact], place: Array) -> Array | None:
        """The derivatives of what a word states, with the value that it has at a place; None where no fact tells it."""
        given, at = facts[0].given, self.at(place)
        if given in self.directions:
            value = next((each for fact in facts if (each := fact.implied(at)) is not None), None)
            if value is None:
                return None
            self.directions[given] = direction_of(value)
        return self.slopes(facts, place)


def direction_of(angle: float) -> tuple[float, float]:
    """Cosine and sine of an angle, degrees."""
    return cos(radians(angle)), sin(radians(angle))


def null_space(rows: Array) -> Array:
    """The motions that keep facts of these derivatives, orthonormal, one a row."""
    sizes = numpy.linalg.norm(rows, axis=1)
    rows = rows[sizes > 0] / sizes[sizes > 0, None]
    if not rows.size:
        return numpy.eye(rows.shape[1])
    _, values, right = svd(rows)
    return numpy.asarray(right[int((values > RANK * values[0]).sum()) :])
