"""ISG as a language of lines and arcs in a row: what meets, what its corners are, and its settings."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace as replace_fields
from decimal import Decimal

from msgspec.structs import replace

from contoursolve.controls.chain import Element, Joining, Language, Member, reading
from contoursolve.controls.common import first_motion_setting, setting
from contoursolve.controls.isg.lexicon import BOOK, CHAMFER, MODES, ROUNDING
from contoursolve.controls.plain import PLANES
from contoursolve.geometry import CornerShape, Heading, Turn
from contoursolve.reading import ContourForm, Convention, Modes, Sample, Setting, State

NO_SIZE = "@no-size"
"""A corner block without a size, before any."""

PAIR_SENSE = setting(
    "pair-sense",
    "whether one of two lines that meet may run against its angle",
    {
        "line": "it may: the angle is that of the line, either way",
        "ray": "it may not: the angle is the direction of travel",
    },
    BOOK.assumed("not described"),
)
CIRCLE = Setting(
    "radius-difference",
    "by how much the radii at two points of an arc may differ",
    {"0.01": "mm"},
    "0.01",
    BOOK.assumed("not described"),
    bounds=(Decimal("0.001"), Decimal(1)),
)
MODAL = setting(
    "angle-modal",
    "whether an angle stays in force",
    {"off": "a block without #ANG is an ordinary block", "on": "a line with one coordinate runs at the last #ANG"},
    BOOK.derived("the sample of error 21904"),
    changes={"on": reading(keeps_angle=True)},
)


def _is_ray(modes: Modes) -> bool:
    return modes.convention(PAIR_SENSE).value == "ray"


def _circumstances(member: Member, _: Sequence[State], _modes: Modes) -> Iterator[str]:
    size = member.here.memory.get("I")
    if member.corner is not None and (size is None or size.number == 0):
        yield NO_SIZE


def _conventions(form: ContourForm, _: Collection[str], modes: Modes) -> Iterator[Convention]:
    """Whether a line of a pair may run against its angle, if that was set."""
    if _is_ray(modes) and any(isinstance(row.fact, Heading) for row in form.facts):
        yield modes.convention(PAIR_SENSE)


MACHINE = setting(
    "machine",
    "which plane is selected before the program says it",
    {"mill": "G17", "lathe": "G18"},
    BOOK.assumed("the initial state is a parameter"),
    changes={"lathe": lambda dialect: replace_fields(dialect, plane=PLANES[18])},
)
FIRST_MOTION = first_motion_setting(BOOK.assumed("as samples without G1 show"))
SETTINGS = (MACHINE, PAIR_SENSE, CIRCLE, MODAL, FIRST_MOTION)

_LINE, _ARC = Element(None, False, False), Element(Turn.CCW, False, False)
_OPEN, _CLOSING = replace(_LINE, is_followed=True), replace(_LINE, is_over=True)
_START = "G17 G90 G0 X0 Y0"

LANGUAGE = Language(
    lexicon=MODES.lexicon,
    planes={},
    allowed=frozenset({*"NGFSTMDHXYZIJKR", "#ANG", "#RND", "#CHR", "#CHF", "#FRC"}),
    joining=Joining.OPEN,
    angle="#ANG",
    corners={
        "#CHR": CornerShape.CHAMFER_SETBACK,
        "#CHF": CornerShape.CHAMFER_FACE,
        "#RND": CornerShape.FILLET,
    },
    corner_codes={CHAMFER: "#CHR", ROUNDING: "#RND"},
    samples={
        (_LINE,): Sample(_START, ("G1 {X40} {Y23.094} {#ANG=30}",)),
        (_LINE, _LINE): Sample(_START, ("G1 {X40} {Y0} {#ANG=0} {#CHR=6} #RND=5", "{X60} {Y20} {#ANG=45}")),
        (_LINE, _ARC): Sample(_START, ("G1 {X40} {Y0} {#CHR=6} #RND=5", "G3 {X60} {Y20} {I0} {J20} {R20}")),
        (_OPEN, _CLOSING): Sample(_START, ("G1 #ANG=70 {#CHF=2} {#RND=2}", "{X80} {Y25} {#ANG=-30}")),
    },
    circumstances=_circumstances,
    conventions=_conventions,
    is_ray=_is_ray,
    is_ray_alone=True,
)
