"""A small reference interpreter of what a program means before its geometry begins: modal state, offsets, frames, calls
and types, for SINUMERIK and for Fanuc macros. Nothing of the package is used.

A value is a pair of numbers, as if the program ran twice: what is not known is drawn for each run, and what comes out
alike is known. A place is a value along each axis, in the coordinates of the machine.
"""

import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

AXES = "XYZ"
IDENTITY, NOWHERE = np.eye(3), np.zeros((3, 2))
_MODES = {17: ("plane", "XY"), 18: ("plane", "ZX"), 19: ("plane", "YZ"), 20: ("unit", 25.4), 21: ("unit", 1.0)}
_MODES |= {70: ("unit", 25.4), 71: ("unit", 1.0), 90: ("is_absolute", True), 91: ("is_absolute", False)}
_MODES |= {number: ("motion", number) for number in range(4)}


class Stopped(Exception):  # noqa: N818 - the control stops with an alarm, or a program of this kind is not drawn
    pass


Value = Place = np.ndarray
Ends = dict[str, tuple[Value, bool]]  # what words name, each with whether it is absolute
_draw = np.random.default_rng(0)


def lost(*size: int) -> Value:
    return _draw.uniform(-1e3, 1e3, (*size, 2))


def is_known(value: Value) -> bool:
    return bool(np.abs(value[..., 0] - value[..., 1]).max() < 1e-7)


def rounded(value: Value) -> Value:
    return np.floor(np.abs(value) + 0.5) * np.where(value >= 0, 1, -1)


_SMOOTH = {"add": np.add, "sub": np.subtract, "mul": np.multiply, "truediv": np.divide, "neg": np.negative}
_OPERATIONS = {"lt": np.less, "le": np.less_equal, "gt": np.greater, "ge": np.greater_equal, "mod": np.fmod}
_OPERATIONS |= {"eq": lambda a, b: np.isclose(a, b, rtol=1e-12, atol=0), "floordiv": lambda a, b: np.trunc(a / b)}
_OPERATIONS |= {"ne": lambda a, b: ~_OPERATIONS["eq"](a, b)}
_OPERATIONS |= {"and": np.logical_and, "or": np.logical_or, "xor": np.logical_xor, "invert": np.logical_not}
_WORKS = {"SIN": lambda a: np.sin(np.radians(a)), "COS": lambda a: np.cos(np.radians(a)), "ABS": np.abs}
_WORKS |= {"ROUND": rounded, "SQRT": lambda a: np.sqrt(a) if a[0] >= 0 else np.full(2, np.inf)}


@dataclass(eq=False)
class Cell:
    """A variable with its type, or a part of a formula; without a value (None) it counts as 0."""

    value: Value | None
    kind: str = "REAL"


def _of_cells(work: Callable[..., Value], *, is_smooth: bool = False) -> Callable[..., Cell]:
    """An operation; only of a smooth one comes something known where an operand is not."""

    def run(*parts: Cell) -> Cell:
        values = [np.zeros(2) if each.value is None else each.value for each in parts]
        if work is np.divide and not values[1].all():
            raise Stopped("division by 0")
        return Cell(work(*values) * 1.0 if is_smooth or all(map(is_known, values)) else lost())

    return run


for _name, _work in {**_SMOOTH, **_OPERATIONS}.items():
    setattr(Cell, f"__{_name}__", _of_cells(_work, is_smooth=_name in _SMOOTH))
# Python ranks its operators as both languages do: comparisons last, then or, xor, and, sums, products.
_SIGNS = {"AND": "&", "XOR": "^", "OR": "|", "NOT": "~", "DIV": "//", "MOD": "%", "<>": "!="}
_SIGNS |= {"EQ": "==", "NE": "!=", "GT": ">", "LT": "<", "GE": ">=", "LE": "<="}
_FUNCTIONS = {name: _of_cells(work) for name, work in _WORKS.items()} | {"plain": lambda at: Cell(np.full(2, at))}
_TOKEN = re.compile(r"#(?:(?P<number>\d+)|\()|(?P<name>[A-Z_$][\w$]*)|\d+\.?\d*|\.\d+|<>")


def _python(found: re.Match[str]) -> str:
    """What stands for a part of a formula."""
    token, (number, name) = found[0], found.groups()
    if token[0] == "#":
        return f"read(plain({number}))" if number else "read("
    if token in _SIGNS or token in _FUNCTIONS:
        return f" {_SIGNS.get(token, token)} "
    return f"read('{name}')" if name else f"plain({float(token)})"


class Modes(NamedTuple):
    """What SAVE brings back: the settable offset is `active`, and the programmable frame is from `shift` on."""

    plane: str
    diameter: str
    active: Place
    motion: int = 1
    unit: float = 1.0
    is_absolute: bool = True
    work: str = "?"
    shift: Place = NOWHERE
    coarse: Place = NOWHERE
    matrix: np.ndarray = IDENTITY
    is_plain: bool = True  # nothing but coarse shifts has been said of it


@dataclass
class Move:
    """A motion of a block; its zero, in places of the machine, and its corner: the word, and the size in mm."""

    line: int
    motion: int
    axes: str
    start: Place
    end: Place
    zero: tuple[np.ndarray, Place]
    corner: tuple[str, Value] | None = None
    angle: Value | None = None
    center: Place | None = None

    def seen(self, place: Place, zero: tuple[np.ndarray, Place]) -> Place:
        return moved(zero, place)[[*map(AXES.index, self.axes)]]


class Interpreter:
    """One run of a program; `decide` is asked where a condition is not known. Each language says in patterns what its
    comments, subprograms and assignments are, respells its lines as those that `flow` reads, and splits a block into
    names, texts and whether they are absolute, if they say so."""

    def __init__(self, text: str, decide: Callable[[], bool], *, is_turning: bool) -> None:
        self.lines, self.marks = list[str](), list[str]()
        for each in text.upper().split("\n"):
            number, line = re.match(r"(?:N0*(\d+) *)?(.*)", re.sub(self.comment, "", each).strip()).groups()
            for pattern, normal in self.spelled:
                line = re.sub(pattern, normal, line)
            self.lines.append(line)
            self.marks.append(line[:-1] if line.endswith(":") else number)
        self.heads = {found[1]: at for at, line in enumerate(self.lines) if (found := re.match(self.head, line))}
        self.decide, self.is_turning, self.line, self.steps, self.first = decide, is_turning, 0, 0, 0
        self.modes = Modes("ZX" if is_turning else "XY", self.diameter if is_turning else "DIAMOF", lost(3))
        self.moves, self.tools, self.tables = list[Move](), dict[str, str](), defaultdict[str, Place](lambda: lost(3))
        self.levels = [{name: Cell(lost()) for name in self.own_variables}]
        self.shared = {"TRUE": Cell(np.ones(2), "BOOL"), "FALSE": Cell(np.zeros(2), "BOOL")}
        self.others, self.local = np.zeros((2, 3, 2))
        """Shifts that no call brings back: tool, basic or external offset, reference point; and the local zero."""
        self.place, self.open, self.axes = lost(3), None, "XZ" if is_turning else "XYZ"

    def section(self, first: int) -> list[Move]:
        """Run the program, or a subprogram; all moves so far."""
        at, outer, line = first, self.first, self.line
        self.first = first
        while at < len(self.lines) and not re.fullmatch("M(0?2|17|30|99)|RET", self.lines[at]):
            self.steps, self.line = self.steps + 1, at + 1
            if self.steps > 3_000:
                raise Stopped("endless")
            at = self.flow(at, self.lines[at])
        self.first, self.line = outer, line
        return self.moves

    def flow(self, at: int, line: str) -> int:
        """Run a line; the index of the next one."""
        word = line.partition(" ")[0]
        if found := re.match(r"(?:IF (.+) )?GOTO([FB]?) ?(\w+)$", line):
            return at + 1 if found[1] and not self.is_true(found[1]) else self.label(found[3], at, found[2])
        if found := re.match(r"IF (.+) THEN (.+)", line):
            if self.is_true(found[1]):
                self.block(found[2])
        elif word in ("IF", "WHILE"):
            ends = ("ELSE", "ENDIF") if word == "IF" else ("ENDWHILE",)
            return at + 1 if self.is_true(line[len(word) :]) else self.match(at, 1, *ends) + 1
        elif word in ("ELSE", "ENDWHILE"):
            return self.match(at, 1, "ENDIF") + 1 if word == "ELSE" else self.match(at, -1, "WHILE")
        elif word in ("FOR", "ENDFOR"):
            head = at if word == "FOR" else self.match(at, -1, "FOR")
            name, start, last = re.match(r"FOR (\w+)=(.+) TO (.+)", self.lines[head]).groups()
            self.assign(name, self.value(start if word == "FOR" else f"{name}+1"))
            return head + 1 if self.is_true(f"{name}<={last}") else self.match(head, 1, "ENDFOR") + 1
        elif word == "UNTIL":
            return at + 1 if self.is_true(line[6:]) else self.match(at, -1, "REPEAT") + 1
        elif not re.match(r"(ENDIF|REPEAT|.*:)?$|PROC |EXTERN |O\d", line):
            self.block(line)
        return at + 1

    def match(self, at: int, way: int, *ends: str) -> int:
        """The index of the line that ends what begins here."""
        opens, closes, depth = ("IF", "WHILE", "FOR", "REPEAT"), ("ENDIF", "ENDWHILE", "ENDFOR", "UNTIL"), 0
        while True:
            at += way
            word = "" if re.match("IF .* (GOTO|THEN)", self.lines[at]) else self.lines[at].split(" ")[0]
            if depth == 0 and word in ends:
                return at
            depth += way * ((word in opens) - (word in closes))

    def label(self, name: str, at: int, way: str) -> int:
        """A label before or behind a line, or anywhere in this subprogram."""
        places = [place for place, mark in enumerate(self.marks) if mark == name]
        least = at + 1 if way else self.first
        return max(each for each in places if each <= at) if way == "B" else min(p for p in places if p >= least)

    def is_true(self, text: str) -> bool:
        value = self.value(text)
        return self.decide() if value is not None and not is_known(value) else value is not None and bool(value[0])

    def value(self, text: str) -> Value | None:
        plain = text.replace("[", "(").replace("]", ")").strip()
        return eval(_TOKEN.sub(_python, plain), _FUNCTIONS | {"read": self.read}).value

    def cell(self, name: str) -> Cell:
        """A variable of this level or of the main program; else it may be global data, which are known everywhere."""
        own = next((level[name] for level in (self.levels[-1], self.levels[0]) if name in level), None)
        return own or self.shared.setdefault(name, Cell(lost()))

    def assign(self, name: str, value: Value | None) -> None:
        self.cell(name).value = self.converted(value, self.cell(name).kind)

    def converted(self, value: Value | None, kind: str) -> Value | None:
        if kind != "REAL" and not is_known(value):
            return lost()
        return rounded(value) if kind == "INT" else (value != 0) * 1.0 if kind == "BOOL" else value

    def block(self, line: str) -> None:
        if found := re.fullmatch(self.assigned, line):
            self.assign(found[1], self.value(found[2]))
        else:
            self.words(line)

    def words(self, line: str) -> None:
        words = [*self.split(line)]
        codes = [float(text) for name, text, _ in words if name == "G"]
        texts = {name: text for name, text, _ in words}
        for number in codes:
            if number in _MODES:
                self.change(**{_MODES[number][0]: _MODES[number][1]})
            elif 54 <= number < 60 or number == 500 or 505 <= number <= 599:
                work = f"G{number:g}" + f"P{texts.get('P')}" * (number == 54.1)
                self.change(work=work, active=self.tables[work].copy())
        self.change_tool(codes, texts)
        ends, corner, angle = Ends(), None, None
        for name, text, way in words:
            is_used = name in (*AXES, *"IJKR", "RND", "CHR", "CHF", ",R", ",C", "ANG", ",A")
            value = self.number(text) if is_used else None
            if name in ("ANG", ",A"):
                angle = value
            elif len(name) == 1 and value is not None:
                ends[name] = value, self.modes.is_absolute if way is None else way
            elif value is not None:
                corner = name, value * self.modes.unit
        if own := {*codes} & {52, 53, 92, 153, 50 if self.is_turning else 92}:
            self.set_place(own, {AXES.index(axis): self.size(axis, ends[axis][0]) for axis in AXES if axis in ends})
        elif {*ends} & {*AXES} or angle is not None:
            self.go(ends, corner, angle)

    def change_tool(self, codes: Sequence[float], texts: Mapping[str, str]) -> None:
        told = {name: texts[name] for name in "TD" if name in texts}
        if self.is_turning and not told.items() <= self.tools.items():
            self.others[[0, 2]] = lost(2)
        elif not self.is_turning and ({43, 44, 49} & {*codes} or texts.get("M", "").lstrip("0") == "6"):
            self.others[2] = lost()
        self.tools.update(told)

    def change(self, **modes: object) -> None:
        self.modes = self.modes._replace(**modes)

    def zero(self) -> tuple[np.ndarray, Place]:
        return self.modes.matrix, self.modes.active + self.others + self.local + self.modes.shift

    def size(self, axis: str, value: Value, is_absolute: bool = True) -> Value:
        """mm, X as a radius."""
        is_half = axis == "X" and self.modes.diameter in ("DIAMON", "DIAM90" if is_absolute else "")
        return value * (self.modes.unit * (0.5 if is_half else 1))

    def set_place(self, own: set[float], named: Mapping[int, Value]) -> None:
        """Move in the coordinates of the machine, or say where coordinates count from."""
        here, is_local, kept = moved(self.zero(), self.place), 52 in own, self.local if 52 in own else self.others
        if own & {53, 153}:
            self.place, self.open = self.place.copy(), None
            self.place[[*named]] = lost(len(named))
            self.moves.append(Move(self.line, -1, self.modes.plane, self.place, self.place, self.zero()))
            return
        if self.open is not None or not (is_local or self.modes.is_absolute):
            raise Stopped("an open angle, or G92 in increments, of which the facts say nothing")
        for axis, value in named.items():
            kept[axis] = value if is_local else kept[axis] + here[axis] - value

    def go(self, words: Ends, corner: tuple[str, Value] | None, angle: Value | None) -> None:
        """Move to the ends that words of axes name."""
        modes, (matrix, origin) = self.modes, self.zero()
        start = moved((matrix, origin), self.place)
        plane, at = [*map(AXES.index, modes.plane)], start.copy()
        for axis in {*AXES} & {*words}:
            size, index = self.size(axis, *words[axis]), AXES.index(axis)
            at[index] = size if words[axis][1] else at[index] + size
        named = [AXES.index(axis) for axis in modes.plane if axis in words]
        move = Move(self.line, modes.motion, modes.plane, self.place, self.place, (matrix, origin), corner, angle)
        if self.open is not None:
            (first, heading), self.open, place = self.open, None, start.copy()
            place[plane] = lost(2)
            given = first.seen(first.start, first.zero), at[plane], heading, angle
            if angle is not None and len(named) == 2 and all(map(is_known, given)):
                place[plane] = _crossing(*given)
            first.end = move.start = matrix @ place + origin
        elif angle is not None and not named:
            self.open = (move, angle)
            self.moves.append(move)
            return
        elif angle is not None and len(named) == 2:
            raise Stopped("an angle and both ends")
        elif angle is not None:
            (one,), (other,), way = named, {*plane} - {*named}, np.tan(np.radians(angle))
            at[other] = start[other] + (at[one] - start[one]) * (way if one == plane[0] else 1 / way)
        if modes.motion in (2, 3):
            move.center = self.center(words, start[plane], at[plane])
        self.place = move.end = matrix @ at + origin
        if named or angle is not None:
            self.moves.append(move)

    def center(self, words: Ends, start: Place, end: Place) -> Place:
        if "R" not in words:
            letters = ["IJK"[AXES.index(axis)] for axis in self.modes.plane]
            return start + [self.modes.unit * words[name][0] if name in words else np.zeros(2) for name in letters]
        radius, way = words["R"][0] * self.modes.unit, end - start
        far, is_left = np.hypot(*way), (self.modes.motion == 3) == (radius > 0)
        height = np.sqrt(np.maximum(radius**2 - far**2 / 4, 0)) * np.where(is_left, 1, -1)
        return (start + end) / 2 + np.array([-way[1], way[0]]) / far * height


def moved(zero: tuple[np.ndarray, Place], place: Place) -> Place:
    """A place of the machine as it is counted in a program."""
    return np.linalg.inv(zero[0]) @ (place - zero[1])


def _crossing(one: Place, other: Place, *headings: Value) -> Place:
    """Where a line from a point meets a line to another one, by their headings."""
    (a, b), (c, d) = ((np.cos(np.radians(each)), np.sin(np.radians(each))) for each in headings)
    across, (x, y) = a * d - b * c, other - one
    if (np.abs(across) < 0.04).all():
        raise Stopped("parallel")
    return one + (x * d - y * c) / across * np.array([a, b])


class Sinumerik(Interpreter):
    """840D: subprograms with PROC in the same file."""

    comment, head = ";.*", r"PROC (\w+)"
    diameter, own_variables, spelled = "DIAMOF", (), ()
    assigned = r"(?!(?:[XYZIJK]|ANG|RND|CHR|CHF|CR)=)(\w+)=(.+)"
    number, read = Interpreter.value, Interpreter.cell

    def block(self, line: str) -> None:
        if line.startswith("DEF "):
            kind, names = line.split(" ", 2)[1:]
            for name, _, text in (each.strip().partition("=") for each in names.split(",")):
                self.levels[-1][name] = Cell(self.converted(self.value(text or "0"), kind), kind)
        elif (found := re.fullmatch(r"(\w+)(?: ?\((.*)\))?", line)) and found[1] in self.heads:
            self.call(self.heads[found[1]], re.findall(r"(?:[^,()]|\([^)]*\))+", found[2] or ""))
        elif found := re.match(r"\$P_(.)\w+(?:\[(\d)\])?=(\w+)\((\w),(.+)\)", line):
            self.set_system_frame(*found.groups())
        elif found := re.match(r"(A?(?:TRANS|ROT|SCALE|MIRROR)|G5[89])\b(.*)", line):
            said = re.findall(r"([A-Z]+)=?(\S*)", found[2])
            self.change_frame(found[1], {address: self.value(text) for address, text in said})
        else:
            super().block(line)

    def call(self, head: int, given: Sequence[str]) -> None:
        level, kept = dict[str, Cell](), self.modes
        parameters, flags = re.match(r"PROC \w+ ?(?:\(([^)]*)\))?(.*)", self.lines[head]).groups()
        for at, (*how, kind, own) in enumerate(each.split() for each in (parameters or "").split(",") if each):
            text = given[at].strip() if at < len(given) else "0"
            if not how:
                level[own] = Cell(self.converted(self.value(text or "0"), kind), kind)
            elif (text[0] != "R" and text not in {**self.levels[0], **self.levels[-1]}) or self.cell(text).kind != kind:
                raise Stopped("another type by reference")
            else:
                level[own] = self.cell(text)
        self.levels.append(level)
        self.section(head + 1)
        self.levels.pop()
        if "SAVE" in flags.split():
            if kept.work == self.modes.work and not np.array_equal(kept.active, self.modes.active):
                # By a setting, what the called program does to the offset in force stays or not.
                kept = kept._replace(active=lost(3))
            self.modes = kept

    def set_frame(self, shift: Place, coarse: Place, matrix: np.ndarray = IDENTITY, is_plain: bool = True) -> None:
        self.change(shift=shift, coarse=coarse, matrix=matrix, is_plain=is_plain)

    def change_frame(self, name: str, said: Mapping[str, Value]) -> None:
        old, kind, along = self.modes, name.removeprefix("A"), NOWHERE.copy()
        named = [AXES.index(axis) for axis in AXES if axis in said]
        for axis in named:
            along[axis] = self.size(AXES[axis], said[AXES[axis]]) if axis or old.diameter == "DIAMOF" else lost()
        if name == "TRANS" and named:
            known = along if old.is_plain else lost(3)
            self.set_frame(known, known)
        elif name == "ATRANS":
            self.set_frame(old.shift + old.matrix @ along, old.coarse, old.matrix, is_plain=False)
        elif kind in ("G58", "G59") and (old.matrix == IDENTITY).all():
            coarse, total = old.coarse.copy(), old.shift.copy()
            total[named] = along[named] + (total[named] - coarse[named] if name == "G58" else coarse[named])
            coarse[named] = along[named] if name == "G58" else coarse[named]
            self.set_frame(total, coarse, is_plain=old.is_plain and name == "G58")
        elif kind in ("G58", "G59"):
            self.set_frame(lost(3), NOWHERE, old.matrix, is_plain=False)
        elif not all(map(is_known, said.values())):
            raise Stopped("a frame that is not known")
        else:
            sizes = [(said[axis][0] if kind == "SCALE" else -1.0) if axis in said else 1.0 for axis in AXES]
            matrix = turned(old.plane, said["RPL"][0]) if "RPL" in said else np.diag(sizes)
            before = (old.shift, old.coarse, old.matrix @ matrix) if name != kind else (NOWHERE, NOWHERE, matrix)
            self.set_frame(*before, is_plain=not said)

    def set_system_frame(self, kind: str, number: str | None, function: str, axis: str, amount: str) -> None:
        """Write the programmable frame, a settable one or that in force, or the basic one."""
        value, along = self.value(amount), NOWHERE.copy()
        along[AXES.index(axis)] = value
        if kind == "P" and function == "CTRANS":
            self.set_frame(along, along)
        elif kind == "P":
            self.set_frame(NOWHERE, NOWHERE, turned({"X": "YZ", "Y": "ZX", "Z": "XY"}[axis], value[0]), is_plain=False)
        elif number:
            self.tables[f"G{53 + int(number)}"] = lost(3)
        elif kind == "I":
            self.change(active=lost(3))
        else:
            self.others[:] = lost(3)

    def split(self, line: str) -> Iterator[tuple[str, str, bool | None]]:
        for word in line.split():
            if word.startswith("DIAM"):
                self.change(diameter=word)
            elif word == "SUPA":
                yield "G", "53", None
            elif found := re.fullmatch(r"(?:([A-Z_$]\w*)=|([A-Z]))(?:(AC|IC)(?=\())?(.+)", word):
                name = "R" if found[1] == "CR" else found[1] or found[2]
                yield name, found[4], found[3] and found[3] == "AC"


def turned(axes: str, angle: float) -> np.ndarray:
    matrix, pair, way = np.eye(3), [*map(AXES.index, axes)], np.exp(1j * np.radians(angle))
    matrix[np.ix_(pair, pair)] = [[way.real, -way.imag], [way.imag, way.real]]
    return matrix


ARGUMENTS = dict(zip("ABCIJKDEFHMQRSTUVWXYZ", (1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, *range(17, 27)), strict=True))
_WORD = re.compile(r"(,?[A-Z])([-+]?(?:\[[^\]]*\]|#\d+|\d*\.?\d*))")


class Fanuc(Interpreter):
    """Subprograms stand as O numbers in the same file."""

    comment, head, assigned = r"\([^)]*\)|^%.*", r"O0*(\d+)", r"#(\d+) ?= ?(.+)"
    diameter, own_variables = "DIAMON", [*map(str, range(1, 34))]
    spelled = ((r"^(IF|WHILE) ?\[(.+)\] ?(?:DO ?\d|(GOTO|THEN) ?(.+))$", r"\1 \2 \3 \4"), (r"^END\d$", "ENDWHILE"))

    def system(self, at: int) -> tuple[Place, str] | None:
        """A place or a shift, and an axis, that a variable of the control is of."""
        number, axis = (at - 5201) // 20, (at - 1) % 20
        if axis >= len(self.axes) or not (5001 <= at <= 5003 or 5201 <= at <= 5326):
            return None
        shift = self.tables[f"G{53 + number}"] if number > 0 else self.others
        return (moved(self.zero(), self.place) if at < 5200 else shift), self.axes[axis]

    def read(self, number: Cell) -> Cell:
        if found := self.system(at := int(number.value[0])):
            return Cell(found[0][AXES.index(found[1])] / self.size(found[1], 1.0))
        return self.cell(str(at))

    def assign(self, name: str, value: Value | None) -> None:
        if found := self.system(int(name)):
            found[0][AXES.index(found[1])] = self.size(found[1], np.zeros(2) if value is None else value)
            self.change(active=self.tables[self.modes.work].copy())
        else:
            super().assign(name, value)

    def split(self, line: str) -> Iterator[tuple[str, str, bool | None]]:
        for name, text in _WORD.findall(line.replace(" ", "")):
            if text and not (self.is_turning and name + text in ("G90", "G91")):
                is_length = self.is_turning and name in ("U", "W")
                yield {"U": "X", "W": "Z"}[name] if is_length else name, text, False if is_length else None

    def number(self, text: str) -> Value:
        return self.value(text) if re.search(r"[#\[.]", text) else np.full(2, float(text) / 1000)

    def words(self, line: str) -> None:
        words = {name: text for name, text in _WORD.findall(line.replace(" ", "")) if text}
        if re.search(r"M98|G65", line):
            given = {ARGUMENTS[name]: self.number(text) for name, text in words.items() if name in ARGUMENTS}
            own = {each: Cell(given.get(int(each))) for each in self.own_variables}
            self.levels.append(own if "G65" in line else self.levels[-1])
            for _ in range(int(words.get("L", "1"))):
                self.section(self.heads[words["P"].lstrip("0")] + 1)
            self.levels.pop()
        elif re.search(r"G10\b", line):
            # G10 L2: a number that adds or replaces.
            for at, axis in enumerate(self.axes):
                if axis in words:
                    self.assign(str(5201 + 20 * int(words.get("P", "0")) + at), lost())
        else:
            super().words(line)
