"""Characters into blocks and words, exactly as typed.

A text or a file comes in, blocks of words with their places go out; no word has a meaning yet. Begin with `word`,
then `lexer`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
