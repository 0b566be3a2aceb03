"""Arcs by themselves in words: what is wrong with one, and with which word it would be right."""

from collections.abc import Callable, Iterator, Sequence
from math import hypot, sqrt

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.edits import AT_LEAST, Edit, apply_edits, change, drop, has_plus, with_plus, write_word
from contoursolve.diagnosis.explain import Context, report
from contoursolve.diagnosis.wording import MOST_FIXES, join, length_limit, length_text, limit_text
from contoursolve.diagnostics import Applicability, Basis, Diagnostic, Fix, LineChange, Span
from contoursolve.gcode import Block, Word, parse_block
from contoursolve.reading import (
    CENTRES,
    ArcFault,
    ArcIssue,
    ArcWord,
    Beyond,
    Control,
    Modes,
    PlainArc,
    State,
    arc_of,
    faults_of,
    restate,
)
from contoursolve.tolerance import LENGTH

_PATHS = {
    Beyond.SPIRAL: "a spiral from the one radius to the other",
    Beyond.AXIS_LINE: "the arc with the first radius, then a straight line along one axis",
}
"""The path that a control cuts, if it does not stop."""

_COMPARED = (ArcIssue.RADII_DIFFER, ArcIssue.RADII_UNCORRECTED, ArcIssue.SPIRAL, ArcIssue.CENTRE_MOVES)


class _Mended(Struct, frozen=True):
    """Words of an arc with other values (mm, as in `ArcWord`), and by how much they change; a slip comes first."""

    words: tuple[tuple[ArcWord, float], ...]
    amount: float
    is_slip: bool = False
    rounding: str = ""


def explain_arc(context: Context, control: Control, arc: PlainArc, before: State) -> Iterator[Diagnostic]:
    """Findings about the arc that a block states by itself, if something is wrong with it."""
    for fault in faults_of(arc):
        fixes = tuple(_fixes(arc, fault, before, control.modes))[:MOST_FIXES]
        told = replace(_told(context, arc, fault), fixes=fixes)
        is_open = any(each.name == CENTRES for each in control.settings)
        if is_open and fault.issue in _COMPARED and any(each.is_slip for each in _from_origin(arc)):
            words = join([each.word.text.strip() for each in arc.centers if each is not None])
            setting = f"--setting {control.name}.{CENTRES}=origin"
            note = f"{words} fit as coordinates of the centre; if the control reads them so, state {setting}"
            told = replace(told, notes=(*told.notes, note))
        yield told


def _told(context: Context, arc: PlainArc, fault: ArcFault) -> Diagnostic:
    unit, values = arc.here.unit, fault.values
    blamed: Sequence[Word] = arc.words
    if fault.issue is ArcIssue.OUTSIDE_PLANE:
        blamed = arc.outside
    elif fault.issue in (ArcIssue.RADIUS_SMALL, ArcIssue.FULL_BY_RADIUS, ArcIssue.MOVES_NOTHING, ArcIssue.OVER_HALF):
        own = (*arc.ends, arc.radius)
        blamed = [each.word for each in own if each is not None]
    elif fault.issue is ArcIssue.BOTH:
        blamed = [each.word for each in (*arc.centers, arc.radius) if each is not None]
    # The centre may stand in another line, which a fix names.
    blamed = [word for word in blamed if word.span.line == arc.block.line]
    lengths = {name: length_text(value, unit) for name, value in values.items()}
    if fault.issue is ArcIssue.RADIUS_SMALL:
        lengths["limit"] = limit_text(length_limit(values["limit"], unit, -1), unit.value)
    center = " and ".join(sorted(arc.here.plane.centers))
    fields = {"path": _PATHS.get(arc.table.beyond, ""), "plane": arc.here.plane.code, "center": center}
    off = next((lengths[name] for name in ("shift", "off_by_mm") if name in lengths), "")
    place = Context(context.rules, unit, place=arc.block.span)
    kept = {name: values[name] for name in ("limit", "actual", "off_by_mm") if name in values}
    basis = Basis.NUMERICAL if values else Basis.RULE
    return report(place, fault.issue, basis, blamed, kept, off=off, **fields, **lengths)


def _fixes(arc: PlainArc, fault: ArcFault, before: State, modes: Modes) -> Iterator[Fix]:
    """The fixes with which the arc is right, the likeliest first."""
    if fault.issue in _COMPARED or fault.issue is ArcIssue.RADIUS_SMALL:
        propose = _of_center if fault.issue in _COMPARED else _of_radius
        ordered = sorted(propose(arc), key=lambda each: (not each.is_slip, each.amount))
        told = dict[str, Fix]()
        for each in ordered:
            fix = _with_values(arc, each, before, modes)
            if fix is not None:
                told.setdefault(fix.description, fix)
        yield from told.values()
        return
    tried = list[tuple[str, str]]()
    block = arc.block
    if fault.issue is ArcIssue.BOTH:
        centers = [each.word for each in arc.centers if each is not None]
        tried += (_dropped(block, words) for words in ([arc.radius.word] if arc.radius else [], centers))
    elif fault.issue is ArcIssue.OUTSIDE_PLANE:
        free = [name for name, own in zip(arc.here.plane.centers, arc.centers, strict=True) if own is None]
        for word in arc.outside[:1]:
            tried += (_edited(block, [change(word, name + word.text.strip()[1:])]) for name in free)
        tried.append(_dropped(block, arc.outside))
    elif fault.issue in (ArcIssue.UNDEFINED, ArcIssue.RUNS_LINE) and modes.follow is None:
        tried.append(_as_line(block))
    for description, text in tried:
        if text != block.text and _is_right(text, block, before, modes, is_line=fault.issue in _LINES):
            yield Fix(description, text, Applicability.CHANGES_CONTOUR, replaced=block.text)


_LINES = (ArcIssue.UNDEFINED, ArcIssue.RUNS_LINE)
"""Issues with an arc that was probably meant to be a line."""


def _edited(block: Block, edits: Sequence[Edit]) -> tuple[str, str]:
    return join([str(each) for each in edits]), apply_edits([block], edits)[0]


def _dropped(block: Block, words: Sequence[Word]) -> tuple[str, str]:
    texts = join([word.text.strip() for word in words])
    return f"delete {texts}", apply_edits([block], [drop(word) for word in words])[0]


def _as_line(block: Block) -> tuple[str, str]:
    own = next((word for word in block.words if word.address == "G" and word.number in (2, 3)), None)
    if own is not None:
        return _edited(block, [change(own, "G01" if "0" in own.text else "G1")])
    return "add G01", restate(block, "G01").text


def _is_right(text: str, block: Block, before: State, modes: Modes, *, is_line: bool = False) -> bool:
    """Whether a block with another text is an arc with which nothing is wrong; or none, if it is to be a line."""
    read = parse_block(text, block.line, block.syntax)
    arc = arc_of(read, before, modes)
    return is_line and not read.faults if arc is None else not any(faults_of(arc))


def _of_center(arc: PlainArc) -> Iterator[_Mended]:
    """Words with which an arc about a centre would be right."""
    way, spoke = arc.way, arc.spoke
    if way is None or spoke is None:
        return
    square = way[0] * way[0] + way[1] * way[1]
    for at, word in enumerate(arc.centers):
        if word is not None and abs(way[at]) > LENGTH:
            value = (square / 2 - spoke[1 - at] * way[1 - at]) / way[at]
            yield _Mended(((word, value),), abs(value - spoke[at]))
    centers = [(at, word) for at, word in enumerate(arc.centers) if word is not None]
    for signs in ((-1, 1), (1, -1), (-1, -1)):
        turned = [(word, signs[at] * spoke[at]) for at, word in centers]
        yield _slip(arc, turned, (spoke[0] * signs[0], spoke[1] * signs[1]))
    yield from _counted_from(arc, way)
    yield from _from_origin(arc)
    radius = hypot(*spoke)
    for at, word in enumerate(arc.ends):
        rest = radius * radius - (way[1 - at] - spoke[1 - at]) ** 2
        if word is not None and rest >= 0:
            value = min((spoke[at] + sign * sqrt(rest) for sign in (-1, 1)), key=lambda each: abs(each - way[at]))
            yield _Mended(((word, value),), abs(value - way[at]))


def _from_origin(arc: PlainArc) -> Iterator[_Mended]:
    """A centre whose coordinates are written."""
    first, second = (_start_of(arc, at) for at in (0, 1))
    if first is not None and second is not None and not arc.table.counts_from_origin and not arc.center_text:
        yield from _counted_from(arc, (-first, -second))


def _counted_from(arc: PlainArc, place: tuple[float, float]) -> Iterator[_Mended]:
    """A centre that is counted from another place than where the arc begins."""
    spoke, centers = arc.spoke, [each for each in arc.centers if each is not None]
    if spoke is not None and len(centers) == len(spoke):
        counted = spoke[0] + place[0], spoke[1] + place[1]
        yield _slip(arc, [(word, counted[at]) for at, word in enumerate(centers)], counted)


def _slip(arc: PlainArc, words: Sequence[tuple[ArcWord, float]], spoke: tuple[float, float]) -> _Mended:
    """A centre that was written otherwise by a slip: it agrees just so, or it is no such slip."""
    way = arc.way or (0.0, 0.0)
    off = abs(hypot(*spoke) - hypot(way[0] - spoke[0], way[1] - spoke[1]))
    changed = [each for each in words if each[0].value is None or abs(each[0].value - each[1]) > LENGTH]
    is_slip = bool(changed) and arc.table.allows(off, hypot(*spoke)) and hypot(*spoke) > LENGTH
    return _Mended(tuple(changed) if is_slip else (), off, is_slip)


def _start_of(arc: PlainArc, at: int) -> float | None:
    place = arc.here.axes[arc.here.plane.axes[at]]
    return None if place.value is None else float(place.value)


def _of_radius(arc: PlainArc) -> Iterator[_Mended]:
    """Words with which an arc by its radius would be right."""
    way, size = arc.way, arc.size
    if way is None or size is None or arc.radius is None:
        return
    sign, half = (1 if size > 0 else -1), hypot(*way) / 2
    if abs(abs(way[0]) - abs(way[1])) <= arc.table.limit(half):
        # A quarter of a circle from one axis to the other.
        yield _Mended(((arc.radius, sign * abs(way[0])),), 0.0, is_slip=True)
    yield _Mended(((arc.radius, sign * half),), half - abs(size), rounding=AT_LEAST)
    for at, word in enumerate(arc.ends):
        rest = 4 * size * size - way[1 - at] ** 2
        if word is not None and rest >= 0:
            value = min((one * sqrt(rest) for one in (-1, 1)), key=lambda each: abs(each - way[at]))
            yield _Mended(((word, value),), abs(value - way[at]))


def _with_values(arc: PlainArc, mended: _Mended, before: State, modes: Modes) -> Fix | None:
    """The fix that gives words other values; None where they cannot be written so that the arc is right."""
    edits = list[Edit]()
    for own, value in mended.words:
        text = _written(arc, own, value, mended.rounding)
        if text is None:
            return None
        edits.append(change(own.word, text))
    block = arc.block
    edits = [edit for edit in edits if edit.text != edit.old.strip()]
    if not edits:
        return None
    mine = [edit for edit in edits if edit.place == block.line]
    text = apply_edits([block], mine)[0]
    beside = tuple(_beside(arc, [edit for edit in edits if edit.place != block.line]))
    here = before
    for each in beside:
        read = parse_block(each.text, each.span.line, block.syntax)
        here = modes.follow(before, read, modes) if modes.follow is not None else before
    read = parse_block(text, block.line, block.syntax)
    new = arc_of(read, here, modes)
    if new is None or any(faults_of(new)):
        return None
    said = join([edit.among([block]) for edit in edits])
    return Fix(
        said,
        text,
        Applicability.CHANGES_CONTOUR,
        effect=_radius_of(new),
        replaced=block.text,
        beside=beside,
    )


def _beside(arc: PlainArc, edits: Sequence[Edit]) -> Iterator[LineChange]:
    """The change of the line that states the centre."""
    if edits:
        line = edits[0].place
        block = parse_block(arc.center_text, line, arc.block.syntax)
        yield LineChange(Span(line, 1, len(block.text) + 1), apply_edits([block], edits)[0], block.text)


def _radius_of(arc: PlainArc) -> str:
    radius = arc.size if arc.size is not None else hypot(*arc.spoke) if arc.spoke is not None else 0.0
    return f"the arc has a radius of {length_text(abs(radius), arc.here.unit)}"


def _written(arc: PlainArc, own: ArcWord, value: float, rounding: str) -> str | None:
    """A word with a value, spelled as it is; None where that is not known."""
    word, lexicon = own.word, arc.lexicon
    if word.address not in lexicon.addresses or own.base is None:
        return None
    write: Callable[..., str] = write_word
    more = {"rounding": rounding} if rounding else {}
    text = write(word.address, value + own.base, lexicon, arc.here.unit, **more)
    bare = lexicon.spell(word.address, "")
    if word.has_point and "." not in text.removeprefix(bare):
        text += "."
    return with_plus(text, is_like="+" in word.text) if has_plus([arc.block]) else text
