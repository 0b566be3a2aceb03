"""Slips of one word: one table of kinds, each with how unlikely it is, and what a word may have been meant to be if it
happened. Slips of several words, of codes and of blocks stand in `slips_of_blocks`."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from decimal import Decimal
from enum import IntEnum
from functools import cached_property, lru_cache

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.edits import Edit, EditKind
from contoursolve.diagnosis.examine import LEADING
from contoursolve.diagnosis.spelling import respelled
from contoursolve.gcode import FACT, Word, mended
from contoursolve.geometry import CornerShape, Plane, Unit
from contoursolve.numeric import trimmed
from contoursolve.reading import Address, Control, Effect, Lexicon, Modes, ParsedContour, WithoutPoint

_WORD = re.compile(
    r"(?P<address>RND[ \t]+R|,?[ \t]*[A-Za-z](?![A-Za-z_#])|[A-Za-z]\w*=[A-Za-z]+(?=\()|#?[A-Za-z]\w*?(?=[ \t]*=)"
    r"|[A-Za-z]{2,}(?=[ \t]*[+-]?[\d.]))"
    r"[ \t]*[=(]?[ \t]*(?P<sign>[+-]?)(?P<number>\d+\.?\d*|\.\d+)\)?",
    re.ASCII,
)
_DECIMALS = 3
"""Decimals that a word of either control has at most."""
_ABOUT, _NEARLY = 0.01, 0.003
"""mm or degrees: by so much the value that agrees with rounded words may miss the one that was meant; the second where
many values may be meant."""
_LONG = 4
"""Digits of a number that may have lost its point in the middle."""
_FULL_TURN, _HALF, _QUARTER = 360, 180, 90
_BESIDE_DIGIT = dict(zip("1234567890", ("2", "13", "24", "35", "46", "57", "68", "79", "80", "9"), strict=True))
_ROWS = ("qwertyuiop", "asdfghjkl", "zxcvbnm")
"""The digits beside each digit on a keyboard, and the letters of one, a row each."""
_ALIKE = ("ABCE", "IJK", "XU", "ZW", "YV", "XYZ", "UVW", "PQ", "OQ", "PR", "QR", "RC", "RI")
"""Letters that mean something alike: angles, centres, an axis and its increment, axes, sizes."""
_AXES, _STEPS, _NO_PATH = "XYZUVW", "UVW", "MSTFHD"
"""Letters of axes, of their increments, and of what has nothing to do with a path: their numbers have no point."""
_RADIUS = ("R", "CR")
"""The word for the radius of an arc on one control or another."""
_ACROSS, _RADII = ("I", "U"), ("R", "CR", "I", "J", "K")
"""Words of lengths across a turned part that are radii, and radii and centres; drawings have diameters."""
_POINTS = (("CCX", "CCY"), ("ICCX", "ICCY"), ("CCPR", "CCPA"), ("PR", "PA"), ("IPR", "IPA"))
"""Words that state a point together."""


class Speech(Struct, frozen=True):
    """The words that may stand at a place: the control's table, the addresses that are allowed, those that give corners
    a size; of a contour also what it says, and the axis that counts diameters, if one does."""

    lexicon: Lexicon
    allowed: frozenset[str]
    shapes: Mapping[str, CornerShape] = {}
    claim: ParsedContour | None = None
    turned: str = ""

    def address(self, match: re.Match[str]) -> str:
        """The address of a word."""
        name = " ".join(match["address"].upper().split())
        return match["address"] if "=" in match[0] else self.lexicon.spelling.addresses.get(name, match["address"])

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
    def of_control(cls, control: Control, turned: str) -> "Speech":
        """Those of a control, outside its contours."""
        lexicon = control.modes.lexicon
        return cls(lexicon, frozenset(lexicon.addresses), turned=turned)


def turned_axis(plane: Plane) -> str:
    """The axis of a plane that counts diameters; empty for none."""
    return next((axis for axis, is_diameter in zip(plane.axes, plane.diameters, strict=True) if is_diameter), "")


class Typed(Struct, frozen=True, dict=True):
    """A word as it was typed, in parts, and where it stands; `stated` are the addresses of its block."""

    speech: Speech
    word: Word
    address: str
    sign: str
    number: str
    stated: frozenset[str] = frozenset()

    @classmethod
    def of(cls, word: Word, speech: Speech, stated: frozenset[str] = frozenset()) -> "Typed | None":
        """The word in parts; None if it has no number."""
        match = _WORD.fullmatch(word.text.strip())
        return cls(speech, word, speech.address(match), match["sign"], match["number"], stated) if match else None

    def spelled(self, number: str) -> str:
        """The word with another text of its number."""
        return self.speech.lexicon.spell(self.address, number)

    def as_number(self, *numbers: str) -> Iterator[str]:
        """The word with other digits."""
        return (self.spelled(self.sign + number) for number in numbers)

    def as_value(self, *values: Decimal) -> Iterator[str]:
        """The word with another number, spelled as this one is."""
        for value in values:
            text = trimmed(abs(value))
            is_pointed = self.number.endswith(".") or ("." in self.number and self.counts)
            sign = "-" if value < 0 else "+" if self.sign == "+" else ""
            yield self.spelled(sign + text + "." * (is_pointed and "." not in text))

    def as_address(self, *addresses: str) -> Iterator[str]:
        """The word with another address."""
        return (self.speech.lexicon.spell(address, self.sign + self.number) for address in addresses)

    @cached_property
    def row(self) -> Address | None:
        """The row of its address; None for a word that the control does not know."""
        return self.speech.lexicon.addresses.get(self.word.address)

    @cached_property
    def value(self) -> Decimal:
        """Its number."""
        return Decimal(self.sign + self.number)

    @property
    def is_choice(self) -> bool:
        """Whether only its sign counts, and chooses."""
        return self.row is not None and self.row.unit is Unit.SIGN

    @property
    def is_angle(self) -> bool:
        """Whether it states an angle."""
        return self.row is not None and self.row.unit is Unit.DEGREE

    @property
    def is_diameter(self) -> bool:
        """Whether it states a diameter."""
        turned = self.speech.turned
        return self.row is not None and bool(turned) and (self.row.is_diameter or self.row.axis == turned)

    @property
    def counts(self) -> bool:
        """Whether a number without a point counts least increments."""
        return self.speech.lexicon.numbers.without_point is WithoutPoint.LEAST_INCREMENTS

    @property
    def unknown(self) -> Word | None:
        """The word, if the contour has no such address."""
        unknown = self.speech.claim.unknown if self.speech.claim is not None else ()
        return next((each for each in unknown if each.span == self.word.span), None)


Texts = Iterable[str]


def _point_lost(typed: Typed) -> Iterator[str]:
    digits = typed.number
    if "." not in digits:
        if typed.counts:
            yield from typed.as_number(f"{digits}.")
        if typed.counts or len(digits) >= _LONG + typed.is_angle:
            # With as many decimals as the least increment has, it is what was typed where numbers count increments.
            places = range(1, min(_DECIMALS + (not typed.counts), len(digits)))
            # Nobody means Z-2.0 by Z-20.
            places = places if len(digits) >= _LONG or not digits.endswith("0") else range(0)
            yield from typed.as_number(*(f"{digits[:-place]}.{digits[-place:]}" for place in places))


def _point_lost_in_few(typed: Typed) -> Texts:
    """A point in a number that is no larger than many that need none."""
    digits = typed.number
    is_short = not typed.counts and "." not in digits and 1 < len(digits) < _LONG and not digits.endswith("0")
    return typed.as_number(*(f"{digits[:at]}.{digits[at:]}" for at in range(len(digits) - 1, 0, -1) if is_short))


def _point_moved(typed: Typed) -> Iterator[str]:
    """The point a place to the right, or to the left of the last digit."""
    whole, point, rest = typed.number.partition(".")
    if rest and whole:
        moved, tail = (whole + rest[0]).lstrip("0") or "0", rest[1:].rstrip("0")
        yield from typed.as_number(moved + (f".{tail}" if tail else point if typed.counts else ""))
    if len(whole) > 1 and whole[-1] != "0" and (point or typed.counts):
        yield from typed.as_number(f"{whole[:-1]}.{whole[-1]}{rest}")
    elif whole.strip("0") and len(whole) == 1 and rest:
        yield from typed.as_number(f"0.{whole}{rest}")


def _zero_added(typed: Typed) -> Texts:
    whole, point, rest = typed.number.partition(".")
    return typed.as_number(whole[:-1] + point + rest) if len(whole) > 1 and whole.endswith("0") else ()


def _zero_lost(typed: Typed) -> Texts:
    whole, point, rest = typed.number.partition(".")
    # Lengths of three digits are rare, and so are angles of four; and nobody turns so far to the right.
    is_turned_far = typed.is_angle and typed.value * 10 < -_HALF
    is_short = whole.strip("0") and not is_turned_far and not rest and len(whole) <= 1 + typed.is_angle
    return typed.as_number(f"{whole}0{point}") if is_short else ()


def _zero_first(typed: Typed) -> Texts:
    """A zero that stands before another digit, behind it."""
    match = re.match(r"0([1-9])(.*)", typed.number)
    return typed.as_number(f"{match[1]}0{match[2]}") if match else ()


def _sign_lost(typed: Typed) -> Texts:
    is_turned_far = typed.is_angle and abs(typed.value) > _HALF
    is_positive = typed.sign != "-" and typed.value and not typed.is_choice and not is_turned_far
    return [typed.spelled("-" + typed.number)] if is_positive else ()


def _sign_added(typed: Typed) -> Texts:
    return [typed.spelled(typed.number)] if typed.sign == "-" and not typed.is_choice else ()


def _sign_of_choice(typed: Typed) -> Texts:
    sign = "" if typed.sign == "-" else "-"
    return [typed.spelled(sign + typed.number)] if typed.is_choice and typed.value else ()


def _angles(others: Callable[[Decimal], Iterable[Decimal]]) -> Callable[[Typed], Texts]:
    """Angles that follow from that of a line, or of an arc."""

    def texts(typed: Typed) -> Texts:
        value = typed.value
        if not typed.is_angle or abs(value) > _FULL_TURN:
            return ()
        found = (each for each in others(value) if (each or abs(value) == _HALF) and abs(each) < _FULL_TURN)
        return typed.as_value(*found)

    return texts


def _complement(angle: Decimal) -> Decimal:
    """The angle with the other axis, in the same quadrant."""
    turned = angle % _HALF
    return angle - turned + (_QUARTER if turned < _QUARTER else _HALF + _QUARTER) - turned


def _twice_or_half(typed: Typed) -> Texts:
    """A diameter as a radius and the reverse, where X counts diameters; a radius as a diameter."""
    if typed.row is None or typed.row.unit is not Unit.MM or not typed.value:
        return ()
    if typed.row.is_diameter:
        return typed.as_value(typed.value * 2, typed.value / 2)
    is_radius = typed.word.address in _RADII and typed.word.address not in typed.speech.shapes
    return typed.as_value(typed.value / 2) if is_radius else ()


def _half_across(typed: Typed) -> Texts:
    """A length across a turned part, but for corners, as the difference of the diameters on its drawing."""
    address, row = typed.word.address, typed.row
    is_length = row is not None and row.unit is Unit.MM and not row.is_diameter and address not in typed.speech.shapes
    is_across = is_length and typed.value and typed.speech.turned and address in _ACROSS
    return typed.as_value(typed.value / 2) if is_across else ()


def _comma(typed: Typed) -> Texts:
    if re.match(r",\s", typed.word.text):
        # That comma belongs to the number before it.
        return ()
    if "," in typed.address:
        return [f"{typed.address[1:].strip()}{typed.sign}{typed.number}"]
    return [f",{typed.word.text}"] if len(typed.address) == 1 else ()


def _neighbour(typed: Typed) -> Texts:
    """The word of the other corner that gives it the same shape; a radius is a rounding."""
    own, shapes = typed.address.upper(), typed.speech.shapes
    shape = shapes.get(own, CornerShape.FILLET if own.strip(" ,") == "R" else None)
    return typed.as_address(*(address for address, other in shapes.items() if other is shape and address != own))


def _swapped(typed: Typed) -> Texts:
    text = typed.number
    # Within a number, a point is moved rather.
    places = [at for at in range(len(text) - 1) if "." not in (text[at : at + 2] if at else text[1:2])]
    found = (text[:at] + text[at + 1] + text[at] + text[at + 2 :] for at in places if text[at] != text[at + 1])
    return typed.as_number(*found)


def _typed_twice(typed: Typed) -> Texts:
    text = typed.number
    return typed.as_number(*(text[:at] + text[at + 1 :] for at in range(len(text) - 1) if text[at] == text[at + 1]))


def _digits(others: Callable[[str], Iterable[str]]) -> Callable[[Typed], Texts]:
    """Each digit with each of some others for it."""

    def texts(typed: Typed) -> Texts:
        text = typed.number
        places = ((at, other) for at, digit in enumerate(text) if digit.isdigit() for other in others(digit))
        return typed.as_number(*(text[:at] + other + text[at + 1 :] for at, other in places))

    return texts


def _digit_lost(typed: Typed) -> Texts:
    text = typed.number
    return typed.as_number(*(text[:at] + digit + text[at:] for at in range(len(text) + 1) for digit in _BESIDE_DIGIT))


def _other_address(typed: Typed) -> Texts:
    """A word of which the contour has no address, as the one that it was most plausibly meant to be."""
    claim, word = typed.speech.claim, typed.unknown
    return [respelled(word, claim)] if claim is not None and word is not None else ()


def _other_letter(typed: Typed) -> Texts:
    """Such a word of one letter, as one that its block has not yet."""
    claim, own = typed.speech.claim, typed.word
    if claim is None or len(own.address.lstrip(",#")) > 1 or typed.unknown is None:
        return ()
    stated = {word.address for block in claim.blocks if block.line == own.span.line for word in block.words}
    free = (each for each in claim.lexicon.addresses if each in claim.form.allowed and each not in stated)
    return typed.as_address(*(each for each in free if len(each) == len(own.address)))


def _letter_alike(typed: Typed) -> Texts:
    """A word of one letter as one whose letter means something alike, or lies beside it on a keyboard; where it needs
    its comma, with that."""
    letter = typed.address.strip(" ,").upper()
    if len(letter) != 1 or (letter in _NO_PATH and "." not in typed.number):
        return ()
    alike = {*_beside(letter), *(other for group in _ALIKE if letter in group for other in group)} - {letter}
    alike |= {"ANG"} if letter in _ALIKE[0] else set()
    # The comma is no axis's; and what moves an axis was meant to move one.
    is_odd = _AXES.__contains__ if "," in typed.address else lambda bare: letter in _AXES and bare not in _AXES
    bare = {address: address.lstrip(",#") for address in typed.speech.lexicon.addresses}
    # Nobody writes an increment of 0.
    bare = {address: each for address, each in bare.items() if typed.value or each not in _STEPS}
    free = (address for address in bare if address not in typed.stated and address != typed.word.address)
    return typed.as_address(*(address for address in free if bare[address] in alike and not is_odd(bare[address])))


def _beside(letter: str) -> Iterator[str]:
    """The letters right and left of a letter, and those that touch it in the row above and below."""
    for number, row in enumerate(_ROWS):
        at = row.find(letter.lower())
        if at >= 0:
            above, below = (_ROWS[each] if 0 <= each < len(_ROWS) else "" for each in (number - 1, number + 1))
            yield from (row[max(at - 1, 0) : at] + row[at + 1 : at + 2] + above[at : at + 2]).upper()
            yield from below[max(at - 1, 0) : at + 1].upper()


def _of_another_control(typed: Typed) -> Texts:
    """An increment, or the radius of an arc, as this control spells it."""
    known, address = typed.speech.lexicon.addresses, typed.address.upper()
    others = [f"{dict(zip('UVW', 'XYZ', strict=True)).get(address, '')}=IC"]
    others += [each for each in _RADIUS if address in _RADIUS and typed.row is None]
    return typed.as_address(*(each for each in others if each in known))


class Changes(IntEnum):
    """The part of a word that a slip changes."""

    ADDRESS = 0
    SIGN = 1
    DIGITS = 2
    """Digits or the point."""


_A, _S, _D = Changes

TYPING = "typing: which fingers and keys go wrong"
MEANING = "what is mistaken on drawings: slips that machinists and makers of controls name"
SEEN = "slips by hand and at random, tests/slips and tests/unit/test_typing.py"


class SlipKind(Struct, frozen=True):
    """A kind of slip: its name, what happened in words, an example, how unlikely it is, and what a word may have been
    meant to be.

    `example` is what is typed for what is meant on some control, with | between blocks; empty for a kind that other
    drafts are explained by.
    `cost` is the negative natural logarithm of its share among slips, about, and `why` where that is known from.
    """

    name: str
    sentence: str
    example: str
    cost: float
    why: str
    changes: Changes = Changes.ADDRESS
    texts: Callable[[Typed], Texts] = lambda _: ()
    is_frequent: bool = True
    """Whether it leaves few texts of each word; dozens else."""


UNREADABLE = SlipKind("unreadable", "", "", 0.3, TYPING, _D)
"""Letters for digits, commas for points, two points or signs: told by the finding itself."""
ZERO_FIRST = SlipKind("zero-first", "two digits swapped", "Z-06. for Z-60.", 0.4, TYPING, _D, _zero_first)
POINT_LOST = SlipKind("point-lost", "", "X50 for X50.", 0.9, SEEN, _D, _point_lost)
COMMA = SlipKind("comma", "", "C2. for ,C2.", 0.9, SEEN, _A, _comma)
SIGN_LOST = SlipKind("sign-lost", "a lost minus sign", "Z60. for Z-60.", 1.6, SEEN, _S, _sign_lost)
NEIGHBOUR = SlipKind(
    "neighbour",
    "the word of another corner",
    "G111 A180. K-28. B150. X64. P6. for G111 A180. K-28. B150. X64. Q6.",
    1.7,
    MEANING,
    _A,
    _neighbour,
)
SIGN_ADDED = SlipKind("sign-added", "a minus sign too many", "X-50. for X50.", 1.8, SEEN, _S, _sign_added)
SUPPLEMENT = SlipKind(
    *("supplement", "the angle from the other side", ",A30. for ,A150.", 1.9, MEANING, _D),
    _angles(lambda angle: [(_HALF if angle >= 0 else -_HALF) - angle] if abs(angle) < _HALF else ()),
)
POINT_LOST_IN_FEW = SlipKind(
    "point-lost-few", "a lost decimal point", "X125 for X12.5", 2.2, TYPING, _D, _point_lost_in_few
)
POINT_MOVED = SlipKind("point-moved", "the decimal point moved", "Z-2.5 for Z-25.", 2.0, SEEN, _D, _point_moved)
ZERO_ADDED = SlipKind("zero-added", "a zero too many", "Z-600. for Z-60.", 2.0, SEEN, _D, _zero_added)
ZERO_LOST = SlipKind("zero-lost", "a lost zero", ",A15. for ,A150.", 2.3, SEEN, _D, _zero_lost)
LETTER_ALIKE = SlipKind("letter-alike", "another letter", "X-60. for Z-60.", 2.4, TYPING, _A, _letter_alike)
OPPOSITE = SlipKind(
    *("opposite", "the other way along the line", ",A-30. for ,A150.", 2.3, MEANING, _D),
    _angles(lambda angle: [angle - _HALF if angle >= _HALF else angle + _HALF]),
)
_DIAMETER = SlipKind(
    *("diameter", "a diameter for a radius, or the reverse", "X25. for X50.", 2.6, MEANING, _D, _twice_or_half)
)
OTHER_AXIS = SlipKind(
    *("other-axis", "the angle from the other axis", ",A30. for ,A120.", 2.9, MEANING, _D),
    _angles(lambda angle: (angle + _QUARTER, _QUARTER - angle, angle - _QUARTER)),
)
COMPLEMENT = SlipKind(
    *("complement", "the angle from the other axis", ",A150. for ,A120.", 2.9, MEANING, _D),
    _angles(lambda angle: [_complement(angle)]),
)
FEW = (
    ZERO_FIRST,
    POINT_LOST,
    COMMA,
    SIGN_LOST,
    NEIGHBOUR,
    SIGN_ADDED,
    SlipKind("choice", "the other sign", "Q-1 for Q1", 1.8, MEANING, _S, _sign_of_choice),
    SUPPLEMENT,
    POINT_LOST_IN_FEW,
    POINT_MOVED,
    ZERO_ADDED,
    ZERO_LOST,
    SlipKind(
        "other-address",
        "another word",
        "G1 ANGG=170 RND=6|X64 Z-60 ANG=110 for G1 ANG=170 RND=6|X64 Z-60 ANG=110",
        0.9,
        MEANING,
        _A,
        _other_address,
    ),
    SlipKind(
        "other-letter",
        "another letter",
        "G111 A180. K-28. E150. X64. for G111 A180. K-28. B150. X64.",
        2.1,
        TYPING,
        _A,
        _other_letter,
    ),
    LETTER_ALIKE,
    SlipKind("increment", "a word of another control", "U10 for X=IC(10)", 1.0, MEANING, _A, _of_another_control),
    SlipKind("twice", "a digit typed twice", "Z-660. for Z-60.", 2.2, TYPING, _D, _typed_twice),
    SlipKind("swapped", "two digits swapped", "Z-26. for Z-62.", 2.4, TYPING, _D, _swapped),
    OPPOSITE,
    SlipKind("across", "a diameter for a radius", "I8. for I4.", 1.8, MEANING, _D, _half_across),
    _DIAMETER,
    OTHER_AXIS,
)
"""Kinds that leave few texts of each word."""
OF_DIGITS = (
    SlipKind(
        "key-beside", "a key beside", "Z-70. for Z-60.", 3.8, TYPING, _D, _digits(_BESIDE_DIGIT.__getitem__), False
    ),
    SlipKind("digit-lost", "a lost digit", "Z-6. for Z-65.", 4.0, TYPING, _D, _digit_lost, False),
    SlipKind("digit-added", "a digit too many", "Z-605. for Z-60.", 4.0, TYPING, _D, _digits(lambda _: [""]), False),
    SlipKind(
        "other-digit", "another digit", "Z-90. for Z-60.", 4.8, TYPING, _D, _digits(lambda _: _BESIDE_DIGIT), False
    ),
)
"""Kinds that leave dozens."""
ROUND = SlipKind("round", "", "", 3.0, SEEN, _D)
"""Digits that are wrong: the others make it a round number."""
CODE = SlipKind("code", "", "", 2.0, TYPING)
"""Another G code, or one that was forgotten."""
SLIPS = (UNREADABLE, *FEW, CODE, *OF_DIGITS, ROUND)


def texts_of(slip: SlipKind, typed: Typed | None) -> Iterator[str]:
    """Words that a word may have been meant to be if a slip happened to it; none of one without a number."""
    if typed is None or (slip.changes is Changes.DIGITS and typed.is_choice):
        return
    speech, own = typed.speech, typed.word.text.strip()
    decimals = max(_DECIMALS, len(typed.number.partition(".")[2]))
    for text in dict.fromkeys(slip.texts(typed)):
        match = _WORD.fullmatch(text)
        address = speech.address(match).replace(" ", "").upper() if match else ""
        if match is None or address not in speech.lexicon.addresses or address not in speech.allowed:
            continue
        # Zeros say nothing, no drawing has idle turns, and nobody writes a leading zero or a corner of no size.
        is_same = text == own or ("." in text and "." in own and text.rstrip("0") == own.rstrip("0"))
        is_idle = LEADING.search(text) or (typed.is_angle and _is_idle_turn(match, typed))
        is_nothing = not match["number"].strip("0.") and speech.address(match) in speech.shapes
        if not (is_same or is_idle or is_nothing) and len(match["number"].partition(".")[2]) <= decimals:
            yield text


def misreadings(word: Word, claim: ParsedContour) -> Iterator[tuple[str, str]]:
    """Each word that somebody who misreads a drawing may take for this one, with what is mistaken, the likeliest
    first."""
    typed = Typed.of(word, Speech.of(claim))
    kinds = [kind for kind in FEW if kind.sentence and (kind.why == MEANING or kind in (SIGN_LOST, SIGN_ADDED))]
    if typed is not None and typed.speech.turned and not typed.is_diameter:
        # A letter of radii on other forms may be a length along the part here.
        kinds.remove(_DIAMETER)
    for kind in sorted(kinds, key=lambda each: each.cost):
        yield from ((text, kind.sentence) for text in texts_of(kind, typed))


def _is_idle_turn(match: re.Match[str], typed: Typed) -> bool:
    """Whether an angle differs by whole turns, or becomes more than one, which drawings have not."""
    value = Decimal(match["sign"] + match["number"])
    is_turned = match["address"].upper() == typed.address.upper() and (value - typed.value) % _FULL_TURN == 0
    # A number without a point may count increments.
    is_degrees = "." in match["number"] or not typed.counts or abs(typed.value) <= _FULL_TURN
    return is_turned or (is_degrees and abs(value) > _FULL_TURN)


def mistyped_codes(word: Word, modes: Modes) -> list[str]:
    """The contour codes that a G code may have been meant to be by a slip of its digits."""
    typed = Typed.of(word, Speech(modes.lexicon, frozenset())) if word.address == "G" else None
    if typed is None:
        return []
    kinds = (slip for slip in SLIPS if slip.changes is Changes.DIGITS and slip is not POINT_LOST)
    meant = {text for slip in kinds for text in slip.texts(typed)} - {word.text.strip()}
    codes = (f"G{number}" for number, code in modes.codes.items() if code.effect is Effect.CONTOUR)
    return [code for code in codes if code in meant]


def recognise(edit: Edit, claim: ParsedContour) -> SlipKind | None:
    """The most plausible slip that explains a change of a word; None if no slip does."""
    if edit.kind is not EditKind.CHANGE or edit.span is None or edit.address == FACT:
        return None
    if edit.address == "G" or edit.text == mended(edit.old):
        return UNREADABLE if edit.text == mended(edit.old) else CODE
    typed = Typed.of(Word(edit.address, None, False, edit.old, edit.span), Speech.of(claim))
    kinds = sorted(SLIPS, key=lambda slip: slip.cost)
    return next((slip for slip in kinds if edit.text in texts_of(slip, typed)), None)


def explained(word: Word, value: float, claim: ParsedContour, kinds: Iterable[SlipKind] = SLIPS) -> Iterator[str]:
    """Words that a word may have been meant to be with about this value, mm (radius) or degrees, by a slip."""
    speech = Speech.of(claim)
    typed = Typed.of(word, speech)
    for slip in kinds:
        for text in texts_of(slip, typed):
            match = _WORD.fullmatch(text)
            if match is None or speech.address(match).replace(" ", "").upper() != word.address:
                continue
            number = match["sign"] + match["number"]
            meant = replace(word, number=Decimal(number), has_point="." in number)
            other = claim.lexicon.value(meant, claim.after.unit)
            if other is not None and abs(float(other) - value) <= (_ABOUT if slip.is_frequent else _NEARLY):
                yield text


def partners(address: str) -> Iterator[str]:
    """The words that state a point together with the one of an address, and seldom stand without it."""
    yield from (each for pair in _POINTS if address in pair for each in pair if each != address)


def number_in(text: str) -> str:
    """The number of a word as it is typed, without its sign; empty if it has none."""
    match = _WORD.fullmatch(text.strip())
    return match["number"] if match else ""


@lru_cache(maxsize=1024)
def plain_code(text: str) -> str:
    """A code without a zero that leads."""
    return re.sub(r"^G0+(?=\d)", "G", text.strip().upper())
