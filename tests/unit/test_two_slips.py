"""Two slips at once: each has its finding and its fix, and the fixes apply one after the other."""

import pytest
from test_slip_corpus import mended

import contoursolve
from contoursolve.program import changed

TURNED = "G00 X40. Z-48.|G01 Z-60. ,R3. F0.2|X50. ,C1.|Z-75.|X60."
PLATE = "N10 G17 G90|N20 G0 X0 Y0|N30 G41 G1 X60 ,R8 F200|N40 Y40 ,C5|N50 X30 ,R8|N60 X0 Y0"


def one_after_the_other(control: str, text: str) -> str:
    """A program with its first fixes."""
    return "|".join(mended({"control": control, "slip": text.split("|"), "settings": []}))


CASES = {
    "letter": ("fanuc-lathe", TURNED, {"X50.": "X5O.", ",R3.": ",R30."}),
    "comma": ("fanuc-lathe", TURNED, {",C1.": "C1.", ",R3.": ",R30."}),
    "two commas": ("fanuc-lathe", TURNED, {",C1.": ",,C1.", ",R3.": ",R30."}),
    "comma for point": ("fanuc-lathe", TURNED, {",C1.": ",C1,", ",R3.": ",R30."}),
    "mill": ("nct-99m", PLATE, {"Y40": "Y4O", "X30 ,R8": "X30 ,R88"}),
}


@pytest.mark.parametrize("name", CASES)
def test_two_slips_have_a_finding_and_a_fix_each(name):
    control, right, slips = CASES[name]
    text = right
    for meant, typed in slips.items():
        text = text.replace(meant, typed, 1)
    result = contoursolve.solve(text.replace("|", "\n"), control=control)
    errors = [each for each in result.diagnostics if each.is_error]
    assert len(errors) == len(slips)
    for each in errors:
        # A finding points at what is typed, and its fix changes that line alone.
        span = each.labels[0].span
        assert any(span_text(text, span) in typed for typed in slips.values())
        new = each.fixes[0].by_line(result.lines_of(each))
        assert [line for line in new if new[line] != text.split("|")[line - 1]] == [span.line]
    assert one_after_the_other(control, text) == right


def span_text(text: str, span: tuple[int, int, int]) -> str:
    return text.split("|")[span[0] - 1][span[1] - 1 : span[2] - 1]


TOGETHER = {
    "code and sign": (
        "fanuc-mill",
        "G17 G90|G00 X-10. Y-12.|G01 Y30. F250.|X25. ,R5.|G03 X45. Y10. R20.|G01 X70. ,C4.|Y-20. ,R8.|X-10.|Y-12.",
        {"G01 X70.": "X70.", "Y-20.": "Y20."},
    ),
    "angle of 0 and sign": (
        "yasnac-lx3",
        "G00 X60. Z2.|G01 Z0. F0.15|G111 A180. K-25. B210. X40. P3. Q2.|G01 Z-70.|X34.",
        {"A180.": "A0.", "Z-70.": "Z70."},
    ),
}


@pytest.mark.parametrize("name", TOGETHER)
def test_one_fix_undoes_two_slips_that_no_single_one_explains(name):
    control, right, slips = TOGETHER[name]
    text = right
    for meant, typed in slips.items():
        text = text.replace(meant, typed, 1)
    result = contoursolve.solve(text.replace("|", "\n"), control=control)
    finding, fix = next((each, fix) for each in result.diagnostics for fix in each.fixes)
    changes = contoursolve.editing.changes_of(fix, result.lines_of(finding), dict(enumerate(text.split("|"), 1)))
    assert changed(text.replace("|", "\n"), changes).split("\n") == right.split("|")


LOST = {
    "before another contour": (
        "G00 X40. Z-48.|G01 Z-60. ,R3. F0.2|X50. ,C1.|Z-75.|X56. Z-80. ,R1.|Z-95.|X62.",
        ("Z-75.", "Z-75"),
    ),
    "outside contours": ("G00 X40. Z-48.|G01 Z-60. ,R3. F0.2|X50. ,C1.|Z-75.|X60.|Z-105.|X72.", ("Z-105.", "Z-105")),
    "beside another slip": ("G00 X40. Z-48.|G01 Z-60. ,R3. F0.2|X50. ,C1.|Z-75.|X60.", ("Z-75.", "Z-75")),
}


@pytest.mark.parametrize("name", LOST)
def test_a_lost_point_is_the_first_error_and_nothing_else_is_blamed_for_it(name):
    right, (meant, typed) = LOST[name]
    text = right.replace(meant, typed)
    result = contoursolve.solve(text.replace("|", "\n"), control="fanuc-lathe")
    (finding,) = result.diagnostics
    assert (finding.code, finding.is_error) == ("point-lost", True)
    assert one_after_the_other("fanuc-lathe", text) == right
    both = text.replace(",R3.", ",R30.")
    found = contoursolve.solve(both.replace("|", "\n"), control="fanuc-lathe").diagnostics
    assert [each.code for each in found] == ["point-lost", "fanuc-corner-too-large"]
    assert one_after_the_other("fanuc-lathe", both) == right


@pytest.mark.parametrize(
    "text",
    [
        "G00 X40. Z2.|G01 Z-60. ,R3. F0.2|X50. ,C1.|Z-75.|X60.|Z5",  # the path goes no farther than with the point
        "G00 X40000 Z-48000|G01 Z-60000 ,R3000 F0.2|X50000 ,C1000|Z-75000|X60000|Z-750",  # nothing has a point
        "G00 X40. Z-48.|G01 Z-60. ,R3. F0.2|X50. ,C1.|Z-75.|X60.|G04 X75",  # a dwell
    ],
)
def test_a_number_without_a_point_that_may_be_meant_is_no_lost_one(text):
    found = contoursolve.solve(text.replace("|", "\n"), control="fanuc-lathe").diagnostics
    assert all(each.code != "point-lost" for each in found)


def test_a_fix_that_keeps_the_contour_does_not_hide_a_likelier_slip():
    text = "G17 G90 G21 G00 X0. Y0.\nG01 X0. Y-18. ,C2. F300.\nX-7.5 Y-730.99\nX22.95 Y-760.24\nG00 Z50.\nM30\n"
    (finding,) = contoursolve.solve(text, control="fanuc-mill").diagnostics
    assert [each.applicability.value for each in finding.fixes[:2]] == ["changes-contour", "safe"]
    assert contoursolve.fix(text, control="fanuc-mill").text == text
    mended = contoursolve.fix(text, control="fanuc-mill", unsafe=True).text
    assert mended == text.replace("Y-730.99", "Y-73.99")


def test_a_list_of_fixes_is_short_and_its_numbers_were_tried():
    text = (
        "0 BEGIN PGM HH MM|1 L X+0 Y+0 RL F300|2 FL AN+6|3 FC DR- R30 CCX+40 CCY+40|4 FSELECT 1|5 FLT X+100 Y+20"
        "|6 END PGM HH MM"
    )
    (finding,) = contoursolve.solve(text.replace("|", "\n"), control="heidenhain").diagnostics
    assert 2 <= len(finding.fixes) <= 4
    assert finding.fixes[0].description.startswith("write AN+60 for AN+6 (a lost zero)")
    for fix in finding.fixes:
        for number in fix.numbers:
            lines = [each.replace(number.word, number.example) for each in fix.replacement.split("\n")]
            whole = [text.split("|", maxsplit=1)[0], text.split("|")[1], *lines, text.rsplit("|", maxsplit=1)[-1]]
            assert contoursolve.solve("\n".join(whole), control="heidenhain").answers[0].contour is not None


def test_no_fix_leaves_a_mistake_in_the_last_block_of_a_program():
    """With its two contours exchanged, the chamfer of the last one is too large in place of that of the first."""
    text = "G50 X300. Z200.\nG00 X12. Z0.\nG11 X7.5 K7.5\nG12 Z-20. I3."
    first, *_ = contoursolve.check(text, control="yasnac-lx3")
    assert [each.description.split()[0] for each in first.fixes] == ["write"] * len(first.fixes) != []
