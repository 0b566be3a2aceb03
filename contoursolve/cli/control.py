"""The option --control: a control that is built in by its name, one of your own by where its tables are."""

import sys
from collections.abc import Callable, Iterable
from importlib import import_module
from pathlib import Path
from typing import Any

import click
from click.shell_completion import CompletionItem

from contoursolve.dialects import DIALECTS, Dialect

_OWN = "MODULE:NAME"


class ControlType(click.ParamType):  # type: ignore[type-arg]  # generic in newer releases of click only
    """The name of a control, or `package.module:NAME` of a Dialect, which is then given itself."""

    name = "control"

    def __init__(self, names: Iterable[str]) -> None:
        self.names = click.Choice([*names])

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if isinstance(value, Dialect) or ":" not in value:
            return value if isinstance(value, Dialect) else self.names.convert(value, param, ctx)
        module, _, name = value.partition(":")
        try:
            return _load(module, name)
        except (ImportError, TypeError) as error:
            self.fail(f"{value}: {error}", param, ctx)

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        return self.names.shell_complete(ctx, param, incomplete)


def control_option(
    help_: str, name: str = "--control", names: Iterable[str] = tuple(DIALECTS)
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """An option for a control; its value is a name, a Dialect, or None."""
    choices = [*names]
    own = f"{help_} {_OWN} names a Dialect of your own in a Python module, also one in this folder."
    return click.option(name, type=ControlType(choices), metavar=f"[{'|'.join((*choices, _OWN))}]", help=own)


def _load(module: str, name: str) -> Dialect:
    """The tables of this name in a module that Python finds, also from here. Raises ImportError, TypeError."""
    here = str(Path.cwd())
    if here not in sys.path:
        sys.path.append(here)
    try:
        imported = import_module(module)
    except Exception as error:
        # Whatever the module does.
        told = f"{module or 'the module'} cannot be imported: {type(error).__name__}: {error}"
        raise ImportError(f"{told}{_where(module, error)}") from None
    found = getattr(imported, name, None)
    if not isinstance(found, Dialect):
        path = getattr(imported, "__file__", None)
        file = f" ({path})" if path else ""
        raise TypeError(f"{module}{file} has no contoursolve.Dialect of the name {name!r}")
    return found


def _where(module: str, error: Exception) -> str:
    """What to do about a module that is not there."""
    if not isinstance(error, ModuleNotFoundError) or error.name not in (module, module.partition(".")[0]):
        return ""
    if module.endswith(".py"):
        return f"; write the module without .py, {module.removesuffix('.py')}:NAME"
    return f"; a module is looked for among those of Python, then in this folder, {Path.cwd()}"
