"""One place of all unknowns at which facts hold, and the null space of their Jacobian there: what can still move."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import tee
from math import dist, hypot

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Freedom
from contoursolve.geometry import (
    Fact,
    OfCircle,
    Profile,
    Values,
    assemble,
    both,
    scalar,
)
from contoursolve.numeric import Array, svd
from contoursolve.solving.affine import nearest_sides
from contoursolve.solving.determinacy import Determinacy, analyse
from contoursolve.solving.natural_layout import NaturalLayout
from contoursolve.solving.newton import RANK, Equations, null_space
from contoursolve.solving.sides import side_values
from contoursolve.solving.solution import Point

SEEDS, RANDOM = 8, 16
"""Places from which a drawing is looked for: the natural one and such beside it, then random ones."""

MOST_ROWS = 6_000
"""Rows of derivatives after which no further place is tried. Of 437 contours that lack words and were drawn, the
slowest took 5,412, and half took 6."""

TURNS = 3
"""Times that lines which run against their directions are turned round."""

MOST_SPECIAL, MOST_FURTHER = 4, 16
"""Drawings in which more can move than in general, and those that are not on the chosen side either, after which no
other one is looked for."""

STEPS, STEP, FAR = 14, 0.08, 2.5
"""Steps along a way to either side; the size of one, and the length of a way, in sizes of the drawing."""

MOST_FAMILIES = 4
"""Ways that are followed."""

SAME = 1e-5
"""mm. What is less is nothing."""

_NOTHING = 1e-12
"""mm per mm. Rounding of what does not move."""

_STRAIGHT = 1e-7
"""Sine of the change of direction up to which a way is straight."""


class NullMotion(Struct, frozen=True):
    """One way in which a drawing can still move: how far each point (mm along each axis) and each radius moves with
    1 mm of the first point, or radius, that moves."""

    points: Mapping[str, Point]
    radii: Mapping[str, float]


class NaturalDrawing(Struct, frozen=True, eq=False, dict=True):
    """A place at which facts hold (those that are firm; by how much the doubted ones miss is `off_mm`)."""

    equations: Equations
    facts: tuple[Fact, ...]
    place: Array
    doubted: tuple[Fact, ...] = ()

    @cached_property
    def scalars(self) -> dict[str, float]:
        """The values of all unknowns, mm."""
        return self.equations.scalars(self.place)

    @cached_property
    def points(self) -> dict[str, Point]:
        """The places of all points, mm."""
        values, figure = {**self.equations.known, **self.scalars}, self.equations.system.figure
        return {name: (values[scalar(name, 0)], values[scalar(name, 1)]) for name in (figure.start, *figure.points)}

    @property
    def radii(self) -> dict[str, float]:
        """The unknown radii, mm."""
        return {name: self.scalars[name] for name in self.equations.system.figure.radii}

    @property
    def sides(self) -> dict[str, int]:
        """The sides on which elements lie beside others, where nothing says it: 1 or -1."""
        signs = self.equations.signs
        return {side: signs[side] for fact in self.equations.system.facts for side in fact.sides()}

    @cached_property
    def moves(self) -> Array:
        """The motions that are left: an orthonormal basis in the scale of the equations, one motion a row."""
        return null_space(self.equations.slopes(self.facts, self.place))

    @property
    def dimension(self) -> int:
        """In how many ways it can still move."""
        return len(self.moves)

    @property
    def is_chosen(self) -> bool:
        """Whether every point for which there are two places lies on the side that the control chooses."""
        choices = self.equations.profile.choices
        values = side_values(self.equations.system, self.equations.at(self.place), {each.point for each in choices})
        for choice in choices:
            if choice.point in values:
                value, left, right = values[choice.point]
                if choice.side.value != (left if value > 0 else right) and abs(value) > SAME:
                    return False
        return True

    @cached_property
    def goes_back(self) -> bool:
        """Whether a line runs against its stated direction, which not every control refuses."""
        return bool(self.equations.against(self.place))

    @cached_property
    def fixed(self) -> frozenset[str]:
        """The unknowns that no motion moves. They may still have several values, one in each of several drawings."""
        sizes = numpy.abs(self.moves).max(axis=0, initial=0.0)
        return frozenset(name for name, size in zip(self.equations.number, sizes, strict=True) if size <= RANK)

    @cached_property
    def freedom(self) -> dict[str, int]:
        """In how many ways each point moves: 0, 1 or 2."""
        figure = self.equations.system.figure
        found = {figure.start: 0}
        for name in figure.points:
            values = svd(self.of(name, self.moves))[1] if len(self.moves) else numpy.zeros(1)
            found[name] = int((values > RANK).sum())
        return found

    def of(self, point: str, moves: Array) -> Array:
        """The motions of a point, in sizes of the drawing."""
        columns = [self.equations.number[each] for each in both(point)]
        return numpy.asarray(moves[:, columns] * self.equations.scales[columns] / self.equations.size)

    def along(self, point: str) -> Array:
        """The motion in which a point moves most, of length 1."""
        _, _, right = svd(self.of(point, self.moves).T)
        motion = right[0] @ self.moves
        return numpy.asarray(motion / float(numpy.linalg.norm(motion)))

    @property
    def off_mm(self) -> dict[str, float]:
        """The amount by which each doubted fact is off, by its given, mm."""
        off: dict[str, float] = {}
        found = self.equations.residuals(self.doubted, self.place).tolist()
        for fact, miss in zip(self.doubted, found, strict=True):
            off[fact.given] = max(off.get(fact.given, 0.0), abs(miss) * self.equations.size)
        return off

    # Motions -------------------------------------------------------------------------------------------------

    @cached_property
    def leading(self) -> dict[str, Array]:
        """A basis of motions of few points, each by an unknown that it alone moves, by 1.

        Each has as few unknowns as any with that one (a fundamental circuit). Of the bases that lead with the first
        and with the last unknowns, the sparsest motions are taken.
        """
        names = [*self.equations.number]
        found: list[tuple[int, int, Array]] = []
        for order in (range(len(names)), range(len(names) - 1, -1, -1)):
            found += [(int((abs(motion) > RANK).sum()), lead, motion) for lead, motion in _reduced(self.moves, order)]
        chosen: dict[str, Array] = {}
        for _, lead, motion in sorted(found, key=lambda each: each[:2]):
            rows = numpy.array([*chosen.values(), motion])
            if names[lead] not in chosen and int((svd(rows)[1] > RANK).sum()) == len(rows):
                chosen[names[lead]] = motion
        return chosen

    @property
    def basis(self) -> Array:
        """The motions of `leading`, in mm a mm of that unknown, shape (unknowns, motions)."""
        scales = self.equations.scales
        found = [way * scales / scales[self.equations.number[name]] for name, way in self.leading.items()]
        basis = numpy.array(found).reshape(len(found), len(scales)).T
        return numpy.where(abs(basis) > _NOTHING, basis, 0.0)

    @cached_property
    def motions(self) -> tuple[NullMotion, ...]:
        """The same by points and radii, in mm for each mm of the first point that moves."""
        figure, found = self.equations.system.figure, []
        for motion in self.basis.T:
            moved = dict(zip(self.equations.number, motion.tolist(), strict=True))
            points = {name: (moved[scalar(name, 0)], moved[scalar(name, 1)]) for name in figure.points}
            sizes = [*(hypot(*way) for way in points.values()), *(abs(moved[name]) for name in figure.radii)]
            unit = next((size for size in sizes if size > RANK * max(sizes)), 1.0)
            ways = {name: (_tidy(a / unit), _tidy(b / unit)) for name, (a, b) in points.items()}
            radii = {name: _tidy(moved[name] / unit) for name in figure.radii}
            found.append(
                NullMotion(
                    {name: way for name, way in ways.items() if hypot(*way) > RANK},
                    {name: way for name, way in radii.items() if abs(way) > RANK},
                )
            )
        return tuple(found)

    def freedoms(self) -> Iterator[Freedom]:
        """The points that can still move, in the order of the unknowns, each with how it moves."""
        for point in self.equations.system.figure.points:
            ways = self.freedom[point]
            if ways == 2:  # noqa: PLR2004 - the plane has two axes
                yield Freedom(point, None)
            elif ways:
                one, other = self.of(point, self.along(point)[None, :])[0].tolist()
                # Of two that differ by rounding, the first tells which way is forwards.
                lead = one if abs(one) > abs(other) * (1 - RANK) else other
                length = hypot(one, other) * (1 if lead > 0 else -1)
                circles = (fact.circle for fact in self.facts if fact.circle is not None)
                about = next((each.center for each in circles if self._is_about(point, each)), "")
                is_straight = not about and self._is_straight(point)
                yield Freedom(point, (_tidy(one / length), _tidy(other / length)), about, is_straight)

    def _is_about(self, point: str, circle: OfCircle) -> bool:
        """Whether a point slides along a circle that stays."""
        moving = {*both(circle.center), circle.radius} & {*self.equations.number}
        return circle.point == point and moving <= self.fixed

    def _is_straight(self, point: str) -> bool:
        """Whether a point slides along a line: its direction does not change along the way."""
        motion, small = self.along(point), 1e-3
        first = self.of(point, motion[None, :])[0]
        moved = self.equations.solve(self.facts, self.place + motion * small)
        if moved is None:
            return False
        step = [b - a for a, b in zip(self.points[point], replace(self, place=moved).points[point], strict=True)]
        return bool(abs(step[0] * first[1] - step[1] * first[0]) <= _STRAIGHT * hypot(*step) * hypot(*first) + 1e-14)

    def follow(self, motion: Array, steps: int = STEPS, step: float = STEP) -> Iterator["NaturalDrawing"]:
        """The drawings on one side of a way, as far as the drawing goes."""
        here, heads = self, [element.head for element in self.equations.system.figure.path]
        for _ in range(steps):
            speed = max((float(numpy.linalg.norm(self.of(head, motion[None, :]))) for head in heads), default=1.0)
            try:
                found = self.equations.solve(self.facts, here.place + motion * step / max(speed, 1e-3))
                if found is None or not self.equations.runs_right(self.facts, found):
                    return
                here = replace(self, place=found)
                moved = motion @ here.moves.T @ here.moves
            except (ArithmeticError, ValueError, numpy.linalg.LinAlgError):
                return
            motion = moved / max(float(numpy.linalg.norm(moved)), 1e-300)
            if any(dist(here.points[head], self.points[head]) > FAR * self.equations.size for head in heads):
                return
            yield here

    @cached_property
    def ways(self) -> dict[str, tuple[Point, ...]]:
        """The ways of the ends of elements that slide, on both sides of where they are; of a straight one, its ends."""
        ways: dict[str, tuple[Point, ...]] = {}
        followed: list[tuple[Array, list[NaturalDrawing]]] = []
        for name in (element.head for element in self.equations.system.figure.path):
            if self.freedom[name] != 1 or name in ways:
                continue
            motion = self.along(name)
            known = next((way for each, way in followed if abs(float(each @ motion)) > 1 - RANK), None)
            if known is None:
                if len(followed) == MOST_FAMILIES:
                    continue
                back, on = ([*self.follow(each)] for each in (-motion, motion))
                known = [*back[::-1], self, *on]
                followed.append((motion, known))
            ways[name] = tuple(_simplified([each.points[name] for each in known]))
        return ways

    def beside(self) -> Iterator["NaturalDrawing"]:
        """Further drawings, one motion after the other, to either side, near and far."""
        for steps in (3, 6):
            for motion in self.leading.values():
                for way in (motion, -motion):
                    yield from [*self.follow(way / float(numpy.linalg.norm(way)), steps, 2 * STEP)][steps - 1 :]


def _tidy(value: float) -> float:
    """A number without the rounding of a zero."""
    return value + 0.0 if abs(value) > _NOTHING else 0.0


def _reduced(moves: Array, order: Iterable[int]) -> Iterator[tuple[int, Array]]:
    """Rows in reduced echelon form, solved for the first columns of an order that can be, each with its column."""
    rows, found = moves.copy(), list[int]()
    for column in order:
        if len(found) == len(rows):
            break
        best = max(range(len(found), len(rows)), key=lambda row: abs(rows[row, column]))
        if abs(rows[best, column]) <= 1e3 * RANK:
            continue
        rows[[len(found), best]] = rows[[best, len(found)]]
        rows[len(found)] /= rows[len(found), column]
        for row in range(len(rows)):
            if row != len(found):
                rows[row] -= rows[row, column] * rows[len(found)]
        found.append(column)
    yield from zip(found, rows, strict=False)


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


def drawings(
    profile: Profile, doubted: Iterable[str] = (), hints: Mapping[str, float] | None = None
) -> Iterator[NaturalDrawing]:
    """Drawings of a contour, that nearest to a natural one first; facts by `doubted` givens hold as far as can be.

    Those in which more can move than in general come last: there lines lie in line, or a circle touches. So do those
    in which a line runs against its angle, and those that are not on the side that the control chooses. Several who
    ask for those of one profile share what was found.
    """
    if doubted or hints:
        return _in_order(profile, frozenset(doubted), hints or {})
    kept = vars(profile)
    mine, kept[_DRAWINGS] = tee(kept[_DRAWINGS] if _DRAWINGS in kept else _in_order(profile, frozenset(), {}))
    return mine


_DRAWINGS = "drawings"
"""The place of the drawings of a profile: beside its fields, as it keeps what it works out itself."""


def _in_order(profile: Profile, doubted: frozenset[str], hints: Mapping[str, float]) -> Iterator[NaturalDrawing]:
    system = assemble(profile)
    general = len(system.unknowns) - analyse(system).rank
    further = list[tuple[int, NaturalDrawing]]()
    for drawing in _found(profile, doubted, hints):
        is_special = drawing.dimension > general and not drawing.doubted
        order = 2 * (not drawing.is_chosen) + drawing.goes_back
        if not is_special and not order:
            yield drawing
            continue
        further.append((order, drawing))
        if sum(not order for order, _ in further) == MOST_SPECIAL or len(further) == MOST_FURTHER:
            break
    yield from (drawing for _, drawing in sorted(further, key=lambda each: each[0]))


def first_drawing(profile: Profile) -> NaturalDrawing | None:
    """The first of the drawings of a contour; None where none is found, or its start is not known."""
    return next(drawings(profile), None) if profile.start.is_known else None


def open_at_values(profile: Profile, verdict: Determinacy) -> tuple[str, ...]:
    """The unknowns that can still move at the values of a profile, of those that nothing determines in general; all of
    these where no drawing tells."""
    drawing = first_drawing(profile)
    if drawing is None or drawing.dimension != len(assemble(profile).unknowns) - verdict.rank:
        return verdict.free
    return tuple(name for name in verdict.free if name not in drawing.fixed)


def _found(profile: Profile, unsure: frozenset[str], hints: Mapping[str, float]) -> Iterator[NaturalDrawing]:
    """The drawings that are found from natural places, then from random ones."""
    system = assemble(profile)
    firm = tuple(fact for fact in system.facts if not fact.given or fact.given not in unsure)
    others = tuple(fact for fact in system.facts if fact.given and fact.given in unsure)
    plain = Equations(profile, system)
    empty = Values(plain.known, plain.amounts, plain.directions, system.headed, plain.signs)
    layout = NaturalLayout(profile, system, empty, plain.size, hints)
    sides, rows = dict.fromkeys(side for fact in system.facts for side in fact.sides()), 0
    for seed in range(SEEDS + RANDOM):
        if rows > MOST_ROWS:
            break
        place = plain.place(layout.values(seed)) if seed < SEEDS else plain.random_place(seed)
        equations = plain
        if sides:
            signs: Mapping[str, int] = nearest_sides(system.facts, plain.at(place))
            if seed % 2:
                signs = {side: 1 if (seed >> number + 1) & 1 else -1 for number, side in enumerate(sides)}
            equations = Equations(profile, system, signs)
        # Whoever follows a drawing in between works out rows of its own.
        before = equations.rows
        try:
            found = _place_near(equations, firm, others, place)
            is_drawn = found is not None and equations.has_lengths(found)
        except (ArithmeticError, ValueError, numpy.linalg.LinAlgError):
            found, is_drawn = None, False
        rows += equations.rows - before
        if found is not None and is_drawn:
            yield NaturalDrawing(equations, firm, found, others)


def _place_near(equations: Equations, firm: Sequence[Fact], doubted: Sequence[Fact], place: Array) -> Array | None:
    """The place near another one at which firm facts hold in their senses; None where it is not found."""
    found = None
    for _ in range(TURNS):
        place = equations.best(firm, doubted, place if found is None else equations.turned(found))
        found = equations.solve(firm, place)
        if found is None:
            return None
        found = equations.polished(firm, found)
        if not equations.against(found):
            break
    return found if found is not None and equations.runs_right(firm, found) else None
