"""Records about lines of a program that have other numbers now: their places, and the lines that their texts name."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass, replace as with_fields
from enum import Enum
from functools import partial
from operator import is_
from typing import Any, Protocol

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Fix, LineChange, OpenNumber, Span
from contoursolve.gcode import Block
from contoursolve.geometry import Plane
from contoursolve.reading import Awaited


class Renumbering(Protocol):
    """Other numbers of lines."""

    def line(self, line: int) -> int:
        """The number that a line has now."""

    def place(self, span: Span) -> Span:
        """The place that a place is now."""


_LINES = re.compile(r"(?<=program )lines? \d+(?:, \d+)*(?: and \d+)?")
"""Line numbers as messages name them; `line 1` alone is an element of a contour."""


_TEXTS = {Fix: ("replacement", "replaced", "example"), LineChange: ("old", "text")}
"""Texts of programs, which name no lines."""


def renumbered(record: Any, now: Renumbering) -> Any:
    """A record with every line that it names as it is now."""
    if isinstance(record, str):
        if "program line" not in record:
            return record
        return _LINES.sub(lambda lines: re.sub(r"\d+", lambda line: str(now.line(int(line[0]))), lines[0]), record)
    if isinstance(record, Span):
        return now.place(record)
    if isinstance(record, Enum | Plane):
        return record
    if isinstance(record, Awaited):
        return record.then(partial(renumbered, now=now))
    if isinstance(record, tuple):
        parts = [renumbered(each, now) for each in record]
        return record if all(map(is_, parts, record)) else tuple(parts)
    if isinstance(record, Mapping):
        values = {name: renumbered(each, now) for name, each in record.items()}
        return record if all(values[name] is each for name, each in record.items()) else values
    if isinstance(record, Struct):
        names = [name for name in record.__struct_fields__ if name not in _TEXTS.get(type(record), ())]
        changes = _changes(record, names, now)
        changes |= {"line": now.line(record.line)} if isinstance(record, Block | OpenNumber) else {}
        return replace(record, **changes) if changes else record
    if is_dataclass(record) and not isinstance(record, type):
        changes = _changes(record, [each.name for each in fields(record)], now)
        return with_fields(record, **changes) if changes else record
    return record


def _changes(record: Any, names: Iterable[str], now: Renumbering) -> dict[str, Any]:
    old = {name: getattr(record, name) for name in names}
    new = {name: renumbered(each, now) for name, each in old.items()}
    return {name: each for name, each in new.items() if each is not old[name]}
