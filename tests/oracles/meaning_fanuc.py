"""The reference interpreter of Fanuc macros, on lathes and mills: calls, local variables, offsets, tool changes."""

import re
from collections.abc import Callable, Sequence

from meaning_core import AXES, PLANES, Formula, Interpreter, Move, Stopped, Value, lost

ARGUMENTS = dict(zip("ABCIJKDEFHMQRSTUVWXYZ", (1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, *range(17, 27)), strict=True))
_WORD = re.compile(r"(,?[A-Z])([-+]?(?:\[[^\]]*\]|#\d+|\d*\.?\d*))")
_SHIFTS = range(5201, 5327)


class Fanuc(Interpreter):
    """Subprograms stand as O numbers in the same file."""

    def __init__(self, text: str, decide: Callable[[], bool], *, is_turning: bool) -> None:
        super().__init__(text, decide)
        self.is_turning, self.axes = is_turning, "XZ" if is_turning else "XYZ"
        self.modes.plane, self.modes.diameter = ("ZX", "DIAMON") if is_turning else ("XY", "DIAMOF")
        self.shared = dict[int, Value | None]()
        self.levels: list[dict[int, Value | None]] = [{number: lost(0) for number in range(1, 34)}]
        self.heads = {int(found[1]): at for at, one in enumerate(self.lines) if (found := re.match(r"O(\d+)", one))}
        self.section_of = 0

    def bare(self, line: str) -> str:
        return re.sub(r"\([^)]*\)|^%.*", "", line).strip()

    def run(self) -> list[Move]:
        self.section(0)
        return self.moves

    def section(self, first: int) -> None:
        at, outer = first, self.section_of
        self.section_of = first
        while at < len(self.lines):
            self.step()
            self.line, line = at + 1, re.sub(r"^N\d+ *", "", self.lines[at])
            if re.fullmatch(r"M(99|30|02|2)", line):
                break
            at = self.flow(at, line)
        self.section_of = outer

    def flow(self, at: int, line: str) -> int:
        """Run a line; the index of the next one."""
        if found := re.match(r"IF ?\[(.+)\] ?GOTO ?(\d+)$", line):
            return self.label(found[2]) if self.is_true(found[1]) else at + 1
        if found := re.match(r"GOTO ?(\d+)$", line):
            return self.label(found[1])
        if found := re.match(r"IF ?\[(.+)\] ?THEN ?(#.+)$", line):
            if self.is_true(found[1]):
                self.assign(found[2])
        elif found := re.match(r"WHILE ?\[(.+)\] ?DO ?(\d)$", line):
            if not self.is_true(found[1]):
                return next(to for to in range(at, len(self.lines)) if self.lines[to] == f"END{found[2]}") + 1
        elif found := re.match(r"END(\d)$", line):
            back = re.compile(rf"WHILE.*DO ?{found[1]}$")
            return next(to for to in range(at, -1, -1) if back.match(self.lines[to]))
        elif line.startswith("#"):
            self.assign(line)
        elif line and not re.match(r"O\d+", line):
            self.block(line)
        return at + 1

    def label(self, number: str) -> int:
        marked = re.compile(rf"N0*{number}\b")
        return next(to for to in range(self.section_of, len(self.lines)) if marked.match(self.lines[to]))

    # Variables

    def read(self, name: str, formula: Formula) -> Value | None:
        inner = formula.one() or Value()
        number = int(inner.number)
        if number in range(5001, 5004) and number - 5001 < len(self.axes):
            axis = self.axes[number - 5001]
            return self.position()[AXES.index(axis)] * (1 / self.size(axis, Value(1), is_absolute=True).number)
        if number in _SHIFTS and (number - 5201) % 20 < len(self.axes):
            axis = self.axes[(number - 5201) % 20]
            kept = self.others if number < 5221 else self.table(f"G{54 + (number - 5221) // 20}")
            return kept[axis] * (1 / self.size(axis, Value(1), is_absolute=True).number)
        if number < 34:
            return self.levels[-1].get(number)
        return self.shared.setdefault(number, lost(self.line))

    def assign(self, line: str) -> None:
        found = re.match(r"#(\d+) ?= ?(.+)", line)
        assert found
        number, value = int(found[1]), self.value(found[2])
        if number in _SHIFTS:
            axis = self.axes[(number - 5201) % 20]
            self.set_shift((number - 5201) // 20, axis, self.size(axis, value or Value(), is_absolute=True))
        elif number < 34:
            self.levels[-1][number] = value
        else:
            self.shared[number] = value

    def set_shift(self, number: int, axis: str, value: Value) -> None:
        """Write a work offset, or the external one (0)."""
        if number == 0:
            self.others[axis] = value
            return
        name = f"G{53 + number}"
        self.table(name)[axis] = value
        if self.modes.work == name:
            self.modes.active = {**self.modes.active, axis: value}

    # Blocks

    def number(self, name: str, text: str) -> Value | None:
        if "#" in text or "[" in text:
            return self.value(text)
        return Value(float(text) if "." in text else float(text) / 1000)

    def block(self, line: str) -> None:
        words = [(name, text) for name, text in _WORD.findall(line.replace(" ", "")) if text]
        codes = [f"{name}{float(text):g}" for name, text in words if name in "GM" and re.fullmatch(r"[\d.]+", text)]
        if {"M98", "G65"} & {*codes}:
            self.call(dict(words), is_macro="G65" in codes)
            return
        plain = {name: text for name, text in words if name not in "GMFSN"}
        if "G10" in codes:
            self.set_data(plain)
            return
        self.tools(codes, plain)
        values = {name: value for name, text in plain.items() if (value := self.number(name, text)) is not None}
        own = [code for code in codes if code in ("G52", "G92", "G53") or (code == "G50" and self.is_turning)]
        for code in codes:
            self.code(code, plain)
        named = {axis: self.size(axis, value, is_absolute=True) for axis, value in values.items() if axis in AXES}
        if own:
            self.shift(own[0], named)
            return
        ends = {name: (value, self.modes.is_absolute) for name, value in values.items() if name in "XYZIJKR"}
        if self.is_turning:
            ends.update({"XZ"["UW".index(name)]: (values[name], False) for name in "UW" if name in values})
        corner = next(((name, values[name]) for name in (",R", ",C") if name in values), None)
        if {*ends} & {*AXES} or ",A" in values:
            self.go(ends, corner, values.get(",A"))

    def call(self, words: dict[str, str], *, is_macro: bool) -> None:
        line, target = self.line, int(words["P"])
        if is_macro:
            given = {n: t for n, t in words.items() if n not in "GPL"}
            self.levels.append({ARGUMENTS[name]: self.number(name, text) for name, text in given.items()})
        for _ in range(int(words.get("L", "1"))):
            self.section(self.heads[target] + 1)
        if is_macro:
            self.levels.pop()
        self.line = line

    def set_data(self, plain: dict[str, str]) -> None:
        """G10 L2: a work offset, by a number that adds or replaces."""
        number = int(plain.get("P", "0"))
        for axis in AXES:
            if axis in plain:
                self.set_shift(number, axis, lost(self.line))

    def tools(self, codes: Sequence[str], plain: dict[str, str]) -> None:
        if self.is_turning and "T" in plain and plain["T"] != self.tool:
            self.tool = plain["T"]
            self.lose(self.others, "XZ")
        if not self.is_turning and {"G43", "G44", "G49", "M6"} & {*codes}:
            self.lose(self.others, "Z")

    def code(self, code: str, plain: dict[str, str]) -> None:
        number, modes = float(code[1:]), self.modes
        if code[0] == "M":
            return
        if number in (0, 1, 2, 3):
            modes.motion = int(number)
        elif number in PLANES:
            modes.plane = PLANES[int(number)]
        elif number in (90, 91) and not self.is_turning:
            modes.is_absolute = number == 90
        elif number in (20, 21):
            modes.unit = 25.4 if number == 20 else 1.0
        elif 54 <= number <= 59 and (name := code + (f"P{plain['P']}" if number == 54.1 else "")) != modes.work:
            self.choose(name)

    def shift(self, code: str, named: dict[str, Value]) -> None:
        """G52, G92 (G50) and G53 with the axes of their block, mm."""
        if code == "G52":
            self.local.update(named)
        elif code == "G53":
            self.leave([*named])
        else:
            if not self.modes.is_absolute:
                raise Stopped("G92 in increments, of which the facts say nothing")
            here = self.position()
            for axis, value in named.items():
                self.others[axis] = self.others[axis] + here[AXES.index(axis)] - value
        if code != "G53" and self.open is not None:
            raise Stopped("an open angle")
