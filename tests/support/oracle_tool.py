"""Whether a tool cuts a contour, and how far a path is from one, by points alone: no offset is computed here."""

import json
from dataclasses import dataclass
from math import atan2, ceil, cos, sin, tau
from typing import Any

import numpy
from click.testing import CliRunner
from numpy.typing import NDArray

from contoursolve.cli import main

Points = NDArray[numpy.complex128]


@dataclass
class Part:
    """A line, or an arc about a centre: `turn` is +1 to the left, -1 to the right, 0 for a line."""

    start: complex
    end: complex
    center: complex = 0j
    turn: int = 0

    @property
    def radius(self) -> float:
        return abs(self.start - self.center)

    @property
    def sweep(self) -> float:
        ratio = (self.end - self.center) / (self.start - self.center)
        return (atan2(ratio.imag, ratio.real) * self.turn) % tau or tau

    @property
    def length(self) -> float:
        return self.radius * self.sweep if self.turn else abs(self.end - self.start)

    def at(self, shares: Points) -> tuple[Points, Points]:
        """Places at shares of the way, and the directions of travel there."""
        if not self.turn:
            way = self.end - self.start
            return self.start + shares * way, numpy.full(len(shares), way / abs(way))
        spokes = (self.start - self.center) * numpy.exp(1j * self.turn * self.sweep * shares)
        return self.center + spokes, 1j * self.turn * spokes / self.radius

    def distances(self, points: Points) -> Points:
        """The distance of each point."""
        ends = numpy.minimum(abs(points - self.start), abs(points - self.end))
        if self.turn:
            away = points - self.center
            angles = (numpy.angle(away / (self.start - self.center)) * self.turn) % tau
            return numpy.where(angles <= self.sweep, numpy.minimum(abs(abs(away) - self.radius), ends), ends)
        way = (self.end - self.start) / self.length
        along = ((points - self.start) * way.conjugate()).real
        aside = abs(((points - self.start) * way.conjugate()).imag)
        return numpy.where((along >= 0) & (along <= self.length), aside, ends)


def clearance(points: Points, parts: list[Part]) -> Points:
    """The distance of each point from the nearest part."""
    return numpy.min([part.distances(points) for part in parts], axis=0)


def is_cut(parts: list[Part], radius: float, side: int, step: float = 0.01) -> bool | None:
    """Whether a tool touches all of a contour but what lies in its inside corners, where it goes on without a leap;
    None where points so far apart cannot tell."""
    before: complex | None = None
    apart = 0.0
    for number, part in enumerate(parts):
        count = max(ceil(part.length / step), 8)
        shares = numpy.linspace(0, 1, count + 1)
        places, ways = part.at(shares)
        centers = places + 1j * side * radius * ways
        off = clearance(centers, parts) - radius
        touched = off >= -1e-7
        if not touched.any():
            return None if part.length < 4 * step or off.max() > -step else False
        first, last = numpy.flatnonzero(touched)[[0, -1]]
        if not touched[first : last + 1].all():
            return None if off[first : last + 1].min() > -step / 10 else False
        inside = number and _turn(parts[number - 1], part) * side > 0
        if first and not inside:
            return None if off[:first].min() > -step / 10 else False
        apart = max(apart, abs(numpy.diff(centers)).max())
        if before is not None and inside and abs(centers[first] - before) > 3 * apart:
            return None if abs(centers[first] - before) < 30 * apart else False
        is_inside_behind = number + 1 < len(parts) and _turn(part, parts[number + 1]) * side > 0
        if last < count and not is_inside_behind:
            return None if off[last + 1 :].min() > -step / 10 else False
        before = centers[last]
    return True


def _turn(one: Part, other: Part) -> float:
    """The angle between two parts, to the left positive."""
    (_, before), (_, behind) = one.at(numpy.array([1.0])), other.at(numpy.array([0.0]))
    ratio = complex(behind[0] / before[0])
    return atan2(ratio.imag, ratio.real)


def draw(random: numpy.random.Generator) -> list[Part]:
    """A contour of lines and arcs in a row, some of them tangent, whose ends are decimals of a thousandth. Its ends do
    not cross: they would be run-in and run-off."""
    while True:
        parts = _draw(random)
        places = parts[0].at(numpy.linspace(0, 1, 400))[0]
        if len(parts) < 3 or clearance(places, parts[-1:]).min() > 0.1:
            return parts


def _draw(random: numpy.random.Generator) -> list[Part]:
    here, way = complex(*random.integers(-20, 20, 2)), random.uniform(0, tau)
    parts = list[Part]()
    for _ in range(random.integers(2, 7)):
        turn = 0.0 if random.random() < 0.35 and parts else random.choice([-1, 1]) * random.uniform(0.15, 2.2)
        way += turn if parts else 0.0
        unit = complex(cos(way), sin(way))
        if random.random() < 0.5:
            end = here + unit * random.uniform(0.4, 14)
            end = complex(round(end.real, 3), round(end.imag, 3))
            parts.append(Part(here, end))
            way = atan2((end - here).imag, (end - here).real)
        else:
            bend, radius, sweep = int(random.choice([-1, 1])), random.uniform(0.5, 9), random.uniform(0.3, 3.0)
            center = here + 1j * bend * radius * unit
            center = complex(round(center.real, 3), round(center.imag, 3))
            end = center + (here - center) * complex(cos(bend * sweep), sin(bend * sweep))
            parts.append(Part(here, end, center, bend))
            spoke = 1j * bend * (end - center)
            way = atan2(spoke.imag, spoke.real)
        here = parts[-1].end
    return parts


TIPS = {0: 0j, 1: 1 + 1j, 2: -1 + 1j, 3: -1 - 1j, 4: 1 - 1j, 5: 1, 6: 1j, 7: -1, 8: -1j, 9: 0j}
"""From the centre of a nose to the programmed point, in radii, by the number of the tip."""


def run(*words: str) -> Any:
    done = CliRunner().invoke(main, [*words])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exc_info
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


@dataclass
class Spelling:
    """The words of a control for a contour in a plane: its axes, those of the centre of an arc, counted from where the
    arc begins, how many times the second axis counts, what stands first, and the codes of both sides."""

    control: str
    axes: str = "XY"
    centers: str = "IJ"
    factor: int = 1
    head: str = "G17 G90"
    sides: tuple[str, str] = ("G41 ", "G42 ")
    options: tuple[str, ...] = ()

    @property
    def is_lathe(self) -> bool:
        return self.axes == "ZX"

    def place(self, at: complex) -> str:
        """The words of a place, each number with twelve decimals."""
        return f"{self.axes[0]}{at.real:.12f} {self.axes[1]}{at.imag * self.factor:.12f}"

    def move(self, part: Part) -> list[str]:
        """The blocks of a part."""
        center = part.center - part.start
        words = f" {self.centers[0]}{center.real:.12f} {self.centers[1]}{center.imag:.12f}" if part.turn else ""
        return [f"G0{1 + (part.turn < 0) + 2 * (part.turn > 0)} {self.place(part.end)}{words}"]

    def program(self, contours: list[list[Part]], side: int = 0) -> str:
        """Contours with rapids between them; a side (+1 left, -1 right) is said in a move of 50 that leads to each."""
        lines = [self.head] if self.head else []
        for parts in contours:
            _, way = parts[0].at(numpy.array([0.0]))
            begin = parts[0].start - 50 * way[0] * (1 if side else 0)
            lines.append(f"G00 {self.place(begin)}")
            if side:
                lines.append(f"{self.sides[side < 0]}G00 {self.place(parts[0].start)}")
            lines += [line for part in parts for line in self.move(part)]
            if side:
                _, way = parts[-1].at(numpy.array([1.0]))
                lines.append(f"G40 G00 {self.place(parts[-1].end + 50j * side * way[0])}")
        return "\n".join(lines)


_RL = {"G41 ": "RL", "G42 ": "RR"}


class Klartext(Spelling):
    """Blocks of HEIDENHAIN."""

    def place(self, at: complex) -> str:
        return f"X{at.real:+.12f} Y{at.imag:+.12f}"

    def move(self, part: Part) -> list[str]:
        if not part.turn:
            return [f"L {self.place(part.end)} F300"]
        return [f"CC {self.place(part.center)}", f"C {self.place(part.end)} DR{'-+'[part.turn > 0]}"]

    def program(self, contours: list[list[Part]], side: int = 0) -> str:
        lines = super().program(contours, side).splitlines()
        for number, line in enumerate(lines):
            code, rapid, place = line.rpartition("G00")
            if rapid:
                lines[number] = f"L{place} {_RL.get(code, 'R0')} FMAX"
        return "\n".join(["BEGIN PGM T MM", *lines, "END PGM T MM"])


_LATHE = ("ZX", "KI", 2, "G18")
SPELLINGS = (
    Spelling("fanuc-lathe", *_LATHE),
    Spelling("fanuc-mill"),
    Spelling("haas-lathe", *_LATHE),
    Spelling("haas-mill"),
    Spelling("yasnac-lx3", *_LATHE),
    Spelling("nct-99m"),
    Spelling("siemens-840d", head="G17 G90 G71"),
    Spelling("siemens-840d", "ZX", "KI", 2, "G18 G90 G71 DIAMON", options=("--setting", "siemens-840d.machine=lathe")),
    Spelling("siemens-808d", head="G17 G90 G71"),
    Spelling("siemens-808d", "ZX", "KI", 1, "G18 G90 DIAMOF", options=("--setting", "siemens-808d.machine=lathe")),
    Spelling("isg"),
    Spelling("isg", "ZX", "KI", 1, "G18 G90", options=("--setting", "isg.machine=lathe")),
    Spelling("mitsubishi"),
    Klartext("heidenhain", head=""),
)
"""Every control; some turn and mill."""


def program_of(contours: list[list[Part]], *, is_lathe: bool, factor: int = 2) -> str:
    """Contours with rapids between them, as Fanuc controls read them; X of a lathe counts so many times."""
    spelling = Spelling("fanuc-lathe", "ZX", "KI", factor, "G18") if is_lathe else Spelling("fanuc-mill", head="G17")
    return spelling.program(contours)


def parts_of(elements: list[dict[str, Any]]) -> list[Part]:
    return [
        Part(
            complex(*each["start"]),
            complex(*each["end"]),
            complex(*each.get("center", (0, 0))),
            {"cw": -1, "ccw": 1}.get(each.get("turn", ""), 0),
        )
        for each in elements
    ]
