"""Repairs as fixes: what is written, and what the contour is then, so that no two that differ look the same."""

from collections.abc import Mapping, Sequence

from contoursolve.diagnosis.attempt import Repair
from contoursolve.diagnosis.edits import EditKind, edited
from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.wording import join, length_text, place_text
from contoursolve.diagnostics import Fix, NumberRange, OpenNumber
from contoursolve.geometry import Profile
from contoursolve.solving import ArcSegment, Contour, Point, scalars_of


def fixes_of(answer: Answer, repairs: Sequence[Repair]) -> tuple[Fix, ...]:
    """Repairs in words, each with the place where the contour then ends or turns; where several have the same place,
    with what is different."""
    outcomes = _outcomes(answer, [repair.contour for repair in repairs])
    return tuple(_fix(answer, repair, outcome) for repair, outcome in zip(repairs, outcomes, strict=True))


def _fix(answer: Answer, repair: Repair, outcome: str) -> Fix:
    edits = zip(repair.edits, repair.slips, strict=True)
    blocks = answer.claim.blocks
    told = (edit.among(blocks) + (f" ({slip.sentence})" if slip and slip.sentence else "") for edit, slip in edits)
    description = "; ".join(told)
    if repair.numbers:
        description += f" ({_numbers(repair.numbers)})"
    if outcome:
        description += f" -> {outcome}" + "".join(f", {drawback}" for drawback in repair.drawbacks)
    dropped = [edit.old for edit in repair.edits if edit.kind is EditKind.DROP and edit.errand]
    is_beside = len(dropped) == len(repair.edits)
    effect = f"drops {join(dropped)}" if is_beside else ""
    example = edited(blocks, repair.example) if any(each.example for each in repair.numbers) else ""
    replaced = "\n".join(block.text for block in blocks)
    return Fix(
        description,
        repair.replacement,
        repair.applicability,
        effect,
        example,
        replaced,
        repair.beside,
        repair.numbers,
    )


def _numbers(numbers: Sequence[OpenNumber]) -> str:
    """What open numbers may be; empty where there are none."""
    known = [each for each in numbers if each.example]
    if not known:
        return "no number was tried"
    if len(known) == 1:
        return f"such as {known[0].example}{_ranges(known[0], ', ')}"
    return "such as " + " and ".join(each.example + _ranges(each, " (", ")") for each in known)


def _ranges(number: OpenNumber, before: str, behind: str = "") -> str:
    if not number.ranges:
        return ""
    texts = [*map(_range, number.ranges)]
    return before + ("; or " if len(texts) > 1 else "").join(texts) + "; or others" * (not number.is_complete) + behind


def _range(ends: NumberRange) -> str:
    if not ends.low and not ends.high:
        return "any number"
    if not ends.low or not ends.high:
        return f"{ends.low} or above" if ends.low else f"{ends.high} or below"
    return f"between {ends.low} and {ends.high}" if ends.low != ends.high else ends.low


def _outcomes(answer: Answer, contours: Sequence[Contour | None]) -> list[str]:
    """A text for each contour: where it ends or turns, and what tells it from those of which that is the same."""
    texts = [_place(answer, contour) if contour else "" for contour in contours]
    features = [_features(answer.profile, contour) if contour else {} for contour in contours]
    while groups := _alike(texts, features):
        for group in groups:
            name = _most_different([features[each] for each in group])
            for each in group:
                texts[each] += f", {features[each].get(name, f'without {name}')}"
    return texts


def _place(answer: Answer, contour: Contour) -> str:
    profile = answer.profile
    point = next(iter(profile.intersections), "")
    # The changed blocks may be of another form.
    if answer.contour is None and len(answer.lines) > 1 and point in contour.points:
        return f"{point} is at {_at(profile, contour.points[point])}"
    return f"the contour ends at {_at(profile, contour.end)}"


def _at(profile: Profile, place: Point) -> str:
    return place_text(profile, scalars_of({"": place}))


def _features(profile: Profile, contour: Contour) -> dict[str, str]:
    """The texts about a contour, by their subjects: its points, its elements, its end."""
    found = {name: f"{name} at {_at(profile, at)}" for name, at in contour.points.items()}
    corners = {each.name for each in contour.elements if each.name.startswith("corner ")}
    # A corner is what is meant to differ; that its neighbours end elsewhere follows from it.
    for each in sorted(contour.elements, key=lambda element: element.name not in corners):
        length = each.radius if isinstance(each, ArcSegment) else each.length
        size = f"with radius {length_text(length, profile.unit)}" if isinstance(each, ArcSegment) else ""
        if each.name in corners:
            found[each.name] = f"{each.name} {size or length_text(length, profile.unit) + ' long'}"
        elif isinstance(each, ArcSegment):
            found[each.name] = f"{each.name} {each.turn.value} {size} to {_at(profile, each.end)}"
        else:
            found[each.name] = f"{each.name} to {_at(profile, each.end)}"
    return found | {"the end": f"the end at {_at(profile, contour.end)}"}


def _alike(texts: Sequence[str], features: Sequence[Mapping[str, str]]) -> list[list[int]]:
    """The places of contours that are told alike and are not, as far as texts can tell."""
    groups: dict[str, list[int]] = {}
    for place, text in enumerate(texts):
        groups.setdefault(text, []).append(place)
    return [each for text, each in groups.items() if text and any(features[each[0]] != features[at] for at in each)]


def _most_different(features: Sequence[Mapping[str, str]]) -> str:
    """The text that differs most among some contours, the first of those that do."""
    names = dict.fromkeys(name for each in features for name in each)
    return max(names, key=lambda name: len({each.get(name) for each in features}))
