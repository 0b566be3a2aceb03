"""Findings, the places they are about, and where a fact comes from.

Nothing comes in but text and numbers; records go out that every other room uses. Begin with `finding`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
