"""Choices that are named by a text: the member of an enum with that value, or an error that lists them all."""

from enum import Enum
from typing import TypeVar

Choice = TypeVar("Choice", bound=Enum)


def choice_of(kind: type[Choice], value: str, argument: str) -> Choice:
    """The member of an enum with this value. Raises ValueError, which lists the choices."""
    for member in kind:
        if member.value == value:
            return member
    raise ValueError(f"{argument} cannot be {value!r}; choose from {', '.join(str(each.value) for each in kind)}")
