"""Output for people and programs: text, JSON, SARIF, DXF, HTML.

Results come in, lines and documents go out. Begin with `listing` for text, `document` for JSON.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
