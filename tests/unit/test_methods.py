"""Methods and attributes of records: what they give, and what they say where there is nothing to give."""

from importlib import import_module
from math import cos, pi, radians, sin
from pathlib import Path

import pytest
from examples import law
from hypothesis import assume, strategies as st

import contoursolve
from contoursolve import ContourSketch, SketchElement, Status
from contoursolve.geometry import Plane, Turn
from contoursolve.solving import ArcSegment, Contour, LineSegment

SHAFT = "G111 X100. A180. K-30. B120. P5. Q5."
TWICE = "G00 X40. Z0.\nG111 X100. A180. K-30. B120.\nG00 X40. Z0.\nG111 X100. A180. K-30. B120."
PLATE = "G17 G90 G0 X0 Y0\nG1 X30. Y0 ,R2.\nX30. Y20. ,R3.\nX0 Y20. ,C4.\nX0 Y0"
ARCS = "G17 G90 G0 X0 Y0\nG1 X20. Y0 ,R1.\nG2 X20. Y10. R8. ,R1.\nG3 X0 Y10. R40. ,R1.\nG1 X0 Y0"


def test_the_functions_of_rooms_above_are_there():
    """Each is looked up by its name when a method asks for it."""
    for name, room in contoursolve._ROOMS.items():
        assert callable(getattr(import_module(f"contoursolve.{room}"), name)), name


def test_the_answer_of_a_result_is_the_only_one():
    result = contoursolve.solve(SHAFT, start="X40. Z0.")
    assert result.answer is result.answers[0]
    with pytest.raises(ValueError, match=r"2 contours, which begin in program lines 2, 4; take one of result.answers"):
        _ = contoursolve.solve(TWICE).answer
    with pytest.raises(ValueError, match="the program has no contour"):
        _ = contoursolve.solve("G00 X2.", control="fanuc-lathe").answer


def test_an_answer_with_other_words_is_that_of_the_block_with_these_words():
    answer = contoursolve.solve(SHAFT, start="X40. Z0.").answer
    other = contoursolve.solve("G111 X100. A180. K-31. B120. Q5. D2.", start="X40. Z0.").answer
    again = answer.with_words(drop=["P"], change={"1:K": "K-31."}, add=["D2."])
    assert again.status is other.status
    assert again.contour == other.contour
    assert [each.code for each in again.diagnostics] == [each.code for each in other.diagnostics]
    with pytest.raises(ValueError, match="the blocks have no word Z; they have"):
        answer.with_words(change={"Z": "Z-1."})


def test_a_word_is_added_to_the_last_block_or_to_that_of_its_line():
    answer = contoursolve.solve(
        "FL AN+80 LEN50\nFCT DR- R15\nFLT X+90 Y+40", start="X+0 Y+0", control="heidenhain"
    ).answer
    shorter = answer.with_words(drop="LEN")
    assert shorter.status is contoursolve.Status.UNDERDETERMINED
    for added in ("1:LEN50", ["1:LEN50"]):
        assert shorter.with_words(add=added).contour == answer.contour
    with pytest.raises(ValueError, match="9:LEN50: the blocks of the contour are in program lines 1, 2, 3"):
        shorter.with_words(add="9:LEN50")


def test_a_chain_that_a_move_cuts_off_lacks_the_same_words():
    chain = "0 BEGIN PGM A MM\n1 L X+0 Y+0\n2 FL AN+80\n3 FL X+90 Y+40\n{}4 END PGM A MM"
    ended, cut = (contoursolve.solve(chain.format(more)).answer for more in ("", "L X+100 Y+0\n"))
    assert [each.code for each in cut.diagnostics] == ["words-missing", "heidenhain-block-illegal"]
    assert cut.missing == ended.missing
    assert ("AN",) in cut.missing


def test_a_contour_of_a_program_stands_alone_in_inches_too():
    result = contoursolve.solve("G20\nG00 X2. Z0.\nG111 X4. A180. K-1. B120. P.1\nG111 A180. W-1.")
    text = result.answers[0].standing_alone()
    alone = contoursolve.solve(text, control=result.control, units="inch").answer
    assert alone.contour.end == pytest.approx(result.answers[0].contour.end)


@pytest.mark.parametrize(
    ("text", "length", "area"),
    [(PLATE, 100 - 10 + 2.5 * pi - 8 + 32**0.5, 600 - (4 + 9) * (1 - pi / 4) - 8), (ARCS, None, None)],
)
def test_length_and_area_of_a_closed_contour(text, length, area):
    contour = contoursolve.solve(text, control="fanuc-mill").answer.contour
    if area is not None:
        assert contour.length == pytest.approx(length)
        assert contour.area == pytest.approx(area)
    points = contour.sample(1e-6)
    steps = list(zip(points, [*points[1:], points[0]], strict=True))
    assert contour.area == pytest.approx(abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in steps)) / 2, abs=1e-3)


@law(st.floats(-1e4, 1e4), st.floats(0.1, 1e3), st.floats(1, 359), st.sampled_from(Turn))
def test_a_circle_in_two_arcs_has_its_area_wherever_it_lies(at, radius, angle, turn):
    assume(radius * radians(min(angle, 360 - angle)) > 1e-3)
    start, other = (at + radius, at), (at + radius * cos(radians(angle)), at + radius * sin(radians(angle)))
    arcs = (
        ArcSegment("one", start, other, (at, at), radius, turn),
        ArcSegment("two", other, start, (at, at), radius, turn),
    )
    contour = Contour(start, start, {}, arcs, PLANE)
    assert contour.area == pytest.approx(pi * radius**2, rel=1e-6)
    assert contour.length == pytest.approx(2 * pi * radius, rel=1e-6)


PLANE = Plane("G17", ("X", "Y"), ("I", "J"), (False, False))


def test_an_open_contour_says_by_how_much():
    contour = contoursolve.solve(SHAFT, start="X40. Z0.").answer.contour
    with pytest.raises(ValueError, match=r"the contour is open: its end is 58\.\d+ mm from its start"):
        _ = contour.area


def test_start_and_end_are_points_that_no_list_has():
    contour = contoursolve.solve(SHAFT, start="X40. Z0.").answer.contour
    assert (contour.points["start"], contour.points["end"]) == (contour.start, contour.end)
    assert [*contour.points] == ["V1", "V2"]
    with pytest.raises(KeyError, match="no point V3; there are start, end, V1, V2"):
        _ = contour.points["V3"]


@pytest.mark.parametrize("text", [PLATE, ARCS])
def test_shapely_sees_the_same_contour(text):
    shapely = pytest.importorskip("shapely")
    contour = contoursolve.solve(text, control="fanuc-mill").answer.contour
    line = contour.to_shapely(chord_error=1e-5)
    assert line.length == pytest.approx(contour.length, abs=1e-3)
    assert shapely.Polygon(line).area == pytest.approx(contour.area, abs=1e-3)
    assert shapely.Polygon(line).is_valid


def test_a_line_has_no_area():
    there = (LineSegment("line 1", (0.0, 0.0), (3.0, 4.0)), LineSegment("line 2", (3.0, 4.0), (0.0, 0.0)))
    contour = Contour((0.0, 0.0), (0.0, 0.0), {}, there, PLANE)
    assert (contour.area, contour.length) == (0.0, 10.0)


def test_a_system_has_degrees_of_freedom_and_the_directions_in_which_nothing_holds_it():
    system = contoursolve.system("G111 X100. A180. K-30. B120. P5.", start="X40. Z0.")
    assert (system.dof, system.null_space.motions, system.conflicts, system.redundant) == (0, (), (), ())
    free = system.free("K")
    assert free.dof == free.null_space.dimension == 1
    assert all(each.simplify() == 0 for each in free.jacobian * free.null_space.exact)
    stated, conditions = system.of_word("B")
    assert [each.source.text for each in stated] == ["B120."]
    assert [str(each.expression) for each in conditions] == ["sin(B)"]


def test_ties_that_disagree_are_conflicts_and_the_others_are_redundant():
    block = "G111 A135. I10. K{}. B180. Z-40."
    wrong, right = (contoursolve.solve(block.format(k), start="X40. Z0.").answer.system for k in (-12, -10))
    assert [each.words for each in wrong.conflicts] == [("I10.", "K-12.", "A135.")]
    assert [each.words for each in right.redundant] == [("I10.", "K-10.", "A135.")]
    assert (wrong.redundant, right.conflicts) == ((), ())


def test_every_status_has_its_text():
    assert {each.text for each in Status} == {"solved", "not decided", "not enough given", "cannot be cut"}


def test_a_sketch_solves_itself_and_is_kept_in_a_file(tmp_path: Path):
    sketch = ContourSketch("milled", (SketchElement("line", {"X": 10, "Y": 5}),), {"X": 0, "Y": 0})
    assert sketch.solve().is_finished
    assert sketch.system().rank == 2
    for name in ("part.toml", "part.json"):
        sketch.save(tmp_path / name)
        assert contoursolve.read_sketch((tmp_path / name).read_text(encoding="utf-8")).solve().is_finished
    with pytest.raises(ValueError, match="takes an element"):
        ContourSketch("milled").system()


@pytest.mark.parametrize("begin", [10, -10])
@pytest.mark.parametrize(
    "lines",
    [
        ("X-6. Z-20.",),
        ("X4. Z-9. ,R0.5", "X-10. Z-20."),
        ("X-2. Z-9. ,R0.5", "X-12. Z-12. ,R0.5", "X8. Z-20. ,R0.5", "X-30. Z-25."),
        ("X2. Z-9. ,R0.5", "X12. Z-12. ,R0.5", "X-8. Z-20. ,R0.5", "X30. Z-25."),
    ],
)
def test_a_crossing_is_the_farthest_place_of_the_first_element_beyond_the_spindle_axis(begin: int, lines: tuple[str]):
    text = "\n".join((f"G00 X{begin}. Z0.", f"G01 X{begin / 2} Z-2. ,R0.5", *lines))
    (answer,) = contoursolve.solve(text, control="fanuc-lathe").answers
    ends = [(each.name, max(each.start, each.end, key=lambda at: -at[1] * begin)) for each in answer.contour.elements]
    beyond = [(at, name) for name, at in ends if at[1] * begin < 0]
    found = answer.contour.crossing
    assert (found and (found.at, found.element.name)) == (beyond[0] if beyond else None)
    assert ("axis-crossed" in {each.code for each in answer.diagnostics}) == bool(beyond)
