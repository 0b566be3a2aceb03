"""All controls, by name; the tables of one are read when it is asked for."""

from collections.abc import Iterator, Mapping
from importlib import import_module

from contoursolve.reading import Control

_CONTROLS: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "yasnac-lx3": ("yasnac_lx3", ("G 11", "G 12")),
    "nct-99m": ("nct_99m", (",", "R I J", "R I K", "R J K")),
    "fanuc-lathe": ("fanuc", (",",)),
    "fanuc-mill": ("fanuc", (",",)),
    "haas-lathe": ("fanuc", (",",)),
    "haas-mill": ("fanuc", (",",)),
    "mitsubishi": ("mitsubishi", (",", "G H")),
    "siemens-840d": ("siemens", ("ANG =", "RND =", "CHR =", "CHF =")),
    "siemens-808d": ("siemens", ("ANG =", "RND =", "CHR =", "CHF =")),
    "isg": ("isg", ("ANG #", "RND #", "CHR #", "CHF #", "G 301", "G 302")),
    "heidenhain": ("heidenhain", ("BEG", "FL", "FC", "F AN", "F LEN", "F CC")),
    "cnc-pilot": ("cnc_pilot", ("FERTIGTEIL", "FINISHED", "HILFSKONTUR", "AUXIL", "BEARBEITUNG")),
}
"""The folder that has the record of each, under its name in capitals; and what a line has, in upper case, that shows
the control: all parts of one of these texts, anywhere. What else it needs for that the control's own `signs` say."""

_PARTS = [
    (text.partition(" ")[0], text.split()[1:], {name for name, (_, texts) in _CONTROLS.items() if text in texts})
    for text in dict.fromkeys(text for _, texts in _CONTROLS.values() for text in texts)
]
"""The first part and the others of each of these texts, and the controls that they may show."""


class _Controls(Mapping[str, Control]):
    """The controls by name. Most programs are for one of them, and show no other."""

    def __init__(self) -> None:
        self._read: dict[str, Control] = {}

    def __getitem__(self, name: str) -> Control:
        if name not in self._read:
            module = import_module(f"contoursolve.controls.{_CONTROLS[name][0]}")
            self._read[name] = getattr(module, name.upper().replace("-", "_"))
        return self._read[name]

    def __iter__(self) -> Iterator[str]:
        return iter(_CONTROLS)

    def __len__(self) -> int:
        return len(_CONTROLS)

    def __or__(self, others: Mapping[str, Control]) -> dict[str, Control]:
        return {**self, **others}

    def showing(self, line: str) -> list[Control]:
        """The controls that a line may show, in order; their `signs` say whether it does."""
        text, shown = line.upper(), set[str]()
        for first, others, names in _PARTS:
            if first in text and (not others or all(part in text for part in others)):
                shown |= names
        return [self[name] for name in _CONTROLS if name in shown] if shown else []


CONTROLS = _Controls()
