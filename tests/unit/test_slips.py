"""A letter typed for the digit that it looks like: the first fix writes the digit, tried and solved."""

import re

import pytest

from contoursolve import Status, solve
from contoursolve.diagnostics import Severity

TAPER = "N10 G111 X100. A180. K-30. B120. P5. Q5."
BLOCKS = {
    "G111": ("yasnac-lx3", "G00 X40. Z0.\n", TAPER),
    "G112": ("yasnac-lx3", "G00 X100. Z-50.\n", "G112 U0 I10. K-50. P5. Q5. R30."),
    "G11": ("yasnac-lx3", "G00 X30. Z0\n", "G11 Z-20. I8. F30."),
    "circle-line": ("nct-99m", "G17 G42 G0 X50 Y0\nG3 X-50 Y0 R50\n", "G1 X-50 Y42.857 ,A171.87 Q-1"),
}
SHAPES = {"1": "lI", "0": "Oo"}


CASES = [
    (name, block[:at] + letter + block[at + 1 :])
    for name, (_, _, block) in BLOCKS.items()
    for at, digit in enumerate(block)
    for letter in SHAPES.get(digit, "")
    if not block[:at].strip().startswith("N1")
]
"""Each block with each digit in turn that looks like a letter as that letter, numbers of blocks apart."""


def fixes_of(text: str, **options: str) -> list[str]:
    """The fixes of the finding that has some."""
    return [fix.replacement for each in solve(text, **options).diagnostics for fix in each.fixes]


# A line that a contour ends with is none by itself, and `I.87` is a word that the control reads.
NOT_MENDED = {"Gl X-50 Y42.857 ,A171.87 Q-1", "GI X-50 Y42.857 ,A171.87 Q-1", "G1 X-50 Y42.857 ,A17I.87 Q-1"}


@pytest.mark.parametrize(("name", "text"), CASES)
def test_a_letter_for_a_digit_is_found_and_the_first_fix_writes_the_digit(name, text):
    control, before, block = BLOCKS[name]
    result = solve(before + text, control=control)
    assert result.has_errors
    fixes = [fix.replacement for each in result.diagnostics for fix in each.fixes]
    assert text in NOT_MENDED or fixes[0].split("\n")[-1] == block


@pytest.mark.parametrize("code", ["G11l", "G1l1", "GIII", "Glll", "g1I1", "G 1l1", "GlllXlOO.A18O. (GO) ;l"])
@pytest.mark.parametrize("control", ["yasnac-lx3", None])
def test_a_code_with_letters_for_digits_is_told_as_the_code_whether_or_not_the_control_is_known(code, control):
    rest = " X100. A180. K-30. B120." if "X" not in code else ""
    text = code.replace("A18O.", "A18O. K-30. B120.") + rest
    meant = re.sub(r"(?i)^g *[1lI]{3}(?=[ X])", lambda found: found[0].replace("l", "1").replace("I", "1"), text)
    meant = meant.replace("XlOO.", "X100.").replace("A18O.", "A180.")
    assert fixes_of(text, start="X40. Z0.", control=control)[0] == meant
    assert solve(meant, start="X40. Z0.").answers[0].status is Status.SOLVED


def test_a_block_that_is_read_without_an_error_gets_a_warning_that_names_the_code():
    before = TAPER.removesuffix(" Q5.")
    found = solve(f"G00 X40. Z0.\n{before}\nG1l1 A180. B120. X160. Z-80.", control="yasnac-lx3").diagnostics
    (finding,) = found
    assert (finding.code, finding.severity, finding.span.line) == ("letter-for-digit", Severity.WARNING, 3)
    assert "with G111 this block would be a contour" in finding.message
    assert [fix.replacement for fix in finding.fixes] == ["G111 A180. B120. X160. Z-80."]
    # Not solved: told, and not offered as a fix.
    (finding,) = solve(f"G00 X40. Z0.\n{before}\nG1l1 A180. B120. X160.", control="yasnac-lx3").diagnostics
    assert (finding.code, finding.fixes) == ("letter-for-digit", ())


@pytest.mark.parametrize(
    ("text", "mended"),
    [
        ("G1 X10 Y5 (G1l1 X5)", None),
        ("G17 G0 X0 Y0\nG2X10Y0I5J0", None),
        ("O1001\nG1 X1O", "G1 X10"),
        ("GO X10.", "G0 X10."),
        ("(GIII)\nGOTO 10", None),
        ("TOOL 1", None),
        ("", None),
    ],
)
def test_what_is_no_contour_with_digits_either_is_not_called_one(text, mended):
    for control in ("yasnac-lx3", "nct-99m", None):
        assert fixes_of(text, control=control)[:1] in ([], [mended])
        assert "letter-for-digit" not in {each.code for each in solve(text, control=control).diagnostics}


ASKED = {
    "G11l X100. A180. K-30. B120.": ("number-missing", "letter l in G11l: did you mean the digit 1 (G111)?"),
    "GIII X100. A180. K-30. B120.": ("number-missing", "letter I in GIII: did you mean the digit 1 (G111)?"),
    "G111 X1OO. A180. K-30. B120.": ("number-missing", "letter O in X1OO.: did you mean the digit 0 (X100.)?"),
    "G111 X100. A180. K-3O.l B120.": (
        "number-malformed",
        "letters O and l in K-3O.l: did you mean the digits 0 and 1 (K-30.1)?",
    ),
    "G111 X1l0. A180. K-30. B120.": ("address-unknown", "letter l in X1l0.: did you mean the digit 1 (X110.)?"),
}


@pytest.mark.parametrize("text", ASKED)
def test_a_letter_for_a_digit_is_asked_about_and_nothing_is_said_that_follows_from_it(text):
    (finding,) = solve(text, start="X40. Z0.", control="yasnac-lx3").diagnostics
    code, message = ASKED[text]
    assert (finding.code, finding.message) == (code, message)
    assert all("delete" not in fix.description for fix in finding.fixes)


def test_a_code_with_a_letter_is_not_taken_for_another_code():
    # G11 X80. K5. would be a contour, and is not what anybody wrote.
    (finding,) = solve("G00 X60. Z0.\nG11l X80. K5.").diagnostics
    assert (finding.fixes, finding.help.partition(" if")[0]) == ((), "write G111 for G11l")


def test_a_word_that_means_what_it_says_is_no_part_of_another_one():
    (finding,) = solve("G111 A135. B180. Z-60. K I5.", start="X40. Z0.").diagnostics
    assert finding.message == "K has no number"
    assert [fix.replacement for fix in finding.fixes] == ["G111 A135. B180. Z-60. I5."]


def test_a_word_that_a_letter_cuts_short_is_not_said_to_lack_its_point():
    found = solve("G111 A18O. B120 K-30. X100.", start="X40. Z0.").diagnostics
    assert {each.code: each.addresses for each in found} == {"number-malformed": ("O",), "point-missing": ("B",)}


MENDED = {
    "G111 X100. A180. K-20.. B120.": "G111 X100. A180. K-20. B120.",
    "G111 X100. A180. K--20. B120.": "G111 X100. A180. K-20. B120.",
    "G111 X100. A180. K- 20. B120.": "G111 X100. A180. K-20. B120.",
    "G111 X100. A180. K20.- B120.": "G111 X100. A180. K-20. B120.",
    "G111 X100. A180. K-30. P2, B135.": "G111 X100. A180. K-30. P2. B135.",
    "G111 X100. A180, K-30. B135.": "G111 X100. A180. K-30. B135.",
    "G111 X100. A180.,K-30. B135.": "G111 X100. A180.K-30. B135.",
    "G111 X100. A180. K-30. B135. P5,": "G111 X100. A180. K-30. B135. P5.",
    "G111 X100. A180. K-30. B135. P5, (finish)": "G111 X100. A180. K-30. B135. P5. (finish)",
    "G111 X100. A180. K-30. B135. P5..": "G111 X100. A180. K-30. B135. P5.",
    "G111 X100. A180. K=-30. B135.": "G111 X100. A180. K-30. B135.",
    "G111 X100. A180. K = -30.5 B135.": "G111 X100. A180. K-30.5 B135.",
    "G111 X100. A180. K-30,5 B135.": "G111 X100. A180. K-30.5 B135.",
}


@pytest.mark.parametrize("text", MENDED)
def test_a_comma_a_point_or_a_sign_too_many_is_asked_about_and_the_first_fix_is_what_was_meant(text):
    findings = solve(text, start="X40. Z0.", control="yasnac-lx3").diagnostics
    errors = [each for each in findings if each.severity is Severity.ERROR]
    assert [fix.replacement for fix in errors[0].fixes][:1] == [MENDED[text]]
    assert all("is not a number that a control reads: did you mean" in each.message for each in errors)
    # What the help says is what the first fix does.
    assert errors[0].fixes[0].description.startswith(errors[0].help.partition(" if")[0].partition(";")[0])


def test_a_slip_in_a_line_of_a_loop_is_mended_where_it_stands():
    text = "O2\n#100=5.\nWHILE[#100 LT 8.]DO1\nG01 X40. Z12,50\nG01 Z-30. ,R#100 F0.2\nG01 X100. ,A120.\n"
    text += "#100=#100+1.\nEND1\nM30\n"
    (found,) = (each for each in solve(text, control="fanuc-lathe").diagnostics if each.span.line == 4)
    assert [fix.replacement for fix in found.fixes] == ["G01 X40. Z12.50"]
