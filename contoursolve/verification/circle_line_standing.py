"""How an NCT pair of words alone stands: at most two circles through the start, and two crossings on each."""

from collections.abc import Iterator

from contoursolve.tolerance import AGREEMENT, RADIUS_DIFFERENCE
from contoursolve.verification.case import Case, Circle, turn_of
from contoursolve.verification.circle_line import crossings, given_point, leg
from contoursolve.verification.circle_line_stated import ANGLE, CENTER, CHOICE, END, POINT
from contoursolve.verification.claimed import ClaimedDiagnosis
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import ROUNDING, direction
from contoursolve.verification.standing import Candidate, Leg, Standing, path_of

_NEAR = 1e-6
"""1 (share of a limit). A difference so close to its limit is left undecided."""


def stand(case: Case) -> Standing | None:
    """None where rounding hides whether something touches or agrees."""
    turn, point = turn_of(case), given_point(case)
    has_center, has_radius = bool(case.states(*CENTER)), bool(case.states("1:R"))
    if not (has_center or (has_radius and point is not None)):
        return Standing(is_loose=True)
    if not all(case.states(name) for name in (*END, ANGLE)):
        return None
    if not has_center:
        return _crossed(case, list(_circles(case, point or 0j)))
    center = complex(*(case.amount(name) if case.states(name) else 0.0 for name in CENTER))
    radii = [abs(center), *([case.amount("1:R")] if has_radius else [])]
    others = [*radii[1:], *([] if point is None else [abs(point - center)])]
    standings = [_crossed(case, [(Circle(center, radius, turn), {})]) if radius else Standing() for radius in radii]
    off = max((abs(other - radii[0]) for other in others), default=0.0)
    if off <= case.limit or not (radii[0] or has_radius):
        return standings[0]
    # Which of two radii counts for the crossings, and whether words are compared where nothing chooses, is open.
    if CHOICE not in case.choices or (has_radius and not all(each and each.candidates for each in standings)):
        return None
    if off > (1 + _NEAR) * RADIUS_DIFFERENCE:
        return Standing(disagrees=" ".join(case.texts(*CENTER, "1:R", *POINT)), candidates=None)
    return standings[0] if not has_radius and off < (1 - _NEAR) * RADIUS_DIFFERENCE else None


def check_ties(case: Case, diagnosis: ClaimedDiagnosis, ledger: Ledger) -> None:
    """A centre and a point say the same; nothing is worked out of what can still move."""
    ledger.require("nothing is said to move", (), not diagnosis.freedoms, "freedoms of a circle are not worked out")
    point = given_point(case)
    if not diagnosis.ties or case.states("1:R") or point is None:
        return
    center = complex(*(case.amount(name) if case.states(name) else 0.0 for name in CENTER))
    off = abs(abs(point - center) - abs(center)) if center else 0.0
    (tie, *more) = diagnosis.ties
    ledger.require("there is one tie", tie.addresses, not more)
    # The least increment is not worth mentioning; where nothing is solved, nothing is compared.
    if off <= AGREEMENT or (not tie.off_by_mm and not case.claimed.has_path):
        ledger.measure("they disagree by as much", tie.addresses, tie.off_by_mm, 0.0)
    else:
        ledger.measure("they disagree by as much", tie.addresses, tie.off_by_mm - off, case.limit)
    is_right = tie.is_conflict == (tie.off_by_mm > RADIUS_DIFFERENCE)
    ledger.require("they conflict if that is more than the control allows", tie.addresses, is_right)


Found = tuple[Circle, dict[str, int]]
"""A circle, and the signs of the words that choose it."""


def _circles(case: Case, point: complex) -> Iterator[Found]:
    """Both circles of the radius through the start and the point; R's sign chooses (printed)."""
    radius, chord, turn = case.amount("1:R"), abs(point), turn_of(case)
    if not 0 < chord <= 2 * radius:
        return
    rise, unsure = leg(radius, chord / 2, ROUNDING * (radius + chord))
    if rise <= unsure:
        yield Circle(point / 2, radius, turn), {}
        return
    for sign in (1, -1):
        left = (sign > 0) == (turn.sign > 0)
        yield Circle(point / 2 + rise * point / chord * (1j if left else -1j), radius, turn), {"1:R": sign}


def _crossed(case: Case, circles: list[Found]) -> Standing | None:
    found = []
    end, along = complex(*(case.coordinate(name, axis) for axis, name in enumerate(END))), direction(case.value(ANGLE))
    for circle, signs in circles:
        meeting = crossings(case, circle)
        if meeting is None:
            continue
        if meeting.touches is None:
            return None
        for sense in (0,) if meeting.touches else (1, -1):
            crossing = meeting.foot + sense * meeting.half * along
            legs = [Leg(crossing, (circle.center, circle.radius, circle.turn)), Leg(end)]
            chosen = {**signs, **({CHOICE: sense} if sense else {})}
            found.append(Candidate(path_of(legs, {"P1": crossing}, case.origin), chosen))
    return Standing(candidates=tuple(found))
