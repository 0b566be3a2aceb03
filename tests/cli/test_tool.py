"""The tool on the command line: how it is stated, and what is said of it."""

import json
from itertools import product
from pathlib import Path

import pytest
from calling import COMPENSATED, NOSE, block, call, data

LATHE, MILL = ("--control", "fanuc-lathe"), ("--control", "fanuc-mill")
TAPER = block("X20. Z0. / G01 X20. Z-10. / X30. Z-20. / X30. Z-30.")


# How it is stated -------------------------------------------------------------------------------------------------

NO_MATTER = "T1 M6\nG00 X0 Y0\nM30\n"


@pytest.mark.parametrize(
    ("words", "text", "told"),
    [
        (("--tool", "R-1", "--tip", "3"), "", "the radius of the tool is R-1; it must not be less than 0"),
        (("--tool", "R0.8", "--tip", "12"), "", "there is no tip 12; the tips have the numbers 0 to 9"),
        (("--tool", "R0.8"), "", "a turning tool needs the number of its imaginary tip"),
        (("--tool", "8mm", "--tip", "3"), "", "'8mm' is no tool; write R8\n"),
        (("--tool", "R0,8", "--tip", "3"), "", "'R0,8' is no tool; write R0.8\n"),
        (("--tool", "R0.8 tip3", "--tip", "3"), "", "'R0.8 tip3' is no tool; write R0.8, tip 3\n"),
        (("--tool", "R0,8; tip 3", "--tip", "3"), "", "write R0.8, tip 3\n"),
        (("--tool", "R0.8, 3", "--tip", "3"), "", "write R0.8, tip 3\n"),
        (("--tool", "R0.8, tip 2", "--tip", "3"), "", "the tool has tip 2 and tip 3; leave one out"),
        (("--tool", "D1.6"), "", "write its radius and, on a lathe, its tip, such as R0.8, tip 3"),
        (("--tip", "3"), "", "--tip goes with --tool"),
        ((), "", "--side goes with --tool"),
        ((*NOSE, "--side", "right"), "", "--side is given several times"),
        (("--tool", "program"), "", "nothing says which tool cuts program line 4"),
        ((), "(contoursolve tool: R0,8)", "program line 1: 'R0,8' is no tool; write R0.8"),
        ((), "(contoursolve tool R0.8)", "states no tool; write (contoursolve tool: R0.8, tip 3)"),
        ((), "(contoursolve tol: R0.8)", "states no tool; write (contoursolve tool: R0.8, tip 3)"),
        ((), "(contoursolve TOOLS: R0.8)", "states no tool; write (contoursolve tool: R0.8, tip 3)"),
    ],
)
def test_what_is_no_tool_is_told_in_one_sentence(words, text, told):
    text = f"{text}\n{COMPENSATED}" if text else COMPENSATED.replace("G42 ", "").replace("G40 ", "")
    side = () if "contoursolve" in text else ("--side", "left")
    for command in ("check", "solve", *(["expand"] if words or side else [])):
        done = call(command, *LATHE, *words, *side, "-", stdin=text)
        assert (done.exit_code, done.stdout) == (2, "")
        assert told in done.stderr


@pytest.mark.parametrize(
    ("words", "text", "told"),
    [
        ((*LATHE, *NOSE), "G00 X20. Z0.\nG01 Z-10.\n", "nothing says on which side of the contour"),
        ((*LATHE, *NOSE, "--side", "left"), COMPENSATED, "side left is against G42 in program line 3"),
        ((*MILL, *NOSE, "--side", "left"), "G00 X0 Y0\nG01 X5. Y5.\n", "a cutter has no imaginary tip"),
        ((*MILL, "--tool", "R5"), NO_MATTER, "no cutting move goes beside a contour"),
        ((*LATHE, *NOSE), COMPENSATED.replace("G42", "G41 G42"), "G41 and G42 stand together in program line 3"),
        ((*LATHE, *NOSE), COMPENSATED.replace("G42", "G42 G40"), "G40 and G42 stand together in program line 3"),
        ((*LATHE, *NOSE), COMPENSATED.replace("G42", "G42 G42"), None),
        ((*LATHE, *NOSE, "--side", "right"), COMPENSATED, None),
        ((*LATHE, *NOSE, "--side", "right", "--side=right"), COMPENSATED, None),
    ],
)
def test_what_the_program_lacks_or_says_otherwise_is_told(words, text, told):
    for command in ("check", "expand"):
        done = call(command, *words, "-", stdin=text)
        assert done.exit_code == (2 if told else 0)
        assert not told or told in done.stderr


@pytest.mark.parametrize("command", ["range", "sweep", "find"])
def test_a_family_has_the_tool_as_a_word(command):
    done = call(command, "--tool", "R5", "--block", "G01 X1.")
    assert (done.exit_code, "here the tool is a word: --word tool, or --vary tool=" in done.stderr) == (2, True)


@pytest.mark.parametrize(
    ("row", "told"),
    [
        ("T0101 = {radius = -1}", "tools.T0101: the radius of the tool is R-1; it must not be less than 0"),
        ("T0101 = {radius = 0.8, tip = 12}", "tools.T0101: there is no tip 12"),
        ("X1 = {radius = 0.8}", "tools.X1: it is no tool; write T0101"),
        ("T0202 = {radius = 0.8, tip = 3}", "T0101 in program line 1 has no row in the table of tools"),
        ("T0101 = {radius = 0.8, tip = 3}\nT101 = {radius = 0.4, tip = 3}", "T0101 and T101 in the table of tools"),
        ("D1 = {radius = 5}\nD01 = {radius = 6}", "D1 and D01 in the table of tools name one tool; leave one out"),
    ],
)
def test_a_row_of_the_table_is_named(row: str, told: str, tmp_path):
    (tmp_path / "a.nc").write_text(f"T0101\n{COMPENSATED}")
    (tmp_path / "contoursolve.toml").write_text(f"[tools]\n{row}\n")
    done = call("check", *LATHE, "--tool", "program", tmp_path / "a.nc")
    assert (done.exit_code, told in done.stderr) == (2, True)
    assert "contoursolve.toml" in done.stderr or "in the table of tools" in done.stderr


# What is said of it -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("tool", "side", "blocks", "needed"),
    [
        ("R0.4, tip 3, back {}", "right", "X30. Z0./G01 X30. Z-10./X18.453 Z-20.", 30.0),
        ("R0.4, tip 2, back {}", "left", "X30. Z0./G01 X30. Z-10./X40. Z-20.", 26.5651),
        ("R0.4, tip 3, front {}", "right", "X30. Z-10./G01 X50. Z-9.5", 2.8624),
        ("R0.4, tip 4, back {}", "left", "X20. Z-30./G01 X20. Z-20./X10. Z-12.", 32.0054),
    ],
)
def test_flanks_that_are_stated(tool: str, side: str, blocks: str, needed: float):
    words = block(blocks.replace("/", " / "))
    for stated, is_free in ((needed - 0.01, False), (needed + 0.01, True)):
        done = call("check", *LATHE, "--side", side, "--tool", tool.format(round(stated, 4)), *words)
        assert (f"clearance of {needed:.3f} deg" in done.stdout, done.exit_code) == (not is_free, int(not is_free))


PLATE = """\
T1 M6
G90 G17 G54 G00 X-20. Y-20.
G01 G41 X0. Y-8. D1 F100
Y40. ,R6. F300
X40. ,C2.
<<MIDST>>
Y0.
X-8.
G40 G00 X-20. Y-20.
"""
"""A plate with overlapping run-in and run-off."""


@pytest.mark.parametrize(
    ("row", "text", "told"),
    [
        ("D1 = {radius = 0}", PLATE, "info[tool-no-radius]"),
        ("D2 = {radius = 5}", PLATE, "D1 in program line 3 has no row"),
        # M6 changes the tool that T makes ready.
        ("T1 = {radius = 4.5}\nT2 = {radius = 4}", PLATE.replace("G90", "T2\nG90"), "the centre for cutter R4.5,"),
    ],
)
def test_the_tool_of_the_table_is_the_one_in_force(row, text, told, tmp_path):
    (tmp_path / "a.nc").write_text(text.replace("<<MIDST>>\n", ""))
    (tmp_path / "contoursolve.toml").write_text(f"[tools]\n{row}\n")
    assert any(told in call(each, *MILL, "--tool", "program", tmp_path / "a.nc").output for each in ("check", "expand"))


def lines(control: str, *blocks: str) -> str:
    return "\n".join([f"(contoursolve control: {control})", *blocks]) + "\n"


TURN = ("G42 G01 Z0. F0.1", "X30. Z-10.", "Z-30.", "X40.", "G40 G00 X60. Z50.")
BARE = ("G00 X20. Z2.", "G01 Z0.", "X30. Z-10.", "Z-30.", "X40.", "G00 X60. Z50.")
AGAIN = ("G42 G00 X20. Z2.", "G01 Z0.", "X30. Z-10.", "Z-30.", "G40 G00 X60.", "M30")
ISLAND = ("G41 D1 G01 X-30. F500", "Y30.", "X30.", "Y-30.", "X-40.", "G40 Y-50.")


@pytest.mark.parametrize(
    ("blocks", "told"),
    [
        (("T0101", "G00 X20. Z2.", *TURN, "T0202", *BARE), {"12: tool-uncompensated"}),
        (("T0101", "G00 X20. Z2.", *TURN, "G00 X42. Z0.", "G01 X0.", "G00 Z2."), {"10: tool-stub"}),
        (("T0101", "G00 X42. Z0.", "G01 X-1.6", "G00 X20. Z2.", *TURN), set()),
        (("G00 X20. Z2.", *TURN, "G00 X42. Z-20.", "G01 X30.", "G00 X42."), set()),
        (
            ("G00 X20. Z2.", *TURN, "G00 X42. Z-20.", "G01 X30.", "X42.", "G00 Z-24.", "G01 X30.", "Z-20.", "X42."),
            set(),
        ),
    ],
)
def test_what_cuts_without_compensation_beside_a_contour_with_it(
    blocks: tuple[str, ...], told: set[str], tmp_path: Path
):
    """The taper of 26.57 degrees of U-6, and a face that stops at the axis."""
    (tmp_path / "a.nc").write_text(lines("fanuc-lathe", *blocks))
    done = call("check", "--format", "json", *NOSE, tmp_path / "a.nc")
    found = [each for each in json.loads(done.stdout)["diagnostics"] if each["severity"] == "warning"]
    assert {f"{each['line']}: {each['code']}" for each in found} == told
    assert all("comes out 0.2733 mm too thick" in each["message"] for each in found if "uncomp" in each["code"])


def test_a_pass_of_a_cutter_without_compensation_is_not_judged(tmp_path: Path):
    again = [each.replace("G41 D1 ", "").replace("G40 ", "") for each in ISLAND]
    (tmp_path / "a.nc").write_text(lines(MILL[1], "G00 X-40. Y-20.", *ISLAND, "G00 Y-20.", *again))
    told = call("check", "--tool", "R5", tmp_path / "a.nc").stdout
    assert "info[tool-not-judged]: program lines 10 to 15 cut without G41" in told


@pytest.mark.parametrize(
    ("start", "depth", "begin", "end", "told"),
    [
        ("X0. Y0.", "G01 Z-5.", "X-30. Y0.", "X0.", {"entry", "exit"}),
        ("X-40. Y0.", "G01 Z-5.", "X-30. Y0.", "X-50.", set()),
        ("X-40. Y0.", "G01 Z-5.", "X-30. Y0.", "X0.", {"exit"}),
        # Above the part, nothing is cut.
        ("X0. Y0.", "G00 Z5.", "X-30. Y0.\nG01 Z-5.", "X-50.", set()),
    ],
)
def test_the_moves_to_a_contour_and_away_go_around_it(
    start: str, depth: str, begin: str, end: str, told: set[str], tmp_path: Path
):
    blocks = (f"G00 {start}", f"{depth} F200", f"G41 D1 {begin}", "Y30.", "X30.", "Y-30.", "X-30.", "Y0.", f"G40 {end}")
    (tmp_path / "a.nc").write_text(lines(MILL[1], *blocks))
    found = call("check", "--tool", "R5", tmp_path / "a.nc").stdout
    assert {each for each in ("entry", "exit") if f"[tool-{each}-through]" in found} == told


@pytest.mark.parametrize(
    ("blocks", "told"),
    [
        (("G40 G00 X60.", "M30"), None),
        (("G40 G00 X60.", "G28 U0 W0", "M30"), None),
        (("M30",), "still-on: G42 is still in force at program line 8"),
        (("G00 X60.", "M30"), "still-on: G42 is still in force at program line 9"),
        (("T0202", "G40 G00 X60.", "M30"), "still-on: G42 is still in force at program line 8"),
        (("G00 X60.", "T0202", "G40", "M30"), "still-on: G42 is still in force at program line 9"),
        (("G28 U0 W0", "G40", "M30"), "still-on: G42 is still in force at program line 8"),
        (("G28 U0 W0", "G00 X60.", "G40", "M30"), "interrupted: program line 8 (G28: reference point return)"),
        (("G28 U0 W0", "G40", *AGAIN), "still-on: G42 is still in force at program line 8"),
        (("G28 U0 W0", *AGAIN), "interrupted: program line 8 (G28: reference point return)"),
        (("G40 G28 U0 W0", *AGAIN), None),
        (("G40", "G28 U0 W0", "M30"), None),
    ],
)
def test_compensation_that_does_not_end_behind_a_contour_is_told(blocks: tuple[str, ...], told: str | None):
    head = ("G21 G40 G18", "T0101", "G00 X20. Z2.", "G42 G01 Z0. F0.1", "X30. Z-10.", "Z-30.", "X40.")
    found = data("check", *LATHE, *NOSE, "-", stdin="\n".join((*head, *blocks)))["diagnostics"]
    ends = [each for each in found if each["code"] in ("tool-still-on", "tool-interrupted")]
    assert len(ends) == bool(told)
    assert told is None or f"{ends[0]['code']}: {ends[0]['message']}".startswith(f"tool-{told}")


@pytest.mark.parametrize(
    "blocks",
    [
        ("G00 X62. Z0.", "G01 X-1.6"),
        ("G00 X42. Z-20.", "G01 X30.", "G04 X0.5"),
        ("G00 X42. Z-20.", "G01 X30.", "X42."),
        ("G00 X0. Z2.", "G01 Z-20.", "Z2."),
    ],
)
def test_a_face_or_a_groove_by_the_tip_alone_is_right_on_either_side(blocks: tuple[str, ...], tmp_path):
    (tmp_path / "a.nc").write_text(text := lines("fanuc-lathe", *blocks, "G00 X62. Z2."))
    for side in ("left", "right"):
        done = call("check", *NOSE, "--side", side, tmp_path / "a.nc")
        assert done.stdout == "1 contour solved, no problems\n", done.stdout
    assert call("expand", *NOSE, "--side", "right", tmp_path / "a.nc").stdout == text


@pytest.mark.parametrize(
    ("control", "words", "blocks"),
    [
        ("fanuc-mill", ("--tool", "R5"), ("G00 X-40. Y-20.", *ISLAND[:-1], "G40 X-50. Y-40. I-1. J0.")),
        ("haas-lathe", NOSE, ("G00 X20. Z2.", *TURN[:-1], "G40 X45. Z-30. I1. K0.")),
    ],
)
def test_two_letters_beside_g40_are_a_wall_and_no_corners(
    control: str, words: tuple[str, ...], blocks: tuple[str, ...], tmp_path: Path
):
    (tmp_path / "a.nc").write_text(lines(control, *blocks))
    told = call("check", *words, tmp_path / "a.nc").stdout
    assert told.count("error[") == 1
    assert "beside G40, the direction of a wall) interrupts the contour" in told


@pytest.mark.parametrize(("code", "wrong"), [("G41", 1), ("G42", -1)])
def test_kont_goes_around_a_contour_where_the_way_begins_or_ends_on_its_other_side(code: str, wrong: int):
    starts = {f"X{off - 20} Y{-off - 20}": off * wrong for off in (-20, 0, 20)} | {"X-20": 1, "Y-20": 1}  # not known
    for (start, begin), end, word in product(starts.items(), (-20, 0, 20), ("KONT", "NORM")):
        line = ("X50 Y50", f"G40 X{80 + end} Y{80 - end}", "M30")
        blocks = (f"G17 G90 {word}", f"G0 {start}", f"{code} D1 G1 X0 Y0 F500", *line)
        found = data("check", "--control", "siemens-840d", "--tool", "R5", "-", stdin="\n".join(blocks))["diagnostics"]
        is_around = word == "KONT" and max(begin, end * wrong) > 0
        assert ("tool-not-followed" in {each["code"] for each in found}) == is_around, (start, end, word)


def test_a_closed_contour_that_begins_in_an_inside_corner(tmp_path: Path):
    lines = ["G90 G17 G00 X10. Y10.", "G41 D1 G01 X0 Y0 F100", "X60.", "Y40.", "X0", "Y0", "G40 X10. Y10."]
    for turned in (lines, [each.replace("G41", "G42") for each in (*lines[:2], "Y40.", "X60.", "Y0", "X0", lines[-1])]):
        (tmp_path / "a.nc").write_text("\n".join(turned) + "\n")
        text = call("check", *MILL, "--tool", "R5", tmp_path / "a.nc").stdout
        assert "help: begin the contour in the middle of an element, not in an inside corner" in text
        (contour,) = data("solve", *MILL, "--tool", "R5.0", tmp_path / "a.nc")["contours"]
        assert [each["largest_radius"] for each in contour["tool"]["faults"]] == [None]
        (found,) = data("find", "--word", "tool", *MILL, tmp_path / "a.nc")["contours"]
        assert found["stated"] is None


@pytest.mark.parametrize(
    ("radius", "told"),
    [
        ("R5", "2.0711 mm stays in it, 5.0000 mm and 5.0000 mm along"),
        ("R5.001", "the cutter R5.001 needs 10.0020 mm between its corners: 0.0020 mm short"),
    ],
)
def test_a_slot_as_wide_as_the_tool_is_cut_but_for_its_corners(radius: str, told: str):
    """A right angle keeps (√2 - 1) R of the tool, and R along both sides: between two of them a straight needs 2 R."""
    slot = ("G17 G90 G00 X0 Y30.", "G41 D1 G01 X-5. Y20. F500", "Y-10.", "X5.", "Y20.", "G40 X0. Y30.")
    text = call("check", *MILL, "--tool", radius, "-", stdin=lines(MILL[1], *slot)).stdout
    assert told in text
    assert ("tool-element-vanishes" in text) is (radius != "R5")
    assert "as the path of the centre" not in text


def test_what_leads_away_from_a_closed_contour_is_no_wall():
    around = ("G41 D1 G01 X-30. Y-45. F500", "Y-30.", "Y30.", "X30.", "Y-30.", "X-30.", "X-60.", "G40 Y-60.")
    text = lines(MILL[1], "G17 G90 G00 X-60. Y-60.", *around)
    assert "no problems" in call("check", *MILL, "--tool", "R5", "-", stdin=text).stdout


def test_what_is_not_followed_or_not_solved_is_told_once(tmp_path: Path):
    lines = ["G90 G17 G0 X0 Y0", "G41 G1 X20 Y0 F300 D1", "RND=50 X40", "X40 Y20", "G3 X20 Y0 TURN=X", "G40 X0", "M30"]
    (tmp_path / "a.mpf").write_text("\n".join(lines) + "\n")
    done = call("check", "--control", "siemens-840d", "--tool", "R5", tmp_path / "a.mpf")
    assert "the contour is not solved" not in done.stdout
    blocks = ["G90 G17 G00 X0 Y0", "G41 D1 G01 X20. Y0 F100", "Y20.", "G02 X40. Y20.", "G40 G00 X80."]
    for number, told in ((0, "program line 4 (the centre or the radius of the arc is not known) interrupts"), (2, "")):
        (tmp_path / "b.nc").write_text("\n".join([*blocks[:2], *blocks[2 + number // 2 :]]) + "\n")
        done = call("check", *MILL, "--tool", "R5", tmp_path / "b.nc")
        assert (
            told or "no tool cuts anything; program line 3 is not followed: the centre or the radius"
        ) in done.output


def test_a_tip_that_points_away_is_a_warning_for_every_radius(tmp_path):
    about = [*LATHE, "--tip", "3", "--side", "left", *TAPER]
    done = call("range", "--word", "tool", *about)
    assert (done.exit_code, "warning: program line 1: tip 3 points away from this straight" in done.output) == (0, True)
    rounded = [word.replace("Z-10.", "Z-10. ,R2.") for word in about]
    swept = call("sweep", "--vary", "tool=0.2:0.8:0.2", *rounded, "-o", tmp_path / "a.csv")
    assert swept.stdout.count("cut by the tool") == 4
    assert (tmp_path / "a.csv").read_text().count("True,0.8,tip_against_side") == 4
