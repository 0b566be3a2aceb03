"""The command `contoursolve lsp`."""

import click

from contoursolve.cli.options import CouldNotRunError
from contoursolve.diagnostics.extras import MissingExtraError, importing


@click.command()
def lsp() -> None:
    """Serve an editor: findings, fixes, hovers and completions while a program is typed.

    An editor starts this command and talks to it over standard input and output, in the Language Server Protocol. There
    is nothing to see in a terminal. docs/editors.md has the lines that each editor needs. Needs the extra
    contoursolve[lsp].

    \b
    contoursolve lsp
    """
    try:
        with importing("lsp", "the language server"):
            from contoursolve.lsp.server import server  # noqa: PLC0415 - needs an extra
    except MissingExtraError as error:
        raise CouldNotRunError(str(error)) from None
    server.start_io()
