"""The options that commands share, the control, programs from files and options, and the exit statuses."""

import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from glob import glob
from importlib import import_module
from math import isfinite, nan
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource
from click.shell_completion import CompletionItem

from contoursolve import gcode
from contoursolve.api import follow_program, read_program
from contoursolve.cli.printing import print_lines, style_of_output
from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import Policy
from contoursolve.diagnostics import ProgramError, UserError
from contoursolve.gcode import ENDINGS, STANDARD_INPUT, OpenFile, Program
from contoursolve.geometry import Length
from contoursolve.output import EXPLAINING, Collected, Totals, harmless, lines_of_findings, short_findings
from contoursolve.program import (
    Result,
    Run,
    UnknownControlError,
    check_start,
    find_settings,
    read_setting,
    stated_settings,
)
from contoursolve.reading import Control

_OWN = "MODULE:NAME"


class ControlType(click.ParamType):  # type: ignore[type-arg]  # generic in newer releases of click only
    """The name of a control, or `package.module:NAME` of a Control, which is then given itself."""

    name = "control"

    def __init__(self, names: Iterable[str]) -> None:
        self.names = click.Choice([*names])

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if isinstance(value, Control) or ":" not in value:
            return value if isinstance(value, Control) else self.names.convert(value, param, ctx)
        module, _, name = value.partition(":")
        try:
            control = _load(module, name)
        except (ImportError, TypeError) as error:
            self.fail(f"{value}: {error}", param, ctx)
        if ctx is not None:
            ctx.meta[control.name] = value
        return control

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        return self.names.shell_complete(ctx, param, incomplete)


def control_option(
    help_: str, name: str = "--control", names: Iterable[str] = tuple(CONTROLS)
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """An option for a control; its value is a name, a Control, or None."""
    choices = [*names]
    own = f"{help_} {_OWN} names a Control of your own in a Python module, also one in this folder."
    return click.option(name, type=ControlType(choices), metavar=f"[{'|'.join((*choices, _OWN))}]", help=own)


def _load(module: str, name: str) -> Control:
    """The tables of this name in a module that Python finds, also from here. Raises ImportError, TypeError."""
    here = str(Path.cwd())
    if here not in sys.path:
        sys.path.append(here)
    try:
        imported = import_module(module)
    except Exception as error:
        # Whatever the module does.
        told = f"{module or 'the module'} cannot be imported: {type(error).__name__}: {error}"
        raise ImportError(f"{told}{_where(module, error)}") from None
    found = getattr(imported, name, None)
    if not isinstance(found, Control):
        path = getattr(imported, "__file__", None)
        file = f" ({path})" if path else ""
        raise TypeError(f"{module}{file} has no contoursolve.Control of the name {name!r}")
    return found


def _where(module: str, error: Exception) -> str:
    """Advice about a module that is not there; empty for another error."""
    if not isinstance(error, ModuleNotFoundError) or error.name not in (module, module.partition(".")[0]):
        return ""
    if module.endswith(".py"):
        return f"; write the module without .py, {module.removesuffix('.py')}:NAME"
    return f"; a module is looked for among those of Python, then in this folder, {Path.cwd()}"


FOUND_ERRORS, COULD_NOT_RUN = 1, 2


def status_of(tally: Totals, found: int) -> int:
    """The exit status where so many findings count."""
    return COULD_NOT_RUN if tally.unexamined else FOUND_ERRORS if found else 0


class CouldNotRunError(click.ClickException):
    """Bad usage or an unreadable program: one line on standard error and exit status 2."""

    exit_code = COULD_NOT_RUN

    def format_message(self) -> str:
        """The message, which may begin a line with the name of a file."""
        return harmless(super().format_message())


FILE = click.Path(readable=False)
"""The type of arguments that name files, which shells complete; what a file lacks is said when it is read."""

format_option = click.option(
    "--format", "format_", type=click.Choice(["text", "json"]), default="text", show_default=True, help="What to print."
)


units_option = click.option(
    "--units",
    type=click.Choice([unit.value for unit in Length]),
    default="mm",
    show_default=True,
    help="Unit of the program's numbers where the program does not say it, as by G20, G21, MM or INCH.",
)


settings_option = click.option(
    "--setting",
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


def _read_folders(_context: click.Context, _option: click.Parameter, folders: tuple[str, ...]) -> tuple[str, ...]:
    """The folders of `--path`, which are there."""
    for folder in folders:
        try:
            with os.scandir(folder):
                pass
        except (OSError, ValueError) as error:
            told = getattr(error, "strerror", None) or error
            raise click.BadParameter(f"{folder} cannot be read as a folder: {told}") from None
    return folders


def _read_values(_context: click.Context, _option: click.Parameter, texts: tuple[str, ...]) -> dict[str, float]:
    """The values of `--variable`, by the names of the variables."""
    values = {}
    for text in texts:
        name, _, number = text.partition("=")
        try:
            values[name.strip().upper()] = float(number)
        except ValueError:
            values[name.strip().upper()] = nan
        if not isfinite(values[name.strip().upper()]) or not name.strip():
            raise click.BadParameter(f'{text}: write NAME=NUMBER, such as "#100=95."')
    return values


let_option = click.option(
    "--variable",
    "variables",
    multiple=True,
    metavar="NAME=NUMBER",
    callback=_read_values,
    help='The value of a variable, such as "#100=95.", whatever the program says of it; may be repeated.',
)

path_option = click.option(
    "--path",
    "folders",
    multiple=True,
    metavar="FOLDER",
    callback=_read_folders,
    help="Where subprograms are that are neither in the program nor beside it; may be repeated.",
)


Command = Callable[..., None]


def together(*options: Callable[[Command], Command]) -> Callable[[Command], Command]:
    """Several options as one decorator, in the order of the help."""

    def decorate(command: Command) -> Command:
        for option in reversed(options):
            command = option(command)
        return command

    return decorate


apart_options = together(
    let_option,
    path_option,
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
        help='Where the tool is at first, such as "X40. Z0.", in words as the control reads them, in --units '
        'unless it says "G20 X2. Z0.". Of a program, it also holds for a subprogram that nothing calls.',
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
"""The options for what is stated apart from a program file."""

named_options = together(
    click.option(
        "--trust",
        "trust",
        multiple=True,
        metavar="WORDS",
        help='Words that are right, such as "Z-50. A120.": no fix changes them, and a conflict names the others. In a '
        "program, write the comment (contoursolve trust: Z-50. A120.); may be repeated.",
    ),
    click.option(
        "--reference",
        "reference",
        multiple=True,
        metavar="WORDS",
        help='Coordinates of the contour\'s end, such as "Z-50.": not used, only compared. In a program, write the '
        "comment (contoursolve reference: Z-50.) beside the block that ends there; may be repeated.",
    ),
)
"""The options for words that are named, about which something is said."""

common_options = together(
    apart_options,
    control_option("The control. Without it, contoursolve finds it from the program where that is clear."),
    units_option,
    rules_option,
    settings_option,
)
"""The options that `solve` and `check` share."""


side_options = together(
    click.option(
        "--tip", type=int, metavar="NUMBER", help="The number of the imaginary tip of a turning tool, 0 to 9."
    ),
    click.option(
        "--side",
        type=click.Choice(["left", "right"]),
        help="The side of the contour on which the tool runs, for a program without G41 and G42 (RL and RR).",
    ),
    click.option(
        "--outside",
        type=click.Choice(["roll", "intersect"]),
        help="The way around an outside corner: an arc about it, or to where both offsets meet. Without it, as the "
        "program says (G450, G451; G25, G26), or the setting tool-outside.",
    ),
)
"""The options that state a tool but for its radius."""


tool_options = together(
    click.option(
        "--tool",
        "tool",
        metavar="RADIUS",
        help="The radius of the tool's nose or of the cutter, such as R0.8, in the program's unit; 'program' for what "
        "the program and contoursolve.toml say. The comment (contoursolve tool: R0.8, tip 3) states it, too.",
    ),
    side_options,
)
"""The options that state a tool."""


def explain_option(what: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """The option that asks for more than the short text."""
    return click.option("--explain", "is_explained", is_flag=True, help=f"Also print {what}.")


_SHARED = {
    "blocks": "--block",
    "start": "--start",
    "facts": "--fact",
    "trust": "--trust",
    "reference": "--reference",
    "variables": "--variable",
    "folders": "--path",
    "control": "--control",
    "units": "--units",
    "rules": "--rules",
    "assignments": "--setting",
}
"""Options that `check` has, too, by the names of their parameters."""


def explaining(program: str | None = None, **instead: object) -> str:
    """The command that explains all that is found in a program, with the options of the command that runs; `instead`
    are values in the place of its own."""
    context, words = click.get_current_context(), [EXPLAINING]
    for name, option in _SHARED.items():
        if name in instead or context.get_parameter_source(name) is ParameterSource.COMMANDLINE:
            values = instead.get(name, context.params[name])
            values = [f"{each}={number:g}" for each, number in values.items()] if isinstance(values, dict) else values
            for value in values if isinstance(values, tuple | list) else (values,):
                told = context.meta.get(value.name, value.name) if isinstance(value, Control) else str(value)
                words += [option, _quoted(told)]
    return " ".join([*words, *([_quoted(program)] if program and not program.startswith("<") else [])])


def _quoted(word: str) -> str:
    return word if re.fullmatch(r"[\w./:=-]+", word) else f'"{word}"'


def print_findings(result: Result, program: str | None = None, *, err: bool = False, **instead: object) -> None:
    """Print the findings in a program, for a command that has another purpose."""
    command = explaining(program, **instead)
    print_lines(lines_of_findings(result, short_findings(result), style_of_output(), explaining=command), err=err)


def load(paths: Sequence[str], blocks: tuple[str, ...]) -> list[Callable[[], Program]]:
    """Functions that give each program that is asked for; a file is read when its turn comes."""
    if blocks and paths:
        raise click.UsageError("give either a PROGRAM or --block, not both")
    if blocks:
        return [lambda: gcode.parse("\n".join(blocks), "<block>")]
    if not paths:
        raise click.UsageError("missing PROGRAM: name a file, or - for standard input, or use --block")
    return [partial(read_program, path) for path in paths]


def files_named(path: str) -> list[str]:
    """The files that a name means: those of a folder, and those that wildcards match where no shell has put them in
    their place, as on Windows. Empty for a folder without programs."""
    if path == STANDARD_INPUT:
        return [path]
    if Path(path).is_dir():
        return _programs_in(path)
    is_file = not _WILD.search(path) or Path(path).exists()
    found = [] if is_file else sorted(glob(path, recursive=True))  # noqa: PTH207 - Path.glob takes no whole paths
    return [each for name in found for each in ([name] if Path(name).is_file() else files_named(name))] or [path]


def _programs_in(folder: str) -> list[str]:
    """The programs of a folder and the folders in it, but for hidden ones, by their endings; a Fanuc's have none."""
    found = []
    for place, folders, names in os.walk(folder):
        folders[:] = [each for each in folders if not each.startswith(".")]
        visible = (Path(place, each) for each in names if not each.startswith("."))
        found += [str(each) for each in visible if each.suffix.lower() in ENDINGS or _NUMBERED.fullmatch(each.name)]
    return sorted(found)


_NUMBERED = re.compile(r"O\d{4,}", re.IGNORECASE | re.ASCII)


_WILD = re.compile(r"[*?\[]")


def is_sketch(name: str | None) -> bool:
    """Whether a name is that of a sketch's file."""
    return name is not None and name.lower().endswith((".toml", ".json"))


def named_after(program: str | None, suffix: str) -> Path:
    """The file in this folder for what is made of a program, where nobody gave it a name."""
    is_named = program is not None and program != STANDARD_INPUT
    return Path(f"{Path(program).stem if program and is_named else 'contour'}{suffix}")


def follow(program: Program, start: str | None, assignments: Sequence[str], options: dict[str, Any]) -> Run | Collected:
    """A program under the options of the command as a stream; where a tool is stated, with what is said of it. What
    makes no sense ends the command."""
    stated: dict[str, Any] = {name: options[name] for name in ("tool", "tip", "side", "outside") if name in options}
    options = {name: value for name, value in options.items() if name not in stated}
    with naming(program.name):
        run = follow_program(program, start=start, settings=settings_of(program, assignments), **options)
    check_start(run.asked)
    if stated and (stated["tool"] is not None or any(each in program.text for each in _NAMED)):
        from contoursolve import tool_radius  # noqa: PLC0415 - few programs state a tool

        with naming(program.name):
            wanted = tool_radius.wanted_tool(program.name, **stated)
            if stated["tool"] is not None or any(map(tool_radius.tool_of, run.frame.program.blocks)):
                report = tool_radius.look_at_tool(result := run.collect(), run.asked, wanted)
                return Collected(tool_radius.result_beside_tool(result, report), run.is_strict, tool=report)
    check_toolless(stated)
    return run


_NAMED = ("contoursolve", "CONTOURSOLVE", "Contoursolve")
"""The beginning of a comment that may state a tool."""


def check_toolless(stated: Mapping[str, Any], remedy: str = "--tool, such as --tool R0.8") -> None:
    """Refuse the options of a tool where none is stated."""
    for name in ("tip", "side"):
        if stated.get(name) is not None:
            raise click.UsageError(f"--{name} goes with {remedy}")


@contextmanager
def naming(program: str = "", options: str = "") -> Iterator[None]:
    """Errors about a program begin with its name; where its control is not known, they end with how to say it."""
    try:
        yield
    except ProgramError as error:
        told = str(error)
        if isinstance(error, UnknownControlError):
            told = error.text(f"; say which with {options or '--control ' + '|'.join(error.choices)}")
        raise UserError(f"{program and program + ': '}{told}") from None


def settings_of(program: Program | OpenFile, assignments: Sequence[str]) -> dict[str, str]:
    """The settings of the project file beside a program, or here for what is no file; those that the program states on
    top, and then those of `--setting`. Raises SettingError."""
    folder = Path() if program.name.startswith("<") else Path(program.name).parent
    lines = program.lines() if isinstance(program, OpenFile) else (block.text for block in program.blocks)
    return find_settings(folder) | stated_settings(lines) | dict(map(read_setting, assignments))
