"""Pictures as files: what their names ask for."""

from pathlib import Path

import click

from contoursolve.cli.options import CouldNotRunError
from contoursolve.files import CannotWriteError, check_target
from contoursolve.pictures import Picture, Theme

SVG, PNG = ".svg", ".png"

theme_option = click.option(
    "--theme",
    type=click.Choice([Theme.LIGHT.value, Theme.DARK.value, Theme.PAGE.value]),
    default=Theme.LIGHT.value,
    show_default=True,
    help="Colours of a picture; page follows the page or the reader of an SVG.",
)


def bytes_of(picture: Picture, target: Path) -> bytes:
    """A picture as its name asks for. Raises MissingExtraError."""
    return picture.png() if target.suffix.lower() == PNG else picture.svg.encode()


def check_picture(target: Path, *, is_forced: bool) -> None:
    """Raise CouldNotRunError if a picture cannot be written there."""
    if target.suffix.lower() not in (SVG, PNG):
        raise CouldNotRunError(f"{target}: pictures end in .svg or .png")
    try:
        check_target(target, None, is_forced=is_forced)
    except CannotWriteError as error:
        raise CouldNotRunError(str(error)) from None
