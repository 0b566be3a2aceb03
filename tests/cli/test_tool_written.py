"""Paths of a tool that expand writes, without G41 and G42: in place of the contour, and of nothing else."""

import re
from pathlib import Path

import pytest
from calling import COMPENSATED, NOSE, call

LATHE, MILL = ("--control", "fanuc-lathe"), ("--control", "fanuc-mill")


TABLES = Path(__file__).parents[1] / "oracles" / "tool"


def lines(control: str, *blocks: str) -> str:
    return "\n".join([f"(contoursolve control: {control})", *blocks]) + "\n"


def test_diff_compares_a_contour_with_the_path_of_the_tool_beside_it(tmp_path: Path):
    (tmp_path / "a.nc").write_text(COMPENSATED)
    made = call("expand", *LATHE, *NOSE, tmp_path / "a.nc")
    (tmp_path / "b.nc").write_text(made.stdout)
    same = call("diff", *LATHE, *NOSE, tmp_path / "a.nc", tmp_path / "b.nc")
    assert (same.exit_code, same.stdout.splitlines()[0]) == (0, "equal: the same path to within 0.001 mm")
    other = call("diff", *LATHE, "--tool", "R0.4", "--tip", "3", tmp_path / "a.nc", tmp_path / "b.nc")
    assert (other.exit_code, "different" in other.stdout) == (1, True)
    plain = call("diff", *LATHE, *NOSE, tmp_path / "b.nc", tmp_path / "b.nc")
    assert (plain.exit_code, "neither program has G41 or G42 (RL or RR)" in plain.stderr) == (2, True)
    without = call("diff", *LATHE, "--tip", "3", tmp_path / "a.nc", tmp_path / "b.nc")
    assert (without.exit_code, "--tip goes with --tool" in without.stderr) == (2, True)


@pytest.mark.parametrize(
    ("source", "path", "words"),
    [
        ("flange.nc", "flange-tip.nc", ("--tool", "R0.8", "--tip", "3", "--side", "right", *LATHE)),
        ("plate.nc", "plate-centre.nc", ("--tool", "R4", "--side", "left", *MILL)),
    ],
)
def test_whole_programs_are_written_as_by_hand(source: str, path: str, words: tuple[str, ...], tmp_path):
    done = call("expand", TABLES / source, *words, "-o", tmp_path / "new.nc")
    assert done.exit_code == 0, done.stderr
    assert "1 contour expanded, at most 0.0006 mm off" in done.stderr or "at most 0.0005 mm off" in done.stderr
    done = call("diff", tmp_path / "new.nc", TABLES / path, *words[-2:], "--tolerance", "0.0012")
    assert done.exit_code == 0, done.stdout


def test_compensation_stays_where_a_contour_stays(tmp_path: Path):
    """A neck that the cutter does not pass, between two contours that it cuts; G41 and G40 stand alone."""
    good = ["G00 X{0}. Y0", "G41 D1", "G01 X{1}. Y0 F300", "Y20.", "G40", "G01 X{0}. Y30."]
    narrow = ["G00 X200. Y0", "G41 D1", "G01 X190. Y0", "Y20.", "X187.", "Y0", "G40", "G01 X200. Y-20."]
    first, last = ([line.format(place, place - 10) for line in good] for place in (100, 300))
    (tmp_path / "a.nc").write_text("\n".join(["G17 G90", *first, *narrow, *last]) + "\n")
    done = call("expand", *MILL, "--tool", "R4", "--keep-going", "--no-comments", tmp_path / "a.nc")
    text = done.stdout.splitlines()
    assert (done.exit_code, text.count("G41 D1"), text.count("G40")) == (1, 1, 1)
    assert all(line in text for line in narrow)
    assert text.index("G41 D1") > text.index("G01 X86. Y20.")
    unsolved = ["G01 X50. ,A45. ,R500.", "X60. Y60."]
    (tmp_path / "a.nc").write_text("\n".join(["G17 G90", *first, *unsolved]) + "\n")
    done = call("expand", *MILL, "--tool", "R4", "--keep-going", "--no-comments", tmp_path / "a.nc")
    assert (done.exit_code, "G41 D1" in done.stdout.splitlines()) == (1, True)


def test_a_change_of_the_side_is_told_and_written(tmp_path: Path):
    blocks = ["G17 G00 X-10. Y-10.", "G41 D1 G01 X0 Y0 F300", "Y20.", "X20.", "G42 Y40.", "X40.", "G40 X60."]
    (tmp_path / "a.nc").write_text("\n".join(blocks) + "\n")
    done = call("check", *MILL, "--tool", "R3", tmp_path / "a.nc")
    assert "warning[tool-switched]" in done.stdout
    text = call("expand", *MILL, "--tool", "R3", "--no-comments", tmp_path / "a.nc").stdout
    assert "G01 X20. Y23.\n(path of the centre for cutter R3, right of the contour)\nG01 X23. Y20.\n" in text


TURNED = """\
G21 G40 G99
T0101
G00 X62. Z2.
G71 U2. R0.5
G71 P100 Q200 U0.4 W0.1 F0.25
N100 G00 {0}X16.
G01 Z0. F0.1
X20. ,C2.
Z-15. ,R2.
X30.
X60. Z-40.
N200 {1}X62.
G00 X100. Z50.
T0202
{2}
{3}G70 P100 Q200
{4}G00 X100. Z50.
M30
"""
FINISHED = (
    "G01 X16. Z-0.469 F0.1|G01 X19.531 Z-2.234|G03 X20. Z-2.8 I-0.566 K-0.566|G01 X20. Z-13.8|G02 X22.4 Z-15. I1.2 K0."
)


@pytest.mark.parametrize("control", ["fanuc-lathe", "haas-lathe"])
@pytest.mark.parametrize(
    "words",
    [
        ("", "", "G00 X62. Z2.", "G42\n", "G40 "),
        ("", "", "G00 G42 X62. Z2.", "", "G40 "),
        ("G42 ", "G40 ", "G00 X62. Z2.", "", ""),
    ],
    ids=["before", "in a move", "in the profile"],
)
def test_the_finishing_pass_is_written_and_roughing_stays(words: tuple[str, ...], control: str, tmp_path):
    (tmp_path / "a.nc").write_text(TURNED.format(*words))
    (tmp_path / "contoursolve.toml").write_text(
        "[tools]\nT0101 = {radius = 1.6, tip = 3}\nT0202 = {radius = 0.8, tip = 3}\n"
    )
    given = ("--control", control, "--tool", "program")
    done = call("expand", *given, "--no-comments", tmp_path / "a.nc", "-o", tmp_path / "new.nc")
    assert done.exit_code == 0, done.stderr
    text = (tmp_path / "new.nc").read_text()
    assert not re.search(r"G4[012]", text)
    rough, behind = text.split("(G70 P100 Q200)\n")
    assert "G71 P100 Q200 U0.4 W0.1 F0.25\nN100 G00 X16.\nG01 Z0. F0.1\nG01 X20. Z-2.\n" in rough
    assert text.count("(path of the tip for nose R0.8, tip 3, right of the contour)") == 1
    assert FINISHED.replace("|", "\n") in behind
    assert behind.splitlines()[-3].startswith("G00 ")
    assert call("diff", *given, tmp_path / "a.nc", tmp_path / "new.nc").exit_code == 0
    found = call("check", *given, tmp_path / "a.nc")
    assert (found.exit_code, "warning" in found.stdout) == (0, False)


def test_what_of_a_finishing_pass_cannot_be_written_is_told(tmp_path: Path):
    (tmp_path / "a.nc").write_text(TURNED.format("", "", "G00 X62. Z2.", "G42\n", "G40 ").replace("G99", "G18"))
    done = call("expand", "--control", "mitsubishi", *NOSE, tmp_path / "a.nc")
    assert "program line 17: where the tool is after G70 is not known of this control" in done.stderr
    given, words = (*LATHE, *NOSE), ("G42 ", "G40 ", "G00 X62. Z2.", "", "")
    for old, new, told in (
        ("G70 P100 Q200", "", "G71 in program line 5 is not compensated (assumed), and no G70 cuts its profile"),
        ("G70 P100 Q200", "G70 P100 Q200 U0.2", "program line 16: U0.2 beside G70 cannot be written out"),
    ):
        (tmp_path / "a.nc").write_text(TURNED.format(*words).replace(old, new))
        done = call("expand", *given, tmp_path / "a.nc")
        assert (done.exit_code, told in done.stderr) == (2, True), done.stderr


@pytest.mark.parametrize(
    ("control", "words", "blocks"),
    [
        (
            "fanuc-lathe",
            NOSE,
            "G00 X20. Z2. / G42 G01 Z0. F0.1 / X30. Z-5. / Z-20. / G02 X40. Z-25. R5. / G01 Z-40. / X50. / G40 G00 Z9.",
        ),
        (
            "fanuc-lathe",
            NOSE,
            "G00 X16. Z2. / G42 G01 Z0. F0.1 / X20. ,C1. / Z-15. ,R3. / ,A150. X40. / Z-50. / G40 G00 X60. Z50.",
        ),
        (
            "fanuc-mill",
            ("--tool", "R5"),
            "G00 X-45. Y0. / G41 D1 G01 X-30. F500 / Y30. / X30. / Y-30. / X-30. / Y0. / G40 G00 X-45.",
        ),
    ],
)
def test_check_sees_the_path_by_hand_in_what_expand_writes(
    control: str, words: tuple[str, ...], blocks: str, tmp_path: Path
):
    (tmp_path / "a.nc").write_text(lines(control, *blocks.split(" / ")))
    assert call("expand", *words, tmp_path / "a.nc", "-o", tmp_path / "b.nc").exit_code == 0
    done = call("check", *words, "--side", "left" if control == MILL[1] else "right", tmp_path / "b.nc")
    assert (done.exit_code, "tool-by-hand" in done.stdout, done.stdout.count("[tool-")) == (0, True, 1), done.stdout


ISLAND = ("G41 D1 G01 X-30. F500", "Y30.", "X30.", "Y-30.", "X-40.", "G40 Y-50.")


def test_a_move_in_depth_under_compensation_is_the_same_path(tmp_path: Path):
    plunge = ("G00 X-40. Y-20.", "G41 D1 X-30. Y-20.", "Z2.", "G01 Z-5. F200", *ISLAND[1:])
    (tmp_path / "a.nc").write_text(lines(MILL[1], *plunge))
    assert call("expand", "--tool", "R5", tmp_path / "a.nc", "-o", tmp_path / "b.nc").exit_code == 0
    done = call("diff", tmp_path / "a.nc", tmp_path / "b.nc", "--tool", "R5")
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("way", "depths"),
    [
        ("Y-30 F500\nZ30\nX50\nY30 X48\nZ-30\nY-40", ["60", "50", "48"]),
        ("G91 Y10 F500\nZ50\nX-10\nY60 X-2\nZ-60\nY-70\nG90", ["60", "-10", "-2"]),
    ],
)
def test_a_depth_outside_the_plane_stays_the_diameter_that_it_was(way: str, depths: list[str]):
    text = f"G19 G90 DIAMON\nG0 Y-40 Z-20 X60\nG41 D1 G1 {way}\nG40 Y-60\nM30\n"
    found = call("expand", "--control", "siemens-840d", "--tool", "R5", "-", stdin=text).stdout
    assert re.findall(r"^[^;\n]*X(\S+)$", found, re.MULTILINE) == depths


CALLED = """\
O1000
G21 G17 G40 G90
T1 M06
G00 X-20. Y-20. Z5.
M98 P2000
G00 X80. Y-20.
#1=3.
M98 P3000
M30
O2000
G41 D1 G01 X0 Y-10. F200
Y30. ,R6.
X40. ,C3.
Y0
X-10.
G40 G00 X-20. Y-20.
M99
O3000
WHILE[#1GT0]DO1
G41 D1 G01 X100. Y-10. F200
Y[30.+#1] ,R6.
X140. ,C3.
Y0
X90.
G40 G00 X80. Y-20.
#1=#1-1.
END1
M99
"""
SINUMERIK = """\
G17 G90 G71 G94
T1 D1 M6
FOR R1=2 TO 6
G0 X-20 Y-20 Z5
G1 Z=-R1 F100
KONTUR
G0 Z10
ENDFOR
M30
"""
KONTUR = """\
G41 G1 X0 Y-10 F500
Y40 RND=6
X30 RND=6
ANG=-45 X60
Y-10
G40 G1 X90 Y-30
M17
"""


@pytest.mark.parametrize(
    ("text", "control", "count"), [(CALLED, "fanuc-mill", 4), (SINUMERIK, "siemens-840d", 5)], ids=["fanuc", "siemens"]
)
def test_a_program_with_calls_is_written_out_along_the_path_of_the_tool(
    text: str, control: str, count: int, tmp_path: Path
):
    (tmp_path / "a.nc").write_bytes(text.replace("\n", "\r\n").encode("latin-1"))
    (tmp_path / "KONTUR.SPF").write_text(KONTUR)
    words, new = ("--control", control, "--tool", "R4"), tmp_path / "new.nc"
    done = call("expand", *words, tmp_path / "a.nc")
    assert (done.exit_code, "no one path: expand it inline" in done.stderr) == (2, True)
    done = call("expand", *words, "--inline", tmp_path / "a.nc", "-o", new)
    assert (done.exit_code, f"{count} contours expanded" in done.stderr) == (0, True), done.stderr
    assert not re.search(rb"(?m)^[^;(\r\n]*(?:G4[12]|M98|WHILE|KONTUR)|[^\r]\n", new.read_bytes())
    assert call("diff", *words, tmp_path / "a.nc", new).exit_code == 0


def test_a_finding_about_a_call_names_the_line_of_the_program(tmp_path: Path):
    (tmp_path / "a.nc").write_text(CALLED.replace("X40. ,C3.", "X20. ,R2.\nY40. ,R1.\nX40."))
    words = (*MILL, "--tool", "R4", "--inline")
    done = call("expand", *words, tmp_path / "a.nc")
    assert (done.exit_code, done.stdout) == (1, "")
    assert "a.nc:13:6\n" in done.stderr
    assert "13 | X20. ,R2." in done.stderr
    (tmp_path / "a.nc").write_text(CALLED.replace("P3000\nM30", "P9000\nM30"))
    done = call("expand", *words, tmp_path / "a.nc")
    told = "program line 8: M98 P9000 calls 9000, which is not in this file"
    assert (done.exit_code, told in done.stderr) == (2, True)


def test_each_call_is_cut_by_the_tool_that_is_in_use(tmp_path: Path):
    """The same subprogram for two tools: the arc is too small for the second one alone."""
    stated = CALLED.replace("T1 M06", "T1 M06\nD1").replace("#1=3.\nM98 P3000", "T2 M06\nM98 P2000").split("O3000")[0]
    (tmp_path / "a.nc").write_text(stated.replace("X40. ,C3.", "X20. ,R5.\nY40. ,R1.\nX40."))
    (tmp_path / "contoursolve.toml").write_text("[tools]\nT1 = {radius = 4.0}\nT2 = {radius = 6.0}\n")
    done = call("check", *MILL, "--tool", "program", tmp_path / "a.nc")
    assert done.stdout.count("error[tool-arc-too-small]") == 1
    assert "radius 5.0000 mm is 1.0000 mm too small for the cutter R6" in done.stdout
