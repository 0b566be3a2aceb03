"""Blocks of called files while the control of a program is not known, found in all languages that read calls in it."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from msgspec.structs import replace

from contoursolve.controls import CONTROLS
from contoursolve.execution import Call, CallKind, Library, MacroLanguage, Surroundings, When
from contoursolve.gcode import Block, Syntax, parse_block

MOST_FILES = 500
"""Files that are looked at."""

_REMARK = re.compile(r"[ \t]*+(?>(?:N\d++)?)[ \t]*+\(", re.IGNORECASE)
"""A line that is a comment of those who write comments in parentheses: nobody else's line begins so."""


def blocks_of_called_files(lines: Iterable[str], around: Surroundings) -> list[Block]:
    """The blocks of the files that lines call, and of those that these call; each block has the name of its file."""
    found: dict[str, list[Block]] = {}
    libraries = _libraries(around)
    waiting: list[Iterable[str]] = [lines]
    for each in waiting:
        for name, texts in _called_by(each, libraries):
            if name not in found and len(found) < MOST_FILES:
                found[name] = [replace(parse_block(text, line), file=name) for line, text in texts]
                waiting.append([text for _, text in texts])
    return [block for blocks in found.values() for block in blocks]


def _libraries(around: Surroundings) -> Sequence[tuple[MacroLanguage, Library]]:
    """A library of subprograms for each language."""
    languages: dict[str, tuple[MacroLanguage, Syntax]] = {}
    for control in CONTROLS.values():
        language = control.modes.language
        if language is not None:
            languages.setdefault(language.name, (language, control.modes.syntax))
    return [(language, Library(language, syntax, around.folders)) for language, syntax in languages.values()]


def _called_by(
    lines: Iterable[str], libraries: Sequence[tuple[MacroLanguage, Library]]
) -> Iterator[tuple[str, Sequence[tuple[int, str]]]]:
    """The names of files that lines call, and the lines of each with their numbers."""
    names: Mapping[str, set[str]] = {language.name: set() for language, _ in libraries}
    for line in lines:
        if _REMARK.match(line):
            continue
        for language, library in libraries:
            called = {*names_called(language, line.rstrip("\r\n"))} if language.may_say(line) else set[str]()
            for name in sorted(called - names[language.name]):
                names[language.name].add(name)
                source = library.find(name)
                if source is not None:
                    yield source.name, [(block.line, block.text) for block in source.blocks]


def names_called(language: MacroLanguage, line: str) -> Iterator[str]:
    """The programs that a line calls by name or number."""
    statements = list(language.read(line).statements)
    statements += (inner for each in statements if isinstance(each, When) for inner in each.then)
    for each in statements:
        if isinstance(each, Call) and each.kind in _NAMING and not each.cycle.startswith("G"):
            yield from [each.target] if isinstance(each.target, str) else []


_NAMING = (CallKind.PROGRAM, CallKind.PROFILE)
"""Calls that name a program; of those of a cycle, G71 names blocks."""
