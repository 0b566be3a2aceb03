"""A contour in HTML: as tables everything that its picture shows."""

from collections.abc import Iterator, Sequence

import htpy as h

from contoursolve.examine import Answer
from contoursolve.markup.tables import short, table
from contoursolve.output.contours import (
    assumptions_text,
    check_rows,
    convention_text,
    count_text,
    given_rows,
    path_rows,
    small,
    solution_rows,
)
from contoursolve.output.solutions import list_solutions, printed_certificate

MOST_ELEMENTS = 200
"""Rows of a table on a page."""


def words_table(answer: Answer) -> h.Element:
    """What was given."""
    return table("What was given", ("word", "value", "unit", "meaning"), given_rows(answer), numbers=(1,))


def path_table(answer: Answer) -> h.Element | None:
    """Every named point and every element of the path, in the unit and the axes of the program."""
    rows = path_rows(answer)
    if not rows:
        return None
    header = ("element", "move", *rows[0][2:])
    return table("The path", header, cut(rows[1:]), numbers=range(2, len(header)))


def cut(rows: Sequence[Sequence[str]]) -> Sequence[Sequence[str]]:
    """The rows that a page holds, and in the last one how many more there are."""
    if len(rows) <= MOST_ELEMENTS:
        return rows
    rest = len(rows) - MOST_ELEMENTS
    return [*rows[:MOST_ELEMENTS], (f"and {rest} more", *[""] * (len(rows[0]) - 1))]


def solutions_table(answer: Answer) -> Iterator[h.Node]:
    """All solutions and what selects each, where there are several or may be more."""
    listing = list_solutions(answer)
    if listing is None or (len(listing.solutions) == 1 and listing.is_complete):
        return
    header = ("solution", "chosen", "where it differs", "what selects it", "certificate")
    rows = [
        (name, "yes" if each.is_chosen else "", f"{label} {where}".strip(), selects, certificate)
        for each, (name, label, where, selects, certificate) in solution_rows(answer, listing)
    ]
    yield table("All solutions", header, cut(rows))
    yield h.p[short(f"{count_text(listing)}.")]
    yield from (h.p[short(f"Not decided: {doubt}.")] for doubt in listing.doubts)


def checks_table(answer: Answer) -> h.Element | None:
    """The checks that a contour without a path went through."""
    if answer.diagnosis is None or answer.contour is not None:
        return None
    header, *rows = check_rows(answer.diagnosis)
    return table("Checks", header, rows)


def remarks(answer: Answer, control: str) -> Iterator[h.Element]:
    """What is proven of the path, what it rests on, and the block with what it asked for filled in."""
    if answer.filled:
        yield h.p[f"Filled in (the contour moves by {small(answer.filled.deviation)}):"]
        yield h.pre["\n".join(short(text.strip()) for text in answer.filled.blocks)]
    if answer.contour is None:
        return
    yield h.p[short(f"Certificate: {printed_certificate(answer.certificate)}.")]
    yield from (h.p[short(convention_text(each, control))] for each in answer.claim.conventions)
    yield from (h.p[short(text)] for text in assumptions_text(answer))
