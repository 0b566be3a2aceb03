"""The text of the program: every line with its number, linked with the contours and the findings about it."""

from collections.abc import Iterator

import htpy as h

from contoursolve.output.layout import printable
from contoursolve.report.places import Places
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
    return h.div(id=f"line-{block.line}", class_=kind)[h.span(".line")[number], h.code[_text(block, places)]]


def _text(block: Block, places: Places) -> Iterator[h.Node]:
    """The text with the marked words as links to their findings; where marks overlap, the worst and first counts."""
    text, here = printable(block.text), 0
    marks = sorted(places.marks.get(block.line, ()), key=lambda each: (each.label.span.column, each.target))
    for marked in marks:
        begin, end = marked.label.span.column - 1, min(marked.label.span.end_column - 1, len(text))
        if begin < here or end <= begin:
            continue
        yield text[here:begin]
        severity, message = marked.finding.severity.value, marked.finding.message
        yield h.a(class_=f"mark {severity}", href=marked.target, title=f"{severity}: {message}"[:300])[text[begin:end]]
        here = end
    yield text[here:]
