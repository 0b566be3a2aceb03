"""The arguments of a call that have no decimal point: what they count, which each control says in its own way."""

from collections.abc import Iterable

from msgspec.structs import replace

from contoursolve.execution import ANGLE_INCREMENT, LENGTH_INCREMENT, Limit, Machine, Surroundings, machine_of
from contoursolve.gcode import Block, Program
from contoursolve.geometry import Length, Unit
from contoursolve.reading.lexicon import Effect
from contoursolve.reading.modal_state import Modes

ARGUMENTS = "macro-arguments"
"""The name of the setting: `whole` where they mean what they say."""


def unit_of_calls(blocks: Iterable[Block], modes: Modes, unit: Length) -> Length | None:
    """The unit in which a program calls, where it begins in another one; None where it changes."""
    units = {
        row.unit
        for block in blocks
        for word in block.words
        if word.address == "G" and (row := modes.codes.get(word.number))  # type: ignore[call-overload]
        if row.effect is Effect.UNITS
    }
    return next(iter(units or {unit})) if len(units) <= 1 else None


def machine_in(
    program: Program, modes: Modes, around: Surroundings, unit: Length, limit: Limit | None = None
) -> Machine | None:
    """The machine that runs a program, which begins in a unit, for a control; None for one that neither calls, jumps
    nor computes."""
    machine = machine_of(program, modes.language, modes.syntax, around, limit)
    if machine is None or not any("65" in block.text or "66" in block.text for block in program.blocks):
        return machine
    values = {**around.values, **_increments(program.blocks, modes, unit)}
    return machine_of(program, modes.language, modes.syntax, replace(around, values=values), limit)


def _increments(blocks: Iterable[Block], modes: Modes, unit: Length) -> dict[str, float]:
    """The units of lengths and angles that are arguments without a decimal point; nothing where that is not known."""
    numbers, here = modes.lexicon.numbers, unit_of_calls(blocks, modes, unit)
    names = {LENGTH_INCREMENT.name: Unit.MM, ANGLE_INCREMENT.name: Unit.DEGREE}
    if modes.settings.get(ARGUMENTS) == "whole":
        return dict.fromkeys(names, 1.0)
    return {name: float(numbers.step(kind, here)) for name, kind in names.items()} if here is not None else {}
