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
        text = " ".join([finding.message, *finding.notes])
        # A line with a number is one of the program.
        assert re.search(r"(?<!program )\b(?:line|arc|corner) \d", text) is None, text
        told = re.findall(r"program lines? ([\d, and]+)", text)
        lines |= {int(line) for each in told for line in re.findall(r"\d+", each)}
        blocks = re.findall(r"\d+", " ".join(re.findall(r"\bblocks? ([\d, and]+)", text)))
        lines |= {line for line, own in texts.items() if {*own.split()[:1]} & {*blocks}}
        for fix in finding.fixes[:1]:
            assert changes_of(fix, result.lines_of(finding), texts).keys() <= lines, (finding, fix)


def test_an_element_of_a_free_contour_is_told_with_the_number_of_its_block():
    text = "0 BEGIN PGM R MM\n1 L X+0 Y+10 R0\n2 FL AN+15\n3 FC DR- R25 CCX+50 CCY+20\n4 FL X+90 Y+10\n5 END PGM R MM"
    (finding,) = solve(text, control="heidenhain").diagnostics
    assert "the arc (block 3) is open: add AN, LEN or IX in block 4" in finding.message
