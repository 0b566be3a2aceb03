"""Repairs that only drop words, against a search through all sets of words to drop."""

import random
from itertools import combinations
from typing import Any

import numpy
import pytest

from contoursolve import Status, solve

START = "X40. Z0."
WORDS = {
    "A": "A160.",
    "I": "I10.919",
    "K": "K-30.",
    "B": "B120.",
    "X": "X100.",
    "U": "U60.",
    "Z": "Z-41.016",
    "W": "W-41.016",
    "C": "C2.",
    "P": "P3.",
    "D": "D2.",
    "Q": "Q3.",
    "M": "M08",
}


def is_clean(words: list[str]) -> bool:
    """Solved without an error or a warning."""
    answers = solve(f"G111 {' '.join(words)}", start=START, depth="verdict")
    return answers.answers[0].status is Status.SOLVED and not answers.diagnostics


def drops_by_search(words: list[str]) -> set[frozenset[str]]:
    """All smallest sets of up to four words whose dropping leaves a clean block."""
    found: list[frozenset[str]] = []
    for size in range(1, 5):
        for dropped in map(frozenset, combinations(words, size)):
            if not any(other < dropped for other in found) and is_clean(
                [word for word in words if word not in dropped]
            ):
                found.append(dropped)
    return set(found)


def drops_offered(words: list[str]) -> set[frozenset[str]]:
    """The sets of words that the fixes drop, of those that only drop."""
    result = solve(f"G111 {' '.join(words)}", start=START)
    fixes = [fix.replacement.split()[1:] for finding in result.diagnostics for fix in finding.fixes]
    return {frozenset(words) - frozenset(kept) for kept in fixes if set(kept) < set(words)}


def test_fixes_that_drop_words_are_exactly_the_smallest_that_work() -> None:
    draw = random.Random(20)
    compared = 0
    while compared < 60:
        words = draw.sample(list(WORDS.values()), draw.randint(5, 8))
        answer = solve(f"G111 {' '.join(words)}", start=START, depth="verdict").answers[0]
        is_about_words = answer.status is Status.REJECTED or any(
            each.code.endswith("ignored") for each in answer.diagnostics
        )
        wanted = drops_by_search(words) if is_about_words else set()
        if wanted:
            compared += 1
            assert drops_offered(words) == wanted, words


OUTLINE = """G17 G90 G0 X0 Y0
G1 X20 Y0 ,R2 F200
X30 Y10 ,R2
X40 Y0 ,R2
X60 Y0 ,R2
X60 Y20 ,R30
X50 Y30 ,R2
X60 Y40 ,R2
X0 Y40 ,R2
X-10 Y20 ,R2
X0 Y0"""
"""Ten elements, of which two do not fit."""


def zigzag(length: int, **changed: str) -> str:
    """A chain of lines with a rounding between each two, some of them written otherwise: `line_3="X60 ,R2"`."""
    lines = [f"X{20 * number} Y{10 * (number % 2)} ,R2" for number in range(1, length)]
    lines.append(f"X{20 * length} Y{10 * (length % 2)}")
    for name, text in changed.items():
        lines[int(name.removeprefix("line_")) - 1] = text
    return "\n".join(["G17 G90 G0 X0 Y0", f"G1 {lines[0]}", *lines[1:]])


@pytest.fixture
def decompositions(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The sizes of all matrices that are decomposed."""
    sizes: list[int] = []
    original = numpy.linalg.svd

    def counted(matrix: numpy.ndarray, *args: Any, **kwargs: Any) -> Any:
        sizes.append(max(matrix.shape[-2:]))
        return original(matrix, *args, **kwargs)

    monkeypatch.setattr(numpy.linalg, "svd", counted)
    return sizes


def test_decompositions_grow_with_the_number_of_lines_and_not_with_that_of_their_subsets(decompositions):
    counts = []
    for length in (8, 16, 32):
        decompositions.clear()
        solve(zigzag(length, line_4="X80 ,R2"), control="nct-99m")
        counts.append(len(decompositions))
        assert max(decompositions) <= 4
    assert counts[2] <= 4 * counts[0] + 8, counts
