"""A contour of an open program in the explorer: by itself where it can stand alone, so that each move is quick."""

from collections.abc import Sequence

from contoursolve.diagnosis import Answer
from contoursolve.gcode import split_lines
from contoursolve.notebook import Conversation, begin, standing_alone
from contoursolve.program import OpenProgram

_TOOL = "contoursolve tool"


class Explored:
    """The conversation about the contour on some lines of a program, and what the program becomes by it.

    A contour that stands alone has blank lines before it, so that its lines have the numbers that they have in the
    program.
    """

    def __init__(self, program: OpenProgram, answer: Answer, *, is_whole: bool = False) -> None:
        self.first, self.last = answer.lines[0], answer.lines[-1]
        lines = split_lines(program.text)
        own, dialect = lines[self.first - 1 : self.last], program.dialect
        before = [] if is_whole else _leading(program, answer)
        self.is_alone = bool(before)
        self._around = lines[: self.first - 1], lines[self.last :]
        self._before = before
        if self.is_alone:
            begun = begin("".join((*before, *own)), line=self.first, control=dialect, units=answer.unit.value)
        else:
            begun = begin(program.text, line=self.first, control=dialect)
        self.conversation = Conversation(begun)
        self.text = program.text
        """The text of the program with what was done to the contour."""

    def answer(self, action: dict[str, object]) -> dict[str, object] | None:
        """Do what the explorer asks for; what changes of its state, or None where that is more than the contour by
        itself."""
        changed = self.conversation.answer(action)
        now = self.conversation.exploration
        if not self.is_alone:
            self.text = now.text
            return changed
        lines, place = split_lines(now.text), now.place
        if place is None or lines[: place.before] != self._before:
            return None
        self.last = self.first + len(lines) - place.before - 1
        self.text = "".join((*self._around[0], *lines[place.before :], *self._around[1]))
        return changed


def _leading(program: OpenProgram, answer: Answer) -> Sequence[str]:
    """The lines that bring a contour's start point and modes, behind so many blank ones that the contour keeps its
    lines; empty where it rests on more."""
    dialect, first = program.dialect, answer.lines[0]
    if dialect is None or not program.is_in_parts or _TOOL in program.text:
        return ()
    settings = dialect.modes.settings
    text = standing_alone(answer, control=dialect, units=answer.unit.value, settings=settings, is_exact=True)
    leading = [f"{each}\n" for each in text.split("\n")[: -len(answer.claim.blocks)]] if text else []
    return [*["\n"] * (first - 1 - len(leading)), *leading] if leading and len(leading) < first else ()
