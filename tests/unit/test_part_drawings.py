"""The drawing of a whole program: no text meets a text, a line of the path or an arrow; its numbers are the part's."""

import json
from itertools import combinations
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

import contoursolve
from contoursolve.errors import UnknownControlError
from contoursolve.pictures.labels import clip
from contoursolve.pictures.page import Shape, Stroke, Sweep, Text

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
    return contoursolve.solve("\n".join(texts), control=control)


PROGRAMS = sorted(
    each for each in (ROOT / "docs" / "programs").iterdir() if each.suffix in (".nc", ".h", ".mpf") and each.is_file()
)


@pytest.mark.parametrize("file", PROGRAMS, ids=lambda each: each.name)
def test_no_label_of_our_own_programs_meets_a_label_or_a_line(file):
    try:
        result = contoursolve.solve(file)
    except UnknownControlError as error:
        result = contoursolve.solve(file, control=error.choices[0])
    for is_whole in (True, False, None):
        assert not meetings(contoursolve.draw(result, is_whole=is_whole))


@pytest.mark.parametrize("file", sorted((ROOT / "docs" / "vectors").glob("*.json")), ids=lambda each: each.stem)
def test_no_label_of_crowded_programs_meets_a_label_or_a_line(file):
    told = json.loads(file.read_text(encoding="utf-8"))
    for first in range(0, 24, 6):
        rows = [row for row in told["vectors"] if row.get("program")][first : first + 6]
        if rows:
            result = several_contours(rows, told["control"])
            if len(result.answers) > 1:
                assert not meetings(contoursolve.draw(result))


STEPS = st.lists(
    st.tuples(st.integers(1, 40), st.integers(0, 30), st.sampled_from(["", ",R1.", ",C1.", ",R0.4", ",C0.5"])),
    min_size=2,
    max_size=14,
)


@settings(max_examples=12, deadline=None, derandomize=True)
@given(STEPS)
def test_no_label_of_a_drawn_shaft_meets_a_label_or_a_line(steps):
    """Shafts with steps, tapers and corners; each length and each diameter of the program stands once."""
    blocks, z, x, path = ["G00 X20. Z2.", "G01 Z0."], 0, 20, []
    for along, up, corner in steps:
        z, x = z - along, x + 2 * up
        path.append(f"G01 X{x}. Z{z}. {corner}" if len(path) % 2 else f"G01 X{x}. {corner}\nZ{z}. {corner}")
    picture = contoursolve.draw(contoursolve.solve("\n".join([*blocks, *path]), control="fanuc-lathe"))
    assert not meetings(picture)
