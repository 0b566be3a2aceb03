"""A compensation that leads the tool into the material of a turned contour, where its path leaves no doubt: one towards
the chuck that only widens is an outside, one that only narrows and that the tool leaves inwards is a bore."""

from collections.abc import Sequence
from math import cos, radians, sin

from contoursolve.diagnosis.examine import Answer, is_compensated_inward
from contoursolve.diagnosis.slip_kinds import plain_code
from contoursolve.diagnosis.window import Stretch, Window, moves_of
from contoursolve.gcode import Word
from contoursolve.tolerance import AGREEMENT

_LEFT = 41
_NOT_AT_ALL = 1e-6
"""The part of a direction that is none."""


def in_material(answer: Answer, window: Window) -> tuple[Word, str, str] | None:
    """The code with which the tool runs in the material, the one for the other side, and what the contour is; None
    where nothing is sure."""
    state, is_inward = answer.claim.before, is_compensated_inward(answer)
    if answer.contour is None or is_inward is None or state.doubts:
        return None
    turned = state.plane.diameters.index(True)
    is_bore = _is_bore([*moves_of(answer.contour)], turned)
    leaving = _leaving(window, state.plane.axes[turned], state.plane.axes[1 - turned])
    if is_bore is None or (is_bore and leaving is None) or (leaving is not None and (leaving > 0) is is_bore):
        return None
    word = _code(answer, window, f"G{state.compensation}")
    if is_inward is is_bore or word is None:
        return None
    return word, "G42" if state.compensation == _LEFT else "G41", "bore" if is_bore else "outside contour"


def _is_bore(moves: Sequence[Stretch], turned: int) -> bool | None:
    """True of a path towards the chuck that is the wall of a bore; None unless it only widens or only narrows."""
    across, along = ([], []) if moves else ([0.0], [0.0])
    for each in moves:
        if abs(each.sweep) >= 180 or min(each.start[turned], each.end[turned]) < -AGREEMENT:  # noqa: PLR2004 - degrees
            return None
        for heading in map(radians, each.headings):
            parts = cos(heading), sin(heading)
            across.append(parts[turned])
            along.append(parts[1 - turned])
    widens, narrows = min(across) >= -_NOT_AT_ALL, max(across) <= _NOT_AT_ALL
    is_towards_chuck = max(along) <= _NOT_AT_ALL and min(along) < -_NOT_AT_ALL
    return narrows if is_towards_chuck and widens is not narrows else None


def _leaving(window: Window, across: str, along: str) -> float | None:
    """By how much the tool leads away from the axis where it leaves the path behind a contour, 0 along the axis; None
    where that is not known."""
    for part in window.before.parts:
        if part.blocks and part.blocks[0].line > window.lines[-1]:
            ends = [(part.before.axes[axis].value, part.after.axes[axis].value) for axis in (across, along)]
            if any(None in each for each in ends):
                return None
            away, back = (float((end or 0) - (start or 0)) for start, end in ends)
            if away or back > 0:
                return away
    return None


def _code(answer: Answer, window: Window, code: str) -> Word | None:
    """The word that put a compensation into force, if no other contour stands behind it."""
    first = answer.claim.blocks[0].line
    for part in reversed([part for part in window.before.parts if part.blocks and part.blocks[0].line <= first]):
        if part.answer is not None and part.blocks[0].line < first:
            return None
        words = (word for block in part.blocks for word in block.words if block.line <= first)
        if found := next((word for word in words if plain_code(word.text) == code), None):
            return found
    return None
