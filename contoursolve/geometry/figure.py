"""A drawing without its values: points, lines, arcs and corners, the roles of blocks."""

from collections.abc import Iterable, Iterator
from enum import Enum
from math import sqrt
from typing import Protocol

from msgspec import Struct

FIRST, SECOND = 0, 1
"""Indices of a plane's first and second axis."""


def scalar(point: str, axis: int) -> str:
    """The name of one coordinate of a point."""
    return f"{point}.{axis}"


def both(*points: str) -> tuple[str, ...]:
    """The names of both coordinates of points."""
    return tuple(scalar(point, axis) for point in points for axis in (FIRST, SECOND))


def line_scalars(line: str) -> tuple[str, str, str]:
    """The names of a line's direction and place."""
    return f"{line}.cos", f"{line}.sin", f"{line}.off"


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


def scalars_of(element: Line | Arc) -> tuple[str, ...]:
    """The names of the scalars that determine where an element lies."""
    if isinstance(element, Line):
        return both(element.tail, element.head, *([element.toward] if element.toward else []))
    return *both(element.tail, element.head, element.center), element.radius


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

    @property
    def radius(self) -> str:
        """The name of its size where that is an unknown."""
        return f"{self.name}.radius"


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
    for role in roles:
        if role.prefixes == ("",):
            yield role, dict(zip(everything, everything, strict=True))
            continue
        for place, name in enumerate(() if starting else everything):
            prefix, colon, _ = name.partition(":")
            starting.setdefault(prefix + colon, []).append((place, name))
        is_alone = len(role.prefixes) == 1
        found = [
            (place, ("" if is_alone else f"{number}:") + name.removeprefix(prefix), name)
            for number, prefix in enumerate(role.prefixes, 1)
            for place, name in starting.get(prefix, ())
        ]
        yield role, {call: name for _, call, name in (found if is_alone else sorted(found))}
