"""The command `contoursolve`, and where its commands are."""

import io
import sys
from importlib import import_module
from itertools import pairwise

import click

from contoursolve import __version__
from contoursolve.diagnostics import UserError, names_like

COMMANDS = {
    "check": "check:check",
    "solve": "solve:solve",
    "expand": "expand:expand",
    "filter": "expand:filter_",
    "convert": "convert:convert",
    "write": "write:write",
    "diff": "diff:diff",
    "draw": "pictures:draw",
    "report": "pictures:report",
    "system": "solve:system",
    "family": "family:family",
    "ranges": "questions:ranges",
    "find": "questions:find",
    "sensitivity": "questions:sensitivity",
    "tolerances": "questions:tolerances",
    "verify": "verify:verify",
    "rules": "catalogue:rules",
    "explain": "catalogue:explain",
    "facts": "catalogue:facts",
}
"""Place of each command: a module of this room, and the name there. `contoursolve` itself adds the commands beside
it."""

ALIASES = (
    ("plot", "", ("draw",)),
    ("sweep", "", ("family",)),
    ("range", "", ("ranges",)),
    ("sensitivity", "--tolerance", ("tolerances",)),
    ("sensitivity", "--keep", ("tolerances",)),
    ("sensitivity", "--word", ("tolerances",)),
    ("fix", "", ("check", "--fix")),
    ("", "--bring", ("--goal",)),
    ("", "--let", ("--variable",)),
    ("", "--set", ("--setting",)),
)
"""Other spellings that work, and no help lists: a command with the option, if any, that makes it another one; or an
option of any command. Each with what is meant."""


def _spelled(args: list[str]) -> list[str]:
    """The arguments with the command and its options by their names in the help."""
    name, rest = args[0], [each.partition("=") for each in args[1:]]
    given = {option for option, _, _ in rest}
    own = {option: instead[0] for command, option, instead in ALIASES if not command}
    of_command = ([*each] for command, option, each in ALIASES if command == name and (not option or option in given))
    return [*next(of_command, [name]), *(own.get(option, option) + sign + value for option, sign, value in rest)]


class _Commands(click.Group):
    """The commands; each is imported when it is asked for, so that the others start sooner."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """All names, in order."""
        return [*COMMANDS, *super().list_commands(ctx)]

    def invoke(self, ctx: click.Context) -> object:
        """Run the command. An interrupt ends it with a status of its own: 1 means that an error was found."""
        try:
            return super().invoke(ctx)
        except click.ClickException as error:
            from contoursolve.output import harmless  # noqa: PLC0415 - only here

            vars(error)["message"] = harmless(error.message)
            if isinstance(error, click.NoSuchOption) and error.option_name == "--tool":
                told = "here the tool is a word: --word tool, or --vary tool=0.4:1.2:0.1"
                raise click.UsageError(f"No such option '--tool'; {told}", error.ctx) from None
            raise
        except UserError as error:
            from contoursolve.cli.options import CouldNotRunError  # noqa: PLC0415 - the same

            raise CouldNotRunError(str(error)) from None
        except KeyboardInterrupt:
            from contoursolve.cli.printing import say  # noqa: PLC0415 - the same
            from contoursolve.cli.progress import STOPPED, leave_threads  # noqa: PLC0415 - most runs end by themselves

            say("stopped", err=True)
            leave_threads(STOPPED)
            ctx.exit(STOPPED)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments. A shell cannot pass a NUL, and no file has it in its name."""
        if any("\0" in argument for argument in args):
            raise click.UsageError("arguments with a NUL character cannot be read", ctx)
        return super().parse_args(ctx, [*args[1:], "--help"] if args[:1] == ["help"] else args)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that is named, and the arguments behind it; of another name, the commands that it is close to."""
        args = _spelled(args)
        name, names = args[0], self.list_commands(ctx)
        if ctx.resilient_parsing:  # as a shell asks for what may follow
            return super().resolve_command(ctx, args)
        if name in names or name.startswith("-"):
            found = super().resolve_command(ctx, args)
            for option in found[1].params if found[1] is not None else ():
                _check_once(option, args, ctx)
            return found
        close = names_like(name, names)
        meant = f" Did you mean {' or '.join(map(repr, close))}?" if close else ""
        raise click.UsageError(f"No such command {name!r}.{meant}", ctx)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of this name."""
        module, _, name = COMMANDS.get(cmd_name, "").partition(":")
        if not module:
            return super().get_command(ctx, cmd_name)
        command: click.Command = getattr(import_module(f"contoursolve.cli.{module}"), name)
        return command


def _check_once(option: click.Parameter, args: list[str], ctx: click.Context) -> None:
    """Refuse two values of an option that has one."""
    if not isinstance(option, click.Option) or option.multiple or option.is_flag or option.count or option.nargs != 1:
        return
    pairs = [(arg.partition("="), after) for arg, after in pairwise([*args, ""])]
    values = dict.fromkeys(own if sign else after for (name, sign, own), after in pairs if name in option.opts)
    if len(values) > 1:
        told = f"{option.opts[0]} is given several times, as {' and '.join(values)}"
        raise click.UsageError(f"{told}; leave all but one out", ctx)


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, "-V", "--version", prog_name="contoursolve")
def main() -> None:
    """Solve CNC contour blocks, or say why they cannot be solved.

    Reads the contour blocks of Fanuc, Haas and Mitsubishi controls (,A ,C ,R), of HEIDENHAIN TNC (free contours FL FLT
    FC FCT) and CNC PILOT (DIN PLUS), of SINUMERIK (ANG RND CHR CT), of the ISG kernel (#ANG #RND), of the NCT 99M
    (chapter 16) and of the YASNAC LX3 (G111, G112, G11, G12), with any further facts.

    contoursolve reads words such as X40. as the control does, in a program and in options (--block, --start, --goal).
    On most lathes a number without a decimal point counts least increments, so X40 is 0.040 mm. Numbers alone
    (--vary, --within, --tolerance) and those in facts mean what they say, in mm or inches and degrees.

    contoursolve help COMMAND shows the options of a command.

    Exit status: 0 no error found, 1 at least one error found, 2 could not run, 130 stopped by Ctrl-C. It is the same if
    the output is not read to its end, as by head.
    """
    for stream in (sys.stdout, sys.stderr):
        # A console may lack a character that a program's comment has.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
