"""Wrong arguments of public functions: an error that names the argument and what fits, and none from inside."""

from inspect import Parameter, isclass, signature

import pytest

import contoursolve

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
FUNCTIONS = [
    name for name in contoursolve.__all__ if callable(each := getattr(contoursolve, name)) and not isclass(each)
]
OWN_OF_PYTHON = ("expected string or bytes-like", "is not iterable", "has no len", "has no attribute", "unhashable")


def required(function):
    """The names of the arguments that it needs, and those of them that go by name alone."""
    own = [each for each in signature(function).parameters.values() if each.default is Parameter.empty]
    own = [each for each in own if each.kind not in (Parameter.VAR_KEYWORD, Parameter.VAR_POSITIONAL)]
    return [each.name for each in own], {each.name for each in own if each.kind is Parameter.KEYWORD_ONLY}


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("wrong", [("A", 1), 5, object()], ids=["a tuple", "a number", "an object"])
def test_an_argument_of_another_type_is_named(name, wrong):
    function = getattr(contoursolve, name)
    names, by_name = required(function)
    with pytest.raises((TypeError, ValueError)) as caught:
        function(*(wrong for each in names if each not in by_name), **dict.fromkeys(by_name, wrong))
    assert not any(each in str(caught.value) for each in OWN_OF_PYTHON), str(caught.value)


def test_what_is_given_in_another_form_is_told_with_what_fits():
    result = contoursolve.solve(BLOCK, start={"X": 40, "Z": 0})
    assert result.answers[0].contour == contoursolve.solve(BLOCK, start=START).answers[0].contour
    for ask, message in (
        (
            lambda: contoursolve.solve(BLOCK, start=(40, 0)),
            'the start is words such as "X40. Z0.", or {"X": 40, "Z": 0}',
        ),
        (lambda: contoursolve.family(BLOCK, vary={"A": [1]}, start=(40, 0)), 'or {"X": 40, "Z": 0}, not (40, 0)'),
        (
            lambda: contoursolve.solve(BLOCK, start={"Q": 40, "Z": 0}),
            'the start "Q40.0 Z0.0": Q40.0 states no place; the axes of yasnac-lx3 are X and Z',
        ),
        (lambda: contoursolve.solve(BLOCK, start={"X": "a"}), "X of the start is a number, not 'a'"),
        (lambda: contoursolve.solve(BLOCK, variables=5), 'variables is a mapping of variables, such as {"#100": 95.0}'),
        (lambda: contoursolve.ranges(BLOCK, "A", settings=5), "settings is a mapping of settings, such as"),
        (lambda: contoursolve.solve(BLOCK, facts=[5]), 'a fact is a text such as "length of line 1 = 30"'),
        (lambda: contoursolve.solve(BLOCK, trust=5), 'trust is words, such as "Z-50. A120.", not 5'),
        (lambda: contoursolve.Sketch().solve(), "the sketch is empty; add a line, an arc or a circle"),
        (lambda: contoursolve.parse(("G1", "X2")), "text is a text (str), or a Path, not ('G1', 'X2')"),
        (lambda: contoursolve.check(5), "the program is a text (str), a Path or a Program, not int"),
    ):
        with pytest.raises((TypeError, ValueError)) as caught:
            ask()
        assert message in str(caught.value), str(caught.value)
