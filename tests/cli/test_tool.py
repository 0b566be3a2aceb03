"""The tool on the command line: how it is stated, what is said of it, and what is written."""

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from oracle_tool import run

from contoursolve.cli import main
from contoursolve.controls import TOOL_FACTS
from contoursolve.tool_radius import ToolFaultKind

TABLES = Path(__file__).parents[1] / "oracles" / "tool"
LATHE, MILL = ("--control", "fanuc-lathe"), ("--control", "fanuc-mill")
TAPER = ("--start", "X20. Z0.", "--block", "G01 X20. Z-10.", "--block", "X30. Z-20.", "--block", "X30. Z-30.")
NOSE = ("--tool", "R0.8", "--tip", "3")
COMPENSATED = """\
N1 G21 G40 G18
N5 G00 X40. Z5.
N6 G42 G00 X20. Z2. D1
N10 G01 Z-10. F0.2
N20 X30. Z-20.
N30 Z-30.
N40 G40 X50.
N50 G00 Z100.
"""


def call(*words: str | Path) -> Result:
    done = CliRunner().invoke(main, [str(word) for word in words])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exc_info
    return done


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (
            ("--tool", "R-1", "--tip", "3", "--side", "left"),
            "the radius of the tool is R-1; it must not be less than 0",
        ),
        (("--tool", "R0.8", "--tip", "12", "--side", "left"), "there is no tip 12; the tips have the numbers 0 to 9"),
        (("--tool", "8mm", "--tip", "3", "--side", "left"), "'8mm' is no tool; write R8"),
        (("--tool", "R0.8", "--side", "left"), "a turning tool needs the number of its imaginary tip"),
        (NOSE, "program line 1, G01 X20. Z-10.: nothing says on which side of the contour the tool runs"),
        (("--tool", "program", "--side", "left"), "nothing says which tool cuts program line 1"),
        (("--tip", "3"), "--tip goes with --tool"),
        (("--side", "left"), "--side goes with --tool"),
    ],
)
def test_what_is_no_tool_is_told_in_one_sentence(words: tuple[str, ...], told: str):
    for command in ("check", "solve", "expand"):
        done = call(command, *LATHE, *words, *TAPER)
        assert done.exit_code == 2
        assert told in done.stderr
        assert done.stdout == ""


def test_a_side_against_the_program_and_a_tip_of_a_cutter(tmp_path: Path):
    (tmp_path / "a.nc").write_text(COMPENSATED)
    done = call("check", *LATHE, *NOSE, "--side", "left", tmp_path / "a.nc")
    assert (done.exit_code, done.stderr.count("\n")) == (2, 1)
    assert "side left is against G42 in program line 3" in done.stderr
    assert call("check", *LATHE, *NOSE, "--side", "right", tmp_path / "a.nc").exit_code == 0
    done = call("check", *MILL, *NOSE, "--side", "left", "--start", "X0 Y0", "--block", "G01 X5. Y5.")
    assert "a cutter has no imaginary tip" in done.stderr


@pytest.mark.parametrize(
    ("statement", "table"),
    [
        ("(contoursolve tool: R0.8, tip 3)", ""),
        ("T0101", "[tools]\nT0101 = {radius = 0.8, tip = 3}\n"),
        ("(no tool)", "[tools]\nD1 = {radius = 0.8, tip = 3}\n"),
    ],
)
def test_a_program_states_its_tool(statement: str, table: str, tmp_path: Path):
    (tmp_path / "a.nc").write_text(f"{statement}\n{COMPENSATED}")
    (tmp_path / "contoursolve.toml").write_text(table)
    options = ("--tool", "program") if table else ()
    (contour,) = run("solve", "--format", "json", *LATHE, *options, str(tmp_path / "a.nc"))["contours"]
    assert (contour["tool"]["radius"], contour["tool"]["tip"], contour["tool"]["side"]) == (0.8, 3, "right")
    assert contour["lines"] == [5, 6, 7]
    assert contour["tool"]["elements"][-1]["end"] == [-30.8, 15.0]


def test_an_inch_program_states_an_inch_tool():
    blocks = ("--block", "G20 G18 G01 X.8 Z-.4", "--block", "X1.2 Z-.8", "--start", "X.8 Z0", "--units", "inch")
    words = ("--tool", "R.0315", "--tip", "3", "--side", "right")
    (contour,) = run("solve", "--format", "json", *LATHE, *words, *blocks)["contours"]
    assert contour["tool"]["radius"] == pytest.approx(0.8001)


def test_findings_name_the_word_what_fits_and_a_fix_that_was_tried():
    words = ("--tool", "R2.4", "--tip", "3", "--side", "right")
    done = call("check", *words, TABLES / "flange.nc")
    assert done.exit_code == 1
    text = done.stdout
    assert "the inside arc of radius 2.0000 mm is 0.4000 mm too small for the nose R2.4" in text
    assert "flange.nc:14:11" in text
    assert "a nose of radius up to 2.0000 mm cuts the whole contour (tried)" in text
    assert "write ,R2.4 for ,R2." in text
    assert "control: alarm 41 (derived)" in text
    assert text.endswith("2 contours solved, 1 error, 8 warnings, 1 info\n")
    log = json.loads(call("check", *words, "--format", "sarif", TABLES / "flange.nc").stdout)["runs"][0]
    told = {log["tool"]["driver"]["rules"][each["ruleIndex"]]["id"] for each in log["results"]}
    assert told == {"tool-arc-too-small", "tool-approach", "tool-uncompensated"}
    fixed = (TABLES / "flange.nc").read_text().replace(",R2.", ",R2.4")
    done = CliRunner().invoke(main, ["check", *words, "-"], input=fixed)
    assert done.exit_code == 0


def test_a_groove_and_a_neck_are_told_with_their_widths():
    groove = ["X30. Z-10.", "X20. Z-10.", "X20. Z-11.5", "X30. Z-11.5", "X30. Z-20."]
    blocks = [word for block in groove for word in ("--block", f"G01 {block}")]
    text = call("check", *LATHE, *NOSE, "--side", "right", "--start", "X30. Z0.", *blocks).stdout
    assert "the groove is 1.5000 mm wide; this nose needs 1.6000 mm" in text
    neck = ["G01 X-4. Y9.1652", "G03 X4. Y9.1652 I4. J-9.1652", "G01 X4. Y20."]
    blocks = [word for block in neck for word in ("--block", block)]
    words = ("--explain", "--tool", "R6", "--side", "left", "--start", "X-4. Y20.")
    text = call("check", *MILL, *words, *blocks).stdout
    assert "the cutter R6 cuts 4.0000 mm into program line 3 while it works on program line 1" in text
    assert "the control looks two moves ahead (printed): it finds this" in text
    round_ = ["G03 X-10. Y0 R10.", "X0 Y-10. R10.", "X10. Y0 R10.", "X4. Y9.1652 R10."]
    far = [neck[0], *round_, neck[2]]
    words = (*words[:-1], "X-4. Y20.", *(word for block in far for word in ("--block", block)))
    assert "ahead (printed): it does not find this" in call("check", *MILL, *words).stdout


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
    start, *others = blocks.split("/")
    words = ["--start", start, *(word for block in others for word in ("--block", block))]
    for stated, is_free in ((needed - 0.01, False), (needed + 0.01, True)):
        done = call("check", *LATHE, "--side", side, "--tool", tool.format(round(stated, 4)), *words)
        assert (f"clearance of {needed:.3f} deg" in done.stdout, done.exit_code) == (not is_free, int(not is_free))


def test_entry_and_exit(tmp_path: Path):
    program = COMPENSATED.replace("Z2. D1", "Z0.5").replace("Z5.", "Z1.").replace("X40.", "X20.")
    (tmp_path / "a.nc").write_text(program)
    text = call("check", *LATHE, *NOSE, tmp_path / "a.nc").stdout
    assert "warning[tool-entry-too-short]: the move to the contour is 0.5000 mm long, 0.3000 mm shorter" in text
    (tmp_path / "a.nc").write_text(COMPENSATED.replace("G42 G00 X20. Z2. D1", "G42 G03 X20. Z2. R20."))
    done = call("check", *LATHE, *NOSE, tmp_path / "a.nc")
    assert (done.exit_code, "control: alarm 34 (printed)" in done.stdout) == (1, True)


@pytest.mark.parametrize(
    ("tip", "radius", "blocks", "told"),
    [
        (3, "R0.8", "X0. Z0./G01 X18. Z0./X20. Z-1./X20. Z-20.", ["line comes out 0.3314 mm too thick"]),
        (3, "R0.8", "X0. Z0./G01 X14. Z0./G03 X20. Z-3. R3./G01 X20. Z-15.", ["0.3314", "it becomes radius 2.2000 mm"]),
        (3, "R0.8", "X20. Z0./G01 X20. Z-12./G02 X26. Z-15. R3./G01 X40. Z-15.", ["it becomes radius 3.8000 mm"]),
        (3, "R0.4", "X30. Z0./G01 X30. Z-10./X18.453 Z-20./X18.453 Z-30.", ["line comes out 0.2536 mm too deep"]),
        (3, "R0.8", "X0. Z0./G03 X20. Z-10. R10./G01 X20. Z-25.", ["it becomes radius 9.2000 mm"]),
        (
            3,
            "R0.8",
            "X20. Z0./G01 X20. Z-10./X30. Z-20./X30. Z-30.",
            ["0.2733", "0.6111 mm on the diameter, 0.6111 mm"],
        ),
        (8, "R0.8", "X20. Z0./G01 X20. Z-10./X30. Z-20./X30. Z-30.", ["line comes out 0.0845 mm too deep"]),
        (9, "R0.8", "X20. Z0./G01 X20. Z-10./X30. Z-20./X30. Z-30.", ["contour comes out 0.8000 mm too deep"]),
    ],
)
def test_what_comes_out_without_compensation(tip: int, radius: str, blocks: str, told: list[str]):
    start, *others = blocks.split("/")
    words = [word for block in others for word in ("--block", block)]
    done = call("check", *LATHE, "--tool", radius, "--tip", str(tip), "--side", "right", "--start", start, *words)
    assert (done.exit_code, done.stdout.count("[tool-uncompensated]")) == (0, 1)
    assert all(text in done.stdout for text in told)


HAND = """\
G21 G40 G18
G00 X16. Z2.
G00 X14.4 Z0.
G01 X19.4 F0.2
G03 X20.5314 Z-0.2343 R0.8
G01 X23.5314 Z-1.7343
G03 X24. Z-2.3 R0.8
G01 Z-17.0679
G00 X60. Z50.
"""
"""The face, the chamfer and the cylinder of a stud, X21. Z0., X24. Z-1.5, for nose R0.8 (sheet: TR-P1)."""


def test_a_path_that_is_made_by_hand_names_its_radius_and_its_part(tmp_path: Path):
    (tmp_path / "a.nc").write_text(HAND)
    done = call("check", *LATHE, *NOSE, "--side", "right", tmp_path / "a.nc")
    assert "the path is made by hand for a nose of radius 0.8000 mm" in done.stdout
    assert "the part goes through Z0.0000 X21.0001, Z-1.5000 X24.0000 and Z-16.2679 X24.0000" in done.stdout
    assert done.stdout.splitlines()[-1].endswith("1 info")
    smaller = call("check", *LATHE, "--tool", "R0.4", "--tip", "3", "--side", "right", tmp_path / "a.nc").stdout
    # The chamfer of 0.8 is 0.3314 too thick without compensation: for half of it, half of that, to the other side.
    assert "with the nose R0.4 this line comes out 0.1657 mm too deep" in smaller
    assert smaller.count("[tool-other-radius]") == 1


def test_one_arc_around_a_corner_shows_a_path_by_hand_where_all_of_the_part_is_round(tmp_path: Path):
    """The path of TR-1 with its only outside corner, and a contour with a rounding of that radius in its place."""
    blocks = "G00 X20. Z2.\nG01 Z-0.8 F0.2\nZ-10.611\nX29.831 Z-20.442\nG03 X30. Z-20.8 R0.8\nG01 Z-30.8\nG00 X60.\n"
    for text, is_by_hand in ((blocks, True), ("G00 X20. Z0.\nG01 Z-10. F0.2\nX30. Z-20. ,R0.8\nZ-30.\n", False)):
        (tmp_path / "a.nc").write_text(text)
        told = call("check", *LATHE, *NOSE, "--side", "right", tmp_path / "a.nc").stdout
        assert ("tool-by-hand" in told, "tool-uncompensated" in told) == (is_by_hand, not is_by_hand)


def test_roundings_of_the_radius_of_a_nose_are_no_path_by_hand():
    blocks = ("G01 X20. ,R0.8", "Z-10. ,R2.", "X30. ,R0.8", "Z-20.", "X50. Z-30. ,R0.8", "Z-40.")
    words = [word for block in blocks for word in ("--block", block)]
    done = call("check", *LATHE, *NOSE, "--side", "right", "--start", "X0. Z0.", *words)
    assert "tool-uncompensated" in done.stdout
    assert "tool-by-hand" not in done.stdout


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


# What is written --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("source", "path", "words"),
    [
        ("flange.nc", "flange-tip.nc", ("--tool", "R0.8", "--tip", "3", "--side", "right", *LATHE)),
        ("plate.nc", "plate-centre.nc", ("--tool", "R4", "--side", "left", *MILL)),
    ],
)
def test_whole_programs_are_written_as_by_hand(source: str, path: str, words: tuple[str, ...], tmp_path: Path):
    done = call("expand", TABLES / source, *words, "-o", tmp_path / "new.nc")
    assert done.exit_code == 0, done.stderr
    assert "1 contour expanded, at most 0.0006 mm off" in done.stderr or "at most 0.0005 mm off" in done.stderr
    done = call("diff", tmp_path / "new.nc", TABLES / path, *words[-2:], "--tolerance", "0.0012")
    assert done.exit_code == 0, done.stdout


def test_compensation_is_taken_out_and_all_else_stays(tmp_path: Path):
    (tmp_path / "a.nc").write_text(COMPENSATED)
    text = call("expand", *LATHE, *NOSE, "--no-comments", tmp_path / "a.nc").stdout
    assert text.splitlines() == [
        "N1 G21 G18",
        "N5 G00 X40. Z5.",
        "(path of the tip for nose R0.8, tip 3, right of the contour)",
        "N6 G00 X20. Z1.2",
        "N10 G01 X20. Z-10.611 F0.2",
        "N20 G01 X29.831 Z-20.442",
        "G03 X30. Z-20.8 I-0.716 K-0.358",
        "N30 G01 X30. Z-30.8",
        "N40 G01 X50. Z-30.",
        "N50 G00 Z100.",
    ]


@pytest.mark.parametrize("is_stated", [True, False])
def test_increments_lead_to_the_same_places(is_stated: bool, tmp_path: Path):
    """The same contour in absolute and in incremental words, with a move of a third axis in each of its rapids."""
    places = [(10, 10), (10, 35), (20, 45), (30, 35), (30, 10), (50, 0), (55, 5)]
    words = ["{0}G01 {1} F100", "{1}", "{1}", "G02 {1} I0 J-10.", "G01 {1}", "G00 Z9.\n{2}{1}", "G00 {1} Z5."]
    absolute, steps, before = ["G17 G90 G00 X0 Y0 Z9."], ["G17 G90 G00 X0 Y0 Z9.", "G91"], (0, 0)
    for place, word in zip(places, words, strict=True):
        codes = ("G41 ", "G40 ") if is_stated else ("", "")
        absolute.append(word.format(codes[0], f"X{place[0]}. Y{place[1]}.", codes[1]))
        step = word.format(codes[0], f"X{place[0] - before[0]}. Y{place[1] - before[1]}.", codes[1])
        steps.append(step.replace("Z5.", "Z-4.").replace("Z9.", "Z0"))
        before = place
    for name, lines in (("absolute.nc", absolute), ("steps.nc", steps)):
        (tmp_path / name).write_text("\n".join(lines) + "\n")
        side = () if is_stated else ("--side", "left")
        output = ("-o", tmp_path / f"new-{name}")
        done = call("expand", *MILL, "--tool", "R4", *side, "--no-comments", tmp_path / name, *output)
        assert done.exit_code == 0, done.stderr
        assert not re.search(r"G4[012]|D\d", (tmp_path / f"new-{name}").read_text())
    done = call("diff", tmp_path / "new-absolute.nc", tmp_path / "new-steps.nc", *MILL, "--tolerance", "0.005")
    assert done.exit_code == 0, done.stdout


@pytest.mark.parametrize(
    ("around", "loop"),
    [
        ("X10. Y-10./G03 X20. Y0 J10./X10. Y10. I-10./X0 Y0", "G03 X20. Y0 I-20. J0"),
        ("X-8. Y-10./G03 X0 Y-2. J8./G03 X-8. Y8. I-8./X-20. Y20.", "G01 Y30./X40./Y-20./X0/Y0"),
    ],
)
def test_arcs_that_lead_to_a_closed_contour_are_no_walls(around: str, loop: str, tmp_path: Path):
    start, arc, behind, end = around.split("/")
    blocks = ["G17 G90 G00 X-20. Y-30.", f"G41 D1 G01 {start} F300", arc, *loop.split("/"), behind, f"G40 G01 {end}"]
    twice = [*blocks[:-1], f"G01 {end}", "Z-10.", start, *blocks[2:]]
    for lines, radius in ((blocks, "R6"), (twice, "R2")):
        (tmp_path / "a.nc").write_text("\n".join(lines) + "\n")
        done = call("expand", *MILL, "--tool", radius, tmp_path / "a.nc")
        assert done.exit_code == 0, done.stderr
    done = call("check", *MILL, "--tool", "R12", tmp_path / "a.nc")
    assert "inside arc of radius" in done.stdout


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


def test_no_alarm_is_invented():
    printed = {
        *(
            "33",
            "34",
            "41",
            "340",
            "341",
            "342",
            "10750",
            "10751",
            "90008",
            "90017",
            "90123",
            "P151",
            "P152",
            "P153",
            "3048",
        ),
        "Tool radius too large",
    }
    assert {alarm.number for facts in TOOL_FACTS.values() for alarm in facts.alarms.values()} == printed
    kinds = {kind.name.lower() for kind in ToolFaultKind}
    assert all({*facts.alarms} <= kinds for facts in TOOL_FACTS.values())


def test_nothing_is_written_where_the_tool_does_not_fit(tmp_path: Path):
    words = ("--tool", "R2.4", "--tip", "3", "--side", "right")
    done = call("expand", TABLES / "flange.nc", *words, "-o", tmp_path / "new.nc")
    assert (done.exit_code, (tmp_path / "new.nc").exists()) == (1, False)
    done = call("expand", TABLES / "flange.nc", *words, "--keep-going")
    assert done.exit_code == 1
    assert "N60 Z-70. ,R2." in done.stdout.splitlines()
    assert "NOT EXPANDED: tool-arc-too-small" in done.stdout


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
    ("first", "last", "is_clear"),
    [
        ("Y-8.", "X-8.", True),
        # In two lines, across the start.
        ("Y-8.", "X2.\nX-8.", True),
        ("Y-20.\nY-4.", "X20.\nX4.\nX-2.\nX-8.", True),
        # They would cross if one went on by less than the radius; or by less than the tool reaches.
        ("Y-8.", "X2.", True),
        ("Y2.", "X-8.", True),
        ("Y-8.", "X4.999", True),
        # Beside the walls of a pocket, the cutter does cut in.
        ("Y-8.", "X2. G42", False),
    ],
)
def test_straight_run_in_and_run_off_are_walls_up_to_where_they_cross(
    first: str, last: str, is_clear: bool, tmp_path: Path
):
    program = PLATE.replace(" ,C2.", "").replace("<<MIDST>>\n", "").replace("Y-8.", first, 1)
    last, _, side = last.partition(" ")
    program = program.replace("X-8.\n", f"{last}\n", 1).replace("G41", side or "G41")
    (tmp_path / "a.nc").write_text(program)
    done = call("check", *MILL, "--tool", "R5", tmp_path / "a.nc")
    assert ("tool-interference" not in done.stdout, done.exit_code) == (is_clear, int(not is_clear)), done.stdout


def test_run_in_and_run_off_that_cross_are_no_walls(tmp_path: Path):
    (tmp_path / "a.nc").write_text(PLATE.replace("<<MIDST>>\n", ""))
    done = call("expand", *MILL, "--tool", "R5", "--no-comments", tmp_path / "a.nc")
    assert done.exit_code == 0
    assert "G01 X-5. Y-8." in done.stdout
    assert "G01 X-8. Y-5." in done.stdout
    found = call("find", "--word", "tool", *MILL, tmp_path / "a.nc")
    assert found.exit_code == 0


@pytest.mark.parametrize(
    "midst", ["G55", "G68 X0 Y0 R10.", "G28 Z0.", "G91 Z-1.", "G81 X45. Y45. Z-5. R2.", "T2 M6", "D2", "G53 Z0."]
)
def test_what_interrupts_a_contour_is_an_error_and_nothing_is_written(midst: str, tmp_path: Path):
    (tmp_path / "a.nc").write_text(PLATE.replace(" ,C2.", "").replace("<<MIDST>>", midst))
    done = call("expand", *MILL, "--tool", "R5", tmp_path / "a.nc")
    assert (done.exit_code, done.stdout) == (1, "")
    assert "nothing was written" in done.stderr
    code = "tool-other-tool" if midst[0] in "TD" else "tool-interrupted"
    assert done.stderr.count(f"error[{code}]: program line 6 ") == 1


def test_a_comment_that_is_meant_to_state_a_tool_is_told(tmp_path: Path):
    (tmp_path / "a.nc").write_text(f"(contoursolve tool R0.8)\n{COMPENSATED}")
    done = call("check", *LATHE, tmp_path / "a.nc")
    assert (done.exit_code, done.stdout) == (2, "")
    assert "states no tool; write (contoursolve tool: R0.8, tip 3)" in done.stderr


@pytest.mark.parametrize(
    ("size", "units"),
    [("0.4", "mm"), ("0.3", "mm"), ("1.7", "mm"), ("0.0157", "inch"), ("0.1", "inch"), ("0.03125", "inch")],
)
def test_the_largest_radius_that_is_shown_fits_and_the_next_one_does_not(size: str, units: str):
    """A fillet between a cylinder and a face, the chamfer of two inside corners of the same size, and a groove."""
    from_axis = [f"G01 X2. Z-{2 - float(size):g}", f"G02 X{2 + 2 * float(size):g} Z-2. R{size}", "G01 X8. Z-2."]
    chamfer = ["G01 X2. Z-2.", f"X{2 + 2 * float(size):g} Z-{2 + float(size):g}", f"X8. Z-{2 + float(size):g}"]
    groove = ["G01 X40.", "Z-2.", "X2.", f"Z-{2 + 2 * float(size):g}", "X40."]
    for blocks in (from_axis, chamfer, groove):
        words = ["--units", units, "--side", "right", "--start", "X2. Z0.", "--tip", "3", "--tool"]
        given = [word for block in blocks for word in ("--block", block)]
        text = call("check", *LATHE, *words, "R3.", *given).stdout
        shown = re.search(r"up to ([0-9.]+) \S+ cuts", text)
        assert shown is not None
        step = 10.0 ** -len(shown[1].split(".")[1])
        assert "error" not in call("check", *LATHE, *words, f"R{shown[1]}", *given).stdout
        assert blocks is chamfer or float(shown[1]) == float(size)
        assert "error[tool-" in call("check", *LATHE, *words, f"R{float(shown[1]) + step:.5f}", *given).stdout


@pytest.mark.parametrize(
    ("tip", "side", "blocks", "told"),
    [
        (3, "right", "X0. Z0./G03 X20. Z-10. R10./G01 Z-25.", "1.6000"),
        (3, "right", "X0. Z5./G01 Z0./G03 X20. Z-10. R10./G01 Z-25.", "1.6000"),
        (3, "left", "X30. Z0./G01 X0.", "1.6000"),
        (3, "left", "X30. Z0./G01 X-1.", "0.6000"),
        (3, "left", "X30. Z0./G01 X-1.6", ""),
        (3, "left", "X30. Z0./G01 X0./X-1.6", ""),
        (8, "left", "X30. Z0./G01 X0.", "1.6000"),
        (3, "right", "X0. Z0./G01 X20. Z-17.3205", "0.2144"),
        (3, "left", "X30. Z0./G01 X2.", ""),
        (0, "left", "X30. Z0./G01 X0.", ""),
    ],
)
def test_a_stub_stands_where_the_tip_stops_at_the_axis(tip: int, side: str, blocks: str, told: str):
    start, *others = blocks.split("/")
    words = [word for block in others for word in ("--block", block)]
    done = call("check", *LATHE, "--tool", "R0.8", "--tip", tip, "--side", side, "--start", start, *words)
    assert done.stdout.count("[tool-stub]") == bool(told)
    assert f"a stub of diameter {told} mm stands at X0" in done.stdout or not told


def test_a_tip_that_points_away_cuts_with_no_radius():
    about = [*LATHE, "--tip", "3", "--side", "left", *TAPER]
    done = call("range", "--word", "tool", *about)
    assert (done.exit_code, "tip 3 points away from this line" in done.output) == (1, True)
    rounded = [word.replace("Z-10.", "Z-10. ,R2.") for word in about]
    text = call("sweep", "--vary", "tool=0.2:0.8:0.2", *rounded).stdout
    assert text.count("not 1 (tip against side)") == 4
    groove = ["X30. Z-10.", "X20. Z-10. ,R1.", "X20. Z-13. ,R1.", "X30. Z-13.", "X30. Z-20."]
    blocks = [word for block in groove for word in ("--block", f"G01 {block}")]
    assert "points away" not in call("check", *LATHE, *NOSE, "--side", "right", "--start", "X30. Z0.", *blocks).stdout
    belt = ["X60. Z-46.", "X44. Z-48.755", "X44. Z-51.755", "X60. Z-54.51"]
    blocks = [word for block in belt for word in ("--block", f"G01 {block}")]
    assert "points away" not in call("check", *LATHE, *NOSE, "--side", "right", "--start", "X64. Z-46.", *blocks).stdout
    rib = ["X40. Z-10.", "X40. Z-20.", "X30. Z-20."]
    blocks = [word for block in rib for word in ("--block", f"G01 {block}")]
    assert "away" in call("check", *LATHE, *NOSE, "--side", "right", "--start", "X30. Z-10.", *blocks).stdout


def test_a_word_that_calls_no_tool_and_a_tool_without_a_radius(tmp_path: Path):
    for control, word, told in (("nct-99m", "D00", "(printed)"), ("haas-mill", "D0", "(assumed)")):
        program = PLATE.replace("D1", word).replace("<<MIDST>>\n", "")
        (tmp_path / "a.nc").write_text(program)
        done = call("expand", "--control", control, "--tool", "R5", tmp_path / "a.nc")
        assert (done.exit_code, done.stdout) == (1, "")
        assert f"error[tool-no-offset]: {word} is in force: G41 works with radius 0 {told}" in done.stderr
    (tmp_path / "a.nc").write_text(PLATE.replace("T1", "T0").replace(" D1", "").replace("<<MIDST>>\n", ""))
    assert "T0 is in force" in call("check", *MILL, "--tool", "R5", tmp_path / "a.nc").stdout
    (tmp_path / "a.nc").write_text(PLATE.replace("<<MIDST>>\n", ""))
    for row, told in (
        ("D1 = {radius = 0}", "info[tool-no-radius]"),
        ("D2 = {radius = 5}", "D1 in program line 3 has no row"),
    ):
        (tmp_path / "contoursolve.toml").write_text(f"[tools]\n{row}\n")
        assert told in call("check", *MILL, "--tool", "program", tmp_path / "a.nc").output


def test_m6_changes_the_tool_that_t_makes_ready(tmp_path: Path):
    (tmp_path / "contoursolve.toml").write_text("[tools]\nT1 = {radius = 5}\nT2 = {radius = 4}\n")
    (tmp_path / "a.nc").write_text(PLATE.replace("<<MIDST>>\n", "").replace("G90", "T2\nG90"))
    text = call("expand", *MILL, "--tool", "program", tmp_path / "a.nc").stdout
    assert "path of the centre for cutter R5" in text


def test_two_codes_of_compensation_in_one_block(tmp_path: Path):
    for codes, named in (("G41 G42", "G41 and G42"), ("G42 G40", "G40 and G42"), ("G41 G41", "")):
        (tmp_path / "a.nc").write_text(PLATE.replace("G41", codes).replace("<<MIDST>>\n", ""))
        done = call("check", *MILL, "--tool", "R5", tmp_path / "a.nc")
        assert (
            (done.exit_code, f"{named} stand together in program line 3" in done.stderr) == (2, True)
            if named
            else (
                0,
                False,
            )
        )


@pytest.mark.parametrize(
    ("end", "line"), [("M30", 9), ("G28 X0 Y0", 9), ("T2 M6\nG40 G00 X0", 9), ("M05", 9), ("G40\nM30", 0)]
)
def test_compensation_that_nothing_ends(end: str, line: int, tmp_path: Path):
    program = PLATE.replace("<<MIDST>>\n", "").replace("G40 ", "")
    for name, text in (("on.nc", f"{program}{end}\n"), ("off.nc", f"{program.replace('G00 X-20', 'G40 G00 X-20')}")):
        (tmp_path / name).write_text(text.replace("G90 G17 G54 G40 G00", "G90 G17 G54 G00"))
    done = call("check", *MILL, "--tool", "R5", tmp_path / "on.nc")
    told = f"warning[tool-still-on]: G41 is still in force at program line {line}"
    assert (done.exit_code, told in done.stdout) == (0, bool(line))
    assert "on.nc:8:1" in done.stdout or not line
    on, off = (
        call("expand", *MILL, "--tool", "R5", "--no-comments", tmp_path / f"{each}.nc") for each in ("on", "off")
    )
    assert on.stdout.splitlines()[:14] == off.stdout.splitlines()[:14]


def test_a_lathe_asks_for_the_tip_whatever_x_counts(tmp_path: Path):
    for codes in ("DIAMON", "DIAMOF", ""):
        (tmp_path / "a.mpf").write_text(f"G90 G18 {codes}\nG0 X10 Z5\nG42 G1 X10 Z0 D1\nZ-10\nX20 Z-20\nG40 G0 X80\n")
        words = ("check", "--control", "siemens-840d", "--tool", "R0.8", tmp_path / "a.mpf")
        assert "a turning tool needs the number of its imaginary tip" in call(*words).stderr
        assert call(*words, "--tip", "3").exit_code == 0
    (tmp_path / "a.nc").write_text("G90 G18 G00 X10. Z5.\nG42 G01 Z0 D1 F100\nZ-10.\nX20.\nG40 G00 X80.\n")
    assert call("check", *MILL, "--tool", "R0.8", tmp_path / "a.nc").exit_code == 0


def test_the_side_of_a_contour_that_is_not_solved_is_known(tmp_path: Path):
    blocks = ["BEGIN PGM A MM", "TOOL CALL 1 Z S2000", "L X-30 Y-30 R0 FMAX", "L X+0 Y+0 RR F300", "FL AN+0 LEN40"]
    blocks += ["RND R6", "FL AN+90 LEN30", "FC DR+ R20 X+10 Y+40", "L X-30 Y+40 R0 FMAX", "END PGM A MM"]
    for first in (None, "RND R3"):
        lines = [*blocks[:4], *([first] if first else []), *blocks[4:]]
        (tmp_path / "a.h").write_text("".join(f"{number} {line}\n" for number, line in enumerate(lines)))
        done = call("check", "--tool", "R5", tmp_path / "a.h")
        assert (done.exit_code, done.stderr) == (1, "")
        assert "error[several-contours]" in done.stdout
        assert "side left is against RR" in call("check", "--tool", "R5", "--side", "left", tmp_path / "a.h").stderr


def test_a_program_that_cuts_nothing_is_not_asked_for_a_side(tmp_path: Path):
    (tmp_path / "a.nc").write_text("T1 M6\nG00 X0 Y0\nM30\n")
    for command in ("check", "expand"):
        done = call(command, *MILL, "--tool", "R5", tmp_path / "a.nc")
        assert (done.exit_code, "no cutting move goes beside a contour" in done.stderr) == (2, True)


# Calls, helices and other controls -----------------------------------------------------------------------------------

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


HELIX = """\
G17 G90 G00 X20. Y0 Z2.
G41 D1 G01 X30. Y-5. Z0 F200
G03 X40. Y5. J10.
G03 X40. Y5. I-40. Z-2.
G03 X40. Y5. I-40.
G03 X30. Y15. I-10.
G40 G01 X0 Y0
"""
RAMPS = """\
G17 G90 G00 X100. Y100. Z0
G41 D1 G01 X110. F100
Y120. Z-3.
X140. Z-5.
Y{0}
G40 X160.
"""


@pytest.mark.parametrize(
    ("text", "made"),
    [
        (
            HELIX,
            (
                "G01 X30. Y-1. Z0. F200/G03 X36. Y5. I0. J6./G03 X-36. Y5. I-36. J0. Z-1./G03 X36. Y5. I36. J0. Z-2./"
                "G03 X-36. Y5. I-36. J0./G03 X36. Y5. I36. J0./G03 X30. Y11. I-6. J0./G01 X0. Y0."
            ),
        ),
        (
            RAMPS.format("100."),
            (
                "G01 X106. Y100. F100/G01 X106. Y120. Z-3./G02 X110. Y124. I4. J0./G01 X140. Y124. Z-5./"
                "G02 X144. Y120. I0. J-4./G01 X144. Y100./G01 X160. Y100."
            ),
        ),
        # An inside arc of the radius of the tool is a point: what moves along moves alone.
        (
            RAMPS.format("110.\nG03 X144. Y106. R4. Z-7.\nG01 X150."),
            (
                "G01 X106. Y100. F100/G01 X106. Y120. Z-3./G02 X110. Y124. I4. J0./G01 X140. Y124. Z-5./"
                "G02 X144. Y120. I0. J-4./G01 X144. Y110./G01 Z-7./G01 X150. Y110./G01 X160. Y106."
            ),
        ),
    ],
    ids=["helix", "ramps", "point"],
)
def test_what_moves_outside_the_plane_goes_along(text: str, made: str, tmp_path: Path):
    (tmp_path / "a.nc").write_text(text)
    done = call("expand", *MILL, "--tool", "R4", "--no-comments", tmp_path / "a.nc", "-o", tmp_path / "new.nc")
    assert done.exit_code == 0, done.stderr
    assert (tmp_path / "new.nc").read_text().splitlines()[2:] == made.split("/")
    assert call("diff", *MILL, "--tool", "R4", tmp_path / "a.nc", tmp_path / "new.nc").exit_code == 0


@pytest.mark.parametrize(
    ("stated", "told"),
    [
        ("R0,8", "'R0,8' is no tool; write R0.8\n"),
        ("R0.8 tip3", "'R0.8 tip3' is no tool; write R0.8, tip 3\n"),
        ("R0,8; tip 3", "write R0.8, tip 3\n"),
        ("R0.8, 3", "write R0.8, tip 3\n"),
        ("R0.8, tip 2", "the tool has tip 2 and tip 3; leave one out"),
        ("D1.6", "write its radius and, on a lathe, its tip, such as R0.8, tip 3"),
    ],
)
def test_a_tool_in_another_spelling_is_told_with_the_right_one(stated: str, told: str):
    assert told in call("check", *LATHE, "--tool", stated, "--tip", "3", "--side", "right", *TAPER).stderr
    comment = stated if "," in stated or " " in stated else f"{stated}, tip 3"
    blocks = ["--block", f"(contoursolve tool: {comment})", *TAPER]
    if "tip 2" not in stated:
        assert f"program line 1: {comment!r} is no tool" in call("check", *LATHE, "--side", "right", *blocks).stderr


@pytest.mark.parametrize(
    ("row", "told"),
    [
        ("T0101 = {radius = -1}", "tools.T0101: the radius of the tool is R-1; it must not be less than 0"),
        ("T0101 = {radius = 0.8, tip = 12}", "tools.T0101: there is no tip 12"),
        ("X1 = {radius = 0.8}", "tools.X1: it is no tool; write T0101"),
        ("T0202 = {radius = 0.8, tip = 3}", "T0101 in program line 1 has no row in the table of tools"),
        (
            "T0101 = {radius = 0.8, tip = 3}\nT101 = {radius = 0.4, tip = 3}",
            "T0101 and T101 in the table of tools",
        ),
        ("D1 = {radius = 5}\nD01 = {radius = 6}", "D1 and D01 in the table of tools name one tool; leave one out"),
    ],
)
def test_a_row_of_the_table_is_named(row: str, told: str, tmp_path: Path):
    (tmp_path / "a.nc").write_text(f"T0101\n{COMPENSATED}")
    (tmp_path / "contoursolve.toml").write_text(f"[tools]\n{row}\n")
    done = call("check", *LATHE, "--tool", "program", tmp_path / "a.nc")
    assert (done.exit_code, told in done.stderr) == (2, True)
    assert "contoursolve.toml" in done.stderr or "in the table of tools" in done.stderr


@pytest.mark.parametrize("comment", ["tol: R0.8", "toool: R0.8, tip 3", "too: R0.8", "TOOLS: R0.8"])
def test_a_misspelt_comment_about_a_tool(comment: str, tmp_path: Path):
    (tmp_path / "a.nc").write_text(f"(contoursolve {comment})\n{COMPENSATED}")
    done = call("check", *LATHE, tmp_path / "a.nc")
    assert (done.exit_code, "program line 1: " in done.stderr) == (2, True)
    assert "states no tool; write (contoursolve tool: R0.8, tip 3)" in done.stderr
    (tmp_path / "a.nc").write_text(f"(CONTOURSOLVE TOOL: R0.80, TIP 3)\n(contoursolve note: it runs)\n{COMPENSATED}")
    assert "nose R0.8, tip 3, right" in call("expand", *LATHE, "--tool", "program", tmp_path / "a.nc").stdout


def test_an_option_that_is_given_twice():
    for words in (("--side", "left", "--side", "right"), ("--side=left", "--side", "right")):
        done = call("check", *LATHE, *NOSE, *words, *TAPER)
        assert (done.exit_code, "--side is given several times" in done.stderr) == (2, True)
    assert call("check", *LATHE, *NOSE, "--side", "right", "--side", "right", *TAPER).exit_code == 0


def test_a_closed_contour_that_begins_in_an_inside_corner(tmp_path: Path):
    lines = ["G90 G17 G00 X10. Y10.", "G41 D1 G01 X0 Y0 F100", "X60.", "Y40.", "X0", "Y0", "G40 X10. Y10."]
    for turned in (lines, [each.replace("G41", "G42") for each in (*lines[:2], "Y40.", "X60.", "Y0", "X0", lines[-1])]):
        (tmp_path / "a.nc").write_text("\n".join(turned) + "\n")
        text = call("check", *MILL, "--tool", "R5", tmp_path / "a.nc").stdout
        assert "help: begin the contour in the middle of an element, not in an inside corner" in text
        (contour,) = run("solve", "--format", "json", *MILL, "--tool", "R5.0", str(tmp_path / "a.nc"))["contours"]
        assert [each["largest_radius"] for each in contour["tool"]["faults"]] == [None]
        assert (
            json.loads(call("find", "--word", "tool", *MILL, tmp_path / "a.nc", "--format", "json").stdout)["contours"][
                0
            ]["stated"]
            is None
        )


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
def test_the_finishing_pass_is_written_and_roughing_stays(words: tuple[str, ...], control: str, tmp_path: Path):
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


def lines(control: str, *blocks: str) -> str:
    return "\n".join([f"(contoursolve control: {control})", *blocks]) + "\n"


TURN = ("G42 G01 Z0. F0.1", "X30. Z-10.", "Z-30.", "X40.", "G40 G00 X60. Z50.")
BARE = ("G00 X20. Z2.", "G01 Z0.", "X30. Z-10.", "Z-30.", "X40.", "G00 X60. Z50.")
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


@pytest.mark.parametrize(
    "blocks",
    [
        ("G00 X62. Z0.", "G01 X-1.6"),
        ("G00 X42. Z-20.", "G01 X30.", "G04 X0.5"),
        ("G00 X42. Z-20.", "G01 X30.", "X42."),
        ("G00 X0. Z2.", "G01 Z-20.", "Z2."),
    ],
)
def test_a_face_or_a_groove_by_the_tip_alone_is_right_on_either_side(blocks: tuple[str, ...], tmp_path: Path):
    (tmp_path / "a.nc").write_text(text := lines("fanuc-lathe", *blocks, "G00 X62. Z2."))
    for side in ("left", "right"):
        done = call("check", *NOSE, "--side", side, tmp_path / "a.nc")
        assert done.stdout == "1 contour solved, no problems\n", done.stdout
    assert call("expand", *NOSE, "--side", "right", tmp_path / "a.nc").stdout == text


def test_a_move_in_depth_under_compensation_is_the_same_path(tmp_path: Path):
    plunge = ("G00 X-40. Y-20.", "G41 D1 X-30. Y-20.", "Z2.", "G01 Z-5. F200", *ISLAND[1:])
    (tmp_path / "a.nc").write_text(lines(MILL[1], *plunge))
    assert call("expand", "--tool", "R5", tmp_path / "a.nc", "-o", tmp_path / "b.nc").exit_code == 0
    done = call("diff", tmp_path / "a.nc", tmp_path / "b.nc", "--tool", "R5")
    assert done.exit_code == 0, done.output


def test_what_runs_again_is_told_once(tmp_path: Path):
    loop = ("#1=1", "WHILE[#1LE3]DO1", "G00 X-40. Y-20.", "G01 Z-#1 F200", "G41 D1 X30.", "Y30.", "X-30.", "G40 Y-50.")
    (tmp_path / "a.nc").write_text(lines(MILL[1], *loop, "#1=#1+1", "END1"))
    told = call("check", "--tool", "R5", tmp_path / "a.nc").stdout
    assert (told.count("tool-inside-corner"), told.count("= the same in 3 passes")) == (1, 1)


@pytest.mark.parametrize("command", ["range", "sweep", "find"])
def test_a_family_has_the_tool_as_a_word(command: str):
    done = call(command, "--tool", "R5", "--block", "G01 X1.")
    assert (done.exit_code, "here the tool is a word: --word tool, or --vary tool=" in done.stderr) == (2, True)


def test_where_no_tool_fits_the_fix_is_no_smaller_one(tmp_path: Path):
    """An arc in the wrong sense begins where the line comes from."""
    blocks = ("G00 X0. Y-20.", "G41 D1 G01 Y0. F500", "Y30.", "G02 X-10. Y40. I-10. J0.", "G01 X-40.", "G40 Y80.")
    (tmp_path / "a.nc").write_text(lines(MILL[1], *blocks))
    told = call("check", "--tool", "R5", tmp_path / "a.nc").stdout
    assert "no cutter fits here\n  = help: check whether the contour goes back on itself" in told


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


def test_several_words_that_are_not_followed_beside_a_short_contour(tmp_path: Path):
    blocks = (
        "0 BEGIN PGM A MM",
        "1 TOOL CALL 1 Z S3000",
        "2 L X-40 R+ FMAX",
        "3 L Y-20 R- FMAX",
        "4 L X-30 Y-20 RL F500",
    )
    blocks = (*blocks, "5 L Y+30 RL", "6 L X+30 RR", "7 L Y-30", "8 L Y-60 R0", "9 END PGM A MM")
    (tmp_path / "a.h").write_text("\n".join(blocks) + "\n")
    done = call("check", "--control", "heidenhain", "--tool", "R4", tmp_path / "a.h")
    assert done.exit_code == 1, done.output
