"""Data that IPython gets of a record: text, HTML and a picture."""

import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any

from contoursolve.diagnosis import Answer, Derivation, EquationSystem
from contoursolve.diagnostics import Shown
from contoursolve.families import Family, FeasibleRange, FeasibleRegion
from contoursolve.notebook.records import bounded, text_of
from contoursolve.program import Result
from contoursolve.solving import Drawing, Drawings, Sketch

__all__ = ["bundle", "text_of", "with_widget"]

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
        shown["text/latex"] = _made(EquationSystem._repr_latex_, record)
    if isinstance(record, Derivation):
        shown["text/latex"] = record.latex
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
    from contoursolve.notebook.records_html import html_of  # noqa: PLC0415 - htpy is slow to import

    return html_of(record)


def with_widget(bundled: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    """Data and metadata by which a widget is shown: nothing where a program executes the notebook, such as
    `nbconvert --execute`. The page that it makes would show the widget, which is dead there, in place of a picture."""
    data, metadata = bundled if isinstance(bundled, tuple) else (bundled or {}, {})
    kernel: Any = getattr(_shell(), "kernel", None)
    request = kernel.get_parent("shell") if hasattr(kernel, "get_parent") else {}
    # Who executes notebooks lets no cell ask for input; where somebody reads along, it may.
    is_read = request.get("content", {}).get("allow_stdin", True)
    return (data if is_read else {}), metadata


def _is_terminal() -> bool:
    """Whether IPython runs in a terminal, which shows text only."""
    shell = _shell()
    return shell is not None and shell.display_formatter.active_types == ["text/plain"]


def _shell() -> Any:
    """The shell of IPython that runs this; None without one."""
    return import_module("IPython").get_ipython() if "IPython" in sys.modules else None
