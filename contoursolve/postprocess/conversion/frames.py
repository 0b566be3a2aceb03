"""The coordinate systems of a program and of the one that is written: a block is read in another one behind what moves,
turns or mirrors the coordinate system and is not converted."""

from collections.abc import Mapping
from decimal import Decimal

from msgspec import Struct

from contoursolve.comparison import Motion
from contoursolve.postprocess.conversion.program_lines import ProgramLine
from contoursolve.reading import WORK, Control, Effect, ZeroMove, axis_words, rows_of, shift_in, turns_in

_NOTHING = Decimal(0)
_OF_TABLES = (ZeroMove.OTHER, ZeroMove.DATA, ZeroMove.LATER)


class FramePart(Struct, frozen=True):
    """A part of the coordinate system: its value, and the line of the program that gave it."""

    value: object
    line: ProgramLine | None = None


class Frames:
    """Both coordinate systems, part by part: the work offset, shifts by their axis (mm), and what turns them."""

    def __init__(self, source: Control) -> None:
        self.modes = source.modes
        zero = source.modes.zero.first
        self.source: dict[str, FramePart] = {WORK: FramePart(zero.get(WORK))}
        self.target = dict(self.source)
        self.is_begun = False
        """Tells whether a motion is behind it: before the first one, an operator sets the datum."""

    def take(self, line: ProgramLine) -> dict[str, FramePart]:
        """Take what a line of the program changes, and return that."""
        before, zero, changed = self.source, line.after.zero, dict[str, FramePart]()
        values = {axis: shift_in(zero, axis) for axis in self.modes.axes}
        values |= self._presets(line)
        found: dict[str, object] = {axis: value for axis, value in values.items() if value is not None}
        found |= {WORK: zero[WORK]} if WORK in zero else {}
        turning, data = turns_in(zero), self._data_of(line)
        found |= {_turn(name): name in turning for name in {*turning, *turns_in(line.before.zero)}}
        found |= {_turn(data): True} if data else {}
        for name, value in found.items():
            if before.get(name, FramePart(_first(name))).value != value:
                changed[name] = FramePart(value, line)
        self.source = {**before, **changed}
        if not self.is_begun:
            # The operator sets the datum for that of a program which has not moved yet.
            self.target |= {name: each for name, each in changed.items() if name in (WORK, _turn(data))}
        self.is_begun = self.is_begun or any(each.motion is not Motion.PRESET for each in line.travels)
        return changed

    def convert(self, changed: Mapping[str, FramePart]) -> None:
        """Take over into the new program what a line changed."""
        self.target |= changed

    def convert_shifts(self) -> None:
        """Take over all shifts in force into the new program."""
        self.target |= {name: each for name, each in self.source.items() if name in self.modes.axes}

    def shifts(self) -> dict[str, float]:
        """The shifts of the program in force, mm by axis."""
        found = ((axis, self.source.get(axis, FramePart(_NOTHING)).value) for axis in self.modes.axes)
        return {axis: float(at) for axis, at in found if isinstance(at, Decimal)}

    def shift(self) -> dict[str, float]:
        """The way from where the program's block leads to its coordinates in the new one, mm by axis."""
        found = dict[str, float]()
        for axis in self.modes.axes:
            own, new = (part.get(axis, FramePart(_NOTHING)).value for part in (self.source, self.target))
            if isinstance(own, Decimal) and isinstance(new, Decimal) and own != new:
                found[axis] = float(own - new)
        return found

    def differs_by(self) -> ProgramLine | None:
        """The line by which the coordinates of both are read otherwise than by a shift; None for none."""
        for name in {**self.source, **self.target}:
            own, new = (part.get(name, FramePart(_first(name))) for part in (self.source, self.target))
            if name not in self.modes.axes and own.value != new.value:
                return own.line or new.line
        return None

    def _presets(self, line: ProgramLine) -> dict[str, Decimal | None]:
        """The shifts by a block that states where the tool is: of axes of which that was known, and has moved."""
        if not any(code.effect is Effect.PRESET for code in rows_of(line.block, self.modes)):
            return {}
        found = dict[str, Decimal | None]()
        for word in axis_words(line.block, self.modes):
            axis = self.modes.lexicon.addresses[word.address].axis
            own, new = line.before.axes[axis].value, line.after.axes[axis].value
            at = self.source.get(axis, FramePart(_NOTHING)).value
            if own is not None and new is not None and isinstance(at, Decimal):
                found[axis] = at + own - new
        return found

    def _data_of(self, line: ProgramLine) -> str:
        """The text of a block that changes numbers of work offsets, or states a place that was not known."""
        block, modes = line.block, self.modes
        for row, _ in modes.zero.rows_in(block):
            entries = row.entries(block, modes.axes) if row.entries is not None else ()
            is_work = row.group == WORK or any(each.group == WORK for each in entries)
            if row.move in _OF_TABLES and is_work:
                return block.text.strip()
        is_preset = any(code.effect is Effect.PRESET for code in rows_of(block, modes))
        words = axis_words(block, modes) if is_preset else ()
        rows = [modes.lexicon.addresses[word.address].axis for word in words]
        return block.text.strip() if any(line.before.axes[axis].value is None for axis in rows) else ""


def _turn(name: str) -> str:
    return f"turned by {name}"


def _first(name: str) -> object:
    """The value of a part that nothing has changed yet."""
    return None if name == WORK else False if name.startswith(_turn("")) else _NOTHING
