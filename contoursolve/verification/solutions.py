"""Every solution that a result lists: each is a path of its own, no two are the same, and one may be the contour."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import combinations, product
from math import inf

from contoursolve import syntax
from contoursolve.statements import GrammarError, PointIs, Vocabulary, read_statement
from contoursolve.syntax import Word
from contoursolve.tolerance import RESIDUAL
from contoursolve.verification.claimed import (
    ClaimedAsked,
    ClaimedContour,
    ClaimedPath,
    ClaimedSolution,
    ClaimedStatus,
)
from contoursolve.verification.examination import examine, signs_of
from contoursolve.verification.filled import half_increment
from contoursolve.verification.forms import CHECKERS
from contoursolve.verification.ledger import Ledger, fewest
from contoursolve.verification.measure import ROUNDING
from contoursolve.verification.path import check_certificate
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
        if each.is_chosen or not each.is_path:  # the others are looked at as a whole
            certificate = Ledger()
            check_certificate(each.certificate, _limit(each.path), certificate)
            ledger.checks += [replace(check, name=f"{own}: {check.name}") for check in certificate.checks]
        if each.is_path:
            remark = "it claims to be one"
            ledger.require(f"{own} has a path", (), not each.path.is_empty, remark)
        else:
            ledger.require(f"{own} has no path", (), each.path.is_empty, "it claims to be none")
            ledger.require(f"{own} has a reason against it", (), bool(each.reasons), "none is named")
            values = [asked.word for asked in each.asked or () if asked.value is not None]
            ledger.require(f"{own} answers nothing", values, not values, "it has no path")
    paths = [(number, each) for number, each in numbered if each.is_path]
    for (one, first), (other, second) in combinations(paths, 2):
        apart = max(_distance(first.path, second.path), _difference(first.asked, second.asked)) > _limit(first.path)
        ledger.require(f"solutions {one} and {other} are two", (), apart, "they are the same path")
        selects = bool(first.selects and first.selects == second.selects)
        remark = "the same words select both"
        ledger.require(f"solutions {one} and {other} are told apart", first.selects, not selects, remark)
    is_checked, eligible, is_known, is_exact = False, 0, True, False
    for number, each in paths:
        _check_selects(found, each, [other for _, other in paths if other is not each], number, ledger)
        if each.is_chosen and claimed.has_path:
            eligible += 1
            continue  # it is the contour, and that is checked
        readings = list(_readings(found, each))
        name, remark = f"solution {number}: what selects it are words that choose", "the program has no such words"
        if not ledger.require(name, each.selects, bool(readings), remark):
            continue
        attempt = fewest(partial(_attempt, found, claimed, each, *reading) for reading in readings)
        is_examined = all(each.what != "the path" for each in attempt.omissions)
        is_checked |= is_examined and bool(attempt.checks)
        is_known &= is_examined
        for check in attempt.checks:
            ledger.checks.append(replace(check, name=f"solution {number}: {check.name}"))
        ledger.omissions += [each for each in attempt.omissions if each not in ledger.omissions]
        if not attempt.failures and _is_eligible(found, claimed, each):
            eligible += 1
            exact = (
                partial(_attempt, found, claimed, each, *one) for one in readings if one[0] is ClaimedStatus.SOLVED
            )
            is_exact |= not fewest(exact).failures
    if not is_known:
        ledger.omit("which of the solutions is chosen", "not all of them were checked")
    elif claimed.has_path and paths:
        ledger.require("the program chooses one path", (), eligible == 1, f"{eligible} of {len(paths)} agree with it")
    elif claimed.status is ClaimedStatus.AMBIGUOUS:
        remark = f"{eligible} of {len(paths)} agree with it"
        ledger.require("the program does not choose one path", (), eligible > 1, remark)
    elif eligible:
        # Where words that agree say more than they need to, that is said first; what rules reject was checked by them.
        is_over = claimed.status is ClaimedStatus.OVERDETERMINED and not is_exact
        is_right = is_over or (claimed.status is ClaimedStatus.REJECTED and not found.claim.directives)
        remark = f"the result says {claimed.status.value}, and {eligible} of {len(paths)} agree with the program"
        ledger.require("a contour with paths that the program allows is ambiguous", (), is_right, remark)
    return is_checked


def _is_eligible(found: Found, claimed: ClaimedContour, solution: ClaimedSolution) -> bool:
    """Whether a solution, right in all else, agrees with the words of the program that choose, too."""
    checker = CHECKERS.get(found.claim.form.name)
    signs = signs_of(found.claim, checker.choosing(found.claim) if checker else ())
    if not signs:
        return True
    statuses = (ClaimedStatus.SOLVED, ClaimedStatus.OVERDETERMINED)
    attempts = (partial(_attempt, found, claimed, solution, status, signs) for status in statuses)
    return not fewest(attempts).failures


def _check_count(claimed: ClaimedContour, listed: tuple[ClaimedSolution, ...], ledger: Ledger) -> None:
    """The numbers of solutions and of paths are those of the list."""
    count = claimed.count
    if count is None:
        ledger.require("a list of solutions comes with their number", (), not listed, "the number is missing")
        return
    paths = sum(each.is_path for each in listed)
    remark = f"there are said to be {count.solutions}, and {len(listed)} are listed"
    ledger.require("all solutions are listed", (), count.solutions == len(listed), remark)
    ledger.require(
        "all paths are listed",
        (),
        count.contours == paths,
        f"there are said to be {count.contours}, and {paths} are listed",
    )
    ledger.require(
        "the list is complete unless there is a doubt", (), count.is_complete != bool(count.doubts), "it is both"
    )


def _check_chosen(found: Found, claimed: ClaimedContour, listed: tuple[ClaimedSolution, ...], ledger: Ledger) -> None:
    """The contour is one of the solutions, and no other is chosen; if nothing chooses there are several."""
    chosen = [each for each in listed if each.is_chosen]
    if not claimed.has_path:
        status = claimed.status.value
        ledger.require("no solution is chosen", (), not chosen, f"it is {status}, with {len(chosen)} chosen")
        return
    if ledger.require("one solution is chosen", (), len(chosen) == 1, f"{len(chosen)} are"):
        off = _distance(chosen[0].path, claimed.path)
        ledger.measure("the solution that is chosen is the contour", (), off, _limit(claimed.path))
        if claimed.asked is not None and chosen[0].asked is not None:
            off = _difference(claimed.asked, chosen[0].asked)
            ledger.measure("the solution that is chosen answers as the contour", (), off, RESIDUAL)
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


def _difference(one: tuple[ClaimedAsked, ...] | None, other: tuple[ClaimedAsked, ...] | None) -> float:
    """The largest difference of two answers to the same questions, mm or degrees; infinite for other questions."""
    if one is None or other is None:
        return 0.0
    texts = [[(each.word, each.line, each.unit, each.value is None) for each in asked] for asked in (one, other)]
    if texts[0] != texts[1]:
        return inf
    pairs = zip(one, other, strict=True)
    return max((abs((first.value or 0.0) - (second.value or 0.0)) for first, second in pairs), default=0.0)


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
    checker, words = CHECKERS.get(found.claim.form.name), found.claim.words
    choosing = checker.choosing(found.claim) if checker else ()
    for status in (ClaimedStatus.SOLVED, ClaimedStatus.OVERDETERMINED):
        for named in _signs(found, solution, choosing):
            names = [name for name in choosing if name in named or (name in words and words[name].number)]
            signs = [((named[name],) if name in named else (1, -1)) for name in names]
            for combination in product(*signs):
                yield status, dict(zip(names, combination, strict=True))


def _signs(found: Found, solution: ClaimedSolution, choosing: tuple[str, ...]) -> Iterator[Signs]:
    """The signs of the words that select a solution, by the names of their givens: what selects is in the order of
    the blocks."""
    vocabulary, words = found.claim.vocabulary, found.claim.words
    selecting = [
        word
        for text in solution.selects
        for word in syntax.parse_block(text, 1).words
        if word.number and word.address in {vocabulary[name][0] for name in choosing if name in vocabulary}
    ]
    for names in combinations(choosing, len(selecting)):
        pairs = list(zip(names, selecting, strict=True))
        if all(vocabulary[name][0] == word.address and _has_size(words.get(name), word) for name, word in pairs):
            yield {name: 1 if (word.number or 0) > 0 else -1 for name, word in pairs}


def _has_size(stated: Word | None, word: Word) -> bool:
    """Whether a word that selects has the size of the stated one, where its size means something."""
    if word.address != "R" or stated is None or stated.number is None:
        return word.address != "R" or stated is not None
    return abs(stated.number) == abs(word.number or 0)


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
        asked=solution.asked,
        filled=None,
        count=None,
    )
    examine(found, alone, ledger, signs)
    return ledger


def _check_selects(
    found: Found, solution: ClaimedSolution, others: list[ClaimedSolution], number: int, ledger: Ledger
) -> None:
    """A fact that selects a solution is true of it, and of no other one; a word has the value that it answers."""
    checker = CHECKERS.get(found.claim.form.name)
    if checker is None:
        return
    for text in solution.selects:
        block = syntax.parse_block(text, 1)
        for directive in block.directives:
            _check_fact(found, solution, others, directive.text, f"solution {number}: what selects it", ledger)
        for word in block.words:
            _check_word(found, solution, word, f"solution {number}: what selects it", ledger)


def _check_fact(
    found: Found, solution: ClaimedSolution, others: list[ClaimedSolution], text: str, own: str, ledger: Ledger
) -> None:
    plane, unit = found.claim.after.plane, found.claim.after.unit
    points = CHECKERS[found.claim.form.name].points(found.claim)
    try:
        fact = read_statement(text, Vocabulary((), points, plane, unit))
    except GrammarError as error:
        ledger.require(f"{own} is true", [text], False, str(error))
        return
    if not isinstance(fact, PointIs) or fact.value is None or fact.of not in solution.path.points:
        ledger.omit(text, "what selects a solution is about a point that the result does not list")
        return
    value = float(fact.value)
    limit = SHOWN * float(unit.in_mm) / (2 if plane.diameters[fact.axis] else 1) + RESIDUAL
    ledger.measure(f"{own} is true", [text], solution.path.points[fact.of][fact.axis] - value, limit)
    places = [each.path.points[fact.of][fact.axis] for each in others if fact.of in each.path.points]
    is_alone = all(abs(each - value) > limit for each in places)
    ledger.require(f"{own} is true of no other", [text], is_alone, "it is true of another one, too")


def _check_word(found: Found, solution: ClaimedSolution, word: Word, own: str, ledger: Ledger) -> None:
    claim, unit = found.claim, found.claim.after.unit
    stated = [each for block in claim.blocks for each in block.words if each.address == word.address]
    given = claim.lexicon.given(word.address, word, unit) if word.address in claim.lexicon.addresses else None
    if not ledger.require(f"{own} is a word with a value", [word.text], given is not None) or given is None:
        return
    if word.address == "R" and not any(each.is_asked for each in stated):
        is_same = any(each.number is not None and abs(each.number) == abs(word.number or 0) for each in stated)
        ledger.require(f"{own} has a radius of the program", [word.text], is_same, "it has no such R")
    for each in stated:
        answers = [asked for asked in solution.asked or () if (asked.word, asked.line) == (each.text, each.span.line)]
        if answers and answers[0].value is not None:
            value = abs(given.value) if word.address == "R" else given.value
            off, limit = answers[0].value - float(value), half_increment(given, claim.lexicon, unit) + RESIDUAL
            ledger.measure(f"{own} has the value that is asked for", [word.text], off, limit, given.unit.value)
