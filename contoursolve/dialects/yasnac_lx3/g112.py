"""YASNAC LX3 G112, circular-arc multiple cornering: its facts, its path, and which way round its arc runs.

In the turning form line 1 and the line on which corner 2 lands are parallel to Z, in the facing form parallel to X.
What is said here of `along` and `across` holds for both: the axis of these lines, and the other one.
"""

from collections.abc import Iterator
from dataclasses import replace
from decimal import Decimal
from functools import cache

from contoursolve.constraints import Coordinate, Heading, Level, Offset, OnCircle, Radius
from contoursolve.dialects.yasnac_lx3.claim import after_cornering, bevel_of, claim_of
from contoursolve.dialects.yasnac_lx3.g111 import PASSING, REFUSED, START, V1, V2
from contoursolve.dialects.yasnac_lx3.lexicon import ASSUMPTIONS
from contoursolve.model import FIRST, SECOND, Arc, Choice, CornerShape, Given, Line, Role, Side, Turn, Unit
from contoursolve.reading import Claim, CornerRow, FactRow, Form, Modes, Sample, State
from contoursolve.syntax import Block

CENTER, LANDING, RADIUS, WAY = "C", "landing line", "r", "way"
"""LANDING is the foot of the centre on the line on which corner 2 lands, WAY the direction of both lines."""

BACKS_UP, UNDECIDED = "@backs-up", "@undecided"
"""Circumstances: an arc that would have to turn round, and one that could run on either side of its centre."""

TURNING, FACING = "G112 turning", "G112 facing"

_CENTERS = ("K", "I")
"""The words that place the centre, by axis."""
_WAYS = {(FIRST, 1): 0, (FIRST, -1): 180, (SECOND, 1): 90, (SECOND, -1): -90}
"""Degrees, by the axis along which a line runs and the sign of its way."""


@cache
def g112(along: int, turn: Turn, bevel: CornerShape) -> Form:
    """The form of the block: lines along an axis, an arc that turns so, bevels of a shape."""
    across = 1 - along
    absolute, increment = ("X", "U") if along == FIRST else ("Z", "W")
    axis, other = ("Z", "X") if along == FIRST else ("X", "Z")
    return Form(
        name="G112",
        title=f"circular-arc multiple cornering, {'turning' if along == FIRST else 'facing'}",
        roles=(Role("G112"), Role(TURNING if along == FIRST else FACING)),
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
        allowed=frozenset("XUZWIKRPQCD") | PASSING,
        combinations=(
            *(((), (name,)) for name in (_CENTERS[across], "R", absolute, increment)),
            ((), (_CENTERS[along],), (_CENTERS[along], WAY)),
        ),
        sample=_SAMPLES[along],
        assumptions=ASSUMPTIONS,
        meanings={
            absolute: f"absolute {other} of the line along {axis} on which corner 2 lands",
            increment: f"{other} increment from the start point to the line along {axis} on which corner 2 lands",
            "I": "X distance from start to the centre of the arc (radius value)",
            "K": "Z distance from start to the centre of the arc",
        },
    )


_SAMPLES = (
    Sample("G00 X100. Z-50.", ("G112 {C5.} {D5.} {I10.} {K-50.} {P5.} {Q5.} {R30.} {U0} {X100.}",)),
    Sample("G00 X100. Z-50.", ("G112 Z-50. {C2.} {D2.} {I30.} {K5.} {P2.} {Q2.} {R15.} {W0}",)),
)

G112_FORMS = tuple(g112(along, Turn.CW, CornerShape.CHAMFER_AXIS_45) for along in (FIRST, SECOND))


def claim_g112(block: Block, state: State, modes: Modes) -> Claim:
    """The contour of a block with G112, which is not modal (assumed, as G111)."""
    after = after_cornering(block, state, modes)
    addresses = {word.address for word in block.words}
    along = SECOND if addresses & {"Z", "W"} and not addresses & {"X", "U"} else FIRST
    draft = claim_of(block, g112(along, Turn.CW, CornerShape.FILLET), 112, state, after, modes)
    forward, aside = (_value(draft, _CENTERS[axis]) for axis in (along, 1 - along))
    way, side = _sign(forward), _sign(aside)
    beyond = _landing(draft, 1 - along, aside)
    supplied = []
    if way:
        supplied.append(Given(WAY, Decimal(_WAYS[along, way]), Unit.DEGREE, None))
    # The arc passes its centre on the side of line 1, or on that of the landing line where line 1 leads to the centre.
    turns = way * (side or -_sign(beyond)) * (1 if along == FIRST else -1)
    form = g112(along, Turn.CCW if turns > 0 else Turn.CW, bevel_of(modes))
    # The arc begins where line 1 meets it first, and ends beyond its centre (derived).
    choices = [Choice(V1, Side.NEARER, ""), Choice(V2, Side.FARTHER, "")]
    circumstances = _circumstances(side, beyond)
    claim = claim_of(block, form, 112, state, after, modes, REFUSED, supplied, choices, circumstances)
    return replace(claim, limits=_limits(draft, 1 - along, aside, beyond))


def _value(claim: Claim, name: str) -> Decimal | None:
    return claim.givens[name].value if name in claim.givens else None


def _sign(value: Decimal | None) -> int:
    return (value > 0) - (value < 0) if value is not None else 0


def _landing(claim: Claim, across: int, aside: Decimal | None) -> Decimal | None:
    """How far the landing line lies from the centre, in the positive sense of its axis, mm; None where unknown."""
    absolute, increment = (("Z", "W"), ("X", "U"))[across]
    start = claim.before.start().values[across]
    place, step = _value(claim, absolute), _value(claim, increment)
    if aside is None:
        return None
    if step is not None:
        return step - aside
    return place - start - aside if place is not None and start is not None else None


def _limits(claim: Claim, across: int, aside: Decimal | None, beyond: Decimal | None) -> dict[str, Decimal]:
    """Where the words put the landing line through the centre, each by itself."""
    if aside is None or beyond is None:
        return {}
    lands = claim.givens.keys() & set("ZW" if across == FIRST else "XU")
    limits = {name: claim.givens[name].value - beyond for name in lands}
    return {**limits, _CENTERS[across]: aside + beyond}


def _circumstances(side: int, beyond: Decimal | None) -> Iterator[str]:
    """What keeps the arc from running from V1 to V2; the centre lies to `side` of line 1."""
    if beyond is not None and side * _sign(beyond) > 0:
        yield BACKS_UP
    if beyond == 0 and not side:
        yield UNDECIDED
