"""The commands that write programs: expand, and the filter of LinuxCNC."""

import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any

import click
from msgspec.structs import replace

from contoursolve.api import MOST_DECIMALS, follow_options
from contoursolve.cli.brief_help import LongCommand
from contoursolve.cli.options import (
    FILE,
    FOUND_ERRORS,
    check_toolless,
    common_options,
    control_option,
    explaining,
    naming,
    rules_option,
    settings_of,
    settings_option,
    together,
    tool_options,
    units_option,
)
from contoursolve.cli.printing import is_screen, print_bytes, say, style_of_output
from contoursolve.diagnosis import Policy, count
from contoursolve.gcode import (
    OpenFile,
    check_target,
    check_unprotected,
    open_program_file,
    program_file_of,
    write_whole,
)
from contoursolve.output import Style, finding_lines, plain, without_repeated
from contoursolve.postprocess import (
    POSTS,
    Arcs,
    ExpansionOptions,
    Numbering,
    Post,
    Rewritten,
    Risk,
    Summary,
    Writer,
    rewrite,
)
from contoursolve.program import SolveOptions

_BY_HAND = "write by hand what is meant there"

STANDARD = "-"
"""Standard input, or standard output."""


wording_options = together(
    click.option(
        "--arcs",
        type=click.Choice([arcs.value for arcs in Arcs]),
        default="center",
        show_default=True,
        help="The centre of an arc by I J K from where it begins, or by R.",
    ),
    click.option(
        "--decimals",
        type=click.IntRange(1, MOST_DECIMALS),
        metavar="COUNT",
        help="Decimals of an end point; without it, those of the target. I J K and R have at least as many.",
    ),
    click.option(
        "--block-numbers",
        type=click.Choice([numbering.value for numbering in Numbering]),
        default="first",
        show_default=True,
        help="Which lines have a number in the place of a block that has one. first: the first line, or the "
        "last one where G70 to G73 end a profile there. all: every line, with numbers that are still free. "
        "All other lines keep theirs.",
    ),
    click.option("--no-comments", is_flag=True, help="Do not keep the original blocks as comments."),
)
"""The options about what stands in the place of a block."""


@click.command(cls=LongCommand, short_help="Write a program's contours as plain G-code.")
@click.argument("program", metavar="OLD", required=False, type=FILE)
@common_options
@click.option("-o", "--output", metavar="NEW", help="Where to write; without it, or with -, to standard output.")
@click.option("--in-place", "is_in_place", is_flag=True, help="Write to OLD itself, and keep it as OLD.bak.")
@click.option("--force", "is_forced", is_flag=True, help="Replace NEW if it exists.")
@click.option(
    "--post",
    type=click.Choice(["same", "linuxcnc", "fanuc", "haas", "sinumerik", "klartext"]),
    default="same",
    show_default=True,
    help="For which control: the one that OLD is for, LinuxCNC, or Fanuc; with --formulas, also the others.",
)
@wording_options
@tool_options
@click.option(
    "--inline",
    "is_inline",
    is_flag=True,
    help="Write one program without calls, jumps, loops and variables: each call and each pass as it runs.",
)
@click.option(
    "--formulas",
    "has_formulas",
    is_flag=True,
    help="Write contours whose words hold variables as formulas of these, in the target's macro language. The values "
    "of the variables in OLD, or of --variable, are an example, at which the formulas are checked.",
)
@click.option(
    "--scratch",
    metavar="RANGE",
    help='The variables in which formulas compute, such as "#140-#160".',
)
@click.option(
    "--keep-going",
    "keeps_going",
    is_flag=True,
    help="Write the others where one contour fails; it stays, below a comment that says why.",
)
@click.option(
    "--keep-untranslated",
    "keeps_untranslated",
    is_flag=True,
    help="Warn and write what the target would run along another path, such as G90 of a lathe.",
)
@click.pass_context
def expand(
    context: click.Context,
    /,
    program: str | None,
    blocks: tuple[str, ...],
    start: str | None,
    output: str | None,
    is_in_place: bool,
    is_forced: bool,
    post: str,
    keeps_going: bool,
    keeps_untranslated: bool,
    **options: Any,
) -> None:
    """Write OLD (a file, or - for standard input) with every contour as plain G00, G01, G02 and G03.

    Everything else stays as it is, byte for byte. Each original block stays as a comment above what replaces it.
    Rounding moves the end points first, then the centre of each arc; the largest deviation is printed. expand
    rewrites only contours. It names every word of the rest that the target does not know. It writes nothing where a
    contour fails, or where the target would run another path: a turning cycle as a rapid, for example.

    Of a Klartext program, free contours and corners become L, CC and C. For another target, such as --post linuxcnc,
    expand writes the other blocks in G codes, too.

    Calls stay. A contour of a subprogram is written once, and must be the same in every call. With --inline, it may
    differ: expand writes out each call. It writes nothing where a jump cannot be decided.

    Exit status: 0 every contour is expanded, 1 one is left or nothing is written, 2 could not run.

    \b
    contoursolve expand shaft.nc -o shaft_plain.nc
    contoursolve expand cover.nc --post linuxcnc --arcs radius > cover.ngc
    contoursolve expand --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0."
    """
    if bool(blocks) == bool(program):
        raise click.UsageError("name a program (- for standard input), or give --block")
    if options["tool"] is None:
        check_toolless(options)
    elif options["has_formulas"]:
        raise click.UsageError("--tool goes without --formulas")
    target = program_itself(program, output) if is_in_place else target_of(program, output, is_forced=is_forced)
    wish = _wish(_post_of(post, options), options)
    source = (
        program_file_of("".join(f"{block}\n" for block in blocks), "<block>")
        if blocks
        else open_program_file(program or "-")
    )
    with TemporaryFile() as body:
        with _progress_bar() as progress:
            rewritten = _rewrite(source, body, wish, start, options, progress)
        summary = rewritten.summary
        report_left(summary, program or "<block>", style_of_output())
        report_misread(summary, wish.post, style_of_output(), is_kept=keeps_untranslated)
        if summary.has_end or (summary.left and not keeps_going):
            say("nothing was written" + " (--keep-going expands the others)" * (not summary.has_end), err=True)
            context.exit(FOUND_ERRORS)
        if summary.misread and not keeps_untranslated:
            report_told(summary, wish.post)
            say(f"nothing was written: {_BY_HAND} (--keep-untranslated writes it as it is)", err=True)
            context.exit(FOUND_ERRORS)
        if target is None:
            print_bytes(rewritten.pieces())
        elif summary.replaced or summary.restated or not is_in_place:
            backup = write_whole(target, rewritten.pieces(), keeps_backup=is_in_place)
            say(f"{target} written" + (f"; the old one is {backup}" if backup else ""), err=True)
    _report_expansion(summary, wish.post, style_of_output())
    context.exit(FOUND_ERRORS if summary.left else 0)


@click.command("filter", short_help="Expand a program as a filter of LinuxCNC.")
@click.argument("program", metavar="FILE", type=FILE)
@control_option("The control; found from the program without it.")
@units_option
@rules_option
@settings_option
@wording_options
@click.pass_context
def filter_(context: click.Context, /, program: str, **options: Any) -> None:
    """Write FILE for LinuxCNC to standard output, as LinuxCNC asks a filter to.

    Progress goes to standard error as FILTER_PROGRESS=n. filter writes nothing where a contour fails, or where LinuxCNC
    would run something along another path. The findings then go to standard error, and the exit status is 1 (2: could
    not run). In LinuxCNC's INI file:

    \b
    [FILTER]
    PROGRAM_EXTENSION = .nc Programs of other controls
    nc = contoursolve filter
    """

    def progress(share: float) -> None:
        say(f"FILTER_PROGRESS={int(share * 100)}", err=True)

    with TemporaryFile() as body:
        wish = _wish(POSTS["linuxcnc"], options)
        rewritten = _rewrite(open_program_file(program), body, wish, None, options, progress)
        report_left(rewritten.summary, program, plain)
        report_misread(rewritten.summary, wish.post, plain, is_kept=False)
        if rewritten.summary.left or rewritten.summary.misread:
            say("nothing was written" + f": {_BY_HAND}" * bool(rewritten.summary.misread), err=True)
            context.exit(FOUND_ERRORS)
        progress(1.0)
        print_bytes(rewritten.pieces())
    _report_expansion(rewritten.summary, POSTS["linuxcnc"], plain)


def program_itself(program: str | None, output: str | None) -> Path:
    """The file that is replaced by what is written."""
    if output is not None or program in (None, STANDARD):
        raise click.UsageError("--in-place takes a file OLD, and no NEW")
    file = Path(str(program))
    check_unprotected(file)
    return file


def target_of(program: str | None, output: str | None, *, is_forced: bool) -> Path | None:
    """The file to write to, if any. What may not be written to is told before anything is done."""
    source = None if program in (None, STANDARD) else Path(str(program))
    if output in (None, STANDARD):
        return None
    target = Path(str(output))
    check_target(target, source, is_forced=is_forced)
    return target


def _post_of(post: str, options: Mapping[str, Any]) -> Post:
    """The target of this name."""
    if not options["has_formulas"]:
        if options["scratch"]:
            raise click.UsageError("--scratch goes with --formulas")
        if post not in POSTS:
            raise click.UsageError(f"--post {post} goes with --formulas; convert writes the words of other controls")
        return POSTS[post]
    if options["arcs"] != Arcs.CENTER.value or options["is_inline"]:
        raise click.UsageError("--formulas goes without --arcs radius and --inline")
    from contoursolve.postprocess import post_of_formulas  # noqa: PLC0415 - few programs need it

    return post_of_formulas(post)


def _wish(post: Post, options: Mapping[str, Any]) -> ExpansionOptions:
    """The options of an expansion, from those of the command."""
    arcs, numbering = Arcs(options["arcs"]), Numbering(options["block_numbers"])
    has_comments, is_inline = not options["no_comments"], options.get("is_inline", False)
    return ExpansionOptions(post, arcs, options["decimals"], has_comments, numbering, is_inline)


def _rewrite(
    opening: AbstractContextManager[OpenFile],
    body: IO[bytes],
    wish: ExpansionOptions,
    start: str | None,
    options: Mapping[str, Any],
    progress: Callable[[float], None],
) -> Rewritten:
    """Expand a program."""
    tool = {name: options[name] for name in ("tool", "tip", "side", "outside") if name in options}
    told = {name: options[name] for name in ("units", "rules", "facts", "variables", "folders") if name in options}
    with opening as opened, naming(opened.name):
        settings, control = settings_of(opened, options["assignments"]), options["control"]
        asked = SolveOptions(start=start, control=control, settings=settings, **told)
        if tool.get("tool") and not options.get("has_formulas"):
            from contoursolve.output import rewrite_beside_tool  # noqa: PLC0415 - few programs need it
            from contoursolve.tool_radius import wanted_tool  # noqa: PLC0415 - as above

            wanted = wanted_tool(opened.name, **tool)
            return rewrite_beside_tool(opened, body, wish, asked, wanted, follow_options, progress)
        writer = _formulas(opened, wish, options) if options.get("has_formulas") else None
        request = asked.request(opened.name)
        return rewrite(
            opened, body, wish, request, control=control, settings=settings, progress=progress, writer=writer
        )


def _formulas(source: OpenFile, wish: ExpansionOptions, options: Mapping[str, Any]) -> Writer:
    """The writer of contours as formulas."""
    from contoursolve.postprocess import formulas_for  # noqa: PLC0415 - few programs need it

    return formulas_for(
        source.read(), wish.post, options["scratch"], options["variables"] or {}, Policy(options["rules"])
    )


@contextmanager
def _progress_bar() -> Iterator[Callable[[float], None]]:
    """A bar on standard error if that is a terminal; a program that is done before it tells anything needs none."""
    with ExitStack() as stack:
        bars: list[Any] = []

        def show(share: float) -> None:
            if not bars and is_screen(sys.stderr):
                bars.append(stack.enter_context(click.progressbar(length=100, label="expanding", file=sys.stderr)))
            for bar in bars:
                bar.update(int(share * 100) - bar.pos)

        yield show
        for bar in bars:
            bar.update(100 - bar.pos)


def report_left(summary: Summary, name: str, style: Style) -> None:
    """Print on standard error why contours were not expanded."""
    for left in summary.left:
        if all(not finding.is_error for finding in left.diagnostics):
            say(f"{style('error', 'error')}: program line {left.lines[0]}: {left.reason}", err=True)
        for finding in without_repeated(left.diagnostics):
            here = tuple(label for label in finding.labels if label.span.line in left.sources)
            about = replace(finding, labels=here)
            lines = finding_lines(about, name, left.sources, style, explaining=explaining(name))
            say("\n".join(lines), err=True)


def report_misread(summary: Summary, post: Post, style: Style, *, is_kept: bool) -> None:
    """Print on standard error the lines that the target would run along another path."""
    severity = "warning" if is_kept else "error"
    for each in summary.misread:
        say(f"{style(severity, severity)}: program line {each.line}: {each.sentence(post.title)}", err=True)


def report_fixed(summary: Summary, style: Style) -> None:
    """Print on standard error the lines whose variables have the values of one run."""
    for each in summary.fixed:
        say(
            f"program line {each.line}: {style('warning', 'warning')}: {each.sentence} (see --formulas and --inline)",
            err=True,
        )


def report_told(summary: Summary, post: Post) -> None:
    """Print on standard error the lines at which the target stops, or that it reads otherwise on the same path."""
    for each in summary.unfamiliar:
        if each.risk is Risk.TOLD:
            say(f"program line {each.line}: {each.sentence(post.title)}", err=True)


def _report_expansion(summary: Summary, post: Post, style: Style) -> None:
    """Print on standard error what was expanded, and what is left to do."""
    for finding in summary.concluded:
        say(f"{style('info', 'info')}[{finding.code}]: {finding.message}", err=True)
    for finding in summary.warned:
        place = (
            f"program line {finding.span.line}"
            if finding.span.line > 0
            else "--start"
            if not finding.span.line
            else "--fact"
        )
        say(f"{place}: {style('warning', 'warning')}[{finding.code}]: {finding.message}", err=True)
    if summary.warnings > len(summary.warned):
        say(f"and {count(summary.warnings - len(summary.warned), 'warning')} more", err=True)
    report_fixed(summary, style)
    report_told(summary, post)
    done = f"{count(summary.replaced, 'contour')} expanded"
    if summary.replaced:
        done += f", at most {summary.deviation:.1g} mm off"
    if summary.left:
        done += f"; {len(summary.left)} left"
    if summary.warnings:
        them = "it" if summary.warnings == 1 else "them"
        done += f"; {count(summary.warnings, 'warning')}: contoursolve check says more about {them}"
    if summary.restated:
        done += f"; {count(summary.restated, 'other block')} read for {post.title}"
    if not (summary.replaced or summary.left or summary.restated):
        here = "no contour block in this file" if summary.elsewhere else "no contour block"
        done = f"{here}: nothing to expand"
    say(done, err=True)
    for finding in summary.elsewhere:
        way = "" if finding.is_error else "; expand --inline writes it out"
        say(f"program line {finding.span.line}: {finding.message}{way}", err=True)
