"""Several fixes of one finding: what is shown behind the arrow tells their contours apart."""

import re

import pytest

from contoursolve import Diagnostic, check, solve
from contoursolve.controls import DIALECTS

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


@pytest.mark.parametrize(("name", "text"), REJECTED[::4])
def test_fixes_that_make_different_contours_do_not_look_alike(name, text):
    for finding in check(text, control=name):
        told = outcomes(finding)
        for place, (end, block) in enumerate(told):
            for other_end, other in told[:place]:
                if end == other_end and len(block.split("\n")) == len(other.split("\n")) == 1:
                    before = text.split("\n")[: finding.span.line - 1]
                    made = [paths("\n".join([*before, each]), name) for each in (block, other)]
                    assert made[0] == made[1], (text, finding.message, end)


@pytest.mark.parametrize(
    ("block", "ends"),
    [
        ("G111 X100. A180. K-30. B120. C5. P5.", ["corner 1 with radius 5.000 mm", "corner 1 7.071 mm long"]),
        ("G111 X100. A180. K-30. B120. P60. Q5.", ["corner 1 with radius 51.961 mm", "without corner 1"]),
        (
            "G111 X100. A180. K-30. B120. D5. Q5.",
            ["corner 1 7.071 mm long", "corner 1 with radius 5.000 mm", "without corner 1"],
        ),
    ],
)
def test_what_differs_is_shown(block, ends):
    finding = next(each for each in check(block, control="yasnac-lx3", start="X40. Z0.") if each.fixes)
    shown = [end for end, _ in outcomes(finding)]
    assert [end for end in ends if not any(each.endswith(end) for each in shown)] == []
    assert len(shown) == len({*shown})


def test_fixes_that_make_one_contour_show_one_place():
    finding = check("G111 X100. A180. K-30. B120. U60.", control="yasnac-lx3", start="X40. Z0.")[0]
    assert len({re.sub(r".*-> ", "", each.description) for each in finding.fixes}) == 1


@pytest.mark.parametrize(("name", "text"), REJECTED[::4])
def test_a_line_with_a_number_is_an_element_and_a_line_of_the_program_is_called_so(name, text):
    # Far down in its program, no line of it has the number of an element.
    shifted = "\n" * 40 + text
    result = solve(shifted, control=name, depth="path")
    told = [
        each
        for finding in result.diagnostics
        for each in (finding.message, finding.help, *finding.notes, *(fix.description for fix in finding.fixes))
    ]
    lines = {
        int(number)
        for each in told
        for number in re.findall(r"(?<!program )\b[Ll]ines? (\d+)", each.replace("G-code", ""))
    }
    # The line 99 that a fact states is no line of any program, nor an element.
    assert not [each for each in lines if each > 40 and each != 99], told
