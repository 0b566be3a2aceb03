"""A repair that is tried: the edits are applied to the text, and what comes out is read, checked and solved."""

import dataclasses
import re
from collections.abc import Iterable, Iterator, Sequence
from decimal import Decimal
from itertools import chain, islice

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.edits import Edit, EditKind, InsertionSide, Why, apply_edits, edit_facts, edited
from contoursolve.diagnosis.examine import Answer, Depth, Policy, examine, problems
from contoursolve.diagnosis.examples import ends, propose, sampled
from contoursolve.diagnosis.reach import Reach
from contoursolve.diagnosis.subsets import LARGEST_ROLE
from contoursolve.diagnosis.typo_fixes import (
    FEW,
    NEIGHBOUR,
    POINT_LOST,
    ROUND,
    SIGN_ADDED,
    SIGN_LOST,
    SLIPS,
    Slip,
    recognise,
)
from contoursolve.diagnostics import Applicability, Diagnostic, Severity, Span
from contoursolve.gcode import Block, parse_block
from contoursolve.geometry import Profile, Unit, assemble
from contoursolve.reading import Dialect, ParsedContour, ReadIssue, State, advance, leave, read
from contoursolve.solving import (
    Contour,
    LineSegment,
    NoteKind,
    Point,
    Segment,
    Status,
    affine_facts,
    analyse,
    groups_of,
    is_closed,
    opposes,
)
from contoursolve.tolerance import AGREEMENT

MOST_TRIED = 60
"""Changed blocks that are tried for one contour, fewer for a chain, whose every trial takes longer; beyond it the list
is not called complete."""

MOST_SLIPS = 60
"""Changed blocks that are considered for the slips of one contour."""

MOST_OF_DIGITS = 3
"""Slips of digits that are told; there may be many."""

MOST_CONSIDERED = 2_000
"""Changed blocks that are looked at for one contour; most of them contain a repair that was found before."""

EASY_STEP, LARGEST_STEP = 4, 12
"""Unknowns of one step: up to the first it takes milliseconds; beyond the second a search can take a minute, and a
draft is not tried."""

SLOW = 15
"""Drafts that one with a step between these counts for; it can take a second."""


class Repair(Struct, frozen=True):
    """A change of a block that the control accepts, with the block that it makes.

    `contour` is the path then (None for a placeholder, whose number is missing), `deviation` the largest
    distance (mm) of its points and elements from those of the refused block, where that has any.
    """

    edits: tuple[Edit, ...]
    replacement: str
    applicability: Applicability
    contour: Contour | None
    deviation: float
    warnings: int = 0
    """Rules that warn about the changed block and did not before."""
    example: tuple[Edit, ...] = ()
    """The edits with numbers for the placeholders that make a contour."""
    ends: tuple[str, ...] = ()
    """From which number to which one the placeholder may be; nothing where no end was found."""
    is_exact: bool = True
    """Whether its circles pass through their points, and do not only miss them by less than a control minds."""
    is_blamed: bool = True
    """Whether a finding is about a word that it changes."""
    reason: Why = Why.OTHER
    """The least convincing of the reasons for its edits."""
    slips: tuple[Slip | None, ...] = ()
    """The slip that explains each edit."""
    drawbacks: tuple[str, ...] = ()
    """The reason, in words, for which it is unlikely to be meant."""


class Repairs(Struct, frozen=True):
    """Repairs, best first: fewest edits, smallest change of the contour.

    `is_complete` tells that all smallest sets of words to drop and add, up to `MOST_EDITS`, were tried, `has_tried_all`
    that so was all that was thought of;
    `tried` are the words that were tried to be added, by address and line.
    """

    repairs: tuple[Repair, ...]
    is_complete: bool
    has_tried_all: bool = False
    tried: frozenset[tuple[str, int]] = frozenset()


class Trial(Struct, frozen=True):
    """The contour that edits are tried on, as it is before: its codes, its path if there is one, and where the next
    block's line ends."""

    claim: ParsedContour
    dialect: Dialect
    codes: frozenset[str]
    contour: Contour | None
    next_place: tuple[Decimal, Decimal] | None = None
    following: tuple[Block, ...] = ()
    """The blocks after it, of which a corner needs one."""
    blamed: frozenset[Span] = frozenset()
    """The words that findings are about."""
    previous: tuple[Sequence[Block], State] | None = None
    """The blocks before it, and the state before those: with its commas in place, it may be the end of it."""
    is_redundant: bool = False
    """Whether its words say something twice, and agree."""
    reach: Reach | None = None
    """The parts that edits leave as they are."""

    def repair(self, edits: tuple[Edit, ...]) -> Repair | None:
        """The repair with the reasons for it, if it is one."""
        if any(edit.span in self.claim.trusted for edit in edits):
            return None
        if self.reach is not None and self.reach.leaves_a_problem(edits):
            return None
        repair = self._solve(edits)
        if repair is None:
            return None
        found = tuple(recognise(edit, self.claim) or (ROUND if _is_round(edit) else None) for edit in edits)
        reason = max(Why.SLIP if slip else edit.reason for edit, slip in zip(edits, found, strict=True))
        is_blamed = not self.blamed or any(edit.span in self.blamed for edit in edits)
        return replace(repair, reason=reason, slips=found, is_blamed=is_blamed)

    def _solve(self, edits: tuple[Edit, ...]) -> Repair | None:
        """The repair, if the changed block is read as the same form, accepted, and solved without a finding."""
        claim = self.claim
        texts = apply_edits(claim.blocks, edits)
        if texts == tuple(block.text for block in claim.blocks) and all(edit.is_in_block for edit in edits):
            return None
        replacement = edited(claim.blocks, edits)
        if any(edit.is_placeholder for edit in edits):
            example, kind = self._example(edits), Applicability.PLACEHOLDER
            return Repair(edits, replacement, kind, None, 0.0, example=example) if example else None
        answer = self.examine(edits)
        if answer is None:
            paths = (self._path_in_parts, self._path_beside_arcs) if _is_about_corners(edits, claim) else ()
            contour = next(filter(None, (path(edits) for path in paths)), None)
            return self._making(contour, edits, replacement) if contour else None
        if answer.contour is None or not _is_settled(answer, edits):
            return None
        # No change of the block moves its start.
        findings = [each for each in problems(answer) if each.about is not ReadIssue.START_IN_INCREMENTS]
        rules = [each for each in findings if _is_crossing(each)]
        if answer.profile.is_extended:
            # Rules of the manual only warn where more is stated or asked than the control reads.
            rules += [each for each in findings if each.about is None and each.severity is Severity.WARNING]
        if all(edit.kind is EditKind.ADD and edit.address in _choices(claim) for edit in edits):
            # Either sign makes the contour where two elements only touch.
            rules += [each for each in findings if each.about is NoteKind.TOUCHES]
        if not all(each in rules or self._now_agrees(each) for each in findings):
            return None
        if answer.contour.crossing is not None and self.codes == {each.code for each in rules if _is_crossing(each)}:
            return None
        repair = self._making(answer.contour, edits, replacement)
        is_safe = repair.applicability is Applicability.SAFE and not any(_drops_more(edit, claim) for edit in edits)
        return replace(
            repair,
            applicability=Applicability.SAFE if is_safe else Applicability.CHANGES_CONTOUR,
            warnings=sum(each.code not in self.codes for each in rules),
            is_exact=all(each.about is not NoteKind.RADIUS_DIFFERS for each in answer.diagnostics),
        )

    def _making(self, contour: Contour, edits: tuple[Edit, ...], replacement: str) -> Repair:
        """The repair that makes a contour, which may be parted into several, and lines between them."""
        reference = self.contour
        deviation = contour.deviation(reference) if reference else float("inf")
        is_same = reference is not None and contour.is_alike(reference) and deviation <= AGREEMENT
        # Hardly anybody means a path across the spindle axis, unless it was there before.
        is_across = contour.crossing is not None and (reference is None or reference.crossing is None)
        applicability = Applicability.SAFE if is_same else Applicability.CHANGES_CONTOUR
        return Repair(
            edits, replacement, applicability, contour, deviation, drawbacks=("across the spindle axis",) * is_across
        )

    def _path_in_parts(self, edits: tuple[Edit, ...]) -> Contour | None:
        """The path of blocks that are several contours, or plain lines, without the corners that are dropped. None
        where one of them is not sound, or more than lines and contours is left."""
        claim, dialect = self.claim, self.dialect
        blocks = [
            parse_block(text, block.line, block.syntax)
            for text, block in zip(apply_edits(claim.blocks, edits), claim.blocks, strict=True)
        ]
        state, index, elements = claim.before, 0, list[Segment]()
        start = here = _place(state)
        while index < len(blocks) and here is not None:
            part = dialect.find(blocks, index, state, dialect.modes)
            if isinstance(part, ParsedContour):
                answer = examine(part, dialect.rules, Policy.ENFORCE, lambda: None)
                if not (part.form.is_contour and _is_sound(answer) and answer.contour):
                    return None
                elements += answer.contour.elements
                state, index = leave(part, answer.contour.end, dialect.modes), index + len(part.blocks)
            else:
                state, index = advance(state, blocks[index], dialect.modes), index + 1
                there = _place(state)
                if there is None or state.motion != _LINE:
                    return None
                elements += [LineSegment(f"line {index}", here, there)] if there != here else []
            here = _place(state)
        return Contour(start, here, {}, tuple(elements), claim.before.plane) if start and here else None

    def _path_beside_arcs(self, edits: tuple[Edit, ...]) -> Contour | None:
        """The path of the same elements, arcs among them, without the words that are dropped, if it is sound."""
        claim, spans = self.claim, {edit.span for edit in edits}
        words = {name: word for name, word in claim.words.items() if word.span not in spans}
        givens = {name: each for name, each in claim.givens.items() if name in words or name not in claim.words}
        answer = examine(dataclasses.replace(claim, words=words, givens=givens), self.dialect.rules, Policy.ENFORCE)
        return answer.contour if _is_sound(answer) else None

    def _now_agrees(self, finding: Diagnostic) -> bool:
        """Whether a finding that the block did not have before says only that a word now agrees."""
        is_new = finding.code not in self.codes and not self.is_redundant and finding.severity is Severity.WARNING
        is_near = finding.values.get("off_by_mm", float("inf")) <= AGREEMENT
        return is_new and is_near and not opposes(finding.values, Unit.DEGREE)

    def examine(self, edits: tuple[Edit, ...]) -> Answer | None:
        """The answer to the edited blocks; None where they are not read as the same contour any more."""
        found = self.find(edits)
        if found is None or self._largest_step(found) > LARGEST_STEP:
            return None
        return examine(found, self.dialect.rules, Policy.ENFORCE, lambda: self.next_place, Depth.TRIAL)

    def extra(self, edits: tuple[Edit, ...]) -> int:
        """The number of further drafts that trying these edits counts for."""
        found = self.find(edits) if self.claim.directives else None
        return SLOW - 1 if found and EASY_STEP < self._largest_step(found) <= LARGEST_STEP else 0

    def _largest_step(self, found: ParsedContour) -> int:
        """The number of unknowns that further facts make one step determine together; 0 for ordinary words."""
        profile = self._stated(found)
        if profile is None or not profile.is_extended:
            return 0
        system = assemble(profile)
        if not analyse(system).is_determined:
            return 0
        return max(len(group.unknowns) for group in groups_of(system))

    def find(self, edits: tuple[Edit, ...]) -> ParsedContour | None:
        """The edited blocks as they are read; None where they are not the same contour any more."""
        claim, dialect = self.claim, self.dialect
        texts = apply_edits(claim.blocks, edits)
        lines = [
            (part, block.line)
            for text, block in zip(texts, claim.blocks, strict=True)
            for part in text.split("\n")
            if text or not block.text
        ]
        ahead, blocks, behind = _parted([parse_block(*line, dialect.modes.syntax) for line in lines], edits)
        if not blocks:
            return None
        state = claim.before
        for block in ahead:
            state = advance(state, block, dialect.modes)
        apart = edit_facts([each for each in claim.directives if each.span.line < 0], edits)
        blocks[-1] = replace(blocks[-1], directives=(*blocks[-1].directives, *apart))
        is_about_commas = all(map(_is_comma, edits))
        more = self.following if is_about_commas else ()
        if is_about_commas and self.previous and self.previous[0][-1].line < blocks[0].line:
            whole = dialect.find([*self.previous[0], *blocks, *more], 0, self.previous[1], dialect.modes)
            if isinstance(whole, ParsedContour) and whole.blocks[-1].line >= blocks[-1].line:
                return whole
        found = dialect.find([*blocks, *more], 0, state, dialect.modes)
        others = (dialect.find([*ahead, *behind], index, state, dialect.modes) for index in range(len(ahead + behind)))
        if not isinstance(found, ParsedContour) or any(isinstance(each, ParsedContour) for each in others):
            return None
        return found if len(found.blocks) == len(blocks) or (more and len(found.blocks) > len(blocks)) else None

    def _example(self, edits: tuple[Edit, ...]) -> tuple[Edit, ...] | None:
        """The edits with a number for every placeholder that makes a contour; as they are where further facts determine
        a drawing that has no closed form. None if nothing is found."""
        found = self.find(sampled(edits))
        profile = self._stated(found) if found else None
        if found is None or profile is None:
            return None
        if profile.is_extended:
            system = assemble(profile)
            if not analyse(system).is_determined:
                return None
            if not is_closed(system):
                return edits
        affine = affine_facts(profile, profile.facts)
        if affine is not None and affine.freedoms():
            return None
        return next((each for each in propose(found, profile, edits) if self.repair(each)), None)

    def with_ends(self, repair: Repair) -> Repair:
        """A repair with a placeholder, with the numbers between which that of its example stands."""
        found = self.find(repair.example) if repair.example != repair.edits else None
        if found is None:
            return repair

        def is_accepted(edits: tuple[Edit, ...]) -> bool:
            return self.repair(edits) is not None

        profile = self._stated(found)
        return replace(repair, ends=tuple(ends(found, profile, repair.edits, is_accepted))) if profile else repair

    def _stated(self, claim: ParsedContour) -> Profile | None:
        """The profile of a contour with its further facts; None if one of them cannot be used."""
        profile = read(claim, frozenset())
        if not profile.is_extended:
            return profile
        from contoursolve.geometry import apply_statements  # noqa: PLC0415 - few blocks state more than their words

        profile, faults = apply_statements(profile, claim.directives, lambda: self.next_place)
        return None if faults else profile


def _is_round(edit: Edit) -> bool:
    """Whether a word gets a round number from the others, which hardly happens by chance."""
    return edit.why is Why.AGREES and len(edit.text.partition(".")[2]) <= 1 and edit.kind is EditKind.CHANGE


def _choices(claim: ParsedContour) -> set[str]:
    """The addresses of words of which only the sign counts."""
    return {claim.vocabulary[name][0] for name in claim.form.choices if name in claim.vocabulary}


def _is_about_corners(edits: tuple[Edit, ...], claim: ParsedContour) -> bool:
    """Whether all that is done is to leave out corners, and the angles of lines whose ends are stated."""
    sizes = (name for name in claim.form.outline.shapes if name in claim.words)
    spans = {claim.words[name].span for name in (*sizes, *_spare_angles(claim))}
    return all(edit.kind is EditKind.DROP and edit.span in spans for edit in edits)


def _spare_angles(claim: ParsedContour) -> Iterator[str]:
    """The angles of lines that have both coordinates of their end, and begin where the block before ends."""
    prefixes = {role.prefixes[0] for role in claim.form.roles if role.name == "line"}
    for row in claim.form.outline.facts:
        given = row.fact.given or ""
        prefix = given[: given.find(":") + 1]
        if row.fact.heading and given in claim.words and prefix in prefixes:
            stated = {
                name.removeprefix(prefix).removesuffix("-step") for name in claim.words if name.startswith(prefix)
            }
            if stated >= {"first", "second"}:
                yield given


def _is_sound(answer: Answer) -> bool:
    return answer.status is Status.SOLVED and not problems(answer)


_LINE = 1
"""The motion code of a line."""


def _place(state: State) -> Point | None:
    """The place of the tool in the plane, mm, if that is known."""
    first, second = state.start().values
    return None if first is None or second is None else (float(first), float(second))


def _drops_more(edit: Edit, claim: ParsedContour) -> bool:
    """Whether a word is dropped that does something besides the contour, or moves an axis outside the plane: the
    contour is the same, what the machine does is not."""
    row = claim.lexicon.addresses.get(edit.address)
    is_beside = row is not None and bool(row.axis) and row.axis not in claim.before.plane.axes
    return edit.kind is EditKind.DROP and (is_beside or edit.errand is not None)


def _is_settled(answer: Answer, edits: tuple[Edit, ...]) -> bool:
    """Whether it is solved. A value that was corrected may then say what the others say."""
    if answer.status is Status.OVERDETERMINED:
        if answer.claim.form.is_general:
            return True
        return answer.profile.is_extended and any(edit.kind is EditKind.CHANGE for edit in edits)
    return answer.status is Status.SOLVED


def _is_crossing(finding: Diagnostic) -> bool:
    """Whether the path crosses the spindle axis, which may be meant."""
    return finding.about is ReadIssue.AXIS_CROSSED


def _is_comma(edit: Edit) -> bool:
    """Whether the address gets a comma or loses it, or becomes another one of several letters."""
    if edit.kind is not EditKind.CHANGE or edit.text == edit.old:
        return False
    is_long = len(edit.address.lstrip(",")) > 1 and not edit.text.upper().startswith(edit.address)
    return is_long or edit.text.strip(", ") == edit.old.strip(", ")


def _parted(blocks: list[Block], edits: tuple[Edit, ...]) -> tuple[list[Block], list[Block], list[Block]]:
    """Blocks as those of words that were moved before the contour, its own, and those of words moved behind it."""
    sides = [edit.errand.side for edit in edits if edit.kind is EditKind.MOVE and edit.errand]
    first, last = sides.count(InsertionSide.BEFORE), len(blocks) - sides.count(InsertionSide.BEHIND)
    return blocks[:first], blocks[first:last], blocks[last:]


# Ranking -------------------------------------------------------------------------------------------------------------


def choose_repairs(
    trial: Trial,
    stages: Iterable[Iterable[tuple[Edit, ...]]],
    slips: Iterable[tuple[Edit, ...]] = (),
    digits: Iterable[tuple[Edit, ...]] = (),
    radii: Iterable[tuple[Edit, ...]] = (),
) -> Repairs:
    """The drafts that are repairs, none of which contains another one; of each stage after what came before.

    `slips` are tried besides, `digits` where neither these nor a value that agrees or fits explains the block; of
    `radii` those count that make round points.
    """
    found: list[Repair] = []
    tried: set[tuple[Edit, ...]] = set()

    def try_slips(drafts: Iterable[tuple[Edit, ...]], enough: int, *, is_round: bool = False) -> None:
        for edits in islice(drafts, MOST_SLIPS):
            repair = trial.repair(edits)
            if is_round and repair and not _has_round_points(repair):
                continue
            if repair and not any(set(other.edits) <= set(edits) for other in found):
                found.append(repair)
            if sum(each.reason is Why.SLIP for each in found) >= enough:
                return

    try_slips(slips, MOST_SLIPS)
    try_slips(radii, MOST_SLIPS, is_round=True)
    spent = 0
    length = len(trial.claim.blocks)
    most = MOST_TRIED if length <= LARGEST_ROLE else max(8, 2 * MOST_TRIED // length)
    considered = 0
    for edits in chain.from_iterable(stages):
        considered += 1
        if len(tried) + spent > most or considered > MOST_CONSIDERED:
            break
        if edits not in tried and not any(set(other.edits) <= set(edits) for other in found):
            tried.add(edits)
            repair = trial.repair(edits)
            found += [repair] if repair else []
            spent += trial.extra(edits)
    if not any(each.reason in _STRONG and each.is_exact and not each.drawbacks for each in found):
        try_slips(digits, MOST_OF_DIGITS)
    found = [repair for repair in found if not any(set(other.edits) < set(repair.edits) for other in found)]
    found.sort(key=_order)
    found = [each for at, each in enumerate(found) if not any(_is_again(each, other) for other in found[:at])]
    is_complete = len(tried) + spent <= most and considered <= MOST_CONSIDERED
    found = [trial.with_ends(each) if each.example else each for each in found]
    added = frozenset((edit.address, edit.line) for edits in tried for edit in edits if edit.kind is EditKind.ADD)
    ordered = tuple(_large_last(found, trial.contour))
    return Repairs(ordered, is_complete, has_tried_all=is_complete, tried=added)


def _order(repair: Repair) -> tuple[object, ...]:
    """The order in which a colleague would name them: what a slip of typing explains, then what agrees with the other
    words, what fits, what is missing, what is one too many; among equals the smallest change."""
    slip = max((min(SLIPS.index(each), len(FEW) + 1) for each in repair.slips if each), default=0)
    # Of signs that may be lost or too many, the one with which the contour does not go to and fro.
    is_sign = repair.contour is not None and {*repair.slips} <= {SIGN_LOST, SIGN_ADDED}
    is_other = repair.applicability is not Applicability.SAFE
    size = _size(repair.contour) if repair.contour else 0.0
    # A lost point is looked for at the end of a number first; in a long one, before the last three digits.
    lost = [edit for edit, each in _explained(repair) if each and each.sentence == "a lost decimal point"]
    lost += [edit for edit, each in _explained(repair) if each is POINT_LOST]
    decimals = [len(edit.text.partition(".")[2]) for edit in lost]
    decimals = [_DECIMALS - each if len(edit.text) > _LONG else each for edit, each in zip(lost, decimals, strict=True)]
    is_of_digits = repair.reason is Why.SLIP and any(each and each.is_of_digits for each in repair.slips) and not lost
    return (
        bool(repair.drawbacks),
        repair.reason,
        not repair.is_exact,
        repair.reason is Why.SLIP and not _has_round_points(repair),
        (SLIPS.index(SIGN_LOST) if is_sign else slip) if repair.reason is Why.SLIP else 0,
        round(size, 6) if is_sign else 0.0,
        sum(decimals),
        not repair.is_blamed,
        sum(_change(edit) for edit in repair.edits) if is_of_digits else 0,
        repair.warnings,
        is_other,
        [edit.text for edit in repair.edits if edit.text.startswith("\n")],
        repair.deviation,
        len(repair.edits),
        round(size, 6) if NEIGHBOUR not in repair.slips else 0,
    )


def _large_last(found: list[Repair], before: Contour | None) -> list[Repair]:
    """Repairs in order, behind the others those that make the contour more than twice as large as it was, or as the
    first one makes it; of several by the same slip in one word, as the smallest one. A slip that makes it several times
    as large as another slip does goes there, too."""
    sizes = [_size(each.contour) for each in found if each.contour and _is_alike(each, found[0])]
    if before is None and not sizes:
        return found
    largest = 2 * (_size(before) if before else min(sizes))
    by_slips = [_size(each.contour) for each in found if each.contour and each.reason is Why.SLIP]
    largest = min([largest, *(_SEVERAL * size for size in by_slips)])
    large = [
        each for each in found if each.contour and _size(each.contour) > largest and not all(map(_is_comma, each.edits))
    ]
    rest = [each for each in found if each not in large]
    return rest + [replace(each, drawbacks=(*each.drawbacks, _LARGE)) for each in large]


def _change(edit: Edit) -> float:
    """By how much a number is changed, of its size."""
    old, new = (_NUMBER.search(text) for text in (edit.old, edit.text))
    return abs(float(new[0]) / float(old[0]) - 1) if old and new and float(old[0]) else 1.0


_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)")


def _has_round_points(repair: Repair) -> bool:
    """Whether the intersections that a control computes come out at round numbers, which hardly happens by chance."""
    points = [at for name, at in repair.contour.points.items() if name.startswith("P")] if repair.contour else []
    return bool(points) and all(abs(round(each, 1) - each) <= AGREEMENT for at in points for each in at)


def _explained(repair: Repair) -> Iterator[tuple[Edit, Slip | None]]:
    return zip(repair.edits, repair.slips, strict=True)


def _is_again(repair: Repair, other: Repair) -> bool:
    """Whether a repair writes another value in the same words for the same contour, as R-50 for R50."""
    is_same = repair.contour is not None and repair.contour == other.contour
    changes = all(edit.kind is EditKind.CHANGE for edit in (*repair.edits, *other.edits))
    return is_same and changes and [edit.span for edit in repair.edits] == [edit.span for edit in other.edits]


def _is_alike(repair: Repair, other: Repair) -> bool:
    """Whether two repairs say that the same slip happened to the same words."""
    return repair.slips == other.slips and [edit.span for edit in repair.edits] == [edit.span for edit in other.edits]


_STRONG = (Why.ROUNDED, Why.SLIP, Why.FITS)
_SEVERAL, _DECIMALS, _LONG = 5, 3, 6
_LARGE = "more than twice as large"


def _size(contour: Contour) -> float:
    """The larger side of the rectangle around the points of a path, mm."""
    points = [contour.start, *(element.end for element in contour.elements)]
    return max(max(each[axis] for each in points) - min(each[axis] for each in points) for axis in (0, 1))
