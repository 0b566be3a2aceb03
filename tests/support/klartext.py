"""Klartext programs that were drawn first, with the path that they state; and what a plain Klartext program runs."""

import re
from cmath import phase, rect
from collections.abc import Iterator
from math import degrees, pi, radians, tan
from random import Random
from typing import NamedTuple

from interpreter import Motion

Element = tuple[complex, complex, complex | None, str]
"""Where it begins and ends, its centre, and `line`, `cw` or `ccw`."""

FREE_LINES = ("ends", "angle", "increments", "polar")
LINES, ARCS = ("L", "L increments", "LP"), ("C", "CR", "CP", "CP steps")


class Drawn(NamedTuple):
    """A program, the path of its chain, and what it shows."""

    text: str
    path: list[Element]
    shows: frozenset[str]


class _Drawing:
    """A path on its way, and the blocks that state it."""

    def __init__(self, rng: Random, share: float) -> None:
        """`share` is how many of the elements are free ones."""
        self.rng, self.is_free, self.is_plain = rng, True, not share
        self.here = complex(rng.randint(-40, 40), rng.randint(-40, 40))
        self.way = rect(1, radians(rng.uniform(-180, 180)))
        self.blocks: list[str] = []
        self.path: list[Element] = []
        self.shows: set[str] = set()
        self.was_line = self.is_exact = False
        """`is_exact`: what has been stated determines the end of the last element, and not more than that."""

    def line(self) -> None:
        """A line that goes off at an angle, or on in the same direction."""
        rng, before = self.rng, self.way
        is_tangent = self.is_exact and not self.was_line and rng.random() < 0.5
        if not is_tangent:
            self.way *= rect(1, radians(rng.choice((-1, 1)) * rng.uniform(25, 120)))
        length = rng.uniform(20, 45)
        end = self.here + length * self.way
        corner = self.was_line and rng.random() < 0.5 and not is_tangent
        if corner:
            self._corner(before)
        pole = complex(rng.randint(-80, 80), rng.randint(-80, 80))
        ends, angle = _at(end), f"AN{degrees(phase(self.way)):+.9f}"
        polar = f"PR+{abs(end - pole):.9f} PA{degrees(phase(end - pole)):+.9f}"
        if self.is_free:
            how = rng.choice(FREE_LINES)
            if how == "polar":
                self.blocks.append(f"FPOL {_at(pole)}")
            words = {"ends": ends, "angle": f"{angle} LEN{length:.9f}", "polar": polar}
            words["increments"] = _at(end - self.here, "I")
            if is_tangent and how == "angle":
                self._say(f"FLT LEN{length:.9f}", "FLT")
            else:
                self._say(f"FL {words[how]}", f"FL {how}")
        else:
            how = rng.choice(LINES)
            if how == "LP":
                self.blocks.append(f"CC {_at(pole)}")
            self._say({"L": f"L {ends}", "LP": f"LP {polar}"}.get(how, f"L {_at(end - self.here, 'I')}"), how)
        self.path.append((self.path[-1][1] if corner else self.here, end, None, "line"))
        self.here, self.was_line, self.is_exact = end, True, True

    def _corner(self, before: complex) -> None:
        """A rounding or a chamfer between two lines."""
        rng, turn = self.rng, phase(self.way / before)
        if rng.random() < 0.5:
            radius = rng.uniform(0.5, 3.5)
            setback, text, name = radius * abs(tan(turn / 2)), f"RND R{radius:.9f}", "RND"
        else:
            radius, setback = 0.0, rng.uniform(0.5, 6)
            text, name = f"CHF {setback:.9f}", "CHF"
        begin, end = self.here - setback * before, self.here + setback * self.way
        start, _, center, kind = self.path.pop()
        self.path.append((start, begin, center, kind))
        sign = 1 if turn > 0 else -1
        arc = (begin + sign * 1j * before * radius, "ccw" if turn > 0 else "cw")
        self.path.append((begin, end, *arc) if radius else (begin, end, None, "line"))
        self._say(text, name)

    def arc(self) -> None:
        """An arc that goes on in the same direction, or turns off."""
        rng, is_tangent = self.rng, self.is_exact and self.rng.random() < 0.7
        if not is_tangent:
            self.way *= rect(1, radians(rng.uniform(-100, 100)))
        radius, sweep, sign = rng.uniform(4, 30), radians(rng.uniform(30, 340)), rng.choice((-1, 1))
        center = self.here + sign * 1j * self.way * radius
        end = center + (self.here - center) * rect(1, sign * sweep)
        sense = "DR" + ("+" if sign > 0 else "-")
        ends, place = _at(end), f"CCX{center.real:+.9f} CCY{center.imag:+.9f}"
        ended = f"CCA{degrees(phase(end - center)):+.9f}"
        if self.is_free:
            if is_tangent and rng.random() < 0.6:
                self._say(f"FCT {sense} R{radius:.9f} {ended}", "FCT")
            else:
                self._say(f"FC {sense} {place} {ended}", "FC")
        else:
            how = rng.choice([*ARCS, *(["CT"] * 4 if is_tangent and self.is_plain else [])])
            turned = f"IPA{sign * degrees(sweep):+.9f}"
            if how in ("C", "CP", "CP steps"):
                self.blocks.append(f"CC {_at(center)}")
            text = {
                "C": f"C {ends} {sense}",
                "CR": f"CR {ends} R{radius if sweep < pi else -radius:+.9f} {sense}",
                "CP": f"CP PA{degrees(phase(end - center)):+.9f} {sense}",
                "CP steps": f"CP {turned} {sense}",
                "CT": f"CT {ends}",
            }[how]
            self._say(text, how)
        self.path.append((self.here, end, center, "ccw" if sign > 0 else "cw"))
        self.way *= rect(1, sign * sweep)
        self.here, self.was_line, self.is_exact = end, False, self.is_free or how not in ("C", "CR")

    def _say(self, text: str, name: str) -> None:
        self.blocks.append(text)
        self.shows.add(name)


def _at(point: complex, step: str = "") -> str:
    return f"{step}X{point.real:+.9f} {step}Y{point.imag:+.9f}"


def random_program(rng: Random, share: float = 1.0) -> Drawn:
    """A program with this share of free elements among conventional moves, each determined by those before it."""
    drawing = _Drawing(rng, share)
    start = drawing.here
    drawing.blocks.append(f"L {_at(start)} R0 FMAX")
    for _ in range(rng.randint(3, 9)):
        drawing.is_free = rng.random() < share
        drawing.line() if rng.random() < 0.6 else drawing.arc()
    blocks = ["BEGIN PGM DRAWN MM", "L Z+50 F200 M3", *drawing.blocks, "L Z+50 R0 FMAX M5", "END PGM DRAWN MM"]
    text = "".join(f"{number} {block}\n" for number, block in enumerate(blocks))
    return Drawn(text, drawing.path, frozenset(drawing.shows))


_WORD = re.compile(r"(CC|CR|DR|IX|IY|FMAX|[A-Z])[ ]*([+-]?[\d.]*)")


def walk(text: str) -> Iterator[Motion]:
    """What a control runs in the plane, of lines L, and arcs C and CR."""
    here, center = complex(0, 0), complex(0, 0)
    for line in text.split("\n"):
        block = re.sub(r"^\d+ |;.*", "", line).strip()
        function = block.partition(" ")[0]
        if function not in ("L", "CC", "C", "CR"):
            assert not re.match(r"F[LC]|FSEL|RND|CHF|X|Y", function), line
            continue
        words = dict(_WORD.findall(block.removeprefix(function)))
        old = center if function == "CC" else here
        end = complex(float(words.get("X", old.real)), float(words.get("Y", old.imag)))
        end += complex(float(words.get("IX") or 0), float(words.get("IY") or 0))
        if function == "CC":
            center = end
            continue
        sign = 1 if words.get("DR") == "+" else -1
        if function == "L":
            if end != here:
                yield Motion("traverse" if "FMAX" in words else "line", here, end, None)
        else:
            middle = center
            if function == "CR":
                half, size = (end - here) / 2, float(words["R"])
                height = max(size**2 - abs(half) ** 2, 0.0) ** 0.5 * (1 if size > 0 else -1)
                middle = here + half + sign * 1j * half / abs(half) * height
            yield Motion("ccw" if sign > 0 else "cw", here, end, middle)
        here = end
