"""After an edit in a program of 10,000 lines, findings come in at most twice the time of checking the changed contour
and what follows from it, as a program of its own; both in one run."""

import re
from statistics import median
from time import perf_counter

import pytest

from contoursolve import OpenProgram, solve

ROUNDS = 41
CONTOURS = 1_000
HEAD = "O1\nG50 X200. Z200.\nG96 S200 M3\n"
ONE = (
    "N{number} G00 X{start}. Z0.\nG01 Z-5. F0.2\nX50. Z-10.\nG00 X200. Z2.\nX40. Z0.\n"
    "G111 X100. A180. K-{depth}. B120. {corner} Q5.\nG00 X200.\nZ2.\nT0101 M8\nG04 X1.\n"
)
LINE = 5_009
"""Of a contour in the midst of the program."""


def program_of(corner: str) -> str:
    ones = (ONE.format(number=10 * n + 10, start=40 + n % 7, depth=30 + n % 9, corner=corner) for n in range(CONTOURS))
    return HEAD + "".join(ones)


def edit(program: OpenProgram, digit: int) -> float:
    """Type one digit into the K of a contour; how long its findings take, seconds."""
    begin = perf_counter()
    program.edit((LINE, 21), (LINE, 22), str(digit))
    program.check()
    assert isinstance(program.diagnostics, tuple)
    return perf_counter() - begin


def check_alone(lines: list[str], digit: int) -> float:
    """The same contour with the lines from the last known position to the next one."""
    text = re.sub(r"K-\d+", f"K-3{digit}", "\n".join(lines))
    begin = perf_counter()
    solve(text, control="yasnac-lx3")
    return perf_counter() - begin


@pytest.mark.parametrize("corner", ["P5.", "P500."], ids=["solved", "refused"])
def test_an_edit_costs_what_depends_on_it(corner):
    program = OpenProgram(program_of("P5."))
    program.check()
    if corner != "P5.":
        block = program.blocks[LINE - 1].text
        program.edit((LINE, 1), (LINE, len(block) + 1), block.replace("P5.", corner))
        program.check()
    assert bool(program.diagnostics) == (corner != "P5.")
    around = [program.blocks[line - 1].text for line in range(LINE - 1, LINE + 3)]
    edits, alone = [], []
    for number in range(ROUNDS):
        edits.append(edit(program, number % 5 + 1))
        alone.append(check_alone(around, number % 5 + 1))
    print(f"\n{corner}: an edit {1e3 * median(edits):.1f} ms, the contour alone {1e3 * median(alone):.1f} ms")  # noqa: T201 - what was measured
    assert median(edits) < 2 * median(alone)
