"""Packages of extras, such as `contoursolve[picture]`: imported where they are needed, or told to be missing."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from contoursolve.diagnostics.errors import UserError


class MissingExtraError(UserError, ImportError):
    """A package of an extra is missing, or a font for it; the message says what needs it and what to install."""


class LateModule:
    """A module that few need, imported when one of its names is asked for, by `typing.get_type_hints`, too."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, name: str) -> Any:
        return getattr(import_module(self._name), name)


@contextmanager
def importing(extra: str, purpose: str) -> Iterator[None]:
    """Context for imports that need the packages of an extra. Raises MissingExtraError without one of them."""
    try:
        yield
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package in ("", "contoursolve"):
            raise
        raise MissingExtraError(f"{purpose} needs {package}{_advice(extra)}") from None


def _advice(extra: str) -> str:
    """The end of the sentence: where the package is to come from, in the way in which contoursolve was installed."""
    wanted, environment = f'"contoursolve[{extra}]"', Path(sys.prefix)
    if getattr(sys, "frozen", False):
        # The program for a computer without Python (editors/desktop).
        return f"; this program is without it; where there is Python, install: python -m pip install {wanted}"
    if (environment / "pipx_metadata.json").is_file():
        command = f"pipx inject {environment.name} {wanted}"
    else:
        # The interpreter that runs this is named: any other `pip` may install for another one.
        python = f'"{sys.executable}"' if " " in sys.executable else sys.executable or "python"
        command = _of_uv_tool(environment / "uv-receipt.toml", extra)
        if not command and find_spec("pip") is None and _is_of_uv(environment):
            command = f"uv pip install --python {python} {wanted}"
        command = command or f"{python} -m pip install {wanted}"
    return f"; install it with: {command}"


def _of_uv_tool(receipt: Path, extra: str) -> str:
    """The command that installs a tool of uv again, with one more extra; empty where it is not ours."""
    from tomllib import load  # noqa: PLC0415 - only here

    if not receipt.is_file():
        return ""
    with receipt.open("rb") as file:
        own, *others = load(file)["tool"]["requirements"]
    # From an index, and from a folder (docs/install.md); uv replaces a tool: what it has is named again.
    if own.keys() - {"name", "extras", "directory", "editable"} or own["name"] != "contoursolve":
        return ""
    place = own.get("directory") or own.get("editable") or own["name"]
    further = [f"--with {each['name']}" for each in others]
    wanted = f'"{place}[{",".join(sorted({*own.get("extras", ()), extra}))}]"'
    return " ".join(["uv tool install", *["--editable"] * ("editable" in own), *further, wanted])


def _is_of_uv(environment: Path) -> bool:
    """Whether uv made the environment, which has no pip."""
    settings = environment / "pyvenv.cfg"
    return settings.is_file() and any(line.startswith("uv =") for line in settings.read_text("utf-8").splitlines())


def need(module: str, extra: str, purpose: str) -> Any:
    """A module of an extra. Raises MissingExtraError."""
    with importing(extra, purpose):
        return import_module(module)
