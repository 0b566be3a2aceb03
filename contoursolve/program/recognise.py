"""For which control a program is: as its name says, or as its blocks show."""

import re
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import islice

from contoursolve.controls import DIALECTS
from contoursolve.diagnosis import either, join
from contoursolve.diagnostics import ProgramError
from contoursolve.gcode import (
    ISO,
    Block,
    Passage,
    Program,
    Syntax,
    Word,
    blocks_in,
    in_passages,
    late_pattern,
    motion_of,
    telling,
    words_of,
)
from contoursolve.program.project_file import CONTROL, FIRST_LINES, check_settings, configure, stated_settings
from contoursolve.reading import Dialect, ReadIssue, Taken


class UnknownControlError(ProgramError, ValueError):
    """The program does not tell which control it is for; the message lists the choices, and so does `choices`.

    `said` is the message alone; `readings` are what the choices read differently, a line for each, which end the text.
    """

    def __init__(self, said: str, choices: Iterable[str] = DIALECTS, readings: Iterable[str] = ()) -> None:
        self.said, self.choices, self.readings = said, tuple(choices), tuple(readings)
        super().__init__(self.text())

    def text(self, way: str = "") -> str:
        """The message, with what to do after it."""
        return "\n".join((self.said + way, *(f"  {each}" for each in self.readings)))


class SeveralControlsError(UnknownControlError):
    """Words of a program are those of several controls: `choices`, which may read it alike."""


def choose(
    control: str | Dialect | None,
    program: Program,
    settings: Mapping[str, str] | None = None,
    recognise_by: Callable[[Iterable[Block]], Dialect | None] | None = None,
) -> Dialect | None:
    """The control of this name, or that is given as its tables, or else the one that a program states in a comment or
    is written for; with those of the settings by `control.name` that are about it. None if no block shows the control.
    Blocks are recognised by `recognise`, or by another way that is given.

    Raises UnknownControlError, which lists the choices, if there is no such control or the program shows several, and
    SettingError if there is no such setting.
    """
    # Tables that are given say all of a control: what the program states of it is in them already.
    stated = {} if isinstance(control, Dialect) else stated_settings(block.text for block in program.blocks)
    own = stated | dict(settings or {})
    found = named_control(control, own) or (recognise_by or recognise)(program.blocks)
    if found is None:
        check_settings(own)
        return None
    configured = configure(found, own)
    return (
        configured
        if isinstance(control, Dialect)
        else for_machine(configured, own, (each.text for each in in_passages(program.blocks)))
    )


def for_machine(dialect: Dialect, settings: Mapping[str, str], lines: Iterable[str]) -> Dialect:
    """A control that is on mills and on lathes, for the kind of machine that a program is for, if nothing states it: a
    lathe where X and Z move alone and no plane is selected."""
    turned = for_kind(dialect, settings, "lathe")
    if turned is dialect or not _is_turned(lines, dialect.modes.syntax):
        return dialect
    told = Taken(ReadIssue.MACHINE_TAKEN, {"setting": f"{dialect.name}.{_MACHINE}"})
    return replace(turned, taken=(*turned.taken, told))


def for_kind(dialect: Dialect, settings: Mapping[str, str], kind: str) -> Dialect:
    """A control that is on mills and on lathes, for one of these kinds of machine, if no setting states it."""
    name = f"{dialect.name}.{_MACHINE}"
    is_open = name not in settings and any(each.name == _MACHINE for each in dialect.settings)
    return configure(dialect, {name: kind}) if is_open else dialect


def _is_turned(lines: Iterable[str], syntax: Syntax) -> bool:
    """Whether X and Z move, no line has Y, and none selects a plane."""
    axes = set[str]()
    for line in lines:
        if axes == TURNED_AXES and not _MAY_BE_MILL.search(line):
            continue
        shown = shown_of_machine(line, syntax)
        if shown & _OF_NO_LATHE:
            return False
        axes |= shown
    return axes == TURNED_AXES


def shown_of_machine(line: str, syntax: Syntax) -> frozenset[str]:
    """The axes of a line, and the codes of planes, as far as it may show for which kind of machine a program is."""
    found = _OF_MACHINE.findall(syntax.comment.sub(" ", line)) if _OF_MACHINE.search(line) else ()
    return frozenset(each.upper().replace("G0", "G") for each in found)


_MACHINE = "machine"
_OF_MACHINE = late_pattern(r"(?<![A-Z_$\[,])(?:[XYZ](?=\s*[-+.=\d])|G0?1[789](?!\d))", re.IGNORECASE)
TURNED_AXES = frozenset({"X", "Z"})
"""The axes of a lathe."""

_MAY_BE_MILL = re.compile(r"Y|G0?1[789]", re.IGNORECASE)
_OF_NO_LATHE = frozenset({"Y", "G17", "G18", "G19"})


def named_control(control: str | Dialect | None, settings: Mapping[str, str] | None) -> Dialect | None:
    """The control of this name, or that is given as its tables, or else the one that the settings name; None if nothing
    names one. Raises UnknownControlError, which lists the choices."""
    wanted = control or (settings or {}).get(CONTROL)
    return wanted if isinstance(wanted, Dialect) else find_dialect(wanted) if wanted else None


def find_dialect(control: str) -> Dialect:
    """The control of this name. Raises UnknownControlError, which lists the choices."""
    if control not in DIALECTS:
        raise UnknownControlError(f"unknown control {control!r}; choose from {', '.join(DIALECTS)}")
    return DIALECTS[control]


def shown_by(block: Block, known: Container[str] = ()) -> frozenset[str]:
    """Signs of the control in a block: words of several controls, moving axes of a lathe, and marks of a mill or a
    lathe. `own` and `sign` with the name of a control are words of it alone. A control that is `known` by its own words
    is not looked for."""
    if ISO.plain.one.fullmatch(block.text):
        return _shown_plainly(words_of(block.text))
    stated = {word.address for word in block.words}
    codes = {word.number for word in block.words if word.address == "G"}
    shown = {*(stated & _SHARED), *(_TURNED[address] for address in stated & _TURNED.keys())}
    if codes & _PLANES:
        shown.add(PLANE)
    # G90 is a turning cycle of a lathe, but not beside a motion or a plane.
    is_absolute = _ABSOLUTE in codes and bool(codes & _BESIDE_ABSOLUTE)
    if is_absolute or codes & _OF_A_MILL or "Y" in stated:
        shown.add(_MILLED)
    if stated & {"Z", "W"} and stated & _SHARED:
        shown.add(_CORNER_ON_Z)
    for dialect in DIALECTS.showing(block.text):
        words = () if f"own {dialect.name}" in known else _signs(dialect, block)
        if words:
            shown.add(f"sign {dialect.name}")
        if any(word.address not in _SHARED for word in words):
            shown.add(f"own {dialect.name}")
    return frozenset(shown)


def _shown_plainly(words: str) -> frozenset[str]:
    """The same of the words of plain lines: what they show is which axes there are."""
    axes = [axis for address, axis in _TURNED.items() if address in words]
    return frozenset([*axes, _MILLED] if "Y" in words else axes)


def _signs(dialect: Dialect, block: Block) -> list[Word]:
    """The words of a block that show a control."""
    return [word for word in dialect.signs(block) if word.address not in dialect.rare]


class Recogniser:
    """For which control the blocks of a program are, as far as they show."""

    def __init__(self) -> None:
        self.signs: dict[str, str] = {}
        """What first showed each control, by its name."""
        self.begun: Dialect | None = None
        """The control whose programs alone begin as this one does."""
        self._own: set[str] = set()
        """The controls that words of their own showed."""
        self._shown: set[str] = set()
        self._is_turned = False

    def look(self, line: Block | Passage) -> None:
        """Take a block, or plain lines, into account."""
        if isinstance(line, Block):
            self.take(line, shown_by(line, self._shown))
            return
        all_of_them = _shown_plainly(words_of(line.text, line.syntax))
        for block in blocks_in(line):
            if all_of_them <= self._shown:
                break
            self.take(block, shown_by(block, self._shown))

    def take(self, block: Block, shown: frozenset[str]) -> None:
        """The same for a block of which it is known what it shows."""
        if shown <= self._shown:
            return
        self.begun = self.begun or begun_by(block)
        for name in DIALECTS:
            if f"sign {name}" in shown and name not in self.signs:
                self.signs[name] = _sign(_signs(DIALECTS[name], block), block)
            if f"own {name}" in shown:
                self._own.add(name)
        self._shown |= shown
        self._is_turned |= _CORNER_ON_Z in shown and PLANE not in self._shown

    @property
    def may_turn(self) -> bool:
        """Whether it may be the program of a lathe, though no word shows a control."""
        return self._shown >= {*_TURNED.values()} and _MILLED not in self._shown

    @property
    def is_sure(self) -> bool:
        """Whether a word that only one control has showed it."""
        return bool(self._own)

    def find(self) -> Dialect | None:
        """The control; None if no block shows it. Raises UnknownControlError if they show more than one."""
        if self.begun is not None:
            return self.begun
        fitting = [name for name in DIALECTS if name in (self._own or self.signs) and self._fits(DIALECTS[name])]
        if len(fitting) == 1 and (fitting == [*self._own] or not self._own):
            return DIALECTS[fitting[0]]
        if self.signs:
            shown = {name: self.signs[name] for name in (not self._own and fitting) or self.signs}
            raise several_controls(shown, SeveralControlsError if shown.keys() <= {*fitting} else UnknownControlError)
        return None

    def _fits(self, dialect: Dialect) -> bool:
        """Whether it has all the words, and is for such a machine: a program for a mill that selects no plane has
        contours in X and Y."""
        shared = self._shown & _SHARED
        if not shared <= dialect.modes.lexicon.addresses.keys() - dialect.rare:
            return False
        if dialect.name in self._own:
            return True
        is_lathe = any(dialect.plane.diameters)
        # A program that moves X and Z alone is that of a lathe.
        is_turned = self._is_turned or (PLANE not in self._shown and self._shown >= {*_TURNED.values()})
        is_milled = _MILLED in self._shown
        return not is_milled if is_lathe else is_milled or not is_turned


_SHARED = frozenset({",A", ",C", ",R"})
_MILLED, PLANE, _CORNER_ON_Z = "milled", "plane", "corner on Z"
_TURNED = {"X": "X", "U": "X", "Z": "Z", "W": "Z"}
_PLANES, _OF_A_MILL = frozenset({17, 18, 19}), frozenset({17, 19, 91})
_BEGIN = "PGM"
_ABSOLUTE, _BESIDE_ABSOLUTE = 90, frozenset({0, 1, 18})


def recognise(blocks: Iterable[Block]) -> Dialect | None:
    """The control that a program is written for; None if no block shows it.

    Raises UnknownControlError if its blocks show more than one.
    """
    recogniser = Recogniser()
    for line in in_passages(blocks):
        recogniser.look(line)
        if recogniser.begun is not None:
            break
    return recogniser.find()


def turned_with_corners(blocks: Iterable[Block]) -> tuple[str, ...]:
    """The lathes whose programs a program may be that shows no control, as it has I, K or R beside the only axis of a
    line: there they make a corner."""
    motion, has_corners, axes = -1, False, set[str]()
    for block in in_passages(blocks):
        if isinstance(block, Passage):
            words = words_of(block.text, block.syntax)
            if "Y" in words:
                return ()
            axes |= _shown_plainly(words)
            stated_motion = motion_of(words)
            motion = motion if stated_motion is None else stated_motion
            continue
        stated = {word.address for word in block.words}
        codes = [int(word.number) for word in block.words if word.address == "G" and word.number is not None]
        motion = next((code for code in codes if code in _MOTIONS), -1 if _CYCLES.intersection(codes) else motion)
        if "Y" in stated or _PLANES_OF_A_MILL.intersection(codes):
            return ()
        moved = {_TURNED[address] for address in stated & _TURNED.keys()}
        axes |= moved
        has_corners |= motion == 1 and len(moved) == 1 and bool(stated & CORNERS_WITHOUT_COMMA)
    is_turned = has_corners and axes == {*_TURNED.values()}
    # A table of corner words says all of them: without I, K and R these make none.
    return tuple(
        name
        for name, each in DIALECTS.items()
        if is_turned and any(each.plane.diameters) and {word for word, *_ in each.corners} <= CORNERS_WITHOUT_COMMA
    )


def may_make_corner(line: str) -> bool:
    """Whether a line has a letter that may make a corner without a comma."""
    return not CORNERS_WITHOUT_COMMA.isdisjoint(line.upper())


CORNERS_WITHOUT_COMMA = frozenset("IKR")
"""Addresses of words that make a corner without a comma, beside the only axis of a line on a lathe."""
_MOTIONS, _PLANES_OF_A_MILL = range(4), frozenset({17, 19})
_CYCLES = frozenset({*range(32, 36), *range(65, 68), *range(70, 95)})
"""Codes in whose blocks, and behind them, I, K and R mean something else."""


def begun_by(block: Block) -> Dialect | None:
    """The control whose programs alone begin with such a line."""
    # Nearly no line has the word that all of these have.
    if _BEGIN not in block.text.upper():
        return None
    return next((each for each in DIALECTS.showing(block.text) if _begins(each.signs(block))), None)


def begins_for_another(blocks: Iterable[Block], dialect: Dialect) -> bool:
    """Whether blocks begin as a program of another control does."""
    return any(begun_by(block) and not _begins(dialect.signs(block)) for block in islice(blocks, FIRST_LINES))


def _begins(words: Sequence[Word]) -> bool:
    return bool(words) and words[0].address == _BEGIN


def several_controls(
    signs: Mapping[str, str], kind: type[UnknownControlError] = UnknownControlError
) -> UnknownControlError:
    """That blocks show more than one control; `signs` say what shows each."""
    by_sign: dict[str, list[str]] = {}
    for name in DIALECTS:
        if name in signs:
            by_sign.setdefault(signs[name], []).append(name)
    places = "; ".join(f"{either(names)} by {sign}" for sign, names in by_sign.items())
    reads = "; ".join(f"{name} has {DIALECTS[name].contours}" for name in DIALECTS if name in signs)
    return kind(
        f"the program looks like more than one control ({places}); {reads}",
        [name for name in DIALECTS if name in signs],
    )


def what_shows(blocks: Iterable[Block], dialect: Dialect) -> str:
    """The first sign that blocks are for a control; empty if there is none."""
    return next((sign for block in telling(blocks) for sign in [sign_of(block, dialect)] if sign), "")


def first_signs(blocks: Iterable[Block], own: str) -> dict[str, str]:
    """The first sign of each control but one, by its name; the search ends behind the begin of a program."""
    found, rest = dict[str, str](), {*DIALECTS}
    for block in telling(blocks):
        showing = (each for each in DIALECTS.showing(block.text) if each.name in rest)
        signs = {each.name: words for each in showing if (words := each.signs(block))}
        begun = [name for name, words in signs.items() if _begins(words)]
        found |= {name: _sign(words, block) for name, words in signs.items()}
        if begun:
            rest, found = set(), {name: found[name] for name in begun}
        rest -= found.keys()
        if not rest:
            break
    return {name: found[name] for name in DIALECTS if name in found and name != own}


def sign_of(block: Block, dialect: Dialect) -> str:
    """The sign that a block is for a control; empty if there is none."""
    words = dialect.signs(block)
    return _sign(words, block) if words else ""


def sign_against(block: Block, dialect: Dialect, other: Dialect) -> str:
    """The sign that a block is for another control and that is no word of this one; empty if there is none."""
    own = dialect.modes.lexicon.addresses
    foreign = [word for word in _signs(other, block) if word.address not in _SHARED or word.address not in own]
    return _sign(foreign, block) if foreign else ""


def _sign(words: Sequence[Word], block: Block) -> str:
    where = f"program line {block.line} of {block.file}" if block.file else f"program line {block.line}"
    return f"{join([word.text.strip() for word in words])} in {where}"
