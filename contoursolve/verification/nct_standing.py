"""How an NCT contour of words alone stands: two places for each meeting with a circle, two circles for R."""

from itertools import product

from contoursolve.tolerance import AGREEMENT
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedDiagnosis
from contoursolve.verification.course import Course, Trace, trace
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.nct_words import (
    CENTERS,
    CORNERS,
    ENDS,
    ROUNDED,
    choosing,
    course_of,
    elements_of,
    is_plain,
    lacks_words,
    own_point,
)
from contoursolve.verification.rails import LooseError, UnmakeableError
from contoursolve.verification.standing import Candidate, Leg, Standing, path_of

_NEAR = 1e-6
"""1 (share of a limit). A difference so close to its limit is left undecided."""

MOST = 7
"""Words that choose. More would make more than 128 contours, which are not all gone through."""


def stand(case: Case) -> Standing | None:
    """None where rounding hides whether something touches or agrees, or where words say more than they need to."""
    if lacks_words(case):
        return Standing(is_loose=True)
    sizes = [[each.given(word) for word in CORNERS] for each in elements_of(case.claim)[:-1]]
    if any(all(case.states(name) and case.value(name) for name in names) for names in sizes):
        return Standing(disagrees="a chamfer and a rounding", is_twice=True)
    if any(case.amount(name) < 0 for names in sizes for name in case.states(*names)):
        return Standing()
    names = choosing(case.claim)
    if not is_plain(case):
        return None
    names = tuple(name for name in names if name.endswith("Q") or case.states(name))
    is_all = len(names) <= MOST
    if not is_all and set(names) - case.choices.keys():
        return None
    every = product((1, -1), repeat=len(names)) if is_all else [tuple(case.choices[name] for name in names)]
    found: dict[tuple[tuple[str, int], ...], Course] = {}
    for values in every:
        signs = dict(zip(names, values, strict=True))
        try:
            course = course_of(case, signs)
        except LooseError:
            # With signs that choose, other places of the points may leave nothing loose.
            return None if names else Standing(is_loose=True)
        except UnmakeableError:
            continue
        if None in course.touching.values():
            return None
        key = tuple((name, sign) for name, sign in signs.items() if name not in course.moot)
        found.setdefault(key, course)
    if not found:
        return _nowhere(case)
    is_all = is_all and not any(ROUNDED in course.moot for course in found.values())
    gaps = [max(map(abs, course.gaps.values()), default=0.0) for course in found.values()]
    if any(abs(gap - case.slack) <= _NEAR * case.slack for gap in gaps):
        return None
    if gaps and min(gaps) > case.slack:
        return Standing(disagrees="a point is not on its circle", candidates=None)
    if any(gap > case.slack for gap in gaps):
        return None
    if any(gap > case.limit for gap in gaps) and set(names) - case.choices.keys():
        return None  # whether words are compared where nothing chooses is open
    candidates = tuple(_candidate(case, course, dict(key)) for key, course in found.items())
    return Standing(candidates=candidates, is_all=is_all)


def _nowhere(case: Case) -> Standing | None:
    """Where no contour has its intersections: whether a point is off its circle all the same."""
    is_known = True
    for each in elements_of(case.claim):
        own = [names for names in ENDS for name in names[:1] if case.states(each.given(name))]
        center = [case.amount(each.given(name)) if case.states(each.given(name)) else 0.0 for name in CENTERS]
        if each.turn is None or not (each.is_over or case.states(*map(each.given, CENTERS))):
            continue
        if own and each.number > 1 and not each.is_over:
            is_known = False
            continue
        point = own_point(case, each, 0j)
        at = complex(*center)
        if each.is_over:
            at = complex(*(case.coordinate(each.given(name), axis) for axis, name in enumerate(CENTERS)))
        radius = case.amount(each.given("R")) if each.is_over else abs(at)
        if point is not None and abs(abs(point - at) - radius) > case.slack:
            return Standing(disagrees="a point is not on its circle", candidates=None)
    return Standing() if is_known else None


def _candidate(case: Case, course: Course, signs: dict[str, int]) -> Candidate:
    try:
        traced = trace(course)
    except UnmakeableError:
        return Candidate(None, signs)
    points = dict(zip(case.claim.form.intersections, course.joints[1:], strict=False))
    return Candidate(path_of(legs_of(traced), points, case.origin), signs)


def legs_of(traced: Trace) -> list[Leg]:
    """The elements of a trace."""
    return [Leg(piece.end, piece.arc) for piece in traced.pieces]


def check_ties(case: Case, diagnosis: ClaimedDiagnosis, ledger: Ledger) -> None:
    """A centre, a radius and a point may say the same; nothing is worked out of what can still move."""
    if diagnosis.freedoms:
        ledger.omit("the freedoms of the diagnosis", "they are not worked out for circles and chains")
    if not diagnosis.ties:
        return
    if not is_plain(case):
        ledger.omit("the ties of the diagnosis", "they are worked out only where each word is needed")
        return
    try:
        gaps = [abs(gap) for gap in course_of(case, case.choices).gaps.values()]
    except UnmakeableError as error:
        ledger.omit("the ties of the diagnosis", str(error))
        return
    for tie in diagnosis.ties:
        # The least increment is not worth mentioning; where nothing is solved, nothing is compared.
        known = [gap for gap in gaps if gap > AGREEMENT] + [0.0]
        off = min((tie.off_by_mm - gap for gap in known), key=abs)
        ledger.measure("they disagree by as much as an element does", tie.addresses, off, case.limit)
        is_right = tie.is_conflict == (tie.off_by_mm > case.slack)
        ledger.require("they conflict if that is more than the control allows", tie.addresses, is_right)
