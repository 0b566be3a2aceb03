"""Which tools cut a contour, a family of contours, and all contours of a program."""

import json
from pathlib import Path
from typing import Any

import numpy
import pytest
from calling import block as blocks_of, call, data
from oracle_tool import draw, program_of, run

import contoursolve

TABLES = Path(__file__).parents[1] / "oracles" / "tool"
LATHE, MILL = ("--control", "fanuc-lathe", "--tip", "3"), ("--control", "fanuc-mill")
G111 = ("--block", "G111 X100. A180. K-30. B120. P5. Q5.", "--start", "X40. Z0.")
NOSE = ("--side", "right", "--tip", "3")


WORKED = [
    ("22", LATHE, "right", "X20. Z0. / G01 X20. Z-14.6 / G02 X20.8 Z-15. R0.4 / G01 X40. Z-15.", 0.4, "arc-too-small"),
    (
        "23",
        LATHE,
        "right",
        "X30. Z0. / G01 X30. Z-10. / X20. Z-10. / X20. Z-11.5 / X30. Z-11.5 / X30. Z-20.",
        0.75,
        "element-vanishes",
    ),
    ("24", LATHE, "right", "X20. Z0. / G01 X20. Z-10. / X21. Z-10.5 / X30. Z-10.5", 0.8535534, "element-vanishes"),
    (
        "25",
        MILL,
        "left",
        "X-4. Y20. / G01 X-4. Y9.16515139 / G03 X4. Y9.16515139 I4. J-9.16515139 / G01 X4. Y20.",
        4,
        "interference",
    ),
    # The tool beside the neck touches its wall and the circle: (10 + R)^2 = (4 + R)^2 + 20^2.
    (
        "25 outside",
        MILL,
        "right",
        "X-4. Y20. / G01 X-4. Y9.16515139 / G03 X4. Y9.16515139 I4. J-9.16515139 / G01 X4. Y20.",
        316 / 12,
        "element-vanishes",
    ),
]


@pytest.mark.parametrize("row", WORKED, ids=[row[0] for row in WORKED])
def test_worked_examples_end_where_check_says(row: tuple[Any, ...]):
    _, words, side, program, largest, code = row
    about = [*words, "--side", side, *blocks_of(program)]
    (found,) = data("range", "--word", "tool", *about)["ranges"]
    high = found["high"]
    assert (high["value"], high["reason"]["code"]) == (pytest.approx(largest, abs=1e-6), f"tool-{code}")
    assert found["low"]["value"] == 0
    for radius, is_cut in ((high["value"] - 1e-6, True), (high["value"] + 3e-6, False), (high["value"] / 3, True)):
        assert (call("check", "--tool", f"R{radius:.9f}", *about).exit_code == 0) is is_cut


@pytest.mark.parametrize("seed", range(41, 49))
def test_random_contours_end_where_check_says(seed, tmp_path):
    """What fits at the largest radius fits at smaller ones, and does not at larger ones, contour by contour."""
    random, ended = numpy.random.default_rng(seed), 0
    for _ in range(1):
        program, side = tmp_path / "a.nc", str(random.choice(["left", "right"]))
        program.write_text(program_of([draw(random) for _ in range(3)], is_lathe=False))
        about = (program, *MILL, "--side", side, "--outside", str(random.choice(["roll", "intersect"])))
        found = json.loads(call("find", "--word", "tool", "--within", "0:30", "--format", "json", *about).stdout)
        for number, contour in enumerate(found["contours"]):
            end = contour["ranges"][0]["high"] if contour["ranges"] else {"value": 0.0, "reason": True}
            ended += bool(end["reason"])
            for radius, is_cut in ((0.3 * end["value"], True), (end["value"], True), (end["value"] + 1e-5, False)):
                if is_cut or end["reason"]:
                    tool = ("--tool", f"R{radius:.9f}")
                    own = run("solve", "--format", "json", *tool, *map(str, about))["contours"][number]
                    assert (not own["tool"]["faults"] or not radius) is is_cut, (radius, contour)
    assert ended


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("range", "--word", "tool", "--word", "P", *NOSE), "family tries both: --vary tool=0.2:1.2:0.05"),
        (("range", "--word", "tool", "--within", "-1:2", *NOSE), "the radius of a tool is not below 0"),
        (("range", "--word", "P", "--tip", "3"), "--tip goes with --word tool"),
        (("find", "--word", "tool", "--goal", "end Z1.", *NOSE), "--goal goes with a word of the block"),
        (("find", "--word", "P"), "missing --goal"),
        (("find", "a.nc", "--word", "P", "--goal", "end Z1."), "only --word tool takes a PROGRAM"),
        (("sweep", "--vary", "P=1", "--side", "left"), "--side goes with --vary tool=VALUES"),
        (("sweep", "--vary", "tool=-0.4,1", *NOSE), "the radius of the tool is R-0.4; it must not be less than 0"),
        (("sweep", "--vary", "tool=1", "--vary", "Tool=2", *NOSE), "--vary names tool twice"),
        (("sweep", "--vary", "tool=1", "--plot", "a.svg", *NOSE), "leave out --plot"),
        (("sweep", "--vary", "tool=1", "--dask", "tcp://x", *NOSE), "leave out --dask"),
        (("sweep", "--vary", "tool=1,2", "--vary", "P=1", "--paired", *NOSE), "tool has 2, P has 1"),
    ],
)
def test_what_cannot_be_combined_is_told(words: tuple[str, ...], told: str):
    done = call(*words, *(() if "a.nc" in words else G111))
    assert done.exit_code == 2
    assert told in done.stderr


def test_a_contour_without_a_solution_and_a_program_without_one():
    done = call("range", "--word", "tool", *NOSE, "--block", "G111 X100. A180. B120.", "--start", "X40. Z0.")
    assert (done.exit_code, "nothing is computed" in done.stderr) == (2, True)
    done = call("find", "-", "--word", "tool", *NOSE, "--control", "fanuc-lathe", stdin="M30\n")
    assert (done.exit_code, "no cutting move goes beside a contour" in done.stderr) == (2, True)
    plain = ("--block", "G01 X30. Z-10.", "--start", "X20. Z0.")
    done = call("sweep", "--vary", "tool=1", *LATHE, "--side", "left", *plain)
    assert (done.exit_code, "contoursolve ranges --word tool" in done.stderr) == (2, True)


# find -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "words", "largest", "word"),
    [
        ("flange.nc", (*LATHE, "--side", "right"), 2.0, "program line 14, ,R2."),
        ("plate.nc", (*MILL, "--side", "left"), 5.0, "program line 11, ,R5."),
    ],
)
def test_the_largest_tool_of_whole_programs(name: str, words: tuple[str, ...], largest: float, word: str):
    found = data("find", TABLES / name, "--word", "tool", *words)
    (contour,) = found["contours"]
    assert (found["largest"], contour["ranges"][0]["high"]["reason"]["text"].split(":")[0]) == (largest, word)


def test_lines_that_are_no_path_are_named_and_units_may_change(tmp_path: Path):
    program = tmp_path / "a.nc"
    inch = "G17 G20 G90 G00 X8. Y0\nG01 X8. Y1. ,R.1\nX9.\n"
    program.write_text(f"G17 G21 G90\nG00 X0 Y0\nG01 X0 Y30. ,R2.\nX40.\nM98 P7777\n{inch}M30\n")
    done = call("find", program, "--word", "tool", *MILL, "--side", "right")
    assert done.stdout.splitlines()[0] == "largest tool for all 2 contours: 2.0000 mm"
    assert "0.10000 in  program line 7, ,R.1" in done.stdout
    assert "not looked at: program line 5 (M98 calls or ends a subprogram)" in done.stdout


# sweep ------------------------------------------------------------------------------------------------------------


def test_a_family_is_what_solve_says_row_by_row(tmp_path: Path):
    words = (*G111, *NOSE, "--vary", "P=0,15,60", "--vary", "tool=0.2,8,25", "--vary", "K=-30,-1.5")
    done = call("sweep", *words, "-o", tmp_path / "a.csv", "--workers", "2")
    assert done.exit_code == 0
    head, *rows = (tmp_path / "a.csv").read_text().splitlines()
    names = head.split(",")
    assert names[:3] == ["P", "K", "tool"]
    kinds = set()
    for line in rows:
        row = dict(zip(names, line.split(","), strict=True))
        block = f"G111 X100. A180. K{row['K']} B120. P{row['P']} Q5."
        about = ("--tool", f"R{row['tool']}", *NOSE, "--block", block, "--start", "X40. Z0.")
        (contour,) = json.loads(call("solve", "--format", "json", *about).stdout)["contours"]
        assert row["status"] == contour["status"]
        told = [each["kind"] for each in (contour["tool"] or {"faults": []})["faults"]]
        errors = [each for each in told if each not in ("tip_against_side", "uncompensated")]
        is_solved = contour["status"] == "solved"
        assert row["tool.fits"] == str(is_solved and not errors)
        assert row["tool.fault"] in errors or (not errors and not row["tool.fault"])
        kinds.add(row["tool.fault"])
    assert kinds == {"arc_too_small", "element_vanishes", ""}
    assert "cut by the tool R0.2" in done.stdout


def test_the_summary_counts_contours_once_for_each_tool():
    words = ("--vary", "P=0.4,0.8,1.2,60", "--vary", "tool=0.4:1.2:0.4", *NOSE)
    found = data("sweep", *G111, *words)
    assert (found["contours"], found["statuses"][0]["count"]) == (4, 3)
    assert [each["contours"] for each in found["tools"]] == [
        {"cut": 3},
        {"cut": 2, "arc_too_small": 1},
        {"arc_too_small": 2, "cut": 1},
    ]
    paired = data("sweep", *G111, "--vary", "P=0.4,0.8", "--vary", "tool=0.4,1.2", "--paired", *NOSE)
    each_way = [{"cut": 1}, {"arc_too_small": 1}]
    assert (paired["contours"], [each["contours"] for each in paired["tools"]]) == (2, each_way)
    alone = data("sweep", *G111, "--vary", "tool=0.4,10", *NOSE)
    assert (alone["contours"], [each["contours"] for each in alone["tools"]]) == (1, each_way)


def test_arrays_have_the_tool_as_their_last_axis():
    block, vary = "G20 G111 X4. A180. K-1. B120. P.5 Q.2", {"tool": [0.6, 0.1], "P": [0.05, 0.3, 0.4]}
    found = contoursolve.family(block, start="X2. Z0.", units="inch", side="right", tip=3, vary=vary)
    assert found["tool.fits"].tolist() == [[False, False], [False, True], [False, True]]
    assert found["tool.largest"][1].tolist() == pytest.approx([2.54, 2.54])
    assert numpy.isnan(found["tool.largest"][0]).all()
    assert found["tool.fault"][0].tolist() == ["arc_too_small"] * 2
    assert [found.measures()[name].unit for name in ("tool", "tool.largest", "tool.fits")] == ["inch", "mm", ""]
    with pytest.raises(TypeError, match="sid"):
        contoursolve.ranges(block, "tool", sid="left")  # type: ignore[call-arg]
    assert found.to_arrow()["tool.fault"].to_pylist()[3] == ""


CROSSING = (
    "X-10. Y-20. / G41 G01 X0. Y-7.2 / X0. Y20. / X-16.4 Y-5.3 / X7.9 Y-18.6 / X30. Y0. / X3.6 Y0. / G40 X3.6 Y-40."
)
"""The run-in begins 7.2 mm before the run-off, which ends 3.6 mm from it: a cutter R3.6 reaches the other one."""


def test_a_larger_tool_may_fit_where_a_smaller_one_does_not():
    about, end = (*MILL, *blocks_of(CROSSING)), 3.1036080981
    found = data("range", "--word", "tool", *about)
    ends = [(each["low"]["value"], each["high"]["value"]) for each in found["ranges"]]
    assert ends == [(0, pytest.approx(end, abs=1e-6)), (pytest.approx(3.6), pytest.approx(4.1937359, abs=1e-6))]
    assert not found["complete"]
    assert (
        "not proven: a smaller tool is taken to fit wherever a larger one does"
        in call("range", "--word", "tool", *about).stdout
    )
    for radius in (0.5, 3.1, 3.2, 3.5, 3.6, 4.19, 4.2):
        fits = radius < end or 3.6 <= radius < 4.1937
        done = call("check", "--tool", f"R{radius}", *about)
        assert (done.exit_code == 0) is fits, radius
        # Up to the end of the first range every tool is known to fit.
        assert fits or "up to 3.1036 mm" in done.stdout or "; 3.1036 mm the whole contour" in done.stdout
        assert ("tool-runs-cross" in done.stdout) is (radius >= 3.6)
    assert (
        "program lines 2 and 6, the run-in and the run-off, cross at X0.0000 Y0.0000"
        in call("check", "--tool", "R4", *about).stdout
    )
    # A table of many radii says the same, whatever lies between.
    start, *lines = CROSSING.replace("X0. Y20.", "X0. Y20. ,R5.").split(" / ")
    radii = [1, 2, 3.2, 3.5, 3.7, 4, 4.5]
    family = contoursolve.family("\n".join(lines), start=start, control="fanuc-mill", vary={"tool": radii})
    assert family["tool.fits"].tolist() == [True, True, False, False, True, True, False]


CROSSES_ITSELF = """0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000
2 L X-3 Y-10.94 R0 FMAX
L X0 Y0 RR F300
L X39.154 Y0
CC X26.1021 Y16.2125
C X18.5533 Y35.6087 DR+
L X9.282 Y32
L X5.884 Y27.763
L X0.281 Y-8.704
L X-2.52 Y-26.936
CC X-16.3453 Y-37.4622
C X-23.2396 Y-53.4124 DR-
L X-21.6528 Y-42.1801 R0 FMAX
END PGM A MM
"""


def test_a_part_of_a_contour_has_the_walls_of_the_whole(tmp_path):
    """Of the elements around the fault alone, the first and the last one would be the run-in and the run-off."""
    program = tmp_path / "a.h"
    program.write_text(CROSSES_ITSELF)
    done = call("check", "--tool", "R3", program)
    assert done.exit_code == 1
    assert "cuts 3.0000 mm into program line 10 while it works on program line 5" in done.stdout
    assert "no cutter fits here" in done.stdout
    lines = "X11. Y3. / G41 G01 X0. Y0. / Y-35.103 / X-13.62 Y-16.242 / X-23.293 Y-2.846 / X-13.57 Y-6.169 / "
    rest = "X13.136 Y6.933 / X31.164 Y15.777 / X57.081 Y14.025 / G40 X60.8161 Y24.7976"
    about = ("--control", "isg", *blocks_of(lines + rest))
    done = call("check", "--tool", "R3", *about)
    assert "a cutter of radius up to 0.7837 mm cuts the whole contour (tried)" in done.stdout
    (found,) = data("range", "--word", "tool", *about)["ranges"]
    assert found["high"]["value"] == pytest.approx(0.7837, abs=1e-4)


BORE = "X34. Z2. / G41 G01 Z0. / X30. Z-2. / Z-20. / X20. ,R1. / Z-32. / G40 X18."


def test_a_doubtful_tip_is_a_warning_wherever_it_is_told(tmp_path):
    """No radius makes a tip another one: it keeps no tool from the contour."""
    about, warning = (*LATHE, *blocks_of(BORE)), "tip 3 points away from this straight, with the tool left of it"
    check = call("check", "--tool", "R0.4", *about[:2], "--tip", "3", *about[4:])
    # Findings in the same words are one.
    assert (check.exit_code, check.stdout.count(f"warning[tool-tip-against-side]: {warning}")) == (0, 1)
    assert call("expand", "--tool", "R0.4", *about).exit_code == 0
    ranges = call("range", "--word", "tool", *about).stdout
    # The step of 5 mm has a corner of 1 mm.
    assert "to    4.0000 mm  program line 4: the straight is 4.0000 mm long" in ranges
    assert ranges.count(f"warning: program line {3}: {warning}") == 1
    assert len(data("range", "--word", "tool", *about)["warnings"]) == 2
