"""A contour in the words of a control: the wordings that its rules allow, read back and proven, the best first."""

from collections.abc import Iterator, Mapping, Sequence
from heapq import heappop, heappush
from itertools import count

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison import Motion, ToolPath, Travel, bend_of, compare, follow
from contoursolve.diagnosis import Answer, Depth
from contoursolve.gcode import comment_out, parse, parse_block
from contoursolve.geometry import Length
from contoursolve.postprocess.drawn_contour import DrawnContour, draw, with_roundings
from contoursolve.postprocess.post_processors import MachineKind, machine_of
from contoursolve.postprocess.wordings import Rest, Wording, Wordings, WrittenBlock, WrittenWord
from contoursolve.program import Request, for_kind, run
from contoursolve.reading import Dialect, Diameter, State, advance
from contoursolve.solving import ArcSegment, Segment

MOST_CANDIDATES = 8
"""Candidates that are listed."""

MOST_READ = 60
"""Candidates that are read back."""

SAME = 1e-6
"""mm. A contour whose words are exact is read back to within this."""

_UNITS_OFF = 2
"""A contour with rounded words is read back to within so many units of the last decimal of its control."""

Cost = tuple[int, int, int, int, int]
"""Computed numbers, words, blocks, increments, and numbers that are not the drawing's own."""

_NOTHING: Cost = (0, 0, 0, 0, 0)


class Candidate(Struct, frozen=True):
    """One way to say the contour: its blocks, and a whole small program with them.

    It was read back as the control reads it, without a finding, and is the same contour to within `deviation` mm.
    """

    blocks: tuple[WrittenBlock, ...]
    lines: tuple[str, ...]
    """The blocks as they stand in the program."""
    program: str
    deviation: float
    cost: Cost
    written_out: tuple[str, ...] = ()
    """The corners that the control has no word for, which are blocks of their own."""
    is_plain: bool = False
    """Whether all its blocks are lines and arcs by their ends."""

    def words(self, rest: Rest) -> tuple[WrittenWord, ...]:
        """The words whose numbers rest on something."""
        return tuple(word for block in self.blocks for word in block.words if word.rest is rest)


class Written(Struct, frozen=True):
    """A contour in the words of a control: the candidates, the best first. `reason` says what the control has no words
    for, or why it cannot make the contour at all."""

    control: str
    title: str
    candidates: tuple[Candidate, ...]
    reason: str = ""
    read_back: int = 0
    """The number of candidates that were read back."""


def write_contour(answer: Answer, target: Dialect, *, most: int = MOST_CANDIDATES) -> Written:
    """The wordings of a solved contour for a control. Raises ValueError if it has no path."""
    drawn = draw(answer)
    kind = MachineKind.LATHE if {*drawn.plane.axes} == {"X", "Z"} else MachineKind.MILL
    target = for_kind(target, {}, kind.value)
    if machine_of(target) is not kind:
        made = {MachineKind.LATHE: "turned", MachineKind.MILL: "milled"}[kind]
        return Written(
            target.name, target.title, (), f"the contour is {made}, and {target.name} is a {machine_of(target).value}"
        )
    rounded = with_roundings(drawn)
    searches = [_Search(drawn, target), *([_Search(rounded, target)] if rounded != drawn else [])]
    found, read, tried = list[Candidate](), 0, set[str]()
    while len(found) < most and read < MOST_READ:
        ahead = [each for each in searches if each.ahead(tried) is not None]
        if not ahead:
            break
        best = min(ahead, key=_Search.order)
        read += 1
        candidate = best.take(tried)
        found += [candidate] if candidate else []
    if not any(each.is_plain for each in found):
        candidate = _Search(drawn, target, is_plain=True).take(tried)
        read += 1
        found += [candidate] if candidate else []
    found.sort(key=lambda each: (each.cost, each.lines))
    return Written(target.name, target.title, tuple(found), _reason(target, found), read)


def _reason(target: Dialect, found: Sequence[Candidate]) -> str:
    if not found:
        return f"{target.name} accepts no blocks for this contour, not even plain ones"
    best = found[0]
    if best.is_plain and best.cost[0]:
        return f"{target.name} has no words for this contour: it is written as plain lines and arcs"
    if best.written_out:
        return f"{target.name} has no word for {' and '.join(best.written_out)}: a block of its own makes it"
    return ""


def _needed(wordings: Iterator[Wording]) -> list[Wording]:
    """Wordings without those that say more words than another one of the same elements."""
    said = {each: frozenset(word.text for block in each.blocks for word in block.words) for each in wordings}
    codes = {each: tuple(block.code for block in each.blocks) for each in said}
    return [
        each
        for each, texts in said.items()
        if not any(codes[each] == codes[other] and own < texts for other, own in said.items())
    ]


class _Node(Struct, frozen=True):
    """A place on the way through the elements: the next one, whether it begins behind a cut corner, and the motion in
    force."""

    index: int
    is_cut: bool
    motion: int | None


class _Choice(Struct, frozen=True):
    """A wording at its place."""

    node: _Node
    wording: Wording


class _Search:
    """The wordings of a whole contour, those first that cost less."""

    def __init__(self, drawn: DrawnContour, target: Dialect, *, is_plain: bool = False) -> None:
        self.drawn, self.target, self.is_plain = drawn, target, is_plain
        self.opening = opening_of(target, drawn)
        state = target.initial_state(drawn.unit)
        for line in self.opening:
            state = advance(state, parse_block(line, 1, target.modes.syntax), target.modes)
        self.wordings = Wordings(drawn, target, replace(state, plane=state.plane))
        self.banned = set[tuple[int, bool, Wording]]()
        self.options = dict[tuple[int, bool], list[Wording]]()
        self.motions = {0, 1, 2, 3}
        self.next: tuple[Cost, tuple[str, ...], tuple[_Choice, ...]] | None = None
        self.found = self._in_order()

    def order(self) -> tuple[Cost, tuple[str, ...]]:
        """The place of the next wording among those of all searches."""
        return (self.next[0], self.next[1]) if self.next else (_NOTHING, ())

    def ahead(self, tried: set[str]) -> tuple[str, ...] | None:
        """The lines of the next wording that has not been tried; None if there is none."""
        while self.next is None or "\n".join(self.next[1]) in tried:
            self.next = next(self.found, None)
            if self.next is None:
                return None
        return self.next[1]

    def take(self, tried: set[str]) -> Candidate | None:
        """Read the next wording back. Where it is not the same contour, what is to blame is left out from now on."""
        if self.ahead(tried) is None or self.next is None:
            return None
        cost, lines, choices = self.next
        tried.add("\n".join(lines))
        program, first = self._program(lines, choices)
        deviation, line = self._read_back(program, choices)
        if deviation is None:
            self._ban(choices, line - first)
            return None
        blocks = tuple(block for each in choices for block in each.wording.blocks)
        elements = self.drawn.elements
        cut = [(elements[n.node.index + n.wording.count - 1].corner, n.wording) for n in choices]
        written_out = tuple(corner.segment.name for corner, each in cut if corner and each.writes_corner)
        return Candidate(blocks, lines, program, deviation, cost, written_out, all(e.wording.is_plain for e in choices))

    def _ban(self, choices: tuple[_Choice, ...], place: int) -> None:
        for each in choices:
            place -= len(each.wording.blocks)
            if place < 0 and not each.wording.is_plain:
                self.banned.add((each.node.index, each.node.is_cut, each.wording))
                self.next, self.found = None, self._in_order()
                break

    # All of them, in order

    def _at(self, index: int, is_cut: bool) -> list[Wording]:
        key = index, is_cut
        if key not in self.options:
            self.options[key] = _needed(self.wordings.at(index, is_cut=is_cut, is_plain=self.is_plain))
        return [each for each in self.options[key] if (index, is_cut, each) not in self.banned]

    def _in_order(self) -> Iterator[tuple[Cost, tuple[str, ...], tuple[_Choice, ...]]]:
        """Every wording of the whole contour: its cost, its lines, and what it is made of."""
        last, rest = len(self.drawn.elements), dict[_Node, Cost]()
        for index in reversed(range(last + 1)):
            for is_cut in (False, True):
                for wording in self._at(index, is_cut) if index < last else ():
                    self.motions |= {block.motion for block in wording.blocks if block.motion is not None}
        for index in reversed(range(last + 1)):
            for node in (_Node(index, is_cut, motion) for is_cut in (False, True) for motion in sorted(self.motions)):
                costs = [
                    _add(step, rest[there])
                    for wording in (self._at(index, node.is_cut) if index < last else ())
                    for step, there, _ in (self._step(node, wording),)
                    if there in rest
                ]
                if index == last or costs:
                    rest[node] = min(costs) if costs else _NOTHING
        begin, number = _Node(0, False, 0), count()
        heap: list[tuple[Cost, tuple[str, ...], int, Cost, _Node, tuple[_Choice, ...]]] = []
        if begin in rest:
            heappush(heap, (rest[begin], (), next(number), _NOTHING, begin, ()))
        while heap:
            whole, lines, _, spent, node, choices = heappop(heap)
            if node.index == last:
                yield whole, lines, choices
                continue
            for wording in self._at(node.index, node.is_cut):
                step, there, texts = self._step(node, wording)
                if there in rest:
                    cost = _add(spent, step)
                    more = (*lines, *texts), next(number), cost, there, (*choices, _Choice(node, wording))
                    heappush(heap, (_add(cost, rest[there]), *more))

    def _step(self, node: _Node, wording: Wording) -> tuple[Cost, _Node, tuple[str, ...]]:
        """What a wording costs at a place, the place behind it, and its lines."""
        motion, texts, words = node.motion, list[str](), 0
        for block in wording.blocks:
            code = () if block.motion is not None and block.motion == motion else (block.code,)
            texts.append(" ".join((*code, *(word.text for word in block.words))))
            words += len(code) + len(block.words)
            motion = motion if block.motion is None else block.motion
        rests = [word.rest for block in wording.blocks for word in block.words]
        steps = sum(word.is_step for block in wording.blocks for word in block.words)
        cost = rests.count(Rest.COMPUTED), words, len(wording.blocks), steps, rests.count(Rest.ROUND)
        return cost, _Node(node.index + wording.count, wording.is_cut, motion), tuple(texts)

    # Reading back

    def _program(self, lines: tuple[str, ...], choices: tuple[_Choice, ...]) -> tuple[str, int]:
        """The whole program, and the number of the line in which the contour begins."""
        needs_side = any(each.wording.needs_side for each in choices)
        modes, drawn = self.target.modes, self.drawn
        places = (self.wordings.word(axis, at, number).text for number, (axis, at) in enumerate(zip(self.wordings.plane.axes, drawn.start, strict=True)))
        opening = [*self.opening]
        if needs_side:
            opening[-1] += " G41 D0"
        start = " ".join((modes.codes[0].text, *sorted(places)))
        before, behind = _FRAMES.get(self.target.name, _ISO_FRAME)
        closing = ["G40"] if needs_side else []
        text = [*before, *opening, start, *lines, *closing, *behind]
        return "\n".join(text) + "\n", len(before) + len(opening) + 2

    def _read_back(self, program: str, choices: tuple[_Choice, ...]) -> tuple[float | None, int]:
        """How far the contour of a program is off, mm; None and the line to blame where it is another one."""
        return read_back(program, self.drawn, self.target, is_exact=not self.next or not self.next[0][0])


def read_back(program: str, drawn: DrawnContour, target: Dialect, *, is_exact: bool) -> tuple[float | None, int]:
    """How far the contour of a program is off a drawn one, mm; None and the line to blame where it is another one, or
    has a finding."""
    result = run(parse(program, syntax=target.modes.syntax), Request(target, drawn.unit, depth=Depth.FINDINGS, is_strict=True))
    for finding in result.diagnostics:
        return None, finding.span.line
    axes, numbers = drawn.plane.axes, target.modes.lexicon.numbers
    path = follow(result, target, drawn.unit, axes)
    steps = tuple(
        replace(each, compensation=_NO_SIDE) if isinstance(each, Travel) else each
        for each in path.steps
        if not (isinstance(each, Travel) and each.motion is Motion.RAPID)
    )
    unit = float(numbers.inch * drawn.unit.in_mm if drawn.unit is Length.INCH else numbers.mm)
    own = ToolPath("", "", axes, tuple(_travel(each, drawn) for each in drawn.path))
    found = compare(own, replace(path, steps=steps), SAME if is_exact else _UNITS_OFF * unit)
    if found.difference is None:
        return found.deviation, 0
    blamed = found.difference.new or (steps[-1] if steps else None)
    return None, blamed.line if blamed else 0


_NO_SIDE = 40


def _travel(segment: Segment, drawn: DrawnContour) -> Travel:
    bend = None
    if isinstance(segment, ArcSegment):
        bend = bend_of((0, 1), segment.center, segment.start, segment.end, segment.turn)
    return Travel(
        0, "", Motion.FEED, segment.start, segment.end, bend, _NO_SIDE, is_skippable=False, unit=drawn.unit, doubled=(False, False)
    )


def _add(one: Cost, other: Cost) -> Cost:
    return one[0] + other[0], one[1] + other[1], one[2] + other[2], one[3] + other[3], one[4] + other[4]


# Around the blocks

_ISO_FRAME = ("%", "O0001"), ("M30", "%")
_FRAMES: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    **dict.fromkeys(("siemens-840d", "siemens-808d"), ((), ("M30",))),
    "isg": (("%CONTOUR",), ("M30",)),
}
"""The lines with which a program begins and ends, where that is not as ISO 6983 has it."""


def opening_of(target: Dialect, drawn: DrawnContour) -> tuple[str, ...]:
    """The lines that say how the words of a program are read."""
    modes = target.modes
    rows = modes.codes.values()
    codes = [next(each.text for each in rows if each.unit is drawn.unit)]
    if machine_of(target) is MachineKind.MILL or target.diameter is not None:
        codes += [each.text for each in rows if each.plane and each.plane.code == drawn.plane.code]
    if 91 in modes.codes:  # noqa: PLR2004 - its code
        codes.append(modes.codes[90].text)
    if target.diameter is not None and machine_of(target) is MachineKind.LATHE:
        codes += [each.text for each in rows if each.diameter is Diameter.ON][:1]
    stated = {name: value for name, value in modes.settings.items() if name != "machine"}
    comment = ", ".join((f"contoursolve control: {target.name}", *(f"{name}: {value}" for name, value in stated.items())))
    return (*(comment_out(comment, modes.syntax) if stated else ()), " ".join(codes))
