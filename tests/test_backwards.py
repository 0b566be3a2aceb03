"""Contours drawn first and described by words afterwards: solving the words must give the drawing back.

Each drawing is held against the package twice: as drawn, and as the oracle computes it from the words
as printed. Words have 12 decimals, so that rounding them moves a point by less than the tolerance.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, product, repeat
from math import radians, tan
from random import Random
from typing import NamedTuple

import pytest
from oracle import PLANES, Outcome, circle_line, cross, dot, g111, heading, largest_gap, sign

from contoursolve import Answer, solve

TOLERANCE = 1e-9
"""mm."""

Words = Mapping[str, str]


class Drawing(NamedTuple):
    """A program that describes one contour; `vertices` are the ends of its elements, as drawn."""

    program: tuple[str, ...]
    outcome: Outcome
    vertices: Sequence[complex]
    kinds: Mapping[str, object]


def printed(value: float) -> str:
    return f"{value:.12f}"


def values(words: Words) -> dict[str, float]:
    return {address: float(text) for address, text in words.items()}


def joined(words: Words, rng: Random) -> str:
    stated = [address + text for address, text in words.items()]
    rng.shuffle(stated)
    return " ".join(stated)


def answers_of(drawings: Sequence[Drawing], control: str) -> tuple[Answer, ...]:
    """One program of all drawings: solving them together is what a user does, and is fast."""
    program = "\n".join(line for drawing in drawings for line in drawing.program)
    answers = solve(program, control=control).answers
    assert len(answers) == len(drawings)
    return answers


def assert_all_found(drawings: Sequence[Drawing], control: str) -> None:
    for drawing, answer in zip(drawings, answers_of(drawings, control), strict=True):
        shown = "\n".join(drawing.program)
        assert drawing.outcome.status == "solved", shown
        assert answer.status.value == "solved", shown
        assert largest_gap(drawing.outcome, answer.contour) <= TOLERANCE, shown
        found = [answer.contour.start, *(element.end for element in answer.contour.elements)]
        gaps = [abs(complex(*a) - b) for a, b in zip(found, drawing.vertices, strict=True)]
        assert max(gaps) <= TOLERANCE, shown


# G111 -----------------------------------------------------------------------------------------------

ENDS = tuple(product(("X", "U"), ("Z", "W")))
ONE_END = tuple(("B", end) for end in "XUZW")
BOTH_AND_B = tuple(("B", *ends) for ends in ENDS)
TWO_OR_THREE = (("A", "I"), ("A", "K"), ("I", "K"), ("A", "I", "K"))
COMBINATIONS = (
    *product(TWO_OR_THREE, (*ONE_END, *ENDS, *BOTH_AND_B)),  # with (v) and (vi)
    *product((("A",), ("I",), ("K",)), BOTH_AND_B),  # (i)
)
"""The words of line 1 and of line 2, in every way that Table 2.34 and its notes allow."""

SHAPES = tuple(
    (combination, corner1, corner2)
    for combination in COMBINATIONS
    for corner1 in ("", "C", "P")
    for corner2 in (("", "D", "Q") if combination[1] in ONE_END else ("",))
)


def draw_g111(
    rng: Random, shape: tuple[tuple[tuple[str, ...], tuple[str, ...]], str, str], quadrant: int, sense: int, square: str
) -> Drawing:
    """A contour whose line 1 runs in a quadrant and turns to the left or right; `square` lines follow an axis."""
    (first, second), corner1, corner2 = shape
    # A bevel C beside a bevel D fixes the sense of the turn; then the other one is drawn.
    for turn in chain(repeat(sense, 300), repeat(-sense, 3000)):
        angle1 = 90 * quadrant + (0 if "1" in square else rng.uniform(4, 86))
        angle2 = angle1 + turn * rng.uniform(6, 170)
        angle2 = 90 * round(angle2 / 90) if "2" in square else angle2
        u, v = heading(angle1), heading(angle2)
        if _can_be_stated(first, second, u, v) and _can_be_cut(second, corner1, corner2, u, v):
            break
    else:
        raise AssertionError(f"nothing drawn for {shape} {quadrant} {sense} {square}")
    start = complex(rng.uniform(-80, 80), rng.uniform(5, 80))
    length1, length2 = rng.uniform(20, 90), rng.uniform(20, 90)
    v1 = start + length1 * u
    v2 = v1 + length2 * v
    ends = {
        "X": 2 * v2.imag,
        "U": 2 * (v2 - start).imag,
        "Z": v2.real,
        "W": (v2 - start).real,
        "I": (v1 - start).imag,
        "K": (v1 - start).real,
        "A": rng.uniform(-360, 360) if {"I", "K"} < set(first) else _within_a_turn(angle1, rng),
        "B": rng.uniform(-360, 360) if len(first) + len(second) > 4 or _is_b_spare(first, second) else angle2,
    }
    ends["B"] = ends["B"] if abs(ends["B"]) <= 360 and ends["B"] != angle2 else _within_a_turn(angle2, rng)
    words = {name: ends[name] for name in (*first, *second)}
    vertices = [start]
    if corner1:
        amount, s, t = _draw_corner(corner1, rng.uniform(2, 0.4 * min(length1, length2)), u, v, length2)
        words[corner1] = amount
        vertices += [v1 - s * u, v1 + t * v]
    else:
        vertices.append(v1)
    if corner2:
        onward = complex(sign(v.real) or sign(u.real), 0) if second[1] in "XU" else 1j * (sign(v.imag) or sign(u.imag))
        amount, s, t = _draw_corner(corner2, rng.uniform(2, 0.4 * length2), v, onward, 1e9)
        words[corner2] = amount
        vertices += [v2 - s * v, v2 + t * onward]
    else:
        vertices.append(v2)
    position = {"X": printed(2 * start.imag), "Z": printed(start.real)}
    texts = {name: printed(value) for name, value in words.items()}
    begin = complex(float(position["Z"]), float(position["X"]) / 2)
    return Drawing(
        (f"G00 {joined(position, rng)}", f"G111 {joined(texts, rng)}"),
        g111(begin, values(texts)),
        vertices,
        {
            "shape": shape,
            "corners": (corner1, corner2),
            "quadrant": (sign(u.real), sign(u.imag)),
            "sense": sign(cross(u, v)),
            "square": square,
        },
    )


def _is_b_spare(first: tuple[str, ...], second: tuple[str, ...]) -> bool:
    return len(first) >= 2 and second in BOTH_AND_B


def _within_a_turn(angle: float, rng: Random) -> float:
    """The same direction, -360 to 360, in one of the two or three ways to write it."""
    return rng.choice([angle + turn for turn in (-720, -360, 0, 360, 720) if abs(angle + turn) <= 360])


def _can_be_stated(first: tuple[str, ...], second: tuple[str, ...], u: complex, v: complex) -> bool:
    """Whether these words fix V1 and V2 firmly at these directions."""
    sines = {"A": cross(u, v), "I": v.imag, "K": v.real} if len(first) == 1 else {}
    if first == ("A", "I"):
        sines["A"] = u.imag
    elif first == ("A", "K"):
        sines["A"] = u.real
    if second in ONE_END:
        sines["B"] = v.imag if second[1] in "XU" else v.real
    return all(abs(sines.get(name, 1)) > 0.05 for name in (*first, *second)) and abs(cross(u, v)) > 0.05


def _can_be_cut(second: tuple[str, ...], corner1: str, corner2: str, u: complex, v: complex) -> bool:
    def steepness(direction: complex) -> float:
        return abs(direction.imag) - abs(direction.real)

    onto_z = second[-1] in "XU"
    if corner1 == "C":
        shares_quadrant = u.real * v.real >= 0 and u.imag * v.imag >= 0
        if not shares_quadrant or steepness(u) * steepness(v) > -0.01:
            return False
    if corner2 == "D" and (steepness(v) if onto_z else -steepness(v)) < 0.1:
        return False
    if corner2:
        return bool(v.real or u.real) if onto_z else bool(v.imag or u.imag)
    return True


def _draw_corner(word: str, reach: float, u: complex, v: complex, room: float) -> tuple[float, float, float]:
    """A corner that leaves the line `reach` before its end: its size, and how much it takes of both lines."""
    if word in "PQ":
        half_turn = abs(cross(u, v)) / (1 + dot(u, v))  # tan(turn / 2)
        return reach / half_turn, reach, reach
    # 45 degrees: as far in Z as in X. The advance of both lines on an axis adds up.
    ratio = (abs(u.real) - abs(u.imag)) / (abs(v.imag) - abs(v.real))
    s = min(reach, 0.4 * room / ratio) if ratio > 0 else reach
    return s * abs(u.real) + s * ratio * abs(v.real), s, s * ratio


def g111_drawings() -> Iterator[Drawing]:
    rng = Random(111)
    for shape in SHAPES:
        for quadrant, sense in product(range(4), (1, -1)):
            yield draw_g111(rng, shape, quadrant, sense, "")
        for square in ("1", "2"):
            if _has_square(shape, square):
                for quadrant in range(4):
                    yield draw_g111(rng, shape, quadrant, rng.choice((1, -1)), square)


def _has_square(shape: tuple[tuple[tuple[str, ...], tuple[str, ...]], str, str], square: str) -> bool:
    """Words that fix a line in one axis only cannot state all four axis directions."""
    (first, second), _, corner2 = shape
    if square == "1":
        return "A" not in first or len(first) == 3 or len(first) == 1
    return second not in ONE_END and not corner2 and len(first) > 1


def test_every_drawn_g111_contour_is_found_again() -> None:
    drawings = list(g111_drawings())
    shapes = Counter(drawing.kinds["shape"] for drawing in drawings)
    assert shapes.keys() == set(SHAPES)
    assert min(shapes.values()) >= 8
    assert len(drawings) >= 2_000
    senses = {
        (kinds["corners"], kinds["quadrant"], kinds["sense"])
        for kinds in (drawing.kinds for drawing in drawings)
        if not kinds["square"]
    }
    assert senses == set(product(product(("", "C", "P"), ("", "D", "Q")), product((1, -1), (1, -1)), (1, -1)))
    assert_all_found(drawings, "yasnac-lx3")
