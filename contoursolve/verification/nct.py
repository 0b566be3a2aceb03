"""NCT chapter 16: a contour of any number of blocks against its words, and which of two intersections is meant."""

from functools import partial

from contoursolve.reading import Claim
from contoursolve.verification import nct_stated
from contoursolve.verification.case import Case
from contoursolve.verification.chain import Words, check_course, check_points, draw
from contoursolve.verification.claimed import ClaimedStatus, Rules
from contoursolve.verification.course import Course, trace
from contoursolve.verification.drawing import Drawing, UnmeasurableError
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.nct_words import (
    choosing_pairs,
    circle_side,
    course_of,
    elements_of,
    is_plain,
    own_point,
)
from contoursolve.verification.rails import Ring, UnmakeableError

LINES = {-1: "nearer", 1: "farther"}
"""What the sides of an intersection with a line are called."""


def check(case: Case, ledger: Ledger) -> None:
    """Everything that the words of the blocks say about the path."""
    if not check_points(case, ledger, case.claim.form.intersections):
        ledger.omit("the words of the blocks", "they are about points that the result does not have")
        return
    _check_signs(case, ledger)
    if not is_plain(case):
        nct_stated.check(case, ledger, words_of(case.claim), partial(_check_stated_sides, case))
        return
    is_over = case.claimed.status is ClaimedStatus.OVERDETERMINED
    ledger.require("as many words as the status says", (), not is_over, "none of them is one too many")
    words = words_of(case.claim)
    try:
        course = course_of(case, case.choices, None if needs_sign(case) else case.points)
    except UnmakeableError as error:
        everything = [word for each in words.values() for word in each]
        ledger.require("the words make a path", everything, False, str(error))
        return
    check_course(case, ledger, course, case.claim.form.intersections, words)
    _check_double(case, ledger, course)
    check_branches(case, ledger, course)


def _check_stated_sides(case: Case, wanted: dict[str, set[str | None]], ledger: Ledger) -> None:
    if not case.is_listed:
        check_sides(case, ledger, wanted)


def words_of(claim: Claim) -> Words:
    """The words of each block by the name of its element."""
    return {
        each.name: tuple(word.text for name, word in claim.words.items() if name.startswith(f"{each.number}:"))
        for each in elements_of(claim)
    }


def needs_sign(case: Case) -> bool:
    """Whether Q must choose: where the rules are not enforced, the other crossing may be none of a path."""
    return case.rules not in (Rules.WARN, Rules.OFF)


def _check_signs(case: Case, ledger: Ledger) -> None:
    """Q has a sign where it must choose."""
    if case.is_extended or case.is_listed or not needs_sign(case):
        return
    for before, each in choosing_pairs(case.claim):
        has_sign = bool(case.choices.get(each.given("Q")))
        words = case.texts(each.given("Q"))
        ledger.require(f"Q chooses where {before.name} and {each.name} meet", words, has_sign, "Q is zero or missing")


def _check_double(case: Case, ledger: Ledger, course: Course) -> None:
    is_double = case.claimed.certificate.double
    if is_double is None or case.is_listed or None in course.touching.values():
        return
    remark = "it says so" if is_double else "it does not say so"
    fits = is_double == any(course.touching.values())
    ledger.require("the certificate says double where two elements touch, and only there", (), fits, remark)


def check_branches(case: Case, ledger: Ledger, course: Course) -> None:
    """The branch of every intersection is the one that Q chooses; where elements just touch there is none."""
    if case.is_listed:
        return
    wanted: dict[str, set[str | None]] = {}
    for before, each in choosing_pairs(case.claim):
        sign = case.choices.get(each.given("Q"), 0)
        touches = course.touching.get(each.number - 1, False)
        side: str | None = None
        if sign and touches is not True:
            side = LINES[sign]
            first, second = course.joints[before.number - 1], course.rails[each.number - 1]
            if before.turn is not None and isinstance(second, Ring):
                _, side = circle_side(case, sign, first, second.center, second.radius)
        wanted[each.tail] = {side, None} if touches is None else {side}
    check_sides(case, ledger, wanted)


def check_sides(case: Case, ledger: Ledger, wanted: dict[str, set[str | None]]) -> None:
    """The claimed branches are among those that are possible, by the point."""
    branches, branch = case.claimed.branches, case.claimed.branch
    if branches is None:
        branches = dict(zip(wanted, (branch or "").split(", "), strict=False)) if branch else {}
    words = [word for _, each in choosing_pairs(case.claim) for word in case.texts(each.given("Q"))]
    fits = all(branches.get(name) in sides for name, sides in wanted.items()) and branches.keys() <= wanted.keys()
    ledger.require("the branch is the one that Q chooses", words, fits, f"the result has {branch!a}"[:60])
    told = ", ".join(branches.values()) or None
    ledger.require("the branches are named in their order", words, told == branch, f"the result has {branch!a}"[:60])


def redo(case: Case) -> Drawing | None:
    """The contour of the words alone, as their signs choose; None if they do not fix it."""
    if not is_plain(case):
        return None
    try:
        course = course_of(case, case.choices)
        return draw(course, trace(course).pieces, points_of(case, course))
    except UnmakeableError as error:
        raise UnmeasurableError(str(error)) from None


def points_of(case: Case, course: Course) -> dict[str, complex]:
    """The points of the contour by name, for facts."""
    points = {"S": 0j}
    for each, rail, tail, head in zip(
        elements_of(case.claim), course.rails, course.joints, course.joints[1:], strict=False
    ):
        points[each.head] = head
        point = own_point(case, each, tail)
        if point is not None:
            points[each.own] = point
        if each.center:
            points[each.center] = getattr(rail, "center", 0j)
    return points
