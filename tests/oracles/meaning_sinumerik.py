"""The reference interpreter of SINUMERIK 840D programs: calls with SAVE, VAR and locals, types, frames and offsets."""

import re
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass

from meaning_core import (
    AXES,
    IDENTITY,
    PLANES,
    Formula,
    Frame,
    Interpreter,
    Matrix,
    Move,
    Stopped,
    Value,
    joined,
    lost,
    rounded,
    times,
    turned,
)


class Sinumerik(Interpreter):
    """840D: subprograms with PROC in the same file."""

    def __init__(self, text: str, decide: Callable[[], bool], *, is_turning: bool, main_def: str = "program") -> None:
        super().__init__(text, decide)
        self.modes.diameter, self.is_turning, self.main_def = "DIAMOF", is_turning, main_def
        self.modes.plane = "ZX" if is_turning else "XY"
        self.tools = dict[str, str]()
        self.shared, self.levels = dict[str, Value](), list[dict[str, "Cell"]]()
        self.heads = {found[1]: at for at, line in enumerate(self.lines) if (found := re.match(r"PROC (\w+)", line))}

    def bare(self, line: str) -> str:
        return re.sub(r"^N\d+ ?", "", line.partition(";")[0].strip())

    def run(self) -> list[Move]:
        self.levels.append({})
        self.section(0)
        return self.moves

    def section(self, first: int) -> None:
        at = first
        while at < len(self.lines):
            self.step()
            self.line, line = at + 1, self.lines[at]
            if line in ("M17", "RET", "M30", "M2", "M02"):
                return
            at = self.flow(at, line)

    def flow(self, at: int, line: str) -> int:
        """Run a line; the index of the next one."""
        if found := re.match(r"IF (.+) GOTO([FB]) (\w+)$", line):
            return self.label(found[3], at, found[2]) if self.is_true(found[1]) else at + 1
        if found := re.match(r"GOTO([FB]) (\w+)$", line):
            return self.label(found[2], at, found[1])
        if found := re.match(r"(IF|WHILE) (.+)", line):
            ends = ("ELSE", "ENDIF") if found[1] == "IF" else ("ENDWHILE",)
            return at + 1 if self.is_true(found[2]) else self.match(at, 1, *ends) + 1
        if line == "ELSE":
            return self.match(at, 1, "ENDIF") + 1
        if line == "ENDWHILE":
            return self.match(at, -1, "WHILE")
        if found := re.match(r"FOR (\w+)=(.+) TO (.+)", line):
            self.assign(found[1], self.value(found[2]) or Value())
            return self.passes(at, found[1], found[3])
        if line == "ENDFOR":
            head = self.match(at, -1, "FOR")
            found = re.match(r"FOR (\w+)=(.+) TO (.+)", self.lines[head])
            assert found
            self.assign(found[1], (self.value(found[1]) or Value()) + Value(1))
            return self.passes(head, found[1], found[3])
        if line == "UNTIL" or line.startswith("UNTIL "):
            return at + 1 if self.is_true(line[6:]) else self.match(at, -1, "REPEAT") + 1
        if not (line in ("", "ENDIF", "REPEAT") or line.endswith(":") or line.startswith(("PROC ", "EXTERN "))):
            self.block(line)
        return at + 1

    def passes(self, head: int, name: str, last: str) -> int:
        more = self.is_true(f"{name}<={last}")
        return head + 1 if more else self.match(head, 1, "ENDFOR") + 1

    def match(self, at: int, way: int, *ends: str) -> int:
        """The index of the line that ends what begins here."""
        opens, closes = ("IF", "WHILE", "FOR", "REPEAT"), ("ENDIF", "ENDWHILE", "ENDFOR", "UNTIL")
        depth = 0
        while True:
            at += way
            word = self.lines[at].split(" ")[0]
            is_jump = word == "IF" and " GOTO" in self.lines[at]
            if depth == 0 and word in ends and not is_jump:
                return at
            if word in opens and not is_jump:
                depth += way
            elif word in closes:
                depth -= way

    def label(self, name: str, at: int, way: str) -> int:
        places = [place for place, line in enumerate(self.lines) if line == f"{name}:"]
        return min(place for place in places if place > at) if way == "F" else max(p for p in places if p <= at)

    # Variables

    def cell(self, name: str) -> "Cell | None":
        if name in self.levels[-1]:
            return self.levels[-1][name]
        return self.levels[0].get(name) if self.main_def == "program" else None

    def read(self, name: str, formula: Formula) -> Value | None:
        if formula.ahead == "(" and name == "R":
            index = formula.one() or Value()
            name = f"R{int(index.number)}"
        if formula.ahead == "(" and self.cell(f"{name}[0]"):
            index = formula.one() or Value()
            name = f"{name}[{int(index.number)}]"
        if name in ("TRUE", "FALSE"):
            return Value(float(name == "TRUE"))
        if re.fullmatch(r"R\d+", name):
            return self.shared.setdefault(f"R{int(name[1:])}", lost(self.line))
        cell = self.cell(name)
        # Else it may be global data, which are known everywhere.
        return cell.value if cell else self.shared.setdefault(name, lost(self.line))

    def assign(self, name: str, value: Value) -> None:
        if re.fullmatch(r"R\d+", name):
            self.shared[f"R{int(name[1:])}"] = value
        elif cell := self.cell(name):
            cell.value = converted(value, cell.kind, self.line)
        else:
            self.shared[name] = value

    def define(self, line: str) -> None:
        kind, names = re.match(r"DEF (\w+)(?:\[\d+\])? (.+)", line).groups()  # type: ignore[union-attr]
        for each in names.split(","):
            name, _, text = each.strip().partition("=")
            value = converted((self.value(text) if text else None) or Value(), kind, self.line)
            size = re.fullmatch(r"(\w+)\[(\d+)\]", name)
            for one in [f"{size[1]}[{at}]" for at in range(int(size[2]))] if size else [name]:
                self.levels[-1][one] = Cell(kind, value)

    def call(self, name: str, given: Sequence[str]) -> None:
        head, line = self.heads[name], self.line
        parameters = re.match(r"PROC \w+ ?(?:\(([^)]*)\))?(.*)", self.lines[head])
        assert parameters
        level = dict[str, Cell]()
        names = [each.split() for each in parameters[1].split(",")] if parameters[1] else []
        for at, (*how, kind, own) in enumerate(names):
            text = given[at].strip() if at < len(given) else ""
            if how == ["VAR"]:
                known = self.cell(text) or (Shared(self.shared, text) if re.fullmatch(r"R\d+", text) else None)
                if known is None or known.kind != kind:
                    raise Stopped("another type by reference")
                level[own] = known
            else:
                level[own] = Cell(kind, converted((self.value(text) if text else None) or Value(), kind, self.line))
        kept = copy(self.modes)
        self.levels.append(level)
        self.section(head + 1)
        self.levels.pop()
        self.line = line
        if "SAVE" in parameters[2].split():
            if kept.work == self.modes.work and kept.active != self.modes.active:
                # By a setting, what the called program does to the offset in force stays or not.
                kept.active = {axis: lost(line) for axis in AXES}
            self.modes = kept

    # Blocks

    def block(self, line: str) -> None:
        if line.startswith("DEF "):
            self.define(line)
        elif (found := re.fullmatch(r"(\w+)(?: ?\((.*)\))?", line)) and found[1] in self.heads:
            self.call(found[1], _arguments(found[2] or ""))
        elif re.match(r"A?(TRANS|ROT|SCALE|MIRROR)\b|G5[89]\b|\$P_", line):
            self.frames(line)
        elif (found := re.fullmatch(r"(\w+(?:\[\d+\])?)=(.+)", line)) and not re.fullmatch(
            r"[XYZIJK]|ANG|RND|CHR|CHF|CR", found[1]
        ):
            self.assign(found[1], self.value(found[2]) or Value())
        else:
            self.words(line.split())

    def frames(self, line: str) -> None:
        name, *words = re.split(r"[ =]", line, maxsplit=1)
        said = dict[str, Value]()
        for address, text in re.findall(r"([A-Z]+)=?(\S*)", words[0]) if not name.startswith("$") and words else ():
            said[address] = self.value(text) or Value()
        frame, none = self.modes.frame, Value()
        if name.startswith("$"):
            self.framed(name, words[0])
            return
        shift = {axis: self.size(axis, said[axis], True) for axis in AXES if axis in said}
        if "X" in shift and self.modes.diameter != "DIAMOF":
            shift["X"] = lost(self.line)
        if name == "TRANS" and shift:
            known = shift if frame.is_plain else {axis: lost(self.line) for axis in AXES}
            frame = Frame(known, known)
        elif name == "ATRANS":
            along = times(frame.matrix, [shift.get(axis, none) for axis in AXES])
            added = {axis: frame.shift.get(axis, none) + one for axis, one in zip(AXES, along, strict=True)}
            frame = Frame(added, frame.coarse, frame.matrix, is_plain=False)
        elif name in ("G58", "G59") and frame.matrix == IDENTITY:
            coarse, total = dict(frame.coarse), dict(frame.shift)
            for axis, one in shift.items():
                fine = total.get(axis, none) - coarse.get(axis, none)
                total[axis] = one + fine if name == "G58" else coarse.get(axis, none) + one
                coarse[axis] = one if name == "G58" else coarse.get(axis, none)
            frame = Frame(total, coarse, is_plain=frame.is_plain and name == "G58")
        elif name in ("G58", "G59"):
            frame = Frame({axis: lost(self.line) for axis in AXES}, {}, frame.matrix, is_plain=False)
        else:
            old = frame if name.startswith("A") else Frame()
            frame = Frame(old.shift, old.coarse, joined(old.matrix, self.matrix(name, said)), is_plain=not said)
        self.modes.frame = frame

    def matrix(self, name: str, said: Mapping[str, Value]) -> Matrix:
        if not all(each.is_known for each in said.values()):
            raise Stopped("a frame that is not known")
        if name.endswith("ROT"):
            return turned(self.modes.plane, said["RPL"].number) if "RPL" in said else IDENTITY
        factors = [said[axis].number if name.endswith("SCALE") else -1 for axis in AXES if axis in said]
        named = [axis for axis in AXES if axis in said]
        sizes = dict(zip(named, factors, strict=True))
        return tuple(tuple(sizes.get(AXES[i], 1.0) * (i == j) for j in range(3)) for i in range(3))

    def framed(self, name: str, text: str) -> None:
        if name == "$P_PFRAME":
            function, axis, amount = re.match(r"(\w+)\((\w),(.+)\)", text).groups()  # type: ignore[union-attr]
            value = self.value(amount) or Value()
            if function == "CTRANS":
                self.modes.frame = Frame({axis: value}, {axis: value})
            else:
                pair = {"X": "YZ", "Y": "ZX", "Z": "XY"}[axis]
                self.modes.frame = Frame({}, {}, turned(pair, value.number), is_plain=False)
        elif name.startswith("$P_UIFR"):
            self.tables[f"G{53 + int(name[8])}"] = {axis: lost(self.line) for axis in AXES}
        elif name == "$P_IFRAME":
            self.modes.active = {axis: lost(self.line) for axis in AXES}
        else:
            self.lose(self.others)

    def words(self, words: Sequence[str]) -> None:
        codes = [word for word in words if re.fullmatch(r"G\d+", word)]
        self.modes.diameter = next((word for word in words if word.startswith("DIAM")), self.modes.diameter)
        is_own = [self.code(word) for word in codes]
        self.change_tool({word[0]: word for word in words if re.fullmatch(r"[TD]\d+", word)})
        ends = dict[str, tuple[Value, bool]]()
        corner, angle = None, None
        for found in filter(None, (re.fullmatch(r"(?:([A-Z_$]\w*)=(.+)|([A-Z])(.+))", word) for word in words)):
            name, text = found[1] or found[3], found[2] or found[4]
            if name in (*AXES, *"IJK"):
                way = re.fullmatch(r"(AC|IC)\((.+)\)", text)
                value = self.value(way[2] if way else text) or Value()
                ends[name] = value, way[1] == "AC" if way else self.modes.is_absolute
            elif name == "CR":
                ends["R"] = self.value(text) or Value(), True
            elif name in ("RND", "CHR", "CHF"):
                corner = name, (self.value(text) or Value()) * self.modes.unit
            elif name == "ANG":
                angle = self.value(text) or Value()
        if any(is_own) or "SUPA" in words:
            self.leave([axis for axis in ends if axis in AXES])
        elif ends or angle is not None:
            self.go(ends, corner, angle)

    def change_tool(self, told: Mapping[str, str]) -> None:
        if any(self.tools.get(name) != word for name, word in told.items()):
            self.tools.update(told)
            if self.is_turning:
                self.lose(self.others, "XZ")

    def code(self, word: str) -> bool:
        number, modes = int(word[1:]), self.modes
        if number in (0, 1, 2, 3):
            modes.motion = number
        elif number in PLANES:
            modes.plane = PLANES[number]
        elif number in (70, 71):
            modes.unit = 25.4 if number == 70 else 1.0
        elif number in (90, 91):
            modes.is_absolute = number == 90
        elif number in (54, 55, 56, 57, 500) or 505 <= number <= 599:
            self.choose(word)
        return number in (53, 153)


@dataclass
class Cell:
    """A variable with its type."""

    kind: str
    value: Value


class Shared(Cell):
    """An R parameter by reference."""

    def __init__(self, kept: dict[str, Value], name: str) -> None:
        self.kept, self.name, self.kind = kept, f"R{int(name[1:])}", "REAL"

    @property
    def value(self) -> Value:  # type: ignore[override]
        return self.kept.setdefault(self.name, lost(0))

    @value.setter
    def value(self, value: Value) -> None:
        self.kept[self.name] = value


def converted(value: Value, kind: str, line: int) -> Value:
    if kind == "REAL":
        return value
    if not value.is_known:
        return lost(line)
    return Value(rounded(value.number) if kind == "INT" else float(value.number != 0))


def _arguments(text: str) -> list[str]:
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and not depth:
            parts.append("")
        else:
            parts[-1] += letter
    return parts if text else []
