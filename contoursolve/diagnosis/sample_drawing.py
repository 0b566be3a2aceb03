"""A drawing that has all that a contour states, whatever else it has: what further words would determine there.

At most values a word may determine what it does not at those that the others leave: the direction of a line through two
known points is one that it has already.
"""

from collections.abc import Collection, Mapping, Sequence
from itertools import product

import numpy
from msgspec import Struct

from contoursolve.geometry import Profile, assemble, both
from contoursolve.numeric import Array, svd
from contoursolve.reading import ParsedContour, read, stating
from contoursolve.solving import RANK, Equations, basis_of, null_space

MOST_UNKNOWNS = 60
"""Unknowns of a contour of which a drawing is looked for: about ten elements, a tenth of a second."""

TRIES = 3
"""Random places from which a drawing is looked for."""


class SampleDrawing(Struct, frozen=True, eq=False):
    """The rows of derivatives of what is stated at one drawing, and those of further words by their names. `own` are
    the columns of the contour's unknowns: further words may need lines of their own."""

    stated: Array
    further: Mapping[str, Array]
    own: tuple[int, ...]
    joints: Mapping[str, tuple[int, ...]]
    """The columns of points between two parts of one straight line, or of one circle."""

    def _rows(self, names: Collection[str]) -> Array:
        """The rows of what is stated and of these words, each of length 1."""
        rows = numpy.concatenate([self.stated, *(self.further[name] for name in names if name in self.further)])
        sizes = numpy.linalg.norm(rows, axis=1)
        found: Array = rows[sizes > 0] / sizes[sizes > 0, None]
        return found

    def cuts(self, names: Collection[str] = ()) -> list[str]:
        """The points that slide along a line or a circle, which they cut in two, while nothing else moves."""
        rows = self._rows(names)
        return [
            point
            for point, columns in self.joints.items()
            if rows.size and int((svd(rows[:, list(columns)])[1] > RANK).sum()) < len(columns)
        ]

    def missing(self, names: Collection[str] = ()) -> int:
        """The number of words that a path still lacks beside these: where a cut lies makes no difference to it."""
        return self.open_after(names) - len(self.cuts(names))

    def open_after(self, names: Collection[str] = ()) -> int:
        """In how many ways the contour still moves beside these words."""
        moves = null_space(self._rows(names))[:, list(self.own)]
        return int((svd(moves)[1] > RANK).sum()) if moves.size else 0

    def helping(self, names: Sequence[str]) -> list[str]:
        """Those of some words that determine anything that is open."""
        open_ = self.missing()
        return [name for name in names if name not in self.further or self.missing((name,)) < open_]


def sample_drawing(claim: ParsedContour, profile: Profile, names: Sequence[str]) -> SampleDrawing | None:
    """A drawing of a contour in which some further words have the values that they have there; None where none is
    found, or the contour is too large."""
    whole = read(stating(claim, names), frozenset(fact.given for fact in profile.ignored))
    system = assemble(whole)
    if not profile.start.is_known or len(system.unknowns) > MOST_UNKNOWNS:
        return None
    profiled, own = {*profile.facts}, assemble(profile).unknowns
    if not {*own} <= {*system.unknowns}:
        return None  # with those words some corner is none
    stated = [fact for fact in system.facts if fact in profiled or not fact.given]
    equations = Equations(whole, system)
    consistent = {*basis_of(assemble(profile))}
    # Where what is stated contradicts itself, a drawing has as much of it as can be true.
    sets = [stated, [fact for fact in stated if fact in consistent]]
    for true, number in product(sets if len(sets[1]) < len(stated) else sets[:1], range(TRIES)):
        try:
            place = equations.solve(true, equations.random_place(number))
            if place is None or not equations.has_lengths(place):
                continue
            told = {name: [fact for fact in system.facts if fact.given == name] for name in names}
            rows = {name: equations.rows_at(facts, place) for name, facts in told.items() if facts}
            further = {name: each for name, each in rows.items() if each is not None}
            columns = tuple(equations.number[name] for name in own)
            joints = {
                point: tuple(equations.number[name] for name in both(point) if name in equations.number)
                for point in equations.joints_at(place)
            }
            slopes = equations.slopes(true, place)
            return SampleDrawing(slopes, further, columns, {point: each for point, each in joints.items() if each})
        except (ArithmeticError, ValueError, numpy.linalg.LinAlgError):
            continue  # at a random place something may be nothing that others are divided by
    return None


def helping_words(claim: ParsedContour, profile: Profile, absent: Sequence[str]) -> list[str]:
    """Those of some absent words that determine anything that is open; all where no drawing tells."""
    drawing = sample_drawing(claim, profile, absent)
    return [*absent] if drawing is None else drawing.helping(absent)
