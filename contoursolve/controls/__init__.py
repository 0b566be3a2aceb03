"""The controls: each is a record of tables in a folder of its own.

Blocks come in, parsed contours go out, and the rules about them. Begin with a folder, or with `common` for what holds
for every control.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
