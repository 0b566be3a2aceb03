"""A contour in the words of a control, or of all controls: `contoursolve.write`, and what is printed of it."""

from collections.abc import Iterator, Mapping, Sequence

from contoursolve.controls import DIALECTS
from contoursolve.diagnosis import Answer, count, join
from contoursolve.diagnostics import UserError
from contoursolve.gcode import parse
from contoursolve.postprocess import Rest, Written, WrittenContour, WrittenWord, write_contour
from contoursolve.program import Result, Run, SolveOptions, configure, find_dialect
from contoursolve.reading import Dialect
from contoursolve.sketches.as_program import as_program
from contoursolve.sketches.sketch import ContourSketch


class UnfinishedError(UserError, ValueError):
    """A contour that has no path yet, so that it has no words; the message says what is open."""


def write(
    contour: Answer | Result | ContourSketch, control: str | Dialect, *, settings: Mapping[str, str] | None = None
) -> Written:
    """A contour in the words of a control: those first that rest on the drawing's own numbers, and are few.

    Args:
        contour: a sketch, a solved contour, or the result of a program with one contour.
        control: its name, such as `fanuc-lathe`, or its tables.
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
    target = control if isinstance(control, Dialect) else configure(find_dialect(control), settings)
    return write_contour(_answer_of(contour), target)


def write_for_all(
    contour: Answer | Result | ContourSketch, *, settings: Mapping[str, str] | None = None
) -> tuple[Written, ...]:
    """The same for every control: the first candidate of each, or the reason why there is none."""
    answer = _answer_of(contour)
    return tuple(write_contour(answer, configure(DIALECTS[name], settings), most=1) for name in DIALECTS)


def _answer_of(contour: Answer | Result | ContourSketch) -> Answer:
    if isinstance(contour, ContourSketch):
        found = examine_sketch(contour)
        if not found.answers or found.answers[0].contour is None:
            raise UnfinishedError(join([each.message for each in found.diagnostics]))
        return found.answers[0]
    if isinstance(contour, Result):
        if len(contour.answers) != 1:
            raise ValueError(f"one contour is written; the program has {len(contour.answers)}")
        contour = contour.answers[0]
    if contour.contour is None:
        raise UnfinishedError(f"the contour is {contour.status.value}: solve it first")
    return contour


def examine_sketch(sketch: ContourSketch) -> Result:
    """The result of a sketch's program."""
    program = as_program(sketch)
    asked = SolveOptions(start=program.start, units=sketch.unit, strict=True).request("sketch", sketch.control)
    return Run(parse(program.text, "sketch"), asked).collect()


def candidate_lines(candidate: WrittenContour) -> Iterator[str]:
    """The number of words of a candidate, its blocks, and on what its numbers rest."""
    _, words, _, *_ = candidate.cost
    yield f"{count(words, 'word')} in {count(len(candidate.blocks), 'block')}, {_ground(candidate)}"
    yield from (f"    {line}" for line in candidate.lines)
    for rest in (Rest.COMPUTED, Rest.ROUND):
        told = [_told(word) for word in candidate.words(rest)]
        if told:
            yield f"  {rest.value}: {', '.join(told)}"


def _ground(candidate: WrittenContour) -> str:
    """On what a candidate rests, in a few words."""
    computed = len(candidate.words(Rest.COMPUTED))
    if computed:
        return f"{computed} computed: at most {candidate.deviation:.1g} mm off"
    return "with round numbers" if candidate.words(Rest.ROUND) else "all numbers those of the drawing"


def _told(word: WrittenWord) -> str:
    return f"{word.text} (off by {word.off:.1g})" if word.off else word.text


def table_lines(several: Sequence[Written]) -> Iterator[str]:
    """The first candidate for each control, a line for each block."""
    width = max(len(each.control) for each in several)
    for each in several:
        said = each.candidates[0].lines if each.candidates else ()
        ground = f"{_ground(each.candidates[0])}" if each.candidates else ""
        yield f"{each.control:{width}}  {'; '.join(filter(None, (ground, each.reason)))}"
        yield from (f"{'':{width}}    {line}" for line in said)
