"""Corners between lines and arcs: fillets, setback chamfers and 45 degree bevels, by their geometry alone.

No import of the package. A place is a complex number, as in `oracle`; lengths are mm. A path comes as
elements that meet in sharp corners; a corner cuts both of its elements and puts one piece between them.

* Fillet (printed for NCT, "arc tangent to both elements"): on the side to which the path turns. Its centre is
  where both elements, moved by the radius to that side, meet. Of the two places, it is the one that V moves
  to as the radius grows from zero: the one on V's side of the line through both centres, or of the foot of
  the centre on the line. (Derived: the two places are mirror images, so this one is also the nearer to V.)
* Chamfer (printed for NCT): its ends are at the given distance from V; on an arc this is the chord.
* Bevel (derived for the LX3): a stick of 45 degrees, as long in Z as in X, slid along the line until its
  other end is on the other element.
* A piece that starts before its first element or ends beyond its second does not fit, and neither do two
  pieces that overlap on the element between them (derived: refused, never shrunk).
"""

from cmath import phase, rect
from collections.abc import Mapping, Sequence
from math import acos, asin, inf, sqrt, tau
from typing import Any, NamedTuple

from oracle import ON, Element, Outcome, cross, dot, meet, sign


class Corner(NamedTuple):
    kind: str
    """`R` fillet, `C` chamfer by setback, `B` bevel of 45 degrees."""
    amount: float
    quadrant: complex = 0j
    """Of a bevel: which way it goes along each axis."""


def ahead(element: Element, at: complex) -> complex:
    """The direction of travel at a place of the element."""
    if element.center is None:
        return (element.end - element.start) / abs(element.end - element.start)
    out = (at - element.center) / abs(at - element.center)
    return out * bend(element) * 1j


def bend(element: Element) -> int:
    """1 if an arc turns left, -1 if it turns right."""
    return 1 if element.turn == "ccw" else -1


def stretch(element: Element, begin: complex, end: complex) -> float:
    """How far it is along the element from one place to another; on an arc never backwards."""
    if element.center is None:
        return dot(ahead(element, begin), end - begin)
    swept = phase((end - element.center) / (begin - element.center)) * bend(element) % tau
    return element.radius * (swept if swept < tau - 1e-11 else swept - tau)


def length(element: Element) -> float:
    """Where an arc ends where it starts, it is a full circle."""
    if element.center is None:
        return abs(element.end - element.start)
    along = stretch(element, element.start, element.end)
    return along if along > ON else tau * element.radius


def connect(elements: Sequence[Element], corners: Mapping[int, Corner], outcome: Outcome) -> None:
    """Appends the elements to the outcome, cut by their corners: `corners[k]` is at the end of `elements[k]`."""
    pieces = {
        k: _piece(elements[k], elements[k + 1], corner, outcome) for k, corner in corners.items() if corner.amount
    }
    for k, element in enumerate(elements):
        come, leave = pieces.get(k - 1), pieces.get(k)
        if come or leave:
            taken = stretch(element, element.start, come.end) if come else 0.0
            taken += stretch(element, leave.start, element.end) if leave else 0.0
            outcome.need(length(element) - taken)
        outcome.go(
            element._replace(start=come.end if come else element.start, end=leave.start if leave else element.end)
        )
        if leave:
            outcome.go(leave)


def _piece(before: Element, after: Element, corner: Corner, outcome: Outcome) -> Element:
    make = {"R": _fillet, "C": _chamfer, "B": _bevel}[corner.kind]
    outcome.need_length(min(length(before), length(after)))
    return make(before, after, corner, outcome)


def _fillet(before: Element, after: Element, corner: Corner, outcome: Outcome) -> Element:
    at, radius = before.end, corner.amount
    u, v = ahead(before, at), ahead(after, at)
    if abs(cross(u, v)) < 1e-9:  # what a fillet between tangent elements is, no page says
        outcome.is_near = True
        outcome.need(-1)
    side = sign(cross(u, v))
    moved = [
        element.radius - side * bend(element) * radius if element.center is not None else 0.0
        for element in (before, after)
    ]
    for element, reach in zip((before, after), moved, strict=True):
        if element.center is not None:
            outcome.need_length(reach)
    if before.center is None and after.center is None:
        # The centre is radius / cos(turn / 2) away on the bisector, and cos(turn / 2) is |u + v| / 2.
        center = at + 2 * radius * (v - u) / (abs(v - u) * abs(v + u))
    elif before.center is not None and after.center is not None:
        apart, (one, other) = after.center - before.center, moved
        outcome.need(one + other - abs(apart))
        outcome.need(abs(apart) - abs(one - other))
        cosine = (abs(apart) ** 2 + one**2 - other**2) / (2 * abs(apart) * one)
        angle = acos(max(-1.0, min(1.0, cosine))) * sign(cross(apart, at - before.center))
        center = before.center + one * apart / abs(apart) * rect(1, angle)
    else:
        along, arc, reach = (u, after, moved[1]) if before.center is None else (v, before, moved[0])
        center = _on_parallel(at + 1j * along * side * radius, along, arc.center or 0j, reach, at, outcome)
    return Element("arc", _touch(before, center), _touch(after, center), center, radius, "ccw" if side > 0 else "cw")


def _on_parallel(
    through: complex, along: complex, middle: complex, reach: float, at: complex, outcome: Outcome
) -> complex:
    """Where a line meets a circle, on the side of its foot where `at` is."""
    foot = through + along * dot(along, middle - through)
    outcome.need(reach - abs(foot - middle))
    half = sqrt(max(0.0, (reach - abs(foot - middle)) * (reach + abs(foot - middle))))
    return foot + along * half * sign(dot(along, at - middle))


def _touch(element: Element, center: complex) -> complex:
    if element.center is None:
        along = ahead(element, center)
        return element.start + along * dot(along, center - element.start)
    return element.center + element.radius * (center - element.center) / abs(center - element.center)


def _chamfer(before: Element, after: Element, corner: Corner, outcome: Outcome) -> Element:
    return Element(
        "line",
        _set_back(before, before.end, -corner.amount, outcome),
        _set_back(after, before.end, corner.amount, outcome),
    )


def _set_back(element: Element, at: complex, chord: float, outcome: Outcome) -> complex:
    if element.center is None:
        return at + chord * ahead(element, at)
    outcome.need(2 * element.radius - abs(chord))
    half = asin(max(-1.0, min(1.0, chord / 2 / element.radius)))
    return element.center + (at - element.center) * rect(1, 2 * half * bend(element))


def _bevel(before: Element, after: Element, corner: Corner, outcome: Outcome) -> Element:
    at, stick = before.end, corner.amount * corner.quadrant
    u, v = ahead(before, at), ahead(after, at)
    if before.center is None and after.center is None:
        end = meet((at + stick, u), (at, v), outcome)
        begin = end - stick
    elif before.center is None:
        assert after.center is not None
        end = _on_parallel(at + stick, u, after.center, after.radius, at, outcome)
        begin = end - stick
    else:
        assert after.center is None
        begin = _on_parallel(at - stick, v, before.center, before.radius, at, outcome)
        end = begin + stick
    for element, come, leave in ((before, begin, at), (after, at, end)):
        if element.center is None:  # along a line it can come out reversed; along an arc the quadrant sees to it
            outcome.need(stretch(element, come, leave))
    return Element("line", begin, end)


def gap(one: Sequence[Element], other: Sequence[Element]) -> float:
    """The largest distance, mm, between two paths: ends, centres, radii. Infinite if elements differ in kind."""
    if [element[::5] for element in one] != [element[::5] for element in other]:
        return inf
    gaps = [0.0]
    for mine, theirs in zip(one, other, strict=True):
        gaps += [abs(mine.start - theirs.start), abs(mine.end - theirs.end), abs(mine.radius - theirs.radius)]
        gaps.append(abs((mine.center or 0) - (theirs.center or 0)))
    return max(gaps)


def miss(elements: Sequence[Element], points: Mapping[str, complex], contour: Mapping[str, Any]) -> float:
    """The same distance to a contour in JSON, its ends and named points included. It may name more points."""
    if not elements or not points.keys() <= contour["points"].keys():
        return inf
    found = [
        Element(
            each["kind"],
            complex(*each["start"]),
            complex(*each["end"]),
            complex(*each["center"]) if "center" in each else None,
            each.get("radius", 0.0),
            each.get("turn", ""),
        )
        for each in contour["elements"]
    ]
    gaps = [abs(complex(*contour["points"][name]) - point) for name, point in points.items()]
    ends = abs(complex(*contour["start"]) - elements[0].start), abs(complex(*contour["end"]) - elements[-1].end)
    return max(gap(elements, found), *ends, *gaps)
