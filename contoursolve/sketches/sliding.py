"""A sketch that lacks dimensions, as it may look: one place of all unknowns at which what is given holds, and the ways
along which its points can still slide."""

from cmath import phase, rect
from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import cos, dist, pi, radians, sin

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.diagnosis import Equations
from contoursolve.geometry import FIRST, SECOND, Arc, Line, Profile, assemble, both, line_scalars, scalar
from contoursolve.numeric import pinv, svd
from contoursolve.sketches.sketch import ContourSketch
from contoursolve.solving import Point
from contoursolve.tolerance import LENGTH

Array = NDArray[numpy.float64]

RANK = 1e-6
"""Share of the largest singular value below which one counts as zero, as of a sample drawing."""

STEPS, STEP = 14, 0.08
"""Steps along a way to either side, and the size of one, in sizes of the drawing."""

MOST_FAMILIES = 4
"""Ways that are followed."""

MOST_STEPS = 20
"""Steps of the Gauss-Newton method from a natural place."""

OTHERS = 3
"""Further places from which a drawing is looked for, beside the natural one."""

SAME = 1e-5
"""mm. What is less is nothing."""

FAR = 2.5
"""Sizes of the drawing beyond which a way is of no use."""

_SHARE, _SWEPT = 0.3, radians(60)
"""Length of an element of which nothing is known, in sizes of the drawing; the angle of an arc."""


class Loose(Struct, frozen=True):
    """A drawing of a sketch that lacks something: its points and radii (mm), in how many ways each point moves (0, 1
    or 2), `ways` along which a point slides, and the number of dimensions that are missing. `off_mm` is by how much
    each fact, by its given, is off: those that contradict the others."""

    points: Mapping[str, Point]
    radii: Mapping[str, float]
    freedom: Mapping[str, int]
    ways: Mapping[str, tuple[Point, ...]]
    missing: int
    off_mm: Mapping[str, float]

    def off_of(self, number: int) -> float | None:
        """The largest amount by which a fact of an element is off; None where all are true."""
        most = max((off for given, off in self.off_mm.items() if given.startswith(f"{number}:")), default=0.0)
        return most if most > SAME else None


def loosely_drawn(sketch: ContourSketch, profile: Profile, doubted: Iterable[str] = ()) -> Loose | None:
    """The drawing nearest to a natural one; facts by `doubted` givens hold as far as can be. None if none is found."""
    unsure = frozenset(doubted)
    has_sides = any(fact.sides() for fact in profile.facts)
    for side in (1, -1) if has_sides else (1,):
        drawing = _Drawing(sketch, profile, unsure, side)
        for seed in range(1 + OTHERS):
            place = drawing.solve(seed)
            if place is not None:
                return drawing.at(place)
    return None


class _Drawing:
    """The equations of a sketch, and places at which they hold."""

    def __init__(self, sketch: ContourSketch, profile: Profile, doubted: frozenset[str], side: int) -> None:
        self.sketch, self.profile, self.system = sketch, profile, assemble(profile)
        self.equations = Equations(profile, self.system, side)
        self.firm = [fact for fact in self.system.facts if fact.given not in doubted]
        self.doubted = [fact for fact in self.system.facts if fact.given in doubted]
        self.size = self.equations.size

    def solve(self, seed: int) -> Array | None:
        """The place found from the natural one, or, of a number, from one beside it."""
        place = numpy.array([*_Layout(self, seed).values()]) / self.equations.scales
        try:
            if self.doubted:
                place = self._best(place)
            found = self.equations.solve(self.firm, place, MOST_STEPS)
        except (ArithmeticError, ValueError, numpy.linalg.LinAlgError):
            return None
        is_one = found is not None and self.runs_right(found) and self.equations.has_lengths(found)
        return found if is_one else None

    def _best(self, place: Array) -> Array:
        """The place at which the firm facts hold, and of the doubted ones as much as can (least squares)."""
        facts = [*self.firm, *self.doubted]
        weights = numpy.array([1.0] * len(self.firm) + [1e-3] * len(self.doubted))
        for _ in range(30):
            off = self.equations.residuals(facts, place) * weights
            step = pinv(self.equations.slopes(facts, place) * weights[:, None], rcond=RANK * 1e-3) @ -off
            place = place + step * min(1.0, 1.0 / max(float(numpy.abs(step).max(initial=0.0)), 1e-300))
        return place

    def runs_right(self, place: Array) -> bool:
        """Whether lines run in the direction that is given, and radii are positive."""
        points, radii = self.named(place)
        for element in self.profile.figure.path:
            if isinstance(element, Arc):
                if radii.get(element.radius, 1.0) <= 0:
                    return False
            elif element.heading in self.equations.directions:
                along = self.equations.directions[element.heading]
                step = [points[element.head][axis] - points[element.tail][axis] for axis in (FIRST, SECOND)]
                if step[0] * along[0] + step[1] * along[1] < -LENGTH:
                    return False
        return True

    def named(self, place: Array) -> tuple[dict[str, Point], dict[str, float]]:
        """The points and the radii at a place, mm."""
        values = dict(zip(self.system.unknowns, (place * self.equations.scales).tolist(), strict=True))
        values |= self.equations.known
        figure = self.profile.figure
        points = {name: (values[scalar(name, 0)], values[scalar(name, 1)]) for name in (figure.start, *figure.points)}
        return points, {name: values[name] for name in figure.radii if name in values}

    def moves(self, place: Array) -> Array:
        """The motions that keep all facts: one a row."""
        rows = self.equations.slopes(self.firm, place)
        sizes = numpy.linalg.norm(rows, axis=1)
        rows = rows[sizes > 0] / sizes[sizes > 0, None]
        if not rows.size:
            return numpy.eye(place.size)
        _, values, right = svd(rows)
        return numpy.asarray(right[int((values > RANK * values[0]).sum()) :])

    def at(self, place: Array) -> Loose:
        """All that a place tells."""
        moves, (points, radii) = self.moves(place), self.named(place)
        freedom = {self.profile.figure.start: 0}
        for name in self.profile.figure.points:
            values = svd(self._of(name, moves))[1] if len(moves) else numpy.zeros(1)
            freedom[name] = int((values > RANK).sum())
        off_mm: dict[str, float] = {}
        for fact, off in zip(self.doubted, self.equations.residuals(self.doubted, place).tolist(), strict=True):
            off_mm[fact.given] = max(off_mm.get(fact.given, 0.0), abs(off) * self.size)
        return Loose(points, radii, freedom, self._ways(place, moves, freedom), len(moves), off_mm)

    def _of(self, name: str, moves: Array) -> Array:
        """The motions of a point."""
        columns = [self.equations.number[each] for each in both(name)]
        return numpy.asarray(moves[:, columns] * self.equations.scales[columns] / self.size)

    def _ways(self, place: Array, moves: Array, freedom: Mapping[str, int]) -> dict[str, tuple[Point, ...]]:
        """The ways of the ends of elements that slide."""
        ways: dict[str, tuple[Point, ...]] = {}
        followed: list[tuple[Array, list[dict[str, Point]]]] = []
        for name in (element.head for element in self.profile.figure.path):
            if freedom[name] != 1 or name in ways:
                continue
            motion = self._along(name, moves)
            known = next((way for each, way in followed if abs(float(each @ motion)) > 1 - RANK), None)
            if known is None:
                if len(followed) == MOST_FAMILIES:
                    continue
                back, on = ([*self._follow(place, each)] for each in (-motion, motion))
                known = [*back[::-1], self.named(place)[0], *on]
                followed.append((motion, known))
            ways[name] = tuple(_simplified([at[name] for at in known]))
        return ways

    def _along(self, name: str, moves: Array) -> Array:
        """The motion in which a point moves most, of length 1."""
        _, _, right = svd(self._of(name, moves).T)
        motion = right[0] @ moves
        return numpy.asarray(motion / float(numpy.linalg.norm(motion)))

    def _follow(self, place: Array, motion: Array) -> Iterator[dict[str, Point]]:
        """The places on one side of a way, as far as the drawing goes."""
        start, heads = self.named(place)[0], [element.head for element in self.profile.figure.path]
        for _ in range(STEPS):
            speed = max(float(numpy.linalg.norm(self._of(head, motion[None, :]))) for head in heads)
            try:
                found = self.equations.solve(self.firm, place + motion * STEP / max(speed, 1e-3))
                if found is None or not self.runs_right(found):
                    return
                free = self.moves(found)
                moved = motion @ free.T @ free
            except (ArithmeticError, ValueError, numpy.linalg.LinAlgError):
                return
            place, motion = found, moved / numpy.linalg.norm(moved)
            points = self.named(place)[0]
            if any(dist(points[head], start[head]) > FAR * self.size for head in heads):
                return
            yield points


def _simplified(way: Sequence[Point]) -> Sequence[Point]:
    """A way; of a straight one, its ends."""
    steps = numpy.array(way) - way[0]
    _, (_, *across), right = svd(steps)
    if max(across, default=0.0) > SAME:
        return way
    along = steps @ right[0]
    # Toward what is farthest from its begin.
    along *= -1 if -along.min() > along.max() else 1
    return [way[each] for each in dict.fromkeys((int(along.argmin()), int(along.argmax())))]


class _Layout:
    """A natural drawing: one element after the other with what is given of each, as complex numbers; else as it goes
    on. From another seed than 0, all is beside that."""

    def __init__(self, drawing: _Drawing, seed: int) -> None:
        self.drawing, self.equations, self.size = drawing, drawing.equations, drawing.size
        self.random, self.spread = numpy.random.default_rng(seed), 0.4 * self.size if seed else 0.0
        self.found: dict[str, float] = {}

    def values(self) -> Iterator[float]:
        """The values of all unknowns."""
        figure = self.drawing.profile.figure
        here = complex(*(self.equations.known[name] for name in both(figure.start)))
        heading = pi if self.drawing.sketch.part == "turned" else 0.0
        for number, element in enumerate(figure.path, 1):
            entered = self.equations.directions.get(f"{number}:AN")
            heading = phase(complex(*entered)) if entered else heading
            follow = self._arc if isinstance(element, Arc) else self._line
            here, heading = follow(number, element, here, heading)  # type: ignore[arg-type]
            self._put(element.head, here)
        for name in self.drawing.system.unknowns:
            away = float(self.random.uniform(-1, 1))
            natural = self.size * _SHARE * (1 if name in figure.radii else away)
            value = self.found.get(name, self.equations.amounts.get(name, natural))
            yield value + (0.0 if name.endswith((".cos", ".sin")) else self.spread * away)

    def _put(self, point: str, place: complex) -> None:
        self.found |= dict(zip(both(point), (place.real, place.imag), strict=True))

    def _line(self, number: int, line: Line, here: complex, heading: float) -> tuple[complex, float]:
        """The end of a line, and the direction in which it ends."""
        length, told = self.equations.amounts.get(f"{number}:LEN", self.size * _SHARE), self._told(number, "", here)
        along = rect(1, heading)
        known = [(told[axis] or 0.0, axis) for axis in (FIRST, SECOND) if told[axis] is not None]
        for value, axis in known if len(known) == 1 else ():
            begin, step = ((here.real, along.real), (here.imag, along.imag))[axis]
            length = abs((value - begin) / step) if abs(step) > RANK else length
        head = self._with(told, here + length * along)
        heading = phase(head - here) if abs(head - here) > LENGTH else heading
        offset = cos(heading) * here.imag - sin(heading) * here.real
        self.found |= dict(zip(line_scalars(line.name), (cos(heading), sin(heading), offset), strict=True))
        return head, heading

    def _arc(self, number: int, arc: Arc, here: complex, heading: float) -> tuple[complex, float]:
        amounts, sign = self.equations.amounts, arc.turn.sign
        radius = amounts.get(f"{number}:R", self.size * _SHARE)
        center = self._with(self._told(number, "CC", here), here + rect(radius, heading + sign * pi / 2))
        radius = amounts.get(f"{number}:R", max(abs(here - center), self.size * RANK))
        ended = self.equations.directions.get(f"{number}:CCA")
        angle = phase(complex(*ended)) if ended else phase(here - center) + sign * _SWEPT
        self._put(arc.center, center)
        self.found[arc.radius] = radius
        head = self._with(self._told(number, "", here), center + rect(radius, angle))
        return head, phase(head - center) + sign * pi / 2

    def _with(self, told: Sequence[float | None], place: complex) -> complex:
        """A place with the coordinates that are told."""
        first, second = told
        return complex(place.real if first is None else first, place.imag if second is None else second)

    def _told(self, number: int, prefix: str, here: complex) -> list[float | None]:
        """The coordinates of an element's end, or of its centre (CC), that are given or guessed."""
        amounts, profile, sketch = self.equations.amounts, self.drawing.profile, self.drawing.sketch
        guess, told = sketch.elements[number - 1].guess, list[float | None]()
        for begin, axis, is_turned in zip((here.real, here.imag), sketch.axes, profile.plane.diameters, strict=True):
            stated, step = (amounts.get(f"{number}:{lead}{prefix}{axis}") for lead in ("", "I"))
            if stated is None and step is not None:
                stated = begin + step
            if stated is None and prefix + axis in guess:
                stated = float(guess[prefix + axis] * profile.unit.in_mm) * (0.5 if is_turned else 1)
            told.append(stated)
        return told
