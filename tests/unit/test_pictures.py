"""Pictures of contours, programs and sketches: what is shown, where it stands, and that any reader can see it."""

import math
import os
import random
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner
from fuzzing import NAMED, examples, mutate

import contoursolve
from contoursolve.__main__ import commands
from contoursolve.diagnosis import BlockState
from contoursolve.pictures import (
    DARK_COLORS,
    LEVELS,
    LIGHT_COLORS,
    Leader,
    Mark,
    MarkKind,
    Role,
    Theme,
    compose,
    draw,
    draw_answer,
    draw_matrix,
    draw_result,
)

PROGRAMS = sorted((Path(__file__).parents[2] / "notebooks" / "programs").glob("*.nc"))
SHAFT = next(path for path in PROGRAMS if path.stem == "shaft")
MOST_BYTES = 80_000
SVG = "{http://www.w3.org/2000/svg}"
CIRCLE = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\n"
BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
HOSTILE = "(]]></svg><script>alert[1]</script> & \" ' \x0b \ud800 \u202e $x^2$ {0} %s \\ <!-- )"
BESIDE = "G111 A180. K-30. B120. X100. (contoursolve: line 2 passes through [Z-40. X80.])"

KINDS = {
    "solved": (BLOCK, START, {}),
    "bevels": ("G111 X100. A180. K-30. B120. C5. D5.", START, {}),
    "inches": ("G20\nG111 X4. A180. K-1. B120. P.2 Q.2", "G20 X2. Z0.", {"units": "inch"}),
    "corner too large": ("G111 A180. K-20. P4. B90. X66. D0.5", "X60. Z-55.", {}),
    "ignored": ("G111 A135. I10. K-12. B180. Z-40. X70. P2.", START, {}),
    "free": ("G111 X100. A180. K-30.", START, {}),
    "quite free": ("G111 A90. C2. Q3.", "X20. Z0.", {}),
    "free at no value": ("G111 A180. I0 B120. X100.", START, {"rules": "off"}),
    "nothing known of line 1": ("G111 B-120.", START, {}),
    "a corner asked for": ("G111 X100. A180. K-30. B120. P? Q5.", START, {}),
    "an arc asked for": ("G112 U0 I? K-30. R32. P3. Q3.", "X60. Z-44.", {}),
    "parallel": ("G111 X100. A180. K-30. B180.", START, {}),
    "reversed": ("G111 X100. A180. K-30. B-120.", START, {}),
    "conflicting": ("G111 A135. I10. K-12. B180. Z-40. P2.", START, {"rules": "off"}),
    "overlap": ("G111 X50. A180. K-30. B120. P9. Q9.", START, {}),
    "asked": ("G111 X100. A180. K-30. B120. P?", START, {"facts": ["straight part of line 2 = 20"]}),
    "beside its place": (BESIDE, START, {}),
    "through its place": (BESIDE.replace("B120. ", ""), START, {}),
    "without a start": ("G111 X100. A180. K-30. B120.", None, {}),
    "an end too far": ("G111 A180. K-30. B120. X10000000000.", START, {}),
    "a radius below zero": ("G112 U0 I10. K-50. R-30.", "X100. Z-50.", {}),
    "an arc missed": ("G112 U-60. I10. K-50. R30.", "X100. Z-50.", {}),
    "G112": ("G112 U0 I10. K-50. P5. Q5. R30.", "X100. Z-50.", {}),
    "G11": ("G11 Z-20. I8.", "X30. Z0.", {}),
    "G01": ("G01 X80. K-7.", "X46. Z-20.", {"control": "yasnac-lx3"}),
    "circle-line": (CIRCLE + "G1 X-50 Y42.857 ,A171.87 Q-1", None, {}),
    "ambiguous": (CIRCLE + "G1 X-50 Y42.857 ,A171.87", None, {"rules": "off"}),
    "missed": (CIRCLE + "G1 X-50 Y80 ,A171.87 Q1", None, {}),
    "apart": (CIRCLE + "G3 X200 Y0 I200 J-20 R20 Q1", None, {}),
    "radii differ": ("G17 G41 G0 X50 Y0\nG3 X-52 Y0 I-50 J0\nG1 X-50 Y42.857 ,A171.87 Q1", None, {}),
    "G18": ("G18 G41 G0 Z50 X0\nG3 Z-50 X0 R50\nG1 Z-50 X42.857 ,A171.87 Q1", None, {}),
    "without points": ("G00 X20. Z0.\nG01 Z-20 ,R2\nX40 ,A100", None, {"control": "fanuc-lathe"}),
    "tiny": ("G111 X0.002 A180. K-0.003 B120.", "X0. Z0.", {}),
    "huge": ("G111 X100000. A180. K-30000. B120. P5. Q5.", "X99000. Z-90000.", {}),
}
"""Blocks, where they begin, and options."""


def answer_of(name):
    text, start, options = KINDS[name]
    (answer,) = contoursolve.solve(text, start=start, **options).answers
    return answer


def texts(items, role=None):
    return [each for each in items if hasattr(each, "runs") and role in (None, each.runs[-1].role)]


def strokes(items, role=None):
    return [each for each in items if hasattr(each, "steps") and role in (None, each.role)]


def is_arc(step):
    return hasattr(step, "angle")


def labels(picture):
    return [text.words for text in picture.sheet.texts]


# What holds for every picture -------------------------------------------------------------------------------------


def check(picture):
    """Texts stand on the page and apart, the numbers are finite, and readers are told; the SVG as a tree."""
    boxes = [text.box for text in picture.sheet.texts if text.words.strip()]
    for number, box in enumerate(boxes):
        assert -0.5 <= box.left < box.right <= picture.width + 0.5
        assert -0.5 <= box.top < box.bottom <= picture.height + 0.5
        assert not any(box.meets(other) for other in boxes[:number]), box
    assert len(picture.svg.encode()) < MOST_BYTES
    assert not re.search(r"nan|inf(?![a-z])", re.sub(r"<(title|desc|text|tspan)[^>]*>[^<]*", "", picture.svg))
    tree = ElementTree.fromstring(picture.svg)
    title, description = tree[0], tree[1]
    assert [each.tag for each in (tree, title, description)] == [f"{SVG}svg", f"{SVG}title", f"{SVG}desc"]
    assert (tree.get("role"), tree.get("aria-labelledby")) == ("img", f"{title.get('id')} {description.get('id')}")
    shown = re.sub("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "\ufffd", picture.description)
    assert (title.text, description.text) == (picture.title, shown)
    assert title.text
    assert description.text
    names = [each.get("id") for each in tree.iter() if each.get("id")]
    assert len(names) == len(set(names))
    return tree


def check_matrix(system):
    """The order of the blocks makes the matrix triangular, what is solved is square, and the picture can be read."""
    rows = [row for block in system.blocks for row in block.rows]
    columns = [column for block in system.blocks for column in block.columns]
    assert sorted(rows) == [*range(len(system.equations))]
    assert sorted(columns) == [*range(len(system.unknowns))]
    for number, block in enumerate(system.blocks):
        if block.state is not BlockState.REPEATED:
            later = [column for other in system.blocks[number + 1 :] for column in other.columns]
            assert not any(system.jacobian[row, column] for row in block.rows for column in later)
        if block.state is BlockState.SOLVED:
            assert len(block.rows) == len(block.columns)
            assert system.jacobian.extract(list(block.rows), list(block.columns)).rank() == len(block.rows)
    repeated = [block for block in system.blocks if block.state is BlockState.REPEATED]
    assert system.rank == len(rows) - sum(len(block.rows) for block in repeated)
    assert {str(each) for each in system.free} <= {
        str(system.unknowns[column].symbol)
        for block in system.blocks
        if block.state is BlockState.OPEN
        for column in block.columns
    }
    check(draw(system))


WORDS_OF_TWO_LINES = {"A": "A160.", "I": "I10.919", "K": "K-30.", "B": "B120.", "X": "X101.838", "Z": "Z-41.547"}


@pytest.mark.parametrize("letters", ["ABX", "AIK", "AIKB", "ABXZ", "AIKBXZ", "KB"])
def test_the_matrix_of_words_and_unknowns_is_in_the_order_of_its_blocks(letters):
    block = " ".join(["G111", *(WORDS_OF_TWO_LINES[letter] for letter in letters)])
    check_matrix(contoursolve.system(block, start="X40. Z0.", rules="off"))


@pytest.mark.slow
def test_the_matrix_of_a_pair_and_of_a_fact_is_in_the_order_of_its_blocks():
    pair = contoursolve.solve("G3 X0 Y40 I-40 J0\nG1 X-60 Y50 ,A170 Q-1", start="G42 X40 Y0", control="nct-99m")
    check_matrix(pair.answers[0].system)
    facts = ["straight part of line 2 = 20"]
    asked = contoursolve.solve("G111 X100. A180. K-30. B120. P?", start="X40. Z0.", facts=facts).answers[0].system
    check_matrix(asked)
    assert "7. Z_corner1_begin" in draw_matrix(asked).description


def check_drawing(answer):
    """The path and the radii are where the contour has them, and no text covers a centre or lies along a path."""
    sheet = draw_answer(answer).sheet
    if sheet.placement is None:
        return
    place, scale = sheet.placement.view.place, sheet.placement.view.scale
    thick = [stroke for stroke in strokes(sheet.drawing) if stroke.width >= 2.2]
    if answer.contour is not None:
        drawn = [stroke for stroke in thick if stroke.width == 2.6]
        for stroke, element in zip(drawn, answer.contour.elements, strict=True):
            (step,) = stroke.steps
            assert stroke.start == pytest.approx(place(element.start))
            assert (step.end if is_arc(step) else step) == pytest.approx(place(element.end))
            assert is_arc(step) == hasattr(element, "radius")
            if is_arc(step):
                assert (*step.center, step.radius) == pytest.approx((*place(element.center), scale * element.radius))
                assert abs(step.angle) == pytest.approx(math.radians(abs(element.sweep)))
                assert (step.angle > 0) == (element.turn.value == "cw"), "Y is down on a page"
    own = {text.words for text in texts(sheet.drawing)}
    for leader in (each for each in compose(answer).each(Leader) if each.center is not None and each.text in own):
        x, y = place(leader.center)
        rays = [each for each in strokes(sheet.drawing, leader.role) if (each.width, each.about) == (0.9, leader.about)]
        assert rays, leader.text
        for (a, b), (c, d) in ((ray.start, ray.steps[0]) for ray in rays):
            off = abs((c - a) * (y - b) - (d - b) * (x - a)) / math.hypot(c - a, d - b)
            assert off < 0.02 * max(1.0, math.hypot(x - a, y - b) / 100), "a ray runs through the centre (ISO 129)"
            assert math.hypot(c - x, d - y) == pytest.approx(scale * math.dist(leader.at, leader.center), rel=1e-6)
    crosses = [place(mark.at) for mark in compose(answer).each(Mark) if mark.kind is MarkKind.CENTER]
    for text in texts(sheet.drawing):
        left, top, right, bottom = text.box
        assert not any(left - 4 < x < right + 4 and top - 4 < y < bottom + 4 for x, y in crosses), text
        for stroke in (each for each in thick if not is_arc(each.steps[0])):
            (a, b), (c, d) = stroke.start, stroke.steps[0]
            spots = [(a + (c - a) * part / 200, b + (d - b) * part / 200) for part in range(201)]
            covered = sum(left < x < right and top < y < bottom for x, y in spots)
            assert covered * math.hypot(c - a, d - b) / 200 < 70, text


def random_block(draw: random.Random) -> tuple[str, str]:
    """Any words of G111 at any size, and a start point."""
    size = 10.0 ** draw.uniform(-3, 5)
    letters = draw.sample("XUZWABIKPQCD", draw.randrange(2, 9))
    angles = (0, 45, 90, 120, 180, -30, 359.999)
    words = [
        f"{letter}{draw.choice(angles) if letter in 'AB' else draw.uniform(-size, size):.4f}" for letter in letters
    ]
    return f"G111 {' '.join(words)}", f"X{draw.uniform(0, size):.4f} Z{draw.uniform(-size, size):.4f}"


@pytest.mark.parametrize("seed", range(12))
def test_random_blocks_of_every_status_are_drawn(seed):
    draw = random.Random(seed)
    options = {"rules": draw.choice(("enforce", "off")), "depth": draw.choice(("full", "verdict"))}
    for _ in range(4):
        text, start = random_block(draw)
        answers = contoursolve.solve(f"{text} {HOSTILE}", start=start, **options).answers
        control = draw.choice(NAMED)
        text = draw.choice(examples(control))
        for _ in range(draw.randrange(1, 4)):
            text = mutate(text, draw)
        others = contoursolve.solve(text, control=control, **options).answers
        for answer in (*answers, *others):
            check(draw_answer(answer, theme=draw.choice(list(Theme))))
        for answer in answers:
            check_drawing(answer)


# One contour ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("block", "in_block", "drawn"),
    [
        ("G111 Z-95 A180. X100. B120.", {"Z-95"}, {"Z-95 = -0.095 mm"}),
        ("G111 X100 A180. K-30. B120. P5.", {"X100"}, {"X100 = 0.100 mm dia"}),
        ("G111 X100. A180. K-30 B120. P5.", {"K-30"}, {"K-30 = -0.030 mm"}),
        ("G111 X100. A180. K-30. B120. Z-95", {"Z-95"}, {"Z-95 = -0.095 mm"}),
        ("G111 X100. A180. K-30. B120. P5", set(), set()),
        # Its point alone would not mend this one.
        ("G111 Z95 A180. X100. B120.", {"A180.", "Z95"}, {"A180.", "Z95 = 0.095 mm"}),
        ("G111 X100. A180. K-30. B120. E7.", {"E7."}, set()),
        ("G111 X100. A180. K-30. B12O.", {"B12O."}, {"B12"}),
        ("G111 X100. A180. K-30. B120. B130.", {"B120.", "B130."}, {"B120."}),
        # Words are blamed unless others are missing beside them.
        ("G111 X100. A180. B120.", set(), set()),
        ("G12 W-20.", set(), set()),
        ("G12 U50. W-20. K8.", {"U50.", "W-20."}, {"W-20."}),
        ("G112 U0 I10. K0 R30.", {"K0"}, {"K0"}),
    ],
)
def test_what_is_at_fault_is_marked_and_not_what_disagrees_with_it(block, in_block, drawn):
    (answer,) = contoursolve.solve(block, start=START, control="yasnac-lx3").answers
    picture = draw_answer(answer)
    check(picture)
    lines, inside = (
        {run.text.strip() for text in texts(items) for run in text.runs if run.is_underlined}
        for items in (picture.sheet.around, picture.sheet.drawing)
    )
    assert "".join(sorted(lines)) == "".join(sorted(in_block))  # one that is read in part is in two
    assert inside == drawn


def test_a_crowded_drawing_says_what_it_leaves_out():
    blocks = [f"G1 X{10 * (number + 1)} Y{7 * (number % 2)} ,R1" for number in range(40)]
    (answer,) = contoursolve.solve("G17 G90 G0 X0 Y0\n" + "\n".join([*blocks, "G1 X500 Y0"]), control="nct-99m").answers
    picture = draw_answer(answer)
    check(picture)
    assert [text.words for text in texts(picture.sheet.drawing)] == ["start", "end", *(f"V{n}" for n in range(1, 39))]
    small = ", ".join(f"rounding ,R1 (program line {line})" for line in range(2, 8))
    assert labels(picture)[-3] == "40 words are not drawn: there is no room for so many"
    assert " ".join(labels(picture)[-2:]) == f"too small to be read here: {small} and 34 more"


def test_how_far_a_line_passes_from_a_place_is_a_dimension():
    fact = "line 2 passes beside [Z-40. X80.] at 2"
    (answer,) = contoursolve.solve("G111 X100. A180. K-30.", start=START, facts=[fact]).answers
    picture = draw_answer(answer)
    check(picture)
    # The place lies 20 mm above V1 and 10 mm before it: its line at 2 mm meets X100. in one of two places.
    assert "end  Z-41.777 X100" in labels(picture)
    assert [text.words for text in texts(picture.sheet.drawing)].count("2") == 1
    (size,) = [each for each in strokes(picture.sheet.drawing) if each.width == 1.3]
    view = picture.sheet.placement.view
    assert size.start == pytest.approx(view.place((-40.0, 40.0)))
    assert math.dist(size.start, size.steps[0]) == pytest.approx(2 * view.scale)


# Colours, bytes and files -----------------------------------------------------------------------------------------


def luminance(color: str) -> float:
    """WCAG 2.2, relative luminance."""
    parts = [int(color[place : place + 2], 16) / 255 for place in (1, 3, 5)]
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("colors", [LIGHT_COLORS, DARK_COLORS], ids=["light", "dark"])
def test_every_text_and_line_stands_out_from_its_ground(colors):
    fields = {Role.SOLVED_FIELD, Role.REFUSED_FIELD, Role.OTHER_FIELD, *LEVELS}
    for role in set(Role) - fields - {Role.PAPER}:
        assert contrast(colors[role], colors[Role.PAPER]) >= 4.5
    for field in fields:
        assert contrast(colors[Role.INK], colors[field]) >= 7


def test_states_are_told_apart_without_colour_and_several_pictures_stand_in_one_page():
    dashes, names = {}, []
    for name in KINDS:
        picture = draw_answer(answer_of(name), theme=Theme.PAGE)
        names += re.findall(r' id="([^"]+)"', picture.svg)
        for stroke in strokes(picture.sheet.drawing):
            dashes.setdefault(stroke.role, set()).add(stroke.dash)
    dashed = [max(dashes[role]) for role in (Role.DERIVED, Role.IGNORED, Role.CONFLICTING, Role.FREE, Role.GHOST)]
    assert len({*dashed, ()}) == len(dashed) + 1
    assert dashes[Role.GIVEN] == {()}
    assert len(names) == len(set(names))


def test_text_of_a_program_is_escaped():
    text = f"G111 X100. A180. K-30. B120. P5. {HOSTILE}"
    (answer,) = contoursolve.solve(text, start=START, facts=["line 2 passes through (Z-47.3205 X100.)"]).answers
    # A file's name may be no Unicode; what XML has no character for is shown as one, and nothing beside it.
    known, unknown = "\t\ud7ff\ue000\ufffd\U00010000\U0010ffff", "\x00\x08\x0b\x1f\ud800\udfff\ufffe\uffff"
    picture = draw_answer(answer, title=f"<b>&\"'{known}{unknown}")
    tree = ElementTree.fromstring(picture.svg)
    assert tree[0].text == f"<b>&\"'{known}{len(unknown) * chr(0xFFFD)}"
    tags = "svg title desc defs clipPath rect g path polygon circle text tspan"
    assert {each.tag for each in tree.iter()} <= {f"{SVG}{tag}" for tag in tags.split()}
    assert picture.png(50).startswith(b"\x89PNG")


@pytest.mark.slow
def test_the_same_contour_gives_the_same_bytes_in_every_process_and_an_svg_needs_no_package():
    program = (
        "import contoursolve, pathlib, sys; from contoursolve.pictures import draw_result\n"
        "sys.stdout.buffer.write(draw_result(contoursolve.solve(pathlib.Path(sys.argv[1]))).svg.encode())\n"
        "assert not {'resvg_py', 'sympy', 'scipy', 'PIL'} & sys.modules.keys()"
    )
    found = subprocess.run(
        [sys.executable, "-c", program, str(SHAFT)],
        check=True,
        capture_output=True,
        env={**os.environ, "PYTHONHASHSEED": "7", "PYTHONPATH": os.pathsep.join(sys.path)},
    ).stdout
    assert found == draw_result(contoursolve.solve(SHAFT)).svg.encode()


def test_a_png_that_cannot_be_made_is_refused(monkeypatch, tmp_path):
    picture = draw_answer(answer_of("solved"))
    for wrong in (0, -1, 1e9, float("nan")):
        with pytest.raises(ValueError, match="cannot be painted"):
            picture.png(wrong)
    with monkeypatch.context() as patch:
        patch.setattr("contoursolve.pictures.svg._has_fonts", lambda: False)
        with pytest.raises(contoursolve.errors.MissingExtraError, match="needs a font"):
            picture.png()
    monkeypatch.setitem(sys.modules, "resvg_py", None)
    status, output = plot(SHAFT, "-o", tmp_path / "a.png")
    assert status == 2
    assert f'{sys.executable} -m pip install "contoursolve[picture]"' in output
    assert not (tmp_path / "a.png").exists()


# Programs ---------------------------------------------------------------------------------------------------------


def test_contours_that_begin_at_one_place_share_a_label_beside_the_path():
    (path,) = (each for each in PROGRAMS if each.stem == "unusual")
    words = labels(draw_result(contoursolve.solve(path)))
    assert "unusual.nc: 4 contours (4 solved)" in words
    assert "1, 2, 3, 4" in words


# Sketches ---------------------------------------------------------------------------------------------------------


def rings_of(picture, role):
    """Centres and radii of the whole circles in a role, pixels."""
    sweeps = [item.steps[0] for item in strokes(picture.sheet.drawing, role) if is_arc(item.steps[0])]
    return [(*sweep.center, sweep.radius) for sweep in sweeps if abs(sweep.angle) == pytest.approx(2 * math.pi)]


def test_all_circles_that_touch_three_are_drawn_where_they_touch_and_labelled():
    sketch = contoursolve.Sketch()
    for name, center, radius in (("a", (0, 0), 10), ("b", (40, 5), 8), ("c", (18, 35), 6)):
        sketch.circle(name, center, radius)
    sketch.circle("k")
    for name in "abc":
        sketch.state(f"k tangent to {name}")
    drawings, picture = sketch.solve(), draw(sketch)
    check(picture)
    assert picture.sheet == draw(drawings).sheet
    given, found = rings_of(picture, Role.GIVEN), rings_of(picture, Role.CANDIDATE)
    assert (len(given), len(found), len(drawings)) == (3, 8, 8)
    for x, y, radius in found:
        for other_x, other_y, other in given:
            apart = math.hypot(x - other_x, y - other_y)
            assert min(abs(apart - radius - other), abs(apart - abs(radius - other))) < 1e-6
    told = labels(picture)
    for number, drawn in enumerate(drawings, 1):
        (size,) = [float(text.split("R")[1]) for text in told if text.startswith(f"{number}: k R")]
        assert size == pytest.approx(drawn.radii["k.radius"], abs=5e-4)
        assert f"{number}: {drawn.name}" in told
    assert {"a R10", "b R8", "c R6", "k tangent to a"} <= set(told)
    shown = sketch._repr_mimebundle_()
    assert [*shown] == ["text/plain", "image/svg+xml", "text/html"]
    assert shown["text/plain"] == str(drawings)


def test_the_facts_of_a_sketch_are_dimensions_and_its_points_tell_the_drawings_apart():
    sketch = contoursolve.Sketch((10, 20))
    for name, to in (("a", ""), ("b", ""), ("c", "P0")):
        sketch.line(name, to)
    for fact in ("length of a = 8", "length of b = 7", "length of c = 5", "direction of a = 0", "direction of c = ?"):
        sketch.state(fact)
    drawings = sketch.solve()
    picture = draw(drawings)
    check(picture)
    inside = {text.words for text in texts(picture.sheet.drawing)}
    assert {"length of a = 8", "length of b = 7", "length of c = 5", "direction of a = 0"} <= inside
    assert {"1: P2  X12.5 Y24.33", "2: P2  X12.5 Y15.67", "P1  X18 Y20"} <= inside
    one = draw(drawings[0])
    check(one)
    assert {"P2  X12.5 Y24.33", "direction of c = -120"} <= set(labels(one))
    sketch.state("length of a = 9")
    check(draw(sketch))  # facts that disagree leave no drawing


def test_distances_of_a_sketch_are_dimensions_from_lines_and_places():
    sketch = contoursolve.Sketch()
    sketch.circle("a", (0, 0), 10)
    for name in "mn":
        sketch.infinite_line(name)
    sketch.circle("k")
    stated = ("m tangent to a", "direction of m = 30", "n parallel to m at 7", "X of center of k = 40")
    for fact in (*stated, "Y of center of k = 10", "k passes beside [X40 Y20] at 3"):
        sketch.state(fact)
    picture = draw(sketch)
    check(picture)
    assert {"n parallel to m at 7", "3"} <= {text.words for text in texts(picture.sheet.drawing)}


# The command ------------------------------------------------------------------------------------------------------


def plot(*arguments):
    done = CliRunner().invoke(commands(), ["plot", *map(str, arguments)])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.exit_code, done.output


def test_plot_writes_one_contour_or_each_in_the_theme_that_is_asked_for(tmp_path):
    result = contoursolve.solve(SHAFT)
    status, output = plot(SHAFT, "--line", 69, "-o", tmp_path / "a.PNG", "--theme", "dark")
    assert (status, "a.PNG: program line 69, solved" in output) == (0, True)
    wanted = next(answer for answer in result.answers if answer.lines[0] == 69)
    assert (tmp_path / "a.PNG").read_bytes() == draw_answer(wanted, theme=Theme.DARK).png()
    assert plot(SHAFT, "--each", "-o", tmp_path / "b.svg")[0] == 0
    names = sorted(path.name for path in tmp_path.glob("b*"))
    assert names == sorted(f"b-{answer.lines[0]}.svg" for answer in result.answers)
    status, output = plot(SHAFT, "--line", 1, "-o", tmp_path / "c.svg")
    assert status == 2
    assert "program line 1 belongs to no contour; contours begin in program lines 53, 67" in output
    assert not (tmp_path / "c.svg").exists()
    for wrong in (("--line", 69, "--each"), ("--each", "-o", "x.dxf"), ("--line", 69, "-o", "x.dxf")):
        assert plot(SHAFT, *wrong)[0] == 2
