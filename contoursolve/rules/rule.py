"""A rule is a row: what it finds, in words, with its source, the control's alarm, and examples."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache

from contoursolve.diagnostic import Alarm, Severity
from contoursolve.model import Role
from contoursolve.rules.conditions import Condition, Stated
from contoursolve.shown import Shown
from contoursolve.source import Source


@dataclass(frozen=True, slots=True, eq=False)
class Rule(Shown):
    """One row of the catalogue.

    `message` is a template; its fields are listed in `explain`. A rule finds something in one of two
    ways: `when` holds for the words of the blocks of one of its `roles`; or something in the program or its geometry
    happens that `about` names. `ignores` names the word that the control then drops without
    a word. Each example is a program; `rejected` ones raise this code, `accepted` ones do not.
    """

    code: str
    message: str
    help: str
    source: Source
    accepted: tuple[str, ...]
    rejected: tuple[str, ...]
    roles: tuple[str, ...] = ()
    when: Condition | None = None
    about: Enum | None = None
    ignores: str = ""
    alarm: Alarm | None = None
    severity: Severity = Severity.ERROR
    note: str = ""
    """What the manual says besides about the same thing, half a sentence without a full stop."""
    is_about_geometry: bool = False
    """What it refuses could be written, but cannot be made."""

    def holds(self, own: Stated) -> bool:
        """Whether it finds something in what the blocks of its role state."""
        return self.when is not None and self.when.holds(own)

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
    return _PHRASES[name] if name in _PHRASES else f"<{_GAPS.get(name, name)}>"


_PHRASES = {"comparison": "", "fits": "at most <limit> fits", "smaller": "write at most <limit>"}
_GAPS = {"words": "word", "off": "difference", "subject": "element", "free": "point"}


@dataclass(frozen=True, slots=True)
class Offence:
    """A rule that holds for the blocks of a role, and the names of the givens that it points at."""

    rule: Rule
    names: tuple[str, ...]
    role: Role


def check(rules: tuple[Rule, ...], roles: Sequence[Role], stated: Stated) -> tuple[Offence, ...]:
    """All rules on combinations of words that refuse or ignore something in what the blocks of a contour state."""
    return tuple(offence for role in roles for offence in _check_role(rules, role, stated))


def is_refused_by_values(rules: tuple[Rule, ...], roles: Sequence[Role], stated: Stated) -> bool:
    """Whether `check` finds something that depends on values and not on names alone."""
    for role in roles:
        by_values = _rules_of(rules, role.name)[1]
        if by_values:
            is_all = role.prefixes == ("",)
            own = stated if is_all else {call: stated[name] for call, name in role.names(stated).items()}
            if any(rule.holds(own) for rule in by_values):
                return True
    return False


def _check_role(rules: tuple[Rule, ...], role: Role, stated: Stated) -> tuple[Offence, ...]:
    by_names, by_values = _rules_of(rules, role.name)
    names = role.names(stated)
    offences = _offences_by_names(by_names, role, frozenset(names.values()))
    if by_values:
        own = {call: stated[name] for call, name in names.items()}
        offences += tuple(_offence(rule, role, own, names) for rule in by_values if rule.holds(own))
    return offences


@lru_cache(maxsize=256)
def _rules_of(rules: tuple[Rule, ...], role: str) -> tuple[tuple[Rule, ...], tuple[Rule, ...]]:
    """The rules on combinations of a role: those on names alone, and those on values."""
    own = [rule for rule in rules if role in rule.roles and rule.when is not None]
    by_values = tuple(rule for rule in own if rule.when is not None and rule.when.reads_values)
    return tuple(rule for rule in own if rule not in by_values), by_values


@lru_cache(maxsize=8192)
def _offences_by_names(rules: tuple[Rule, ...], role: Role, stated: frozenset[str]) -> tuple[Offence, ...]:
    """Programs repeat few combinations of words many times."""
    names = role.names(stated)
    own = dict.fromkeys(names)
    return tuple(_offence(rule, role, own, names) for rule in rules if rule.holds(own))


def _offence(rule: Rule, role: Role, own: Stated, names: Mapping[str, str]) -> Offence:
    offenders = rule.when.offenders(own) if rule.when is not None else ()
    return Offence(rule, tuple(names[call] for call in offenders), role)
