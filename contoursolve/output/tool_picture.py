"""A tool beside contours as it is drawn: its path, the tool where that matters, and what it leaves."""

from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise
from math import dist

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import DECIMALS, Answer
from contoursolve.diagnostics import Diagnostic, checked
from contoursolve.geometry import Turn
from contoursolve.output.findings import alike, lines_text
from contoursolve.pictures import (
    Closeup,
    Leader,
    Mark,
    MarkKind,
    Part,
    Role,
    TextRun,
    ToolDrawing,
    Trail,
    Weight,
    number,
    remarks_of,
)
from contoursolve.solving import (
    LEAST,
    ArcSegment,
    LineSegment,
    Point,
    Segment,
    along,
    direction,
    foot_on,
    middle,
    on_arc,
)
from contoursolve.tolerance import LENGTH
from contoursolve.tool_radius import (
    NOTICED,
    CuttingRun,
    OffsetPath,
    ToolFault,
    ToolFaultKind,
    ToolReport,
    ToolRun,
    UncutRest,
    nearest,
    title_of,
    uncompensated,
)

MOST_STANCES, MOST_DEPTHS, MOST_WRONG = 16, 3, 2
"""Places of one run at which the tool is drawn, at which there stands how much stays, and that come out wrong."""

_READABLE = 24.0
"""Pixels of a tool that can be read."""

_HATCHES, _PIECES = 7, 12
"""Lines across what stays in a corner, and straight pieces of an arc of its outline."""


class Stance(Struct, frozen=True):
    """A centre of the tool at an element (its number, from 0), the fault there, and the outline of what the tool leaves
    in the corner, with the tool's own arc last; `depth` is how much that is from the corner to the tool, mm."""

    center: Point
    element: int
    fault: ToolFault | None = None
    rest: tuple[Segment, ...] = ()
    depth: float = 0.0


def parts_beside(report: ToolReport, answer: Answer | None = None) -> tuple[ToolDrawing, ...]:
    """The drawings of a tool beside the contours of a program, in each plane, or beside one of them."""
    lines = answer.lines if answer is not None else ()
    drawn, findings = [], sorted(report.findings, key=lambda finding: not finding.is_error)
    # Beside a whole program, nobody sees which line "this line" is.
    told = findings if lines else [_named(each) for each in alike(findings)]
    for each in report.runs:
        own = [place for place, travel in enumerate(each.run.travels) if answer is None or travel.line in lines]
        if own:
            here = [one for one in told if one.span.line in (lines or each.run.lines)]
            drawn.append(_beside(each, own, tuple(remarks_of(here)), is_whole=answer is None))
    planes = groupby(sorted(drawn, key=lambda one: one.plane.code), key=lambda one: one.plane)
    return tuple(_together([*several]) for _, several in planes)


def _named(found: Sequence[Diagnostic]) -> Diagnostic:
    """The first of findings in the same words, which names the lines of all."""
    lines = lines_text([each.span.line for each in found])
    return replace(found[0], message=f"{lines}: {found[0].message}")


@checked
def tool_text(report: ToolReport, line: int) -> str:
    """The sentence about which tool cuts the contour on a line; empty where no tool goes."""
    each = next((each for each in report.runs if line in each.run.lines), None)
    if each is None:
        return ""
    kind, fits = "nose" if each.run.is_lathe else "cutter", "fits" if each.path is not None else "does not fit"
    most = each.largest_radius
    typed = f"{each.typed_radius(DECIMALS[each.run.unit.value]).normalize():f}"
    told = f"a {kind} up to R{typed} cuts all of it" if most is not None else f"every {kind} does"
    told = told if most is None or most >= LEAST else f"no {kind} does"
    return f"{each.title}: it {fits}; {told}"


def _together(several: Sequence[ToolDrawing]) -> ToolDrawing:
    """The drawing in one plane."""
    meanings: dict[Role, str] = {}
    for role, text in (item for each in several for item in each.meanings.items()):
        told = meanings.get(role, text)
        meanings[role] = told if text in told else f"{told}; {text}"
    joined = {
        # Passes at several depths lie on each other.
        name: tuple(dict.fromkeys(part for each in several for part in getattr(each, name)))
        for name in ("parts", "cut", "remarks", "closeups")
    }
    return replace(
        several[0], title="; ".join(dict.fromkeys(each.title for each in several)), meanings=meanings, **joined
    )


def _beside(
    each: ToolRun, own: Sequence[int], remarks: tuple[tuple[TextRun, ...], ...], *, is_whole: bool
) -> ToolDrawing:
    run, title = each.run, each.title
    cut = tuple(run.elements[place] for place in own if is_whole and not run.travels[place].element)
    path = tuple(each.written(piece) for piece in each.pieces if piece.element in own)
    beside = each.uncompensated if is_whole else ()
    trails = ((cut, Role.INK, Weight.MAIN), (path, Role.TRACK, Weight.BESIDE), (beside, Role.GHOST, Weight.BESIDE))
    stances = [stance for stance in _stances(each) if stance.element in own][:MOST_STANCES]
    parts: list[Part] = [Trail(*row) for row in trails if row[0]]
    parts += [part for place, stance in enumerate(stances) for part in _parts(each, stance, is_first=not place)]
    parts += _depths(each, stances)
    meanings = {Role.TRACK: f"path of the {'tip' if run.is_lathe else 'centre'}", Role.TOOL: title}
    meanings |= {Role.GHOST: f"comes out without G{run.side.code}"} if beside else {}
    meanings |= {Role.CONFLICTING: "cannot be cut, or the tool does not fit"} if each.faults else {}
    closeups = []
    for place, stance in enumerate(stances):
        name = f"program line {run.travels[stance.element].line}" if place or stance.fault or stance.rest else "start"
        closeups.append(Closeup(name, (_circle(each, stance), *stance.rest), _READABLE))
    told = title_of(each) if path else f"{title}: it does not fit"
    return ToolDrawing(run.plane, run.unit, told, tuple(parts), cut, remarks, meanings, tuple(closeups))


def _circle(each: ToolRun, stance: Stance) -> ArcSegment:
    begin = along(stance.center, (1.0, 0.0), each.run.radius)
    return ArcSegment("", begin, begin, stance.center, each.run.radius, Turn.CCW)


def _parts(each: ToolRun, stance: Stance, *, is_first: bool) -> Iterator[Part]:
    """The tool as a circle, with the imaginary tip of a lathe, and what it leaves, hatched."""
    run, fault, (x, y) = each.run, stance.fault, stance.center
    role = Role.CONFLICTING if fault is not None else Role.TOOL
    hatches = tuple(_hatches(stance.rest))
    if hatches:
        yield Trail(hatches, Role.REST, Weight.BESIDE)
    if run.radius > LENGTH:
        yield Trail((_circle(each, stance),), role, Weight.BESIDE)
    if run.is_lathe:
        label = (TextRun(f"tip {run.tool.tip}", role),) if is_first else ()
        yield Mark((x + run.vector[0], y + run.vector[1]), MarkKind.TIP, label, role=role)
    if fault is not None:
        text = fault.kind.name.replace("_", " ").lower() + (f": {_length(each, fault.short)}" if fault.short else "")
        yield Leader(stance.center, direction(run.elements[stance.element].end, stance.center), text, role)


def _depths(each: ToolRun, stances: Sequence[Stance]) -> Iterator[Leader]:
    """The rest that stays in the corners in which most does."""
    deepest: dict[str, Stance] = {}
    for stance in sorted(stances, key=lambda one: -round(one.depth, 6)):
        if stance.rest and stance.fault is None:
            deepest.setdefault(f"{_length(each, stance.depth)} stays", stance)
    for text, stance in list(deepest.items())[:MOST_DEPTHS]:
        corner = each.run.elements[stance.element].end
        yield Leader(corner, direction(stance.center, corner), text, Role.REST)


def _length(each: ToolRun, mm: float) -> str:
    return f"{number(mm, each.run.unit)} {each.run.unit.value}"


# Where the tool stands ----------------------------------------------------------------------------------------


def _stances(each: ToolRun) -> Iterator[Stance]:
    """The places that matter: where the tool does not fit; else where it begins, in inside corners, and where most
    comes out wrong."""
    own, pieces = each.run, each.offset.pieces or ()
    faults = [fault for fault in each.faults if fault.kind is not ToolFaultKind.LEFT_OUT]
    yield from (_at_fault(each, fault) for fault in faults)
    if pieces and not faults:
        yield Stance(pieces[0].segment.start, 0)
    yield from (_resting(own, rest) for rest in each.offset.rests(pieces) if rest.depth >= NOTICED)
    wrong = list(uncompensated(own.elements, own.side.sign, own.radius, own.tip)) if each.uncompensated else []
    for fault in sorted(wrong, key=lambda one: -round(abs(one.short or 0.0), 6))[:MOST_WRONG]:
        yield Stance(_at_fault(each, fault).center, fault.element)


def _at_fault(each: ToolRun, fault: ToolFault) -> Stance:
    """Between the neighbours of an element that is too small, beside the others."""
    own, place, side = each.run, fault.element, each.run.side.sign
    at, way = middle(own.elements[place])
    if fault.kind in (ToolFaultKind.ARC_TOO_SMALL, ToolFaultKind.ELEMENT_VANISHES):
        for rest in each.offset.rests(each.offset.shortcut or ()):
            if rest.first < place < rest.last:
                return replace(_resting(own, rest), element=place, fault=fault)
    if fault.kind is ToolFaultKind.INTERFERENCE and fault.working is not None:
        beside = OffsetPath([own.elements[fault.working]], own.radius, side).pieces
        if beside:
            return Stance(nearest(own.elements[place], beside[0].segment)[1], place, fault)
    return Stance(along(at, (-way[1] * side, way[0] * side), own.radius), place, fault)


def _resting(own: CuttingRun, rest: UncutRest) -> Stance:
    """The place at which a tool leaves something."""
    near = own.elements[rest.first : rest.last + 1]
    return Stance(rest.center, rest.first, None, _outline(own.side.sign, near, rest.center), rest.depth)


def _outline(side: int, near: Sequence[Segment], center: Point) -> tuple[Segment, ...]:
    """The outline of what a tool leaves that touches the first and the last of some elements."""
    first, last = foot_on(near[0], center), foot_on(near[-1], center)
    parts = (replace(near[0], start=first), *near[1:-1], replace(near[-1], end=last))
    nose = ArcSegment("", last, first, center, dist(center, first), Turn.CW if side > 0 else Turn.CCW)
    return (*(each for each in parts if dist(each.start, each.end) > LENGTH), nose)


def _hatches(outline: Sequence[Segment]) -> Iterator[LineSegment]:
    """Lines at 45 degrees across an outline, as many whatever its size."""
    if not outline:
        return
    places: list[Point] = []
    for part in outline:
        pieces = _PIECES if isinstance(part, ArcSegment) else 1
        places += [on_arc(part, n / pieces)[0] if isinstance(part, ArcSegment) else part.start for n in range(pieces)]
    levels = [y - x for x, y in places]
    low, high = min(levels), max(levels)
    for place in range(_HATCHES if high - low > LENGTH else 0):
        level, met = low + (high - low) * (place + 0.5) / _HATCHES, list[Point]()
        for (a, one), (b, two) in pairwise([*zip(places, levels, strict=True), (places[0], levels[0])]):
            if (one > level) is not (two > level):
                share = (level - one) / (two - one)
                met.append((a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])))
        met.sort()
        yield from (LineSegment("", *ends) for ends in zip(met[::2], met[1::2], strict=False))
