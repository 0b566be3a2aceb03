"""Conventions of a control on which its manual is silent: settings with a name, which a user can change."""

from collections.abc import Mapping
from dataclasses import dataclass

from contoursolve.source import Source


@dataclass(frozen=True, slots=True)
class Setting:
    """One convention: what it decides, its values with what each means, the one in force unless told otherwise,
    and why."""

    name: str
    meaning: str
    values: Mapping[str, str]
    default: str
    source: Source


@dataclass(frozen=True, slots=True)
class Convention:
    """A setting with the value that was used."""

    setting: Setting
    value: str

    @property
    def meaning(self) -> str:
        """What the value means."""
        return self.setting.values[self.value]
