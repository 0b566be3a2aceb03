"""Mitsubishi as a language of lines and arcs in a row: what meets, what touches, what H chooses, and its settings."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace as replace_fields

from msgspec.structs import replace

from contoursolve.controls.chain import (
    A_LINE,
    CLOSING_LINE,
    OPEN_LINE,
    AngleWords,
    ArcWords,
    BlockMeeting,
    Joining,
    Language,
    LanguageBasis,
    Member,
    reading,
)
from contoursolve.controls.chain.language import (
    ARC,
    BESIDE_ARC,
    CIRCLE_CIRCLE,
    CIRCLE_LINE,
    CLOSING_ARC,
    IN_ZX,
    LINE_CIRCLE,
    LINE_LINE,
    ONE_CENTER,
    OPEN_ARC,
    OPEN_ARC_END,
    WITHOUT_POINT,
    Premise,
)
from contoursolve.controls.control_settings import (
    arc_chamfer_setting,
    arguments_setting,
    length_setting,
    number_setting,
    setting,
)
from contoursolve.controls.mitsubishi.lexicon import BOOK, LAST_CORNER, MODES, TURNED_PLANES, turned
from contoursolve.reading import Assumption, ContourForm, Control, Convention, Modes, Sample, State, all_of, some

PICK_REQUIRED, STRAIGHT_ONLY = "@pick-required", "@straight-only"
UNGUARDED, ALONG_ARC, PICKS_NOTHING = "@unguarded", "@along-arc", "@picks-nothing"
FROM_END = "@from-end"
CHAMFER_LAST, ROUNDING_LAST = "@chamfer-last", "@rounding-last"
"""The corner word of two that stands behind the other one in its block."""
ONE_CORNER = "@one-corner"
"""A block takes one corner word."""
INCREMENTAL, HIGH_SPEED, TURNED = "@incremental", "@high-speed", "@turned"


def _turning(control: Control) -> Control:
    return replace_fields(control, plane=TURNED_PLANES[18], modes=turned(control.modes))


_NUMBER = number_setting(
    {"calculator": "mm, inches and degrees, as with a point", "increment": "least increments: 0.001 mm, 0.001 deg"},
    BOOK.assumed("a machine parameter"),
)
_DIAMETER = setting(
    "diameter",
    "whether X is a diameter",
    {"off": "X is a radius, and G17 is in force at first", "on": "X is a diameter, and G18 is in force at first"},
    BOOK.assumed("a machine parameter"),
    changes={"on": _turning},
)
_ANGLE_WORD = setting(
    "angle-word",
    "which word states an angle",
    {"A": "A or ,A; of both in a block, ,A does", ",A": "only ,A: A is an axis or another function"},
    BOOK.assumed("linear angle command: the names of axes are machine parameters"),
    changes={",A": reading(angle={"synonyms": (",A",)})},
)
_FULL_CIRCLE = setting(
    "arc-without-end",
    "what an arc about its centre is that has no end and no H",
    {"contact": "it ends where it meets the next block, if that fits", "circle": "a full circle"},
    BOOK.assumed("not described"),
    changes={"circle": reading(arc={"closes": True})},
)
_FIRST_CENTER = setting(
    "first-centre",
    "what I, J and K of an arc without an end are counted from",
    {"start": "where the arc starts", "end": "where it ends, as printed; contoursolve does not compute this"},
    BOOK.derived("p. 378: the end is what is computed"),
)
_PICK = setting(
    "h-default",
    "what a crossing without H is",
    {"0": "as with H0: the one with the shorter line", "error": "H must be there"},
    BOOK.assumed("not described"),
)
CONTACT = length_setting(
    "contact-tol", "by how much two arcs about known centres may miss a contact", "0.01", BOOK.assumed("not described")
)
_SENSE = setting(
    "angle-sense",
    "whether a line that touches no arc may run against its angle",
    {"line": "it may: the angle is that of the line, either way", "ray": "it may not: the angle is the way it runs"},
    BOOK.derived("p. 375: the angle at the start or at the end of the line"),
)
_CORNER = setting(
    "corner",
    "beside what ,C and ,R stand",
    {"II": "beside lines and arcs", "I": "between two lines alone"},
    BOOK.assumed("corner chamfering I and II: options"),
)
_ARC_CHAMFER = arc_chamfer_setting("the size of a chamfer", BOOK.assumed("not described"), "virtual corner")
_GUARD = setting(
    "guard-deg",
    "how close the directions of two lines may come",
    {"1": "at less than 1 deg no vertex is computed", "0": "only parallel lines have none"},
    BOOK.assumed("alarm P392"),
)
_TWO_CORNERS = setting(
    "two-corner-words",
    "what ,C and ,R in one block are",
    {"last": "of ,C and ,R in a block the last is made", "error": "a block takes one of ,C and ,R"},
    LAST_CORNER,
)
SETTINGS = (
    _NUMBER, _DIAMETER, _ANGLE_WORD, _FULL_CIRCLE, _FIRST_CENTER, _PICK, CONTACT, _SENSE, _CORNER, _ARC_CHAMFER, _GUARD,
    _TWO_CORNERS,
    arguments_setting(BOOK.assumed("not described")),
)  # fmt: skip


_CENTER = some("center-first", "center-second", "center-at-first", "center-at-second")
_PREMISES = (
    Premise(_NUMBER, some(WITHOUT_POINT)),
    Premise(_DIAMETER, some(IN_ZX)),
    Premise(_DIAMETER, some("X"), is_told_where_set=True),
    Premise(_ANGLE_WORD, some("A") & ~some(",A")),
    Premise(_FULL_CIRCLE, some(OPEN_ARC_END) & _CENTER & ~some("H")),
    Premise(_FIRST_CENTER, some(OPEN_ARC_END) & some("center-first", "center-second")),
    Premise(_TWO_CORNERS, all_of(",C", ",R")),
    Premise(_CORNER, some(",C", ",R") & some(BESIDE_ARC)),
    Premise(_ARC_CHAMFER, some(",C") & some(BESIDE_ARC)),
    Premise(_GUARD, some("A", ",A"), is_told_where_set=True),
)
"""The angle is called A, whichever word states it."""


def _circumstances(member: Member, _: Sequence[State], _modes: Modes) -> Iterator[str]:
    pick, corners = (
        member.block.find("H"),
        [each.address for each in member.block.words if each.address in (",C", ",R")],
    )
    holds = {
        INCREMENTAL: member.here.is_incremental,
        CHAMFER_LAST: corners[-1:] == [",C"],
        ROUNDING_LAST: corners[-1:] == [",R"],
        HIGH_SPEED: "G05" in member.here.memory,
        TURNED: any(member.here.plane.diameters),
        PICKS_NOTHING: pick is not None and pick.number not in (None, 0, 1),
    }
    return (name for name, is_true in holds.items() if is_true)


def _conventions(form: ContourForm, _: Collection[str], modes: Modes) -> Iterator[Convention]:
    """Of those about the geometry, the ones that were set."""
    roles = {role.name for role in form.roles}
    about = ((_SENSE, True), (CONTACT, CIRCLE_CIRCLE in roles))
    return (
        modes.convention(setting) for setting, is_here in about if is_here and not modes.has(setting, setting.default)
    )


_MILL = "G17 G90 G00 X0 Y0"

_ASSUMPTIONS = (
    Assumption("h-missing", "a crossing without H is the one with the shorter line",
               BOOK.assumed("not described"), (LINE_CIRCLE, CIRCLE_LINE),
               some("1:center-first", "1:center-at-first", "2:center-first") & ~some("1:H", "2:H")),
    Assumption("one-of-center", "of the two of I, J and K that belong to the plane, one that is left out is 0",
               BOOK.assumed("not described"), (ARC,), some(ONE_CENTER)),
    Assumption("radius-of-contact", "a positive R is the arc of at most 180 deg, a negative one the other",
               BOOK.assumed("not described"), (LINE_CIRCLE, CIRCLE_LINE, CIRCLE_CIRCLE), some("1:R", "2:R")),
)  # fmt: skip

LANGUAGE = Language(
    lexicon=MODES.lexicon,
    allowed=frozenset({*"NGFSTMDHEXYZIJKRAPQ", ",A", ",C", ",R"}),
    meeting=BlockMeeting(
        joining=Joining.PAIRED, picks="H", contact=lambda modes: float(modes.convention(CONTACT).value)
    ),
    titles={
        LINE_LINE: "Geometric I: vertex of two lines",
        LINE_CIRCLE: "Geometric IB: line and arc",
        CIRCLE_LINE: "Geometric IB: arc and line",
        CIRCLE_CIRCLE: "Geometric IB: two arcs",
        "line-angle": "line by its angle and one coordinate",
        "corners": "chamfers and roundings",
        "chain": "Geometric I or IB in a row with corners",
        "arc": "arc",
    },
    angle=AngleWords(address="A", synonyms=("A", ",A"), sense=_SENSE),
    arc=ArcWords(centers=("P", "Q")),
    assumptions=_ASSUMPTIONS,
    samples={
        (A_LINE,): Sample(_MILL, ("G01 {X40.} {Y23.094} A30.",)),
        (A_LINE, A_LINE): Sample(_MILL, ("G01 {X40.} {Y0} {A0} {,C6.} ,R5.", "{X60.} {Y20.} {A45.}")),
        (OPEN_LINE, CLOSING_LINE): Sample(_MILL, ("G01 A70. {,C2.} {,R2.}", "{X80.} {Y25.} {A-30.}")),
        (OPEN_LINE, CLOSING_ARC): Sample(_MILL, ("G01 A10.", "G03 {X60.} {Y15.} I-20. J-25. {R32.} {H1}")),
        (OPEN_LINE, replace(CLOSING_ARC, touches=True)): Sample(_MILL, ("G01 A15.", "G03 {X70.} {Y50.} {R30.}")),
        (OPEN_ARC, CLOSING_LINE): Sample(_MILL, ("G03 I30. {J0} {H0}", "G01 {X20.} {Y-60.} {A-90.}")),
        (OPEN_ARC, replace(CLOSING_ARC, touches=True)): Sample(_MILL, ("G03 I0 J30.", "G03 {X15.} {Y20.} {R10.}")),
        (OPEN_ARC, replace(CLOSING_LINE, touches=True)): Sample(_MILL, ("G03 R30.", "G01 {X-20.} {Y76.} {A150.}")),
    },
    basis=LanguageBasis(
        circumstances=_circumstances,
        where_set={
            PICK_REQUIRED: (_PICK, "error"),
            STRAIGHT_ONLY: (_CORNER, "I"),
            FROM_END: (_FIRST_CENTER, "end"),
            ONE_CORNER: (_TWO_CORNERS, "error"),
            ALONG_ARC: (_ARC_CHAMFER, "arc_length"),
            UNGUARDED: (_GUARD, "0"),
        },
        conventions=_conventions,
        premises=_PREMISES,
    ),
)
