"""Facts in words: each as a condition on what is sought, and on which condition several of them determine it."""

import re
from collections.abc import Collection, Sequence

from contoursolve.diagnosis.wording import angle_text, join, length_text, unknowns_text
from contoursolve.gcode import FACT
from contoursolve.geometry import Fact, Profile, System
from contoursolve.solving import Group


def fact_text(fact: Fact, sought: Collection[str], profile: Profile) -> str:
    """One fact as a condition on `sought` unknowns, with its word; empty for what goes without saying."""
    given = profile.givens.get(fact.given or getattr(fact, "part_of", ""))
    word = f" ({given.word.text.strip()})" if given is not None and given.word is not None else ""
    if given is not None and given.word is not None and given.word.address == FACT:
        return given.word.text.strip()
    unit, axes = profile.unit, profile.plane.axes
    if given is not None and fact.placed is not None and fact.placed.is_stepped:
        point, axis, origin, _ = fact.placed
        if origin:
            return f"{length_text(float(given.value), unit)} from {origin} along {axes[axis]}{word}"
        factor = 2 if profile.plane.diameters[axis] else 1
        return f"{point} at {axes[axis]}{length_text(float(given.value) * factor, unit)}{word}"
    if given is not None and fact.heading is not None:
        tail, head = fact.heading
        other = tail if f"{head}.0" in sought or f"{head}.1" in sought else head
        return f"on the line through {other} at {angle_text(given.as_typed(float(given.value)))}{word}"
    if given is not None and fact.sizes:
        return f"radius {length_text(float(given.value), unit)}{word}"
    return fact.phrase(axes, sought)


def condition_text(group: Group, system: System, profile: Profile) -> str:
    """The condition in words on which the facts of a group determine its unknowns."""
    circles = [fact for fact in group.facts if fact.circle]
    headings = [fact for fact in group.facts if fact.heading]
    placed = [fact.placed for fact in group.facts if fact.placed]
    lines, axes, size = _lines(headings, profile), profile.plane.axes, len(group.facts)
    if len(headings) == size == _PAIR:
        return f"{lines} must not be parallel"
    if len(headings) == size == 1:
        return f"{lines} must not be parallel to {axes[int(group.unknowns[0].rpartition('.')[2])]}"
    if len(headings) == len(placed) == 1 and size == _PAIR:
        return f"{lines} must not be parallel to {axes[1 - placed[0].axis]}"
    if len(circles) == size == 1 and group.unknowns[0] in system.figure.radii:
        return "the radius must not be zero"
    if len(circles) == size == _PAIR:
        return "the two circles must not only touch"
    if len(circles) == 1 and size == _PAIR:
        return "the line must not only touch the circle"
    return f"the equations for {unknowns_text(group.unknowns, profile)} must not say the same"


_PAIR = 2


def _lines(headings: Sequence[Fact], profile: Profile) -> str:
    """The lines that run at given angles, with their words."""
    words = [word.text.strip() for word in profile.words_of(headings)]
    return f"the {'lines' if len(headings) > 1 else 'line'} at {join(words)}" if words else "the line"


def fact_subject(text: str) -> str:
    """The subject of a fact, whose value it gives, as it is printed."""
    return " ".join(text.partition("=")[0].split())


def fact_key(text: str) -> str:
    """The subject of a fact, however it is spelled: `Z of end of corner 2` is `corner 2.end Z`."""
    subject = fact_subject(text).lower().replace("centre", "center")
    also = _ALSO.fullmatch(subject)
    if also is None:
        return _DOTTED.sub(r" \1", subject)
    axis, part, of = also.groups()
    return f"{of}{f'.{_BEGIN.get(part, part)}' if part else ''} {axis}"


_ALSO = re.compile(r"([a-z]) of (?:(begin|start|end|center) of )?(.+)")
_DOTTED = re.compile(r"\.([a-z])$")
_BEGIN = {"start": "begin"}
