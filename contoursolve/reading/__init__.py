"""The meaning of a control's words: its lexicon, its modal state, its contour forms, its rules.

Blocks come in, the modal state and parsed contours go out. Begin with `control`, which lists what a control is.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
