"""Legal contours in which one point stands out: a warning with the number that was probably meant; none for tapers."""

import pytest

from contoursolve import solve

LATHE = "G00 X20. Z2.\nG01 X20. Z0. F0.2\n{}X62. Z-50. ,C1.5\nX62. Z-70."
STEPS = "X30. Z0. ,C1.\nX30. Z-25. ,R2.\nX46. Z-25. ,C1.5\nX46. Z-50. ,R3.\n"
FRAME = "G17 G90\nG0 X0 Y0\nG1 X60 Y0 RND=2 F200\nX60 Y40 CHR=4\nX20 Y40 RND=2\nX20 Y25 RND=1\nX0 Y25 RND=2\nX0 Y0"

PLATE = "G17 G90\nG00 X5. Y5.\nG01 X65. ,C2. F250.\nY45. ,C3.\n{} ,C2.\nY5."
START, MINUS = "(the start of the corner)", "(a minus sign too many)"
ZERO, POINT = "(a lost zero)", "(the decimal point moved)"


def suspected(text: str, control: str) -> list[str]:
    found = [each for each in solve(text, control=control).diagnostics if each.about.value == "suspected"]
    return [fix.description.split(" -> ")[0] for each in found for fix in each.fixes]


@pytest.mark.parametrize(
    ("control", "text", "expected"),
    [
        ("fanuc-lathe", LATHE.format(STEPS.replace("X30. Z0.", "X28. Z0.")), f"write X30. for X28. {START}"),
        ("haas-lathe", LATHE.format(STEPS.replace("X30. Z-25.", "X30. Z-23.")), f"write Z-25. for Z-23. {START}"),
        ("fanuc-lathe", LATHE.format(STEPS.replace("X46. Z-50.", "X4.6 Z-50.")), f"write X46. for X4.6 {POINT}"),
        ("siemens-840d", FRAME.replace("X60 Y40", "X60 Y36"), f"write Y40 for Y36 {START}"),
        ("siemens-840d", FRAME.replace("X20 Y40", "X-20 Y40"), f"write X20 for X-20 {MINUS}"),
        ("siemens-840d", FRAME.replace("X20 Y40", "X2 Y40"), f"write X20 for X2 {ZERO}"),
        ("fanuc-mill", PLATE.format("X-5."), f"write X5. for X-5. {MINUS}"),
    ],
)  # fmt: skip
def test_the_number_that_makes_all_lines_parallel_or_closes_the_path_is_told(control, text, expected):
    assert suspected(text, control) == [expected]


@pytest.mark.parametrize(
    ("control", "text"),
    [
        ("fanuc-lathe", LATHE.format(STEPS)),
        ("fanuc-lathe", LATHE.format(STEPS.replace("X46. Z-25. ,C1.5\nX46.", "X46. Z-25. ,C1.5\nX56."))),
        ("fanuc-lathe", LATHE.format("X30. Z0. ,C1.\nX32. Z-25. ,R2.\nX46. Z-25. ,C1.5\nX46. Z-50. ,R3.\n")),
        ("siemens-840d", FRAME),
        ("siemens-840d", FRAME.replace("X60 Y40", "X50 Y40")),
        ("siemens-840d", FRAME.replace("X60 Y40 CHR=4", "X60 Y37 CHR=4")),
        ("fanuc-mill", PLATE.format("X-8.")),
    ],
)
def test_a_taper_and_an_open_path_are_meant(control, text):
    assert suspected(text, control) == []
