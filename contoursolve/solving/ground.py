"""What a profile states, as exact numbers: the ground on which every solution is proven."""

from collections.abc import Mapping
from dataclasses import dataclass

from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.constraints import Functions, System, Values
from contoursolve.model import FIRST, SECOND, Given, Profile, Unit, scalar
from contoursolve.solving.kernel import COSINE, SIDE, SINE
from contoursolve.solving.polynomial import draw, draw_direction

BALLS = Functions(ball.root, ball.cosine, ball.sine)


@dataclass(frozen=True, slots=True)
class Ground:
    """The known scalars and the givens of a profile, exactly as stated; mm and degrees."""

    scalars: Mapping[str, Number]
    amounts: Mapping[str, Number]
    angles: Mapping[str, Given]

    def values(self, scalars: Mapping[str, Number], signs: Mapping[str, int], system: System) -> Values:
        """A lookup of exact numbers and balls for the facts of a system."""
        directions = {name: ball.direction(given.value) for name, given in self.angles.items()}
        return Values({**self.scalars, **scalars}, self.amounts, directions, system.headed, signs, BALLS)

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
            return ball.exact(signs[name.removeprefix(SIDE)])
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
    )


def witness_of(name: str, signs: Mapping[str, int]) -> int:
    """What stands for an input of a kernel where it is asked which coefficients vanish for all values."""
    if name.startswith(SIDE):
        return signs[name.removeprefix(SIDE)]
    for cosine, sine in ((COSINE, SINE), (".cos", ".sin")):
        for number, ending in enumerate((cosine, sine)):
            if name.endswith(ending):
                return draw_direction(name.removesuffix(ending))[number]
    return draw(name)

