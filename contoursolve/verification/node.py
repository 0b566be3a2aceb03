"""Reading a JSON document that may hold anything: each value knows its place, so that an error can name it."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite
from typing import Any, NoReturn

from contoursolve.verification.document import CannotVerifyError, Document

FARTHEST = 1e12
"""mm. The largest number read: words end at 1e6 mm, and intersections of lines 0.001 deg apart at 1e11 mm."""

_SHOWN = 60
"""Characters of a value that an error message shows."""

Coordinates = tuple[float, float]
"""mm in the plane's axes, X of a lathe as radius, as the result has them."""


def read_json(document: Document) -> "Node":
    """The document as a whole. Raises CannotVerifyError if it is no JSON, or could be read in two ways."""
    return Node(_parse(document), "", document.name)


def _parse(document: Document) -> Any:
    try:
        return json.loads(document.data, parse_constant=_refuse_constant, object_pairs_hook=_unambiguous)
    except (ValueError, RecursionError) as error:
        reason = "it is nested too deeply" if isinstance(error, RecursionError) else str(error)
        told = f"{document.name} is not a result of 'solve --format json'"
        raise CannotVerifyError(f"{told}: it is no JSON document ({reason})") from None


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no number that JSON has")


def _unambiguous(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object; a name that stands twice could be read either way."""
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"the name {shown(twice)} stands twice in one object")
    return found


def shown(value: object) -> str:
    """A value of the result in pure ASCII, cut to a length that fits a line."""
    if isinstance(value, (list, dict)):
        return "a list" if isinstance(value, list) else "an object"
    if value is None or isinstance(value, bool):
        return json.dumps(value)
    # A number of thousands of digits cannot even be written out.
    text = "a very large number" if isinstance(value, int) and abs(value) > 10**_SHOWN else ascii(value)
    return text if len(text) <= _SHOWN else text[:_SHOWN] + "..."


@dataclass(frozen=True, slots=True)
class Node:
    """A value of the document with its place, so that an error can name it."""

    value: Any
    place: str
    document: str

    def refuse(self, message: str) -> NoReturn:
        raise CannotVerifyError(f"{self.document}: {self.place or 'the document'}: {message}")

    def expect(self, wanted: str) -> NoReturn:
        self.refuse(f"{shown(self.value)} where {wanted} is expected")

    def fields(self) -> "dict[str, Node]":
        return {name: self._at(name) for name in self._object()}

    def field(self, name: str) -> "Node":
        if name not in self._object():
            self.refuse(f"the field {name!r} is missing")
        return self._at(name)

    def _object(self) -> dict[str, Any]:
        if not isinstance(self.value, dict):
            self.expect("an object")
        return self.value

    def _at(self, name: str) -> "Node":
        # A name of the document's own making is shown as ASCII, whatever it holds.
        shown_name = ascii(name)[1:-1]
        return Node(self.value[name], f"{self.place}.{shown_name}" if self.place else shown_name, self.document)

    def maybe(self, name: str) -> "Node | None":
        """A field that older results lack; null counts as missing."""
        return self._at(name).optional() if name in self._object() else None

    def items(self) -> "Iterator[Node]":
        if not isinstance(self.value, list):
            self.expect("a list")
        for number, item in enumerate(self.value):
            yield Node(item, f"{self.place}[{number}]", self.document)

    def pair(self) -> "tuple[Node, Node]":
        found = tuple(self.items())
        if len(found) != 2:  # noqa: PLR2004 - a plane has two axes
            self.refuse(f"{len(found)} values where two are expected")
        return found

    def optional(self) -> "Node | None":
        return None if self.value is None else self

    def text(self) -> str:
        if not isinstance(self.value, str):
            self.expect("a text")
        return self.value

    def boolean(self) -> bool:
        if not isinstance(self.value, bool):
            self.expect("true or false")
        return self.value

    def integer(self) -> int:
        if self.whole() < 0:
            self.refuse(f"{shown(self.value)} is no line number")
        return self.whole()

    def whole(self) -> int:
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            self.expect("a whole number")
        if not abs(self.value) <= FARTHEST:
            self.refuse(f"{shown(self.value)} is no line number")
        return self.value

    def number(self) -> float:
        if isinstance(self.value, bool) or not isinstance(self.value, (int, float)):
            self.expect("a number")
        if not abs(self.value) <= FARTHEST or not isfinite(self.value):
            self.refuse(f"{shown(self.value)} is larger than any coordinate, {FARTHEST:g} mm")
        return float(self.value)

    def coordinates(self) -> Coordinates:
        first, second = self.pair()
        return first.number(), second.number()

    def choice(self, choices: tuple[str, ...]) -> str:
        if self.text() not in choices:
            self.refuse(f"{shown(self.value)} where one of {', '.join(choices)} is expected")
        return self.text()
