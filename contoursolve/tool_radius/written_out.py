"""A program without calls and finishing cycles: each pass, and the profile of G70, stands where it runs."""

from collections import deque
from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from contoursolve.comparison import FINISHING, ToolPath, Travel, follow, in_cycle
from contoursolve.execution import Call, CallKind, EventKind, Machine, MacroLanguage, ProgramEvent
from contoursolve.gcode import Block, comment_out, parse_block
from contoursolve.geometry import Length
from contoursolve.program import Run, lines_alone, machine_for
from contoursolve.reading import Control, State, TakenBlocks, Ways, advance
from contoursolve.tool_radius.tool import ToolError

_KEPT = frozenset("NFSTMDG")
"""Words beside G70 that hold for the finishing pass."""


def written_out(run: Run, control: Control, *, is_inline: bool) -> list[Block]:
    """The blocks of a program that has calls or cycles with profiles; none of a plain one. Raises ToolError."""
    program, language = run.frame.program, control.modes.language
    machine = machine_for(program, control, run.asked.around, run.asked.unit)
    if machine is None or language is None:
        return []
    if not is_inline and machine.computes:
        raise ToolError("a program that calls, jumps or computes has no one path: expand it inline")
    machine.finishes = True
    blocks, backs = list[Block](), iter(list[str]())
    if any(_calls_profile(block.text, language) for block in program.blocks):
        backs = _ways_back(follow(run.collect(), control, run.asked.unit, control.modes.axes, finishes=True))
    for each in _followed(machine, control, run.asked.unit):
        if isinstance(each, Block):
            blocks.append(each)
        elif isinstance(each, ProgramEvent) and each.reason in FINISHING:
            if each.kind is EventKind.ENTER:
                blocks += _beside_cycle(blocks.pop())
            elif each.kind is EventKind.LEAVE:
                blocks.append(parse_block(next(backs), each.line, control.modes.syntax))
    return blocks


def _followed(machine: Machine, control: Control, unit: Length) -> Iterator[Block | ProgramEvent]:
    """The lines of a program without calls, while somebody follows its modes: SAVE brings some of them back."""

    def take(held: Sequence[Block], index: int, state: State, _: bool) -> TakenBlocks:
        return TakenBlocks(1, advance(state, held[index], control.modes))

    ran = list[Block | ProgramEvent]()

    def kept() -> Iterator[Block | ProgramEvent]:
        for each in lines_alone(machine, _refuse):
            ran.append(each)
            yield each

    begin = control.initial_state(unit)
    begin = replace(begin, zero={}) if machine.is_for_calls else begin
    ways = Ways(lambda: begin, control.modes, take)
    deque(machine.follow(kept(), ways), 0)
    yield from ran


def _refuse(event: ProgramEvent) -> None:
    told = event.reason or "nobody knows what runs here"
    raise ToolError(told if told.startswith("program line") else f"program line {event.line}: {told}")


def _calls_profile(text: str, language: MacroLanguage) -> bool:
    """Whether a line is a cycle such as G71 or G70 with its profile."""
    said = language.read(text).statements if language.may_say(text) else ()
    return any(isinstance(each, Call) and each.kind is CallKind.PROFILE and each.cycle.startswith("G") for each in said)


def _beside_cycle(block: Block) -> Iterator[Block]:
    """G70 as a comment, and the words beside it, in the place of its block. Raises ToolError."""
    words = [word for word in block.words if word.address not in "PQ" and word.text.strip().upper() != FINISHING[0]]
    strange = next((word for word in words if word.address not in _KEPT), None)
    if strange is not None:
        told = f"{strange.text.strip()} beside {FINISHING[0]} cannot be written out; leave it out"
        raise ToolError(f"program line {block.line}: {told}")
    texts = [comment_out(block.text, block.syntax)[0], " ".join(word.text.strip() for word in words)]
    yield from (parse_block(text, block.line, block.syntax) for text in texts if text)


def _ways_back(path: ToolPath) -> Iterator[str]:
    """The rapid behind each finishing pass to where its cycle was called."""
    ends = {step.number: step for step in path.steps if isinstance(step, Travel)}
    for number, block in enumerate(path.blocks[:-1]):
        if in_cycle(path.blocks[number + 1], FINISHING) and not in_cycle(block, FINISHING):
            step, words = ends.get(number), list[str]()
            for axis, start, end, twice in (
                zip(path.axes, step.start, step.end, step.doubled, strict=True) if step else ()
            ):
                if end is None and start is not None:
                    told = f"where the tool is after {FINISHING[0]} is not known of this control"
                    raise ToolError(f"program line {block.line}: {told}")
                if step is not None and end is not None and end != start:
                    words.append(f" {axis}{end * (1 + twice) / float(step.unit.in_mm):.6f}".rstrip("0"))
            yield f"G00{''.join(words)}" if words else ""
