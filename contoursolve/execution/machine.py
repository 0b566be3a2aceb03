"""Runs a program as a control does: assignments, jumps, loops, calls and profiles, from block to block."""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from functools import partial
from itertools import chain
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.execution.evaluate import written
from contoursolve.execution.events import EventKind, Follower, ProgramEvent
from contoursolve.execution.macro_language import (
    ARGUMENT,
    SKIP_SWITCH,
    Assign,
    Call,
    CallKind,
    CodeLine,
    Definitions,
    Else,
    ElseIf,
    EndIf,
    EndLoop,
    For,
    Forget,
    FormalParameter,
    If,
    Jump,
    JumpWay,
    Known,
    Loop,
    MacroLanguage,
    MacroStatement,
    ModalCall,
    ProgramEnd,
    ReadAs,
    Refused,
    Return,
    Strange,
    Unknown,
    Vacant,
    VariableType,
    When,
    WordFormula,
)
from contoursolve.execution.subprograms import Absent, Library, LineRange, ProgramFile, Surroundings
from contoursolve.execution.variables import VariableLevel, Variables, as_type
from contoursolve.gcode import (
    Block,
    Caller,
    Program,
    Substitution,
    Syntax,
    late_pattern,
    parse_block,
    telling,
)
from contoursolve.numeric import Apply, Indexed, Term, Variable

MOST_BLOCKS = 5_000
"""Blocks that run again, or in another file, after which a program is not followed any further."""


class Limit(Struct, frozen=True):
    """Largest number of blocks that run again, or in another file, and the name of its setting."""

    blocks: int = MOST_BLOCKS
    setting: str = "most-blocks"

    @property
    def control(self) -> str:
        """The control whose setting it is, as a message names it."""
        return self.setting.rpartition(".")[0] or "CONTROL"


DEEPEST = 50
"""Calls in one another; controls admit ten at most."""


class ProgramKind(Enum):
    """The ways in which a program runs."""

    IN_ORDER = "line by line"
    FOR_CALLS = "line by line, where another program calls it"
    FOLLOWED = "as it calls, jumps and computes"


def kind_of(lines: Iterable[str], language: MacroLanguage | None) -> ProgramKind:
    """The way in which a program runs."""
    ends = set[type[MacroStatement]]()
    for each in _said(lines, language):
        if each.words or each.is_part or any(_has_to_run(one, each) for one in each.statements):
            return ProgramKind.FOLLOWED
        ends.update(map(type, each.statements))
    return ProgramKind.FOR_CALLS if _is_returning(ends) else ProgramKind.IN_ORDER


def _said(lines: Iterable[str], language: MacroLanguage | None) -> Iterator[CodeLine]:
    """Those of some lines that may say more than words with numbers."""
    return (language.read(line.rstrip("\r\n")) for line in lines if language.may_say(line)) if language else iter(())


def says_end(lines: Iterable[str], language: MacroLanguage | None) -> bool:
    """Whether any of some lines ends a program or a subprogram."""
    return any(isinstance(one, Return | ProgramEnd) for each in _said(lines, language) for one in each.statements)


def needs_running(lines: Iterable[str], language: MacroLanguage | None) -> bool:
    """Whether a program calls, jumps or computes, so that it has to be followed as it runs."""
    return kind_of(lines, language) is ProgramKind.FOLLOWED


def _is_returning(said: Collection[type[MacroStatement]]) -> bool:
    """Whether a program that says this returns, and nothing in it ends the run, so that others call it."""
    return Return in said and ProgramEnd not in said


def _has_to_run(statement: MacroStatement, line: CodeLine) -> bool:
    """Whether a statement is more than the end of what is written, which is the end wherever it runs."""
    return not isinstance(statement, Return | ProgramEnd) or line.rest.lstrip().startswith("/")


def _cuts(statement: MacroStatement) -> bool:
    """Whether a statement is the call of a profile by a cycle, such as G71."""
    return isinstance(statement, Call) and statement.kind is CallKind.PROFILE and statement.cycle.startswith("G")


def machine_of(
    program: Program,
    language: MacroLanguage | None,
    syntax: Syntax,
    around: Surroundings,
    limit: Limit | None = None,
) -> "Machine | None":
    """The machine that runs a program; None for one that neither calls, jumps nor computes."""
    if language is None or not needs_running((block.text for block in telling(program.blocks)), language):
        return None
    library = Library(language, syntax, around.folders, (limit or Limit()).control)
    return Machine(program, language, library, around.values, limit)


class _Loop(Struct):
    """A loop that is open: its lines, the last value and the step of what it counts, why nobody knows how often it
    runs, if that is so, and which pass this is."""

    lines: LineRange
    last: float | None = None
    step: float = 1.0
    reason: str = ""
    passes: int = 1


class _Branch(Struct):
    """An If that is open: its lines, whether one of its parts has run, and whether nobody knows which."""

    lines: LineRange
    has_run: bool
    is_undecided: bool = False


class _State(Struct):
    """The state at a place: the variables of each level of calls, and what whoever follows knows beside. `reason`
    decides between the ways that come there."""

    levels: list[VariableLevel]
    beside: Any
    reason: str = ""


class _Head(Struct):
    """A line to which a jump or a loop may come back: what was known and how much was found when it was reached, how
    often it was run again, the last line to which a way has left since, and whether ways have come into it that were
    kept before."""

    number: int
    known: _State
    found: int
    passes: int = 0
    farthest: float = -1
    is_aside: bool = False


class _Taken(Struct, frozen=True):
    """A jump of which nobody knows whether it is taken, on the way on which it is."""

    target: int
    reason: str


Place = tuple[tuple[float, float], ...]
"""Progress of a way through a program: of two ways, the one that has come less far has to run first."""


_Begun = tuple[str, int, int, tuple[frozenset[tuple[str, Known]], ...]]


class _Frame(Struct):
    """A program, a subprogram or a section that runs: the indices of its next, first and last line."""

    source: ProgramFile
    at: int
    first: int
    last: int
    call: Call | None = None
    callers: tuple[Caller, ...] = ()
    left: int = 1
    """Number of runs left, this one included."""
    depth: int = 1
    """The number of levels of variables that go on where it ends."""
    own: VariableLevel | None = None
    """The level of variables with which each of its runs begins, if it has one of its own."""
    begun: _Begun | None = None
    """The lines that a call runs, and what all variables held then."""
    loops: list[_Loop] = field(default_factory=list)
    branches: list[_Branch] = field(default_factory=list)
    here: int = 0
    """The index of the line that runs."""
    rest: list[MacroStatement | _Taken] = field(default_factory=list)
    """Statements of that line that wait for a call on it to end."""
    heads: dict[int, _Head] = field(default_factory=dict)
    jumped: str = ""
    """The reason why the target of a jump is not known: any block with a number or a label may follow. Empty without
    one."""
    is_again: bool = False
    """Whether its next line runs again, nobody knows how often."""
    entry: Any = None
    """The state of whoever follows where it was called, if all is as it was there when it ends, or if it saves the
    modes."""
    saves: bool = False
    """Whether the modes at the call are in force again where it ends."""
    doubt: str = ""
    """The reason why nobody knows how often it runs."""
    first_ran: int = 0
    """The number of blocks that had run before it, if what it changes has to be written back."""

    def go_to(self, index: int) -> None:
        """Go on at a line: what the line that runs still says is left out."""
        self.at, self.rest = index, []

    def copy(self) -> "_Frame":
        """Another one that runs on by itself."""
        return replace(
            self,
            loops=[replace(each) for each in self.loops],
            branches=[replace(each) for each in self.branches],
            rest=[*self.rest],
            heads={at: replace(each) for at, each in self.heads.items()},
        )

    def meet(self, other: "_Frame") -> None:
        """Take in another one that has come to the same place."""
        if len(other.branches) < len(self.branches):
            self.branches = other.branches
        for at, head in self.heads.items():
            same = other.heads.get(at)
            head.farthest = max(head.farthest, -1 if same is None else same.farthest)
            head.is_aside = head.is_aside or (same is not None and same.is_aside)

    @property
    def place(self) -> Place:
        """Its progress; the rest of a line comes before the next one."""
        loops = ((each.lines.first, each.passes) for each in self.loops if each.lines.has(self.at))
        has_run = not self.branches or self.branches[-1].has_run
        # CASE names several blocks: ways to two of them do not meet on its line.
        taken = ((float(each.target), 0.0) for each in self.rest[:1] if isinstance(each, _Taken))
        return ((-self.left, self.first), *loops, (self.at - 0.5 * bool(self.rest), has_run), *taken)


class _Way(Struct):
    """A way through the program that waits: what runs there, what is known, and how many were kept before."""

    frames: list[_Frame]
    known: _State
    number: int


_BEHIND = ((float("inf"), 0.0),)
"""Behind all that a call runs."""

MOST_BEYOND = 200
"""Blocks that are looked at to see how a contour ends in lines that have run."""

MOST_PASSES = 3
"""Largest number of passes through lines that run nobody knows how often, until nothing new follows."""


def _place(frames: Iterable[_Frame]) -> Place:
    """The progress of a way."""
    return tuple(each for frame in frames for each in frame.place) + _BEHIND


class _RefusedError(Exception):
    """The control stops at a block; the message says why."""


class _UndecidedError(Exception):
    """Nobody knows what runs on from a line, so that nothing can be written out; the message says why."""

    def __init__(self, line: int, told: str) -> None:
        super().__init__(told)
        self.line = line


class Machine:
    """One run of a program. `given` are values of variables that are stated apart from it."""

    def __init__(
        self,
        program: Program,
        language: MacroLanguage,
        library: Library,
        given: Mapping[str, float] | None = None,
        limit: Limit | None = None,
    ) -> None:
        self.language, self.library = language, library
        self.main = ProgramFile(program, language, is_other=False)
        self.variables = Variables(language, given or {})
        self._frames: list[_Frame] = []
        self._visited: set[int] = set()
        self._steps, self._limit = 0, limit or Limit()
        self._waiting: dict[Place, _Way] = {}
        """The ways that wait."""
        self._kept, self._decided = 0, ""
        """How many ways and heads have been kept, and what decided last between the way that runs and others."""
        self.found: list[Any] = []
        """What has been found by whoever follows."""
        self._follower = Follower()
        self._beside: Any = None
        """What he knows here."""
        self._named: set[tuple[str, int]] = set()
        """By file and index: lines to which jumps lead that stay as they are written."""
        self._passed: set[int] = set()
        """What was known at each jump back."""
        self._last: object = None
        """What ran the last block: contours do not go on beyond a call."""
        self._untaken: dict[int, tuple[int, list[VariableLevel]]] = {}
        """By the index of a line of the main file to which a decision did not lead: the mark and the values there."""
        self._marks, self._here, self._is_marking = 0, 0, False
        """How many marks there are, the one under which it is kept what is known here, and whether the next block has
        it."""
        self.passed_over: set[int] = set()
        """The lines of the main file that do not run, because of what was decided."""
        self.finishes = False
        """Whether a program without calls has the profile where G70 cuts it."""
        self._is_alone, self._is_reached, self._is_passing_over = False, True, False
        """Whether calls are written out, whether what runs is reached from the main program, and whether what runs is
        passed over there."""
        self._told: dict[str, EventKind] = {}
        """The fault of the line that runs, and may run on."""
        self._has_to_decide = False
        """Whether it ends where nobody knows what is decided."""
        self._ran: list[Block] = []
        """All blocks that have run, where what SAVE brings back has to be written."""

    @property
    def ran(self) -> frozenset[int]:
        """The lines of the main file that have run."""
        return frozenset(self.main.blocks[index].line for index in self._visited)

    @property
    def computes(self) -> bool:
        """Whether the main file calls, jumps or computes beside the profiles of cycles that cut."""
        said = (self.main.code(index) for index in range(len(self.main)))
        return any(
            each.words or each.is_part or any(_has_to_run(one, each) and not _cuts(one) for one in each.statements)
            for each in said
        )

    def follow(self, ran: Iterable[Block | ProgramEvent], follower: Follower) -> Iterator[Any]:
        """Let somebody follow what runs; all that he finds, one by one, and None for a block that waits to be read."""
        self._follower, self._beside, blocks = follower, follower.begin(None), list[Block]()
        for each in chain(ran, (None,)):
            if isinstance(each, Block):
                blocks.append(each)
                yield None
                continue
            for found in self._read(blocks, each):
                self.found.append(found)
                yield found
            blocks = []
            if each is not None and each.kind.loses:
                modes = each.kind is not EventKind.STOPPED and not each.keeps_modes
                self._beside = follower.lose(self._beside, each.reason, each.line, modes=modes)
            elif each is not None and each.kind is EventKind.FRESH:
                self._beside = follower.begin(each)

    def _read(self, blocks: Sequence[Block], event: ProgramEvent | None) -> Iterator[Any]:
        self._beside = yield from self._follower.read(self._beside, blocks, event)

    def run_alone(self) -> Iterator[Block | ProgramEvent]:
        """The blocks of the main program and of what it calls, as one program without calls and jumps. What is set to a
        value that is not known stays; the profile of a cycle that is written elsewhere does not run. It ends at a
        decision of which nobody knows how it is taken."""
        self._is_alone = self._has_to_decide = True
        try:
            yield from self._with_own_numbers(self._run_from(self._begin_main()))
        except _UndecidedError as error:
            yield ProgramEvent(EventKind.UNDECIDED, error.line, str(error))
            return
        last = next((at for at in reversed(range(len(self.main))) if self.main.blocks[at].text.strip()), None)
        if last is not None and last not in self._visited and _ENDS_FILE.fullmatch(self.main.blocks[last].text):
            yield self.main.blocks[last]

    def _with_own_numbers(self, ran: Iterable[Block | ProgramEvent]) -> Iterator[Block | ProgramEvent]:
        """The blocks that run, no block number twice. A block of a call, and one that runs again, loses its number. It
        is told where the profile of a cycle would lose its number."""
        first = self._begin()
        last, taken = self.main.section_end(first), set[str]()

        def is_taken(number: str, block: Block) -> bool:
            return number in taken or (_is_called(block) and self.main.number(number, first, last) is not None)

        for each in ran:
            if isinstance(each, ProgramEvent):
                yield each
                continue
            for call in self.language.read(each.text).statements if _is_called(each) else ():
                if isinstance(call, Call) and call.kind is CallKind.PROFILE and call.cycle in _CUTTING_PROFILES:
                    names = (one for one in (call.target, call.last) if isinstance(one, str) and is_taken(one, each))
                    for name in names:
                        told = f"{call.cycle} names N{name}, which stands twice in a program without calls"
                        yield ProgramEvent(EventKind.BARRIER, each.line, told)
            number = _numbered(each)
            if number and is_taken(number, each):
                yield _without_number(each)
                continue
            taken.add(number)
            yield each

    def run_all_alone(self) -> Iterator[Block | ProgramEvent]:
        """The same, and behind it what nothing calls."""
        self._is_alone = True
        yield from self.run()

    def run(self) -> Iterator[Block | ProgramEvent]:
        """Every block in the order in which it runs, with numbers for its variables; behind the end of the program,
        what nothing calls."""
        yield from self._run_from(self._begin_main())
        self._is_reached = False
        for index in range(len(self.main)):
            if index not in self._visited and self._says_something(index):
                if self._steps >= self._limit.blocks:
                    yield from self._unfollowed(index)
                    return
                yield self._run_what_is_left(index)
                yield from self._run_from(index)

    def _run_what_is_left(self, index: int) -> ProgramEvent:
        """Begin at a line that has not run: with what was known where a decision did not lead to it, or with nothing
        but the variables that were set once in all."""
        code, line = self.main.code(index), self.main.blocks[index].line
        told = f"program {code.begins}" if code.begins is not None else f"program line {line}"
        is_begun = code.begins is not None or bool(code.labels) or self._follows_end(index)
        self._is_passing_over = index in self._untaken or not is_begun
        why = f"nothing in this file calls {told}" if is_begun else f"{told} does not run here"
        mark, levels = self._untaken.get(index, (0, [self.variables.set_once()]))
        self.variables.levels = levels
        if code.begins is not None and self.language.declares:
            formal = self.main.head(index, self.main.section_end(index)).parameters
            unknown = {each.name: Unknown(f"{each.name}{ARGUMENT}{code.begins}") for each in formal}
            types = {each.name: each.of_type for each in formal}
            levels.append(VariableLevel(code.begins, dict(unknown) | self.variables.given_of(unknown), types))
        self._here, self._is_marking = mark, False
        return ProgramEvent(EventKind.FRESH, line, why, mark)

    def _keep(self, frame: _Frame, first: int) -> None:
        """Keep what is known now for a line to which a decision does not lead."""
        if frame.source is not self.main:
            return
        first = next((at for at in range(first, len(self.main)) if self._says_something(at)), first)
        if first not in self._untaken:
            self._untaken[first] = self._mark(), self.variables.copy()

    def _mark(self) -> int:
        """The number under which it is kept what is known here."""
        if not self._here:
            self._marks += 1
            self._here, self._is_marking = self._marks, True
        return self._here

    def _go_on(self) -> None:
        """Whatever was known, it may be something else now."""
        self._here, self._is_marking = 0, False

    def _follows_end(self, index: int) -> bool:
        """Whether a line stands behind the end of a program, so that only a call leads there."""
        before = next((at for at in range(index - 1, -1, -1) if self._says_something(at)), None)
        said = self.main.code(before).statements if before is not None else ()
        return any(isinstance(each, ProgramEnd | Return) for each in said)

    def _unfollowed(self, first: int) -> Iterator[Block | ProgramEvent]:
        """The blocks from a line on that have not run, as they are written."""
        for index in range(first, len(self.main)):
            if index not in self._visited:
                block = self.main.blocks[index]
                if index == first or index - 1 in self._visited:
                    yield ProgramEvent(EventKind.FRESH, block.line, "the program is not followed as far as this")
                yield block

    def _begin_main(self) -> int:
        """The index of the line with which the main program begins; the arguments of one that others call are not
        known."""
        begin = self._begin()
        heads = (self.main.code(at) for at in range(begin, len(self.main)) if self._says_something(at))
        name = next((each.begins for each in heads if each.begins is not None), "")
        for each in self.main.head(begin, self.main.section_end(begin)).parameters if len(self.main) else ():
            self.variables.levels[0].types[each.name] = each.of_type
            self.variables.set(each.name, Unknown(f"{each.name}{ARGUMENT}{name}"))
        self.variables.is_called = self._is_for_calls(begin)
        return begin

    @property
    def is_for_calls(self) -> bool:
        """Whether others call the main program, so that it begins with what is in force there."""
        return self._is_for_calls(self._begin())

    def _is_for_calls(self, begin: int) -> bool:
        """Whether the main program is one that others call: it returns, and nothing in it ends the run."""
        last = self.main.section_end(begin)
        return _is_returning({type(each) for at in range(begin, last + 1) for each in self.main.code(at).statements})

    def _begin(self) -> int:
        """The index of the line with which the main program begins: no subprogram by its head, and none calls it."""
        sections = self.main.sections
        first = min(sections.values(), default=0)
        if len(sections) < 2 or any(map(self._says_something, range(first))):  # noqa: PLR2004 - one calls another
            return 0
        called = self._called()
        return min({*sections.values()} - called, key=lambda at: (self.main.code(at).is_part, at), default=first)

    def _called(self) -> set[int]:
        """The indices of the lines with which programs of the main file begin that others call."""
        sections = self.main.sections
        return {sections[name] for name in self.main.called() if name in sections}

    def _run_from(self, index: int) -> Iterator[Block | ProgramEvent]:
        """The blocks that run from a line of the main file on, to its end or to blocks that have run."""
        head = next((at for at in range(index, len(self.main)) if self._says_something(at)), index)
        last = self.main.section_end(head)
        if head < min(self.main.sections.values(), default=0) and last + 1 not in self._called():
            # What stands before the name of a program belongs to it.
            last = self.main.section_end(last + 1)
        self._frames, self._waiting, self._last = [_Frame(self.main, index, index, last)], {}, None
        while self._frames or self._waiting:
            yield from self._meet()
            frame = self._frames[-1]
            is_known = not (self._is_reached or frame.callers) and frame.at in self._visited
            if is_known and not (frame.rest or self._waiting or self._is_alone) and frame.at <= frame.last:
                yield from self._look_beyond(frame)
                return
            if not frame.rest and (frame.at > frame.last or is_known):
                yield from self._leave(frame)
                continue
            if self._steps >= self._limit.blocks:
                most = f"more than {self._limit.blocks:,} blocks run again"
                told = f"{most}: the program may never end; --setting {self._limit.setting}=NUMBER follows more of them"
                yield ProgramEvent(EventKind.STOPPED, frame.source.blocks[frame.at].line, told)
                return
            # A long program is no endless one.
            self._steps += not frame.rest and (frame.source is not self.main or frame.at in self._visited)
            try:
                for each in self._step(frame):
                    if isinstance(each, ProgramEvent) and each.kind is not EventKind.BARRIER:
                        self._go_on()
                    elif self._has_to_decide and isinstance(each, Block):
                        self._ran.append(each)
                    yield from self._tell(frame)
                    yield each
                yield from self._tell(frame)
            except _RefusedError as error:
                # The control stops here; what follows is examined as if it went on.
                frame.rest = []
                if self._is_alone:
                    yield self._as_written(frame, frame.here)
                yield ProgramEvent(EventKind.STOPPED, self._line(frame, frame.here), str(error))

    def _tell(self, frame: _Frame) -> Iterator[ProgramEvent]:
        """The fault of the line that runs, and may run on."""
        told = self._told | dict.fromkeys(self.variables.undefined, EventKind.REFUSED)
        self._told, self.variables.undefined = {}, []
        if not self._is_alone:
            yield from (ProgramEvent(kind, self._line(frame, frame.here), reason) for reason, kind in told.items())

    def _look_beyond(self, frame: _Frame) -> Iterator[Block | ProgramEvent]:
        """The next blocks behind lines that had not run, although they have run themselves: a contour may go on
        there."""
        count, assigned = 0, len(self.variables.assigned)
        yield ProgramEvent(EventKind.BEYOND, frame.source.blocks[frame.at].line)
        while self._frames == [frame] and frame.at <= frame.last and count < MOST_BEYOND:
            try:
                ran = [*self._step(frame)]
            except _RefusedError:
                break
            for each in ran:
                if isinstance(each, ProgramEvent) and each.kind is not EventKind.HEAD:
                    count = MOST_BEYOND
                elif isinstance(each, Block) and count < MOST_BEYOND:
                    yield each
                    count += 1
        self._frames, self._waiting = [], {}
        del self.variables.assigned[assigned:]

    def _runs_in(self) -> object:
        """The call that runs; repeated lines belong to the call that repeats them."""
        frame = next(each for each in reversed(self._frames) if not _is_loop(each.call))
        return frame.source, frame.first, frame.callers

    def _says_something(self, index: int) -> bool:
        """Whether a line of the main file has more than its number, comments and blanks."""
        block, code = self.main.blocks[index], self.main.code(index)
        has_words = any(word.address != "N" for word in block.words)
        return has_words or bool(code.statements or code.labels) or code.begins is not None or block.macro is not None

    # One line

    def _step(self, frame: _Frame) -> Iterator[Block | ProgramEvent]:
        """Run the next line of a frame, or the rest of the line that waited for what it called."""
        if not frame.rest:
            yield from self._begin_line(frame)
        while frame.rest and self._frames and self._frames[-1] is frame:
            yield from self._do(frame, frame.here, frame.rest.pop(0))

    def _begin_line(self, frame: _Frame) -> Iterator[Block | ProgramEvent]:
        """Run the words of the next line of a frame; what it says besides waits in `rest`."""
        index = frame.here = frame.at
        if index in frame.source.heads and not frame.is_again:
            yield from self._begin_head(frame, index)
        frame.is_again = False
        is_new = frame.source is self.main and index not in self._visited
        if frame.source is self.main:
            if self._is_passing_over and is_new:
                self.passed_over.add(frame.source.blocks[index].line)
            self._visited.add(index)
        block, code = frame.source.blocks[index], frame.source.code(index)
        if frame.jumped and (code.labels or code.number):
            self.variables.lose_all(frame.jumped)
            yield ProgramEvent(EventKind.LOST, self._line(frame, index), frame.jumped)
        self.variables.line, frame.at = self._line(frame, index), index + 1
        if self.language.declares and self._has_strange_words(block, code):
            code = replace(code, rest=block.text, statements=())
        code, moving = self._assign_first(block, self._if_not_skipped(code) if block.is_skippable else code)
        when = next((each for each in moving if isinstance(each, When) and each.has_words), None)
        if when is not None:
            yield from self._run_words_if(when, frame, code, is_new=is_new)
            return
        frame.rest, told = [*_ends_last(moving)], _in_doubt(block, moving)
        if told and self._is_alone:
            yield block
            frame.rest = [each for each in frame.rest if isinstance(each, ProgramEnd | Return)]
        else:
            yield from self._run_words(frame, block, code)
        if told:
            yield ProgramEvent(EventKind.STOPPED, self._line(frame, index), told)

    def _run_words_if(
        self, when: When, frame: _Frame, code: CodeLine, *, is_new: bool
    ) -> Iterator[Block | ProgramEvent]:
        """Run the words of a line if a condition holds; where that is not known, what follows does not rest on them."""
        index, block = frame.here, frame.source.blocks[frame.here]
        truth, line = self.variables.truth(when.condition), self._line(frame, index)
        if isinstance(truth, Unknown) and self._is_alone:
            yield block
            yield ProgramEvent(EventKind.LOST, line, truth.reason)
        elif isinstance(truth, Unknown):
            yield from self._part(frame, truth.reason, lambda other: other.rest.clear())
            frame.rest = [*when.then]
            yield from self._run_words(frame, block, code)
        elif truth or (index in self._untaken and not self._is_reached):
            frame.rest = [when] if truth else []
            yield from self._run_words(frame, block, code)
        elif is_new:
            self._keep(frame, index)
            self._visited.discard(index)

    def _if_not_skipped(self, code: CodeLine) -> CodeLine:
        """The statements of a line that begins with /, in doubt: nobody knows whether it sets, jumps, calls or ends
        anything."""
        said = code.statements
        if any(isinstance(each, When) and each.has_words for each in said):
            return code
        jumps = (each.condition for each in said if isinstance(each, Jump | When) and each.condition is not None)
        if any(self.variables.truth(each) is False for each in jumps):
            return code
        doubtful = tuple(each for each in said if isinstance(each, _IN_DOUBT))
        kept = tuple(each for each in said if not isinstance(each, _IN_DOUBT))
        return replace(code, statements=(When(SKIP_SWITCH, doubtful), *kept)) if doubtful else code

    def _assign_first(self, block: Block, code: CodeLine) -> tuple[CodeLine, list[MacroStatement]]:
        """Carry out the assignments with which a line begins; what else it says, and the statements behind them."""
        rest = iter(code.statements)
        for statement in rest:
            if isinstance(statement, ReadAs):
                self._told[statement.told] = EventKind.READ_AS
                continue
            if not isinstance(statement, Assign | Forget):
                return code, [statement, *rest]
            is_known = self.variables.assign(statement)
            name = self.variables.name(statement.variable)
            if self.language.may_move(name if isinstance(name, str) else ""):
                # Whoever reads the blocks has to see it.
                is_one = len(code.statements) == 1 and isinstance(name, str)
                code = replace(code, rest=self._set_anew(name, block) if is_one else block.text)
            elif not is_known and self._is_alone:
                code = replace(code, rest=block.text)
        return code, []

    def _set_anew(self, name: str | Unknown, block: Block) -> str:
        """The line that sets a variable to what it holds now, with a number for the name; as it is written, if that is
        not known."""
        value = self.variables.value(Variable(name)) if isinstance(name, str) else None
        head = block.text[: len(block.text) - len(block.text.lstrip())]
        return f"{head}{name}={written(value)}" if isinstance(value, float) else block.text

    def _run_words(self, frame: _Frame, block: Block, code: CodeLine) -> Iterator[Block | ProgramEvent]:
        """Run the words of a line."""
        if any(_returns(each, is_called=bool(frame.callers)) for each in frame.rest):
            code = replace(code, rest=_without_return(code.rest, block))
        if code.statements and not (self._is_alone or code.rest.strip()):
            return
        ran = self._block(frame, block, code)
        if not self._is_passed_over(frame, code, ran):
            here = self._runs_in()
            if self._last is not None and self._last != here:
                yield ProgramEvent(EventKind.BARRIER, block.line)
            self._last = here
            yield replace(ran, mark=self._here) if self._is_marking else ran
            self._go_on()
            called = self.variables.values.get(_CALLED_BEHIND)
            if called is not None and any(word.address.rstrip("0123456789") in _AXES for word in ran.words):
                reason = called.reason if isinstance(called, Unknown) else str(called)
                keeps = _LOSES_MODES not in self.variables.values
                yield ProgramEvent(EventKind.CALLED, self._line(frame, frame.here), reason, keeps_modes=keeps)

    def _has_strange_words(self, block: Block, code: CodeLine) -> bool:
        """Whether what looks like assignments stands among words, to variables that nobody has declared: `G1 X5 AGN=30`
        has a word that is mistyped."""
        variables = [each.variable for each in code.statements if isinstance(each, Assign | Forget)]
        names = [each.name for each in variables if isinstance(each, Variable)]
        is_strange = any(_is_word(name) and not self.variables.is_set(name) for name in names)
        rest = parse_block(code.rest, block.line, block.syntax) if is_strange else block
        return is_strange and any(word.address != "N" for word in rest.words)

    def _is_passed_over(self, frame: _Frame, code: CodeLine, ran: Block) -> bool:
        """Whether a line has nothing to run: it is the head of a program that is called, or written out elsewhere."""
        if code.begins is not None and (frame.callers or not (self._is_reached or self._is_alone)):
            return True
        if self._is_alone and frame.callers and _ENDS_FILE.fullmatch(ran.text):
            # The end of a file that is called ends no program.
            return True
        is_bare = all(word.address == "N" for word in ran.words) and ran.macro is None
        if self._is_alone and is_bare and (code.statements or code.labels):
            is_named = (frame.source.name, frame.here) in self._named
            return not is_named and not ran.syntax.comment.search(ran.text)
        return False

    def _unclear(
        self, frame: _Frame, index: int, reason: str, called: str = "", unread: str = "", *, keeps_modes: bool = False
    ) -> Iterator[Block | ProgramEvent]:
        """A line that does what is not known; without calls, it stays as it is written."""
        is_written = self._says_words(frame, index) and frame.source.code(index).rest == frame.source.blocks[index].text
        if self._is_alone and not is_written:
            yield self._as_written(frame, index)
        line = self._line(frame, index)
        yield ProgramEvent(EventKind.LOST, line, reason, called=called, unread=unread, keeps_modes=keeps_modes)

    def _block(self, frame: _Frame, block: Block, code: CodeLine) -> Block:
        """A block with numbers in the place of variables."""
        is_label = self._is_alone and bool(code.labels)
        if is_label and (frame.source.name, frame.here) in self._named:
            return block
        if not (frame.callers or frame.source.name or code.statements or code.words or is_label):
            return block
        text, changes = code.rest, list[Substitution]()
        for word in reversed(code.words):
            value, typed = self.variables.value(_unsigned(word.value)), block.text[word.begin : word.end]
            if isinstance(value, Vacant):
                text = self._without_word(word, text)
                changes.append(
                    Substitution(word.begin, word.end, typed, "", "it is empty, so that this word is left out")
                )
                continue
            value = self.variables.value(word.value)
            if isinstance(value, float):
                number = written(value)
                text = word.put(number, text)
                changes.append(Substitution(word.begin, word.end, typed, number))
            else:
                reason = value.reason if isinstance(value, Unknown) else f"{value!r} is no number"
                changes.append(Substitution(word.begin, word.end, typed, "", reason))
        if self._is_alone and not block.text[:1].isspace():
            # Nothing stands where a statement stood.
            text = text.lstrip()
        ran = block if text == block.text else parse_block(text, block.line, block.syntax)
        return replace(
            ran,
            callers=frame.callers,
            file=frame.source.name,
            directives=block.directives,
            substituted=tuple(reversed(changes)),
        )

    def _without_word(self, word: WordFormula, text: str) -> str:
        """A line without a word."""
        address = _ADDRESS.search(text, 0, word.begin)
        begin = address.start() if address is not None else word.begin
        return text[:begin] + " " * (0 if self._is_alone else word.end - begin) + text[word.end :]

    def _stay(self, frame: _Frame, index: int) -> Iterator[Block]:
        """Without calls, a line that does what is not known stays as it is written."""
        if self._is_alone:
            yield self._as_written(frame, index)

    # Ways: where nobody knows what is decided, both run, and only what they agree on is known where they meet

    def _decide(self, frame: _Frame, reason: str) -> None:
        """Refuse to write out what nobody knows whether it runs."""
        if not self._has_to_decide:
            return
        block, file = frame.source.blocks[frame.here], frame.source.name
        where = f", line {block.line} of {file}," if file else ""
        advice = "state its value by --variable"
        if self.variables.truth(SKIP_SWITCH) == Unknown(reason):
            advice = "delete the block, or its /"
        told = f"{block.text.strip()}{where} cannot be decided: {reason}; {advice}"
        raise _UndecidedError(self._line(frame, frame.here), told)

    def _part(self, frame: _Frame, reason: str, change: Callable[[_Frame], object]) -> Iterator[ProgramEvent]:
        """Keep another way, which goes on where a change of what runs now puts it."""
        line = self._line(frame, frame.here)
        self._decided = f"program line {line} decides: {reason}"
        yield ProgramEvent(EventKind.PART, line, self._decided)
        frames = [each.copy() for each in self._frames]
        change(frames[-1])
        place = frames[-1].rest[0].target if frames[-1].rest and isinstance(frames[-1].rest[0], _Taken) else None
        _leave_to(frame, frames[-1].at if place is None else place)
        self._wait(frames, self._state())

    def _state(self) -> _State:
        """The state here."""
        return _State(self.variables.copy(), self._beside, self._decided)

    def _know(self, known: _State) -> None:
        """Go on with what is known."""
        self.variables.levels, self._beside, self._decided = known.levels, known.beside, known.reason

    def _join(self, one: _State, other: _State, reason: str) -> _State:
        """The state where two ways meet."""
        levels = self.variables.join(one.levels, other.levels, reason)
        return _State(levels, self._follower.join((one.beside, other.beside), reason), one.reason or other.reason)

    def _wait(self, frames: list[_Frame], known: _State) -> None:
        """Let a way wait until those that have come less far are there as well; it meets one that waits there."""
        self._kept += 1
        place, number = _place(frames), self._kept
        other = self._waiting.get(place)
        if other is not None:
            why = other.known.reason or known.reason
            known, number = self._join(other.known, known, why), other.number
            for ours, theirs in zip(other.frames, frames, strict=True):
                ours.meet(theirs)
                if ours.entry is not theirs.entry:
                    ours.entry = self._follower.join((ours.entry, theirs.entry), why)
            frames = other.frames
        self._waiting[place] = _Way(frames, known, number)

    def _meet(self) -> Iterator[ProgramEvent]:
        """Go on with the way that has come least far, together with all others that are there."""
        if not self._waiting or (self._frames and _place(self._frames) < min(self._waiting)):
            return
        yield ProgramEvent(EventKind.MEET)
        if self._frames:
            self._wait(self._frames, self._state())
        way = self._waiting.pop(min(self._waiting))
        self._frames = way.frames
        self._know(way.known)
        self._go_on()
        for head in (each for frame in self._frames for each in frame.heads.values()):
            head.is_aside = head.is_aside or way.number < head.number

    def _begin_head(self, frame: _Frame, index: int) -> Iterator[ProgramEvent]:
        """Keep what is known on a line to which a jump or a loop may come back."""
        if not self._has_to_decide:
            # What is written out runs once.
            yield ProgramEvent(EventKind.HEAD, self._line(frame, index))
        self._kept += 1
        frame.heads[index] = _Head(self._kept, self._state(), len(self.found))

    def _run_again(self, frame: _Frame, first: int, reason: str) -> Iterator[Block | ProgramEvent]:
        """Go back to a line, nobody knows how often, until nothing new follows; then go on behind the one that runs."""
        line, head = self._line(frame, frame.here), frame.heads.get(first)
        told = f"program line {line} decides: {reason}"
        if head is None:
            # A computed jump, or one into a loop.
            self.variables.lose(self._assigned_in(frame, first, frame.here), reason)
            yield ProgramEvent(EventKind.LOST, line, reason)
            return
        yield ProgramEvent(EventKind.MEET)
        both = self._join(head.known, self._state(), told)
        # The deeper a loop is in others, the less often it runs each time.
        within = sum(bool(each.reason) and each.lines.first != first for each in frame.loops)
        is_last = self._is_alone or head.passes >= max(MOST_PASSES - within, 1)
        is_same = self._follower.is_same(both.beside, head.known.beside)
        is_settled = is_same and both.levels == head.known.levels
        if is_last or is_settled:
            self.variables.levels = both.levels
            self.variables.lose(self._assigned_in(frame, first, frame.here), reason)
            if not is_last:
                # What follows has run.
                self._beside = self._follower.join((), told)
            elif not is_same:
                self._beside = self._follower.lose(self._beside, told, line, in_passes=True)
            return
        if not head.is_aside:
            # All of it is found anew.
            del self.found[head.found :]
        both.reason = self._decided
        head.passes += 1
        self._know(both)
        head.known = self._state()
        frame.go_to(first)
        frame.is_again = True

    def _do_taken(self, frame: _Frame, index: int, taken: _Taken) -> Iterator[Block | ProgramEvent]:
        """Jump on the way on which that is decided."""
        if taken.target > index:
            yield from self._land(frame, index, taken.target)
            return
        yield from self._run_again(frame, taken.target, taken.reason)
        if frame.is_again:
            yield from self._land(frame, index, taken.target)

    def _is_endless(self, frame: _Frame, index: int, first: int, *, is_always: bool) -> bool:
        """Whether nothing ends what goes back to a line but ways out of it, of which nobody knows whether they are
        taken. Refuses what nothing ends at all."""
        head = frame.heads.get(first)
        is_left = head is not None and head.farthest > index and bool(self._waiting)
        if not is_left:
            self._check_repetition(frame, index, first)
        return is_left and (is_always or self._repeats(frame, index, first))

    def _run_endless(self, frame: _Frame, first: int) -> Iterator[Block | ProgramEvent]:
        """Run what only such ways end once more, until nothing new follows."""
        yield from self._run_again(frame, first, "how often it runs is not known")
        if not frame.is_again:
            self._frames = []

    # Statements that move nothing

    def _do(self, frame: _Frame, index: int, statement: MacroStatement | _Taken) -> Iterator[Block | ProgramEvent]:
        """Carry out a statement of a line."""
        if isinstance(statement, Jump | Call):
            for told in self._named_twice(frame, index, statement):
                yield ProgramEvent(EventKind.STOPPED, self._line(frame, index), told)
        yield from _DO[type(statement)](self, frame, index, statement)

    def _named_twice(self, frame: _Frame, index: int, statement: Jump | Call) -> Iterator[str]:
        """Messages about block numbers that a line jumps to or names, and that stand twice in its program."""
        if isinstance(statement, Jump):
            is_off = statement.condition is not None and self.variables.truth(statement.condition) is False
            names = [] if is_off else [statement.target]
        else:
            is_number = statement.kind is CallKind.LINES or statement.cycle.startswith("G")
            is_number = is_number or not self.language.jumps_to_numbers
            names = [each for each in (statement.target, statement.last) if each is not None] if is_number else []
        for each in names:
            name = self.variables.resolve(each)
            lines = frame.source.lines_named(name, index, self.language) if isinstance(name, str) else []
            if len(lines) > 1:
                places = " and ".join(str(frame.source.blocks[at].line) for at in lines[:2])
                line = frame.source.blocks[index].line
                what = "block" if self.language.jumps_to_numbers else "label"
                told = f"which stands twice, in program lines {places}: give each its own number"
                yield f"program line {line} names {what} {name}, {told}"

    def _do_assign(self, frame: _Frame, index: int, statement: Assign | Forget) -> Iterator[Block | ProgramEvent]:
        self.variables.assign(statement)
        name = self.variables.name(statement.variable)
        if self.language.may_move(name if isinstance(name, str) else ""):
            block = frame.source.blocks[index]
            text = self._set_anew(name, block)
            ran = parse_block(text, block.line, block.syntax)
            yield replace(ran, callers=frame.callers, file=frame.source.name)

    def _do_end(self, _frame: _Frame, _index: int, _statement: ProgramEnd) -> Iterator[Block | ProgramEvent]:
        self._frames = []
        yield from ()

    def _do_strange(self, frame: _Frame, index: int, statement: Strange) -> Iterator[Block | ProgramEvent]:
        self.variables.lose_all(statement.reason)
        frame.jumped = statement.reason if statement.jumps else frame.jumped
        keeps = statement.is_beside
        yield from self._unclear(frame, index, statement.reason, unread=statement.unread, keeps_modes=keeps)

    def _do_definitions(self, _frame: _Frame, _index: int, statement: Definitions) -> Iterator[Block | ProgramEvent]:
        self.variables.defines = statement.begin
        yield from ()

    def _do_told(self, _frame: _Frame, _index: int, statement: Refused | ReadAs) -> Iterator[Block | ProgramEvent]:
        is_refused = isinstance(statement, Refused)
        self._told[statement.told] = EventKind.REFUSED if is_refused else EventKind.READ_AS
        yield from ()

    def _do_modal_call(self, frame: _Frame, index: int, call: ModalCall) -> Iterator[Block | ProgramEvent]:
        if not call.reason:
            called = self.variables.values.pop(_CALLED_BEHIND, None)
            if called is not None:
                reason = called.reason if isinstance(called, Unknown) else str(called)
                keeps = self.variables.values.pop(_LOSES_MODES, None) is None
                yield from self._stay(frame, index) if not self._says_words(frame, index) else ()
                line = self._line(frame, index)
                yield ProgramEvent(EventKind.LOST, line, reason, keeps_modes=keeps, is_told=True)
            return
        self.variables.lose_all(call.reason)
        self.variables.values[_CALLED_BEHIND] = call.reason
        if not call.keeps_modes:
            self.variables.values[_LOSES_MODES] = call.reason
        yield from self._unclear(frame, index, call.reason, unread=call.name, keeps_modes=call.keeps_modes)

    def _do_when(self, frame: _Frame, index: int, when: When) -> Iterator[Block | ProgramEvent]:
        truth = self.variables.truth(when.condition)
        if truth is True:
            frame.rest[:0], told = _ends_last(when.then), _in_doubt(frame.source.blocks[index], when.then)
            if told:
                yield ProgramEvent(EventKind.STOPPED, self._line(frame, index), told)
            return
        jumps = [each for each in when.then if isinstance(each, Jump)]
        if isinstance(truth, Unknown) and len(jumps) < len(when.then):
            self._decide(frame, truth.reason)
            yield from self._stay(frame, index)
            if self._is_alone and any(isinstance(each, Call) for each in when.then):
                yield ProgramEvent(EventKind.LOST, self._line(frame, index), truth.reason)
                return
            if any(isinstance(each, Return | ProgramEnd) for each in when.then):
                _leave_to(frame, float("inf"))
            then = _ends_last(when.then)
            yield from self._part(frame, truth.reason, lambda other: other.rest.__setitem__(slice(0, 0), then))
            return
        for jump in jumps:
            yield from self._jump(frame, index, replace(jump, condition=when.condition))

    def _line(self, frame: _Frame, index: int) -> int:
        """The line of the main file at which something on a line happens."""
        return frame.callers[0].line if frame.source.name and frame.callers else frame.source.blocks[index].line

    def _jump(self, frame: _Frame, index: int, jump: Jump) -> Iterator[Block | ProgramEvent]:
        truth = self.variables.truth(jump.condition) if jump.condition is not None else True
        target, told = self._target(frame, index, jump), self._lacks(frame, index, jump)
        if truth is False:
            if target is not None:
                self._keep(frame, target)
            return
        if isinstance(where := self.variables.resolve(jump.target), Unknown):
            self._decide(frame, where.reason)
        if target is None and frame.jumped == told:
            raise _RefusedError(told)
        if isinstance(truth, Unknown):
            self._decide(frame, truth.reason)
            yield from self._jump_in_doubt(frame, index, target, truth.reason, told)
            return
        if target is None:
            raise _RefusedError(told)
        if self._waiting and self._is_alone:
            self._named.add((frame.source.name, target))
            yield from self._stay(frame, index)
        if target <= index:
            if self._is_endless(frame, index, target, is_always=jump.condition is None):
                yield from self._run_endless(frame, target)
                if frame.is_again:
                    yield from self._land(frame, index, target)
                return
        elif jump.condition is not None:
            self._keep(frame, index + 1)
        yield from self._land(frame, index, target)

    def _jump_in_doubt(
        self, frame: _Frame, index: int, target: int | None, reason: str, told: str
    ) -> Iterator[Block | ProgramEvent]:
        """Run both ways of a jump of which nobody knows whether it is taken; `told` says that its target is missing."""
        if target is not None:
            self._named.add((frame.source.name, target))
            yield from self._stay(frame, index)
            taken = _Taken(target, reason)
            yield from self._part(frame, reason, lambda other: other.rest.__setitem__(slice(None), [taken]))
        elif not self._is_alone:
            # Where it jumps, the control stops; what follows runs where it does not.
            yield ProgramEvent(EventKind.MAY_STOP, self._line(frame, index), told)

    def _lacks(self, frame: _Frame, index: int, jump: Jump) -> str:
        """The message about a jump whose target is missing or not known; an unknown target may be any block."""
        line, where = self._line(frame, index), self.variables.resolve(jump.target)
        if isinstance(where, str):
            return f"program line {line} jumps to {where}, which is not there"
        told = f"program line {line} jumps to an unknown block: {where.reason}"
        if jump.condition is None or self.variables.truth(jump.condition) is not False:
            frame.jumped = told
        return told

    def _land(self, frame: _Frame, index: int, target: int) -> Iterator[ProgramEvent]:
        """Go on at the target of a jump. It leaves the loops and branches in which its target is not; what begins there
        begins anew; and how often a loop runs into which it jumps, nobody knows."""
        for other in frame.rest:
            # CASE decides among several jumps at once.
            if isinstance(other, Jump) and (place := self._target(frame, index, other)) is not None:
                self._keep(frame, place)
        frame.go_to(target)
        frame.loops = [each for each in frame.loops if each.lines.has(target)]
        frame.branches = [each for each in frame.branches if each.lines.has(target)]
        nesting, open_loops = frame.source.nesting, [each.lines for each in frame.loops]
        loops = {each for each in nesting.loops.values() if each.has(target)}.difference(open_loops)
        branches = {each for each in nesting.branches.values() if each.has(target)}
        frame.loops += (_Loop(each, reason="how often the loop runs is not known") for each in sorted(loops))
        frame.branches += (
            _Branch(each, has_run=True) for each in sorted(branches.difference(each.lines for each in frame.branches))
        )
        if loops:
            line, begun = self._line(frame, index), frame.source.blocks[min(loops).first].line
            told = f"program line {line} jumps into the loop that program line {begun} begins: how often that runs "
            told += "then is not known"
            yield ProgramEvent(EventKind.STOPPED, line, told)

    def _check_repetition(self, frame: _Frame, index: int, target: int) -> None:
        """Refuse to go back to a line where everything was the same before: that would go on for ever."""
        if self._repeats(frame, index, target):
            line = self._line(frame, index)
            if any(isinstance(each, Unknown) for level in self.variables.levels for each in level.values.values()):
                told = f"program line {line} goes back again and again: what ends that is not known"
                raise _RefusedError(f"{told}, so it is followed no further")
            raise _RefusedError(f"program line {line} runs for ever: nothing changes from pass to pass")

    def _repeats(self, frame: _Frame, index: int, target: int) -> bool:
        """Whether everything was the same before where a line leads back."""
        calls = tuple((each.source.name, each.at, each.left) for each in self._frames)
        # Values have no order; what they were is all that matters.
        now = hash((frame.source.name, index, target, calls, self.variables.all()))
        known = now in self._passed
        self._passed.add(now)
        return known

    def _target(self, frame: _Frame, index: int, jump: Jump) -> int | None:
        last = frame.last if frame.call is None or frame.call.kind is not CallKind.PROFILE else len(frame.source) - 1
        forward, backward = range(index + 1, last + 1), range(index, frame.source.section_of(index).start - 1, -1)
        ways = {
            JumpWay.ANYWHERE: (forward, backward),
            JumpWay.FORWARD: (forward,),
            JumpWay.BACKWARD: (backward,),
        }[jump.way]
        value = self.variables.resolve(jump.target)
        if isinstance(value, Unknown):
            return None
        if value.isdigit() and self.language.jumps_to_numbers:
            return _first(frame.source.number(value, *ends) for ends in ((index + 1, last), (backward.stop + 1, index)))
        return frame.source.label(value.upper(), *ways)

    def _assigned_in(self, frame: _Frame, first: int, last: int) -> Iterator[str]:
        """The variables that statements of some lines set."""
        for index in range(first, last + 1):
            for statement in frame.source.code(index).statements:
                within = statement.then if isinstance(statement, When) else (statement,)
                for each in within:
                    variable = each.variable if isinstance(each, Assign | Forget | For) else None
                    name = self.variables.name(variable) if variable is not None else None
                    if isinstance(name, str):
                        yield name
                    elif name is not None:
                        yield from [name for level in self.variables.levels for name in level.values]

    # Branches

    def _begin_branch(self, frame: _Frame, index: int, branch: If | ElseIf) -> Iterator[Block | ProgramEvent]:
        truth, lines = self.variables.truth(branch.condition), self._branch_lines(frame, index)
        if isinstance(truth, Unknown):
            self._decide(frame, truth.reason)
            yield from self._stay(frame, index)
            yield from self._part(frame, truth.reason, partial(_begin_part, first=index, lines=lines))
            frame.branches.append(_Branch(lines, has_run=True, is_undecided=True))
            return
        frame.branches.append(_Branch(lines, truth))
        if truth:
            self._keep_parts(frame, index)
        else:
            self._keep(frame, index + 1)
            frame.go_to(frame.source.nesting.next_parts[index])

    def _branch_lines(self, frame: _Frame, index: int) -> LineRange:
        """The lines of the branch that a line begins or goes on with. Raises if it has no end."""
        lines = frame.source.nesting.branches.get(index)
        if lines is None or lines.last > frame.last:
            raise _RefusedError(f"the IF of program line {self._line(frame, index)} has no end")
        return lines

    def _keep_parts(self, frame: _Frame, index: int) -> None:
        """Keep what is known now for the parts of a branch behind the one that runs."""
        nesting = frame.source.nesting
        while (part := nesting.next_parts.get(index)) is not None and part < nesting.branches[index].last:
            self._keep(frame, part + 1)
            index = part

    def _open_branch(self, frame: _Frame, index: int) -> _Branch | None:
        """The branch that is open and goes on with a line or ends there; those in it have ended."""
        lines = frame.source.nesting.branches.get(index)
        while any(each.lines == lines for each in frame.branches):
            if frame.branches[-1].lines == lines:
                return frame.branches[-1]
            frame.branches.pop()
        return None

    def _next_branch(self, frame: _Frame, index: int, part: ElseIf | Else) -> Iterator[Block | ProgramEvent]:
        branch = self._open_branch(frame, index)
        if branch is not None and branch.is_undecided:
            yield from self._stay(frame, index)
        if branch is None or branch.has_run:
            self._branch_lines(frame, index)
            frame.go_to(frame.source.nesting.next_parts[index])
        elif isinstance(part, ElseIf):
            frame.branches.pop()
            yield from self._begin_branch(frame, index, part)
        else:
            branch.has_run = True

    def _end_branch(self, frame: _Frame, index: int, _end: EndIf) -> Iterator[Block | ProgramEvent]:
        branch = self._open_branch(frame, index)
        if branch is None:
            return
        frame.branches.pop()
        if branch.is_undecided:
            yield from self._stay(frame, index)

    # Loops

    def _begin_loop(self, frame: _Frame, index: int, loop: Loop | For) -> Iterator[Block | ProgramEvent]:
        lines = frame.source.nesting.loops.get((index, loop.name))
        if lines is None or lines.last > frame.last:
            raise _RefusedError(f"the loop of program line {self._line(frame, index)} has no end")
        known = next((each for each in frame.loops if each.lines == lines), None)
        if isinstance(loop, For):
            yield from self._count(frame, loop, lines, known)
            return
        truth = self.variables.truth(loop.condition) if loop.condition is not None else True
        if isinstance(truth, Unknown):
            yield from self._run_unknown_loop(frame, lines, truth.reason, known)
        elif truth is False:
            self._leave_loop(frame, lines)
        elif known is None:
            frame.loops.append(_Loop(lines))

    def _run_unknown_loop(
        self, frame: _Frame, lines: LineRange, reason: str, known: _Loop | None
    ) -> Iterator[Block | ProgramEvent]:
        """Run a loop once more, of which nobody knows whether it does."""
        self._decide(frame, reason)
        if not self._is_alone and not (known is not None and known.reason):
            yield from self._begin_head(frame, lines.first)
        if self._is_alone:
            yield from self._unclear(frame, lines.first, reason)
        _leave_loop(frame, lines)
        yield from self._part(frame, reason, lambda other: other.go_to(lines.last + 1))
        frame.loops.append(_Loop(lines, reason=reason))

    def _count(self, frame: _Frame, loop: For, lines: LineRange, known: _Loop | None) -> Iterator[Block | ProgramEvent]:
        name = self.variables.name(loop.variable)
        first, last, step = (self.variables.value(each) for each in (loop.first, loop.last, loop.step))
        if known is not None and known.reason:
            yield from self._run_unknown_loop(frame, lines, known.reason, known)
            return
        if known is None:
            if not (isinstance(name, str) and isinstance(first, float) and isinstance(last, float)):
                why = next(each for each in (name, first, last) if not isinstance(each, float) and each is not None)
                told = why if isinstance(why, Unknown) else Unknown(f"{why} counts what is not known")
                self.variables.set(name, told) if isinstance(name, str) else self.variables.lose_all(told.reason)
                yield from self._run_unknown_loop(frame, lines, told.reason, None)
                return
            frame.loops.append(_Loop(lines, last, step if isinstance(step, float) else 1.0))
            self.variables.set(name, first)
        current = self.variables.value(loop.variable)
        state = frame.loops[-1]
        is_over = isinstance(current, float) and state.last is not None and (current - state.last) * state.step > 0
        if is_over:
            self._leave_loop(frame, lines)

    def _leave_loop(self, frame: _Frame, lines: LineRange) -> None:
        """Go on behind a loop."""
        _leave_loop(frame, lines)
        frame.go_to(lines.last + 1)

    def _end_loop(self, frame: _Frame, index: int, end: EndLoop) -> Iterator[Block | ProgramEvent]:
        loop = next((each for each in frame.loops if each.lines.last == index), None)
        if loop is None:
            return
        # Loops that begin in it have been left.
        frame.loops = frame.loops[: frame.loops.index(loop) + 1]
        until = self.variables.truth(end.until) if end.until is not None else False
        if loop.reason or isinstance(until, Unknown):
            reason = until.reason if isinstance(until, Unknown) else loop.reason
            self._decide(frame, reason)
            yield from self._stay(frame, index)
            if isinstance(until, Unknown):
                yield from self._part(frame, reason, lambda other: _leave_loop(other, loop.lines))
            yield from self._run_again(frame, loop.lines.first, reason)
            if not frame.is_again:
                frame.loops.remove(loop)
        elif until:
            frame.loops.remove(loop)
        else:
            first = loop.lines.first
            counting = next((each for each in frame.source.code(first).statements if isinstance(each, For)), None)
            if counting is not None:
                value, name = self.variables.value(counting.variable), self.variables.name(counting.variable)
                if isinstance(value, float) and isinstance(name, str):
                    self.variables.set(name, value + loop.step)
            is_always = end.until is None and not _ends_by_itself(frame.source.code(first))
            if self._is_endless(frame, index, first, is_always=is_always):
                yield from self._run_endless(frame, first)
                return
            loop.passes += 1
            frame.go_to(first)

    # Calls

    def _call(self, frame: _Frame, index: int, call: Call) -> Iterator[Block | ProgramEvent]:
        line, count = self._line(frame, index), self.variables.value(call.count)
        text = frame.source.blocks[index].text.strip()
        found = self.library.find_called(call, frame.source, index, self.main, self.variables.resolve)
        if isinstance(found, Unknown):
            yield from self._cannot_call(frame, index, call, found)
            return
        source, first, last = found
        if last < first:
            raise _RefusedError(f"{text} {_backwards(source, first, last, index)}")
        if len(self._frames) >= DEEPEST:
            yield from self._unwind(source, first)
            raise _RefusedError(f"program line {line} calls itself again and again: {DEEPEST} calls in one another")
        doubt = f"how often {text} runs is not known: {count.reason}" if isinstance(count, Unknown) else ""
        if doubt:
            yield from self._unclear(frame, index, doubt)
        times = int(count) if isinstance(count, float) else 1
        if times < 1:
            return
        is_behind = call.cycle.startswith("G") and source is frame.source and first > index
        is_inside = any(each.call is not None and each.call.kind is CallKind.PROFILE for each in self._frames)
        if call.kind is CallKind.PROFILE and is_inside:
            # In a profile, no control runs a cycle.
            return
        is_finishing = self.finishes and call.cycle == "G70"
        if self._is_alone and call.kind is CallKind.PROFILE and not is_behind and not is_finishing:
            if not self._says_words(frame, index):
                yield frame.source.blocks[index]
            if not call.cycle.startswith("G"):
                told = f"{call.cycle} cuts a profile that is written elsewhere, which a program without calls has not"
                yield ProgramEvent(EventKind.BARRIER, line, told)
            return
        yield from self._begin_call(frame, index, call, found, times)
        if self._frames[-1] is not frame:
            self._frames[-1].doubt = doubt
        if call.kind is CallKind.PROFILE and is_behind:
            frame.at = last + 1

    def _begin_call(
        self, frame: _Frame, index: int, call: Call, found: tuple[ProgramFile, int, int], times: int
    ) -> Iterator[Block | ProgramEvent]:
        """Run what a call has found, with a level of variables and the modes at its entry."""
        source, first, last = found
        line, text = self._line(frame, index), frame.source.blocks[index].text.strip()
        head, depth = source.head(first, last), len(self.variables.levels)
        own = self._level_of(call, head, text)
        ours = frame.source.code(frame.source.section_of(index).start).unit
        if head.unit and ours and head.unit != ours:
            told = f"{text} calls a program in {head.unit}, and this one is in {ours}: what that moves is not known"
            own = Unknown(told)
        if isinstance(own, Unknown):
            self.variables.lose_all(own.reason)
            yield from self._unclear(frame, index, own.reason)
            return
        begun = self._begun(line, source, first, last, own)
        caller = Caller(line, text, call.cycle, self._is_reached)
        called = _Frame(source, first, first, last, call, (*frame.callers, caller), times, depth, own, begun)
        called.saves = head.saves and call.kind is CallKind.PROGRAM
        if call.kind is CallKind.PROFILE or called.saves:
            yield ProgramEvent(EventKind.BARRIER if called.saves else EventKind.ENTER, line, call.cycle)
            called.entry, called.first_ran = self._beside, len(self._ran)
        if called.saves:
            self._beside = self._follower.enter(self._beside)
        self._frames.append(called)
        if own is not None:
            self.variables.levels.append(own.copy())

    def _cannot_call(self, frame: _Frame, index: int, call: Call, why: Unknown) -> Iterator[Block | ProgramEvent]:
        """A call of what is not found. That a file is not there is told where a contour depends on it,
        and that the program names what it has not in any case."""
        self.variables.lose_all(why.reason)
        if isinstance(why, Absent):
            raise _RefusedError(why.reason)
        name = call.target if isinstance(call.target, str) else ""
        called = "" if call.arguments or frame.source.name else name
        keeps_modes = call.kind is CallKind.PROFILE or bool(re.fullmatch(self.language.own_cycles, name))
        yield from self._unclear(frame, index, why.reason, called, keeps_modes=keeps_modes)

    def _begun(self, line: int, source: ProgramFile, first: int, last: int, own: VariableLevel | None) -> _Begun:
        """The identity of a call with its values. Raises _RefusedError for a call that runs already with the same ones:
        it would call itself for ever."""
        levels = [self.variables.levels[0], *([own] if own is not None else self.variables.levels[1:])]
        begun = source.name, first, last, tuple(frozenset(each.values.items()) for each in levels)
        if any(each.begun == begun for each in self._frames):
            raise _RefusedError(f"program line {line} calls itself again and again: nothing changes from call to call")
        return begun

    def _as_written(self, frame: _Frame, index: int) -> Block:
        """A line that stays as it is written; of one whose words have run, its statements."""
        block, code = frame.source.blocks[index], frame.source.code(index)
        if not self._says_words(frame, index) or len(code.rest) != len(block.text):
            return block
        text = "".join(" " if kept.strip() else typed for typed, kept in zip(block.text, code.rest, strict=True))
        return parse_block(text, block.line, block.syntax) if text.strip() else block

    def _says_words(self, frame: _Frame, index: int) -> bool:
        """Whether a line has words besides its number and its statements."""
        block, code = frame.source.blocks[index], frame.source.code(index)
        return any(word.address != "N" for word in parse_block(code.rest, block.line, block.syntax).words)

    def _level_of(self, call: Call, head: CodeLine, text: str) -> VariableLevel | Unknown | None:
        """The level of variables with which a call begins; None for one that has none of its own, Unknown where it is
        not known what it hands over. Raises _RefusedError."""
        if not call.is_local:
            for name, term in call.arguments:
                self.variables.set(name, self.variables.value(term))
            return None
        level = VariableLevel(str(self.variables.resolve(call.target)))
        if not self.language.declares:
            level.values |= {name: self.variables.value(term) for name, term in call.arguments}
            return level
        if len(call.arguments) > len(head.parameters):
            most = len(head.parameters)
            raise _RefusedError(f"{text} hands over {len(call.arguments)} values, and {level.program} takes {most}")
        given, links = dict(enumerate(term for _, term in call.arguments)), dict[str, tuple[int, str]]()
        for place, formal in enumerate(head.parameters):
            handed = given.get(place)
            if formal.is_reference and handed is not None:
                link = self._link(formal, handed, text)
                if isinstance(link, Unknown):
                    return link
                links[formal.name] = link
                continue
            value: Known = "" if formal.of_type is VariableType.STRING else 0.0
            if handed is not None:
                value = self.variables.value(handed)
            elif formal.has_default:
                value = Unknown(f"{formal.name} has a value of its own, which is not read")
            level.types[formal.name] = formal.of_type
            typed = as_type(value, formal.of_type, formal.name)
            level.values[formal.name] = self.variables.stated(formal.name, typed)
        return replace(level, links=links)

    def _link(self, formal: FormalParameter, term: Term, text: str) -> tuple[int, str] | Unknown:
        """The variable that a subprogram has by reference: its level, and its name there. Raises _RefusedError."""
        if not isinstance(term, Variable | Indexed):
            told = f"{text} hands over no variable for {formal.name}, which {text.partition('(')[0]} changes (VAR)"
            raise _RefusedError(f"{told}; write a variable there")
        name = self.variables.name(term)
        if isinstance(name, Unknown):
            return Unknown(f"which variable {text} hands over for {formal.name} is not known: {name.reason}")
        held = self.variables.type_of(name)
        if held is not None and held is not formal.of_type:
            told = f"{text} hands over {name}, of type {held.value}, for {formal.name} (VAR {formal.of_type.value})"
            raise _RefusedError(f"{told}; write a variable of type {formal.of_type.value} there")
        return self.variables.place(name)

    def _return(self, frame: _Frame, _index: int, end: Return) -> Iterator[Block | ProgramEvent]:
        if frame.call is None:
            if not self.language.passes_return:
                self._frames = []
            return
        caller = self._frames[-2]
        yield from self._leave(frame)
        if end.to is not None:
            value = self.variables.value(end.to)
            if isinstance(value, Vacant):
                return
            target = (
                caller.source.number(f"{value:.0f}", 0, len(caller.source) - 1) if isinstance(value, float) else None
            )
            if target is None:
                raise _RefusedError("the subprogram returns to a block that is not there")
            caller.at = target

    def _unwind(self, source: ProgramFile, first: int) -> Iterator[Block | ProgramEvent]:
        """End what calls itself at all depths: otherwise, the calls behind each of its calls multiply."""
        outermost = next(
            (at for at, each in enumerate(self._frames) if (each.source, each.first) == (source, first)), 1
        )
        for frame in reversed(self._frames[max(outermost, 1) :]):
            frame.left = 1
            yield from self._leave(frame)

    def _leave(self, frame: _Frame) -> Iterator[Block | ProgramEvent]:
        """The end of what a frame runs: it runs again, or what called it goes on."""
        frame.left -= 1
        self._last = self._last if _is_loop(frame.call) else frame
        if frame.saves:
            yield from self._bring_back(frame)
        if frame.left > 0:
            frame.at, frame.loops, frame.branches, frame.heads = frame.first, [], [], {}
            if frame.own is not None and self.language.declares:
                self.variables.leave(frame.depth)
                self.variables.levels.append(frame.own.copy())
            return
        self._frames.pop()
        if frame.own is not None:
            self.variables.leave(frame.depth)
        self._go_on()
        if frame.doubt:
            self.variables.lose_all(frame.doubt)
            yield ProgramEvent(EventKind.LOST, frame.callers[-1].line, frame.doubt, is_told=True)
        if frame.call is not None and frame.call.kind is CallKind.PROFILE:
            yield ProgramEvent(EventKind.LEAVE, frame.callers[-1].line, frame.call.cycle)
            self._beside = frame.entry

    def _bring_back(self, frame: _Frame) -> Iterator[Block | ProgramEvent]:
        """Put the modes in force again that were in force where a subprogram was called."""
        line = self._line(frame, frame.here)
        yield ProgramEvent(EventKind.BARRIER, line)
        told = f"the coordinate system is again that of {frame.callers[-1].text}, by SAVE"
        if self._has_to_decide:
            yield from self._write_back(frame, line)
        self._beside = self._follower.restore(frame.entry, self._beside, told, line)
        self._go_on()

    def _write_back(self, frame: _Frame, line: int) -> Iterator[Block | ProgramEvent]:
        """Blocks that say what SAVE brings back. Raises _UndecidedError where there are none."""
        call, ran = frame.callers[-1], (self._ran[: frame.first_ran], self._ran[frame.first_ran :])
        back = self._follower.write_back(frame.entry, self._beside, *ran)
        if back.refused:
            raise _UndecidedError(line, f"SAVE behind {call.text} cannot be written out: {back.refused}")
        if back.left_out:
            yield ProgramEvent(EventKind.BARRIER, line, f"SAVE behind {call.text}: {back.left_out}")
        for text in back.lines:
            block = parse_block(text, call.line, frame.source.blocks[frame.first].syntax)
            self._ran.append(replace(block, callers=frame.callers, file=frame.source.name))
            yield self._ran[-1]


def _is_loop(call: Call | None) -> bool:
    """Whether a call repeats lines of what calls: `CALL LBL 1 REP 2`, `REPEAT A B P2`."""
    return call is not None and (
        call.kind is CallKind.SECTION or (call.kind is CallKind.LABEL and call.last is not None)
    )


def _begin_part(frame: _Frame, *, first: int, lines: LineRange) -> None:
    """Let a frame go on at the next part of a branch: behind ELSE, at ELSEIF or at the end."""
    part = frame.source.nesting.next_parts[first]
    said = frame.source.code(part).statements
    has_run = not any(isinstance(each, ElseIf) for each in said)
    frame.go_to(part + any(isinstance(each, Else) for each in said))
    frame.branches.append(_Branch(lines, has_run, is_undecided=True))


def _leave_loop(frame: _Frame, lines: LineRange) -> None:
    frame.loops = [each for each in frame.loops if each.lines != lines]


def _leave_to(frame: _Frame, place: float) -> None:
    """A way leaves for a line."""
    for head in frame.heads.values():
        head.farthest = max(head.farthest, place)


def _ends_by_itself(code: CodeLine) -> bool:
    """Whether a loop that begins on a line has a condition, or counts."""
    return any(
        isinstance(each, For) or (isinstance(each, Loop) and each.condition is not None) for each in code.statements
    )


_DO: Mapping[type[MacroStatement | _Taken], Callable[..., Iterator[Block | ProgramEvent]]] = {
    Assign: Machine._do_assign,
    Forget: Machine._do_assign,
    When: Machine._do_when,
    _Taken: Machine._do_taken,
    Jump: Machine._jump,
    Call: Machine._call,
    Return: Machine._return,
    ProgramEnd: Machine._do_end,
    If: Machine._begin_branch,
    ElseIf: Machine._next_branch,
    Else: Machine._next_branch,
    EndIf: Machine._end_branch,
    Loop: Machine._begin_loop,
    For: Machine._begin_loop,
    EndLoop: Machine._end_loop,
    Strange: Machine._do_strange,
    Definitions: Machine._do_definitions,
    Refused: Machine._do_told,
    ReadAs: Machine._do_told,
    ModalCall: Machine._do_modal_call,
}


def _in_doubt(block: Block, statements: Sequence[MacroStatement]) -> str:
    """The reason why the effect of a line is not known; empty if it is clear."""
    if not any(isinstance(each, ProgramEnd | Return) for each in statements):
        return ""
    does = [told for kind, told in _DOES.items() if any(isinstance(each, kind) for each in statements)]
    if len(does) == 1:
        return ""
    return (
        f"program line {block.line} {' and '.join(does)} in one block: which comes first is not known; write two blocks"
    )


_DOES: Mapping[type[MacroStatement], str] = {
    ProgramEnd: "ends the program",
    Return: "returns",
    Call: "calls a subprogram",
    Jump: "jumps",
}


def _ends_last(statements: Sequence[MacroStatement]) -> list[MacroStatement]:
    """The statements of a line, in whatever order they stand: what ends a program comes last."""
    return sorted(statements, key=lambda each: (isinstance(each, ProgramEnd | Return), isinstance(each, Return)))


def _backwards(source: ProgramFile, first: int, last: int, index: int) -> str:
    """That a call on a line names lines of which the last one stands before the first one."""
    begins, ends = (source.blocks[each].line for each in (first, last))
    if last == index - 1:
        return f"repeats from program line {begins} up to itself, but that line stands after it"
    return f"runs from program line {begins}, but its last line, {ends}, stands before that"


_ADDRESS = late_pattern(r",?[A-Z][ \t]*\Z", re.IGNORECASE)
"""Address before the value of a word."""


def _unsigned(term: Term) -> Term:
    """A value without the sign before it."""
    return term.arguments[0] if isinstance(term, Apply) and term.function == "negate" else term


def _is_word(name: str) -> bool:
    """Whether a name may be that of a word with a value: it is none of a machine's variable, nor a parameter."""
    return name[0].isalpha() and not name[1:].isdigit()


def _first(values: Iterable[int | None]) -> int | None:
    return next((each for each in values if each is not None), None)


_CALLED_BEHIND = "a call after each move"
"""Under this name it is known what a modal call does: ways that meet agree on it as on variables."""
_LOSES_MODES = "the modes behind that call"
_AXES = frozenset("XYZUVWABC")
"""Addresses of what moves."""

_CUTTING_PROFILES = ("G71", "G72", "G73")
"""Cycles that run the profile which their P and Q name; G70 runs one that another has named."""


def _is_called(block: Block) -> bool:
    """Whether a block is of another program than the main one: the profile of a cycle is none."""
    return bool(block.file) or any(not each.cycle.startswith("G") for each in block.callers)


def _numbered(block: Block) -> str:
    """The number of a block, which N states in its first word; empty if it has none."""
    word = block.words[0] if block.words else None
    is_number = word is not None and word.address == "N" and word.number is not None and word.number % 1 == 0
    return f"{word.number:.0f}" if word is not None and is_number else ""


def _without_number(block: Block) -> Block:
    """A block without the number with which it begins, and without the blanks behind that."""
    span = block.words[0].span
    text = block.text[: span.column - 1] + block.text[span.end_column - 1 :].lstrip()
    bare = parse_block(text, block.line, block.syntax)
    shift = len(block.text) - len(text)
    moved = (replace(each, begin=each.begin - shift, end=each.end - shift) for each in block.substituted)
    return replace(bare, callers=block.callers, file=block.file, directives=block.directives, substituted=tuple(moved))


_RETURNS = (17, 29, 99)
"""M codes that end a subprogram."""


def _returns(statement: MacroStatement | _Taken, *, is_called: bool) -> bool:
    """Whether a statement ends a subprogram; in a main program, where it is not known whether it does."""
    if isinstance(statement, When):
        return any(isinstance(each, Return) for each in statement.then)
    return is_called and isinstance(statement, Return)


_IN_DOUBT = (Assign, Forget, Jump, Call, Return, ProgramEnd, When)
"""Statements that a block which begins with / leaves out as a whole."""


def _without_return(text: str, block: Block) -> str:
    """A line without the word that ends a subprogram."""
    for word in parse_block(text, block.line, block.syntax).words:
        if word.address == "M" and word.number in _RETURNS:
            begin, end = word.span.column - 1, word.span.end_column - 1
            text = text[:begin] + " " * (end - begin) + text[end:]
    return text


_ENDS_FILE = late_pattern(r"\s*(?:%|\d*\s*END\s+PGM\b.*)\s*", re.IGNORECASE)
"""The last line of a file, which stands behind all of its subprograms."""
