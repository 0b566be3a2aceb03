"""Contours of G111 that are drawn first and described by words afterwards.

Words have 12 decimals, so that rounding them moves a point by less than what is tolerated.
"""

from collections.abc import Mapping, Sequence
from decimal import Decimal
from itertools import product
from random import Random
from typing import Any, NamedTuple

from oracle import Outcome, cross, dot, g111, heading, sign


class Case(NamedTuple):
    """A program of one contour and what the oracle says of it."""

    program: tuple[str, ...]
    outcome: Outcome
    kind: Any = None
    vertices: Sequence[complex] = ()
    """The ends of all elements, as drawn."""


def printed(value: float) -> str:
    return f"{value:.12f}"


def shuffled(words: Mapping[str, str], rng: Random) -> str:
    texts = [address + text for address, text in words.items()]
    rng.shuffle(texts)
    return " ".join(texts)


def numbers(words: Mapping[str, str]) -> dict[str, Decimal]:
    return {address: Decimal(text) for address, text in words.items()}


ENDS = tuple(product(("X", "U"), ("Z", "W")))


B_AND_ONE = tuple(("B", end) for end in "XUZW")


B_AND_BOTH = tuple(("B", *ends) for ends in ENDS)


COMBINATIONS = (
    *product((("A", "I"), ("A", "K"), ("I", "K"), ("A", "I", "K")), (*B_AND_ONE, *ENDS, *B_AND_BOTH)),  # with (v), (vi)
    *product((("A",), ("I",), ("K",)), B_AND_BOTH),  # (i)
)
"""The words of line 1 and of line 2, in every way that Table 2.34 and its notes allow."""


class Shape(NamedTuple):
    """The words of a G111 block; corners are "" or an address."""

    line1: tuple[str, ...]
    line2: tuple[str, ...]
    corner1: str
    corner2: str

    @property
    def is_a_ignored(self) -> bool:
        return len(self.line1) == 3

    @property
    def is_b_ignored(self) -> bool:
        return len(self.line1) > 1 and len(self.line2) == 3

    @property
    def lands_along_z(self) -> bool:
        return self.line2[-1] in ("X", "U")


SHAPES = tuple(
    Shape(line1, line2, corner1, corner2)
    for line1, line2 in COMBINATIONS
    for corner1 in ("", "C", "P")
    for corner2 in (("", "D", "Q") if line2 in B_AND_ONE else ("",))
)


def is_firm(shape: Shape, u: complex, v: complex) -> bool:
    """Whether these words fix V1 and V2 well at these directions."""
    sines = [cross(u, v)]
    if len(shape.line1) == 1:
        sines.append({"A": cross(u, v), "I": v.imag, "K": v.real}[shape.line1[0]])
    elif "A" in shape.line1 and not shape.is_a_ignored:
        sines.append(u.imag if "I" in shape.line1 else u.real)
    if shape.line2 in B_AND_ONE:
        sines.append(v.imag if shape.lands_along_z else v.real)
    return all(abs(sine) > 0.05 for sine in sines)


def has_corners(shape: Shape, u: complex, v: complex) -> bool:
    """Whether both corners can be made: a bevel needs a flat line and a steep one that share a quadrant."""
    steep1, steep2 = abs(u.imag) - abs(u.real), abs(v.imag) - abs(v.real)
    if shape.corner1 == "C" and not (u.real * v.real >= 0 and u.imag * v.imag >= 0 and steep1 * steep2 < -0.01):
        return False
    if shape.corner2 == "D" and (steep2 if shape.lands_along_z else -steep2) < 0.1:
        return False
    return not shape.corner2 or third_line(shape, u, v) != 0


def third_line(shape: Shape, u: complex, v: complex) -> complex:
    return complex(sign(v.real) or sign(u.real)) if shape.lands_along_z else 1j * (sign(v.imag) or sign(u.imag))


def corner(word: str, reach: float, u: complex, v: complex, room: float) -> tuple[float, float, float]:
    """A corner that takes at most `reach` of the line before and `room` of the line after: size, and both lengths."""
    if word in "PQ":
        taken = min(reach, room)
        return taken * (1 + dot(u, v)) / abs(cross(u, v)), taken, taken
    # At 45 degrees it is as far in Z as in X, and both lines share that advance.
    ratio = (abs(u.real) - abs(u.imag)) / (abs(v.imag) - abs(v.real))
    taken = min(reach, room / ratio) if ratio else reach
    return taken * (abs(u.real) + ratio * abs(v.real)), taken, taken * ratio


def draw_g111(rng: Random, shape: Shape, quadrant: int, sense: int, square: tuple[bool, bool]) -> Case | None:
    """A contour whose line 1 runs into a quadrant and turns left (1) or right (-1) there.

    Lines that are `square` follow an axis. None if these words or corners allow no such contour.
    """
    for _ in range(100):
        angle1 = 90 * quadrant + (0 if square[0] else rng.uniform(4, 86))
        angle2 = angle1 + sense * rng.uniform(6, 170)
        angle2 = 90 * round(angle2 / 90) if square[1] else angle2
        u, v = heading(angle1), heading(angle2)
        if is_firm(shape, u, v) and has_corners(shape, u, v):
            break
    else:
        return None
    length1, length2 = rng.uniform(20, 90), rng.uniform(20, 90)
    start = complex(rng.uniform(-80, 80), rng.uniform(5, 80))
    v1 = start + length1 * u
    v2 = v1 + length2 * v
    vertices = [start]
    sizes = {}
    for word, at, arriving, leaving, reach, room in (
        (shape.corner1, v1, u, v, 0.8 * length1, 0.4 * length2),
        (shape.corner2, v2, v, third_line(shape, u, v), 0.4 * length2, 100),
    ):
        if word:
            sizes[word], before, after = corner(word, rng.uniform(0.1, 1) * reach, arriving, leaving, room)
            vertices += [at - before * arriving, at + after * leaving]
        else:
            vertices.append(at)
    meant = {
        "A": rng.uniform(-360, 360) if shape.is_a_ignored else within_one_turn(angle1, rng),
        "B": rng.uniform(-360, 360) if shape.is_b_ignored else within_one_turn(angle2, rng),
        "I": (v1 - start).imag,
        "K": (v1 - start).real,
        "X": 2 * v2.imag,
        "U": 2 * (v2 - start).imag,
        "Z": v2.real,
        "W": (v2 - start).real,
        **sizes,
    }
    words = {name: printed(meant[name]) for name in (*shape.line1, *shape.line2, *sizes)}
    kind = shape, (sign(u.real), sign(u.imag)), sign(cross(u, v)), square
    return g111_case(rng, start, words, kind, vertices)


def g111_case(
    rng: Random, start: complex, words: Mapping[str, str], kind: Any = None, vertices: Sequence[complex] = ()
) -> Case:
    z, x = printed(start.real), printed(2 * start.imag)
    outcome = g111(complex(float(z), float(Decimal(x) / 2)), numbers(words))
    return Case((f"G00 X{x} Z{z}", f"G111 {shuffled(words, rng)}"), outcome, kind, vertices)


def within_one_turn(angle: float, rng: Random) -> float:
    """The same direction from -360 to 360, in one of its spellings."""
    return rng.choice([angle + turns for turns in (-720, -360, 0, 360, 720) if abs(angle + turns) <= 360])
