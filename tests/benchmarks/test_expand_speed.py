"""How long whole programs take to expand, beside what LinuxCNC takes to interpret the result, and how much memory."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from random import Random

import pytest

FORMS = (
    "G111 X100. A180. K-30. B120. P5. Q5.",
    "G111 A180. K-30. B120. X100. C5. D5. F0.2",
    "G111 X100. Z-60. A180. K-30. P2.",
    "G111 A180. K-{k}. B150. U20. P{p:.2f}",
    "G111 I0 K-15. P3. U4. W-20.",
)


def write_program(path: Path, lines: int) -> None:
    """One line in ten is a contour block."""
    rng = Random(1)
    with path.open("w") as file:
        file.write("%\nO0001 (TEST)\nN10 G21 G40 F100\n")
        for _ in range(lines // 10):
            block = rng.choice(FORMS).format(k=rng.randint(10, 40), p=rng.uniform(0.5, 2))
            file.write(f"N{rng.randrange(9999)} G00 X40. Z0.\n{block}\n")
            for _ in range(8):
                x, z = rng.uniform(10, 90), -rng.uniform(0, 90)
                file.write(rng.choice((f"G01 X{x:.3f} Z{z:.3f} F0.2\n", f"X{x:.3f}\n", "(COMMENT)\n")))
        file.write("M30\n%\n")


INSTALLED = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
"""The environment of a process. An installed package is compiled; ours must be, too."""

_MEASURE = """
import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True, capture_output=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)
"""


def spent(*command: object) -> tuple[float, float]:
    """Processor seconds of a command, and its memory in MB."""
    arguments = [sys.executable, "-c", _MEASURE, *map(str, command)]
    done = subprocess.run(arguments, check=True, capture_output=True, text=True, env=INSTALLED)
    seconds, memory = map(float, done.stdout.split())
    return seconds, memory


@pytest.mark.skipif(shutil.which("rs274") is None, reason="rs274 is not installed (Debian: linuxcnc-uspace)")
def test_expanding_takes_at_most_eight_times_what_interpreting_the_result_takes(tmp_path, told):
    old, new = tmp_path / "old.nc", tmp_path / "new.ngc"
    expand = (sys.executable, "-m", "contoursolve", "expand", old, "--post", "linuxcnc", "--force", "-o", new)
    write_program(old, 100)
    spent(*expand)
    write_program(old, 100_000)
    # Both alternate, for other work on the machine slows down either.
    times = [(spent(*expand)[0], spent("rs274", "-g", new)[0]) for _ in range(3)]
    ours, theirs = (min(each) for each in zip(*times, strict=True))
    told(
        "expand, 100,000 lines with 10,000 contours", f"{ours:.1f} s", f"{ours / theirs:.1f} times rs274 on the result"
    )
    assert ours <= 8 * theirs


def test_a_million_lines_take_at_most_300_mb(tmp_path):
    old, new = tmp_path / "old.nc", tmp_path / "new.ngc"
    write_program(old, 1_000_000)
    _, memory = spent(sys.executable, "-m", "contoursolve", "expand", old, "--post", "linuxcnc", "-o", new)
    assert memory <= 300
