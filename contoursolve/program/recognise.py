"""For which control a program is: as its name says, or as its blocks show."""

from collections.abc import Iterable, Mapping

from contoursolve.controls import DIALECTS
from contoursolve.diagnosis.wording import join
from contoursolve.gcode import Block, Program
from contoursolve.program.project import CONTROL, check_settings, configure
from contoursolve.reading.dialect import Dialect


class UnknownControlError(ValueError):
    """The program does not tell which control it is for; the message lists the choices, and so does `choices`."""

    def __init__(self, message: str, choices: Iterable[str] = DIALECTS) -> None:
        super().__init__(message)
        self.choices = tuple(choices)


def choose(
    control: str | Dialect | None, program: Program, settings: Mapping[str, str] | None = None
) -> Dialect | None:
    """The control of this name, or that is given as its tables, or else the one that a program is written for; with
    those of the settings by `control.name` that are about it. None if no block shows the control.

    Raises UnknownControlError, which lists the choices, if there is no such control or the program shows several, and
    SettingError if there is no such setting.
    """
    control = control or (settings or {}).get(CONTROL)
    found = control if isinstance(control, Dialect) else find_dialect(control) if control else recognise(program.blocks)
    if found is None:
        check_settings(settings or {})
        return None
    return configure(found, settings)


def find_dialect(control: str) -> Dialect:
    """The control of this name. Raises UnknownControlError, which lists the choices."""
    if control not in DIALECTS:
        raise UnknownControlError(f"unknown control {control!r}; choose from {', '.join(DIALECTS)}")
    return DIALECTS[control]


class Recogniser:
    """For which control the blocks of a program are, as far as they show."""

    def __init__(self) -> None:
        self.signs: dict[str, str] = {}
        """What first showed each control, by its name."""
        self._excluded: set[str] = set()
        self._plane = 17

    def look(self, block: Block) -> None:
        """Take a block into account."""
        codes = (word.number for word in block.words if word.address == "G")
        self._plane = next((int(code) for code in codes if code in _PLANES), self._plane)
        for name, dialect in DIALECTS.items():
            if name not in self.signs:
                sign = sign_of(block, dialect)
                if sign:
                    self.signs[name] = sign
            if dialect.excludes and name not in self._excluded and dialect.excludes(block, self._plane):
                self._excluded.add(name)

    @property
    def is_sure(self) -> bool:
        """Whether the words that showed a control are its own."""
        return any(DIALECTS[name].excludes is None for name in self.signs)

    def find(self) -> Dialect | None:
        """The control; None if no block shows it. Raises UnknownControlError if they show more than one."""
        fitting = [name for name in DIALECTS if name in self.signs and name not in self._excluded]
        if len(fitting) == 1:
            return DIALECTS[fitting[0]]
        if self.signs:
            raise several_controls({name: self.signs[name] for name in fitting or self.signs})
        return None


_PLANES = (17, 18, 19)


def recognise(blocks: Iterable[Block]) -> Dialect | None:
    """The control that a program is written for; None if no block shows it.

    Raises UnknownControlError if its blocks show more than one.
    """
    recogniser = Recogniser()
    for block in blocks:
        recogniser.look(block)
    return recogniser.find()


def several_controls(signs: Mapping[str, str]) -> UnknownControlError:
    """That blocks show more than one control; `signs` say what shows each."""
    by_sign: dict[str, list[str]] = {}
    for name in DIALECTS:
        if name in signs:
            by_sign.setdefault(signs[name], []).append(name)
    places = "; ".join(f"{' or '.join(names)} by {sign}" for sign, names in by_sign.items())
    reads = "; ".join(f"{name} has {DIALECTS[name].contours}" for name in DIALECTS if name in signs)
    return UnknownControlError(
        f"the program looks like more than one control ({places}); {reads}",
        [name for name in DIALECTS if name in signs],
    )


def what_shows(blocks: Iterable[Block], dialect: Dialect) -> str:
    """What first shows that blocks are for a control; empty if nothing does."""
    return next((sign for block in blocks for sign in [sign_of(block, dialect)] if sign), "")


def sign_of(block: Block, dialect: Dialect) -> str:
    """What shows that a block is for a control; empty if nothing does."""
    words = dialect.signs(block)
    return f"{join([word.text.strip() for word in words])} in program line {block.line}" if words else ""
