"""Rows that the rules treat alike, which have one system, one choice of branches, one function: how its inputs follow
the free words, and what its results are.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import pairwise, product
from math import isfinite, nan
from typing import Any, NamedTuple

import numpy
from msgspec import Struct, field
from msgspec.structs import replace
from numpy.typing import NDArray

from contoursolve.diagnosis import MOST_CHOICES, Answer, count_choices, counted_text, join
from contoursolve.diagnostics import Basis
from contoursolve.families.block_template import Template, called, errors_of
from contoursolve.families.errors import ByRowError, FamilyError
from contoursolve.families.free_words import bordered, factor_of, kind_of, limits_of, stated_by, value_of
from contoursolve.families.results import ASKED, RESIDUAL, ROOM, coordinate_name, factors_of
from contoursolve.families.traced_reading import OWN, Alike, Reading, placed_of, trace_reading
from contoursolve.families.word_values import Places, Ranges, read_limits
from contoursolve.gcode import FACT, Word
from contoursolve.geometry import FIRST, SECOND, CornerShape, Profile, Question, Start, System, Unit, assemble, scalar
from contoursolve.numeric import COSINE, SINE, Affine, Array, Following, difference, directions
from contoursolve.reading import ParsedContour, Premises, ReadIssue, join_premises
from contoursolve.solving import (
    Checked,
    Construction,
    Enumeration,
    NoteKind,
    Status,
    SystemSolution,
    analyse,
    axes_of,
    compile_checks,
    compile_path,
    compile_system,
    inputs_of,
    is_closed,
    points_with_two_solutions,
    reason_of,
    solve,
)
from contoursolve.tolerance import LARGEST

ORIGIN = "origin:"
"""Prefix of the inputs for the coordinates of the start point."""

Follows = tuple[tuple[str, Following], ...]
"""The values that follow words, by name."""


class Linear(Struct, frozen=True):
    """A value that follows a word: the mm or degrees for each unit of the word, and the value for 0."""

    word: str
    factor: Decimal
    base: Decimal = Decimal(0)

    def at(self, values: Mapping[str, float]) -> Decimal:
        """The value in one row."""
        found = Decimal(repr(values[self.word])) * self.factor
        return found + self.base if self.base else found

    def column(self, values: Mapping[str, Array]) -> Array:
        """The values at all values of the word."""
        found = values[self.word] * float(self.factor)
        return found + float(self.base) if self.base else found


class Input(Struct, frozen=True, eq=False):
    """An input of a function that varies: the values, and the word whose places they have; less those of the start
    point where it counts from there, and the word that this follows."""

    word: str
    values: Array
    since: str = ""
    start: Array | None = None

    def fill(self, places: Mapping[str, Places], out: Array) -> None:
        """The values of some rows."""
        numpy.take(self.values, places[self.word], out=out, mode="clip")
        if self.start is not None:
            out[:] = difference(out, self.start[places[self.since]])


class CaseClass(Struct, frozen=True, eq=False):
    """Rows that share a profile but for the values of the free words.

    `status` is the verdict where it does not depend on the values. `free` has the values that follow a free word, by
    name; `moves` has the coordinates of the start point that do, by axis. `is_closed` tells that there is one function
    for all rows; without it, every row may have several solutions.
    """

    profile: Profile
    status: Status | None
    free: Mapping[str, Linear]
    moves: Mapping[int, Linear] = field(default_factory=dict)
    is_closed: bool = True
    premises: Premises = Premises()
    """Premises of its contours beside the words."""

    @property
    def system(self) -> System:
        """The equations."""
        return assemble(self.profile)

    @property
    def machine(self) -> Construction:
        """The function of a single solve."""
        return compile_system(self.system)

    @property
    def checked(self) -> Checked:
        """The checks of a single solve."""
        return compile_checks(self.system)

    def numbers(self) -> dict[str, float]:
        """The inputs of the function that stay."""
        start = {f"{ORIGIN}{axis}": self.start(axis) for axis in (FIRST, SECOND)}
        return inputs_of(self.profile, self.system) | start

    def start(self, axis: int) -> float:
        """A coordinate of the start point as it stands in the profile, mm."""
        return float(self.profile.start.values[axis] or 0)

    def _varying(self) -> Iterator[tuple[str, Linear | None, Linear | Decimal | None]]:
        """The inputs that vary, by name: what each follows, and for a coordinate where the start point is, from which
        it counts inside. One that is stated varies with a start point that does."""
        start = [self.moves.get(axis, value or Decimal(0)) for axis, value in enumerate(self.profile.start.values)]
        axes = axes_of(self.system)
        yield from ((name, own, start[axes[name]] if name in axes else None) for name, own in self.free.items())
        yield from (
            (name, None, start[axis]) for name, axis in axes.items() if axis in self.moves and name not in self.free
        )

    def columns(self, ranges: Ranges) -> dict[str, Input]:
        """The inputs of the function that vary."""
        values = ranges.values
        found = {f"{ORIGIN}{axis}": Input(each.word, each.column(values)) for axis, each in self.moves.items()}
        for name, own, start in self._varying():
            given = self.profile.givens[name]
            if isinstance(start, Linear):
                begins = start.column(values)
                if own is None:
                    found[name] = Input(start.word, difference(float(given.value), begins))
                else:
                    found[name] = Input(own.word, own.column(values), start.word, begins)
            elif own is not None and given.unit is Unit.DEGREE:
                for part, column in zip((COSINE, SINE), directions(own.column(values)), strict=True):
                    found[name + part] = Input(own.word, column)
            elif own is not None:
                column = own.column(values)
                found[name] = Input(own.word, column if start is None else difference(column, float(start)))
        return found

    def along(self, word: str) -> "CaseClass":
        """The class with one free word alone, the others as they are in its profile."""
        free = {name: each for name, each in self.free.items() if each.word == word}
        moves = {axis: each for axis, each in self.moves.items() if each.word == word}
        return replace(self, free=free, moves=moves)

    def follows(self) -> Follows:
        """The inputs that vary, as they follow the one free word."""
        found: dict[str, Following] = {}
        for name, own, start in self._varying():
            factor = own.factor if own is not None else Decimal(0)
            factor -= start.factor if isinstance(start, Linear) else 0
            is_angle = own is not None and self.profile.givens[name].unit is Unit.DEGREE
            found[name] = Following(float(factor), is_angle)
        return tuple(found.items())

    def fixed(self, names: Iterable[str], signs: Mapping[str, float] | None = None) -> list[float]:
        """The numbers that a chart of the free word needs besides it, by name; of a value that follows a word, its
        constant. `signs` are inputs that choose a branch."""
        numbers = {**self.numbers(), **(signs or {})}
        for name, own, start in self._varying():
            value = self.profile.givens[name].value if own is None else own.base
            value -= start.base if isinstance(start, Linear) else start or Decimal(0)
            numbers[name] = float(value)
        return [numbers[name] for name in names]

    def origin(self, values: Mapping[str, Array]) -> list[Array | float]:
        """The coordinates of the start point in rows of these values."""
        return [self.moves[axis].column(values) if axis in self.moves else self.start(axis) for axis in (FIRST, SECOND)]

    def at(self, values: Mapping[str, float]) -> Profile:
        """The profile of one row."""
        givens = {name: replace(self.profile.givens[name], value=each.at(values)) for name, each in self.free.items()}
        first, second = (
            self.moves[axis].at(values) if axis in self.moves else value
            for axis, value in enumerate(self.profile.start.values)
        )
        return replace(self.profile, givens={**self.profile.givens, **givens}, start=Start((first, second)))

    def solve(self, values: Mapping[str, float], enumeration: Enumeration | None = None) -> SystemSolution:
        """A single solve of one row, as `examine` does it, without a proof; `enumeration` has its solutions if they
        are known."""
        from contoursolve.solving import place_cuts, settle  # noqa: PLC0415 - not every class solves a row alone

        profile = self.at(values)
        if not self.is_closed:
            # After a search the reason is the same, whichever facts are to blame.
            is_lost = enumeration is not None and enumeration.within is not None and enumeration.is_complete
            is_blaming = not is_lost or bool(enumeration and enumeration.found)
            settlement = settle(profile, is_blaming=is_blaming, enumeration=enumeration)
            placed, cuts = place_cuts(profile, settlement.loose) if settlement.loose else (profile, ())
            return settle(placed).solution if cuts else settlement.solution
        solution = solve(profile, is_proven=False)
        touches = any(remark.kind is NoteKind.TOUCHES for remark in solution.remarks)
        if not touches or count_choices(profile) > MOST_CHOICES:
            return solution
        return settle(profile).solution

    def words(self, givens: Iterable[str]) -> str:
        """The words that state values, the free ones without their numbers."""
        texts = []
        for name in givens:
            given = self.profile.givens.get(name)
            if name in self.free:
                texts.append(called(self.free[name].word))
            elif given is not None and given.word is not None:
                value = counted_text(given, self.profile.unit) if given.unit is not Unit.SIGN else ""
                texts.append(given.word.text + f" (read as {value})" * bool(value))
        return join(list(dict.fromkeys(texts)))

    def is_like(self, other: "CaseClass") -> bool:
        """Whether rows of two classes can be evaluated together."""
        if self.status is not None or other.status is not None:
            return self.status is other.status
        starts = zip(self.profile.start.values, other.profile.start.values, strict=True)
        return (
            self._drawing == other._drawing
            and (self.profile.choices, self.profile.picks) == (other.profile.choices, other.profile.picks)
            and (self.free, self.moves, self._stays) == (other.free, other.moves, other._stays)
            and all(axis in self.moves or one == two for axis, (one, two) in enumerate(starts))
        )

    @property
    def _drawing(self) -> object:
        """The equations, or the layout; profiles with further facts have layouts of their own."""
        return self.system if self.profile.is_extended else self.profile.layout

    @property
    def _stays(self) -> dict[str, Decimal]:
        return {name: given.value for name, given in self.profile.givens.items() if name not in self.free}


def case_of(
    template: Template, values: Mapping[str, float], answer: Answer | None = None, *, is_sampled: bool = False
) -> CaseClass:
    """The class of the row with these values; `answer` is its single solve. Raises FamilyError where a word cannot
    vary, and where only each row itself tells how it is read: `is_sampled` tells that others were read, too, as far as
    their values follow the words."""
    answer = answer or template.solve(values)
    status = verdict_of(answer)
    if status is not None:
        # What is refused may not even state the value.
        return CaseClass(answer.profile, status, {})
    reading = trace_reading(template, values, answer)
    if reading.is_by_row and not (is_sampled and reading.is_followed):
        names = join([called(name) for name in template.words])
        raise ByRowError(f"each value of {names} decides how the block is read; {INSTEAD}")
    following = {word for each in (*reading.givens.values(), *reading.start.values()) for word in each.factors}
    facts = {name: word for name, word in template.words.items() if word.address == FACT}
    for name, word in template.words.items():
        if name not in following and not (name in facts and stated_by(word, answer.profile)):
            raise FamilyError(f"{word.text} cannot vary: the contour has no value of it")
    free = {name: _linear(each) for name, each in reading.givens.items()}
    free |= case_in(answer, facts, values).free
    moves = {axis: _linear(each) for axis, each in reading.start.items()}
    return replace(case_in(answer, {}, values), free=free, moves=moves)


def _linear(value: Affine) -> Linear:
    ((word, factor),) = value.factors.items()
    return Linear(word, factor, value.constant)


INSTEAD = "solve it value by value with `contoursolve family`"
"""The remedy where no range can be told."""


class ByRow(Struct, frozen=True, eq=False):
    """The way in which the rows of one key are read one by one: the contour at whose place, none if all of the program
    is read; and the number of the class of each kind of reading."""

    like: ParsedContour | None
    classes: dict[Alike, int]


def case_alone(template: Template, values: Mapping[str, float]) -> CaseClass:
    """The class of rows that are read as the one with these values, whatever numbers each of them states."""
    answer = template.solve(values)
    facts = {name: word for name, word in template.words.items() if word.address == FACT}
    case = case_in(answer, facts, values)
    if case.status is not None:
        return case
    begins = enumerate(answer.start.values)
    moves = {axis: Linear(f"{OWN}start {axis}", Decimal(1)) for axis, value in begins if value is not None}
    stated = (*answer.claim.givens, *placed_of(answer))
    free = {name: Linear(OWN + name, Decimal(1)) for name in stated}
    return replace(case, free={**case.free, **free}, moves=moves)


def case_in(answer: Answer, words: Mapping[str, Word], values: Mapping[str, float]) -> CaseClass:
    """The class of a contour that was solved at these values of its free words. Raises FamilyError as `case_of`."""
    profile = answer.profile
    status = verdict_of(answer)
    free: dict[str, Linear] = {}
    for word, typed in words.items():
        stated = stated_by(typed, profile)
        if not stated and status is None:
            raise FamilyError(f"{typed.text} cannot vary: the contour has no value of it")
        number = Decimal(repr(values[word]))
        free |= {
            given.name: Linear(word, factor_of(answer, typed, given, number), given.clockwise_from or Decimal(0))
            for given in stated
        }
    is_closed = status is not None or has_one_function(profile)
    return CaseClass(profile, status, free, is_closed=is_closed, premises=answer.premises)


def has_one_function(profile: Profile) -> bool:
    """Whether words choose all that is between two places, and each place has a closed form."""
    system, chosen = assemble(profile), {choice.point for choice in profile.choices}
    return not profile.is_extended and is_closed(system) and chosen.issuperset(points_with_two_solutions(system))


def verdict_of(answer: Answer) -> Status | None:
    """The status that all rows of the class have, if the equations are not solved."""
    errors = errors_of(answer)
    # A word that is trusted and not there refuses no block.
    is_refused = any(each.basis is Basis.RULE and each.about is not ReadIssue.TRUSTED_ABSENT for each in errors)
    # A rule by which a word is ignored tells in numbers what the others make of it.
    is_refused = is_refused or (bool(answer.profile.ignored) and answer.status is Status.REJECTED)
    system = assemble(answer.profile)
    is_loose = not analyse(system).is_determined
    is_structural = is_loose or any(
        each.basis is Basis.STRUCTURAL or each.about is ReadIssue.CORNER_NEGATIVE for each in errors
    )
    if not is_refused and not is_structural:
        return None
    if answer.status is Status.REJECTED or is_structural or len(system.facts) == len(system.unknowns):
        return answer.status
    raise FamilyError(f"{errors[0].message}; leave out what is said twice, or apply no rules")


def premises_of(cases: Iterable[CaseClass], template: Template, more: Iterable[Premises] = ()) -> Premises:
    """The premises of the contours of classes beside their words, without those that are refused."""
    control = template.asked.control
    several = (*more, *(case.premises for case in cases if case.status is None))
    return join_premises(several, control.name if control is not None else "")


class FreeWords:
    """The free words of one block: what they are written in, the limits of the rules between which their values are
    treated alike, and single solves at any values of them."""

    def __init__(self, template: Template) -> None:
        self.template, self.names = template, tuple(template.words)
        self.answer = template.solve({})
        """Of the block as it stands."""
        words = template.words.values()
        self.values = tuple(value_of(word, self.answer) for word in words)
        self._limits = limits_of(template, dict(zip(self.names, self.values, strict=True)))
        self.scales = [abs(each.scale) for each in self._limits]
        """mm or degrees for each unit of the words."""
        stated = [kind_of(word, self.answer) for word in words]
        self.kinds, self.diameters = [kind for kind, _ in stated], [is_diameter for _, is_diameter in stated]
        self.units = ["deg" if kind is Unit.DEGREE else self.answer.unit.value for kind in self.kinds]
        self._answers = {self.values: self.answer}
        self._cases: list[CaseClass] = []
        self.is_sampled = False
        """Whether it was looked at many values how the block is read, which each decides."""
        self.doubts: list[str] = []
        """What is not proven, and why; empty if everything is."""

    def at(self, values: Sequence[float]) -> dict[str, float]:
        """Values by the names of the words."""
        return dict(zip(self.names, map(float, values), strict=True))

    def answer_at(self, *values: float) -> Answer:
        """The single solve at these values."""
        if values not in self._answers:
            self._answers[values] = self.template.solve(self.at(values))
        return self._answers[values]

    def is_solved(self, *values: float) -> bool:
        """Whether the single solve at these values has a contour."""
        return self.answer_at(*values).contour is not None

    def case_at(self, *values: float) -> CaseClass:
        """The class of the row with these values."""
        case = case_of(self.template, self.at(values), self.answer_at(*values), is_sampled=self.is_sampled)
        self._cases.append(case)
        return case

    @property
    def premises(self) -> Premises:
        """Premises of the contours that were looked at."""
        own = [self.answer.premises] if self.answer.contour is not None else []
        return premises_of(self._cases, self.template, own)

    def limits_within(self, number: int, within: tuple[float, float]) -> tuple[float, float]:
        """The range in which a word is looked at. Raises FamilyError for one that is none."""
        return read_limits(self.names[number], within, LARGEST / self.scales[number], self.units[number])

    def marks(self, within: Sequence[tuple[float, float]]) -> list[list[float]]:
        """The ends of a range of each word, and in it the limits of the rules and what else decides how it is read."""
        known: dict[tuple[float, ...], Reading] = {}
        while True:
            marks = [
                [low, *(each for bound in limits.bounds if low < (each := bound / limits.scale) < high), high]
                for limits, (low, high) in zip(self._limits, within, strict=True)
            ]
            middles = [tuple((low + high) / 2 for low, high in cell) for cell in product(*map(pairwise, marks))]
            for middle in middles:
                if middle not in known:
                    known[middle] = trace_reading(self.template, self.at(middle), self.answer_at(*middle))
            alike = (known[middle] for middle in middles)
            borders = (border for each in alike if not each.is_by_row for border in each.borders)
            more = bordered(self._limits, self.names, borders)
            if more == self._limits:
                return marks
            self._limits = more


# Results ---------------------------------------------------------------------------------------------------------

Results = Mapping[str, NDArray[Any]]
"""Columns by name."""


class ShownOutput(NamedTuple):
    """The output behind a result, the axis of a coordinate, as inside they count from the start point, and by how much
    larger the number is that a person reads: a diameter."""

    output: str
    axis: int | None = None
    factor: int = 1


def shown_as(output: str) -> str:
    """The output that has the results."""
    return f"shown:{output}"


def names_of(case: CaseClass) -> dict[str, str]:
    """The names of the results, by the outputs that have them."""
    return {case.checked.worst: RESIDUAL} | {shown_as(each.output): name for name, each in results_of(case).items()}


def sides_of_choice(case: CaseClass) -> dict[str, int]:
    """The sides that the words choose, by the point: +1 farther or left, -1 nearer or right."""
    shown = case.profile.intersections
    return {choice.point: choice.side.sign for choice in case.profile.choices if choice.given and choice.point in shown}


def results_of(case: CaseClass) -> dict[str, ShownOutput]:
    """The output behind each result."""
    figure, path = case.system.figure, compile_path(case.system).path
    plane = case.profile.plane
    axes = list(zip((FIRST, SECOND), plane.axes, factors_of(plane), strict=True))
    found: dict[str, ShownOutput] = {}
    for point in figure.points:
        for axis, letter, factor in axes:
            found[coordinate_name(point, letter)] = ShownOutput(scalar(point, axis), axis, factor)
    found |= {f"{radius}": ShownOutput(radius) for radius in figure.radii}
    for corner in figure.corners:
        for place in ("begin", "end", *(("center",) if corner.shape is CornerShape.FILLET else ())):
            for axis, letter, factor in axes:
                output = getattr(path.corners[corner.name], place)[axis]
                found[coordinate_name(f"{corner.name}.{place}", letter)] = ShownOutput(output, axis, factor)
    return found | {f"{element.name}{ROOM}": ShownOutput(path.rooms[element.name]) for element in figure.path}


def asked_of(profile: Profile) -> dict[str, Question]:
    """The values that are asked for, by the names of their columns."""
    found: dict[str, Question] = {}
    for question in profile.questions:
        name = f"{ASKED}{question.word.text.partition('=')[0].rstrip('? ').strip()}"
        found[f"{name} in program line {question.word.span.line}" if name in found else name] = question
    return found


def fill_row(case: CaseClass, values: Mapping[str, float], row: int, table: Results) -> None:
    """The results of a single solve in a row."""
    solution = case.solve(values)
    table["status"][row] = solution.status.code
    table["reason"][row] = reason_of(solution.refusals[0].kind if solution.refusals else None)
    if not solution.points:
        for name in (*(name for name in table if name.endswith(ROOM)), RESIDUAL):
            # A room without points is none.
            table[name][row] = table[name][row] if isfinite(table[name][row]) else nan
        return
    letters, factors = case.profile.plane.axes, factors_of(case.profile.plane)
    for radius, value in solution.radii.items():
        table[radius][row] = value
    pairs = dict(solution.points)
    del pairs[case.system.figure.start]
    for name, corner in solution.corners.items():
        pairs |= {f"{name}.begin": corner.begin, f"{name}.end": corner.end}
        pairs |= {f"{name}.center": corner.center} if corner.center is not None else {}
    for name, pair in pairs.items():
        for letter, value, factor in zip(letters, pair, factors, strict=True):
            table[coordinate_name(name, letter)][row] = value * factor
    touching = {remark.subject for remark in solution.remarks if remark.kind is NoteKind.TOUCHES}
    for point, side in sides_of_choice(case).items():
        table[f"branch.{point}"][row] = 0 if point in touching else side
