"""Facts as text: what can be read, where a mistake is marked, and that no text at all ends in a traceback."""

import re

import pytest
from click.testing import CliRunner

from contoursolve import check
from contoursolve.cli import main
from contoursolve.geometry import Length, Plane, Vocabulary, read_statement
from contoursolve.output import vocabulary_lines

LATHE = Vocabulary(
    ("line 1", "line 2", "line 3", "corner 1", "corner 2", "arc", "line"),
    ("S", "V1", "V2"),
    Plane("G18", ("Z", "X"), ("K", "I"), (False, True)),
    Length.MM,
)
START = "X40. Z0."
WHOLE = "G111 A180. K-30. B120. X100. P5. Q5."

EXAMPLES = [match[1] for line in vocabulary_lines() if (match := re.match(r"  (\S.*?)  +\S", line))]
"""The left column of `contoursolve facts`."""


# What can be read -----------------------------------------------------------------------------------------


def test_the_examples_are_found() -> None:
    assert len(EXAMPLES) >= 23
    assert {"length of line 1 = 30", "line tangent to arc"} <= {*EXAMPLES}


@pytest.mark.parametrize("fact", EXAMPLES)
def test_every_example_of_the_vocabulary_can_be_read(fact: str) -> None:
    found = read_statement(fact, LATHE)
    for other in (
        fact.replace("(", "[").replace(")", "]"),
        fact.replace("(", "").replace(")", ""),
        fact.upper(),
        f"  {fact.replace(' ', '   ')} ",
    ):
        assert read_statement(other, LATHE) == found, other


# Mistakes, and where they are marked ----------------------------------------------------------------------


def test_the_listing_underlines_a_fact_that_is_stated_apart() -> None:
    arguments = ["solve", "--block", WHOLE, "--start", START, "--fact", "length of line 1 = 2O"]
    done = CliRunner().invoke(main, arguments)
    lines = done.output.splitlines()
    (place,) = [number for number, line in enumerate(lines) if line.endswith("| length of line 1 = 2O")]
    assert done.exit_code == 1
    assert lines[place + 1].index("^^") == lines[place].index("2O")


NOT_ROUND, NO_LINE = "line 1 is not round", "corner 1 is not a line"
IMPOSSIBLE = [
    ("radius of line 1 = 3", NOT_ROUND),
    ("Z of center of line 1 = 3", NOT_ROUND),
    ("chord of line 1 = 3", NOT_ROUND),
    ("polar angle of line 1 = 3", NOT_ROUND),
    ("straight part of corner 1 = 3", NO_LINE),
    ("direction of corner 1 = 3", NO_LINE),
    ("length of line 1 = length of corner 1", NO_LINE),
    ("line 1 parallel to corner 1", NO_LINE),
    ("angle from line 1 to corner 1 = 3", "line 1 and corner 1 are not neighbours"),
    ("line 1 tangent to line 1", "two lines cannot be tangent unless they are neighbours"),
    ("line 1 tangent to line [Z0 X0 A45]", "two lines cannot be tangent unless they are neighbours"),
    ("line 1 meets line at 4", "line 1 is no last corner"),
    ("corner 1 meets line at 4", "corner 1 is no last corner"),
    ("corner 2 meets next line", "there is no next block with a line whose end is known"),
    ("length of corner 1 = 3", "the length of corner 1 depends on its sense; state the angle between its lines"),
    pytest.param("chord of corner 1 = 0", "a chord is larger than 0, not 0", marks=pytest.mark.boundary),
    ("line 1 passes beside [Z0 X0] at -1", "a distance is not negative, as -1 is"),
    ("line 1 parallel to line 2 at -1", "a distance is not negative, as -1 is"),
    ("line 1 parallel to line 1", "line 1 is one line, and parallel to itself"),
    ("line 1 parallel to line 2 at 1", "line 1 and line 2 meet in V1, so that there is no distance between them"),
]


@pytest.mark.parametrize(("fact", "reason"), IMPOSSIBLE)
def test_a_fact_that_makes_no_sense_is_impossible_and_named_as_a_whole(fact: str, reason: str) -> None:
    block = f"{WHOLE} (contoursolve: {fact})"
    (found,) = [each for each in check(block, start=START) if each.code.startswith("fact-")]
    assert (found.code, found.message) == ("fact-impossible", f"{fact} says nothing about this contour: {reason}")
    assert block[found.span.column - 1 : found.span.end_column - 1] == fact


def test_a_line_that_a_corner_meets_can_be_stated_once() -> None:
    found = check(WHOLE, start=START, facts=["corner 2 meets line at 180", "corner 2 meets line at 170"])
    assert [each.code for each in found] == ["fact-impossible"]


def test_round_brackets_in_a_comment_are_refused_with_the_hint_that_square_ones_work() -> None:
    found = check(f"{WHOLE} (contoursolve: line 2 passes through (Z-40. X80.))", start=START)
    (unreadable,) = [each for each in found if each.code == "fact-unreadable"]
    assert unreadable.message.endswith("inside a comment write [ ] for ( )")
