"""Why a block is refused: six blocks that no other tool diagnoses; the layers, ties and freedoms of random ones.

The equations are written down a second time here, as rows of a matrix, and every subset of words is tried.
"""

import re
from collections import Counter
from collections.abc import Mapping
from decimal import Decimal
from itertools import combinations, product
from math import atan2, cos, degrees, hypot, inf, radians, sin
from random import Random
from typing import Any

import mpmath
import numpy
import pytest

from contoursolve import Answer, Severity, solve
from contoursolve.pictures import draw_result

START = "X40. Z0."
LAYERS = ["grammar", "rules", "structure", "generic rank", "values", "geometry"]
EQUATIONS = "AIKBXUZW"
Words = dict[str, Decimal]


def answer_to(text: str, rules: str = "enforce", start: str | None = START, **options: str) -> Answer:
    (answer,) = solve(text, control="yasnac-lx3", rules=rules, start=start, **options).answers
    return answer


def verdicts(answer: Answer) -> dict[str, str]:
    assert [layer.name for layer in answer.diagnosis.layers] == LAYERS
    return {layer.name: layer.verdict.value for layer in answer.diagnosis.layers}


def block_of(words: Words) -> str:
    texts = (f"{name}{value:f}" + ("" if "." in f"{value:f}" else ".") for name, value in words.items())
    return " ".join(("G111", *texts))


# Six blocks that other solvers trip over -----------------------------------------------------------------


BEFORE = "G17 G42 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y60 ,A180 Q-1"
BEHIND = "G17 G90 G42 D1 G0 X0 Y0\nG1 ,A0\nG3 X50 Y50 I40 J50 R10 Q1"


@pytest.mark.boundary
@pytest.mark.parametrize("rules", ["enforce", "off"])
@pytest.mark.parametrize(
    ("text", "values", "low", "size"),
    [
        # The angles at which a line meets a circle lie asin(radius / distance) to either side of its centre.
        (BEFORE, {"actual": 60, "limit": 50, "off_by_mm": 10}, 90, 2 * degrees(atan2(50, 60))),
        (
            *(BEHIND, {"actual": 50, "limit": 10, "off_by_mm": 40}),
            *(degrees(atan2(50, 40) - numpy.arcsin(10 / hypot(40, 50))), 2 * degrees(numpy.arcsin(10 / hypot(40, 50)))),
        ),
    ],
    ids=["before", "behind"],
)
def test_line_that_misses_the_circle_is_told_by_how_much_and_which_angles_meet_it(text, values, low, size, rules):
    (answer,) = solve(text, rules=rules).answers
    (finding,) = answer.diagnostics
    assert (answer.status.value, finding.code) == ("no-solution", "nct-circle-missed")
    assert {name: finding.values[name] for name in values} == pytest.approx(values)
    assert (finding.values["angle_from"], finding.values["angle_to"]) == pytest.approx((low, low + size))
    assert verdicts(answer)["geometry"] == "found"
    word = re.search(r",A\d+", text)[0]
    found = [
        solve(text.replace(word, f",A{angle:.3f}"), rules=rules, depth="verdict").answers[0].status.value
        for angle in (low - 0.01, low + 0.01, low + size / 2, low + size - 0.01, low + size + 0.01)
    ]
    assert found == ["no-solution", "solved", "solved", "solved", "no-solution"]


# Ties and freedoms against every subset of words ------------------------------------------------------


def rows_of(words: Mapping[str, Any], start: tuple[float, float] = (0, 20)) -> tuple[numpy.ndarray, numpy.ndarray]:
    """The words as rows of a matrix and right sides; unknowns V1z, V1x, V2z, V2x from the start point, mm."""
    z, x = start

    def row(name: str, value: float) -> tuple[tuple[float, ...], float]:
        c, s = cos(radians(value)), sin(radians(value))
        return {
            "A": ((s, -c, 0, 0), 0),
            "I": ((0, 1, 0, 0), value),
            "K": ((1, 0, 0, 0), value),
            "B": ((-s, c, s, -c), 0),
            "X": ((0, 0, 0, 1), value / 2 - x),
            "U": ((0, 0, 0, 1), value / 2),
            "Z": ((0, 0, 1, 0), value - z),
            "W": ((0, 0, 1, 0), value),
        }[name]

    rows = [row(name, float(value)) for name, value in words.items() if name in EQUATIONS]
    return numpy.array([each[0] for each in rows], dtype=float), numpy.array([each[1] for each in rows], dtype=float)


def brute_force(words: Words) -> tuple[set[frozenset[str]], set[frozenset[str]], bool]:
    """All minimal inconsistent sets of words, all minimal dependent sets, and whether some case is nobody's to judge.

    Subsets are the rows that are not zeroed.
    """
    names, (matrix, right) = list(words), rows_of(words)
    subsets = [frozenset(each) for size in range(len(names) + 1) for each in combinations(range(len(names)), size)]
    masks = numpy.array([[row in subset for row in range(len(names))] for subset in subsets], dtype=float)
    scale = max(1.0, float(abs(right).max()))
    plain = masks[:, :, None] * matrix
    augmented = numpy.concatenate([plain, masks[:, :, None] * right[:, None] / scale], axis=2)
    values = numpy.linalg.svd(augmented, compute_uv=False)
    is_near = bool(((values > 1e-9) & (values < 1e-3 / scale)).any())
    rank, augmented_rank = numpy.linalg.matrix_rank(plain, tol=1e-9), (values > 1e-9).sum(axis=1)
    sizes = masks.sum(axis=1)

    def minimal(flags: numpy.ndarray) -> set[frozenset[str]]:
        flagged = {subset for subset, flag in zip(subsets, flags, strict=True) if flag}
        least = {each for each in flagged if not any(each - {row} in flagged for row in each)}
        return {frozenset(names[row] for row in each) for each in least}

    return minimal(rank < augmented_rank), minimal(rank < sizes), is_near


def runs_back(words: Words) -> bool:
    """Whether a line that words fix runs against the angle that they state."""
    matrix, right = rows_of(words)
    v1z, v1x, v2z, v2x = numpy.linalg.lstsq(matrix, right, rcond=None)[0]
    ways = {"A": (v1z, v1x), "B": (v2z - v1z, v2x - v1x)}
    angles = {name: radians(float(words[name])) for name in words.keys() & ways.keys()}
    return any(cos(angle) * ways[name][0] + sin(angle) * ways[name][1] < -1e-6 for name, angle in angles.items())


def random_words(random: Random, letters: str) -> Words:
    """Words of a drawing, or of none: lengths on a coarse grid, angles of 45 or 15 degrees, so that ties occur.

    A drawing has lines along the axes or at 45 degrees; half of those get one word wrong.
    """
    steps = [random.choice([(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, 1), (1, -1), (-1, -1)]) for _ in range(2)]
    (kz, kx), (wz, wx) = ((10 * random.randint(1, 3) * z, 10 * random.randint(1, 3) * x) for z, x in steps)
    if random.random() < 0.5:
        (kz, kx), (wz, wx) = ((20 * z, 20 * x) for z, x in steps)
        angles = [Decimal(round(degrees(atan2(x, z)))) for z, x in steps]
    else:
        angles = [Decimal(15 * random.randint(-24, 24)) for _ in range(2)]
    z, x = kz + wz, kx + wx
    values = dict(zip(EQUATIONS, (angles[0], kx, kz, angles[1], 40 + 2 * x, 2 * x, z, z), strict=True))
    words = {name: Decimal(values[name]) for name in letters}
    if random.random() < 0.5:
        words[random.choice(letters)] += 30
    return words


@pytest.mark.parametrize("seed", range(20))
def test_ties_freedoms_and_status_are_those_of_the_ranks(seed):
    random = Random(seed)
    size = random.choice((1, 2, 3, 4, 5, 5, 6, 6, 7, 8))
    words = random_words(random, "".join(random.sample(EQUATIONS, size)))
    answer = answer_to(block_of(words), "off")
    assert_layers_fit(answer)
    conflicts, dependent, is_near = brute_force(words)
    if answer.diagnosis is None:
        assert (answer.status.value, dependent) == ("solved", set())
    else:
        assert_freedoms(words, answer)
        for tie in answer.diagnosis.ties:
            assert_amount(words, tie)
    if is_near:
        return
    if answer.diagnosis is not None:
        assert Counter(frozenset(tie.addresses) for tie in answer.diagnosis.ties) == Counter(dependent)
        told = {frozenset(tie.addresses) for tie in answer.diagnosis.ties if tie.is_conflict}
        assert conflicts <= told
        assert [each for each in told - conflicts if not runs_back({name: words[name] for name in each})] == []
        assert answer.diagnosis.ties_complete
    if runs_back(words):
        assert answer.contour is None
    elif numpy.linalg.matrix_rank(rows_of(words)[0], tol=1e-9) < 4:
        # Words that agree take precedence over a geometry that does not exist, by the contract's order.
        others = ("no-solution", "conflicting", "overdetermined") if conflicts else ()
        assert answer.status.value in ("underdetermined", *others)
        assert answer.contour is None
    else:
        decided = "conflicting" if conflicts else "overdetermined" if dependent else "solved"
        assert answer.status.value in (decided, "no-solution")


def assert_amount(words: Words, tie: Any) -> None:
    """The amount of a tie is the largest change of one word that makes it agree."""
    own = {name: words[name] for name in tie.addresses}
    matrix, right = rows_of(own)
    weights = numpy.linalg.svd(matrix)[0][:, len(own) - 1]
    assert tie.off_by_mm == pytest.approx(max(abs(float(weights @ right) / weights)), rel=1e-9, abs=1e-9)


def assert_freedoms(words: Words, answer: Answer) -> None:
    """Freedoms are the null space seen at each point."""
    matrix, _ = rows_of(words)
    _, values, right = numpy.linalg.svd(matrix)
    null = right[int((values > 1e-9).sum()) :]
    found = {freedom.point: freedom.direction for freedom in answer.diagnosis.freedoms}
    for point, columns in (("V1", (0, 1)), ("V2", (2, 3))):
        part = null[:, columns]
        dimension = int(numpy.linalg.matrix_rank(part, tol=1e-9)) if part.size else 0
        assert (point in found) == (dimension > 0)
        if dimension == 2:
            assert found[point] is None
        elif dimension == 1:
            direction = numpy.array(found[point])
            assert hypot(*direction) == pytest.approx(1)
            # Some motion that the words allow moves the point along the direction: A times it is zero.
            motion = numpy.linalg.lstsq(part.T, direction, rcond=None)[0] @ null
            assert motion[list(columns)] == pytest.approx(direction, abs=1e-9)
            assert matrix @ motion == pytest.approx(numpy.zeros(len(matrix)), abs=1e-9)


# Blocks that lack something in one part and contradict themselves in another ----------------------------------


def rank_and_misses(values: dict[str, float], start: tuple[float, float]) -> tuple[int, dict[str, float]]:
    """The rank of the equations of some words; and by how much each word that the words before it make unnecessary
    misses what they say."""
    names = [name for name in "IKAXUZWB" if name in values]
    rows, right = rows_of({name: values[name] for name in names}, start)
    kept, off = list[int](), dict[str, float]()
    for number, name in enumerate(names):
        weights = numpy.linalg.lstsq(rows[kept].T, rows[number], rcond=None)[0] if kept else numpy.zeros(0)
        if abs(rows[number] - weights @ rows[kept]).max() < 1e-9:
            off[name] = abs(right[number] - weights @ right[kept])
        else:
            kept.append(number)
    return len(kept), off


def draw_values(draw: Random, letters: list[str], *, is_shaken: bool) -> tuple[dict[str, float], tuple[float, float]]:
    """Values of the words of one contour, and its start; shaken, some are moved, by far more than what is told."""
    z, x = draw.uniform(-50, 50), draw.uniform(5, 60)
    (v1z, v1x), (v2z, v2x) = ((draw.uniform(-90, 90), draw.uniform(5, 90)) for _ in range(2))
    values = {"I": v1x - x, "K": v1z - z, "X": 2 * v2x, "U": 2 * (v2x - x), "Z": v2z, "W": v2z - z}
    values |= {"A": degrees(atan2(v1x - x, v1z - z)), "B": degrees(atan2(v2x - v1x, v2z - v1z))}
    for letter in draw.sample(EQUATIONS, 3) if is_shaken else ():
        values[letter] += draw.choice((1, -1)) * draw.uniform(1, 9)
    values |= {letter: draw.uniform(0.1, 0.5) for letter in "CPDQ"}
    return {letter: round(values[letter], 12) for letter in letters}, (round(z, 12), round(x, 12))


@pytest.mark.parametrize("seed", range(8))
def test_both_parts_of_blocks_of_any_words_are_told(seed):
    draw = Random(seed)
    for _ in range(40):
        letters = draw.sample(EQUATIONS + "CPDQ", draw.randint(1, 12))
        values, start = draw_values(draw, letters, is_shaken=draw.random() < 0.5)
        rank, off = rank_and_misses(values, start)
        if any(1e-9 < each <= 0.01 for each in off.values()):
            continue
        block = "G111 " + " ".join(f"{letter}{value:.12f}" for letter, value in values.items())
        answer = answer_to(block, "off", f"X{2 * start[1]:.12f} Z{start[0]:.12f}", depth="verdict")
        codes = {each.code: each for each in answer.diagnostics}
        conflicts = [each for each in answer.diagnostics if each.code == "words-conflict"]
        told = {each.addresses[0]: each.values["off_by_mm"] for each in conflicts}
        assert told == pytest.approx({letter: each for letter, each in off.items() if each > 0.01}, abs=1e-6), block
        # Nothing tells on which line corner 2 lands.
        is_nowhere = bool({*letters} & {*"DQ"}) and bool({*letters} & {*"XU"}) == bool({*letters} & {*"ZW"})
        assert ("words-missing" in codes, "corner-nowhere" in codes) == (rank < 4, is_nowhere), (block, codes)
        if told or {*"CP"} <= {*letters} or {*"DQ"} <= {*letters}:
            statuses = {"conflicting"}
        elif rank < 4 or is_nowhere:
            statuses = {"underdetermined"}
        else:
            statuses = {"overdetermined"} if off else {"solved", "no-solution"}
        assert answer.status.value in statuses, (block, codes)


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


# Ladders to the edge ----------------------------------------------------------------------------------


def assert_layers_fit(answer: Answer) -> None:
    """With a contour, nothing but a warning was found. Without one, some layer has found why."""
    has_contour = answer.contour is not None
    assert not has_contour or answer.status.value in ("solved", "overdetermined"), answer.status
    assert has_contour or answer.status.value != "solved"
    assert has_contour != any(each.severity is Severity.ERROR for each in answer.diagnostics), answer.status
    if answer.diagnosis is None:
        assert answer.status.value == "solved"
        return
    layers = verdicts(answer)
    if answer.status.value == "solved":
        assert "found" not in (layers["structure"], layers["generic rank"]), layers
    if has_contour:
        assert layers["geometry"] == "passed", layers
    else:
        assert "found" in layers.values(), layers


def exact_v1(a: Decimal, b: Decimal, x: Decimal, z: Decimal) -> tuple[Any, Any]:
    """Where the line from the start (Z0, X40 diameter) along A meets the line through the end along B."""
    with mpmath.workdps(60):
        a, b, x, z = (mpmath.mpf(str(each)) for each in (a, b, x, z))
        u, v = ((mpmath.cospi(angle / 180), mpmath.sinpi(angle / 180)) for angle in (a, b))
        q = (z, x / 2 - 20)
        s = (q[0] * v[1] - q[1] * v[0]) / (u[0] * v[1] - u[1] * v[0])
        return s * u[0], 20 + s * u[1]


PARALLEL = [
    (power, half_turn, sign, aside)
    for number, (half_turn, sign, aside) in enumerate(product((0, 180), (1, -1), (0, 20)))
    for power in range(1 + number.bit_count() % 2, 15, 2)
]
"""Ever smaller angles; line 2 runs on or back, and the contour is on the way or 10 mm aside."""


@pytest.mark.parametrize(("power", "half_turn", "sign", "aside"), PARALLEL)
def test_lines_ever_more_parallel_are_never_solved_wrongly(power, half_turn, sign, aside):
    a, z = Decimal(150), Decimal(-40)
    b = a - half_turn + sign * Decimal(10) ** -power
    with mpmath.workdps(60):
        # On the way, line 1 runs 25 mm back in Z, and line 2 the rest.
        x = 40 - 2 * z * Decimal(str(mpmath.tan(mpmath.pi / 6))) + aside
        if not aside:
            v = mpmath.tan(mpmath.pi * mpmath.mpf(str(b)) / 180)
            x = Decimal(str(40 + 2 * (mpmath.tan(-mpmath.pi / 6) * -25 + v * -15)))
    x = round(x, 22)
    answer = answer_to(f"G111 A{a}. B{b:f} X{x:f} Z{z}.")
    assert_layers_fit(answer)
    if answer.status.value == "solved":
        at, exact = answer.contour.points["V1"], exact_v1(a, b, x, z)
        error = float(mpmath.hypot(at[0] - exact[0], at[1] - exact[1]))
        assert error <= answer.error_bound < inf
    if not aside and (half_turn or power <= 3):
        # Against its direction, line 2 is not on the way.
        assert (answer.status.value == "solved") == (not half_turn) or power <= 3


@pytest.mark.parametrize("power", range(1, 15))
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
def test_line_ever_closer_to_touching_the_circle_is_never_solved_wrongly(power, sign, side):
    circle = ("I-50", "X-50 Y0 R50", "X-50 Y0 I-50")[(power + sign - side) % 3]
    height = 50 * (1 + sign * Decimal(10) ** -power)
    (answer,) = solve(f"G17 G42 G0 X50 Y0\nG3 {circle}\nG1 X-60 Y{height:f} ,A180 Q{side}").answers
    assert_layers_fit(answer)
    if answer.status.value != "solved":
        assert sign > 0, answer.status
        return
    at = answer.contour.points["P1"]
    with mpmath.workdps(60):
        above = mpmath.mpf(str(height))
        half = mpmath.sqrt(2500 - above**2) if sign < 0 else 0
        error = float(min(mpmath.hypot(at[0] - root, at[1] - above) for root in (half, -half)))
    if sign > 0:  # within the rounding of the distance itself, and said to be so
        assert [finding.code for finding in answer.diagnostics] == ["nct-circle-touched"]
    assert error <= answer.error_bound


# Slips of a newcomer -------------------------------------------------------------------------------------


def test_a_decimal_comma_in_a_fact_is_told_as_in_a_word_and_mended():
    answer = answer_to("G111 A180. B120. X100. (contoursolve: length of line 1 = 30,5)")
    error = next(each for each in answer.diagnostics if each.severity is Severity.ERROR)
    assert error.message.endswith("30,5 has a decimal comma; write 30.5")
    assert error.fixes[0].replacement.endswith("length of line 1 = 30.5)")


@pytest.mark.parametrize(("angle", "ending"), [("A135.", ""), ("A135.001", " to its least increment")])
def test_an_angle_that_is_ignored_agrees_or_does_so_to_its_least_increment(angle, ending):
    (answer,) = solve(f"G111 {angle} I10. K-10. B180. Z-40.", start="X40. Z0.").answers
    (finding,) = (each for each in answer.diagnostics if angle in each.message)
    told = f"the control ignores {angle}, because I and K are given, too; it agrees with them{ending}"
    assert finding.message == told
