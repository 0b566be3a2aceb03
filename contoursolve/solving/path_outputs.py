"""The measures of a path as one record: of expressions, of the names of a function's outputs, or of numbers."""

from collections.abc import Callable, Mapping
from typing import Any

from msgspec import Struct

from contoursolve.solving.corners import CornerPath, Pair


class PathOutputs(Struct, frozen=True, eq=False):
    """The measures of a path, mm, by the names of its elements and corners.

    `lengths` are those of the elements, along their direction, so that a reversed line has a negative one, and of lines
    beside the path that corners land on. `rooms` are what the corners leave of the elements. `landings` tell the way
    (-1, 0 or 1) in which a corner lands where no element follows.
    """

    lengths: Mapping[str, Any]
    rooms: Mapping[str, Any]
    corners: Mapping[str, CornerPath]
    landings: Mapping[str, Any]

    @property
    def residuals(self) -> tuple[Any, ...]:
        """By how much the corners miss their definitions, mm."""
        return tuple(each for corner in self.corners.values() for each in corner.residuals)

    def named(self, declare: Callable[[str, Any], None]) -> "PathOutputs":
        """The names of these measures, each of which is declared as an output of a function."""

        def name(kind: str, of: str, value: Any) -> str:
            declare(text := f"{kind}:{of}", value)
            return text

        def pair(kind: str, of: str, values: Pair) -> Pair:
            return name(kind, f"{of}.0", values[0]), name(kind, f"{of}.1", values[1])

        def corner(of: str, each: CornerPath) -> CornerPath:
            return CornerPath(
                name("setback-in", of, each.setback_in),
                name("setback-out", of, each.setback_out),
                pair("begin", of, each.begin),
                pair("end", of, each.end),
                None if each.center is None else pair("center", of, each.center),
                name("turn", of, each.turn),
                name("cosine", of, each.cosine),
                tuple(name(f"corner-residual:{of}", str(n), value) for n, value in enumerate(each.residuals)),
            )

        return PathOutputs(
            {of: name("length", of, value) for of, value in self.lengths.items()},
            {of: name("room", of, value) for of, value in self.rooms.items()},
            {of: corner(of, each) for of, each in self.corners.items()},
            {of: name("landing", of, value) for of, value in self.landings.items()},
        )

    def read(self, out: Callable[[str], Any]) -> "PathOutputs":
        """The numbers, columns or expressions behind these names."""
        return PathOutputs(
            {name: out(value) for name, value in self.lengths.items()},
            {name: out(value) for name, value in self.rooms.items()},
            {name: _read(corner, out) for name, corner in self.corners.items()},
            {name: out(value) for name, value in self.landings.items()},
        )


def _read(corner: CornerPath, out: Callable[[str], Any]) -> CornerPath:
    (a, b), (c, d), center = corner.begin, corner.end, corner.center
    return CornerPath(
        out(corner.setback_in),
        out(corner.setback_out),
        (out(a), out(b)),
        (out(c), out(d)),
        None if center is None else (out(center[0]), out(center[1])),
        out(corner.turn),
        out(corner.cosine),
        tuple([out(each) for each in corner.residuals]),
    )
