"""The page: a summary, every contour, what was found elsewhere, the program, and the sources. It loads nothing and
runs no script, so that it opens anywhere and says the same in ten years."""

from collections import Counter
from collections.abc import Callable, Iterator
from importlib.resources import files
from pathlib import PurePath

import htpy as h
from markupsafe import Markup

from contoursolve.diagnostic import Diagnostic, Severity
from contoursolve.dialects import DIALECTS
from contoursolve.examine import Answer, Policy
from contoursolve.markup.answers import (
    checks_table,
    path_table,
    remarks,
    solutions_table,
    words_table,
)
from contoursolve.markup.figure import figure
from contoursolve.markup.findings import finding_element
from contoursolve.markup.style import page_style
from contoursolve.markup.tables import short, table
from contoursolve.output.contours import place_text
from contoursolve.output.layout import count
from contoursolve.output.listing import sources_of, summary_line
from contoursolve.pipeline import Result
from contoursolve.report.places import Places, contour_name, find_places
from contoursolve.report.program import program_element
from contoursolve.source import Evidence

_POLICY = "default-src 'none'; style-src 'unsafe-inline'"
"""Tells the browser to load and to run nothing."""

_GRADES = {
    Evidence.PRINTED: "read on a page of the control's manual",
    Evidence.DERIVED: "follows from printed facts by geometry or symmetry",
    Evidence.ASSUMED: "our choice where the pages that we have are silent",
}

Progress = Callable[[], object]


def report_page(result: Result, version: str, progress: Progress = lambda: None) -> Iterator[str]:
    """The page in pieces; `progress` is called after each contour."""
    yield from _page(result, version, progress).iter_chunks()
    yield "\n"


def _page(result: Result, version: str, progress: Progress) -> h.Element:
    places = find_places(result)
    name = short(PurePath(result.program.name).name)
    return h.html(lang="en")[
        h.head[
            h.meta(charset="utf-8"),
            h.meta(http_equiv="Content-Security-Policy", content=_POLICY),
            h.meta(name="viewport", content="width=device-width, initial-scale=1"),
            h.meta(name="color-scheme", content="light dark"),
            h.meta(name="generator", content=f"contoursolve {version}"),
            h.title[f"{name}: contours"],
            h.style[Markup(page_style() + _own_style())],  # our own files
        ],
        h.body(".contoursolve")[
            h.header[h.h1[name], h.p(".lead")[summary_line([result])], _conditions(result)],
            h.nav(aria_label="Parts of this page")[
                h.a(href="#contours")["Contours"],
                h.a(href="#program")["Program"],
                h.a(href="#sources")["Sources"],
            ],
            h.main[
                _contours(result, places, progress), _others(result, places), _program(result, places), _sources(result)
            ],
            h.footer[
                h.p[f"contoursolve {version}. Lengths in the unit of each contour; X is a diameter where it says so."]
            ],
        ],
    ]


def _own_style() -> str:
    return files("contoursolve.report").joinpath("report.css").read_text(encoding="utf-8")


def _conditions(result: Result) -> h.Element:
    """The control, and everything apart from the program that the result depends on."""
    dialect = DIALECTS.get(result.control or "")
    rows = [("program", result.program.name)]
    rows.append(("control", f"{dialect.title} ({dialect.name})" if dialect else result.control or "not known"))
    if result.policy is not Policy.ENFORCE:
        rows.append(("rules of the manual", result.policy.value))
    rows += [("setting", f"{result.control}.{name}={value}") for name, value in sorted(result.settings.items())]
    if result.start:
        rows.append(("start", result.start.text))
    rows += [("further fact", fact.text) for fact in result.facts]
    return h.dl[([h.dt[name], h.dd[short(value)]] for name, value in rows)]


def _contours(result: Result, places: Places, progress: Progress) -> h.Element | None:
    if not result.answers:
        return h.section(id="contours")[h.h2["Contours"], h.p["The program has no contour."]]
    header = ("contour", "line", "form", "status", "ends at", "findings")
    rows = [
        (
            h.a(href=f"#contour-{number}")[f"contour {number}"],
            _line_link(answer.lines[0], places),
            short(f"{answer.claim.form.name} ({answer.claim.form.title})"),
            _status(answer),
            h.span(".place")[place_text(answer, answer.contour.end)] if answer.contour else "",
            _found(answer.diagnostics),
        )
        for number, answer in enumerate(result.answers, 1)
    ]
    return h.section(id="contours")[
        h.h2["Contours"],
        table("Every contour, with what became of it", header, rows),
        figure(result) if len(result.answers) > 1 else None,
        (_contour(answer, number, result, places, progress) for number, answer in enumerate(result.answers, 1)),
    ]


def _contour(answer: Answer, number: int, result: Result, places: Places, progress: Progress) -> h.Element:
    found = [_finding(each, result, places) for each in answer.diagnostics]
    path, words = path_table(answer), words_table(answer)
    element = h.article(id=f"contour-{number}")[
        h.h3[short(contour_name(answer, number)), ": ", _status(answer)],
        h.div(".blocks")[
            (
                h.p[_line_link(block.line, places), " ", h.code[short(block.text.strip())]]
                for block in answer.profile.blocks
            )
        ],
        h.div(".beside")[figure(answer), h.div[path or words, *remarks(answer, result.control or "")]],
        found,
        solutions_table(answer),
        words if path else None,
        checks_table(answer),
    ]
    progress()
    return element


def _finding(finding: Diagnostic, result: Result, places: Places) -> h.Element:
    sources = sources_of(result, finding)
    return finding_element(finding, result.program.name, sources, anchor=places.line, identity=places.finding(finding))


def _status(answer: Answer) -> h.Element:
    """The status, in the colour of its worst finding."""
    worst = next((each for each in Severity if each in {found.severity for found in answer.diagnostics}), None)
    return h.span(class_=f"status {worst.value if worst else 'fine'}")[answer.status.value]


def _found(findings: tuple[Diagnostic, ...]) -> str:
    numbers = Counter(each.severity for each in findings)
    return ", ".join(count(numbers[each], each.value) for each in Severity if numbers[each]) or "none"


def _line_link(line: int, places: Places) -> h.Node:
    target = places.line(line)
    return h.a(href=target)[f"line {line}"] if target else f"line {line}"


def _others(result: Result, places: Places) -> h.Element | None:
    """What was found outside contours."""
    own = {id(each) for answer in result.answers for each in answer.diagnostics}
    others = [finding for finding in result.diagnostics if id(finding) not in own]
    if not others:
        return None
    return h.section(id="others")[
        h.h2["Findings outside contours"],
        (
            finding_element(
                each,
                result.program.name,
                sources_of(result, each),
                anchor=places.line,
                identity=places.finding(each),
                heading=h.h3,
            )
            for each in others
        ),
    ]


def _program(result: Result, places: Places) -> h.Element:
    return h.section(id="program")[
        h.h2["Program"],
        h.p["The number of a line leads to its contour, a marked word to the finding about it."],
        program_element(result.program, places),
    ]


def _sources(result: Result) -> h.Element:
    """Where every finding, every convention and every assumption comes from, and how well it is known."""
    codes: dict[tuple[str, str, Evidence], set[str]] = {}
    for finding in result.diagnostics:
        source = finding.source
        codes.setdefault((source.manual, source.place, source.evidence), set()).add(finding.code)
    for answer in result.answers:
        claim = answer.claim
        resting = [(each.setting.name, each.setting.source) for each in claim.conventions]
        for name, source in (*resting, *((each.name, each.source) for each in answer.assumptions)):
            codes.setdefault((source.manual, source.place, source.evidence), set()).add(f"{result.control}.{name}")
    rows = [
        (manual, place, evidence.value, ", ".join(sorted(used)))
        for (manual, place, evidence), used in sorted(codes.items(), key=lambda item: (item[0][:2], item[0][2].value))
    ]
    return h.section(id="sources")[
        h.h2["Sources"],
        table("What the findings rest on", ("manual", "place", "grade", "for"), rows) if rows else None,
        h.dl[([h.dt[grade.value], h.dd[meaning]] for grade, meaning in _GRADES.items())],
    ]
