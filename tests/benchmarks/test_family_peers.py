"""Contours a second beside general tools on the same work: pytest tests/benchmarks/test_family_peers.py -s

The work is two lines by A, K, B and X with one rounding P, for random A and P: the intersections, the ends and the
centre of the rounding. contoursolve also makes every check, and says of each row what is wrong with it.

A peer that is not installed has no row, and the test says so. How general solvers find a chain: `peers.py`.
"""

import sys
from collections.abc import Callable
from functools import cache
from math import cos, hypot, radians, sin
from time import process_time
from typing import Any

import numpy as np
import pytest

import contoursolve

BLOCK, START = "G111 X100. A180. K-30. B120. P5.", "X40. Z0."
ROWS = 200_000
ROUNDS = 5
"""The quickest counts, for other work slows a short one by half."""
RNG = np.random.default_rng(1)
A, P = np.round(RNG.uniform(150, 210, ROWS), 3), np.round(RNG.uniform(0.5, 9, ROWS), 3)
K, B, X = -30.0, radians(120), 50.0

NAMES = [
    f"{name} {axis}" for name in ("V1", "V2", "corner 1.begin", "corner 1.end", "corner 1.center") for axis in "ZX"
]


def equations(point: np.ndarray, a: float, p: float) -> list[float]:
    """What a user states: places on lines, contacts on lines, the centre beside both."""
    z1, x1, z2, x2, zb, xb, ze, xe, zc, xc = point
    side = 1 if sin(B - a) > 0 else -1
    return [
        z1 - K,
        z1 * sin(a) - (x1 - 20) * cos(a),
        x2 - X,
        (z2 - z1) * sin(B) - (x2 - x1) * cos(B),
        (zc - z1) * -sin(a) + (xc - x1) * cos(a) - side * p,
        (zc - z1) * -sin(B) + (xc - x1) * cos(B) - side * p,
        zb - zc - side * p * sin(a),
        xb - xc + side * p * cos(a),
        ze - zc - side * p * sin(B),
        xe - xc + side * p * cos(B),
    ]


GUESS = np.array([-30, 20, -47, 50, -27, 20, -31, 22, -27, 25], float)


def by_scipy(rows: int) -> np.ndarray:
    fsolve = pytest.importorskip("scipy.optimize").fsolve
    return np.array([fsolve(equations, GUESS, (radians(a), p)) for a, p in zip(A[:rows], P[:rows], strict=True)])


def by_lambdify(rows: int) -> np.ndarray:
    """The closed form, made by sympy and evaluated by NumPy: no check, no status."""
    sympy = pytest.importorskip("sympy")
    a, p, b = *sympy.symbols("a p"), sympy.rad(120)
    u, v = sympy.Matrix([sympy.cos(a), sympy.sin(a)]), sympy.Matrix([sympy.cos(b), sympy.sin(b)])
    v1 = sympy.Matrix([0, 20]) + u * (-30 / u[0])
    v2 = v1 + v * ((50 - v1[1]) / v[1])
    side, back = sympy.sign(u[0] * v[1] - u[1] * v[0]), p * (u - v).norm() / (u + v).norm()
    begin, end = v1 - u * back, v1 + v * back
    center = begin + sympy.Matrix([-u[1], u[0]]) * side * p
    function = sympy.lambdify([a, p], [*v1, *v2, *begin, *end, *center], "numpy", cse=True)
    return np.stack([np.broadcast_to(each, rows) for each in function(np.radians(A[:rows]), P[:rows])], axis=1)


def by_loop(rows: int) -> np.ndarray:
    """`contoursolve.solve` in a loop: text in, a proven contour out."""
    found = []
    for a, p in zip(A[:rows], P[:rows], strict=True):
        block = f"G111 X100. A{a:.3f} K-30. B120. P{p:.3f}"
        contour = contoursolve.solve(block, start=START).answers[0].contour
        assert contour is not None
        corner = next(each for each in contour.elements if each.name == "corner 1")
        places = contour.points["V1"], contour.points["V2"], corner.start, corner.end, corner.center  # type: ignore[union-attr]
        found.append([value for place in places for value in place])
    return np.array(found)


def by_family(rows: int) -> np.ndarray:
    found = contoursolve.family(BLOCK, start=START, vary={"A": A[:rows], "P": P[:rows]}, paired=True)
    # X of a lathe is a diameter in a family.
    return np.stack([found[name] / (1 + name.endswith("X")) for name in NAMES], axis=1)


@cache
def mapped(rows: int) -> Any:
    """The function of the system for many rows."""
    return contoursolve.system(BLOCK, start=START).function().map(rows)


def by_map(rows: int) -> np.ndarray:
    """The function of a system, mapped over the rows: no check, no status."""
    others = {"Z_S": 0, "X_S": 40, "X": 100, "K": -30, "B": 120}
    found = mapped(rows)(**others, A=A[None, :rows], P=P[None, :rows])
    points, corner, centers = found["points"].full(), found["elements"].full()[1], found["centers"].full()
    parts = points[0].reshape(rows, 2), points[1].reshape(rows, 2), corner.reshape(rows, 4), centers.reshape(rows, 2)
    return np.concatenate(parts, axis=1)


PEERS: dict[str, tuple[Callable[[int], np.ndarray], int]] = {
    "contoursolve.family": (by_family, ROWS),
    "sympy.lambdify, unchecked": (by_lambdify, ROWS),
    "function().map of a system, unchecked": (by_map, ROWS),
    "a loop over contoursolve.solve": (by_loop, 2_000),
    "scipy.optimize.fsolve": (by_scipy, 2_000),
}


def test_contours_a_second_beside_general_tools(capsys: pytest.CaptureFixture[str]) -> None:
    expected, rates, right, missing = by_family(ROWS), {}, {}, []
    for name, (solve, rows) in PEERS.items():
        try:
            solve(min(rows, 10))
        except pytest.skip.Exception as reason:
            missing.append(f"{name}: {reason}")
            continue
        times = []
        for _ in range(ROUNDS):
            begin = process_time()
            found = solve(rows)
            times.append(process_time() - begin)
        rates[name] = rows / min(times)
        is_known = np.isfinite(expected[:rows]).all(axis=1)
        off = [hypot(*each) for each in (found - expected[:rows])[is_known]]
        right[name] = np.mean(np.array(off) < 1e-6)
    with capsys.disabled():
        for name, rate in rates.items():
            sys.stdout.write(f"\n| {name} | {rate:,.0f} | {right[name]:.0%} |")
    assert right["contoursolve.family"] == right["a loop over contoursolve.solve"] == 1
    assert rates["contoursolve.family"] > 0.2 * rates["sympy.lambdify, unchecked"]
    if missing:
        pytest.skip(f"all others were measured. {'; '.join(missing)}")
