"""Which word moves a point most: derivatives, tolerances and rounding, held against solving again."""

import json
from math import radians, tan

import numpy as np
import pytest
from click.testing import CliRunner

import contoursolve
from contoursolve.cli import main
from contoursolve.families import FamilyError, family, sensitivity, tolerances

BLOCK, START = "G111 X100. A175. K-30. B121.2345 P5. Q5.", "X40. Z0."
ALLOWED = {"A": 0.05, "B": 0.04, "K": 0.02, "X": 0.03, "Q": 0.1}


def test_a_million_draws_are_as_far_off_as_the_tolerances_say():
    """Uniform within its tolerance, a word has the standard deviation tolerance / sqrt(3)."""
    found = tolerances(BLOCK, ALLOWED, start=START)
    rng = np.random.default_rng(7)
    stated = {each.word: each.stated for each in found.effects}
    drawn = {word: stated[word] + rng.uniform(-off, off, 100_000) for word, off in ALLOWED.items()}
    rows = family(BLOCK, vary=drawn, paired=True, start=START)
    for axis, name in enumerate(("corner 2.end.Z", "corner 2.end.X")):
        values, spread = rows[name], found.spread[axis]
        assert np.abs(values - found.place[axis]).max() <= spread.worst * 1.001 + 1e-12
        assert values.std() * np.sqrt(3) == pytest.approx(spread.typical, rel=0.01, abs=1e-12)
        assert found.limits.low[axis] - 1e-9 <= values.min()
        assert values.max() <= found.limits.high[axis] + 1e-9
    assert found.limits.high[0] - found.place[0] == pytest.approx(found.spread[0].worst, rel=0.01)
    assert [each.word for each in found.effects[:2]] == ["Q", "B"]


def test_rounding_is_solved_again_beside_its_linear_estimate():
    effects = {each.word: each for each in tolerances(BLOCK, start=START).effects}
    angle = effects["B"]
    assert (angle.rounded, angle.increment) == (121.234, 0.001)
    texts = (BLOCK, BLOCK.replace("2345", "234"))
    ends = [contoursolve.solve(text, start=START).answers[0].contour.end for text in texts]
    assert angle.by_rounding == pytest.approx(np.hypot(*np.subtract(*ends)), abs=1e-12)
    assert angle.by_rounding == pytest.approx(angle.by_rounding_linear, rel=1e-3)
    assert effects["K"].by_rounding == 0
    assert effects["K"].by_half == pytest.approx(abs(effects["K"].slope[0]) * 0.0005, rel=1e-3)
    assert effects["X"].by_half == pytest.approx(np.hypot(*effects["X"].slope) * 0.0005, rel=1e-3)


def test_tolerances_beyond_which_there_is_no_contour_are_told():
    """The largest rounding is K / tan(30): 51.79 for K-29.9, 52.13 for K-30.1."""
    found = tolerances("G111 X100. A180. K-30. B120. P51.9", {"P": 0.2, "K": 0.1}, start=START)
    assert (found.limits.count, found.limits.without) == (4, 1)
    (missing,) = found.limits.missing
    assert (missing.count, missing.values) == (1, {"P": pytest.approx(52.1), "K": pytest.approx(-29.9)})
    assert "at most 51.788 mm fits" in missing.message


def test_no_combination_of_the_limits_may_have_a_contour():
    limits = tolerances(BLOCK, {"A": 999_000}, start=START).limits
    assert (limits.count, limits.without) == (2, 2)
    assert np.isnan([*limits.low, *limits.high]).all()


@pytest.mark.parametrize(
    ("allowed", "message"),
    [
        ({"A": 1, "a": 2}, "two tolerances"),
        ({"A": -0.1}, r"positive: 0\.1 means \+-0\.1"),
        ({"A": float("nan")}, "finite"),
        ({"R": 1}, "no word R; there are"),
    ],
)
def test_a_tolerance_that_makes_no_sense_is_refused(allowed, message):
    with pytest.raises(FamilyError, match=message):
        tolerances(BLOCK, allowed, start=START)


FACTS = [
    ("G111 X100. A180. K-30. B120. P?", "X40. Z0.", ["straight part of line 2 = 20"]),
    ("G111 X100. A180. K-30. B120. P5. Q?", "X40. Z0.", ["radius of corner 1 = radius of corner 2"]),
    (
        "G111 X100. A180. K-30. B120. P? Q?",
        "X40. Z0.",
        ["radius of corner 1 = radius of corner 2", "straight part of line 2 = 20"],
    ),
    ("G112 X50. K-30. I-10. R? Q2.", "X40. Z0.", ["length of arc = 20"]),
]


@pytest.mark.parametrize(("block", "start", "facts"), FACTS)
def test_derivatives_of_equations_without_a_closed_form_are_central_differences(block, start, facts):
    slopes = sensitivity(block, start=start, facts=facts).slopes
    step, compared = 1e-4, 0
    program = contoursolve.parse(block)
    for word in next(iter(slopes.values())):
        line, _, address = word.rpartition(":")
        if " " in word:
            value = float(next(fact for fact in facts if fact.startswith(word)).partition("=")[2])
        else:
            same = [each for each in program.blocks if not line or each.line == int(line)]
            value = float(next(each.find(address) for each in same if each.find(address)).number)
        found = family(block, vary={word: [value - step, value + step]}, start=start, facts=facts)
        if set(found.summary()) != {contoursolve.Status.SOLVED}:
            continue
        compared += 1
        for name, by_word in slopes.items():
            if name in found.names:
                difference = np.diff(found[name])[0] / (2 * step)
                assert abs(by_word[word] - difference) <= 1e-5 * max(1.0, abs(difference)), (name, word)
    assert compared >= 2


def run(*arguments):
    done = CliRunner().invoke(main, ["sensitivity", "--block", BLOCK, "--start", START, *map(str, arguments)])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.exit_code, done.stdout, done.stderr


def test_the_command_prints_the_words_in_order():
    status, output, _ = run("--tolerance", "a=0.05", "--tolerance", "K=0.02")
    assert status == 0
    lines = output.splitlines()
    assert [line.split()[0] for line in lines[2:4]] == ["K", "A"]
    assert "solved at all 4 combinations" in output
    assert "B rounded to 121.2340 deg moves it by" in output
    for wrong, message in ((("--tolerance", "P"), "WORD=VALUE"), (("--point", "V9"), "no point V9")):
        status, output, errors = run(*wrong)
        assert (status, output) == (2, "")
        assert message in errors


def test_limits_without_a_contour_are_told_before_what_the_tolerances_come_to():
    done = CliRunner().invoke(
        main, ["sensitivity", "--block", "G111 X100. A180. K-30. B120. P25.", "--start", START, "--tolerance", "P=40"]
    )
    lines = [line.strip() for line in done.output.splitlines() if "P" in line or "off by" in line][-3:]
    assert lines[0].startswith("no contour at 1 of 2 combinations of the limits, at P -15: P-15.0 is negative")
    assert lines[1].startswith("no contour at 1 of 2 combinations of the limits, at P 65: corner 1 does not fit")
    assert lines[2].startswith("off by at worst")


def test_in_an_inch_program_every_number_is_in_inches_and_says_so():
    """The tolerance of P moves the centre of its rounding by tan(30) of itself along Z, and by itself along X."""
    block = "G111 X4. A180. K-1.2 B120. P.2 Q.2"
    found = tolerances(block, {"P": 0.01}, point="corner 1.center", start="X1.6 Z0.", units="inch")
    (effect,) = [each for each in found.effects if each.word == "P"]
    assert (effect.unit, effect.increment, effect.slope) == (
        "inch",
        0.0001,
        pytest.approx((25.4 * tan(radians(30)), 25.4)),
    )
    words = ["--block", block, "--start", "X1.6 Z0.", "--units", "inch"]
    about = ["--point", "corner 1.center", "--tolerance", "P=0.01"]
    title, _, row, *others = CliRunner().invoke(main, ["sensitivity", *words, *about]).output.splitlines()
    assert " in; moved by each word" in title
    cells = row.split("  ")
    assert [each.strip() for each in cells if each] == [
        *("P", "0.20000 in", "0.57735 in/in", "2.00000 in/in", "0.01 in"),
        *("0.01155 in", "0.00006 in"),
    ]
    assert "off by at worst Z 0.00577 in, X dia 0.02000 in" in others[-2]
    assert not any("mm" in line for line in (title, row, *others))


def test_a_number_without_a_point_means_what_the_control_reads():
    least = tolerances("G111 X100000 A175000 K-30000 B121234 P5000 Q5000", {"K": 0.02}, start=START)
    same = tolerances("G111 X100. A175. K-30. B121.234 P5. Q5.", {"K": 0.02}, start=START)
    for one, other in zip(least.effects, same.effects, strict=True):
        assert (one.word, one.stated, one.by_half, one.rounded) == (
            other.word,
            other.stated,
            other.by_half,
            other.rounded,
        )
        assert one.slope == pytest.approx(other.slope)
    assert least.limits == same.limits


def test_a_zero_without_a_point_moves_the_point_as_one_with_a_point():
    slopes = []
    for zero in ("I0", "I0."):
        found = tolerances(f"G111 X100. A180. K-30. B120. {zero}", start="X40. Z0.")
        slopes += [each.slope[0] for each in found.effects if each.word == "I"]
    assert slopes == pytest.approx([tan(radians(30))] * 2)


def test_a_word_that_stands_before_the_contour_too_is_the_one_of_the_contour():
    chain = "G1 ,A197.103 ,R2\nG3 X20 Y30 I20 J-10 R40 Q-1"
    allowed = {",A": 0.1, "X": 0.01}
    found = tolerances(f"G17 G90 G42 G0 X100 Y20\n{chain}", allowed, control="nct-99m")
    alone = tolerances(chain, allowed, start="G17 G90 G42 X100 Y20", control="nct-99m")
    assert found.effects == alone.effects
    assert found.limits == alone.limits
    assert {each.word: each.tolerance for each in found.effects if each.tolerance} == allowed


def test_a_half_circle_has_no_derivative_by_its_radius():
    """Its centre runs away as the root of what the radius is more than half the chord."""
    block = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"
    slopes = sensitivity(block).slopes["P1.X"]
    assert np.isnan(slopes["R"])
    assert np.isfinite(slopes[",A"])
    document = CliRunner().invoke(main, ["sensitivity", "--block", block, "--format", "json"])
    assert document.exit_code == 0, document.output
    words = {each["word"]: each["slope"] for each in json.loads(document.stdout)["words"]}
    assert words["R"] is None
