"""LinuxCNC's own compensation against ours: the same path where its rules allow it, its error where ours refuses."""

from pathlib import Path
from typing import Any

import numpy
import pytest
from interpreter import Motion, RefusedError, interpret
from oracle_tool import TIPS, Part, clearance, draw, program_of, run

pytestmark = pytest.mark.interpreter

ORIENTATIONS = {0: 0, 1: 4, 2: 3, 3: 2, 4: 1, 5: 5, 6: 8, 7: 7, 8: 6, 9: 9}
"""LinuxCNC's numbers of the tips."""


def compensated(parts: list[Part], radius: float, side: str, tip: int | None) -> str:
    """A contour under LinuxCNC's compensation, with a move to it along its first element."""
    moves = program_of([parts], is_lathe=tip is not None, factor=1).splitlines()
    way = parts[0].at(numpy.array([0.0]))[1][0]
    before = parts[0].start - way * (radius + 5)
    names = "ZX" if tip is not None else "XY"
    lathe = f" L{ORIENTATIONS[tip]}" if tip is not None else ""
    code = "G41.1" if side == "left" else "G42.1"
    start = f"G00 {names[0]}{before.real:.12f} {names[1]}{before.imag:.12f}"
    entry = f"G01 {moves[1].removeprefix('G00 ')}"
    head = f"{moves[0]} G8 G21 G90 G91.1 G94 F100 G40"
    return "\n".join([head, start, f"{code} D{2 * radius:.6f}{lathe}", entry, *moves[2:], "G40", "M2", ""])


def told(motions: list[Motion]) -> list[tuple[str, complex]]:
    """The kinds and ends of motions that are longer than LinuxCNC's digits."""
    return [(each.kind, each.end) for each in motions if abs(each.end - each.start) > 2e-3]


def is_gouging(motions: list[Motion], shift: complex, parts: list[Part], radius: float) -> bool:
    """Whether a path comes nearer to a contour than the radius."""
    turns = {"cw": -1, "ccw": 1}
    moves = [Part(each.start, each.end, each.center or 0j, turns.get(each.kind, 0)) for each in motions]
    places = [move.at(numpy.linspace(0, 1, 500))[0] - shift for move in moves if abs(move.end - move.start) > 1e-3]
    return min(clearance(each, parts).min() for each in places) < radius - 1e-4


@pytest.mark.parametrize("count", [20, 60])
def test_linuxcnc_goes_the_same_way(count: int, tmp_path: Path):
    random, alike, refused = numpy.random.default_rng(274), 0, 0
    for number in range(count):
        parts, radius = draw(random), round(random.uniform(0.2, 4), 2)
        side, tip = str(random.choice(["left", "right"])), number % 10 if number % 3 == 0 else None
        (tmp_path / "drawn.nc").write_text(program_of([parts], is_lathe=tip is not None))
        options = ["--tool", f"R{radius}", "--side", side, "--rules", "off"]
        options += ["--control", "fanuc-mill"] if tip is None else ["--control", "fanuc-lathe", "--tip", str(tip)]
        (contour,) = run("solve", "--format", "json", *options, str(tmp_path / "drawn.nc"))["contours"]
        text = compensated(parts, radius, side, tip)
        kinds = {each["kind"] for each in contour["tool"]["faults"]} - {"tip_against_side"}
        try:
            motions = interpret(text, tmp_path)
        except RefusedError:
            motions = []
        if kinds:
            # It looks at the next move alone: what it does not refuse, it cuts into.
            shift = radius * TIPS[tip] if tip is not None else 0j
            assert not motions or is_gouging(motions[2:], shift, parts, radius), text
            refused += not motions
            continue
        ends = told(motions)
        own: list[dict[str, Any]] = contour["tool"]["elements"]
        expected = [(each.get("turn", "line"), complex(*each["end"]), complex(*each["start"])) for each in own]
        mine = [(kind, end) for kind, end, start in expected if abs(end - start) > 2e-3]
        theirs = ends[-len(mine) :]
        assert [kind for kind, _ in theirs] == [kind for kind, _ in mine], text
        assert max(abs(one - other) for (_, one), (_, other) in zip(theirs, mine, strict=True)) < 1e-3, text
        alike += 1
    assert alike > 0.3 * count
    assert refused > 0.1 * count
