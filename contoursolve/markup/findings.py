"""A finding in HTML: the layout of the terminal, with its colours, and its place as a link."""

from collections.abc import Callable, Mapping, Sequence

import htpy as h

from contoursolve.diagnostic import Diagnostic
from contoursolve.output.findings import Piece, finding_pieces

LONGEST = 400
"""Characters of a line."""

Anchor = Callable[[int], str | None]
"""The address of a line of the program on the page, if it has one."""


def finding_element(
    finding: Diagnostic,
    name: str,
    sources: Mapping[int, str],
    *,
    anchor: Anchor | None = None,
    identity: str = "",
    heading: h.Element = h.h4,
) -> h.Element:
    """One finding: its title, and below it everything else that the terminal shows."""
    title, *rest = finding_pieces(finding, name, sources)
    target = anchor(finding.span.line) if anchor else None
    return h.section(class_=f"finding {finding.severity.value}", id=identity or None)[
        heading[(_piece(piece, None) for piece in bounded(title))],
        h.pre(tabindex="0")[([*(_piece(piece, target) for piece in bounded(line)), "\n"] for line in rest if line)],
    ]


def bounded(line: Sequence[Piece]) -> list[Piece]:
    """The pieces of a line as far as it is not too long."""
    shown: list[Piece] = []
    room = LONGEST
    for text, role in line:
        shown.append((text if len(text) <= room else f"{text[:room]} ...", role))
        room -= len(text)
        if room <= 0:
            break
    return shown


def _piece(piece: Piece, target: str | None) -> h.Node:
    text, role = piece
    if role == "place" and target:
        return h.a(href=target)[text]
    return h.span(class_=role)[text] if role else text
