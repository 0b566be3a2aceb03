"""What the commands about one block and its words share."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

from contoursolve.api import solve
from contoursolve.cli.control import control_option
from contoursolve.cli.loading import settings_of
from contoursolve.cli.options import CouldNotRunError, rules_option, settings_option, units_option
from contoursolve.cli.printing import say, style_of_output
from contoursolve.data import json_text
from contoursolve.dialects import DIALECTS
from contoursolve.extras import MissingExtraError
from contoursolve.families import FamilyError, RefusedError
from contoursolve.files import CannotWriteError
from contoursolve.output.listing import lines_of_findings
from contoursolve.pipeline import FactPlaceError
from contoursolve.project import SettingError
from contoursolve.reading import Trouble
from contoursolve.recognise import UnknownControlError


def block_options(command: Callable[..., None]) -> Callable[..., None]:
    """The options that say which block is meant, and how it is read."""
    for option in reversed(
        (
            click.option(
                "--block", "blocks", multiple=True, required=True, metavar="TEXT", help="The block; may be repeated."
            ),
            click.option(
                "--start",
                metavar="WORDS",
                help='The start point, such as "X40. Z0.", in words as the control reads them.',
            ),
            control_option("The control; found from the block without it."),
            units_option,
            rules_option,
            settings_option,
        )
    ):
        command = option(command)
    return command


format_option = click.option(
    "--format", "format_", type=click.Choice(["text", "json"]), default="text", show_default=True, help="What to print."
)

fact_option = click.option(
    "--fact", "facts", multiple=True, metavar="FACT", help="A further fact, as for solve; may be repeated."
)


def read_options(options: dict[str, Any]) -> dict[str, Any]:
    """The arguments of a function about a block, from the options of a command, after a warning on standard error if
    its start point may be meant otherwise."""
    rest = {name: options[name] for name in ("start", "control", "units", "rules")}
    rest["settings"] = settings_of(Path(), options["assignments"])
    block = "\n".join(options["blocks"])
    for finding in solve(block, **rest, depth="verdict").diagnostics:
        if finding.about is Trouble.START_IN_INCREMENTS:
            say(f"{finding.severity.value}: {finding.message}; {finding.help}", err=True)
    return {"block": block, **rest}


@contextmanager
def usage() -> Iterator[None]:
    """Errors of what was asked for as one line and exit status 2; before it, the findings about a block that is refused
    whatever the values."""
    try:
        yield
    except RefusedError as error:
        result = error.result
        for line in lines_of_findings(result, result.diagnostics, style_of_output()):
            say(line, err=True)
        raise CouldNotRunError("the block is refused, whatever the values that vary; nothing was computed") from None
    except (FamilyError, SettingError, FactPlaceError, MissingExtraError, CannotWriteError) as error:
        raise CouldNotRunError(str(error)) from None
    except UnknownControlError as error:
        raise CouldNotRunError(f"{error}; say which with --control {'|'.join(DIALECTS)}") from None


def read_within(text: str) -> tuple[float, float]:
    """The range of `--within LOW:HIGH`."""
    low, _, high = text.partition(":")
    try:
        return float(low), float(high)
    except ValueError:
        raise click.UsageError(f"--within {text}: write LOW:HIGH, such as 0.1:50") from None


def print_json(document: dict[str, Any]) -> None:
    """One JSON document."""
    click.echo(json_text(document))
