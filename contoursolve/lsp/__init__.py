"""The language server: findings, fixes, hovers and completions in any editor that speaks its protocol (LSP 3.17).

A client's messages come in, records of the protocol go out. All of it rests on the public functions of contoursolve;
begin with `server`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
