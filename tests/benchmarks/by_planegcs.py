"""A chain's facts as constraints of planegcs, FreeCAD's solver, with helping points where its user draws them.

It is in no extra, and what measures it goes without where it is missing. For Python 3.12 and 3.13, PyPI has wheels of
0.9.6. For Python 3.11 it has 0.1.1, as source only: `pip install planegcs` needs a C++20 compiler, Eigen and Boost
(Debian: g++, libeigen3-dev, libboost-dev). This module speaks both.

What has a direction is stated by `p2p_angle` and `l2l_angle`, which know it; `parallel`, `perpendicular` and
`tangent_line_arc` do not, and the last has no gradient where an arc ends on the line that it touches.
"""

from cmath import exp, phase
from collections.abc import Callable
from math import radians, tau
from time import perf_counter

from chains import Chain, Fact


class PlaneSketch:
    """A chain's guess as points, lines and arcs. Every coordinate is an unknown; fixed is what a constraint holds."""

    def __init__(self, guess: Chain) -> None:
        import planegcs  # noqa: PLC0415 not everybody has it

        self.solver = planegcs.SketchSolver()
        self.success = planegcs.SolveStatus.Success
        self.algorithms = planegcs.Algorithm.__members__
        self.is_early = not hasattr(self.solver, "add_point_from_params")  # 0.1
        self.guess = guess
        self.points = [self.fixed(guess.points[0]), *(self.point(place) for place in guess.points[1:])]
        self.centers = {number: self.point(guess.arc(number).center) for number in guess.arcs}
        self.elements = {number: self.element(number) for number in guess.numbers}

    def value(self, value: float) -> int:
        return self.solver.add_param(value, fixed=True)

    def point(self, place: complex) -> int:
        return self.solver.add_point(place.real, place.imag)

    def fixed(self, place: complex) -> int:
        point = self.point(place)
        self.solver.coordinate_x(point, self.value(place.real))
        self.solver.coordinate_y(point, self.value(place.imag))
        return point

    def element(self, number: int) -> int:
        start, end = self.points[number - 1], self.points[number]
        if not self.guess.is_arc(number):
            return self.solver.add_line(start, end)
        arc = self.guess.arc(number)
        first = self.guess.points[number - 1]
        if arc.turn == "cw":  # all its arcs run counter-clockwise
            start, end, first = end, start, self.guess.points[number]
        angle = phase(first - arc.center) % tau
        angles = angle, angle + radians(self.guess.sweep(number))
        if not self.is_early:  # its rules, that the ends are on the circle, are implied
            values = [self.solver.add_param(value, fixed=False) for value in (arc.radius, *angles)]
            return self.solver.add_arc(self.centers[number], start, end, *values)
        made = self.solver.add_arc(self.centers[number], arc.radius, *angles)
        self.solver.arc_rules(made)
        # 0.1.1 numbers an arc's ends just before it, and has no other way to learn their numbers.
        self.solver.coincident(start, made - 2)
        self.solver.coincident(end, made - 1)
        return made

    def circle(self, center: complex, radius: float) -> int:
        """A fixed one."""
        point, value = self.fixed(center), self.value(radius)
        if not self.is_early:
            return self.solver.add_circle(point, value)
        made = self.solver.add_circle(point, radius)
        self.solver.circle_radius(made, value)
        return made

    def spoke(self, number: int, *, at_end: bool) -> tuple[int, int]:
        """A line, and by how many degrees an element's direction of travel is turned from it."""
        if not self.guess.is_arc(number):
            return self.elements[number], 0
        line = self.solver.add_line(self.centers[number], self.points[number if at_end else number - 1])
        return line, 90 * self.guess.arc(number).sign

    def place_of(self, point: int) -> complex:
        return complex(*self.solver.get_point(point))

    def result(self) -> Chain:
        points = [self.place_of(point) for point in self.points]
        variables = [part for point in points[1:] for part in (point.real, point.imag)]
        for number in self.guess.arcs:
            center = self.place_of(self.centers[number])
            radius = (abs(points[number - 1] - center) + abs(points[number] - center)) / 2
            variables += (center.real, center.imag, radius)
        return self.guess.at(variables)


def state_coordinate(sketch: PlaneSketch, fact: Fact) -> None:
    first = fact.elements[0]
    point = sketch.points[first] if fact.kind.endswith("point") else sketch.centers[first]
    say = sketch.solver.coordinate_x if fact.kind.startswith("x") else sketch.solver.coordinate_y
    say(point, sketch.value(fact.values[0]))


def state_radius(sketch: PlaneSketch, fact: Fact) -> None:
    sketch.solver.arc_radius(sketch.elements[fact.elements[0]], sketch.value(fact.values[0]))


def state_direction(sketch: PlaneSketch, fact: Fact) -> None:
    number = fact.elements[0]
    sketch.solver.p2p_angle(*sketch.points[number - 1 : number + 1], sketch.value(radians(fact.values[0])))


def state_length(sketch: PlaneSketch, fact: Fact) -> None:
    number, length = fact.elements[0], sketch.value(fact.values[0])
    if sketch.guess.is_arc(number):
        sketch.solver.arc_length(sketch.elements[number], length)
    else:
        sketch.solver.p2p_distance(*sketch.points[number - 1 : number + 1], length)


def state_angle(sketch: PlaneSketch, fact: Fact) -> None:
    """An angle, or none at all where the elements are tangent."""
    first, second = fact.elements
    (before, turned), (after, turned_too) = sketch.spoke(first, at_end=True), sketch.spoke(second, at_end=False)
    angle = (fact.values[0] if fact.values else 0.0) + turned - turned_too
    sketch.solver.l2l_angle(before, after, sketch.value(radians(angle)))


def state_passing(sketch: PlaneSketch, fact: Fact) -> None:
    number = fact.elements[0]
    say = sketch.solver.point_on_arc if sketch.guess.is_arc(number) else sketch.solver.point_on_line
    say(sketch.fixed(complex(*fact.values)), sketch.elements[number])


def state_circle(sketch: PlaneSketch, fact: Fact) -> None:
    number = fact.elements[0]
    x, y, radius = fact.values
    circle = sketch.circle(complex(x, y), radius)
    if sketch.guess.is_arc(number):
        sketch.solver.tangent_circle_arc(circle, sketch.elements[number])
    else:
        sketch.solver.tangent_line_circle(sketch.elements[number], circle)


def state_line(sketch: PlaneSketch, fact: Fact) -> None:
    x, y, angle = fact.values
    place = complex(x, y)
    line = sketch.solver.add_line(sketch.fixed(place), sketch.fixed(place + exp(1j * radians(angle))))
    sketch.solver.tangent_line_arc(line, sketch.elements[fact.elements[0]])


def state_equal_length(sketch: PlaneSketch, fact: Fact) -> None:
    sketch.solver.equal_length(*(sketch.elements[number] for number in fact.elements))


def state_equal_radius(sketch: PlaneSketch, fact: Fact) -> None:
    sketch.solver.equal_radius_aa(*(sketch.elements[number] for number in fact.elements))


WORDS: dict[str, Callable[[PlaneSketch, Fact], None]] = {
    "x of point": state_coordinate,
    "y of point": state_coordinate,
    "x of center": state_coordinate,
    "y of center": state_coordinate,
    "radius": state_radius,
    "direction": state_direction,
    "length": state_length,
    "angle": state_angle,
    "tangent": state_angle,
    "passes through": state_passing,
    "tangent to circle": state_circle,
    "tangent to line": state_line,
    "equal length": state_equal_length,
    "equal radius": state_equal_radius,
}


def solve_in_plane(guess: Chain, facts: tuple[Fact, ...], algorithm: str) -> tuple[Chain, bool, float]:
    """What it finds, whether it says that it did, and the seconds of the call that solves."""
    sketch = PlaneSketch(guess)
    for fact in facts:
        WORDS[fact.kind](sketch, fact)
    chosen = sketch.algorithms[algorithm]
    begin = perf_counter()
    status = sketch.solver.solve(chosen)
    seconds = perf_counter() - begin
    return sketch.result(), status == sketch.success, seconds
