"""Centres of arcs that were counted from the wrong point."""

from collections.abc import Callable, Iterator, Sequence
from decimal import Decimal

from contoursolve.diagnosis.edits import Edit, change
from contoursolve.diagnosis.window import Window
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Length
from contoursolve.reading import State, advance

Pair = tuple[Decimal, Decimal]


def centres_from_start(window: Window, blocks: Sequence[Block]) -> Iterator[tuple[Edit, ...]]:
    """Both words of a centre, counted from the start, if they were counted from the origin or from the end."""
    yield from _counted_anew(window, blocks, lambda start, end: (_less(_ORIGIN, start), _less(end, start)))


def centres_from_origin(window: Window, blocks: Sequence[Block]) -> Iterator[tuple[Edit, ...]]:
    """The same counted from the origin, if they were counted from the start or from the end."""
    yield from _counted_anew(window, blocks, lambda start, end: (start, end))


_ORIGIN = Decimal(0), Decimal(0)


def _less(place: Pair, other: Pair) -> Pair:
    return place[0] - other[0], place[1] - other[1]


def _counted_anew(
    window: Window, blocks: Sequence[Block], shifts: Callable[[Pair, Pair], tuple[Pair, ...]]
) -> Iterator[tuple[Edit, ...]]:
    """Both words of each centre with a shift that follows from where its arc begins and ends."""
    lines, modes = {block.line for block in blocks}, window.dialect.modes
    state = window.ahead[0][1] if window.ahead else window.state
    for block in window.blocks:
        before, state = state, advance(state, block, modes)
        words = [word for each in before.plane.centers if (word := block.find(each)) is not None]
        start, end = _place(before), _place(state)
        if block.line not in lines or len(words) != len(before.plane.centers) or start is None or end is None:
            continue
        numbers = [word.number for word in words if word.number is not None]
        if len(numbers) != len(words):
            continue
        for shift in dict.fromkeys(shifts(start, end)):
            if shift != _ORIGIN:
                new = zip(words, (number + step for number, step in zip(numbers, shift, strict=True)), strict=True)
                yield tuple(change(word, _text(word, value)) for word, value in new if value != word.number)


def _place(state: State) -> Pair | None:
    """The place of the tool in the plane, as centres count: radii, in the unit of the program."""
    first, second = state.start().values
    if first is None or second is None:
        return None
    inch = Decimal("25.4") if state.unit is Length.INCH else Decimal(1)
    return Decimal(first) / inch, Decimal(second) / inch


def _text(word: Word, value: Decimal) -> str:
    """A word with another number, spelled as it is."""
    text = f"{value.normalize():f}"
    return f"{word.address}{text}{'.' if word.has_point and '.' not in text else ''}"
