"""Packages of extras, such as `contoursolve[picture]`: imported where they are needed, or told to be missing."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from contoursolve.diagnostics.errors import UserError


class MissingExtraError(UserError, ImportError):
    """A package of an extra is missing, or a font for it; the message says what needs it and what to install."""


@contextmanager
def importing(extra: str, purpose: str) -> Iterator[None]:
    """Context for imports that need the packages of an extra. Raises MissingExtraError without one of them."""
    try:
        yield
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package in ("", "contoursolve"):
            raise
        # The interpreter that runs this is named: any other `pip` may install for another one.
        python = f'"{sys.executable}"' if " " in sys.executable else sys.executable or "python"
        raise MissingExtraError(
            f'{purpose} needs {package}; install it with: {python} -m pip install "contoursolve[{extra}]"'
        ) from None


def need(module: str, extra: str, purpose: str) -> Any:
    """A module of an extra. Raises MissingExtraError."""
    with importing(extra, purpose):
        return import_module(module)
