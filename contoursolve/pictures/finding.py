"""What is known of a contour, solved or not: its points and corners, and what speaks against it.

A contour that is solved has all its points. One that is refused is worked out as far as its equations go, for a
corner that does not fit has a place as well. What words leave free is put somewhere, and is said to be so.
"""

from dataclasses import replace
from math import inf, isfinite

from contoursolve.analysis import judge
from contoursolve.constraints import assemble
from contoursolve.examine import MOST_CHOICES, Answer, count_choices
from contoursolve.model import FIRST, SECOND, Layout, Profile, scalar
from contoursolve.pictures.completing import complete, is_chosen
from contoursolve.pictures.known import Known, in_part, is_usable, known_of
from contoursolve.settling import said_twice
from contoursolve.solving import Point, Refusal, RefusalKind, Solution, is_closed, points_with_two_solutions, solve
from contoursolve.solving.compile import compile_system
from contoursolve.solving.numbers import corner_of, inputs_of


def find_known(answer: Answer) -> Known:
    """All that can be drawn of a contour; nothing if its start is not known."""
    profile = answer.profile
    if not answer.start.is_known:
        return Known()
    if answer.contour is not None:
        solution = _solution_of(answer)
        if solution is not None and solution.points:
            return known_of(solution)
    system = assemble(profile)
    verdict = judge(system)
    if profile.is_extended:
        found = _of_alternatives(answer)
        if found is None and not verdict.is_determined and not answer.claim.directives:
            return complete(profile)  # words that are asked for, and nothing gives them
        return found or in_part(profile)
    if verdict.is_determined and is_closed(system):
        return _worked_out(profile)
    if verdict.is_determined:
        return in_part(profile)
    return _completed(profile)


def _completed(profile: Profile) -> Known:
    """A contour of which words leave something free, without those of them that contradict the others."""
    refusals = tuple(each for each in said_twice(profile) if isinstance(each, Refusal))
    against = {each.subject for each in refusals if each.kind is RefusalKind.WORDS_DISAGREE}
    facts = tuple(fact for fact in profile.facts if fact.given not in against)
    part = replace(profile, layout=Layout(profile.figure, facts)) if against else profile
    return replace(complete(part), refusals=refusals)


def _solution_of(answer: Answer) -> Solution | None:
    """The solution behind the path of a contour."""
    if answer.alternatives is not None:
        from contoursolve.solving.alternatives import choose  # noqa: PLC0415 - most contours need no choice

        eligible = choose(answer.alternatives, answer.profile.choices)
        return next((item.solution for item in eligible if item.is_path), None)
    system = assemble(answer.profile)
    return solve(answer.profile, is_proven=False) if is_closed(system) else None


def _of_alternatives(answer: Answer) -> Known | None:
    """The first solution that there is, for a contour that nothing chooses."""
    items = answer.alternatives.items if answer.alternatives else ()
    found = next((item.solution for item in items if item.is_path), None)
    return known_of(found) if found is not None else None


def _worked_out(profile: Profile) -> Known:
    """The points of a determined contour that is refused, as far as they exist, with its corners as large as stated."""
    system = assemble(profile)
    out = dict(compile_system(system).function(_inputs(profile)))
    origin = tuple(float(value or 0) for value in profile.start.values)

    def absolute(at: Point) -> Point:
        return origin[FIRST] + at[FIRST], origin[SECOND] + at[SECOND]

    points = {system.figure.start: absolute((0.0, 0.0))}
    rest: dict[str, float] = {}
    for name in system.figure.points:
        at = out.get(scalar(name, FIRST), inf), out.get(scalar(name, SECOND), inf)
        if all(is_usable(value) for value in at):
            points[name] = absolute(at)
        else:
            rest |= {scalar(name, axis): absolute(at)[axis] for axis in (FIRST, SECOND) if is_usable(at[axis])}
    radii = {name: out[name] for name in system.figure.radii if is_usable(out.get(name, inf)) and out[name] > 0}
    corners = {}
    for corner in system.figure.corners:
        if corner.size in profile.givens and profile.givens[corner.size].value > 0:
            built = corner_of(corner, float(profile.givens[corner.size].value), out, absolute)
            places = (built.begin, built.end, *([built.center] if built.center else []))
            if all(is_usable(value) for place in places for value in place) and isfinite(built.turn):
                corners[corner.name] = built
    is_solvable = count_choices(profile) <= MOST_CHOICES and is_chosen(profile)
    refusals = solve(profile, is_proven=False).refusals if is_solvable else ()
    singular = next((refusal.subject for refusal in refusals if refusal.kind is RefusalKind.NOT_FIXED), "")
    if singular:
        found = complete(profile, singular.split(","))
        if found.placed:
            return found
    if len(points) < len(system.figure.points) + 1:
        part = in_part(profile)
        points = {**part.points, **points}
        radii, rest = {**part.radii, **radii}, {**part.scalars, **rest}
    return Known(points, radii, corners, refusals, scalars=rest)


def _inputs(profile: Profile) -> dict[str, float]:
    """All inputs of the function, one of two places where nothing chooses."""
    system = assemble(profile)
    sides = {f"side:{point}": 1.0 for point in points_with_two_solutions(system)}
    return {**sides, **inputs_of(profile, system)}
