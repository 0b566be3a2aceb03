"""Pictures: every contour is drawn, labels stand apart, numbers are the contour's, and any reader can see it."""

import os
import random
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from test_fuzz import mutate, windows
from test_rules import examine, examples

import contoursolve
from contoursolve.pictures import Picture, Theme, draw_answer, draw_result
from contoursolve.pictures.sheet import Box

PROGRAMS = sorted((Path(__file__).parent.parent / "notebooks" / "programs").glob("*.nc"))
RANDOM = int(os.environ.get("CONTOURSOLVE_PICTURES", "240"))
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
    page = Box(0.0, 0.0, sheet.width, sheet.height)
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


@pytest.mark.parametrize(("control", "code", "program"), examples("rejected"))
def test_what_a_rule_refuses_is_drawn(control, code, program):
    result = examine(program, control)
    check(draw_result(result))


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


@pytest.mark.parametrize("seed", range(8))
def test_random_blocks_of_every_status_are_drawn(seed):
    draw, statuses = random.Random(seed), set()
    near = windows()
    for number in range(RANDOM // 8):
        if number % 2:
            text, start = random_block(draw)
            result = contoursolve.solve(
                f"{text} {HOSTILE}",
                start=start,
                rules=draw.choice(("enforce", "off")),
                depth=draw.choice(("full", "verdict")),
            )
        else:
            text, control = draw.choice(near)
            for _ in range(draw.randrange(1, 4)):
                text = mutate(text, draw)
            result = contoursolve.solve(text, control=control, rules=draw.choice(("enforce", "off")))
        for answer in result.answers:
            statuses.add(answer.status.value)
            check(draw_answer(answer, theme=draw.choice(list(Theme))))
    assert len(statuses) > 3
