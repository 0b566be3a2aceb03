"""Where a contour exists: every range of a word's values, with what ends it; and regions of two words."""

from math import radians

import numpy as np
import pytest
from click.testing import CliRunner

from contoursolve import family, ranges
from contoursolve.cli import main
from contoursolve.errors import FamilyError
from contoursolve.families import outcomes_of
from contoursolve.solving import Status

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
LATHE = {"start": START}
MILL = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 {} {}\nG1 X-50 Y42.857 {}"
CIRCLE_LINE = MILL.format("R50", "", ",A171.87 Q-1")


def only(found):
    (interval,) = found.intervals
    return interval


def test_ranges_of_a_few_thousandths_are_found_in_a_wide_range():
    block = "G111 X100. A180. K-30. B120. I0. P5."
    found = only(ranges(block, "I", start=START, rules="off", within=(-5000, 5000)))
    # Two coordinates in X and the angle, each exact to half its increment.
    allowed = 0.0005 + 30 * radians(0.0005) + 1e-9
    assert (found.low.value, found.high.value) == (pytest.approx(-allowed), pytest.approx(allowed))


@pytest.mark.parametrize(
    ("block", "word", "within", "message"),
    [
        (BLOCK, "R", None, "the block has no word R"),
        (BLOCK, "P", (5, 1), "no range"),
        (BLOCK, "P", (1, float("inf")), "no range"),
        pytest.param(BLOCK, "P", (0, 1_000_001), "beyond 1,000,000 mm", marks=pytest.mark.boundary),
        (BLOCK, "P", 5, "two numbers"),
        # It chooses between two intersections.
        (CIRCLE_LINE, "Q", None, "it has no range"),
    ],
)
def test_a_range_that_makes_no_sense_is_refused(block, word, within, message):
    options = LATHE if block == BLOCK else {}
    with pytest.raises(FamilyError, match=message):
        ranges(block, word, within=within, **options)


REGIONS = {
    "two roundings": (BLOCK, LATHE, ("A", "P"), ((100, 300), (-2, 60))),
    "two angles": (BLOCK, LATHE, ("A", "B"), ((95, 265), (5, 175))),
    "bevels": ("G111 X100. A180. K-30. B120. C5. D5.", LATHE, ("K", "C"), ((-40, 5), (0, 30))),
    "an arc": ("G112 X50. K-30. I-10. R20. P2. Q2.", LATHE, ("R", "P"), ((-1, 60), (-0.1, 9))),
    "a circle": (CIRCLE_LINE, {}, (",A", "R"), ((160, 260), (40, 80))),
}


def crossings(found, value):
    """Where a line at a value of the first word crosses the lines of a region, by linear interpolation."""
    for each in found.boundaries:
        points = np.array(each.points)
        first, second = points.T
        for place in np.flatnonzero((first[1:] - value) * (first[:-1] - value) < 0):
            share = (value - first[place]) / (first[place + 1] - first[place])
            yield second[place] + share * (second[place + 1] - second[place])


@pytest.mark.slow
def test_every_value_of_a_region_has_the_outcome_of_its_single_solve_and_rules_bound_it_too():
    block, options, words, within = REGIONS["two roundings"]
    found = ranges(block, words, within, **options)
    axes = [np.linspace(*ends, count) for ends, count in zip(within, found.outcomes.shape, strict=True)]
    every = family(block, vary=dict(zip(words, axes, strict=True)), **options)
    same = found.outcomes == outcomes_of(every["status"], every["reason"])
    # Only what is narrower than the first samples stand apart may differ.
    assert (~same).mean() < 1e-3
    assert [each.reason.text for each in found.boundaries] == [
        "P is too large for the first straight",
        "P is too large for the second straight",
        "the control refuses such values of P; `contoursolve explain g111-corner-sign` says why",
        "a point lies farther away than words reach",
    ]


NOT_CLOSED = "no range with a contour (proven)\n  as it stands, the block has none: the rounding P60. does not fit: P60"
FACT = ["--fact", "straight part of line 2 = 20", "--word", "straight part of line 2"]


@pytest.mark.parametrize(
    ("block", "arguments", "status", "told"),
    [
        (BLOCK, ["--word", "p"], 0, "P at most 51.961 mm"),
        (BLOCK, ["--word", "P", "--within", "55:60"], 1, "no range"),
        (BLOCK, ["--word", "A", "--word", "P"], 2, "--within"),
        (BLOCK.replace("P5.", "P60."), ["--word", "P", "--within", "55:60"], 1, NOT_CLOSED),
        (BLOCK.replace("P5.", "P?").replace(" Q5.", ""), FACT, 0, "straight part of line 2, now 20.0000 mm"),
        (BLOCK, ["--word", "Start.x"], 0, "start X, now 40.0000 mm"),
        (BLOCK, ["--word", "R"], 2, "no word R"),
        (BLOCK, ["--word", "P", "--within", "5"], 2, "--within 5: write LOW:HIGH, such as 0.1:50"),
    ],
)
def test_the_command_prints_the_ranges(block, arguments, status, told):
    done = CliRunner().invoke(main, ["range", "--block", block, "--start", START, *arguments])
    assert done.exit_code == status
    assert told in (done.stderr if status == 2 else done.stdout)
    assert (done.stdout == "") == (status == 2)


FACTS = {
    "a radius from a straight part": (
        "G111 X100. A180. K-30. B120. P?",
        {"start": START, "facts": ["straight part of line 2 = 20"]},
        {"K": (-60, 5), "straight part of line 2": (-5, 60), "B": (60, 200), "start.X": (10, 120)},
    ),
    "an angle from a length": (
        "G111 X100. A? K-30. B120. (contoursolve: length of line 1 = 35.)",
        {"start": START},
        {"K": (-60, 5), "length of line 1": (5, 70)},
    ),
    "a place, in inches": (
        "G111 X4. A180. K-1.2 B? P.2 Q.2",
        {"start": "X1.6 Z0.", "units": "inch", "facts": ["line 2 passes through (Z-1.6 X3.2)"]},
        {"start.X": (0, 4), "start.Z": (-1.5, 1.5), "K": (-2.4, 0), "P": (0, 2)},
    ),
    "facts of which the first ones fix nothing, in inches": (
        "G111 X4. A180. K? B120. P.2 Q.2",
        {"start": "X1.6 Z0.", "units": "inch", "facts": ["X of V1 = 1.6", "Z of V1 = -1.2"]},
        {"Z of V1": (-3, 0)},
    ),
    "a tangent circle": (
        "G111 X100. A180. K-30. B? P5.",
        {"start": START, "facts": ["line 2 tangent to circle (Z-60. X60. R5.)"]},
        {"start.X": (0, 100), "K": (-100, 0)},
    ),
    "a last corner asked for, beside a shoulder": (
        "G111 X100. A180. K-30. B90. P5. Q?",
        {"start": START, "facts": ["straight part of line 2 = 22."]},
        {"B": (60, 170), "K": (-60, 10), "X": (40, 150), "P": (0, 20)},
    ),
    "a last bevel asked for, on a line to a place": (
        "G111 X100. A180. K-30. B120. P5. D?",
        {"start": START, "facts": ["corner 2 meets line to (Z-90. X130.)", "straight part of line 2 = 22."]},
        {"start.X": (20, 90), "straight part of line 2": (0, 40)},
    ),
    "said twice": (
        "G111 X100. A180. K-30. B120. P5. Q5.",
        {"start": START, "facts": ["length of line 1 = 30"]},
        {"K": (-30.01, -29.99), "length of line 1": (29.99, 30.01), "A": (179, 181)},
    ),
    "words that ask alone": (
        "G111 X100. A180. K-30. B120. P5. Q5.",
        {"start": START, "facts": ["length of line 1 = ?"]},
        {"A": (100, 300), "P": (-1, 60)},
    ),
    "a start point": (BLOCK, {"start": START}, {"start.X": (-10, 120), "start.Z": (-20, 20)}),
    "a start point that is a block": (MILL.format("R50", "", ",A171.87 Q-1"), {}, {"1:X": (45, 55), ",A": (100, 260)}),
    "a choice that nothing makes": (
        MILL.format("R50", ",R3", ",A171.87"),
        {"rules": "off"},
        {"R": (-70, 80)},
    ),
    "a choice, and a half circle": (
        MILL.format("R50", "", ",A171.87 Q-1"),
        {"facts": ["length of line = ?"]},
        {",A": (100, 260), "R": (40, 90)},
    ),
    "a choice that a fact makes": (
        MILL.format("R50", "", ",A171.87"),
        {"facts": ["X of P1 = 40"], "rules": "off"},
        {"X of P1": (39.99, 40.01), ",A": (171.8, 171.9)},
    ),
    "an angle from a point": (
        MILL.format("R50", "", ",A? Q-1"),
        {"facts": ["X of P1 = 40"]},
        {"R": (45, 150), "X of P1": (-60, 60)},
    ),
}


STARTED = [
    pytest.param(block, options, word, within, id=f"{name}-{word}")
    for name, (block, options, ranges) in FACTS.items()
    for word, within in ranges.items()
]


def solved_in(block, vary, options):
    """Whether each row of a family, which is followed in boxes and not in closed form, has a contour."""
    return np.isin(family(block, vary=vary, **options)["status"], (Status.SOLVED.code, Status.OVERDETERMINED.code))


def check_against_family(block, word, found, options):
    """A range is what a fine family shows, beside its ends, too."""
    low, high = found.within
    ends = [end for each in found.intervals for end in (each.low, each.high)]
    assert all(end.is_verified for end in ends)
    values = {*np.round(np.linspace(low, high, 81), 3).tolist()}
    values |= {round(end.value + step, 3) for end in ends for step in (-0.003, -0.001, 0, 0.001, 0.003)}
    values = [v for v in sorted(values) if low <= v <= high and all(abs(v - end.value) > 2e-5 for end in ends)]
    solved = solved_in(block, {word: values}, options)
    wrong = [value for value, is_solved in zip(values, solved, strict=True) if (value in found) is not bool(is_solved)]
    assert not wrong, (word, wrong, found.intervals)
    return bool(solved.any())


@pytest.mark.parametrize(("block", "options", "word", "within"), STARTED)
def test_ranges_with_facts_and_start_points_are_those_of_a_fine_family(block, options, word, within):
    assert check_against_family(block, word, ranges(block, word, within=within, **options), options)


CUT = [
    *REGIONS.values(),
    *(
        (*FACTS[name][:2], words, [FACTS[name][2].get(word, (0, 60)) for word in words])
        for name, *words in (
            ("a start point", "start.X", "P"),
            ("an angle from a length", "K", "length of line 1"),
            ("a radius from a straight part", "K", "straight part of line 2"),
            ("a radius from a straight part", "start.X", "B"),
            ("an angle from a point", "R", "X of P1"),
        )
    ),
]


@pytest.mark.slow
@pytest.mark.parametrize(("block", "options", "words", "within"), CUT)
def test_a_cut_through_a_region_is_what_a_fine_family_shows(block, options, words, within):
    found = ranges(block, words, within, **options)
    (low, high), span = within
    axis = np.linspace(*span, 161)
    for value in np.round(np.random.default_rng(len(block)).uniform(low, high, 5), 3).tolist():
        solved = solved_in(block, {words[0]: [value], words[1]: axis}, options)[0]
        changes = np.flatnonzero(solved[1:] != solved[:-1])
        at = sorted(crossings(found, value))
        assert len(at) == changes.size, (value, at, axis[changes])
        cell = found.cell[1]
        assert all(axis[n] - cell <= each <= axis[n + 1] + cell for n, each in zip(changes, at, strict=True))
