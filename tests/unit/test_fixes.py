"""What a fix keeps and what it drops: words beside the contour, and the contour itself; how several are told apart."""

import pytest

from contoursolve import DIALECTS, Diagnostic, Fix, solve
from contoursolve.diagnostics import Applicability

START = "T0101 X40. Z0."  # the tool that is there
TAPER = "G111 X100. A180. K-30. B120."
MOVED = {
    "T0101": ("tool", "before"),
    "S500": ("spindle speed", "before"),
    "M3": ("spindle on", "before"),
    "M08": ("coolant on", "before"),
    "M09": ("coolant off", "after"),
    "M05": ("spindle off", "after"),
    "M00": ("stop", "after"),
    "M1": ("stop", "after"),
    "M30": ("end of program", "after"),
    "M41": ("machine function", "before"),
}


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


# Several fixes of one finding --------------------------------------------------------------------------------

REJECTED = [
    (name, text)
    for name, dialect in DIALECTS.items()
    for rule in dialect.catalogue
    for text in dict.fromkeys(rule.rejected)
]


def paths(text: str, control: str) -> list[tuple[float, ...]]:
    """The coordinates of all contours of a program, as far as a listing shows them."""
    answers = solve(text, control=control, depth="path").answers
    elements = (each for answer in answers if answer.contour for each in answer.contour.elements)
    return [tuple(round(value, 3) for value in (*each.start, *each.end)) for each in elements]


def outcomes(finding: Diagnostic) -> list[tuple[str, str]]:
    """What is behind the arrow of each fix, and the blocks that it writes."""
    shown = (each.description.partition(" -> ") for each in finding.fixes)
    return [(end, fix.replacement) for (_, arrow, end), fix in zip(shown, finding.fixes, strict=True) if arrow]
