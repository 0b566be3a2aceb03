"""What is not on the pages that we have: settings, which a user can change, and what a control is taken to accept."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from decimal import Decimal

from contoursolve.model import Role
from contoursolve.rules import Condition, Stated
from contoursolve.source import Evidence, Source


@dataclass(frozen=True, slots=True)
class Setting:
    """One convention: what it decides, its values with what each means, the one in force unless told otherwise,
    and why.

    The value of one with `bounds` is a number between them, both in mm, and its values are the default one alone.
    """

    name: str
    meaning: str
    values: Mapping[str, str]
    default: str
    source: Source
    bounds: tuple[Decimal, Decimal] | None = None

    def choices(self, value: str) -> str:
        """What it can be, if it cannot have this value; else empty."""
        if self.bounds is None:
            return "" if value in self.values else f"values are: {', '.join(self.values)}"
        least, most = self.bounds
        is_number = _NUMBER.fullmatch(value) is not None
        return "" if is_number and least <= Decimal(value) <= most else f"it is a number from {least} to {most} mm"

    def meaning_of(self, value: str) -> str:
        """What a value means."""
        return self.values[value] if self.bounds is None else f"{self.meaning}: {value} mm"


_NUMBER = re.compile(r"\d{1,9}(\.\d{0,9})?|\.\d{1,9}", re.ASCII)


@dataclass(frozen=True, slots=True)
class Convention:
    """A setting with the value that was used."""

    setting: Setting
    value: str

    @property
    def meaning(self) -> str:
        """What the value means."""
        return self.setting.meaning_of(self.value)

    @property
    def evidence(self) -> Evidence:
        """How well it is known that the control means this: of another value than the default one, not at all."""
        return self.setting.source.evidence if self.value == self.setting.default else Evidence.ASSUMED


AT_ITS_LIMIT = "@at its limit"
"""The circumstance that a 45 degree bevel begins or ends at its virtual intersection."""


@dataclass(frozen=True, slots=True, eq=False)
class Assumption:
    """What a control is taken to accept, or to mean, although no page that we have says so.

    `meaning` is half a sentence without a full stop. A contour rests on it where `when` holds for what the blocks of
    one of its `roles` state: values and circumstances by name, and in a form of one block every address.
    """

    name: str
    meaning: str
    source: Source
    roles: tuple[str, ...]
    when: Condition

    def carries(self, roles: Iterable[Role], stated: Stated) -> bool:
        """Whether a contour of these roles, which states this, rests on it."""
        for role in roles:
            if role.name in self.roles:
                own = {call: stated[name] for call, name in role.names(stated).items()}
                if self.when.holds(own):
                    return True
        return False
