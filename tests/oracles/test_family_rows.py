"""Random rows of families against closed forms of their own."""

import numpy as np
import pytest
from oracle_columns import JUDGED, circle_line, g111

from contoursolve.families import family
from contoursolve.solving import Status

ROWS, PART = 200_000, 500_000
"""Of a form, and of it at once."""

FARTHEST = 1e6  # mm, in X by diameter or radius; between its half and its double nothing is judged

FORMS = {
    "G111": (
        "G111 X100. A180. K-30. B120. P5. Q5.",
        {"start": "X40. Z0."},
        "ZX",
        g111,
        {"A": (90, 270), "K": (-60, 5), "B": (30, 200), "X": (20, 140), "P": (0, 12), "Q": (0, 12)},
    ),
    "NCT circle and line": (
        "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1",
        {},
        "XY",
        circle_line,
        {"2:X": (-70, 40), "2:Y": (-40, 40), "R": (-90, 90), ",A": (100, 260), "Q": (-1, 1)},
    ),
}


def draw(rng, low, high, rows):
    """Three decimals, as a control reads them, and a tenth of them whole multiples of 30."""
    values = np.round(rng.uniform(low, high, rows), 3)
    special = np.arange(np.ceil(low / 30), np.floor(high / 30) + 1) * 30
    return np.where(rng.random(rows) < 0.1, rng.choice(special, rows), values)


@pytest.mark.parametrize("name", FORMS)
@pytest.mark.parametrize("count", [5_000, pytest.param(ROWS, marks=pytest.mark.slow)])
def test_no_wrong_answer_is_called_solved_and_no_right_one_is_lost(name, count):
    block, options, axes, oracle, ranges = FORMS[name]
    solved = judged = 0
    for part in range(0, count, PART):
        rng = np.random.default_rng([part, sorted(FORMS).index(name)])
        rows = min(PART, count - part)
        values = {word: draw(rng, *ends, rows) for word, ends in ranges.items()}
        if "Q" in ranges and ranges["Q"] == (-1, 1):
            values["Q"] = rng.choice([-1.0, 1.0], rows)
        found = family(block, vary=values, paired=True, **options)
        places, margin, size = oracle(*values.values())
        is_solved = found["status"] == Status.SOLVED.code
        assert not (is_solved & (margin < -JUDGED)).any(), "solved, where there is none"
        # A contour that reaches beyond what words can say is none; the oracle knows no such limit.
        reach = np.fmax.reduce([np.abs(place) for place in places.values()])
        assert not (is_solved & (reach > 2 * FARTHEST)).any(), "solved, beyond the range of words"
        assert not (~is_solved & (margin > JUDGED) & (reach < FARTHEST / 2)).any(), "not solved, where there is one"
        good = is_solved & (margin > JUDGED)
        for place, expected in places.items():
            # X of a lathe, whose axes are Z and X, is a diameter.
            first, second = found[f"{place} {axes[0]}"], found[f"{place} {axes[1]}"] / (1 + (axes[0] == "Z"))
            assert np.array_equal(np.isnan(expected[good]), np.isnan(first[good])), place
            off = np.abs(first + 1j * second - expected)[good] / size[good]
            assert not (off > 1e-12).any(), (place, np.nanmax(off))
        solved, judged = solved + good.sum(), judged + np.isfinite(margin).sum()
    assert solved > count / 20
    assert judged > count * 0.7
