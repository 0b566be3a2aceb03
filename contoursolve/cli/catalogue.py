"""The commands that tell what there is: rules, facts, explain."""

import click

from contoursolve.cli.options import CouldNotRunError, control_option, format_option
from contoursolve.cli.printing import print_json, print_lines, say
from contoursolve.controls import CONTROLS
from contoursolve.diagnostics import did_you_mean
from contoursolve.reading import Control


@click.command(short_help="List the whole catalogue of rules.")
@control_option("Only the rules of this control.")
@click.option(
    "--table",
    "is_table",
    is_flag=True,
    help="Instead: every set of words of every form, with what the manual and the equations say of it.",
)
@format_option
def rules(control: str | Control | None, is_table: bool, format_: str) -> None:
    """List the whole catalogue of rules and findings, with their evidence and the control's alarms.

    --format json also has the advice and the examples of each rule, and every setting.
    """
    from contoursolve.output import catalogue_data, catalogue_lines, word_set_lines  # noqa: PLC0415 - only here

    chosen = _chosen(control)
    if format_ == "json":
        if is_table:
            raise click.UsageError("--table is text: leave out --table or --format json")
        print_json(catalogue_data(chosen))
        return
    print_lines(word_set_lines(chosen) if is_table else catalogue_lines(chosen))


def _chosen(control: str | Control | None) -> list[Control]:
    """The control that is asked for, or all that are built in."""
    if isinstance(control, Control):
        return [control]
    return [each for name, each in CONTROLS.items() if control in (None, name)]


@click.command(short_help="List the further facts that can be stated about a contour.")
def facts() -> None:
    """List the further facts that can be stated about a contour, with --fact or in a comment (contoursolve: ...)."""
    from contoursolve.output import vocabulary_lines  # noqa: PLC0415 - only here

    print_lines(vocabulary_lines())


@click.command(short_help="Explain one rule, or all behind an alarm number.")
@click.argument("code")
@control_option("Only a rule of this control.")
def explain(code: str, control: str | Control | None) -> None:
    """Explain a rule by its CODE, or all rules behind an alarm number of the control.

    Prints the rule in words, wrong blocks, right blocks, and its place in the manual.

    \b
    contoursolve explain g111-line-1
    contoursolve explain 146
    """
    from contoursolve.output import alarm_rows, rule_view  # noqa: PLC0415 - only here
    from contoursolve.tool_radius import ToolFaultKind  # noqa: PLC0415 - the same

    wanted, chosen = code.strip().lower(), _chosen(control)
    found = {kind.code: (kind.rule, ["every control, with --tool"]) for kind in ToolFaultKind if kind.code == wanted}
    named = [(rule, each.name) for each in chosen for rule in each.rules if rule.code == wanted]
    behind = [(row.rule, row.control) for row in alarm_rows(chosen) if row.is_called(wanted)]
    if not named:  # some controls have a row of their own about the same
        about = {rule.about for each in CONTROLS.values() for rule in each.rules if rule.code == wanted} - {None}
        named = [(rule, each.name) for each in chosen for rule in each.rules if rule.about in about]
    met = [(rule, name) for rule, name in named if not rule.absent]
    for rule, name in (met or named) + behind:
        found.setdefault(rule.code, (rule, []))[1].append(name)
    if not found:
        hint = did_you_mean(wanted, sorted({rule.code for each in chosen for rule in each.rules}))
        raise CouldNotRunError(f"no rule has the code or the alarm {code!r}; {hint}'contoursolve rules' lists them")
    for rule, controls in found.values():
        say("\n".join((*rule_view(rule, controls).lines(), "")))
