"""The contours of a whole program in one table: a row for each element of each path."""

from collections.abc import Iterable, Iterator

from contoursolve.diagnosis import Answer, certificate_text, count, join, labels_of, list_solutions
from contoursolve.output.contours import later_texts, path_heads, path_table
from contoursolve.output.plain_text import printable
from contoursolve.output.premises import premise_texts
from contoursolve.program import Result
from contoursolve.reading import Premises, join_premises

_NAME = 32
"""Least columns for what an element is."""

_LONGEST = 100
"""Characters of a block that its row shows."""


def is_told_by_path(answer: Answer) -> bool:
    """Whether its path says all of a contour: one is there, no value was asked for, and nothing is left to choose."""
    if answer.contour is None or answer.asked or answer.filled:
        return False
    listing = list_solutions(answer)
    return listing is None or (listing.is_single and listing.is_closed)


class ProgramTable:
    """The rows of the contours of one program. It keeps what they rest on for the end."""

    def __init__(self, result: Result) -> None:
        self._result = result
        self._heads: tuple[str, ...] = ()
        self._end: tuple[float, float] | None = None
        self._premises = list[Premises]()

    def rows(self, answer: Answer) -> Iterator[str]:
        """The first block of a contour, its elements, and its start unless the contour before ends there."""
        contour = answer.contour
        if contour is None:
            return
        heads = path_heads(contour.plane, answer.unit)
        if heads != self._heads:
            yield self._row("line", "element", "move", heads)
            self._heads = heads
        yield f"{answer.lines[0]:>5}  {_title(answer)}"
        table = path_table(contour, answer.unit, labels_of(answer.profile))
        start, *elements = table.rows[len(contour.points) :]
        for name, move, *cells in elements if contour.start == self._end else (start, *elements):
            yield self._row("", name, move, cells)
        known = certificate_text(answer.certificate)
        yield from (
            f"{'':>5}  {text}" for text in (*later_texts(answer), *([f"certificate: {known}"] if known else []))
        )
        self._end = contour.elements[-1].end if contour.elements else contour.start
        self._premises.append(answer.premises)

    def interrupt(self) -> bool:
        """Name the columns and the start of the next contour again: something else stands between. Whether there are
        rows above."""
        has_rows = bool(self._heads)
        self._heads, self._end = (), None
        return has_rows

    def closing(self) -> Iterator[str]:
        """Say what the contours rest on besides their words, and which commands tell more."""
        if self.interrupt():
            yield ""
        control, name = self._result.control or "", self._result.program.name
        yield from premise_texts(join_premises(self._premises, control), control)
        named = f'"{name}"' if " " in name else name
        page = "" if name.startswith("<") else f"; contoursolve serve {named} opens a page"
        yield f"more: --full prints all of each contour{page}"

    def _row(self, line: str, name: str, move: str, cells: Iterable[str]) -> str:
        heads = self._heads or cells
        numbers = "".join(f"  {cell:>{max(9, len(head))}}" for cell, head in zip(cells, heads, strict=False))
        return f"{line:>5}  {name:<{_NAME}} {move:<4}{numbers}".rstrip()


def _title(answer: Answer) -> str:
    """The first block of a contour, how many follow, and from where they are called."""
    blocks = [printable(block.text.strip()) for block in answer.profile.blocks]
    text = blocks[0] if len(blocks[0]) <= _LONGEST else f"{blocks[0][: _LONGEST - 3]}..."
    more = f", and {count(len(blocks) - 1, 'more block')}" if len(blocks) > 1 else ""
    called = f", called in line {join([str(each) for each in answer.calls])}" if answer.calls else ""
    return f"{text}{more}{called}"
