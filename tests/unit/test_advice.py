"""What a finding asks to add, to delete or to write helps: its words, its fixes and the equations agree."""

from math import hypot

import pytest

from contoursolve import CONTROLS, check, solve

START = "X40. Z0."


def test_an_increment_in_brackets_is_offered_too():
    (finding, *_) = check("G17 G90 G0 X10 Y0\nG1 ANG=30\nM30", control="siemens-840d")
    assert {each.description: each.example for each in finding.fixes} == {
        "add X? (such as X20, X10.001 or above)": "G1 ANG=30 X20",
        "add Y? (such as Y10, Y0.001 or above)": "G1 ANG=30 Y10",
        "delete ANG=30": "",
        "add X=IC(?) (such as X=IC(10), X=IC(0.001) or above)": "G1 ANG=30 X=IC(10)",
    }


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
    corner = f"the corner between program lines 2 and 3 is at X{end[0]:.3f} mm Y{end[1]:.3f} mm"
    told = f"add {words[other]} to program line 2 -> {corner}"
    assert [each.description for each in finding.fixes if each.description.startswith(told)]


FORMS = {
    "yasnac-lx3": "G111 36, G112 3, G11 2, G12 2",
    "fanuc-lathe": "line-angle 2, corners 4, line-line 1, chain 2",
    "mitsubishi": "line-angle 2, corners 2, line-line 1, line-circle 1, circle-line 1",
}


@pytest.mark.parametrize("control", FORMS)
def test_every_example_of_a_form_is_a_contour_of_it(control):
    blocks = CONTROLS[control].examples
    counts = {name: sum(each.form == name for each in blocks) for name in dict.fromkeys(each.form for each in blocks)}
    assert ", ".join(f"{name} {count}" for name, count in counts.items()) == FORMS[control]
    for each in blocks:
        (answer,) = solve(each.text, control=control, start=START).answers
        assert answer.claim.form.name == each.form
