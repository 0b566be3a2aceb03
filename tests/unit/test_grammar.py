"""Facts as text: what can be read, where a mistake is marked, and that no text at all ends in a traceback."""

import json
import re
from collections.abc import Sequence
from typing import Any

import pytest
from click.testing import CliRunner
from examples import law
from hypothesis import strategies as st

from contoursolve import solve
from contoursolve.cli import main
from contoursolve.geometry import GrammarError, Length, Plane, Vocabulary, read_statement
from contoursolve.output.catalogue import vocabulary_lines

LATHE = Vocabulary(
    ("line 1", "line 2", "line 3", "corner 1", "corner 2", "arc", "line"),
    ("S", "V1", "V2"),
    Plane("G18", ("Z", "X"), ("K", "I"), (False, True)),
    Length.MM,
)
START = ("--start", "X40. Z0.")
WHOLE = "G111 A180. K-30. B120. X100. P5. Q5."
MILL = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"

EXAMPLES = [match[1] for line in vocabulary_lines() if (match := re.match(r"  (\S.*?)  +\S", line))]
"""The left column of `contoursolve facts`."""


def run(*arguments: str) -> tuple[int, str, str]:
    done = CliRunner().invoke(main, list(arguments))
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    assert "Traceback" not in done.output
    return done.exit_code, done.stdout, done.stderr


def findings(block: str, *facts: str) -> list[dict[str, Any]]:
    options = [part for fact in facts for part in ("--fact", fact)]
    _, output, _ = run("solve", "--block", block, *START, *options, "--format", "json")
    return list(json.loads(output)["diagnostics"])


# What can be read -----------------------------------------------------------------------------------------


def test_the_examples_are_found() -> None:
    assert len(EXAMPLES) >= 23
    assert "length of line 1 = 30" in EXAMPLES
    assert "line tangent to arc" in EXAMPLES


@pytest.mark.parametrize("fact", EXAMPLES)
def test_every_example_of_the_vocabulary_can_be_read(fact: str) -> None:
    assert read_statement(fact, LATHE)
    assert read_statement(fact.replace("(", "[").replace(")", "]"), LATHE)


def test_the_listing_itself_shows_a_block_that_is_solved() -> None:
    (block,) = [line.strip() for line in vocabulary_lines() if "G111" in line and "contoursolve:" in line]
    assert run("solve", "--block", block, *START)[0] == 0


@pytest.mark.parametrize(
    ("fact", "other"),
    [
        ("length of line 1 = 30", "LENGTH OF LINE 1 = 30"),
        ("length of line 1 = 30", "  Length   of line  1=30  "),
        ("length of line 1 = 30", "length of line 1 = 30."),
        ("length of line 1 = 30", "length of line 1 = +30.000"),
        ("length of line 1 = 30", "length of line 1 = 3e1"),
        ("length of line 1 = 0.5", "length of line 1 = .5"),
        ("radius of corner 1 = 5", "size of corner 1 = 5"),
        ("radius of corner 1 = 5", "radius of CORNER 1 = 5"),
        ("Z of begin of corner 1 = -3", "z of start of corner 1 = -3"),
        ("Z of center of corner 1 = -3", "Z of centre of corner 1 = -3"),
        ("line 2 passes through (Z-40. X80.)", "line 2 passes through (X80 Z-40)"),
        ("line 2 passes through (Z-40. X80.)", "line 2 passes through [Z-40 X80]"),
        ("line 2 passes through (Z-40. X80.)", "line 2 passes through Z-40 X80"),
        ("line 2 passes through (Z-40. X80.)", "line 2 through (Z -40, X 80)"),
        ("line 2 passes beside (Z-40. X80.) at 5", "line 2 passes [Z-40 X80] at 5.0"),
        ("line 2 passes beside (Z-40. X80.) at 5", "LINE 2 Passes Beside x80 z-40 AT +5"),
        ("line 2 parallel to line 1", "line 2 is parallel to line 1 "),
        ("line 2 parallel to line 1 at 10", "line 2  is  parallel to line 1  at 1e1"),
        ("polar angle of arc = 90", "polar angle of end of arc = 90."),
        ("polar angle of begin of arc = 90", "Polar Angle of start of arc=90"),
        ("line 2 tangent to circle (Z-40. X120. R10.)", "line 2 is tangent to circle Z-40 X120 R10"),
        ("corner 1 tangent to line (Z0. X30. A180.)", "corner 1 tangent to line [x30 z0 a180]"),
        ("corner 2 meets line to (Z-60. X130.)", "corner 2 MEETS LINE TO Z-60 X130"),
        ("length of line 1 = ?", "length of line 1=?"),
    ],
)
def test_spelling_does_not_change_the_meaning(fact: str, other: str) -> None:
    assert read_statement(other, LATHE) == read_statement(fact, LATHE)


def test_numbers_without_a_point_mean_what_they_say_though_words_count_increments() -> None:
    block = "G111 A180000 B120000 X100000"
    asked = solve(block, start="X40. Z0.", facts=["length of line 1 = 30", "Z of V1 = ?"]).answers[0].answers
    assert [each.value for each in asked] == [pytest.approx(-30)]


def test_a_coordinate_of_a_diameter_axis_is_a_diameter_and_lengths_are_in_the_unit_of_the_program() -> None:
    block, facts = (
        "G111 A180. B120. X4.",
        ["X of V2 = 4", "length of line 1 = 2", "Z of V1 = ?", "length of line 2 = ?"],
    )
    (answer,) = solve(block, start="X2. Z0.", units="inch", facts=facts).answers
    assert answer.status.value == "overdetermined"
    assert sorted(float(each.value or 0) for each in answer.answers) == pytest.approx([-50.8, 25.4 / 0.75**0.5])


def test_several_facts_in_a_comment_are_separated_by_semicolons() -> None:
    block = "G111 A180. B120. (contoursolve: X of V2 = 100; ; length of line 1 = 30 ;radius of corner 1 = ?) P5. (P9.)"
    (answer,) = solve(block, start="X40. Z0.").answers
    assert answer.status.value == "solved"
    assert [each.text for each in answer.claim.directives] == [
        "X of V2 = 100",
        "length of line 1 = 30",
        "radius of corner 1 = ?",
    ]


@pytest.mark.parametrize(
    "comment",
    [
        "; contoursolve: line 2 passes through (X10 Y17.321); length of line 3 = 59.282",
        "; (contoursolve: line 2 passes through [X10 Y17.321]; length of line 3 = 59.282)",
    ],
)
def test_comments_behind_a_semicolon_state_facts_with_parentheses_and_without(comment: str) -> None:
    blocks = (f"2 FL AN+60 {comment}", "3 FL X+80 Y+20 AN-30", "4 END PGM A MM")
    (answer,) = solve("\n".join(("0 BEGIN PGM A MM", "1 L X+0 Y+0", *blocks))).answers
    assert answer.status.value == "overdetermined"
    assert answer.claim.directives[0].text.startswith("line 2 passes through")
    assert answer.claim.directives[1].text == "length of line 3 = 59.282"


@pytest.mark.parametrize(
    "comment", ["(contoursolve)", "(contour solve: x)", "(see contoursolve: x)", "; contoursolve: x"]
)
def test_other_comments_state_nothing(comment: str) -> None:
    (answer,) = solve(f"{WHOLE} {comment}", start="X40. Z0.").answers
    assert answer.claim.directives == ()
    assert answer.status.value == "solved"


# Mistakes, and where they are marked ----------------------------------------------------------------------

MISTAKES = [
    ("length of line 9 = 20", "line 9", "(line 1, line 2, corner 1, corner 2)"),
    ("lenght of line 1 = 20", "lenght", "(line 1, line 2, corner 1, corner 2)"),
    ("length of line 1 = 2O", "2O", "a number"),
    ("length of line 1 = 1.2.3", "1.2.3", "a number"),
    ("length of line 1 = 5mm", "5mm", "a number"),
    ("length of line 1 = 20 mm", "mm", "the end of the fact"),
    ("length of line 1 = ? ?", "?", "the end of the fact"),
    ("length of line 1 : 20", ":", "`=`"),
    ("length line 1 = 20", "length", "an element"),
    ("X of V3 = 20", "V3", "(S, V1, V2)"),
    ("Y of V1 = 20", "Y", "an element"),
    ("line 1 passes through [Z-40.]", "]", "a place such as"),
    ("line 1 passes through [Z-40. X3. ", "", "`]`"),
    ("line 1 passes through Z-40. Z3.", "Z3.", "a place such as"),
    ("line 1 tangent to circle [Z0 X0]", "]", "`R` and a number"),
    ("corner 1 tangent to line [Z0 X0]", "]", "`A` and a number"),
    ("line 1 tangent to Z0 X0 R5", "Z0", "an element, `circle (...)` or `line (...)`"),
    ("line 1 passes [Z0 X0]", "", "`at` and a distance"),
    ("line 1 passes beside [Z0 X0] at", "", "a number"),
    ("line 1 parallel line 2", "parallel", "`parallel to`"),
    ("line 1 parallel to line 2 by 3", "by", "`at` and a distance"),
    ("line 1 parallel to line 2 at X3", "X3", "a number"),
    ("chord of line 1 = length of line 1", "length of line 1", "only two lengths or two radii"),
    ("polar angle of center of corner 1 = 3", "center", "`begin of` or `end of`"),
    ("line 1 touches line 2", "touches", "`tangent to`"),
    ("corner 2 meets line", "line", "`next line`"),
    ("angle from line 1 line 2 = 20", "line", "`to`"),
    ("length of line 1 = straight part of line 2", "straight part of line 2", "only two lengths or two radii"),
    ("radius of corner 1 = length of line 2", "length of line 2", "only two lengths or two radii"),
]


@pytest.mark.parametrize(("fact", "marked", "expected"), MISTAKES)
def test_a_mistake_is_marked_where_it_is(fact: str, marked: str, expected: str) -> None:
    with pytest.raises(GrammarError) as caught:
        read_statement(fact, Vocabulary(("line 1", "line 2", "corner 1", "corner 2"), *_rest()))
    error = caught.value
    assert expected in str(error)
    assert fact[error.begin : error.end].strip() == marked
    assert (f"`{marked}`" if marked else "the end") in str(error) or "only two" in str(error)


def _rest() -> tuple[Any, ...]:
    return LATHE.points, LATHE.plane, LATHE.unit


MARKED = [case for case in MISTAKES if case[1]]


@pytest.mark.parametrize(("fact", "marked", "expected"), MARKED)
def test_the_columns_of_a_finding_underline_the_mistake_inside_the_comment(
    fact: str, marked: str, expected: str
) -> None:
    block = f"G111 A180. K-30. B120. X100. P5. Q5. (contoursolve: X of V1 = 40 ;  {fact};X of V1 = 40)"
    (found,) = [each for each in findings(block) if each["code"] == "fact-unreadable"]
    assert expected in found["message"]
    assert found["line"] == 1
    assert block[found["column"] - 1 : found["end_column"] - 1] == marked
    assert found["column"] > block.index(fact)


@pytest.mark.parametrize(("fact", "marked", "expected"), MARKED)
def test_a_fact_apart_from_the_program_has_columns_of_its_own(fact: str, marked: str, expected: str) -> None:
    (found,) = [each for each in findings(WHOLE, "X of V1 = 40", fact) if each["code"] == "fact-unreadable"]
    assert (found["line"], found["fact"]["number"]) == (1, 2)
    assert fact[found["fact"]["column"] - 1 : found["fact"]["end_column"] - 1] == marked


def test_the_listing_underlines_a_fact_that_is_stated_apart() -> None:
    status, output, _ = run("solve", "--block", WHOLE, *START, "--fact", "length of line 1 = 2O")
    lines = output.splitlines()
    (place,) = [number for number, line in enumerate(lines) if line.endswith("| length of line 1 = 2O")]
    assert status == 1
    assert lines[place + 1].index("^^") == lines[place].index("2O")


IMPOSSIBLE = [
    ("radius of line 1 = 3", "line 1 is not round"),
    ("Z of center of line 1 = 3", "line 1 is not round"),
    ("straight part of corner 1 = 3", "corner 1 is not a line"),
    ("direction of corner 1 = 3", "corner 1 is not a line"),
    ("angle from line 1 to corner 1 = 3", "not neighbours"),
    ("line 1 tangent to line 1", "two lines cannot be tangent"),
    ("line 1 tangent to line [Z0 X0 A45]", "two lines cannot be tangent"),
    ("length of line 1 = length of corner 1", "corner 1 is not a line"),
    ("line 1 meets line at 4", "line 1 is no last corner"),
    ("corner 1 meets line at 4", "corner 1 is no last corner"),
    ("corner 2 meets next line", "no next block"),
    ("length of corner 1 = 3", "state the angle between its lines"),
    ("chord of line 1 = 3", "line 1 is not round"),
    ("chord of corner 1 = 0", "a chord is larger than 0"),
    ("polar angle of line 1 = 3", "line 1 is not round"),
    ("line 1 passes beside [Z0 X0] at -1", "a distance is not negative"),
    ("line 1 parallel to corner 1", "corner 1 is not a line"),
    ("line 1 parallel to line 1", "parallel to itself"),
    ("line 1 parallel to line 2 at -1", "a distance is not negative"),
    ("line 1 parallel to line 2 at 1", "meet in V1"),
]


@pytest.mark.parametrize(("fact", "reason"), IMPOSSIBLE)
def test_a_fact_that_makes_no_sense_is_impossible_and_named_as_a_whole(fact: str, reason: str) -> None:
    block = f"{WHOLE} (contoursolve: {fact})"
    (found,) = [each for each in findings(block) if each["code"].startswith("fact-")]
    assert found["code"] == "fact-impossible"
    assert fact in found["message"]
    assert reason in found["message"]
    assert block[found["column"] - 1 : found["end_column"] - 1] == fact


def test_a_line_that_a_corner_meets_can_be_stated_once() -> None:
    codes = [each["code"] for each in findings(WHOLE, "corner 2 meets line at 180", "corner 2 meets line at 170")]
    assert codes == ["fact-impossible"]


# Any text at all ------------------------------------------------------------------------------------------

PHRASES = [
    "length of",
    "straight part of",
    "direction of",
    "radius of",
    "angle from",
    "to",
    "Z of",
    "X of",
    "begin of",
    "end of",
    "center of",
    "line 1",
    "line 2",
    "corner 1",
    "corner 2",
    "V1",
    "V2",
    "S",
    "arc",
    "line",
    "passes through",
    "tangent to",
    "meets",
    "next line",
    "line at",
    "line to",
    "circle",
    "=",
    "= ?",
    "= 30",
    "= -60",
    "= 0",
    "= 1e9",
    "(Z-40. X80.)",
    "(Z-40. X120. R10.)",
    "[Z0 X30 A180]",
    "?",
    ";",
    "R",
    "A",
    ",",
    "(",
    ")",
    "[",
    "]",
    "#1",
    "1e999",
    "\t",
    "\x00",
]
PIECES = st.sampled_from((*PHRASES, "9" * 50, "\N{FULLWIDTH DIGIT ONE}"))
SENSIBLE = st.sampled_from([fact for fact in EXAMPLES if not fact.startswith("line tangent")])
NUMBERS = st.sampled_from(("0", "-5", "1e-9", "0.001", "30", "29.999999", "1000", "1e6", "180", "-360", "?"))


@st.composite
def fact_texts(draw: st.DrawFn) -> str:
    if draw(st.booleans()):
        return " ".join(draw(st.lists(PIECES, max_size=8)))
    text = draw(SENSIBLE)
    return re.sub(r"= [-\d.]+$", lambda _: f"= {draw(NUMBERS)}", text)


def answered(arguments: Sequence[str]) -> None:
    """An answer with an exit status of its own, no traceback, and the same bytes twice."""
    first = run(*arguments)
    assert first[0] in (0, 1, 2)
    assert run(*arguments) == first


@law(st.text(max_size=40) | fact_texts(), few=2, many=8)
def test_any_text_is_a_statement_or_a_grammar_error(text: str) -> None:
    found = None
    try:
        read_statement(text, LATHE)
    except GrammarError as error:
        found = error
    assert found is None or 0 <= found.begin <= len(text)
    assert found is None or found.begin < found.end


FREE = ("G111 A180. B120. X100. P5. Q5.", "G111 A180. K-30. B120. P? Q5.", WHOLE, "G111 A180. K-30. B120. X100. C? D2.")
"""Every line has its direction, so that solving takes steps in closed form."""


@law(st.sampled_from(FREE), st.lists(fact_texts(), min_size=1, max_size=2), st.booleans(), few=2)
def test_any_fact_about_a_block_is_answered(block: str, facts: list[str], is_comment: bool) -> None:
    if is_comment:
        arguments = ["--block", f"{block} (contoursolve: {'; '.join(facts)})"]
    else:
        arguments = ["--block", block, *(part for fact in facts for part in ("--fact", fact))]
    answered(["solve", *arguments, *START])


ASKABLE = [
    "A180.",
    "K-30.",
    "I0.",
    "B120.",
    "X100.",
    "U60.",
    "Z-47.32",
    "W-47.32",
    "C2.",
    "P2.",
    "D2.",
    "Q2.",
    "F.2",
    "G0",
]
MILL_WORDS = [re.findall(r",?[A-Z]-?[\d.]+", line) for line in MILL.splitlines()]


def asked(word: str) -> str:
    return re.sub(r"[-\d.]+$", "?", word)


@law(
    st.lists(st.sampled_from(ASKABLE), min_size=1, max_size=12, unique=True),
    st.randoms(use_true_random=False),
    examples=[(list(ASKABLE[:12]), None)],
    few=2,
)
def test_a_question_mark_may_stand_in_any_word_of_a_taper(words: list[str], rng: Any) -> None:
    texts = [asked(word) if rng is None or rng.random() < 0.4 else word for word in words]
    answered(["solve", "--block", " ".join(("G111", *texts)), *START, "--control", "yasnac-lx3"])


@law(st.randoms(use_true_random=False))
def test_a_question_mark_may_stand_in_any_word_of_a_pair(rng: Any) -> None:
    kept = [[word for word in words if rng.random() < 0.9] for words in MILL_WORDS]
    lines = [" ".join(asked(word) if rng.random() < 0.25 else word for word in words) for words in kept]
    answered(["solve", *(part for line in lines for part in ("--block", line)), "--control", "nct-99m"])


@pytest.mark.parametrize(
    ("comment", "written"),
    [
        ("(contoursolve length of line 1 = 5)", "(contoursolve: length of line 1 = 5)"),
        ("(Contour-Solve: X of V1 = 40)", "(contoursolve: X of V1 = 40)"),
        ("(contoursolver = line 1 passes through [Z-1. X40.])", "(contoursolve: line 1 passes through [Z-1. X40.])"),
        (";contoursolve: length of line 1 = 5", "(contoursolve: length of line 1 = 5)"),
    ],
)
def test_a_comment_that_is_almost_a_fact_is_warned_about_with_what_to_write(comment: str, written: str) -> None:
    (found,) = [each for each in findings(f"{WHOLE} {comment}") if each["code"] == "fact-unmarked"]
    assert found["severity"] == "warning"
    assert found["help"] == f"write {written}"


@pytest.mark.parametrize("comment", ["(CONTOUR: OUTSIDE)", "(contoursolve 1.0)", "(made by contoursolve: A = B)"])
def test_comments_that_only_mention_a_contour_are_comments(comment: str) -> None:
    assert findings(f"{WHOLE} {comment}") == []


def test_round_brackets_in_a_comment_are_refused_with_the_hint_that_square_ones_work() -> None:
    found = findings(f"{WHOLE} (contoursolve: line 2 passes through (Z-40. X80.))")
    (unreadable,) = [each for each in found if each["code"] == "fact-unreadable"]
    assert unreadable["message"].endswith("inside a comment write [ ] for ( )")


def test_an_element_that_is_not_there_is_named_as_a_whole() -> None:
    (found,) = findings(f"{WHOLE} (contoursolve: straight part of line 3 = 1)")
    assert found["message"].endswith("expected a line (line 1, line 2, corner 1, corner 2), found `line 3`")
