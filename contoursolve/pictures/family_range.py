"""The ranges of one word as a bar: where the contour exists, what ends it, and which value the block has."""

from collections.abc import Iterator

from contoursolve.families import End, Feasible, Way
from contoursolve.output.layout import written
from contoursolve.pictures.arrows import line
from contoursolve.pictures.chart import LEFT, SIZE, TITLE, WIDE, WIDTH, heading, over_range
from contoursolve.pictures.metrics import shorten
from contoursolve.pictures.sheet import Anchor, Box, Dot, Item, Run, Shape, Sheet, Text
from contoursolve.pictures.theme import Role
from contoursolve.pictures.wording import axis_text, visible

_TOP, _HIGH = 52.0, 26.0
"""Pixels above the bar, and of the bar."""

_MARGIN = 0.15
"""Share of what is shown that lies beyond the outermost ends."""

_MOST = 12
"""Ends that are told in words."""

_HIGHER = 17.0
"""Pixels from one line of text to the next."""


def range_title(found: Feasible) -> str:
    """What a bar shows."""
    proof = "" if found.is_complete else " (that these are all is not proven)"
    return f"{found.word}: where the contour exists{proof}"


def lay_out_range(found: Feasible, title: str) -> Sheet:
    """The page of the ranges of a word."""
    low, high = _shown(found)
    scale = over_range(low, high)

    def x_of(value: float) -> float:
        return LEFT + WIDE * (min(max(value, low), high) - low) / (high - low)

    bottom = _TOP + _HIGH
    items: list[Item] = [heading(title), _bar(LEFT, LEFT + WIDE, Role.REFUSED_FIELD)]
    for interval in found.intervals:
        begin = x_of(interval.low.value)
        items.append(_bar(begin, max(x_of(interval.high.value), begin + 1.5), Role.SOLVED_FIELD))
    for each, _ in _ends(found):
        items.append(line((x_of(each.value), _TOP - 5.0), (x_of(each.value), bottom + 5.0), Role.INK, 1.6))
    items.append(line((LEFT, bottom), (LEFT + WIDE, bottom), Role.INK))
    for value, share in scale.ticks():
        x = LEFT + share * WIDE
        items.append(line((x, bottom), (x, bottom + 5.0), Role.INK))
        items.append(Text((x, bottom + 19.0), (Run(f"{value:g}", Role.INK),), SIZE, Anchor.MIDDLE))
    name = axis_text(found.word, found.unit)
    items.append(Text((LEFT + WIDE / 2, bottom + 38.0), (Run(name, Role.INK),), TITLE, Anchor.MIDDLE, is_bold=True))
    items.append(Dot((x_of(found.stated), _TOP + _HIGH / 2), 4.0, Role.GIVEN))
    height = bottom + 62.0
    for told, role in _remarks(found):
        items.append(Text((18.0, height), (Run(shorten(told, WIDTH - 36.0, SIZE), role),), SIZE))
        height += _HIGHER
    return Sheet(WIDTH, height, Box(0.0, 0.0, WIDTH, height), tuple(items))


def _bar(left: float, right: float, role: Role) -> Shape:
    return Shape(((left, _TOP), (right, _TOP), (right, _TOP + _HIGH), (left, _TOP + _HIGH)), role)


def _ends(found: Feasible) -> Iterator[tuple[End, str]]:
    """Where the contour begins or ceases to exist, with which of both."""
    for each in found.intervals:
        if each.low.way is not Way.RANGE:
            yield each.low, "from"
        if each.high.way is not Way.RANGE:
            yield each.high, "to"


def _shown(found: Feasible) -> tuple[float, float]:
    """What is shown: all ends and the value that the block has, as far as they were looked at, and a margin."""
    values = [end.value for end, _ in _ends(found)] or list(found.within)
    low, high = min(*values, found.stated), max(*values, found.stated)
    margin = _MARGIN * (high - low) or max(1.0, abs(low))
    return max(low - margin, min(found.within[0], low)), min(high + margin, max(found.within[1], high))


def _remarks(found: Feasible) -> Iterator[tuple[str, Role]]:
    """The value that the block has, and what fails beyond each end."""
    yield f"the block has {written(found.stated, found.unit)}", Role.GIVEN
    ends = list(_ends(found))
    for end, way in ends[:_MOST]:
        reason = f": {visible(end.reason.text)}" if end.reason is not None else ""
        yield f"{way} {written(end.value, found.unit)}{reason}", Role.INK
    if len(ends) > _MOST:
        yield f"and {len(ends) - _MOST} more ends", Role.MUTED
    if not found.intervals:
        yield "there is a contour for no value", Role.INK
    elif not ends:
        yield "there is a contour for every value that was looked at", Role.INK
