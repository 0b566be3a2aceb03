"""Klartext: how its blocks are spelled, its words, its functions, and conventions on which the manuals are silent."""

import re
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property

from msgspec import Struct

from contoursolve.controls.control_settings import setting
from contoursolve.controls.further import rows as rows_beside
from contoursolve.diagnostics import Book, Source
from contoursolve.gcode import NUMBER, Block, Syntax, Word, WordSpelling, late_pattern, plain_spelling, words_as
from contoursolve.geometry import CornerShape, Unit
from contoursolve.reading import TURNED, Address, Bearing, Code, Effect, Lexicon, NumberFormat, WithoutPoint
from contoursolve.tolerance import CIRCLE_DEVIATION, RADIUS_DIFFERENCE

BOOK = Book("HEIDENHAIN TNC user's manuals")
_FK, _PATH = BOOK.printed("free contour programming FK"), BOOK.printed("path functions")

ROUNDING, CHAMFER = "ROUNDING", "CHAMFER"
"""The names of the sizes that RND and CHF state."""

FREE = ("FL", "FLT", "FC", "FCT")
"""Elements of free contour programming."""
STRAIGHT = ("L", "LP", "FL", "FLT")
ABOUT_CENTER = ("C", "CP")
"""Arcs about CC."""
TANGENT = ("FLT", "FCT", "CT", "CTP")
"""Elements that begin in the direction of the one before them."""
_MEANINGS = {
    "L": "line to a point",
    "LP": "line to a point by PR and PA",
    "C": "arc about CC to a point",
    "CP": "arc about CC by its angle",
    "CR": "arc by its radius",
    "CT": "arc that touches the element before it",
    "CTP": "arc that touches the element before it, by PR and PA",
    "FL": "line by any of its data",
    "FLT": "line by any of its data; it touches the element before it",
    "FC": "arc by any of its data",
    "FCT": "arc by any of its data; it touches the element before it",
}
MOVES = (*_MEANINGS,)
_WAYS = ("PLT", "PLN", "PCT", "PLCT", "LT", "LN", "CT", "LCT")
APPROACHES = tuple(f"{side} {way}" for side in ("APPR", "DEP") for way in _WAYS)

_FIRST_CODE = 20_001
_FUNCTIONS: tuple[tuple[Effect, str, tuple[str, ...], Source], ...] = (
    *((Effect.CONTOUR, meaning, (name,), _PATH) for name, meaning in _MEANINGS.items()),
    (Effect.CONTOUR, "pole of a free contour", ("FPOL",), _FK),
    (Effect.NONE, "centre of a circle, or pole", ("CC",), _PATH),
    (Effect.NONE, "approach or departure", APPROACHES, BOOK.printed("approach and departure")),
    (Effect.NONE, "stop", ("STOP",), BOOK.assumed("stop")),
)
_COMPENSATION = (("R0", 40), ("RL", 41), ("RR", 42))


def _codes() -> dict[int, Code]:
    rows, number = list[Code](), _FIRST_CODE
    for effect, meaning, names, source in _FUNCTIONS:
        for name in names:
            rows.append(Code(number, effect, meaning, source, name=name))
            number += 1
    source = BOOK.printed("radius compensation")
    rows += [Code(code, Effect.COMPENSATION, "compensation", source, name=name) for name, code in _COMPENSATION]
    return {code.number: code for code in rows}


CODES = _codes()
_NAMES = {code.name: code.number for code in CODES.values()}


class PlaneWords(Struct, frozen=True, dict=True):
    """The names of the words of a chain, some of which name an axis of its plane."""

    axes: tuple[str, str] = ("X", "Y")
    across: tuple[str, ...] = ("Z", "IZ")
    """Words that lead out of the plane."""
    has_corners: bool = False
    """Whether the block of an element may have the corner behind it."""
    chamfer: CornerShape = CornerShape.CHAMFER_SETBACK
    slack: float = RADIUS_DIFFERENCE
    """mm. By how much the radii at two points of an arc may differ."""

    def each(self, *texts: str) -> tuple[str, ...]:
        """Texts with each axis for their braces, text by text."""
        return tuple(text.format(axis) for text in texts for axis in self.axes)

    @cached_property
    def increments(self) -> tuple[str, ...]:
        return self.each("I{}")

    @cached_property
    def referred(self) -> tuple[str, ...]:
        """Increments that may count from another block: I and these, whose block R and these name."""
        return (*self.axes, "PR", "PA", "AN", *self.each("CC{}"), "CCPR", "CCPA")

    @cached_property
    def referring(self) -> tuple[str, ...]:
        """Words whose number is that of another block."""
        return ("PAR", *(f"R{name}" for name in self.referred))

    @cached_property
    def of_lines(self) -> tuple[str, ...]:
        """Words that state a fact about a line, each by itself."""
        return (*self.axes, *self.increments, "PR", "PA", "IPR", "IPA", "AN", "IAN", "LEN")

    @cached_property
    def of_arcs(self) -> tuple[str, ...]:
        """Words that state a fact about an arc, each by itself."""
        return (
            *(*self.of_lines, *self.each("CC{}"), "CCPR", "CCPA"),
            *(*self.each("ICC{}"), "ICCPR", "ICCPA", "R", "CCA"),
        )

    @cached_property
    def beside(self) -> tuple[str, ...]:
        """The coordinates of a point beside an element."""
        return self.each("PD{}")

    def of_element(self, *, is_line: bool) -> tuple[str, ...]:
        """All words that a line, or an arc, may have beside its sense: in the order of those tables."""
        points = self.each("P1{}", "P2{}") if is_line else self.each("P1{}", "P2{}", "P3{}")
        parallel = ("PAR", "DP") if is_line else ()
        own = self.of_lines if is_line else self.of_arcs
        return (*own, *points, *self.beside, "D", *parallel, *self.referring[1:])

    @cached_property
    def usual(self) -> tuple[str, ...]:
        """The words that complete a chain, in the order in which drawings have them."""
        return (
            *("R", "AN", *self.axes, "LEN", *self.each("CC{}"), "PR", "PA", "CCA", *self.increments, "IAN"),
            *("CCPR", "CCPA", *self.each("ICC{}"), "IPR", "IPA", "ICCPR", "ICCPA"),
        )


IN_KLARTEXT = PlaneWords(slack=CIRCLE_DEVIATION)


def _long(words: PlaneWords) -> str:
    """The names that have several letters."""
    first, second = words.axes
    return (
        rf"I?(?:CC{first}|CC{second}|CCPR|CCPA|PR|PA|AN)|LEN|CCA|P[123][{first}{second}]|PD[{first}{second}]|PAR|DP"
        rf"|R(?:{first}|{second}|PR|PA|AN|CC{first}|CC{second}|CCPR|CCPA)|FSELECT"
    )


_NUMBER = r"[+-]?+(?>\d++(?>[.,]\d*+)?|[.,]\d++)"
_AXIS = "I?[XYZABCUVW]"
_BY_LENGTH = "|".join(sorted((*MOVES, "FPOL", "CC", "STOP", "R0", "RL", "RR"), key=len, reverse=True))
_MISSPELT = (
    # FN15: has no blank before its number.
    r"F(?!N(?![A-Z])|UNCTION\b)[A-Z]|L(?!BL(?![A-Z])|N(?![A-Z]))[A-Z]"
    r"|(?:R|C(?!YCL(?![A-Z])|ALL(?![A-Z])))[A-Z]{1,6}+(?:(?<=R)|[ \t]*+=?[ \t]*+R?+)[ \t]*+=?[ \t]*+[\d.,]"
)
"""A block that begins like a function and is none: it is read into words, and told."""


def _value(prefix: str) -> str:
    """A number, a parameter, or a question mark, in groups that begin so."""
    return rf"(?:(?P<{prefix}_number>{_NUMBER})(?![\d.,\w])|[+-]?+Q[LRS]?+\d++|(?P<{prefix}_asked>\?))"


_SENSES = {"CW": ("DR", "-1", False), "CCW": ("DR", "+1", False)}
"""Senses as drawings have them."""


def _parts(token: re.Match[str]) -> tuple[str, str | None, bool]:
    """The parts of a word; a comma stands for a point, and a sign alone for 1."""
    found = token.groupdict()
    if found["label"] is not None:
        return "N", found["label"].strip().lstrip("Nn"), False
    if found["sense"] is not None:
        turned = _SENSES.get(found["sense"].upper())
        return turned or (found["sense"].upper(), f"{found['sign'] or '+'}1", False)
    if found["feed"] is not None:
        return found["feed"][0].upper(), None, False
    kind = next(kind for kind in ("long", "corner", "letter", "foreign") if found[kind] is not None)
    address, number = found[kind].upper(), found[f"{kind}_number"]
    if kind == "corner":
        address = ROUNDING if address.startswith("R") else CHAMFER
    return address, number and number.replace(",", "."), found[f"{kind}_asked"] is not None


_LACKS_R = r"RND[ \t]++[+-]?+Q[LRS]?+\d++"
_BEHIND = r"[ \t]*+=?+[ \t]*+(?=[\d.,+-])[\w.,+-]++"
"""A text that is almost a number, behind an address."""
BLOCK_NUMBER = r"[ \t/]*+(?>(?:N?(?P<number>\d++)(?![.,\w])[ \t]*+)?)"
"""The begin of a statement: its sign to skip it and its number, if any."""


OF_SENSES = r"DR(?=[ \t]*+[+-])|CLSD(?!\w)"
OF_CORNERS = r"RND(?![A-Z])[ \t]*+R[ \t]*+|CHF(?![A-Z])[ \t]*+(?!R)"
"""Words with a sign alone, and those of corners."""


SPELLING = WordSpelling(
    {
        **{f"{axis}{word}": f"{axis}{word}" for axis in ("", "I")
           for word in ("CCX", "CCY", "CCZ", "CCPR", "CCPA", "AN")},
        **{f"I{word}": f"I{word}" for word in ("X", "Y", "Z", "A", "B", "C", "PR", "PA")},
        **{f"P{point}{axis}": f"P{point}{axis}" for point in "123D" for axis in "XYZ"},
        **{f"R{word}": f"R{word} " for word in ("X", "Y", "Z", "PR", "PA", "AN")},
        **{f"R{word}": f"R{word} " for word in ("CCX", "CCY", "CCZ", "CCPR", "CCPA")},
        "PR": "PR", "PA": "PA", "LEN": "LEN", "CCA": "CCA", "DP": "DP", "PAR": "PAR ", "FSELECT": "FSELECT ",
        ROUNDING: "RND R", CHAMFER: "CHF ",
    },
    signs=frozenset({"DR", "CLSD"}),
    names={"RND": ROUNDING, "CHF": CHAMFER},
    # A chamfer has no R: its size stands behind CHF.
    spare=late_pattern(r"\b(CHF)[ \t]*R[ \t]*(?=\d)", re.IGNORECASE),
)  # fmt: skip
"""The spelling of words of several letters, which have no equals sign."""


def spelling(name: str, words: PlaneWords, senses: str = OF_SENSES, corners: str = OF_CORNERS) -> Syntax:
    """The spelling of blocks with these words: letters and a number without an equals sign, comments behind a
    semicolon, a number before each block."""
    long = _long(words)
    # The begin of a block that is read into words.
    moving = (
        rf"(?:{_BY_LENGTH}|FSELECT|RND|CHF|APPR|DEP)(?![A-Z])|{_AXIS}[ \t]*+[+-]?+[\d.,Q?]"
        rf"|(?:{long})[ \t]*+[+-]?+[\d.,Q?]|(?:DR|CLSD)[ \t]*+[+-]|[FMS][ \t]*+[\dQ]"
    )
    own = (
        rf"{_LACKS_R}|(?>(?:F[LC]T?)?)(?:{long}|RND|CHF|{_AXIS})[ \t]*+[-+.,\d=]|[A-Z]++(?<=Q)\d"
        r"|[A-Z]++(?<=Q[LRS])\d"
    )
    each_word = (
        r"(?P<label>(?:\A|(?<=/))[ \t]*+N?+\d++(?![.,\w]))",
        rf"(?P<sense>{senses})[ \t]*+(?P<sign>[+-]?+)",
        rf"(?P<feed>F[ \t]*+(?:AUTO|MAX)\b|F[UZ][ \t]*+{_NUMBER}|M[BT][ \t]*+(?:MAX|{_NUMBER}))",
        rf"(?P<long>{long})[ \t]*+{_value('long')}",
        rf"(?P<corner>{corners}){_value('corner')}",
        # R0 is no radius: it ends the compensation.
        rf"(?!R0(?![\w.,]))(?P<letter>{_AXIS}|[A-Z])(?!(?!Q[LRS]?\d)[A-Z])[ \t]*+{_value('letter')}",
        # Such as LEM20 or ANG=30: no word of Klartext.
        rf"(?!{own})(?P<foreign>[A-Z]{{2,}}?(?:[1-3][XY])?)(?>(?:[ \t]*+=)?)[ \t]*+{_value('foreign')}",
    )
    tokens = (
        f"(?P<word>{'|'.join(each_word)})",
        r"(?P<blank>[ \t\f\v\x1a\ufeff~]++)",
        r"(?P<comment>;.*+)",
        rf"(?P<glued>(?:{'|'.join(sorted(FREE, key=len, reverse=True))})(?=(?:{long}|{_AXIS})[ \t]*+[+-]?+[\d.,]))",
        rf"(?P<name>(?:APPR|DEP)[ \t]++[A-Z]++|(?:{_BY_LENGTH})(?![\w.,]))",
        rf"(?P<malformed>(?:{long}|(?:RND|CHF)[ \t]*+R?+|{_AXIS}|[A-Z](?![A-Z])){_BEHIND}|{_LACKS_R})",
        r"(?P<bare>[A-Z]++[+-]?+)",
        r"(?P<stray>[^ \tA-Z;]++)",
    )
    return Syntax(
        name,
        token=re.compile("|".join(tokens), re.ASCII | re.IGNORECASE),
        statement=re.compile(
            BLOCK_NUMBER + rf"(?!{moving}|{_MISSPELT}|;|~?+[ \t]*+$)"
            r"(?:(?P<flow>CALL\b|FN[ \t]*+(?:9|10|11|12)[ \t]*+:)|(?P<assignment>\S))",
            re.IGNORECASE,
        ),
        comment=re.compile(r";.*+"),
        remark=";{}",
        codes=_NAMES,
        parts=_parts,
        counts_blocks=True,
        skip=re.compile(r"[ \t]*+/"),
        bare_number=re.compile(r"[ \t/]*+N?\d++[ \t]*+"),
        words=SPELLING,
    )


# In this order, as the control writes them: a line, an arc with its radius or about CC, and CC.
_GAP = r"[ \t]{1,20}+"
_PLACE = rf"(?>(?:{_GAP}X{NUMBER})?)(?>(?:{_GAP}Y{NUMBER})?)"
_TAIL = "".join(rf"(?>(?:{_GAP}{each}(?![\w.,]))?)" for each in ("R[0LR]", "F(?>MAX|[0-9]{1,5}+)", "M0?[34589]"))
_BOTH = rf"{_GAP}X{NUMBER}{_GAP}Y{NUMBER}"
_PLAIN = (
    rf"(?>(?:[0-9]{{1,6}}+{_GAP})?)(?:L(?=[^\r\n;]*[XYZ][-+.0-9]){_PLACE}(?>(?:{_GAP}Z{NUMBER})?){_TAIL}"
    rf"|CC{_BOTH}|(?:CR{_BOTH}{_GAP}R{NUMBER}|C{_BOTH}){_GAP}DR[-+]{_TAIL})[ \t]{{0,20}}+"
)
SYNTAX = replace(
    spelling("klartext", IN_KLARTEXT),
    plain=plain_spelling(
        *(_PLAIN, ";", "FMAX"),
        begins=late_pattern(r"(?:\A|[\r\n])[ \t]*+(?>(?:[0-9]++[ \t]++)?)(?!CC)[^\r\n]*[XY]"),
        parts=late_pattern(r"CC[^\r\n]*+|[XYZ]|R[0LR](?!\w)"),
    ),
)

NUMBERS = NumberFormat(WithoutPoint.AS_WRITTEN, _PATH)


def rows_of(
    words: PlaneWords, path: Source, free: Source, chord: Source, angle: Source, *, is_diameter: bool = False
) -> dict[str, Address]:
    """The addresses, by what is printed about paths and about free contours, and why LEN of an arc is its chord and CCA
    an angle; of what another block counts for, the address of its number, too. X is a diameter, or not."""
    axes = tuple(dict.fromkeys((*words.axes, *(name for name in words.across if not name.startswith("I")))))
    rows = [
        *(Address(axis, "coordinate", Unit.MM, path, axis, is_absolute=True) for axis in axes),
        *(Address(f"I{axis}", "increment", Unit.MM, path, axis, True) for axis in axes),
    ]
    first, second = words.axes
    table = (
        (path, Unit.MM, "PR", "distance of the end from the pole"),
        (path, Unit.DEGREE, "PA", "direction from the pole to the end"),
        (path, Unit.MM, "IPR", "how much farther the end is from the pole"),
        (path, Unit.DEGREE, "IPA", "how far the direction from the pole turns"),
        (free, Unit.DEGREE, "AN", "direction of the line, or of the arc where it begins"),
        (free, Unit.DEGREE, "IAN", "angle to the element before it"),
        (chord, Unit.MM, "LEN", "length of the line, or chord of the arc"),
        (free, Unit.MM, f"CC{first}", f"{first} of the centre"),
        (free, Unit.MM, f"CC{second}", f"{second} of the centre"),
        (free, Unit.MM, "CCPR", "distance of the centre from the pole"),
        (free, Unit.DEGREE, "CCPA", "direction from the pole to the centre"),
        (free, Unit.MM, f"ICC{first}", f"increment along {first} to the centre"),
        (free, Unit.MM, f"ICC{second}", f"increment along {second} to the centre"),
        (free, Unit.MM, "ICCPR", "how much farther the centre is from the pole"),
        (free, Unit.DEGREE, "ICCPA", "how far the direction from the pole turns to that of the centre"),
        (free, Unit.MM, "R", "radius"),
        (free, Unit.SIGN, "DR", "sense of the arc: + is counter-clockwise"),
        (angle, Unit.DEGREE, "CCA", "direction from the centre to the end of the arc"),
        *(
            (free, Unit.MM, f"P{number}{axis}", f"{axis} of a point on the element")
            for number in "123"
            for axis in words.axes
        ),
        *((free, Unit.MM, f"PD{axis}", f"{axis} of a point beside the element") for axis in words.axes),
        (free, Unit.MM, "D", "distance of that point from the element"),
        (
            free,
            Unit.SIGN,
            "PAR",
            "block of the line, or of the arc where it begins, to which it is parallel",
        ),
        (free, Unit.MM, "DP", "distance from that line"),
        *((free, Unit.SIGN, f"R{name}", f"block from which I{name} counts") for name in words.referred),
        *((free, Unit.SIGN, name, "begins in the direction of the element before it") for name in TANGENT),
        (free, Unit.SIGN, "CLSD", "begin (+) and end (-) of a closed contour"),
        (free, Unit.SIGN, "FSELECT", "which of several solutions"),
        (path, Unit.MM, ROUNDING, "rounding"),
        (path, Unit.MM, CHAMFER, "chamfer: the distance of both its ends from the corner"),
    )
    rows += [Address(address, meaning, unit, source) for source, unit, address, meaning in table]
    named = {row.address: row for row in rows}
    if is_diameter:
        halved = words.each("{}", "I{}", "CC{}", "ICC{}", "P1{}", "P2{}", "P3{}", "PD{}")
        named |= {name: replace(named[name], is_diameter=True) for name in halved if name.endswith(TURNED)}
    return named


REFERRING_TO_LINES = ("RAN",)
"""The word that names a line: no page tells which direction of an arc it would mean."""

_BESIDE = (
    ("N", "number of a block", Bearing.NONE),
    ("F FU FZ FT FMAXT", "feed", Bearing.NONE),
    ("S T M MB MT", "speed, tool or function", Bearing.NONE),
    ("A B C U V W IA IB IC IU IV IW", "further axis", Bearing.AXIS),
    ("TX TY TZ NX NY NZ", "direction of the tool or of a surface", Bearing.NONE),
    ("H", "height of an approach or a helix", Bearing.NONE),
)
LEXICON = Lexicon(
    rows_of(
        IN_KLARTEXT,
        *(_PATH, _FK, BOOK.assumed("LEN of an arc is its chord"), BOOK.assumed("CCA counts from +X")),
    ),
    NUMBERS,
    rows_beside(BOOK.assumed("addresses"), _BESIDE),
    BOOK.assumed("the control refuses what it has no function for"),
    SPELLING,
)


def function_of(block: Block) -> str:
    """The function of a block: L where it has coordinates alone, RND, CHF and FSELECT by their words; empty if none."""
    for word in block.words:
        if word.address == "G":
            name = " ".join(word.text.upper().split())
            if name not in ("R0", "RL", "RR"):
                return name
        elif word.address in _BY_WORD:
            return _BY_WORD[word.address]
    for fault in block.faults:
        if fault.text.strip().upper() in _BY_WORD.values():
            # Its number is missing, or cannot be read.
            return fault.text.strip().upper()
    return "L" if any(word.address in LEXICON.addresses for word in block.words) else ""


_BY_WORD: Mapping[str, str] = {ROUNDING: "RND", CHAMFER: "CHF", "FSELECT": "FSELECT"}
"""Functions that are a word with a number."""


def shown_by(block: Block) -> tuple[Word, ...]:
    """The words that show Klartext: the begin of a program, and elements of free contour programming."""
    if _MISSPELT_FREE.match(block.text):
        return tuple(word for word in words_as(block, SYNTAX) if word.address in _OF_FREE)
    if not _SHOWS.search(block.text):
        return ()
    begins = _BEGIN.match(block.text)
    if begins:
        return (Word("PGM", None, False, "BEGIN PGM", block.span),)
    return tuple(word for word in words_as(block, SYNTAX) if word.address == "G" and word.text.upper() in FREE)


_OF_FREE = ("AN", "LEN", "CCX", "CCY", "CCA")
_MISSPELT_FREE = re.compile(
    BLOCK_NUMBER
    + rf"(?!(?:{'|'.join(FREE)})[ \t])F[A-Z]{{1,4}}[ \t]++(?:[^;]*[ \t])?(?:{'|'.join(_OF_FREE)})[ \t]*+[+-]",
    re.IGNORECASE,
)
"""A block that begins like a free element, and has a word that nothing else has."""
_SHOWS = re.compile(r"BEGIN|F[LC]T?[ \t\r\n]|F[LC]T?$", re.IGNORECASE)
_BEGIN = re.compile(r"[ \t\ufeff]*+\d*+[ \t]*+BEGIN[ \t]++PGM\b", re.IGNORECASE)

SELECTION = setting(
    "fselect",
    "which of several solutions FSELECT takes",
    {
        "own_order": "where solutions first differ: the nearer end along that element, then the smaller left turn",
        "ignore": "none: what the program says besides must choose",
    },
    BOOK.assumed("the order is on no page"),
)
AMBIGUOUS = setting(
    "ambiguous",
    "what comes of several solutions without FSELECT",
    {"error": "it is refused, with all of them", "first": "the first one is taken, in the order of FSELECT"},
    BOOK.assumed("an open contour cannot be run"),
)
SETTINGS = (SELECTION, AMBIGUOUS)
