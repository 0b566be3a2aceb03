"""Products of an open program: plain G-code, another control's words, a page, a notebook; and what is stated beside it.

An editor's server and the workbench offer the same ones. What a product needs is imported when it is made.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct

if TYPE_CHECKING:
    from contoursolve.postprocess import Conversion, Expansion
    from contoursolve.program import OpenProgram, Result
    from contoursolve.tool_radius import ToolReport

MOST_TOLD = 3
"""Things that were left as they are that a message names."""

_LONGEST = 5_000
"""Lines of a program that is solved again for its tool while somebody waits."""


class Product(Struct, frozen=True):
    """A text that was made of a program, and what is to be said of it; without a text, why there is none."""

    text: str | None
    message: str = ""


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
    from contoursolve.api import solve_with_tool  # noqa: PLC0415 - as above
    from contoursolve.program import find_tool_table  # noqa: PLC0415 - as above

    is_stated = "contoursolve tool" in program.text
    try:
        has_table = path is not None and find_tool_table(path.parent)
        if program.dialect is None or not (is_stated or has_table) or len(program.blocks) > _LONGEST:
            return None
        name = str(path) if path is not None else "<program>"
        return solve_with_tool(program.text, name=name, control=program.dialect, depth="verdict")[1]
    except (OSError, ValueError) as error:
        return str(error) if is_stated else None


def expanded(program: "OpenProgram", **options: Any) -> Product:
    """A program in plain G-code, with options as for `expand`, or why there is none."""
    from contoursolve.api import expand  # noqa: PLC0415 - as above

    try:
        found = expand(program.text, control=program.dialect, name=program.name, **options)
    except ValueError as error:
        return Product(None, str(error))
    return Product(found.text, _what_was_left(found, program.dialect.title if program.dialect else ""))


def converted(program: "OpenProgram", control: str, settings: Mapping[str, str]) -> Product:
    """A program in the words of another control, with the settings of both, or why there is none."""
    from contoursolve.api import convert  # noqa: PLC0415 - as above
    from contoursolve.controls import DIALECTS  # noqa: PLC0415 - as above

    try:
        found = convert(program.text, control, control=program.dialect, settings=settings, name=program.name)
    except ValueError as error:
        return Product(None, str(error))
    difference = found.comparison.difference if found.comparison else None
    if difference is not None:
        return Product(found.text, f"the new program is another path: {difference.reason}")
    return Product(found.text, _what_was_left(found, DIALECTS[control].title))


def _what_was_left(found: "Expansion | Conversion", target: str) -> str:
    """Reasons why contours were left as they are, and words that the target reads otherwise; empty without any."""
    left = [f"program line {each.lines[0]}: {each.reason}" for each in found.summary.left]
    left += [f"program line {each.line}: {each.sentence(target)}" for each in found.summary.unfamiliar]
    return "; ".join(left[:MOST_TOLD]) + (f"; and {len(left) - MOST_TOLD} more" if len(left) > MOST_TOLD else "")


def solved(program: "OpenProgram", name: str, tool: "ToolReport | str | None") -> "tuple[Result, ToolReport | None]":
    """A program solved as a whole; if there is a report about its tool, with that, as a program of another name. Raises
    as `solve`."""
    from contoursolve.api import solve, solve_with_tool  # noqa: PLC0415 - as above

    if tool is None or isinstance(tool, str):
        return solve(program.text, control=program.dialect, name=program.name), None
    return solve_with_tool(program.text, control=program.dialect, name=name)


def page_about(program: "OpenProgram", name: str, tool: "ToolReport | str | None", version: str) -> Product:
    """A page of HTML about a program, or why there is none."""
    from contoursolve.output import report_page  # noqa: PLC0415 - as above

    try:
        result, report = solved(program, name, tool)
        if not result.answers:
            return Product(None, "the program has no contour block")
        return Product("".join(report_page(result, version, tool=report)))
    except (ValueError, ImportError) as error:
        return Product(None, str(error))


def notebook_about(program: "OpenProgram", line: int) -> Product:
    """A notebook that explores the contour on a line, or why there is none."""
    from contoursolve.notebook.standing_alone import standing_alone  # noqa: PLC0415 - as above

    answer, dialect = program.contour_at(line), program.dialect
    if answer is None or dialect is None:
        return Product(None, "there is no contour under the cursor")
    if not answer.start.is_known:
        return Product(None, "the start point of this contour is not known")
    options: dict[str, Any] = {
        "control": dialect.name,
        "units": answer.unit.value,
        "settings": dict(dialect.modes.settings),
    }
    text = standing_alone(answer, control=dialect, units=answer.unit.value, settings=dialect.modes.settings)
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
