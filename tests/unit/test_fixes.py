"""What a fix keeps and what it drops: words beside the contour, and the contour itself; how several are told apart."""

import json
import re
from random import Random

import pytest
from click.testing import CliRunner
from examples import control_of
from test_limits import KINDS

from contoursolve import DIALECTS, Diagnostic, Fix, check, solve
from contoursolve.cli import main
from contoursolve.diagnostics import Applicability

START = "T0101 X40. Z0."  # the tool that is there
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


@pytest.mark.parametrize(
    ("block", "rules", "lines"),
    [
        (f"/{TAPER} M08 S500 T0101 F0.2", "enforce", ["/T0101", "/S500", "/M08", f"/{TAPER} F0.2"]),
        (f"{TAPER} M30 M08 M9", None, ["M08", TAPER, "M9", "M30"]),
    ],
)
def test_words_move_in_the_order_in_which_a_machine_needs_them(block, rules, lines):
    (finding,) = solve(block, start=START, **({"rules": rules} if rules else {})).diagnostics[-1:]
    assert finding.fixes[0].replacement.split("\n") == lines


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


@pytest.mark.parametrize(
    ("control", "text", "line", "written"),
    [
        ("yasnac-lx3", f"G00 {START}\n{TAPER} M08\nG00 X200.\n", 2, f"M08\n{TAPER}"),
        ("nct-99m", "G17 G90 G0 X0 Y0\nG1 Y50 ,C5\nX80 ,R60\nY0 ,C5\nX0\n", 3, "X80 ,R6"),
    ],
)
def test_a_fix_is_in_sarif_line_by_line(control, text, line, written, tmp_path):
    (tmp_path / "part.nc").write_text(text)
    arguments = ["check", str(tmp_path / "part.nc"), "--format", "sarif", "--control", control]
    first = json.loads(CliRunner().invoke(main, arguments).output)["runs"][0]["results"][0]["fixes"][0]
    (change,) = first["artifactChanges"][0]["replacements"]
    assert (change["deletedRegion"]["startLine"], change["insertedContent"]["text"]) == (line, written)


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


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("word", [" M08", " ,A45", " I5", " R-30", " X10", " C2", " Q2", " S100"])
def test_a_fix_that_keeps_the_contour_keeps_every_element(kind, word):
    first, *rest = KINDS[kind](Random(f"{kind}{word}")).split("\n")
    rest[0] += word
    text, control = "\n".join([first, *rest]), control_of(first)
    for rules in ("enforce", "off"):
        for fix in (fix for each in check(text, rules=rules, control=control) for fix in each.fixes):
            old = solve(text, rules="off", depth="verdict", control=control).answers
            if fix.applicability is Applicability.SAFE and old and old[0].contour:
                (new,) = solve(f"{first}\n{fix.replacement}", depth="verdict", control=control).answers
                assert old[0].contour.is_alike(new.contour), fix
                assert old[0].contour.deviation(new.contour) < 1e-3, fix


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


# Several fixes of one finding --------------------------------------------------------------------------------

REJECTED = [
    (name, text)
    for name, dialect in DIALECTS.items()
    for rule in dialect.catalogue
    for text in dict.fromkeys(rule.rejected)
]


def paths(text: str, control: str) -> list[tuple[float, ...]]:
    """The coordinates of all contours of a program, as far as a listing shows them."""
    answers = solve(text, control=control, depth="path").answers
    elements = (each for answer in answers if answer.contour for each in answer.contour.elements)
    return [tuple(round(value, 3) for value in (*each.start, *each.end)) for each in elements]


def outcomes(finding: Diagnostic) -> list[tuple[str, str]]:
    """What is behind the arrow of each fix, and the blocks that it writes."""
    shown = (each.description.partition(" -> ") for each in finding.fixes)
    return [(end, fix.replacement) for (_, arrow, end), fix in zip(shown, finding.fixes, strict=True) if arrow]


@pytest.mark.parametrize(("name", "text"), REJECTED[::4])
def test_fixes_that_make_different_contours_do_not_look_alike(name, text):
    for finding in check(text, control=name):
        told = outcomes(finding)
        for place, (end, block) in enumerate(told):
            for other_end, other in told[:place]:
                if end == other_end and len(block.split("\n")) == len(other.split("\n")) == 1:
                    before = text.split("\n")[: finding.span.line - 1]
                    made = [paths("\n".join([*before, each]), name) for each in (block, other)]
                    assert made[0] == made[1], (text, finding.message, end)


@pytest.mark.parametrize(
    ("block", "ends"),
    [
        ("G111 X100. A180. K-30. B120. C5. P5.", ["corner 1 with radius 5.000 mm", "corner 1 7.071 mm long"]),
        ("G111 X100. A180. K-30. B120. P60. Q5.", ["corner 1 with radius 51.961 mm", "without corner 1"]),
        (
            "G111 X100. A180. K-30. B120. D5. Q5.",
            ["corner 1 7.071 mm long", "corner 1 with radius 5.000 mm", "without corner 1"],
        ),
    ],
)
def test_what_differs_is_shown(block, ends):
    finding = next(each for each in check(block, control="yasnac-lx3", start=START) if each.fixes)
    shown = [end for end, _ in outcomes(finding)]
    assert [end for end in ends if not any(each.endswith(end) for each in shown)] == []
    assert len(shown) == len({*shown})


def test_fixes_that_make_one_contour_show_one_place():
    finding = check("G111 X100. A180. K-30. B120. U60.", control="yasnac-lx3", start=START)[0]
    assert len({re.sub(r".*-> ", "", each.description) for each in finding.fixes}) == 1


@pytest.mark.parametrize(("name", "text"), REJECTED[::4])
def test_a_line_with_a_number_is_an_element_and_a_line_of_the_program_is_called_so(name, text):
    # Far down in its program, no line of it has the number of an element.
    shifted = "\n" * 40 + text
    result = solve(shifted, control=name, depth="path")
    told = [
        each
        for finding in result.diagnostics
        for each in (finding.message, finding.help, *finding.notes, *(fix.description for fix in finding.fixes))
    ]
    lines = {
        int(number)
        for each in told
        for number in re.findall(r"(?<!program )\b[Ll]ines? (\d+)", each.replace("G-code", ""))
    }
    # The line 99 that a fact states is no line of any program, nor an element.
    assert not [each for each in lines if each > 40 and each != 99], told
