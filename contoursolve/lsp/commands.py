"""Commands of a client beyond the protocol: pictures, the plain program, other controls, reports, notebooks."""

from collections.abc import Iterator, Mapping
from typing import Any

from lsprotocol import types

import contoursolve
from contoursolve.lsp.language_features import stretch, tool_beside
from contoursolve.lsp.opened import Opened
from contoursolve.notebook import Product, converted, expanded, notebook_about, page_about
from contoursolve.pictures import Theme, draw_answer

_NO_CONTOUR = "there is no contour under the cursor"
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
        for each in answer.words
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
    return _reply("text", None if opened is None else _unread(opened) or expanded(opened.program))


def convert_program(opened: Opened | None, control: str) -> Reply:
    """The program in the words of another control, or why there is none."""
    return _reply("text", converted(opened.program, control, opened.conventions) if opened else None)


def report_on(opened: Opened | None) -> Reply:
    """A page about the program, or why there is none."""
    if opened is None:
        return _reply("html", None)
    return _reply("html", _unread(opened) or page_about(opened.program, opened.tool(), contoursolve.__version__))


def notebook_of(opened: Opened | None, line: int) -> Reply:
    """A notebook that explores the contour on a line, which counts from 0, or why there is none."""
    return _reply("notebook", notebook_about(opened.program, line + 1) if opened else Product(None, _NO_CONTOUR))


def _unread(opened: Opened) -> Product | None:
    """The reason why nothing is made of a program whose control is not known; None where it is."""
    if opened.program.control is not None or not opened.troubles:
        return None
    return Product(None, "; ".join(opened.troubles))


def _reply(name: str, product: Product | None) -> Reply:
    """A product under its name, with its message; without one, the program is not open."""
    made = product or Product(None, NOT_OPEN)
    return {name: made.text, "message": made.message}


def file_of(opened: Opened | None, what: str, line: int) -> tuple[str, str | None]:
    """The name and the text of a file that shows a picture (`draw`), a notebook (`explore`) or the plain program
    (`expand`); or why there is none, and None."""
    if opened is None:
        return NOT_OPEN, None
    stem = (opened.path.stem if opened.path else "program").replace("/", "-")
    if what == "draw":
        answer = opened.program.contour_at(line + 1)
        if answer is None:
            return _NO_CONTOUR, None
        return f"{stem}-{line + 1}.svg", draw_answer(answer, beside=tool_beside(opened, answer)).svg
    if what == "explore":
        found = notebook_of(opened, line)
        return (f"{stem}-{line + 1}.ipynb", found["notebook"]) if found["notebook"] else (found["message"] or "", None)
    found = expand_program(opened)
    suffix = opened.path.suffix if opened.path else ".nc"
    return (f"{stem}-expanded{suffix}", found["text"]) if found["text"] else (found["message"] or "", None)
