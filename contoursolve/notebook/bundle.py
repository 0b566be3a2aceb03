"""What a notebook gets of a record: the terminal's text always, HTML and a picture where they can be made."""

import sys
from collections.abc import Iterable
from importlib import import_module
from itertools import islice

from contoursolve.examine import Answer
from contoursolve.families import Family, Feasible, Region
from contoursolve.notebook.text import text_of
from contoursolve.pipeline import Result
from contoursolve.shown import Shown

MOST_LINES = 400
"""Lines of text."""

WIDEST = 400
"""Characters of a line."""

MOST_CHARACTERS = 2_000_000
"""Of HTML or SVG; what is larger stays text."""


def bundle(record: Shown) -> dict[str, str]:
    """A record by the types of data that a notebook knows. What cannot be made is left out."""
    shown = {"text/plain": bounded(text_of(record))}
    if _is_terminal():
        return shown
    if isinstance(record, Answer | Result | Family | Feasible | Region) and (
        not isinstance(record, Result) or record.answers
    ):
        shown["image/svg+xml"] = _made("contoursolve.markup.picture", "picture_of", record)
    shown["text/html"] = _made("contoursolve.notebook.html", "html_of", record)
    return {kind: text for kind, text in shown.items() if kind == "text/plain" or 0 < len(text) <= MOST_CHARACTERS}


def bounded(lines: Iterable[str]) -> str:
    """Lines as one text of a bounded size."""
    first = list(islice(lines, MOST_LINES + 1))
    shown = [line if len(line) <= WIDEST else f"{line[:WIDEST]} ..." for line in first[:MOST_LINES]]
    if len(first) > MOST_LINES:
        shown.append("...")
    return "\n".join(shown).rstrip()


def _made(module: str, name: str, record: object) -> str:
    """What a function makes of a record; nothing where a package is missing or the record cannot be drawn."""
    try:
        return str(getattr(import_module(module), name)(record))
    except Exception:  # the text says the same
        return ""


def _is_terminal() -> bool:
    """Whether IPython runs in a terminal, which shows text only."""
    if "IPython" not in sys.modules:
        return False
    shell = import_module("IPython").get_ipython()
    return shell is not None and shell.display_formatter.active_types == ["text/plain"]
