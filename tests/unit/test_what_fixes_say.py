"""What is said of fixes: where each edits, which lines beside the contour it changes, and when the contour stays."""

import json
import re
from pathlib import Path

import pytest

from contoursolve import solve
from contoursolve.program import changes_of

SLIPS = json.loads((Path(__file__).parents[1] / "slips" / "by_hand.json").read_text())


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


def test_an_element_that_has_the_number_of_its_block_is_told_with_its_program_line():
    """The control's screen shows the numbers of blocks, and findings name the lines of the file."""
    text = "0 BEGIN PGM R MM\n1 L X+0 Y+10 R0\n2 FL AN+15\n3 FC DR- R25 CCX+50 CCY+20\n4 FL X+90 Y+10\n5 END PGM R MM"
    (finding,) = solve(text, control="heidenhain").diagnostics
    assert "arc 3 is open: add AN, LEN or IX in program line 5" in finding.message
    assert finding.notes == ("arc 3 is block 3, in program line 4",)
