"""Plain text in columns, safe for any terminal."""

import re
import unicodedata
from collections.abc import Iterator, Sequence
from typing import Any

from msgspec import Struct
from msgspec.structs import replace


def columns(rows: Sequence[Sequence[str]], left: Sequence[int] = (0,), indent: str = "  ") -> list[str]:
    """Lines with aligned cells, two blanks apart; the columns named in `left` are aligned left."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    template = indent + "  ".join(f"%{'-' if number in left else ''}{width}s" for number, width in enumerate(widths))
    return [(template % tuple(row)).rstrip() for row in rows]


def printable(text: str) -> str:
    """The text with tabs as blanks and other control characters as dots: as many characters as before."""
    return text if text.isprintable() else "".join(c if c.isprintable() else (" " if c == "\t" else ".") for c in text)


def cells(text: str, begin: int, end: int) -> int:
    """The columns of a terminal that characters of a printable text take, from a place on to before another one, which
    may be behind its end: two for those of East Asia, none for accents that stand above another character."""
    stretch = text[max(begin, 0) : max(end, 0)]
    return max(end, 0) - max(begin, 0) + (0 if stretch.isascii() else sum(map(_surplus, stretch)))


def _surplus(char: str) -> int:
    """Columns that a character takes beyond one: 1, 0 or -1."""
    if unicodedata.east_asian_width(char) in "WF":
        return 1
    return -1 if unicodedata.category(char) in ("Mn", "Me") else 0


def harmless(text: str) -> str:
    """The text without lines that GitHub's runner would take for commands to it: names of files and blocks may begin
    with `::`."""
    return _COMMAND.sub(r"\g<blank>\\::", text) if "::" in text else text


_COMMAND = re.compile(r"^(?P<blank>[^\S\n]*+)::", re.MULTILINE)


Name = tuple[str, str]
"""A kind (`word`, `point`, `element`, `finding`) and a name of that kind, as pictures write it; `("", "")` for none."""

NAMELESS: Name = ("", "")


class Table(Struct, frozen=True):
    """Rows under a caption, as every format shows them; the columns named in `left` are texts, the others numbers. A
    cell is a text, or has one and is HTML by itself."""

    caption: str
    header: Sequence[str]
    rows: Sequence[Sequence[Any]]
    left: Sequence[int] = (0,)
    names: Sequence[Name] = ()
    """Names of items of a picture that each row shows; empty if rows show none."""

    is_headed: bool = True
    """Whether lines have the header: not if the rows explain themselves."""

    is_listed: bool = False
    """Whether lines have a paragraph for each row, because its cells are long."""

    def lines(self, indent: str = "  ") -> list[str]:
        """The rows as lines; nothing for no row."""
        if self.is_listed:
            return [f"{indent}{line}" for line in self._paragraphs()]
        rows = [self.header, *self.rows] if self.is_headed else self.rows
        texts = [[cell if isinstance(cell, str) else cell.text for cell in row] for row in rows]
        return columns(texts, self.left, indent) if self.rows else []

    def _paragraphs(self) -> Iterator[str]:
        """Each row with its number: the first two cells on a line, every other one below it."""
        for number, (first, second, *rest) in enumerate(self.rows, 1):
            yield f"{number}. {self.header[0]} {first}: {second}"
            yield from (f"   {line}" for cell in filter(None, rest) for line in cell.split("\n"))

    def without_empty(self) -> "Table":
        """The same without columns that say nothing."""
        kept = [place for place in range(len(self.header)) if any(row[place] for row in self.rows)]
        rows = [[row[place] for place in kept] for row in self.rows]
        left = [number for number, place in enumerate(kept) if place in self.left]
        return replace(self, header=[self.header[place] for place in kept], rows=rows, left=left)

    @property
    def numbers(self) -> list[int]:
        """The columns that are numbers."""
        return [place for place in range(len(self.header)) if place not in self.left]


class Excerpt(Struct, frozen=True):
    """Lines as they stand somewhere, such as blocks of a program, below what they are."""

    title: str
    text: str


class Folded(Struct, frozen=True):
    """A paragraph or tables that a page shows to those who open them, behind what they are."""

    title: str
    parts: Sequence[str | Table]


class RecordView(Struct, frozen=True):
    """A record in words, as every format shows it: a title, then everything else in its order. Lines have the captions
    of tables where no title says what they are; an empty text is an empty line."""

    title: str
    parts: Sequence[str | Table | Excerpt | Folded]
    picture: Any = None
    """A record whose picture stands above it on a page."""

    def lines(self) -> Iterator[str]:
        """The lines of a text."""
        if self.title:
            yield self.title
        is_first = True
        for title, part in self._flat():
            if isinstance(part, str):
                yield f"  {title}{part}" if part else ""
            elif isinstance(part, Excerpt):
                yield from ("", f"  {part.title}:", *(f"    {line}" for line in part.text.split("\n")))
            elif self.title:
                yield from part.lines()
            elif part.rows:
                head = [f"  {part.caption[0].lower()}{part.caption[1:]}:", *part.lines("    ")]
                yield from head if is_first else ("", *head)
            is_first = False

    def _flat(self) -> Iterator[tuple[str, str | Table | Excerpt]]:
        """The parts, and what stands before a text that a page folds."""
        for part in self.parts:
            if isinstance(part, Folded):
                yield from ((f"{part.title}: ", each) for each in part.parts)
            else:
                yield "", part
