"""The senses of conventional arcs that begin in the direction of the block before them, and so have no DR."""

from collections.abc import Iterator, Sequence

from contoursolve.controls.heidenhain.follow import CENTER, follow, pole_of
from contoursolve.controls.heidenhain.lexicon import LEXICON, STRAIGHT, function_of
from contoursolve.gcode import Block
from contoursolve.reading import Modes, State
from contoursolve.tolerance import LENGTH


def senses(blocks: Sequence[Block], state: State, modes: Modes) -> Iterator[tuple[int, int]]:
    """The lines of such arcs whose ends and begin are known, each with 1 (counter-clockwise) or -1."""
    direction: complex | None = None
    for block in blocks:
        function, before = function_of(block), state
        state = follow(state, block, modes)
        start, end = _place(before), _place(state)
        if function in ("RND", "CHF", "CC", "FPOL", "FSELECT", "") or block.macro is not None:
            continue
        if start is None or end is None or abs(end - start) <= LENGTH:
            direction = None
        elif function in ("FC", "FCT"):
            # Where a free arc ends is still to be found.
            direction = None
        elif function in STRAIGHT:
            direction = (end - start) / abs(end - start)
        elif function in ("CT", "CTP"):
            chord = (end - start) / abs(end - start)
            turned = direction and chord / direction
            if turned:
                yield block.line, 1 if turned.imag > 0 else -1
            direction = direction * turned**2 if direction and turned else None
        else:
            direction = _behind_arc(block, before, start, end)


def _place(state: State) -> complex | None:
    first, second = state.start().values
    return None if first is None or second is None else complex(float(first), float(second))


def _behind_arc(block: Block, before: State, start: complex, end: complex) -> complex | None:
    """The direction in which an arc about a centre or with a radius ends."""
    sense, radius, pole = block.find("DR"), block.find("R"), pole_of(before, CENTER)
    if sense is None or not sense.number:
        return None
    sign = 1 if sense.number > 0 else -1
    size = LEXICON.value(radius, before.unit) if radius is not None else None
    if size is not None:
        half = (end - start) / 2
        height = max(float(size) ** 2 - abs(half) ** 2, 0.0) ** 0.5
        center = start + half + sign * (1 if size > 0 else -1) * 1j * half / abs(half) * height
    elif pole is not None:
        center = complex(float(pole[0]), float(pole[1]))
    else:
        return None
    spoke = end - center
    return sign * 1j * spoke / abs(spoke) if spoke else None
