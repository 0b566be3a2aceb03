"""For which control a program is where its words are those of several: whether all that read them read them alike."""

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import zip_longest

from msgspec import Struct
from msgspec.structs import replace as replace_fields

from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import Answer, Depth, coordinates, join, status_text
from contoursolve.diagnostics import Diagnostic
from contoursolve.gcode import Block, Program, telling
from contoursolve.program.called_files import blocks_of_called_files
from contoursolve.program.pipeline import Run
from contoursolve.program.project_file import configure, stated_settings
from contoursolve.program.recognise import (
    CORNERS_WITHOUT_COMMA,
    SeveralControlsError,
    UnknownControlError,
    choose,
    readers_of_arcs,
    turned_with_corners,
    what_shows,
)
from contoursolve.program.request import Request
from contoursolve.reading import ArcIssue, Control, ReadIssue, Taken
from contoursolve.solving import LineSegment, Segment
from contoursolve.tolerance import ERROR_BOUND_WARNING


class _Outcome(Struct, frozen=True):
    """One contour as a control reads it: its lines, its status, the points of its path, and text for a reader."""

    lines: tuple[int | str, ...]
    """Behind the name of the file, if that is not the program's."""
    status: str
    path: tuple[float, ...]
    told: str
    elements: tuple[str, ...] = ()
    """Its lines and arcs as a reader sees them, who may count diameters."""

    def agrees(self, other: "_Outcome | None") -> bool:
        """Whether another control makes the same of it."""
        if other is None or (self.lines, self.status, len(self.path)) != (other.lines, other.status, len(other.path)):
            return False
        return all(abs(one - two) <= ERROR_BOUND_WARNING for one, two in zip(self.path, other.path, strict=True))


class _Reading(Struct, frozen=True):
    """A program as a control reads it: its contours, and the places of words without a comma that are taken for
    corners."""

    outcomes: tuple[_Outcome, ...]
    corners: frozenset[tuple[int, int]]
    findings: frozenset[Hashable]
    """The place, the kind and the severity of each finding, and the first fix of an error, if that was looked for."""
    has_errors: bool
    arcs: frozenset[int] = frozenset()
    """The lines with a finding about an arc."""


def choose_alike(
    control: str | Control | None,
    program: Program,
    asked: Request,
    settings: Mapping[str, str] | None = None,
    recognise_by: Callable[[Iterable[Block]], Control | None] | None = None,
) -> Control | None:
    """The control as `choose` finds it, or else the first of those that have the words of a program and read it alike;
    the others are told by it (`Control.taken`). `asked` says from where and how the program is examined.

    Raises UnknownControlError, which tells what they read differently, and SettingError.
    """
    found, names, several = _choose(control, program, settings, recognise_by)
    if found is None and (
        called := blocks_of_called_files((each.text for each in telling(program.blocks)), asked.around)
    ):
        everything = replace_fields(program, blocks=(*program.blocks, *called))
        found, names, several = _choose(control, everything, settings, recognise_by)
        sign = what_shows(called, found) if found is not None and not what_shows(program.blocks, found) else ""
        if found is not None and sign:
            told = Taken(ReadIssue.CONTROL_CALLED, {"control": found.name, "sign": sign})
            found = replace(found, taken=(*found.taken, told))
    if found is not None:
        return found
    own = stated_settings(block.text for block in program.blocks) | dict(settings or {})
    if not names:
        return _by_arcs(program, asked, own)
    readings = {name: _read(program, configure(CONTROLS[name], own), asked) for name in names}
    readers = [*readings] if several else _taking_corners(readings)
    if not any(each.outcomes for each in readings.values()):
        if several is None:
            return None
        raise several
    first, *others = readers
    for contour in zip_longest(*(readings[name].outcomes for name in readers)):
        if not _is_alike(contour):
            said, made = _differences(dict(zip(readers, contour, strict=True)))
            raise UnknownControlError(said, readers, made)
    own_control = configure(CONTROLS[first], own)
    if not others:
        return own_control
    is_told_alike = len({readings[name].findings for name in readers}) == 1
    if is_told_alike and any(each.has_errors for each in readings.values()):
        full = (_read(program, configure(CONTROLS[name], own), asked, Depth.FULL) for name in readers)
        is_told_alike = len({each.findings for each in full}) == 1
    return _first_of(readers, own_control, is_told_alike=is_told_alike)


def _by_arcs(program: Program, asked: Request, own: Mapping[str, str]) -> Control | None:
    """The first control of those for which a program without a contour may be, where all of them tell something of an
    arc; None where one of them does not."""
    names, common = readers_of_arcs(program), frozenset[int]()
    findings = set[frozenset[Hashable]]()
    for name in names:
        reading = _read(program, configure(CONTROLS[name], own), asked)
        common = common & reading.arcs if findings else reading.arcs
        findings.add(reading.findings)
        if not common:
            return None
    first = configure(CONTROLS[names[0]], own) if names else None
    return first and _first_of(names, first, is_told_alike=len(findings) == 1)


def _first_of(names: Sequence[str], first: Control, *, is_told_alike: bool) -> Control:
    """The first of some controls that cut the same path, with what its reader is told of them."""
    if len(names) == 1:
        return first
    how = "read this program alike" if is_told_alike else "cut the same path, but tell other findings"
    alike = Taken(ReadIssue.CONTROL_ALIKE, {"controls": join(names), "control": first.name, "how": how})
    return replace(first, taken=(*first.taken, alike))


def _choose(
    control: str | Control | None,
    program: Program,
    settings: Mapping[str, str] | None,
    recognise_by: Callable[[Iterable[Block]], Control | None] | None,
) -> tuple[Control | None, tuple[str, ...], SeveralControlsError | None]:
    """The control as `choose` finds it; or else the names of those that may read a program alike, and what it shows of
    several."""
    try:
        found = choose(control, program, settings, recognise_by)
    except SeveralControlsError as error:
        return None, error.choices, error
    return found, turned_with_corners(program.blocks) if found is None else (), None


def _read(program: Program, control: Control, asked: Request, depth: Depth = Depth.VERDICT) -> _Reading:
    """Read a program as a control does; with a depth other than VERDICT, its fixes are looked for, too."""
    own = asked.of(control, lambda: (block.text for block in program.blocks))
    running = Run(program, replace_fields(own, depth=depth))
    result = running.collect()
    found = (*result.answers, *running.called)
    words = (word for answer in found for word in answer.claim.words.values())
    corners = ((word.span.line, word.span.column) for word in words if word.address in CORNERS_WITHOUT_COMMA)
    findings = frozenset(map(_told_of, result.diagnostics))
    arcs = frozenset(each.span.line for each in result.diagnostics if isinstance(each.about, ArcIssue))
    return _Reading(tuple(map(_outcome, found)), frozenset(corners), findings, result.has_errors, arcs)


def _told_of(finding: Diagnostic) -> Hashable:
    """A finding without its control: its place, kind and severity, and the first fix where it is an error."""
    fix = finding.fixes[0].description.partition(" -> ")[0] if finding.fixes and finding.is_error else ""
    # A code of a rule begins with the control's family.
    return finding.span, finding.about or finding.code.partition("-")[2], finding.severity, fix


def _outcome(answer: Answer) -> _Outcome:
    contour, file = answer.contour, answer.claim.blocks[0].file
    lines: tuple[int | str, ...] = (file, *answer.lines) if file else answer.lines
    if contour is None:
        told = next((each.message for each in answer.diagnostics if each.is_error), status_text(answer.status))
        return _Outcome(lines, answer.status.value, (), told)
    places = [at for each in contour.elements for at in (each.start, each.end, getattr(each, "center", each.end))]
    told = f"ends at {coordinates(contour.end, answer.plane, answer.unit)}"
    path = tuple(value for place in (*places, contour.end) for value in place)
    elements = tuple(_element_text(each, answer) for each in contour.elements)
    return _Outcome(lines, answer.status.value, path, told, elements)


def _element_text(element: Segment, answer: Answer) -> str:
    end = coordinates(element.end, answer.plane, answer.unit)
    if isinstance(element, LineSegment):
        return f"a line to {end}"
    return f"an arc to {end} about {coordinates(element.center, answer.plane, answer.unit)}"


def _taking_corners(readings: Mapping[str, _Reading]) -> list[str]:
    """The controls that take every word for a corner that any of them takes; if there is none, all with contours."""
    corners = frozenset[tuple[int, int]]().union(*(each.corners for each in readings.values()))
    having = {name: each for name, each in readings.items() if each.outcomes}
    return [name for name, each in having.items() if each.corners == corners] or [*having]


def _is_alike(contour: Sequence[_Outcome | None]) -> bool:
    first, *others = contour
    return first is not None and all(first.agrees(each) for each in others)


def _differences(contour: Mapping[str, _Outcome | None]) -> tuple[str, list[str]]:
    """That controls read a contour differently, and what each makes of it."""
    groups: list[tuple[_Outcome | None, list[str]]] = []
    for name, each in contour.items():
        own = next((names for one, names in groups if one is each or (one and one.agrees(each))), None)
        if own is None:
            groups.append((each, own := []))
        own.append(name)
    first = min((each.lines for each in contour.values() if each is not None), key=str)
    file, lines = (f" of {first[0]}", first[1:]) if isinstance(first[0], str) else ("", first)
    where = f"program line {lines[0]}" if len(lines) == 1 else f"program lines {lines[0]} to {lines[-1]}"
    where += file
    made = _told_apart([each for each, _ in groups])
    told = [f"{join(names)}: {text}" for text, (_, names) in zip(made, groups, strict=True)]
    return f"the controls read {where} differently", told


def _told_apart(made: Sequence[_Outcome | None]) -> list[str]:
    """Descriptions of a contour as each control reads it, made different by the first line or arc that differs."""
    told = ["no contour there" if each is None else each.told for each in made]
    paths = [each.elements for each in made if each is not None]
    if len({*told}) == len(told) or len(paths) < len(made):
        return told
    apart = next((at for at, each in enumerate(zip_longest(*paths)) if len({*each}) > 1), None)
    if apart is None:
        return told
    begin = f"after {paths[0][apart - 1]}, " if apart else "at first "
    return [f"{begin}{path[apart] if apart < len(path) else 'nothing more'}" for path in paths]
