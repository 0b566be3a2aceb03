"""One contour of a result against its block: its status, its path if it claims one, and all that it lists."""

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import combinations
from math import degrees, hypot

import numpy
from msgspec.structs import replace

from contoursolve import gcode
from contoursolve.gcode import Word
from contoursolve.geometry import Choice, Coordinate, Fact, Heading, apply_statements
from contoursolve.reading import ParsedContour, unused_words
from contoursolve.tolerance import AGREEMENT, RESIDUAL
from contoursolve.verification import rank
from contoursolve.verification.decode import (
    ClaimedContour,
    ClaimedDiagnosis,
    ClaimedFreedom,
    ClaimedPath,
    ClaimedSolution,
    ClaimedTie,
)
from contoursolve.verification.drawing import side_of
from contoursolve.verification.path_checks import (
    check_branches,
    check_certificate,
    check_filled,
    examine,
    half_increment,
    missed,
    told,
)
from contoursolve.verification.receipt import Ledger
from contoursolve.verification.residuals import Array
from contoursolve.verification.status import (
    FEW,
    ROUNDING,
    Candidate,
    Case,
    Found,
    allowance,
    candidates,
    expected,
    is_against,
    prepare,
)

LOOSE = ("underdetermined", "no-solution", "undecided")
"""What a contour may be whose words leave points free at their values alone."""


def check_contour(found: Found, claimed: ClaimedContour) -> tuple[Ledger, bool]:
    """The checks of one contour, and whether a path or its status was among what was checked."""
    ledger = Ledger()
    with numpy.errstate(all="ignore"):
        try:
            return ledger, _check_contour(found, claimed, ledger)
        except numpy.linalg.LinAlgError:
            ledger.omit("the rest of the contour", "its numbers are too far from any solution to be worked with")
            return ledger, False


def _check_contour(found: Found, claimed: ClaimedContour, ledger: Ledger) -> bool:
    _check_place(found.claim, claimed, ledger)
    case, values = prepare(found), None
    paths = [each for each in (claimed, *claimed.solutions) if each.elements]
    solutions = candidates(case, [told(case, each) for each in paths]) if case.has_solutions else []
    # Values may leave open what the words alone do not.
    is_fixed = bool(solutions) and not any(each.is_open for each in solutions)
    if paths and not is_fixed and found.claim.form.is_general:
        case = prepare(found, has_cuts=True)
        solutions = candidates(case, [told(case, each) for each in paths]) if case.has_solutions else []
    for text in (each.text for each in found.claim.directives if each.span.line < -found.apart):
        ledger.omit(f"the fact {text}", "stated in the result only: checked, but not known from the program")
    if claimed.has_path:
        why = case.statuses.get("rejected") or ("" if case.is_readable else case.statuses.get("underdetermined", ""))
        ledger.require("every word and fact can be read", (), case.is_readable, why)
        if case.is_readable and case.profile.start.is_known:
            values = examine(case, claimed, solutions, ledger, is_chosen=True)
        if values is not None:
            check_branches(case, claimed.branches, claimed.branch, values, ledger)
            check_filled(case, claimed, ledger)
    else:
        _check_bare(claimed, ledger)
    listed = [_examine_listed(case, claimed, each, solutions, values, ledger) for each in range(len(claimed.solutions))]
    _check_list(case, claimed, listed, values, ledger)
    if ledger.failures:
        ledger.omit("the status, and whether there are other solutions", "what is claimed is wrong in itself")
        return False
    is_checked = _check_status(case, claimed, solutions, ledger)
    _check_count(case, claimed, solutions, ledger)
    if claimed.diagnosis is not None:
        _check_diagnosis(case, claimed.diagnosis, solutions, values, ledger)
    return is_checked or values is not None


def _check_place(claim: ParsedContour, claimed: ClaimedContour, ledger: Ledger) -> None:
    """Where the contour is, and what its blocks say apart from its geometry."""
    conventions = sorted(f"{each.setting.name}={each.value}" for each in claim.conventions)
    others = sorted(f"{each.setting}={each.value}" for each in claimed.conventions)
    for name, own, its in (
        ("the lines are those of its blocks", [str(each.line) for each in claim.blocks], map(str, claimed.lines)),
        ("the form is that of its blocks", [claim.form.name], [claimed.form]),
        ("the plane is the one in force", claim.after.plane.axes, claimed.plane),
        ("the conventions are those in force", conventions, others),
    ):
        told, has = (" ".join(ascii(each)[1:60].strip("'") for each in texts) or "none" for texts in (own, its))
        ledger.require(name, (), told == has, f"the program has {told}, and the result has {has}")
    for axis, known, value in zip(claim.before.plane.axes, claim.before.start().values, claimed.start, strict=True):
        name = f"{axis} of the start is the program's position"
        if known is not None and value is not None:
            ledger.measure(name, (), value - float(known), RESIDUAL + ROUNDING * abs(float(known)))
            continue
        remark = f"the program is at {known} mm, and the result has none"
        if known is None and value is not None:
            remark = f"the program does not tell it, and the result has {value:g} mm; "
            remark += "if it was solved with --start, verify with the same --start"
        ledger.require(name, (), known is None and value is None, remark)
    texts = list((Counter(each.text for each in claim.directives) - Counter(claimed.facts)).elements())
    ledger.require("the result lists the facts of the program", texts, not texts, "it does not")
    places = [(word.text, word.span.line) for word in claim.words.values() if word.is_asked]
    places += [(each.text, each.span.line) for each in claim.directives]
    for asked in (each for path in (claimed, *claimed.solutions) for each in path.asked):
        is_known = (asked.word, asked.line) in places
        ledger.require("what is answered is asked there", [asked.word], is_known, f"it is not on line {asked.line}")


def _check_bare(claimed: ClaimedContour, ledger: Ledger) -> None:
    """A contour without a path claims nothing else that only a path has."""
    ledger.omit("the path", f"claimed {claimed.status}: there is none to check")
    remark = f"it is {claimed.status}, with a path"
    ledger.require("a contour with this status has no path", (), claimed.is_empty, remark)
    given = (claimed.certificate.radius, claimed.certificate.double, claimed.branch, claimed.branches or None)
    is_bare = all(each is None for each in given)
    ledger.require("without a path nothing is certified or chosen", (), is_bare, "the result does so")
    values = [each.word for each in claimed.asked if each.value is not None]
    ledger.require("without a path no value is known", values, not values, "the result answers what is asked for")
    ledger.require("without a path nothing is filled in", (), claimed.filled is None, "there are filled blocks")


def _check_status(case: Case, claimed: ClaimedContour, solutions: Sequence[Candidate], ledger: Ledger) -> bool:
    """Whether the status could be worked out."""
    status, why = expected(case, solutions)
    if any(each.is_open for each in solutions):
        is_right = claimed.status in LOOSE
        ledger.require("the words leave points free at their values", (), is_right, f"it is {claimed.status}")
        status, why = None, "the words leave points free at their values, and there may be other solutions"
    is_open = claimed.count is not None and not claimed.count.is_complete
    if claimed.status == "undecided" and status in ("solved", "overdetermined") and is_open:
        status, why = None, "a search found one contour, which is no proof that there is no other"
    if status is None:
        ledger.omit("the status", why)
    else:
        remark = f"the result says {claimed.status}, and by the words it is {status}: {why}"
        words = [case.label(word) for word in case.claim.words.values()]
        ledger.require("the status is the one that the words give", words, claimed.status == status, remark)
    if status == "rejected":
        ledger.omit("why it is rejected", "the rules of the manual are read from the same tables")
    elif status == "no-solution" and case.is_determined and not rank.is_linear(case.system):
        ledger.omit("whether there is a solution after all", "a search found none, which is no proof")
    ignored = [*case.profile.words_of(case.profile.ignored), *unused_words(case.claim, case.profile)]
    for word in ignored if case.is_readable else ():
        ledger.omit(word.text, "the control does not use it for this contour")
    return status is not None


# --- The list of solutions -------------------------------------------------------------------------


def _examine_listed(
    case: Case,
    claimed: ClaimedContour,
    number: int,
    found: Sequence[Candidate],
    exact: Array | None,
    ledger: Ledger,
) -> Array | None:
    """One solution of the list; the values of its unknowns, if it is a path. `exact` are those of the contour."""
    solution, own, values = claimed.solutions[number], Ledger(), None
    if exact is not None and solution.is_chosen and solution.is_path and _own(solution) == _own(claimed):
        return exact  # It is the contour, and that is checked.
    if not solution.is_path:
        check_certificate(case, solution.certificate, own)
        own.require("it has no path", (), solution.is_empty, "it claims to be none")
        own.require("it has a reason against it", (), bool(solution.reasons), "none is named")
        answers = [asked.word for asked in solution.asked if asked.value is not None]
        own.require("it answers nothing", answers, not answers, "it has no path")
    elif own.require("it has a path", (), not solution.is_empty, "it claims to be one") and case.is_readable:
        values = examine(case, solution, found, own, is_chosen=solution.is_chosen)
    elif not case.is_readable:
        own.require("every word and fact can be read", (), passed=False, remark="they cannot")
    ledger.add(own, f"solution {number + 1}: ")
    return values


def _own(path: ClaimedPath) -> tuple[object, ...]:
    return path.end, path.points, path.elements, path.certificate, path.asked


def _check_list(
    case: Case, claimed: ClaimedContour, values: Sequence[Array | None], exact: Array | None, ledger: Ledger
) -> None:
    """The list of solutions: their number, which are told apart by what, which one is the contour. `values` are those
    of the unknowns of each, `exact` those of the contour."""
    listed, count = claimed.solutions, claimed.count
    paths = [number for number, each in enumerate(listed) if each.is_path]
    if count is None:
        is_right = not listed and not claimed.has_path
        ledger.require("a list of solutions comes with their number", (), is_right, "the number is missing")
    else:
        for name, said, has in (("solutions", count.solutions, len(listed)), ("paths", count.contours, len(paths))):
            remark = f"there are said to be {said}, and {has} are listed"
            ledger.require(f"all {name} are listed", (), said == has, remark)
        is_told = count.is_complete != bool(count.doubts)
        ledger.require("the list is complete unless there is a doubt", (), is_told, "it is both")
        if count.within_mm is not None and count.is_complete:
            is_all, remark = count.within_mm >= case.profile.travel, f"within {count.within_mm:g} mm of the start point"
            remark = f"it holds all {remark}, and the control's travel is {case.profile.travel:g} mm"
            ledger.require("a list that is complete holds all in the control's travel", (), is_all, remark)
        words = [word.text for word in case.claim.words.values()]
        parts = count.chosen_by.split(" and ") if count.chosen_by else []
        is_known = all(part in words for part in parts)
        ledger.require("what chooses is a word of the program", parts, is_known, "the program does not have it")
    for one, other in combinations(paths, 2):
        name, selects = f"solutions {one + 1} and {other + 1}", listed[one].selects
        ledger.require(f"{name} differ", (), not _are_one(values[one], values[other]), "they are the same path")
        is_told = not selects or selects != listed[other].selects
        ledger.require(f"words tell {name} apart", selects, is_told, "the same words select both")
    for number in paths:
        own = values[number]
        if own is not None:
            _check_selects(case, listed[number], own, [listed[each] for each in paths if each != number], ledger)
    chosen = [number for number, each in enumerate(listed) if each.is_chosen]
    if not claimed.has_path:
        ledger.require("no solution is chosen", (), not chosen, f"it is {claimed.status}, with {len(chosen)} chosen")
    elif count is not None and ledger.require("one solution is chosen", (), len(chosen) == 1, f"{len(chosen)} are"):
        is_it = _are_one(values[chosen[0]], exact)
        ledger.require("the solution that is chosen is the contour", (), is_it, "it is another")


def _are_one(first: Array | None, second: Array | None) -> bool:
    """Whether the words put two paths in the same place; also where that is not known."""
    return first is None or second is None or float(abs(first - second).max(initial=0.0)) <= 10 * RESIDUAL


def _check_count(case: Case, claimed: ClaimedContour, found: Sequence[Candidate], ledger: Ledger) -> None:
    """The list has at least as many solutions as a search finds."""
    count = claimed.count
    if count is None:
        return
    if found and count.is_complete:
        there, makeable = len(found), sum(each.is_path for each in found)
        remark = f"the result has {count.solutions} and can make {count.contours}; a search found at least "
        remark += f"{there} and can make {makeable}"
        is_all = count.solutions >= there and count.contours >= makeable
        words = [word.text for word in case.claim.words.values()]
        ledger.require("the result has all solutions that a search finds", words, is_all, remark)
    ledger.omit("whether these are all solutions", "a search found no others, which is no proof")


SHOWN = 0.5e-3
"""Half of the last decimal of a coordinate that selects a solution, in the program's unit, X as diameter."""


def _check_selects(
    case: Case, solution: ClaimedSolution, values: Array, others: Sequence[ClaimedSolution], ledger: Ledger
) -> None:
    """What selects a solution is true of it: a word that chooses its side, the value that it answers, or a coordinate
    that no other one has."""
    scalars, true, selectors = case.scalars(values), Counter[str](), case.claim.selectors
    for each in selectors:
        side = side_of(case.system, scalars, Choice(each.point, each.side, ""))
        true[each.word] += side is not None and side[0] > 0 and side[1] > case.band / FEW
    for text in solution.selects:
        is_true = true[text] > 0
        if any(each.word == text for each in selectors):
            true[text] -= 1
            ledger.omit("whether the words that select a solution are all that do", "each was checked by itself")
        elif case.claim.form.picking and text.startswith(case.claim.form.picking):
            ledger.omit(text, "the order in which solutions are counted")
            continue
        else:
            is_true = _is_true(case, text, solution, others)
        ledger.require("what selects a solution is true of it", [text], is_true, "it is not")


def _is_true(case: Case, text: str, solution: ClaimedSolution, others: Sequence[ClaimedSolution]) -> bool:
    """Whether words are what a solution answers, or a coordinate is its own alone."""
    block, truths = gcode.parse_block(text, 1, case.claim.blocks[0].syntax), list[bool]()
    for word in block.words:
        answers = [each for each in solution.asked if each.word[: len(word.address)] == word.address]
        truths += [abs(missed(case, each, word)) <= half_increment(case, word) + RESIDUAL for each in answers]
    for directive in block.directives if not truths else ():
        facts, faults = apply_statements(replace(case.profile, is_extended=True), [directive], lambda: None)
        fact = facts.facts[-1] if not faults else None
        if isinstance(fact, Coordinate):
            limit = SHOWN * float(case.claim.after.unit.in_mm) / (1 + case.profile.plane.diameters[fact.axis])
            value = float(facts.givens[fact.given].value)
            for each in (solution, *others):
                # Of a point that the result does not list nothing is known.
                off = abs(each.points[fact.point][fact.axis] - value) if fact.point in each.points else None
                truths.append(off is None or (off <= limit + RESIDUAL) == (each is solution))
    return bool(truths) and all(truths)


# --- The diagnosis ---------------------------------------------------------------------------------

HALF_TURN = 180.0
"""Degrees."""

COMPLETE = "ties are complete where the block can be read and has no further facts"

CLEARLY = 2.0
"""1. Within so many times the allowed amount or one part of so many it is left open whether words agree."""


def _check_diagnosis(
    case: Case, diagnosis: ClaimedDiagnosis, found: Sequence[Candidate], path: Array | None, ledger: Ledger
) -> None:
    """What can still move and which words say the same, where the facts are about lines between points."""
    facts = (*case.profile.facts, *case.profile.ignored)
    system, is_whole = replace(case.system, facts=facts), not case.profile.is_extended
    is_known = case.profile.start.is_known and not any(block.faults for block in case.claim.blocks)
    if not is_known or not rank.is_linear(system):
        is_right = diagnosis.ties_complete == (is_known and is_whole)
        ledger.require(COMPLETE, (), is_right, "it says the opposite")
        ledger.require("freedoms are those of lines between points", (), not diagnosis.freedoms, "there are others")
        ledger.omit("the ties and freedoms of the diagnosis", "they were worked out for lines between points only")
        _check_other_ties(case, diagnosis.ties, found, ledger)
        return
    rows, off = system.linearised(facts)
    _check_freedoms(rank.freedoms(rows, system), diagnosis.freedoms, ledger)
    tied = rank.ties(rows, off)
    if tied is None:
        ledger.omit("the ties of the diagnosis", "there are too many sets of words to look at")
        return
    ledger.require(COMPLETE, (), diagnosis.ties_complete == is_whole, "it says the opposite")
    names = [tuple(map(_address, case.profile.words_of([facts[n] for n in tie.facts]))) for tie in tied]
    for claimed in diagnosis.ties:
        words, is_one = claimed.addresses, claimed.addresses in names
        if not ledger.require("the words of a tie say the same", words, is_one, "they do not"):
            continue
        tie = tied.pop(names.index(words))
        names.remove(words)
        limit = (RESIDUAL + ROUNDING * case.size) * max(1.0, tie.scale)
        ledger.measure("they disagree by as much", words, claimed.off_by_mm - tie.off, limit)
        *others, last = tie.facts
        gap, values, is_fixed = rank.compare(rows, off, others, last)
        share = gap / allowance(case, facts[last], values, {}) if is_fixed else tie.off / AGREEMENT
        is_right = claimed.is_conflict == (share > 1) or 1 / CLEARLY < share < CLEARLY
        if _is_turned(case, rows, off, [(each, facts[each]) for each in tie.facts], path):
            is_right = claimed.is_conflict
        ledger.require("they conflict if that is more than the least increments", words, is_right)
    rest = [" ".join(each) for each in names]
    ledger.require("the ties name all words that say the same", rest, not names, "the result lacks these")


def _is_turned(case: Case, rows: Array, off: Array, tied: Sequence[tuple[int, Fact]], path: Array | None) -> bool:
    """Whether a line runs against the direction that one of some facts states: on the path, or where these facts put
    its ends."""
    numbers = [number for number, _ in tied]
    is_fixed = rank.fixed(rows[numbers]) if path is None else numpy.full(rows.shape[1], fill_value=True)
    at = case.system.at(rank.solved(rows[numbers], off[numbers]) if path is None else path, {})
    return any(
        isinstance(fact, Heading) and bool(is_fixed[rows[number] != 0].all()) and is_against(case, fact, at)
        for number, fact in tied
    )


def _address(word: Word) -> str:
    return word.text if word.address == gcode.FACT else word.address


def _check_other_ties(case: Case, ties: Sequence[ClaimedTie], found: Sequence[Candidate], ledger: Ledger) -> None:
    """Ties of circles and further facts: each disagrees as much as one of the facts that are not needed."""
    off = [
        (abs(case.missed_by(fact, each.values, each.signs)), fact in each.conflicts)
        for each in found
        for fact in case.spare
    ]
    for tie in ties:
        if off and tie.off_by_mm:
            gap, is_conflict = min(off, key=lambda one: abs(one[0] - tie.off_by_mm))
            limit = RESIDUAL + ROUNDING * case.reach
            ledger.measure("they disagree by as much", tie.addresses, gap - tie.off_by_mm, limit)
            is_right = tie.is_conflict == is_conflict
            ledger.require("they conflict if that is more than is allowed", tie.addresses, is_right)
        else:
            ledger.omit("the ties of the diagnosis", "what circles and facts have in common was not worked out")


def _check_freedoms(
    wanted: Mapping[str, tuple[float, float] | None], freedoms: Sequence[ClaimedFreedom], ledger: Ledger
) -> None:
    is_same = sorted(each.point for each in freedoms) == sorted(wanted)
    names = ", ".join(wanted) or "none"
    ledger.require("the points that can move are those", (), is_same, f"they are {names}")
    for each in freedoms if is_same else ():
        along, own = wanted[each.point], f"{each.point} moves in that direction"
        is_line = (along is not None) == (each.direction is not None) == (each.angle is not None)
        ledger.require(f"{each.point} moves along a line or anywhere", (), is_line)
        if along is None or each.direction is None or each.angle is None:
            continue
        first, second = each.direction
        # Its larger part is positive; of two that are equal, either is.
        flipped = -1 if max(along, key=abs) < 0 else 1
        ways = (flipped, -flipped) if abs(abs(first) - abs(second)) <= RESIDUAL else (flipped,)
        off = min(hypot(first - way * along[0], second - way * along[1]) for way in ways)
        ledger.measure(own, (), off, 2 * RESIDUAL, "1")
        ledger.require(f"{own}, its angle up to half a turn", (), 0 <= each.angle <= HALF_TURN)
        turned = each.angle - degrees(float(numpy.arctan2(second, first)))
        ledger.measure(f"{own}, by its angle", (), (turned + 90) % 180 - 90, RESIDUAL, "deg")
