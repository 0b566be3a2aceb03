"""Answers of the desk that make something of a program: drawings, other programs, pages; with a tool, with values."""

import base64
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import PurePath
from typing import Any

import contoursolve
from contoursolve.comparison import Document, compare, follow, verify
from contoursolve.controls import CONTROLS
from contoursolve.diagnostics import importing
from contoursolve.execution import NamedVariable, named_variables
from contoursolve.notebook import (
    Product,
    converted,
    expanded,
    expanded_beside_tool,
    page_about,
    report_on_tool,
    stated_tool,
)
from contoursolve.output import beside_of, differences, receipt_lines, receipt_summary, to_json
from contoursolve.pictures import Picture, Theme, draw_comparison, draw_result
from contoursolve.postprocess import ending_of
from contoursolve.program import CONTROL, Result
from contoursolve.tool_radius import ToolReport, result_beside_tool, title_of
from contoursolve.workbench.fields import ActionError, Data, read_field
from contoursolve.workbench.open_view import ProgramView, contour_row
from contoursolve.workbench.playing import over_drawing

MOST_VARIABLES = 200
"""Variables of a program that have fields."""

SAME = 0.001
"""Distance up to which two paths are the same, mm, as for `contoursolve diff`."""

MOST_VALUE = 1_000_000_000
"""Of a variable, either way; NaN is not below it."""


def answer_with(make: str, view: ProgramView, action: Mapping[str, Any]) -> Data:
    """The answer of one of `PRODUCTS`, of a program that is examined. Raises ActionError, ValueError."""
    view.program.check()
    if view.program.control is None:
        raise ActionError(view.program.trouble or "no word tells the control; choose it, or write the program first")
    return PRODUCTS[make](view, action)


def _drawing(view: ProgramView, _: Mapping[str, Any]) -> Data:
    result = view.program.result()
    picture = draw_result(result, theme=Theme.PAGE, beside=beside_of(_stated(view)))
    return {**_told_of(picture), **over_drawing(view, result, picture)}


def _stated(view: ProgramView) -> ToolReport | None:
    """The report about the tool that the program or the project file states, if there is one."""
    found = stated_tool(view.program, view.path)
    return found if isinstance(found, ToolReport) else None


def _drawn(result: Result, tool: ToolReport | None) -> Data:
    return _told_of(draw_result(result, theme=Theme.PAGE, beside=beside_of(tool)))


def _told_of(picture: Picture) -> Data:
    return {"svg": picture.svg, "title": picture.title, "description": picture.description}


def _with_tool(view: ProgramView, action: Mapping[str, Any]) -> Data:
    report = report_on_tool(view.program, view.path, **_tool(action))
    result = result_beside_tool(view.program.result(), report)
    radii = [each.largest_radius for each in report.runs]
    limits = [each for each in radii if each is not None]
    return {
        **_drawn(result, report),
        "findings": _told(view, result),
        "runs": [
            {
                "line": each.run.lines[0],
                "last": each.run.lines[-1],
                "title": title_of(each),
                "fits": each.path is not None,
                "largest_mm": largest,
            }
            for each, largest in zip(report.runs, radii, strict=True)
        ],
        "largest_mm": min(limits, default=None),
    }


def _tool(action: Mapping[str, Any]) -> Data:
    """The tool that an action states."""
    kinds = {"tool": str, "tip": int, "side": str, "outside": str}
    return {name: read_field(action, name, kind) for name, kind in kinds.items() if action.get(name) not in (None, "")}


def _with_values(view: ProgramView, action: Mapping[str, Any]) -> Data:
    program = view.program
    language = program.control.modes.language if program.control is not None else None
    values = read_field(action, "values", dict, {})
    if not all(isinstance(each, int | float) and abs(each) <= MOST_VALUE for each in values.values()):
        raise ActionError(f"values of variables are numbers up to {MOST_VALUE:,}")
    found = sorted(named_variables(language, view.lines()) if language is not None else (), key=_by_number)
    start = read_field(action, "start", str, "").strip() or None
    result = contoursolve.solve(program.text, control=program.control, name=program.name, variables=values, start=start)
    return {
        **_drawn(result, None),
        "fields": [
            {
                "name": each.name,
                "line": each.line,
                "set_on": each.set_on,
                "number": each.number,
                "value": values.get(each.name),
            }
            for each in found[:MOST_VARIABLES]
        ],
        "left_out": max(len(found) - MOST_VARIABLES, 0),
        "findings": _told(view, result),
        "contours": [contour_row(each, each.lines[0], each.lines[-1]) for each in result.answers],
    }


def _by_number(variable: NamedVariable) -> list[tuple[int, str]]:
    """The order of variables as people count them: #3 before #10."""
    return [(int(each), "") if each.isdecimal() else (0, each) for each in re.split(r"(\d+)", variable.name)]


def _told(view: ProgramView, result: Result) -> Sequence[Data]:
    """The findings of another result of the same text. Their fixes are those of the program as it is, and not here."""
    return [{**view.told(each, result.lines_of(each)), "fixes": []} for each in result.diagnostics]


# Files ---------------------------------------------------------------------------------------------------------------


def _expand(view: ProgramView, action: Mapping[str, Any]) -> Data:
    if tool := _tool(action):
        return _program(view, expanded_beside_tool(view.program, view.path, **tool), f"-tool{_suffix(view)}")
    kinds = {"post": str, "arcs": str, "decimals": int, **dict.fromkeys(_SWITCHES, bool)}
    options = {name: read_field(action, name, kind) for name, kind in kinds.items() if action.get(name) is not None}
    return _program(view, expanded(view.program, **options), f"-plain{_suffix(view)}")


_SWITCHES = ("comments", "inline", "keep_going", "keep_untranslated")


def _convert(view: ProgramView, action: Mapping[str, Any]) -> Data:
    control = read_field(action, "to", str)
    if control not in CONTROLS:
        raise ActionError(f"{control!r} is no control here")
    settings = {name: value for name, value in view.settings.items() if name != CONTROL}
    made = converted(view.program, control, settings)
    left = [{"line": each.line, "text": each.text, "reason": each.reason} for each in made.not_converted]
    return {**_program(view, made, f"-{control}{ending_of(CONTROLS[control])}"), "not_converted": left}


def _program(view: ProgramView, made: Product, ending: str) -> Data:
    """Another program in the encoding of the first one."""
    more = {"details": made.details} if made.details else {}
    if made.text is None and more:
        return {"name": "", "message": f"Nothing was written: {made.message}", **more}
    if made.text is None:
        raise ActionError(made.message or "nothing was written: a contour is not solved; mend its findings first")
    return {**_file(view, ending, view.file.encode(made.text), made.message), "text": made.text, **more}


def _report(view: ProgramView, _: Mapping[str, Any]) -> Data:
    made = page_about(view.program, stated_tool(view.program, view.path), contoursolve.__version__)
    if made.text is None:
        raise ActionError(made.message)
    return _file(view, ".html", made.text.encode("utf-8", "replace"))


def _dxf(view: ProgramView, _: Mapping[str, Any]) -> Data:
    with importing("dxf", "a DXF drawing"):
        from contoursolve.output import drawing_for_cad  # noqa: PLC0415 - needs an extra

        drawn = drawing_for_cad(view.program.result(), _stated(view))
    if drawn is None:
        raise ActionError("no contour is solved, so that nothing can be drawn")
    return _file(view, ".dxf", *drawn)


def _png(view: ProgramView, _: Mapping[str, Any]) -> Data:
    picture = draw_result(view.program.result(), beside=beside_of(_stated(view)))
    return _file(view, ".png", picture.png(), picture.title)


def _verify(view: ProgramView, _: Mapping[str, Any]) -> Data:
    """The result of the program, checked against its words without the solver."""
    result = view.program.result()
    program = Document(view.file.name, view.file.encode(view.text))
    receipt = verify(program, Document("result", to_json(result).encode()), control=view.program.control)
    details = "\n".join(receipt_lines(receipt))
    return {"name": "", "verdict": receipt.verdict.value, "message": receipt_summary(receipt), "details": details}


def compared(old: ProgramView, new: ProgramView) -> Data:
    """The differences of the paths of two programs, as the command line tells them, with a picture. Raises
    ActionError."""
    for view in (old, new):
        view.program.check()
        if view.program.control is None:
            raise ActionError(f"{view.file.name}: {view.program.trouble or 'no word tells the control; choose it'}")
    results = [view.program.result() for view in (old, new)]
    for view, result in zip((old, new), results, strict=True):
        if any(each.is_error for each in result.diagnostics):
            raise ActionError(f"not compared: {view.file.name} has errors, and no path; mend them first")
    controls = [view.program.control for view in (old, new)]
    axes = tuple(sorted({axis for each in controls if each is not None for axis in each.modes.axes}))
    paths = [
        follow(result, control, view.program.request.unit, axes)
        for view, result, control in zip((old, new), results, controls, strict=True)
        if control is not None
    ]
    comparison = compare(paths[0], paths[1], SAME)
    told = [*differences.comparison_lines(comparison)]
    picture = draw_comparison(comparison, theme=Theme.PAGE)
    title = f"{old.file.name} and {new.file.name}"
    text = "\n".join(told[1:]).strip()
    return {"name": "", "title": title, "message": told[0], "svg": picture.svg, "text": text}


def _suffix(view: ProgramView) -> str:
    return PurePath(view.file.name).suffix or ".nc"


def _file(view: ProgramView, ending: str, data: bytes, message: str = "") -> Data:
    """A file that a page may save, named after the program."""
    stem = PurePath(view.file.name).stem or "program"
    return {"name": f"{stem}{ending}", "base64": base64.b64encode(data).decode("ascii"), "message": message}


PRODUCTS: Mapping[str, Callable[[ProgramView, Mapping[str, Any]], Data]] = {
    "drawing": _drawing,
    "tool": _with_tool,
    "variables": _with_values,
    "expand": _expand,
    "convert": _convert,
    "report": _report,
    "dxf": _dxf,
    "png": _png,
    "verify": _verify,
}
"""Functions that make something of a program, by the name of the action."""
