"""NCT chapter 16, fact by fact of the control's sheet: what over-defines a block, what is missing, what is refused."""

import json
import re
from random import Random

import pytest
from generate_nct import Drawn, random_chain, random_pair
from oracle_corners import miss
from oracle_nct import Settings, runs

from contoursolve import check, solve
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.controls import CONTROLS
from contoursolve.output import to_json

FROM_CIRCLE = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\n"


def errors(result):
    return [each for each in result.diagnostics if each.severity.value == "error"]


def codes(text: str) -> set[str]:
    return {each.code for each in check(text, control="nct-99m") if each.severity.value == "error"}


def is_verified(text, result) -> bool:
    documents = Document("program", text.encode()), Document("result", to_json(result).encode())
    return verify(*documents).verdict is not ReceiptVerdict.FAILED


# What over-defines a block (4, 8) ---------------------------------------------------------------------------


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
    rows = [rule for rule in CONTROLS["nct-99m"].rules if rule.source.place.startswith(("16", "p. 2"))]
    found = {rule.code: rule.alarm.number.split()[0] for rule in rows if rule.alarm}
    assert {code: found.get(code) for code in ALARMS} == ALARMS
    assert {rule.source.evidence.value for rule in rows if rule.code in ALARMS} == {"printed"}


def test_a_q_beside_p_belongs_to_its_code_and_makes_no_contour():
    program = "G17 G90 G0 X0 Y0\nG64 P0.1 Q0.1\nG1 X10 Y0 ,R1 F100\nX20 Y10\n"
    result = solve(program, control="nct-99m")
    assert ([answer.lines[0] for answer in result.answers], result.has_errors) == ([3], False)
