"""LinuxCNC's interpreter, rs274, as the judge of what we write: the path that it makes of a program."""

import os
import re
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from math import atan2, cos, hypot, pi, sin, tau
from pathlib import Path
from tempfile import mkdtemp
from typing import NamedTuple

RS274 = shutil.which("rs274")

_CALL = re.compile(r"\b(STRAIGHT_TRAVERSE|STRAIGHT_FEED|ARC_FEED|SELECT_PLANE|MESSAGE)\((.*)\)")
_AXES = {"XY": (0, 1), "XZ": (2, 0), "YZ": (1, 2)}
_MARK = "(MSG,PROGRAM)\n"
_BETWEEN = f"G40\n{_MARK}G17 G8 G21 G90 G91.1 G94 F100\nG00 X0 Y0 Z0\n{_MARK}"
_TOOLS = "".join(f"T{number} P{number} D0 Z0\n" for number in range(1, 20))


class RefusedError(AssertionError):
    """rs274 does not run the program; the message is its own."""


class Motion(NamedTuple):
    """One canonical call; points in the plane's axes."""

    kind: str  # traverse, line, cw or ccw
    start: complex
    end: complex
    center: complex | None


def interpret(program: str, folder: Path) -> list[Motion]:
    """The motions of a program, without those of no length, in its own units."""
    return _run(program, folder)[0]


def interpret_all(programs: Sequence[str], folder: Path) -> list[list[Motion]]:
    """The motions of each of many programs without an end, run one after the other in one process, which is quicker."""
    return _run("".join(_BETWEEN + program for program in programs) + "G40\nM2\n", folder)[2::2]


def _run(program: str, folder: Path) -> list[list[Motion]]:
    """The motions before the first message, and after each."""
    folder = Path(mkdtemp(dir=folder))  # it keeps a file of variables, and renames it
    file, tools = folder / "program.ngc", folder / "tools.tbl"
    file.write_text(program, encoding="utf-8", newline="")
    tools.write_text(_TOOLS)
    (folder / "program.var").touch()
    assert RS274
    done = subprocess.run(
        [RS274, "-t", str(tools), "-v", str(folder / "program.var"), "-g", str(file)],
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
        env={**os.environ, "HOME": str(folder)},  # its tool table is a file there, which others would share
    )
    said = [line for line in done.stderr.splitlines() if line.strip() and line != "executing"]
    if said or done.returncode:
        reached = program.split(_MARK)[done.stdout.count("MESSAGE(")]
        raise RefusedError("\n".join((*said, reached)))
    place, axes = [0.0, 0.0, 0.0], _AXES["XY"]
    runs: list[list[Motion]] = [[]]
    for name, arguments in _CALL.findall(done.stdout):
        if name == "SELECT_PLANE":
            axes = _AXES[arguments.removeprefix("CANON_PLANE_")]
            continue
        if name == "MESSAGE":
            runs.append([])
            continue
        values = [float(text) for text in arguments.split(",")]
        start, center = complex(place[axes[0]], place[axes[1]]), None
        if name == "ARC_FEED":
            place[axes[0]], place[axes[1]] = values[:2]
            center, kind = complex(*values[2:4]), "ccw" if values[4] > 0 else "cw"
        else:
            place[:], kind = values[:3], "traverse" if name == "STRAIGHT_TRAVERSE" else "line"
        end = complex(place[axes[0]], place[axes[1]])
        if center is not None or end != start:
            runs[-1].append(Motion(kind, start, end, center))
    return runs


def assert_path(motions: Sequence[Motion], elements: Sequence[tuple], within: float) -> None:
    """The motions are these elements (start, end, center or None, turn), each within so many mm along all its way.

    An element may be written as several motions, or, if it is shorter than that, as none.
    """
    rest = list(motions)
    for start, end, center, turn in elements:
        while True:
            if abs(end - (rest[0].start if rest else end)) <= 3 * within and abs(end - start) <= 3 * within:
                break  # too short to be written
            assert rest, f"nothing goes to {end}"
            motion = rest.pop(0)
            assert (motion.center is None) == (center is None), (motion, start, end)
            if center is not None:
                assert motion.kind == turn
                radius = abs(start - center)
                for share in range(9):
                    at = _on_arc(motion, share / 8)
                    assert abs(abs(at - center) - radius) <= 2 * within, (motion, center, radius)
            if abs(motion.end - end) <= within:
                break
            assert center is not None, f"{motion} does not end at {end}"
    assert not rest, f"left over: {rest}"


def _on_arc(motion: Motion, share: float) -> complex:
    """A point of the arc: its radius goes evenly from that of its start to that of its end."""
    assert motion.center is not None
    begin, finish = motion.start - motion.center, motion.end - motion.center
    sign = 1 if motion.kind == "ccw" else -1
    first = atan2(begin.imag, begin.real)
    swept = ((atan2(finish.imag, finish.real) - first) * sign) % tau
    swept = swept if swept > 1e-9 else 2 * pi
    radius = hypot(begin.real, begin.imag) * (1 - share) + hypot(finish.real, finish.imag) * share
    angle = first + sign * swept * share
    return motion.center + radius * complex(cos(angle), sin(angle))


_STOP = "G90 G00 X77777. Y77777. Z77777.\n"
"""What stands in place of an abort, where many programs run in one process."""
_THERE = (77777.0, 38888.5)
"""Also where X is a diameter."""


def interpret_rows(rows: Sequence[tuple[str, Mapping[str, float]]], folder: Path) -> list[tuple[list[Motion], bool]]:
    """The motions of programs at values of their variables, each row in turn, and whether it stops with `(abort, ...)`;
    a program without an end is read once."""
    programs = list(dict.fromkeys(program for program, _ in rows))
    text = ""
    for number, program in enumerate(programs, 1):
        stopping = re.sub(r"\(abort,.*\)\n", f"{_STOP}o{number} return\n", program)
        text += f"o{number} sub\n{stopping}o{number} endsub\n"
    for program, values in rows:
        number = programs.index(program) + 1
        text += _BETWEEN + "".join(f"{name}={value:.6f}\n" for name, value in values.items()) + f"o{number} call\n"
    found = []
    for motions in _run(text + "G40\nM2\n", folder)[2::2]:
        last = motions[-1].end if motions else 0j
        is_stopped = last.real in _THERE and last.imag in _THERE
        found.append((motions[:-1] if is_stopped else motions, is_stopped))
    return found
