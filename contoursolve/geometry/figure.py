"""A drawing without its values: points, lines, arcs and corners, what a fact about it is, the roles of blocks."""

from collections.abc import Callable, Collection, Iterable, Iterator, Set
from enum import Enum
from math import sqrt
from typing import Any, NamedTuple, Protocol

from msgspec import Struct


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


class Fact(Protocol):
    """One equation. Its residual is in mm; `equation` is the same without what makes it no polynomial."""

    @property
    def given(self) -> str:
        """Name of the given that states this fact; empty for what the form itself states."""

    def reads(self) -> tuple[str, ...]:
        """Names of the scalars that the residual depends on besides the given."""

    def sides(self) -> tuple[str, ...]:
        """Names of the sides on which it is not stated where two elements touch."""

    def residual(self, at: Lookup) -> Any:
        """Signed distance from being true, mm."""

    def equation(self, at: Lookup) -> Any:
        """Zero where the residual is, and polynomial in coordinates, radii and directions where it can be."""

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        """Values that must be positive besides, because the equation alone allows the opposite."""

    def sense_reads(self) -> tuple[str, ...]:
        """Names of the scalars that the residual and the senses depend on."""

    def implied(self, at: Lookup) -> float | None:
        """The value of the given (mm or degrees) that makes the residual zero; None where any does."""

    def reach(self, at: Lookup, increment: Increments) -> Any:
        """The distance by which it moves with the last digit of each coordinate and word in it, mm; None where no word
        alone states it."""

    def follows(self, known: Incidence, at: Lookup) -> Iterator[Any]:
        """Expressions that are zero wherever it holds in its senses, together with the points on its lines and circles,
        and that read no more than it does."""

    def excess(self, at: Lookup) -> Any:
        """By how much a distance is more than it is to be, mm; None if the fact is about something else."""

    def phrase(self, axes: tuple[str, str], sought: Collection[str]) -> str:
        """The words for it without its value, where `sought` are the unknowns to be found; empty if that says all, or
        if it goes without saying."""

    def places(self, at: Lookup) -> Iterator[tuple[str, tuple[float, float]]]:
        """The lines (by name) and the circles (by centre) that it is about, each with where it holds."""

    @property
    def statement(self) -> str:
        """The given of what states it, or of what it is a part of; empty for what the form itself states."""

    @property
    def placed(self) -> Placed | None:
        """The point that it puts somewhere along an axis, if it is about that alone."""

    @property
    def heading(self) -> tuple[str, str] | None:
        """The two points from the first of which to the second it runs at the given angle, if it is about that."""

    @property
    def circle(self) -> OfCircle | None:
        """The circle on which it puts a point, if it is about that."""

    @property
    def beside(self) -> Clearance | None:
        """The place about which it lets a circle touch a line, or a circle that passes another one at a distance."""

    @property
    def span(self) -> tuple[str, str] | None:
        """The two points whose distance it gives, if it is about that."""

    @property
    def passes(self) -> tuple[str, str] | None:
        """The line and the point of it through which it lets that pass, if it is about that."""

    @property
    def spoke(self) -> tuple[str, str] | None:
        """The centre and the point of a radius whose own direction is given; of two facts about it, the first tells."""

    @property
    def collinear(self) -> tuple[str, str, str] | None:
        """Two points and a third one on the line through them, if it is about that."""

    @property
    def sizes(self) -> str:
        """The name of the radius to which it gives a value, if it is about that alone."""

    @property
    def from_line(self) -> str:
        """The point that it puts on a line, or at a distance from one; empty if it is about something else."""

    @property
    def is_affine(self) -> bool:
        """Whether its residual is affine in the coordinates of points, whatever the values are."""

    @property
    def foot(self) -> tuple[str, str, str] | None:
        """The line, the centre and the point in which that line touches the circle about it, if it is about that."""

    @property
    def centers(self) -> tuple[str, str] | None:
        """The centres of two circles that touch at a point, if it is about that point."""

    @property
    def radial(self) -> Radial | None:
        """The point of a circle whose direction from the centre it gives; of two facts about it, the first tells."""

    @property
    def directed(self) -> str:
        """The line whose own direction is given; empty if it is about something else."""

    @property
    def vertex(self) -> str:
        """The point at which the direction of a radius, which it gives in parts, is an angle; empty otherwise."""

    @property
    def turn_between(self) -> tuple[Any, Any] | None:
        """The two elements between whose directions it gives the angle, if it is about that."""

    @property
    def radius_step(self) -> tuple[str, str] | None:
        """The radius that is larger than another one as far as a given says, and that, if it is about that."""

    @property
    def parallel(self) -> tuple[str, str] | None:
        """The two lines that it makes parallel: its residual is the sine of the angle between them."""

    @property
    def is_ray(self) -> bool:
        """Whether it gives the direction of one line, and not the opposite one as well."""

    @property
    def is_half(self) -> bool:
        """Whether it is one part of a direction: its equation is true of the opposite one, too."""


def scalar(point: str, axis: int) -> str:
    """The name of one coordinate of a point."""
    return f"{point}.{axis}"


def line_scalars(line: str) -> tuple[str, str, str]:
    """The names of a line's direction and place."""
    return f"{line}.cos", f"{line}.sin", f"{line}.off"


FIRST, SECOND = 0, 1
"""Indices of a plane's first and second axis."""


class Turn(Enum):
    """Sense of an arc, seen with the plane's first axis to the right and its second axis up."""

    CW = "cw"
    CCW = "ccw"

    @property
    def sign(self) -> int:
        """+1 for counter-clockwise, -1 for clockwise."""
        return 1 if self is Turn.CCW else -1


class Line(Struct, frozen=True):
    """A straight move; `heading` names the given angle in whose direction it must run, if any, `toward` the point
    towards which it must run from its tail. Of its two intersections with an arc, one is nearer along its direction;
    or else, where it `counts_length`, with one the line is shorter."""

    name: str
    tail: str
    head: str
    heading: str | None = None
    toward: str | None = None
    counts_length: bool = False
    is_signed: bool = False
    """Whether the sign of the corner word before it gives this direction."""


class Arc(Struct, frozen=True):
    """A circular move about an unknown centre; `radius` names the unknown radius.

    Of its two intersections with the arc before it, one is left of the way between the centres; or else, where it
    `counts_clockwise`, one is met first if that arc is travelled clockwise from its start.
    """

    name: str
    tail: str
    head: str
    center: str
    radius: str
    turn: Turn
    counts_clockwise: bool = False
    may_be_full: bool = False
    """Whether it is a full circle if it ends where it begins. Any other arc must end elsewhere."""


class CornerShape(Enum):
    """The shape that replaces a virtual intersection."""

    FILLET = "fillet"
    """An arc tangent to both elements; its size is the radius."""
    CHAMFER_AXIS_45 = "chamfer axis-45"
    """A segment at 45 degrees to the axes; its size is the extent along each axis."""
    CHAMFER_LENGTH_45 = "chamfer length-45"
    """A segment at 45 degrees to the axes; its size is its own length."""
    CHAMFER_SETBACK = "chamfer setback"
    """A segment whose two ends are as far from the virtual intersection as its size; on an arc, along the chord."""

    CHAMFER_FACE = "chamfer face"
    """A segment of this length whose two ends are as far from the virtual intersection as each other; on an arc, along
    the chord."""

    @property
    def share(self) -> float:
        """The extent along each axis of a segment at 45 degrees of size 1; 0 for what does not run at 45 degrees."""
        return _SHARES.get(self, 0)


_SHARES = {CornerShape.CHAMFER_AXIS_45: 1, CornerShape.CHAMFER_LENGTH_45: sqrt(0.5)}


class Corner(Struct, frozen=True):
    """A corner at the virtual intersection `at`, between the line or arc `before` and what follows.

    `after` names the next element of the path; without it the corner lands on a line that the block itself does
    not cut: parallel to axis `lands_parallel_to`, or the figure's line `lands_on`.
    """

    name: str
    at: str
    shape: CornerShape
    size: str
    before: str
    after: str | None = None
    lands_parallel_to: int | None = None
    lands_on: str | None = None
    guard: float = 0.0
    """Sine of the change of direction up to which the control leaves the corner out."""
    least: float = 0.0
    """Sine of the change of direction up to which the control refuses the corner instead."""


class Circle(Struct, frozen=True):
    """A circle that is not part of the path, about a point with a radius; either may be known or unknown."""

    name: str
    center: str
    radius: str


class Round(Protocol):
    """A circle, or something that is part of one."""

    @property
    def center(self) -> str: ...

    @property
    def radius(self) -> str: ...


class Figure(Struct, frozen=True):
    """A drawing without its values: unknown points and radii, the path from `start`, its corners.

    `places` are points with given coordinates (the givens `place.0` and `place.1`). `lines` and `circles` are
    not part of the path; `known_radii` are radii that are givens. `carriers` names the lines whose direction
    and place are unknowns of their own: `line.cos`, `line.sin`, and the distance of the origin to the right of
    the line, `line.off`.
    """

    start: str
    points: tuple[str, ...]
    radii: tuple[str, ...]
    path: tuple[Line | Arc, ...]
    corners: tuple[Corner, ...] = ()
    places: tuple[str, ...] = ()
    known_radii: tuple[str, ...] = ()
    lines: tuple[Line, ...] = ()
    circles: tuple[Circle, ...] = ()
    carriers: tuple[str, ...] = ()

    def line(self, name: str) -> Line:
        """The line of this name, of the path or beside it."""
        for line in (*self.path, *self.lines):
            if isinstance(line, Line) and line.name == name:
                return line
        raise KeyError(name)


class BlockRole(Struct, frozen=True):
    """The part that some blocks of a contour play together, by the name under which rules speak of it.

    `prefixes` begin the names of what each of these blocks states. A rule about one block sees the names without
    the prefix, a rule about several sees `1:`, `2:`, ... in its place.
    """

    name: str
    prefixes: tuple[str, ...] = ("",)

    def names(self, stated: Iterable[str]) -> dict[str, str]:
        """Of the names that a contour states, those of this role, by what its rules call them."""
        return next(named for _, named in names_of_roles((self,), stated))


def names_of_roles(roles: Iterable[BlockRole], stated: Iterable[str]) -> Iterator[tuple[BlockRole, dict[str, str]]]:
    """Each role with the names of `BlockRole.names`. A prefix ends with the first colon of a name."""
    everything = list(stated)
    starting: dict[str, list[tuple[int, str]]] = {}
    for place, name in enumerate(everything):
        prefix, colon, _ = name.partition(":")
        starting.setdefault(prefix + colon, []).append((place, name))
    for role in roles:
        if role.prefixes == ("",):
            yield role, {name: name for name in everything}
            continue
        is_alone = len(role.prefixes) == 1
        found = [
            (place, ("" if is_alone else f"{number}:") + name.removeprefix(prefix), name)
            for number, prefix in enumerate(role.prefixes, 1)
            for place, name in starting.get(prefix, ())
        ]
        yield role, {call: name for _, call, name in (found if is_alone else sorted(found))}
