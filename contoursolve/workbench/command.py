"""The command `contoursolve serve`; it stands beside the command line, which knows nothing of the server."""

import gc
from pathlib import Path
from secrets import token_urlsafe

import click


@click.command(short_help="Open the workbench: programs on a page of your own.")
@click.argument("path", metavar="[FILE|FOLDER]", required=False, type=click.Path(path_type=Path))
@click.option(
    "--port", type=click.IntRange(0, 65_535), default=0, metavar="N", help="The port; without it, a free one."
)
@click.option("--no-browser", is_flag=True, help="Print the address alone, and open no browser.")
def serve(path: Path | None, port: int, no_browser: bool) -> None:
    """Open the workbench: a page on this computer for the programs of FOLDER, or for FILE.

    The page shows findings at each word, mends, draws, converts and saves. A file is written only when you say so.
    Without FILE or FOLDER, the folder is the present one. Ctrl-C ends the workbench.

    Only this computer reaches the page, at an address with a token.

    \b
    contoursolve serve
    contoursolve serve shaft.nc --port 8100 --no-browser
    """
    import threading  # noqa: PLC0415 - the other commands start without it
    import webbrowser  # noqa: PLC0415 - as above

    from contoursolve.workbench import server  # noqa: PLC0415 - as above
    from contoursolve.workbench.desk import Desk  # noqa: PLC0415 - as above

    path = path or Path()
    if not path.exists():
        raise click.UsageError(f"{path}: no such file or folder")
    folder, first = (path, "") if path.is_dir() else (path.parent, path.name)
    token, own = token_urlsafe(24), server.bind(port)
    address = f"http://{server.HOST}:{own.getsockname()[1]}/?token={token}"
    click.echo(f"The workbench of {_shown(folder)}:")
    click.echo(f"{address}\nCtrl-C ends it.")
    if not no_browser:
        # A browser in the terminal would not return.
        threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
    gc.enable()  # a command collects no cycles, but this one goes on for days
    server.run(Desk(folder, first=first), token, own)


def _shown(folder: Path) -> str:
    """The whole name of a folder, as a terminal may show it."""
    from contoursolve.output import harmless  # noqa: PLC0415 - as above

    return harmless(str(folder.resolve()))
