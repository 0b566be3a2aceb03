"""A contour with a variable is a family: for which values it exists, and commands that take the variable as a word."""

from math import ceil, cos, radians

import pytest
from click.testing import CliRunner
from hypothesis import given, strategies as st

import contoursolve
from contoursolve.cli import main
from contoursolve.controls import CONTROLS
from contoursolve.families import FamilyError

START = "G00 X40. Z0.\n"
BLOCK = "G111 A180. K-30. B120. X#100 P5. Q#101"


def notes(text, **options):
    (finding,) = (each for each in contoursolve.check(text, **options) if each.code in ("value-variable", VARIABLE))
    return finding.notes


VARIABLE = "heidenhain-parameter"
KLARTEXT = "0 BEGIN PGM A MM\n1 L X+0 Y+0\n2 FL AN+60\n3 FL X+Q1 Y+20 AN-30\n4 END PGM A MM\n"


def test_check_says_for_which_values_a_contour_exists_and_what_ends_them():
    first, below, why = notes(START + BLOCK.replace("#101", "5."))
    assert (first, why) == ("#100 makes a contour from 50.000 on", "#100: #100 is set by nothing before")
    assert below.startswith("#100 below 50.000: P5. and Q5. overlap on the second straight")
    # Behind this (rounded into the range), the line of 60 deg runs past the end of the one of -30 deg.
    least = ceil(20_000 * cos(radians(60)) / cos(radians(30))) / 1000
    assert notes(KLARTEXT)[0] == f"Q1 makes a contour from {least} on"
    both = notes(START + "G111 A[180.-#100] K-30. B120. X100. P#100 Q5.")
    assert both[0].startswith("#100 makes a contour from 0.000 to 34.67")


def test_two_variables_are_named_with_the_reason_of_each():
    assert set(notes(START + BLOCK)) == {"#100: #100 is set by nothing before", "#101: #101 is set by nothing before"}
    assert notes(START + "#100=#5041\n#101=5.\n" + BLOCK)[-2:] == ("#101 is 5. here", "#100: #5041 is the machine's")


def test_what_nobody_knows_any_more_behind_a_call_is_known_if_it_was_stated():
    text = f"{START}#100=60.\nG65 P9000\n{BLOCK.replace('#101', '5.')}"
    codes = [{each.code for each in contoursolve.check(text, variables=given)} for given in ({}, {"#100": 50.0})]
    assert ["value-variable" in each for each in codes] == [True, False]


@given(value=st.floats(30.0, 300.0).map(lambda each: round(each, 3)))
def test_what_is_said_of_a_value_holds_for_it(value):
    text = START + BLOCK.replace("#101", "5.")
    (answer,) = contoursolve.solve(text, variables={"#100": value}).answers
    assert (answer.contour is not None) == (value >= 50)
    (typed,) = contoursolve.solve(text.replace("#100", f"{value:f}")).answers
    assert answer.contour == typed.contour


@pytest.mark.parametrize(
    ("block", "told"),
    [
        (BLOCK, "#101 is set by nothing before; state it with --variable"),
        ("G111 A180. K-30. B120. X[#100+1.]", "#100 is a part of [#100+1.]"),
        ("G111 A180. K-30. B120. X#100 P#100", "#100 stands in several words"),
    ],
)
def test_a_variable_that_is_no_word_is_told(block, told):
    with pytest.raises(FamilyError, match=r".") as error:
        contoursolve.ranges(block, "#100", start="X40. Z0.")
    assert told in str(error.value)


def test_the_command_line_states_values():
    arguments = ["range", "--block", BLOCK, "--start", "X40. Z0.", "--word", "#100"]
    done = CliRunner().invoke(main, [*arguments, "--variable", "#101=5."])
    assert (done.exit_code, "#100 at least 50.000 mm" in done.output) == (0, True)
    assert "now" not in done.output
    for wrong in ("#101", "#101=x", "=5", "#101=nan"):
        done = CliRunner().invoke(main, [*arguments, "--variable", wrong])
        assert (done.exit_code, "NAME=NUMBER" in done.output) == (2, True)


@pytest.mark.needs("anywidget")
def test_the_explorer_takes_values_of_variables():
    explorer = contoursolve.explore(BLOCK, start="X40. Z0.", variables={"#100": 95, "#101": 4.75})
    assert explorer.text == "G111 A180. K-30. B120. X95. P5. Q4.75"


MACRO_B = ("fanuc-lathe", "fanuc-mill", "haas-lathe", "haas-mill", "mitsubishi", "nct-99m", "yasnac-lx3")


COMPARED = {
    "#1 EQ #0": True,
    "#1 NE #0": False,
    "#1 EQ 0": False,
    "#1 NE 0": True,
    "#1 GE 0": True,
    "#1 LE 0": True,
    "#1 GT 0": False,
    "#1 LT 0": False,
    "#1 LT 1": True,
    "[#1+0] EQ #0": False,
    "[#1*5] EQ 0": True,
    "[#0+2] EQ 2": True,
    "#2 EQ #0": True,
    "#3 EQ #0": False,
    "#3 EQ 0": True,
}


@pytest.mark.parametrize("condition", COMPARED)
def test_what_is_empty_is_told_from_0_by_eq_and_ne_alone(condition):
    text = (
        f"G0 X0. Y0.\nG65 P9\nM30\nO9\n#2=#1\n#3=0\n#4=10.\nIF[{condition}]THEN #4=20.\nG1 X#4 Y#1 ,C1.\nY30. ,R#0\nM99"
    )
    result = contoursolve.expand(text, control="fanuc-mill", inline=True)
    assert f"G01 X{19 if COMPARED[condition] else 9}. Y0." in result.text
    assert result.summary.replaced == 1


def test_formulas_with_the_empty_variable_are_those_with_0():
    text = "G17 G21 G90 G0 X0. Y0.\n#101=50.\n#102=2.\nG1 X[#101+{}] ,R#102 F100\nY30.\nM30"
    one, two = (
        contoursolve.expand(text.format(each), control="fanuc-mill", formulas=True, comments=False)
        for each in ("#0", "0.")
    )
    assert one.text == two.text
    assert one.summary.replaced == 1


@pytest.mark.parametrize(
    ("control", "name", "told"),
    [
        *((each, "foo.bar", "there is no variable FOO.BAR") for each in CONTROLS),
        *((each, "#-1", "there is no variable #-1") for each in CONTROLS),
        *((each, "yasnac-lx3.foo", "a setting is stated with --setting") for each in CONTROLS),
        *((each, "R100", "write #100") for each in MACRO_B),
        ("siemens-840d", "#100", "variables are called R100 or a name such as _ANG: write R100"),
        ("isg", "#100", "write P100"),
        ("heidenhain", "#100", "write Q100"),
        ("fanuc-mill", "#0", "#0 is always empty"),
        ("", "foo.bar", "there is no variable FOO.BAR"),
    ],
)
def test_a_value_of_what_is_no_variable_is_told(control, name, told):
    named = ["--control", control] if control else []
    done = CliRunner().invoke(main, ["check", *named, "--block", "G0 X0", "--variable", f"{name}=1"])
    assert (done.exit_code, told in done.output) == (2, True), done.output


@pytest.mark.parametrize("command", ["solve", "range"])
@pytest.mark.parametrize(
    ("start", "told"),
    [("hello", "hello has no number"), ("X4O. Z0.", "did you mean the digit 0 (X40.)"), ("Q5.", "Q5. states no place")],
)
def test_a_start_that_cannot_be_read_is_wrong_usage(command, start, told):
    words = ["--block", "G111 X100. A180. K-30. B120.", "--start", start, *["--word", "X"] * (command == "range")]
    done = CliRunner().invoke(main, [command, *words])
    assert (done.exit_code, told in done.output) == (2, True), done.output


def test_a_folder_that_cannot_be_read_is_wrong_usage():
    done = CliRunner().invoke(main, ["solve", "--block", "G111 X100. A180. K-30.", "--path", "nowhere/at/all"])
    assert (done.exit_code, "cannot be read as a folder" in done.output) == (2, True), done.output


@pytest.mark.parametrize("head", ["PROC REC(INT K)", "DEF REAL K", "DEF INT K=1"])
def test_a_variable_that_the_program_declares_has_any_name(head):
    text = f"{head}\nG18 G90 DIAMON\nG0 X60 Z2\nG1 X40 F0.2\nIF K>0\n  Z-20 RND=2\nELSE\n  Z-25 RND=3\nENDIF\nX52\nM17"
    for value, end in ((1.0, -20.0), (-1.0, -25.0)):
        result = contoursolve.solve(text, control="siemens-840d", variables={"K": value})
        assert {each.status.value for each in result.answers} == {"solved"}
        assert any(each.contour.end == (end, 26.0) for each in result.answers)
    with pytest.raises(ValueError, match="no variable H"):
        contoursolve.solve(text, control="siemens-840d", variables={"H": 1.0})


@pytest.mark.parametrize(
    ("control", "typed", "stated"),
    [
        ("siemens-840d", "Y=R17 RND=2", "R17"),
        ("siemens-840d", "Y=40*SIN(_ANG) RND=2", "_ANG"),
        ("isg", "Y=P100 #RND=2", "P100"),
        ("isg", "Y=V.L.WIDE #RND=2", "V.L.WIDE"),
        ("fanuc-mill", "Y-[ABS[SQRT[#101]]] ,R2.", "#101"),
        ("fanuc-mill", "Y[#<wide>] ,R2.", "#<WIDE>"),
    ],
)
def test_the_variable_whose_value_is_to_be_stated_is_named_as_it_is(control, typed, stated):
    text = f"G17 G90 G0 X0 Y0\nG1 X60. F9\n{typed}\nX5."
    (finding,) = contoursolve.check(text, control=control)
    assert finding.help.endswith(f'--variable "{stated}=95."')
    assert not contoursolve.check(text, control=control, variables={stated: 30.0})


def test_a_fix_keeps_the_variable_of_a_word_whose_address_it_changes():
    text = "G17 G90 G94\nR10=18\nG0 X0 Y0\nG1 X60 Y-10 F500 RND=3\nG3 X78 Y8 R=R10\nG1 X78 Y50\nM30"
    found = next(each for each in contoursolve.check(text, control="siemens-840d") if each.fixes)
    assert found.fixes[0].description.startswith("write CR=R10 for R=R10")
    assert found.fixes[0].replacement.splitlines()[1] == "G3 X78 Y8 CR=R10"


HANDED_OVER = """{unit}
G00 X0. {axis}0.
G65 P7002 X20000 R{size}
M30
O7002
G01 X#24 ,R#18 F1.
{axis}-40.
M99"""


@pytest.mark.parametrize("control", [each for each in MACRO_B if each != "yasnac-lx3"])
@pytest.mark.parametrize(("unit", "step"), [("G21", 0.001), ("G20", 0.0001), ("", 0.001)])
def test_an_argument_without_a_point_counts_the_least_increment_of_its_address(control: str, unit: str, step: float):
    axis = "Z" if control.endswith("lathe") else "Y"

    def solved(**options):
        program = HANDED_OVER.format(unit=unit, axis=axis, size="3000" if not options else "3")
        return contoursolve.solve(program, control=control, **options)

    result = solved()
    (answer,) = result.answers
    (radius,) = (each.radius for each in answer.contour.elements if hasattr(each, "radius"))
    assert radius == pytest.approx(3000 * step * (25.4 if unit == "G20" else 1))
    (warning,) = (each for each in result.diagnostics if each.code == "argument-in-increments")
    assert (warning.severity.value, warning.span.line) == ("warning", 3)
    short = "2 and 0.3" if unit == "G20" else "20 and 3"
    assert f"X20000 and R3000 have no decimal point and are read as {short} in the called program" in warning.message
    # A control that reads them as they stand has the same warning.
    whole = solved(settings={f"{control}.macro-arguments": "whole"})
    (radius,) = (each.radius for each in whole.answers[0].contour.elements if hasattr(each, "radius"))
    assert radius == pytest.approx(3 * (25.4 if unit == "G20" else 1))
    assert [each.code for each in whole.diagnostics].count("argument-in-increments") == 1


@pytest.mark.parametrize("call", ["G66 P9 X2 A5.\nG67", "G66.1 P9 X2\nG67", "IF[#1 EQ 1]THEN G65 P9 X2 D3"])
def test_an_argument_without_a_point_is_told_of_each_kind_of_call(call: str):
    result = contoursolve.solve(f"G21 G90\n{call}\nM30\nO9\nG00 X#24\nM99", control="fanuc-mill")
    (warning,) = (each for each in result.diagnostics if each.code == "argument-in-increments")
    assert "X2 has no decimal point and is read as 0.002 in the called program" in warning.message
    assert (warning.span.line, warning.span.column) == (2, call.index("X2") + 1)


def test_an_argument_is_not_known_where_the_unit_changes():
    program = "G21 G90\nG00 X0. Y0.\nG65 P9 X20000\nG20\nG65 P9 X20000\nM30\nO9\nG01 X#24 ,R3. F1.\nY40.\nM99"
    result = contoursolve.solve(program, control="fanuc-mill")
    assert all(each.contour is None for each in result.answers)
    notes = [note for each in result.diagnostics for note in each.notes]
    assert any("no decimal point, and the program changes between mm and inches" in each for each in notes)
    # With points, the unit of the calls does not matter.
    pointed = contoursolve.solve(program.replace("20000", "20."), control="fanuc-mill")
    assert not [each for each in pointed.diagnostics if each.code == "argument-in-increments"]


def test_whole_numbers_and_other_letters_are_handed_over_as_they_stand():
    program = "G21 G90\nG00 X0. Y0.\nG65 P9 D20 H3 S7 T0 X0\nM30\nO9\nG01 X#7 ,R#11 F1.\nY40.\nM99"
    result = contoursolve.solve(program, control="fanuc-mill")
    assert result.answers[0].contour.points["V1"] == (20, 0)
    assert not [each for each in result.diagnostics if each.code == "argument-in-increments"]
