"""What a program means before its geometry begins: starts and paths are those of small reference interpreters, or are
said to be unknown; and what is written anew moves as before."""

import re
from itertools import groupby

import numpy as np
import pytest
from click.testing import CliRunner
from drawn_meanings import drawn
from meaning_path import CONTROLS, Hard, Open, path_of, runs
from program_meaning import PRODUCT, judged
from reference_interpreter import AXES, Move, Stopped, is_known

from contoursolve import convert, expand
from contoursolve.cli import main

EACH = 5
"""Programs of a case."""

AS_WRITTEN = 0.002
"""mm by which two paths may differ that are written to 0.001."""

SHOWN = {
    # The start of the only contour and its first corner, as the manuals read these programs, in our own numbers.
    "a formal parameter is a variable of its own": (
        "DEF REAL AA=15|G0 X0 Y0|SUB5(20)|G1 X=AA RND=2|Y20|M30|PROC SUB5(REAL AA)|AA=AA+10|RET",
        (0, 15),
    ),
    "DEF in a subprogram is known there alone": (
        "DEF REAL AA=15|G0 X0 Y0|SUB6|G1 X=AA RND=2|Y20|M30|PROC SUB6|DEF REAL AA|AA=40|RET",
        (0, 15),
    ),
    "VAR is by reference, through two levels": (
        (
            "DEF REAL ZZ=15|G0 X0 Y0|SUB7(ZZ)|G1 X=ZZ RND=2|Y20|M30|PROC SUB7(VAR REAL AA)|SUB8(AA)|RET|"
            "PROC SUB8(VAR REAL BB)|BB=BB+15|RET"
        ),
        (0, 30),
    ),
    "INT rounds": ("DEF INT ZZ=22.6|G0 X0 Y0|G1 X=ZZ RND=2|Y20|M30", (0, 23)),
    "SAVE brings back G90": (
        "G0 X0 Y0|SUB9(3)|G1 X20 RND=2|Y20|M30|PROC SUB9(REAL AA) SAVE DISPLOF|G91 G0 X=AA|RET",
        (3, 20),
    ),
    "SAVE brings back mm": (
        "G0 X0 Y0|SUB1(1)|G1 X30 RND=2|Y20|M30|PROC SUB1(REAL AA) SAVE|G70|G0 X=AA|RET",
        (25.4, 30),
    ),
    "SAVE brings back the frame": (
        "G0 X0 Y0|SUB1(5)|G1 X20 RND=2|Y20|M30|PROC SUB1(REAL AA) SAVE|TRANS X=AA|G0 X0 Y0|RET",
        (5, 20),
    ),
    "a number shifts": ("TRANS X0|G0 X0 Y0|G59 X10|G1 X20 RND=2|Y20|M30", (-10, 20)),
}


@pytest.mark.parametrize("name", SHOWN)
def test_the_interpreter_reads_what_the_manuals_show(name):
    shown, (start, corner) = SHOWN[name]
    text = "G17 G71 G90 G54\n" + shown.replace("|", "\n")
    (moves,) = runs(text, "siemens-840d")
    path = path_of(moves[-2:])
    assert path.start == pytest.approx(start)
    assert path.elements[0][0].real == pytest.approx(corner - 2)
    assert [each.kind for each in judged(text, "siemens-840d")] == ["same"]


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("case", range(16))
def test_a_start_and_a_path_are_the_interpreters_or_unknown_with_a_line(case, control):
    for seed in range(case * EACH, case * EACH + EACH):
        text = drawn(str(seed), control)
        for each in judged(text, control):
            assert each.kind in ("same", "unknown", "refused", "hard"), (seed, each, text)


def alike_zero(one: Move, other: Move) -> bool:
    """Whether both count from the same point."""
    return (one.zero[0] == other.zero[0]).all() and np.allclose(one.zero[1], other.zero[1], rtol=0, atol=1e-7)


def trace(text: str, control: str, *, is_in_one: bool = False) -> list[tuple[complex | None, complex | None]]:
    """The ends of all moves of the only way of a program, and the centres of arcs: None where something of it is not
    known. Each is in its own coordinates, or all are in those of the first move."""
    (moves,), found = runs(text, control), []
    first = moves[0].zero if moves else None
    while moves:
        count = 1
        while moves[count - 1].corner is not None and count < len(moves):
            count += 1
        chain, moves = moves[:count], moves[count:]
        path, begin = path_of(chain), len(found)
        if any(not alike_zero(each, chain[0]) for each in chain):
            # In whose coordinates such a path would be is not stated.
            raise Hard
        if isinstance(path, Open):
            if len(chain) > 1:
                # Its corners are made where all of it is increments, and else left as they are.
                raise Hard
            for each in chain:
                end = each.seen(each.end, each.zero)
                found.append((complex(*end[:, 0]) if is_known(end) else None, None))
        elif path is None:
            raise Hard
        else:
            found += path.elements
        if is_in_one:
            turn, origin = chain[0].zero
            away = (origin - first[1])[[*map(AXES.index, chain[0].axes)]]
            if not np.allclose(turn, first[0]) or not is_known(away):
                raise Hard
            off = complex(*away[:, 0])
            found[begin:] = [tuple(at if at is None else at + off for at in each) for each in found[begin:]]
    return found


def from_first(path: list[tuple[complex | None, complex | None]]) -> list[tuple[complex | None, complex | None]]:
    """A path, counted from the first place that is known."""
    first = next((end for end, _ in path if end is not None), 0)
    return [tuple(at if at is None else at - first for at in each) for each in path]


TWINS = {"fanuc-mill": "haas-mill", "fanuc-lathe": "haas-lathe", "siemens-840d": "isg", "siemens-turning": "isg"}
"""Controls of almost the same words."""

AS_HERE = {
    # Its angles have no comma; an argument of G65 never has one.
    "fanuc": (r"(?m)^((?!.*G65).*) A(?=[-\d])", r"\1 ,A"),
    "siemens": (
        r"#(?=[A-Z])|\bG(51|52|92)\b",
        lambda found: {None: "", "51": "DIAMON", "52": "DIAMOF", "92": "G58"}[found[1]],
    ),
}
"""How words of a twin are spelled here."""

FRAMES = re.compile(r"TRANS|ROT|SCALE|MIRROR|SUPA|\$P_|G5(?:[389]|\d\d)|G153")
"""What no twin has."""


def anew(seed: int, control: str, write, *, is_in_one: bool = False) -> bool | None:
    """Whether a drawn program is written anew, with the path that it had; None for one whose path is not known. Where
    shifts may be worked into the coordinates, all are those of the first move."""
    text = drawn(str(seed), control)
    try:
        before = trace(text, control, is_in_one=is_in_one)
    except (Hard, Stopped, ValueError):
        return None
    written = write(text)
    if written is None:
        return False
    after = trace(written, control, is_in_one=is_in_one)
    assert len(before) == len(after), (seed, text, written)
    if is_in_one:
        before, after = map(from_first, (before, after))
    for one, other in zip(before, after, strict=True):
        for a, b in zip(one, other, strict=True):
            assert (a is None) is (b is None), (seed, one, other, text, written)
            assert a is None or abs(a - b) <= AS_WRITTEN, (seed, one, other, text, written)
    return True


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("inline", [False, True])
@pytest.mark.parametrize("case", range(6))
def test_what_is_written_anew_moves_as_before(case, inline, control):
    def write(text: str) -> str | None:
        own = PRODUCT.get(control, control)
        return expand(text, control=own, comments=False, keep_going=True, inline=inline).text

    for seed in range(1000 + case * EACH, 1000 + case * EACH + EACH):
        anew(seed, control, write)


@pytest.mark.parametrize("control", CONTROLS)
def test_what_is_written_for_the_twin_moves_as_before(control):
    framed = list[str]()

    def write(text: str) -> str | None:
        found = convert(text, TWINS[control], control=PRODUCT.get(control, control), comments=False)
        assert found.text is not None, text
        if found.not_converted:
            framed.extend(each.text for each in found.not_converted[:1] if FRAMES.search(text))
            return None
        return re.sub(*AS_HERE[control.partition("-")[0]], found.text)

    is_in_one = control.startswith("siemens")
    told = [anew(seed, control, write, is_in_one=is_in_one) for seed in range(1000, 1000 + 6 * EACH)]
    assert told.count(True) >= told.count(False) - len(framed), (told.count(True), told.count(False), framed)
    assert told.count(True) >= 2


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("case", range(4))
def test_a_tool_path_is_known_where_the_program_is(case, control, tmp_path):
    for seed in range(2000 + case * EACH, 2000 + case * EACH + EACH):
        drawn_text, file = drawn(str(seed), control), tmp_path / f"{seed}.txt"
        # The last contour of the main program is cut with compensation.
        first, last = drawn_text.split("M30\n", 1)
        begin, mark, contour = first.rpartition("G01 " if control.startswith("fanuc") else "G1 ")
        away = "X200. Z200." if "turning" in control or "lathe" in control else "X200. Y200."
        text = f"{begin}G42 {mark}{contour}G40 G00 {away}\nM30\n{last}"
        file.write_text(text)
        tool = ["--tool", "R0.1", *(["--tip", "3"] if control in ("fanuc-lathe", "siemens-turning") else [])]
        options = ["--control", PRODUCT.get(control, control), "--inline", "--keep-going", "--no-comments"]
        written = CliRunner().invoke(main, ["expand", str(file), *tool, *options]).stdout
        try:
            before = [each is None for each, _ in trace(text, control)]
            after = [each is None for each, _ in trace(written, control)] if written else before
        except (Hard, Stopped, ValueError):
            continue
        assert [known for known, _ in groupby(before)] == [known for known, _ in groupby(after)], (seed, text, written)
