"""Region of two words in which a contour exists: values all over a box are solved, closer where the outcome changes."""

from collections.abc import Sequence
from decimal import Decimal
from math import floor, log10
from typing import Any, TypeVar, Unpack

import numpy
from msgspec import Struct
from msgspec.structs import asdict, replace

from contoursolve.diagnosis import inward, short_name
from contoursolve.diagnostics import Shown, check_type, from_above
from contoursolve.families.block_template import BlockOptions, RefusedError, SweepSpec, Template, spec_of
from contoursolve.families.branches import branches_of
from contoursolve.families.case_classes import CaseClass, FreeWords, premises_of
from contoursolve.families.compiled_sweep import CompiledSweep
from contoursolve.families.errors import ByRowError, FamilyError
from contoursolve.families.evaluate import compile_sweep, solve_sweep
from contoursolve.families.export import Family
from contoursolve.families.free_words import are_compared, check_block
from contoursolve.families.sampled_lines import (
    Boundary,
    Outcomes,
    boundaries_of,
    crossings_of,
    is_contour,
    outcomes_of,
)
from contoursolve.families.word_values import Ranges, are_same
from contoursolve.geometry import Unit
from contoursolve.numeric import Array
from contoursolve.program import takes
from contoursolve.reading import Premises
from contoursolve.solving import REASONS, Point, Status

T = TypeVar("T")


class Lattice(Struct, frozen=True):
    """Values of both words, the closest that are solved; every `coarse` one of each is solved first."""

    columns: int
    rows: int
    coarse: int


PICTURE, BY_ROW = Lattice(305, 201, 4), Lattice(65, 41, 2)
"""As many as a picture has cells; and fewer where each row is read by itself, some seconds."""

UNKNOWN = -1


class FeasibleRegion(Shown, Struct, frozen=True, eq=False):
    """Values of two words, within a box, with which a block has a contour: the lines that bound them.

    Nothing here is a proof: the values were sampled. All values are as the words are written; a pair of them is a value
    of each word.

    Attributes:
        words: the two words by their names.
        units: what they are written in: mm, inch or deg.
        diameters: whether the values of each are diameters.
        stated: the values that the block has.
        within: the box: the range of each word, lower value first.
        boundaries: the lines between values with and without a contour.
        cell: how close, by word, each line is to where the contour begins to exist.
        seen: what is narrower than this, by word, may be missing.
        exists: whether the contour exists at any value that was looked at.
        outcomes: what came of values evenly spaced over the box: an array with one axis for each word.
        spec: the block, and how it is read.
        premises: what its contours assume besides the words.
    """

    words: tuple[str, str]
    units: tuple[str, str]
    diameters: tuple[bool, bool]
    stated: Point
    within: tuple[Point, Point]
    boundaries: tuple[Boundary, ...]
    cell: Point
    seen: Point
    exists: bool
    outcomes: Outcomes
    spec: SweepSpec
    premises: Premises = Premises()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, FeasibleRegion) and are_same(asdict(self), asdict(other))

    def __hash__(self) -> int:
        return hash((self.words, self.within, self.stated))

    @property
    def fineness(self) -> str:
        """Statement in words of how finely the values were sampled."""
        cell, seen = (
            " and ".join(f"{_rounded_up(each)} {short_name(unit)}" for each, unit in zip(size, self.units, strict=True))
            for size in (self.cell, self.seen)
        )
        return f"sampled, edges within {cell}; what is narrower than {seen} may be missing"

    def plot(self, ax: Any = None, *, result: str | None = None) -> Any:
        """Draw the region on `ax`, axes of matplotlib, or on the current ones, and return them: where the contour
        exists, the lines that bound it, each labelled with what fails beyond it, and the values of the block. `result`
        colours it, as for `draw_region`. Raises FamilyError for a result that is none, MissingExtraError without the
        package of `contoursolve[plot]`."""
        return from_above("plot_record", self, ax, result=result)

    def family(self, columns: int | None = None, rows: int | None = None) -> Family:
        """The contours at evenly spaced values of both words, as many as `outcomes` has unless it is told: for
        results, such as `region.family()["V2 Z"]`. Raises FamilyError for less than two values of a word."""
        own = self.outcomes.shape
        counts = own[0] if columns is None else columns, own[1] if rows is None else rows
        if min(counts) < 2:  # noqa: PLR2004 - both ends
            raise FamilyError(f"{counts[0]} by {counts[1]} values are no grid; take 2 or more of each word")
        axes = (numpy.linspace(*ends, count) for ends, count in zip(self.within, counts, strict=True))
        return solve_sweep(compile_sweep(self.spec, Ranges(dict(zip(self.words, axes, strict=True)), is_paired=False)))


@takes(BlockOptions)
def region(
    block: str,
    words: tuple[str, str],
    within: tuple[Point, Point],
    **options: Unpack[BlockOptions],
) -> FeasibleRegion:
    """The region of two words' values, as they are written, in which the contour is solved; see
    `contoursolve.ranges`."""
    check_type("words", words, Sequence, "two words, such as ('A', 'P')")
    check_type("within", within, Sequence, "two ranges, such as ((150, 210), (1, 60))")
    if isinstance(words, str) or len(words) != 2 or len(within) != 2:  # noqa: PLR2004 - axes of a map
        raise FamilyError("name two words, and a range for each of them")
    spec = spec_of(block, words, **options)
    template = spec.template()
    check_block(template)
    return _RegionSearch(template, spec, within).run()


class _RegionSearch(FreeWords):
    """Two words of one block."""

    def __init__(self, template: Template, spec: SweepSpec, within: Sequence[tuple[float, float]]) -> None:
        super().__init__(template)
        if len(self.names) == 1:
            raise FamilyError(f"{self.names[0]} is named twice")
        for word, kind in zip(self.names, self.kinds, strict=True):
            if kind is Unit.SIGN:
                raise FamilyError(f"{template.words[word].text} has no range; name words that state lengths or angles")
        self.spec = replace(spec, names=self.names)
        self.within = [self.limits_within(axis, each) for axis, each in enumerate(within)]
        self.lattice = BY_ROW if self._is_by_row() else PICTURE
        counts = self.lattice.columns, self.lattice.rows
        self.axes = [numpy.linspace(*ends, count) for ends, count in zip(self.within, counts, strict=True)]
        self.cases: list[CaseClass] = []
        self._sweep: CompiledSweep | None = None

    def _is_by_row(self) -> bool:
        """Whether each row tells how it is read, at the stated values or in the middle."""
        if are_compared(self.template, self.answer.claim):
            return True
        try:
            for place in (self.values, tuple((low + high) / 2 for low, high in self.within)):
                self.case_at(*place)
        except ByRowError:
            return True
        return False

    def run(self) -> FeasibleRegion:
        """The region."""
        outcomes = self._sample()
        crossings = crossings_of(self.axes, outcomes, self._outcomes)
        cell, seen = ([float(each[step] - each[0]) for each in self.axes] for step in (1, self.lattice.coarse))
        return FeasibleRegion(
            words=_two(self.names),
            units=_two(self.units),
            diameters=_two(self.diameters),
            stated=_two(self.values),
            within=_two(self.within),
            boundaries=tuple(boundaries_of(self.template, outcomes, crossings)),
            cell=_two(cell),
            seen=_two(seen),
            exists=bool(is_contour(outcomes).any()),
            outcomes=outcomes,
            spec=self.spec,
            premises=premises_of(self.cases, self.template),
        )

    def _outcomes(self, points: Array) -> Outcomes:
        """The outcomes at values of both words, by (point, word)."""
        ranges = Ranges(dict(zip(self.names, points.T.copy(), strict=True)), is_paired=True)
        try:
            ready = compile_sweep(self.spec, ranges, self._sweep)
        except RefusedError:  # each of these values, for the same reason
            return numpy.full(len(points), Status.REJECTED.code * len(REASONS), numpy.int64)
        # Where there is no closed form, a search for every row takes minutes; it says so.
        for case in ready.cases if not ready.by_row else ():
            if case.status is None and not case.is_closed:
                branches_of(case.along(self.names[0]), *self.within[0])
        self._sweep = ready
        self.cases += ready.cases
        found = solve_sweep(ready)
        return outcomes_of(found["status"], found["reason"])

    def _sample(self) -> Outcomes:
        """The outcomes of all values: of those that are solved, and between them what these are alike in."""
        found = numpy.full([each.size for each in self.axes], UNKNOWN, numpy.int64)
        wanted, coarse = numpy.zeros(found.shape, bool), self.lattice.coarse
        wanted[::coarse, ::coarse] = True
        while (places := numpy.argwhere(wanted & (found == UNKNOWN))).size:
            points = numpy.stack([self.axes[word][places[:, word]] for word in (0, 1)], axis=1)
            found[tuple(places.T)] = self._outcomes(points)
            size = coarse + 1
            parts = numpy.lib.stride_tricks.sliding_window_view(found, (size, size))[::coarse, ::coarse]
            known = numpy.where(parts == UNKNOWN, parts[:, :, :1, :1], parts)
            for i, j in numpy.argwhere(known.min(axis=(2, 3)) != known.max(axis=(2, 3))).tolist():
                wanted[i * coarse : i * coarse + size, j * coarse : j * coarse + size] = True
        corners = found[::coarse, ::coarse].repeat(coarse, axis=0).repeat(coarse, axis=1)
        return numpy.where(found == UNKNOWN, corners[: found.shape[0], : found.shape[1]], found)


def _rounded_up(value: float) -> str:
    """A size with two digits, no less than it is."""
    digits = 1 - floor(log10(value))
    return f"{inward(Decimal(repr(round(value, digits + 6))), digits, -1):.{max(digits, 0)}f}"


def _two(values: Sequence[T]) -> tuple[T, T]:
    """The pair of what concerns the two words."""
    first, second = values
    return first, second
