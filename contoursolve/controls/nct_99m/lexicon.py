"""NCT 99M/2000M: addresses, numbers, planes and G codes, what chapter 16's blocks are, and assumptions."""

from decimal import Decimal

from contoursolve.controls.chain.language import (
    ARC,
    FEED,
    FOLLOWED,
    LINE,
    NEGATIVE_RADIUS,
    ON_PARALLEL_AXES,
    ONE_CENTER,
    OVER_CIRCLE,
    OVER_LINE,
    STATED_POINT,
)
from contoursolve.controls.further import MILLS, UNREAD_CALLS, known_by_name, letters
from contoursolve.controls.plain import CALLS, MILL_CODES, PLANES, code_rows, merge
from contoursolve.controls.zero_tables import length_rows, zero_table
from contoursolve.diagnostics import Book
from contoursolve.execution import fanuc
from contoursolve.geometry import Unit
from contoursolve.reading import (
    Address,
    Assumption,
    Effect,
    Lexicon,
    Modes,
    NumberFormat,
    Value,
    WithoutPoint,
    some,
)

BOOK = Book("NCT 99M/2000M Programmer's Manual")
CHAPTER = BOOK.printed("16.3.3, p. 129")
PARALLEL = BOOK.printed("16.2, p. 120")
ARCS = BOOK.printed("p. 25")
ANGLE = BOOK.derived("p. 120 and 123, not printed on p. 129")
SINGLE_BLOCK = "in single-block mode the control stops after each inserted chamfer or rounding, too (16.1, p. 120)"
CODES_SOURCE = BOOK.assumed("list of G codes")
OFFSETS = BOOK.assumed("work and tool offsets, as on Fanuc")

ADDRESSES = (
    Address("X", "coordinate", Unit.MM, CHAPTER, axis="X"),
    Address("Y", "coordinate", Unit.MM, CHAPTER, axis="Y"),
    Address("Z", "coordinate", Unit.MM, CHAPTER, axis="Z"),
    *(Address(axis, "coordinate of a parallel axis", Unit.MM, PARALLEL, axis=axis) for axis in "UVW"),
    Address("I", "centre along X, from where the arc begins", Unit.MM, ARCS),
    Address("J", "centre along Y, from where the arc begins", Unit.MM, ARCS),
    Address("K", "centre along Z, from where the arc begins", Unit.MM, ARCS),
    Address("R", "radius; negative for an arc of more than 180 deg", Unit.MM, ARCS),
    Address(",A", "angle of the line, from the plane's first axis, counter-clockwise", Unit.DEGREE, ANGLE),
    Address(",C", "chamfer", Unit.MM, BOOK.printed("16.1")),
    Address(",R", "rounding", Unit.MM, BOOK.printed("16.1")),
    Address("Q", "which intersection: along a line, negative the nearer, positive the farther", Unit.SIGN, CHAPTER),
)

NUMBERS = NumberFormat(WithoutPoint.AS_WRITTEN, BOOK.printed("examples, p. 123-130"))

AXES = ("X", "Y", "Z", "U", "V", "W")
PARALLEL_TO = {"X": "U", "Y": "V", "Z": "W"}

XY, ZX, YZ = PLANES.values()

_OWN_NAMES = {Effect.NONE: {64: "continuous cutting", 98: "return", 99: "return"}}
CODES = code_rows(CHAPTER, {}, PLANES) | code_rows(CODES_SOURCE, merge(MILL_CODES, _OWN_NAMES), {})

WORDS = Lexicon(
    {row.address: row for row in ADDRESSES},
    NUMBERS,
    letters(BOOK.assumed("addresses")),
    BOOK.assumed("an address that cannot stand there stops the control"),
)
MODES = Modes(
    WORDS,
    known_by_name(CODES_SOURCE, MILLS, CODES),
    AXES,
    CALLS,
    language=fanuc(),
    unread_calls=UNREAD_CALLS,
    zero=zero_table(OFFSETS, AXES, *length_rows(OFFSETS)),
)

UNCOMPENSATED, UNCOMPENSATED_FREE = "@uncompensated", "@uncompensated-free"
"""Over-defined without compensation where that is required, and where a setting frees it."""

BESIDE = tuple(f"beside-{axis}" for axis in AXES)
"""Words that move an axis outside the plane, each with its axis."""

CHAMFER, ROUNDING = ",C", ",R"


ASSUMPTIONS = (
    Assumption("circle-without-point",
        "the point of a circle with I, J or K may be left out before a computed intersection",
        BOOK.assumed("16.3.3, p. 129: the format has a point"), (ARC,),
        some("center-first", "center-second") & ~some(*STATED_POINT) & some(FOLLOWED)),
    Assumption("sign-of-radius", "the sign of R of an arc that begins in an intersection means nothing",
        BOOK.assumed("p. 128: not described"), (OVER_CIRCLE,), some(NEGATIVE_RADIUS)),
    Assumption("one-of-center", "of the two of I, J and K that belong to the plane, one that is left out is 0",
        BOOK.assumed("p. 25: not described"), (ARC,), some(ONE_CENTER)),
    Assumption("parallel-axis", "U, V or W beside ,A stands for its parallel axis of the plane, where that has no word",
        BOOK.assumed("16.2, p. 120: X, Y, Z or their parallel axes"), (LINE,), some(ON_PARALLEL_AXES)),
    Assumption("increment-beside-angle", "beside ,A, under G91, the coordinate is an increment from the start point",
        BOOK.assumed("16.2, p. 120: not described"), (LINE,), some("first-step", "second-step") & some(",A")),
    Assumption("corner-of-zero", ",C or ,R of value 0 means no corner",
        BOOK.assumed("16.1: not described"), (LINE, ARC, OVER_LINE, OVER_CIRCLE),
        Value((CHAMFER, ROUNDING), excluding=Decimal(0))),
    Assumption("feed-in-block", "F may stand in the block",
        BOOK.assumed("16.3: the formats have none"), (LINE, ARC, OVER_LINE, OVER_CIRCLE), some(FEED)),
)  # fmt: skip
