"""Contours drawn first and described by words afterwards: solving the words must give the drawing back.

Each drawing is held against the package twice: as drawn, and as the oracle computes it from the words
as printed. Words have 12 decimals, so that rounding them moves a point by less than the tolerance.
Blocks that nobody drew are held against the oracle's verdict.
"""

from cmath import phase
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from math import degrees
from random import Random
from typing import NamedTuple

import pytest
from generate_g111 import SHAPES, Case, draw_g111, g111_case, numbers, printed, shuffled, within_one_turn
from oracle import PLANES, circle_line, dot, heading, largest_gap, sign

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


def draw_pair(rng: Random, pair: Pair) -> Case:
    """A line that enters the circle at the crossing (Q-) or leaves it there (Q+), and the arc up to it."""
    circle = complex(rng.uniform(-100, 100), rng.uniform(-100, 100))
    radius, begin = rng.uniform(10, 80), rng.uniform(0, 360)
    start = circle + radius * heading(begin)
    out = heading(begin + rng.uniform(10, 350))
    crossing = circle + radius * out
    along = out * heading(rng.uniform(-80, 80) + (180 if pair.side == "Q-" else 0))
    if rng.random() < 0.2:
        along = min((1, 1j, -1, -1j), key=lambda axis: abs(axis - along))
        if abs(dot(along, out)) < 0.1 or (dot(along, out) > 0) != (pair.side == "Q+"):
            return draw_pair(rng, pair)
    end = crossing + rng.uniform(1, 150) * along
    swept = rng.uniform(190, 350) if pair.circle == "R-" else rng.uniform(10, 170)
    swept = rng.uniform(10, 350) if pair.circle == "center+point" else swept
    point = circle + radius * heading(begin + (swept if pair.turn == "G3" else -swept))
    first, second, i, j = PLANES[pair.plane]
    arc = {}
    if pair.circle != "center":
        step = point - start if pair.is_incremental else point
        arc |= {first: printed(step.real), second: printed(step.imag)}
    if pair.circle.startswith("center"):
        arc |= {i: printed((circle - start).real), j: printed((circle - start).imag)}
    else:
        arc["R"] = printed(radius if pair.circle == "R+" else -radius)
    angle = within_one_turn(degrees(phase(along)), rng)
    line = {
        first: printed(end.real),
        second: printed(end.imag),
        ",A": printed(angle),
        "Q": pair.side[1:] + rng.choice(("1", "0.001", "77")),
    }
    return pair_case(rng, pair, start, arc, line, (start, crossing, end))


def pair_case(
    rng: Random,
    pair: Pair,
    start: complex,
    arc: Mapping[str, str],
    line: Mapping[str, str],
    vertices: Sequence[complex] = (),
) -> Case:
    first, second, _, _ = PLANES[pair.plane]
    at = {first: printed(start.real), second: printed(start.imag)}
    outcome = circle_line(
        pair.plane,
        complex(*map(float, at.values())),
        TURNS[pair.turn],
        numbers(arc),
        numbers(line),
        is_incremental=pair.is_incremental,
        is_compensated=pair.compensation != "G40",
    )
    distance = "G91" if pair.is_incremental else "G90"
    program = (
        f"G{pair.plane} G90 {pair.compensation} G0 {shuffled(at, rng)}",
        f"{distance} {pair.turn} {shuffled(arc, rng)}",
        f"G1 {shuffled(line, rng)}",
    )
    return Case(program, outcome, pair, vertices)


@pytest.mark.parametrize("times", [1, pytest.param(4, marks=pytest.mark.slow)])
def test_every_drawn_arc_and_line_is_found_again(times: int) -> None:
    rng = Random(1633)
    cases = [draw_pair(rng, pair) for pair in PAIRS for _ in range(times)]
    assert_drawings_come_back(cases, MILL)


@pytest.mark.parametrize("count", [60, pytest.param(1_000, marks=pytest.mark.slow)])
def test_an_arc_and_line_are_refused_or_solved_as_the_sheet_says_whatever_their_words(count: int) -> None:
    rng = Random(3014)
    compared = assert_verdicts_agree([random_pair(rng) for _ in range(count)], MILL)
    assert compared.total() > 0.99 * count
    assert min(compared[status] for status in ("solved", "rejected", "no-solution", "conflicting")) > 0.05 * count


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
        cases.append(pair_case(rng, pair, start + center, arc, line))
    compared = assert_verdicts_agree(cases, MILL)
    assert compared.total() > 0.95 * len(cases)
    assert min(compared[status] for status in ("solved", "no-solution")) > 0.2 * len(cases)


ON_50 = tuple(complex(x, y) for x in range(-50, 51) for y in range(-50, 51) if x * x + y * y == 2_500)


def random_pair(rng: Random) -> Case:
    pair = rng.choice(PAIRS)._replace(compensation=rng.choice(("G41", "G42") * 9 + ("G40",)))
    first, second, i, j = PLANES[pair.plane]
    start = complex(rng.uniform(-50, 50), rng.uniform(-50, 50))

    def length() -> str:
        return printed(rng.choice((rng.uniform(-90, 90), rng.uniform(-90, 90), float(rng.randint(-1, 1)))))

    arc = {}
    if pair.circle != "center":
        arc |= {first: length(), second: length()}
    if pair.circle == "center+point" and rng.random() < 0.8:
        # A point that is on the circle, or off it by less or more than the control allows.
        center = complex(rng.uniform(-90, 90), rng.uniform(-90, 90))
        point = center - center * heading(rng.uniform(0, 360)) * rng.choice((1, 1, 1 + 1e-5, 1.01))
        point += 0 if pair.is_incremental else start
        arc = {first: printed(point.real), second: printed(point.imag)}
        arc |= {i: printed(center.real), j: printed(center.imag)}
    elif pair.circle.startswith("center"):
        arc |= {i: length(), j: length()}
    else:
        arc["R"] = pair.circle[1:] + printed(rng.uniform(0, 150))
    angle = rng.choice((rng.uniform(-360, 360), 45.0 * rng.randint(-8, 8)))
    line = {first: length(), second: length(), ",A": printed(angle), "Q": pair.side[1:] + "1"}
    if rng.random() < 0.2:
        name = rng.choice((*arc, "Q", "R", i))
        if name == "Q":
            line["Q"] = "0"
        elif name in arc:
            del arc[name]
        else:
            arc[name] = length()
    return pair_case(rng, pair, start, arc, line)
