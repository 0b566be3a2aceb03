"""A letter typed for the digit that it looks like: the first fix writes the digit, tried and solved."""

import pytest

from contoursolve import solve
from contoursolve.diagnostics import Severity

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
