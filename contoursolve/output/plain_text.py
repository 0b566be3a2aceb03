"""Plain text in columns, safe for any terminal."""

import re
import unicodedata
from collections.abc import Sequence

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
    """Rows under a caption, as every format shows them; the columns named in `left` are texts, the others numbers."""

    caption: str
    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    left: Sequence[int] = (0,)
    names: Sequence[Name] = ()
    """Names of items of a picture that each row shows; empty if rows show none."""

    def lines(self, indent: str = "  ", *, is_headed: bool = True) -> list[str]:
        """The rows as lines, below the header unless they explain themselves; nothing for no row."""
        rows = [self.header, *self.rows] if is_headed else self.rows
        return columns(rows, self.left, indent) if rows else []

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
