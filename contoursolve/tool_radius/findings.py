"""Findings about a tool that does not fit a contour: what is too small for it, by how much, and what would fit."""

from collections import Counter
from collections.abc import Iterator, Sequence
from decimal import ROUND_CEILING, Decimal
from functools import cached_property
from math import dist

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison import ToolPath, follow
from contoursolve.controls import TOOL_FACTS, ToolEffect, ToolFacts
from contoursolve.diagnosis import (
    DECIMALS,
    Context,
    angle_text,
    apply_edits,
    change,
    coordinates,
    inward,
    join,
    length_in,
    limit_text,
    move_without_point,
    rank,
    write_word,
)
from contoursolve.diagnostics import (
    Applicability,
    Basis,
    Diagnostic,
    Evidence,
    Fix,
    Label,
    Severity,
    Span,
    from_above,
    hash_of,
)
from contoursolve.gcode import Block, Word, parse, spelled
from contoursolve.geometry import dot
from contoursolve.program import Request, Result, run
from contoursolve.reading import Control
from contoursolve.solving import LEAST, ArcSegment, Contour, LineSegment, Segment, along, minus, shifted, typed_limit
from contoursolve.tolerance import AGREEMENT, LARGEST, LENGTH
from contoursolve.tool_radius.by_hand import is_around, made_for, part_of, within
from contoursolve.tool_radius.clearance import gaps_below
from contoursolve.tool_radius.faults import ToolFault, ToolFaultKind
from contoursolve.tool_radius.joint import direction
from contoursolve.tool_radius.offset import (
    FittingRadii,
    OffsetElement,
    OffsetPath,
    RunsCrossing,
    are_walls,
    fitting_radii,
    flank_faults,
    stub,
    tip_faults,
    told_of_path,
    uncompensated,
    without_short,
)
from contoursolve.tool_radius.runs import (
    SIDES,
    CuttingRun,
    ToolRequest,
    find_bare,
    find_runs,
    nothing_cut,
    place_of,
    segment_of,
)
from contoursolve.tool_radius.tool import OutsideCorner, ToolError, ToolSide
from contoursolve.tool_radius.tool_settings import ToolSettings, settings_of
from contoursolve.tool_radius.words import WordInForce


class ToolRun(Struct, frozen=True, dict=True):
    """A run with the path of the tool's centre and all faults, those of the geometry first."""

    run: CuttingRun
    offset: OffsetPath
    rules: "ToolRules"
    stops: tuple[ToolFault, ...]

    __hash__ = hash_of
    """Its faults without what would fit."""

    @cached_property
    def faults(self) -> tuple[ToolFault, ...]:
        """All faults, those of the geometry first."""
        return *self.offset.faults, *self.stops[len(self.offset.stops) :]

    @cached_property
    def part(self) -> Contour:
        """The contour as it is programmed."""
        return _contour(self.run, [each.element for each in self.run.travels], self.run.elements)

    @cached_property
    def path(self) -> Contour | None:
        """The path of the programmed point: the imaginary tip, or the centre; None where the tool does not fit."""
        if not self.pieces:
            return None
        names = [self.run.travels[each.element].element if each.is_own else "around" for each in self.pieces]
        return _contour(self.run, names, [self.written(each) for each in self.pieces])

    @cached_property
    def pieces(self) -> tuple[OffsetElement, ...]:
        """The path of the centre as it is written: from where the move to the contour ends, to where the setting says,
        without moves that are too short; empty where there is none."""
        if not self.offset.pieces or any(self.rules.is_error(each.kind) for each in self.stops):
            return ()
        own, settings, found = self.run, self.offset.settings, list(self.offset.pieces)
        if (entry := self.rules.entry_of(own)) is not None:
            first = entry.pieces[-1].segment.start if entry.pieces else found[0].segment.start
            found[0] = replace(found[0], segment=replace(found[0].segment, start=first))
            found[:0] = [replace(each, element=0) for each in (entry.pieces or ())[1:-1]]
        last = found[-1].segment
        if settings.ends_at_tip and isinstance(last, LineSegment):
            way = direction(last, at_end=True)
            past = dot(own.vector, way)
            if 0 < past < last.length:
                found[-1] = replace(found[-1], segment=replace(last, end=along(last.end, way, -past)))
        return tuple(without_short(found))

    def written(self, piece: OffsetElement) -> Segment:
        """A piece of the centre's path as that of the programmed point."""
        return shifted(piece.segment, self.run.vector)

    @property
    def title(self) -> str:
        """The tool, and its side."""
        own = self.run
        kind = f"nose {own.size}, tip {own.tool.tip}" if own.is_lathe else f"cutter {own.size}"
        return f"{kind}, {own.side.value} of the contour"

    def typed_radius(self, decimals: int) -> Decimal:
        """The largest radius as it is typed in the unit of the program, 0 where no tool fits."""
        scale, largest = float(self.run.unit.in_mm), self.largest_radius or 0.0
        return typed_limit(0.0, largest / scale, decimals, lambda size: not self.rules.stops(self.run, size * scale))

    @cached_property
    def largest_radius(self) -> float | None:
        """The largest radius (mm) up to which each tool cuts all of it (tried); None where every tool does."""
        fit = min((each.largest for each in self.faults if each.largest is not None), default=LARGEST)
        found = self.rules.fitting(self.run, fit)
        if not found or found[0].low:
            return 0.0
        return found[0].high if found[0].high < LARGEST else None

    @cached_property
    def uncompensated(self) -> tuple[Segment, ...]:
        """The part that comes out where the programmed point itself runs along the contour, the outline of its way;
        empty where it is not simple, and where the program states compensation."""
        return () if self.run.is_stated else part_of(self.run, self.run.radius, OutsideCorner.ROLL)


def _contour(own: CuttingRun, names: Sequence[str], segments: Sequence[Segment]) -> Contour:
    """Segments as one contour; a plain move has the name of its kind."""
    named = tuple(
        replace(each, name=name or ("arc" if isinstance(each, ArcSegment) else "straight"))
        for name, each in zip(names, segments, strict=True)
    )
    return Contour(named[0].start, named[-1].end, {}, named, own.plane)


class ToolRules(Struct, frozen=True):
    """The ground on which runs are looked at: the axes of their places, the way around outside corners, and the facts
    about the control."""

    axes: tuple[str, ...]
    outside: OutsideCorner | None
    facts: ToolFacts
    settings: ToolSettings

    __hash__ = hash_of

    def at(self, own: CuttingRun) -> ToolRun:
        """A run with the path of its tool, and all faults."""
        outside = self.outside or own.outside or self.settings.outside
        settings = replace(self.settings, outside=outside)
        made = OffsetPath(own.elements, own.radius, own.side.sign, settings, own.levels)
        told = ToolFaultKind.LEFT_OUT, ToolFaultKind.INSIDE_CORNER if self.settings.refuses_corner else None
        is_asked = settings.leaves or settings.refuses_corner
        rests = (each for each in (told_of_path(made) if is_asked else ()) if each.kind in told)
        return ToolRun(own, made, self, (*made.stops, *self._around(own), *self._through(own, made), *rests))

    def stops(self, own: CuttingRun, radius: float) -> list[ToolFault]:
        """The faults that keep a tool of a radius (mm) from a run."""
        strict = replace(self, settings=replace(self.settings, leaves=False))
        found = strict.at(with_radius(own, radius)).stops
        return [each for each in found if self.is_error(each.kind)]

    def fitting(self, own: CuttingRun, most: float) -> list[FittingRadii]:
        """All radii (mm) up to one with which nothing keeps a tool from a run."""
        return fitting_radii(lambda radius: self.stops(own, radius), self.crossing(own), most)

    def crossing(self, own: CuttingRun) -> RunsCrossing | None:
        """The places where the run-in and the run-off of a run cross."""
        return OffsetPath(own.elements, 0.0, own.side.sign, self.settings, own.levels).crossing

    def entry_of(self, own: CuttingRun) -> OffsetPath | None:
        """The path beside the move to a contour and its first element, where the setting has that as an element."""
        lead = own.lead if self.settings.is_entry_offset and own.is_stated else None
        if lead is None or lead.bend is not None or None in place_of(lead, self.axes, at_end=False):
            return None
        return OffsetPath((segment_of(lead, self.axes), own.elements[0]), own.radius, own.side.sign, self.settings)

    def _through(self, own: CuttingRun, made: OffsetPath) -> Iterator[ToolFault]:
        """The moves to a contour and away on which the centre of the tool goes through it, at the same depth."""
        pieces, beside = made.pieces or (), [self.axes.index(axis) for axis in self.axes if axis not in own.plane.axes]
        first, last = own.travels[0], own.travels[-1]
        ways = (ToolFaultKind.ENTRY_THROUGH, own.lead, 0, first), (ToolFaultKind.EXIT_THROUGH, own.leaving, -1, last)
        is_told = pieces and own.is_stated and not own.broken and not self.settings.is_entry_offset
        for kind, move, end, there in ways if is_told else ():
            at = place_of(move, self.axes, at_end=bool(end)) if move is not None and move.bend is None else (None, None)
            if move is None or at[0] is None or at[1] is None or (end and move.compensation in SIDES):
                continue
            if any(len({move.start[axis], move.end[axis], there.end[axis]}) > 1 for axis in beside):
                continue
            center, piece = minus((at[0], at[1]), own.vector), pieces[end].segment
            way = LineSegment("", center, piece.end if end else piece.start)
            numbers = [*made.walls]
            met = {numbers[gap.wall]: gap.at for gap in gaps_below([way], [*made.walls.values()], AGREEMENT)}
            # A contour may begin or end in the air.
            ends = {made.elements[0].start, made.elements[-1].end}
            inner = [number for number, at in met.items() if min(dist(at, each) for each in ends) > AGREEMENT]
            if inner or len(met) > 1:
                element = len(own.elements) - 1 if end else 0
                yield ToolFault(kind, element, working=min(inner or met))

    def is_error(self, kind: ToolFaultKind) -> bool:
        """Whether a fault leaves no path."""
        refused = {ToolFaultKind.ENTRY_TOO_SHORT: self.facts.needs_entry}
        refused[ToolFaultKind.INSIDE_CORNER] = self.settings.refuses_corner
        return refused.get(kind, False) or kind.value.severity is Severity.ERROR

    def _around(self, each: CuttingRun) -> Iterator[ToolFault]:
        """The faults of the moves to a contour and away, of what interrupts it, and of the tip and the flanks."""
        lead, leaving, last = each.lead if each.is_stated else None, each.leaving, len(each.elements) - 1
        if lead is not None and lead.bend is not None:
            yield ToolFault(ToolFaultKind.ENTRY_BY_ARC, 0)
        if leaving is not None and each.is_stated and leaving.bend is not None:
            yield ToolFault(ToolFaultKind.EXIT_BY_ARC, last)
        if lead is not None and lead.bend is None:
            (a, b), (c, d) = (place_of(lead, self.axes, at_end=at_end) for at_end in (False, True))
            length = dist((a, b), (c or 0.0, d or 0.0)) if a is not None and b is not None else each.radius + 1
            if length <= each.radius - LENGTH or (self.facts.needs_entry and length <= each.radius):
                yield ToolFault(ToolFaultKind.ENTRY_TOO_SHORT, 0, each.radius - length, length=length)
        if (entry := self.entry_of(each)) is not None:
            yield from (replace(fault, element=0) for fault in entry.stops)
        yield from (fault for fault in _of_words(each, self.axes) if self.is_error(fault.kind))
        is_told = any(word.line == each.broken for word in each.words)
        if each.broken and each.is_stated and not is_told:
            yield ToolFault(ToolFaultKind.OTHER_TOOL if each.is_changed else ToolFaultKind.INTERRUPTED, 0)
        if each.void is not None and each.radius > LENGTH:
            yield ToolFault(ToolFaultKind.NO_OFFSET, 0)
        if any(each.vector):
            silent = self.settings.is_tip_silent
            own = [] if silent else [*tip_faults(each.elements, each.side.sign, each.radius, each.tip)]
            own += flank_faults(each.elements, each.side.sign, each.tool)
            # A rapid is no surface.
            yield from (fault for fault in own if each.levels[fault.element] > 0)


def _of_words(own: CuttingRun, axes: Sequence[str]) -> Iterator[ToolFault]:
    """The faults of the words in force that change the radius, or compensation."""
    for number, each in enumerate(own.words):
        kind, is_told = ToolFaultKind.NOT_FOLLOWED, True
        match each.row.effect:
            case ToolEffect.ADDS:
                kind, is_told = ToolFaultKind.RADIUS_ADDED if each in own.added else kind, each.number != 0
            case ToolEffect.STATES:
                kind, stated = ToolFaultKind.RADIUS_STATED, sum(word.number or 0 for word in (each, *own.added))
                is_told = abs(float(stated) * float(own.unit.in_mm) - own.radius) > LENGTH
            case ToolEffect.TURNS:
                is_told = any(own.vector)
            case ToolEffect.BEHIND:
                is_told = _is_behind(own, axes)
        yield from [ToolFault(kind, 0, working=number)] * is_told


def _is_behind(own: CuttingRun, axes: Sequence[str]) -> bool:
    """Whether the way to a contour begins behind its first element, or the way away ends behind the last; or nobody
    knows that."""
    first, last = own.elements[0], own.elements[-1]
    for move, element, (c, d), at_end in ((own.lead, first, first.start, False), (own.leaving, last, last.end, True)):
        a, b = place_of(move, axes, at_end=at_end) if move is not None else (c, d)
        along, across = direction(element, at_end=at_end)
        if a is None or b is None or own.side.sign * ((b - d) * along - (a - c) * across) < -LENGTH:
            return True
    return False


def with_radius(own: CuttingRun, radius: float) -> CuttingRun:
    """A run with a tool of a radius, mm."""
    shown = Decimal(repr(round(radius / float(own.unit.in_mm), 9)))
    return replace(own, radius=radius, tool=replace(own.tool, radius=shown, is_metric=False))


class ToolReport(Struct, frozen=True):
    """The runs of a program beside which a tool goes, and the findings about them.

    Attributes:
        runs: the runs of cutting moves, each with the path of the tool (mm) and its faults.
        findings: what the tool cannot cut, or leaves.
        path: the path of the program; the runs are parts of it.
    """

    runs: tuple[ToolRun, ...]
    findings: tuple[Diagnostic, ...]
    path: ToolPath

    __hash__ = hash_of

    def text(self, line: int) -> str:
        """The sentence about which tool cuts the contour on a program line; empty where no tool goes."""
        return str(from_above("tool_text", self, line))


def look_at_tool(result: Result, asked: Request, wanted: ToolRequest, axes: tuple[str, ...] = ()) -> ToolReport:
    """The runs of a solved program with the paths of the tool, and what it cannot cut; places of its path are in these
    axes, or in those of its control. Raises ToolError."""
    control, path, rules, runs = runs_beside(result, asked, wanted, axes)
    if not runs and all(answer.contour is not None for answer in result.answers):
        raise nothing_cut(path)
    told, made = ToolFindings(result, control, asked, wanted), tuple(map(rules.at, runs))
    found = [each for number, tool_run in enumerate(made) for each in told.of(tool_run, is_first=not number)]
    found += [each for tool_run in made for each in told.of_points(tool_run.run) if each not in result.diagnostics]
    for own in find_bare(path, wanted, control, runs) if runs and runs[0].is_stated else ():
        found += told.of_bare(own if own.is_lathe else replace(own, side=runs[0].side), rules)
    return ToolReport(made, tuple(sorted(_once(found), key=rank)), path)


def _once(found: Sequence[Diagnostic]) -> Iterator[Diagnostic]:
    """Findings without those that tell the same of a block that runs again."""
    passes = Counter((each.code, each.span, each.message) for each in found)
    for each in found:
        count = passes.pop((each.code, each.span, each.message), 0)
        if count:
            yield replace(each, notes=(*each.notes, f"the same in {count} passes") if count > 1 else each.notes)


def runs_beside(
    result: Result, asked: Request, wanted: ToolRequest, axes: tuple[str, ...] = ()
) -> tuple[Control, ToolPath, ToolRules, list[CuttingRun]]:
    """The control of a solved program, its path, the ground on which its runs are looked at, and the runs. Raises
    ToolError."""
    if (control := asked.control) is None:
        raise ToolError("no block shows the control, which says how moves are read; say which with --control")
    path = follow(result, control, asked.unit, axes or control.modes.axes, finishes=True).with_places()
    rules = ToolRules(path.axes, wanted.outside, TOOL_FACTS.get(control.name, ToolFacts()), settings_of(control))
    return control, path, rules, find_runs(path, wanted, control)


def _crossing(made: OffsetPath) -> list[ToolFault]:
    """The place where the run-in and the run-off cross, if one of them is cut short there."""
    if (found := made.crossing) is None or [*made.walls.items()] == [*enumerate(made.elements)]:
        return []
    return [ToolFault(ToolFaultKind.RUNS_CROSS, found.coming[0], working=found.going[0], at=found.at)]


class ToolFindings:
    """Faults as findings about the lines and words of one program."""

    def __init__(self, result: Result, control: Control, asked: Request, wanted: ToolRequest) -> None:
        self.result, self.control, self.asked, self.wanted = result, control, asked, wanted
        self.facts = TOOL_FACTS.get(control.name, ToolFacts())
        self.broken, self.said = set[int](), set[tuple[ToolFaultKind, WordInForce | None]]()
        self.blocks = {block.line: block for block in result.program.blocks}

    def of(self, tool_run: ToolRun, *, is_first: bool) -> Iterator[Diagnostic]:
        """The findings about one run."""
        own = tool_run.run
        told = [ToolFault(ToolFaultKind.APPROACH, 0)] if own.is_approached else []
        told += [ToolFault(ToolFaultKind.SWITCHED, 0)] if own.lead is None and not is_first else []
        told += [] if own.is_stated else self._uncompensated(own)
        told += [fault for fault in _of_words(own, tool_run.rules.axes) if not tool_run.rules.is_error(fault.kind)]
        told += [ToolFault(ToolFaultKind.NO_D, 0)] if own.lacks_d else []
        told += [ToolFault(ToolFaultKind.NO_RADIUS, 0)] if own.radius <= LENGTH else []
        told += _crossing(tool_run.offset)
        told += [ToolFault(ToolFaultKind.STILL_ON, len(own.elements) - 1)] if own.still_on else []
        # What interrupts one run stands before the next one; of a contour without a solution, its own finding tells.
        self.broken |= {line for each in self.result.answers if each.contour is None for line in each.lines}
        faults = [each for each in tool_run.faults if each.kind not in _BREAKS or own.broken not in self.broken]
        self.broken.add(own.broken)
        rests = [each for each in told_of_path(tool_run.offset) if each not in tool_run.stops]
        if own.is_plain or any(each.kind is ToolFaultKind.BY_HAND for each in told):
            # The path of a tool is no contour that one has to fit; nor is what the tip alone makes.
            faults, rests = [], []
        told = [each for each in (*told, *faults) if (each.kind, self._word_of(own, each)) not in self.said]
        self.said |= {(each.kind, word) for each in told if (word := self._word_of(own, each))}
        yield from (self._finding(tool_run, fault) for fault in (*told, *rests))

    def of_points(self, own: CuttingRun) -> Iterator[Diagnostic]:
        """The coordinates without a decimal point that count least increments, where others of its moves have one."""
        moves = [each for each in (own.lead, *own.travels, own.leaving) if each and not each.element and not each.file]
        blocks = {each.line: self.blocks[each.line] for each in moves if each.line in self.blocks}
        lexicon, shapes = self.control.modes.lexicon, {*own.plane.centers, self.control.modes.radius}
        rows = lexicon.addresses
        words = {
            line: [
                word for word in block.words if (row := rows.get(word.address)) and (row.axis or word.address in shapes)
            ]
            for line, block in blocks.items()
        }
        if any(word.has_point for each in words.values() for word in each):
            for line, block in blocks.items():
                context = Context(self.asked.rules, own.unit, place=block.span)
                yield from move_without_point(context, words[line], lexicon, own.unit)

    def of_bare(self, own: CuttingRun, rules: ToolRules) -> Iterator[Diagnostic]:
        """The findings about moves that a program with compensation makes without it."""
        faults = [ToolFault(ToolFaultKind.NOT_JUDGED, 0, working=len(own.elements) - 1)] * (own.radius > LENGTH)
        if any(own.tip):
            # The tip tells which side is meant: on the other one, all would be wrong.
            sides = [replace(own, side=side) for side in ([own.side] if self.wanted.side else ToolSide)]
            rows = [(each, [*self._uncompensated(each, is_bare=True)]) for each in sides]
            own, faults = min(rows, key=lambda row: (sum(abs(each.short or 0.0) for each in row[1]), row[0].side.value))
        made = OffsetPath(own.elements, own.radius, own.side.sign, rules.settings, own.levels)
        yield from (self._finding(ToolRun(own, made, rules, ()), each) for each in faults)

    def _uncompensated(self, own: CuttingRun, *, is_bare: bool = False) -> Iterator[ToolFault]:
        """The error of each element where the programmed point runs along a contour, or along another tool's path.
        Where nobody names the side, or the tip alone makes it, a line along an axis has none."""
        found = made_for(own)
        if found is None:
            for each in uncompensated(own.elements, own.side.sign, own.radius, own.tip):
                is_plain = any(own.tip) and min(map(abs, direction(own.elements[each.element], at_end=False))) <= LENGTH
                if not (is_bare or own.is_plain) or not is_plain or isinstance(own.elements[each.element], ArcSegment):
                    yield each
            yield from stub(own.elements, own.side.sign, own.radius, own.tip)
            return
        made, begin, end = found
        around = [number for number, each in enumerate(own.elements) if is_around(each, made, own)]
        yield ToolFault(ToolFaultKind.BY_HAND, around[0], length=made, rest=(begin, end))
        for each in uncompensated(own.elements, own.side.sign, own.radius - made, own.tip):
            if each.element not in around and begin <= each.element < end:
                yield replace(each, kind=ToolFaultKind.OTHER_RADIUS, length=made)

    def _finding(self, tool_run: ToolRun, fault: ToolFault) -> Diagnostic:
        own, row = tool_run.run, fault.kind.value
        travel = own.travels[fault.element]
        is_entry, is_exit = fault.kind in _ENTRIES, fault.kind in _EXITS
        leaving = own.leaving if not own.still_on or (own.leaving and own.leaving.line < own.still_on) else None
        shown = own.lead if is_entry and own.lead else leaving if is_exit and leaving else travel
        is_small = fault.kind is ToolFaultKind.ARC_TOO_SMALL
        word = self.word(own, fault) if is_small else own.void if fault.kind is ToolFaultKind.NO_OFFSET else None
        line = own.broken if fault.kind in _BREAKS else shown.called_at or shown.line
        said = self._word_of(own, fault)
        line = said.line if said is not None else line
        block = self.blocks.get(line)
        span = word.span if word is not None else block.span if block is not None else Span(line, 1, 2)
        texts, values = self.texts(own, fault), {"off_by_mm": fault.short} if fault.short is not None else {}
        return Diagnostic(
            fault.kind.code,
            Severity.ERROR if tool_run.rules.is_error(fault.kind) else row.severity,
            Basis.NUMERICAL,
            span,
            row.message.format(**texts)
            + (f" (program line {shown.line} of {shown.file})" if shown.called_at == line else ""),
            fault.kind.source,
            (Label(span, ""),),
            (word.address,) if word is not None else (),
            self.facts.alarms.get(fault.kind.name.lower()),
            values if fault.largest is None else {**values, "limit": fault.largest, "actual": own.radius},
            tuple(self._notes(tool_run, fault)),
            _ELSEWHERE if _is_at_start(own, fault) else _BACK if _fits_none(fault) else row.help.format(**texts),
            tuple(self._fixes(own, fault, word)) if is_small and word else (),
            fault.kind,
        )

    def _word_of(self, own: CuttingRun, fault: ToolFault) -> WordInForce | None:
        """The word in force that a fault is about."""
        return own.words[fault.working or 0] if fault.kind in _OF_WORDS else None

    def texts(self, own: CuttingRun, fault: ToolFault) -> dict[str, str]:
        """The numbers and names of a message."""
        element, unit, short = own.elements[fault.element], own.unit, fault.short or 0.0
        back, on = (length_in(each, unit) for each in fault.rest)
        # Of a word, its number stands in the place of an element.
        working = 0 if fault.kind in _OF_WORDS else fault.working or 0
        name, last = "arc" if isinstance(element, ArcSegment) else "straight", working or fault.element
        said, codes = self._word_of(own, fault), {f"G{n}": self.control.modes.codes[n].text for n in (40, 41, 42)}
        lines = " to ".join(str(own.travels[number].line) for number in (fault.element, last))
        return {
            "tool": f"{_kind(own)} {own.size}",
            "kind": _kind(own),
            "broken": str(own.broken),
            "why": f" ({own.why})" if own.why else "",
            "still_on": str(own.still_on),
            "lines": " to ".join(dict.fromkeys([str(own.lines[0]), str(own.lines[-1])])),
            "cancel": self.control.modes.codes[40].text,
            "void": own.void.text.strip() if own.void else "",
            "word": said.text if said else "",
            "at": str(said.line) if said else "",
            "meaning": f"{said.row.meaning} ({said.row.evidence.value})" if said else "",
            "instead": said.row.help.format(**codes) if said else "",
            "offset": _offset_for(own.void) if own.void else "",
            "grade": (self.facts.no_offset if own.void and own.void.address == "D" else Evidence.ASSUMED).value,
            "left": f"this {name}" if last == fault.element else f"what program lines {lines} make",
            "made": length_in(fault.length, unit),
            "element": name,
            "radius": length_in(getattr(element, "radius", 0.0), unit),
            "short": length_in(short, unit),
            "length": length_in(fault.length, unit),
            "needs": length_in(fault.length + short, unit),
            "cross": coordinates(fault.at, own.plane, unit) if fault.at is not None else "",
            "wall": str(own.travels[fault.element].line),
            "line": str(own.travels[working].line),
            "begin": str(own.lines[0]),
            "tip": str(own.tool.tip),
            "side": own.side.value,
            "code": self.control.modes.codes[own.side.code].text,
            "needed": angle_text(fault.rest[0]),
            "stated": angle_text(fault.rest[1]),
            "rest": f"{back} and {on} along its sides",
            "times": f"{fault.rest[0]:.1f}",
            "beside": f", {back} before it and {on} after it" * any(each > LENGTH for each in fault.rest),
            "comes_out": self._comes_out(own, element, short),
        }

    def _comes_out(self, own: CuttingRun, element: Segment, off: float) -> str:
        """The sentence about what an element becomes without compensation."""
        unit, much = own.unit, f"{length_in(abs(off), own.unit)} too {'thick' if off > 0 else 'deep'}"
        if not any(own.vector):
            return f"contour comes out {much}"
        if isinstance(element, ArcSegment):
            radius = element.radius + own.side.sign * element.turn.sign * own.radius
            left = f"radius {length_in(radius, unit)}" if radius > LENGTH else "a square corner"
            return f"arc of radius {length_in(element.radius, unit)} comes out {much}: it becomes {left}"
        across, onward = map(abs, direction(element, at_end=False))
        ways = ((across, 2 * off, "on the diameter"), (onward, off, "along Z"))
        told = (f", {length_in(abs(size / part), unit)} {where}" for part, size, where in ways if part > LENGTH)
        return f"straight comes out {much}{''.join(told)}"

    def _notes(self, tool_run: ToolRun, fault: ToolFault) -> Iterator[str]:
        """Notes about what fits, and where."""
        own = tool_run.run
        kind, unit = _kind(own), own.unit
        if _fits_none(fault):
            yield f"no {kind} fits here"
        elif fault.largest is not None:
            whole = tool_run.largest_radius or 0.0
            decimals = DECIMALS[unit.value] + 1
            here, typed = Decimal(repr(round(fault.largest / float(unit.in_mm), 10))), tool_run.typed_radius(decimals)
            here = typed if fault.largest == whole else inward(here, decimals, 1)
            fits, all_ = (limit_text(each, unit.value) for each in (here, typed))
            where = "the whole contour (tried)" if fault.largest == whole else "this place"
            more = f"; {all_} the whole contour (tried)" if whole >= LEAST and fault.largest != whole else ""
            yield f"a {kind} of radius up to {fits} cuts {where}{more}"
        if fault.kind is ToolFaultKind.UNCOMPENSATED and not any(own.vector):
            yield f"as the path of the centre of this {kind} it is right"
        if fault.kind is ToolFaultKind.BY_HAND:
            begin, end = map(int, fault.rest)
            places = [each.end for each in part_of(within(own, begin, end), fault.length)][:_MOST_PLACES]
            yield f"the part goes through {join([coordinates(at, own.plane, unit) for at in places])}"
        if fault.kind is ToolFaultKind.TIP_AGAINST_SIDE:
            yield f"the nose would lie {length_in(fault.short or 0.0, unit)} deep"
        if fault.kind is ToolFaultKind.ARC_TOO_SMALL:
            yield f"the smallest inside radius that this {kind} makes is {length_in(own.radius, unit)}"
        if fault.kind is ToolFaultKind.ELEMENT_VANISHES and 0 < fault.element < len(own.elements) - 1:
            before, after = own.elements[fault.element - 1], own.elements[fault.element + 1]
            if are_walls(before, after, own.side.sign):
                wide, needs = length_in(fault.length, unit), length_in(2 * own.radius, unit)
                yield f"the groove is {wide} wide; this {kind} needs {needs}"
        if fault.kind is ToolFaultKind.INTERFERENCE and fault.at is not None:
            yield f"it cuts at {coordinates(fault.at, own.plane, unit)}"
            if self.facts.notice:
                apart = abs(fault.element - (fault.working or 0))
                yield f"{self.facts.notice}: it {'finds this' if apart <= self.facts.ahead else 'does not find this'}"

    def word(self, own: CuttingRun, fault: ToolFault) -> Word | None:
        """The word that states the radius of an arc: that of a corner, or R."""
        travel = own.travels[fault.element]
        for answer in self.result.answers if not travel.file else ():
            if travel.element and travel.line in answer.lines:
                sizes = {corner.name: corner.size for corner in answer.profile.figure.corners}
                given = answer.profile.givens.get(sizes.get(travel.element, ""))
                return given.word if given is not None else None
        block = self.blocks.get(travel.line) if not travel.file else None
        return block.find(self.control.modes.radius) if block is not None and not travel.element else None

    def _fixes(self, own: CuttingRun, fault: ToolFault, word: Word) -> Iterator[Fix]:
        """The radius of the tool in the place of a smaller one, if the tool then cuts the contour."""
        block, lexicon = self.blocks[word.span.line], self.control.modes.lexicon
        if not own.travels[fault.element].element or word.address not in lexicon.addresses:
            return
        new = write_word(word.address, own.radius, lexicon, own.unit, ROUND_CEILING)
        (text,) = apply_edits([block], [change(word, new)])
        if self._mends(block, text, own):
            told = f"write {new} for {word.text.strip()}"
            effect = f"changes the contour; the {_kind(own)} cuts it"
            yield Fix(told, text, Applicability.CHANGES_CONTOUR, effect, replaced=block.text)

    def _mends(self, block: Block, text: str, own: CuttingRun) -> bool:
        """Whether a contour can be cut with a block in another text, and brings no new error."""
        lines = [text if each.line == block.line else each.text for each in self.result.program.blocks]
        program = spelled(parse("\n".join(lines), self.result.program.name), self.control.modes.syntax)
        tried = run(program, self.asked)
        if sum(each.is_error for each in tried.diagnostics) > sum(each.is_error for each in self.result.diagnostics):
            return False
        _, _, rules, runs = runs_beside(tried, self.asked, self.wanted)
        return all(not rules.at(each).offset.faults for each in runs if {*each.lines} & {*own.lines})


_MOST_PLACES = 6
"""Places of a part that a note names."""

_OF_WORDS = (ToolFaultKind.NOT_FOLLOWED, ToolFaultKind.RADIUS_STATED, ToolFaultKind.RADIUS_ADDED)

_BREAKS = (ToolFaultKind.INTERRUPTED, ToolFaultKind.OTHER_TOOL)

_EXITS = (ToolFaultKind.EXIT_BY_ARC, ToolFaultKind.STILL_ON, ToolFaultKind.EXIT_THROUGH)

_ENTRIES = (
    ToolFaultKind.ENTRY_THROUGH,
    ToolFaultKind.ENTRY_BY_ARC,
    ToolFaultKind.ENTRY_TOO_SHORT,
    ToolFaultKind.APPROACH,
)


_ELSEWHERE = "begin the contour in the middle of an element, not in an inside corner"


_BACK = "check whether the contour goes back on itself: the direction of an arc (G02 or G03), or an end"


def _fits_none(fault: ToolFault) -> bool:
    """Whether no tool fits at its place."""
    return fault.largest is not None and fault.largest < LEAST


def _is_at_start(own: CuttingRun, fault: ToolFault) -> bool:
    """Whether a tool cuts into the last element of a closed contour while it begins with the first, or the reverse."""
    if fault.kind is not ToolFaultKind.INTERFERENCE or fault.working is None:
        return False
    first, last = sorted((fault.element, fault.working))
    return dist(own.elements[first].start, own.elements[last].end) <= AGREEMENT


def _offset_for(void: Word) -> str:
    """The word that calls an offset in the place of one that calls none."""
    turret = int(void.number or 0) // 100
    return f"T{turret:02}{turret:02}" if turret else "the number of the tool"


def _kind(own: CuttingRun) -> str:
    return "nose" if own.is_lathe else "cutter"
