"""NCT chapter 16, fact by fact of the control's sheet: what over-defines a block, what is missing, what is refused."""

import json
import re
from collections import Counter
from math import cos, isfinite, radians, sin
from random import Random

import pytest
from click.testing import CliRunner
from generate_nct import FORMS, Drawn, random_chain, random_cornered, random_pair
from oracle_corners import miss
from oracle_nct import Settings, runs

from contoursolve import Result, check, expand, solve
from contoursolve.cli import main
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.controls import DIALECTS
from contoursolve.diagnostics.finding import Diagnostic
from contoursolve.families import family
from contoursolve.output.document import to_json
from contoursolve.program.project_file import SettingError
from contoursolve.solving import StatusCode

FROM_CIRCLE = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\n"
TO_CIRCLE = "N10 G17 G42 G0 X100 Y20 D0 S200 M3\nN20 G1 X-30 Y-20\nN30 G3 X20 Y40 I20 J-10 R50"
LINES = "G17 G90 G41 G0 X90 Y10\nG1 ,A150\nG1 X10 Y20 ,A225"


def errors(result: Result) -> list[Diagnostic]:
    return [each for each in result.diagnostics if each.severity.value == "error"]


def codes(text: str, **options: str) -> set[str]:
    return {each.code for each in check(text, control="nct-99m", **options) if each.severity.value == "error"}


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
    assert codes("G17 G90 G0 X0 Y0 Z5\nG1 X5\n" + text) <= {"no-contour"}


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


@pytest.mark.parametrize("rules", ["enforce", "off"])
@pytest.mark.parametrize(
    "text",
    [
        TO_CIRCLE,
        FROM_CIRCLE + "G1 X-50 Y42.857 Q-1",
        FROM_CIRCLE + "G1 X-50 ,A171.87 Q-1",
        FROM_CIRCLE + "X-50 Y42.857 I0 J0 Q-1",
        LINES.replace(",A150", "X90 Y10"),
        LINES.replace(",A150", ",C5"),
        LINES.replace("G41 ", "").replace("G1 X10", "G41 G1 X10"),
        "G17 G90 G41 G0 X90 Y10\nG91 G3 X-50 Y0 I0 J0 R50",
    ],
)
def test_what_is_refused_here_is_verified(text, rules):
    result = solve(text, control="nct-99m", rules=rules)
    documents = Document("program", text.encode()), Document("result", to_json(result).encode())
    assert verify(*documents).verdict is not ReceiptVerdict.FAILED


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


@pytest.mark.parametrize(("seed", "count"), [(1501, 50), pytest.param(1502, 150, marks=pytest.mark.slow)])
def test_no_message_over_random_broken_programs_holds_what_is_no_number(seed, count):
    rng = Random(seed)
    draws = (random_pair, random_chain, random_cornered)
    for _ in range(count):
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
@pytest.mark.parametrize("count", [3, pytest.param(50, marks=pytest.mark.slow)])
def test_programs_are_read_as_the_settings_say_and_the_check_of_results_agrees(settings, count):
    rng = Random(f"{settings}{count}")
    statuses: Counter[str] = Counter()
    for _ in range(count):
        program = draw(rng).program
        (expected,) = runs(program, settings)
        if expected.is_near:
            continue
        text = "\n".join(program)
        result = solve(text, control="nct-99m", settings=named(settings), depth="verdict")
        (contour,) = json.loads(to_json(result))["contours"]
        if (contour["status"], expected.status) != ("conflicting", "no-solution"):
            assert contour["status"] == expected.status, text
        statuses[expected.status] += 1
        if expected.status == "solved":
            is_off = any(each.code == "nct-radius-differs" for each in result.diagnostics)
            assert miss(expected.elements, expected.points, contour) < (0.5 if is_off else 1e-8), text
            documents = Document("program", text.encode()), Document("result", to_json(result).encode())
            assert verify(*documents).verdict is not ReceiptVerdict.FAILED, text
    assert statuses["solved"] >= count / 5


def test_a_setting_is_not_that_of_the_same_blocks_before():
    """What is compiled for a form is kept; a difference of radii is not a part of the form's text."""
    text = FROM_CIRCLE.replace("R50", "I-50.005 J0") + "G1 X-50 Y42.857 ,A171.87 Q-1"
    allowed = ["0.02", "0.002", "0.02", "0.002"]
    statuses = [solve(text, settings=named(Settings(radius_difference=each))).answers[0].status for each in allowed]
    assert [status.value for status in statuses] == ["solved", "conflicting"] * 2


def test_the_point_met_first_is_counted_from_where_the_arc_starts_in_a_chain_too():
    """The sheet's third reading: from the start of the first circle's arc, which may be an intersection itself."""
    chain = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 I-50 J0\nX-40 Y60 I-40 J20 R40 Q-1\nG2 X20 Y60 I-10 J60 R30 Q-1"
    settings = Settings(circle_circle_q="first-met-clockwise")
    (expected,) = runs(chain.split("\n"), settings)
    (answer,) = solve(chain, settings=named(settings)).answers
    assert expected.status == answer.status.value == "solved"
    assert [side.value for side in answer.sides.values()] == ["first", "first"]
    for name, at in expected.points.items():
        assert answer.contour.points[name] == pytest.approx((at.real, at.imag), abs=1e-9)
    assert {each.setting.name: each.value for each in answer.claim.conventions} == {
        "circle-circle-q": "first-met-clockwise"
    }


def test_a_family_counts_with_the_settings_too():
    text = "G17 G90 G41 G0 X50 Y0\nG3 X-49.98 Y0 I-50 J0\nG3 X-40 Y60 I-40 J20 R40 Q-1"
    settings = named(Settings(circle_circle_q="first-met-clockwise", radius_difference="0.03"))
    turns = [radians(15 * step) for step in range(24)]
    centers = [(round(-40 + 40 * cos(turn), 3), round(60 + 40 * sin(turn), 3)) for turn in turns]
    rows = [(i, j, x) for i, j in centers for x in (-49.96, -49.98, -50.0)]
    names = ("3:I", "3:J", "2:X")
    table = family(text, vary=dict(zip(names, zip(*rows, strict=True), strict=True)), paired=True, settings=settings)
    solved = 0
    for index, (i, j, x) in enumerate(rows):
        lines = text.replace("I-40 J20", f"I{i} J{j}").replace("X-49.98", f"X{x}")
        (answer,) = solve(lines, settings=settings, depth="verdict").answers
        assert (answer.contour is not None) == (table["status"][index] == StatusCode.SOLVED), lines
        if answer.contour:
            solved += 1
            at = table["P1.X"][index], table["P1.Y"][index]
            assert answer.contour.points["P1"] == pytest.approx(at, abs=1e-9)
    assert solved > 10


@pytest.mark.parametrize(
    "value", ["0", "-1", "0.0009", "10.1", "1e-2", "nan", "inf", "", "x", "\u0660.\u0661", "1" * 400]
)
def test_a_difference_of_radii_that_is_no_sensible_number_is_refused(value):
    with pytest.raises(SettingError, match="it is a number from"):
        solve(LINES, settings={"nct-99m.radius-difference": value})


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
    documents = Document("program", BESIDE.encode()), Document("result", to_json(result).encode())
    assert verify(*documents).verdict is not ReceiptVerdict.FAILED


@pytest.mark.parametrize("axis", ["Z", "U", "V", "W"])
def test_an_expanded_program_with_an_axis_beside_the_plane_is_the_same_path(axis, tmp_path):
    old, new, moved = (tmp_path / name for name in ("old.nc", "new.nc", "moved.nc"))
    old.write_text(f"G17 G90 G0 X0 Y0 Z0 U0 V0 W0\nG1 X30 ,A45 {axis}-5 F100\nG1 X50 ,A0")
    new.write_text(expand(old.read_text(), decimals=6).text)
    moved.write_text(new.read_text().replace(f"{axis}-5", f"{axis}-6"))
    compared = [
        CliRunner().invoke(main, ["diff", str(old), str(each), "--control", "nct-99m"]) for each in (new, moved)
    ]
    assert [each.exit_code for each in compared] == [0, 1], [each.output for each in compared]


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
    assert second.start.values == (None, None)


# Grades, places, alarms, and what is assumed --------------------------------------------------------------------

ROWS = {
    # As the sheet has them: place, grade, alarm.
    "nct-circle-missed": ("16.3: on no page seen", "derived", None),
    "nct-circles-apart": ("16.3: on no page seen", "derived", None),
    "nct-parallel": ("16.3: on no page seen", "derived", None),
    "nct-point-is-start": ("16.3.1, p. 123", "printed", None),
    "nct-q-missing": ("16.3: not described", "assumed", None),
    "nct-q-zero": ("16.3: not described", "assumed", None),
    "nct-reversed": ("16.3.3, p. 129: movements contrary to programmer's needs", "printed", None),
    "nct-compensation-off": ("16.3: every format and example has it", "assumed", None),
    "nct-radius-too-small": ("p. 25: R; no alarm is printed for it", "derived", None),
    "nct-circle-undefined": ("p. 26 (4.3): alarm 3014", "printed", "3014"),
    "nct-center-outside-plane": ("p. 26 (4.3): alarm 3014", "printed", "3014"),
    "nct-radius-without-point": ("p. 26 (4.3): alarm 3012", "printed", "3012"),
    "nct-circle-degenerate": ("p. 26 (4.3): alarm 3012, end equals start", "printed", "3012"),
    "nct-two-corners": ("16.1; alarm 3017", "printed", "3017"),
    "nct-corner-without-next": ("16.1; alarm 3081", "printed", "3081"),
    "nct-corner-outside-plane": ("16.1; alarm 3081", "printed", "3081"),
    "nct-corner-too-large": ("16.1; alarm 3084", "printed", "3084"),
    "nct-coordinate-missing": ("16.2, p. 120", "printed", None),
    "nct-axis-outside-plane": ("16.3: not described", "assumed", None),
}


@pytest.mark.parametrize("code", ROWS)
def test_each_row_has_the_place_the_grade_and_the_alarm_of_the_sheet(code):
    (rule,) = (rule for rule in DIALECTS["nct-99m"].rules if rule.code == code)
    alarm = rule.alarm.number.split()[0] if rule.alarm else None
    assert (rule.source.place, rule.source.evidence.value, alarm) == ROWS[code]


def test_single_block_stops_are_named_where_corners_are_explained():
    """P. 120."""
    text = "in single-block mode the control stops after each inserted chamfer or rounding, too (16.1, p. 120)"
    for code in ("nct-corner-too-large", "nct-two-corners", "nct-corner-without-next"):
        assert text in CliRunner().invoke(main, ["explain", code]).output
    corner, plain = "G17 G90 G0 X0 Y0\nG1 X30 ,C10\nX40 Y40", LINES
    for program, is_told in ((corner, True), (plain, False)):
        assert (
            text in CliRunner().invoke(main, ["solve", "-", "--explain", "--control", "nct-99m"], input=program).output
        ) is is_told


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
def test_what_a_contour_rests_on_is_named_in_text_and_json(text, names):
    (contour,) = json.loads(to_json(solve(text)))["contours"]
    assert (contour["status"], [each["name"] for each in contour["assumptions"]]) == ("solved", names)
    assert all(each["source"]["evidence"] == "assumed" for each in contour["assumptions"])
    shown = CliRunner().invoke(main, ["solve", "-"], input=text).output
    assert ("depends on: " in shown) is bool(names)
    assert all(each["meaning"] in shown for each in contour["assumptions"])


def test_compensation_is_named_only_where_it_decides():
    free = {"nct-99m.compensation": "free"}
    for text, named_there in ((LINES, []), (LINES.replace("G41 ", ""), ["compensation"])):
        (contour,) = json.loads(to_json(solve(text, settings=free)))["contours"]
        assert contour["status"] == "solved"
        assert [each["setting"] for each in contour["conventions"]] == named_there


def test_a_parallel_axis_stands_for_that_of_the_plane_where_a_line_by_its_angle_has_no_other_coordinate(tmp_path):
    text = "G17 G90 G0 X1 Y2 U10 V20 W30\nG1 U30 ,A45 Z-5\nG1 X11 ,A0\nG19 G91 W10 ,A90\nG90 Z0 ,A90"
    result = solve(text)
    assert errors(result) == []
    assert [answer.plane.axes for answer in result.answers] == [("U", "Y"), ("X", "Y"), ("Y", "W"), ("Y", "Z")]
    assert [answer.contour.end for answer in result.answers] == [
        pytest.approx(at) for at in ((30, 22), (11, 22), (22, 40), (22, 0))
    ]
    contours = json.loads(to_json(result))["contours"]
    assert [each["name"] for each in contours[0]["assumptions"]] == ["parallel-axis"]
    expanded = expand(text).text
    assert "G01 U30 Y22 Z-5" in expanded
    documents = Document("program", text.encode()), Document("result", to_json(result).encode())
    assert verify(*documents).verdict is not ReceiptVerdict.FAILED
    old, new = tmp_path / "old.nc", tmp_path / "new.nc"
    old.write_text(text)
    new.write_text(expanded)
    outcome = CliRunner().invoke(main, ["diff", str(old), str(new), "--control", "nct-99m"])
    assert outcome.exit_code == 0, outcome.output
    assert codes("G17 G90 G0 X0 Y0\nG1 U30 ,A45") == {"position-unknown"}
    assert codes("G17 G90 G0 X0 Y0 U0\nG1 U30 ,A45 ,R5\nX50 Y0") == {"nct-plane-changes"}
