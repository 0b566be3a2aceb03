"""A contour in the words of a control, or of all controls: `contoursolve.write`."""

from collections.abc import Mapping
from typing import overload

from contoursolve.controls import CONTROLS, ControlName
from contoursolve.diagnosis import Answer, status_text
from contoursolve.diagnostics import UserError, check_type
from contoursolve.postprocess import WrittenContours, write_contour
from contoursolve.program import Result, configure, find_control
from contoursolve.reading import Control
from contoursolve.sketches.known_part import solve_sketch
from contoursolve.sketches.sketch import ContourSketch


class UnfinishedError(UserError, ValueError):
    """A contour that has no path yet, so that it has no words; the message says what is open."""


@overload
def write(
    contour: Answer | Result | ContourSketch,
    control: ControlName | Control,
    *,
    settings: Mapping[str, str] | None = None,
) -> WrittenContours: ...


@overload
def write(
    contour: Answer | Result | ContourSketch, control: None = None, *, settings: Mapping[str, str] | None = None
) -> tuple[WrittenContours, ...]: ...


def write(
    contour: Answer | Result | ContourSketch,
    control: ControlName | Control | None = None,
    *,
    settings: Mapping[str, str] | None = None,
) -> WrittenContours | tuple[WrittenContours, ...]:
    """A contour in the words of a control: those first that have the drawing's own numbers, and are few.

    Args:
        contour: a sketch, a solved contour, or the result of a program with one contour.
        control: its name, such as `fanuc-lathe`, or its tables; without it, all of them are written for, each with its
            first candidate.
        settings: conventions of the controls by `control.name`, as for `solve`.

    Returns:
        Its `candidates`, the best first. Each was read back as the control reads it, without a finding, and is the same
        contour. `reason` says what the control has no words for, or why it cannot make the contour at all.

    Raises UnfinishedError if the contour is open or contradicts itself, ValueError if there are several,
    UnknownControlError and SettingError as `solve`.

    >>> from contoursolve import solve
    >>> shaft = solve("G00 X40. Z0.\\nG111 X100. A180. K-30. B120. P5.")
    >>> write(shaft, "fanuc-lathe").candidates[0].lines
    ('G01 Z-30. ,R5.', 'X100. ,A120.')
    """
    check_type("contour", contour, Answer | Result | ContourSketch)
    if control is None:
        answer = _answer_of(contour)
        return tuple(write_contour(answer, configure(CONTROLS[name], settings), most=1) for name in CONTROLS)
    target = control if isinstance(control, Control) else configure(find_control(control), settings)
    return write_contour(_answer_of(contour), target)


def _answer_of(contour: Answer | Result | ContourSketch) -> Answer:
    if isinstance(contour, ContourSketch):
        known = solve_sketch(contour)
        if known.answer is None or not known.is_finished:
            told = known.missing or "; ".join(each.message for each in known.findings)
            raise UnfinishedError(f"the sketch is not finished: {told}")
        return known.answer
    if isinstance(contour, Result):
        if len(contour.answers) != 1:
            raise ValueError(f"one contour is written; the program has {len(contour.answers)}")
        contour = contour.answers[0]
    if contour.contour is None:
        raise UnfinishedError(f"there is no contour to write: {status_text(contour.status)}; solve it first")
    return contour
