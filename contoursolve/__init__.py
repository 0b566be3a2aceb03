"""contoursolve: why is this contour block refused, and where does it go?

It reads the contour blocks of CNC programs (Fanuc, Haas, Mitsubishi `,A ,C ,R`, HEIDENHAIN `FL FC` and DIN
PLUS, SINUMERIK `ANG`, ISG `#ANG`, NCT 99M, YASNAC LX3 `G111`), turns each into a small system of equations, and says
what is missing, what is said twice, and what the path is. Lengths are in mm, X of a lathe is a radius, angles are in
degrees.

>>> import contoursolve
>>> result = contoursolve.solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.")
>>> [element.name for element in result.answer.contour.elements]
['line 1', 'corner 1', 'line 2', 'corner 2']
"""

from collections.abc import Callable
from importlib import import_module
from typing import Any

from lazy_loader import attach_stub

from contoursolve.diagnostics import did_you_mean, register_functions

__version__ = "0.1.0"

_found, __dir__, __all__ = attach_stub(__name__, __file__)


def __getattr__(name: str) -> Any:
    if name in __all__:
        return _found(name)
    hint = did_you_mean(name, __all__).strip()
    raise AttributeError(f"module 'contoursolve' has no attribute {name!r}{hint and f'; {hint}'}")


_ROOMS = {
    "bundle": "notebook",
    "completions": "diagnosis",
    "construction_lines": "output",
    "draw": "outcomes",
    "legal_blocks": "diagnosis",
    "list_solutions": "diagnosis",
    "plot_record": "pictures",
    "sketch_system": "sketches",
    "solve_sketch": "sketches",
    "standing_alone": "notebook",
    "stated_words": "output",
    "status_text": "diagnosis",
    "system_latex": "output",
    "systems_to_json": "output",
    "text_of": "notebook",
    "to_smt": "output",
    "tool_text": "output",
    "ways_to_complete": "diagnosis",
    "with_words": "diagnosis",
    "words_to_add": "diagnosis",
    "write_sketch": "sketches",
}
"""The room of each function to which a method of a record in a room below leads."""


def _function(name: str) -> Callable[..., Any]:
    found: Callable[..., Any] = getattr(import_module(f"{__name__}.{_ROOMS[name]}"), name)
    return found


register_functions(_function)
