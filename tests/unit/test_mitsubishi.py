"""Mitsubishi: what its settings and letters mean, what it refuses, and laws against closed forms."""

from dataclasses import replace
from random import Random

import pytest
from examples import law
from hypothesis import strategies as st
from oracle_mitsubishi import FORMS, random_block
from vectors import VECTORS, ends as ends_of, program_of

from contoursolve import DIALECTS, UnknownControlError, solve

VERTEX, CROSSING, ARCS, LEVER = (program_of("mitsubishi", name) for name in ("MI-G2", "MI-G3-H0", "MI-G5", "MI-G6"))
MILL = "G17 G90 G00 X0 Y0\n"
LEAVING = MILL + "G03 I30. J0 H0\nG01 X20. Y-60. A-90."
KNOWN_ARCS = ARCS.replace("R25.", "I-16.083 J-19.14")
APART = KNOWN_ARCS.replace("-16.083", "-16.133")
CORNER_ON_ARC = MILL + "G01 X40. ,C6.\nG02 X60. Y20. I20. J0"
INSIDE = CROSSING.replace("X60. Y15.", "X40. Y20.")
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


def near(*places: tuple[float, float]):
    return [pytest.approx(each, abs=1e-4) for each in places]


def turned(text: str, plane: int) -> str:
    """The same blocks with the letters of another plane."""
    return text.replace("G17", f"G{plane}").translate(str.maketrans("XYIJ", PLANES[plane]))


@pytest.mark.parametrize(
    ("text", "settings", "places"),
    [
        (MILL + "G01 X40. A-150.", {}, [(40, 23.0940)]),
        (MILL + "G01 X40. A390.", {}, [(40, 23.0940)]),
        (MILL + "G01 X40. Y20. A30. ,R2.\nX60. Y20.", {}, [(39.5777, 19.7889), (40.4721, 20), (60, 20)]),
        # From inside a circle the shorter line counts, whichever way it runs.
        (INSIDE, {}, [(-10.9836, 3.0633), (40, 20)]),
        (INSIDE.replace("H0", "H1"), {}, [(46.3572, 13.1740), (40, 20)]),
        (MILL + "G05 P2\nG01 X10. Y5.\nG05 P0\nX40. A30.", {}, [(40, 22.3205)]),
        (MILL + "G05 P2\nG01 X10. Y5.\nX40. ,R2.\nY40.", {}, [(38, 5), (40, 7), (40, 40)]),
        ("G90 G00 X20. Z0\nG01 X40. A90.", {"diameter": "on"}, [(0, 20)]),
        ("G18 G90 G00 X20. Z10.\nG01 A70.\nX50. Z80. A-30.", {"diameter": "on"}, [(26.6669, 55.7919), (80, 25)]),
        (MILL + "G01 X40 A45", {}, [(40, 40)]),
        (MILL + "G01 X40 A45", {"number": "increment"}, [(0.04, 0.04 * 0.00078540)]),
        (MILL + "G01 X30. ,C5.\nX40. Y40.", {"corner": "I", "chamfer_on_arc": "arc_length"},
         [(25, 0), (31.2127, 4.8507), (40, 40)]),
        (APART, {"contact_tol": "0.1"}, None),
    ],
)  # fmt: skip
def test_words_mean_what_the_settings_say(text, settings, places):
    assert ends(text, **settings) == (
        near(*places) if places else [pytest.approx(each, abs=0.05) for each in ends(KNOWN_ARCS)]
    )


@pytest.mark.parametrize(
    ("text", "settings", "code", "alarm"),
    [
        (MILL + "G05 P2\nG01 X10. Y5.\nX40. A30.", {}, "mitsubishi-high-speed", "P33"),
        (INSIDE, {"angle_sense": "ray"}, "line-reversed", None),
        (CROSSING.replace(" H0", ""), {"h_default": "error"}, "mitsubishi-h-missing", None),
        (ARCS, {"first_centre": "end"}, "mitsubishi-centre-from-end", None),
        (LEAVING, {"first_centre": "end"}, "mitsubishi-centre-from-end", None),
        (APART, {}, "mitsubishi-radius-difference", None),
        (CORNER_ON_ARC, {"corner": "I"}, "mitsubishi-corner-arc", None),
        (CORNER_ON_ARC, {"chamfer_on_arc": "arc_length"}, "mitsubishi-chamfer-along-arc", None),
        pytest.param(
            VERTEX.replace("A-30.", "A70.9"), {}, "mitsubishi-angles-parallel", "P392", marks=pytest.mark.boundary
        ),
    ],
)
def test_what_the_control_refuses_has_its_code_and_its_alarm(text, settings, code, alarm):
    result = mitsubishi(text, **settings)
    (first, *_) = [each for each in result.diagnostics if each.severity.value == "error"]
    assert (first.code, first.alarm.number.split()[0] if first.alarm else None) == (code, alarm)
    assert result.answers[0].contour is None


@pytest.mark.parametrize(
    ("text", "settings", "code"),
    [
        (CROSSING, {"h_default": "error"}, "mitsubishi-h-missing"),
        (VERTEX.replace("A-30.", "A70.9"), {"guard_deg": "0"}, "mitsubishi-angles-parallel"),
        pytest.param(VERTEX.replace("A-30.", "A71.1"), {}, "mitsubishi-angles-parallel", marks=pytest.mark.boundary),
    ],
)
def test_what_the_control_does_not_refuse(text, settings, code):
    assert code not in {each.code for each in mitsubishi(text, **settings).diagnostics}


@pytest.mark.parametrize(
    ("text", "code", "numbers"),
    [
        (CROSSING.replace("A10.", "A80."), "mitsubishi-circle-missed", ["41.997 mm", "32.016 mm", "9.981 mm"]),
        (MILL + "G01 X40. Y20. A30. ,R2.\nX60. Y20.", "mitsubishi-angle-ignored", ["26.565 deg"]),
        (MILL + "G01 X40. Y0 ,R2.\nX60. Y20. A30.", "mitsubishi-angle-ignored", ["45.000 deg"]),
        (MILL + "G01 X40. A-150.", "angle-opposite", []),
    ],
)
def test_a_finding_says_by_how_much(text, code, numbers):
    (finding,) = mitsubishi(text).diagnostics
    assert finding.code == code
    assert all(number in finding.message for number in numbers)


def test_sweeps_are_those_of_the_sheet():
    first, second = (each for each in elements(ARCS) if hasattr(each, "center"))
    assert (abs(first.sweep), abs(second.sweep)) == pytest.approx((101.388, 141.427), abs=1e-3)
    *_, other = elements(ARCS.replace("R25", "R-25"))
    assert (*other.center, abs(other.sweep)) == pytest.approx((45.0483, 61.5539, 218.573), abs=1e-3)


@pytest.mark.parametrize("plane", PLANES)
@pytest.mark.parametrize("name", ["MI-G2", "MI-G3-H0", "MI-G3-H1", "MI-G4", "MI-G4-negative-radius", "MI-G5"])
def test_planes_read_the_same_blocks_with_other_letters(name, plane):
    assert ends(turned(program_of("mitsubishi", name), plane)) == near(*ends_of(VECTORS["mitsubishi"][name]))


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


def test_a_crossing_without_h_rests_on_an_assumption():
    text = CROSSING.replace(" H0", "")
    assert ends(text) == ends(CROSSING)
    assert [each.name for each in mitsubishi(text).answers[0].claim.rests_on()] == ["h-missing"]


def test_a_may_be_an_axis():
    with_comma = VERTEX.replace("A", ",A")
    assert ends(with_comma) == ends(VERTEX) == ends(with_comma, angle_word=",A")
    assert mitsubishi(VERTEX, angle_word=",A").answers == ()
    assert ends(VERTEX.replace("A70.", "A20. ,A70.")) == ends(VERTEX)
    assert ends(with_comma.replace(",A70.", ",A70. A20."), angle_word=",A") == ends(VERTEX)


def test_a_full_circle_is_one_unless_what_follows_shows_that_it_is_none():
    assert mitsubishi(MILL + "G03 I-20.\nG01 X30. Y10.").answers == ()
    assert "mitsubishi-no-full-circle" in {each.code for each in mitsubishi(ARCS).diagnostics}
    assert mitsubishi(ARCS, arc_without_end="circle").answers == ()
    assert ends(LEAVING) == ends(LEAVING, arc_without_end="circle", angle_word="A")


def test_h_beside_an_arc_shows_the_control_and_other_words_do_not():
    assert solve(CROSSING).control == "mitsubishi"
    assert solve(MILL + "G01 X40. A30.\nG00 X0 Y0 A90.").control is None
    assert solve("G17 G90 G43 H5 G00 X0 Y0\nG02 X10. Y0 R5.").control is None
    with pytest.raises(UnknownControlError):
        solve(LEVER)


def test_a_relative_without_its_rules_reads_the_same_blocks():
    relative = replace(DIALECTS["mitsubishi"], name="mine", title="mine")
    assert solve(VERTEX, control=relative).answers[0].contour.end == pytest.approx((80, 25))


# Against closed forms ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("plane", PLANES)
@pytest.mark.parametrize("seed", range(5))
def test_random_blocks_of_each_form_go_where_the_closed_form_goes(form, plane, seed):
    for number in range(4):
        drawn = random_block(Random(f"{seed} {number}"), form, plane)
        if drawn.is_near:
            continue
        (answer,) = mitsubishi(drawn.text).answers
        assert (answer.contour is not None) is bool(drawn.elements), drawn.text
        for mine, theirs in zip(drawn.elements, answer.contour.elements if answer.contour else (), strict=True):
            gaps = [abs(complex(*theirs.start) - mine.start), abs(complex(*theirs.end) - mine.end)]
            if mine.center is not None:
                assert theirs.turn.value == mine.turn
                gaps += [abs(complex(*theirs.center) - mine.center), abs(theirs.radius - mine.radius)]
            assert max(gaps) <= 1e-8, drawn.text


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
