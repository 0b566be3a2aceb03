"""Every solution that a result lists: each is a path of its own, no two are the same, and one may be the contour."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import combinations, product
from math import inf

from contoursolve import syntax
from contoursolve.statements import GrammarError, PointIs, Vocabulary, read_statement
from contoursolve.tolerance import RESIDUAL
from contoursolve.verification.claimed import (
    ClaimedContour,
    ClaimedPath,
    ClaimedSolution,
    ClaimedStatus,
)
from contoursolve.verification.examination import examine
from contoursolve.verification.forms import CHECKERS
from contoursolve.verification.ledger import Ledger, fewest
from contoursolve.verification.measure import ROUNDING
from contoursolve.verification.walk import Found

SHOWN = 0.5e-3
"""Half of the last decimal of a coordinate that selects a solution, in the program's unit, X as diameter."""


def check_solutions(found: Found, claimed: ClaimedContour, ledger: Ledger) -> bool:
    """The listed solutions, their number, and the one that was chosen; whether a path was among them."""
    listed = claimed.solutions
    if listed is None:
        return False
    _check_count(claimed, listed, ledger)
    _check_chosen(found, claimed, listed, ledger)
    numbered = list(enumerate(listed, 1))
    for number, each in numbered:
        own = f"solution {number}"
        if each.is_path:
            remark = "it claims to be one"
            ledger.require(f"{own} has a path", (), not each.path.is_empty, remark)
        else:
            ledger.require(f"{own} has no path", (), each.path.is_empty, "it claims to be none")
            ledger.require(f"{own} has a reason against it", (), bool(each.reasons), "none is named")
    paths = [(number, each) for number, each in numbered if each.is_path]
    for (one, first), (other, second) in combinations(paths, 2):
        apart = _distance(first.path, second.path) > _limit(first.path)
        ledger.require(f"solutions {one} and {other} are two", (), apart, "they are the same path")
    is_checked = False
    for number, each in paths:
        _check_selects(found, each, [other for _, other in paths if other is not each], number, ledger)
        if each.is_chosen and claimed.has_path:
            continue  # it is the contour, and that is checked
        attempt = fewest(partial(_attempt, found, claimed, each, *reading) for reading in _readings(found, each))
        is_checked |= bool(attempt.checks)
        for check in attempt.checks:
            ledger.checks.append(replace(check, name=f"solution {number}: {check.name}"))
        ledger.omissions += [each for each in attempt.omissions if each not in ledger.omissions]
    return is_checked


def _check_count(claimed: ClaimedContour, listed: tuple[ClaimedSolution, ...], ledger: Ledger) -> None:
    """The numbers of solutions and of paths are those of the list."""
    count = claimed.count
    if count is None:
        ledger.require("a list of solutions comes with their number", (), not listed, "the number is missing")
        return
    paths = sum(each.is_path for each in listed)
    remark = f"{count.solutions} claimed, {len(listed)} listed"
    ledger.require("all solutions are listed", (), count.solutions == len(listed), remark)
    ledger.require("all paths are listed", (), count.contours == paths, f"{count.contours} claimed, {paths} listed")
    ledger.require(
        "the list is complete unless there is a doubt", (), count.is_complete != bool(count.doubts), "it is both"
    )
    ledger.omit("whether these are all solutions", "their number was not worked out")


def _check_chosen(found: Found, claimed: ClaimedContour, listed: tuple[ClaimedSolution, ...], ledger: Ledger) -> None:
    """The contour is one of the solutions, and no other is chosen; if nothing chooses there are several."""
    chosen = [each for each in listed if each.is_chosen]
    if not claimed.has_path:
        status = claimed.status.value
        ledger.require("no solution is chosen", (), not chosen, f"{status}, with {len(chosen)} chosen")
        if claimed.status is ClaimedStatus.AMBIGUOUS:
            paths = sum(each.is_path for each in listed)
            ledger.require("several solutions are paths", (), paths > 1, f"{paths} of them")
        return
    if ledger.require("one solution is chosen", (), len(chosen) == 1, f"{len(chosen)} are"):
        off = _distance(chosen[0].path, claimed.path)
        ledger.measure("the solution that is chosen is the contour", (), off, _limit(claimed.path))
    words = [word.text for word in found.claim.words.values()]
    parts = claimed.count.chosen_by.split(" and ") if claimed.count and claimed.count.chosen_by else []
    is_known = all(part in words for part in parts)
    ledger.require("what chooses is a word of the program", parts, is_known, "the program does not have it")


def _limit(path: ClaimedPath) -> float:
    return RESIDUAL + ROUNDING * max((abs(value) for at in path.points.values() for value in at), default=0.0)


def _distance(one: ClaimedPath, other: ClaimedPath) -> float:
    """The largest difference of two numbers of two paths, mm; infinite where they are made of other elements."""
    kinds = [[each.arc.turn if each.arc else None for each in path.elements] for path in (one, other)]
    if kinds[0] != kinds[1] or one.points.keys() != other.points.keys():
        return inf
    pairs = zip(_numbers(one), _numbers(other), strict=True)
    return max((abs(first - second) for first, second in pairs), default=0.0)


def _numbers(path: ClaimedPath) -> list[float]:
    found = [inf, inf] if path.end is None else list(path.end)
    found = [value if value < inf else 0.0 for value in found]
    for name in sorted(path.points):
        found += path.points[name]
    for each in path.elements:
        found += [*each.start, *each.end, *((*each.arc.center, each.arc.radius) if each.arc else ())]
    return found


Signs = Mapping[str, int]


def _readings(found: Found, solution: ClaimedSolution) -> Iterator[tuple[ClaimedStatus, Signs]]:
    """As what a solution may be meant: with words that only agree or without them, and by which signs.

    A word that does not tell the solutions apart is not named by what selects them.
    """
    checker = CHECKERS.get(found.claim.form.name)
    named = _signs(found, solution)
    names = checker.choosing if checker else ()
    signs = [((named[name],) if name in named else (1, -1)) for name in names]
    for status in (ClaimedStatus.SOLVED, ClaimedStatus.OVERDETERMINED):
        for combination in product(*signs):
            yield status, dict(zip(names, combination, strict=True))


def _signs(found: Found, solution: ClaimedSolution) -> dict[str, int]:
    """The signs of the words that select a solution, by the names of their givens."""
    signs = {}
    for text in solution.selects:
        for word in syntax.parse_block(text, 1).words:
            for name, (address, _) in found.claim.vocabulary.items():
                if address == word.address and word.number:
                    signs[name] = 1 if word.number > 0 else -1
    return signs


def _attempt(
    found: Found, claimed: ClaimedContour, solution: ClaimedSolution, status: ClaimedStatus, signs: Signs
) -> Ledger:
    ledger = Ledger()
    alone = replace(
        claimed,
        status=status,
        path=solution.path,
        branch=None,
        certificate=solution.certificate,
        asked=None,
        filled=None,
        solutions=None,
        count=None,
    )
    examine(found, alone, ledger, signs)
    return ledger


def _check_selects(
    found: Found, solution: ClaimedSolution, others: list[ClaimedSolution], number: int, ledger: Ledger
) -> None:
    """A fact that selects a solution is true of it, and of no other one."""
    checker, plane, unit = CHECKERS.get(found.claim.form.name), found.claim.after.plane, found.claim.after.unit
    if checker is None:
        return
    for text in solution.selects:
        for directive in syntax.parse_block(text, 1).directives:
            name = f"solution {number}: what selects it is true"
            try:
                fact = read_statement(directive.text, Vocabulary((), checker.points, plane, unit))
            except GrammarError as error:
                ledger.require(name, [text], False, str(error))
                continue
            if isinstance(fact, PointIs) and fact.value is not None and fact.of in solution.path.points:
                limit = SHOWN * float(unit.in_mm) / (2 if plane.diameters[fact.axis] else 1) + RESIDUAL
                off = solution.path.points[fact.of][fact.axis] - float(fact.value)
                ledger.measure(name, [text], off, limit)
                apart = [abs(each.path.points[fact.of][fact.axis] - float(fact.value)) for each in others]
                name = f"solution {number}: what selects it is true of no other"
                ledger.require(name, [text], all(each > limit for each in apart), "it is true of another, too")
            else:
                ledger.omit(text, "what selects a solution is about a point that the result does not list")
