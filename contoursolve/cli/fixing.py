"""Fixes that `check` applies to programs: what is asked, what is written where, and what is told of it."""

import sys
from collections.abc import Callable, Sequence
from difflib import unified_diff
from pathlib import Path
from typing import Any

import click

from contoursolve import gcode
from contoursolve.cli.options import together
from contoursolve.cli.printing import print_bytes, say, style_of_output
from contoursolve.diagnosis import count
from contoursolve.diagnostics import Diagnostic, Fix
from contoursolve.gcode import (
    STANDARD_INPUT,
    CannotWriteError,
    OpenFile,
    Program,
    check_unprotected,
    file_in_memory,
    open_program_file,
    split_lines,
    write_whole,
)
from contoursolve.output import Collected, printable
from contoursolve.program import DECLINED, Examined, Mend, Result, Run, examined_result, likely_fixes, mend, safe_fixes

MACHINE_READ = ("json", "sarif", "github")
"""Formats that are no place for a diff."""


class Fixing:
    """The fixes of all programs of one command, applied as its options say."""

    def __init__(self, *, is_unsafe: bool, is_agreed: bool, is_diff: bool) -> None:
        self.is_unsafe, self.is_diff = is_unsafe, is_diff
        self._agreed: bool | None = True if is_agreed or is_diff else None
        """The answer to all further questions; None where each is asked."""
        self._applied = self._left = self._unsafe = 0

    @property
    def asks(self) -> bool:
        """Whether a question comes before a fix that changes the contour."""
        return self.is_unsafe and self._agreed is None

    def check_usage(self, format_: str, *, has_input: bool) -> None:
        """Raise UsageError for options that do not go together, and where nobody can be asked."""
        if self.is_diff and format_ in MACHINE_READ:
            raise click.UsageError(f"--diff prints a diff; it goes without --format {format_}")
        if self.asks and (has_input or not sys.stdin.isatty()):
            raise click.UsageError(
                "--unsafe-fixes asks before each fix that changes the contour, and there is no terminal to ask; "
                "give --yes to apply them all, or --diff to see them"
            )

    def prints_program(self, names: list[str]) -> bool:
        """Whether a program, or a diff, takes standard output."""
        return self.is_diff or not names or STANDARD_INPUT in names

    @property
    def summary(self) -> str:
        """The number of fixes, behind the counts of what was found; empty if there are none."""
        done = "would be applied" if self.is_diff else "applied"
        told = [f"{count(self._applied, 'fix', 'fixes')} {done}"] if self._applied or self.is_diff else []
        told += [f"{count(self._left, 'fix', 'fixes')} not applied"] if self._left else []
        if self._unsafe:
            what = count(self._unsafe, "fix changes", "fixes change")
            told.append(f"{what} the contour (see --unsafe-fixes)")
        return "; " + ", ".join(told) if told else ""

    def fix(
        self,
        source: OpenFile,
        text: str,
        examine: Callable[[Program], Run | Collected],
        hidden_in: Callable[[Result], set[int]],
    ) -> Collected:
        """Fix a program whose text was read, and write it where it belongs; what is found in it then, with a diff as it
        is now. Findings that are hidden are left alone. Raises UserError where it cannot be examined or written."""
        runs, hidden, alive = dict[str, Collected](), set[int](), list[Result]()
        path = None if source.stamp is None else Path(source.name)
        if path is not None and not self.is_diff:
            check_unprotected(path)

        def examined(now: str) -> Examined:
            run = examine(gcode.parse(now, source.name))
            result = run.collect()
            runs[now] = Collected(result, run.is_strict)
            # An identity is that of one finding as long as that lives.
            alive.append(result)
            hidden.update(hidden_in(result))
            return examined_result(now, result)

        def wanted(finding: Diagnostic) -> Sequence[Fix]:
            fixes = likely_fixes if self.is_unsafe else safe_fixes
            return () if id(finding) in hidden else fixes(finding)

        def agrees(mended: Mend) -> bool:
            return self._ask(mended, source.name)

        mended = mend(text, examined, wanted, agrees)
        left = [each for each in mended.left if each.trouble != DECLINED]
        self._applied, self._left = self._applied + len(mended.applied), self._left + len(left)
        if not self.is_unsafe:
            self._unsafe += sum(_is_unsafe(each) for each, _ in mended.after.found if id(each) not in hidden)
        if self.is_diff:
            _print_diff(source, text, mended.text)
        elif path is None:
            print_bytes([source.mark, source.encode(mended.text)])
        elif mended.text != text:
            _replace(path, source, text, mended.text)
        self._tell(source.name, mended.applied, left)
        return runs[text if self.is_diff else mended.text]

    def _tell(self, name: str, applied: tuple[Mend, ...], left: list[Mend]) -> None:
        """Say on standard error which fixes were applied, and why others were not."""
        style, done = style_of_output(), "would fix" if self.is_diff else "fixed"
        for each in applied:
            say(f"{_place(name, each)}: {style(done, 'bold')}: {_told(each)}", err=True)
        for each in left:
            say(f"{_place(name, each)}: {style('not fixed', 'bold')}: {_told(each)}: {each.trouble}", err=True)

    def _ask(self, mended: Mend, name: str) -> bool:
        """Whether a fix that changes the contour is agreed to."""
        if self._agreed is not None:
            return self._agreed
        style, severity = style_of_output(), mended.finding.severity.value
        head = style(f"{severity}[{mended.finding.code}]", severity)
        say(f"{_place(name, mended)}: {head}: {mended.finding.message}", err=True)
        for line, new in mended.changes.items():
            say(f"  - {printable(mended.old[line])}", err=True)
            for text in [] if new is None else new.split("\n"):
                say(f"  + {printable(text)}", err=True)
        say(f"  {mended.fix.description}", err=True)
        choices = click.Choice(["y", "n", "a", "q"])
        try:
            answer = click.prompt(_QUESTION, type=choices, default="n", show_choices=False, err=True)
        except click.Abort:
            raise KeyboardInterrupt from None
        self._agreed = {"a": True, "q": False}.get(answer)
        return answer in ("y", "a")


def _is_unsafe(finding: Diagnostic) -> bool:
    """Whether the first fix of a finding changes the contour, and no other one keeps it."""
    return bool(likely_fixes(finding)) and not safe_fixes(finding)


_QUESTION = "Apply this fix? It changes the contour: y(es), n(o), a(ll), q(uit asking)"


def _place(name: str, mended: Mend) -> str:
    return f"{printable(name)}:{mended.line}"


def _told(mended: Mend) -> str:
    """A fix without the place where the contour then ends, and the finding that it mends."""
    what, arrow, end = mended.fix.description.partition(" -> ")
    return f"{what}{'' if mended.is_safe else arrow + end} [{mended.finding.code}]"


def _replace(path: Path, source: OpenFile, old: str, new: str) -> None:
    """Write a program over itself, unless somebody else has written it meanwhile."""
    with open_program_file(path) as now:
        if (now.mark, now.encoding, now.read()) != (source.mark, source.encoding, old):
            raise CannotWriteError(f"{path} was changed while it was examined; nothing was written")
    write_whole(path, [source.mark, source.encode(new)], keeps_backup=False)


def _print_diff(source: OpenFile, old: str, new: str) -> None:
    """Print what changes in a program, as `diff -u` does, in the bytes of the program."""
    pieces = []
    for line in unified_diff(split_lines(old), split_lines(new), source.name, source.name):
        is_last = not line.endswith(("\n", "\r"))
        told = line if line.endswith("\n") else line.rstrip("\r") + "\n"
        pieces.append(source.encode(told + "\\ No newline at end of file\n" * is_last))
    print_bytes(pieces)


fix_options = together(
    click.option("--fix", "is_fix", is_flag=True, help="Write all fixes that keep the contour into the programs."),
    click.option(
        "--unsafe-fixes",
        "is_unsafe",
        is_flag=True,
        help="Like --fix, and also the first fix of a finding where it changes the contour, after a question.",
    ),
    click.option("--yes", "is_agreed", is_flag=True, help="Answer each question of --unsafe-fixes with yes."),
    click.option("--diff", "is_diff", is_flag=True, help="Show what --fix would write as a diff, and write nothing."),
)
"""The options about fixes."""


def read_fixing(options: dict[str, Any]) -> Fixing | None:
    """The fixing that a command's options ask for, which are taken out of them; None if they ask for none. Raises
    UsageError."""
    is_fix, is_unsafe, is_agreed, is_diff = (
        options.pop(name) for name in ("is_fix", "is_unsafe", "is_agreed", "is_diff")
    )
    if is_agreed and not is_unsafe:
        raise click.UsageError("--yes answers the questions of --unsafe-fixes; give both")
    return Fixing(is_unsafe=is_unsafe, is_agreed=is_agreed, is_diff=is_diff) if is_fix or is_unsafe or is_diff else None


def fixed(
    fixing: Fixing,
    name: str,
    blocks: tuple[str, ...],
    examine: Callable[[Program], Run | Collected],
    hidden_in: Callable[[Result], set[int]],
) -> Collected:
    """Fix the program of a name, or the blocks that stand in for one, as `Fixing.fix`."""
    if blocks:
        text = "".join(f"{block}\n" for block in blocks)
        return fixing.fix(file_in_memory(text, "<block>"), text, examine, hidden_in)
    if name != STANDARD_INPUT and Path(name).exists() and not (Path(name).is_file() or Path(name).is_dir()):
        raise CannotWriteError(f"{name} is not a regular file; give - for standard input")
    with open_program_file(name) as source:
        text = source.read()
    return fixing.fix(source, text, examine, hidden_in)
