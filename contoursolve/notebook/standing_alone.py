"""A contour of a program as a program of its own."""

from decimal import Decimal
from math import dist

from contoursolve.api import solve
from contoursolve.diagnosis import Answer
from contoursolve.diagnostics import checked

_ABSOLUTE, _ON_THE_PATH = 90, 40

_EXACT = Decimal("1e-9")

_ROUNDED = 0.005
"""mm. What the rounding of a start point may move the end."""


@checked
def standing_alone(answer: Answer, *, is_exact: bool = False) -> str:
    """The blocks of a contour after what leads to its start point and puts its modal codes in force; see
    `Answer.standing_alone`."""
    if not answer.start.is_known or answer.start.is_relative:
        return ""
    control, policy = answer.read_by.control, answer.read_by.policy
    state, codes = answer.claim.before, control.modes.codes
    selected = [code.text for code in codes.values() if code.plane is not None and code.plane.code == state.plane.code]
    is_switched = _ABSOLUTE in codes and codes[_ABSOLUTE].effect.value == "absolute"
    is_beside = state.compensation != _ON_THE_PATH and state.compensation in codes
    compensated = [codes[state.compensation].text] if is_beside else []
    counting = [code.text for code in codes.values() if code.diameter is not None and code.diameter is state.diameter]
    modes = [*selected[:1], *(["G90"] if is_switched else []), *counting[:1], *compensated]
    motion = f"G{state.motion:02}" if state.motion else ""
    begin = " ".join((*modes, "G00", _exact_start(answer) if is_exact else answer.start_text))
    forced = " ".join(filter(None, ("G91" if is_switched and state.is_incremental else "", motion)))
    text = "\n".join((begin, *([forced] if forced else []), *(block.text.strip() for block in answer.claim.blocks)))
    found = solve(text, control=control, units=answer.unit.value, rules=policy.value).answers
    return text if len(found) == 1 and _is_same(found[0], answer) else ""


def _is_same(one: Answer, other: Answer) -> bool:
    """Whether two contours end at the same place, to the rounding of the start point, or neither is one."""
    if one.status is not other.status or one.contour is None or other.contour is None:
        return one.status is other.status and one.contour is other.contour
    return dist(one.contour.end, other.contour.end) < _ROUNDED


def _exact_start(answer: Answer) -> str:
    """The words of the start point as they are, with all decimals that matter."""
    words = []
    for axis, value in zip(answer.plane.axes, answer.start.values, strict=True):
        counts_twice = answer.claim.lexicon.addresses[axis].is_diameter
        shown = (value or Decimal(0)) / answer.unit.in_mm * (2 if counts_twice else 1)
        words.append(f"{axis}{shown.quantize(_EXACT) + 0:f}")
    return " ".join(words)
