"""Klartext programs expanded: chains as L, CC and C, and whole programs in G codes."""

from random import Random

import pytest
from calling import call
from examples_heidenhain import PROGRAMS
from interpreter import assert_path
from klartext import random_program, walk

import contoursolve

CAM = PROGRAMS["g6"]


def chain(*blocks: str, before: str = "L X+0 Y+0 F200", unit: str = "MM") -> str:
    lines = (f"BEGIN PGM A {unit}", before, *blocks, f"END PGM A {unit}")
    return "".join(f"{number} {line}\n" for number, line in enumerate(lines))


# --- Klartext ---


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_everything_outside_stays_byte_for_byte(tmp_path, end):
    blocks = ["\t(OLD", "0  BEGIN PGM  A MM ", "* - \xe4", "1 L X+0  Y+0 ;; \xe4", "2 FL X+50 Y+0", " ; inside", "",
              "3 CYCL DEF 7.0", "4 L IX+Q1 R0 FMAX", "5 END PGM A MM"]  # fmt: skip
    old, new = tmp_path / "old.h", tmp_path / "new.h"
    old.write_bytes(end.join(blocks).encode("latin-1"))
    done = call("expand", "--no-comments", old, "-o", new)
    assert done.exit_code == 0, done.output
    blocks[4] = "2 L X+50 Y+0"
    assert new.read_bytes() == end.join(blocks).encode("latin-1")


def test_what_fails_is_told_and_nothing_is_written(tmp_path):
    program = tmp_path / "open.h"
    program.write_text(chain("FL AN+60", "L X+50 Y+0"))
    for post in ("same", "linuxcnc"):
        done = call("expand", "--post", post, str(program))
        assert done.exit_code == 1
        assert "heidenhain-block-illegal" in done.stderr
        assert done.stdout == ""


# --- G codes ---


BLOCKS = {
    "L X+5,5 Y-3 FMAX": "G00 X5.5 Y-3",
    "X50 Z+2 F AUTO M3": "",
    "Z+2 F500 M13": "G01 Z2 F500 M3 M8",
    "L IX+10 IY-2.5 F100": "G01 X20 Y17.5 F100",
    "L X+1 A+30 C-15.5": "G01 X1 A30 C-15.5",
    "LP PR+10 PA+90": "G01 X0 Y10",
    "LP IPA+90 FMAX": "G00 X-20 Y10",
    "C X+20 Y-10 DR-": "G02 X20 Y-10 I-10 J-20",
    "C X+10 Y+20 DR+": "G03 X-10 Y-20 I-10 J-20 / G03 X10 Y20 I10 J20",
    "CP PA+0 DR-": "G02 X22.3607 Y0 I-10 J-20",
    "CP IPA+90 IZ-4 DR+": "G03 X-20 Y10 I-10 J-20 Z1",
    "CR X+20 Y+30 R+10 DR+": "G03 X20 Y30 I0 J10",
    "CR X+20 Y+30 R-10 DR+": "G03 X20 Y30 I10 J0",
    "L RL F100": "G41 F100",
    "STOP M9": "M0 M9",
    "M30": "M30",
}


@pytest.mark.parametrize(("block", "written"), BLOCKS.items())
def test_a_conventional_block_in_g_codes(block, written):
    before = "BEGIN PGM A MM\nL X+10 Y+20 Z+5 F200\nCC X+0 Y+0\n"
    expansion = contoursolve.expand(before + block + "\n", post="linuxcnc", comments=False, keep_going=True)
    lines = expansion.text.splitlines()[4:]
    assert bool(expansion.summary.left) is not bool(written)
    assert not written or " / ".join(lines) == written


@pytest.mark.parametrize(
    ("block", "told"),
    [
        ("CYCL DEF 200 DRILLING ~", "CYCL DEF"),
        ("APPR LT X+2 Y+1 LEN1 RL", "APPR LT"),
        ("DEP LT LEN5", "DEP LT"),
        ("FN 18: SYSREAD Q5 = ID20 NR3", "FN"),
        ("L X+Q5", "X+Q5"),
        ("L X+5 M99", "M99"),
        ("TOOL CALL 5 Z S100 DL+0.1", "TOOL CALL"),
        ("TOOL CALL 5 X S100", "tool axis"),
        ("CT X+5 Y+9", "CT"),
        ("RND R5", "RND"),
        ("C X+5 Y+5 DR+", "position"),
        ("L X5..5", "cannot be read"),
        ("L IA+5", "IA"),
    ],
)
def test_what_has_no_g_codes_is_a_comment_and_told(tmp_path, block, told):
    program = tmp_path / "old.h"
    program.write_text(f"0 BEGIN PGM A MM\n1 {block}\n2 END PGM A MM\n")
    arguments = ["expand", "--post", "linuxcnc", str(program)]
    done = call(*arguments)
    assert (done.exit_code, done.stdout) == (1, "")
    assert told in done.stderr
    done = call(*arguments, "--keep-going")
    assert done.exit_code == 1
    remark, kept = done.stdout.splitlines()[2:4]
    assert remark.startswith("(NOT EXPANDED: ")
    assert told in remark
    assert kept == f"(1 {block})"


# --- The same path ---


@pytest.mark.parametrize("post", ["same", "linuxcnc"])
@pytest.mark.parametrize("share", [1.0, 0.5, 0.0])
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("arcs", ["center", "radius"])
def test_an_expanded_program_runs_where_it_was_drawn(tmp_path, post, share, seed, arcs):
    """By diff, and by a reader of plain Klartext that knows no free contours."""
    drawn = random_program(Random(seed), share)
    expansion = contoursolve.expand(drawn.text, post=post, arcs=arcs)
    (tmp_path / "old.h").write_text(drawn.text)
    (tmp_path / "new.nc").write_text(expansion.text)
    control = ["--new-control", "linuxcnc"] if post == "linuxcnc" else []
    done = call("diff", "--tolerance", "0.002", *control, tmp_path / "old.h", tmp_path / "new.nc")
    assert done.exit_code == 0, done.output
    if (post, share) == ("same", 1.0):
        assert_path([each for each in walk(expansion.text) if each.kind != "traverse"], drawn.path, 0.001)


def test_convert_writes_contours_out_and_says_what_it_leaves():
    helix = chain("L Z+0", "CC X+10 Y+0", "CP IPA+810 IZ-9 DR+", "L X+5 A+30")
    assert "\n(NOT CONVERTED - L X+5 A+30)\n" in contoursolve.convert(helix, "fanuc-mill").text
    found = contoursolve.convert(helix.replace(" A+30", ""), "fanuc-mill", comments=False)
    assert found.comparison.is_equal
    found = contoursolve.convert(CAM, "fanuc-mill", comments=False)
    assert found.text.splitlines()[10] == "X8.682 Y49.24"
    assert (found.summary.in_words, found.summary.written_out) == (1, [])


def test_blocks_in_a_row_with_one_reason_are_one_entry():
    text = chain("L X+5 M25", "L X+6 M25", "L X+7", "L X+8 M25", "L X+9 M25", "L X+7 M25", "L X+4 M27")
    expansion = contoursolve.expand(text, post="linuxcnc", comments=False, keep_going=True)
    assert [left.lines for left in expansion.summary.left] == [(3, 4), (6, 7, 8), (9,)]
    assert expansion.text.count("(NOT EXPANDED: M2") == 3
