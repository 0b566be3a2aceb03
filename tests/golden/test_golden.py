"""Every byte that the commands print and write is as it was when `tests/golden/record.py` recorded it."""

import re
from collections.abc import Iterator
from difflib import unified_diff
from functools import cache
from html import unescape
from pathlib import Path

import click
import pytest
from record import FOLDER, Case, Parts, paths, read, run, stored, written

from contoursolve.__main__ import commands
from contoursolve.controls import CONTROLS

UNRECORDED = {
    "lsp": "what it says while it examines depends on the time; tests/cli/test_lsp.py asks it",
    "family --dask": "needs a cluster",
}
"""What no record has, each with the reason."""


@pytest.mark.parametrize("path", [pytest.param(each, id=each.relative_to(FOLDER).as_posix()) for each in paths()])
def test_what_a_command_prints_and_writes_is_as_recorded(path: Path, tmp_path: Path) -> None:
    expected = stored(path)
    case, _ = read(expected)
    found = written(case, run(case, tmp_path))
    assert found == expected, "\n".join(unified_diff(expected.split("\n"), found.split("\n"), "recorded", "now", n=2))


MOST_RECORDS, MOST_BYTES = 800, 4_000_000


def test_the_records_have_every_command_and_option_every_control_and_every_rule_and_are_few() -> None:
    texts = {path: stored(path) for path in paths()}
    recorded = {each for path, text in texts.items() for each in covered(path.stem, *read(text))}
    assert {*wanted()} - recorded == UNRECORDED.keys()
    assert len(texts) <= MOST_RECORDS
    assert sum(map(len, map(str.encode, texts.values()))) <= MOST_BYTES


LINE = re.compile(r"(?<!program )\bline \d+\b|(?<!program )\blines \d+\b")
POINT = re.compile(
    r"^ *(?:(?:error|warning|info)\[.*|= .*)(?<![\w.=+-])([PV]\d+) (?:is|are|can|does|do) ", re.MULTILINE
)
QUOTED = re.compile(r"^ *(?:--fact )?\d* [|].*$|^error\[fact-unreadable\].*$", re.MULTILINE)
"""Lines of the program, and what is said about a fact, which has the names that facts have."""


def test_a_line_is_a_line_of_the_program_and_findings_name_points_by_where_they_lie() -> None:
    wrong = set[tuple[str, str]]()
    for path in paths():
        case, parts = read(stored(path))
        # The list of facts, and what is said about a fact, have the names that facts have.
        reads = " ".join((*case.arguments, case.stdin, *case.files.values()))
        for head, text in parts.items():
            is_page = head.endswith((".svg", ".html"))
            if "facts" in case.arguments or not (is_page or (head.startswith("std") and is_text(text))):
                continue
            shown = QUOTED.sub("", unescape(re.sub(r"<[^>]*>", "\n", text)) if is_page else text)
            # A long remark of a picture goes on in another line.
            shown = re.sub(r"program\s+line", "program line", shown)
            told = {found[0] for found in LINE.finditer(shown)}
            told |= {found[1] for found in POINT.finditer(shown)} if "contoursolve:" not in reads else set()
            wrong |= {(path.relative_to(FOLDER).as_posix(), each) for each in told if each not in reads}
    assert not wrong


def is_text(text: str) -> bool:
    """Whether a text is for readers, and no document of JSON."""
    return not text.startswith(("{", "["))


@cache
def known() -> dict[str, click.Command]:
    """All commands."""
    group, context = commands(), click.Context(commands())
    return {name: group.get_command(context, name) for name in group.list_commands(context)}


def wanted() -> Iterator[str]:
    """What the records are to have: each command with each choice of each option; each control; each rule as a finding
    on a control."""
    yield from CONTROLS
    for name, command in known().items():
        yield name
        for option in command.params:
            if isinstance(option, click.Option):
                choices = option.type.choices if isinstance(option.type, click.Choice) else [""]
                yield from (f"{name} {option.opts[-1]} {each}".strip() for each in choices)
    yield from {rule.code for each in CONTROLS.values() for rule in each.catalogue}


def covered(name: str, case: Case, parts: Parts) -> Iterator[str]:
    """What a record has of it."""
    runs, control = (*case.before, case.arguments), name.rpartition(".")[2]
    for command, *arguments in runs:
        yield command
        for option in known()[command].params if command in known() else ():
            given = [value for word, value in zip(arguments, [*arguments[1:], ""], strict=True) if word in option.opts]
            if isinstance(option.type, click.Choice) and isinstance(option.default, str):
                given = given or [option.default]
            yield from (f"{command} {option.opts[-1]} {value}" for value in given)
            yield from [f"{command} {option.opts[-1]}"] if given else ()
    if control in CONTROLS and case.arguments[0] not in ("rules", "explain", "facts", "help"):
        yield control
        text = "\n".join(map(parts.get, ("stdout", "stderr"), ("", "")))
        yield from re.findall(r'(?:^(?:error|warning|info)\[|"code": "|title=)([\w-]+)', text, re.MULTILINE)
