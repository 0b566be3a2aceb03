"""Fields of an action, as a page sends them."""

from collections.abc import Mapping
from typing import Any

from contoursolve.diagnostics import UserError

Data = dict[str, Any]

_NEEDED = object()
_KINDS = {str: "a text", int: "a whole number", bool: "true or false", dict: "an object", list: "a list"}


class ActionError(UserError, ValueError):
    """An action that cannot be done; the message says why, and `more` what else is told."""

    def __init__(self, message: str, **more: Any) -> None:
        super().__init__(message)
        self.more = more


def read_field(action: Mapping[str, Any], name: str, kind: type, default: Any = _NEEDED) -> Any:
    """A field of an action, of this kind of JSON; without it, or where it is null, the default. Raises ActionError."""
    value = action.get(name)
    if value is None and default is not _NEEDED:
        return default
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        raise ActionError(f"{action.get('do')} needs {_KINDS[kind]} for {name}; nothing was changed")
    return value
