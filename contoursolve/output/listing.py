"""A whole result as text: contours with their findings in the order of the program, and what was examined in all."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace as replace_fields
from heapq import heappop, heappush
from itertools import chain
from typing import TYPE_CHECKING, Any, TypeVar

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import (
    PROBABLY,
    Answer,
    ContourState,
    count,
    join,
    labels_of,
    rank,
    states_in,
    statuses_text,
)
from contoursolve.diagnostics import Applicability, Diagnostic, Fix, LateModule, Severity, check_type
from contoursolve.output.contours import contour_lines, explaining_lines, path_table, title_line
from contoursolve.output.findings import EXPLAINING, Style, finding_lines, lines_text, words_of
from contoursolve.output.plain_text import columns, printable
from contoursolve.program import ELSEWHERE, Result, Run, what_shows
from contoursolve.reading import ReadIssue
from contoursolve.solving import Contour, NoteKind, Status

if TYPE_CHECKING:
    from contoursolve import pictures, tool_radius
    from contoursolve.output import program_table
else:
    pictures, tool_radius = LateModule("contoursolve.pictures"), LateModule("contoursolve.tool_radius")
    program_table = LateModule("contoursolve.output.program_table")

MOST_ALIKE = 10
"""Findings of one code in one program that are shown where nobody asks for all."""


def listed(result: Result) -> list[Diagnostic | Answer]:
    """Contours in order, between the findings about other blocks; a contour has its own findings."""
    own = {id(finding) for answer in result.answers for finding in answer.diagnostics}
    items: list[Diagnostic | Answer] = [finding for finding in result.diagnostics if id(finding) not in own]
    items += result.answers
    return sorted(items, key=lambda each: each.lines[0] if isinstance(each, Answer) else each.span.line)


class Collected(Struct, frozen=True):
    """A result that is told as if it came as a stream."""

    frame: Result
    is_strict: bool
    hidden: int | None = None
    """Number of its findings that a baseline hides; None without a baseline."""
    tool: "tool_radius.ToolReport | None" = None
    """The paths of the tool, where one is stated."""

    def __iter__(self) -> Iterator[Answer | Diagnostic]:
        return iter(listed(self.frame))

    def moves(self) -> Counter[Status]:
        """The contours of plain moves alone beside which a tool goes."""
        return _plain_runs(self.frame, self.tool)

    def collect(self) -> Result:
        """All of it."""
        return self.frame


def listing_lines(result: Result, style: Style, *, is_explained: bool = False) -> Iterator[str]:
    """Everything about a result."""
    return _listing_lines(listed(result), result, style, is_explained=is_explained)


def stream_listing(
    run: Run | Collected,
    tally: "Totals",
    style: Style,
    *,
    is_explained: bool = False,
    is_derived: bool = False,
    is_brief: bool = False,
) -> Iterator[str]:
    """The same of a stream; that there is nothing to solve is one line. With `is_derived`, contours are calculated by
    hand. If it `is_brief`, the paths of several contours are one table."""

    def key(item: Answer | Diagnostic) -> Any:
        tally.count(item, is_explained=is_explained)
        return (item.lines[0], True) if isinstance(item, Answer) else (item.span.line, False, rank(item))

    items: Iterable[Answer | Diagnostic] = _in_order((key(item), item) for item in run)
    is_short, table = not (run.is_strict or is_explained), None
    if is_brief:
        are_several, items = _has_several(items)
        table = program_table.ProgramTable(run.frame) if are_several else None
    options = {"is_explained": is_explained, "is_short": is_short, "is_derived": is_derived}
    yield from _listing_lines(items, run.frame, style, table=table, **options)


def stream_findings(
    run: Run | Collected,
    tally: "Totals",
    style: Style,
    *,
    is_explained: bool = False,
    is_alone: bool = True,
    most: int | None = MOST_ALIKE,
) -> Iterator[str]:
    """The findings of a stream, as `check` reports them: of those in the same words the first, then the lines of the
    others; of those of one code so many, and then how many more. Only where it `is_alone` that there is nothing to
    solve is told."""
    is_short = not (run.is_strict or is_explained)
    alike = Counter[tuple[Severity, str]]()
    again: dict[tuple[Severity, str, object], list[int]] = {}

    answers, following = list[Answer](), Consequences()

    def items() -> Iterator[tuple[Any, Diagnostic]]:
        for item in _counted(run, tally, answers, is_explained=is_explained):
            findings = findings_of(item, is_explained=is_explained)
            for finding in findings if is_explained else following.without(item, findings):
                if is_alone or not is_short or not _is_nothing(finding):
                    yield (rank(finding), isinstance(item, Answer)), finding

    def shown() -> Iterator[Diagnostic]:
        for finding in _in_order(items()):
            kind, words = (finding.severity, finding.code), words_of(finding)
            is_said = words in again and not is_explained
            again.setdefault(words, []).append(finding.span.line)
            alike[kind] += not is_said
            if most is None or (alike[kind] <= most and not is_said):
                yield finding
            else:
                following.beneath(finding)

    yield from lines_of_findings(
        run.frame, shown(), style, is_explained=is_explained, is_short=is_short, following=following
    )
    yield from lines_of_findings(run.frame, following.left(), style)
    if most is not None and not is_explained:
        yield from _said_again(again, style)
    for (severity, code), number in alike.items():
        if most is not None and number > most:
            yield f"{_kind_text(severity, code, style)}: and {number - most:,} more like it; --all shows them"
            yield ""
    for answer in answers:
        yield from (title_line(answer, run.frame.program.name), *explaining_lines(answer), "")


def _said_again(said: Mapping[tuple[Severity, str, object], Sequence[int]], style: Style) -> Iterator[str]:
    """The other lines of findings in the same words, of which the first was shown."""
    for (severity, code, _), (_, *others) in said.items():
        if others:
            yield f"{_kind_text(severity, code, style)}: the same in {lines_text(others)}; --all shows each"
            yield ""


def _kind_text(severity: Severity, code: str, style: Style) -> str:
    return style(f"{severity.value}[{code}]", severity.value)


def _counted(
    run: Run | Collected, tally: "Totals", answers: list[Answer], *, is_explained: bool
) -> Iterator[Answer | Diagnostic]:
    """The items of a run, each of which is counted; those to be explained are kept."""
    for item in run:
        tally.count(item, is_explained=is_explained)
        if is_explained and isinstance(item, Answer):
            answers.append(item)
        yield item


def nothing_line(result: Result, finding: Diagnostic, style: Style) -> str:
    """That there is nothing to solve in a program, and for which control it looks; empty for another finding."""
    if finding.about is not ReadIssue.NO_CONTOUR:
        return ""
    name, role = printable(result.program.name), finding.severity.value
    if finding.severity is Severity.INFO:
        return f"{name}: no contour block, nothing to solve; --explain says how one begins"
    return f"{style(role, role)}: {name} has no contour block: {'; '.join(finding.notes)}"


def findings_of(item: Answer | Diagnostic, *, is_explained: bool = True) -> tuple[Diagnostic, ...]:
    """The findings about a contour, unless they are explained without what repeats an error; a finding itself."""
    if not isinstance(item, Answer):
        return (item,)
    return item.diagnostics if is_explained else without_repeated(item.diagnostics)


def without_repeated(findings: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """The findings about one contour without those that say what another one says."""
    errors = [each for each in findings if each.is_error]
    waits = any(each.about in WAITS for each in findings)
    return tuple(each for each in findings if not _is_repeated(each, errors, waits=waits))


WAITS = {
    ReadIssue.START_ASSUMED: ("is checked as if this were fixed", "are checked as if this were fixed"),
    ReadIssue.CONTOUR_WAITS: ("waits for this end point", "wait for this end point"),
}
"""The findings about a contour that waits for another one, and what is said of it, or of several, beneath the error
there."""


class Consequences:
    """The contours of a program that wait for another one, each to be told beneath the first error of that one."""

    def __init__(self) -> None:
        self._contours = dict[int, tuple[int, ...]]()
        """The lines of the contour of each error, by its identity."""
        self._waiting: dict[int, list[tuple[int, Diagnostic]]] = {}
        self._first = dict[tuple[int, ...], Diagnostic]()
        """The first error of each contour that has a fix with all numbers, by the lines of the contour."""

    def without(self, item: Answer | Diagnostic, findings: Sequence[Diagnostic]) -> Iterator[Diagnostic]:
        """The findings about a contour, or another one, without what is told beneath an error."""
        for finding in findings:
            if finding.about not in WAITS:
                yield finding
            elif isinstance(item, Answer):
                for line in {label.span.line for label in finding.labels} - {*item.lines}:
                    self._waiting.setdefault(line, []).append((item.lines[0], finding))
            if finding.is_error and isinstance(item, Answer):
                self._contours[id(finding)] = item.lines
                if any(fix.applicability is not Applicability.PLACEHOLDER for fix in finding.fixes):
                    self._first.setdefault(item.lines, finding)

    def is_mended_above(self, finding: Diagnostic) -> bool:
        """Whether the fixes of the first error of its contour, each of which makes one, mend an error that has none."""
        first = self._first.get(self._contours.get(id(finding), ()))
        return not finding.fixes and first is not None and first is not finding

    def beneath(self, error: Diagnostic) -> str:
        """The contours that wait for an error, in one line; empty where another error has said it."""
        found = [each for line in self._contours.pop(id(error), ()) for each in self._waiting.pop(line, ())]
        told = []
        for about, (one, several) in WAITS.items():
            lines = [str(line) for line in sorted({line for line, waits in found if waits.about is about})]
            named = f"program line{'s' * (len(lines) > 1)} {join(lines)}"
            told += [f"{named} {several if len(lines) > 1 else one}"] if lines else []
        return "; ".join(told)

    def left(self) -> Iterator[Diagnostic]:
        """The findings about contours that wait for one of which no error is told."""
        while self._waiting:
            yield from (waits for _, waits in self._waiting.pop(min(self._waiting)))


def _is_repeated(finding: Diagnostic, errors: Sequence[Diagnostic], *, waits: bool) -> bool:
    """Whether a finding says what another one of the same contour says."""
    match finding.about:
        case ReadIssue.POSITION_UNKNOWN:
            return waits
        case ReadIssue.UNDERDETERMINED:
            return bool(errors) and finding.severity is Severity.INFO
        case ReadIssue.POINT_MISSING:
            labels = (label for each in errors for label in each.labels if label.text.startswith(PROBABLY))
            return finding.span in {label.span for label in labels}
        case NoteKind.WORDS_AGREE:
            return any({*finding.addresses} <= {*each.addresses} for each in errors)
    return False


def short_findings(result: Result) -> list[Diagnostic]:
    """The findings of a result without what repeats an error."""
    every, shown = (
        {id(each) for answer in result.answers for each in findings_of(answer, is_explained=is_explained)}
        for is_explained in (True, False)
    )
    return [each for each in result.diagnostics if id(each) not in every - shown]


_Item = TypeVar("_Item")

_HELD = 1_000
"""Contours and findings that wait for others that belong before them: what is told late may be about an early line."""


def _in_order(items: Iterable[tuple[Any, _Item]]) -> Iterator[_Item]:
    """Items by their keys, as far as so many at a time allow."""
    held: list[tuple[Any, int, _Item]] = []
    for number, (key, item) in enumerate(items):
        heappush(held, (key, number, item))
        if len(held) > _HELD:
            yield heappop(held)[2]
    while held:
        yield heappop(held)[2]


def _listing_lines(
    items: Iterable[Diagnostic | Answer],
    result: Result,
    style: Style,
    *,
    is_explained: bool,
    is_short: bool = False,
    is_derived: bool = False,
    table: "program_table.ProgramTable | None" = None,
) -> Iterator[str]:
    for item in items:
        findings = findings_of(item, is_explained=is_explained)
        if table and isinstance(item, Answer) and program_table.is_told_by_path(item):
            yield from table.rows(item)
        elif isinstance(item, Answer):
            yield from _interrupting(table)
            yield from contour_lines(item, result, is_explained=is_explained, is_derived=is_derived)
            if not is_explained:
                # It stands beside its contour: one line is enough.
                yield from (line for each in findings if each.about in WAITS for line in (f"  {each.message}", ""))
                findings = tuple(each for each in findings if each.about not in WAITS)
        if findings:
            yield from _interrupting(table)
        yield from lines_of_findings(result, findings, style, is_explained=is_explained, is_short=is_short)
    if table:
        yield from table.closing()


def _has_several(items: Iterable[Answer | Diagnostic]) -> tuple[bool, Iterator[Answer | Diagnostic]]:
    """Look as far as the second contour: say whether there is one, and give all items again."""
    iterator, held, contours = iter(items), list[Answer | Diagnostic](), 0
    for item in iterator:
        held.append(item)
        contours += isinstance(item, Answer)
        if contours > 1:
            break
    return contours > 1, chain(held, iterator)


def _interrupting(table: "program_table.ProgramTable | None") -> Iterator[str]:
    """A blank line between rows of a table and what is told in full."""
    if table and table.interrupt():
        yield ""


def lines_of_findings(
    result: Result,
    findings: Iterable[Diagnostic],
    style: Style,
    *,
    is_explained: bool = False,
    is_short: bool = False,
    explaining: str = EXPLAINING,
    following: Consequences | None = None,
) -> Iterator[str]:
    """The lines of findings, each with the program's lines that it marks; `explaining` is the command that explains
    them. If it `is_short`, that there is nothing to solve is one line."""
    told: tuple[Fix, ...] = ()
    for finding in findings:
        shown = finding
        if is_short and (line := nothing_line(result, finding, style)):
            yield line
            continue
        is_mended = following is not None and following.is_mended_above(finding)
        if is_mended or (told and finding.fixes == told):
            notes = ("the fixes above mend this, too", *finding.notes)
            shown = replace(finding, fixes=(), help=finding.help if is_explained else "", notes=notes)
        told = finding.fixes or told
        sources = sources_of(result, finding)
        name = result.program.name
        beneath = following.beneath(finding) if following else ""
        yield from finding_lines(
            shown, name, sources, style, is_explained=is_explained, explaining=explaining, following=beneath
        )


def sources_of(result: Result, finding: Diagnostic) -> dict[int, str]:
    """The texts of the lines that a finding marks, by number."""
    blocks = result.program.blocks
    first = blocks[0].line if blocks else 1
    numbers = {label.span.line for label in finding.labels}
    sources = {number: blocks[number - first].text for number in numbers if 0 <= number - first < len(blocks)}
    if result.start:
        sources[0] = result.start.text
    return sources | {fact.span.line: fact.text for fact in result.facts}


def closing_lines(result: Result, tally: "Totals | None" = None) -> Iterator[str]:
    """For which control a program was read and what shows that, and what was found in all: of a result that is only
    the frame of a stream, as it was counted."""
    if result.control is not None:
        own = CONTROLS.get(result.control)
        sign = what_shows(result.program.blocks, own) if own else ""
        whence = f"from {sign}" if sign else "as told above" if result.is_concluded else "as asked for"
        yield f"control: {own.title if own else result.control} ({whence})"
    yield (tally or _tally(result, is_explained=True)).line(1)


def summary_line(result: Result, *, is_explained: bool = False, tool: "tool_radius.ToolReport | None" = None) -> str:
    """The last line of a listing: the contours examined, with those of plain moves beside a tool, and the findings.
    Nothing examined is not the same as nothing found."""
    tally = _tally(result, is_explained=is_explained)
    tally.statuses.update(_plain_runs(result, tool))
    return tally.line(1)


def _plain_runs(result: Result, tool: "tool_radius.ToolReport | None") -> Counter[Status]:
    solved = {line for answer in result.answers for line in answer.lines}
    runs = tool.runs if tool is not None else ()
    return Counter(Status.SOLVED for each in runs if solved.isdisjoint(each.run.lines))


UNEXAMINED = (ReadIssue.NO_CONTOUR, ReadIssue.CONTROL_UNKNOWN)


class Totals(Struct, frozen=True):
    """Counts of contours by status, of findings by severity, and of contours that were not examined or checked."""

    statuses: Counter[Status] = field(default_factory=Counter)
    severities: Counter[Severity] = field(default_factory=Counter)
    unexamined: Counter[str] = field(default_factory=Counter)
    """Programs that look as if they had contours, but for no control that was tried."""
    waiting: Counter[Status] = field(default_factory=Counter)
    """Contours that are not checked, because nobody knows where they begin."""

    hidden: Counter[str] = field(default_factory=Counter)
    """Findings that a baseline hides, by the programs."""

    elsewhere: Counter[str] = field(default_factory=Counter)
    """Findings about contours of other files, which programs call."""

    def count(self, item: Answer | Diagnostic, *, is_explained: bool = True) -> None:
        """Count a contour with its findings, or a finding."""
        if isinstance(item, Answer):
            self.statuses[item.status] += 1
            if any(each.about is ReadIssue.CONTOUR_WAITS for each in item.diagnostics):
                self.waiting[item.status] += 1
        for each in findings_of(item, is_explained=is_explained):
            if _is_nothing(each):
                continue
            if each.about not in WAITS:
                self.severities[each.severity] += 1
            self.elsewhere[each.code] += each.about in ELSEWHERE
            if each.about in UNEXAMINED and each.is_error:
                self.unexamined[each.code] += 1

    def add(self, other: "Totals") -> None:
        """Count what was counted in another program, too."""
        self.statuses.update(other.statuses)
        self.severities.update(other.severities)
        self.unexamined.update(other.unexamined)
        self.waiting.update(other.waiting)
        self.elsewhere.update(other.elsewhere)
        self.hidden.update(other.hidden)

    @property
    def has_something(self) -> bool:
        """Whether there is a contour or a finding."""
        return bool(self.statuses or self.severities or self.hidden) and not (self.unexamined and not self.statuses)

    def line(self, programs: int) -> str:
        """The counts as one line, for a number of programs."""
        total, states = self.statuses.total(), states_in(self.statuses)
        found = ", ".join(count(self.severities[each], each.value) for each in Severity if self.severities[each])
        number = self.waiting.total()
        waiting = f"; {count(number, 'contour waits', 'contours wait')} for an end point" if number else ""
        several = f"{count(programs, 'program')}, " if programs > 1 else ""
        hidden = f"; {self.hidden.total():,} hidden by the baseline" if self.hidden.total() else ""
        told = f"{found or ('no other problems' if hidden else 'no problems')}{waiting}{hidden}"
        if not total:
            own = " of its own" if self.elsewhere.total() else ""
            return f"{several}no contour{own} examined; {told}"
        if len(states) > 1:
            return f"{several}{count(total, 'contour')}: {statuses_text(self.statuses)}; {told}"
        (state,) = states
        if state in (ContourState.SOLVED, ContourState.CANNOT_BE_CUT):
            return f"{several}{count(total, 'contour')} {state.value}, {told}"
        return f"{several}{count(total, 'contour')}: {state.value}; {told}"


def _is_nothing(finding: Diagnostic) -> bool:
    """Whether it only remarks that there is nothing to solve."""
    return finding.about is ReadIssue.NO_CONTOUR and finding.severity is Severity.INFO


def beside_of(
    tool: "tool_radius.ToolReport | None", answer: Answer | None = None
) -> "tuple[pictures.ToolDrawing, ...]":
    """The drawings of a tool beside the contours of a program, in each plane, or beside one of them."""
    if tool is None:
        return ()
    from contoursolve.output.tool_picture import parts_beside  # noqa: PLC0415 - few programs state a tool
    from contoursolve.tool_radius import ToolReport  # noqa: PLC0415 - the same

    check_type("tool", tool, ToolReport, "the ToolReport of `solve_with_tool`")

    return parts_beside(tool, answer)


def tool_lines(report: "tool_radius.ToolReport", result: Result) -> Iterator[str]:
    """The path of the tool beside each contour of a program."""
    from contoursolve.tool_radius import title_of  # noqa: PLC0415 - few programs state a tool

    for each in report.runs:
        begin = f"{printable(result.program.name)}:{each.run.lines[0]}"
        if each.path is None:
            yield from (f"{begin}: {each.title}: it does not fit", "")
            continue
        table = path_table(_named_by_lines(each, result), each.run.unit)
        yield f"{begin}: {title_of(each)}"
        yield from (*columns([("", "", *table.header[2:]), *table.rows], table.left), "")


def _named_by_lines(each: "tool_radius.ToolRun", result: Result) -> Contour:
    """The path of a tool, each element called by what it goes along."""
    answers = {line: answer for answer in result.answers for line in answer.lines}
    labels = {line: labels_of(answer.profile) for line, answer in answers.items()}

    def called(name: str, line: int) -> str:
        return labels.get(line, {}).get(name, f"{name} (program line {line})")

    assert each.path is not None
    names = (each.run.travels[piece.element].line for piece in each.pieces)
    elements = zip(each.path.elements, names, strict=True)
    return replace_fields(
        each.path, elements=tuple(replace(element, name=called(element.name, line)) for element, line in elements)
    )


def table_lines(programs: Sequence[tuple[str, Totals | None]]) -> Iterator[str]:
    """Several programs by their names, the worst first; None stands for one that could not be read. Those without
    contours and findings are counted."""
    shown = [(name, each) for name, each in programs if each is None or each.unexamined or each.has_something]
    rows = [_row(name, each) for name, each in sorted(shown, key=lambda row: _badness(row[1]))]
    if rows:
        yield from columns([("program", "contours", "errors", "warnings"), *rows], indent="")
    if len(shown) < len(programs):
        yield f"{count(len(programs) - len(shown), 'program')} without contour blocks"
    yield ""


def _badness(totals: Totals | None) -> tuple[int, ...]:
    if totals is None or totals.unexamined:
        return (0,)
    return (1, -totals.severities[Severity.ERROR], -totals.severities[Severity.WARNING])


def _row(name: str, totals: Totals | None) -> tuple[str, ...]:
    if totals is None or totals.unexamined:
        return (printable(name), "not examined", "", "")
    numbers = (totals.statuses.total(), totals.severities[Severity.ERROR], totals.severities[Severity.WARNING])
    return (printable(name), *map(str, numbers))


def _tally(result: Result, *, is_explained: bool) -> Totals:
    findings = [
        each for each in (result.diagnostics if is_explained else short_findings(result)) if not _is_nothing(each)
    ]
    return Totals(
        Counter(answer.status for answer in result.answers), Counter(finding.severity for finding in findings)
    )
