"""Rows that the rules treat alike, which have one system, one choice of branches, one function: which classes of rows a
case has, and what they have for results.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from decimal import Decimal
from itertools import pairwise, product
from math import isfinite, nan, prod
from typing import Any

import numpy
from numpy.typing import NDArray

from contoursolve.analysis import judge
from contoursolve.backends.chart import Following
from contoursolve.backends.columns import Array, difference, directions
from contoursolve.backends.inputs import COSINE, SINE
from contoursolve.constraints import System, assemble
from contoursolve.diagnostic import Basis
from contoursolve.examine import MOST_CHOICES, Answer, count_choices
from contoursolve.families.spec import (
    FamilyError,
    Places,
    Ranges,
    RefusedError,
    Template,
    errors_of,
    first_error,
    is_same,
    unit_word,
)
from contoursolve.model import FIRST, SECOND, CornerShape, Given, Profile, Question, Start, Unit, scalar
from contoursolve.reading import Trouble
from contoursolve.rules import Rule, Value
from contoursolve.solving import RemarkKind, Solution, Status, is_closed, points_with_two_solutions
from contoursolve.solving.checks import Check, compile_checks
from contoursolve.solving.compile import Machine, compile_system
from contoursolve.solving.numbers import axes_of, inputs_of
from contoursolve.solving.solve import solve
from contoursolve.solving.verdict import Codes, code_of, reason_of
from contoursolve.syntax import FACT, Word
from contoursolve.tolerance import LARGEST

ORIGIN = "origin:"
"""What the inputs for the coordinates of the start point begin with."""

MOST_OPEN = 3
"""Points of which both places are tried in columns."""


Follows = tuple[tuple[str, Following], ...]
"""The values that follow words, by name."""


@dataclass(frozen=True, slots=True, eq=False)
class Input:
    """An input of a function that varies: the values, and the word whose places they have; less those of a word of the
    start point, where it counts from there."""

    word: str
    values: Array
    since: str = ""
    start: Array | None = None

    def fill(self, places: Mapping[str, Places], out: Array) -> None:
        """The values of some rows."""
        numpy.take(self.values, places[self.word], out=out, mode="clip")
        if self.start is not None:
            out[:] = difference(out, self.start[places[self.since]])


@dataclass(frozen=True, slots=True, eq=False)
class CaseClass:
    """Rows that share a profile but for the values of the free words.

    `status` is the verdict where it does not depend on the values. `free` has, by the name of each value that follows
    from a free word, the name of the word, and the mm or degrees for each unit of it. `moves` has, by axis, the word
    that the start point follows, with the mm for each unit of it and where it is for 0. `is_closed` tells that there is
    one function for all rows; without it, every row may have several solutions.
    """

    profile: Profile
    status: Status | None
    free: Mapping[str, tuple[str, Decimal]]
    moves: Mapping[int, tuple[str, Decimal, Decimal]] = field(default_factory=dict)
    is_closed: bool = True

    @property
    def system(self) -> System:
        """The equations."""
        return assemble(self.profile)

    @property
    def open_points(self) -> tuple[str, ...]:
        """The points between whose two places nothing chooses, where each place has a closed form and nothing is said
        twice; none where there are too many."""
        found = _open_points(self.profile)
        is_twice = len(self.system.facts) > len(self.system.unknowns)
        return () if found is None or is_twice or len(found) > MOST_OPEN else found

    @property
    def machine(self) -> Machine:
        """The function of a single solve."""
        return compile_system(self.system)

    @property
    def checks(self) -> tuple[Check, ...]:
        """The checks of a single solve, in their order."""
        return compile_checks(self.system).checks

    def numbers(self) -> dict[str, float]:
        """The inputs of the function that stay."""
        start = {f"{ORIGIN}{axis}": float(value or 0) for axis, value in enumerate(self.profile.start.values)}
        return inputs_of(self.profile, self.system) | start

    @property
    def _counted(self) -> Mapping[str, int]:
        """The axis of each value that is stated as a coordinate, which counts from the start point inside."""
        return axes_of(self.system)

    def columns(self, ranges: Ranges) -> dict[str, Input]:
        """The inputs of the function that vary."""
        found: dict[str, Input] = {}
        counted = self._counted
        for given, (word, factor) in self.free.items():
            values = ranges.values[word] * float(factor)
            if self.profile.givens[given].unit is Unit.DEGREE:
                for name, part in zip((COSINE, SINE), directions(values), strict=True):
                    found[given + name] = Input(word, part)
            elif given not in counted:
                found[given] = Input(word, values)
            elif counted[given] in self.moves:
                found[given] = Input(word, values, self.moves[counted[given]][0], self.begins(counted[given], ranges))
            else:
                found[given] = Input(word, difference(values, float(self.profile.start.values[counted[given]] or 0)))
        for given, axis in counted.items():
            if axis in self.moves and given not in self.free:
                value = float(self.profile.givens[given].value)
                found[given] = Input(self.moves[axis][0], difference(value, self.begins(axis, ranges)))
        moves = {f"{ORIGIN}{axis}": Input(move[0], self.begins(axis, ranges)) for axis, move in self.moves.items()}
        return found | moves

    def follows(self, words: Sequence[str]) -> Follows:
        """The values that follow the free words, and those that count from a start point that does."""
        found = {
            given: Following(words.index(word), float(factor), self.profile.givens[given].unit is Unit.DEGREE)
            for given, (word, factor) in self.free.items()
        }
        for given, axis in self._counted.items():
            if axis in self.moves and given not in self.free:
                word, factor, _ = self.moves[axis]
                found[given] = Following(words.index(word), -float(factor), is_angle=False)
        return tuple(found.items())

    def fixed(self, names: Iterable[str], signs: Mapping[str, float] | None = None) -> list[float]:
        """What a chart of the free words needs besides them, by name; of a value that follows a word, what is added.
        `signs` are inputs that choose a branch."""
        numbers, counted = {**self.numbers(), **(signs or {})}, self._counted
        for given in (*self.free, *counted):
            value = Decimal(0) if given in self.free else self.profile.givens[given].value
            if given in counted:
                start = self.profile.start.values[counted[given]] or Decimal(0)
                value -= self.moves[counted[given]][2] if counted[given] in self.moves else start
            numbers[given] = float(value)
        return [numbers[name] for name in names]

    def begins(self, axis: int, ranges: Ranges) -> Array:
        """The coordinates of the start point at the values of its word, mm."""
        word, factor, base = self.moves[axis]
        return ranges.values[word] * float(factor) + float(base)

    def origin(self, ranges: Ranges, places: Mapping[str, Places]) -> list[Array | float]:
        """The coordinates of the start point in some rows."""
        start = [float(value or 0) for value in self.profile.start.values]
        return [
            self.begins(axis, ranges)[places[self.moves[axis][0]]] if axis in self.moves else start[axis]
            for axis in (0, 1)
        ]

    def at(self, values: Mapping[str, float]) -> Profile:
        """The profile of one row."""
        givens = dict(self.profile.givens)
        for name, (word, factor) in self.free.items():
            givens[name] = replace(givens[name], value=Decimal(repr(values[word])) * factor)
        start = list(self.profile.start.values)
        for axis, (word, factor, base) in self.moves.items():
            start[axis] = Decimal(repr(values[word])) * factor + base
        return replace(self.profile, givens=givens, start=Start((start[0], start[1])))

    def solve(self, values: Mapping[str, float]) -> Solution:
        """A single solve of one row, as `examine` does it, without a proof."""
        from contoursolve.settling import settle  # noqa: PLC0415 - few rows touch

        profile = self.at(values)
        if not self.is_closed:
            return settle(profile).solution
        solution = solve(profile, is_proven=False)
        touches = any(remark.kind is RemarkKind.TOUCHES for remark in solution.remarks)
        if not touches or count_choices(profile) > MOST_CHOICES:
            return solution
        return settle(profile).solution


def value_of(word: Word, answer: Answer) -> float:
    """The value of a word as it would be written with a decimal point."""
    lexicon = answer.claim.lexicon
    if word.address not in lexicon.addresses:
        return float(word.number or 0)
    one = lexicon.value(unit_word(word, has_point=True), answer.unit) or Decimal(1)
    return float((lexicon.value(word, answer.unit) or Decimal(0)) / one)


def unit_of(word: Word, answer: Answer) -> Unit:
    """What a word of a block or of the start point, or a fact, states. Raises FamilyError where nothing tells, or a
    fact cannot be read."""
    unread = next((each for each in answer.diagnostics if each.about is Trouble.FACT_UNREADABLE), None)
    if unread is not None:
        raise FamilyError(unread.message)
    row = answer.claim.lexicon.addresses.get(word.address)
    given = next((each for each in answer.profile.givens.values() if each.word and is_same(word, each.word)), None)
    if row is None and given is None:
        raise FamilyError(first_error(answer) or f"{word.text} states no value")
    return row.unit if row is not None else given.unit if given is not None else Unit.MM


def limits_of(template: Template, values: Mapping[str, float]) -> tuple[list[float], list[tuple[float, ...]]]:
    """For each free word, the mm or degrees for each unit of it, and the limits of the rules, between which its values
    are treated alike. Raises FamilyError where the limits of two words depend on each other."""
    answer = template.solve(values)
    claim, tied = answer.claim, list[str]()
    scales: list[float] = []
    bounds: list[tuple[float, ...]] = []
    for name, word in template.words.items():
        limits = {Decimal(0), -Decimal(LARGEST), Decimal(LARGEST)}
        stated = list(_stated_by(word, answer.profile))
        one: Decimal | None = None
        if word.address in claim.lexicon.addresses:
            limits |= {*_limits(template.dialect.rules)}
            one = claim.lexicon.value(unit_word(word, has_point=True), answer.unit)
        elif word.address != FACT:
            raise FamilyError(f"{word.text} is no word of the contour")
        elif stated:
            one = _factor(answer, word, stated[0], Decimal(repr(values[name])))
        for given in stated:
            if given.name in claim.limits:
                limits.add(claim.limits[given.name])
                tied.append(word.text)
        if not stated and claim.limits and word.address != FACT:
            tied.append(name)
        scales.append(float(one or 1))
        bounds.append(tuple(sorted(map(float, limits))))
    if len(tied) > 1:
        raise FamilyError(
            f"{' and '.join(tied)} are read together, for on which side of its centre the arc ends depends on both: "
            "vary one of them at a time"
        )
    return scales, bounds


def _intervals_of(values: Array, bounds: tuple[float, ...]) -> Codes:
    """The number of the interval between two bounds in which each value lies; a bound is an interval of its own."""
    limits = numpy.array(bounds)
    places = numpy.searchsorted(limits, values, "left") + numpy.searchsorted(limits, values, "right")
    return places.astype(numpy.uint8)


def _limits(rules: Iterable[Rule]) -> Iterable[Decimal]:
    for rule in rules:
        if isinstance(rule.when, Value):
            for limit in (rule.when.least, rule.when.most, rule.when.excluding):
                if limit is not None and limit.is_finite():
                    yield limit


def case_of(template: Template, values: Mapping[str, float], answer: Answer | None = None) -> CaseClass:
    """The class of the row with these values; `answer` is its single solve. Raises FamilyError where a word cannot
    vary."""
    answer = answer or template.solve(values)
    moving = [name for name, word in template.words.items() if not list(_stated_by(word, answer.profile))]
    words = {name: word for name, word in template.words.items() if name not in moving}
    case = case_in(answer, words, values)
    if case.status is not None:
        # What is refused may not even state the value.
        return case
    moves = {axis: move for name in moving for axis, move in _moves(template, values, name, answer)}
    idle = [template.words[name].text for name in moving if name not in [word for word, _, _ in moves.values()]]
    if idle:
        raise FamilyError(f"{idle[0]} cannot vary: the contour has no value of it")
    return replace(case, moves=moves)


def _moves(
    template: Template, values: Mapping[str, float], name: str, answer: Answer
) -> Iterable[tuple[int, tuple[str, Decimal, Decimal]]]:
    """How the start point follows a word, by axis. Raises FamilyError where other values follow it, too."""
    other = template.solve({**values, name: values[name] + 1})
    if {given.name: given.value for given in other.profile.givens.values()} != {
        given.name: given.value for given in answer.profile.givens.values()
    }:
        raise FamilyError(f"{name} cannot vary: words that count from it change, too")
    pairs = zip(answer.start.values, other.start.values, strict=True)
    for axis, (value, changed) in enumerate(pairs):
        if value is not None and changed is not None and value != changed:
            factor = changed - value
            yield axis, (name, factor, value - factor * Decimal(repr(values[name])))


def case_in(answer: Answer, words: Mapping[str, Word], values: Mapping[str, float]) -> CaseClass:
    """The class of a contour that was solved at these values of its free words. Raises FamilyError as `case_of`."""
    profile = answer.profile
    status = _verdict(answer)
    free: dict[str, tuple[str, Decimal]] = {}
    for word, typed in words.items():
        number, stated = Decimal(repr(values[word])), list(_stated_by(typed, profile))
        if not stated and status is None:
            raise FamilyError(f"{typed.text} cannot vary: the contour has no value of it")
        for given in stated:
            free[given.name] = word, _factor(answer, typed, given, number)
    return CaseClass(profile, status, free, is_closed=status is not None or _open_points(profile) == ())


def _open_points(profile: Profile) -> tuple[str, ...] | None:
    """The points between whose two places nothing chooses; None where some have no closed form."""
    system, chosen = assemble(profile), {choice.point for choice in profile.choices}
    if profile.is_extended or not is_closed(system):
        return None
    return tuple(point for point in points_with_two_solutions(system) if point not in chosen)


def _factor(answer: Answer, typed: Word, given: Given, number: Decimal) -> Decimal:
    """The mm or degrees of a value for each unit of the word that states it."""
    if number:
        return given.value / number
    if typed.address == FACT:
        return answer.unit.in_mm if given.unit is Unit.MM and not given.is_diameter else Decimal(1)
    one = unit_word(typed, has_point=given.word is None or given.word.has_point)
    return answer.claim.lexicon.value(one, answer.unit) or Decimal(1)


def _stated_by(typed: Word, profile: Profile) -> Iterable[Given]:
    """The values that follow from a word, wherever it now stands in its line."""
    for given in profile.givens.values():
        if given.word is not None and is_same(typed, given.word):
            yield given


def alike(one: CaseClass, other: CaseClass) -> bool:
    """Whether rows of two classes can be evaluated together."""
    if one.status is not None or other.status is not None:
        return one.status is other.status
    return (
        _drawing(one) == _drawing(other)
        and one.profile.choices == other.profile.choices
        and (one.free, one.moves, _fixed(one)) == (other.free, other.moves, _fixed(other))
        and all(
            axis in one.moves or one.profile.start.values[axis] == other.profile.start.values[axis] for axis in (0, 1)
        )
    )


def _drawing(case: CaseClass) -> object:
    """What is drawn and stated; profiles with further facts have layouts of their own."""
    return case.system if case.profile.is_extended else case.profile.layout


def _fixed(case: CaseClass) -> dict[str, Decimal]:
    return {name: given.value for name, given in case.profile.givens.items() if name not in case.free}


def _verdict(answer: Answer) -> Status | None:
    """The status that all rows of the class have, if the equations are not solved."""
    errors = errors_of(answer)
    is_refused = any(each.basis is Basis.RULE for each in errors)
    system = assemble(answer.profile)
    is_loose = not judge(system).is_determined
    is_structural = is_loose or any(
        each.basis is Basis.STRUCTURAL or each.about is Trouble.CORNER_NEGATIVE for each in errors
    )
    if not is_refused and not is_structural:
        return None
    if answer.status is Status.REJECTED or is_structural or len(system.facts) == len(system.unknowns):
        return answer.status
    raise FamilyError(f"{errors[0].message}; leave out what is said twice, or apply no rules")


Results = Mapping[str, NDArray[Any]]
"""Columns by name."""

Behind = tuple[str, int | None]
"""The output behind a result, and the axis of a coordinate: inside they count from the start point."""


def shown_as(output: str) -> str:
    """The output that has the results."""
    return f"shown:{output}"


def names_of(case: CaseClass) -> dict[str, str]:
    """The names of the results, by the outputs that have them."""
    return {"worst": "residual"} | {shown_as(output): name for name, (output, _) in results_of(case).items()}


def sides_of_choice(case: CaseClass) -> dict[str, int]:
    """The sides that the words choose, by the point: +1 farther or left, -1 nearer or right."""
    shown = case.profile.intersections
    return {choice.point: choice.side.sign for choice in case.profile.choices if choice.given and choice.point in shown}


def results_of(case: CaseClass) -> dict[str, Behind]:
    """The output behind each result, and the axis of a coordinate: inside they count from the start point."""
    figure = case.system.figure
    axes = list(zip((FIRST, SECOND), case.profile.plane.axes, strict=True))
    found: dict[str, tuple[str, int | None]] = {}
    for point in figure.points:
        found |= {f"{point}.{letter}": (scalar(point, axis), axis) for axis, letter in axes}
    found |= {f"{radius}": (radius, None) for radius in figure.radii}
    for corner in figure.corners:
        for place in ("begin", "end", *(("center",) if corner.shape is CornerShape.FILLET else ())):
            for axis, letter in axes:
                found[f"{corner.name}.{place}.{letter}"] = f"{place}:{corner.name}.{axis}", axis
    return found | {f"{element.name}.room": (f"room:{element.name}", None) for element in figure.path}


def asked_of(profile: Profile) -> dict[str, Question]:
    """The values that are asked for, by the names of their columns."""
    found: dict[str, Question] = {}
    for question in profile.questions:
        name = f"asked.{question.word.text.partition('=')[0].rstrip('? ').strip()}"
        found[f"{name} in line {question.word.span.line}" if name in found else name] = question
    return found


def fill_row(case: CaseClass, values: Mapping[str, float], row: int, table: Results) -> None:
    """The results of a single solve in a row."""
    solution = case.solve(values)
    table["status"][row] = code_of(solution.status)
    table["reason"][row] = reason_of(solution.refusals[0].kind if solution.refusals else None)
    if not solution.points:
        for name in (*(name for name in table if name.endswith(".room")), "residual"):
            # A room without points is none.
            table[name][row] = table[name][row] if isfinite(table[name][row]) else nan
        return
    letters = case.profile.plane.axes
    for radius, value in solution.radii.items():
        table[radius][row] = value
    pairs = dict(solution.points)
    del pairs[case.system.figure.start]
    for name, corner in solution.corners.items():
        pairs |= {f"{name}.begin": corner.begin, f"{name}.end": corner.end}
        pairs |= {f"{name}.center": corner.center} if corner.center is not None else {}
    for name, pair in pairs.items():
        for letter, value in zip(letters, pair, strict=True):
            table[f"{name}.{letter}"][row] = value
    touching = {remark.subject for remark in solution.remarks if remark.kind is RemarkKind.TOUCHES}
    for point, side in sides_of_choice(case).items():
        table[f"branch.{point}"][row] = 0 if point in touching else side


@dataclass(frozen=True, slots=True)
class Example:
    """A row of a class that the rules may tell apart: its key, its values, and how many rows have this key."""

    key: int
    values: tuple[float, ...]
    count: int


@dataclass(frozen=True, slots=True)
class Examples:
    """One row of each class that the rules may tell apart, in the order of their keys, as plain data.

    Each word has a scale and bounds: its values, scaled, lie between two bounds or on one, which gives a number; the
    numbers of all words make the key.
    """

    scales: tuple[float, ...]
    bounds: tuple[tuple[float, ...], ...]
    rows: tuple[Example, ...]

    def key(self, values: Sequence[Array], places: Sequence[Places]) -> NDArray[numpy.int64]:
        """The keys of some rows."""
        words = zip(values, places, self.scales, self.bounds, strict=True)
        return _key_of((_intervals_of(each * scale, bounds)[at] for each, at, scale, bounds in words), self.bounds)


def examples_of(template: Template, ranges: Ranges) -> Examples:
    """A row for each set of intervals in which the values lie. Raises FamilyError."""
    scales, bounds = limits_of(template, {name: float(values[0]) for name, values in ranges.values.items()})
    if prod(2 * len(limits) + 1 for limits in bounds) >= 2**63:
        raise FamilyError(f"{len(bounds)} words are too many to vary at once")
    words = list(ranges.values.values())
    parts = [_intervals_of(values * scale, limits) for values, scale, limits in zip(words, scales, bounds, strict=True)]
    columns = [_key_of(parts, bounds)] if ranges.is_paired else parts
    rows: list[Example] = []
    for choice in product(*(zip(*_unique(each), strict=True) for each in columns)):
        numbers, firsts, counts = zip(*choice, strict=True)
        places = firsts * len(words) if ranges.is_paired else firsts
        key = numbers[0] if ranges.is_paired else int(_key_of(numbers, bounds)[0])
        rows.append(Example(key, tuple(float(each[at]) for each, at in zip(words, places, strict=True)), prod(counts)))
    return Examples(tuple(scales), tuple(bounds), tuple(rows))


def _key_of(numbers: Iterable[NDArray[Any] | int], bounds: Sequence[tuple[float, ...]]) -> NDArray[numpy.int64]:
    """The numbers of the intervals of all words as one, row by row."""
    key = numpy.zeros(1, numpy.int64)
    for each, limits in zip(numbers, bounds, strict=True):
        key = key * (2 * len(limits) + 1) + each
    return key


def _unique(numbers: NDArray[Any]) -> tuple[list[int], list[int], list[int]]:
    """Numbers in order, each once, with the first place and the count of each."""
    found, firsts, counts = numpy.unique(numbers, return_index=True, return_counts=True)
    return found.tolist(), firsts.tolist(), counts.tolist()


def cases_of(template: Template, examples: Examples) -> tuple[tuple[CaseClass, ...], NDArray[numpy.int64]]:
    """The classes of the example rows, each once, and the number of the class of each example. Raises FamilyError."""
    items: list[CaseClass] = []
    numbers: list[int] = []
    for row in examples.rows:
        case = case_of(template, dict(zip(template.words, row.values, strict=True)))
        numbers.append(next((number for number, each in enumerate(items) if alike(each, case)), len(items)))
        items += [case] if numbers[-1] == len(items) else []
    return tuple(items), numpy.array(numbers, numpy.int64)


Refusals = frozenset[tuple[str, int, tuple[str, ...]]]
"""Findings by code, line and words."""


def check_block(template: Template, values: Mapping[str, float] | None = None) -> None:
    """Raise RefusedError where a block is refused whatever the values of its free words; `values` are those of one row,
    without it those that the words have in the block.

    Rules treat the values between two of their limits alike. Word by word, the value with the fewest refusals is
    taken; what then is left does not depend on the values.
    """
    answer = template.solve(values or {})
    left = _refusals(answer)
    if not left:
        return
    chosen = dict(values or {name: value_of(word, answer) for name, word in template.words.items()})
    limits = zip(chosen, *limits_of(template, chosen), strict=True) if chosen else ()
    for name, scale, bounds in limits:
        for value in _probes(bounds):
            tried = {**chosen, name: value / scale}
            try:
                found = _refusals(template.solve(tried))
            except FamilyError:  # with this value it is no single contour
                continue
            if _weight(found) < _weight(left):
                left, chosen = found, tried
            if not left:
                return
    raise RefusedError(template.examined())


def _refusals(answer: Answer) -> Refusals:
    """What refuses a block by its text, its words or the structure of its equations."""
    if answer.status not in _REFUSED:
        return frozenset()
    return frozenset(
        (each.code, each.span.line, each.addresses)
        for each in errors_of(answer)
        if each.basis is not Basis.NUMERICAL or each.about in _USELESS
    )


_REFUSED = (Status.REJECTED, Status.CONFLICTING, Status.UNDERDETERMINED)
"""What a block may be without its values."""


def _weight(refusals: Refusals) -> tuple[int, int]:
    """How much is refused: findings, and the words that they name."""
    return len(refusals), sum(len(words) for _, _, words in refusals)


_USELESS = (Trouble.FACT_UNREADABLE, Trouble.FACT_IMPOSSIBLE)
"""Findings about facts that cannot be used, whatever they rest on."""


def _probes(bounds: tuple[float, ...]) -> Iterator[float]:
    """A value on each limit of the rules and between each two, as far as values are read."""
    inner = [each for each in bounds if abs(each) < LARGEST]
    yield from inner
    # Near the least of them, for what is large may fit nowhere.
    for low, high in pairwise((-LARGEST, *inner, LARGEST)):
        step = min(1.0, (high - low) / 2)
        yield low + step if low >= 0 else high - step
