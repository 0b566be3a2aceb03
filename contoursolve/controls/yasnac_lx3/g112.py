"""YASNAC LX3 G112, circular-arc multiple cornering: its facts, its path, which way round its arc runs, its rules."""

import dataclasses
from collections.abc import Iterator
from decimal import Decimal
from functools import cache

from contoursolve.controls.geometry_rules import GENERAL
from contoursolve.controls.rule_rows import row
from contoursolve.controls.yasnac_lx3.claim import OTHER_G, BlockReader, after_cornering, bevel_of
from contoursolve.controls.yasnac_lx3.g111 import PASSING, REFUSED, START, V1, V2
from contoursolve.controls.yasnac_lx3.lexicon import ASSUMPTIONS, BOOK, alarms
from contoursolve.diagnostics import Evidence, Severity
from contoursolve.gcode import Block
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    BlockRole,
    Choice,
    Coordinate,
    CornerShape,
    Given,
    Heading,
    Level,
    Line,
    Offset,
    OnCircle,
    Radius,
    Side,
    Turn,
    Unit,
)
from contoursolve.reading import (
    ContourForm,
    CornerRow,
    FactRow,
    Modes,
    Outline,
    ParsedContour,
    Sample,
    State,
    Value,
    WordTable,
    all_of,
    at_least,
    at_most,
    some,
)

CENTER, LANDING, RADIUS, WAY = "C", "landing line", "r", "way"
"""LANDING is the foot of the centre on the line on which the second corner lands, WAY the direction of both lines."""

BACKS_UP, UNDECIDED = "@backs-up", "@undecided"
"""Circumstances: an arc that would have to turn round, and one that could run on either side of its centre."""

TURNING, FACING = "G112 turning", "G112 facing"

_CENTERS = ("K", "I")
"""The words that place the centre, by axis."""
_WAYS = {(FIRST, 1): 0, (FIRST, -1): 180, (SECOND, 1): 90, (SECOND, -1): -90}
"""Degrees, by the axis along which a line runs and the sign of its way."""


@cache
def g112(along: int, turn: Turn, bevel: CornerShape) -> ContourForm:
    """The form of the block: lines along an axis, an arc that turns so, bevels of a shape."""
    across = 1 - along
    absolute, increment = ("X", "U") if along == FIRST else ("Z", "W")
    axis, other = ("Z", "X") if along == FIRST else ("X", "Z")
    return ContourForm(
        name="G112",
        title=f"circular-arc multiple cornering, {'turning' if along == FIRST else 'facing'}",
        roles=(BlockRole("G112"), BlockRole(TURNING if along == FIRST else FACING)),
        outline=Outline(
            start=START,
            points=(CENTER, V1, LANDING, V2),
            radii=(RADIUS,),
            facts=(
                FactRow(Offset("I", CENTER, START, SECOND), ("I",)),
                FactRow(Offset("K", CENTER, START, FIRST), ("K",)),
                FactRow(Radius("R", RADIUS), ("R",)),
                FactRow(Heading(WAY, START, V1), (WAY,)),
                FactRow(OnCircle(V1, CENTER, RADIUS), ()),
                FactRow(Level(LANDING, CENTER, along), ()),
                FactRow(Coordinate(absolute, LANDING, across), (absolute,)),
                FactRow(Offset(increment, LANDING, START, across), (increment,)),
                FactRow(Heading(WAY, LANDING, V2), (WAY,)),
                FactRow(OnCircle(V2, CENTER, RADIUS), ()),
            ),
            path=(Line("line 1", START, V1, heading=WAY), Arc("arc", V1, V2, CENTER, RADIUS, turn)),
            lines=(Line("line 2", LANDING, V2, heading=WAY),),
            corners=(
                CornerRow("corner 1", V1, "line 1", "arc", {"C": bevel, "P": CornerShape.FILLET}),
                CornerRow("corner 2", V2, "arc", None, {"D": bevel, "Q": CornerShape.FILLET}, lands_on="line 2"),
            ),
            intersections=(V1, V2),
        ),
        allowed=frozenset("XUZWIKRPQCD") | PASSING,
        table=WordTable(
            combinations=(
                *(((), (name,)) for name in (_CENTERS[across], "R", absolute, increment)),
                ((), (_CENTERS[along],), (_CENTERS[along], WAY)),
            ),
            sample=_SAMPLES[along],
        ),
        assumptions=ASSUMPTIONS,
        meanings={
            absolute: f"absolute {other} of the line along {axis} on which the second corner lands",
            increment: f"{other} increment from the start to the line along {axis} on which the second corner lands",
            "I": "X distance from start to the centre of the arc (radius value)",
            "K": "Z distance from start to the centre of the arc",
        },
    )


_SAMPLES = (
    Sample("G00 X100. Z-50.", ("G112 {C5.} {D5.} {I10.} {K-50.} {P5.} {Q5.} {R30.} {U0} {X100.}",)),
    Sample("G00 X100. Z-50.", ("G112 Z-50. {C2.} {D2.} {I30.} {K5.} {P2.} {Q2.} {R15.} {W0}",)),
)

G112_FORMS = tuple(g112(along, Turn.CW, CornerShape.CHAMFER_AXIS_45) for along in (FIRST, SECOND))


def claim_g112(block: Block, state: State, modes: Modes) -> ParsedContour:
    """The contour of a block with G112, which is not modal (assumed, as G111)."""
    reader = BlockReader(block, 112, state, after_cornering(block, state, modes), modes)
    addresses = {word.address for word in block.words}
    along = SECOND if addresses & {"Z", "W"} and not addresses & {"X", "U"} else FIRST
    forward, aside = (reader.value(_CENTERS[axis]) for axis in (along, 1 - along))
    way, side = _sign(forward), _sign(aside)
    beyond = _landing(reader, 1 - along, aside)
    supplied = []
    if way:
        supplied.append(Given(WAY, Decimal(_WAYS[along, way]), Unit.DEGREE, None))
    # The arc passes its centre on the side of line 1, or on that of the landing line where line 1 leads to the centre.
    turns = way * (side or -_sign(beyond)) * (1 if along == FIRST else -1)
    form = g112(along, Turn.CCW if turns > 0 else Turn.CW, bevel_of(modes))
    # The arc begins where line 1 meets it first, and ends beyond its centre (derived).
    choices = (Choice(V1, Side.NEARER, ""), Choice(V2, Side.FARTHER, ""))
    return dataclasses.replace(
        reader.claim(form, REFUSED, supplied),
        choices=choices,
        circumstances=frozenset(_circumstances(side, beyond)),
        limits=_limits(reader, 1 - along, aside, beyond),
    )


def _sign(value: Decimal | None) -> int:
    return (value > 0) - (value < 0) if value is not None else 0


def _landing(reader: BlockReader, across: int, aside: Decimal | None) -> Decimal | None:
    """The distance of the landing line from the centre, in the positive sense of its axis, mm; None where unknown."""
    absolute, increment = (("Z", "W"), ("X", "U"))[across]
    start = reader.before.start().values[across]
    place, step = reader.value(absolute), reader.value(increment)
    if aside is None:
        return None
    if step is not None:
        return step - aside
    return place - start - aside if place is not None and start is not None else None


def _limits(reader: BlockReader, across: int, aside: Decimal | None, beyond: Decimal | None) -> dict[str, Decimal]:
    """The values of words that put the landing line through the centre, each by itself."""
    if aside is None or beyond is None:
        return {}
    lands = reader.values.keys() & set("ZW" if across == FIRST else "XU")
    limits = {name: reader.values[name].value - beyond for name in lands}
    return {**limits, _CENTERS[across]: aside + beyond}


def _circumstances(side: int, beyond: Decimal | None) -> Iterator[str]:
    """The circumstances that keep the arc from running from V1 to V2; the centre lies to `side` of line 1."""
    if beyond is not None and side * _sign(beyond) > 0:
        yield BACKS_UP
    if beyond == 0 and not side:
        yield UNDECIDED


_ROLE = "G112"
_END = ("X", "U", "Z", "W")
_START = "G00 X100. Z-50.\n"
_GOOD = _START + "G112 U0 I10. K-50. R30."
_FACE = _START + "G112 W0 I30. K5. R15."
_ARC_FIRST = _START + "G112 U-10. I0 K-50. R30."

_FORMAT = BOOK.printed("2.8.30, p. 144")
_IMPOSSIBLE = BOOK.printed("2.8.30, p. 146, Table 2.44")
_WAY = BOOK.derived("2.8.30, p. 144-146: the path does not back up")
_FITS = BOOK.derived("2.8.30, p. 146, Table 2.44: no intersection, bevel cannot be made")
_WORDS_IN_BLOCK, _PRINTED_COMBINATION, _PRINTED_GEOMETRY = alarms(Evidence.PRINTED)
_, _COMBINATION, _GEOMETRY = alarms(Evidence.ASSUMED)

_COMBINATION_RULES = (
    row("g112-word-missing", "G112 needs I, K, R and one of X, U, Z and W; the block gives {present:X U Z W I K R}",
        "add {absent:X|U|Z|W I K R}; a zero must be written, too (U0, I0)", _FORMAT, at_most(3, _END, "I", "K", "R"),
        ((_GOOD, _FACE), _START + "G112 U0 I10. K-50.", _START + "G112 I10. K-50. R30.", _START + "G112 U0 K-50. R30."),
        (_ROLE,), alarm=_COMBINATION),
    row("g112-x-and-u",
        "{words}: X and U both give the line on which the second corner lands", "keep one of them", _FORMAT,
        all_of("X", "U"), (_GOOD, _GOOD + " X100."), (_ROLE,), alarm=_COMBINATION),
    row("g112-z-and-w",
        "{words}: Z and W both give the line on which the second corner lands", "keep one of them", _FORMAT,
        all_of("Z", "W"), (_FACE, _FACE + " Z-50."), (_ROLE,), alarm=_COMBINATION),
    row("g112-x-and-z",
        "{words:X U Z W}: the second corner lands on a line along Z by X(U), or along X by Z(W), not on both",
        "keep X(U) if the straight runs along Z, Z(W) if it runs along X", _FORMAT, all_of(("X", "U"), ("Z", "W")),
        ((_GOOD, _FACE), _GOOD + " Z-150."), (_ROLE,), alarm=_COMBINATION),
    row("g112-c-and-p", "{words}: the first corner is either a bevel C or a rounding P", "keep one of them", _FORMAT,
        all_of("C", "P"), ((_GOOD + " C5. Q5.", _GOOD + " P5. D5."), _GOOD + " C5. P5."), (_ROLE,),
        alarm=_PRINTED_COMBINATION),
    row("g112-d-and-q", "{words}: the second corner is either a bevel D or a rounding Q", "keep one of them", _FORMAT,
        all_of("D", "Q"), ((_GOOD + " D5.", _GOOD + " Q5."), _GOOD + " D5. Q5."), (_ROLE,), alarm=_PRINTED_COMBINATION),
    row("g112-corner-sign", "{words} {are} negative; C, P, D and Q are written without sign",
        "delete the minus sign: the arc tells on which side the corner lies",
        BOOK.assumed("2.8.30, p. 144: without sign; that it is an error"),
        Value(("C", "P", "D", "Q"), least=Decimal(0)), ((_GOOD + " P5. Q5.", _GOOD + " P0"), _GOOD + " P-5."), (_ROLE,),
        alarm=_COMBINATION),
    row("g112-radius", "{words}: the radius of the arc must be more than 0",
        "write the radius without sign; I and K tell where the centre is", BOOK.derived("2.8.30, p. 144: arc radius"),
        Value(("R",), least=Decimal(0), excluding=Decimal(0)),
        (_GOOD, _START + "G112 U0 I10. K-50. R-30.", _START + "G112 U0 I10. K-50. R0"), (_ROLE,), alarm=_COMBINATION),
    row("g112-m-s-t", "{words:M S T}: a G112 block takes no M, S or T word", "write it in a block of its own",
        _IMPOSSIBLE, some("M", "S", "T"),
        ((_GOOD + " F0.2", "M08\n" + _GOOD), _GOOD + " M08", _GOOD + " S500", _GOOD + " T0101"), (_ROLE,),
        alarm=_WORDS_IN_BLOCK),
    row("g112-other-g", "{words:other G} uses the axis words of the block itself, and so does G112",
        "write it in a block of its own; G112 needs no G01",
        BOOK.assumed("2.8.30: multiple cornering is not modal; two codes of one group"), some(OTHER_G),
        (_GOOD, ("G112", "G01 G112"), ("G112", "G04 G112")), (_ROLE,), alarm=_COMBINATION),
)  # fmt: skip

_WAY_RULES = (
    row("g112-no-way",
        "{words}: the straight runs along Z towards the centre, which is not before or behind the start",
        "write the Z distance to the centre, or use Z(W) if the straight runs along X", _WAY,
        Value(("K",), excluding=Decimal(0)), (_GOOD, _START + "G112 U0 I10. K0 R30."), (TURNING,), alarm=_GEOMETRY,
        is_about_geometry=True),
    row("g112-no-way-facing",
        "{words}: the straight runs along X towards the centre, which is neither above nor below the start",
        "write the X distance to the centre, or use X(U) if the straight runs along Z", _WAY,
        Value(("I",), excluding=Decimal(0)), (_FACE, _START + "G112 W0 I0 K5. R15."), (FACING,), alarm=_GEOMETRY,
        is_about_geometry=True),
    row("g112-backs-up",
        "{words}: the straight and the line of the second corner lie on opposite sides of the centre; the arc would "
        "turn back",
        "put both lines on one side of the centre, or change the sign of I or K", _WAY,
        some(BACKS_UP) & at_least(1, "I", "K", *_END),
        (_GOOD, _START + "G112 U30. I10. K-50. R30.", _START + "G112 W8. I30. K5. R15."), (_ROLE,), alarm=_GEOMETRY,
        is_about_geometry=True),
    row("g112-side-open",
        "{words}: the straight and the line of the second corner lead through the centre; no word says on which "
        "side the arc runs",
        "move the centre or the line on which the second corner lands", _WAY, some(UNDECIDED) & at_least(1, "I", "K",
        *_END),
        (_ARC_FIRST, _START + "G112 U0 I0 K-50. R30."), (_ROLE,), alarm=_GEOMETRY, is_about_geometry=True),
)  # fmt: skip

# The two corners cannot overlap: each of them stays on its side of the arc's lowest or highest point.
_GEOMETRY_RULES = (
    row("g112-missed", like=GENERAL,
        message="the line through {subject} misses the arc: it passes the centre at {actual}, the radius is {limit}",
        help="write a larger R, or move the centre or the line nearer to each other by {off}", source=_IMPOSSIBLE,
        examples=(_GOOD, _START + "G112 U0 I40. K-50. R30.", _START + "G112 U-60. I10. K-50. R30."), roles=(_ROLE,),
        alarm=_PRINTED_GEOMETRY),
    row("g112-touches", like=GENERAL,
        message="the line through {subject} just touches the arc, so the path has no corner there",
        help="check that it is meant to touch", source=_WAY, examples=(_GOOD, _START + "G112 U-40. I10. K-50. R30."),
        roles=(_ROLE,), severity=Severity.INFO),
    row("g112-reversed", like=GENERAL,
        message="{subject} would have to run back: it meets the arc first {off} behind its start",
        help="start farther from the arc, or change the centre or the radius", source=_IMPOSSIBLE,
        examples=(_GOOD, _START + "G112 U0 I10. K-20. R30."), roles=(_ROLE,), alarm=_PRINTED_GEOMETRY),
    row("g112-arc-empty", like=GENERAL, message="{subject} ends where it begins: both lines touch it in the same point",
        help="move the centre or the line on which the second corner lands", source=_FITS,
        examples=(_GOOD, _START + "G112 U0 I30. K-50. R30."), roles=(_ROLE,), alarm=_GEOMETRY),
    row("g112-corner-too-large", like=GENERAL,
        message="{subject} does not fit: {words} is {actual}, {fits} on the straight and on the arc",
        help="{smaller}, or make the straight and the arc longer", source=_FITS,
        examples=((_GOOD + " P5. Q5.", _GOOD + " C5. D5."), _GOOD + " P60.", _GOOD + " D40."), roles=(_ROLE,),
        alarm=_GEOMETRY),
    row("g112-no-corner", like=GENERAL, message="{words}: at {subject} the line touches the arc, so it is no corner",
        source=_FITS, examples=(_GOOD + " P5.", _START + "G112 U-40. I10. K-50. R30. Q5."), roles=(_ROLE,),
        alarm=_GEOMETRY),
    row("g112-bevel-band", like=GENERAL, message="{words}: no 45 deg segment of {subject} joins the line and the arc",
        source=_IMPOSSIBLE, examples=(_GOOD + " C5. D5.", _START + "G112 U0 I28. K-50. R30. C1."), roles=(_ROLE,),
        alarm=_PRINTED_GEOMETRY),
)  # fmt: skip

G112_RULES = _COMBINATION_RULES + _WAY_RULES + _GEOMETRY_RULES
