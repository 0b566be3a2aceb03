"""The drawing of a whole program: no text meets a text, a line of the path or an arrow; its numbers are the part's."""

import json
from itertools import combinations
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

import contoursolve
from contoursolve.diagnosis import list_solutions
from contoursolve.errors import UnknownControlError
from contoursolve.pictures.labels import clip
from contoursolve.pictures.page import Shape, Stroke, Sweep, Text
from contoursolve.pictures.theme import Role
from contoursolve.pictures.two_solutions import two_solutions

ROOT = Path(__file__).parents[2]


def meetings(picture) -> list[str]:
    """The texts of a picture that meet another text, a thick line, or the tip or edge of an arrow."""
    items = (*picture.sheet.drawing, *picture.sheet.around)
    texts = [(each.words, each.box) for each in items if isinstance(each, Text)]
    found = [f"{a} | {b}" for (a, one), (b, other) in combinations(texts, 2) if one.meets(other)]
    lines = []
    for each in picture.sheet.drawing:
        if isinstance(each, Stroke) and each.width > 1.35:
            here = each.start
            for step in each.steps:
                for spot in step.spots(here, 48) if isinstance(step, Sweep) else [step]:
                    lines.append((here, spot))
                    here = spot
        elif isinstance(each, Shape) and len(each.corners) == 3:
            lines += [(each.corners[place - 1], at) for place, at in enumerate(each.corners)]
    for words, box in texts[: len(texts)]:
        if any(clip(a, b, box) is not None for a, b in lines):
            found.append(f"{words} | a line")
    return found


def several_contours(rows, control):
    """Programs of the test vectors, one after the other: many contours beside and over one another."""
    texts = ["\n".join(row["program"]) for row in rows]
    return contoursolve.solve("\n".join(texts), control=control, depth="verdict")


PROGRAMS = sorted(
    each for each in (ROOT / "docs" / "programs").iterdir() if each.suffix in (".nc", ".h", ".mpf") and each.is_file()
)


@pytest.mark.parametrize("file", PROGRAMS, ids=lambda each: each.name)
def test_no_label_of_our_own_programs_meets_a_label_or_a_line(file):
    try:
        result = contoursolve.solve(file)
    except UnknownControlError as error:
        result = contoursolve.solve(file, control=error.choices[0])
    for is_whole in (True, False) if len(result.answers) > 1 else ():
        assert not meetings(contoursolve.draw(result, is_whole=is_whole))


VECTORS = [each for each in sorted((ROOT / "docs" / "vectors").glob("*.json")) if each.stem != "schema"]


@pytest.mark.parametrize("file", VECTORS, ids=lambda each: each.stem)
def test_no_label_of_crowded_programs_meets_a_label_or_a_line(file):
    told = json.loads(file.read_text(encoding="utf-8"))
    result = several_contours([row for row in told["vectors"] if row.get("program")][:6], told["control"])
    assert len(result.answers) > 1
    assert not meetings(contoursolve.draw(result))


STEPS = st.lists(
    st.tuples(st.integers(1, 40), st.integers(0, 30), st.sampled_from(["", ",R1.", ",C1.", ",R0.4", ",C0.5"])),
    min_size=2,
    max_size=14,
)


@settings(max_examples=6, deadline=None, derandomize=True)
@given(STEPS)
def test_no_label_of_a_drawn_shaft_meets_a_label_or_a_line(steps):
    """Shafts with steps, tapers and corners; each length and each diameter of the program stands once."""
    blocks, z, x, path = ["G00 X20. Z2.", "G01 Z0."], 0, 20, []
    for along, up, corner in steps:
        z, x = z - along, x + 2 * up
        path.append(f"G01 X{x}. Z{z}. {corner}" if len(path) % 2 else f"G01 X{x}. {corner}\nZ{z}. {corner}")
    picture = contoursolve.draw(contoursolve.solve("\n".join([*blocks, *path]), control="fanuc-lathe"))
    assert not meetings(picture)


def test_the_drawing_of_a_shaft_has_every_number_once_and_what_is_worked_out_in_parentheses():
    text = """G00 X16. Z3.
G01 Z0. F0.15
X20. ,C1.
Z-25. ,R3.
X30. ,C1.
Z-40.
X40. ,A150.
G01 Z-60.
"""
    picture = contoursolve.draw(contoursolve.solve(text, control="fanuc-lathe"), is_whole=True)
    told = [each.words for each in (*picture.sheet.drawing, *picture.sheet.around) if isinstance(each, Text)]
    for words in ("Ø20", "Ø30", "Ø40", "0", "25", "40", "(48.66)", "60", "R3", "30°"):
        assert told.count(words) == 1, words
    assert told.count("1\N{MULTIPLICATION SIGN}45°") == 2


def test_two_solutions_are_taken_apart_as_a_and_b():
    """What both have is drawn once; what one of two has alone is in its colour, and has its letter there."""
    text = """BEGIN PGM 1 MM
L X+0 Y+10 RL F400
FL AN+60
FC DR- R20 CCX+40 CCY+50
FLT
FCT DR- R10 CCX+85 CCY+25
FLT X+60 Y+5
END PGM 1 MM
"""
    both = two_solutions(contoursolve.solve(text, control="heidenhain").answers[0])
    lengths = {role: sum(s.length for t in both.trails if t.role is role for s in t.segments) for role in Role}
    one, other = (each.contour.length for each in list_solutions(contoursolve.solve(text).answers[0]))
    shared = lengths[Role.DETERMINED]
    assert shared + lengths[Role.SOLUTION_A] == pytest.approx(one)
    assert shared + lengths[Role.SOLUTION_B] == pytest.approx(other)
    assert [mark.label[0].text for mark in both.marks] == ["A", "B"]
