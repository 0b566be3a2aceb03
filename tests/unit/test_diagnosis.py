"""Why a block is refused: six blocks that no other tool diagnoses; the layers, ties and freedoms of random ones.

The equations are written down a second time here, as rows of a matrix, and every subset of words is tried.
"""

import re
from collections import Counter
from decimal import Decimal
from itertools import combinations
from math import atan2, cos, degrees, hypot, inf, radians, sin, tan
from random import Random
from typing import Any

import mpmath
import numpy
import pytest
from examples import control_of

from contoursolve import Answer, Severity, completions, parse, solve
from contoursolve.diagnostics import Applicability, Verdict

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

AIK = "A135. I10. K{k} B180. Z-40."


@pytest.mark.parametrize(
    ("rules", "status", "code"), [("enforce", "solved", "g111-a-ignored"), ("off", "overdetermined", "words-redundant")]
)
def test_a_i_and_k_that_agree_are_one_too_many_and_each_may_go(rules, status, code):
    answer = answer_to("G111 " + AIK.format(k="-10."), rules)
    (finding,) = answer.diagnostics
    assert (answer.status.value, finding.code, finding.addresses) == (status, code, ("A",))
    assert finding.values == pytest.approx({"actual": 135, "expected": 135, "off_by_mm": 0}, abs=1e-9)
    (tie,) = answer.diagnosis.ties
    assert (set(tie.addresses), tie.identity, tie.is_conflict) == ({"A", "I", "K"}, "K = I/tan(A)", False)
    assert tie.off_by_mm == pytest.approx(0, abs=1e-9)
    assert answer.diagnosis.freedoms == ()
    assert {fix.replacement: fix.applicability for fix in finding.fixes} == dict.fromkeys(
        ["G111 I10. K-10. B180. Z-40.", "G111 A135. K-10. B180. Z-40.", "G111 A135. I10. B180. Z-40."],
        Applicability.SAFE,
    )


@pytest.mark.parametrize(
    ("rules", "status", "code"), [("enforce", "solved", "g111-a-ignored"), ("off", "conflicting", "words-conflict")]
)
def test_a_i_and_k_that_disagree_are_named_with_what_each_would_have_to_be(rules, status, code):
    answer = answer_to("G111 " + AIK.format(k="-12."), rules)
    (finding,) = answer.diagnostics
    assert (answer.status.value, finding.code, finding.addresses) == (status, code, ("A",))
    # The direction of V1 from the start, and how far V1 (12 left, 10 up) lies from the line at 135 degrees.
    expected = {"actual": 135, "expected": degrees(atan2(10, -12)), "off_by_mm": 2 / 2**0.5}
    assert finding.values == pytest.approx(expected, abs=1e-9)
    (tie,) = answer.diagnosis.ties
    assert (set(tie.addresses), tie.is_conflict) == ({"A", "I", "K"}, True)
    assert tie.off_by_mm == pytest.approx(2)
    notes = " ".join(finding.notes)
    assert [text for text in ("I12.", "K-10.", "A140.194", "2.000 mm apart") if text not in notes] == []
    drops = {fix.replacement for fix in finding.fixes if fix.description.startswith("delete")}
    assert drops == {"G111 I10. K-12. B180. Z-40.", "G111 A135. K-12. B180. Z-40.", "G111 A135. I10. B180. Z-40."}


@pytest.mark.parametrize(
    ("rules", "status", "code"), [("enforce", "rejected", "g111-line-2"), ("off", "underdetermined", "words-missing")]
)
def test_a_alone_lets_v1_slide_along_its_direction_and_v2_lie_anywhere(rules, status, code):
    answer = answer_to("G111 A135.", rules)
    assert (answer.status.value, answer.diagnostics[0].code) == (status, code)
    assert answer.diagnosis.ties == ()
    first, second = answer.diagnosis.freedoms
    assert (first.point, second.point, second.direction) == ("V1", "V2", None)
    assert first.angle == pytest.approx(135)
    # One of I and K with two of line 2, or all of B, X or U, Z or W: 2 * (2 + 2 + 4) + 4.
    placeholders = {fix.replacement: fix.applicability for fix in answer.diagnostics[0].fixes}
    assert [*placeholders.values()] == [Applicability.PLACEHOLDER] * 20


@pytest.mark.parametrize("rules", ["enforce", "off"])
def test_a_parallel_to_b_is_dependent_only_at_these_values_and_how_far_apart_the_lines_are_is_told(rules):
    answer = answer_to("G111 A135. B135. X60. Z-40.", rules)
    (finding,) = answer.diagnostics
    assert (answer.status.value, finding.code) == ("no-solution", "g111-parallel")
    assert set(finding.addresses) == {"A", "B", "X", "Z"}
    # V2 is 40 left of the start and 10 above it; the line at 135 degrees passes it at (40 - 10) / sqrt 2.
    assert finding.values["off_by_mm"] == pytest.approx(30 / 2**0.5)
    (tie,) = answer.diagnosis.ties
    assert (set(tie.addresses), tie.is_conflict) == ({"A", "B", "X", "Z"}, True)
    (freedom,) = answer.diagnosis.freedoms
    assert (freedom.point, freedom.angle) == ("V1", pytest.approx(135))
    layers = verdicts(answer)
    assert [layers[name] for name in LAYERS[2:]] == ["passed", "passed", "found", "not run"]
    # A sign may be lost; and each of the four words can give way to I or to K.
    slips = {"G111 A-135. B135. X60. Z-40.", "G111 A135. B-135. X60. Z-40."}
    assert {fix.replacement for fix in finding.fixes[:2]} == slips
    assert len(finding.fixes) == 2 + 8


@pytest.mark.parametrize("rules", ["enforce", "off"])
def test_a_b_x_and_z_are_unusual_and_fine(rules):
    answer = answer_to("G111 A135. B180. X60. Z-40.", rules)
    assert (answer.status.value, answer.diagnostics) == ("solved", ())
    assert answer.contour.points["V1"] == pytest.approx((-10, 30))
    assert answer.contour.end == pytest.approx((-40, 30))


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
        solve(text.replace(word, f",A{angle:.3f}"), rules=rules).answers[0].status.value
        for angle in (low - 0.01, low + 0.01, low + size / 2, low + size - 0.01, low + size + 0.01)
    ]
    assert found == ["no-solution", "solved", "solved", "solved", "no-solution"]


# Ties and freedoms against every subset of words ------------------------------------------------------


def rows_of(words: Words, start: tuple[float, float] = (0, 20)) -> tuple[numpy.ndarray, numpy.ndarray]:
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


@pytest.mark.parametrize("seed", range(100))
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


@pytest.mark.parametrize("seed", range(40))
def test_identities_hold_for_every_consistent_block_that_has_them(seed):
    random = Random(seed)
    v1, v2 = (complex(random.uniform(5, 50), random.uniform(5, 50)) for _ in range(2))
    z, x = random.uniform(-50, 50), random.uniform(20, 60)
    a, b = (float(numpy.angle(each, deg=True)) for each in (v1, v2 - v1))
    values = {
        "A": a, "B": b, "I": v1.imag, "K": v1.real,
        "X": 2 * (x + v2.imag), "U": 2 * v2.imag, "Z": z + v2.real, "W": v2.real,
    }  # fmt: skip
    words = {name: round(Decimal(value), 9) for name, value in values.items()}
    letters = random.sample(EQUATIONS, random.choice((5, 6, 8)))
    answer = answer_to(block_of({name: words[name] for name in letters}), "off", f"X{2 * x:.9f} Z{z:.9f}")
    radius = {**values, "X": values["X"] / 2, "U": values["U"] / 2, "Xstart": x, "Zstart": z}
    angles = {name: radians(values[name]) for name in "AB"}
    assert len(answer.diagnosis.ties) > 0
    for tie in answer.diagnosis.ties:
        left, right = tie.identity.split(" = ")
        names = {*re.findall(r"\b[A-Z]\w*", tie.identity)} - {"Xstart", "Zstart"}
        assert names == set(tie.addresses)
        value = eval(right, {"__builtins__": {}}, {**radius, **angles, "tan": tan})
        assert value == pytest.approx(radius[left], abs=1e-5 * max(1, abs(1 / tan(angles["B"])))), tie
        assert not tie.is_conflict


SAID_TWICE = [
    ("yasnac-lx3", "G111 X100. A180. K-30. B120. P5.", "X40. Z0.", ["length of line 1 = 31"], "K A fact", 1.0),
    ("heidenhain", "L X+0 Y+0\nFL X+20 Y+0 AN0 LEN20.5\nFL X+20 Y+20 AN90", None, [], "X AN LEN", 0.5),
    ("heidenhain", "L X+0 Y+0\nFC DR+ R10 CCX+0 CCY+10 X+10 Y+10.5", None, [], "X Y CCX CCY R", 0.0125),
    ("nct-99m", "G17 G90 G41 G0 X0 Y0\nG1 X100 Y0 ,R5\nG3 X140.1 Y40 I0 J40", None, [], "X Y I J X Y", 0.1),
]


@pytest.mark.parametrize(("control", "program", "start", "facts", "words", "off"), SAID_TWICE)
def test_facts_of_all_kinds_that_say_the_same_are_a_tie(control, program, start, facts, words, off):
    """Of G111, of circles, of facts and of FK, with by how much they disagree, and that these are all."""
    (answer,) = solve(program, control=control, start=start, facts=facts).answers
    told = [tuple("fact" if each in facts else each for each in tie.addresses) for tie in answer.diagnosis.ties]
    tie = answer.diagnosis.ties[told.index(tuple(words.split()))]
    assert tie.is_conflict
    assert tie.off_by_mm == pytest.approx(off, abs=1e-3)
    assert answer.diagnosis.ties_complete


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


@pytest.mark.parametrize("power", range(1, 15))
@pytest.mark.parametrize("half_turn", [0, 180])
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("aside", [0, 20], ids=["on the way", "10 mm aside"])
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
@pytest.mark.parametrize("circle", ["I-50", "X-50 Y0 R50", "X-50 Y0 I-50"])
def test_line_ever_closer_to_touching_the_circle_is_never_solved_wrongly(power, sign, side, circle):
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


@pytest.mark.parametrize(
    ("words", "rules", "start", "not_run", "reason"),
    [
        ("A135. I10. K-12. B180. Z-40,5", "enforce", START, LAYERS[1:], "not every word could be read"),
        ("A#1 I10. B180. Z-40.", "enforce", START, LAYERS[2:], "not every word could be read"),
        ("A135. B135. X60. Z-40.", "off", START, ["rules"], "switched off"),
        ("A135. I10. B180. Z-40.", "enforce", None, LAYERS[4:], "the start point is not known"),
        ("A135. B180. Z-40.", "enforce", START, LAYERS[4:], "words are missing"),
        (
            *("A180. K-30. B120. X100. C2. P2.", "enforce", START, LAYERS[4:]),
            "a corner or a choice is not determined",
        ),
        ("A135. B135. X60. Z-40.", "enforce", START, LAYERS[5:], "the points are not determined"),
        ("A135. I10. B180. Z-40. M08", "enforce", START, LAYERS[5:], "a rule refuses the block"),
    ],
)
def test_layer_that_could_not_run_says_so_and_why(words, rules, start, not_run, reason):
    layers = {layer.name: layer for layer in answer_to(f"G111 {words}", rules, start).diagnosis.layers}
    assert {layers[name].remark for name in not_run if layers[name].verdict is Verdict.NOT_RUN} == {reason}
    run = LAYERS[: LAYERS.index(not_run[0])]
    assert [name for name in LAYERS if layers[name].verdict is Verdict.NOT_RUN][: len(not_run)] == not_run
    assert [name for name in run if layers[name].verdict is Verdict.NOT_RUN] == []


# Slips of a newcomer -------------------------------------------------------------------------------------


@pytest.mark.parametrize("words", ["X100 A180 K-30 B120", "X100. A180 K-30. B120."])
def test_a_forgotten_point_is_told_and_mended_first(words):
    answer = answer_to(f"G111 {words}")
    error = next(each for each in answer.diagnostics if each.severity is Severity.ERROR)
    assert error.notes[0] == "A180 is read as 0.180 deg: it has no decimal point"
    assert error.help.startswith("write A180. if that is meant")
    assert error.fixes[0].replacement == "G111 X100. A180. K-30. B120."
    (told,) = (each for each in answer.diagnostics if each.code == "point-missing")
    assert "0.180 deg" in told.message


@pytest.mark.parametrize("words", ["A180000 K-30000 B120000 X100000", "A180000 K-30000 B120000"])
def test_least_increments_that_mean_what_they_say_are_left_alone(words):
    assert "point-missing" not in {each.code for each in answer_to(f"G111 {words}").diagnostics}


def test_a_decimal_comma_in_a_fact_is_told_as_in_a_word_and_mended():
    answer = answer_to("G111 A180. B120. X100. (contoursolve: length of line 1 = 30,5)")
    error = next(each for each in answer.diagnostics if each.severity is Severity.ERROR)
    assert error.message.endswith("30,5 has a decimal comma; write 30.5")
    assert error.fixes[0].replacement.endswith("length of line 1 = 30.5)")


@pytest.mark.parametrize(("angle", "slip", "turn"), [("A400.", "A200.", "A-140."), ("A580.", "A180.", "A220.")])
def test_an_angle_of_more_than_a_turn_may_be_a_slip_or_one_within_a_turn_that_runs_forward(angle, slip, turn):
    (error,) = answer_to(f"G111 {angle} K-30. B120. X100.").diagnostics
    assert [fix.replacement for fix in error.fixes] == [f"G111 {fixed} K-30. B120. X100." for fixed in (slip, turn)]


# Corners that overlap -------------------------------------------------------------------------------------

OVERLAPPING = {
    "two roundings": ("G00 X40. Z0.\nG111 X100. A180. K-30. B120. {} {}", "P35.", "Q35."),
    "rounding and bevel": ("G00 X40. Z0.\nG111 X100. A180. K-30. B120. {} {}", "P40.", "D20."),
    "no multiple of the least increment": ("G00 X40. Z0.\nG111 X100. A180. K-31.7 B127.3 {} {}", "P45.123", "Q33."),
    "inches": ("G20 G00 X1.6 Z0.\nG111 X4. A180. K-2.7 B127.3 {} {}", "P2.2", "Q1.8"),
    "two blocks": ("G17 G90 G0 X0 Y0\nG1 X30 {}\nY30 {}\nX60", ",C20.", ",R20."),
    "on an arc": ("G17 G90 G0 X0 Y0\nG1 X30 {}\nG3 X0 Y30 R30 {}\nG1 Y0", ",R14", ",R14"),
}


@pytest.mark.boundary
@pytest.mark.parametrize("name", OVERLAPPING)
def test_of_two_corners_that_overlap_each_is_told_how_large_it_may_be_if_the_other_stays(name):
    text, *sizes = OVERLAPPING[name]
    step, mm, unit = ("0.0001", "25.4", "in") if text.startswith("G20") else ("0.001", "1", "mm")
    control = control_of(text)
    (error,) = solve(text.format(*sizes), control=control).answers[0].diagnostics
    assert error.code.endswith("corners-overlap")
    named = [f"{size} (program line {line})" if text.startswith("G17") else size for line, size in enumerate(sizes, 2)]
    for index, key in enumerate(("limit_first", "limit_second")):
        largest = (Decimal(error.values[key]) / Decimal(mm) + Decimal("1e-10")) // Decimal(step) * Decimal(step)
        assert f"at most {largest} {unit} for {named[index]}" in error.help
        assert error.labels[index].text == f"at most {largest} {unit} beside {named[1 - index]}"
        outcomes, words = [], [*sizes]
        for size in (largest + Decimal(step), largest):
            words[index] = f"{sizes[index].rstrip('0123456789.')}{size}"
            outcomes.append(solve(text.format(*words), control=control).answers[0].contour is not None)
        assert outcomes == [False, True]
        block = text.format(*words).partition("\n")[2]
        assert numbers_of(block) in [numbers_of(fix.replacement) for fix in error.fixes]


def numbers_of(block: str) -> list[tuple[str, Decimal]]:
    """The words of a block, with their values."""
    return [(word.address, word.number) for each in parse(block).blocks for word in each.words]


def test_the_largest_sizes_of_overlapping_corners_come_in_the_order_of_the_words():
    straight, turned = (
        answer_to(f"G111 X100. A180. K-30. B120. {words}").diagnostics[0] for words in ("P35. Q30.", "Q30. P35.")
    )
    assert straight.addresses == ("P", "Q")
    assert turned.addresses == ("Q", "P")
    # On line 2, of 34.641 mm, both corners take tan(30) of their radius.
    assert (straight.values["limit_first"], straight.values["limit_second"]) == pytest.approx((30, 25))
    assert (turned.values["limit_first"], turned.values["limit_second"]) == pytest.approx((25, 30))


def test_the_largest_size_of_a_corner_that_is_shown_fits():
    (error,) = answer_to("G111 X100. A180. K-30. B120. P60.").diagnostics  # 51.9615 mm fit
    assert "at most 51.961 mm fits" in error.message
    fits = [answer_to(f"G111 X100. A180. K-30. B120. P{size}").contour is not None for size in ("51.961", "51.962")]
    assert fits == [True, False]


def test_completion_with_a_contour_solves():
    arc, options = "G3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87", {"control": "nct-99m", "start": "G17 G42 G0 X50 Y0"}
    found = completions(arc, **options)
    assert sorted(each.word for each in found) == ["Q-1", "Q1"]
    for each in found:
        (answer,) = solve(each.block, **options).answers
        assert (answer.status.value, answer.contour) == ("solved", each.contour)
    first, second = (each.contour.points["P1"] for each in found)
    assert hypot(first[0] - second[0], first[1] - second[1]) > 1
