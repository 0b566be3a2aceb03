"""The known part of a sketch: each element and corner with its state, what is missing and what would finish it, all
solutions and the one that a guess chooses."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from enum import Enum
from math import dist, inf

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import (
    Answer,
    Depth,
    join,
    labels_of,
    length_text,
    list_solutions,
    place_text,
    status_text,
)
from contoursolve.diagnostics import Diagnostic, Severity, checked, hash_of
from contoursolve.geometry import Arc, scalar
from contoursolve.pictures import Known, Role, find_known, in_part, list_trails
from contoursolve.sketches.as_program import Field, SketchProgram, as_program, element_of
from contoursolve.sketches.finishing import (
    SketchEntry,
    asked_values,
    examined,
    missing_fields,
    missing_text,
    sketch_exactly,
    tried_entries,
    with_examples,
    written_place,
)
from contoursolve.sketches.sketch import ASKED, ContourSketch, SketchElement
from contoursolve.sketches.terms import on_drawing
from contoursolve.solving import (
    ArcSegment,
    Contour,
    NaturalDrawing,
    Point,
    RefusalKind,
    Segment,
    Status,
    drawings,
    scalars_of,
)
from contoursolve.tolerance import AGREEMENT, LENGTH

NOTHING = 1e-5
"""mm. What is less is nothing."""


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
    has chosen. `missing` says in one line what is missing, empty if nothing is; `remarks` tell of guesses, `asked` are
    the values of fields with `?`, as they are written, None where nothing tells one.
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
    asked: Mapping[Field, Decimal | None] = {}

    __hash__ = hash_of

    @property
    def is_finished(self) -> bool:
        """Whether it has one contour, and nothing is missing."""
        return self.answer is not None and self.answer.contour is not None and not self.missing

    @property
    def said(self) -> str:
        """Its state in one line: what is missing or wrong, or that it is finished."""
        if self.missing or self.is_finished:
            return self.missing or "the contour is finished"
        errors = (each.message for each in self.findings if each.severity is Severity.ERROR)
        return next(errors, f"no contour: {status_text(self.status)}")


@checked
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
    program, answer = as_program(sketch), None
    if program.start is not None and sketch.elements:
        answer = examined(sketch, Depth.FINDINGS if with_ranges else Depth.VERDICT)
    if answer is None:
        found = _not_begun(sketch, program)
    else:
        found = _Reading(sketch, program, answer).result(with_ranges=with_ranges)
    first = next((at for at, each in enumerate(sketch.elements) if each.kind == "arc" and each.turn is None), None)
    if first is not None:
        # What is not the same whichever way such an arc turns is not known, except by what stands before it.
        turned = [replace(each, turn=each.turn or "cw") if each.kind == "arc" else each for each in sketch.elements]
        others = solve_sketch(replace(sketch, elements=tuple(turned))).elements
        before: dict[str, SketchPart] = {}
        if first and not sketch.closed:
            before = {
                each.name: each for each in solve_sketch(replace(sketch, elements=sketch.elements[:first])).elements
            }
        alike = (_known_alike(one, other, before) for one, other in zip(found.elements, others, strict=True))
        found = replace(found, elements=tuple(alike))
    for each in _unfinished(sketch):
        missing = found.missing or f"{each.message}: {each.help}"
        found = replace(found, missing=missing, findings=(*found.findings, each))
    return found


def _unfinished(sketch: ContourSketch) -> Iterator[SketchFinding]:
    """The gaps that the next element will fill: `as_program` leaves it out."""
    number = len(sketch.elements)
    if sketch.closed and number == 1:
        message, help_ = "a closed contour has two lines or arcs, or more", "add the next line or arc"
        yield SketchFinding("drawing-closed-alone", Severity.ERROR, message, help_, ((0, "closed"),))
    if number and sketch.elements[-1].corner is not None:
        where, help_ = (
            "needs an element after it, and none follows",
            "add the next line or arc, or leave the corner out",
        )
        if sketch.closed:
            where, help_ = "lies where the closed contour begins", "let it begin in the middle of an element"
        message, fields = f"corner {number} {where}", ((number, "corner"),)
        yield SketchFinding("drawing-corner-without-next", Severity.ERROR, message, help_, fields)


def _known_alike(part: SketchPart, other: SketchPart, before: Mapping[str, SketchPart]) -> SketchPart:
    """A part that is known where another reading has it, or contradicts; else what is known of it without the elements
    behind it."""
    is_known = part.state is other.state is PartState.KNOWN and _is_same(part.segment, other.segment)
    if is_known or part.state is PartState.CONTRADICTING:
        return part
    return before.get(part.name) or replace(part, state=PartState.UNKNOWN, segment=None, ways=())


def _not_begun(sketch: ContourSketch, program: SketchProgram) -> SketchAnswer:
    """The answer about a sketch that begins nowhere, or has no element."""
    open_ = [axis for axis in sketch.axes if axis not in sketch.start]
    entries = tuple(SketchEntry(0, f"start.{axis}", "where the contour begins") for axis in open_)
    missing = f"where it begins is missing: {join(open_)} of the start" if open_ else "the first line or arc is missing"
    parts = (SketchPart(name, number, PartState.UNKNOWN) for name, number in sketch.parts())
    return SketchAnswer(sketch, program, Status.UNDERDETERMINED.value, None, tuple(parts), missing, entries)


class _Reading:
    """The answer about a program, read back into the sketch."""

    def __init__(self, sketch: ContourSketch, program: SketchProgram, answer: Answer) -> None:
        self.sketch, self.program, self.answer = sketch, program, answer
        self.remarks: list[str] = []
        self.sure: set[str] = set()
        self.errors = [each for each in answer.diagnostics if each.is_error]
        self.blamed = dict(self._blamed())
        path = answer.profile.figure.path
        self.heads = {number: element.head for number, element in enumerate(path, 1)}
        # What a guess may be about: ends, then centres.
        self.points = {(number, ""): head for number, head in self.heads.items()}
        self.points |= {(number, "CC"): each.center for number, each in enumerate(path, 1) if isinstance(each, Arc)}
        self.loose: NaturalDrawing | None = None
        self.gap: SketchFinding | None = None
        self.with_ranges = False

    def result(self, *, with_ranges: bool) -> SketchAnswer:
        self.with_ranges = with_ranges
        answer, listed = self.answer, _contours(self.answer)
        several = [contour for contour, _ in listed]
        chosen = self._chosen(several) if len(several) > 1 else None
        has_guess = any(each.guess for each in self.sketch.elements)
        if has_guess and answer.contour is not None:
            self.remarks.append("the guess is not used: what is given has one solution")
        elif has_guess and answer.status is Status.UNDERDETERMINED:
            self.remarks.append("the guess is no dimension: it only shows where an element may be")
        missing = ""
        entries: Iterable[SketchEntry] = ()
        if chosen is not None:
            picked = examined(self.sketch, picks=next(picks for contour, picks in listed if contour is chosen))
            answer = picked if picked is not None and picked.contour is not None else answer
        elif answer.contour is None:
            self.loose = self._loosely()
            self.gap = self._gap() if self.sketch.closed else None
            missing, entries = self._missing(len(several), with_ranges=with_ranges)
        return SketchAnswer(
            self.sketch,
            self.program,
            answer.status.value,
            answer,
            tuple(self._parts(answer, is_open=not several, is_chosen=chosen is not None)),
            missing,
            tuple(entries),
            tuple(self._findings(answer)),
            tuple(self._solutions(several, chosen)) if len(several) > 1 else (),
            tuple(self.remarks),
            asked_values(self.program, answer),
        )

    # Guesses -------------------------------------------------------------------------------------------------

    def _chosen(self, several: Sequence[Contour]) -> Contour | None:
        """The solution nearest to the guesses; None without a guess, or where two are equally near."""
        distances = [self._distance(each) for each in several]
        nearest, next_one, *_ = sorted(distances)
        if nearest == inf:
            return None
        if next_one - nearest <= AGREEMENT:
            self.remarks.append("two contours are equally near to the guess: put it nearer to one of them")
            return None
        return several[distances.index(nearest)]

    def _distance(self, contour: Contour) -> float:
        """The distance of the guesses from the points of a solution, mm; infinite without a guess."""
        places = scalars_of({point: contour.places[point] for point in self.points.values()})
        squares = [(places[name] - guessed) ** 2 for name, guessed in self._guessed()]
        return sum(squares) ** 0.5 if squares else inf

    def _guessed(self) -> Iterator[tuple[str, float]]:
        """The coordinates that guesses tell, mm."""
        for (number, prefix), point in self.points.items():
            guess = self.sketch.elements[number - 1].guess
            for axis, letter in enumerate(self.sketch.axes):
                if prefix + letter in guess:
                    times = 2 if self.answer.plane.diameters[axis] else 1
                    yield scalar(point, axis), float(guess[prefix + letter] * self.answer.unit.in_mm) / times

    def _solutions(self, several: Sequence[Contour], chosen: Contour | None) -> Iterator[SketchSolution]:
        for number, each in enumerate(several, 1):
            others = [one.places for one in several if one is not each]
            # The first point that no other solution has there tells it best.
            apart = {key: min(dist(each.places[name], at[name]) for at in others) for key, name in self.points.items()}
            best = next((key for key, gap in apart.items() if gap > AGREEMENT), max(apart, key=lambda key: apart[key]))
            place = written_place(self.answer, each.places[self.points[best]])
            guess = {best[1] + axis: value for axis, value in place.items()}
            yield SketchSolution(f"contour {number}", each.elements, each is chosen, (best[0], guess))

    # States --------------------------------------------------------------------------------------------------

    def _blamed(self) -> Iterator[tuple[str, float | None]]:
        """The names of the elements and corners that errors contradict, with the amount, mm."""
        for finding in self.errors if self.answer.status not in _OPEN else ():
            fields = (self.program.field_at(label.span) for label in finding.labels)
            for number, name in (field for field in fields if field is not None and field[0]):
                if isinstance(finding.about, RefusalKind):
                    yield f"corner {number}" if name == "corner" else self.sketch.name_of(number), _amount(finding)

    def _loosely(self) -> NaturalDrawing | None:
        spans = {label.span for finding in self.errors for label in finding.labels} if self.blamed else set()
        givens = self.answer.profile.givens.items()
        doubted = [name for name, given in givens if given.word is not None and given.word.span in spans]
        return next(drawings(self.answer.profile, doubted, dict(self._guessed())), None)

    def _parts(self, answer: Answer, *, is_open: bool, is_chosen: bool) -> Iterator[SketchPart]:
        """Every element and corner with its state."""
        known = find_known(self.answer)
        trails = [*list_trails(self.answer, known)]
        shared = {each.name for trail in trails if trail.role is Role.DETERMINED for each in trail.segments}
        drawn = {each.name: each for trail in trails for each in trail.segments}
        if answer.contour is not None:
            drawn = {each.name: each for each in answer.contour.elements}
        # What follows from directions as they are is no less sure than what does so whatever they are.
        self.sure = {*known.points} - known.several | {*in_part(answer.profile).points}
        loose, gap = self.loose, self.gap
        completed = self._completed(loose, drawn) if loose is not None else {}
        for part, number in self.sketch.parts():
            segment, off = completed.get(part, drawn.get(part)), self.blamed.get(part)
            if part in self.blamed:
                state = PartState.CONTRADICTING
                off = gap.off_mm if gap is not None and number == len(self.sketch.elements) else off
                off = off if off is not None or loose is None else _off_of(number, loose)
            elif loose is not None and is_open:
                state = self._state(part, number, loose, drawn)
            elif part in shared:
                state = PartState.KNOWN
            else:
                state = PartState.UNKNOWN if not is_chosen or part not in drawn else PartState.GUESSED
            is_placed = state is not PartState.UNKNOWN or bool(self.blamed)
            ways = self._ways(part, number, loose) if loose and state is PartState.SLIDING else ()
            yield SketchPart(part, number, state, segment if is_placed else None, off, ways)

    def _ways(self, part: str, number: int, loose: NaturalDrawing) -> tuple[tuple[Point, ...], ...]:
        way = loose.ways.get(self.heads.get(number, ""))
        return (way,) if way and not part.startswith("corner") else ()

    def _state(self, part: str, number: int, loose: NaturalDrawing, drawn: Mapping[str, Segment]) -> PartState:
        """The state of an element, or of the corner after it, of a sketch that has no contour."""
        path = self.answer.profile.figure.path
        is_corner = part.startswith("corner")
        around = path[number - 1 : number + is_corner]
        if len(around) <= is_corner or (
            self.blamed and any(each.name in self.blamed or each.name not in drawn for each in around)
        ):
            return PartState.UNKNOWN
        ends = [end for each in around for end in (each.tail, each.head, getattr(each, "center", each.head))]
        freedom = max(loose.freedom.get(each, 0) for each in ends)
        # What moves nowhere may still lie in several places.
        freedom = freedom or (0 if self.sure.issuperset(ends) else 2)
        return (PartState.KNOWN, PartState.SLIDING, PartState.UNKNOWN)[min(freedom, 2)]

    def _completed(self, loose: NaturalDrawing, drawn: Mapping[str, Segment]) -> dict[str, Segment]:
        """The lines and arcs of a loose drawing, with its corners where they fit."""
        trails = list_trails(self.answer, Known(loose.points, loose.radii))
        plain = {each.name: each for trail in trails for each in trail.segments}
        sketch, found = sketch_exactly(self.answer, self.sketch, loose), None
        for name, number in self.sketch.parts():
            if name.startswith("corner") and name in self.blamed:
                sketch = sketch.changed(number, corner=None)
        if any(each.corner for each in sketch.elements):
            found = examined(sketch)
        whole = found.contour.elements if found is not None and found.contour is not None else ()
        return {**plain, **drawn, **{each.name: each for each in whole}}

    def _missing(self, several: int, *, with_ranges: bool) -> tuple[str, tuple[SketchEntry, ...]]:
        """The missing entries in one line, and one by one."""
        if several > 1:
            return f"{several} contours fit: choose one, or guess where an element ends", ()
        arcs = [n for n, each in enumerate(self.sketch.elements, 1) if each.kind == "arc" and each.turn is None]
        if arcs:
            told = join([self.sketch.name_of(each) for each in arcs])
            entries = tuple(SketchEntry(each, "turn", "clockwise or counter-clockwise") for each in arcs)
            return f"the sense of {told} is missing: clockwise or counter-clockwise", entries
        unfinished = [each for each in self.errors if each.about is None]
        if self.answer.status is Status.REJECTED and unfinished:
            first = self._finding(unfinished[0])
            return f"{first.message}: {first.help}", tried_entries(self.sketch, self.answer, ())
        if self.answer.status is not Status.UNDERDETERMINED:
            return "", ()
        count, fields = missing_fields(self.answer, self.loose)
        entries = tried_entries(self.sketch, self.answer, fields)
        if with_ranges and self.loose is not None and count == 1:
            entries = with_examples(self.sketch, self.answer, self.loose, entries)
        return missing_text(self.sketch, count, fields), entries

    def _gap(self) -> SketchFinding | None:
        """The finding about a closed contour that ends elsewhere: of both axes together; None if it does not."""
        field = len(self.sketch.elements), "closed"
        errors = [each for each in self.errors if field in self._fields(each) and isinstance(each.about, RefusalKind)]
        # Where it ends is what the rest gives, if that is one place.
        left_open = examined(replace(self.sketch, closed=False)) if errors else None
        paths = [contour for contour, _ in _contours(left_open)] if left_open is not None else []
        if not paths or any(dist(each.end, paths[0].end) > AGREEMENT for each in paths):
            return None
        end, gap = paths[0].end, dist(paths[0].start, paths[0].end)
        if gap <= LENGTH:
            return None
        there, amount = self._place(end), length_text(gap, self.answer.unit)
        message = f"the contour ends at {there}, {amount} from where it begins"
        help_ = "add what leads back to the start, or say that it does not end where it begins"
        fixes = tuple(fix for each in errors for fix in self._fixes(each))
        return SketchFinding(errors[0].code, Severity.ERROR, message, help_, (field, (0, "closed")), gap, fixes)

    def _place(self, at: Point) -> str:
        return place_text(self.answer.profile, scalars_of({"": at}))

    def _fields(self, finding: Diagnostic) -> tuple[Field, ...]:
        fields = (self.program.field_at(label.span) for label in finding.labels)
        return tuple(dict.fromkeys(field for field in fields if field is not None))

    def _findings(self, answer: Answer) -> Iterator[SketchFinding]:
        """The findings; that a field agrees with others is not told where it also contradicts."""
        gap = self.gap
        if gap is not None:
            yield gap
        # What is not given yet is no error; what is missing tells it.
        own = [each for each in answer.diagnostics if gap is None or gap.fields[0] not in self._fields(each)]
        found = [self._finding(each) for each in own if each.code != "drawing-sense"]
        wrong = {field for each in found if each.severity is Severity.ERROR for field in each.fields}
        for each in found:
            if each.severity is not Severity.INFO or not each.fields or not wrong.issuperset(each.fields):
                yield each

    # Findings ------------------------------------------------------------------------------------------------

    def _finding(self, finding: Diagnostic) -> SketchFinding:
        """A finding in the words of the sketch, with its fixes: numbers that agree first, then what may go."""
        fixes = tuple(self._fixes(finding))
        agreeing = [*filter(None, map(self._agreeing, fixes if finding.is_error and self.with_ranges else ()))]
        # An angle of a drawing is rarely the number that is wrong.
        agreeing.sort(key=lambda each: each.title.startswith(_ANGLES))
        return SketchFinding(
            finding.code,
            finding.severity,
            on_drawing(finding.message, self.sketch),
            on_drawing(finding.help, self.sketch),
            self._fields(finding),
            finding.values.get("off_by_mm"),
            (*agreeing, *fixes),
        )

    def _agreeing(self, fix: SketchFix) -> SketchFix | None:
        """For a fix that deletes one number, one that writes what the rest gives; None where that, typed in to three
        decimals, does not agree."""
        (number, now), *others = fix.elements.items()
        old = self.sketch.elements[number - 1]
        gone = [name for name in old.words if name not in now.words]
        if others or len(gone) != 1 or replace(old, words=now.words) != now or old.words[gone[0]] == ASKED:
            return None
        name, open_ = gone[0], self.sketch.changed(number, words={**old.words, gone[0]: ASKED})
        found = examined(open_)
        value = asked_values(as_program(open_), found).get((number, name)) if found is not None else None
        if value is None:
            return None
        told = value.normalize()
        mended = self.sketch.changed(number, words={**old.words, name: told})
        checked_ = examined(mended)
        if checked_ is None or checked_.contour is None:
            return None
        title = f"write {name}{told:f} for {name}{old.words[name]} in {self.sketch.name_of(number)}"
        return SketchFix(title, {number: mended.elements[number - 1]})

    def _fixes(self, finding: Diagnostic) -> Iterator[SketchFix]:
        """The fixes of a finding that change elements."""
        for fix in finding.fixes:
            changed = dict[int, SketchElement]()
            for line, text in fix.by_line(self.answer.lines).items():
                element = element_of(text, self.sketch) if text and "\n" not in text else None
                if element is None or not 0 < line <= len(self.sketch.elements):
                    break
                old = self.sketch.elements[line - 1]
                # Those of the whole sketch stand in the line of its first element.
                count = len(element.facts) - (len(self.sketch.facts) if line == 1 else 0)
                now = replace(element, guess=old.guess, facts=element.facts[:count])
                if now != old:
                    changed[line] = now
            else:
                if changed:
                    yield SketchFix(self._moved(on_drawing(fix.description, self.sketch)), changed)

    def _moved(self, title: str) -> str:
        """The title of a fix without the places that it leaves where they are."""
        points = self.loose.points if self.loose is not None else {}
        labels = labels_of(self.answer.profile)
        told = {on_drawing(f"the {labels[name]} is", self.sketch): at for name, at in points.items() if name in labels}
        told |= {"the contour ends": points[self.heads[max(self.heads)]]} if points else {}
        same = [f"{lead} at {self._place(at)}" for lead, at in told.items()]
        change, _, outcome = title.partition(" -> ")
        moved = ", ".join(each for each in outcome.split(", ") if each not in same)
        return f"{change} -> {moved}" if moved else change


def _off_of(number: int, loose: NaturalDrawing) -> float | None:
    """The largest amount, mm, by which a fact of an element is off; None where all are true."""
    most = max((off for given, off in loose.off_mm.items() if given.startswith(f"{number}:")), default=0.0)
    return most if most > NOTHING else None


_ANGLES = ("write AN", "write IAN", "write CCA", "write PA", "write RAN")


_OPEN = (Status.UNDERDETERMINED, Status.AMBIGUOUS)


def _contours(answer: Answer) -> list[tuple[Contour, Mapping[int, int]]]:
    """All contours that fit, each with the numbers that choose it by elements, and in the order of these."""
    listing = list_solutions(answer)
    found = [
        (each.contour, {pick.element: pick.number for pick in each.picks})
        for each in (listing.solutions if listing else ())
        if each.contour is not None
    ]
    return sorted(found, key=lambda each: [*each[1].items()])


def _amount(finding: Diagnostic) -> float | None:
    """The amount, mm, by which a finding tells that something is off, or is too large."""
    values = finding.values
    found = values.get("off_by_mm", values.get("actual", 0.0) - values["limit"] if "limit" in values else None)
    return found if found is not None and found > LENGTH else None


def _is_same(one: Segment | None, other: Segment | None) -> bool:
    """Whether two lines or arcs are in one place."""
    if one is None or other is None:
        return one is other
    centers = [each.center if isinstance(each, ArcSegment) else each.end for each in (one, other)]
    return max(dist(one.start, other.start), dist(one.end, other.end), dist(*centers)) <= AGREEMENT
