"""The oracles held against the sheets' worked numbers, against drawings, and against searches that know no formula."""

from cmath import pi
from collections import Counter
from itertools import pairwise, product
from math import cos, radians, sin, tan
from random import Random

import numpy
import pytest
from generate_lx3 import FORMS as LATHE_FORMS, random_g11, random_g112
from generate_nct import FORMS, disturbed, draw_path, random_chain, random_cornered, random_pair
from oracle import PLANES, Element, Outcome, _RefusedError as Refused, circle_line, cross, dot
from oracle_corners import Corner, ahead, connect, gap, length, miss, stretch
from oracle_lx3 import contours, g11, g12, g112
from oracle_nct import runs

CLOSE = 1e-9
"""mm."""

PAIRS = tuple(product(("line", "arc"), repeat=2))


def cornered(path: list[Element], kind: str, amount: float) -> list[Element]:
    """The path with its only corner; empty if it does not fit."""
    outcome = Outcome()
    try:
        connect(path, {0: Corner(kind, amount)}, outcome)
    except Refused:
        return []
    return outcome.elements


def distance(element: Element, at: complex) -> float:
    """From the element's whole line or circle."""
    if element.center is None:
        return abs(cross(ahead(element, element.start), at - element.start))
    return abs(abs(at - element.center) - element.radius)


def grown(path: list[Element], radius: float, steps: int = 60) -> complex:
    """Where the centre of a fillet has come to that grew from nothing in the corner: Newton's method on distances."""
    at = path[0].end
    u, v = ahead(path[0], at), ahead(path[1], at)
    first = radius / steps / 50
    center = at + 2 * first * (v - u) / (abs(v - u) * abs(v + u))
    for size in numpy.geomspace(first, radius, steps):
        for _ in range(20):
            miss_by = numpy.array([distance(element, center) - size for element in path])
            slopes = []
            for element in path:
                across = center - (element.center or 0)
                if element.center is None:
                    along = ahead(element, element.start)
                    slope = 1j * along * numpy.sign(cross(along, center - element.start))
                else:
                    slope = across / abs(across) * numpy.sign(abs(across) - element.radius)
                slopes.append([slope.real, slope.imag])
            center -= complex(*numpy.linalg.solve(numpy.array(slopes), miss_by))
            if max(abs(miss_by)) < 1e-13 * max(1, size):
                break
    return center


@pytest.mark.parametrize("kinds", PAIRS)
def test_a_fillet_is_the_one_that_grows_out_of_its_corner(kinds):
    rng = Random(81)
    made = 0
    for _ in range(600):
        path = draw_path(rng, kinds)
        pieces = cornered(path, "R", rng.uniform(0.3, 40))
        if not pieces:
            continue
        before, fillet, after = pieces
        made += 1
        assert fillet.center is not None
        for cut, whole, touch in ((before, path[0], fillet.start), (after, path[1], fillet.end)):
            assert distance(whole, fillet.center) == pytest.approx(fillet.radius, abs=CLOSE)
            assert distance(whole, touch) < CLOSE
            assert abs(abs(touch - fillet.center) - fillet.radius) < CLOSE
            assert abs(ahead(whole, touch) - ahead(fillet, touch)) < 1e-8
            assert 0 <= length(cut) < length(whole)
        turn = cross(ahead(path[0], path[0].end), ahead(path[1], path[1].start))
        assert fillet.turn == ("ccw" if turn > 0 else "cw")
        if made % 10 == 0:
            assert abs(grown(path, fillet.radius) - fillet.center) < 1e-7
    assert made > 200


@pytest.mark.parametrize("kinds", PAIRS)
def test_the_largest_fillet_uses_an_element_up_or_has_nowhere_to_grow(kinds):
    rng = Random(3084)
    reasons: Counter[str] = Counter()
    for _ in range(150):
        path = draw_path(rng, kinds)
        low, high = 0.0, 1e5
        for _ in range(70):
            size = (low + high) / 2
            low, high = (size, high) if cornered(path, "R", size) else (low, size)
        if low > 99_999:
            reasons["no largest one"] += 1
            assert "line" not in kinds
            continue
        before, fillet, after = cornered(path, "R", low * (1 - 1e-9))
        assert fillet.center is not None
        normals = [(touch - fillet.center) / fillet.radius for touch in (fillet.start, fillet.end)]
        if min(length(before), length(after)) < 1e-5:
            reasons["an element is used up"] += 1
        else:
            # Both curves, moved by the radius, touch: seen from the centre the elements are opposite each other.
            assert abs(normals[0] + normals[1]) < 1e-3
            reasons["nowhere to grow"] += 1
    assert reasons["an element is used up"] > 30
    assert ("arc" in kinds) == (reasons["nowhere to grow"] > 0)


@pytest.mark.parametrize("kinds", PAIRS)
def test_a_chamfer_ends_as_far_from_the_corner_on_both_elements(kinds):
    rng = Random(10)
    made = 0
    for _ in range(600):
        path, amount = draw_path(rng, kinds), rng.uniform(0.3, 40)
        pieces = cornered(path, "C", amount)
        if not pieces:
            # The straight distance from the corner to an element's far end decides, or a diameter.
            reach = [abs(path[0].start - path[0].end), abs(path[1].end - path[1].start)]
            for k, element in enumerate(path):
                if element.center is not None and length(element) > pi * element.radius:
                    reach[k] = 2 * element.radius
            assert min(reach) < amount
            continue
        made += 1
        before, chamfer, after = pieces
        for cut, whole, end in ((before, path[0], chamfer.start), (after, path[1], chamfer.end)):
            assert abs(end - path[0].end) == pytest.approx(amount, abs=CLOSE)
            assert distance(whole, end) < CLOSE
            assert length(cut) + stretch(whole, *((end, whole.end) if whole is path[0] else (whole.start, end))) == (
                pytest.approx(length(whole), abs=CLOSE)
            )
    assert made > 200


# NCT --------------------------------------------------------------------------------------------------

LINES = "G17 G90 G41 D0", "G0 X90 Y10"
TO_CIRCLE = "N10 G17 G42 G0 X100 Y20 D0 S200 M3", "N20 G1 X-30 Y-20"
FROM_CIRCLE = "N10 G17 G0 X90 Y0 M3 S200", "N20 G42 G1 X50 D0", "N30 G3 X-50 Y0 R50"


@pytest.mark.parametrize(
    ("program", "crossing", "end"),
    [
        ((*LINES, "N10 G1 ,A150", "N20 X10 Y20 ,A225"), 32.9423 + 42.9423j, 10 + 20j),
        ((*LINES, "N10 G1 X50 Y33.094", "N20 X10 Y20 ,A225"), 32.9423 + 42.9423j, 10 + 20j),
        ((*TO_CIRCLE, "N30 G3 X20 Y40 I20 J-10 R50 Q-1", "N40 G40 G0 Y60"), 66.0216 + 9.5451j, 20 + 40j),
        ((*TO_CIRCLE, "N30 G3 X20 Y40 I20 J-10 R50 Q1", "N40 G40 G0 Y60"), -29.0486 - 19.7073j, 20 + 40j),
        ((*FROM_CIRCLE, "N40 G1 X-50 Y42.857 ,A171.87 Q-1"), 39.99998 + 30.00002j, -50 + 42.857j),
        ((*FROM_CIRCLE, "N40 G1 X-50 Y42.857 ,A171.87 Q1"), -30.00012 + 39.99991j, -50 + 42.857j),
    ],
)
def test_intersections_of_the_sheet_come_out(program, crossing, end):
    (run,) = runs(program)
    assert run.status == "solved"
    assert abs(run.points["P1"] - crossing) < 8e-5
    assert run.end == end


@pytest.mark.parametrize(
    ("program", "begin", "end"),
    [
        (("N1 G1 G91 X30 ,C10", "N2 X10 Y40"), 20, 32.4254 + 9.7014j),
        (("N1 G91 G01 X30 ,R8", "N2 G03 X-30 Y30 R30"), 20.4939, 27.9462 + 10.9091j),
    ],
)
def test_corners_of_the_sheet_come_out(program, begin, end):
    (run,) = runs(("G17 G0 X0 Y0", *program))
    assert [abs(run.elements[1].start - begin) < 8e-5, abs(run.elements[1].end - end) < 8e-5] == [True, True]


def assert_same(drawn, found):
    assert found.status == "solved", drawn.text
    assert not found.is_near, drawn.text
    assert gap(found.elements, drawn.elements) < CLOSE, drawn.text
    assert found.points.keys() == drawn.points.keys()
    assert all(abs(found.points[name] - at) < CLOSE for name, at in drawn.points.items()), drawn.text


@pytest.mark.parametrize("times", [1, 5])
def test_every_drawn_run_is_read_back_from_its_text(times):
    rng = Random(16)
    drawings = [
        random_pair(rng, form, plane, corner)
        for form, plane, corner in product(FORMS, PLANES, ("", "C", "R"))
        for _ in range(6 * times)
    ]
    drawings += [random_chain(rng, 1 + k % 20, plane) for plane in PLANES for k in range(40 * times)]
    drawings += [random_cornered(rng, plane) for plane in PLANES for _ in range(60 * times)]
    covered: Counter[str] = Counter()
    for drawn in drawings:
        (found,) = runs(drawn.program)
        assert_same(drawn, found)
        covered.update(drawn.kind)
    for kind in (
        *("line by ,A", "line by a point", "line by a point G91", "line to end ,R G91"),
        *("arc by its center", "arc by R+", "arc by R- G91", "arc by center and point", "arc by center and point G91"),
        *("over-defined line", "over-defined line Q-", "over-defined line Q+ G91", "over-defined line ,C"),
        *("over-defined arc Q-", "over-defined arc Q+", "over-defined arc Q+ ,R", "over-defined arc Q- ,C G91"),
        *("line by one coordinate and ,A", "line by one coordinate and ,A ,C G91"),
    ):
        assert covered[kind] >= 2 * times, kind


def test_the_drawings_of_one_seed_are_the_same_bytes():
    assert random_chain(Random(5), 9, 18) == random_chain(Random(5), 9, 18)
    assert random_g112(Random(5), "facing", "P", "D") == random_g112(Random(5), "facing", "P", "D")


def test_both_oracles_of_a_circle_and_a_line_agree():
    rng = Random(129)
    for _ in range(300):
        plane = rng.choice(tuple(PLANES))
        drawn = random_pair(rng, "circle-line", plane)
        blocks = [words_of(line) for line in drawn.program[1:]]
        is_incremental = drawn.kind[0].endswith("G91")
        turn = drawn.elements[0].turn
        other = circle_line(plane, drawn.start, turn, *blocks, is_incremental=is_incremental)
        assert gap(other.elements, drawn.elements) < CLOSE


def words_of(line: str) -> dict[str, float]:
    return {word.rstrip("0123456789.-"): float(word.lstrip(",ABCDIJKQRXYZ")) for word in line.split() if word[0] != "G"}


START = "G17 G90 G41 G0 X0 Y0 D0"


@pytest.mark.parametrize(
    ("blocks", "status"),
    [
        (("G1 ,A0", "X20 Y20 ,A90"), "solved"),
        (("G1 ,A0", "X20 Y20 ,A-90"), "no-solution"),  # it would move against its angle
        (("G1 ,A180", "X20 Y20 ,A90"), "no-solution"),
        (("G1 ,A90", "X20 Y20 ,A90"), "no-solution"),  # parallel
        (("G1 ,A45", "X20 Y20 ,A45"), "underdetermined"),  # the same line
        (("G1 ,A0", "X20 Y-20 ,A90", "X50 Y50 ,A0"), "solved"),  # a given point behind the start of its line
        (("G1 ,A0", "X20 Y20 ,A90", "X10 Y50 ,A0"), "no-solution"),
        (("G1 ,A0", "X20 Y20 ,A90", "X50 Y-50 ,A0"), "no-solution"),
        (("G40 G1 ,A0", "X20 Y20 ,A90"), "rejected"),
        (("G1 ,A0 ,C2 ,R2", "X20 Y20 ,A90"), "rejected"),
        (("G1 ,A0 ,C2", "X20 Y20 ,A90 ,C2"), "rejected"),
        (("G1 ,A0 ,C2", "G0 X20 Y20"), "rejected"),
        (("G1 ,A0 ,R21", "X20 Y20 ,A90"), "no-solution"),
        (("G1 ,A0 ,R20", "X20 Y20 ,A90"), "solved"),
        (("G1 X50 Y0", "G3 X40 Y10 I30 J10 R10 Q-1"), "solved"),
        (("G1 X50 Y5", "G3 X40 Y10 I30 J10 R10 Q0"), "rejected"),
        (("G1 X50 Y5", "G3 X40 Y10 I30 J10 R10"), "rejected"),
        (("G1 X50 Y-5", "G3 X40 Y10 I30 J10 R10 Q1"), "no-solution"),  # the line misses the circle
        (("G1 X50 Y5", "G3 X41 Y10 I30 J10 R10 Q1"), "conflicting"),
        (("G3 X0 Y20 R10", "G2 X100 Y20 I80 J20 R20 Q-1"), "no-solution"),  # circles apart
    ],
)
def test_what_the_sheet_refuses_is_refused(blocks, status):
    assert [run.status for run in runs((START, *blocks))] == [status]


# LX3 --------------------------------------------------------------------------------------------------


def test_the_arc_of_the_sheet_is_a_hollow_with_two_fillets():
    (found,) = contours(("G01 X100. Z-50.;", "G112 U0 I10. K-50. P5. Q5. R30.;"))
    assert [element.turn for element in found.elements] == ["", "ccw", "cw", "ccw"]
    ends = [-68.3772 + 50j, -72.8948 + 47.1429j, -127.1052 + 47.1429j, -131.6228 + 50j]
    assert [element.end for element in found.elements] == pytest.approx(ends, abs=8e-5)


def test_the_arc_of_the_sheet_has_two_bevels():
    (found,) = contours(("G01 X100. Z-50.;", "G112 U0 I10. K-50. C5. D5. R30.;"))
    assert [element.turn for element in found.elements] == ["", "", "cw", ""]
    ends = [-69.0192 + 50j, -74.0192 + 45j, -125.9808 + 45j, -130.9808 + 50j]
    assert [element.end for element in found.elements] == pytest.approx(ends, abs=8e-5)


def test_the_bevels_of_the_sheet_end_as_its_drawing_says():
    found = contours(("G00 X30. Z0;", "G11 Z-20. I8. F30;", "X80. K-7.;"))
    assert [element.end for each in found for element in each.elements] == [-12 + 15j, -20 + 23j, -20 + 33j, -27 + 40j]


@pytest.mark.parametrize("count", [45, 120])
def test_every_drawn_arc_with_corners_is_read_back_from_its_text(count):
    rng = Random(112)
    covered: Counter[tuple[str, ...]] = Counter()
    for form, one, two in product(LATHE_FORMS, ("", "P", "C"), ("", "Q", "D")):
        for _ in range(count):
            drawn = random_g112(rng, form, one, two)
            (found,) = contours(drawn.program)
            assert_same(drawn, found)
            assert_goes_on(found.elements, form)
            covered[drawn.kind] += 1
    assert len(covered) == 2 * 2 * 2 * 2 * 9


def assert_goes_on(elements: list[Element], form: str) -> None:
    """The path never backs up along line 1, and a rounding leaves no edge."""
    axis = 1 if form == "turning" else 1j
    line = elements[0]
    onward = axis * numpy.sign(dot(axis, line.end - line.start))
    for element in elements:
        for part in numpy.linspace(0, 1, 9):
            at = element.start + part * (element.end - element.start)
            if element.center is not None:
                swept = part * length(element) / element.radius * (1 if element.turn == "ccw" else -1)
                at = element.center + (element.start - element.center) * complex(cos(swept), sin(swept))
            assert dot(onward, ahead(element, at)) > -1e-9
    for before, after in pairwise(elements):
        assert before.end == after.start
        if after.kind == before.kind == "arc":
            assert abs(ahead(before, before.end) - ahead(after, after.start)) < 1e-9


@pytest.mark.parametrize(
    ("words", "status"),
    [
        ("U0 I10. K-50. R30.", "solved"),
        ("U0 I-10. K-50. R30.", "solved"),
        ("U60. I10. K-50. R30.", "no-solution"),  # lands on the other side of the centre
        ("U0 I0 K-50. R30.", "near"),  # neither side is chosen
        ("U-20. I0 K-50. R30.", "solved"),
        ("U0 I31. K-50. R30.", "no-solution"),
        ("U-100. I10. K-50. R30.", "no-solution"),
        ("U0 I10. K-28. R30.", "no-solution"),  # it starts within the circle
        ("U0 I10. K0 R30.", "no-solution"),
        ("U0 I28. K-50. R30. C5.", "no-solution"),  # flatter than 45 degrees
        ("U0 I10. K-50. R30. P5. C5.", "rejected"),
        ("U0 W0 I10. K-50. R30.", "rejected"),
        ("I10. K-50. R30.", "rejected"),
        ("U0 I10. K-50.", "rejected"),
        ("U0 I10. K-50. R-30.", "rejected"),
        ("U0 I10. K-50. R30. Q200.", "solved"),  # outside a circle a fillet has no largest radius
        ("U0 I10. K-50. R30. D25.", "no-solution"),  # deeper than the hollow
        ("U0 I10. K-30. R30. P5.", "no-solution"),  # line 1 is too short for it
    ],
)
def test_what_g112_cannot_make_is_refused(words, status):
    (found,) = contours(("G00 X100. Z-50.", f"G112 {words}"))
    assert ("near" if found.is_near else found.status) == status


def test_every_drawn_bevel_and_quarter_circle_is_read_back_from_its_text():
    rng = Random(11)
    kinds: Counter[str] = Counter()
    for _ in range(300):
        drawn = random_g11(rng, 4)
        found = contours(drawn.program)
        assert [each.status for each in found] == ["solved"] * 4
        assert gap([element for each in found for element in each.elements], drawn.elements) < CLOSE, drawn.text
        kinds.update(drawn.kind)
    assert len(kinds) == 3 * 4


@pytest.mark.parametrize(
    ("words", "status"),
    [
        ({"U": 20, "K": 10}, "solved"),
        ({"U": 20, "K": 10.001}, "no-solution"),
        ({"W": -5, "I": 5.001}, "no-solution"),
        ({"W": -5, "I": 0}, "rejected"),
        ({"W": -5}, "rejected"),
        ({"W": -5, "K": 2}, "rejected"),
        ({"W": -5, "U": 5, "K": 2}, "rejected"),
    ],
)
def test_limits_of_a_bevel_are_those_of_a_quarter_circle(words, status):
    assert g11(20j, words).status == g12(20j, words).status == status


def test_whatever_a_word_says_a_path_that_is_solved_has_no_gap_and_stays_on_its_circles():
    rng = Random(9)
    drawings = [random_pair(rng, rng.choice(FORMS), 17, rng.choice(("", "C", "R"))) for _ in range(600)]
    drawings += [random_chain(rng, rng.randint(2, 5), 18) for _ in range(400)]
    drawings += [random_cornered(rng, 19) for _ in range(400)]
    drawings += [random_g112(rng, rng.choice(LATHE_FORMS), "P", "D") for _ in range(400)]
    statuses: Counter[str] = Counter()
    for drawn in drawings:
        program = disturbed(rng, drawn)
        for found in (contours if "G112" in program[-1] else runs)(program):
            statuses[found.status] += 1
            if found.status == "solved":
                assert abs(found.elements[0].start - drawn.start) < CLOSE
                assert found.elements[-1].end == found.end
            for before, after in pairwise(found.elements):
                assert before.end == after.start
            for element in found.elements:
                if element.center is not None:
                    for at in (element.start, element.end):
                        assert abs(abs(at - element.center) - element.radius) <= 0.01 + CLOSE, program
    assert min(statuses[status] for status in ("solved", "no-solution", "conflicting", "rejected")) > 30


def test_the_gap_to_a_contour_in_json_sees_every_number():
    (found,) = contours(("G01 X100. Z-50.;", "G112 U0 I10. K-50. P5. Q5. R30.;"))

    def pair(at: complex) -> list[float]:
        return [at.real, at.imag]

    elements = []
    for element in found.elements:
        shown = {"kind": element.kind, "start": pair(element.start), "end": pair(element.end)}
        if element.center is not None:
            shown |= {"center": pair(element.center), "radius": element.radius, "turn": element.turn}
        elements.append(shown)
    points = {name: pair(at) for name, at in found.points.items()}
    contour = {"start": [-50, 50], "end": pair(found.end), "points": points, "elements": elements}
    assert miss(found.elements, found.points, contour) == 0
    elements[1]["center"][0] += 0.25
    assert miss(found.elements, found.points, contour) == 0.25
    elements[1]["turn"] = "cw"
    assert miss(found.elements, found.points, contour) == float("inf")


def test_a_fillet_between_lines_takes_what_trigonometry_says():
    words = {"X": 60, "I": -10, "K": -40, "R": 30}
    assert g112(complex(0, 30), words | {"P": 0}).elements == g112(complex(0, 30), words).elements
    for turn in (30, 90, 150):
        path = [Element("line", -500, 0), Element("line", 0, 500 * complex(cos(radians(turn)), sin(radians(turn))))]
        before, *_ = cornered(path, "R", 10)
        assert 500 - length(before) == pytest.approx(10 * tan(radians(turn) / 2))
