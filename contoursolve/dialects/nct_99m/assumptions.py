"""NCT 99M, chapter 16: what the control is taken to accept although no page that we have says so."""

from decimal import Decimal

from contoursolve.dialects.nct_99m.element import (
    ARC,
    CHAMFER,
    FEED,
    FOLLOWED,
    LINE,
    NEGATIVE_RADIUS,
    ON_PARALLEL_AXES,
    ONE_CENTER,
    OVER_CIRCLE,
    OVER_LINE,
    ROUNDING,
)
from contoursolve.dialects.nct_99m.lexicon import MANUAL
from contoursolve.reading import Assumption
from contoursolve.rules import Condition, Value, some
from contoursolve.source import Evidence, Source

_POINT = ("first", "first-step", "second", "second-step")


def _row(name: str, meaning: str, place: str, roles: tuple[str, ...], when: Condition) -> Assumption:
    return Assumption(name, meaning, Source(MANUAL, place, Evidence.ASSUMED), roles, when)


ASSUMPTIONS = (
    _row(
        "circle-without-point",
        "the point of a circle that has I, J or K may be left out before an over-defined block",
        "16.3.3, p. 129: the format has a point",
        (ARC,),
        some("center-first", "center-second") & ~some(*_POINT) & some(FOLLOWED),
    ),
    _row(
        "sign-of-radius",
        "the sign of R of an over-defined circle means nothing",
        "p. 128: not described",
        (OVER_CIRCLE,),
        some(NEGATIVE_RADIUS),
    ),
    _row(
        "one-of-center",
        "of the two of I, J and K that belong to the plane, one that is left out is 0",
        "p. 25: not described",
        (ARC,),
        some(ONE_CENTER),
    ),
    _row(
        "parallel-axis",
        "U, V or W beside ,A stands for the axis of the plane to which it is parallel, where that has no word",
        "16.2, p. 120: X, Y, Z or their parallel axes",
        (LINE,),
        some(ON_PARALLEL_AXES),
    ),
    _row(
        "increment-beside-angle",
        "beside ,A, under G91, the coordinate is an increment from the start point",
        "16.2, p. 120: not described",
        (LINE,),
        some("first-step", "second-step") & some(",A"),
    ),
    _row(
        "corner-of-zero",
        ",C or ,R of value 0 means no corner",
        "16.1: not described",
        (LINE, ARC, OVER_LINE, OVER_CIRCLE),
        Value((CHAMFER, ROUNDING), excluding=Decimal(0)),
    ),
    _row(
        "feed-in-block",
        "F may stand in the block",
        "16.3: the formats have none",
        (LINE, ARC, OVER_LINE, OVER_CIRCLE),
        some(FEED),
    ),
)
