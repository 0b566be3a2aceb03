"""Slips in the blocks around a finding: each word by every kind of slip, two words, codes and blocks, the
most plausible first."""

import re
from collections.abc import Callable, Iterable, Iterator
from decimal import Decimal
from enum import Enum
from functools import cached_property
from itertools import chain

from msgspec import Struct

from contoursolve.diagnosis.edits import Edit, change
from contoursolve.diagnosis.plausibility import (
    FEATURES,
    Feature,
    coarseness,
    cost_of,
    distance,
    familiarity,
    numbers_of,
    rounding_of,
)
from contoursolve.diagnosis.slip_kinds import (
    LETTER_ALIKE,
    NEIGHBOUR,
    OF_DIGITS,
    POINT_LOST,
    POINT_LOST_IN_FEW,
    SIGN_LOST,
    ZERO_ADDED,
    ZERO_LOST,
    Changes,
    SlipKind,
    Speech,
    Typed,
    number_in,
    plain_code,
    texts_of,
    turned_axis,
)
from contoursolve.diagnosis.slips_of_blocks import CODES, OTHER_BLOCK, SEVERAL, Edits, Near
from contoursolve.diagnosis.window import Window
from contoursolve.diagnostics import Span
from contoursolve.gcode import AXES, Block, Word
from contoursolve.geometry import Unit
from contoursolve.reading import ParsedContour, ReadIssue
from contoursolve.solving import NoteKind, RefusalKind

MOST_TRIED, MOST_OF_DIGITS = 30, 16
"""Drafts around one finding that are tried; the rest is less plausible than these. The second of wrong digits."""

_NEAR, _FAR = 1, 3
"""Blocks on either side of the marked ones in which slips of every kind are looked for; and blocks with words ahead."""
_POINTED, _FEW_ROUND = 0.8, 0.5
"""By so much more plausible a lost point is where no more than this share of the numbers is round."""
_BLOCK = 0.6
"""The distance of the block of what a finding marks."""
OPEN = (ReadIssue.UNDERDETERMINED, RefusalKind.NOT_FIXED)
"""The events of a contour that lacks something."""
_ASKED, _ASKING = 2.3, {*OPEN, NoteKind.SEVERAL}
"""By so much more plausible a word was meant for the block beside if it is missing there; and what tells that."""
_NAMED, _ODD = 0.8, 0.6
"""By so much more plausible a letter is that a message names, and another one than that of a negative diameter."""
_READ, _NEGATIVE, _EARLIER, _SIZE, _OTHER_POINTS, _ACROSS = 1.1, 0.5, 0.6, 1.6, 1.5, 1.6
"""The costs of a wrong letter that has a meaning there, of a negative angle, of the first of two equal words, of a
negative size, of one point that is lost where others are, and of a negative diameter."""
_TENS, _IN_PLACE = 1.0, 0.3
"""The costs of a zero too many in a place of whole tens, and in another one."""
_SIZES = ("R", "CR", "P", "Q", "C", "D", "RND", "CHR", "CHF")
_BESIDE_PLANE, _USUAL_ANGLE, _USUAL_STEP, _HALF_TURN = 1.5, 0.4, 30, 180
"""The cost of a wrong letter of an axis that lifts the tool, and by so much more plausible a lost zero is with which an
angle is a multiple of some degrees."""
_OF_CLAIM = ("neighbour", "other-address", "other-letter")
"""Kinds that are about the words of a contour."""

_OF_MEANING = (LETTER_ALIKE, SIGN_LOST, ZERO_LOST)
"""Kinds whose cost depends on what the word means."""

Slips = tuple[SlipKind | None, ...]


class Candidate(Struct, frozen=True):
    """Edits that undo one slip, the kind of each, and what is known of them before they are tried."""

    edits: Edits
    slips: Slips
    evidence: tuple[tuple[Feature, float], ...]

    @property
    def cost(self) -> float:
        """The cost of the features that are known."""
        return sum(FEATURES[each][0] * amount for each, amount in self.evidence)


class Marked(Struct, frozen=True, dict=True):
    """The places that a finding marks, and the lines in which they are; `told` are the messages about it, and
    `events` what they are about."""

    spans: frozenset[Span]
    lines: frozenset[int]
    told: str = ""
    events: frozenset[Enum] = frozenset()

    @cached_property
    def named(self) -> frozenset[str]:
        """The addresses that the messages name."""
        return frozenset(re.findall(r"(?<![A-Z,#])[,#]?[A-Z]+(?![A-Z=])", self.told))

    def has(self, edit: Edit) -> bool:
        """Whether an edit changes what is marked, a code of a marked line, or one to a code that is named."""
        if edit.address not in CODES:
            return edit.span in self.spans
        named = re.compile(rf"\b{re.escape(plain_code(edit.text))}(?!\d)")
        return edit.span is not None and (edit.span.line in self.lines or bool(named.search(self.told)))


def touches(edit: Edit, place: Span) -> bool:
    """Whether an edit changes something of a place, or all of its line."""
    if edit.span is None or edit.span.line != place.line:
        return False
    return edit.span.column < place.end_column and place.column < edit.span.end_column


def is_lasting(edit: Edit) -> bool:
    """Whether a code chooses the plane, or what coordinates count from."""
    return edit.address == "G" and re.fullmatch(r"G(1[789]|9[01])", edit.text.strip(), re.IGNORECASE) is not None


def drafts_around(
    window: Window,
    marked: Marked,
    claim: ParsedContour | None,
    kinds: Iterable[SlipKind],
    may_mend: Callable[[Edits], bool] = lambda _: True,
    is_in_vain: Callable[[Span], bool] = lambda _: False,
) -> list[Candidate]:
    """Drafts around what a finding marks that may mend it, the most plausible first, and those alike in the order of
    the text; those of more than one word beside the `FEW` kinds. What `is_in_vain` to change is left out."""
    found: dict[Edits, Candidate] = {}
    numbers, near, kinds = numbers_of(window.blocks), _near_blocks(window, marked), tuple(kinds)
    coarse, trusted = coarseness(numbers), claim.trusted if claim is not None else frozenset[Span]()
    several = _of_several(Near(window, near), marked) if kinds != OF_DIGITS else iter(())
    words = _of_words(Prices.of(window, marked, claim), near, kinds, is_in_vain)
    for edits, slips, cost in chain(words, several):
        if any(edit.span in trusted for edit in edits) or not may_mend(edits):
            continue
        # What lasts counts for all blocks behind it.
        apart = (_BLOCK if is_lasting(edit) else distance(edit.place, marked.has(edit), marked.lines) for edit in edits)
        evidence = (
            (Feature.KIND, cost),
            (Feature.NEAR, min(apart, default=0.0)),
            (Feature.ROUND, sum(map(rounding_of, edits)) * coarse),
            (Feature.FAMILIAR, familiarity(edits, numbers)),
        )
        draft = Candidate(edits, slips, evidence)
        if edits not in found or draft.cost < found[edits].cost:
            found[edits] = draft
    return sorted(found.values(), key=_order)


def _order(draft: Candidate) -> tuple[object, ...]:
    return round(draft.cost, 6), [(edit.span or Span(edit.line, 0, 0), edit.text) for edit in draft.edits]


def _near_blocks(window: Window, marked: Marked) -> list[Block]:
    """The blocks that a finding marks, those beside them, and those with words ahead of its own."""
    blocks, first, count = window.blocks, window.first, len(window.own)
    places = [at for at, block in enumerate(blocks) if block.line in marked.lines]
    near = {at for place in places for at in range(place - _NEAR, place + _NEAR + 1)}
    near |= {*range(first, first + count)} if count <= 2 * _FAR else set()
    near |= {*[at for at in range(first) if blocks[at].words][-_FAR:]}
    return [block for at, block in enumerate(blocks) if at in near]


def _of_several(near: Near, marked: Marked) -> Iterator[tuple[Edits, Slips, float]]:
    for kind in SEVERAL:
        told = kind.slip if kind.slip.sentence else None
        for edits in kind.edits(near):
            is_asked = kind.slip is OTHER_BLOCK and _is_asked(edits[1].address, near, marked)
            yield edits, (told,) * len(edits), kind.slip.cost - _ASKED * is_asked


def _is_asked(address: str, near: Near, marked: Marked) -> bool:
    """Whether a message names a word because it is missing, or chooses nothing where it is."""
    row = near.window.control.modes.lexicon.addresses.get(address)
    is_missing = not marked.events.isdisjoint(_ASKING) or (row is not None and row.unit is Unit.SIGN)
    return is_missing and address in marked.named


def _of_words(
    prices: "Prices", near: Iterable[Block], kinds: Iterable[SlipKind], is_in_vain: Callable[[Span], bool]
) -> Iterator[tuple[Edits, Slips, float]]:
    for block in near:
        stated = frozenset(word.address for word in block.words)
        for word in block.words:
            is_apart = word.address in "GNMF" or (word.address == "O" and word.span not in prices.marked.spans)
            if is_apart or word.is_asked or is_in_vain(word.span):
                continue
            is_computed = any(each.is_within(block.typed_span(word.span)) for each in block.substituted)
            typed = {id(each): Typed.of(word, each, stated) for each in (prices.within, prices.outside)}
            for kind in kinds if all(typed.values()) else ():
                for text in texts_of(kind, typed[id(prices.speech(block, kind))]):
                    if is_computed and number_in(text) != number_in(word.text):
                        # Nobody typed that number.
                        continue
                    edit = change(word, text)
                    yield (edit,), (kind,), prices.price(edit, kind)


class Prices(Struct, frozen=True, dict=True):
    """The cost of slips of one word around what a finding marks, whichever way they are found: `within` a contour, of
    which `lines` and the words that are `read` are, or `outside`."""

    window: Window
    marked: Marked
    within: Speech
    outside: Speech
    lines: frozenset[int] = frozenset()
    read: frozenset[Span] = frozenset()

    @classmethod
    def of(cls, window: Window, marked: Marked, claim: ParsedContour | None) -> "Prices":
        """The prices around a contour, or around other blocks."""
        turned = turned_axis(window.state.plane) or (turned_axis(claim.before.plane) if claim is not None else "")
        outside = Speech.of_control(window.control, turned)
        if claim is None:
            return cls(window, marked, outside, outside)
        lines, read = (block.line for block in claim.blocks), (word.span for word in claim.words.values())
        return cls(window, marked, Speech.of(claim), outside, frozenset(lines), frozenset(read))

    def speech(self, block: Block, kind: SlipKind) -> Speech:
        """The words that may stand in a block."""
        is_within = block.line in self.lines and kind.changes is not Changes.ADDRESS
        return self.within if is_within or kind.name in _OF_CLAIM else self.outside

    @cached_property
    def _places(self) -> dict[Span, tuple[Block, int]]:
        """The block of each word, and its place there."""
        blocks = self.window.blocks
        return {word.span: (block, at) for block in blocks for at, word in enumerate(block.words)}

    @cached_property
    def _is_coarse(self) -> bool:
        """Whether few numbers are round, so that one without a point has lost it."""
        return coarseness(numbers_of(self.window.blocks)) <= _FEW_ROUND

    def price(self, edit: Edit, kind: SlipKind) -> float:
        """The cost of a slip of a word, with what the words around say of it."""
        cost = cost_of(edit, kind)
        if edit.span not in self._places:
            return cost
        block, at = self._places[edit.span]
        word = block.words[at]
        if kind is NEIGHBOUR:
            # Of two words for one corner, the later one is that of the corner behind.
            cost += _EARLIER * any(each.address == word.address for each in block.words[at + 1 :])
        elif kind is POINT_LOST:
            # One point is seldom lost alone beside others.
            cost += _OTHER_POINTS * (sum(map(_is_pointless, block.words)) > _is_pointless(word))
        if kind in (POINT_LOST, POINT_LOST_IN_FEW):
            cost -= _POINTED * self._is_coarse
        elif kind is ZERO_ADDED:
            # Of places, tens are more frequent than those of one digit.
            is_round = Decimal(number_in(edit.old) or 1) % 10 == 0
            cost += (_TENS if is_round else _IN_PLACE) * (edit.address[:1] in AXES)
        typed = Typed.of(word, self.speech(block, kind)) if kind in _OF_MEANING else None
        if typed is None:
            return cost
        if kind is LETTER_ALIKE:
            cost += self._letter(typed, edit.text) + _BESIDE_PLANE * _is_beside_plane(edit, self.window)
        elif kind is SIGN_LOST:
            # Drawings have few negative angles, diameters and sizes.
            cost += _NEGATIVE * typed.is_angle + _ACROSS * typed.is_diameter
            cost += _SIZE * (word.address.strip(",") in _SIZES)
        elif kind is ZERO_LOST:
            cost -= _USUAL_ANGLE * (typed.is_angle and _is_usual(edit.text))
        return cost

    def _letter(self, typed: Typed, text: str) -> float:
        """The cost of a wrong letter besides that of its kind: more if the word has a meaning as it is, less if its
        sign has none, or if a message names the other letter."""
        letter = re.match(r"[,#]?[A-Z]+", text.upper())
        if letter is not None and letter[0] in self.marked.named:
            return -_NAMED
        if typed.is_diameter and (typed.word.number or 0) < 0:
            return -_ODD
        if typed.word.address in "IJK" and typed.word.address not in self.window.state.plane.centers:
            # The centre of another plane has none.
            return 0.0
        row = self.outside.lexicon.addresses.get(typed.word.address)
        return _READ * (typed.word.span in self.read or bool(row and row.axis))


def _is_pointless(word: Word) -> bool:
    return bool(word.number) and not word.has_point and word.address not in "GMNFSTO"


def _is_beside_plane(edit: Edit, window: Window) -> bool:
    """Whether a word moves an axis outside the plane, or would, as another block around does: a tool is lowered and
    lifted in blocks of its own."""
    rows, axes = window.control.modes.lexicon.addresses, window.state.plane.axes
    for address in (edit.address, edit.text[:1].upper()):
        row = rows.get(address)
        if row is not None and row.axis and row.axis not in axes:
            words = (each for block in window.blocks for each in block.words if each.address == address)
            return any(edit.span is None or each.span.line != edit.span.line for each in words)
    return False


def _is_usual(text: str) -> bool:
    """Whether an angle is one that most drawings have."""
    number = number_in(text)
    return bool(number) and float(number) % _USUAL_STEP == 0 and float(number) <= _HALF_TURN
