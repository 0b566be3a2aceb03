"""CNC PILOT: what must be said of wrong programs, its settings, and its sections. Its worked examples are vectors."""

from math import cos, degrees, hypot, radians, sin, tan
from random import Random

import pytest
from click.testing import CliRunner
from free_chains import Drawn, Step, draw
from vectors import program_of

from contoursolve import ArcSegment, check, expand, solve
from contoursolve.cli import main

PROGRAM, LEAVING = program_of("cnc-pilot", "CP-P1"), program_of("cnc-pilot", "CP-G10")


def text(example: str) -> str:
    return example.replace(" / ", "\n")


def path(result) -> list[float]:
    """The numbers of a path: +2 for an arc clockwise and +3 for another one, with its radius and its centre; Z and X of
    each end, X as a diameter."""
    found: list[float] = []
    for answer in result.answers:
        for element in answer.contour.elements if answer.contour else ():
            if isinstance(element, ArcSegment):
                center, radius = element.center, element.radius
                found += [{"cw": 2, "ccw": 3}[element.turn.value], radius, center[0], 2 * center[1]]
            found += [element.end[0], 2 * element.end[1]]
    return found


WRONG = {
    "E1": ("words-missing", "one word is missing, so line 1 and line 2 are open"),
    "E2": ("lines-parallel", "no P1 fits A10, X80, Z-60 and A10: the lines are parallel and 9.277 mm apart"),
    "E3": ("circle-missed", "it passes the centre at 20.000 mm, the radius is 15.000 mm, 5.000 mm too far"),
    "E4": ("radius-too-small", "15.000 mm is less than half the distance between two points of the arc, 18.028 mm"),
    "E5": ("cnc-pilot-corner-too-large", "B12 is 12.000 mm, at most 10.000 mm fits on line 1"),
    "E6": ("words-conflict", "by 2.935 mm: it states 15.000 deg, they give 9.462 deg"),
    "E7": ("no-point", "no P1 fits A0 and A60 together G3 in program line 3 was probably G2"),
    "E8": ("cnc-pilot-feed-range", "E1.5: the share of the feed is above 0, and 1 at most"),
    "E9": ("cnc-pilot-arc-empty", "arc 1 ends where it begins: no arc, or a full circle, would be cut"),
    "E10": ("cnc-pilot-center-and-radius", "R25, I20 and K-5: the arc has both a centre and a radius"),
    "E11": ("words-missing", "one word is missing, so arc 1 is open"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_the_sheet_wants_said_of_a_wrong_program_is_said(name):
    found = check(program_of("cnc-pilot", f"CP-{name}"), control="cnc-pilot")
    code, told = WRONG[name]
    (finding,) = (each for each in found if each.code == code)
    assert told in " ".join((finding.message, *finding.notes))
    assert {each.code for each in found} <= {code, "radius-difference"}
    assert [each.alarm for each in found if each.alarm] == []


@pytest.mark.parametrize(("corner", "fitting"), [("B-15", "B-5"), ("B15", "B5")])
def test_of_a_corner_too_large_the_largest_one_of_its_kind_is_offered_first(corner, fitting):
    (found,) = check(f"G0 X30 Z0\nG1 X50 {corner}\nG1 Z-5\nG1 X70", control="cnc-pilot")
    assert found.fixes[0].description.startswith(f"write {fitting} for {corner}")


def test_a_contour_below_the_turning_centre_is_told():
    told = {each.code: each.severity.value for each in check("G0 X20 Z0\nG1 X-4", control="cnc-pilot")}
    assert told == {"axis-crossed": "warning", "cnc-pilot-below-centre": "warning"}


def test_a_forgotten_tangency_is_what_b0_says():
    """Without B0 the elements touch, and nothing is missing."""
    assert not check(program_of("cnc-pilot", "CP-E11").replace(" B0", ""), control="cnc-pilot")


SETTINGS = {
    "angle-zero=plus_z": ("G0 X40 Z-60 / G1 X60 A30 B2 / G1 Z0", "G0 X40 Z-60 / G1 X60 A150 B2 / G1 Z0"),
    "i=diameter": (LEAVING.replace("I0", "I10"), LEAVING.replace("I0", "I5")),
    "arc-q=zero_far": (LEAVING, LEAVING.replace("B0", "B0 Q1")),
    "modal-g=on": ("G0 X30 Z0 / G1 X50 B-2 / Z-40", "G0 X30 Z0 / G1 X50 B-2 / G1 Z-40"),
    "b-missing=always": ("G0 X40 Z0 / G1 Z-30 / G2 X70 Z-42 R12.3", "G0 X40 Z0 / G1 Z-30 / G2 X70 Z-42"),
    "chamfer=face": ("G0 X30 Z0 / G1 X50 B-2.828427 / G1 Z-40", "G0 X30 Z0 / G1 X50 B-2 / G1 Z-40"),
}


@pytest.mark.parametrize("stated", SETTINGS)
def test_a_setting_reads_a_program_as_the_default_reads_another_one(stated):
    name, value = stated.split("=")
    program, meant = map(text, SETTINGS[stated])
    result = solve(program, control="cnc-pilot", settings={f"cnc-pilot.{name}": value})
    assert not result.has_errors
    assert path(result) == pytest.approx(path(solve(meant, control="cnc-pilot")), abs=1e-5)
    assert [each.value for each in result.answers[0].premises.conventions if each.setting.name == name] == [value]
    assert path(solve(program, control="cnc-pilot")) != pytest.approx(path(result), abs=1e-5) or name == "b-missing"


def test_words_of_later_controls_and_small_letters_are_the_same_words():
    program = program_of("cnc-pilot", "CP-G7")
    later = program.replace("A10 B5", "an10 br5 be0.5").replace("B-2", "br-2")
    assert path(solve(later, control="cnc-pilot")) == path(solve(program, control="cnc-pilot"))


def test_data_of_sections_without_a_contour_are_no_contour():
    told = solve(PROGRAM.replace("ROHTEIL", "REVOLVER 1\nT1 G1 X20 A5\nROHTEIL"))
    assert len(told.answers) == len(solve(PROGRAM).answers)


def test_the_place_before_a_section_counts_no_longer_in_it():
    told = solve(
        PROGRAM.replace("N2 G0 X0 Z0 [start]\n", "").replace("FERTIGTEIL", "HILFSKONTUR\nG0 X0 Z0\nFERTIGTEIL")
    )
    assert {each.code for each in told.diagnostics if each.is_error} >= {"position-unknown"}


def test_a_contour_on_the_face_is_refused_by_its_code():
    told = check(PROGRAM + "\nSTIRN Z0\nG100 XK30 YK-10\nG101 A90 B4")
    assert [each.message for each in told if each.code == "not-read"] == [
        f"contoursolve does not read G{number} yet" for number in (100, 101)
    ]


def test_what_is_written_out_is_the_same_path(tmp_path):
    written = expand(PROGRAM)
    assert (written.control, written.summary.replaced, written.summary.left) == ("cnc-pilot", 1, [])
    for name, program in (("old", PROGRAM), ("new", written.text)):
        (tmp_path / name).write_text(program)
    done = CliRunner().invoke(main, ["diff", str(tmp_path / "old"), str(tmp_path / "new"), "--control", "cnc-pilot"])
    assert (done.exit_code, "A" in written.text.partition("N5 G01")[2].splitlines()[0]) == (0, False), done.output


def test_a_program_in_din_plus_shows_its_control_and_a_bare_contour_does_not():
    assert solve(PROGRAM).control == "cnc-pilot"
    assert solve(program_of("cnc-pilot", "CP-G7")).control is None


# Drawn first and described by words afterwards ------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(8))
def test_the_centre_of_an_arc_counts_from_the_end_of_a_line_also_where_that_is_computed(seed: int):
    random = Random(seed)
    angle, rise, turn = random.uniform(10, 60), random.uniform(3, 15), random.choice((2, 3))
    tail = -rise / tan(radians(angle)), 20 + rise
    step, way = (random.uniform(-6, 6), random.choice((-1, 1)) * random.uniform(8, 20)), random.uniform(0, 360)
    center = tail[0] + step[0], tail[1] + step[1]
    end = center[0] + hypot(*step) * cos(radians(way)), center[1] + hypot(*step) * sin(radians(way))
    line = f"N2 G1 X{2 * tail[1]:.4f} A{angle:.5f} B0"
    arc = f"N3 G{turn} X{2 * end[1]:.4f} Z{end[0]:.4f} I{step[1]:.4f} K{step[0]:.4f}"
    result = solve(f"FERTIGTEIL\nN1 G0 X40 Z0\n{line}\n{arc}\nBEARBEITUNG\nENDE")
    wanted = [tail[0], 2 * tail[1], turn, hypot(*step), center[0], 2 * center[1], end[0], 2 * end[1]]
    assert path(result) == pytest.approx(wanted, abs=5e-3)
    assert not [each for each in result.diagnostics if each.is_error]


def place(at: tuple[float, float]) -> str:
    return f"X{2 * at[1]:.9f} Z{at[0]:.9f}"


def center(each: Drawn, is_step: bool) -> str:
    along, across = each.tail if is_step else (0.0, 0.0)
    return f"I{each.center[1] - across:.9f} K{each.center[0] - along:.9f}"


def arc(each: Drawn, number: int = 0) -> str:
    return f"G{number + (2 if each.step.sense < 0 else 3)}"


def slope(each: Drawn) -> str:
    return f"A{180 - degrees(each.begin):.9f}"


def line(random: Random) -> Step:
    return Step(length=random.uniform(15, 60))


def bow(random: Random) -> Step:
    return Step(radius=random.uniform(5, 40), sweep=radians(random.uniform(20, 150)), sense=random.choice((-1, 1)))


OPEN = "X? Z?"
WORDINGS = {
    "line, arc, line": lambda one, two, last: (
        *(f"G1 {slope(one)}", f"{arc(two)} {OPEN} R{two.step.radius:.9f}", f"G1 {place(last.head)} {slope(last)}"),
    ),
    "arc, line": lambda one, two: (f"{arc(one)} {OPEN} {center(one, True)}", f"G1 {place(two.head)}"),
    "line, arc": lambda one, two: (f"G1 {place(one.head)}", f"{arc(two)} {place(two.head)}"),
    "arc, line, arc": lambda one, _, last: (
        *(f"{arc(one, 10)} {OPEN} {center(one, False)}", f"G1 {OPEN}"),
        f"{arc(last, 10)} {place(last.head)} {center(last, False)}",
    ),
    "arc, arc": lambda one, two: (
        *(f"{arc(one)} {place(one.head)} R{one.step.radius:.9f}", f"{arc(two)} {place(two.head)}"),
    ),
}
"""The words of elements that touch, as few as they need."""


@pytest.mark.parametrize("seed", range(16))
@pytest.mark.parametrize("kinds", WORDINGS)
def test_elements_that_touch_are_found_again(kinds, seed):
    for part in range(4):
        random = Random(f"{kinds} {4 * seed + part}")
        steps = [line(random) if kind == "line" else bow(random) for kind in kinds.split(", ")]
        drawn = draw((0.0, 500.0), radians(random.uniform(-180, 180)), steps)
        program = "\n".join((f"G0 {place(drawn[0].tail)}", *WORDINGS[kinds](*drawn)))
        (answer,) = solve(program, control="cnc-pilot", depth="verdict").answers
        found = [number for each in answer.contour.elements for number in each.end]
        assert found == pytest.approx([number for each in drawn for number in each.head], abs=1e-5), program
