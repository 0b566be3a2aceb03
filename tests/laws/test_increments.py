"""Words are exact to half their increment: what is compared is compared within the increments of what is compared."""

import json
from math import cos, hypot, radians, sin, tan
from random import Random

import numpy as np
import pytest

import contoursolve
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.families import family
from contoursolve.output.document import to_json
from contoursolve.solving import STATUSES


def answer_to(block, start=None, **options):
    return contoursolve.solve(block, start=start, **options).answers[0]


HALF = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"
TAPER = "G111 A120. K-15. X{} Z-60. C2."


@pytest.mark.parametrize(
    ("x", "is_inside"), [("91.961", True), ("91.9615", True), ("91.959", False), ("91.957", False)]
)
def test_a_bevel_at_a_taper_onto_a_cylinder_is_inside_within_the_increment_of_x(x, is_inside):
    answer = answer_to(TAPER.format(x), "X40. Z0.")
    assert [each.code for each in answer.diagnostics] == ([] if is_inside else ["g111-bevel-outside"])
    if not is_inside:
        outside = 20 + 15 * tan(radians(60)) - float(x) / 2
        assert answer.diagnostics[0].values["off_by_mm"] == pytest.approx(outside)


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("unit", ["mm", "inch"])
def test_every_taper_onto_a_cylinder_with_x_rounded_to_the_increment_is_accepted(seed, unit):
    draw, decimals, scale = Random(seed), *((3, 1.0) if unit == "mm" else (4, 1 / 25.4))
    step = 10.0**-decimals
    for _ in range(10):
        angle, k = round(draw.uniform(92, 134), 3), round(-draw.uniform(5, 40) * scale, decimals)
        start = round(draw.uniform(10, 80) * scale, decimals)
        x = round(start + 2 * k * tan(radians(angle)), decimals)
        z, size = k - draw.uniform(10, 60) * scale, draw.uniform(0.2, 2) * scale
        words = "G111 A{}. K{:.4f} X{:.4f} Z{:.4f} C{:.4f}".replace("{}.", "{}")
        block, place = words.format(angle, k, x, z, size), f"X{start:.4f} Z0."
        answer = answer_to(block, place, units=unit, depth="verdict")
        assert answer.status.value == "solved", (block, place, [each.message for each in answer.diagnostics])
        short = answer_to(words.format(angle, k, x - 2.5 * step, z, size), place, units=unit, depth="verdict")
        assert [each.code for each in short.diagnostics] == ["g111-bevel-outside"], (block, place)


def half_circle(draw):
    """A half circle by R with all numbers rounded, and a line from a point of it; half its chord less R."""
    radius, angle = draw.uniform(2, 80), draw.uniform(0, 360)
    center = complex(draw.uniform(-90, 90), draw.uniform(-90, 90))

    def at(degrees, far):
        return center + far * complex(cos(radians(degrees)), sin(radians(degrees)))

    begin, end = (complex(round(z.real, 3), round(z.imag, 3)) for z in (at(angle, radius), at(angle + 180, radius)))
    way = angle + draw.uniform(30, 150)
    leaving = at(way, radius) + draw.uniform(5, 40) * complex(cos(radians(way + 60)), sin(radians(way + 60)))
    size = round(radius, 3)
    text = (
        f"G17 G90 G41 D1 G0 X{begin.real:.3f} Y{begin.imag:.3f}\nG3 X{end.real:.3f} Y{end.imag:.3f} R{{:.3f}}\n"
        f"G1 X{leaving.real:.3f} Y{leaving.imag:.3f} ,A{(way + 60) % 360:.3f} Q1"
    )
    return text, size, abs(end - begin) / 2


@pytest.mark.parametrize("seed", range(40))
def test_every_half_circle_by_r_with_rounded_numbers_is_one(seed):
    text, size, half = half_circle(Random(seed))
    answer = answer_to(text.format(size), depth="verdict")
    assert answer.status.value == "solved", (text.format(size), [each.message for each in answer.diagnostics])
    notes = [each.code for each in answer.diagnostics]
    assert ("nct-half-circle" in notes) == (half > size + 1e-9), (text.format(size), notes)
    if half > size + 1e-9:
        arc = answer.contour.elements[0]
        # The centre comes from the points, and the arc is as large as they say.
        assert arc.radius == pytest.approx(half, abs=1e-9)
        assert hypot(arc.start[0] - arc.center[0], arc.start[1] - arc.center[1]) == pytest.approx(half, abs=1e-9)
    finding = answer_to(text.format(half - 0.0025), depth="verdict").diagnostics[0]
    assert finding.code == "nct-radius-too-small", text
    assert finding.values["limit"] - finding.values["actual"] == pytest.approx(finding.values["off_by_mm"])
    if seed < 10:
        result = contoursolve.solve(text.format(size))
        documents = (Document(name, each.encode()) for name, each in (("p", text.format(size)), ("r", to_json(result))))
        assert verify(*documents).verdict is ReceiptVerdict.VERIFIED, text.format(size)


def test_words_that_agree_within_their_increments_agree_in_the_text_and_in_the_tie():
    block, start = "G111 K-56.561 Z-43.112 I-1.915 U-115.337 A-178.061", "X10.544 Z7.268"
    answer = answer_to(block, start)
    (finding,) = (each for each in answer.diagnostics if each.code == "g111-a-ignored")
    assert "it agrees with them" in finding.message
    assert finding.notes[0].endswith("the same place")
    (tie,) = answer.diagnosis.ties
    assert not tie.is_conflict
    assert tie.off_by_mm == pytest.approx(0.004, abs=1e-4)
    assert answer_to(block, start, rules="off").status.value == "overdetermined"
    assert answer_to(block.replace("178.061", "178.057"), start, rules="off").status.value == "conflicting"


@pytest.mark.parametrize("rules", ["enforce", "off"])
@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("off", [0.0, 0.0005, 0.002, 0.01])
@pytest.mark.usefixtures("without_repairs")
def test_text_and_tie_never_disagree_on_rounded_words(rules, seed, off):
    draw = Random(seed)
    k, i = (draw.choice((1, -1)) * draw.uniform(1, 60) for _ in range(2))
    angle = np.degrees(np.arctan2(i, k)) + off * draw.choice((1, -1))
    block = f"G111 I{i:.3f} K{k:.3f} A{angle:.3f} B{angle:.3f} Z{1.5 * k:.3f}"
    answer = answer_to(block, "X90. Z0.", rules=rules)
    (tie,) = answer.diagnosis.ties
    messages = " ".join(each.message for each in answer.diagnostics)
    agrees = "agrees with them" in messages or " repeats " in messages
    assert agrees != tie.is_conflict, (block, messages)
    assert agrees == (answer.status.value != "conflicting") or rules == "enforce", block


@pytest.mark.parametrize(
    ("block", "start", "word", "values"),
    [
        (TAPER.format(92), "X40. Z0.", "X", 91.955 + 0.0005 * np.arange(20)),
        ("G111 I10. K-10. A135. B170. X80.", "X40. Z0.", "A", 134.99 + 0.0005 * np.arange(40)),
        ("G111 A180. K-30. B120. X100. U60.", "X40. Z0.", "U", 59.995 + 0.0005 * np.arange(20)),
        (HALF, None, "R", 49.995 + 0.0005 * np.arange(20)),
    ],
)
def test_columns_compare_as_single_blocks_do(block, start, word, values):
    options = {"start": start} if start else {}
    found = family(block, vary={word: np.round(values, 4)}, rules="off", **options)
    statuses = set()
    for value, status in zip(np.round(values, 4), found["status"], strict=True):
        stated = {"X": "X92", "A": "A135.", "U": "U60.", "R": "R50"}[word]
        one = answer_to(block.replace(stated, f"{word}{value:.4f}"), start, rules="off", depth="verdict")
        assert STATUSES[status] is one.status, (word, value)
        statuses.add(one.status)
    assert len(statuses) > 1


def test_no_message_shows_two_equal_numbers_as_different():
    answer = answer_to("G111 I0 K-4000. A180.0007 B170. X80.", "X40. Z0.", rules="off")
    (finding,) = (each for each in answer.diagnostics if each.code == "words-conflict")
    assert "it states 180.001 deg, they give 180.000 deg" in finding.message
    answer = answer_to("G111 I0 K-90000. A180.0004 B170. X80.", "X40. Z0.", rules="off")
    told = [each.message for each in answer.diagnostics if each.code == "words-conflict"]
    assert all("180.000 deg, they give 180.000 deg" not in each for each in told)
    assert json.loads(to_json(contoursolve.solve(TAPER.format(91.961), start="X40. Z0.")))["contours"]


ARC = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y{} ,A180 Q-1"


@pytest.mark.parametrize(
    ("y", "code"),
    [
        ("50", "nct-circle-touched"),
        ("50.0000000000001", "nct-circle-missed"),
        ("49.9999999999999", None),
        ("50.00000000000003", "nct-circle-missed"),
    ],
)
def test_whether_a_line_touches_a_circle_is_decided_on_the_exact_words(y, code):
    answer = answer_to(ARC.format(y))
    assert [each.code for each in answer.diagnostics] == ([code] if code else [])
    found = family(ARC.format(y), vary={"2:X": [-50.0, -60.0]})
    assert STATUSES[found["status"][0]] is answer.status
    if code == "nct-circle-missed":
        (finding,) = answer.diagnostics
        assert finding.values["off_by_mm"] == pytest.approx(float(y.replace("50.", "0.")), rel=1e-3)
    if code is None:
        assert answer.contour.points["P1"][0] == pytest.approx((2 * 50 * 1e-13) ** 0.5, rel=1e-3)


FAR = "G111 A180. K-10. B179.9999999999 X41."


def test_a_contour_farther_away_than_words_reach_is_none():
    answer = answer_to(FAR, "X40. Z0.")
    assert answer.status.value == "no-solution"
    (finding,) = answer.diagnostics
    assert finding.code == "out-of-range"
    assert finding.message.startswith("the end of the second straight lies 286478897575.412 mm from the start point")
    assert finding.values == {"limit": 1e6, "actual": pytest.approx(286478897575.4)}
    assert answer.contour is None
    angles = [179.9999999999, 179.999, 179.99, 120.0]
    found = family(FAR, start="X40. Z0.", vary={"B": angles})
    singles = [answer_to(FAR.replace("179.9999999999", f"{each:.10f}"), "X40. Z0.").status for each in angles]
    assert [STATUSES[status] for status in found["status"]] == singles
    program = f"G0 X40. Z0.\n{FAR}"
    result = to_json(contoursolve.solve(program))
    assert verify(*(Document("", each.encode()) for each in (program, result))).verdict is not ReceiptVerdict.FAILED
