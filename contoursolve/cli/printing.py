"""Lines on the terminal, in its colours."""

import gc
import os
import sys
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import Any, TextIO

import click

from contoursolve.diagnostics import json_text
from contoursolve.output import Style, harmless, plain

_COLORS: dict[str, dict[str, Any]] = {
    "error": {"fg": "red", "bold": True},
    "warning": {"fg": "yellow", "bold": True},
    "info": {"fg": "cyan", "bold": True},
    "frame": {"fg": "blue", "bold": True},
    "bold": {"bold": True},
    "place": {},
}


def is_screen(stream: TextIO) -> bool:
    """True of a terminal that moves its cursor; one named `dumb` by TERM has neither that nor colours."""
    return stream.isatty() and os.environ.get("TERM") != "dumb"


def style_of_output() -> Style:
    """Colours, unless NO_COLOR or TERM asks for none; click leaves them out where there is no terminal."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return plain
    return lambda text, role: click.style(text, **_COLORS[role]) if text else text


def say(text: str, *, err: bool = False) -> None:
    """Print a text, on standard output or standard error."""
    click.echo(harmless(text), err=err)


def print_lines(lines: Iterable[str], *, err: bool = False) -> None:
    """Print lines in batches: a call of click for each would take longer than solving."""
    for batch in _batched(lines, 1_000):
        say("\n".join(batch), err=err)


def print_pieces(pieces: Iterable[str], *, err: bool = False) -> None:
    """Print the pieces of a document, in batches."""
    for batch in _batched(pieces, 1_000):
        click.echo("".join(batch), nl=False, err=err)
        # The encoder of the standard library leaves cycles behind for each text, and a command collects none by itself.
        gc.collect(0)
    click.echo(err=err)


def print_bytes(pieces: Iterable[bytes]) -> None:
    """A program on standard output, byte for byte."""
    stream = sys.stdout.buffer
    for piece in pieces:
        stream.write(piece)
    stream.flush()


def print_json(document: dict[str, Any]) -> None:
    """One JSON document."""
    click.echo(json_text(document))


def _batched(lines: Iterable[str], size: int) -> Iterator[list[str]]:
    """Lists of up to `size` lines (itertools.batched is in Python 3.12)."""
    iterator = iter(lines)
    while batch := list(islice(iterator, size)):
        yield batch
