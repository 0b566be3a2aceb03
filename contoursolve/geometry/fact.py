"""Facts as equations: what they have in common, the values that they look up, the vectors that they are made of."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence, Set
from functools import lru_cache, reduce
from typing import Any, NamedTuple, Protocol

from msgspec import Struct, field

from contoursolve.geometry.figure import FIRST, SECOND, line_scalars, scalar
from contoursolve.numeric import FLOATS, Created, Functions
from contoursolve.tolerance import AGREEMENT, RESIDUAL


class Lookup(Protocol):
    """Gives the values of points, radii and givens; a value is anything with `+ - * / **`."""

    def scalar(self, name: str) -> Any:
        """A coordinate, a radius, or a part of a line, by its name."""

    def coordinate(self, point: str, axis: int) -> Any:
        """One coordinate of a point, mm."""

    def radius(self, name: str) -> Any:
        """A radius, mm."""

    def amount(self, given: str) -> Any:
        """A given length or coordinate, mm."""

    def direction(self, given: str) -> tuple[Any, Any]:
        """Cosine and sine of a given angle."""

    def bearing(self, name: str) -> tuple[Any, Any]:
        """Cosine and sine of a line's direction."""

    def line(self, name: str) -> tuple[Any, Any, Any]:
        """Cosine and sine of a line's direction, and how far to the right of it the origin lies, mm.

        A point (x, y) lies `cosine * y - sine * x - offset` to the left of the line, mm.
        """

    def side(self, name: str) -> Any:
        """+1 or -1: on which side two elements touch."""

    def rotation(self, angle: Any) -> tuple[Any, Any]:
        """Cosine and sine of a computed angle, radians."""

    def root(self, value: Any) -> Any:
        """Square root."""

    def vanishes(self, value: Any) -> bool:
        """Whether a value is zero."""

    def first_that_moves(self, moves: Sequence[Any]) -> Any:
        """The first of some values that is not zero; the first one where all are."""


class Placed(NamedTuple):
    """A point that a fact puts somewhere along an axis, counted from `origin`, or from zero where that is empty; as far
    as a given says, or at the same place where it is not `is_stepped`."""

    point: str
    axis: int
    origin: str
    is_stepped: bool = True


class Clearance(NamedTuple):
    """A place about which a circle touches something else, and the radius of that, its distance: a line by its name, or
    a circle by centre and radius; and on which side."""

    center: str
    radius: str
    line: str
    circle: tuple[str, str]
    side: str | int


class Radial(NamedTuple):
    """A point of a circle that lies in a direction from its centre which a fact tells."""

    center: str
    radius: str
    point: str
    direction: Callable[["Lookup"], tuple[Any, Any]]


class Incidence(Protocol):
    """Points on lines and circles, as all facts of a system tell them."""

    read: Set[str]
    """The names of the scalars that the facts in question read."""

    def is_on(self, center: str, radius: str, *points: str) -> bool:
        """Whether facts put points on the circle about a centre, with that radius."""

    def radius_of(self, center: str, point: str) -> str:
        """The radius of the circle about a centre on which facts put a point; empty if none does."""

    def on_line(self, line: str) -> Set[str]:
        """All points on a line."""

    def points(self, line: str) -> list[str]:
        """Those of which both coordinates are among the scalars."""

    def touched(self, line: str, center: str) -> list[str]:
        """The points in which a line touches the circle about a centre."""


class OfCircle(NamedTuple):
    """A point that lies on a circle, and by how much it may be off it, mm."""

    point: str
    center: str
    radius: str
    slack: float


Increments = Callable[[str], Any]
"""The least increment of a coordinate by its axis, or of a value by its name."""


class Fact:
    """One equation. Its residual is in mm; `equation` is the same without what makes it no polynomial. What a kind does
    not say otherwise: its residual is a polynomial already, it holds in one sense only, and depends on the scalars for
    which residual and senses ask."""

    __slots__ = ()

    @property
    def given(self) -> str:
        """Name of the given that states this fact; empty for what the form itself states."""
        return ""

    def reads(self) -> tuple[str, ...]:
        """Names of the scalars that the residual depends on besides the given."""
        return _dependence(self).residual

    def sides(self) -> tuple[str, ...]:
        """Names of the sides on which it is not stated where two elements touch."""
        return _dependence(self).sides

    def residual(self, at: Lookup) -> Any:
        """Signed distance from being true, mm."""
        raise NotImplementedError

    def equation(self, at: Lookup) -> Any:
        """Zero where the residual is, and polynomial in coordinates, radii and directions where it can be."""
        return self.residual(at)

    def senses(self, _at: Lookup) -> tuple[Any, ...]:
        """Values that must be positive besides, because the equation alone allows the opposite."""
        return ()

    def sense_reads(self) -> tuple[str, ...]:
        """Names of the scalars that the residual and the senses depend on."""
        return _dependence(self).senses

    def implied(self, _at: Lookup) -> float | None:
        """The value of the given (mm or degrees) that makes the residual zero; None where any does."""
        return None

    def reach(self, _at: Lookup, _increment: Increments) -> Any:
        """The distance by which it moves with the last digit of each coordinate and word in it, mm; None where no word
        alone states it."""
        return None

    def allowance(self, at: Lookup, increment: Increments) -> Any:
        """The distance by which it may miss other facts, mm: every coordinate and every word is exact to half its
        increment."""
        reach = self.reach(at, increment)
        return AGREEMENT if reach is None else reach / 2 + RESIDUAL

    def follows(self, _known: Incidence, _at: Lookup) -> Iterator[Any]:
        """Expressions that are zero wherever it holds in its senses, together with the points on its lines and circles,
        and that read no more than it does."""
        return iter(())

    def excess(self, _at: Lookup) -> Any:
        """By how much a distance is more than it is to be, mm; None if the fact is about something else."""
        return None

    def phrase(self, _axes: tuple[str, str], _sought: Collection[str]) -> str:
        """The words for it without its value, where `sought` are the unknowns to be found; empty if that says all, or
        if it goes without saying."""
        return ""

    def places(self, _at: Lookup) -> Iterator[tuple[str, tuple[float, float]]]:
        """The lines (by name) and the circles (by centre) that it is about, each with where it holds."""
        return iter(())

    @property
    def statement(self) -> str:
        """The given of what states it, or of what it is a part of; empty for what the form itself states."""
        return self.given

    @property
    def placed(self) -> Placed | None:
        """The point that it puts somewhere along an axis, if it is about that alone."""
        return None

    @property
    def heading(self) -> tuple[str, str] | None:
        """The two points from the first of which to the second it runs at the given angle, if it is about that."""
        return None

    @property
    def circle(self) -> OfCircle | None:
        """The circle on which it puts a point, if it is about that."""
        return None

    @property
    def beside(self) -> Clearance | None:
        """The place about which it lets a circle touch a line, or a circle that passes another one at a distance."""
        return None

    @property
    def span(self) -> tuple[str, str] | None:
        """The two points whose distance it gives, if it is about that."""
        return None

    @property
    def passes(self) -> tuple[str, str] | None:
        """The line and the point of it through which it lets that pass, if it is about that."""
        return None

    @property
    def spoke(self) -> tuple[str, str] | None:
        """The centre and the point of a radius whose own direction is given; of two facts about it, the first tells."""
        return None

    @property
    def collinear(self) -> tuple[str, str, str] | None:
        """Two points and a third one on the line through them, if it is about that."""
        return None

    def affine_in(self, _unknowns: Set[str]) -> "Fact":
        """The same fact in a form whose residual is affine in some unknowns, if it has one."""
        return self

    @property
    def sizes(self) -> str:
        """The name of the radius to which it gives a value, if it is about that alone."""
        return ""

    @property
    def from_line(self) -> str:
        """The point that it puts on a line, or at a distance from one; empty if it is about something else."""
        return ""

    @property
    def is_affine(self) -> bool:
        """Whether its residual is affine in the coordinates of points, whatever the values are."""
        return False

    @property
    def foot(self) -> tuple[str, str, str] | None:
        """The line, the centre and the point in which that line touches the circle about it, if it is about that."""
        return None

    @property
    def contact(self) -> str:
        """The point in which it lets two elements touch, so that there is one place for it; empty otherwise."""
        return ""

    @property
    def side_names(self) -> tuple[str, str]:
        """The names of the two sides on which elements may touch where it does not state one."""
        return "left", "right"

    @property
    def centers(self) -> tuple[str, str] | None:
        """The centres of two circles that touch at a point, if it is about that point."""
        return None

    @property
    def radial(self) -> Radial | None:
        """The point of a circle whose direction from the centre it gives; of two facts about it, the first tells."""
        return None

    @property
    def directed(self) -> str:
        """The line whose own direction is given; empty if it is about something else."""
        return ""

    @property
    def vertex(self) -> str:
        """The point at which the direction of a radius, which it gives in parts, is an angle; empty otherwise."""
        return ""

    @property
    def turn_between(self) -> tuple[Any, Any] | None:
        """The two elements between whose directions it gives the angle, if it is about that."""
        return None

    @property
    def radius_step(self) -> tuple[str, str] | None:
        """The radius that is larger than another one as far as a given says, and that, if it is about that."""
        return None

    @property
    def parallel(self) -> tuple[str, str] | None:
        """The two lines that it makes parallel: its residual is the sine of the angle between them."""
        return None

    @property
    def is_ray(self) -> bool:
        """Whether it gives the direction of one line, and not the opposite one as well."""
        return False

    @property
    def is_half(self) -> bool:
        """Whether it is one part of a direction: its equation is true of the opposite one, too."""
        return False


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

    def first_that_moves(self, moves: Sequence[Any]) -> Any:
        unless_zero = self.functions.unless_zero
        if unless_zero is None:
            return next((move for move in moves if not self.vanishes(move)), moves[0])
        return reduce(lambda found, move: unless_zero(move, found), reversed(moves[:-1]), moves[-1])

    def root(self, value: Any) -> Any:
        return self.functions.root(value)


class _Dependence(NamedTuple):
    """The names of the scalars on which the residual of a fact depends, those with what its senses depend on, and the
    names of its open sides."""

    residual: tuple[str, ...]
    senses: tuple[str, ...]
    sides: tuple[str, ...]


@lru_cache(maxsize=65536)
def _dependence(fact: Fact) -> _Dependence:
    """The names that a fact asks for, at numbers that are no special ones."""
    names, sides = dict[str, float](), dict[str, int]()
    scalars = Created(lambda name: names.setdefault(name, (len(names) + 1) ** 1.5))
    given, turned = Created(lambda _: 0.5), Created(lambda _: (0.6, 0.8))
    at = Values(scalars, given, turned, signs=Created(lambda name: sides.setdefault(name, 1)))
    fact.residual(at)
    residual = tuple(names)
    fact.senses(at)
    return _Dependence(residual, tuple(names), tuple(sides))
