"""The lines of a program on their way through an expansion: read into blocks, and their ends kept."""

from collections.abc import Iterable, Iterator, Mapping

from msgspec.structs import replace

from contoursolve.controls import CONTROLS
from contoursolve.gcode import ISO, MOST_TOGETHER, Block, Directive, Passage, parse_block
from contoursolve.program.lookahead import Line
from contoursolve.program.recognise import several_controls, sign_against, sign_of
from contoursolve.reading import Control, PlainLines

_USUAL = "\n"
"""End of a line of which nothing else is noted."""


class Lines:
    """The lines of a program as blocks; how each of them ends is kept until it is asked for."""

    def __init__(
        self,
        lines: Iterable[str],
        control: Control,
        facts: Mapping[int, tuple[Directive, ...]],
        *,
        is_certain: bool,
    ) -> None:
        self._lines = lines
        self._facts = facts
        self._plain = PlainLines(control.modes)
        self._is_certain = is_certain
        self._control, self._own = control, ""
        self._ends: dict[int, str] = {}
        self.end = _USUAL
        """The end of the last line that has one."""

    def blocks(self) -> Iterator[Line]:
        has, facts, syntax = self._plain.has, self._facts, self._control.modes.syntax
        held: list[str] = []
        for number, line in enumerate(self._lines, 1):
            # Arcs are written anew in blocks of their own.
            if has(line) and (syntax is ISO or ISO.plain.one.fullmatch(line)) and number not in facts:
                held.append(line)
                if line[-1:] != _USUAL or line[-2:-1] == "\r":
                    self._put(line, number)
                if len(held) >= MOST_TOGETHER:
                    yield Passage(number + 1 - len(held), "".join(held), len(held), syntax)
                    held = []
                continue
            if held:
                yield Passage(number - len(held), "".join(held), len(held), syntax)
                held = []
            yield self._read(line, number)
        if held:
            yield Passage(number + 1 - len(held), "".join(held), len(held), syntax)

    def _read(self, line: str, number: int) -> Block:
        text = self._put(line, number)
        block = parse_block(text, number, self._control.modes.syntax)
        if number in self._facts:
            block = replace(block, directives=(*block.directives, *self._facts[number]))
        if self._is_certain:
            return block
        self._own = self._own or sign_of(block, self._control)
        for other in CONTROLS.showing(text):
            sign = sign_against(block, self._control, other) if other.name != self._control.name else ""
            if sign:
                raise several_controls({self._control.name: self._own, other.name: sign})
        return block

    def _put(self, line: str, number: int) -> str:
        """The text of a line; its end is kept."""
        text = line.rstrip("\r\n")
        end = line[len(text) :]
        if end != _USUAL:
            self._ends[number] = end
        return text

    def end_of(self, line: int) -> str:
        """The end of a line that is not taken yet; if it has none, as the lines before it end."""
        return self._ends.get(line, _USUAL) or self.end

    def take_end(self, line: int) -> str:
        """The end of a line, which is asked for once."""
        end = self._ends.pop(line, _USUAL)
        self.end = end or self.end
        return end

    def take(self, passage: Passage, place: int) -> str:
        """The lines of a passage from a place on, with their ends, which are asked for once."""
        lines = passage.lines[place:] if place else passage.lines
        if self._ends:
            return "".join(
                line.rstrip("\r\n") + self.take_end(passage.line + place + n) for n, line in enumerate(lines)
            )
        self.end = _USUAL
        return "".join(lines) if place else passage.text
