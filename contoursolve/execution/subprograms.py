"""Places of subprograms: sections of a program, files beside it, and files in other folders."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path

from msgspec import Struct

from contoursolve.execution.macro_language import (
    Call,
    CallKind,
    CodeLine,
    Else,
    ElseIf,
    EndIf,
    EndLoop,
    For,
    If,
    Jump,
    JumpWay,
    Loop,
    MacroLanguage,
    ProgramEnd,
    Return,
    Unknown,
    When,
)
from contoursolve.gcode import (
    MOST_OF_PROGRAM,
    Block,
    Program,
    Syntax,
    UnreadableProgramError,
    decode,
    parse,
    read_bytes,
)
from contoursolve.numeric import Constant, Term


class Surroundings(Struct, frozen=True):
    """Statements apart from a program that runs: values of variables by name, and folders with files of subprograms."""

    values: Mapping[str, float] = {}
    folders: tuple[Path, ...] = ()


ALONE = Surroundings()

Resolve = Callable[[Term | str], str | Unknown]
"""From what a call names to the name or number itself."""


def surroundings_of(
    name: str, values: Mapping[str, float] | None = None, folders: Iterable[str | Path] = ()
) -> Surroundings:
    """Those of a program of some name; its own folder comes first."""
    own = () if name.startswith("<") else (Path(name).parent,)
    known = {each.strip().upper(): float(value) for each, value in (values or {}).items()}
    return Surroundings(known, (*own, *map(Path, folders)))


class Absent(Unknown, frozen=True):
    """The program itself has no such name."""


class LineRange(Struct, frozen=True, order=True):
    """The lines of a loop or of a branch: the indices of its first and its last one."""

    first: int
    last: int

    def has(self, index: int) -> bool:
        """Whether a line is in it: behind its first one, which begins it."""
        return self.first < index <= self.last


class Nesting(Struct, frozen=True):
    """The loops of a file by the indices of their first lines and by their names; its branches by the indices of the
    lines that begin them, go on with them or end them; and by the line that begins one part of a branch, the line with
    the next part or the end."""

    loops: Mapping[tuple[int, str], LineRange]
    branches: Mapping[int, LineRange]
    next_parts: Mapping[int, int]


class ProgramFile:
    """One file with programs, and what each of its lines says."""

    def __init__(self, program: Program, language: MacroLanguage, *, is_other: bool) -> None:
        self.name = program.name if is_other else ""
        """Its name, if it is another file than the main program."""
        # Each is looked at several times.
        self.blocks: Sequence[Block] = tuple(program.blocks)
        self.language = language
        self._codes: dict[int, CodeLine] = {}

    def __len__(self) -> int:
        return len(self.blocks)

    def code(self, index: int) -> CodeLine:
        """The statements of a line."""
        found = self._codes.get(index)
        if found is None:
            found = self._codes[index] = self.language.read(self.blocks[index].text)
        return found

    @cached_property
    def _places(self) -> tuple[dict[str, list[int]], dict[str, list[int]]]:
        """The indices of the lines with each block number, and with each label."""
        numbers, labels = dict[str, list[int]](), dict[str, list[int]]()
        for index in range(len(self)):
            code = self.code(index)
            if code.number:
                numbers.setdefault(code.number, []).append(index)
            for label in code.labels:
                labels.setdefault(label, []).append(index)
        return numbers, labels

    def number(self, number: str, first: int, last: int) -> int | None:
        """The index of the line with a block number, between two others."""
        places = self._places[0].get(number.lstrip("0") or "0", ())
        return next((index for index in places if first <= index <= last), None)

    def label(self, name: str, *ways: range) -> int | None:
        """The index of the first line with a label, or with a block number of that name (`N10`), on some ways through
        the lines, one after the other."""
        numbers, labels = self._places
        number = name[1:].lstrip("0") if name[:1] == "N" and name[1:].isdigit() else ""
        places = [*labels.get(name, ()), *(numbers.get(number, ()) if number else ())]
        return next((min(found, key=way.index) for way in ways if (found := [at for at in places if at in way])), None)

    @cached_property
    def sections(self) -> dict[str, int]:
        """The programs that it has, each with the index of the line with which it begins."""
        found: dict[str, int] = {}
        for index in range(len(self)):
            name = self.code(index).begins
            if name is not None:
                found.setdefault(name.upper(), index)
        return found

    def head(self, first: int, last: int) -> CodeLine:
        """The line with the formal parameters of a program, which may stand behind the one that names it; else its
        first one."""
        for index in range(first, last + 1):
            code = self.code(index)
            if code.parameters or code.saves:
                return code
            if code.statements or (
                code.begins is None and any(word.address != "N" for word in self.blocks[index].words)
            ):
                break
        return self.code(first)

    def called(self) -> Iterator[str]:
        """The programs that a program of the file calls by name; not those that call themselves."""
        name = ""
        for code in map(self.code, range(len(self))):
            name = name if code.begins is None else code.begins.upper()
            for each in code.statements:
                if isinstance(each, Call) and isinstance(each.target, str) and each.target.upper() != name:
                    yield each.target.upper()

    @cached_property
    def heads(self) -> frozenset[int]:
        """The indices of the lines to which something may come back while it is not known how often: those to which
        jumps lead, and those of loops that have no condition or that something in them may leave."""
        found = {part.first for part in self.nesting.loops.values() if self._may_be_left(part)}
        for index in range(len(self)):
            for jump in self._jumps(index):
                target = f"{jump.target.value:.0f}" if isinstance(jump.target, Constant) else jump.target
                if jump.way is not JumpWay.FORWARD and isinstance(target, str):
                    places = self.label(target.upper(), range(index, -1, -1)), self.number(target, 0, index)
                    found.update(each for each in places if each is not None)
        return frozenset(found)

    def _may_be_left(self, loop: LineRange) -> bool:
        """Whether anything but its own condition ends a loop."""
        begins = self.code(loop.first).statements
        if not any(isinstance(each, For) or (isinstance(each, Loop) and each.condition is not None) for each in begins):
            return True
        inside = (each for index in range(loop.first + 1, loop.last) for each in self.code(index).statements)
        return any(isinstance(each, Jump | When | Return | ProgramEnd) for each in inside)

    def _jumps(self, index: int) -> Iterator[Jump]:
        for each in self.code(index).statements:
            within = each.then if isinstance(each, When) else (each,)
            yield from (one for one in within if isinstance(one, Jump))

    def section_end(self, first: int) -> int:
        """The index of the last line of the program to which a line belongs."""
        later = (index for index in self.sections.values() if index > first)
        return min(later, default=len(self)) - 1

    def section_of(self, index: int) -> range:
        """The lines of the program to which a line belongs."""
        first = max((each for each in self.sections.values() if each <= index), default=0)
        return range(first, self.section_end(index) + 1)

    def lines_named(self, name: str, index: int, language: MacroLanguage) -> list[int]:
        """The indices of the lines by that name, in the program to which a line belongs: by their block number, or
        where those are not jumped to, by their label."""
        numbers, labels = self._places
        digits = name[1:] if name[:1] == "N" else name
        if language.jumps_to_numbers:
            found = numbers.get(digits.lstrip("0") or "0", ()) if digits.isdigit() else ()
        else:
            found = labels.get(name.upper(), ())
        own = self.section_of(index)
        return [each for each in found if each in own]

    @cached_property
    def nesting(self) -> Nesting:
        """Its loops and branches."""
        loops, open_loops = dict[tuple[int, str], LineRange](), dict[str, list[int]]()
        branches, next_parts, open_branches = dict[int, LineRange](), dict[int, int](), list[list[int]]()
        for index in range(len(self)):
            code = self.code(index)
            if code.begins is not None:
                open_loops, open_branches = {}, []
            for each in code.statements:
                if isinstance(each, Loop | For):
                    open_loops.setdefault(each.name, []).append(index)
                elif isinstance(each, EndLoop) and open_loops.get(each.name):
                    first = open_loops[each.name].pop()
                    loops[first, each.name] = LineRange(first, index)
                elif isinstance(each, If):
                    open_branches.append([index])
                elif isinstance(each, Else | ElseIf | EndIf) and open_branches and open_branches[-1][-1] < index:
                    next_parts[open_branches[-1][-1]] = index
                    open_branches[-1].append(index)
                    if isinstance(each, EndIf):
                        lines = open_branches.pop()
                        branches |= dict.fromkeys(lines, LineRange(lines[0], index))
        return Nesting(loops, branches, next_parts)


class Library:
    """The subprograms that may be called from a program, found by their names."""

    def __init__(
        self, language: MacroLanguage, syntax: Syntax, folders: Sequence[Path], control: str = "CONTROL"
    ) -> None:
        self.language, self.syntax, self.folders, self.control = language, syntax, folders, control
        self._files: dict[str, ProgramFile | None] = {}

    @cached_property
    def _listed(self) -> dict[str, Path]:
        """The files of all folders by their names in upper case; those of the first folder count."""
        found: dict[str, Path] = {}
        for folder in self.folders:
            try:
                files = sorted(folder.iterdir())
            except OSError:
                continue
            for file in files:
                found.setdefault(file.name.upper(), file)
        return found

    def find(self, name: str) -> ProgramFile | None:
        """The file that holds a subprogram; None if there is none that can be read."""
        if name not in self._files:
            names = (each.upper() for each in self.language.files(name))
            path = next((self._listed[each] for each in names if each in self._listed), None)
            self._files[name] = self._open(path) if path is not None else None
        return self._files[name]

    def find_called(
        self, call: Call, source: ProgramFile, index: int, main: ProgramFile, resolve: Resolve
    ) -> tuple[ProgramFile, int, int] | Unknown:
        """The target of a call on a line of a file: a file, and the indices of its first and last line there."""
        text = source.blocks[index].text.strip()
        first = resolve(call.target)
        last = resolve(call.last) if call.last is not None else None
        for each in (first, last):
            if isinstance(each, Unknown):
                return Unknown(f"what {text} calls is not known: {each.reason}")
        if call.kind is CallKind.LINES or (call.kind is CallKind.PROFILE and call.cycle.startswith("G")):
            own = source.section_of(index)
            begin = source.number(str(first), own.start, own.stop - 1)
            end = source.number(str(last), begin or own.start, own.stop - 1) if last is not None else own.stop - 1
            if begin is None or end is None:
                missing = first if begin is None else last
                return Absent(f"{text} names block {missing}, which is not there")
            return source, begin, end
        if call.kind is CallKind.PROGRAM:
            return self._find_program(str(first), source, main, text)
        everywhere = range(len(source))
        begin = source.label(str(first), everywhere)
        if begin is None and call.kind is CallKind.PROFILE:
            return self._find_program(str(first), source, main, text)
        end = len(source) - 1 if call.kind is not CallKind.SECTION else index - 1
        if last is not None:
            end = source.label(str(last), everywhere)
        if begin is None or end is None:
            return Absent(f"{text} names {first if begin is None else last}, which is not there")
        return source, begin, end

    def _find_program(
        self, name: str, source: ProgramFile, main: ProgramFile, text: str
    ) -> tuple[ProgramFile, int, int] | Unknown:
        for each in dict.fromkeys((source, main)):
            if name in each.sections:
                first = each.sections[name]
                return each, first, each.section_end(first)
        found = self.find(name)
        if found is None or not len(found):
            files = self.language.files(name)
            where = f"; neither is {files[0]} beside it: name its folder with --path" if files else ""
            is_command = name.replace("_", "A").isalpha() and "CALL" not in text.upper()
            if files and is_command and self.language.with_names is not None:
                where += f", or state with --setting {self.control}.words={name} that it moves nothing"
            told = f"{name} is called, and" if text.upper() == name else f"{text} calls {name}, which"
            return Unknown(f"{told} is not in this file{where}")
        first = found.sections.get(name, 0)
        return found, first, found.section_end(first) if len(found.sections) > 1 else len(found) - 1

    def _open(self, path: Path) -> ProgramFile | None:
        try:
            text = decode(read_bytes(str(path), most=MOST_OF_PROGRAM), str(path))
        except UnreadableProgramError:
            return None
        return ProgramFile(parse(text, path.name, syntax=self.syntax), self.language, is_other=True)
