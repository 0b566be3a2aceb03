"""Findings about a tool that does not fit a contour: what is too small for it, by how much, and what would fit."""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from math import dist

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison import follow
from contoursolve.controls import TOOL_FACTS, ToolFacts
from contoursolve.diagnosis import coordinates, length_in, rank, written
from contoursolve.diagnostics import OWN, Applicability, Basis, Diagnostic, Evidence, Fix, Label, Severity, Source, Span
from contoursolve.gcode import Block, Word, parse, spelled
from contoursolve.program import Request, Result, run
from contoursolve.reading import Dialect
from contoursolve.solving import ArcSegment, Contour, LineSegment, Segment
from contoursolve.tolerance import LENGTH
from contoursolve.tool_radius.joint import direction
from contoursolve.tool_radius.offset import Fault, FaultKind, Offset, Piece, excess, tip_faults
from contoursolve.tool_radius.runs import Run, ToolRequest, find_runs, place_of

_NOTICED = 0.005
"""mm. A smaller error is not told (assumed)."""

_SOURCE = Source(OWN, "geometry of the tool's radius", Evidence.DERIVED)


class ToolRun(Struct, frozen=True, dict=True):
    """A run with the path of the tool's centre and all faults, those of the geometry first."""

    run: Run
    offset: Offset
    faults: tuple[Fault, ...]

    @cached_property
    def part(self) -> Contour:
        """The contour as it is programmed."""
        return _contour(self.run, [each.element for each in self.run.travels], self.run.elements)

    @cached_property
    def path(self) -> Contour | None:
        """The path of the programmed point: the imaginary tip, or the centre; None where the tool does not fit."""
        if self.offset.pieces is None or not self.offset.pieces:
            return None
        names = [self.run.travels[each.element].element if each.is_own else "around" for each in self.offset.pieces]
        return _contour(self.run, names, [self.written(each) for each in self.offset.pieces])

    def written(self, piece: Piece) -> Segment:
        """A piece of the centre's path as that of the programmed point."""
        (first, second), segment = self.run.vector, piece.segment
        places = {name: getattr(segment, name) for name in ("start", "end", "center") if hasattr(segment, name)}
        return replace(segment, **{name: (at[0] + first, at[1] + second) for name, at in places.items()})


def _contour(own: Run, names: Sequence[str], segments: Sequence[Segment]) -> Contour:
    """Segments as one contour; a plain move has the name of its kind."""
    named = tuple(
        replace(each, name=name or ("arc" if isinstance(each, ArcSegment) else "line"))
        for name, each in zip(names, segments, strict=True)
    )
    return Contour(named[0].start, named[-1].end, {}, named, own.plane)


class ToolReport(Struct, frozen=True):
    """The runs of a program beside which a tool goes, and the findings about them."""

    runs: tuple[ToolRun, ...]
    findings: tuple[Diagnostic, ...]
    axes: tuple[str, ...]
    """Those of the control, in the order of the places of moves."""


class _Row(Struct, frozen=True):
    """A kind of fault in words: its code, what is wrong, what to do."""

    code: str
    message: str
    help: str
    severity: Severity = Severity.ERROR


_ROWS: Mapping[FaultKind, _Row] = {
    FaultKind.ARC_TOO_SMALL: _Row(
        "tool-arc-too-small",
        "the inside arc of radius {radius} is {short} too small for the {tool}",
        "take a smaller tool or a larger radius",
    ),
    FaultKind.ELEMENT_VANISHES: _Row(
        "tool-element-vanishes",
        "the {element} is {length} long, the {tool} needs {needs} between its corners: {short} short",
        "take a smaller tool or make it longer",
    ),
    FaultKind.NO_INTERSECTION: _Row(
        "tool-no-intersection",
        "the {tool} does not reach the corner at the end of this {element}",
        "take a smaller tool",
    ),
    FaultKind.INTERFERENCE: _Row(
        "tool-interference",
        "the {tool} cuts {short} into program line {wall} while it works on program line {line}",
        "take a smaller tool or make the gap wider",
    ),
    FaultKind.NOT_VERIFIED: _Row(
        "tool-not-verified", "the path of the tool misses this {element} by {short}: it is not used", "report it"
    ),
    FaultKind.ENTRY_BY_ARC: _Row(
        "tool-entry-by-arc", "compensation begins in an arc", "write G41 or G42 in a straight move before it"
    ),
    FaultKind.EXIT_BY_ARC: _Row(
        "tool-exit-by-arc", "compensation ends in an arc", "write G40 in a straight move behind it"
    ),
    FaultKind.ENTRY_TOO_SHORT: _Row(
        "tool-entry-too-short",
        "the move to the contour is {length} long, {short} shorter than the radius of the {tool}",
        "begin farther away",
        Severity.WARNING,
    ),
    FaultKind.TIP_AGAINST_SIDE: _Row(
        "tool-tip-against-side",
        "tip {tip} points away from this {element}, with the tool {side} of it: the nose would lie {short} deep",
        "check the number of the tip, and G41 or G42",
        Severity.WARNING,
    ),
}


def look_at_tool(result: Result, dialect: Dialect, asked: Request, wanted: ToolRequest) -> ToolReport:
    """The runs of a solved program with the paths of the tool, and what it cannot cut. Raises ToolError."""
    runs = _tool_runs(result, dialect, asked, wanted)
    told = _Findings(result, dialect, asked, wanted)
    found = [each for tool_run in runs for each in told.of(tool_run)]
    return ToolReport(tuple(runs), tuple(sorted(found, key=rank)), dialect.modes.axes)


def _tool_runs(result: Result, dialect: Dialect, asked: Request, wanted: ToolRequest) -> list[ToolRun]:
    path = follow(result, dialect, asked.unit, dialect.modes.axes)
    facts = TOOL_FACTS.get(dialect.name, ToolFacts())
    return [_with_faults(each, path.axes, wanted, facts) for each in find_runs(path, wanted, result.program.blocks)]


def _with_faults(each: Run, axes: tuple[str, ...], wanted: ToolRequest, facts: ToolFacts) -> ToolRun:
    made = Offset(each.elements, each.radius, each.side.sign, wanted.outside, each.is_wall)
    faults, lead, leaving = list(made.faults), each.lead if each.is_stated else None, each.leaving
    if lead is not None and lead.bend is not None:
        faults.append(Fault(FaultKind.ENTRY_BY_ARC, 0))
    if leaving is not None and each.is_stated and leaving.bend is not None:
        faults.append(Fault(FaultKind.EXIT_BY_ARC, len(each.elements) - 1))
    if lead is not None and lead.bend is None:
        (a, b), (c, d) = (place_of(lead, axes, at_end=at_end) for at_end in (False, True))
        length = dist((a, b), (c or 0.0, d or 0.0)) if a is not None and b is not None else each.radius + 1
        if length <= each.radius - LENGTH or (facts.needs_entry and length <= each.radius):
            faults.append(Fault(FaultKind.ENTRY_TOO_SHORT, 0, each.radius - length, length=length))
    if any(each.vector):
        faults += tip_faults(each.elements, each.side.sign, each.radius, each.tool.vector())
    return ToolRun(each, made, tuple(faults))


class _Findings:
    """Faults as findings about the lines and words of one program."""

    def __init__(self, result: Result, dialect: Dialect, asked: Request, wanted: ToolRequest) -> None:
        self.result, self.dialect, self.asked, self.wanted = result, dialect, asked, wanted
        self.facts = TOOL_FACTS.get(dialect.name, ToolFacts())
        self.blocks = {block.line: block for block in result.program.blocks}

    def of(self, tool_run: ToolRun) -> Iterator[Diagnostic]:
        """The findings about one run."""
        own = tool_run.run
        if own.is_approached and own.lead is not None:
            yield self._approach(own, own.lead.line)
        for fault in tool_run.faults:
            yield self._finding(own, fault)
        if not own.is_stated:
            yield from self._uncompensated(own)
        for element, travel, joint in zip(own.elements, own.travels, tool_run.offset.joints, strict=False):
            rest = dist(joint.meeting.center, element.end) - own.radius if joint.meeting is not None else 0.0
            if joint.meeting is not None and rest >= _NOTICED and tool_run.offset.pieces is not None:
                sides = " and ".join(length_in(each, own.unit) for each in (joint.meeting.back, joint.meeting.ahead))
                told = f"the inside corner behind this block keeps the radius of the {_kind(own)}"
                message = f"{told}: {length_in(rest, own.unit)} stays in it, {sides} along its sides"
                yield self._told("inside-corner", message, travel.line, rest, Severity.INFO)

    def _uncompensated(self, own: Run) -> Iterator[Diagnostic]:
        """What comes out where the program runs as it is, without compensation."""
        tip, unit = own.tool.vector() if own.is_lathe else (0.0, 0.0), own.unit
        errors = [excess(element, own.side.sign, own.radius, tip) for element in own.elements]
        for element, travel, off in zip(own.elements, own.travels, errors, strict=True):
            if abs(off) < _NOTICED:
                continue
            subject, more = self._result(own, element, off) if any(tip) else ("contour", "")
            much = f"{length_in(abs(off), unit)} too {'thick' if off > 0 else 'deep'}"
            message = f"without G{own.side.code} this {subject} comes out {much}{more}"
            yield self._told("uncompensated", message, travel.line, off)
            if not any(tip):
                return

    def _result(self, own: Run, element: Segment, off: float) -> tuple[str, str]:
        """An element of a turned part, and what it becomes without compensation."""
        if isinstance(element, ArcSegment):
            radius = element.radius + own.side.sign * element.turn.sign * own.radius
            left = f"radius {length_in(radius, own.unit)}" if radius > LENGTH else "a square corner"
            return f"arc of radius {length_in(element.radius, own.unit)}", f": it becomes {left}"
        across, along = map(abs, direction(element, at_end=False))
        ways = (
            (2 / across, "on the diameter") if across > LENGTH else None,
            (1 / along, "along Z") if along > LENGTH else None,
        )
        return "line", "".join(f", {length_in(abs(off) * way[0], own.unit)} {way[1]}" for way in ways if way)

    def _told(
        self, name: str, message: str, line: int, off: float, severity: Severity = Severity.WARNING
    ) -> Diagnostic:
        span = self._span(line)
        told = "write the compensation, or the path of the tool: contoursolve expand --tool"
        told = told if severity is Severity.WARNING else "a smaller tool leaves less"
        labels, values = (Label(span, ""),), {"off_by_mm": off}
        kind = (f"tool-{name}", severity, Basis.NUMERICAL, span, message, _SOURCE)
        return Diagnostic(*kind, labels, values=values, help=told)

    def _approach(self, own: Run, line: int) -> Diagnostic:
        span = self.blocks[line].span
        return Diagnostic(
            "tool-approach",
            Severity.INFO,
            Basis.RULE,
            span,
            f"this block is taken to lead to the contour, which begins with program line {own.lines[0]}",
            Source(OWN, "where a contour begins without G41 and G42", Evidence.ASSUMED),
            (Label(span, ""),),
            help=f"write G{own.side.code} into the block before it if it cuts the part",
        )

    def _finding(self, own: Run, fault: Fault) -> Diagnostic:
        row, unit, travel = _ROWS[fault.kind], own.unit, own.travels[fault.element]
        is_entry, is_exit = fault.kind in _ENTRIES, fault.kind is FaultKind.EXIT_BY_ARC
        shown = own.lead if is_entry and own.lead else own.leaving if is_exit and own.leaving else travel
        word = self._word(own, fault) if fault.kind is FaultKind.ARC_TOO_SMALL else None
        span = word.span if word is not None else self._span(shown.line)
        element, short = own.elements[fault.element], fault.short or 0.0
        texts = {
            "tool": f"{_kind(own)} R{own.tool.radius}",
            "element": "arc" if isinstance(element, ArcSegment) else "line",
            "radius": length_in(getattr(element, "radius", 0.0), unit),
            "short": length_in(short, unit),
            "length": length_in(fault.length, unit),
            "needs": length_in(fault.length + short, unit),
            "wall": str(travel.line),
            "line": str(own.travels[fault.working].line) if fault.working is not None else "",
            "tip": str(own.tool.tip),
            "side": own.side.value,
        }
        is_error = row.severity is Severity.ERROR or (is_entry and self.facts.needs_entry)
        values = {"off_by_mm": fault.short} if fault.short is not None else {}
        finding = Diagnostic(
            row.code,
            Severity.ERROR if is_error else row.severity,
            Basis.NUMERICAL,
            span,
            row.message.format(**texts),
            _SOURCE,
            (Label(span, ""),),
            (word.address,) if word is not None else (),
            self.facts.alarms.get(fault.kind.value),
            values if fault.largest is None else {**values, "limit": fault.largest, "actual": own.radius},
            tuple(self._notes(own, fault)),
            row.help,
        )
        return replace(finding, fixes=tuple(self._fixes(own, fault, word))) if word is not None else finding

    def _notes(self, own: Run, fault: Fault) -> Iterator[str]:
        """What fits, and where."""
        kind, unit = _kind(own), own.unit
        if fault.largest is not None and fault.largest > LENGTH:
            tried = Offset(own.elements, fault.largest, own.side.sign, self.wanted.outside, own.is_wall)
            fits = written(fault.largest / float(unit.in_mm), unit.value, 1)
            whole = "the whole contour (tried)" if not tried.faults else "this place"
            yield f"a {kind} of radius up to {fits} cuts {whole}"
        if fault.kind is FaultKind.ARC_TOO_SMALL:
            yield f"the smallest inside radius that this {kind} makes is {length_in(own.radius, unit)}"
        if fault.kind is FaultKind.ELEMENT_VANISHES and 0 < fault.element < len(own.elements) - 1:
            before, after = own.elements[fault.element - 1], own.elements[fault.element + 1]
            if _are_walls(before, after):
                wide, needs = length_in(fault.length, unit), length_in(2 * own.radius, unit)
                yield f"the groove is {wide} wide; this {kind} needs {needs}"
        if fault.kind is FaultKind.INTERFERENCE and fault.at is not None:
            yield f"it cuts at {coordinates(fault.at, own.plane, unit)}"
            if self.facts.notice:
                yield self.facts.notice

    def _span(self, line: int) -> Span:
        block = self.blocks.get(line)
        return block.span if block is not None else Span(line, 1, 2)

    def _word(self, own: Run, fault: Fault) -> Word | None:
        """The word that states the radius of an arc: that of a corner, or R."""
        travel = own.travels[fault.element]
        for answer in self.result.answers:
            if travel.element and travel.line in answer.lines:
                sizes = {corner.name: corner.size for corner in answer.profile.figure.corners}
                given = answer.profile.givens.get(sizes.get(travel.element, ""))
                return given.word if given is not None else None
        block = self.blocks.get(travel.line)
        return block.find(self.dialect.modes.radius) if block is not None and not travel.element else None

    def _fixes(self, own: Run, fault: Fault, word: Word) -> Iterator[Fix]:
        """The radius of the tool in the place of a smaller one, if the tool then cuts the contour."""
        block = self.blocks[word.span.line]
        if own.tool.is_metric or word.number is None or not own.travels[fault.element].element:
            return
        number = f"{own.tool.radius.normalize():f}"
        new = word.text.strip().removesuffix(_number_in(word.text)) + (number if "." in number else number + ".")
        text = block.text[: word.span.column - 1] + new + block.text[word.span.end_column - 1 :]
        if self._mends(block, text, own):
            effect = f"changes the contour; the {_kind(own)} cuts it"
            yield Fix(
                f"write {new} for {word.text.strip()}", text, Applicability.CHANGES_CONTOUR, effect, replaced=block.text
            )

    def _mends(self, block: Block, text: str, own: Run) -> bool:
        """Whether a contour can be cut with a block in another text, and brings no new error."""
        lines = [text if each.line == block.line else each.text for each in self.result.program.blocks]
        program = spelled(parse("\n".join(lines), self.result.program.name), self.dialect.modes.syntax)
        tried = run(program, self.asked)
        if sum(each.is_error for each in tried.diagnostics) > sum(each.is_error for each in self.result.diagnostics):
            return False
        runs = _tool_runs(tried, self.dialect, self.asked, self.wanted)
        return all(not each.offset.faults for each in runs if {*each.run.lines} & {*own.lines})


_ENTRIES = (FaultKind.ENTRY_BY_ARC, FaultKind.ENTRY_TOO_SHORT)


def _kind(own: Run) -> str:
    return "nose" if own.is_lathe else "cutter"


def _number_in(text: str) -> str:
    """The digits at the end of a word."""
    stripped = text.strip()
    return stripped[len(stripped.rstrip("0123456789.+-")) :]


def _are_walls(before: Segment, after: Segment) -> bool:
    """Whether two lines are the parallel walls of a groove."""
    if not (isinstance(before, LineSegment) and isinstance(after, LineSegment)):
        return False
    (a, b), (c, d) = direction(before, at_end=True), direction(after, at_end=False)
    return a * c + b * d < LENGTH - 1
