"""Rows of the catalogue: the one way in which controls write a rule, column by column."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from enum import Enum
from typing import Any, TypedDict, Unpack

from contoursolve.diagnostics import OWN, Alarm, Book, Evidence, Severity, Source
from contoursolve.reading import Condition, Rule
from contoursolve.solving import NoteKind, RefusalKind

Examples = str | tuple[str | tuple[str, ...], *tuple[str | tuple[str, str], ...]] | Mapping[str, str]
"""A right program, or several in parentheses, and wrong ones behind it: programs, or two texts, of which the second
stands for the first in the right one. Or the slip by which the right programs of each control go wrong."""

GEOMETRY = Source(OWN, "the geometry of lines, arcs and corners", Evidence.ASSUMED)

EVENTS: Mapping[str, Rule] = {
    code: Rule(code, kind.event.message, kind.event.help, GEOMETRY, about=kind, severity=kind.event.severity)
    for kind in (*RefusalKind, *NoteKind)
    for code in (kind.value, *kind.event.codes)
}
"""The rows about geometric events, as contoursolve tells them, by the end of a code."""


class Further(TypedDict, total=False):
    """Columns that few rows have (see `Rule`)."""

    about: Enum
    alarm: Alarm | None
    severity: Severity
    ignores: str
    note: str
    options: str
    is_about_geometry: bool
    is_about_choice: bool


def row(
    code: str,
    message: str = "",
    help: str = "",  # noqa: A002 - the name of the column
    source: Source | None = None,
    finds: Condition | Enum | None = None,
    examples: Examples = "",
    roles: tuple[str, ...] = (),
    *,
    like: Rule | Mapping[str, Rule] | None = None,
    **further: Unpack[Further],
) -> Rule:
    """A row of the catalogue. It finds what a condition on the words of its roles holds for, or what happens. A row
    `like` another one, or like the one of a table that the end of its code names, states what is otherwise alone."""
    finding = {} if finds is None else {"when" if isinstance(finds, Condition) else "about": finds}
    columns = {"message": message, "help": help, "source": source, **finding, "roles": roles}
    stated: dict[str, Any] = {name: column for name, column in columns.items() if column} | {**further}
    if examples:
        stated |= _told(examples)
    if isinstance(like, Mapping):
        parts = code.split("-")
        ends = ("-".join(parts[number:]) for number in range(len(parts)))
        like = next(like[end] for end in ends if end in like)
    return replace(like, code=code, **stated) if like else Rule(code, **stated)


def _told(examples: Examples) -> dict[str, Any]:
    """The columns of a rule with these examples."""
    if isinstance(examples, Mapping):
        return {"slip": examples}
    right, *wrong = (examples,) if isinstance(examples, str) else examples
    accepted = (right,) if isinstance(right, str) else right
    rejected = tuple(each if isinstance(each, str) else accepted[0].replace(*each) for each in wrong)
    return {"accepted": accepted, "rejected": rejected}


def with_rows(rules: Iterable[Rule], *own: Rule) -> tuple[Rule, ...]:
    """The rules, with rows in the place of those of the same code; what is left of them stands behind."""
    return tuple({rule.code: rule for rule in (*rules, *own)}.values())


def with_pages(rules: Iterable[Rule], book: Book, pages: Mapping[str, str]) -> tuple[Rule, ...]:
    """The rules, of which a page prints those of these codes, each with its place. Raises KeyError for a code that none
    of them has."""
    rows = {rule.code: rule for rule in rules}
    return with_rows(rows.values(), *(replace(rows[code], source=book.printed(at)) for code, at in pages.items()))
