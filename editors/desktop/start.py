"""Starts contoursolve on a computer without Python: the whole command line, and the workbench for a double click.

Without arguments it is `contoursolve serve` of a folder of programs, with files alone `contoursolve serve FILE`: a
double click passes nothing, and a file that is dropped on the program is its argument. So it does not matter how it was
started, and a terminal gives the same as a double click. Nothing here or in the package starts a process of Python, so
that nothing asks for multiprocessing.freeze_support.
"""

import os
import sys
from pathlib import Path

from click import Context

from contoursolve.__main__ import commands, main


def arguments(given: list[str], here: Path, program: Path) -> list[str]:
    """The arguments of the command line: what is given, or the workbench where no command is given."""
    if not given:
        return ["serve", str(_folder(here, program))]
    # A block is an argument, too, and longer than a name may be; os.path says no then, and Path raises an error.
    files = [each for each in given if os.path.exists(each)]  # noqa: PTH110
    if not files or files[0] != given[0] or given[0] in commands().list_commands(Context(commands())):
        return given
    # Of several files the page lists the others, for they lie in one folder.
    return ["serve", given[0], *(each for each in given if each not in files)]


def _folder(here: Path, program: Path) -> Path:
    """Where the programs are: the folder in which it was started, or the documents, where a double click tells none."""
    is_told = here not in (program.parent, Path.home(), Path(here.anchor)) and "system32" not in str(here).lower()
    return here if is_told else documents()


def documents() -> Path:
    """The folder of the user's documents, as the system knows it; the home folder where there is none."""
    home = Path.home()
    found = home / "Documents"
    if sys.platform == "win32":
        import winreg  # noqa: PLC0415 - there only

        key = r"Software\Microsoft\Windows\CurrentVersion\Explorer\User Shell Folders"
        try:
            with winreg.OpenKey(winreg.HKEY_CURRENT_USER, key) as folders:
                found = Path(os.path.expandvars(winreg.QueryValueEx(folders, "Personal")[0]))
        except OSError:
            pass
    settings = Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config") / "user-dirs.dirs"
    if settings.is_file():
        for line in settings.read_text("utf-8", "replace").splitlines():
            if line.startswith("XDG_DOCUMENTS_DIR="):
                found = Path(line.partition("=")[2].strip('" ').replace("$HOME", str(home)))
    return found if found.is_dir() else home


def restore_library_path() -> None:
    """Give programs that are started from here, such as the browser, their own libraries: on Linux, PyInstaller's
    bootloader puts those of this program first, and keeps what was there under another name."""
    if getattr(sys, "frozen", False) and sys.platform not in ("win32", "darwin"):
        before = os.environ.pop("LD_LIBRARY_PATH_ORIG", None)
        os.environ.pop("LD_LIBRARY_PATH", None)
        if before is not None:
            os.environ["LD_LIBRARY_PATH"] = before


if __name__ == "__main__":
    restore_library_path()
    given = sys.argv[1:]
    sys.argv[1:] = arguments(given, Path.cwd(), Path(sys.executable))
    try:
        main()
    except SystemExit as end:
        # Windows closes the window of a double click, and with it what was told.
        if end.code and sys.argv[1:] != given and sys.platform == "win32" and sys.stdin and sys.stdin.isatty():
            input("Press Enter to close this window.")
        raise
