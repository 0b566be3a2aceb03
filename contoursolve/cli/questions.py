"""The commands about a word of one block: which values it may have, which one is wanted, what it moves."""

from collections.abc import Sequence
from math import isfinite
from typing import Any

import click
from click.core import ParameterSource

from contoursolve.api import follow_program
from contoursolve.cli.block_options import (
    block_options,
    fact_option,
    is_about_tool,
    program_options,
    read_options,
    read_within,
    usage,
)
from contoursolve.cli.brief_help import LongCommand
from contoursolve.cli.options import FILE, FOUND_ERRORS, check_toolless, format_option, load, settings_of, side_options
from contoursolve.cli.printing import print_json, print_lines
from contoursolve.families import feasible, find as find_values, region, tolerance_for, tolerances as effects_of
from contoursolve.output import (
    found_data,
    found_view,
    range_data,
    range_view,
    region_data,
    region_view,
    tolerances_data,
    tolerances_view,
    tools_data,
    tools_lines,
    word_tolerance_data,
    word_tolerance_view,
)
from contoursolve.program import check_start
from contoursolve.tool_radius import ToolTrials, find_tools, largest_tools, least_of, wanted_tool


@click.command("ranges", cls=LongCommand, short_help="Tell for which values of a word, or of two, a contour exists.")
@block_options
@format_option
@click.option(
    "--word",
    "words",
    multiple=True,
    required=True,
    metavar="WORD",
    help="A word of the block, such as P, or 2:,A for program line 2; 'start X' of the start point; a fact, by what it "
    "gives the value of. Given twice, the region of both. 'tool' is the radius of the tool that cuts it.",
)
@click.option(
    "--within",
    multiple=True,
    metavar="LOW:HIGH",
    help="The range to search, for each word in turn, in mm, inches or degrees; X is a diameter where that of the "
    "block is; without it, one turn for an angle, 1 m to either side for a length.",
)
@side_options
@fact_option
@click.pass_context
def ranges(
    context: click.Context,
    /,
    words: tuple[str, ...],
    within: tuple[str, ...],
    tip: int | None,
    side: str | None,
    outside: str | None,
    facts: tuple[str, ...],
    format_: str,
    **options: Any,
) -> None:
    """Tell for which values of WORD the contour of a block exists, and what ends each range of them.

    ranges finds every range: it divides the values until each part is proven to have the contour or to have none. It
    solves the block on both sides of each end. For two words it samples the region: it solves values all over it, more
    where the outcome changes, and says how finely. It names what fails beyond each line; --format json has their
    points. With facts or ? it follows all solutions: the contour exists where exactly one can be made. Where they leave
    no formula, use family, which solves the block value by value.

    With --word tool it tells up to which radius a tool cuts the contour, and what stops a larger one. It takes every
    cutting move of the block, with contour words or without.

    Exit status: 0 the contour exists for some value, 1 for none, 2 could not run.

    \b
    contoursolve ranges --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." --word P
    contoursolve ranges --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." \\
      --word tool --side right --tip 3
    """
    ranges = [read_within(each) for each in within]
    is_tool, stated = is_about_tool(words), dict[str, Any](tip=tip, side=side, outside=outside)
    if is_tool and len(words) > 1:
        told = "family tries both: --vary tool=0.2:1.2:0.05 and --vary with the other word"
        raise click.UsageError(f"--word tool stands alone; {told}")
    if not is_tool:
        check_toolless(stated, "--word tool")
    if len(words) > 2 or (len(words) == 2 and len(ranges) != 2) or len(ranges) > len(words):  # noqa: PLR2004
        raise click.UsageError("name one --word, or two with a --within LOW:HIGH for each")
    with usage():
        about = {"facts": facts, **read_options(options)}
        if len(words) == 1:
            limits = ranges[0] if ranges else None
            if is_tool:
                found = least_of(find_tools(about.pop("block"), within=limits, **about, **stated))
            else:
                found = feasible(word=words[0], within=limits, **about)
            exists, lines, document = bool(found.intervals), range_view(found).lines(), range_data(found)
        else:
            both = region(words=(words[0], words[1]), within=(ranges[0], ranges[1]), **about)
            exists, lines, document = both.exists, region_view(both).lines(), region_data(both)
    if format_ == "json":
        print_json(document)
    else:
        print_lines(lines)
    context.exit(0 if exists else FOUND_ERRORS)


@click.command("find", cls=LongCommand, short_help="Find the value of a word that brings a point where it is wanted.")
@click.argument("program", required=False, type=FILE)
@program_options
@format_option
@click.option(
    "--word",
    required=True,
    metavar="WORD",
    help="A word of the block, such as A, or 2:,A for program line 2; 'start X' of the start point; a fact, by what it "
    "gives the value of. 'tool' is the largest tool for all contours of PROGRAM, or of the block.",
)
@click.option(
    "--goal",
    "goal",
    metavar="GOAL",
    help="A point and where it is wanted, in words as the control reads them: 'end Z-50.', 'V1 X44.', "
    "'corner 1.center Z-20.'. With both coordinates, find looks for what comes nearest.",
)
@click.option(
    "--within",
    metavar="LOW:HIGH",
    help="The range to search, in mm, inches or degrees; X is a diameter where that of the block is; without it, "
    "one turn for an angle, 1 m to either side for a length.",
)
@side_options
@fact_option
@click.pass_context
def find(
    context: click.Context,
    /,
    program: str | None,
    word: str,
    goal: str | None,
    within: str | None,
    tip: int | None,
    side: str | None,
    outside: str | None,
    facts: tuple[str, ...],
    format_: str,
    **options: Any,
) -> None:
    """Find every value of WORD with which a point of the contour lies where it is wanted.

    find solves and certifies each value by itself. It also prints the block to write, with the value rounded to the
    control's least increment. It says how far the point is off then.

    With --word tool it finds the largest tool that cuts all contours of PROGRAM, and the largest for each. It says what
    limits it. --block, --start and --fact may stand in for PROGRAM; --goal is not needed.

    Exit status: 0 found, 1 no such value, 2 could not run.

    \b
    contoursolve find --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." --word A --goal "end Z-50."
    contoursolve find part.nc --word tool --side right --tip 3
    """
    limits = read_within(within) if within else None
    if is_about_tool([word]):
        _find_tool(context, program, (tip, side, outside), limits, {"facts": facts, **options}, goal, format_)
        return
    check_toolless({"tip": tip, "side": side}, "--word tool")
    if program is not None or not options["blocks"]:
        raise click.UsageError("give the block with --block; only --word tool takes a PROGRAM")
    if goal is None:
        raise click.UsageError("missing --goal: name a point and where it is wanted, such as 'end Z-50.'")
    with usage():
        found = find_values(word=word, goal=goal, within=limits, facts=facts, **read_options(options))
    if format_ == "json":
        print_json(found_data(found))
    else:
        print_lines(found_view(found).lines())
    context.exit(0 if found.hits else FOUND_ERRORS)


def _find_tool(
    context: click.Context,
    name: str | None,
    tool: tuple[int | None, str | None, str | None],
    within: tuple[float, float] | None,
    options: dict[str, Any],
    goal: str | None,
    format_: str,
) -> None:
    """Print the largest tool for all contours of a program."""
    if goal is not None:
        raise click.UsageError("--goal goes with a word of the block, not with --word tool")
    (program,) = (read() for read in load([name] if name is not None else [], options.pop("blocks")))
    with usage(program.name):
        settings = settings_of(program, options.pop("assignments"))
        run = follow_program(program, settings=settings, **options)
        check_start(run.asked)
        wanted = wanted_tool(program.name, None, *tool)
        trials = ToolTrials(result := run.collect(), run.asked, wanted)
        found = largest_tools(trials, result, within)
    if format_ == "json":
        print_json(tools_data(found, trials.path.unfollowed))
    else:
        print_lines(tools_lines(found, trials.path.unfollowed))
    context.exit(0 if all(each.intervals for each in found.values()) else FOUND_ERRORS)


_point_option = click.option(
    "--point", metavar="POINT", default="end", show_default=True, help="The point: end, V2, 'corner 1.center', ..."
)


@click.command("sensitivity", short_help="Tell which word moves a point most.")
@block_options
@format_option
@_point_option
@fact_option
def sensitivity(point: str, facts: tuple[str, ...], format_: str, **options: Any) -> None:
    """Tell how far each word moves a point of a contour.

    A row for each word: per unit, and by rounding to the control's least increment. 'contoursolve tolerances' adds the
    effect of tolerances.

    Exit status: 0 done, 2 could not run, or the block has no contour.

    \b
    contoursolve sensitivity --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0."
    """
    _print_effects({}, point, facts, format_, options)


def _print_effects(
    allowed: dict[str, float], point: str, facts: tuple[str, ...], format_: str, options: dict[str, Any]
) -> None:
    """Print by how much each word moves a point, and what its tolerance comes to."""
    with usage():
        found = effects_of(allowed=allowed, point=point, facts=facts, **read_options(options))
    if format_ == "json":
        print_json(tolerances_data(found))
    else:
        print_lines(tolerances_view(found).lines())


@click.command("tolerances", cls=LongCommand, short_help="Tell the effect of tolerances, or how far a word may be off.")
@block_options
@format_option
@_point_option
@click.option(
    "--tolerance",
    "allowed",
    multiple=True,
    metavar="WORD=VALUE",
    help="By how much a word may be off to either side, in mm, inches or degrees; X is a diameter where that of the "
    "block is; may be repeated. A fact goes by what it gives the value of.",
)
@click.option(
    "--keep",
    "kept",
    metavar="RESULT=VALUE",
    help="Tell instead how far a word may be off until a result moves by VALUE, such as 'end Z=0.01'. RESULT is a "
    "coordinate of a point, or what a fact gives the value of. VALUE is in mm, inches or degrees; X is a diameter "
    "where that of the block is.",
)
@click.option(
    "--word", "words", multiple=True, metavar="WORD", help="With --keep, the word; may be repeated; all without it."
)
@fact_option
@click.pass_context
def tolerances(
    context: click.Context,
    /,
    allowed: tuple[str, ...],
    point: str,
    kept: str | None,
    words: tuple[str, ...],
    facts: tuple[str, ...],
    format_: str,
    **options: Any,
) -> None:
    """Tell the effect of tolerances on a point of a contour.

    A row for each word: per unit, by its tolerance, and by rounding to the control's least increment. Tolerances add up
    to first order, at worst and statistically (RSS); the block is also solved at all combinations of their limits.
    With --keep it is the other way round: between which values a word may be, and what ends them.

    Exit status: 0 done, 2 could not run, or the block has no contour.

    \b
    contoursolve tolerances --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." \\
      --tolerance A=0.1 --tolerance K=0.02
    """
    given: dict[str, float] = {}
    for name, number in map(_read_tolerance, allowed):
        if name in given:
            raise click.UsageError(f"--tolerance names {name} twice")
        given[name] = number
    if kept is not None:
        is_other = given or context.get_parameter_source("point") is ParameterSource.COMMANDLINE
        if is_other:
            raise click.UsageError("--keep names the result itself; leave out --tolerance and --point")
        _keep(kept, words, {"facts": facts, **read_options(options)}, format_)
        return
    if words:
        raise click.UsageError("--word says for which words --keep asks; give --keep, such as 'end Z=0.01'")
    _print_effects(given, point, facts, format_, options)


def _keep(text: str, words: Sequence[str], about: dict[str, Any], format_: str) -> None:
    """Print how far words may be off so that a result stays."""
    keep, within = _read_number("--keep", text, "RESULT=VALUE, such as 'end Z=0.01'")
    with usage():
        names = words or [each.word for each in effects_of(**about).effects]
        found = [tolerance_for(word=each, keep=keep, within=within, **about) for each in names]
    if format_ == "json":
        print_json({"schema": "contoursolve/tolerance/1", "words": [word_tolerance_data(each) for each in found]})
    else:
        print_lines(line for each in found for line in word_tolerance_view(each).lines())


def _read_tolerance(text: str) -> tuple[str, float]:
    return _read_number("--tolerance", text, "WORD=VALUE, such as P=0.05")


def _read_number(option: str, text: str, form: str) -> tuple[str, float]:
    """A name and its number."""
    name, equals, value = text.rpartition("=")
    try:
        number = float(value)
    except ValueError:
        number = float("nan")
    if not equals or not isfinite(number):
        raise click.UsageError(f"{option} {text}: write {form}")
    return name.strip(), number
