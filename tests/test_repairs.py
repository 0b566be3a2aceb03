"""Repairs that only drop words, against a search through all sets of words to drop."""

import random
from itertools import combinations

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
