"""Edits of a block's text: words dropped, added, moved into a block of their own, or written with another value."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from decimal import ROUND_DOWN, ROUND_HALF_EVEN, ROUND_UP, Decimal
from enum import Enum, IntEnum

from msgspec import Struct
from msgspec.structs import replace as replace_fields

from contoursolve.diagnosis.wording import shorten
from contoursolve.diagnostics import Evidence, Source, Span, check_type
from contoursolve.gcode import (
    FACT,
    PLAIN,
    Block,
    Directive,
    Lookalike,
    Substitution,
    Syntax,
    Word,
    WordSpelling,
    late_pattern,
    parse_block,
    read_directive,
)
from contoursolve.geometry import Length, Unit
from contoursolve.reading import Lexicon, ParsedContour, WithoutPoint, restate

PLACEHOLDER = "?"
"""Stands for a number that the block does not give."""


class EditKind(Enum):
    """The change that is made to a word."""

    DROP = "delete"
    ADD = "add"
    CHANGE = "change"
    MOVE = "move"


class InsertionSide(Enum):
    """The place of a word that gets a block of its own."""

    BEFORE = "before"
    AFTER = "after"


class Errand(Struct, frozen=True):
    """The effect of a word besides the contour, and its time: before the motion of its block or behind it. None where a
    block of its own is no place for it."""

    address: str
    numbers: tuple[int, ...]
    """The numbers that it is about; none for any number."""
    meaning: str
    side: InsertionSide | None
    source: Source


_ASSUMED = Source("contoursolve", "when a control runs what stands beside a motion", Evidence.ASSUMED)

ERRANDS = (
    Errand("F", (), "feed", None, _ASSUMED),
    Errand("T", (), "tool", InsertionSide.BEFORE, _ASSUMED),
    Errand("S", (), "spindle speed", InsertionSide.BEFORE, _ASSUMED),
    Errand("M", (3, 4), "spindle on", InsertionSide.BEFORE, _ASSUMED),
    Errand("M", (7, 8), "coolant on", InsertionSide.BEFORE, _ASSUMED),
    Errand("M", (9,), "coolant off", InsertionSide.AFTER, _ASSUMED),
    Errand("M", (5,), "spindle off", InsertionSide.AFTER, _ASSUMED),
    Errand("M", (0, 1), "stop", InsertionSide.AFTER, _ASSUMED),
    Errand("M", (98, 99), "subprogram", InsertionSide.AFTER, _ASSUMED),
    Errand("M", (2, 30), "end of program", InsertionSide.AFTER, _ASSUMED),
    Errand("M", (), "machine function", InsertionSide.BEFORE, _ASSUMED),
)
"""The first row that fits counts; words that move to one side of a block stand there in the order of the rows."""


def errand_of(address: str, text: str) -> Errand | None:
    """The effect of a word, as it is written, besides the contour; None for the words of a contour."""
    number = re.fullmatch(r"0*(\d+)\.?0*", PLAIN.number_of(text, address))
    fitting = (
        row
        for row in ERRANDS
        if row.address == address and (not row.numbers or (number is not None and int(number[1]) in row.numbers))
    )
    return next(fitting, None)


class Why(IntEnum):
    """The reason for which an edit is proposed, the one that a colleague would think of first before the others."""

    ROUNDED = 0
    """It differs by what rounding explains."""
    SLIP = 1
    """A slip of typing explains it."""
    AGREES = 2
    """It agrees with the other words."""
    FITS = 3
    """It is the largest value that fits."""
    OTHER = 4
    """It is another word or value with which there is a contour."""
    MISSING = 5
    """The word is missing."""
    NOT_NEEDED = 6
    """The word is one too many."""


@dataclass(frozen=True, slots=True)
class Edit:
    """One word dropped, added or changed. `span` is the old word's place, `text` the new word."""

    kind: EditKind
    address: str
    span: Span | None = None
    old: str = ""
    text: str = ""
    line: int = 0
    """Line of the block that an added word goes to; behind it, if the text begins with the end of a line."""
    why: Why = field(default=Why.OTHER, compare=False)

    @property
    def reason(self) -> Why:
        """The reason for which it is proposed."""
        return _REASONS.get(self.kind, self.why)

    def __str__(self) -> str:
        old, text = (self._shown(each) for each in (self.old, self.text))
        errand = self.errand
        if self.kind is EditKind.CHANGE:
            return f"write {text} for {old}"
        if self.kind is EditKind.MOVE and errand is not None and errand.side is not None:
            return f"move {old} ({errand.meaning}) into a block of its own {errand.side.value} this one"
        meaning = f" ({errand.meaning})" if errand is not None and self.kind is EditKind.DROP else ""
        return f"{self.kind.value} {text.strip() if self.text else old}{meaning}"

    def among(self, blocks: Sequence[Block]) -> str:
        """It in words, with its program line where other blocks have the same word, or could get it."""
        line, is_added = self.place, self.kind is EditKind.ADD
        others = [block for block in blocks if block.line != line]
        is_beside = len(others) == len(blocks)
        if line > 0 and (
            is_beside or any(is_added or any(word.text == self.old for word in block.words) for block in others)
        ):
            where = "after" if self.is_behind else "to" if is_added else "in"
            return f"{self} {where} program line {line}"
        return str(self)

    @property
    def is_behind(self) -> bool:
        """Whether what it adds gets a block of its own, behind that of its line."""
        return self.text.startswith("\n")

    @property
    def place(self) -> int:
        """The program line that it changes."""
        return self.span.line if self.span else self.line

    @property
    def errand(self) -> Errand | None:
        """The effect of the old word besides the contour."""
        return errand_of(self.address, self.old)

    def _shown(self, text: str) -> str:
        return shorten(text) if self.is_in_block else f'--fact "{shorten(text)}"'

    @property
    def is_in_block(self) -> bool:
        """Whether it is about the text of the block, not about a fact that is stated apart from it."""
        return self.span is None or self.span.line > 0

    @property
    def is_placeholder(self) -> bool:
        """Whether it adds a word whose number is still to be chosen."""
        return self.kind is EditKind.ADD and self.text.rstrip(")").endswith(PLACEHOLDER)


def drop(word: Word) -> Edit:
    """A word, or a fact as a word, taken out."""
    return Edit(EditKind.DROP, word.address, word.span, word.text)


def change(word: Word, text: str, why: Why = Why.OTHER) -> Edit:
    """A word, or a fact as a word, written with another text."""
    return Edit(EditKind.CHANGE, word.address, word.span, word.text, text, why=why)


def mend(word: Lookalike) -> Edit:
    """Text that is almost a word, written as the word that it is meant to be."""
    return Edit(EditKind.CHANGE, word.address, word.span, word.old, word.new)


def add(claim: ParsedContour, name: str, text: str = "") -> Edit:
    """The word for a name added, with its number still to be chosen unless its text is given."""
    address, index = claim.vocabulary[name]
    text = text or claim.lexicon.spell(address, PLACEHOLDER)
    return Edit(EditKind.ADD, address, text=text, line=claim.blocks[index].line)


_REASONS = {EditKind.DROP: Why.NOT_NEEDED, EditKind.ADD: Why.MISSING, EditKind.MOVE: Why.AGREES}


def apply_edits(blocks: Iterable[Block], edits: Iterable[Edit]) -> tuple[str, ...]:
    """The texts of the blocks with the edits made; blanks that a dropped word leaves double are merged. A block from
    which words are moved has several lines; the text of one of which too little is left is empty."""
    edits = tuple(edits)
    lines = {edit.span.line if edit.span is not None else edit.line for edit in edits}
    lines |= {edit.line for edit in edits if edit.kind is EditKind.ADD}
    texts = []
    for block in blocks:
        text = block.text
        if block.line not in lines:
            texts.append(text)
            continue
        own = [edit for edit in edits if edit.span is not None and edit.span.line == block.line]
        for edit in sorted(own, key=lambda each: each.span.column if each.span else 0, reverse=True):
            assert edit.span is not None
            before, after = text[: edit.span.column - 1], text[edit.span.end_column - 1 :]
            if edit.text:
                text = before + edit.text + after
            else:
                text = before.rstrip(" ") + after if before.strip() else before + after.lstrip(" ")
        for edit in edits:
            if edit.kind is EditKind.ADD and edit.line == block.line and edit.text.startswith("\n"):
                text += edit.text
            elif edit.kind is EditKind.ADD and edit.line == block.line:
                insert = _with_code if edit.address == "G" else _insert
                text = insert(text, edit.text, block.syntax)
        bare = block.syntax.bare_number
        if bare and bare.fullmatch(text) and own and not any(edit.kind is EditKind.MOVE for edit in own):
            text = ""
        is_fact_dropped = any(edit.address == FACT and not edit.text for edit in own)
        texts.append(_with_moved(_tidy(text) if is_fact_dropped else text, own))
    return tuple(texts)


def read_edited(block: Block, text: str, syntax: Syntax) -> list[Block]:
    """The blocks that a text in place of a block makes, which may have several lines. Where numbers stand for variables
    is known of the parts of the first one that stay."""
    first, *rest = text.split("\n")
    kept = next((at for at, pair in enumerate(zip(block.text, first, strict=False)) if pair[0] != pair[1]), len(first))
    grown = len(first) - len(block.text)
    substituted, shift = list[Substitution](), 0
    for each in block.substituted:
        begin = each.begin + shift
        end = begin + len(each.number or each.typed)
        shift += end - begin - (each.end - each.begin)
        if end <= kept:
            substituted.append(each)
        elif block.text[begin:] == first[begin + grown :]:
            substituted.append(replace_fields(each, begin=each.begin + grown, end=each.end + grown))
    own = replace_fields(parse_block(first, block.line, syntax), substituted=tuple(substituted))
    parts = (own, *(parse_block(part, block.line, syntax) for part in rest))
    return [each.with_points(block.pointed) for each in parts]


def read_edits(blocks: Sequence[Block], edits: Iterable[Edit], syntax: Syntax) -> list[Block]:
    """The blocks that edits make of some; those that they do not change are the same, and one of which too little is
    left is gone."""
    edits, found = tuple(edits), list[Block]()
    for block, text in zip(blocks, apply_edits(blocks, edits), strict=True):
        apart = tuple(each for each in block.directives if each.span.line < 0)
        facts = edit_facts(apart, edits)
        if text == block.text and facts == apart:
            found.append(block)
        elif text.strip():
            found += read_edited(block, text, syntax)
            found[-1] = replace_fields(found[-1], directives=(*found[-1].directives, *facts))
    return found


def edits_of_words(
    blocks: Sequence[Block], dropped: Iterable[str], added: Iterable[str], changed: Mapping[str, str]
) -> list[Edit]:
    """The edits that drop, add and change words of blocks by their addresses, or by line and address: `2:,A`. Raises
    ValueError for a word that is not there, or more than once, and for a line that is not theirs."""
    check_type("change", changed, Mapping, 'the new words by the old ones, such as {"K": "K-31."}')
    edits = [drop(_only_word(blocks, address)) for address in _each(dropped)]
    for address, text in changed.items():
        if not isinstance(text, str):
            raise TypeError(f"the new word for {address} is a text such as '{address}5.', not {text!r}")
        edits.append(change(_only_word(blocks, address), text))
    return edits + [_added(blocks, word) for word in _each(added)]


def _each(words: Iterable[str]) -> Iterable[str]:
    return (words,) if isinstance(words, str) else words


def _added(blocks: Sequence[Block], word: str) -> Edit:
    line, _, text = word.rpartition(":")
    lines = [str(block.line) for block in blocks]
    if line and line not in lines:
        raise ValueError(f"{word}: the blocks of the contour are in program lines {', '.join(lines)}")
    return Edit(EditKind.ADD, text, text=text, line=int(line or lines[-1]))


def _only_word(blocks: Sequence[Block], address: str) -> Word:
    line, _, own = address.upper().rpartition(":")
    words = [
        word for block in blocks for word in block.words if word.address == own and line in ("", str(word.span.line))
    ]
    if not words:
        have = dict.fromkeys(word.address for block in blocks for word in block.words)
        raise ValueError(f"the blocks have no word {address}; they have {', '.join(have)}")
    if len(words) > 1:
        lines = list(dict.fromkeys(word.span.line for word in words))
        told = f"; name one of them with its line, such as {lines[0]}:{own}" if len(lines) > 1 else ""
        raise ValueError(f"the blocks have {len(words)} words {address}{told}")
    return words[0]


def with_value(word: Word, value: str, words: WordSpelling) -> str:
    """The text of a word, or of a fact, with another value; empty for a fact that states none."""
    if word.address != FACT:
        return words.spell(word.address, value)
    stated = FACT_VALUE.search(word.text)
    return f"{word.text[: stated.start('value')]}{value}" if stated else ""


FACT_VALUE = late_pattern(r"(?:=|\bat)\s*+(?P<value>[+-]?+(?>\d++\.?+\d*+|\.\d++)|\?)\s*+$")
"""The value that a fact states: `= 30`, `at 10`."""


def typed_text(value: float | Decimal) -> str:
    """A number as a word has it: with a point, without an exponent, and all its digits."""
    text = format(value if isinstance(value, Decimal) else Decimal(repr(float(value))), "f")
    return text if "." in text else f"{text}."


def signed(edits: Iterable[Edit], blocks: Iterable[Block]) -> tuple[Edit, ...]:
    """Edits in the style of some blocks: with a plus before positive coordinates and angles, where words have one."""
    edits = tuple(edits)
    if not has_plus(blocks):
        return edits
    return tuple(replace(edit, text=with_plus(edit.text, is_like="+" in edit.old)) for edit in edits)


def has_plus(blocks: Iterable[Block]) -> bool:
    """Whether any word has a number with a plus."""
    return any(_PLUS.search(word.text) for block in blocks for word in block.words)


def with_plus(text: str, *, is_like: bool = False) -> str:
    """A word with a plus before its positive number, if it is a coordinate or an angle, or like one that has it."""
    match = _POSITIVE.fullmatch(text)
    is_place = match is not None and (match["address"][-1] in _AXES or match["address"] in _ANGLES)
    return f"{match['address']}+{match['number']}" if match is not None and (is_place or is_like) else text


_PLUS = re.compile(r"[A-Za-z][ \t]*\+[\d.]")
_POSITIVE = re.compile(r"(?P<address>[A-Za-z]+)(?P<number>[\d.]+)")
_AXES = "XYZxyz"
_ANGLES = ("AN", "IAN", "PA", "IPA", "CCA", "CCPA", "ICCPA")
"""Angles of Klartext, the only language in which a plus is usual."""


def edited(blocks: Sequence[Block], edits: Iterable[Edit]) -> str:
    """The lines of the blocks with the edits made, without those of which too little is left."""
    texts = zip(blocks, apply_edits(blocks, edits), strict=True)
    return "\n".join(text for block, text in texts if text or not block.text)


def _with_moved(text: str, edits: Iterable[Edit]) -> str:
    """A block with the words that are moved out of it before and behind, each in a line of its own; they are skipped
    where the block is."""
    moved = [(ERRANDS.index(edit.errand), edit) for edit in edits if edit.kind is EditKind.MOVE and edit.errand]
    moved.sort(key=lambda each: (each[0], each[1].span))
    skipped = re.match(r"\s*(/\d*)", text)
    skip = skipped[1] if skipped else ""
    sides = {side: [skip + edit.old for row, edit in moved if ERRANDS[row].side is side] for side in InsertionSide}
    return "\n".join([*sides[InsertionSide.BEFORE], text, *sides[InsertionSide.AFTER]])


def edit_facts(facts: Iterable[Directive], edits: Iterable[Edit]) -> tuple[Directive, ...]:
    """The facts that are stated apart from the blocks, with the edits made."""
    by_place = {edit.span: edit for edit in edits if edit.address == FACT}
    found = []
    for fact in facts:
        edit = by_place.get(fact.span)
        if edit is None:
            found.append(fact)
        elif edit.text:
            found.append(read_directive(edit.text, fact.span.line))
    return tuple(found)


def _tidy(text: str) -> str:
    """Comments without the separators that a dropped fact leaves, or without the comment that it leaves empty."""
    text = re.sub(r"([(\[]\s*+contoursolve\s*+:)\s*+(?>(?:;\s*+)+)", r"\1 ", text, flags=re.IGNORECASE)
    text = re.sub(r"(?<!\s)\s*+[(\[]\s*+contoursolve\s*+:\s*+[)\]]", "", text, flags=re.IGNORECASE)
    return re.sub(r"(?<!\s)\s*+;(?:\s*+;)*(\s*+[);\]])", r"\1", text)


def _with_code(text: str, code: str, syntax: Syntax) -> str:
    """A G code added before the first word that is more than a number."""
    return restate(parse_block(text, 1, syntax), f"G{int(code.removeprefix('G')):02}").text


def _insert(text: str, word: str, syntax: Syntax) -> str:
    """A word added behind the last one, before a comment."""
    comment = syntax.comment.search(text)
    cut = comment.start() if comment else len(text)
    head, tail = text[:cut].rstrip(), text[cut:]
    return f"{head} {word}" + (f" {tail}" if tail else "")


AT_MOST, AT_LEAST = ROUND_DOWN, ROUND_UP
"""The way in which the size of a limit is rounded, whatever its sign."""


def write_word(address: str, value: float, lexicon: Lexicon, unit: Length, rounding: str = ROUND_HALF_EVEN) -> str:
    """A word for a value in mm (radius) or degrees, rounded to the control's least increment: a limit (`AT_MOST`,
    `AT_LEAST`) to what is within it."""
    row = lexicon.addresses[address]
    value = value if row.clockwise_from is None else float(row.clockwise_from) - value
    number = rounded(value, row.unit, lexicon, unit, is_diameter=row.is_diameter, rounding=rounding)
    text = f"{number:f}".rstrip("0")
    if text.endswith(".") and (lexicon.numbers.without_point is WithoutPoint.AS_WRITTEN or number == 0):
        text = text[:-1]
    return lexicon.spell(address, text)


def rounded(
    value: float, kind: Unit, lexicon: Lexicon, unit: Length, *, is_diameter: bool, rounding: str = ROUND_HALF_EVEN
) -> Decimal:
    """A value in mm (radius) or degrees as a number of the program, to the least increment; no negative zero."""
    number = Decimal(repr(value))
    if kind is not Unit.DEGREE:
        number = number / unit.in_mm * (2 if is_diameter else 1)
    return number.quantize(lexicon.numbers.step(kind, unit), rounding) + 0
