"""A contour of an open program in the explorer: each move examines only what depends on it."""

from typing import Any

from contoursolve.diagnosis import Answer
from contoursolve.notebook import Conversation, begin
from contoursolve.program import OpenProgram, Result


class Explored:
    """The conversation about the contour on some lines of a program. What is tried passes through the program, which
    has the text of the conversation again after each answer."""

    def __init__(self, program: OpenProgram, answer: Answer) -> None:
        self.program, self.first, self.last = program, answer.lines[0], answer.lines[-1]
        control, unit = program.control, program.unit
        begun = begin(program.text, line=self.first, control=control, units=unit, examine=self._examine)
        self.conversation = Conversation(begun)
        self._restore()

    @property
    def text(self) -> str:
        """The text of the program with what was done to the contour."""
        return self.conversation.exploration.text

    def answer(self, action: dict[str, Any]) -> dict[str, Any]:
        """Do what the explorer asks for; what changes of its state."""
        try:
            return self.conversation.answer(action)
        finally:
            self._restore()

    def _examine(self, text: str) -> Result:
        self.program.replace(text)
        self.program.check()
        return self.program.result()

    def _restore(self) -> None:
        self.program.replace(self.text)
        now = self.conversation.exploration.answer
        if now is not None:
            self.first, self.last = now.lines[0], now.lines[-1]
