"""The option `--watch`: a command runs again whenever a program is saved."""

import gc
import os
import sys
import time
from collections.abc import Iterable
from contextlib import suppress
from functools import wraps
from itertools import chain
from pathlib import Path
from typing import Any

import click

from contoursolve.cli.options import Command, CouldNotRunError, files_named
from contoursolve.cli.printing import is_screen, say
from contoursolve.diagnosis import count
from contoursolve.diagnostics import UserError
from contoursolve.gcode import ENDINGS, SHARED_ENDINGS, STANDARD_INPUT
from contoursolve.program import project_files

BETWEEN = 0.5
"""Seconds between two looks at the files. Files of a network tell nobody that they have changed, so they are asked."""

Stamps = dict[str, tuple[int, int]]
"""When files were written last, and their sizes, by their names."""


def watchable(command: Command) -> Command:
    """The command with the option `--watch`; its own parameters follow."""

    @wraps(command)
    def run(*arguments: Any, is_watched: bool, **options: Any) -> None:
        if not is_watched:
            command(*arguments, **options)
            return
        programs = options["programs"] if "programs" in options else [options["program"] or ""]
        if not any(programs) or STANDARD_INPUT in programs:
            raise click.UsageError("--watch looks at files: name a PROGRAM")
        folders = options["folders"]
        while True:
            before = _stamps(programs, folders)
            try:
                command(*arguments, **options)
            except click.exceptions.Exit:  # its status is that of one run
                pass
            except (UserError, CouldNotRunError) as error:
                CouldNotRunError(str(error)).show()
            click.get_current_context().close()
            gc.collect()
            say(f"watching {count(len(before), 'file')}; Ctrl-C ends", err=True)
            changed = _wait(before, programs, folders)
            if is_screen(sys.stdout):
                click.clear()
            say(f"{changed} was changed", err=True)

    told = "Run again whenever a PROGRAM, a program beside it or contoursolve.toml is saved, until Ctrl-C."
    return click.option("--watch", "is_watched", is_flag=True, help=told)(run)


def _wait(before: Stamps, programs: Iterable[str], folders: Iterable[str]) -> str:
    """Wait until a file is changed, made or deleted, and nobody writes any more; returns its name."""
    now = before
    while True:
        time.sleep(BETWEEN)
        last, now = now, _stamps(programs, folders)
        changed = [name for name in sorted({*before, *now}) if before.get(name) != now.get(name)]
        if changed and now == last:
            return changed[0]


def _stamps(programs: Iterable[str], folders: Iterable[str]) -> Stamps:
    """Of the programs, of all that they may call (what lies beside them and in the folders), and of project files; not
    of a file where the output of this command goes."""
    files = {Path(name) for program in programs for name in files_named(program)}
    around = {*map(Path, folders), *(each.parent for each in files), *filter(Path.is_dir, map(Path, programs))}
    beside = (each for folder in around for each in folder.glob("*") if each.suffix.lower() in _CALLED)
    outputs = [os.fstat(stream.fileno()) for stream in (sys.stdout, sys.stderr)]
    found: Stamps = {}
    for file in chain(files, beside, *map(project_files, around)):
        with suppress(OSError):  # it is not there, or nobody may look at it
            status = file.stat()
            if file.is_file() and not any(os.path.samestat(status, each) for each in outputs):
                found[str(file)] = status.st_mtime_ns, status.st_size
    return found


_CALLED = (*ENDINGS, *SHARED_ENDINGS)
