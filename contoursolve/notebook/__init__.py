"""Notebooks: how records show themselves, and a contour to move."""

from contoursolve.notebook.entrance import MissingExtraError, explore

__all__ = ["MissingExtraError", "explore"]
