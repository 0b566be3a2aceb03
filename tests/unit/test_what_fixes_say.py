"""What is said of fixes: where each edits, which lines beside the contour it changes, and when the contour stays."""

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from contoursolve import solve
from contoursolve.cli import main
from contoursolve.diagnostics import Applicability
from contoursolve.notebook import exploration as explore
from contoursolve.program import changed, changes_of

SLIPS = json.loads((Path(__file__).parents[1] / "slips" / "by_hand.json").read_text())
FUNCTION = ("fanuc-lathe", "G00 X16. Z2.\nG01 Z0. F0.2\nX30. ,C1.5\nZ-25. ,R3.\nM08\nX50. ,A120.\nZ-60.\n", 5)
PLANE = ("fanuc-mill", "G17 G90\nG00 X0. Z0.\nG01 Z40. ,R6. F200\nX30. ,C3.\nZ-10. ,R4.\nX0.\n", 1)
MENDED = {
    FUNCTION: "G00 X16. Z2.\nG01 Z0. F0.2\nM08\nX30. ,C1.5\nZ-25. ,R3.\nX50. ,A120.\nZ-60.\n",
    PLANE: PLANE[1].replace("G17", "G18"),
}


def solved(slip):
    settings = dict(each.split("=", 1) for each in slip["settings"])
    return solve("\n".join(slip["slip"]), control=slip["control"], settings=settings)


@pytest.mark.parametrize("slip", SLIPS)
def test_a_finding_names_every_line_that_its_first_fix_changes(slip):
    result = solved(slip)
    texts = {block.line: block.text for block in result.program.blocks}
    for finding in result.diagnostics:
        lines = {finding.span.line, *(label.span.line for label in finding.labels)}
        told = re.findall(r"program lines? ([\d, and]+)", " ".join([finding.message, *finding.notes]))
        lines |= {int(line) for each in told for line in re.findall(r"\d+", each)}
        for fix in finding.fixes[:1]:
            assert changes_of(fix, result.lines_of(finding), texts).keys() <= lines, (finding, fix)


@pytest.mark.parametrize("slip", SLIPS)
def test_the_same_contour_is_the_same_contour(slip):
    result = solved(slip)
    texts = {block.line: block.text for block in result.program.blocks}
    for finding in result.diagnostics:
        lines = result.lines_of(finding)
        for fix in (each for each in finding.fixes if each.applicability is Applicability.SAFE):
            assert not fix.beside
            after = changed("\n".join(slip["slip"]), changes_of(fix, lines, texts))
            options = {"control": slip["control"], "rules": "off"}
            one, two = (
                [each.contour for each in solve(text, **options).answers if {*lines}.intersection(each.lines)]
                for text in ("\n".join(slip["slip"]), after)
            )
            # Without a corner or an angle, plain lines may be left.
            if len(one) == len(two) == 1 and one[0] and two[0] and after.count("\n") == len(slip["slip"]) - 1:
                # Without its corner, an arc behind is a plain move, and no part of the contour.
                few = min(len(path.elements) for path in (*one, *two))
                ways = [[value for each in path.elements[:few] for value in each.end] for path in (*one, *two)]
                assert ways[0] == pytest.approx(ways[1], abs=0.01)


@pytest.mark.parametrize("case", [FUNCTION, PLANE], ids=["a function between", "another plane"])
def test_the_lines_beside_the_contour_are_shown_and_written(case, tmp_path):
    control, text, line = case
    program = tmp_path / "part.nc"
    program.write_text(text)

    def run(*options):
        return CliRunner().invoke(main, ["check", str(program), "--control", control, *options])

    listing = run().stdout
    assert f"program line {line}:\n" in listing
    assert f"- {text.splitlines()[line - 1]}\n" in listing
    (first, *_) = json.loads(run("--format", "json").stdout)["diagnostics"]
    assert any(f"program line {line}" in note for note in first["notes"])
    fix = first["fixes"][0]
    assert line in [each["line"] for each in fix["beside"]]
    assert [each["old"] for each in fix["beside"]] == [text.splitlines()[each["line"] - 1] for each in fix["beside"]]
    sarif = json.loads(run("--format", "sarif").stdout)["runs"][0]["results"][0]
    changes = sarif["fixes"][0]["artifactChanges"][0]["replacements"]
    assert line in [each["deletedRegion"]["startLine"] for each in changes]
    added = [each[1:] for each in run("--unsafe-fixes", "--diff").stdout.splitlines()[2:] if each.startswith("+")]
    assert added == [each for each in MENDED[case].splitlines() if each not in text.splitlines() or each == "M08"]
    assert run("--unsafe-fixes", "--yes").exit_code == 0
    assert program.read_text() == MENDED[case]


def test_the_explorer_changes_the_lines_beside_the_contour():
    now = explore.begin(PLANE[1], control=PLANE[0])
    assert explore.apply_fix(now, 0, 0).text.splitlines() == MENDED[PLANE].splitlines()


def test_a_corner_that_lacks_its_neighbour_is_left_out_only_after_a_question(tmp_path):
    """The control stops there: there is no contour that stays the same without the corner."""
    control, text, _ = FUNCTION
    program = tmp_path / "part.nc"
    program.write_text(text)
    done = CliRunner().invoke(main, ["check", str(program), "--control", control, "--fix"])
    assert done.exit_code == 1
    assert done.output.splitlines()[-1].endswith("1 fix changes the contour (see --unsafe-fixes)")
    assert program.read_text() == text


def test_a_point_is_told_in_the_plane_of_the_fix():
    control, text, _ = PLANE
    (fix, *_) = solve(text, control=control).diagnostics[0].fixes
    assert fix.description.endswith("in program line 1 (another plane) -> V1 is at Z40.000 mm X0.000 mm")


def test_the_first_fix_of_an_angle_is_the_one_that_is_expected():
    program = "G00 X66. Z-76.\nG111 A180. K-4. B-10. X70.\nG01 X70. Z-82.\nM30"
    (finding,) = solve(program, control="yasnac-lx3").diagnostics
    assert finding.labels[0].text == "expected 170.000 deg"
    assert finding.fixes[0].description.startswith("write B170. for B-10. (the other way along the line)")


def test_an_element_that_has_the_number_of_its_block_is_told_with_its_program_line():
    """The control's screen shows the numbers of blocks, and findings name the lines of the file."""
    text = "0 BEGIN PGM R MM\n1 L X+0 Y+10 R0\n2 FL AN+15\n3 FC DR- R25 CCX+50 CCY+20\n4 FL X+90 Y+10\n5 END PGM R MM"
    (finding,) = solve(text, control="heidenhain").diagnostics
    assert "arc 3 is open: add AN, LEN or IX in program line 5" in finding.message
    assert finding.notes == ("arc 3 is block 3, in program line 4",)


@pytest.mark.parametrize(
    ("blocks", "fix"),
    [
        ("G1 Z-20 RND=5\nX32 RND=2\nZ-40", "delete RND=5; delete RND=2"),
        ("G1 Z-20 RND=5\nX34 RND=2\nZ-40", "write RND=0.5 for RND=5; write RND=0.5 for RND=2"),
        ("G1 X34 RND=5\nZ-20", "write RND=1 for RND=5"),
    ],
)
def test_the_first_fix_of_a_corner_that_does_not_fit_is_about_corners(blocks, fix):
    """Not about a diameter, which X16 or X3.2 for X32 would change: the part would be another one."""
    finding = solve(f"G18 G90 DIAMON\nG0 X32 Z0\n{blocks}\nM30", control="siemens-840d").diagnostics[0]
    assert finding.fixes[0].description.startswith(fix)
