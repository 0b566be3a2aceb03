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
    """Two blocks of a form, most of them drawn first, and then written with three decimals."""
    draw = _Draw(rng, plane)
    if form == "I":
        return draw.vertex()
    if form in ("IB 2", "IB 3"):
        return draw.crossing(is_line_first=form == "IB 2")
    if form in ("IB 4", "IB 5"):
        return draw.contact(is_line_first=form == "IB 4")
    return draw.arcs(is_first_known=form == "IB 1 centre")


class _Draw:
    """Random words and what they say; of two blocks the second may be drawn first, against the way of travel."""

    def __init__(self, rng: Random, plane: int) -> None:
        self.rng, self.plane, self.letters = rng, plane, AXES[plane]
        self.angle = round(rng.uniform(-180, 180), 3)
        self.sense, self.is_long = rng.choice((1, -1)), rng.random() < 0.3
        self.size = round(rng.uniform(5, 50), 3)
        self.signed = f"R{'-' if self.is_long else ''}{self.size:.3f}"

    def place(self, size: float = 60) -> complex:
        return complex(round(self.rng.uniform(-size, size), 3), round(self.rng.uniform(-size, size), 3))

    def words(self, point: complex, names: slice = slice(0, 2)) -> str:
        first, second = self.letters[names]
        return f"{first}{point.real:.3f} {second}{point.imag:.3f}"

    def arm(self, to: complex) -> str:
        return self.words(to, slice(2, 4))

    def drawn(self, start: complex, text: str, elements: list[Element], *, is_near: bool) -> Drawn:
        return Drawn(f"G{self.plane} G90 G00 {self.words(start)}\n{text}", elements, is_near)

    def vertex(self) -> Drawn:
        start, end = self.place(), self.place()
        first, second = (float(self.rng.randint(-179, 179)) for _ in range(2))
        text, apart = f"G01 A{first}\n{self.words(end)} A{second}", (first - second) % 180
        if not apart:
            return self.drawn(start, text, [], is_near=False)
        meet = vertex(start, first, end, second)
        lines = [Element("line", start, meet), Element("line", meet, end)]
        return self.drawn(start, text, lines, is_near=abs(meet) > 1e4 or apart in (1, 179))

    def crossing(self, *, is_line_first: bool) -> Drawn:
        start, end, bow, pick = self.place(), self.place(), self.place(40), self.rng.choice((0, 1))
        far, on = (start, end) if is_line_first else (end, start)
        center, own = on + bow, abs(bow)
        line, curve = f"G01 A{self.angle}", f"{_turn(self.sense)} {self.arm(bow)} H{pick}"
        text = f"{line}\n{curve} {self.words(end)}" if is_line_first else f"{curve}\n{line} {self.words(end)}"
        meet = crossing(far, self.angle, center, own, is_longer=bool(pick))
        gap = abs(abs(cross(heading(self.angle), center - far)) - own)
        near = min(gap, abs(dot(center - far, heading(self.angle)))) < CLEAR
        if meet is None:
            return self.drawn(start, text, [], is_near=near)
        near |= min(abs(meet - on), abs(meet - far)) < CLEAR
        return self.drawn(start, text, self._pair(start, meet, end, center, is_line_first), is_near=near)

    def _pair(self, start: complex, meet: complex, end: complex, center: complex, is_line_first: bool) -> list[Element]:
        if is_line_first:
            return [Element("line", start, meet), _arc(meet, end, center, self.sense)]
        return [_arc(start, meet, center, self.sense), Element("line", meet, end)]

    def contact(self, *, is_line_first: bool) -> Drawn:
        way, side = (heading(self.angle), self.sense) if is_line_first else (-heading(self.angle), -self.sense)
        far, on, size = self.place(), self.place(), self.size
        if self.rng.random() < 0.7:
            bent = size * heading(self.rng.uniform(0, 360))
            on = _rounded(far + way * (complex(self.rng.uniform(1, 80), side * size) + bent))
        start, end = (far, on) if is_line_first else (on, far)
        place = f"{self.words(end)}"
        text = f"G01 A{self.angle}\n{_turn(self.sense)} {place} {self.signed}"
        if not is_line_first:
            text = f"{_turn(self.sense)} {self.signed}\nG01 {place} A{self.angle}"
        hub = contact(far, way, on, size, side, is_long=self.is_long)
        height = cross(way, on - far) * side
        near = min(abs(height), abs(height - 2 * size)) < CLEAR
        length = dot(hub - far, way) if hub is not None else 0.0
        meet = far + way * length
        if hub is None or length <= 0:
            return self.drawn(start, text, [], is_near=near or 0 < abs(length) < CLEAR)
        near |= length < CLEAR or abs(meet - on) < CLEAR
        return self.drawn(start, text, self._pair(start, meet, end, hub, is_line_first), is_near=near)

    def arcs(self, *, is_first_known: bool) -> Drawn:
        fixed, on, bow, size = self.place(), self.place(), self.place(40), self.size
        known, own, side = fixed + bow, abs(bow), self.rng.choice((1, -1))
        senses = (self.sense, -side * self.sense)
        if self.rng.random() < 0.7:
            hub = known + (own + side * size) * heading(self.rng.uniform(0, 360))
            on = _rounded(hub + size * heading(self.rng.uniform(0, 360)))
        start, end = (fixed, on) if is_first_known else (on, fixed)
        shapes = (self.arm(bow), self.signed) if is_first_known else (self.signed, self.arm(bow))
        text = f"{_turn(senses[0])} {shapes[0]}\n{_turn(senses[1])} {self.words(end)} {shapes[1]}"
        reach, apart = abs(own + side * size), abs(on - known)
        near = min(abs(apart - reach - size), abs(apart - abs(reach - size)), reach) < CLEAR
        elements: list[Element] = []
        for hub in touching(known, own, on, size, side):
            meet = touch_point(known, own, hub, size, side)
            near |= min(abs(meet - start), abs(meet - end)) < CLEAR
            turned = swept(meet, end, hub, senses[1]) if is_first_known else swept(start, meet, hub, senses[0])
            if (turned > tau / 2) is self.is_long:
                first, second = (known, hub) if is_first_known else (hub, known)
                elements = [_arc(start, meet, first, senses[0]), _arc(meet, end, second, senses[1])]
        return self.drawn(start, text, elements, is_near=near)


def _turn(sense: int) -> str:
    return "G03" if sense > 0 else "G02"


def _rounded(point: complex) -> complex:
    return complex(round(point.real, 3), round(point.imag, 3))


def _arc(start: complex, end: complex, center: complex, sense: int) -> Element:
    return Element("arc", start, end, center, abs(start - center), "ccw" if sense > 0 else "cw")
