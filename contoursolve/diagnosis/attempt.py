"""A repair that is tried: the edits are applied to the text, and what comes out is read, checked and solved."""

import dataclasses
import re
from collections.abc import Callable, Container, Iterator
from decimal import Decimal
from enum import Enum
from functools import cached_property, lru_cache
from itertools import pairwise

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
    read_edited,
)
from contoursolve.diagnosis.examine import MOST_CHOICES, Answer, Depth, Policy, count_choices, examine, problems
from contoursolve.diagnosis.examples import MOST_OPEN, numbers_for, propose, sampled
from contoursolve.diagnosis.plausibility import (
    OF_EDITS,
    Feature,
    NumbersAround,
    cost_of,
    numbers_of,
    total,
)
from contoursolve.diagnosis.prospects import Prospects
from contoursolve.diagnosis.reach import Reach, is_of_codes
from contoursolve.diagnosis.slip_kinds import ROUND, SlipKind, partners, recognise
from contoursolve.diagnosis.slips_around import (
    OPEN,
    Marked,
    Prices,
)
from contoursolve.diagnosis.spelling import torn_codes
from contoursolve.diagnosis.stated_values import Geometry
from contoursolve.diagnosis.subsets import blamed_spans
from contoursolve.diagnosis.window import LINE, Seen, Window, alone, parts_of, path_of
from contoursolve.diagnostics import Applicability, Diagnostic, LineChange, OpenNumber, Span
from contoursolve.gcode import Block
from contoursolve.geometry import FIRST, SECOND, Profile, Unit, assemble, scalar
from contoursolve.reading import Control, ParsedContour, ReadIssue, advance, read
from contoursolve.solving import (
    Contour,
    NoteKind,
    RefusalKind,
    Status,
    affine_facts,
    analyse,
    groups_of,
    is_closed,
    is_given_up,
)
from contoursolve.tolerance import AGREEMENT

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
    slips: tuple[SlipKind | None, ...] = ()
    """The slip that explains each edit."""
    drawbacks: tuple[str, ...] = ()
    """The reason, in words, for which it is unlikely to be meant."""
    beside: tuple[LineChange, ...] = ()
    """The lines outside the contour that it changes, too."""
    is_double: bool = False
    """Whether it undoes two slips, of which none alone explains what is wrong."""
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
    `tried` are the words that were tried to be added, by address and line; `is_cut` tells that the search ended before
    all that it thought of was tried.
    """

    repairs: tuple[Repair, ...]
    is_complete: bool
    has_tried_all: bool = False
    tried: frozenset[tuple[str, int]] = frozenset()
    is_cut: bool = False


class Trial(Struct, frozen=True, dict=True):
    """A contour on which edits are tried: as it is answered, with the blocks around it (`window`).

    `about` has the places and the message of the finding that is to be mended, where it is not all that is wrong; it
    `is_frequent` where each contour of a program may have the same: fewer slips are tried then.
    """

    answer: Answer
    control: Control
    window: Window
    about: tuple[frozenset[Span], str] | None = None
    is_frequent: bool = False

    @property
    def claim(self) -> ParsedContour:
        """Its blocks as they are read."""
        return self.answer.claim

    @cached_property
    def lines(self) -> frozenset[int]:
        """Those of its blocks."""
        return frozenset(block.line for block in self.claim.blocks)

    @cached_property
    def problems(self) -> list[Diagnostic]:
        """The findings that are to be mended; none where a finding is given."""
        return [] if self.about else problems(self.answer)

    @cached_property
    def own(self) -> Window:
        """Its blocks alone: a number that is still to be chosen says nothing of those behind."""
        return alone(self.answer, self.control)

    @cached_property
    def codes(self) -> frozenset[str]:
        """The codes of its findings."""
        return frozenset(each.code for each in self.answer.diagnostics)

    @cached_property
    def told(self) -> str:
        """The messages of its findings, which may name a word to add."""
        return self.about[1] if self.about else " ".join(each.message for each in self.problems)

    @cached_property
    def contour(self) -> Contour | None:
        """Its path; of one that rules refuse, the path without them."""
        answer = self.answer
        is_refused = answer.contour is None and answer.start.is_known and not answer.profile.is_extended
        if not is_refused or torn_codes(answer.claim) or count_choices(answer.profile) > MOST_CHOICES:
            return answer.contour
        return examine(answer.claim, self.control, Policy.OFF).contour

    @cached_property
    def next_place(self) -> tuple[Decimal, Decimal] | None:
        """The end of the line of the next block, if a fact is about it and it was known."""
        profile = self.answer.profile
        for line in profile.figure.lines if profile.is_extended else ():
            names = scalar(line.head, FIRST), scalar(line.head, SECOND)
            if line.name.endswith(".landing") and line.head and profile.givens.keys() >= {*names}:
                return profile.givens[names[0]].value, profile.givens[names[1]].value
        return None

    @cached_property
    def reach(self) -> Reach | None:
        """The parts that edits leave as they are."""
        return Reach(self.answer) if self.problems and self.answer.start.is_known else None

    @cached_property
    def geometry(self) -> Geometry:
        """The values that its words fix of the drawing."""
        return Geometry.of(self.claim)

    @cached_property
    def prospects(self) -> Prospects | None:
        """The words and lines that slips must change to undo what is wrong."""
        if not self.problems:
            return None
        is_plain = self.answer.start.is_known and not self.answer.profile.is_extended
        conflicts = [each.facts for each in self.geometry.conflicts] if is_plain else ()
        return Prospects.of(self.answer, self.control.rules, conflicts, self.reach, self.window.blocks)

    def is_about(self, kinds: Container[Enum | None]) -> bool:
        """Whether a problem is about one of some events."""
        return any(each.about in kinds for each in self.problems)

    @cached_property
    def is_searched(self) -> bool:
        """Whether several contours fit, which a search has found, or one was given up: each trial takes another one."""
        answer = self.answer
        several = answer.alternatives if answer.status in (Status.AMBIGUOUS, Status.UNDECIDED) else None
        if several is not None and several.reach is not None:
            return True
        # Beside what is open, each trial gives up the same search again.
        is_open = answer.start.is_known and answer.profile.is_extended and self.is_about(OPEN)
        return is_open and is_given_up(answer.profile)

    @cached_property
    def is_crossing_curves(self) -> bool:
        """Whether it has points that are computed as those of two lines or circles."""
        profile = self.answer.profile
        return not self.about and not profile.is_extended and any(each[0] == "P" for each in profile.intersections)

    @cached_property
    def is_missed(self) -> bool:
        """Whether a circle is missed, so that its size may be wrong."""
        return not self.about and any(each.about is RefusalKind.CIRCLE_MISSED for each in self.answer.diagnostics)

    @cached_property
    def is_spare(self) -> bool:
        """Whether all that is wrong tells that a corner is one too many: the control leaves it out, or another one
        takes exactly its room."""
        found = self.problems
        return bool(found) and all(each.about is ReadIssue.CORNER_DROPPED or _is_filled(each) for each in found)

    def repair(self, edits: tuple[Edit, ...], window: Window | None = None) -> Repair | None:
        """The repair with the reasons for it, if it is one."""
        if any(edit.span in self.claim.trusted for edit in edits):
            return None
        if self.reach is not None and self.reach.leaves_a_problem(edits):
            return None
        repair = self._solve(edits, window or self.window)
        if repair is None:
            return None
        found = tuple(recognise(edit, self.claim) or (ROUND if _is_round(edit) else None) for edit in edits)
        return replace(repair, slips=found)

    def _solve(self, edits: tuple[Edit, ...], window: Window) -> Repair | None:
        """The repair, if the changed block is read as the same form, accepted, and solved without a finding."""
        claim = self.claim
        texts = apply_edits(claim.blocks, edits)
        if texts == tuple(block.text for block in claim.blocks) and all(edit.is_in_block for edit in edits):
            return None
        replacement = edited(claim.blocks, edits)
        if any(edit.is_placeholder for edit in edits):
            example, kind = self._example(edits) or self._example_around(edits), Applicability.PLACEHOLDER
            return Repair(edits, replacement, kind, None, 0.0, example=example) if example else None
        # Either sign makes the contour where two elements only touch.
        is_choice = all(edit.kind is EditKind.ADD and edit.address in _choices(self.claim) for edit in edits)
        seen = window.mended(edits, {NoteKind.TOUCHES} if is_choice else ())
        is_parted = all(edit.kind is EditKind.DROP and edit.span in self._parting for edit in edits)
        if seen is None or not (is_parted or self._is_whole(seen)):
            return None
        contour = path_of(seen, self.lines)
        if contour is None and any(part.after.motion != LINE for part in parts_of(seen, self.lines)):
            contour = self._path_beside_arcs(edits)
        if contour is None or (contour.crossing is not None and self.is_about({ReadIssue.AXIS_CROSSED})):
            return None
        return self.made(contour, edits, replacement)

    def _path_beside_arcs(self, edits: tuple[Edit, ...]) -> Contour | None:
        """The path of the same elements, arcs among them that are none without a corner, without words that are
        dropped."""
        if any(edit.kind is not EditKind.DROP for edit in edits):
            return None
        claim, spans = self.claim, {edit.span for edit in edits}
        words = {name: word for name, word in claim.words.items() if word.span not in spans}
        givens = {name: each for name, each in claim.givens.items() if name in words or name not in claim.words}
        changed = dataclasses.replace(claim, words=words, givens=givens)
        answer = examine(changed, self.control, Policy.ENFORCE)
        return answer.contour if answer.status is Status.SOLVED and not problems(answer) else None

    def _is_whole(self, seen: Seen) -> bool:
        """Whether its blocks are still one contour, or part of one."""
        parts = parts_of(seen, self.lines)
        return any(part.answer is not None and {block.line for block in part.blocks} >= self.lines for part in parts)

    @cached_property
    def _parting(self) -> frozenset[Span]:
        """The words of corners, and of the angles of lines whose ends are stated: without them, plain blocks may be
        left."""
        claim = self.claim
        sizes = (name for name in claim.form.outline.shapes if name in claim.words)
        return frozenset(claim.words[name].span for name in (*sizes, *_spare_angles(claim)))

    @cached_property
    def marked(self) -> Marked:
        """The places that its findings mark: of an arc all its words, and where words are missing all of them."""
        blamed = self.about[0] if self.about else frozenset(blamed_spans(self.answer))
        lines = frozenset(span.line for span in blamed)
        own = list[Block]()
        if self.is_about(_OF_CIRCLES):
            # Any word of its block may place a circle wrongly.
            sizes = (*"IJK", self.control.modes.radius)
            arcs = [block for block in self.claim.blocks if any(map(block.find, sizes))]
            own += [block for block in arcs if block.line in lines] or arcs
        if self.is_missed:
            own += [block for block in self.claim.blocks if block.find(self.control.modes.radius)]
        own += self.claim.blocks if self.is_about(OPEN) and len(self.claim.blocks) <= SHORT else ()
        spans = {word.span for block in own for word in block.words}
        events = frozenset(each.about for each in self.answer.diagnostics if each.about and not self.about)
        return Marked(blamed | spans, lines | {block.line for block in own}, self.told, events)

    @cached_property
    def _prices(self) -> Prices:
        return Prices.of(self.window, self.marked, self.claim)

    def price(self, edit: Edit, slip: SlipKind | None) -> float:
        """The cost of an edit for what it undoes; of a slip, the same whichever way it is found."""
        return cost_of(edit, slip) if slip is None else self._prices.price(edit, slip)

    @cached_property
    def numbers(self) -> NumbersAround:
        """The numbers of the blocks around."""
        return numbers_of(self.window.blocks)

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
        blocks = self.window.blocks
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

    def examine(self, edits: tuple[Edit, ...]) -> Answer | None:
        """The answer to the edited blocks; None where they are not read as the same contour any more."""
        found = self.find(edits)
        if found is None or self._largest_step(found) > LARGEST_STEP:
            return None
        return examine(found, self.control, Policy.ENFORCE, lambda: self.next_place, Depth.TRIAL)

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
        return self._lately(edits)

    @cached_property
    def _lately(self) -> Callable[[tuple[Edit, ...]], ParsedContour | None]:
        """The same, of a few edits kept: those of one word are asked for again."""
        return lru_cache(maxsize=16)(self._find)

    def _find(self, edits: tuple[Edit, ...]) -> ParsedContour | None:
        claim, control = self.claim, self.control
        texts = apply_edits(claim.blocks, edits)
        read = [
            again
            for text, block, same in zip(texts, claim.blocks, self._blocks, strict=True)
            if text or not block.text
            for again in ([same] if text == block.text else self._read(block, text))
        ]
        ahead, blocks, behind = _parted(read, edits)
        if not blocks:
            return None
        state = claim.before
        for block in ahead:
            state = advance(state, block, control.modes)
        apart = edit_facts([each for each in claim.directives if each.span.line < 0], edits)
        blocks[-1] = replace(blocks[-1], directives=(*blocks[-1].directives, *apart))
        found = control.find(blocks, 0, state, control.modes)
        others = (control.find([*ahead, *behind], index, state, control.modes) for index in range(len(ahead + behind)))
        if not isinstance(found, ParsedContour) or any(isinstance(each, ParsedContour) for each in others):
            return None
        return found if len(found.blocks) == len(blocks) else None

    @cached_property
    def _blocks(self) -> list[Block]:
        """The blocks as they are, each by itself."""
        return [block for each in self.claim.blocks for block in self._read(each, each.text)]

    def _read(self, block: Block, text: str) -> list[Block]:
        return read_edited(block, text, self.control.modes.syntax)

    def _example(self, edits: tuple[Edit, ...]) -> tuple[Edit, ...] | None:
        """The edits with a number for every placeholder that makes a contour; as they are where further facts determine
        a drawing that has no closed form. None if nothing is found."""
        found = self.find(sampled(edits, self.claim.lexicon))
        profile = self._stated(found) if found else None
        if found is None or profile is None or not profile.start.is_known:
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
        return next((each for each in propose(found, profile, edits) if self.repair(each, self.own)), None)

    def _example_around(self, edits: tuple[Edit, ...]) -> tuple[Edit, ...] | None:
        """The place of an axis that is added, halfway between those before and behind it, with which the blocks around
        are right: as several contours where the blocks were one. None for anything else."""
        window, row = self.window, self.claim.lexicon.addresses.get(edits[0].address)
        if len(edits) > 1 or row is None or not row.axis or row.is_increment:
            return None
        words = [word for block in window.blocks for word in block.words if word.address == edits[0].address]
        before = [word.number for word in words if word.number is not None and word.span.line < edits[0].line]
        behind = [word.number for word in words if word.number is not None and word.span.line > edits[0].line]
        if not before or not behind:
            return None
        number = f"{(before[-1] + behind[0]) / 2:f}"
        text = self.claim.lexicon.spell(edits[0].address, number if "." in number else f"{number}.")
        example = (dataclasses.replace(edits[0], text=text),)
        seen = window.after(example)
        return example if seen is not None and any(seen.answers) and window.mends(seen) else None

    def with_numbers(self, repair: Repair, *, may_try: bool) -> Repair:
        """A repair with placeholders, with the numbers that they may be; where hardly one is left, with that. Where
        none is computed, some are tried if they may be."""
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
            example = self._tried_number(repair.edits) if may_try and len(open_) == 1 else None
            if example is None:
                return replace(repair, numbers=open_)
            text = next(new.text for new, old in zip(example, repair.edits, strict=True) if old.is_placeholder)
            return replace(repair, example=example, numbers=(replace(open_[0], example=text),))

        def is_accepted(edits: tuple[Edit, ...]) -> bool:
            return self.repair(edits, self.own) is not None

        numbers = [*numbers_for(found, profile, repair.edits, repair.example, is_accepted)]
        is_fixed = all(each.is_complete and width <= _FIXED for each, width in numbers)
        valued = self.repair(repair.example) if is_fixed else None
        if valued is not None:
            return replace(valued, slips=repair.slips, evidence=repair.evidence)
        texts = iter([each.example for each, _ in numbers])
        example = tuple(dataclasses.replace(e, text=next(texts)) if e.is_placeholder else e for e in repair.edits)
        return replace(repair, example=example, numbers=tuple(each for each, _ in numbers))

    def _tried_number(self, edits: tuple[Edit, ...]) -> tuple[Edit, ...] | None:
        """The edits with a number for their only placeholder that makes a contour, of those that drawings have and the
        words around suggest; None if none does."""
        (place,) = (at for at, edit in enumerate(edits) if edit.is_placeholder)
        row = self.claim.lexicon.addresses.get(edits[place].address)
        if row is None:
            return None
        blocks = self.window.blocks
        rows = self.claim.lexicon.addresses
        known = sorted(
            {
                word.number
                for block in blocks
                for word in block.words
                if word.number is not None and word.address in rows and rows[word.address].axis == row.axis
                and rows[word.address].unit is row.unit
            }
        )  # fmt: skip
        between = [(one + two) / 2 for one, two in pairwise(known)]
        numbers = _USUAL_ANGLES if row.unit is Unit.DEGREE else [*between, *known]
        if not row.axis and row.unit is not Unit.DEGREE:
            # Nothing has a size of 0.
            numbers = [each for each in numbers if each > 0]
        for number in numbers[:_MOST_NUMBERS]:
            edit = dataclasses.replace(edits[place], text=self.claim.lexicon.spell(edits[place].address, f"{number:f}"))
            tried = (*edits[:place], edit, *edits[place + 1 :])
            if self._solve(tried, self.own) is not None:
                return tried
        return None

    def _stated(self, claim: ParsedContour) -> Profile | None:
        """The profile of a contour with its further facts; None if one of them cannot be used."""
        profile = read(claim, frozenset())
        if not profile.is_extended:
            return profile
        from contoursolve.geometry import apply_statements  # noqa: PLC0415 - few blocks state more than their words

        profile, faults = apply_statements(profile, claim.directives, lambda: self.next_place)
        return None if faults else profile


_USUAL_ANGLES = [Decimal(each) for each in (45, 135, 90, 30, 60, 120, 150, 0)]
"""Degrees."""

_MOST_NUMBERS = 8
"""Numbers that are tried for one placeholder, where none can be computed."""

_OF_CIRCLES = tuple(kind for kind in RefusalKind if re.search("radius|circle", kind.event.code))


def _is_filled(finding: Diagnostic) -> bool:
    """Whether each of two corners alone takes exactly the room of the other one, which hardly happens by chance."""
    return all(abs(finding.values.get(each, float("inf"))) <= AGREEMENT for each in ("limit_first", "limit_second"))


_HALF = 2.4
"""By so much more plausible a word is that a point lacks, of which the other one is there."""


def _is_round(edit: Edit) -> bool:
    """Whether a word gets a round number from the others, which hardly happens by chance."""
    return edit.why is Why.AGREES and len(edit.text.partition(".")[2]) <= 1 and edit.kind is EditKind.CHANGE


def _choices(claim: ParsedContour) -> set[str]:
    """The addresses of words of which only the sign counts."""
    return {claim.vocabulary[name][0] for name in claim.form.choices if name in claim.vocabulary}


def _spare_angles(claim: ParsedContour) -> Iterator[str]:
    """The angles of lines that have both coordinates of their end, and begin where the block before ends."""
    prefixes = {role.prefixes[0] for role in claim.form.roles if role.name == "line"}
    for row in claim.form.outline.facts:
        given = row.fact.given or ""
        prefix = given[: given.find(":") + 1]
        if row.fact.heading and given in claim.words and prefix in prefixes:
            ends = ((f"{prefix}{axis}", f"{prefix}{axis}-step") for axis in ("first", "second"))
            if all(any(name in claim.words for name in names) for names in ends):
                yield given


def _does_more(edit: Edit, claim: ParsedContour) -> bool:
    """Whether a word is dropped that does something besides the contour, or one is dropped or written that moves an
    axis outside the plane: the contour is the same, what the machine does is not."""
    written = re.match(r"[A-Za-z]+", edit.text.strip())
    rows = (claim.lexicon.addresses.get(each) for each in {edit.address, written[0].upper() if written else ""})
    is_beside = any(row is not None and row.axis and row.axis not in claim.before.plane.axes for row in rows)
    return is_beside or (edit.kind is EditKind.DROP and edit.errand is not None)


def _parted(blocks: list[Block], edits: tuple[Edit, ...]) -> tuple[list[Block], list[Block], list[Block]]:
    """Blocks as those of words that were moved before the contour, its own, and those of words moved behind it."""
    sides = [edit.errand.side for edit in edits if edit.kind is EditKind.MOVE and edit.errand]
    first, last = sides.count(InsertionSide.BEFORE), len(blocks) - sides.count(InsertionSide.AFTER)
    return blocks[:first], blocks[first:last], blocks[last:]


SHORT = 12
"""Blocks of a contour in all of which a word may be missing."""


_FIXED = 0.05
"""mm or degrees: a number that may differ by so much is fixed by the others, as closely as the control looks."""
