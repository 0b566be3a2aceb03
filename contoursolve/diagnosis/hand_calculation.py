"""The calculation of a contour by hand, step by step as its construction has it: triangles, formulas, numbers."""

from collections.abc import Iterator
from math import atan2, hypot
from typing import Any

from contoursolve.diagnosis.hand_corners import HandCorners
from contoursolve.diagnosis.hand_sheet import Calculation, Pair
from contoursolve.geometry import (
    FIRST,
    Arc,
    Fact,
    line_scalars,
)
from contoursolve.solving import ConstructionStep, StepKind, steps_of


class HandCalculation(HandCorners):
    """The steps of a construction, each by hand, then the corners."""

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

    def _found(self, steps: list[ConstructionStep]) -> Calculation:
        self._number += 1
        step = steps[0]
        names = [name for each in steps for name in each.unknowns]
        things = dict.fromkeys(name.rpartition(".")[0] or name for name in names)
        title = ", ".join(things)
        if len(steps) > 1 or _is_placed(step):
            for each in steps:
                self._placed(each)
            return self._done(f"{title}: its size is stated" if step.facts[0].sizes else f"{title}: words state it")
        return self._checked(lambda: self._by_hand(step)) or self._together(step, title)

    def _by_hand(self, step: ConstructionStep) -> Calculation | None:
        """The calculation of a step that is no word's own; None where nobody can make it by hand."""
        is_direction = any(name.endswith(".cos") for name in step.unknowns)
        is_polar = len(step.facts) == 2 and step.facts[0].span is not None and step.facts[1].heading is not None  # noqa: PLR2004
        match step.kind:
            case StepKind.RADIUS:
                return self._radius(step)
            case StepKind.LINE_CIRCLE:
                return self._line_circle(step)
            case StepKind.TWO_CIRCLES:
                return self._two_circles(step)
            case StepKind.AFFINE if not is_direction:
                return self._linear(step)
        if is_polar:
            return self._polar(step)
        if is_direction:
            return self._direction(step)
        return self._tangent_arc(step) or self._beside_line(step)

    def _radius(self, step: ConstructionStep) -> Calculation:
        """A radius, the long side of a right triangle."""
        (circle,) = step.circles
        (x, y), (a, b) = self._point(circle.point), self._point(circle.center)
        self._put(self._symbols.scalar(step.unknowns[0]), self._hand.root((x - a) ** 2 + (y - b) ** 2))
        self._triangle = self._right(circle.center, (a, b), circle.point, (x, y))
        return self._done(f"{step.unknowns[0]}: the distance from {circle.center} to {circle.point}")

    def _linear(self, step: ConstructionStep) -> Calculation | None:
        """A point on one or two lines, or what other linear equations tell."""
        lines = [self._line_of(fact, step) for fact in step.facts]
        if len(step.unknowns) == 1 and lines[0] is not None:
            return self._leg(step, lines[0])
        if len(lines) == 2 and lines[0] is not None and lines[1] is not None:  # noqa: PLR2004 - two lines
            return self._two_lines(step, lines[0], lines[1])
        if any(fact.sides() for fact in step.facts):
            return None  # no word tells on which side it lies
        turned = self._symbols.turned()
        formulas = self._hand.solve_linear(
            [fact.equation(self._at).xreplace(turned) for fact in step.facts],
            [self._symbols.scalar(name) for name in step.unknowns],
        )
        for name, formula in zip(step.unknowns, formulas or (), strict=bool(formulas)):
            self._put(self._symbols.scalar(name), formula)
        return self._done(f"{step.point}: from linear equations") if formulas is not None else None

    def _together(self, step: ConstructionStep, title: str) -> Calculation:
        """The values that several equations give together, as the solution has them."""
        for line in (name.removesuffix(".cos") for name in step.unknowns if name.endswith(".cos")):
            cosine, sine, _ = line_scalars(line)
            angle = atan2(self._scalars[sine], self._scalars[cosine])
            self._sheet.put(self._symbols.turned_angle(line), angle, is_angle=True)
        units = {name: "" if name.endswith((".cos", ".sin")) else "mm" for name in step.unknowns}
        found = [(self._symbols.scalar(name), self._scalars[name], unit) for name, unit in units.items()]
        return self._taken(title, found)

    def _polar(self, step: ConstructionStep) -> Calculation:
        """A point by its distance and its direction from another one."""
        length, ray = step.facts
        tail, head = ray.heading or ("", "")
        (a, b), (x, y) = self._point(tail), self._point(head)
        angle, far = self._symbols.angle(ray.given), self._at.amount(length.given)
        self._put_pair((x, y), (a + far * self._hand.cosine(angle), b + far * self._hand.sine(angle)))
        self._triangle = self._right(tail, (a, b), head, (x, y))
        return self._done(f"{step.point}: right triangle from {tail}, the long side and the angle are known")

    def _tangent_arc(self, step: ConstructionStep) -> Calculation | None:
        """An arc that begins in a known direction and leads to a known point; None for another step."""
        turned = next((fact for fact in step.facts if fact.turn_between), None)
        arcs = [arc for arc in self._system.figure.path if isinstance(arc, Arc) and f"{arc.center}.0" in step.unknowns]
        if turned is None or turned.turn_between is None or len(arcs) != 1 or len(step.facts) != 3:  # noqa: PLR2004
            return None
        (arc,) = arcs
        (a, b), (x, y) = map(self._point, (arc.tail, arc.head))
        side, (first, second) = arc.turn.sign, turned.turn_between[0].vector(self._at)
        way = self._put("w", self._hand.heading(second, first), "deg", "angle of what is before")
        way = way + self._symbols.angle(turned.given)
        far = self._put("k", self._hand.root((x - a) ** 2 + (y - b) ** 2), meaning="the chord")
        across = self._put("v", self._hand.heading(y - b, x - a), "deg", f"angle from {arc.tail} to {arc.head}")
        size = side * far / (2 * self._hand.sine(across - way))
        radius = self._put(self._symbols.scalar(arc.radius), size, meaning="half the chord, by its sine")
        center = self._point(arc.center)
        sine, cosine = self._hand.sine(way), self._hand.cosine(way)
        self._put_pair(center, (a - side * radius * sine, b + side * radius * cosine))
        self._triangle = (
            (arc.tail, self._place((a, b))),
            ("centre", self._place(center)),
            (arc.head, self._place((x, y))),
        )
        return self._done(f"{arc.center}: on the perpendicular at {arc.tail}; the chord and its angle are known")

    def _beside_line(self, step: ConstructionStep) -> Calculation | None:
        """The centre of a circle of known radius that touches a known line and leads through a known point; None for
        another step."""
        touching = next((fact.beside for fact in step.facts if fact.beside and fact.beside.line), None)
        circle = next((fact.circle for fact in step.facts if fact.circle), None)
        if touching is None or circle is None or len(step.unknowns) != len(step.facts) or len(step.facts) != 2:  # noqa: PLR2004
            return None
        if step.point != touching.center or circle.center != touching.center:
            return None
        headed = self._system.headed.get(touching.line)
        if headed is None:
            return None
        angle, (a, b), radius = self._symbols.angle(headed[0]), self._point(headed[1]), self._at.radius(touching.radius)
        sine, cosine = self._hand.sine(angle), self._hand.cosine(angle)
        first, second = self._meant(step.point)
        left = (second - self._sheet.value(b)) * self._sheet.value(cosine)
        left -= (first - self._sheet.value(a)) * self._sheet.value(sine)
        side = 1 if left > 0 else -1
        beside = a - side * radius * sine, b + side * radius * cosine
        along = self._crossing(beside, angle, self._point(circle.point), radius, (first, second))
        self._put_pair(self._point(step.point), (beside[0] + along * cosine, beside[1] + along * sine))
        return self._done(f"{step.point}: as far from the line as from {circle.point}")

    def _direction(self, step: ConstructionStep) -> Calculation | None:
        """The direction of a line that passes known points, or touches known circles; None for another one."""
        line = step.unknowns[0].rpartition(".")[0]
        cosine, sine, offset = line_scalars(line)
        through = [fact.passes[1] for fact in step.facts if fact.passes]
        circles = [(fact.beside.center, fact.beside.radius) for fact in step.facts if fact.beside and fact.beside.line]
        if len(through) + len(circles) != 2 or len(step.facts) != 3:  # noqa: PLR2004 - two of three equations
            return None
        names = [*through, *(center for center, _ in circles)]
        (a, b), (c, d) = map(self._point, names)
        meant = self._scalars[cosine], self._scalars[sine]
        way = self._put("w", self._hand.heading(d - b, c - a), "deg", f"angle from {names[0]} to {names[1]}")
        turns: list[Any] = [0]
        if circles:
            far = self._put("c", self._hand.root((c - a) ** 2 + (d - b) ** 2), meaning="between them")
            radii = [self._at.radius(radius) for _, radius in circles]
            reaches = [radii[0]] if len(radii) == 1 else [radii[0] + radii[1], radii[0] - radii[1]]
            turns = [sign * self._hand.arcsine(reach / far) for reach in reaches for sign in (1, -1)]
        options = [way + turn + back for turn in turns for back in (0, self._hand.PI)]
        angle = min(options, key=lambda each: self._off(each, meant))
        named = self._symbols.turned_angle(line)
        self._put(named, angle, "deg", f"angle of {line}")
        for name, part in ((cosine, self._hand.cosine(named)), (sine, self._hand.sine(named))):
            self._sheet.put(self._symbols.scalar(name), part)
        place = b * self._hand.cosine(named) - a * self._hand.sine(named)
        if not through:
            side = 1 if self._sheet.value(place) > self._scalars[offset] else -1
            place = place - side * self._at.radius(circles[0][1])
        self._put(self._symbols.scalar(offset), place, meaning="of the line from zero")
        told = "touches" if circles else "leads through"
        return self._done(f"{line}: {told} {' and '.join(names[len(through) :] or names)}")

    def _off(self, angle: Any, meant: tuple[float, float]) -> float:
        """By how much a direction differs from one that is meant."""
        parts = self._sheet.value(self._hand.cosine(angle)), self._sheet.value(self._hand.sine(angle))
        return hypot(parts[0] - meant[0], parts[1] - meant[1])

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
        point = self._point(step.point)
        self._put_pair(point, (a + t * cosine(one), b + t * sine(one)))
        self._triangle = (begin, self._place((a, b))), (step.point, self._place(point)), (end, self._place((c, d)))
        return self._done(f"{step.point}: triangle {begin}, {step.point}, {end}; one side and its angles are known")

    def _line_circle(self, step: ConstructionStep) -> Calculation:
        (circle,) = step.circles
        line = self._line_of(step.of_line, step)
        if line is None:
            raise ValueError("the line of a step has a known point")
        (a, b), angle, _ = line
        center, radius = self._point(step.centers[0]), self._at.radius(circle.radius)
        way = self._crossing((a, b), angle, center, radius, self._meant(step.point))
        there = a + way * self._hand.cosine(angle), b + way * self._hand.sine(angle)
        self._put_pair(self._point(step.point), there)
        return self._done(f"{step.point}: the line meets the circle about {step.centers[0]}; half the chord is a leg")

    def _two_circles(self, step: ConstructionStep) -> Calculation:
        first, second = map(self._point, step.centers)
        one, other = (self._at.radius(circle.radius) for circle in step.circles)
        self._put_pair(self._point(step.point), self._meeting(first, second, one, other, self._meant(step.point)))
        names = " and ".join(step.centers)
        return self._done(f"{step.point}: triangle with {names}, all three sides are known")


def _is_placed(step: ConstructionStep) -> bool:
    """Whether a step has one unknown that a word states."""
    return len(step.facts) == 1 and (
        step.facts[0].placed is not None or bool(step.facts[0].sizes and step.facts[0].given)
    )
