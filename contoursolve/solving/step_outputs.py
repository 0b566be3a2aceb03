"""The measures of one step of a construction as one record, and a table of how each is tested."""

from collections.abc import Callable, Iterator, Mapping
from enum import Enum
from typing import Any

from msgspec import Struct
from msgspec.structs import astuple

from contoursolve.tolerance import TOUCHING


class Need(Enum):
    """The conditions on a step besides its equations."""

    REGULAR = "its determinant is not zero"
    REAL = "its discriminant is not negative"
    POSITIVE = "a radius, or what tells a sense, is positive"


class StepOutputs(Struct, frozen=True, eq=False):
    """The measures of a step: expressions, or the names of a function's outputs; None where a step has no such."""

    entries: tuple[tuple[Any, ...], ...] = ()
    """The matrix of affine equations that are so as they are, by row."""
    constants: tuple[Any, ...] = ()
    """Their constants, by row, mm."""
    determinant: Any = None
    """Of affine equations; or the length of the direction that they leave a conic."""
    short: Any = None
    """By how much the stated radius of a half circle is less than its points say, mm."""
    distance: Any = None
    """Between the centres of two circles, mm."""
    leading: Any = None
    """The coefficient of the square in the equation of a conic on a line."""
    discriminant: Any = None
    """Of the equation whose two roots are the two places, mm**2 where they are those of circles."""
    offset: Any = None
    """From a centre to a line, or along the way to another centre to the common chord, mm."""
    radius: Any = None
    """Of the circle whose centre it is, mm."""
    gap: Any = None
    """The radius less the offset, mm."""
    scale: Any = None
    """The size of what the offset is made of, mm: rounding of the gap is a share of it."""

    def named(self, number: int, declare: Callable[[str, Any], None]) -> "StepOutputs":
        """The names of these measures of the step of this number, each of which is declared as an output of a
        function."""

        def name(kind: str, value: Any) -> Any:
            if value is None:
                return None
            if isinstance(value, tuple):
                return tuple(name(f"{kind}:{index}", each) for index, each in enumerate(value))
            declare(kind, value)
            return kind

        fields = zip(self.__struct_fields__, astuple(self), strict=True)
        return StepOutputs(*[name(f"{field}:{number}", value) for field, value in fields])

    def read(self, out: Callable[[str], Any]) -> "StepOutputs":
        """The numbers, columns or expressions behind these names."""

        def of(names: Any) -> Any:
            return tuple(map(of, names)) if isinstance(names, tuple) else None if names is None else out(names)

        return StepOutputs(*map(of, astuple(self)))

    def conditions(self) -> Iterator[tuple[Need, Any]]:
        """Its measures that a condition is about, in order."""
        for field, test in SIGN_TESTS.items():
            if test.need is not None and getattr(self, field) is not None:
                yield test.need, getattr(self, field)

    def signs(self) -> Iterator[tuple[Any, tuple[int, ...]]]:
        """Its measures whose signs leave one solution, with these signs."""
        for field, test in SIGN_TESTS.items():
            if test.signs and getattr(self, field) is not None:
                yield getattr(self, field), test.signs

    @property
    def of_touching(self) -> tuple[Any, ...]:
        """The measures that tell whether its two places are one."""
        return self.offset, self.radius, self.scale

    def is_touching(self, out: Mapping[str, Any]) -> Any:
        """True where its two places are one, as far as floats can tell: of outputs, numbers or columns."""
        offset, radius, scale = (out[name] for name in self.of_touching)
        return abs(radius - abs(offset)) <= TOUCHING * scale


class SignTest(Struct, frozen=True):
    """The test of a measure: the condition that it is for, and the signs that leave one solution."""

    need: Need | None = None
    signs: tuple[int, ...] = ()


SIGN_TESTS: Mapping[str, SignTest] = {
    "determinant": SignTest(Need.REGULAR, (-1, 1)),
    "distance": SignTest(Need.REGULAR),
    # One that is exactly zero leaves one solution, too.
    "discriminant": SignTest(Need.REAL, (0, 1)),
    "radius": SignTest(signs=(1,)),
}
"""By the field of the record; others are for messages and for further checks."""
