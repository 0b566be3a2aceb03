"""What is known of a contour, solved or not: its points and corners, and what speaks against it.

A contour that is solved has all its points. One that is refused is worked out as far as its equations go, for a
corner that does not fit has a place as well. What words leave free is put somewhere, and is said to be so.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from decimal import Decimal
from itertools import product
from math import hypot, inf, isfinite

from contoursolve.analysis import judge
from contoursolve.analysis.identities import is_affine
from contoursolve.constraints import Coordinate, Level, Offset, OnCircle, Radius, assemble
from contoursolve.diagnosis.affine import affine_facts
from contoursolve.examine import MOST_CHOICES, Answer, count_choices
from contoursolve.model import FIRST, SECOND, Fact, Given, Layout, Profile, Unit, scalar
from contoursolve.solving import (
    Point,
    Refusal,
    Solution,
    Status,
    is_closed,
    points_with_two_solutions,
    solve,
)
from contoursolve.solving.compile import compile_system
from contoursolve.solving.solution import CornerSolution
from contoursolve.solving.solve import corner_of, inputs_of
from contoursolve.tolerance import LARGEST

MOST_FREE = 6
"""Free coordinates that are put somewhere; of a contour with more, only what is known is drawn."""

MOST_TRIED = 40
"""Places that are tried for what is free, each a solve of well under a millisecond."""

MOST_GHOSTS = 3
"""Completions that are shown."""

_STEPS = (0.6, 1.0, 0.35, 1.5, -0.6, -1.0, -0.35, -1.5)
"""Where a free coordinate is put, from where the line begins, in lengths of the drawing."""


@dataclass(frozen=True, slots=True)
class Known:
    """`points` (mm) and `radii` by name, `corners` whether they fit or not; `placed` are the points that words leave
    free. `others` are further completions."""

    points: Mapping[str, Point] = field(default_factory=dict)
    radii: Mapping[str, float] = field(default_factory=dict)
    corners: Mapping[str, CornerSolution] = field(default_factory=dict)
    refusals: tuple[Refusal, ...] = ()
    placed: frozenset[str] = frozenset()
    others: tuple[Solution, ...] = ()
    scalars: Mapping[str, float] = field(default_factory=dict)
    """Coordinates of which the other one is not known."""

    def coordinate(self, point: str, axis: int) -> float | None:
        """One coordinate of a point, mm."""
        if point in self.points:
            return self.points[point][axis]
        return self.scalars.get(scalar(point, axis))


def find_known(answer: Answer) -> Known:
    """All that can be drawn of a contour; nothing if its start is not known."""
    profile = answer.profile
    if not answer.start.is_known:
        return Known()
    if answer.contour is not None:
        solution = _solution_of(answer)
        if solution is not None and solution.points:
            return _known(solution)
    system = assemble(profile)
    verdict = judge(system)
    if profile.is_extended:
        return _of_alternatives(answer) or _in_part(profile)
    if verdict.is_determined and is_closed(system):
        return _worked_out(profile)
    if verdict.is_determined:
        return _in_part(profile)
    return _completed(profile, len(verdict.free))


def _solution_of(answer: Answer) -> Solution | None:
    """The solution behind the path of a contour."""
    if answer.alternatives is not None:
        from contoursolve.solving.alternatives import choose  # noqa: PLC0415 - most contours need no choice

        eligible = choose(answer.alternatives, answer.profile.choices)
        return next((item.solution for item in eligible if item.is_path), None)
    system = assemble(answer.profile)
    return solve(answer.profile, is_proven=False) if is_closed(system) else None


def _of_alternatives(answer: Answer) -> Known | None:
    """The first solution that there is, for a contour that nothing chooses."""
    items = answer.alternatives.items if answer.alternatives else ()
    found = next((item.solution for item in items if item.is_path), None)
    return _known(found) if found is not None else None


def _known(solution: Solution) -> Known:
    return Known(solution.points, solution.radii, solution.corners)


def _worked_out(profile: Profile) -> Known:
    """The points of a determined contour that is refused, as far as they exist, with its corners as large as stated."""
    system = assemble(profile)
    out = dict(compile_system(system).function(_inputs(profile)))
    origin = tuple(float(value or 0) for value in profile.start.values)

    def absolute(at: Point) -> Point:
        return origin[FIRST] + at[FIRST], origin[SECOND] + at[SECOND]

    points = {system.figure.start: absolute((0.0, 0.0))}
    rest: dict[str, float] = {}
    for name in system.figure.points:
        at = out.get(scalar(name, FIRST), inf), out.get(scalar(name, SECOND), inf)
        if all(_is_usable(value) for value in at):
            points[name] = absolute(at)
        else:
            rest |= {scalar(name, axis): absolute(at)[axis] for axis in (FIRST, SECOND) if _is_usable(at[axis])}
    radii = {name: out[name] for name in system.figure.radii if _is_usable(out.get(name, inf)) and out[name] > 0}
    corners = {}
    for corner in system.figure.corners:
        if corner.size in profile.givens:
            built = corner_of(corner, float(profile.givens[corner.size].value), out, absolute)
            places = (built.begin, built.end, *([built.center] if built.center else []))
            if all(_is_usable(value) for place in places for value in place) and isfinite(built.turn):
                corners[corner.name] = built
    is_solvable = count_choices(profile) <= MOST_CHOICES and _is_chosen(profile)
    refusals = solve(profile, is_proven=False).refusals if is_solvable else ()
    if len(points) < len(system.figure.points) + 1:
        part = _in_part(profile)
        points = {**part.points, **points}
        radii, rest = {**part.radii, **radii}, {**part.scalars, **rest}
    return Known(points, radii, corners, refusals, scalars=rest)


def _is_usable(value: float) -> bool:
    return isfinite(value) and abs(value) <= 10 * LARGEST


def _is_chosen(profile: Profile) -> bool:
    """Whether every point that may lie in two places has a choice."""
    chosen = {choice.point for choice in profile.choices}
    return chosen.issuperset(points_with_two_solutions(assemble(profile)))


def _inputs(profile: Profile) -> dict[str, float]:
    """All inputs of the function, one of two places where nothing chooses."""
    system = assemble(profile)
    sides = {f"side:{point}": 1.0 for point in points_with_two_solutions(system)}
    return {**sides, **inputs_of(profile, system)}


def _in_part(profile: Profile) -> Known:
    """What the facts say one after the other, without solving anything: coordinates, and the circles about known
    centres through known points."""
    system = assemble(profile)
    basis = [system.facts[index] for index in judge(system).basis]
    plain = [fact for fact in basis if is_affine([fact])]
    values = _fixed(profile, plain)
    for _ in basis:
        before = len(values)
        for fact in basis:
            _derive(fact, profile, values)
        if len(values) == before:
            break
    start = {scalar(system.figure.start, axis): float(v or 0) for axis, v in enumerate(profile.start.values)}
    everything = {**values, **start}
    points: dict[str, Point] = {}
    rest: dict[str, float] = {}
    for name in (system.figure.start, *system.figure.points, *system.figure.places):
        pair = [everything.get(scalar(name, axis)) for axis in (FIRST, SECOND)]
        if pair[0] is not None and pair[1] is not None:
            points[name] = pair[0], pair[1]
        else:
            rest |= {scalar(name, axis): value for axis, value in enumerate(pair) if value is not None}
    radii = {name: values[name] for name in system.figure.radii if name in values}
    return Known(points, radii, scalars=rest)


def _fixed(profile: Profile, facts: list[Fact]) -> dict[str, float]:
    """The coordinates that plain facts fix."""
    part = replace(profile, layout=Layout(profile.figure, tuple(facts)))
    affine = affine_facts(part, facts) if facts else None
    return {name: value for name, value in affine.fixed_by(facts).items() if _is_usable(value)} if affine else {}


def _derive(fact: Fact, profile: Profile, values: dict[str, float]) -> None:
    """What one fact adds to the values that are known."""
    figure, amounts = profile.figure, profile.givens

    def get(point: str, axis: int) -> float | None:
        if point == figure.start:
            return float(profile.start.values[axis] or 0)
        if point in figure.places:
            return float(amounts[scalar(point, axis)].value)
        return values.get(scalar(point, axis))

    if isinstance(fact, Radius):
        values.setdefault(fact.radius, abs(float(amounts[fact.given].value)))
    elif isinstance(fact, Coordinate):
        values.setdefault(scalar(fact.point, fact.axis), float(amounts[fact.given].value))
    elif isinstance(fact, Offset):
        origin = get(fact.origin, fact.axis)
        if origin is not None and fact.point != figure.start:
            values.setdefault(scalar(fact.point, fact.axis), origin + float(amounts[fact.given].value))
    elif isinstance(fact, Level):
        level = get(fact.origin, fact.axis)
        if level is not None and fact.point != figure.start:
            values.setdefault(scalar(fact.point, fact.axis), level)
    elif isinstance(fact, OnCircle) and fact.radius not in values:
        pairs = [(get(fact.point, axis), get(fact.center, axis)) for axis in (FIRST, SECOND)]
        steps = [at - center for at, center in pairs if at is not None and center is not None]
        if len(steps) == len(pairs) and hypot(*steps) > 0:
            values[fact.radius] = hypot(*steps)


def _completed(profile: Profile, free: int) -> Known:
    """A contour with what its words leave free put somewhere, so that the control would make it if that can be."""
    known = _in_part(profile)
    if free > MOST_FREE:
        return known
    size = drawing_size(profile)
    found: list[Solution] = []
    placed: frozenset[str] = frozenset()
    for number, (full, names) in enumerate(_completions(profile, known, size)):
        if number >= MOST_TRIED or len(found) > MOST_GHOSTS:
            break
        placed = names
        if is_closed(assemble(full)) and _is_chosen(full):
            solution = solve(full, is_proven=False)
            if solution.status in (Status.SOLVED, Status.OVERDETERMINED) and solution.points:
                found.append(solution)
    if not found:
        return known
    first, *others = found
    moved = placed | {
        name for name, at in first.points.items() for other in others if _is_apart(at, other.points[name], size)
    }
    return replace(_known(first), placed=frozenset(moved), others=tuple(others))


def _is_apart(one: Point, other: Point, size: float) -> bool:
    return hypot(one[0] - other[0], one[1] - other[1]) > size / 1_000_000


def _completions(profile: Profile, known: Known, size: float) -> Iterator[tuple[Profile, frozenset[str]]]:
    """The profile with further facts that determine it, and the points that these are about."""
    names: list[str] = []
    extended, moves = profile, _moves(profile)
    while free := judge(assemble(extended)).free:
        open_ = [
            name for name in free if name not in names and name not in known.scalars and _is_placeable(name, profile)
        ]
        if not open_ or len(names) >= MOST_FREE:
            return
        names.append(max(open_, key=lambda name: round(moves.get(name, 1.0), 6)))
        extended = _with(profile, dict.fromkeys(names, 0.0))
    points = frozenset(name.rpartition(".")[0] for name in names if name not in profile.figure.radii)
    for steps in sorted(product(_STEPS, repeat=len(names)), key=lambda each: sum(map(_STEPS.index, each)))[:MOST_TRIED]:
        values: dict[str, float] = {}
        for name, step in zip(names, steps, strict=True):
            if name in profile.figure.radii:
                values[name] = abs(step) * size
                continue
            point, _, axis = name.rpartition(".")
            base, lead = _lead(profile, known, values, point, int(axis))
            values[name] = base + lead * step * size
        yield _with(profile, values), points


def _is_placeable(name: str, profile: Profile) -> bool:
    return name in profile.figure.radii or name.rpartition(".")[2] in (str(FIRST), str(SECOND))


def _moves(profile: Profile) -> dict[str, float]:
    """How much each coordinate changes when what is free moves by 1; 1 for what is not known."""
    affine = affine_facts(profile, profile.facts)
    freedoms = affine.freedoms() if affine is not None else ()
    return {
        scalar(freedom.point, axis): abs(freedom.direction[axis])
        for freedom in freedoms
        if freedom.direction is not None
        for axis in (FIRST, SECOND)
    }


def _lead(profile: Profile, known: Known, values: Mapping[str, float], point: str, axis: int) -> tuple[float, float]:
    """Where the element to a point comes from, on an axis, and the way (+1 or -1) in which the path leads on."""

    def get(name: str) -> float | None:
        return values.get(scalar(name, axis), known.coordinate(name, axis))

    comes = {element.head: element.tail for element in profile.figure.path}
    before = comes.get(point, profile.figure.start)
    base = get(before)
    earlier = get(comes[before]) if before in comes else None
    if base is None:
        return float(profile.start.values[axis] or 0), 1.0
    return base, -1.0 if earlier is not None and base < earlier else 1.0


def _with(profile: Profile, values: Mapping[str, float]) -> Profile:
    """The profile with unknowns at values."""
    givens, facts = dict(profile.givens), list(profile.facts)
    for name, value in values.items():
        given = f"put {name}"
        point, _, axis = name.rpartition(".")
        givens[given] = Given(given, Decimal(repr(round(value, 6))), Unit.MM, None)
        facts.append(Coordinate(given, point, int(axis)) if axis.isdigit() else Radius(given, name))
    return replace(profile, givens=givens, layout=Layout(profile.figure, tuple(facts)))


def drawing_size(profile: Profile) -> float:
    """How large a drawing is, by its words alone, mm."""
    start = [float(value or 0) for value in profile.start.values]
    sizes = []
    for fact in profile.facts:
        if isinstance(fact, Coordinate):
            sizes.append(abs(float(profile.givens[fact.given].value) - start[fact.axis]))
        elif isinstance(fact, Offset | Radius):
            sizes.append(abs(float(profile.givens[fact.given].value)))
    return max((size for size in sizes if size > 0), default=10.0)
