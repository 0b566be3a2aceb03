"""Mitsubishi: every worked example of its sheet, right and wrong, its settings, and a law against closed forms."""

from dataclasses import replace
from random import Random

import pytest
from click.testing import CliRunner
from examples import law
from hypothesis import strategies as st
from oracle_mitsubishi import FORMS, random_block
from vectors import VECTORS, ends as ends_of, program_of

from contoursolve import UnknownControlError, expand, solve
from contoursolve.cli import main
from contoursolve.controls import DIALECTS

VERTEX, CROSSING, CONTACT, ARCS, LEVER = (
    program_of("mitsubishi", name) for name in ("MI-G2", "MI-G3-H0", "MI-G4", "MI-G5", "MI-G6")
)
LEAVING = "G17 G90 G00 X0 Y0\nG03 I30. J0 H0\nG01 X20. Y-60. A-90."
KNOWN_ARCS = ARCS.replace("R25.", "I-16.083 J-19.14")
CORNER_ON_ARC = "G17 G90 G00 X0 Y0\nG01 X40. ,C6.\nG02 X60. Y20. I20. J0"


def mitsubishi(text: str, **settings: str):
    names = {f"mitsubishi.{name.replace('_', '-')}": value for name, value in settings.items()}
    return solve(text, control="mitsubishi", settings=names)


def ends(text: str, **settings: str):
    """Where the elements of all contours end."""
    result = mitsubishi(text, **settings)
    assert not result.has_errors, [each.message for each in result.diagnostics]
    return [each.end for answer in result.answers for each in answer.contour.elements]


def codes(text: str, **settings: str) -> dict[str, str | None]:
    """The alarms of all findings by their codes."""
    found = mitsubishi(text, **settings).diagnostics
    return {each.code: each.alarm.number.split()[0] if each.alarm else None for each in found}


def test_sweeps_are_those_of_the_sheet():
    def arcs(text):
        elements = (each for answer in mitsubishi(text).answers for each in answer.contour.elements)
        return [each for each in elements if hasattr(each, "center")]

    first, second = arcs(ARCS)
    assert (abs(first.sweep), abs(second.sweep)) == pytest.approx((101.388, 141.427), abs=1e-3)
    other = arcs(ARCS.replace("R25", "R-25"))[1]
    assert (*other.center, abs(other.sweep)) == pytest.approx((45.0483, 61.5539, 218.573), abs=1e-3)


@pytest.mark.parametrize("number", ["P33", "p392", "P393", "P394", "P395", "P396", "P397"])
def test_an_alarm_is_explained_by_its_number_with_its_grade(number):
    shown = CliRunner().invoke(main, ["explain", number])
    assert shown.exit_code == 0
    grades = {rule.alarm.evidence.value for rule in DIALECTS["mitsubishi"].rules if rule.alarm}
    assert grades == {"assumed", "printed"}
    assert f"alarm {number.upper()} " in shown.output


def test_a_line_that_misses_says_by_how_much():
    (finding,) = mitsubishi(CROSSING.replace("A10.", "A80.")).diagnostics
    for number in ("41.997 mm", "32.016 mm", "9.981 mm"):
        assert number in finding.message


def test_an_angle_beside_both_coordinates_is_ignored_and_the_real_one_is_told():
    text = "G17 G90 G00 X0 Y0\nG01 X40. Y20. A30. ,R2.\nX60. Y20."
    (finding,) = mitsubishi(text).diagnostics
    assert (finding.code, finding.severity.value) == ("mitsubishi-angle-ignored", "warning")
    assert "26.565 deg" in finding.message
    assert ends(text)[-1] == pytest.approx((60, 20))
    # In the second block of a contour, too.
    later = mitsubishi("G17 G90 G00 X0 Y0\nG01 X40. Y0 ,R2.\nX60. Y20. A30.").diagnostics
    assert [each.code for each in later] == ["mitsubishi-angle-ignored"]
    assert "45.000 deg" in later[0].message


def test_either_of_two_angles_of_a_line_is_the_same_one():
    text = "G17 G90 G00 X0 Y0\nG01 X40. A30."
    assert ends(text) == ends(text.replace("A30", "A-150")) == ends(text.replace("A30", "A390"))
    assert "angle-opposite" in codes(text.replace("A30", "A-150"))


def test_from_inside_a_circle_the_shorter_line_counts_whichever_way_it_runs():
    text = CROSSING.replace("X60. Y15.", "X40. Y20.")
    assert ends(text)[0] == pytest.approx((-10.9836, 3.0633), abs=1e-4)
    assert "angle-opposite" in codes(text)
    assert mitsubishi(text, angle_sense="ray").answers[0].contour is None
    assert ends(text.replace("H0", "H1"))[0] == pytest.approx((46.3572, 13.1740), abs=1e-4)


@pytest.mark.parametrize("plane", [17, 18, 19])
def test_planes_read_the_same_blocks_with_other_letters(plane):
    letters = {17: "XYIJ", 18: "ZXKI", 19: "YZJK"}[plane]
    for name in ("MI-G2", "MI-G3-H0", "MI-G3-H1", "MI-G4", "MI-G4-negative-radius", "MI-G5"):
        text, expected = program_of("mitsubishi", name), ends_of(VECTORS["mitsubishi"][name])
        turned = text.replace("G17", f"G{plane}").translate(str.maketrans("XYIJ", letters))
        assert ends(turned) == [pytest.approx(each, abs=1e-4) for each in expected]


@pytest.mark.parametrize("plane", [17, 18, 19])
def test_a_centre_by_p_and_q_is_absolute(plane):
    """P is for I and Q for K; in G17 Q is for J, in G19 P is for J."""
    text = "G17 G90 G00 X5. Y3.\nG03 I30. J-2. H0\nG01 X20. Y-60. A-80."
    letters = {17: "XYIJ", 18: "ZXKI", 19: "YZJK"}[plane]
    turned = text.replace("G17", f"G{plane}").translate(str.maketrans("XYIJ", letters))
    absolute = turned.replace(f"{letters[2]}30.", "@35.").replace(f"{letters[3]}-2.", "@1.")
    first, second = ("Q", "P") if plane == 18 else ("P", "Q")
    absolute = absolute.replace("@", first, 1).replace("@", second, 1)
    assert ends(absolute) == ends(turned) == ends(absolute, first_centre="end", arc_without_end="circle")
    assert ends(absolute.replace("H0", "H1")) == ends(turned.replace("H0", "H1")) != ends(turned)
    assert ends(absolute.replace(" H0", "")) == ends(turned)
    assert "mitsubishi-h-missing" in codes(absolute.replace(" H0", ""), h_default="error")
    assert "mitsubishi-no-full-circle" not in codes(absolute.replace(" H0", ""))
    if plane == 18:
        assert "mitsubishi-centre-of-diameter" in codes(absolute, diameter="on")


def test_high_speed_machining_stays_in_force_until_it_ends():
    text = "G17 G90 G00 X0 Y0\nG05 P2\nG01 X10. Y5.\nX40. A30."
    assert codes(text) == {"mitsubishi-high-speed": "P33"}
    assert ends(text.replace("\nX40.", "\nG05 P0\nX40.")) == [pytest.approx((40, 22.3205), abs=1e-4)]
    assert ends(text.replace("X40. A30.", "X40. ,R2.\nY40."))[-1] == pytest.approx((40, 40))


# Settings ---------------------------------------------------------------------------------------------------------


def test_x_may_be_a_diameter():
    text = "G90 G00 X20. Z0\nG01 X40. A90.\nA150.\nX80. Z-30. A120."
    assert ends(text, diameter="on")[0] == pytest.approx((0, 20))
    corner = "G18 G90 G00 X20. Z10.\nG01 A70.\nX50. Z80. A-30."
    assert ends(corner, diameter="on") == [
        pytest.approx(each, abs=1e-4) for each in ends(corner.replace("X20", "X10").replace("X50", "X25"))
    ]
    assert "X50 Z80" in expand(corner, control="mitsubishi", settings={"mitsubishi.diameter": "on"}).text


def test_a_number_without_a_point_is_what_the_setting_says():
    text = "G17 G90 G00 X0 Y0\nG01 X40 A45"
    assert ends(text) == [pytest.approx((40, 40))]
    assert mitsubishi(text, number="increment").answers[0].contour.end == pytest.approx((0.04, 3.1416e-5), abs=1e-7)


@pytest.mark.slow
def test_a_centre_counted_from_an_end_that_is_to_be_found_is_refused():
    for text in (ARCS, LEAVING):
        assert "mitsubishi-centre-from-end" not in codes(text)
        assert "mitsubishi-centre-from-end" in codes(text, first_centre="end")
        assert mitsubishi(text, first_centre="end").answers[0].contour is None


def test_a_crossing_without_h_rests_on_an_assumption_or_is_refused():
    text = CROSSING.replace(" H0", "")
    assert ends(text) == ends(CROSSING)
    assert [each.name for each in mitsubishi(text).answers[0].claim.rests_on()] == ["h-missing"]
    assert "mitsubishi-h-missing" in codes(text, h_default="error")
    assert "mitsubishi-h-missing" not in codes(CROSSING, h_default="error")


@pytest.mark.slow
def test_two_known_arcs_must_touch_to_within_the_tolerance():
    assert ends(KNOWN_ARCS)[0] == pytest.approx((29.4094, 35.9236), abs=1e-3)
    apart = KNOWN_ARCS.replace("-16.083", "-16.133")
    assert mitsubishi(apart).answers[0].contour is None
    assert ends(apart, contact_tol="0.1")[0] == pytest.approx((29.41, 35.92), abs=0.05)


def test_corners_and_chamfers_beside_arcs_follow_the_option():
    assert len(ends(CORNER_ON_ARC)) == 3
    assert "mitsubishi-corner-arc" in codes(CORNER_ON_ARC, corner="I")
    assert "mitsubishi-chamfer-along-arc" in codes(CORNER_ON_ARC, chamfer_on_arc="arc_length")
    straight = "G17 G90 G00 X0 Y0\nG01 X30. ,C5.\nX40. Y40."
    assert ends(straight) == ends(straight, corner="I", chamfer_on_arc="arc_length")


def test_the_guard_of_a_vertex_can_be_set():
    text = VERTEX.replace("A-30.", "A70.5")
    assert "mitsubishi-angles-parallel" not in codes(text, guard_deg="0")
    assert codes(VERTEX.replace("A-30.", "A71.")).get("mitsubishi-angles-parallel") is None


def test_a_may_be_an_axis():
    with_comma = VERTEX.replace("A", ",A")
    assert ends(with_comma) == ends(VERTEX) == ends(with_comma, angle_word=",A")
    assert mitsubishi(VERTEX, angle_word=",A").answers == ()
    assert ends(VERTEX.replace("A70.", "A20. ,A70.")) == ends(VERTEX)
    assert ends(with_comma.replace(",A70.", ",A70. A20."), angle_word=",A") == ends(VERTEX)


def test_a_full_circle_is_one_unless_what_follows_shows_that_it_is_none():
    full = "G17 G90 G00 X0 Y0\nG03 I-20.\nG01 X30. Y10."
    assert mitsubishi(full).answers == ()
    assert "mitsubishi-no-full-circle" in codes(ARCS)
    assert mitsubishi(ARCS, arc_without_end="circle").answers == ()
    assert ends(LEAVING) == ends(LEAVING, arc_without_end="circle", angle_word="A")


# For which control ------------------------------------------------------------------------------------------------


def test_h_beside_an_arc_shows_the_control_and_other_words_do_not():
    assert solve(CROSSING).control == "mitsubishi"
    assert solve("G17 G90 G00 X0 Y0\nG01 X40. A30.\nG00 X0 Y0 A90.").control is None
    assert solve("G17 G90 G43 H5 G00 X0 Y0\nG02 X10. Y0 R5.").control is None
    (told,) = solve("G17 G90 G00 X0 Y0\nG01 X30. ,R5.\nX40. Y40.").diagnostics
    assert "mitsubishi" in told.message
    with pytest.raises(UnknownControlError):
        solve(LEVER)


def test_a_relative_without_its_rules_reads_the_same_blocks():
    relative = replace(DIALECTS["mitsubishi"], name="mine", title="mine")
    assert solve(VERTEX, control=relative).answers[0].contour.end == pytest.approx((80, 25))


# Against closed forms ---------------------------------------------------------------------------------------------


def assert_as_drawn(form: str, seed: int, plane: int) -> None:
    drawn = random_block(Random(seed), form, plane)
    if drawn.is_near:
        return
    (answer,) = mitsubishi(drawn.text).answers
    assert (answer.contour is not None) is bool(drawn.elements), drawn.text
    if answer.contour is None:
        return
    for mine, theirs in zip(drawn.elements, answer.contour.elements, strict=True):
        gaps = [abs(complex(*theirs.start) - mine.start), abs(complex(*theirs.end) - mine.end)]
        if mine.center is not None:
            assert theirs.turn.value == mine.turn
            gaps += [abs(complex(*theirs.center) - mine.center), abs(theirs.radius - mine.radius)]
        assert max(gaps) <= 1e-8, drawn.text


@pytest.mark.parametrize("form", FORMS)
@law(st.integers(0, 10**9), st.sampled_from((17, 18, 19)), few=2)
def test_random_blocks_of_each_form_go_where_the_closed_form_goes(form, seed, plane):
    assert_as_drawn(form, seed, plane)


@pytest.mark.slow
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
