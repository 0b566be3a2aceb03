"""Contours and maps on axes of matplotlib: every place that is drawn is one of the contour."""

import sys
from math import hypot

import numpy
import pytest

import contoursolve

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
MILL = "G17 G41 D0 G0 X-30 Y60\nG1 ,A180 ,R3\nG3 X-85 Y50 I-60 J50 R25 Q-1\nG1 X-75 Y0 ,A-90 Q1"


@pytest.fixture
def ax():
    figure = pytest.importorskip("matplotlib.figure").Figure()
    return figure.subplots()


def contour_of(block, start=None):
    return contoursolve.solve(block, start=start).answers[0].contour


@pytest.mark.needs("matplotlib")
@pytest.mark.parametrize(("block", "start"), [(BLOCK, START), (MILL, None)], ids=["lathe", "mill"])
def test_a_contour_is_one_line_as_near_to_it_as_asked(ax, block, start):
    contour = contour_of(block, start)
    assert contour.plot(ax, chord_error=0.001, label="a part", color="red") is ax
    (line,) = ax.lines
    assert (line.get_label(), line.get_color(), ax.get_aspect()) == ("a part", "red", 1.0)
    points = line.get_xydata()
    assert tuple(points[0]) == contour.start
    assert tuple(points[-1]) == contour.end
    arcs = [each for each in contour.elements if hasattr(each, "radius")]
    for arc in arcs:
        off = numpy.hypot(*(points - arc.center).T) - arc.radius
        own = points[numpy.abs(off) < 1e-9]
        middles = (own[1:] + own[:-1]) / 2
        near = [each for each in middles if hypot(*(each - arc.center)) < arc.radius]
        assert all(arc.radius - hypot(*(each - arc.center)) <= 0.001 + 1e-12 for each in near)
        assert len(own) > 5
    # Names and numbers are the machine's, places are those of the contour.
    if start:
        assert (ax.get_xlabel(), ax.get_ylabel()) == ("Z [mm]", "X [mm, diameter]")
        assert ax.yaxis.get_major_formatter()(50.0, 0) == "100"
    else:
        assert (ax.get_xlabel(), ax.get_ylabel()) == ("X [mm]", "Y [mm]")


@pytest.mark.needs("matplotlib")
def test_a_region_and_a_family_are_drawn_beside_what_is_there(ax):
    region = contoursolve.region(BLOCK, ("A", "P"), ((150, 210), (1, 60)), start=START)
    ax.plot([160], [10], label="mine")
    assert region.plot(ax, result="length") is ax
    labels = [line.get_label() for line in ax.lines]
    assert labels == ["mine", *(each.reason.text for each in region.boundaries), "the block"]
    assert [tuple(each) for each in ax.lines[1].get_xydata()] == list(region.boundaries[0].points)
    assert (ax.get_xlabel(), ax.get_ylabel(), ax.get_title()) == ("A [deg]", "P [mm]", "length [mm]")
    vary = {"A": numpy.linspace(150, 210, 31), "P": numpy.linspace(1, 60, 29)}
    family = contoursolve.family(BLOCK, start=START, vary=vary)
    other = type(ax.figure)().subplots()
    for options in ({}, {"result": "V1.Z"}, {"result": "end.Z", "words": ("P", "A")}):
        other.clear()
        assert family.plot(other, **options) is other
    assert (other.get_xlabel(), other.get_ylim()) == ("P [mm]", (150.0, 210.0))
    with pytest.raises(contoursolve.FamilyError, match="did you mean end"):
        family.plot(other, result="end.Y")
    with pytest.raises(TypeError, match="ax is axes of matplotlib"):
        family.plot([other])
    one = contoursolve.family(BLOCK, start=START, vary={"A": [170], "P": [1, 2]})
    with pytest.raises(ValueError, match="two or more values"):
        one.plot(other, words=("A", "P"))


def test_without_matplotlib_its_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(contoursolve.MissingExtraError, match=r'needs matplotlib; .* "contoursolve\[plot\]"'):
        contour_of(BLOCK, START).plot()
