"""Reasons in short sentences: because these words say this, and that word says that, ... so."""

import json
import pkgutil
import re
from collections.abc import Container, Iterable, Iterator, Sequence
from decimal import Decimal
from functools import lru_cache
from itertools import pairwise

from contoursolve.diagnosis.wording import (
    DECIMALS,
    angle_text,
    by_line,
    element_text,
    inward,
    join,
    length_text,
    limit_text,
    number_text,
    place_text,
    statement_text,
)
from contoursolve.diagnostics import Diagnostic, Freedom, Span
from contoursolve.geometry import FIRST, SECOND, Arc, Fact, Line, Profile, assemble, scalar
from contoursolve.solving import (
    AffineFacts,
    Circuit,
    Topic,
    analyse,
    groups_of,
    is_conflict,
    lookup,
    refusals_about,
    runs_against,
)
from contoursolve.tolerance import REGULAR


def identity(profile: Profile, facts: Iterable[Fact]) -> str:
    """The formula by which the words of these facts depend on one another, such as `K = I/tan(A)`; empty where no
    formula is kept. The start point's coordinates are called Zstart, Xstart and so on."""
    names = sorted(fact.given for fact in facts if fact.given)
    formula = _shipped().get(f"{profile.form}: {' '.join(names)}", "")
    for name in sorted(names, key=len, reverse=True):
        word = profile.givens[name].word
        formula = formula.replace(name, word.address if word else f"{profile.givens[name].value:f}")
    for number, axis in enumerate(profile.plane.axes):
        formula = formula.replace(scalar(profile.figure.start, number), f"{axis}start")
    return formula


_DIFFERENCE = re.compile(r"= -(\w+) \+ (\w+)$")
_STARTS = re.compile(r"\b(\w)start\b")


@lru_cache(maxsize=1)
def _shipped() -> dict[str, str]:
    data = pkgutil.get_data("contoursolve.solving", "identities.json")
    table: dict[str, str] = json.loads(data) if data else {}
    return table


def conflict_reasons(
    profile: Profile,
    affine: AffineFacts,
    circuit: Circuit,
    trusted: Container[Span] = (),
    *,
    is_about_direction: bool,
) -> Iterator[str]:
    """Sentences on where the facts of a circuit put their point, and how far apart; nobody needs to change words at
    `trusted` places.

    The last fact that is not an angle is compared with the others, because a place can be compared; where a direction
    is only opposite (`is_about_direction`), no place tells.
    """
    places = [fact for fact in circuit.facts if not fact.heading] or list(circuit.facts)
    single = places[-1]
    others = [fact for fact in circuit.facts if fact is not single]
    fixed = affine.fixed_by(others)
    point = getattr(single, "point", "")
    known = {name: value for name, value in fixed.items() if name.partition(".")[0] == point}
    is_apart = is_conflict(circuit, profile, affine)
    is_place = (is_apart or not is_about_direction) and not runs_against(others, profile, lookup(profile, fixed))
    if known and single.given and is_place:
        given = profile.givens[single.given]
        row = affine.facts.index(single)
        axis = next(axis for axis in (FIRST, SECOND) if scalar(point, axis) in single.reads())
        own = -float(affine.constants[row]) / affine.rows[row].get(affine.columns[scalar(point, axis)], 0.0)
        shown = circuit.off[circuit.facts.index(single)] * (2 if profile.plane.diameters[axis] else 1)
        apart = f"{length_text(shown, profile.unit)} apart"
        ending = apart if is_apart else "the same place"
        verb = "put" if len(others) > 1 else "puts"
        words = join([word.text for word in profile.words_of(others)])
        yield (
            f"because {words} {verb} {point} at {place_text(profile, known)}, "
            f"and {given.word.text if given.word else 'what is not written'} puts it at "
            f"{place_text(profile, {scalar(point, axis): own})}: {ending}"
        )
    places_of = {name: given.word.span for name, given in profile.givens.items() if given.word}
    others = [fact for fact in circuit.facts if places_of.get(fact.given) not in trusted]
    agreeing = [text for fact in others if (text := _agreeing(profile, affine, circuit, fact))]
    if (is_apart or is_about_direction) and agreeing:
        several = f"change one: {', '.join(agreeing[:-1])} or {agreeing[-1]}"
        yield several if len(agreeing) > 1 else f"write {agreeing[0]} instead"
    formula = identity(profile, circuit.facts)
    if formula:
        radius = " (X and U as radius)" if "tan" in formula and ("X" in formula or "U" in formula) else ""
        yield _STARTS.sub(r"start \1", _DIFFERENCE.sub(r"= \2 minus \1", formula)) + radius


def _agreeing(profile: Profile, affine: AffineFacts, circuit: Circuit, fact: Fact) -> str:
    """One fact of a circuit as it would be written to agree with the others."""
    others = [other for other in circuit.facts if other is not fact]
    at = lookup(profile, affine.fixed_by(others))
    # Where the others turn a line round, no length does that makes it agree.
    if not fact.given or not at.scalars.keys() >= {*fact.reads()} or runs_against(others, profile, at):
        return ""
    value, given = fact.implied(at), profile.givens[fact.given]
    if value is None or given.word is None:
        return ""
    shown, stated = (given.as_typed(each) for each in (value, float(given.value)))
    is_same = number_text(shown, given.unit, profile.unit) == number_text(stated, given.unit, profile.unit)
    return "" if is_same else statement_text(given, shown, profile)


def freedom_reasons(profile: Profile, freedoms: Sequence[Freedom]) -> Iterator[str]:
    """Sentences on what can still move, and how."""
    for freedom in freedoms:
        if freedom.direction is None:
            yield f"{freedom.point} can still lie anywhere"
            continue
        axis = next((axis for axis in (FIRST, SECOND) if abs(freedom.direction[1 - axis]) < REGULAR), None)
        way = f"along {profile.plane.axes[axis]}" if axis is not None else f"along {angle_text(freedom.angle or 0)}"
        if freedom.about:
            arcs = (each for each in profile.figure.path if isinstance(each, Arc) and each.center == freedom.about)
            way = f"along {next((each.name for each in arcs), f'the circle about {freedom.about}')}"
        elif not freedom.is_straight:
            way = f"along a curve (here {way})"
        yield f"{freedom.point} can still slide {way}"


def path_reasons(profile: Profile, affine: AffineFacts | None, finding: Diagnostic) -> Iterator[str]:
    """Sentences on the source of the numbers in a finding about the path."""
    values = finding.values
    yield from _placed_before(profile, finding)
    if "angle_from" in values:
        known = "start" if _ends_on_arc(profile, finding) else "end"
        stated = (each for each in profile.givens.values() if each.word and each.word.address == finding.addresses[0])
        given = next(stated, None)
        both = (values[name] for name in ("angle_from", "angle_to"))
        ends = zip(sorted(both if given is None else map(given.as_typed, both)), (-1, 1), strict=True)
        yield (
            f"a line through the same {known} point meets the circle with {finding.addresses[0]} between "
            f"{' and '.join(limit_text(inward(Decimal(repr(at)), DECIMALS['deg'], way), 'deg') for at, way in ends)}"
        )
    if affine is not None and finding.about in refusals_about(Topic.DIRECTION):
        fixed = affine.fixed_by(affine.facts)
        for line in (element for element in profile.figure.path if isinstance(element, Line)):
            word = profile.givens[line.heading].word if line.heading else None
            if word and word.span == finding.span:
                tail, head = (_known(profile, fixed, point) for point in (line.tail, line.head))
                if tail and head:
                    yield (
                        f"because {element_text(line.name)} goes from {place_text(profile, tail)} to "
                        f"{place_text(profile, head)}, and {word.text} points the other way"
                    )


def _ends_on_arc(profile: Profile, finding: Diagnostic) -> bool:
    """Whether the line of which a word states the angle goes on as an arc."""
    for line, after in pairwise(profile.figure.path):
        word = profile.givens[line.heading].word if isinstance(line, Line) and line.heading else None
        if word is not None and word.span == finding.span:
            return isinstance(after, Arc)
    return False


def _placed_before(profile: Profile, finding: Diagnostic) -> Iterator[str]:
    """Sentences on the words of earlier blocks that put the beginning of an element of a later one where it is."""
    if finding.about not in refusals_about(Topic.RADII) or len(profile.blocks) != len(profile.figure.path):
        return
    for element, block in zip(profile.figure.path, profile.blocks, strict=True):
        if block.line == finding.span.line and element.tail != profile.figure.start:
            system = assemble(profile)
            if not analyse(system).is_determined:
                return
            wanted = {scalar(element.tail, axis) for axis in (FIRST, SECOND)}
            facts: list[Fact] = []
            for group in reversed(groups_of(system)):
                if wanted & {*group.unknowns}:
                    facts += group.facts
                    wanted |= {name for fact in group.facts for name in system.unknowns_of(fact)}
            words = sorted(profile.words_of(facts), key=lambda word: word.span)
            if words:
                shown = by_line((word.text, word.span.line) for word in words)
                yield f"because {element_text(element.name)} begins at {element.tail}, where {shown} put it"


def _known(profile: Profile, fixed: dict[str, float], point: str) -> dict[str, float]:
    """The coordinates of a point; none where not both are known, as far beyond all travel."""
    at = lookup(profile, fixed)
    try:
        return {scalar(point, axis): at.coordinate(point, axis) for axis in (FIRST, SECOND)}
    except KeyError:
        return {}
