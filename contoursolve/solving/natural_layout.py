"""A natural place of all unknowns of a contour: one element after the other, each as its own facts have it, else as the
path goes on. Facts that tell of several elements need not hold there."""

from cmath import phase, rect
from collections.abc import Mapping, Sequence
from itertools import chain
from math import hypot, pi, radians

import numpy

from contoursolve.geometry import FIRST, SECOND, Arc, Fact, Line, Profile, System, Values, both, line_scalars, scalar
from contoursolve.tolerance import LENGTH

SHARE, SWEPT, BEND = 0.3, radians(60), radians(35)
"""Length of an element of which nothing is known, in sizes of the drawing; angle of an arc; angle at a point."""

SPREAD = 0.4
"""Sizes of the drawing by which places of other seeds than 0 lie beside the natural one."""

_TINY = 1e-6
"""Share of the size of a drawing that counts as nothing."""


class NaturalLayout:
    """The values of all unknowns, mm. `hints` are coordinates that nothing states, but which are meant."""

    def __init__(self, profile: Profile, system: System, at: Values, size: float, hints: Mapping[str, float]) -> None:
        self.figure, self.system, self.at, self.size, self.hints = profile.figure, system, at, size, hints
        self.is_turned = any(profile.plane.diameters)
        facts = system.facts
        self.angles = {fact.heading: at.directions[fact.given] for fact in facts if fact.heading and fact.given}
        self.directed = {fact.directed: at.directions[fact.given] for fact in facts if fact.directed}
        self.lengths = {fact.span: at.amounts[fact.given] for fact in facts if fact.span}
        self.ends = {each.point: each.direction(at) for fact in facts if (each := fact.radial) is not None}
        self.told = told_by(facts, at.amounts, {**at.amounts, **at.scalars}, {})
        self.found: dict[str, float] = {}
        self.random, self.spread = numpy.random.default_rng(0), 0.0

    def values(self, seed: int = 0) -> dict[str, float]:
        """A place of all unknowns; from another seed than 0, one beside the natural one."""
        self.random, self.spread = numpy.random.default_rng(seed), SPREAD * self.size if seed else 0.0
        self.found = dict(self.told)
        here, heading = complex(*(self.at.scalar(name) for name in both(self.figure.start))), None
        for number, element in enumerate(self.figure.path):
            follow = self._arc if isinstance(element, Arc) else self._line
            here, heading = follow(number, element, here, heading)  # type: ignore[arg-type]
            self._put(element.head, here)
        for name in (name for name in self.figure.points if scalar(name, FIRST) not in self.found):
            self._put(name, self._beside(name))
        return {name: self._spread(name) for name in self.system.unknowns}

    def _spread(self, name: str) -> float:
        away = float(self.random.uniform(-1, 1))
        value = self.found.get(name, self.size * SHARE * (1 if name in self.figure.radii else away))
        is_free = name not in self.told and not name.endswith((".cos", ".sin"))
        moved = value + (self.spread * away if is_free else 0.0)
        return abs(moved) if name in self.figure.radii else moved

    def _put(self, point: str, place: complex) -> None:
        self.found |= dict(zip(both(point), (place.real, place.imag), strict=True))

    def _beside(self, point: str) -> complex:
        """A place near the points that are placed and that a fact mentions with this one."""
        mine = {*both(point)}
        near = [name for fact in self.system.facts if mine & {*fact.reads()} for name in fact.reads()]
        points = dict.fromkeys(name.rpartition(".")[0] for name in near if name in self.found and name[-1] == "0")
        placed = (both(name) for name in points if {*both(name)} <= {*self.found})
        places = [complex(*(self.found[each] for each in names)) for names in placed]
        middle = sum(places) / len(places) if places else 0.0
        return middle + self.size * SHARE * complex(self.random.uniform(-1, 1), self.random.uniform(-1, 1)) / 2

    def _ahead(self, number: int, here: complex) -> tuple[complex, int] | None:
        """The next point of the path that is known, and the number of elements up to it."""
        for count, element in enumerate(self.figure.path[number:], 1):
            names = both(element.head)
            if all(name in self.told for name in names):
                place = complex(*(self.told[name] for name in names))
                return (place, count) if abs(place - here) > self.size * _TINY else None
        return None

    def _way(self, number: int, here: complex, heading: float | None) -> tuple[float, float]:
        """The direction in which an element begins of which nothing tells it, and its length."""
        ahead = self._ahead(number, here)
        if ahead is not None:
            place, count = ahead
            return phase(place - here), abs(place - here) / count
        onwards = pi if self.is_turned else 0.0
        if heading is None:
            return onwards, self.size * SHARE
        return heading, self.size * SHARE

    def _line(self, number: int, line: Line, here: complex, heading: float | None) -> tuple[complex, float]:
        """The end of a line, and the direction in which it ends."""
        along, length = self._way(number, here, heading)
        stated = self.angles.get((line.tail, line.head), self.directed.get(line.name))
        stated = self.at.directions.get(line.heading, stated) if line.heading else stated
        if stated is not None:
            along = phase(complex(*stated))
        elif heading is not None and abs(rect(1, along) - rect(1, heading)) < _TINY:
            along += -BEND if self.is_turned else BEND
        length = abs(self.lengths.get((line.tail, line.head), length))
        step = rect(1, along)
        known = [(value, axis) for axis in (FIRST, SECOND) if (value := self._hinted(line.head, axis)) is not None]
        for value, axis in known if len(known) == 1 else ():
            begin, part = ((here.real, step.real), (here.imag, step.imag))[axis]
            length = abs((value - begin) / part) if abs(part) > _TINY else length
        head = self._with(line.head, here + length * step)
        along = phase(head - here) if abs(head - here) > LENGTH else along
        step = rect(1, along)
        offset = step.real * here.imag - step.imag * here.real
        self.found |= dict(zip(line_scalars(line.name), (step.real, step.imag, offset), strict=True))
        return head, along

    def _arc(self, number: int, arc: Arc, here: complex, heading: float | None) -> tuple[complex, float]:
        sign = arc.turn.sign
        along, length = self._way(number, here, heading)
        if heading is None and self._ahead(number, here) is not None:
            along -= sign * SWEPT / 2
        radius = self.told.get(arc.radius)
        begun = self.ends.get(arc.tail)
        outwards = rect(1, along - sign * pi / 2) if begun is None else complex(*begun)
        spoke = -(radius or length) * outwards
        center = self._with(arc.center, here + spoke)
        if radius is None:
            radius = max(abs(here - center), self.size * _TINY)
        ended = self.ends.get(arc.head)
        angle = phase(complex(*ended)) if ended else phase(here - center) + sign * SWEPT
        self._put(arc.center, center)
        self.found[arc.radius] = radius
        head = self._with(arc.head, center + rect(radius, angle))
        return head, phase(head - center) + sign * pi / 2

    def _hinted(self, point: str, axis: int) -> float | None:
        name = scalar(point, axis)
        return self.told.get(name, self.hints.get(name))

    def _with(self, point: str, place: complex) -> complex:
        """A place with the coordinates of a point that are told."""
        first, second = (self._hinted(point, axis) for axis in (FIRST, SECOND))
        return complex(place.real if first is None else first, place.imag if second is None else second)


def told_by(
    facts: Sequence[Fact], amounts: Mapping[str, float], known: Mapping[str, float], values: Mapping[str, float]
) -> dict[str, float]:
    """Some values of unknowns, with those that follow from one fact after the other. `known` are the coordinates of the
    start and of given places (mm). They are coordinates, and circles about known centres through known points."""
    found = dict(values)

    def get(point: str, axis: int) -> float | None:
        name = scalar(point, axis)
        return known.get(name, found.get(name))

    for _ in facts:
        before = len(found)
        for fact in facts:
            placed, circle = fact.placed, fact.circle
            if fact.sizes and fact.given:
                found.setdefault(fact.sizes, abs(amounts[fact.given]))
            elif placed is not None:
                origin = get(placed.origin, placed.axis) if placed.origin else 0.0
                if origin is not None:
                    step = amounts[fact.given] if placed.is_stepped else 0.0
                    found.setdefault(scalar(placed.point, placed.axis), origin + step)
            elif circle is not None and circle.radius not in found:
                pairs = [(get(circle.point, axis), get(circle.center, axis)) for axis in (FIRST, SECOND)]
                steps = [at - center for at, center in pairs if at is not None and center is not None]
                if len(steps) == len(pairs) and hypot(*steps) > 0:
                    found[circle.radius] = hypot(*steps)
        if len(found) == before:
            break
    return found


def size_of(profile: Profile, amounts: Mapping[str, float], angles: Mapping[str, object]) -> float:
    """The size of a drawing by its numbers alone, mm; at least 1."""
    starts = [float(value or 0) for value in profile.start.values]
    lengths = (abs(value) for name, value in amounts.items() if name not in angles)
    return max(1.0, hypot(*starts), *chain(lengths, (0.0,)))
