"""A drawing that has all that a contour states, whatever else it has: what further words would determine there.

At most values a word may determine what it does not at those that the others leave: the direction of a line through two
known points is one that it has already.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import pairwise, product
from math import cos, hypot, radians, sin

import numpy
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

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
    both,
    cross,
    dot,
    scalar,
    step,
)
from contoursolve.numeric import Created, pinv, svd
from contoursolve.reading import ParsedContour, read, stating
from contoursolve.solving import basis_of

Array = NDArray[numpy.float64]

MOST_UNKNOWNS = 60
"""Unknowns of a contour of which a drawing is looked for: about ten elements, a tenth of a second."""

TRIES, STEPS = 3, 40
"""Random places from which a drawing is looked for, and steps of the Gauss-Newton method from each."""

ARRIVED, STEP = 1e-8, 1e-6
"""mm. How well a drawing has what is stated, and how far unknowns are moved for a derivative."""

SHORTEST = 1e-4
"""Share of the size of a drawing that every line of it is longer than."""

RANK = 1e-6
"""Share of the largest singular value below which one counts as zero: derivatives are good to about 1e-9."""


class SampleDrawing(Struct, frozen=True, eq=False):
    """The rows of derivatives of what is stated at one drawing, and those of further words by their names. `own` are
    the columns of the contour's unknowns: further words may need lines of their own."""

    stated: Array
    further: Mapping[str, Array]
    own: tuple[int, ...]
    joints: Mapping[str, tuple[int, ...]]
    """The columns of points between two parts of one straight line, or of one circle."""

    def _rows(self, names: Collection[str]) -> Array:
        """The rows of what is stated and of these words, each of length 1."""
        rows = numpy.concatenate([self.stated, *(self.further[name] for name in names if name in self.further)])
        sizes = numpy.linalg.norm(rows, axis=1)
        found: Array = rows[sizes > 0] / sizes[sizes > 0, None]
        return found

    def cuts(self, names: Collection[str] = ()) -> list[str]:
        """The points that slide along a line or a circle, which they cut in two, while nothing else moves."""
        rows = self._rows(names)
        return [
            point
            for point, columns in self.joints.items()
            if rows.size and int((svd(rows[:, list(columns)])[1] > RANK).sum()) < len(columns)
        ]

    def missing(self, names: Collection[str] = ()) -> int:
        """The number of words that a path still lacks beside these: where a cut lies makes no difference to it."""
        return self.open_after(names) - len(self.cuts(names))

    def open_after(self, names: Collection[str] = ()) -> int:
        """In how many ways the contour still moves beside these words."""
        rows = self._rows(names)
        if not rows.size:
            return len(self.own)
        _, values, right = svd(rows)
        moves = right[int((values > RANK * values[0]).sum()) :, list(self.own)]
        return int((svd(moves)[1] > RANK).sum()) if moves.size else 0

    def helping(self, names: Sequence[str]) -> list[str]:
        """Those of some words that determine anything that is open."""
        open_ = self.missing()
        return [name for name in names if name not in self.further or self.missing((name,)) < open_]


def sample_drawing(claim: ParsedContour, profile: Profile, names: Sequence[str]) -> SampleDrawing | None:
    """A drawing of a contour in which some further words have the values that they have there; None where none is
    found, or the contour is too large."""
    whole = read(stating(claim, names), frozenset(fact.given for fact in profile.ignored))
    system = assemble(whole)
    if not profile.start.is_known or len(system.unknowns) > MOST_UNKNOWNS:
        return None
    profiled, own = {*profile.facts}, assemble(profile).unknowns
    if not {*own} <= {*system.unknowns}:
        return None  # with those words some corner is none
    stated = [fact for fact in system.facts if fact in profiled or not fact.given]
    equations = Equations(whole, system)
    consistent = {*basis_of(assemble(profile))}
    # Where what is stated contradicts itself, a drawing has as much of it as can be true.
    sets = [stated, [fact for fact in stated if fact in consistent]]
    for true, number in product(sets if len(sets[1]) < len(stated) else sets[:1], range(TRIES)):
        try:
            place = equations.solve(true, equations.random_place(number))
            if place is None or not equations.has_lengths(place):
                continue
            told = {name: [fact for fact in system.facts if fact.given == name] for name in names}
            rows = {name: equations.rows_at(facts, place) for name, facts in told.items() if facts}
            further = {name: each for name, each in rows.items() if each is not None}
            columns = tuple(equations.number[name] for name in own)
            joints = {
                point: tuple(equations.number[name] for name in both(point) if name in equations.number)
                for point in equations.joints_at(place, true)
            }
            slopes = equations.slopes(true, place)
            return SampleDrawing(slopes, further, columns, {point: each for point, each in joints.items() if each})
        except (ArithmeticError, ValueError, numpy.linalg.LinAlgError):
            continue  # at a random place something may be nothing that others are divided by
    return None


def helping_words(claim: ParsedContour, profile: Profile, absent: Sequence[str]) -> list[str]:
    """Those of some absent words that determine anything that is open; all where no drawing tells."""
    drawing = sample_drawing(claim, profile, absent)
    return [*absent] if drawing is None else drawing.helping(absent)


class Equations:
    """The facts of a system as functions of its unknowns."""

    def __init__(self, profile: Profile, system: System, side: int = 1) -> None:
        self.side = side
        """The side on which elements lie beside others, where nothing says it: 1 is the left."""
        self.system, self.number = system, {name: place for place, name in enumerate(system.unknowns)}
        starts = [float(value or 0) for value in profile.start.values]
        self.known = {scalar(profile.figure.start, axis): starts[axis] for axis in (FIRST, SECOND)}
        self.amounts = {name: float(given.value) for name, given in profile.givens.items()}
        angles = {name: self.amounts[name] for name, given in profile.givens.items() if given.unit is Unit.DEGREE}
        self.directions = {name: _direction(value) for name, value in angles.items()}
        lengths = [abs(value) for name, value in self.amounts.items() if name not in angles]
        self.size = max(1.0, *lengths, *map(abs, starts))
        self.scales = numpy.array([1.0 if name.endswith((".cos", ".sin")) else self.size for name in system.unknowns])

    def at(self, place: Array) -> Values:
        """A lookup at these values of the unknowns, each in its scale."""
        values = {**self.known, **dict(zip(self.number, (place * self.scales).tolist(), strict=True))}
        return Values(values, self.amounts, self.directions, self.system.headed, Created(lambda _: self.side))

    def residuals(self, facts: Sequence[Fact], place: Array) -> Array:
        """By how much facts are off, in the scale."""
        at = self.at(place)
        return numpy.array([float(fact.residual(at)) for fact in facts]) / self.size

    def slopes(self, facts: Sequence[Fact], place: Array) -> Array:
        """The derivatives of facts by the unknowns."""
        found, here = numpy.zeros((len(facts), place.size)), (place * self.scales).tolist()
        ends = [((place + way) * self.scales).tolist() for way in (STEP, -STEP)]
        # One lookup serves all: an unknown is moved in it and back.
        values = {**self.known, **dict(zip(self.number, here, strict=True))}
        at = replace(self.at(place), scalars=values)
        for row, fact in enumerate(facts):
            for name in self.system.unknowns_of(fact):
                number, off = self.number[name], []
                for moved in ends:
                    values[name] = moved[number]
                    off.append(float(fact.residual(at)) / self.size)
                values[name] = here[number]
                found[row, number] = (off[0] - off[1]) / (2 * STEP)
        return found

    def has_lengths(self, place: Array) -> bool:
        """Whether every line of the path has a length at a place: of one without, the direction says nothing."""
        at, least = self.at(place), self.size * SHORTEST
        lines = [each for each in self.system.figure.path if isinstance(each, Line) and each.tail and each.head]
        steps = [[at.coordinate(each.head, axis) - at.coordinate(each.tail, axis) for axis in (0, 1)] for each in lines]
        return all(hypot(*step) > least for step in steps)

    def joints_at(self, place: Array, facts: Sequence[Fact]) -> Iterator[str]:
        """The points without a corner between two parts of one straight line or of one circle, at a place, where
        these facts hold."""
        at, figure = self.at(place), self.system.figure
        sharp = {corner.at for corner in figure.corners}
        for first, second in pairwise(figure.path):
            if first.head in sharp:
                continue
            if isinstance(first, Line) and isinstance(second, Line):
                ways = [step(at, each.tail, each.head) for each in (first, second)]
                sizes = hypot(*ways[0]) * hypot(*ways[1])
                if abs(cross(*ways)) < RANK * sizes and not self._turns_back(first, second, facts):
                    yield first.head
            elif isinstance(first, Arc) and isinstance(second, Arc) and first.turn is second.turn:
                apart = (
                    hypot(*step(at, first.center, second.center)),
                    at.radius(first.radius) - at.radius(second.radius),
                )
                if max(map(abs, apart)) < RANK * self.size:
                    yield first.head

    def _turns_back(self, first: Line, second: Line, facts: Sequence[Fact]) -> bool:
        """Whether stated directions of two lines are opposite."""
        stated = (fact for fact in facts if isinstance(fact, Heading) and fact.given in self.directions)
        ways = {fact.heading: self.directions[fact.given] for fact in stated}
        own = [ways.get((each.tail, each.head)) for each in (first, second)]
        return own[0] is not None and own[1] is not None and dot(own[0], own[1]) < 0

    def random_place(self, seed: int) -> Array:
        """A place at random, with positive radii."""
        place = numpy.random.default_rng(seed).uniform(-1, 1, len(self.number))
        for name, number in self.number.items():
            place[number] = abs(place[number]) if name in self.system.figure.radii else place[number]
        return place

    def solve(self, facts: Sequence[Fact], place: Array, steps: int = STEPS) -> Array | None:
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

    def rows_at(self, facts: Sequence[Fact], place: Array) -> Array | None:
        """The derivatives of what a word states, with the value that it has at a place; None where no fact tells it."""
        given, at = facts[0].given, self.at(place)
        if given in self.directions:
            value = next((each for fact in facts if (each := fact.implied(at)) is not None), None)
            if value is None:
                return None
            self.directions[given] = _direction(value)
        return self.slopes(facts, place)


def _direction(angle: float) -> tuple[float, float]:
    return cos(radians(angle)), sin(radians(angle))
