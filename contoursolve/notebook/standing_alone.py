"""A contour of a program as a program of its own."""

from collections.abc import Mapping
from decimal import Decimal
from math import dist

from contoursolve.api import solve
from contoursolve.controls import ControlName
from contoursolve.diagnosis import Answer
from contoursolve.diagnostics import checked
from contoursolve.output import start_text
from contoursolve.program import Rules, Units, configure, find_dialect
from contoursolve.reading import Control

_ABSOLUTE, _ON_THE_PATH = 90, 40

_EXACT = Decimal("1e-9")

_ROUNDED = 0.005
"""mm. What the rounding of a start point may move the end."""


@checked
def standing_alone(
    answer: Answer,
    *,
    control: ControlName | Control,
    units: Units = "mm",
    rules: Rules = "enforce",
    settings: Mapping[str, str] | None = None,
    is_exact: bool = False,
) -> str:
    """The blocks of a contour after what leads to its start point and puts its modal codes in force.

    Args:
        answer: one of `Result.answers`, whose start point is known.
        control: the control of the program; `units`, `rules` and `settings` as for `solve`.
        is_exact: whether the start point is not rounded to the least increment of the control.

    Returns:
        A text that `solve` takes with the same options, its last lines the blocks of the contour; empty if that would
        be another contour.

    >>> program = "G00 X40. Z0.\\nG111 X100. A180. K-30. B120. P5.\\nG111 A180. W-20."
    >>> print(standing_alone(solve(program).answers[0], control="yasnac-lx3"))
    G00 Z0 X40.
    G111 X100. A180. K-30. B120. P5.
    """
    if not answer.start.is_known or answer.start.is_relative:
        return ""
    dialect = control if isinstance(control, Control) else configure(find_dialect(control), settings)
    state, codes = answer.claim.before, dialect.modes.codes
    selected = [code.text for code in codes.values() if code.plane is not None and code.plane.code == state.plane.code]
    is_switched = _ABSOLUTE in codes and codes[_ABSOLUTE].effect.value == "absolute"
    is_beside = state.compensation != _ON_THE_PATH and state.compensation in codes
    compensated = [codes[state.compensation].text] if is_beside else []
    counting = [code.text for code in codes.values() if code.diameter is not None and code.diameter is state.diameter]
    modes = [*selected[:1], *(["G90"] if is_switched else []), *counting[:1], *compensated]
    motion = f"G{state.motion:02}" if state.motion else ""
    begin = " ".join((*modes, "G00", _exact_start(answer) if is_exact else start_text(answer)))
    forced = " ".join(filter(None, ("G91" if is_switched and state.is_incremental else "", motion)))
    text = "\n".join((begin, *([forced] if forced else []), *(block.text.strip() for block in answer.claim.blocks)))
    found = solve(text, control=control, units=units, rules=rules, settings=settings).answers
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
