"""Language features at the cursor: hovers, hints, completions, signatures, symbols, folds."""

import re
from base64 import b64encode
from collections.abc import Iterator, Sequence

from lsprotocol import types

from contoursolve import (
    CONTROLS,
    Answer,
    Block,
    Control,
    Status,
    Word,
)
from contoursolve.diagnosis import StatedWord, called_in_program
from contoursolve.lsp.opened import Opened
from contoursolve.output import beside_of, equations_of, path_of
from contoursolve.pictures import ToolDrawing, draw_answer
from contoursolve.reading import LegalBlock

WIDE = 420
"""Pixels of a picture in a hover."""

_LEGAL: dict[object, tuple[LegalBlock, ...]] = {}
"""The legal blocks of the controls that were asked for, by their names and settings."""

_LONGEST_WORD = 40
_BLOCK_BEGUN = re.compile(r"\s*+/?+\s*+(?>(?:[Nn]\d++)?)\s*+(?P<code>(?>(?:[Gg]\d*+)?))\Z", re.ASCII)
"""A line that has no more than its number, and the beginning of a G code."""


def hover_of(opened: Opened, position: types.Position) -> types.Hover | None:
    """The meaning of the word under the cursor and the points it fixes, or the whole contour; None elsewhere."""
    line, column = opened.places.place(position)
    is_known = opened.program.is_examined(line, line)
    answer, block = opened.program.contour_at(line) if is_known else None, _block(opened, line)
    word = next((each for each in block.words if each.span.column <= column < each.span.end_column), None)
    if answer is not None:
        ran = next((each for each in answer.claim.blocks if each.line == line), block)
        here = {ran.typed_span(each.word.span): each for each in answer.words if each.word.span.line == line}
        stated = here.get(word.span) if word is not None else None
        if stated is not None and word is not None:
            return _hover(opened, _with_tool(opened, _about_word(stated, answer), line), word)
        is_drawn = opened.options.has_pictures and opened.reads_markdown
        text = _about_contour(answer, is_drawn=is_drawn, beside=tool_beside(opened, answer))
        return _shown(opened, _with_tool(opened, text, line), _lines_of(opened, line))
    text = _about_plain_word(opened, word) if word is not None else ""
    if text and not is_known:
        done, lines = opened.program.examined, len(opened.program.blocks)
        text += f"\n\nThe contours here are not known yet: {done} of {lines} lines are examined."
    return _hover(opened, text, word) if text and word is not None else None


def tool_beside(opened: Opened, answer: Answer) -> Sequence[ToolDrawing]:
    """The drawing of the tool beside a contour."""
    tool = opened.tool()
    return beside_of(None if isinstance(tool, str) else tool, answer)


def _with_tool(opened: Opened, text: str, line: int) -> str:
    """A text, and which tool cuts the contour on a line."""
    tool = opened.tool()
    told = tool if isinstance(tool, str) or tool is None else tool.text(line)
    return f"{text}\n\nTool: {_plain(told)}." if told else text


def _hover(opened: Opened, text: str, word: Word) -> types.Hover:
    return _shown(opened, text, opened.places.range(*stretch(word)))


def _shown(opened: Opened, text: str, where: types.Range) -> types.Hover:
    """A text of Markdown, or the same plainly for a client that reads none."""
    if opened.reads_markdown:
        return types.Hover(types.MarkupContent(types.MarkupKind.Markdown, text), where)
    plain = re.sub(r"\\([\\`*_{}\[\]<>#|!])|\*\*", r"\1", text)
    return types.Hover(types.MarkupContent(types.MarkupKind.PlainText, plain), where)


def stretch(word: Word) -> tuple[int, int, int]:
    """The place of a word without the blanks around it."""
    begin = word.span.column + len(word.text) - len(word.text.lstrip())
    return word.span.line, begin, begin + len(word.text.strip())


def _about_word(stated: StatedWord, answer: Answer) -> str:
    value = "" if stated.value is None else f"{stated.value:.5f}".rstrip("0").rstrip(".")
    lines = [f"**{_plain(stated.word.text)}** {called_in_program(answer.profile)(stated.meaning)}"]
    if value:
        lines.append(f"{value} {stated.unit}".strip() + _in_mm(stated))
    if stated.is_ignored:
        lines.append("The control ignores it here.")
    if stated.fixes:
        lines.append(f"fixes {', '.join(_with_place(name, answer) for name in stated.fixes)}")
    equations, conditions = equations_of(answer, stated.word)
    lines += [f"`{each}`" for each in equations]
    lines += [f"{_plain(text)}: `{formula}` {here}" for text, formula, here in conditions]
    return "\n\n".join(lines)


def _in_mm(stated: StatedWord) -> str:
    return f" = {(stated.value or 0) * 25.4:.4f} mm" if stated.unit == "in" else ""


def _with_place(name: str, answer: Answer) -> str:
    """A point with its coordinates; an element or a corner with the place where it ends."""
    if answer.contour is None:
        return called_in_program(answer.profile)(name)
    table = path_of(answer, answer.contour)
    rows = {name: row for (_, name), row in zip(table.names, table.rows, strict=True)}
    if name not in rows:
        return called_in_program(answer.profile)(name)
    axes = answer.plane.axes
    place = " ".join(f"{axis}{text}" for axis, text in zip(axes, rows[name][2:4], strict=True))
    told = rows[name][0]
    return f"{told}: {place}" if name in answer.contour.points else f"{told}, which ends at {place}"


def _about_plain_word(opened: Opened, word: Word) -> str:
    control = opened.program.control
    if control is None:
        return ""
    if word.address == "G" and word.number is not None and word.number % 1 == 0:
        code = control.modes.codes.get(int(word.number))
        return f"**{_plain(word.text)}** {code.meaning}" if code and code.meaning else ""
    row = control.modes.lexicon.addresses.get(word.address)
    return f"**{_plain(word.text)}** {row.meaning}" if row else ""


def _about_contour(answer: Answer, *, is_drawn: bool, beside: Sequence[ToolDrawing] = ()) -> str:
    end = answer.end_text
    lines = [f"**{_plain(answer.form_text)}**: {answer.state}" + (f", ends at {end}" if end else "")]
    if is_drawn:
        lines.append(f"![the contour]({image_of(answer, beside)})")
    if answer.contour is not None:
        table = path_of(answer, answer.contour)
        shown = [[*row[:4]] for row in table.rows]
        head = ["element", "move", *table.header[2:4]]
        lines.append("\n".join("| " + " | ".join(row) + " |" for row in (head, ["---"] * 4, *shown)))
    return "\n\n".join(lines)


def image_of(answer: Answer, beside: Sequence[ToolDrawing] = ()) -> str:
    """A small picture of a contour, as an address that holds all of it."""
    picture = draw_answer(answer, beside=beside)
    scale = WIDE / picture.width
    size = f'width="{WIDE}" height="{picture.height * scale:.0f}" '
    svg = re.sub(r'width="[\d.]+" height="[\d.]+" ', size, picture.svg, count=1)
    return f"data:image/svg+xml;base64,{b64encode(svg.encode()).decode()}"


def _plain(text: str) -> str:
    """A text of the program in Markdown."""
    return re.sub(r"([\\`*_{}\[\]<>#|!])", r"\\\1", text.strip())


def _block(opened: Opened, line: int) -> Block:
    blocks = opened.program.blocks
    return blocks[min(max(line, 1), len(blocks)) - 1]


def _lines_of(opened: Opened, line: int) -> types.Range:
    contour = next((each for each in opened.program.contours if each.first <= line <= each.last), None)
    return opened.places.whole(contour.first, contour.last) if contour else opened.places.whole(line, line)


def hints_of(opened: Opened, wanted: types.Range) -> Iterator[types.InlayHint]:
    """The end point behind each solved contour."""
    for contour in opened.program.contours:
        end = contour.answer.end_text
        if end and wanted.start.line <= contour.last - 1 <= wanted.end.line:
            at = opened.places.position(contour.last, len(opened.places.text(contour.last)) + 1)
            yield types.InlayHint(at, f"ends at {end}", padding_left=True)


# Completions -------------------------------------------------------------------------------------------------


class Completer:
    """Completions at one place."""

    def __init__(self, opened: Opened, position: types.Position, *, has_snippets: bool) -> None:
        self.opened, self.has_snippets = opened, has_snippets
        self.line, self.column = opened.places.place(position)
        self.before = opened.places.text(self.line)[: self.column - 1]
        self.begin = self.column
        """Where what is completed begins."""

    def items(self) -> Iterator[types.CompletionItem]:
        """Words of the contour there, or examples of blocks."""
        control, answer = self.opened.program.control, self.opened.program.contour_at(self.line)
        near, begun = self.before[-_LONGEST_WORD:], _BLOCK_BEGUN.match(self.before)
        letters = re.search(r"[#,]?[A-Za-z]*\Z", near)
        typed = letters[0] if letters else ""
        if is_in_comment(self.opened, self.line, self.column):
            return
        if control is not None and answer is not None:
            # Behind a digit begins no word, unless its letter is there.
            if typed or not near or near[-1].isspace():
                self.begin = self.column - len(typed)
                yield from self._words(answer)
        elif begun is not None:
            self.begin = begun.start("code") + 1
            for each in CONTROLS.values() if control is None else (control,):
                yield from self._blocks(each)

    def _words(self, answer: Answer) -> Iterator[types.CompletionItem]:
        found = [each for each in answer.addable if each.line == self.line]
        for number, each in enumerate(sorted(found, key=lambda each: each.contour is None)):
            detail = "fixed by the other words" if each.contour is not None else ""
            yield self._item(each.text, each.text.replace("?", "${1}"), each.meaning, detail, each.address, number)

    def _blocks(self, control: Control) -> Iterator[types.CompletionItem]:
        key = control.name, *sorted(control.modes.settings.items())
        if key not in _LEGAL:
            _LEGAL[key] = control.examples
        for number, each in enumerate(_LEGAL[key]):
            title = f"{control.name}: {each.title}" if self.opened.program.control is None else each.title
            yield self._item(each.text.replace("\n", " / "), _snippet(each.text), title, "", each.text, number)

    def _item(
        self, label: str, snippet: str, detail: str, documentation: str, filter_: str, number: int
    ) -> types.CompletionItem:
        plain = re.sub(r"\$\{\d+:?([^}]*)\}", r"\1", snippet)
        return types.CompletionItem(
            label,
            kind=types.CompletionItemKind.Snippet if "\n" in plain or " " in plain else types.CompletionItemKind.Field,
            detail=detail,
            documentation=documentation or None,
            filter_text=filter_,
            sort_text=f"{number:03}",
            insert_text_format=types.InsertTextFormat.Snippet
            if self.has_snippets
            else types.InsertTextFormat.PlainText,
            text_edit=types.TextEdit(
                self.opened.places.range(self.line, self.begin, self.column), snippet if self.has_snippets else plain
            ),
        )


def _snippet(text: str) -> str:
    """A block whose numbers are stops, each with its value."""
    count = iter(range(1, 1_000))
    return re.sub(
        r"(?<=[A-Z=(])(-?\d*\.?\d+\.?)",
        lambda number: f"${{{next(count)}:{number[0]}}}" if not _is_code(text, number.start()) else number[0],
        text,
    )


def _is_code(text: str, at: int) -> bool:
    return text[at - 1] == "G"


def signatures_of(opened: Opened, position: types.Position) -> types.SignatureHelp | None:
    """The sets of words that complete the block under the cursor, and what each of them means."""
    line, _ = opened.places.place(position)
    answer, control = opened.program.contour_at(line), opened.program.control
    if answer is None or control is None:
        return None
    stated = " ".join(each.word.text.strip() for each in answer.words if each.word.span.line == line)
    additions = {each.address: each.meaning for each in answer.addable}
    ways: Sequence[tuple[str, ...]] = answer.missing
    if not ways and answer.status is Status.SOLVED and additions:
        ways = [tuple(additions)]
    found = []
    for way in ways:
        label = " ".join((stated, *way))
        begins, at = [], len(stated) + 1
        for address in way:
            begins.append((at, at + len(address)))
            at += len(address) + 1
        found.append(
            types.SignatureInformation(
                label,
                "may also stand here" if answer.status is Status.SOLVED else "completes the block",
                [
                    types.ParameterInformation(place, additions.get(address, ""))
                    for place, address in zip(begins, way, strict=True)
                ],
            )
        )
    return types.SignatureHelp(found, 0, 0) if found else None


# The program's outline ---------------------------------------------------------------------------------------


def symbols_of(opened: Opened) -> Iterator[types.DocumentSymbol]:
    """The contours, each with its status and its end."""
    for contour in opened.program.contours:
        answer, end = contour.answer, contour.answer.end_text
        yield types.DocumentSymbol(
            name=f"{answer.claim.form.name}, program line {contour.first}",
            detail=f"{answer.state}{f', ends at {end}' if end else ''}",
            kind=types.SymbolKind.Function if answer.status is Status.SOLVED else types.SymbolKind.Event,
            range=opened.places.whole(contour.first, contour.last),
            selection_range=opened.places.whole(contour.first, contour.first),
        )


def is_in_comment(opened: Opened, line: int, column: int) -> bool:
    """Whether a place is within a comment, as the control has them."""
    text, at = opened.places.text(line), column - 1
    found = (match for match in _comment(opened).finditer(text) if match.start() < at <= match.end())
    return any(at < match.end() or not match[0].endswith(")") for match in found)


def _is_comment(opened: Opened, line: int) -> bool:
    """Whether a line is nothing but comments."""
    text = opened.places.text(line)
    return ("(" in text or ";" in text) and not _comment(opened).sub("", text).strip()


def _comment(opened: Opened) -> re.Pattern[str]:
    return opened.program.syntax.comment


def folds_of(opened: Opened) -> Iterator[types.FoldingRange]:
    """Contours of several lines, and comments."""
    for contour in opened.program.contours:
        if contour.last > contour.first:
            yield types.FoldingRange(contour.first - 1, contour.last - 1, kind=types.FoldingRangeKind.Region)
    first, lines = 0, len(opened.program.blocks)
    for line in range(1, lines + 2):
        is_comment = line <= lines and _is_comment(opened, line)
        if is_comment and not first:
            first = line
        elif not is_comment and first:
            if line - 1 > first:
                yield types.FoldingRange(first - 1, line - 2, kind=types.FoldingRangeKind.Comment)
            first = 0
