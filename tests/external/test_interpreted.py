"""Programs that were drawn first, expanded, and run: by LinuxCNC's interpreter, and as a Fanuc control reads them."""

import re
from collections.abc import Iterator
from functools import cache
from random import Random
from typing import NamedTuple

import pytest
from examples_fanuc import EXAMPLES, drawn
from fanuc import read
from generate_fanuc import random_lathe, random_mill
from generate_lx3 import FORMS as ARC_FORMS, random_g11, random_g112
from generate_nct import FORMS, Drawn, random_chain, random_cornered, random_pair
from interpreter import assert_path, interpret, interpret_all
from oracle import Element, g111
from oracle_fanuc import Machine, whole
from oracle_mitsubishi import FORMS as PAIRS, random_block
from vectors import VECTORS, ends, path_of as drawn_path

import contoursolve
from contoursolve.comparison import ToolPath, compare, follow
from contoursolve.controls import CONTROLS, PLAIN
from contoursolve.gcode import parse
from contoursolve.geometry import Length
from contoursolve.program.pipeline import run
from contoursolve.program.request import Request

LX3, NCT = "yasnac-lx3", "nct-99m"
AT_LEAST = 200
"""Programs."""


class Drawing(NamedTuple):
    """A program, the path that it was written from, and what it shows."""

    control: str
    text: str
    path: list[Element]
    plane: int
    shows: frozenset[str]


@cache
def drawings() -> list[Drawing]:
    """Every form of both controls, each with every corner, every third one in inches."""
    rng = Random(6)
    found = []
    for number, (control, program, path, plane, shows) in enumerate(_all(rng)):
        unit = "G20" if number % 3 == 2 else "G21"
        found.append(Drawing(control, f"{unit} F100\n{program}", list(path), plane, frozenset({unit, *shows})))
    return found


Case = tuple[str, str, list[Element], int, set[str]]


def _all(rng: Random) -> Iterator[Case]:
    yield from _on_a_lathe(rng)
    for plane in (17, 18, 19):
        yield from _on_a_mill(rng, plane)


def _on_a_lathe(rng: Random) -> Iterator[Case]:
    for line_1 in ("AI", "AK", "IK"):
        for line_2 in ("BX", "BU", "BZ", "BW", "XZ", "UW", "XW"):
            for corners in ("", "C", "P") if "B" not in line_2 else ("", "C", "P", "D", "Q", "CD", "CQ", "PD", "PQ"):
                text, path = _taper(rng, line_1, line_2, corners)
                shows = {"G111", f"G111 {line_2}", f"G111 {corners or 'sharp'}", f"G111 {line_1}"}
                yield LX3, text, path, 18, shows
    for form in ARC_FORMS:
        for first in ("", "P", "C"):
            for second in ("", "Q", "D"):
                drawn = random_g112(rng, form, first, second)
                yield LX3, drawn.text, list(drawn.elements), 18, {f"G112 {form}", f"G112 {first}{second}"}
    for count in range(24):
        drawn = random_g11(rng, 1 + count % 4)
        yield LX3, drawn.text, list(drawn.elements), 18, {kind[:3] for kind in drawn.kind}


def _on_a_mill(rng: Random, plane: int) -> Iterator[Case]:
    for form in FORMS:
        for corner in ("", "C", "R"):
            yield _nct(random_pair(rng, form, plane, corner), form, f",{corner}" if corner else "sharp")
    for length in (2, 3, 4, 5):
        yield _nct(random_chain(rng, length, plane), f"chain of {length + 1}")
    for _ in range(10):
        drawn = random_cornered(rng, plane)
        yield _nct(drawn, "16.2" if len(drawn.kind) == 1 else "16.1")


def _nct(drawn: Drawn, *shows: str) -> Case:
    parts = {part for kind in drawn.kind for part in (kind.split(" ,")[0], *re.findall(r",[CR]|G91", kind))}
    return NCT, drawn.text, list(drawn.elements), drawn.plane, {*shows, *parts, f"G{drawn.plane}"}


def _taper(rng: Random, line_1: str, line_2: str, corners: str) -> tuple[str, list[Element]]:
    """A taper of the closed form that the control accepts."""
    while True:
        start = complex(round(rng.uniform(-20, 20), 3), round(rng.uniform(20, 80), 3) / 2)
        words = {
            "A": rng.choice((180, 135, 90, round(rng.uniform(91, 269), 3))),
            "K": -round(rng.uniform(2, 40), 3),
            "I": round(rng.uniform(-5, 20), 3),
            "B": round(rng.uniform(91, 179), 3),
            "X": round(rng.uniform(20, 160), 3),
            "U": round(rng.uniform(-20, 80), 3),
            "Z": -round(rng.uniform(20, 120), 3),
            "W": -round(rng.uniform(20, 120), 3),
            **{name: round(rng.uniform(0.2, 5), 3) for name in "CPDQ"},
        }
        words = {name: words[name] for name in line_1 + line_2 + corners}
        outcome = g111(start, words)
        if outcome.status == "solved" and not outcome.is_near:
            break
    block = " ".join(f"{name}{value:.3f}" for name, value in words.items())
    return f"G00 X{2 * start.imag:.4f} Z{start.real:.4f}\nG111 {block}\n", list(outcome.elements)


def test_every_form_of_both_controls_is_among_the_programs():
    shown = frozenset[str]().union(*(each.shows for each in drawings()))
    wanted = {"G20", "G21", "G17", "G18", "G19", "G91", "G11", "G12", "G01", "16.1", "16.2", ",C", ",R", *FORMS}
    wanted |= {f"G111 {corners}" for corners in ("sharp", "C", "P", "D", "Q", "CD", "CQ", "PD", "PQ")}
    wanted |= {f"G112 {form}" for form in ARC_FORMS} | {f"G112 {pair}" for pair in ("", "P", "CD", "PQ", "CQ", "PD")}
    wanted |= {f"chain of {count}" for count in (3, 4, 5, 6)}
    wanted |= {"arc by center and point", "arc by R+", "arc by R-", "line by one coordinate and", "line to end"}
    assert wanted - shown == set()
    for control in (LX3, NCT):
        assert {"G20", "G21"} <= frozenset().union(*(each.shows for each in drawings() if each.control == control))
    assert len(drawings()) >= AT_LEAST


def expanded(post: str, arcs: str, stride: int = 1) -> list[str]:
    """The programs for a target, one in so many of them, and that it knows all that is in them."""
    programs = []
    for each in drawings()[::stride]:
        expansion = contoursolve.expand(each.text, post=post, arcs=arcs, control=each.control)
        assert expansion.text is not None, (each.text, expansion.summary.left)
        text = expansion.text
        unfamiliar = [found.text[4:] for found in expansion.summary.unfamiliar if found.text[0] == "G"]
        assert unfamiliar == ["in G19"] * (each.plane == 19 and post == "linuxcnc"), each.text
        if post == "linuxcnc":
            assert ("G7 " if each.control == LX3 else "G8 ") in text
            # LinuxCNC has no compensation in G19, and says so; with D0, it changes nothing.
            text = re.sub(r"G4[12] |D0", "", text) if each.plane == 19 else text
        programs.append(text)
    return programs


def within(each: Drawing, post: str) -> float:
    """How far off in the program's unit: half the last decimal, for start and end, and four decimals of rs274."""
    if post == "linuxcnc":
        return 2e-4
    return 1.5e-4 + 1e-4 if "G20" in each.shows else 1.5e-3


@pytest.mark.interpreter
@pytest.mark.parametrize(
    ("post", "arcs"),
    [
        ("linuxcnc", "center"),
        *(
            pytest.param(*each, marks=pytest.mark.slow)
            for each in (("linuxcnc", "radius"), ("fanuc", "center"), ("fanuc", "radius"))
        ),
    ],
)
def test_linuxcnc_runs_every_program_where_it_was_drawn(post, arcs, tmp_path):
    programs = expanded(post, arcs)
    if post == "fanuc":
        # What a Fanuc control has in force by itself is said once before each.
        modes = ["G7 G18" if each.control == LX3 else "G8 G17" for each in drawings()]
        programs = [
            f"{mode} G90 G91.1\n" + (re.sub(r"G4[12] |D0", "", text) if each.plane == 19 else text)
            for mode, text, each in zip(modes, programs, drawings(), strict=True)
        ]
    for each, motions in zip(drawings(), interpret_all(programs, tmp_path), strict=True):
        path = [(part.start, part.end, part.center, part.turn) for part in each.path]
        assert_path(motions[1:], path, within(each, post))


@pytest.mark.interpreter
@pytest.mark.parametrize("count", [3, 60])
def test_linuxcnc_runs_blocks_in_pairs_where_they_were_drawn(count, tmp_path):
    blocks = [random_block(Random(number), form, 17 + number % 2) for form in PAIRS for number in range(count)]
    drawn = [each for each in blocks if each.elements and not each.is_near]
    assert len(drawn) >= len(blocks) / 3
    programs = []
    for each in drawn:
        text = contoursolve.expand(f"G21 F100\n{each.text}\n", post="linuxcnc", control="mitsubishi").text
        assert text is not None, each.text
        programs.append(text)
    for each, motions in zip(drawn, interpret_all(programs, tmp_path), strict=True):
        assert_path(motions[1:], [(part.start, part.end, part.center, part.turn) for part in each.elements], 2e-4)


@pytest.mark.interpreter
@pytest.mark.parametrize("name", [each for each in VECTORS["mitsubishi"] if each.startswith("MI-")])
def test_linuxcnc_runs_the_worked_examples_of_blocks_in_pairs_to_where_they_end(name, tmp_path):
    row = VECTORS["mitsubishi"][name]
    text = "\n".join(row["program"])
    frame = text if text.startswith("%") else f"G21 F100\n{text}\nM2"
    written = contoursolve.expand(frame, post="linuxcnc", control="mitsubishi").text
    found = [motion.end for motion in interpret(written, tmp_path) if motion.kind != "traverse"]
    for expected in ends(row):
        near = [place for place, end in enumerate(found) if abs(end - complex(*expected)) <= 2e-4]
        assert near, expected
        found = found[near[0] + 1 :]


RESPELLED = {
    "siemens-840d": (
        ("G1 ANG=30 RND=6\nX60 Y20 ANG=-45", "0 0; 46.7308 26.9801 > cw 53.9735 26.0265 49.7308 21.7839; 60 20"),
        ("G1 X=AC(30) CHR=3\nG91 X30 Y40", "0 0; 27 0; 31.8 2.4; 60 40"),
        ("G1 X10\nCT X20 Y10\nX30 Y20", "0 0; 10 0; ccw 20 10 10 10; cw 30 20 30 10"),
    ),
    "isg": (
        ("G01 #ANG=60 X20", "0 0; 20 34.6410"),
        ("G91 G01 X80 Y-40\nG301 I40\nG01 X80 Y40", "0 0; 44.2229 -22.1115; 115.7771 -22.1115; 160 0"),
        ("G91 G01 X60\nG302 I30\nX-40 Y-55", "0 0; 1.0869 0 > cw 25.3490 -47.6452 1.0869 -30; 20 -55"),
        (
            "G1 X10\n#ANG=70 #RND=8\n#ANG=15 X60 Y70",
            "0 0; 10 0; 31.4036 58.8059 > cw 36.8506 63.7971 38.9211 56.0697; 60 70",
        ),
    ),
}
"""Contours of a mill as the sheets have them."""


@pytest.mark.interpreter
@pytest.mark.parametrize("control", RESPELLED)
def test_linuxcnc_runs_what_words_with_names_are_expanded_to(control, tmp_path):
    for text, printed in RESPELLED[control]:
        expansion = contoursolve.expand(f"G17 G90 G0 X0 Y0 F100\n{text}\nM2\n", post="linuxcnc", control=control)
        assert not expansion.summary.left
        assert not expansion.summary.unfamiliar
        motions = [each for each in interpret(expansion.text, tmp_path) if each.kind != "traverse"]
        path = [(part.start, part.end, part.center, part.turn) for part in drawn(printed, 1)]
        assert_path(motions, path, 4e-4)


@pytest.mark.parametrize(
    ("control", "text", "told"),
    [
        (
            "siemens-840d",
            "G17 DIAMOF G0 X0 Y0 LIMS=3000\nG1 X=IC(5)\nG0 X0\nG1 X30 RND=2\nY=40",
            ["LIMS=3000", "X=IC(5)"],
        ),
        ("siemens-840d", "G17 G71 G0 X0 Y0\nRNDM=2\nG1 X30\nY40 FRC=0.1", ["RNDM=2", "FRC=0.1"]),
        ("isg", "G17 G71 G162 G0 X0 Y0\nG1 X30 #RND=2\nY40 #FRC=10", ["G162", "#FRC=10"]),
    ],
)
def test_words_that_linuxcnc_cannot_know_are_told(control, text, told):
    summary = contoursolve.expand(text, post="linuxcnc", control=control).summary
    assert [each.text for each in summary.unfamiliar] == told


@pytest.mark.parametrize("arcs", ["center", "radius"])
@pytest.mark.parametrize("stride", [5, 1])
def test_a_fanuc_control_runs_every_program_where_it_was_drawn(arcs, stride):
    for each, text in zip(drawings()[::stride], expanded("fanuc", arcs, stride), strict=True):
        motions = list(read(text, is_lathe=each.control == LX3))
        path = [(part.start, part.end, part.center, part.turn) for part in each.path]
        assert_path(motions[1:], path, within(each, "fanuc"))


@pytest.mark.slow
@pytest.mark.parametrize("post", ["same", "linuxcnc", "fanuc"])
@pytest.mark.parametrize("stride", [5, pytest.param(1, marks=pytest.mark.slow)])
def test_diff_finds_every_program_equal_and_each_coordinate_that_is_off_by_a_hundredth(post, stride):
    rng = Random(10)
    targets = {"same": (LX3, NCT), "linuxcnc": ("linuxcnc", "linuxcnc"), "fanuc": ("fanuc-lathe", "fanuc-mill")}
    for each in drawings()[::stride]:
        arcs, target = rng.choice(("center", "radius")), targets[post][each.control == NCT]
        new = contoursolve.expand(each.text, post=post, arcs=arcs, control=each.control).text
        old = path_of(each.text, each.control)
        inches = "G20" in each.shows
        tolerance = 0.0005 if post == "linuxcnc" else 0.003 if inches else 0.0015
        found = compare(old, path_of(new, target), tolerance)
        assert found.is_equal, (each.text, new, found.difference and found.difference.reason, found.difference)
        place = rng.choice(list(re.finditer(r"(?<=[XYZUW])-?\d*\.?\d+", re.sub(r"\(.*\)", hide, new))))
        value = float(place[0]) + rng.choice((-1, 1)) * (0.0004 if inches else 0.01)
        changed = f"{new[: place.start()]}{value:.12f}{new[place.end() :]}"
        assert not compare(old, path_of(changed, target), tolerance).is_equal, (place, new)


def hide(comment: re.Match[str]) -> str:
    return " " * len(comment[0])


def path_of(text: str, control: str) -> ToolPath:
    chosen = {**CONTROLS, **PLAIN}[control]
    result = run(parse(text), Request(chosen))
    return follow(result, chosen, Length.MM, ("X", "Y", "Z"))


FANUC = ("fanuc-lathe", "fanuc-mill", "haas-lathe", "haas-mill")


@cache
def of_fanuc() -> list[tuple[str, str, list[Element], int]]:
    """Control, program, path and plane; the path is that of the oracle, all lines and arcs, also without corners."""
    rng, found = Random(17), list[tuple[str, str, list[Element], int]]()
    for number in range(80):
        control = FANUC[number % 4]
        angle, plane = "A" if control == "haas-lathe" else ",A", 18
        if control.endswith("lathe"):
            lines = random_lathe(rng, rng.randint(2, 6), angle, meets=control == "fanuc-lathe")
            machine = Machine(is_lathe=True, angle=angle, meets=control == "fanuc-lathe")
        else:
            plane = rng.choice((17, 18, 19))
            straight = ["line"] if control == "haas-mill" else ["line", "line", "arc"]
            lines = random_mill(rng, [rng.choice(straight) for _ in range(rng.randint(2, 6))], plane)
            machine = Machine(is_lathe=False)
        lines = [line.replace("F0.2", "") for line in lines if "G04" not in line]
        path = whole(lines, machine)
        assert path, lines
        found.append((control, "F100\n" + "\n".join(lines) + "\n", list(path), plane))
    for control, row in EXAMPLES:
        lines = [line for line in row["program"] if re.match(r"(N\d+ )?(G(0[0-3]|1[78]|20) |[XYZ,])", line)]
        lines = [
            line.replace(" M08", "").replace("N5 Y0", "G01 Y0")
            for line in lines
            if not line.startswith(("N80", "G00 Z50.", "G01 Z-6."))
        ]
        # The whole programs begin with a line that is no part of a contour.
        path = drawn_path(row)
        before = {"X16.": 2 + 8j, "X-40": -40 - 10j}.get(lines[0].split()[-2][:4])
        first = [] if before is None else [Element("line", before, path[0].start)]
        plane = 18 if control.endswith("lathe") else 17
        found.append((control, "\n".join(["F100", *lines, ""]), [*first, *path], plane))
    return found


@pytest.mark.interpreter
@pytest.mark.parametrize("post", ["linuxcnc", pytest.param("fanuc", marks=pytest.mark.slow)])
def test_linuxcnc_runs_what_fanuc_and_haas_programs_are_expanded_to(post, tmp_path):
    programs, paths = [], []
    for control, text, path, plane in of_fanuc():
        expansion = contoursolve.expand(text, post=post, control=control)
        new = expansion.text
        assert new is not None, text
        target = contoursolve.expand(text, post="linuxcnc", control=control).summary
        if any(each.text[0] in "UW" for each in target.unfamiliar):
            continue  # a line without a corner stays as it is, and LinuxCNC has no U and W
        new = re.sub(r"G4[12] |D0", "", new) if plane == 19 else new
        mode = "G7 G18" if control.endswith("lathe") else "G8 G17"
        programs.append(new if post == "linuxcnc" else f"{mode} G90 G91.1\n{new}")
        paths.append(("G20" in text, path))
    assert len(programs) > len(of_fanuc()) / 2
    for (is_inch, path), motions in zip(paths, interpret_all(programs, tmp_path), strict=True):
        expected = [(part.start, part.end, part.center, part.turn) for part in path]
        within_mm = 2e-4 if post == "linuxcnc" else (1.5e-4 + 1e-4 if is_inch else 1.5e-3)
        share = 25.4 if is_inch else 1
        scaled = [(a / share, b / share, None if c is None else c / share, turn) for a, b, c, turn in expected]
        assert_path([each for each in motions if each.kind != "traverse"], scaled, within_mm)
