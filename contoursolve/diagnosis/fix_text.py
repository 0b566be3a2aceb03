"""Repairs as fixes: what is written, and what the contour is then, so that no two that differ look the same."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial

from msgspec.structs import replace

from contoursolve.diagnosis.attempt import Repair
from contoursolve.diagnosis.certain_slips import MendedText
from contoursolve.diagnosis.edits import Edit, EditKind, edited
from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.slip_kinds import SlipKind
from contoursolve.diagnosis.slips_around import touches
from contoursolve.diagnosis.wording import MOST_FIXES, PROBABLY, join, length_text, place_text
from contoursolve.diagnostics import Diagnostic, Fix, Label, NumberRange, OpenNumber
from contoursolve.gcode import Block
from contoursolve.geometry import Profile
from contoursolve.solving import ArcSegment, Contour, Point, scalars_of


def with_fixes(finding: Diagnostic, answer: Answer, repairs: Sequence[Repair]) -> Diagnostic:
    """A finding with repairs as its fixes; it points at the words that the first one changes, too."""
    return _pointing(replace(finding, fixes=fixes_of(answer, repairs)), repairs)


def _pointing(finding: Diagnostic, repairs: Sequence[Repair]) -> Diagnostic:
    """The finding; it points at the words that its first fix changes, too, and says where that adds or takes away."""
    known, labels, notes = [label.span for label in finding.labels], list[Label](), list[str]()
    edits = repairs[0].edits if repairs else ()
    are_blocks = any(each and each.name == "blocks-swapped" for repair in repairs[:1] for each in repair.slips)
    lines = [str(edit.place) for edit in edits] if are_blocks and _are_exchanged(edits) else []
    for edit in edits:
        is_marked = any(touches(edit, span) for span in known)
        if edit.place <= 0 or is_marked or (edit.kind is EditKind.ADD and edit.place in {span.line for span in known}):
            continue
        there = f"program line {edit.place}"
        if lines:
            notes = [f"program lines {join(sorted(lines, key=int))} were probably exchanged"]
        elif edit.kind is EditKind.CHANGE:
            notes.append(f"{edit.old} in {there} was probably {edit.text}")
        elif edit.kind is EditKind.DROP:
            meant = next((each for each in edits if each.kind is EditKind.ADD and each.address == edit.address), None)
            where = (
                f"was probably meant {_side(meant)} program line {meant.place}" if meant else "is probably not meant"
            )
            notes.append(f"{edit.old} in {there} {where}")
        elif edit.kind is EditKind.ADD and not any(each.kind is EditKind.DROP for each in edits):
            notes.append(f"{edit.address} is missing {_side(edit)} {there}")
        if edit.span is not None:
            other = [f"exchanged with program line {each}" for each in lines if each != str(edit.place)]
            labels.append(Label(edit.span, PROBABLY + (other[0] if other else edit.text or "not meant here")))
    # The first reason says what is wrong.
    told = (*finding.notes[:1], *notes, *finding.notes[1:])
    return replace(finding, labels=(*finding.labels, *labels), notes=told)


def _side(edit: Edit) -> str:
    return "after" if edit.is_behind else "in"


def fixes_of(answer: Answer, repairs: Sequence[Repair], typed: MendedText | None = None) -> tuple[Fix, ...]:
    """Repairs in words, each with the place where the contour then ends or turns; where several have the same place,
    with what is different. Those of a text that is mended in thought change the text as it is `typed`."""
    repairs = _told(answer, repairs)
    outcomes = _outcomes(answer, repairs)
    return tuple(_fix(answer, repair, outcome, typed) for repair, outcome in zip(repairs, outcomes, strict=True))


def _told(answer: Answer, repairs: Sequence[Repair]) -> list[Repair]:
    """The repairs that are told: the first few, and all that only choose among the solutions. Of several that leave
    open numbers which nobody knows, the finding says enough."""
    unknown = [repair for repair in repairs if repair.numbers and not any(each.example for each in repair.numbers)]
    if len(unknown) > 1 or any(repair.numbers for repair in repairs if repair not in unknown):
        repairs = [repair for repair in repairs if repair not in unknown]
    claim = answer.claim
    choosing = {claim.vocabulary[name][0] for name in claim.form.choices if name in claim.vocabulary}
    choosing = {*choosing, claim.form.free.picking} - {""}

    def chooses(repair: Repair) -> bool:
        return all(edit.address in choosing and edit.kind is not EditKind.DROP for edit in repair.edits)

    first = [repair for repair in repairs if not chooses(repair)][:MOST_FIXES]
    return [repair for repair in repairs if chooses(repair) or repair in first]


def told(edits: Sequence[Edit], slips: Sequence[SlipKind | None], blocks: Sequence[Block]) -> str:
    """Edits in words, and the slip that each undoes; `blocks` are those of the contour. A word that goes from one place
    to another is moved, and blocks that get each other's text are exchanged."""
    sentences = [slip.sentence if slip else "" for slip in slips]
    texts = [edit.among(blocks) for edit in edits]
    is_one = len({*sentences}) == 1
    if is_one and len(edits) > 1:
        texts = _together(edits) or texts
        return "; ".join(texts) + f" ({sentences[0]})" * bool(sentences[0])
    return "; ".join(text + f" ({sentence})" * bool(sentence) for text, sentence in zip(texts, sentences, strict=True))


def _together(edits: Sequence[Edit]) -> list[str]:
    """Several edits as one; nothing if they are no move and no exchange."""
    last = edits[-1]
    old, lines = [edit.old.strip() for edit in edits], [edit.place for edit in edits]
    is_moved = last.kind is EditKind.ADD and all(edit.kind is EditKind.DROP for edit in edits[:-1])
    if is_moved and " ".join(old[:-1]) == last.text.strip():
        where = "after" if last.is_behind else "to"
        errand = edits[0].errand if len(edits) == _PAIR else None
        what = last.text.strip() + (f" ({errand.meaning})" if errand else "")
        return [f"move {what} from program line {lines[0]} {where} program line {lines[-1]}"]
    if _are_exchanged(edits):
        return [f"exchange {old[0]} in program line {lines[0]} and {old[1]} in program line {lines[1]}"]
    return []


_PAIR = 2


def _are_exchanged(edits: Sequence[Edit]) -> bool:
    """Whether two edits in different lines give each other's place its text."""
    if len(edits) != _PAIR:
        return False
    one, other = edits
    return one.place != other.place and (one.old, one.text) == (other.text, other.old)


def _fix(answer: Answer, repair: Repair, outcome: str, typed: MendedText | None) -> Fix:
    blocks, edits = answer.claim.blocks, repair.edits
    write: Callable[[Iterable[Edit]], str] = partial(edited, blocks)
    replacement, beside = repair.replacement, repair.beside
    if typed is not None:
        blocks, edits, write = typed.own, tuple(map(typed.typed, edits)), typed.edited
        replacement, beside = write(repair.edits), (*beside, *typed.beside(repair.edits))
    description = told(edits, repair.slips, blocks)
    if repair.numbers:
        description += f" ({_numbers(repair.numbers)})"
    if outcome:
        description += f" -> {outcome}" + "".join(f", {drawback}" for drawback in repair.drawbacks)
    dropped = [edit.old for edit in repair.edits if edit.kind is EditKind.DROP and edit.errand]
    is_beside = len(dropped) == len(repair.edits)
    effect = f"drops {join(dropped)}" if is_beside else ""
    example = write(repair.example) if any(each.example for each in repair.numbers) else ""
    replaced = "\n".join(block.text for block in blocks)
    return Fix(
        description,
        replacement,
        repair.applicability,
        effect,
        example,
        replaced,
        beside,
        repair.numbers,
    )


def _numbers(numbers: Sequence[OpenNumber]) -> str:
    """The numbers that may be written for open ones, in words."""
    known = [each for each in numbers if each.example]
    if not known:
        return "no number for it was found"
    if len(known) == 1:
        return f"such as {known[0].example}{_ranges(known[0], ', ')}"
    return f"such as {join([each.example + _ranges(each, ' (', ')') for each in known])}"


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


def _outcomes(answer: Answer, repairs: Sequence[Repair]) -> list[str]:
    """A text for each repair: where its contour ends or turns, and what tells it from those of which that is the
    same."""
    contours = [repair.contour for repair in repairs]
    texts = [_place(answer, repair, contours) for repair in repairs]
    features = [_features(_drawn(answer, contour), contour) if contour else {} for contour in contours]
    while groups := _alike(texts, features):
        for group in groups:
            name = _most_different([features[each] for each in group])
            for each in group:
                texts[each] += f", {features[each].get(name, f'without {name}')}"
    return texts


def _drawn(answer: Answer, contour: Contour) -> Profile:
    """The profile in whose plane a contour lies, which an edit may have changed."""
    profile = answer.profile
    return profile if contour.plane == profile.plane else replace(profile, plane=contour.plane)


def _place(answer: Answer, repair: Repair, contours: Sequence[Contour | None]) -> str:
    """The place of the point that the edited block makes; else of the first intersection that is not the same in all
    contours, or of the end."""
    contour = repair.contour
    if contour is None:
        return ""
    profile = _drawn(answer, contour)
    point = next(iter(profile.intersections), "")
    # The changed blocks may be of another form.
    if answer.contour is None and len(answer.lines) > 1 and point in contour.points:
        own = _touched(answer, repair.edits)
        is_end = bool(own) and own == profile.figure.path[-1].head
        if own not in contour.points and is_end:
            return f"the contour ends at {_at(profile, contour.end)}"
        named = [each for each in (own, point, *profile.intersections) if each in contour.points]
        point = next((each for each in named if _differs(each, contours)), named[0])
        return f"{point} is at {_at(profile, contour.points[point])}"
    return f"the contour ends at {_at(profile, contour.end)}"


def _differs(point: str, contours: Sequence[Contour | None]) -> bool:
    """Whether a point is not at the same place in all contours, as far as a text can tell."""
    places = {each.points.get(point) for each in contours if each is not None}
    return len({None if each is None else tuple(round(at, 3) for at in each) for each in places}) > 1


def _touched(answer: Answer, edits: Sequence[Edit]) -> str:
    """The point that edits move first of all: where the last element that they change ends, or begins if its end is
    stated and they change no coordinate; empty if they change none."""
    claim, path = answer.claim, answer.profile.figure.path
    names = claim.makes or [(each.name,) for each in path]
    if len(names) != len(claim.blocks):
        return ""
    lines, rows = {edit.place for edit in edits}, claim.lexicon.addresses

    def axes(addresses: Iterable[str]) -> set[str]:
        return {row.axis for each in addresses if (row := rows.get(each)) is not None and row.axis}

    for block, own in reversed([*zip(claim.blocks, names, strict=True)]):
        element = next((each for each in reversed(path) if each.name in own), None)
        if block.line in lines and element is not None:
            is_stated = len(axes(word.address for word in block.words)) > 1
            is_elsewhere = is_stated and not axes(edit.address for edit in edits if edit.place == block.line)
            return element.tail if is_elsewhere else element.head
    return ""


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
            # The only one needs no name, and the word that names it may be another one now.
            name = each.name if len(corners) > 1 else f"the {'rounding' if size else 'chamfer'}"
            found[each.name] = f"{name} {size or length_text(length, profile.unit) + ' long'}"
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
