"""Decides between all contours that satisfy a profile: the control's choice, the only one, or none."""

from dataclasses import replace

from contoursolve.model import Profile
from contoursolve.solving.alternatives import Alternative, Alternatives, choose
from contoursolve.solving.elimination import Obstacle
from contoursolve.solving.solution import Refusal, RefusalKind, Remark, RemarkKind, Solution, Status


def decide(alternatives: Alternatives, profile: Profile) -> Solution:
    """The contour of a profile, of whose equations these are the solutions.

    Several contours, between which nothing chooses, are ambiguous.
    """
    eligible = choose(alternatives, profile.choices)
    paths = [item for item in eligible if item.is_path]
    count = {"actual": float(len(paths))}
    if len(paths) > 1:
        return Solution(Status.AMBIGUOUS, remarks=(Remark(RemarkKind.SEVERAL, "", (), count),))
    if paths:
        solution = _without_selecting(paths[0].solution, alternatives)
        if alternatives.is_complete:
            return solution
        return replace(solution, remarks=(*solution.remarks, Remark(RemarkKind.COUNT_OPEN, "", (), count)))
    return _refused(eligible, alternatives)


def _without_selecting(solution: Solution, alternatives: Alternatives) -> Solution:
    """A solution without the remark that a word was not needed, where the word tells it from another solution."""
    selecting = {
        refusal.subject
        for item in alternatives.items
        for refusal in item.solution.refusals
        if refusal.kind in (RefusalKind.WORDS_DISAGREE, RefusalKind.FACT_DISAGREES)
    }
    remarks = tuple(
        remark
        for remark in solution.remarks
        if remark.kind is not RemarkKind.WORDS_AGREE or remark.subject not in selecting
    )
    agrees = any(remark.kind is RemarkKind.WORDS_AGREE for remark in remarks)
    return replace(solution, status=Status.OVERDETERMINED if agrees else Status.SOLVED, remarks=remarks)


def _refused(items: tuple[Alternative, ...], alternatives: Alternatives) -> Solution:
    """Why there is no contour: what speaks against the first of the solutions, or that there is none. Where a search
    was given up, there may be others."""
    is_open = any(doubt.obstacle is Obstacle.UNFINISHED for doubt in alternatives.doubts)
    if items and not is_open:
        return items[0].solution
    kind = RefusalKind.NO_POINT if alternatives.is_complete else RefusalKind.SEARCH_UNFINISHED
    return Solution(kind.status, refusals=(Refusal(kind, ""),))
