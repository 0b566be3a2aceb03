"""Records that show themselves in notebooks, and are text where they are printed."""

from importlib import import_module
from typing import Any


class Shown:
    """A record that a notebook shows as a picture with tables, and everything else as text.

    Only showing it needs the rooms above, so they are imported by name, when it is shown.
    """

    __slots__ = ()

    def __str__(self) -> str:
        """What the terminal prints of this record; its `repr` has all its fields."""
        return "\n".join(import_module("contoursolve.notebook.records").text_of(self)).rstrip()

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """Text, HTML and SVG of this record, as IPython asks for them; what cannot be drawn is text."""
        try:
            bundle: dict[str, str] = import_module("contoursolve.notebook.records").bundle(self)
        except Exception:  # a notebook must go on, whatever is missing or broken
            return {"text/plain": repr(self)}
        wanted = set(include or bundle) - set(exclude or ())
        return {kind: text for kind, text in bundle.items() if kind in wanted}
