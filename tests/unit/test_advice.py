"""What a finding asks to add, to delete or to write helps: its words, its fixes and the equations agree."""

import re

import pytest

from contoursolve import Diagnostic, check, solve

START = "X40. Z0."


def findings(block: str, **options: str) -> dict[str, Diagnostic]:
    return {each.code: each for each in check(block, control="yasnac-lx3", start=START, **options)}


def asked(finding: Diagnostic) -> str:
    """What is to be added, as a finding that lacks words says it."""
    return (finding.message + "; " + finding.help).partition("add ")[2].partition(";")[0]


@pytest.mark.parametrize(
    ("block", "code", "words"),
    [
        # With I0 any A leaves line 1 no length; K places V1 on it.
        ("G111 X100. I0 B120.", "g111-line-1", "K"),
        ("G111 X100. I0 B120.", "words-missing", "one of K, Z, W"),
        # At 90 deg K says what A says.
        ("G111 A90.", "g111-line-1", "I"),
        ("G111 A90.", "words-missing", "three of I, X or U, Z or W, B"),
        ("G111 A180.", "words-missing", "three of K, X or U, Z or W, B"),
        # I and K say the same beside A, and so do X and U.
        ("G111 A170. B120. C2.", "words-missing", "two of I or K, X or U, Z or W"),
        ("G111 A170. B120. C2.", "g111-line-1", "I or K"),
        ("G111 A170. B120. C2.", "g111-line-2", "X or U or Z or W"),
        ("G111 I10. B120.", "words-missing", "two of K or A, X or U, Z or W"),
        ("G111 I10. K-20. B120.", "words-missing", "one of X, U, Z, W"),
        ("G111 C2.", "words-missing", "four of I, K, A, X or U, Z or W, B"),
    ],
)
def test_only_words_that_help_are_asked_for(block, code, words):
    assert asked(findings(block)[code]) == words


@pytest.mark.parametrize(
    ("block", "word"), [("G111 X100. I0 B120.", "K"), ("G111 U60. I0 B120.", "K"), ("G111 A180. B120. X100.", "K")]
)
def test_a_word_that_may_have_either_sign_is_offered(block, word):
    (fix,) = (
        each for each in next(iter(findings(block).values())).fixes if each.description.startswith(f"add {word}?")
    )
    (answer,) = solve(fix.example, control="yasnac-lx3", start=START).answers
    assert answer.contour is not None
    assert not answer.diagnostics


@pytest.mark.parametrize("block", ["G111 X100. I0 B120.", "G111 A90.", "G111 A170. B120. C2.", "G111 X100. U50."])
def test_every_word_that_is_asked_for_is_in_a_fix(block):
    found = findings(block).values()
    offered = {word for each in found for fix in each.fixes for word in re.findall(r"add ([A-Z]+)\?", fix.description)}
    named = {word for each in found for word in re.findall(r"\b[A-Z]\b", asked(each))}
    assert named
    assert named <= offered


def test_not_all_of_words_that_say_the_same_are_asked_for_together():
    missing = findings("G111 X100. U50.")["words-missing"]
    assert missing.message.endswith("add three of I, K, A, Z or W, B; not I, K and A together")


@pytest.mark.parametrize(
    ("block", "units", "told"),
    [
        ("G111 A170. K-20. X100. U50.", "mm", "by 10.000 mm: it states 50.000 mm, X100. gives 60.000 mm"),
        ("G111 A170. K-.8 X4. U1.5", "inch", "by 0.9252 in: it states 1.5000 in, X4. gives 2.4252 in"),
        ("G111 A170. K-20. Z-50. W-40.", "mm", "by 10.000 mm: it states -40.000 mm, Z-50. gives -50.000 mm"),
    ],
)
def test_differences_are_shown_as_words_are_written(block, units, told):
    start = START if units == "mm" else "X1.5748 Z0."
    result = check(block, control="yasnac-lx3", start=start, units=units)
    finding = next(each for each in result if each.code == "words-conflict")
    assert finding.message.partition(" ")[2].partition(" ")[2].partition(" ")[2].endswith(told)
    assert any(note.endswith(f"{told.split(' ')[1]} {told.split(' ')[2].rstrip(':')} apart") for note in finding.notes)


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        (
            ["G00 X-1.6 Z0.", "G01 X18. ,C1. F0.2", "Z-30. ,R3.", "X36."],
            (2, "line 1", "X-1.600 mm to Z0.000 mm X16.000 mm"),
        ),
        (["G00 X36. Z-30.", "G01 Z0. ,R3.", "X-1.6 ,R.5", "Z5."], (3, "line 2", "X30.000 mm to Z0.000 mm X-0.600 mm")),
        (
            ["G00 X-40. Z0.", "G01 Z-10. ,R2.", "X-20. ,C1.", "Z-20. ,R1.", "X30."],
            (5, "line 4", "X-18.000 mm to Z-20.000 mm X30.000 mm"),
        ),
    ],
)
def test_a_path_across_the_spindle_axis_names_the_line_that_crosses_it(lines, told):
    line, element, places = told
    (finding,) = (each for each in check("\n".join(lines), control="fanuc-lathe") if each.code == "axis-crossed")
    assert finding.span.line == line
    assert finding.message.startswith(f"{element} crosses the spindle axis")
    assert finding.message.endswith(places)


def test_an_increment_in_brackets_is_offered_too():
    (finding, *_) = check("G17 G90 G0 X10 Y0\nG1 ANG=30\nM30", control="siemens-840d")
    fixes = {each.description: each.example for each in finding.fixes}
    assert fixes["add X=IC(?) (such as X=IC(10), X=IC(0.001) or above)"] == "G1 ANG=30 X=IC(10)"


@pytest.mark.parametrize(
    ("block", "told"),
    [
        ("G111 Z-60. A90. I20. B200. C5.", "lies 40.000 mm in X (diameter) outside"),
        ("G111 X100. A180. K-30. B60. C5.", "lies 17.321 mm in Z outside"),
    ],
)
def test_how_far_a_bevel_is_outside_is_told_as_its_axis_is_programmed(block, told):
    finding = findings(block)["g111-bevel-outside"]
    assert told in finding.message
    assert finding.values["off_by_mm"] == pytest.approx(20.0 if "X (" in told else 17.3205, abs=1e-4)
