"""Contours drawn first and described by words afterwards: solving the words must give the drawing back.

Each drawing is held against the package twice: as drawn, and as the oracle computes it from the words
as printed. Words have 12 decimals, so that rounding them moves a point by less than the tolerance.
Blocks that nobody drew are held against the oracle's verdict.
"""

from cmath import phase
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import product
from math import degrees
from random import Random
from typing import Any, NamedTuple

import pytest
from oracle import PLANES, Outcome, circle_line, cross, dot, g111, heading, largest_gap, sign

from contoursolve import Answer, solve

TOLERANCE = 1e-9
"""mm."""

LATHE, MILL = "yasnac-lx3", "nct-99m"


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


@pytest.mark.parametrize("stride", [93, pytest.param(5, marks=pytest.mark.slow)])
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
