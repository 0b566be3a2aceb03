"""Steps without a closed form: all solutions in a range, by dividing it until each box holds one or none."""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy
from msgspec import Struct

from contoursolve.geometry import System
from contoursolve.numeric import (
    Array,
    Boxes,
    Finder,
    Intervals,
    Narrower,
    Number,
    Replay,
    Tape,
    approach,
    ball,
    constant,
    contract,
    expressions,
    finder_of,
    intervals,
    joined,
    stacked,
)
from contoursolve.solving.determinacy import basis_of
from contoursolve.solving.elimination import Root
from contoursolve.solving.implied_constraints import consequences, necessities
from contoursolve.solving.inputs import input_values
from contoursolve.solving.krawczyk import keep, prove, refine
from contoursolve.solving.partition import Group
from contoursolve.solving.step_equations import Kernel

BATCH = 1024
"""The number of boxes that are looked at together."""

FEW = 32
"""Fewer boxes than these are divided further before they are looked at."""

DIVISION = 0.487
"""Boxes are divided away from the middle, where drawings like to have their solutions."""

NARROWEST = 2.0**-33
"""A box this small in every direction, as a share of how large and how far away it is, is given up as undecided."""

MARGINS = (2.0**-43, 2.0**-37, 2.0**-31)
"""By how much of its coordinates a box is inflated before it is tested; the larger ones for the smallest boxes, in
which rounding hides the solution."""

STARTS, STEPS, TRIED = 2000, 25, 64
"""The number of boxes that remain undecided from which Newton's method starts, how many steps it takes, and how many of
the places to which it leads are tried to be proven to hold a solution."""

PASSES, WORTHWHILE = 3, 0.8
"""The number of times that boxes are narrowed by each equation before they are by all, and the share of an unknown's
range that must be left after a pass for another one not to be worthwhile."""


class Conditions(Struct, frozen=True, eq=False):
    """The conditions that a group's unknowns must satisfy, for intervals.

    `narrower` has the equations, what follows from them, and what must not be negative; `equations` the equations
    and their derivatives, row by row.
    """

    unknowns: tuple[str, ...]
    narrower: Narrower
    narrowed_by: tuple[str, ...]
    equations: Replay
    arguments: tuple[str, ...]


Range = tuple[float, float]
"""The least and the largest value of an unknown."""


class Task(Struct, frozen=True, eq=False):
    """The places where solutions of a group are searched for: cases, each with the values of the group's other inputs,
    the range of each unknown, and how many intervals may be looked at for all of the cases together.

    The box of `inner` ranges, if there is one, is left out: it was searched before. `sizes` are an ordinary value of
    each unknown, and how far others ordinarily are from it: what is farther away is divided by magnitude. With
    `is_guessing`, points near which there may be solutions are looked for in what remains undecided.
    """

    cases: Sequence[Mapping[str, Number]]
    reach: Mapping[str, Range]
    sizes: Mapping[str, Range]
    budget: int
    is_guessing: bool
    inner: Mapping[str, Range] | None = None

    def boxes(self, unknowns: Sequence[str]) -> list[list[Range]]:
        """The boxes that make up what is searched."""
        whole = [self.reach[name] for name in unknowns]
        if self.inner is None:
            return [whole]
        found, left = list[list[Range]](), list(whole)
        for number, name in enumerate(unknowns):
            (low, high), (begin, end) = whole[number], self.inner[name]
            parts = [part for part in ((low, begin), (end, high)) if part[0] < part[1]]
            found += [[*left[:number], part, *left[number + 1 :]] for part in parts]
            left[number] = max(low, begin), min(high, end)
        return found


class Division(Struct, frozen=True):
    """Boxes that are proven to hold exactly one solution, and whether they hold all of them.

    `likely` are points near which there may be others, in the boxes that remain undecided.
    """

    proven: Boxes
    likely: list[list[float]]
    is_complete: bool


@lru_cache(maxsize=1024)
def conditions_of(system: System, group: Group) -> Conditions:
    """The conditions of a group of facts of a system."""
    tape = Tape()
    for name in group.unknowns:
        tape.input(name)
    at = input_values(system.headed, tape, {})
    zeros = [
        *(fact.equation(at) for fact in group.facts),
        *consequences(group.facts, basis_of(system), system.headed, at),
    ]
    signs = necessities(system.figure, group.facts, at)
    for number, expression in enumerate((*zeros, *signs)):
        tape.output(str(number), expression)
    slopes = Tape()
    unknowns = [slopes.input(name) for name in group.unknowns]
    equations = [fact.equation(input_values(system.headed, slopes, {})) for fact in group.facts]
    slopes.output("equations and slopes", expressions.with_slopes(equations, unknowns)[0])
    return Conditions(
        group.unknowns,
        Narrower(tape.shared(), len(zeros)),
        tape.inputs,
        Replay(slopes.shared(), intervals.FUNCTIONS, constant),
        slopes.inputs,
    )


def divide(conditions: Conditions, tasks: Sequence[Task]) -> list[tuple[list[Division], int]]:
    """All solutions within reach for each case of each task, and how many intervals were looked at for the task."""
    size = len(conditions.unknowns)
    cases = [case for task in tasks for case in task.cases]
    owner = numpy.repeat(numpy.arange(len(tasks)), [len(task.cases) for task in tasks])
    narrowed_at, known = (
        [_by_case(name, cases) for name in names[size:]] for names in (conditions.narrowed_by, conditions.arguments)
    )
    sizes = numpy.array([[task.sizes[name] for name in conditions.unknowns] for task in tasks])[owner]
    parts = [task.boxes(conditions.unknowns) for task in tasks]
    at_first = [(number, box) for number in range(len(cases)) for box in parts[owner[number]]]
    bounds = numpy.array([box for _, box in at_first]).reshape(-1, size, 2)
    pending = [Boxes(bounds[:, :, 0], bounds[:, :, 1], numpy.array([number for number, _ in at_first], numpy.intp))]
    proven, undecided = [pending[0][:0]], [pending[0][:0]]
    looked_at, budgets = numpy.zeros(len(tasks), int), numpy.array([task.budget for task in tasks])
    with numpy.errstate(all="ignore"):
        while pending:
            boxes, pending = _batch(pending)
            is_over = (looked_at * size >= budgets)[owner[boxes.case]]
            undecided.append(boxes[is_over])
            boxes = boxes[~is_over]
            looked_at += numpy.bincount(owner[boxes.case], minlength=len(tasks))
            if len(boxes):
                boxes = _narrowed(conditions.narrower, boxes, narrowed_at)
            if not len(boxes):
                continue
            found = contract(conditions.equations, boxes, known, MARGINS[0])
            proven.append(found.boxes[found.is_proven])
            boxes, slopes = found.boxes[~found.is_proven], found.slopes[~found.is_proven]
            is_small = _is_narrow(boxes, sizes).all(axis=1)
            small, boxes, slopes = boxes[is_small], boxes[~is_small], slopes[~is_small]
            for margin in MARGINS[1:] if len(small) else ():
                found = contract(conditions.equations, small, known, margin)
                proven.append(found.boxes[found.is_proven])
                small = found.boxes[~found.is_proven]
            undecided.append(small)
            if len(boxes):
                pending.append(_divided(boxes, slopes, sizes))
        rest, alone = joined(undecided), joined(proven)
        guessed = rest[numpy.array([task.is_guessing for task in tasks])[owner[rest.case]]]
        likely = approach(conditions.equations, guessed[:: max(1, len(guessed) // STARTS)].middle, known, STEPS)
    is_open = numpy.bincount(rest.case, minlength=len(cases)) > 0
    by_case = zip(_by(alone, len(cases)), _by(likely, len(cases)), is_open.tolist(), strict=True)
    divisions = [Division(own, near.low.tolist(), not is_left) for own, near, is_left in by_case]
    firsts = numpy.searchsorted(owner, numpy.arange(len(tasks) + 1)).tolist()
    return [
        (divisions[first:last], count * size)
        for (first, last), count in zip(pairwise(firsts), looked_at.tolist(), strict=True)
    ]


def _by_case(name: str, cases: Sequence[Mapping[str, Number]]) -> Intervals:
    """The bounds of an input in every case."""
    bounds = [ball.bounds(case[name]) for case in cases]
    return Intervals(numpy.array([low for low, _ in bounds]), numpy.array([high for _, high in bounds]))


def _by(boxes: Boxes, cases: int) -> list[Boxes]:
    """The boxes of each case."""
    order = numpy.argsort(boxes.case, kind="stable")
    ends = numpy.searchsorted(boxes.case[order], numpy.arange(cases + 1)).tolist()
    return [boxes[order[first:last]] for first, last in pairwise(ends)]


def _batch(pending: list[Boxes]) -> tuple[Boxes, list[Boxes]]:
    """The boxes that have waited longest, and the others: no cluster of boxes uses up what others need."""
    number, count = 0, 0
    while number < len(pending) and count < BATCH:
        count += len(pending[number])
        number += 1
    boxes = joined(pending[:number])
    rest = [boxes[BATCH:]] if count > BATCH else []
    return boxes[:BATCH], rest + pending[number:]


def _narrowed(narrower: Narrower, boxes: Boxes, known: list[Intervals]) -> Boxes:
    """The boxes narrowed by each condition, for as long as that helps most of them."""
    for _ in range(PASSES):
        columns, is_possible = narrower.narrowed(boxes.inputs(known), len(boxes))
        widths = (boxes.high - boxes.low)[is_possible]
        boxes = stacked(columns[: boxes.low.shape[1]], boxes.case)[is_possible]
        if not len(boxes):
            break
        left = numpy.min((boxes.high - boxes.low) / numpy.maximum(widths, 1e-300), axis=1)
        if numpy.median(left) > WORTHWHILE:
            break
    return boxes


def _is_narrow(boxes: Boxes, sizes: Array) -> Any:
    """In which directions boxes are too small to be divided."""
    middle, size = sizes[boxes.case, :, 0], sizes[boxes.case, :, 1]
    far = numpy.maximum(numpy.abs(boxes.low - middle), numpy.abs(boxes.high - middle))
    return boxes.high - boxes.low <= NARROWEST * numpy.maximum(size, far)


def _where(slopes: Array, boxes: Boxes, sizes: Array) -> Array:
    """The unknown to divide of each box: the one whose width moves the equations most, each by its share.

    The smear of Kearfott (1987), relative and summed as by Trombettoni, Araya and others (2011), AAAI.
    """
    smear = numpy.minimum(slopes, 1e100) * (boxes.high - boxes.low)[:, None, :]
    share = smear / numpy.maximum(smear.sum(axis=2, keepdims=True), 1e-300)
    found: Array = numpy.where(_is_narrow(boxes, sizes), 0.0, share.sum(axis=1)).argmax(axis=1)
    return found


def _divided(boxes: Boxes, slopes: Array, sizes: Array) -> Boxes:
    """Two parts of each box, or more where there are few boxes: a batch of a few takes as long as one of many."""
    parts = boxes
    while True:
        where = _where(slopes, parts, sizes)
        every = numpy.arange(len(parts))
        begin, end = parts.low[every, where], parts.high[every, where]
        # What is far away is divided by its magnitude, what is not in the middle.
        middle, size = sizes[parts.case, where].T
        first, last = numpy.arcsinh((begin - middle) / size), numpy.arcsinh((end - middle) / size)
        at = middle + size * numpy.sinh(first + DIVISION * (last - first))
        low, high = parts.low.copy(), parts.high.copy()
        low[every, where] = high[every, where] = numpy.clip(at, begin, end)
        parts = joined([Boxes(parts.low, high, parts.case), Boxes(low, parts.high, parts.case)])
        if len(parts) >= FEW:
            return parts
        slopes = numpy.concatenate([slopes, slopes])


NARROW = 2.0**-60
"""1 (share of the coordinates). A box that is wider is tried to be enclosed otherwise."""


def settle(kernel: Kernel, divisions: Sequence[Division], inputs: Mapping[str, Number]) -> list[Root]:
    """All solutions that are proven, in any part of what was searched."""
    found: list[list[Number]] = []
    for division in divisions:
        for low, high in zip(division.proven.low.tolist(), division.proven.high.tolist(), strict=True):
            keep(_pinned(kernel, [ball.between(*ends) for ends in zip(low, high, strict=True)], inputs), found)
        for point in division.likely[:TRIED]:
            box = search(kernel, point, inputs)
            if box is not None:
                keep(box, found)
    return [Root(dict(enumerate(box))) for box in found]


def search(kernel: Kernel, guess: Sequence[float], inputs: Mapping[str, Number]) -> list[Number] | None:
    """A box about the solution that a guess leads to, if it can be proven to be one."""
    names = kernel.arguments[len(kernel.unknowns) :]
    finder = _finder(kernel)
    found = finder(guess, [ball.middle(inputs[name]) for name in names]) if finder else None
    return prove(kernel, found, inputs) if found else None


def _pinned(kernel: Kernel, box: list[Number], inputs: Mapping[str, Number]) -> list[Number]:
    """The solution in a box that is proven to hold exactly one, as narrowly as it can be enclosed."""
    narrow = refine(kernel, box, inputs)
    if all(ball.width(each) <= NARROW * max(1.0, abs(ball.middle(each))) for each in narrow):
        return narrow
    near = search(kernel, [ball.middle(each) for each in narrow], inputs)
    if near is not None and all(ball.contains(outer, inner) for outer, inner in zip(narrow, near, strict=True)):
        return near
    return narrow


@lru_cache(maxsize=256)
def _finder(kernel: Kernel) -> Finder | None:
    return finder_of(kernel.function, len(kernel.unknowns))
