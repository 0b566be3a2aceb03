"""The command `contoursolve serve`; it stands beside the command line, which knows nothing of the server."""

import gc
import os
from pathlib import Path

import click

from contoursolve.diagnostics import importing

PASSWORD = "CONTOURSOLVE_PASSWORD"
"""The variable of the environment that sets a password."""

_SHORTEST = 8


@click.command(short_help="Open the workbench: programs on a page of your own.")
@click.argument("path", metavar="[FILE|FOLDER]", required=False, type=click.Path(path_type=Path))
@click.option(
    "--port", type=click.IntRange(0, 65_535), default=0, metavar="N", help="The port; without it, a free one."
)
@click.option("--no-browser", is_flag=True, help="Print the address alone, and open no browser.")
@click.option("--lan", "is_in_network", is_flag=True, help="Serve other computers of your network, too.")
@click.option("--ask-password", is_flag=True, help="With --lan: ask for a password with which they may write.")
def serve(path: Path | None, port: int, no_browser: bool, is_in_network: bool, ask_password: bool) -> None:
    """Open the workbench: a page on this computer for the programs of FOLDER, or for FILE.

    The page shows findings at each word, mends, draws, converts and saves. A file is written only when you say so.
    Without FILE or FOLDER, the folder is the present one. Ctrl-C ends the workbench.

    Only this computer reaches the page, at an address with a token. With --lan, every computer of your network does, if
    it knows the address. It reads all programs of the folder, and writes none, unless it knows a password: that of
    --ask-password, or of the variable CONTOURSOLVE_PASSWORD. The connection is not encrypted. Needs the extra
    contoursolve[app].

    \b
    contoursolve serve
    contoursolve serve shaft.nc --port 8100 --no-browser
    """
    import threading  # noqa: PLC0415 - the other commands start without it
    import webbrowser  # noqa: PLC0415 - as above

    with importing("app", "the workbench"):
        from contoursolve.workbench import server  # noqa: PLC0415 - needs an extra
    from contoursolve.workbench.desk import Desk  # noqa: PLC0415 - as above

    path = path or Path()
    if not path.exists():
        raise click.UsageError(f"{path}: no such file or folder")
    if ask_password and not is_in_network:
        raise click.UsageError("--ask-password goes with --lan: on this computer alone, the page may write")
    password = ""
    if is_in_network:
        password = os.environ.get(PASSWORD, "")
        if ask_password:
            password = click.prompt("Password for writing", hide_input=True, confirmation_prompt=True, err=True)
        if password and len(password) < _SHORTEST:
            raise click.UsageError(f"the password has {len(password)} characters; take at least {_SHORTEST}")
    folder, first = (path, "") if path.is_dir() else (path.parent, path.name)
    access = server.Access(is_in_network, password)
    own = server.bind(port, is_in_network=is_in_network)
    host = server.address_in_network() if is_in_network else "127.0.0.1"
    address = f"http://{host}:{own.getsockname()[1]}/?token={access.token}"
    if is_in_network:
        _warn(folder, has_password=bool(password))
    click.echo(f"The workbench of {_shown(folder)}:")
    click.echo(f"{address}\nCtrl-C ends it.")
    if not no_browser:
        # A browser in the terminal would not return.
        threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
    gc.enable()  # a command collects no cycles, but this one goes on for days
    server.run(Desk(folder, first=first, can_unlock=bool(password)), access, own)


def _warn(folder: Path, *, has_password: bool) -> None:
    """Say what it means to serve a network."""
    writing = (
        "Who also knows the password may write them."
        if has_password
        else "Nobody may write, for no password is set (--ask-password)."
    )
    click.echo(
        f"--lan: every computer in your network reaches this page while it runs.\n"
        f"Who knows the address reads every program in {_shown(folder)}. {writing}\n"
        "The connection is not encrypted: who listens in the network sees programs and the password.",
        err=True,
    )


def _shown(folder: Path) -> str:
    """The whole name of a folder, as a terminal may show it."""
    from contoursolve.output import harmless  # noqa: PLC0415 - as above

    return harmless(str(folder.resolve()))
