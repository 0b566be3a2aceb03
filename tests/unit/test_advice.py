"""What a finding asks to add, to delete or to write helps: its words, its fixes and the equations agree."""

import re
from math import hypot

import pytest

from contoursolve import DIALECTS, Diagnostic, check, legal_blocks, solve

START = "X40. Z0."


def findings(block: str, **options: str) -> dict[str, Diagnostic]:
    return {each.code: each for each in check(block, control="yasnac-lx3", **({"start": START} | options))}


def asked(finding: Diagnostic) -> str:
    """What is to be added, as a finding that lacks words says it."""
    text = finding.message + "; " + finding.help.removesuffix("; a zero must be written, too (I0, K0)")
    return text.partition("add ")[2].removesuffix("; or state a fact about it: `contoursolve facts` lists them")


ASKED = {
    # With I0 any A leaves line 1 no length; K places V1 on it.
    "G111 X100. I0 B120.": {"g111-line-1": "K", "words-missing": "one of K, Z, W"},
    # At 90 deg K says what A says.
    "G111 A90.": {"g111-line-1": "I", "words-missing": "three of I, X or U, Z or W, B"},
    "G111 A180.": {"g111-line-1": "K", "words-missing": "three of K, X or U, Z or W, B"},
    # I and K say the same beside A, and so do X and U.
    "G111 A170. B120. C2.": {"g111-line-1": "I or K", "words-missing": "two of I or K, X or U, Z or W"},
    "G111 I10. B120.": {"g111-line-1": "A or K", "words-missing": "two of K or A, X or U, Z or W"},
    "G111 I10. K-20. B120.": {"words-missing": "one of X, U, Z, W"},
    "G111 X100. U50.": {
        "g111-line-1": "A or I or K",
        "words-missing": "three of I, K, A, Z or W, B; not I, K and A together",
    },
}


@pytest.mark.parametrize("block", ASKED)
def test_only_words_that_help_are_asked_for_and_each_is_in_a_fix(block):
    found = findings(block)
    assert {code: asked(found[code]) for code in ASKED[block]} == ASKED[block]
    fixes = [fix for each in found.values() for fix in each.fixes]
    offered = {word for fix in fixes for word in re.findall(r"add ([A-Z]+)\?", fix.description)}
    named = {word for each in found.values() for word in re.findall(r"\b[A-Z]\b", asked(each))}
    assert named - offered == set()
    assert offered - named == set()


@pytest.mark.parametrize("block", ["G111 X100. I0 B120.", "G111 U60. I0 B120.", "G111 A180. B120. X100."])
def test_a_word_that_may_have_either_sign_is_offered(block):
    (fix,) = (
        each for each in next(iter(findings(block).values())).fixes if each.description.startswith("add K? (such as K-")
    )
    assert fix.example == f"{block} K-20."
    (answer,) = solve(fix.example, control="yasnac-lx3", start=START).answers
    assert answer.contour.points["V1"] == pytest.approx((-20, 20))
    assert answer.diagnostics == ()


RANGE = re.compile(r"([A-Z])([-\d.]+) \((?:between \1([-\d.]+) and \1([-\d.]+)|\1([-\d.]+) or (above|below))\)")
ONE = re.compile(r"add ([A-Z])\? \(such as \1([-\d.]+), \1([-\d.]+) or (above|below)\)")


def numbers_told(description: str) -> list[tuple[str, float, float]]:
    """The words of a fix, each with the least step inwards from an end of its range, and this end."""
    found = [(word, float(end), 1 if way == "above" else -1) for word, _, end, way in ONE.findall(description)]
    for word, _, low, high, end, way in RANGE.findall(description):
        ends = [(low, 1), (high, -1)] if low else [(end, 1 if way == "above" else -1)]
        found += [(word, float(each), step) for each, step in ends]
    return found


@pytest.mark.boundary
@pytest.mark.parametrize("block", ["G111 I10. K-20. B120.", "G111 A180. B120. X100.", "G111 A170. B120. C2."])
def test_the_numbers_that_a_fix_tells_have_a_contour_and_those_beyond_have_none(block):
    """Of several words, the others have the numbers that stand there."""
    count = 0
    for fix in (fix for each in findings(block).values() for fix in each.fixes):
        for word, end, step in numbers_told(fix.description)[:2]:
            for off, has_contour in ((0.002 * step, True), (-0.002 * step, False)):
                text = re.sub(rf"\b{word}[-\d.]+$|\b{word}[-\d.]+(?= )", f"{word}{end + off:.3f}", fix.example)
                (answer,) = solve(text, control="yasnac-lx3", start=START, depth="verdict").answers
                assert (answer.contour is not None) is has_contour, (fix.description, text)
                count += 1
    assert count >= 4


@pytest.mark.parametrize(
    ("words", "units", "by", "states", "change"),
    [
        ("K-20. X100. U50.", "mm", "10.000 mm", "50.000 mm, X100. gives 60.000 mm", "X90. or U60."),
        ("K-.8 X4. U1.5", "inch", "0.9252 in", "1.5000 in, X4. gives 2.4252 in", "X3.0748 or U2.4252"),
        ("K-20. Z-50. W-40.", "mm", "10.000 mm", "-40.000 mm, Z-50. gives -50.000 mm", "Z-40. or W-50."),
    ],
)
def test_differences_are_shown_as_words_are_written(words, units, by, states, change):
    start = START if units == "mm" else "X1.5748 Z0."
    finding = findings(f"G111 A170. {words}", start=start, units=units)["words-conflict"]
    _, first, last = words.split()
    assert finding.message == f"{last} disagrees with {first} by {by}: it states {states}"
    assert finding.notes[0].endswith(f": {by} apart")
    assert finding.notes[1] == f"change one: {change}"


@pytest.mark.parametrize(
    ("text", "line", "told"),
    [
        ("G00 X-1.6 Z0.\nG01 X18. ,C1. F0.2\nZ-30. ,R3.\nX36.", 2, "1|Z0.000 mm X-1.600 mm to Z0.000 mm X16.000 mm"),
        ("G00 X36. Z-30.\nG01 Z0. ,R3.\nX-1.6 ,R.5\nZ5.", 3, "2|Z0.000 mm X30.000 mm to Z0.000 mm X-0.600 mm"),
        (
            "G00 X-40. Z0.\nG01 Z-10. ,R2.\nX-20. ,C1.\nZ-20. ,R1.\nX30.",
            *(5, "4|Z-20.000 mm X-18.000 mm to Z-20.000 mm X30.000 mm"),
        ),
    ],
)
def test_a_path_across_the_spindle_axis_names_the_line_that_crosses_it(text, line, told):
    (finding,) = (each for each in check(text, control="fanuc-lathe") if each.code == "axis-crossed")
    number, places = told.split("|")
    assert finding.span.line == line
    assert finding.message == f"line {number} crosses the spindle axis: it goes from {places}"


def test_an_increment_in_brackets_is_offered_too():
    (finding, *_) = check("G17 G90 G0 X10 Y0\nG1 ANG=30\nM30", control="siemens-840d")
    assert {each.description: each.example for each in finding.fixes} == {
        "add X? (such as X20, X10.001 or above)": "G1 ANG=30 X20",
        "add Y? (such as Y10, Y0.001 or above)": "G1 ANG=30 Y10",
        "delete ANG=30": "",
        "add X=IC(?) (such as X=IC(10), X=IC(0.001) or above)": "G1 ANG=30 X=IC(10)",
        "add Y=IC(?) (such as Y=IC(10), Y=IC(0.001) or above)": "G1 ANG=30 Y=IC(10)",
    }


@pytest.mark.parametrize(
    ("words", "told", "off"),
    [
        # 90 degrees up from X40 by 20 mm to the radius, then back to Z-60: V1 lies at X80, the end farther down.
        ("Z-60. A90. I20. B200.", "40.000 mm in X (diameter)", 20.0),
        ("X100. A180. K-30. B60.", "17.321 mm in Z", 30 / 3**0.5),
    ],
)
def test_how_far_a_bevel_is_outside_is_told_as_its_axis_is_programmed(words, told, off):
    finding = findings(f"G111 {words} C5.")["g111-bevel-outside"]
    rest = "outside the rectangle between start and end of line 2"
    assert finding.message == f"C5.: the virtual intersection lies {told} {rest}"
    assert finding.values["off_by_mm"] == pytest.approx(off)


@pytest.mark.parametrize(
    ("end", "center", "other"),
    [((20, 10), (10, 5), 1), ((20, 10), (7, 11), 0), ((-30, 14), (-8, 22), 1), ((16, -24), (-4, -20), 0)],
)
def test_the_other_word_of_a_centre_is_offered_with_which_the_circle_passes_through_its_end(end, center, other):
    """Both ends of the arc are equally far from the centre: 2 (I x + J y) = x² + y²."""
    assert hypot(*center) == pytest.approx(hypot(end[0] - center[0], end[1] - center[1]))
    words = [f"I{center[0]}", f"J{center[1]}"]
    text = f"G17 G90 G1 G42 X0 Y0 F100\nG3 X{end[0]} Y{end[1]} {words[1 - other]} RND=2\nG1 X60 Y50"
    (finding,) = (each for each in check(text, control="siemens-840d") if each.code == "siemens-radius-difference")
    told = f"add {words[other]} to program line 2 -> V1 is at X{end[0]:.3f} mm Y{end[1]:.3f} mm"
    assert [each.description for each in finding.fixes if each.description.startswith(told)]


FORMS = {
    "yasnac-lx3": "G111 12, G112 3, G11 2, G12 2",
    "fanuc-lathe": "line-angle 2, corners 4, line-line 1, chain 2",
    "mitsubishi": "line-angle 2, corners 2, line-line 1, line-circle 1, circle-line 1",
}


@pytest.mark.parametrize("control", FORMS)
def test_every_example_of_a_form_is_a_contour_of_it(control):
    blocks = legal_blocks(DIALECTS[control])
    counts = {name: sum(each.form == name for each in blocks) for name in dict.fromkeys(each.form for each in blocks)}
    assert ", ".join(f"{name} {count}" for name, count in counts.items()) == FORMS[control]
    for each in blocks:
        (answer,) = solve(each.text, control=control, start=START).answers
        assert answer.claim.form.name == each.form
