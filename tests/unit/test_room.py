"""What fits where a corner is too large: the largest size, found in a few evaluations of the contour's function."""

import pytest

import contoursolve
from contoursolve.numeric import Compiled

MILL = "G17 G90 G0 X0 Y0\n"


@pytest.mark.parametrize(
    ("control", "program", "told", "most"),
    [
        ("fanuc-lathe", "G0 X20. Z0.\nG1 Z-20. ,R30.\nX60.", {"limit": 20.0}, 4),
        ("nct-99m", MILL + "G1 X30 ,C31\nX40 Y40", {"limit": 30.0}, 4),
        # The largest is no decimal: 20 is sqrt(2) times it.
        ("fanuc-lathe", "G0 X20. Z0.\nG1 Z-20. ,C31.\nX40. Z-30.", {"limit": 14.142135624}, 7),
        # Each of two keeps the other one's room.
        ("nct-99m", MILL + "G1 X30 ,C20\nY30 ,C20\nX60", {"limit_first": 10.0, "limit_second": 10.0}, 7),
        # The second takes all of the line, so both must come down.
        ("nct-99m", MILL + "G1 X60 ,C20\nY30 ,C30\nX120", {"together": 15.0}, 14),
        # An arc before the corner: what is left does not fall linearly, and ends where no rounding touches both.
        ("nct-99m", MILL + "G1 X50 Y0 ,R90\nG3 X-50 Y0 R50", {"limit": 25.0}, 10),
    ],
)
def test_what_fits_is_found_in_few_evaluations(monkeypatch, control, program, told, most):
    calls = []
    call = Compiled.__call__
    monkeypatch.setattr(Compiled, "__call__", lambda self, values: calls.append(1) or call(self, values))
    answer = contoursolve.solve(program, control=control, depth="verdict", rules="off").answers[0]
    values = next(each.values for each in answer.diagnostics if each.is_error)
    assert {name: values[name] for name in told} == pytest.approx(told, abs=1e-8)
    assert len(calls) <= most
