"""Sketches for a page: what is known of one, its words for a control or for all, and sketches out of files."""

from collections.abc import Mapping
from typing import Any, Literal

from contoursolve import sketches
from contoursolve.controls import CONTROLS
from contoursolve.diagnostics import plain
from contoursolve.postprocess import NumberGround, WrittenContour, WrittenContours, WrittenWord, ending_of
from contoursolve.sketches import ContourSketch
from contoursolve.workbench.fields import ActionError, Data, read_field

_GROUNDS = {
    NumberGround.DRAWING: "drawing",
    NumberGround.ROUND: "round",
    NumberGround.COMPUTED: "computed",
}
_UNITS: Mapping[str, Literal["mm", "inch"]] = {"mm": "mm", "inch": "inch"}


def known_of_sketch(action: Mapping[str, Any]) -> Data:
    """All that is known of a sketch, with its text as a file of TOML or JSON has it. Raises SketchError."""
    sketch = _sketch(action)
    known = sketches.sketch_view(sketch, with_ranges=read_field(action, "ranges", bool, False))
    return {**known, "text": sketches.write_sketch(sketch), "json": sketches.write_sketch(sketch, as_json=True)}


def words_of_sketch(action: Mapping[str, Any]) -> Data:
    """The words of a sketch for a control, or the first ones for each control. Raises as `sketches.write`."""
    sketch, control = _sketch(action), read_field(action, "control", str, "")
    if not control:
        return {"rows": [_row(each) for each in sketches.write(sketch)]}
    if control not in CONTROLS:
        raise ActionError(f"{control!r} is no control here")
    written = sketches.write(sketch, control)
    candidates = [_candidate(each) for each in written.candidates]
    return {**_row(written), "ending": ending_of(CONTROLS[control]), "candidates": candidates}


def _row(written: WrittenContours) -> Data:
    block = "\n".join(written.candidates[0].lines) if written.candidates else ""
    return {"control": written.control, "title": written.title, "reason": written.reason, "block": block}


def _candidate(written: WrittenContour) -> Data:
    words = (word for block in written.blocks for word in block.words if word.ground in _GROUNDS)
    return {
        "block": "\n".join(written.lines),
        "program": written.program,
        "is_plain": written.is_plain,
        "written_out": [*written.written_out],
        "deviation_mm": written.deviation,
        "words": [{"text": each.text, "rests": _GROUNDS[each.ground], "off": _off(each)} for each in words],
    }


def _off(word: WrittenWord) -> str:
    """The amount by which rounding puts a word off; empty for an exact one."""
    return f"{word.off:.1g} {word.unit.value} off" if word.off else ""


def sketch_in(text: str) -> Data:
    """The sketch of a file's text, as plain data. Raises SketchError."""
    return {"sketch": plain(sketches.plain_sketch(sketches.read_sketch(text)))}


def sketch_in_drawing(data: bytes, action: Mapping[str, Any]) -> Data:
    """The sketch of a chain of a DXF drawing, with what was left out, and its layers. Raises DxfError and
    MissingExtraError."""
    zero = read_field(action, "zero", list, None)
    found = sketches.read_dxf(
        data,
        part="milled" if read_field(action, "part", str) == "milled" else "turned",
        layer=read_field(action, "layer", str, "") or None,
        unit=_UNITS.get(read_field(action, "unit", str, "")),
        zero=(float(zero[0]), float(zero[1])) if zero else None,
        chain=read_field(action, "chain", int, None),
        reverse=read_field(action, "reverse", bool, False),
    )
    return {
        "sketch": plain(sketches.plain_sketch(found.sketch)),
        "layers": dict(found.layers),
        "notes": [*found.given, *found.notes],
        "measured": plain(found.measured),
    }


def _sketch(action: Mapping[str, Any]) -> ContourSketch:
    return sketches.sketch_of(read_field(action, "sketch", dict))
