"""Arguments that fit: the member of an enum that a text names, names that a misspelt one is close to, and values of the
type that is asked for; or an error that says what fits."""

from collections.abc import Callable, Iterable
from enum import Enum
from functools import lru_cache, wraps
from types import UnionType
from typing import Any, ParamSpec, TypeVar

Choice = TypeVar("Choice", bound=Enum)
P = ParamSpec("P")
T = TypeVar("T")

_NUMBERS = (int, float, bool)
"""Types that stand for each other."""

_LONGEST = 40
"""Characters of a value that a message shows."""


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


def check_type(argument: str, value: object, kind: type | UnionType, fits: str = "") -> None:
    """Raise TypeError, which names the argument and what fits, where a value is of another type."""
    if not isinstance(value, kind):
        name = getattr(kind, "__name__", str(kind))
        fits = fits or ("a text (str)" if kind is str else f"{'an' if name[0] in 'AEIOU' else 'a'} {name}")
        # Whoever solves a program has a result of several answers.
        hint = "; take one of its `answers`" if name == "Answer" and hasattr(value, "answers") else ""
        raise TypeError(f"{argument} is {fits}, not {_shown(value)}{hint}")


def _shown(value: object) -> str:
    """A value in a message: itself if it is short, else its type."""
    text = repr(value)
    return text if len(text) <= _LONGEST else type(value).__name__


def _is_plain(kind: type | UnionType) -> bool:
    """Whether values can be held against a type, as they cannot against `Sequence[str]`."""
    return not any(getattr(each, "__args__", ()) for each in getattr(kind, "__args__", ()))


def checked(function: Callable[P, T]) -> Callable[P, T]:
    """A function that names an argument whose type is none of its own, instead of failing somewhere inside."""
    kinds: dict[str, Any] = {
        name: kind
        for name, kind in function.__annotations__.items()
        if isinstance(kind, type | UnionType) and kind not in _NUMBERS and name != "return" and _is_plain(kind)
    }
    names = function.__code__.co_varnames[: function.__code__.co_argcount]

    @wraps(function)
    def checking(*arguments: P.args, **options: P.kwargs) -> T:
        for name, value in (*zip(names, arguments, strict=False), *options.items()):
            if name in kinds:
                check_type(name, value, kinds[name])
        return function(*arguments, **options)

    return checking
