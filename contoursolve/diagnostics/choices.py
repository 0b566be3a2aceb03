"""Choices that are named by a text: the member of an enum with that value, or an error that lists them all; and names
that a misspelt one is close to."""

from collections.abc import Iterable
from enum import Enum
from functools import lru_cache
from typing import TypeVar

Choice = TypeVar("Choice", bound=Enum)


def choice_of(kind: type[Choice], value: str, argument: str) -> Choice:
    """The member of an enum with this value. Raises ValueError, which lists the choices."""
    for member in kind:
        if member.value == value:
            return member
    raise ValueError(f"{argument} cannot be {value!r}; choose from {', '.join(str(each.value) for each in kind)}")


def names_like(word: str, names: Iterable[str]) -> list[str]:
    """The names that a word was probably meant to be, the closest first; capitals do not matter."""
    from difflib import get_close_matches  # noqa: PLC0415 - most words are right

    known = {name.lower(): name for name in names}
    return [known[each] for each in get_close_matches(word.lower(), known)]


def did_you_mean(word: str, names: Iterable[str]) -> str:
    """The question whether one of these names was meant, with a blank behind it; empty if none is close."""
    near = names_like(word, names)
    return f"did you mean {' or '.join(near)}? " if near else ""


@lru_cache(maxsize=4096)
def typing_distance(first: str, second: str) -> int:
    """The slips between two words: the optimal string alignment distance, in which neighbours may be swapped."""
    rows = [list(range(len(second) + 1))]
    for at, letter in enumerate(first, 1):
        row = [at]
        for other, meant in enumerate(second, 1):
            best = min(rows[-1][other] + 1, row[-1] + 1, rows[-1][other - 1] + (letter != meant))
            if at > 1 and other > 1 and letter == second[other - 2] and first[at - 2] == meant:
                best = min(best, rows[-2][other - 2] + 1)
            row.append(best)
        rows.append(row)
    return rows[-1][-1]
