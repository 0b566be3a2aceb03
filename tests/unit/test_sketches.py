"""What is known of a sketch: states, what is missing, guesses, contradictions; each through the public door."""

import json
import re
from decimal import Decimal
from math import dist, radians, tan
from pathlib import Path

import pytest
from msgspec.structs import replace

import contoursolve

EXAMPLES = Path(__file__).parents[1] / "sketches"

ENDS = {
    "turned_shaft": ("line 3", (-49.4142, 39.4142)),
    "turned_ball": ("arc 1", (-36.0, 12.0)),
    "turned_taper_by_length": ("line 2", (-25 - (22.5**2 - 8**2) ** 0.5, 23.0)),
    "turned_recess_inch": ("line 5", (-63.5, 25.4)),
    "milled_plate": ("line 4", (0.0, 30 + 40 / 3**0.5)),
    "milled_distances": ("line 4", (11.0041, 60.0)),
    "milled_slot": ("arc 2", (40.0, 6.0)),
    "milled_chord": ("arc 2", (44.9071, 13.3333)),
    "fk_cam": ("arc 2", (28.2528, 60.8475)),
    "fk_two_circles": ("arc 3", (98.0, -5.0)),
    "guessed_length": ("line 2", ((40**2 - 25**2) ** 0.5 + 20, 25.0)),
    "guessed_meeting": ("line 1", (-35 + (20**2 - 10**2) ** 0.5, 15.0)),
}


def sketch(name: str) -> contoursolve.ContourSketch:
    return contoursolve.read_sketch((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"))


def changed(whole: contoursolve.ContourSketch, number: int, **fields: object) -> contoursolve.ContourSketch:
    """A sketch with other fields of an element; None takes one away."""
    element = whole.elements[number - 1]
    own = {name: fields.pop(name) for name in tuple(fields) if name in element.__struct_fields__}
    words = {name: value for name, value in {**element.words, **fields}.items() if value is not None}
    elements = list(whole.elements)
    elements[number - 1] = replace(element, words={n: Decimal(str(v)) for n, v in words.items()}, **own)
    return replace(whole, elements=tuple(elements))


def states(found) -> dict[str, str]:
    return {each.name: each.state.value for each in found.elements}


def test_an_end_may_be_as_far_as_another_line():
    lines = [{"X": 60, "Y": 10}, {"AN": 90, "LEN": 20}, {"AN": 180, "X": 30}, {"AN": -80}]
    elements = [contoursolve.SketchElement("line", {n: Decimal(v) for n, v in each.items()}) for each in lines]
    elements[-1] = replace(elements[-1], facts=("end of line 4 lies on line 1",))
    found = contoursolve.ContourSketch("milled", tuple(elements), {"X": 0, "Y": 0}).solve()
    x, y = found.elements[-1].segment.end
    assert y == pytest.approx(x / 6)
    assert (30 - y) / (x - 30) == pytest.approx(tan(radians(80)))


@pytest.mark.parametrize(
    ("name", "number", "fields", "status", "code", "wrong", "off"),
    [
        ("turned_shaft", 3, {"LEN": 30}, "conflicting", "words-conflict", {"line 3"}, 30 - 20 * 2**0.5),
        ("turned_shaft", 3, {"corner": contoursolve.SketchCorner("rounding", Decimal(60))}, "no-solution",
         "corner-too-large", {"corner 3"}, 60 - 10 / tan(radians(22.5))),
        ("fk_two_circles", 3, {"X": 98, "Y": 0}, "conflicting", "fact-conflict", {"arc 3"}, 5.0),
        ("guessed_meeting", 2, {"R": 3}, "no-solution", "no-point", {"line 1", "arc 2"}, None),
        ("milled_slot", 2, {"R": 7}, "conflicting", None, None, 1.0),
        ("fk_cam", 2, {"turn": None}, "rejected", None, set(), None),
        ("milled_distances", 4, {"P1Y": None}, "rejected", "drawing-point-1", set(), None),
        ("milled_plate", 2, {"facts": ("chord of line 9 = 3",)}, "rejected", "fact-unreadable", set(), None),
        ("milled_plate", 2, {"facts": ("chord of line 2 = 3",)}, "rejected", "fact-impossible", set(), None),
        ("milled_distances", 3, {"PAR": 7}, "rejected", "drawing-block-missing", set(), None),
        ("turned_ball", 1, {"PR": 7}, "rejected", "drawing-pole-missing", set(), None),
    ],
)  # fmt: skip
def test_a_contradiction_is_told_with_its_amount(name, number, fields, status, code, wrong, off):
    found = changed(sketch(name), number, **fields).solve()
    assert found.status == status
    assert not found.is_finished
    assert code is None or any(each.code == code and each.fields for each in found.findings)
    contradicting = {each.name: each.off_mm for each in found.elements if each.state.value == "contradicting"}
    assert wrong is None or {*contradicting} == wrong
    if off is not None:
        assert off == pytest.approx(max(each or 0 for each in contradicting.values()), abs=1e-3)
    assert not any("program line" in each.message + each.help for each in found.findings)
    if found.answer is not None:
        shown = re.sub("<desc>.*?</desc>", "", contoursolve.draw(found).svg)
        measured = [each for each in found.elements if each.segment is not None and each.off_mm is not None]
        assert bool(re.search(r">off\b", shown)) == bool(measured)


def test_fixes_are_changes_of_fields():
    found = changed(sketch("turned_shaft"), 3, LEN=30).solve(with_ranges=True)
    fixes = [fix for each in found.findings for fix in each.fixes]
    assert len(fixes) > 2
    for fix in fixes:
        elements = [fix.elements.get(number, each) for number, each in enumerate(found.sketch.elements, 1)]
        assert replace(found.sketch, elements=tuple(elements)).solve().is_finished


def test_ways_and_entries_of_what_is_missing():
    found = changed(sketch("turned_shaft"), 3, X=None).solve(with_ranges=True)
    assert found.missing == "one entry is missing: Z, X, LEN, IZ or IX of line 3, or X, LEN or IZ of line 4"
    sliding = {name for name, state in states(found).items() if state == "sliding"}
    assert sliding == {"line 3", "corner 3", "line 4"}
    assert {state for name, state in states(found).items() if name not in sliding} == {"known"}
    (way,) = next(each.ways for each in found.elements if each.name == "line 3")
    # Along its direction, and no way back behind its begin.
    assert all(x - 20 == pytest.approx(-30 - z) and z <= -30 for z, x in way)
    entries = {(each.number, each.field): each for each in found.entries}
    assert [(each.low, each.high) for each in entries[3, "X"].ranges] == [("41.172", "98.343")]
    assert all(each.example for each in found.entries)
    for each in found.entries:
        assert changed(found.sketch, each.number, **{each.field: each.example}).solve().is_finished


@pytest.mark.parametrize("name", [name for name in sorted(ENDS) if name.startswith("guessed") or "ball" in name])
def test_a_guess_chooses_and_is_no_dimension(name):
    bare = sketch(name)
    bare = replace(bare, elements=tuple(replace(each, guess={}) for each in bare.elements))
    found = bare.solve()
    assert found.status == "ambiguous"
    assert len(found.solutions) == 2
    for number, solution in enumerate(found.solutions):
        element, place = solution.guess
        again = changed(bare, element, guess=place).solve()
        assert [each.is_chosen for each in again.solutions] == [n == number for n in range(2)]
        assert again.program == found.program
        assert [each.segment for each in again.elements] == [
            next((each for each in solution.segments if each.name == part.name), None) for part in again.elements
        ]
    equal = changed(sketch("guessed_length"), 1, guess={"X": Decimal(0)}).solve()
    assert equal.remarks == ("two contours are equally near to the guess: put it nearer to one of them",)
    unused = sketch("milled_chord").solve()
    assert unused.remarks == ("the guess is not used: what is given has one solution",)


@pytest.mark.parametrize(
    ("name", "count"), [(name, 1 + place) for name in ENDS for place, _ in enumerate(sketch(name).elements[:5])]
)
def test_every_state_of_typing_has_an_answer(name, count):
    whole = sketch(name)
    *before, last = whole.elements[:count]
    for number in range(len(last.words) + 1):
        words = dict([*last.words.items()][:number])
        found = replace(whole, elements=(*before, replace(last, words=words))).solve()
        assert found.is_finished or found.missing or found.findings
        assert [each.name.partition(" ")[0] for each in found.elements if "corner" not in each.name] == [
            each.kind for each in (*before, last)
        ]


@pytest.mark.parametrize("name", ENDS)
def test_a_sketch_without_elements_or_a_start_says_so(name):
    whole = sketch(name)
    assert replace(whole, elements=()).solve().elements == ()
    assert replace(whole, start={}).solve().missing.startswith("where it begins is missing")


@pytest.mark.parametrize(
    ("name", "fields", "roles"),
    [
        ("turned_shaft", {"X": None}, {"sliding": "s-free", "known": "s-ink"}),
        ("turned_shaft", {"LEN": 30}, {"contradicting": "s-conflicting"}),
        ("guessed_length", {}, {"guessed": "s-guessed"}),
    ],
)
def test_a_page_is_told_all_as_plain_data(name, fields, roles):
    whole = changed(sketch(name), 3, **fields) if fields else sketch(name)
    view, found = contoursolve.editing.sketch_view(whole), whole.solve()
    assert json.loads(json.dumps(view)) == view
    assert [each["state"] for each in view["elements"]] == [each.state.value for each in found.elements]
    assert roles.keys() <= {*states(found).values()}
    assert all(f'class="{role}"' in view["picture"]["svg"] for role in roles.values())
    assert 'data-element="line 1"' in view["picture"]["svg"]


SEVERAL = """sketch = 1
part = "milled"
start = { X = 0, Y = 0 }
[[element]]
kind = "line"
AN = 0
LEN = 30
[[element]]
kind = "line"
LEN = 40
IY = 25
[[element]]
kind = "line"
AN = 0
LEN = 20
[[element]]
kind = "line"
LEN = 40
Y = 60
"""


def test_all_contours_that_fit_are_drawn_by_name_and_only_what_they_share_has_dimensions():
    found = contoursolve.read_sketch(SEVERAL).solve()
    texts = re.findall(r"<text[^>]*>(.*?)</text>", contoursolve.draw(found).svg, re.DOTALL)
    shown = [re.sub(r"<[^>]*>", "", each) for each in texts]
    step, last = (40**2 - 25**2) ** 0.5, (40**2 - 35**2) ** 0.5
    ends = [50 + one * step + other * last for one in (1, -1) for other in (1, -1)]
    places = [f"  X{Decimal(f'{end:.4f}').normalize():f} Y60" for end in ends]
    named = [f"contour {number}{place}" for number, place in enumerate(places, 1)]
    assert [each.name for each in found.solutions] == ["contour 1", "contour 2", "contour 3", "contour 4"]
    assert set(named) <= {*shown}
    # LEN20, LEN40 and the end lie elsewhere in each contour.
    assert {"AN0", "LEN30", "IY25", "Y60"} <= {*shown}
    assert shown.count("AN0") == 1
    assert not [each for each in shown if each.startswith(("LEN20", "LEN40", "end", "FSELECT"))]
    chosen = contoursolve.read_sketch(SEVERAL + "guess = { X = 40 }")
    svg = contoursolve.draw(chosen.solve()).svg
    assert [f"contour {number}" in svg for number in (1, 2, 3, 4)] == [True, True, False, True]
    assert "LEN20" in svg


def test_what_an_arc_lacks_is_no_error_and_names_the_arc():
    plain = contoursolve.read_sketch(SEVERAL)
    arcs = tuple(contoursolve.SketchElement("arc", {}) for _ in range(2))
    found = replace(plain, elements=(*plain.elements[:1], *arcs)).solve()
    assert found.missing == "the sense of arc 2 and arc 3 is missing: clockwise or counter-clockwise"
    assert [(each.number, each.field) for each in found.entries] == [(2, "turn"), (3, "turn")]
    assert not [each for each in found.findings if each.severity.value == "error"]
    assert found.elements[0].state.value == "known"
    turned = states(changed(sketch("fk_cam"), 2, turn=None).solve())
    assert [name for name, state in turned.items() if state == "known"] == ["line 1", "corner 4", "line 5"]


@pytest.mark.parametrize(
    ("name", "count"), [("milled_chord", 1), ("milled_distances", 1), ("guessed_length", 0), ("turned_ball", 1)]
)
def test_the_gap_of_a_closed_contour_is_that_of_the_open_one(name, count):
    given = sketch(name)
    bare = replace(given, elements=tuple(replace(each, guess={}) for each in given.elements))
    open_, found = bare.solve(), replace(bare, closed=True).solve()
    gaps = [each.off_mm for each in found.findings if (0, "closed") in each.fields]
    paths = [each.segments for each in open_.solutions] or [open_.answer.contour.elements]
    ends = {round(dist(each[0].start, each[-1].end), 6) for each in paths}
    # Where the contours that fit end in several places, none of these is told.
    assert gaps == [pytest.approx(each) for each in ends if len(ends) == 1]
    assert len(gaps) == count


def test_fixes_tell_no_place_that_they_leave_where_it_is():
    found = changed(sketch("turned_shaft"), 2, Z=-30, X=40, AN=170).solve(with_ranges=True)
    titles = [fix.title for each in found.findings for fix in each.fixes]
    assert "delete AN170" in titles
    assert any(" -> " in each for each in titles)
    assert not any("-> the corner between line 1 and line 2 is at Z0.000 mm X40.000 mm" in each for each in titles)
