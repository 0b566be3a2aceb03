"""For which control a program is: as its name says, or as its blocks show."""

import re
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import islice

from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import either, join
from contoursolve.diagnostics import ProgramError, did_you_mean
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
from contoursolve.reading import (
    NAMED_FILE,
    POLAR_WORDS,
    SEMICOLON_COMMENT,
    Y_AXIS,
    Control,
    ReadIssue,
    Taken,
)


class UnknownControlError(ProgramError, ValueError):
    """The program does not tell which control it is for; the message lists the choices, and so does `choices`.

    `said` is the message alone; `readings` are what the choices read differently, a line for each, which end the text.
    """

    def __init__(self, said: str, choices: Iterable[str] = CONTROLS, readings: Iterable[str] = ()) -> None:
        self.said, self.choices, self.readings = said, tuple(choices), tuple(readings)
        super().__init__(self.text())

    def text(self, way: str = "") -> str:
        """The message, with what to do after it."""
        return "\n".join((self.said + way, *(f"  {each}" for each in self.readings)))


class SeveralControlsError(UnknownControlError):
    """Words of a program are those of several controls: `choices`, which may read it alike."""


def choose(
    control: str | Control | None,
    program: Program,
    settings: Mapping[str, str] | None = None,
    recognise_by: Callable[[Iterable[Block]], Control | None] | None = None,
) -> Control | None:
    """The control of this name, or that is given as its tables, or else the one that a program states in a comment or
    is written for; with those of the settings by `control.name` that are about it. None if no block shows the control.
    Blocks are recognised by `recognise`, or by another way that is given.

    Raises UnknownControlError, which lists the choices, if there is no such control or the program shows several, and
    SettingError if there is no such setting.
    """
    # Tables that are given say all of a control: what the program states of it is in them already.
    stated = {} if isinstance(control, Control) else stated_settings(block.text for block in program.blocks)
    own = stated | dict(settings or {})
    found = named_control(control, own) or (recognise_by or partial(recognise, name=program.name))(program.blocks)
    if found is None:
        check_settings(own)
        return None
    configured = configure(found, own)
    return (
        configured
        if isinstance(control, Control)
        else for_machine(configured, own, (each.text for each in in_passages(program.blocks)))
    )


def for_machine(control: Control, settings: Mapping[str, str], lines: Iterable[str]) -> Control:
    """A control that is on mills and on lathes, for the kind of machine that a program is for, if nothing states it: a
    lathe where X and Z move alone and no plane is selected."""
    turned = for_kind(control, settings, "lathe")
    shown = frozenset[str]() if turned is control else _shown_of_turning(lines, control.modes.syntax)
    if not shown:
        return control
    # A program that selects the plane and diameters says all that is taken of it.
    if "G18" in shown and shown & _DIAMETERS:
        return turned
    told = Taken(ReadIssue.MACHINE_TAKEN, {"setting": f"{control.name}.{_MACHINE}"})
    return replace(turned, taken=(*turned.taken, told))


def for_kind(control: Control, settings: Mapping[str, str], kind: str) -> Control:
    """A control that is on mills and on lathes, for one of these kinds of machine, if no setting states it."""
    name = f"{control.name}.{_MACHINE}"
    is_open = name not in settings and any(each.name == _MACHINE for each in control.settings)
    return configure(control, {name: kind}) if is_open else control


def _shown_of_turning(lines: Iterable[str], syntax: Syntax) -> frozenset[str]:
    """The marks of a lathe in lines: X and Z move and no line has Y, in a program that selects no plane or speaks of a
    lathe. Nothing for what may be another one."""
    shown = set[str]()
    for line in lines:
        if shown >= TURNED_AXES and not _MAY_TELL_MORE.search(line):
            continue
        shown |= shown_of_machine(line, syntax)
        if "Y" in shown:
            return frozenset()
    is_turned = shown >= TURNED_AXES and (bool(shown & _OF_A_LATHE) or not shown & _PLANE_CODES)
    return frozenset(shown if is_turned else ())


def shown_of_machine(line: str, syntax: Syntax) -> frozenset[str]:
    """The axes of a line, the codes of planes and the words of a lathe, as far as it may show for which kind of machine
    a program is."""
    found = _OF_MACHINE.findall(syntax.comment.sub(" ", line)) if _OF_MACHINE.search(line) else ()
    return frozenset(each.upper().replace("G0", "G") for each in found)


_MACHINE = "machine"
_OF_MACHINE = late_pattern(
    r"(?<![A-Z_$\[,])(?:[XYZ](?=\s*[-+.=\d])|G0?(?:1[789]|96[12]?)(?!\d)|DIAM(?:ON|90)\b|LIMS\b)", re.IGNORECASE
)
TURNED_AXES = frozenset({"X", "Z"})
"""The axes of a lathe."""

_MAY_TELL_MORE = re.compile(r"Y|G0?1[789]|96|DIAM|LIMS", re.IGNORECASE)
_PLANE_CODES = frozenset({"G17", "G18", "G19"})
_DIAMETERS = frozenset({"DIAMON", "DIAM90"})
_OF_A_LATHE = frozenset({"G96", "G961", "G962", "LIMS", *_DIAMETERS})


def named_control(control: str | Control | None, settings: Mapping[str, str] | None) -> Control | None:
    """The control of this name, or that is given as its tables, or else the one that the settings name; None if nothing
    names one. Raises UnknownControlError, which lists the choices."""
    wanted = control or (settings or {}).get(CONTROL)
    return wanted if isinstance(wanted, Control) else find_control(wanted) if wanted else None


def find_control(control: str) -> Control:
    """The control of this name. Raises UnknownControlError, which lists the choices."""
    if control not in CONTROLS:
        hint = did_you_mean(control, CONTROLS)
        if ":" in control:
            hint = "in Python, give the record itself, such as control=MY_LATHE, or "
        raise UnknownControlError(f"unknown control {control!r}; {hint}choose from {', '.join(CONTROLS)}")
    return CONTROLS[control]


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
    text = ISO.comment.sub(" ", block.text)
    kinds = {mark for mark, pattern in _KINDS.items() if pattern.search(text)}
    shown |= kinds | {f"sure {mark}" for mark in kinds if _SURE[mark].search(text)}
    shown |= {mark for mark, pattern in _OTHER_WORDS.items() if pattern.search(block.text)}
    if "Y" in stated:
        shown.add(Y_AXIS)
    if stated & {"Z", "W"} and stated & _SHARED:
        shown.add(_CORNER_ON_Z)
    for control in CONTROLS.showing(block.text):
        words = () if f"own {control.name}" in known else _signs(control, block)
        if words:
            shown.add(f"sign {control.name}")
        addresses = {word.address for word in words} - _SHARED
        if addresses:
            shown.add(f"{'own' if addresses - _OF_ARCS else 'arc'} {control.name}")
        if addresses and stated & _OF_CONTOURS and POLAR_WORDS not in shown:
            shown.add(f"sure {control.name}")
    return frozenset(shown)


def _shown_plainly(words: str) -> frozenset[str]:
    """The same of the words of plain lines: what they show is which axes there are."""
    shown = [axis for address, axis in _TURNED.items() if address in words]
    if "Y" in words:
        shown += [_MILLED, _MILL, Y_AXIS]
    elif "U" in words or "W" in words:
        shown.append(_LATHE)
    return frozenset(shown)


def _signs(control: Control, block: Block) -> list[Word]:
    """The words of a block that show a control."""
    return [word for word in control.signs(block) if word.address not in control.rare]


class Recogniser:
    """For which control the blocks of a program of this name are, as far as they show."""

    def __init__(self, name: str = "") -> None:
        self.signs: dict[str, str] = {}
        """What first showed each control, by its name."""
        self.begun: Control | None = None
        """The control whose programs alone begin as this one does."""
        self._own: set[str] = set()
        """The controls that words of their own showed."""
        self._arcs: set[str] = set()
        """The controls that words of an arc showed, which others have too, though not together."""
        self._shown: set[str] = {NAMED_FILE} if _OF_SINUMERIK.search(name) else set()
        self._is_turned = False

    @classmethod
    def of(cls, blocks: Iterable[Block], name: str) -> "Recogniser":
        """The recogniser of a program of this name, with its blocks up to one that only one control's programs have."""
        recogniser = cls(name)
        for line in in_passages(blocks):
            recogniser.look(line)
            if recogniser.begun is not None:
                break
        return recogniser

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
        for name in CONTROLS:
            if f"sign {name}" in shown and name not in self.signs:
                self.signs[name] = _sign(_signs(CONTROLS[name], block), block)
            if f"own {name}" in shown:
                self._own.add(name)
            if f"arc {name}" in shown:
                self._arcs.add(name)
        self._shown |= shown
        self._is_turned |= _CORNER_ON_Z in shown and PLANE not in self._shown

    @property
    def may_turn(self) -> bool:
        """Whether it may be the program of a lathe, though no word shows a control."""
        return self._shown >= {*_TURNED.values()} and (self._kind == _LATHE or _MILLED not in self._shown)

    @property
    def is_sure(self) -> bool:
        """Whether words that only one control has showed it, and no other line can exclude it."""
        return any(not CONTROLS[name].excluded_by for name in self._certain)

    @property
    def _certain(self) -> set[str]:
        """The controls that words showed which no other one has, or not together."""
        return {name for name in self._own or self._arcs if not self._is_excluded(name)}

    def _is_excluded(self, name: str) -> bool:
        """Whether the program is for another control, unless words that only this one has beside its sign say more."""
        return f"sure {name}" not in self._shown and bool(CONTROLS[name].excluded_by & self._shown)

    @property
    def _kind(self) -> str:
        """The kind of machine that words speak for; empty where none does, or both are spoken for alike."""
        kinds = self._shown & {_LATHE, _MILL}
        if len(kinds) > 1:
            # A lathe may have Y, and it drills.
            kinds = {each for each in kinds if f"sure {each}" in self._shown}
        return next(iter(kinds)) if len(kinds) == 1 else ""

    def find(self) -> Control | None:
        """The control; None if no block shows it. Raises UnknownControlError if they show more than one."""
        if self.begun is not None:
            return self.begun
        certain = self._certain
        signs = {name: each for name, each in self.signs.items() if not self._is_excluded(name)}
        fitting = [name for name in CONTROLS if name in (certain or signs) and self._fits(CONTROLS[name])]
        if len(fitting) == 1 and (fitting == [*certain] or not certain):
            return CONTROLS[fitting[0]]
        if signs:
            shown = {name: signs[name] for name in (not certain and fitting) or signs}
            raise several_controls(shown, SeveralControlsError if shown.keys() <= {*fitting} else UnknownControlError)
        return None

    def may_be(self, control: Control) -> bool:
        """Whether the program may be for a control, for all that it shows."""
        return self._fits(control) and not self._is_excluded(control.name)

    def _fits(self, control: Control) -> bool:
        """Whether it has all the words, and is for such a machine: a program for a mill that selects no plane has
        contours in X and Y."""
        shared = self._shown & _SHARED
        if not shared <= control.modes.lexicon.addresses.keys() - control.rare:
            return False
        if control.name in self._certain:
            return True
        is_lathe = any(control.plane.diameters)
        if self._kind:
            return is_lathe == (self._kind == _LATHE)
        # A program that moves X and Z alone is that of a lathe.
        is_turned = self._is_turned or (PLANE not in self._shown and self._shown >= {*_TURNED.values()})
        is_milled = _MILLED in self._shown
        return not is_milled if is_lathe else is_milled or not is_turned


_SHARED = frozenset({",A", ",C", ",R"})
_MILLED, PLANE, _CORNER_ON_Z = "milled", "plane", "corner on Z"
_TURNED = {"X": "X", "U": "X", "Z": "Z", "W": "Z"}
_PLANES, _OF_A_MILL = frozenset({17, 18, 19}), frozenset({17, 19, 91})
_OF_ARCS = frozenset("IJKR")
"""Words of arcs, which all controls have."""
_LATHE, _MILL = "lathe", "mill"
_KINDS = {
    _LATHE: late_pattern(
        r"(?<![A-Z_$\[,])(?:T\d{4}(?![\d.])|G0*50(?!\d).*S\s*\d|G0*96(?!\d)|[UW]\s*[-+.\d]|G0*71(?!\d).*P\s*\d.*Q\s*\d"
        r"|G0*76(?!\d).*P\s*\d{6}|G0*99(?!\d)(?!.*G0*(?:7[346]|8[1-9])(?!\d)))",
        re.IGNORECASE,
    ),
    _MILL: late_pattern(
        r"(?<![A-Z_$\[,])(?:Y\s*[-+.\d]|G0*43(?!\d).*H\s*\d|M0*6(?!\d)|G0*8[123](?!\d))", re.IGNORECASE
    ),
}
"""Words that speak for a kind of machine, on Fanuc and its kin: tools with their offset in one number, limits of the
spindle, constant cutting speed, increments by U and W, cycles that turn, feeds per turn; and of a mill Y, tool lengths,
tool changes, drilling. A plane, G90 or G95 speaks for neither (assumed, from real programs). Where both are spoken for,
the sure ones decide: limits of the spindle, constant cutting speed and turning cycles, or tool lengths."""
_SURE = {
    _LATHE: late_pattern(
        r"(?<![A-Z_$\[,])(?:G0*50(?!\d).*S\s*\d|G0*96(?!\d)|G0*71(?!\d).*P\s*\d.*Q\s*\d|G0*76(?!\d).*P\s*\d{6})",
        re.IGNORECASE,
    ),
    _MILL: late_pattern(r"(?<![A-Z_$\[,])G0*43(?!\d).*H\s*\d", re.IGNORECASE),
}
"""Those of them that no machine of the other kind has."""
_OF_CONTOURS = frozenset("ABCDIKPQRUW")
"""Words of a contour, which no pole has."""
_OTHER_WORDS = {
    POLAR_WORDS: late_pattern(r"(?<![A-Z_])[AR]P\s*=", re.IGNORECASE),
    SEMICOLON_COMMENT: late_pattern(r"^[^(]*;[ \t]*\w"),
}
_OF_SINUMERIK = late_pattern(r"\.[ms]pf$", re.IGNORECASE)
_BEGIN = "PGM"
_ABSOLUTE, _BESIDE_ABSOLUTE = 90, frozenset({0, 1, 18})


def recognise(blocks: Iterable[Block], name: str = "") -> Control | None:
    """The control that a program, of this name, is written for; None if no block shows it.

    Raises UnknownControlError if its blocks show more than one.
    """
    return Recogniser.of(blocks, name).find()


def has_arcs(text: str) -> bool:
    """Whether lines have a code of an arc."""
    return _ARC_CODE.search(text) is not None


def readers_of_arcs(program: Program) -> tuple[str, ...]:
    """The controls for which a program in G codes may be that shows none, as far as its axes, the words of a kind of
    machine and the word of a radius tell."""
    if not has_arcs(program.text):
        return ()
    recogniser = Recogniser.of(program.blocks, program.name)
    has_radius = _RADIUS.search(ISO.comment.sub(" ", program.text)) is not None
    return tuple(
        name
        for name, each in CONTROLS.items()
        if each.modes.arcs is not None and each.modes.arcs.read is None and recogniser.may_be(each)
        if not has_radius or each.modes.radius == "R"
    )


_ARC_CODE = late_pattern(r"(?<![A-Z_$])G0*[23](?!\d)", re.IGNORECASE)
_RADIUS = late_pattern(r"(?<![A-Z_$\[,])R\s*[-+.\d]", re.IGNORECASE)


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
        for name, each in CONTROLS.items()
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


def begun_by(block: Block) -> Control | None:
    """The control whose programs alone begin with such a line."""
    # Nearly no line has the word that all of these have.
    if _BEGIN not in block.text.upper():
        return None
    return next((each for each in CONTROLS.showing(block.text) if _begins(each.signs(block))), None)


def begins_for_another(blocks: Iterable[Block], control: Control) -> bool:
    """Whether blocks begin as a program of another control does."""
    return any(begun_by(block) and not _begins(control.signs(block)) for block in islice(blocks, FIRST_LINES))


def _begins(words: Sequence[Word]) -> bool:
    return bool(words) and words[0].address == _BEGIN


def several_controls(
    signs: Mapping[str, str], kind: type[UnknownControlError] = UnknownControlError
) -> UnknownControlError:
    """That blocks show more than one control; `signs` say what shows each."""
    by_sign: dict[str, list[str]] = {}
    for name in CONTROLS:
        if name in signs:
            by_sign.setdefault(signs[name], []).append(name)
    places = "; ".join(f"{either(names)} by {sign}" for sign, names in by_sign.items())
    reads = "; ".join(f"{name} has {CONTROLS[name].contours}" for name in CONTROLS if name in signs)
    return kind(
        f"the program looks like more than one control ({places}); {reads}",
        [name for name in CONTROLS if name in signs],
    )


def what_shows(blocks: Iterable[Block], control: Control) -> str:
    """The first sign that blocks are for a control; empty if there is none."""
    return next((sign for block in telling(blocks) for sign in [sign_of(block, control)] if sign), "")


def first_signs(blocks: Iterable[Block], own: str) -> dict[str, str]:
    """The first sign of each control but one, by its name; the search ends behind the begin of a program."""
    found, rest = dict[str, str](), {*CONTROLS}
    for block in telling(blocks):
        showing = (each for each in CONTROLS.showing(block.text) if each.name in rest)
        signs = {each.name: words for each in showing if (words := each.signs(block))}
        begun = [name for name, words in signs.items() if _begins(words)]
        found |= {name: _sign(words, block) for name, words in signs.items()}
        if begun:
            rest, found = set(), {name: found[name] for name in begun}
        rest -= found.keys()
        if not rest:
            break
    return {name: found[name] for name in CONTROLS if name in found and name != own}


def sign_of(block: Block, control: Control) -> str:
    """The sign that a block is for a control; empty if there is none."""
    words = control.signs(block)
    return _sign(words, block) if words else ""


def sign_against(block: Block, control: Control, other: Control) -> str:
    """The sign that a block is for another control and that is no word of this one; empty if there is none."""
    own = control.modes.lexicon.addresses
    foreign = [word for word in _signs(other, block) if word.address not in _SHARED or word.address not in own]
    return _sign(foreign, block) if foreign else ""


def _sign(words: Sequence[Word], block: Block) -> str:
    where = f"program line {block.line} of {block.file}" if block.file else f"program line {block.line}"
    return f"{join([word.text.strip() for word in words])} in {where}"
