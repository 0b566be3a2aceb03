"""How long a user waits, beside a peer in the same run: pytest tests/benchmarks."""

import os
import random
import subprocess
import sys
from math import cos, radians, sin
from pathlib import Path
from time import perf_counter

import numpy
import pytest
from pytest_benchmark.fixture import BenchmarkFixture
from scipy.optimize import fsolve

import contoursolve

START = "X40. Z0."
BLOCK = "G111 X100. A180. K-30. B120. P5. Q5."


INSTALLED = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
"""The environment of a process. Installed packages are compiled; ours must be, too, as numpy and casadi are."""


def best_of(rounds: int, command: list[str]) -> float:
    """Shortest time of a whole process, seconds."""
    times = []
    for _ in range(rounds):
        begin = perf_counter()
        subprocess.run(command, check=True, capture_output=True, env=INSTALLED)
        times.append(perf_counter() - begin)
    return min(times)


def test_one_block_warm_from_text_to_verified_contour(benchmark: BenchmarkFixture) -> None:
    result = benchmark(contoursolve.solve, BLOCK, start=START)
    assert result.answers[0].status is contoursolve.Status.SOLVED


def test_peer_scipy_fsolve_on_the_bare_equations_of_the_same_block(benchmark: BenchmarkFixture) -> None:
    """The virtual intersections only: no text, no rules, no corners, no check."""
    a, b = radians(180), radians(120)

    def residuals(v: numpy.ndarray) -> list[float]:
        z1, x1, z2, x2 = v
        return [
            z1 * sin(a) - (x1 - 20) * cos(a),
            z1 + 30,
            (z2 - z1) * sin(b) - (x2 - x1) * cos(b),
            x2 - 50,
        ]

    solution = benchmark(fsolve, residuals, numpy.array([-20.0, 25.0, -40.0, 40.0]))
    assert solution == pytest.approx([-30, 20, -47.32050807568877, 50])


LINE_1 = (("A", "I"), ("A", "K"), ("I", "K"))
LINE_2 = (("B", "X"), ("B", "U"), ("B", "Z"), ("B", "W"), ("X", "Z"), ("X", "W"), ("U", "Z"), ("U", "W"))
RANGES = {
    "A": (150, 170),
    "I": (1, 4),
    "K": (-30, -20),
    "B": (100, 130),
    "X": (90, 110),
    "U": (50, 70),
    "Z": (-60, -50),
    "W": (-60, -50),
}


def write_blocks(number: int) -> str:
    """A program of sound G111 blocks of mixed combinations of words."""
    draw = random.Random(1)
    lines = []
    for _ in range(number):
        first, second = draw.choice(LINE_1), draw.choice(LINE_2)
        words = [f"{name}{draw.uniform(*RANGES[name]):.3f}" for name in first + second]
        words.append(draw.choice(["", "C1.", "P2."] if "B" in second else ["", "P2."]))
        # A bevel at 45 degrees onto a line along X would need a flatter line 2.
        words.append(draw.choice(["", "Q2.", *(["D1."] if {"X", "U"} & {*second} else [])]) if "B" in second else "")
        lines += [f"G00 {START}", " ".join(["G111", *words])]
    return "\n".join(lines)


OVER_SPECIFIED = "G111 A135. I10. K-12. B180. Z-40. P2."


def test_one_over_specified_block_is_fully_diagnosed_in_less_than_50_ms(benchmark: BenchmarkFixture) -> None:
    result = benchmark(contoursolve.solve, OVER_SPECIFIED, start=START, rules="off")
    assert len(result.diagnostics[0].fixes) >= 6
    assert benchmark.stats.stats.median < 0.050


SOUND = ("G111 X100. A180. K-30. B120. P5. Q5.", "G111 I8. A160. B120. X90.", "G111 I5. K-20. Z-50. B130. C1. Q1.")
BROKEN = (
    "G111 X100. A180. B120. P5. Q5.",
    "G111 A135. I10. K-12. B180. Z-40.",
    "G111 X100. A180. K-30. B120. P60.",
    "G111 X100. A0 K-30. B120.",
    "G111 X100. U60. A180. K-30. B120.",
)


def test_checking_a_program_with_one_broken_block_in_ten_takes_at_most_three_times_solving_it_without(
    benchmark: BenchmarkFixture, tmp_path: Path
) -> None:
    blocks = [
        BROKEN[number // 10 % len(BROKEN)] if number % 10 == 0 else SOUND[number % len(SOUND)]
        for number in range(10_000)
    ]
    sound, mixed = tmp_path / "sound.nc", tmp_path / "mixed.nc"
    sound.write_text("".join(f"G00 {START}\n{block}\n" for block in blocks if block in SOUND), encoding="utf-8")
    mixed.write_text("".join(f"G00 {START}\n{block}\n" for block in blocks), encoding="utf-8")
    check = [sys.executable, "-m", "contoursolve", "check", str(mixed)]
    solve = best_of(3, [sys.executable, "-m", "contoursolve", "solve", str(sound)])
    benchmark.pedantic(subprocess.run, args=(check,), kwargs={"capture_output": True, "env": INSTALLED}, rounds=3)
    ratio = benchmark.stats.stats.min / solve
    benchmark.extra_info.update(solve_s=solve, ratio=ratio)
    assert ratio <= 3
