"""Two programs, or a program and what is claimed of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from msgspec.structs import replace

from contoursolve import output
from contoursolve.api import read_source
from contoursolve.controls import CONTROLS, PLAIN, ControlName
from contoursolve.diagnostics import LateModule, ProgramError, UserError, check_type, did_you_mean
from contoursolve.gcode import Program
from contoursolve.program import (
    CONTROL,
    Request,
    Result,
    SolveOptions,
    StartKeywords,
    UnknownControlError,
    choose_alike,
    configure,
    run,
    start_text,
    takes,
)
from contoursolve.reading import Control, ReadIssue

# What these rooms hold is imported when it is asked for, by `help` and `typing.get_type_hints`, too.
if TYPE_CHECKING:
    from contoursolve import comparison
else:
    comparison = LateModule("contoursolve.comparison")

__all__ = ["compare_programs", "diff", "verify"]

ANY_CONTROL = (*CONTROLS, *PLAIN)
"""The names of controls whose programs have a path."""

Naming = Callable[[str], AbstractContextManager[None]]


@takes(StartKeywords)
def diff(
    old: str | Path | Program,
    new: str | Path | Program,
    *,
    tolerance: float = 0.001,
    new_control: ControlName | Control | None = None,
    new_units: str | None = None,
    tool: str | None = None,
    tip: int | None = None,
    side: str | None = None,
    outside: str | None = None,
    folders: Iterable[str | Path] = (),
    **options: Unpack[StartKeywords],
) -> comparison.Comparison:
    """Compare the paths of two programs: the same, or every difference, the largest first.

    Args:
        old: a program, as for `solve`: its text, the `Path` of a file, or what `parse` gave.
        new: the other program.
        tolerance: how far apart the paths may be, mm.
        new_control: the control of `new`; without it that named for `old`, unless `new` has words of another.
        new_units: `mm` or `inch` of `new`; without it as for `old`.
        tool: a tool, such as `"R0.8, tip 3"`: a program with G41 or G42 stands for the path of the tool beside it.
        tip: the number of its imaginary tip.
        side: `left` or `right` of `old`, where neither program has G41 or G42.
        outside: the way around an outside corner, `roll` or `intersect`.
        folders: where files with subprograms are, besides those of the programs.
        control: of `old`; and all others as for `solve`, with the same errors.

    Raises NotComparedError where a program has errors, so that it has no path; its `results` have them.

    >>> same = diff("G01 X40. Z0.\\nZ-30.", "G01 X40. Z0.\\nZ-10.\\nZ-30.", control="fanuc-lathe")
    >>> same.is_equal
    True
    >>> old, new = "G01 X40. Z0.\\nZ-30.", "G01 X40. Z0.\\nZ-30.02"
    >>> round(diff(old, new, control="fanuc-lathe").differences[0].distance, 6)
    0.02
    """
    return compare_programs(
        old,
        new,
        SolveOptions(**options, folders=folders),
        _naming,
        tolerance=tolerance,
        new_control=new_control,
        new_units=new_units,
        tool={"tool": tool, "tip": tip, "side": side, "outside": outside},
    )


@contextmanager
def _naming(program: str) -> Iterator[None]:
    """Errors about a program begin with its name; where its control is not known, they end with how to say it."""
    try:
        yield
    except UnknownControlError as error:
        said = f"{program}: {error.said}"
        raise UnknownControlError(
            f"{said}; say which with control= or new_control=", error.choices, error.readings
        ) from None
    except ProgramError as error:
        raise UserError(f"{program}: {error}") from None


def compare_programs(
    old: str | Path | Program,
    new: str | Path | Program,
    options: SolveOptions,
    naming: Naming,
    *,
    tolerance: float,
    new_control: str | Control | None,
    new_units: str | None,
    tool: Mapping[str, Any],
) -> comparison.Comparison:
    """The same with its options in records; errors of a program are raised within `naming` of its name."""
    if tool["tool"] is None and (stated := [name for name, value in tool.items() if value is not None]):
        raise ValueError(f'{stated[0]} is about a tool, and there is none: say tool="R0.8"')
    sides: list[tuple[Result, Control, Request]] = []
    for source, own, unit, called in ((old, options.control, None, "<old>"), (new, new_control, new_units, "<new>")):
        program, told = read_source(source, called, options)
        before = sides[0][1] if sides else None
        is_kept = options.control is not None and before is not None and _reads_what_shows_others(before, program)
        told = replace(told, units=unit or told.units, strict=True)
        with naming(program.name):
            control = _control_of(program, own or (before if is_kept else None), before, told)
        asked = replace(told, settings=None).request(program.name, control)
        sides.append((run(program, asked), control, asked))
    if any(_has_no_path(result) for result, *_ in sides):
        raise comparison.NotComparedError([result for result, *_ in sides], [asked for *_, asked in sides])
    axes = tuple(sorted({axis for _, control, _ in sides for axis in control.modes.axes}))
    finishes = tool["tool"] is not None
    paths = [
        comparison.follow(result, control, asked.unit, axes, finishes=finishes) for result, control, asked in sides
    ]
    one, other = _beside_tool(sides, paths, tool, naming) if finishes else paths
    return comparison.compare(one, other, tolerance)


def _beside_tool(
    sides: Sequence[tuple[Result, Control, Request]],
    paths: Sequence[comparison.ToolPath],
    tool: Mapping[str, Any],
    naming: Naming,
) -> list[comparison.ToolPath]:
    """The paths of the tool beside contours, and those that are paths of it already. Raises UserError."""
    from contoursolve.tool_radius import is_compensated, look_at_tool, path_of_tool, wanted_tool  # noqa: PLC0415

    found: list[comparison.ToolPath] = []
    for (result, _, asked), path in zip(sides, paths, strict=True):
        own = tool if not found else {**tool, "side": None}
        if not is_compensated(path) and own["side"] is None:
            found.append(path)
            continue
        name = result.program.name
        with naming(name):
            report = look_at_tool(result, asked, wanted_tool(name, **own), path.axes)
        error = next((each for each in report.findings if each.is_error), None)
        if error is not None:
            told = f"{error.message}; check it with this tool for more"
            raise UserError(f"{name}: program line {error.span.line}: {told}")
        found.append(path_of_tool(report))
    if all(one is other for one, other in zip(found, paths, strict=True)):
        raise UserError("neither program has G41 or G42 (RL or RR); say the side of the first one, left or right")
    return found


def _reads_what_shows_others(control: Control, program: Program) -> bool:
    """Whether a control has every word by which a program shows another one, so that it need not be for that one."""
    others = [other for other in CONTROLS.values() if other.name != control.name]
    shown = [word for other in others for block in program.blocks for word in other.signs(block)]
    addresses, codes = control.modes.lexicon.addresses, control.modes.codes
    return all(word.number in codes if word.address == "G" else word.address in addresses for word in shown)


def _control_of(
    program: Program, control: str | Control | None, otherwise: Control | None, options: SolveOptions
) -> Control:
    """The control of a program: the one that is named, or that it shows, or another. Raises UnknownControlError."""
    settings = dict(options.settings or {})
    name = control or settings.get(CONTROL)
    known = {**CONTROLS, **PLAIN}
    if isinstance(name, str) and name not in known:
        raise UnknownControlError(f"there is no control {name!r}; {did_you_mean(name, known)}".rstrip("; "), known)
    named = known[name] if isinstance(name, str) else name
    asked = SolveOptions(folders=options.folders).request(program.name)
    shown = None if named else choose_alike(None, program, asked, settings)
    chosen = named or shown or otherwise
    if chosen is None:
        raise UnknownControlError("no block shows the control", known)
    return shown or configure(chosen, settings)


def _has_no_path(result: Result) -> bool:
    """Whether a program has errors; that it has no contour is none here."""
    errors = (each for each in result.diagnostics if each.is_error)
    return any(each.about is not ReadIssue.NO_CONTOUR for each in errors)


@takes(StartKeywords)
def verify(
    program: str | Path | Program,
    result: Result | str | Path,
    *,
    facts: Iterable[str] = (),
    folders: Iterable[str | Path] = (),
    **options: Unpack[StartKeywords],
) -> comparison.Receipt:
    """Check a claimed result against the words of a program, without the solver.

    Args:
        program: as for `solve`: its text, the `Path` of a file, or what `parse` gave.
        result: a `Result`, the text that `contoursolve solve --format json` printed, or the `Path` of a file with it.
        facts: further facts about the only contour, as text, as they were given to `solve`.
        folders: where files with subprograms are, besides that of the program.
        control: its name, or its tables; without it the one that the result names.
        start: words that give the start point, as they were given to `solve`.
        units: `mm` or `inch`, for numbers before any G20 or G21.
        variables: values of variables by name, as they were given to `solve`.

    The value of each word is measured at the points and elements of the result: joints, tangency, senses, sizes. It
    shares with `solve` which contours a program has and what their words state. The rules and the settings are those
    that the result names.

    Returns:
        A `Receipt`: its `verdict`, and of each contour every check, how far it is off, and its limit.

    Raises CannotVerifyError for an input that is not what it should be. Rules and settings stand in the result; given
    here, they are refused, too.

    >>> from contoursolve import solve
    >>> block, start = "G111 X100. A180. K-30. B120. P5.", "X40. Z0."
    >>> verify(block, solve(block, start=start), start=start).verdict.value
    'verified'
    >>> verify(block.replace("P5.", "P6."), solve(block, start=start), start=start).verdict.value
    'failed'
    """
    told = SolveOptions(**options)
    told.check_types()
    named = next((name for name in ("rules", "settings") if name in options), None)
    if named is not None:
        raise comparison.CannotVerifyError(f"{named} are those that the result names; leave {named} out")
    return comparison.verify(
        _document(read_source(program, "<program>", told)[0]),
        _claims(result),
        told.control,
        told.units,
        start_text(told.start),
        [facts] if isinstance(facts, str) else tuple(facts),
        told.variables,
        folders,
    )


def _document(program: Program) -> comparison.Document:
    return comparison.Document(program.name, program.text.encode())


def _claims(result: Result | str | Path) -> comparison.Document:
    if isinstance(result, Path):
        return comparison.read_document(str(result))
    check_type("result", result, Result | str, "a Result, the text of its JSON, or a Path")
    return comparison.Document("<result>", (result if isinstance(result, str) else output.to_json(result)).encode())
