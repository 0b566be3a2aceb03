"""Mitsubishi: what its settings and letters mean, what it refuses, and laws against closed forms."""

from random import Random

import pytest
from examples import law
from hypothesis import strategies as st
from oracle_mitsubishi import FORMS, random_block
from vectors import program_of

from contoursolve import solve
from contoursolve.errors import UnknownControlError

CROSSING, ARCS, LEVER = (program_of("mitsubishi", name) for name in ("MI-G3-H0", "MI-G5", "MI-G6"))
MILL = "G17 G90 G00 X0 Y0\n"
PLANES = {17: "XYIJ", 18: "ZXKI", 19: "YZJK"}


def mitsubishi(text: str, **settings: str):
    names = {f"mitsubishi.{name.replace('_', '-')}": value for name, value in settings.items()}
    return solve(text, control="mitsubishi", settings=names)


def elements(text: str, **settings: str):
    """The elements of all contours."""
    result = mitsubishi(text, **settings)
    assert not result.has_errors, [each.message for each in result.diagnostics]
    return [each for answer in result.answers for each in answer.contour.elements]


def ends(text: str, **settings: str):
    return [each.end for each in elements(text, **settings)]


def turned(text: str, plane: int) -> str:
    """The same blocks with the letters of another plane."""
    return text.replace("G17", f"G{plane}").translate(str.maketrans("XYIJ", PLANES[plane]))


def test_sweeps_are_those_of_the_sheet():
    first, second = (each for each in elements(ARCS) if hasattr(each, "center"))
    assert (abs(first.sweep), abs(second.sweep)) == pytest.approx((101.388, 141.427), abs=1e-3)
    *_, other = elements(ARCS.replace("R25", "R-25"))
    assert (*other.center, abs(other.sweep)) == pytest.approx((45.0483, 61.5539, 218.573), abs=1e-3)


@pytest.mark.parametrize(
    ("words", "kept"),
    [("X30. ,C5. ,R2.", ",R2."), (",C5. X30. ,R2.", ",R2."), (",C5. ,R2. X30.", ",R2."), ("X30. ,R2. ,C5.", ",C5.")],
)
def test_the_last_of_two_corner_words_is_made_wherever_else_in_the_block_they_stand(words, kept):
    text = MILL + "G01 {}\nX40. Y40."
    made = elements(text.format(words))
    assert made == elements(text.format(f"X30. {kept}"))
    found = mitsubishi(text.format(words)).diagnostics
    assert [each.code.rpartition("-")[2] for each in found] == ["replaced"]
    refused = mitsubishi(text.format(words), two_corner_words="error")
    assert [each.code for each in refused.diagnostics][:1] == ["mitsubishi-two-corners"]


@pytest.mark.parametrize(
    ("text", "number"),
    [("G01 X30. ,R5.\nM30", "P382"), ("G01 X3. ,R5.\nY40.", "P383"), ("G01 X30. ,R5.\nY3.", "P383")],
)
def test_a_corner_that_does_not_fit_has_its_alarm(text, number):
    (alarm,) = {each.alarm.number.split()[0] for each in mitsubishi(MILL + text).diagnostics if each.alarm}
    assert alarm == number


@pytest.mark.parametrize("plane", PLANES)
def test_a_centre_by_p_and_q_is_absolute(plane):
    """P is for I and Q for K; in G17 Q is for J, in G19 P is for J."""
    text = turned("G17 G90 G00 X5. Y3.\nG03 I30. J-2. H0\nG01 X20. Y-60. A-80.", plane)
    first, second = ("Q", "P") if plane == 18 else ("P", "Q")
    absolute = text.replace(f"{PLANES[plane][2]}30.", f"{first}35.").replace(f"{PLANES[plane][3]}-2.", f"{second}1.")
    assert ends(absolute) == ends(text) == ends(absolute, first_centre="end", arc_without_end="circle")
    assert ends(absolute.replace("H0", "H1")) == ends(text.replace("H0", "H1")) != ends(text)
    assert ends(absolute.replace(" H0", "")) == ends(text)
    told = {each.code for each in mitsubishi(absolute.replace(" H0", ""), h_default="error").diagnostics}
    assert "mitsubishi-h-missing" in told
    if plane == 18:
        told = {each.code for each in mitsubishi(absolute, diameter="on").diagnostics}
        assert "mitsubishi-centre-of-diameter" in told


def test_h_beside_an_arc_shows_the_control_and_other_words_do_not():
    assert solve(CROSSING).control == "mitsubishi"
    assert solve(MILL + "G01 X40. A30.\nG00 X0 Y0 A90.").control is None
    assert solve("G17 G90 G43 H5 G00 X0 Y0\nG02 X10. Y0 R5.").control is None
    with pytest.raises(UnknownControlError):
        solve(LEVER)


# Against closed forms ---------------------------------------------------------------------------------------------


@law(st.integers(0, 10**9), st.sampled_from(FORMS), st.integers(0, 5), few=2)
def test_a_word_that_is_lost_makes_no_other_contour(seed, form, number):
    drawn = random_block(Random(seed), form)
    head, first, second = drawn.text.split("\n")
    words = [word for word in second.split() if word[0] != "G"]
    lost = words[number % len(words)]
    if lost[0] == "H" or (lost[0] in "IJ" and sum(word[0] in "IJ" for word in words) > 1):
        return  # it has a value without it
    text = "\n".join((head, first, " ".join(word for word in second.split() if word != lost)))
    result = mitsubishi(text)
    assert result.has_errors or not result.answers, text
