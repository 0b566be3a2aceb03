"""The calculation of a contour by hand, step by step as its construction has it: triangles, formulas, numbers."""

from collections.abc import Iterator, Mapping
from math import hypot
from typing import Any

from msgspec import Struct

from contoursolve.diagnostics import Shown
from contoursolve.geometry import FIRST, SECOND, Arc, Corner, CornerShape, Fact, Line, Profile, System, scalar
from contoursolve.solving import ConstructionStep, CornerSolution, StepKind, steps_of, symbolic_values

Pair = tuple[Any, Any]


Triangle = tuple[tuple[str, tuple[float, float]], ...]
"""The corners of a triangle by their names, mm."""


class CalculationLine(Struct, frozen=True):
    """One line: the symbol that it finds, the formula (of sympy), the same with numbers, and the value: mm, X of a
    lathe as radius, or degrees."""

    symbol: Any
    formula: Any
    numbers: str
    value: float
    unit: str
    meaning: str = ""


class Calculation(Struct, frozen=True):
    """The lines that find one point, radius or corner: what is found, why so, and the corners of the triangle in which
    it is calculated (mm); none where there is no triangle. `is_searched` tells that nobody can calculate it by hand."""

    title: str
    lines: tuple[CalculationLine, ...]
    triangle: Triangle = ()
    is_searched: bool = False


class Derivation(Shown, Struct, frozen=True):
    """The calculation of a contour by hand: `steps` find its points one after the other, then its corners."""

    steps: tuple[Calculation, ...]


class HandCalculation:
    """The calculations of one contour, made of the symbols of its system and the values of the solution."""

    def __init__(
        self,
        profile: Profile,
        system: System,
        symbols: Any,
        values: Mapping[Any, Any],
        scalars: Mapping[str, float],
        corners: Mapping[str, CornerSolution],
    ) -> None:
        from contoursolve.numeric import hand, symbolic  # noqa: PLC0415 - sympy is slow to import

        self._hand = hand
        self._profile, self._system, self._symbols = profile, system, symbols
        self._scalars, self._corners = scalars, corners
        self._sheet = hand.Sheet(values)
        self._sheet.angles |= {
            symbols.angle(given.name) for given in profile.givens.values() if given.unit.value == "deg"
        }
        self._at = symbolic_values(symbols, symbolic.FUNCTIONS, system.headed)
        self._number = 0
        self._lines: list[CalculationLine] = []
        self._triangle: Triangle = ()

    def steps(self) -> Iterator[Calculation]:
        """The calculations in the order of the construction, then those of the corners."""
        pending: list[ConstructionStep] = []
        for step in steps_of(self._system):
            if pending and not (_is_placed(step) and _is_placed(pending[-1]) and step.point == pending[-1].point):
                yield self._found(pending)
                pending = []
            pending.append(step)
        if pending:
            yield self._found(pending)
        for corner in self._system.figure.corners:
            if corner.name in self._corners:
                yield self._corner(corner)

    # One line ------------------------------------------------------------------------------------------------------

    def _put(self, name: str | Any, formula: Any, unit: str = "mm", meaning: str = "") -> Any:
        """A line of the calculation; its symbol."""
        is_angle = unit == "deg"
        own = f"{name}_{self._number}" if isinstance(name, str) else name
        numbers = self._sheet.numbers(formula)
        symbol, value = self._sheet.put(own, formula, is_angle=is_angle)
        shown = value * 57.29577951308232 if is_angle else value
        self._lines.append(CalculationLine(symbol, formula, numbers, shown, unit, meaning))
        return symbol

    def _done(self, title: str, *, is_searched: bool = False) -> Calculation:
        found = Calculation(title, tuple(self._lines), self._triangle, is_searched)
        self._lines, self._triangle = [], ()
        return found

    def _point(self, name: str) -> Pair:
        return self._at.coordinate(name, FIRST), self._at.coordinate(name, SECOND)

    def _place(self, pair: Pair) -> tuple[float, float]:
        return self._sheet.value(pair[0]), self._sheet.value(pair[1])

    def _right(self, one: str, first: Pair, other: str, second: Pair) -> Triangle:
        """The right triangle between two points, with its legs along the axes."""
        (a, b), (x, y) = self._place(first), self._place(second)
        return (one, (a, b)), ("", (x, b)), (other, (x, y))

    # Steps ---------------------------------------------------------------------------------------------------------

    def _found(self, steps: list[ConstructionStep]) -> Calculation:
        self._number += 1
        step = steps[0]
        names = [name for each in steps for name in each.unknowns]
        things = dict.fromkeys(name.rpartition(".")[0] or name for name in names)
        title = ", ".join(things)
        if len(steps) > 1 or _is_placed(step):
            for each in steps:
                self._placed(each)
            return self._done(f"{title}: its coordinates are stated")
        if step.kind is StepKind.RADIUS:
            circle = step.circles[0]
            (x, y), (a, b) = self._point(circle.point), self._point(circle.center)
            self._put(self._symbols.scalar(step.unknowns[0]), self._hand.root((x - a) ** 2 + (y - b) ** 2))
            self._triangle = self._right(circle.center, (a, b), circle.point, (x, y))
            return self._done(f"{title}: the distance from {circle.center} to {circle.point}")
        if step.kind is StepKind.LINE_CIRCLE:
            return self._line_circle(step)
        if step.kind is StepKind.TWO_CIRCLES:
            return self._two_circles(step)
        if step.kind is StepKind.AFFINE:
            lines = [self._line_of(fact, step) for fact in step.facts]
            if len(step.unknowns) == 1 and lines[0] is not None:
                return self._leg(step, lines[0])
            if len(lines) == 2 and lines[0] is not None and lines[1] is not None:  # noqa: PLR2004 - two lines
                return self._two_lines(step, lines[0], lines[1])
            found = self._hand.solve_linear(
                [fact.equation(self._at) for fact in step.facts], [self._symbols.scalar(name) for name in step.unknowns]
            )
            if found is not None:
                for name, formula in zip(step.unknowns, found, strict=True):
                    self._put(self._symbols.scalar(name), formula, "" if name.endswith((".cos", ".sin")) else "mm")
                return self._done(f"{title}: from linear equations")
        for name in step.unknowns:
            unit = "" if name.endswith((".cos", ".sin")) else "mm"
            symbol, value = self._symbols.scalar(name), self._scalars[name]
            self._sheet.put(symbol, value)
            self._lines.append(CalculationLine(symbol, symbol, "", value, unit))
        return self._done(f"{title}: no calculation by hand, several equations are solved together", is_searched=True)

    def _placed(self, step: ConstructionStep) -> None:
        (fact,) = step.facts
        if fact.sizes:
            self._put(self._symbols.scalar(fact.sizes), self._at.amount(fact.given))
            return
        if fact.placed is None:
            raise ValueError(f"{fact} places nothing")
        point, axis, origin, is_stepped = fact.placed
        right = self._at.coordinate(origin, axis) if origin else 0
        right = right + self._at.amount(fact.given) if is_stepped else right
        self._put(self._at.coordinate(point, axis), right)

    def _line_of(self, fact: Fact, step: ConstructionStep) -> tuple[Pair, Any, str] | None:
        """A known point of the line on which a fact puts a point of a step, the line's angle, and its name."""
        if fact.heading:
            tail, head = fact.heading
            other = tail if step.point == head else head
            return self._point(other), self._symbols.angle(fact.given), other
        if fact.collinear and not {*fact.collinear[:1]} & {step.point}:
            tail, through, point = fact.collinear
            other = point if through == step.point else through
            if other == step.point:
                return None
            (a, b), (c, d) = self._point(tail), self._point(other)
            name = f"w{'' if not any(str(each.symbol).startswith('w') for each in self._lines) else 2}"
            return (
                (a, b),
                self._put(name, self._hand.heading(d - b, c - a), "deg", f"angle from {tail} to {other}"),
                tail,
            )
        return None

    def _leg(self, step: ConstructionStep, line: tuple[Pair, Any, str]) -> Calculation:
        """One coordinate of a point on a line, by a right triangle of which a leg and an angle are known."""
        (a, b), angle, other = line
        point, axis = step.point, int(step.unknowns[0].rpartition(".")[2])
        x, y = self._point(point)
        tangent = self._hand.tangent(angle)
        self._put(x if axis == FIRST else y, a + (y - b) / tangent if axis == FIRST else b + (x - a) * tangent)
        self._triangle = self._right(other, (a, b), point, (x, y))
        return self._done(f"{point}: right triangle from {other}, one leg and the angle are known")

    def _two_lines(
        self, step: ConstructionStep, first: tuple[Pair, Any, str], second: tuple[Pair, Any, str]
    ) -> Calculation:
        """The intersection of two lines, by the law of sines."""
        (a, b), one, begin = first
        (c, d), other, end = second
        sine, cosine = self._hand.sine, self._hand.cosine
        along = ((c - a) * sine(other) - (d - b) * cosine(other)) / sine(other - one)
        t = self._put("t", along, meaning=f"from {begin} to {step.point}, by the law of sines")
        x, y = self._point(step.point)
        self._put(x, a + t * cosine(one))
        self._put(y, b + t * sine(one))
        self._triangle = (begin, self._place((a, b))), (step.point, self._place((x, y))), (end, self._place((c, d)))
        return self._done(f"{step.point}: triangle {begin}, {step.point}, {end}; one side and its angles are known")

    def _line_circle(self, step: ConstructionStep) -> Calculation:
        (circle,) = step.circles
        line = self._line_of(step.of_line, step)
        if line is None:
            raise ValueError("the line of a step has a known point")
        (a, b), angle, _ = line
        center, radius = self._point(step.centers[0]), self._at.radius(circle.radius)
        x, y = self._point(step.point)
        way = self._crossing((a, b), angle, center, radius, self._meant(step.point))
        self._put(x, a + way * self._hand.cosine(angle))
        self._put(y, b + way * self._hand.sine(angle))
        return self._done(f"{step.point}: the line meets the circle about {step.centers[0]}; half the chord is a leg")

    def _meant(self, point: str) -> tuple[float, float]:
        return self._scalars[scalar(point, FIRST)], self._scalars[scalar(point, SECOND)]

    def _crossing(self, tail: Pair, angle: Any, center: Pair, radius: Any, meant: tuple[float, float]) -> Any:
        """The way along a line to a circle, on that side on which a point is meant."""
        sine, cosine = self._hand.sine(angle), self._hand.cosine(angle)
        east, north = center[0] - tail[0], center[1] - tail[1]
        d = self._put("d", north * cosine - east * sine, meaning="from the line to the centre")
        f = self._put("f", east * cosine + north * sine, meaning="along the line to the foot of that")
        h = self._put("h", self._hand.root(radius**2 - d**2), meaning="half the chord")
        way = f + h
        for sign in (1, -1):
            s = self._sheet.value(f + sign * h)
            place = (
                self._sheet.value(tail[0]) + s * self._sheet.value(cosine),
                self._sheet.value(tail[1]) + s * self._sheet.value(sine),
            )
            if hypot(place[0] - meant[0], place[1] - meant[1]) <= _SAME:
                way = f + sign * h
        foot = tail[0] + f * cosine, tail[1] + f * sine
        self._triangle = ("centre", self._place(center)), ("foot", self._place(foot)), ("", meant)
        return way

    def _two_circles(self, step: ConstructionStep) -> Calculation:
        first, second = map(self._point, step.centers)
        one, other = (self._at.radius(circle.radius) for circle in step.circles)
        x, y = self._point(step.point)
        formulas = self._meeting(first, second, one, other, self._meant(step.point))
        self._put(x, formulas[0])
        self._put(y, formulas[1])
        names = " and ".join(step.centers)
        return self._done(f"{step.point}: triangle with {names}, all three sides are known")

    def _meeting(self, first: Pair, second: Pair, one: Any, other: Any, meant: tuple[float, float]) -> tuple[Any, Any]:
        """The formulas of a point at distances from two others, on that side on which it is meant."""
        root = self._hand.root
        c = self._put("c", root((second[0] - first[0]) ** 2 + (second[1] - first[1]) ** 2), meaning="between them")
        w = self._put(
            "w", self._hand.heading(second[1] - first[1], second[0] - first[0]), "deg", "from one to the other"
        )
        a = self._put("a", (c**2 + one**2 - other**2) / (2 * c), meaning="along that")
        h = self._put("h", root(one**2 - a**2), meaning="across it")
        sine, cosine = self._hand.sine(w), self._hand.cosine(w)
        self._triangle = ("1", self._place(first)), ("", meant), ("2", self._place(second))
        found = first[0] + a * cosine - h * sine, first[1] + a * sine + h * cosine
        mirrored = first[0] + a * cosine + h * sine, first[1] + a * sine - h * cosine
        here = self._place(found)
        return found if hypot(here[0] - meant[0], here[1] - meant[1]) <= _SAME else mirrored

    # Corners -------------------------------------------------------------------------------------------------------

    def _corner(self, corner: Corner) -> Calculation:
        self._number += 1
        solved, vertex = self._corners[corner.name], self._point(corner.at)
        elements = {each.name: each for each in self._system.figure.path}
        before = elements[corner.before]
        after = elements[corner.after] if corner.after else None
        name = f"{corner.name.replace(' ', '')}"
        size = self._size(corner)
        if isinstance(before, Line) and not isinstance(after, Arc):
            one, other = self._angle_of(before), self._angle_after(corner, after)
            if other is not None:
                return self._between_lines(corner, solved, vertex, one, other, size)
        if after is not None and corner.shape is CornerShape.FILLET:
            return self._fillet_of_arcs(corner, solved, before, after, size)
        if after is not None and corner.shape is CornerShape.CHAMFER_SETBACK:
            return self._setbacks(corner, solved, before, after, size)
        if after is not None and corner.shape.share:
            return self._bevel_of_arc(corner, solved, before, after, size)
        for part, point in (("begin", solved.begin), ("end", solved.end), ("center", solved.center)):
            for axis, value in enumerate(point or ()):
                symbol, found = self._sheet.put(f"{self._profile.plane.axes[axis]}_{part}_{name}", value)
                self._lines.append(CalculationLine(symbol, symbol, "", found, "mm"))
        return self._done(f"{corner.name}: beside an arc; its equations are solved together", is_searched=True)

    def _size(self, corner: Corner) -> Any:
        name = f"{corner.name}.radius"
        return self._symbols.scalar(name if name in self._system.unknowns else corner.size)

    def _angle_of(self, line: Line) -> Any:
        if line.heading is not None:
            return self._symbols.angle(line.heading)
        (a, b), (c, d) = self._point(line.tail), self._point(line.toward or line.head)
        return self._put(
            f"w{line.name.replace(' ', '')}", self._hand.heading(d - b, c - a), "deg", f"angle of {line.name}"
        )

    def _angle_after(self, corner: Corner, after: Line | None) -> Any:
        if after is not None:
            return self._angle_of(after)
        if corner.lands_on is not None:
            return self._angle_of(self._system.figure.line(corner.lands_on))
        return None

    def _between_lines(
        self, corner: Corner, solved: CornerSolution, vertex: Pair, one: Any, other: Any, size: Any
    ) -> Calculation:
        """A corner between two lines, by the right triangle of half the turn."""
        sine, cosine = self._hand.sine, self._hand.cosine
        turn = self._put("u", self._turn(one, other), "deg", "the turn from one line to the next")
        back = ahead = size
        why = "as far from the intersection on both lines"
        if corner.shape is CornerShape.FILLET:
            back = ahead = self._put("t", abs(size * self._hand.tangent(turn / 2)), meaning="from the intersection")
            why = "right triangle of the radius and half the turn"
        elif corner.shape is CornerShape.CHAMFER_FACE:
            back = ahead = self._put("t", size / (2 * cosine(turn / 2)), meaning="from the intersection")
            why = "right triangle of half the face and half the turn"
        elif corner.shape.share:
            share = self._hand.root(2) / 2 if corner.shape is CornerShape.CHAMFER_LENGTH_45 else 1
            step = [size * share * (1 if solved.end[axis] > solved.begin[axis] else -1) for axis in (FIRST, SECOND)]
            back = self._put(
                "t", (step[0] * sine(other) - step[1] * cosine(other)) / sine(turn), meaning="on the first line"
            )
            ahead = self._put(
                "v", (step[1] * cosine(one) - step[0] * sine(one)) / sine(turn), meaning="on the second line"
            )
            why = "triangle with two angles of 45 degrees to the axes"
        own = corner.name.rpartition(" ")[2]
        axes = self._profile.plane.axes
        begin = vertex[0] - back * cosine(one), vertex[1] - back * sine(one)
        end = vertex[0] + ahead * cosine(other), vertex[1] + ahead * sine(other)
        starts = [self._put(self._named(axes[axis], "begin", own), begin[axis]) for axis in (FIRST, SECOND)]
        for axis in (FIRST, SECOND):
            self._put(self._named(axes[axis], "end", own), end[axis])
        third = ("centre", solved.center) if solved.center else ("end", solved.end)
        self._triangle = ("begin", solved.begin), (corner.at, self._place(vertex)), third
        if corner.shape is CornerShape.FILLET:
            side = 1 if solved.turn > 0 else -1
            self._put(self._named(axes[0], "center", own), starts[0] - side * size * sine(one))
            self._put(self._named(axes[1], "center", own), starts[1] + side * size * cosine(one))
        return self._done(f"{corner.name}: {why}")

    def _fillet_of_arcs(
        self, corner: Corner, solved: CornerSolution, before: Line | Arc, after: Line | Arc, size: Any
    ) -> Calculation:
        """A rounding beside an arc: its centre lies on a line or a circle beside each of the two."""
        if solved.center is None:
            raise ValueError("a rounding has a centre")
        side = 1 if solved.turn > 0 else -1
        vertex, edges = self._point(corner.at), (before, after)
        reaches = [self._reach(each, side, size) if isinstance(each, Arc) else None for each in edges]
        if isinstance(before, Arc) and isinstance(after, Arc):
            center = self._meeting(
                self._point(before.center), self._point(after.center), reaches[0], reaches[1], solved.center
            )
        else:
            line, arc = (before, after) if isinstance(before, Line) else (after, before)
            if not isinstance(line, Line) or not isinstance(arc, Arc):
                raise ValueError("one of two is a line, the other one an arc")
            angle, reach = self._angle_of(line), reaches[edges.index(arc)]
            sine, cosine = self._hand.sine(angle), self._hand.cosine(angle)
            beside = vertex[0] - side * size * sine, vertex[1] + side * size * cosine
            way = self._crossing(beside, angle, self._point(arc.center), reach, solved.center)
            center = beside[0] + way * cosine, beside[1] + way * sine
        own, axes = corner.name.rpartition(" ")[2], self._profile.plane.axes
        m = [self._put(self._named(axes[axis], "center", own), center[axis]) for axis in (FIRST, SECOND)]
        for place, edge, reach in zip(("begin", "end"), edges, reaches, strict=True):
            if isinstance(edge, Arc):
                middle, radius = self._point(edge.center), self._at.radius(edge.radius)
                found = [middle[axis] + (m[axis] - middle[axis]) * radius / reach for axis in (FIRST, SECOND)]
            else:
                angle = self._angle_of(edge)
                found = [m[0] + side * size * self._hand.sine(angle), m[1] - side * size * self._hand.cosine(angle)]
            for axis in (FIRST, SECOND):
                self._put(self._named(axes[axis], place, own), found[axis])
        return self._done(f"{corner.name}: its centre is as far from both elements as its radius")

    def _setbacks(
        self, corner: Corner, solved: CornerSolution, before: Line | Arc, after: Line | Arc, size: Any
    ) -> Calculation:
        """A chamfer beside an arc whose ends are so far from the intersection, on an arc along the chord."""
        vertex = self._point(corner.at)
        own, axes = corner.name.rpartition(" ")[2], self._profile.plane.axes
        for place, edge, way, meant in (("begin", before, -1, solved.begin), ("end", after, 1, solved.end)):
            if isinstance(edge, Arc):
                found = self._meeting(self._point(edge.center), vertex, self._at.radius(edge.radius), size, meant)
            else:
                angle = self._angle_of(edge)
                found = (
                    vertex[0] + way * size * self._hand.cosine(angle),
                    vertex[1] + way * size * self._hand.sine(angle),
                )
            for axis in (FIRST, SECOND):
                self._put(self._named(axes[axis], place, own), found[axis])
        return self._done(f"{corner.name}: each end is so far from the intersection, on an arc along the chord")

    def _bevel_of_arc(
        self, corner: Corner, solved: CornerSolution, before: Line | Arc, after: Line | Arc, size: Any
    ) -> Calculation:
        """A chamfer at 45 degrees to the axes, whose one end is on a line and the other one on an arc."""
        line, arc = (before, after) if isinstance(before, Line) else (after, before)
        if not isinstance(line, Line) or not isinstance(arc, Arc):
            raise ValueError("no control makes a 45 degree chamfer between two arcs")
        vertex, center = self._point(corner.at), self._point(arc.center)
        share = self._hand.root(2) / 2 if corner.shape is CornerShape.CHAMFER_LENGTH_45 else 1
        steps = [size * share * (1 if solved.end[axis] > solved.begin[axis] else -1) for axis in (FIRST, SECOND)]
        way = 1 if line is before else -1
        moved = center[0] - way * steps[0], center[1] - way * steps[1]
        angle, meant = self._angle_of(line), solved.begin if line is before else solved.end
        along = self._crossing(vertex, angle, moved, self._at.radius(arc.radius), meant)
        own, axes = corner.name.rpartition(" ")[2], self._profile.plane.axes
        places = ("begin", "end") if line is before else ("end", "begin")
        on_line = vertex[0] + along * self._hand.cosine(angle), vertex[1] + along * self._hand.sine(angle)
        for axis in (FIRST, SECOND):
            first = self._put(self._named(axes[axis], places[0], own), on_line[axis])
            self._put(self._named(axes[axis], places[1], own), first + way * steps[axis])
        return self._done(f"{corner.name}: the circle, moved by the chamfer, meets the line")

    def _reach(self, arc: Arc, side: int, size: Any) -> Any:
        """The distance of the centre of a rounding from that of an arc beside it."""
        outward = self._at.radius(arc.radius) - arc.turn.sign * side * size
        return self._put(f"q{arc.name.rpartition(' ')[2]}", outward, meaning=f"from {arc.center} to the centre")

    def _named(self, axis: str, place: str, own: str) -> Any:
        from contoursolve.numeric import symbolic  # noqa: PLC0415 - sympy is slow to import

        return symbolic.symbol(f"{axis}_{place}_{own}")

    def _turn(self, one: Any, other: Any) -> Any:
        """The turn between two angles, by whole turns between half of one to either side."""
        degrees = (self._sheet.value(other) - self._sheet.value(one)) * 57.29577951308232
        turns = round(degrees / 360)
        return other - one - (2 * turns * self._pi() if turns else 0)

    def _pi(self) -> Any:
        from contoursolve.numeric import symbolic  # noqa: PLC0415 - sympy is slow to import

        return symbolic.PI


_SAME = 1e-6
"""mm by which two places of a step may differ and still be the same."""


def _is_placed(step: ConstructionStep) -> bool:
    """Whether a step has one unknown that a word states."""
    return len(step.facts) == 1 and (
        step.facts[0].placed is not None or bool(step.facts[0].sizes and step.facts[0].given)
    )
