"""What Python takes along: points of a contour, files of pictures and drawings, families as tables."""

from itertools import pairwise
from math import dist

import pytest

import contoursolve
from contoursolve.output import to_dxf
from contoursolve.pictures import draw_answer

SHAFT, START = "G111 X100. A180. K-30. B120. P5.", "X40. Z0."


def test_points_along_a_contour_miss_its_arcs_by_no_more_than_the_chord_error():
    contour = contoursolve.solve(SHAFT, start=START).answers[0].contour
    arc = next(each for each in contour.elements if each.name == "corner 1")
    for error in (1.0, 0.01, 0.001):
        points = contour.sample(error)
        assert (points[0], points[-1]) == (contour.start, contour.end)
        on_arc = [at for at in points if abs(dist(at, arc.center) - arc.radius) < 1e-9]
        middles = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in pairwise(on_arc)]
        off = max(arc.radius - dist(at, arc.center) for at in middles)
        assert off <= error + 1e-12
        assert len(on_arc) == 2 or error / 4 < off
    with pytest.raises(ValueError, match="more than 0 mm, not 0"):
        contour.sample(0)


@pytest.mark.needs("resvg_py", "ezdxf")
def test_a_picture_is_saved_by_the_ending_of_its_name(tmp_path):
    answers = contoursolve.solve(SHAFT, start=START).answers
    picture = draw_answer(answers[0])
    picture.save(tmp_path / "a.svg")
    assert (tmp_path / "a.svg").read_text(encoding="utf-8").startswith("<svg ")
    picture.save(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes()[1:4] == b"PNG"
    with pytest.raises(ValueError, match=r"contoursolve\.export"):
        picture.save(tmp_path / "a.dxf")
    assert to_dxf(answers).split()[1] == b"SECTION"


@pytest.mark.needs("pyarrow")
def test_a_family_is_a_stream_of_arrow():
    import pyarrow  # noqa: PLC0415

    family = contoursolve.family(SHAFT, start=START, vary={"A": [170.0, 180.0]})
    table = pyarrow.table(family)
    assert table.num_rows == 2
    assert table.equals(family.to_arrow())
