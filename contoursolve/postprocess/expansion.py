"""A program with its contours written as plain G-code, or in plain words of its control."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

from contoursolve.diagnosis.examine import Depth, Policy
from contoursolve.execution.events import ProgramEvent
from contoursolve.execution.subprograms import Surroundings
from contoursolve.gcode import Directive, Program
from contoursolve.geometry import Length
from contoursolve.postprocess.expander import OPENING, Expander
from contoursolve.postprocess.expansion_report import Left, Options, Summary
from contoursolve.postprocess.numbering import Numbers
from contoursolve.postprocess.post_processors import SAME, machine_of
from contoursolve.postprocess.restating import UNITS, InGCodes, InOwnWords
from contoursolve.program.batch import Batch
from contoursolve.program.calls import machine_for
from contoursolve.program.lines import Lines
from contoursolve.program.pipeline import attach, walk
from contoursolve.program.stream import Line, each_block
from contoursolve.reading.dialect import Dialect

__all__ = ["OPENING", "expand_lines", "lines_of_facts", "opening_of"]


def expand_lines(  # noqa: PLR0913 - takes what `rewrite` takes
    lines: Lines,
    dialect: Dialect,
    options: Options,
    summary: Summary,
    *,
    unit: Length = Length.MM,
    policy: Policy = Policy.ENFORCE,
    start: Program | None = None,
    numbers: Numbers | None = None,
    around: Surroundings | None = None,
    expander: Callable[..., Expander] | None = None,
) -> Iterator[str | object]:
    """The lines of a program (each with its end) with every contour replaced, and `OPENING` once.

    `numbers` are those of the whole program, where every line is to have one. `around` is for a program that calls or
    computes, which is read as a whole; `expander` makes another pass than the usual one. Unless the control of the
    lines is certain, raises UnknownControlError if some block is for another one.
    """
    writing, kind = dialect.writing, Expander
    if writing is not None and options.post is SAME:
        kind = InOwnWords
    elif writing is not None:
        kind, dialect = InGCodes, replace(dialect, find=writing.find)
    together = Batch(dialect, policy, is_proven=False)
    blocks: Iterable[Line] = lines.blocks()
    machine = None
    if around is not None:
        whole = tuple(each_block([*blocks], 0))
        blocks, machine = whole, machine_for(Program("", "", whole, dialect.modes.syntax), dialect, around)

    def leave(event: ProgramEvent) -> None:
        if kind is not InGCodes:  # which tells of each block that it cannot write
            told = event.reason or "which part of the branch runs is not known"
            summary.left.append(Left((event.line,), told, (), {}))

    telling = leave if options.is_inline or kind is InGCodes else None
    steps = walk(blocks, dialect, unit, policy, Depth.PATH, start, together, machine, telling)
    yield from (expander or kind)(dialect, options, summary, lines, numbers).expand(steps)


def lines_of_facts(
    program: Program, dialect: Dialect, unit: Length, start: Program | None, facts: Sequence[Directive]
) -> dict[int, tuple[Directive, ...]]:
    """Facts that were stated apart from a program, by the line of its only contour. Raises FactPlaceError."""
    if not facts:
        return {}
    attached, worded = attach(program, dialect, unit, start, facts)
    return {block.line: worded for block in attached.blocks if worded[0] in block.directives}


def opening_of(options: Options, dialect: Dialect, unit: Length, summary: Summary) -> str:
    """The line that the target needs before the first block; empty if it needs none, or nothing was replaced."""
    text = options.post.opening.get(machine_of(dialect), "") if summary.replaced else ""
    if summary.unit is not None and dialect.writing is not None:
        unit, text = summary.unit, options.post.opening.get(machine_of(dialect), dialect.writing.opening)
    if dialect.diameter is not None:
        counts = summary.counts_diameters or any(dialect.initial_state(unit).plane.diameters)
        text = text.replace("G8 ", "G7 ") if counts else text.replace("G7 ", "G8 ")
    return text.format(unit=UNITS[unit]) + summary.line_end if text else ""
