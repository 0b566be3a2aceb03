"""Commands of many options: `--help` shows the main ones, `--help-all` every one."""

from typing import Any

import click

_MAIN = {
    "check": "block start control tool fix diff explain format",
    "solve": "block start fact control derivation full explain format",
    "expand": "output in_place control tool inline formulas post keep_going",
    "write": "to all output force layer part zero sketch",
    "diff": "tolerance control new_control tool side plot theme format",
    "draw": "output line each whole block start control tool",
    "report": "output force explain block start control tool side",
    "family": "block start vary control output plot result format",
    "ranges": "block start word within control fact format rules",
    "find": "block start word goal within control fact format",
    "tolerances": "block start point tolerance keep word control format",
}
"""The options that `--help` shows, by the names of the commands: eight each."""


class LongCommand(click.Command):
    """A command whose help is short unless `--help-all` asks for all of it."""

    def get_params(self, ctx: click.Context) -> list[click.Parameter]:
        """Its options, with the one for the whole help before that for the short help."""
        *params, short = super().get_params(ctx)
        return [*params, _HELP_ALL, short]

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the main options, or all."""
        main, is_all = _MAIN[self.name or ""].split(), ctx.meta.get(_SHOWS_ALL, False)
        options = [each for each in self.get_params(ctx) if isinstance(each, click.Option)]
        shown = [each for each in options if is_all or each.opts[-1].strip("-").replace("-", "_") in main]
        records = [each.get_help_record(ctx) for each in (*shown, *(() if is_all else options[-2:]))]
        with formatter.section("Options" if is_all else f"Main options ({len(main)} of {len(options) - 2})"):
            formatter.write_dl([record for record in records if record])


_SHOWS_ALL = "contoursolve.cli.all_options"


def show_all(ctx: click.Context) -> None:
    """Have the help of this context list every option."""
    ctx.meta[_SHOWS_ALL] = True


def _print_all(ctx: click.Context, _option: click.Parameter, value: Any) -> None:
    if value and not ctx.resilient_parsing:
        show_all(ctx)
        click.echo(ctx.get_help(), color=ctx.color)
        ctx.exit()


_HELP_ALL = click.Option(
    ["--help-all"],
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_print_all,
    help="Show all options and exit.",
)
