"""ISG as a language of lines and arcs in a row: what meets, what its corners are, and its settings."""

from collections.abc import Iterator, Sequence
from dataclasses import replace as replace_fields

from contoursolve.controls.chain import (
    A_LINE,
    AN_ARC,
    CLOSING_LINE,
    OPEN_LINE,
    AngleWords,
    BlockMeeting,
    CornerWords,
    Joining,
    Language,
    LanguageBasis,
    Member,
    reading,
)
from contoursolve.controls.chain.language import Premise, sense_conventions
from contoursolve.controls.control_settings import angle_sense_setting, first_motion_setting, length_setting, setting
from contoursolve.controls.isg.lexicon import BOOK, CENTERS, CHAMFER, MODES, ROUNDING
from contoursolve.controls.plain import PLANES
from contoursolve.geometry import CornerShape
from contoursolve.reading import Modes, Sample, State, some

NO_SIZE = "@no-size"
"""A corner block without a size, before any."""

PAIR_SENSE = angle_sense_setting(BOOK.assumed("not described"), "pair-sense", "one of two lines that meet")
CIRCLE = length_setting(
    "radius-difference",
    "by how much the radii at two points of an arc may differ",
    "0.01",
    BOOK.assumed("not described"),
)
MODAL = setting(
    "angle-modal",
    "whether an angle stays in force",
    {"off": "a block without #ANG is an ordinary block", "on": "a line with one coordinate runs at the last #ANG"},
    BOOK.derived("the sample of error 21904"),
    changes={"on": reading(angle={"stays": True})},
)


UNCORRECTED = "@uncorrected"
"""The control does not move the centres of arcs."""


def _circumstances(member: Member, _: Sequence[State], _modes: Modes) -> Iterator[str]:
    size = member.here.memory.get("I")
    if member.corner is not None and (size is None or size.number == 0):
        yield NO_SIZE
    if CENTERS in member.here.memory:
        yield UNCORRECTED


MACHINE = setting(
    "machine",
    "which plane is selected before the program says it",
    {"mill": "G17", "lathe": "G18"},
    BOOK.assumed("the initial state is a parameter"),
    changes={"lathe": lambda control: replace_fields(control, plane=PLANES[18])},
)
FIRST_MOTION = first_motion_setting(BOOK.assumed("as samples without G1 show"))
SETTINGS = (MACHINE, PAIR_SENSE, CIRCLE, MODAL, FIRST_MOTION)

_START = "G17 G90 G0 X0 Y0"

LANGUAGE = Language(
    lexicon=MODES.lexicon,
    allowed=frozenset({*"NGFSTMDHXYZIJKR", "#ANG", "#RND", "#CHR", "#CHF", "#FRC"}),
    meeting=BlockMeeting(joining=Joining.OPEN),
    angle=AngleWords(address="#ANG", sense=PAIR_SENSE, is_ray_alone=True),
    corner=CornerWords(
        words={
            "#CHR": CornerShape.CHAMFER_SETBACK,
            "#CHF": CornerShape.CHAMFER_FACE,
            "#RND": CornerShape.FILLET,
        },
        codes={CHAMFER: "#CHR", ROUNDING: "#RND"},
        codes_in_rapid=True,
    ),
    samples={
        (A_LINE,): Sample(_START, ("G1 {X40} {Y23.094} {#ANG=30}",)),
        (A_LINE, A_LINE): Sample(_START, ("G1 {X40} {Y0} {#ANG=0} {#CHR=6} #RND=5", "{X60} {Y20} {#ANG=45}")),
        (A_LINE, AN_ARC): Sample(_START, ("G1 {X40} {Y0} {#CHR=6} #RND=5", "G3 {X60} {Y20} {I0} {J20} {R20}")),
        (OPEN_LINE, CLOSING_LINE): Sample(_START, ("G1 #ANG=70 {#CHF=2} {#RND=2}", "{X80} {Y25} {#ANG=-30}")),
    },
    basis=LanguageBasis(
        circumstances=_circumstances,
        conventions=lambda form, _, modes: sense_conventions(PAIR_SENSE, form, modes),
        premises=(
            Premise(MACHINE, some("X", "Y", "Z"), is_told_where_set=True),
            Premise(MODAL, some("#ANG"), is_told_where_set=True),
        ),
    ),
)
