"""Which word moves a point most: derivatives, tolerances and rounding, held against solving again."""

import json
from functools import partial

import calling
import numpy as np
import pytest
from click.testing import CliRunner

from contoursolve.cli import main
from contoursolve.families import FamilyError, family, sensitivity, tolerances

BLOCK, START = "G111 X100. A175. K-30. B121.2345 P5. Q5.", "X40. Z0."
ALLOWED = {"A": 0.05, "B": 0.04, "K": 0.02, "X": 0.03, "Q": 0.1}


def test_a_million_draws_are_as_far_off_as_the_tolerances_say():
    """Uniform within its tolerance, a word has the standard deviation tolerance / sqrt(3)."""
    found = tolerances(BLOCK, allowed=ALLOWED, start=START)
    rng = np.random.default_rng(7)
    stated = {each.word: each.stated for each in found.effects}
    drawn = {word: stated[word] + rng.uniform(-off, off, 100_000) for word, off in ALLOWED.items()}
    rows = family(BLOCK, vary=drawn, paired=True, start=START)
    for axis, name in enumerate(("corner 2.end Z", "corner 2.end X")):
        # What is named has X as a diameter, a place as a radius.
        values, spread = rows[name] / (1 + axis), found.spread[axis]
        assert np.abs(values - found.place[axis]).max() <= spread.worst * 1.001 + 1e-12
        assert values.std() * np.sqrt(3) == pytest.approx(spread.typical, rel=0.01, abs=1e-12)
        assert found.limits.low[axis] - 1e-9 <= values.min()
        assert values.max() <= found.limits.high[axis] + 1e-9
    assert found.limits.high[0] - found.place[0] == pytest.approx(found.spread[0].worst, rel=0.01)
    assert [each.word for each in found.effects[:2]] == ["Q", "B"]


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
        tolerances(BLOCK, allowed=allowed, start=START)


run = partial(calling.run, "sensitivity", "--block", BLOCK, "--start", START)


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
    assert lines[1].startswith("no contour at 1 of 2 combinations of the limits, at P 65: the rounding P65.0 does")
    assert lines[2].startswith("off by at worst")


def test_a_half_circle_has_no_derivative_by_its_radius():
    """Its centre runs away as the root of what the radius is more than half the chord."""
    block = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"
    slopes = sensitivity(block).slopes["P1 X"]
    assert np.isnan(slopes["R"])
    assert np.isfinite(slopes[",A"])
    document = CliRunner().invoke(main, ["sensitivity", "--block", block, "--format", "json"])
    assert document.exit_code == 0, document.output
    words = {each["word"]: each["slope"] for each in json.loads(document.stdout)["words"]}
    assert words["R"] is None
