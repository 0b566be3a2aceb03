"""What is measured of a path, as one record: of expressions, of the names of a function's outputs, or of numbers."""

from collections.abc import Callable, Mapping
from typing import Any

from msgspec import Struct

from contoursolve.solving.corners import CornerPath

Pair = tuple[Any, Any]


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

        def name(text: str, value: Any) -> str:
            declare(text, value)
            return text

        return self._each(name)

    def read(self, out: Callable[[str], Any]) -> "PathOutputs":
        """What is behind these names: numbers, columns or expressions."""
        return self._each(lambda _, name: out(name))

    def _each(self, of: Callable[[str, Any], Any]) -> "PathOutputs":
        def part(kind: str, values: Mapping[str, Any]) -> dict[str, Any]:
            return {name: of(f"{kind}:{name}", value) for name, value in values.items()}

        corners = {name: _corner(name, corner, of) for name, corner in self.corners.items()}
        return PathOutputs(
            part("length", self.lengths), part("room", self.rooms), corners, part("landing", self.landings)
        )


def _corner(name: str, corner: CornerPath, of: Callable[[str, Any], Any]) -> CornerPath:
    def pair(kind: str, values: Pair) -> Pair:
        return of(f"{kind}:{name}.0", values[0]), of(f"{kind}:{name}.1", values[1])

    return CornerPath(
        setback_in=of(f"setback-in:{name}", corner.setback_in),
        setback_out=of(f"setback-out:{name}", corner.setback_out),
        begin=pair("begin", corner.begin),
        end=pair("end", corner.end),
        center=None if corner.center is None else pair("center", corner.center),
        turn=of(f"turn:{name}", corner.turn),
        cosine=of(f"cosine:{name}", corner.cosine),
        residuals=tuple(of(f"corner-residual:{name}:{place}", each) for place, each in enumerate(corner.residuals)),
    )
