"""The construction of a contour in words, which a toolmaker could follow with ruler and compass."""

from collections.abc import Iterable, Iterator, Mapping

from contoursolve.diagnosis import (
    Answer,
    called_in_program,
    chosen_solution,
    fact_text,
    join,
    length_text,
    list_alternatives,
    unknowns_text,
)
from contoursolve.diagnostics import checked
from contoursolve.geometry import Profile, System, assemble
from contoursolve.output.plain_text import printable
from contoursolve.solving import (
    ARCS,
    ConstructionStep,
    Group,
    analyse,
    is_searched,
    spare_of,
    steps_of,
)


@checked
def construction_lines(answer: Answer) -> list[str]:
    """The construction of a contour, step by step, as `contoursolve solve --explain` prints it."""
    profile = answer.profile
    if not profile.start.is_known:
        return ["  construction: the start point is not known"]
    system, called = assemble(profile), called_in_program(profile)
    verdict = analyse(system)
    if not verdict.is_determined:
        return [f"  construction: still open: {called(unknowns_text(verdict.free, profile))}"]
    chosen = chosen_solution(profile, list_alternatives(answer)) if answer.contour is not None else None
    scalars, sides = (chosen.scalars, chosen.sides) if chosen is not None else ({}, {})
    lines = ["  construction:"]
    for number, group in enumerate(_joined(steps_of(system)), 1):
        facts = join(
            list(
                dict.fromkeys(
                    filter(None, (printable(called(fact_text(fact, group.unknowns, profile))) for fact in group.facts))
                )
            )
        )
        how = _choice(group, system, sides)
        place = _place(group, profile, scalars)
        lines.append(f"    {number}. {called(_things(group, profile))}: {facts}{how}")
        lines += [f"       -> {place}"] if place else []
    words = join([printable(word.text) for word in profile.words_of(spare_of(system))])
    return [*lines, f"    checked besides: {words}"] if words else lines


def _joined(steps: Iterable[ConstructionStep]) -> Iterator[Group]:
    """Steps in a row that find coordinates of one point, as one step."""
    pending: Group | None = None
    for step in steps:
        group = Group(step.facts, step.unknowns)
        if pending is not None and len(_names(pending)) == 1 and _names(pending) == _names(group):
            pending = Group(pending.facts + group.facts, pending.unknowns + group.unknowns)
            continue
        if pending is not None:
            yield pending
        pending = group
    if pending is not None:
        yield pending


def _names(group: Group) -> set[str]:
    return {name.rpartition(".")[0] for name in group.unknowns}


def _things(group: Group, profile: Profile) -> str:
    """The unknowns that a step finds, as text without the names of axes."""
    shown = unknowns_text(group.unknowns, profile)
    axes = f" ({join(profile.plane.axes)})"
    return shown.replace(axes, "")


def _choice(group: Group, system: System, sides: Mapping[str, str]) -> str:
    """Text behind a step: the place that is chosen among several, and a search where there is no closed form."""
    names = _names(group)
    chosen = [f"the {side}" if side in ARCS else f"the one {side}" for name, side in sides.items() if name in names]
    is_open = len(group.unknowns) > 1 and is_searched(system, group)
    numeric = "; no closed form: searched, and proven" if is_open else ""
    return (f"; {join(chosen)}" if chosen else "") + numeric


def _place(group: Group, profile: Profile, scalars: Mapping[str, float]) -> str:
    """Coordinates of the points of a step, and sizes of its radii, as text."""
    texts = []
    for name in group.unknowns:
        thing, _, part = name.rpartition(".")
        if name not in scalars or part in ("cos", "sin", "off"):
            continue
        value = scalars[name]
        if part.isdigit():
            shown = value * (2 if profile.plane.diameters[int(part)] else 1)
            label = (
                f"{thing} {profile.plane.axes[int(part)]}" if len(_names(group)) > 1 else profile.plane.axes[int(part)]
            )
            texts.append(f"{label}{length_text(shown, profile.unit)}")
        else:
            texts.append(f"radius {length_text(value, profile.unit)}")
    return " ".join(texts)
