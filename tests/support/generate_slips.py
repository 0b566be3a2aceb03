"""Blocks of every form with words too many, missing, or of another sign. Same generator, same blocks.

No import of the package.
"""

from collections.abc import Callable, Sequence
from math import cos, radians, sin
from random import Random
from typing import NamedTuple

import generate_lx3
import generate_nct


class Spoilt(NamedTuple):
    """A program: one line that leads to the start, then the blocks of one contour."""

    lines: tuple[str, ...]
    control: str

    @property
    def text(self) -> str:
        return "\n".join(self.lines)


def _printed(value: float) -> str:
    return f"{value:.3f}"


def g111(rng: Random) -> Spoilt:
    """Words of one drawing, of which some are left out, turned round or replaced."""
    start_z, start_x = rng.uniform(0, 140), rng.uniform(5, 70)
    a, b = radians(rng.choice((180, 90, rng.uniform(0, 360)))), radians(rng.uniform(0, 360))
    first, second = rng.uniform(5, 60), rng.uniform(5, 60)
    i, k = first * sin(a), first * cos(a)
    z, x = start_z + k + second * cos(b), start_x + i + second * sin(b)
    words = {"A": a * 180 / 3.141592653589793, "I": i, "K": k, "B": b * 180 / 3.141592653589793}
    words |= {"X": 2 * x, "U": 2 * (x - start_x), "Z": z, "W": z - start_z}
    words |= {address: rng.uniform(0.5, 3) for address in "CPDQ"}
    texts = []
    for address in rng.sample(list(words), rng.randint(3, 8)):
        value, kind = words[address], rng.random()
        value = -value if kind < 0.12 else rng.uniform(-100, 100) if kind < 0.2 else 0.0 if kind < 0.23 else value
        texts.append(address + _printed(value))
    if rng.random() < 0.1:
        texts.append(rng.choice(("M08", "T0101", "F0.2")))
    lines = f"G00 X{_printed(2 * start_x)} Z{_printed(start_z)}", f"G111 {' '.join(texts)}"
    return Spoilt(lines, "yasnac-lx3")


def g112(rng: Random) -> Spoilt:
    drawn = generate_lx3.random_g112(
        rng, rng.choice(generate_lx3.FORMS), rng.choice(("", "P", "C")), rng.choice(("", "Q", "D"))
    )
    return Spoilt(_spoil(rng, drawn.program, ["X", "U", "Z", "W", "P", "C", "Q", "D", "A"]), "yasnac-lx3")


def pair(rng: Random) -> Spoilt:
    drawn = generate_nct.random_pair(rng, rng.choice(generate_nct.FORMS), 17, rng.choice(("", "C", "R")))
    return Spoilt(_spoil(rng, drawn.program, ["X", "Y", "I", "J", "R", ",A", ",C", ",R", "Q", "Z"]), "nct-99m")


def cornered(rng: Random) -> Spoilt:
    drawn = generate_nct.random_cornered(rng, 17)
    while len(drawn.program) > 3:
        drawn = generate_nct.random_cornered(rng, 17)
    return Spoilt(_spoil(rng, drawn.program, ["X", "Y", "I", "J", "R", ",A", ",C", ",R", "Q"]), "nct-99m")


def chain(rng: Random) -> Spoilt:
    drawn = generate_nct.random_chain(rng, 2, 17)
    return Spoilt(_spoil(rng, drawn.program, ["X", "Y", "I", "J", "R", ",A", ",C", ",R", "Q"]), "nct-99m")


FORMS: dict[str, Callable[[Random], Spoilt]] = {
    "g111": g111,
    "g112": g112,
    "pair": pair,
    "cornered": cornered,
    "chain": chain,
}


def _spoil(rng: Random, program: Sequence[str], addresses: Sequence[str]) -> tuple[str, ...]:
    lines = [" ".join(_shortened(text) for text in line.split()) for line in program]
    for _ in range(rng.choice((0, 1, 1, 2))):
        line = rng.randrange(1, len(lines))
        texts = lines[line].split()
        words = [place for place, text in enumerate(texts) if text[0] != "G"]
        kind = rng.random()
        if kind < 0.5 or not words:
            absent = [address for address in addresses if address not in map(_address, texts)]
            texts.append(rng.choice(absent) + _printed(rng.choice((1, -1, 5)) * rng.uniform(1, 20)))
        elif kind < 0.75:
            place = rng.choice(words)
            address = _address(texts[place])
            texts[place] = address + _printed(-float(texts[place].removeprefix(address)))
        else:
            texts.pop(rng.choice(words))
        lines[line] = " ".join(texts)
    return tuple(lines)


def _address(text: str) -> str:
    return text.rstrip("-.0123456789")


def _shortened(text: str) -> str:
    address = _address(text)
    return f"{address}{float(text.removeprefix(address)):.6f}".rstrip("0") if "." in text else text
