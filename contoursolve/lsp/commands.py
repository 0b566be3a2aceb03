"""Commands of a client beyond the protocol: pictures, the plain program, other controls, reports, notebooks."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from lsprotocol import types

import contoursolve
from contoursolve import Conversion, Expansion, standing_alone, stated_words
from contoursolve.lsp.language_features import stretch, tool_beside
from contoursolve.lsp.opened import Opened
from contoursolve.pictures import Theme, draw_answer

MOST_TOLD = 3
NOT_OPEN = "the program is not open in this editor"
Reply = Mapping[str, str | None]

_LENSES = (("draw", "drawBeside"), ("explore", "exploreContour"), ("expand", "expandProgram"))
"""Lenses above a contour, each with the client's own command for it."""


def lenses_of(opened: Opened, *, of_client: bool) -> Iterator[types.CodeLens]:
    """Above each contour, what can be done with it: by the client's own commands, or by the server's."""
    for contour in opened.program.contours:
        place, line = opened.places.whole(contour.first, contour.first), contour.first - 1
        for title, own in _LENSES:
            if of_client:
                arguments = [opened.uri] if title == "expand" else [opened.uri, line]
                command = types.Command(title, f"contoursolve.{own}", arguments=arguments)
            else:
                command = types.Command(title, "contoursolve.show", arguments=[title, opened.uri, line])
            yield types.CodeLens(place, command)


def picture_of(opened: Opened, position: types.Position) -> Any:
    """The contour under the cursor: its picture, and where its words are; None where there is none."""
    line, _ = opened.places.place(position)
    answer = opened.program.contour_at(line)
    if answer is None:
        return None
    picture = draw_answer(answer, theme=Theme.PAGE, beside=tool_beside(opened, answer))
    words = [
        {"key": each.key, "text": each.word.text.strip(), "range": opened.places.range(*stretch(each.word))}
        for each in stated_words(answer)
    ]
    return {
        "uri": opened.uri,
        "version": opened.version,
        "title": picture.title,
        "description": picture.description,
        "svg": picture.svg,
        "range": opened.places.whole(answer.lines[0], answer.lines[-1]),
        "words": words,
        "findings": [f"{each.severity.value}: {each.message}" for each in answer.diagnostics],
    }


def expand_program(opened: Opened | None) -> Reply:
    """The program in plain G-code, or why there is none."""
    if opened is None:
        return {"text": None, "message": NOT_OPEN}
    program = opened.program
    if program.dialect is None and opened.troubles:
        return {"text": None, "message": "; ".join(opened.troubles)}
    try:
        found = contoursolve.expand(program.text, control=program.dialect, name=program.name)
    except ValueError as error:
        return {"text": None, "message": str(error)}
    return {"text": found.text, "message": _what_was_left(found, program.dialect.title if program.dialect else "")}


def convert_program(opened: Opened | None, control: str) -> Reply:
    """The program in the words of another control, or why there is none."""
    if opened is None:
        return {"text": None, "message": NOT_OPEN}
    program = opened.program
    try:
        settings = opened.conventions
        found = contoursolve.convert(
            program.text, control, control=program.dialect, settings=settings, name=program.name
        )
    except ValueError as error:
        return {"text": None, "message": str(error)}
    message = _what_was_left(found, contoursolve.DIALECTS[control].title)
    difference = found.comparison.difference if found.comparison else None
    if difference is not None:
        message = f"the new program is another path: {difference.reason}"
    return {"text": found.text, "message": message}


def _what_was_left(found: Expansion | Conversion, target: str) -> str:
    """Reasons why contours were left as they are, and words that the target reads otherwise; empty without any."""
    left = [f"program line {each.lines[0]}: {each.reason}" for each in found.summary.left]
    left += [f"program line {each.line}: {each.sentence(target)}" for each in found.summary.unfamiliar]
    return "; ".join(left[:MOST_TOLD]) + (f"; and {len(left) - MOST_TOLD} more" if len(left) > MOST_TOLD else "")


def report_on(opened: Opened | None) -> Reply:
    """A page about the program, or why there is none."""
    if opened is None:
        return {"html": None, "message": NOT_OPEN}
    program = opened.program
    if program.dialect is None and opened.troubles:
        return {"html": None, "message": "; ".join(opened.troubles)}
    try:
        result, tool = contoursolve.solve(program.text, control=program.dialect, name=program.name), None
        if isinstance(opened.tool(), contoursolve.ToolReport):
            name = str(opened.path or program.name)
            result, tool = contoursolve.solve_with_tool(program.text, control=program.dialect, name=name)
        if not result.answers:
            return {"html": None, "message": "the program has no contour block"}
        page = contoursolve.report_page(result, contoursolve.__version__, tool=tool)
    except (ValueError, ImportError) as error:
        return {"html": None, "message": str(error)}
    return {"html": "".join(page), "message": ""}


def notebook_of(opened: Opened | None, line: int) -> Reply:
    """A notebook that explores the contour on a line, which counts from 0, or why there is none."""
    answer = opened.program.contour_at(line + 1) if opened is not None else None
    if opened is None or answer is None or opened.program.dialect is None:
        return {"notebook": None, "message": "there is no contour under the cursor"}
    if not answer.start.is_known:
        return {"notebook": None, "message": "the start point of this contour is not known"}
    dialect = opened.program.dialect
    options: dict[str, Any] = {
        "control": dialect.name,
        "units": answer.unit.value,
        "settings": dict(dialect.modes.settings),
    }
    text = standing_alone(answer, control=dialect, units=answer.unit.value, settings=dialect.modes.settings)
    if not text:  # it rests on lines before it: they come along
        text, options = opened.program.text, {"line": line + 1, **options}
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
    return {"notebook": json.dumps(notebook, indent=1, ensure_ascii=False), "message": ""}


def file_of(opened: Opened | None, what: str, line: int) -> tuple[str, str | None]:
    """The name and the text of a file that shows a picture (`draw`), a notebook (`explore`) or the plain program
    (`expand`); or why there is none, and None."""
    if opened is None:
        return NOT_OPEN, None
    stem = (opened.path.stem if opened.path else "program").replace("/", "-")
    if what == "draw":
        answer = opened.program.contour_at(line + 1)
        if answer is None:
            return "there is no contour under the cursor", None
        return f"{stem}-{line + 1}.svg", draw_answer(answer, beside=tool_beside(opened, answer)).svg
    if what == "explore":
        found = notebook_of(opened, line)
        return (f"{stem}-{line + 1}.ipynb", found["notebook"]) if found["notebook"] else (found["message"] or "", None)
    found = expand_program(opened)
    suffix = opened.path.suffix if opened.path else ".nc"
    return (f"{stem}-expanded{suffix}", found["text"]) if found["text"] else (found["message"] or "", None)
