"""NCT chapter 16, fact by fact of the control's sheet: what over-defines a block, what is missing, what is refused."""

import json
import re
from math import isfinite
from random import Random

import pytest
from click.testing import CliRunner
from generate_nct import FORMS, Drawn, random_chain, random_cornered, random_pair
from oracle_corners import miss
from oracle_nct import Settings, runs

from contoursolve import SettingError, check, expand, solve
from contoursolve.cli import main
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.controls import DIALECTS
from contoursolve.output import to_json

FROM_CIRCLE = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\n"
TO_CIRCLE = "N10 G17 G42 G0 X100 Y20 D0 S200 M3\nN20 G1 X-30 Y-20\nN30 G3 X20 Y40 I20 J-10 R50"
LINES = "G17 G90 G41 G0 X90 Y10\nG1 ,A150\nG1 X10 Y20 ,A225"


def errors(result):
    return [each for each in result.diagnostics if each.severity.value == "error"]


def codes(text: str) -> set[str]:
    return {each.code for each in check(text, control="nct-99m") if each.severity.value == "error"}


def is_verified(text, result) -> bool:
    documents = Document("program", text.encode()), Document("result", to_json(result).encode())
    return verify(*documents).verdict is not ReceiptVerdict.FAILED


def is_same_path(tmp_path, one: str, other: str) -> bool:
    old, new = tmp_path / "old.nc", tmp_path / "new.nc"
    old.write_text(one)
    new.write_text(other)
    done = CliRunner().invoke(main, ["diff", str(old), str(new), "--control", "nct-99m"])
    assert done.exit_code in (0, 1), done.output
    return done.exit_code == 0


# What over-defines a block (4, 8) ---------------------------------------------------------------------------


@pytest.mark.parametrize("control", [None, "nct-99m"])
def test_an_over_defined_circle_without_its_q_gets_both_with_their_contours(control):
    """P. 128: Q is not part of what triggers it."""
    result = solve(TO_CIRCLE + "\nN40 G40 G0 Y60", control=control)
    (finding,) = errors(result)
    assert (result.control, finding.code, finding.alarm) == ("nct-99m", "nct-q-missing", None)
    for fix, q, at in zip(finding.fixes, ("Q-1", "Q1"), ((66.0216, 9.5451), (-29.0486, -19.7073)), strict=True):
        assert fix.description.startswith(f"add {q} to program line 3 -> P1 is at")
        (answer,) = solve(f"N10 G17 G42 G0 X100 Y20 D0\n{fix.replacement}").answers
        assert answer.contour.points["P1"] == pytest.approx(at, abs=5e-5)


@pytest.mark.parametrize(
    ("text", "code", "missing"),
    [
        (FROM_CIRCLE + "G1 X-50 Y42.857 Q-1", "nct-line-incomplete", ",A is missing"),
        (FROM_CIRCLE + "G1 X-50 ,A171.87 Q-1", "nct-line-incomplete", "Y is missing"),
        (FROM_CIRCLE + "X-50 Y42.857 I0 J0 Q-1", "nct-circle-incomplete", "R is missing"),
        (TO_CIRCLE.replace(" J-10", " Q1"), "nct-circle-incomplete", "J is missing"),
        (TO_CIRCLE.replace(" X20", " Q1"), "nct-circle-incomplete", "X is missing"),
        (FROM_CIRCLE + "G1 X-50 Q-1", "nct-q-without-intersection", "chooses nothing"),
        (FROM_CIRCLE + "M8\nG1 X-50 Y42.857 Q-1", "nct-q-without-intersection", "chooses nothing"),
        ("G17 G90 G0 X50 Y0\nG1 X40 Y0 Q1", "nct-q-without-intersection", "chooses nothing"),
        ("G17 G90 G41 G1 X50 Y0\nQ1", "nct-q-without-intersection", "chooses nothing"),
    ],
)
def test_a_q_that_belongs_to_nothing_is_told_with_the_word_that_is_missing(text, code, missing):
    found = [each for each in check(text, control="nct-99m") if each.code == code]
    assert missing in found[0].message
    assert found[0].message.startswith("Q")


@pytest.mark.parametrize("text", ["G81 X10 Y10 R2 Q5\nX20", "G83 X10 Y10 Z-5 R2 Q5", "G65 P1 Q5", "M98 P1 Q5"])
def test_a_q_with_another_meaning_is_left_alone(text):
    assert codes("G17 G90 G0 X0 Y0 Z5\nG1 X5\n" + text) == set()


CHAIN = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\n{}X-40 Y60 I-40 J20 R40 Q-1"


def test_a_circle_whose_g3_is_not_repeated_shows_the_control_and_is_solved():
    """P. 134: modal inside a chain."""
    modal, told = solve(CHAIN.format("")), solve(CHAIN.format("G3 "))
    assert modal.control == told.control == "nct-99m"
    assert modal.answers[0].contour == told.answers[0].contour is not None
    assert solve(CHAIN.format("").replace(" Q-1", "")).control == "nct-99m"
    assert errors(solve(CHAIN.format("").replace(" Q-1", "")))[0].code == "nct-q-missing"


@pytest.mark.parametrize("arc", ["G3 X60. Z-10. I10. K0. R10.", "X60. Z-10. I10. K0. R10. Q5."])
def test_an_arc_of_a_lathe_with_centre_and_radius_does_not_show_a_mill(arc):
    assert solve(f"G00 X40. Z0.\nG111 A180. K-30. B120. X100.\nG1 X30. Z0.\n{arc}").control == "yasnac-lx3"


# Where compensation is on (3) -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "is_refused"),
    [
        (LINES, False),
        (LINES.replace("G41 ", ""), True),
        (LINES.replace("G41 ", "").replace("G1 X10", "G41 G1 X10"), True),
        (LINES.replace("G41 ", "").replace("G1 ,A150", "G41 G1 ,A150"), True),
        (LINES.replace("G1 X10", "G40 G1 X10"), True),
        (LINES + "\nG40 G1 X0", False),
    ],
)
def test_compensation_is_on_before_the_first_of_two_blocks(text, is_refused):
    assert ("nct-compensation-off" in codes(text)) is is_refused


# N1's point (5, 5a) -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("point", ["X90 Y10", "X90", "Y10", "G91 X0 Y0", "X90.0 Y10.000"])
@pytest.mark.parametrize("after", ["G1 X10 Y20 ,A225", "G3 X20 Y40 I20 J-10 R50 Q-1", "G1 X10 Y20 ,A190"])
def test_a_point_of_the_line_that_is_its_start_point_is_told_as_that(point, after):
    """P. 123: never parallel, and never a circle that is missed."""
    (finding,) = errors(solve(f"G17 G90 G41 G0 X90 Y10\nG1 {point}\n{after}"))
    assert finding.code == "nct-point-is-start"
    assert (finding.source.place, finding.source.evidence.value, finding.alarm) == ("16.3.1, p. 123", "printed", None)
    assert finding.span.line == 2


@pytest.mark.parametrize("seed", range(20))
def test_no_message_over_random_broken_programs_holds_what_is_no_number(seed):
    rng = Random(seed)
    draws = (random_pair, random_chain, random_cornered)
    for _ in range(10):
        draw = rng.choice(draws)
        arguments = {random_pair: (rng.choice(FORMS),), random_chain: (rng.randint(1, 3),), random_cornered: ()}[draw]
        drawn = draw(rng, *arguments, rng.choice((17, 18, 19)))
        lines = [line.split() for line in drawn.program]
        for _ in range(rng.randint(1, 3)):
            line = rng.choice(lines)
            index = rng.randrange(len(line))
            address = line[index].rstrip("-.0123456789")
            others = [word for each in lines for word in each if word.startswith(address)]
            changes = ("", address + "0", address + "90", rng.choice(others), line[index].replace("-", ""))
            line[index] = rng.choice(changes)
        text = "\n".join(" ".join(line) for line in lines)
        for rules in ("enforce", "off"):
            for finding in solve(text, control="nct-99m", rules=rules, depth="verdict").diagnostics:
                said = f"{finding.message} {finding.help}".lower().replace("=", " ").split()
                assert not {"nan", "inf", "-inf"} & {word.strip(",;:()") for word in said}, (text, finding.message)
                assert all(isfinite(value) for value in finding.values.values()), (text, finding)


# Settings: what no page says (3, and Q of two circles) --------------------------------------------------------

SETTINGS = [
    Settings(circle_circle_q="right-is-negative"),
    Settings(circle_circle_q="first-met-clockwise"),
    Settings(radius_difference="0.5", compensation="free"),
    Settings(circle_circle_q="first-met-clockwise", radius_difference="0.002"),
]


def named(settings: Settings) -> dict[str, str]:
    """The settings as the command line takes them."""
    return {f"nct-99m.{name.replace('_', '-')}": value for name, value in settings._asdict().items()}


def draw(rng: Random) -> Drawn:
    """A pair or a chain, most of them of circles, some of them without compensation or with a point off its circle."""
    plane = rng.choice((17, 18, 19))
    drawn = random_pair(rng, "circle-circle", plane, rng.choice(("", "C", "R")))
    if rng.random() < 0.5:
        drawn = random_chain(rng, rng.randint(1, 4), plane, corners=0.2)
    lines = list(drawn.program)
    if rng.random() < 0.3:
        lines[0] = lines[0].replace("G41 ", "").replace("G42 ", "")
    if rng.random() < 0.5:
        first = {17: "X", 18: "Z", 19: "Y"}[plane]
        line = rng.randrange(1, len(lines))
        off = rng.choice((0.0015, -0.0015, 0.008, -0.1, 0.3))
        lines[line] = re.sub(rf"(?<!\S){first}(\S+)", lambda word: f"{first}{float(word[1]) + off:.12f}", lines[line])
    return drawn._replace(program=tuple(lines))


@pytest.mark.parametrize("settings", SETTINGS)
@pytest.mark.parametrize("seed", range(15))
def test_programs_are_read_as_the_settings_say_and_the_check_of_results_agrees(settings, seed):
    rng = Random(f"{settings}{seed}")
    for _ in range(4):
        program = draw(rng).program
        (expected,) = runs(program, settings)
        if expected.is_near:
            continue
        text = "\n".join(program)
        result = solve(text, control="nct-99m", settings=named(settings), depth="verdict")
        (contour,) = json.loads(to_json(result))["contours"]
        if (contour["status"], expected.status) != ("conflicting", "no-solution"):
            assert contour["status"] == expected.status, text
        if expected.status == "solved":
            is_off = any(each.code == "nct-radius-differs" for each in result.diagnostics)
            assert miss(expected.elements, expected.points, contour) < (0.5 if is_off else 1e-8), text
            assert is_verified(text, result), text


def test_a_setting_is_not_that_of_the_same_blocks_before():
    """What is compiled for a form is kept; a difference of radii is not a part of the form's text."""
    text = FROM_CIRCLE.replace("R50", "I-50.005 J0") + "G1 X-50 Y42.857 ,A171.87 Q-1"
    allowed = ["0.02", "0.002", "0.02", "0.002"]
    statuses = [solve(text, settings=named(Settings(radius_difference=each))).answers[0].status for each in allowed]
    assert [status.value for status in statuses] == ["solved", "conflicting"] * 2


@pytest.mark.parametrize(
    "value",
    [
        *("0", "-1", "1e-2", "nan", "inf", "", "x", "\u0660.\u0661", "1" * 400),
        pytest.param("0.0009", marks=pytest.mark.boundary),
        pytest.param("10.1", marks=pytest.mark.boundary),
    ],
)
def test_a_difference_of_radii_that_is_no_sensible_number_is_refused(value):
    with pytest.raises(SettingError, match="it is a number from"):
        solve(LINES, settings={"nct-99m.radius-difference": value})


@pytest.mark.boundary
@pytest.mark.parametrize(
    ("off", "is_solved"), [("0.0099", True), ("0.0101", False), ("-0.0099", True), ("-0.0101", False)]
)
def test_radii_may_differ_by_a_hundredth(off, is_solved):
    text = f"G17 G90 G41 G0 X50 Y0\nG3 X{-50 - float(off):.4f} Y0 I-50 J0\nG1 X-50 Y42.857 ,A171.87 Q-1"
    assert (solve(text).answers[0].contour is not None) is is_solved


# A word outside the plane, and parallel axes (p. 120) ----------------------------------------------------------

BESIDE = (
    "G17 G90 G0 X0 Y0 Z0 W1\nG1 X30 ,A45 Z-5 F100\nG1 ,A10 X90 W-3\nG1 X90 ,A45 Z-10\nG91 ,A0 X1 Z-1\nG90 G18 X100 ,A90"
)


def test_a_line_by_one_coordinate_and_its_angle_takes_one_word_of_another_axis():
    result = solve(BESIDE)
    assert errors(result) == []
    assert {each.code for each in result.diagnostics} == {"line-vanishes"}
    assert [answer.contour.end for answer in result.answers[:2]] == [
        (30.0, 30.0),
        (90.0, pytest.approx(40.5796, abs=1e-4)),
    ]
    last = result.answers[-1]
    assert last.start.values == (-11, 91), "Z and X go on from there"
    expanded = expand(BESIDE).text
    assert [line for line in expanded.splitlines() if "(" not in line][1:5] == [
        "G01 X30 Y30 Z-5 F100",
        "G01 X90 Y40.58 W-3",
        "G01 Z-10",
        "G91 G01 X1 Y0 Z-1",
    ]
    assert is_verified(BESIDE, result)


@pytest.mark.parametrize("axis", ["Z", "W"])
def test_an_expanded_program_with_an_axis_beside_the_plane_is_the_same_path(axis, tmp_path):
    text = f"G17 G90 G0 X0 Y0 Z0 U0 V0 W0\nG1 X30 ,A45 {axis}-5 F100\nG1 X50 ,A0"
    expanded = expand(text, decimals=6).text
    moved = expanded.replace(f"{axis}-5", f"{axis}-6")
    assert [is_same_path(tmp_path, text, each) for each in (expanded, moved)] == [True, False]


@pytest.mark.parametrize(
    "text",
    [
        "G17 G90 G0 X0 Y0\nG1 X30 ,A45 Z-5 W-3",
        "G17 G90 G0 X0 Y0\nG1 X30 Z-5 ,C10\nX40 Y40",
        "G17 G90 G0 X0 Y0\nG1 X30 ,A45 Z-5 ,R2\nX40 Y-40",
        LINES + " Z-5",
        LINES.replace("G1 ,A150", "G1 ,A150 W5"),
    ],
)
def test_more_of_it_or_elsewhere_is_refused(text):
    assert codes(text) == {"nct-corner-outside-plane" if ",C" in text or ",R" in text else "nct-axis-outside-plane"}


def test_increments_of_a_contour_without_a_path_are_no_coordinates():
    first, second = solve("G17 G90 G0 X10 Y10 Z3\nG91 G1 X15 ,A90 Z2\nG90 G18 X50 ,A30").answers
    assert first.contour is None
    assert second.start.values == (5, 25)
    first, second = solve("G17 G90 G0 X10 Y10 Z3\nG91 G1 X15 ,C50\nX10\nG90 Y50 ,A30").answers
    assert first.contour is None
    assert second.start.values == (35, 10)


# Grades, places, alarms, and what is assumed --------------------------------------------------------------------

ALARMS = {
    "nct-circle-undefined": "3014",
    "nct-center-outside-plane": "3014",
    "nct-radius-without-point": "3012",
    "nct-circle-degenerate": "3012",
    "nct-two-corners": "3017",
    "nct-corner-without-next": "3081",
    "nct-corner-outside-plane": "3081",
    "nct-corner-too-large": "3084",
}
"""What the sheet prints of chapters 4 and 16; all else of chapter 16 has no alarm."""


def test_alarms_are_those_that_the_sheet_prints():
    rows = [rule for rule in DIALECTS["nct-99m"].rules if rule.source.place.startswith(("16", "p. 2"))]
    found = {rule.code: rule.alarm.number.split()[0] for rule in rows if rule.alarm}
    assert {code: found.get(code) for code in ALARMS} == ALARMS
    assert {rule.source.evidence.value for rule in rows if rule.code in ALARMS} == {"printed"}


@pytest.mark.parametrize(
    ("text", "names"),
    [
        (LINES, []),
        (TO_CIRCLE + " Q-1", []),
        (TO_CIRCLE.replace("R50", "R-50 Q1"), ["sign-of-radius"]),
        (FROM_CIRCLE.replace("X-50 Y0 R50", "I-50 J0") + "G1 X-50 Y42.857 ,A171.87 Q-1", ["circle-without-point"]),
        (FROM_CIRCLE.replace("R50", "I-50") + "G1 X-50 Y42.857 ,A171.87 Q-1", ["one-of-center"]),
        (LINES.replace(",A150", ",A150 ,R0"), ["corner-of-zero"]),
        (LINES + " F100", ["feed-in-block"]),
        ("G17 G90 G0 X0 Y0\nG91 G1 X10 ,A45", ["increment-beside-angle"]),
        ("G17 G90 G0 X0 Y0\nG1 X10 ,A45 Z-5", []),
    ],
)
def test_what_a_contour_rests_on_is_named(text, names):
    (contour,) = json.loads(to_json(solve(text)))["contours"]
    assert (contour["status"], [each["name"] for each in contour["assumptions"]]) == ("solved", names)
    assert all(each["source"]["evidence"] == "assumed" for each in contour["assumptions"])


def test_compensation_is_named_only_where_it_decides():
    for text, named_there in ((LINES, []), (LINES.replace("G41 ", ""), ["compensation"])):
        (answer,) = solve(text, settings={"nct-99m.compensation": "free"}).answers
        assert answer.status.value == "solved"
        assert [each.setting.name for each in answer.claim.conventions] == named_there


def test_a_parallel_axis_stands_for_that_of_the_plane_where_a_line_by_its_angle_has_no_other_coordinate(tmp_path):
    text = "G17 G90 G0 X1 Y2 U10 V20 W30\nG1 U30 ,A45 Z-5\nG1 X11 ,A0\nG19 G91 W10 ,A90\nG90 Z0 ,A90"
    result = solve(text)
    assert errors(result) == []
    assert [answer.plane.axes for answer in result.answers] == [("U", "Y"), ("X", "Y"), ("Y", "W"), ("Y", "Z")]
    assert [answer.contour.end for answer in result.answers] == [
        pytest.approx(at) for at in ((30, 22), (11, 22), (22, 40), (22, 0))
    ]
    assert [each.name for each in result.answers[0].claim.rests_on()] == ["parallel-axis"]
    assert "G01 U30 Y22 Z-5" in expand(text).text
    assert is_verified(text, result)
    assert is_same_path(tmp_path, text, expand(text).text)
    assert codes("G17 G90 G0 X0 Y0\nG1 U30 ,A45") == {"position-unknown"}
    assert codes("G17 G90 G0 X0 Y0 U0\nG1 U30 ,A45 ,R5\nX50 Y0") == {"nct-plane-changes"}
