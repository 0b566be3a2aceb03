"""Fanuc and Haas, fact by fact of the controls' sheets: lines and arcs with ,A ,C ,R, and what is refused."""

import re
from collections import Counter
from collections.abc import Sequence
from itertools import product
from math import inf
from random import Random

import pytest
from click.testing import CliRunner
from examples_fanuc import (
    EXAMPLES,
    FL_G1,
    FL_G4,
    FL_G5,
    FM_G1,
    FM_G3,
    HAAS_LATHE,
    HAAS_MILL,
    LATHE,
    MILL,
    drawn,
)
from generate_fanuc import disturbed, random_lathe, random_mill
from oracle import Element
from oracle_corners import gap
from oracle_fanuc import Machine, run

from contoursolve import Diagnostic, Result, UnknownControlError, check, expand, family, solve
from contoursolve.cli import main
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.output import to_json
from contoursolve.solving import StatusCode


def errors(result: Result) -> list[Diagnostic]:
    return [each for each in result.diagnostics if each.severity.value == "error"]


def path(result: Result) -> list[Element]:
    """All contours of a program, one behind the other."""
    return [element for answer in result.answers for element in elements(answer)]


def elements(answer) -> list[Element]:
    found = []
    for each in answer.contour.elements if answer.contour else ():
        start, end = complex(*each.start), complex(*each.end)
        if hasattr(each, "center"):
            found.append(Element("arc", start, end, complex(*each.center), each.radius, each.turn.value))
        else:
            found.append(Element("line", start, end))
    return found


def test_the_program_of_the_lathe_tells_its_control_and_that_of_the_mill_asks():
    assert solve(FL_G5).control == LATHE
    with pytest.raises(UnknownControlError) as caught:
        solve(FM_G3)
    assert set(caught.value.choices) >= {MILL, HAAS_MILL, "nct-99m"}
    assert not {"yasnac-lx3", LATHE, HAAS_LATHE} & {*caught.value.choices}


@pytest.mark.parametrize("control", [LATHE, MILL, HAAS_LATHE, HAAS_MILL])
@pytest.mark.parametrize(
    ("size", "names"),
    [
        pytest.param("20.", ["corner 1", "line 2"], marks=pytest.mark.boundary),
        pytest.param("20.001", None, marks=pytest.mark.boundary),
        ("0", ["line 1", "line 2"]),
    ],
)
def test_a_corner_as_long_as_the_move_is_accepted_and_a_zero_one_is_none(control, size, names):
    start, second = ("G00 X40. Z0", "X120.") if control.endswith("lathe") else ("G17 G90 G00 Z0 X0 Y0", "Y40.")
    first = "Z-20." if control.endswith("lathe") else "X20."
    for word in ("R", "C"):
        (answer,) = solve(f"{start}\nG01 {first} ,{word}{size}\n{second}", control=control).answers
        assert (answer.contour and [each.name for each in answer.contour.elements if each.length > 1e-9]) == names


# Seen in real text ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "G1X50.,R5.F100\nY40.",
        "G1 X50. F100 ,R5.\nY40.",
        "G1 X50. ,R5. F100\nY40.",
        "g1 x50. ,r5. f100\ny40.",
        "G1(edge)X50.(c),R5.(r)\nY40.",
        "G1 X 50. , R 5.\nY 40.",
        "G1 ,R5. X50.\nY40.",
        "N10G1X+50.,R+5.\nN20Y40.",
        "G1 X50. ,R5.\nG04 P500\nY40.",
        "G1 X50. ,R5.\nG4 X1.5\nY40.",
        "G1 X50. ,R5.\n(corner)\n\nY40.",
        "G1 X50. ,R5.\nN30 G04 P500 (wait)\nN31 G04 P500\nY40.",
        "/G1 X50. ,R5.\nY40.",
        "G1 X50000 ,R5000\nY40000",
    ],
)
@pytest.mark.parametrize("control", [MILL, HAAS_MILL])
def test_the_same_corner_is_read_however_it_is_written(control, text):
    result = solve("G17 G90 G00 X0 Y0\n" + text, control=control)
    assert errors(result) == []
    assert gap(drawn("0 0; 45 0 > ccw 50 5 45 5; 50 40", 1), path(result)) < 1e-9


@pytest.mark.parametrize(
    ("control", "text", "found", "fix"),
    [
        (MILL, "G1 Y100 R10\nX50.", "R10", "G1 Y100 ,R10"),
        (MILL, "g1x.375c.063\ny1.", "c.063", "g1x.375,c.063"),
        (MILL, "G1 X50. R10.\nY60.", "R10.", "G1 X50. ,R10."),
        (HAAS_MILL, "G1 X50. R2.\nY60.", "R2.", "G1 X50. ,R2."),
        (HAAS_LATHE, "G1 Z-50. C2.\nX60.", "C2.", "G1 Z-50. ,C2."),
        (LATHE, "G1 X50. A150.\nZ-60.", "A150.", "G1 X50. ,A150."),
        (LATHE, "G1 Z-50. C10.\nX60.", "C10.", "G1 Z-50. ,C10."),
    ],
)
def test_a_lost_comma_is_told_with_what_the_letter_means_without_it(control, text, found, fix):
    start = "G00 X40. Z0\n" if control.endswith("lathe") else "G17 G90 G00 X0 Y0\n"
    (finding,) = [each for each in check(start + text, control=control) if each.code.endswith("comma-missing")]
    assert finding.message == f"{found} has no comma, so the control does not read it as ,{found}"
    assert "C is an axis" in finding.help or "A and C are axes" in finding.help
    assert [each.replacement for each in finding.fixes] == [fix]
    assert len(finding.message.split()) <= 20


@pytest.mark.parametrize(
    ("text", "code", "fix"),
    [
        ("G01 Z-20. ,R25.\nX60.", "fanuc-corner-too-large", "G01 Z-20. ,R20.\nX60."),
        ("G01 Z-20. ,C-5.\nX60.", "fanuc-corner-negative", "G01 Z-20. ,C5.\nX60."),
        ("G01 Z-20. ,C5. ,R5.\nX60.", "fanuc-two-corners", "G01 Z-20. ,C5.\nX60."),
        ("G01 Z-20. ,C5.\nZ-40.", "fanuc-corner-dropped", "G01 Z-20.\nZ-40."),
        ("G01 ,A180.\nX60. Z-47. A120.", "fanuc-closing-incomplete", "G01 ,A180.\nX60. Z-47. ,A120."),
        ("G01 ,A180.\nX60. Z-47. ,A-120.", "fanuc-angle-opposite", "G01 ,A180.\nX60. Z-47. ,A120."),
        ("G01 X40. Z-17.3205 ,A150.", "words-redundant", "G01 X40. Z-17.3205"),
        ("G01 X40. Z-17. ,A150.", "words-conflict", "G01 X40. Z-17."),
        ("G01 X40. Z-17. ,A150. ,R2.\nZ-40.", "words-conflict", "G01 X40. Z-17. ,R2.\nZ-40."),
    ],
)
def test_the_first_fix_is_what_a_colleague_would_name(text, code, fix):
    found = [each for each in check("G00 X20. Z0.\n" + text, control=LATHE) if each.fixes]
    assert found[0].code == code
    assert found[0].fixes[0].replacement == fix


@pytest.mark.parametrize(
    ("control", "text"),
    [
        (MILL, "G01 X30. ,R5.\nG03 X40. Y10. R10."),
        (MILL, "G03 X20. Y20. I0 J20. ,R2.\nG01 Y60."),
        (MILL, "G01 X30. ,R5.\nG03 X40. Y10. R10. ,C2.\nG01 X0"),
        ("nct-99m", "G1 X30 ,R5\nG3 X40 Y10 I0 J10"),
        ("nct-99m", "G1 X30 ,C5\nG3 X40 Y10 R10"),
        ("mitsubishi", "G01 X30. ,R5.\nG03 X40. Y10. R10."),
        ("mitsubishi", "G01 X30. ,R5.\nX60."),
    ],
)
def test_a_corner_on_a_tangent_joint_may_be_deleted(control, text):
    (finding,) = check("G17 G90 G00 X0 Y0\n" + text, control=control)
    corner = text.split("\n")[0].split()[-1]
    assert finding.message.startswith(f"{corner}: ")
    assert text.replace(" " + corner, "", 1) in [each.replacement for each in finding.fixes]


def test_an_angle_that_is_missing_behind_an_open_line_is_asked_for_with_a_value_that_fits():
    (finding,) = [each for each in check("G00 X20. Z0.\nG01 ,A180.\nX60. Z-47.", control=LATHE) if each.fixes]
    assert finding.message.endswith("it lacks ,A")
    assert finding.fixes[0].replacement == "G01 ,A180.\nX60. Z-47. ,A?"
    told = [each.message for each in check("G00 X20. Z0.\nG01 ,A180.\nX60. ,A120.", control=LATHE)]
    assert not any("W in line 3" in each or "U in line 3" in each for each in told)


# Random contours --------------------------------------------------------------------------------------------

MACHINES = {
    LATHE: Machine(is_lathe=True, signed="IKR"),
    MILL: Machine(is_lathe=False, signed="IJK"),
    HAAS_LATHE: Machine(is_lathe=True, angle="A", meets=False, signed="IKR"),
    HAAS_MILL: Machine(is_lathe=False, arcs=False, beside="AB"),
}
TYPED = {
    LATHE: (",A", ",C", ",R", "X", "Z", "U", "W", "R", "I", "K", "A"),
    MILL: (",C", ",R", "X", "Y", "Z", "R", "I", "J", "K", ",A", "C"),
    HAAS_LATHE: ("A", ",C", ",R", "X", "Z", "U", "W", "R", "I", "K", ",A"),
    HAAS_MILL: (",C", ",R", "X", "Y", "Z", "R", "I", "J", "K", ",A", "A"),
}
PAIRS = [("line", "line"), ("line", "arc"), ("arc", "line"), ("arc", "arc")]


def draw(rng: Random, control: str, kinds: Sequence[str] | None = None, *, reverses: bool = True) -> list[str]:
    count = rng.randint(2, 6)
    if control.endswith("lathe"):
        machine = MACHINES[control]
        return random_lathe(rng, len(kinds or range(count)), machine.angle, meets=machine.meets, reverses=reverses)
    straight = ["line"] if control == HAAS_MILL else ["line", "line", "arc"]
    return random_mill(rng, kinds or [rng.choice(straight) for _ in range(count)], rng.choice((17, 18, 19)))


def judge(program: Sequence[str], control: str, machine: Machine, settings: dict[str, str] | None = None) -> str:
    """`right` or `refused`; fails where a contour is wrong, or is solved and the oracle refuses it."""
    expected = run(program, machine)
    if expected.is_near:
        return "near"
    text = "\n".join(program)
    result = solve(text, control=control, settings=settings, depth="verdict")
    found = {answer.claim.blocks[0].line: elements(answer) for answer in result.answers if answer.contour}
    for each in expected.runs:
        size = max(abs(element.end) for element in each.elements)
        assert gap(each.elements, found.pop(each.line, [])) < 1e-8 * max(1, size / 1000), (
            text,
            each.line,
            errors(result),
        )
    last = expected.refused or inf
    assert not any(rest for line, rest in found.items() if line <= last), (text, found)
    return "refused" if expected.refused else "right"


DRAWN = [
    *((control, {}, {}, None) for control in MACHINES),
    *((MILL, {}, {}, kinds) for kinds in PAIRS),
    (LATHE, {"angle-sense": "ray"}, {"sense": "ray"}, None),
    (LATHE, {"guard-deg": "0"}, {"guard": 0.0}, None),
    (LATHE, {"redundant-angle": "error"}, {"strict": True}, None),
    (HAAS_LATHE, {"angle-sense": "ray"}, {"sense": "ray"}, None),
    (MILL, {"guard-deg": "0"}, {"guard": 0.0}, None),
    *((HAAS_MILL, {"arcs": "on"}, {"arcs": True}, kinds) for kinds in PAIRS),
]
"""Controls, settings, what they change of the oracle's machine, and the kinds of two moves."""


@pytest.mark.parametrize(("control", "settings", "changes", "kinds"), DRAWN)
@pytest.mark.parametrize("part", range(10))
def test_drawn_programs_come_out_as_the_oracle_says_and_no_wrong_one_is_solved(control, settings, changes, kinds, part):
    """Sound ones, and each once more with a word lost, too many or wrong."""
    rng, machine = Random(f"{control}{settings}{kinds}{part}"), MACHINES[control]._replace(**changes)
    named = {f"{control}.{name}": value for name, value in settings.items()}
    verdicts: Counter[str] = Counter()
    for _ in range(10):
        program = draw(rng, control, kinds)
        sound = judge(program, control, machine, named)
        assert settings or sound != "refused"
        verdicts.update((sound, judge(disturbed(rng, program, TYPED[control]), control, machine, named)))
    assert verdicts["right"] > 3
    assert verdicts["near"] < 10


START = "G00 X20. Z0.\n"


@pytest.mark.parametrize("text", ["G01 X40. ,A-30.", "G01 ,A0\nX60. Z-47. ,A120.", "G01 ,A180.\nX60. Z-47. ,A-60."])
@pytest.mark.parametrize("is_haas", [False, True])
def test_a_line_against_its_angle_is_told_and_a_ray_is_refused(text, is_haas):
    if is_haas and "\n" in text:
        return
    control, text = (HAAS_LATHE, text.replace(",A", "A")) if is_haas else (LATHE, text)
    result = solve(START + text, control=control)
    assert [each.code for each in result.diagnostics] == [f"{control.split('-')[0]}-angle-opposite"]
    assert result.diagnostics[0].severity.value == "warning"
    assert result.answers[0].status.value == "solved"
    refused = solve(START + text, control=control, settings={f"{control}.angle-sense": "ray"})
    assert refused.answers[0].contour is None
    assert [each.code for each in errors(refused)] == ["line-reversed"]
    conventions = [each for answer in refused.answers for each in answer.claim.conventions]
    assert ("angle-sense", "ray") in [(each.setting.name, each.value) for each in conventions]


def test_an_angle_beside_both_coordinates_is_checked_or_refused():
    strict = {"fanuc-lathe.redundant-angle": "error"}
    agrees, misses = START + "G01 X40. Z-17.3205 ,A150.", START + "G01 X40. Z-17. ,A150."
    assert solve(agrees, control=LATHE).answers[0].status.value == "overdetermined"
    assert solve(misses, control=LATHE).answers[0].status.value == "conflicting"
    for text in (agrees, misses):
        result = solve(text, control=LATHE, settings=strict)
        assert errors(result)[0].code == "fanuc-angle-redundant"
        assert errors(result)[0].help == "delete the angle"
        assert result.answers[0].contour is None
    closing = START + "G01 ,A180.\nX60. Z-47. ,A120."
    assert errors(solve(closing, control=LATHE, settings=strict)) == []


@pytest.mark.parametrize(
    ("control", "text", "angle", "expected"),
    [
        (LATHE, "G00 X50. Z0\nG01 Z-20. ,R5.\nZ-40.", "0.000", "0 50; -20 50; -40 50"),
        (LATHE, "G00 X50. Z0\nG01 Z-20. ,R5.\nX50.2 Z-40.", "0.286", "0 50; -20 50; -40 50.2"),
        (HAAS_LATHE, "G00 X50. Z0\nG01 Z-20. ,C5.\nX50.2 Z-40.", "0.286", "0 50; -20 50; -40 50.2"),
        (MILL, "G17 G90 G00 X0 Y0\nG01 X20. ,R2.\nX50. Y.5", "0.955", "0 0; 20 0; 50 .5"),
        (HAAS_MILL, "G17 G90 G00 X0 Y0\nG01 X20. ,C2.\nX50. Y.5", "0.955", "0 0; 20 0; 50 .5"),
    ],
)
def test_a_corner_within_the_guard_is_left_out_with_a_warning_that_tells_the_angle(control, text, angle, expected):
    result = solve(text, control=control)
    (answer,), (finding,) = result.answers, result.diagnostics
    assert answer.status.value == "solved"
    assert finding.severity.value == "warning"
    assert finding.code == f"{control.split('-')[0]}-corner-dropped"
    assert f"turns by {angle} deg" in finding.message
    assert finding.fixes[0].applicability.value == "safe"
    corner = text.split("\n")[-2].split()[-1]
    assert finding.fixes[0].replacement == "\n".join(text.replace(" " + corner, "").split("\n")[-2:])
    share = 0.5 if control.endswith("lathe") else 1
    places = [tuple(map(float, each.split())) for each in expected.split(";")]
    found = [answer.contour.start, *(each.end for each in answer.contour.elements)]
    assert found == [pytest.approx((first, second * share)) for first, second in places]


def test_a_corner_on_a_tangent_arc_is_left_out_and_the_others_are_cut():
    text = "G17 G90 G00 X0 Y0\nG01 X30. ,R5.\nG03 X40. Y10. R10. ,C2.\nG01 X60. Y20. ,C3.\nX80. Y30.2"
    result = solve(text, control=MILL)
    assert [each.span.line for each in result.diagnostics] == [2, 4]
    assert [each.name for each in result.answers[0].contour.elements] == [
        "line 1",
        "arc",
        "corner 2",
        "line 2",
        "line 3",
    ]
    documents = Document("program", text.encode()), Document("result", to_json(result).encode())
    assert verify(*documents, control=MILL).verdict is ReceiptVerdict.VERIFIED


def test_verify_tells_corners_that_are_left_out_from_those_that_are_forgotten():
    lines = [f"G01 X{20 * each}. Y{each % 3 / 10} ,C2." for each in range(1, 4)]
    text = "\n".join(("G17 G90 G00 X0 Y0", *lines, "X80. Y30."))

    def verdict(of: str) -> ReceiptVerdict:
        result = to_json(solve(of, control=MILL)).encode()
        return verify(Document("program", text.encode()), Document("result", result), control=MILL).verdict

    assert len(check(text, control=MILL)) == 2
    assert verdict(text) is ReceiptVerdict.VERIFIED
    assert verdict(text.replace("Y0.0 ,C2.\nX80.", "Y0.0\nX80.")) is not ReceiptVerdict.VERIFIED


SWEPT = "G00 X50. Z50.\nG01 ,A30. ,R5.\nX0. Z150. ,A-45."
SINGLE = "G00 X20. Z0.\nG01 X40. ,A150. ,C2.\nZ-60."
AT_THE_GUARD = [134.0, 133.999, 135.0, 136.0, 136.001, -44.0, -45.0, -46.0, -46.001, 30.0, 100.5, -120.0, 314.5, 493.5]
SWEEPS = [
    ("G00 X0 Y0\nG01 X30. ,C5.\nX60. Y1.", {"3:Y": [-1.0, -0.53, -0.52, 0.0, 0.52, 0.53, 1.0]}, MILL, {}),
    ("G00 X0 Y0\nG01 X30. ,C5.\nX60. Y1.", {"3:Y": [-2.0, -0.53, -0.52, 0.3, 0.53]}, MILL, {"guard-corner": "error"}),
    (
        "G00 X20. Z0\nG01 Z-25. R5.\nX40.",
        {"2:R": [-12.0, -5.0, 0.0, 5.0, 12.0], "3:X": [-10.0, 5.0, 20.0, 40.0]},
        LATHE,
        {},
    ),
    *(
        case
        for settings in ({}, {"angle-sense": "ray"}, {"guard-deg": "0"})
        for case in (
            (SWEPT, {"3:,A": AT_THE_GUARD, "2:,R": [0.0, 5.0, 40.0]}, LATHE, settings),
            (SINGLE, {"2:,A": [0.0, 0.5, 1.0, 1.001, 90.0, 178.999, 179.0, 181.001, -0.5, 359.5]}, LATHE, settings),
            (SWEPT, {"2:,A": [30.0, 40.0, 134.5, 135.0], "3:,A": [-45.0, -40.0, -45.9, 30.5]}, LATHE, settings),
        )
    ),
]


@pytest.mark.parametrize(("text", "vary", "control", "settings"), SWEEPS)
def test_a_sweep_across_the_guard_and_the_sign_says_what_solve_says(text, vary, control, settings):
    """Also within the guard about the other line's direction, and at its ends."""
    named = {f"{control}.{name}": value for name, value in settings.items()}
    table, rows = family(text, vary=vary, control=control, settings=named), [*product(*vary.values())]
    for number, row in enumerate(rows):
        lines = text.split("\n")
        for name, value in zip(vary, row, strict=True):
            line, address = name.split(":")
            lines[int(line) - 1] = re.sub(rf"(?<![,A-Z]){address}-?[\d.]+", f"{address}{value}", lines[int(line) - 1])
        (answer,) = solve("\n".join(lines), control=control, settings=named, depth="verdict").answers
        assert StatusCode(table["status"].ravel()[number]).status is answer.status, row
        if answer.contour:
            for point, pair in answer.contour.points.items():
                for letter, value in zip(answer.plane.axes, pair, strict=True):
                    assert table[f"{point}.{letter}"].ravel()[number] == pytest.approx(value, abs=1e-9), row
    is_by_row = text == SWEPT and len(vary["3:,A"]) == 4 and "guard-deg" not in settings
    assert table.remark == "each value of ,A of block 2 and ,A of block 3 decides how its row is read" * is_by_row


@pytest.mark.parametrize("control", MACHINES)
def test_a_number_without_a_point_counts_least_increments_or_is_as_written(control):
    text, expected = {
        True: ("{} X20000 Z0\nG01 X40000 ,C2000\nZ-30000", "20 0; 36 0; 40 -2; 40 -30"),
        False: ("{} G17 G90 X0 Y0\nG01 X40000 ,C2000\nY30000", "0 0; 38 0; 40 2; 40 30"),
    }[control.endswith("lathe")]
    share = 0.5 if control.endswith("lathe") else 1
    for unit, size in (("G21 G00", 1), ("G20 G00", 2.54)):
        found = path(solve(text.format(unit), control=control))
        wanted = [each._replace(start=each.start * size, end=each.end * size) for each in drawn(expected, share)]
        assert gap(wanted, found) < 1e-9
    plain = solve(
        text.replace("000", "").format("G21 G00"), control=control, settings={f"{control}.number": "calculator"}
    )
    assert gap(drawn(expected, share), path(plain)) < 1e-9


def test_an_angle_without_a_point_counts_thousandths_of_a_degree():
    result = solve(START + "G01 X40. ,A150000", control=LATHE)
    assert result.answers[0].contour.end == pytest.approx((-17.320508, 20))


# Corners between two axes ------------------------------------------------------------------------------------

PLAIN = {"fanuc-lathe.corner-words": "plain"}


@pytest.mark.parametrize("control", [LATHE, MILL, HAAS_LATHE])
@pytest.mark.parametrize("part", range(8))
def test_random_steps_with_signs_come_out_as_the_oracle_says(control, part):
    rng, verdicts = Random(f"steps {control}{part}"), Counter[str]()
    plane, letters = ("G18", "ZXKI") if control != MILL else rng.choice((("G17", "XYIJ"), ("G19", "YZJK")))
    for _ in range(30):
        program, way = [f"{plane} G90 G00 {letters[0]}0 {letters[1]}400."], rng.randrange(2)
        at, steps = [0.0, 400.0], [rng.choice((-1, 1)) * rng.uniform(15, 60) for _ in range(rng.randint(2, 5))]
        for number, step in enumerate(steps):
            at[way] += step
            word = f"{letters[way]}{at[way]:.3f}"
            if number + 1 < len(steps) and rng.random() < 0.8:
                sign = (1 if steps[number + 1] > 0 else -1) * (-1 if rng.random() < 0.1 else 1)
                address = rng.choice((letters[3 - way], *("R" * (control != MILL))))
                word += f" {address}{sign * rng.uniform(0.5, 5):.3f}"
            program.append("G01 " + word)
            way = 1 - way if rng.random() < 0.95 else way
        program = disturbed(rng, program, TYPED[control]) if rng.random() < 0.3 else program
        verdicts[judge(program, control, MACHINES[control])] += 1
    assert verdicts["right"] > 5
    assert verdicts["refused"] > 1


@pytest.mark.parametrize("seed", range(5))
def test_random_chains_in_plain_words_are_those_with_commas(seed):
    rng = Random(seed)
    for _ in range(3):
        text = "\n".join(draw(rng, LATHE))
        with_commas, plain = solve(text, control=LATHE), solve(text.replace(",", ""), control=LATHE, settings=PLAIN)
        assert path(plain) == path(with_commas), text


def test_plain_words_leave_the_radius_of_an_arc_alone():
    text = FL_G4 + "\nG02 X60. Z-55. R5.\nG01 Z-60. R2.\nX70."
    assert [each.form for each in solve(text, control=LATHE, settings=PLAIN).answers] == ["corners", "corners"]
    assert solve("G00 X20. Z0\nG02 X30. Z-5. R5.", control=LATHE, settings=PLAIN).answers == ()


@pytest.mark.parametrize("control", MACHINES)
def test_a_corner_within_the_guard_may_be_refused(control):
    start, ends = (
        ("G00 X50. Z0", ("Z-40.", "X50.2 Z-40."))
        if control.endswith("lathe")
        else ("G00 Z-20. X0 Y0", ("X60.", "X60. Y.3"))
    )
    first, beyond = ("Z-20.", "X52. Z-40.") if control.endswith("lathe") else ("X30.", "X60. Y2.")
    for end in (*ends, beyond):
        text = f"{start}\nG01 {first} ,C2.\n{end}"
        assert solve(text, control=control).answers[0].contour is not None
        refused = solve(text, control=control, settings={f"{control}.guard-corner": "error"})
        assert (refused.answers[0].contour is None) is (end != beyond)
        assert [each.code for each in errors(refused)] == [f"{control.split('-')[0]}-corner-straight"] * (end != beyond)
        documents = Document("program", text.encode()), Document("result", to_json(refused).encode())
        assert verify(*documents).verdict is not ReceiptVerdict.FAILED


# Which control ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "control"),
    [
        (FL_G1, LATHE),
        (FL_G1.replace(" ,A-45.", ""), LATHE),
        ("G00 U-10. W5.\nG01 ,A30.\nX0.\nZ150.", LATHE),
        ("G00 X20. Z0\nG01 X40.\nZ-30. ,A175.", LATHE),
        ("G18 G90 G00 X20. Z0\nG01 X40. ,A30.", "nct-99m"),
        ("G17\n" + FL_G1, "nct-99m"),
        ("G00 X0 Y0\nG01 X40. ,A30.", "nct-99m"),
        (FM_G1, None),
        (START + "G111 A180. K-30. B120. X100.", "yasnac-lx3"),
    ],
)
def test_the_control_is_told_from_the_program_or_asked_for(text, control):
    if control:
        assert solve(text).control == control
        return
    with pytest.raises(UnknownControlError) as caught:
        solve(text)
    assert len(caught.value.choices) > 1
    for name in caught.value.choices:
        assert name in str(caught.value)


# Commands ---------------------------------------------------------------------------------------------------

DWELL = FL_G5.replace("N60 Z-70.", "G04 P500\nN60 Z-70.").replace("N50 X60.", "N45 G04 U1.5 (WAIT)\nN50 X60.")


@pytest.mark.parametrize("post", ["same", "fanuc", "linuxcnc"])
def test_a_dwell_behind_a_corner_stays_between_the_corner_and_the_next_line(post):
    lines = expand(DWELL, post=post).text.splitlines()
    at = [number for number, line in enumerate(lines) if "G04" in line]
    assert len(at) == 2
    assert lines[at[0] - 1].startswith("G02 X53.67"), "the rounding behind N40 ends before it"
    assert lines[at[1] - 1] == "G01 X60. Z-57."
    assert next(line for line in lines[at[1] + 1 :] if line[0] != "(").startswith("N60 G01 X60. Z-68.")


def test_a_dwell_behind_an_open_line_stays_at_its_end():
    text = "G00 X50. Z50.\nG01 ,A30.\nG04 P500\nX0. Z150. ,A-45."
    lines = [line for line in expand(text).text.splitlines() if line[0] != "("]
    assert [line[:3] for line in lines] == ["G00", "G01", "G04", "G01"]


@pytest.mark.parametrize("number", range(len(EXAMPLES)))
@pytest.mark.parametrize("post", ["same", "fanuc"])
def test_an_example_and_what_it_is_expanded_to_are_the_same_path(number, post, tmp_path):
    control, row = EXAMPLES[number]
    text = "\n".join(row["program"]) + "\n"
    old, new = tmp_path / "old.nc", tmp_path / "new.nc"
    old.write_text(text)
    new.write_text(expand(text, control=control, post=post).text)
    named = ["--control", control]
    outcome = CliRunner().invoke(main, ["diff", str(old), str(new), *named])
    assert outcome.exit_code == 0, outcome.output
    text = new.read_text()
    place = re.search(r"^(?:N\d+ )?G01 X(-?\d+\.\d*)", text, re.MULTILINE)
    new.write_text(f"{text[: place.start(1)]}{float(place[1]) + 0.01}{text[place.end(1) :]}")
    assert CliRunner().invoke(main, ["diff", str(old), str(new), *named]).exit_code == 1


def test_a_value_that_is_asked_for_is_found_beside_a_fact():
    (answer,) = solve("G00 X50. Z50.\nG01 ,A30.\nX0. Z? ,A-45.", facts=["X of P1 = 104.90381"]).answers
    assert answer.answers[0].value == pytest.approx(150, abs=1e-4)
    (answer,) = solve("G17 G90 G00 X0 Y0\nG1 X50. ,R?\nY40.", control=MILL, facts=["radius of corner 1 = 7"]).answers
    assert answer.answers[0].value == pytest.approx(7)
    (answer,) = solve(START + "G01 X40. ,A? (contoursolve: length of line = 20)", control=LATHE).answers
    assert answer.status.value == "ambiguous", "a line of 20 mm to that diameter runs either way"


def test_what_a_setting_means_that_is_not_computed_is_refused():
    angled, arc = START + "G01 X40. ,A150.", "G17 G90 G00 X0 Y0\nG01 X40. ,C6.\nG02 X60. Y20. I20. J0"
    for control, text, setting in ((LATHE, angled, "angle=supplementary"), (MILL, arc, "chamfer-on-arc=arc_length")):
        name, value = setting.split("=")
        assert solve(text, control=control).answers[0].contour is not None
        (answer,) = solve(text, control=control, settings={f"{control}.{name}": value}).answers
        assert answer.contour is None
        assert any(value in each.message or name in each.help for each in answer.diagnostics)


STEPS = [f"G00 X20. Z0\nG01 Z-25. R{sign}5.\nX{end}." for sign in ("", "-") for end in range(-30, 70, 33)]


@pytest.mark.parametrize("settings", [{}, {"angle-sense": "ray"}, {"guard-deg": "0"}])
def test_many_contours_of_a_program_come_out_as_each_alone(settings):
    """Programs with many contours of one form solve them together."""
    rng, named = Random(f"{settings}"), {f"{LATHE}.{name}": value for name, value in settings.items()}
    special, blocks = [0.0, 90.0, 180.0, 179.5, 90.3, 150.0, -45.0], [*STEPS]
    for _ in range(5):
        first, second = (rng.choice([rng.uniform(0, 360), *special]) for _ in range(2))
        blocks.append(f"G00 X50. Z50.\nG01 ,A{first:.3f} ,R2.\nX80. Z{rng.choice((0, 150))}. ,A{second:.3f}")
    together = solve("\n".join(blocks), control=LATHE, settings=named).answers
    for text, answer in zip(blocks, together, strict=True):
        (alone,) = solve(text, control=LATHE, settings=named).answers
        assert (answer.status, elements(answer)) == (alone.status, elements(alone)), text
        # What is hardly meant depends on the contours beside.
        one, other = ([each.code for each in found.diagnostics] for found in (answer, alone))
        assert [code for code in one if code != "suspected"] == [code for code in other if code != "suspected"], text


def test_a_corner_in_a_thread_behind_a_contour_is_told():
    result = solve("G00 X20. Z0.\nG01 X22. ,A150.\nG32 Z-25. F1. ,R2.\nM30", control=LATHE)
    assert [each.alarm.number[:3] for each in errors(result)] == ["050"]
    assert [each.status.value for each in result.answers] == ["solved", "rejected"]
