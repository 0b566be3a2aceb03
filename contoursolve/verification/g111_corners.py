"""YASNAC LX3 G111: the corners between the lines, and the elements of the path, by the sheet (2.8.30).

Points count from the start point: real is Z, imaginary is X as radius.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

from contoursolve.model import Turn
from contoursolve.tolerance import LENGTH, REGULAR
from contoursolve.verification.case import Case, Move
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import PRINTED, cross, dot, sign

BEVELS = ("C", "D")


@dataclass(frozen=True, slots=True)
class Lines:
    """The two virtual intersections, and the unit directions of both lines; an angle in use gives them exactly.

    `landing` is the unit vector of the axis that corner 2 lands along, in either sense; None if the words give
    no such line. `zero` is the size up to which a component of `first` counts as zero.
    """

    v1: complex
    v2: complex
    first: complex
    second: complex
    landing: complex | None
    zero: float

    @property
    def slack(self) -> float:
        """By how much an angle in use is off its line, mm: next to nothing, unless words only just agree."""
        return abs(cross(self.first, self.v1)) + abs(cross(self.second, self.v2 - self.v1))


@dataclass(frozen=True, slots=True)
class _Corner:
    """A corner that is made: its word, its size (mm), and the lines before and after it.

    `at` is the virtual intersection; `quadrant` holds the signs of a bevel's two extents, each -1, 0 or 1.
    `room` is the length of the shorter line, mm; a third line has no end.
    """

    name: str
    word: str
    size: float
    at: complex
    arriving: complex
    leaving: complex
    quadrant: complex
    room: float


def check_elements(case: Case, ledger: Ledger, lines: Lines) -> None:
    """The corners are those of the words, and the elements run along the lines and corners."""
    drawn = Ledger()
    corners = {corner.name: corner for corner in _corners(case, drawn, lines)}
    ledger.add(drawn)
    if drawn.failures:
        ledger.omit("the elements", "the corners between them are not defined")
    else:
        _check_order(case, ledger, lines, corners)


def _corners(case: Case, ledger: Ledger, lines: Lines) -> Iterator[_Corner]:
    """The corners that are made: a word of 0 makes none."""
    for name, bevel, rounding in (("corner 1", "C", "P"), ("corner 2", "D", "Q")):
        words = [word for word in case.states(bevel, rounding) if case.value(word)]
        texts = case.texts(*words)
        if not words or not ledger.require(f"{name} has one shape", texts, len(words) == 1, "two words"):
            continue
        size = case.amount(words[0])
        if not ledger.require(f"{name} has a size", texts, size > 0, f"{size:g} mm"):
            continue
        room = abs(lines.v2 - lines.v1)
        if name == "corner 1":
            room = min(room, abs(lines.v1))
            quadrant = complex(sign(lines.v2.real, case.limit), sign(lines.v2.imag, case.limit))
            corner = _Corner(name, words[0], size, lines.v1, lines.first, lines.second, quadrant, room)
            if _joins(corner, ledger, texts):
                yield corner
            continue
        remark = "X(U) and Z(W) both give line 2"
        if not ledger.require(f"{name} has a line to land on", texts, lines.landing is not None, remark):
            continue
        # Tables 2.35 and 2.36: a component that line 2 lacks is taken from line 1.
        onward = complex(
            sign(lines.second.real) or sign(lines.first.real, lines.zero),
            sign(lines.second.imag) or sign(lines.first.imag, lines.zero),
        )
        leaving = complex(onward.real, 0) if lines.landing == 1 else complex(0, onward.imag)
        corner = _Corner(name, words[0], size, lines.v2, lines.second, leaving, onward, room)
        if _joins(corner, ledger, texts):
            yield corner


def _joins(corner: _Corner, ledger: Ledger, texts: tuple[str, ...]) -> bool:
    """Whether a corner lies between two lines that have a length and are not parallel."""
    joins = corner.room > LENGTH and abs(cross(corner.arriving, corner.leaving)) > REGULAR
    return ledger.require(f"{corner.name} joins two lines", texts, joins, "one has no length, or they are parallel")


Slots = dict[str, Move]
"""The claimed elements by their names: line 1, corner 1, line 2, corner 2."""


def _check_order(case: Case, ledger: Ledger, lines: Lines, corners: dict[str, _Corner]) -> None:
    """The elements are the two lines and the corners, each where it belongs.

    A line that its corners leave no length is left out; the reading that has the fewest faults counts.
    """
    order = [name for name in ("line 1", "corner 1", "line 2", "corner 2") if "line" in name or name in corners]
    ledgers = []
    for kept1, kept2 in product((True, False), repeat=2):
        names = [name for name in order if (name != "line 1" or kept1) and (name != "line 2" or kept2)]
        shapes = [name in corners and corners[name].word not in BEVELS for name in names]
        if shapes == [move.circle is not None for move in case.moves]:
            attempt = Ledger()
            _check_slots(case, attempt, lines, corners, dict(zip(names, case.moves, strict=True)))
            ledgers.append(attempt)
    texts = case.texts(*(corner.word for corner in corners.values()))
    found = ", ".join("arc" if move.circle else "line" for move in case.moves) or "nothing"
    wanted = ", ".join("arc" if name in corners and corners[name].word not in BEVELS else "line" for name in order)
    remark = f"found {found}; the words make {wanted}"
    if ledger.require("the elements are those that the words make", texts, bool(ledgers), remark):
        ledger.add(min(ledgers, key=lambda each: len(each.failures)))


def _check_slots(case: Case, ledger: Ledger, lines: Lines, corners: dict[str, _Corner], slots: Slots) -> None:
    limit = case.limit + lines.slack
    line1 = slots["line 1"].end if "line 1" in slots else 0j
    joined = _check_corner(case, ledger, "corner 1", line1, lines, corners, slots)
    line2 = slots["line 2"].end if "line 2" in slots else joined
    _check_corner(case, ledger, "corner 2", line2, lines, corners, slots)
    if "corner 1" in corners:
        word = case.texts(corners["corner 1"].word)
        _check_between(limit, ledger, "corner 1 leaves line 1", word, (0j, lines.v1), lines.first, line1)
        _check_between(limit, ledger, "corner 1 joins line 2", word, (lines.v1, lines.v2), lines.second, joined)
        if corners["corner 1"].word in BEVELS:
            # p. 138: refused where V1 lies outside the rectangle of start and end of line 2.
            out = max(0.0, *(max(min(0.0, to) - at, at - max(0.0, to)) for at, to in _sides(lines)))
            ledger.measure("V1 lies between the start and V2", word, out, case.limit)
    if "corner 2" in corners:
        word = case.texts(corners["corner 2"].word)
        _check_between(limit, ledger, "corner 2 leaves line 2", word, (lines.v1, lines.v2), lines.second, line2)
        beyond = slots["corner 2"].end - lines.v2
        back = max(0.0, -dot(corners["corner 2"].leaving, beyond))
        ledger.measure("corner 2 lands ahead of V2", word, back, case.limit)
        ledger.measure("corner 2 lands on its line", word, cross(corners["corner 2"].leaving, beyond), case.limit)
    overlap = max(0.0, -dot(lines.second, line2 - joined))
    ledger.measure("the corners leave room on line 2", (), overlap, case.limit)


def _sides(lines: Lines) -> Iterator[tuple[float, float]]:
    """V1 and V2 along each axis."""
    yield lines.v1.real, lines.v2.real
    yield lines.v1.imag, lines.v2.imag


def _check_between(
    limit: float,
    ledger: Ledger,
    name: str,
    words: tuple[str, ...],
    ends: tuple[complex, complex],
    along: complex,
    at: complex,
) -> None:
    """A point lies on a line and between its ends."""
    begin, end = ends
    ledger.measure(f"{name} on it", words, cross(along, at - begin), limit)
    outside = max(0.0, -dot(along, at - begin), -dot(along, end - at))
    ledger.measure(f"{name} between its ends", words, outside, limit)


def _check_corner(
    case: Case,
    ledger: Ledger,
    name: str,
    reached: complex,
    lines: Lines,
    corners: dict[str, _Corner],
    slots: Slots,
) -> complex:
    """The corner itself, from where the line before it ends; where the next line begins."""
    if name not in corners:
        at = lines.v1 if name == "corner 1" else lines.v2
        ledger.measure(f"{name} is sharp", (), abs(reached - at), case.limit)
        return reached
    corner, move = corners[name], slots[name]
    word = case.texts(corner.word)
    if corner.word in BEVELS:
        extent = corner.size * corner.quadrant
        ledger.measure(f"{name} is a 45 degree bevel", word, abs(move.end - move.start - extent), case.limit)
    elif move.circle:
        circle = move.circle
        # A direction taken from two points has their error, and a large radius makes it larger.
        limit = case.limit + (lines.slack + 2 * PRINTED) * (1 + corner.size / corner.room)
        before, after = dot(corner.arriving, move.start - circle.center), dot(corner.leaving, move.end - circle.center)
        ledger.measure(f"{name} has its radius", word, circle.radius - corner.size, case.limit)
        ledger.measure(f"{name} touches the line before", word, before, limit)
        ledger.measure(f"{name} touches the line after", word, after, limit)
        turn = Turn.CCW if cross(corner.arriving, corner.leaving) > 0 else Turn.CW
        ledger.require(f"{name} turns as the lines do", word, circle.turn is turn, circle.turn.value)
    return move.end
