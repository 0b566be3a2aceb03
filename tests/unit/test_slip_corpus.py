"""The corpus of slips by hand is well formed, what is said of each, and how often, and for which, the first fix undoes
a slip."""

import json
import re
from functools import cache
from itertools import chain
from pathlib import Path

import pytest
from vectors import BY_HAND as RIGHT

import contoursolve
from contoursolve.program import changed, changes_of

FOLDER = Path(__file__).parents[1] / "slips"
SLIPS = json.loads((FOLDER / "by_hand.json").read_text())
PAIRS = json.loads((FOLDER / "pairs.json").read_text())
NAMED = contoursolve.CONTROLS.keys() - {"siemens-808d", "cnc-pilot"}


def test_the_page_lists_the_kinds():
    table = (FOLDER / "README.md").read_text().partition("| kind | example |")[2]
    firsts = [row.split("|")[1] for row in table.splitlines() if row.startswith("| `")]
    assert {each["kind"] for each in SLIPS} == {kind for first in firsts for kind in re.findall(r"`([^`]+)`", first)}


def test_names_are_unique_and_every_control_takes_part():
    assert len({each["id"] for each in SLIPS}) == len(SLIPS) >= 170
    assert len({each["id"] for each in RIGHT}) == len(RIGHT) == 300
    assert len({(each["control"], *each["program"]) for each in RIGHT}) == len(RIGHT)
    meant = {(each["part"], each["control"], *each["right"]) for each in SLIPS}
    assert len({part for part, *_ in meant}) == len(meant) >= 35
    assert meant <= {(each["part"], each["control"], *each["program"]) for each in RIGHT}
    assert {each["control"] for each in SLIPS} == {each["control"] for each in RIGHT} == NAMED


def both(pair: dict) -> dict:
    """The entry of two slips at once: that of the first one, with the lines that the second one changes."""
    one, two = (next(each for each in SLIPS if each["id"] == name) for name in pair["of"])
    assert one["right"] == two["right"], pair["id"]
    lines = zip(one["right"], one["slip"], two["slip"], strict=True)
    assert all(right in (first, second) for right, first, second in lines), pair["id"]
    lines = zip(one["right"], one["slip"], two["slip"], strict=True)
    return one | {"slip": [second if first == right else first for right, first, second in lines]}


# What fixes make of them ------------------------------------------------------------------------------------------


def solved(entry: dict, lines: list[str]) -> contoursolve.Result:
    return _solved("\n".join(lines), entry["control"], *entry["settings"])


@cache
def _solved(text: str, control: str, *settings: str) -> contoursolve.Result:
    """Each slip is asked about more than once."""
    return contoursolve.solve(text, control=control, settings=dict(each.split("=", 1) for each in settings))


def paths(result: contoursolve.Result) -> list[tuple[float, ...]] | None:
    """All places of all contours, mm to a hundredth; None where one has no path."""
    if not result.answers or any(each.contour is None for each in result.answers):
        return None
    elements = [each for answer in result.answers for each in answer.contour.elements]
    return [tuple(round(value, 2) + 0.0 for value in (*each.start, *each.end)) for each in elements]


def fixed(
    entry: dict, result: contoursolve.Result, finding: contoursolve.Diagnostic, fix: contoursolve.Fix
) -> list[str]:
    old = dict(enumerate(entry["slip"], 1))
    changes = changes_of(fix, result.lines_of(finding), old)
    return changed("\n".join(entry["slip"]), changes).split("\n")


def mended(entry: dict) -> list[str]:
    """The lines of an entry with the first fix of its first finding, and so on until nothing is left or has a fix."""
    for _ in range(4):
        result = solved(entry, entry["slip"])
        found = [(each, fix) for each in result.diagnostics for fix in each.fixes[:1]]
        if not found:
            break
        entry = entry | {"slip": fixed(entry, result, *found[0])}
    return entry["slip"]


@pytest.mark.parametrize(
    ("slips", "first_share", "three_share"),
    [
        pytest.param(SLIPS[::24], 0.7, 0.8, id="some"),
        pytest.param(SLIPS, 0.91, 0.93, id="all", marks=pytest.mark.slow),
    ],
)
def test_the_first_fix_undoes_most_slips_by_hand(slips, first_share, three_share):
    """Of those whose contour a fix can give back without asking for a number."""
    first = among = count = 0
    for entry in slips:
        meant = [paths(solved(entry, lines)) for lines in (entry["right"], *entry.get("also", ()))]
        if entry["expect"] != "first-fix" or meant[0] is None:
            continue
        count += 1
        result = solved(entry, entry["slip"])
        findings = sorted(result.diagnostics, key=lambda each: (each.severity.value != "error", each.span))
        offered = list(chain.from_iterable(((each, fix) for fix in each.fixes) for each in findings))
        good = [paths(solved(entry, fixed(entry, result, *each))) in meant for each in offered[:3]]
        first += good[:1] == [True]
        among += any(good)
    assert first / count >= first_share, (first, among, count)
    assert among / count >= three_share, (first, among, count)


@pytest.mark.parametrize(
    ("pairs", "share"),
    [
        pytest.param(PAIRS[::12], 0.4, id="some"),
        pytest.param(PAIRS, 0.7, id="all", marks=pytest.mark.slow),
    ],
)
def test_the_first_fixes_one_after_the_other_undo_most_pairs(pairs, share):
    """Of two slips, of some of which nothing tells that they are any."""
    count = 0
    for pair in pairs:
        entry = both(pair)
        meant = paths(solved(entry, entry["right"]))
        count += paths(solved(entry, mended(entry))) == meant
    assert count / len(pairs) >= share, (count, len(pairs))


MORE = {
    "centre": ("fanuc-mill", "G17 G90|G00 X0. Y0.|G01 X60. ,R4. F300|G02 X60. Y50. I15. J-25. ,R4.|G01 X0.|Y0."),
    "two corners": ("nct-99m", "G17 G90|G0 X0 Y0|G1 X55 ,R6 F200|Y35 ,C3 ,R1|X0 Y12"),
    "circle": ("nct-99m", "G17 G0 X90 Y0|G42 G1 X50 D0|G3 X-50 Y0 R55|G1 X-50 Y42.857 ,A171.87 Q-1|G40 G0 Y70"),
    "turn": ("yasnac-lx3", "G00 X40. Z0.|G111 A400. K-30. B120. X100."),
}
"""Controls and programs, besides those of the corpus."""

FIRST = {
    "ya-spindle-01": "write K-28. for I-28.",  # kind
    "nc-plate-02": "write ,R8 for ,R88",  # round
    "ya-flange-02": "write I15. for K15.",  # near
    "fm-frame-02": "write Y65. for Y56.",  # familiar
    "circle": "write R50 for R55",  # points
    "fl-full-03": "write Z-25. for Z-52.",  # turns-back
    "fl-cone-06": "write X70. for X7.",  # inward
    "nc-cam-03": "write I-40 for I40",  # turning
    "centre": "write J25. for J-25.",  # wide
    "turn": "write A200. for A400.",  # across
    "two corners": "delete ,R1",  # large
    "nc-hook-08": "write X10 for X-10",  # long
    "fm-frame-07": "write G90 for G91",  # closed
    "mi-lever-02": "write A350. for A170.",  # same
    "he-wing-01": "write FLT for FL",
    "he-star-02": "add PA?",
    "he-plate-02": "write RND for RDN",
    "hm-slot-06": "write I25. for I85. (the centre counted from the start)",
    "nc-hook-02": "write I10 for I0; write J0 for J-40",
    "ya-bush-03": "write Z-70. for Z-7.",
    "fl-full-08": "write X46. for X-46. (a minus sign too many)",
    "hl-axle-09": "write Z-52. for X-52.",
    "fm-bracket-01": "write G91 for G90",
    "nc-plate-05": "write ,R6 for .R6",
    "ya-bush-06": "write Q2. for O2.",
    "fl-bore-05": "write Z-20. for Z-20",
    "fm-plate-01": "write G03 for G02",
    "si-pocket-04": "write X=IC(40) for X=IC40",
    "ya-bush-02": "write A180. for A0. (the angle from the other side)",
    "fm-eye-08": "write G01 for G03",
    "nc-hook-09": "move Q-1 from program line 5 to program line 4",
    "is-roof-06": "move Y60 from program line 5 to program line 4",
    "fl-cone-09": "move ,A120. from program line 5 to program line 4",
    "he-saddle-03": "add DR+",
    "si-knob-02": "write CT for TC",
    "si-knob-04": "add G1 to program line 6",
    "hm-slot-02": "write I25. for K25.",
    "ya-collar-01": "write I12. for I24.",
    "nc-wedge-05": "write ,A60 for ,A6",
}
"""The first fix of a slip, and the feature of `diagnosis/plausibility.py` that decides that it is the first."""


def first_fix(entry: dict, lines: list[str]) -> str:
    return next((fix.description for each in solved(entry, lines).diagnostics for fix in each.fixes), "")


@pytest.mark.parametrize("name", FIRST)
def test_the_first_fix_undoes_the_slip_in_whatever_order_words_stand(name):
    control, text = MORE.get(name, ("", ""))
    more = {"control": control, "slip": text.split("|"), "settings": []}
    entry = next((each for each in SLIPS if each["id"] == name), more)
    told = first_fix(entry, entry["slip"])
    assert told.startswith(FIRST[name])
    if entry["control"] != "heidenhain":
        parts = [re.match(r"(N\d+ )?(.*)", line).groups() for line in entry["slip"]]
        assert first_fix(entry, [(number or "") + " ".join(reversed(rest.split())) for number, rest in parts]) == told


# What is said of them ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("slip", SLIPS[::3], ids=lambda slip: slip["id"])
def test_a_finding_names_every_line_that_its_first_fix_changes(slip):
    result = solved(slip, slip["slip"])
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
    (finding,) = contoursolve.solve(text, control="heidenhain").diagnostics
    assert "the arc (block 3) is open: add AN, LEN or IX in block 4" in finding.message
