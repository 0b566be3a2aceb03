"""A program with its contours written as plain G-code, or in plain words of its control."""

from collections.abc import Callable, Iterable, Iterator

from msgspec.structs import replace as replace_fields

from contoursolve.diagnosis import Depth
from contoursolve.execution import EventKind, ProgramEvent, ProgramKind
from contoursolve.gcode import Directive, Program
from contoursolve.geometry import Length
from contoursolve.postprocess.expander import OPENING, Expander
from contoursolve.postprocess.expansion_report import ExpansionOptions, Left, Summary
from contoursolve.postprocess.numbering import Numbers
from contoursolve.postprocess.post_processors import SAME, machine_of
from contoursolve.postprocess.restating import InGCodes, InOwnWords
from contoursolve.program import Batch, Line, Lines, Request, attach, each_block, machine_for, walk
from contoursolve.reading import Control

__all__ = ["OPENING", "expand_lines", "lines_of_facts", "opening_of"]


def expand_lines(
    lines: Lines,
    control: Control,
    asked: Request,
    options: ExpansionOptions,
    summary: Summary,
    *,
    numbers: Numbers | None = None,
    runs: ProgramKind = ProgramKind.IN_ORDER,
    expander: Callable[..., Expander] | None = None,
) -> Iterator[str | object]:
    """The lines of a program for a control (each with its end) with every contour replaced, and `OPENING` once.

    `numbers` are those of the whole program, where every line is to have one. A program that `runs` as it calls or
    computes is read as a whole; `expander` makes another pass than the usual one. Unless the control of the lines is
    certain, raises UnknownControlError if some block is for another one.
    """
    writing, kind = control.writing, Expander
    if writing is not None and options.post is SAME:
        kind = InOwnWords
    elif writing is not None:
        kind = InGCodes
    together = Batch(control, asked.policy, is_proven=False)
    blocks: Iterable[Line] = lines.blocks()
    machine = None
    if runs is ProgramKind.FOLLOWED:
        whole = tuple(each_block([*blocks], 0))
        program = Program("", "", whole, control.modes.syntax)
        blocks, machine = whole, machine_for(program, control, asked.around, asked.unit)

    def leave(event: ProgramEvent) -> None:
        is_end = event.kind is EventKind.UNDECIDED
        if is_end or kind is not InGCodes:  # which tells of each block that it cannot write
            told = f"{event.reason}, or leave out --inline" if is_end and options.is_inline else event.reason
            summary.left.append(Left((event.line,), told, (), {}, is_end))

    telling = leave if options.is_inline or kind is InGCodes else None
    asked = replace_fields(asked, control=control, depth=Depth.PATH)
    steps = walk(blocks, asked, together, machine, telling, is_called=runs is ProgramKind.FOR_CALLS)
    yield from (expander or kind)(control, options, summary, lines, numbers).expand(steps)


def lines_of_facts(program: Program, asked: Request) -> dict[int, tuple[Directive, ...]]:
    """The facts that were stated apart from a program, by the line of its only contour. Raises FactPlaceError."""
    attached, worded = attach(program, asked)
    return {block.line: worded for block in attached.blocks if worded and worded[0] in block.directives}


def opening_of(options: ExpansionOptions, control: Control, unit: Length, summary: Summary) -> str:
    """The line that the target needs before the first block; empty if it needs none, or nothing was replaced."""
    text = options.post.opening.get(machine_of(control), "") if summary.replaced else ""
    if summary.unit is not None and control.writing is not None:
        unit, text = summary.unit, options.post.opening.get(machine_of(control), control.writing.opening)
    if control.diameter is not None:
        counts = summary.counts_diameters or any(control.initial_state(unit).plane.diameters)
        text = text.replace("G8 ", "G7 ") if counts else text.replace("G7 ", "G8 ")
    return text.format(unit=options.post.code_of(unit)) + summary.line_end if text else ""
