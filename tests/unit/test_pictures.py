"""Pictures: every contour is drawn, labels stand apart, numbers are the contour's, and any reader can see it."""

import math
import os
import random
import re
import struct
import subprocess
import sys
import time
from pathlib import Path
from xml.etree import ElementTree

import numpy
import pytest
from click.testing import CliRunner
from fuzzing import CONTROLS, examples, mutate
from test_rules import WRONG

import contoursolve
from contoursolve.cli import main
from contoursolve.diagnosis.wording import statuses_text
from contoursolve.diagnostics.finding import Severity
from contoursolve.pictures import (
    Picture,
    Theme,
    draw,
    draw_answer,
    draw_family_fan,
    draw_family_map,
    draw_range,
    draw_region,
    draw_result,
    draw_sweep,
)
from contoursolve.pictures.compose import compose
from contoursolve.pictures.labels import clip
from contoursolve.pictures.page import WIDTH, Box, Shape, Stroke, Sweep, Text
from contoursolve.pictures.scene import Leader, Mark, MarkKind
from contoursolve.pictures.subject import subject_of
from contoursolve.pictures.svg import PIXELS
from contoursolve.pictures.theme import DARK_COLORS, DASHES, LEVELS, LIGHT_COLORS, Role
from contoursolve.solving import StatusCode
from contoursolve.solving.contour import ArcSegment
from contoursolve.try_edits import try_example

PROGRAMS = sorted((Path(__file__).parents[2] / "notebooks" / "programs").glob("*.nc"))
"""Blocks of one seed."""
"""Random blocks that are drawn; 2,000 for a thorough run."""

MOST_BYTES = 60_000
SVG = "{http://www.w3.org/2000/svg}"
CIRCLE = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\n"

KINDS = {
    "solved": ("G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0.", {}),
    "bevels": ("G111 X100. A180. K-30. B120. C5. D5.", "X40. Z0.", {}),
    "inches": ("G20\nG111 X4. A180. K-1. B120. P.2 Q.2", "G20 X2. Z0.", {"units": "inch"}),
    "corner too large": ("G111 A180. K-20. P4. B90. X66. D0.5", "X60. Z-55.", {}),
    "ignored": ("G111 A135. I10. K-12. B180. Z-40. X70. P2.", "X40. Z0.", {}),
    "free": ("G111 X100. A180. K-30.", "X40. Z0.", {}),
    "quite free": ("G111 A90. C2. Q3.", "X20. Z0.", {}),
    "parallel": ("G111 X100. A180. K-30. B180.", "X40. Z0.", {}),
    "reversed": ("G111 X100. A180. K-30. B-120.", "X40. Z0.", {}),
    "conflicting": ("G111 A135. I10. K-12. B180. Z-40. P2.", "X40. Z0.", {"rules": "off"}),
    "overlap": ("G111 X50. A180. K-30. B120. P9. Q9.", "X40. Z0.", {}),
    "asked": ("G111 X100. A180. K-30. B120. P?", "X40. Z0.", {"facts": ["straight part of line 2 = 20"]}),
    "without a start": ("G111 X100. A180. K-30. B120.", None, {}),
    "G112": ("G112 U0 I10. K-50. P5. Q5. R30.", "X100. Z-50.", {}),
    "G11": ("G11 Z-20. I8.", "X30. Z0.", {}),
    "G01": ("G01 X80. K-7.", "X46. Z-20.", {"control": "yasnac-lx3"}),
    "circle-line": (CIRCLE + "G1 X-50 Y42.857 ,A171.87 Q-1", None, {}),
    "ambiguous": (CIRCLE + "G1 X-50 Y42.857 ,A171.87", None, {"rules": "off"}),
    "missed": (CIRCLE + "G1 X-50 Y80 ,A171.87 Q1", None, {}),
    "apart": (CIRCLE + "G3 X200 Y0 I200 J-20 R20 Q1", None, {}),
    "radii differ": ("G17 G41 G0 X50 Y0\nG3 X-52 Y0 I-50 J0\nG1 X-50 Y42.857 ,A171.87 Q1", None, {}),
    "G18": ("G18 G41 G0 Z50 X0\nG3 Z-50 X0 R50\nG1 Z-50 X42.857 ,A171.87 Q1", None, {}),
    "tiny": ("G111 X0.002 A180. K-0.003 B120.", "X0. Z0.", {}),
    "huge": ("G111 X100000. A180. K-30000. B120. P5. Q5.", "X99000. Z-90000.", {}),
}


def answers_of(name: str):
    text, start, options = KINDS[name]
    return contoursolve.solve(text, start=start, **options).answers


def check(picture: Picture) -> ElementTree.Element:
    """What holds for every picture; its SVG as a tree."""
    sheet = picture.sheet
    page = Box(0.0, 0.0, WIDTH, sheet.height)
    texts = [text for text in sheet.texts if text.words.strip()]
    for number, text in enumerate(texts):
        assert page.grow(0.5).holds(text.box), text
        for other in texts[:number]:
            assert not text.box.meets(other.box), (text, other)
    assert len(picture.svg.encode()) < MOST_BYTES
    assert not re.search(r"nan|inf(?![a-z])", re.sub(r"<(title|desc|text|tspan)[^>]*>[^<]*", "", picture.svg))
    tree = ElementTree.fromstring(picture.svg)
    assert tree.tag == f"{SVG}svg"
    assert tree.get("role") == "img"
    title, description = tree[0], tree[1]
    assert [title.tag, description.tag] == [f"{SVG}title", f"{SVG}desc"]
    assert tree.get("aria-labelledby").split() == [title.get("id"), description.get("id")]
    assert title.text
    assert description.text
    names = [each.get("id") for each in tree.iter() if each.get("id")]
    assert len(names) == len(set(names))
    return tree


@pytest.mark.parametrize("name", KINDS)
def test_every_kind_of_contour_is_drawn_with_labels_apart(name):
    (answer,) = answers_of(name)
    for theme in Theme:
        tree = check(draw_answer(answer, theme=theme))
        shown = " ".join("".join(each.itertext()) for each in tree.iter(f"{SVG}text"))
        for word in answer.claim.words.values():
            assert word.text.strip() in shown


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_labels_of_all_programs_in_the_repository_stand_apart(path):
    result = contoursolve.solve_file(path)
    check(draw_result(result))
    for answer in result.answers:
        check(draw_answer(answer))


def words_in(picture):
    return ["".join(each.itertext()) for each in ElementTree.fromstring(picture.svg).iter(f"{SVG}text")]


def test_contours_that_begin_at_one_place_share_a_label_beside_the_path():
    (path,) = (each for each in PROGRAMS if each.stem == "unusual")
    result = contoursolve.solve_file(path)
    assert len({answer.contour.start for answer in result.answers}) == 1
    words = words_in(draw_result(result))
    assert "unusual.nc: 4 contours (4 solved)" in words
    assert [word for word in words if "line" in word] == ["1, 2, 3, 4  lines 5, 8, 11, 14"]


@pytest.mark.parametrize("block", ["G111 A180.", "G111 A180. B120.", "G111 B-120.", "G111 A170. B100. P5."])
def test_what_is_free_is_drawn_whatever_way_the_words_lead(block):
    (answer,) = contoursolve.solve(block, start="X40. Z0.").answers
    assert "end (free)" in words_in(draw_answer(answer))


@pytest.mark.parametrize("name", ["parallel", "missed"])
def test_the_end_is_shown_only_where_the_path_gets_there(name):
    (answer,) = answers_of(name)
    assert not any(word.startswith("end") for word in words_in(draw_answer(answer)))


def test_what_words_leave_free_is_never_shown_as_worked_out():
    (arc,) = contoursolve.solve("G112 U0 I? K-30. R32. P3. Q3.", start="X60. Z-44.").answers
    words = words_in(draw_answer(arc))
    assert {"V1", "V2", "end (free)"} <= set(words)
    (rounding,) = contoursolve.solve("G111 X100. A180. K-30. B120. P? Q5.", start="X40. Z0.").answers
    words = words_in(draw_answer(rounding))
    assert not any(word.startswith("end") for word in words)  # it lies behind Q5., which is not worked out


def test_a_drawing_in_inches_says_so():
    inches, millimetres = (words_in(draw_answer(*answers_of(name))) for name in ("inches", "solved"))
    assert {"X (diameter, inch)", "Z (inch)"} <= set(inches)
    assert {"X (diameter)", "Z"} <= set(millimetres)


@pytest.mark.parametrize(
    ("dialect", "rule", "program", "is_right"),
    [
        pytest.param(*each.values, id=each.id, marks=[pytest.mark.slow] * (number % 20 > 0))
        for number, each in enumerate(WRONG[::2])
    ],
)
def test_what_a_rule_refuses_is_drawn(dialect, rule, program, is_right):
    result = try_example(dialect, rule, program)
    check(draw_result(result))
    for answer in result.answers:
        check(draw_answer(answer))
        check_radii(answer)
        assert_errors_have_one_colour(answer)


def assert_errors_have_one_colour(answer):
    """All words that one error is about are marked, or none of them; what was probably meant is beside."""
    blamed = subject_of(answer).blamed
    words = {word.span for block in answer.claim.blocks for word in block.words}
    for finding in (each for each in answer.diagnostics if each.severity is Severity.ERROR):
        about = {label.span for label in finding.labels if "probably" not in label.text} & words
        assert len({span in blamed for span in about}) <= 1, finding


def random_block(draw: random.Random) -> tuple[str, str]:
    """Any words of G111 at any size, and a start point."""
    size = 10.0 ** draw.uniform(-3, 5)
    letters = draw.sample("XUZWABIKPQCD", draw.randrange(2, 9))
    angles = (0, 45, 90, 120, 180, -30, 359.999)
    words = [
        f"{letter}{draw.choice(angles) if letter in 'AB' else draw.uniform(-size, size):.4f}" for letter in letters
    ]
    return f"G111 {' '.join(words)}", f"X{draw.uniform(0, size):.4f} Z{draw.uniform(-size, size):.4f}"


HOSTILE = "(]]></svg><script>alert[1]</script> & \" ' \x0b \ud800 \u202e $x^2$ {0} %s \\ <!-- )"


@pytest.mark.parametrize(
    ("seed", "count"), [(0, 8), *(pytest.param(seed, 20, marks=pytest.mark.slow) for seed in range(8))]
)
def test_random_blocks_of_every_status_are_drawn(seed, count):
    draw, statuses = random.Random(seed), set()
    for number in range(count):
        if number % 2:
            text, start = random_block(draw)
            result = contoursolve.solve(
                f"{text} {HOSTILE}",
                start=start,
                rules=draw.choice(("enforce", "off")),
                depth=draw.choice(("full", "verdict")),
            )
        else:
            control = draw.choice(CONTROLS)
            text = draw.choice(examples(control))
            for _ in range(draw.randrange(1, 4)):
                text = mutate(text, draw)
            result = contoursolve.solve(text, control=control, rules=draw.choice(("enforce", "off")))
        for answer in result.answers:
            statuses.add(answer.status.value)
            check(draw_answer(answer, theme=draw.choice(list(Theme))))
    assert len(statuses) > min(3, count // 8)


def labels(picture: Picture) -> list[str]:
    return [text.words for text in picture.sheet.texts]


def test_shown_numbers_are_those_of_the_contour():
    draw = random.Random(5)
    for _ in range(40):
        angles = f"A{draw.uniform(140, 200):.1f} B{draw.uniform(100, 150):.1f}"
        words = f"{angles} K-{draw.uniform(20, 40):.2f} X{draw.uniform(120, 200):.2f}"
        answer = contoursolve.solve(f"G111 {words} P1. Q2.", start="X40. Z0.").answers[0]
        if answer.contour is None:
            continue
        shown = labels(draw_answer(answer))
        for name, at in {"end": answer.contour.end, **answer.contour.points}.items():
            (label,) = [text for text in shown if text.startswith(f"{name}  ")]
            z, x = map(float, re.fullmatch(rf"{name}  Z(\S+) X(\S+)", label).groups())
            assert (z, x / 2) == pytest.approx(at, abs=6e-4)


def test_inches_are_shown_as_the_program_has_them():
    (answer,) = answers_of("inches")
    assert "end  Z-1.6928 X4" in labels(draw_answer(answer))
    assert answer.contour.end[0] / 25.4 == pytest.approx(-1.6928, abs=5e-5)


def roles_of(name: str) -> dict[str, Role]:
    """The roles of what is written in the drawing."""
    (answer,) = answers_of(name)
    sheet = draw_answer(answer).sheet
    return {run.text.strip(): run.role for text in sheet.drawing if isinstance(text, Text) for run in text.runs}


@pytest.mark.parametrize(
    ("name", "text", "role"),
    [
        ("solved", "A180.", Role.GIVEN),
        ("bevels", "C5. x 45°", Role.GIVEN),
        ("ignored", "A135.", Role.IGNORED),
        ("ignored", "1.414 off", Role.IGNORED),
        ("ignored", "5 off", Role.IGNORED),
        ("corner too large", "P4. (max 2.5)", Role.CONFLICTING),
        ("parallel", "30 apart", Role.CONFLICTING),
        ("missed", "22.125 off", Role.CONFLICTING),
        ("conflicting", "1.414 off", Role.CONFLICTING),
        ("radii differ", "2 off", Role.CONFLICTING),
        ("apart", "130.998 off", Role.CONFLICTING),
        ("free", "end (free)", Role.FREE),
        ("asked", "P = 25.359", Role.DERIVED),
        ("ambiguous", "Q-1", Role.CANDIDATE),
        ("ambiguous", "Q1", Role.CANDIDATE),
        ("circle-line", "Q-1", Role.GIVEN),
        ("G18", ",A171.87", Role.GIVEN),
    ],
)
def test_each_word_and_each_gap_is_shown_in_its_state(name, text, role):
    assert roles_of(name).get(text) is role


def test_what_is_free_has_arrows_and_other_completions_that_were_solved():
    (answer,) = answers_of("free")
    strokes = [item for item in draw_answer(answer).sheet.drawing if isinstance(item, Stroke)]
    assert sum(stroke.role is Role.GHOST for stroke in strokes) == 3
    arrows = [stroke for stroke in strokes if stroke.role is Role.FREE and not stroke.dash]
    assert {round(stroke.start[1] - stroke.steps[0][1], 6) for stroke in arrows} == {0.0}  # along Z


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


def test_states_are_told_apart_without_colour():
    states = (Role.GIVEN, Role.DERIVED, Role.IGNORED, Role.CONFLICTING, Role.FREE, Role.GHOST, Role.MUTED)
    assert len({DASHES.get(role, ()) for role in states}) == len(states)


@pytest.mark.parametrize("count", [6, 100])
def test_several_pictures_stand_in_one_page(count):
    names = [
        each.get("id")
        for name in list(KINDS)[:count]
        for each in check(draw_answer(answers_of(name)[0], theme=Theme.PAGE)).iter()
        if each.get("id")
    ]
    assert len(names) == len(set(names))


def test_a_page_can_colour_its_pictures_and_a_file_needs_no_style_sheet():
    (answer,) = answers_of("solved")
    page, file = (draw_answer(answer, theme=theme).svg for theme in (Theme.PAGE, Theme.DARK))
    (name,) = re.findall(r'^<svg[^>]* id="([^"]+)"', page)
    assert f"#{name} .f-ink{{fill:var(--cs-ink,{LIGHT_COLORS[Role.INK]})}}" in page
    assert f"@media (prefers-color-scheme:dark){{#{name} .s-paper" in page
    assert not re.search("<style|class=|var", file)
    assert DARK_COLORS[Role.PAPER] in file
    # Where style sheets are taken out, a page has the light picture.
    plain = re.sub(r'<style>.*?</style>| (?:class|data-[a-z]+)="[^"]*"', "", page)
    assert re.sub(name, "", plain) == re.sub("cs-[0-9a-f]{12}", "", draw_answer(answer).svg)


def test_text_of_a_program_is_escaped():
    text = f"G111 X100. A180. K-30. B120. P5. {HOSTILE}"
    (answer,) = contoursolve.solve(text, start="X40. Z0.", facts=["line 2 passes through (Z-47.3205 X100.)"]).answers
    picture = draw_answer(answer, title="<b>&\"'\x00\udcff")  # a file's name may be no Unicode
    tree = check(picture)
    assert tree[0].text == "<b>&\"'��"
    tags = "svg title desc defs clipPath rect g path polygon circle text tspan"
    assert {each.tag for each in tree.iter()} <= {f"{SVG}{tag}" for tag in tags.split()}
    assert picture.png(50)


@pytest.mark.slow
def test_the_same_contour_gives_the_same_bytes_in_every_process():
    program = (
        "import contoursolve, sys; from contoursolve.pictures import draw_result; "
        "p = draw_result(contoursolve.solve_file(sys.argv[1])); sys.stdout.buffer.write(p.svg.encode() + p.png(60))"
    )
    found = {
        subprocess.run(
            [sys.executable, "-c", program, str(PROGRAMS[0])],
            check=True,
            capture_output=True,
            env={**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": ":".join(sys.path)},
        ).stdout
        for seed in ("0", "7")
    }
    assert len(found) == 1


def test_a_png_has_the_size_that_is_asked_for():
    picture = draw_answer(answers_of("solved")[0])
    for dpi in (48, 96, 200):
        data = picture.png(dpi)
        assert data.startswith(b"\x89PNG")
        size = struct.unpack(">II", data[16:24])
        assert size == pytest.approx((picture.width * dpi / PIXELS, picture.height * dpi / PIXELS), abs=1)
        assert b"tIME" not in data
        place = data.index(b"pHYs") + 4
        assert struct.unpack(">IIB", data[place : place + 9]) == (round(dpi / 0.0254), round(dpi / 0.0254), 1)
        assert picture.title.encode() in data[: data.index(b"IDAT")]
    for wrong in (0, -1, 1e9, float("nan")):
        with pytest.raises(ValueError, match="cannot be painted"):
            picture.png(wrong)


def test_a_png_without_a_font_for_its_texts_is_refused(monkeypatch):
    monkeypatch.setattr("contoursolve.pictures.svg._has_fonts", lambda: False)
    with pytest.raises(contoursolve.MissingExtraError, match="needs a font"):
        draw_answer(answers_of("solved")[0]).png()


@pytest.mark.slow
def test_svg_needs_no_package_and_png_names_the_one_it_needs(monkeypatch):
    program = (
        "import sys, contoursolve; from contoursolve.pictures import draw_answer\n"
        "a = contoursolve.solve('G111 X100. A180. K-30. B120.', start='X40. Z0.').answers[0]\n"
        "draw_answer(a).svg; print(*({'resvg_py', 'sympy', 'scipy', 'PIL'} & sys.modules.keys()))"
    )
    assert subprocess.run([sys.executable, "-c", program], check=True, capture_output=True).stdout.split() == []
    monkeypatch.setitem(sys.modules, "resvg_py", None)
    with pytest.raises(ImportError, match=r'-m pip install "contoursolve\[picture\]"'):
        draw_answer(answers_of("solved")[0]).png()


@pytest.mark.slow
def test_a_picture_takes_less_than_25_ms_of_the_processor():
    for name in ("solved", "ignored", "ambiguous", "G112"):
        (answer,) = answers_of(name)
        times = []
        for _ in range(20):
            begin = time.process_time()
            draw_answer(answer)
            times.append(time.process_time() - begin)
        assert min(times) < 0.025


def test_arcs_keep_their_radius_and_sense():
    (answer,) = answers_of("G112")
    tree = check(draw_answer(answer))
    paths = [each.get("d") for each in tree.iter(f"{SVG}path") if each.get("stroke-width") == "2.6"]
    assert len(paths) == len(answer.contour.elements)
    arcs = re.findall(r"A([\d.]+) [\d.]+ 0 ([01]) ([01])", "".join(paths))
    wanted = [each for each in answer.contour.elements if isinstance(each, ArcSegment)]
    scale = float(arcs[0][0]) / wanted[0].radius
    assert len(arcs) == len(wanted)
    for (radius, large, clockwise), element in zip(arcs, wanted, strict=True):
        assert float(radius) == pytest.approx(element.radius * scale, rel=1e-2)
        assert (large, clockwise) == (str(int(element.sweep > 180)), str(int(element.turn.value == "cw")))


def test_a_program_without_a_contour_says_what_is_wrong_with_it():
    result = contoursolve.solve("G00 X40. Z0.\nG01 X50. F0.2\nG02 X50. Z0. R10.", control="yasnac-lx3")
    picture = draw_result(result)
    check(picture)
    told = labels(picture)
    assert "The program has no contour." in told
    assert not picture.sheet.drawing


@pytest.mark.parametrize(
    ("text", "start", "names"),
    [
        ("G111 A180. K-30. B120. X10000000000.", "X40. Z0.", {"V1"}),
        ("G112 U0 I10. K-50. R-30.", "X100. Z-50.", {"V1", "V2"}),
    ],
)
def test_a_path_that_is_known_in_part_has_no_end(text, start, names):
    (answer,) = contoursolve.solve(text, start=start).answers
    said = {each.split()[0] for each in labels(draw_answer(answer))}
    assert names < said
    assert "end" not in said


def test_a_fact_is_drawn_where_it_belongs_and_its_gap_where_it_fails():
    text = "G111 A180. K-30. B120. X100. (contoursolve: line 2 passes through [Z-40. X80.])"
    (answer,) = contoursolve.solve(text, start="X40. Z0.").answers
    picture = draw_answer(answer)
    check(picture)
    # From V1, on a line at 120 deg, it is 10 mm back and 20 mm up: 20 cos 60 - 10 sin 60 = 1.340 mm beside it.
    assert "1.34 off" in labels(picture)
    red = [run.text for each in picture.sheet.texts for run in each.runs if run.role is Role.CONFLICTING]
    assert sum("line 2 passes through" in each for each in red) == 3  # in the block, at the place, in the finding
    (answer,) = contoursolve.solve(text.replace("B120. ", ""), start="X40. Z0.").answers
    picture = draw_answer(answer)
    check(picture)
    assert not any("off" in each for each in labels(picture))


def test_what_is_wrong_is_in_the_picture_however_short_the_path():
    (answer,) = contoursolve.solve("G112 U-60. I10. K-50. R30.", start="X100. Z-50.").answers
    told = " ".join(labels(draw_answer(answer)))
    assert "10 off" in told
    assert "no room" not in told


def test_words_are_blamed_unless_others_are_missing_beside_them():
    def red(text, start="X30. Z0."):
        (answer,) = contoursolve.solve(text, start=start, control="yasnac-lx3").answers
        first = draw_answer(answer).sheet.around
        runs = [run for each in first if isinstance(each, Text) and each.is_mono for run in each.runs]
        return {run.text for run in runs if run.role is Role.CONFLICTING}

    assert red("G12 U50. W-20. K8.") == {"U50.", "W-20."}
    assert red("G112 U0 I10. K0 R30.", "X100. Z-50.") == {"K0"}
    assert red("G111 X100. A180. B120.") == set()
    assert red("G12 W-20.") == set()


def radii_of(answer):
    """The words of a contour that point at arcs, with where they point from: their centres."""
    return [(each, each.center) for each in compose(answer).each(Leader) if each.center is not None]


def check_radii(answer):
    """Each leader of a radius lies on a ray through the centre (ISO 129), and no text on the mark of a centre."""
    sheet = draw_answer(answer).sheet
    if sheet.placement is None:
        return 0
    view, count = sheet.placement.view, 0
    for leader, center in radii_of(answer):
        (x, y), size = view.place(center), leader.text
        if size not in {text.words for text in sheet.drawing if isinstance(text, Text)}:
            continue  # it had no room, or stands in a detail
        rays = [
            item
            for item in sheet.drawing
            if isinstance(item, Stroke)
            and item.width == 0.9
            and item.about == leader.about
            and item.role is leader.role
        ]
        assert rays, size
        for ray in rays:
            (a, b), (c, d) = ray.start, ray.steps[0]
            length = math.hypot(c - a, d - b)
            assert abs((c - a) * (y - b) - (d - b) * (x - a)) / length < 0.02 * max(1.0, math.hypot(x - a, y - b) / 100)
            radius = math.hypot(c - x, d - y)
            assert radius == pytest.approx(view.scale * math.dist(leader.at, center), rel=1e-6)
            count += 1
    crosses = [view.place(mark.at) for mark in compose(answer).each(Mark) if mark.kind is MarkKind.CENTER]
    for text in (item for item in sheet.drawing if isinstance(item, Text)):
        assert not any(text.box.meets(Box(x - 4, y - 4, x + 4, y + 4)) for x, y in crosses), text
    return count


@pytest.mark.slow
def test_radii_point_through_their_centres_and_no_text_lies_on_the_mark_of_one():
    answers = [answer for path in PROGRAMS for answer in contoursolve.solve_file(path).answers]
    assert sum(map(check_radii, [*answers, *(answer for name in KINDS for answer in answers_of(name))])) > 30


CROWDED = "G00 X40 Z2\nG111 A180 K-30 B120 X100"
"""Without points it is hardly larger than the mark of a point."""


@pytest.mark.slow
def test_no_label_lies_along_a_path():
    crowded = contoursolve.solve(CROWDED, control="yasnac-lx3").answers
    for answer in [*crowded, *(answer for name in KINDS for answer in answers_of(name))]:
        drawing = draw_answer(answer).sheet.drawing
        paths = [item for item in drawing if isinstance(item, Stroke) and item.width >= 2.2]
        ends = [(path.start, path.steps[0]) for path in paths if not isinstance(path.steps[0], Sweep)]
        for text in (item for item in drawing if isinstance(item, Text)):
            covered = [clip(*each, text.box) for each in ends]
            assert all(part is None or math.dist(*part) < 70 for part in covered), text


@pytest.mark.parametrize("angle", ["A0.", "A360.", "A1."])
def test_an_angle_of_0_has_an_arrow_beside_the_line(angle):
    (answer,) = contoursolve.solve(f"G111 X100. {angle} K30. B60. P5.", start="X40. Z0.").answers
    drawing = draw_answer(answer).sheet.drawing
    (text,) = [item for item in drawing if isinstance(item, Text) and item.words == angle]
    (arrow,) = [
        item for item in drawing if isinstance(item, Shape) and item.role is Role.GIVEN and item.about == text.about
    ]
    (line,) = [
        item for item in drawing if isinstance(item, Stroke) and item.role is Role.GIVEN and item.about == text.about
    ]
    assert arrow.corners[0] == line.steps[0]
    assert line.steps[0][0] > line.start[0] + 20
    start = draw_answer(answer).sheet.placement.view.place(answer.contour.start)
    assert 5 < abs(line.start[1] - start[1]) < 15  # off the path


def underlined(picture):
    """The words at fault, by where they are: in the block, in the drawing."""
    return [
        {run.text.strip() for item in items if isinstance(item, Text) for run in item.runs if run.is_underlined}
        for items in (picture.sheet.around, picture.sheet.drawing)
    ]


@pytest.mark.parametrize(
    ("block", "in_block", "drawn"),
    [
        ("G111 Z-95 A180. X100. B120.", {"Z-95"}, {"Z-95 = -0.095 mm"}),
        ("G111 X100 A180. K-30. B120. P5.", {"X100"}, {"X100 = 0.100 mm dia"}),
        ("G111 X100. A180. K-30 B120. P5.", {"K-30"}, {"K-30 = -0.030 mm"}),
        ("G111 X100. A180. K-30. B120. Z-95", {"Z-95"}, {"Z-95 = -0.095 mm"}),
        ("G111 X100. A180. K-30. B120. P5", set(), set()),
        # Its point would not mend this one.
        ("G111 Z95 A180. X100. B120.", {"A180."}, {"A180."}),
        ("G111 X100. A180. K-30. B120. E7.", {"E7."}, set()),
        ("G111 X100. A180. K-30. B12O.", {"B12O."}, {"B12"}),
        ("G111 X100. A180. K-30. B120. B130.", {"B120.", "B130."}, {"B120."}),
    ],
)
def test_what_is_at_fault_is_marked_and_not_what_disagrees_with_it(block, in_block, drawn):
    (answer,) = contoursolve.solve(block, start="X40. Z0.").answers
    picture = draw_answer(answer)
    check(picture)
    lines, inside = underlined(picture)
    assert "".join(sorted(lines)) == "".join(sorted(in_block))  # one that is read in part is in two
    assert inside == drawn


# Families.

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."


def test_a_map_names_every_outcome_with_its_boundary():
    family = contoursolve.family(
        BLOCK, start=START, vary={"A": numpy.arange(100, 260, 1.0), "P": numpy.arange(0, 40, 0.5)}
    )
    picture = draw_family_map(family)
    check(picture)
    told = " ".join(labels(picture))
    for name in ("solved", "line reversed", "corner too large", "corners overlap", "A [deg]", "P [mm]"):
        assert name in told
    turned = draw_family_map(family, ("P", "A"), theme=Theme.PAGE)
    assert check(turned).tag
    assert turned.sheet != picture.sheet
    with pytest.raises(ValueError, match="a grid of two words"):
        draw_family_map(contoursolve.family(BLOCK, start=START, vary={"A": [170, 180]}))
    with pytest.raises(ValueError, match="a grid of two words"):
        draw_family_map(family, ("A", "Q"))


def lines_of(picture, width):
    """The lines of a map or a region, as places on the page."""
    return [
        numpy.array([item.start, *item.steps])
        for item in picture.sheet.drawing
        if isinstance(item, Stroke) and item.width == width
    ]


def spot_of(values, within):
    """Where two values are on a page whose plane covers a box: 610 by 400 pixels from (92, 56)."""
    across, up = ((value - low) / (high - low) for value, (low, high) in zip(values, within, strict=True))
    return 92 + 610 * across, 56 + 400 * (1 - up)


PAIR = CIRCLE + "G1 X-50 Y42.857 ,A171.87 Q-1"
REGIONS = {
    "too large": (BLOCK, {"A": (150.0, 210.0), "P": (1.0, 60.0)}, {"start": START}),
    "two angles": (BLOCK, {"A": (91.0, 269.0), "B": (90.0, 200.0)}, {"start": START}),
    "a rule": (BLOCK, {"P": (-10.0, 60.0), "Q": (-10.0, 60.0)}, {"start": START}),
    "a circle": (PAIR, {"R": (40.0, 80.0), ",A": (150.0, 179.0)}, {}),
}


TWO_REGIONS = [pytest.param(n, marks=[pytest.mark.slow] * (n != "two angles")) for n in REGIONS]


@pytest.mark.parametrize("name", TWO_REGIONS)
def test_the_lines_of_a_map_part_values_that_have_a_contour_from_those_that_have_none(name):
    block, within, options = REGIONS[name]
    axes = {word: numpy.linspace(*ends, 61) for word, ends in within.items()}
    family = contoursolve.family(block, vary=axes, **options)
    picture = draw_family_map(family)
    check(picture)
    drawn = lines_of(picture, width=3.0)
    assert drawn
    # The middles of the outer cells are half a cell from the frame.
    half = {word: (high - low) / 120 for word, (low, high) in within.items()}
    whole = [(low - half[word], high + half[word]) for word, (low, high) in within.items()]
    # Where cells beside each other are not alike, a line runs where the contour begins to exist between their middles.
    spots = numpy.concatenate([dense(line) for line in drawn])
    (one, first), (two, second) = axes.items()
    rows, columns = numpy.nonzero(family.has_contour[:-1] != family.has_contour[1:])
    fine = first[rows, None] + (first[1] - first[0]) * numpy.linspace(0, 1, 65)
    vary = {one: fine.ravel(), two: numpy.repeat(second[columns], fine.shape[1])}
    is_solved = contoursolve.family(block, vary=vary, paired=True, **options).has_contour.reshape(fine.shape)
    for values, solved, column in zip(fine, is_solved, columns, strict=True):
        edges = values[:-1][solved[1:] != solved[:-1]]
        nearest = min(numpy.hypot(*(spots - spot_of((edge, second[column]), whole)).T).min() for edge in edges)
        assert nearest < 2, (edges, second[column])


def dense(line):
    steps = numpy.concatenate([[0], numpy.cumsum(numpy.hypot(*numpy.diff(line, axis=0).T))])
    along = numpy.linspace(0, steps[-1], int(steps[-1]) + 2)
    return numpy.stack([numpy.interp(along, steps, line[:, axis]) for axis in (0, 1)], axis=1)


def fields_of(picture):
    """The fields of a map or a region, with what each is painted as."""
    shapes = (item for item in picture.sheet.drawing if isinstance(item, Shape) and "field" in item.role.value)
    return [(Box(*shape.corners[0], *shape.corners[2]), shape.role) for shape in shapes]


def has_contour(block, within, spots, options):
    """Which places of a page whose plane covers a box have a contour, solved for their values."""
    values = {
        word: low + share * (high - low)
        for (word, (low, high)), share in zip(
            within.items(), ((spots[:, 0] - 92) / 610, (456 - spots[:, 1]) / 400), strict=True
        )
    }
    return contoursolve.family(block, vary=values, paired=True, **options).has_contour


@pytest.mark.parametrize("name", TWO_REGIONS)
def test_the_fields_of_a_region_are_painted_as_single_solves_tell_and_none_has_the_name_of_another(name):
    block, within, options = REGIONS[name]
    found = contoursolve.families.region(block, tuple(within), tuple(within.values()), **options)
    for theme in (Theme.LIGHT, Theme.PAGE):
        picture = draw_region(found, theme=theme)
        check(picture)
    assert len(lines_of(picture, width=3.0)) == len(found.boundaries)
    told = " ".join(labels(picture))
    assert all(word in told for each in found.boundaries for word in each.reason.text.split())
    fields, draw = fields_of(picture), random.Random(3)
    lines = numpy.concatenate([dense(line) for line in lines_of(picture, width=3.0)])
    spots = numpy.array([(draw.uniform(92, 702), draw.uniform(56, 456)) for _ in range(300)])
    spots = numpy.array([spot for spot in spots if numpy.hypot(*(lines - spot).T).min() > 2.5])  # the lines cover it
    for (x, y), is_solved in zip(spots, has_contour(block, within, spots, options), strict=True):
        role = [role for box, role in fields if box.left <= x <= box.right and box.top <= y <= box.bottom][-1]
        assert (role is Role.SOLVED_FIELD) == is_solved, (x, y)
    assert_names_stand_in_their_fields(picture, block, within, options)


def assert_names_stand_in_their_fields(picture, block, within, options):
    """No text in the plane of a page covers a place with a contour but `solved`, and what the block has."""
    names = [each for each in picture.sheet.texts if Box(92, 56, 702, 456).holds(each.box)]
    assert names
    for text in names:
        left, top, right, bottom = text.box
        grid = numpy.meshgrid(numpy.linspace(left, right, 12), numpy.linspace(top, bottom, 12))
        solved = has_contour(block, within, numpy.stack([each.ravel() for each in grid], axis=1), options)
        if text.runs[0].role is not Role.GIVEN:
            assert solved.all() if text.words == "solved" else not solved.any(), text


@pytest.mark.slow
def test_names_of_maps_stand_in_their_fields_and_never_where_there_is_a_contour():
    for block, within, options in REGIONS.values():
        for across, up in ((61, 61), (140, 90)):
            # Values in the middles of the cells, so that the whole plane is the box.
            shares = [(numpy.arange(count) + 0.5) / count for count in (across, up)]
            cells = [low + share * (high - low) for (low, high), share in zip(within.values(), shares, strict=True)]
            family = contoursolve.family(block, vary=dict(zip(within, cells, strict=True)), **options)
            assert_names_stand_in_their_fields(draw_family_map(family), block, within, options)


def test_a_map_of_many_even_values_has_even_axes_and_counts_all_of_them():
    values = {"A": numpy.linspace(150, 210, 401), "P": numpy.linspace(1, 60, 237)}
    family = contoursolve.family(BLOCK, start=START, vary=values)
    for words in (("A", "P"), ("P", "A")):
        picture = draw_family_map(family, words)
        check(picture)
        ticks = [text for text in picture.sheet.texts if re.fullmatch(r"\d+", text.words) and text.at[1] > 470]
        steps = numpy.diff([text.at[0] for text in ticks])
        assert len(ticks) > 3
        assert steps == pytest.approx(steps[0], abs=1e-6)
    told = ", ".join(f"{number:,} {contoursolve.status_text(status)}" for status, number in family.summary().items())
    assert picture.title == f"P and A: {told}"
    assert "drawn: 200 of 401 values of A; the title counts all contours" in labels(picture)
    # A sweep draws the same from the values that it draws alone.
    ready = contoursolve.families.sweep(BLOCK, start=START, vary=values)
    assert draw_sweep(ready).sheet == draw_family_map(family).sheet
    fan = draw_sweep(contoursolve.families.sweep(BLOCK, start=START, vary={"A": numpy.arange(120, 250.1, 2)}))
    counts = contoursolve.family(BLOCK, start=START, vary={"A": numpy.arange(120, 250.1, 2)}).summary()
    assert fan.title == f"A from 120 to 250, 66 contours (21 drawn): {statuses_text(counts)}"


def test_an_axis_says_that_its_values_are_diameters():
    vary = {"X": numpy.linspace(60, 120, 20), "K": numpy.linspace(-40, -20, 20)}
    shown = set(labels(draw_family_map(contoursolve.family(BLOCK, start=START, vary=vary))))
    shown |= set(labels(draw_range(contoursolve.feasible(BLOCK, "X", start=START))))
    assert {"X diameter [mm]", "K [mm]"} <= shown
    assert "X diameter [mm]" in labels(
        draw_region(contoursolve.region(BLOCK, ("X", "K"), ((60, 120), (-40, -20)), start=START))
    )


def test_where_every_value_is_refused_a_region_says_so():
    found = contoursolve.region(BLOCK, ("P", "Q"), ((-9.0, -5.0), (-9.0, -5.0)), start=START)
    picture = draw_region(found)
    check(picture)
    assert picture.title == "P and Q: no contour at every value sampled"
    assert {role for _, role in fields_of(picture)} <= {Role.REFUSED_FIELD, Role.OTHER_FIELD}


def test_what_is_refused_is_painted_as_refused_though_words_agree():
    block = "G111 A135. I10. K-10. B120. Z-40."
    vary = {"B": numpy.arange(10.0, 90.0, 5), "I": [10.0, 10.0001]}
    found = contoursolve.family(block, start=START, rules="off", vary=vary)
    assert (found["status"] == StatusCode.OVERDETERMINED).all()
    assert not numpy.isfinite(found["V2.X"]).any()
    picture = draw_family_map(found)
    shapes = [item for item in picture.sheet.drawing if isinstance(item, Shape)]
    assert {shape.role for shape in shapes} == {Role.REFUSED_FIELD}


def test_a_bar_shows_the_ranges_of_a_word_with_what_ends_them():
    found = contoursolve.families.feasible(BLOCK, "P", start=START)
    picture = draw_range(found)
    check(picture)
    told = " ".join(labels(picture))
    assert "P is too large for line 1: P at most 51.961 mm" in told
    assert "the block has 5.0000 mm" in told


@pytest.mark.parametrize("word", [",A", "R"])
def test_what_ends_a_range_is_told_in_full(word):
    found = contoursolve.feasible(PAIR, word)
    told = " ".join(labels(draw_range(found)))
    reasons = [end.reason.text for each in found.intervals for end in (each.low, each.high) if end.reason is not None]
    assert reasons
    assert all(" ".join(reason.split()) in told for reason in reasons)


def test_a_map_of_one_value_each_and_one_of_many_are_drawn():
    for count in (1, 2, 700):
        values = numpy.linspace(3.0, 4.0, count)
        family = contoursolve.family(BLOCK, start=START, vary={"P": values, "Q": values})
        check(draw_family_map(family))


def test_a_fan_shows_each_contour_and_names_where_the_outcome_changes():
    values = [120.0, 130.0, 140.0, 150.0, 160.0, 180.0, 200.0]
    answers = [contoursolve.solve(BLOCK.replace("A180.", f"A{value}"), start=START).answers[0] for value in values]
    picture = draw_family_fan("A", values, answers)
    check(picture)
    assert {"A120", "A140", "A200"} <= set(labels(picture))
    with pytest.raises(ValueError, match="a value for each"):
        draw_family_fan("A", values[:2], answers)
    with pytest.raises(ValueError, match="cannot be read"):
        draw_family_fan("A", values * 9, answers * 9)


def sweep(*arguments):
    done = CliRunner().invoke(main, ["sweep", "--block", BLOCK, "--start", START, *map(str, arguments)])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.exit_code, done.output


@pytest.mark.slow
def test_sweep_draws_one_word_as_a_fan_and_two_as_a_map(tmp_path):
    one = ("--vary", "A=120:250:2", "--vary", "Q=5")
    status, output = sweep(*one, "--plot", tmp_path / "fan.svg")
    assert (status, "fan.svg written" in output) == (0, True)
    assert "A from 120 to 250, 66 contours (21 drawn): " in (tmp_path / "fan.svg").read_text()
    assert sweep(*one, "--plot", tmp_path / "fan.svg", "--force", "--theme", "dark")[0] == 0
    assert DARK_COLORS[Role.PAPER] in (tmp_path / "fan.svg").read_text()
    both = (*one, "--vary", "P=1:60:0.5")
    status, output = sweep(*both, "--plot", tmp_path / "map.png")
    assert status == 0
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")
    assert sweep(*both, "--plot", tmp_path / "room.svg", "--result", "line 1.room")[0] == 0
    assert "line 1.room [mm]: from " in (tmp_path / "room.svg").read_text()
    assert "name its file with --plot" in sweep(*both, "--result", "V2.Z")[1]
    family = contoursolve.family(
        BLOCK, start=START, vary={"A": numpy.arange(120, 250.1, 2), "P": numpy.arange(1, 60.1, 0.5), "Q": [5.0]}
    )
    told = ", ".join(f"{number:,} {contoursolve.status_text(status)}" for status, number in family.summary().items())
    assert draw_family_map(family).title == f"A and P: {told}"
    for wrong, said in (
        ((*both, "--vary", "X=90,100"), "has 3 words"),
        (("--vary", "A=170"), "has 0 words"),
        (("--vary", "A=170,180", "--vary", "P=1,2", "--paired"), "has paired words"),
        ((*both, "--result", "V9.Z"), "there is no result V9.Z; did you mean"),
        ((*one, "--result", "V2.Z"), "a map of V2.Z takes two words that vary"),
    ):
        status, output = sweep(*wrong, "--plot", tmp_path / "no.svg")
        assert status == 2
        assert said in output
    assert sweep(*one, "--plot", tmp_path / "fan.svg")[0] == 2
    assert "pictures end in .svg or .png" in sweep(*one, "--plot", tmp_path / "fan.pdf")[1]
    assert not (tmp_path / "no.svg").exists()


# Sketches.


def apollonius():
    """Three circles, and one that touches all of them."""
    sketch = contoursolve.Sketch()
    for name, center, radius in (("a", (0, 0), 10), ("b", (40, 5), 8), ("c", (18, 35), 6)):
        sketch.circle(name, center, radius)
    sketch.circle("k")
    for name in "abc":
        sketch.state(f"k tangent to {name}")
    return sketch


def rings_of(picture, role):
    """Centres and radii of the whole circles in a role, pixels."""
    strokes = [item for item in picture.sheet.drawing if isinstance(item, Stroke) and item.role is role]
    sweeps = [item.steps[0] for item in strokes if isinstance(item.steps[0], Sweep)]
    return [(*sweep.center, sweep.radius) for sweep in sweeps if abs(sweep.angle) == pytest.approx(2 * math.pi)]


def test_all_circles_that_touch_three_are_drawn_where_they_touch_and_labelled():
    sketch = apollonius()
    drawings, picture = sketch.solve(), draw(sketch)
    check(picture)
    assert picture.sheet == draw(drawings).sheet
    given, found = rings_of(picture, Role.GIVEN), rings_of(picture, Role.CANDIDATE)
    assert (len(given), len(found)) == (3, len(drawings))
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
    assert {"text/plain", "text/html", "image/svg+xml"} <= shown.keys()
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
    inside = {text.words for text in picture.sheet.drawing if isinstance(text, Text)}
    assert {"length of a = 8", "length of b = 7", "length of c = 5", "direction of a = 0"} <= inside
    assert {"1: P2  X12.5 Y24.33", "2: P2  X12.5 Y15.67", "P1  X18 Y20"} <= inside
    one = draw(drawings[0])
    check(one)
    assert "P2  X12.5 Y24.33" in labels(one)
    assert "direction of c = -120" in labels(one)
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
    assert {"n parallel to m at 7", "3"} <= {text.words for text in picture.sheet.drawing if isinstance(text, Text)}


def test_how_far_a_line_passes_from_a_place_is_a_dimension():
    fact = "line 2 passes beside [Z-40. X80.] at 2"
    (answer,) = contoursolve.solve("G111 X100. A180. K-30.", start="X40. Z0.", facts=[fact]).answers
    picture = draw_answer(answer)
    check(picture)
    assert "2" in {text.words for text in picture.sheet.drawing if isinstance(text, Text)}


# The command.


def plot(*arguments, **options):
    done = CliRunner().invoke(main, ["plot", *map(str, arguments)], **options)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.exit_code, done.output


SHAFT = next(path for path in PROGRAMS if path.stem == "shaft")


def test_plot_writes_an_svg_of_the_whole_program_with_its_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, output = plot(SHAFT)
    assert status == 0
    assert "shaft.svg: 7 contours" in output
    written = Path("shaft.svg").read_bytes()
    assert written == draw_result(contoursolve.solve_file(SHAFT)).svg.encode()
    assert plot(SHAFT)[0] == 0
    Path("shaft.svg").write_text("mine")
    assert plot(SHAFT)[0] == 2
    assert Path("shaft.svg").read_text() == "mine"
    assert plot(SHAFT, "--force")[0] == 0
    assert plot("--block", BLOCK, "--start", START)[0] == 0
    assert Path("contour.svg").is_file()


def test_plot_writes_one_contour_or_each_in_the_theme_that_is_asked_for(tmp_path):
    result = contoursolve.solve_file(SHAFT)
    status, output = plot(SHAFT, "--line", 69, "-o", tmp_path / "a.PNG", "--theme", "dark")
    assert (status, "a.PNG: program line 69, solved" in output) == (0, True)
    wanted = next(answer for answer in result.answers if answer.lines[0] == 69)
    assert (tmp_path / "a.PNG").read_bytes() == draw_answer(wanted, theme=Theme.DARK).png()
    status, output = plot(SHAFT, "--each", "-o", tmp_path / "b.svg")
    assert sorted(path.name for path in tmp_path.glob("b*")) == sorted(
        f"b-{answer.lines[0]}.svg" for answer in result.answers
    )
    status, output = plot(SHAFT, "--line", 1, "-o", tmp_path / "c.svg")
    assert status == 2
    assert "program line 1 belongs to no contour; contours begin in program lines 53, 67" in output
    assert not (tmp_path / "c.svg").exists()
    for wrong in (("--line", 69, "--each"), ("--each", "-o", "x.dxf"), ("--line", 69, "-o", "x.dxf")):
        assert plot(SHAFT, *wrong)[0] == 2


def test_plot_draws_what_cannot_be_solved_and_says_so(tmp_path):
    target = tmp_path / "broken.svg"
    status, output = plot("--block", "G111 X100. A180. K-30. B180.", "--start", START, "-o", target)
    assert status == 1
    assert "30 apart" in target.read_text()
    assert "1 contour without a solution" in output
    status, output = plot("--block", "G00 X1.", "--start", START, "--control", "yasnac-lx3", "-o", tmp_path / "no.svg")
    assert status == 1
    assert "no.svg: not written" in output


def test_plot_of_a_png_without_resvg_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "resvg_py", None)
    status, output = plot(SHAFT, "-o", tmp_path / "a.png")
    assert status == 2
    assert f'{sys.executable} -m pip install "contoursolve[picture]"' in output
    assert not (tmp_path / "a.png").exists()


def test_what_words_fix_at_no_value_is_drawn_as_free():
    text = "G111 A180. I0 B120. X100."
    (answer,) = contoursolve.solve(text, start=START, rules="off").answers
    assert answer.status is contoursolve.Status.UNDERDETERMINED
    assert "end (free)" in labels(draw_answer(answer))


def test_a_crowded_drawing_says_what_it_leaves_out():
    blocks = [f"G1 X{10 * (number + 1)} Y{7 * (number % 2)} ,R1" for number in range(40)]
    (answer,) = contoursolve.solve("G17 G90 G0 X0 Y0\n" + "\n".join([*blocks, "G1 X500 Y0"]), control="nct-99m").answers
    picture = draw_answer(answer)
    check(picture)
    assert any("words are not drawn" in text for text in labels(picture))
    assert {"start", "end"} <= set(labels(picture))


def test_moves_that_lead_to_a_contour_are_in_the_picture_of_its_program():
    text = "G00 X60. Z5.\nG01 X40. F0.2\nZ0.\n" + BLOCK + "\nG01 Z-90.\nG00 X80.\n" + BLOCK.replace("X100.", "X150.")
    result = contoursolve.solve(text, control="yasnac-lx3")
    strokes = [item for item in draw_result(result).sheet.drawing if isinstance(item, Stroke) and item.width > 1]
    assert [stroke.role for stroke in strokes].count(Role.INK) == 2 + 3  # two contours; X40., Z0. and Z-90.
    rapid = [stroke for stroke in strokes if stroke.role is Role.RAPID]
    assert len(rapid) == 1  # to X80.; nobody knows where that to X60. begins
    assert all(stroke.dash for stroke in rapid)
    assert {"feed move", "rapid move"} <= set(labels(draw_result(result)))


def test_a_word_without_a_point_where_nothing_else_is_known_keeps_its_picture():
    for text in ("G1 X30 ,C10\nX40 Y40", "G00 X20. Z0.\nG01 Z-20 ,R2\nX40 ,A100"):
        for control in ("fanuc-mill", "fanuc-lathe", "nct-99m"):
            for answer in contoursolve.solve(text, control=control).answers:
                check(draw_answer(answer))


def test_contours_between_which_nothing_chooses_look_alike_whatever_else_is_wrong():
    text = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87"
    for more, is_open in (("", True), (" Q-1", False)):
        for rules in ("enforce", "off"):
            (answer,) = contoursolve.solve(text + more, control="nct-99m", rules=rules).answers
            picture = draw_answer(answer)
            roles = {item.role for item in picture.sheet.drawing if isinstance(item, Stroke) and item.width > 2}
            assert roles == ({Role.CANDIDATE} if is_open else {Role.INK}), (more, rules)
            labels = [text.words for text in picture.sheet.texts]
            assert not is_open or all(any(each.startswith(name) for each in labels) for name in ("P1  Q1 ", "P1  Q-1 "))
