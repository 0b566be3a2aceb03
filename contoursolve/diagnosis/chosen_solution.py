"""The solution of a contour that its control takes: the values of all unknowns, and the sides that were chosen."""

from collections.abc import Mapping

from msgspec import Struct

from contoursolve.geometry import Profile, assemble
from contoursolve.solving import (
    Alternatives,
    SystemSolution,
    choose,
    find_alternatives,
    is_closed,
    pick,
    points_with_two_solutions,
    scalars_of,
    solve,
)


class Chosen(Struct, frozen=True):
    """The solution, the values of all unknowns (mm), and the sides on which it differs from others, by the point."""

    solution: SystemSolution
    scalars: Mapping[str, float]
    sides: Mapping[str, str]


def chosen_solution(profile: Profile, alternatives: Alternatives | None = None) -> Chosen | None:
    """The solution that is meant, of a profile that is determined; None where there is none, or nothing chooses one.
    `alternatives` are all solutions, if they are known."""
    if alternatives is None and _is_chosen_by_words(profile):
        found = solve(profile)
        scalars = {**scalars_of(found.points), **found.radii, **found.scalars}
        sides = {choice.point: choice.side.value for choice in profile.choices}
        return Chosen(found, scalars, sides) if found.points else None
    every = alternatives if alternatives is not None else find_alternatives(profile)
    paths = [item for item in choose(every, profile.choices) if item.is_path]
    meant = pick(paths, profile)[0] if profile.picks else paths
    if len(meant) != 1:
        return None
    (only,) = meant
    differing = {key for key in only.sides if len({each.sides.get(key) for each in every.items}) > 1}
    return Chosen(only.solution, only.scalars, {key: side for key, side in only.sides.items() if key in differing})


def _is_chosen_by_words(profile: Profile) -> bool:
    """Whether it is solved one step after the other, with a choice wherever there are two places."""
    system = assemble(profile)
    chosen = {choice.point for choice in profile.choices}
    return is_closed(system) and chosen.issuperset(points_with_two_solutions(system))
