"""The lines of a program with variables, read as if every word had the value that its variables have for example."""

from collections.abc import Iterable, Mapping
from decimal import Decimal
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import typed_text
from contoursolve.execution import Assign, CodeLine, Known, Unknown, When, evaluate, place_in, variables_of
from contoursolve.gcode import Block, Word, parse_block
from contoursolve.numeric import Constant, Term, Variable
from contoursolve.program import Lines
from contoursolve.reading import Control

DECIMALS = 6
"""To which an example of a value is rounded: controls read no more."""


class Free(Struct, frozen=True):
    """A value that follows variables: its name here, how it is computed, and for an example its value and those of
    the variables."""

    name: str
    term: Term
    value: Decimal
    known: Mapping[str, float] = {}


class Slot(Struct, frozen=True):
    """The place of a word's value in its line, and that value."""

    begin: int
    end: int
    free: Free


class MacroLine(Struct, frozen=True):
    """A line that holds variables: what it says, with those of its words that have a value for example."""

    code: CodeLine
    slots: tuple[Slot, ...]

    def typed(self, block: Block, values: Mapping[str, Decimal]) -> tuple[Block, dict[int, Slot]]:
        """The block with numbers in place of variables, by name or those of the example, and the slots by the index of
        their word. Texts stay as they are."""
        text, shift, places = self.code.rest, 0, dict[int, Slot]()
        for slot in self.slots:
            number = typed_text(float(values.get(slot.free.name, slot.free.value)))
            text = text[: slot.begin + shift] + number + text[slot.end + shift :]
            places[slot.begin + shift] = slot
            shift += len(number) - (slot.end - slot.begin)
        read = parse_block(text, block.line, block.syntax)
        words, slots = list[Word](), dict[int, Slot]()
        for index, word in enumerate(read.words):
            first, last = word.span.column - 1, word.span.end_column - 1
            at = next((at for at in places if first <= at < last), None)
            if at is not None:
                slots[index] = places[at]
                word = replace(word, text=text[first:at] + block.text[places[at].begin : places[at].end])  # noqa: PLW2901
            words.append(word)
        return replace(block, words=tuple(words), faults=read.faults), slots


class FormulaLines(Lines):
    """The lines of a program on their way; `macros` are those that hold variables, by their numbers."""

    def __init__(
        self, lines: Iterable[str], control: Control, *args: Any, lets: Mapping[str, float], **options: Any
    ) -> None:
        super().__init__(lines, control, *args, **options)
        self.language, self.lets = control.modes.language, lets
        self.macros: dict[int, MacroLine] = {}
        self.values: dict[str, Known] = {**lets}
        """The variables as far as the program has been read."""

    def _read(self, line: str, number: int) -> Block:
        block = super()._read(line, number)
        if self.language is None or not self.language.may_say(block.text):
            return block
        code, slots = self.language.read(block.text), list[Slot]()
        for place, word in enumerate(code.words):
            value = evaluate(word.value, self._look_up)
            if isinstance(value, float):
                name, number_of = f"value {place + 1} of program line {number}", Decimal(str(round(value, DECIMALS)))
                term = place_in(word.value, {self.language.always_empty: Constant(0.0)})
                slots.append(Slot(word.begin, word.end, Free(name, term, number_of, self._known(term))))
        for statement in code.statements:
            self._follow(statement)
        self.macros[number] = MacroLine(code, tuple(slots))
        return self.macros[number].typed(block, {})[0]

    def _follow(self, statement: object) -> None:
        """Set the values that a statement assigns, whatever jumps lead there."""
        if isinstance(statement, When) and evaluate(statement.condition, self._look_up) == 1:
            for each in statement.then:
                self._follow(each)
        elif isinstance(statement, Assign) and getattr(statement.variable, "name", None) not in (None, *self.lets):
            self.values[getattr(statement.variable, "name", "")] = evaluate(statement.value, self._look_up)

    def _look_up(self, name: str) -> Known:
        return self.language.value_of(name, self.values) if self.language else Unknown(f"{name} has no value")

    def _known(self, term: Term) -> dict[str, float]:
        """The values of the variables of an expression that has one."""
        names = [each.name for each in variables_of(term) if isinstance(each, Variable)]
        return {name: value for name in names if isinstance(value := self.values.get(name), float)}
