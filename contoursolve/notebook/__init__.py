"""Notebooks: how records show themselves, and a contour to move."""

from contoursolve.notebook.entrance import explore

__all__ = ["explore"]
