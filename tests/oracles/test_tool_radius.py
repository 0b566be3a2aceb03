"""The tool: worked examples by hand, and random contours against an oracle of points."""

import re
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy
import pytest
from click.testing import CliRunner
from oracle_tool import SPELLINGS, TIPS, Part, Spelling, clearance, draw, is_cut, parts_of, run

from contoursolve.cli import main

TABLE = Path(__file__).parent / "tool" / "tool-radius.txt"
ROWS = [line.split(" | ") for line in TABLE.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]


def examine(tool: str, start: str, program: str) -> dict[str, Any]:
    """The only contour of a worked example."""
    radius, *words = tool.split()
    tip = [word[1:] for word in words if word.startswith("T")]
    side, outside = "left" if "G41" in words else "right", "intersect" if "intersect" in words else "roll"
    blocks = [part for block in program.split(" / ") for part in ("--block", block)]
    control = ["--control", "fanuc-lathe", "--tip", *tip] if tip else ["--control", "fanuc-mill"]
    options = ["--tool", radius, "--side", side, "--outside", outside, "--start", start, *control]
    (contour,) = run("solve", "--format", "json", *options, *blocks)["contours"]
    return dict(contour)


def point(text: str, plane: list[str]) -> list[float]:
    """A place of the table, X of a lathe as radius."""
    words = dict(re.findall(r"([XYZ])(-?[\d.]+)", text))
    return [float(words[axis]) / (2 if axis == "X" and "Z" in plane else 1) for axis in plane]


@pytest.mark.parametrize(("number", "tool", "start", "program", "result"), ROWS, ids=[row[0] for row in ROWS])
def test_worked_examples(number: str, tool: str, start: str, program: str, result: str):
    contour = examine(tool, start, program)
    found, plane = contour["tool"], contour["plane"]
    assert contour["status"] == "solved"
    faults = [each for each in found["faults"] if each["kind"] != "tip_against_side"]
    if ">" not in result:
        kind, block, short, fits = result.split()
        (fault,) = faults
        assert (fault["kind"], fault["element"]) == (kind, int(block) - 1)
        assert (fault["short_by_mm"], fault["largest_radius"]) == pytest.approx((float(short), float(fits)), abs=1e-4)
        assert found["elements"] is None
        return
    assert faults == []
    begin, *moves = result.split(" > ")
    assert found["start"] == pytest.approx(point(begin, plane), abs=1e-4)
    assert len(found["elements"]) == len(moves)
    for element, move in zip(found["elements"], moves, strict=True):
        end, _, center = move.partition(" (c ")
        assert element["end"] == pytest.approx(point(end, plane), abs=1e-4)
        assert element["kind"] == ("arc" if center else "line")
        if center:
            assert element["center"] == pytest.approx(point(center, plane), abs=1e-4)
            assert element["radius"] == pytest.approx(float(center.rpartition("R")[2].strip(")")), abs=1e-4)
            assert element["turn"] == ("cw" if "G02" in end else "ccw")


def test_a_tip_that_points_away_is_told():
    contour = examine("R0.8 T3 G41", "X20. Z0.", "G01 X20. Z-10. / X30. Z-20. / X30. Z-30.")
    deep = [each["short_by_mm"] for each in contour["tool"]["faults"]]
    assert {each["kind"] for each in contour["tool"]["faults"]} == {"tip_against_side"}
    assert (deep[0], deep[2]) == pytest.approx((1.6, 1.6))


# Random contours --------------------------------------------------------------------------------------------------


def expanded(contours: list[list[Part]], about: "Drawn", folder: Path) -> list[list[Part]]:
    """The paths that are written for contours that a tool cuts, read as contours for a tool without a radius."""
    (folder / "drawn.nc").write_text(about.spelling.program(contours, about.stated))
    output = folder / "written.nc"
    done = CliRunner().invoke(main, ["expand", *about.options, str(folder / "drawn.nc"), "-o", str(output), "--force"])
    assert done.exit_code == 0 or not contours, done.output
    plain = ["solve", "--format", "json", "--tool", "0", "--side", "left", *about.reading, str(output)]
    return [parts_of(each["elements"]) for each in run(*plain)["contours"]] if contours else []


@dataclass
class Drawn:
    """How contours are spelled, and the tool beside them."""

    spelling: Spelling
    radius: float
    side: int
    stated: int
    """The side, if the program says it; else 0."""
    outside: str
    tip: int

    @property
    def reading(self) -> list[str]:
        tip = ["--tip", str(self.tip)] if self.spelling.is_lathe else []
        return ["--control", self.spelling.control, *self.spelling.options, *tip, "--rules", "off"]

    @property
    def options(self) -> list[str]:
        side = [] if self.stated else ["--side", "left" if self.side > 0 else "right"]
        return ["--tool", f"R{self.radius}", *side, "--outside", self.outside, *self.reading]

    @property
    def shift(self) -> complex:
        """From the centre to the programmed point."""
        return self.radius * TIPS[self.tip] if self.spelling.is_lathe else 0j


@pytest.mark.slow
@pytest.mark.parametrize("count", [14, 100])
def test_random_contours(count: int, tmp_path: Path):
    """No path comes nearer to any wall than the radius; each stays at it, where something is left out, too; what fits
    is not refused."""
    random = numpy.random.default_rng(41)
    refused, left, undecided, in_each = 0, 0, 0, count // len(SPELLINGS)
    for spelling in SPELLINGS * max(in_each // 10, 1):
        contours = [draw(random) for _ in range(min(in_each, 10))]
        side = int(random.choice([-1, 1]))
        outside = str(random.choice(["roll", "intersect"]))
        stated = side if random.random() < 0.5 and spelling.control != "yasnac-lx3" else 0
        radius = round(random.uniform(0.2, 4), 2)
        about = Drawn(spelling, radius, side, stated, outside, int(random.integers(10)))
        (tmp_path / "drawn.nc").write_text(spelling.program(contours, stated))
        found = run("solve", "--format", "json", *about.options, str(tmp_path / "drawn.nc"))["contours"]
        assert len(found) == len(contours), (about, found)
        fitting = [parts for parts, each in zip(contours, found, strict=True) if each["tool"]["elements"]]
        for parts, path in zip(fitting, expanded(fitting, about, tmp_path), strict=True):
            places = [each.at(numpy.linspace(0, 1, 200))[0] - about.shift for each in path]
            assert min(clearance(each, parts).min() for each in places) > radius - 0.002, about
        leave = ("--setting", f"{spelling.control}.tool-too-small=leave", str(tmp_path / "drawn.nc"))
        (tmp_path / "drawn.nc").write_text(spelling.program(contours, stated))
        rests = run("solve", "--format", "json", *about.options, *leave)["contours"]
        for parts, contour, rest in zip(contours, found, rests, strict=True):
            # What fits has the same path where the tool may leave something.
            for piece in parts_of(rest["tool"]["elements"] or []):
                off = clearance(piece.at(numpy.linspace(0, 1, 1000))[0] - about.shift, parts) - radius
                # Elements that turn by less than 0.01 degrees are taken for tangent.
                assert off.min() > -1e-5
                assert outside == "intersect" or abs(off).max() < 1e-5
            left += contour["tool"]["elements"] is None and rest["tool"]["elements"] is not None
            assert contour["tool"]["elements"] in (None, rest["tool"]["elements"])
            tool, read = contour["tool"], parts_of(contour["elements"])
            assert max(abs(one.end - two.end) for one, two in zip(parts, read, strict=True)) < 1e-9
            says = is_cut(parts, radius, side)
            if tool["elements"] is None:
                refused += 1
                undecided += says is None
                kinds = {each["kind"] for each in tool["faults"]} - {"tip_against_side"}
                # Prolonged, a path comes to walls that it would not reach around the corner.
                is_prolonged = outside == "intersect" and kinds == {"interference"}
                assert says is not True or is_prolonged, (about, kinds, parts)
                continue
            assert says is not False, (about, parts)
            path = parts_of(tool["elements"])
            assert all(abs(one.end - two.start) < 1e-8 for one, two in pairwise(path))
    assert refused < 0.9 * count
    assert left > 0
    assert undecided < 0.2 * count
