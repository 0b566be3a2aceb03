"""Sketches at the desk: what is known of one, its words, files of it, and drawings of CAD."""

from base64 import b64encode
from io import StringIO

import pytest

import contoursolve
from contoursolve.sketches import read_sketch, sketch_view
from contoursolve.workbench import Desk

TEXT = """sketch = 1
part = "turned"
start = { Z = 0, X = 20 }

[[element]]
kind = "line"
AN = 180
Z = -30.50

[[element]]
kind = "line"
AN = 120
X = 60
"""
SKETCH = {
    "sketch": 1,
    "part": "turned",
    "start": {"Z": "0", "X": "20"},
    "element": [{"kind": "line", "AN": "180", "Z": "-30.50"}, {"kind": "line", "AN": "120", "X": "60"}],
}


@pytest.fixture
def ask(tmp_path):
    (tmp_path / "part.toml").write_text(TEXT, encoding="utf-8")
    desk = Desk(tmp_path)
    return lambda do, **fields: desk.answer({"window": "a", "do": do, **fields})


def test_a_sketch_is_opened_and_saved_where_nobody_else_changed_it(ask, tmp_path) -> None:
    opened = ask("sketch_open", name="part.toml")
    assert opened == {"sketch": SKETCH, "name": "part.toml", "base": opened["base"]}
    data = b64encode(TEXT.encode()).decode()
    for brought in ({"text": TEXT}, {"base64": data}):
        assert ask("sketch_open", name="own.toml", **brought) == {"sketch": SKETCH, "name": "own.toml", "base": ""}
    assert ask("save", name="part.toml", text="x")["conflict"] == opened["base"]
    longer = TEXT.replace("60", "70")
    saved = ask("save", name="part.toml", text=longer, base=opened["base"])
    assert (saved["saved"], len(saved["base"])) == ("part.toml", 32)
    assert (tmp_path / "part.toml").read_text(encoding="utf-8") == longer
    assert ask("save", name="part.toml", base64=data, over=saved["base"])["base"] == opened["base"]
    assert (tmp_path / "part.toml").read_text(encoding="utf-8") == TEXT


@pytest.mark.parametrize("ranges", [True, False])
def test_what_is_known_of_a_sketch_is_that_of_python_with_its_files(ranges, ask) -> None:
    known = ask("sketch", sketch=SKETCH, ranges=ranges)
    json = known.pop("json")
    assert (known.pop("text"), read_sketch(json)) == (TEXT, read_sketch(TEXT))
    assert known == sketch_view(read_sketch(TEXT), with_ranges=ranges)
    assert (known["said"], known["is_finished"]) == ("the contour is finished", True)


def test_the_words_of_a_sketch_tell_on_what_they_rest_and_how_far_they_are_off(ask) -> None:
    words = ask("sketch_words", sketch=SKETCH, control="fanuc-lathe")
    wanted = contoursolve.write(read_sketch(TEXT), "fanuc-lathe").candidates
    assert [each["block"] for each in words["candidates"]] == ["\n".join(each.lines) for each in wanted]
    assert [each["program"] for each in words["candidates"]] == [each.program for each in wanted]
    assert words["block"] == words["candidates"][0]["block"] == "G01 Z-30.5\nX60. ,A120."
    # By hand: 20 mm of radius at 120 degrees are 20 / tan(60 deg) = 11.547005 mm along Z.
    assert [(each["text"], each["rests"], each["off"]) for each in words["candidates"][1]["words"]] == [
        ("Z-30.5", "drawing", ""),
        ("X60.", "drawing", ""),
        ("Z-42.047", "computed", "5e-06 mm off"),
    ]
    assert [each["is_plain"] for each in words["candidates"]] == [False, True, False, False]
    for control, ending in (("haas-lathe", ".nc"), ("siemens-808d", ".mpf"), ("heidenhain", ".h")):
        assert ask("sketch_words", sketch=SKETCH, control=control)["ending"] == ending


def test_the_first_words_of_a_sketch_are_told_for_each_control(ask) -> None:
    rows = {row["control"]: (row["block"], row["reason"]) for row in ask("sketch_words", sketch=SKETCH)["rows"]}
    milling = ("", "the contour is turned, and this control is for mills")
    mills = ("nct-99m", "fanuc-mill", "haas-mill", "mitsubishi", "heidenhain")
    assert {control for control, row in rows.items() if row == milling} == {*mills}
    assert rows["yasnac-lx3"] == ("G111 A180. B120. K-30.5 X60.", "")
    assert rows["haas-lathe"] == ("G01 Z-30.5\nX60. A120.", "")
    assert rows["siemens-840d"] == ("G01 Z-30.5\nX60 ANG=120", "")


@pytest.mark.parametrize(
    ("do", "fields", "told"),
    [
        (
            "sketch",
            {"element": [{"kind": "line", "LEN": "3O"}]},
            'element 1: LEN is "3O"; write a number, such as 12.5',
        ),
        ("sketch", {"start": {"Q": "1"}}, "start.Q is no axis of this part; its axes are Z and X"),
        ("sketch", {"part": "cast"}, 'part is "cast"; write "turned" or "milled"'),
        ("sketch", {"element": 7}, "element is 7; write a list of lines and arcs"),
        ("sketch", {"sketch": None}, "sketch is missing; write sketch = 1"),
        (
            "sketch_words",
            {"element": [{"kind": "line", "AN": "180"}, {"kind": "line", "AN": "120", "X": "60"}]},
            "the sketch is not finished: one entry is missing: Z, LEN or IZ of line 1, or Z of line 2",
        ),
    ],
)
def test_what_is_no_sketch_is_told_in_one_sentence(do, fields, told, ask) -> None:
    assert ask(do, sketch={**SKETCH, **fields}, control="fanuc-lathe")["trouble"].startswith(told)


def test_what_is_no_file_of_a_sketch_or_a_drawing_is_told(ask) -> None:
    assert ask("sketch_words", sketch=SKETCH, control="abacus") == {"trouble": "'abacus' is no control here"}
    assert ask("sketch_open", name="p.toml", base64=b64encode(b"\xff").decode()) == {
        "trouble": "p.toml is no sketch: a sketch is TOML or JSON in UTF-8"
    }
    pytest.importorskip("ezdxf")
    told = ask("dxf_in", name="part.toml", part="turned")["trouble"]
    assert told.startswith("the file is no DXF drawing that can be read: ")


LINES = {"0": ((0, 0, 0, 20), (0, 20, -30, 20), (-30, 20, -50, 30)), "beside": ((100, 0, 120, 7),)}
TURNED = [("0", "40"), ("-30", "40"), ("-50", "60")]


@pytest.mark.parametrize(
    ("fields", "start", "ends", "note"),
    [
        ({"part": "turned", "layer": "0"}, ("0", "0"), TURNED, "the axis is Y0 of the drawing"),
        ({"part": "turned", "chain": 1}, ("0", "0"), TURNED, "the axis is Y0 of the drawing"),
        (
            {"part": "turned", "layer": "0", "reverse": True},
            *(("-50", "60"), [("-30", "40"), ("0", "40"), ("0", "0")], "the axis is Y0 of the drawing"),
        ),
        (
            {"part": "milled", "layer": "beside", "unit": "inch"},
            *(("100", "0"), [("120", "7")], "the drawing says that its unit is 1 mm; inch is taken, as you say"),
        ),
        ({"part": "milled", "layer": "beside", "zero": [5, -10]}, ("95", "10"), [("115", "17")], None),
    ],
    ids=str,
)
def test_a_drawing_of_cad_becomes_a_sketch_from_the_folder_or_by_its_bytes(fields, start, ends, note, ask, tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    document, written = ezdxf.new(units=4), StringIO()
    document.layers.add("beside")
    for layer, lines in LINES.items():
        for x, y, *end in lines:
            document.modelspace().add_line((x, y), end, dxfattribs={"layer": layer})
    document.write(written)
    (tmp_path / "part.dxf").write_text(written.getvalue())
    found = ask("dxf_in", name="part.dxf", **fields)
    axes = ("Z", "X") if fields["part"] == "turned" else ("X", "Y")
    assert tuple(found["sketch"]["start"][axis] for axis in axes) == start
    assert [tuple(each[axis] for axis in axes) for each in found["sketch"]["element"]] == ends
    assert found["sketch"].get("unit", "mm") == fields.get("unit", "mm")
    assert found["layers"] == {"0": 3, "beside": 1}
    assert note is None or found["notes"] == [note]
    assert [tuple(each[axis] for axis in axes) for each in found["measured"]] == ends
    data = b64encode(written.getvalue().encode()).decode()
    assert ask("dxf_in", name="other.dxf", base64=data, **fields) == found
    assert ask("sketch", sketch=found["sketch"])["is_finished"]


def test_an_arc_that_is_added_without_its_sense_leaves_what_is_known(ask):
    known = [{"kind": "line", "X": "40"}, {"kind": "line", "AN": "180", "Z": "-30"}, {"kind": "line", "X": "60"}]
    sketch = {"sketch": 1, "part": "turned", "start": {"Z": "0", "X": "0"}}
    before = ask("sketch", sketch={**sketch, "element": known})["elements"]
    assert any(each["segment"] for each in before)
    after = ask("sketch", sketch={**sketch, "element": [*known, {"kind": "arc"}]})["elements"]
    assert after[: len(before)] == before
