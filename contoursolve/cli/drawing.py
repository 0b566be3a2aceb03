"""Options of commands that read a sketch, or a DXF drawing for one."""

from collections.abc import Callable, Mapping
from functools import wraps
from pathlib import Path
from typing import Any

import click

from contoursolve.cli.printing import print_lines, say
from contoursolve.gcode import decode, read_bytes, write_whole
from contoursolve.program import find_control
from contoursolve.reading import Control
from contoursolve.sketches import ContourSketch, read_dxf, read_sketch, write_sketch

_BEGINS = b"AC10", b"AutoCAD Binary DXF"
"""A drawing that is no text: DWG, and DXF in binary."""


class _Place(click.ParamType):  # type: ignore[type-arg]  # generic in newer releases of click only
    """Two coordinates, such as 0,100."""

    name = "X,Y"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, float]:
        """Both numbers."""
        try:
            first, second = map(float, str(value).split(","))
        except ValueError:
            self.fail(f"{value!r} is no place; write two numbers with points, such as 0,100.5", param, ctx)
        return first, second


_OPTIONS = (
    click.option("--layer", metavar="NAME", help="DXF: the layer of the contour, or a pattern such as 'contour*'."),
    click.option(
        "--part", type=click.Choice(["turned", "milled"]), help="DXF: the part; without it, as NAME makes it."
    ),
    click.option(
        "--unit",
        type=click.Choice(["mm", "inch", "m"]),
        help="DXF: the unit, where the drawing tells none or a wrong one.",
    ),
    click.option("--zero", type=_Place(), help="DXF: the place that is zero; its Y is the axis of a turned part."),
    click.option("--chain", type=click.IntRange(1), metavar="N", help="DXF: the chain, where there are several."),
    click.option("--join", type=click.FloatRange(0, 1, min_open=True), metavar="MM", help="DXF: ends so near meet."),
    click.option("--reverse", is_flag=True, help="DXF: travel the chain the other way."),
    click.option("--sketch", "kept", metavar="NEW", help="DXF: write the sketch, too, to change what is given."),
)
_NAMES = ("layer", "part", "unit", "zero", "chain", "join", "reverse", "kept")


def drawing_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Options for a DXF drawing, all passed as one argument, `drawing`."""

    @wraps(function)
    def take(*arguments: Any, **options: Any) -> Any:
        drawing = {name: options.pop(name) for name in _NAMES}
        return function(*arguments, drawing=drawing, **options)

    for option in reversed(_OPTIONS):
        take = option(take)
    return take


def read_drawn(file: str, control: str | Control | None, drawing: Mapping[str, Any]) -> ContourSketch:
    """The sketch of a file, or of a DXF drawing; what a drawing has besides is told on standard error. Raises
    DxfError, SketchError, UsageError."""
    data = read_bytes(file, "a sketch or a DXF drawing")
    given = {name: value for name, value in drawing.items() if value}
    is_drawing = file.lower().endswith((".dxf", ".dwg")) or data.split(None, 2)[:2] == [b"0", b"SECTION"]
    if not (is_drawing or data.startswith(_BEGINS)):
        if given:
            name = "--sketch" if "kept" in given else f"--{next(iter(given))}"
            raise click.UsageError(f"{name} is for a DXF drawing, and {file} is none")
        return read_sketch(decode(data, file))
    kept = given.pop("kept", None)
    if "part" not in given:
        if control is None:
            raise click.UsageError(
                "a DXF drawing does not say how its part is made: add --part turned or --part milled"
            )
        target = find_control(control) if isinstance(control, str) else control
        given["part"] = "turned" if any(target.plane.diameters) else "milled"
    if kept and Path(kept).exists():
        raise click.UsageError(f"{kept} exists; name another file for the sketch")
    found = read_dxf(data, **given)
    print_lines((*found.notes, *(f"given: {each}" for each in found.given)), err=True)
    if kept:
        write_whole(Path(kept), (write_sketch(found.sketch).encode(),), keeps_backup=False)
        say(f"{kept} written", err=True)
    return found.sketch
