"""Blocks of all controls with words that vary, and values for them: what a family is asked for. It imports no package.

Each is drawn at random: a program of some form, and two or so of its words with a few values, ordinary and special ones
(signs, zero, right angles), in any order.
"""

import re
from collections.abc import Callable, Mapping
from random import Random
from typing import NamedTuple

from free_chains import random_chain as random_free
from generate_fanuc import random_lathe, random_mill
from generate_lx3 import random_g11, random_g112
from generate_nct import FORMS, random_chain, random_cornered, random_pair
from generate_typing import random_g111


class Asked(NamedTuple):
    """A block, its control, where it starts if that is stated apart, and values of some of its words, row by row."""

    block: str
    control: str
    start: str | None
    vary: Mapping[str, list[float]]


Block = tuple[str, str, str | None]
ROWS = 6

_WORD = re.compile(r"(?<![A-Z0-9.,=#$\[])(,?[A-Z]+=?)([-+]?\d+\.?\d*)(?![\d.])")
_NEVER = {"G", "N", "M", "F", "S", "T", "D", "H", "RX", "RY", "RAN", "PAR", "PGM"}
_LINES = re.compile(r"\s*\d* *(BEGIN|END|BLK|TOOL)")


def draw(random: Random, form: str) -> Asked | None:
    """A family of a form; None where nothing of the block can vary."""
    block, control, start = BLOCKS[form](random)
    words = [] if start is None else [(f"start.{address}", 0.0) for address in re.findall("[XYZ]", start)]
    for number, line in enumerate(block.split("\n"), 1):
        found = [] if _LINES.match(line) else _WORD.findall(line)
        addresses = [address.rstrip("=") for address, _ in found]
        words += [
            (f"{number}:{address}", float(value))
            for address, (_, value) in zip(addresses, found, strict=True)
            if address not in _NEVER and addresses.count(address) == 1
        ]
    if not words:
        return None
    chosen = random.sample(words, min(random.choice((1, 1, 1, 2)), len(words)))
    return Asked(block, control, start, {word: [_value(random, value) for _ in range(ROWS)] for word, value in chosen})


def _value(random: Random, value: float) -> float:
    found = random.choice(
        (
            value,
            value + random.uniform(-1, 1),
            value + random.uniform(-1, 1),
            value * random.uniform(-2, 3),
            value + random.choice((30, -30, 60)),
            -value,
            random.uniform(-180, 180),
            random.choice((0, 45, 90, -90, 180, 270)),
        )
    )
    return round(found, random.choice((0, 1, 3, 3)))


def _number(random: Random, low: float, high: float) -> float:
    return round(random.uniform(low, high), random.choice((0, 0, 2))) + 0.0


def _free(random: Random) -> Block:
    """Short chains of Klartext, with directions that one element hands to the next."""

    def u(low: float, high: float) -> float:
        return _number(random, low, high)

    lines: list[str] = []
    for number in range(random.randint(2, 4)):
        is_tangent = number > 0 and random.random() < 0.7
        mark = "T" if is_tangent else ""
        if random.random() < 0.5:
            ends = (*[f"LEN{u(5, 40)}"] * 6, f"IX{u(-40, 40):+}", f"X{u(-40, 40):+} Y{u(-40, 40):+}")
            words = [random.choice(ends)] + ([] if is_tangent else [f"AN{u(-180, 180):+}"])
            lines.append(f"FL{mark} {' '.join(words)}")
        else:
            circle = random.choice((*[f"R{u(3, 30)}"] * 6, f"CCX{u(-40, 40):+} CCY{u(-40, 40):+}"))
            begin = [] if is_tangent else [f"AN{u(-180, 180):+}"]
            end = random.choice((*[f"CCA{u(-180, 180):+}"] * 6, f"LEN{u(5, 30)}", f"X{u(-40, 40):+}"))
            lines.append(" ".join([f"FC{mark} DR{random.choice('+-')}", circle, *begin, end]))
        if random.random() < 0.15:
            lines.append(random.choice((f"RND R{u(1, 4)}", f"CHF {u(1, 4)}")))
    return "\n".join(lines), "heidenhain", "X0 Y0"


def _conventional(random: Random) -> Block:
    """Plain moves of Klartext, of which a tangent arc turns to the side on which it ends."""

    def end() -> str:
        return f"X{_number(random, -40, 40):+} Y{_number(random, -40, 40):+}"

    lines = [f"L {end()}"]
    for _ in range(random.randint(1, 3)):
        more = (
            f"CT {end()}",
            f"CT {end()}",
            f"FLT LEN{_number(random, 5, 30)}",
            f"FCT DR{random.choice('+-')} R{_number(random, 5, 30)} CCA{_number(random, -180, 180):+}",
            f"RND R{_number(random, 1, 5)}\nL {end()}",
        )
        lines.append(random.choice(more))
    return "\n".join(lines), "heidenhain", "X0 Y0"


def _tangent(random: Random) -> Block:
    """Tangent arcs, each of which turns to the side on which it ends, now and then with roundings that stay."""

    def end() -> str:
        return f"X{_number(random, -40, 90)} Y{_number(random, -40, 40)}"

    lines = [f"G17 G90 G1 {end()}"]
    for _ in range(random.randint(1, 4)):
        plain = (f"G1 {end()}", f"G1 {end()} RND={_number(random, 1, 4)}", f"G2 {end()} CR={_number(random, 60, 90)}")
        lines.append(random.choice((*[f"CT {end()}"] * 6, *plain)))
    if random.random() < 0.15:
        lines[1] += f" RNDM={_number(random, 1, 3)}"
    return "\n".join(lines), random.choice(("siemens-840d", "siemens-808d")), "X0 Y0"


def _angles(random: Random) -> Block:
    """Lines by their angles, and corners of plain moves, as each control writes them."""
    control, angle, axis, corners = random.choice(
        (
            ("siemens-840d", "ANG=", "Y", ("RND=", "CHF=", "CHR=")),
            ("siemens-808d", "ANG=", "Z", ("RND=", "CHF=", "CHR=")),
            ("fanuc-lathe", ",A", "Z", (",R", ",C")),
            ("haas-lathe", "A", "Z", (",R", ",C")),
            ("fanuc-mill", ",A", "Y", (",R", ",C")),
            ("haas-mill", ",A", "Y", (",R", ",C")),
            ("mitsubishi", ",A", "Y", (",R", ",C")),
            ("isg", "$A", "Y", ("#RND=", "#CHR=")),
        )
    )

    def u(low: float, high: float) -> float:
        return _number(random, low, high)

    plane = {"siemens-808d": "G18 ", "fanuc-lathe": "", "haas-lathe": ""}.get(control, "G17 G90 ")
    end, corner = f"X{u(-40, 60)} {axis}{u(-60, 40)}", random.choice(("", f" {random.choice(corners)}{u(1, 4)}"))
    if control == "isg" or random.random() < 0.3:
        lines = [f"{plane}G1 {end} {random.choice(corners)}{u(1, 6)}", f"X{u(-40, 60)} {axis}{u(-60, 40)}"]
    elif random.random() < 0.7:
        lines = [f"{plane}G1 {angle}{u(-180, 180)}{corner}", f"{end} {angle}{u(-180, 180)}"]
    else:
        lines = [f"{plane}G1 {random.choice('X' + axis)}{u(-40, 60)} {angle}{u(-180, 180)}"]
    return "\n".join(lines), control, f"X0 {axis}0"


def _g111(random: Random) -> Block:
    sound = random_g111(random)
    return "\n".join((sound.before, *(" ".join(block) for block in sound.blocks))), sound.control, None


def _g112(random: Random) -> Block:
    form, corners = random.choice(("turning", "facing")), (random.choice(("", "C", "P")), random.choice(("", "D", "Q")))
    return "\n".join(random_g112(random, form, *corners).program), "yasnac-lx3", None


def _mill(random: Random) -> Block:
    kinds = [random.choice(("line", "arc")) for _ in range(random.randint(2, 4))]
    return "\n".join(random_mill(random, kinds, 17)), random.choice(("fanuc-mill", "haas-mill", "mitsubishi")), None


BLOCKS: Mapping[str, Callable[[Random], Block]] = {
    "free": _free,
    "conventional": _conventional,
    "tangent": _tangent,
    "angles": _angles,
    "lathe": lambda r: ("\n".join(random_lathe(r, r.randint(2, 5))), r.choice(("fanuc-lathe", "haas-lathe")), None),
    "mill": _mill,
    "pair": lambda r: (
        random_pair(r, r.choice(FORMS), r.choice((17, 18, 19)), r.choice(" CR").strip()).text,
        "nct-99m",
        None,
    ),
    "chain": lambda r: (random_chain(r, r.randint(2, 4), 17).text, "nct-99m", None),
    "corners": lambda r: (random_cornered(r, 17).text, "nct-99m", None),
    "G111": _g111,
    "G112": _g112,
    "G11": lambda r: ("\n".join(random_g11(r).program), "yasnac-lx3", None),
    "free by twelve decimals": lambda r: (random_free(r, 2, 4).text, "heidenhain", None),
}
"""Programs of every form, by its name."""
