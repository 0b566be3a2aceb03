"""ISG kernel: the worked examples of its sheet, right and wrong, how it is spelled, corners in blocks of their own."""

import re

import pytest
from click.testing import CliRunner
from examples_fanuc import drawn
from oracle import Element
from oracle_corners import gap
from vectors import VECTORS, program_of

from contoursolve import check, expand, solve
from contoursolve.cli import main
from contoursolve.diagnostics import Severity

ISG = "isg"
MILL = "G17 G90 G0 X0 Y0\n"


def isg(text: str, depth: str = "full", **settings: str):
    named = {f"isg.{name.replace('_', '-')}": value for name, value in settings.items()}
    return solve(text, control=ISG, settings=named, depth=depth)


def path(text: str, **settings: str) -> list[Element]:
    """All contours, one behind the other; they have no errors."""
    result = isg(text, **settings)
    assert not result.has_errors, [each.message for each in result.diagnostics]
    found = []
    for each in (element for answer in result.answers for element in answer.contour.elements):
        start, end = complex(*each.start), complex(*each.end)
        if hasattr(each, "center"):
            found.append(Element("arc", start, end, complex(*each.center), each.radius, each.turn.value))
        else:
            found.append(Element("line", start, end))
    return found


def ends(text: str, **settings: str) -> list[complex]:
    return [each.end for each in path(text, **settings)]


def refused(text: str, code: str, number: str | None = None, **settings: str) -> None:
    """That the error is found first, with its ID, and no contour of its blocks called solved."""
    result = isg(text, "verdict", **settings)
    errors = [each for each in result.diagnostics if each.severity.value == "error"]
    assert [each.code for each in errors][:1] == [code], [each.message for each in errors]
    assert (errors[0].alarm.number.split()[0] if errors[0].alarm else None) == number
    line = errors[0].span.line
    assert not [each for each in result.answers if each.contour and each.lines[0] <= line <= each.lines[-1]]


def test_two_corners_between_two_moves_are_refused():
    result = isg(MILL + "G1 X10\nG302 I2\nG301 I2\nG1 Y10")
    assert {each.alarm.number.split()[0] for each in result.diagnostics if each.alarm} == {"20351"}
    assert "20701" in next(each.alarm.number for each in result.diagnostics if each.alarm)
    assert all(each.contour is None for each in result.answers)


def test_an_angle_beside_both_coordinates_says_by_how_much_they_miss_and_names_the_ways_out():
    (finding,) = isg("N100 G17 G1 X10 Y10\n#ANG=45 X20 Y25").diagnostics
    assert "56.310 deg" in finding.message
    assert "3.536 mm" in finding.message
    fixes = [each.replacement for each in finding.fixes]
    assert {"#ANG=45 X20", "#ANG=45 Y25", "X20 Y25"} <= {*fixes}


def test_lines_of_a_comment_move_nothing():
    text = MILL + "#COMMENT BEGIN\nG1 X55 #ANG=100\nX90\n#COMMENT END\nG1 #ANG=45 X20"
    assert ends(text) == [pytest.approx(20 + 20j)]


def test_without_a_motion_code_g1_is_in_force_or_the_program_must_say_it():
    text = "N100 G17 X10 Y10\n#ANG=45 X20 Y25"
    refused(text, "isg-angle-redundant", "21895")
    result = isg(text, first_motion="none")
    assert not any(each.contour for each in result.answers)
    assert "no G code of a motion is in force" in result.diagnostics[0].notes[0]


# How it is spelled ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "G1 X80 #RND=5\nG1 Y40",
        "N10G01X80Y0 #RND 5\nN20Y40",
        "g1 x80 #rnd=5\ny40",
        "G1 #RND = 5 X=80 F100\nY=40",
        "G1 X80 #RND=5 #FRC=100\nY40 (END)",
        "G1 X80 (A (NESTED (DEEP)) COMMENT) #RND=5\nY40 (OPEN (TO THE END",
        "G1 X80 #RND=5 ;REMARK (\n\n(NOTHING)\nY40",
        "G91 G1 X80 #RND=5\nY40",
        "G1 X80\nG302 I5\nG1 Y40",
        "G1 X80\nG302I5 (R5)\n(NOTHING)\nY40",
        "G1 X80\nN5 G302 I=5\nN6 Y40",
        "/G1 X80 #RND=5\nY+40.0",
        "G1 # RND=5 X80\nY40.",
    ],
)
def test_the_same_corner_is_read_however_it_is_written(text):
    expected = drawn("0 0; 75 0 > ccw 80 5 75 5; 80 40", 1)
    for head in ("", "%MAIN\n#COMMENT BEGIN\n#COMMENT END\n"):
        assert gap(expected, path(head + MILL + text)) < 1e-9


@pytest.mark.parametrize(
    "text",
    [
        "G1 X100+P10 #ANG=30",
        "G1 X[100+P10] #ANG=30",
        "G1 X40 #ANG=P5",
        "G1 X40 #RND=V.P.R\nY40",
        "G1 X30\nG301 I=P1\nY30",
    ],
)
def test_an_expression_has_no_value(text):
    refused(MILL + text, "value-variable")


@pytest.mark.parametrize(
    ("between", "told"),
    [
        ("L SUB1", "SUB1"),
        ("LL LOCAL", "LL"),
        ("L10", "L10"),
        ("M17", "M17"),
        ("G54", "G54"),
        ("G68 R30", "G68"),
        ("G74 X0 Y0", "G74"),
        ("#ROTATION ON", "#ROTATION"),
        ("#CS ON [0,0,0]", "#CS"),
        ("$IF P1 > 5\nG1 X5\n$ENDIF", "P1"),
        ("G1 X=P1 Y=P2+5", "variable"),
        ("G161", "G161"),
    ],
)
def test_behind_what_is_not_followed_the_position_is_unknown(between, told):
    result = isg(MILL + between + "\nG1 Y60 #ANG=30")
    errors = [each for each in result.diagnostics if each.severity.value == "error"]
    is_called = between in ("L SUB1", "LL LOCAL")
    assert [each.code for each in errors] == ["mode-unknown"] * is_called + ["position-unknown"]
    assert told in errors[0].message
    assert result.answers[0].contour is None


# Planes, diameters and settings -------------------------------------------------------------------------------------


@pytest.mark.parametrize(("plane", "letters"), [(17, "XYIJ"), (18, "ZXKI"), (19, "YZJK")])
def test_planes_read_the_same_blocks_with_other_letters(plane, letters):
    table = str.maketrans("XYIJ", letters)
    text = MILL + "G1 #ANG=30 #RND=6\nX60 Y20 #ANG=-45 #CHR=2\nG3 X80 Y40 I20 J0\nG302 I1\nG1 Y80"
    own = re.compile(r"(?<![A-Z#])[XYIJ](?=[\d=])")
    lines = [own.sub(lambda word: word[0].translate(table), line.replace("I1", "\0")) for line in text.split("\n")]
    assert ends("\n".join(lines).replace("\0", "I1").replace("G17", f"G{plane}")) == pytest.approx(ends(text))


def test_x_is_a_diameter_behind_g51_and_a_radius_before_and_behind_g52():
    text = "G18 {} G90 G0 Z15 X4\nG1 #ANG=30 #RND=3\n#ANG=80 Z40 X60\nG302 I2\nG1 X80"
    radius = ends(text.format("").replace("X4", "X2").replace("X60", "X30").replace("X80", "X40"))
    assert ends(text.format("G51")) == pytest.approx(radius)
    assert ends(text.format("G51 G52")) == ends(text.format("")) != radius
    single = "G18 G51 G90 G0 Z0 X20\nG1 X40 #ANG=45"
    assert ends(single) == pytest.approx([10 + 20j])
    refused("G18 G51 G90 G0 X20 Z0\nG1 X40 #RND=2\nG52 Z-50", "isg-diameter-changes")
    by_radius = path("G18 G51 G90 G0 X20 Z10\nG1 Z0 #RND=1\nG2 X40 Z-10 R20")
    assert by_radius[-1].radius == pytest.approx(20)
    by_center = path("G18 G51 G90 G0 X20 Z10\nG1 Z0 #RND=1\nG2 X36 Z-4 I8 K6")
    assert by_center[-1].center == pytest.approx(6 + 18j)


def test_a_line_of_its_own_is_a_ray_and_one_of_a_pair_need_not_be():
    refused(MILL + "G1 X-40 #ANG=30", "isg-line-reversed")
    pair = MILL + "G1 #ANG=210\nX60 Y20 #ANG=-45"
    assert ends(pair) == pytest.approx(ends(pair.replace("210", "30")))
    assert [(each.code, each.severity.value) for each in isg(pair).diagnostics] == [("angle-opposite", "warning")]
    refused(pair, "isg-line-reversed", pair_sense="ray")
    assert ends(pair.replace("210", "30"), pair_sense="ray") == ends(pair.replace("210", "30"))
    refused(pair.replace("210", "30").replace("-45", "135"), "isg-line-reversed", pair_sense="ray")
    (answer,) = isg(pair, pair_sense="ray").answers
    assert [each.setting.name for each in answer.claim.conventions] == ["pair-sense"]


def test_the_radii_of_an_arc_may_differ_by_a_setting():
    text = MILL + "G1 X40 #RND=6\nG2 X60 Y20.05 I20 J0"
    refused(text, "radius-difference")
    assert abs(ends(text, radius_difference="0.1")[-1] - (60 + 20.05j)) < 1e-9


def test_a_chamfer_is_measured_as_its_word_says():
    assert ends(MILL + "G1 X30 #CHR=3\nX60 Y40") == pytest.approx([27, 31.8 + 2.4j, 60 + 40j])
    assert ends(MILL + "G1 X30\nG301 I3\nX60 Y40") == pytest.approx([27, 31.8 + 2.4j, 60 + 40j])
    face = ends(MILL + "G1 X30 #CHF=2\nX60 Y40")
    assert abs(face[1] - face[0]) == pytest.approx(2)
    arc = path(MILL + "G1 X30\nG301 I2\nG2 X50 Y20 I20 J0")
    assert abs(arc[1].end - 30) == pytest.approx(2)
    assert abs(arc[1].end - 50) == pytest.approx(20)


@pytest.mark.parametrize(
    ("text", "code", "fix"),
    [
        ("G1 #ANG=30 #RND=6\nX60 Y20", "isg-closing-incomplete", "G1 #ANG=30 #RND=6\nX60 Y20 #ANG=?"),
        ("G1 #ANG=30\nX60 #ANG=-45", "isg-closing-incomplete", "G1 #ANG=30\nX60 #ANG=-45 Y?"),
        ("G1 #ANG=30\nX60 Y20 #ANG=45", "angle-opposite", "G1 #ANG=30\nX60 Y20 #ANG=-45"),
        ("G1 X40 Y20 #ANG=62", "isg-angle-redundant", "G1 X40 Y20"),
        ("G1 X30 #RND=300\nY40", "isg-corner-too-large", "G1 X30 #RND=30\nY40"),
        ("G1 X30\nG302 I300\nG1 Y40", "isg-corner-too-large", "G1 X30\nG302 I30\nG1 Y40"),
        ("G1 X30\nG302 I-3\nG1 Y40", "isg-corner-negative", "G1 X30\nG302 I3\nG1 Y40"),
        ("G1 X30 #CHR=2 #RND=3\nY40", "isg-two-corners", "G1 X30 #RND=3\nY40"),
        ("G1 X30 #RND 3\nX50", "isg-corner-straight", "G1 X30\nX50"),
        ("G1 X30 #RND=2\nG2 X40 Y10", "isg-circle-undefined", "G1 X30 #RND=2\nG2 X40 Y10 R?"),
        ("G1 #ANG=30\nX60 Y20 #ANG=-45 #RND=5\nM30", "isg-corner-without-next", "G1 #ANG=30\nX60 Y20 #ANG=-45"),
        ("G1 X-40 #ANG=30", "isg-line-reversed", "G1 X-40 #ANG=150"),
    ],
)
def test_the_first_fix_is_what_a_colleague_would_name(text, code, fix):
    found = [each for each in check(MILL + text, control=ISG) if each.fixes]
    assert found[0].code == code
    assert found[0].fixes[0].replacement == fix


# Corners in blocks of their own -------------------------------------------------------------------------------------


def test_a_stored_size_stays_until_another_one_is_given():
    text = MILL + "G1 X30\nG302 I5\nY30\nG301\nX60\nG302 I2\nY60\nG302\nX90"
    written = MILL + "G1 X30 #RND=5\nY30 #CHR=5\nX60 #RND=2\nY60 #RND=2\nX90"
    assert ends(text) == pytest.approx(ends(written))
    later = MILL + "G1 X30\nG302 I5\nY30\nG0 X50\nG1 Y50\nG301\nX80"
    assert ends(later)[3:] == pytest.approx([50 + 45j, 55 + 50j, 80 + 50j])
    refused(later.replace(" I5", ""), "isg-corner-size", "20012")


def test_a_corner_block_moves_nothing_and_keeps_the_motion():
    text = MILL + "G91 G1 X30\nG302 I5\nY30\nG301 I3\nX30\nG3 X10 Y10 I0 J10\nG302 I1\nG1 X-40"
    assert ends(text)[-1] == pytest.approx(30 + 40j)


def test_corner_blocks_between_arcs_and_meeting_lines():
    text = MILL + "G1 #ANG=70\nG302 I2\nX80 Y25 #ANG=-30\nG301 I3\nG1 X90 Y60"
    assert ends(text) == pytest.approx(ends(MILL + "G1 #ANG=70 #RND=2\nX80 Y25 #ANG=-30 #CHR=3\nX90 Y60"))
    arcs = MILL + "G2 X20 Y20 I20 J0\nG302 I2\nG2 X40 Y40 I20 J0"
    assert ends(arcs) == pytest.approx(ends(MILL + "G2 X20 Y20 I20 J0 #RND=2\nG2 X40 Y40 I20 J0"))


def test_a_corner_block_may_say_more_and_a_word_and_a_block_are_one_too_many():
    refused(MILL + "G1 X30 #RND=2\nG302 I2\nG1 Y30", "isg-corner-twice")
    refused(MILL + "G1 X30 #RND=2\nG301 I2\nG1 Y30", "isg-two-corners")
    for block in ("G302 I2 X50", "G302 I2 I3", "G302 I2 #ANG=30", "G302 I2 Z-5", "G302 I2 Q1"):
        refused(MILL + f"G1 X30\n{block}\nG1 Y30", "isg-corner-crowded")
    refused(MILL + "G1 X30\nG302 G301 I2\nG1 Y30", "isg-corner-both", "20130")
    assert ends(MILL + "G1 X30\nN5 G302 I2 F100 M8\nG1 Y30") == ends(MILL + "G1 X30\nG302 I2\nG1 Y30")


# Expansion ----------------------------------------------------------------------------------------------------------

WRITTEN = {name: program_of(ISG, name) for name in VECTORS[ISG] if name.startswith("IS-")} | {
    "stored": MILL + "G1 X30\nG302 I5\nG1 Y30\nG301\nG1 X60 #FRC=100",
    "G51": "G18 G51 G90 G0 Z15 X4\nG1 #ANG=30 #RND=3\n#ANG=80 Z40 X60\nG302 I2\nG1 X80",
}


@pytest.mark.parametrize("name", [*WRITTEN])
@pytest.mark.parametrize("arcs", ["center", "radius"])
def test_what_is_written_out_goes_the_same_way(name, arcs, tmp_path):
    old, new = tmp_path / "old.nc", tmp_path / "new.nc"
    old.write_text(WRITTEN[name] + "\n")
    new.write_text(expand(WRITTEN[name] + "\n", control=ISG, arcs=arcs).text)
    outcome = CliRunner().invoke(main, ["diff", str(old), str(new), "--control", ISG])
    assert outcome.exit_code == 0, outcome.output
    code = "\n".join(line for line in new.read_text().splitlines() if line[0] not in "(;")
    assert not re.search(r"#(?!FRC)|G30", code)
    place = list(re.finditer(r"[XYZ](-?[1-9]\d*\.?\d*)(?= |$)", code, re.MULTILINE))[-1]
    new.write_text(f"{code[: place.start(1)]}{float(place[1]) + 0.01}{code[place.end(1) :]}")
    assert CliRunner().invoke(main, ["diff", str(old), str(new), "--control", ISG]).exit_code == 1


@pytest.mark.parametrize(
    ("program", "codes"),
    [
        ("G1 X20 G310 #RND=5\nX40 Y60", ["word-beside-code"]),
        ("G1 X10 #ANG=30 G310\nX40 Y40", ["word-beside-code"]),
        ("G1 X10\nG310 X20 Y20\nG302 I5\nX40", ["isg-corner-alone"]),
        ("G310 X10\nG1 X40 #RND=5\nY40", ["position-unknown"]),
        ("G1 X30 #CHF=4 #CHR=2\nX40 Y40", ["isg-two-corners"]),
        ("G1 X30 #RND=4 #CHR=2\nX40 Y40", ["isg-two-corners"]),
    ],
)
def test_one_slip_beside_a_measuring_move_or_in_a_corner_is_one_finding(program, codes):
    found = check(MILL + program, control=ISG)
    assert [each.code for each in found if each.severity is not Severity.INFO] == codes


@pytest.mark.parametrize("code", ["G999", "G310"])
def test_a_code_that_a_lathe_has_not_is_named_in_the_block_of_a_contour(code):
    found = check(f"G00 X40. Z0.\n{code} G111 X100. A180. K-30. B120. C5.", control="yasnac-lx3")
    assert [(each.code, each.message.partition(" ")[0]) for each in found] == [("code-unknown", code)]
