"""The lines of a program on their way through an expansion: read into blocks, and their ends kept."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from contoursolve.dialects import DIALECTS, Dialect
from contoursolve.pipeline import UnknownControlError
from contoursolve.reading import plain_lines
from contoursolve.syntax import Block, Directive, PlainLine, parse_block


_USUAL = "\n"
"""How a line ends of which nothing else is noted."""


class Lines:
    """The lines of a program as blocks; how each of them ends is kept until it is asked for."""

    def __init__(
        self, lines: Iterable[str], dialect: Dialect, facts: Mapping[int, tuple[Directive, ...]], *, is_certain: bool
    ) -> None:
        self._lines = lines
        self._facts = facts
        self._plain = plain_lines(dialect.modes).fullmatch
        self._others = [other for other in DIALECTS.values() if not is_certain and other.name != dialect.name]
        self._control = dialect.name
        self._ends: dict[int, str] = {}
        self.end = _USUAL
        """The end of the last line that has one."""

    def blocks(self) -> Iterator[Block | PlainLine]:
        plain, facts = self._plain, self._facts
        for number, line in enumerate(self._lines, 1):
            text = line[:-1]
            if line[-1:] != "\n" or text[-1:] == "\r":
                text = line.rstrip("\r\n")
                self._ends[number] = line[len(text) :]
            found = plain(text)
            if found and number not in facts:
                yield PlainLine(number, text, found.lastgroup is not None)
                continue
            block = parse_block(text, number)
            if number in self._facts:
                block = replace(block, directives=(*block.directives, *self._facts[number]))
            for other in self._others:
                if other.signs(block):
                    controls = f"{self._control}, and {other.name} by line {number}"
                    raise UnknownControlError(f"the program looks like more than one control ({controls})")
            yield block

    def end_of(self, line: int) -> str:
        """The end of a line that is not taken yet; if it has none, as the lines before it end."""
        return self._ends.get(line, _USUAL) or self.end

    def take_end(self, line: int) -> str:
        """The end of a line, which is asked for once."""
        end = self._ends.pop(line, _USUAL)
        self.end = end or self.end
        return end

    def take(self, lines: Sequence[PlainLine]) -> str:
        """Lines with their ends, which are asked for once."""
        if not self._ends:
            self.end = _USUAL
            return _USUAL.join(line.text for line in lines) + _USUAL
        return "".join(line.text + self.take_end(line.line) for line in lines)
