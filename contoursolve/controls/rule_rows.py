"""Rows of rules with their examples: the one way in which controls write a rule on words in a line or two."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

from contoursolve.diagnostics import Alarm, Book, Severity, Source
from contoursolve.reading import Condition, Rule


def rule_row(  # noqa: PLR0913 - a row has these columns
    prefix: str,
    code: str,
    message: str,
    help_: str,
    source: Source,
    when: Condition,
    roles: tuple[str, ...],
    good: str,
    *bad: tuple[str, str] | str,
    alarm: Alarm | None = None,
    severity: Severity = Severity.ERROR,
    ignores: str = "",
    note: str = "",
    is_about_geometry: bool = False,
    is_about_choice: bool = False,
) -> Rule:
    """A row of a control whose codes begin with a prefix; what is wrong is a program, or two texts of which the second
    stands for the first in the right one."""
    return Rule(
        f"{prefix}-{code}",
        message,
        help_,
        source,
        accepted=(good,),
        rejected=tuple(each if isinstance(each, str) else good.replace(*each) for each in bad),
        roles=roles,
        when=when,
        ignores=ignores,
        alarm=alarm,
        severity=severity,
        note=note,
        is_about_geometry=is_about_geometry,
        is_about_choice=is_about_choice,
    )


def with_pages(rules: Iterable[Rule], book: Book, pages: Mapping[str, str]) -> tuple[Rule, ...]:
    """The rules, of which a page prints those of these codes, each with its place. Raises KeyError for a code that none
    of them has."""
    rows = {rule.code: rule for rule in rules}
    return (
        *(rows | {code: replace(rows[code], source=book.printed(place)) for code, place in pages.items()}).values(),
    )
