"""Programs of any length: what is kept of a program does not grow with it, and the outputs are those of short ones."""

import random
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from contoursolve.cli import main
from contoursolve.gcode import lexer

PROGRAMS = sorted((Path(__file__).parents[2] / "notebooks" / "programs").glob("*.nc"))
MOST = 300_000
"""KB that a program of 1,000,000 lines may take; one of 200,000 takes no more than a part of it."""


def long_program(lines: int) -> str:
    draw = random.Random(lines)
    rows = ["G50 S2000", "G00 X40. Z0."]
    for number in range(lines // 5):
        rows += [
            f"N{number % 9999:04d} G00 X40. Z0.",
            f"G111 X100. A180. K-{draw.uniform(20, 40):.3f} B120. P5. Q5. F0.2",
        ]
        rows += [f"G01 Z-{draw.uniform(70, 90):.3f}", f"X{draw.uniform(100, 150):.3f}", f"(COMMENT {number})"]
    return "\n".join(rows) + "\n"


@pytest.mark.parametrize("arguments", ["check", "solve --format json", "check --format json", "check --format github"])
def test_blocks_that_are_not_kept_give_the_same_output(arguments, monkeypatch, tmp_path):
    odd = tmp_path / "odd.nc"
    odd.write_text(
        "X1\n%\nG0 X40. Z0.\nG111 X100. A180. B120.\nG111 A180. K--3.\r\nX1 X2 \u00e9\rG0 X40. Z0.\n%\nX5 Y1e9\n"
    )
    arguments = arguments.split()
    paths = [*map(str, PROGRAMS), str(odd)]
    expected = [CliRunner().invoke(main, [*arguments, path]) for path in paths]
    monkeypatch.setattr(lexer, "MANY_LINES", 1)
    for path, each in zip(paths, expected, strict=True):
        found = CliRunner().invoke(main, [*arguments, path])
        assert (found.exit_code, found.output) == (each.exit_code, each.output)


LATHE, MILL = "G01 X{x:.3f} Z-{z:.3f} F0.2", "N10 G01 X{x:.3f} Y-{z:.3f} F200"
SINUMERIK = "N5 G3 X{x:.3f} Y={z:.3f} CR=80\n; note\nG1 X=AC({x:.3f}) Y{z:.3f} F500"
KLARTEXT = "1 L X+{x:.3f} Y+{z:.3f} R0 FMAX M3\n2 CC X+0 Y+0\nC X-{x:.3f} Y-{z:.3f} DR+ ; note\nCR X+1 Y+2 R-65.5 DR-"
ISG = "N1 G02 X={x:.3f} Y{z:.3f} I1 J2 (note) ; note\nG01 X1 Y{z:.3f}"


@pytest.mark.parametrize(
    ("move", "contour", "control"),
    [
        (LATHE, "", ()),
        (MILL, "", ("--control", "fanuc-mill")),
        (LATHE, "G111 X100. A180. K-30. B120. P5. Q5.", ()),
        (MILL, "G01 X90. ,C.5", ("--control", "fanuc-mill", "--strict")),
        (SINUMERIK, "G1 X5 ANG=30", ("--control", "siemens-840d")),
        (KLARTEXT, "FL X+1 Y+2\nFL AN+30", ("--control", "heidenhain")),
        (ISG, "G1 X90 #RND=3", ("--control", "isg", "--strict")),
    ],
)
def test_plain_lines_are_not_read_into_words(move, contour, control, monkeypatch, tmp_path):
    program, parse_block, read = tmp_path / "long.nc", lexer.parse_block, list[int]()
    monkeypatch.setattr(lexer, "MANY_LINES", 1_000)
    monkeypatch.setattr(lexer, "parse_block", lambda *asked: read.append(0) or parse_block(*asked))
    counts = []
    for number in (2_000, 4_000):
        draw = random.Random(number)
        rows = [move.format(x=draw.uniform(50, 80), z=draw.uniform(1, 90)) for _ in range(number)]
        rows[1500:1500] = contour.split("\n") * bool(contour)
        program.write_text("\n".join(["%", "G90 G21", "G00 X40. Z0. Y0.", *rows, "M30", "%"]) + "\n")
        read.clear()
        CliRunner().invoke(main, ["check", *control, str(program)])
        counts.append(len(read))
    # The last lines of each passage say what stays in force.
    assert counts[1] - counts[0] < 25
    assert counts[1] < 1_100


MEASURE = """
import resource, subprocess, sys
with open(sys.argv[1], "wb") as output:
    subprocess.run(sys.argv[2:], check=True, stdout=output)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
"""
"""A child has at least the memory of the process that starts it, so that has to be a small one."""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="asks the system for the memory of a process")
@pytest.mark.parametrize(("arguments", "lines"), [(("check",), 30_000), (("solve", "--format", "json"), 15_000)])
def test_long_programs_take_little_memory(arguments, lines, tmp_path):
    def taken(number):
        program = tmp_path / f"long-{number}.nc"
        program.write_text(long_program(number))
        command = [sys.executable, "-m", "contoursolve", *arguments, str(program)]
        measured = [sys.executable, "-c", MEASURE, str(tmp_path / "out"), *command]
        done = subprocess.run(measured, check=True, capture_output=True, text=True)
        return int(done.stdout) * (1 if sys.platform != "darwin" else 1 / 1024)

    # The libraries alone take more on one machine than on another.
    assert taken(lines) - taken(300) < MOST / 3
