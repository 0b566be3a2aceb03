"""The command `contoursolve lsp`; it stands beside the command line, which knows nothing of the server."""

import click

from contoursolve.diagnostics import importing


@click.command()
def lsp() -> None:
    """Serve an editor: findings, fixes, hovers and completions while a program is typed.

    An editor starts this command and talks to it over standard input and output, in the Language Server Protocol. There
    is nothing to see in a terminal. docs/editors.md has the lines that each editor needs. Needs the extra
    contoursolve[lsp].

    \b
    contoursolve lsp
    """
    with importing("lsp", "the language server"):
        from contoursolve.lsp.server import server  # noqa: PLC0415 - needs an extra
    server.start_io()
