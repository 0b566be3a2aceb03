"""A contour with a variable is a family: for which values it exists, and commands that take the variable as a word."""

from math import cos, radians, tan

import numpy
import pytest
from click.testing import CliRunner
from hypothesis import given
from hypothesis import strategies as st

import contoursolve
from contoursolve.cli import main
from contoursolve.families import FamilyError

START = "G00 X40. Z0.\n"
BLOCK = "G111 A180. K-30. B120. X#100 P5. Q#101"
ONE = {"start": "X40. Z0.", "variables": {"#101": 5.0}}


def notes(text, **options):
    (finding,) = (each for each in contoursolve.check(text, **options) if each.code in ("value-variable", VARIABLE))
    return finding.notes


VARIABLE = "heidenhain-parameter"
KLARTEXT = "0 BEGIN PGM A MM\n1 L X+0 Y+0\n2 FL AN+60\n3 FL X+Q1 Y+20 AN-30\n4 END PGM A MM\n"


def test_check_says_for_which_values_a_contour_exists_and_what_ends_them():
    first, below, why = notes(START + BLOCK.replace("#101", "5."))
    assert (first, why) == ("#100 makes a contour from 50.000 on", "#100: #100 is set by nothing before")
    assert below.startswith("#100 below 50.000: P5. and Q5. overlap on line 2")
    # Behind this, the line of 60 deg runs past the end of the one of -30 deg.
    assert notes(KLARTEXT)[0] == f"Q1 makes a contour from {20 * cos(radians(60)) / cos(radians(30)):.3f} on"
    both = notes(START + "G111 A[180.-#100] K-30. B120. X100. P#100 Q5.")
    assert both[0].startswith("#100 makes a contour from 0.000 to 34.67")


def test_two_variables_are_named_with_the_reason_of_each():
    assert set(notes(START + BLOCK)) == {"#100: #100 is set by nothing before", "#101: #101 is set by nothing before"}
    assert notes(START + "#100=#5041\n#101=5.\n" + BLOCK)[-2:] == ("#101 is 5. here", "#100: #5041 is the machine's")


@given(value=st.floats(30.0, 300.0).map(lambda each: round(each, 3)))
def test_what_is_said_of_a_value_holds_for_it(value):
    text = START + BLOCK.replace("#101", "5.")
    (answer,) = contoursolve.solve(text, variables={"#100": value}).answers
    assert (answer.contour is not None) == (value >= 50)
    (typed,) = contoursolve.solve(text.replace("#100", f"{value:f}")).answers
    assert answer.contour == typed.contour


def test_commands_about_families_take_a_variable_as_a_word():
    found = contoursolve.feasible(BLOCK, "#100", **ONE)
    assert [round(each.low.value, 4) for each in found.intervals] == [50.0]
    table = contoursolve.family(BLOCK, vary={"#100": [45.0, 95.0]}, **ONE)
    assert [code == 0 for code in table.columns["status"]] == [False, True]
    plain = contoursolve.family(
        BLOCK.replace("X#100", "X1.").replace("#101", "5."), vary={"X": [95.0]}, start="X40. Z0."
    )
    assert numpy.allclose(table.columns["V2.Z"][1], plain.columns["V2.Z"][0])
    hits = contoursolve.find_word(BLOCK.replace(" Q#101", ""), "#100", "end Z-45.", start="X40. Z0.").hits
    assert [each.value for each in hits] == [pytest.approx(2 * (20 + 15 * tan(radians(60))), abs=1e-6)]


@pytest.mark.parametrize(
    ("block", "told"),
    [
        (BLOCK, "#101 is set by nothing before; state it with --let"),
        ("G111 A180. K-30. B120. X[#100+1.]", "#100 is a part of [#100+1.]"),
        ("G111 A180. K-30. B120. X#100 P#100", "#100 stands in several words"),
    ],
)
def test_a_variable_that_is_no_word_is_told(block, told):
    with pytest.raises(FamilyError, match=r".") as error:
        contoursolve.feasible(block, "#100", start="X40. Z0.")
    assert told in str(error.value)


def test_the_command_line_states_values():
    arguments = ["range", "--block", BLOCK, "--start", "X40. Z0.", "--word", "#100"]
    done = CliRunner().invoke(main, [*arguments, "--let", "#101=5."])
    assert (done.exit_code, "#100 at least 50.000 mm" in done.output) == (0, True)
    assert "now" not in done.output
    for wrong in ("#101", "#101=x", "=5", "#101=nan"):
        done = CliRunner().invoke(main, [*arguments, "--let", wrong])
        assert (done.exit_code, "NAME=NUMBER" in done.output) == (2, True)


@pytest.mark.needs("anywidget")
def test_the_explorer_takes_values_of_variables():
    explorer = contoursolve.explore(BLOCK, start="X40. Z0.", variables={"#100": 95, "#101": 4.75})
    assert explorer.text == "G111 A180. K-30. B120. X95. P5. Q4.75"
