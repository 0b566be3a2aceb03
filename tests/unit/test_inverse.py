"""The inverse question: which values of a word bring a point where it is wanted."""

import json
from functools import partial
from itertools import pairwise
from random import Random

import calling
import numpy as np
import pytest
from generate_g111 import SHAPES, draw_g111
from generate_lx3 import random_g11, random_g112
from generate_nct import FORMS, random_chain, random_cornered, random_pair
from msgspec.structs import replace

import contoursolve
from contoursolve.families import FamilyError, Way, family, feasible, find, inverse, spec_of, tolerance_for

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."


def place_of(point, contour):
    """Where a point, or the begin, the end or the center of an element is; None where it is not there."""
    if point == "end":
        return contour.end
    name, _, place = point.partition(".")
    element = next((each for each in contour.elements if each.name == name), None)
    if place:
        return element and getattr(element, {"begin": "start"}.get(place, place))
    return contour.points.get(point)


def goal_of(point, answer, axes=(0, 1)):
    """Where a point is, as the control writes it."""
    at, in_mm = place_of(point, answer.contour), float(answer.unit.in_mm)
    words = (f"{answer.plane.axes[axis]}{at[axis] * (1 + answer.plane.diameters[axis]) / in_mm!r}" for axis in axes)
    return f"{point} {' '.join(words)}"


@pytest.mark.parametrize(("within", "turns"), [(None, [0]), ((-400, 400), [-1, 0]), ((-171, 188), [])])
def test_an_angle_that_is_asked_for_is_looked_for_in_its_range(within, turns):
    """The direction of 188.794 degrees is that of -171.206 degrees, too."""
    block, facts = "G111 X100. A180. K-30. B120. P?", ["straight part of line 2 = 20"]
    found = find(block, "A", "end Z-50.", start=START, facts=facts, within=within)
    assert [hit.value for hit in found.hits] == pytest.approx([188.79397 + 360 * each for each in turns], abs=1e-5)


def test_a_block_that_leaves_something_open_has_no_answer():
    with pytest.raises(FamilyError, match=r"radius of the rounding P\? is still open"):
        find("G111 X100. A180. K-30. B120. P?", "A", "end Z-50.", start=START)
    asked = find(BLOCK.replace("P5.", "P?"), "K", "end X300.", start=START, facts=["straight part of line 2 = 20"])
    assert (asked.hits, asked.remark.partition("; ")[0]) == ((), "K does not move end in this direction")
    with pytest.raises(FamilyError, match="no range"):
        find(BLOCK, "A", "end Z-50.", start=START, facts=["length of line 1 = 30"], within=(200, 100))


def test_a_value_at_an_end_is_rounded_to_the_side_with_a_contour():
    """The largest rounding is 51.96152 mm: written as 51.962 it would not fit."""
    hits = find(BLOCK.replace(" Q5.", ""), "P", "corner 1.begin Z9. X40.", start=START, within=(1, 60)).hits
    assert hits[0].value == pytest.approx(51.961524227)
    assert (hits[0].rounded, hits[0].rounded_away is not None) == (51.961, True)


@pytest.mark.parametrize(
    ("word", "goal", "message"),
    [
        ("A", "end", "no goal"),
        ("A", "end Y3", "the axes of this contour are Z and X"),
        ("A", "end Z3. Z4.", "twice"),
        ("A", "end Z3..4", "no number"),
        ("A", "V9 Z3.", "no point V9; there are end, V1, V2"),
        ("length of line 1", "end Z-50.", "no fact says what length of line 1 is"),
        ("A", "end Z-50", r"Z-50 has no decimal point.* reads it as -0.050 mm; write Z-50. for -50.000 mm, or Z-0.05"),
    ],
)
def test_a_goal_that_makes_no_sense_is_refused(word, goal, message):
    with pytest.raises(FamilyError, match=message):
        find(BLOCK, word, goal, start=START)


run = partial(calling.run, "find", "--block", BLOCK, "--start", START)


def test_the_status_of_the_command_says_whether_there_is_a_value():
    goals = ("end Z-50.", "end Z-50. X90.", "end Z900.", "nowhere")
    assert [run("--word", "A", "--goal", goal)[0] for goal in goals] == [0, 0, 1, 2]


def test_what_is_written_for_a_fact_and_for_the_start_point():
    (hit,) = find(BLOCK, "start.X", "end Z-60.", start=START).hits
    assert hit.block == "X6.077 Z0."
    again = contoursolve.solve(BLOCK, start=hit.block).answers[0].contour
    assert hit.rounded_away == pytest.approx(abs(again.end[0] + 60), abs=1e-12)
    block, facts = "G111 X100. A180. K-30. B120. P?", ["straight part of line 2 = 20"]
    (hit,) = find(block, "straight part of line 2", "corner 1.begin Z-20.", start=START, facts=facts).hits
    text, fact = hit.block.split("\n")
    again = contoursolve.solve(text, start=START, facts=[fact]).answers[0].contour
    assert abs(place_of("corner 1.begin", again)[0] + 20) == pytest.approx(hit.rounded_away, abs=1e-12)


# --- What was lost: values that exist, and a list that was called complete without them ---


@pytest.mark.parametrize("give", [1e-5, -1.0])
def test_a_value_that_single_solves_do_not_confirm_leaves_the_list_open(give, monkeypatch):
    """Whatever is dropped, the list says so."""
    isolate = inverse.isolate

    def worse(curve, low, high):
        found = isolate(curve, low, high)
        return replace(found, zeros=tuple(replace(zero, value=zero.value + give) for zero in found.zeros))

    monkeypatch.setattr(inverse, "isolate", worse)
    found = find(BLOCK, "A", "end Z-50.", start=START)
    assert (found.hits, found.is_complete) == ((), False)
    assert found.doubts[0].endswith("deg: there is a value, and single solves do not confirm it")
    _, output, _ = run("--word", "A", "--goal", "end Z-50.")
    assert "no value (at least; that these are all is not proven)" in output
    assert f"  not proven: {found.doubts[0]}" in output
    assert json.loads(run("--word", "A", "--goal", "end Z-50.", "--format", "json")[1])["doubts"] == [*found.doubts]


def g111_of(rng):
    """A sound block with any words and corners."""
    square = (rng.random() < 0.3, rng.random() < 0.3)
    case = draw_g111(rng, rng.choice(SHAPES), rng.randrange(4), rng.choice((1, -1)), square)
    if case is None or case.outcome.status != "solved":
        return g111_of(rng)
    start, block = case.program
    options = {"start": start.removeprefix("G00 ")}
    return block, options, contoursolve.solve(block, depth="verdict", **options).answers[0]


def drawn_of(rng):
    """A program of any other form, and chains."""
    corners = [rng.choice(("", "P", "C")), rng.choice(("", "Q", "D"))]
    drawn, control = rng.choice(
        (
            lambda: (random_g112(rng, rng.choice(("turning", "facing")), *corners), "yasnac-lx3"),
            lambda: (random_g11(rng), "yasnac-lx3"),
            lambda: (random_pair(rng, rng.choice(FORMS), rng.randrange(17, 20), rng.choice(("", "C", "R"))), "nct-99m"),
            lambda: (random_chain(rng, 2, rng.randrange(17, 20)), "nct-99m"),
            lambda: (random_cornered(rng, 17), "nct-99m"),
        )
    )()
    return drawn.text, {"control": control}, contoursolve.solve(drawn.text, control=control, depth="verdict").answers[0]


def crossings_of(block, options, name, goal, found):
    """The values that bisection of single solves finds between neighbours of a scan that the goal parts."""
    names = {"start": None, "control": None, "facts": (), "units": "mm", "rules": "enforce", "settings": None}
    template = spec_of(block, (name,), **(names | options)).template()

    def off(value):
        contour = template.solve({name: value}).contour
        return None if contour is None else contour.end[goal] - found.goal.place[goal]

    about = [found.stated + way * step for step in np.logspace(-4, 2, 13) for way in (-1, 1)]
    values = sorted({*np.linspace(*found.within, 61).tolist(), *map(float, about)})
    values = [value for value in values if found.within[0] <= value <= found.within[1]]
    known = [(value, away) for value in values if (away := off(value)) is not None]
    for first, last in pairwise(known):
        below, above = first, last
        while below[1] * above[1] < 0 and above[0] - below[0] > 1e-9 * max(1.0, abs(below[0])):
            middle = (below[0] + above[0]) / 2
            away = off(middle)
            if away is None:
                break
            below, above = ((middle, away), above) if away * below[1] > 0 else (below, (middle, away))
        else:
            if below[1] * above[1] < 0 and max(abs(below[1]), abs(above[1])) < 1e-3:
                yield below[0]


def ask_back(rng, scans):
    """A random sound block, asked by up to six of its words for the end that it has; how many questions that were."""
    block, options, answer = (g111_of if rng.random() < 0.85 else drawn_of)(rng)
    words, count = [*answer.claim.words.values()], 0
    words = rng.sample(words, min(6, len(words)))
    for axis in (0, 1):
        for word in words:
            name = f"{word.span.line}:{word.address}" if "\n" in block else word.address
            if name.endswith(":Q") and options.get("control") == "nct-99m":
                continue  # it only chooses between two places
            found = find(block, name, goal_of("end", answer, (axis,)), **options)
            if "does not move" in found.remark:
                continue
            count += 1
            own = found.stated
            has_own = any(abs(hit.value - own) <= 1e-6 * max(1, abs(own)) for hit in found.hits)
            assert has_own or found.doubts, (block, options, name, axis, found.hits)
            if found.is_complete and rng.random() < scans:
                for value in crossings_of(block, options, name, axis, found):
                    near = [hit for hit in found.hits if abs(hit.value - value) <= 1e-6 * max(1, abs(value))]
                    assert near, (block, options, name, axis, value, found.hits)
    return count


@pytest.mark.parametrize("seed", range(1, 13))
def test_asked_for_the_end_that_it_has_each_word_finds_its_own_value(seed):
    """Or the list is not called complete; one that is has every value that a scan of single solves brackets."""
    rng, asked = Random(seed), 0
    while asked < 2:
        asked += ask_back(rng, 0.03)


LATHE, NCT = {"start": START}, "G17 G90 G41 G0 X{} Y{}\n"
KEPT = [
    (BLOCK, LATHE, "A", "end", 0.5),
    (BLOCK, LATHE, "P", "corner 1.center X", 30.0),
    ("G111 A160. B120. I10. Z-60. P2. Q2.", LATHE, "A", "V1 Z", 0.02),
    ("G111 X4. A180. K-1.2 B120. P.2 Q.2", {"start": "X1.6 Z0.", "units": "inch"}, "A", "corner 1.end X", 0.001),
    (NCT.format(50, 0) + "G3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1", {}, ",A", "P1", 1.0),
    ("G112 X44. K-30. I2. R20.", LATHE, "R", "V2 Z", 0.1),
    (NCT.format(50, 0) + "G3 X-50 Y0 R50 ,R2\nG3 X-40 Y60 I-40 J20 R40 Q-1", {}, "2:R", "P1 X", 3.0),
    (
        NCT.format(90, 10) + "G1 ,A150 ,R2\nG1 X10 Y20 ,A225 Q1 ,C2\nG3 X-40 Y-20 I-20 J-20 R20 Q1",
        *({}, "3:,A", "corner 2.end X", 0.05),
    ),
]


@pytest.mark.parametrize(("block", "options", "word", "keep", "within"), KEPT)
def test_a_result_stays_near_between_the_ends_of_a_tolerance_and_not_beyond(block, options, word, keep, within):
    """Every value of a fine grid, solved by itself as a family: the ends are where the result has moved, or is lost."""
    found = tolerance_for(block, word, keep=keep, within=within, **options)
    assert found.is_complete
    point, _, letter = keep.rpartition(" ") if keep[-2:-1] == " " else (keep, "", "")
    answer = contoursolve.solve(block, depth="verdict", **options).answers[0]
    letters, in_mm = answer.plane.axes, float(answer.unit.in_mm)
    point = "corner 2.end" if point == "end" else point
    width = max(found.plus, found.minus)
    edges = [
        found.low.value,
        found.stated,
        found.high.value,
        found.low.value - width / 50,
        found.high.value + width / 50,
    ]
    values = np.unique([*np.linspace(found.low.value, found.high.value, 801), *edges])
    grid = family(block, vary={word: values}, **options)
    here = np.flatnonzero(values == found.stated)[0]
    factors = [1 if letter else 1 + each for each in answer.plane.diameters]
    columns = [
        (grid[f"{point} {axis}"], each) for axis, each in zip(letters, factors, strict=True) if letter in ("", axis)
    ]
    off = [(column - column[here]) / each for column, each in columns]
    moved = np.hypot.reduce([*off, np.zeros(values.size)]) / in_mm
    inside = (values > found.low.value) & (values < found.high.value)
    assert (moved[inside] <= within * (1 + 1e-9)).all()
    for end, number in ((found.low, 0), (found.high, -1)):
        assert end.is_verified
        at = moved[np.flatnonzero(values == end.value)[0]]
        if end.way is Way.MOVED:
            assert at == pytest.approx(within, abs=1e-9)
        else:
            assert (end.reason is not None) is not (end.way is Way.RANGE)
        assert not moved[number] <= within or end.way is Way.RANGE
    assert Way.MOVED in (found.low.way, found.high.way)
    if found.low.way is found.high.way:
        assert found.linear == pytest.approx(min(found.plus, found.minus), rel=0.5)


def test_a_word_of_one_of_several_contours_has_a_tolerance_of_its_own():
    program = f"G00 X40. Z0.\n{BLOCK}\nG01 Z-100.\nG111 X140. A180. Z-130. B120. P5.\nG00 X200."
    alone = tolerance_for("G111 X140. A180. Z-130. B120. P5.", "A", keep="V1 Z", within=0.01, start="X100. Z-100.")
    found = tolerance_for(program, "4:A", keep="V1 Z", within=0.01)
    assert (found.low.value, found.high.value) == (alone.low.value, alone.high.value)
    assert (found.is_complete, found.linear) == (True, alone.linear)
    one, two = (feasible(*each).intervals[0] for each in ((program, "2:P"), (f"G00 {START}\n{BLOCK}", "P")))
    assert (one.low.value, one.high.value) == (two.low.value, two.high.value)
    with pytest.raises(FamilyError, match=r"2 contours \(program lines 2, 4\); a family is about one: name a word"):
        tolerance_for(program, "1:X", keep="V1 Z", within=0.01)


def test_places_of_elements_are_those_of_the_points_and_corners_that_end_them():
    block, options = "G01 Z-30. ,R5.\nX60. ,A150.\nZ-80.", {"start": START, "control": "fanuc-lathe"}
    for one, other in (
        ("line 2.end Z", "N2 Z"),
        ("Z of begin of corner 1", "corner 1.begin Z"),
        ("end.z", "Z of end of line 2"),
    ):
        found = [tolerance_for(block, ",A", keep=each, within=0.01, **options) for each in (one, other)]
        assert (found[0].low.value, found[0].high.value) == (found[1].low.value, found[1].high.value)
        assert found[0].is_complete
    room = tolerance_for(block, ",A", keep="line 2.room", within=0.01, **options)
    assert room.kept == "straight part of line 2"
    # At 179 degrees a rounding is left out: what jumps there is no value in doubt.
    assert find(block, ",A", "corner 1.end Z-40.", **options).is_complete
    with pytest.raises(FamilyError, match="the block has no word A; write ,A"):
        tolerance_for(block, "A", keep="N2 Z", within=0.01, **options)


ASKED, STRAIGHT = "G111 X100. A180. K-30. B120. P?", ["straight part of line 2 = 20"]


@pytest.mark.parametrize(
    ("block", "facts", "word", "keep", "within", "unit"),
    [
        (BLOCK, [], "A", "length of line 2", 0.01, "mm"),
        (BLOCK, [], "K", "length of line 1", 0.5, "mm"),
        (BLOCK, [], "B", "direction of line 2", 0.1, "deg"),
        (ASKED, STRAIGHT, "X", "P", 0.1, "mm"),
        (ASKED.replace("X100.", "X?").replace("P?", "P5."), STRAIGHT, "B", "X", 0.2, "mm"),
    ],
)
def test_lengths_and_directions_are_kept_as_facts_name_them(block, facts, word, keep, within, unit):
    """At both ends the value, asked for by itself, is off by just so much, as it is written."""
    found = tolerance_for(block, word, keep=keep, within=within, start=START, facts=facts)
    assert found.kept_unit == unit
    values = []
    for value in (found.stated, found.low.value, found.high.value):
        text = block.replace(f"{word}{found.stated:g}.", f"{word}{value!r}")
        more = [*facts, f"{keep} = ?"] if " of " in keep else facts
        (*_, asked) = contoursolve.solve(text, start=START, facts=more).answers[0].asked
        values.append(asked.value * (1 + asked.question.is_diameter))
    assert [abs(each - values[0]) for each in values[1:]] == pytest.approx([within] * 2, abs=1e-8)
    assert found.low.value < found.stated < found.high.value


def test_a_word_that_is_not_asked_for_is_no_result():
    with pytest.raises(FamilyError, match=r"there is no result Q; the results are end Z"):
        tolerance_for(ASKED, "X", keep="Q", within=1, start=START, facts=STRAIGHT)


@pytest.mark.parametrize(
    ("word", "keep", "within", "told"),
    [
        ("A", "end Z", 0, "within is how far end Z may move, a number above 0, not 0"),
        ("A", "V9 Z", 1, "there is no result V9 Z; did you mean V2 Z or V1 Z? the results are end Z, end X"),
        ("A", "end Y", 1, "there is no result end Y; the axes of this contour are Z and X"),
        ("W", "end Z", 1, "the block has no word W"),
        ("A", "length of line 9", 1, "expected an element (line 1, line 2, corner 1, corner 2), found `line 9`"),
    ],
)
def test_what_has_no_tolerance_says_why(word, keep, within, told):
    with pytest.raises(FamilyError) as caught:
        tolerance_for(BLOCK, word, keep=keep, within=within, start=START)
    assert (told in str(caught.value), "\n" in str(caught.value)) == (True, False)
    with pytest.raises(FamilyError, match="as it stands, the block has no contour to keep: "):
        tolerance_for(BLOCK.replace("P5.", "P80."), "A", keep="end Z", within=1, start=START)


def test_a_range_of_a_free_contour_is_not_lost_where_roots_end():
    """Places without any contour are most of what is looked at: that a length is zero there says nothing."""
    chain = "FL X+10 Y+0\nFCT DR+ R5\nFLT X+30 Y+20"
    found = feasible(chain, "R", start="X0 Y0", control="heidenhain")
    (only,) = found.intervals
    assert (only.low.value, only.high.value) == (0.001, pytest.approx(20, abs=1e-6))
