"""NCT chapter 16 as a language of lines and arcs in a row: what meets, what Q chooses, and its settings."""

from collections.abc import Collection, Iterator, Mapping, Sequence

from msgspec.structs import replace

from contoursolve.controls.chain import (
    A_LINE,
    AN_ARC,
    CLOSING_LINE,
    OPEN_LINE,
    AngleWords,
    BlockMeeting,
    CornerWords,
    Element,
    Joining,
    Language,
    LanguageBasis,
    Member,
)
from contoursolve.controls.chain.language import (
    CIRCLE_CIRCLE,
    CIRCLE_LINE,
    CLOSING_ARC,
    LINE_CIRCLE,
    LINE_LINE,
    OPEN_ARC,
)
from contoursolve.controls.control_settings import length_setting, setting
from contoursolve.controls.nct_99m.lexicon import (
    ASSUMPTIONS,
    AXES,
    BOOK,
    MODES,
    PARALLEL_TO,
    SINGLE_BLOCK,
    UNCOMPENSATED,
    UNCOMPENSATED_FREE,
)
from contoursolve.controls.plain import PLANES
from contoursolve.geometry import Side
from contoursolve.reading import ContourForm, Convention, Modes, Sample, State
from contoursolve.tolerance import RADIUS_DIFFERENCE

ALLOWED = frozenset({"N", "G", "F", "S", "T", "M", "D", "H", *AXES, "I", "J", "K", "R", ",A", ",C", ",R", "Q"})

TITLES = {
    LINE_LINE: "linear-linear intersection",
    LINE_CIRCLE: "linear-circular intersection",
    CIRCLE_LINE: "circular-linear intersection",
    CIRCLE_CIRCLE: "circular-circular intersection",
    "line-angle": "line by its angle and one coordinate",
    "corners": "chamfers and roundings",
    "chain": "chain of intersections",
    "arc": "arc",
}

SELECTS = {
    LINE_LINE: "chooses nothing",
    LINE_CIRCLE: "which intersection along the line before: negative the nearer, positive the farther",
    CIRCLE_LINE: "which intersection along the line: negative the nearer, positive the farther",
    CIRCLE_CIRCLE: "which intersection of the two circles",
}

CLOCKWISE = "first-met-clockwise"

CIRCLE_CIRCLE_Q = setting(
    "circle-circle-q",
    "which intersection of two circles Q chooses",
    {
        "left-is-negative": "Q<0 the point left of the way from the first centre to the second, Q>0 the one right",
        "right-is-negative": "Q<0 the point right of the way from the first centre to the second, Q>0 the one left",
        CLOCKWISE: "Q<0 the point met first, clockwise along the first circle from its arc's start, Q>0 the one met "
        "second",
    },
    BOOK.assumed("16.3.4: the page has not been seen"),
)

COMPENSATION = setting(
    "compensation",
    "whether intersections are computed without G41 or G42",
    {
        "required": "G41 or G42 must be active before the first of two blocks that meet in an intersection",
        "free": "intersections are computed without G41 and G42, too",
    },
    BOOK.assumed("16.3: every format and example has it; the sentence is on no page seen"),
)

RADIUS_DIFFERENCES = length_setting(
    "radius-difference",
    "how much the radii at two points of an arc may differ (machine parameter RADDIFF)",
    str(RADIUS_DIFFERENCE),
    BOOK.assumed("p. 26 (4.3): alarm 3011; the value is one of each machine"),
    most=10,
)

SETTINGS = (CIRCLE_CIRCLE_Q, COMPENSATION, RADIUS_DIFFERENCES)


def _choose_side(role: str, is_negative: bool, modes: Modes) -> Side:
    """The intersection that a sign of Q chooses."""
    if role != CIRCLE_CIRCLE:
        return Side.NEARER if is_negative else Side.FARTHER
    negative, positive = _CIRCLE_SIDES[modes.convention(CIRCLE_CIRCLE_Q).value]
    return negative if is_negative else positive


_CIRCLE_SIDES = {
    "left-is-negative": (Side.LEFT, Side.RIGHT),
    "right-is-negative": (Side.RIGHT, Side.LEFT),
    CLOCKWISE: (Side.FIRST, Side.SECOND),
}
"""The sides that a negative and a positive Q of two circles choose."""


def _counts_clockwise(modes: Modes) -> bool:
    return modes.has(CIRCLE_CIRCLE_Q, CLOCKWISE)


def _uncompensated(member: Member, states: Sequence[State], modes: Modes) -> Iterator[str]:
    """The circumstance that G41 or G42 is missing in one of the states before N1, in N1 and in N2."""
    if member.element.is_over and any(state.compensation == 40 for state in states):  # noqa: PLR2004 - G40
        yield UNCOMPENSATED_FREE if modes.has(COMPENSATION, "free") else UNCOMPENSATED


def _conventions(form: ContourForm, circumstances: Collection[str], modes: Modes) -> Iterator[Convention]:
    """The settings that decide here: a difference of radii has a finding of its own, so that only one that was set is
    named."""
    if any(name.endswith((UNCOMPENSATED, UNCOMPENSATED_FREE)) for name in circumstances):
        yield modes.convention(COMPENSATION)
    difference = modes.convention(RADIUS_DIFFERENCES)
    if difference.value != RADIUS_DIFFERENCES.default and any(row.fact.circle for row in form.outline.facts):
        yield difference
    if CIRCLE_CIRCLE in {role.name for role in form.roles}:
        yield modes.convention(CIRCLE_CIRCLE_Q)


_FROM = "G17 G90 G41 G0 X50 Y0"

_N1_ARC = "G3 {X-50.0} {Y0} {I-50} {J0} {R50} {,C2} {,R2}"

SAMPLES: Mapping[tuple[Element, ...], Sample] = {
    (A_LINE,): Sample(_FROM, ("G1 {X90} {Y40.0} ,A45",)),
    (A_LINE, AN_ARC): Sample(_FROM, ("G1 {X80} {Y0} {,A0} {,C2} ,R8", "G3 X50 {Y30} {I-30} {J0} {R30}")),
    (OPEN_LINE, CLOSING_LINE): Sample(
        "G17 G90 G41 G0 X90 Y10", ("G1 {X50} {Y33.094} {,A150} {,C2} {,R2}", "G1 X10 Y20 ,A225 {Q1}")
    ),
    (OPEN_LINE, CLOSING_ARC): Sample(
        "G17 G90 G42 G0 X100 Y20", ("G1 {X-30} {Y-20} {,A197.103} {,C2} {,R2}", "G3 X20 Y40 I20 J-10 R50 {Q-1}")
    ),
    (OPEN_ARC, CLOSING_LINE): Sample(_FROM, (_N1_ARC, "G1 X-50 Y42.857 ,A171.87 {Q-1}")),
    (OPEN_ARC, CLOSING_ARC): Sample(_FROM, (_N1_ARC, "G3 X-40 Y60 I-40 J20 R40 {Q-1}")),
    (OPEN_LINE, replace(CLOSING_LINE, is_followed=True), CLOSING_ARC): Sample(
        "G17 G90 G41 G0 X90 Y10",
        ("G1 {X50} {Y33.094} {,A150} {,R2}", "G1 X10 Y20 ,A225 {Q1.0} {,C2}", "G3 X-40 Y-20 I-20 J-20 R20 {Q1}"),
    ),
}
"""Programs for the tables of words, one for each kind of form."""

LANGUAGE = Language(
    lexicon=MODES.lexicon,
    planes={plane.code: plane for plane in PLANES.values()},
    allowed=ALLOWED,
    meeting=BlockMeeting(
        joining=Joining.OVER_DEFINED,
        selector="Q",
        selects=SELECTS,
        choose_side=_choose_side,
        counts_clockwise=_counts_clockwise,
    ),
    titles=TITLES,
    angle=AngleWords(parallel=PARALLEL_TO),
    corner=CornerWords(note=SINGLE_BLOCK),
    assumptions=ASSUMPTIONS,
    samples=SAMPLES,
    basis=LanguageBasis(circumstances=_uncompensated, conventions=_conventions),
)
