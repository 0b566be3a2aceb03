"""Slips of typing: one table of kinds, each with what a word may have been meant to be, the most plausible first; and
what was meant where a slip keeps a block from being a contour."""

import re
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from decimal import Decimal

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.drafts import has_faults, missing_points, unreadable
from contoursolve.diagnosis.edits import Edit, EditKind, apply_edits, change, mend
from contoursolve.diagnosis.examine import Answer, Depth, Policy, examine
from contoursolve.diagnosis.explain import Context, report, spans_of
from contoursolve.diagnosis.spelling import meant_in, meant_words, respelled
from contoursolve.diagnosis.subsets import blamed_spans, lines_near
from contoursolve.diagnosis.wording import join
from contoursolve.diagnostics import Applicability, Basis, Diagnostic, Fix
from contoursolve.gcode import FACT, Block, Word, lookalike_at, mended, parse_block, spell
from contoursolve.geometry import CornerShape, Unit
from contoursolve.reading import Dialect, Effect, Modes, ParsedContour, ReadIssue, State, WithoutPoint, codes_of

_WORD = re.compile(
    r"(?P<address>,?[ \t]*[A-Za-z](?![A-Za-z_#])|[A-Za-z]\w*=[A-Za-z]+(?=\()|#?[A-Za-z]\w*(?=[ \t=]))"
    r"[ \t]*[=(]?[ \t]*(?P<sign>[+-]?)(?P<number>\d+\.?\d*|\.\d+)\)?",
    re.ASCII,
)
_DECIMALS = 3
"""Decimals that a word of either control has at most."""
_ABOUT, _NEARLY = 0.01, 0.003
"""mm or degrees: by so much the value that agrees with rounded words may miss the one that was meant; the second where
many values may be meant."""
_WHOLE = 2
"""Blocks of a contour that is looked at as a whole."""
_LONG = 4
"""Digits of a number that may have lost its point in the middle."""
_NEAR = dict(zip("1234567890", ("2", "13", "24", "35", "46", "57", "68", "79", "80", "9"), strict=True))
"""The digits beside each digit on a keyboard."""


class Typed(Struct, frozen=True):
    """A word as it was typed, in parts, and the contour that it stands in."""

    claim: ParsedContour | None
    word: Word
    address: str
    sign: str
    number: str

    def with_number(self, number: str) -> str:
        """The word with other digits."""
        return spell(self.address, self.sign + number)

    @property
    def is_choice(self) -> bool:
        """Whether only its sign counts, and chooses."""
        return self.unit is Unit.SIGN

    @property
    def unit(self) -> Unit | None:
        """The unit of its number; None for a word that the contour does not know."""
        row = self.claim.lexicon.addresses.get(self.word.address) if self.claim else None
        return row.unit if row else None

    @property
    def counts(self) -> bool:
        """Whether a number without a point counts least increments."""
        return self.claim is not None and self.claim.lexicon.numbers.without_point is WithoutPoint.LEAST_INCREMENTS


class Slip(Struct, frozen=True):
    """A kind of slip: what happened, in words, and what a word may have been meant to be if it did."""

    sentence: str
    texts: Callable[[Typed], Iterator[str]]
    is_of_digits: bool = True
    """Whether it changes digits or the point."""
    is_of_numbers: bool = True
    """Whether it changes the value of a word, not its address."""


def _point_lost(typed: Typed) -> Iterator[str]:
    if "." in typed.number:
        return
    if typed.counts:
        yield typed.with_number(f"{typed.number}.")
    is_angle = typed.unit is Unit.DEGREE
    if typed.counts or len(typed.number) >= _LONG + is_angle:
        # With as many decimals as the least increment has, it is what was typed where numbers count increments.
        places = range(1, min(_DECIMALS + (not typed.counts), len(typed.number)))
        yield from (typed.with_number(f"{typed.number[:-place]}.{typed.number[-place:]}") for place in places)


def _point_lost_in_few(typed: Typed) -> Iterator[str]:
    """A point in a number that is no larger than many that need none."""
    if not typed.counts and "." not in typed.number and 1 < len(typed.number) < _LONG:
        ends = range(len(typed.number) - 1, 0, -1) if not typed.number.endswith("0") else ()
        yield from (typed.with_number(f"{typed.number[:at]}.{typed.number[at:]}") for at in ends)


def _sign_lost(typed: Typed) -> Iterator[str]:
    if not typed.sign and float(typed.number) and not typed.is_choice:
        yield spell(typed.address, "-" + typed.number)


def _sign_added(typed: Typed) -> Iterator[str]:
    if typed.sign == "-" and not typed.is_choice:
        yield spell(typed.address, typed.number)


def _sign_of_choice(typed: Typed) -> Iterator[str]:
    if typed.is_choice and float(typed.number):
        yield spell(typed.address, ("" if typed.sign == "-" else "-") + typed.number)


def _comma_of_address(typed: Typed) -> Iterator[str]:
    if "," in typed.address:
        yield f"{typed.address[1:].strip()}{typed.sign}{typed.number}"
    elif len(typed.address) == 1:
        yield f",{typed.word.text}"


def _neighbour(typed: Typed) -> Iterator[str]:
    """The word of the other corner that gives it the same shape; a radius is a rounding."""
    shapes = _shapes(typed.claim) if typed.claim else {}
    shape = shapes.get(typed.address.upper(), CornerShape.FILLET if typed.address.strip(" ,").upper() == "R" else None)
    for address, other in shapes.items():
        if other is shape and address != typed.address.upper():
            yield spell(address, typed.sign + typed.number)


def _shapes(claim: ParsedContour) -> dict[str, CornerShape]:
    """The addresses that give corners a size, each with its shape."""
    shapes = claim.form.outline.shapes.items()
    return {claim.vocabulary[name][0]: shape for name, shape in shapes if name in claim.vocabulary}


def _swapped(typed: Typed) -> Iterator[str]:
    text = typed.number
    for at in range(len(text) - 1):
        if text[at] != text[at + 1] and "." not in text[at : at + 2]:
            yield typed.with_number(text[:at] + text[at + 1] + text[at] + text[at + 2 :])


def _typed_twice(typed: Typed) -> Iterator[str]:
    text = typed.number
    for at in range(len(text) - 1):
        if text[at] == text[at + 1]:
            yield typed.with_number(text[:at] + text[at + 1 :])


def _exchanged(typed: Typed, others: Callable[[str], Iterable[str]]) -> Iterator[str]:
    """Each digit with each of some others for it."""
    text = typed.number
    for at, digit in enumerate(text):
        if digit.isdigit():
            yield from (typed.with_number(text[:at] + other + text[at + 1 :]) for other in others(digit))


def _digit_lost(typed: Typed) -> Iterator[str]:
    text = typed.number
    for at in range(len(text) + 1):
        yield from (typed.with_number(text[:at] + digit + text[at:]) for digit in _NEAR)


def _other_address(typed: Typed) -> Iterator[str]:
    """A word of which the contour has no address, as the one that it was most plausibly meant to be."""
    claim = typed.claim
    word = next((each for each in claim.unknown if each.span == typed.word.span), None) if claim else None
    if claim is not None and word is not None:
        yield respelled(word, claim)


def _other_letter(typed: Typed) -> Iterator[str]:
    """Such a word of one letter, as one that its block has not yet."""
    claim = typed.claim
    if claim is None or len(typed.word.address.lstrip(",#")) > 1:
        return
    if any(each.span == typed.word.span for each in claim.unknown):
        stated = {word.address for block in claim.blocks if block.line == typed.word.span.line for word in block.words}
        for address in claim.lexicon.addresses:
            if address in claim.form.allowed and len(address) == len(typed.word.address) and address not in stated:
                yield spell(address, typed.sign + typed.number)


UNREADABLE = Slip("", lambda typed: iter([mended(typed.word.text)]))
"""Letters for digits, commas for points, two points or signs: told by the finding itself."""
POINT_LOST = Slip("", _point_lost)
SIGN_LOST = Slip("a lost minus sign", _sign_lost, is_of_digits=False)
SIGN_ADDED = Slip("a minus sign too many", _sign_added, is_of_digits=False)
NEIGHBOUR = Slip("the word of another corner", _neighbour, is_of_digits=False, is_of_numbers=False)

FEW = (
    UNREADABLE,
    POINT_LOST,
    Slip("", _comma_of_address, is_of_digits=False, is_of_numbers=False),
    SIGN_LOST,
    NEIGHBOUR,
    SIGN_ADDED,
    Slip("the other sign", _sign_of_choice, is_of_digits=False),
    Slip("a lost decimal point", _point_lost_in_few),
    Slip("a word of another control", _other_address, is_of_digits=False, is_of_numbers=False),
    Slip("another letter", _other_letter, is_of_digits=False, is_of_numbers=False),
    Slip("a digit typed twice", _typed_twice),
    Slip("two digits swapped", _swapped),
)
"""Kinds that leave few texts of each word."""

OF_DIGITS = (
    Slip("a key beside", lambda typed: _exchanged(typed, _NEAR.__getitem__)),
    Slip("a lost digit", _digit_lost),
    Slip("a digit too many", lambda typed: _exchanged(typed, lambda _: [""])),
    Slip("another digit", lambda typed: _exchanged(typed, lambda _: _NEAR)),
)
"""Kinds that leave dozens."""

ROUND = Slip("", lambda _: iter(()))
"""Digits that are wrong: the others make it a round number."""

CODE = Slip("", lambda _: iter(()), is_of_digits=False, is_of_numbers=False)

SLIPS = (*FEW, CODE, *OF_DIGITS, ROUND)


def texts_of(slip: Slip, word: Word, claim: ParsedContour) -> Iterator[str]:
    """Words that a word may have been meant to be if a slip happened to it."""
    typed = _typed(word, claim)
    if typed is None or (slip.is_of_digits and typed.is_choice):
        return
    for text in dict.fromkeys(slip.texts(typed)):
        match = _WORD.fullmatch(text)
        if match is None or not _is_known(match["address"], claim) or _says_the_same(text, word.text.strip()):
            continue
        if _LEADING.search(text):
            continue
        if not match["number"].strip("0.") and match["address"] in _shapes(claim):
            # Nobody writes a corner of no size.
            continue
        if len(match["number"].partition(".")[2]) <= max(_DECIMALS, len(typed.number.partition(".")[2])):
            yield text


def mistyped_codes(word: Word, modes: Modes) -> list[str]:
    """The contour codes that a G code may have been meant to be by a slip of its digits."""
    match = _WORD.fullmatch(word.text.strip())
    if word.address != "G" or match is None:
        return []
    typed = Typed(None, word, match["address"], match["sign"], match["number"])
    meant = {text for slip in SLIPS if slip.is_of_digits and slip is not POINT_LOST for text in slip.texts(typed)}
    codes = [f"G{number}" for number, code in modes.codes.items() if code.effect is Effect.CONTOUR]
    return [code for code in codes if code in meant and code != word.text.strip()]


def other_codes(answer: Answer, modes: Modes) -> Iterator[tuple[Edit, ...]]:
    """The G codes of a contour as those of other contours that they may have been meant to be; none of a code that its
    block repeats, because the other one would stay. And a code that may have been forgotten, where words mean nothing
    without it."""
    words = [word for block in answer.claim.blocks for word in block.words]
    times = Counter((word.span.line, word.address, word.number) for word in words)
    words = [word for word in words if times[word.span.line, word.address, word.number] == 1]
    yield from ((change(word, text),) for word in words for text in mistyped_codes(word, modes))
    codes = [f"G{number}" for number, code in modes.codes.items() if code.effect is Effect.CONTOUR]
    lines = dict.fromkeys(word.span.line for word in answer.claim.unknown)
    for line in sorted(lines.keys() - {word.span.line for word in words if word.address == "G"}):
        yield from ((Edit(EditKind.ADD, "G", text=code, line=line),) for code in codes)


def recognise(edit: Edit, claim: ParsedContour) -> Slip | None:
    """The most plausible slip that explains a change of a word; None if no slip does."""
    if edit.kind is not EditKind.CHANGE or edit.span is None or edit.address == FACT:
        return None
    if edit.address == "G":
        return CODE if edit.text != mended(edit.old) else UNREADABLE
    if edit.text == mended(edit.old):
        return UNREADABLE
    word = Word(edit.address, None, False, edit.old, edit.span)
    return next((slip for slip in SLIPS if edit.text in texts_of(slip, word, claim)), None)


def explained(word: Word, value: float, claim: ParsedContour) -> Iterator[str]:
    """Words that a word may have been meant to be with about this value, mm (radius) or degrees."""
    unit = claim.after.unit
    for slip in SLIPS:
        for text in texts_of(slip, word, claim):
            match = _WORD.fullmatch(text)
            if match is None or match["address"].replace(" ", "").upper() != word.address:
                continue
            number = match["sign"] + match["number"]
            other = claim.lexicon.value(replace(word, number=Decimal(number), has_point="." in number), unit)
            if other is not None and abs(float(other) - value) <= (_NEARLY if slip in OF_DIGITS else _ABOUT):
                yield text


def suspects(answer: Answer, tied: Collection[str]) -> list[Word]:
    """The words in which a slip may lie: those that contradict each other, those that errors are about, the others; of
    a chain only those near an error."""
    claim = answer.claim
    meant = meant_words(claim) if claim.unknown or has_faults(claim) else ()
    words = list(dict.fromkeys(word for word in (*claim.unknown, *claim.repeated, *claim.words.values())))
    words = [word for word in words if not lookalike_at(meant, word.span) and not word.is_asked]
    blamed = blamed_spans(answer)
    torn = [word for word in words if _LEADING.search(word.text)]
    if torn:
        # Nobody writes 08.4: that is where the slip is.
        return torn
    contradicting = {claim.words[name].span for name in tied if name in claim.words}
    if len(claim.blocks) > _WHOLE:
        lines = lines_near(claim, blamed | contradicting)
        words = [word for word in words if word.span.line in lines]
    # Of two words for one corner, the later one is that of the corner behind.
    first = {name for row in claim.form.outline.corners[:1] for name in row.shapes}
    late = {word.address for word in claim.repeated} & first
    order = {
        word: -at if word.address in late else at for at, word in enumerate(sorted(words, key=lambda word: word.span))
    }
    return sorted(words, key=lambda word: (word.span not in contradicting, word.span not in blamed, order[word]))


_LEADING = re.compile(r"[A-Za-z][ \t]*+[=(]?+[ \t]*+[+-]?0\d")


def slips(answer: Answer, kinds: Iterable[Slip], words: Iterable[Word]) -> Iterator[tuple[Edit, ...]]:
    """One word as it may have been meant, by each kind of slip; what cannot be read besides is taken out."""
    claim, words = answer.claim, list(words)
    forced = tuple(next(unreadable(claim), ()))
    taken_out = {(edit.address, edit.span.line) for edit in forced if edit.span is not None}
    for kind in kinds:
        for word in words:
            same, rest = (word.address, word.span.line), forced
            if same in taken_out:
                rest = tuple(edit for edit in forced if edit.span is None or (edit.address, edit.span.line) != same)
            for text in texts_of(kind, word, claim):
                yield (*rest, change(word, text))


def point_slips(answer: Answer) -> Iterator[tuple[Edit, ...]]:
    """Points in the words that are said to lack one: in all of them, then in each."""
    yield from missing_points(answer)
    lacking = spans_of(answer.diagnostics, ReadIssue.POINT_MISSING)
    words = [word for word in answer.claim.words.values() if word.span in lacking]
    yield from slips(answer, (POINT_LOST,), words)


def _typed(word: Word, claim: ParsedContour) -> Typed | None:
    match = _WORD.fullmatch(word.text.strip())
    return None if match is None else Typed(claim, word, match["address"], match["sign"], match["number"])


def _says_the_same(text: str, typed: str) -> bool:
    """Whether two words differ in zeros at most."""
    return text == typed or (
        "." in text and "." in typed and text.rstrip("0") == typed.rstrip("0") and typed.rstrip("0") != ""
    )


def _is_known(address: str, claim: ParsedContour) -> bool:
    name = address.replace(" ", "").upper()
    return name in claim.lexicon.addresses and name in claim.form.allowed


# Blocks that are a contour but for a slip: a comma that is missing, a letter that looks like a digit -------------

_LINES = (0, 1)
_OF_A_LINE = (
    Effect.MOTION,
    Effect.PLANE,
    Effect.UNITS,
    Effect.COMPENSATION,
    Effect.ABSOLUTE,
    Effect.INCREMENTAL,
    Effect.NONE,
)


def explain_commas(
    context: Context,
    dialect: Dialect,
    blocks: Sequence[Block],
    states: tuple[State, State],
    previous: tuple[Sequence[Block], State] | None = None,
) -> Iterator[Diagnostic]:
    """Words of a line, the first of some blocks, whose address the control reads with a comma only: each with the
    comma as its fix, if that makes a contour that is solved. `states` are those before and after the block; `previous`
    are the blocks before it, which may be part of the contour then, and the state before them."""
    block, (before, after) = blocks[0], states
    addresses = dialect.modes.lexicon.addresses
    codes = codes_of(block, dialect.modes)
    is_line = after.motion in _LINES and not block.macro
    if not is_line or any(isinstance(code, Word) or code.effect not in _OF_A_LINE for code in codes):
        return
    for word in block.words:
        text = f",{word.text.strip()}" if f",{word.address}" in addresses else ""
        if not text:
            continue
        finding = report(context, ReadIssue.COMMA_MISSING, Basis.RULE, [word], meant=text)
        edit = change(word, text)
        found, replacement = _read(dialect, blocks, [edit], before)
        fixes = tuple(_tried(dialect, blocks[0], found, [edit], replacement))
        if previous and not fixes:
            edited = parse_block(replacement, block.line, block.syntax)
            other = dialect.find([*previous[0], edited, *blocks[1:]], 0, previous[1], dialect.modes)
            other = other if other and edited in other.blocks else None
            fixes = tuple(_tried(dialect, block, other, [edit], replacement))
        if fixes or any(map(block.find, after.plane.axes)):
            yield replace(finding, fixes=fixes)


def explain_codes(
    context: Context, dialect: Dialect, blocks: Sequence[Block], before: State, findings: Sequence[Diagnostic]
) -> Iterator[Diagnostic]:
    """G codes of a block, the first of some, that the control does not know and with which it is a contour that is
    solved if one slip of their digits is mended, as in G110."""
    yield from findings
    for word in blocks[0].words:
        for text in mistyped_codes(word, dialect.modes) if word.number not in dialect.modes.codes else ():
            edit = change(word, text)
            found, replacement = _read(dialect, blocks, [edit], before)
            fixes = tuple(_tried(dialect, blocks[0], found, [edit], replacement))
            if fixes:
                finding = report(context, ReadIssue.CODE_MISTYPED, Basis.RULE, [word], meant=text)
                yield replace(finding, fixes=fixes)


def explain_letters(
    context: Context, dialect: Dialect, blocks: Sequence[Block], before: State, findings: Sequence[Diagnostic]
) -> Iterator[Diagnostic]:
    """The findings about a block, the first of some, that is a contour if letters of its G code are the digits that
    they look like: with these digits as the fix, if it is solved then. `before` is the state before it."""
    meant = meant_in(blocks[0], [fault.span for fault in blocks[0].faults])
    edits = [mend(each) for each in meant]
    found, replacement = _read(dialect, blocks, edits, before)
    if found is None or not any(each.is_code for each in meant):
        yield from findings
        return
    fixes = tuple(_tried(dialect, blocks[0], found, edits, replacement))
    # A letter for a digit is no word.
    findings = [each for each in findings if each.about not in _OF_WORDS or not lookalike_at(meant, each.span)]
    blamed = [each for each in findings if lookalike_at(meant, each.span)]
    if not blamed:
        words = [Word(each.address, None, False, each.old, each.span) for each in meant]
        text = join([each.new for each in meant])
        yield replace(report(context, ReadIssue.LETTER_FOR_DIGIT, Basis.RULE, words, meant=text), fixes=fixes)
    for each in findings:
        yield replace(each, fixes=fixes) if blamed and each is blamed[0] else each


_OF_WORDS = (ReadIssue.WORD_UNKNOWN, ReadIssue.WORD_MISTYPED)


def _read(
    dialect: Dialect, blocks: Sequence[Block], edits: Sequence[Edit], before: State
) -> tuple[ParsedContour | None, str]:
    """The contour that begins with the first of some blocks when it is edited, if one does; and its text then."""
    (text,) = apply_edits(blocks[:1], edits)
    found = dialect.find([parse_block(text, blocks[0].line, blocks[0].syntax), *blocks[1:]], 0, before, dialect.modes)
    return (found if isinstance(found, ParsedContour) and found.form.is_contour else None), text


def _tried(
    dialect: Dialect, block: Block, found: ParsedContour | None, edits: Sequence[Edit], replacement: str
) -> Iterator[Fix]:
    """The edits of a block as a fix, if they make a contour that is solved."""
    if found is not None and examine(found, dialect.rules, Policy.ENFORCE, depth=Depth.VERDICT).contour:
        told = "; ".join(map(str, edits))
        yield Fix(told, replacement, Applicability.CHANGES_CONTOUR, replaced=block.text)
