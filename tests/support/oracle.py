"""Closed forms written from the control sheets alone, to hold the package against: plain math, no import of it.

A point is a complex number: real is the plane's first axis (Z of the lathe), imaginary its second
(X of the lathe, as radius). Words come as the control reads them: mm, degrees, diameters.
"""

import cmath
from collections.abc import Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from math import acos, copysign, inf, radians, sqrt
from typing import Any, NamedTuple

Number = float | Decimal
Words = Mapping[str, Number]

ON = 1e-10
"""mm. A case this close to a boundary lies on it; rounding moves it no further."""
NEAR = 1e-6
"""mm. A case this close to a boundary, but not on it, is nobody's to judge."""


class Element(NamedTuple):
    kind: str
    start: complex
    end: complex
    center: complex | None = None
    radius: float = 0.0
    turn: str = ""


def elements_of(answer) -> list[Element]:
    """The elements of an answer that has a contour."""
    found = []
    for each in answer.contour.elements if answer.contour else ():
        start, end = complex(*each.start), complex(*each.end)
        if hasattr(each, "center"):
            found.append(Element("arc", start, end, complex(*each.center), each.radius, each.turn.value))
        else:
            found.append(Element("line", start, end))
    return found


@dataclass
class Outcome:
    status: str = ""
    points: dict[str, complex] = field(default_factory=dict)
    elements: list[Element] = field(default_factory=list)
    is_near: bool = False
    """Whether some condition is met, or missed, by less than `NEAR`."""
    end: complex = 0j

    def need(self, slack: float, on: float = ON) -> None:
        """The path exists only if `slack` (mm) is at least zero."""
        self.is_near |= on < abs(slack) < NEAR
        if slack < -on:
            raise _RefusedError("no-solution")

    def need_length(self, length: float) -> None:
        self.need(length if length > ON else -NEAR)

    def go(self, element: Element) -> None:
        if abs(element.end - element.start) > ON:
            self.elements.append(element)
        self.end = element.end


class _RefusedError(Exception):
    """The status is its only argument."""


def heading(degrees: Number) -> complex:
    """The direction of an angle; exact along the axes, and folded as a decimal: 359.999 is as good as -0.001.

    >>> heading(-270) == 1j
    True
    """
    quarter, rest = divmod(Decimal(degrees), 90)
    return (1, 1j, -1, -1j)[int(quarter) % 4] * cmath.rect(1, radians(rest))


def cross(u: complex, v: complex) -> float:
    return (u.conjugate() * v).imag


def dot(u: complex, v: complex) -> float:
    return (u.conjugate() * v).real


def sign(value: float) -> int:
    return (value > 0) - (value < 0)


Locus = tuple[complex, complex]
"""A point and a direction: every word of G111 but a corner puts V1 or V2 onto a line."""


def meet(one: Locus, other: Locus, outcome: Outcome) -> complex:
    (p, u), (q, v) = one, other
    sine = cross(u, v)
    outcome.is_near |= 1e-12 < abs(sine) < NEAR
    if abs(sine) <= 1e-12:
        apart = abs(cross(q - p, u))
        outcome.is_near |= ON < apart < NEAR
        raise _RefusedError("no-solution" if apart > ON else "underdetermined")
    return p + u * (cross(q - p, v) / sine)


def g111(start: complex, words: Words) -> Outcome:
    """YASNAC LX3 G111 by section 2.8.30.

    >>> f"{g111(20j, {'X': 100, 'A': 180, 'K': -30, 'B': 120, 'P': 5, 'Q': 5}).end:.4f}"
    '-50.2073+50.0000j'
    """
    outcome = Outcome()
    if not _is_legal(words):
        outcome.status = "rejected"
        return outcome
    try:
        _taper(start, words, outcome)
        outcome.status = "solved"
    except _RefusedError as refused:
        outcome.status = refused.args[0]
    return outcome


def _is_legal(words: Words) -> bool:
    first = len(words.keys() & {"A", "I", "K"})
    second = [bool(words.keys() & slot) for slot in ({"B"}, {"X", "U"}, {"Z", "W"})]
    return (
        not any(words.keys() >= pair for pair in ({"X", "U"}, {"Z", "W"}, {"C", "P"}, {"D", "Q"}))
        and all(words.get(name, 0) >= 0 for name in "CPDQ")
        and all(abs(words.get(name, 0)) <= 360 for name in "AB")
        and ((first >= 2 and sum(second) >= 2) or (first == 1 and all(second)))
        and not (second[1] and second[2] and words.keys() & {"D", "Q"})
    )


def _taper(start: complex, words: Words, outcome: Outcome) -> None:
    a = heading(words["A"]) if "A" in words and not words.keys() >= {"I", "K"} else None  # (v)
    ends: list[Locus] = []
    if "X" in words:
        ends.append((complex(0, words["X"]) / 2, 1))
    if "U" in words:
        ends.append((complex(0, start.imag + float(words["U"]) / 2), 1))
    if "Z" in words:
        ends.append((complex(words["Z"]), 1j))
    if "W" in words:
        ends.append((complex(start.real + float(words["W"])), 1j))
    corner: list[Locus] = []
    if "I" in words:
        corner.append((start + 1j * float(words["I"]), 1))
    if "K" in words:
        corner.append((start + float(words["K"]), 1j))
    if a is not None:
        corner.append((start, a))
    b = heading(words["B"]) if "B" in words and (len(ends) == 1 or len(corner) == 1) else None  # (vi)

    if len(corner) == 2:
        v1 = meet(corner[0], corner[1], outcome)
        v2 = meet(ends[0], ends[1] if b is None else (v1, b), outcome)
    else:  # (i)
        v2 = meet(ends[0], ends[1], outcome)
        v1 = meet(corner[0], (v2, b or 1), outcome)
    outcome.points = {"V1": v1, "V2": v2}
    line1, line2 = v1 - start, v2 - v1
    for line, direction in ((line1, a), (line2, b)):
        if direction is not None:
            outcome.need(dot(direction, line))
    u1, u2 = (
        direction if direction is not None else line / abs(line) if abs(line) > ON else 0j
        for line, direction in ((line1, a), (line2, b))
    )
    _cornered(start, words, (v1, v2), (u1, u2), outcome)


def _cornered(
    start: complex, words: Words, points: tuple[complex, complex], ways: tuple[complex, complex], outcome: Outcome
) -> None:
    """The path by two lines with corners at their ends."""
    (v1, v2), (u1, u2) = points, ways
    line1, line2 = v1 - start, v2 - v1
    first = second = None
    if words.get("C") or words.get("P"):
        outcome.need_length(abs(line1))  # a corner joins two lines, neither of which is a point
    if any(words.get(name) for name in "CPDQ"):
        outcome.need_length(abs(line2))
    if words.get("C") or words.get("P"):
        quadrant = complex(sign((v2 - start).real), sign((v2 - start).imag))
        first = _corner(v1, u1, u2, quadrant, float(words.get("C", 0)), float(words.get("P", 0)), outcome)
        if words.get("C"):
            box = v2 - start
            for low, at, high in (
                (min(0, box.real), line1.real, max(0, box.real)),
                (min(0, box.imag), line1.imag, max(0, box.imag)),
            ):
                outcome.need(at - low)
                outcome.need(high - at)
    if words.get("D") or words.get("Q"):
        onward = complex(sign(u2.real) or sign(u1.real), sign(u2.imag) or sign(u1.imag))
        third = complex(onward.real) if words.keys() & {"X", "U"} else 1j * onward.imag
        second = _corner(v2, u2, third, onward, float(words.get("D", 0)), float(words.get("Q", 0)), outcome)

    leave1 = first.start if first else v1
    join2, leave2 = first.end if first else v1, second.start if second else v2
    if first:
        outcome.need(dot(u1, leave1 - start))
    if first or second:
        outcome.need(dot(u2, leave2 - join2))
    outcome.end = start
    outcome.go(Element("line", start, leave1))
    if first:
        outcome.go(first)
    outcome.go(Element("line", join2, leave2))
    if second:
        outcome.go(second)


def _corner(
    at: complex, u: complex, v: complex, quadrant: complex, bevel: float, radius: float, outcome: Outcome
) -> Element:
    """A bevel found by sliding a 45 degree stick along the first line, or a fillet about the bisector's centre."""
    outcome.is_near |= 1e-12 < abs(cross(u, v)) < NEAR
    if not u or not v or abs(cross(u, v)) <= 1e-12:
        raise _RefusedError("no-solution")
    if bevel:
        stick = bevel * quadrant
        slid = cross(stick, v) / cross(u, v)
        begin, end = at - slid * u, at - slid * u + stick
        outcome.need(slid)
        outcome.need(dot(v, end - at))
        return Element("line", begin, end)
    # The bisector's centre is radius / cos(turn / 2) away, and cos(turn / 2) is |u + v| / 2.
    center = at + 2 * radius * (v - u) / (abs(v - u) * abs(v + u))
    begin, end = at + u * dot(u, center - at), at + v * dot(v, center - at)
    return Element("arc", begin, end, center, radius, "ccw" if cross(u, v) > 0 else "cw")


PLANES = {17: ("X", "Y", "I", "J"), 18: ("Z", "X", "K", "I"), 19: ("Y", "Z", "J", "K")}
"""Addresses of the first and second axis, and of the centre along them."""


def circle_line(
    plane: int,
    start: complex,
    turn: str,
    arc: Words,
    line: Words,
    *,
    is_incremental: bool = False,
    is_compensated: bool = True,
) -> Outcome:
    """NCT 16.3.3: the words of the arc (`turn` cw for G2, ccw for G3) and of the over-defined line.

    >>> arc, line = {"X": -50, "Y": 0, "R": 50}, {"X": -50, "Y": 42.857, ",A": 171.87, "Q": -1}
    >>> f"{circle_line(17, 50, 'ccw', arc, line).points['P1']:.5f}"
    '39.99998+30.00002j'
    """
    outcome = Outcome()
    first, second, i, j = PLANES[plane]
    has_center, has_point = bool(arc.keys() & {i, j}), bool(arc.keys() & {first, second})
    is_legal = is_compensated and line.get("Q", 0) and has_center != ("R" in arc) and (has_center or has_point)
    if not is_legal or arc.get("R") == 0:
        outcome.status = "rejected"
        return outcome
    try:
        _circle_line(plane, start, turn, arc, line, is_incremental, outcome)
        outcome.status = "solved"
    except _RefusedError as refused:
        outcome.status = refused.args[0]
    return outcome


def _circle_line(
    plane: int, start: complex, turn: str, arc: Words, line: Words, is_incremental: bool, outcome: Outcome
) -> None:
    first, second, i, j = PLANES[plane]
    if is_incremental:
        point = start + complex(arc.get(first, 0), arc.get(second, 0))
    else:
        point = complex(arc.get(first, start.real), arc.get(second, start.imag))
    if "R" in arc:
        radius, chord = abs(float(arc["R"])), point - start
        outcome.need_length(abs(chord))
        outcome.need(radius - abs(chord) / 2)
        # Seen from the start, the centre lies beside the chord: left of it on a short ccw or a long cw arc.
        aside = copysign(acos(min(1.0, abs(chord) / 2 / radius)), arc["R"]) * (1 if turn == "ccw" else -1)
        center = start + chord / abs(chord) * cmath.rect(radius, aside)
    else:
        center = start + complex(arc.get(i, 0), arc.get(j, 0))
        radius = abs(center - start)
        outcome.need_length(radius)
        if arc.keys() & {first, second}:
            difference = abs(abs(point - center) - radius)
            outcome.is_near |= abs(difference - 0.01) < NEAR
            if difference > 0.01:
                raise _RefusedError("conflicting")
    # The power of the line's end is the product of its two distances to the circle along the line.
    end, along = complex(line[first], line[second]), heading(line[",A"])
    room = radius - abs(cross(along, end - center))
    outcome.need(room, on=0.0)
    half_sum = dot(along, end - center)
    power = (abs(end - center) - radius) * (abs(end - center) + radius) if room else half_sum**2
    larger = half_sum + copysign(sqrt(max(0.0, half_sum**2 - power)), half_sum)
    distances = larger, power / larger if larger else 0.0
    distance = max(distances) if line["Q"] < 0 else min(distances)  # the nearer is met first: farther before the end
    crossing = end - distance * along
    outcome.points = {"P1": crossing}
    outcome.need(distance)
    outcome.need_length(abs(crossing - start))
    outcome.end = start
    outcome.go(Element("arc", start, crossing, center, radius, turn))
    outcome.go(Element("line", crossing, end))


def largest_gap(outcome: Outcome, contour: Any) -> float:
    """The largest distance, mm, between an outcome and a contour of the package: all points, ends and radii.

    Infinite where the two are not made of the same elements.
    """
    elements = list(contour.elements)
    if len(elements) != len(outcome.elements) or outcome.points.keys() != set(contour.points):
        return inf
    gaps = [abs(complex(*contour.points[name]) - point) for name, point in outcome.points.items()]
    gaps.append(abs(complex(*contour.end) - outcome.end))
    for mine, theirs in zip(outcome.elements, elements, strict=True):
        gaps += [abs(complex(*theirs.start) - mine.start), abs(complex(*theirs.end) - mine.end)]
        if mine.kind != ("arc" if hasattr(theirs, "center") else "line"):
            return inf
        if mine.center is not None:
            if theirs.turn.value != mine.turn:
                return inf
            gaps += [abs(complex(*theirs.center) - mine.center), abs(theirs.radius - mine.radius)]
    return max(gaps)
