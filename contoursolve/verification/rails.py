"""The lines and circles that elements run along, with the sense of travel, and where two of them meet.

Points count from the start point, in mm; real is the plane's first axis, imaginary its second.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import atan2, inf, sqrt

from contoursolve.model import Turn
from contoursolve.tolerance import LENGTH, REGULAR, RESIDUAL
from contoursolve.verification.measure import ROUNDING, cross, dot, unit

NEARER, FARTHER = -1, 1
"""Of the two places where a line meets a circle, along the line."""
LEFT, RIGHT = -1, 1
"""Of the two places where circles meet, beside the way from the first centre to the second."""

_FEW = 8.0
"""1. How often the band of rounding may be taken differently by the solver."""


class UnmakeableError(ValueError):
    """Something that words describe and that there cannot be; the message says what."""


class LooseError(UnmakeableError):
    """A point that the words leave free at their values; the message says why."""


@dataclass(frozen=True, slots=True)
class Ray:
    """A line through `at` in the unit direction `along`; `unsure` (mm) is how far it may be off there, and `swing` (1)
    how much more for each mm from there."""

    at: complex
    along: complex
    unsure: float = 0.0
    swing: float = 0.0


@dataclass(frozen=True, slots=True)
class Ring:
    """A circle and the sense of travel; radius in mm."""

    center: complex
    radius: float
    turn: Turn
    unsure: float = 0.0


Rail = Ray | Ring


@dataclass(frozen=True, slots=True)
class Meeting:
    """Where two rails meet, by the side (0 where there is one place), and what rounding does to it, mm.

    `touches` is None where rounding hides whether they touch or cross.
    """

    places: Mapping[int, complex]
    unsure: float
    touches: bool | None = False


def off(rail: Rail, at: complex) -> float:
    """How far a point is off a line or circle, mm."""
    return cross(rail.along, at - rail.at) if isinstance(rail, Ray) else abs(at - rail.center) - rail.radius


def heading(rail: Rail, at: complex) -> complex:
    """The unit direction of travel at a point of a rail; zero where there is none."""
    return rail.along if isinstance(rail, Ray) else unit(at - rail.center) * 1j * rail.turn.sign


def travel(rail: Rail, begin: complex, end: complex) -> float:
    """How far it is from one point of a rail to another, mm, negative against the sense of travel; on a circle by the
    shorter way."""
    if isinstance(rail, Ray):
        return dot(rail.along, end - begin)
    spokes = begin - rail.center, end - rail.center
    return rail.radius * rail.turn.sign * atan2(cross(*spokes), dot(*spokes))


def beside(rail: Rail, by: float) -> Rail:
    """The same rail so far to its left. Raises UnmakeableError for a circle of no radius."""
    if isinstance(rail, Ray):
        return Ray(rail.at + by * 1j * rail.along, rail.along)
    if rail.radius - rail.turn.sign * by <= LENGTH:
        raise UnmakeableError("it is larger than its circle")
    return Ring(rail.center, rail.radius - rail.turn.sign * by, rail.turn)


def leg(hypotenuse: float, leg: float, unsure: float) -> tuple[float, float]:
    """The other leg of a right-angled triangle, mm, and what an error of the first two does to it."""
    rest = (hypotenuse - leg) * (hypotenuse + leg)
    found = sqrt(max(0.0, rest))
    double = sqrt(2 * hypotenuse * unsure)
    return found, min(hypotenuse * unsure / found if found else inf, double)


def side_of(first: Rail, second: Rail, at: complex) -> int:
    """The side of a place where two rails meet."""
    if isinstance(first, Ring) and isinstance(second, Ring):
        return LEFT if cross(second.center - first.center, at - first.center) > 0 else RIGHT
    ray, ring = (first, second) if isinstance(first, Ray) else (second, first)
    if isinstance(ray, Ray) and isinstance(ring, Ring):
        return NEARER if dot(ray.along, at - ring.center) < 0 else FARTHER
    return 0


def meet(first: Rail, second: Rail, unsure: float) -> Meeting:
    """Where two rails meet; `unsure` (mm) is what they may be off. Raises UnmakeableError if they do not."""
    if isinstance(first, Ray) and isinstance(second, Ray):
        return _cross_lines(first, second, unsure)
    if isinstance(first, Ring) and isinstance(second, Ring):
        return _cross_circles(first, second, unsure)
    ray, ring = (first, second) if isinstance(first, Ray) else (second, first)
    if not isinstance(ray, Ray) or not isinstance(ring, Ring):
        raise TypeError("a rail is a line or a circle")
    distance = cross(ray.along, ray.at - ring.center)
    foot = ray.at - dot(ray.along, ray.at - ring.center) * ray.along
    parts = (ring.center.real, ring.center.imag, ray.at.real, ray.at.imag)
    band = ROUNDING * (ring.radius + sum(map(abs, parts)))
    own = unsure + ray.unsure + ray.swing * (abs(foot - ray.at) + ring.radius) + ring.unsure
    half, blur, touches = _half(ring.radius, abs(distance), band, own, "the line misses the circle")
    return Meeting({side: foot + side * half * ray.along for side in (NEARER, FARTHER)}, blur + band + own, touches)


def _cross_lines(first: Ray, second: Ray, unsure: float) -> Meeting:
    turn = cross(first.along, second.along)
    if abs(turn) <= REGULAR:
        if abs(cross(first.along, second.at - first.at)) <= RESIDUAL:
            raise LooseError("the two lines are one, so that they meet everywhere")
        raise UnmakeableError("the lines are parallel")
    ahead = cross(second.at - first.at, second.along) / turn
    place = first.at + ahead * first.along
    far = (first.swing * abs(ahead), second.swing * abs(place - second.at))
    scale = abs(first.at) + abs(second.at) + abs(ahead)
    own = ROUNDING * scale + unsure + first.unsure + second.unsure + sum(far)
    return Meeting({0: place}, 2 * own / abs(turn))


def _cross_circles(first: Ring, second: Ring, unsure: float) -> Meeting:
    way = second.center - first.center
    distance = abs(way)
    if distance <= LENGTH:
        raise UnmakeableError("the circles have one centre")
    along = way / distance
    ahead = (distance + (first.radius - second.radius) * (first.radius + second.radius) / distance) / 2
    parts = (first.center.real, first.center.imag, second.center.real, second.center.imag)
    stretch = 1 + (first.radius + second.radius) / distance
    band = ROUNDING * (first.radius + second.radius + sum(map(abs, parts))) * stretch
    own = (unsure + first.unsure + second.unsure) * stretch
    half, blur, touches = _half(first.radius, abs(ahead), band, own, "the circles do not meet")
    foot = first.center + ahead * along
    places = {side: foot - side * half * 1j * along for side in (LEFT, RIGHT)}
    return Meeting(places, blur + band + own, touches)


def _half(radius: float, distance: float, band: float, own: float, without: str) -> tuple[float, float, bool | None]:
    """Half a chord at a distance from the centre, what rounding does to it, and whether it is next to nothing."""
    gap = radius - distance
    touches: bool | None = None
    if abs(gap) <= band / _FEW and own <= band / _FEW:
        touches = True
    elif abs(gap) > _FEW * band + own:
        touches = False
        if gap < 0:
            raise UnmakeableError(without)
    half, blur = leg(radius, distance, band + own)
    return (0.0, 0.0, True) if touches else (half, blur, touches)
