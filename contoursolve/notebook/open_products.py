"""Products of an open program: plain G-code, another control's words, a page, a notebook; and what is stated beside it.

An editor's server and the workbench offer the same ones. What a product needs is imported when it is made.
"""

import json
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from msgspec import Struct
from msgspec.structs import replace

if TYPE_CHECKING:
    from contoursolve.controls import ControlName
    from contoursolve.postprocess import NotConverted, Summary
    from contoursolve.program import OpenProgram
    from contoursolve.tool_radius import ToolReport, ToolRequest

MOST_TOLD = 3
"""Things that were left as they are that a message names."""


class Product(Struct, frozen=True):
    """A text that was made of a program, and what is to be said of it; without a text, why there is none. `details` are
    all lines of it, where the message names some; `not_converted` is what has no counterpart on another control."""

    text: str | None
    message: str = ""
    details: str = ""
    not_converted: "tuple[NotConverted, ...]" = ()


def project_settings(path: Path | None) -> dict[str, str] | str:
    """The settings of the project file beside a program or above it, or what is wrong with that file."""
    from contoursolve.program import find_settings  # noqa: PLC0415 - a server is asked before it has loaded anything

    try:
        return find_settings(path.parent) if path is not None else {}
    except (OSError, ValueError) as error:  # a name that no file may have, or a SettingError
        return str(error)


def stated_tool(program: "OpenProgram", path: Path | None) -> "ToolReport | str | None":
    """The report about the tool that a program or its project file states; the reason where nothing can be said, None
    where no tool is stated."""
    from contoursolve.program import find_tool_table  # noqa: PLC0415 - as above

    is_stated = "contoursolve tool" in program.text
    try:
        has_table = path is not None and find_tool_table(path.parent)
        return report_on_tool(program, path) if program.control is not None and (is_stated or has_table) else None
    except (OSError, ValueError) as error:
        return str(error) if is_stated else None


def report_on_tool(program: "OpenProgram", path: Path | None, **stated: Any) -> "ToolReport":
    """The report about a tool, which is stated as for `solve_with_tool`; else about that of the program or its project
    file. Raises ToolError."""
    from contoursolve.tool_radius import look_at_tool  # noqa: PLC0415 - as above

    program.check()
    return look_at_tool(program.result(), program.request, _tool_of(path, **stated))


def _tool_of(path: Path | None, **stated: Any) -> "ToolRequest":
    from contoursolve.tool_radius import wanted_tool  # noqa: PLC0415 - as above

    return wanted_tool(str(path) if path is not None else "<program>", **stated)


def expanded(program: "OpenProgram", **options: Any) -> Product:
    """A program in plain G-code, with options as for `expand`, or why there is none."""
    from contoursolve.api import expand  # noqa: PLC0415 - as above

    try:
        found = expand(program.text, control=program.control, name=program.name, **options)
    except ValueError as error:
        return Product(None, str(error))
    return _expansion(program, found.text, found.summary)


def expanded_beside_tool(program: "OpenProgram", path: Path | None, **stated: Any) -> Product:
    """A program along the path of a tool, without calls where it had some; or why there is none. The tool is stated as
    for `report_on_tool`."""
    from contoursolve.api import follow_options  # noqa: PLC0415 - as above
    from contoursolve.gcode import ANY_TEXT, file_in_memory  # noqa: PLC0415 - as above
    from contoursolve.output import rewrite_beside_tool  # noqa: PLC0415 - as above
    from contoursolve.postprocess import ExpansionOptions  # noqa: PLC0415 - as above
    from contoursolve.program import SolveOptions  # noqa: PLC0415 - as above

    source, wish = file_in_memory(program.text, program.name), ExpansionOptions(is_inline=True)
    asked = SolveOptions(control=program.control, units=program.unit)
    try:
        tool = _tool_of(path, **stated)
        found = rewrite_beside_tool(source, BytesIO(), wish, asked, tool, follow_options)
    except ValueError as error:
        return Product(None, str(error))
    is_whole = not (found.summary.left or found.summary.misread)
    text = b"".join(found.pieces()).decode(*ANY_TEXT) if is_whole else None
    return _expansion(program, text, found.summary)


def _expansion(program: "OpenProgram", text: str | None, summary: "Summary") -> Product:
    return _telling(text, summary, program.control.title if program.control else "", "expand")


def converted(program: "OpenProgram", control: str, settings: Mapping[str, str]) -> Product:
    """A program in the words of another control, with the settings of both, or why there is none."""
    from contoursolve.api import convert  # noqa: PLC0415 - as above

    try:
        found = convert(
            program.text, cast("ControlName", control), control=program.control, settings=settings, name=program.name
        )
    except ValueError as error:
        return Product(None, str(error))
    difference = found.comparison.difference if found.comparison else None
    if found.text is None:
        return Product(None, f"the new program is another path: {difference.reason}" if difference else "")
    told = [f"program line {each.line}: {each.sentence}" for each in found.not_converted]
    return replace(_listing(found.text, [*told, *found.notes], "convert"), not_converted=found.not_converted)


def _telling(text: str | None, summary: "Summary", target: str, command: str) -> Product:
    """A text with the reasons why contours were left as they are, the words that the target reads otherwise, and those
    that are numbers now; the command line lists all of them, too."""
    left = [f"program line {each.lines[0]}: {each.reason}" for each in summary.left]
    left += [f"program line {each.line}: {each.sentence(target)}" for each in summary.unfamiliar]
    left += [f"program line {each.line}: {each.sentence}" for each in summary.fixed]
    return _listing(text, left, command)


def _listing(text: str | None, left: "list[str]", command: str) -> Product:
    """A text with what is to be said of it, of which a message names the first."""
    more = len(left) - MOST_TOLD
    told = "; ".join(left[:MOST_TOLD])
    if more <= 0:
        return Product(text, told)
    return Product(text, f"{told}; and {more} more: contoursolve {command} lists all", "\n".join(left))


def page_about(program: "OpenProgram", tool: "ToolReport | str | None", version: str) -> Product:
    """A page of HTML about a program, with the report about its tool if there is one; or why there is none."""
    from contoursolve.output import report_page  # noqa: PLC0415 - as above
    from contoursolve.tool_radius import result_beside_tool  # noqa: PLC0415 - as above

    report = None if isinstance(tool, str) else tool
    program.check()
    try:
        result = program.result() if report is None else result_beside_tool(program.result(), report)
        if not result.answers:
            return Product(None, "the program has no contour block")
        return Product("".join(report_page(result, version, tool=report)))
    except (ValueError, ImportError) as error:
        return Product(None, str(error))


def notebook_about(program: "OpenProgram", line: int) -> Product:
    """A notebook that explores the contour on a line, or why there is none."""
    from contoursolve.notebook.standing_alone import standing_alone  # noqa: PLC0415 - as above

    answer, control = program.contour_at(line), program.control
    if answer is None or control is None:
        return Product(None, "there is no contour under the cursor")
    if not answer.start.is_known or answer.start.is_relative:
        return Product(None, "the start point of this contour is not known")
    options: dict[str, Any] = {
        "control": control.name,
        "units": answer.unit.value,
        "settings": dict(control.modes.settings),
    }
    text = standing_alone(answer)
    if not text:  # it rests on lines before it: they come along
        text, options = program.text, {"line": line, **options}
    told = "".join(f", {name}={value!r}" for name, value in options.items() if value)
    code = f"import contoursolve\n\ncontoursolve.explore({text!r}{told})"
    cell: dict[str, object] = {
        "cell_type": "code",
        "id": "contour",
        "metadata": {},
        "source": code,
        "outputs": [],
        "execution_count": None,
    }
    kernel = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    notebook = {"cells": [cell], "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}
    return Product(json.dumps(notebook, indent=1, ensure_ascii=False))
