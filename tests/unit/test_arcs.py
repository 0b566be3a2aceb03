"""Arcs by themselves: what is said of one in each place, what the settings change, and what is not known."""

import pytest

import contoursolve

MILL = "G21 G90 G17\nG00 X0 Y0\nG01 X10. F200.\n"


def told(text, control="fanuc-mill", **settings):
    named = {f"{control}.{name.replace('_', '-')}": value for name, value in settings.items()}
    found = contoursolve.check(text, control=control, settings=named)
    return [each for each in found if each.code.startswith(("arc-", "profile-begins"))]


def codes(text, control="fanuc-mill", **settings):
    return [(each.code, each.span.line) for each in told(text, control, **settings)]


@pytest.mark.parametrize(
    ("text", "control", "code", "fix"),
    [
        (MILL + "G02 X30. Y20. I17. J0.\nG01 X50. ,R2.\nY40.", "fanuc-mill", "arc-radii-differ", "write I20. for I17."),
        (
            "G20 G90 G17\nG00 X1. Y3.\nG02 X0.64 Y1.6 I-0.56 J-0.42",
            "mitsubishi",
            "arc-radii-differ",
            "write J-0.6023 f",
        ),
        ("G00 X150. Z0.\nG01 Z-10. F0.2\nG03 X144. Z-13. R1.", "fanuc-lathe", "arc-radius-small", "write R3. for R1."),
        (
            "0 BEGIN PGM A MM\n1 L X+20 Y+0 R0 F500\n2 CC X+37 Y+0\n3 C X+40 Y+20 DR-",
            "heidenhain",
            "arc-radii-differ",
            "write X+40 for X+37 in program line 3",
        ),
        ("G90 G17\nG00 X0 Y0\nG01 X10\nG02 X30 Y0 R10 I10 J0", "isg", "arc-both", "delete R10"),
        (MILL + "G02 X-30. Y0 I-10. J0.", "fanuc-mill", "arc-radii-differ", "write I-20. for I-10."),
        (MILL + "G02 X30. Y20. I30. J0.", "fanuc-mill", "arc-radii-differ", "write I20. for I30."),
        (MILL + "X20. Y10.\nG02 X20. Y0", "fanuc-mill", "arc-undefined", "write G01 for G02"),
    ],
)
def test_a_finding_names_what_would_agree(text, control, code, fix):
    found = told(text, control)
    assert [each.code for each in found] == [code]
    assert found[0].fixes[0].description.startswith(fix)


@pytest.mark.parametrize(
    ("arc", "found"),
    [
        ("G02 X30. Y20. I17. J0.", [("control-alike", 1), ("arc-radii-differ", 4)]),
        ("G02 X30. Y20. I20. J0.", [("no-contour", 1)]),
        ("G02 X30. Y20. R8.", [("control-alike", 1), ("arc-radius-small", 4)]),
    ],
)
def test_without_a_contour_and_a_control_an_arc_is_told_that_none_runs(arc, found):
    result = contoursolve.solve(MILL + arc + "\nM30")
    assert [(each.code, each.span.line) for each in result.diagnostics] == found
    assert result.has_errors == (len(found) > 1)


def test_each_fix_makes_the_arc_right():
    text = MILL + "G02 X30. Y21. I17. J2."
    (finding,) = told(text)
    lines = text.split("\n")
    assert len(finding.fixes) > 2
    for fix in finding.fixes:
        assert told("\n".join([*lines[:-1], fix.replacement])) == []


def test_of_an_arc_from_an_unknown_start_its_words_alone_are_judged():
    assert codes("G90 G17\nG02 X30. Y20. I17. J0.") == []
    assert codes("G90 G17\nG02 X30. Y20.") == [("arc-undefined", 2)]
    assert codes("G90 G17\nG02 X30. Y20. I5. K1.") == [("arc-outside-plane", 2)]
    assert codes("G91 G17\nG02 X30. Y20. I17. J0.") == [("arc-radii-differ", 2)]
    assert codes("G91 G17\nG02 X#1 Y20. I17. J0.") == []
    # X and Y of polar coordinates are no places.
    assert codes("G90 G17\nG00 X10. Y0\nG16\nG02 X10. Y90. R10.\nG15\nG00 X0 Y0\nG02 X30. Y0 R5.") == [
        ("arc-radius-small", 7)
    ]


def test_arcs_are_judged_in_subprograms_profiles_and_rows():
    called = "G90 G17\nG00 X0 Y0\nM98 P10\nM30\nO0010\nG02 X20. Y0 I9. J0\nX40. Y0 I10.\nM99"
    assert codes(called) == [("arc-radii-differ", 6)]
    before, behind = "G00 X62. Z2.\nG71 U2. R0.5\nG71 P10 Q20 U0.4 W0.1 F0.25\n", "\nN20 G01 X62.\nG70 P10 Q20\nM30"
    profile = before + "{}\nG02 X30. Z-20. R2." + behind
    assert codes(profile.format("N10 G00 X20.\nG01 Z-10."), "fanuc-lathe") == [("arc-radius-small", 6)]


@pytest.mark.parametrize(("control", "severity"), [("fanuc-lathe", "error"), ("haas-lathe", "warning")])
def test_the_profile_of_a_cycle_begins_with_a_line(control, severity):
    text = "T0101\nG00 X62. Z0.\nG71 {}\nG71 P10 Q20 U0.4 W0.1 F0.25\nN10 {} X60. Z-1. R1.\nG01 Z-20.\nN20 X62.\nM30"
    found = told(text.format("U2. R0.5", "G03"), control)
    assert [(each.code, each.severity.value) for each in found] == [("profile-begins-with-arc", severity)]
    assert told(text.format("U2. R0.5", "G01").replace(" R1.", ""), control) == []


def test_settings_say_what_the_control_does():
    off, without = MILL + "G02 X30. Y0 I9. J0.", MILL + "G02 X30. Y0"
    assert codes(off) == [("arc-radii-differ", 4)]
    assert codes(off, radius_difference="3") == []
    assert codes(off, radius_difference="0") == [("arc-spiral", 4)]
    (line,) = told(off, radius_difference="0", off_arc="axis_line")
    assert "straight line along one axis" in line.message
    assert codes(without, no_centre="line") == [("arc-runs-line", 4)]
    assert codes(MILL + "G02 X30. Y0 I20. J0.", arc_centre="origin") == []
    turned = "G00 X40. Z0.\nG01 Z-5. F0.2\nG02 X60. Z-15. R-12."
    assert codes(turned, "fanuc-lathe") == []
    assert codes(turned, "fanuc-lathe", negative_radius="error") == [("arc-over-half", 3)]


def test_sinumerik_allows_more_of_a_larger_radius_and_isg_moves_a_centre():
    far = "G17 G90\nG0 X0 Y0\nG2 X200 Y0 I100.02 J0"
    assert codes(far, "siemens-840d") == []
    assert codes(far, "siemens-840d", radius_difference_factor="0.0001") == [("arc-radii-differ", 3)]
    moved = "G17 G90\nG0 X0 Y0\n{}G2 X20 Y0 I10.02 J0"
    assert codes(moved.format(""), "isg") == [("arc-centre-moves", 3)]
    assert codes(moved.format(""), "isg", centre_correction="off") == [("arc-radii-uncorrected", 3)]
    assert codes(moved.format("G164\n"), "isg") == [("arc-radii-uncorrected", 4)]
    assert codes(moved.format("G164\nG165\n"), "isg") == [("arc-centre-moves", 5)]
    assert codes("G17 G90\nG0 X0 Y0\nG2 X60 Y10 I10 J0", "isg") == [("arc-radii-differ", 3)]
    assert codes("G17 G90\nG0 X5 Y0\nG161\nG0 X5 Y0\nG2 X25 Y0 I15 J0", "isg") == []


def test_coordinates_of_a_centre_are_told_as_such():
    """Fixes write them as the control reads them; the setting leaves them as they are."""
    text = MILL + "G02 X30. Y20. I30. J0."
    (finding,) = told(text)
    assert "I30. and J0. fit as coordinates of the centre" in finding.notes[-1]
    assert told(text, arc_centre="origin") == []
    assert not told(MILL + "G02 X30. Y20. I17. J0.")[0].notes
