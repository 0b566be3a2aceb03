"""Klartext programs expanded: chains as L, CC and C, and whole programs in G codes."""

import re
from random import Random

import pytest
from calling import call
from examples_heidenhain import PROGRAMS
from interpreter import assert_path
from klartext import random_program, walk

import contoursolve

CAM = PROGRAMS["g6"]
WRITTEN = {
    "8": "8 L X+8.682 Y+49.24",
    "9": "9 CC X+23.4546 Y+46.6357\nC X+28.253 Y+60.848 DR-",
    "10": "10 L X+84.559 Y+41.837",
    "11": "11 CC X+82 Y+34.2573\nC X+90 Y+34.257 DR-",
    "12": "12 L X+90 Y+5",
    "13": "13 L X+85 Y+0",
    "14": "14 L X+0 Y+0",
}


def in_place_of(text: str, **options: object) -> list[str]:
    """What stands between the first and the last block of a program of which everything is said, without comments."""
    expansion = contoursolve.expand(text, comments=False, **options)
    assert expansion.text is not None, expansion.summary.left
    return expansion.text.splitlines()


def chain(*blocks: str, before: str = "L X+0 Y+0 F200", unit: str = "MM") -> str:
    lines = (f"BEGIN PGM A {unit}", before, *blocks, f"END PGM A {unit}")
    return "".join(f"{number} {line}\n" for number, line in enumerate(lines))


# --- Klartext ---


def test_a_chain_is_written_in_plain_klartext_with_its_blocks_as_comments():
    lines = []
    for line in CAM.splitlines():
        number = line.split()[0]
        lines += [f";{line}", WRITTEN[number]] if number in WRITTEN else [line]
    assert contoursolve.expand(CAM).text == "\n".join(lines) + "\n"


@pytest.mark.parametrize("comments", [True, False])
def test_what_is_written_is_not_expanded_again(comments):
    once = contoursolve.expand(CAM, comments=comments).text
    again = contoursolve.expand(once)
    assert again.text == once
    assert again.summary.replaced == 0
    assert all(each.code == "no-contour" for each in contoursolve.solve(once).diagnostics)


def test_words_beside_a_contour_go_to_the_block_that_moves():
    text = chain("FL X+50 Y+0 RL F300 M8", "FC DR+ CCX+50 CCY+20 CCA+0 M5 ; UP", "FL X+70 Y+60 FMAX")
    assert in_place_of(text)[2:5] == ["2 L X+50 Y+0 RL F300 M8", "3 CC X+50 Y+20 ; UP", "C X+70 Y+20 DR+ M5"]
    assert in_place_of(text)[5] == "4 L X+70 Y+60 FMAX"


def test_a_long_arc_is_written_as_two_and_both_are_in_rapid_if_it_is():
    text = chain("FC DR+ CCX+0 CCY+20 CCA-100 FMAX", "FL X+50 Y+50")
    assert in_place_of(text)[2:6] == [
        "2 CC X+0 Y+20", "C X+1.743 Y+39.924 DR+ FMAX", "CC X+0 Y+20.0001", "C X-3.473 Y+0.304 DR+ FMAX",
    ]  # fmt: skip


def test_the_feed_of_a_rounding_ends_with_it():
    text = chain("FL X+50 Y+0", "RND R5 F50", "FL X+50 Y+50")
    assert in_place_of(text)[2:6] == ["2 L X+45 Y+0", "3 CC X+45 Y+5", "C X+50 Y+5 DR+ F50", "4 L X+50 Y+50 F200"]
    text = chain("FL X+50 Y+0", "RND R5 F50", "FL X+50 Y+50 FMAX", "L X+0")
    assert in_place_of(text)[5:8] == ["4 L X+50 Y+50 FMAX", "L F200", "5 L X+0"]
    lines = in_place_of(text.replace("5 L", "M8\n/L Y+0\n5 L"), post="linuxcnc")
    assert lines[5:9] == ["N4 G00 X50 Y50", "M8", "/G01 Y0 F200", "N5 G01 X0 F200"]


def test_a_centre_that_was_in_force_is_in_force_behind_the_contour():
    text = chain("CC X+10 Y-5", "FL X+50 Y+0", "RND R5", "FL X+50 Y+50", "CP IPA+90 DR+")
    assert in_place_of(text)[6:8] == ["5 L X+50 Y+50", "CC X+10 Y-5"]


def test_a_move_of_the_tool_axis_between_free_elements_stays():
    text = chain("FL AN+0 LEN50", "L IZ-5 F80 ; DOWN", "L IZ-1", "FL X+90 Y+20", before="L X+0 Y+0 Z+0 F200")
    assert in_place_of(text)[3:5] == ["3 L IZ-5 F80 ; DOWN", "4 L IZ-1"]
    assert in_place_of(text, post="linuxcnc")[4:6] == ["N3 G01 Z-5 F80 (DOWN)", "N4 G01 Z-6"]


@pytest.mark.parametrize(("word", "is_written"), [("Z-5", True), ("IZ-5", False)])
def test_a_single_free_line_may_move_the_tool_axis(word, is_written):
    text = chain(f"FL X+50 Y+0 {word}", before="L X+0 Y+0 Z+0 F200")
    assert in_place_of(text)[2] == f"2 L X+50 Y+0 {word}"
    found = contoursolve.expand(text, post="linuxcnc", comments=False)
    assert (found.text is not None) is is_written
    if is_written:
        assert "N2 G01 X50 Y0 Z-5\n" in found.text


def test_numbers_for_every_line_are_those_that_are_free():
    written = contoursolve.expand(CAM, block_numbers="all", comments=False).text.splitlines()
    assert [line.split()[0] for line in written[8:12]] == ["8", "9", "18", "10"]
    assert all(re.match(r"\d+ \D", line) for line in written)


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


def test_a_word_without_g_codes_is_told_and_the_block_moves():
    expansion = contoursolve.expand(chain("L X+5 M25"), post="linuxcnc", comments=False, keep_going=True)
    assert expansion.text.splitlines()[3:5] == [
        "(NOT EXPANDED: M25 has no counterpart here: write by hand what it does)", "N2 G01 X5",
    ]  # fmt: skip
    assert [left.lines for left in expansion.summary.left] == [(3,)]


def test_corners_between_conventional_moves_are_written_out():
    text = chain("L X+50", "RND R5", "L Y+50", "CHF 2", "L X+0", "CT X+0 Y+20", "L X+30 Y+20")
    assert in_place_of(text, post="linuxcnc")[3:-1] == [
        "N2 G01 X45 Y0", "N3 G03 X50 Y5 I0 J5", "N4 G01 X50 Y48", "N5 G01 X48 Y50", "N6 G01 X0 Y50",
        "N7 G03 X0 Y20 I0 J-15", "N8 G01 X30 Y20",
    ]  # fmt: skip


def test_what_a_block_that_is_not_written_puts_in_force_is_said_in_the_next_that_moves():
    text = chain("APPR LT X+10 Y+20 LEN15 RL F250", "M8", "FL X+50 AN+0", "FL X+50 Y+50", "DEP LT LEN5", "L X+90")
    lines = contoursolve.expand(text, post="linuxcnc", comments=False, keep_going=True).text.splitlines()
    assert lines[5:8] == ["N3 G41 M8", "N4 G01 X50 Y20 F250", "N5 G01 X50 Y50"]
    assert lines[10] == "N7 G40 G01 X90"


def test_parameters_that_are_known_are_written_as_numbers():
    text = chain("Q1 = 20 + 5", "L X+Q1 Y-Q1")
    assert in_place_of(text, post="linuxcnc")[-2] == "N3 G01 X25 Y-25"


@pytest.mark.parametrize(("post", "opening"), [("linuxcnc", "G8 G17 G20 G90 G91.1"), ("fanuc", "G17 G20 G90 G94")])
def test_a_program_in_inches(post, opening):
    lines = in_place_of(chain("FL X+1.5 Y+0", "RND R.25", "FL X+1.5 Y+1", unit="INCH"), post=post)
    assert lines[0] == opening
    assert lines[2].startswith("N1 G01 X0")
    assert "F20" in lines[2]  # Tenths of an inch.
    assert lines[3].startswith("N2 G01 X1.25 Y0")


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


def test_convert_writes_contours_out_and_follows_both_paths():
    helix = chain("L Z+0", "CC X+10 Y+0", "CP IPA+810 IZ-9 DR+", "L X+5 A+30")
    assert contoursolve.convert(helix, "fanuc-mill").text is None
    found = contoursolve.convert(helix.replace(" A+30", ""), "fanuc-mill", comments=False)
    assert found.comparison.is_equal
    found = contoursolve.convert(CAM, "fanuc-mill", comments=False)
    assert found.text.splitlines()[9] == "N8 G01 X8.682 Y49.24"
    assert (found.summary.in_words, found.summary.written_out) == (0, [9])


def test_blocks_in_a_row_with_one_reason_are_one_entry():
    text = chain("L X+5 M25", "L X+6 M25", "L X+7", "L X+8 M25", "L X+9 M25", "L X+7 M25", "L X+4 M27")
    expansion = contoursolve.expand(text, post="linuxcnc", comments=False, keep_going=True)
    assert [left.lines for left in expansion.summary.left] == [(3, 4), (6, 7, 8), (9,)]
    assert expansion.text.count("(NOT EXPANDED: M2") == 3
