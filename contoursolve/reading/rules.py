"""A rule is a row: a condition on the words of a block, what it says, its source, alarm and examples."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from enum import Enum
from functools import cached_property, lru_cache

from contoursolve.diagnostics import Alarm, Severity, Shown, Source
from contoursolve.geometry import BlockRole, names_of_roles

Stated = Mapping[str, Decimal | None]
"""The statement of a block: the value of each given by name (None for a variable), and circumstances such as `@alone`,
which have no value."""

THIS_CONTROL = "CONTROL"
"""The name of the control in the options of a rule that several have."""

Slot = tuple[str, ...]
"""Names that say the same thing in different ways, such as X and U."""


class Condition:
    """Holds or does not hold for what a block states; `offenders` are the names that make it hold."""

    reads_values = False
    """True of a condition that depends on values and not on names alone."""

    def holds(self, stated: Stated) -> bool:
        """Whether the condition is true of these words; their order never matters."""
        raise NotImplementedError

    def offenders(self, stated: Stated) -> tuple[str, ...]:
        """The stated names that this condition speaks about."""
        raise NotImplementedError

    def limits(self, _name: str, _stated: Stated) -> tuple[Decimal, ...]:
        """The values of a name between which this condition holds alike, where nothing else that is stated varies."""
        return ()

    def compared(self, _stated: Stated) -> tuple[tuple[str, str], ...]:
        """The names whose values this condition compares with each other, beside what else is stated."""
        return ()

    def __and__(self, other: "Condition") -> "Condition":
        return Both(self, other)

    def __or__(self, other: "Condition") -> "Condition":
        return Either(self, other)

    def __invert__(self) -> "Condition":
        return Unless(self)


@dataclass(frozen=True, slots=True)
class _Joined(Condition):
    """Two conditions as one."""

    first: Condition
    second: Condition

    @property
    def parts(self) -> tuple[Condition, Condition]:
        return self.first, self.second

    @property
    def reads_values(self) -> bool:  # type: ignore[override]
        return any(part.reads_values for part in self.parts)

    def offenders(self, stated: Stated) -> tuple[str, ...]:
        holding = [part for part in self.parts if part.holds(stated)]
        return tuple(dict.fromkeys(name for part in holding for name in part.offenders(stated)))

    def limits(self, name: str, stated: Stated) -> tuple[Decimal, ...]:
        return self.first.limits(name, stated) + self.second.limits(name, stated)

    def compared(self, stated: Stated) -> tuple[tuple[str, str], ...]:
        return self.first.compared(stated) + self.second.compared(stated)


class Both(_Joined):
    """Two conditions at once."""

    __slots__ = ()

    def holds(self, stated: Stated) -> bool:
        return self.first.holds(stated) and self.second.holds(stated)

    def limits(self, name: str, stated: Stated) -> tuple[Decimal, ...]:
        return () if self._fails_by_names(stated) else super().limits(name, stated)

    def compared(self, stated: Stated) -> tuple[tuple[str, str], ...]:
        return () if self._fails_by_names(stated) else super().compared(stated)

    def _fails_by_names(self, stated: Stated) -> bool:
        """Whether it does not hold, whatever the values are."""
        return any(not part.reads_values and not part.holds(stated) for part in self.parts)


class Either(_Joined):
    """One of two conditions, or both."""

    __slots__ = ()

    def holds(self, stated: Stated) -> bool:
        return self.first.holds(stated) or self.second.holds(stated)


@dataclass(frozen=True, slots=True)
class Unless(Condition):
    """The opposite of a condition; it points at nothing."""

    condition: Condition

    @property
    def reads_values(self) -> bool:  # type: ignore[override]
        return self.condition.reads_values

    def holds(self, stated: Stated) -> bool:
        return not self.condition.holds(stated)

    def offenders(self, _stated: Stated) -> tuple[str, ...]:
        return ()

    def limits(self, name: str, stated: Stated) -> tuple[Decimal, ...]:
        return self.condition.limits(name, stated)


@dataclass(frozen=True, slots=True)
class Count(Condition):
    """The number of slots that are filled lies between two bounds."""

    slots: tuple[Slot, ...]
    least: int = 0
    most: int = 1_000

    def holds(self, stated: Stated) -> bool:
        names = stated.keys()
        return self.least <= sum(not names.isdisjoint(slot) for slot in self.slots) <= self.most

    def offenders(self, stated: Stated) -> tuple[str, ...]:
        return tuple(name for slot in self.slots for name in slot if name in stated)


@dataclass(frozen=True, slots=True)
class Value(Condition):
    """Some of these names has a value outside the bounds; a bound that is open excludes itself."""

    names: tuple[str, ...]
    least: Decimal = Decimal("-Infinity")
    most: Decimal = Decimal("Infinity")
    excluding: Decimal | None = None

    reads_values = True

    def holds(self, stated: Stated) -> bool:
        for name in self.names:
            value = stated.get(name)
            if value is not None and not (self.least <= value <= self.most and value != self.excluding):
                return True
        return False

    def offenders(self, stated: Stated) -> tuple[str, ...]:
        return tuple(name for name in self.names if name in stated and self.holds({name: stated[name]}))

    def limits(self, name: str, _stated: Stated) -> tuple[Decimal, ...]:
        ends = (self.least, self.most, self.excluding) if name in self.names else ()
        return tuple(end for end in ends if end is not None and end.is_finite())


@dataclass(frozen=True, slots=True)
class AngleAlong(Condition):
    """Some of these angles, in degrees, lies within a limit of a direction or of its opposite."""

    names: tuple[str, ...]
    direction: int
    within: Decimal

    reads_values = True

    def holds(self, stated: Stated) -> bool:
        return bool(self.offenders(stated))

    def offenders(self, stated: Stated) -> tuple[str, ...]:
        values = ((name, stated.get(name)) for name in self.names)
        return tuple(name for name, value in values if value is not None and self._is_along(value))

    def limits(self, name: str, _stated: Stated) -> tuple[Decimal, ...]:
        return _around(Decimal(self.direction), self.within) if name in self.names else ()

    def _is_along(self, value: Decimal) -> bool:
        return _apart(value, Decimal(self.direction)) <= self.within


@dataclass(frozen=True, slots=True)
class AnglesParallel(Condition):
    """Two angles, in degrees, differ by no more than a limit, or by that from half a turn."""

    names: tuple[str, str]
    within: Decimal

    reads_values = True

    def holds(self, stated: Stated) -> bool:
        first, second = (stated.get(name) for name in self.names)
        return first is not None and second is not None and _apart(first, second) <= self.within

    def offenders(self, stated: Stated) -> tuple[str, ...]:
        return self.names if self.holds(stated) else ()

    def limits(self, name: str, stated: Stated) -> tuple[Decimal, ...]:
        others = [stated.get(other) for other in self.names if other != name] if name in self.names else []
        return tuple(end for other in others if other is not None for end in _around(other, self.within))

    def compared(self, _stated: Stated) -> tuple[tuple[str, str], ...]:
        return (self.names,)


def _apart(first: Decimal, second: Decimal) -> Decimal:
    """The angle between two lines, from 0 to 90 degrees."""
    apart = (first - second) % 180
    return min(abs(apart), 180 - abs(apart))


def _around(direction: Decimal, within: Decimal) -> tuple[Decimal, ...]:
    """The angles that are just so far from a direction or its opposite, in two turns either way."""
    first = direction % 180
    return tuple(first + half * 180 + side for half in range(-4, 4) for side in (-within, within))


def some(*names: str) -> Condition:
    """At least one of the names is stated."""
    return Count((names,), least=1)


def all_of(*slots: Slot | str) -> Condition:
    """Each slot is filled."""
    return at_least(len(slots), *slots)


def at_least(number: int, *slots: Slot | str) -> Condition:
    """At least this many slots are filled."""
    return Count(_slots(slots), least=number)


def at_most(number: int, *slots: Slot | str) -> Condition:
    """At most this many slots are filled."""
    return Count(_slots(slots), most=number)


def _slots(slots: tuple[Slot | str, ...]) -> tuple[Slot, ...]:
    return tuple((slot,) if isinstance(slot, str) else slot for slot in slots)


@dataclass(frozen=True)
class Rule(Shown):
    """One row of the catalogue.

    `message` is a template; its fields are listed in `explain`. A rule finds something in one of two
    ways: `when` holds for the words of the blocks of one of its `roles`; or something in the program or its geometry
    happens that `about` names. `ignores` names the word that the control then drops without
    a word. Each example is a program; `rejected` ones raise this code, `accepted` ones do not. Those of a rule that
    controls share are made of programs of each control, by its `slip` (see `controls.own_words`).
    """

    code: str
    message: str
    help: str
    source: Source
    accepted: tuple[str, ...] = ()
    rejected: tuple[str, ...] = ()
    roles: tuple[str, ...] = ()
    when: Condition | None = None
    about: Enum | None = None
    ignores: str = ""
    alarm: Alarm | None = None
    severity: Severity = Severity.ERROR
    note: str = ""
    """A further remark of the manual about the same thing, half a sentence without a full stop."""
    is_about_geometry: bool = False
    """True of a rule that refuses what could be written, but cannot be made."""
    is_about_choice: bool = False
    """True of a rule that refuses a block because no word chooses between two places."""
    slip: Mapping[str, str] = field(default_factory=dict)
    """The gaps of a control's right programs that a wrong one has filled otherwise."""
    options: str = ""
    """Options of `contoursolve check` for its examples; `THIS_CONTROL` stands for the control's name."""
    file: str = ""
    """A file beside its examples: the name, and the text from the second line on."""
    absent: str = ""
    """The reason why no program of the control meets it; such a row is not listed."""
    control: str = THIS_CONTROL
    """The control that its help names, of a row that is told for one."""
    fill: "Callable[[Rule], Rule] | None" = field(default=None, repr=False)
    """The maker of its examples in a control's words; None where it has them."""

    def __hash__(self) -> int:
        return hash((self.code, self.message))

    @cached_property
    def told(self) -> "Rule":
        """The same rule with its examples, which are made when they are asked for."""
        return self.fill(self) if self.fill else self

    def holds(self, own: Stated) -> bool:
        """Whether it finds something in what the blocks of its role state."""
        return self.when is not None and self.when.holds(own)

    @property
    def title(self) -> str:
        """The message with its fields shown as gaps."""
        return _FIELD.sub(_gap, self.message)

    @property
    def advice(self) -> str:
        """The help, with its fields shown as gaps."""
        return _FIELD.sub(_gap, self.help)


class Rules(tuple[Rule, ...]):
    """Rules as a key of caches: their hash is worked out once, though it is asked for with every contour."""

    @cached_property
    def _hash(self) -> int:
        return hash(tuple(self))

    def __hash__(self) -> int:
        return self._hash

    def __reduce__(self) -> tuple[type["Rules"], tuple[tuple[Rule, ...]]]:
        # The hash is another one in another process.
        return Rules, (tuple(self),)


_FIELD = re.compile(r"\{(\w+)(?::([^}]*))?\}")


def _gap(field: re.Match[str]) -> str:
    """A field of a template: `{words:D Q}` as <D or Q>, `{limit}` as <limit>."""
    name, spec = field.groups()
    if spec:
        return f"<{spec if spec == 'other G' else ' or '.join(spec.replace('|', ' ').split())}>"
    return _PHRASES[name] if name in _PHRASES else f"<{_GAPS.get(name, name)}>"


VERBS = {"are": "is", "have": "has", "do": "does", "stand": "stands", "leave": "leaves", "define": "defines"} | {
    "depend": "depends"
}
"""Verbs of a message about words, and as they are of one word."""

_PHRASES = VERBS | {"comparison": "", "fits": "at most <limit> fits", "smaller": "write at most <limit>"}
_GAPS = {
    "words": "word",
    "off": "difference",
    "cancel": "G40",
    "subject": "element",
    "free": "point",
    "where": "line",
    "things": "point",
}


@dataclass(frozen=True, slots=True)
class Offence:
    """A rule that holds for the blocks of a role, and the names of the givens that it points at."""

    rule: Rule
    names: tuple[str, ...]
    role: BlockRole

    @property
    def ignored(self) -> str:
        """The name of what the control drops; empty if it drops nothing. Of several blocks, the last one has it."""
        return self.rule.ignores and self.role.prefixes[-1] + self.rule.ignores


def check(rules: tuple[Rule, ...], roles: Sequence[BlockRole], stated: Stated) -> tuple[Offence, ...]:
    """All rules on combinations of words that refuse or ignore something in what the blocks of a contour state."""
    named = names_of_roles(roles, stated)
    return tuple(offence for role, names in named for offence in _check_role(rules, role, names, stated))


def is_refused_by_values(rules: tuple[Rule, ...], roles: Sequence[BlockRole], stated: Stated) -> bool:
    """Whether `check` finds something that depends on values and not on names alone."""
    by_values_of = {role: _rules_of(rules, role.name)[1] for role in roles}
    for role, names in names_of_roles((role for role, own in by_values_of.items() if own), stated):
        by_values = by_values_of[role]
        own = {call: stated[name] for call, name in names.items()}
        if any(rule.holds(own) for rule in by_values):
            return True
    return False


def _check_role(
    rules: tuple[Rule, ...], role: BlockRole, names: Mapping[str, str], stated: Stated
) -> tuple[Offence, ...]:
    by_names, by_values = _rules_of(rules, role.name)
    offences = _offences_by_names(by_names, role, frozenset(names.values()))
    if by_values:
        own = {call: stated[name] for call, name in names.items()}
        offences += tuple(_offence(rule, role, own, names) for rule in by_values if rule.holds(own))
    return offences


@lru_cache(maxsize=256)
def _rules_of(rules: tuple[Rule, ...], role: str) -> tuple[Rules, Rules]:
    """The rules on combinations of a role: those on names alone, and those on values."""
    own = [rule for rule in rules if role in rule.roles and rule.when is not None]
    by_values = Rules(rule for rule in own if rule.when is not None and rule.when.reads_values)
    return Rules(rule for rule in own if rule not in by_values), by_values


@lru_cache(maxsize=8192)
def _offences_by_names(rules: tuple[Rule, ...], role: BlockRole, stated: frozenset[str]) -> tuple[Offence, ...]:
    """Programs repeat few combinations of words many times."""
    names = role.names(stated)
    own = dict.fromkeys(names)
    return tuple(_offence(rule, role, own, names) for rule in rules if rule.holds(own))


def _offence(rule: Rule, role: BlockRole, own: Stated, names: Mapping[str, str]) -> Offence:
    offenders = rule.when.offenders(own) if rule.when is not None else ()
    return Offence(rule, tuple(names[call] for call in offenders), role)
