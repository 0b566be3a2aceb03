"""SINUMERIK as a language of lines and arcs in a row: what meets, what its corners are, and its settings."""

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace as replace_fields

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
from contoursolve.controls.chain.language import (
    BESIDE_ARC,
    FOLLOWED,
    LAST,
    RAPID,
    RAPID_CORNER,
    Premise,
    sense_conventions,
)
from contoursolve.controls.control_settings import (
    angle_sense_setting,
    arc_chamfer_setting,
    first_motion_setting,
    redundant_angle_setting,
    setting,
)
from contoursolve.controls.plain import PLANES
from contoursolve.controls.siemens.lexicon import BOOK, MODES, TANGENT_ARC
from contoursolve.geometry import CornerShape
from contoursolve.reading import ContourForm, Control, Convention, Diameter, Modes, Sample, Setting, State, all_of, some

STRICT_ANGLE, NO_STEPS, ALONG_ARC = "@strict-angle", "@no-steps", "@along-arc"


def _counting(diameter: Diameter) -> Callable[[Control], Control]:
    return lambda control: replace_fields(control, diameter=diameter)


def _turning(control: Control) -> Control:
    diameter = Diameter.ON if control.diameter is Diameter.BY_PLANE else control.diameter
    return replace_fields(control, plane=PLANES[18], diameter=diameter)


MACHINE = setting(
    "machine",
    "which plane is selected, and what X is, before the program says it",
    {"mill": "G17, and X is a radius in G17", "lathe": "G18, and X is a diameter"},
    BOOK.assumed("machine data"),
    changes={"lathe": _turning},
)
DIAMETER = setting(
    "diam",
    "what X is before the program says it by DIAMON, DIAMOF or DIAM90",
    {
        "plane": "a diameter while G18 is selected, else a radius",
        "DIAMOF": "a radius",
        "DIAMON": "a diameter",
        "DIAM90": "a diameter in absolute coordinates, a radius in increments",
    },
    BOOK.assumed("machine data"),
    changes={
        "DIAMOF": _counting(Diameter.OFF),
        "DIAMON": _counting(Diameter.ON),
        "DIAM90": _counting(Diameter.ABSOLUTE),
    },
)
SENSE = angle_sense_setting(BOOK.assumed("not described"))
REDUNDANT = redundant_angle_setting(BOOK.assumed("alarm 10795"), "error")
CLOSING = setting(
    "closing-incremental",
    "whether the second of two lines that meet may give its end by increments",
    {"allow": "it may: they count from where the first line starts", "error": "it must not"},
    BOOK.assumed("not described"),
)
ARC_CHAMFER = arc_chamfer_setting("CHR", BOOK.assumed("not described"))
ANGLE_NAME = setting(
    "name-angle",
    "which word states an angle",
    {"ANG": "ANG", "A": "A"},
    BOOK.printed("p. 214: the names are machine data"),
    changes={"A": reading({"A": "ANG"})},
)
_SETBACK, _FILLET = CornerShape.CHAMFER_SETBACK, CornerShape.FILLET
CHAMFER_NAME = setting(
    "name-chamfer",
    "which word states the width of a chamfer",
    {"CHR": "CHR; CHF is the length of the face", "CHF": "CHF; no word states the length of the face"},
    BOOK.printed("p. 214: the names are machine data"),
    changes={"CHF": reading({"CHF": "CHR"}, corner={"words": {"CHR": _SETBACK, "RND": _FILLET}})},
)


def _circumstances(member: Member, _: Sequence[State], _modes: Modes) -> Iterator[str]:
    if member.here.diameter is Diameter.BY_PLANE and any(member.here.plane.diameters):
        yield "@by-plane"


_PREMISES = (
    Premise(MACHINE, some("X"), is_told_where_set=True),
    Premise(DIAMETER, some("X"), is_told_where_set=True),
    Premise(REDUNDANT, all_of(("first", "first-step"), ("second", "second-step"), "ANG") & ~some(FOLLOWED)),
    Premise(ARC_CHAMFER, some("CHR") & some(BESIDE_ARC)),
    Premise(ANGLE_NAME, some("ANG"), is_told_where_set=True),
    Premise(CHAMFER_NAME, some("CHR"), is_told_where_set=True),
)


def _conventions(form: ContourForm, circumstances: Collection[str], modes: Modes) -> Iterator[Convention]:
    """The settings of X, where only the plane tells what it is; and of whether a line may run against its angle, if
    that was set."""
    if any(name.endswith("@by-plane") for name in circumstances):
        yield modes.convention(DIAMETER)
    yield from sense_conventions(SENSE, form, modes)


_RAPID = ("rapid-corner", "a corner beside G0", {"error": "it is refused", "made": "it is made as beside G1"})
_SECOND = (
    "no-second-move",
    "a corner behind which no move follows in the same plane",
    {"error": "it is refused", "leave-out": "it is left out, without an alarm"},
)
_OF_808D = BOOK.printed("808D milling, chamfer, second hand")
RAPID_CORNER_840D, SECOND_MOVE_840D = (setting(*row, BOOK.assumed("840D: not described")) for row in (_RAPID, _SECOND))
RAPID_CORNER_808D, SECOND_MOVE_808D = (
    setting(name, meaning, dict(reversed(values.items())), _OF_808D) for name, meaning, values in (_RAPID, _SECOND)
)
FIRST_MOTION = first_motion_setting(BOOK.assumed("as samples without G1 show"))
SETTINGS = (MACHINE, DIAMETER, SENSE, REDUNDANT, CLOSING, ARC_CHAMFER, ANGLE_NAME, CHAMFER_NAME, FIRST_MOTION)

_START = "G17 G90 G0 X0 Y0"


def _corners(rapid: Setting, second: Setting) -> CornerWords:
    return CornerWords(
        words={"CHR": _SETBACK, "CHF": CornerShape.CHAMFER_FACE, "RND": _FILLET},
        stays={"RNDM": "RND"},
        words_in_rapid=lambda modes: modes.has(rapid, "made"),
        leaves_out=lambda modes: modes.has(second, "leave-out"),
    )


def _premises_of(rapid: Setting, second: Setting) -> tuple[Premise, ...]:
    corners = some("CHR", "CHF", "RND")
    return (
        Premise(rapid, some(RAPID) & some(RAPID_CORNER), is_told_where_set=True),
        Premise(second, corners & some(LAST), is_told_where_set=True),
    )


LANGUAGE = Language(
    lexicon=MODES.lexicon,
    allowed=frozenset({*"NGFSTMDHXYZIJK", "ANG", "RND", "CHR", "CHF", "CR", "RNDM", "FRC", "FRCM"})
    | {f"{axis}={way}" for axis in "XYZ" for way in ("AC", "IC")}
    | {f"X={way}" for way in ("DAC", "DIC", "RAC", "RIC")},
    meeting=BlockMeeting(joining=Joining.OPEN, closes_by_steps=True),
    angle=AngleWords(address="ANG", sense=SENSE),
    names={MODES.radius: "R"},
    corner=_corners(RAPID_CORNER_840D, SECOND_MOVE_840D),
    arc=ArcWords(tangent=TANGENT_ARC),
    order=BlockOrder(between=3, runs_in_rapid=True),
    samples={
        (A_LINE,): Sample(_START, ("G1 {X40} {Y23.094} {ANG=30}",)),
        (A_LINE, A_LINE): Sample(_START, ("G1 {X40} {Y0} {ANG=0} {CHR=6} RND=5", "{X60} {Y20} {ANG=45}")),
        (A_LINE, AN_ARC): Sample(_START, ("G1 {X40} {Y0} {CHR=6} RND=5", "G3 {X60} {Y20} {I0} {J20} {CR=20}")),
        (OPEN_LINE, CLOSING_LINE): Sample(_START, ("G1 ANG=70 {CHF=2} {RND=2}", "{X80} {Y25} {ANG=-30}")),
    },
    basis=LanguageBasis(
        circumstances=_circumstances,
        where_set={
            STRICT_ANGLE: (REDUNDANT, "error"),
            NO_STEPS: (CLOSING, "error"),
            ALONG_ARC: (ARC_CHAMFER, "arc_length"),
        },
        conventions=_conventions,
        premises=(*_PREMISES, *_premises_of(RAPID_CORNER_840D, SECOND_MOVE_840D)),
    ),
)
LANGUAGE_808D = replace_fields(
    LANGUAGE,
    corner=_corners(RAPID_CORNER_808D, SECOND_MOVE_808D),
    basis=replace_fields(LANGUAGE.basis, premises=(*_PREMISES, *_premises_of(RAPID_CORNER_808D, SECOND_MOVE_808D))),
)
