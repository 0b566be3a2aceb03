"""YASNAC LX3 G112, G11, G12, G01 with a bevel and arcs: worked numbers, drawings, the oracle, laws, refusals."""

import random
import re
from collections import Counter
from decimal import Decimal
from functools import cache
from itertools import product
from math import cos, radians, sin

import pytest
from click.testing import CliRunner
from generate_lx3 import FORMS, random_g11, random_g112
from generate_nct import disturbed
from oracle_lx3 import WORD, contours

import contoursolve
from contoursolve.cli import main
from contoursolve.controls import YASNAC_LX3
from contoursolve.program.pipeline import run
from contoursolve.program.request import Request

CLOSE = 1e-9
"""mm."""


def solve(text, **options):
    return contoursolve.solve(text, control="yasnac-lx3", **options)


def codes(result):
    return [each.code for each in result.diagnostics if each.severity.value != "info"]


def place(at):
    return complex(*at)


def assert_same(answer, elements, points):
    contour = answer.contour
    assert contour is not None, answer.diagnostics
    assert len(contour.elements) == len(elements)
    for found, expected in zip(contour.elements, elements, strict=True):
        assert abs(place(found.start) - expected.start) < CLOSE
        assert abs(place(found.end) - expected.end) < CLOSE
        assert hasattr(found, "turn") == (expected.kind == "arc")
        if expected.kind == "arc":
            assert found.turn.value == expected.turn
            assert found.radius == pytest.approx(expected.radius, abs=CLOSE)
            assert abs(place(found.center) - expected.center) < CLOSE
    for name, at in points.items():
        assert abs(place(contour.points[name]) - at) < CLOSE


def rounded(answer):
    """(Z, X diameter) of the end of each element."""
    return [(round(each.end[0], 4), round(2 * each.end[1], 4)) for each in answer.contour.elements]


MANUAL = "G01 X100. Z-50. F0.2\n"


def test_forms_of_this_control_show_that_a_program_is_for_it():
    for block in ("G112 U0 I10. K-50. R30.", "G11 Z-80. I8.", "G12 U20. K-2."):
        assert contoursolve.solve(MANUAL + block).control == "yasnac-lx3"


@pytest.mark.slow
@pytest.mark.parametrize("count", [3, 12])
def test_g112_is_the_drawing_it_was_written_from(count):
    rng = random.Random(112)
    for form, one, two in product(FORMS, ("", "P", "C"), ("", "Q", "D")):
        for _ in range(count):
            drawn = random_g112(rng, form, one, two)
            (answer,) = solve(drawn.text, depth="verdict").answers
            assert_same(answer, drawn.elements, drawn.points)
            assert answer.certificate.proof.value in ("exact", "unique")


@pytest.mark.slow
@pytest.mark.parametrize("count", [15, 60])
def test_g11_g12_and_g01_are_the_drawings_they_were_written_from(count):
    rng = random.Random(11)
    for _ in range(count):
        drawn = random_g11(rng, 4)
        answers = solve(drawn.text, depth="verdict").answers
        elements = [each for answer in answers for each in answer.contour.elements]
        assert len(answers) == 4
        assert len(elements) == len(drawn.elements)
        for found, expected in zip(elements, drawn.elements, strict=True):
            assert abs(place(found.end) - expected.end) < CLOSE
            assert getattr(getattr(found, "turn", None), "value", "") == expected.turn


@pytest.mark.slow
@pytest.mark.parametrize("count", [40, pytest.param(120, marks=pytest.mark.slow)])
def test_verdicts_on_disturbed_blocks_are_those_of_the_oracle(count):
    rng = random.Random(146)
    statuses = Counter()
    for number in range(count):
        one, two = rng.choice(("", "P", "C")), rng.choice(("", "Q", "D"))
        drawn = random_g112(rng, rng.choice(FORMS), one, two) if number % 3 else random_g11(rng, 1)
        program = disturbed(rng, drawn)
        expected, found = contours(program), solve("\n".join(program), depth="verdict").answers
        assert len(found) == len(expected), program
        for answer, outcome in zip(found, expected, strict=True):
            if not outcome.is_near:
                assert answer.status.value == outcome.status, (program, answer.diagnostics)
                statuses[outcome.status] += 1
                if outcome.status == "solved":
                    assert_same(answer, outcome.elements, outcome.points)
    assert min(statuses[status] for status in ("solved", "no-solution", "rejected")) > count / 25


def transformed(drawn, word):
    """The program with every word rewritten; the G codes stay."""
    return "\n".join(WORD.sub(lambda found: word(found[1], found[2]), line) for line in drawn.program)


def drawings(count):
    rng = random.Random(18)
    corners = product(FORMS, ("P", "C"), ("Q", "D"))
    yield from (random_g112(rng, *each) for each in corners)
    yield from (random_g11(rng, 2) for _ in range(count))


@pytest.mark.parametrize("drawn", list(drawings(6)), ids=lambda drawn: "-".join(drawn.kind))
def test_laws_of_the_forms(drawn):
    """Order of words, inches, a shift of the origin and a mirror of Z change nothing but what they say."""
    reference = [answer.contour for answer in solve(drawn.text).answers]

    def ends(text, **options):
        return [each.end for answer in solve(text, **options).answers for each in answer.contour.elements]

    plain = [each.end for contour in reference for each in contour.elements]
    reverse = "\n".join(" ".join([*line.split()[:1], *reversed(line.split()[1:])]) for line in drawn.program)
    if "G" in reverse.splitlines()[-1]:
        assert ends(reverse) == plain

    def inches(address, value):
        return address + (value if address in "GN" else format(Decimal(value) / Decimal("25.4"), "f"))

    def shifted(address, value):
        step = {"Z": Decimal("12.5"), "X": Decimal(40)}.get(address, 0)
        return address + (value if address in "GN" else format(Decimal(value) + step, "f"))

    def mirrored(address, value):
        return address + (format(-Decimal(value), "f") if address in "ZWK" else value)

    close = pytest.approx
    assert [x for end in ends(transformed(drawn, inches), units="inch") for x in end] == close(
        [x for end in plain for x in end], abs=1e-6
    )
    assert [(z - 12.5, x - 20) for z, x in ends(transformed(drawn, shifted))] == [
        (close(z, abs=CLOSE), close(x, abs=CLOSE)) for z, x in plain
    ]
    assert [(-z, x) for z, x in ends(transformed(drawn, mirrored))] == [
        (close(z, abs=CLOSE), close(x, abs=CLOSE)) for z, x in plain
    ]


@pytest.mark.parametrize(
    ("block", "line"),
    [
        ("G112 U0 I10. K-50. R30. D25.", "G112 U0 I10. K-50. R30. D18.284"),
        ("G11 U10. K-7.", "G11 U10. K-5."),
        ("G12 W-5. I-6.", "G12 W-5. I-5."),
    ],
)
def test_corner_that_is_too_large_is_offered_with_the_largest_size_and_its_sign(block, line):
    (finding,) = solve(MANUAL + block).diagnostics
    assert line in [fix.replacement for fix in finding.fixes]


def test_line_that_leads_to_the_centre_takes_the_side_of_the_landing_line():
    for step, turn in (("U-10.", "cw"), ("U10.", "ccw")):
        (answer,) = solve(f"{MANUAL}G112 {step} I0 K-50. R30.").answers
        assert answer.contour.elements[1].turn.value == turn


def test_line_that_touches_the_arc_ends_it_without_a_corner():
    result = solve(MANUAL + "G112 U-40. I10. K-50. R30. P5.")
    assert rounded(result.answers[0])[-1] == (-100, 60)
    assert codes(result) == []


def test_mode_of_g11_lasts_until_another_motion():
    result = solve(
        "G00 X30. Z0.\nG11\nM08\nZ-20. I8.\nG04 X1.\nS500\nX80. K-7.\nG01 Z-40.\nX90.\nG12 Z-50. I2.\nU20. K1."
    )
    assert [answer.form for answer in result.answers] == ["G11", "G11", "G12", "G12"]
    assert codes(result) == []


def test_ordinary_lines_and_arcs_are_not_contours():
    arcs = ("X70. Z-10. R10.", "X90. Z-20. I10.", "I5. K0", "U0.002 W-20. R10.", "R#1 X3.", "G28 U0 W0", "X1. R1.")
    result = solve("\n".join(("G00 X50. Z0.", "G02", *arcs, "G00 X40. Z0.", "G11 Z-20. I8.")))
    assert len(result.answers) == 1
    assert codes(result) == []


@pytest.mark.parametrize(
    ("arc", "code"),
    [
        ("G02 X70. Z-10. R7.05", "arc-radius-small"),
        ("G02 X70. Z-10. R-7.05", "arc-radius-small"),
        ("G03 U20. W-10. I10.02", "arc-spiral"),
        ("G03 X70. Z-10.", "arc-undefined"),
        ("G03 X50. Z0 R5.", "arc-full-by-radius"),
        ("G03 X50. Z0 I0 K0", "arc-empty-circle"),
        ("G02 X70. Z-10. I10. J0", "arc-outside-plane"),
    ],
)
def test_arc_that_cannot_run_is_reported_and_not_listed(arc, code):
    text = f"G00 X50. Z0.\n{arc}\nG00 X40. Z0.\nG11 Z-20. I8."
    finding = contoursolve.check(text, control="yasnac-lx3")[0]
    assert len(solve(text).answers) == 1
    assert finding.code == code
    assert finding.span.line == 2
    # Of where it begins, some arcs need not know.
    is_by_itself = code in ("arc-spiral", "arc-undefined", "arc-outside-plane")
    assert {*codes(solve(text.replace(" Z0.", "", 1)))} == ({code} if is_by_itself else set())


def configured(values, block):
    program = contoursolve.parse("G00 X40. Z0.\n" + block)
    return run(program, Request(YASNAC_LX3.configure(values))).answers[0]


def test_bevel_by_setback_is_as_long_on_both_sides_of_the_virtual_intersection():
    answer = configured({"bevel": "setback"}, "G111 X100. A180. K-30. B120. C5. D4.")
    c, s, z2 = 5 * cos(radians(60)), 5 * sin(radians(60)), -30 - 30 / 3**0.5
    assert [each.end for each in answer.contour.elements] == [
        (pytest.approx(z), pytest.approx(x))
        for z, x in [(-25, 20), (-30 - c, 20 + s), (z2 + 0.8 * c, 50 - 0.8 * s), (z2 - 4, 50)]
    ]
    arc = configured({"bevel": "setback"}, "G112 U0 I10. K-50. R30. C5.").contour
    begin, end, v1 = arc.elements[0].end, arc.elements[1].end, place(arc.points["V1"])
    assert abs(place(begin) - v1) == pytest.approx(5)
    assert abs(place(end) - v1) == pytest.approx(5)
    assert abs(place(end) - (-50 + 30j)) == pytest.approx(30)


def test_bevel_by_length_is_a_45_degree_segment_of_that_length():
    """The oracle: as the default reading with the amount divided by the square root of two."""
    for words, sizes in (("G111 X100. A180. K-30. B120.", (5, 4)), ("G112 U0 I10. K-50. R30.", (5, 3))):
        block, shorter = (f"{words} C{c:.15f} D{d:.15f}" for c, d in (sizes, [each / 2**0.5 for each in sizes]))
        answer, like = configured({"bevel": "length"}, block), configured({}, shorter)
        assert answer.status is like.status is contoursolve.Status.SOLVED
        for one, two in zip(answer.contour.elements, like.contour.elements, strict=True):
            assert abs(place(one.end) - place(two.end)) < CLOSE
        bevels = [each for each in answer.contour.elements if each.name.startswith("corner")]
        assert [each.length for each in bevels] == pytest.approx(sizes)
        (convention,) = answer.claim.conventions
        assert (convention.value, convention.evidence.value) == ("length", "assumed")
    too_large = configured({"bevel": "length"}, "G111 X100. A180. K-30. B120. C60.")
    (finding,) = too_large.diagnostics
    assert finding.values["limit"] / 2**0.5 == pytest.approx(
        configured({}, "G111 X100. A180. K-30. B120. C60.").diagnostics[0].values["limit"]
    )
    asked = configured({"bevel": "length"}, "G111 X100. A180. K-30. B120. C? (contoursolve: length of corner 1 = 5)")
    assert asked.asked[0].value == pytest.approx(5)


def test_a_path_that_crosses_the_spindle_axis_is_said_with_the_place():
    for text, reached in (
        ("G00 X26.193 Z-11.645\nG111 I1.766 Z-4.662 A90. B-66.607", (-4.662, -2.559)),
        ("G00 X20. Z-50.\nG112 U0 I10. K-50. R30.", (-100.0, -20.0)),
        ("G00 X30. Z0.\nG11 X-80. K-7.", (0.0, -66.0)),
        ("G00 X30. Z0.\nG12 Z-20. I-16.", (-20.0, -2.0)),
        ("G00 X30. Z0.\nG01 X-20. K-7.", (0.0, -6.0)),
        ("G00 X0 Z0.\nG111 A60. I10. B-45. Z30.", None),
        ("G00 X-40. Z0.\nG111 A180. K-30. B120. X100.", (-70.415, 100.0)),
    ):
        result = solve(text)
        assert codes(result) == ["axis-crossed"], text
        (finding,) = (each for each in result.diagnostics if each.code == "axis-crossed")
        assert finding.severity.value == "warning"
        crossing = result.answers[0].contour.crossing
        assert finding.values["actual"] == crossing.at[1]
        if reached:
            assert crossing.at == (pytest.approx(reached[0], abs=1e-3), pytest.approx(reached[1] / 2, abs=1e-3))
            assert f"X{2 * crossing.at[1]:.3f}" in finding.message


def test_a_path_on_one_side_of_the_spindle_axis_is_no_crossing():
    for text in (
        "G00 X-40. Z0.\nG111 A180. K-30. B-120. X-100. Q5.",
        "G00 X40. Z0.\nG111 A270. I-20. X0 Z-5.",
        "G00 X0 Z0.\nG111 A90. I10. X60. B120.",
        "G00 X0 Z0.\nG111 A-90. I-10. X-60. B-120.",
        "G00 X40. Z-50.\nG112 U0 I10. K-50. R30.",
    ):
        assert "axis-crossed" not in codes(solve(text)), text


@pytest.mark.slow
def test_contours_that_are_solved_together_cross_the_axis_as_each_by_itself():
    """The columns of `solve` and the patterns of `expand` tell the same as one contour by itself."""
    blocks = [f"G111 I1.766 Z-4.662 A90. B-{60 + number / 2:.2f}" for number in range(20)]
    text = "\n".join(f"G00 X26.193 Z-11.645\n{block}" for block in blocks)
    alone = [solve(f"G00 X26.193 Z-11.645\n{block}", depth="verdict").diagnostics for block in blocks]
    assert 0 < sum(map(bool, alone)) < len(blocks)
    messages = [(2 * number, each.message) for number, found in enumerate(alone, 1) for each in found]
    assert [(each.span.line, each.message) for each in solve(text, depth="verdict").diagnostics] == messages
    assert contoursolve.expand(text).summary.warnings == len(messages)


BEHIND = """
G00 X40. Z0.|G111 X100. A180. K-30. B120.|Z-90.|g111-rapid-behind
G00 X40. Z0.|G111 X100. A180. K-30. B120. P5. Q5.|W-30. F.2|g111-rapid-behind
G00 X40. Z0.|G111 X100. A180. K-30. B120.|M08|N7|(IN A ROW)|X120.|g111-rapid-behind
G00 X40. Z0.|G111 X100. A180. K-30. B120.|G04 X1.|Z-90.|g111-rapid-behind
G00 X100. Z-50.|G112 U0 I10. K-50. R30.|Z-150.|g111-rapid-behind
G00 X40. Z0.|G111 X100. A180. B120.|Z-90.|g111-line-1 g111-rapid-behind
G00 X40. Z0.|G111 X100. A180. K-30. B120.|G01 Z-90.|
G00 X40. Z0.|G111 X100. A180. K-30. B120.|G00 Z-90.|
G00 X40. Z0.|G111 X100. A180. K-30. B120.|G01 F.2|Z-90.|
G00 X40. Z0.|G111 X100. A180. K-30. B120.|G28 U0 W0|
G00 X40. Z0.|G111 X100. A180. K-30. B120.|T0202|X90.|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120.|Z-90.|
G00 X40. Z0.|G111 X100. A180. K-30. B120.|X160. A180. K-30. B120.|g111-forgotten
G00 X40. Z0.|G111 X100. A180. K-30. B120.|Z-90. K-10.|g111-forgotten
G00 X40. Z0.|G111 X100. A180. K-30. B120.|X160. B135.|g111-forgotten
G00 X40. Z0.|G111 X100. A180. K-30. B120.|X160. P2.|g111-forgotten
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120.|X160. Q2.|g111-forgotten
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120.|Z-90. I3.|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|Z-90.|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|X120.|g111-landing-left
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|G04 U1.|X120.|g111-landing-left
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|G04 U1.|Z-90.|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|G10 P1 X0.1 Z0.2|Z-90.|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|G50 X200. Z100.|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|Z-40.|g111-landing-left
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. D5.|X100. Z-90.|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. D5.|X100.01 Z-90.|g111-landing-left
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q0|X120.|
G01 X40. Z0. F.2|G111 Z-60. A180. K-30. B120. Q5.|X160.|
G01 X40. Z0. F.2|G111 Z-60. A180. K-30. B120. Q5.|Z-90.|g111-landing-left
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|G111 K-20. I0 B120. X160.|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|G111 A135. K-20. B120. X160.|g111-landing-left
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|G112 U0 I10. K-50. R30.|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|G02 X110. W-5. R5.|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|G02 U10. W-5. I5. K0|
G01 X40. Z0. F.2|G111 X100. A180. K-30. B120. Q5.|G03 U10. W-5. R5.|g111-landing-left
G01 X100. Z-50. F.2|G112 U0 I10. K-50. P5. Q5. R30.|Z-150.|
G01 X100. Z-50. F.2|G112 U0 I10. K-50. P5. Q5. R30.|X120. Z-150.|g111-landing-left
"""


@pytest.mark.parametrize("row", BEHIND.split("\n")[1:-1])
@pytest.mark.usefixtures("without_repairs")
def test_the_block_behind_multiple_cornering_is_looked_at(row):
    *lines, expected = row.split("|")
    text = "\n".join(lines)
    result = solve(text)
    found = codes(result)
    assert found == expected.split()
    for each in result.diagnostics:
        if each.code in ("g111-rapid-behind", "g111-forgotten", "g111-landing-left"):
            assert (each.severity.value, each.span.line) == ("warning", len(lines))
            assert re.search("(rounding Q|chamfer D)5|second corner", each.message) or lines[1][:4] in each.message
    # With G01 in force behind them, there is no rapid.
    other = solve(text, settings={"yasnac-lx3.motion-after": "g01"}, depth="verdict")
    assert "g111-rapid-behind" not in codes(other)
    # In a long program that is solved together, and as it is expanded, the same is told.
    many = solve("\n".join([text] * 12))
    assert [each.message for each in many.diagnostics] == 12 * [each.message for each in result.diagnostics]
    if not result.has_errors:
        assert contoursolve.expand("\n".join([text] * 30), control="yasnac-lx3").summary.warnings == 30 * len(found)


def test_the_fix_for_a_forgotten_code_is_the_block_with_it_and_only_if_that_is_a_contour():
    start = "G00 X40. Z0.\nG111 X100. A180. K-30. B120.\n"
    (finding,) = solve(start + "N5 X160. A180. K-30. B120.").diagnostics
    (fix,) = finding.fixes
    (behind,) = fix.beside
    assert (fix.replacement, behind.span.line) == (fix.replaced, 3)
    assert behind.text == "N5 G111 X160. A180. K-30. B120."
    assert codes(solve(start + behind.text)) == []
    (finding,) = solve(start + "X160. B120.").diagnostics
    assert (finding.code, finding.fixes) == ("g111-forgotten", ())


def test_behind_g111_the_motion_before_it_is_written_out():
    """G111 is not modal. By default what was in force before it is again, and `expand` says it."""
    for motion, setting, written in (
        ("G00", "unchanged", ["G00", "Z-90."]),
        ("G01", "unchanged", ["Z-90."]),
        ("G00", "g01", ["Z-90."]),
    ):
        text = f"{motion} X40. Z0. F.2\nG111 X100. A180. K-30. B120.\nZ-90.\n"
        settings = {"yasnac-lx3.motion-after": setting}
        expansion = contoursolve.expand(text, control="yasnac-lx3", settings=settings)
        lines = expansion.text.split("\n")
        assert lines[lines.index("G01 X100. Z-47.321") + 1 : -1] == written
        assert expansion.summary.warnings == (written[0] == "G00")


def test_settings_have_names_and_a_contour_tells_on_which_it_rests():
    assert configured({}, "G111 X100. A180. K-30. B120. C5.").claim.conventions[0].setting.name == "bevel"
    assert configured({}, "G112 U0 I10. K-50. R30. D5.").claim.conventions[0].setting.name == "bevel"
    assert configured({}, "G111 X100. A180. K-30. B120. P5.").claim.conventions == ()
    assert configured({}, "G11 Z-20. I5.").claim.conventions == ()
    with pytest.raises(ValueError, match="values are: axis-45, length, setback"):
        YASNAC_LX3.configure({"bevel": "45"})


@cache
def printed_tables():
    return CliRunner().invoke(main, ["rules", "--table", "--control", "yasnac-lx3"]).output.split("\n\n")


def table(form):
    """{letters: (legality, determinacy)} of a form's part of the printed table, without the letters of every row."""
    (part,) = (part for part in printed_tables() if part.startswith(f"yasnac-lx3 {form}:"))
    rows = [line.split(" | ") for line in part.splitlines()[1:]]
    found = {frozenset(words.split()) - {"-"}: (legality, rest) for words, legality, rest in rows}
    shared = frozenset.intersection(*found)
    return {words - shared: row for words, row in found.items()}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("form", "letters", "needed", "either"),
    [
        ("G112, circular-arc multiple cornering, turning", "XUIKRPQCD", "IKR", "XU"),
        ("G112, circular-arc multiple cornering, facing", "WIKRPQCD", "IKR", ""),
        ("G11, bevelling, along Z", "XUWIK", "I", ""),
        ("G11, bevelling, along X", "UIK", "K", ""),
        ("G12, rounding, along Z", "XUWIK", "I", ""),
        ("G12, rounding, along X", "UIK", "K", ""),
    ],
)
def test_table_says_which_sets_of_words_are_legal_and_that_each_of_them_is_determined(form, letters, needed, either):
    """A row of a facing form or of G11 has its axis word besides, which may not be given twice."""
    rows = table(form)
    pairs = [set("CP"), set("DQ"), *([set(either)] if either else [])]
    assert len(rows) == 2 ** len(letters)
    for words, (legality, determinacy) in rows.items():
        is_legal = (
            words >= set(needed)
            and (not either or bool(words & set(either)))
            and not any(words >= pair for pair in pairs)
            and words <= {*needed, *either, *("PQCD" if "R" in letters else "")}
        )
        assert (legality == "legal") == is_legal, sorted(words)
        assert not is_legal or determinacy.startswith("determined"), sorted(words)


def test_a_word_without_a_part_in_the_contour_is_named_whatever_the_rules():
    for block, word in (("G11 Z-70. X30. I8.", "X"), ("G112 Z-150. U0 I10. K-50. R30.", "Z")):
        found = solve(MANUAL + block, rules="off")
        (finding,) = (each for each in found.diagnostics if each.code == "word-unused")
        assert finding.addresses == (word,)


# What was asked before changes nothing ------------------------------------------------------------------------


@pytest.mark.slow
def test_the_table_is_the_same_after_blocks_under_other_settings():
    table = ("rules", "--control", "yasnac-lx3", "--table")
    before = CliRunner().invoke(main, table).output
    for bevel, words in product(
        ("setback", "length"), ("X80. I5. K-20.", "X80. I-5. K20.", "Z-80. I5. K-20.", "Z80. I-5. K20.")
    ):
        contoursolve.solve(
            f"G00 X40. Z0.\nG112 {words} R30. C2.", control="yasnac-lx3", settings={"yasnac-lx3.bevel": bevel}
        )
    assert CliRunner().invoke(main, table).output == before


def test_fixes_do_not_depend_on_the_values_of_a_block_before():
    """Of G112, which words may be left out together depends on where the others put the landing line."""

    def fixes(z):
        block = f"G00 X282.952378 Z-160.976511\nG112 Z{z} R13.021413 K-6.178 I42.488466 W-31.459"
        return [fix.replacement for finding in solve(block).diagnostics for fix in finding.fixes]

    assert fixes("-190.") == []
    assert fixes("-157.141638") == ["G112 Z-157.141638 R13.021413 K-6.178 I42.488466"]


def test_a_forgotten_code_is_the_first_fix_and_no_help_tells_to_delete_what_it_reads():
    result = solve("G01 X40. Z0. F.2\nG111 X100. A180. K-30. B120.\nX160. A180. K-30. B120.")
    unknown = [each for each in result.diagnostics if each.code == "address-unknown"]
    assert [each.help for each in unknown] == ["add G111", "add G111"]
    assert unknown[0].fixes[0].replacement == "G111 X160. A180. K-30. B120."
    behind = next(each for each in result.diagnostics if each.code == "g111-forgotten")
    assert behind.fixes[0].beside[0].text == unknown[0].fixes[0].replacement
