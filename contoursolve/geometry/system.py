"""Facts as equations: what they have in common, the values that they look up, and the system that they make."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any, NamedTuple

from msgspec import Struct, field

from contoursolve.geometry.figure import (
    FIRST,
    SECOND,
    Clearance,
    Fact,
    Figure,
    Incidence,
    Increments,
    Line,
    Lookup,
    OfCircle,
    Placed,
    Radial,
    line_scalars,
    scalar,
)
from contoursolve.geometry.profile import Layout, Profile
from contoursolve.numeric import FLOATS, Created, Functions


class Equation:
    """A fact whose residual is a polynomial already, and that holds in one sense only; what it depends on is what its
    residual and its senses ask for."""

    __slots__ = ()

    def equation(self, at: Lookup) -> Any:
        return self.residual(at)

    def residual(self, at: Lookup) -> Any:
        raise NotImplementedError

    def senses(self, _at: Lookup) -> tuple[Any, ...]:
        return ()

    def reads(self) -> tuple[str, ...]:
        return _dependence(self).residual

    def sense_reads(self) -> tuple[str, ...]:
        return _dependence(self).senses

    def sides(self) -> tuple[str, ...]:
        return _dependence(self).sides

    def implied(self, _at: Lookup) -> float | None:
        return None

    def reach(self, _at: Lookup, _increment: Increments) -> Any:
        return None

    def excess(self, _at: Lookup) -> Any:
        return None

    def follows(self, _known: Incidence, _at: Lookup) -> Iterator[Any]:
        return iter(())

    def phrase(self, _axes: tuple[str, str], _sought: Collection[str]) -> str:
        return ""

    def places(self, _at: Lookup) -> Iterator[tuple[str, tuple[float, float]]]:
        return iter(())

    @property
    def statement(self) -> str:
        return str(getattr(self, "given", ""))

    @property
    def placed(self) -> Placed | None:
        return None

    @property
    def heading(self) -> tuple[str, str] | None:
        return None

    @property
    def circle(self) -> OfCircle | None:
        return None

    @property
    def beside(self) -> Clearance | None:
        return None

    @property
    def span(self) -> tuple[str, str] | None:
        return None

    @property
    def passes(self) -> tuple[str, str] | None:
        return None

    @property
    def spoke(self) -> tuple[str, str] | None:
        return None

    @property
    def collinear(self) -> tuple[str, str, str] | None:
        return None

    @property
    def sizes(self) -> str:
        return ""

    @property
    def from_line(self) -> str:
        return ""

    @property
    def is_affine(self) -> bool:
        return False

    @property
    def foot(self) -> tuple[str, str, str] | None:
        return None

    @property
    def centers(self) -> tuple[str, str] | None:
        return None

    @property
    def radial(self) -> Radial | None:
        return None

    @property
    def directed(self) -> str:
        return ""

    @property
    def vertex(self) -> str:
        return ""

    @property
    def turn_between(self) -> tuple[Any, Any] | None:
        return None

    @property
    def radius_step(self) -> tuple[str, str] | None:
        return None

    @property
    def parallel(self) -> tuple[str, str] | None:
        return None

    @property
    def is_ray(self) -> bool:
        return False

    @property
    def is_half(self) -> bool:
        return False


def both(*points: str) -> tuple[str, ...]:
    """The names of both coordinates of points."""
    return tuple(scalar(point, axis) for point in points for axis in (FIRST, SECOND))


def step(at: Lookup, tail: str, head: str) -> tuple[Any, Any]:
    """From one point to another, mm along each axis."""
    first, second = at.coordinate(tail, FIRST), at.coordinate(tail, SECOND)
    return at.coordinate(head, FIRST) - first, at.coordinate(head, SECOND) - second


def place(at: Lookup, point: str) -> tuple[float, float]:
    """The place of a point, mm."""
    return float(at.coordinate(point, FIRST)), float(at.coordinate(point, SECOND))


def size(value: Any, at: Lookup) -> Any:
    """The absolute value of a number of any kind."""
    return at.root(value * value)


def apart(at: Lookup, tail: str, head: str) -> Any:
    """The distance between two points, mm."""
    first, second = step(at, tail, head)
    return at.root(first**2 + second**2)


def dot(a: tuple[Any, Any], b: tuple[Any, Any]) -> Any:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1]


def cross(a: tuple[Any, Any], b: tuple[Any, Any]) -> Any:
    """Vector product; positive where b points to the left of a."""
    return a[0] * b[1] - a[1] * b[0]


def side_of(side: str | int, at: Lookup) -> Any:
    """The value of a side, whether stated or open."""
    return at.side(side) if isinstance(side, str) else side


def rotate(vector: tuple[Any, Any], by: tuple[Any, Any]) -> tuple[Any, Any]:
    """A vector turned by the angle of this cosine and sine."""
    return vector[0] * by[0] - vector[1] * by[1], vector[1] * by[0] + vector[0] * by[1]


class Values(Struct, frozen=True):
    """`scalars` holds coordinates, radii and lines by name, `amounts`, `directions` and `signs` the givens.

    A coordinate or a radius that is no scalar is a given. `headed` are the lines whose direction is a given,
    each with that given and with a point of the line.
    """

    scalars: Mapping[str, Any]
    amounts: Mapping[str, Any]
    directions: Mapping[str, tuple[Any, Any]]
    headed: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    signs: Mapping[str, Any] = field(default_factory=dict)
    functions: Functions = FLOATS

    def scalar(self, name: str) -> Any:
        return self.scalars[name] if name in self.scalars else self.amounts[name]

    def coordinate(self, point: str, axis: int) -> Any:
        return self.scalar(scalar(point, axis))

    def radius(self, name: str) -> Any:
        return self.scalar(name)

    def amount(self, given: str) -> Any:
        return self.amounts[given]

    def direction(self, given: str) -> tuple[Any, Any]:
        return self.directions[given]

    def bearing(self, name: str) -> tuple[Any, Any]:
        if name in self.headed:
            return self.direction(self.headed[name][0])
        cosine, sine, _ = line_scalars(name)
        return self.scalars[cosine], self.scalars[sine]

    def line(self, name: str) -> tuple[Any, Any, Any]:
        cosine, sine = self.bearing(name)
        if name not in self.headed:
            return cosine, sine, self.scalars[line_scalars(name)[2]]
        tail = self.headed[name][1]
        return cosine, sine, cosine * self.coordinate(tail, SECOND) - sine * self.coordinate(tail, FIRST)

    def side(self, name: str) -> Any:
        return self.signs[name]

    def rotation(self, angle: Any) -> tuple[Any, Any]:
        return self.functions.cosine(angle), self.functions.sine(angle)

    def vanishes(self, value: Any) -> bool:
        return self.functions.vanishes(value)

    def root(self, value: Any) -> Any:
        return self.functions.root(value)


class _Dependence(NamedTuple):
    """The names of the scalars on which the residual of a fact depends, those with what its senses depend on, and the
    names of its open sides."""

    residual: tuple[str, ...]
    senses: tuple[str, ...]
    sides: tuple[str, ...]


@lru_cache(maxsize=65536)
def _dependence(fact: Equation) -> _Dependence:
    """The names that a fact asks for, at numbers that are no special ones."""
    names, sides = dict[str, float](), dict[str, int]()
    scalars = Created(lambda name: names.setdefault(name, (len(names) + 1) ** 1.5))
    given, turned = Created(lambda _: 0.5), Created(lambda _: (0.6, 0.8))
    at = Values(scalars, given, turned, signs=Created(lambda name: sides.setdefault(name, 1)))
    fact.residual(at)
    residual = tuple(names)
    fact.senses(at)
    return _Dependence(residual, tuple(names), tuple(sides))


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
