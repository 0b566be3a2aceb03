"""For which control a program is: as its name says, or as its blocks show."""

from collections.abc import Iterable, Mapping

from contoursolve.controls import DIALECTS
from contoursolve.diagnosis.wording import join
from contoursolve.gcode import Block, Program
from contoursolve.program.project import check_settings, configure
from contoursolve.reading.dialect import Dialect


class UnknownControlError(ValueError):
    """The program does not tell which control it is for; the message lists the choices."""


def choose(
    control: str | Dialect | None, program: Program, settings: Mapping[str, str] | None = None
) -> Dialect | None:
    """The control of this name, or that is given as its tables, or else the one that a program is written for; with
    those of the settings by `control.name` that are about it. None if no block shows the control.

    Raises UnknownControlError, which lists the choices, if there is no such control or the program shows several, and
    SettingError if there is no such setting.
    """
    found = control if isinstance(control, Dialect) else find_dialect(control) if control else recognise(program)
    if found is None:
        check_settings(settings or {})
        return None
    return configure(found, settings)


def find_dialect(control: str) -> Dialect:
    """The control of this name. Raises UnknownControlError, which lists the choices."""
    if control not in DIALECTS:
        raise UnknownControlError(f"unknown control {control!r}; choose from {', '.join(DIALECTS)}")
    return DIALECTS[control]


def recognise(program: Program) -> Dialect | None:
    """The control that a program is written for; None if no block shows it.

    Raises UnknownControlError if its blocks show more than one.
    """
    shown: list[Dialect] = []
    for block in program.blocks:
        shown += [each for each in DIALECTS.values() if each not in shown and each.signs(block)]
    shown.sort(key=list(DIALECTS.values()).index)
    if len(shown) > 1:
        raise several_controls({each.name: what_shows(program.blocks, each) for each in shown})
    return shown[0] if shown else None


def several_controls(signs: Mapping[str, str]) -> UnknownControlError:
    """That blocks show more than one control; `signs` say what shows each."""
    places = ", ".join(f"{name} by {signs[name]}" for name in DIALECTS if name in signs)
    return UnknownControlError(f"the program looks like more than one control ({places})")


def what_shows(blocks: Iterable[Block], dialect: Dialect) -> str:
    """What first shows that blocks are for a control; empty if nothing does."""
    return next((sign for block in blocks for sign in [sign_of(block, dialect)] if sign), "")


def sign_of(block: Block, dialect: Dialect) -> str:
    """What shows that a block is for a control; empty if nothing does."""
    words = dialect.signs(block)
    return f"{join([word.text.strip() for word in words])} in program line {block.line}" if words else ""


def first_sign(blocks: Iterable[Block]) -> Dialect | None:
    """The control that the first block that shows any is written for."""
    return next((dialect for block in blocks for dialect in DIALECTS.values() if dialect.signs(block)), None)
