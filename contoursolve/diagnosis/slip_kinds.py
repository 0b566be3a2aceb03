"""Slips of people who write programs: one table of kinds, each with how unlikely it is, and what a word may have been
meant to be if it happened."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from decimal import Decimal
from functools import cached_property, lru_cache

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.edits import Edit, EditKind
from contoursolve.diagnosis.examine import LEADING
from contoursolve.diagnosis.spelling import respelled
from contoursolve.gcode import FACT, Word, mended, spell
from contoursolve.geometry import CornerShape, Plane, Unit
from contoursolve.reading import Dialect, Effect, Lexicon, Modes, ParsedContour, WithoutPoint

_WORD = re.compile(
    r"(?P<address>RND[ \t]+R|,?[ \t]*[A-Za-z](?![A-Za-z_#])|[A-Za-z]\w*=[A-Za-z]+(?=\()|#?[A-Za-z]\w*?(?=[ \t]*=)"
    r"|[A-Za-z]{2,}(?=[ \t]*[+-]?[\d.]))"
    r"[ \t]*[=(]?[ \t]*(?P<sign>[+-]?)(?P<number>\d+\.?\d*|\.\d+)\)?",
    re.ASCII,
)
_TWO_WORDS = {"RND R": "ROUNDING", "CHF": "CHAMFER"}
"""The addresses of Klartext's words whose text is two words."""


def _address_in(match: re.Match[str]) -> str:
    """The address of a word, as `spell` takes it."""
    name = " ".join(match["address"].upper().split())
    return match["address"] if "=" in match[0] else _TWO_WORDS.get(name, match["address"])


_DECIMALS = 3
"""Decimals that a word of either control has at most."""
_ABOUT, _NEARLY = 0.01, 0.003
"""mm or degrees: by so much the value that agrees with rounded words may miss the one that was meant; the second where
many values may be meant."""
_LONG = 4
"""Digits of a number that may have lost its point in the middle."""
_NEAR = dict(zip("1234567890", ("2", "13", "24", "35", "46", "57", "68", "79", "80", "9"), strict=True))
"""The digits beside each digit on a keyboard."""
_ROWS = ("qwertyuiop", "asdfghjkl", "zxcvbnm")
"""The letters of a keyboard, a row each."""
_ALIKE = ("ABCE", "IJK", "XU", "ZW", "YV", "XYZ", "UVW", "PQ", "PR", "QR", "RC", "RI")
"""Letters that mean something alike: angles, centres, an axis and its increment, axes, sizes."""


class Speech(Struct, frozen=True):
    """The words that may stand at a place: the control's table, the addresses that are allowed, those that give corners
    a size, and the words that have no meaning there."""

    lexicon: Lexicon
    allowed: frozenset[str]
    shapes: Mapping[str, CornerShape]
    claim: ParsedContour | None = None
    turned: str = ""
    """The axis of the plane that counts diameters, if one does."""

    @classmethod
    def of(cls, claim: ParsedContour) -> "Speech":
        """Those of a contour."""
        rows = claim.form.outline.shapes.items()
        shapes = {claim.vocabulary[name][0]: shape for name, shape in rows if name in claim.vocabulary}
        for shape in (shape for name, shape in rows if name not in claim.vocabulary):
            # The axis along which the size is measured has its letter.
            shapes |= {letter: shape for letter in "IJK" if letter in claim.vocabulary}
        return cls(claim.lexicon, claim.form.allowed, shapes, claim, turned_axis(claim.before.plane))

    @classmethod
    def of_control(cls, dialect: Dialect, turned: str) -> "Speech":
        """Those of a control, outside its contours."""
        lexicon = dialect.modes.lexicon
        return cls(lexicon, frozenset(lexicon.addresses), {}, None, turned)

    def is_angle(self, word: Word) -> bool:
        """Whether a word states an angle."""
        row = self.lexicon.addresses.get(word.address)
        return row is not None and row.unit is Unit.DEGREE

    def is_diameter(self, word: Word) -> bool:
        """Whether a word states a diameter."""
        row = self.lexicon.addresses.get(word.address)
        return row is not None and bool(self.turned) and (row.is_diameter or row.axis == self.turned)

    def is_axis(self, word: Word) -> bool:
        """Whether a word moves an axis."""
        row = self.lexicon.addresses.get(word.address)
        return row is not None and bool(row.axis)

    def is_known(self, address: str) -> bool:
        """Whether words with this address may stand there."""
        name = address.replace(" ", "").upper()
        return name in self.lexicon.addresses and name in self.allowed


def turned_axis(plane: Plane) -> str:
    """The axis of a plane that counts diameters; empty for none."""
    return next((axis for axis, is_diameter in zip(plane.axes, plane.diameters, strict=True) if is_diameter), "")


class Typed(Struct, frozen=True, dict=True):
    """A word as it was typed, in parts, and where it stands."""

    speech: Speech
    word: Word
    address: str
    sign: str
    number: str
    stated: frozenset[str] = frozenset()
    """The addresses of its block."""

    def with_number(self, number: str) -> str:
        """The word with other digits."""
        return spell(self.address, self.sign + number)

    def with_value(self, value: Decimal) -> str:
        """The word with another number, spelled as this one is."""
        sign = "-" if value < 0 else "+" if self.sign == "+" else ""
        text = f"{abs(value):f}"
        text = text.rstrip("0").rstrip(".") if "." in text else text
        if self.number.endswith(".") or ("." in self.number and "." not in text and self.counts):
            text += "" if "." in text else "."
        return spell(self.address, sign + text)

    @cached_property
    def value(self) -> Decimal:
        """Its number."""
        return Decimal(self.sign + self.number)

    @property
    def is_choice(self) -> bool:
        """Whether only its sign counts, and chooses."""
        return self.unit is Unit.SIGN

    @cached_property
    def unit(self) -> Unit | None:
        """The unit of its number; None for a word that the contour does not know."""
        row = self.speech.lexicon.addresses.get(self.word.address)
        return row.unit if row else None

    @property
    def counts(self) -> bool:
        """Whether a number without a point counts least increments."""
        return self.speech.lexicon.numbers.without_point is WithoutPoint.LEAST_INCREMENTS


class SlipKind(Struct, frozen=True):
    """A kind of slip: its name, what happened in words, how unlikely it is, and what a word may have been meant to be.

    `cost` is the negative natural logarithm of its share among slips, about, and `why` where that is known from.
    """

    name: str
    sentence: str
    cost: float
    why: str
    texts: Callable[[Typed], Iterator[str]] = lambda _: iter(())
    is_of_digits: bool = False
    """Whether it changes digits or the point."""
    is_of_numbers: bool = False
    """Whether it changes the value of a word, not its address."""
    is_frequent: bool = True
    """Whether it leaves few texts of each word; dozens else."""


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


def _point_moved(typed: Typed) -> Iterator[str]:
    """The point a place to the right, or to the left of the last digit."""
    whole, point, rest = typed.number.partition(".")
    if rest and whole:
        moved = (whole + rest[0]).lstrip("0") or "0"
        tail = rest[1:].rstrip("0")
        yield typed.with_number(moved + (f".{tail}" if tail else point if typed.counts else ""))
    if len(whole) > 1 and whole[-1] != "0" and (point or typed.counts):
        yield typed.with_number(f"{whole[:-1]}.{whole[-1]}{rest}")


def _zero_added(typed: Typed) -> Iterator[str]:
    whole, point, rest = typed.number.partition(".")
    if len(whole) > 1 and whole.endswith("0"):
        yield typed.with_number(whole[:-1] + point + rest)


def _zero_lost(typed: Typed) -> Iterator[str]:
    whole, point, rest = typed.number.partition(".")
    # Nobody turns so far to the right.
    is_angle = typed.unit is Unit.DEGREE
    is_turned_far = is_angle and typed.value * 10 < -_HALF
    # Lengths of three digits are rare, and so are angles of four.
    if whole.strip("0") and not is_turned_far and not rest and len(whole) <= (2 if is_angle else 1):
        yield typed.with_number(f"{whole}0{point}")


def _zero_first(typed: Typed) -> Iterator[str]:
    """A zero that stands before another digit, behind it."""
    match = re.match(r"0([1-9])", typed.number)
    if match:
        yield typed.with_number(f"{match[1]}0{typed.number[2:]}")


def _sign_lost(typed: Typed) -> Iterator[str]:
    is_turned_far = typed.unit is Unit.DEGREE and abs(typed.value) > _HALF
    if typed.sign != "-" and float(typed.number) and not typed.is_choice and not is_turned_far:
        yield spell(typed.address, "-" + typed.number)


def _sign_added(typed: Typed) -> Iterator[str]:
    if typed.sign == "-" and not typed.is_choice:
        yield spell(typed.address, typed.number)


def _sign_of_choice(typed: Typed) -> Iterator[str]:
    if typed.is_choice and float(typed.number):
        yield spell(typed.address, ("" if typed.sign == "-" else "-") + typed.number)


def _turned(typed: Typed, others: Callable[[Decimal], Iterable[Decimal]]) -> Iterator[str]:
    """Angles that follow from that of a line, or of an arc."""
    if typed.unit is Unit.DEGREE and 0 < abs(typed.value) <= _FULL_TURN:
        for angle in others(typed.value):
            if (angle or abs(typed.value) == _HALF) and abs(angle) < _FULL_TURN:
                yield typed.with_value(angle)


_FULL_TURN, _HALF, _QUARTER = 360, 180, 90


def _supplement(angle: Decimal) -> Iterator[Decimal]:
    if abs(angle) < _HALF:
        yield _HALF - angle if angle > 0 else -_HALF - angle


def _opposite(angle: Decimal) -> Iterator[Decimal]:
    yield angle - _HALF if angle >= _HALF else angle + _HALF


def _other_axis(angle: Decimal) -> Iterator[Decimal]:
    yield from (angle + _QUARTER, _QUARTER - angle, angle - _QUARTER)


def _complement(angle: Decimal) -> Iterator[Decimal]:
    """The angle with the other axis, in the same quadrant."""
    turned = angle % _HALF
    other = _QUARTER - turned if turned < _QUARTER else _HALF + _QUARTER - turned
    yield angle - turned + other


def _twice_or_half(typed: Typed) -> Iterator[str]:
    """A diameter as a radius and the reverse, where X counts diameters; a radius as a diameter."""
    row = typed.speech.lexicon.addresses.get(typed.word.address)
    if row is None or row.unit is not Unit.MM or not typed.value:
        return
    if row.is_diameter:
        yield from (typed.with_value(typed.value * 2), typed.with_value(typed.value / 2))
    elif typed.word.address in _RADII and typed.word.address not in typed.speech.shapes:
        yield typed.with_value(typed.value / 2)


def _half_across(typed: Typed) -> Iterator[str]:
    """A length across a turned part, as the difference of the diameters on its drawing."""
    row = typed.speech.lexicon.addresses.get(typed.word.address)
    # The size of a corner is none.
    is_length = row is not None and row.unit is Unit.MM and not row.is_diameter
    is_length = is_length and typed.word.address not in typed.speech.shapes
    if is_length and typed.value and typed.speech.turned and typed.word.address in _ACROSS:
        yield typed.with_value(typed.value / 2)


_ACROSS, _RADII = ("I", "U"), ("R", "CR", "I", "J", "K")
"""Words of lengths across a turned part that are radii, and radii and centres; drawings have diameters."""


def _comma_of_address(typed: Typed) -> Iterator[str]:
    if re.match(r",\s", typed.word.text):
        # That comma belongs to the number before it.
        return
    if "," in typed.address:
        yield f"{typed.address[1:].strip()}{typed.sign}{typed.number}"
    elif len(typed.address) == 1:
        yield f",{typed.word.text}"


def _neighbour(typed: Typed) -> Iterator[str]:
    """The word of the other corner that gives it the same shape; a radius is a rounding."""
    shapes = typed.speech.shapes
    shape = shapes.get(typed.address.upper(), CornerShape.FILLET if typed.address.strip(" ,").upper() == "R" else None)
    for address, other in shapes.items():
        if other is shape and address != typed.address.upper():
            yield spell(address, typed.sign + typed.number)


def _swapped(typed: Typed) -> Iterator[str]:
    text = typed.number
    for at in range(len(text) - 1):
        # Within a number, a point is moved rather.
        if text[at] != text[at + 1] and "." not in (text[at : at + 2] if at else text[1:2]):
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
    claim = typed.speech.claim
    word = next((each for each in claim.unknown if each.span == typed.word.span), None) if claim else None
    if claim is not None and word is not None:
        yield respelled(word, claim)


def _other_letter(typed: Typed) -> Iterator[str]:
    """Such a word of one letter, as one that its block has not yet."""
    claim = typed.speech.claim
    if claim is None or len(typed.word.address.lstrip(",#")) > 1:
        return
    if any(each.span == typed.word.span for each in claim.unknown):
        stated = {word.address for block in claim.blocks if block.line == typed.word.span.line for word in block.words}
        for address in claim.lexicon.addresses:
            if address in claim.form.allowed and len(address) == len(typed.word.address) and address not in stated:
                yield spell(address, typed.sign + typed.number)


def _letter_alike(typed: Typed) -> Iterator[str]:
    """A word of one letter as one whose letter means something alike, or lies beside it on a keyboard; where it needs
    its comma, with that."""
    letter = typed.address.strip(" ,").upper()
    if len(letter) != 1 or (letter in _BESIDE and "." not in typed.number):
        return
    alike = dict.fromkeys(other for group in _ALIKE if letter in group for other in group if other != letter)
    alike |= dict.fromkeys(_beside(letter))
    for address in typed.speech.lexicon.addresses:
        bare = address.lstrip(",#")
        is_angle = bare == "ANG" and letter in _ALIKE[0]
        if bare in _AXES if typed.address.startswith(",") else (letter in _AXES and bare not in _AXES):
            # The comma is no axis's; and what moves an axis was meant to move one.
            continue
        if bare in _STEPS and not float(typed.number):
            # Nobody writes an increment of 0.
            continue
        if (bare in alike or is_angle) and address not in typed.stated and address != typed.word.address:
            yield spell(address, typed.sign + typed.number)


def _increment(typed: Typed) -> Iterator[str]:
    """An increment as a control spells it that has no letter for it."""
    axis = dict(zip("UVW", "XYZ", strict=True)).get(typed.address.upper(), "")
    if f"{axis}=IC" in typed.speech.lexicon.addresses:
        yield spell(f"{axis}=IC", typed.sign + typed.number)


_AXES, _STEPS = "XYZUVW", "UVW"
_BESIDE = "MSTFHD"
"""Letters of what has nothing to do with a path: their numbers have no point."""


def _beside(letter: str) -> Iterator[str]:
    """The letters right and left of a letter, and those that touch it in the row above and below."""
    for number, row in enumerate(_ROWS):
        at = row.find(letter.lower())
        if at >= 0:
            near = [row[at - 1 : at] if at else "", row[at + 1 : at + 2]]
            near += [_ROWS[number - 1][at : at + 2]] if number else []
            near += [_ROWS[number + 1][max(at - 1, 0) : at + 1]] if number + 1 < len(_ROWS) else []
            yield from "".join(near).upper()


_TYPING = "typing: which fingers and keys go wrong"
_MEANING = "what is mistaken on drawings: slips that machinists and makers of controls name"
_SEEN = "slips by hand and at random, tests/slips and tests/unit/test_typing.py"

UNREADABLE = SlipKind("unreadable", "", 0.3, _TYPING, lambda typed: iter([mended(typed.word.text)]), True, True)
"""Letters for digits, commas for points, two points or signs: told by the finding itself."""
POINT_LOST = SlipKind("point-lost", "", 0.9, _SEEN, _point_lost, True, True)
COMMA = SlipKind("comma", "", 0.9, _SEEN, _comma_of_address)
SIGN_LOST = SlipKind("sign-lost", "a lost minus sign", 1.6, _SEEN, _sign_lost, is_of_numbers=True)
SIGN_ADDED = SlipKind("sign-added", "a minus sign too many", 1.8, _SEEN, _sign_added, is_of_numbers=True)
NEIGHBOUR = SlipKind("neighbour", "the word of another corner", 1.7, _MEANING, _neighbour)
ZERO_FIRST = SlipKind("zero-first", "two digits swapped", 0.4, _TYPING, _zero_first, True, True)
LETTER_ALIKE = SlipKind("letter-alike", "another letter", 2.4, _TYPING, _letter_alike)
SUPPLEMENT = SlipKind(
    "supplement", "the angle from the other side", 1.9, _MEANING, lambda typed: _turned(typed, _supplement), True, True
)
OPPOSITE = SlipKind(
    "opposite", "the other way along the line", 2.3, _MEANING, lambda typed: _turned(typed, _opposite), True, True
)
OTHER_AXIS = SlipKind(
    "other-axis", "the angle from the other axis", 2.9, _MEANING, lambda typed: _turned(typed, _other_axis), True, True
)
COMPLEMENT = SlipKind(
    "complement", "the angle from the other axis", 2.9, _MEANING, lambda typed: _turned(typed, _complement), True, True
)
POINT_LOST_IN_FEW = SlipKind("point-lost-few", "a lost decimal point", 2.2, _TYPING, _point_lost_in_few, True, True)
POINT_MOVED = SlipKind("point-moved", "the decimal point moved", 2.0, _SEEN, _point_moved, True, True)
ZERO_LOST = SlipKind("zero-lost", "a lost zero", 2.3, _SEEN, _zero_lost, True, True)

FEW = (
    UNREADABLE,
    ZERO_FIRST,
    POINT_LOST,
    COMMA,
    SIGN_LOST,
    NEIGHBOUR,
    SIGN_ADDED,
    SlipKind("choice", "the other sign", 1.8, _MEANING, _sign_of_choice, is_of_numbers=True),
    SUPPLEMENT,
    POINT_LOST_IN_FEW,
    POINT_MOVED,
    SlipKind("zero-added", "a zero too many", 2.0, _SEEN, _zero_added, True, True),
    ZERO_LOST,
    SlipKind("other-address", "another word", 0.9, _MEANING, _other_address),
    SlipKind("other-letter", "another letter", 2.1, _TYPING, _other_letter),
    LETTER_ALIKE,
    SlipKind("increment", "a word of another control", 1.0, _MEANING, _increment),
    SlipKind("twice", "a digit typed twice", 2.2, _TYPING, _typed_twice, True, True),
    SlipKind("swapped", "two digits swapped", 2.4, _TYPING, _swapped, True, True),
    OPPOSITE,
    SlipKind("across", "a diameter for a radius", 1.8, _MEANING, _half_across, True, True),
    SlipKind("diameter", "a diameter for a radius, or the reverse", 2.6, _MEANING, _twice_or_half, True, True),
    OTHER_AXIS,
)
"""Kinds that leave few texts of each word."""

OF_DIGITS = (
    SlipKind(
        "key-beside",
        "a key beside",
        3.8,
        _TYPING,
        lambda typed: _exchanged(typed, _NEAR.__getitem__),
        True,
        True,
        False,
    ),
    SlipKind("digit-lost", "a lost digit", 4.0, _TYPING, _digit_lost, True, True, False),
    SlipKind(
        "digit-added",
        "a digit too many",
        4.0,
        _TYPING,
        lambda typed: _exchanged(typed, lambda _: [""]),
        True,
        True,
        False,
    ),
    SlipKind(
        "other-digit",
        "another digit",
        4.8,
        _TYPING,
        lambda typed: _exchanged(typed, lambda _: _NEAR),
        True,
        True,
        False,
    ),
)
"""Kinds that leave dozens."""

ROUND = SlipKind("round", "", 3.0, _SEEN, is_of_digits=True, is_of_numbers=True)
"""Digits that are wrong: the others make it a round number."""

CODE = SlipKind("code", "", 2.0, _TYPING)
"""Another G code, or one that was forgotten."""

SLIPS = (*FEW, CODE, *OF_DIGITS, ROUND)


def texts_of(slip: SlipKind, word: Word, speech: Speech, stated: frozenset[str] = frozenset()) -> Iterator[str]:
    """Words that a word may have been meant to be if a slip happened to it, beside the addresses of its block."""
    typed = typed_as(word, speech, stated)
    if typed is not None:
        yield from texts_for(slip, typed)


def typed_as(word: Word, speech: Speech, stated: frozenset[str] = frozenset()) -> "Typed | None":
    """A word as it was typed, beside the addresses of its block; None if it has no number."""
    match = _WORD.fullmatch(word.text.strip())
    return Typed(speech, word, _address_in(match), match["sign"], match["number"], stated) if match else None


def texts_for(slip: SlipKind, typed: Typed) -> Iterator[str]:
    """The same for a word that is read."""
    speech, word = typed.speech, typed.word
    if slip.is_of_digits and typed.is_choice:
        return
    for text in dict.fromkeys(slip.texts(typed)):
        match = _WORD.fullmatch(text)
        if match is None or not speech.is_known(_address_in(match)) or _says_the_same(text, word.text.strip()):
            continue
        if LEADING.search(text) or (typed.unit is Unit.DEGREE and _is_idle_turn(match, typed)):
            continue
        if not match["number"].strip("0.") and _address_in(match) in speech.shapes:
            # Nobody writes a corner of no size.
            continue
        if len(match["number"].partition(".")[2]) <= max(_DECIMALS, len(typed.number.partition(".")[2])):
            yield text


def _is_idle_turn(match: re.Match[str], typed: Typed) -> bool:
    """Whether an angle differs by whole turns, or becomes more than one, which drawings have not."""
    value = Decimal(match["sign"] + match["number"])
    is_turned = match["address"].upper() == typed.address.upper() and (value - typed.value) % _FULL_TURN == 0
    # A number without a point may count increments.
    is_degrees = "." in match["number"] or not typed.counts or abs(typed.value) <= _FULL_TURN
    return is_turned or (is_degrees and abs(value) > _FULL_TURN)


def mistyped_codes(word: Word, modes: Modes) -> list[str]:
    """The contour codes that a G code may have been meant to be by a slip of its digits."""
    match = _WORD.fullmatch(word.text.strip())
    if word.address != "G" or match is None:
        return []
    typed = Typed(Speech(modes.lexicon, frozenset(), {}), word, match["address"], match["sign"], match["number"])
    meant = {text for slip in SLIPS if slip.is_of_digits and slip is not POINT_LOST for text in slip.texts(typed)}
    codes = [f"G{number}" for number, code in modes.codes.items() if code.effect is Effect.CONTOUR]
    return [code for code in codes if code in meant and code != word.text.strip()]


def recognise(edit: Edit, claim: ParsedContour) -> SlipKind | None:
    """The most plausible slip that explains a change of a word; None if no slip does."""
    if edit.kind is not EditKind.CHANGE or edit.span is None or edit.address == FACT:
        return None
    if edit.address == "G":
        return CODE if edit.text != mended(edit.old) else UNREADABLE
    if edit.text == mended(edit.old):
        return UNREADABLE
    word, speech = Word(edit.address, None, False, edit.old, edit.span), Speech.of(claim)
    kinds = sorted(SLIPS, key=lambda slip: slip.cost)
    return next((slip for slip in kinds if edit.text in texts_of(slip, word, speech)), None)


def explained(word: Word, value: float, claim: ParsedContour, kinds: Iterable[SlipKind] | None = None) -> Iterator[str]:
    """Words that a word may have been meant to be with about this value, mm (radius) or degrees, by any slip or by one
    of some kinds."""
    unit, speech = claim.after.unit, Speech.of(claim)
    for slip in SLIPS if kinds is None else kinds:
        for text in texts_of(slip, word, speech):
            match = _WORD.fullmatch(text)
            if match is None or _address_in(match).replace(" ", "").upper() != word.address:
                continue
            number = match["sign"] + match["number"]
            other = claim.lexicon.value(replace(word, number=Decimal(number), has_point="." in number), unit)
            if other is not None and abs(float(other) - value) <= (_ABOUT if slip.is_frequent else _NEARLY):
                yield text


def partners(address: str) -> Iterator[str]:
    """The words that state a point together with the one of an address, and seldom stand without it."""
    yield from (each for pair in _POINTS if address in pair for each in pair if each != address)


_POINTS = (("CCX", "CCY"), ("ICCX", "ICCY"), ("CCPR", "CCPA"), ("PR", "PA"), ("IPR", "IPA"))


def number_in(text: str) -> str:
    """The number of a word as it is typed, without its sign; empty if it has none."""
    match = _WORD.fullmatch(text.strip())
    return match["number"] if match else ""


@lru_cache(maxsize=1024)
def plain_code(text: str) -> str:
    """A code without a zero that leads."""
    return re.sub(r"^G0+(?=\d)", "G", text.strip().upper())


def _says_the_same(text: str, typed: str) -> bool:
    """Whether two words differ in zeros at most."""
    return text == typed or (
        "." in text and "." in typed and text.rstrip("0") == typed.rstrip("0") and typed.rstrip("0") != ""
    )
