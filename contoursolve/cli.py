"""The command line: arguments in, text or JSON out, exit status 0 (no error found), 1 (errors found), 2.

What only some commands need, they import themselves, so that the others start sooner.
"""

import io
import os
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from importlib import import_module
from itertools import islice
from pathlib import Path
from typing import Any

import click

from contoursolve import __version__, syntax
from contoursolve.api import UnreadableProgramError, only_findings, read_program, solve_program
from contoursolve.diagnostic import Diagnostic, Severity
from contoursolve.dialects import DIALECTS, PLAIN, Dialect
from contoursolve.examine import Answer, Policy
from contoursolve.model import Length
from contoursolve.output.contours import contour_lines
from contoursolve.output.document import findings_to_json, to_json
from contoursolve.output.findings import Style, finding_lines, plain
from contoursolve.output.layout import count
from contoursolve.pipeline import FactPlaceError, Result, UnknownControlError, recognise, run
from contoursolve.project import SettingError, configure, find_settings, read_setting
from contoursolve.rules import Rule
from contoursolve.solving import Status
from contoursolve.syntax import Program

FOUND_ERRORS, COULD_NOT_RUN = 1, 2


_COLORS: dict[str, dict[str, Any]] = {
    "error": {"fg": "red", "bold": True},
    "warning": {"fg": "yellow", "bold": True},
    "info": {"fg": "cyan", "bold": True},
    "frame": {"fg": "blue", "bold": True},
    "bold": {"bold": True},
}


class CouldNotRunError(click.ClickException):
    """Bad usage or an unreadable program: one line on standard error and exit status 2."""

    exit_code = COULD_NOT_RUN


units_option = click.option(
    "--units",
    type=click.Choice([unit.value for unit in Length]),
    default="mm",
    show_default=True,
    help="Unit of the program's numbers before any G20 or G21.",
)


settings_option = click.option(
    "--set",
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


def _apart(command: Callable[..., None]) -> Callable[..., None]:
    """The options for what is stated apart from a program file."""
    for option in reversed(
        (
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
                help='Start point for --block, such as "X40. Z0.", in --units unless it says "G20 X2. Z0.".',
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
    ):
        command = option(command)
    return command


def common_options(command: Callable[..., None]) -> Callable[..., None]:
    """The options that `solve` and `check` share."""
    for option in reversed(
        (
            _apart,
            click.option(
                "--control",
                type=click.Choice(list(DIALECTS)),
                help="The control. Without it, the control is found from the program where that is clear.",
            ),
            units_option,
            rules_option,
            settings_option,
        )
    ):
        command = option(command)
    return command


_ELSEWHERE = {"expand": "contoursolve.cli_expand:expand", "filter": "contoursolve.cli_expand:filter_"}


class _Commands(click.Group):
    """The commands; those of other modules are imported when they are asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """All names, in order."""
        return sorted([*super().list_commands(ctx), *_ELSEWHERE])

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of this name."""
        if cmd_name not in _ELSEWHERE:
            return super().get_command(ctx, cmd_name)
        module, _, name = _ELSEWHERE[cmd_name].partition(":")
        command: click.Command = getattr(import_module(module), name)
        return command


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="contoursolve")
def main() -> None:
    """Solve CNC contour blocks, or say why they cannot be solved.

    Reads the contour blocks of the YASNAC LX3 (G111, G112, G11, G12) and of the NCT 99M (chapter 16), with any
    further facts.

    Exit status: 0 no error found, 1 at least one error found, 2 could not run.
    """
    for stream in (sys.stdout, sys.stderr):
        # A console may lack a character that a program's comment has.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


@main.command(short_help="Solve every contour block of a program.")
@click.argument("program", required=False)
@common_options
@click.option(
    "--format",
    "format_",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="What to print; json is in mm, with X as radius.",
)
@click.option("--explain", "is_explained", is_flag=True, help="Also print the construction, step by step.")
@click.pass_context
def solve(
    context: click.Context,
    /,
    program: str | None,
    blocks: tuple[str, ...],
    start: str | None,
    format_: str,
    is_explained: bool,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Solve every contour block of PROGRAM (a file, or - for standard input).

    Prints what was given, the virtual intersections, and every element of the path, with what is proven of it; where
    several contours satisfy a block, all of them. A word with ? for its value, such as P?, is worked out from the
    other words and from facts.

    \b
    contoursolve solve shaft.nc
    contoursolve solve --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0."
    contoursolve solve --start "X40. Z0." --fact "length of line 1 = 30" --block "G111 X100. A180. B120. K?"
    """
    result = _examine(_load([program] if program else [], blocks, start)[0](), start, assignments, options)
    if format_ == "json":
        click.echo(to_json(result))
    else:
        _print(_solved(result, style_of_output(), is_explained))
        _print_summary([result])
    context.exit(FOUND_ERRORS if result.has_errors else 0)


@main.command(short_help="Report findings only, for any number of programs.")
@click.argument("programs", nargs=-1, metavar="PROGRAM...")
@common_options
@click.option(
    "--format",
    "format_",
    type=click.Choice(["text", "json", "sarif", "github"]),
    default="text",
    show_default=True,
    help="What to print: text, one JSON document, SARIF 2.1.0, or GitHub's annotations.",
)
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning", "never"]),
    default="error",
    show_default=True,
    help="The least finding that makes the exit status 1.",
)
@click.pass_context
def check(
    context: click.Context,
    /,
    programs: tuple[str, ...],
    blocks: tuple[str, ...],
    start: str | None,
    format_: str,
    fail_on: str,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Report the findings about each PROGRAM (files, or - for standard input), without the contours.

    \b
    contoursolve check shaft.nc flange.nc
    contoursolve check --control yasnac-lx3 - < shaft.nc
    """
    is_shown = len(programs) > 1 and sys.stderr.isatty()
    results, failures = [], []
    with click.progressbar(
        _load(programs, blocks, start), label="checking", file=sys.stderr, hidden=not is_shown
    ) as loaded:
        for load in loaded:
            try:
                results.append(only_findings(_examine(load(), start, assignments, options)))
            except CouldNotRunError as error:
                failures.append(error)
    for failure in failures:
        failure.show()
    if failures and not results:
        context.exit(COULD_NOT_RUN)
    match format_:
        case "json":
            click.echo(findings_to_json(results))
        case "sarif":
            from contoursolve.output.exchange import to_sarif  # noqa: PLC0415 - only here

            click.echo(to_sarif(results, __version__))
        case "github":
            from contoursolve.output.exchange import to_github  # noqa: PLC0415 - only here

            _print([to_github(results)])
        case _:
            for result in results:
                _print(_findings(result, result.diagnostics, style_of_output()))
            _print_summary(results)
    failing = {"error": (Severity.ERROR,), "warning": (Severity.ERROR, Severity.WARNING), "never": ()}[fail_on]
    found = {finding.severity for result in results for finding in result.diagnostics}
    context.exit(COULD_NOT_RUN if failures else FOUND_ERRORS if found & set(failing) else 0)


@main.command(short_help="List the whole catalogue of rules.")
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
    _print(table_lines(chosen) if is_table else catalogue_lines(chosen))


@main.command(short_help="List the further facts that can be stated about a contour.")
def facts() -> None:
    """List the further facts that can be stated about a contour, with --fact or in a comment (contoursolve: ...)."""
    from contoursolve.output.vocabulary import vocabulary_lines  # noqa: PLC0415 - only here

    _print(vocabulary_lines())


@main.command(short_help="Explain one rule, or all behind an alarm number.")
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


@main.command(short_help="Check a claimed answer, independently.")
@click.argument("inputs", nargs=-1, metavar="PROGRAM RESULT.json")
@_apart
@click.option(
    "--control",
    type=click.Choice(list(DIALECTS)),
    help="The control. Without it, the one that the result names.",
)
@units_option
@click.option(
    "--format",
    "format_",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="What to print: text, or a receipt with every check, its residual and its limit.",
)
@click.pass_context
def verify(
    context: click.Context,
    /,
    inputs: tuple[str, ...],
    blocks: tuple[str, ...],
    start: str | None,
    format_: str,
    **options: Any,
) -> None:
    """Check every element of RESULT.json against the words of PROGRAM (one of them may be -).

    RESULT.json is what solve printed with --format json. Each point, radius and direction, each value that was asked
    for and each listed solution is held against the words and further facts with formulas of its own, none of the
    solver's; so are the status and the number of solutions where there are words alone. What was not checked is named,
    too. The program is read with the settings that RESULT.json names. Give --block, --start and --fact as they were
    given to solve.

    Exit status: 0 nothing claimed is wrong, 1 something is, 2 could not run.

    \b
    contoursolve solve shaft.nc --format json > shaft.json
    contoursolve verify shaft.nc shaft.json
    contoursolve verify --block "G111 X100. A180. K-30. B120." --start "X40. Z0." block.json
    """
    from contoursolve import verification  # noqa: PLC0415 - only here

    if inputs.count("-") > 1:
        raise click.UsageError("only one of PROGRAM and RESULT.json can be standard input")
    if start is not None and not blocks:
        raise click.UsageError("--start goes with --block; a PROGRAM states its own positions")
    if blocks and len(inputs) != 1:
        raise click.UsageError("with --block, name RESULT.json and no PROGRAM")
    if not blocks and len(inputs) != 2:  # noqa: PLR2004 - the two that the usage names
        raise click.UsageError("name PROGRAM and RESULT.json, or --block and RESULT.json")
    try:
        program = verification.document_of_blocks(blocks) if blocks else verification.read_document(inputs[0])
        receipt = verification.verify(program, verification.read_document(inputs[-1]), start=start, **options)
    except verification.CannotVerifyError as error:
        raise CouldNotRunError(str(error)) from None
    if format_ == "json":
        click.echo(verification.to_json(receipt))
    else:
        _print(verification.report_lines(receipt))
    context.exit(FOUND_ERRORS if receipt.verdict is verification.Verdict.FAILED else 0)


@main.command(short_help="Draw the contours for CAD (DXF).")
@click.argument("program", required=False)
@click.option(
    "-o", "--output", required=True, metavar="OUT.dxf", type=click.Path(path_type=Path), help="The drawing to write."
)
@click.option("--force", "is_forced", is_flag=True, help="Replace the drawing if it exists.")
@common_options
@click.pass_context
def plot(
    context: click.Context,
    /,
    program: str | None,
    output: Path,
    is_forced: bool,
    blocks: tuple[str, ...],
    start: str | None,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Draw every solved contour of PROGRAM (a file, or - for standard input) into a DXF file.

    Lines and arcs in full precision, each element on a layer of its own; virtual and computed intersections on the
    layer construction. The drawing's X and Y are the plane's axes: on a lathe Z to the right and X up, as radius. It
    is in mm, or in inches if all contours are. Needs the extra contoursolve[dxf].

    \b
    contoursolve plot shaft.nc -o shaft.dxf
    contoursolve plot --block "G111 X100. A180. K-30. B120. P5." --start "X40. Z0." -o block.dxf --force
    """
    if output.suffix.lower() != ".dxf":
        raise CouldNotRunError(f"{output}: drawings end in .dxf; SVG and PNG are not made yet")
    load = _load([program] if program else [], blocks, start)[0]
    try:
        from contoursolve.output.drawing_dxf import to_dxf  # noqa: PLC0415 - needs an extra
    except ModuleNotFoundError as error:
        if error.name != "ezdxf":
            raise
        raise CouldNotRunError("a DXF drawing needs ezdxf; install it with: pip install 'contoursolve[dxf]'") from None
    from contoursolve.output.target import TargetError, check_target, write_whole  # noqa: PLC0415 - only here

    try:
        check_target(output, (program,) if program else (), is_forced=is_forced)
        result = _examine(load(), start, assignments, options)
        _print(_findings(result, result.diagnostics, style_of_output()))
        contours = [answer.contour for answer in result.answers if answer.contour]
        if contours:
            write_whole(output, to_dxf(result.answers))
    except TargetError as error:
        raise CouldNotRunError(str(error)) from None
    elements = count(sum(len(contour.elements) for contour in contours), "element")
    written = f"{output}: {elements} of {count(len(contours), 'contour')}" if contours else f"{output}: not written"
    _print_summary([result])
    click.echo(written)
    context.exit(FOUND_ERRORS if result.has_errors or not contours else 0)


_ANY_CONTROL = click.Choice([*DIALECTS, *PLAIN])


@main.command(short_help="Tell whether two programs describe the same path.")
@click.argument("old", metavar="OLD")
@click.argument("new", metavar="NEW")
@click.option(
    "--tolerance",
    type=click.FloatRange(min=0, min_open=True, max=1),
    default=0.001,
    show_default=True,
    metavar="MM",
    help="How far apart the paths may be, in mm.",
)
@click.option(
    "--control", type=_ANY_CONTROL, help="The control of OLD. Without it, found from OLD where that is clear."
)
@click.option(
    "--new-control", type=_ANY_CONTROL, help="The control of NEW. Without it, found from NEW, or that of OLD."
)
@units_option
@click.option(
    "--new-units", type=click.Choice([unit.value for unit in Length]), help="The same for NEW. Without it, as for OLD."
)
@rules_option
@settings_option
@click.option(
    "--format", "format_", type=click.Choice(["text", "json"]), default="text", show_default=True, help="What to print."
)
@click.pass_context
def diff(
    context: click.Context,
    /,
    old: str,
    new: str,
    tolerance: float,
    control: str | None,
    new_control: str | None,
    units: str,
    new_units: str | None,
    rules: str,
    assignments: tuple[str, ...],
    format_: str,
) -> None:
    """Tell whether OLD and NEW describe the same path, and if not, where they differ first.

    Contours are solved, and all moves by G0 to G3 followed, in either program as its own control reads them. A line or
    an arc may be divided differently. What is not followed, such as cycles and subprograms, must be the same word by
    word, and is listed. Feeds, leads, speeds, tools, offsets, dwells and M functions are not compared.

    Exit status: 0 the same path, 1 not the same or not solved, 2 could not run.

    \b
    contoursolve diff shaft.nc shaft_by_hand.nc
    contoursolve diff shaft.nc shaft.ngc --new-control linuxcnc --tolerance 0.002
    """
    from contoursolve.comparison import compare, follow  # noqa: PLC0415 - only here
    from contoursolve.output import differences  # noqa: PLC0415 - only here

    if old == new == "-":
        raise click.UsageError("only one of OLD and NEW can be standard input")
    sides: list[tuple[Result, Dialect, Length]] = []
    for path, own, unit in ((old, control, units), (new, new_control, new_units or units)):
        program = _read(path)
        dialect = _dialect_of(program, own, sides[0][1] if sides else None, assignments)
        result = only_findings(run(program, dialect, Length(unit), Policy(rules)))
        sides.append((result, dialect, Length(unit)))
    results = [result for result, _, _ in sides]
    if any(result.has_errors for result in results):
        if format_ == "json":
            click.echo(differences.refusal_to_json(results))
        else:
            for result in results:
                _print(_findings(result, result.diagnostics, style_of_output()))
            click.echo("not compared: a program that has errors has no path")
        context.exit(FOUND_ERRORS)
    axes = tuple(sorted({axis for _, dialect, _ in sides for axis in dialect.modes.axes}))
    one, other = (follow(result, dialect, unit, axes) for result, dialect, unit in sides)
    comparison = compare(one, other, tolerance)
    if format_ == "json":
        click.echo(differences.to_json(comparison))
    else:
        _print(differences.comparison_lines(comparison))
    context.exit(0 if comparison.is_equal else FOUND_ERRORS)


def _dialect_of(program: Program, name: str | None, otherwise: Dialect | None, assignments: Sequence[str]) -> Dialect:
    """The control of a program: the one that is named, or that it shows, or another."""
    try:
        settings = find_settings(_folder(program)) | dict(map(read_setting, assignments))
        dialect = {**DIALECTS, **PLAIN}[name] if name else recognise(program) or otherwise
        if dialect is not None:
            return configure(settings).get(dialect.name, dialect)
    except SettingError as error:
        raise CouldNotRunError(str(error)) from None
    except UnknownControlError as error:
        raise CouldNotRunError(f"{program.name}: {error}; say which with --control or --new-control") from None
    choices = "|".join([*DIALECTS, *PLAIN])
    raise CouldNotRunError(f"{program.name}: no block shows the control; say which with --control {choices}")


def _load(paths: Sequence[str], blocks: tuple[str, ...], start: str | None) -> list[Callable[[], Program]]:
    """How to get each program that is asked for; a file is read when its turn comes."""
    if blocks and paths:
        raise click.UsageError("give either a PROGRAM or --block, not both")
    if start is not None and not blocks:
        raise click.UsageError("--start goes with --block; a PROGRAM states its own positions")
    if blocks:
        return [lambda: syntax.parse("\n".join(blocks), "<block>")]
    if not paths:
        raise click.UsageError("missing PROGRAM: name a file, or - for standard input, or use --block")
    return [partial(_read, path) for path in paths]


def _read(path: str) -> Program:
    try:
        return read_program(path)
    except UnreadableProgramError as error:
        raise CouldNotRunError(str(error)) from None


def _examine(program: Program, start: str | None, assignments: Sequence[str], options: dict[str, Any]) -> Result:
    try:
        settings = find_settings(_folder(program)) | dict(map(read_setting, assignments))
        return solve_program(program, start=start, settings=settings, **options)
    except SettingError as error:
        raise CouldNotRunError(str(error)) from None
    except UnknownControlError as error:
        raise CouldNotRunError(f"{program.name}: {error}; say which with --control {'|'.join(DIALECTS)}") from None
    except FactPlaceError as error:
        raise CouldNotRunError(f"{program.name}: {error}") from None


def _folder(program: Program) -> Path:
    """Where the search for a project file begins: beside the program, or here for what is no file."""
    return Path() if program.name.startswith("<") else Path(program.name).parent


def style_of_output() -> Style:
    """Colours, unless NO_COLOR asks for none; click leaves them out where there is no terminal."""
    if os.environ.get("NO_COLOR"):
        return plain
    return lambda text, role: click.style(text, **_COLORS[role]) if text else text


def _print(lines: Iterable[str]) -> None:
    """Print lines in batches: a call of click for each would take longer than solving."""
    for batch in _batched(lines, 1_000):
        click.echo("\n".join(batch))


def _batched(lines: Iterable[str], size: int) -> Iterator[list[str]]:
    """Lists of up to `size` lines (itertools.batched is in Python 3.12)."""
    iterator = iter(lines)
    while batch := list(islice(iterator, size)):
        yield batch


def _findings(result: Result, findings: Iterable[Diagnostic], style: Style) -> Iterator[str]:
    """The lines of findings, each with the program's lines that it marks."""
    blocks = result.program.blocks
    first = blocks[0].line if blocks else 1
    for finding in findings:
        numbers = {label.span.line for label in finding.labels}
        sources = {number: blocks[number - first].text for number in numbers if 0 <= number - first < len(blocks)}
        if result.start:
            sources[0] = result.start.text
        sources |= {fact.span.line: fact.text for fact in result.facts}
        yield from finding_lines(finding, result.program.name, sources, style)


def _solved(result: Result, style: Style, is_explained: bool) -> Iterator[str]:
    """Contours in order, each followed by its findings, between the findings about other blocks."""
    own = {id(finding) for answer in result.answers for finding in answer.diagnostics}
    items: list[Diagnostic | Answer] = [finding for finding in result.diagnostics if id(finding) not in own]
    items += result.answers
    for item in sorted(items, key=lambda each: each.lines[0] if isinstance(each, Answer) else each.span.line):
        if isinstance(item, Answer):
            yield from contour_lines(item, result, is_explained=is_explained)
            yield from _findings(result, item.diagnostics, style)
        else:
            yield from _findings(result, [item], style)


def _print_summary(results: Sequence[Result]) -> None:
    """What was examined and what was found; nothing examined is not the same as nothing found."""
    answers = [answer for result in results for answer in result.answers]
    findings = [finding for result in results for finding in result.diagnostics]
    statuses = Counter(answer.status for answer in answers)
    solved = ", ".join(f"{statuses[status]} {status.value}" for status in reversed(Status) if statuses[status])
    severities = Counter(finding.severity for finding in findings)
    found = ", ".join(count(severities[each], each.value) for each in Severity if severities[each])
    examined = f"{count(len(answers), 'contour')} ({solved})" if answers else "no contour examined"
    programs = f"{count(len(results), 'program')}, " if len(results) > 1 else ""
    click.echo(f"{programs}{examined}; {found or 'nothing found'}")
