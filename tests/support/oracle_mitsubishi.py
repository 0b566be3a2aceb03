"""Mitsubishi's Geometric I and IB in closed form, from the control's sheet alone, and random blocks of each form.

A point is a complex number: real is the plane's first axis, imaginary its second. Angles are degrees. Each construction
gives where the two blocks meet, or None where they do not, and so does no import of the package.
"""

from cmath import phase
from math import sqrt, tau
from random import Random
from typing import NamedTuple

from oracle import Element, cross, dot, heading

AXES = {17: ("X", "Y", "I", "J"), 18: ("Z", "X", "K", "I"), 19: ("Y", "Z", "J", "K")}
FORMS = ("I", "IB 1 centre", "IB 1 radius", "IB 2", "IB 3", "IB 4", "IB 5")
CLEAR = 1e-3
"""mm. What is as close as that to where a solution ends is nobody's to judge."""


class Drawn(NamedTuple):
    """A program, its path by the oracle (empty where there is none), and whether rounding decides."""

    text: str
    elements: list[Element]
    is_near: bool


def vertex(start: complex, first: float, end: complex, second: float) -> complex:
    """Where a line from a point and a line to a point cross."""
    one, two = heading(first), heading(second)
    return start + one * (cross(end - start, two) / cross(one, two))


def crossing(point: complex, angle: float, center: complex, radius: float, *, is_longer: bool) -> complex | None:
    """Where a line through a point crosses a circle: of two places the one that is nearer to the point, or farther."""
    way = heading(angle)
    foot, height = dot(center - point, way), cross(way, center - point)
    if abs(height) >= radius:
        return None
    half = sqrt(radius**2 - height**2)
    return point + way * sorted((foot - half, foot + half), key=abs)[is_longer]


def contact(start: complex, way: complex, end: complex, radius: float, sense: int, *, is_long: bool) -> complex | None:
    """The centre of an arc that a line from a point runs into, and that ends in a point; `sense` is +1 for
    counter-clockwise."""
    to = (end - start) * way.conjugate()
    under = radius**2 - (to.imag - sense * radius) ** 2
    if under <= 0:
        return None
    return start + way * complex(to.real + (sqrt(under) if is_long else -sqrt(under)), sense * radius)


def swept(start: complex, end: complex, center: complex, sense: int) -> float:
    """How far an arc turns, radians."""
    spoke = (end - center) / (start - center)
    return sense * phase(spoke) % tau


def touching(known: complex, own: float, end: complex, radius: float, side: int) -> list[complex]:
    """The centres of circles of a radius through a point that touch a known circle, outside (+1) or inside (-1)."""
    reach, way = abs(own + side * radius), end - known
    along = (abs(way) ** 2 + reach**2 - radius**2) / (2 * abs(way))
    if abs(along) >= reach:
        return []
    height = sqrt(reach**2 - along**2)
    return [known + way / abs(way) * complex(along, sign * height) for sign in (1, -1)]


def touch_point(known: complex, own: float, other: complex, radius: float, side: int) -> complex:
    """Where two circles touch."""
    way = (other - known) / abs(other - known)
    return known + way * own * (1 if side > 0 or own > radius else -1)


def random_block(rng: Random, form: str, plane: int = 17) -> Drawn:
    """Two blocks of a form, drawn first and then written with three decimals."""
    x, y, i, j = AXES[plane]

    def place(size: float = 60) -> complex:
        return complex(round(rng.uniform(-size, size), 3), round(rng.uniform(-size, size), 3))

    def at(point: complex) -> str:
        return f"{x}{point.real:.3f} {y}{point.imag:.3f}"

    def arm(point: complex) -> str:
        return f"{i}{point.real:.3f} {j}{point.imag:.3f}"

    def arc(start: complex, end: complex, center: complex, sense: int) -> Element:
        return Element("arc", start, end, center, abs(start - center), "ccw" if sense > 0 else "cw")

    start, end, angle = place(), place(), round(rng.uniform(-180, 180), 3)
    sense, is_long, pick = rng.choice((1, -1)), rng.random() < 0.3, rng.choice((0, 1))
    turn, other = ("G03", "G02") if sense > 0 else ("G02", "G03")
    size = round(rng.uniform(5, 50), 3)
    signed = f"R{'-' if is_long else ''}{size:.3f}"
    elements: list[Element] = []
    is_near = False
    head = f"G{plane} G90 G00 {at(start)}\n"
    if form == "I":
        angle, second = float(rng.randint(-179, 179)), float(rng.randint(-179, 179))
        text = f"G01 A{angle}\n{at(end)} A{second}"
        if (angle - second) % 180:
            meet = vertex(start, angle, end, second)
            elements = [Element("line", start, meet), Element("line", meet, end)]
            is_near = abs(meet) > 1e4 or (angle - second) % 180 in (1, 179)
    elif form in ("IB 2", "IB 3"):
        bow = place(40)
        center = (end if form == "IB 2" else start) + bow
        far, on = (start, end) if form == "IB 2" else (end, start)
        meet_ = crossing(far, angle, center, abs(bow), is_longer=bool(pick))
        line, curve = f"G01 A{angle}", f"{turn} {arm(bow)} H{pick}"
        text = f"{line}\n{curve} {at(end)}" if form == "IB 2" else f"{curve}\n{line} {at(end)}"
        gap = abs(abs(cross(heading(angle), center - far)) - abs(bow))
        is_near = gap < CLEAR or abs(dot(center - far, heading(angle))) < CLEAR
        if meet_ is not None:
            is_near |= min(abs(meet_ - on), abs(meet_ - far)) < CLEAR
            straight = Element("line", *((far, meet_) if form == "IB 2" else (meet_, far)))
            bowed = arc(*((meet_, end) if form == "IB 2" else (start, meet_)), center, sense)
            elements = [straight, bowed] if form == "IB 2" else [bowed, straight]
    elif form in ("IB 4", "IB 5"):
        way = heading(angle) if form == "IB 4" else -heading(angle)
        side = sense if form == "IB 4" else -sense
        far, on = (start, end) if form == "IB 4" else (end, start)
        if rng.random() < 0.7:
            # An end that the arc reaches.
            on = far + way * (complex(rng.uniform(1, 80), side * size) + size * heading(rng.uniform(0, 360)))
            on = complex(round(on.real, 3), round(on.imag, 3))
            start, end = (far, on) if form == "IB 4" else (on, far)
        head = f"G{plane} G90 G00 {at(start)}\n"
        hub_ = contact(far, way, on, size, side, is_long=is_long)
        text = (
            f"G01 A{angle}\n{turn} {at(end)} {signed}" if form == "IB 4" else f"{turn} {signed}\nG01 {at(end)} A{angle}"
        )
        height = cross(way, on - far) * side
        is_near = min(abs(height), abs(height - 2 * size)) < CLEAR
        if hub_ is not None:
            length = dot(hub_ - far, way)
            meet = far + way * length
            is_near |= abs(length) < CLEAR or abs(meet - on) < CLEAR
            if length > 0:
                straight = Element("line", *((far, meet) if form == "IB 4" else (meet, far)))
                bowed = arc(*((meet, end) if form == "IB 4" else (start, meet)), hub_, sense)
                elements = [straight, bowed] if form == "IB 4" else [bowed, straight]
    else:
        is_equal = rng.random() < 0.4
        contact_side = -1 if is_equal else 1
        words = (turn, turn if is_equal else other)
        first_known = form == "IB 1 centre"
        bow = place(40)
        fixed, on = (start, end) if first_known else (end, start)
        known = fixed + bow
        own = abs(bow)
        if rng.random() < 0.7:
            touch = known + own * heading(rng.uniform(0, 360))
            hub = touch + (touch - known) / own * size * contact_side
            on = hub + size * heading(rng.uniform(0, 360))
            on = complex(round(on.real, 3), round(on.imag, 3))
        start, end = (fixed, on) if first_known else (on, fixed)
        head = f"G{plane} G90 G00 {at(start)}\n"
        text = (
            f"{words[0]} {arm(bow)}\n{words[1]} {at(end)} {signed}"
            if first_known
            else f"{words[0]} {signed}\n{words[1]} {at(end)} {arm(bow)}"
        )
        senses = (sense, sense if is_equal else -sense)
        reach, apart = abs(own + contact_side * size), abs(on - known)
        is_near = min(abs(apart - reach - size), abs(apart - abs(reach - size)), reach) < CLEAR
        for hub in touching(known, own, on, size, contact_side):
            meet = touch_point(known, own, hub, size, contact_side)
            is_near |= min(abs(meet - start), abs(meet - end)) < CLEAR
            turned = swept(meet, end, hub, senses[1]) if first_known else swept(start, meet, hub, senses[0])
            if (turned > tau / 2) is is_long:
                hubs = (known, hub) if first_known else (hub, known)
                elements = [arc(start, meet, hubs[0], senses[0]), arc(meet, end, hubs[1], senses[1])]
    return Drawn(head + text, elements, is_near)
