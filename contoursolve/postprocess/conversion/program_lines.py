"""The lines of a program, each with what it says and does: in the order of the text, or as they run."""

from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from contoursolve.comparison import ToolPath, Travel, Unfollowed
from contoursolve.diagnosis import Answer, join
from contoursolve.execution import EventKind, ProgramEvent
from contoursolve.gcode import Block, Program
from contoursolve.geometry import Length
from contoursolve.postprocess.conversion.block_meaning import Meaning, MeaningReader
from contoursolve.postprocess.conversion.program_words import kind_of_control
from contoursolve.program import Request, Result, Step, machine_for, walk
from contoursolve.reading import ContourBlock, Control, State, advance, blocks_of, leave


@dataclass(slots=True)
class ProgramLine:
    """One line of the program: what it says, the states around it, its path, and the contour that begins there."""

    block: Block
    meaning: Meaning
    before: State
    after: State
    answer: Answer | None
    """That of the contour to which it belongs."""
    part: ContourBlock | None
    """Its part of that, if it makes some of it."""
    travels: tuple[Travel, ...]
    lost: tuple[Unfollowed, ...]

    @property
    def line(self) -> int:
        """Its line in the main program: where that calls it, if another file has it."""
        return line_of(self.block)

    @property
    def first(self) -> int:
        """The line by which it is written more plainly, with the rest of its contour or of its file."""
        return self.line if self.answer is None else line_of(self.answer.claim.blocks[0])


def place_in(file: str, line: int) -> str:
    """A line of another file, as a reader names it."""
    return f"{file}, line {line}"


def line_of(block: Block) -> int:
    """The line in the main program of a block, or of the call that leads to it."""
    return block.callers[0].line if block.file and block.callers else block.line


def as_it_runs(program: Program, asked: Request) -> tuple[Sequence[Step] | None, tuple[str, ...]]:
    """A program as it runs, without calls, jumps and variables, and what is to be said of that; None for one that has
    none of these, or that cannot be followed to its end."""
    control, events = asked.control, list[ProgramEvent]()
    machine = machine_for(program, control, asked.around, asked.unit) if control is not None else None
    if machine is None or not machine.computes:
        return None, ()
    ran = [*walk((), asked, machine=machine, told=events.append)]
    lost = next((each for each in events if each.kind in (EventKind.UNDECIDED, EventKind.STOPPED)), None)
    if lost is not None:
        return None, (f"calls, jumps and variables are not written out: {lost.reason}",)
    files = sorted({block.file for step in ran for block in step.blocks} - {""})
    where = f" {join(files)} {'stand' if len(files) > 1 else 'stands'} where it is called." if files else ""
    told = [f"calls, jumps and variables are written out, with the values that they have{where and ':'}{where[:-1]}"]
    missing = {each.line: each.reason for each in events if each.kind is EventKind.LOST and each.called}
    told += [f"program line {line}: {reason}" for line, reason in missing.items()]
    rest = [each.line for each in program.blocks if each.says_something and each.line not in machine.ran]
    if rest:
        what = "lines" if len(rest) > 1 else "line"
        told.append(f"nothing runs program {what} {_named(rest)}: left out")
    return ran, tuple(told)


def _named(lines: Sequence[int]) -> str:
    """Lines as a reader names them, those in a row together."""
    rows = [[line for _, line in row] for _, row in groupby(enumerate(lines), lambda pair: pair[1] - pair[0])]
    return join([f"{row[0]} to {row[-1]}" if len(row) > 1 else f"{row[0]}" for row in rows])


def in_order(result: Result, source: Control, unit: Length) -> Iterator[Step]:
    """The contours and the other blocks of a program in the order of its lines."""
    contours = {answer.lines[0]: answer for answer in result.answers if not answer.claim.blocks[0].file}
    state, end = source.initial_state(unit), 0
    for block in result.start.blocks if result.start else ():
        state = advance(state, block, source.modes)
    for block in result.program.blocks:
        answer = contours.get(block.line)
        if answer is not None:
            end = answer.lines[-1]
            yield Step(tuple(result.program.blocks[block.line - 1 : end]), state, answer)
            state = _behind(answer, source)
        elif block.line > end:
            yield Step((block,), state)
            state = _after(state, block, source)


def _behind(answer: Answer, source: Control) -> State:
    finish = answer.contour.end if answer.contour else None
    return leave(answer.claim, finish, source.modes, "the contour is not solved")


def _after(state: State, block: Block, source: Control) -> State:
    return advance(state, block, source.modes) if block.words or block.macro or block.faults else state


def lines_of(steps: Iterable[Step], source: Control, old: ToolPath, *, is_run: bool) -> Iterator[ProgramLine]:
    """The lines of a program with what each of them says and does, in the order of the text or, with `is_run`, as they
    run."""
    reader, number = MeaningReader(source, kind_of_control(source)), 0
    travels, lost = dict[int, list[Travel]](), dict[int, list[Unfollowed]]()
    for each in old.steps:
        place = each.number if is_run else each.line
        if each.file and not is_run:
            continue
        if isinstance(each, Travel):
            travels.setdefault(place, []).append(each)
        else:
            lost.setdefault(place, []).append(each)
    for step in steps:
        state, answer = step.before, step.answer
        parts = deque(blocks_of(answer.claim, state, source.modes) if answer is not None else ())
        for block in step.blocks:
            part = parts.popleft() if parts and parts[0].block.line == block.line else None
            before, after = part.state if part is not None else state, state
            if answer is None:
                after = _after(state, block, source)
            elif block is step.blocks[-1]:
                after = _behind(answer, source)
            meaning = reader.read(block, before, after, is_contour=part is not None)
            place = number if is_run else block.line
            own = tuple(travels.get(place, ())), tuple(lost.get(place, ()))
            yield ProgramLine(block, meaning, before, after, answer if part is not None else None, part, *own)
            state = after if answer is None else state
            number += 1
