"""The commands that tell what there is: rules, facts, explain."""

import click

from contoursolve.cli.options import (
    CouldNotRunError,
)
from contoursolve.cli.printing import print_lines
from contoursolve.dialects import DIALECTS
from contoursolve.rules import Rule


@click.command(short_help="List the whole catalogue of rules.")
@click.option("--control", type=click.Choice(list(DIALECTS)), help="Only the rules of this control.")
@click.option(
    "--table",
    "is_table",
    is_flag=True,
    help="Instead: every set of words of every form, legal or not, determined or not.",
)
def rules(control: str | None, is_table: bool) -> None:
    """List the whole catalogue of rules and findings, with their evidence and the control's alarms."""
    from contoursolve.output.catalogue import catalogue_lines, table_lines  # noqa: PLC0415 - only here

    chosen = [dialect for name, dialect in DIALECTS.items() if control in (None, name)]
    print_lines(table_lines(chosen) if is_table else catalogue_lines(chosen))


@click.command(short_help="List the further facts that can be stated about a contour.")
def facts() -> None:
    """List the further facts that can be stated about a contour, with --fact or in a comment (contoursolve: ...)."""
    from contoursolve.output.vocabulary import vocabulary_lines  # noqa: PLC0415 - only here

    print_lines(vocabulary_lines())


@click.command(short_help="Explain one rule, or all behind an alarm number.")
@click.argument("code")
def explain(code: str) -> None:
    """Explain a rule by its CODE, or all rules behind an alarm number of the control.

    Prints the rule in words, wrong blocks, right blocks, and its place in the manual.

    \b
    contoursolve explain g111-line-1
    contoursolve explain 146
    """
    from contoursolve.output.catalogue import rule_lines  # noqa: PLC0415 - only here

    wanted = code.strip().lower()
    found: dict[str, tuple[Rule, list[str]]] = {}
    for name, dialect in DIALECTS.items():
        for rule in dialect.rules:
            if wanted in (rule.code, rule.alarm.number.split()[0] if rule.alarm else ""):
                found.setdefault(rule.code, (rule, []))[1].append(name)
    if not found:
        raise CouldNotRunError(f"no rule has the code or the alarm {code!r}; 'contoursolve rules' lists them")
    for rule, controls in found.values():
        click.echo("\n".join((*rule_lines(rule, controls), "")))
