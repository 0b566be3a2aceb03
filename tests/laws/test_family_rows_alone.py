"""Every row of a family is what a single solve says of its block, whatever row stands first."""

from itertools import count
from random import Random

import numpy as np
import pytest
from generate_families import BLOCKS, ROWS, draw

from contoursolve import family, find, sensitivity, solve, tolerances
from contoursolve.errors import FamilyError
from contoursolve.families import feasible, region, spec_of
from contoursolve.output.families import rest_lines
from contoursolve.solving import STATUSES, Status

NEAR = 1e-7  # mm, or of the coordinate


def alone(block, values, **options):
    """What a single solve says of a block with these values in their places."""
    template = spec_of(block, [*values], **options).template()
    return template.solve(dict(zip(template.words, values.values(), strict=True)))


def difference(row, answer):
    """By what a row differs from a single solve; empty if by nothing."""
    status = STATUSES[int(row["status"])]
    if status is not answer.status:
        return f"{status}, alone {answer.status}"
    if answer.contour is None:
        return ""
    places = {name: at for name, at in answer.contour.places.items() if name != answer.profile.figure.start}
    for name, at in places.items():
        for axis, radius, is_diameter in zip(answer.plane.axes, at, answer.plane.diameters, strict=True):
            value = radius * (1 + is_diameter)
            if not abs(row[f"{name} {axis}"] - value) <= NEAR * max(1, abs(value)):  # true for NaN
                return f"{name} {axis} is {row[f'{name} {axis}']}, alone {value}"
    return "" if row["residual"] <= NEAR else f"off by {row['residual']}"


@pytest.mark.parametrize("form", BLOCKS)
@pytest.mark.parametrize("part", range(4))
def test_every_row_is_what_a_single_solve_says(form, part):
    for number in count(part, 8):
        asked = draw(Random(f"{form} {number}"), form)
        options = {"control": asked.control} | ({} if asked.start is None else {"start": asked.start})
        try:
            found = family(asked.block, vary=asked.vary, paired=True, **options)
        except FamilyError:
            continue
        for row in range(ROWS):
            answer = alone(asked.block, {word: each[row] for word, each in asked.vary.items()}, **options)
            assert not difference({name: found[name][row] for name in found.columns}, answer), (asked, row)
        if Status.SOLVED.code in found["status"]:
            return


HANDED_ON = "FL AN+0 LEN20\nFCT DR+ R10 CCA+0\nFLT LEN10"
TURNED = "G17 G90 G1 X18.169 Y18.888\nCT X43.512 Y24.063\nCT X62.863 Y26.403\nCT X98.566 Y12.069"
KLARTEXT = {"control": "heidenhain", "start": "X0 Y0"}
SINUMERIK = {"control": "siemens-840d", "start": "X0 Y0"}


@pytest.mark.parametrize("order", [[30, 90], [90, 30], [0, 90, 30]])
def test_the_direction_that_an_arc_hands_to_a_line_is_that_of_its_row(order):
    found = family(HANDED_ON, vary={"2:CCA": order}, **KLARTEXT)
    (at,) = np.flatnonzero(np.array(order) == 90)
    assert (found["P3 X"][at], found["P3 Y"][at]) == pytest.approx((10, 20))


def test_tangent_arcs_turn_to_the_side_of_their_row():
    found = family(TURNED, vary={"2:Y": [24, 26, 28.8582, 30]}, **SINUMERIK)
    assert found["status"].tolist() == [Status.SOLVED.code] * 4
    assert found["r3"][2:] == pytest.approx([104.8299, 2589.4814], abs=5e-5)


def test_a_start_that_moves_turns_an_arc_that_ends_on_the_other_side_of_its_centre():
    block = "G112 X100. K-30. I10. R20."
    found = family(block, vary={"X": [100, 60], "start.X": [80, 140]}, control="yasnac-lx3", start="X80. Z0.")
    for row, (end, begin) in enumerate([(100, 80), (100, 140), (60, 80), (60, 140)]):
        (answer,) = solve(block.replace("X100.", f"X{end}."), control="yasnac-lx3", start=f"X{begin}. Z0.").answers
        assert STATUSES[found["status"].ravel()[row]] is answer.status


def test_a_word_that_others_count_from_varies_with_them():
    found = family("L X+3 Y+4\nRND R1\nFL IX20 IY0", vary={"start.X": [0, 1], "1:X": [3, 5]}, **KLARTEXT)
    assert found["P2 X"].ravel() == pytest.approx([23, 25, 23, 25])


def test_a_word_is_found_that_turns_what_stands_behind_it():
    found = find(HANDED_ON, "2:CCA", "end X25", within=(10, 360), **KLARTEXT)
    assert [hit.value for hit in found.hits] == pytest.approx([24.295189, 245.704811])
    assert found.is_complete
    near = find(HANDED_ON, "2:CCA", "end X25", within=(10, 60), **KLARTEXT)
    assert [hit.value for hit in near.hits] == pytest.approx([24.295189])


def test_a_centre_and_the_end_of_a_chain_are_points_that_a_word_brings_somewhere():
    block = "FL AN+30 LEN20\nFCT DR- R10 CCA+30\nFLT LEN15"
    (hit,) = find(block, "1:LEN", "C2 X25", **KLARTEXT).hits
    assert hit.value == pytest.approx(20 / 3**0.5 * 2, abs=1e-9)
    (hit,) = find(block, "3:LEN", "P3 X40", within=(1, 100), **KLARTEXT).hits
    assert hit.point[0] == pytest.approx(40)


CUT = "FL X+0 Y+20\nFL Y+20\nFL X+50 Y+20"


@pytest.mark.parametrize(
    ("block", "word", "values", "options"),
    [
        # What only cuts a line in two is free; beside the line it is open.
        (CUT, "3:Y", [20, 17.8, 20], KLARTEXT),
        (CUT, "3:Y", [17.8, 20], KLARTEXT),
        ("FL AN+0\nFL AN+0 X+50", "2:AN", [10, 0], KLARTEXT),
        ("FC DR- CCX+20 CCY+0 R20\nFC DR- CCX+20 CCY+0 R20 X+40 Y+0", "2:CCX", [19, 20, 21], KLARTEXT),
        ("FC DR- CCX+20 CCY+0 R20\nFCT DR- R20 X+40 Y+0", "2:R", [20, 19], KLARTEXT),
        ("FL LEN40 P1X+30 P1Y+10\nFSELECT 3\nFL X+80 Y+20", "FSELECT", [2.729, -3, 3, 1], KLARTEXT),
        ("G1 X40 Y20 #ANG=30", "#ANG", [30, 26.565, 31], {"control": "isg", "start": "X0 Y0"}),
        (
            "G17 G90 G42 G0 X14 Y-73\nG2 X-64 Y-190 I0 J-84\nG3 Q-77 R9.9 I25.5 J-81 X23.8 Y-71",
            "2:J",
            [-84, 0, 0.001],
            {"control": "nct-99m"},
        ),
    ],
)
def test_rows_of_several_kinds_are_what_a_single_solve_says(block, word, values, options):
    found = family(block, vary={word: values}, **options)
    for row, value in enumerate(values):
        answer = alone(block, {word: value}, **options)
        assert not difference({name: found[name][row] for name in found.columns}, answer)


@pytest.mark.parametrize(
    ("block", "word", "message"),
    [
        ("G1 X30 RNDM=5\nX40 Y40", "RNDM", r"with RNDM 0: nothing to solve"),
        (CUT, "2:Y", r"with Y of program line 2 0: one word is missing"),
    ],
)
def test_what_refuses_a_block_by_a_value_of_its_rows_alone_names_the_value(block, word, message):
    options = {"control": "siemens-840d", "start": "G17 X0 Y0"} if "RNDM" in block else KLARTEXT
    with pytest.raises(FamilyError, match=message):
        family(block, vary={word: [0]}, **options)


BENT = "G17 G90 G1 X10 Y0\nCT X20 Y5"


def test_a_range_goes_on_where_an_arc_turns_over():
    found = feasible(BENT, "2:Y", within=(-20, 20), **SINUMERIK)
    assert not found.is_complete
    # Between the arcs of both senses, of less than 1,000 m, it is a line.
    for value in (-20, -0.01, 0, 0.01, 20):
        assert value in found
    assert 5e-5 not in found
    assert 5e-5 not in feasible(BENT, "2:Y", within=(5e-6, 20), **SINUMERIK)


@pytest.mark.parametrize(("goal", "value"), [("C Y20", 20 - 300**0.5), ("C Y-20", 300**0.5 - 20)])
def test_a_value_is_found_on_either_side_of_where_an_arc_turns_over(goal, value):
    (hit,) = find(BENT, "2:Y", goal, within=(-9, 9), **SINUMERIK).hits
    assert hit.value == pytest.approx(value)


def test_derivatives_by_a_direction_that_is_handed_on_count_all_that_it_turns():
    block = "FL AN+30 LEN20\nFCT DR- R10 CCA+30\nFLT LEN15"
    slopes = sensitivity(block, **KLARTEXT).slopes
    assert set(slopes["P3 X"]) == {"AN", "1:LEN", "R", "CCA", "3:LEN"}
    step = 1e-3
    for word, (name, value) in {"CCA": ("2:CCA", 30), "AN": ("AN", 30), "R": ("R", 10)}.items():
        low, high = (alone(block, {name: value + way * step}, **KLARTEXT).contour for way in (-1, 1))
        for axis in (0, 1):
            rate = (high.end[axis] - low.end[axis]) / (2 * step)
            assert slopes[f"P3 {'XY'[axis]}"][word] == pytest.approx(rate, abs=1e-6)


@pytest.mark.parametrize("point", ["P3", "C2", "end"])
def test_tolerances_are_told_of_the_end_of_a_chain_and_of_centres(point):
    found = tolerances("FL AN+30 LEN20\nFCT DR- R10 CCA+30\nFLT LEN15", allowed={"R": 0.1}, point=point, **KLARTEXT)
    assert found.spread[0].worst == pytest.approx({"P3": 0.136603, "end": 0.136603, "C2": 0.05}[point], abs=1e-6)


def test_what_contours_rest_on_is_told_of_all_of_them():
    ready = family(HANDED_ON, vary={"2:CCA": [30, 90]}, **KLARTEXT)
    (answer,) = solve(HANDED_ON, **KLARTEXT).answers
    assert [each.name for each in ready.premises.assumptions] == [each.name for each in answer.assumptions]
    assert not ready.remark
    found = find(HANDED_ON, "2:CCA", "end X25", within=(10, 60), **KLARTEXT)
    assert "CCA counts from +X, counter-clockwise" in next(iter(rest_lines(found)))
    block, options = "G111 X100. A180. K-30. B120. C5.", {"start": "X40. Z0."}
    for found in (
        feasible(block, "C", **options),
        region(block, ("C", "A"), ((0, 5), (170, 190)), **options),
        tolerances(block, **options),
        family(block, vary={"C": [1, 2]}, settings={"yasnac-lx3.bevel": "length"}, **options),
    ):
        assert any("--setting yasnac-lx3.bevel=" in line for line in rest_lines(found))


def test_rows_that_are_read_one_by_one_are_told():
    found = family(TURNED, vary={"2:Y": [24, 30]}, **SINUMERIK)
    assert found.remark == "each value of Y of program line 2 decides how its row is read"


def test_a_range_over_all_that_is_searched_is_what_single_solves_say():
    """An arc turns over between the stated value and the limit of a rule at 0, far from both."""
    block = TURNED.rpartition("\n")[0]
    found = feasible(block, "2:Y", **SINUMERIK)
    assert not found.is_complete
    for value in (-500, -1.8, -1.7707, -1.7, 0, 20, 28.2658, 28.5, 29.95, 60, 900):
        is_inside = any(each.low.value <= value <= each.high.value for each in found.intervals)
        assert is_inside is (alone(block, {"2:Y": value}, **SINUMERIK).contour is not None), value
