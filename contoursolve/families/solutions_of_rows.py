"""Several solutions of each row of a family: their names, by which `list_solutions` tells them apart."""

from collections.abc import Sequence
from itertools import count

import numpy
from msgspec.structs import replace

from contoursolve.diagnosis import list_solutions
from contoursolve.families.case_classes import CaseClass, has_one_function
from contoursolve.families.compiled_sweep import CompiledSweep
from contoursolve.families.export import Family
from contoursolve.families.results import coordinate_name, factors_of
from contoursolve.geometry import Profile
from contoursolve.solving import Contour, find_alternatives

LOOKED_AT = 16
"""Rows by whose solutions each one is named: those with most of them, from the first to the last."""

SAME = 1e-6
"""mm. Points of one solution in a family and in a single solve."""


def without_defaults(case: CaseClass) -> CaseClass:
    """The class without what is chosen where no word chooses."""
    profile = _undecided(case.profile)
    return replace(case, profile=profile, is_closed=case.is_closed and has_one_function(profile))


def _undecided(profile: Profile) -> Profile:
    """The drawing without the choices of words that nobody wrote; those of the form itself stay."""
    choices = tuple(each for each in profile.choices if not each.given or each.given in profile.givens)
    return replace(profile, choices=choices, picks=tuple(each for each in profile.picks if each.given))


def names_of_solutions(ready: CompiledSweep, found: Sequence[Family]) -> list[tuple[int, str]]:
    """The place of each solution in the order of a single solve, and its name. Where it has several in different rows,
    all of them."""
    has = numpy.stack([each.has_contour.reshape(-1) for each in found])
    most = numpy.flatnonzero(has.sum(axis=0) == has.sum(axis=0).max())
    rows = most[numpy.unique(numpy.linspace(0, most.size - 1, LOOKED_AT).astype(int))].tolist()
    # What none of these rows has is named by the first that has it.
    rows += [int(own.argmax()) for own in has if own.any() and not own[rows].any()]
    names: list[dict[str, int]] = [{} for _ in found]
    for row in rows:
        values = {word: float(column[0]) for word, column in ready.ranges.rows(row, row + 1).values.items()}
        answer = ready.template.solve(values)
        profile = _undecided(answer.profile)
        listing = list_solutions(replace(answer, profile=profile, alternatives=find_alternatives(profile)))
        for place, listed in enumerate(listing.solutions if listing is not None else ()):
            for family, own in zip(found, names, strict=True):
                if listed.contour is not None and _is_in(family, row, listed.contour):
                    own.setdefault(listed.name, place)
    numbers = count(1)
    return [
        (min(own.values()), " or ".join(filter(None, own)) or "the only one")
        if own
        else (len(found), f"solution {next(numbers)}")
        for own in names
    ]


def _is_in(family: Family, row: int, contour: Contour) -> bool:
    """Whether a row has the points of a contour."""
    letters, factors = contour.plane.axes, factors_of(contour.plane)
    return all(
        abs(family.columns[column][row] - at * factor) <= SAME
        for name, place in contour.points.items()
        for letter, at, factor in zip(letters, place, factors, strict=True)
        if (column := coordinate_name(name, letter)) in family.columns
    )
