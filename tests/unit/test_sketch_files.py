"""Sketches as text: read and written without loss, refused with one sentence, and their schema."""

import json
from pathlib import Path

import calling
import pytest

import contoursolve
from contoursolve.sketches import SketchError, read_sketch, sketch_schema, solve_sketch, write_sketch

ROOT = Path(__file__).parents[2]

SPINDLE = """sketch = 1
part = "turned"
start = { Z = -33, X = 40 }

[[element]]
kind = "line"
AN = 165
X = 46 # of the drawing
Z = -45

[[element]]
kind = "arc"
tangent = true
turn = "ccw"
R = 20

[[element]]
kind = "line"
tangent = true
X = 52
Z = -70
"""


def test_commands_take_a_sketch_and_name_values_that_agree_when_they_are_typed_in(tmp_path):
    """`check` names the lines of the file; each number that it proposes makes a contour; what is missing is drawn."""
    file, lines = tmp_path / "spindle.toml", SPINDLE.splitlines()
    file.write_text(SPINDLE, encoding="utf-8")
    status, told, _ = calling.run("check", file, "--format", "json")
    finding = json.loads(told)["diagnostics"][0]
    agreeing = [each for each in finding["fixes"] if each["description"].startswith("write ")]
    assert (status, lines[finding["line"] - 1].split(" =")[0] in ("kind", "AN", "X", "Z")) == (1, True)
    assert agreeing
    for each in agreeing:
        (change,) = each["beside"]
        typed = [*lines[: change["line"] - 1], change["text"], *lines[change["line"] :]]
        file.write_text("\n".join(typed), encoding="utf-8")
        assert calling.run("check", file)[0] == 0
    assert "the contour is finished" in calling.run("solve", file)[1]
    file.write_text(SPINDLE.replace("AN = 165\n", "").replace("X = 52\n", ""), encoding="utf-8")
    drawn = tmp_path / "spindle.svg"
    status, told, _ = calling.run("draw", file, "-o", drawn)
    assert (status, "missing" in told, "missing" in drawn.read_text(encoding="utf-8")) == (1, True, True)
    assert calling.run("solve", file, "--control", "isg")[0] == 2


def test_numbers_keep_their_digits():
    text = (
        'sketch = 1\npart = "milled"\n\n[[element]]\nkind = "line"\nX = 40.50\nY = -0.1000000000000000001\nLEN = "?"\n'
    )
    assert write_sketch(contoursolve.read_sketch(text)) == text


_PART = 'sketch = 1\npart = "turned"\n'
_LINE = _PART + '[[element]]\nkind = "line"\n'


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('part = "turned"', 'sketch is missing; write sketch = 1'),
        ('sketch = 2\npart = "turned"', "sketch is 2, and this contoursolve reads version 1; install a newer one"),
        ('sketch = 1\npart = "round"', 'part is "round"; write "turned" or "milled"'),
        (_PART + "start = { Z = 0, Y = 1 }", "start.Y is no axis of this part; its axes are Z and X"),
        (_LINE + "LENG = 3", "element 1: LENG is no field here; LEN was probably meant"),
        (_LINE + "R = 3", "element 1: R is a field of arcs; leave it out, or change kind"),
        (_LINE + "PDY = 3", "element 1: PDY is no field here; PDZ or PDX was probably meant"),
        (_LINE + "X = 2,5", "line 5 of the file: write 2.5 with a point, or in quotes"),
        (_LINE + 'X = "2.5.1"', 'element 1: X is "2.5.1"; write a number, such as 12.5 or "12,5", or "?"'),
        (_LINE + "X = nan", 'element 1: X is NaN; write a number, such as 12.5 or "12,5", or "?"'),
        (_LINE + "X = 2020-01-01", 'element 1: X is "2020-01-01"; write a number, such as 12.5 or "12,5", or "?"'),
        (_LINE + f'X = "2.{"0" * 39}"', 'element 1: X is "2.' + "0" * 37 + '...; write a number, such'),
        (_LINE + "X = true", 'element 1: X is true; write a number, such as 12.5 or "12,5", or "?"'),
        (_LINE + "X = 1e9", 'element 1: X is 1000000000, which is larger than a control can travel'),
        (
            _LINE + "corner = { fillet = 2 }",
            'element 1: corner is {"fillet": 2}; write a rounding or a chamfer, such as { rounding = 2 }',
        ),
        (_LINE + 'guess = { X = "?" }', 'element 1: guess.X is "?", and a number must stand there'),
        (_LINE + 'facts = ["a\\nb"]', 'element 1: facts is ["a\\nb"]; write a list of statements, such as ["length'),
        (_PART + '[[element]]\nX = 1', 'element 1: kind is missing; write kind = "line" or "arc"'),
        ('{"sketch": 1, "part": "milled", "element": [{"kind": null}]}', 'element 1: kind is missing; write kind ='),
        (_PART + "[[element]]\nkind = [1]", 'element 1: kind is [1]; write "line" or "arc"'),
        (_LINE + "guess = { CCX = 1 }", "element 1: guess.CCX is no axis of this part; its axes are Z and X"),
        ('{"sketch": 1, "sketch": 1, "part": "milled"}', "sketch is given twice in one table; leave one out"),
        ("[1", "the file is no TOML: Expected ']' at the end of a table declaration (at end of document)"),
        (_PART + "a." * 9 + "a = 1", "the file is no TOML: a key has more than 8 dots (at line 3)"),
        (_PART + "start = { Z = 0, " + '"a" . ' * 9 + "b = 1 }", "the file is no TOML: a key has more than 8"),
        (_PART + "[a.b.c.d.e.f.g.h.i]", "a is no field here"),
        ("{]", "the file is no JSON: "),
    ],
)  # fmt: skip
def test_a_wrong_file_is_refused_with_its_place(text, told):
    with pytest.raises(SketchError) as caught:
        contoursolve.read_sketch(text)
    assert str(caught.value).startswith(told)
    assert "\n" not in str(caught.value)


def test_the_schema_is_that_of_the_table():
    """docs/sketch.schema.json; `python -m tests.unit.test_sketch_files` writes it."""
    assert (ROOT / "docs" / "sketch.schema.json").read_text(encoding="utf-8") == _schema()


def _schema() -> str:
    return json.dumps(sketch_schema(), indent=2) + "\n"


if __name__ == "__main__":
    (ROOT / "docs" / "sketch.schema.json").write_text(_schema(), encoding="utf-8")


REPEATING = {
    "a chord beside its ends": """sketch = 1
part = "milled"
start = { X = 0, Y = 0 }
[[element]]
kind = "line"
X = 9.248192
[[element]]
kind = "arc"
X = 16.373786
CCA = 354.4
CCX = 11.298126
LEN = 8.80214
tangent = true
turn = "cw"
[[element]]
kind = "arc"
Y = -11.206371
CCA = 226.9
LEN = 10.791844
tangent = true
turn = "ccw"
""",
    "a radius beside a centre": """sketch = 1
part = "milled"
start = { X = 0, Y = 0 }
[[element]]
kind = "line"
X = 10.360887
[[element]]
kind = "arc"
LEN = 7.932715
CCA = 302.4
CCX = 5.839095
R = 5.5
tangent = true
turn = "cw"
[[element]]
kind = "line"
Y = -34.123453
IX = -16.442881
LEN = 20
[[element]]
kind = "arc"
CCA = 246.1
Y = -49.056476
CCY = -41.193892
tangent = true
turn = "ccw"
""",
}
"""Dimensions of drawings that repeat others to the sixth decimal, in which they are rounded."""


@pytest.mark.parametrize(
    ("name", "ends", "wrong"),
    [
        ("a chord beside its ends", [(9.248, 4.06), (16.374, -1.108), (20.18, -11.206)], ("8.80214", "8.8022")),
        (
            "a radius beside a centre",
            [(10.361, -14.963), (8.786, -22.738), (-7.657, -34.123), (-6.245, -49.056)],
            ("LEN = 20", "LEN = 20.001"),
        ),
    ],
)
def test_dimensions_that_repeat_others_but_for_rounding_are_too_many_and_no_contradiction(
    name: str, ends: list[tuple[float, float]], wrong: tuple[str, str]
) -> None:
    found = solve_sketch(read_sketch(REPEATING[name]))
    assert found.is_finished, found.said
    assert [tuple(round(value, 3) for value in each.segment.end) for each in found.elements] == ends
    assert [each.code for each in found.findings if each.severity.value == "error"] == []
    # What is really off is told with its amount.
    told = solve_sketch(read_sketch(REPEATING[name].replace(*wrong)))
    assert any(each.off_mm for each in told.findings), [each.message for each in told.findings]
