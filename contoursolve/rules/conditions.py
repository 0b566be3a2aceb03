"""A small algebra of conditions on the words of a block, so that a rule is data and not code."""

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal

Stated = Mapping[str, Decimal | None]
"""What a block states: the value of each given by name (None for a variable), and circumstances such
as `@alone`, which have no value."""

Slot = tuple[str, ...]
"""Names that say the same thing in different ways, such as X and U."""


class Condition:
    """Holds or does not hold for what a block states; `offenders` are the names that make it hold."""

    reads_values = False
    """Whether it depends on values and not on names alone."""

    def holds(self, stated: Stated) -> bool:
        """Whether the condition is true of these words; their order never matters."""
        raise NotImplementedError

    def offenders(self, stated: Stated) -> tuple[str, ...]:
        """The stated names that this condition speaks about."""
        raise NotImplementedError

    def __and__(self, other: "Condition") -> "Condition":
        return Both(self, other)

    def __invert__(self) -> "Condition":
        return Unless(self)


@dataclass(frozen=True, slots=True)
class Both(Condition):
    """Two conditions at once."""

    first: Condition
    second: Condition

    def holds(self, stated: Stated) -> bool:
        return self.first.holds(stated) and self.second.holds(stated)

    def offenders(self, stated: Stated) -> tuple[str, ...]:
        return tuple(dict.fromkeys(self.first.offenders(stated) + self.second.offenders(stated)))


@dataclass(frozen=True, slots=True)
class Unless(Condition):
    """The opposite of a condition; it points at nothing."""

    condition: Condition

    def holds(self, stated: Stated) -> bool:
        return not self.condition.holds(stated)

    def offenders(self, _stated: Stated) -> tuple[str, ...]:
        return ()


@dataclass(frozen=True, slots=True)
class Count(Condition):
    """The number of slots that are filled lies between two bounds."""

    slots: tuple[Slot, ...]
    least: int = 0
    most: int = 1_000

    def holds(self, stated: Stated) -> bool:
        return self.least <= sum(any(name in stated for name in slot) for slot in self.slots) <= self.most

    def offenders(self, stated: Stated) -> tuple[str, ...]:
        return tuple(name for slot in self.slots for name in slot if name in stated)


@dataclass(frozen=True, slots=True)
class Value(Condition):
    """Some of these names has a value outside the bounds; a bound that is open excludes itself."""

    names: tuple[str, ...]
    least: Decimal = Decimal("-Infinity")
    most: Decimal = Decimal("Infinity")
    excluding: Decimal | None = None

    @property
    def reads_values(self) -> bool:  # type: ignore[override]
        return True

    def holds(self, stated: Stated) -> bool:
        for name in self.names:
            value = stated.get(name)
            if value is not None and not (self.least <= value <= self.most and value != self.excluding):
                return True
        return False

    def offenders(self, stated: Stated) -> tuple[str, ...]:
        return tuple(name for name in self.names if name in stated and self.holds({name: stated[name]}))


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
