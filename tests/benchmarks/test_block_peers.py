"""One block from text to a checked contour, beside planegcs (FreeCAD's solver, from npm) with its check and text."""

import json
import shutil
import subprocess
from pathlib import Path
from statistics import median
from time import perf_counter

import pytest

import contoursolve

START, BLOCK = "X40. Z0.", "G111 X100. A180. K-30. B120. P5. Q5."
PACKAGE = "@salusoft89/planegcs@1.3.0"


def ours(rounds: int) -> float:
    """Microseconds of one block, warm; the median."""
    times = []
    for _ in range(rounds):
        begin = perf_counter()
        (answer,) = contoursolve.solve(BLOCK, start=START).answers
        times.append(1e6 * (perf_counter() - begin))
        assert answer.contour.end == pytest.approx((-50.2073, 50), abs=1e-4)
    return median(times)


def theirs(folder: Path) -> float:
    command = ["node", Path(__file__).with_name("by_planegcs.mjs"), f"G00 {START}", BLOCK]
    done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["end"] == "U2 Z-50.2073 X100.0000"
    return found["us"]


@pytest.mark.skipif(shutil.which("npm") is None, reason="npm is not installed")
def test_one_block_beside_planegcs(tmp_path: Path, told) -> None:
    install = ["npm", "install", "--silent", "--prefix", tmp_path, PACKAGE]
    subprocess.run(install, check=True, capture_output=True)
    ours(500)
    # Both alternate, for other work on the machine slows down either.
    pairs = [(ours(1_000), theirs(tmp_path)) for _ in range(3)]
    mine, peer = (min(each) for each in zip(*pairs, strict=True))
    told(
        "one block, warm, from text to a proven contour",
        f"{mine:.0f} us",
        f"{mine / peer:.1f} times planegcs with its check and text",
    )
    assert mine < 3 * peer
