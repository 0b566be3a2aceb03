"""The command `check`: the findings about programs, and their fixes."""

import sys
from pathlib import Path
from typing import Any

import click

from contoursolve import __version__
from contoursolve.cli.brief_help import LongCommand
from contoursolve.cli.fixing import MACHINE_READ, fix_options, fixed, read_fixing
from contoursolve.cli.options import (
    COULD_NOT_RUN,
    FILE,
    CouldNotRunError,
    common_options,
    explain_option,
    files_named,
    follow,
    is_sketch,
    load,
    named_options,
    status_of,
    tool_options,
)
from contoursolve.cli.printing import is_screen, print_lines, print_pieces, say, style_of_output
from contoursolve.diagnosis import count
from contoursolve.diagnostics import Severity, UserError
from contoursolve.gcode import ENDINGS, STANDARD_INPUT, Program, check_target, write_whole
from contoursolve.output import (
    MOST_ALIKE,
    Baseline,
    Collected,
    Findings,
    Shelf,
    Totals,
    read_baseline,
    stream_findings,
    table_lines,
)
from contoursolve.program import Result, Run, find_baseline
from contoursolve.reading import Control

_FAILING = {"error": (Severity.ERROR,), "warning": (Severity.ERROR, Severity.WARNING), "never": ()}
_NOTHING = "nothing"
"""The format that leaves standard output to something else."""


@click.command(cls=LongCommand, short_help="Report findings only, for any number of programs.")
@click.argument("programs", nargs=-1, metavar="PROGRAM...", type=FILE)
@common_options
@named_options
@tool_options
@click.option(
    "--format",
    "format_",
    type=click.Choice(["text", *MACHINE_READ]),
    default="text",
    show_default=True,
    help="What to print: text, one JSON document, SARIF 2.1.0, or GitHub's annotations.",
)
@click.option(
    "--fail-on",
    type=click.Choice([*_FAILING]),
    default="error",
    show_default=True,
    help="The least finding that makes the exit status 1.",
)
@fix_options
@click.option(
    "--write-baseline",
    "new_baseline",
    metavar="FILE",
    help="Write all findings into FILE, as JSON, and show none. An old baseline there is replaced.",
)
@click.option(
    "--baseline",
    "baseline",
    metavar="FILE",
    help="Hide the findings that --write-baseline has written into FILE. They are known by their code and the text of "
    "their block. Without it, contoursolve.toml may name one.",
)
@explain_option("every reason, every fix, and the equations of each contour")
@click.option("--strict", "is_strict", is_flag=True, help="Also report faults outside contours that change no contour.")
@click.option("--all", "shows_all", is_flag=True, help=f"Show more than {MOST_ALIKE} findings of a kind in a program.")
@click.pass_context
def check(
    context: click.Context,
    /,
    programs: tuple[str, ...],
    blocks: tuple[str, ...],
    start: str | None,
    format_: str,
    fail_on: str,
    new_baseline: str | None,
    baseline: str | None,
    is_explained: bool,
    is_strict: bool,
    shows_all: bool,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Report the findings about each PROGRAM (files, folders, or - for standard input), without the contours.

    Outside contours, check reports only faults that can change a contour: in its start point, plane, unit or mode, or
    in the value of a word. --strict also reports those that change none. Each finding shows at most two reasons and two
    fixes; --explain shows all. Several programs end with a table, the worst first.

    A name may have wildcards: * ? [ ], and ** for any folders. A folder stands for its programs, and for those in its
    folders; hidden ones are left out. Programs end in .nc, .mpf, .h and the like, or are called O1234.

    --fix writes the fixes that keep the contour into the programs, and reports what is left. --diff only shows them.
    For standard input and --block, the fixed program goes to standard output, the findings to standard error.

    A sketch (a .toml file) is checked, too: contradictions and missing data, in the lines of its file.

    Exit status: 0 no error, 1 an error is found (see --fail-on), 2 a program could not be examined. With --fix it is
    that of the programs afterwards, with --diff as they are. What a baseline hides does not count.

    \b
    contoursolve check shaft.nc flange.nc
    contoursolve check *.nc parts
    contoursolve check --diff shaft.nc
    contoursolve check --fix shaft.nc
    contoursolve check --control yasnac-lx3 - < shaft.nc
    """
    named = [files_named(program) for program in programs]
    for program, files in zip(programs, named, strict=True):
        if not files:
            say(f"{program}: no program is in this folder; programs end in {', '.join(ENDINGS)}", err=True)
    if named and not any(named):
        context.exit(COULD_NOT_RUN)
    names = [name for files in named for name in files]
    loaders, fixing, hiding = load(names, blocks), read_fixing(options), _Hiding(new_baseline, baseline)
    options |= {"strict": is_strict or bool(blocks), "depth": "findings"}
    if any(map(is_sketch, names)):
        from contoursolve.cli.sketched import refuse_options  # noqa: PLC0415 - most runs have programs

        refuse_options(context, is_fixing=fixing is not None)
    if fixing:
        fixing.check_usage(format_, has_input=not names or STANDARD_INPUT in names)
    is_silent = new_baseline is not None or (fixing is not None and fixing.is_diff)
    is_err = fixing is not None and fixing.prints_program(names)
    told = _NOTHING if is_silent and format_ == "text" else format_
    telling = _Telling(context.with_resource(Shelf()), told, is_alone=len(names) <= 1, is_err=is_err)
    telling.most, telling.is_explained = None if shows_all else MOST_ALIKE, is_explained
    # A bar among the lines of a terminal, or before a question, would be torn.
    is_torn = (format_ == "text" and sys.stdout.isatty()) or (fixing is not None and fixing.asks)
    is_shown = not telling.is_alone and is_screen(sys.stderr) and not is_torn

    def examine(program: Program) -> Run | Collected:
        if is_sketch(program.name):
            from contoursolve.cli.sketched import examined_sketch  # noqa: PLC0415 - most runs have programs

            return examined_sketch(program)
        return follow(program, start, assignments, options)

    with click.progressbar(loaders, label="checking", file=sys.stderr, hidden=not is_shown) as loaded:
        for name, loader in zip(names or [""], loaded, strict=True):
            try:
                run = fixed(fixing, name, blocks, examine, hiding.hidden_in) if fixing else examine(loader())
                telling.take(name, hiding.hide(run))
            except UserError as error:
                CouldNotRunError(str(error)).show()
                telling.rows.append((name, None))
    hiding.write(is_whole=not telling.has_failed)
    if telling.has_failed and telling.is_alone:
        context.exit(COULD_NOT_RUN)
    control = options["control"]
    telling.close(fixing.summary if fixing else "", control if isinstance(control, Control) else None)
    hiding.tell_gone()
    found = sum(telling.tally.severities[each] for each in _FAILING[fail_on])
    context.exit(COULD_NOT_RUN if telling.has_failed else status_of(telling.tally, found))


class _Hiding:
    """The baselines of one command: the one to write, or those that hide findings."""

    def __init__(self, new: str | None, given: str | None) -> None:
        if new is not None and given is not None:
            raise click.UsageError("--write-baseline writes all findings; give it without --baseline")
        self._new = Baseline(Path(new)) if new is not None else None
        self._given = read_baseline(Path(given)) if given is not None else None
        self._named: dict[Path, Baseline] = {}
        if self._new is not None:
            check_target(self._new.file, None, is_forced=True)
            if self._new.file.exists():
                # A program that was named by mistake stays.
                read_baseline(self._new.file)

    def hide(self, run: Run | Collected) -> Run | Collected:
        """The part of a program's findings that is to be told."""
        known = self._new or self._known_of(run.frame)
        if known is None:
            return run
        whole = run if isinstance(run, Collected) else Collected(run.collect(), run.is_strict)
        if known is self._new:
            known.add(whole.frame)
        return known.hide(whole)

    def hidden_in(self, result: Result) -> set[int]:
        """The identities of the findings of a program that are hidden; what is new is not."""
        known = None if self._new else self._known_of(result)
        return known.hidden_in(result) if known else set()

    def _known_of(self, result: Result) -> Baseline | None:
        """The baseline that is given, or that a project file names."""
        if self._given is not None:
            return self._given
        name = result.program.name
        file = find_baseline(Path() if name.startswith("<") else Path(name).parent)
        if file is not None and file not in self._named:
            self._named[file] = read_baseline(file)
        return self._named[file] if file is not None else None

    def write(self, *, is_whole: bool) -> None:
        """Write the new baseline, if one is asked for and has the findings of all programs."""
        if self._new is not None and not is_whole:
            say(f"{self._new.file} was not written: a program could not be examined", err=True)
        elif self._new is not None:
            write_whole(self._new.file, [self._new.text().encode()], keeps_backup=False)
            number = sum(known.total() for known in self._new.known.values())
            say(f"{self._new.file} written: {count(number, 'finding')}", err=True)

    def tell_gone(self) -> None:
        """Say which baselines know findings that are gone."""
        for known in filter(None, (self._given, *self._named.values())):
            if known.gone:
                told = f"{count(known.gone, 'finding')} in it {'are' if known.gone > 1 else 'is'} gone"
                say(f"{known.file}: {told}; --write-baseline {known.file} writes it anew", err=True)


class _Telling:
    """The report about the programs of one command, in one format."""

    most: int | None = None
    is_explained = False

    def __init__(self, shelf: Shelf, format_: str, *, is_alone: bool, is_err: bool) -> None:
        self.format, self.is_alone, self.is_err = format_, is_alone, is_err
        self.tally, self.rows = Totals(), list[tuple[str, Totals | None]]()
        self._document, self._results = Findings(shelf), list[Result]()
        self._is_strict = False

    @property
    def has_failed(self) -> bool:
        """Whether a program could not be examined."""
        return any(each is None for _, each in self.rows)

    def take(self, name: str, run: Run | Collected) -> None:
        """Tell of one program, or keep what is told at the end."""
        own, hidden = Totals(), run.hidden if isinstance(run, Collected) else None
        self._is_strict = run.is_strict
        if self.format == "text":
            options = {"is_explained": self.is_explained, "is_alone": self.is_alone}
            lines = stream_findings(run, own, style_of_output(), most=self.most, **options)
            print_lines(lines, err=self.is_err)
        elif self.format == "json":
            self._document.add(run, own)
        elif self.format == _NOTHING:
            for item in run:
                own.count(item, is_explained=False)
        else:
            self._results.append(run.collect())
            for finding in self._results[-1].diagnostics:
                own.count(finding)
        if isinstance(run, Collected):
            own.statuses.update(run.moves())
        if hidden:
            own.hidden[name] += hidden
        self.rows.append((name, own))
        self.tally.add(own)

    def close(self, fixes: str, own: Control | None) -> None:
        """Tell what is told at the end, with the number of fixes; `own` is a control that is not built in."""
        failed = sum(each is None for _, each in self.rows)
        total = self.tally.line(len(self.rows) - failed) + fixes
        if failed:
            whose = "its error says" if failed == 1 else "their errors say"
            total += f"; {count(failed, 'program')} not examined: {whose} what to do"
        match self.format:
            case "json":
                print_pieces(self._document.pieces(), err=self.is_err)
            case "sarif":
                from contoursolve.output import to_sarif  # noqa: PLC0415 - only here

                click.echo(to_sarif(self._results, __version__, own), err=self.is_err)
            case "github":
                from contoursolve.output import to_github  # noqa: PLC0415 - only here

                click.echo(to_github(self._results), err=self.is_err)
            case "text" if not self.is_alone:
                print_lines(table_lines(self.rows), err=self.is_err)
                say(total, err=self.is_err)
            case "text" if self._is_strict or self.is_explained or self.tally.has_something or fixes:
                say(total, err=self.is_err)
            case _ if self.format == _NOTHING:
                say(total, err=True)
