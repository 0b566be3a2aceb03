"""Fanuc and Haas as languages of lines and arcs in a row, with their settings."""

from collections.abc import Iterator, Sequence
from dataclasses import replace as replace_fields
from decimal import Decimal
from math import radians, sin

from contoursolve.controls.chain import (
    A_LINE,
    AN_ARC,
    CLOSING_LINE,
    OPEN_LINE,
    AngleWords,
    ArcWords,
    BlockMeeting,
    BlockOrder,
    CornerWords,
    Joining,
    Language,
    LanguageBasis,
    Member,
    reading,
)
from contoursolve.controls.chain.language import BESIDE_ARC, FOLLOWED, WITHOUT_POINT, Premise, sense_conventions
from contoursolve.controls.control_settings import (
    angle_sense_setting,
    arc_chamfer_setting,
    arguments_setting,
    number_setting,
    redundant_angle_setting,
    setting,
)
from contoursolve.controls.fanuc.lexicon import (
    CORNERS,
    DRAWING,
    HAAS,
    HAAS_LATHE_WORDS,
    HAAS_MILL_WORDS,
    LATHE_WORDS,
    MILL_WORDS,
)
from contoursolve.controls.plain import LATHE
from contoursolve.diagnostics import Book, Evidence, Source
from contoursolve.geometry import CornerShape
from contoursolve.reading import Mode, Modes, Sample, Setting, State, all_of, some

GUARD = Decimal(1)
"""Degrees: the angles within which a control computes no vertex and makes no corner."""

WRONG_PLANE, UNGUARDED = "@wrong-plane", "@unguarded"
STRICT_ANGLE, COMPENSATION_CHANGES = "@strict-angle", "@compensation-changes"
COMPENSATION_CHANGED = "@compensation-changed"
"""G40, G41 or G42 stands in a block before, and this is the first move since."""
SUPPLEMENTARY, ALONG_ARC = "@supplementary", "@along-arc"
STRAIGHT_ONLY = "@straight-only"
"""Corners stand between lines alone."""


def _number(manual: Book) -> Setting:
    return number_setting(
        {
            "increment": "least increments: 0.001 mm, 0.0001 inch, 0.001 deg",
            "calculator": "mm, inches and degrees, as with a point",
        },
        manual.assumed("a machine parameter"),
    )


def _guard(manual: Book) -> Setting:
    return setting(
        "guard-deg",
        "how close two directions may come",
        {
            "1": "within 1 deg no vertex is computed, no coordinate is found, and no corner is made",
            "0": "only where they are the same",
        },
        manual.assumed("1 deg is printed for a sibling"),
    )


REDUNDANT_ANGLE = redundant_angle_setting(DRAWING.assumed("not described"), "check")
GENERATION = setting(
    "generation",
    "which generation of the control it is",
    {
        "NGC": "Next Generation: corners stand between lines alone",
        "classic": "classic control: corners stand beside arcs, too",
    },
    HAAS.printed("mill NGC (2017) p. 250; classic mill, G02 and G03"),
)

_SETBACK, _FILLET = CornerShape.CHAMFER_SETBACK, CornerShape.FILLET
_BIT = "parameter 3405, bit 4"
LATHE_CORNER_WORDS = setting(
    "corner-words",
    "which words state angles and corners",
    {
        "comma": ",A ,C ,R; and between two axes I, K or R with a sign",
        "plain": "A, C and R without a comma; between two axes C and R have a sign",
    },
    DRAWING.assumed(_BIT),
    changes={
        "plain": reading(
            {"A": ",A", "C": ",C", "R": ",R"},
            corner={"signed": {"C": _SETBACK, "R": _FILLET}, "is_signed_by_shape": True},
        )
    },
)
MILL_CORNER_WORDS = setting(
    "corner-words",
    "which word with a sign states a chamfer between two axes, beside ,C",
    {"comma": "I, J or K: the letter of the axis of the next line", "plain": "C without a comma"},
    CORNERS.assumed(_BIT),
    changes={"plain": reading(like={"C": ",C"}, corner={"signed": {"C": _SETBACK}})},
)


def _guard_corner(manual: Book) -> Setting:
    return setting(
        "guard-corner",
        "a corner where the path turns by less than that",
        {"drop": "it is left out, with a warning", "error": "it is refused"},
        manual.assumed("printed for a sibling"),
    )


ANGLE = setting(
    "angle",
    "what a number after ,A means",
    {"normal": "the angle itself", "supplementary": "180 deg minus the angle; contoursolve does not compute this"},
    DRAWING.assumed("another bit of parameter 3405, recalled"),
)
ARC_CHAMFER = arc_chamfer_setting(",C", CORNERS.assumed("not described"))
SENSE = angle_sense_setting(DRAWING.assumed("not described"))
_ARGUMENTS = arguments_setting(
    Source("FANUC 16i/18i-PB B-63684EN", "p. 278: the increment may depend on the machine", Evidence.PRINTED)
)
_HAAS_ARGUMENTS = arguments_setting(
    Source("Haas 96-8000 (1999)", "p. 364: I, J and K count 0.0001 inch; the other letters assumed", Evidence.PRINTED)
)
LATHE_NUMBER, MILL_NUMBER, HAAS_NUMBER = _number(DRAWING), _number(CORNERS), _number(HAAS)
LATHE_GUARD, MILL_GUARD, HAAS_GUARD = _guard(DRAWING), _guard(CORNERS), _guard(HAAS)
LATHE_SETTINGS = (
    *(LATHE_NUMBER, SENSE, LATHE_GUARD, _guard_corner(DRAWING)),
    *(REDUNDANT_ANGLE, LATHE_CORNER_WORDS, ANGLE, _ARGUMENTS),
)
MILL_SETTINGS = (MILL_NUMBER, MILL_GUARD, _guard_corner(CORNERS), MILL_CORNER_WORDS, ARC_CHAMFER, _ARGUMENTS)
HAAS_LATHE_SETTINGS = (
    *(HAAS_NUMBER, angle_sense_setting(HAAS.assumed("not described")), HAAS_GUARD, _guard_corner(HAAS)),
    _HAAS_ARGUMENTS,
)
HAAS_MILL_SETTINGS = (HAAS_NUMBER, HAAS_GUARD, _guard_corner(HAAS), GENERATION, _HAAS_ARGUMENTS)

_CORNERED = some(",C", ",R", "corner-first", "corner-second", "corner-R", "corner-C")


def _premises(number: Setting, guard: Setting, *more: Premise) -> tuple[Premise, ...]:
    return (
        Premise(number, some(WITHOUT_POINT)),
        Premise(guard, _CORNERED | some(",A", "A"), is_told_where_set=True),
        *more,
    )


def _guarded(modes: Modes) -> bool:
    return modes.settings.get("guard-deg") != "0"


def _guard_sine(modes: Modes) -> float:
    return sin(radians(float(GUARD))) if _guarded(modes) else 0.0


def _refuses(modes: Modes) -> bool:
    return modes.settings.get("guard-corner") == "error"


def _circumstances(member: Member, states: Sequence[State], modes: Modes) -> Iterator[str]:
    is_first = len(states) == 2  # noqa: PLR2004 - no block of the contour is before it
    moved_with = member.before.moved_with if is_first else states[-2].compensation
    is_entered = is_first or not _is_wrong_plane(member.before)
    holds = {
        WRONG_PLANE: is_entered and _is_wrong_plane(member.here),
        UNGUARDED: not _guarded(modes),
        COMPENSATION_CHANGES: member.before.compensation != member.here.compensation,
        COMPENSATION_CHANGED: moved_with != member.before.compensation == member.here.compensation
        and Mode.COMPENSATION not in member.here.doubts,
    }
    return (name for name, is_true in holds.items() if is_true)


def _is_wrong_plane(state: State) -> bool:
    """Whether a lathe is in another plane than that of Z and X."""
    return any(state.plane.diameters) and state.plane.code != LATHE.code


def _straight_circumstances(member: Member, states: Sequence[State], modes: Modes) -> Iterator[str]:
    yield from _circumstances(member, states, modes)
    yield STRAIGHT_ONLY


_COMMON = ("N", "G", "F", "S", "T", "M", "D", "H", "P", "E", "R", "I", "J", "K", ",C", ",R")

_ON_LATHE, _ON_MILL = "G00 X20. Z0.", "G17 G90 G00 X0 Y0"

FANUC_LATHE_LANGUAGE = Language(
    lexicon=LATHE_WORDS,
    allowed=frozenset({*_COMMON, "X", "Z", "U", "W", ",A"}),
    meeting=BlockMeeting(joining=Joining.OPEN),
    samples={
        (A_LINE,): Sample(_ON_LATHE, ("G01 {X40.} {Z-17.3205} ,A150.",)),
        (A_LINE, A_LINE): Sample(_ON_LATHE, ("G01 {X30.} {Z-20.} {,A165.96} {,C2.} ,R3.", "{X50.} {Z-21.} {,A95.7}")),
        (OPEN_LINE, CLOSING_LINE): Sample(
            _ON_LATHE, ("G01 {X20.} {Z-20.} ,A180. {,C2.} {,R3.}", "{X60.} {Z-47.} {,A120.}")
        ),
        (OPEN_LINE, CLOSING_LINE, A_LINE): Sample(
            _ON_LATHE, ("G01 ,A180. {,C2.} {,R3.}", "X60. Z-47. ,A120. {,C1.} ,R2.", "{Z-60.} {X60.0}")
        ),
    },
    basis=LanguageBasis(
        circumstances=_straight_circumstances,
        where_set={STRICT_ANGLE: (REDUNDANT_ANGLE, "error"), SUPPLEMENTARY: (ANGLE, "supplementary")},
        conventions=lambda form, _, modes: sense_conventions(SENSE, form, modes),
        premises=_premises(
            LATHE_NUMBER,
            LATHE_GUARD,
            Premise(ANGLE, some(",A")),
            Premise(LATHE_CORNER_WORDS, some("corner-first", "corner-second", "corner-R")),
            Premise(LATHE_CORNER_WORDS, _CORNERED | some(",A"), is_told_where_set=True),
            Premise(
                REDUNDANT_ANGLE, all_of(("first", "first-step"), ("second", "second-step"), ",A") & ~some(FOLLOWED)
            ),
        ),
    ),
    angle=AngleWords(sense=SENSE),
    corner=CornerWords(guard=_guard_sine, refuses=_refuses, signed={"I": _SETBACK, "K": _SETBACK, "R": _FILLET}),
    order=BlockOrder(threads=frozenset({32, 34}), passes=frozenset({4})),
)
FANUC_MILL_LANGUAGE = Language(
    lexicon=MILL_WORDS,
    allowed=frozenset({*_COMMON, "X", "Y", "Z"}),
    meeting=BlockMeeting(joining=Joining.OPEN),
    angle=AngleWords(address=""),
    samples={
        (A_LINE, A_LINE): Sample(_ON_MILL, ("G01 {X40.} {Y0} {,C6.} ,R5.", "{X60.} {Y20.}")),
        (A_LINE, AN_ARC): Sample(_ON_MILL, ("G01 {X40.} {Y0} {,C6.} ,R5.", "G03 {X60.} {Y20.} {I0} {J20.} {R20.}")),
    },
    basis=LanguageBasis(
        circumstances=_circumstances,
        where_set={ALONG_ARC: (ARC_CHAMFER, "arc_length")},
        premises=_premises(
            MILL_NUMBER,
            MILL_GUARD,
            Premise(MILL_CORNER_WORDS, some("corner-first", "corner-second", "corner-C")),
            Premise(ARC_CHAMFER, some(",C") & some(BESIDE_ARC)),
        ),
    ),
    corner=CornerWords(guard=_guard_sine, refuses=_refuses, signed={"I": _SETBACK, "J": _SETBACK, "K": _SETBACK}),
    arc=ArcWords(radius_wins=True),
    order=BlockOrder(threads=frozenset({33}), passes=frozenset({4})),
)

HAAS_LATHE_LANGUAGE = replace_fields(
    FANUC_LATHE_LANGUAGE,
    lexicon=HAAS_LATHE_WORDS,
    angle=replace_fields(FANUC_LATHE_LANGUAGE.angle, address="A"),
    allowed=FANUC_LATHE_LANGUAGE.allowed - {",A"} | {"A", "Y", "V"},
    samples={
        (A_LINE,): Sample(_ON_LATHE, ("G01 {X40.} {Z-17.3205} A150.",)),
        (A_LINE, A_LINE): Sample(_ON_LATHE, ("G01 {X30.} {Z-20.} {A165.96} {,C2.} ,R3.", "{X50.} {Z-21.} {A95.7}")),
    },
    basis=replace_fields(FANUC_LATHE_LANGUAGE.basis, premises=_premises(HAAS_NUMBER, HAAS_GUARD)),
)
HAAS_MILL_LANGUAGE = replace_fields(
    FANUC_MILL_LANGUAGE,
    lexicon=HAAS_MILL_WORDS,
    basis=replace_fields(
        FANUC_MILL_LANGUAGE.basis,
        where_set={STRAIGHT_ONLY: (GENERATION, "NGC")},
        premises=_premises(
            HAAS_NUMBER, HAAS_GUARD, Premise(GENERATION, _CORNERED & some(BESIDE_ARC), is_told_where_set=True)
        ),
    ),
    corner=replace_fields(FANUC_MILL_LANGUAGE.corner, signed={}),
    arc=ArcWords(),
)
