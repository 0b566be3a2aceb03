"""The words with which HEIDENHAIN says elements of a drawn contour: conventional moves, and free elements in a row that
are solved together."""

from collections.abc import Iterator, Mapping
from itertools import islice

from msgspec.structs import replace

from contoursolve.diagnosis import Answer
from contoursolve.gcode import Word
from contoursolve.geometry import Arc, CornerShape, Turn, Unit
from contoursolve.postprocess.contour_drawing import ContourDrawing, DrawnElement, begins_smoothly
from contoursolve.postprocess.small_program import SmallProgram
from contoursolve.postprocess.wordings import (
    REFERENCE,
    NumberGround,
    Speller,
    Wording,
    WrittenBlock,
    WrittenWord,
    changed_axes,
)
from contoursolve.reading import Control, State
from contoursolve.solving import ArcSegment, LineSegment, Segment

CORNERS = {"ROUNDING": CornerShape.FILLET, "CHAMFER": CornerShape.CHAMFER_SETBACK}
_SENSES = {Turn.CW: "DR-", Turn.CCW: "DR+"}
_UNSIGNED = ("LEN", "R", "D", "DP", *CORNERS)
_REFERENCES = ("PAR", "RX", "RY", "RAN", "RPR", "RPA", "RCCX", "RCCY", "RCCPR", "RCCPA")
_BESIDE = ("DR", "tangent", "FSELECT", *CORNERS)
"""The parts of an element that are not among its words: its sense, its function, its pick, its corner."""
_PICK = "FSELECT"
_LONGEST = 24
"""Free elements that are tried in a row."""
MOST_TRIED = 60
"""Rows of free elements that are tried."""


class KlartextWordings(Speller):
    """The words of Klartext; `program` is that in which free elements are solved."""

    def __init__(
        self, drawn: ContourDrawing, control: Control, state: State, answer: Answer, program: SmallProgram
    ) -> None:
        super().__init__(drawn, control, state)
        self.corner_rows = [(name, 1, shape) for name, shape in CORNERS.items()]
        self.answer, self.program, self.tries = answer, program, MOST_TRIED

    def word(self, address: str, value: float, axis: int | None = None, text: str = "") -> WrittenWord:
        found = super().word(address, value, axis, text)
        return replace(found, text=_signed(found.text, address))

    def special(self, index: int, *, is_cut: bool) -> Iterator[Wording]:
        element = self.drawn.elements[index]
        if index and isinstance(element.segment, ArcSegment) and self._goes_on_smoothly(index):
            smooth = (WrittenBlock(None, "CT", self.place(element.segment.end)),)
            yield from (self.closed(1, smooth, way) for way in self.corners(element) if not way.behind)
        plain = self.plain(index, is_cut=is_cut)
        is_rounded = all(any(word.ground is NumberGround.COMPUTED for word in each.words) for each in plain)
        if is_cut or not (is_rounded or not index):
            return
        whole, is_done = len(self.drawn.elements) - index, False
        for count in dict.fromkeys((*range(1, min(_LONGEST, whole) + 1), *([] if index else [whole]))):
            tried = self._run(index, count) if count == whole or not is_done else ()
            blocks = next((each for each in tried if self._is_solved(index, count, each)), None)
            if blocks is not None:
                corner = islice(self.corner_words(self.drawn.elements[index + count - 1]), 1)
                yield Wording(count, self.attach(blocks, tuple(corner)))
                is_done |= not self._goes_on_smoothly(index + count)

    def _is_solved(self, index: int, count: int, blocks: tuple[WrittenBlock, ...]) -> bool:
        """Whether blocks alone make some elements in a row, as far as their number allows to try."""
        row = [*self.drawn.elements[index : index + count]]
        if self.tries <= 0 or row[0].cut is None or row[-1].cut is None:
            return False
        self.tries -= 1
        row[-1] = replace(row[-1], corner=None, cut=replace(row[-1].cut, end=row[-1].segment.end))
        row[0] = replace(row[0], cut=replace(row[0].cut, start=row[0].segment.start))
        part, mm = replace(self.drawn, elements=tuple(row)), float(self.unit.in_mm)
        start = [f"{axis}{at / mm:+.9f}" for axis, at in zip(self.plane.axes, part.start, strict=True)]
        return self.program.read(part, start, blocks, is_exact=True, is_part=True).deviation is not None

    def _goes_on_smoothly(self, index: int) -> bool:
        elements = self.drawn.elements
        return index < len(elements) and begins_smoothly(elements[index - 1], elements[index])

    def _run(self, index: int, count: int) -> Iterator[tuple[WrittenBlock, ...]]:
        """Free elements in a row, without the corner behind the last one; none if a corner between them has no word."""
        row = self.drawn.elements[index : index + count]
        corners = [tuple(islice(self.corner_words(each), 1)) for each in row]
        if any(each.corner and not words for each, words in zip(row, corners, strict=True)):
            return
        for is_whole in (False, True)[: 1 + (count == len(self.drawn.elements))]:
            blocks = tuple[WrittenBlock, ...]()
            for place, words in enumerate((*corners[:-1], ()), index):
                free = self._free(place, is_whole=is_whole)
                new = tuple(each for each in free if each.code != "FPOL" or each not in blocks)
                blocks = self.attach((*blocks, *new), words)
            yield blocks

    def attach(self, moves: tuple[WrittenBlock, ...], words: tuple[WrittenWord, ...]) -> tuple[WrittenBlock, ...]:
        return (*moves, WrittenBlock(None, "", words)) if words else moves

    def moves(self, segment: Segment) -> Iterator[tuple[WrittenBlock, ...]]:
        if isinstance(segment, ArcSegment):
            yield from self._arc(segment)
            return
        words = tuple(self.place(segment.end)[axis] for axis in changed_axes(segment))
        yield from [(WrittenBlock(None, "L", words),)] if words else []

    def _arc(self, arc: ArcSegment) -> Iterator[tuple[WrittenBlock, ...]]:
        sense = WrittenWord(_SENSES[arc.turn])
        ends, center = self.place(arc.end), self.place(arc.center)
        if arc.sweep < _FULL:
            radius = self.word("R", arc.radius if arc.sweep <= _FULL / 2 else -arc.radius)
            yield (WrittenBlock(None, "CR", (*ends, radius, sense)),)
        yield WrittenBlock(None, "CC", center), WrittenBlock(None, "C", (*ends, sense))

    def _free(self, index: int, *, is_whole: bool) -> Iterator[WrittenBlock]:
        """The block of a free element, with all that the drawing says of it; its pole before it, its pick behind."""
        element, claim = self.drawn.elements[index], self.answer.claim
        is_smooth = index > 0 and self._goes_on_smoothly(index)
        own = {name: word for name, word in claim.words.items() if name.startswith(f"{element.place + 1}:")}
        words = list(self._by_facts(element)) if not claim.form.is_general else []
        for name, word in own.items() if claim.form.is_general else ():
            is_said = name.partition(":")[2] not in _BESIDE and not word.is_asked
            if is_said and (word.address != "CLSD" or is_whole):
                words.append(self._as_said(name, word))
        yield from self._pole(own)
        sense = [WrittenWord(_SENSES[element.segment.turn])] if isinstance(element.segment, ArcSegment) else []
        code = ("FL" if isinstance(element.segment, LineSegment) else "FC") + ("T" if is_smooth else "")
        yield WrittenBlock(None, code, (*words, *sense), element.place)
        picks = [word for word in own.values() if word.address == _PICK]
        yield from (
            WrittenBlock(None, "", (WrittenWord(self.lexicon.spell(_PICK, f"{word.number}")),)) for word in picks
        )

    def _as_said(self, name: str, word: Word) -> WrittenWord:
        """A word of a free contour for the same element."""
        given, address = self.answer.claim.givens.get(name), word.address
        if address in _REFERENCES:
            path = self.answer.profile.figure.path
            place = next((n for n, each in enumerate(path) if each.name.endswith(f" {word.number}")), len(path))
            return WrittenWord(self.lexicon.spell(address, f"{REFERENCE}{place}{REFERENCE}"))
        if given is None or given.unit is Unit.SIGN:
            return WrittenWord(self.lexicon.spell(address, f"{word.number}"))
        is_coordinate = address[-1] in "XY" and not address.startswith("I")
        return self.word(address, float(given.value), "XY".index(address[-1]) if is_coordinate else None)

    def _pole(self, own: Mapping[str, Word]) -> Iterator[WrittenBlock]:
        """The pole from which words of an element count."""
        facts = [each for each in self.answer.profile.facts if each.given in own]
        named = dict.fromkeys(name.rpartition(".")[0] for each in facts for name in each.reads())
        for pole in (each for each in named if each.startswith("pole")):
            at = self.answer.contour.places[pole] if self.answer.contour else (0.0, 0.0)
            yield WrittenBlock(None, "FPOL", self.place(at))

    def _by_facts(self, element: DrawnElement) -> Iterator[WrittenWord]:
        """The words of Klartext that state what the words of another control do."""
        profile = self.answer.profile
        path = profile.figure.path[element.place]
        marks = {path.head: "", **({path.center: "CC"} if isinstance(path, Arc) else {})}
        found = dict[str, tuple[float, int | None]]()
        for fact in (each for each in profile.facts if each.given):
            value, at = float(profile.givens[fact.given].value), fact.placed
            if fact.heading == (path.tail, path.head) and isinstance(element.segment, LineSegment):
                way = element.segment.angle
                is_opposite = abs((way - value + _FULL / 2) % _FULL - _FULL / 2) > _QUARTER
                found.setdefault("AN", (value + is_opposite * _FULL / 2, None))
            elif at is not None and at.is_stepped and at.point in marks and at.origin in ("", path.tail):
                step = "I" if at.origin else ""
                found.setdefault(f"{step}{marks[at.point]}{'XY'[at.axis]}", (value, None if step else at.axis))
            elif isinstance(path, Arc) and fact.sizes == path.radius:
                found.setdefault("R", (abs(value), None))
            elif fact.span == (path.tail, path.head):
                found.setdefault("LEN", (value, None))
        yield from (self.word(name, *value) for name, value in found.items())


_FULL, _QUARTER = 360.0, 90.0


def _signed(text: str, address: str) -> str:
    """A word with its sign, where Klartext is used to one."""
    number = text[len(address) :].lstrip(" ")
    if address in _UNSIGNED or not number or number[0] in "+-":
        return text
    return text[: len(text) - len(number)] + "+" + number
