"""The table of all sets of words: kept as reviewed files, and G111's part restated by linear algebra of our own; what
`solve` says of these sets. The values of their words agree with each other, so that a set alone tells its status."""

import re
from functools import lru_cache
from itertools import chain, combinations
from math import cos, radians, sin
from pathlib import Path

import numpy
import pytest
from click.testing import CliRunner

from contoursolve import Answer, solve
from contoursolve.cli import main

TABLES = Path(__file__).parent / "tables"
LETTERS = "ABCDIKPQUWXZ"
EQUATIONS = "AIKBXUZW"
NOT_MIXED = ("XU", "ZW", "CP", "DQ")


@lru_cache(maxsize=1)
def tables() -> dict[str, str]:
    """What the command prints, by form: lines of the form and, first, their header."""
    outcomes = [CliRunner().invoke(main, ["rules", "--table", "--control", name]) for name in ("yasnac-lx3", "nct-99m")]
    assert {outcome.exit_code for outcome in outcomes} == {0}
    parts = [part for outcome in outcomes for part in outcome.output.rstrip("\n").split("\n\n")]
    return {_name(part): part.strip("\n") + "\n" for part in parts}


def _name(part: str) -> str:
    """The form's name; where a form goes along either axis, with which."""
    name, _, *way = part.partition(" ")[2].partition(":")[0].split(", ")
    return " ".join((name, *way)).lower().replace(" ", "-")


@lru_cache(maxsize=1)
def g111_rows() -> dict[frozenset[str], tuple[str, str]]:
    """By set of letters: what the table says of its legality and of its determinacy."""
    rows = [line.split(" | ") for line in tables()["g111"].splitlines()[1:]]
    result = {frozenset(words.split()) - {"-"}: (legality, rest) for words, legality, rest in rows}
    assert len(result) == len(rows)
    return result


def is_legal(letters: frozenset[str]) -> bool:
    """The control's sheet, restated."""
    first = len(letters & set("AIK"))
    has_b, has_x, has_z = (bool(letters & set(slot)) for slot in ("B", "XU", "ZW"))
    return (
        not any(letters >= set(pair) for pair in NOT_MIXED)
        and ((first >= 2 and has_b + has_x + has_z >= 2) or (first == 1 and has_b and has_x and has_z))
        and not (has_x and has_z and letters & set("DQ"))
    )


def ignored(letters: frozenset[str]) -> frozenset[str]:
    """Note v drops A, note vi drops B."""
    first, second = letters & set("AIK"), {"B"} <= letters and letters & set("XU") and letters & set("ZW")
    return frozenset(("A" if len(first) == 3 else "") + ("B" if second and len(first) >= 2 else ""))


def matrix(letters: frozenset[str], seed: int) -> numpy.ndarray:
    """One row for each word that is an equation, at random angles; columns V1z, V1x, V2z, V2x."""
    a, b = (radians(angle) for angle in numpy.random.default_rng(seed).uniform(5, 85, 2))
    rows = {
        "A": (sin(a), -cos(a), 0, 0),
        "I": (0, 1, 0, 0),
        "K": (1, 0, 0, 0),
        "B": (-sin(b), cos(b), sin(b), -cos(b)),
        **dict.fromkeys("XU", (0, 0, 0, 1)),
        **dict.fromkeys("ZW", (0, 0, 1, 0)),
    }
    return numpy.array([rows[each] for each in EQUATIONS if each in letters], dtype=float).reshape(-1, 4)


def ranks(letters: frozenset[str]) -> int:
    return max(int(numpy.linalg.matrix_rank(matrix(letters, seed), tol=1e-9)) for seed in (1, 2))


def free_and_tied(letters: frozenset[str]) -> tuple[frozenset[str], frozenset[str]]:
    """The unknowns that no rows fix, and the words whose row the other rows make up."""
    full = ranks(letters)
    names = ("V1z", "V1x", "V2z", "V2x")
    free = []
    for column, name in enumerate(names):
        unit = numpy.eye(4)[column]
        grown = numpy.vstack([matrix(letters, 1), unit])
        free += [name] if numpy.linalg.matrix_rank(grown, tol=1e-9) > full else []
    tied = (each for each in letters & set(EQUATIONS) if ranks(letters - {each}) == full)
    return frozenset(free), frozenset(tied)


@pytest.mark.slow
def test_tables_are_the_reviewed_ones():
    assert tables() == {path.stem: path.read_text(encoding="utf-8") for path in TABLES.glob("*.txt")}


def mill_rows(form: str) -> dict[frozenset[str], tuple[frozenset[str], frozenset[str], str]]:
    """By set of words (`1:X` is X of block 1): the rules that refuse it, those that warn, its determinacy."""
    rows = {}
    for line in tables()[form].splitlines()[1:]:
        words, legality, rest = line.split(" | ")
        if legality.startswith("read as"):
            continue
        warned = re.search(r" \(warns (.*)\)", legality)
        refused = legality.partition("refused: ")[2].partition(" (")[0]
        found = frozenset(refused.split(", ")) - {""}, frozenset(warned[1].split(", ") if warned else ()), rest
        assert rows.setdefault(frozenset(words.split()) - {"-"}, found) is found
    return rows


def _arc(words: set[str], has_end: bool) -> set[str]:
    """What the sheet says of an ordinary arc."""
    has_center, has_radius = bool(words & {"I", "J"}), "R" in words
    return {
        code
        for code, is_so in {
            "nct-circle-undefined": not has_center and not has_radius,
            "nct-center-and-radius": has_center and has_radius,
            "nct-radius-without-point": has_radius and not has_end,
        }.items()
        if is_so
    }


def _line_before(words: set[str]) -> set[str]:
    """What the sheet says of a line that ends in an intersection: its direction is stated once."""
    codes = {"nct-direction-twice"} if ",A" in words and words & {"X", "Y"} else set()
    codes |= set() if words & {"X", "Y", ",A"} else {"nct-line-undefined"}
    return codes | _alone(words, "X", "Y", ",A")


def _line_to(words: set[str]) -> set[str]:
    """What the sheet says of a line that ends where it says."""
    codes = {"nct-coordinate-missing"} if ",A" in words and not words & {"X", "Y"} else set()
    return codes | _alone(words, "X", "Y", ",A")


def _circle_before(words: set[str]) -> set[str]:
    """What it says of an arc that ends in an intersection."""
    alone = _alone(words, "X", "Y", "I", "J", "R")
    return alone or _arc(words, bool(words & {"X", "Y"}))


def _alone(words: set[str], *all_of_them: str) -> set[str]:
    return {"nct-nothing-before"} if words.issuperset(all_of_them) else set()


def _q(words: set[str]) -> set[str]:
    return set() if "Q" in words else {"nct-q-missing"}


MILL = {
    # By form: its sets of words, those that are of another form or none, and what the sheet refuses.
    "line-angle": (4, 0, lambda one, _: _line_to(one)),
    "corners": (256, 16, lambda one, two: _line_to(one) | _arc(two, has_end=True)),
    "line-line": (64, 2, lambda one, _: _line_before(one)),
    "line-circle": (64, 2, lambda one, two: _line_before(one) | _q(two)),
    "circle-line": (256, 0, lambda one, two: _circle_before(one) | _q(two)),
    "circle-circle": (256, 0, lambda one, two: _circle_before(one) | _q(two)),
    "chain": (128, 8, lambda one, _: _line_before(one)),
}


@pytest.mark.parametrize("form", MILL)
@pytest.mark.slow
def test_sets_of_words_of_the_mill_are_refused_as_the_sheet_says(form):
    count, others, expected = MILL[form]
    rows = mill_rows(form)
    assert (len(rows), len(tables()[form].splitlines()) - 1) == (count - others, count)
    for words, (refused, warned, _) in rows.items():
        one, two, three = (
            {word.removeprefix(mark) for word in words if word.startswith(mark) or (mark == "1:" and ":" not in word)}
            for mark in ("1:", "2:", "3:")
        )
        corners = {"nct-two-corners"} if one >= {",C", ",R"} else set()
        third = _q(three) if form == "chain" else set()
        assert refused == expected(one, two) | corners | third, sorted(words)
        assert warned == ({"nct-q-unused"} if form in ("line-line", "chain") and "Q" in two else set()), sorted(words)


@pytest.mark.slow
@pytest.mark.parametrize("form", MILL)
def test_a_legal_set_of_words_of_the_mill_leaves_nothing_free(form):
    """It may say something twice, where that must agree: a point of a circle that has a centre and another point."""
    for words, (refused, _, rest) in mill_rows(form).items():
        circles = [word for word in ("1:I", "1:J", "2:I", "2:J", "I", "J") if word in words]
        if not refused:
            assert rest.startswith("determined") or (rest.startswith("tied") and "two" not in rest), sorted(words)
        if rest.startswith("determined"):
            assert not (refused == set() and circles and words & {"1:X", "1:Y"} and form == "circle-line"), sorted(
                words
            )
            assert form not in ("line-circle", "circle-circle") or refused


@pytest.mark.slow
def test_table_has_every_set_of_letters_once():
    sets = chain.from_iterable(combinations(LETTERS, size) for size in range(len(LETTERS) + 1))
    assert set(g111_rows()) == set(map(frozenset, sets))


@pytest.mark.slow
def test_276_sets_are_legal_and_they_are_those_of_the_manual():
    legal = {letters for letters, (legality, _) in g111_rows().items() if legality.startswith("legal")}
    assert len(legal) == 276
    assert legal == {letters for letters in g111_rows() if is_legal(letters)}


def test_every_legal_set_is_determined():
    not_determined = {
        "".join(sorted(letters)): rest
        for letters, (legality, rest) in g111_rows().items()
        if legality.startswith("legal") and not rest.startswith("determined")
    }
    assert not_determined == {}


def test_words_that_the_control_ignores_are_those_of_the_notes():
    for letters, (legality, _) in g111_rows().items():
        named = legality.partition("(ignores ")[2].rstrip(")").split(", ") if "(ignores" in legality else []
        assert frozenset(named) == ignored(letters), sorted(letters)


def test_set_is_determined_exactly_when_its_equations_have_rank_4_without_a_spare_and_each_corner_one_shape():
    for letters, (_, rest) in g111_rows().items():
        kept = letters - ignored(letters)
        equations = kept & set(EQUATIONS)
        is_regular = ranks(kept) == len(equations) == 4
        has_one_shape = not any(letters >= set(pair) for pair in ("CP", "DQ"))
        # Corner 2 lands parallel to the axis that B's other partner leaves open: one of X and Z, and B, must be there.
        lands = "B" in kept and bool(kept & set("XU")) != bool(kept & set("ZW"))
        expected = is_regular and has_one_shape and (lands or not letters & set("DQ"))
        assert rest.startswith("determined") == expected, (sorted(letters), rest)


@pytest.mark.parametrize("stride", [11, pytest.param(3, marks=pytest.mark.slow)])
def test_free_unknowns_and_tied_words_are_those_of_the_null_spaces(stride):
    for letters, (_, rest) in list(g111_rows().items())[::stride]:
        free, tied = free_and_tied(letters - ignored(letters))
        parts = {part.partition(": ")[0]: part.partition(": ")[2] for part in rest.split("; ")}
        said = set()
        for point in ("V1", "V2"):
            text = parts.get("free", "").partition(f"{point} (")[2].partition(")")[0]
            said |= {point + axis.lower() for axis in ("Z", "X") if axis in text}
        assert said == free, (sorted(letters), rest)
        assert set(parts.get("tied", "").replace(",", "").split()) == tied, (sorted(letters), rest)


def test_condition_is_zero_exactly_where_the_equations_are_singular():
    names = {"sin": sin, "cos": cos}
    for letters, (_, rest) in g111_rows().items():
        if not rest.startswith("determined"):
            continue
        condition = rest.partition("unless ")[2].removesuffix(" = 0") or "1"
        rows = letters - ignored(letters)
        for seed in (1, 2, 3):
            a, b = (radians(angle) for angle in numpy.random.default_rng(seed).uniform(5, 85, 2))
            value = abs(eval(condition, {"__builtins__": {}}, {**names, "A": a, "B": b}))
            assert value == pytest.approx(abs(numpy.linalg.det(matrix(rows, seed))), abs=1e-12), sorted(letters)


# What solve says of the sets of G111 ---------------------------------------------------------------------

WORDS = ["A160.", "B120.", "C2.", "D2.", "I10.919", "K-30.", "P3.", "Q3.", "U61.838", "W-41.547", "X101.838"]
WORDS += ["Z-41.547"]
V1, V2 = (-30.0, 30.919), (-41.547, 50.919)
AGREE = 2e-3
"""mm. The words are rounded to 0.001 mm."""

SETS = [frozenset(chosen) for size in range(13) for chosen in combinations(LETTERS, size)]


def geometry(letters: frozenset[str]) -> str:
    """The status that the equations alone give a set."""
    count = len(letters & set(EQUATIONS))
    if letters >= set("CP") or letters >= set("DQ"):
        return "conflicting"  # two shapes for one corner
    if not count or ranks(letters) < 4:
        return "underdetermined"
    end_x, end_z = letters & set("XU"), letters & set("ZW")
    if letters & set("DQ") and bool(end_x) == bool(end_z):
        return "underdetermined"  # no line to land on
    if count > 4:
        return "overdetermined"
    # 135 deg does not lie between 120 and 90 deg: no 45 deg segment joins line 2 and a line parallel to X.
    return "no-solution" if "D" in letters and end_z else "solved"


@pytest.fixture(scope="module", params=["some", pytest.param("many", marks=pytest.mark.slow)])
def answers(request) -> dict[tuple[str, frozenset[str]], Answer]:
    """By policy and set: of those that are legal all or some, of all others a sixth or a few."""
    step = 6 if request.param == "many" else 50
    some = [*[letters for letters in SETS if is_legal(letters)][:: step // 7 + 1], *SETS[::step]]
    found = {}
    for rules in ("enforce", "warn", "off"):
        asked = some if rules == "enforce" else some[::2]
        for letters in asked:
            block = " ".join(("G111", *(word for word in WORDS if word[0] in letters)))
            (answer,) = solve(block, control="yasnac-lx3", start="X40. Z0.", rules=rules, depth="verdict").answers
            found[rules, letters] = answer
    return found


def statuses(answers, rules):
    return {letters: answer.status.value for (own, letters), answer in answers.items() if own == rules}


def test_a_set_is_rejected_exactly_when_the_sheet_refuses_it_and_else_has_the_status_of_the_words_that_are_used(
    answers,
):
    for letters, status in statuses(answers, "enforce").items():
        assert status == (geometry(letters - ignored(letters)) if is_legal(letters) else "rejected"), sorted(letters)


def test_without_rules_a_set_has_the_status_of_the_geometry(answers):
    for letters, status in statuses(answers, "off").items():
        assert status == geometry(letters), sorted(letters)


def test_rules_as_warnings_refuse_nothing_and_keep_the_refusal(answers):
    for letters, status in statuses(answers, "warn").items():
        found = answers["warn", letters].diagnostics
        strict = {each.code for each in answers["enforce", letters].diagnostics if each.basis.value == "rule"}
        assert status != "rejected"
        assert strict <= {each.code for each in found}
        assert not any(each.severity.value == "error" and each.basis.value == "rule" for each in found)


def test_every_set_that_is_solved_gives_the_same_two_points_and_an_error_is_found_exactly_without_them(answers):
    for (_, letters), answer in answers.items():
        assert (answer.contour is None) == any(each.is_error for each in answer.diagnostics), sorted(letters)
        if answer.contour:
            found = chain(answer.contour.points["V1"], answer.contour.points["V2"])
            assert list(found) == pytest.approx([*V1, *V2], abs=AGREE)
