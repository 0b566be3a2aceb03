"""Exercises: numbers are drawn, one answer is right, each other one is a misreading that makes a contour."""

import re

import pytest

import contoursolve

TAPER = "G111 X100. A180. K-30. B120. P5."
LATHE = "G01 ,A150.\nX60. Z-50. ,A180."


@pytest.mark.parametrize(
    ("block", "ask", "options"),
    [
        (TAPER, "V2 Z", {"start": "X40. Z0."}),
        (TAPER.replace("A180.", "A170."), "V1 X", {"start": "X40. Z0."}),
        (LATHE, "P1 Z", {"start": "X40. Z0.", "control": "fanuc-lathe"}),
    ],
)
@pytest.mark.parametrize("seed", [1, 2])
def test_one_answer_is_right_and_each_other_one_is_a_misreading(block, ask, options, seed):
    made = contoursolve.exercise(block, ask, seed=seed, **options)
    assert made == contoursolve.exercise(block, ask, seed=seed, **options)
    point, axis = ask.split()

    def value(text):
        (answer,) = contoursolve.solve(text, **options).answers
        at = answer.contour.points[point]
        return 2 * at[1] if axis == "X" else at[0]

    letters = dict(made.letters)
    assert letters[made.right].value == pytest.approx(value(made.block), abs=1e-9)
    assert len({round(choice.value, 2) for choice in made.choices}) == len(made.choices) > 1
    for choice in made.choices:
        if not choice.is_right:
            text, typed = re.match(r"(\S+) in place of (\S+):", choice.why).groups()
            assert made.block.count(typed) == 1
            assert choice.value == pytest.approx(value(made.block.replace(typed, text)), abs=1e-9)
    assert made.solution.steps


def test_the_answer_is_hidden_until_somebody_asks():
    made = contoursolve.exercise(TAPER, "V2 Z", seed=4, start="X40. Z0.")
    shown = made._repr_mimebundle_()
    assert "in place of" not in shown["text/plain"] == str(made)
    assert shown["text/html"].index("<details") < shown["text/html"].index("in place of")


@pytest.mark.parametrize(
    ("block", "ask", "told"),
    [
        (TAPER, "V9 Z", "an exercise asks for V1 Z, V1 X, V2 Z, V2 X, end Z or end X; not for V9 Z"),
        (TAPER, "V2", "not for V2"),
        ("G01 X10.", "end Z", "an exercise takes one contour"),
        ("G111 A90. B180. Z-30.", "end Z", "an exercise takes a block that has a contour as it stands"),
    ],
)
def test_what_makes_no_exercise_is_told(block, ask, told):
    with pytest.raises(ValueError, match=told):
        contoursolve.exercise(block, ask, start="X40. Z0.")


@pytest.mark.parametrize("most", [0, -1, 26])
def test_no_exercise_has_more_answers_than_letters(most):
    with pytest.raises(ValueError, match=f"most cannot be {most}; an exercise has 1 to 25 wrong answers"):
        contoursolve.exercise(TAPER, "V2 Z", seed=4, start="X40. Z0.", most=most)
