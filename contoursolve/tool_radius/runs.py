"""Runs of cutting moves beside which a tool goes on one side, by G41 and G42 (RL and RR), or as it is asked for."""

from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import groupby
from math import dist

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison import ROUGHING, Motion, Step, ToolPath, Travel, Unfollowed, in_cycle
from contoursolve.controls import TOOL_FACTS, ToolEffect, ToolFacts
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Length, Plane, Turn, cross
from contoursolve.reading import Control, Effect, rows_of
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment, foot_on
from contoursolve.tolerance import AGREEMENT, LENGTH
from contoursolve.tool_radius.joint import TANGENT, direction, turn_of
from contoursolve.tool_radius.tool import OutsideCorner, Tool, ToolError, ToolSide, tool_of
from contoursolve.tool_radius.tool_settings import settings_of
from contoursolve.tool_radius.words import RadiusWords, WordInForce

SIDES = {side.code: side for side in ToolSide}


def is_compensated(path: ToolPath) -> bool:
    """Whether any of its moves is made under G41 or G42, RL or RR."""
    return any(isinstance(step, Travel) and step.compensation in SIDES for step in path.steps)


class ToolRequest(Struct, frozen=True):
    """A tool as it is asked for: by an option, or in the program and the table of tools; and its side."""

    tool: Tool | None = None
    tip: int | None = None
    side: ToolSide | None = None
    outside: OutsideCorner | None = None
    """The way around an outside corner; without it, as the program or the setting says."""
    table: Mapping[tuple[str, Decimal], Tool] = {}
    """Tools by the address and the number of their T or D word."""
    default: Tool | None = None
    """The tool where none is stated."""


class CuttingRun(Struct, frozen=True):
    """Elements that follow one another in a plane, all on one side of one tool; `radius` is in mm.

    `lead` is the move before, the end of which moves with the tool; `leaving` the one behind, which begins where the
    tool is. `is_stated` tells that the program says the side.
    """

    elements: tuple[Segment, ...]
    travels: tuple[Travel, ...]
    tool: Tool
    radius: float
    side: ToolSide
    plane: Plane
    unit: Length
    levels: tuple[int, ...]
    """As `OffsetPath` has them."""
    lead: Travel | None = None
    leaving: Travel | None = None
    is_stated: bool = True
    broken: int = 0
    """The line that interrupts it, or changes the tool, while G41 or G42 is in force; 0 without one."""
    is_changed: bool = False
    """Whether that is a change of the tool."""
    why: str = ""
    """The reason for which its way is not followed."""
    is_approached: bool = False
    """Whether the lead is a cutting move, of which nothing says that it is none of the contour."""
    still_on: int = 0
    """The line up to which nothing ends G41 or G42 behind it, where another tool or the end comes; 0 without one."""
    void: Word | None = None
    """The D or T word in force that calls no tool, `D0`."""
    outside: OutsideCorner | None = None
    """The way around outside corners that the program says."""
    is_plain: bool = False
    """Whether it is one straight move along an axis, such as a face or a groove, which the tip alone makes."""
    words: tuple[WordInForce, ...] = ()
    """The words in force that change the radius, or compensation."""
    added: tuple[WordInForce, ...] = ()
    """Those of which the number is a part of the radius."""
    lacks_d: bool = False
    """Whether D is missing before it."""

    @property
    def lines(self) -> tuple[int, ...]:
        """The program lines of its elements."""
        return tuple(dict.fromkeys(travel.line for travel in self.travels))

    @property
    def is_lathe(self) -> bool:
        """Whether the programmed point is an imaginary tip."""
        return _is_turned(self.plane, self.tool)

    @property
    def size(self) -> str:
        """The radius as the program would write it, `R0.8`; with its unit where that is another one."""
        return f"R{self.tool.radius.normalize():f}" + " mm" * (self.tool.is_metric and self.unit is not Length.MM)

    @property
    def tip(self) -> Point:
        """From the centre of the tool to the programmed point, in radii; a cutter's point is its centre."""
        return self.tool.vector() if self.is_lathe else (0.0, 0.0)

    @property
    def vector(self) -> Point:
        """The same in mm."""
        first, second = self.tip
        return self.radius * first, self.radius * second


_LEADS = 3
"""Elements that may lead to a closed contour, or away from it."""


def _levels(elements: Sequence[Segment], travels: Sequence[Travel], axes: Sequence[str]) -> Iterator[int]:
    """The number of the pass of each element, from 1, negative for what is no surface: rapids, and what leads to a
    closed contour or away from it. A rapid, and another depth, begin another pass."""

    def depth(place: int) -> object:
        plane = travels[place].plane
        ends = zip(axes, travels[place].end, strict=True)
        return travels[place].motion, [at for axis, at in ends if plane and axis not in plane.axes]

    passes = groupby(range(len(travels)), depth)
    for number, places in enumerate((list(each) for _, each in passes), 1):
        parts, last = [elements[place] for place in places], len(places) - 1
        ends = range(max(last - _LEADS, 0), last + 1)
        firsts = (first for first in range(min(_LEADS, last) + 1) if any(_closes(parts, first, each) for each in ends))
        first = next(firsts, None)
        if first is not None:
            lasts = (each for each in reversed(ends) if each >= first and _closes(parts, first, each, is_end=True))
            last = next(lasts, last)
        for place, own in enumerate(places):
            is_wall = travels[own].motion is Motion.FEED and (first or 0) <= place <= last
            yield number if is_wall else -number


def _closes(parts: Sequence[Segment], first: int, last: int, *, is_end: bool = False) -> bool:
    """Whether a contour that begins with one element comes back there in another one; or its end lies on the first."""
    start, end = parts[first].start, parts[last].end
    if last >= first and dist(start, end) <= AGREEMENT:
        return True
    at, on = (end, parts[first]) if is_end else (start, parts[last])
    return last > first + 1 and dist(at, foot_on(on, at)) <= AGREEMENT


def find_runs(path: ToolPath, asked: ToolRequest, control: Control) -> list[CuttingRun]:
    """The runs of a program. Raises ToolError."""
    stock = _Stock(asked, path.blocks, control)
    texts = {side: control.modes.codes[side.code].text for side in ToolSide}
    for place, code in stock.switches:
        if asked.side and code in {*SIDES} - {asked.side.code}:
            line = path.blocks[place].line
            raise ToolError(
                f"side {asked.side.value} is against {texts[SIDES[code]]} in program line {line}; leave one out"
            )
    is_stated = any(code in SIDES for _, code in stock.switches)
    groups = list(_groups(path, stock, is_stated=is_stated))
    first = next((group.travels[0] for group in groups if group.travels), None)
    if not is_stated and asked.side is None and first is not None:
        where = f"{first.file or 'program'} line {first.line}, {first.text.strip()}"
        raise ToolError(
            f"{where}: nothing says on which side of the contour the tool runs; "
            f"write {' or '.join(texts.values())} before it, or state the side: left or right"
        )
    found = [run for group in groups if (run := _run(group, path.axes, stock, asked.side)) is not None]
    return [stock.left(run, found) for run in found] if is_stated else found


def find_bare(path: ToolPath, asked: ToolRequest, control: Control, found: Sequence[CuttingRun]) -> list[CuttingRun]:
    """The cutting moves that a program with G41 or G42 makes without them, on the side to which the tip points; none of
    a tool that nothing states, and none that lead to contours or away."""
    stock, bare = _Stock(asked, path.blocks, control), list[CuttingRun]()
    around = {id(each) for own in found for each in (own.lead, own.leaving)}
    for group in _groups(path, stock, is_stated=False) if found else ():
        is_lead = any(each is not None and id(each) in around for each in (group.lead, group.leaving))
        group.travels = [each for each in group.travels if id(each) not in around]
        try:
            own = _run(group, path.axes, stock, asked.side or ToolSide.RIGHT)
        except ToolError:
            continue
        # One straight move may lead somewhere; a centre may go anywhere.
        if own is not None and (len(own.elements) > 1 or (own.is_lathe and not is_lead)):
            bare.append(own)
    return bare


def nothing_cut(path: ToolPath) -> ToolError:
    """The error that no cutting move is there for a tool, with the first move that is not followed."""
    moves = [each for each in path.unfollowed if any(not word.startswith("G") for word in each.words)]
    lost = [f"; program line {each.line} is not followed: {each.reason}" for each in moves[:1]]
    rough = next((each.callers[-1] for each in path.blocks if in_cycle(each, ROUGHING)), None)
    if rough is not None:
        told = f"{rough.cycle} in program line {rough.line} is not compensated (assumed), and no G70 cuts its profile"
        lost = [f"; {told}"]
    return ToolError(f"no cutting move goes beside a contour, so that no tool cuts anything{''.join(lost)}")


class _Group(Struct):
    """Moves that may be a run, in the order of the program."""

    travels: list[Travel]
    lead: Travel | None = None
    leaving: Travel | None = None
    side: ToolSide | None = None
    broken: Step | None = None
    """The step that interrupts it while G41 or G42 is in force."""


_ON = frozenset(f"G{code}" for code in SIDES)


def _groups(path: ToolPath, stock: "_Stock", *, is_stated: bool) -> Iterator[_Group]:
    """Moves under G41 or G42, of which the first leads to the contour; or else cutting moves between those that do not
    cut. The first move behind leaves the contour."""
    group, before, broken = _Group([]), None, None
    for step in path.steps:
        if isinstance(step, Travel) and in_cycle(path.blocks[step.number], ROUGHING):
            # What they leave is for the finishing pass.
            continue
        move = step if isinstance(step, Travel) and step.motion in (Motion.RAPID, Motion.FEED) else None
        if move is not None and not _moves(move, path.axes):
            continue
        side = SIDES.get(move.compensation) if move is not None and is_stated else None
        is_known = move is not None and None not in place_of(move, path.axes, at_end=False)
        is_bare = move is not None and move.motion is Motion.FEED and is_known and move.compensation not in SIDES
        is_cut = side is not None if is_stated else is_bare
        if move is not None and is_cut and side is group.side and _continues(before, move, path.axes):
            group.travels.append(move)
            before = move
            continue
        # Where only the side or the plane changes, the tool is at the contour already.
        is_there = is_cut and move is not None and (bool(group.travels) or not is_stated)
        group.leaving = None if is_there else move
        is_lost = isinstance(step, Unfollowed) and not _ON.isdisjoint(step.words)
        is_off = not is_lost and stock.is_off(step.number)
        if isinstance(step, Travel):
            is_off = step.compensation not in SIDES
        if group.side is not None and side is not None and side is not group.side:
            is_off = True
        broken = None if is_off else broken or (step if group.side is not None or is_lost else None)
        group.broken = group.broken or broken
        yield group
        group = _Group([move] if is_there and move else [], None if is_there else move, None, side, broken)
        before = move
    yield group


def _why(broken: Step | None, axes: Sequence[str]) -> str:
    """The reason for which the way behind a step is not followed: behind an offset, the next move begins anywhere."""
    if isinstance(broken, Unfollowed):
        return broken.reason
    is_known = not isinstance(broken, Travel) or None not in place_of(broken, axes, at_end=False)
    return "" if is_known else "where it begins is not known"


def _aside(step: Travel, axes: Sequence[str]) -> float:
    """A coordinate that is none of the end of a move."""
    return min((at for at in place_of(step, axes, at_end=True) if at is not None), default=0.0) - 1.0


def _continues(before: Travel | None, step: Travel, axes: Sequence[str]) -> bool:
    """Whether a move goes on where another one ends, in its plane."""
    if before is None or step.plane is None or before.plane != step.plane:
        return False
    ways = zip(place_of(before, axes, at_end=True), place_of(step, axes, at_end=False), strict=True)
    return all(end is not None and start is not None and abs(end - start) <= AGREEMENT for end, start in ways)


def _moves(step: Travel, axes: Sequence[str]) -> bool:
    """Whether it moves in its plane."""
    if step.plane is None or not {*step.plane.axes} <= {*axes}:
        return False
    ways = zip(place_of(step, axes, at_end=False), place_of(step, axes, at_end=True), strict=True)
    return step.bend is not None or any(
        end is not None and (start is None or abs(end - start) > LENGTH) for start, end in ways
    )


def _run(group: _Group, axes: Sequence[str], stock: "_Stock", side: ToolSide | None) -> CuttingRun | None:
    """The run of a group; None where nothing is cut. Without a stated side, a move that leads at an angle to the first
    contour words is no part of it."""
    travels, lead, leaving, is_approached = group.travels, group.lead, group.leaving, False
    while travels and travels[-1].motion is not Motion.FEED:
        travels, leaving = travels[:-1], travels[-1]
    own = group.side or side
    if not travels or travels[0].plane is None or own is None:
        return None
    plane = travels[0].plane
    # A move that begins anywhere interrupts its run: where it is put does not matter.
    elements = [segment_of(each, axes, _aside(each, axes)) for each in travels]
    first, last = (lead or travels[0]).number, travels[-1].number
    words = stock.words.beside(first, (leaving or travels[-1]).number, group.broken.line if group.broken else 0)
    added = tuple(
        each
        for each in words
        if each.row.effect is ToolEffect.ADDS and each.number is not None and each.first <= first and last <= each.last
    )
    tool = stock.at(travels[0])
    if added:
        more = sum(each.number or 0 for each in added) * (travels[0].unit.in_mm if tool.is_metric else 1)
        tool = replace(tool, radius=tool.radius + more)
    if tool.radius < 0:
        raise ToolError(f"with {added[0].text} in program line {added[0].line}, the radius is R{tool.radius}")
    radius = float(tool.radius) * (1.0 if tool.is_metric else float(travels[0].unit.in_mm))
    first = next((number for number, each in enumerate(travels) if each.element), 0) if group.side is None else 0
    while first and abs(turn_of(elements[first - 1], elements[first])) <= TANGENT:
        first -= 1
    if first:
        lead, is_approached, travels, elements = travels[first - 1], True, travels[first:], elements[first:]
    if tool.tip is None and (any(plane.diameters) or (plane.axes == _TURNED and stock.has_lathe)):
        raise ToolError("a turning tool needs the number of its imaginary tip, 0 to 9; state it, as in R0.8, tip 3")
    if tool.tip is not None and not _is_turned(plane, tool):
        raise ToolError(f"a cutter has no imaginary tip; leave tip {tool.tip} out")
    made = CuttingRun(
        tuple(elements),
        tuple(travels),
        tool,
        radius,
        own,
        plane,
        travels[0].unit,
        tuple(_levels(elements, travels, axes)),
        lead,
        leaving,
        group.side is not None,
        group.broken.line if group.broken else stock.changed(travels),
        group.broken is None,
        _why(group.broken, axes),
        is_approached,
        void=stock.void(travels[0]) if group.side is not None else None,
        outside=stock.outside(travels[0]),
        words=words,
        added=added,
        lacks_d=group.side is not None and stock.lacks_d(travels[0]),
    )
    if made.is_stated or not any(made.tip) or not _is_plain(made.elements):
        return made
    # The tip is clear of it on the one side only.
    against = [own.sign * cross(direction(each, at_end=False), made.tip) > LENGTH for each in made.elements]
    turned = ToolSide.RIGHT if own is ToolSide.LEFT else ToolSide.LEFT
    return replace(made, side=turned if against[0] else own, is_plain=True) if any(against) else made


def _is_plain(elements: Sequence[Segment]) -> bool:
    """Whether elements are one straight move along an axis, perhaps there and back."""
    ways = [direction(each, at_end=False) for each in elements]
    is_straight = not any(isinstance(each, ArcSegment) for each in elements)
    return is_straight and all(min(map(abs, way)) <= LENGTH and abs(cross(way, ways[0])) <= LENGTH for way in ways)


def _is_turned(plane: Plane, tool: Tool) -> bool:
    """Whether a plane is that of a lathe: its X counts diameters, or the tool has a tip where X counts radii."""
    return any(plane.diameters) or (tool.tip is not None and plane.axes == _TURNED)


_TURNED = ("Z", "X")


def place_of(step: Travel, axes: Sequence[str], *, at_end: bool) -> tuple[float | None, float | None]:
    """The place where a move begins or ends in its plane, mm; None for what is not known."""
    place = step.end if at_end else step.start
    first, second = (place[axes.index(axis)] for axis in (step.plane.axes if step.plane else ()))
    return first, second


def segment_of(step: Travel, axes: Sequence[str], unknown: float = 0.0) -> Segment:
    """A move as an element of its plane, where what is `unknown` of its start is this number. The centre of an arc is
    put as far from one end as from the other: words are rounded."""
    (a, b), (c, d) = (place_of(step, axes, at_end=at_end) for at_end in (False, True))
    start, end = (unknown if a is None else a, unknown if b is None else b), (c or 0.0, d or 0.0)
    if step.bend is None:
        return LineSegment("", start, end)
    center, chord = step.bend.center, (end[0] - start[0], end[1] - start[1])
    square = chord[0] ** 2 + chord[1] ** 2
    if square > LENGTH**2:
        middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
        along = ((center[0] - middle[0]) * chord[0] + (center[1] - middle[1]) * chord[1]) / square
        center = center[0] - along * chord[0], center[1] - along * chord[1]
    turn = Turn.CCW if step.bend.sweep > 0 else Turn.CW
    return ArcSegment("", start, end, center, dist(center, start), turn)


class _Stock:
    """The tools that a program states, by the places from which on they are in use, in the blocks as they run."""

    def __init__(self, asked: ToolRequest, blocks: Sequence[Block], control: Control) -> None:
        self.asked, self.blocks, self.settings = asked, blocks, settings_of(control)
        # Such a control turns in its plane Z X, with X as diameter or radius.
        self.has_lathe = control.diameter is not None or control.plane.axes == _TURNED
        self.facts = TOOL_FACTS.get(control.name, ToolFacts())
        self.words, corners = RadiusWords(blocks, self.facts.words), self.facts.corners
        self.corners = [
            (place, OutsideCorner(corners[name]))
            for place, block in enumerate(blocks if corners else ())
            for word in block.words
            if (name := f"{word.address}{word.number}") in corners
        ]
        table, letters, modes = asked.table, {address for address, _ in asked.table}, control.modes
        self.tools: list[tuple[int, Tool | Word]] = []
        self.voids: list[tuple[int, Word | None]] = []
        self.changes, self.ends, self.moved, self.switches = (
            list[int](),
            list[int](),
            list[int](),
            list[tuple[int, int]](),
        )
        # D is another word in some contours.
        addresses = [each for each in "TD" if each not in modes.lexicon.addresses]
        functions = [{word.number for word in block.words if word.address == "M"} for block in blocks]
        has_change, ready, last = any(_CHANGE in each for each in functions), dict[str, Word](), Decimal(-1)
        for place, block in enumerate(blocks):
            called = {
                word.address: word for word in block.words if word.address in addresses and word.number is not None
            }
            # Where M6 changes tools, T makes one ready.
            if has_change and "T" in called:
                ready = {"T": called.pop("T")}
            called |= ready if _CHANGE in functions[place] else {}
            rows = [(word, table.get((word.address, word.number or Decimal(0)))) for word in called.values()]
            stated = tool_of(block) if asked.tool is None else None
            unknown = [word for word, tool in rows if tool is None and word.address in letters and word.number]
            uses = [each for each in (stated, *(tool for _, tool in rows), *unknown) if each is not None]
            self.tools += [(place, each) for each in uses[:1]]
            number = called["D"].number if "D" in called else None
            if "T" in called or any(tool for _, tool in rows) or (number is not None and -1 < last != number):
                self.changes.append(place)
            last = last if number is None else number
            if called:
                self.voids.append((place, next(filter(self._is_void, called.values()), None)))
            codes = rows_of(block, modes)
            if "T" in called or functions[place] & _ENDS or any(code.effect is Effect.SINGLE for code in codes):
                self.ends.append(place)
            elif any(row.axis for word in block.words if (row := modes.lexicon.addresses.get(word.address))):
                self.moved.append(place)
            texts = {code.number: code.text for code in codes if code.effect is Effect.COMPENSATION}
            if len(texts) > 1:
                told = " and ".join(text for _, text in sorted(texts.items()))
                raise ToolError(f"{told} stand together in program line {block.line}; leave one out")
            self.switches += [(place, code) for code in texts]

    def outside(self, step: Travel) -> OutsideCorner | None:
        """The way around outside corners that the program says for a move."""
        return next((way for place, way in reversed(self.corners) if place <= step.number), None)

    def is_off(self, number: int) -> bool:
        """Whether neither G41 nor G42 is in force where a block begins, or where a way home leads."""
        reached = number + (number in self.ends)
        return next((code not in SIDES for place, code in reversed(self.switches) if place < reached), True)

    def changed(self, travels: Sequence[Travel]) -> int:
        """The line of another tool behind the first of some moves and before the last; 0 without one."""
        first, last = (bisect_right(self.changes, each.number) for each in (travels[0], travels[-1]))
        return self.blocks[self.changes[first]].line if first < last else 0

    def left(self, run: CuttingRun, found: Sequence[CuttingRun]) -> CuttingRun:
        """A run that knows where G40 is missing behind it: before another tool, or a way home, or the end, where no
        other run comes first. Where no move comes before G40, a way home interrupts nothing."""
        first, last, never = run.travels[0].number, run.travels[-1].number, len(self.blocks)
        offs = [place for place, code in self.switches if code not in SIDES]
        if any(run.broken < self.blocks[place].line and place <= first for place in offs):
            run = replace(run, broken=0)
        off = next((place for place in offs if place > last), never)
        following = min((other.travels[0].number for other in found if other.travels[0].number > last), default=never)
        end = next((place for place in self.ends if place > last), never - 1)
        line, beyond = self.blocks[end].line, bisect_right(self.moved, end) < bisect_right(self.moved, off - 1)
        if end >= min(off, following) or (run.broken and (run.broken != line or beyond)):
            return run
        return replace(run, broken=0, still_on=line)

    def _is_void(self, word: Word) -> bool:
        """Whether a T or D word calls no offset."""
        is_split = self.facts.splits_t and word.address == "T" and (word.number or 0) >= 100  # noqa: PLR2004 - digits
        return not word.number or (is_split and not word.number % 100)

    def lacks_d(self, step: Travel) -> bool:
        """Whether no D stands before a move, of a control that takes the radius by it."""
        return self.facts.needs_d and not any(block.find("D") for block in self.blocks[: step.number + 1])

    def void(self, step: Travel) -> Word | None:
        """The word in force at a move that calls no tool."""
        return next((word for place, word in reversed(self.voids) if place <= step.number), None)

    def at(self, step: Travel) -> Tool:
        """The tool that makes a move. Raises ToolError."""
        stated = next((tool for place, tool in reversed(self.tools) if place <= step.number), None)
        tool = self.asked.tool or stated or self.asked.default
        if isinstance(tool, Word):
            told = f"{tool.text.strip()} in program line {tool.span.line} has no row in the table of tools"
            raise ToolError(f"{told}; write one below [tools] in contoursolve.toml, or state a tool such as R0.8")
        if tool is None:
            raise ToolError(
                f"nothing says which tool cuts program line {step.line}; state one such as R0.8, or write the comment "
                "(contoursolve tool: R0.8, tip 3) above it"
            )
        tool = tool if self.asked.tip is None else replace(tool, tip=self.asked.tip)
        tool = replace(tool, is_mirrored=self.settings.is_mirrored)
        is_diameter = self.settings.is_diameter and tool.radius is not getattr(self.asked.default, "radius", None)
        return replace(tool, radius=tool.radius / 2) if is_diameter else tool


_CHANGE, _ENDS = 6, {2, 30}
"""M functions that change the tool, and that end a program."""
