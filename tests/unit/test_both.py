"""Blocks that lack something in one part and contradict themselves in another: both are told.

The oracle is the rank of G111's equations, written here by hand: with letters drawn at random, what is free and what
contradicts itself is a matter of linear algebra.
"""

from math import cos, radians, sin
from random import Random

import numpy
import pytest

from contoursolve import solve
from contoursolve.pictures import draw_result

GEOMETRY, CORNERS, ANGLES = "IKAXUZWB", "CPDQ", "AB"
ROUND = 1e-9
TOLD = 0.01
"""mm. What is shaken is shaken by more."""


def row_of(letter, value, start):
    """A word as a row over Z and X (radius) of V1 and V2, and its constant: the row times the unknowns is that."""
    z, x = start
    if letter in ANGLES:
        c, s = cos(radians(value)), sin(radians(value))
        return ((s, -c, 0, 0), z * s - x * c) if letter == "A" else ((-s, c, s, -c), 0.0)
    return {
        "I": ((0, 1, 0, 0), x + value),
        "K": ((1, 0, 0, 0), z + value),
        "X": ((0, 0, 0, 1), value / 2),
        "U": ((0, 0, 0, 1), x + value / 2),
        "Z": ((0, 0, 1, 0), value),
        "W": ((0, 0, 1, 0), z + value),
    }[letter]


def rank_and_misses(values, start):
    """The rank of the equations of some words; and by how much each word that the words before it make unnecessary
    misses what they say."""
    rows, ends, off = [], [], {}
    for letter in (each for each in GEOMETRY if each in values):
        row, end = row_of(letter, values[letter], start)
        if rows:
            weights = numpy.linalg.lstsq(numpy.array(rows).T, numpy.array(row), rcond=None)[0]
            if abs(numpy.array(row) - weights @ numpy.array(rows)).max() < ROUND:
                off[letter] = abs(end - weights @ numpy.array(ends))
                continue
        rows.append(row)
        ends.append(end)
    return len(rows), off


def is_nowhere(letters):
    """Whether nothing tells on which line corner 2 lands."""
    return bool(letters & {*"DQ"}) and bool(letters & {*"XU"}) == bool(letters & {*"ZW"})


def statuses(letters, rank, off):
    """The first in the contract's order; of two for what this oracle does not tell."""
    if any(each > TOLD for each in off.values()) or {*"CP"} <= letters or {*"DQ"} <= letters:
        return {"conflicting"}
    if rank < 4 or is_nowhere(letters):
        return {"underdetermined"}
    return {"overdetermined"} if off else {"solved", "no-solution"}


def draw_values(draw, letters, *, is_shaken):
    """Values of the words of one contour; shaken, those of some are moved."""
    start = draw.uniform(-50, 50), draw.uniform(5, 60)
    v1, v2 = ((draw.uniform(-90, 90), draw.uniform(5, 90)) for _ in range(2))
    values = {
        "I": v1[1] - start[1],
        "K": v1[0] - start[0],
        "X": 2 * v2[1],
        "U": 2 * (v2[1] - start[1]),
        "Z": v2[0],
        "W": v2[0] - start[0],
        "A": numpy.degrees(numpy.arctan2(v1[1] - start[1], v1[0] - start[0])),
        "B": numpy.degrees(numpy.arctan2(v2[1] - v1[1], v2[0] - v1[0])),
    }
    for letter in draw.sample(GEOMETRY, 3) if is_shaken else ():
        values[letter] += draw.choice((1, -1)) * draw.uniform(1, 9)
    values |= {letter: draw.uniform(0.1, 0.5) for letter in CORNERS}
    return {letter: round(float(values[letter]), 12) for letter in letters}, tuple(round(each, 12) for each in start)


def check(values, start):
    """One block against the equations."""
    block = "G111 " + " ".join(f"{letter}{value:.12f}" for letter, value in values.items())
    place = f"X{2 * start[1]:.12f} Z{start[0]:.12f}"
    (rank, off), letters = rank_and_misses(values, start), {*values}
    if any(ROUND < each <= TOLD for each in off.values()):
        return
    answer = solve(block, start=place, rules="off", depth="verdict").answers[0]
    codes = [each.code for each in answer.diagnostics]
    told = {each.addresses[0]: each.values["off_by_mm"] for each in answer.diagnostics if each.code == "words-conflict"}
    assert told == pytest.approx({letter: each for letter, each in off.items() if each > TOLD}, abs=1e-6), (
        block,
        place,
    )
    assert ("words-missing" in codes) == (rank < 4), (block, place, codes)
    assert ("corner-nowhere" in codes) == is_nowhere(letters), (block, place, codes)
    assert answer.status.value in statuses(letters, rank, off), (block, place, codes)


@pytest.mark.parametrize("seed", range(24))
def test_both_parts_of_blocks_of_any_words_are_told(seed):
    draw = Random(seed)
    for _ in range(40):
        letters = draw.sample(GEOMETRY + CORNERS, draw.randint(1, 12))
        check(*draw_values(draw, letters, is_shaken=draw.random() < 0.5))


@pytest.mark.parametrize(
    "text",
    [
        "G17 G90 G41 G0 X120.8 Y-55.9\nG1 G90 ,R7.75\nG3 R17.36 Q77 Y-101.97 I-100.41 J-117.73 X107.69",
        "G17 G90 G41 G0 X124 Y34.4\nG1 ,C9.9 ,A-270.\nG91 Y29.2 ,A-42.7\nG3 G91 X123.6 Y-35.3 R86.9 J64.3 I205.5 Q-77",
    ],
    ids=["pair", "chain"],
)
def test_a_circle_that_misses_its_point_is_told_where_its_beginning_is_not_determined(text):
    found = {each.code for each in solve(text, control="nct-99m").diagnostics}
    assert {"nct-radius-difference", "words-missing"} <= found


def test_the_picture_shows_what_the_text_says():
    result = solve("G111 Z-27.727 W-4.211 A180. B-152.", start="X40. Z0.", rules="off")
    assert "23.516 off" in str(draw_result(result).svg)
