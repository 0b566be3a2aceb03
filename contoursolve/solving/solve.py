"""Solves a determined profile and believes nothing: every answer is held against the original equations."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from functools import cached_property, lru_cache
from itertools import combinations, count
from math import asin, atan2, degrees, hypot, inf, isfinite

from msgspec.structs import replace

from contoursolve.geometry import (
    FIRST,
    INCREMENT_OF,
    SECOND,
    Fact,
    Profile,
    System,
    Values,
    assemble,
    scalar,
)
from contoursolve.numeric import direction, inverse_norm
from contoursolve.solving.affine import affine_facts
from contoursolve.solving.certify import certify, decide_meeting
from contoursolve.solving.checks import (
    Check,
    MeasuredFigure,
    Stage,
    Test,
    at_origin,
    check_step,
    compile_checked,
    compile_checks,
    is_failing,
    unverified,
)
from contoursolve.solving.compare import compare_affine, compare_fact, givens_of
from contoursolve.solving.compile import compile_system
from contoursolve.solving.construction import ConstructionStep, StepKind, is_closed
from contoursolve.solving.determinacy import analyse
from contoursolve.solving.events import NoteKind, RefusalKind, Status
from contoursolve.solving.judge import MeasuredPath, judge_path, judge_range, vanishing_lines
from contoursolve.solving.numbers import inputs_of, lookup, scalars_of, sizes_of, solution_at
from contoursolve.solving.path_outputs import PathOutputs
from contoursolve.solving.solution import Certificate, Note, Point, Refusal, SystemSolution, up_to_one_digit
from contoursolve.solving.step_outputs import StepOutputs
from contoursolve.tolerance import ERROR_BOUND_WARNING, RESIDUAL, TOUCHING

ROUNDING = 2.0**-50
"""1 (share of the coordinates). Rounding of one formula of about four operations."""


def solve(profile: Profile, *, is_proven: bool = True) -> SystemSolution:
    """The contour of a profile whose system is determined and whose start is known.

    With more facts than unknowns, the first determined subset that is regular at these values is
    solved, and the remaining facts must agree with it. Raises ValueError if nothing is determined, NoClosedFormError
    if some step has no closed form (see `is_closed`).
    """
    system = assemble(profile)
    verdict = analyse(system)
    if not verdict.is_determined:
        raise ValueError(f"not determined: {', '.join(verdict.free)}")
    attempt = _Attempt(profile, system)
    answer = attempt.answer(is_proven=is_proven)
    tied = frozenset(system.facts[index] for index in verdict.tied) if attempt.stuck else frozenset()
    # Where it is singular and nothing is said twice, nothing can stand in for it.
    for candidate in _orders(system, tied) if attempt.stuck & tied else ():
        attempt = _Attempt(profile, candidate)
        answer = attempt.answer(is_proven=is_proven)
        if not attempt.stuck:
            break
    return _all_refusals(profile, answer) if attempt.stuck else answer


OFTEN = 8
"""Solves of one system from which on its checks are part of its function: to compile them takes as long as about 20."""


@lru_cache(maxsize=4096)
def _solved(_: System) -> Iterator[int]:
    """Counts how often a system was solved."""
    return count()


def _all_refusals(profile: Profile, answer: SystemSolution) -> SystemSolution:
    """A refusal where a step is singular, with whatever else facts about lines say against each other."""
    affine = affine_facts(profile, profile.facts)
    events = tuple(compare_affine(profile, affine)) if affine is not None else ()
    return refused(events) if any(isinstance(event, Refusal) for event in events) else answer


def refused(events: Iterable[Refusal | Note]) -> SystemSolution:
    """The solution that refusals leave, with the words that agree; its status is the first in order."""
    refusals = tuple(event for event in events if isinstance(event, Refusal))
    agreeing = tuple(event for event in events if isinstance(event, Note) and event.kind is NoteKind.WORDS_AGREE)
    found = {refusal.kind.status for refusal in refusals} | ({Status.OVERDETERMINED} if agreeing else set())
    status = next(status for status in Status if status in found)
    return SystemSolution(status, refusals=refusals, remarks=agreeing)


def _orders(system: System, tied: frozenset[Fact]) -> Iterator[System]:
    """The system with its facts reordered, so that another basis is solved, in closed form. Whatever is not tied is in
    every basis."""
    needed = len(system.unknowns) - (len(system.facts) - len(tied))
    for chosen in combinations([fact for fact in system.facts if fact in tied], needed):
        first = tuple(fact for fact in system.facts if fact not in tied or fact in chosen)
        basis = system.keep(first)
        if analyse(basis).is_determined and is_closed(basis):
            yield system.keep(first + tuple(fact for fact in system.facts if fact not in first))


class _Attempt:
    """One evaluation of one system; `answer` reads the outputs in the order in which they can fail."""

    def __init__(self, profile: Profile, system: System) -> None:
        first, second = profile.start.values
        if first is None or second is None:
            raise ValueError("the start point is not known")
        self.start = first, second
        self.origin = float(first), float(second)
        self.profile = profile
        self.system = system
        self.machine = compile_system(system)
        self.inputs = inputs_of(profile, system)
        is_often = next(_solved(system)) >= OFTEN
        function = compile_checked(system) if is_often else self.machine.function
        self.out = function(self.inputs)
        checks = compile_checks(system).outputs if is_often else None
        self.is_clear = checks is not None and self.out[checks.passed] == len(checks.checks)
        """Whether every check is known to be passed, but for those of half circles."""
        self.path = self.machine.path.read(self.out.__getitem__)
        self.refusals: list[Refusal] = []
        self.remarks: list[Note] = []
        self.doubles: dict[int, dict[str, float]] = {}
        self.split = 0.0
        self.stuck: frozenset[Fact] = frozenset()
        """The facts of the step that is singular at these values, if one is."""

    @cached_property
    def measured(self) -> MeasuredFigure:
        """The figure in numbers, which checks of each thing by itself measure."""
        figure = self.system.figure
        return MeasuredFigure(figure, Values({**self.out, **at_origin(figure)}, {}, {}), self.path, self._increment)

    def _increment(self, name: str) -> float:
        return self.inputs[INCREMENT_OF + name]

    def _resize(self, sizes: Mapping[str, float]) -> PathOutputs:
        """The measures of the path for other sizes of corners."""
        return self.machine.path.read(self.machine.function({**self.inputs, **sizes}).__getitem__)

    def answer(self, *, is_proven: bool) -> SystemSolution:
        for number, (step, names) in enumerate(zip(self.machine.steps, self.machine.measures, strict=True)):
            refusal = None if self.is_clear and not step.is_equal else self._examine_step(number, step, names)
            if refusal:
                self.refusals.append(refusal)
                self._compare_all()
                return self._refused()
        sizes = sizes_of(self.profile)
        if self.is_clear:
            self._compare_all()
        else:
            self._judge(MeasuredPath(self.profile, self.measured, sizes, self._resize))
        if self.refusals:
            return self._refused()
        self.remarks += vanishing_lines(self.system.figure, self.path)
        bound = self._error_bound()
        if not bound - self.split <= ERROR_BOUND_WARNING:
            self.remarks.append(Note(NoteKind.SENSITIVE, "", (), {"limit": ERROR_BOUND_WARNING, "actual": bound}))
        agrees = any(remark.kind is NoteKind.WORDS_AGREE for remark in self.remarks)
        return replace(
            solution_at(self.system, self.profile.start, sizes, self.out, self.path.corners),
            status=Status.OVERDETERMINED if agrees else Status.SOLVED,
            remarks=tuple(self.remarks),
            error_bound=bound,
            certificate=self._certificate(bound) if is_proven else None,
        )

    def _judge(self, path: MeasuredPath) -> None:
        """The refusals of a path whose steps have solutions."""
        self.refusals += judge_range(path)
        if self.refusals:
            self._compare_all()
            return
        self._check_equations()
        if not self.refusals:
            self.refusals += judge_path(path)

    def _certificate(self, bound: float) -> Certificate:
        """The proof of the points and the corners, as they are printed."""
        certificate = certify(self.profile, self.system, self.out, bound)
        touches = any(remark.kind is NoteKind.TOUCHES for remark in self.remarks)
        return replace(certificate, gap=0.0) if touches else certificate

    def _refused(self) -> SystemSolution:
        return refused([*self.refusals, *self.remarks])

    def _point(self, name: str) -> Point:
        """A point, counted from the start point."""
        if name == self.system.figure.start:
            return 0.0, 0.0
        return self.out[scalar(name, FIRST)], self.out[scalar(name, SECOND)]

    def _absolute(self, point: Point) -> Point:
        return self.origin[FIRST] + point[FIRST], self.origin[SECOND] + point[SECOND]

    def _examine_step(self, number: int, step: ConstructionStep, names: StepOutputs) -> Refusal | None:
        """The refusal by the first check of a step that fails; whether elements meet that floats cannot tell from
        touching ones is decided on the exact words."""
        for check, margin in check_step(self.measured, step, names, self.out.__getitem__):
            if is_failing(check, margin):
                measures = names.read(self.out.__getitem__)
                refusal = self._refusal(check, number, step, measures)
                if check.stage is not Stage.TOUCHING:
                    return refusal
                decides = not measures.short
                sign, discriminant = decide_meeting(self.profile, self.system, number) if decides else (0, 0.0)
                if sign < 0:
                    off = -discriminant / (2 * measures.radius)
                    return replace(refusal, values={"off_by_mm": off, **self._meeting(step, measures)[1]})
                self._note_double(step, measures, refusal)
        return None

    def _refusal(self, check: Check, number: int, step: ConstructionStep, measures: StepOutputs) -> Refusal:
        """The refusal of a step of which a check fails."""
        if check.kind is RefusalKind.POINT_IS_START:
            at = {scalar(check.subject, axis) for axis in (FIRST, SECOND)}
            facts = (fact for fact in self.system.facts if at & {*self.system.unknowns_of(fact)})
            return Refusal(check.kind, check.subject, tuple(fact.given for fact in facts if fact.given))
        if step.kind is StepKind.AFFINE:
            return self._singular(check, number, step, measures)
        givens, values = self._meeting(step, measures)
        if check.test is Test.ABOVE:
            return Refusal(check.kind, check.subject, givens, {} if step.is_equal else values)
        off = abs(abs(measures.offset) - measures.radius)
        return Refusal(check.kind, check.subject, givens, {"off_by_mm": off, **values})

    def _singular(self, check: Check, number: int, step: ConstructionStep, measures: StepOutputs) -> Refusal:
        self.stuck = frozenset(step.facts)
        off = _contradiction(measures.entries, measures.constants)
        # The words that fixed what this step builds on belong to the reason, too.
        used = {name for fact in step.facts for name in self.system.unknowns_of(fact)} - set(step.unknowns)
        earlier = [
            other.facts
            for other in self.machine.steps[:number]
            if other.kind is StepKind.AFFINE and used & set(other.unknowns)
        ]
        givens = tuple(fact.given for facts in (step.facts, *earlier) for fact in facts if fact.given)
        if abs(off) <= RESIDUAL:
            return Refusal(RefusalKind.NOT_FIXED, check.subject, givens)
        return _refuse(check.kind, check.subject, givens, off_by_mm=abs(off))

    def _meeting(self, step: ConstructionStep, measures: StepOutputs) -> tuple[tuple[str, ...], dict[str, float]]:
        """The words by which a point lies on a line or a circle and on another circle, and what is compared, mm."""
        if step.kind is StepKind.RADIUS:
            return self._givens_of(step.of_circles[0]), {}
        offset, radius = abs(measures.offset), measures.radius
        if step.kind is StepKind.LINE_CIRCLE:
            is_stated = bool(self.profile.words_of([step.of_line])) or not step.of_line.heading
            angles = self._meeting_angles(step, radius) if is_stated else {}
            givens = self._givens_of(step.of_line if is_stated else step.of_circles[0])
            return givens, {"limit": radius, "actual": offset, **angles}
        if step.is_equal:
            return self._givens_of(step.of_circles[0]), {"limit": offset, "actual": radius}
        givens = tuple(given for circle in step.of_circles for given in self._givens_of(circle))
        return givens, self._reach(step, measures.distance)

    def _reach(self, step: ConstructionStep, distance: float) -> dict[str, float]:
        """The distance of the centres of two circles, and the nearest distance at which they would meet, mm."""
        one, other = (self.out[circle.radius] for circle in step.circles)
        limit = one + other if distance >= max(one, other) else abs(one - other)
        return {"limit": limit, "actual": distance, "off_by_mm": abs(distance - limit)}

    def _note_double(self, step: ConstructionStep, measures: StepOutputs, refusal: Refusal) -> None:
        """A double solution, as far as floats can tell: in the error bound, a row that holds the point where it
        is along the direction in which the two solutions part takes the place of its circle's, and how far
        apart they could be is added. `refusal` is what it would be if they did not meet."""
        if not step.is_equal:
            values = self._meeting(step, measures)[1]
            self.remarks.append(Note(NoteKind.TOUCHES, refusal.subject, refusal.givens, values))
        elif measures.short:
            # A circle about the middle of two points is an ordinary half circle; a stated radius may be less than half
            # of its chord within what the words are exact to.
            half, short = abs(measures.offset), measures.short
            values = {"limit": half, "actual": half - short, "off_by_mm": short}
            self.remarks.append(Note(NoteKind.HALF_CIRCLE, refusal.subject, refusal.givens, values))
        point = step.point
        if step.kind is StepKind.LINE_CIRCLE:
            first, second = self._line_direction(step)
        else:
            begin, end = (self._point(center) for center in step.centers)
            length = hypot(end[0] - begin[0], end[1] - begin[1])
            first, second = (begin[1] - end[1]) / length, (end[0] - begin[0]) / length
        row = self.machine.basis.index(step.of_circles[-1])
        self.doubles[row] = {scalar(point, FIRST): first, scalar(point, SECOND): second}
        if not self._is_half_circle(step, measures):
            self.split = max(self.split, (2 * measures.radius * TOUCHING * measures.scale) ** 0.5)

    def _line_direction(self, step: ConstructionStep) -> Point:
        if step.of_line.heading:
            return direction(self.profile.givens[step.of_line.given].value)
        tail, through = map(self._point, next(step.lines_through()))
        length = hypot(through[0] - tail[0], through[1] - tail[1])
        return (through[0] - tail[0]) / length, (through[1] - tail[1]) / length

    def _is_half_circle(self, step: ConstructionStep, measures: StepOutputs) -> bool:
        """Whether the radius is exactly half the chord from the start point, in decimals, or is taken to be."""
        if not step.is_equal:
            return False
        if measures.short:
            return True
        values: dict[tuple[str, int], Decimal] = {}
        radius = Decimal(0)
        for fact in self.system.facts:
            value = self.profile.givens[fact.given].value if fact.given else Decimal(0)
            placed = fact.placed
            if fact.sizes == step.circles[0].radius:
                radius = value
            elif placed and placed.is_stepped and placed.origin in ("", self.system.figure.start):
                values[placed.point, placed.axis] = value - (0 if placed.origin else self.start[placed.axis])
        if step.circles[0].point != self.system.figure.start:
            return False
        chord = [values.get((step.circles[1].point, axis)) for axis in (FIRST, SECOND)]
        return None not in chord and sum(part**2 for part in chord if part is not None) == 4 * radius**2

    def _meeting_angles(self, step: ConstructionStep, radius: float) -> dict[str, float]:
        """Between which angles of travel a line through the known point of the heading meets the circle, degrees."""
        ends, (circle,) = step.of_line.heading, step.circles
        if ends is None:
            return {}
        tail, head = (circle.center, ends[1]) if ends[0] == circle.point else (ends[0], circle.center)
        (a, b), (c, d) = self._point(tail), self._point(head)
        first, second = c - a, d - b
        distance = hypot(first, second)
        if distance <= radius:
            return {}
        middle, half = degrees(atan2(second, first)), degrees(asin(radius / distance))
        return {"angle_from": middle - half, "angle_to": middle + half}

    def _givens_of(self, fact: Fact) -> tuple[str, ...]:
        return givens_of(fact, self.system)

    def _check_equations(self) -> None:
        """All original equations: those solved must hold to rounding, the others as well as words can say."""
        residuals = [self.out[name] for name in self.machine.residuals]
        if not all(abs(residual) <= RESIDUAL for residual in residuals):  # true for NaN
            worst = max(residuals, key=lambda residual: abs(residual) if isfinite(residual) else float("inf"))
            self.refusals.append(unverified(abs(worst)))
            return
        self._compare_all()

    def _compare_all(self) -> None:
        """The facts that were not needed, as far as what they speak about has a value."""
        for fact, name in zip(self.machine.checks, self.machine.compared, strict=True):
            off = abs(self.out[name])
            if isfinite(off):
                self._compare(fact, off)

    def _compare(self, fact: Fact, off: float) -> None:
        """A fact that was not needed, at the points that the others give."""
        points = {name: self._absolute(self._point(name)) for name in self.system.figure.points}
        scalars = {**scalars_of(points), **{name: self.out[name] for name in self.system.figure.radii}}
        event = compare_fact(fact, off, self.profile, self.system, lookup(self.profile, scalars))
        if isinstance(event, Refusal):
            self.refusals.append(event)
        elif event is not None:
            self.remarks.append(event)

    def _error_bound(self) -> float:
        """First-order bound of the error of any unknown, mm, rounded up to one digit.

        Where a double solution was recognised, it is taken as exactly double.
        """
        unknowns = self.system.unknowns
        size = len(unknowns)
        if not size:
            return self.split
        entries = {
            (row, column): self.out[name] for row, column, name in self.machine.slopes if row not in self.doubles
        }
        for row, direction_of in self.doubles.items():
            entries |= {(row, unknowns.index(name)): value for name, value in direction_of.items()}
        largest = max(1.0, *[abs(self.out[name]) for name in unknowns])
        worst = max([abs(self.out[name]) for name in self.machine.residuals])
        bound = inverse_norm(entries, size) * (worst + ROUNDING * largest) + self.split
        return up_to_one_digit(bound) if isfinite(bound) else inf


def _refuse(kind: RefusalKind, subject: str, givens: tuple[str, ...], **values: float) -> Refusal:
    return Refusal(kind, subject, givens, values)


def _contradiction(rows: Sequence[Sequence[float]], constants: Sequence[float]) -> float:
    """By how much a singular affine step of one or two rows contradicts itself, mm.

    The row with the largest entry is solved for, and the other one's residual remains.
    """
    if len(rows) == 1:
        return constants[0]
    lead = max((0, 1), key=lambda row: max(map(abs, rows[row])))
    other = 1 - lead
    column = max((0, 1), key=lambda index: abs(rows[lead][index]))
    return constants[other] - constants[lead] * rows[other][column] / rows[lead][column]
