"""Results of a contour by their names, read in one way wherever one is named, and what a family has of them."""

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

import numpy
from msgspec.structs import replace
from numpy.typing import NDArray

from contoursolve.diagnostics import did_you_mean
from contoursolve.families.errors import FamilyError
from contoursolve.geometry import (
    PATH_END,
    Arc,
    Figure,
    GrammarError,
    Line,
    Plane,
    PointName,
    Profile,
    RadiusIs,
    ResultName,
    StraightIs,
    read_result,
    vocabulary_of,
    write_result,
)
from contoursolve.numeric import Array

LENGTH = "length"
"""The name of the length of the path."""

ROOM, ASKED, RESIDUAL = ".room", "asked.", "residual"
"""Names of columns: what the corners leave of an element, what is asked for with `?`, and how exact a row is."""

Columns = Mapping[str, NDArray[Any]]


def coordinate_name(point: str, letter: str) -> str:
    """The name of a coordinate: `V2 X`."""
    return f"{point} {letter}"


def factors_of(plane: Plane) -> tuple[int, int]:
    """By how much the numbers that a person reads of each axis are larger than those of points, where X is a radius."""
    first, second = plane.diameters
    return 1 + first, 1 + second


class ResultNames:
    """The results of a contour by all the names that they go by. `columns` are the names of those that are known as
    numbers, or have derivatives."""

    def __init__(self, profile: Profile, columns: Iterable[str]) -> None:
        self.figure, self.plane = profile.figure, profile.plane
        self.columns = tuple(each for each in columns if each != RESIDUAL)
        words = vocabulary_of(profile)
        own = (each for each in self._points if each.rpartition(".")[0] not in words.elements)
        self.words = replace(words, points=tuple(dict.fromkeys((*self.figure.points, *own))))

    @cached_property
    def _points(self) -> list[str]:
        """The points that the columns have coordinates of."""
        letter = coordinate_name("", self.plane.axes[0])
        return [each.removesuffix(letter) for each in self.columns if each.endswith(letter)]

    @property
    def points(self) -> list[str]:
        """The names of the points."""
        return list(dict.fromkeys((PATH_END.of, *self._points)))

    @property
    def known(self) -> dict[str, str]:
        """The names of the results as they are printed, each with its column; that of the length is empty."""
        ends = {
            coordinate_name(PATH_END.of, letter): coordinate_name(end_name(self.figure), letter)
            for letter in self.plane.axes
            if self.figure.path
        }
        found = {name: column for name, column in ends.items() if column in self.columns}
        return found | {self._printed(each): each for each in self.columns} | {LENGTH: ""}

    def _printed(self, column: str) -> str:
        """The name of the result that a column has."""
        own = next((each.name for each in self.figure.path if isinstance(each, Arc) and each.radius == column), "")
        if own:
            return write_result(ResultName(quantity=RadiusIs(own, None)), self.plane)
        line = column.removesuffix(ROOM)
        if any(each.name == line and isinstance(each, Line) for each in self.figure.path):
            return write_result(ResultName(quantity=StraightIs(line, None)), self.plane)
        return column

    def read(self, name: str) -> ResultName:
        """The result, or the point, of a name. Raises FamilyError, which names those that are like it, or all."""
        check_text("result", name)
        try:
            return read_result(name, self.words)
        except GrammarError as error:
            known = [*self.known]
            hint = f"{_told(error)}{did_you_mean(' '.join(name.split()), known)}"
            have = f"{hint}the results are {', '.join(known)}"
            raise FamilyError(f"there is no result {name}; {have}" if name.strip() else have) from None

    def column(self, name: str) -> str:
        """The column of a result by its name; empty for the length. Raises FamilyError, as `read`."""
        check_text("result", name)
        asked = f"{ASKED}{' '.join(name.split())}".lower()
        direct = next((each for each in self.columns if each == name or each.lower() == asked), None)
        if direct is not None:
            return direct
        read = self.read(name)
        found = self._column_of(read)
        if found is None:
            known, printed = self.known, write_result(read, self.plane)
            if read.point is not None and read.axis is None:
                axes = " or ".join(coordinate_name(printed, letter) for letter in self.plane.axes)
                raise FamilyError(f"{printed} is a point; name one coordinate of it: {axes}")
            ask = f"state the fact '{printed} = ?' to have it" if read.quantity is not None else ""
            have = f"the results are {', '.join(known)}"
            raise FamilyError(f"there is no result {printed} here; {ask or have}")
        return found

    def printed(self, name: str) -> str:
        """The name of a result as it is printed. Raises FamilyError, as `column`."""
        column = self.column(name)
        is_column = name in self.columns or column.startswith(ASKED)
        return self._printed(column) if is_column else self.written(self.read(name))

    def written(self, read: ResultName) -> str:
        """The name as it is printed. An arc has no straight part; what corners leave of it goes by its column."""
        column = self._column_of(read) or ""
        return self._printed(column) if column.endswith(ROOM) else write_result(read, self.plane)

    def _column_of(self, read: ResultName) -> str | None:
        """The column of a result; empty for the length of the path, None without one."""
        found: str | None = None
        match read:
            case ResultName(None, None, None):
                return ""
            case ResultName(PointName() as point, int(axis)):
                found = coordinate_name(base_name(point, self.figure), self.plane.axes[axis])
            case ResultName(quantity=StraightIs(element, _)):
                found = f"{element}{ROOM}"
            case ResultName(quantity=RadiusIs(element, _)):
                arcs = (each.radius for each in self.figure.path if isinstance(each, Arc) and each.name == element)
                found = next(arcs, f"{element}.radius")
        if found in self.columns:
            return found
        asked = (each for each in self.columns if each.startswith(ASKED))
        return next((each for each in asked if self._is(read, each.removeprefix(ASKED))), None)

    def _is(self, read: ResultName, name: str) -> bool:
        try:
            return read_result(name, self.words) == read
        except GrammarError:
            return False


class NamedResults(dict[str, Any]):
    """Values of a record for each result: by the names as they are printed, and by all others that a result has."""

    def __init__(self, names: ResultNames, values: Mapping[str, Any]) -> None:
        super().__init__(values)
        self.names = names

    def __missing__(self, name: str) -> Any:
        try:
            column = self.names.column(name)
        except FamilyError as error:
            raise KeyError(str(error)) from None
        if column not in self:
            raise KeyError(f"there is no {name} here; there are {', '.join(self)}")
        return self[column]


def check_text(what: str, text: object) -> None:
    """Raise TypeError for a name that is no text."""
    if not isinstance(text, str):
        raise TypeError(f"a {what} is named by a text (str), such as {_EXAMPLES[what]!r}, not {text!r}")


_EXAMPLES = {"result": "end Z", "point": "corner 1.center", "goal": "end Z-50.", "word": "2:A"}


def read_point(name: str, names: ResultNames) -> PointName:
    """The point of a name. Raises FamilyError for another one, which names the points."""
    check_text("point", name)
    have = f"there are {', '.join(names.points)}"
    try:
        read = read_result(name, names.words)
    except GrammarError as error:
        hint = f"{_told(error)}{did_you_mean(' '.join(name.split()), names.points)}"
        raise FamilyError(f"the contour has no point {name}; {hint}{have}") from None
    if read.point is None or read.axis is not None:
        told = f"; write {read.point.text}" if read.point is not None else ""
        raise FamilyError(f"{write_result(read, names.plane)} is no point{told}; {have}")
    return read.point


def _told(error: GrammarError) -> str:
    """The fault of a name of which the beginning is known; empty for another one."""
    return f"{error}; " if error.begin or not str(error).startswith("expected") else ""


def end_name(figure: Figure) -> str:
    """The name of the point at which a figure's path ends."""
    last = figure.path[-1]
    landing = next((corner.name for corner in figure.corners if corner.at == last.head), None)
    return last.head if landing is None else f"{landing}.end"


def base_name(point: PointName, figure: Figure) -> str:
    """The name of a point among those that have columns: `V2`, `corner 1.begin`."""
    if point == PATH_END:
        return end_name(figure)
    element = next((each for each in figure.path if each.name == point.of), None)
    if element is None or not point.part:
        return point.text
    if point.part == "center":
        return element.center if isinstance(element, Arc) else point.text
    return element.tail if point.part == "begin" else element.head


def lengths_of(columns: Columns, plane: Plane) -> Array:
    """The lengths of paths, mm, in the shape of the columns: what the corners leave of each element, and the corners,
    each chord or arc of which is less than half a turn."""
    total = numpy.zeros(next(iter(columns.values())).shape)
    first = coordinate_name(".begin", plane.axes[0])
    for name, column in columns.items():
        if name.endswith(ROOM):
            total += _without_gaps(column)
        elif name.startswith("corner ") and name.endswith(first):
            total += _without_gaps(_corner_length(columns, name.removesuffix(first), plane))
    return total


def _corner_length(columns: Columns, corner: str, plane: Plane) -> Array:
    def apart(one: str, other: str) -> Array:
        def step(letter: str) -> Array:
            first, last = (columns[coordinate_name(f"{corner}.{each}", letter)] for each in (one, other))
            return first - last

        found: Array = numpy.hypot(
            *(step(letter) / factor for letter, factor in zip(plane.axes, factors_of(plane), strict=True))
        )
        return found

    chord = apart("begin", "end")
    if coordinate_name(f"{corner}.center", plane.axes[0]) not in columns:
        return chord
    radius = apart("begin", "center")
    with numpy.errstate(invalid="ignore", divide="ignore"):
        arc = 2 * radius * numpy.arcsin(numpy.minimum(chord / (2 * radius), 1.0))
    # A corner that is left out has no radius; of several kinds of rows, a chamfer has no centre.
    return numpy.where(radius > 0, arc, chord)


def _without_gaps(column: Array) -> Array:
    """A column with 0 for what a row does not have."""
    return numpy.where(numpy.isnan(column), 0.0, column)
