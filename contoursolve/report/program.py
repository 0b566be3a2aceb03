"""The text of the program: every line with its number, linked with the contours and the findings about it."""

from collections.abc import Iterable, Iterator

import htpy as h

from contoursolve.diagnostic import Severity
from contoursolve.markup.tables import short
from contoursolve.output.layout import printable
from contoursolve.report.places import Marked, Places
from contoursolve.syntax import Block, Program


def program_element(program: Program, places: Places) -> h.Element:
    """The listing."""
    return h.div(".listing", tabindex="0", role="region", aria_label="Program text")[
        (_line(block, places) for block in program.blocks)
    ]


def _line(block: Block, places: Places) -> h.Element:
    contour = places.contour_at.get(block.line)
    number: h.Node = str(block.line)
    if contour is not None:
        number = h.a(href=f"#contour-{contour}", title=f"contour {contour}")[number]
    kind = "contour" if contour is not None else None
    return h.div(id=f"line-{block.line}", class_=kind)[
        h.span(".line")[number], h.code[_text(block, places)], _findings(block, places)
    ]


def _findings(block: Block, places: Places) -> Iterator[h.Node]:
    """Links to the findings at a line."""
    found = {marked.target: marked.finding for marked in places.marks.get(block.line, ())}
    for target, finding in found.items():
        if finding.span.line == block.line:
            yield h.a(class_=f"code {finding.severity.value}", href=target)[finding.code]


def _text(block: Block, places: Places) -> Iterator[h.Node]:
    """The text with the marked words as links to their findings."""
    text, here = printable(block.text), 0
    for begin, end, marked in _apart(places.marks.get(block.line, ()), len(text)):
        severity, message = marked.finding.severity.value, marked.finding.message
        yield text[here:begin]
        yield h.a(class_=f"mark {severity}", href=marked.target, title=short(message))[text[begin:end]]
        here = end
    yield text[here:]


def _apart(marks: Iterable[Marked], width: int) -> list[tuple[int, int, Marked]]:
    """Marks that do not overlap, from left to right; of those that do, the worst and then the shortest stays."""
    stretches = [(each.label.span.column - 1, min(each.label.span.end_column - 1, width), each) for each in marks]
    severities = list(Severity)
    stretches.sort(key=lambda each: (severities.index(each[2].finding.severity), each[1] - each[0], each[0]))
    chosen: list[tuple[int, int, Marked]] = []
    for begin, end, each in stretches:
        if begin < end and all(end <= other[0] or begin >= other[1] for other in chosen):
            chosen.append((begin, end, each))
    return sorted(chosen, key=lambda each: each[0])
