"""Circles and lines that touch given ones: closed forms in 110 digits, to hold the engine against; no import of it.

Doubles are taken as they are, exactly. Two things touch, or a root is double, if they do to 1e-60 of the
configuration's size: whatever is true only after rounding is decided as the doubles have it.

>>> [round(float(circle.r), 6) for circle in tangent_circles(Line(0, 0, 0), Line(4, 0, 90), Line(0, 3, 0))]
[1.5, 1.5]
>>> len(tangent_circles(Circle(0, 0, 1), Circle(4, 0, 1), Circle(1, 5, 1)))
8
>>> len(tangent_lines(Circle(0, 0, 1), Circle(4, 0, 1))), len(tangent_lines(Circle(0, 0, 1), Point(1, 0)))
(4, 1)
"""

from collections.abc import Iterable, Iterator, Sequence
from functools import wraps
from itertools import product
from math import cos, pi, radians, sin
from random import Random
from typing import Any, NamedTuple

from mpmath import mp, mpf

DIGITS = 110
ZERO = mpf(10) ** -60
"""Of values that were scaled to about 1."""

Real = Any
"""A double, an integer or an mpf."""


class Point(NamedTuple):
    x: Real
    y: Real


class Circle(NamedTuple):
    x: Real
    y: Real
    r: Real


class Line(NamedTuple):
    """Through a place, in a direction in degrees; endless."""

    x: Real
    y: Real
    a: Real


Thing = Point | Circle | Line


class EndlessError(Exception):
    """Infinitely many solutions."""


def precise(function: Any) -> Any:
    @wraps(function)
    def run(*given: Any, **named: Any) -> Any:
        with mp.workdps(DIGITS):
            return function(*given, **named)

    return run


class Frame(NamedTuple):
    """Where the things are about 1 large and about 0 away."""

    x: mpf
    y: mpf
    size: mpf

    def into(self, thing: Thing) -> Thing:
        x, y = (mpf(thing.x) - self.x) / self.size, (mpf(thing.y) - self.y) / self.size
        match thing:
            case Point():
                return Point(x, y)
            case Circle():
                return Circle(x, y, mpf(thing.r) / self.size)
            case Line():
                return Line(x, y, mpf(thing.a))

    def back(self, thing: Thing) -> Any:
        x, y = thing.x * self.size + self.x, thing.y * self.size + self.y
        match thing:
            case Point():
                return Point(x, y)
            case Circle():
                return Circle(x, y, thing.r * self.size)
            case Line():
                return Line(x, y, thing.a)


def frame_of(things: Sequence[Thing], radius: Real = 0) -> Frame:
    xs, ys = [mpf(thing.x) for thing in things], [mpf(thing.y) for thing in things]
    x, y = sum(xs) / len(xs), sum(ys) / len(ys)
    sizes = [mpf(radius), *(mp.hypot(a - x, b - y) for a, b in zip(xs, ys, strict=True))]
    sizes += [mpf(thing.r) for thing in things if isinstance(thing, Circle)]
    return Frame(x, y, max(sizes) or mpf(1))


def normal_of(line: Line) -> tuple[mpf, mpf, mpf]:
    """Unit normal to the left of a line, and the line's distance along it."""
    angle = mpf(line.a) * mp.pi / 180
    n, m = -mp.sin(angle), mp.cos(angle)
    return n, m, n * line.x + m * line.y


def is_zero(value: mpf) -> bool:
    return bool(abs(value) < ZERO)


def roots(a: mpf, b: mpf, c: mpf) -> list[mpf]:
    """Real roots of a t^2 + b t + c, a double one once."""
    if is_zero(a):
        if not is_zero(b):
            return [-c / b]
        if is_zero(c):
            raise EndlessError
        return []
    inner = b * b - 4 * a * c
    if is_zero(inner):
        return [-b / (2 * a)]
    if inner < 0:
        return []
    q = -(b + (mp.sqrt(inner) if b >= 0 else -mp.sqrt(inner))) / 2
    return [q / a, c / q] if not is_zero(q) else [q / a, -b / a - q / a]


def different(things: Iterable[Thing]) -> list[Any]:
    found: list[Thing] = []
    for thing in things:
        if not any(max(abs(a - b) for a, b in zip(thing, one, strict=True)) < mpf(10) ** -25 for one in found):
            found.append(thing)
    return found


# Circles that touch three things


@precise
def tangent_circles(*three: Thing, keep_given: bool = False) -> list[Circle]:
    """
    All circles that touch three circles or lines, or pass through points; raises `EndlessError` for a family of them.

    A given circle which touches the other two is no solution, unless `keep_given` says so: there it is a double
    root, or worse. Straight lines (circles without end) are no solutions.
    """
    frame = frame_of(three)
    things = sorted((frame.into(thing) for thing in three), key=lambda thing: isinstance(thing, Line))
    signed = [thing for thing in things if not isinstance(thing, Point)]
    found = []
    for signs in product((1, -1), repeat=max(len(signed) - 1, 0)):
        of = dict(zip(map(id, signed), (1, *signs), strict=bool(signed)))
        for x, y, r in signed_circles([(thing, of.get(id(thing), 1)) for thing in things]):
            circle = Circle(x, y, abs(r))
            if is_zero(r) or (not keep_given and any(circle_is(circle, thing) for thing in things)):
                continue
            assert all(is_zero(gap(circle, thing)) for thing in things), (three, circle)
            found.append(circle)
    return [frame.back(circle) for circle in different(found)]


def circle_is(circle: Circle, thing: Thing) -> bool:
    return isinstance(thing, Circle) and all(abs(a - b) < mpf(10) ** -25 for a, b in zip(circle, thing, strict=True))


def signed_circles(things: Sequence[tuple[Thing, int]]) -> Iterator[tuple[mpf, mpf, mpf]]:
    """
    x, y and a radius of either sign, where the distance to a circle's centre is the radius plus `sign` times the
    circle's, and the height over a line is `sign` times the radius. Circles first.
    """
    rows = [(row, right) for thing, sign in things if isinstance(thing, Line) for row, right in [plane(thing, sign)]]
    cones = [cone(thing, sign) for thing, sign in things if not isinstance(thing, Line)]
    rows += [unit([a - b for a, b in zip(cones[0], other, strict=True)]) for other in cones[1:]]
    if not cones:
        yield from meet(rows)
        return
    axis = cross(rows[0][0], rows[1][0])
    length = dot(axis, axis)
    if length < ZERO:
        if consistent(*rows):
            raise EndlessError
        return
    sides = cross(rows[1][0], axis), cross(axis, rows[0][0])
    foot = [(rows[0][1] * a + rows[1][1] * b) / length for a, b in zip(*sides, strict=True)]
    axis = [part / mp.sqrt(length) for part in axis]
    u, v, w, constant = cones[0]
    a = lorentz(axis, axis)
    b = 2 * lorentz(axis, foot) + dot((u, v, w), axis)
    c = lorentz(foot, foot) + dot((u, v, w), foot) + constant
    for t in roots(a, b, c):
        x, y, r = (p + t * d for p, d in zip(foot, axis, strict=True))
        yield x, y, r


Vector = Sequence[mpf]


def dot(a: Vector, b: Vector) -> mpf:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def lorentz(a: Vector, b: Vector) -> mpf:
    return a[0] * b[0] + a[1] * b[1] - a[2] * b[2]


def cross(a: Vector, b: Vector) -> list[mpf]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def cone(thing: Point | Circle, sign: int) -> tuple[mpf, mpf, mpf, mpf]:
    """Factors of x, y, r and the constant, beside x^2 + y^2 - r^2."""
    radius = thing.r if isinstance(thing, Circle) else mpf(0)
    return -2 * thing.x, -2 * thing.y, -2 * sign * radius, thing.x**2 + thing.y**2 - radius**2


def plane(line: Line, sign: int) -> tuple[list[mpf], mpf]:
    n, m, height = normal_of(line)
    return unit([n, m, mpf(-sign), -height])


def unit(row: Vector) -> tuple[list[mpf], mpf]:
    """The factors of a linear equation with length 1, and its right side."""
    length = mp.sqrt(dot(row, row))
    if is_zero(length):
        return [mpf(0)] * 3, -row[3]
    return [part / length for part in row[:3]], -row[3] / length


def consistent(one: tuple[Vector, mpf], other: tuple[Vector, mpf]) -> bool:
    """Whether two dependent equations say the same."""
    if is_zero(dot(one[0], one[0])) or is_zero(dot(other[0], other[0])):
        return all(is_zero(right) for row, right in (one, other) if is_zero(dot(row, row)))
    return is_zero(one[1] - dot(one[0], other[0]) * other[1])


def meet(rows: Sequence[tuple[Vector, mpf]]) -> Iterator[tuple[mpf, mpf, mpf]]:
    """Of three planes. Dependent ones come of parallel lines: the same line twice, or no circle between them."""
    (a, p), (b, q), (c, r) = rows
    whole = dot(a, cross(b, c))
    if not is_zero(whole):
        parts = zip(cross(b, c), cross(c, a), cross(a, b), strict=True)
        x, y, z = ((p * one + q * two + r * three) / whole for one, two, three in parts)
        yield x, y, z
        return
    pairs = ((rows[0], rows[1]), (rows[1], rows[2]), (rows[0], rows[2]))
    alike = [pair for pair in pairs if dot(*[cross(pair[0][0], pair[1][0])] * 2) < ZERO]
    if all(consistent(*pair) for pair in alike):
        raise EndlessError


# Circles of a given radius


# Lines that touch two circles


@precise
def tangent_lines(one: Point | Circle, other: Point | Circle) -> list[Line]:
    """All lines which touch two circles or pass through points; the place of a line is where it touches the first."""
    frame = frame_of((one, other))
    first, second = (frame.into(thing) for thing in (one, other))
    r, s = (thing.r if isinstance(thing, Circle) else mpf(0) for thing in (first, second))
    dx, dy = second.x - first.x, second.y - first.y
    square = dx * dx + dy * dy
    found = []
    for rise in (r - s, r + s):  # n (c2 - c1) for the normal n that points from the line to the first centre
        if is_zero(square):
            if is_zero(rise):
                raise EndlessError
            continue
        inner = square - rise * rise
        if is_zero(inner):
            slopes = [mpf(0)]
        elif inner < 0:
            continue
        else:
            slopes = [mp.sqrt(inner), -mp.sqrt(inner)]
        for slope in slopes:
            n, m = (-rise * dx - slope * dy) / square, (-rise * dy + slope * dx) / square
            angle = mp.atan2(-n, m) * 180 / mp.pi % 180
            found.append((Line(first.x - r * n, first.y - r * m, angle), n, m))
    lines: list[Line] = []
    for line, *_ in found:
        if not any(same_line(line, known) for known in lines):
            assert all(is_zero(gap(line, thing)) for thing in (first, second)), (one, other)
            lines.append(line)
    return [frame.back(line) for line in lines]


def same_line(one: Line, other: Line) -> bool:
    """Whether two lines are one; of things that were scaled to about 1."""
    a, b = normal_of(one), normal_of(other)
    turn = a[0] * b[1] - a[1] * b[0]
    return abs(turn) < mpf(10) ** -25 and abs(offset_of(Point(other.x, other.y), one)) < mpf(10) ** -25


# Points of intersection


@precise
def intersections(one: Thing, other: Thing) -> list[Point]:
    """The common points of two circles or lines; raises `EndlessError` if they are one."""
    frame = frame_of((one, other))
    return [frame.back(point) for point in _common(frame.into(one), frame.into(other))]


def _common(one: Thing, other: Thing) -> list[Point]:
    match one, other:
        case Line(), Line():
            (n, m, c), (p, q, d) = normal_of(one), normal_of(other)
            whole = n * q - m * p
            if is_zero(whole):
                if is_zero(offset_of(Point(other.x, other.y), one)):
                    raise EndlessError
                return []
            return [Point((c * q - m * d) / whole, (n * d - c * p) / whole)]
        case Circle(), Circle():
            dx, dy = other.x - one.x, other.y - one.y
            square = dx * dx + dy * dy
            if is_zero(square):
                if is_zero(one.r - other.r):
                    raise EndlessError
                return []
            share = (square + one.r**2 - other.r**2) / (2 * square)
            inner = one.r**2 / square - share * share
            return [
                Point(one.x + share * dx - side * dy, one.y + share * dy + side * dx)
                for side in roots(1, mpf(0), -inner)
            ]
        case Circle(), Line():
            height = offset_of(Point(one.x, one.y), other)
            n, m, _ = normal_of(other)
            x, y = one.x - height * n, one.y - height * m
            return [Point(x + t * m, y - t * n) for t in roots(1, mpf(0), height**2 - one.r**2)]
        case Line(), Circle():
            return _common(other, one)
    raise TypeError(one, other)


# By how much things miss each other


def offset_of(place: Point, line: Line) -> mpf:
    n, m, height = normal_of(line)
    return n * place.x + m * place.y - height


def gap(one: Circle | Line, other: Thing) -> mpf:
    """
    By how much two things do not touch, in mm: 0 if they do.

    >>> float(gap(Circle(0, 0, 1), Circle(3, 0, 1))), float(gap(Line(0, 1, 0), Circle(9, 0, 1)))
    (1.0, 0.0)
    """
    if isinstance(other, Line):
        one, other = other, one
    if isinstance(one, Line):
        assert not isinstance(other, Line)
        return abs(offset_of(Point(other.x, other.y), one)) - (other.r if isinstance(other, Circle) else 0)
    radius = other.r if isinstance(other, Circle) else mpf(0)
    distance = mp.hypot(one.x - other.x, one.y - other.y)
    return min(distance - (one.r + radius), distance - abs(one.r - radius), key=abs)


# Random instances


def random_thing(random: Random, kind: str, scale: float, shift: complex) -> Thing:
    """A `P`oint, `C`ircle or `L`ine about a shift, at most about `scale` away."""
    place = shift + complex(random.uniform(-scale, scale), random.uniform(-scale, scale))
    match kind:
        case "P":
            return Point(place.real, place.imag)
        case "C":
            return Circle(place.real, place.imag, random.uniform(0.05, 0.6) * scale)
        case "L":
            return Line(place.real, place.imag, random.uniform(-180, 180))
    raise ValueError(kind)


def random_frame(random: Random) -> tuple[float, complex]:
    """A scale from 1e-3 to 1e4 mm, equally likely in each decade, and a shift up to 1e4 mm, often none."""
    scale = 10 ** random.uniform(-3, 4)
    shift = random.choice((0.0, scale, 1e3, 1e4))
    return scale, complex(random.uniform(-shift, shift), random.uniform(-shift, shift))


def random_things(random: Random, kinds: str) -> tuple[Thing, ...]:
    """
    One thing for each letter of `kinds`, for example "CCL"; their number of solutions is whatever it is.

    >>> [type(thing).__name__ for thing in random_things(Random(1), "CPL")]
    ['Circle', 'Point', 'Line']
    """
    scale, shift = random_frame(random)
    return tuple(random_thing(random, kind, scale, shift) for kind in kinds)


def touching_things(random: Random, kinds: str) -> tuple[Circle, tuple[Thing, ...]]:
    """A circle, and things that all touch it, but for their rounding to doubles: it is near one of the solutions."""
    scale, shift = random_frame(random)
    circle = Circle(shift.real, shift.imag, random.uniform(0.2, 1.0) * scale)
    return circle, tuple(touching(random, kind, circle) for kind in kinds)


def touching(random: Random, kind: str, circle: Circle) -> Thing:
    angle = random.uniform(-pi, pi)
    x, y, r = circle.x + circle.r * cos(angle), circle.y + circle.r * sin(angle), circle.r
    match kind:
        case "P":
            return Point(x, y)
        case "C":
            share = random.choice((random.uniform(0.2, 0.8), random.uniform(1.25, 3)))
            side = random.choice((1, -1)) * share * r
            return Circle(x + side * cos(angle), y + side * sin(angle), abs(side))
        case "L":
            along = random.uniform(-2, 2) * r
            x, y = x - along * sin(angle), y + along * cos(angle)
            return Line(x, y, (angle + pi / 2) * 180 / pi)
    raise ValueError(kind)


KNOWN: tuple[tuple[str, tuple[Thing, ...], int | None], ...] = (
    ("three circles apart", (Circle(0, 0, 1), Circle(5, 0, 1), Circle(1, 6, 2)), 8),
    (
        "unit circles about a triangle of equal sides",
        tuple(Circle(4 * cos(a), 4 * sin(a), 1) for a in map(radians, (0, 120, 240))),
        8,
    ),
    ("one inside, one outside of the third", (Circle(0, 0, 5), Circle(0, 0, 1), Circle(20, 0, 1)), 0),
    ("all concentric", (Circle(0, 0, 1), Circle(0, 0, 2), Circle(0, 0, 3)), 0),
    ("two concentric, one between them", (Circle(0, 0, 5), Circle(0, 0, 1), Circle(3, 0, 0.5)), 8),
    ("each touches the others (3, 4, 5)", (Circle(0, 0, 1), Circle(3, 0, 2), Circle(0, 4, 3)), 2),
    ("the same circle twice", (Circle(0, 0, 1), Circle(0, 0, 1), Circle(3, 0, 1)), None),
    ("three that touch in one place", (Circle(1, 0, 1), Circle(2, 0, 2), Circle(3, 0, 3)), None),
    ("three crossing in two places", (Circle(3, 0, 5), Circle(-3, 0, 5), Circle(0, 0, 4)), 0),
    ("three points", (Point(0, 0), Point(4, 0), Point(0, 3)), 1),
    ("three points in a row", (Point(0, 0), Point(4, 0), Point(9, 0)), 0),
    ("two points over a line", (Point(0, 1), Point(3, 4), Line(0, 0, 0)), 2),
    ("two points as far from a line", (Point(0, 1), Point(4, 1), Line(0, 0, 0)), 1),
    ("two points, the line between", (Point(0, 1), Point(3, -4), Line(0, 0, 0)), 0),
    ("two points, one on the line", (Point(0, 0), Point(3, 4), Line(0, 0, 0)), 1),
    ("a point and two lines", (Point(3, 1), Line(0, 0, 0), Line(0, 0, 90)), 2),
    ("a point on one of two lines", (Point(3, 0), Line(0, 0, 0), Line(0, 0, 90)), 2),
    ("a point between two parallel lines", (Point(3, 1), Line(0, 0, 0), Line(0, 4, 0)), 2),
    ("a point beside two parallel lines", (Point(3, 5), Line(0, 0, 0), Line(0, 4, 180)), 0),
    ("three lines", (Line(0, 0, 0), Line(4, 0, 90), Line(0, 0, 30)), 4),
    ("two of three lines are one", (Line(0, 0, 0), Line(4, 0, 180), Line(0, 0, 30)), None),
    ("two of three lines parallel and apart", (Line(0, 0, 0), Line(4, 1, 180), Line(0, 0, 30)), 2),
    ("three parallel lines", (Line(0, 0, 0), Line(0, 1, 0), Line(0, 3, 180)), 0),
    ("three lines through one point", (Line(1, 1, 0), Line(1, 1, 50), Line(1, 1, 90)), 0),
    ("a circle in a corner", (Circle(5, 5, 1), Line(0, 0, 0), Line(0, 0, 90)), 4),
    ("a circle over the crossing", (Circle(0, 0, 1), Line(0, 0, 0), Line(0, 0, 90)), 8),
    ("two circles over a line", (Circle(0, 5, 1), Circle(6, 7, 2), Line(0, 0, 0)), 8),
    ("a point in a circle, another outside", (Point(0, 0), Point(9, 1), Circle(0, 0, 1)), 0),
    ("two points outside of a circle", (Point(5, 0), Point(1, 9), Circle(0, 0, 1)), 2),
    ("a point and two circles apart", (Point(1, 9), Circle(0, 0, 1), Circle(6, 0, 2)), 4),
)
"""Name, three things, and how many circles touch them; None if without end."""
