"""Contours drawn first and described by words afterwards: solving the words must give the drawing back.

Each drawing is held against the package twice: as drawn, and as the oracle computes it from the words
as printed. Words have 12 decimals, so that rounding them moves a point by less than the tolerance.
Blocks that nobody drew are held against the oracle's verdict.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import product
from random import Random
from typing import NamedTuple

import pytest
from generate_g111 import SHAPES, Case, draw_g111, g111_case, numbers, printed, shuffled
from oracle import PLANES, circle_line, heading, largest_gap, sign

from contoursolve import Answer, solve

TOLERANCE = 1e-9
"""mm."""

LATHE, MILL = "yasnac-lx3", "nct-99m"


def solve_all(cases: Sequence[Case], control: str) -> Iterator[tuple[Case, Answer, str]]:
    """All cases as one program; the text of each, to show."""
    answers = solve(
        "\n".join(line for case in cases for line in case.program), control=control, depth="verdict"
    ).answers
    for case, answer in zip(cases, answers, strict=True):
        yield case, answer, "\n".join(case.program)


def assert_drawings_come_back(cases: Sequence[Case], control: str) -> None:
    for case, answer, shown in solve_all(cases, control):
        assert case.outcome.status == answer.status.value == "solved", shown
        assert largest_gap(case.outcome, answer.contour) <= TOLERANCE, shown
        found = [answer.contour.start, *(element.end for element in answer.contour.elements)]
        gaps = [abs(complex(*a) - b) for a, b in zip(found, case.vertices, strict=True)]
        assert max(gaps) <= TOLERANCE, shown


def assert_verdicts_agree(cases: Sequence[Case], control: str) -> Counter[str]:
    """How often each verdict was compared."""
    compared: Counter[str] = Counter()
    for case, answer, shown in solve_all([case for case in cases if not case.outcome.is_near], control):
        assert answer.status.value == case.outcome.status, shown
        if case.outcome.status == "solved":
            size = max(map(abs, case.outcome.points.values()))
            assert largest_gap(case.outcome, answer.contour) <= TOLERANCE * max(1, size / 1_000), shown
        compared[case.outcome.status] += 1
    return compared


# G111 -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("stride", [7, pytest.param(2, marks=pytest.mark.slow)])
def test_every_drawn_g111_contour_is_found_again(stride: int) -> None:
    rng = Random(111)
    turns = list(product(range(4), (1, -1)))
    cases = []
    for shape in SHAPES[::stride]:
        drawn = [draw_g111(rng, shape, quadrant, sense, (False, False)) for quadrant, sense in turns]
        # A bevel C beside a bevel D fixes the sense of the turn in each quadrant.
        assert sum(case is not None for case in drawn) == (4 if shape[2:] == ("C", "D") else 8)
        for square in ((True, False), (False, True), (True, True)):
            drawn += [draw_g111(rng, shape, *rng.choice(turns), square) for _ in range(2)]
        cases += [case for case in drawn if case]
    assert len(cases) >= 2_000 // stride
    oblique = {
        (kind[0].corner1, kind[0].corner2, *kind[1:3])
        for kind in (case.kind for case in cases)
        if kind[3] == (False, False)
    }
    assert oblique == set(product(("", "C", "P"), ("", "D", "Q"), product((1, -1), (1, -1)), (1, -1)))
    assert Counter(case.kind[3] for case in cases)[True, True] > 100 // stride
    assert_drawings_come_back(cases, LATHE)


@pytest.mark.parametrize("count", [60, pytest.param(2_000, marks=pytest.mark.slow)])
def test_g111_is_refused_or_solved_as_the_sheet_says_whatever_its_words(count: int) -> None:
    rng = Random(145)
    blocks = [random_words(rng) for _ in range(count)]
    cases = [g111_case(rng, complex(rng.uniform(-50, 50), rng.uniform(0, 60)), words) for words in blocks]
    compared = assert_verdicts_agree(cases, LATHE)
    assert compared.total() > 0.99 * len(cases)
    assert min(compared[status] for status in ("solved", "rejected", "no-solution")) > 0.1 * count


@pytest.mark.parametrize("stride", [93, pytest.param(11, marks=pytest.mark.slow)])
def test_g111_along_the_axes_and_at_45_degrees_is_judged_as_the_sheet_says(stride: int) -> None:
    """Corners that fit exactly, bevels along a line, corners on the rectangle, second lines along an axis."""
    rng = Random(2_36)
    cases = []
    angles = range(-360, 361, 45)
    chosen = list(product(angles, angles, ("AI", "AK", "IK"), "XZ", " CP", " DQ"))[::stride]
    for a, b, line1, end, corner1, corner2 in chosen:
        u, v = heading(a), heading(b)
        v1 = complex(20 * sign(round(u.real, 9)), 20 * sign(round(u.imag, 9)))
        v2 = v1 + complex(40 * sign(round(v.real, 9)), 40 * sign(round(v.imag, 9)))
        start = complex(rng.randint(-50, 50), rng.randint(20, 60))
        meant = {"A": a, "B": b, "I": v1.imag, "K": v1.real}
        meant |= {"X": 2 * (start + v2).imag, "Z": (start + v2).real, "U": 2 * v2.imag, "W": v2.real}
        names = (*line1, "B", end if rng.random() < 0.7 else {"X": "U", "Z": "W"}[end])
        words = {name: f"{meant[name]:.1f}" for name in names}
        for word in f"{corner1}{corner2}".replace(" ", ""):
            words[word] = rng.choice(("0.", "5.", "10.", "20.", "30.", "40."))
        cases.append(g111_case(rng, start, words))
    compared = assert_verdicts_agree(cases, LATHE)
    assert compared.total() == len(cases)
    assert min(compared[status] for status in ("solved", "no-solution", "underdetermined")) > 0.06 * len(cases)


def random_words(rng: Random) -> dict[str, str]:
    """Mostly a legal combination of words, with values that nobody made fit."""
    shape = rng.choice(SHAPES)
    names = {*shape.line1, *shape.line2, shape.corner1, shape.corner2} - {""}
    if rng.random() < 0.2:
        names ^= {rng.choice("XUZWAIBKCDPQ")}
    words = {}
    for name in sorted(names):
        if name in "AB":
            value = rng.choice((rng.uniform(-360, 360), 45.0 * rng.randint(-8, 8)))
        elif name in "CDPQ":
            value = rng.choice((rng.uniform(0, 15), rng.uniform(0, 15), rng.uniform(0, 60), 0.0))
        else:
            value = rng.choice((rng.uniform(-120, 120), rng.uniform(-120, 120), float(rng.randint(-2, 2))))
        words[name] = printed(value)
    if rng.random() < 0.02:
        words[rng.choice("CDPQAB")] = printed(rng.choice((-2.0, 361.0, 500.0)))
    return words


# NCT 16.3.3 -------------------------------------------------------------------------------------------

TURNS = {"G2": "cw", "G3": "ccw"}


class Pair(NamedTuple):
    """How an arc and an over-defined line are written."""

    plane: int
    turn: str
    circle: str
    """center, center and point, R of an arc below 180 deg, R of one above."""
    side: str
    is_incremental: bool
    compensation: str


PAIRS = tuple(
    Pair(*choice)
    for choice in product(
        PLANES, TURNS, ("center", "center+point", "R+", "R-"), ("Q-", "Q+"), (False, True), ("G41", "G42")
    )
)


@pytest.mark.parametrize("stride", [39, pytest.param(2, marks=pytest.mark.slow)])
def test_an_arc_and_line_on_round_numbers_are_judged_as_the_sheet_says(stride: int) -> None:
    """Tangents, lines through the centre or the start, half circles, ends on the circle."""
    rng = Random(50)
    cases = []
    for pair, angle in list(product(PAIRS, range(-360, 361, 45)))[::stride]:
        first, second, i, j = PLANES[pair.plane]
        # All of them on one circle of radius 50 about the centre.
        start, point, center = rng.choice(ON_50), rng.choice(ON_50), complex(rng.randint(-9, 9), rng.randint(-9, 9))
        step = point - start if pair.is_incremental else point + center
        arc = {first: f"{step.real:.1f}", second: f"{step.imag:.1f}"} if pair.circle != "center" else {}
        if pair.circle.startswith("center"):
            arc |= {i: f"{-start.real:.1f}", j: f"{-start.imag:.1f}"}
        else:
            arc["R"] = pair.circle[1:] + "50."
        end = center + rng.choice((*ON_50, *ON_50, 50 + 50j, 70 - 50j, -30 + 90j, 50 * (1 + 2j), 0, 60 + 10j))
        line = {first: f"{end.real:.1f}", second: f"{end.imag:.1f}", ",A": f"{angle}.", "Q": pair.side[1:] + "1"}
        at = {first: f"{(start + center).real:.1f}", second: f"{(start + center).imag:.1f}"}
        stated = complex(*map(float, at.values())), TURNS[pair.turn], numbers(arc), numbers(line)
        outcome = circle_line(pair.plane, *stated, is_incremental=pair.is_incremental, is_compensated=True)
        program = (
            f"G{pair.plane} G90 {pair.compensation} G0 {shuffled(at, rng)}",
            f"{'G91' if pair.is_incremental else 'G90'} {pair.turn} {shuffled(arc, rng)}",
            f"G1 {shuffled(line, rng)}",
        )
        cases.append(Case(program, outcome, pair, ()))
    compared = assert_verdicts_agree(cases, MILL)
    assert compared.total() > 0.95 * len(cases)
    assert min(compared[status] for status in ("solved", "no-solution")) > 0.2 * len(cases)


ON_50 = tuple(complex(x, y) for x in range(-50, 51) for y in range(-50, 51) if x * x + y * y == 2_500)
