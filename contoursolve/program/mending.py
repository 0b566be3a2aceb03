"""Fixes applied to the text of a program: what each writes, and all of those that are wanted, each one checked."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Applicability, Diagnostic, Fix, Severity, checked, hash_of
from contoursolve.gcode import split_lines
from contoursolve.program.open_program import OpenProgram
from contoursolve.program.pipeline import Result
from contoursolve.solving import Contour
from contoursolve.tolerance import AGREEMENT

Changes = Mapping[int, str | None]
"""Texts by the lines in whose place they go, with a line feed between several; None drops a line."""

FoundValues = tuple[Diagnostic, tuple[int, ...]]
"""A finding, and the lines that its fixes replace."""


@checked
def changes_of(fix: Fix, lines: Sequence[int], old: Mapping[int, str]) -> Changes:
    """The changes that a fix makes to the lines that it replaces and to those beside; `old` are texts of lines, at
    least of the first."""
    texts = {**old, **{each.span.line: each.old for each in fix.beside}}
    return {line: new or None for line, new in sorted(fix.by_line(lines).items()) if new != texts[line]}


def changed(text: str, changes: Changes) -> str:
    """A program's text with other lines; what is between and around them keeps its characters and line ends."""
    lines, ends = split_lines(text), list[str]()
    for line in lines:
        ends.append(line[len(line.rstrip("\r\n")) :])
    for number, new in changes.items():
        # The last line may have no end.
        between = ends[number - 1] or (ends[number - 2] if number > 1 else "") or "\n"
        lines[number - 1] = "" if new is None else new.replace("\n", between) + ends[number - 1]
    return "".join(lines)


class Mend(Struct, frozen=True):
    """One fix of one finding, and the changes that it makes to a program as it is at that moment; `old` are the texts
    of the lines that it replaces."""

    finding: Diagnostic
    fix: Fix
    old: Mapping[int, str]
    changes: Changes
    trouble: str = ""
    """The reason why it was not applied, if it was tried."""

    @property
    def line(self) -> int:
        """The first line that it changes."""
        return min(self.changes)

    @property
    def is_safe(self) -> bool:
        """Whether the contour stays the same."""
        return self.fix.applicability is Applicability.SAFE

    @property
    def key(self) -> tuple[int, str, str]:
        """The mark that tells it from others, as long as no lines move."""
        texts = [self.fix.replacement, *(each.text for each in self.fix.beside)]
        return min(self.old), self.finding.code, "\n".join(texts)


def _moved(line: int, changes: Changes) -> int:
    """The number of a line when changes are made, none of which is about it."""
    return line + sum(map(_growth, (new for at, new in changes.items() if at < line)))


def _growth(new: str | None) -> int:
    return -1 if new is None else new.count("\n")


class Examined(Struct, frozen=True):
    """A program's text and its examination: the findings, and the contours by their first lines, None for one that is
    not solved."""

    text: str
    found: tuple[FoundValues, ...]
    contours: Mapping[int, Contour | None]

    def mends(self, wanted: "Wanted") -> Iterator[list[Mend]]:
        """For each finding the fixes that are wanted, in order; a fix that writes what is there already is none."""
        lines = split_lines(self.text)
        for finding, places in self.found:
            fixes = wanted(finding) if min(places) > 0 and max(places) <= len(lines) else ()
            yield [each for fix in fixes if (each := self._mend(finding, fix, places, lines)) is not None]

    def _mend(self, finding: Diagnostic, fix: Fix, places: Sequence[int], lines: Sequence[str]) -> Mend | None:
        """A fix of a finding; None if it changes nothing, or is one of other texts than there are."""
        beside = {each.span.line: each.old for each in fix.beside}
        old = {line: "".join(lines[line - 1 : line]).rstrip("\r\n") for line in (*places, *beside)}
        made = Mend(finding, fix, old, changes_of(fix, places, old))
        is_there = fix.replaced == "\n".join(old[line] for line in places)
        return made if made.changes and is_there and all(old[line] == beside[line] for line in beside) else None


def examined_result(text: str, result: Result) -> Examined:
    """The same of the result of a text."""
    found = tuple((each, result.lines_of(each)) for each in result.diagnostics)
    return Examined(text, found, {each.lines[0]: each.contour for each in result.answers})


def _examined_open(program: OpenProgram) -> Examined:
    """The same of an open program, when all of it is examined."""
    contours = {each.first: each.answer.contour for each in program.contours}
    found = sorted(program.found(), key=lambda each: each[0].span)
    return Examined(program.text, tuple(found), contours)


Wanted = Callable[[Diagnostic], Sequence[Fix]]
"""The fixes of a finding that are wanted: the first of them that leaves the program no worse is applied."""


@checked
def safe_fixes(finding: Diagnostic) -> list[Fix]:
    """The fixes of a finding that keep the contour; none behind a likelier one that changes it, whose slip they would
    hide."""
    if finding.fixes and finding.fixes[0].applicability is not Applicability.SAFE:
        return []
    return [fix for fix in finding.fixes if fix.applicability is Applicability.SAFE]


@checked
def likely_fixes(finding: Diagnostic) -> list[Fix]:
    """The first fix of a finding, unless its number is still to be chosen; then those that keep the contour."""
    first = [fix for fix in finding.fixes[:1] if fix.applicability is not Applicability.PLACEHOLDER]
    return [*first, *(fix for fix in safe_fixes(finding) if fix not in first)]


class FixedProgram(Struct, frozen=True):
    """A program with its fixes applied.

    Attributes:
        text: the program as it is then; line ends and all other characters stay as they are.
        applied: the fixes that were applied, in their order.
        left: the fixes that were left, each with its `trouble`.
        after: the findings of the program as it is then.
    """

    text: str
    applied: tuple[Mend, ...]
    left: tuple[Mend, ...]
    after: Examined

    __hash__ = hash_of


DECLINED = "declined"
"""The trouble of a fix that was not agreed to."""


def mend(
    text: str,
    examine: Callable[[str], Examined],
    wanted: Wanted = safe_fixes,
    agrees: Callable[[Mend], bool] = lambda _: True,
) -> FixedProgram:
    """Apply all wanted fixes to a program, and then those that are wanted of the program that this makes, until none is
    left. One that changes the contour is applied only if `agrees` says so.

    After each fix the program is examined anew: its error is gone, and no new one has come; where it keeps the contour,
    all contours are where they were. Otherwise it is left. Several are applied at once if they change the contours of
    different lines and keep them. Each one that is applied makes errors or warnings fewer, so that there is an end.
    """
    now, applied, left = examine(text), list[Mend](), dict[tuple[int, str, str], Mend]()
    most = _AT_ONCE
    while batch := _next(now, wanted, left, most):
        if not batch[0].is_safe and not agrees(batch[0]):
            left[batch[0].key] = replace(batch[0], trouble=DECLINED)
            continue
        changes = {line: new for each in batch for line, new in each.changes.items()}
        after = examine(changed(now.text, changes))
        trouble = _trouble(now, after, batch) or _moves_contours(now, after, batch, changes)
        if trouble and len(batch) > 1:
            most = len(batch) // 2
            continue
        most = min(2 * most, _AT_ONCE)
        if trouble:
            left[batch[0].key] = replace(batch[0], trouble=trouble)
            continue
        applied += batch
        left = {(_moved(line, changes), code, new): each for (line, code, new), each in left.items()}
        now = after
    return FixedProgram(now.text, tuple(applied), tuple(left.values()), now)


_AT_ONCE = 1 << 16
"""Fixes that are applied before the program is examined again."""


@checked
def mend_open(program: OpenProgram, wanted: Wanted = safe_fixes) -> FixedProgram:
    """The same of a program that is open in an editor, which stays as it is."""
    copy = program.copy()

    def examine(text: str) -> Examined:
        copy.replace(text)
        copy.check()
        return _examined_open(copy)

    return mend(program.text, examine, wanted)


def _next(now: Examined, wanted: Wanted, left: Iterable[tuple[int, str, str]], most: int) -> list[Mend]:
    """The next fixes to apply: so many that keep the contour and touch different lines, or one that changes it."""
    first = [next((each for each in mends if each.key not in left), None) for mends in now.mends(wanted)]
    safe, taken = list[Mend](), set[int]()
    for each in first:
        if each is not None and each.is_safe and len(safe) < most and taken.isdisjoint(each.old):
            safe.append(each)
            taken.update(each.old)
    return safe or [each for each in first if each is not None and not each.is_safe][:1]


_FINDINGS = {Severity.ERROR: "error", Severity.WARNING: "warning"}


def _trouble(before: Examined, after: Examined, batch: Sequence[Mend]) -> str:
    """The reason why fixes make a program worse; empty if they do not. Behind an error there may be a warning."""
    allowed, now = _counts(before), _counts(after)
    worst = Severity.ERROR
    for each in batch:
        allowed[each.finding.severity, each.finding.code] -= 1
        worst = worst if each.finding.is_error else Severity.WARNING
    for severity, code in now:
        is_counted = severity is Severity.ERROR or (severity is Severity.WARNING and worst is Severity.WARNING)
        is_mended = any((each.finding.severity, each.finding.code) == (severity, code) for each in batch)
        if (is_counted or is_mended) and now[severity, code] > allowed[severity, code]:
            return f"{severity.value}[{code}] is still there" if is_mended else f"it brings {severity.value}[{code}]"
    return ""


def _counts(examined: Examined) -> Counter[tuple[Severity, str]]:
    return Counter((finding.severity, finding.code) for finding, _ in examined.found)


def _moves_contours(before: Examined, after: Examined, batch: Sequence[Mend], changes: Changes) -> str:
    """That fixes which keep the contours move one of them; empty if they do not. A contour in whose lines something is
    written may begin in a line of its own, or be a plain move."""
    if not all(each.is_safe for each in batch):
        return ""
    touched = {line for each in batch for line in each.old}
    for line, contour in before.contours.items():
        first = _moved(line, changes)
        lines = range(first, first + 1 + max(_growth(changes.get(line, "")), 0))
        there = next(filter(None, (after.contours.get(at) for at in lines)), None)
        is_plain = there is None and line in touched
        if contour is not None and not is_plain and (there is None or contour.deviation(there) > AGREEMENT):
            return f"it moves the contour in program line {line}"
    return ""
