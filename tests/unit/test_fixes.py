"""What a fix keeps and what it drops: words beside the contour, and the contour itself."""

import json
from random import Random

import pytest
from click.testing import CliRunner
from examples import control_of
from test_limits import KINDS

from contoursolve import solve
from contoursolve.cli import main
from contoursolve.diagnosis.edits import ERRANDS, InsertionSide
from contoursolve.diagnostics.finding import Applicability, Fix
from contoursolve.diagnostics.source import Evidence
from contoursolve.notebook.exploration import apply_fix, begin
from contoursolve.solving.contour import ArcSegment

START = "X40. Z0."
TAPER = "G111 X100. A180. K-30. B120."
MOVED = {
    "T0101": ("tool", "before"),
    "S500": ("spindle speed", "before"),
    "M3": ("spindle on", "before"),
    "M08": ("coolant on", "before"),
    "M09": ("coolant off", "after"),
    "M05": ("spindle off", "after"),
    "M00": ("stop", "after"),
    "M1": ("stop", "after"),
    "M30": ("end of program", "after"),
    "M41": ("machine function", "before"),
}


@pytest.mark.parametrize("word", MOVED)
@pytest.mark.parametrize("block", [TAPER + " {}", "N10 G111 X100. {} A180. K-30. B120. (TAPER)"])
def test_a_word_beside_the_contour_moves_into_a_block_of_its_own(word, block):
    meaning, side = MOVED[word]
    (finding,) = solve(block.format(word), start=START).diagnostics
    moved, deleted = finding.fixes
    rest = block.replace(" {}", "")
    assert moved.description.startswith(f"move {word} ({meaning}) into a block of its own {side} this one -> ")
    assert moved.replacement == "\n".join([word, rest] if side == "before" else [rest, word])
    assert moved.applicability is Applicability.SAFE
    assert deleted.description.startswith(f"delete {word} ({meaning}) -> ")
    assert (deleted.replacement, deleted.applicability) == (rest, Applicability.CHANGES_CONTOUR)
    assert deleted.effect == f"drops {word}"
    again = solve(moved.replacement, start=START)
    assert (again.diagnostics, again.answers[0].contour) == ((), solve(rest, start=START).answers[0].contour)


def test_several_words_move_in_the_order_in_which_a_machine_needs_them():
    (finding,) = solve(f"/{TAPER} M08 S500 T0101 F0.2", start=START, rules="enforce").diagnostics[-1:]
    fix = finding.fixes[0]
    assert fix.replacement.split("\n") == ["/T0101", "/S500", "/M08", f"/{TAPER} F0.2"]
    assert {row.side for row in ERRANDS} == {*InsertionSide, None}
    assert {row.source.evidence for row in ERRANDS} == {Evidence.ASSUMED}


def test_all_words_of_one_letter_move():
    (finding,) = solve(f"{TAPER} M30 M08 M9", start=START).diagnostics
    assert finding.fixes[0].replacement.split("\n") == ["M08", TAPER, "M9", "M30"]


def test_a_feed_that_a_fix_drops_is_named_and_the_fix_is_not_automatic():
    (finding,) = solve(f"{TAPER} F0.2 F0.3", start=START).diagnostics
    assert finding.fixes[0].description.startswith("delete F0.3 (feed) -> ")
    assert all(fix.applicability is not Applicability.SAFE for fix in finding.fixes)


def test_a_fix_names_its_program_line_where_another_has_the_same_word():
    lines = ("G17 G90 G0 X0 Y0", "G1 X72.505 Y33.809 ,R10", "X64.053 Y51.935 ,R10", "X-8.452 Y18.126")
    (finding,) = solve("\n".join(lines), control="nct-99m").diagnostics
    told = [fix.description.partition(" -> ")[0] for fix in finding.fixes]
    assert told[:2] == [f"write ,R9.999 for ,R10 in program line {line}" for line in (3, 2)]
    assert len({*told}) == len(told)
    assert "delete Y33.809" in told


def test_every_output_takes_a_fix_of_several_lines(tmp_path):
    program = tmp_path / "moved.nc"
    program.write_text(f"G00 {START}\n{TAPER} M08\nG00 X200.\n")
    run = CliRunner().invoke
    lines = ["M08", TAPER]
    data = json.loads(run(main, ["solve", str(program), "--format", "json"]).output)
    assert data["diagnostics"][0]["fixes"][0]["replacement"].split("\n") == lines
    sarif = json.loads(run(main, ["check", str(program), "--format", "sarif"]).output)
    (change,) = sarif["runs"][0]["results"][0]["fixes"][0]["artifactChanges"][0]["replacements"]
    assert (change["deletedRegion"]["startLine"], change["insertedContent"]["text"].split("\n")) == (2, lines)
    text = run(main, ["check", str(program)]).output
    assert "fix [same contour]: move M08 (coolant on) into a block of its own before this one" in text
    assert "fix [drops M08]: delete M08 (coolant on)" in text
    assert "\n".join(f"      {line}" for line in lines) in text
    exploration = begin(program.read_text())
    fixed = apply_fix(exploration, 0, 0)
    assert fixed.text.split("\n")[:4] == [f"G00 {START}", *lines, "G00 X200."]
    assert not fixed.result.has_errors


def test_a_fix_of_a_chain_is_in_sarif_line_by_line(tmp_path):
    program = tmp_path / "pocket.nc"
    program.write_text("G17 G90 G0 X0 Y0\nG1 Y50 ,C5\nX80 ,R60\nY0 ,C5\nX0\n")
    sarif = json.loads(
        CliRunner().invoke(main, ["check", str(program), "--format", "sarif", "--control", "nct-99m"]).output
    )
    first = sarif["runs"][0]["results"][0]["fixes"][0]
    (change,) = first["artifactChanges"][0]["replacements"]
    assert (change["deletedRegion"]["startLine"], change["insertedContent"]["text"]) == (3, "X80 ,R6")


@pytest.mark.parametrize(
    ("new", "wanted"),
    [
        ("a\nc", ["a", "", "c"]),
        ("b\nc", ["", "b", "c"]),
        ("a\nb", ["a", "b", ""]),
        ("a\nB", ["a", "B", ""]),
        ("a\nb\nn\nc", ["a", "b", "n\nc"]),
        ("n\na\nb\nc", ["n\na", "b", "c"]),
        ("a\nB\nc", ["a", "B", "c"]),
    ],
)
def test_lines_that_a_fix_drops_or_adds_leave_the_others_where_they_are(new, wanted):
    fix = Fix("", new, Applicability.CHANGES_CONTOUR, replaced="a\nb\nc")
    assert fix.by_line((3, 4, 6)) == dict(zip((3, 4, 6), wanted, strict=True))


def test_contours_are_the_same_if_every_element_is_not_if_the_named_points_and_the_end_are():
    sharp = "G111 A180. K-30. B120. X100. {}"
    bevel, fillet, other = (solve(sharp.format(word), start=START).answers[0].contour for word in ("C2.", "P2.", "P3."))
    assert bevel.points == fillet.points == other.points
    assert len(bevel.elements) == len(fillet.elements)
    assert not bevel.is_alike(fillet)
    assert fillet.is_alike(other)
    assert fillet.deviation(fillet) == 0
    # The radius differs by 1 mm, the centre by 1 / cos 30 deg.
    assert fillet.deviation(other) == pytest.approx(2 / 3**0.5)
    short, long = (f"G17 G90 G0 X0 Y0\nG1 X10 ,R1\nG2 X10 Y10 R{sign}8" for sign in ("", "-"))
    one, two = (solve(text, control="nct-99m").answers[0].contour for text in (short, long))
    assert one.end == two.end
    assert not one.is_alike(two)


def path(contour):
    """Every number of the elements of a path."""
    return [
        (each.start, each.end, *((each.center, each.radius, each.turn) if isinstance(each, ArcSegment) else ()))
        for each in contour.elements
    ]


@pytest.mark.slow
def test_a_fix_that_keeps_the_contour_keeps_every_element():
    rng, kept = Random(8), 0
    for kind in KINDS:
        for _ in range(5):
            first, *rest = KINDS[kind](rng).split("\n")
            rest[0] += rng.choice((" M08", " ,A45", " I5", " R-30", " X10", " C2", " Q2", " S100"))
            for rules in ("enforce", "off"):
                try:
                    result = solve("\n".join([first, *rest]), rules=rules, control=control_of(first))
                except ValueError:
                    continue
                old = solve("\n".join([first, *rest]), rules="off", depth="verdict", control=control_of(first)).answers
                for fix in (each for finding in result.diagnostics for each in finding.fixes):
                    if fix.applicability is Applicability.SAFE and old and old[0].contour:
                        mended = "\n".join([first, fix.replacement])
                        new = solve(mended, depth="verdict", control=control_of(first)).answers[0].contour
                        kept += 1
                        for one, other in zip(path(old[0].contour), path(new), strict=True):
                            assert len(one) == len(other), (first, rest, fix)
                            numbers = zip(one, other, strict=True)
                            assert all(a == pytest.approx(b, abs=1e-3) if a != b else True for a, b in numbers)
    assert kept > 5


def test_a_corner_that_misses_by_rounding_gets_the_last_digit_first():
    """The round end of a slot at 25 degrees: its width is 20 mm, its corners are rounded to 0.001 mm."""
    text = "G17 G90 G0 X0 Y0\nG1 X72.505 Y33.809 ,R10\nX64.053 Y51.935 ,R10\nX-8.452 Y18.126"
    (finding,) = solve(text, control="nct-99m").diagnostics
    assert finding.fixes[0].description.startswith("write ,R9.999 for ,R10")
    assert "X-72.505" not in finding.fixes[1].description


def test_q_is_the_fix_where_a_line_and_a_circle_only_touch():
    text = "G17 G90 G0 X-50 Y50\nG1 G41 D1 X-20 Y50\nG1 ,A0\nG3 X50 Y0 I0 J0 R50"
    (finding,) = solve(text, control="nct-99m").diagnostics
    assert finding.code == "nct-q-missing"
    assert [fix.description.partition(" ->")[0] for fix in finding.fixes] == [
        "add Q-1 to program line 4",
        "add Q1 to program line 4",
    ]


@pytest.mark.parametrize("text", ["G00 X4O. Z0.\nG111 A180. K-30. B120. X100.", "G00 X4l.\nG111 W0. A180. I5. B120."])
def test_a_coordinate_that_is_read_in_part_leaves_the_position_unknown(text):
    codes = [each.code for each in solve(text, control="yasnac-lx3").diagnostics]
    assert codes[-1] == "position-unknown"
    assert "start-in-increments" not in codes
