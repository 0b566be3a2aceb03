"""Why a block is refused: the six blocks that no other tool diagnoses, and laws on random blocks.

The equations are written down a second time here, as rows of a matrix, and every subset of words is tried.
"""

import re
from collections import Counter
from dataclasses import dataclass, field
from decimal import Decimal
from difflib import SequenceMatcher
from functools import lru_cache
from itertools import combinations
from math import atan2, cos, degrees, hypot, inf, radians, sin, tan
from random import Random
from typing import Any

import mpmath
import numpy
import pytest
from examples import control_of
from records import replace

from contoursolve import Answer, completions, parse, solve, what_if
from contoursolve.diagnostics.finding import Applicability, Severity, Verdict

START = "X40. Z0."
AGREEMENT = 0.001
"""mm or degrees: the least increment."""

LAYERS = ["grammar", "rules", "structure", "generic rank", "values", "geometry"]


def answer_to(text: str, rules: str = "enforce", start: str | None = START, **options: str) -> Answer:
    (answer,) = solve(text, control="yasnac-lx3", rules=rules, start=start, **options).answers
    return answer


def verdicts(answer: Answer) -> dict[str, str]:
    assert [layer.name for layer in answer.diagnosis.layers] == LAYERS
    return {layer.name: layer.verdict.value for layer in answer.diagnosis.layers}


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
    assert {fix.replacement for fix in finding.fixes} == {
        "G111 I10. K-10. B180. Z-40.",
        "G111 A135. K-10. B180. Z-40.",
        "G111 A135. I10. B180. Z-40.",
    }
    assert {fix.applicability for fix in finding.fixes} == {Applicability.SAFE}


@pytest.mark.parametrize(
    ("rules", "status", "code"), [("enforce", "solved", "g111-a-ignored"), ("off", "conflicting", "words-conflict")]
)
def test_a_i_and_k_that_disagree_are_named_with_what_each_would_have_to_be(rules, status, code):
    answer = answer_to("G111 " + AIK.format(k="-12."), rules)
    (finding,) = answer.diagnostics
    assert (answer.status.value, finding.code, finding.addresses) == (status, code, ("A",))
    # The direction of V1 from the start, and how far V1 (12 left, 10 up) lies from the line at 135 degrees.
    expected = {"actual": 135, "expected": 140.19442890773481, "off_by_mm": 2 / 2**0.5}
    assert finding.values == pytest.approx(expected, abs=1e-9)
    (tie,) = answer.diagnosis.ties
    assert (set(tie.addresses), tie.is_conflict) == ({"A", "I", "K"}, True)
    assert tie.off_by_mm == pytest.approx(2)
    notes = " ".join(finding.notes)
    assert all(text in notes for text in ("I12.", "K-10.", "A140.194", "2.000 mm apart"))
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
    placeholders = {fix.replacement for fix in answer.diagnostics[0].fixes}
    assert len(placeholders) == 20
    assert {fix.applicability for fix in answer.diagnostics[0].fixes} == {Applicability.PLACEHOLDER}


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


@pytest.mark.parametrize("rules", ["enforce", "off"])
def test_line_that_misses_the_circle_is_told_by_how_much_and_which_angles_meet_it(rules):
    text = "G17 G42 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y60 ,A180 Q-1"
    (answer,) = solve(text, rules=rules).answers
    (finding,) = answer.diagnostics
    assert (answer.status.value, finding.code, finding.addresses) == ("no-solution", "nct-circle-missed", (",A",))
    values = {name: finding.values[name] for name in ("actual", "limit", "off_by_mm")}
    assert values == pytest.approx({"actual": 60, "limit": 50, "off_by_mm": 10})
    # Seen from the end, the circle spans twice asin(50 / |end|) about the centre; one tangent is upright.
    assert finding.values["angle_from"] == pytest.approx(90)
    assert finding.values["angle_to"] == pytest.approx(90 + 2 * numpy.degrees(numpy.arcsin(50 / hypot(50, 60))) % 180)
    inside = (finding.values["angle_from"] + finding.values["angle_to"]) / 2
    found = {
        solve(text.replace(",A180", f",A{angle:.3f}"), rules=rules).answers[0].status.value
        for angle in (inside, finding.values["angle_from"] + 0.01, finding.values["angle_to"] - 0.01)
    }
    assert found == {"solved"}
    assert verdicts(answer)["geometry"] == "found"


@pytest.mark.parametrize("rules", ["enforce", "off"])
def test_the_angles_at_which_a_line_meets_the_circle_behind_it_are_those_of_its_travel(rules):
    text = "G17 G90 G42 D1 G0 X0 Y0\nG1 ,A0\nG3 X50 Y50 I40 J50 R10 Q1"
    (answer,) = solve(text, rules=rules).answers
    (finding,) = answer.diagnostics
    low, high = finding.values["angle_from"], finding.values["angle_to"]
    assert "a line through the same start point meets the circle" in finding.notes[0]
    found = [
        solve(text.replace(",A0", f",A{angle:.3f}"), rules=rules).answers[0].status.value
        for angle in (low - 0.01, low + 0.01, (low + high) / 2, high - 0.01, high + 0.01)
    ]
    assert found == ["no-solution", "solved", "solved", "solved", "no-solution"]


# Ties and freedoms against every subset of words ------------------------------------------------------

EQUATIONS = "AIKBXUZW"
Words = dict[str, Decimal]


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


def decimal(random: Random, low: int, high: int, step: str = "0.05") -> Decimal:
    return random.randint(low, high) * Decimal(step)


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


def block_of(words: Words) -> str:
    return "G111 " + " ".join(
        f"{name}{value:f}" + ("" if "." in f"{value:f}" else ".") for name, value in words.items()
    )


FOR_DIAGNOSES, FOR_BLOCKS = pytest.mark.parametrize("count", [18, 36]), pytest.mark.parametrize("count", [10, 16])


@lru_cache
def random_diagnoses(count: int) -> list[tuple[Words, Answer]]:
    random, result = Random(3), []
    while len(result) < count:
        size = random.choice((1, 2, 3, 4, 5, 5, 6, 6, 7, 8))
        words = random_words(random, "".join(random.sample(EQUATIONS, size)))
        result.append((words, answer_to(block_of(words), "off")))
    return result


@FOR_DIAGNOSES
@pytest.mark.slow
def test_ties_are_all_minimal_dependent_sets_and_conflicts_all_minimal_inconsistent_ones(count):
    conflicts_seen = ties_seen = 0
    for words, answer in random_diagnoses(count):
        conflicts, dependent, is_near = brute_force(words)
        if is_near:
            continue
        if answer.diagnosis is None:
            assert (answer.status.value, dependent) == ("solved", set()), words
            continue
        ties = Counter(frozenset(tie.addresses) for tie in answer.diagnosis.ties)
        assert ties == Counter(dependent), (block_of(words), answer.status)
        assert {frozenset(tie.addresses) for tie in answer.diagnosis.ties if tie.is_conflict} == conflicts, words
        assert answer.diagnosis.ties_complete
        conflicts_seen, ties_seen = conflicts_seen + len(conflicts), ties_seen + len(dependent)
    assert conflicts_seen > count / 2
    assert ties_seen > conflicts_seen + count / 2


@pytest.mark.slow
@FOR_DIAGNOSES
def test_status_is_that_of_the_ranks(count):
    for words, answer in random_diagnoses(count):
        conflicts, dependent, is_near = brute_force(words)
        if is_near:
            continue
        matrix, _ = rows_of(words)
        is_determined = numpy.linalg.matrix_rank(matrix, tol=1e-9) == 4
        status, said = answer.status.value, (block_of(words), answer.status)
        if not is_determined:
            # Words that agree take precedence over a geometry that does not exist, by the contract's order.
            missing = ("no-solution", "conflicting", "overdetermined") if conflicts else ()
            assert status in ("underdetermined", *missing), said
            assert answer.contour is None, said
        elif conflicts:
            assert status in ("conflicting", "no-solution"), said
        else:
            assert status in ("overdetermined" if dependent else "solved", "no-solution"), said


@pytest.mark.slow
@FOR_DIAGNOSES
def test_amount_of_a_tie_is_the_largest_change_of_one_word_that_makes_it_agree(count):
    seen = 0
    for words, answer in random_diagnoses(count):
        for tie in answer.diagnosis.ties if answer.diagnosis else ():
            own = {name: words[name] for name in tie.addresses}
            matrix, right = rows_of(own)
            weights = numpy.linalg.svd(matrix)[0][:, len(own) - 1]
            expected = max(abs(float(weights @ right) / weights))
            assert tie.off_by_mm == pytest.approx(expected, rel=1e-9, abs=1e-9), (words, tie)
            seen += tie.is_conflict
    assert seen > count


@pytest.mark.slow
@FOR_DIAGNOSES
def test_freedoms_are_the_null_space_seen_at_each_point(count):
    seen = Counter()
    for words, answer in random_diagnoses(count):
        if answer.diagnosis is None:
            continue
        matrix, _ = rows_of(words)
        _, values, right = numpy.linalg.svd(matrix)
        null = right[int((values > 1e-9).sum()) :]
        found = {freedom.point: freedom.direction for freedom in answer.diagnosis.freedoms}
        for point, columns in (("V1", (0, 1)), ("V2", (2, 3))):
            part = null[:, columns]
            dimension = int(numpy.linalg.matrix_rank(part, tol=1e-9)) if part.size else 0
            assert (point in found) == (dimension > 0), words
            if dimension == 2:
                assert found[point] is None, words
            elif dimension == 1:
                direction = numpy.array(found[point])
                assert hypot(*direction) == pytest.approx(1), words
                # Some motion that the words allow moves the point along the direction: A times it is zero.
                motion = numpy.linalg.lstsq(part.T, direction, rcond=None)[0] @ null
                assert motion[list(columns)] == pytest.approx(direction, abs=1e-9), words
                assert matrix @ motion == pytest.approx(numpy.zeros(len(matrix)), abs=1e-9), words
            seen[dimension] += 1
    assert min(seen[dimension] for dimension in (0, 1, 2)) > count / 10


@pytest.mark.slow
@pytest.mark.parametrize("count", [10, 40])
def test_identities_hold_for_every_consistent_block_that_has_them(count):
    random, seen = Random(4), set()
    for _ in range(count):
        v1, v2 = (complex(random.uniform(5, 50), random.uniform(5, 50)) for _ in range(2))
        z, x = random.uniform(-50, 50), random.uniform(20, 60)
        if abs(v2 - v1) < 1:
            continue
        a, b = (float(numpy.angle(each, deg=True)) for each in (v1, v2 - v1))
        values = {
            "A": a, "B": b, "I": v1.imag, "K": v1.real,
            "X": 2 * (x + v2.imag), "U": 2 * v2.imag, "Z": z + v2.real, "W": v2.real,
        }  # fmt: skip
        words = {name: round(Decimal(value), 9) for name, value in values.items()}
        letters = random.sample(EQUATIONS, random.choice((5, 6, 8)))
        start = f"X{2 * x:.9f} Z{z:.9f}"
        answer = answer_to(block_of({name: words[name] for name in letters}), "off", start)
        radius = {**values, "X": values["X"] / 2, "U": values["U"] / 2, "Xstart": x, "Zstart": z}
        angles = {name: radians(values[name]) for name in "AB"}
        for tie in answer.diagnosis.ties:
            assert tie.identity, tie
            left, right = tie.identity.split(" = ")
            names = {*re.findall(r"\b[A-Z]\w*", tie.identity)} - {"Xstart", "Zstart"}
            assert names == set(tie.addresses)
            value = eval(right, {"__builtins__": {}}, {**radius, **angles, "tan": tan})
            assert value == pytest.approx(radius[left], abs=1e-5 * max(1, abs(1 / tan(angles["B"])))), tie
            assert not tie.is_conflict
            seen.add(tie.identity)
    assert len(seen) == 15


# Repairs ----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Case:
    """A block with something wrong: words by address, what else is written in it, and how."""

    kind: str
    words: Words
    extra: tuple[str, ...] = ()
    with_comma: str = ""
    start: tuple[Decimal, Decimal] = (Decimal(40), Decimal(0))
    """X as diameter, Z."""
    order: tuple[int, ...] = field(default=())

    @property
    def text(self) -> str:
        words = []
        for name, value in self.words.items():
            text = f"{value:f}" if "." in f"{value:f}" else f"{value:f}.0"
            words.append(name + (text.replace(".", ",") if name == self.with_comma else text))
        words += self.extra
        return " ".join(["G111", *(words[index] for index in self.order or range(len(words)))])

    @property
    def start_text(self) -> str:
        return "X{:.4f} Z{:.4f}".format(*self.start)

    def solve(self, **options: str) -> Answer:
        return answer_to(self.text, start=self.start_text, **options)


def good_words(random: Random) -> tuple[Words, Answer]:
    """A legal block that is solved without a finding; in steps of 0.5 inch, so that inches write it exactly."""
    while True:
        first = random.sample("AIK", 2)
        second = random.choice(("BX", "BU", "BZ", "BW", "XZ", "UW", "XW"))
        if random.random() < 0.2:
            first, second = first[:1], random.choice(("BXZ", "BUW"))
        corners = random.choice(("", "P", "C", "PQ", "CD", "Q", "PD"))
        if "B" not in second or len(second) == 3:
            corners = corners.strip("QD")
        names = [*first, *second, *corners]
        random.shuffle(names)
        words = {name: random.choice((1, 2, 3)) * Decimal("0.254") if name in "CPDQ"
                 else Decimal(15 * random.randint(-11, 12)) if name in "AB"
                 else random.choice((-3, -2, -1, 1, 2, 3)) * Decimal("12.7") for name in names}  # fmt: skip
        answer = answer_to(block_of(words), depth="verdict")
        if answer.status.value == "solved" and not answer.diagnostics:
            return words, answer


def implied(words: Words, answer: Answer, name: str) -> Decimal | None:
    """The value that a word would have in the contour, to the least increment."""
    (v1z, v1x), (v2z, v2x) = answer.contour.points["V1"], answer.contour.points["V2"]
    value = {
        "A": numpy.degrees(numpy.arctan2(v1x - 20, v1z)),
        "I": v1x - 20, "K": v1z,
        "B": numpy.degrees(numpy.arctan2(v2x - v1x, v2z - v1z)),
        "X": 2 * v2x, "U": 2 * (v2x - 20), "Z": v2z, "W": v2z,
    }[name]  # fmt: skip
    return Decimal(f"{float(value):.3f}")


KINDS = (
    "missing", "agrees", "disagrees", "corner too large", "sign", "x and u", "c and p", "angle", "m08", "comma",
)  # fmt: skip


def broken(random: Random, kind: str) -> Case:
    while True:
        words, answer = good_words(random)
        lines = [name for name in words if name in EQUATIONS]
        spare = [
            name
            for name in EQUATIONS
            if name not in words and {"X": "U", "U": "X", "Z": "W", "W": "Z"}.get(name, "-") not in words
        ]
        angles = [name for name in "AB" if name in words]
        match kind:
            case "missing":
                gone = random.choice(lines)
                return Case(kind, {name: value for name, value in words.items() if name != gone})
            case "agrees" | "disagrees" if spare:
                name = random.choice(spare)
                off = Decimal("12.7") if kind == "disagrees" else 0
                return Case(kind, words | {name: implied(words, answer, name) + off})
            case "corner too large" if corners := [name for name in words if name in "CPDQ"]:
                return Case(kind, words | {random.choice(corners): Decimal(254)})
            case "sign":
                name = random.choice(lines)
                value = words[name]
                return Case(
                    kind, words | {name: (value - 180 if value > 0 else value + 180) if name in "AB" else -value}
                )
            case "x and u" if "X" in words or "U" in words:
                return Case(kind, words | {name: implied(words, answer, name) for name in "XU" if name not in words})
            case "c and p" if "C" in words or "P" in words:
                return Case(kind, words | {name: Decimal("0.508") for name in "CP" if name not in words})
            case "angle" if angles:
                name = random.choice(angles)
                return Case(kind, words | {name: words[name] + random.choice((-720, 720))})
            case "m08":
                return Case(kind, words, ("M08",))
            case "comma":
                return Case(kind, words, with_comma=random.choice(list(words)))


@lru_cache
def broken_blocks(count: int) -> list[tuple[Case, Answer]]:
    random = Random(5)
    cases = [broken(random, KINDS[number % len(KINDS)]) for number in range(count)]
    return [(case, case.solve()) for case in cases]


def fixes_of(answer: Answer) -> tuple[Any, ...]:
    return tuple(fix for finding in answer.diagnostics for fix in finding.fixes)


def changed_words(old: str, new: str) -> frozenset[tuple[str, ...]]:
    """Which words differ: dropped, added, or written over in their place."""
    before, after = old.split(), new.split()
    changes: list[tuple[str, ...]] = []
    for what, i, j, k, m in SequenceMatcher(None, before, after, autojunk=False).get_opcodes():
        if what == "replace" and j - i == m - k:
            changes += zip(before[i:j], after[k:m], strict=True)
        elif what != "equal":
            changes += [(word, "") for word in before[i:j]] + [("", word) for word in after[k:m]]
    return frozenset(changes)


def same_contour(one: Any, other: Any, tolerance: float = AGREEMENT) -> bool:
    if len(one.elements) != len(other.elements):
        return False
    pairs = [(one.end, other.end)]
    pairs += [(a.end, b.end) for a, b in zip(one.elements, other.elements, strict=True)]
    pairs += [(one.points[name], other.points[name]) for name in one.points]
    return all(hypot(a[0] - b[0], a[1] - b[1]) <= tolerance for a, b in pairs)


@pytest.mark.slow
@FOR_BLOCKS
def test_fix_applied_solves_the_block_and_removes_its_findings(count):
    seen = Counter()
    for case, answer in broken_blocks(count):
        old = {finding.code for finding in answer.diagnostics}
        for fix in fixes_of(answer):
            if fix.applicability is Applicability.PLACEHOLDER:
                continue
            again = answer_to(fix.replacement, start=case.start_text)
            assert again.status.value == "solved", (case.text, fix)
            # A path that crosses the spindle axis, or turns far, may be meant.
            told = [each for each in again.diagnostics if each.code not in ("axis-crossed", "suspected")]
            left = [each for each in told if each.severity is not Severity.INFO]
            for each in left:
                assert each.code not in old, (case.text, fix, each.code)
                assert each.code.endswith("-ignored"), (case.text, fix, each.code)
                assert each.values["off_by_mm"] <= AGREEMENT, (case.text, fix)
            seen[case.kind] += 1
    # Not every block of a kind has a fix.
    assert len(seen) >= 8, seen
    assert count < 60 or all(seen[kind] > count / 30 for kind in KINDS if kind != "missing"), seen


@pytest.mark.slow
@FOR_BLOCKS
def test_fix_offered_with_the_rules_off_removes_the_findings_that_it_was_offered_for(count):
    wrong = []
    for case, _ in broken_blocks(count):
        answer = case.solve(rules="off")
        old = {finding.code for finding in answer.diagnostics if finding.severity is not Severity.INFO}
        for fix in fixes_of(answer):
            if fix.applicability is not Applicability.PLACEHOLDER:
                again = answer_to(fix.replacement, "off", case.start_text, depth="verdict")
                left = old & {finding.code for finding in again.diagnostics}
                wrong += [(case.kind, case.text, fix.description, left)] if left else []
    assert wrong == []


@FOR_BLOCKS
def test_no_two_fixes_write_the_same_numbers_and_none_writes_the_old_one(count):
    def meaning(text: str) -> frozenset[tuple[str, str]]:
        words = re.findall(r"([A-Z])([-+0-9.,?]+)", text)
        return frozenset((name, _number(name, value)) for name, value in words)

    for case, answer in broken_blocks(count):
        for each in (answer, case.solve(rules="off")):
            # What mends both of two findings stands with both.
            for fixes in {finding.fixes for finding in each.diagnostics}:
                meanings = [meaning(fix.replacement) for fix in fixes]
                doubles = [fix.description for fix, own in zip(fixes, meanings, strict=True) if meanings.count(own) > 1]
                assert not doubles, (case.text, doubles)
                # A word that moves into a block of its own keeps its number.
                new = [own for fix, own in zip(fixes, meanings, strict=True) if "move " not in fix.description]
                assert meaning(case.text) not in new, (case.text, [fix.description for fix in fixes])


def _number(name: str, text: str) -> str:
    """A number as the control means it: a direction is the same after a full turn."""
    if not re.fullmatch(r"[-+0-9.]+", text) or name not in "AB":
        return text if not re.fullmatch(r"[-+0-9.]+", text) else str(Decimal(text).normalize())
    value = Decimal(text)
    return str(((value + 360) % 360).normalize()) if abs(value) <= 360 else text


@FOR_BLOCKS
def test_every_broken_block_that_one_word_would_mend_has_a_fix(count):
    without = [
        (case.kind, case.text)
        for case, answer in broken_blocks(count)
        if answer.diagnostics and case.kind != "sign" and not fixes_of(answer)
    ]
    assert without == []


@FOR_BLOCKS
def test_every_single_word_whose_dropping_mends_a_block_is_offered(count):
    """Against trying each word."""
    missing, seen = [], 0
    for case, answer in broken_blocks(count):
        if not answer.diagnostics or case.kind == "comma":  # that word is corrected, not dropped
            continue
        offered = {fix.replacement for fix in fixes_of(answer)}
        words = case.text.split()
        for index in range(1, len(words)):
            text = " ".join(words[:index] + words[index + 1 :])
            again = answer_to(text, start=case.start_text, depth="verdict")
            if again.status.value == "solved" and not again.diagnostics:
                seen += 1
                missing += [(case.text, words[index])] if text not in offered else []
    assert missing == []
    assert seen > count * 2 / 3


@FOR_BLOCKS
def test_safe_fix_keeps_the_contour_and_no_other_fix_is_called_so(count):
    seen = Counter()
    for case, answer in broken_blocks(count):
        reference = answer.contour or case.solve(rules="off").contour
        for fix in fixes_of(answer):
            if fix.applicability is Applicability.PLACEHOLDER:
                continue
            again = answer_to(fix.replacement, start=case.start_text).contour
            is_same = reference is not None and same_contour(reference, again)
            # What else the machine does is not the contour.
            is_kept = not re.search("delete [MSTF]", fix.description)
            assert (fix.applicability is Applicability.SAFE) == (is_same and is_kept), (case.text, fix)
            seen[fix.applicability] += 1
    assert min(seen.values()) > count / 3


@FOR_BLOCKS
def test_no_fix_contains_another_one(count):
    for case, answer in broken_blocks(count):
        unmoved = [fix for fix in fixes_of(answer) if "move " not in fix.description]
        changes = [changed_words(case.text, fix.replacement) for fix in unmoved]
        assert len(set(changes)) == len(changes), case.text
        assert not any(one < other for one in changes for other in changes), (case.text, fixes_of(answer))


@FOR_BLOCKS
def test_fix_says_where_the_contour_then_ends(count):
    for case, answer in broken_blocks(count):
        for fix in fixes_of(answer):
            found = re.search(r"the contour ends at Z(\S+) mm X(\S+) mm", fix.description)
            assert bool(found) == (fix.applicability is not Applicability.PLACEHOLDER), fix
            if found:
                z, x = answer_to(fix.replacement, start=case.start_text, depth="verdict").contour.end
                said = [float(each) for each in found.groups()]
                assert said == pytest.approx([z, 2 * x], abs=0.0005 + 1e-9), (case.text, fix)


NUMBERS = ("30.", "-30.", "120.", "5.", "-150.", "67.")


@FOR_BLOCKS
def test_placeholder_makes_a_legal_determined_block_for_some_number(count):
    random, solved, seen = Random(6), 0, 0
    for case, answer in broken_blocks(count):
        placeholders = [fix for fix in fixes_of(answer) if fix.applicability is Applicability.PLACEHOLDER]
        for fix in random.sample(placeholders, min(3, len(placeholders))):
            assert "?" in fix.replacement
            statuses = set()
            for _ in range(12):
                text = re.sub(r"\?", lambda _: random.choice(NUMBERS), fix.replacement)
                statuses.add(answer_to(text, start=case.start_text, depth="verdict").status.value)
            assert statuses & {"solved", "no-solution"}, (case.text, fix, statuses)
            assert "rejected" not in statuses, (case.text, fix)
            solved, seen = solved + ("solved" in statuses), seen + 1
    assert seen > count / 6
    assert solved > seen / 2


# What does not change a diagnosis ---------------------------------------------------------------------


def mirrored(case: Case) -> Case:
    words = {
        name: 180 - value if name in "AB" else -value if name in "KZW" else value for name, value in case.words.items()
    }
    return replace(case, words=words, start=(case.start[0], -case.start[1]))


def shifted(case: Case) -> Case:
    by = {"X": Decimal(2000), "Z": Decimal(1000)}
    words = {name: value + by.get(name, 0) for name, value in case.words.items()}
    return replace(case, words=words, start=(case.start[0] + 2000, case.start[1] + 1000))


def shuffled(case: Case) -> Case:
    order = list(range(len(case.words) + len(case.extra)))
    Random(case.text).shuffle(order)
    return replace(case, order=tuple(order))


def in_inches(case: Case) -> Case:
    words = {name: value if name in "AB" else value / Decimal("25.4") for name, value in case.words.items()}
    return replace(case, words=words, start=(case.start[0] / Decimal("25.4"), case.start[1] / Decimal("25.4")))


def verdict(answer: Answer) -> dict[str, Any]:
    diagnosis = answer.diagnosis
    return {
        "status": answer.status,
        # Moved by 2 m, a path crosses the spindle axis no more, and other numbers are another one with its point moved.
        "codes": {finding.code for finding in answer.diagnostics} - {"axis-crossed", "suspected"},
        "layers": diagnosis and verdicts(answer),
        "ties": diagnosis and {(frozenset(tie.addresses), tie.is_conflict) for tie in diagnosis.ties},
        "freedoms": diagnosis and {(each.point, each.direction is None) for each in diagnosis.freedoms},
        # How many there are depends on how numbers are written: slips of typing explain some of them.
        "fixes": bool([fix for each in answer.diagnostics if each.code != "suspected" for fix in each.fixes]),
    }


@pytest.mark.parametrize("rules", ["enforce", pytest.param("off", marks=pytest.mark.slow)])
@pytest.mark.parametrize("change", [shuffled, mirrored, shifted, in_inches])
@FOR_BLOCKS
def test_diagnosis_does_not_depend_on_order_unit_mirror_image_or_shift(change, rules, count):
    wrong = []
    for case, before in broken_blocks(count):
        start = (Decimal("38.1"), case.start[1]) if change is in_inches else case.start
        units = "inch" if change is in_inches else "mm"
        if change is in_inches and case.kind in ("agrees", "x and u"):
            continue  # their values are rounded to the millimetre's least increment
        own = replace(case, start=start)
        one = verdict(before if own == case and rules == "enforce" else own.solve(rules=rules))
        other = verdict(change(own).solve(rules=rules, units=units))
        if one != other:
            wrong.append((case.kind, own.text, {key: (one[key], other[key]) for key in one if one[key] != other[key]}))
    assert wrong == []


@FOR_BLOCKS
def test_repairs_do_not_depend_on_the_order_of_words(count):
    for case, answer in broken_blocks(count):
        other = shuffled(case).solve()
        assert {frozenset(fix.replacement.split()) for fix in fixes_of(answer)} == {
            frozenset(fix.replacement.split()) for fix in fixes_of(other)
        }, case.text


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


@pytest.mark.slow
@pytest.mark.parametrize("half_turn", [0, 180])
@pytest.mark.parametrize("sign", [1, pytest.param(-1, marks=pytest.mark.slow)])
@pytest.mark.parametrize("aside", ["on the way", "10 mm aside"])
def test_lines_ever_more_parallel_are_never_solved_wrongly(half_turn, sign, aside):
    statuses = []
    for power in range(1, 15):
        step = sign * Decimal(10) ** -power
        a, z = Decimal(150), Decimal(-40)
        b = a - half_turn + step
        with mpmath.workdps(60):
            # On the way: line 1 runs 30 mm in X, and line 2 the rest, or back.
            x = 40 - 2 * z * Decimal(str(mpmath.tan(mpmath.pi / 6))) + (20 if aside != "on the way" else 0)
            if aside == "on the way":
                v = mpmath.tan(mpmath.pi * mpmath.mpf(str(b)) / 180)
                x = Decimal(str(40 + 2 * (mpmath.tan(-mpmath.pi / 6) * -25 + v * -15)))
        x = round(x, 22)
        answer = answer_to(f"G111 A{a}. B{b:f} X{x:f} Z{z}.")
        statuses.append(answer.status.value)
        assert_layers_fit(answer)
        if answer.status.value == "solved":
            at, exact = answer.contour.points["V1"], exact_v1(a, b, x, z)
            error = float(mpmath.hypot(at[0] - exact[0], at[1] - exact[1]))
            assert error <= answer.error_bound, (power, error, answer.error_bound)
            assert answer.error_bound < inf
    if aside == "on the way" and not half_turn:
        assert statuses[:3] == ["solved"] * 3
    if half_turn:
        assert "solved" not in statuses[3:] or aside != "on the way"


@pytest.mark.slow
@pytest.mark.parametrize("sign", [1, pytest.param(-1, marks=pytest.mark.slow)])
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("circle", ["I-50", "X-50 Y0 R50", "X-50 Y0 I-50"])
def test_line_ever_closer_to_touching_the_circle_is_never_solved_wrongly(sign, side, circle):
    for power in range(1, 15):
        height = 50 * (1 + sign * Decimal(10) ** -power)
        text = f"G17 G42 G0 X50 Y0\nG3 {circle}\nG1 X-60 Y{height:f} ,A180 Q{side}"
        (answer,) = solve(text).answers
        assert_layers_fit(answer)
        if answer.status.value != "solved":
            assert sign > 0, (power, answer.status)
            continue
        at = answer.contour.points["P1"]
        with mpmath.workdps(60):
            above = mpmath.mpf(str(height))
            half = mpmath.sqrt(2500 - above**2) if sign < 0 else 0
            error = float(min(mpmath.hypot(at[0] - root, at[1] - above) for root in (half, -half)))
        if sign > 0:  # within the rounding of the distance itself, and said to be so
            assert [finding.code for finding in answer.diagnostics] == ["nct-circle-touched"], power
        assert error <= answer.error_bound, (power, error, answer.error_bound)


# Layers that could not run ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "rules", "start", "not_run", "reason"),
    [
        ("G111 A135. I10. K-12. B180. Z-40,5", "enforce", START, LAYERS[1:], "not every word could be read"),
        ("G111 A#1 I10. B180. Z-40.", "enforce", START, LAYERS[2:], "not every word could be read"),
        ("G111 A135. B135. X60. Z-40.", "off", START, ["rules"], "switched off"),
        ("G111 A135. I10. B180. Z-40.", "enforce", None, LAYERS[4:], "the start point is not known"),
        ("G111 A135. B180. Z-40.", "enforce", START, LAYERS[4:], "words are missing"),
        (
            "G111 A180. K-30. B120. X100. C2. P2.",
            "enforce",
            START,
            LAYERS[4:],
            "a corner or a choice is not determined",
        ),
        ("G111 A135. B135. X60. Z-40.", "enforce", START, LAYERS[5:], "the points are not determined"),
        ("G111 A135. I10. B180. Z-40. M08", "enforce", START, LAYERS[5:], "a rule refuses the block"),
    ],
)
def test_layer_that_could_not_run_says_so_and_why(text, rules, start, not_run, reason):
    layers = {layer.name: layer for layer in answer_to(text, rules, start).diagnosis.layers}
    for name in not_run:
        assert (layers[name].verdict, layers[name].remark) == (Verdict.NOT_RUN, reason), name
    first = not_run[0]
    assert all(layers[name].verdict is not Verdict.NOT_RUN for name in LAYERS[: LAYERS.index(first)])


@FOR_BLOCKS
def test_layers_never_contradict_the_status(count):
    for _, answer in broken_blocks(count):
        assert_layers_fit(answer)


@FOR_DIAGNOSES
def test_layers_of_random_words_never_contradict_the_status(count):
    for _, answer in random_diagnoses(count):
        assert_layers_fit(answer)


# What-if and completions ------------------------------------------------------------------------------


@FOR_BLOCKS
def test_what_if_without_an_edit_is_solve(count):
    for case, answer in broken_blocks(count):
        (same,) = what_if(case.text, control="yasnac-lx3", start=case.start_text).answers
        assert same == answer, case.text


@pytest.mark.slow
@pytest.mark.parametrize("count", [2, 30])
def test_what_if_does_what_its_words_say(count):
    for case, _ in broken_blocks(count):
        if case.kind == "comma":
            continue
        name, *_ = case.words
        dropped = replace(case, words={key: value for key, value in case.words.items() if key != name})
        (answer,) = what_if(case.text, drop=[name], start=case.start_text).answers
        assert verdict(answer) == verdict(dropped.solve()), case.text
        word = case.text.split()[1]
        (back,) = what_if(case.text, change={name: word}, start=case.start_text).answers
        assert verdict(back) == verdict(case.solve()), case.text
        (added,) = what_if(dropped.text, add=[word], start=case.start_text).answers
        assert verdict(added) == verdict(case.solve()), case.text


@pytest.mark.parametrize("address", ["K", "Z"])
def test_what_if_refuses_to_edit_a_word_that_is_not_there_once(address):
    with pytest.raises(ValueError, match="exactly one"):
        what_if("G111 A135. I10. Z-40. Z-40.", drop=[address], start=START)


@FOR_BLOCKS
def test_completions_are_exactly_the_words_that_make_a_block_legal_and_determined(count):
    """Restated from the manual: the missing one of two of A, I, K or of two of line 2."""
    seen = 0
    for case, answer in broken_blocks(count):
        found = completions(case.text, control="yasnac-lx3", start=case.start_text)
        if case.kind != "missing" or answer.status.value == "solved":
            continue
        lines = set(case.words) & set(EQUATIONS)
        first, second = lines & set("AIK"), {"B": "B", "X": "X", "U": "X", "Z": "Z", "W": "Z"}
        slots = {second[name] for name in lines if name in second}
        legal = set()
        for name in set(EQUATIONS) - lines:
            own = first | ({name} & set("AIK"))
            then = slots | ({second[name]} if name in second else set())
            is_twice = name in second and second[name] in slots
            is_cornered = {"X", "Z"} <= then and set(case.words) & set("DQ")
            if (
                not is_twice
                and not is_cornered
                and ((len(own) == 2 and len(then) == 2) or (len(own) == 1 and len(then) == 3))
            ):
                legal.add(name)
        # A legal word that leaves the block singular at these values, or without a contour, whatever its number,
        # completes nothing.
        addresses = {each.word[0] for each in found}
        assert addresses <= legal, case.text
        for name in legal - addresses:
            ranks = [
                numpy.linalg.matrix_rank(rows_of(case.words | {name: Decimal(value)})[0], tol=1e-9)
                for value in ("30", "67.1")
            ]
            numbers = range(-175, 180, 10) if max(ranks) == 4 else ()
            tried = [replace(case, words=case.words | {name: Decimal(number)}).solve() for number in numbers]
            assert not any(each.contour for each in tried), (case.text, name)
        seen += len(addresses)
    assert seen > count / 4


def test_completion_with_a_contour_solves():
    text = "G17 G42 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87"
    arc = "\n".join(text.splitlines()[1:])
    options = {"control": "nct-99m", "start": text.splitlines()[0]}
    found = completions(arc, **options)
    assert {each.word for each in found} == {"Q-1", "Q1"}
    for each in found:
        (answer,) = solve(each.block, **options).answers
        assert answer.status.value == "solved"
        assert answer.contour == each.contour
    first, second = (each.contour.points["P1"] for each in found)
    assert hypot(first[0] - second[0], first[1] - second[1]) > 1


@FOR_BLOCKS
def test_completions_without_a_contour_end_with_a_question_mark(count):
    for case, _ in broken_blocks(count):
        for each in completions(case.text, control="yasnac-lx3", start=case.start_text):
            assert each.word in each.block
            assert each.word.endswith("?") == (each.contour is None)


# Slips of a newcomer -------------------------------------------------------------------------------------

MEANT = "G111 X100. A180. K-30. B120."


@pytest.mark.parametrize("text", ["G111 X100 A180 K-30 B120", "G111 X100. A180 K-30. B120."])
def test_a_forgotten_point_is_told_and_mended_first(text):
    answer = answer_to(text)
    error = next(each for each in answer.diagnostics if each.severity is Severity.ERROR)
    assert error.notes[0] == "A180 is read as 0.180 deg: it has no decimal point"
    assert error.help.startswith("write A180. if that is meant")
    assert error.fixes[0].replacement == MEANT
    (told,) = (each for each in answer.diagnostics if each.code == "point-missing")
    assert "0.180 deg" in told.message


def test_least_increments_that_mean_what_they_say_are_left_alone():
    for text in ("G111 A180000 K-30000 B120000 X100000", "G111 A180000 K-30000 B120000"):
        assert "point-missing" not in {each.code for each in answer_to(text).diagnostics}


def test_a_decimal_comma_in_a_fact_is_told_as_in_a_word_and_mended():
    answer = answer_to("G111 A180. B120. X100. (contoursolve: length of line 1 = 30,5)")
    error = next(each for each in answer.diagnostics if each.severity is Severity.ERROR)
    assert error.message.endswith("30,5 has a decimal comma; write 30.5")
    assert error.fixes[0].replacement.endswith("length of line 1 = 30.5)")


@pytest.mark.parametrize(("angle", "slip", "turn"), [("A400.", "A200.", "A-140."), ("A580.", "A180.", "A220.")])
def test_an_angle_of_more_than_a_turn_may_be_a_slip_or_one_within_a_turn_that_runs_forward(angle, slip, turn):
    answer = answer_to(f"G111 {angle} K-30. B120. X100.")
    (error,) = answer.diagnostics
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


@pytest.mark.parametrize("name", OVERLAPPING)
def test_of_two_corners_that_overlap_each_is_told_how_large_it_may_be_if_the_other_stays(name):
    text, *sizes = OVERLAPPING[name]
    step, mm, unit = ("0.0001", "25.4", "in") if text.startswith("G20") else ("0.001", "1", "mm")

    control = control_of(text)
    (error,) = solve(text.format(*sizes), control=control).answers[0].diagnostics
    assert error.code.endswith("corners-overlap")
    for index, key in enumerate(("limit_first", "limit_second")):
        own = sizes[index]
        named = [
            f"{size} (program line {line})" if text.startswith("G17") else size for line, size in enumerate(sizes, 2)
        ]
        largest = (Decimal(error.values[key]) / Decimal(mm) + Decimal("1e-10")) // Decimal(step) * Decimal(step)
        assert f"at most {largest} {unit} for {named[index]}" in error.help
        assert error.labels[index].text == f"at most {largest} {unit} beside {named[1 - index]}"
        outcomes = []
        for size in (largest + Decimal(step), largest):
            words = [*sizes]
            words[index] = f"{own.rstrip('0123456789.')}{size}"
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
    assert straight.values["limit_first"] == turned.values["limit_second"] > straight.values["limit_second"]


def test_the_largest_size_of_a_corner_that_is_shown_fits():
    (error,) = answer_to("G111 X100. A180. K-30. B120. P60.").diagnostics  # 51.9615 mm fit
    assert "at most 51.961 mm fits" in error.message
    assert answer_to("G111 X100. A180. K-30. B120. P51.961").contour is not None


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
    assert tuple(words.split()) in told
    tie = answer.diagnosis.ties[told.index(tuple(words.split()))]
    assert tie.is_conflict
    assert tie.off_by_mm == pytest.approx(off, abs=1e-3)
    assert answer.diagnosis.ties_complete
