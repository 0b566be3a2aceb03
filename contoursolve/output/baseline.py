"""Baselines: the findings that were there before, which are told no more."""

import json
import os
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from contoursolve.diagnostics import Diagnostic, UserError, json_text
from contoursolve.gcode import read_bytes
from contoursolve.output.listing import UNEXAMINED, Collected
from contoursolve.program import Result

SCHEMA = "contoursolve/baseline/1"

Subject = tuple[str, str, int]
"""The code of a finding, the text of its block, and its place among those of which both are equal, from 1."""


class BaselineError(UserError, ValueError):
    """A file that is no baseline; the message says why."""


def subjects_of(result: Result) -> Iterator[tuple[Diagnostic, Subject]]:
    """Each finding with what stays the same of it when lines are inserted elsewhere."""
    seen = Counter[tuple[str, str]]()
    lines = {block.line: block.text for block in result.program.blocks}
    for finding in result.diagnostics:
        subject = finding.code, lines.get(result.place(finding.span).line, "").strip()
        seen[subject] += 1
        yield finding, (*subject, seen[subject])


class Baseline:
    """The findings of programs by the paths of their files, which are relative to the folder of the baseline: how many
    there are of a code in blocks of a text."""

    def __init__(self, file: Path) -> None:
        self.file = file
        self.known: dict[str, Counter[tuple[str, str]]] = {}
        self.gone = 0
        """Findings that are in it, and not in the programs that were looked at."""

    def add(self, result: Result) -> None:
        """Take the findings of a program."""
        known = self.known.setdefault(self._path(result), Counter())
        known.update(subject[:2] for finding, subject in subjects_of(result) if _may_be_hidden(finding))

    def hidden_in(self, result: Result) -> set[int]:
        """The identities of the findings of a program that are known."""
        known = self._known(result)
        found = ((finding, *subject) for finding, subject in subjects_of(result) if _may_be_hidden(finding))
        return {id(finding) for finding, code, block, place in found if place <= known[code, block]}

    def hide(self, run: Collected) -> Collected:
        """The findings of a program without those that are known."""
        result = run.frame
        hidden = self.hidden_in(result)
        self.gone += self._known(result).total() - len(hidden)

        def left(findings: tuple[Diagnostic, ...]) -> tuple[Diagnostic, ...]:
            return tuple(each for each in findings if id(each) not in hidden)

        answers = tuple(replace(each, diagnostics=left(each.diagnostics)) for each in result.answers)
        shown = replace(result, answers=answers, diagnostics=left(result.diagnostics))
        return replace(run, frame=shown, hidden=len(hidden))

    def text(self) -> str:
        """The file's text."""
        rows = {
            path: [{"code": code, "block": block, "count": number} for (code, block), number in sorted(known.items())]
            for path, known in sorted(self.known.items())
        }
        return json_text({"schema": SCHEMA, "programs": rows}) + "\n"

    def _known(self, result: Result) -> Counter[tuple[str, str]]:
        return self.known.get(self._path(result), Counter())

    def _path(self, result: Result) -> str:
        name = result.program.name
        if name.startswith("<"):
            return name
        try:
            return Path(os.path.relpath(name, self.file.parent)).as_posix()
        except ValueError:  # on another drive of Windows
            return Path(name).resolve().as_posix()


def _may_be_hidden(finding: Diagnostic) -> bool:
    """Whether it is about a program that could be examined."""
    return not (finding.about in UNEXAMINED and finding.is_error)


def read_baseline(file: Path) -> Baseline:
    """Read a baseline. Raises BaselineError, or UnreadableProgramError for what is no file."""
    found = Baseline(file)
    data = read_bytes(str(file), "a baseline")
    try:
        document = json.loads(data)
        if not isinstance(document, dict) or document.get("schema") != SCHEMA:
            raise BaselineError(f'{file} is no baseline: its "schema" is not "{SCHEMA}"; name another file')
        for path, rows in document["programs"].items():
            found.known[path] = Counter(dict(map(_read_row, rows)))
    except (ValueError, RecursionError) as error:
        if isinstance(error, BaselineError):
            raise
        raise BaselineError(f"{file} is no baseline: it is not JSON text; name another file") from None
    except (AttributeError, KeyError, TypeError):
        raise BaselineError(f"{file} is no baseline: a finding lacks its code, block or count") from None
    return found


def _read_row(row: Mapping[str, Any]) -> tuple[tuple[str, str], int]:
    code, block, number = row["code"], row["block"], row["count"]
    if not (isinstance(code, str) and isinstance(block, str) and type(number) is int and number > 0):
        raise TypeError
    return (code, block), number
