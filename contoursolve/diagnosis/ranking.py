"""The order of repairs: all that are found, with the slips around them, weighed by one model."""

import re
from bisect import insort
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from itertools import chain
from math import log2

from msgspec.structs import replace

from contoursolve.diagnosis.attempt import SHORT, Repair, Repairs, Trial
from contoursolve.diagnosis.edits import (
    Edit,
    EditKind,
    Why,
    edited,
    has_plus,
    signed,
    with_plus,
)
from contoursolve.diagnosis.examine import LEADING
from contoursolve.diagnosis.plausibility import (
    OF_EDITS,
    ROUNDEST,
    Feature,
    coarseness,
    distance,
    familiarity,
    oddities,
    round_points,
    rounding_of,
    size_of,
    total,
)
from contoursolve.diagnosis.prospects import keeps_address
from contoursolve.diagnosis.slip_kinds import FEW, OF_DIGITS, number_in
from contoursolve.diagnosis.slips_around import (
    MOST_OF_DIGITS,
    MOST_TRIED as MOST_AROUND,
    Candidate,
    drafts_around,
    touches,
)
from contoursolve.diagnosis.subsets import LARGEST_ROLE
from contoursolve.diagnosis.window import Seen, moves_of, parts_of, path_of
from contoursolve.diagnostics import Applicability, NumberRange
from contoursolve.solving import Contour
from contoursolve.tolerance import AGREEMENT

MOST_TRIED = 60
"""Changed blocks that are tried for one contour, fewer for a chain, whose every trial takes longer; beyond it the list
is not called complete."""

MOST_CONSIDERED = 2_000
"""Changed blocks that are looked at for one contour; most of them contain a repair that was found before."""


def choose_repairs(trial: Trial, stages: Iterable[Iterable[tuple[Edit, ...]]]) -> Repairs:
    """The drafts that are repairs, none of which contains another one, and the slips around the contour that explain
    it; the most plausible first."""
    found: list[Repair] = []
    tried: set[tuple[Edit, ...]] = set()
    spent = 0
    length = len(trial.claim.blocks)
    most = MOST_TRIED if length <= LARGEST_ROLE else max(8, 2 * MOST_TRIED // length)
    considered = 0
    for draft in chain.from_iterable(stages):
        edits = tuple(edit for edit in draft if edit.kind is not EditKind.CHANGE or edit.text != edit.old)
        considered += 1
        if len(tried) + spent > most or considered > MOST_CONSIDERED:
            break
        if edits not in tried and not any(set(other.edits) <= set(edits) for other in found):
            tried.add(edits)
            repair = trial.repair(edits)
            found += [repair] if repair else []
            spent += trial.extra(edits)
    is_complete = len(tried) + spent <= most and considered <= MOST_CONSIDERED
    found = [_weighed(each, trial) for each in found]
    known = {each.edits: each for each in found}
    around, are_all = _slips_around(trial, known.copy(), tried - known.keys())
    for each in around:
        other = known.get(each.edits)
        if other is None or each.cost_of_edits < other.cost_of_edits:
            known[each.edits] = each
    if not trial.is_frequent and not trial.is_searched and _is_unexplained(known.values()):
        from contoursolve.diagnosis.two_slips import two_slips  # noqa: PLC0415 - most have one slip

        known |= {each.edits: replace(each, is_double=True) for each in _tried(trial, two_slips(trial))}
    found = [*known.values()]
    found = [
        each
        for each in found
        if not any(set(other.edits) < set(each.edits) and other.cost <= each.cost for other in found)
    ]
    found = _usual_marked(_large_marked(found, trial.contour))
    found.sort(key=_order)
    found = [each for at, each in enumerate(found) if not any(_is_again(each, other) for other in found[:at])]
    if found and not found[0].is_double:
        # Beside one slip that explains it, two tell nothing.
        found = [each for each in found if not each.is_double]
    farthest = found[0].cost + _FARTHEST if found else 0.0
    found = [each for at, each in enumerate(found) if at < _ENOUGH or each.cost <= farthest or not any(each.slips)]
    found = [
        styled(trial.with_numbers(each, may_try=at < _MOST_COUNTED) if each.example else each, trial)
        for at, each in enumerate(found)
    ]
    # Of a word that may be of several sizes and one that may be of one alone, that is left to who knows the drawing.
    found.sort(key=lambda each: (each.cost, not each.numbers))
    added = frozenset((edit.address, edit.line) for edits in tried for edit in edits if edit.kind is EditKind.ADD)
    is_cut = not (is_complete and are_all)
    return Repairs(tuple(found), is_complete, has_tried_all=is_complete, tried=added, is_cut=is_cut)


def _is_unexplained(found: Iterable[Repair]) -> bool:
    """Whether no slip explains what is wrong well."""
    best = min(found, key=lambda each: each.cost, default=None)
    return best is None or best.cost > _WELL or not any(best.slips)


_WELL = 5.0
"""The cost of a repair beside which two slips are not looked for."""


def _tried(trial: Trial, drafts: Iterable[Candidate]) -> Iterator[Repair]:
    """The drafts that are repairs, up to those that would hardly be among the first ones."""
    ranked = list[float]()
    for draft in drafts:
        if draft.cost > _bound(ranked):
            return
        repair = repair_of(draft, trial)
        if repair is not None:
            insort(ranked, repair.cost_of_edits)
            yield repair


def _slips_around(
    trial: Trial, known: Mapping[tuple[Edit, ...], Repair], refused: Set[tuple[Edit, ...]]
) -> tuple[list[Repair], bool]:
    """The slips of a contour and of the blocks around it that explain what is wrong, those of digits where no other
    one does; and whether all that may were tried."""
    window, claim = trial.window, trial.claim
    # Where each trial takes a search, no slip is tried.
    found, are_all = list[Repair](), True
    if not trial.marked.lines or trial.is_searched:
        return found, not trial.is_searched
    ranked = sorted(each.cost for each in known.values())
    paths = [_USUAL, *(_cost_of_path(each, trial) for each in known.values())]
    best = min(map(_doubt, known.values()), default=None)
    # What cannot be read is an error until an edit touches it.
    torn = {each.span for block in window.own for each in block.faults}

    def may_mend(edits: tuple[Edit, ...]) -> bool:
        is_whole = all(any(touches(edit, span) for edit in edits) for span in torn)
        return is_whole and (trial.prospects is None or trial.prospects.has(edits))

    for kinds in (FEW, OF_DIGITS)[: 1 if trial.is_frequent else 2]:
        is_likely = best is not None and best < _LIKELY
        if kinds is OF_DIGITS and is_likely and not trial.is_crossing_curves:
            break
        is_in_vain = trial.prospects.is_in_vain if trial.prospects is not None else lambda _: False
        drafts = drafts_around(window, trial.marked, claim, kinds, may_mend, is_in_vain)
        most = MOST_AROUND if kinds is FEW else MOST_OF_DIGITS
        if kinds is OF_DIGITS and is_likely:
            # The sizes of circles that are missed, which few other slips explain.
            sizes = {*"IJK", window.control.modes.radius} if trial.is_missed else None
            most = MOST_AROUND if sizes else most
            drafts = [
                each
                for each in drafts
                if all(edit.span in trial.marked.spans for edit in each.edits)
                and (sizes is None or all(edit.address in sizes for edit in each.edits))
            ]
        most, tried = _tries(most, trial), 0
        for draft in drafts:
            own = known.get(draft.edits)
            if own is not None and own.cost_of_edits <= draft.cost:
                continue
            if draft.edits in refused and all(map(keeps_address, draft.edits)):
                continue
            if tried >= most or draft.cost + min(paths) - _PATH > _bound(ranked):
                are_all = are_all and tried < most
                break
            tried += 1
            repair = repair_of(draft, trial)
            if repair is None:
                continue
            best = _doubt(repair) if best is None else min(best, _doubt(repair))
            insort(ranked, repair.cost)
            paths.append(_cost_of_path(repair, trial))
            found.append(repair)
    return found, are_all


def _tries(most: int, trial: Trial) -> int:
    """The number of drafts that are tried: fewer of a long contour, whose every trial takes longer, and where each
    contour may have the same finding."""
    length = len(trial.claim.blocks)
    if trial.is_frequent:
        return _FREQUENT
    return most if length <= SHORT else max(_FEWEST, most * SHORT // length)


def _bound(costs: Sequence[float]) -> float:
    """The cost beyond which a further repair would hardly be among the first ones."""
    return min([*costs[_ENOUGH - 1 : _ENOUGH], *(each + _BEHIND for each in costs[:1])], default=float("inf"))


_FEWEST, _FREQUENT = 8, 16
"""Drafts that are tried of the longest contours, and of those that may all have the same finding."""


def _cost_of_path(repair: Repair, trial: Trial) -> float:
    """The cost of its path; of curves that cross, with intersections that come out round."""
    path = dict(each for each in repair.evidence if each[0] not in OF_EDITS)
    if trial.is_crossing_curves:
        path[Feature.POINTS] = -ROUNDEST
    return total(path.items())


def _doubt(repair: Repair) -> float:
    """The cost of its edits; with that of a path which hardly anybody means."""
    return repair.cost_of_edits + total(each for each in repair.evidence if each[0] is Feature.ACROSS)


_FARTHEST = 5.0
"""Slips that are so much less plausible than the best repair are not told behind some others."""

_LIKELY = 4.0
"""The cost of the edits of a repair beside which wrong digits are not looked for."""

_MARGIN = 2.5
"""By so much less plausible than the best one, repairs tell nothing of sizes."""

_USUAL = 2.0
"""The cost of a usual path, where those that are known are odd."""

_MOST_COUNTED = 8
"""The first repairs, for which numbers are tried that cannot be computed."""

_ENOUGH, _BEHIND, _PATH = 3, 1.0, 0.2
"""Repairs that are read, and by how much less plausible than the first one they may be; by so much another path may
cost less than the least of those that are known."""


def styled(repair: Repair, trial: Trial) -> Repair:
    """A repair whose words have their signs as those around have them."""
    window, blocks = trial.window, trial.claim.blocks
    around = window.blocks
    edits, example = signed(repair.edits, around), signed(repair.example, around)
    if (edits, example) == (repair.edits, repair.example) and not (repair.numbers and has_plus(around)):
        return repair
    own = {block.line for block in blocks}
    beside = tuple(each for each in window.changes(edits) if each.span.line not in own) if repair.beside else ()
    numbers = tuple(
        replace(
            each,
            example=with_plus(each.example),
            ranges=tuple(NumberRange(with_plus(ends.low), with_plus(ends.high)) for ends in each.ranges),
        )
        for each in repair.numbers
    )
    replacement = edited(blocks, [edit for edit in edits if edit.place in own or edit.place <= 0])
    return replace(repair, edits=edits, example=example, replacement=replacement, beside=beside, numbers=numbers)


def repair_of(draft: Candidate, trial: Trial, is_better: Callable[[Seen], bool] = lambda _: True) -> Repair | None:
    """A draft with what it makes of the contour, if that is right, and better; of plain blocks, none is left."""
    seen = trial.window.mended(draft.edits)
    if seen is None or not is_better(seen):
        return None
    parts = (part.answer.contour for part in parts_of(seen, trial.window.lines) if part.answer is not None)
    contour = next(parts, None)
    # Parted by plain blocks, it ends with them.
    contour = (path_of(seen, trial.lines) or contour) if contour is not None else None
    within = [edit for edit in draft.edits if edit.place in trial.lines]
    replacement = edited(trial.claim.blocks, within)
    repair = Repair(draft.edits, replacement, Applicability.CHANGES_CONTOUR, None, 0.0)
    if contour is not None:
        repair = trial.made(contour, draft.edits, replacement)
    beside = tuple(each for each in trial.window.changes(draft.edits) if each.span.line not in trial.lines)
    # What is beside the contour draws a path, too, or says how it is followed.
    applicability = Applicability.CHANGES_CONTOUR if beside else repair.applicability
    repair = replace(repair, applicability=applicability, slips=draft.slips, beside=beside)
    return replace(repair, evidence=_of_path(repair, seen, draft.evidence))


def _weighed(repair: Repair, trial: Trial) -> Repair:
    """A repair with what is known of it without the blocks around it."""
    edits, marked = repair.edits, trial.marked
    kinds = [trial.price(edit, slip) + trial.strangeness(edit) for edit, slip in zip(edits, repair.slips, strict=True)]
    # Corners that share an element which is too short for them do not fit for one reason.
    is_fitted = all(edit.why is Why.FITS for edit in edits) or all(trial.drops_corner(edit) for edit in edits)
    is_one = bool(edits) and is_fitted and not any(repair.slips)
    kind = max(kinds) if is_one else sum(kinds)
    kind += _NAUGHT * sum(_is_naught(edit) for edit in edits)
    kind += _SIGNED * sum(edit.why is Why.AGREES and _has_other_sign(edit) for edit in edits)
    lines = [edit.span.line if edit.span else edit.line for edit in edits]
    near = [distance(line, edit.span in marked.spans, marked.lines) for line, edit in zip(lines, edits, strict=True)]
    rounding = sum(map(rounding_of, edits)) * coarseness(trial.numbers)
    evidence = (
        (Feature.KIND, kind),
        (Feature.NEAR, min(near, default=0.0)),
        (Feature.ROUND, rounding),
        (Feature.FAMILIAR, familiarity(edits, trial.numbers)),
    )
    seen = trial.window.after(edits) if repair.contour is not None else None
    return replace(repair, evidence=_of_path(repair, seen, evidence))


_NAUGHT = 1.5
"""The cost of another value for a 0, which nobody types by mistake."""


def _is_naught(edit: Edit) -> bool:
    return edit.why is Why.AGREES and not number_in(edit.old).strip("0.")


_SIGNED = 0.8
"""The cost of a sign that changes with the value, which the others would have as well with the old sign."""


def _has_other_sign(edit: Edit) -> bool:
    return ("-" in edit.text) is not ("-" in edit.old)


def _of_path(
    repair: Repair, seen: Seen | None, known: tuple[tuple[Feature, float], ...]
) -> tuple[tuple[Feature, float], ...]:
    """The features that are known, and those of the path."""
    contour = repair.contour
    if contour is None and seen is None:
        return known
    moves = seen.moves if seen is not None else tuple(moves_of(contour)) if contour else ()
    return (
        *known,
        *oddities(moves).items(),
        (Feature.POINTS, -round_points(contour)),
        (Feature.SAME, -float(contour is not None and repair.deviation <= AGREEMENT and not repair.beside)),
        (Feature.WARNING, float(repair.warnings + len(_LEADING_ZERO.findall(repair.replacement)))),
    )


_LEADING_ZERO = re.compile(LEADING.pattern + r"\d*+\.")
"""A word that is left with a number that begins with a zero, of which a suspicion would be told."""


def _large_marked(found: list[Repair], before: Contour | None) -> list[Repair]:
    """Repairs, those that make the contour more than twice as large as it was, or as the smallest of the more plausible
    ones makes it, with that as a drawback."""
    best = min((each.cost for each in found if each.contour), default=0.0)
    sizes = [size_of(each.contour) for each in found if each.contour and each.cost <= best + _MARGIN]
    if not sizes:
        return found
    least = max(size_of(before) if before else 0.0, min(sizes), AGREEMENT)
    shortest = min(each.contour.length for each in found if each.contour and each.cost <= best + _MARGIN)
    marked = []
    for each in found:
        times = log2(size_of(each.contour) / least) - 1 if each.contour and size_of(each.contour) else 0.0
        if each.contour and shortest:
            longer = max(log2(max(each.contour.length, AGREEMENT) / shortest), 0.0)
            each = replace(each, evidence=(*each.evidence, (Feature.LONG, longer)))  # noqa: PLW2901
        if times > 0:
            evidence = (*each.evidence, (Feature.LARGE, max(times - 1, 0.0)))
            each = replace(each, drawbacks=(*each.drawbacks, _LARGE), evidence=evidence)  # noqa: PLW2901
        marked.append(each)
    return marked


def _usual_marked(found: list[Repair]) -> list[Repair]:
    """Repairs; those whose path nobody knows turn, and close, as the most plausible one of the others does."""
    known = (dict(each.evidence) for each in found if each.contour or each.example != each.edits)
    usual = next((each for each in known if Feature.TURNING in each), {Feature.TURNING: _USUAL_TURNING})
    path = tuple((each, usual[each]) for each in (Feature.TURNING, Feature.CLOSED) if each in usual)
    return [
        each if any(one[0] is Feature.TURNING for one in each.evidence) else
        replace(each, evidence=(*each.evidence, *path))
        for each in found
    ]  # fmt: skip


_USUAL_TURNING = 1.0
"""Half turns of a usual path."""


def _order(repair: Repair) -> tuple[object, ...]:
    """The most plausible first; of those alike the smallest change."""
    size = size_of(repair.contour) if repair.contour else 0.0
    return (
        repair.cost,
        round(repair.deviation, 6),
        len(repair.edits),
        round(size, 6),
        # Wherever in its block a word stands.
        sorted((edit.place, edit.old.strip(), edit.text.strip()) for edit in repair.edits),
    )


def _is_again(repair: Repair, other: Repair) -> bool:
    """Whether a repair writes another value in the same words for the same contour, as R-50 for R50."""
    is_same = repair.contour is not None and repair.contour == other.contour
    changes = all(edit.kind is EditKind.CHANGE for edit in (*repair.edits, *other.edits))
    return is_same and changes and [edit.span for edit in repair.edits] == [edit.span for edit in other.edits]


_LARGE = "more than twice as large"
