"""The worked examples of both control sheets, to the digits that they print.

Programs of the NCT manual are printed in it; where its results, and the YASNAC examples as a whole, are
marked derived, they were computed from the page by hand and not by this package.
"""

from dataclasses import dataclass, field

import pytest
from oracle import Number, Outcome, circle_line, g111, largest_gap

from contoursolve import Answer, ArcSegment, solve

Point = tuple[str, str]
"""As printed: a computed value agrees if it rounds to these digits."""


@dataclass
class Example:
    """A block or pair, where it is from, and the ends of its elements."""

    source: str
    """Manual, page, and what is printed and what derived."""
    program: str
    vertices: tuple[Point, ...]
    arcs: tuple[tuple[str, str], ...] = ()
    """Radius and turn of each arc."""
    points: dict[str, Point] = field(default_factory=dict)


LX3 = "YASNAC LX3 2.8.30, p. 136-140: words printed, block and results derived"
NCT = "NCT 99M 16.3.3, p. 130: program printed, result derived"

# Z and X as radius.
TAPERS = {
    "two bevels": Example(
        LX3,
        "G00 X40. Z0.\nG111 X100. A180. K-30. B120. C5. D5.",
        (("-27.8868", "20"), ("-32.8868", "25"), ("-44.4338", "45"), ("-49.4338", "50")),
        points={"V1": ("-30", "20"), "V2": ("-47.3205", "50")},
    ),
    "two roundings": Example(
        LX3,
        "G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.",
        (("-27.1132", "20"), ("-31.4434", "22.5"), ("-45.8771", "47.5"), ("-50.2073", "50")),
        (("5", "cw"), ("5", "ccw")),
        {"V1": ("-30", "20"), "V2": ("-47.3205", "50")},
    ),
    "two roundings, by Z": Example(
        LX3,
        "G00 X40. Z0.\nG111 Z-60. A180. K-30. B120. P5. Q5.",
        (("-27.1132", "20"), ("-31.4434", "22.5"), ("-59.3301", "70.8013"), ("-60", "73.3013")),
        (("5", "cw"), ("5", "cw")),
        {"V1": ("-30", "20"), "V2": ("-60", "71.9615")},
    ),
    "a bevel, by W": Example(
        LX3,
        "G00 X40. Z0.\nG111 W-60. A180. K-30. B150. D5.",
        (("-30", "20"), ("-55", "34.4338"), ("-60", "39.4338")),
        points={"V1": ("-30", "20"), "V2": ("-60", "37.3205")},
    ),
}
"""Both printed formats: the end by X(U), which corner 2 leaves along Z, and by Z(W), which it leaves along X."""

_P130 = "N10 G17 G0 X90 Y0 M3 S200\nN20 G42 G1 X50 D0\nN30 G3 X-50 Y0 R50\nN40 G1 X-50 Y{y} ,A{a} Q{q}\nN50 G40 G0 Y70"
_PRINTED = {"y": "42.857", "a": "171.87"}
_EXACT = {"y": "42.857142857143", "a": "171.869897645844"}
"""The line through (40, 30) and (-30, 40): its slope is -1/7."""

PAIRS = {
    "Q-1, printed decimals": Example(
        NCT, _P130.format(q=-1, **_PRINTED), (("39.99998", "30.00002"), ("-50", "42.857")), (("50", "ccw"),)
    ),
    "Q1, printed decimals": Example(
        NCT, _P130.format(q=1, **_PRINTED), (("-30.00012", "39.99991"), ("-50", "42.857")), (("50", "ccw"),)
    ),
    "Q-1, exact": Example(
        NCT, _P130.format(q=-1, **_EXACT), (("40.0000000", "30.0000000"), ("-50", "42.8571429")), (("50", "ccw"),)
    ),
    "Q1, exact": Example(
        NCT, _P130.format(q=1, **_EXACT), (("-30.0000000", "40.0000000"), ("-50", "42.8571429")), (("50", "ccw"),)
    ),
}


def rounds_to(value: float, digits: str) -> bool:
    decimals = len(digits.partition(".")[2])
    return abs(value - float(digits)) <= 0.5 * 10**-decimals if decimals else abs(value - float(digits)) <= 1e-9


def assert_matches(answer: Answer, example: Example) -> None:
    assert answer.status.value == "solved", example.source
    assert [each for each in answer.diagnostics if each.severity.value != "info"] == []
    contour = answer.contour
    found = [element.end for element in contour.elements] + [contour.points[name] for name in example.points]
    for at, expected in zip(found, (*example.vertices, *example.points.values()), strict=True):
        assert all(map(rounds_to, at, expected)), (at, expected, example.source)
    arcs = [each for each in contour.elements if isinstance(each, ArcSegment)]
    assert [(f"{arc.radius:g}", arc.turn.value) for arc in arcs] == list(example.arcs)
    assert contour.end == contour.elements[-1].end


@pytest.mark.parametrize("name", TAPERS)
def test_the_tapers_of_the_yasnac_sheet_come_out_to_its_digits(name: str) -> None:
    assert_matches(solve(TAPERS[name].program).answers[0], TAPERS[name])


@pytest.mark.parametrize("name", PAIRS)
def test_the_pairs_of_the_nct_sheet_come_out_to_its_digits(name: str) -> None:
    result = solve(PAIRS[name].program)
    assert result.control == "nct-99m"
    (answer,) = result.answers
    assert answer.lines == (3, 4)
    assert answer.sides["P1"].value == ("nearer" if "Q-" in name else "farther")
    assert answer.contour.points["P1"] == answer.contour.elements[0].end
    assert_matches(answer, PAIRS[name])


def test_a_taper_in_the_forbidden_band_is_refused_for_both_bevels() -> None:
    """YASNAC sheet, third example, derived: both setbacks are negative; alarm 146 is assumed for G111."""
    result = solve("G00 X40. Z0.\nG111 X60. A180. K-30. B160. C2. D2.")
    assert result.answers[0].status.value == "no-solution"
    assert result.answers[0].contour is None
    errors = [each for each in result.diagnostics if each.severity.value == "error"]
    assert {(each.alarm.number, each.addresses) for each in errors if each.alarm} == {("146", ("C",)), ("146", ("D",))}


@pytest.mark.parametrize(
    ("start", "words", "end"),
    [
        (20j, {"X": 100, "A": 180, "K": -30, "B": 120, "C": 5, "D": 5}, -49.4338 + 50j),
        (20j, {"X": 100, "A": 180, "K": -30, "B": 120, "P": 5, "Q": 5}, -50.2073 + 50j),
    ],
)
def test_the_oracle_agrees_with_the_yasnac_sheet(start: complex, words: dict[str, Number], end: complex) -> None:
    assert abs(g111(start, words).end - end) < 1e-4
    assert g111(start, {**words, "X": 60, "B": 160}).status == ("no-solution" if "C" in words else "solved")


@pytest.mark.parametrize(("side", "crossing"), [(-1, 39.99998 + 30.00002j), (1, -30.00012 + 39.99991j)])
def test_the_oracle_agrees_with_the_nct_sheet(side: int, crossing: complex) -> None:
    arc, line = {"X": -50, "Y": 0, "R": 50}, {"X": -50, "Y": 42.857, ",A": 171.87, "Q": side}
    outcome: Outcome = circle_line(17, 50, "ccw", arc, line)
    assert abs(outcome.points["P1"] - crossing) < 1e-5
    solved = solve("G17 G42 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q" + str(side))
    assert largest_gap(outcome, solved.answers[0].contour) < 1e-12
