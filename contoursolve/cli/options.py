"""The options that commands share, and the exit statuses."""

from collections.abc import Callable

import click

from contoursolve.cli.control import control_option
from contoursolve.examine import Policy
from contoursolve.model import Length
from contoursolve.output.plain_text import harmless

FOUND_ERRORS, COULD_NOT_RUN = 1, 2


class CouldNotRunError(click.ClickException):
    """Bad usage or an unreadable program: one line on standard error and exit status 2."""

    exit_code = COULD_NOT_RUN

    def format_message(self) -> str:
        """The message, which may begin a line with the name of a file."""
        return harmless(super().format_message())


units_option = click.option(
    "--units",
    type=click.Choice([unit.value for unit in Length]),
    default="mm",
    show_default=True,
    help="Unit of the program's numbers before any G20 or G21.",
)


settings_option = click.option(
    "--set",
    "assignments",
    multiple=True,
    metavar="CONTROL.NAME=VALUE",
    help="Change a convention on which the manual is silent; may be repeated. 'contoursolve rules' lists them. "
    "The file contoursolve.toml holds them for a whole folder.",
)


rules_option = click.option(
    "--rules",
    type=click.Choice([policy.value for policy in Policy]),
    default="enforce",
    show_default=True,
    help="Rules of the control's manual: enforce refuses what they refuse, warn only says so, off lets the "
    "geometry alone decide. About a block with ? or facts, which no control reads, they only warn.",
)


def apart_options(command: Callable[..., None]) -> Callable[..., None]:
    """The options for what is stated apart from a program file."""
    for option in reversed(
        (
            click.option(
                "--block",
                "blocks",
                multiple=True,
                metavar="TEXT",
                help="A block to examine instead of a file; may be repeated, one block each.",
            ),
            click.option(
                "--start",
                metavar="WORDS",
                help='Start point for --block, such as "X40. Z0.", in words as the control reads them, in --units '
                'unless it says "G20 X2. Z0.".',
            ),
            click.option(
                "--fact",
                "facts",
                multiple=True,
                metavar="FACT",
                help='A fact besides the words, such as "length of line 1 = 30", for a program with one contour; may '
                "be repeated. 'contoursolve facts' lists every kind.",
            ),
        )
    ):
        command = option(command)
    return command


def common_options(command: Callable[..., None]) -> Callable[..., None]:
    """The options that `solve` and `check` share."""
    for option in reversed(
        (
            apart_options,
            control_option("The control. Without it, the control is found from the program where that is clear."),
            units_option,
            rules_option,
            settings_option,
        )
    ):
        command = option(command)
    return command
