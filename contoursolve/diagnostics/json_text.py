"""Plain data as JSON."""

import json
from collections.abc import Mapping
from decimal import Decimal
from enum import Enum
from math import isfinite
from typing import Any

import msgspec
from msgspec import Struct


def json_text(data: Any) -> str:
    """One document: ASCII, which every console prints; a number that JSON does not know raises ValueError."""
    # The encoder of the standard library with an indent is pure Python: eight times as slow.
    text = json.dumps(data, ensure_ascii=True, allow_nan=False)
    try:
        return msgspec.json.format(text, indent=1)
    except msgspec.DecodeError:  # half of a surrogate pair, which is no Unicode, or lists as deep as no document is
        return json.dumps(data, indent=1, ensure_ascii=True, allow_nan=False)


def members(record: object, names: str) -> dict[str, Any]:
    """Fields of a record as members of an object: each name is one of both, or `member=field`."""
    pairs = (name.partition("=") for name in names.split())
    return {member: plain(getattr(record, attribute or member)) for member, _, attribute in pairs}


def plain(value: Any) -> Any:
    """A value as JSON holds it: enums by their values, records with all their fields, null for what is not finite, and
    decimal numbers as texts with the digits that they have."""
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, float):
        return value if isfinite(value) else None
    if isinstance(value, Decimal):
        return f"{value:f}"
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    if isinstance(value, Mapping):
        return {name: plain(each) for name, each in value.items()}
    if isinstance(value, Struct):
        return {name: plain(getattr(value, name)) for name in value.__struct_fields__}
    return value
