"""The corpora of slips by hand and of right programs are well formed: columns, kinds, fills and names."""

import json
import re
from pathlib import Path

FOLDER = Path(__file__).parents[1] / "slips"
SLIPS = json.loads((FOLDER / "by_hand.json").read_text())
RIGHT = json.loads((FOLDER / "right.json").read_text())
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
    assert len({(each["control"], *each["lines"]) for each in RIGHT}) == len(RIGHT)
    meant = {(each["part"], each["control"], *each["right"]) for each in SLIPS}
    assert len({part for part, *_ in meant}) == len(meant) >= 35
    assert meant <= {(each["part"], each["control"], *each["lines"]) for each in RIGHT}
    assert {each["control"] for each in SLIPS} == {each["control"] for each in RIGHT} == CONTROLS
