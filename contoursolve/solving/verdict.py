"""The verdict on each of many rows, by the checks of `solving.solve` and `solving.path` in their order."""

from collections.abc import Iterable, Mapping, Sequence
from enum import IntEnum

import numpy
from numpy.typing import NDArray

from contoursolve.backends.columns import Array
from contoursolve.constraints import Coordinate, Heading, Offset, OnCircle, Radius
from contoursolve.model import FIRST, SECOND, Arc, Corner, CornerShape, Fact, Figure, scalar
from contoursolve.solving.plan import AffineStep, DistanceStep, LineCircleStep, Step, TwoCirclesStep
from contoursolve.solving.solution import RefusalKind, Status
from contoursolve.tolerance import AGREEMENT, LENGTH, RADIUS_DIFFERENCE, REGULAR, RESIDUAL, TOUCHING

Mask = NDArray[numpy.bool_]
Codes = NDArray[numpy.uint8]
Out = Mapping[str, Array]


class Code(IntEnum):
    """A status in a column of numbers."""

    SOLVED = 0
    OVERDETERMINED = 1
    REJECTED = 2
    CONFLICTING = 3
    UNDERDETERMINED = 4
    AMBIGUOUS = 5
    NO_SOLUTION = 6
    UNDECIDED = 7

    @property
    def status(self) -> Status:
        """The status that it stands for."""
        return Status[self.name]


REASONS: tuple[RefusalKind | None, ...] = (None, *RefusalKind)
"""What a number in the column `reason` stands for."""

_REASON = {kind: number for number, kind in enumerate(REASONS)}


def code_of(status: Status) -> Code:
    """The number of a status."""
    return Code[status.name]


def reason_of(kind: RefusalKind | None) -> int:
    """The number of a reason."""
    return _REASON[kind]


class Verdict:
    """What the checks found, row by row: `status` and `reason` as numbers; and the rows `again` that need the exact
    arithmetic of a single solve: a step that is singular, a line that touches its circle.

    The outputs hold the residuals of the facts that were solved, by number, and after them those of `checks`, the facts
    that were not needed.
    """

    def __init__(
        self,
        figure: Figure,
        solved: int,
        checks: Sequence[Fact],
        steps: Sequence[Step],
        corner_residuals: Sequence[str],
        cosines: Out,
        out: Out,
        rows: int,
    ) -> None:
        self.figure, self.out, self.cosines = figure, out, cosines
        self.reason: Codes = numpy.zeros(rows, numpy.uint8)
        self.again: Mask = numpy.zeros(rows, bool)
        self.agreeing: dict[str, Mask] = {}
        """Where a fact that was not needed agrees, by the value that it states."""
        self.differing: dict[str, Mask] = {}
        self._agrees: Mask = numpy.zeros(rows, bool)
        self._conflicts: Mask = numpy.zeros(rows, bool)
        with numpy.errstate(invalid="ignore"):
            basis = _worst(numpy.zeros(rows), (out[f"residual:{number}"] for number in range(solved)))
            self.worst = _worst(basis.copy(), (out[name] for name in corner_residuals))
            """The largest residual of the equations that were solved, mm; NaN if any is."""
            for number, step in enumerate(steps):
                self._check_step(number, step)
            self._check_equations(basis, solved, checks)
            self._check_elements()
            if figure.corners:
                self._check_corners()
                self._check_room()
                # Checked last, because a corner that does not fit may be huge.
                self._refuse(~(self.worst <= RESIDUAL), RefusalKind.NOT_VERIFIED)

    @property
    def status(self) -> Codes:
        """The statuses; of several, the first in the order of `Status`."""
        status: Codes = (self.reason != 0).view(numpy.uint8) * numpy.uint8(Code.NO_SOLUTION)
        if self.agreeing:
            status[self._agrees] = Code.OVERDETERMINED
            status[self._conflicts] = Code.CONFLICTING
        return status

    def _refuse(self, mask: Mask, kind: RefusalKind) -> None:
        """Rows that nothing spoke against until here."""
        if mask.any():
            numpy.putmask(self.reason, mask & (self.reason == 0), _REASON[kind])

    def _look_again(self, mask: Mask) -> None:
        if mask.any():
            self.again |= mask & (self.reason == 0)

    def _check_step(self, number: int, step: Step) -> None:
        out = self.out
        if isinstance(step, AffineStep):
            self._look_again(~(numpy.abs(out[f"determinant:{number}"]) > REGULAR))
            return
        if isinstance(step, DistanceStep):
            self._refuse(~(out[step.circle.radius] > LENGTH), RefusalKind.CIRCLE_UNDEFINED)
            return
        offset, radius = numpy.abs(out[f"offset:{number}"]), out[f"radius:{number}"]
        kind = RefusalKind.CIRCLE_MISSED
        if isinstance(step, TwoCirclesStep):
            kind = RefusalKind.RADIUS_TOO_SMALL if step.is_equal else RefusalKind.CIRCLES_APART
            undefined = RefusalKind.CIRCLE_UNDEFINED if step.is_equal else kind
            self._refuse(~(out[f"distance:{number}"] > LENGTH), undefined)
        gap, limit = radius - offset, TOUCHING * out[f"scale:{number}"]
        fits = gap >= -limit
        if isinstance(step, LineCircleStep) or not step.is_equal:
            self._look_again(fits & (gap <= limit))
        self._refuse(~fits, kind)

    def _check_equations(self, basis: Array, solved: int, checks: Sequence[Fact]) -> None:
        wrong = ~(basis <= RESIDUAL) & (self.reason == 0)
        self._refuse(wrong, RefusalKind.NOT_VERIFIED)
        for number, fact in enumerate(checks, solved):
            off = numpy.abs(self.out[f"residual:{number}"])
            self._compare(fact, off, numpy.isfinite(off) & ~wrong)

    def _compare(self, fact: Fact, off: Array, is_known: Mask) -> None:
        """A fact that was not needed, at the points that the others give."""
        out, kind = self.out, RefusalKind.WORDS_DISAGREE
        if isinstance(fact, OnCircle) and not fact.given:
            first, second = self._step(fact.center, fact.point)
            off = numpy.abs(numpy.hypot(first, second) - out[fact.radius])
            agrees, differs = numpy.zeros(1, bool), ~(off <= RADIUS_DIFFERENCE)
            kind = RefusalKind.RADIUS_DIFFERENCE
        elif isinstance(fact, Heading):
            first, second = self._step(fact.tail, fact.head)
            cosine, sine = (self.cosines[f"{fact.given}:{part}"] for part in ("cos", "sin"))
            turned = numpy.arctan2(cosine * second - sine * first, cosine * first + sine * second)
            agrees = (off <= AGREEMENT) | (numpy.abs(numpy.degrees(turned)) <= AGREEMENT)
            differs = ~agrees
        elif fact.given:
            agrees = off <= AGREEMENT
            differs = ~agrees
            if not isinstance(fact, Coordinate | Offset | Radius):
                self._look_again(differs & is_known)
        else:
            agrees, differs, kind = numpy.zeros(1, bool), ~(off <= AGREEMENT), RefusalKind.FACT_DISAGREES
        self.agreeing[fact.given], self.differing[fact.given] = agrees & is_known, differs & is_known
        self._agrees |= self.agreeing[fact.given]
        self._conflicts |= self.differing[fact.given]
        self._refuse(differs & is_known, kind)

    def _step(self, tail: str, head: str) -> tuple[Array, Array]:
        """From one point to another, mm."""
        if tail == self.figure.start:
            return self._point(head)
        (a, b), (c, d) = self._point(tail), self._point(head)
        return c - a, d - b

    def _point(self, name: str) -> tuple[Array, Array]:
        """A point, counted from the start."""
        if name == self.figure.start:
            return numpy.zeros(1), numpy.zeros(1)
        return self.out[scalar(name, FIRST)], self.out[scalar(name, SECOND)]

    def _check_elements(self) -> None:
        for element in self.figure.path:
            if isinstance(element, Arc):
                first, second = self._step(element.tail, element.head)
                is_short = (numpy.abs(first) <= LENGTH) & (numpy.abs(second) <= LENGTH)
                if is_short.any():
                    self._refuse(is_short & (numpy.hypot(first, second) <= LENGTH), RefusalKind.ARC_EMPTY)
            else:
                kind = RefusalKind.LINE_BACKWARDS if element.heading is None else RefusalKind.LINE_REVERSED
                self._refuse(~(self.out[f"length:{element.name}"] >= -LENGTH), kind)

    def _check_corners(self) -> None:
        out = self.out
        for corner in self.figure.corners:
            name = corner.name
            for element in self._elements(corner):
                self._refuse(out[f"length:{element}"] <= LENGTH, RefusalKind.CORNER_TOO_LARGE)
            if f"landing:{name}" in out:
                self._refuse(out[f"landing:{name}"] == 0, RefusalKind.LANDING_UNKNOWN)
            straight = numpy.abs(out[f"turn:{name}"]) <= REGULAR
            if straight.any():
                self._refuse(straight & (out[f"cosine:{name}"] > 0), RefusalKind.CORNER_STRAIGHT)
                self._refuse(straight, RefusalKind.CORNER_REVERSES)
            if corner.shape is CornerShape.CHAMFER_AXIS_45:
                self._refuse(self._outside(corner) > LENGTH, RefusalKind.BEVEL_OUTSIDE)
                for way in ("in", "out"):
                    self._refuse(out[f"setback-{way}:{name}"] < -LENGTH, RefusalKind.BEVEL_IN_BAND)

    def _outside(self, corner: Corner) -> Array:
        """How far a corner lies outside the rectangle spanned by the ends of its two lines, mm."""
        path = {element.name: element for element in self.figure.path}
        before, after = path[corner.before], path.get(corner.after or "")
        if after is None or isinstance(before, Arc) or isinstance(after, Arc):
            return numpy.zeros(1)
        tail, head, at = self._point(before.tail), self._point(after.head), self._point(corner.at)
        excess = numpy.full(1, -numpy.inf)
        for axis in (FIRST, SECOND):
            low, high = numpy.minimum(tail[axis], head[axis]), numpy.maximum(tail[axis], head[axis])
            excess = numpy.maximum(excess, numpy.maximum(low - at[axis], at[axis] - high))
        return excess

    def _check_room(self) -> None:
        for corner in self.figure.corners:
            for element, way in zip(self._elements(corner), ("in", "out"), strict=False):
                setback = self.out[f"setback-{way}:{corner.name}"]
                fits = (setback >= -LENGTH) & (setback <= self.out[f"length:{element}"] + LENGTH)
                self._refuse(~fits, RefusalKind.CORNER_TOO_LARGE)
        for each in self.figure.path:
            self._refuse(self.out[f"room:{each.name}"] < -LENGTH, RefusalKind.CORNERS_OVERLAP)

    def _elements(self, corner: Corner) -> list[str]:
        """The elements that a corner joins, as far as they have two ends."""
        after = corner.after or corner.lands_on
        return [corner.before, *([after] if after and f"length:{after}" in self.out else [])]


def _worst(worst: Array, residuals: Iterable[Array]) -> Array:
    """The largest absolute value, row by row, in place of the first argument."""
    single, size = numpy.zeros(1), numpy.empty_like(worst)
    for residual in residuals:
        if residual.size == 1 < worst.size:
            numpy.maximum(single, numpy.abs(residual), out=single)
        else:
            numpy.maximum(worst, numpy.abs(residual, out=size), out=worst)
    # What is the same for all rows is compared once.
    return numpy.maximum(worst, single, out=worst) if single[0] != 0 else worst
