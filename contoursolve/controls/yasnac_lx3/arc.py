"""YASNAC LX3 arcs, G02 and G03: nothing is calculated, but whether an arc can run as stated is checked."""

import dataclasses
from collections.abc import Mapping
from decimal import Decimal
from functools import cache
from itertools import chain
from math import hypot
from string import ascii_uppercase

from msgspec.structs import replace

from contoursolve.controls.geometry_rules import told
from contoursolve.controls.yasnac_lx3.claim import BlockReader
from contoursolve.controls.yasnac_lx3.g111 import START
from contoursolve.controls.yasnac_lx3.lexicon import BOOK
from contoursolve.diagnostics import Severity
from contoursolve.gcode import Block
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    BlockRole,
    Choice,
    Coordinate,
    Given,
    Offset,
    OnCircle,
    Radius,
    Side,
    Turn,
    Unit,
)
from contoursolve.reading import (
    ContourForm,
    FactRow,
    Modes,
    Outline,
    ParsedContour,
    Rule,
    State,
    WordTable,
    apply_modes,
    at_most,
    some,
)
from contoursolve.tolerance import LENGTH, RADIUS_DIFFERENCE

CENTER, END, RADIUS = "C", "E", "r"
WRONG_CENTER = frozenset("J")
"""The centre word of an axis that a lathe does not have."""

_TURNS = {2: Turn.CW, 3: Turn.CCW}
_ENDS, CENTERS = (("Z", "W"), ("X", "U")), ("K", "I")
"""The words of the end and of the centre, by axis."""


@cache
def arc(code: int) -> ContourForm:
    """The form of an arc with G02 or G03."""
    return ContourForm(
        name=f"G{code:02}",
        title="arc",
        roles=(BlockRole("arc"),),
        outline=Outline(
            start=START,
            points=(CENTER, END),
            radii=(RADIUS,),
            facts=(
                FactRow(Offset("I", CENTER, START, SECOND), ("I",)),
                FactRow(Offset("K", CENTER, START, FIRST), ("K",)),
                FactRow(Radius("R", RADIUS), ("R",)),
                FactRow(Coordinate("X", END, SECOND), ("X",)),
                FactRow(Offset("U", END, START, SECOND), ("U",)),
                FactRow(Coordinate("Z", END, FIRST), ("Z",)),
                FactRow(Offset("W", END, START, FIRST), ("W",)),
                FactRow(OnCircle(START, CENTER, RADIUS), ()),
                FactRow(OnCircle(END, CENTER, RADIUS), ()),
            ),
            path=(Arc("arc", START, END, CENTER, RADIUS, _TURNS[code]),),
            corners=(),
            intersections=(),
        ),
        allowed=frozenset(ascii_uppercase) - WRONG_CENTER,
        table=WordTable(
            combinations=((("X",), ("U",)), (("Z",), ("W",)), (("I", "K"), ("R",))),
        ),
        meanings={"I": "X distance from start to centre (radius value)", "K": "Z distance from start to centre"},
        is_contour=False,
    )


ARC_FORMS = tuple(arc(code) for code in _TURNS)


def claim_arc(block: Block, code: int, state: State, modes: Modes) -> ParsedContour | None:
    """The arc of a block, if it cannot run as stated; None if it can, or if that cannot be known.

    Most arcs can, and this tells it in a few operations; what is wrong with the others is found out by their form.
    """
    after = apply_modes(state, block, modes)
    words = [word for word in block.words if word.address in _READ]
    values = {word.address: modes.lexicon.value(word, after.unit) for word in words if word.address not in WRONG_CENTER}
    is_doubtful = any(values.keys() >= {*names} for names in (*_ENDS, ("R", "I"), ("R", "K")))
    if is_doubtful or not words or block.faults or None in (*values.values(), *state.start().values):
        return None
    known = {address: value for address, value in values.items() if value is not None}
    has_center = not known.keys().isdisjoint((*CENTERS, "R"))
    if len(words) == len(known) and has_center and _runs(known, state):
        return None
    reader = BlockReader(block, code, state, after, modes)
    supplied = [Given(names[1], Decimal(0), Unit.MM, None) for names in _ENDS if known.keys().isdisjoint(names)]
    choices = []
    if "R" in known:
        supplied.append(replace(reader.values["R"], value=abs(known["R"])))
        is_left = (known["R"] > 0) == (_TURNS[code] is Turn.CCW)
        choices.append(Choice(CENTER, Side.LEFT if is_left else Side.RIGHT, "R"))
    elif has_center:
        # Of the two distances to the centre, one that is not written is 0 (assumed, as on other controls).
        supplied += [Given(name, Decimal(0), Unit.MM, None) for name in CENTERS if name not in known]
    return dataclasses.replace(reader.claim(arc(code), WRONG_CENTER, supplied), choices=tuple(choices))


_READ = frozenset({*chain(*_ENDS), *CENTERS, "R", *WRONG_CENTER})


def _runs(values: Mapping[str, Decimal], state: State) -> bool:
    """Whether an arc can run from the start to the end, as far as a control looks.

    The rounding of a difference of exactly what is allowed must not make it more.
    """
    first, second = (_step(values, state, axis) for axis in (FIRST, SECOND))
    chord = hypot(first, second)
    if "R" in values:
        return 0 < chord <= 2 * (abs(float(values["R"])) + RADIUS_DIFFERENCE) + LENGTH
    along, across = (float(values.get(name, 0)) for name in CENTERS)
    distance = hypot(along, across)
    return distance > 0 and abs(hypot(first - along, second - across) - distance) <= RADIUS_DIFFERENCE + LENGTH


def _step(values: Mapping[str, Decimal], state: State, axis: int) -> float:
    """From start to end along an axis, mm."""
    absolute, increment = _ENDS[axis]
    start = state.start().values[axis]
    if absolute in values and start is not None:
        return float(values[absolute] - start)
    return float(values.get(increment, 0))


_ROLE = "arc"
_START = "G00 X40. Z0.\nG01 X50. F0.2\n"
_GOOD = _START + "G02 X70. Z-10. R10."
_CENTERED = _START + "G02 X70. Z-10. I10. K0"
_BEFORE = "\nG00 X40. Z0.\nG111 A180. K-30. B120. X100."
_ARCS = BOOK.assumed("circular interpolation: not on the pages that we have")

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
    told(
        "arc-radius-too-small",
        _GOOD + _BEFORE,
        _START + "G02 X70. Z-10. R5.",
        message="{words}: the radius of {actual} is less than half the distance from the start to the end, {limit}",
        help="write at least {limit}, or correct the end",
        source=_ARCS,
        roles=(_ROLE,),
    ),
    told(
        "arc-undefined",
        (_GOOD + _BEFORE, _START + "G02 I5. K0" + _BEFORE),
        _START + "G02 X50. Z0. R10.",
        _START + "G02 R10.",
        _START + "G02 X70. Z-10. I0 K0",
        message="{words} {define} no circle: the radius is 0, or the arc ends where it begins",
        help="give an end away from the start, or a full circle by I and K",
        source=_ARCS,
        roles=(_ROLE,),
    ),
    told(
        "arc-radius-difference",
        (_CENTERED + _BEFORE, _START + "G02 X70. Z-10.005 I10. K0" + _BEFORE),
        _START + "G02 X70. Z-10.5 I10. K0",
        message="{words}: start and end of the arc differ in their distance from the centre by {off}, allowed {limit}",
        help="correct the end or the centre",
        source=BOOK.assumed("circular interpolation; the allowed difference is our choice"),
        roles=(_ROLE,),
    ),
    told(
        "arc-radius-differs",
        _CENTERED + _BEFORE,
        message="{words}: start and end of the arc differ in their distance from the centre by {off}, within the "
        "allowed {limit}",
        help="correct the end or the centre",
        source=BOOK.assumed("circular interpolation; the allowed difference is our choice"),
        roles=(_ROLE,),
        severity=Severity.INFO,
    ),
)
