"""A claimed path against the course that words state: joints, elements and corners, one by one.

Points count from the start point, in mm; real is the plane's first axis, imaginary its second.
"""

from collections.abc import Mapping, Sequence
from itertools import combinations

from contoursolve.tolerance import LENGTH
from contoursolve.verification.case import Case, Move
from contoursolve.verification.course import Bend, Course, Piece, Shape, Trace, length, trace
from contoursolve.verification.drawing import Bevel, Drawing, Round, Straight
from contoursolve.verification.drawing import Shape as Drawn
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import ROUNDING, dot, unit
from contoursolve.verification.rails import Rail, Ray, Ring, UnmakeableError, heading, off

Words = Mapping[str, tuple[str, ...]]
"""The words of each element, as typed."""


def check_points(case: Case, ledger: Ledger, names: Sequence[str]) -> bool:
    """The result names the inner joints, and an end."""
    wanted, found = ", ".join(names) or "none", ", ".join(sorted(map(ascii, case.points))) or "none"
    is_right = ledger.require(
        f"the points are {wanted}", (), case.points.keys() == set(names), f"the result has {found}"
    )
    return is_right and case.end is not None


def check_course(case: Case, ledger: Ledger, course: Course, joints: Sequence[str], words: Words) -> None:
    """The claimed joints, lines, circles and corners are those of the course; `joints` are the names of those
    that the result names; the last one is otherwise the end."""
    claimed = [0j, *(case.points[name] for name in joints)]
    ends = list(joints)
    if len(joints) < len(course.names):
        claimed.append(case.end or 0j)
        ends.append("the end")
    base = ROUNDING * case.reach + case.start_error
    for number, (name, at) in enumerate(zip(ends, claimed[1:], strict=True), 1):
        stated = [word for each in course.names[number - 1 : number + 1] for word in words[each]]
        blur = course.unsure[number] if course.unsure else base
        case.compare(ledger, f"{name} is where the words put it", stated, abs(at - course.joints[number]), blur)
    for number, (name, rail) in enumerate(zip(course.names, course.rails, strict=True)):
        _check_rail(case, ledger, name, rail, claimed[number : number + 2], words[name], course.gaps.get(number, 0.0))
    try:
        traced = trace(course)
    except UnmakeableError as error:
        ledger.require("the elements and corners can be made", _all(words), False, str(error))
        return
    for name, room in traced.room.items():
        taken = [word for bend in course.bends.values() for word in bend.words]
        ledger.measure(f"the corners leave room on {name}", taken, max(0.0, -room), case.limit)
    unsure = max((base, *course.unsure)) * traced.condition
    moves = check_pieces(case, ledger, traced, unsure, words)
    for number, bend in course.bends.items():
        if bend.name in moves:
            after = (
                course.landing[0] if number + 1 == len(course.rails) and course.landing else course.rails[number + 1]
            )
            at = course.joints[number + 1]
            _check_bend(case, ledger, bend, moves[bend.name], (course.rails[number], after), at, unsure)


def _all(words: Words) -> list[str]:
    return [word for each in words.values() for word in each]


def _check_rail(
    case: Case,
    ledger: Ledger,
    name: str,
    rail: Rail,
    ends: Sequence[complex],
    words: tuple[str, ...],
    gap: float,
) -> None:
    """An element begins and ends on its line or circle, and a line runs in its direction."""
    blur = rail.unsure + (rail.swing * max(abs(at - rail.at) for at in ends) if isinstance(rail, Ray) else 0.0)
    thing = "line" if isinstance(rail, Ray) else "circle"
    ledger.measure(f"{name} begins on its {thing}", words, off(rail, ends[0]), case.limit + blur)
    # Alarm 3011: what differs less than a machine parameter is accepted.
    ledger.measure("the point lies on its circle", words, gap, case.slack + case.limit) if gap else None
    end = off(rail, ends[1]) - (gap if abs(off(rail, ends[1]) - gap) <= case.limit + blur else 0.0)
    ledger.measure(f"{name} ends on its {thing}", words, end, case.limit + blur)
    if isinstance(rail, Ray):
        against = max(0.0, -length(rail, ends[0], ends[1]))
        ledger.measure(f"{name} runs in its direction", words, against, case.limit)


def check_pieces(case: Case, ledger: Ledger, traced: Trace, unsure: float, words: Words) -> dict[str, Move]:
    """The claimed elements are those of the trace; by their names."""
    pieces = _fitting(traced.pieces, case.moves)
    shown = ", ".join("arc" if move.circle else "line" for move in case.moves) or "nothing"
    wanted = ", ".join(f"{piece.name} ({'arc' if piece.arc else 'line'})" for piece in traced.pieces)
    name, remark = "the elements are those that the words make", f"the result has {shown}, and the words make {wanted}"
    if not ledger.require(name, _all(words), pieces is not None, remark) or pieces is None:
        return {}
    for piece, move in zip(pieces, case.moves, strict=True):
        own = piece.words or words.get(piece.name, ())
        gap = max(abs(move.start - piece.begin), abs(move.end - piece.end))
        case.compare(ledger, f"{piece.name} begins and ends where the words put it", own, gap, unsure)
        if piece.arc and move.circle:
            center, radius, turn = piece.arc
            gap = abs(move.circle.center - center)
            case.compare(ledger, f"the centre of {piece.name} is where the words put it", own, gap, unsure)
            ledger.measure(f"{piece.name} has its radius", own, move.circle.radius - radius, case.limit + unsure)
            ledger.require(
                f"{piece.name} turns as it must", own, move.circle.turn is turn, f"it turns {move.circle.turn.value}"
            )
    return dict(zip((piece.name for piece in pieces), case.moves, strict=True))


def _fitting(pieces: Sequence[Piece], moves: Sequence[Move]) -> list[Piece] | None:
    """The pieces without those of no length that the claimed path leaves out, too; None if they are others."""
    short = [number for number, piece in enumerate(pieces) if abs(piece.end - piece.begin) <= _SHORT]
    missing = len(pieces) - len(moves)
    kinds = [move.circle is not None for move in moves]
    for left in combinations(short, missing) if 0 <= missing <= len(short) else ():
        kept = [piece for number, piece in enumerate(pieces) if number not in left]
        if [piece.arc is not None for piece in kept] == kinds:
            return kept
    return None


_SHORT = 2 * LENGTH
"""mm. A piece so short may be left out, or not."""


def _check_bend(
    case: Case,
    ledger: Ledger,
    bend: Bend,
    move: Move,
    rails: tuple[Rail, Rail],
    at: complex,
    unsure: float,
) -> None:
    """What a corner is by its definition, in the claimed numbers alone."""
    limit = case.limit + unsure
    if bend.shape is Shape.ROUNDING and move.circle:
        for rail, end, side in zip(rails, (move.start, move.end), ("before", "after"), strict=True):
            slant = dot(heading(rail, end), end - move.circle.center)
            ledger.measure(f"{bend.name} touches the element {side}", bend.words, slant, limit)
    elif bend.shape is Shape.SETBACK:
        for end, side in ((move.start, "before"), (move.end, "after")):
            far = abs(end - at) - bend.size
            ledger.measure(f"{bend.name} is set back by its size on the element {side}", bend.words, far, limit)
    elif bend.shape is Shape.BEVEL:
        run = move.end - move.start
        extent = max(abs(abs(run.real) - bend.size), abs(abs(run.imag) - bend.size))
        ledger.measure(f"{bend.name} is a 45 degree bevel", bend.words, extent, limit)


def draw(course: Course, pieces: Sequence[Piece], points: Mapping[str, complex]) -> Drawing:
    """The course as a drawing, cut into these pieces."""
    shapes: dict[str, Drawn] = {}
    sizes = {bend.name: bend.size for bend in course.bends.values()}
    cut = {piece.name: piece for piece in pieces}
    for number, (name, rail) in enumerate(zip(course.names, course.rails, strict=True)):
        begin, end = course.joints[number : number + 2]
        piece = cut.get(name)
        own = (piece.begin, piece.end) if piece else (begin, end)
        if isinstance(rail, Ring):
            shapes[name] = Round(*own, rail.center, rail.radius, rail.turn)
        else:
            shapes[name] = Straight(begin, end, *own, rail.along or unit(end - begin))
    for piece in pieces:
        if piece.name not in shapes:
            shapes[piece.name] = (
                Round(piece.begin, piece.end, *piece.arc)
                if piece.arc
                else Bevel(piece.begin, piece.end, sizes.get(piece.name, 0.0))
            )
    return Drawing(points, shapes, course.names)
