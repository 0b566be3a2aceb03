"""What the derivatives of constraints tell: which of them fix the points, what can still move, which say the same.

Along them, damped Gauss-Newton from many starts at once searches for solutions; it never counts more than it finds.
"""

from collections.abc import Mapping, Sequence
from decimal import Decimal
from itertools import combinations
from math import comb
from typing import Any

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import FIRST, SECOND, Coordinate, Fact, Heading, Level, Offset, Radius, scalar
from contoursolve.numeric import pinv, shortest_solution, svd
from contoursolve.tolerance import REGULAR
from contoursolve.verification.residuals import Array, ResidualSystem, direction

GENERIC = 1e-9
"""1 (share of a row). A row of derivatives at random values that others leave less of follows from them."""

NEARLY = 1e-5
"""1 (share of the largest). A singular value below this may be that of two solutions that have become one."""

MOST_SETS = 3_000
"""Sets of facts that are looked through for those that say the same."""


# --- What follows from what ------------------------------------------------------------------------


def jacobian_at_random(system: ResidualSystem) -> Array:
    """The derivatives of all facts at random values of everything, the same ones every time."""
    rng = numpy.random.default_rng(16)

    def some(names: Mapping[str, Any]) -> dict[str, float]:
        return {name: float(rng.uniform(1, 2)) for name in names}

    given = {name: direction(Decimal(rng.uniform(0, 360))) for name in system.directions}
    anywhere = replace(system, known=some(system.known), amounts=some(system.amounts), directions=given)
    values = rng.uniform(-2, 2, len(system.unknowns))
    for number, name in enumerate(system.unknowns):
        if name.endswith(".sin"):
            values[number - 1 : number + 1] = direction(Decimal(rng.uniform(0, 360)))
    return anywhere.jacobian(system.facts, values, {side: rng.choice((-1, 1)) for side in system.sides})


def independent(rows: Array, least: float) -> list[int]:
    """The rows of which none follows from those before it."""
    chosen: list[int] = []
    basis = numpy.zeros((0, rows.shape[1]))
    for number, row in enumerate(rows):
        rest = row
        for _ in range(2):
            rest = rest - (basis @ rest) @ basis
        left, size = float(numpy.linalg.norm(rest)), float(numpy.linalg.norm(row))
        if size > 0 and left > least * size:
            chosen.append(number)
            basis = numpy.vstack((basis, rest / left))
    return chosen


def is_linear(system: ResidualSystem) -> bool:
    """Whether all facts are about lines between points, so that their derivatives are the same everywhere."""
    return all(isinstance(fact, Offset | Coordinate | Heading) for fact in system.facts)


def _null_space(rows: Array) -> Array:
    """Directions, one a row, in which the unknowns can move."""
    _, sizes, right = svd(rows)
    null: Array = right[int((sizes > REGULAR).sum()) :]
    return null


def fixed(rows: Array) -> Array:
    """For each unknown, whether the rows leave it nowhere to go."""
    found: Array = abs(_null_space(rows)).max(axis=0, initial=0.0) <= REGULAR
    return found


def freedoms(rows: Array, system: ResidualSystem) -> dict[str, tuple[float, float] | None]:
    """The points that can move: along a unit vector, or anywhere (None)."""
    null, found = _null_space(rows), dict[str, tuple[float, float] | None]()
    for point in system.figure.points:
        moves = null[:, [system.unknowns.index(scalar(point, axis)) for axis in (FIRST, SECOND)]]
        if abs(moves).max(initial=0.0) > REGULAR:
            _, lengths, ways = svd(moves, full_matrices=False)
            is_line = int((lengths > REGULAR).sum()) == 1
            found[point] = (float(ways[0][FIRST]), float(ways[0][SECOND])) if is_line else None
    return found


LINEAR = (Coordinate, Offset, Heading, Level, Radius)
"""Facts whose derivatives are the same everywhere."""


def rigid(system: ResidualSystem) -> dict[str, float]:
    """The scalars that are known or that such facts alone put in their places."""
    facts = [fact for fact in system.facts if isinstance(fact, LINEAR)]
    if not facts:
        return dict(system.known)
    rows, off = system.linearised(facts)
    held = zip(system.unknowns, solved(rows, off).tolist(), fixed(rows), strict=True)
    return {**system.known, **{name: value for name, value, is_fixed in held if is_fixed}}


def solved(rows: Array, off: Array) -> Array:
    """The values, of all the shortest ones, that make linear facts true as nearly as they can be."""
    return shortest_solution(rows, -off) if len(rows) else numpy.zeros(rows.shape[1])


def compare(rows: Array, off: Array, others: Sequence[int], last: int) -> tuple[float, Array, bool]:
    """By how much a linear fact misses what others say (mm), the values that those give, and whether they fix all that
    it is about."""
    values = solved(rows[[*others]], off[[*others]])
    is_fixed = bool(fixed(rows[[*others]])[rows[last] != 0].all())
    return abs(float(rows[last] @ values + off[last])), values, is_fixed


class Tie(Struct, frozen=True):
    """Facts (by their numbers) that say the same, and by how much the one that is off most misses the others, mm."""

    facts: tuple[int, ...]
    off: float
    scale: float
    """1. How much of the rounding of one fact that is."""


def ties(rows: Array, off: Array) -> list[Tie] | None:
    """The smallest sets of facts of which each follows from the others; None where there are too many to look at."""
    found: list[Tie] = []
    rank = len(independent(rows, REGULAR))
    if rank == len(rows):
        return found
    if sum(comb(len(rows), size) for size in range(1, rank + 2)) > MOST_SETS:
        return None
    for size in range(1, rank + 2):
        for each in combinations(range(len(rows)), size):
            if any(set(other.facts) <= set(each) for other in found):
                continue
            # How often each row must be taken for all to add up to nothing.
            left, sizes, _ = svd(rows[list(each)])
            if int((sizes > REGULAR * max(1.0, float(sizes.max(initial=0.0)))).sum()) < size:
                least = float(abs(left[:, -1]).min())
                found.append(Tie(each, abs(float(left[:, -1] @ off[list(each)])) / least, 1 / least))
    return found


# --- How far values are from a solution --------------------------------------------------------------


class Correction(Struct, frozen=True):
    """How far each unknown is from where the facts put it to first order, `by`, and what rounding hides of that, mm.

    `fold` (mm) is how far the values are from two solutions that have become one, None where those are apart.
    `is_hidden` tells that several have become one in a way that leaves open how far off they are, `is_open` that the
    facts do not fix the values there.
    """

    by: Array
    unsure: Array
    fold: float | None = None
    is_hidden: bool = False
    is_open: bool = False


def correct(
    system: ResidualSystem, facts: Sequence[Fact], values: Array, signs: Mapping[str, Any], noise: float, hides: float
) -> Correction:
    """By how much as many facts as unknowns would move values; each fact is `noise` (mm) unsure itself. Two solutions
    are one where no more than what `hides` them (mm) keeps them apart."""
    off, slopes = system.residuals(facts, values, signs), system.jacobian(facts, values, signs)
    if not slopes.size or not numpy.isfinite(slopes).all():
        return Correction(numpy.full(len(values), numpy.nan), system.zero)
    left, sizes, right = svd(slopes)
    inverse = pinv(slopes, rcond=1e-15)
    apart = Correction(-inverse @ off, abs(inverse).sum(axis=1) * noise)
    if sizes[-1] > NEARLY * sizes[0]:
        return apart
    # Where two solutions have become one, the derivative vanishes along what could move.
    along, against = right[-1], left[:, -1]
    step = 1e-4 * max(1.0, float(abs(values).max()))
    bend = system.jacobian(facts, values + step * along, signs) - system.jacobian(facts, values - step * along, signs)
    curvature = float(against @ bend @ along) / (2 * step)
    if abs(curvature) <= GENERIC and sizes[-1] > REGULAR * sizes[0]:
        return apart
    if abs(curvature) <= GENERIC or (len(sizes) > 1 and sizes[-2] <= NEARLY * sizes[0]):
        is_open = _goes_on(system, facts, values, signs, along)
        return Correction(system.zero, system.zero, is_hidden=not is_open, is_open=is_open)
    fold = float(against @ slopes @ along) / curvature
    if abs(fold * sizes[-1]) > hides:
        return apart
    inner = (right[:-1].T / sizes[:-1]) @ left[:, :-1].T
    return Correction(-inner @ off - fold * along, abs(inner).sum(axis=1) * noise, fold=abs(fold))


def _goes_on(
    system: ResidualSystem, facts: Sequence[Fact], values: Array, signs: Mapping[str, Any], along: Array
) -> bool:
    """Whether there are other solutions all along a direction; a single one draws values back to itself."""
    step = 0.1 * max(1.0, float(abs(values).max()))
    own = {side: numpy.full(2, sign) for side, sign in signs.items()}
    starts = numpy.stack((values + step * along, values - step * along))
    ends = _descend(system, facts, starts, own, step)
    off = abs(system.residuals(facts, ends, own)).max(axis=-1)
    return bool(((abs(ends - values).max(axis=-1) > step / 20) & (off <= FOUND * step)).any())


# --- Search ------------------------------------------------------------------------------------------

STARTS, ROUNDS = 40, 40
"""Starts of a search, the same ones every time, and steps from each."""

FOUND = 1e-8
"""1 (share of the size). Residuals up to this are those of a solution, which is then taken to the last bit."""

APART = 1e-4
"""1 (share of the size). Solutions that are nearer are two that have become one."""


def search(
    system: ResidualSystem, facts: Sequence[Fact], size: float, near: Sequence[Array] = ()
) -> list[tuple[Array, dict[str, int]]]:
    """Solutions of facts, each with the signs of open sides, found from random starts within some sizes (mm) of the
    start point and from those values that are `near` one, NaN where these are not known."""
    rng = numpy.random.default_rng(16)
    # The sides of other facts are no solutions of their own.
    sides = list(dict.fromkeys(side for fact in facts for side in fact.sides()))
    tries = min(_MOST_TRIES, _TRIES * 2 ** len(sides))
    count = STARTS + tries * len(near)
    starts = rng.normal(0, 1, (count, len(system.unknowns))) * size * rng.choice((0.3, 1.0, 3.0), (count, 1))
    radii = [name in system.figure.radii for name in system.unknowns]
    starts[:, radii] = abs(starts[:, radii])
    for number, name in enumerate(system.unknowns):
        if name.endswith((".cos", ".sin")):
            starts[:, number] = rng.normal(0, 1, count)
    signs = {side: rng.choice((-1, 1), count) for side in sides}
    if near:
        told = numpy.repeat(numpy.array(near), tries, axis=0)
        turns = {side: 1 - 2 * (numpy.arange(len(told)) >> place & 1) for place, side in enumerate(sides)}
        first, held = starts[: len(told)], ~numpy.isnan(told)
        # Where several have become one, what is known would be lost on the way to what is not.
        first[:] = _descend(system, facts, numpy.where(held, told, first), turns, size, held[:, None, :])
        for side, its in turns.items():
            signs[side][: len(told)] = its
    values = _descend(system, facts, starts, signs, size)
    off = abs(system.residuals(facts, values, signs)).max(axis=-1, initial=0.0)
    found: list[tuple[Array, dict[str, int]]] = []
    for number in numpy.argsort(off, kind="stable"):
        own = {side: int(sign[number]) for side, sign in signs.items()}
        is_new = all(abs(values[number] - other).max() > APART * size or own != signs_of for other, signs_of in found)
        if off[number] <= FOUND * size and is_new and (values[number, radii] > 0).all():
            found.append((values[number], own))
    return found


_TRIES, _MOST_TRIES = 4, 64
"""Starts for each choice of open sides, and in all, from what a claimed path tells."""


def settle(
    system: ResidualSystem, facts: Sequence[Fact], values: Array, held: Array, signs: Mapping[str, int]
) -> Array:
    """Values with those that are not held where the facts put them."""
    if held.all():
        return values
    own = {side: numpy.full(1, sign) for side, sign in signs.items()}
    settled: Array = _descend(system, facts, values[None], own, float(abs(values).max()), held)[0]
    return settled


def _descend(
    system: ResidualSystem,
    facts: Sequence[Fact],
    values: Array,
    signs: Mapping[str, Array],
    size: float,
    held: Array | bool = False,
) -> Array:
    """Values after some steps downhill; a step that does not go down is taken shorter the next time."""
    damping, eye = numpy.full(len(values), 1e-3), numpy.eye(values.shape[-1])
    off = numpy.nan_to_num(system.residuals(facts, values, signs), nan=1e30)
    for _ in range(ROUNDS):
        slopes = numpy.where(held, 0.0, system.jacobian(facts, values, signs))
        across = numpy.swapaxes(slopes, -1, -2)
        downhill, normal = (
            numpy.nan_to_num(each, posinf=0.0, neginf=0.0)
            for each in (across @ off[..., None], across @ slopes + damping[:, None, None] * eye)
        )
        least = 1e-15 * (1 + abs(normal).max(axis=(-1, -2), keepdims=True))
        step = -numpy.linalg.solve(normal + least * eye, downhill)[..., 0]
        rest = numpy.nan_to_num(system.residuals(facts, values + step, signs), nan=1e30)
        is_better = (rest**2).sum(axis=-1) <= (off**2).sum(axis=-1)
        values = numpy.where(is_better[:, None], values + step, values)
        off = numpy.where(is_better[:, None], rest, off)
        damping = numpy.where(is_better, damping * 0.1, damping * 10).clip(1e-14, 1e6)
        if abs(step).max(initial=0.0) <= 1e-12 * size:
            break
    return values
