"""Runs what `expand --formulas` writes for Fanuc, Haas, SINUMERIK and Klartext: no import of the package.

Expressions are rewritten into Python's and evaluated; a program goes from line to line, by jumps and by IF, ELSE, ENDIF.
"""

import re
from collections.abc import Iterator, Mapping
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
        return float(eval(found, {"__builtins__": {}}, dict(_FUNCTIONS)))  # noqa: S307 - our own text

    def run(self) -> Run:
        motions: list[tuple[str, dict[str, float], dict[str, float]]] = []
        center: dict[str, float] = {}
        place = steps = 0
        while place < len(self.lines):
            line = self.lines[place]
            place, steps = place + 1, steps + 1
            assert steps < _MOST_LINES, "it goes round"
            if found := re.fullmatch(r"IF \[(.*)\] THEN #3000=\d+ \((.*)\)", line):
                if self.value(found[1]):
                    return Run(motions, found[2])
            elif found := re.fullmatch(r"IF \[(.*)\] THEN (#\d+)=(.*)", line):
                if self.value(found[1]):
                    self.values[found[2]] = self.value(found[3])
            elif found := re.fullmatch(r"IF \[(.*)\] GOTO (\d+)", line):
                place = self.labels[found[2]] if self.value(found[1]) else place
            elif found := re.fullmatch(r"FN (9|11|12): IF (\S+) (EQU|GT|LT) (\S+) GOTO LBL (\d+)", line):
                one, two = self.value(found[2]), self.value(found[4])
                holds = {"EQU": one == two, "GT": one > two, "LT": one < two}[found[3]]
                place = self.labels[found[5]] if holds else place
            elif found := re.fullmatch(r"GOTO (\d+)", line):
                place = self.labels[found[1]]
            elif found := re.fullmatch(r"IF (.*)", line):
                place = place if self.value(found[1]) else self._behind(place, "ELSE")
            elif line == "ELSE":
                place = self._behind(place, "")
            elif found := re.fullmatch(r'SETAL\(65000,"(.*)"\)', line):
                return Run(motions, found[1])
            elif line == "FN 14: ERROR = 1000":
                return Run(motions, "ERROR")
            elif found := re.fullmatch(r"(#\d+|[RQ]\d+) ?= ?(.*)", line):
                self.values[found[1]] = self.value(found[2])
            elif line.startswith("CC "):
                center = {name[1:]: self.value(text) for name, text in _WORD.findall(line)}
            elif found := re.match(r"(G0?[0123]|L|C) ", line):
                words = {name: self.value(text) for name, text in _WORD.findall(line)}
                kind = {"L": "G01", "C": "G03" if line.endswith("DR+") else "G02"}.get(found[1], found[1])
                motions.append((kind, words, center if found[1] == "C" else {}))
        return Run(motions, "")

    def _behind(self, place: int, other: str) -> int:
        """The line behind the ELSE or the ENDIF of an IF."""
        depth = 0
        for number in range(place, len(self.lines)):
            line = self.lines[number]
            if not depth and line in (other, "ENDIF"):
                return number + 1
            depth += line.startswith("IF ") - (line == "ENDIF")
        raise AssertionError("an IF does not end")


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
