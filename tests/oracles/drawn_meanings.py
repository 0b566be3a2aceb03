"""Programs for the reference interpreters, drawn: calls three deep, variables of the same names, offsets, frames and
tool changes before, in and behind blocks with corners, decisions and loops."""

from collections.abc import Callable, Sequence
from random import Random

_SIZES = ("1", "2", "2.5", "3", "4")
_FAR = ((60, 95), (50, 90), (10, 30), (5, 25), (100, 140))


class Drawn:
    """A drawn program; `text` is its text."""

    def __init__(self, seed: str, control: str) -> None:
        self.random, self.control = Random(f"{control} {seed}"), control
        self.is_turning = control in ("siemens-turning", "fanuc-lathe")
        self.axes = "XZ" if self.is_turning else "XY"
        self.names, self.labels = list[str](), 0
        """The variables that are known where lines are drawn."""
        self.text = "\n".join(self.program()) + "\n"

    def is_so(self, share: float) -> bool:
        return self.random.random() < share

    def one(self, options: Sequence[str]) -> str:
        return self.random.choice(options)

    def near(self, low: float = 0, high: float = 40) -> str:
        """A number with at most one decimal."""
        return f"{self.random.randint(int(low), int(high))}{self.one(('.', '.', '.5', '.4', '.6'))}"

    def program(self) -> list[str]:
        raise NotImplementedError

    def lines(self, depth: int, options: Sequence[tuple[int, Callable[[int], list[str]]]], count: int) -> list[str]:
        chosen = self.random.choices([each for _, each in options], [weight for weight, _ in options], k=count)
        return [line for each in chosen for line in each(depth)]

    def contour(self, depth: int) -> list[str]:
        rapid, straight = self.moves
        one, other = self.axes
        lines = [f"{rapid} {self.word(one, 0, 20)} {self.word(other, 0, 20)}"] if self.is_so(0.45) else []
        if self.has_angles and self.is_so(0.1):
            # Two lines by their angles; both ends are in the second.
            a, b = self.random.choice(((30, 120), (20, 80), (60, 150)))
            ends = " ".join(self.far(axis) for axis in sorted(self.axes))
            return [*lines, f"{straight} {self.angle(a)}{self.corner()}", f"{ends} {self.angle(b)}"]
        blocks = []
        for at, (axis, low, high) in enumerate(self.ends(self.random.randint(2, 4))):
            words = [self.word(axis, low, high)]
            if self.is_so(0.2):
                words.append(self.word(self.axes[self.axes[0] == axis], 20, 90))
            elif self.has_angles and self.is_so(0.08):
                words.append(self.angle(self.one(("20", "70", "110", "160", "200"))))
            blocks.append(f"{straight} " * (at == 0) + " ".join(words))
        lines += [each + (self.corner() if self.is_so(0.8) else "") for each in blocks[:-1]] + blocks[-1:]
        for at in range(len(lines)):
            if self.is_so(0.04):
                lines[at] = f"{self.one((*self.OFFSETS, *self.codes))} {lines[at]}"
            elif self.is_so(0.02) and at:
                lines[at] = "\n".join([*self.effect(depth), lines[at]])
        return lines

    @property
    def simple(self) -> list[tuple[int, Callable[[int], list[str]]]]:
        return [(3, self.contour), (3, self.effect), (2, self.assignment), (3, self.call), (1, self.mode)]

    def ends(self, count: int) -> list[tuple[str, int, int]]:
        """Axes in turn, each with the limits of where it goes."""
        first, far = self.random.randrange(2), self.random.sample(_FAR, count)
        return [(self.axes[(first + at) % 2], *limits) for at, limits in enumerate(far)]


class DrawnSinumerik(Drawn):
    """Programs of SINUMERIK."""

    NAMES = ("AA", "BB", "ZZ", "TIEFE", "_Q")
    OFFSETS = ("G54", "G54", "G55", "G500", "G507")
    moves, codes, has_angles = ("G0", "G1"), ("D2", "G90", "G91"), True

    def angle(self, degrees: object) -> str:
        return f"ANG={degrees}"

    def far(self, axis: str) -> str:
        return self.word(axis, 90, 130)

    def value(self, low: float = 0, high: float = 40) -> str:
        """What stands behind `=`."""
        if not self.is_so(0.35):
            return self.near(low, high)
        name = self.one([*self.names, "R1", "R2"])
        return self.one((f"{name}+{self.near(low, high)}", f"{self.near(low, high)}-{name}/2", name, f"2*{name}"))

    def word(self, axis: str, low: float, high: float) -> str:
        value, way = self.value(low, high), self.random.random()
        if way < 0.08:
            return f"{axis}={'IC' if way < 0.05 else 'AC'}({value})"
        return f"{axis}{value}" if value[0].isdigit() and not {*value} & {*"+-*/"} else f"{axis}={value}"

    def corner(self) -> str:
        value = self.one([*_SIZES] * 6 + [each for each in self.names if self.is_so(0.05)])
        return f" {self.one(('RND', 'RND', 'CHR', 'CHF'))}={value}"

    def effect(self, depth: int) -> list[str]:
        """What moves the zero, or the place."""
        axis, other = self.random.sample(self.axes, 2)
        # Frames along a diameter are not stated by the facts.
        axis = "Z" if self.is_turning else axis
        shift = [f"{axis}{self.near()}", f"{axis}={self.value()}"]
        shift += [f"X{self.near()} Y{self.near()}"] * (not self.is_turning)
        options = [
            *[self.one(self.OFFSETS)] * 3,
            *[f"{self.one(('TRANS', 'ATRANS', 'TRANS', 'G58', 'G59'))} {self.one(shift)}"] * 4,
            self.one(("TRANS", "ROT", f"ROT RPL={self.near()}", f"AROT RPL={self.near()}", f"MIRROR {axis}0")),
            f"{self.one(('SCALE', 'ASCALE'))} X2 {self.axes[1]}2",
            f"$P_PFRAME={self.one((f'CTRANS({axis},{self.near()})', 'CROT(Z,30)', 'CROT(Y,30)'))}",
            f"{self.one(('$P_IFRAME', '$P_UIFR[1]', '$P_UIFR[2]', '$P_BFRAME'))}=CTRANS({axis},5)",
            *[self.one(("T1 D1", "T1 D2", "T2 D1", "D2", "D0"))] * 2,
            f"{self.one(('G53', 'G153', 'SUPA'))} G0 {other}{self.near()}" if self.is_so(0.7) else "M5",
            f"G0 {self.word(axis, 0, 30)}",
        ]
        return [self.one(options)]

    def mode(self, depth: int) -> list[str]:
        code, back = self.one(("G91 G90", "G70 G71", "G70 G71", "G91 G90", "DIAMOF DIAMON", "DIAM90 DIAMON")).split()
        if code[0] == "D" and not self.is_turning:
            code, back = "G91", "G90"
        inner = self.contour(depth) if self.is_so(0.3) else [f"G0 {self.word(self.axes[0], 1, 9)}"]
        return [f"{code} {inner[0]}", *inner[1:], *([back] if self.is_so(0.7) else [])]

    def assignment(self, depth: int) -> list[str]:
        return [f"{self.one([*self.names, 'R1', 'R2'])}={self.value()}"]

    def call(self, depth: int) -> list[str]:
        if depth >= 3:
            return self.assignment(depth)
        number = self.random.choice([each for each in range(len(self.heads)) if self.heads[each][0] > depth])
        _, name, parameters = self.heads[number]
        given = []
        for how, _, _ in parameters:
            place = self.one(
                [*(self.names if not how else [each for each in self.names if each in self.real]), "R1", "R2"]
            )
            given.append(place if how or self.is_so(0.3) else self.near() if self.is_so(0.7) else f"{place}+1")
        return [f"{name}({','.join(given)})" if given else name]

    def condition(self) -> str:
        name = self.one([*self.names, "R1", "R1"])
        return f"{name}{self.one(('>', '<', '>=', '<>', '=='))}{self.near(10, 30)}"

    def choice(self, depth: int) -> list[str]:
        inner, other = self.lines(depth, self.simple, 1), self.lines(depth, self.simple, 1)
        if self.is_so(0.25):
            self.labels += 1
            return [f"IF {self.condition()} GOTOF L{self.labels}", *inner, f"L{self.labels}:"]
        return [f"IF {self.condition()}", *inner, *(["ELSE", *other] if self.is_so(0.5) else []), "ENDIF"]

    def loop(self, depth: int) -> list[str]:
        self.labels += 1
        name = f"R{90 + self.labels}"
        inner = self.lines(depth, self.simple, 1)
        if self.is_so(0.5):
            return [f"FOR {name}=1 TO {self.one(('1', '2', '3'))}", *inner, "ENDFOR"]
        return [f"{name}=0", f"WHILE {name}<{self.one(('1', '2', '3'))}", *inner, f"{name}={name}+1", "ENDWHILE"]

    def definitions(self, least: int) -> list[str]:
        names, lines = self.random.sample(self.NAMES, self.random.randint(least, 2)), list[str]()
        self.real = []
        for name in names:
            start = self.one(("", f"={self.near(5)}", f"={self.near(5)}"))
            kind = self.one(("REAL", "REAL", "INT", "BOOL"))
            lines.append(f"DEF {kind} {name}{start}")
            if kind == "REAL":
                self.real.append(name)
        self.names = names
        return lines

    def program(self) -> list[str]:
        self.heads = list[tuple[int, str, list[tuple[str, str, str]]]]()
        for depth in (1, 2, 3):
            for which in range(self.random.randint(1, 2)):
                names = self.random.sample(self.NAMES, self.random.choice((0, 0, 1, 1, 2)))
                said = [self.one(("VAR REAL", "REAL", "REAL", "INT")).rpartition(" ") for _ in names]
                kinds = [(how, kind, each) for (how, _, kind), each in zip(said, names, strict=True)]
                self.heads.append((depth, f"SUB{depth}{which}", kinds))
        options = [*self.simple, (1, self.choice), (1, self.loop)]
        own = self.definitions(0)
        main, head = (
            self.names,
            "G18 G71 G90 G54 " + self.one(("DIAMON", "DIAMON", "DIAMOF")) if self.is_turning else "",
        )
        text = [*own, head or "G17 G71 G90 G54", "T1 D1"]
        text += [f"R1={self.near(5)}"] * self.is_so(0.8) + [f"R2={self.near(5)}"] * self.is_so(0.8)
        text += [f"G0 {self.axes[0]}{self.near(0, 9)} {self.axes[1]}{self.near(0, 9)}"] * self.is_so(0.9)
        text += [*self.lines(0, options, self.random.randint(2, 5)), *self.contour(0), "M30"]
        for depth, name, parameters in self.heads:
            # What a caller of a caller defines is tried as well.
            taken = [each for _, _, each in parameters]
            own = [line for line in self.definitions(0) if line.split()[2].partition("=")[0] not in taken]
            self.real = [each for each in self.real if each not in taken]
            self.real += [each for _, kind, each in parameters if kind == "REAL"]
            self.names = [*self.names, *taken, *main]
            listed = ", ".join(f"{how} {kind} {each}".strip() for how, kind, each in parameters)
            flags = self.one(("", "", " SAVE", " SAVE", " SAVE DISPLOF", " DISPLOF"))
            text += [f"PROC {name}{f'({listed})' if listed else ''}{flags}", *own]
            text += [*self.lines(depth, options, self.random.randint(1, 3)), self.one(("RET", "M17"))]
        return "\n".join(text).split("\n")


class DrawnFanuc(Drawn):
    """Programs of Fanuc macros."""

    OFFSETS = ("G54", "G54", "G55", "G57", "G54.1 P2")
    moves = ("G00", "G01")
    has_angles = property(lambda self: self.is_turning)
    codes = property(lambda self: ("T0202",) if self.is_turning else ("G90", "G91"))

    def angle(self, degrees: object) -> str:
        return f",A{degrees}."

    def far(self, axis: str) -> str:
        return f"{axis}{self.near(90, 130)}"

    def value(self, low: float = 0, high: float = 40) -> str:
        if not self.is_so(0.35):
            return self.near(low, high)
        name = self.one(("#1", "#2", "#24", "#25", "#100", "#101"))
        number = self.near(low, high)
        return self.one((f"[{name}+{number}]", f"[{number}-{name}/2.]", name, f"[2.*{name}]"))

    def word(self, axis: str, low: float, high: float) -> str:
        if self.is_turning and self.is_so(0.1):
            axis = "UW"["XZ".index(axis)]
        return f"{axis}{self.value(low, high)}"

    def corner(self) -> str:
        value = self.one([f"{each}." if "." not in each else each for each in _SIZES] * 6 + ["#18", "#100"])
        return f" ,{self.one('RRC')}{value}"

    def effect(self, depth: int) -> list[str]:
        axis = self.one(self.axes)
        number = 5221 + 20 * self.random.choice((0, 0, 1)) + self.axes.index(axis)
        options = [
            *[self.one(self.OFFSETS)] * 3,
            *[f"G10 L2 P{self.one('0112')} {axis}{self.near()}"] * 2,
            f"#{number}={self.one((self.near(), f'#{number}+{self.near()}'))}",
            f"#{5201 + self.axes.index(axis)}={self.near()}",
            f"G53 G00 {axis}{self.near()}",
            f"G00 {self.word(axis, 0, 30)}",
            "#100=12.",
        ]
        if self.is_turning:
            options += [self.one(("T0101", "T0202", "T0100", "T0102", "T0"))] * 4 + [f"G50 {axis}{self.near()}"]
        else:
            options += [self.one(self.shifts)] * 2 + [self.one(("G43 H2", "G49", "T2 M06"))]
        return [self.one(options)]

    @property
    def shifts(self) -> list[str]:
        """G52 or G92: how they join is not stated by the facts."""
        code = "G52" if self.has_local else "G92"
        return [f"{code} X{self.near()}", f"{code} X{self.near()} Y{self.near()}", f"{code} Y0."]

    def mode(self, depth: int) -> list[str]:
        if self.is_turning:
            return self.contour(depth)
        inner = self.contour(depth) if self.is_so(0.3) else [f"G00 {self.word(self.axes[0], 1, 9)}"]
        return [f"G91 {inner[0]}", *inner[1:], *(["G90"] if self.is_so(0.7) else [])]

    def assignment(self, depth: int) -> list[str]:
        value = self.value()
        return [f"#{self.one(('1', '2', '24', '25', '100', '101'))}={value}"]

    def call(self, depth: int) -> list[str]:
        if depth >= 3:
            return self.assignment(depth)
        target = self.one([str(each) for each in self.heads if int(each) // 100 > depth])
        times = self.one(("", "", " L2"))
        if self.is_so(0.4):
            return [f"M98 P{target}{times}"]
        letters = self.random.sample(["A", "B", "R", "X", "Y"], self.random.randint(0, 3))
        sizes = [self.value(1, 4) if each == "R" else self.value(5, 40) for each in letters]
        given = [
            f"{each}{size.replace('.', '') if self.is_so(0.1) and size[0].isdigit() and size[-1] == '.' else size}"
            for each, size in zip(letters, sizes, strict=True)
        ]
        return [" ".join([f"G65 P{target}{times}", *given])]

    def condition(self) -> str:
        name = self.one(("#1", "#24", "#100", "#101"))
        return f"[{name} {self.one(('GT', 'LT', 'GE', 'NE', 'EQ'))} {self.near(10, 30)}]"

    def choice(self, depth: int) -> list[str]:
        self.labels += 1
        inner = self.lines(depth, self.simple, 1)
        if self.is_so(0.2):
            return [f"IF{self.condition()}THEN #100={self.near()}"]
        return [f"IF{self.condition()}GOTO {self.labels}", *inner, f"N{self.labels} M05"]

    def loop(self, depth: int) -> list[str]:
        self.labels += 1
        name = f"#{110 + self.labels}"
        inner = self.lines(depth, self.simple, 1)
        more = f"WHILE[{name} LT {self.one(('1.', '2.', '3.'))}]DO1"
        return [f"{name}=0", more, *inner, f"{name}={name}+1.", "END1"]

    def program(self) -> list[str]:
        self.heads, self.has_local = [101, 102, 201, 202, 301], self.is_so(0.5)
        options = [*self.simple, (1, self.choice), (1, self.loop)]
        text = ["G21 G40 G99 G54", "T0101"] if self.is_turning else ["G21 G17 G90 G54"]
        text += [f"#{each}={self.near(5)}" for each in (1, 2, 24, 25, 100, 101) if self.is_so(0.7)]
        text += [f"#18={self.near(1, 3)}"]
        text += [f"G00 {self.axes[0]}{self.near(0, 9)} {self.axes[1]}{self.near(0, 9)}"] * self.is_so(0.9)
        text += [*self.lines(0, options, self.random.randint(2, 5)), *self.contour(0), "M30"]
        for head in self.heads:
            text += [f"O{head}", *self.lines(head // 100, options, self.random.randint(1, 3)), "M99"]
        return "\n".join(text).split("\n")


def drawn(seed: str, control: str) -> str:
    return (DrawnSinumerik if control.startswith("siemens") else DrawnFanuc)(seed, control).text
