"""Fanuc and Haas, fact by fact of the controls' sheets: lines and arcs with ,A ,C ,R, and what is refused."""

from collections import Counter
from collections.abc import Sequence
from math import inf
from random import Random

import pytest
from examples_fanuc import (
    FL_G5,
    FM_G3,
    HAAS_LATHE,
    HAAS_MILL,
    LATHE,
    MILL,
)
from generate_fanuc import disturbed, random_lathe, random_mill
from oracle import Element, elements_of
from oracle_corners import gap
from oracle_fanuc import Machine, run

from contoursolve import Diagnostic, Result, check, solve
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.errors import UnknownControlError
from contoursolve.output import to_json


def errors(result: Result) -> list[Diagnostic]:
    return [each for each in result.diagnostics if each.severity.value == "error"]


def path(result: Result) -> list[Element]:
    """All contours of a program, one behind the other."""
    return [element for answer in result.answers for element in elements_of(answer)]


def test_the_program_of_the_lathe_tells_its_control_and_that_of_the_mill_asks():
    assert solve(FL_G5).control == LATHE
    with pytest.raises(UnknownControlError) as caught:
        solve(FM_G3)
    assert set(caught.value.choices) >= {MILL, HAAS_MILL, "nct-99m"}
    assert not {"yasnac-lx3", LATHE, HAAS_LATHE} & {*caught.value.choices}


# Seen in real text ------------------------------------------------------------------------------------------


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


START_UPS = [
    ("G42\nG01 X30. ,R5.\nY40.", True),
    ("G01 X10.\nG42 D1\nM8\nX30. ,R5.\nY40.", True),
    ("G42 D1\nG01 Z-5. F100.\nX30. ,R5.\nY40.", True),
    ("G42\nG01 X10.\nX30.\nG40\nY40. ,R5.\nX60.", True),
    ("G42\nG01 X10.\nX20.\nX30.\nG40\nX40. ,R5.\nY40.", True),
    ("G42\nG01 X10.\nG41\nX30. ,R5.\nY40.", True),
    ("G42\nM98 P7\nG00 X0 Y0\nG01 X30. ,R5.\nY40.\nM30\nO7\nG01 X5.\nM99", False),
    ("G42\nG01 X10.\nG42\nX30. ,R5.\nY40.", False),
    ("G42\nG01 X10.\nX20.\nX25.\nX30. ,R5.\nY40.", False),
    ("G40 G80\nG01 X30. ,R5.\nY40.", False),
    ("G42\nG01 X10.\nX30. ,R5.\nY40. ,R5.\nX60. ,R5.\nY80.\nG40\nX90.", False),
]
"""Behind a rapid to X0 Y0 of a mill: whether a corner stands in the first move since the compensation was switched."""


@pytest.mark.parametrize(("text", "is_told"), START_UPS)
def test_no_corner_stands_in_the_first_move_behind_a_switch_of_the_compensation(text, is_told):
    found = [each.code for each in errors(solve(f"G17 G90 G00 X0 Y0\n{text}", control=MILL))]
    assert found == ["fanuc-corner-start-up"] * is_told


def test_a_haas_lathe_makes_the_same_corners_in_each_plane():
    def made(text: str, *, is_swapped: bool):
        found = solve(text, control=HAAS_LATHE)
        assert not found.has_errors
        way = (lambda at: complex(at.imag, at.real)) if is_swapped else complex
        return [(each.kind, way(each.start), way(each.end), each.radius) for each in path(found)]

    own = made("G00 X60. Z2.\nG01 Z-20. ,R3.\nX100. ,C2.\nZ-50.", is_swapped=False)
    assert own == made("G17 G00 X60. Y2.\nG01 Y-20. ,R3.\nX100. ,C2.\nV-30.", is_swapped=True)
    assert own == made("G19 G00 Y30. Z2.\nG01 Z-20. ,R3.\nY50. ,C2.\nW-30.", is_swapped=True)


@pytest.mark.parametrize("centre", ["I20.", "J0", "I22. J3.", "J-9. I20."])
def test_a_radius_wins_over_a_centre_and_says_so(centre):
    text = "G17 G90 G00 X0 Y0\nG01 X40. ,C6.\nG02 X60. Y20. {}\nG01 X80."
    found = solve(text.format(f"{centre} R20."), control=MILL)
    assert path(found) == path(solve(text.format("R20."), control=MILL))
    assert [each.code.rpartition("-")[2] for each in found.diagnostics] == ["ignored"] * len(centre.split())
    assert not errors(found)
    clash = solve(text.format(f"{centre} R20."), control=HAAS_MILL, settings={"haas-mill.generation": "classic"})
    assert "haas-center-and-radius" in {each.code for each in errors(clash)}


# Random contours --------------------------------------------------------------------------------------------

MACHINES = {
    LATHE: Machine(is_lathe=True, signed="IKR"),
    MILL: Machine(is_lathe=False, signed="IJK", radius_wins=True),
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
    found = {answer.claim.blocks[0].line: elements_of(answer) for answer in result.answers if answer.contour}
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
    *((HAAS_MILL, {"generation": "classic"}, {"arcs": True}, kinds) for kinds in PAIRS),
]
"""Controls, settings, what they change of the oracle's machine, and the kinds of two moves."""


@pytest.mark.parametrize(("control", "settings", "changes", "kinds"), DRAWN)
@pytest.mark.parametrize("part", range(4))
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


def test_an_angle_without_a_point_counts_thousandths_of_a_degree():
    result = solve(START + "G01 X40. ,A150000", control=LATHE)
    assert result.answers[0].contour.end == pytest.approx((-17.320508, 20))


# Corners between two axes ------------------------------------------------------------------------------------

PLAIN = {"fanuc-lathe.corner-words": "plain"}


@pytest.mark.parametrize("seed", range(5))
def test_random_chains_in_plain_words_are_those_with_commas(seed):
    rng = Random(seed)
    for _ in range(3):
        text = "\n".join(draw(rng, LATHE))
        with_commas, plain = solve(text, control=LATHE), solve(text.replace(",", ""), control=LATHE, settings=PLAIN)
        assert path(plain) == path(with_commas), text


# Commands ---------------------------------------------------------------------------------------------------


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
        assert (answer.status, elements_of(answer)) == (alone.status, elements_of(alone)), text
        # What is hardly meant depends on the contours beside.
        one, other = ([each.code for each in found.diagnostics] for found in (answer, alone))
        assert [code for code in one if code != "suspected"] == [code for code in other if code != "suspected"], text
