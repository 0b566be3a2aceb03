"""The workbench: a page on the shop's own PC, where programs are opened, understood, mended and saved.

Actions come in, as plain data; what changes on the page goes out. Begin with `desk`, which knows no web.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
