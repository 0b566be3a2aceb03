"""The lines of a program on their way through an expansion: read into blocks, and their ends kept."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from contoursolve.dialects import DIALECTS, Dialect
from contoursolve.pipeline import several_controls, sign_of
from contoursolve.reading import plain_lines
from contoursolve.syntax import Block, Directive, PlainLine, parse_block


class Lines:
    """The lines of a program as blocks; how each of them ends is kept until it is asked for."""

    def __init__(
        self, lines: Iterable[str], dialect: Dialect, facts: Mapping[int, tuple[Directive, ...]], *, is_certain: bool
    ) -> None:
        self._lines = lines
        self._facts = facts
        self._plain = plain_lines(dialect.modes).fullmatch
        self._others = [other for other in DIALECTS.values() if not is_certain and other.name != dialect.name]
        self._dialect = dialect
        self._ends: dict[int, str] = {}
        self.end = "\n"
        """The end of the last line that has one."""

    def blocks(self) -> Iterator[Block | PlainLine]:
        own = ""
        for number, line in enumerate(self._lines, 1):
            size = 2 if line.endswith("\r\n") else 1 if line.endswith(("\n", "\r")) else 0
            text, end = line[: len(line) - size], line[len(line) - size :]
            self._ends[number] = end
            plain = self._plain(text)
            if plain and number not in self._facts:
                yield PlainLine(number, text, plain["moves"] is not None)
                continue
            block = parse_block(text, number)
            if number in self._facts:
                block = replace(block, directives=(*block.directives, *self._facts[number]))
            if self._others:
                own = own or sign_of(block, self._dialect)
            for other in self._others:
                sign = sign_of(block, other)
                if sign:
                    raise several_controls({self._dialect.name: own, other.name: sign})
            yield block

    def end_of(self, line: int) -> str:
        """The end of a line that is not taken yet; if it has none, as the lines before it end."""
        return self._ends[line] or self.end

    def take_end(self, line: int) -> str:
        """The end of a line, which is asked for once."""
        end = self._ends.pop(line)
        self.end = end or self.end
        return end
