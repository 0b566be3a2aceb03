"""Records that show themselves in notebooks, are text where they are printed, and answer with what rooms above have."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

_find: list[Callable[[str], Callable[..., Any]]] = []


def register_functions(find: Callable[[str], Callable[..., Any]]) -> None:
    """Register what finds a function by its name, in a room above; its module is imported then, and not before."""
    _find[:] = [find]


def from_above(name: str, record: Any, *arguments: Any, **options: Any) -> Any:
    """The result of a function that a room above has for methods of records: that of a record, and further
    arguments."""
    return _find[0](name)(record, *arguments, **options)


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
        return "\n".join(from_above("text_of", self)).rstrip()

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """Text, HTML and SVG of this record, as IPython asks for them; what cannot be drawn is text."""
        try:
            bundle = from_above("bundle", self)
        except Exception:  # a notebook must go on, whatever is missing or broken
            return {"text/plain": repr(self)}
        wanted = set(include or bundle) - set(exclude or ())
        return {kind: text for kind, text in bundle.items() if kind in wanted}
