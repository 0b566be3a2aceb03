"""What the derivatives of constraints tell: which of them fix the points, what can still move, which say the same.

Along them, damped Gauss-Newton from many starts at once searches for solutions; it never counts more than it finds.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from itertools import combinations
from math import comb, hypot
from typing import Any

import numpy

from contoursolve.constraints import Coordinate, Heading, Level, Offset, Radius
from contoursolve.model import FIRST, SECOND, Fact, scalar
from contoursolve.tolerance import REGULAR
from contoursolve.verification.residuals import Array, Sheet, direction

GENERIC = 1e-9
"""1 (share of a row). A row of derivatives at random values that others leave less of follows from them."""

NEARLY = 1e-5
"""1 (share of the largest). A singular value below this may be that of two solutions that have become one."""

MOST_SETS = 3_000
"""Sets of facts that are looked through for those that say the same."""


@dataclass(frozen=True, slots=True)
class Correction:
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


def slopes_at_random(sheet: Sheet) -> Array:
    """The derivatives of all facts at random values of everything, the same ones every time."""
    rng = numpy.random.default_rng(16)

    def some(names: Mapping[str, Any]) -> dict[str, float]:
        return {name: float(rng.uniform(1, 2)) for name in names}

    given = {name: direction(Decimal(rng.uniform(0, 360))) for name in sheet.directions}
    anywhere = replace(sheet, known=some(sheet.known), amounts=some(sheet.amounts), directions=given)
    values = rng.uniform(-2, 2, len(sheet.unknowns))
    for number, name in enumerate(sheet.unknowns):
        if name.endswith(".sin"):
            values[number - 1 : number + 1] = direction(Decimal(rng.uniform(0, 360)))
    return anywhere.slopes(sheet.facts, values, {side: rng.choice((-1, 1)) for side in sheet.sides})


def independent(rows: Array, least: float, first: Sequence[int] = ()) -> list[int]:
    """The rows of which none follows from those before it; some of them may be taken first."""
    chosen: list[int] = []
    basis = numpy.zeros((0, rows.shape[1]))
    for number in dict.fromkeys((*first, *range(len(rows)))):
        rest, size = rows[number], float(numpy.linalg.norm(rows[number]))
        for _ in range(2):
            rest = rest - (basis @ rest) @ basis
        left = float(numpy.linalg.norm(rest))
        if size > 0 and left > least * size:
            chosen.append(number)
            basis = numpy.vstack((basis, rest / left))
    return sorted(chosen)


def is_linear(sheet: Sheet) -> bool:
    """Whether all facts are about lines between points, so that their derivatives are the same everywhere."""
    return all(isinstance(fact, Offset | Coordinate | Heading) for fact in sheet.facts)


def correct(
    sheet: Sheet, facts: Sequence[Fact], values: Array, signs: Mapping[str, Any], noise: float, hides: float
) -> Correction:
    """By how much as many facts as unknowns would move values; each fact is `noise` (mm) unsure itself. Two solutions
    are one where no more than what `hides` them (mm) keeps them apart."""
    off, slopes = sheet.residuals(facts, values, signs), sheet.slopes(facts, values, signs)
    if not slopes.size or not numpy.isfinite(slopes).all():
        return Correction(numpy.full(len(values), numpy.nan), numpy.zeros(len(values)))
    left, sizes, right = numpy.linalg.svd(slopes)
    if sizes[-1] > NEARLY * sizes[0]:
        return _apart(off, slopes, noise)
    # Where two solutions have become one, the derivative vanishes along what could move.
    along, against = right[-1], left[:, -1]
    step = 1e-4 * max(1.0, float(abs(values).max()))
    bend = sheet.slopes(facts, values + step * along, signs) - sheet.slopes(facts, values - step * along, signs)
    curvature = float(against @ bend @ along) / (2 * step)
    if abs(curvature) <= GENERIC and sizes[-1] > REGULAR * sizes[0]:
        return _apart(off, slopes, noise)
    if abs(curvature) <= GENERIC or (len(sizes) > 1 and sizes[-2] <= NEARLY * sizes[0]):
        nothing, is_open = numpy.zeros(len(values)), _goes_on(sheet, facts, values, signs, along)
        return Correction(nothing, nothing, is_hidden=not is_open, is_open=is_open)
    fold = float(against @ slopes @ along) / curvature
    if abs(fold * sizes[-1]) > hides:
        return _apart(off, slopes, noise)
    inner = (right[:-1].T / sizes[:-1]) @ left[:, :-1].T
    by = -inner @ off - fold * along
    return Correction(by, abs(inner).sum(axis=1) * noise, fold=abs(fold))


def _goes_on(sheet: Sheet, facts: Sequence[Fact], values: Array, signs: Mapping[str, Any], along: Array) -> bool:
    """Whether there are other solutions all along a direction; a single one draws values back to itself."""
    step = 0.1 * max(1.0, float(abs(values).max()))
    own = {side: numpy.full(2, sign) for side, sign in signs.items()}
    starts = numpy.stack((values + step * along, values - step * along))
    ends = _descend(sheet, facts, starts, own, step, numpy.zeros(len(values), bool))
    off = abs(sheet.residuals(facts, ends, own)).max(axis=-1)
    return bool(((abs(ends - values).max(axis=-1) > step / 20) & (off <= FOUND * step)).any())


def _apart(off: Array, slopes: Array, noise: float) -> Correction:
    inverse = numpy.linalg.pinv(slopes, rcond=1e-15)
    return Correction(-inverse @ off, abs(inverse).sum(axis=1) * noise)


def freedoms(rows: Array, sheet: Sheet) -> dict[str, tuple[float, float] | None]:
    """The points that can move: along a unit vector, or anywhere (None)."""
    _, sizes, right = numpy.linalg.svd(rows)
    null = right[int((sizes > REGULAR).sum()) :]
    found: dict[str, tuple[float, float] | None] = {}
    for point in sheet.figure.points:
        columns = [sheet.unknowns.index(scalar(point, axis)) for axis in (FIRST, SECOND)]
        moves = null[:, columns]
        if not len(moves) or abs(moves).max() <= REGULAR:
            continue
        _, lengths, ways = numpy.linalg.svd(moves, full_matrices=False)
        is_line = int((lengths > REGULAR).sum()) == 1
        found[point] = (float(ways[0][FIRST]), float(ways[0][SECOND])) if is_line else None
    return found


@dataclass(frozen=True, slots=True)
class Tie:
    """Facts (by their numbers) that say the same, and by how much the one that is off most misses the others, mm."""

    facts: tuple[int, ...]
    off: float
    scale: float
    """1. How much of the rounding of one fact that is."""


def ties(rows: Array, off: Array) -> list[Tie] | None:
    """The smallest sets of facts of which each follows from the others; None where there are too many to look at."""
    found: list[Tie] = []
    rank = len(independent(rows, REGULAR))
    spare = len(rows) - rank
    if spare and sum(comb(len(rows), size) for size in range(1, rank + 2)) > MOST_SETS:
        return None
    for size in range(1, rank + 2 if spare else 1):
        for each in combinations(range(len(rows)), size):
            if any(set(other.facts) <= set(each) for other in found):
                continue
            weights = _tied(rows[list(each)])
            if weights is not None:
                gap = float(weights @ off[list(each)])
                least = float(abs(weights).min())
                found.append(Tie(each, abs(gap) / least, 1 / least))
    return found


def _tied(rows: Array) -> Array | None:
    """How often each row must be taken for all to add up to nothing; None where they do not."""
    left, sizes, _ = numpy.linalg.svd(rows)
    rank = int((sizes > REGULAR * max(1.0, float(sizes.max(initial=0.0)))).sum())
    return None if rank == len(rows) else left[:, -1]


def turns(found: tuple[float, float], claimed: tuple[float, float]) -> float:
    """The sine of the angle between two lines."""
    return (found[0] * claimed[1] - found[1] * claimed[0]) / max(hypot(*claimed), REGULAR)


LINEAR = (Coordinate, Offset, Heading, Level, Radius)
"""Facts whose derivatives are the same everywhere."""


def rigid(sheet: Sheet) -> dict[str, float]:
    """The scalars that are known or that such facts alone put in their places."""
    facts, nothing = [fact for fact in sheet.facts if isinstance(fact, LINEAR)], numpy.zeros(len(sheet.unknowns))
    if not facts:
        return dict(sheet.known)
    rows, off = sheet.slopes(facts, nothing, {}), sheet.residuals(facts, nothing, {})
    values = numpy.linalg.lstsq(rows, -off, rcond=None)[0].tolist()
    held = zip(sheet.unknowns, values, fixed(rows), strict=True)
    return {**sheet.known, **{name: value for name, value, is_fixed in held if is_fixed}}


def fixed(rows: Array) -> Iterator[bool]:
    """For each unknown, whether the rows leave it nowhere to go."""
    _, sizes, right = numpy.linalg.svd(rows)
    null = right[int((sizes > REGULAR).sum()) :]
    yield from (not len(null) or float(abs(column).max()) <= REGULAR for column in null.T)


STARTS, ROUNDS = 40, 40
"""Starts of a search, the same ones every time, and steps from each."""

FOUND = 1e-8
"""1 (share of the size). Residuals up to this are those of a solution, which is then taken to the last bit."""

APART = 1e-4
"""1 (share of the size). Solutions that are nearer are two that have become one."""


def search(
    sheet: Sheet, facts: Sequence[Fact], size: float, near: Sequence[Array] = ()
) -> list[tuple[Array, dict[str, int]]]:
    """Solutions of facts, each with the signs of open sides, found from random starts within some sizes (mm) of the
    start point and from those values that are `near` one."""
    rng = numpy.random.default_rng(16)
    starts = rng.normal(0, 1, (STARTS, len(sheet.unknowns))) * size * rng.choice((0.3, 1.0, 3.0), (STARTS, 1))
    for number, name in enumerate(sheet.unknowns):
        if name in sheet.figure.radii:
            starts[:, number] = abs(starts[:, number])
        if name.endswith((".cos", ".sin")):
            starts[:, number] = rng.normal(0, 1, STARTS)
    signs = {side: rng.choice((-1, 1), STARTS) for side in sheet.sides}
    for number, values in enumerate(near[:STARTS]):
        starts[number] = values
    values = _descend(sheet, facts, starts, signs, size, numpy.zeros(len(sheet.unknowns), bool))
    off = abs(sheet.residuals(facts, values, signs)).max(axis=-1, initial=0.0)
    found: list[tuple[Array, dict[str, int]]] = []
    for number in numpy.argsort(off, kind="stable"):
        own = {side: int(sign[number]) for side, sign in signs.items()}
        is_new = all(abs(values[number] - other).max() > APART * size or own != sides for other, sides in found)
        if off[number] <= FOUND * size and is_new and _are_sizes(sheet, values[number]):
            found.append((values[number], own))
    return found


def _are_sizes(sheet: Sheet, values: Array) -> bool:
    """Whether every radius is one."""
    radii = [number for number, name in enumerate(sheet.unknowns) if name in sheet.figure.radii]
    return bool((values[radii] > 0).all())


def _descend(
    sheet: Sheet, facts: Sequence[Fact], values: Array, signs: dict[str, Array], size: float, held: Array
) -> Array:
    """Values after some steps downhill; a step that does not go down is taken shorter the next time."""
    damping = numpy.full(len(values), 1e-3)
    eye = numpy.eye(values.shape[-1])
    off = numpy.nan_to_num(sheet.residuals(facts, values, signs), nan=1e30)
    for _ in range(ROUNDS):
        slopes = numpy.where(held, 0.0, sheet.slopes(facts, values, signs))
        across = numpy.swapaxes(slopes, -1, -2)
        normal = across @ slopes + damping[:, None, None] * eye
        downhill = numpy.nan_to_num(across @ off[..., None], posinf=0.0, neginf=0.0)
        normal = numpy.nan_to_num(normal, posinf=0.0, neginf=0.0)
        least = 1e-15 * (1 + abs(normal).max(axis=(-1, -2), keepdims=True))
        step = -numpy.linalg.solve(normal + least * eye, downhill)
        tried = values + step[..., 0]
        rest = numpy.nan_to_num(sheet.residuals(facts, tried, signs), nan=1e30)
        is_better = (rest**2).sum(axis=-1) <= (off**2).sum(axis=-1)
        values = numpy.where(is_better[:, None], tried, values)
        off = numpy.where(is_better[:, None], rest, off)
        damping = numpy.where(is_better, damping * 0.1, damping * 10).clip(1e-14, 1e6)
        if abs(step).max(initial=0.0) <= 1e-12 * size:
            break
    return values


def fill(
    sheet: Sheet, facts: Sequence[Fact], values: Array, signs: Mapping[str, int], free: Array, size: float
) -> list[Array]:
    """Values of those unknowns that are free, from a few starts; the others stay."""
    rng, found = numpy.random.default_rng(16), list[Array]()
    for count in (1, _TRIES):
        starts = numpy.tile(values, (count, 1))
        starts[:, free] += rng.normal(0, 1, (count, int(free.sum()))) * size
        for number, name in enumerate(sheet.unknowns):
            if free[number] and name.endswith((".cos", ".sin")):
                starts[:, number] = rng.normal(0, 1, count)
        own = {side: numpy.full(count, sign) for side, sign in signs.items()}
        found += list(_descend(sheet, facts, starts, own, size, ~free))
        if abs(sheet.residuals(sheet.facts, found[0], signs)).max(initial=0.0) <= FOUND * size:
            break
    return found


_TRIES = 6
"""Starts from which unknowns are found that a path does not tell."""
