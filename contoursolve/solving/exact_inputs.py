"""The statements of a profile as exact numbers: the ground on which every solution is proven."""

from collections.abc import Mapping
from dataclasses import dataclass

from contoursolve.geometry import FIRST, SECOND, Given, Profile, System, Unit, Values, scalar
from contoursolve.numeric import COSINE, SIDE, Created, Number, ball
from contoursolve.solving.numbers import axes_of

REACH = 4.0
"""The reach of a search at first, in distances of the farthest that is given: there are the solutions that are
meant."""

SMALLEST = 1e-4
"""mm. The least radius or length of a line, and distance of the centres of circles that go on smoothly into each other,
that a search looks at: a tenth of the controls' least increment. A circle without a radius is a point, which touches
and meets whatever passes through it, and a line without a length has any direction."""

_SIDES = {sign: ball.exact(sign) for sign in (1, -1)}


@dataclass(frozen=True, slots=True)
class Ground:
    """The known scalars and the givens of a profile, exactly as stated; mm and degrees."""

    scalars: Mapping[str, Number]
    amounts: Mapping[str, Number]
    angles: Mapping[str, Given]
    travel: float
    """mm. How far from the start point all solutions are searched for."""

    def values(self, scalars: Mapping[str, Number], signs: Mapping[str, int], system: System) -> Values:
        """A lookup of exact numbers and balls for the facts of a system."""
        directions = Created(lambda name: ball.direction(self.angles[name].value))
        return Values({**self.scalars, **scalars}, self.amounts, directions, system.headed, signs, ball.FUNCTIONS)

    def nearby(self, system: System) -> float:
        """The distance from the start point within which solutions are searched for first: `REACH` times as far as
        anything that is given, mm."""
        starts, absolute = self._starts(system), axes_of(system)
        sizes = [
            abs(ball.middle(value) - (starts[absolute[name]] if name in absolute else 0.0))
            for name, value in self.amounts.items()
        ]
        return REACH * max([1e-3, *sizes])

    def farthest(self, system: System) -> float:
        """The distance from the start point within which all solutions are searched for, mm."""
        return max(self.travel, self.nearby(system))

    def _starts(self, system: System) -> list[float]:
        return [ball.middle(self.scalars.get(scalar(system.figure.start, axis), ball.exact(0.0))) for axis in (0, 1)]

    def sizes(self, system: System) -> dict[str, tuple[float, float]]:
        """An ordinary value of every unknown, and how far others ordinarily are from it."""
        size = self.nearby(system) / REACH
        ranges = self.reach(system, size).items()
        return {
            name: (0.0, size) if name in system.figure.radii else ((low + high) / 2, (high - low) / 2)
            for name, (low, high) in ranges
        }

    def reach(self, system: System, far: float) -> dict[str, tuple[float, float]]:
        """The range of every unknown so far from the start point, mm; radii are at least `SMALLEST`."""
        starts = self._starts(system)
        ranges: dict[str, tuple[float, float]] = {}
        for name in system.unknowns:
            part = name.rpartition(".")[2]
            if part in ("cos", "sin"):
                ranges[name] = (-1.0, 1.0)
            elif name in system.figure.radii:
                ranges[name] = (min(SMALLEST, far), far)
            elif part == "off":
                ranges[name] = (-far - sum(map(abs, starts)), far + sum(map(abs, starts)))
            else:
                start = starts[int(part)]
                ranges[name] = (start - far, start + far)
        return ranges

    def number(self, name: str, scalars: Mapping[str, Number], signs: Mapping[str, int]) -> Number:
        """The value of an input of a kernel."""
        found = scalars.get(name)
        if found is None:
            found = self.scalars.get(name)
        if found is None:
            found = self.amounts.get(name)
        if found is not None:
            return found
        if name.startswith(SIDE):
            return _SIDES[signs[name.removeprefix(SIDE)]]
        given, _, part = name.rpartition(":")
        cosine, sine = ball.direction(self.angles[given].value)
        return cosine if f":{part}" == COSINE else sine


def ground_of(profile: Profile) -> Ground:
    """The ground of a profile whose start is known."""
    start = {
        scalar(profile.figure.start, axis): ball.exact(value)
        for axis, value in zip((FIRST, SECOND), profile.start.values, strict=True)
        if value is not None
    }
    givens = profile.givens.items()
    return Ground(
        start,
        {name: ball.exact(given.value) for name, given in givens if given.unit is not Unit.DEGREE},
        {name: given for name, given in givens if given.unit is Unit.DEGREE},
        profile.travel,
    )
