"""Whole programs of each control with G41 and G42 (RL and RR): the path that is written, against points of the part."""

import re
from pathlib import Path

import numpy
import pytest
from calling import call
from oracle_tool import TIPS, clearance, parts_of, run

KLARTEXT = """\
0 BEGIN PGM K MM
1 TOOL CALL 1 Z S2000 F300
2 L Z+50 R0 FMAX M3
3 L X-30 Y-30 R0 FMAX
4 L Z-5 F AUTO
5 L X+0 Y+10 RL F300
6 L IY+50
7 RND R6
8 L X+40 Y+80
9 CHF 5
10 L X+80
11 CC X+80 Y+60
12 C X+100 Y+60 DR-
13 LP PR+30 PA-90
14 CR X+60 Y+0 R+30 DR-
15 L X+15
16 L Y-30 R0 FMAX M9
17 L X+200 Y-30 FMAX
18 L X+200 Y+0 RR F300
19 FL AN+90 LEN40
20 RND R6
21 FL AN+0 LEN40
22 L X+260
23 L X+300 Y-20 R0 FMAX M30
24 END PGM K MM
"""
TURNED = "{0}\nT0101\nG00 X16. Z2.\nG42 G01 Z0. F0.2\n{1}\nG40 G00 X120.\nG00 Z60.\nM30\n"
MILLED = "{0}\nT1 D1\nG00 X-20. Y-20.\nG41 G01 X0. Y8. D1 F300\n{1}\nX12.\nG40 G00 Y-20.\nM30\n"
COMMA = "Y30. ,R6.\nX40. ,C3.\nY20.\nG03 X50. Y10. R10.\nG01 X60. Y8.\nY0."
ASSIGNED = "Y30 RND=6\nX40 CHR=3\nY20\nG3 X50 Y10 CR=10\nG1 X60 Y8\nY0"
PROGRAMS = {
    "heidenhain": (KLARTEXT, 4, None, 2),
    "fanuc-mill": (MILLED.format("G21 G17 G90", COMMA), 4, None, 1),
    "haas-mill": (MILLED.format("G21 G17 G90", COMMA), 4, None, 1),
    "nct-99m": (MILLED.format("G21 G17 G90", COMMA), 4, None, 1),
    "mitsubishi": (MILLED.format("G21 G17 G90", COMMA), 4, None, 1),
    "isg": (MILLED.format("G17 G90", "Y30 #RND=6\nX40 #CHR=3\nY20\nG03 X50 Y10 R10\nG01 X60 Y8\nY0"), 4, None, 1),
    "siemens-840d": (MILLED.format("G17 G90", ASSIGNED), 4, None, 1),
    "siemens-808d": (MILLED.format("G17 G90", ASSIGNED.replace("CHR", "CHF")), 4, None, 1),
    "fanuc-lathe": (TURNED.format("G21", "X20. ,C2.\nZ-15. ,R3.\nX30. Z-40. ,R10.\nX60."), 0.8, 3, 1),
    "haas-lathe": (TURNED.format("G21", "X20. ,C2.\nZ-15. ,R3.\nX30. Z-40. ,R10.\nX60."), 0.8, 3, 1),
    "yasnac-lx3": (TURNED.format("", "X40.\nZ-15.\nG111 X100. A180. K-30. B120. P5. Q5.\nG01 Z-80."), 0.8, 3, 1),
}


@pytest.mark.parametrize("control", PROGRAMS)
def test_a_whole_program_of_each_control(control: str, tmp_path: Path):
    text, radius, tip, count = PROGRAMS[control]
    (tmp_path / "a.nc").write_text(text)
    words = ["--control", control, *(("--tip", str(tip)) if tip is not None else ())]
    contours = run("solve", "--format", "json", "--tool", f"R{radius}", *words, str(tmp_path / "a.nc"))["contours"]
    new = tmp_path / "new.nc"
    made = ["expand", *words, "--tool", f"R{radius}", "--no-comments", str(tmp_path / "a.nc"), "-o", str(new)]
    done = call(*made)
    assert (done.exit_code, len(contours)) == (0, count), done.output
    assert not re.search(r"\b(?:G4[012]|R[LR]|RND|CHF|CHR|FL)\b|,[RC]", new.read_text())
    assert ("D1" in new.read_text()) == (control in ("siemens-840d", "siemens-808d", "isg"))
    written = run("solve", "--format", "json", "--tool", "R0", "--side", "left", *words, str(new))["contours"]
    pieces = [part for contour in written for part in parts_of(contour["elements"])]
    for contour in contours:
        for piece in parts_of(contour["tool"]["elements"]):
            at = piece.at(numpy.linspace(0, 1, 50))[0]
            assert clearance(at, pieces).max() < 0.002
            off = clearance(at - radius * TIPS[tip or 0], parts_of(contour["elements"])) - radius
            assert abs(off).max() < 1e-6


CALLED = """\
0 BEGIN PGM K3 MM
1 TOOL CALL 1 Z S2000 F300
2 L Z+50 R0 FMAX M3
3 L X-30 Y-30 R0 FMAX
4 L Z+0 FMAX
5 CALL LBL 1
6 CALL LBL 1
7 CC X+220 Y+20
8 L X+220 Y+20 FMAX
9 L X+230 Y+20 RL F300
10 CP IPA+720 IZ-4 DR+
11 CP IPA+360 DR+
12 L X+221 Y+20 R0
13 C X+221 Y+20 DR+
14 L Z+50 FMAX M30
15 LBL 1
16 L IZ-2 FMAX
17 {0}L X+0 Y+10 RL F300
18 L Y+60
19 RND R6
20 L X+40
21 L Y+0
22 L X+15
23 L X-30 Y-30 R0 FMAX
24 LBL 0
25 END PGM K3 MM
"""


def test_an_approach_that_is_not_followed_is_no_entry(tmp_path: Path):
    (tmp_path / "a.h").write_text(CALLED.format("APPR LT X+0 Y+10 LEN10 RL F300 ;"))
    done = call("check", "--control", "heidenhain", "--tool", "R4", tmp_path / "a.h")
    assert (done.exit_code, "error[tool-not-followed]: APPR LT in program line 18 leads to" in done.stdout) == (1, True)


def test_a_finding_in_another_file_names_the_call_and_the_file(tmp_path: Path):
    lines = ["G17 G90 G71 G94", "T1 D1 M6", "G0 X-20 Y-20 Z5", "G1 Z-3 F100", "KONTUR", "G0 Z10", "M30"]
    (tmp_path / "a.mpf").write_text("\n".join(lines) + "\n")
    (tmp_path / "KONTUR.SPF").write_text("G42 G1 X0 Y-10 F500\nY40 RND=2\nX60\nY-10\nG40 G1 X90 Y-30\nM17\n")
    for words in (["check"], ["expand", "--inline"]):
        done = call(*words, "--control", "siemens-840d", "--tool", "R4", tmp_path / "a.mpf")
        assert done.exit_code == 1
        assert "2.0000 mm too small for the cutter R4 (program line 2 of KONTUR.SPF)\n" in done.output
        assert "a.mpf:5:1\n" in done.output
        assert "5 | KONTUR\n" in done.output


def test_facing_and_boring_with_a_tool_of_their_own(tmp_path: Path):
    """G72 before G70 under G41, and a bore with G41 in its profile: the way back goes to where the cycle was called."""
    facing = ["G72 W2. R0.5", "G72 P100 Q200 U0.4 W0.1 F0.25", "N100 G00 Z-20.", "G01 X60. F0.1", "X40. ,R3.", "Z-10."]
    facing = [
        "G00 X62. Z2.",
        *facing,
        "X20.",
        "N200 Z0.",
        "T0202",
        "G00 X62. Z2.",
        "G41",
        "G70 P100 Q200",
        "G40 G00 X100.",
    ]
    bore = [
        "T0303",
        "G00 X18. Z2.",
        "G71 U1. R0.5",
        "G71 P300 Q400 U-0.4 W0.1 F0.2",
        "N300 G00 G41 X30.",
        "G01 Z0. F0.1",
    ]
    bore += ["X26. Z-2. ,R1.", "Z-20. ,R2.", "X18.", "N400 G40 X17.", "G70 P300 Q400", "G00 Z50.", "M30"]
    (tmp_path / "a.nc").write_text("\n".join(["G21 G40 G99", "T0101", *facing, *bore]) + "\n")
    (tmp_path / "contoursolve.toml").write_text(
        "[tools]\nT0101 = {radius = 0.8, tip = 3}\nT0202 = {radius = 0.8, tip = 3}\nT0303 = {radius = 0.4, tip = 2}\n"
    )
    words, new = ["--control", "fanuc-lathe", "--tool", "program"], tmp_path / "new.nc"
    done = call("expand", *words, "--no-comments", str(tmp_path / "a.nc"), "-o", str(new))
    assert done.exit_code == 0, done.output
    text = new.read_text()
    # An inside arc of 3 becomes one of 2.2.
    assert "G01 X44.4 Z-20.\nG03 X40. Z-17.8 I0. K2.2\n" in text
    assert "G01 X20. Z-0.8\nG00 X62. Z2.\n" in text
    assert "G03 X22.8 Z-20. I-1.6 K0.\nG01 X18.8 Z-20.\nG01 X17. Z-20.\nG00 Z2. X18.\n" in text
    assert call("diff", *words, str(tmp_path / "a.nc"), str(new)).exit_code == 0
