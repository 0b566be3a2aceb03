"""A drawing under construction, to which statements add what they speak about."""

from collections.abc import Mapping, Sequence
from decimal import Decimal

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.gcode import Word
from contoursolve.geometry.fact import Fact
from contoursolve.geometry.figure import FIRST, SECOND, Arc, Circle, Corner, CornerShape, Figure, Line, scalar
from contoursolve.geometry.lines import (
    Along,
    ChamferLeg,
    Distance,
    EqualDistances,
    Parallel,
    Tangent,
    carry,
    direction_at,
    put_on,
)
from contoursolve.geometry.points import Radius
from contoursolve.geometry.profile import Given, Layout, Unit
from contoursolve.geometry.touching import Foot, round_off, set_back
from contoursolve.tolerance import RADIUS_DIFFERENCE


class StatementError(ValueError):
    """A statement that makes no sense for this drawing; the message says why."""


class DraftCircle(Struct, frozen=True):
    """A circle, an arc or a rounding: its centre, its radius, and where it begins and ends, if it does."""

    center: str
    radius: str
    begin: str = ""
    end: str = ""


class Draft:
    """A figure, its facts and its givens. Statements ask it for elements, which it adds as they are needed.

    `word` is what states the facts that are being added; it is kept with their givens.
    """

    def __init__(self, figure: Figure, facts: Sequence[Fact], givens: Mapping[str, Given]) -> None:
        self.figure = figure
        self.facts = list(facts)
        self.givens = dict(givens)
        self.word: Word | None = None

    def layout(self) -> Layout:
        """The figure with all the facts."""
        return Layout(self.figure, tuple(self.facts))

    def add(self, *facts: Fact) -> None:
        """Add facts."""
        self.facts += facts

    def give(self, name: str, value: Decimal, unit: Unit, *, is_diameter: bool = False) -> str:
        """Add a given and return its name."""
        self.givens[name] = Given(name, value, unit, self.word, is_diameter)
        return name

    def element(self, name: str) -> Line | Arc | Corner | Circle:
        """The element of this name. Raises StatementError if there is none."""
        everything = (*self.figure.path, *self.figure.corners, *self.figure.lines, *self.figure.circles)
        for element in everything:
            if element.name == name:
                return element
        names = ", ".join(element.name for element in everything)
        raise StatementError(f"there is no element {name!r} here; elements are {names}")

    def line(self, name: str) -> Line:
        """A line whose direction can be spoken about: stated, or unknown as a whole."""
        line = self.element(name)
        if not isinstance(line, Line):
            raise StatementError(f"{name} is not a line")
        if line.heading is None and name not in self.figure.carriers:
            self.figure = replace(self.figure, carriers=(*self.figure.carriers, name))
            self.add(*carry(line))
        return line

    def part(self, name: str) -> Line | Arc:
        """An arc of the path, or a line whose direction can be spoken about."""
        element = self.element(name)
        return element if isinstance(element, Arc) else self.line(name)

    def point_on(self, line: str) -> str:
        """A point of a line: where it begins, a place that it passes through, or else the point nearest to the start,
        which is added."""
        own = self.line(line)
        passed = (fact.passes for fact in self.facts if fact.passes)
        found = own.tail or next((point for name, point in passed if name == line), "")
        if found:
            return found
        foot = f"{line}.foot"
        self.figure = replace(self.figure, points=(*self.figure.points, foot))
        self.add(put_on(own, foot), Foot(line, foot, self.figure.start))
        return foot

    def around(self, name: str, center: str, distance: Decimal) -> DraftCircle:
        """The places at a given distance from a point: a circle that is not drawn."""
        radius = self.give(f"{name}.radius", distance, Unit.MM)
        self.figure = replace(self.figure, known_radii=(*self.figure.known_radii, radius))
        return DraftCircle(center, radius)

    def round(self, name: str) -> DraftCircle:
        """An arc, a circle, or a rounding. Raises StatementError for anything else."""
        match self.element(name):
            case Arc() as arc:
                return DraftCircle(arc.center, arc.radius, arc.tail, arc.head)
            case Circle() as circle:
                return DraftCircle(circle.center, circle.radius)
            case Corner() as corner if corner.shape is CornerShape.FILLET:
                self.corner(name)
                return DraftCircle(f"{name}.center", f"{name}.radius", f"{name}.begin", f"{name}.end")
            case _:
                raise StatementError(f"{name} is not round")

    def point(self, part: str, name: str) -> str:
        """The point that begins, ends or centers an element."""
        element = self.element(name)
        if isinstance(element, Corner):
            self.corner(name)
            if part == "center" and element.shape is not CornerShape.FILLET:
                raise StatementError(f"{name} is not round")
            return f"{name}.{part}"
        if part == "center":
            return self.round(name).center
        found = {"begin": getattr(element, "tail", ""), "end": getattr(element, "head", "")}[part]
        if not found:
            raise StatementError(f"{name} has no {part}")
        return str(found)

    def place(self, name: str, values: tuple[Decimal, Decimal]) -> str:
        """A point with given coordinates, mm."""
        for axis, value in enumerate(values):
            self.give(scalar(name, axis), value, Unit.MM)
        self.figure = replace(self.figure, places=(*self.figure.places, name))
        return name

    def circle(self, name: str, center: tuple[Decimal, Decimal], radius: Decimal) -> DraftCircle:
        """A given circle."""
        if radius <= 0:
            raise StatementError("a circle has a radius larger than 0; a line through a point `passes through` it")
        place = self.place(f"{name}.center", center)
        known = self.give(f"{name}.radius", radius, Unit.MM)
        self.figure = replace(
            self.figure,
            known_radii=(*self.figure.known_radii, known),
            circles=(*self.figure.circles, Circle(name, place, known)),
        )
        return DraftCircle(place, known)

    def given_line(self, name: str, place: tuple[Decimal, Decimal], degrees: Decimal) -> str:
        """A given line through a place in a direction."""
        line = Line(name, self.place(f"{name}.place", place), "", self.give(f"{name}.angle", degrees, Unit.DEGREE))
        self.figure = replace(self.figure, lines=(*self.figure.lines, line))
        return name

    def junction(self, first: str, second: str) -> str:
        """The point in which two neighbours of the path meet."""
        one, other = self.element(first), self.element(second)
        if isinstance(one, Line | Arc) and isinstance(other, Line | Arc):
            for before, after in ((one, other), (other, one)):
                if before.head and before.head == after.tail:
                    return before.head
        raise StatementError(f"{first} and {second} are not neighbours")

    def travel(self, name: str, at: str) -> Along | Tangent:
        """The direction in which an element of the path is travelled at one of its ends."""
        return direction_at(self.part(name), at)

    def leave(self, point: str, arc: Arc) -> None:
        """Drop that a point lies on an arc's circle: something else says so, in a way that keeps a tangent point
        apart from a double intersection."""
        circles = ((fact, fact.circle) for fact in self.facts)
        self.facts = [fact for fact, on in circles if on is None or (on.point, on.center) != (point, arc.center)]

    def corner(self, name: str, *, is_solved: bool = True) -> None:
        """Make a corner's own points and its size unknowns, tied to its lines. Raises StatementError for a chamfer by
        its face, or at 45 degrees beside an arc, whose equations are not solved."""
        corner = self.element(name)
        if not isinstance(corner, Corner) or f"{name}.begin" in self.figure.points:
            return
        begin, end, size = f"{name}.begin", f"{name}.end", f"{name}.radius"
        meeting = [
            (self.element(corner.before), begin, 1),
            (self.element(corner.after or self._landing(corner)), end, -1),
        ]
        slack = min([fact.circle.slack for fact in self.facts if fact.circle], default=RADIUS_DIFFERENCE)
        if corner.size in self.givens:
            self.add(Radius(corner.size, size))
        points = (begin, end) if corner.shape is not CornerShape.FILLET else (f"{name}.center", begin, end)
        for met, point, way in meeting:
            element = self.part(met.name)
            self.add(put_on(element, point, slack=slack))
            if corner.shape is CornerShape.FILLET:
                self.add(*round_off(corner, element, point, way))
            elif corner.shape is CornerShape.CHAMFER_SETBACK:
                self.add(set_back(corner, element, point, way))
        if corner.shape is CornerShape.CHAMFER_FACE:
            if is_solved:
                raise StatementError(f"{name} is a chamfer by the length of its face: its size must be a number")
            self.add(Distance(corner.size, begin, end), EqualDistances("", (begin, corner.at), (corner.at, end)))
        share = corner.shape.share
        if share:
            is_beside_arc = any(isinstance(element, Arc) for element, *_ in meeting)
            if is_beside_arc and is_solved:
                raise StatementError(f"{name} is a bevel beside an arc: its size must be a number")
            advance = () if corner.lands_on or is_beside_arc else self._advance(corner)
            is_between = bool(corner.lands_on) and not is_beside_arc
            between = tuple(element.name for element, *_ in meeting) if is_between else ()
            self.add(
                *(
                    ChamferLeg(begin, end, size, f"{name}.{axis}", axis, advance, between, share=share)
                    for axis in (FIRST, SECOND)
                )
            )
        self.figure = replace(self.figure, points=(*self.figure.points, *points), radii=(*self.figure.radii, size))

    def _advance(self, corner: Corner) -> tuple[tuple[str, ...], ...]:
        """The lines, or pairs of points, whose way along an axis is that of a 45 degree chamfer; the first that moves
        counts."""
        lines = [element for element in self.figure.path if isinstance(element, Line)]
        index = next(number for number, line in enumerate(lines) if line.name == corner.before)
        if corner.after is not None:
            after = next(line for line in lines if line.name == corner.after)
            return ((lines[index].tail, after.head),)
        return tuple(
            (line.tail, line.head) if line.heading is None else (line.name,) for line in reversed(lines[: index + 1])
        )

    def _landing(self, corner: Corner) -> str:
        """The line that a last corner lands on."""
        if corner.lands_on is not None:
            return corner.lands_on
        if corner.lands_parallel_to is None:
            raise StatementError(f"{corner.name} needs the last line by its angle and one coordinate")
        name = f"{corner.name}.landing"
        line = Line(name, corner.at, "")
        self.figure = replace(self.figure, lines=(*self.figure.lines, line))
        self.line(name)
        self.add(Parallel(name, corner.lands_parallel_to, self._advance(corner)))
        return name
