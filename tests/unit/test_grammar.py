"""Facts as text: what can be read, where a mistake is marked, and that no text at all ends in a traceback."""

import re
from typing import Any

import pytest
from click.testing import CliRunner
from examples import law
from hypothesis import strategies as st

from contoursolve import check, solve
from contoursolve.cli import main
from contoursolve.geometry import GrammarError, Length, Plane, Vocabulary, read_statement
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


def test_the_listing_itself_shows_a_block_that_is_solved() -> None:
    (block,) = [line.strip() for line in vocabulary_lines() if "G111" in line and "contoursolve:" in line]
    assert solve(block, start=START).answers[0].contour is not None


@pytest.mark.parametrize(
    ("fact", "other"),
    [
        ("length of line 1 = 30", "  Length   of line  1=30  "),
        ("length of line 1 = 30", "length of line 1 = 30."),
        ("length of line 1 = 30", "length of line 1 = +30.000"),
        ("length of line 1 = 30", "length of line 1 = 3e1"),
        ("length of line 1 = 0.5", "length of line 1 = .5"),
        ("radius of corner 1 = 5", "size of corner 1 = 5"),
        ("Z of begin of corner 1 = -3", "z of start of corner 1 = -3"),
        ("Z of center of corner 1 = -3", "Z of centre of corner 1 = -3"),
        ("line 2 passes through (Z-40. X80.)", "line 2 passes through (X80 Z-40)"),
        ("line 2 passes through (Z-40. X80.)", "line 2 through (Z -40, X 80)"),
        ("line 2 passes beside (Z-40. X80.) at 5", "line 2 passes [Z-40 X80] at 5.0"),
        ("line 2 passes beside (Z-40. X80.) at 5", "LINE 2 Passes Beside x80 z-40 AT +5"),
        ("line 2 parallel to line 1", "line 2 is parallel to line 1 "),
        ("line 2 parallel to line 1 at 10", "line 2  is  parallel to line 1  at 1e1"),
        ("polar angle of arc = 90", "polar angle of end of arc = 90."),
        ("polar angle of begin of arc = 90", "Polar Angle of start of arc=90"),
        ("line 2 tangent to circle (Z-40. X120. R10.)", "line 2 is tangent to circle Z-40 X120 R10"),
        ("corner 1 tangent to line (Z0. X30. A180.)", "corner 1 tangent to line [x30 z0 a180]"),
        ("length of line 1 = ?", "length of line 1=?"),
    ],
)
def test_spelling_does_not_change_the_meaning(fact: str, other: str) -> None:
    assert read_statement(other, LATHE) == read_statement(fact, LATHE)


PLAIN_TEXT = "0 BEGIN PGM A MM\n1 L X+0 Y+0\n2 FL AN+60 {}\n3 FL X+80 Y+20 AN-30\n4 END PGM A MM"


@pytest.mark.parametrize(
    ("block", "options", "values"),
    [
        # Numbers without a point mean what they say, though words count increments.
        ("G111 A180000 B120000 X100000", {"facts": ["length of line 1 = 30", "Z of V1 = ?"]}, [-30]),
        # A coordinate of a diameter axis is a diameter, and lengths are in the unit of the program.
        (
            "G111 A180. B120. X4.",
            {
                "facts": ["X of V2 = 4", "length of line 1 = 2", "Z of V1 = ?", "length of line 2 = ?"],
                "start": "X2. Z0.",
                "units": "inch",
            },
            [-50.8, 25.4 / 0.75**0.5],
        ),
        # Several facts in a comment are separated by semicolons.
        (
            "G111 A180. B120. (contoursolve: X of V2 = 100; ; length of line 1 = 30 ;Z of V2 = ?) P5. (P9.)",
            {},
            [-30 - 30 / 3**0.5],
        ),
        # Comments behind a semicolon state facts with parentheses and without.
        *(
            (PLAIN_TEXT.format(comment), {"start": None}, [80 * 0.75**0.5 - 10])
            for comment in (
                "; contoursolve: line 2 passes through (X10 Y17.321); length of line 3 = ?",
                "; (contoursolve: line 2 passes through [X10 Y17.321]; length of line 3 = ?)",
            )
        ),
        # Other comments state nothing.
        *(
            (f"{WHOLE} {comment}", {}, [])
            for comment in (
                "(contoursolve)",
                "(contour solve: x)",
                "(see contoursolve: Z of V1 = ?)",
                "; contoursolve: Z of V1 = ?",
            )
        ),
    ],
)
def test_facts_are_read_in_the_terms_of_the_program(block: str, options: dict[str, Any], values: list[float]) -> None:
    (answer,) = solve(block, **({"start": START} | options)).answers
    assert answer.contour is not None
    assert sorted(each.value for each in answer.answers) == pytest.approx(values)


# Mistakes, and where they are marked ----------------------------------------------------------------------

ELEMENTS = " (line 1, line 2, corner 1, corner 2)"
QUANTITY = "an element, or a quantity such as `length of`, `radius of`, `Z of`" + ELEMENTS
RELATION = "`passes through`, `passes beside`, `parallel to`, `tangent to` or `meets`"
PLACE = "a place such as `(Z10. X20.)`"
ONLY_TWO = "only two lengths or two radii can be equal"
MISTAKES = [
    ("length of line 9 = 20", "line 9", "an element" + ELEMENTS),
    ("straight part of line 3 = 1", "line 3", "a line" + ELEMENTS),
    ("lenght of line 1 = 20", "lenght", QUANTITY),
    ("length of line 1 = 2O", "2O", "a number"),
    ("length of line 1 = 1.2.3", "1.2.3", "a number"),
    ("length of line 1 = 5mm", "5mm", "a number"),
    ("length of line 1 = 20 mm", "mm", "the end of the fact"),
    ("length of line 1 = ? ?", "?", "the end of the fact"),
    ("length of line 1 : 20", ":", "`=`"),
    ("length line 1 = 20", "length", QUANTITY),
    ("X of V3 = 20", "V3", "a point, or `begin of`, `end of`, `center of` (S, V1, V2)"),
    ("Y of V1 = 20", "Y", QUANTITY),
    ("line 1 passes through [Z-40.]", "]", PLACE),
    ("line 1 passes through [Z-40. X3. ", "", "`]`"),
    ("line 1 passes through Z-40. Z3.", "Z3.", PLACE),
    ("line 1 tangent to circle [Z0 X0]", "]", "`R` and a number"),
    ("corner 1 tangent to line [Z0 X0]", "]", "`A` and a number"),
    ("line 1 tangent to Z0 X0 R5", "Z0", "an element, `circle (...)` or `line (...)`" + ELEMENTS),
    ("line 1 passes [Z0 X0]", "", "`at` and a distance"),
    ("line 1 passes beside [Z0 X0] at", "", "a number"),
    ("line 1 parallel line 2", "parallel", RELATION),
    ("line 1 parallel to line 2 by 3", "by", "`at` and a distance"),
    ("line 1 parallel to line 2 at X3", "X3", "a number"),
    ("polar angle of center of corner 1 = 3", "center", "an arc, or `begin of` or `end of` one" + ELEMENTS),
    ("line 1 touches line 2", "touches", RELATION),
    ("corner 2 meets line", "line", "`next line`, `line to (...)` or `line at` an angle"),
    ("angle from line 1 line 2 = 20", "line", "`to`"),
    ("chord of line 1 = length of line 1", "length of line 1", ONLY_TWO),
    ("length of line 1 = straight part of line 2", "straight part of line 2", ONLY_TWO),
    ("radius of corner 1 = length of line 2", "length of line 2", ONLY_TWO),
]


@pytest.mark.parametrize(("fact", "marked", "expected"), MISTAKES)
def test_a_mistake_is_marked_where_it_is(fact: str, marked: str, expected: str) -> None:
    """In the fact, in a comment among others, and where facts are stated apart from the program."""
    found = f"`{marked}`" if marked else "the end"
    told = expected if expected == ONLY_TWO else f"expected {expected}, found {found}"
    with pytest.raises(GrammarError) as caught:
        read_statement(fact, Vocabulary(("line 1", "line 2", "corner 1", "corner 2"), *LATHE_BESIDE))
    assert str(caught.value) == told
    assert fact[caught.value.begin : caught.value.end].strip() == marked
    (apart,) = check(WHOLE, start=START, facts=["X of V1 = 40", fact])
    assert (apart.code, apart.message, apart.span.line) == (
        "fact-unreadable",
        f"the fact cannot be read: {told}",
        -2,  # the second of the facts
    )
    assert fact[apart.span.column - 1 : apart.span.end_column - 1].strip() == marked
    if marked:
        block = f"{WHOLE} (contoursolve: X of V1 = 40 ;  {fact};X of V1 = 40)"
        (inside,) = (each for each in check(block, start=START) if each.code == "fact-unreadable")
        assert inside.message == f"the fact cannot be read: {told}"
        assert block[inside.span.column - 1 : inside.span.end_column - 1] == marked
        assert block.index(fact) < inside.span.column <= block.index(fact) + len(fact)


LATHE_BESIDE = LATHE.points, LATHE.plane, LATHE.unit


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


@pytest.mark.parametrize(
    ("comment", "written"),
    [
        ("(contoursolve length of line 1 = 5)", "(contoursolve: length of line 1 = 5)"),
        ("(Contour-Solve: X of V1 = 40)", "(contoursolve: X of V1 = 40)"),
        ("(contoursolver = line 1 passes through [Z-1. X40.])", "(contoursolve: line 1 passes through [Z-1. X40.])"),
        (";contoursolve: length of line 1 = 5", "(contoursolve: length of line 1 = 5)"),
        ("(CONTOUR: OUTSIDE)", ""),
        ("(contoursolve 1.0)", ""),
        ("(made by contoursolve: A = B)", ""),
    ],
)
def test_a_comment_that_is_almost_a_fact_is_warned_about_with_what_to_write(comment: str, written: str) -> None:
    found = [(each.code, each.severity.value, each.help) for each in check(f"{WHOLE} {comment}", start=START)]
    assert found == [("fact-unmarked", "warning", f"write {written}")] * bool(written)


def test_round_brackets_in_a_comment_are_refused_with_the_hint_that_square_ones_work() -> None:
    found = check(f"{WHOLE} (contoursolve: line 2 passes through (Z-40. X80.))", start=START)
    (unreadable,) = [each for each in found if each.code == "fact-unreadable"]
    assert unreadable.message.endswith("inside a comment write [ ] for ( )")


# Any text at all ------------------------------------------------------------------------------------------

PHRASES = (
    "length of|straight part of|direction of|radius of|angle from|to|Z of|X of|begin of|end of|center of|line 1|line 2"
    "|corner 1|corner 2|V1|V2|S|arc|line|passes through|tangent to|meets|next line|line at|line to|circle|=|= ?|= 30"
    "|= -60|= 0|= 1e9|(Z-40. X80.)|(Z-40. X120. R10.)|[Z0 X30 A180]|?|;|R|A|,|(|)|[|]|#1|1e999|\t|\x00"
)
PIECES = st.sampled_from((*PHRASES.split("|"), "9" * 50, "\N{FULLWIDTH DIGIT ONE}"))
SENSIBLE = st.sampled_from([fact for fact in EXAMPLES if not fact.startswith("line tangent")])
NUMBERS = st.sampled_from(("0", "-5", "1e-9", "0.001", "30", "29.999999", "1000", "1e6", "180", "-360", "?"))


@st.composite
def fact_texts(draw: st.DrawFn) -> str:
    if draw(st.booleans()):
        return " ".join(draw(st.lists(PIECES, max_size=8)))
    text = draw(SENSIBLE)
    return re.sub(r"= [-\d.]+$", lambda _: f"= {draw(NUMBERS)}", text)


@law(st.text(max_size=40) | fact_texts(), few=10, many=40)
def test_any_text_is_a_statement_or_a_grammar_error(text: str) -> None:
    found = None
    try:
        read_statement(text, LATHE)
    except GrammarError as error:
        found = error
    assert found is None or 0 <= found.begin < found.end <= len(text) + 1
    assert found is None or found.begin <= len(text)


FREE = ("G111 A180. B120. X100. P5. Q5.", "G111 A180. K-30. B120. P? Q5.", WHOLE, "G111 A180. K-30. B120. X100. C? D2.")
"""Every line has its direction, so that solving takes steps in closed form."""


@pytest.mark.parametrize("block", FREE)
@law(fact_texts().filter(str.strip), few=2, many=4)
def test_any_fact_about_a_block_is_answered_in_a_comment_as_apart(block: str, fact: str) -> None:
    """With the same status, the same values and the same contour."""
    fact = fact.replace("(", "[").replace(")", "]").replace(";", " ")
    (inside,) = solve(f"{block} (contoursolve: {fact})", start=START).answers
    (apart,) = solve(block, start=START, facts=[fact]).answers
    assert (inside.status, inside.contour) == (apart.status, apart.contour) or not fact.isprintable()
    assert [each.value for each in inside.answers] == [each.value for each in apart.answers]


TAPER = ("A180.", "K-30.", "B120.", "X100.", "P5.", "Q3.")
LENGTH_2 = 30 / 0.75**0.5
"""Of line 2, which rises by 30 mm at 120 degrees; a rounding takes its radius times the tangent of 30 degrees."""


@pytest.mark.parametrize(
    ("address", "fact", "value"),
    [
        ("A", "length of line 1 = 30", 180),
        ("K", "length of line 1 = 30", -30),
        ("X", "X of V2 = 100", 100),
        ("X", "straight part of line 2 = 20", 40 + 2 * 0.75**0.5 * (20 + 8 / 3**0.5)),
        ("P", "straight part of line 2 = 20", (LENGTH_2 - 20) * 3**0.5 - 3),
        ("Q", "straight part of line 2 = 20", (LENGTH_2 - 20) * 3**0.5 - 5),
        ("B", "direction of line 2 = 120", 120),
        ("K", "straight part of line 2 = 20", None),
        ("B", "length of line 1 = 30", None),
    ],
)
def test_a_value_that_is_found_makes_the_same_contour_where_it_is_written(address: str, fact: str, value: Any) -> None:
    """In place of the question mark, without the fact; or the block is told to be open."""
    words = {word[0]: word[1:] for word in TAPER}
    solved = [
        solve(f"G111 {' '.join(map(''.join, (words | {address: text}).items()))}", start=START, facts=facts).answers[0]
        for text, facts in (("?", [fact]), (f"{value or 0:.12f}", []))
    ]
    (found,) = solved[0].answers
    if value is None:
        assert (found.value, solved[0].contour) == (None, None)
    else:
        assert found.value * (1 + found.question.is_diameter) == pytest.approx(value, abs=1e-9)
        assert solved[0].contour.deviation(solved[1].contour) < 1e-9
