"""SINUMERIK: every worked example of its sheet, right and wrong, how it is spelled, its settings, RNDM and CT."""

import re
from math import dist
from random import Random

import pytest
from examples import law
from examples_fanuc import drawn
from hypothesis import strategies as st
from oracle import Element
from oracle_corners import gap
from vectors import program_of

from contoursolve import expand, solve

CONTROLS = ("siemens-840d", "siemens-808d")
MILL = "G17 G90 G0 X0 Y0\n"
SI_G1, SI_G4, SI_G5 = (program_of(CONTROLS[0], f"SI-G{number}") for number in (1, 4, 5))


def siemens(text: str, control: str = CONTROLS[0], depth: str = "full", **settings: str):
    named = {f"{control}.{name.replace('_', '-')}": value for name, value in settings.items()}
    return solve(text, control=control, settings=named, depth=depth)


def path(text: str, control: str = CONTROLS[0], **settings: str) -> list[Element]:
    """All contours, one behind the other; they have no errors."""
    result = siemens(text, control, **settings)
    assert not result.has_errors, [each.message for each in result.diagnostics]
    return [element for answer in result.answers for element in path_of(answer)]


def path_of(answer) -> list[Element]:
    found = []
    for each in answer.contour.elements if answer.contour else ():
        start, end = complex(*each.start), complex(*each.end)
        if hasattr(each, "center"):
            found.append(Element("arc", start, end, complex(*each.center), each.radius, each.turn.value))
        else:
            found.append(Element("line", start, end))
    return found


def ends(text: str, **settings: str) -> list[tuple[float, float]]:
    return [(each.end.real, each.end.imag) for each in path(text, **settings)]


def near(*places: tuple[float, float]):
    return [pytest.approx(place, abs=1e-4) for place in places]


def codes(text: str, **settings: str) -> dict[str, str | None]:
    """The alarms of all findings by their codes."""
    found = siemens(text, depth="verdict", **settings).diagnostics
    return {each.code: each.alarm.number.split()[0] if each.alarm else None for each in found}


def refused(text: str, code: str, alarm: str | None = None, **settings: str) -> None:
    """That the error is found, with its alarm, and no contour called solved with it."""
    result = siemens(text, depth="verdict", **settings)
    errors = [each for each in result.diagnostics if each.severity.value == "error"]
    assert [each.code for each in errors][:1] == [code], [each.message for each in errors]
    assert (errors[0].alarm.number.split()[0] if errors[0].alarm else None) == alarm
    line = errors[0].span.line
    assert not [each for each in result.answers if each.contour and each.lines[0] <= line <= each.lines[-1]]


@law(st.floats(0.01, 9), st.sampled_from(["", " CHF"]), few=2, many=3)
def test_the_face_of_a_chamfer_beside_an_arc_has_its_length_between_ends_as_far_from_the_corner(face, behind):
    text = MILL + f"G1 X40 CHF={face:.6f}\nG2 X60 Y20 I20 J0{behind and behind + f'={face / 2:.6f}'}\nG1 X100 Y30"
    (answer,) = siemens(text).answers
    lengths = iter((round(face, 6), round(face / 2, 6)))
    for corner in (each for each in answer.contour.elements if each.name.startswith("corner")):
        at = answer.contour.points[f"V{corner.name[-1]}"]
        assert dist(corner.start, corner.end) == pytest.approx(next(lengths), abs=1e-9)
        assert dist(corner.start, at) == pytest.approx(dist(corner.end, at), abs=1e-9)


@pytest.mark.parametrize(
    ("text", "code", "fixes"),
    [
        ("G1 X60 Y20 ANG=45", "siemens-angle-redundant", ["G1 X60 Y20", "G1 Y20 ANG=45", "G1 X60 ANG=45"]),
        ("G1 X30 CHR=2 RND=3\nY40", "siemens-chr-ignored", ["G1 X30 RND=3\nY40"]),
        ("G1 X30 CHF=3 RND=3\nY40", "siemens-chf-ignored", ["G1 X30 RND=3\nY40"]),
        ("G1 ANG=30 RND=6\nX60 Y20", "siemens-closing-incomplete", ["G1 ANG=30 RND=6\nX60 Y20 ANG=?"]),
        ("G1 ANG=30\nX60 ANG=-45", "siemens-closing-incomplete", ["G1 ANG=30\nX60 ANG=-45 Y?"]),
        ("G1 ANG=30\nX60 Y20 ANG=45", "angle-opposite", ["G1 ANG=30\nX60 Y20 ANG=-45"]),
        ("G1 X40 Y20 ANG=62", "siemens-angle-redundant", ["G1 X40 Y20"]),
        ("G1 X=IC(5) Y=IC(5) ANG=40", "siemens-angle-redundant", ["G1 X=IC(5) Y=IC(5)"]),
        ("G1 X30 RND=300\nY40", "siemens-corner-too-large", ["G1 X30 RND=30\nY40"]),
        ("G1 X=IC(30) CHR=35\nY=IC(40)", "siemens-corner-too-large", ["G1 X=IC(30) CHR=30\nY=IC(40)"]),
        ("G1 X30 RND=-3\nY40", "siemens-corner-negative", ["G1 X30 RND=3\nY40"]),
        ("G1 X=IC(30) RND=3\nX=IC(20)", "siemens-corner-straight", ["G1 X=IC(30)\nX=IC(20)"]),
        ("G1 X30 RND=2\nG2 X40 Y10", "siemens-circle-undefined", ["G1 X30 RND=2\nG2 X40 Y10 CR=?"]),
        ("G1 X30 RND=2\nG2 X60 Y31 I30 J0\nG1 X90", "siemens-radius-difference", ["G1 X30 RND=2\nG2 X60 Y30 I30 J0"]),
        ("G1 X30\nCT X40 Y10 CR=5", "siemens-shape-on-tangent", ["G1 X30\nCT X40 Y10"]),
        ("G1 X30 RND=2\nG2 X40 Y10 CR=10 ANG=45", "siemens-angle-on-arc", ["G1 X30 RND=2\nG2 X40 Y10 CR=10"]),
        ("G1 ANG=30\nX60 Y20 ANG=-45 RND=5\nM30", "siemens-corner-without-next", ["G1 ANG=30\nX60 Y20 ANG=-45"]),
        ("G1 X40 AGN=5\nY40", "word-mistyped", ["G1 X40 ANG=5"]),
    ],
)
def test_the_first_fixes_are_what_a_colleague_would_name(text, code, fixes):
    found = siemens(MILL + text).diagnostics
    (first, *_) = [each for each in found if each.code == code]
    assert [each.replacement for each in first.fixes][: max(len(fixes), 1)] == fixes
    assert not fixes or next(each for each in found if each.fixes) is first


@pytest.mark.parametrize("word", ["CHR=2", "CHF=3"])
def test_a_rounding_beside_a_chamfer_wins(word):
    text = MILL + f"G1 X30 {word} RND=3\nY40"
    assert path(text) == path(text.replace(f" {word}", ""))
    assert {each.severity.value for each in siemens(text).diagnostics} == {"warning"}


# How it is spelled ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "G1 X80 RND=5\nY40",
        "G1 X=80 RND=5\nY=40",
        "G1 X = 80 RND = 5\nY40",
        "N10 G1 X=AC(80) RND=5\nN10 Y=IC(40)",
        "G1 X=IC(80) RND=5\nG91 Y40",
        "g1 x80 rnd=5\ny=ic( 40 )",
        "G01 X80.0 RND=5.000;\nY+40.0 ; END",
        "G1 X80 RND=5 FRC=0.1\nY40 FRCM= 200",
        "/G1 X80 RND=5\n; Y20\n\nY40",
        "G1 X80 RND=5 M8 F200 S=1000\nMARK: Y40",
        'G1 X80 RND=5\nM8\nG4 F0.5\nMSG("CORNER (5)")\nY40',
        "G91 G1 X80 RND=5\nY=AC(40)",
        "G1 X80 RND=5\nG64\nY40 G90",
    ],
)
def test_the_same_corner_is_read_however_it_is_written(text):
    for name in ("", "%_N_CONTOUR_MPF\n;$PATH=/_N_WKS_DIR/_N_A_WPD\n"):
        assert gap(drawn("0 0; 75 0 > ccw 80 5 75 5; 80 40", 1), path(name + MILL + text)) < 1e-9


def test_a_start_that_is_read_before_the_diameters_are_switched_is_told():
    block = "G18 DIAMON G1 X60 ANG=120 RND=2\nZ-50"
    told = {
        start: {each.code for each in solve(block, start=start).diagnostics} for start in ("X40 Z0", "DIAMON X40 Z0")
    }
    assert "start-diameter" in told["X40 Z0"]
    assert told["DIAMON X40 Z0"] == set()


@pytest.mark.parametrize(
    ("control", "value", "is_reduced"),
    [(CONTROLS[0], "", False), (CONTROLS[0], "reduce", True), (CONTROLS[1], "", True), (CONTROLS[1], "error", False)],
)
def test_a_corner_that_does_not_fit_is_refused_and_what_the_control_does_is_told(control, value, is_reduced):
    settings = {f"{control}.too-big": value} if value else {}
    (answer,) = solve(MILL + "G1 X30 RND=50\nY40", control=control, settings=settings).answers
    assert answer.contour is None
    assert ("makes it smaller by itself" in answer.diagnostics[0].message) is is_reduced


@pytest.mark.parametrize(
    ("between", "told"),
    [
        ("L10", "L10"),
        ("POCKET", "POCKET"),
        ('CYCLE95("KONTUR",2,0.1,,,0.2)', "CYCLE95"),
        ("ROT RPL=30\nG0 X0 Y0\nTRANS X10", "TRANS"),
        ("ROT RPL=30", "ROT"),
        ("G54", "G54"),
        ("G1 AP=30 RP=20", "read AP yet"),
        ("POLY PO[X]=(20,1) PO[Y]=(5)", "POLY"),
        ("G1 X1=5", "read X1 yet"),
        ("M17", "M17"),
        ("IF R1>5 GOTOF ENDE\nG1 X5\nENDE:", "R1"),
        ("G1 X=R1 Y=R2+5", "variable"),
        ("G751", "G751"),
    ],
)
def test_behind_what_is_not_followed_the_position_is_unknown(between, told):
    text = MILL + between + "\nG1 Y60 ANG=30"
    result = siemens(text)
    is_called = between in ("L10", "POCKET")
    codes = ["mode-unknown"] * is_called + ["position-unknown"]
    assert [each.code for each in result.diagnostics if each.severity.value == "error"] == codes
    assert told in result.diagnostics[0].message
    assert result.answers[0].contour is None
    modes = "G17 G71 G90 DIAMOF RNDM=0 " * is_called
    again = siemens(MILL + between + f"\n{modes}G0 X0 Y0\nG1 Y60 ANG=30")
    assert [each.contour is not None for each in again.answers] == [True]


def test_an_increment_from_an_unknown_start_leads_nowhere():
    text = "G17 G90 G0 X=R1 Y=R1\nG91 G1 ANG=30 RND=1\nX116 Y115.4 ANG=120\nG0 X5\nG1 Y94 RND=1\nX20"
    assert [(each.code, each.span.line) for each in siemens(text).diagnostics] == [
        ("position-unknown", 2),
        ("position-unknown", 5),
    ]


# Planes and diameters -----------------------------------------------------------------------------------------------


def test_x_is_what_its_command_says():
    def diameters(head: str, tail: str = "G1 X40 Z-30 RND=2\nZ-50", **settings: str):
        return ends(f"{head} G90 G0 X20 Z0\n{tail}", **settings)

    as_radius = diameters("G18 DIAMOF")
    as_diameter = ends("G18 DIAMOF G90 G0 X10 Z0\nG1 X20 Z-30 RND=2\nZ-50")
    assert diameters("G18 DIAMON") == near(*as_diameter)
    assert diameters("G18 DIAM90") == near(*as_diameter)
    assert diameters("G18 DIAM90", "G1 X=IC(20) Z-30 RND=2\nZ-50")[0] != pytest.approx(as_diameter[0])
    assert diameters("G18 DIAM90", "G91 G1 X10 Z-30 RND=2\nZ-20") == near(*as_diameter)
    assert diameters("G18 DIAMON", "G91 G1 X20 Z-30 RND=2\nZ-20") == near(*as_diameter)
    # Nothing tells: the plane does, and the result rests on it.
    assert diameters("G18") == near(*as_diameter)
    (answer,) = siemens("G18 G90 G0 X20 Z0\nG1 X40 Z-30 RND=2\nZ-50").answers
    assert [each.setting.name for each in answer.claim.conventions] == ["diam"]
    for value, expected in (("DIAMOF", as_radius), ("DIAMON", as_diameter), ("DIAM90", as_diameter)):
        assert diameters("G18", diam=value) == near(*expected)
    assert ends("G0 X20 Z0\nG1 X40 Z-30 RND=2\nZ-50", machine="lathe") == near(*as_diameter)
    assert ends("G0 X20 Z0\nG1 X40 Z-30 RND=2\nZ-50") == near(*as_diameter)
    assert siemens("G0 X20 Z0\nG1 X40 Z-30 RND=2\nZ-50", machine="mill").answers[0].contour is None


def test_a_switch_of_diameters_before_a_corner_counts():
    before = MILL.replace("G17", "G18 DIAMOF").replace("Y0", "Z0")
    assert ends(before + "DIAMON\n" + "G1 X60 RND=5\nX80 Z40") == near(*ends(before + "G1 X30 RND=5\nX40 Z40"))


# Settings -----------------------------------------------------------------------------------------------------------


MEETING = MILL + "G1 X10 Y5\nANG=30 RND=6\n{} ANG=-45"


@pytest.mark.parametrize(
    ("text", "settings", "code", "alarm"),
    [
        (MILL + "G1 X40 ANG=210", {"angle_sense": "ray"}, "line-reversed", None),
        (MILL + "G1 X40 Y40 ANG=45", {}, "siemens-angle-redundant", "10795"),
        (MILL + "G1 X40 Y40 ANG=44", {"redundant_angle": "check"}, "words-conflict", None),
        (MEETING.format("X=IC(60) Y=IC(20)"), {"closing_incremental": "error"}, "siemens-closing-increment", None),
        (MILL + "G1 X30 CHR=2\nG2 X50 Y20 CR=20", {"chamfer_on_arc": "arc_length"}, "siemens-chamfer-along-arc", None),
        (MILL + "G2 X20 Y20 CR=20 CHR=2\nG1 Y0", {"chamfer_on_arc": "arc_length"}, "siemens-chamfer-along-arc", None),
        (MILL + "RNDM=20\nG1 X30\nY10\nX50", {}, "siemens-corner-too-large", None),
        (MILL + "G1 X10 RND=2\nCT X20 Y10", {}, "siemens-corner-straight", None),
        (MILL + "CT X20 Y10\nG1 X30 RND=2\nY40", {}, "siemens-no-tangent", None),
        (MILL + "M8\n" * 4 + "CT X20 Y10\nG1 X30 RND=2\nY40", {}, "siemens-no-tangent", None),
        (MILL + "G4 F1\nCT X20 Y10\nG1 X30 RND=2\nY40", {}, "siemens-no-tangent", None),
        ("G18 DIAMOF G0 X0 Z0\nG1 X30 RND=5\nDIAMON\nX40 Z40", {}, "siemens-corner-without-next", None),
        ("G18 DIAMOF G0 X0 Z0\nG1 X30 RND=5\nDIAMON X40 Z40", {}, "siemens-diameter-changes", None),
        (MILL + "G1 ANG=-_ANG RND=5\nX40 Y40 ANG=90", {}, "value-variable", None),
        (MILL + "G1 X30 RND=_RND+12.5\nX40 Y40", {}, "value-variable", None),
        (MILL + "G1 Y40 ANG=R5", {}, "value-variable", None),
        (MILL + "RNDM=_R\nG1 X30\nX40 Y40", {}, "value-variable", None),
    ],
)
def test_what_the_control_refuses_has_its_code_and_its_alarm(text, settings, code, alarm):
    refused(text, code, alarm, **settings)


@pytest.mark.parametrize(
    ("text", "settings", "places"),
    [
        (MILL + "G1 X40 ANG=210", {}, [(40, 23.0940)]),
        (MILL + "G1 X40 Y40 ANG=45", {"redundant_angle": "check"}, [(40, 40)]),
        (MEETING.format("X70 Y25"), {}, [(56.7308, 31.9801), (63.9735, 31.0265), (70, 25)]),
        (MILL + "G1 X30 CHR=2\nY40", {"chamfer_on_arc": "arc_length"}, [(28, 0), (30, 2), (30, 40)]),
        (MILL + "G1 X30 CHR=3\nX60 Y40", {}, [(27, 0), (31.8, 2.4), (60, 40)]),
        # The path turns by the angle of 3 4 5: the half of it has the cosine 2 / sqrt(5).
        (MILL + "G1 X30 CHF=2\nX60 Y40", {}, [(30 - 1.25**0.5, 0), (30 + 0.6 * 1.25**0.5, 0.8 * 1.25**0.5), (60, 40)]),
        ("G17 G70 G0 X0 Y0\nG1 X1 RND=0.1\nY2", {}, [(22.86, 0), (25.4, 2.54), (25.4, 50.8)]),
        ("G17 G700 G0 X0 Y0\nG1 X1 RND=0.1\nY2", {}, [(22.86, 0), (25.4, 2.54), (25.4, 50.8)]),
        (MILL + "G71 G1 X25.4 RND=2.54\nY50.8", {}, [(22.86, 0), (25.4, 2.54), (25.4, 50.8)]),
    ],
)
def test_words_mean_what_the_settings_say(text, settings, places):
    assert ends(text, **settings) == near(*places)


def test_an_angle_the_other_way_is_told_and_increments_close_a_pair():
    assert "angle-opposite" in codes(MILL + "G1 X40 ANG=210")
    for closing in ("X=IC(60) Y=IC(20)", "G91 X60 Y20"):
        assert ends(MEETING.format(closing)) == ends(MEETING.format("X70 Y25"))
    on_arc = path(MILL + "G1 X30 CHR=2\nG2 X50 Y20 CR=20")
    assert (abs(on_arc[1].end - 30), abs(on_arc[1].end - 50)) == pytest.approx((2, 20), abs=1e-9)


def test_a_polar_move_is_no_part_of_a_contour():
    for text in ("G1 AP=30 RP=20 RND=5\nX40", "G1 X30 RND=5\nAP=90 RP=50\nX20"):
        assert not any(each.contour for each in siemens(MILL + text).answers), text


@pytest.mark.parametrize("word", ["RND5", "RND 5", "CHR2.5", "ANG45", "RND=5.5.", "RNDM3", "CR5"])
def test_a_name_without_an_equals_sign_is_told(word):
    refused(MILL + f"G1 X30 {word}\nY40", "number-malformed")
    (finding,) = [each for each in siemens(MILL + f"G1 X30 {word}\nY40").diagnostics if each.code == "number-malformed"]
    assert "RND=5" in finding.help


# RNDM and CT --------------------------------------------------------------------------------------------------------


def test_rndm_rounds_every_corner_until_it_is_0():
    frame = MILL + "{}G1 X30\nX40 Y40\nX80{}\nY80\n{}X90\nY0"
    every = path(frame.format("RNDM=3\n", "", ""))
    assert [each.kind for each in every] == ["line", "arc"] * 5 + ["line"]
    assert {each.radius for each in every if each.kind == "arc"} == {3.0}
    written = re.sub(r"(?<=\d)$", " RND=3", frame.format("", "", ""), flags=re.MULTILINE)
    assert gap(every, path(written.replace("G0 X0 Y0 RND=3", "G0 X0 Y0").removesuffix(" RND=3"))) < 1e-9
    own = path(frame.format("RNDM=3\n", " CHR=2", ""))
    assert "".join(each.kind[0] for each in own) == "lalalllalal"
    ended = path(frame.format("RNDM=3\n", "", "RNDM=0\n"))
    assert [each.kind for each in ended] == ["line", "arc"] * 4 + ["line"], "the last line is none of the contour"
    later = path(frame.format("", " RND=1", "RNDM=2\n"))
    assert [each.radius for each in later if each.kind == "arc"] == [1.0, 2.0]
    begun = path(frame.format("", " RND=1\nRNDM=2", ""))
    assert [each.radius for each in begun if each.kind == "arc"] == [1.0, 2.0, 2.0]


def test_rndm_makes_no_corner_where_the_path_does_not_turn():
    text = MILL + "RNDM=3\nG1 X10\nX20\nY10\nG3 X10 Y20 I-10 J0\nG1 X0\nCT X-10 Y10"
    assert [each.kind for each in path(text)] == ["line", "line", "arc", "line", "arc", "line", "arc"]


def test_rndm_makes_no_corner_at_a_rapid():
    first, second = siemens(MILL + "RNDM=2\nG1 X30\nY40\nG0 X0\nG1 Y20\nX5").answers
    assert [each.kind for each in path_of(first)] == ["line", "arc", "line"]
    assert path_of(second)[0].start == 40j


def test_a_tangent_arc_follows_lines_arcs_and_tangent_arcs():
    expected = drawn("0 0; 10 0; ccw 20 10 10 10; cw 30 0 30 10; cw 40 10 30 10", 1)
    assert gap(expected, path(MILL + "G1 X10\nCT X20 Y10\nX30 Y0\nX40 Y10")) < 1e-9
    line, first, second, third = path(MILL + "G1 X10\nCT X20 Y10\nX30 Y20\nX50 Y0")
    assert (line.end, first.center, first.turn) == (10, pytest.approx(10 + 10j), "ccw")
    assert (second.center, second.turn) == (pytest.approx(30 + 10j), "cw")
    assert (third.turn, third.center.real) == ("cw", pytest.approx(30))
    arc = path(MILL + "G2 X20 Y0 CR=20\nCT X40 Y10")
    radius = arc[0].end - arc[0].center
    assert (radius.conjugate() * (arc[1].center - arc[0].end)).imag == pytest.approx(0, abs=1e-9)
    assert [each.turn for each in arc] == ["cw", "ccw"]
    met = path(MILL + "G1 ANG=30\nX60 Y20 ANG=-45\nCT X70 Y0")
    assert (met[2].center, met[2].turn) == (pytest.approx(35 - 5j), "cw")


@pytest.mark.parametrize("text", ["CT X20 Y10", "G91 CT X10 Y10", "CT X=IC(10) Y=IC(10)", "CT X=AC(20) Y=IC(10)"])
def test_a_tangent_arc_ends_where_increments_and_coordinates_say(text):
    assert path(MILL + "G1 X10\n" + text) == path(MILL + "G1 X10\nCT X20 Y10")


def test_a_tangent_arc_straight_ahead_is_a_line_and_one_behind_is_none():
    assert path(MILL + "G1 X10 Y10\nCT X20 Y20\nX30 Y20") == path(MILL + "G1 X10 Y10 RND=0\nG1 X20 Y20\nCT X30 Y20")
    for text in ("CT X5", "CT X10", "CT"):
        assert siemens(MILL + "G1 X10\n" + text).answers[0].contour is None, text


def test_a_tangent_arc_has_corners():
    inside = path(MILL + "G1 X10\nCT X20 Y10 RND=2\nG1 X40 CHR=1\nY0")
    assert [each.kind for each in inside] == ["line", "arc", "arc", "line", "line", "line"]
    assert abs(inside[1].end - (10 + 10j)) == pytest.approx(10)
    between = path(MILL + "G1 X10 RND=1\nY10\nCT X20 Y20")
    assert [each.kind for each in between] == ["line", "arc", "line", "arc"]


def test_three_blocks_may_stand_before_a_tangent_arc():
    assert path(MILL + "G1 X10\n" + "M8\n" * 3 + "CT X20 Y10") == path(MILL + "G1 X10\nCT X20 Y10")


@pytest.mark.parametrize("text", ["RND=6", "ANG=30"])
def test_three_blocks_may_stand_between_and_not_four(text):
    chain = SI_G4.replace("RND=6\n", "RND=6\n{}")
    assert ends(chain.format("M8\nG4 F1\nS200\n")) == ends(chain.format("")) == ends(chain.format("; A\n\n" * 5))
    result = siemens(chain.format("M8\n" * 4))
    assert result.has_errors
    assert all(each.contour is None for each in result.answers)


def test_a_long_stream_keeps_a_rounding_in_force():
    text = MILL + "RNDM=2\nG1 X10\nX10 Y10\nX20 Y10\nX20 Y0\nX30\nG0 X0 Y0\nM30\n"
    moves = re.findall(r"^G0[123].*$", expand(text, control=CONTROLS[0]).text, re.MULTILINE)
    turns = [each.split()[0] for each in moves if each.startswith(("G02", "G03"))]
    assert turns == ["G03", "G02", "G02", "G03"], "left at 10 0, right at 10 10 and 20 10, left at 20 0"


# Laws ---------------------------------------------------------------------------------------------------------------


def drawn_points(rng: Random, count: int) -> list[complex]:
    """Places of a path that neither turns back nor goes straight on."""
    found = [0j, 20 + 0j]
    while len(found) < count + 2:
        step = complex(round(rng.uniform(-40, 40), 3), round(rng.uniform(-40, 40), 3))
        turn = step / (found[-1] - found[-2])
        if abs(step) > 10 and abs(turn.imag) / abs(turn) > 0.2:
            found.append(found[-1] + step)
    return found[1:]


def heading(element: Element, at: complex) -> complex:
    """The direction of travel at a place of an element."""
    if element.center is None:
        return (element.end - element.start) / abs(element.end - element.start)
    return (at - element.center) / element.radius * (1j if element.turn == "ccw" else -1j)


@pytest.mark.parametrize("seed", range(10))
def test_random_tangent_arcs_begin_in_the_direction_before_them_and_end_at_their_words(seed):
    rng = Random(seed)
    for _ in range(5):
        places = drawn_points(rng, rng.randint(1, 5))
        motions = [rng.choice(("CT", "CT", "G1")) for _ in places[1:-1]] + ["CT"]
        lines = ["G1 X20"]
        for motion, place, before in zip(motions, places[1:], places[:-1], strict=True):
            step = place - before
            words = rng.choice((f"X{place.real:.6f} Y{place.imag:.6f}", f"X=IC({step.real:.6f}) Y=IC({step.imag:.6f})"))
            lines.append(f"{motion} {words}")
        text = MILL + "\n".join(lines)
        found = [each for answer in siemens(text).answers for each in path_of(answer)]
        before = Element("line", 0j, 20 + 0j, None, 0.0, "")
        for motion, start, end in zip(motions, places[:-1], places[1:], strict=True):
            line = Element("line", start, end, None, 0.0, "")
            fitting = [each for each in found if abs(each.end - end) < 1e-6 and abs(each.start - start) < 1e-6]
            own = fitting[0] if fitting else None
            if motion == "CT":
                assert own is not None, text
                assert own.kind == "arc"
                assert abs(heading(before, start) - heading(own, start)) < 1e-6, text
                assert abs(abs(own.end - own.center) - own.radius) < 1e-8
            before = own or line


@pytest.mark.parametrize("seed", range(10))
def test_a_rounding_in_force_is_the_same_as_one_at_each_corner(seed):
    rng = Random(seed)
    for _ in range(5):
        places, size = drawn_points(rng, rng.randint(2, 5)), round(rng.uniform(0.1, 3), 3)
        ends = [f"X{place.real:.3f} Y{place.imag:.3f}" for place in places]
        own = rng.randrange(len(ends) - 1)
        written = [f"{end} RND={0.5 if number == own else size}" for number, end in enumerate(ends[:-1])]
        force = [f"{end} RND=0.5" if number == own else end for number, end in enumerate(ends)]
        one = siemens(MILL + "G1 " + "\n".join([*written, ends[-1]]))
        other = siemens(MILL + f"RNDM={size}\nG1 " + "\n".join(force))
        assert one.has_errors == other.has_errors
        if not one.has_errors:
            assert gap(path_of(one.answers[0]), path_of(other.answers[0])) < 1e-9


def test_where_a_corner_is_not_made_the_words_of_the_end_still_say_where_it_is():
    head, tail = "G18 G90 DIAMON G54\nG0 X16 Z0\nG1 X20\nZ-25 RND=9\nX30 CHR=1\nZ-40\n", "X40 ANG=150\nM30"
    wrong, last = solve(head + tail, control="siemens-840d").answers
    assert wrong.contour is None
    assert last.start.values == (-40, 15)
    # An increment of a line that has no start has no end, either.
    unknown = "G17 G90 G54\nG0 X=R1 Y=R1\nG91 G1 ANG=30 RND=1\nX100 Y100 ANG=120\nG1 X10 RND=2\nY10\nM30"
    first, second = solve(unknown, control="siemens-840d").answers
    assert first.start.values == second.start.values == (None, None)


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("G1 X20 RND=5\nSUB1\nM30\nPROC SUB1\nY20\nRET", "a corner"),
        ("SUB1\nY20\nM30\nPROC SUB1\nG1 X20 RND=5\nRET", "a corner"),
        ("G1 ANG=30\nSUB1\nM30\nPROC SUB1\nX60 Y20 ANG=90\nRET", "a line by its angle alone"),
    ],
)
def test_what_goes_on_behind_a_call_is_refused_for_that(text, what):
    told = solve(f"G17 G90 G54\nG0 X0 Y0\n{text}", control="siemens-840d").diagnostics
    first = next(each for each in told if each.is_error)
    assert (first.code, first.fixes) == ("not-read", ())
    assert first.message == f"contoursolve does not read {what} right before a call or a return yet"
