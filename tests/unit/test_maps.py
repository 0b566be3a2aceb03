"""Pictures of families: maps, regions, ranges, fans and axes of matplotlib show what single solves say, and so does a
map that answers to a pointer."""

import json
import random
import re
import sys
from html import unescape
from html.parser import HTMLParser
from math import hypot
from pathlib import Path

import numpy
import pytest
from click.testing import CliRunner
from test_pictures import check, labels, strokes

import contoursolve
from contoursolve.cli import main
from contoursolve.diagnosis import statuses_text
from contoursolve.output import map_page
from contoursolve.output.map_frames import MOST_BYTES, MOST_FRAMES
from contoursolve.pictures import (
    LEVELS,
    Role,
    Theme,
    draw_family_fan,
    draw_family_map,
    draw_range,
    draw_region,
    draw_sweep,
)
from contoursolve.pictures.overview import compose_fan
from contoursolve.pictures.page import Dot
from contoursolve.pictures.scene import Mark
from contoursolve.solving import Status

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
CHAIN = """\
G17 G41 D0 G0 X-30 Y60
G1 ,A180 ,R3
G3 X-85 Y50 I-60 J50 R25 Q-1
G1 X-75 Y0 ,A-90 Q1"""
CIRCLE_LINE = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"
BOXES = {
    "a taper": (BLOCK, {"A": (150.0, 210.0), "P": (1.0, 60.0)}, {"start": START}),
    "two angles": (BLOCK, {"A": (91.0, 269.0), "B": (90.0, 200.0)}, {"start": START}),
    "a rule": (BLOCK, {"P": (-10.0, 60.0), "Q": (-10.0, 60.0)}, {"start": START}),
    "a circle": (CIRCLE_LINE, {"R": (40.0, 80.0), ",A": (150.0, 179.0)}, {}),
    "a chain with a boss": (CHAIN, {"2:,A": (120.0, 200.0), ",R": (1.0, 20.0)}, {}),
    "a chamfer": (
        "G17 G0 X0 Y0\nG1 X40 Y0 ,C3\nG1 X60 Y30",
        {"3:X": (30.0, 80.0), ",C": (0.5, 40.0)},
        {"control": "nct-99m"},
    ),
    "a question": (
        "G111 X100. A180. K-30. B120. P?",
        {"A": (150.0, 210.0), "straight part of line 2": (1.0, 40.0)},
        {"start": START, "facts": ["straight part of line 2 = 20"]},
    ),
}
"""Blocks, two words with their ends, and options."""
REGIONS = ("a taper", "two angles", "a rule", "a circle")
PAGES = ("a taper", "a chain with a boss", "a chamfer", "a question")


def family_of(name, *counts):
    block, box, options = BOXES[name]
    vary = {word: numpy.linspace(*ends, count) for (word, ends), count in zip(box.items(), counts, strict=True)}
    return contoursolve.family(block, vary=vary, **options)


def region_of(name):
    block, box, options = BOXES[name]
    return contoursolve.ranges(block, tuple(box), tuple(box.values()), **options)


def solved_alone(family, values):
    return family.spec.template().solve(dict(zip(family.ranges.values, map(float, values), strict=True))).contour


# Results ----------------------------------------------------------------------------------------------------------


def test_an_unknown_result_is_refused_with_those_that_are_like_it():
    family = family_of("a taper", 4, 3)
    for wrong, said in (
        ("V3 Z", "there is no result V3 Z; did you mean V2 Z or V1 Z? the results are end Z, "),
        ("lenght", "did you mean length?"),
        ("status", "there is no result status"),
        (" ", "the results are end Z, end X, V1 Z"),
    ):
        for ask in (draw_family_map, contoursolve.explore):
            with pytest.raises(contoursolve.errors.FamilyError, match=re.escape(said)):
                ask(family, result=wrong)
    with pytest.raises(contoursolve.errors.FamilyError, match="take 2 or more"):
        contoursolve.ranges(BLOCK, ("A", "P"), ((170, 190), (1, 9)), start=START).family(1, 5)


# Maps -------------------------------------------------------------------------------------------------------------


def spot_of(values, within):
    """Where two values are on a page whose plane covers a box: 610 by 400 pixels from (92, 56)."""
    across, up = ((value - low) / (high - low) for value, (low, high) in zip(values, within, strict=True))
    return 92 + 610 * across, 56 + 400 * (1 - up)


def values_at(spots, box):
    (a, b), (c, d) = box.values()
    return [a + (b - a) * (spots[..., 0] - 92) / 610, c + (d - c) * (456 - spots[..., 1]) / 400]


def solved_at(name, spots):
    """The family at places of a page whose plane covers the box."""
    block, box, options = BOXES[name]
    values = [each.ravel() for each in values_at(numpy.asarray(spots), box)]
    return contoursolve.family(block, vary=dict(zip(box, values, strict=True)), paired=True, **options)


def lines_of(picture):
    """The borders of a map or a region, as places on the page a pixel apart."""
    return [dense(numpy.array([each.start, *each.steps])) for each in strokes(picture.sheet.drawing) if each.width == 3]


def dense(line):
    steps = numpy.concatenate([[0], numpy.cumsum(numpy.hypot(*numpy.diff(line, axis=0).T))])
    along = numpy.linspace(0, steps[-1], int(steps[-1]) + 2)
    return numpy.stack([numpy.interp(along, steps, line[:, axis]) for axis in (0, 1)], axis=1)


@pytest.mark.parametrize("name", ["a taper", "a chain with a boss", "a question"])
def test_a_line_of_equal_value_runs_where_single_solves_have_its_value(name):
    result = {"a taper": "straight part of line 1", "a chain with a boss": "length", "a question": "asked.P"}[name]
    _, box, _ = BOXES[name]
    picture = draw_region(region_of(name), result=result)
    one, two = box
    assert f"{one} and {two}: {result} [mm" in picture.title
    inside = [text for text in picture.sheet.texts if 92 < text.at[0] < 702 and 56 < text.at[1] < 456]
    told = {float(text.words): text.at for text in inside if re.fullmatch(r"-?\d+(\.\d+)?", text.words)}
    # A narrow area without a contour has its number.
    told = {level: at for level, at in told.items() if solved_at(name, [[at]]).has_contour.all()}
    assert len(told) >= 2
    assert len([each for each in strokes(picture.sheet.drawing) if each.width == 1.2]) >= len(told)
    # The value stands on its line: where its middle is, single solves have it, but for the width of a cell.
    around = [[(x + right, y - 4 + down) for right in (-4, 0, 4) for down in (-4, 0, 4)] for x, y in told.values()]
    found = solved_at(name, around).result(result).reshape(len(told), 9)
    for level, values in zip(told, found, strict=True):
        assert min(values) <= level <= max(values)


def test_a_map_of_a_result_says_what_it_shows_and_only_then_has_its_colours():
    family = family_of("a taper", 24, 20)
    shown = draw_family_map(family, result="v2.z", theme=Theme.PAGE)
    assert "V2 Z [mm]: " in shown.title
    assert "level-8" in shown.svg
    assert not any(role.value in draw_family_map(family, theme=Theme.PAGE).svg for role in LEVELS)
    (remark,) = [each for each in labels(shown) if each.startswith("V2 Z [mm]: from")]
    low, high = numpy.nanmin(family.result("V2 Z")), numpy.nanmax(family.result("V2 Z"))
    assert [float(each) for each in re.findall(r"-?\d+\.\d+", remark)[:2]] == pytest.approx([low, high], abs=0.01)
    assert "solved" not in labels(shown)
    fixed = draw_family_map(family, result="V1 Z")
    assert "V1 Z [mm]: -30.000 wherever there is a contour" in labels(fixed)
    assert "V2 X [mm, diameter]" in draw_family_map(family, result="V2 X").title


@pytest.mark.parametrize("name", REGIONS)
def test_the_lines_of_a_map_part_values_that_have_a_contour_from_those_that_have_none(name):
    block, box, options = BOXES[name]
    family = family_of(name, 41, 31)
    picture = draw_family_map(family)
    check(picture)
    spots = numpy.concatenate(lines_of(picture))
    # The middles of the outer cells are half a cell from the frame.
    (one, first), (two, second) = family.ranges.values.items()
    halves = [(axis[1] - axis[0]) / 2 for axis in (first, second)]
    whole = [(low - half, high + half) for half, (low, high) in zip(halves, box.values(), strict=True)]
    # Where cells beside each other are not alike, a line runs where the contour begins to exist between their middles.
    rows, columns = numpy.nonzero(family.has_contour[:-1] != family.has_contour[1:])
    fine = first[rows, None] + (first[1] - first[0]) * numpy.linspace(0, 1, 65)
    vary = {one: fine.ravel(), two: numpy.repeat(second[columns], fine.shape[1])}
    is_solved = contoursolve.family(block, vary=vary, paired=True, **options).has_contour.reshape(fine.shape)
    for values, solved, column in zip(fine, is_solved, columns, strict=True):
        edges = values[:-1][solved[1:] != solved[:-1]]
        nearest = min(numpy.hypot(*(spots - spot_of((edge, second[column]), whole)).T).min() for edge in edges)
        assert nearest < 2.5, (edges, second[column])


@pytest.mark.parametrize("name", REGIONS)
def test_the_fields_of_a_region_are_painted_as_single_solves_tell_and_none_has_the_name_of_another(name):
    found = region_of(name)
    for theme in (Theme.LIGHT, Theme.PAGE):
        picture = draw_region(found, theme=theme)
        check(picture)
    lines = lines_of(picture)
    assert len(lines) == len(found.boundaries)
    told = " ".join(labels(picture))
    assert all(word in told for each in found.boundaries for word in each.reason.text.split())
    draw = random.Random(3)
    spots = numpy.array([(draw.uniform(92, 702), draw.uniform(56, 456)) for _ in range(300)])
    # The lines cover what is next to them.
    spots = numpy.array([spot for spot in spots if numpy.hypot(*(numpy.concatenate(lines) - spot).T).min() > 2.5])
    for (x, y), is_solved in zip(spots, solved_at(name, spots).has_contour, strict=True):
        (*_, role) = [
            r for left, top, right, bottom, r in fields_of(picture) if left <= x <= right and top <= y <= bottom
        ]
        assert (role is Role.SOLVED_FIELD) == is_solved, (x, y)
    assert_names_stand_in_their_fields(picture, name)


def fields_of(picture):
    """The fields of a map or a region, with what each is painted as."""
    shapes = (each for each in picture.sheet.drawing if hasattr(each, "corners") and "field" in each.role.value)
    return [(*shape.corners[0], *shape.corners[2], shape.role) for shape in shapes]


_BESIDE = 12


def assert_names_stand_in_their_fields(picture, name):
    """No text in the plane of a page covers a place with a contour but `solved`, and what the block has."""
    boxes = [(text, text.box) for text in picture.sheet.texts]
    inside = [(text, box) for text, box in boxes if box[0] > 92 and box[2] < 702 and box[1] > 56 and box[3] < 456]
    assert inside
    for text, (left, top, right, bottom) in inside:
        # An area that is too narrow for its number is beside it.
        more = _BESIDE if text.words.isdigit() else 0
        grid = numpy.meshgrid(
            numpy.linspace(left - more, right + more, 12), numpy.linspace(top - more, bottom + more, 12)
        )
        solved = solved_at(name, numpy.stack(grid, axis=-1)).has_contour
        if text.words.isdigit():
            assert not solved.all(), text
        elif text.runs[0].role is not Role.GIVEN:
            assert solved.all() if text.words == "solved" else not solved.any(), text
        else:  # beside the dot of what the block has, above it or below
            ((x, y),) = (each.at for each in picture.sheet.drawing if isinstance(each, Dot) and each.role is Role.GIVEN)
            assert 0 < max(left - x, x - right) < 10 > max(top - y, y - bottom) > 0


def test_a_map_of_many_even_values_has_even_axes_and_counts_all_of_them():
    values = {"A": numpy.linspace(150, 210, 401), "P": numpy.linspace(1, 60, 57)}
    family = contoursolve.family(BLOCK, start=START, vary=values)
    picture = draw_family_map(family, ("P", "A"))
    check(picture)
    ticks = [text for text in picture.sheet.texts if re.fullmatch(r"\d+", text.words) and text.at[1] > 470]
    steps = numpy.diff([text.at[0] for text in ticks])
    assert len(ticks) > 3
    assert steps == pytest.approx(steps[0], abs=1e-6)
    told = ", ".join(f"{number:,} {status.text}" for status, number in family.summary().items())
    assert picture.title == f"P and A: {told}"
    assert "drawn: 200 of 401 values of A; the title counts all contours" in labels(picture)
    # A sweep draws the same from the values that it draws alone.
    ready = contoursolve.families.sweep(BLOCK, start=START, vary=values)
    assert draw_sweep(ready).sheet == draw_family_map(family).sheet
    vary = {"A": numpy.arange(120, 250.1, 2)}
    fan = draw_sweep(contoursolve.families.sweep(BLOCK, start=START, vary=vary))
    counts = statuses_text(contoursolve.family(BLOCK, start=START, vary=vary).summary())
    assert fan.title == f"A from 120 to 250, 66 contours (21 drawn): {counts}"


@pytest.mark.parametrize("count", [1, 2, 300])
def test_a_map_of_one_value_each_and_one_of_many_are_drawn(count):
    values = numpy.linspace(3.0, 4.0, count)
    check(draw_family_map(contoursolve.family(BLOCK, start=START, vary={"P": values, "Q": values})))


def test_an_axis_says_that_its_values_are_diameters():
    vary = {"X": numpy.linspace(60, 120, 20), "K": numpy.linspace(-40, -20, 20)}
    pictures = (
        draw_family_map(contoursolve.family(BLOCK, start=START, vary=vary)),
        draw_range(contoursolve.ranges(BLOCK, "X", start=START)),
        draw_region(contoursolve.ranges(BLOCK, ("X", "K"), ((60, 120), (-40, -20)), start=START)),
    )
    assert [[label for label in labels(each) if label.endswith("[mm]")] for each in pictures] == [
        ["X diameter [mm]", "K [mm]"], ["X diameter [mm]"], ["X diameter [mm]", "K [mm]"],
    ]  # fmt: skip


def test_where_every_value_is_refused_nothing_is_painted_as_solved():
    refused = {Role.REFUSED_FIELD, Role.OTHER_FIELD}
    picture = draw_region(contoursolve.ranges(BLOCK, ("P", "Q"), ((-9.0, -5.0), (-9.0, -5.0)), start=START))
    check(picture)
    assert picture.title == "P and Q: no contour at every value sampled"
    assert {role for *_, role in fields_of(picture)} <= refused
    # Though words agree at one value.
    vary = {"B": numpy.arange(10.0, 90.0, 5), "I": [10.0, 10.0001]}
    found = contoursolve.family("G111 A135. I10. K-10. B120. Z-40.", start=START, rules="off", vary=vary)
    assert (found["status"] == Status.OVERDETERMINED.code).all()
    assert not numpy.isfinite(found["V2 X"]).any()
    assert {role for *_, role in fields_of(draw_family_map(found))} == {Role.REFUSED_FIELD}


# Ranges, fans and the command -------------------------------------------------------------------------------------


def test_a_fan_shows_each_contour_and_names_where_the_outcome_changes():
    values = [120.0, 130.0, 140.0, 150.0, 160.0, 180.0, 200.0]
    answers = [contoursolve.solve(BLOCK.replace("A180.", f"A{value}"), start=START).answers[0] for value in values]
    picture = draw_family_fan("A", values, answers)
    check(picture)
    assert {"A120", "A140", "A200"} <= set(labels(picture))
    # All end at one place: they are told apart where the rounding is.
    roundings = [10.0, 20.0, 30.0, 40.0]
    alike = [contoursolve.solve(BLOCK.replace("P5.", f"P{value}"), start=START).answers[0] for value in roundings]
    assert len({answer.contour.end for answer in alike}) == 1
    fan = compose_fan("P", roundings, alike, None)
    named = {part.label[0].text: part.at for part in fan.parts if isinstance(part, Mark) and part.label}
    assert len({named[f"P{value:g}"] for value in roundings}) == len(roundings)
    with pytest.raises(ValueError, match="a value for each"):
        draw_family_fan("A", values[:2], answers)
    check(draw_family_fan("A", values[:6] * 8, answers[:6] * 8))
    with pytest.raises(ValueError, match="49 contours cannot be read; draw at most 48"):
        draw_family_fan("A", values * 7, answers * 7)


ONE = ("--vary", "A=120:250:2", "--vary", "Q=5")


@pytest.mark.parametrize(
    ("arguments", "name", "said"),
    [
        ((*ONE, "--vary", "P=1:60:9", "--vary", "X=90,100"), "no.svg", "has 3 words"),
        (("--vary", "A=170"), "no.svg", "has 0 words"),
        (("--vary", "A=170,180", "--vary", "P=1,2", "--paired"), "no.svg", "has paired words"),
        ((*ONE, "--vary", "P=1:60:9", "--result", "V9 Z"), "no.svg", "there is no result V9 Z; did you mean"),
        ((*ONE, "--result", "V2 Z"), "no.svg", "a map of V2 Z takes two words that vary"),
        (ONE, "fan.pdf", "pictures end in .svg or .png"),
        ((*ONE, "--result", "V2 Z"), "", "name its file with --plot"),
    ],
)
def test_a_sweep_that_no_picture_can_show_writes_none(tmp_path, arguments, name, said):
    plot = ["--plot", str(tmp_path / name)] if name else []
    done = CliRunner().invoke(main, ["sweep", "--block", BLOCK, "--start", START, *arguments, *plot])
    assert (done.exit_code, said in done.output) == (2, True), done.output
    assert [*tmp_path.iterdir()] == []


# Maps that answer -------------------------------------------------------------------------------------------------


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


@pytest.mark.parametrize("name", PAGES)
def test_each_frame_of_a_page_is_what_a_single_solve_says(name):
    family = family_of(name, 6, 5)
    page = map_page(family, "length")
    assert page == map_page(family, "length")
    data = data_of(page)
    assert data["note"] == "This page holds the contours of all 30 values of the map."
    for axis, values in zip(data["axes"], family.ranges.values.values(), strict=True):
        assert axis == pytest.approx(values, rel=1e-9)
    places = [(one, two) for one in data["axes"][0] for two in data["axes"][1]]
    for frame, place in zip(data["frames"], places, strict=True):
        contour = solved_alone(family, place)
        assert isinstance(frame, int) == (contour is None)
        if contour is not None:
            text, path = frame
            length = sum(each.length for each in contour.elements)
            assert float(re.search(r"length ([\d.]+) mm", text)[1]) == pytest.approx(length, abs=0.001)
            first, second = (float(each) for each in re.findall(r"-?[\d.]+", path)[-2:])
            assert (first, -second) == pytest.approx(contour.end, abs=0.05)
            assert re.findall("[LA]", path) == ["A" if hasattr(each, "radius") else "L" for each in contour.elements]


def test_a_map_beside_the_values_of_the_block_still_shows_the_block(monkeypatch):
    monkeypatch.setattr("contoursolve.output.map_frames.MOST_FRAMES", 12)
    vary = {"A": [150, 160, 170], "P": [1, 2, 3]}
    for record in (
        contoursolve.family(BLOCK, start=START, vary=vary),
        contoursolve.ranges(BLOCK, ("A", "P"), ((150, 170), (1, 3)), start=START),
    ):
        data = data_of(map_page(record))
        assert (data["stated"], bool(data["ghost"])) == ([180.0, 5.0], True)
        shown = contoursolve.explore(record)
        assert shown.values == {**shown.values, "A": 180.0, "P": 5.0}
        shown.place = {"values": [180, 5], "number": 1}
        assert "A 180 is not on the map, which has 150 to 170" in shown.seen["text"]


def test_a_page_asks_no_other_host_and_lets_nothing_out_of_its_texts():
    block = "G111 X100. A180. K-30. B120. P5. (</script><script>stolen=1</script><img src=x onerror=y>)"
    vary = {"A": [170, 180, 190], "P": [2, 5]}
    page = map_page(contoursolve.family(block, start=START, vary=vary), version="1")
    shown = contoursolve.explore(contoursolve.family(block, start=START, vary=vary))._repr_mimebundle_()[0]
    for text in (page, shown["text/html"]):
        found = Scripts(text)
        assert len(found.scripts) == 2
        assert found.kinds.count("img") == (text is not page)  # the picture for whoever has no scripts
        assert "stolen" not in "".join(told for _, told in found.scripts)
        assert set(re.findall(r"https?://[^\"' )]+", text)) <= {"http://www.w3.org/2000/svg"}
    assert "default-src 'none'" in unescape(page)


def test_the_page_about_maps_tells_how_many_contours_one_holds():
    page = (Path(__file__).parents[2] / "docs" / "python.md").read_text(encoding="utf-8")
    assert f"at most {MOST_FRAMES} contours and {MOST_BYTES // 1000} kB" in page


@pytest.mark.parametrize("name", PAGES)
def test_a_click_opens_the_block_with_these_values_in_the_explorer(name):
    _, box, _ = BOXES[name]
    family = family_of(name, 5, 4)
    shown = contoursolve.explore(family)
    low, high = ([ends[number] for ends in box.values()] for number in (0, 1))
    heard = []
    shown.observe(lambda change: heard.append(change["new"]), "text")
    for share in (0.5, 0.7):
        values = [one + share * (two - one) for one, two in zip(low, high, strict=True)]
        shown.place = {"values": values, "number": 1, "is_open": True}
        alone = solved_alone(family, values)
        assert shown.seen["is_open"]
        assert bool(shown.seen["path"]) == (alone is not None)
        if alone is not None:
            assert shown.answer.contour.end == pytest.approx(alone.end, abs=1e-9)
            assert shown.seen["text"].startswith(f"solved, end {shown.answer.end_text}")
        else:
            # A family has no program whose lines would name a corner.
            (amount,) = re.findall(r": (.*) on ", shown.seen["text"])
            assert any(amount in each.message for each in shown.answer.diagnostics)
    assert heard[-1] == shown.text
    for wrong in ({"values": ["x", 1]}, {"values": [1]}, {}, {"values": [1e300, 1]}):
        before = shown.text
        shown.place = {"number": 2, "is_open": True, **wrong}
        assert (shown.text, bool(shown.seen["text"]), bool(shown.seen["path"])) == (before, True, False)


def test_a_map_is_of_a_family_over_two_words_or_of_a_region():
    one = contoursolve.family(BLOCK, start=START, vary={"A": [170, 180]})
    assert contoursolve.draw(one).title == "A from 170 to 180, 2 contours: 2 solved"  # the contours themselves
    for wrong, error, said in (
        (one, ValueError, "a grid of two words"),
        (contoursolve.solve(BLOCK, start=START), TypeError, "not of Result"),
    ):
        for ask in (map_page, contoursolve.explore):
            with pytest.raises(error, match=said):
                ask(wrong)
    with pytest.raises(ValueError, match="a grid of two words"):
        draw_family_map(family_of("a taper", 3, 2), ("A", "Q"))


# Axes of matplotlib -----------------------------------------------------------------------------------------------


@pytest.fixture
def ax():
    return pytest.importorskip("matplotlib.figure").Figure().subplots()


@pytest.mark.needs("matplotlib")
@pytest.mark.parametrize(
    ("block", "start", "named"),
    [(BLOCK, START, ("Z [mm]", "X [mm, diameter]", "100")), (CHAIN, None, ("X [mm]", "Y [mm]", "50"))],
    ids=["lathe", "mill"],
)
def test_a_contour_is_one_line_as_near_to_it_as_asked(ax, block, start, named):
    contour = contoursolve.solve(block, start=start).answers[0].contour
    assert contour.plot(ax, chord_error=0.001, label="a part", color="red") is ax
    (line,) = ax.lines
    assert (line.get_label(), line.get_color(), ax.get_aspect()) == ("a part", "red", 1.0)
    points = line.get_xydata()
    assert (tuple(points[0]), tuple(points[-1])) == (contour.start, contour.end)
    for arc in [each for each in contour.elements if hasattr(each, "radius")]:
        own = points[numpy.abs(numpy.hypot(*(points - arc.center).T) - arc.radius) < 1e-9]
        middles = (own[1:] + own[:-1]) / 2
        depths = [arc.radius - hypot(*(each - arc.center)) for each in middles]
        assert max(depth for depth in depths if depth < 0.01) <= 0.001 + 1e-12
        assert len(own) > 5
    # Names and numbers are the machine's, places are those of the contour.
    number = ax.yaxis.get_major_formatter()(50.0, 0) if start else "50"
    assert (ax.get_xlabel(), ax.get_ylabel(), number) == named


@pytest.mark.needs("matplotlib")
def test_a_region_and_a_family_are_drawn_beside_what_is_there(ax):
    region = contoursolve.ranges(BLOCK, ("A", "P"), ((150, 210), (1, 60)), start=START)
    ax.plot([160], [10], label="mine")
    assert region.plot(ax, result="length") is ax
    borders = [each.reason.text for each in region.boundaries]
    assert [line.get_label() for line in ax.lines] == ["mine", *borders, "the block"]
    assert [tuple(each) for each in ax.lines[1].get_xydata()] == list(region.boundaries[0].points)
    assert (ax.get_xlabel(), ax.get_ylabel(), ax.get_title()) == ("A [deg]", "P [mm]", "length [mm]")
    family = family_of("a taper", 31, 29)
    other = type(ax.figure)().subplots()
    for options in ({}, {"result": "V1 Z"}, {"result": "end Z", "words": ("P", "A")}):
        other.clear()
        assert family.plot(other, **options) is other
    assert (other.get_xlabel(), other.get_ylim()) == ("P [mm]", (150.0, 210.0))
    one = contoursolve.family(BLOCK, start=START, vary={"A": [170], "P": [1, 2]})
    for own, axes, options, error, said in (
        (family, other, {"result": "end Y"}, contoursolve.errors.FamilyError, "the axes of this contour are Z and X"),
        (family, [other], {}, TypeError, "ax is axes of matplotlib"),
        (one, other, {"words": ("A", "P")}, ValueError, "two or more values"),
    ):
        with pytest.raises(error, match=said):
            own.plot(axes, **options)


def test_without_matplotlib_its_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(contoursolve.errors.MissingExtraError, match=r'needs matplotlib; .* "contoursolve\[plot\]"'):
        contoursolve.solve(BLOCK, start=START).answers[0].contour.plot()
