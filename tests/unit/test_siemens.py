"""SINUMERIK: every worked example of its sheet, right and wrong, how it is spelled, its settings, RNDM and CT."""

import re
from math import dist

import pytest
from examples import law
from hypothesis import strategies as st
from oracle import Element, elements_of
from vectors import program_of

from contoursolve import expand, solve
from contoursolve.comparison import compare, follow
from contoursolve.controls import CONTROLS
from contoursolve.gcode import parse
from contoursolve.geometry import Length
from contoursolve.program import Request, run as run_program

NAMED = ("siemens-840d", "siemens-808d")
MILL = "G17 G90 G0 X0 Y0\n"
SI_G4 = program_of(NAMED[0], "SI-G4")


def siemens(text: str, control: str = NAMED[0], depth: str = "full", **settings: str):
    named = {f"{control}.{name.replace('_', '-')}": value for name, value in settings.items()}
    return solve(text, control=control, settings=named, depth=depth)


def path(text: str, control: str = NAMED[0], **settings: str) -> list[Element]:
    """All contours, one behind the other; they have no errors."""
    result = siemens(text, control, **settings)
    assert not result.has_errors, [each.message for each in result.diagnostics]
    return [element for answer in result.answers for element in elements_of(answer)]


def ends(text: str, **settings: str) -> list[tuple[float, float]]:
    return [(each.end.real, each.end.imag) for each in path(text, **settings)]


def followed(text: str):
    """The whole path of a program."""
    control = CONTROLS[NAMED[0]]
    return follow(run_program(parse(text), Request(control, Length.MM)), control, Length.MM, control.modes.axes)


def near(*places: tuple[float, float]):
    return [pytest.approx(place, abs=1e-4) for place in places]


@law(st.floats(0.01, 9), st.sampled_from(["", " CHF"]), few=2, many=3)
def test_the_face_of_a_chamfer_beside_an_arc_has_its_length_between_ends_as_far_from_the_corner(face, behind):
    text = MILL + f"G1 X40 CHF={face:.6f}\nG2 X60 Y20 I20 J0{behind and behind + f'={face / 2:.6f}'}\nG1 X100 Y30"
    (answer,) = siemens(text).answers
    lengths = iter((round(face, 6), round(face / 2, 6)))
    for corner in (each for each in answer.contour.elements if each.name.startswith("corner")):
        at = answer.contour.points[f"V{corner.name[-1]}"]
        assert dist(corner.start, corner.end) == pytest.approx(next(lengths), abs=1e-9)
        assert dist(corner.start, at) == pytest.approx(dist(corner.end, at), abs=1e-9)


# Planes and diameters -----------------------------------------------------------------------------------------------


def test_x_is_what_its_command_says():
    def diameters(head: str, tail: str = "G1 X40 Z-30 RND=2\nZ-50", **settings: str):
        return ends(f"{head} G90 G0 X20 Z0\n{tail}", **settings)

    as_radius = diameters("G18 DIAMOF")
    as_diameter = ends("G18 DIAMOF G90 G0 X10 Z0\nG1 X20 Z-30 RND=2\nZ-50")
    assert diameters("G18 DIAMON") == near(*as_diameter)
    assert diameters("G18 DIAM90") == near(*as_diameter)
    assert diameters("G18 DIAM90", "G1 X=IC(20) Z-30 RND=2\nZ-50")[0] != pytest.approx(as_diameter[0])
    assert diameters("G18 DIAM90", "G91 G1 X10 Z-30 RND=2\nZ-20") == near(*as_diameter)
    assert diameters("G18 DIAMON", "G91 G1 X20 Z-30 RND=2\nZ-20") == near(*as_diameter)
    # Nothing tells: the plane does, and the result rests on it.
    assert diameters("G18") == near(*as_diameter)
    (answer,) = siemens("G18 G90 G0 X20 Z0\nG1 X40 Z-30 RND=2\nZ-50").answers
    assert [each.setting.name for each in answer.claim.conventions] == ["diam"]
    for value, expected in (("DIAMOF", as_radius), ("DIAMON", as_diameter), ("DIAM90", as_diameter)):
        assert diameters("G18", diam=value) == near(*expected)
    assert ends("G0 X20 Z0\nG1 X40 Z-30 RND=2\nZ-50", machine="lathe") == near(*as_diameter)
    assert ends("G0 X20 Z0\nG1 X40 Z-30 RND=2\nZ-50") == near(*as_diameter)
    assert siemens("G0 X20 Z0\nG1 X40 Z-30 RND=2\nZ-50", machine="mill").answers[0].contour is None


X_WORDS = ("X50", "X=AC(50)", "X=DAC(50)", "X=RAC(25)", "X=DIC(10)", "X=RIC(5)", "G91 X5", "G91 X=DAC(50)")


@pytest.mark.parametrize("word", X_WORDS)
def test_under_diam90_coordinates_and_increments_make_one_contour_and_a_word_may_say_what_it_is(word):
    text = "G18 G90 DIAM90\nG0 X40 Z2\nG1 Z-10 F0.2 RND=0.5\n{} RND=1\nG90 Z-30 RND=1\n{}\nM30\n"
    plain, meant = text.format("X50", "X60"), text.format(word, "G91 X5" if "G91" in word else "X=DIC(10)")
    assert path(meant) == path(plain)
    written = expand(meant, control=NAMED[0]).text
    assert compare(*(followed(text) for text in (plain, written)), 0.001).is_equal
    assert path(meant.replace("DIAM90", "DIAMON").replace("X5 ", "X10 ").replace("X5\n", "X10\n")) == path(plain)


@pytest.mark.parametrize(
    "text",
    ["G0 X30 {}=5\nY40\nG1 X60", "G1 X30 {}=5\nG0 Y40", "G0 X30 {}=5\nG1 Y40", "G0 X30 {}=5\nM8\nG0 Y40"],
)
@pytest.mark.parametrize("word", ["RND", "CHR", "CHF"])
def test_the_808d_makes_corners_beside_rapids_and_larger_ones_where_that_is_set(text, word):
    text = MILL + text.format(word)
    made, plain = path(text, NAMED[1]), path(text.replace("G0 X30", "G1 X30").replace("G0 Y40", "G1 Y40"))
    assert made[:3] == plain[:3]
    assert path(text, rapid_corner="made") == made
    assert siemens(text).has_errors
    assert siemens(text, NAMED[1], rapid_corner="error").diagnostics


@pytest.mark.parametrize("behind", ["M30", "M8\n" * 4 + "Y40", "G18\nX40 Z40"])
@pytest.mark.parametrize("word", ["RND", "CHR", "CHF"])
def test_the_808d_leaves_out_a_corner_without_a_second_move(word, behind):
    text = f"{MILL}G1 X10\nX30 {word}=5\n{behind}"
    result = siemens(text, NAMED[1])
    assert [each.code for each in result.diagnostics] == [f"siemens-{word.lower()}-left-out"]
    (answer,) = result.answers
    assert [(each.kind, each.end) for each in elements_of(answer)] == [("line", 30 + 0j)]
    for refusing in (siemens(text), siemens(text, NAMED[1], no_second_move="error")):
        assert refusing.has_errors


# Settings -----------------------------------------------------------------------------------------------------------


def test_a_polar_move_is_no_part_of_a_contour():
    for text in ("G1 AP=30 RP=20 RND=5\nX40", "G1 X30 RND=5\nAP=90 RP=50\nX20"):
        assert not any(each.contour for each in siemens(MILL + text).answers), text


# RNDM and CT --------------------------------------------------------------------------------------------------------


def test_a_tangent_arc_straight_ahead_is_a_line_and_one_behind_is_none():
    assert path(MILL + "G1 X10 Y10\nCT X20 Y20\nX30 Y20") == path(MILL + "G1 X10 Y10 RND=0\nG1 X20 Y20\nCT X30 Y20")
    for text in ("CT X5", "CT X10", "CT"):
        assert siemens(MILL + "G1 X10\n" + text).answers[0].contour is None, text


@pytest.mark.parametrize("text", ["RND=6", "ANG=30"])
def test_three_blocks_may_stand_between_and_not_four(text):
    chain = SI_G4.replace("RND=6\n", "RND=6\n{}")
    assert ends(chain.format("M8\nG4 F1\nS200\n")) == ends(chain.format("")) == ends(chain.format("; A\n\n" * 5))
    result = siemens(chain.format("M8\n" * 4))
    assert result.has_errors
    assert all(each.contour is None for each in result.answers)


def test_a_long_stream_keeps_a_rounding_in_force():
    text = MILL + "RNDM=2\nG1 X10\nX10 Y10\nX20 Y10\nX20 Y0\nX30\nG0 X0 Y0\nM30\n"
    moves = re.findall(r"^G0[123].*$", expand(text, control=NAMED[0]).text, re.MULTILINE)
    turns = [each.split()[0] for each in moves if each.startswith(("G02", "G03"))]
    assert turns == ["G03", "G02", "G02", "G03"], "left at 10 0, right at 10 10 and 20 10, left at 20 0"


# Laws ---------------------------------------------------------------------------------------------------------------


def test_an_increment_from_an_unknown_start_leads_to_no_place():
    text = "G17 G90 G0 X=R1 Y=R1\nG91 G1 ANG=30 RND=1\nX116 Y115.4 ANG=120\nG0 X5\nG1 Y94 RND=1\nX20"
    assert [(each.code, each.span.line) for each in siemens(text).diagnostics] == [
        ("start-relative", 2),
        ("start-relative", 5),
    ]


def test_where_a_corner_is_not_made_the_words_of_the_end_still_say_where_it_is():
    head, tail = "G18 G90 DIAMON G54\nG0 X16 Z0\nG1 X20\nZ-25 RND=9\nX30 CHR=1\nZ-40\n", "X40 ANG=150\nM30"
    wrong, last = solve(head + tail, control="siemens-840d").answers
    assert wrong.contour is None
    assert last.start.values == (-40, 15)
    # An increment from a place that is not known leads to none.
    unknown = "G17 G90 G54\nG0 X=R1 Y=R1\nG91 G1 ANG=30 RND=1\nX100 Y100 ANG=120\nG1 X10 RND=2\nY10\nM30"
    first, second = solve(unknown, control="siemens-840d").answers
    assert first.start.is_relative
    assert second.start.is_relative


def test_an_arc_by_its_opening_angle_is_read_and_the_next_contour_begins_behind_it():
    arcs = "G17 G90 G71\nG0 X0 Y0\nG2 I10 J0 AR=90\n{}\nG1 X30 RND=3\nY50"
    result = siemens(arcs.format("CIP X20 Y20 I1=15 J1=19"))
    assert result.answers[0].start.values == (20, 20)
    assert not result.diagnostics
    assert [each.code for each in siemens(arcs.format("G2 I5 AR=360")).diagnostics] == ["arc-opening-angle"]
    assert [each.code for each in siemens(arcs.format("CIP X20 Y20 I1=15 J1=15")).diagnostics] == ["arc-in-line"]


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("G1 X20 RND=5\nSUB1\nM30\nPROC SUB1\nY20\nRET", "a corner"),
        ("SUB1\nY20\nM30\nPROC SUB1\nG1 X20 RND=5\nRET", "a corner"),
        ("G1 ANG=30\nSUB1\nM30\nPROC SUB1\nX60 Y20 ANG=90\nRET", "a line by its angle alone"),
    ],
)
def test_what_goes_on_behind_a_call_is_refused_for_that(text, what):
    told = solve(f"G17 G90 G54\nG0 X0 Y0\n{text}", control="siemens-840d").diagnostics
    first = next(each for each in told if each.is_error)
    assert (first.code, first.fixes) == ("not-read", ())
    assert first.message == f"contoursolve does not read {what} right before a call or a return yet"
