"""The known part of a sketch: each element and corner with its state, what is missing and what would finish it, all
solutions and the one that a guess chooses."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from enum import Enum
from math import dist, inf

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import (
    NUMBERS,
    Answer,
    Depth,
    Listed,
    absent_words,
    either,
    helping_words,
    join,
    list_solutions,
)
from contoursolve.diagnostics import Diagnostic, OpenNumber, Severity
from contoursolve.gcode import parse
from contoursolve.geometry import Arc, assemble
from contoursolve.pictures import find_known, list_trails
from contoursolve.program import Run, SolveOptions
from contoursolve.sketches.as_program import Field, SketchProgram, as_program, element_of
from contoursolve.sketches.sketch import ContourSketch, SketchElement, Value
from contoursolve.sketches.sliding import Loose, loosely_drawn
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment, Status, analyse
from contoursolve.tolerance import AGREEMENT, LENGTH


class PartState(Enum):
    """State of an element or a corner of a sketch."""

    KNOWN = "known"
    """All that is given determines it."""
    SLIDING = "sliding"
    """It can still slide along a way."""
    CONTRADICTING = "contradicting"
    """Some of what is given of it contradicts the rest."""
    GUESSED = "guessed"
    """A guess has chosen it among several solutions."""
    UNKNOWN = "unknown"
    """Nothing tells where it is, or several places do."""


class SketchPart(Struct, frozen=True):
    """An element or a corner: its name, the number of its element, its state, the line or arc (mm, X as radius; None if
    there is none yet), by how many mm it contradicts the rest, and the ways along which its end can slide."""

    name: str
    number: int
    state: PartState
    segment: Segment | None = None
    off_mm: float | None = None
    ways: tuple[tuple[Point, ...], ...] = ()


class EntryRange(Struct, frozen=True):
    """A range of numbers, as they are written; empty where it has no end."""

    low: str
    high: str


class SketchEntry(Struct, frozen=True):
    """A field that would help to finish a sketch: the number of its element (0 for the sketch), its name, its meaning.

    With `example` the sketch is finished, where one was tried; `ranges` are the numbers with which it is, all of them
    if `is_complete`. `beside` are further fields that it needs then, each with its example.
    """

    number: int
    field: str
    meaning: str
    example: str = ""
    ranges: tuple[EntryRange, ...] = ()
    is_complete: bool = False
    beside: tuple[tuple[Field, str], ...] = ()


class SketchFix(Struct, frozen=True):
    """A change that mends a finding: a title, and the elements as they are then, by number."""

    title: str
    elements: Mapping[int, SketchElement]


class SketchFinding(Struct, frozen=True):
    """A finding about a sketch, with the fields that it is about."""

    code: str
    severity: Severity
    message: str
    help: str
    fields: tuple[Field, ...]
    off_mm: float | None = None
    fixes: tuple[SketchFix, ...] = ()


class SketchSolution(Struct, frozen=True):
    """One way to draw a sketch: its name, its lines and arcs, whether a guess chooses it, and the guess that would: the
    number of an element and where that ends."""

    name: str
    segments: tuple[Segment, ...]
    is_chosen: bool
    guess: tuple[int, Mapping[str, Decimal]]


class SketchAnswer(Struct, frozen=True):
    """All that is known of a sketch.

    `answer` is that of its program (None where it has no element, or begins nowhere), with the solution that a guess
    has chosen. `missing` says in one line what is missing, empty if nothing is; `remarks` tell of guesses.
    """

    sketch: ContourSketch
    program: SketchProgram
    status: str
    answer: Answer | None
    elements: tuple[SketchPart, ...]
    missing: str = ""
    entries: tuple[SketchEntry, ...] = ()
    findings: tuple[SketchFinding, ...] = ()
    solutions: tuple[SketchSolution, ...] = ()
    remarks: tuple[str, ...] = ()

    @property
    def is_finished(self) -> bool:
        """Whether it has one contour."""
        return self.answer is not None and self.answer.contour is not None


def solve_sketch(sketch: ContourSketch, *, with_ranges: bool = False) -> SketchAnswer:
    """All that is known of a sketch, however little that is.

    Args:
        sketch: as `read_sketch` makes it.
        with_ranges: whether each entry that would finish it has its ranges, and each finding its fixes; that takes
            longer.

    >>> from contoursolve.sketches import read_sketch
    >>> text = 'sketch = 1\\npart = "turned"\\nstart = { Z = 0, X = 0 }\\n[[element]]\\nkind = "line"\\nAN = 90'
    >>> found = solve_sketch(read_sketch(text))
    >>> found.missing, found.elements[0].state.value
    ('one entry is missing: X, LEN or IX of line 1', 'sliding')
    """
    program = as_program(sketch)
    if program.start is None or not sketch.elements:
        return _not_begun(sketch, program)
    answer = _examined(sketch, program, Depth.FINDINGS if with_ranges else Depth.VERDICT)
    if answer is None:
        return _not_begun(sketch, program)
    return _Reading(sketch, program, answer).result()


def _examined(sketch: ContourSketch, program: SketchProgram, depth: Depth) -> Answer | None:
    """The answer about a sketch's program."""
    asked = SolveOptions(start=program.start, units=sketch.unit, depth=depth.value)
    return next(
        iter(Run(parse(program.text, "sketch"), asked.request("sketch", sketch.control)).collect().answers), None
    )


def _not_begun(sketch: ContourSketch, program: SketchProgram) -> SketchAnswer:
    """The answer about a sketch that begins nowhere, or has no element."""
    open_ = [axis for axis in sketch.axes if axis not in sketch.start]
    entries = tuple(SketchEntry(0, f"start.{axis}", "where the contour begins") for axis in open_)
    missing = f"where it begins is missing: {join(open_)} of the start" if open_ else "the first line or arc is missing"
    parts = (SketchPart(sketch.name_of(n), n, PartState.UNKNOWN) for n in range(1, len(sketch.elements) + 1))
    return SketchAnswer(sketch, program, Status.UNDERDETERMINED.value, None, tuple(parts), missing, entries)


class _Reading:
    """The answer about a program, read back into the sketch."""

    def __init__(self, sketch: ContourSketch, program: SketchProgram, answer: Answer) -> None:
        self.sketch, self.program, self.answer = sketch, program, answer
        self.remarks: list[str] = []
        self.errors = [each for each in answer.diagnostics if each.is_error]
        self.blamed = dict(self._blamed())
        path = answer.profile.figure.path
        self.heads = {number: element.head for number, element in enumerate(path, 1)}

    def result(self) -> SketchAnswer:
        answer = self.answer
        listing = list_solutions(answer)
        several = [each for each in listing.solutions if each.contour is not None] if listing else []
        chosen = self._chosen(several) if len(several) > 1 else None
        has_guess = any(each.guess for each in self.sketch.elements)
        if has_guess and answer.contour is not None:
            self.remarks.append("the guess is not used: what is given has one solution")
        missing, loose = "", None
        entries: Iterable[SketchEntry] = ()
        if chosen is not None:
            picked = _examined(self.sketch, self._picking(chosen), Depth.VERDICT)
            answer = picked if picked is not None and picked.contour is not None else answer
        elif answer.contour is None:
            loose = self._loosely()
            missing, entries = self._missing(loose, len(several))
        return SketchAnswer(
            self.sketch,
            self.program,
            answer.status.value,
            answer,
            tuple(self._parts(answer, several, chosen, loose)),
            missing,
            tuple(entries),
            tuple(map(self._finding, self.answer.diagnostics)) if chosen is None else (),
            tuple(self._solutions(several, chosen)) if len(several) > 1 else (),
            tuple(self.remarks),
        )

    # Guesses -------------------------------------------------------------------------------------------------

    def _chosen(self, several: Sequence[Listed]) -> Listed | None:
        """The solution nearest to the guesses; None without a guess, or where two are equally near."""
        ranked = sorted(((self._distance(each), n) for n, each in enumerate(several)))
        if ranked[0][0] == inf:
            return None
        if ranked[1][0] - ranked[0][0] <= AGREEMENT:
            self.remarks.append("two solutions are equally near to the guess: put it nearer to one of them")
            return None
        return several[ranked[0][1]]

    def _distance(self, solution: Listed) -> float:
        """The distance of the guesses from the ends in a solution, mm; infinite without a guess."""
        assert solution.contour is not None
        squares = []
        for number, element in enumerate(self.sketch.elements, 1):
            at = solution.contour.places.get(self.heads.get(number, ""))
            for axis, letter in enumerate(self.sketch.axes):
                if at is not None and letter in element.guess:
                    squares.append((at[axis] - self._mm(axis, element.guess[letter])) ** 2)
        return sum(squares) ** 0.5 if squares else inf

    def _mm(self, axis: int, written: Decimal) -> float:
        return float(written * self.answer.unit.in_mm) * (0.5 if self.answer.plane.diameters[axis] else 1)

    def _written(self, at: Point) -> dict[str, Decimal]:
        """A place as a guess has it."""
        turned = zip(self.sketch.axes, at, self.answer.plane.diameters, strict=True)
        scale = float(self.answer.unit.in_mm)
        return {axis: Decimal(f"{value * (2 if is_turned else 1) / scale:.4f}") for axis, value, is_turned in turned}

    def _picking(self, chosen: Listed) -> SketchProgram:
        return as_program(self.sketch, {each.element: each.number for each in chosen.picks})

    def _solutions(self, several: Sequence[Listed], chosen: Listed | None) -> Iterator[SketchSolution]:
        for number, each in enumerate(several, 1):
            assert each.contour is not None
            at, others = each.contour.places, [one.contour.places for one in several if one.contour and one is not each]
            # The first element whose end no other solution has there tells it best.
            apart = {n: min(dist(at[head], other[head]) for other in others) for n, head in self.heads.items()}
            element = next((n for n, gap in apart.items() if gap > AGREEMENT), max(apart, key=lambda n: apart[n]))
            place = self._written(at[self.heads[element]])
            yield SketchSolution(f"solution {number}", each.contour.elements, each is chosen, (element, place))

    # States --------------------------------------------------------------------------------------------------

    def _blamed(self) -> Iterator[tuple[str, float | None]]:
        """The names of the elements and corners that errors contradict, with the amount, mm."""
        for finding in self.errors:
            if finding.about is None or self.answer.status in (Status.UNDERDETERMINED, Status.AMBIGUOUS):
                continue
            for label in finding.labels:
                field = self.program.field_at(label.span)
                if field is not None and field[0]:
                    name = f"corner {field[0]}" if field[1] == "corner" else self.sketch.name_of(field[0])
                    yield name, finding.values.get("off_by_mm")

    def _loosely(self) -> Loose | None:
        spans = {label.span for finding in self.errors for label in finding.labels} if self.blamed else set()
        givens = self.answer.profile.givens.items()
        doubted = [name for name, given in givens if given.word is not None and given.word.span in spans]
        return loosely_drawn(self.sketch, self.answer.profile, doubted)

    def _parts(
        self, answer: Answer, several: Sequence[Listed], chosen: Listed | None, loose: Loose | None
    ) -> Iterator[SketchPart]:
        """Every element and corner with its state."""
        own = {each.name: each for each in answer.contour.elements} if answer.contour is not None else {}
        drawn = own
        if answer.contour is None:
            trails = list_trails(answer, find_known(answer))
            drawn = {segment.name: segment for trail in trails for segment in trail.segments}
        shared = {name for name in drawn if _is_shared(name, several)} if several else {*drawn}
        completed = self._completed(loose, drawn)
        for number, element in enumerate(self.sketch.elements, 1):
            name = self.sketch.name_of(number)
            for part in (name, f"corner {number}") if element.corner else (name,):
                segment, state, way = drawn.get(part), PartState.KNOWN, None
                if part in self.blamed:
                    state, segment = PartState.CONTRADICTING, segment or completed.get(part)
                elif chosen is not None:
                    state = PartState.KNOWN if part in shared else PartState.GUESSED
                elif several:
                    state, segment = (state, segment) if part in shared else (PartState.UNKNOWN, None)
                elif loose is not None and answer.contour is None:
                    state = self._state(number, loose, segment)
                    segment = None if state is PartState.UNKNOWN and not self.blamed else completed.get(part, segment)
                    way = loose.ways.get(self.heads.get(number, "")) if part == name else None
                elif segment is None:
                    state = PartState.UNKNOWN
                off = self.blamed.get(part)
                if part in self.blamed and off is None and loose is not None:
                    off = max(
                        (off for given, off in loose.off_mm.items() if given.startswith(f"{number}:")), default=None
                    )
                yield SketchPart(part, number, state, segment, off, (way,) if way else ())

    def _state(self, number: int, loose: Loose, segment: Segment | None) -> PartState:
        """The state of an element of a sketch that lacks something."""
        path = self.answer.profile.figure.path
        if number > len(path):
            return PartState.UNKNOWN
        element = path[number - 1]
        ends = [element.tail, element.head, *([element.center] if isinstance(element, Arc) else [])]
        freedom = max(loose.freedom.get(each, 0) for each in ends)
        if not freedom and self.blamed and segment is None:
            return PartState.UNKNOWN
        return (PartState.KNOWN, PartState.SLIDING, PartState.UNKNOWN)[min(freedom, 2)]

    def _completed(self, loose: Loose | None, drawn: Mapping[str, Segment]) -> dict[str, Segment]:
        """The lines and arcs of a loose drawing, with its corners where they fit."""
        if loose is None:
            return {}
        plain: dict[str, Segment] = {}
        elements = list[SketchElement]()
        for given, element in zip(self.sketch.elements, self.answer.profile.figure.path, strict=False):
            tail, head = loose.points[element.tail], loose.points[element.head]
            words = self._exactly("{}", head)
            if isinstance(element, Arc):
                center = loose.points[element.center]
                plain[element.name] = ArcSegment(
                    element.name, tail, head, center, loose.radii[element.radius], element.turn
                )
                words |= self._exactly("CC{}", center)
            elif dist(tail, head) > LENGTH:
                plain[element.name] = LineSegment(element.name, tail, head)
            elements.append(
                SketchElement(
                    given.kind, words, given.turn or "ccw" if given.kind == "arc" else None, corner=given.corner
                )
            )
        contour = None
        if any(each.corner for each in elements):
            sketch = replace(self.sketch, elements=tuple(elements), facts=(), closed=False)
            found = _examined(sketch, as_program(sketch), Depth.VERDICT)
            contour = found.contour if found is not None else None
        return {**plain, **drawn} if contour is None else {each.name: each for each in contour.elements}

    def _exactly(self, name: str, at: Point) -> dict[str, Value]:
        """The words that put a point in a place."""
        scale = float(self.answer.unit.in_mm)
        turned = zip(self.sketch.axes, at, self.answer.plane.diameters, strict=True)
        return {
            name.format(axis): Decimal(f"{value * (2 if is_turned else 1) / scale:.10f}")
            for axis, value, is_turned in turned
        }

    # What is missing -----------------------------------------------------------------------------------------

    def _missing(self, loose: Loose | None, several: int) -> tuple[str, Iterable[SketchEntry]]:
        """The missing entries, in one line, and the fields that would help."""
        answer = self.answer
        if several > 1:
            return f"{several} contours fit: choose one, or guess where an element ends that they have apart", ()
        unfinished = [each for each in self.errors if each.about is None]
        if answer.status is Status.REJECTED and unfinished:
            first = self._finding(unfinished[0])
            return f"{first.message}: {first.help}", self._entries(())
        if answer.status is not Status.UNDERDETERMINED:
            return "", ()
        claim, profile = answer.claim, answer.profile
        system = assemble(profile)
        verdict = analyse(system)
        names = helping_words(claim, profile, absent_words(claim, profile, verdict.free))
        fields = [(int(number), field) for number, _, field in (name.partition(":") for name in names)]
        count = loose.missing if loose is not None and loose.missing else len(system.unknowns) - verdict.rank
        lines: dict[int, list[str]] = {}
        for number, field in sorted(fields[:_MOST_NAMED], key=lambda each: each[0]):
            lines.setdefault(number, []).append(field)
        told = [f"{either(own)} of {self.sketch.name_of(number)}" for number, own in lines.items()]
        amount = f"{NUMBERS.get(count, count)} {'entry is' if count == 1 else 'entries are'} missing"
        return f"{amount}: {', or '.join(told)}" if told else amount, self._entries(fields)

    def _entries(self, fields: Iterable[Field]) -> Iterator[SketchEntry]:
        """The fields that help, those first with which a number was tried."""
        rows = self.sketch.control.modes.lexicon.addresses
        found = dict.fromkeys(fields, SketchEntry(0, "", ""))
        for fix in (fix for finding in self.answer.diagnostics for fix in finding.fixes):
            places = [_place_of(each) for each in fix.numbers]
            if places and (len(places) > 1 or places[0] not in found or not found[places[0]].example):
                first, beside = fix.numbers[0], zip(places[1:], fix.numbers[1:], strict=True)
                ranges = tuple(EntryRange(_number_in(each.low), _number_in(each.high)) for each in first.ranges)
                told = tuple((place, _number_in(each.example)) for place, each in beside)
                found[places[0]] = SketchEntry(0, "", "", _number_in(first.example), ranges, first.is_complete, told)
        for (number, field), entry in sorted(found.items(), key=lambda each: not each[1].example):
            meaning = rows[field].meaning if field in rows else "size of the corner"
            yield replace(entry, number=number, field=field, meaning=meaning)

    # Findings ------------------------------------------------------------------------------------------------

    def _finding(self, finding: Diagnostic) -> SketchFinding:
        """A finding in the words of the sketch, with its fixes."""
        fields = (self.program.field_at(label.span) for label in finding.labels)
        return SketchFinding(
            finding.code,
            finding.severity,
            self._told(finding.message),
            self._told(finding.help),
            tuple(dict.fromkeys(field for field in fields if field is not None)),
            finding.values.get("off_by_mm"),
            tuple(self._fixes(finding)),
        )

    def _fixes(self, finding: Diagnostic) -> Iterator[SketchFix]:
        """The fixes of a finding that change elements."""
        for fix in finding.fixes:
            changed = dict[int, SketchElement]()
            for line, text in fix.by_line(self.answer.lines).items():
                element = element_of(text, self.sketch.control) if text and "\n" not in text else None
                if element is None or not 0 < line <= len(self.sketch.elements):
                    break
                old = self.sketch.elements[line - 1]
                now = replace(
                    element, guess=old.guess, facts=element.facts[: len(element.facts) - self._own_facts(line)]
                )
                if now != old:
                    changed[line] = now
            else:
                if changed:
                    yield SketchFix(self._told(fix.description), changed)

    def _own_facts(self, line: int) -> int:
        """The facts of the whole sketch among those in the line of an element."""
        return len(self.sketch.facts) if line == 1 else 0

    def _told(self, text: str) -> str:
        """A sentence about a program as one about a drawing: its lines are the elements, by their names."""
        text = _LINE.sub(lambda found: self._named(int(found["line"])), text)
        return _WORD.sub(lambda found: _WORDS[found[0]], text)

    def _named(self, number: int) -> str:
        return self.sketch.name_of(number) if 0 < number <= len(self.sketch.elements) else "the start"


_MOST_NAMED = 8
"""Fields that the line about what is missing names."""

_LINE = re.compile(r"program line (?P<line>-?\d+)")
_WORDS = {"FLT": "tangent", "FCT": "tangent", "DR+": "ccw", "DR-": "cw"}
_WORD = re.compile(rf"(?<!\w)(?:{'|'.join(map(re.escape, _WORDS))})(?!\w)")


def _is_shared(name: str, several: Sequence[Listed]) -> bool:
    """Whether all solutions have an element in one place."""
    found = [next((each for each in one.contour.elements if each.name == name), None) for one in several if one.contour]
    first = found[0]
    return first is not None and all(each is not None and _is_same(first, each) for each in found)


def _is_same(one: Segment, other: Segment) -> bool:
    centers = [each.center if isinstance(each, ArcSegment) else each.end for each in (one, other)]
    return max(dist(one.start, other.start), dist(one.end, other.end), dist(*centers)) <= AGREEMENT


def _place_of(number: OpenNumber) -> Field:
    """The field of a number that a fix leaves open."""
    address = number.word.strip().rstrip("?").strip()
    return number.line, "corner" if address in ("RND R", "CHF") else address


def _number_in(word: str) -> str:
    """The number of a word."""
    found = _NUMBER.search(word)
    return found[0] if found else ""


_NUMBER = re.compile(r"[+-]?[\d.]+$")
