"""NCT 16.3.3 by its sheet: an arc and an over-defined line, and which of their two intersections is meant.

Points count from the start point: real is the plane's first axis, imaginary its second.
"""

from dataclasses import dataclass
from math import inf, sqrt

from contoursolve.model import FIRST, SECOND
from contoursolve.tolerance import AGREEMENT, RADIUS_DIFFERENCE
from contoursolve.verification import circle_line_stated
from contoursolve.verification.case import Case, Circle, turn_of
from contoursolve.verification.circle_line_stated import ANGLE, CENTER, CHOICE, END, POINT
from contoursolve.verification.claimed import ClaimedStatus, Rules
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import ROUNDING, cross, direction, dot

READ = frozenset((*CENTER, *POINT, *END, ANGLE, CHOICE, "1:R", "1:point"))


@dataclass(frozen=True, slots=True)
class Crossings:
    """Where the line meets the circle, worked out here.

    `foot` is the point of the line that is closest to the centre, `half` (mm) how far each intersection is
    from it, `unsure` (mm) what rounding does to `half`. `touches` is None where rounding hides whether
    the line touches or cuts.
    """

    foot: complex
    half: float
    unsure: float
    touches: bool | None


CHOOSING = ("1:R", CHOICE)
"""The words whose sign chooses between two solutions."""


def check(case: Case, ledger: Ledger) -> None:
    """Everything that the words of the two blocks say about the path."""
    if case.is_extended:
        circle_line_stated.check(case, ledger)
        return
    names = ", ".join(sorted(map(ascii, case.points))) or "none"
    found = ", ".join("arc" if move.circle else "line" for move in case.moves) or "nothing"
    # A line of no length is left out; an arc cannot be.
    shapes = [move.circle is not None for move in case.moves]
    known = ledger.require("the point is P1", (), case.points.keys() == {"P1"}, names)
    made = ledger.require("the elements are an arc and a line", (), shapes in ([True, False], [True]), found)
    missing = [name for name in (*END, ANGLE) if not case.states(name)]
    missing += [] if case.states(CHOICE) or case.is_listed or not needs_sign(case) else [CHOICE]
    stated = ledger.require("the line has its words", (), not missing, f"{len(missing)} missing")
    circle = case.moves[0].circle if case.moves else None
    if not (known and made and stated and circle):
        ledger.omit("the words of the blocks", "they are about an arc, a line and P1")
        return
    _check_circle(case, ledger, circle)
    _check_line(case, ledger)
    _check_crossing(case, ledger, circle)


def _check_circle(case: Case, ledger: Ledger, circle: Circle) -> None:
    """Centre, radius and turn of the arc; a point of the circle that is given lies on it."""
    words = case.texts(*CENTER, "1:R", *POINT)
    has_center, has_radius = bool(case.states(*CENTER)), bool(case.states("1:R"))
    if not ledger.require("the words give the circle", words, has_center or has_radius, "neither centre nor radius"):
        return
    is_over = case.claimed.status is ClaimedStatus.OVERDETERMINED
    both = has_center and has_radius
    ledger.require("as many words as the status says", words, both or not is_over, "none of them is one too many")
    turn = turn_of(case)
    ledger.require("the arc turns as its G code says", (), circle.turn is turn, circle.turn.value)
    if has_center:
        stated = complex(*(case.amount(name) if case.states(name) else 0.0 for name in CENTER))
        case.compare(
            ledger, "the centre is where the words put it", case.texts(*CENTER), abs(circle.center - stated), 0
        )
    if has_radius:
        limit = AGREEMENT if both else case.limit
        ledger.measure("the radius is the one given", case.texts("1:R"), circle.radius - case.amount("1:R"), limit)
    point = given_point(case)
    if point is None:
        ledger.require("a radius comes with a point", words, has_center, "R alone")
    elif has_center:
        # Alarm 3011: what differs less than a machine parameter is accepted, and the start counts.
        off = abs(point - circle.center) - circle.radius
        ledger.measure("the given point lies on the circle", case.texts(*POINT), off, RADIUS_DIFFERENCE)
    else:
        _check_center_by_radius(case, ledger, circle, point)


def given_point(case: Case) -> complex | None:
    """The point of the circle that the arc's block gives, if any."""
    found = []
    for axis, absolute, step in ((FIRST, *POINT[:2]), (SECOND, *POINT[2:])):
        if case.states(absolute):
            found.append(case.coordinate(absolute, axis))
        elif case.states(step):
            found.append(case.amount(step))
    return complex(*found) if len(found) == 2 else None  # noqa: PLR2004 - a plane has two axes


def _check_center_by_radius(case: Case, ledger: Ledger, circle: Circle, point: complex) -> None:
    """R > 0 makes the arc from the start to the point shorter than half a turn, R < 0 longer (printed)."""
    words, radius = case.texts("1:R", *POINT), case.amount("1:R")
    chord = abs(point)
    name = "the circle passes through start and point"
    if not ledger.require(name, words, 0 < chord <= 2 * radius + case.limit, f"{chord:g} mm apart"):
        return
    rise, unsure = leg(radius, chord / 2, ROUNDING * (radius + chord) + case.start_error)
    left = (case.choices.get("1:R", -1) > 0) == (circle.turn.sign > 0)
    center = point / 2 + rise * point / chord * (1j if left else -1j)
    if rise <= unsure:
        # About the middle of the chord: which side it is on cannot be told, and does not matter.
        center, unsure = point / 2, rise + unsure
    case.compare(ledger, "the centre is where the words put it", words, abs(circle.center - center), unsure)


def leg(hypotenuse: float, leg: float, unsure: float) -> tuple[float, float]:
    """The other leg of a right-angled triangle, mm, and what an error of the first two does to it."""
    rest = (hypotenuse - leg) * (hypotenuse + leg)
    found = sqrt(max(0.0, rest))
    double = sqrt(2 * hypotenuse * unsure)
    return found, min(hypotenuse * unsure / found if found else inf, double)


def _check_line(case: Case, ledger: Ledger) -> None:
    """The line begins at P1 and ends at the point given, in the direction of ,A."""
    crossing, end = case.points["P1"], complex(*(case.coordinate(name, axis) for axis, name in enumerate(END)))
    ledger.measure("the arc ends at P1", (), abs(case.moves[0].end - crossing), case.limit)
    ledger.measure("the line ends where its words say", case.texts(*END), abs(case.moves[-1].end - end), case.limit)
    along, words = direction(case.value(ANGLE)), case.texts(ANGLE, *END)
    ledger.measure("P1 lies on the line", words, cross(along, end - crossing), case.limit)
    against = max(0.0, -dot(along, end - crossing))
    ledger.measure("the line does not run against its angle", words, against, case.limit)


def _check_crossing(case: Case, ledger: Ledger, circle: Circle) -> None:
    """P1 is the nearer of the two intersections for Q < 0, the farther for Q > 0, along ,A (printed)."""
    crossing, branch = case.points["P1"], case.claimed.branch
    ledger.measure("P1 lies on the circle", (), abs(crossing - circle.center) - circle.radius, case.limit)
    words, choice = case.texts(CHOICE), case.choices.get(CHOICE, 0)
    meeting = crossings(case, circle)
    if not ledger.require("the line meets the circle", case.texts(ANGLE, *END), meeting is not None) or not meeting:
        return
    # A line that touches leaves nothing to choose to a solution that is listed.
    is_chosen = bool(choice) or not needs_sign(case) or (case.is_listed and meeting.touches is True)
    if not ledger.require("Q has a sign", words, is_chosen, "Q is zero or missing"):
        return
    if not choice:
        _check_unchosen(case, ledger, meeting)
        return
    meant = "nearer" if choice < 0 else "farther"
    if case.is_listed:
        branch = None if meeting.touches else meant
    allowed = {True: (None,), False: (meant,), None: (None, meant)}[meeting.touches]
    ledger.require("the branch is the one that Q chooses", words, branch in allowed, f"{branch!a}"[:60])
    is_double = case.claimed.certificate.double
    if is_double is not None and not case.is_listed:
        remark = "it says so" if is_double else "it does not say so"
        fits = meeting.touches is None or meeting.touches == is_double
        ledger.require("the certificate says double where the line touches, and only there", (), fits, remark)
    # Without a branch the line touches, and the one intersection is the foot of the perpendicular.
    along = direction(case.value(ANGLE))
    sense, unsure = {None: (0, 0.0), "nearer": (-1, meeting.unsure)}.get(branch, (1, meeting.unsure))
    expected = meeting.foot + sense * meeting.half * along
    case.compare(ledger, "P1 is the intersection that Q chooses", words, abs(crossing - expected), unsure)
    if not meeting.touches and branch is not None:
        other = meeting.foot - sense * meeting.half * along
        ahead = dot(along, crossing - other) * sense
        ledger.measure("the other intersection is on the other side", words, max(0.0, -ahead), case.limit)


def needs_sign(case: Case) -> bool:
    """Whether Q must choose: where the rules are not enforced, the other crossing may be none of a path."""
    return case.rules not in (Rules.WARN, Rules.OFF)


def _check_unchosen(case: Case, ledger: Ledger, meeting: Crossings) -> None:
    """Without Q, P1 is either of the intersections; that there is no other path is looked at apart."""
    along, crossing = direction(case.value(ANGLE)), case.points["P1"]
    ledger.require("no branch is chosen without Q", (), case.claimed.branch is None, f"{case.claimed.branch!a}"[:60])
    gaps = [abs(crossing - meeting.foot - sense * meeting.half * along) for sense in (1, -1)]
    case.compare(ledger, "P1 is an intersection", case.texts(ANGLE, *END), min(gaps), meeting.unsure)


def crossings(case: Case, circle: Circle) -> Crossings | None:
    """The two intersections, counted from the line's end; None where the line misses the circle."""
    along = direction(case.value(ANGLE))
    end = complex(*(case.coordinate(name, axis) for axis, name in enumerate(END)))
    distance = cross(along, end - circle.center)
    foot = end - dot(along, end - circle.center) * along
    scale = circle.radius + sum(abs(each.real) + abs(each.imag) for each in (circle.center, end))
    band, gap = ROUNDING * scale, circle.radius - abs(distance)
    # Half and twice the band within which the solver takes the line as touching.
    touches: bool | None = None
    if abs(gap) <= band / 2 - case.start_error:
        touches = True
    elif abs(gap) > 2 * band + case.start_error:
        touches = False
        if gap < 0:
            return None
    half, unsure = leg(circle.radius, abs(distance), band + case.start_error)
    return Crossings(foot, half, unsure, touches)
