"""The tables of controls in a pickle: a built-in one by where it stands, so that the very same object comes back."""

import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import cache, reduce
from typing import Any

from msgspec import Struct

from contoursolve.controls.all_controls import CONTROLS


class TablePlace(Struct, frozen=True):
    """The place of a table: its control, and the fields, rows and keys that lead to it from there."""

    control: str
    steps: tuple[Any, ...]

    def table(self) -> Any:
        """The table."""
        return reduce(_step, self.steps, CONTROLS[self.control])


def _step(part: Any, step: Any) -> Any:
    return part[step] if isinstance(part, tuple | Mapping) else getattr(part, step)


def reduced(table: Any) -> Any:
    """The pickled form of a table. One of a control of your own has its fields, those that are a built-in control's by
    their places; a function among the others stands in a module, as in every pickle."""
    place = _place_of(table)
    if place is not None:
        return TablePlace.table, (place,)
    own = {name: value if (at := _place_of(value)) is None else at for name, value in _fields(table)}
    return _made, (type(table), own)


def _made(kind: Callable[..., Any], own: Mapping[str, Any]) -> Any:
    return kind(**{name: each.table() if isinstance(each, TablePlace) else each for name, each in own.items()})


def _place_of(part: Any) -> TablePlace | None:
    """The place of a part of a built-in control; only one that has been read has parts."""
    for name in CONTROLS:
        steps = _places(name).get(id(part)) if CONTROLS.home_of(name) in sys.modules else None
        if steps is not None:
            return TablePlace(name, steps)
    return None


@cache
def _places(control: str) -> Mapping[int, tuple[Any, ...]]:
    """The steps that lead to the records of a control and to its own fields, by their ids: it keeps them for ever."""
    found: dict[int, tuple[Any, ...]] = {}
    waiting: list[tuple[Any, tuple[Any, ...]]] = [(CONTROLS[control], ())]
    for part, steps in waiting:
        if id(part) not in found:
            parts = [*_parts(part)]
            if parts or callable(part):
                found[id(part)] = steps
            waiting += ((each, (*steps, step)) for step, each in parts)
    return found


def _parts(part: Any) -> Iterator[tuple[Any, Any]]:
    """The parts of a table, each with the step to it."""
    if isinstance(part, type):
        return
    if isinstance(part, Mapping):
        yield from part.items()
    elif isinstance(part, tuple):
        yield from enumerate(part)
    elif isinstance(part, Struct):
        yield from ((name, getattr(part, name)) for name in part.__struct_fields__)
    elif is_dataclass(part):
        yield from _fields(part)


def _fields(table: Any) -> Iterator[tuple[str, Any]]:
    """The fields of a table that it is made of: the others keep what was asked for."""
    return ((each.name, getattr(table, each.name)) for each in fields(table) if each.init)
