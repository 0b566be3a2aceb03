"""Conventional arcs of Klartext: C and CP about CC, which stands in a block before, and CR by its radius."""

import re
from collections.abc import Iterator

from contoursolve.controls.heidenhain.follow import CENTER, TOOL_AXIS, is_of_machine
from contoursolve.controls.heidenhain.lexicon import ABOUT_CENTER, LEXICON, SYNTAX, function_of
from contoursolve.gcode import Block, Passage, late_pattern, parse_block, words_of
from contoursolve.reading import ArcWord, Mode, Modes, PlainArc, State, apply_modes, is_surely_right, table_in

_BY_RADIUS = "CR"
_POLAR = ("PR", "PA", "IPR", "IPA")


def arc_of(block: Block, before: State, modes: Modes) -> PlainArc | None:
    """The arc that a block states; None where it is none, or where it is not known how it is read."""
    function, plane = function_of(block), before.plane
    if function not in (*ABOUT_CENTER, _BY_RADIUS) or TOOL_AXIS in before.memory or is_of_machine(block):
        return None
    if not before.doubts.keys().isdisjoint((Mode.UNIT, CENTER, *_names(plane.axes))):
        return None
    here = apply_modes(before, block, modes)
    ends = dict[str, ArcWord]()
    radius: ArcWord | None = None
    for word in block.words:
        row = LEXICON.addresses.get(word.address)
        if row is not None and row.axis in plane.axes:
            if row.axis in ends:
                return None
            value, start = LEXICON.value(word, here.unit), _start(here, row.axis)
            base = 0.0 if row.is_increment else start
            stated = None if value is None or base is None else float(value) - base
            ends[row.axis] = ArcWord(word, stated, base)
        elif word.address == "R" and function == _BY_RADIUS:
            value = LEXICON.value(word, here.unit)
            radius = ArcWord(word, None if value is None else float(value))
    first, second = (ends.get(axis) for axis in plane.axes)
    is_polar = any(block.find(name) for name in _POLAR)
    if is_polar and function == _BY_RADIUS:
        return None
    about = function in ABOUT_CENTER
    text = before.memory[CENTER].text if about and CENTER in before.memory else ""
    centers = tuple(_center(here, axis, is_stated=bool(text)) if about else None for axis in plane.axes)
    if is_polar and all(centers):
        # Its end lies on the circle by itself.
        return None
    return PlainArc(
        block,
        here,
        table_in(here, modes),
        LEXICON,
        (first, second),
        (centers[0], centers[1]),
        radius,
        # Of a parameter there is a word.
        is_whole=not text or any(centers),
        center_text=text,
    )


def _names(axes: tuple[str, str]) -> tuple[str, ...]:
    return tuple(f"{CENTER} {axis}" for axis in axes)


def _start(here: State, axis: str) -> float | None:
    at = here.axes[axis]
    return None if at.value is None or at.is_skippable else float(at.value)


def _center(here: State, axis: str, *, is_stated: bool) -> ArcWord | None:
    """The coordinate of CC on an axis; without a value where that is not known."""
    word, start = here.memory.get(f"{CENTER} {axis}"), _start(here, axis)
    if word is None or word.number is None:
        place = here.memory.get(CENTER)
        return ArcWord(place, None) if is_stated and place is not None else None
    value, place = float(word.number * here.unit.in_mm), here.memory.get(CENTER)
    own = parse_block(place.text, place.span.line, SYNTAX).find(axis) if place is not None else None
    return ArcWord(own or word, None if start is None else value - start, start if own is not None else None)


# Plain lines -----------------------------------------------------------------------------------------------------

_ARC = late_pattern(r"^[ \t]*+(?:[0-9]++[ \t]++)?(C[CR]?)[ \t]", re.IGNORECASE | re.MULTILINE)
_WORD = late_pattern(r"([XYR])([-+]?[0-9.,]+)", re.IGNORECASE)
_FUNCTION = late_pattern(r"^[ \t]*+(?:[0-9]++[ \t]++)?(CC?R?)[ \t]", re.IGNORECASE)


def suspected(passage: Passage, state: State, modes: Modes) -> Iterator[int]:
    """The indices of plain lines with an arc with which something may be wrong."""
    if _ARC.search(passage.text) is None:
        return
    lines, table, scale = passage.lines, table_in(state, modes), float(state.unit.in_mm)
    is_plain = TOOL_AXIS not in state.memory and not state.doubts
    center = tuple(_place(state, axis, f"{CENTER} {axis}", scale) for axis in state.plane.axes)
    for index, line in enumerate(lines):
        found = _FUNCTION.match(line)
        if found is None:
            continue
        words = _words(words_of(line, passage.syntax))
        name = found[1].upper()
        if name == CENTER:
            center = words.get("X"), words.get("Y")
            center = tuple(None if each is None else each * scale for each in center)
            continue
        begin = _before(lines, index, "X", state, scale), _before(lines, index, "Y", state, scale)
        end = words.get("X"), words.get("Y")
        known = (*begin, *end, *(center if name != _BY_RADIUS else ()))
        if not is_plain or None in known:
            yield index
            continue
        (x, y), (to_x, to_y) = ((each or 0.0 for each in pair) for pair in (begin, end))
        to_x, to_y = to_x * scale, to_y * scale
        first, second = (each or 0.0 for each in center)
        shape = words.get("R", 0.0) * scale if name == _BY_RADIUS else (first - x, second - y)
        if not is_surely_right(table, (to_x - x, to_y - y), shape):
            yield index


def _words(text: str) -> dict[str, float]:
    return {name.upper(): float(number.replace(",", ".")) for name, number in _WORD.findall(text)}


def _before(lines: tuple[str, ...], index: int, axis: str, state: State, scale: float) -> float | None:
    """The place of an axis before a line, mm."""
    for place in range(index - 1, -1, -1):
        line = lines[place]
        if axis in line and not ((found := _FUNCTION.match(line)) and found[1].upper() == CENTER):
            number = _words(line.partition(";")[0]).get(axis)
            if number is not None:
                return number * scale
    return _start(state, axis)


def _place(state: State, _axis: str, name: str, scale: float) -> float | None:
    word = state.memory.get(name)
    return None if word is None or word.number is None else float(word.number) * scale
