"""Where a contour exists: every range of a word's values, with what ends it."""

import json
from math import asin, atan2, degrees, hypot, radians, sin, tan
from random import Random

import numpy as np
import pytest
from click.testing import CliRunner
from test_family import CASES, text_of

import contoursolve
from contoursolve.cli import main
from contoursolve.families import FamilyError, RefusedError, Way, family, feasible, outcomes_of, region
from contoursolve.families.errors import NotClosedError
from contoursolve.output import region_data, region_lines
from contoursolve.solving import StatusCode

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
WORDS = [(name, word) for name, (_, _, ranges) in CASES.items() for word in ranges if not word.endswith("Q")]
WORDS += [("G111, two roundings", "Q"), ("G111, every start word", "B")]


def has_contour(block, word, value, options):
    text = text_of(block, [word], [value])
    assert value == round(value, 3), "text_of writes three decimals"
    return contoursolve.solve(text, depth="verdict", **options).answers[0].contour is not None


@pytest.mark.parametrize(("name", "word"), WORDS)
@pytest.mark.parametrize("count", [10, pytest.param(60, marks=pytest.mark.slow)])
def test_a_value_is_in_a_range_exactly_if_a_single_solve_has_a_contour(name, word, count):
    block, options, ranges = CASES[name]
    low, high = ranges.get(word, (0, 360))
    found = feasible(block, word, within=(low, high), **options)
    assert found.is_complete
    ends = [end for each in found.intervals for end in (each.low, each.high)]
    assert all(end.is_verified for end in ends), [end for end in ends if not end.is_verified]
    rng = np.random.default_rng(len(name))
    values = {round(float(value), 3) for value in rng.uniform(low, high, count)}
    values |= {round(end.value + step, 3) for end in ends for step in (-0.003, -0.001, 0, 0.001, 0.003)}
    for value in sorted(values):
        if low <= value <= high and all(abs(value - end.value) > 2e-5 for end in ends):
            assert (value in found) is has_contour(block, word, value, options), (word, value)
    for end in ends:
        if end.inside is not None and end.outside is not None:
            assert abs(end.inside - end.outside) <= 4e-4 * max(1, abs(end.value))


def only(found):
    (interval,) = found.intervals
    return interval


def test_ends_are_those_of_the_formulas():
    """Line 1 has 30 mm, line 2 runs at 120 deg from X40 to X100 and has 30/sin(120): a rounding takes tan(30) of its
    radius from each."""
    share = tan(radians(30))
    assert only(feasible(BLOCK, "P", start=START)).high.value == pytest.approx(30 / share, abs=1e-9)
    assert only(feasible(BLOCK, "K", start=START)).high.value == pytest.approx(-5 * share, abs=1e-9)
    lines = 30 / sin(radians(120))
    assert only(feasible(BLOCK, "Q", start=START)).high.value == pytest.approx(lines / share - 5, abs=1e-9)
    assert only(feasible(BLOCK, "X", start=START)).low.value == pytest.approx(
        40 + 2 * 10 * share * sin(radians(120)), abs=1e-9
    )
    inches = feasible("G111 X4. A180. K-1.2 B120. P.2 Q.2", "P", start="X1.6 Z0.", units="inch")
    assert (inches.unit, only(inches).high.value) == ("inch", pytest.approx(1.2 / share, abs=1e-9))


def test_a_line_meets_a_circle_up_to_its_tangent():
    """Seen from the end of the line, the circle of 50 mm about the origin reaches from the direction of its centre to
    either side by the arc sine of radius over distance."""
    block = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"
    found = feasible(block, ",A", within=(160, 200))
    to_center = degrees(atan2(42.857, -50))
    tangent = to_center + degrees(asin(50 / hypot(50, 42.857)))
    assert only(found).high.value == pytest.approx(tangent, abs=1e-9)
    assert only(found).high.reason.text == "the line misses the circle: ,A at most 188.797 deg"


@pytest.mark.parametrize(
    ("block", "word", "within", "texts"),
    [
        (
            BLOCK,
            "P",
            None,
            [
                "the control refuses P below 0.000 mm; `contoursolve explain g111-corner-sign` says why",
                "P is too large for line 1: P at most 51.961 mm",
            ],
        ),
        (BLOCK, "Q", (0, 99), ["", "Q is too large for line 2: Q at most 55.000 mm"]),
        (BLOCK, "K", (-60, 9), ["", "P5. is too large for line 1: K at most -2.887 mm"]),
        (
            "G111 A180. K-30. B120. Z-60.",
            "Z",
            (-90, 0),
            ["", "B120. points away from the end of line 2: Z at most -30.000 mm"],
        ),
    ],
)
def test_an_end_says_what_fails_beyond_it(block, word, within, texts):
    ends = only(
        feasible(
            block,
            word,
            start=START,
            within=within,
        )
    )
    assert [end.reason.text if end.reason else "" for end in (ends.low, ends.high)] == texts


def test_a_single_value_without_a_contour_parts_two_ranges():
    found = feasible("G111 A160. B120. I10. Z-60. P2. Q2.", "A", start=START, within=(100, 150))
    first, second = found.intervals
    assert first.high.value == second.low.value == 120
    assert 120 not in found
    assert 120.001 in found
    assert first.high.reason.code == "g111-no-corner"


def test_ranges_of_a_few_thousandths_are_found_in_a_wide_range():
    block = "G111 X100. A180. K-30. B120. I0. P5."
    found = only(feasible(block, "I", start=START, rules="off", within=(-5000, 5000)))
    # Two coordinates in X and the angle, each exact to half its increment.
    allowed = 0.0005 + 30 * radians(0.0005) + 1e-9
    assert (found.low.value, found.high.value) == (pytest.approx(-allowed), pytest.approx(allowed))


def test_lines_that_are_almost_parallel_end_a_range():
    found = feasible("G111 A180. B120. X100. Z-60.", "A", start=START, within=(160, 350))
    # Before they are, they meet where no word reaches.
    assert "a point lies farther away than words reach: A at most 299.998 deg" in only(found).high.reason.text
    assert 299.998 < only(found).high.value < 299.999


def test_the_range_itself_ends_without_a_reason():
    found = only(feasible(BLOCK, "P", start=START, within=(1, 9)))
    assert (found.low.way, found.low.reason, found.high.value) == (Way.RANGE, None, 9)


@pytest.mark.parametrize(
    ("word", "within", "message"),
    [
        ("R", None, "the block has no word R"),
        ("P", (5, 1), "no range"),
        ("P", (1, float("inf")), "no range"),
        ("P", (0, 2e6), "beyond 1,000,000 mm"),
        ("P", 5, "two numbers"),
    ],
)
def test_a_range_that_makes_no_sense_is_refused(word, within, message):
    with pytest.raises(FamilyError, match=message):
        feasible(BLOCK, word, start=START, within=within)


def test_a_number_without_a_point_means_what_the_control_reads():
    """On this control, least increments: K-30000 is -30 mm."""
    found = feasible("G111 X100000 A180000 K-30000 B120000 P5000 Q5000", "P", start=START)
    assert (found.stated, only(found).high.value) == (5, only(feasible(BLOCK, "P", start=START)).high.value)


def test_a_word_that_chooses_has_no_range():
    block = CASES["circle-line"][0]
    with pytest.raises(FamilyError, match="it has no range"):
        feasible(block, "Q")


REGIONS = {
    "two roundings": (BLOCK, {"start": START}, ("A", "P"), ((100, 300), (-2, 60))),
    "two angles": (BLOCK, {"start": START}, ("A", "B"), ((95, 265), (5, 175))),
    "bevels": ("G111 X100. A180. K-30. B120. C5. D5.", {"start": START}, ("K", "C"), ((-40, 5), (0, 30))),
    "an arc": ("G112 X50. K-30. I-10. R20. P2. Q2.", {"start": START}, ("R", "P"), ((-1, 60), (-0.1, 9))),
    "a circle": (CASES["circle-line"][0], {}, (",A", "R"), ((160, 260), (40, 80))),
}


def crossings(found, value):
    """Where a line at a value of the first word crosses the lines of a region, by linear interpolation."""
    for each in found.boundaries:
        points = np.array(each.points)
        first, second = points.T
        for place in np.flatnonzero((first[1:] - value) * (first[:-1] - value) < 0):
            share = (value - first[place]) / (first[place + 1] - first[place])
            yield second[place] + share * (second[place + 1] - second[place])


@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.slow] * (n != "a circle")) for n in REGIONS])
def test_a_cut_through_a_region_has_the_ends_of_the_range_of_the_other_word(name):
    block, options, words, within = REGIONS[name]
    found = region(block, words, within, **options)
    (low, high), span = within
    lines = block.split("\n")

    def ends_at(value):
        """The ends of the other word's ranges, in the block with this value of the first."""
        text = "\n".join(
            " ".join(f"{words[0]}{value!r}" if part[: len(words[0])] == words[0] else part for part in line.split(" "))
            for line in lines
        )
        ranges = feasible(text, words[1], within=span, **options).intervals
        ranges = [each for each in ranges if each.high.value - each.low.value > found.seen[1]]
        return [end.value for each in ranges for end in (each.low, each.high) if end.reason]

    rng = np.random.default_rng(len(name))
    for value in np.round(rng.uniform(low, high, 8), 3).tolist():
        # A value without the contour alone, as between two angles, is narrower than what is sampled.
        expected = [end for end in ends_at(value) if ends_at(value).count(end) == 1]
        shown = sorted(crossings(found, value))
        assert len(shown) == len(expected), (value, expected, shown)
        assert shown == pytest.approx(expected, abs=found.cell[1])


def test_what_is_sampled_says_how_finely_and_is_never_called_proven():
    block, options, words, within = REGIONS["a circle"]
    found = region(block, words, within, **options)
    assert found.fineness == (
        "sampled, edges within 0.33 deg and 0.20 mm; what is narrower than 1.4 deg and 0.80 mm may be missing"
    )
    told = " ".join(region_lines(found))
    assert found.fineness in told
    assert "proven" not in told.replace("sampled, not proven", "")
    assert region_data(found)["sampled"] == {
        "edges_within": pytest.approx([100 / 304, 0.2]),
        "narrower_may_be_missing": pytest.approx([400 / 304, 0.8]),
    }
    assert "complete" not in region_data(found)


@pytest.mark.slow
def test_every_value_of_a_region_has_the_outcome_of_its_single_solve():
    block, options, words, within = REGIONS["two roundings"]
    found = region(block, words, within, **options)
    axes = [np.linspace(*ends, count) for ends, count in zip(within, found.outcomes.shape, strict=True)]
    every = family(block, vary=dict(zip(words, axes, strict=True)), **options)
    same = found.outcomes == outcomes_of(every["status"], every["reason"])
    # Only what is narrower than the first samples stand apart may differ.
    assert (~same).mean() < 1e-3


def test_rules_bound_a_region_too():
    block, options, words, within = REGIONS["two roundings"]
    texts = [each.reason.text for each in region(block, words, within, **options).boundaries]
    assert texts == [
        "P is too large for line 1",
        "P is too large for line 2",
        "the control refuses such values of P; `contoursolve explain g111-corner-sign` says why",
        "A points away from the end of line 1",
    ]


def run(*arguments):
    done = CliRunner().invoke(main, ["range", *map(str, arguments)])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.exit_code, done.stdout, done.stderr


def test_the_command_prints_the_ranges():
    on_block = ("--block", BLOCK, "--start", START)
    status, output, _ = run(*on_block, "--word", "p")
    assert status == 0
    assert "P is too large for line 1: P at most 51.961 mm" in output
    status, output, _ = run(*on_block, "--word", "P", "--within", "1:60", "--format", "json")
    data = json.loads(output)
    assert (status, data["schema"], data["complete"]) == (0, "contoursolve/range/1", True)
    (each,) = data["ranges"]
    assert (each["low"]["value"], each["low"]["reason"], each["high"]["found_by"]) == (1.0, None, "closed form")
    assert run(*on_block, "--word", "P", "--within", "55:60")[0] == 1
    two = ("--word", "A", "--within", "150:210", "--word", "P", "--within", "1:60")
    status, output, _ = run(*on_block, *two)
    assert (status, "beyond it: P is too large for line 1" in output) == (0, True)
    data = json.loads(run(*on_block, *two, "--format", "json")[1])
    assert (data["schema"], len(data["boundaries"])) == ("contoursolve/region/2", 2)
    assert run(*on_block, "--word", "A", "--word", "P")[0] == 2
    status, output, _ = run(
        "--block", BLOCK.replace("P5.", "P60."), "--start", START, "--word", "P", "--within", "55:60"
    )
    assert (status, "as it stands, the block has none: corner 1 does not fit" in output) == (1, True)
    asked = ("--block", "G111 X100. A180. K-30. B120. P?", "--start", START, "--fact", "straight part of line 2 = 20")
    status, output, _ = run(*asked, "--word", "straight part of line 2")
    assert (status, "straight part of line 2, now 20.0000 mm" in output, "at most 34.641 mm" in output) == (
        0,
        True,
        True,
    )
    assert "start.X, now 40.0000 mm" in run(*on_block, "--word", "Start.x")[1]
    for wrong, message in ((("--word", "R"), "no word R"), (("--word", "P", "--within", "5"), "LOW:HIGH")):
        status, output, errors = run(*on_block, *wrong)
        assert (status, output) == (2, "")
        assert message in errors


MILL = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 {} {}\nG1 X-50 Y42.857 {}"
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
        {"R": (-70, 80), ",A": (100, 260)},
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


def solved_in(block, vary, options):
    """Whether each row of a family, which is followed in boxes and not in closed form, has a contour."""
    return np.isin(family(block, vary=vary, **options)["status"], (StatusCode.SOLVED, StatusCode.OVERDETERMINED))


def check_against_family(block, word, found, options):
    """A range is what a fine family shows, beside its ends, too."""
    low, high = found.within
    ends = [end for each in found.intervals for end in (each.low, each.high)]
    values = {*np.round(np.linspace(low, high, 81), 3).tolist()}
    values |= {round(end.value + step, 3) for end in ends for step in (-0.003, -0.001, 0, 0.001, 0.003)}
    values = [v for v in sorted(values) if low <= v <= high and all(abs(v - end.value) > 2e-5 for end in ends)]
    solved = solved_in(block, {word: values}, options)
    wrong = [value for value, is_solved in zip(values, solved, strict=True) if (value in found) is not bool(is_solved)]
    assert not wrong, (word, wrong, found.intervals)
    return bool(solved.any())


QUICK = ("an angle from a length", "a start point", "a start point that is a block")


@pytest.mark.parametrize("name", [pytest.param(n, marks=() if n in QUICK else pytest.mark.slow) for n in FACTS])
def test_ranges_with_facts_and_start_points_are_those_of_a_fine_family(name):
    block, options, ranges = FACTS[name]
    exists = []
    for word, within in ranges.items():
        found = feasible(block, word, within=within, **options)
        assert all(end.is_verified for each in found.intervals for end in (each.low, each.high)), found.intervals
        exists.append(check_against_family(block, word, found, options))
    assert any(exists)


TOLD = [
    *(f"length of line {number}" for number in (1, 2)),
    *(f"straight part of line {number}" for number in (1, 2)),
    *(f"direction of line {number}" for number in (1, 2)),
    *("X of V1", "Z of V2", "angle from line 1 to line 2", "Z of end of corner 2", "X of begin of corner 1"),
    *("radius of corner 1", "radius of corner 2", "Z of center of corner 1"),
]


def random_block(rng):
    """A block with as many facts that are true of it as it asks for, and what may vary: None where no facts fit."""
    words = {
        "X": rng.uniform(60, 120),
        "A": rng.uniform(150, 200),
        "K": rng.uniform(-50, -20),
        "B": rng.uniform(100, 150),
    }
    words |= {rng.choice(pair): rng.uniform(1, 6) for pair in ("PC", "QD") if rng.random() < 0.7}
    asked = rng.sample(list(words), rng.choice((1, 1, 2)))
    text = "G111 " + " ".join(f"{word}{value:.1f}" for word, value in words.items())
    facts = []
    for fact in rng.sample(TOLD, len(TOLD)):
        answer = contoursolve.solve(text, start=START, facts=[f"{fact} = ?"]).answers[0]
        if answer.answers and answer.answers[0].value is not None:
            value = answer.answers[0].value * (2 if fact.startswith("X of") else 1)
            facts.append(f"{fact} = {value:.3f}")
        if len(facts) == len(asked):
            break
    else:
        return None
    text = "G111 " + " ".join(f"{word}?" if word in asked else f"{word}{words[word]:.1f}" for word in words)
    free = [*(word for word in words if word not in asked), *(fact.partition(" =")[0] for fact in facts), "start.X"]
    return text, facts, rng.choice(free)


@pytest.mark.slow
def test_ranges_of_random_facts_are_those_of_a_fine_family():
    rng, existing = Random(5), 0
    while existing < 3:
        drawn = random_block(rng)
        if drawn is None:
            continue
        text, facts, word = drawn
        options = {"start": START, "facts": facts}
        try:
            found = feasible(text, word, **options)
        except NotClosedError:
            continue
        except RefusedError:
            with pytest.raises(RefusedError):
                family(text, vary={word: [1, 2]}, **options)
            continue
        if found.intervals:
            near = found.stated
            low, high = max(found.within[0], near - 90), min(found.within[1], near + 90)
            found = feasible(text, word, within=(low, high), **options)
            existing += check_against_family(text, word, found, options)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("a start point", ("start.X", "P")),
        *(
            pytest.param(name, words, marks=pytest.mark.slow)
            for name, words in (
                ("an angle from a length", ("K", "length of line 1")),
                ("a radius from a straight part", ("K", "straight part of line 2")),
                ("a radius from a straight part", ("start.X", "B")),
                ("an angle from a point", ("R", "X of P1")),
            )
        ),
    ],
)
def test_a_cut_through_a_region_with_facts_is_what_a_fine_family_shows(name, words):
    block, options, ranges = FACTS[name]
    within = [ranges.get(word, (0, 60)) for word in words]
    found = region(block, words, within, **options)
    (low, high), span = within
    axis = np.linspace(*span, 161)
    for value in np.round(np.random.default_rng(len(name)).uniform(low, high, 5), 3).tolist():
        solved = solved_in(block, {words[0]: [value], words[1]: axis}, options)[0]
        changes = np.flatnonzero(solved[1:] != solved[:-1])
        at = sorted(crossings(found, value))
        assert len(at) == changes.size, (value, at, axis[changes])
        cell = found.cell[1]
        assert all(axis[n] - cell <= each <= axis[n + 1] + cell for n, each in zip(changes, at, strict=True))


@pytest.mark.parametrize(
    ("block", "facts", "message"),
    [
        (
            "G111 X100. A? K-30. B?",
            ["length of line 1 = 35", "angle from line 1 to line 2 = -50"],
            "length of line 1 = 35 and K with A. and B.: they have no closed form together; .* `contoursolve sweep`",
        ),
        (BLOCK, ["lenght of line 1 = 30"], "lenght"),
    ],
)
def test_facts_of_which_no_range_can_be_told_are_named(block, facts, message):
    with pytest.raises(FamilyError, match=message):
        feasible(block, "K", start=START, facts=facts)
    with pytest.raises(FamilyError, match=message):
        region(block, ("K", "X"), ((-40, -20), (80, 120)), start=START, facts=facts)


def test_the_end_where_a_second_contour_begins_says_so():
    block, options, _ = FACTS["an angle from a length"]
    found = feasible(block, "K", within=(-1000, 0), **options)
    touching, rest = found.intervals
    assert touching.low.value == touching.high.value == -35, "there both are one"
    assert "2 contours fit the block" in rest.low.reason.text
    # From there on the one that runs down would run against B120.
    assert rest.low.value == pytest.approx(-((35**2 - 30**2) ** 0.5), abs=1e-9)
    assert "2 contours" in found.refusal


@pytest.mark.parametrize(
    ("units", "start", "block"), [("mm", START, "X100. A? K-30."), ("inch", "X1.6 Z0.", "X4. A? K-1.2")]
)
def test_a_coordinate_of_zero_is_looked_at_as_far_as_any_other(units, start, block):
    told = [
        feasible(f"G111 {block} B120.", "X of V1", start=start, units=units, facts=[f"X of V1 = {value}"])
        for value in (0, 1)
    ]
    assert told[0].within == told[1].within
    assert told[0].intervals == told[1].intervals


def test_a_coordinate_and_the_start_point_that_it_counts_from_bound_a_region_together():
    within = (60, 140), (10, 70)
    found = region(BLOCK, ("X", "start.X"), within, start=START)
    # The first line reaches 30 mm; on the second, P and Q of 5 mm need tan(30) of it each.
    least = 4 * 5 * tan(radians(30)) * sin(radians(120))
    (line,) = found.boundaries
    assert all(abs(end - start - least) <= max(found.cell) for end, start in line.points)
    rows = family(BLOCK, vary={"X": np.linspace(*within[0], 9), "start.X": np.linspace(*within[1], 7)}, start=START)
    ends, starts = np.meshgrid(*rows.ranges.values.values(), indexing="ij")
    assert np.array_equal(rows["status"] == StatusCode.SOLVED, ends - starts >= least)
