"""The control of a text that is being edited: by what it is told, and which edits may tell another one."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from contoursolve.gcode import ISO, Block, Blocks, Program, parse_block
from contoursolve.program.agreeing_controls import choose_alike
from contoursolve.program.open_lines import OpenLines, Splice
from contoursolve.program.project_file import CONTROL, FIRST_LINES, SettingError, stated_settings
from contoursolve.program.recognise import (
    PLANE,
    TURNED_AXES,
    Recogniser,
    UnknownControlError,
    has_arcs,
    may_make_corner,
    shown_by,
    shown_of_machine,
)
from contoursolve.program.request import Request
from contoursolve.reading import Control, ReadIssue


class ToldControl:
    """The control of lines that change, found anew where an edit may tell another one."""

    def __init__(self, lines: OpenLines, name: str, asked: Request) -> None:
        self._lines, self._name, self._asked = lines, name, asked
        self.named: str | Control | None = None
        """The control that somebody named; None: as the program shows."""
        self.settings: dict[str, str] = {}
        """The settings that somebody gave; what a comment in the program states counts more."""
        self.control: Control | None = None
        """The control; None where nothing tells it."""
        self.is_stated = False
        """Whether a comment in the program states it."""
        self.trouble = ""
        """Why the control cannot be told, if it cannot."""
        self.is_ambiguous = False
        """Whether that is because the program may be for several."""
        self._stated: dict[str, str] = {}
        """The settings that comments in its first lines state."""
        self._shown: Counter[str] | None = None
        """How many lines show what of the control; None where they are not asked."""

    def configure(self, named: str | Control | None, settings: Mapping[str, str]) -> None:
        """Take the control that is named (None: as the program shows), with these settings."""
        self.named, self.settings = named, dict(settings)
        self.find()

    def find(self) -> None:
        """Find the control."""
        self.trouble, self.is_ambiguous, self.is_stated, self._shown = "", False, False, None
        try:
            program = Program(self._name, text := self._lines.text, Blocks(text, 1, ISO))
            self._stated = stated_settings(self._lines.texts)
            self.is_stated = CONTROL in self._stated
            settings = self.settings | self._stated
            self.control = choose_alike(self.named, program, self._asked, settings, self._recognise)
        except (UnknownControlError, SettingError) as error:
            self.control, self.trouble = None, str(error)
            named = {self.named, self.settings.get(CONTROL)} - {None}
            self.is_ambiguous = isinstance(error, UnknownControlError) and not named

    def _recognise(self, blocks: Iterable[Block]) -> Control | None:
        """The control that blocks show, as `recognise` does; it is kept what they show."""
        recogniser, self._shown = Recogniser(self._name), Counter()
        for block in blocks:
            shown = shown_by(block)
            self._shown.update(shown)
            recogniser.take(block, shown)
        return recogniser.find()

    def follow(self, change: Splice) -> bool:
        """Find the control anew, if the lines that have changed may tell another one; whether they do. One with the
        same settings stays what it was."""
        old = self.control
        # Where blocks show several controls, the reason names their lines.
        is_shown = self._shows_something_else(change.gone, change.come)
        is_stated = change.first < FIRST_LINES and self._states_something_else()
        if is_stated or self.trouble or is_shown or self._concludes_otherwise([*change.gone, *change.come]):
            self.find()
        if old is None or self.control is None or not _alike(old, self.control):
            return True
        self.control = old
        return False

    def _states_something_else(self) -> bool:
        """Whether the first lines state other settings, now that some of them are others."""
        try:
            return stated_settings(self._lines.texts) != self._stated
        except SettingError:
            return True

    def _shows_something_else(self, gone: Sequence[str], come: Sequence[str]) -> bool:
        """Whether another control may be shown, now that some lines are gone and others have come."""
        if self._shown is None:
            return False
        before = {each for each, count in self._shown.items() if count}
        taken, given = [*map(_shown, gone)], [*map(_shown, come)]
        for shown in taken:
            self._shown.subtract(shown)
        for shown in given:
            self._shown.update(shown)
        # Where a plane is selected, their order counts, too.
        is_ordered = PLANE in before and taken != given
        return is_ordered or before != {each for each, count in self._shown.items() if count}

    def _concludes_otherwise(self, changed: Sequence[str]) -> bool:
        """Whether something else may be concluded about the control, now that these lines are gone or have come."""
        if self.control is None:
            return any(map(may_make_corner, changed)) or has_arcs(self._lines.text)
        syntax = self.control.modes.syntax
        is_alike = any(each.about is ReadIssue.CONTROL_ALIKE for each in self.control.taken)
        return is_alike or any(shown_of_machine(line, syntax) - TURNED_AXES for line in changed)


def _shown(line: str) -> frozenset[str]:
    return shown_by(parse_block(line.rstrip("\r\n"), 1))


def _alike(one: Control, other: Control) -> bool:
    """Whether two are the same control with the same settings."""
    return one is other or (one.name == other.name and one.modes.settings == other.modes.settings)
