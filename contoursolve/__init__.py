"""contoursolve: why is this contour block refused, and where does it go?

It reads the contour blocks of CNC programs (Fanuc, Haas, Mitsubishi `,A ,C ,R`, HEIDENHAIN `FL FC` and DIN
PLUS, SINUMERIK `ANG`, ISG `#ANG`, NCT 99M, YASNAC LX3 `G111`), turns each into a small system of equations, and says
what is missing, what is said twice, and what the path is. Lengths are in mm, X of a lathe is a radius, angles are in
degrees.

>>> import contoursolve
>>> result = contoursolve.solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.")
>>> [element.name for element in result.answers[0].contour.elements]
['line 1', 'corner 1', 'line 2', 'corner 2']
"""

from typing import TYPE_CHECKING

from lazy_loader import attach_stub

from contoursolve.diagnostics import register_renderer

if TYPE_CHECKING:
    from contoursolve.diagnostics import Renderer

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)


def _renderer() -> "Renderer":
    from contoursolve.notebook import mime_bundle  # noqa: PLC0415 - when something is shown

    return mime_bundle


register_renderer(_renderer)
