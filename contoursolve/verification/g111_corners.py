"""YASNAC LX3 G111: the corners between the lines, and the elements of the path, by the sheet (2.8.30).

The size of a corner that is asked for is that of the claimed element; the corner must then be right in all else.

Points count from the start point: real is Z, imaginary is X as radius.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

from contoursolve.model import Turn
from contoursolve.tolerance import LENGTH, REGULAR
from contoursolve.verification.case import Case, Move
from contoursolve.verification.g111_drawing import BEVELS, CORNERS, Lines, Sizes, Slots
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import PRINTED, cross, dot, sign


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


def check_elements(case: Case, ledger: Ledger, lines: Lines) -> tuple[Slots, Sizes] | None:
    """The corners are those of the words, and the elements run along the lines and corners.

    A line that its corners leave no length is left out; of several readings the one with the fewest faults counts.
    Its elements by name are returned.
    """
    found = []
    for slots in _readings(case):
        attempt, sizes = Ledger(), _sizes(case, slots, lines)
        corners = {corner.name: corner for corner in _corners(case, attempt, lines, sizes)}
        if attempt.failures:
            attempt.omit("the elements", "the corners between them are not defined")
        else:
            _check_slots(case, attempt, lines, corners, slots)
        found.append((attempt, slots, sizes))
    if found:
        best = min(found, key=lambda each: len(each[0].failures))
        ledger.require("the elements are those that the words make", case.texts(*_WORDS), True)
        ledger.add(best[0])
        return best[1:]
    list(_corners(case, ledger, lines, _sizes(case, {}, lines)))
    shown = ", ".join("arc" if move.circle else "line" for move in case.moves) or "nothing"
    wanted = ", ".join("arc" if shape else "line" for _, shape in _order(case))
    remark = f"the result has {shown}, and the words make {wanted}"
    ledger.require("the elements are those that the words make", case.texts(*_WORDS), False, remark)
    return None


_WORDS = ("C", "P", "D", "Q")


def makers(case: Case, name: str) -> list[str]:
    """The words that make a corner: a word of 0 makes none."""
    (words,) = ((bevel, rounding) for corner, bevel, rounding in CORNERS if corner == name)
    return [word for word in words if word in case.asked or (case.states(word) and case.value(word))]


def _order(case: Case) -> list[tuple[str, bool]]:
    """The names of all elements that the words make, in order, and whether each is an arc."""
    found = [("line 1", False), ("corner 1", False), ("line 2", False), ("corner 2", False)]
    making = {name: makers(case, name) for name, *_ in CORNERS}
    return [
        (name, name in making and making[name][0] not in BEVELS)
        for name, _ in found
        if name not in making or making[name]
    ]


def _readings(case: Case) -> Iterator[Slots]:
    """Every way to give the claimed elements their names. Lines, and corners whose size is asked for, may be of no
    length and left out."""
    order = _order(case)
    optional = {"line 1", "line 2"} | {name for name, *_ in CORNERS if set(makers(case, name)) & set(case.asked)}
    for kept in product((True, False), repeat=len(order)):
        chosen = [each for each, is_kept in zip(order, kept, strict=True) if is_kept]
        left = {each[0] for each, is_kept in zip(order, kept, strict=True) if not is_kept}
        if left <= optional and [shape for _, shape in chosen] == [move.circle is not None for move in case.moves]:
            yield dict(zip((name for name, _ in chosen), case.moves, strict=True))


def _size(move: Move, at: complex, lines: Lines) -> float:
    """The size of a claimed corner: its radius, how far it is set back from `at`, or by its extent along the axes."""
    run = move.end - move.start
    extent = abs(move.start - at) if lines.is_setback else max(abs(run.real), abs(run.imag)) / lines.share
    return move.circle.radius if move.circle else extent


def _sizes(case: Case, slots: Slots, lines: Lines) -> Sizes:
    """Sizes as stated; one that is asked for is that of its element."""
    sizes: Sizes = {}
    for name, *_ in CORNERS:
        at = case.points["V1" if name == "corner 1" else "V2"]
        for word in makers(case, name):
            if word not in case.asked:
                sizes[word] = case.amount(word)
            elif name in slots:
                sizes[word] = _size(slots[name], at, lines)
            else:
                sizes[word] = 0.0
    return sizes


def _corners(case: Case, ledger: Ledger, lines: Lines, sizes: Sizes) -> Iterator[_Corner]:
    """The corners that are made."""
    for name, *_ in CORNERS:
        words = [word for word in makers(case, name) if sizes[word] or word not in case.asked]
        texts = case.texts(*words)
        if not words or not ledger.require(f"{name} has one shape", texts, len(words) == 1, "two words give it one"):
            continue
        size = sizes[words[0]]
        if not ledger.require(f"{name} has a size", texts, size > 0, f"it is {size:g} mm"):
            continue
        room = abs(lines.v2 - lines.v1)
        if name == "corner 1":
            room = min(room, abs(lines.v1))
            quadrant = complex(sign(lines.v2.real, case.limit), sign(lines.v2.imag, case.limit))
            corner = _Corner(name, words[0], size, lines.v1, lines.first, lines.second, quadrant, room)
            if _joins(corner, ledger, texts):
                yield corner
            continue
        if lines.meeting is not None:
            texts = (*texts, lines.meeting.label)
        leaving, remark = lines.leaving, "X(U) and Z(W) both give line 2, or neither does"
        ledger.require(f"{name} has a line to land on", texts, leaving is not None, remark)
        if leaving is None:
            continue
        corner = _Corner(name, words[0], size, lines.v2, lines.second, leaving, lines.onward, room)
        if _joins(corner, ledger, texts):
            yield corner


def _joins(corner: _Corner, ledger: Ledger, texts: tuple[str, ...]) -> bool:
    """Whether a corner lies between two lines that have a length and are not parallel."""
    joins = corner.room > LENGTH and abs(cross(corner.arriving, corner.leaving)) > REGULAR
    return ledger.require(f"{corner.name} joins two lines", texts, joins, "one has no length, or they are parallel")


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
        if corners["corner 1"].word in BEVELS and not lines.is_setback:
            # p. 140 Note 3: refused where V1 lies outside the rectangle of start and end of line 2.
            # Either of two coordinates is exact to half its increment.
            for axis, (at, to) in enumerate(_sides(lines)):
                out = max(0.0, min(0.0, to) - at, at - max(0.0, to))
                limit = case.limit + case.increment(str(axis))
                ledger.measure("V1 lies between the start and V2", word, out, limit)
    if "corner 2" in corners:
        word = case.texts(corners["corner 2"].word)
        if lines.meeting is not None:
            word = (*word, lines.meeting.label)
        _check_between(limit, ledger, "corner 2 leaves line 2", word, (lines.v1, lines.v2), lines.second, line2)
        beyond = slots["corner 2"].end - lines.v2
        back = max(0.0, -dot(corners["corner 2"].leaving, beyond))
        ledger.measure("corner 2 lands ahead of V2", word, back, case.limit)
        ledger.measure("corner 2 lands on its line", word, cross(corners["corner 2"].leaving, beyond), case.limit)
        if lines.meeting is not None and lines.meeting.length is not None:
            beyond_end = max(0.0, dot(corners["corner 2"].leaving, beyond) - lines.meeting.length)
            ledger.measure("corner 2 lands before the end of the line that it meets", word, beyond_end, case.limit)
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
    if corner.word in BEVELS and lines.is_setback:
        for end, side in ((move.start, "before"), (move.end, "after")):
            far = abs(end - corner.at) - corner.size
            ledger.measure(f"{name} is set back by its size on the line {side}", word, far, case.limit + lines.slack)
    elif corner.word in BEVELS:
        extent = lines.share * corner.size * corner.quadrant
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
        ledger.require(f"{name} turns as the lines do", word, circle.turn is turn, f"it turns {circle.turn.value}")
    return move.end
