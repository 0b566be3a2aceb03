"""A contour in the words of a control: the wordings that its rules allow, read back and proven, the best first."""

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from heapq import heappop, heappush
from itertools import accumulate, count

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison import Motion
from contoursolve.diagnosis import Answer, Depth
from contoursolve.gcode import spell
from contoursolve.postprocess.chain_wordings import ChainWordings, language_of
from contoursolve.postprocess.contour_drawing import ContourDrawing, draw, with_roundings
from contoursolve.postprocess.emit import Format, MotionBlock
from contoursolve.postprocess.expansion_report import ConversionError
from contoursolve.postprocess.form_wordings import FormWordings
from contoursolve.postprocess.klartext_wordings import KlartextWordings
from contoursolve.postprocess.post_processors import MachineKind, machine_of
from contoursolve.postprocess.read_back import ReadBack, read_back
from contoursolve.postprocess.small_program import SmallProgram
from contoursolve.postprocess.wordings import HostProgram, NumberGround, Speller, Wording, WrittenBlock, WrittenWord
from contoursolve.program import for_kind
from contoursolve.reading import Dialect
from contoursolve.solving import Point

MOST_CANDIDATES = 8
"""Candidates that are listed."""

MOST_READ = 60
"""Candidates that are read back."""

_SHORT = 12
"""Elements of a contour for which that holds; of a longer one, fewer candidates are listed and read back."""

Cost = tuple[int, int, int, int, int]
"""Computed numbers, words, blocks, increments with elements that others end, and numbers not of the drawing. A
rounded angle counts as an increment, too: it is farther from where the element ends."""

_NOTHING: Cost = (0, 0, 0, 0, 0)


_NONE = NumberGround.NONE


class WrittenContour(Struct, frozen=True):
    """One way to say the contour: its blocks, and a whole small program with them.

    It was read back as the control reads it, without a finding. It is the same contour to within `deviation` mm.
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

    def words(self, ground: NumberGround) -> tuple[WrittenWord, ...]:
        """The words whose numbers rest on something."""
        return tuple(word for block in self.blocks for word in block.words if word.ground is ground)


class Written(Struct, frozen=True):
    """A contour in the words of a control: the candidates, the best first. `reason` says what the control has no words
    for, or why it cannot make the contour at all."""

    control: str
    title: str
    candidates: tuple[WrittenContour, ...]
    reason: str = ""
    read_back: int = 0
    """The number of candidates that were read back."""


def write_contour(answer: Answer, target: Dialect, *, most: int = MOST_CANDIDATES) -> Written:
    """The wordings of a solved contour for a control. Raises ConversionError if it has no path, or one of no length."""
    drawn = draw(answer)
    if not drawn.elements:
        raise ConversionError("the contour has no length, so that it has no words")
    kind = MachineKind.LATHE if {*drawn.plane.axes} == {"X", "Z"} else MachineKind.MILL
    target = for_kind(target, {}, kind.value)
    if machine_of(target) is not kind:
        made = {MachineKind.LATHE: "turned", MachineKind.MILL: "milled"}[kind]
        return Written(
            target.name, target.title, (), f"the contour is {made}, and {target.name} is a {machine_of(target).value}"
        )
    rounded = with_roundings(drawn)
    several = [drawn, *([rounded] if rounded != drawn else [])]
    searches = [_Search(each, target, answer) for each in several]
    found, read, tried = list[WrittenContour](), 0, set[str]()
    share = min(1.0, _SHORT / len(drawn.elements))
    while len(found) < most * max(share, 1 / most) and read < MOST_READ * max(share, 1 / MOST_CANDIDATES):
        ahead = [each for each in searches if each.ahead(tried) is not None]
        if not ahead:
            break
        best = min(ahead, key=_Search.order)
        candidate = best.take(tried)
        read += 1
        found += [candidate] if candidate else []
    if not any(each.is_plain for each in found):
        searches.append(_Search(drawn, target, answer, is_plain=True))
        candidate = searches[-1].take(tried)
        found += [candidate] if candidate else []
    found.sort(key=lambda each: (each.cost, each.lines))
    reason = _reason(target, found, searches)
    return Written(target.name, target.title, tuple(found), reason, sum(each.read for each in searches))


def _reason(target: Dialect, found: Sequence[WrittenContour], searches: Sequence["_Search"]) -> str:
    if not found:
        return f"{target.name} accepts no blocks for this contour, not even plain ones"
    best = found[0]
    if best.written_out:
        return f"{target.name} has no word for {' and '.join(best.written_out)}: a block of its own makes it"
    if best.is_plain and best.cost[0]:
        return _why_plain(target.name, found, searches)
    return ""


def _why_plain(name: str, found: Sequence[WrittenContour], searches: Sequence["_Search"]) -> str:
    """The reason why the first candidate has no words of this control alone, though some numbers are computed."""
    others = sum(not each.is_plain for each in found)
    if others:
        ways = "1 further way has" if others == 1 else f"{others} further ways have"
        return f"plain lines and arcs are the shortest; {ways} {name}'s own words"
    refused = next((each.refused for each in searches if each.refused), "")
    if refused:
        return f"these are plain lines and arcs: {name} refuses its own words for this contour ({refused})"
    if any(each.has_own_words() for each in searches):
        return "plain lines and arcs are the shortest"
    return f"these are plain lines and arcs: {name} has no other words for this contour"


def _needed(wordings: Iterator[Wording]) -> list[Wording]:
    """Wordings without those that say more words than another one of the same elements."""
    said = {
        each: frozenset(word.text for word in each.words if word.ground is not NumberGround.NONE) for each in wordings
    }
    kinds = {
        each: (*(block.code for block in each.blocks), *(w.text for w in each.words if w.ground is NumberGround.NONE))
        for each in said
    }
    return [
        each
        for each, texts in said.items()
        if not any(kinds[each] == kinds[other] and own < texts for other, own in said.items())
    ]


Moves = Mapping[str, tuple[MotionBlock, ...]]
"""The moves for each element of a contour, by its name."""


def translate(answer: Answer, target: Dialect, here: Point, form: Format, *, is_rapid: bool) -> Moves | None:
    """The moves of a solved contour in the words of a target that writes lines and arcs in a row, in a program where
    the tool is really `here`; None if the target refuses it, or has no words for any of it."""
    if language_of(target) is None or answer.contour is None:
        return None
    side = {41: "G41", 42: "G42"}.get(answer.claim.before.compensation, "G40")
    search = _Search(draw(answer), target, answer, HostProgram(here, form, is_rapid, side))
    tried, candidate = set[str](), None
    while candidate is None and search.read < MOST_READ and search.ahead(tried) is not None:
        candidate = search.take(tried)
    if candidate is None or candidate.is_plain:
        return None
    found = dict[str, tuple[MotionBlock, ...]]()
    for choice in search.taken:
        row = search.drawn.elements[choice.node.index : choice.node.index + choice.wording.count]
        blocks, last = choice.wording.blocks, len(row) - 1
        for place, element in enumerate(row):
            own = blocks[place : place + 1] if place < last else blocks[last:]
            end = search.back.end if element is search.drawn.elements[-1] else element.segment.end
            found[element.segment.name] = tuple(
                MotionBlock(each.motion or 0, tuple(word.text for word in each.words), end, candidate.deviation)
                for each in own
            )
    return found


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

    def __init__(
        self,
        drawn: ContourDrawing,
        target: Dialect,
        answer: Answer,
        around: HostProgram | None = None,
        *,
        is_plain: bool = False,
    ) -> None:
        self.drawn, self.target, self.is_plain, self.surroundings = drawn, target, is_plain, around
        self.around = SmallProgram(target, drawn, around)
        state = self.around.state(drawn.unit)
        language = language_of(target)
        if target.writing is not None:
            self.wordings: Speller = KlartextWordings(drawn, target, state, answer, self._is_solved)
        elif language is not None:
            self.wordings = ChainWordings(drawn, target, state, language, around)
        else:
            self.wordings = FormWordings(drawn, target, state)
        places = enumerate(zip(state.plane.axes, drawn.start, strict=True))
        self.start = tuple(self.wordings.word(axis, at, number) for number, (axis, at) in places)
        self.back, self.taken = ReadBack(None), tuple[_Choice, ...]()
        self.read, self.refused = 0, ""
        """The number of programs that were read back, and why the first one in the control's own words was refused."""
        self.banned = set[tuple[int, bool, Wording]]()
        self.options = dict[tuple[int, bool], list[Wording]]()
        self.kinds = dict[tuple[int, bool], list[Wording]]()
        self.axes = {
            _address(spell(step, "1")): _address(spell(axis, "1")) for axis, step in self.wordings.steps.items()
        }
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

    def take(self, tried: set[str]) -> WrittenContour | None:
        """Read the next wording back. Where it is not the same contour, what is to blame is left out from now on."""
        if self.ahead(tried) is None or self.next is None:
            return None
        cost, lines, choices = self.next
        tried.add("\n".join(lines))
        blocks = tuple(block for each in choices for block in each.wording.blocks)
        needs_side = any(each.wording.needs_side for each in choices)
        program, first = self._program(blocks, lines, needs_side=needs_side)
        self.back = self._read_back("\n".join(program) + "\n", self.drawn, cost)
        if self.back.deviation is None:
            is_own = not all(each.wording.is_plain for each in choices)
            self.refused = self.refused or (self.back.reason if is_own else "")
            self._ban(choices, self.back.line - first)
            return None
        self.taken = choices
        own = tuple(program[first - 1 : first - 1 + len(lines)])
        elements = self.drawn.elements
        cut = [(elements[n.node.index + n.wording.count - 1].corner, n.wording) for n in choices]
        written_out = tuple(corner.segment.name for corner, each in cut if corner and each.writes_corner)
        is_plain = all(each.wording.is_plain for each in choices)
        return WrittenContour(blocks, own, "\n".join(program) + "\n", self.back.deviation, cost, written_out, is_plain)

    def _ban(self, choices: tuple[_Choice, ...], place: int) -> None:
        """Leave out the wording that is to blame: with a finding about a plain block, the corner word before it,
        whatever else stands there; with one about the corner word of a block, that word."""
        ends = accumulate(len(each.wording.blocks) for each in choices)
        number = next((n for n, end in enumerate(ends) if place < end), len(choices) - 1)
        each, before = choices[number], choices[max(number - 1, 0)]
        end = self.drawn.elements[before.node.index + before.wording.count - 1]
        has_word = end.corner is not None and not before.wording.writes_corner
        is_before = bool(number and self.back.word and each.wording.is_plain and has_word)
        blamed = before if is_before else each
        index, is_cut = blamed.node.index, blamed.node.is_cut
        several, last = self._allowed(index, is_cut), [*blamed.wording.words][-1:]
        found = [blamed.wording]
        if is_before:
            found = [other for other in several if other.count == before.wording.count and not other.writes_corner]
        elif [word.text for word in last] == [self.back.word] and self.drawn.elements[index].corner is not None:
            found = [other for other in several if [*other.words][-1:] == last]
        if len(several) > 1:
            self.banned.update((index, is_cut, other) for other in found)
            self.kinds.pop((index, is_cut), None)
            self.next, self.found = None, self._in_order()

    # All of them, in order

    def has_own_words(self) -> bool:
        """Whether the control has words for an element that are more than its end."""
        return any(not each.is_plain for several in self.options.values() for each in several)

    def _at(self, index: int, is_cut: bool) -> list[Wording]:
        """The best wording of each kind: ends and increments are the same kind, in whatever order the words stand."""
        key = index, is_cut
        if key not in self.kinds:
            kinds = dict[tuple[object, ...], Wording]()
            for each in sorted(self._allowed(index, is_cut), key=_cost):
                kinds.setdefault(self._kind(each), each)
            self.kinds[key] = [*kinds.values()]
        return self.kinds[key]

    def _kind(self, wording: Wording) -> tuple[object, ...]:
        axes, blocks = {*self.wordings.plane.axes}, list[tuple[str, ...]]()
        for block in wording.blocks:
            named = [(self.axes.get(at, at), word.text) for word in block.words for at in (_address(word.text),)]
            blocks.append((block.code, *sorted(at if at in axes else text for at, text in named)))
        return wording.count, wording.is_cut, wording.writes_corner, *blocks

    def _allowed(self, index: int, is_cut: bool) -> list[Wording]:
        key = index, is_cut
        if key not in self.options:
            self.options[key] = _needed(self.wordings.at(index, is_cut=is_cut, is_plain=self.is_plain))
        found = [each for each in self.options[key] if (index, is_cut, each) not in self.banned]
        # A corner that has a word is written out where its word is refused, and not beside that.
        said = {each.count for each in found if not each.writes_corner}
        return [each for each in found if not each.writes_corner or each.count not in said]

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
        """The cost of a wording at a place, the place behind it, and its lines."""
        motion, texts, codes = node.motion, list[str](), 0
        for block in wording.blocks:
            code = () if block.motion is not None and block.motion == motion else (block.code,)
            texts.append(" ".join((*filter(None, code), *(word.text for word in block.words))))
            codes += sum(map(bool, code))
            motion = motion if block.motion is None else block.motion
        cost = _add(_cost(wording), (0, codes, 0, 0, 0))
        return cost, _Node(node.index + wording.count, wording.is_cut, motion), tuple(texts)

    # Reading back

    def _program(
        self, blocks: Sequence[WrittenBlock], lines: Sequence[str], *, needs_side: bool = False
    ) -> tuple[list[str], int]:
        start = [word.text for word in self.start]
        if self.surroundings is not None:
            form, here = self.surroundings.form, self.surroundings.here
            places = (at / form.mm * scale for at, scale in zip(here, form.scales, strict=True))
            start = [f"{axis}{at:.9f}" for axis, at in zip(form.plane.axes, places, strict=True)]
        return self.around.assemble(blocks, lines, start, needs_side=needs_side)

    def _read_back(self, program: str, drawn: ContourDrawing, cost: Cost) -> ReadBack:
        self.read += 1
        is_rounded = cost[0] or any(word.ground is NumberGround.COMPUTED for word in self.start)
        is_rapid = self.surroundings is not None and self.surroundings.is_rapid
        motion = Motion.RAPID if is_rapid else Motion.FEED
        # In a program that is there already, it is told of what may be meant otherwise.
        read = partial(read_back, program, drawn, self.target, is_exact=not is_rounded, motion=motion)
        found = read(is_strict=self.surroundings is None)
        # Doubts about what is meant take longer, and repairs of what is wrong anyway much longer.
        is_doubted = found.deviation is not None and self.surroundings is None
        return read(depth=Depth.FINDINGS) if is_doubted else found

    def _is_solved(self, index: int, count: int, blocks: tuple[WrittenBlock, ...]) -> bool:
        """Whether blocks alone make some elements in a row."""
        row = list(self.drawn.elements[index : index + count])
        first, last = row[0], row[-1]
        if last.cut is None or first.cut is None or self.read >= MOST_READ:
            return False
        row[-1] = replace(last, corner=None, cut=replace(last.cut, end=last.segment.end))
        row[0] = replace(row[0], cut=replace(row[0].cut or first.cut, start=first.segment.start))
        part = replace(self.drawn, elements=tuple(row))
        axes, mm = self.wordings.plane.axes, float(self.drawn.unit.in_mm)
        start = [f"{axis}{at / mm:+.9f}" for axis, at in zip(axes, part.start, strict=True)]
        lines = [" ".join(filter(None, (each.code, *(word.text for word in each.words)))) for each in blocks]
        program, _ = self.around.assemble(blocks, lines, start, needs_side=False)
        self.read += 1
        return read_back("\n".join(program), part, self.target, is_exact=True).deviation is not None


def _cost(wording: Wording) -> Cost:
    """The cost of a wording without its codes."""
    words = [*wording.words]
    rests = [word.ground for word in words]
    steps = sum(word.is_indirect for word in words) + wording.count - 1
    return (
        rests.count(NumberGround.COMPUTED),
        len(words),
        len(wording.blocks),
        steps,
        rests.count(NumberGround.ROUND),
    )


_NUMBER = re.compile(r"[-+ .\d]+\)?$")


def _address(text: str) -> str:
    """A word without its number."""
    return _NUMBER.sub("", text).removesuffix("=")


def _add(one: Cost, other: Cost) -> Cost:
    return one[0] + other[0], one[1] + other[1], one[2] + other[2], one[3] + other[3], one[4] + other[4]
