"""Records that show themselves in notebooks, and are text where they are printed."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Protocol


class Renderer(Protocol):
    """Renderer of records. A room far above has it, and the front door of the package registers it."""

    def text_of(self, record: "Shown") -> Iterable[str]:
        """The lines of a record, as a terminal prints them."""

    def bundle(self, record: "Shown") -> dict[str, str]:
        """Text, HTML and SVG of a record, by the types of data that a notebook knows."""

    def plot(self, record: "Shown", ax: Any, **options: Any) -> Any:
        """Draw a record on axes of matplotlib, and return them."""


_load: list[Callable[[], Renderer]] = []


def register_renderer(load: Callable[[], Renderer]) -> None:
    """Register what shows records from now on; it is loaded when one is shown for the first time."""
    _load[:] = [load]


def hash_of(record: Any) -> int:
    """The hash of a frozen record; of its mappings the names count, of what has no hash its type."""
    fields: Iterable[str] = getattr(record, "__struct_fields__", ())
    return hash((type(record), *(_part_of_hash(getattr(record, name)) for name in fields)))


def _part_of_hash(value: Any) -> int:
    if isinstance(value, Mapping):
        return hash(frozenset(value))
    if isinstance(value, (tuple, list)):
        return hash(tuple(map(_part_of_hash, value)))
    try:
        return hash(value)
    except TypeError:
        return hash(type(value))


class Shown:
    """A record that a notebook shows as a picture with tables, and everything else as text."""

    __slots__ = ()

    def __str__(self) -> str:
        """The text of this record as the terminal prints it; its `repr` has all its fields."""
        return "\n".join(_load[0]().text_of(self)).rstrip()

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """Text, HTML and SVG of this record, as IPython asks for them; what cannot be drawn is text."""
        try:
            bundle = _load[0]().bundle(self)
        except Exception:  # a notebook must go on, whatever is missing or broken
            return {"text/plain": repr(self)}
        wanted = set(include or bundle) - set(exclude or ())
        return {kind: text for kind, text in bundle.items() if kind in wanted}


def plot_on(record: Shown, ax: Any, **options: Any) -> Any:
    """A record on axes of matplotlib, or on the current ones without; returns them. Raises MissingExtraError."""
    return _load[0]().plot(record, ax, **options)
