"""What a client asks for beyond the protocol: pictures, the plain program, other controls, reports, notebooks."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from lsprotocol import types

import contoursolve
from contoursolve import Conversion, Expansion, OpenContour, start_text, stated_words
from contoursolve.lsp.opened import Opened
from contoursolve.pictures import Theme, draw_answer

NOT_OPEN = "the program is not open in this editor"
Reply = Mapping[str, str | None]

_LENSES = (("draw", "drawBeside"), ("explore", "exploreContour"), ("expand", "expandProgram"))
"""What stands above a contour, and the client's own command for it."""


def lenses(uri: str, contour: OpenContour, *, of_client: bool) -> Iterator[tuple[str, str, list[Any]]]:
    """The titles of commands about a contour, their names and arguments."""
    for title, own in _LENSES:
        if of_client:
            arguments = [uri] if title == "expand" else [uri, contour.first - 1]
            yield title, f"contoursolve.{own}", arguments
        else:
            yield title, "contoursolve.show", [title, uri, contour.first - 1]


def picture_of(opened: Opened, position: types.Position) -> Any:
    """The contour under the cursor: its picture, and where its words are; None where there is none."""
    line, _ = opened.places.place(position)
    answer = opened.program.contour_at(line)
    if answer is None:
        return None
    picture = draw_answer(answer, theme=Theme.PAGE)
    words = [
        {
            "key": each.key,
            "text": each.word.text.strip(),
            "range": opened.places.range(
                each.word.span.line,
                each.word.span.column + len(each.word.text) - len(each.word.text.lstrip()),
                each.word.span.end_column,
            ),
        }
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
    try:
        found = contoursolve.expand(program.text, control=program.dialect, name=program.name)
    except ValueError as error:
        return {"text": None, "message": str(error)}
    return {"text": found.text, "message": _what_was_left(found)}


def convert_program(opened: Opened | None, control: str) -> Reply:
    """The program in the words of another control, or why there is none."""
    if opened is None:
        return {"text": None, "message": NOT_OPEN}
    program = opened.program
    try:
        found = contoursolve.convert(program.text, control, control=program.dialect, name=program.name)
    except ValueError as error:
        return {"text": None, "message": str(error)}
    message = _what_was_left(found)
    difference = found.comparison.difference if found.comparison else None
    if difference is not None:
        message = f"the new program is another path: {difference.reason}"
    return {"text": found.text, "message": message}


def _what_was_left(found: Expansion | Conversion) -> str:
    """Why contours were left as they are; empty if none was."""
    left = [f"line {each.lines[0]}: {each.reason}" for each in found.summary.left]
    return "; ".join(left[:3]) + (f"; and {len(left) - 3} more" if len(left) > 3 else "")  # noqa: PLR2004 - a message


def report_on(opened: Opened | None) -> Reply:
    """A page about the program, or why there is none."""
    if opened is None:
        return {"html": None, "message": NOT_OPEN}
    program = opened.program
    try:
        result = contoursolve.solve(program.text, control=program.dialect, name=program.name)
        if not result.answers:
            return {"html": None, "message": "the program has no contour block"}
        page = contoursolve.report_page(result, contoursolve.__version__)
    except (ValueError, ImportError) as error:
        return {"html": None, "message": str(error)}
    return {"html": "".join(page), "message": ""}


def notebook_of(opened: Opened | None, line: int) -> Reply:
    """A notebook that explores the contour on a line, or why there is none."""
    answer = opened.program.contour_at(line) if opened is not None else None
    if opened is None or answer is None or opened.program.dialect is None:
        return {"notebook": None, "message": "there is no contour under the cursor"}
    if not answer.start.is_known:
        return {"notebook": None, "message": "the start point of this contour is not known"}
    dialect, texts = opened.program.dialect, [block.text.strip() for block in answer.claim.blocks]
    options = {"start": start_text(answer), "control": dialect.name, "settings": dict(dialect.modes.settings)}
    told = "".join(f", {name}={value!r}" for name, value in options.items() if value)
    code = f"import contoursolve\n\ncontoursolve.explore({chr(10).join(texts)!r}{told})"
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
        answer = opened.program.contour_at(line)
        if answer is None:
            return "there is no contour under the cursor", None
        return f"{stem}-{line}.svg", draw_answer(answer).svg
    if what == "explore":
        found = notebook_of(opened, line)
        return (f"{stem}-{line}.ipynb", found["notebook"]) if found["notebook"] else (found["message"] or "", None)
    found = expand_program(opened)
    suffix = opened.path.suffix if opened.path else ".nc"
    return (f"{stem}-expanded{suffix}", found["text"]) if found["text"] else (found["message"] or "", None)
