"""Problems that a change of words in a long chain cannot mend: those that rest on other blocks alone.

A rule sees the blocks of one role, and an element rests on the facts that determine its points. A problem whose blocks
no edit touches is there behind the edit as before it, so that nothing has to be read or solved to refuse the repair.
"""

import re
from collections.abc import Collection, Iterable, Sequence
from functools import cached_property

from msgspec import Struct

from contoursolve.diagnosis.edits import Edit, EditKind
from contoursolve.diagnosis.examine import Answer, problems
from contoursolve.diagnostics import Diagnostic, Severity, Span
from contoursolve.geometry import (
    FIRST,
    SECOND,
    System,
    assemble,
    scalars_of,
)
from contoursolve.reading import ParsedContour, ReadIssue
from contoursolve.solving import Group, RefusalKind, analyse, groups_of

MOST_HELD = 8
"""Problems of one contour, about, that edits are held against; more of them refuse no more edits of few words."""

MOST_GROUPS = 24
"""Groups of facts that are followed from one problem; what rests on more of them is left to the trial."""

_BESIDE = 3
"""Blocks on either side of what a problem rests on that count with it: a corner lies between two elements, and those
have a corner at their other ends."""

_OF_ELEMENTS = (
    *(kind for kind in RefusalKind if kind.event.is_local),
    ReadIssue.CORNER_DROPPED,
    ReadIssue.CORNER_NEGATIVE,
)
"""Matters of a problem that rests on the form of the elements around its block alone, wherever they lie."""

_ENDS = frozenset({"first", "second", "first-step", "second-step", "X", "Y", "Z", "IX", "IY", "IZ"})
"""Names that a block states of its end. Whatever is before it, it is no line that the next block ends."""


class Held(Struct, frozen=True):
    """The first and the last block, by index, of those on which a problem rests."""

    first: int
    last: int


class Reach(Struct, frozen=True, dict=True):
    """A contour that has problems, and what edits of it leave as it is."""

    answer: Answer

    def leaves_a_problem(self, edits: tuple[Edit, ...], *, parts: bool = False) -> bool:
        """Whether a problem rests on blocks that the edits do not touch. False where that is not known; with `parts`,
        what is left may be several contours, and edits before and behind it count, too."""
        if not self.held or not all(map(self._is_near if parts else self._is_of_a_block, edits)):
            return False
        touched = {self._place_in(edit.span.line if edit.span else edit.line) for edit in edits}
        return any(not any(held.first <= place <= held.last for place in touched) for held in self.held)

    def is_in_vain(self, span: Span) -> bool:
        """Whether a problem rests on blocks without a word, whatever is written for it that is no code: so that nobody
        has to think of anything."""
        place = self._place_in(span.line)
        return span not in self._lasting and any(not held.first <= place <= held.last for held in self.held)

    @cached_property
    def held(self) -> tuple[Held, ...]:
        """The blocks on which some of the problems rest, all over the contour."""
        count = len(self._claim.blocks)
        if count <= 2 * _BESIDE + 1 or self._claim.directives:
            return ()
        found, next_place = list[Held](), 0
        places = ((self._places.get(each.span.line), each) for each in problems(self.answer))
        for place, finding in sorted(((at, each) for at, each in places if at is not None), key=lambda each: each[0]):
            if place >= next_place and (held := self._held(finding)) is not None:
                found.append(held)
                next_place = place + max(count // MOST_HELD, 1)
        return tuple(found)

    @property
    def _claim(self) -> ParsedContour:
        return self.answer.claim

    @cached_property
    def _places(self) -> dict[int, int]:
        """The index of each block by its line."""
        return {block.line: place for place, block in enumerate(self._claim.blocks)}

    def _place_in(self, line: int) -> int:
        """The index of the block of a line; -1 before the contour, and the number of its blocks behind it."""
        outside = -1 if line < self._claim.blocks[0].line else len(self._claim.blocks)
        return self._places.get(line, outside)

    @cached_property
    def _lines(self) -> dict[str, int]:
        """The index of the block of each name of a given, and of what begins the names of a block."""
        claim = self._claim
        found = {name: place for name, (_, place) in claim.vocabulary.items()}
        found |= {name[: name.find(":") + 1]: place for name, place in found.items()}
        return found | {name: self._places.get(word.span.line, 0) for name, word in claim.words.items()}

    @cached_property
    def _ending(self) -> frozenset[int]:
        """The indices of the blocks that state something of their end."""
        names = self._claim.words.items()
        stated = (self._places.get(word.span.line) for name, word in names if name.partition(":")[2] in _ENDS)
        return frozenset(place for place in stated if place is not None)

    @cached_property
    def _lasting(self) -> frozenset[Span | None]:
        """The places of the words that stay in force."""
        claim = self._claim
        return frozenset(
            [*(word.span for word in claim.kept.values()), *(claim.words[name].span for name in claim.lasting)]
        )

    @cached_property
    def _of_blocks(self) -> frozenset[Span | None]:
        """The places of the words that say something of their own block alone."""
        return frozenset(word.span for word in self._claim.words.values()) - self._lasting

    @cached_property
    def _addresses(self) -> frozenset[str]:
        return frozenset(address for address, _ in self._claim.vocabulary.values())

    def _is_of_a_block(self, edit: Edit) -> bool:
        """Whether an edit changes, adds or drops what one block says, and nothing that stays in force."""
        line = edit.span.line if edit.span else edit.line
        if edit.kind is EditKind.MOVE or line not in self._places or "\n" in edit.text:
            return False
        if edit.span is not None and edit.span not in self._of_blocks:
            return False
        written = [each.upper() for each in _ADDRESS.findall(edit.text)]
        return edit.address in self._addresses and all(each in self._addresses for each in written)

    def _is_near(self, edit: Edit) -> bool:
        """Whether an edit changes what one block says, whatever that makes of it, or the start, and no code and nothing
        that stays in force."""
        if edit.kind is EditKind.MOVE or edit.span in self._lasting:
            return False
        return not is_of_codes(edit)

    def _held(self, finding: Diagnostic) -> Held | None:
        """The blocks on which a problem rests; None where that may be more than is near it."""
        labels = (label.span.line for label in finding.labels)
        near = {place for line in (finding.span.line, *labels) if (place := self._places.get(line)) is not None}
        if finding.about is ReadIssue.POINT_MISSING and finding.severity is not Severity.INFO:
            return self._around(near)
        if finding.about is None:
            # With further facts, the rules only warn.
            is_rule = finding.is_error or not self.answer.profile.is_extended
            return self._around(near) if is_rule and finding.severity is not Severity.INFO else None
        return self._around(near | rests) if finding.about in _OF_ELEMENTS and (rests := self._rests_on(near)) else None

    def _around(self, places: Iterable[int]) -> Held | None:
        """From the end of a block that is known to end whatever stands before it."""
        first, last = min(places) - _BESIDE, max(places) + _BESIDE
        while first > 0 and first not in self._ending:
            first -= 1
        return Held(first, last)

    @cached_property
    def _groups(self) -> tuple[dict[str, int], tuple[Group, ...]]:
        """The groups of facts in the order in which they are solved, and the one of each unknown; none where something
        is said twice, or a solution is chosen by the whole chain."""
        verdict = analyse(self._system)
        if not verdict.is_determined or verdict.tied:
            return {}, ()
        groups = groups_of(self._system)
        return {name: number for number, group in enumerate(groups) for name in group.unknowns}, groups

    @cached_property
    def _system(self) -> System:
        return assemble(self.answer.profile)

    def _rests_on(self, near: Iterable[int]) -> set[int]:
        """The indices of the blocks whose facts determine the form of the elements of some blocks and of those beside
        them, wherever these lie; empty where that are many, or where it is not known."""
        own, groups = self._groups
        wanted = {each for place in near for each in range(place - _BESIDE, place + _BESIDE + 1)}
        names = {
            name
            for element, maker in zip(self.answer.profile.figure.path, self._makers, strict=True)
            if maker in wanted
            for name in scalars_of(element)
        }
        found, placed = set[int](), set[str]()
        for _ in range(MOST_GROUPS):
            placed |= {name.rpartition(".")[2] for name in names if name not in own}
            names = {name for name in names if name in own}
            if _is_free(names, placed):
                return found
            group = groups[max(own[name] for name in names)]
            if not all(fact.placed or fact.heading or fact.circle or fact.sizes for fact in group.facts):
                return set()
            if self.answer.claim.form.is_general and any(fact.circle for fact in group.facts):
                return set()
            places = {self._place_of(fact.given) for fact in group.facts if fact.given}
            if None in places:
                return set()
            found |= {place for place in places if place is not None}
            placed |= {str(fact.placed.axis) for fact in group.facts if fact.placed and not fact.placed.origin}
            names = (names | {name for fact in group.facts for name in fact.reads()}) - {*group.unknowns}
        return set()

    @cached_property
    def _makers(self) -> Sequence[int | None]:
        """The index of the block of each element of the path."""
        claim, path = self._claim, self.answer.profile.figure.path
        if claim.makes:
            by_name = {name: place for place, names in enumerate(claim.makes) for name in names}
            return [by_name.get(element.name) for element in path]
        return range(len(path)) if len(path) == len(claim.blocks) else [None] * len(path)

    def _place_of(self, given: str) -> int | None:
        return self._lines.get(given, self._lines.get(given[: given.find(":") + 1]))


def is_of_codes(edit: Edit) -> bool:
    """Whether an edit changes a G code, which may stay in force."""
    return any(_CODE.search(text) for text in (edit.old, edit.text))


_CODE = re.compile(r"(?<![A-Z=])G\d", re.IGNORECASE)
_ADDRESS = re.compile(r",?[A-Z]+", re.IGNORECASE)


def _is_free(names: Iterable[str], placed: Collection[str]) -> bool:
    """Whether names are at most one coordinate on each axis on which nothing else has its place: its value moves what
    hangs on it, and no more."""
    axes = [name.rpartition(".")[2] for name in names]
    return len(axes) == len({*axes}) and {*axes} <= {str(FIRST), str(SECOND)} - {*placed}
