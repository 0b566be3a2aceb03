"""Families with every solution of each row: a pair without the word that chooses, a fact that leaves two, a chain."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import contoursolve
from contoursolve.families import FamilyError, family

TURN = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\n"
FACT = {"start": "X40. Z0.", "facts": ["length of line 1 = 35."]}
BLOCKS = {
    "a line from a circle without Q": (TURN + "G1 X-50 Y42.857 ,A171.87", {}, ",A", (95, 200)),
    "two circles without Q": (TURN + "G3 X-40 Y60 I-40 J20 R40", {}, "2:R", (51, 70)),
    "an angle that is asked for": ("G111 X100. A? K-30. B120. P5.", FACT, "length of line 1", (25, 60)),
    "a line to a circle without H": (
        "G17 G90 G00 X0 Y0\nG01 A10.\nG02 X60. Y10. I-20. J-25.",
        {"control": "mitsubishi", "settings": {"mitsubishi.h-default": "error"}},
        "A",
        (-40, 20),
    ),
}


def test_the_default_stays_one_solution_and_refuses_a_block_without_its_choice():
    block, _, word, _ = BLOCKS["a line from a circle without Q"]
    with pytest.raises(FamilyError, match="Q is missing"):
        family(block, vary={word: [171.87]})
    chosen = [family(f"{block} Q{sign}", vary={word: [171.87, 165.0]}) for sign in (1, -1)]
    found = family(block, vary={word: [171.87, 165.0]}, branches="all")
    assert found.solutions == ("P1 farther", "P1 nearer")
    for name, one in zip(found.solutions, chosen, strict=True):
        own = found.solution(name)
        assert (own.shape, own.solutions) == ((2,), ())
        for column in ("P1 X", "P1 Y", "N2 X"):
            if column in own.names:
                assert own[column] == pytest.approx(one[column], abs=1e-12)
    alone = family(f"{block} Q1", vary={word: [171.87]}, branches="all")
    assert (alone.solutions, alone["P1 X"].shape) == (("P1 farther",), (1, 1))
    with pytest.raises(ValueError, match="branches"):
        family(block, vary={word: [171.87]}, branches="both")
    with pytest.raises(KeyError, match="there are P1 farther, P1 nearer"):
        found.solution("P2")


@pytest.mark.slow
def test_solutions_are_a_dimension_of_arrays_tables_and_executors():
    block, _, word, _ = BLOCKS["a line from a circle without Q"]
    vary = {word: np.linspace(60, 200, 8), "3:Y": [42.857, 35.0]}
    found = family(block, vary=vary, branches="all")
    assert found.shape == found["status"].shape == found[word].shape == (8, 2, 2)
    assert sum(found.summary().values()) == 8 * 2 * 2
    with ThreadPoolExecutor(2) as executor:
        other = family(block, vary=vary, branches="all", executor=executor)
    for name in found.names:
        assert found[name].tobytes() == other[name].tobytes(), name
    data = found.to_xarray()
    assert data["P1 X"].dims == (word, "3:Y", "solution")
    assert data.sel(solution="P1 nearer")["P1 X"].shape == (8, 2)
    table = found.to_arrow()
    assert table.num_rows == found["status"].size
    assert table.column("solution").to_pylist()[:2] == list(found.solutions)
    assert np.array_equal(np.isnan(found.result("length")), ~found.has_contour)
    paired = family(block, vary={word: [171.87, 165.0], "3:Y": [42.857, 40.0]}, paired=True, branches="all")
    assert paired["P1 X"].shape == (2, 2)
    assert "solutions: P1 nearer and P1 farther" in str(found)
    with pytest.raises(ValueError, match="a map shows one solution"):
        contoursolve.pictures.draw_family_map(found)
    nearer = found.solution("P1 nearer")
    assert "length [mm]" in contoursolve.pictures.draw_family_map(nearer, result="length").title
    with pytest.raises(ValueError, match="write the word that chooses"):
        contoursolve.explore(nearer)


def test_a_chain_without_closed_form_says_that_it_has_no_branches():
    block = "FL X+10 Y+0\nFCT DR+ R5\nFLT X+30 Y+20"
    found = family(block, start="X0 Y0", control="heidenhain", vary={"R": [5.0, 6.0, 25.0]}, branches="all")
    assert (found.solutions, found.has_contour[:, 0].tolist()) == (("the only one",), [True, True, False])
