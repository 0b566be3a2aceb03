"""Runs what `expand --formulas` writes for Fanuc, Haas, SINUMERIK and Klartext: no import of the package.

Expressions are rewritten into Python's and evaluated; a program goes from line to line, by jumps and by IF.
"""

import re
from collections.abc import Callable, Iterator, Mapping
from math import acos, atan2, cos, degrees, radians, sin, sqrt
from typing import NamedTuple

from interpreter import Motion

_FUNCTIONS = {
    "SQRT": sqrt,
    "ABS": abs,
    "SIN": lambda angle: sin(radians(angle)),
    "COS": lambda angle: cos(radians(angle)),
    "ATAN2": lambda y, x: degrees(atan2(y, x)),
    "ACOS": lambda value: degrees(acos(value)),
    "SQ": lambda value: value * value,
    "SGN": lambda value: (value > 0) - (value < 0),
    "INT": int,
}
_SIGNS = {" LT ": "<", " LE ": "<=", " GT ": ">", " GE ": ">="}
_VARIABLE = re.compile(r"#\d+|\b[RQ]\d+\b")
_WORD = re.compile(r"(?<![A-Z])(I?[XYZIJK])=?([-+]?(?:#\d+|[RQ]\d+|\d+\.?\d*))")
_MOST_LINES = 100_000
_NOTHING = 1e-6
"""Of a line that is no motion."""


class Run(NamedTuple):
    """The motions in words (X of a lathe as it is written), and what the machine says where it stops."""

    motions: list[tuple[str, dict[str, float], dict[str, float]]]
    message: str


class _Machine:
    def __init__(self, text: str, values: Mapping[str, float]) -> None:
        self.lines = [line.strip() for line in text.splitlines()]
        self.values = dict(values)
        self.motions: list[tuple[str, dict[str, float], dict[str, float]]] = []
        self.center: dict[str, float] = {}
        self.message: str | None = None
        self.place = 0
        self.labels = {
            found[1]: number
            for number, line in enumerate(self.lines)
            for found in [re.fullmatch(r"N(\d+)|LBL (\d+)", line)]
            if found
            for found in [(None, found[1] or found[2])]
        }

    def value(self, text: str) -> float:
        """The value of an expression."""
        found = text.strip().lstrip("+")
        # The direction of x and y, as Fanuc writes it.
        found = re.sub(r"ATAN\[([^\[\]]*)\]/\[([^\[\]]*)\]", r"ATAN2[\1,\2]", found)
        found = found.replace("[", "(").replace("]", ")")
        for sign, python in _SIGNS.items():
            found = found.replace(sign, python)
        # Klartext has functions of what stands behind them.
        found = re.sub(r"\b(SQRT|SQ|ABS|SIN|COS|ACOS|SGN|INT) (Q\d+|[\d.]+)", r"\1(\2)", found)
        found = _VARIABLE.sub(lambda name: repr(self.values[name[0]]), found)
        return float(eval(found, {"__builtins__": {}}, dict(_FUNCTIONS)))

    def run(self) -> Run:
        steps = 0
        while self.place < len(self.lines) and self.message is None:
            line = self.lines[self.place]
            self.place, steps = self.place + 1, steps + 1
            assert steps < _MOST_LINES, "it goes round"
            for pattern, does in _LINES:
                if found := re.fullmatch(pattern, line):
                    does(self, *found.groups())
                    break
        return Run(self.motions, self.message or "")

    def alarm(self, message: str = "ERROR") -> None:
        self.message = message

    def alarm_if(self, condition: str, message: str) -> None:
        self.message = message if self.value(condition) else None

    def assign(self, name: str, value: str) -> None:
        self.values[name] = self.value(value)

    def assign_if(self, condition: str, name: str, value: str) -> None:
        if self.value(condition):
            self.assign(name, value)

    def jump(self, label: str) -> None:
        self.place = self.labels[label]

    def jump_if(self, condition: str, label: str) -> None:
        if self.value(condition):
            self.jump(label)

    def compare(self, one: str, sign: str, other: str, label: str) -> None:
        first, second = self.value(one), self.value(other)
        if {"EQU": first == second, "GT": first > second, "LT": first < second}[sign]:
            self.jump(label)

    def branch(self, condition: str) -> None:
        self.place = self.place if self.value(condition) else self._behind(self.place, "ELSE")

    def skip(self) -> None:
        self.place = self._behind(self.place, "")

    def set_center(self, text: str) -> None:
        self.center = {name[1:]: self.value(value) for name, value in _WORD.findall(text)}

    def move(self, kind: str, text: str) -> None:
        words = {name: self.value(value) for name, value in _WORD.findall(text)}
        center = self.center if kind == "C" else {}
        kind = {"L": "G01", "C": "G03" if text.endswith("DR+") else "G02"}.get(kind, kind)
        self.motions.append((kind, words, center))

    def _behind(self, place: int, other: str) -> int:
        """The line behind the ELSE or the ENDIF of an IF."""
        depth = 0
        for number in range(place, len(self.lines)):
            line = self.lines[number]
            if not depth and line in (other, "ENDIF"):
                return number + 1
            depth += line.startswith("IF ") - (line == "ENDIF")
        raise AssertionError("an IF does not end")


_LINES: tuple[tuple[str, Callable[..., None]], ...] = (
    (r"IF \[(.*)\] THEN #3000=\d+ \((.*)\)", _Machine.alarm_if),
    (r"IF \[(.*)\] THEN (#\d+)=(.*)", _Machine.assign_if),
    (r"IF \[(.*)\] GOTO (\d+)", _Machine.jump_if),
    (r"FN (?:9|11|12): IF (\S+) (EQU|GT|LT) (\S+) GOTO LBL (\d+)", _Machine.compare),
    (r"GOTO (\d+)", _Machine.jump),
    (r"IF (.*)", _Machine.branch),
    (r"ELSE", _Machine.skip),
    (r'SETAL\(65000,"(.*)"\)', _Machine.alarm),
    (r"FN 14: ERROR = 1000", _Machine.alarm),
    (r"(#\d+|[RQ]\d+) ?= ?(.*)", _Machine.assign),
    (r"CC (.*)", _Machine.set_center),
    (r"(G0?[0123]|L|C) (.*)", _Machine.move),
)
"""What each line does; the first pattern counts."""


def run_macros(text: str, values: Mapping[str, float]) -> Run:
    """Run a program at values of its variables."""
    return _Machine(text, values).run()


def motions_of(run: Run, start: complex, axes: str, scales: tuple[float, float]) -> Iterator[Motion]:
    """The motions in a plane whose axes have these letters, each word divided by its scale; the unit is theirs."""
    here, centers = start, {"X": "I", "Y": "J", "Z": "K"}
    for kind, words, center in run.motions:
        if kind in ("G00", "G0"):
            continue
        ends = [
            words.get(axis, part * scale) / scale
            for axis, part, scale in zip(axes, (here.real, here.imag), scales, strict=True)
        ]
        end = complex(*ends)
        if kind in ("G01", "G1"):
            middle = None
        else:
            steps = [center[axis] if center else words[centers[axis]] for axis in axes]
            middle = here + complex(*steps)
        if middle is not None or abs(end - here) > _NOTHING:
            yield Motion({"G02": "cw", "G03": "ccw"}.get(kind, "line"), here, end, middle)
        here = end
