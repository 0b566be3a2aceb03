"""Arcs of every control, drawn at random: right ones, and the same made impossible in each of several ways."""

from dataclasses import dataclass, field
from math import cos, hypot, pi, sin
from random import Random

KINDS = ("centre", "radius", "full", "undefined", "both", "outside")
"""A centre that is not as far from both ends; a radius that is too small; a full circle by its radius; neither a centre
nor a radius; both; and a word of a centre for another plane."""

MILLS = ("fanuc-mill", "haas-mill", "nct-99m", "mitsubishi", "siemens-840d", "siemens-808d", "isg")
LATHES = ("fanuc-lathe", "haas-lathe", "yasnac-lx3", "cnc-pilot")
PLANES = {"G17": ("XY", "IJ", "K", "Z"), "G18": ("ZX", "KI", "J", "Y"), "G19": ("YZ", "JK", "I", "X")}
UNITS = {"siemens": ("G71", "G70"), "isg": ("G71", "G70")}
RADIUS = {"siemens-840d": "CR=", "siemens-808d": "CR="}
CONTOURS = {
    "siemens": "G1 X30. RND=2. F200\nY30.\n",
    "isg": "G1 X30. #RND=2. F200\nY30.\n",
    "mill": "G01 X30. ,R2. F200.\nY30.\n",
    "lathe": "G01 Z-30. ,R2. F0.2\nX60.\n",
}


def kinds_of(control: str) -> tuple[str, ...]:
    """The ways to make an arc of a control impossible: where a radius counts, a centre may stand beside it."""
    left_out = {
        "heidenhain": ("both", "outside"),
        "fanuc-mill": ("both",),
        "fanuc-lathe": ("both",),
        "mitsubishi": ("both",),
        # Without either, an arc touches what is before it.
        "cnc-pilot": ("outside", "undefined"),
    }
    return tuple(kind for kind in KINDS if kind not in left_out.get(control, ()))


@dataclass
class Arcs:
    """Some arcs in a row: the lines before them, and those of each arc, as words."""

    control: str
    before: list[str]
    rows: list[list[str]] = field(default_factory=list)
    """The words of each block; a list that begins with * is one line."""

    @property
    def text(self) -> str:
        """The program."""
        lines = [*self.before, *(" ".join(row) for row in self.rows)]
        if self.control == "heidenhain":
            numbered = [f"{number} {line}" for number, line in enumerate(lines)]
            return "\n".join(numbered) + "\n"
        return "\n".join(lines) + "\nM30\n"

    def shuffled(self, draw: Random) -> "Arcs":
        """The same with the words of each block in another order."""
        if self.control == "heidenhain":
            return self
        return Arcs(self.control, self.before, [draw.sample(row, len(row)) for row in self.rows])


class Drawing:
    """One drawing of arcs of a control."""

    def __init__(self, control: str, draw: Random) -> None:
        self.control, self.draw = control, draw
        self.is_lathe, self.is_klartext = control in LATHES, control == "heidenhain"
        self.is_inch = draw.random() < 0.4 and control != "cnc-pilot"
        self.unit, self.decimals = (25.4, 4) if self.is_inch else (1.0, 3)
        self.is_step = draw.random() < 0.4 and control != "cnc-pilot"
        self.plane = draw.choice([*PLANES]) if control in MILLS else "G18" if self.is_lathe else "G17"
        self.place = [self._round(draw.uniform(-2, 2)), self._round(draw.uniform(2, 4))]
        # Nothing that is turned lies beyond the axis.
        self.place[1] += 500 if control == "cnc-pilot" else 0
        self.motion = ""

    def _round(self, value: float) -> float:
        return round(value, self.decimals)

    def _size(self, least: float, most: float) -> float:
        return self.draw.uniform(least, most) / self.unit

    def arcs(self, kind: str = "") -> Arcs:
        """Arcs in a row, the last one impossible in a way, if one is named."""
        found = Arcs(self.control, self._before())
        count = self.draw.randint(1, 3)
        for number in range(count):
            found.rows += self._arc(kind if number == count - 1 else "")
        return found

    def _before(self) -> list[str]:
        group = next((name for name in ("siemens", "isg") if self.control.startswith(name)), "")
        first, second = self.place
        if self.is_klartext:
            name = "INCH" if self.is_inch else "MM"
            contour = ["L X+0 Y+0 R0 F500", "L X+30", "RND R2", "L Y+30"] if self.draw.random() < 0.5 else []
            return [f"BEGIN PGM A {name}", *contour, f"L X{first:+.4f} Y{second:+.4f} R0 F500"]
        if self.control == "cnc-pilot":
            return ["BEARBEITUNG", f"G0 X{2 * second:.3f} Z{first:.3f}"]
        unit = UNITS.get(group, ("G21", "G20"))[self.is_inch]
        # X is a diameter in G18 else.
        off = " DIAMOF" if group == "siemens" else ""
        lines = [f"{unit} G90 {self.plane}{off}"] if not self.is_lathe else [unit]
        if self.draw.random() < 0.5 and self.plane == "G17":
            lines += ["G00 X0 Y0", *CONTOURS[group or "mill"].splitlines()]
        elif self.draw.random() < 0.5 and self.is_lathe and self.control != "yasnac-lx3":
            lines += ["G00 X40. Z0.", *CONTOURS["lathe"].splitlines()]
        axes = PLANES[self.plane][0]
        lines.append(f"G00 {axes[0]}{first:.4f} {axes[1]}{self._at(second):.4f}")
        if self.is_step and not self.is_lathe:
            lines.append("G91")
        return lines

    def _at(self, second: float) -> float:
        return 2 * second if self.is_lathe else second

    def _arc(self, kind: str) -> list[list[str]]:
        draw = self.draw
        radius, begin = self._size(3, 60), draw.uniform(0, 2 * pi)
        turn = draw.choice((2, 3))
        sense = -1 if turn == 2 else 1
        most = 0.9 * pi if self.control == "cnc-pilot" else 1.75 * pi
        sweep = pi if draw.random() < 0.15 and self.control != "cnc-pilot" else draw.uniform(0.3 * pi, most)
        if kind == "radius":
            sweep = draw.uniform(0.6 * pi, most)
        spoke = [self._round(radius * cos(begin)), self._round(radius * sin(begin))]
        radius = hypot(*spoke)
        # From the centre to the start, turned.
        away = complex(-spoke[0], -spoke[1]) * complex(cos(sweep), sense * sin(sweep))
        step = [self._round(spoke[0] + away.real), self._round(spoke[1] + away.imag)]
        by_radius = kind in ("radius", "full") or (not kind and draw.random() < 0.4)
        if not kind and not by_radius and draw.random() < 0.15 and self.control != "cnc-pilot":
            step = [0.0, 0.0]
        if kind == "full":
            step = [0.0, 0.0]
        size = self._round(radius) * (-1 if sweep > pi else 1)
        if kind == "radius":
            size = self._round(hypot(*step) / 2 * 0.9)
        center: list[float] | None = None if by_radius or kind == "undefined" else spoke
        if kind == "centre":
            chord = hypot(*step)
            center = [self._round(each + 0.3 * radius * way / chord) for each, way in zip(spoke, step, strict=True)]
        shape = size if by_radius else None
        if kind == "both":
            shape = self._round(1.5 * radius)
        return self._written(turn, step, center, shape, is_outside=kind == "outside")

    def _written(
        self, turn: int, step: list[float], center: list[float] | None, size: float | None, *, is_outside: bool
    ) -> list[list[str]]:
        here = self.place
        self.place = there = [self._round(at + by) for at, by in zip(here, step, strict=True)]
        if self.is_klartext:
            return self._in_klartext(turn, here, step, center, size)
        axes, centers, outside, across = PLANES[self.plane]
        codes = [f"G0{turn}"] if self.motion != f"G0{turn}" or self.draw.random() < 0.5 else []
        codes = [f"G{turn}"] if self.control == "cnc-pilot" else codes
        self.motion = f"G0{turn}"
        values = step if self.is_step else there
        letters = "WU" if self.is_step and self.is_lathe else axes
        words = [f"{letters[0]}{values[0]:.4f}", f"{letters[1]}{self._at(values[1]):.4f}"]
        if center is not None:
            words += [f"{name}{value:.4f}" for name, value in zip(centers, center, strict=True) if value or is_outside]
        if size is not None:
            words.append(f"{RADIUS.get(self.control, 'R')}{size:.4f}")
        if is_outside:
            words.append(f"{outside}1.0")
        elif self.control in MILLS and self.draw.random() < 0.2:
            words.append(f"{across}1.0")
        return [[*codes, *words]]

    def _in_klartext(
        self, turn: int, here: list[float], step: list[float], center: list[float] | None, size: float | None
    ) -> list[list[str]]:
        prefix, values = ("I", step) if self.is_step else ("", [at + by for at, by in zip(here, step, strict=True)])
        sense = "DR-" if turn == 2 else "DR+"
        ends = [f"{prefix}X{values[0]:+.4f}", f"{prefix}Y{values[1]:+.4f}"]
        if size is not None:
            return [["CR", *ends, f"R{size:+.4f}", sense]]
        if center is None:
            return [["CR", *ends, sense]]
        about = ["CC", *(f"{axis}{at + by:+.4f}" for axis, at, by in zip("XY", here, center, strict=True))]
        return [about, ["C", *ends, sense]]
