"""A repair that is tried: the edits are applied to the text, and what comes out is read, checked and solved."""

import dataclasses
import re
from bisect import insort
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from decimal import Decimal
from functools import cached_property
from itertools import chain
from math import log2

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.edits import (
    Edit,
    EditKind,
    InsertionSide,
    Why,
    apply_edits,
    edit_facts,
    edited,
    has_plus,
    signed,
    with_plus,
)
from contoursolve.diagnosis.examine import LEADING, Answer, Depth, Policy, examine, problems
from contoursolve.diagnosis.examples import MOST_OPEN, numbers_for, propose, sampled
from contoursolve.diagnosis.plausibility import (
    OF_EDITS,
    ROUNDEST,
    Feature,
    Numbers,
    coarseness,
    cost_of,
    distance,
    familiarity,
    length_of,
    numbers_of,
    oddities,
    round_points,
    rounding_of,
    size_of,
    total,
)
from contoursolve.diagnosis.prospects import Prospects, keeps_address
from contoursolve.diagnosis.reach import Reach, is_of_codes
from contoursolve.diagnosis.slip_kinds import FEW, OF_DIGITS, ROUND, SlipKind, number_in, partners, recognise
from contoursolve.diagnosis.slips_around import (
    MOST_OF_DIGITS,
    MOST_TRIED as MOST_AROUND,
    Candidate,
    Marked,
    drafts_around,
    touches,
)
from contoursolve.diagnosis.subsets import LARGEST_ROLE
from contoursolve.diagnosis.window import Seen, Window, agrees, moves_of
from contoursolve.diagnostics import Applicability, Diagnostic, LineChange, NumberRange, OpenNumber, Severity, Span
from contoursolve.gcode import Block, parse_block, spell
from contoursolve.geometry import Profile, assemble
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
)
from contoursolve.tolerance import AGREEMENT

MOST_TRIED = 60
"""Changed blocks that are tried for one contour, fewer for a chain, whose every trial takes longer; beyond it the list
is not called complete."""

MOST_SEEN = 16
"""Repairs of one contour that are looked at with the blocks around it."""

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
    numbers: tuple[OpenNumber, ...] = ()
    """The numbers that it leaves open."""
    is_exact: bool = True
    """Whether its circles pass through their points, and do not only miss them by less than a control minds."""
    slips: tuple[SlipKind | None, ...] = ()
    """The slip that explains each edit."""
    drawbacks: tuple[str, ...] = ()
    """The reason, in words, for which it is unlikely to be meant."""
    beside: tuple[LineChange, ...] = ()
    """The lines outside the contour that it changes, too."""
    evidence: tuple[tuple[Feature, float], ...] = ()
    """The features that tell how plausible it is, with the amount of each."""

    @property
    def cost(self) -> float:
        """The cost of all of them: the higher, the less it is what was meant."""
        return round(total(self.evidence), 6)

    @property
    def cost_of_edits(self) -> float:
        """The part of it that is known before it is tried."""
        return total(each for each in self.evidence if each[0] in OF_EDITS)


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


class Trial(Struct, frozen=True, dict=True):
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
    window: Window | None = None
    """The blocks around it."""
    is_searched: bool = False
    """Whether several contours fit, which a search has found: each trial takes another one."""
    is_open: bool = False
    """Whether words are missing."""
    is_round: bool = False
    """Whether a finding is about a circle: any word of its block may place it wrongly."""
    is_missed: bool = False
    """Whether a circle is missed, so that its size may be wrong."""
    is_crossing_curves: bool = False
    """Whether it has points that are computed as those of two lines or circles."""
    is_spare: bool = False
    """Whether all that is wrong tells that a corner is one too many: the control leaves it out, or another one takes
    exactly its room."""
    prospects: Prospects | None = None
    """The words and lines that slips must change to undo what is wrong."""
    told: str = ""
    """The messages of its findings, which may name a word to add."""

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
        return replace(repair, slips=found)

    def _solve(self, edits: tuple[Edit, ...]) -> Repair | None:
        """The repair, if the changed block is read as the same form, accepted, and solved without a finding."""
        claim = self.claim
        texts = apply_edits(claim.blocks, edits)
        if texts == tuple(block.text for block in claim.blocks) and all(edit.is_in_block for edit in edits):
            return None
        replacement = edited(claim.blocks, edits)
        if any(edit.is_placeholder for edit in edits):
            example, kind = self._example(edits) or self._example_around(edits), Applicability.PLACEHOLDER
            return Repair(edits, replacement, kind, None, 0.0, example=example) if example else None
        answer = self.examine(edits)
        if answer is None:
            paths = (self._path_in_parts, self._path_beside_arcs) if _is_about_corners(edits, claim) else ()
            contour = next(filter(None, (path(edits) for path in paths)), None)
            return self.made(contour, edits, replacement) if contour else None
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
        repair = self.made(answer.contour, edits, replacement)
        return replace(
            repair,
            warnings=sum(each.code not in self.codes for each in rules),
            is_exact=all(each.about is not NoteKind.RADIUS_DIFFERS for each in answer.diagnostics),
        )

    @cached_property
    def marked(self) -> Marked:
        """The places that its findings mark: of an arc all its words, and where words are missing all of them."""
        lines = frozenset(span.line for span in self.blamed)
        own = list[Block]()
        if self.is_round:
            sizes = (*"IJK", self.dialect.modes.radius)
            arcs = [block for block in self.claim.blocks if any(map(block.find, sizes))]
            own += [block for block in arcs if block.line in lines] or arcs
        if self.is_missed:
            own += [block for block in self.claim.blocks if block.find(self.dialect.modes.radius)]
        own += self.claim.blocks if self.is_open and len(self.claim.blocks) <= _SHORT else ()
        spans = {word.span for block in own for word in block.words}
        return Marked(self.blamed | spans, lines | {block.line for block in own}, self.told)

    @cached_property
    def numbers(self) -> Numbers:
        """The numbers of the blocks around."""
        return numbers_of(self.window.blocks if self.window else self.claim.blocks)

    def drops_corner(self, edit: Edit) -> bool:
        """Whether an edit leaves out a corner that the control does not leave out: it stands on the drawing."""
        if edit.kind is not EditKind.DROP or self.is_spare:
            return False
        vocabulary = self.claim.vocabulary
        return edit.address in {vocabulary[name][0] for name in self.claim.form.outline.shapes if name in vocabulary}

    def strangeness(self, edit: Edit) -> float:
        """The cost of a word that is added seldom: one that no block around has, or that counts from where
        the tool is; more likely one that the finding names."""
        if self.drops_corner(edit):
            return 0.8
        if edit.kind is not EditKind.ADD or edit.address == "G":
            return 0.0
        if edit.address == self.claim.form.free.picking:
            return -2.5
        blocks = self.window.blocks if self.window else self.claim.blocks
        row, is_used = self.claim.lexicon.addresses.get(edit.address), any(block.find(edit.address) for block in blocks)
        is_named = re.search(rf"(?<![A-Z,#]){re.escape(edit.address)}(?![A-Z=])", self.told) is not None
        is_step = row is not None and (row.is_increment or "=" in edit.address)
        own = next((block for block in self.claim.blocks if block.line == edit.line), None)
        is_half = own is not None and any(map(own.find, partners(edit.address)))
        return 0.7 * (not is_used) + 0.8 * (is_step and not is_used) - 0.8 * is_named - _HALF * is_half

    def made(self, contour: Contour, edits: tuple[Edit, ...], replacement: str) -> Repair:
        """The repair that makes a contour, which may be parted into several, and lines between them."""
        reference = self.contour
        deviation = contour.deviation(reference) if reference else float("inf")
        is_same = reference is not None and contour.is_alike(reference) and deviation <= AGREEMENT
        # Another code does something else, whatever the path.
        is_same = is_same and not any(edit.kind is EditKind.CHANGE and is_of_codes(edit) for edit in edits)
        # Hardly anybody means a path across the spindle axis, unless it was there before.
        is_across = contour.crossing is not None and (reference is None or reference.crossing is None)
        is_safe = is_same and not any(_does_more(edit, self.claim) or self.drops_corner(edit) for edit in edits)
        applicability = Applicability.SAFE if is_safe else Applicability.CHANGES_CONTOUR
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
        return finding.code not in self.codes and not self.is_redundant and agrees(finding)

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

    def _example_around(self, edits: tuple[Edit, ...]) -> tuple[Edit, ...] | None:
        """The place of an axis that is added, halfway between those before and behind it, with which the blocks around
        are right: as several contours where the blocks were one. None for anything else."""
        window, row = self.window, self.claim.lexicon.addresses.get(edits[0].address)
        if window is None or len(edits) > 1 or row is None or not row.axis or row.is_increment:
            return None
        words = [word for block in window.blocks for word in block.words if word.address == edits[0].address]
        before = [word.number for word in words if word.number is not None and word.span.line < edits[0].line]
        behind = [word.number for word in words if word.number is not None and word.span.line > edits[0].line]
        if not before or not behind:
            return None
        number = f"{(before[-1] + behind[0]) / 2:f}"
        text = spell(edits[0].address, number if "." in number else f"{number}.")
        example = (dataclasses.replace(edits[0], text=text),)
        seen = window.after(example)
        return example if seen is not None and seen.answers and window.mends(seen) else None

    def with_numbers(self, repair: Repair) -> Repair:
        """A repair with placeholders, with the numbers that they may be; where hardly one is left, with that."""
        open_ = tuple(OpenNumber(edit.text, edit.line) for edit in repair.edits if edit.is_placeholder)
        found = self.find(repair.example) if repair.example != repair.edits else None
        profile = self._stated(found) if found is not None else None
        if repair.example != repair.edits and (found is None or len(open_) > MOST_OPEN):
            # The blocks are several contours then, or a range would say little: it holds for the others' examples only.
            found_texts = [
                edit.text for edit, old in zip(repair.example, repair.edits, strict=True) if old.is_placeholder
            ]
            tried = (replace(each, example=text) for each, text in zip(open_, found_texts, strict=True))
            return replace(repair, numbers=tuple(tried))
        if found is None or profile is None:
            return replace(repair, numbers=open_)

        def is_accepted(edits: tuple[Edit, ...]) -> bool:
            return self.repair(edits) is not None

        numbers = [*numbers_for(found, profile, repair.edits, repair.example, is_accepted)]
        is_fixed = all(each.is_complete and width <= _FIXED for each, width in numbers)
        valued = self.repair(repair.example) if is_fixed else None
        if valued is not None:
            return replace(valued, slips=repair.slips, evidence=repair.evidence)
        texts = iter([each.example for each, _ in numbers])
        example = tuple(dataclasses.replace(e, text=next(texts)) if e.is_placeholder else e for e in repair.edits)
        return replace(repair, example=example, numbers=tuple(each for each, _ in numbers))

    def _stated(self, claim: ParsedContour) -> Profile | None:
        """The profile of a contour with its further facts; None if one of them cannot be used."""
        profile = read(claim, frozenset())
        if not profile.is_extended:
            return profile
        from contoursolve.geometry import apply_statements  # noqa: PLC0415 - few blocks state more than their words

        profile, faults = apply_statements(profile, claim.directives, lambda: self.next_place)
        return None if faults else profile


_HALF = 2.4
"""By so much more plausible a word is that a point lacks, of which the other one is there."""


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


def _does_more(edit: Edit, claim: ParsedContour) -> bool:
    """Whether a word is dropped that does something besides the contour, or one is dropped or written that moves an
    axis outside the plane: the contour is the same, what the machine does is not."""
    written = re.match(r"[A-Za-z]+", edit.text.strip())
    rows = (claim.lexicon.addresses.get(each) for each in {edit.address, written[0].upper() if written else ""})
    is_beside = any(row is not None and row.axis and row.axis not in claim.before.plane.axes for row in rows)
    return is_beside or (edit.kind is EditKind.DROP and edit.errand is not None)


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


_SHORT = 12
"""Blocks of a contour in all of which a word may be missing."""


# Ranking -------------------------------------------------------------------------------------------------------------


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
    # With the blocks around them, as slips are.
    found = [_seen(each, trial) if at < _ENOUGH else each for at, each in enumerate(sorted(found, key=_order))]
    known = {each.edits: each for each in found}
    for each in _slips_around(trial, known.copy(), tried - known.keys()):
        other = known.get(each.edits)
        if other is None or each.cost_of_edits < other.cost_of_edits:
            known[each.edits] = each
    found = [*known.values()]
    found = [
        each
        for each in found
        if not any(set(other.edits) < set(each.edits) and other.cost <= each.cost for other in found)
    ]
    found = [_seen(each, trial) if at < MOST_SEEN else each for at, each in enumerate(sorted(found, key=_order))]
    found = _usual_marked(_large_marked(found, trial.contour))
    found.sort(key=_order)
    found = [each for at, each in enumerate(found) if not any(_is_again(each, other) for other in found[:at])]
    farthest = found[0].cost + _FARTHEST if found else 0.0
    found = [each for at, each in enumerate(found) if at < _ENOUGH or each.cost <= farthest or not any(each.slips)]
    found = [styled(trial.with_numbers(each) if each.example else each, trial) for each in found]
    added = frozenset((edit.address, edit.line) for edits in tried for edit in edits if edit.kind is EditKind.ADD)
    return Repairs(tuple(found), is_complete, has_tried_all=is_complete, tried=added)


def _slips_around(
    trial: Trial, known: Mapping[tuple[Edit, ...], Repair], refused: Set[tuple[Edit, ...]]
) -> Iterator[Repair]:
    """The slips of a contour and of the blocks around it that explain what is wrong: those of digits where no other
    one does."""
    window, claim = trial.window, trial.claim
    if window is None or not trial.marked.lines:
        return
    ranked = sorted(each.cost for each in known.values())
    paths = [_USUAL, *(_cost_of_path(each, trial) for each in known.values())]
    best = min(map(_doubt, known.values()), default=None)
    # What cannot be read is an error until an edit touches it.
    torn = {each.span for block in window.own for each in block.faults}

    def may_mend(edits: tuple[Edit, ...]) -> bool:
        is_whole = all(any(touches(edit, span) for edit in edits) for span in torn)
        return is_whole and (trial.prospects is None or trial.prospects.has(edits))

    for kinds in (FEW, OF_DIGITS):
        is_likely = best is not None and best < _LIKELY
        if kinds is OF_DIGITS and is_likely and not trial.is_crossing_curves:
            return
        drafts = drafts_around(window, trial.marked, claim, kinds, may_mend)
        most = MOST_AROUND if kinds is FEW else MOST_OF_DIGITS
        if kinds is OF_DIGITS and is_likely:
            # The sizes of circles that are missed, which few other slips explain.
            sizes = {*"IJK", window.dialect.modes.radius} if trial.is_missed else None
            most = MOST_AROUND if sizes else most
            drafts = [
                each
                for each in drafts
                if all(edit.span in trial.marked.spans for edit in each.edits)
                and (sizes is None or all(edit.address in sizes for edit in each.edits))
            ]
        most, tried = 0 if trial.is_searched else _fewer(most, len(claim.blocks)), 0
        for draft in drafts:
            own = known.get(draft.edits)
            if own is not None and own.cost_of_edits <= draft.cost:
                continue
            if draft.edits in refused and all(map(keeps_address, draft.edits)):
                continue
            if tried >= most or draft.cost + min(paths) - _PATH > _bound(ranked):
                break
            tried += 1
            seen = window.after(draft.edits)
            if seen is None or not window.mends(seen):
                continue
            lines = {*window.lines}
            answers = [each for each in seen.answers if lines.intersection(each.lines)]
            # Without a word, plain blocks may be left.
            is_plain = not answers and all(edit.kind is EditKind.DROP for edit in draft.edits)
            if not is_plain and (not answers or any(each.contour is None for each in answers)):
                continue
            repair = repair_of(draft, seen, answers, trial)
            best = _doubt(repair) if best is None else min(best, _doubt(repair))
            insort(ranked, repair.cost)
            paths.append(_cost_of_path(repair, trial))
            yield repair


def _fewer(most: int, length: int) -> int:
    """The number of drafts that are tried of a contour of so many blocks: fewer of a long one, whose every trial takes
    longer."""
    return most if length <= _SHORT else max(_FEWEST, most * _SHORT // length)


def _bound(costs: Sequence[float]) -> float:
    """The cost beyond which a further repair would hardly be among the first ones."""
    return min([*costs[_ENOUGH - 1 : _ENOUGH], *(each + _BEHIND for each in costs[:1])], default=float("inf"))


_FEWEST = 8
"""Drafts that are tried of the longest contours."""


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

_ENOUGH, _BEHIND, _PATH = 3, 1.0, 0.2
"""Repairs that are read, and by how much less plausible than the first one they may be; by so much another path may
cost less than the least of those that are known."""


def styled(repair: Repair, trial: Trial) -> Repair:
    """A repair whose words have their signs as those around have them."""
    window, blocks = trial.window, trial.claim.blocks
    around = window.blocks if window is not None else blocks
    edits, example = signed(repair.edits, around), signed(repair.example, around)
    if (edits, example) == (repair.edits, repair.example) and not (repair.numbers and has_plus(around)):
        return repair
    own = {block.line for block in blocks}
    beside = (
        tuple(each for each in window.changes(edits) if each.span.line not in own) if repair.beside and window else ()
    )
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


def repair_of(draft: Candidate, seen: Seen, answers: Sequence[Answer], trial: Trial) -> Repair:
    """A draft that was tried, with what it makes of the contour; of plain blocks, none is left."""
    contour = answers[0].contour if answers else None
    own = {block.line for block in trial.claim.blocks}
    within = [edit for edit in draft.edits if (edit.span.line if edit.span else edit.line) in own]
    replacement = edited(trial.claim.blocks, within)
    repair = Repair(draft.edits, replacement, Applicability.CHANGES_CONTOUR, None, 0.0)
    if contour is not None:
        repair = trial.made(contour, draft.edits, replacement)
    beside = (
        tuple(each for each in trial.window.changes(draft.edits) if each.span.line not in own) if trial.window else ()
    )
    evidence = _of_path(repair, seen, draft.evidence)
    if trial.window is not None:
        evidence = (*evidence, (Feature.BREAKS_BEHIND, float(trial.window.breaks_behind(seen))))
    # What is beside the contour draws a path, too, or says how it is followed.
    applicability = Applicability.CHANGES_CONTOUR if beside else repair.applicability
    return replace(repair, applicability=applicability, slips=draft.slips, evidence=evidence, beside=beside)


def _weighed(repair: Repair, trial: Trial) -> Repair:
    """A repair with what is known of it without the blocks around it."""
    edits, marked = repair.edits, trial.marked
    kind = sum(cost_of(edit, slip) + trial.strangeness(edit) for edit, slip in zip(edits, repair.slips, strict=True))
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
    return replace(repair, evidence=_of_path(repair, None, evidence))


_NAUGHT = 1.5
"""The cost of another value for a 0, which nobody types by mistake."""


def _is_naught(edit: Edit) -> bool:
    return edit.why is Why.AGREES and not number_in(edit.old).strip("0.")


_SIGNED = 0.8
"""The cost of a sign that changes with the value, which the others would have as well with the old sign."""


def _has_other_sign(edit: Edit) -> bool:
    return ("-" in edit.text) is not ("-" in edit.old)


def _seen(repair: Repair, trial: Trial) -> Repair:
    """A repair with what the blocks around it tell."""
    window, edits = trial.window, repair.edits if repair.contour is not None else repair.example
    if window is None or any(each[0] is Feature.SEEN for each in repair.evidence) or not edits:
        return repair
    if any(edit.is_placeholder for edit in edits):
        # Without its number, nothing says where the path leads.
        return replace(repair, evidence=(*repair.evidence, (Feature.SEEN, 0.0)))
    seen = window.after(edits)
    if seen is None:
        return repair
    kept = [each for each in repair.evidence if each[0] in OF_EDITS]
    new = (Feature.SEEN, float(not window.mends(seen)))
    behind = (Feature.BREAKS_BEHIND, float(window.breaks_behind(seen)))
    return replace(repair, evidence=(*_of_path(repair, seen, tuple(kept)), new, behind))


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
        (Feature.SAME, -float(contour is not None and repair.deviation <= AGREEMENT)),
        (Feature.EXACT, float(not repair.is_exact)),
        (Feature.WARNING, float(repair.warnings + len(_LEADING_ZERO.findall(repair.replacement)))),
        *(((Feature.SEEN, 0.0),) if seen is not None else ()),
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
    shortest = min(length_of(each.contour) for each in found if each.contour and each.cost <= best + _MARGIN)
    marked = []
    for each in found:
        times = log2(size_of(each.contour) / least) - 1 if each.contour and size_of(each.contour) else 0.0
        if each.contour and shortest:
            longer = max(log2(max(length_of(each.contour), AGREEMENT) / shortest), 0.0)
            each = replace(each, evidence=(*each.evidence, (Feature.LONG, longer)))  # noqa: PLW2901
        if times > 0:
            evidence = (*each.evidence, (Feature.LARGE, max(times - 1, 0.0)))
            each = replace(each, drawbacks=(*each.drawbacks, _LARGE), evidence=evidence)  # noqa: PLW2901
        marked.append(each)
    return marked


def _usual_marked(found: list[Repair]) -> list[Repair]:
    """Repairs; those whose path nobody knows turn as the most plausible one of the others does."""
    known = (dict(each.evidence) for each in found if each.contour or each.example != each.edits)
    turning = next((each[Feature.TURNING] for each in known if Feature.TURNING in each), _USUAL_TURNING)
    return [
        each if any(one[0] is Feature.TURNING for one in each.evidence) else
        replace(each, evidence=(*each.evidence, (Feature.TURNING, turning)))
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
        [(edit.span or Span(edit.line, 0, 0), edit.text) for edit in repair.edits],
    )


def _is_again(repair: Repair, other: Repair) -> bool:
    """Whether a repair writes another value in the same words for the same contour, as R-50 for R50."""
    is_same = repair.contour is not None and repair.contour == other.contour
    changes = all(edit.kind is EditKind.CHANGE for edit in (*repair.edits, *other.edits))
    return is_same and changes and [edit.span for edit in repair.edits] == [edit.span for edit in other.edits]


_LARGE = "more than twice as large"

_FIXED = 0.05
"""mm or degrees: a number that may differ by so much is fixed by the others, as closely as the control looks."""
