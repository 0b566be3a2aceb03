"""Legal programs that are hardly meant: a warning with what was meant, which a setting switches off."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner
from vectors import BY_HAND as RIGHT, settings

from contoursolve import Severity, check
from contoursolve.cli import main

BACK = "G00 X40. Z0.\nG111 A180. K-30. B60. X100.\nG01 Z-60.\n"
FILLETS = "G17 G90\nG00 X0. Y0.\nG01 X60. ,R4. F150.\nY30. ,R4.\nX40. ,R4.\nY50.\nX0. ,R4.\nY0."
FRAME = "G17 G90\nG00 X0. Y0.\nG01 X80. Y0. ,C3. F300.\nX80. Y44. ,R6.\nX-45. Y50. ,R4.\nX45. Y65. ,C3.\nX0. Y65."
KNOB = "G18 G90 DIAMON\nG0 X10 Z1\nG1 Z-5 F0.15\nX16 ANG=60\nCT X40 Z30\nG1 Z-50 RND=2\nX60"
CONES = "G18 G90 DIAMON\nG0 X20 Z2\nG1 Z-15 F0.2\nX50 ANG=150\nZ-60\nX70 ANG=150\nZ-90\nX90 ANG=120\nZ-120"
FIXES = [
    ("yasnac-lx3", BACK, 2, "write B120. for B60."),
    ("fanuc-mill", FILLETS, 6, "add ,R4. to program line 6"),
    (
        "isg",
        "G17 G90\nG0 X0 Y0\nG1 X60 F500 #CHR=2\nY40 #CHR=2\nX30\nY60 #CHR=2\nX0",
        5,
        "add #CHR=2 to program line 5",
    ),
    ("isg", "G17 G90\nG0 X0 Y0\nG1 X70 F400\nG302 I2\nG1 Y45\nG310 I5\nX10", 6, "write G301 for G310"),
    ("siemens-840d", CONES, 8, "write ANG=150 for ANG=120"),
    ("fanuc-mill", FRAME, 4, "write Y50. for Y44. (the start of the corner); write X45. for X-45."),
    ("siemens-840d", KNOB, 4, "write ANG=120 for ANG=60 (the angle from the other side); write Z-30 for Z30"),
    (
        "yasnac-lx3",
        "G00 X40. Z0.\nG111 A180. K-20. B150. X60.\nG111 A180. K-20. B150. X80.\nG111 A180. K-20. B120. X100.",
        4,
        "write B150. for B120.",
    ),
]


@pytest.mark.parametrize(("control", "text", "line", "fix"), FIXES)
def test_what_is_hardly_meant_is_a_warning_with_what_was_meant(control, text, line, fix):
    (finding,) = check(text, control=control)
    assert (finding.code, finding.severity, finding.span.line) == ("suspected", Severity.WARNING, line)
    assert finding.fixes[0].description.startswith(fix)
    assert not check(text, control=control, settings={f"{control}.suspicions": "off"})


OUTSIDE = "G00 X16. Z2.\n{} G01 Z0. F0.15\nX20. ,C1.\nZ-25. ,R3.\nX30.\nG40 G00 X{}."
BORE = "G00 X60. Z2.\n{} G01 Z0. F0.15\nX40. ,C1.\nZ-25. ,R3.\nX30.\nZ-40.\nG40 G00 X{}."


@pytest.mark.parametrize("control", ["fanuc-lathe", "haas-lathe"])
@pytest.mark.parametrize(
    ("text", "away", "wrong", "right"), [(OUTSIDE, 34, "G41", "G42"), (BORE, 26, "G42", "G41")], ids=["outside", "bore"]
)
def test_a_compensation_into_the_material_is_told_where_the_path_leaves_no_doubt(control, text, away, wrong, right):
    (finding,) = check(text.format(wrong, away), control=control)
    assert (finding.code, finding.span.line) == ("suspected", 2)
    assert finding.fixes[0].description.startswith(f"write {right} for {wrong} in program line 2")
    assert not check(text.format(right, away), control=control)
    # A tool that leaves through what would be the material tells that it is the other side.
    assert not check(text.format(wrong, 60 - away), control=control)


@pytest.mark.parametrize("right", RIGHT)
def test_right_programs_are_told_nothing(right):
    named = settings(right["control"], right)
    found = check("\n".join(right["program"]), control=right["control"], settings=named)
    assert [each for each in found if each.severity is not Severity.INFO] == []


def test_a_suspicion_is_no_error_and_is_switched_off_in_three_ways(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def run(text, *options):
        Path("part.nc").write_text(text)
        done = CliRunner().invoke(main, ["check", "part.nc", "--format", "json", *options])
        return done.exit_code, [each["code"] for each in json.loads(done.stdout)["diagnostics"]]

    assert run(BACK, "--control", "yasnac-lx3") == (0, ["suspected"])
    assert run(BACK, "--control", "yasnac-lx3", "--setting", "yasnac-lx3.suspicions=off") == (0, [])
    assert run("(contoursolve control: yasnac-lx3, suspicions: off)\n" + BACK) == (0, [])
    Path("contoursolve.toml").write_text('control = "yasnac-lx3"\n\n[yasnac-lx3]\nsuspicions = "off"\n')
    assert run(BACK) == (0, [])
    assert run(BACK, "--setting", "yasnac-lx3.suspicions=on") == (0, ["suspected"])
