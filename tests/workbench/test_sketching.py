"""Sketches at the desk: what is known of one, its words, files of it, and drawings of CAD."""

import base64
from io import StringIO

import pytest

import contoursolve
from contoursolve.sketches import read_sketch
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
AN = 90
X = 60
"""


@pytest.fixture
def desk(tmp_path):
    (tmp_path / "part.toml").write_text(TEXT, encoding="utf-8")
    return Desk(tmp_path)


def ask(desk, do, **fields):
    return desk.answer({"window": "a", "do": do, **fields})


def test_a_sketch_is_opened_known_written_and_saved(desk, tmp_path) -> None:
    opened = ask(desk, "sketch_open", name="part.toml")
    sketch = opened["sketch"]
    assert sketch["element"][0] == {"kind": "line", "AN": "180", "Z": "-30.50"}
    known = ask(desk, "sketch", sketch=sketch, ranges=True)
    assert known["is_finished"]
    assert known["text"] == TEXT
    assert read_sketch(known["json"]) == read_sketch(TEXT)
    assert known["picture"]["frame"]["scale"] > 0
    words = ask(desk, "sketch_words", sketch=sketch, control="fanuc-lathe")
    wanted = contoursolve.write(read_sketch(TEXT), "fanuc-lathe").candidates
    assert [each["block"] for each in words["candidates"]] == ["\n".join(each.lines) for each in wanted]
    assert {"text": "Z-30.5", "rests": "drawing", "off": ""} in words["candidates"][0]["words"]
    assert [ask(desk, "sketch_words", sketch=sketch, control=each)["ending"] for each in ENDINGS] == [*ENDINGS.values()]
    rows = ask(desk, "sketch_words", sketch=sketch, control=None)["rows"]
    assert {row["control"] for row in rows if row["block"]} >= {"fanuc-lathe", "haas-lathe", "yasnac-lx3"}
    assert all(row["block"] or row["reason"] for row in rows)
    # Another file is not written over, and the own one only while nobody else changed it.
    assert ask(desk, "save", name="part.toml", text="x")["conflict"] == opened["base"]
    saved = ask(desk, "save", name="part.toml", text=TEXT.replace("60", "70"), base=opened["base"])
    assert saved["saved"] == "part.toml"
    assert (tmp_path / "part.toml").read_text(encoding="utf-8") == TEXT.replace("60", "70")


ENDINGS = {"haas-lathe": ".nc", "siemens-808d": ".mpf", "heidenhain": ".h"}


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"element": [{"kind": "line", "LEN": "3O"}]}, "element 1: LEN is"),
        ({"start": {"Q": "1"}}, "start.Q is no axis"),
        ({"part": "cast"}, "part is"),
        ({"element": 7}, "element is 7"),
        ({"sketch": None}, "sketch"),
    ],
)
def test_what_is_no_sketch_is_told_in_one_sentence(change, told, desk) -> None:
    sketch = {"sketch": 1, "part": "turned", "start": {"Z": "0", "X": "0"}, **change}
    assert ask(desk, "sketch", sketch=sketch)["trouble"].startswith(told)


def test_words_of_an_open_sketch_are_what_is_missing(desk) -> None:
    sketch = ask(desk, "sketch_open", name="part.toml")["sketch"]
    del sketch["element"][0]["Z"]
    assert "missing" in ask(desk, "sketch_words", sketch=sketch, control="fanuc-lathe")["trouble"]
    assert "no control" in ask(desk, "sketch_words", sketch=sketch, control="abacus")["trouble"]


def test_a_drawing_of_cad_becomes_a_sketch_from_the_folder_or_by_its_bytes(desk, tmp_path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new(units=4)
    for start, end in (((0, 0), (0, 20)), ((0, 20), (-30, 20)), ((-30, 20), (-50, 30))):
        document.modelspace().add_line(start, end)
    written = StringIO()
    document.write(written)
    data = written.getvalue().encode()
    (tmp_path / "part.dxf").write_bytes(data)
    by_name = ask(desk, "dxf_in", name="part.dxf", part="turned")
    assert [each["X"] for each in by_name["sketch"]["element"]] == ["40", "40", "60"]
    assert by_name["measured"][1]["LEN"] == "30"
    by_bytes = ask(desk, "dxf_in", name="other.dxf", base64=base64.b64encode(data).decode(), part="turned")
    assert by_bytes == by_name
    assert ask(desk, "sketch", sketch=by_name["sketch"])["is_finished"]
    assert "no DXF" in ask(desk, "dxf_in", name="part.toml", part="turned")["trouble"]
