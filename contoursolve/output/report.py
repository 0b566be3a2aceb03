"""A report: one page of HTML about a whole program, for a screen or for paper. It loads nothing and runs no script, so
that it opens anywhere and says the same in ten years."""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import dist
from pathlib import PurePath
from typing import TYPE_CHECKING

import htpy as h
from markupsafe import Markup
from msgspec import Struct

from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import Answer, Policy, coordinates, count
from contoursolve.diagnostics import Diagnostic, Evidence, Label, LateModule, Severity, Span, checked
from contoursolve.gcode import Block, own_comments
from contoursolve.output.contours import given_table, path_of
from contoursolve.output.findings import alike
from contoursolve.output.html import (
    checks_table,
    figure,
    finding_element,
    lighting_rules,
    page_style,
    path_element,
    remarks,
    short,
    solutions_table,
    style_rules,
    table,
    words_table,
    worst_of,
)
from contoursolve.output.listing import sources_of, summary_line
from contoursolve.output.plain_text import Name, printable
from contoursolve.pictures import About, named_words
from contoursolve.program import Result
from contoursolve.tolerance import LENGTH

if TYPE_CHECKING:
    from contoursolve import tool_radius
else:
    tool_radius = LateModule("contoursolve.tool_radius")

_POLICY = "default-src 'none'; style-src 'unsafe-inline'"
"""Tells the browser to load and to run nothing."""

_GRADES = {
    Evidence.PRINTED: "read on a page of the control's manual",
    Evidence.DERIVED: "follows from printed facts by geometry or symmetry",
    Evidence.ASSUMED: "our choice where the pages that we have are silent",
}

_HINT = "Point at a word, a row or a finding, or go to its row with the Tab key: all that belongs to it is marked."

LONG = 40
"""Contours of a page on which those that are far away are not laid out before they come near."""

Progress = Callable[[], object]


Marked = tuple[Label, Diagnostic]
"""A stretch of a line, and the finding that marks it."""


class PageAnchors(Struct, frozen=True):
    """The addresses on the page: the lines that it shows, the numbers of contours by line and of findings by identity,
    both from 1, and what findings mark, by line; and the tool whose path is shown."""

    lines: frozenset[int]
    contours: Mapping[int, int]
    findings: Mapping[int, int]
    marks: Mapping[int, Sequence[Marked]]
    tool: "tool_radius.ToolReport | None" = None
    shown: frozenset[int] = frozenset()
    """The numbers of the contours that have a picture and tables of their own."""

    def contour(self, number: int) -> str:
        """The address of a contour: its own part of the page, or its row in the table of points."""
        return f"#contour-{number}" if number in self.shown else f"#points-{number}"

    def line(self, number: int) -> str | None:
        """The address of a line; None for what was stated apart from the program."""
        return f"#line-{number}" if number in self.lines else None

    def finding(self, finding: Diagnostic) -> str:
        """The name of a finding."""
        return f"finding-{self.findings[id(finding)]}"


def _find_places(result: Result, tool: "tool_radius.ToolReport | None", *, is_explained: bool) -> PageAnchors:
    """The places of everything that a result holds. A contour has a part of its own where it is asked for, alone, or
    has errors."""
    numbered = list(enumerate(result.answers, 1))
    marks: dict[int, list[Marked]] = {}
    for finding in result.diagnostics:
        for label in finding.labels:
            marks.setdefault(label.span.line, []).append((label, finding))
    return PageAnchors(
        frozenset(block.line for block in result.program.blocks),
        {line: number for number, answer in reversed(numbered) for line in answer.lines},  # of several, the first
        {id(each): number for number, each in enumerate(result.diagnostics, 1)},
        marks,
        tool,
        frozenset(
            number
            for number, answer in numbered
            if is_explained
            or len(numbered) == 1
            or answer.contour is None
            or any(e.is_error for e in answer.diagnostics)
        ),
    )


@checked
def report_page(
    result: Result,
    version: str,
    progress: Progress = lambda: None,
    *,
    is_explained: bool = False,
    tool: "tool_radius.ToolReport | None" = None,
    date: str = "",
) -> Iterator[str]:
    """The page in pieces, explained with equations and a picture of each contour, with the path of a tool; `progress`
    is called after each contour, `date` is that of the file."""
    places = _find_places(result, tool, is_explained=is_explained)
    yield from _page(result, version, progress, places, date, is_explained=is_explained).iter_chunks()
    yield "\n"


def _page(
    result: Result, version: str, progress: Progress, places: PageAnchors, date: str, *, is_explained: bool
) -> h.Element:
    lighting = _lighting(result)
    has_chains = any(answer.claim.form.is_general for answer in result.answers)
    style = page_style(has_chains=has_chains, has_tool=places.tool is not None)
    summary = summary_line(result, is_explained=True, tool=places.tool)
    name = short(PurePath(result.program.name).name)
    return h.html(lang="en")[
        h.head[
            h.meta(charset="utf-8"),
            h.meta(http_equiv="Content-Security-Policy", content=_POLICY),
            h.meta(name="viewport", content="width=device-width, initial-scale=1"),
            h.meta(name="color-scheme", content="light dark"),
            h.meta(name="generator", content=f"contoursolve {version}"),
            h.title[f"{name}: contours"],
            # Our own files and names.
            h.style[Markup(style + style_rules("report.css") + lighting)],
        ],
        h.body(".contoursolve")[
            h.header[h.h1[short(_title_of(result)) or name], h.p(".lead")[summary], _conditions(result, places, date)],
            h.nav(aria_label="Parts of this page")[
                h.a(href="#contours")["Contours"],
                h.a(href="#findings")["Findings"] if result.diagnostics else None,
                h.a(href="#program")["Program"],
                h.a(href="#sources")["Sources"],
            ],
            h.main[
                _contours(result, places),
                _findings_in_short(result, places),
                _each_contour(result, places, progress, is_lit=bool(lighting), is_explained=is_explained),
                _others(result, places),
                _program(result, places),
                _sources(result),
            ],
            h.footer[
                h.p[f"contoursolve {version}. Lengths in the unit of each contour; X is a diameter where it says so."]
            ],
        ],
    ]


def _lighting(result: Result) -> str:
    """The rules that light what belongs together; none for a program of more names than a page lights."""
    names: dict[Name, None] = {}
    for answer in result.answers:
        names |= dict.fromkeys(given_table(answer).names)
        if answer.contour is not None:
            names |= dict.fromkeys(path_of(answer, answer.contour).names)
        names |= dict.fromkeys(("finding", str(number)) for number, _ in enumerate(answer.diagnostics, 1))
    try:
        return lighting_rules(names, ".contoursolve article")
    except ValueError:
        return ""


_NUMBERS = re.compile(r"^\s*[O:]\s*(\d{1,8})\b|^\s*%_N_(\w+?)_[MS]PF|BEGIN\s+PGM\s+(\S+)", re.IGNORECASE)
_HEAD = 4
"""Lines at the head of a program in which its number and its name stand."""


def _number_of(result: Result) -> str:
    """The number or the name that a program has on its control; empty where it has none."""
    found = (_NUMBERS.search(block.text) for block in result.program.blocks[:_HEAD])
    return next((f"O{each[1]}" if each[1] else each[2] or each[3] for each in found if each), "")


def _title_of(result: Result) -> str:
    """The first comment at the head of a program."""
    comments = (own for block in result.program.blocks[:_HEAD] for own in own_comments(block))
    return next(
        (each for each in (told.strip("(); \t") for told in comments) if each and "contoursolve" not in each.lower()),
        "",
    )


def _conditions(result: Result, places: PageAnchors, date: str) -> h.Element:
    """The title block: the number, the file, the control, and everything else that the result depends on."""
    control = CONTROLS.get(result.control or "")
    name, blocks = PurePath(result.program.name).name, result.program.blocks
    rows = [("program", each) for each in [_number_of(result)] if each]
    rows.append(("file", f"{name}, {count(len(blocks), 'line')}"))
    rows += [("date of the file", date)] if date else []
    units = dict.fromkeys(answer.unit.value for answer in result.answers)
    diameters = dict.fromkeys(
        axis
        for answer in result.answers
        for axis, is_diameter in zip(answer.plane.axes, answer.plane.diameters, strict=True)
        if is_diameter
    )
    rows += [("unit", ", ".join([*units, *(f"{axis} = Ø" for axis in diameters)]))] if units else []
    rows.append(("control", f"{control.title} ({control.name})" if control else result.control or "not known"))
    if result.policy is not Policy.ENFORCE:
        rows.append(("rules of the manual", result.policy.value))
    rows += [("setting", f"{result.control}.{name}={value}") for name, value in sorted(result.settings.items())]
    if result.start:
        rows.append(("start", result.start.text))
    rows += [("further fact", fact.text) for fact in result.facts]
    rows += [("tool", told) for told in dict.fromkeys(each.title for each in _runs(places))]
    return h.dl[(h.div[h.dt[name], h.dd[short(value)]] for name, value in rows)]


def _contours(result: Result, places: PageAnchors) -> h.Element:
    """The drawing, one line a contour, and every point."""
    together = figure(result, is_inline=True, tool=places.tool) if len(result.answers) > 1 or _runs(places) else None
    if not result.answers:
        return h.section(id="contours")[h.h2["Contours"], together or h.p["The program has no contour."]]
    header = ("contour", "line", "form", "status", "ends at", "findings")
    own = {id(each) for answer in result.answers for each in answer.diagnostics}
    beside: dict[int | None, list[Diagnostic]] = {}
    for finding in (each for each in result.diagnostics if id(each) not in own):
        beside.setdefault(places.contours.get(finding.span.line), []).append(finding)
    rows = [
        (
            h.a(href=places.contour(number))[f"contour {number}"],
            _line_link(answer.lines[0], places),
            short(answer.form_text),
            _status(answer, found),
            h.span(".place")[coordinates(answer.contour.end, answer.plane, answer.unit)] if answer.contour else "",
            _found(found),
        )
        for number, answer in enumerate(result.answers, 1)
        for found in [(*answer.diagnostics, *beside.get(number, ()))]
    ]
    return h.section(id="contours")[
        h.h2["Contours"] if together or len(rows) > 1 else None,
        together,
        table("Every contour, with what became of it", header, rows) if len(rows) > 1 else None,
        _points(result, places),
    ]


def _points(result: Result, places: PageAnchors) -> Iterator[h.Element]:
    """The table of all points of the contours that have no table of their own, one for each plane and unit."""
    tables: dict[tuple[str, ...], list[tuple[int, Sequence[str]]]] = {}
    for number, answer in enumerate(result.answers, 1):
        if answer.contour is not None and number not in places.shown:
            path = path_of(answer, answer.contour)
            # Where it begins is told already, if the one before ends there.
            goes_on = number > 1 and _goes_on(result.answers[number - 2], answer)
            rows = [(number, row) for row in path.rows if row[1] != "point" and not (goes_on and row[0] == "start")]
            tables.setdefault((str(answer.plane.axes), answer.unit.value), []).extend(rows)
            tables[str(answer.plane.axes), answer.unit.value].insert(0, (0, path.header))
    for (axes, _), rows in tables.items():
        headers = [row for number, row in rows if not number]
        widest = max(headers, key=len)
        begun = set[int]()
        shown: list[list[h.Node]] = []
        for number, row in ((number, row) for number, row in rows if number):
            name: h.Node = f"contour {number}"
            if number not in begun:
                begun.add(number)
                name = h.span(id=f"points-{number}")[name]
            shown.append([name, *row, *[""] * (len(widest) - len(row))])
        caption = "All points" if len(tables) == 1 else f"All points, {axes}"
        yield table(caption, ("contour", *widest), shown, numbers=range(3, len(widest) + 1))


def _goes_on(before: Answer, after: Answer) -> bool:
    """Whether a contour begins where the one before it ends."""
    one, other = before.contour, after.contour
    return one is not None and other is not None and dist(one.end, other.start) <= LENGTH


def _each_contour(
    result: Result, places: PageAnchors, progress: Progress, *, is_lit: bool, is_explained: bool
) -> h.Element | None:
    """The contours that are asked for, or that have errors, each with its picture."""
    if not places.shown:
        for _ in result.answers:
            progress()
        return None
    return h.section(".long" if len(places.shown) >= LONG else "", id="each")[
        h.h2["Contours one by one"] if len(result.answers) > 1 else h.h2["The contour"],
        h.p(".hint")[_HINT] if is_lit else None,
        (
            _contour(answer, number, result, places, progress, is_explained=is_explained)
            for number, answer in enumerate(result.answers, 1)
            if number in places.shown or progress() is NotImplemented
        ),
    ]


def _runs(places: PageAnchors) -> Sequence["tool_radius.ToolRun"]:
    return places.tool.runs if places.tool is not None else ()


def _contour(
    answer: Answer, number: int, result: Result, places: PageAnchors, progress: Progress, *, is_explained: bool
) -> h.Element:
    keys = named_words(answer)
    found = [
        _finding(each, result, places, names=[("finding", str(place)), *_words_of(each, keys)])
        for place, each in enumerate(answer.diagnostics, 1)
    ]
    path = path_element(answer, identity=f"path-{number}")
    words = words_table(answer, identity=f"words-{number}")
    element = h.article(id=f"contour-{number}")[
        h.h3[
            short(f"Contour {number}, program line {answer.lines[0]}: {answer.form_text}"),
            ": ",
            _status(answer, answer.diagnostics),
        ],
        h.div(".blocks")[
            (
                h.p[_line_link(block.line, places), " ", h.code[short(block.text.strip())]]
                for block in answer.profile.blocks
            )
        ],
        h.div(".beside")[
            figure(answer, is_inline=True, tool=places.tool),
            h.div[path or words, *remarks(answer, result.control or "")],
        ],
        found,
        solutions_table(answer),
        words if path else None,
        checks_table(answer),
        _explained(answer) if is_explained else None,
    ]
    progress()
    return element


def _explained(answer: Answer) -> h.Element:
    """The equations of a contour as maths, its construction, and its calculation by hand."""
    from contoursolve.output.explanation_html import (  # noqa: PLC0415 - sympy is slow to import
        calculation_of_contour,
        equations_of_contour,
    )

    calculation = [*calculation_of_contour(answer)]
    return h.section(".equations")[
        h.h4["Equations"],
        *equations_of_contour(answer),
        [h.h4["Calculation by hand"], *calculation] if calculation else None,
    ]


def _words_of(finding: Diagnostic, named: Mapping[Span, About]) -> Iterator[Name]:
    """The words of a contour that a finding points at."""
    yield from (
        ("word", named[label.span].word) for label in finding.labels if label.span in named and named[label.span].word
    )


def _finding(
    finding: Diagnostic, result: Result, places: PageAnchors, heading: h.Element = h.h4, names: Sequence[Name] = ()
) -> h.Element:
    name, sources, identity = result.program.name, sources_of(result, finding), places.finding(finding)
    return finding_element(finding, name, sources, anchor=places.line, identity=identity, heading=heading, names=names)


def _status(answer: Answer, findings: Sequence[Diagnostic]) -> h.Element:
    """The status, in the colour of its worst finding."""
    return h.span(class_=f"status {worst_of(findings)}")[answer.state]


def _found(findings: Sequence[Diagnostic]) -> str:
    numbers = Counter(each.severity for each in findings)
    return ", ".join(count(numbers[each], each.value) for each in Severity if numbers[each]) or "none"


def _line_link(line: int, places: PageAnchors) -> h.Node:
    target = places.line(line)
    return h.a(href=target)[f"program line {line}"] if target else f"program line {line}"


def _findings_in_short(result: Result, places: PageAnchors) -> h.Element | None:
    """The findings, the worst first: each with its line and its first fix, those that say the same as one."""
    groups: dict[tuple[Severity, str, str], list[Diagnostic]] = {}
    for finding in sorted(result.diagnostics, key=lambda each: ([*Severity].index(each.severity), each.span.line)):
        said = _NUMBER.sub("", finding.fixes[0].description if finding.fixes else finding.help)
        groups.setdefault((finding.severity, finding.code, said), []).append(finding)
    if not groups:
        return None
    return h.section(".findings", id="findings")[
        h.h2["Findings"], (_group(found, result, places) for found in groups.values())
    ]


_NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?|\bprogram lines?\b")
_MOST_LINES = 12
"""Lines that a group of findings names."""


def _group(found: Sequence[Diagnostic], result: Result, places: PageAnchors) -> h.Element:
    """Findings that say the same: the first one, what to do, and where the others are."""
    first, others = found[0], found[1:]
    severity, done = first.severity.value, first.fixes[0].description if first.fixes else first.help
    links = [
        [" " if place else "", h.a(href=f"#{places.finding(each)}")[str(result.place(each.span).line)]]
        for place, each in enumerate(others[:_MOST_LINES])
    ]
    more = f" and {len(others) - _MOST_LINES} more" if len(others) > _MOST_LINES else ""
    told = f"{count(len(others), 'finding')} more of this kind, program line{'s' * (len(others) > 1)} "
    return h.div(class_=f"group {severity}")[
        h.p[
            h.span(class_=severity)[severity],
            f", program line {result.place(first.span).line}: ",
            h.a(href=f"#{places.finding(first)}")[short(first.message)],
        ],
        h.p[short(done)] if done else None,
        h.p(".more")[told, links, more] if others else None,
    ]


def _others(result: Result, places: PageAnchors) -> h.Element | None:
    """The section with the findings of which no contour with a part of its own tells; None without any."""
    own = {
        id(each)
        for number, answer in enumerate(result.answers, 1)
        if number in places.shown
        for each in answer.diagnostics
    }
    others = [finding for finding in result.diagnostics if id(finding) not in own]
    if not others:
        return None
    return h.section(id="others")[
        h.h2["Other findings"],
        (_in_same_words(each, result, places) for each in alike(others)),
    ]


def _in_same_words(found: Sequence[Diagnostic], result: Result, places: PageAnchors) -> Iterator[h.Element]:
    """The first of findings that say the same, and the places of the others."""
    first, *others = found
    yield _finding(first, result, places, h.h3)
    if others:
        lines = [
            [", " * bool(n), h.span(id=places.finding(one))[_line_link(one.span.line, places)]]
            for n, one in enumerate(others)
        ]
        yield h.p(".more")["The same in ", lines]


def _program(result: Result, places: PageAnchors) -> h.Element:
    return h.section(".program", id="program")[
        h.h2["Program"],
        h.p["The number of a line leads to its contour, a marked word to the finding about it."],
        h.div(".listing", tabindex="0", role="region", aria_label="Program text")[
            (_line(block, places) for block in result.program.blocks)
        ],
    ]


def _sources(result: Result) -> h.Element:
    """The section with the source of every finding, setting and assumption, and its grade."""
    codes: dict[tuple[str, str, Evidence], set[str]] = {}
    for finding in result.diagnostics:
        source = finding.source
        codes.setdefault((source.manual, source.place, source.evidence), set()).add(finding.code)
    for answer in result.answers:
        claim = answer.claim
        settings = [(each.setting.name, each.setting.source) for each in claim.conventions]
        for name, source in (*settings, *((each.name, each.source) for each in answer.assumptions)):
            codes.setdefault((source.manual, source.place, source.evidence), set()).add(f"{result.control}.{name}")
    rows = [
        (manual, place, evidence.value, ", ".join(sorted(used)))
        for (manual, place, evidence), used in sorted(codes.items(), key=lambda item: (item[0][:2], item[0][2].value))
    ]
    return h.section(id="sources")[
        h.h2["Sources"],
        table("What the findings depend on", ("manual", "place", "grade", "for"), rows) if rows else None,
        h.dl[([h.dt[grade.value], h.dd[meaning]] for grade, meaning in _GRADES.items())],
    ]


# The program -------------------------------------------------------------------------------------------------


def _line(block: Block, places: PageAnchors) -> h.Element:
    contour, number = places.contours.get(block.line), str(block.line)
    shown = h.a(href=places.contour(contour), title=f"contour {contour}")[number] if contour is not None else number
    kind = "contour" if contour is not None else None
    return h.div(id=f"line-{block.line}", class_=kind)[
        h.span(".line")[shown], h.code[_text(block, places)], _findings(block, places)
    ]


def _findings(block: Block, places: PageAnchors) -> Iterator[h.Node]:
    """Links to the findings at a line."""
    found = {id(finding): finding for _, finding in places.marks.get(block.line, ())}
    for finding in found.values():
        if finding.span.line == block.line:
            yield h.a(class_=f"code {finding.severity.value}", href=f"#{places.finding(finding)}")[finding.code]


def _text(block: Block, places: PageAnchors) -> Iterator[h.Node]:
    """The text with the marked words as links to their findings."""
    text, here = printable(block.text), 0
    for begin, end, finding in _apart(places.marks.get(block.line, ()), len(text)):
        kind, target = f"mark {finding.severity.value}", f"#{places.finding(finding)}"
        yield text[here:begin]
        yield h.a(class_=kind, href=target, title=short(finding.message))[text[begin:end]]
        here = end
    yield text[here:]


def _apart(marks: Iterable[Marked], width: int) -> list[tuple[int, int, Diagnostic]]:
    """Marks that do not overlap, from left to right; of those that do, the worst and then the shortest stays."""
    stretches = [(label.span.column - 1, min(label.span.end_column - 1, width), finding) for label, finding in marks]
    severities = list(Severity)
    stretches.sort(key=lambda each: (severities.index(each[2].severity), each[1] - each[0], each[0]))
    chosen: list[tuple[int, int, Diagnostic]] = []
    for begin, end, finding in stretches:
        if begin < end and all(end <= other[0] or begin >= other[1] for other in chosen):
            chosen.append((begin, end, finding))
    return sorted(chosen, key=lambda each: each[0])
