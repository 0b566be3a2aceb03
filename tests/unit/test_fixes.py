"""What a fix keeps and what it drops: words beside the contour, and the contour itself; how several are told apart."""

import pytest

from contoursolve import Fix
from contoursolve.diagnostics import Applicability


@pytest.mark.parametrize(
    ("new", "wanted"),
    [
        ("a\nc", ["a", "", "c"]),
        ("b\nc", ["", "b", "c"]),
        ("a\nb", ["a", "b", ""]),
        ("a\nB", ["a", "B", ""]),
        ("a\nb\nn\nc", ["a", "b", "n\nc"]),
        ("n\na\nb\nc", ["n\na", "b", "c"]),
        ("a\nB\nc", ["a", "B", "c"]),
    ],
)
def test_lines_that_a_fix_drops_or_adds_leave_the_others_where_they_are(new, wanted):
    fix = Fix("", new, Applicability.CHANGES_CONTOUR, replaced="a\nb\nc")
    assert fix.by_line((3, 4, 6)) == dict(zip((3, 4, 6), wanted, strict=True))
