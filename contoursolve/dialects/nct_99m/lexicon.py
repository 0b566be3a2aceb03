"""NCT 99M/2000M: addresses, numbers, planes and G codes (Programmer's Manual, chapter 16, unless noted)."""

from contoursolve.model import Length, Plane, Unit
from contoursolve.reading import Address, Code, Effect, Lexicon, Modes, NumberFormat, WithoutPoint
from contoursolve.source import Evidence, Source

MANUAL = "NCT 99M/2000M Programmer's Manual"
CHAPTER = Source(MANUAL, "16.3.3, p. 129", Evidence.PRINTED)
PARALLEL = Source(MANUAL, "16.2, p. 120", Evidence.PRINTED)
ARCS = Source(MANUAL, "p. 25", Evidence.PRINTED)
ANGLE = Source(MANUAL, "p. 120 and 123, not printed on p. 129", Evidence.DERIVED)
SINGLE_BLOCK = "in single-block mode the control stops after each inserted chamfer or rounding, too (16.1, p. 120)"
CODES_SOURCE = Source(MANUAL, "list of G codes", Evidence.ASSUMED)

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
    Address(",C", "chamfer", Unit.MM, Source(MANUAL, "16.1", Evidence.PRINTED)),
    Address(",R", "rounding", Unit.MM, Source(MANUAL, "16.1", Evidence.PRINTED)),
    Address("Q", "which intersection: along a line, negative the nearer, positive the farther", Unit.SIGN, CHAPTER),
)

NUMBERS = NumberFormat(WithoutPoint.AS_WRITTEN, Source(MANUAL, "examples, p. 123-130", Evidence.PRINTED))

AXES = ("X", "Y", "Z", "U", "V", "W")
PARALLEL_TO = {"X": "U", "Y": "V", "Z": "W"}

XY = Plane("G17", ("X", "Y"), ("I", "J"))
ZX = Plane("G18", ("Z", "X"), ("K", "I"))
YZ = Plane("G19", ("Y", "Z"), ("J", "K"))
PLANES = {plane.code: plane for plane in (XY, ZX, YZ)}


def _codes(effect: Effect, meanings: dict[int, str]) -> tuple[Code, ...]:
    return tuple(Code(number, effect, meaning, CODES_SOURCE) for number, meaning in meanings.items())


CODES = (
    *_codes(Effect.MOTION, {0: "positioning", 1: "line", 2: "arc clockwise", 3: "arc counter-clockwise", 33: "thread"}),
    *(Code(number, Effect.PLANE, "plane", CHAPTER, plane=plane) for number, plane in {17: XY, 18: ZX, 19: YZ}.items()),
    Code(20, Effect.UNITS, "inches", CODES_SOURCE, unit=Length.INCH),
    Code(21, Effect.UNITS, "millimetres", CODES_SOURCE, unit=Length.MM),
    *_codes(Effect.COMPENSATION, {40: "no compensation", 41: "compensation left", 42: "compensation right"}),
    *_codes(Effect.ABSOLUTE, {90: "absolute coordinates"}),
    *_codes(Effect.INCREMENTAL, {91: "incremental coordinates"}),
    *_codes(Effect.NO_MOTION, {4: "dwell", 10: "data setting", 22: "stored limit on", 23: "stored limit off"}),
    *_codes(
        Effect.SINGLE, {27: "reference point check", 28: "reference point return", 29: "return from reference point"}
    ),
    *_codes(
        Effect.SINGLE,
        {30: "other reference point return", 31: "skip", 37: "length measurement", 53: "machine coordinates"},
    ),
    *_codes(Effect.SINGLE, {65: "macro call", 66: "modal macro call", 67: "end of modal macro call"}),
    *_codes(Effect.CYCLE, dict.fromkeys((73, 74, 76, *range(81, 90)), "drilling cycle")),
    *_codes(Effect.CANCEL, {80: "end of cycle"}),
    *_codes(Effect.PRESET, {92: "coordinate setting"}),
    *_codes(Effect.SHIFT, dict.fromkeys(range(54, 60), "work coordinate system")),
    *_codes(Effect.FRAME, {50: "end of scaling", 51: "scaling", 52: "local coordinate system", 68: "rotation"}),
    *_codes(Effect.FRAME, {69: "end of rotation", 15: "end of polar coordinates", 16: "polar coordinates"}),
    *_codes(Effect.NONE, {43: "length compensation", 44: "length compensation", 49: "no length compensation"}),
    *_codes(Effect.NONE, {61: "exact stop", 64: "continuous cutting", 94: "feed a minute", 95: "feed a revolution"}),
    *_codes(
        Effect.NONE, {9: "exact stop", 96: "constant surface speed", 97: "spindle speed", 98: "return", 99: "return"}
    ),
)

MODES = Modes(
    lexicon=Lexicon({row.address: row for row in ADDRESSES}, NUMBERS),
    codes={code.number: code for code in CODES},
    axes=AXES,
    calls=frozenset({98, 99}),
)
