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
        (("range", "--word", "tool", "--word", "P", *NOSE), "sweep tries both: --vary tool=0.2:1.2:0.05"),
        (("range", "--word", "tool", "--within", "-1:2", *NOSE), "the radius of a tool is not below 0"),
        (("range", "--word", "P", "--tip", "3"), "--tip goes with --word tool"),
        (("find", "--word", "tool", "--bring", "end Z1.", *NOSE), "--bring goes with a word of the block"),
        (("find", "--word", "P"), "missing --bring"),
        (("find", "a.nc", "--word", "P", "--bring", "end Z1."), "only --word tool takes a PROGRAM"),
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
    assert (done.exit_code, "contoursolve range --word tool" in done.stderr) == (2, True)


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
    inch = "G20 G00 X8. Y0\nG01 X8. Y1. ,R.1\nX9.\n"
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
    found = contoursolve.family_of_tools(block, start="X2. Z0.", units="inch", side="right", tip=3, vary=vary)
    assert found["tool.fits"].tolist() == [[False, False], [False, True], [False, True]]
    assert found["tool.largest"][1].tolist() == pytest.approx([2.54, 2.54])
    assert numpy.isnan(found["tool.largest"][0]).all()
    assert found["tool.fault"][0].tolist() == ["arc_too_small"] * 2
    assert [found.measures()[name].unit for name in ("tool", "tool.largest", "tool.fits")] == ["inch", "mm", ""]
    with pytest.raises(TypeError, match="sid"):
        contoursolve.find_tools(block, sid="left")  # type: ignore[call-arg]
    assert found.to_arrow()["tool.fault"].to_pylist()[3] == ""
