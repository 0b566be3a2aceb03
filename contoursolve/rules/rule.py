"""A rule is a row: what it finds, in words, with its source, the control's alarm, and examples."""

import re
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache

from contoursolve.diagnostic import Alarm, Severity
from contoursolve.rules.conditions import Condition, Stated
from contoursolve.source import Source


@dataclass(frozen=True, slots=True, eq=False)
class Rule:
    """One row of the catalogue.

    `message` is a template; its fields are listed in `explain`. A rule finds something in one of two
    ways: `when` holds for the words of a block of `form`; or something in the program or its geometry
    happens that `about` names. `ignores` names the word that the control then drops without
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
        return _FIELD.sub(_gap, self.message)

    @property
    def advice(self) -> str:
        """What to do, with its fields shown as gaps."""
        return _FIELD.sub(_gap, self.help)


_FIELD = re.compile(r"\{(\w+)(?::([^}]*))?\}")


def _gap(field: re.Match[str]) -> str:
    """A field of a template: `{words:D Q}` as <D or Q>, `{limit}` as <limit>."""
    name, spec = field.groups()
    if spec:
        return f"<{spec if spec == 'other G' else ' or '.join(spec.replace('|', ' ').split())}>"
    return "" if name == "comparison" else f"<{_GAPS.get(name, name)}>"


_GAPS = {"words": "word", "off": "difference", "subject": "element", "free": "point"}


@dataclass(frozen=True, slots=True)
class Offence:
    """A rule that holds for a block, and the names of the givens that it points at."""

    rule: Rule
    names: tuple[str, ...]


def check(rules: tuple[Rule, ...], form: str, stated: Stated) -> tuple[Offence, ...]:
    """All rules on combinations of words that refuse or ignore something in what a block states."""
    by_names, by_values = _rules_of(rules, form)
    offences = _offences_by_names(by_names, frozenset(stated))
    for rule in by_values:
        if rule.when is not None and rule.when.holds(stated):
            offences += (Offence(rule, rule.when.offenders(stated)),)
    return offences


@lru_cache(maxsize=64)
def _rules_of(rules: tuple[Rule, ...], form: str) -> tuple[tuple[Rule, ...], tuple[Rule, ...]]:
    """The rules on combinations of a form: those on names alone, and those on values."""
    own = [rule for rule in rules if rule.form == form and rule.when is not None]
    by_values = tuple(rule for rule in own if rule.when is not None and rule.when.reads_values)
    return tuple(rule for rule in own if rule not in by_values), by_values


@lru_cache(maxsize=8192)
def _offences_by_names(rules: tuple[Rule, ...], names: frozenset[str]) -> tuple[Offence, ...]:
    """Programs repeat few combinations of words many times."""
    stated = dict.fromkeys(names)
    return tuple(
        Offence(rule, rule.when.offenders(stated))
        for rule in rules
        if rule.when is not None and rule.when.holds(stated)
    )
