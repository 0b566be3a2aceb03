"""Data that IPython gets of a record: text, HTML and a picture."""

import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any

from contoursolve.diagnosis import Answer, EquationSystem
from contoursolve.diagnostics import Shown
from contoursolve.families import Family, FeasibleRange, FeasibleRegion
from contoursolve.notebook.records import bounded, text_of
from contoursolve.program import Result
from contoursolve.solving import Drawing, Drawings, Sketch

__all__ = ["bundle", "text_of"]

_DRAWN = (Answer, Result, Family, FeasibleRange, FeasibleRegion, Sketch, Drawings, Drawing)
"""Records with a picture."""

MOST_CHARACTERS = 2_000_000
"""Of HTML or SVG; what is larger stays text."""


def bundle(record: Shown) -> dict[str, str]:
    """A record by the types of data that a notebook knows. What cannot be made is left out."""
    shown = {"text/plain": bounded(text_of(record))}
    if _is_terminal():
        return shown
    if isinstance(record, _DRAWN) and (not isinstance(record, Result) or record.answers):
        shown["image/svg+xml"] = _made(_svg, record)
    if isinstance(record, EquationSystem):
        shown["text/latex"] = _made(_latex, record)
    shown["text/html"] = _made(_html, record)
    return {kind: text for kind, text in shown.items() if kind == "text/plain" or 0 < len(text) <= MOST_CHARACTERS}


def _made(make: Callable[[Any], str], record: object) -> str:
    """The text that `make` gives for a record; empty if a package is missing or the record cannot be drawn."""
    try:
        return make(record)
    except Exception:  # the text says the same
        return ""


def _svg(record: Any) -> str:
    from contoursolve.pictures import Theme, draw  # noqa: PLC0415 - text needs no picture

    return draw(record, theme=Theme.PAGE).svg


def _html(record: Shown) -> str:
    from contoursolve.notebook.records_html import html_of  # noqa: PLC0415 - needs an extra

    return html_of(record)


def _latex(record: EquationSystem) -> str:
    from contoursolve.output import system_latex  # noqa: PLC0415 - sympy is slow to import

    return f"$\\displaystyle {system_latex(record)}$"


def _is_terminal() -> bool:
    """Whether IPython runs in a terminal, which shows text only."""
    if "IPython" not in sys.modules:
        return False
    shell = import_module("IPython").get_ipython()
    return shell is not None and shell.display_formatter.active_types == ["text/plain"]
