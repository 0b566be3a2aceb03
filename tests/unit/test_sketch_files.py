"""Sketches as text: read and written without loss, refused with one sentence, and their schema."""

import json
from pathlib import Path

import pytest

import contoursolve
from contoursolve.sketches import SketchError, sketch_schema, write_sketch

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "tests" / "sketches").glob("*.toml"))


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
