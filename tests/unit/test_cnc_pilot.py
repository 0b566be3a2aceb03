"""CNC PILOT: what must be said of wrong programs, its settings, and its sections. Its worked examples are vectors."""

from math import cos, hypot, radians, sin, tan
from random import Random

import pytest
from vectors import program_of

from contoursolve import ArcSegment, solve

LEAVING = program_of("cnc-pilot", "CP-G10")


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


def test_the_centre_of_an_arc_counts_from_an_end_that_is_computed():
    line = "FERTIGTEIL\nG0 X40 Z0\nG1 X50 A20 B0\n{}\nBEARBEITUNG\nENDE"
    by_steps = path(solve(line.format("G2 X70 Z-30 I15 K-1.9828"), control="cnc-pilot"))
    begin = -5 / tan(radians(20))
    assert by_steps[:2] == pytest.approx([begin, 50])
    assert by_steps[2:] == pytest.approx([2, hypot(15, 1.9828), begin - 1.9828, 80, -30, 70])
    # Without its end, the line has two; near or far, the distances from the centre agree.
    for near, first in ((0, -28.2915), (1, -54.8968)):
        chosen = path(
            solve(
                line.format(f"G1 A5 B0 Q{near}\nG2 X58 Z-52 I10 K-10").replace("G1 X50 A20 B0\n", ""),
                control="cnc-pilot",
            )
        )
        z, x = chosen[:2]
        assert (z, (x - 40) / 2) == pytest.approx((first, -z * tan(radians(5))), abs=1e-4)
        assert hypot(z - 10 + 52, x / 2 + 10 - 29) == pytest.approx(hypot(10, 10))
