"""All 4,096 sets of the twelve letters of G111, held against a second statement of the control's sheet.

The values of the words agree with each other, so that the status of each set follows from the set alone.
"""

from itertools import chain, combinations
from math import cos, radians, sin

import numpy as np
import pytest

from contoursolve import Result, solve

START = "X40. Z0."
WORDS = {
    "A": "A160.",
    "B": "B120.",
    "C": "C2.",
    "D": "D2.",
    "I": "I10.919",
    "K": "K-30.",
    "P": "P3.",
    "Q": "Q3.",
    "U": "U61.838",
    "W": "W-41.547",
    "X": "X101.838",
    "Z": "Z-41.547",
}
V1, V2 = (-30.0, 30.919), (-41.547, 50.919)
AGREE = 2e-3
"""mm. The words are rounded to 0.001 mm."""

LETTERS = tuple(WORDS)
SETS = [frozenset(chosen) for size in range(13) for chosen in combinations(LETTERS, size)]

A, B = radians(160), radians(120)
ROWS = {
    # Derivatives of what a word states by (V1 z, V1 x, V2 z, V2 x), written out by hand.
    "A": (sin(A), -cos(A), 0, 0),
    "I": (0, 1, 0, 0),
    "K": (1, 0, 0, 0),
    "B": (-sin(B), cos(B), sin(B), -cos(B)),
    "X": (0, 0, 0, 1),
    "U": (0, 0, 0, 1),
    "Z": (0, 0, 1, 0),
    "W": (0, 0, 1, 0),
}


def refuses(letters: frozenset[str]) -> bool:
    """Table 2.34 and supplementary notes i, iii, iv, v, vi of section 2.8.30, sentence by sentence."""
    end_x, end_z = letters & set("XU"), letters & set("ZW")
    line_1, line_2 = len(letters & set("AIK")), bool("B" in letters) + bool(end_x) + bool(end_z)
    if line_2 < 2 or len(end_x) == 2 or len(end_z) == 2:  # "Specify two"; "X and U, Z and W not permitted"
        return True
    if line_1 < (1 if line_2 == 3 else 2):  # "Specify two"; note i: one is enough with B, X(U) and Z(W)
        return True
    if letters >= set("CP") or letters >= set("DQ"):  # "Specify either"; note iv: across is fine
        return True
    return bool(end_x and end_z and letters & set("DQ"))  # note iii, and i and vi as they follow from it


def used(letters: frozenset[str]) -> frozenset[str]:
    """What the control works with: without A by note v, without B by note vi."""
    line_1, line_2 = letters & set("AIK"), bool("B" in letters) + bool(letters & set("XU")) + bool(letters & set("ZW"))
    ignored = set("A" if len(line_1) == 3 else "") | set("B" if line_2 == 3 and len(line_1) >= 2 else "")
    return letters - ignored


def geometry(letters: frozenset[str]) -> str:
    """The status that the equations alone give a set."""
    facts = [ROWS[letter] for letter in sorted(letters & ROWS.keys())]
    if letters >= set("CP") or letters >= set("DQ"):
        return "conflicting"  # two shapes for one corner
    if not facts or np.linalg.matrix_rank(np.array(facts, float)) < 4:
        return "underdetermined"
    has_second_corner, end_x, end_z = letters & set("DQ"), letters & set("XU"), letters & set("ZW")
    if has_second_corner and bool(end_x) == bool(end_z):
        return "underdetermined"  # no line to land on
    if len(facts) > 4:
        return "overdetermined"
    # 135 deg does not lie between 120 and 90 deg: no 45 deg segment joins line 2 and a line parallel to X.
    return "no-solution" if "D" in letters and end_z else "solved"


def block(letters: frozenset[str]) -> str:
    return " ".join(("G111", *(WORDS[letter] for letter in LETTERS if letter in letters)))


@pytest.fixture(scope="module", params=["some", pytest.param("a quarter", marks=pytest.mark.slow)])
def results(request) -> dict[tuple[str, frozenset[str]], Result]:
    legal = [letters for letters in SETS if not refuses(letters)]
    some = [*legal[::6], *SETS[::50]]
    return {
        (rules, letters): solve(block(letters), control="yasnac-lx3", start=START, rules=rules, depth="verdict")
        for rules in ("enforce", "warn", "off")
        for letters in (SETS[::4] if request.param == "a quarter" else some)
    }


def statuses(results, rules):
    return {letters: result.answers[0].status.value for (own, letters), result in results.items() if own == rules}


def differences(found, expected):
    return {
        block(letters): f"{status}, expected {expected(letters)}"
        for letters, status in found.items()
        if status != expected(letters)
    }


def test_276_of_4096_sets_are_legal():
    assert len(SETS) == 4096
    assert sum(not refuses(letters) for letters in SETS) == 276


@pytest.mark.slow
def test_every_set_has_one_contour_with_a_status(results):
    assert all(len(result.answers) == 1 for result in results.values())


def test_a_set_is_rejected_exactly_when_the_sheet_refuses_it(results):
    found = statuses(results, "enforce")
    assert {block(each) for each in found if found[each] == "rejected"} == {
        block(each) for each in found if refuses(each)
    }


def test_a_legal_set_has_the_status_of_the_words_that_the_control_uses(results):
    found = statuses(results, "enforce")
    legal = {letters: status for letters, status in found.items() if not refuses(letters)}
    assert differences(legal, lambda letters: geometry(used(letters))) == {}
    assert len(legal) >= 46


def test_without_rules_a_set_has_the_status_of_the_geometry(results):
    assert differences(statuses(results, "off"), geometry) == {}


def test_rules_as_warnings_refuse_nothing_and_keep_the_refusal(results):
    for letters in statuses(results, "warn"):
        result = results["warn", letters]
        strict = {each.code for each in results["enforce", letters].diagnostics if each.basis.value == "rule"}
        assert result.answers[0].status.value != "rejected"
        assert strict <= {each.code for each in result.diagnostics}
        assert not any(each.severity.value == "error" and each.basis.value == "rule" for each in result.diagnostics)


def test_every_set_that_is_solved_gives_the_same_two_points(results):
    for result in results.values():
        contour = result.answers[0].contour
        if contour:
            assert list(chain(contour.points["V1"], contour.points["V2"])) == pytest.approx([*V1, *V2], abs=AGREE)


def test_an_error_is_found_exactly_when_there_is_no_contour(results):
    for (_, letters), result in results.items():
        assert result.has_errors == (result.answers[0].contour is None), block(letters)
