"""YASNAC LX3 G112 (p. 144-146), G11, G12 and G01 with I or K (p. 31-32) by their sheets.

Points count from the start point: real is Z, imaginary is X as radius.
"""

from math import sqrt

from contoursolve.model import FIRST, SECOND, Turn
from contoursolve.reading import Claim
from contoursolve.verification.case import Case
from contoursolve.verification.chain import check_course, check_points, draw
from contoursolve.verification.claimed import ClaimedDiagnosis, ClaimedStatus, Rules
from contoursolve.verification.course import Bend, Course, Shape, trace
from contoursolve.verification.drawing import Drawing, UnmeasurableError
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import cross, sign, unit
from contoursolve.verification.rails import FARTHER, NEARER, Ray, Ring, UnmakeableError, meet
from contoursolve.verification.standing import Candidate, Leg, Standing, path_of

ENDS = (("Z", "W"), ("X", "U"))
"""What states a coordinate, absolute and as an increment, by axis."""
CENTERS = ("K", "I")
"""What places the centre, by axis; of G11, what tells how far a corner leaves along it."""
CORNERS = (("C", "P"), ("D", "Q"))
"""The bevel and the rounding of each corner."""
READ = frozenset((*ENDS[FIRST], *ENDS[SECOND], *CENTERS, "R", "C", "P", "D", "Q"))
_AXES = (1 + 0j, 1j)


def check(case: Case, ledger: Ledger) -> None:
    """Everything that the words of the block say about the path."""
    names = case.claim.form.intersections
    if not check_points(case, ledger, names):
        ledger.omit("the words of the block", "they are about points that the result does not have")
        return
    is_alone = case.claimed.branch is None and not case.claimed.branches
    ledger.require("there is no choice of branch", (), is_alone)
    words = tuple(word.text for word in case.claim.words.values())
    is_over = case.claimed.status is ClaimedStatus.OVERDETERMINED
    fits = _is_plain(case) and not is_over
    if not ledger.require("as many words as the form needs", words, fits, "they are too few or too many"):
        return
    try:
        course = course_of(case)
    except UnmakeableError as error:
        ledger.require("the words make a path", words, False, str(error))
        return
    check_course(case, ledger, course, names, dict.fromkeys(course.names, words))
    is_double = case.claimed.certificate.double
    if is_double is not None and None not in course.touching.values():
        remark = "it says so" if is_double else "it does not say so"
        fits = is_double == any(course.touching.values())
        ledger.require("the certificate says double where two elements touch, and only there", (), fits, remark)


def _axis_of(claim: Claim) -> int:
    """The axis of line 1: G112 runs along Z where its end is an X, G11 along the axis whose end it has."""
    ends = [bool(claim.words.keys() & set(names)) for names in ENDS]
    if claim.form.name == "G112":
        return SECOND if ends[FIRST] and not ends[SECOND] else FIRST
    return FIRST if ends[FIRST] else SECOND


def _is_plain(case: Case) -> bool:
    """Whether the block has just the words that it needs."""
    ends = [len(case.states(*names)) for names in ENDS]
    bends = [len(case.states(*names)) for names in CORNERS]
    if case.claim.form.name == "G112":
        return sum(ends) == 1 and len(case.states(*CENTERS, "R")) == len((*CENTERS, "R")) and max(bends) <= 1
    return sum(ends) == 1 and case.states(*CENTERS) == (CENTERS[1 - _axis_of(case.claim)],)


def course_of(case: Case) -> Course:
    """The course that the words state. Raises UnmakeableError where there is none."""
    return _arc_course(case) if case.claim.form.name == "G112" else _leaving_course(case)


def _stated(case: Case, axis: int) -> float:
    """Where a block ends along an axis, mm."""
    absolute, step = ENDS[axis]
    return case.coordinate(absolute, axis) if case.states(absolute) else case.amount(step)


def _leaving_course(case: Case) -> Course:
    """To the programmed point, which the corner then leaves along the other axis for as far as I or K."""
    axis, unsure = _axis_of(case.claim), case.start_error
    corner, away = _stated(case, axis) * _AXES[axis], case.amount(CENTERS[1 - axis])
    shape = Shape.ROUNDING if case.claim.form.name == "G12" else Shape.BEVEL
    landing = Ray(corner, sign(away) * _AXES[1 - axis])
    bends = {0: Bend("corner 1", shape, abs(away), case.texts(CENTERS[1 - axis]))} if away else {}
    return Course(
        ("line 1",), (Ray(0j, unit(corner)),), (0j, corner), bends, (landing, corner) if away else None, (0.0, unsure)
    )


def _arc_course(case: Case) -> Course:
    """Line 1 towards the centre, the arc from where they first meet, to beyond the centre on the landing line."""
    axis, unsure = _axis_of(case.claim), case.start_error
    center, radius = complex(case.amount("K"), case.amount("I")), case.amount("R")
    way = sign((center.real, center.imag)[axis]) * _AXES[axis]
    if not way or radius <= 0:
        raise UnmakeableError("the centre is neither ahead nor behind, or there is no radius")
    place = _stated(case, 1 - axis) * _AXES[1 - axis]
    _check_way(case, cross(way, center), cross(way, center - place))
    line, landing = Ray(0j, way, case.start_error), Ray(place, way, unsure)
    # The arc passes its centre on the side of line 1, or on that of the landing line where line 1 leads to the centre.
    side = sign(cross(way, center)) or sign(cross(way, center - place))
    ring = Ring(center, radius, Turn.CCW if side > 0 else Turn.CW, case.start_error)
    first, last = meet(line, ring, unsure), meet(ring, landing, unsure)
    bends = {
        number: Bend(f"corner {number + 1}", *_shape(case, name), case.texts(name))
        for number, names in enumerate(CORNERS)
        for name in names
        if case.states(name) and case.value(name)
    }
    if any(bend.size < 0 for bend in bends.values()):
        raise UnmakeableError("a corner is negative")
    return Course(
        ("line 1", "arc"),
        (line, ring),
        (0j, first.places[NEARER], last.places[FARTHER]),
        bends,
        (landing, place) if 1 in bends else None,
        (0.0, first.unsure, last.unsure),
        {1: first.touches, 2: last.touches},
    )


def _check_way(case: Case, first: float, last: float) -> None:
    """The path does not back up (derived): both lines are on one side of the centre."""
    if is_strict(case) and (first * last < 0 or not (first or last)):
        raise UnmakeableError("line 1 and the landing line lie on opposite sides of the centre, or both lead to it")


def is_strict(case: Case) -> bool:
    """Whether the rules of the manual apply."""
    return case.rules not in (Rules.WARN, Rules.OFF)


def why_not(case: Case) -> str:
    """Why a contour is not checked; empty if it is."""
    form = case.claim.form.name
    if case.is_extended:
        return f"further facts and values that are asked for are not checked with {form}"
    if not _is_plain(case) and not is_strict(case):
        return f"too many words of {form} are not checked: its rules refuse them"
    return ""


def _shape(case: Case, name: str) -> tuple[Shape, float]:
    """A rounding, or a bevel as the setting has it, and its size, mm."""
    amount = case.amount(name)
    if name in ("P", "Q"):
        return Shape.ROUNDING, amount
    values = {each.setting.name: each.value for each in case.claim.conventions}
    if values.get("bevel") == "setback":
        return Shape.SETBACK, amount
    return Shape.BEVEL, amount * sqrt(0.5) if values.get("bevel") == "length" else amount


def redo(case: Case) -> Drawing | None:
    """The contour of the words alone; None if they do not fix it."""
    if not _is_plain(case):
        return None
    try:
        course = course_of(case)
        points = dict(zip(case.claim.form.intersections, course.joints[1:], strict=False))
        return draw(course, trace(course).pieces, {"S": 0j, **points})
    except UnmakeableError as error:
        raise UnmeasurableError(str(error)) from None


def stand(case: Case) -> Standing | None:
    """None where words say more than they need to, or rounding hides whether something touches."""
    ends = [bool(case.states(*names)) for names in ENDS]
    is_arc, axis = case.claim.form.name == "G112", _axis_of(case.claim)
    needed = (*CENTERS, "R") if is_arc else (CENTERS[1 - axis],)
    if not any(ends) or len(case.states(*needed)) < len(needed):
        return Standing(is_loose=True)
    if is_arc and any(len([name for name in names if case.states(name) and case.value(name)]) > 1 for names in CORNERS):
        return Standing(disagrees="two corners in one place", is_twice=True)
    if not _is_plain(case):
        return None
    if is_arc and not case.value(CENTERS[axis]):
        return Standing(is_loose=not is_strict(case))
    try:
        course = course_of(case)
    except UnmakeableError:
        return Standing()
    if None in course.touching.values():
        return None
    try:
        traced = trace(course)
    except UnmakeableError:
        return Standing(candidates=(Candidate(None),))
    points = dict(zip(case.claim.form.intersections, course.joints[1:], strict=False))
    legs = [Leg(piece.end, piece.arc) for piece in traced.pieces]
    return Standing(candidates=(Candidate(path_of(legs, points, case.origin)),))


def check_ties(_case: Case, diagnosis: ClaimedDiagnosis, ledger: Ledger) -> None:
    """Nothing is worked out of what can still move, nor of what words say the same."""
    if diagnosis.freedoms or diagnosis.ties:
        ledger.omit("the ties and freedoms of the diagnosis", "they are not worked out for this form")
