"""The corpus of slips by hand is well formed: columns, kinds, fills and names; and how often
the first fix undoes a slip."""

import json
import re
from itertools import chain
from pathlib import Path

import pytest
from vectors import BY_HAND as RIGHT

import contoursolve
from contoursolve.program import changed, changes_of

FOLDER = Path(__file__).parents[1] / "slips"
SLIPS = json.loads((FOLDER / "by_hand.json").read_text())
CONTROLS = {
    *("yasnac-lx3", "nct-99m", "fanuc-lathe", "fanuc-mill", "haas-lathe"),
    *("haas-mill", "siemens-840d", "isg", "mitsubishi", "heidenhain"),
}


def words(lines: list[str]) -> list[str]:
    return [word for line in lines for word in line.split()]


def test_the_columns_of_a_slip_point_at_its_wrong_words():
    for each in SLIPS:
        for line, word, begin, end in each["wrong"]:
            assert each["slip"][line - 1][begin - 1 : end - 1] == word, each["id"]


def test_every_slip_differs_from_what_was_meant_in_what_it_says():
    for each in SLIPS:
        right, slip = words(each["right"]), words(each["slip"])
        assert each["slip"] not in (each["right"], *each.get("also", ())), each["id"]
        assert bool(each["wrong"]) != bool(each["missing"]), each["id"]
        assert each["expect"] in {"first-fix", "placeholder", "named"}, each["id"]
        assert all(right.count(word) > slip.count(word) for word in each["missing"]), each["id"]
        assert bool(each.get("fill")) == (each["expect"] == "placeholder"), each["id"]
        for asked, value in each.get("fill", {}).items():
            assert asked.endswith("?"), each["id"]
            assert value.startswith(asked[:-1]), each["id"]
            assert value in each["missing"], each["id"]


def test_the_page_lists_the_kinds():
    table = (FOLDER / "README.md").read_text().partition("| kind | example |")[2]
    firsts = [row.split("|")[1] for row in table.splitlines() if row.startswith("| `")]
    listed = {kind for first in firsts for kind in re.findall(r"`([^`]+)`", first)}
    assert {each["kind"] for each in SLIPS} == listed


def test_names_are_unique_and_every_control_takes_part():
    assert len({each["id"] for each in SLIPS}) == len(SLIPS) >= 170
    assert len({each["id"] for each in RIGHT}) == len(RIGHT) == 300
    assert len({(each["control"], *each["program"]) for each in RIGHT}) == len(RIGHT)
    meant = {(each["part"], each["control"], *each["right"]) for each in SLIPS}
    assert len({part for part, *_ in meant}) == len(meant) >= 35
    assert meant <= {(each["part"], each["control"], *each["program"]) for each in RIGHT}
    assert {each["control"] for each in SLIPS} == {each["control"] for each in RIGHT} == CONTROLS


# What fixes make of them ------------------------------------------------------------------------------------------


def solved(entry: dict, lines: list[str]) -> contoursolve.Result:
    settings = dict(each.split("=", 1) for each in entry["settings"])
    return contoursolve.solve("\n".join(lines), control=entry["control"], settings=settings)


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
    return changed("\n".join(entry["slip"]), changes_of(fix, result.lines_of(finding), old)).split("\n")


@pytest.mark.parametrize(
    ("slips", "first_share", "three_share"),
    [
        pytest.param(SLIPS[::24], 0.7, 0.8, id="some"),
        pytest.param(SLIPS, 0.84, 0.89, id="all", marks=pytest.mark.slow),
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
