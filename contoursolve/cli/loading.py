"""Programs from files, standard input and options, examined as the options say."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import click

from contoursolve import syntax
from contoursolve.api import UnreadableProgramError, follow_program, read_program
from contoursolve.cli.options import CouldNotRunError
from contoursolve.dialects import DIALECTS
from contoursolve.pipeline import FactPlaceError, Result, Run
from contoursolve.project import SettingError, find_settings, read_setting
from contoursolve.recognise import UnknownControlError
from contoursolve.syntax import STANDARD_INPUT, Program


def load(paths: Sequence[str], blocks: tuple[str, ...], start: str | None) -> list[Callable[[], Program]]:
    """How to get each program that is asked for; a file is read when its turn comes."""
    if blocks and paths:
        raise click.UsageError("give either a PROGRAM or --block, not both")
    if start is not None and not blocks:
        raise click.UsageError("--start goes with --block; a PROGRAM states its own positions")
    if blocks:
        return [lambda: syntax.parse("\n".join(blocks), "<block>")]
    if not paths:
        raise click.UsageError("missing PROGRAM: name a file, or - for standard input, or use --block")
    return [partial(read, path) for path in paths]


def read(path: str) -> Program:
    """The program of a file, or of standard input; one that cannot be read ends the command."""
    try:
        return read_program(path)
    except UnreadableProgramError as error:
        raise CouldNotRunError(str(error)) from None


def named_after(program: str | None, suffix: str) -> Path:
    """The file in this folder for what is made of a program, where nobody gave it a name."""
    is_named = program is not None and program != STANDARD_INPUT
    return Path(f"{Path(program).stem if program and is_named else 'contour'}{suffix}")


def examine(program: Program, start: str | None, assignments: Sequence[str], options: dict[str, Any]) -> Result:
    """The result of a program under the options of the command; what makes no sense ends the command."""
    return follow(program, start, assignments, options).collect()


def follow(program: Program, start: str | None, assignments: Sequence[str], options: dict[str, Any]) -> Run:
    """The same as a stream."""
    try:
        settings = settings_of(folder_of(program), assignments)
        return follow_program(program, start=start, settings=settings, **options)
    except SettingError as error:
        raise CouldNotRunError(str(error)) from None
    except UnknownControlError as error:
        raise CouldNotRunError(f"{program.name}: {error}; say which with --control {'|'.join(DIALECTS)}") from None
    except FactPlaceError as error:
        raise CouldNotRunError(f"{program.name}: {error}") from None


def settings_of(folder: Path, assignments: Sequence[str]) -> dict[str, str]:
    """The settings of the project file of a folder, and those of `--set` on top. Raises SettingError."""
    return find_settings(folder) | dict(map(read_setting, assignments))


def folder_of(program: Program) -> Path:
    """Where the search for a project file begins: beside the program, or here for what is no file."""
    return Path() if program.name.startswith("<") else Path(program.name).parent
