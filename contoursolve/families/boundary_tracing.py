"""The edge of the region in two words in which all checks of a contour are passed: points on a grid's edges, joined
cell by cell, each brought onto the zero of the margin that governs it.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Protocol

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.families.branches import LEVEL, Branch
from contoursolve.families.subdivision import bisect
from contoursolve.numeric import Array, Intervals
from contoursolve.solving import RefusalKind, Test

NODES = 65
"""Nodes of the grid along each word."""

BISECTIONS = 45
"""From a cell to rounding."""

NEWTON, CLOSE = 6, 1e-6
"""Steps onto a zero, and the share of the range that a step may have to lead to the same zero."""

SAG, HALVINGS = 2e-4, 4
"""Share of the range by which an edge may leave its curve before it is divided, and how often it is."""

LEVELS, MOST = 6, 10_000
"""How often a cell is divided in which intervals do not tell that all of it is alike, and into how many parts."""

FAR = 1.5
"""Cells that the corner of two lines may be away from the middle of their points."""

Cell = tuple[int, int]
Node = tuple[str, int]
"""A point on an edge of the grid, or a corner where two checks begin to fail, by its number."""


class BoundaryTrace(Struct, frozen=True):
    """A line of the edge on which one check begins to fail; its first and last point are the same if it is closed."""

    check: int
    points: Array
    """By (point, word)."""


class Grid(Protocol):
    """What lines are drawn on: rows at the nodes of a grid over a box of two words, `count` along each."""

    count: int
    bisections: int
    nodes: Array

    def onto(self, points: Array, checks: NDArray[numpy.int64]) -> Array:
        """Points moved the shortest way onto the zeros of their margins; NaN where there is none."""

    def corner(self, start: Array, one: int, other: int) -> Array | None:
        """Where two margins are both zero; None where that is not told."""

    def share(self, vectors: Array) -> Array:
        """The length of vectors by (point, word) in shares of the box."""


class Field:
    """The margins of one class of contours on a grid over a box of two words, of all its solutions one after the other.
    Inside is where one solution alone passes its checks."""

    count, bisections = NODES, BISECTIONS

    def __init__(self, branches: Sequence[Branch], low: Sequence[float], high: Sequence[float]) -> None:
        self.branches, self.low, self.high = branches, numpy.array(low), numpy.array(high)
        self.size = self.high - self.low
        self.checks = tuple(check for branch in branches for check in branch.margins.checks)
        self.axes = [numpy.linspace(low[word], high[word], NODES) for word in (0, 1)]
        grid = numpy.meshgrid(*self.axes, indexing="ij")
        self.nodes = numpy.stack([each.ravel() for each in grid], axis=1)
        self.at_nodes = self.values(self.nodes)
        self.is_inside = (self._governing(self.at_nodes) < 0).reshape(NODES, NODES)

    def values(self, points: Array) -> Array:
        """All margins by (check, point)."""
        words = [points[:, 0], points[:, 1]]
        return numpy.concatenate([branch.at(words) for branch in self.branches])

    def slopes(self, points: Array) -> Array:
        """The derivatives of all margins by (word, check, point), each for the whole width of the box."""
        words = [points[:, 0], points[:, 1]]
        slopes = [branch.slopes_at(words) for branch in self.branches]
        found: Array = numpy.concatenate(slopes, axis=1) * self.size[:, None, None]
        return found

    def failing(self, points: Array) -> NDArray[numpy.int64]:
        """The check by which each point is outside; -1 inside."""
        return self._governing(self.values(points))

    def fails(self, points: Array) -> NDArray[numpy.bool_]:
        """Which checks fail, by (check, point)."""
        parts = zip(self.branches, self._parts(self.values(points)), strict=True)
        return numpy.concatenate([branch.margins.failing(values) for branch, values in parts])

    def passing(self, number: int) -> NDArray[numpy.bool_]:
        """The nodes at which the solution that a check is about passes all of its checks alone."""
        own = number // len(self.branches[0].margins.checks)
        fails = self.branches[own].margins.failing(self._parts(self.at_nodes)[own]).any(axis=0)
        found: NDArray[numpy.bool_] = self.is_inside & ~fails.reshape(NODES, NODES)
        return found

    def _parts(self, values: Array) -> list[Array]:
        return numpy.split(values, len(self.branches))

    def _governing(self, values: Array) -> NDArray[numpy.int64]:
        parts = self._parts(values)
        if len(parts) == 1:
            return self.branches[0].margins.first_failing(values)
        excess = []
        for branch, part in zip(self.branches, parts, strict=True):
            size = numpy.where(branch.margins.is_apart, numpy.abs(part), part)
            excess.append(numpy.nan_to_num(size - branch.margins.limits, nan=-numpy.inf))
        least = numpy.stack([each.min(axis=0) for each in excess])
        passing = (least >= 0).sum(axis=0)
        # Where none passes, one just fails; where several pass, one of them just does.
        closest = numpy.where((least >= 0) == (passing > 0), numpy.abs(least), numpy.inf).argmin(axis=0)
        every = numpy.stack(excess)[closest, :, numpy.arange(values.shape[1])]
        own = (every <= numpy.maximum(every.min(axis=1), 0.0)[:, None] + LEVEL).argmax(axis=1)
        found: NDArray[numpy.int64] = numpy.where(passing == 1, -1, closest * len(parts[0]) + own)
        return found

    def share(self, vectors: Array) -> Array:
        """The length of vectors by (point, word) in shares of the box."""
        found: Array = (numpy.abs(vectors) / self.size).max(axis=1)
        return found

    def onto(self, points: Array, checks: NDArray[numpy.int64]) -> Array:
        """Points moved the shortest way onto the zeros of their margins; NaN where there is none."""
        found, every = points.copy(), numpy.arange(len(points))
        with numpy.errstate(all="ignore"):
            for _ in range(NEWTON):
                value = self.values(found)[checks, every]
                slope = self.slopes(found)[:, checks, every].T
                found = found - (value / (slope**2).sum(axis=1))[:, None] * slope * self.size
        return found

    def corner(self, start: Array, one: int, other: int) -> Array | None:
        """Where two margins are both zero, by Newton's method; None if that is not within a cell or so."""
        found = start.copy()
        for _ in range(4 * NEWTON):
            values = self.values(found[None])[[one, other], 0]
            matrix = self.slopes(found[None])[:, [one, other], 0].T
            try:
                found = found - numpy.linalg.solve(matrix, values) * self.size
            except numpy.linalg.LinAlgError:
                return None
            if not numpy.isfinite(found).all():
                return None
        return found if self.share((found - start)[None])[0] <= FAR / (NODES - 1) else None

    def is_proven(self, cells: Iterable[Cell]) -> bool:
        """Whether each cell that is not one of these, or next to one, is alike in all of it, by interval arithmetic."""
        near = {(i + di, j + dj) for i, j in cells for di in (-1, 0, 1) for dj in (-1, 0, 1)}
        rest = [(i, j) for i in range(NODES - 1) for j in range(NODES - 1) if (i, j) not in near]
        if not rest:
            return True
        first, second = numpy.array(rest).T
        low = numpy.stack([self.axes[0][first], self.axes[1][second]], axis=1)
        high = numpy.stack([self.axes[0][first + 1], self.axes[1][second + 1]], axis=1)
        for _ in range(LEVELS + 1):
            is_open = self._is_open([Intervals(low[:, word], high[:, word]) for word in (0, 1)])
            low, high = low[is_open], high[is_open]
            # What is left along the edge of the box is narrower than a cell.
            is_within = ((low > self.low) & (high < self.high)).all(axis=1)
            if not is_within.any():
                return True
            if len(low) > MOST:
                return False
            middle = (low + high) / 2
            quarters = [
                (numpy.where(take, middle, low), numpy.where(take, high, middle))
                for take in ([False, False], [False, True], [True, False], [True, True])
            ]
            low, high = (numpy.concatenate([each[side] for each in quarters]) for side in (0, 1))
        return False

    def _is_open(self, words: list[Intervals]) -> NDArray[numpy.bool_]:
        """In which boxes it is not decided whether one solution alone passes its checks."""
        size = words[0].low.size
        undecided, passing = numpy.zeros(size, bool), numpy.zeros(size, numpy.int64)
        for branch, at_nodes in zip(self.branches, self._parts(self.at_nodes), strict=True):
            is_level = numpy.nan_to_num(numpy.abs(at_nodes)).max(axis=1) <= LEVEL
            passes, fails = branch.verdicts(words, is_level)
            undecided |= ~(passes | fails)
            passing += passes
        return undecided & (passing < 2)  # noqa: PLR2004 - two contours are one too many, whatever the others are


class GridLines:
    """The lines that part two states of the nodes of a grid, such as inside and outside.

    `tell` gives the state of points, and `govern` the check whose margin is zero between two points that differ.
    `is_counted` are the nodes between which lines are sought.
    """

    def __init__(
        self,
        field: Grid,
        states: NDArray[numpy.bool_],
        tell: Callable[[Array], NDArray[numpy.bool_]],
        govern: Callable[[Array], NDArray[numpy.int64]],
        is_counted: NDArray[numpy.bool_],
    ) -> None:
        self.field, self.states, self.tell = field, states, tell
        self.corners: list[Array] = []
        self.edges: dict[tuple[int, int, int], int] = {}
        pairs = list(self._edges(is_counted))
        inside, outside = (field.nodes[[pair[side] for pair in pairs]] for side in (0, 1))
        outside = bisect(inside, outside, lambda points: tell(points)[:, None], self.field.bisections)[1]
        self.checks = govern(outside) if pairs else numpy.zeros(0, numpy.int64)
        self.points = outside
        if pairs:
            exact = field.onto(outside, self.checks)
            is_close = field.share(exact - outside) <= CLOSE  # false for NaN
            self.points = numpy.where(is_close[:, None], exact, outside)
        self.cells = self._cells()

    def _edges(self, is_counted: NDArray[numpy.bool_]) -> Iterator[tuple[int, int]]:
        """The nodes on the two sides of the lines, the one whose state is true first."""
        for along in (0, 1):
            shift = (slice(1, None), slice(None)) if along == 0 else (slice(None), slice(1, None))
            base = (slice(-1), slice(None)) if along == 0 else (slice(None), slice(-1))
            differ = (self.states[base] != self.states[shift]) & is_counted[base] & is_counted[shift]
            for i, j in numpy.argwhere(differ).tolist():
                self.edges[along, i, j] = len(self.edges)
                here, there = (
                    i * self.field.count + j,
                    (i + 1) * self.field.count + j if along == 0 else i * self.field.count + j + 1,
                )
                yield (here, there) if self.states[i, j] else (there, here)

    def _cells(self) -> dict[Cell, list[int]]:
        """The points on the edges of each cell."""
        cells: dict[Cell, list[int]] = {}
        for (along, i, j), number in self.edges.items():
            for cell in ((i, j), (i, j - 1) if along == 0 else (i - 1, j)):
                if min(cell) >= 0 and max(cell) < self.field.count - 1:
                    cells.setdefault(cell, []).append(number)
        return cells

    def traces(self) -> list[BoundaryTrace]:
        """The lines, one for each check that governs a part."""
        links: dict[int, dict[Node, list[Node]]] = {}
        for first, second, check in self._segments():
            at = links.setdefault(check, {})
            at.setdefault(first, []).append(second)
            at.setdefault(second, []).append(first)
        found = []
        for check in sorted(links):
            for path in _paths(links[check]):
                points = numpy.array([self._at(node) for node in path])
                found.append(BoundaryTrace(check, self._refined(points, check)))
        return found

    def _at(self, node: Node) -> Array:
        point: Array = self.points[node[1]] if node[0] == "edge" else self.corners[node[1]]
        return point

    def _segments(self) -> Iterator[tuple[Node, Node, int]]:
        """What joins the points of each cell, and the check that governs it."""
        for cell, numbers in sorted(self.cells.items()):
            for first, second in self._pairs(cell, numbers):
                yield from self._joined(first, second)

    def _pairs(self, cell: Cell, numbers: list[int]) -> list[tuple[int, int]]:
        """Which of the points on the edges of a cell belong together; a line may end in a cell."""
        if len(numbers) < 4:  # noqa: PLR2004 - one line through the cell
            return [(numbers[0], numbers[1])] if len(numbers) > 1 else []
        i, j = cell
        center = (self.field.nodes[i * self.field.count + j] + self.field.nodes[(i + 1) * self.field.count + j + 1]) / 2
        # The two corners of the cell that differ from its middle are cut off, each by the edges that meet there.
        left, bottom = self.edges[1, i, j], self.edges[0, i, j]
        right, top = self.edges[1, i + 1, j], self.edges[0, i, j + 1]
        if bool(self.tell(center[None])[0]) == bool(self.states[i, j]):
            return [(bottom, right), (left, top)]
        return [(left, bottom), (right, top)]

    def _joined(self, first: int, second: int) -> Iterator[tuple[Node, Node, int]]:
        one, other = int(self.checks[first]), int(self.checks[second])
        if one == other:
            yield ("edge", first), ("edge", second), one
            return
        corner = self.field.corner((self.points[first] + self.points[second]) / 2, one, other)
        if corner is None:
            return  # the lines end in this cell
        self.corners.append(corner)
        node = "corner", len(self.corners) - 1
        yield ("edge", first), node, one
        yield node, ("edge", second), other

    def _refined(self, points: Array, check: int) -> Array:
        """A line with points added where it leaves its curve."""
        for _ in range(HALVINGS):
            middles = (points[1:] + points[:-1]) / 2
            on = self.field.onto(middles, numpy.full(len(middles), check))
            sag, width = self.field.share(on - middles), self.field.share(points[1:] - points[:-1])
            places = numpy.flatnonzero((sag > SAG) & (sag < width))  # neither for NaN
            if not places.size:
                break
            points = numpy.insert(points, places + 1, on[places], axis=0)
        return points


def edge_of(field: Field) -> GridLines:
    """The edge of the region in which all checks are passed."""
    everywhere = numpy.ones_like(field.is_inside)
    return GridLines(field, field.is_inside, lambda points: field.failing(points) < 0, field.failing, everywhere)


def gaps_of(field: Field) -> Iterator[GridLines]:
    """The lines within the region on which something is zero that must not be."""
    for number, check in enumerate(field.checks):
        if check.test is Test.APART and check.kind is not RefusalKind.LANDING_UNKNOWN:
            lines = GridLines(
                field,
                (field.at_nodes[number] > 0).reshape(NODES, NODES),
                lambda points, number=number: field.values(points)[number] > 0,  # type: ignore[misc]
                lambda points, number=number: numpy.full(len(points), number),  # type: ignore[misc]
                field.passing(number),
            )
            if lines.edges:
                yield lines


def _paths(links: Mapping[Node, list[Node]]) -> Iterator[list[Node]]:
    """The lines that links make, those with ends first."""
    left = {node: list(others) for node, others in links.items()}
    for begin in sorted(left, key=lambda node: (len(links[node]) != 1, node)):
        while left[begin]:
            path = [begin]
            while left[path[-1]]:
                there = left[path[-1]].pop(0)
                left[there].remove(path[-1])
                path.append(there)
            yield path
