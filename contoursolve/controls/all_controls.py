"""All controls, by name; the tables of one are read when it is asked for."""

from collections.abc import Iterator, Mapping

from contoursolve import controls
from contoursolve.reading import Dialect

_SHOWN_BY = {
    "yasnac-lx3": ("G 11", "G 12"),
    "nct-99m": (",", "R I J", "R I K", "R J K"),
    "fanuc-lathe": (",",),
    "fanuc-mill": (",",),
    "haas-lathe": (",",),
    "haas-mill": (",",),
    "mitsubishi": (",", "G H"),
    "siemens-840d": ("=",),
    "siemens-808d": ("=",),
    "isg": ("#", "G 301", "G 302"),
    "heidenhain": ("BEG", "FL", "FC", "F AN", "F LEN", "F CC"),
}
"""What a line has, in upper case, that shows a control: all parts of one of these texts, anywhere. What else it needs
for that the control's own `signs` say."""
_PARTS = {name: [text.split() for text in shown_by] for name, shown_by in _SHOWN_BY.items()}


class _Controls(Mapping[str, Dialect]):
    """The controls by name. Most programs are for one of them, and show no other."""

    def __getitem__(self, name: str) -> Dialect:
        if name not in _SHOWN_BY:
            raise KeyError(name)
        found: Dialect = getattr(controls, name.upper().replace("-", "_"))
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(_SHOWN_BY)

    def __len__(self) -> int:
        return len(_SHOWN_BY)

    def __or__(self, others: Mapping[str, Dialect]) -> dict[str, Dialect]:
        return {**self, **others}

    def showing(self, line: str) -> Iterator[Dialect]:
        """The controls that a line may show, in order; their `signs` say whether it does."""
        text = line.upper()
        for name, ways in _PARTS.items():
            if any(all(part in text for part in parts) for parts in ways):
                yield self[name]


DIALECTS = _Controls()
