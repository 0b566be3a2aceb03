"""Solved contours as a drawing for CAD: DXF R2010 with one layer an element, the same bytes for the same input.

The plane's first axis is the drawing's X and its second axis the drawing's Y: on a lathe Z to the right and X up, as
radius. Custom properties of the drawing say so. Contours of several planes lie over each other, and the name of each
layer begins with its plane. No text of the program enters it.
"""

import io
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from math import atan2, degrees, hypot
from types import MappingProxyType
from typing import TYPE_CHECKING

import ezdxf
from ezdxf.document import Drawing
from ezdxf.enums import TextEntityAlignment
from ezdxf.filemanagement import new
from ezdxf.layouts.layout import Modelspace

from contoursolve.diagnosis import Answer, count, join
from contoursolve.diagnostics import check_type
from contoursolve.geometry import Length, Plane, Turn
from contoursolve.program import Result
from contoursolve.solving import ArcSegment, Contour, Point, Segment, shifted
from contoursolve.tolerance import LENGTH

if TYPE_CHECKING:
    from contoursolve.tool_radius import ToolReport

CONSTRUCTION = "construction"
"""The layer of what is not cut: virtual and computed intersections."""

_RELEASE = "R2010"
_INSUNITS = {Length.INCH: 1, Length.MM: 4}
_MEASUREMENT = {Length.INCH: 0, Length.MM: 1}
_RED, _BLACK, _GREY = 1, 7, 8
_CROSS = 2
"""$PDMODE: points are drawn as crosses."""
_MARK = 0.01
"""1. Height of texts, as a share of the drawing's larger side."""
_FULL = 360.0


def drawing_for_cad(result: Result, tool: "ToolReport | None") -> tuple[bytes, str] | None:
    """The drawing of all that is solved of a program, with the path of its tool, and what is in it and what is left
    out, each contour by its line; None if nothing is solved."""
    contours = [answer.contour for answer in result.answers if answer.contour]
    runs, solved = tool.runs if tool else (), {line for answer in result.answers for line in answer.lines}
    paths = {f"tool - program line {each.run.lines[0]}": each.path for each in runs if each.path}
    beside = f", {count(len(paths), 'path')} of the tool" if paths else ""
    plain = [each for each in runs if solved.isdisjoint(each.run.lines)]
    paths |= {f"part - program line {each.run.lines[0]}": each.part for each in plain}
    if not contours and not paths:
        return None
    elements = count(sum(len(contour.elements) for contour in contours), "element")
    told = [f"{elements} of {count(len(contours), 'contour')}{beside}", *_left_out(result.answers)]
    if lines := [str(each.lines[0]) for each in result.answers if each.contour and each.start.is_relative]:
        told.append(f"the place is not known of {count(len(lines), 'contour')} ({_program_lines(lines)})")
    if lines := [str(each.run.lines[0]) for each in runs if not each.path]:
        told.append(f"left out: {count(len(lines), 'path')} of the tool ({_program_lines(lines)})")
    return to_dxf(result.answers, paths), "; ".join(told)


def _left_out(answers: Sequence[Answer]) -> Iterator[str]:
    """The contours without a drawing by their lines, those of a state together."""
    by_state: dict[str, list[str]] = {}
    for answer in answers:
        if not answer.contour:
            by_state.setdefault(answer.state, []).append(str(answer.lines[0]))
    for state, lines in by_state.items():
        yield f"left out, {state}: {count(len(lines), 'contour')} ({_program_lines(lines)})"


def _program_lines(lines: Sequence[str]) -> str:
    each_once = [*dict.fromkeys(lines)]  # a block that runs again has its line again
    return f"program {'line' if len(each_once) == 1 else 'lines'} {join(each_once)}"


def to_dxf(answers: Sequence[Answer], paths: Mapping[str, Contour] = MappingProxyType({})) -> bytes:
    """The drawing of every contour that is solved, and of further paths, each on a layer of its name; in inches if all
    contours are programmed in inches, else in mm.

    Raises ValueError if none is solved and there are no paths.
    """
    check_type("answers", answers, Sequence, "a list of answers, such as `result.answers`")
    for answer in answers:
        check_type("each of the answers", answer, Answer)
    drawn = [(number, answer) for number, answer in enumerate(answers, 1) if answer.contour]
    if not drawn and not paths:
        raise ValueError("no contour is solved: the drawing would be empty")
    unit = Length.INCH if drawn and all(answer.unit is Length.INCH for _, answer in drawn) else Length.MM
    is_split = has_several_planes(answers)
    with _same_bytes():
        document = new(_RELEASE)
        _set_header(document, unit, [*(answer.plane for _, answer in drawn), *(each.plane for each in paths.values())])
        for name in dict.fromkeys(construction_name(answer, is_split=is_split) for _, answer in drawn):
            document.layers.add(name, color=_GREY)
        page = document.modelspace()
        height = _MARK * _larger_side([*(each.contour for _, each in drawn if each.contour), *paths.values()], unit)
        for number, answer in drawn:
            _draw(document, page, number, answer, unit, height, is_split=is_split)
        for name, path in paths.items():
            for element in path.elements:
                _draw_element(document, page, element, name, float(unit.in_mm), _GREY)
        for kind in sorted(document.entitydb.dxf_types_in_use()):
            document.classes.add_class(kind)  # ezdxf would list them in the order of a set
        stream = io.StringIO()
        document.write(stream)
    return document.encode(stream.getvalue())


def has_several_planes(answers: Sequence[Answer]) -> bool:
    """Whether the solved contours lie in more than one plane."""
    return len({answer.plane for answer in answers if answer.contour}) > 1


def layer_name(number: int, answer: Answer, element: Segment, *, is_split: bool = False) -> str:
    """The layer of one element: the contour's number and line, and the element's name; `is_split` puts its plane
    before them."""
    return _in_plane(f"contour {number} - program line {answer.lines[0]} - {element.name}", answer, is_split)


def construction_name(answer: Answer, *, is_split: bool = False) -> str:
    """The layer of the intersections of one contour; `is_split` puts its plane before the name."""
    return _in_plane(CONSTRUCTION, answer, is_split)


def _in_plane(name: str, answer: Answer, is_split: bool) -> str:
    return f"{answer.plane.code} - {name}" if is_split else name


@contextmanager
def _same_bytes() -> Iterator[None]:
    """Write no date, no version and no random identity into the drawing."""
    options = ezdxf.options  # type: ignore[attr-defined]  # documented, and exported without saying so
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before


def _set_header(document: Drawing, unit: Length, planes: Sequence[Plane]) -> None:
    document.header["$INSUNITS"] = _INSUNITS[unit]
    document.header["$MEASUREMENT"] = _MEASUREMENT[unit]
    document.header["$PDMODE"] = _CROSS
    for plane in dict.fromkeys(planes):
        first, second = (
            f"{axis} as radius" if is_diameter else axis
            for axis, is_diameter in zip(plane.axes, plane.diameters, strict=True)
        )
        document.header.custom_vars.append(f"Axes in {plane.code}", f"X of the drawing is {first}, Y is {second}")
    document.header.custom_vars.append("Unit", unit.value)


def _larger_side(contours: Sequence[Contour], unit: Length) -> float:
    ends = [each for contour in contours for each in (contour.start, *(element.end for element in contour.elements))]
    sides = (max(each[axis] for each in ends) - min(each[axis] for each in ends) for axis in (0, 1))
    return max(sides) / float(unit.in_mm)


def _draw(
    document: Drawing, page: Modelspace, number: int, answer: Answer, unit: Length, height: float, *, is_split: bool
) -> None:
    contour, scale = answer.contour, float(unit.in_mm)
    if contour is None:
        return

    first, second = answer.led

    def place(at: Point) -> Point:
        return (at[0] + first) / scale, (at[1] + second) / scale

    for element in (shifted(each, answer.led) for each in contour.elements):
        color = _RED if isinstance(element, ArcSegment) else _BLACK
        _draw_element(document, page, element, layer_name(number, answer, element, is_split=is_split), scale, color)
    beside = {"layer": construction_name(answer, is_split=is_split)}
    for name, at in contour.points.items():
        page.add_point(place(at), dxfattribs=beside)
        text = page.add_text(f"{number}: {name}", height=height, dxfattribs=beside)
        text.set_placement(place(at), align=TextEntityAlignment.BOTTOM_LEFT)


def _draw_element(document: Drawing, page: Modelspace, element: Segment, layer: str, scale: float, color: int) -> None:
    if not document.layers.has_entry(layer):
        document.layers.add(layer, color=color)
    style = {"layer": layer}
    start, end = ((at[0] / scale, at[1] / scale) for at in (element.start, element.end))
    if not isinstance(element, ArcSegment):
        page.add_line(start, end, dxfattribs=style)
        return
    center, radius = (element.center[0] / scale, element.center[1] / scale), element.radius / scale
    if hypot(element.end[0] - element.start[0], element.end[1] - element.start[1]) <= LENGTH:
        page.add_circle(center, radius, dxfattribs=style)
        return
    # An arc of DXF runs counter-clockwise.
    first, last = (start, end) if element.turn is Turn.CCW else (end, start)
    page.add_arc(center, radius, _angle(center, first), _angle(center, last), dxfattribs=style)


def _angle(center: Point, at: Point) -> float:
    return degrees(atan2(at[1] - center[1], at[0] - center[0])) % _FULL
