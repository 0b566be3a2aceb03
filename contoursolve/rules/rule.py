"""A rule is a row: what it finds, in words, with its source, the control's alarm, and examples."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum

from contoursolve.diagnostic import Alarm, Severity
from contoursolve.rules.conditions import Condition, Stated
from contoursolve.source import Source


@dataclass(frozen=True, slots=True)
class Rule:
    """One row of the catalogue.

    `message` is a template; its fields are listed in `explain`. A rule finds something in one of two
    ways: `when` holds for the words of a block of `form`; or something else in the program or its
    geometry happens that `about` names. `ignores` names the word that the control then drops without
    a word. Each example is a program; `rejected` ones raise this code, `accepted` ones do not.
    """

    code: str
    message: str
    help: str
    source: Source
    accepted: tuple[str, ...]
    rejected: tuple[str, ...]
    form: str = ""
    when: Condition | None = None
    about: Enum | None = None
    ignores: str = ""
    alarm: Alarm | None = None
    severity: Severity = Severity.ERROR

    @property
    def title(self) -> str:
        """The message with its fields shown as gaps."""
        return self.message.translate(str.maketrans({"{": "<", "}": ">"}))


@dataclass(frozen=True, slots=True)
class Offence:
    """A rule that holds for a block, and the names of the givens that it points at."""

    rule: Rule
    names: tuple[str, ...]


def check(rules: Iterable[Rule], form: str, stated: Stated) -> tuple[Offence, ...]:
    """All rules on combinations of words that refuse or ignore something in what a block states."""
    return tuple(
        Offence(rule, rule.when.offenders(stated))
        for rule in rules
        if rule.form == form and rule.when is not None and rule.when.holds(stated)
    )
