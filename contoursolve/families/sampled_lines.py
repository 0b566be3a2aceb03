"""The lines between where a contour exists and where not, among values of two words that were solved one by one, each
with what fails beyond it.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise

import numpy
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from contoursolve.diagnosis import join
from contoursolve.families.block_template import Template, called, errors_of
from contoursolve.families.case_classes import case_in
from contoursolve.families.feasible_ranges import Reason, failure_of, phrase, refused
from contoursolve.families.free_words import stated_by
from contoursolve.numeric import Array
from contoursolve.solving import REASONS, Check, Point, RefusalKind, Status, Test

Outcomes = NDArray[numpy.int64]
"""Outcome of each value: its status and the reason against it, as one number."""

STRIDE = 16
"""Points of a line of which one is solved by itself for what fails beyond it."""


SECTIONS = 8
"""Parts into which the way between two neighbours is divided of which one has the contour."""

ROUNDS = 3
"""Times that it is divided, each time the part in which the contour begins to exist."""


class Boundary(Struct, frozen=True):
    """A line between values that were solved, with and without the contour. `points` are values of both words; the
    first and the last are the same for a closed line. `reason` says what fails beyond it, and `outside` is the value
    without a contour that says so."""

    points: tuple[Point, ...]
    reason: Reason
    outside: Point


class Crossings(Struct, frozen=True):
    """Neighbours in a grid of which one has the contour: their places in it, by (edge, end, word), the one with the
    contour first; and the values between them on the line, and just beyond it, by (edge, word)."""

    nodes: NDArray[numpy.int64]
    points: Array
    outside: Array


def outcomes_of(status: NDArray[numpy.uint8], reason: NDArray[numpy.uint8]) -> Outcomes:
    """Outcomes, by the columns of a family."""
    found: Outcomes = status.astype(numpy.int64) * len(REASONS) + reason
    return found


def is_contour(outcomes: Outcomes) -> NDArray[numpy.bool_]:
    """Mask of the outcomes that are a contour: one that words agree about may be refused all the same."""
    return numpy.isin(outcomes, [code * len(REASONS) for code in (Status.SOLVED.code, Status.OVERDETERMINED.code)])


def crossings_of(
    axes: Sequence[Array], outcomes: Outcomes, solve: Callable[[Array], Outcomes] | None = None
) -> Crossings:
    """The neighbours in a grid, by (first word, second word), of which one has the contour. With a function that solves
    values, by (point, word), the line runs near where the contour begins to exist; else half-way between them."""
    solved, found = is_contour(outcomes), []
    for along in (0, 1):
        other = tuple(slice(1, None) if axis == along else slice(None) for axis in (0, 1))
        base = tuple(slice(None, -1) if axis == along else slice(None) for axis in (0, 1))
        here = numpy.argwhere(solved[base] != solved[other])
        pairs = numpy.stack([here, here + numpy.eye(2, dtype=numpy.int64)[along]], axis=1)
        is_first = solved[tuple(here.T)]
        found.append(numpy.where(is_first[:, None, None], pairs, pairs[:, ::-1]))
    nodes = numpy.concatenate(found)
    inside, outside = numpy.stack([axes[word][nodes[:, :, word]] for word in (0, 1)], axis=2).transpose(1, 0, 2)
    for _ in range(ROUNDS):
        if solve is None or not len(nodes):
            break
        shares = numpy.linspace(0.0, 1.0, SECTIONS + 1)[1:-1, None, None]
        between = inside + shares * (outside - inside)
        is_solved = is_contour(solve(between.reshape(-1, 2))).reshape(SECTIONS - 1, -1)
        number = numpy.where(is_solved.all(axis=0), SECTIONS - 1, is_solved.argmin(axis=0))[:, None]
        step = (outside - inside) / SECTIONS
        outside = numpy.where(number == SECTIONS - 1, outside, inside + (number + 1) * step)
        inside = inside + number * step
    return Crossings(nodes, (inside + outside) / 2, outside)


def boundaries_of(template: Template, outcomes: Outcomes, crossings: Crossings) -> Iterator[Boundary]:
    """The lines through the cells of a grid, those with ends first, parted where something else fails beyond them."""
    beyond = outcomes[tuple(crossings.nodes[:, 1].T)]
    for path in _paths(_links(crossings, outcomes.shape)):
        reasons = _Reasons(template, crossings.outside[path])
        cuts = [0, *sorted(_changes(beyond[path], reasons)), len(path) - 1]
        parts: list[tuple[list[int], Reason, Point]] = []
        for begin, end in pairwise(cuts):
            middle = (begin + end) // 2
            reason = reasons.at(middle)
            if parts and parts[-1][1].text == reason.text:
                parts[-1][0].extend(path[begin + 1 : end + 1])
            else:
                parts.append((path[begin : end + 1], reason, reasons.place(middle)))
        if len(parts) > 1 and path[0] == path[-1] and parts[0][1].text == parts[-1][1].text:
            (rest, *_), *parts = parts
            parts[-1][0].extend(rest[1:])
        for own, reason, outside in parts:
            points = tuple((float(one), float(two)) for one, two in crossings.points[own])
            yield Boundary(points, reason, outside)


def level_line(axes: Sequence[Array], values: Array, level: float) -> Iterator[Array]:
    """The lines on which a result has a value, between its values in a grid, by (first word, second word), as points of
    shape (n, 2); none through cells of which a corner has no value (NaN)."""
    is_above, found, points = values > level, [], []
    for along in (0, 1):
        other = tuple(slice(1, None) if axis == along else slice(None) for axis in (0, 1))
        base = tuple(slice(None, -1) if axis == along else slice(None) for axis in (0, 1))
        is_known = numpy.isfinite(values[base]) & numpy.isfinite(values[other])
        here = numpy.argwhere((is_above[base] != is_above[other]) & is_known)
        pairs = numpy.stack([here, here + numpy.eye(2, dtype=numpy.int64)[along]], axis=1)
        one, two = (values[tuple(pairs[:, end].T)] for end in (0, 1))
        share = ((level - one) / (two - one))[:, None]
        low, high = (numpy.stack([axes[word][pairs[:, end, word]] for word in (0, 1)], axis=1) for end in (0, 1))
        points.append(low + share * (high - low))
        found.append(numpy.where((one > level)[:, None, None], pairs, pairs[:, ::-1]))
    where = numpy.concatenate(points)
    crossings = Crossings(numpy.concatenate(found), where, where)
    yield from (where[path] for path in _paths(_links(crossings, values.shape, numpy.isfinite(values))))


def _links(
    crossings: Crossings, shape: tuple[int, ...], known: NDArray[numpy.bool_] | None = None
) -> dict[int, list[int]]:
    """The crossings that each is joined with, through the cells between four nodes, all of which are `known`."""
    cells: dict[tuple[int, int], list[int]] = {}
    low = crossings.nodes.min(axis=1)
    along = numpy.ptp(crossings.nodes, axis=1).argmax(axis=1)
    for number, ((i, j), axis) in enumerate(zip(low.tolist(), along.tolist(), strict=True)):
        for cell in ((i, j), (i, j - 1) if axis == 0 else (i - 1, j)):
            if 0 <= cell[0] < shape[0] - 1 and 0 <= cell[1] < shape[1] - 1 and (known is None or _holds(known, cell)):
                cells.setdefault(cell, []).append(number)
    links: dict[int, list[int]] = {number: [] for number in range(len(low))}
    for _, own in sorted(cells.items()):
        # Of two lines through a cell, each cuts off one of its corners with the contour.
        for one, other in _cut_off(crossings, own) if len(own) > 2 else [own]:  # noqa: PLR2004
            links[one].append(other)
            links[other].append(one)
    return links


def _holds(known: NDArray[numpy.bool_], cell: tuple[int, int]) -> bool:
    """Whether all four nodes of a cell are known."""
    return bool(known[cell[0] : cell[0] + 2, cell[1] : cell[1] + 2].all())


def _cut_off(crossings: Crossings, own: Sequence[int]) -> Iterator[list[int]]:
    """Pairs of four crossings: those with the same value that has the contour."""
    inside: dict[tuple[int, ...], list[int]] = {}
    for number in own:
        inside.setdefault(tuple(crossings.nodes[number, 0].tolist()), []).append(number)
    yield from inside.values()


def _paths(links: Mapping[int, list[int]]) -> Iterator[list[int]]:
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


class _Reasons:
    """Failures beyond a line, by single solves at places along it."""

    def __init__(self, template: Template, places: Array) -> None:
        self.template, self._places, self._known = template, places, dict[int, Reason]()

    def place(self, number: int) -> Point:
        """Values of both words beyond the line."""
        first, second = self._places[number].tolist()
        return first, second

    def at(self, number: int) -> Reason:
        """The reason there."""
        if number not in self._known:
            values = dict(zip(self.template.words, self.place(number), strict=True))
            self._known[number] = reason_at(self.template, values)
        return self._known[number]

    def change(self, low: int, high: int) -> int:
        """The first place of some at which another thing fails than at the lowest."""
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if self.at(middle).text == self.at(low).text else (low, middle)
        return high


def _changes(beyond: Outcomes, reasons: _Reasons) -> Iterator[int]:
    """Places along a line at which something else fails beyond it: at changes of the outcome, and among places with
    the same outcome, if single solves say so."""
    marks = [0, *(numpy.flatnonzero(numpy.diff(beyond)) + 1).tolist(), len(beyond)]
    for number, (begin, end) in enumerate(pairwise(marks)):
        if number and reasons.at(begin).text != reasons.at(begin - 1).text:
            yield begin
        for low, high in pairwise([*range(begin, end - 1, STRIDE), end - 1]):
            if reasons.at(low).text != reasons.at(high).text:
                yield reasons.change(low, high)


def reason_at(template: Template, values: Mapping[str, float]) -> Reason:
    """The reason why the row of these values has no contour, in words that hold for others as well."""
    answer = template.solve(values)
    failure, event = failure_of(answer)
    if not isinstance(event, RefusalKind):
        about = next((each.addresses for each in errors_of(answer)), ())
        free = [called(name) for name, word in template.words.items() if word.address in about]
        which = f"such values of {join(free)}" if free else "these values"
        text = failure.message if event is not None else refused(failure.code, event, which)
        return replace(failure, text=text) if failure.code else Reason("there is no contour", "", "")
    words = {name: word for name, word in template.words.items() if stated_by(word, answer.profile)}
    case = case_in(answer, words, values)
    refusal = next((each for each in case.solve(values).refusals if each.kind is event), None)
    if refusal is None:
        return failure
    element = refusal.elements[0] if refusal.elements else refusal.subject
    check = Check(refusal.kind, refusal.subject, element, Test.AT_LEAST, 0.0, refusal.givens)
    return replace(failure, text=phrase(check, refusal.kind, case))
