"""Lines that do nothing but move: nine in ten of a long program, of which the last ones before a contour count."""

import re
from collections.abc import Sequence

from contoursolve.reading.advance import Modes, advance
from contoursolve.reading.state import State
from contoursolve.syntax import PlainLine, parse_block

_NUMBER = r"[ \t]*[+-]?(?:[0-9]{1,12}\.?[0-9]{0,12}|\.[0-9]{1,12})"
_COMMENT = r"\((?![ \t]*contoursolve)[^()]*\)"


def plain_lines(modes: Modes) -> re.Pattern[str]:
    """What the text of a line with G00, G01 or neither and coordinates (the group `moves`) looks like, whatever its
    feed, speed and tool; or that of a line without words.

    Such a line is no contour, and belongs to one only beside a line that is not plain, as long as `is_plain`.
    """
    axes = "".join(sorted(modes.axes))
    words = rf"N[0-9]{{1,8}}|G0?[01]|M0?[34589]|T[0-9]{{1,8}}|[FS{axes}]{_NUMBER}"
    moving = rf"(?=[^(]*[{axes}])[ \t]*(?:(?:(?:{words})(?![0-9.])|{_COMMENT})[ \t]*)+"
    return re.compile(rf"(?P<moves>{moving})|[ \t]*(?:{_COMMENT}[ \t]*)*", re.IGNORECASE | re.ASCII)


def is_plain(state: State) -> bool:
    """Whether plain lines are lines to their coordinates in this state."""
    return state.motion in (0, 1) and not state.is_incremental


def advance_plainly(state: State, lines: Sequence[PlainLine], modes: Modes) -> State:
    """The state after plain lines; each axis and the motion are where the last line that says so has them."""
    missing, needed = {"G", *modes.axes}, []
    for line in reversed(lines):
        if not line.moves:
            continue
        code = line.text.partition("(")[0].upper()
        if any(address in code for address in missing):
            missing = {address for address in missing if address not in code}
            needed.append(line)
            if not missing:
                break
    for line in reversed(needed):
        state = advance(state, parse_block(line.text, line.line), modes)
    return state
