"""Words that are said to be right, and words that are only compared, in options, comments and the editor's program."""

import json

import pytest
from calling import call
from click.testing import Result

from contoursolve import CONTROLS, OpenProgram, solve

TAPER = "G111 A180. K-30. B120. X100. "
START = "G00 X40. Z0.\n"


def check(*arguments: str, status: int | None = None) -> Result:
    done = call("check", *arguments)
    assert status is None or done.exit_code == status, done.output
    return done


# Words that are right -------------------------------------------------------------------------------------

PROGRAMS = {
    "yasnac-lx3": ("G00 X40. Z0.\nG111 A180. K-30. B120. X100. U50.{}", "U50."),
    "nct-99m": ("G17 G90 G0 X0 Y0\nG1 X30 Y20 ,A30{}", ",A30"),
    "fanuc-lathe": ("G00 X20. Z0.\nG01 Z-20. ,C40.{}\nX40.", ",C40."),
    "fanuc-mill": ("G17 G90 G00 X0 Y0\nG01 X40. ,C60.{}\nG01 X60. Y20.", ",C60."),
    "haas-lathe": ("G00 X20. Z0.\nG01 Z-20. K40.{}\nX40.", "K40."),
    "mitsubishi": ("G17 G90 G00 X0 Y0\nG01 X40. ,C60.{}\nG01 X60. Y20.", ",C60."),
    "siemens-840d": ("G17 G90 G0 X0 Y0\nG1 X30 ANG=-10 RND=50{}\nX40 Y40", "RND=50"),
    "siemens-808d": ("G17 G90 G0 X0 Y0\nG1 X30 ANG=-10 RND=50{}\nX40 Y40", "RND=50"),
    "isg": ("G17 G90 G0 X0 Y0\nG1 X30 #RND=5{}\nX40 Y40 I5", "I5"),
    "heidenhain": ("1 L X+0 Y+0 R0 F500\n2 FL AN+0 LEN30{}\n3 FL X+50 Y+30 AN+10", "AN+10"),
}
"""For each control a contour with a word that a fix would change, and the place of a comment."""


@pytest.mark.parametrize("control", PROGRAMS)
def test_no_fix_changes_a_word_that_is_right_whichever_way_it_is_said(control):
    text, word = PROGRAMS[control]
    said = CONTROLS[control].modes.syntax.remark.format(f"contoursolve trust: {word}")
    plain = text.format("")
    ways = {
        "not": (plain, {}),
        "option": (plain, {"trust": word}),
        "beside": (text.format(f" {said}"), {}),
        "alone": (f"{said}\n{plain}", {}),
        "spelled": (text.format(f" {said.replace('trust:', ': TRUSTED')}"), {}),
    }
    changing, shown = {}, {}
    for way, (program, options) in ways.items():
        found = solve(program, control=control, **options).diagnostics
        fixes = {fix.replacement.replace(f" {said}", "") for each in found for fix in each.fixes}
        shown[way] = {fix.partition(" (con")[0].partition(" ; con")[0] for fix in fixes}
        changing[way] = {fix for fix in fixes if word not in fix.split()}
    assert changing.pop("not")
    assert not any(changing.values())


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        ("Z-5.", "the program has no word Z-5.; it has Z0."),
        ("X100", "the program has no word X100; it has X40. and X100."),
        ("Q5.", "the program has no word Q5., and no word Q at all"),
        ("twenty", "write words such as Z-50."),
        ("", "write words such as Z-50."),
    ],
)
def test_what_is_trusted_is_there_or_it_is_said_what_may_be_meant(words, reason, tmp_path):
    part = tmp_path / "part.nc"
    part.write_text(START + TAPER)
    assert check(str(part), "--trust", words, status=2).output.rstrip().endswith(reason)
    with pytest.raises(ValueError, match="cannot be trusted"):
        solve(START + TAPER, trust=words)
    part.write_text(f"(contoursolve trust: {words})\n{START}{TAPER}")
    assert f"trusted-absent]: {words or ''}" in check(str(part), status=1).output
    assert reason in check(str(part)).output
    part.write_text(f"{START}{TAPER}(contoursolve trust: {words})")
    assert reason.replace("the program", "the contour").split(";")[0] in check(str(part), status=1).output


# Words that are compared ----------------------------------------------------------------------------------

CHAIN = "G00 X20. Z0.\nG01 Z-20. ,C5. {}\nX40. ,A170. ,R3. {}\nZ-40. {}\n"


@pytest.mark.parametrize(
    ("place", "words", "told"),
    [
        (0, "Z-20.", "info: Z-20. is met: the contour has Z-20.000 mm at the end of program line 2"),
        (0, "X20.1", "warning: X20.1 is 0.100 mm from the contour, which has X20.000 mm at the end of program line 2"),
        (1, "X40.", "info: X40. is met: the contour has X40.000 mm at the end of program line 3"),
        (2, "Z-4.", "warning: Z-4. is 36.000 mm from the contour, which has Z-40.000 mm at the end of program line 4"),
        (0, "U5.", "warning: U5. was not compared: it is an increment; name the coordinate of the end"),
        (0, ",A170.", "warning: ,A170. was not compared: it is no coordinate along Z and X"),
        (0, "Y5.", "warning: Y5. was not compared: it is no coordinate along Z and X"),
        (0, "five", "warning: five was not compared: write words such as Z-50."),
    ],
)  # fmt: skip
def test_a_reference_beside_a_block_is_compared_with_its_end(place, words, told):
    notes = ["" if at != place else f"(contoursolve reference: {words})" for at in range(3)]
    found = solve(CHAIN.format(*notes), control="fanuc-lathe")
    assert [f"{each.severity.value}: {each.message}" for each in found.diagnostics] == [told]
    plain = solve(CHAIN.format("", "", ""), control="fanuc-lathe")
    assert found.answers[0].contour == plain.answers[0].contour


def test_a_reference_for_the_program_is_compared_with_the_end_of_its_only_contour(tmp_path):
    part = tmp_path / "part.nc"
    part.write_text(START + TAPER)
    done = check(str(part), "--reference", "Z-47.3 X100.", status=0)
    assert (
        "warning[reference-missed]: Z-47.3 is 0.021 mm from the contour, which has Z-47.321 mm at its end"
        in done.output
    )
    assert "info[reference-met]: X100. is met" in done.output
    data = json.loads(check(str(part), "--reference", "X100.02", "--format", "json").output)
    values = data["diagnostics"][0]["values"]
    assert (values["expected"], values["actual"], round(values["off_by_mm"], 9)) == (100.02, 100.0, 0.01)
    part.write_text(f"(contoursolve reference: Z-47.3)\n{START}{TAPER}")
    assert "Z-47.3 is 0.021 mm from the contour" in check(str(part), status=0).output
    part.write_text(START + TAPER + "\n" + START + TAPER)
    assert (
        "the program has 2 contours (program lines 2, 4)" in check(str(part), "--reference", "Z-47.3", status=2).output
    )
    assert (
        "the program has 2 contours"
        in solve(f"(contoursolve reference: Z1.)\n{part.read_text()}").diagnostics[0].message
    )


def test_a_reference_to_what_is_not_solved_or_no_contour_is_not_compared():
    unsolved = solve(START + "G111 A180. B120. X100. (contoursolve reference: X100.)").diagnostics
    assert "X100. was not compared: the contour is not solved" in [each.message for each in unsolved]
    plain = solve("G00 X40. (contoursolve reference: X40.)\n" + START + TAPER).diagnostics
    assert [each.message for each in plain] == ["X40. was not compared: there is no contour in this line"]


@pytest.mark.parametrize(
    "text", [f"(contoursolve trust: A135.)\n{START}", f"{START}(contoursolve reference: X60.)\n", START]
)
def test_an_open_program_finds_what_solve_finds(text):
    text += "G111 A135. I10. K-12. B180. Z-40. (contoursolve reference: Z-40.)\n"
    program = OpenProgram(START)
    program.replace(text)
    program.check()
    assert program.diagnostics == solve(text).diagnostics
    program.replace(text.replace("A135.)", "A13.)").replace("X60.)", "X61.)"))
    program.check()
    assert program.diagnostics == solve(program.text).diagnostics
    program.replace(START + "G111 A135. I10. K-12. B180. Z-40.\n")
    program.check()
    assert program.diagnostics == solve(program.text).diagnostics
