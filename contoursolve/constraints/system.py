"""A figure and its facts as a system of equations, free of values."""

from dataclasses import dataclass
from functools import lru_cache

from contoursolve.model import FIRST, SECOND, Fact, Figure, Layout, Profile, scalar


@dataclass(frozen=True, slots=True, eq=False)
class System:
    """Unknown scalars and the facts about them.

    The coordinates of the figure's start are known, all other points and the radii are unknown.
    `choices` are the points with two solutions between which something outside the facts chooses.
    `key` is a text that is equal for equal systems; caches go by it. `equations_key` leaves out the
    path and the corners, which state nothing about the points.
    """

    figure: Figure
    facts: tuple[Fact, ...]
    choices: tuple[str, ...]
    unknowns: tuple[str, ...]
    equations_key: str
    key: str

    def __eq__(self, other: object) -> bool:
        return isinstance(other, System) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)

    def unknowns_of(self, fact: Fact) -> tuple[str, ...]:
        """The unknown scalars that a fact mentions."""
        known = {scalar(self.figure.start, FIRST), scalar(self.figure.start, SECOND)}
        return tuple(name for name in fact.reads() if name not in known)

    def keep(self, facts: tuple[Fact, ...]) -> "System":
        """The same figure with other facts."""
        return build_system(self.figure, facts, self.choices)


@lru_cache(maxsize=8192)
def build_system(figure: Figure, facts: tuple[Fact, ...], choices: tuple[str, ...] = ()) -> System:
    """The system of a figure; equal arguments give the same object."""
    coordinates = (scalar(point, axis) for point in figure.points for axis in (FIRST, SECOND))
    unknowns = (*coordinates, *figure.radii)
    equations_key = f"{','.join(unknowns)}: {'; '.join(map(str, facts))}"
    return System(figure, facts, choices, unknowns, equations_key, f"{equations_key} | {figure} | {choices}")


def assemble(profile: Profile) -> System:
    """The system of equations of a profile."""
    return _of_layout(profile.layout, tuple(choice.point for choice in profile.choices))


@lru_cache(maxsize=8192)
def _of_layout(layout: Layout, choices: tuple[str, ...]) -> System:
    return build_system(layout.figure, layout.facts, choices)
