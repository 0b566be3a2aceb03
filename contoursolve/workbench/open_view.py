"""A program that is open in a window of the workbench: its text as a page counts it, and what a page shows of it.

A page has lines that end in a line feed alone, and counts UTF-16 units from 0, as JavaScript does. The program keeps
the end of each line as it was.
"""

from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from itertools import accumulate
from pathlib import Path
from time import monotonic

from msgspec import Struct, to_builtins
from msgspec.structs import replace

from contoursolve.controls import ControlName
from contoursolve.diagnosis import Answer, rank
from contoursolve.diagnostics import Applicability, Diagnostic, Fix, Severity, Span, UserError
from contoursolve.notebook import project_settings
from contoursolve.output import effect_of
from contoursolve.postprocess import machine_of
from contoursolve.program import CONTROL, OpenProgram, changes_of
from contoursolve.reading import Control
from contoursolve.solving import Status
from contoursolve.workbench.explored import Explored
from contoursolve.workbench.fields import Data
from contoursolve.workbench.files import FileRefusedError, FileText, mark_of
from contoursolve.workbench.page_words import in_page_words


class TextEdit(Struct, frozen=True, rename={"begin": "from", "end": "to"}):
    """Two offsets in a text as a page counts it, and what stands between them instead."""

    begin: int
    end: int
    text: str


def contour_row(answer: Answer, first: int, last: int) -> Data:
    """A contour on some lines as a page lists it."""
    return {
        "line": first,
        "last": last,
        "status": answer.status.value,
        "told": answer.state,
        "title": answer.claim.form.name,
    }


LETTERS = "ABCDEFGH"
"""Of several contours that fit, in the order of the fixes that choose them."""


def is_choice(finding: Diagnostic) -> bool:
    """Whether its fixes are the several contours that fit: each writes a word more, and nothing else."""
    return finding.is_error and len(finding.fixes) > 1 and all(map(_adds, finding.fixes))


def _adds(fix: Fix) -> bool:
    rest = iter(fix.replacement)
    return bool(fix.replaced) and not fix.numbers and not fix.beside and all(each in rest for each in fix.replaced)


MOST_FINDINGS = 500
"""Of one program. A program for another control may have some in every line, and no page shows them all."""

MOMENT = 0.3
"""Seconds for which is examined before a page is told how far that is."""


class OldEditError(UserError, ValueError):
    """Edits of another text than the program has."""


class ProgramView:
    """One program of a window. `seq` counts its texts; `view` is what a page does not have yet."""

    def __init__(self, number: str, file: FileText, path: Path | None) -> None:
        self.number, self.seq, self.file, self.path = number, 0, replace(file, text=""), path
        """The path is that of its file, beside which are subprograms and the project file; None without a folder."""
        self.control: ControlName | None = None
        self.settings: Mapping[str, str] = {}
        self._project = ""
        """The trouble with the project file, if there is any."""
        self._text, self._line_end = file.text, "\n"
        self._program: OpenProgram | None = None
        self.explored: Explored | None = None
        """The contour that is in the explorer."""
        self._told: Data = {}
        self._shown: dict[int, tuple[Diagnostic, tuple[int, ...], Data]] = {}
        """The data of each finding that is shown, by the identity of its record."""

    @property
    def program(self) -> OpenProgram:
        """The program; examined anew where it was at rest."""
        if self._program is None:
            name = str(self.path or self.file.name)
            self._program = OpenProgram(self._text, control=self.control, settings=self.settings, name=name)
            self._text = ""
        return self._program

    @property
    def text(self) -> str:
        """Its text with the ends of lines as they are in the file."""
        return self._program.text if self._program is not None else self._text

    @property
    def has_changes(self) -> bool:
        """Whether its text is not that of its file."""
        try:
            return self.file.mark != mark_of(self.file.encode(self.text))
        except FileRefusedError:  # a character that the file cannot hold
            return True

    def rest(self) -> None:
        """Forget all that can be made anew from the text."""
        if self._program is not None:
            self._text, self._program, self.explored, self._shown = self._program.text, None, None, {}

    def configure(self, control: ControlName | None) -> None:
        """Read it as a program for this control, or, with None, for the one that it shows; by the settings of the
        project file as that is now."""
        found = project_settings(self.path)
        self._project, self.settings = (found, {}) if isinstance(found, str) else ("", found)
        self.control = control
        if self._program is not None:
            self._program.configure(control, self.settings)

    @property
    def line_count(self) -> int:
        """The number of lines that are examined; 0 while it rests."""
        return len(self._program.blocks) if self._program is not None else 0

    # Text --------------------------------------------------------------------------------------------------------

    @property
    def line_end(self) -> str:
        """The end of its lines; where it has only one line, that of the lines which it had before."""
        if len(self.program.blocks) > 1:
            self._line_end = self.program.line_end
        return self._line_end

    def lines(self) -> list[str]:
        """The lines as a page has them, without ends."""
        program = self.program
        return [program.line(number) for number in range(1, len(program.blocks) + 1)]

    def edit(self, edits: Iterable[TextEdit]) -> None:
        """Follow edits, all of the text as it is. Raises OldEditError where they are not."""
        lines = self.lines()
        starts = [*accumulate((_units(line) + 1 for line in lines), initial=0)]
        several = sorted(edits, key=lambda each: (each.begin, each.end), reverse=True)
        behind = starts[-1] - 1
        for each in several:
            if not 0 <= each.begin <= each.end <= behind:
                raise OldEditError("these edits are of another text; nothing was changed")
            behind = each.begin
        for each in several:
            new = self.line_end.join(_page_lines(each.text))
            self.program.edit(_place(lines, starts, each.begin), _place(lines, starts, each.end), new)
        self.seq += 1

    def replace(self, text: str) -> None:
        """Put another text of a page in the place of the whole; lines that both have keep their ends."""
        change = difference(self.lines(), _page_lines(text))
        if change is not None:
            self.edit([change])

    def changed_by(self, edits: Iterable[tuple[tuple[int, int], tuple[int, int], str]]) -> list[Data]:
        """Make edits of the program, all of the text as it is; the same as one edit of a page."""
        old = self.lines()
        for begin, end, new in sorted(edits, reverse=True):
            self.program.edit(begin, end, new)
        return self._told_as_edit(old)

    def become(self, text: str) -> list[Data]:
        """Put another text of the program in the place of the whole; the same as one edit of a page."""
        old = self.lines()
        self.program.replace(text)
        return self._told_as_edit(old)

    def _told_as_edit(self, old: Sequence[str]) -> list[Data]:
        change = difference(old, self.lines())
        if change is None:
            return []
        self.seq += 1
        return [to_builtins(change)]

    # The explorer ------------------------------------------------------------------------------------------------

    def look(self, line: int) -> Explored | None:
        """Open the explorer on the contour on a line; None where there is none."""
        answer = self.program.contour_at(line)
        self.explored = Explored(self.program, answer) if answer is not None else None
        return self.explored

    def act(self, action: Data, line: int) -> tuple[Data | None, list[Data]]:
        """Do what the explorer asks for at the contour on a line; what changes of its state (None: all of it), and the
        edits that this is of the program."""
        old, explored, is_new = self.lines(), self.explored, False
        if explored is None or explored.text != self.text or not explored.first <= line <= explored.last:
            explored, is_new = self.look(line), True
        changed = explored.answer(action) if explored is not None else None
        return None if is_new else changed, self._told_as_edit(old)

    # View --------------------------------------------------------------------------------------------------------

    def go_on(self) -> None:
        """Examine what is not up to date, for a moment."""
        end = monotonic() + MOMENT
        while not self.program.check(1) and monotonic() < end:
            pass

    def view(self, *, is_whole: bool = False, has_text: bool = False) -> Data:
        """The program as a page shows it; of the long lists only those that it was not sent before, unless
        all `is_whole`."""
        self.go_on()
        program = self.program
        found = sorted(program.found(), key=lambda each: rank(each[0])) if not program.trouble else []
        contours = [*program.contours]
        severities = [each.severity for each, _ in found]
        now: Data = {
            "findings": self._findings(found),
            "more_findings": max(len(found) - MOST_FINDINGS, 0),
            "contours": [contour_row(each.answer, each.first, each.last) for each in contours],
        }
        news = {name: value for name, value in now.items() if is_whole or self._told.get(name) != value}
        self._told = now
        control = program.control
        return {
            "id": self.number,
            "name": self.file.name,
            "seq": self.seq,
            "base": self.file.mark,
            "encoding": self.file.encoding,
            "has_order_mark": bool(self.file.order_mark),
            "line_end": self.line_end,
            "has_changes": self.has_changes,
            "control": _control(control) if control is not None else None,
            "control_from": self._source(),
            "trouble_control": "; ".join(filter(None, (self._project, program.trouble))),
            "unit": contours[0].answer.unit.value if contours else "",
            "lines": len(program.blocks),
            "examined": program.examined,
            "counts": {
                "contours": len(contours),
                "solved": sum(each.answer.status is Status.SOLVED for each in contours),
                "errors": severities.count(Severity.ERROR),
                "warnings": severities.count(Severity.WARNING),
            },
            **({"text": "\n".join(self.lines())} if is_whole or has_text else {}),
            **news,
        }

    def _source(self) -> str:
        """The source that names the control."""
        if self.program.control is None:
            return "none"
        if self.control is not None:
            return "choice"
        if self.program.is_stated:
            return "comment"
        return "project file" if CONTROL in self.settings else "program"

    def _findings(self, found: Sequence[tuple[Diagnostic, tuple[int, ...]]]) -> list[Data]:
        """The findings as a page shows them; each is written anew only where it or its lines are others."""
        shown: dict[int, tuple[Diagnostic, tuple[int, ...], Data]] = {}
        for finding, lines in found[:MOST_FINDINGS]:
            before = self._shown.get(id(finding))
            is_same = before is not None and before[0] is finding and before[1] == lines
            shown[id(finding)] = before if is_same and before else (finding, lines, self.told(finding, lines))
        self._shown = shown
        return [data for _, _, data in shown.values()]

    def told(self, finding: Diagnostic, lines: tuple[int, ...]) -> Data:
        """A finding as a page shows it, with its fixes, which replace some lines."""
        alarm, words = finding.alarm, partial(in_page_words, syntax=self.program.syntax)
        return {
            "code": finding.code,
            "severity": finding.severity.value,
            **self.stretch(finding.span),
            "message": words(finding.message),
            "notes": [*map(words, finding.notes)],
            "help": words(finding.help),
            "source": str(finding.source) if finding.source.is_of_manual else "",
            "alarm": f"alarm {alarm.number} ({alarm.evidence.value})" if alarm else "",
            "labels": [{**self.stretch(each.span), "text": words(each.text)} for each in finding.labels if each.text],
            "fixes": [self._fix(each, finding, lines, number) for number, each in enumerate(finding.fixes)],
        }

    def _fix(self, fix: Fix, finding: Diagnostic, lines: tuple[int, ...], number: int) -> Data:
        changes = self.changes_of(fix, lines)
        answer = self.program.contour_at(lines[0]) if lines else None
        # Where no contour is, none is changed.
        is_first = not fix.effect and answer is not None and answer.contour is None
        return {
            "title": fix.description,
            "kind": fix.applicability.value,
            "effect": ""
            if is_first and fix.applicability is Applicability.CHANGES_CONTOUR
            else effect_of(fix, finding),
            "lines": [{"line": line, "text": text} for line, text in changes.items()],
            **({"solution": LETTERS[number]} if is_choice(finding) and number < len(LETTERS) else {}),
        }

    def changes_of(self, fix: Fix, lines: Sequence[int]) -> Mapping[int, str | None]:
        """The texts that a fix writes, by their lines."""
        return changes_of(fix, lines, {line: self.program.line(line) for line in lines})

    def finding(self, number: int) -> tuple[Diagnostic, tuple[int, ...]]:
        """A finding of those that were shown last, and the lines that its fixes replace. Raises OldEditError."""
        if self._program is None:  # it rests, and the page still shows what was found
            self.program.check()
            self.view()
        shown = [*self._shown.values()]
        if not 0 <= number < len(shown):
            raise OldEditError(f"there is no finding {number + 1} here; nothing was changed")
        return shown[number][:2]

    def stretch(self, span: Span) -> Data:
        """A stretch of a line as a page counts it; at the begin of the program, what was stated apart from it."""
        if span.line < 1:
            return {"line": 1, "from": 0, "to": min(1, len(self.program.line(1)))}
        text = self.program.line(span.line)
        begin = _units(text[: span.column - 1])
        return {"line": span.line, "from": begin, "to": _units(text[: max(span.end_column, span.column + 1) - 1])}


def _control(control: Control) -> Data:
    return {"name": control.name, "title": control.title, "machines": [machine_of(control).value]}


def _page_lines(text: str) -> list[str]:
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def difference(old: Sequence[str], new: Sequence[str]) -> TextEdit | None:
    """The one edit that makes other lines of some, in as few characters as that takes; None if they are the same."""
    most = min(len(old), len(new))
    head = next((at for at in range(most - 1) if old[at] != new[at]), most - 1)
    most -= head
    tail = next((at for at in range(most) if old[-1 - at] != new[-1 - at]), most)
    before, after = old[head : len(old) - tail], new[head : len(new) - tail]
    # Lines that are followed by others have an end of their own.
    one, other = ("".join(f"{each}\n" for each in lines) if tail else "\n".join(lines) for lines in (before, after))
    if one == other:
        return None
    most = min(len(one), len(other))
    same = next((at for at in range(most) if one[at] != other[at]), most)
    most -= same
    behind = next((at for at in range(most) if one[-1 - at] != other[-1 - at]), most)
    begin = sum(_units(each) + 1 for each in old[:head]) + _units(one[:same])
    return TextEdit(begin, begin + _units(one[same : len(one) - behind]), other[same : len(other) - behind])


def _units(text: str) -> int:
    """The number of UTF-16 units of a text."""
    return len(text) if text.isascii() else len(text.encode("utf-16-le", "surrogatepass")) // 2


def _place(lines: Sequence[str], starts: Sequence[int], offset: int) -> tuple[int, int]:
    """The line and the column, from 1, of an offset as a page counts it."""
    index = bisect_right(starts, offset, 0, len(lines)) - 1
    text, units = lines[index], offset - starts[index]
    if text.isascii():
        return index + 1, units + 1
    return index + 1, 1 + len(
        text.encode("utf-16-le", "surrogatepass")[: 2 * units].decode("utf-16-le", "surrogatepass")
    )
