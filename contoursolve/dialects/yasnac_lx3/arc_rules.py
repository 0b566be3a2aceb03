"""YASNAC LX3 arcs, G02 and G03: what cannot run as stated. No alarm numbers are known for them."""

from contoursolve.diagnostic import Severity
from contoursolve.dialects.yasnac_lx3.arc import CENTERS, WRONG_CENTER
from contoursolve.dialects.yasnac_lx3.manual import manual
from contoursolve.rules import Rule, at_most, some
from contoursolve.solving import RefusalKind, RemarkKind
from contoursolve.source import Evidence

_ROLE = "arc"
_START = "G00 X40. Z0.\nG01 X50. F0.2\n"
_GOOD = _START + "G02 X70. Z-10. R10."
_CENTERED = _START + "G02 X70. Z-10. I10. K0"
_BEFORE = "\nG00 X40. Z0.\nG111 A180. K-30. B120. X100."
_ARCS = manual("circular interpolation: not on the pages that we have", Evidence.ASSUMED)

ARC_RULES = (
    Rule(
        code="arc-without-center",
        message="the arc has neither a centre (I, K) nor a radius (R)",
        help="add I and K, the distances from the start to the centre, or R",
        source=_ARCS,
        roles=(_ROLE,),
        when=at_most(0, *CENTERS, "R"),
        accepted=(_GOOD + _BEFORE, _CENTERED + _BEFORE),
        rejected=(_START + "G02 X70. Z-10.",),
    ),
    Rule(
        code="arc-center-outside-plane",
        message="{words}: a lathe has no Y axis; the centre is given by I along X and K along Z",
        help="write I and K",
        source=_ARCS,
        roles=(_ROLE,),
        when=some(*WRONG_CENTER),
        accepted=(_CENTERED + _BEFORE,),
        rejected=(_START + "G02 X70. Z-10. I10. J0",),
    ),
    Rule(
        code="arc-radius-too-small",
        message="{words}: the radius of {actual} is less than half the distance from the start to the end, {limit}",
        help="write at least {limit}, or correct the end",
        source=_ARCS,
        roles=(_ROLE,),
        about=RefusalKind.RADIUS_TOO_SMALL,
        accepted=(_GOOD + _BEFORE,),
        rejected=(_START + "G02 X70. Z-10. R5.",),
    ),
    Rule(
        code="arc-undefined",
        message="{words} define no circle: the radius is 0, or the arc ends where it begins",
        help="give an end away from the start, or a full circle by I and K",
        source=_ARCS,
        roles=(_ROLE,),
        about=RefusalKind.CIRCLE_UNDEFINED,
        accepted=(_GOOD + _BEFORE, _START + "G02 I5. K0" + _BEFORE),
        rejected=(_START + "G02 X50. Z0. R10.", _START + "G02 R10.", _START + "G02 X70. Z-10. I0 K0"),
    ),
    Rule(
        code="arc-radius-difference",
        message="{words}: start and end of the arc differ in their distance from the centre by {off}, allowed {limit}",
        help="correct the end or the centre",
        source=manual("circular interpolation; the allowed difference is our choice", Evidence.ASSUMED),
        roles=(_ROLE,),
        about=RefusalKind.RADIUS_DIFFERENCE,
        accepted=(_CENTERED + _BEFORE, _START + "G02 X70. Z-10.005 I10. K0" + _BEFORE),
        rejected=(_START + "G02 X70. Z-10.5 I10. K0",),
    ),
    Rule(
        code="arc-radius-differs",
        message="{words}: start and end of the arc differ in their distance from the centre by {off}, within the "
        "allowed {limit}",
        help="correct the end or the centre",
        source=manual("circular interpolation; the allowed difference is our choice", Evidence.ASSUMED),
        roles=(_ROLE,),
        severity=Severity.INFO,
        about=RemarkKind.RADIUS_DIFFERS,
        accepted=(_CENTERED + _BEFORE,),
        rejected=(),
    ),
)
