"""Systems of equations: the unknowns of a figure, and the facts about them."""

from collections.abc import Iterable, Mapping
from functools import lru_cache

from msgspec import Struct

from contoursolve.geometry.fact import Fact
from contoursolve.geometry.figure import Figure, Line, both, line_scalars
from contoursolve.geometry.profile import Layout, Profile


def headed_lines(figure: Figure) -> dict[str, tuple[str, str]]:
    """The lines of a figure whose direction is a given, each with that given and with a point of the line."""
    lines = (line for line in (*figure.path, *figure.lines) if isinstance(line, Line))
    return {
        line.name: (line.heading, line.tail)
        for line in lines
        if line.heading is not None and line.name not in figure.carriers
    }


class System(Struct, frozen=True, eq=False):
    """Unknown scalars and the facts about them.

    The coordinates of the figure's start and places are known, all other points, the radii and the carriers
    are unknown. `choices` are the points with two solutions between which something outside the facts chooses.
    Caches go by systems: those are equal whose `key` and facts are; by how much a fact may be off is not in its text.
    `equations_key` leaves out the path and the corners, which state nothing about the points.
    """

    figure: Figure
    facts: tuple[Fact, ...]
    choices: tuple[str, ...]
    unknowns: tuple[str, ...]
    headed: Mapping[str, tuple[str, str]]
    known: frozenset[str]
    equations_key: str
    key: str

    def __eq__(self, other: object) -> bool:
        return isinstance(other, System) and self.key == other.key and self.facts == other.facts

    def __hash__(self) -> int:
        return hash(self.key)

    def unknowns_of(self, fact: Fact) -> tuple[str, ...]:
        """The unknown scalars that a fact mentions."""
        return self.unknowns_among(fact.reads())

    def unknowns_among(self, reads: Iterable[str]) -> tuple[str, ...]:
        """The unknown scalars behind names that a fact reads; a line of given direction is known by its tail."""
        names: dict[str, None] = {}
        for name in reads:
            line, _, part = name.rpartition(".")
            if line not in self.headed or part not in ("cos", "sin", "off"):
                names[name] = None
            elif part == "off":
                names.update(dict.fromkeys(both(self.headed[line][1])))
        return tuple(name for name in names if name not in self.known)

    def keep(self, facts: tuple[Fact, ...]) -> "System":
        """The same figure with other facts."""
        return build_system(self.figure, facts, self.choices)


@lru_cache(maxsize=8192)
def build_system(figure: Figure, facts: tuple[Fact, ...], choices: tuple[str, ...] = ()) -> System:
    """The system of a figure; equal arguments give the same object."""
    lines = (name for line in figure.carriers for name in line_scalars(line))
    unknowns = (*both(*figure.points), *figure.radii, *lines)
    equations_key = f"{','.join(unknowns)}: {'; '.join(map(str, facts))}"
    known = frozenset((*both(figure.start, *figure.places), *figure.known_radii))
    key = f"{equations_key} | {figure} | {choices}"
    return System(figure, facts, choices, unknowns, headed_lines(figure), known, equations_key, key)


def assemble(profile: Profile) -> System:
    """The system of equations of a profile."""
    return _of_layout(profile.layout, tuple(choice.point for choice in profile.choices))


@lru_cache(maxsize=8192)
def _of_layout(layout: Layout, choices: tuple[str, ...]) -> System:
    return build_system(layout.figure, layout.facts, choices)
