"""YASNAC LX3 arcs, G02 and G03: nothing is calculated for them, but whether an arc can run as stated is checked."""

from dataclasses import replace
from decimal import Decimal
from functools import lru_cache
from math import hypot
from string import ascii_uppercase

from contoursolve.constraints import Coordinate, Offset, OnCircle, Radius
from contoursolve.dialects.yasnac_lx3.claim import claim_of
from contoursolve.dialects.yasnac_lx3.g111 import START
from contoursolve.model import FIRST, SECOND, Arc, Choice, Given, Role, Side, Turn, Unit
from contoursolve.reading import Claim, FactRow, Form, Modes, State, apply_modes
from contoursolve.syntax import Block
from contoursolve.tolerance import RADIUS_DIFFERENCE

CENTER, END, RADIUS = "C", "E", "r"
WRONG_CENTER = frozenset("J")
"""The centre word of an axis that a lathe does not have."""

_TURNS = {2: Turn.CW, 3: Turn.CCW}
_ENDS, CENTERS = (("Z", "W"), ("X", "U")), ("K", "I")
"""The words of the end and of the centre, by axis."""


@lru_cache(maxsize=2)
def arc(code: int) -> Form:
    """The form of an arc with G02 or G03."""
    return Form(
        name=f"G{code:02}",
        title="arc",
        roles=(Role("arc"),),
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
        allowed=frozenset(ascii_uppercase) - WRONG_CENTER,
        combinations=((("X",), ("U",)), (("Z",), ("W",)), (("I", "K"), ("R",))),
        meanings={"I": "X distance from start to centre (radius value)", "K": "Z distance from start to centre"},
        is_contour=False,
    )


ARC_FORMS = tuple(arc(code) for code in _TURNS)


def claim_arc(block: Block, code: int, state: State, modes: Modes) -> Claim | None:
    """The arc of a block, if it cannot run as stated; None if it can, or if that cannot be known.

    Most arcs can, and this tells it in a few operations; what is wrong with the others is found out by their form.
    """
    addresses = {word.address for word in block.words}
    if None in state.start().values or not addresses & {"X", "U", "Z", "W", *CENTERS, "R", *WRONG_CENTER}:
        return None
    after = apply_modes(state, block, modes)
    claim = claim_of(block, arc(code), code, state, after, modes, WRONG_CENTER)
    is_doubtful = any(claim.words.keys() >= {*names} for names in (*_ENDS, ("R", "I"), ("R", "K")))
    is_variable = any(word.number is None for word in claim.words.values())
    if is_doubtful or is_variable or block.faults or claim.repeated:
        return None
    steps = [_step(claim, axis) for axis in (FIRST, SECOND)]
    center = [claim.givens[name].value if name in claim.givens else Decimal(0) for name in CENTERS]
    radius = claim.givens["R"].value if "R" in claim.givens else None
    is_centered = any(name in claim.givens for name in CENTERS)
    if not addresses & WRONG_CENTER and (radius or is_centered) and _runs(steps, center, radius):
        return None
    supplied = [Given(names[1], Decimal(0), Unit.MM, None) for names in _ENDS if not addresses & {*names}]
    choices = []
    if radius is not None:
        supplied.append(replace(claim.givens["R"], value=abs(radius)))
        is_left = (radius > 0) == (_TURNS[code] is Turn.CCW)
        choices.append(Choice(CENTER, Side.LEFT if is_left else Side.RIGHT, "R"))
    elif is_centered:
        # Of the two distances to the centre, one that is not written is 0 (assumed, as on other controls).
        supplied += [Given(name, Decimal(0), Unit.MM, None) for name in CENTERS if name not in addresses]
    return claim_of(block, arc(code), code, state, after, modes, WRONG_CENTER, supplied, choices)


def _step(claim: Claim, axis: int) -> Decimal:
    """From start to end along an axis, mm."""
    absolute, increment = _ENDS[axis]
    start = claim.before.start().values[axis]
    if absolute in claim.givens and start is not None:
        return claim.givens[absolute].value - start
    return claim.givens[increment].value if increment in claim.givens else Decimal(0)


def _runs(steps: list[Decimal], center: list[Decimal], radius: Decimal | None) -> bool:
    """Whether an arc can run from the start to the end, as far as a control looks."""
    (first, second), (center_first, center_second) = map(float, steps), map(float, center)
    chord = hypot(first, second)
    if radius is not None:
        return 0 < chord <= 2 * (abs(float(radius)) + RADIUS_DIFFERENCE)
    distance = hypot(center_first, center_second)
    return distance > 0 and abs(hypot(first - center_first, second - center_second) - distance) <= RADIUS_DIFFERENCE
