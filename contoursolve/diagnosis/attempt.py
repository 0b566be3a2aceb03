"""A repair that is tried: the edits are applied to the text, and what comes out is read, checked and solved."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from decimal import Decimal
from itertools import chain

from contoursolve.analysis import judge, order
from contoursolve.constraints import assemble
from contoursolve.contour import Contour
from contoursolve.diagnosis.edits import Edit, EditKind, Side, apply_edits, edit_facts
from contoursolve.diagnosis.examples import propose, sampled
from contoursolve.diagnosis.subsets import LARGEST_ROLE
from contoursolve.diagnostic import Applicability, Diagnostic, Severity
from contoursolve.dialects import Dialect
from contoursolve.examine import Answer, Policy, examine
from contoursolve.model import Profile
from contoursolve.reading import Claim, Trouble, advance, read
from contoursolve.solving import Status
from contoursolve.solving.affine import affine_facts
from contoursolve.syntax import Block, mended, parse_block
from contoursolve.tolerance import AGREEMENT

MOST_TRIED = 60
"""Changed blocks that are tried for one contour, fewer for a chain, whose every trial takes longer; beyond it the list
is not called complete."""

MOST_CONSIDERED = 2_000
"""Changed blocks that are looked at for one contour; most of them contain a repair that was found before."""

EASY_STEP, LARGEST_STEP = 4, 12
"""Unknowns of one step: up to the first it takes milliseconds; beyond the second a search can take a minute, and a
draft is not tried."""

SLOW = 15
"""Drafts that one with a step between these counts for; it can take a second."""


@dataclass(frozen=True, slots=True)
class Before:
    """The contour before its repair: its codes, its path if there is one, and where the next block's line ends."""

    codes: frozenset[str]
    contour: Contour | None
    next_place: tuple[Decimal, Decimal] | None = None
    following: tuple[Block, ...] = ()
    """The blocks after it, of which a corner needs one."""


@dataclass(frozen=True, slots=True)
class Repair:
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


@dataclass(frozen=True, slots=True)
class Repairs:
    """Repairs, best first: fewest edits, smallest change of the contour.

    `is_complete` tells that all smallest sets of words to drop and add, up to `MOST_EDITS`, were tried.
    """

    repairs: tuple[Repair, ...]
    is_complete: bool


def choose_repairs(
    claim: Claim, dialect: Dialect, stages: Iterable[Iterable[tuple[Edit, ...]]], before: Before
) -> Repairs:
    """The drafts that are repairs, none of which contains another one; of each stage after what came before."""
    found: list[Repair] = []
    tried: set[tuple[Edit, ...]] = set()
    spent = 0
    most = MOST_TRIED if len(claim.blocks) <= LARGEST_ROLE else max(8, 2 * MOST_TRIED // len(claim.blocks))
    considered = 0
    for edits in chain.from_iterable(stages):
        considered += 1
        if len(tried) + spent > most or considered > MOST_CONSIDERED:
            break
        if edits not in tried and not any(set(other.edits) <= set(edits) for other in found):
            tried.add(edits)
            repair = _try(claim, dialect, edits, before)
            found += [repair] if repair else []
            spent += _extra(claim, dialect, edits, before)
    found = [repair for repair in found if not any(set(other.edits) < set(repair.edits) for other in found)]
    found.sort(key=_order)
    return Repairs(tuple(found), is_complete=len(tried) + spent <= most and considered <= MOST_CONSIDERED)


def _order(repair: Repair) -> tuple[bool, bool, int, int, float]:
    is_placeholder = repair.applicability is Applicability.PLACEHOLDER
    # A forgotten point or comma is the commonest slip, and one slip however many words lack it; so is what looks
    # almost like a number.
    is_slip = all(edit.text == f"{edit.old}." or _is_comma(edit) or _is_mended(edit) for edit in repair.edits)
    return is_placeholder, not is_slip, len(repair.edits), repair.warnings, repair.deviation


def _try(claim: Claim, dialect: Dialect, edits: tuple[Edit, ...], before: Before) -> Repair | None:
    """The repair, if the changed block is read as the same form, accepted, and solved without a finding."""
    texts = apply_edits(claim.blocks, edits)
    if texts == tuple(block.text for block in claim.blocks) and all(edit.is_in_block for edit in edits):
        return None
    replacement = "\n".join(texts)
    if any(edit.is_placeholder for edit in edits):
        example = _example(claim, dialect, edits, before)
        return Repair(edits, replacement, Applicability.PLACEHOLDER, None, 0.0, example=example) if example else None
    answer = examine_edited(claim, dialect, edits, before)
    if answer is None or answer.contour is None or not _is_settled(answer, edits):
        return None
    # No change of the block moves its start.
    findings = [each for each in answer.diagnostics if each.severity is not Severity.INFO and not _is_before(each)]
    rules = [each for each in findings if (answer.profile.is_extended and _is_rule(each)) or _is_crossing(each)]
    if not all(each in rules or _now_agrees(each, before) for each in findings):
        return None
    reference = before.contour
    deviation = answer.contour.deviation(reference) if reference else float("inf")
    is_same = reference is not None and answer.contour.is_alike(reference) and deviation <= AGREEMENT
    is_safe = is_same and not any(_drops_more(edit, claim) for edit in edits)
    applicability = Applicability.SAFE if is_safe else Applicability.CHANGES_CONTOUR
    warnings = sum(each.code not in before.codes for each in rules)
    return Repair(edits, replacement, applicability, answer.contour, deviation, warnings)


def _drops_more(edit: Edit, claim: Claim) -> bool:
    """Whether a word is dropped that does something besides the contour, or moves an axis outside the plane: the
    contour is the same, what the machine does is not."""
    row = claim.lexicon.addresses.get(edit.address)
    is_beside = row is not None and bool(row.axis) and row.axis not in claim.before.plane.axes
    return edit.kind is EditKind.DROP and (is_beside or edit.errand is not None)


def _is_settled(answer: Answer, edits: tuple[Edit, ...]) -> bool:
    """Whether it is solved. A value that was corrected may then say what the others say."""
    if answer.status is Status.OVERDETERMINED:
        return answer.profile.is_extended and any(edit.kind is EditKind.CHANGE for edit in edits)
    return answer.status is Status.SOLVED


def _is_before(finding: Diagnostic) -> bool:
    """Whether it is about what stands before the contour."""
    return finding.about is Trouble.START_IN_INCREMENTS


def _is_crossing(finding: Diagnostic) -> bool:
    """Whether the path crosses the spindle axis, which may be meant."""
    return finding.about is Trouble.AXIS_CROSSED


def _is_rule(finding: Diagnostic) -> bool:
    """Whether it is a rule of the manual, which only warns where more is stated or asked than the control reads."""
    return finding.about is None and finding.severity is Severity.WARNING


def _now_agrees(finding: Diagnostic, before: Before) -> bool:
    """Whether a finding that the block did not have before says only that a word now agrees."""
    is_new = finding.code not in before.codes and finding.severity is Severity.WARNING
    return is_new and finding.values.get("off_by_mm", float("inf")) <= AGREEMENT


def examine_edited(claim: Claim, dialect: Dialect, edits: tuple[Edit, ...], before: Before) -> Answer | None:
    """The answer to the edited blocks; None where they are not read as the same contour any more."""
    found = _find(claim, dialect, edits, before.following)
    if found is None or _largest_step(found, before) > LARGEST_STEP:
        return None
    return examine(found, dialect.rules, Policy.ENFORCE, lambda: before.next_place)


def _extra(claim: Claim, dialect: Dialect, edits: tuple[Edit, ...], before: Before) -> int:
    """How many more drafts trying these edits counts for."""
    found = _find(claim, dialect, edits) if claim.directives else None
    return SLOW - 1 if found and EASY_STEP < _largest_step(found, before) <= LARGEST_STEP else 0


def _largest_step(found: Claim, before: Before) -> int:
    """The number of unknowns that further facts make one step determine together; 0 for ordinary words."""
    profile = read(found, frozenset())
    if not profile.is_extended:
        return 0
    profile, is_usable = _with_facts(profile, found, before.next_place)
    if not is_usable:
        return 0
    system = assemble(profile)
    verdict = judge(system)
    if not verdict.is_determined:
        return 0
    return max(len(group.unknowns) for group in order(system, [system.facts[index] for index in verdict.basis]))


def _with_facts(profile: Profile, claim: Claim, next_place: tuple[Decimal, Decimal] | None) -> tuple[Profile, bool]:
    """The profile with the further facts, and whether all of them could be used."""
    from contoursolve.statements import apply_statements  # noqa: PLC0415 - few blocks state more than their words

    extended, faults = apply_statements(profile, claim.directives, lambda: next_place)
    return extended, not faults


def _is_comma(edit: Edit) -> bool:
    """Whether the address gets a comma or loses it."""
    return edit.kind is EditKind.CHANGE and edit.text != edit.old and edit.text.strip(", ") == edit.old.strip(", ")


def _is_mended(edit: Edit) -> bool:
    """Whether what could not be read becomes the word that it looks like."""
    return edit.kind is EditKind.CHANGE and edit.text == mended(edit.old)


def _find(claim: Claim, dialect: Dialect, edits: tuple[Edit, ...], following: tuple[Block, ...] = ()) -> Claim | None:
    texts = apply_edits(claim.blocks, edits)
    lines = [(part, block.line) for text, block in zip(texts, claim.blocks, strict=True) for part in text.split("\n")]
    before, blocks, behind = _parted([parse_block(*line) for line in lines], edits)
    state = claim.before
    for block in before:
        state = advance(state, block, dialect.modes)
    apart = edit_facts([each for each in claim.directives if each.span.line < 0], edits)
    blocks[-1] = replace(blocks[-1], directives=(*blocks[-1].directives, *apart))
    more = following if all(map(_is_comma, edits)) else ()
    found = dialect.find([*blocks, *more], 0, state, dialect.modes)
    others = (dialect.find([*before, *behind], index, state, dialect.modes) for index in range(len(before + behind)))
    if not isinstance(found, Claim) or any(isinstance(each, Claim) for each in others):
        return None
    return found if len(found.blocks) == len(blocks) or (more and len(found.blocks) > len(blocks)) else None


def _parted(blocks: list[Block], edits: tuple[Edit, ...]) -> tuple[list[Block], list[Block], list[Block]]:
    """Blocks as those of words that were moved before the contour, its own, and those of words moved behind it."""
    sides = [edit.errand.side for edit in edits if edit.kind is EditKind.MOVE and edit.errand]
    first, last = sides.count(Side.BEFORE), len(blocks) - sides.count(Side.BEHIND)
    return blocks[:first], blocks[first:last], blocks[last:]


def _example(claim: Claim, dialect: Dialect, edits: tuple[Edit, ...], before: Before) -> tuple[Edit, ...] | None:
    """The edits with a number for every placeholder that makes a contour; as they are where further facts are stated,
    if these determine the drawing whatever the numbers are. None if nothing is found."""
    found = _find(claim, dialect, sampled(edits))
    if found is None:
        return None
    profile = read(found, frozenset())
    if profile.is_extended:
        profile, is_stated = _with_facts(profile, found, before.next_place)
        return edits if is_stated and judge(assemble(profile)).is_determined else None
    affine = affine_facts(profile, profile.facts)
    if affine is not None and affine.freedoms():
        return None
    return next((each for each in propose(found, profile, edits) if _try(claim, dialect, each, before)), None)
