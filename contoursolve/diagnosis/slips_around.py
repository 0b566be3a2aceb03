"""Slips in the blocks around a finding: each word by every kind of slip, two words, codes and blocks, the
most plausible first."""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from functools import cached_property
from itertools import chain, pairwise, permutations

from msgspec import Struct

from contoursolve.diagnosis.centre_slips import centres_from_origin, centres_from_start
from contoursolve.diagnosis.edits import Edit, EditKind, change, drop
from contoursolve.diagnosis.plausibility import (
    FEATURES,
    Feature,
    NumbersAround,
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
    ZERO_LOST,
    SlipKind,
    Speech,
    number_in,
    plain_code,
    texts_for,
    turned_axis,
    typed_as,
)
from contoursolve.diagnosis.vocabulary import names_like
from contoursolve.diagnosis.window import Window
from contoursolve.diagnostics import Span
from contoursolve.gcode import Block, Word, find_lookalikes
from contoursolve.geometry import Unit
from contoursolve.reading import Effect, ParsedContour, WithoutPoint, advance

MOST_TRIED, MOST_OF_DIGITS = 30, 16
"""Drafts around one finding that are tried; the rest is less plausible than these. The second of wrong digits."""

_NEAR, _FAR = 1, 3
"""Blocks on either side of the marked ones in which slips of every kind are looked for; and blocks with words ahead."""


Edits = tuple[Edit, ...]
Slips = tuple[SlipKind | None, ...]


class Candidate(Struct, frozen=True):
    """Edits that undo one slip, the kind of each, and what is known of them before they are tried."""

    edits: tuple[Edit, ...]
    slips: tuple[SlipKind | None, ...]
    evidence: tuple[tuple[Feature, float], ...]

    @property
    def cost(self) -> float:
        """The cost of the features that are known."""
        return sum(FEATURES[each][0] * amount for each, amount in self.evidence)


class Marked(Struct, frozen=True, dict=True):
    """The places that a finding marks, and the lines in which they are."""

    spans: frozenset[Span]
    lines: frozenset[int]
    told: str = ""
    """The messages about it, which may name a code."""

    @cached_property
    def named(self) -> frozenset[str]:
        """The addresses that the messages name."""
        return frozenset(_NAMES.findall(self.told))

    def has(self, edit: Edit) -> bool:
        """Whether an edit changes what is marked, a code of a marked line, or one to a code that is named."""
        if edit.address in _CODES:
            return edit.span is not None and (edit.span.line in self.lines or _is_named(edit.text, self.told))
        return edit.span in self.spans


_NAMES = re.compile(r"(?<![A-Z,#])[,#]?[A-Z]+(?![A-Z=])")


def _is_named(code: str, told: str) -> bool:
    return re.search(rf"\b{re.escape(plain_code(code))}(?!\d)", told) is not None


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
    found: dict[tuple[Edit, ...], Candidate] = {}
    numbers = numbers_of(window.blocks)
    coarse = coarseness(numbers)
    trusted = claim.trusted if claim is not None else frozenset[Span]()
    kinds = tuple(kinds)
    several = _of_several(window, marked) if kinds != OF_DIGITS else iter(())
    for edits, slips, cost in chain(_of_words(window, marked, claim, kinds, is_in_vain), several):
        if any(edit.span in trusted for edit in edits) or not may_mend(edits):
            continue
        draft = _draft(numbers, coarse, marked, edits, slips, cost)
        known = found.get(draft.edits)
        if known is None or draft.cost < known.cost:
            found[draft.edits] = draft
    return sorted(found.values(), key=_place)


_POINTED, _FEW_ROUND = 0.8, 0.5
"""By so much more plausible a lost point is where no more than this share of the numbers is round."""


def touches(edit: Edit, place: Span) -> bool:
    """Whether an edit changes something of a place, or all of its line."""
    if edit.span is None or edit.span.line != place.line:
        return False
    return edit.span.column < place.end_column and place.column < edit.span.end_column


def _place(draft: Candidate) -> tuple[object, ...]:
    places = [(edit.span or Span(edit.line, 0, 0), edit.text) for edit in draft.edits]
    return round(draft.cost, 6), places


def _draft(numbers: NumbersAround, coarse: float, marked: Marked, edits: Edits, slips: Slips, cost: float) -> Candidate:
    lines = [edit.span.line if edit.span else edit.line for edit in edits]
    near = [
        # What it says counts for all blocks behind it.
        _BLOCK if is_lasting(edit) else distance(line, marked.has(edit), marked.lines)
        for line, edit in zip(lines, edits, strict=True)
    ]
    # Of two words that are exchanged, one is enough.
    rounding = sum(map(rounding_of, edits)) * coarse
    evidence = (
        (Feature.KIND, cost),
        (Feature.NEAR, min(near, default=0.0)),
        (Feature.ROUND, rounding),
        (Feature.FAMILIAR, familiarity(edits, numbers)),
    )
    return Candidate(edits, slips, evidence)


def is_lasting(edit: Edit) -> bool:
    """Whether a code chooses the plane, or what coordinates count from."""
    return edit.address == "G" and re.fullmatch(r"G(1[789]|9[01])", edit.text.strip(), re.IGNORECASE) is not None


_BLOCK = 0.6
"""The distance of the block of what a finding marks."""


def near_blocks(window: Window, marked: Marked) -> list[Block]:
    """The blocks that a finding marks, those beside them, and those with words ahead of its own."""
    blocks = window.blocks
    places = [at for at, block in enumerate(blocks) if block.line in marked.lines]
    near = {at for place in places for at in range(place - _NEAR, place + _NEAR + 1)}
    first = window.first
    own = range(first, first + len(window.own))
    near |= {*own} if len(own) <= 2 * _FAR else set()
    ahead = [at for at in range(first) if blocks[at].words][-_FAR:]
    return [block for at, block in enumerate(blocks) if at in near or at in ahead]


def _of_words(
    window: Window,
    marked: Marked,
    claim: ParsedContour | None,
    kinds: Iterable[SlipKind],
    is_in_vain: Callable[[Span], bool],
) -> Iterator[tuple[Edits, Slips, float]]:
    prices, kinds = Prices.of(window, marked, claim), tuple(kinds)
    for block in near_blocks(window, marked):
        stated = frozenset(word.address for word in block.words)
        for word in block.words:
            if word.address in "GNOMF" or word.is_asked or is_in_vain(word.span):
                continue
            is_computed = any(each.is_within(block.typed_span(word.span)) for each in block.substituted)
            typed = {id(each): typed_as(word, each, stated) for each in (prices.within, prices.outside)}
            for kind in kinds if all(typed.values()) else ():
                read_as = typed[id(prices.speech(block, kind))]
                for text in texts_for(kind, read_as) if read_as else ():
                    if is_computed and number_in(text) != number_in(word.text):
                        # Nobody typed that number.
                        continue
                    edit = change(word, text)
                    yield (edit,), (kind,), prices.price(edit, kind)


class Prices(Struct, frozen=True, dict=True):
    """The cost of slips of one word around what a finding marks, whichever way they are found."""

    window: Window
    marked: Marked
    within: Speech
    outside: Speech
    lines: frozenset[int]
    """Those of the contour."""
    read: frozenset[Span]
    """The words of the contour."""

    @classmethod
    def of(cls, window: Window, marked: Marked, claim: ParsedContour | None) -> "Prices":
        """The prices around a contour, or around other blocks."""
        turned = turned_axis(window.state.plane) or (turned_axis(claim.before.plane) if claim is not None else "")
        outside = Speech.of_control(window.dialect, turned)
        lines = frozenset(block.line for block in claim.blocks) if claim else frozenset[int]()
        read = frozenset(word.span for word in claim.words.values()) if claim else frozenset[Span]()
        return cls(window, marked, Speech.of(claim) if claim else outside, outside, lines, read)

    def speech(self, block: Block, kind: SlipKind) -> Speech:
        """The words that may stand in a block."""
        is_within = block.line in self.lines and kind.is_of_numbers
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
        word, speech = block.words[at], self.speech(block, kind)
        if kind is LETTER_ALIKE:
            is_read = word.span in self.read or self.outside.is_axis(word)
            cost += _letter_cost(word, edit.text, speech, self.marked, is_read=is_read)
            cost += _BESIDE_PLANE * _is_beside_plane(edit, self.window)
        # One point is seldom lost alone beside others.
        pointless = sum(map(_is_pointless, block.words)) - _is_pointless(word)
        cost += _OTHER_POINTS * (kind is POINT_LOST and pointless > 0)
        cost -= _POINTED * (self._is_coarse and kind in (POINT_LOST, POINT_LOST_IN_FEW))
        # Of two words for one corner, the later one is that of the corner behind.
        is_earlier = any(each.address == word.address for each in block.words[at + 1 :])
        cost += _EARLIER * (kind is NEIGHBOUR and is_earlier)
        cost += _NEGATIVE * (kind is SIGN_LOST and speech.is_angle(word))
        cost -= _USUAL_ANGLE * (kind is ZERO_LOST and speech.is_angle(word) and _is_usual(edit.text))
        cost += _ACROSS * (kind is SIGN_LOST and speech.is_diameter(word))
        return cost + _SIZE * (kind is SIGN_LOST and word.address.strip(",") in _SIZES)


def _letter_cost(word: Word, text: str, speech: Speech, marked: Marked, *, is_read: bool) -> float:
    """The cost of a wrong letter besides that of its kind: more if the word has a meaning as it is, less if its sign
    has none, or if a message names the other letter."""
    letter = re.match(r"[,#]?[A-Z]+", text.upper())
    if letter is not None and letter[0] in marked.named:
        return -_NAMED
    if speech.is_diameter(word) and word.number is not None and word.number < 0:
        return -_ODD
    return _READ * is_read


def _is_beside_plane(edit: Edit, window: Window) -> bool:
    """Whether a word moves an axis outside the plane, or would, as another block around does: a tool is lowered and
    lifted in blocks of its own."""
    rows, axes = window.dialect.modes.lexicon.addresses, window.state.plane.axes
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


_BESIDE_PLANE, _USUAL_ANGLE, _USUAL_STEP, _HALF_TURN = 1.5, 0.4, 30, 180
"""The cost of a wrong letter of an axis that lifts the tool, and by so much more plausible a lost zero is with which an
angle is a multiple of some degrees."""

_NAMED, _ODD = 0.8, 0.6
"""By so much more plausible a letter is that a message names, and another one than that of a negative diameter."""

_READ, _NEGATIVE, _EARLIER, _SIZE, _OTHER_POINTS, _ACROSS = 1.1, 0.5, 0.6, 1.6, 1.5, 1.6
"""The costs of a wrong letter that has a meaning there, of a negative angle, of the first of two equal words, of a
negative size, of one point that is lost where others are, and of a negative diameter."""
_SIZES = ("R", "CR", "P", "Q", "C", "D", "RND", "CHR", "CHF")

_OF_CLAIM = ("neighbour", "other-address", "other-letter")
"""Kinds that are about the words of a contour."""


# Kinds of more than one word -------------------------------------------------------------------------------------

_MEANING = "what is mistaken on drawings: slips that machinists and makers of controls name"


class SeveralKind(Struct, frozen=True):
    """A kind of slip that is not of one word: the edits that undo it in some blocks."""

    slip: SlipKind
    edits: Callable[[Window, Sequence[Block]], Iterator[Edits]]


def _is_pointless(word: Word) -> bool:
    return bool(word.number) and not word.has_point and word.address not in "GMNFSTO"


def _swapped_words(blocks: Sequence[Block], pairs: Sequence[tuple[str, str]]) -> Iterator[Edits]:
    for block in blocks:
        named = {word.address: word for word in block.words}
        for pair in pairs:
            if pair[0] in named and pair[1] in named:
                one, two = named[pair[0]], named[pair[1]]
                first, second = (word.text.strip()[len(word.address) :] for word in (one, two))
                if first != second:
                    yield change(one, one.address + second), change(two, two.address + first)


_CENTRES = (("I", "J"), ("I", "K"), ("J", "K"), ("CCX", "CCY"))
_ENDS = (("X", "Y"), ("X", "Z"), ("U", "W"), ("P", "Q"))
_PAIRS = (*_CENTRES, *_ENDS)
"""Words that belong together, of which each may get the number of the other."""


def _both_signs(_: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    for block in blocks:
        named = {word.address: word for word in block.words if number_in(word.text)}
        for pair in _PAIRS:
            if pair[0] in named and pair[1] in named:
                words = [named[each] for each in pair]
                if all(word.number and word.number > 0 for word in words):
                    yield tuple(
                        change(word, f"{word.address}-{word.text.strip()[len(word.address) :].lstrip('+')}")
                        for word in words
                    )


def _all_points(window: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    lexicon = window.dialect.modes.lexicon
    if lexicon.numbers.without_point is not WithoutPoint.LEAST_INCREMENTS:
        return
    for block in blocks:
        words = [word for word in block.words if word.number and not word.has_point]
        rows = {word: lexicon.addresses.get(word.address) for word in words}
        words = [word for word, row in rows.items() if row is not None and row.unit in (Unit.MM, Unit.DEGREE)]
        # Those with few digits are hardly increments, whatever the others are.
        few = [word for word in words if abs(float(word.number or 0)) < _FEW_INCREMENTS]
        for some in [words, few] if len(few) < len(words) else [words]:
            if len(some) > 1:
                yield tuple(change(word, f"{word.text.strip()}.") for word in some)


_FEW_INCREMENTS = 1000


def _codes(window: Window, blocks: Iterable[Block], pairs: Sequence[tuple[str, str]]) -> Iterator[Edits]:
    known = window.codes
    for block in blocks:
        for word in block.words:
            if word.address not in _CODES:
                continue
            name = plain_code(word.text)
            for typed, meant in pairs:
                is_code = meant in known or word.address != "G"
                if name == typed and is_code and not _is_second(window, block, word, meant):
                    yield (change(word, _like(word, meant)),)


_CODES = ("G", "DR")
"""Addresses of words that are one of few."""


def _said_again(window: Window, _: Sequence[Block]) -> Iterator[Edits]:
    """A code for increments or places that says what is in force already, as the other one."""
    state = window.ahead[0][1] if window.ahead else window.state
    for block in window.blocks:
        before, state = state, advance(state, block, window.dialect.modes)
        typed = "G91" if before.is_incremental else "G90"
        if state.is_incremental is before.is_incremental:
            yield from _codes(window, [block], [(typed, "G90" if before.is_incremental else "G91")])


def _like(word: Word, code: str) -> str:
    """A code with the zero that leads another one, or with as many digits."""
    has_two = re.fullmatch(r"G\d\d", word.text.strip(), re.IGNORECASE)
    return f"G0{code[1:]}" if has_two and len(code) == 2 else code  # noqa: PLR2004


def _of_codes(
    *pairs: tuple[str, str], everywhere: bool = False
) -> Callable[[Window, Sequence[Block]], Iterator[Edits]]:
    return lambda window, blocks: _codes(window, window.blocks if everywhere else blocks, pairs)


def _compensated(window: Window, _: Sequence[Block]) -> Iterator[Edits]:
    """The code for no compensation as one for a side, where none stands behind it: that of a head is meant."""
    codes = [plain_code(word.text) for block in window.blocks for word in block.words]
    sides = sum(code in _SIDES for code in codes)
    for block in window.blocks:
        sides -= sum(plain_code(word.text) in _SIDES for word in block.words)
        if not sides:
            yield from _codes(window, [block], [("G40", side) for side in _SIDES])


_SIDES = ("G41", "G42")


def _both(*names: str) -> tuple[tuple[str, str], ...]:
    """Each of some codes for each other one."""
    return tuple(permutations(names, 2))


def _code_digits(window: Window, *, draws: bool) -> Iterator[Edits]:
    """G codes that draw something, or those that do not, with two digits swapped, or one that is another, too many or
    lost."""
    modes = window.dialect.modes
    known = {
        plain_code(code.text)
        for code in modes.codes.values()
        if code.effect in _OF_PATHS or code.number in modes.separate
    }
    for block in window.blocks:
        for word in block.words:
            digits = plain_code(word.text)[1:]
            if word.address != "G" or not digits.isdigit() or (f"G{digits}" in known) is not draws:
                continue
            for other in known:
                is_code = other[:1] == "G" and other[1:].isdigit() and other[1:] != digits
                is_like = is_code and _is_near(word.text.strip()[1:], _like(word, other)[1:])
                if is_like and not _is_second(window, block, word, other):
                    yield (change(word, _like(word, other)),)


def _is_second(window: Window, block: Block, word: Word, code: str) -> bool:
    """Whether a code would be the second of its block that does what it does."""
    effect = window.codes.get(code)
    others = (plain_code(each.text) for each in block.words if each.address == "G" and each is not word)
    return effect is not None and any(window.codes.get(other) is effect for other in others)


_OF_PATHS = (Effect.MOTION, Effect.PLANE, Effect.CONTOUR, Effect.CORNER, Effect.ABSOLUTE, Effect.INCREMENTAL)


def _is_near(one: str, two: str) -> bool:
    """Whether two numbers have swapped digits, or one digit between them is another one."""
    if len(one) == len(two):
        apart = [(a, b) for a, b in zip(one, two, strict=True) if a != b]
        return len(apart) == 1 or (len(apart) == 2 and apart[0] == apart[1][::-1])  # noqa: PLR2004
    short, long = sorted((one, two), key=len)
    return len(long) == len(short) + 1 and any(long[:at] + long[at + 1 :] == short for at in range(len(long)))


def _tangents(window: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    """Lines and arcs that begin in the direction of the element before: of two of these, one is an arc."""
    lines, before = {block.line for block in blocks}, ""
    for block in window.blocks:
        code = next((word for word in block.words if word.address == "G"), None)
        name = plain_code(code.text) if code else ""
        if block.line in lines and (name == "FC" or before in _KLARTEXT_ARCS):
            yield from _codes(window, [block], _TANGENTS)
        # Corners and poles are no elements.
        before = name if name and name != "FPOL" else before


_TANGENTS = (("FL", "FLT"), ("FC", "FCT"))
_KLARTEXT_ARCS = ("FC", "FCT", "C", "CR", "CT", "CP", "CTP")


def _motion_to_arc(window: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    """An arc for a line that has a centre or a radius, and a motion for a code of none."""
    centres = {"I", "J", "K", window.dialect.modes.radius}
    with_centre = [block for block in blocks if any(word.address in centres for word in block.words)]
    yield from _codes(window, with_centre, [("G1", "G2"), ("G1", "G3"), ("G0", "G2"), ("G0", "G3")])
    for block in with_centre:
        for word in block.words:
            digits = plain_code(word.text)[1:]
            if word.address == "G" and digits.isdigit() and len(digits) > 1:
                arcs = [arc for arc in ("G2", "G3") if _is_near(word.text.strip()[1:], _like(word, arc)[1:])]
                yield from ((change(word, _like(word, arc)),) for arc in arcs)


def _motion_lost(window: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    """The code of a line behind an arc, and of an arc behind a line, that a block lacks."""
    centres = {"I", "J", "K", window.dialect.modes.radius}
    lines, motion = {block.line for block in blocks}, ""
    has_two = any(re.match(r"G0\d", word.text.strip()) for block in window.blocks for word in block.words)
    for block in window.blocks:
        codes = [plain_code(word.text) for word in block.words if word.address == "G"]
        motion = next((code for code in codes if code in _MOTIONS), "" if codes else motion)
        if codes or block.line not in lines or not any(word.address in _AXES for word in block.words):
            continue
        is_round = any(word.address in centres for word in block.words)
        meant = (
            () if not motion or is_round is (motion in _MOTIONS[2:]) else _MOTIONS[2:] if is_round else _MOTIONS[1:2]
        )
        for code in meant:
            text = f"G0{code[1:]}" if has_two else code
            yield (Edit(EditKind.ADD, "G", text=text, line=block.line),)


_MOTIONS, _AXES = ("G0", "G1", "G2", "G3"), "XYZUVW"


def _between(window: Window, _: Sequence[Block]) -> Iterator[Edits]:
    """Blocks without a motion that stand between a corner and its neighbour, moved before the contour."""
    blocks = window.blocks
    first = window.first
    for at in range(first + 1, min(first + len(window.own) + 2, len(blocks) - 1)):
        block = blocks[at]
        if block.words and all(word.address in "MSTFN" for word in block.words):
            said = [word for word in block.words if word.address != "N"]
            dropped = tuple(map(drop, said))
            if first and dropped:
                text = "\n" + " ".join(word.text.strip() for word in said)
                yield (*dropped, Edit(EditKind.ADD, said[0].address, text=text, line=blocks[first - 1].line))
            elif dropped:
                yield dropped


def _swapped_blocks(window: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    lines = {block.line for block in blocks}
    for one, two in pairwise(window.blocks):
        if one.line in lines and two.line in lines and one.words and two.words:
            first, second = _body(one), _body(two)
            if first.text and second.text and first.text != second.text:
                yield change(first, second.text), change(second, first.text)


def _body(block: Block) -> Word:
    """All of a block behind its number, as one word."""
    match = re.match(r"\s*(?:N?\d+\s+)?", block.text)
    begin = match.end() if match else 0
    text = block.text[begin:].rstrip()
    return Word("", None, False, text, Span(block.line, begin + 1, begin + 1 + len(text)))


def _respelled(window: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    """Text that cannot be read, as words that it may have been."""
    own = set(window.lines)
    for block in blocks:
        if block.line not in own:
            continue
        alike = find_lookalikes(block)
        edits = tuple(
            Edit(EditKind.CHANGE, each.address, each.span, each.old, each.new)
            for each in alike
            if not re.fullmatch("[A-Za-z]{3,}", each.old)
        )
        yield from ((edit,) for edit in edits)
        if len(edits) > 1:
            yield edits
        yield from ((edit,) for edit in rewritten(window, [block]))


def rewritten(window: Window, blocks: Iterable[Block]) -> Iterator[Edit]:
    """Text that is almost a word, as the word: with a comma, a point or an equals sign more or less."""
    addresses = window.dialect.modes.lexicon.addresses
    has_marks = any(address.startswith("#") for address in addresses)
    patterns = _RESPELLED if has_marks else [each for each in _RESPELLED if "#" not in each[1]]
    for block in blocks:
        for pattern, new in patterns:
            for match in pattern.finditer(block.text):
                begin = block.text.rfind(" ", 0, match.start()) + 1
                end = (block.text + " ").find(" ", match.end())
                old = block.text[begin:end]
                text = block.text[begin : match.start()] + match.expand(new) + block.text[match.end() : end]
                is_known = "=" not in new or text.partition("=")[0].upper() in addresses
                if text != old and is_known:
                    yield Edit(EditKind.CHANGE, "", Span(block.line, begin + 1, end + 1), old, text)


_RESPELLED = (
    (re.compile(r",,+"), ","),
    (re.compile(r"(?<=\d)(\.\d*),(?=\s|$)"), r"\1"),
    (re.compile(r"(?<![\d.])(\d+),(?=\s|$)"), r"\1."),
    (re.compile(r"(?<=\d)\.\.(?=[A-Z])"), ". ,"),
    (re.compile(r"(?<=\d)\.\.(?![A-Z])"), "."),
    (re.compile(r"(#?[A-Z]{2,})[ \t]*(-?\d+\.?\d*)"), r"\1=\2"),
    (re.compile(r"(?<![#A-Z])([A-Z]{2,}=)"), r"#\1"),
    (re.compile(r"#([A-Z]{2,}=)"), r"\1"),
    (re.compile(r"(?<=\d)[ \t]+(?=\.?\d)"), ""),
    (re.compile(r"\b([GM])[OQ](?=\d)"), r"\g<1>0"),
    (re.compile(r"\b([GM])[lI]\b"), r"\g<1>1"),
)
"""Text that is almost a word, and the word."""


def _misspelt(window: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    """The name of what is no word or code of the control, as one that it has."""
    modes = window.dialect.modes
    known = {*modes.lexicon.plain_names(), *modes.syntax.codes}
    for block in blocks:
        strange = [word.span for word in block.words if _is_strange(word, known)]
        for span in (*strange, *(fault.span for fault in block.faults)):
            match = _NAME.match(block.text, span.column - 1)
            if match is None or match[0].upper() in known:
                continue
            place = Span(block.line, match.start() + 1, match.end() + 1)
            for name in names_like(match[0], modes.lexicon, modes.syntax.codes):
                yield (Edit(EditKind.CHANGE, "", place, match[0], name),)


def _is_strange(word: Word, known: Collection[str]) -> bool:
    """Whether the control has no word or code of this name."""
    if word.address == "G":
        return word.number is None
    return word.address not in known and len(word.address) > 1


_NAME = re.compile(r"#?[A-Za-z]{2,}")


def _references(window: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    """The block of a parallel line, from which a distance counts: the numbers of the lines before it."""
    if "PAR" not in window.dialect.modes.lexicon.addresses:
        return
    lines, numbers = {block.line for block in blocks}, list[str]()
    for block in window.own:
        if block.line in lines and block.find("DP") and not block.find("PAR"):
            yield from ((Edit(EditKind.ADD, "PAR", text=f"PAR {each}", line=block.line),) for each in numbers)
        number = block.find("N")
        if number is not None and any(plain_code(word.text) in _KLARTEXT_LINES for word in block.words):
            numbers.append(number.text.strip())


_KLARTEXT_LINES = ("FL", "FLT", "L", "LP", "LT")


def _dropped(window: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    for block in blocks:
        if block.line in window.lines:
            yield from ((drop(word),) for word in block.words if _is_apart(word, window))


def _is_apart(word: Word, window: Window) -> bool:
    """Whether a word is one of a corner or an angle, by its spelling. Without its offset, a contour lies elsewhere."""
    is_long = word.address.startswith((",", "#")) or len(word.address) > 1
    return is_long and word.address not in window.dialect.modes.zero.names


def _other_block(window: Window, blocks: Sequence[Block]) -> Iterator[Edits]:
    """A word of a corner or an angle that stands in the block before or behind the one that it belongs to."""
    lines = [block.line for block in blocks]
    for one, two in [*pairwise(blocks), *((two, one) for one, two in pairwise(blocks))]:
        for word in one.words:
            if _is_apart(word, window) and two.find(word.address) is None and two.words and one.line in lines:
                yield drop(word), Edit(EditKind.ADD, word.address, text=word.text.strip(), line=two.line)


SEVERAL = (
    SeveralKind(SlipKind("respelled", "", 0.5, _MEANING), _respelled),
    SeveralKind(SlipKind("misspelt", "", 0.7, _MEANING), _misspelt),
    SeveralKind(SlipKind("all-points", "", 0.4, _MEANING), _all_points),
    SeveralKind(
        SlipKind("words-swapped", "two words swapped", 1.4, _MEANING),
        lambda _, blocks: _swapped_words(blocks, _CENTRES),
    ),
    SeveralKind(
        SlipKind("ends-swapped", "two words swapped", 2.6, _MEANING), lambda _, blocks: _swapped_words(blocks, _ENDS)
    ),
    SeveralKind(SlipKind("from-start", "the centre counted from the start", 2.0, _MEANING), centres_from_start),
    SeveralKind(SlipKind("from-origin", "the centre counted from the origin", 3.0, _MEANING), centres_from_origin),
    SeveralKind(SlipKind("both-signs", "two lost minus signs", 3.0, _MEANING), _both_signs),
    SeveralKind(
        SlipKind("turn", "the other way round", 2.1, _MEANING), _of_codes(*_both("G2", "G3"), *_both("DR+", "DR-"))
    ),
    SeveralKind(SlipKind("motion-lost", "", 1.6, _MEANING), _motion_lost),
    SeveralKind(SlipKind("line-for-arc", "an arc", 1.6, _MEANING), _motion_to_arc),
    SeveralKind(SlipKind("tangent", "the tangent", 1.9, _MEANING), _tangents),
    SeveralKind(SlipKind("no-tangent", "no tangent", 3.4, _MEANING), _of_codes(("FLT", "FL"), ("FCT", "FC"))),
    SeveralKind(SlipKind("free-line", "", 2.0, _MEANING), _of_codes(("L", "FL"), ("C", "FC"))),
    SeveralKind(
        SlipKind("plane", "another plane", 1.6, _MEANING), _of_codes(*_both("G17", "G18", "G19"), everywhere=True)
    ),
    SeveralKind(SlipKind("increments", "", 2.6, _MEANING), _of_codes(*_both("G90", "G91"), everywhere=True)),
    SeveralKind(SlipKind("increments-again", "", 1.2, _MEANING), _said_again),
    SeveralKind(SlipKind("compensation", "", 2.2, _MEANING), _compensated),
    SeveralKind(SlipKind("code", "", 2.4, _MEANING), lambda window, _: _code_digits(window, draws=False)),
    SeveralKind(SlipKind("other-code", "", 4.8, _MEANING), lambda window, _: _code_digits(window, draws=True)),
    SeveralKind(SlipKind("rapid", "", 2.8, _MEANING), _of_codes(("G0", "G1"))),
    SeveralKind(SlipKind("between", "", 0.0, _MEANING), _between),
    SeveralKind(SlipKind("blocks-swapped", "two blocks swapped", 3.2, _MEANING), _swapped_blocks),
    SeveralKind(SlipKind("other-block", "a word of the block beside", 4.2, _MEANING), _other_block),
    SeveralKind(SlipKind("reference-lost", "", 1.8, _MEANING), _references),
    SeveralKind(SlipKind("too-many", "", 4.2, _MEANING), _dropped),
)
"""Kinds of slips that are not of one word."""


def _of_several(window: Window, marked: Marked) -> Iterator[tuple[Edits, Slips, float]]:
    blocks = near_blocks(window, marked)
    for kind in SEVERAL:
        for edits in kind.edits(window, blocks):
            told = kind.slip if kind.slip.sentence else None
            yield edits, (told,) * len(edits), kind.slip.cost
