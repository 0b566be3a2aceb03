"""The place of the tool behind the blocks of a Klartext program that are no free contour, and which way arcs without DR
turn."""

import re
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from math import atan2, cos, degrees, hypot, radians, sin

from msgspec.structs import replace

from contoursolve.controls.heidenhain.lexicon import (
    ABOUT_CENTER,
    BLOCK_NUMBER,
    BOOK,
    FREE,
    LEXICON,
    MOVES,
    STRAIGHT,
    function_of,
)
from contoursolve.diagnostics import Span
from contoursolve.gcode import Block, Word, late_pattern
from contoursolve.geometry import Length
from contoursolve.reading import (
    FAULTY,
    WORK,
    Mode,
    Modes,
    Position,
    State,
    ZeroMove,
    ZeroRow,
    apply_modes,
    axis_words,
    positions,
    shift_in,
    shift_zero,
    state_moved,
    table_of,
    with_turn,
)
from contoursolve.tolerance import LENGTH

PLANE = ("X", "Y")
CENTER, POLE = "CC", "FPOL"
"""Functions of poles: of conventional moves and of free contours. Their coordinates stay in force by these names and an
axis, such as FPOL X."""

TOOL_AXIS = "tool axis other than Z"
JOINT = "joint"
"""An approach, or an element that a call ran, as long as no other element stands behind it: what a corner that is the
first of its chain may join."""
DEPARTED = "the tool departs from the contour"

_DECIMALS = Decimal("1e-9")


def follow(state: State, block: Block, modes: Modes) -> State:
    """The state behind a block that is no free contour."""
    if block.macro is not None:
        return _statement(state, block, modes)
    state, function = apply_modes(state, block, modes), function_of(block)
    state = keep_joint(state, block, function)
    if block.faults:
        return state.lose(modes.axes, FAULTY, block.span)
    if function in (CENTER, POLE):
        return set_pole(state, block, function, modes)
    if function.startswith("DEP"):
        return state.lose(state.plane.axes, DEPARTED, block.span)
    if function in FREE and not begins_chain(function, block, state.plane.axes):
        return state.lose(state.plane.axes, "a free contour leads there", block.span)
    if any(block.find(name) for name in ("PR", "PA", "IPR", "IPA")):
        moved = _polar(state, block, modes)
    else:
        moved = state.move(positions(state, axis_words(block, modes), modes, block.is_skippable))
    if is_of_machine(block):
        rows = (modes.lexicon.addresses.get(word.address) for word in block.words)
        own = tuple(dict.fromkeys(row.axis for row in rows if row and row.axis in modes.axes)) or modes.axes
        return moved.lose(own, "its coordinates are those of the machine", block.span)
    if any(word.address == "M" and word.number in _ENDING for word in block.words):
        return moved.lose(modes.axes, "the program ends there", block.span)
    return _call_cycle(moved, block, modes)


def _call_cycle(state: State, block: Block, modes: Modes) -> State:
    """The state behind a block at whose end M99, or M89 up to the next M99, runs the cycle that is defined."""
    for word in words_of_cycle(block):
        memory = {name: each for name, each in state.memory.items() if name != _ALWAYS}
        state = state.remember(memory if word.number == _ONCE else {**memory, _ALWAYS: word})
        state = state.lose(modes.axes, _CYCLE, word.span)
    is_called = _ALWAYS in state.memory and axis_words(block, modes)
    return state.lose(modes.axes, _CYCLE, block.span) if is_called else state


def words_of_cycle(block: Block) -> list[Word]:
    """The words by which a cycle runs at the end of a block: at this one, or at each from here on."""
    return [word for word in block.words if word.address == "M" and word.number in (_ONCE, 89)]


_ONCE = 99
_ALWAYS = "a cycle at the end of each move"
"""Stands in what stays in force behind M89."""


def words_of_machine(block: Block) -> list[Word]:
    """The words by which the coordinates of a block are those of the machine, or of its builder."""
    return [word for word in block.words if word.address == "M" and word.number in _OF_MACHINE]


def is_of_machine(block: Block) -> bool:
    """Whether a block has one of them."""
    return bool(words_of_machine(block))


_ENDING, _OF_MACHINE = (2, 30), (91, 92)


def keep_joint(state: State, block: Block, function: str) -> State:
    """The state behind a block of a function, with what a corner behind it may join beside what it follows at once."""
    is_joint = function.startswith("APPR") or (bool(block.callers) and function in MOVES)
    if is_joint:
        word = Word(JOINT, None, False, JOINT, Span(0, 1, 1))
        return replace(state, memory={**state.memory, JOINT: word})
    if JOINT in state.memory and (function in MOVES or function.startswith("DEP")):
        return replace(state, memory={name: word for name, word in state.memory.items() if name != JOINT})
    return state


def begins_chain(function: str, block: Block, plane: Sequence[str] = PLANE) -> bool:
    """Whether a free line is where a chain begins: it states both coordinates of its end."""
    return function == "FL" and all(block.find(axis) for axis in plane)


def set_pole(state: State, block: Block, function: str, modes: Modes) -> State:
    """The state behind a block that sets a pole: where the tool is, if it has no coordinates."""
    moved = positions(state, axis_words(block, modes), modes, block.is_skippable)
    memory, stated = dict(state.memory), list[str]()
    if function == CENTER:
        # The line that states it, as it is written.
        memory[CENTER] = Word(CENTER, None, False, block.text, block.span)
    for axis in state.plane.axes:
        # A centre keeps the coordinate that its block leaves out; CC alone takes the position.
        if axis in moved or (function == CENTER and not moved):
            value = (moved[axis] if axis in moved else state.axes[axis]).value
            stated.append(f"{function} {axis}")
            memory.pop(f"{function} {axis}", None)
            if value is not None:
                number = value / state.unit.in_mm
                memory[f"{function} {axis}"] = Word(axis, number, True, f"{function} {axis}{number:f}", block.span)
    return replace(state, memory=memory).settle(*stated)


def pole_words(state: State, function: str) -> list[Word | None]:
    """The words of a pole that are in force, by the axes of the plane."""
    return [state.memory.get(f"{function} {axis}") for axis in state.plane.axes]


def pole_of(state: State, function: str) -> tuple[Decimal, Decimal] | None:
    """The coordinates of a pole, mm; None if one of them is not known."""
    words = pole_words(state, function)
    first, second = (word.number * state.unit.in_mm if word and word.number is not None else None for word in words)
    return None if first is None or second is None else (first, second)


def _polar(state: State, block: Block, modes: Modes) -> State:
    """The state where polar coordinates lead."""
    pole, here = pole_of(state, CENTER), state.start().values
    values = {
        name: modes.lexicon.value(word, state.unit)
        for name in ("PR", "PA", "IPR", "IPA")
        for word in [block.find(name)]
        if word is not None
    }
    if pole is None or None in values.values():
        what = "the pole is not known" if pole is None else "its polar coordinates depend on a parameter"
        return state.lose(state.plane.axes, what, block.span)
    known = here[0] is not None and here[1] is not None
    spoke = (float((here[0] or 0) - pole[0]), float((here[1] or 0) - pole[1]))
    distance, angle = values.get("PR"), values.get("PA")
    if (distance is None or angle is None) and not known:
        return state.lose(state.plane.axes, "where the tool was is not known", block.span)
    radius = float(distance) if distance is not None else hypot(*spoke) + float(values.get("IPR") or 0)
    turn = float(angle) if angle is not None else degrees(atan2(spoke[1], spoke[0])) + float(values.get("IPA") or 0)
    ends = (float(pole[0]) + radius * cos(radians(turn)), float(pole[1]) + radius * sin(radians(turn)))
    moved = {
        axis: Position(Decimal(repr(end)).quantize(_DECIMALS), "polar coordinates", block.span, block.is_skippable)
        for axis, end in zip(state.plane.axes, ends, strict=True)
    }
    addresses, plane = modes.lexicon.addresses, state.plane.axes
    others = [word for word in axis_words(block, modes) if addresses[word.address].axis not in plane]
    return state.move({**moved, **positions(state, others, modes, block.is_skippable)})


_CALLS_CYCLE = late_pattern(BLOCK_NUMBER + r"CYCL[ \t]+CALL\b", re.IGNORECASE)
_CYCLE = "a cycle runs"
_RECALLED = BOOK.assumed("coordinate transformations")
_NOTHING = Decimal(0)
_MOST_SHOWN = 40
_MOVING: tuple[tuple[re.Pattern[str], ZeroRow], ...] = tuple(
    (re.compile(BLOCK_NUMBER + pattern, re.IGNORECASE), ZeroRow(name, move, _RECALLED))
    for pattern, name, move in (
        (r"CYCL[ \t]+DEF[ \t]+7\.0*[1-9]\d*[ \t]+(?=I?[XYZ])", "CYCL DEF 7", ZeroMove.SET),
        (r"CYCL[ \t]+DEF[ \t]+7\.0*[1-9]\d*\b", "CYCL DEF 7 #", ZeroMove.SELECT),
        (
            r"CYCL[ \t]+DEF[ \t]+(?:8|10|11|19|26)\b",
            "CYCL DEF 8, CYCL DEF 10, CYCL DEF 11, CYCL DEF 19, CYCL DEF 26",
            ZeroMove.TURN,
        ),
        (r"(?:CYCL[ \t]+DEF[ \t]+247|PRESET)\b", "CYCL DEF 247, PRESET", ZeroMove.SELECT),
        (r"PLANE\b", "PLANE", ZeroMove.TURN),
        (r"(?:TRANS|FUNCTION|FN[ \t]*17)\b", "TRANS, FUNCTION, FN 17", ZeroMove.OTHER),
    )
)
"""The moves of the coordinate system: by numbers along axes, or in a way that is not followed."""
ZERO = table_of((), {}, "XYZ", beside=(row for _, row in _MOVING))
"""At first, no shift is in force."""
_SHIFT = re.compile(r"(?P<step>I?)(?P<axis>[XYZ])[ \t]*+(?>(?P<number>[+-]?+(?>\d++\.?+\d*+|\.\d++))?)", re.IGNORECASE)
_TOOL = re.compile(
    BLOCK_NUMBER + r"TOOL[ \t]+CALL[ \t]+(?:\"[^\"]*\"|\S+)[ \t]+(?P<axis>[XYZUVW])(?=[ \t;]|$)", re.IGNORECASE
)
_BEGIN = re.compile(BLOCK_NUMBER + r"BEGIN[ \t]+PGM\b[^;]*?\b(?P<unit>MM|INCH)[ \t]*(?:;|$)", re.IGNORECASE)
_TOOL_CALL = re.compile(BLOCK_NUMBER + r"TOOL[ \t]+CALL\b", re.IGNORECASE)
_HARMLESS = re.compile(
    BLOCK_NUMBER + r"(?:BEGIN|END|BLK|TOOL|CYCL|LBL|FN|Q[LRS]?\d|SEL|STOP|M\d|\*|\(|;|~|$)", re.IGNORECASE
)
"""The begin of a statement that moves nothing."""


_SAYS_NOTHING = re.compile(BLOCK_NUMBER + r"(?:\*|\(|LBL\b(?![ \t]*0\b)|BLK\b|TOOL[ \t]+DEF\b)", re.IGNORECASE)
"""Statements that leave everything as it is: headings, labels, and what defines blanks and tools."""


def says_nothing(block: Block) -> bool:
    """Whether a statement may stand between the blocks of a contour."""
    return _SAYS_NOTHING.match(block.text) is not None


def _statement(state: State, block: Block, modes: Modes) -> State:
    """The state behind a block that is no list of words."""
    begins = _BEGIN.match(block.text)
    if begins:
        return replace(state, unit=Length.INCH if begins["unit"].upper() == "INCH" else Length.MM)
    tool = _TOOL.match(block.text)
    if _TOOL_CALL.match(block.text):
        # What is known along the axis of a tool depends on its length.
        before = state.memory[TOOL_AXIS].text[-1] if TOOL_AXIS in state.memory else "Z"
        lost = {before, tool["axis"].upper() if tool else before}
        state = state.lose(tuple(axis for axis in modes.axes if axis in lost), "the tool is changed", block.span)
    if tool:
        memory = {name: word for name, word in state.memory.items() if name != TOOL_AXIS}
        if tool["axis"].upper() != "Z":
            memory[TOOL_AXIS] = Word(TOOL_AXIS, None, False, f"tool axis {tool['axis'].upper()}", block.span)
        state = replace(state, memory=memory).settle(TOOL_AXIS)
    for pattern, row in _MOVING:
        if pattern.match(block.text):
            return _move_zero(state, block, row, modes)
    if _CALLS_CYCLE.match(block.text):
        return state.lose(modes.axes, _CYCLE, block.span)
    if _HARMLESS.match(block.text):
        return state
    return state.lose_all(modes.axes, f"{_shown(block)} is not known to contoursolve", block.span)


def _shown(block: Block) -> str:
    """The begin of a statement, as a message names it."""
    text = block.syntax.comment.sub("", block.text).replace("~", " ")
    return " ".join(_NUMBER.sub("", text, count=1).split())[:_MOST_SHOWN]


_NUMBER = late_pattern(BLOCK_NUMBER, re.IGNORECASE)


_ENDS = late_pattern(
    r"CYCL DEF (?:8\.\d+|10\.\d+ ROT ?[+-]?0+(?:\.0*)?|11\.\d+ SCL ?\+?0*1(?:\.0*)?"
    r"|19\.\d+(?: [ABC] ?[+-]?0+(?:\.0*)?)*)|PLANE RESET\b.*"
)
"""The ends of what turns, mirrors or scales axes."""


def _move_zero(state: State, block: Block, row: ZeroRow, modes: Modes) -> State:
    """The state behind a statement that moves the coordinate system."""
    text = " ".join(_NUMBER.sub("", block.syntax.comment.sub("", block.text), count=1).upper().split())
    if row.move is ZeroMove.OTHER:
        lost = state.lose_all(modes.axes, f"{_shown(block)} may change the coordinate system", block.span)
        is_shift = text.startswith("TRANS")
        return replace(lost, zero=with_turn(lost.zero, "TRANS", is_on=not text.endswith("RESET"))) if is_shift else lost
    if row.move is ZeroMove.TURN:
        name = "PLANE" if text.startswith("PLANE") else text.partition(".")[0]
        is_header = text.partition(".")[2].startswith("0")
        zero = state.zero if is_header else with_turn(state.zero, name, is_on=_ENDS.fullmatch(text) is None)
        return replace(state.lose(modes.axes, f"{_shown(block)} changes the coordinate system", block.span), zero=zero)
    if row.move is ZeroMove.SELECT:
        # Another preset ends shifts and turns; a line of a table of datums is one by its number.
        zero = {**modes.zero.first, WORK: ((text, 0),)}
        return replace(state.lose(modes.axes, f"{_shown(block)} changes the coordinate system", block.span), zero=zero)
    steps: Mapping[bool, dict[str, Decimal | None]] = {False: {}, True: {}}
    for each in _SHIFT.finditer(text.partition(".")[2]):
        value = None if each["number"] is None else Decimal(each["number"]) * state.unit.in_mm
        steps[bool(each["step"])][each["axis"].upper()] = None if Mode.UNIT in state.doubts else value
    for is_step, numbers in steps.items():
        if numbers:
            # An increment takes the place of what is in force by the sum of both.
            ways = {axis: (shift_in(state.zero, axis) if is_step else _NOTHING, by) for axis, by in numbers.items()}
            sums = {axis: None if old is None or by is None else old + by for axis, (old, by) in ways.items()}
            reason = f"{_shown(block)} changes the coordinate system"
            moved = shift_zero(state.zero, row.move, block, sums, modes.axes, reason)
            state = state_moved(state, moved, block.span)
    return state


def senses(blocks: Sequence[Block], state: State, modes: Modes) -> Iterator[tuple[int, int]]:
    """The indices of conventional arcs that begin in the direction of the block before them, and so have no DR: of
    those whose ends and begin are known, each with 1 (counter-clockwise) or -1."""
    direction: complex | None = None
    for index, block in enumerate(blocks):
        function, before = function_of(block), state
        state = follow(state, block, modes)
        way = before.step_to(state)
        if function in ("RND", "CHF", "CC", "FPOL", "FSELECT", "") or block.macro is not None:
            continue
        if way is None or abs(way) <= LENGTH:
            direction = None
        elif function in ("FC", "FCT"):
            # Where a free arc ends is still to be found.
            direction = None
        elif function in STRAIGHT:
            direction = way / abs(way)
        elif function in ("CT", "CTP"):
            turned = direction and way / abs(way) / direction
            if turned:
                yield index, 1 if turned.imag > 0 else -1
            direction = direction * turned**2 if direction and turned else None
        else:
            direction = _behind_arc(block, before, way)


def full_circles(blocks: Sequence[Block], state: State, modes: Modes) -> Iterator[int]:
    """The indices of arcs about CC that end where they begin, as far as that is known."""
    for index, block in enumerate(blocks):
        before, state = state, follow(state, block, modes)
        way = before.step_to(state)
        if way is not None and abs(way) <= LENGTH and function_of(block) in ABOUT_CENTER:
            yield index


def _behind_arc(block: Block, before: State, way: complex) -> complex | None:
    """The direction in which an arc about a centre or with a radius ends."""
    sense, radius, pole = block.find("DR"), block.find("R"), pole_of(before, CENTER)
    if sense is None or not sense.number:
        return None
    sign = 1 if sense.number > 0 else -1
    size = LEXICON.value(radius, before.unit) if radius is not None else None
    first, second = before.start().values
    if size is not None:
        half = way / 2
        height = max(float(size) ** 2 - abs(half) ** 2, 0.0) ** 0.5
        center = half + sign * (1 if size > 0 else -1) * 1j * half / abs(half) * height
    elif pole is not None and first is not None and second is not None:
        center = complex(float(pole[0] - first), float(pole[1] - second))
    else:
        return None
    spoke = way - center
    return sign * 1j * spoke / abs(spoke) if spoke else None
