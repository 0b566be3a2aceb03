"""Lines that do nothing but move: nine in ten of a long program, of which the last ones before a contour count."""

import re
from dataclasses import replace
from functools import partial

from contoursolve.model import Length
from contoursolve.reading.advance import Modes, absolute_positions
from contoursolve.reading.state import Awaited, Position, State
from contoursolve.syntax import Passage, find_words

# Possessive throughout: an integer that may be divided at any digit would be tried in all ways.
_NUMBER = r"[ \t]*+[+-]?+(?:[0-9]{1,12}+(?:\.[0-9]{0,12}+)?+|\.[0-9]{1,12}+)"
_COMMENTS = re.compile(r"\([^()]*+\)")
_MOTIONS = re.compile(r"G0?([01])")
_COMMENT = r"\((?![ \t]*+contoursolve)[^()]*+\)"


def plain_lines(modes: Modes) -> re.Pattern[str]:
    """What a line with its end looks like that has G00, G01 or neither and coordinates, whatever its feed, speed and
    tool; or one without words.

    Such a line is no contour, and belongs to one only beside a line that is not plain, as long as `is_plain`.
    """
    axes = "".join(sorted(modes.axes))
    words = rf"N[0-9]{{1,8}}+|G0?[01]|M0?[34589]|T[0-9]{{1,8}}+|[FS{axes}]{_NUMBER}"
    moving = rf"(?=[^(]*[{axes}])[ \t]*+(?:(?:(?:{words})(?![0-9.])|{_COMMENT})[ \t]*+)++"
    return re.compile(rf"(?:{moving}|[ \t]*+(?:{_COMMENT}[ \t]*+)*+)(?:\r\n|\n|\r)?", re.IGNORECASE | re.ASCII)


def is_plain(state: State) -> bool:
    """Whether plain lines are lines to their coordinates in this state."""
    return state.motion in (0, 1) and not state.is_incremental


def words_of(line: str) -> str:
    """The words of a plain line, upper case, without its comments and its end; empty if it has none."""
    return (_COMMENTS.sub("", line) if "(" in line else line).strip().upper()


def motion_of(words: str) -> int | None:
    """The motion that the words of a plain line state, if they state one."""
    found = _MOTIONS.findall(words) if "G" in words else None
    return int(found[-1]) if found else None


def advance_plainly(state: State, passage: Passage, modes: Modes) -> State:
    """The state after plain lines; each axis and the motion are where the last line that says so has them. What an
    axis is told is read when somebody asks."""
    axes, motion = dict[str, Position](), None
    text = "".join(passage.lines).upper()
    programmed = [axis for axis in modes.axes if axis in text]
    for place in range(len(passage.lines) - 1, -1, -1):
        words, found = words_of(passage.lines[place]), None
        motion = motion_of(words) if motion is None else motion
        for axis in programmed:
            if axis in words and axis not in axes:
                found = found or _Moved(passage.lines[place], passage.line + place, state.unit, modes)
                axes[axis] = Awaited(partial(found.position, axis))
        if motion is not None and len(axes) == len(programmed):
            break
    if motion is not None and motion != state.motion:
        state = replace(state, motion=motion)
    return state.move(axes)


class _Moved:
    """Where a plain line leads; it is read once, when somebody asks."""

    def __init__(self, text: str, line: int, unit: Length, modes: Modes) -> None:
        self.text, self.line, self.unit, self.modes = text, line, unit, modes
        self.positions: dict[str, Position] | None = None

    def position(self, axis: str) -> Position:
        """Its end on an axis that it programs."""
        if self.positions is None:
            words = find_words(self.text.rstrip("\r\n"), self.line, self.modes.axes)
            self.positions = absolute_positions(words, self.unit, self.modes)
        return self.positions[axis]
