"""YASNAC LX3: its manual and alarms, addresses, numbers, G codes and assumptions (2.8.30, Table 2.33, unless noted)."""

from decimal import Decimal

from contoursolve.controls.control_settings import setting
from contoursolve.controls.further import LATHES, UNREAD_CALLS, known_by_name, letters
from contoursolve.controls.plain import LATHE_CODES, code_rows, merge
from contoursolve.controls.zero_tables import zero_table
from contoursolve.diagnostics import Alarm, Book, Evidence
from contoursolve.execution import fanuc
from contoursolve.geometry import Unit
from contoursolve.reading import (
    AT_ITS_LIMIT,
    Address,
    Assumption,
    Code,
    Effect,
    Lexicon,
    Modes,
    NumberFormat,
    Value,
    WithoutPoint,
    all_of,
    at_most,
    some,
)

BOOK = Book("YASNAC LX3 Instruction Manual")


def alarms(evidence: Evidence) -> tuple[Alarm, Alarm, Alarm]:
    """The alarms of multiple cornering: words that do not belong into the block, a wrong combination of words,
    impossible geometry. They are printed for what Table 2.44 lists of G112 (p. 146), and assumed for all else."""
    return Alarm("144", evidence), Alarm("145", evidence), Alarm("146", evidence)


TABLE = BOOK.printed("2.8.30, Table 2.33")
SENSE = BOOK.printed("2.8.30, Table 2.33; zero and sense p. 140 (vii)")
DIAMETER = BOOK.derived("2.8.30, Table 2.33; diameter from G11 and the G112 example")
LISTED = BOOK.assumed("list of G codes of the LX3 family")

ADDRESSES = (
    Address("X", "absolute X of the end point (diameter)", Unit.MM, DIAMETER, axis="X", is_diameter=True),
    Address(
        "U", "X increment from the start point (diameter)", Unit.MM, DIAMETER, "X", is_increment=True, is_diameter=True
    ),
    Address("Z", "absolute Z of the end point", Unit.MM, TABLE, axis="Z"),
    Address("W", "Z increment from the start point", Unit.MM, TABLE, axis="Z", is_increment=True),
    Address("A", "travel direction of the first straight, from +Z, counter-clockwise", Unit.DEGREE, SENSE),
    Address("B", "travel direction of the second straight, from +Z, counter-clockwise", Unit.DEGREE, SENSE),
    Address("I", "X distance from start to virtual intersection (radius value)", Unit.MM, TABLE),
    Address("K", "Z distance from start to virtual intersection", Unit.MM, TABLE),
    Address("P", "radius of the first rounding", Unit.MM, TABLE),
    Address("Q", "radius of the second rounding", Unit.MM, TABLE),
    Address("C", "amount of the first bevel", Unit.MM, TABLE),
    Address("D", "amount of the second bevel", Unit.MM, TABLE),
    Address("R", "radius of the arc", Unit.MM, BOOK.printed("2.8.30, p. 144")),
)

NUMBERS = NumberFormat(WithoutPoint.LEAST_INCREMENTS, TABLE)

_OWN_NAMES: dict[Effect, dict[int, str]] = {
    Effect.COMPENSATION: {40: "no nose radius compensation"},
    Effect.SINGLE: {29: "return from reference point", 30: "second reference point return"}
    | {70: "finishing cycle", 71: "roughing cycle along Z", 72: "roughing cycle along X", 73: "pattern cycle"}
    | {74: "face drilling cycle", 75: "grooving cycle", 76: "threading cycle"},
    Effect.NONE: {18: "plane Z X", 98: "feed a minute", 99: "feed a revolution"},
}
CODES = code_rows(LISTED, merge(LATHE_CODES, _OWN_NAMES), {}) | {
    code: Code(code, effect, meaning, source, says_all=effect is Effect.CYCLE)
    for code, effect, meaning, source in (
        (111, Effect.CONTOUR, "taper multiple cornering", TABLE),
        (112, Effect.CONTOUR, "circular-arc multiple cornering", BOOK.printed("2.8.30, p. 144")),
        (11, Effect.CYCLE, "bevelling", BOOK.printed("p. 31-32")),
        (12, Effect.CYCLE, "rounding", BOOK.printed("p. 31-32")),
    )
}

AXIS_45, LENGTH_45, SETBACK = "axis-45", "length", "setback"

BEVEL = setting(
    "bevel",
    "what the amount of a bevel C or D measures",
    {
        AXIS_45: "a segment at 45 degrees to the axes; the amount is its extent along Z and along X as radius",
        LENGTH_45: "a segment at 45 degrees to the axes; the amount is the length of the segment itself",
        SETBACK: "a segment between two points that are both as far from the virtual intersection as the amount",
    },
    BOOK.derived("2.8.30, p. 140 Note 3, on the 45 degree lines; the quadrants, p. 137"),
)

UNCHANGED, G01 = "unchanged", "g01"

MOTION_AFTER = setting(
    "motion-after",
    "which motion is in force after G111 and G112, which are not modal",
    {
        UNCHANGED: "the one that was in force before the block",
        G01: "G01, whatever was in force before the block",
    },
    BOOK.assumed("2.8.30: G111 is not modal; what is in force after it is not said"),
)

_CORNERING = ("G111", "G112")

ASSUMPTIONS = (
    # Where X(U) and Z(W) give line 2, there is no corner 2 to write a word for.
    Assumption(
        "no-corner-word",
        "no corner word means a sharp corner",
        BOOK.assumed("2.8.30, Tables 2.34 and 2.40: C or P, D or Q; of neither of them nothing is said"),
        _CORNERING,
        ~(some("C", "P") & ~(at_most(0, "D", "Q") & ~all_of(("X", "U"), ("Z", "W")))),
    ),
    Assumption(
        "corner-of-zero",
        "C, P, D or Q of value 0 means no corner",
        BOOK.assumed("2.8.30, Table 2.33: amount or radius without sign; of 0 nothing is said"),
        _CORNERING,
        Value(("C", "P", "D", "Q"), excluding=Decimal(0)),
    ),
    Assumption(
        "feed-in-block",
        "F may stand in the block",
        BOOK.assumed("2.8.30: M, S and T are refused, of F nothing is said"),
        _CORNERING,
        some("F"),
    ),
    Assumption(
        "bevel-at-its-limit",
        "a bevel may begin or end at the virtual intersection",
        BOOK.assumed("2.8.30, p. 140 Note 3: of a virtual intersection on a 45 degree line nothing is said"),
        _CORNERING,
        some(AT_ITS_LIMIT),
    ),
)

MODES = Modes(
    lexicon=Lexicon({row.address: row for row in ADDRESSES}, NUMBERS, letters(BOOK.assumed("addresses"))),
    codes=known_by_name(LISTED, LATHES, CODES),
    axes=("Z", "X"),
    calls=frozenset({98, 99}),
    language=fanuc(),
    unread_calls=UNREAD_CALLS,
    zero=zero_table(BOOK.assumed("work and tool offsets, as on Fanuc's lathes"), ("Z", "X")),
)
