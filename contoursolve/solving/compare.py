"""Do facts that say the same agree? What each of them would have to state, and by how much it is off."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from math import asin, degrees, hypot, inf
from typing import Any

from msgspec.structs import replace

from contoursolve.geometry import (
    FIRST,
    INCREMENT_OF,
    SECOND,
    Fact,
    Figure,
    Increments,
    Line,
    Profile,
    System,
    Unit,
    Values,
    assemble,
    step,
)
from contoursolve.solving.affine import AffineFacts, Circuit, IndependentFacts
from contoursolve.solving.determinacy import analyse, circuits_of
from contoursolve.solving.events import NoteKind, RefusalKind
from contoursolve.solving.numbers import lookup
from contoursolve.solving.solution import Note, Refusal
from contoursolve.tolerance import AGREEMENT, LENGTH, RESIDUAL

QUARTER_TURN, FULL_TURN = 90.0, 360.0
"""Degrees."""


def agreement(fact: Fact, off: Any, at: Values, increment: Increments, figure: Figure) -> Iterator[Any]:
    """Margins that are not below 0 (mm) where a fact agrees that was not needed and is off by so much at these points;
    numbers or expressions."""
    limit, excess = fact.allowance(at, increment), fact.excess(at)
    larger, magnitude = at.functions.larger, at.functions.magnitude
    if fact.circle is not None and not fact.given:
        # The residual is the difference of the radii to first order only.
        yield from (fact.circle.slack - excess, fact.circle.slack + excess)
        return
    if fact.span is not None and excess is not None:
        # To first order the residual is the excess; where either is small, the lengths agree. It may lack its sign.
        yield larger(limit - magnitude(off), limit - magnitude(excess))
        return
    if fact.heading is not None and is_directed(fact, figure):
        # The equation alone is true of the opposite direction, too.
        (first, second), (cosine, sine) = step(at, *fact.heading), at.direction(fact.given)
        yield first * cosine + second * sine + LENGTH
    yield from (limit - off, limit + off)


def half_circle_allowance(
    chord: tuple[Any, Any], length: Any, radius: str, increment: Increments, magnitude: Callable[[Any], Any]
) -> Any:
    """The amount by which half of a chord may be more than a radius, mm: both ends and the radius are exact to half
    their increments."""
    across = magnitude(chord[FIRST]) * increment(str(FIRST)) + magnitude(chord[SECOND]) * increment(str(SECOND))
    return (across / length + increment(radius)) / 2 + RESIDUAL


def increments_of(profile: Profile) -> Increments:
    """The least increments of a profile's values."""
    found = profile.increments
    return lambda name: found[INCREMENT_OF + name]


def is_conflict(circuit: Circuit, profile: Profile, affine: AffineFacts) -> bool:
    """Whether facts about lines that say the same disagree: the last of them is held against the others, as it is
    where a contour is solved."""
    last = circuit.facts[-1]
    fixed = affine.fixed_by(circuit.facts[:-1])
    if not fixed.keys() >= {*assemble(profile).unknowns_of(last)}:
        return circuit.off[-1] > AGREEMENT
    return circuit.off[-1] > float(last.allowance(lookup(profile, fixed), increments_of(profile)))


def is_directed(fact: Fact, figure: Figure) -> bool:
    """Whether a fact states the direction in which a line of the path must run."""
    return fact.heading is not None and any(
        isinstance(line, Line) and line.heading == fact.given for line in figure.path
    )


def opposes(values: Mapping[str, float], unit: Unit) -> bool:
    """Whether an angle, compared as by `compare`, states the direction against the one that it would need to state. Its
    equation is true of both; a line without a length needs no direction."""
    expected = values.get("expected")
    return unit is Unit.DEGREE and expected is not None and abs(expected - values.get("actual", 0.0)) > QUARTER_TURN


def runs_against(facts: Iterable[Fact], profile: Profile, at: Values) -> bool:
    """Whether a line runs against the angle that one of some facts states, where these values hold its ends."""
    angles = (each for each in facts if each.heading and at.scalars.keys() >= {*each.reads()})
    return any(opposes(compare(each, profile, at), Unit.DEGREE) for each in angles)


def compare(fact: Fact, profile: Profile, at: Values) -> dict[str, float]:
    """The value that a fact states beside the one that it would need to state at these points, and the gap in mm.

    An expected angle is given by the turn number of the stated one, so that the two can be compared; of two that are
    half a turn away, by the smaller number.
    """
    given = profile.givens[fact.given]
    excess = fact.excess(at) if fact.span is not None else None
    values = {"actual": float(given.value), "off_by_mm": abs(float(fact.residual(at) if excess is None else excess))}
    expected = fact.implied(at)
    if expected is not None:
        if given.unit is Unit.DEGREE:
            expected += FULL_TURN * round((values["actual"] - expected) / FULL_TURN)
            other = expected - FULL_TURN if expected > values["actual"] else expected + FULL_TURN
            if abs(expected - values["actual"]) >= FULL_TURN / 2 - AGREEMENT:
                expected = min(expected, other, key=abs)
        values["expected"] = expected
    return values


def givens_of(fact: Fact, system: System) -> tuple[str, ...]:
    """The given of a fact, or those that determine what it mentions directly."""
    if fact.given:
        return (fact.given,)
    mentioned = set(system.unknowns_of(fact))
    return tuple(each.given for each in system.facts if each.given and set(system.unknowns_of(each)) <= mentioned)


def compare_fact(fact: Fact, off: float, profile: Profile, system: System, at: Values) -> Refusal | Note | None:
    """The event about a fact that was not needed and is off by so much (mm) at the points that the others give."""
    circle = fact.circle
    if circle is not None and not fact.given:
        # The residual is the difference of the radii to first order only.
        away, radius = step(at, circle.center, circle.point), float(at.radius(circle.radius))
        distance = hypot(*map(float, away))
        off = abs(distance - radius)
        values = {"limit": circle.slack, "actual": off, "off_by_mm": off, "radius": radius, "distance": distance}
        if not _agrees(fact, off, profile, at):
            return Refusal(RefusalKind.RADIUS_DIFFERENCE, circle.point, givens_of(fact, system), values)
        if off > AGREEMENT:
            return Note(NoteKind.RADIUS_DIFFERS, circle.point, givens_of(fact, system), values)
        return None
    name = fact.statement
    values = compare(fact, profile, at) if fact.given else {"off_by_mm": off}
    if fact.foot is not None and not fact.given:
        # A line that touches a circle there does so to an angle.
        spoke = hypot(*map(float, step(at, *fact.foot[1:])))
        values["turned_by"] = degrees(asin(min(1.0, off / spoke))) if spoke else 0.0
    is_word = fact.reach(at, increments_of(profile)) is not None
    gap = inf if is_word else abs(values.get("expected", inf) - values.get("actual", inf))
    # The equation alone is true of the opposite direction, too.
    is_opposite = any(float(sense) < -AGREEMENT for sense in fact.senses(at))
    # So is one part of a radius along one of its axes.
    is_against = is_opposite or (fact.is_half and opposes(values, Unit.DEGREE))
    if not is_against and (_agrees(fact, off, profile, at) or gap <= AGREEMENT):
        return Note(NoteKind.WORDS_AGREE, fact.given, (name or fact.given,), values) if fact.given else None
    givens = (name,) if name else givens_of(fact, system)
    kind = RefusalKind.WORDS_DISAGREE if "expected" in values else RefusalKind.FACT_DISAGREES
    return Refusal(kind, name, givens, values)


def _agrees(fact: Fact, off: float, profile: Profile, at: Values) -> bool:
    return all(margin >= 0 for margin in agreement(fact, off, at, increments_of(profile), profile.figure))


def compare_affine(profile: Profile, affine: AffineFacts) -> Iterator[Refusal | Note]:
    """The comparison of each fact that facts before it make unnecessary with these, whether they determine everything
    or not: words that say the same, whatever their values, and lines that are parallel, or the same, at these
    values."""
    system = assemble(profile)
    basis, independent = IndependentFacts(affine), dict[Fact, None]()
    here = lookup(profile, {})
    generic = circuits_of(system)
    for fact in profile.facts:
        circuit = basis.add(fact)
        if circuit is None:
            independent[fact] = None
            continue
        unknowns = {name for each in circuit.facts for name in system.unknowns_of(each)}
        fixed = basis.fixed(unknowns)
        off = circuit.off[-1]
        if _is_tied(fact, independent, generic, system):
            # What follows from others is so wherever these leave something free.
            fixed = affine.placed_by(circuit.facts[:-1]) | fixed
            event = compare_fact(fact, off, profile, system, replace(here, scalars={**here.scalars, **fixed}))
            if event is not None:
                yield event
            continue
        subject = ",".join(name for name in system.unknowns if name in unknowns and name not in fixed)
        givens = tuple(each.given for each in circuit.facts if each.given)
        if off <= RESIDUAL:
            yield Refusal(RefusalKind.NOT_FIXED, subject, givens)
        else:
            yield Refusal(RefusalKind.LINES_PARALLEL, subject, givens, {"off_by_mm": off})


def _is_tied(fact: Fact, basis: Mapping[Fact, None], generic: Mapping[Fact, tuple[Fact, ...]], system: System) -> bool:
    """Whether a fact follows from some independent ones before it whatever the values are; `generic` says it of the
    first facts that are independent for most values."""
    if fact not in generic:
        return False
    return basis.keys() >= {*generic[fact]} or analyse(system.keep((*basis, fact))).rank == len(basis)
