"""Writes `docs/contoursolve.1`, the manual page, from the help of all commands: `python docs/site/man_page.py`."""

from collections.abc import Iterator
from inspect import cleandoc
from pathlib import Path

import click

from contoursolve import __version__
from contoursolve.__main__ import commands

PAGE = Path(__file__).parents[1] / "contoursolve.1"


def man_page() -> str:
    """The page as `man` reads it: what the command is for, then a section a command, with all options."""
    main = commands()
    above = click.Context(main, info_name="contoursolve", **main.context_settings)
    name, *_ = cleandoc(main.help or "").split("\n")
    lines = [
        f'.TH CONTOURSOLVE 1 "" "contoursolve {__version__}" "User Commands"',
        ".ad l",
        *(".SH NAME", rf"contoursolve \- {_text(name[0].lower() + name[1:].rstrip('.'))}"),
        *(".SH SYNOPSIS", _usage(main, above), ".SH DESCRIPTION"),
        *_help(main, above),
    ]
    for each in main.list_commands(above):
        command = main.get_command(above, each)
        assert command is not None
        inner = click.Context(command, above, each)
        lines += [f".SH {_text(each.upper())}", _usage(command, inner), *_help(command, inner)]
    return "\n".join(lines) + "\n"


def _usage(command: click.Command, context: click.Context) -> str:
    return rf"\fB{_text(context.command_path)}\fR {_text(' '.join(command.collect_usage_pieces(context)))}"


def _help(command: click.Command, context: click.Context) -> Iterator[str]:
    """The paragraphs of a help, and its options; lines behind a \\b stay as they are."""
    for paragraph in cleandoc(command.help or "").split("\n\n"):
        is_fixed = paragraph.startswith("\b")
        shown = (_text(line) for line in paragraph.removeprefix("\b\n").split("\n"))
        yield from (".PP", *([".nf"] if is_fixed else []), *shown, *([".fi"] if is_fixed else []))
    for option in command.get_params(context):
        record = option.get_help_record(context)
        if record is not None:
            yield from (".TP", rf"\fB{_text(record[0])}\fR", _text(record[1]))


def _text(text: str) -> str:
    """A line of text as the page has it: no command of troff, hyphens that can be copied, and choices
    that may go on in the next line."""
    plain = text.replace("\\", "\\e").replace("-", "\\-").replace("|", "|\\:")
    return rf"\&{plain}" if plain.startswith((".", "'")) else plain


if __name__ == "__main__":
    PAGE.write_text(man_page(), encoding="utf-8", newline="\n")
