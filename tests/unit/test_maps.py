"""Maps over two words: each line of equal value is where single solves have that value, and a map that answers to a
pointer tells what single solves say.
"""

import json
import re
from html import unescape
from html.parser import HTMLParser

import numpy
import pytest

import contoursolve
from contoursolve.pictures import Theme, draw_family_map, draw_region
from contoursolve.pictures.page import Stroke, Text
from contoursolve.pictures.theme import LEVELS

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
CHAIN = """\
G17 G41 D0 G0 X-30 Y60
G1 ,A180 ,R3
G3 X-85 Y50 I-60 J50 R25 Q-1
G1 X-75 Y0 ,A-90 Q1"""
CHAMFER = "G17 G0 X0 Y0\nG1 X40 Y0 ,C3\nG1 X60 Y30"
BOXES = {
    "a taper": (BLOCK, {"A": (150.0, 210.0), "P": (1.0, 60.0)}, {"start": START}),
    "a chain with a boss": (CHAIN, {"2:,A": (120.0, 200.0), ",R": (1.0, 20.0)}, {}),
    "a chamfer": (CHAMFER, {"3:X": (30.0, 80.0), ",C": (0.5, 40.0)}, {"control": "nct-99m"}),
    "a question": (
        "G111 X100. A180. K-30. B120. P?",
        {"A": (150.0, 210.0), "straight part of line 2": (1.0, 40.0)},
        {"start": START, "facts": ["straight part of line 2 = 20"]},
    ),
}


def family_of(name, count=25):
    block, box, options = BOXES[name]
    return contoursolve.family(
        block, vary={word: numpy.linspace(*ends, count) for word, ends in box.items()}, **options
    )


def solved_alone(family, values):
    return family.spec.template().solve(dict(zip(family.ranges.values, map(float, values), strict=True))).contour


@pytest.mark.parametrize("name", BOXES)
def test_the_length_and_the_end_of_each_row_are_those_of_its_contour(name):
    family = family_of(name, 5)
    axes = list(family.ranges.values.values())
    length, ends = family.result("length"), [family.result(f"end.{axis}") for axis in plane_axes(family)]
    assert family.has_contour.any()
    for row in numpy.ndindex(*family.shape):
        contour = solved_alone(family, [axis[place] for axis, place in zip(axes, row, strict=True)])
        assert (contour is None) == numpy.isnan(length[row])
        if contour is not None:
            assert length[row] == pytest.approx(sum(each.length for each in contour.elements), abs=1e-9)
            assert [each[row] for each in ends] == pytest.approx(contour.end, abs=1e-9)


def plane_axes(family):
    return [name.removeprefix("end.") for name in family.results if name.startswith("end.")]


SHOWN = (("a taper", "line 1.room"), ("a chain with a boss", "length"), ("a question", "asked.P"))


@pytest.mark.slow
@pytest.mark.parametrize(("name", "result"), SHOWN)
def test_a_line_of_equal_value_runs_where_single_solves_have_its_value(name, result):
    block, box, options = BOXES[name]
    words = tuple(box)
    region = contoursolve.region(block, words, tuple(box.values()), **options)
    picture = draw_region(region, result=result)
    lines = [each for each in picture.sheet.drawing if isinstance(each, Stroke) and each.width == 1.2 and each.steps]
    texts = {each.words: each.at for each in picture.sheet.drawing if isinstance(each, Text)}
    assert f"{words[0]} and {words[1]}: {result} [mm" in picture.title
    labels = {float(told): at for told, at in texts.items() if re.fullmatch(r"-?\d+(\.\d+)?", told) and on_plane(at)}
    assert len(labels) >= 2
    checked = 0
    for level, (x, y) in labels.items():
        # The value stands on its line: where its middle is, single solves have it, but for the width of a cell.
        here = values_at((x, y - 4.0), box)
        around = [values_at((x + right, y - 4.0 + down), box) for right in (-4, 0, 4) for down in (-4, 0, 4)]
        found = [alone(region, words, each, result) for each in (here, *around)]
        assert min(found) <= level <= max(found)
        checked += 1
    assert checked == len(labels)
    assert len(lines) >= len(labels)


def on_plane(at):
    return 92 < at[0] < 702 and 56 < at[1] < 456


def values_at(spot, box):
    (a, b), (c, d) = box.values()
    return a + (b - a) * (spot[0] - 92) / 610, c + (d - c) * (456 - spot[1]) / 400


def alone(region, words, values, result):
    vary = dict(zip(words, ([each] for each in values), strict=True))
    spec = region.spec
    family = contoursolve.family(spec.block, vary=vary, start=spec.start, facts=spec.facts)
    return float(family.result(result).item())


def test_a_map_of_a_result_says_what_it_shows_and_only_then_has_its_colours():
    family = family_of("a taper", 40)
    shown = draw_family_map(family, result="v2.z", theme=Theme.PAGE)
    assert "V2.Z [mm]: " in shown.title
    assert "level-8" in shown.svg
    assert not any(role.value in draw_family_map(family, theme=Theme.PAGE).svg for role in LEVELS)
    told = [each.words for each in shown.sheet.texts]
    low, high = numpy.nanmin(family.result("V2.Z")), numpy.nanmax(family.result("V2.Z"))
    (remark,) = [each for each in told if each.startswith("V2.Z [mm]: from")]
    assert [float(each) for each in re.findall(r"-?\d+\.\d+", remark)[:2]] == pytest.approx([low, high], abs=0.01)
    assert "solved" not in told
    fixed = draw_family_map(family, result="V1.Z")
    assert "V1.Z [mm]: -30.000 wherever there is a contour" in [each.words for each in fixed.sheet.texts]
    assert "V2.X [mm, radius]" in draw_family_map(family, result="V2.X").title


def test_each_solution_of_a_row_has_its_results_and_its_map():
    free = CHAIN.replace("Q-1", "").replace("Q1", "")
    vary = {"2:,A": numpy.linspace(150, 200, 5), ",R": numpy.linspace(1, 9, 4)}
    family = contoursolve.family(free, vary=vary, branches="all")
    lengths = family.result("length")
    assert lengths.shape == (5, 4, len(family.solutions))
    chosen = contoursolve.family(CHAIN, vary=vary).result("length")
    is_made = numpy.isfinite(chosen)
    assert is_made.any()
    assert numpy.nanmin(numpy.abs(lengths - chosen[..., None])[is_made], axis=1).max() < 1e-9
    for place, name in enumerate(family.solutions):
        own = family.solution(name)
        assert numpy.array_equal(own.result("length"), lengths[..., place], equal_nan=True)
        assert "length [mm]" in draw_family_map(own, result="length").title
        with pytest.raises(ValueError, match="write the word that chooses"):
            contoursolve.explore_map(own)


def test_an_unknown_result_is_refused_with_those_that_are_like_it():
    family = family_of("a taper", 4)
    for wrong, said in (
        ("V3.Z", "there is no result V3.Z; did you mean V2.Z or V1.Z? the results are end.Z, "),
        ("lenght", "did you mean length?"),
        ("status", "there is no result status"),
        (" ", "a result has a name"),
    ):
        with pytest.raises(contoursolve.FamilyError, match=re.escape(said)):
            draw_family_map(family, result=wrong)
    with pytest.raises(contoursolve.FamilyError, match="take 2 or more"):
        contoursolve.region(BLOCK, ("A", "P"), ((170, 190), (1, 9)), start=START).family(1, 5)


# Maps that answer.


class Scripts(HTMLParser):
    """The scripts of a page, each with its attributes, and the names of all elements."""

    def __init__(self, text):
        super().__init__()
        self.scripts, self.kinds = [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.kinds.append(tag)
        if tag == "script":
            self.scripts.append([dict(attrs), ""])

    def handle_data(self, data):
        if self.kinds[-1] == "script":
            self.scripts[-1][1] += data


def data_of(page):
    (attributes, text), _ = Scripts(page).scripts
    assert attributes == {"type": "application/json"}
    return json.loads(text)


@pytest.mark.slow
@pytest.mark.parametrize("name", BOXES)
def test_each_frame_of_a_page_is_what_a_single_solve_says(name):
    family = family_of(name, 13)
    page = contoursolve.map_page(family, "length")
    assert page == contoursolve.map_page(family, "length")
    data = data_of(page)
    assert data["note"] == "This page holds the contours of all 169 values of the map."
    for axis, values in zip(data["axes"], family.ranges.values.values(), strict=True):
        assert axis == pytest.approx(values, rel=1e-9)
    places = [(one, two) for one in data["axes"][0] for two in data["axes"][1]]
    for frame, place in zip(data["frames"], places, strict=True):
        contour = solved_alone(family, place)
        assert isinstance(frame, int) == (contour is None)
        if contour is not None:
            text, path = frame
            assert float(re.search(r"length ([\d.]+) mm", text)[1]) == pytest.approx(
                sum(each.length for each in contour.elements), abs=0.001
            )
            first, second = (float(each) for each in re.findall(r"-?[\d.]+", path)[-2:])
            assert (first, -second) == pytest.approx(contour.end, abs=0.05)
            assert path.count("L") + path.count("A") == len(contour.elements)


def test_a_page_asks_no_other_host_and_lets_nothing_out_of_its_texts():
    block = "G111 X100. A180. K-30. B120. P5. (</script><script>stolen=1</script><img src=x onerror=y>)"
    vary = {"A": [170, 180, 190], "P": [2, 5]}
    page = contoursolve.map_page(contoursolve.family(block, start=START, vary=vary), version="1")
    shown = contoursolve.explore_map(contoursolve.family(block, start=START, vary=vary))._repr_mimebundle_()[0]
    for text in (page, shown["text/html"]):
        found = Scripts(text)
        assert len(found.scripts) == 2
        assert found.kinds.count("img") == (text is not page)  # the picture for whoever has no scripts
        assert "stolen" not in "".join(told for _, told in found.scripts)
        assert set(re.findall(r"https?://[^\"' )]+", text)) <= {"http://www.w3.org/2000/svg"}
    assert "default-src 'none'" in unescape(page)


@pytest.mark.slow
def test_a_map_of_long_contours_holds_fewer_of_them():
    steps = "\n".join(f"G1 X{number} Y{number % 2} ,R0.1" for number in range(1, 40))
    chain = f"G17 G0 X0 Y0\n{steps}\nG1 X70 Y30"
    vary = {"2:,R": numpy.linspace(0.01, 0.2, 60), "41:Y": numpy.linspace(20, 40, 60)}
    data = data_of(contoursolve.map_page(contoursolve.family(chain, control="nct-99m", vary=vary)))
    assert len(json.dumps(data["frames"])) <= 400_000
    assert 20 <= len(data["frames"]) < 1000
    assert f"of {len(data['columns'])} by {len(data['rows'])} values, the map has 60 by 60" in data["note"]


@pytest.mark.slow
@pytest.mark.parametrize("name", BOXES)
def test_a_click_opens_the_block_with_these_values_in_the_explorer(name):
    _, box, _ = BOXES[name]
    shown = contoursolve.explore_map(family_of(name, 7))
    low, high = ([ends[number] for ends in box.values()] for number in (0, 1))
    heard = []
    shown.observe(lambda change: heard.append(change["new"]), "text")
    for share in (0.5, 0.7):
        values = [one + share * (two - one) for one, two in zip(low, high, strict=True)]
        shown.place = {"values": values, "number": 1, "is_open": True}
        alone = solved_alone(family_of(name, 3), values)
        assert shown.seen["is_open"]
        assert bool(shown.seen["path"]) == (alone is not None)
        if alone is not None:
            assert shown.answer.contour.end == pytest.approx(alone.end, abs=1e-9)
            assert shown.seen["text"].startswith(f"solved, end {contoursolve.end_text(shown.answer)}")
        else:
            assert shown.seen["text"] in [each.message for each in shown.answer.diagnostics]
    assert heard
    assert heard[-1] == shown.text
    for wrong in ({"values": ["x", 1]}, {"values": [1]}, {}, {"values": [1e300, 1]}):
        before = shown.text
        shown.place = {"number": 2, "is_open": True, **wrong}
        assert shown.text == before
        assert shown.seen["text"]
        assert not shown.seen["path"]


def test_a_map_is_of_a_family_over_two_words_or_of_a_region():
    one = contoursolve.family(BLOCK, start=START, vary={"A": [170, 180]})
    for wrong, error, said in (
        (one, ValueError, "a grid of two words"),
        (contoursolve.solve(BLOCK, start=START), TypeError, "not of Result"),
    ):
        with pytest.raises(error, match=said):
            contoursolve.map_page(wrong)
        with pytest.raises(error, match=said):
            contoursolve.explore_map(wrong)
    with pytest.raises(contoursolve.FamilyError, match="did you mean length"):
        contoursolve.explore_map(family_of("a taper", 3), "lenth")
