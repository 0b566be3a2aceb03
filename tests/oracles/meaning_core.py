"""A small reference interpreter of what a program means before its geometry begins: modal state, offsets, frames, calls
and types, for SINUMERIK and for Fanuc macros. Nothing of the package is used.

A value that is not known is a symbol, so that what is unknown and cancels is known again: an offset that is left and
taken up again moves nothing. A place is kept in the coordinates of the machine.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count
from math import cos, floor, inf, radians, sin, sqrt, tan

AXES = "XYZ"
PLANES = {17: "XY", 18: "ZX", 19: "YZ"}
IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_ids = count()


class Stopped(Exception):  # noqa: N818 - the control stops with an alarm, or a program of this kind is not drawn
    pass


@dataclass(frozen=True)
class Value:
    """A number, and symbols (which one, program line) with their factors for what is not known of it."""

    number: float = 0.0
    lost: Mapping[tuple[int, int], float] = field(default_factory=dict)

    @property
    def is_known(self) -> bool:
        return all(abs(factor) < 1e-9 for factor in self.lost.values())

    @property
    def lines(self) -> set[int]:
        return {line for (_, line), factor in self.lost.items() if abs(factor) >= 1e-9}

    def __add__(self, other: "Value") -> "Value":
        both = {each: self.lost.get(each, 0) + other.lost.get(each, 0) for each in {**self.lost, **other.lost}}
        return Value(self.number + other.number, both)

    def __mul__(self, factor: float) -> "Value":
        return Value(self.number * factor, {each: factor * one for each, one in self.lost.items()})

    def __sub__(self, other: "Value") -> "Value":
        return self + other * -1


def lost(line: int) -> Value:
    return Value(0.0, {(next(_ids), line): 1.0})


Place = tuple[Value, Value, Value]
Matrix = tuple[tuple[float, ...], ...]


def times(matrix: Matrix, place: Sequence[Value]) -> Place:
    rows = [place[0] * row[0] + place[1] * row[1] + place[2] * row[2] for row in matrix]
    return rows[0], rows[1], rows[2]


def joined(one: Matrix, other: Matrix) -> Matrix:
    return tuple(tuple(sum(a[k] * other[k][j] for k in range(3)) for j in range(3)) for a in one)


def inverse(m: Matrix) -> Matrix:
    cofactor = [
        [
            m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3]
            - m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3]
            for j in range(3)
        ]
        for i in range(3)
    ]
    whole = sum(m[0][j] * cofactor[0][j] for j in range(3))
    return tuple(tuple(cofactor[j][i] / whole for j in range(3)) for i in range(3))


def turned(axes: str, angle: float) -> Matrix:
    rows, (a, b) = [list(row) for row in IDENTITY], map(AXES.index, axes)
    rows[a][a] = rows[b][b] = cos(radians(angle))
    rows[b][a] = sin(radians(angle))
    rows[a][b] = -rows[b][a]
    return tuple(map(tuple, rows))


@dataclass(frozen=True)
class Frame:
    """The programmable frame: a shift of two parts, as it adds up, and directions and lengths."""

    shift: Mapping[str, Value] = field(default_factory=dict)
    coarse: Mapping[str, Value] = field(default_factory=dict)
    matrix: Matrix = IDENTITY
    is_plain: bool = True
    """Whether nothing but coarse shifts has been said of it."""


@dataclass
class Modes:
    """What SAVE brings back."""

    motion: int = 1
    plane: str = "XY"
    unit: float = 1.0
    is_absolute: bool = True
    diameter: str = "DIAMOF"
    work: str = "?"
    active: Mapping[str, Value] = field(default_factory=dict)
    """The settable offset in force."""
    frame: Frame = field(default_factory=Frame)


Corner = tuple[str, Value]
"""Its word, and its size in mm."""


@dataclass
class Move:
    """A motion of a block; places are those of the machine, `zero` is where they are counted from in the program."""

    line: int
    motion: int
    axes: str
    start: Place
    end: Place
    zero: tuple[Matrix, Place]
    corner: Corner | None = None
    angle: Value | None = None
    center: tuple[Value, Value] | None = None
    is_incremental: bool = False

    def seen(self, place: Place, zero: tuple[Matrix, Place]) -> tuple[Value, Value]:
        program = times(inverse(zero[0]), [one - other for one, other in zip(place, zero[1], strict=True)])
        return program[AXES.index(self.axes[0])], program[AXES.index(self.axes[1])]


# Expressions --------------------------------------------------------------------------------------------------------


def rounded(number: float) -> float:
    return float(floor(abs(number) + 0.5)) * (1 if number >= 0 else -1)


_TOKEN = re.compile(r"\d+\.?\d*|\.\d+|[A-Z_$][A-Z_0-9$]*|==|<>|>=|<=|[-+*/()<>\[\],#]")
_COMPARED = {
    "==": lambda a, b: abs(a - b) <= 1e-12 * max(abs(a), abs(b)),
    "<>": lambda a, b: abs(a - b) > 1e-12 * max(abs(a), abs(b)),
    ">": lambda a, b: a > b,
    "<": lambda a, b: a < b,
    ">=": lambda a, b: a >= b,
    "<=": lambda a, b: a <= b,
}
_MACRO_NAMES = {"EQ": "==", "NE": "<>", "GT": ">", "LT": "<", "GE": ">=", "LE": "<="}
_RANKS = (tuple(_COMPARED), ("OR",), ("XOR",), ("AND",), ("+", "-"), ("*", "/", "DIV", "MOD"))
"""Lowest first: comparisons come last."""
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    "ABS": abs,
    "SQRT": lambda a: sqrt(a) if a >= 0 else inf,
    "SIN": lambda a: sin(radians(a)),
    "COS": lambda a: cos(radians(a)),
    "ROUND": rounded,
}


class Formula:
    """Reads the value of an expression."""

    def __init__(self, text: str, read: Callable[[str, "Formula"], Value | None], line: int) -> None:
        plain = text.replace("[", "(").replace("]", ")")
        self.tokens = [_MACRO_NAMES.get(each, each) for each in _TOKEN.findall(plain)]
        self.read, self.line, self.at = read, line, 0

    def next(self) -> str:
        self.at += 1
        return self.tokens[self.at - 1]

    @property
    def ahead(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def whole(self) -> Value | None:
        return self.ranked(0) if self.tokens else None

    def ranked(self, rank: int) -> Value | None:
        if rank == len(_RANKS):
            return self.one()
        left = self.ranked(rank + 1)
        while self.ahead in _RANKS[rank]:
            left = self.joined(self.next(), left or Value(), self.ranked(rank + 1) or Value())
        return left

    def joined(self, sign: str, one: Value, other: Value) -> Value:
        if sign in ("+", "-"):
            return one + other * (1 if sign == "+" else -1)
        if sign == "*" and (one.is_known or other.is_known):
            return other * one.number if one.is_known else one * other.number
        if not other.is_known or (sign != "/" and not one.is_known):
            return Value(0, {**one.lost, **other.lost, **lost(self.line).lost})
        a, b = one.number, other.number
        if sign == "/":
            if not b:
                raise Stopped("division by 0")
            return one * (1 / b)
        if sign in _COMPARED:
            return Value(float(_COMPARED[sign](a, b)))
        truths = {"AND": bool(a) and bool(b), "OR": bool(a) or bool(b), "XOR": bool(a) is not bool(b)}
        if sign in truths:
            return Value(float(truths[sign]))
        whole = float(int(a / b))
        return Value(whole if sign == "DIV" else a - b * whole)

    def one(self) -> Value | None:
        token = self.next()
        if token in ("-", "+"):
            return (self.one() or Value()) * (-1 if token == "-" else 1)
        if token == "NOT":
            inner = self.one() or Value()
            return Value(float(not inner.number)) if inner.is_known else lost(self.line)
        if token == "(":
            inner = self.ranked(0)
            self.next()
            return inner
        if token in _FUNCTIONS:
            inner = self.one() or Value()
            return Value(_FUNCTIONS[token](inner.number)) if inner.is_known else lost(self.line)
        if token[0].isdigit() or token[0] == ".":
            return Value(float(token))
        return self.read(token, self)


# Interpreters -------------------------------------------------------------------------------------------------------

_STEPS = 3_000


class Interpreter:
    """One run of a program; `decide` is asked where a condition is not known."""

    def __init__(self, text: str, decide: Callable[[], bool], start: Mapping[str, float] | None = None) -> None:
        self.lines = [self.bare(line) for line in text.upper().split("\n")]
        self.decide, self.line, self.steps = decide, 0, 0
        self.modes, self.moves = Modes(), list[Move]()
        self.modes.active = {axis: lost(0) for axis in AXES}
        self.tables = dict[str, dict[str, Value]]()
        self.others = {axis: Value() for axis in AXES}
        """Shifts that no call brings back: tool, basic or external offset, local zero, reference point."""
        self.local = {axis: Value() for axis in AXES}
        self.place: Place = (lost(0), lost(0), lost(0))
        self.tool = "?"
        self.open: tuple[Move, Value] | None = None

    def bare(self, line: str) -> str:
        raise NotImplementedError

    def zero(self) -> tuple[Matrix, Place]:
        none, modes = Value(), self.modes
        x, y, z = (
            modes.active[axis] + self.others[axis] + self.local[axis] + modes.frame.shift.get(axis, none)
            for axis in AXES
        )
        return modes.frame.matrix, (x, y, z)

    def position(self) -> list[Value]:
        matrix, origin = self.zero()
        return list(times(inverse(matrix), [one - other for one, other in zip(self.place, origin, strict=True)]))

    def size(self, axis: str, value: Value, is_absolute: bool) -> Value:
        """mm, X as a radius."""
        kind = self.modes.diameter
        is_half = axis == "X" and (kind == "DIAMON" or (kind == "DIAM90" and is_absolute))
        return value * (self.modes.unit * (0.5 if is_half else 1))

    def lose(self, kept: dict[str, Value], axes: str = AXES) -> None:
        kept.update({axis: lost(self.line) for axis in axes})

    def table(self, name: str) -> dict[str, Value]:
        return self.tables.setdefault(name, {axis: lost(self.line) for axis in AXES})

    def choose(self, name: str) -> None:
        """Take a settable offset; what was in force before the program is not known."""
        self.modes.work, self.modes.active = name, dict(self.table(name))

    def is_true(self, text: str) -> bool:
        value = self.value(text) or Value()
        return bool(value.number) if value.is_known else self.decide()

    def value(self, text: str) -> Value | None:
        return Formula(text, self.read, self.line).whole()

    def read(self, name: str, formula: Formula) -> Value | None:
        raise NotImplementedError

    def go(self, words: Mapping[str, tuple[Value, bool]], corner: Corner | None, angle: Value | None) -> None:
        """Move to the ends that words of axes name, each with whether it is absolute."""
        modes, zero = self.modes, self.zero()
        before, at = self.place, self.position()
        a, b = (AXES.index(axis) for axis in modes.plane)
        for axis, (value, is_absolute) in words.items():
            if axis in AXES:
                size = self.size(axis, value, is_absolute)
                at[AXES.index(axis)] = size if is_absolute else at[AXES.index(axis)] + size
        named = [axis for axis in modes.plane if axis in words]
        move = Move(self.line, modes.motion, modes.plane, before, before, zero, corner, angle)
        move.is_incremental = any(not words[axis][1] for axis in named)
        if self.open is not None:
            first, heading = self.open
            self.open = None
            begin = first.seen(first.start, first.zero)
            end = (at[a], at[b])
            if angle is None or len(named) < 2 or not all(each.is_known for each in (*begin, *end, heading, angle)):
                corner_at = (lost(self.line), lost(self.line))
            else:
                corner_at = _crossing(begin, heading.number, end, angle.number)
            place = self.position()
            place[a], place[b] = corner_at
            first.end = self.machine(place)
            move.start = first.end
        elif angle is not None:
            start = self.position()
            if not named:
                self.open = (move, angle)
                self.moves.append(move)
                return
            if len(named) == 2:
                raise Stopped("an angle and both ends")
            way = tan(radians(angle.number)) if angle.is_known else 0
            if not angle.is_known:
                at[b if named[0] == modes.plane[0] else a] = lost(self.line)
            elif named[0] == modes.plane[0]:
                at[b] = start[b] + (at[a] - start[a]) * way
            else:
                at[a] = start[a] + (at[b] - start[b]) * (1 / way)
        if modes.motion in (2, 3):
            begin = self.position()
            move.center = self.center(words, (begin[a], begin[b]), (at[a], at[b]))
        self.place = move.end = self.machine(at)
        if named or angle is not None:
            self.moves.append(move)

    def leave(self, axes: Sequence[str]) -> None:
        """Move in the coordinates of the machine."""
        at = list(self.place)
        for axis in axes:
            at[AXES.index(axis)] = lost(self.line)
        self.place, self.open = (at[0], at[1], at[2]), None
        self.moves.append(Move(self.line, -1, self.modes.plane, self.place, self.place, self.zero()))

    def machine(self, program: Sequence[Value]) -> Place:
        matrix, origin = self.zero()
        x, y, z = (one + other for one, other in zip(times(matrix, program), origin, strict=True))
        return x, y, z

    def center(self, words: Mapping[str, tuple[Value, bool]], start: Sequence[Value], end: Sequence[Value]):
        unit = self.modes.unit
        if "R" not in words:
            letters = ["IJK"[AXES.index(axis)] for axis in self.modes.plane]
            return tuple(
                one + words[name][0] * unit if name in words else one for one, name in zip(start, letters, strict=True)
            )
        radius = words["R"][0].number * unit
        one, other = (complex(each[0].number, each[1].number) for each in (start, end))
        middle, way = (one + other) / 2, other - one
        height = sqrt(max(radius**2 - abs(way) ** 2 / 4, 0)) * (1 if (self.modes.motion == 3) is (radius > 0) else -1)
        found = middle + 1j * way / abs(way) * height
        return Value(found.real, start[0].lost), Value(found.imag, start[1].lost)

    def run(self) -> list[Move]:
        raise NotImplementedError

    def step(self) -> None:
        self.steps += 1
        if self.steps > _STEPS:
            raise Stopped("endless")


def _crossing(one: Sequence[Value], heading: float, other: Sequence[Value], angle: float) -> tuple[Value, Value]:
    a, b = cos(radians(heading)), sin(radians(heading))
    c, d = cos(radians(angle)), sin(radians(angle))
    across = a * d - b * c
    if abs(across) < 0.04:
        raise Stopped("parallel")
    x, y = (second.number - first.number for first, second in zip(one, other, strict=True))
    far = (x * d - y * c) / across
    return Value(one[0].number + far * a), Value(one[1].number + far * b)
