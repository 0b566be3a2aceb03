"""Settings about the tool: what each changes, against numbers of the sheet and by hand."""

import re
from pathlib import Path
from typing import Any

import pytest
from calling import call, data

LATHE, MILL = "fanuc-lathe", "fanuc-mill"
FILLET = "X20. Z0. / G01 X20. Z-14.6 / G02 X20.8 Z-15. R0.4 / G01 X40. Z-15."
EDGE = "X0. Z0. / G01 X20. Z0. / X20. Z-10."
TAPER = "X20. Z0. / G01 X20. Z-10. / X30. Z-20. / X30. Z-30."
POCKET = "X0 Y0 / G01 X40. Y0 / X40. Y30. / X10. Y30."


def asked(tool: str, blocks: str, side: str, control: str, *settings: str) -> list[str]:
    start, *others = blocks.split(" / ")
    words = ["--control", control, "--tool", tool, "--side", side, "--start", start]
    words += [word for each in settings for word in ("--setting", f"{control}.tool-{each}")]
    return words + [word for block in others for word in ("--block", block)]


def tool_of(*about: str) -> dict[str, Any]:
    """The tool beside the only contour."""
    (contour,) = data("solve", *asked(*about))["contours"]
    return dict(contour["tool"])


def ends(found: dict[str, Any]) -> list[tuple[float, ...]]:
    """The places of a path; none where there is no path."""
    places = [found["start"], *(each["end"] for each in found["elements"])] if found["elements"] else []
    return [tuple(round(value, 4) for value in place) for place in places]


def test_a_tool_that_comes_nowhere_is_refused_although_it_may_leave_something():
    neck = "X-4. Y20. / G01 X-4. Y9.1652 / G03 X4. Y9.1652 I4. J-9.1652 / G01 X4. Y20."
    assert ends(tool_of("R6", neck, "left", MILL, "too-small=leave")) == []
    # With a surface beside the neck, the cutter rests on both edges and goes on.
    wide = neck.replace("X-4. Y20.", "X-24. Y20. / G01 X-4. Y20.", 1) + " / X24. Y20."
    assert ends(tool_of("R6", wide, "left", MILL, "too-small=leave"))[2] == (0.0, 24.4721)


SETTINGS: list[tuple[str, tuple[str, ...], Any, Any]] = [
    ("outside=intersect", ("R0.8, tip 3", EDGE, "right", LATHE), (0.0, 9.2), (0.0, 10.0)),
    # A turn of 45 degrees: over the limit, both ends go on by the radius.
    (
        "intersect-limit=30",
        ("R1, tip 0", "X0. Z0. / G01 X20. Z0. / X30. Z-5.", "right", LATHE, "outside=intersect"),
        (1.0, 10.4142),
        (1.0, 11.0),
    ),
    ("equal-radius=error", ("R0.4, tip 3", FILLET, "right", LATHE), 3, 0),
    ("inside-corner=error", ("R5", POCKET, "left", MILL), 4, 0),
    # TR-12: the tip stops at the end of the contour.
    ("end=tip", ("R0.8, tip 3", EDGE, "right", LATHE), (-10.8, 10.0), (-10.0, 10.0)),
    # The tip that is 3 on Fanuc is 2 on LinuxCNC.
    ("numbers=linuxcnc", ("R0.8, tip 2", TAPER, "right", LATHE), (-30.8, 16.6), (-30.8, 15.0)),
    ("numbers=linuxcnc", ("R0.8, tip 3", TAPER, "right", LATHE), (-30.8, 15.0), (-30.8, 16.6)),
    ("radius=diameter", ("R10", POCKET, "left", MILL), (10.0, 20.0), (10.0, 25.0)),
]


@pytest.mark.parametrize(("setting", "about", "usual", "other"), SETTINGS, ids=[row[0] for row in SETTINGS])
def test_a_setting_changes_the_path(setting: str, about: tuple[str, ...], usual: Any, other: Any):
    """A place of the path with the setting and without it; or how many there are."""
    for found, wanted in ((ends(tool_of(*about)), usual), (ends(tool_of(*about, setting)), other)):
        assert wanted in found if isinstance(wanted, tuple) else len(found) == wanted
    assert ends(tool_of(*about)) != ends(tool_of(*about, setting))


@pytest.mark.parametrize(
    ("entry", "blocks", "start"),
    [
        # An outside corner between the move to the contour and its first element: the cutter rolls around it.
        ("square-next", "G01 X0 Y0/X20./Y20.", "G00 Y-20."),
        ("square-entry", "G01 X0 Y0/X20./Y20.", "G00 Y-20."),
        # An inside corner: the path begins where the cutter touches both.
        ("square-entry", "G01 X0 Y0/X20./Y20.", "G00 Y20."),
        ("square-entry", "G01 X0 Y0/X20./Y20.", "G00 Y3."),
    ],
)
def test_the_move_to_the_contour_may_be_an_element_itself(entry: str, blocks: str, start: str, tmp_path: Path):
    lines = ["G17 G90", f"{start} X0", "G41 D1", *blocks.split("/"), "G40 X40."]
    (tmp_path / "a.nc").write_text("\n".join(lines) + "\n")
    about = ("--control", MILL, "--tool", "R4", "--setting", f"{MILL}.tool-entry={entry}", tmp_path / "a.nc")
    (contour,) = data("solve", *about)["contours"]
    begin = {"G00 Y-20.": (-4.0, 0.0), "G00 Y20.": (4.0, 4.0)}.get(start, ())
    begin = (0.0, 4.0) if entry == "square-next" else begin
    assert ends(contour["tool"])[:1] == ([begin] if begin else [])
    done = call("expand", "--no-comments", *about)
    assert done.exit_code == int(not begin)
    assert ("G02 X0. Y4." in done.stdout) is (begin == (-4.0, 0.0))


@pytest.mark.parametrize(
    ("control", "code", "is_rolled"),
    [("siemens-840d", "G450", True), ("siemens-840d", "G451", False), ("isg", "G26", True), ("isg", "G25", False)],
)
def test_the_program_says_the_way_around_outside_corners(control: str, code: str, is_rolled: bool, tmp_path: Path):
    program = f"G17 G90 G21\n{code}\nG0 X-10 Y-10\nG41 G1 X0 Y0 F100\nX0 Y30\nX40\nY0\nG40 X50\n"
    (tmp_path / "a.nc").write_text(program.replace("G21", "G71" if control != "isg" else "G21"))
    for more, rolled in (((), is_rolled), (("--outside", "roll"), True), (("--outside", "intersect"), False)):
        done = call("expand", "--control", control, "--tool", "R5", "--no-comments", *more, tmp_path / "a.nc")
        assert done.exit_code == 0, done.output
        assert ("CR=" in done.stdout or bool(re.search(r"G0?2 X", done.stdout))) is rolled
