"""Writes `docs/contoursolve.1`, the manual page, from the help of all commands: `python docs/site/man_page.py`."""

from collections.abc import Sequence
from pathlib import Path

import click

from contoursolve import __version__
from contoursolve.__main__ import commands
from contoursolve.cli.brief_help import show_all

PAGE = Path(__file__).parents[1] / "contoursolve.1"


class Troff(click.HelpFormatter):
    """Help as `man` reads it."""

    def write_usage(self, prog: str, args: str = "", prefix: str | None = None) -> None:  # noqa: ARG002 - click's
        self.write(f"\\fB{_plain(prog)}\\fR {_plain(args)}\n")

    def write_text(self, text: str) -> None:
        for paragraph in text.split("\n\n"):
            is_fixed, lines = paragraph.startswith("\b"), paragraph.removeprefix("\b\n").split("\n")
            shown = (_plain(line.strip()) for line in lines)
            self.write("\n".join((".PP", *([".nf"] if is_fixed else []), *shown, *([".fi"] if is_fixed else []), "")))

    def write_heading(self, heading: str) -> None:
        self.write(f".SS {_plain(heading)}\n")

    def write_dl(self, rows: Sequence[tuple[str, str]], col_max: int = 0, col_spacing: int = 0) -> None:  # noqa: ARG002
        self.write("".join(f".TP\n\\fB{_plain(name)}\\fR\n{_plain(told)}\n" for name, told in rows))


def man_page() -> str:
    """The page: what the command is for, then a section a command, with all options."""
    main, page = commands(), Troff()
    above = click.Context(main, info_name="contoursolve", **main.context_settings)
    page.write(f'.TH CONTOURSOLVE 1 "" "contoursolve {__version__}" "User Commands"\n.ad l\n.SH NAME\n')
    page.write(f"contoursolve \\- {_plain((main.help or '').strip().partition('.')[0])}\n.SH SYNOPSIS\n")
    main.format_help(above, page)
    for each in main.list_commands(above):
        if (command := main.get_command(above, each)) is not None:
            page.write(f".SH {_plain(each.upper())}\n")
            own = click.Context(command, above, each)
            show_all(own)
            command.format_help(own, page)
    return "\n".join(line for line in page.getvalue().split("\n") if line) + "\n"


def _plain(text: str) -> str:
    """Text without commands of troff; hyphens can be copied, and choices go on in the next line."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("|", "|\\:")
    return rf"\&{text}" if text.startswith((".", "'")) else text


if __name__ == "__main__":
    PAGE.write_text(man_page(), encoding="utf-8", newline="\n")
