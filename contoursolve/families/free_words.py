"""The free words of a block: what they are written in, the limits of the rules between which their values are treated
alike, and one row of each class that the rules may tell apart.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import pairwise, product
from math import prod
from typing import Any

import numpy
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from contoursolve.diagnosis import Answer, join
from contoursolve.diagnostics import Basis
from contoursolve.families.block_template import Template, called, errors_of, first_error, is_same
from contoursolve.families.errors import FamilyError
from contoursolve.families.traced_reading import Alike, Reading, place_of_contour, read_alone, trace_reading
from contoursolve.families.word_values import LONGEST, Places, Ranges, stretches
from contoursolve.gcode import FACT, Word
from contoursolve.geometry import Given, Profile, Unit, names_of_roles
from contoursolve.numeric import Affine, Array
from contoursolve.reading import ParsedContour, ReadIssue, Rule
from contoursolve.solving import Status
from contoursolve.tolerance import LARGEST


def value_of(word: Word, answer: Answer) -> float:
    """The value of a word as it would be written with a decimal point."""
    lexicon = answer.claim.lexicon
    if word.address not in lexicon.addresses:
        return float(word.number or 0)
    one, origin = lexicon.factor(word, answer.unit, has_point=True), lexicon.addresses[word.address].clockwise_from
    return float(((lexicon.value(word, answer.unit) or Decimal(0)) - (origin or 0)) / one)


def kind_of(word: Word, answer: Answer) -> tuple[Unit, bool]:
    """The unit of a word of a block or of the start point, or of a fact, and whether it is a diameter. Raises
    FamilyError where nothing tells, or a fact cannot be read."""
    unread = next((each for each in answer.diagnostics if each.about is ReadIssue.FACT_UNREADABLE), None)
    if unread is not None:
        raise FamilyError(unread.message)
    row = answer.claim.lexicon.addresses.get(word.address) or next(iter(stated_by(word, answer.profile)), None)
    if row is None:
        raise FamilyError(first_error(answer) or f"{word.text} states no value")
    return row.unit, row.is_diameter


def stated_by(typed: Word, profile: Profile) -> list[Given]:
    """The values that follow from a word, wherever it now stands in its line."""
    return [each for each in profile.givens.values() if each.word is not None and is_same(typed, each.word)]


def factor_of(answer: Answer, typed: Word, given: Given, number: Decimal) -> Decimal:
    """The mm or degrees of a value for each unit of the word that states it with this number."""
    if number and given.clockwise_from is None:
        return given.value / number
    if typed.address == FACT:
        half = Decimal("0.5") if given.is_diameter else Decimal(1)
        return half * answer.unit.in_mm if given.unit is Unit.MM else Decimal(1)
    has_point = given.word is None or given.word.has_point
    return answer.claim.lexicon.factor(replace(typed, has_point=has_point), answer.unit)


WIDE = 256
"""Intervals that have a number of one byte."""

SAME = 1e-12
"""Share of a limit by which two that are one may differ."""


class WordLimits(Struct, frozen=True):
    """The mm or degrees for each unit of a word, and the limits of the rules for its values so scaled."""

    scale: float
    bounds: tuple[float, ...]

    @property
    def count(self) -> int:
        """The number of intervals; a bound is an interval of its own."""
        return 2 * len(self.bounds) + 1

    def intervals(self, values: Array) -> NDArray[Any]:
        """The number of the interval in which each value lies."""
        limits, scaled = numpy.array(self.bounds), values * self.scale
        places = numpy.searchsorted(limits, scaled, "left") + numpy.searchsorted(limits, scaled, "right")
        return places.astype(numpy.uint8 if self.count <= WIDE else numpy.int64)

    def bordered(self, value: float) -> "WordLimits":
        """The same with one value of the word more as a limit."""
        bound = value * self.scale
        if any(abs(bound - each) <= SAME * max(1.0, abs(each)) for each in self.bounds):
            return self
        return WordLimits(self.scale, tuple(sorted((*self.bounds, bound))))


def limits_of(template: Template, values: Mapping[str, float]) -> list[WordLimits]:
    """The limits of the rules between which the values of each free word are treated alike, beside the values of the
    others. Raises FamilyError for what is no word of the contour."""
    answer = template.solve(values)
    claim = answer.claim
    found: list[WordLimits] = []
    for name, word in template.words.items():
        limits = {Decimal(0), -Decimal(LARGEST), Decimal(LARGEST)}
        stated = stated_by(word, answer.profile)
        one: Decimal | None = None
        if word.address in claim.lexicon.addresses:
            limits |= set(limits_beside(template.asked.rules, claim, word))
            one = claim.lexicon.factor(word, answer.unit, has_point=True)
        elif word.address != FACT:
            raise FamilyError(f"{word.text} is no word of the contour")
        elif stated:
            one = factor_of(answer, word, stated[0], Decimal(repr(values[name])))
        found.append(WordLimits(float(one or 1), tuple(sorted(map(float, limits)))))
    return found


def bordered(limits: Sequence[WordLimits], words: Sequence[str], borders: Iterable[Affine]) -> list[WordLimits]:
    """The limits of words with those values besides at which one word alone decides how a block is read."""
    found = list(limits)
    for border in borders:
        if len(border.factors) == 1:
            ((word, factor),) = border.factors.items()
            number = words.index(word)
            found[number] = found[number].bordered(float(-border.constant / factor))
    return found


def are_compared(template: Template, claim: ParsedContour) -> bool:
    """Whether a rule compares the values of free words with each other, so that only each row tells what it says."""
    stated = claim.stated()
    free = {name for name, word in claim.words.items() if any(is_same(each, word) for each in template.words.values())}
    return any(
        free.issuperset(calls.get(call, "") for call in pair)
        for role, calls in names_of_roles(claim.form.roles, stated)
        for rule in template.asked.rules
        if role.name in rule.roles and rule.when is not None
        for pair in rule.when.compared({call: stated[name] for call, name in calls.items()})
    )


def limits_beside(rules: Sequence[Rule], claim: ParsedContour, word: Word) -> Iterator[Decimal]:
    """The limits of the rules that hold for some values of a word beside what else the block states."""
    stated = claim.stated()
    own = {name for name, typed in claim.words.items() if is_same(word, typed)}
    for role, calls in names_of_roles(claim.form.roles, stated):
        seen = {call: stated[name] for call, name in calls.items()}
        conditions = [rule.when for rule in rules if role.name in rule.roles and rule.when is not None]
        for call in (call for call, name in calls.items() if name in own):
            for condition in conditions:
                yield from condition.limits(call, seen)


class Example(Struct, frozen=True):
    """A row of a class that the rules or the reading may tell apart: its key, its values, and how many rows are in the
    class. With `is_by_row`, every row of this key is read by itself, and those that are read alike are a class.
    `is_compared` tells that a rule compares the words of each with each other, too. `others` are the values of other
    rows of the key, which are read by themselves, too: those where a word has an extreme, and one between."""

    key: int
    values: tuple[float, ...]
    count: int
    is_by_row: bool = False
    is_compared: bool = False
    others: tuple[tuple[float, ...], ...] = ()


class Examples(Struct, frozen=True):
    """One row of each class that the rules may tell apart, in the order of their keys, as plain data. The intervals in
    which the values of all words lie make the key."""

    limits: tuple[WordLimits, ...]
    rows: tuple[Example, ...]

    def key(self, values: Sequence[Array], places: Sequence[Places]) -> Places:
        """The keys of some rows."""
        words = zip(values, places, self.limits, strict=True)
        return _key_of([limits.intervals(each)[at] for each, at, limits in words], self.limits)

    def keys_of(self, columns: Ranges) -> Places:
        """The keys of the rows of columns."""
        values = columns.values.values()
        return _key_of([limits.intervals(each) for each, limits in zip(values, self.limits, strict=True)], self.limits)


MOST_BY_ROW = 200_000
"""Rows that are read one by one: some minutes."""


def examples_of(template: Template, ranges: Ranges) -> Examples:
    """A row of each class. What decides how a row is read divides the rows until none is left that is read in another
    way than its example. Raises FamilyError."""
    if not ranges.values:
        return Examples((), (Example(0, (), 1),))
    names, known = list(ranges.values), dict[tuple[float, ...], Reading]()
    first = {name: float(values[0]) for name, values in ranges.values.items()}
    limits, is_compared = tuple(limits_of(template, first)), are_compared(template, template.solve(first).claim)
    while True:
        found = _examples_between(limits, ranges)
        for row in found.rows:
            if row.values not in known:
                known[row.values] = reading_of(template, dict(zip(names, row.values, strict=True)))
        alike = (known[row.values] for row in found.rows)
        borders = (border for each in alike if not each.is_by_row for border in each.borders)
        more = tuple(bordered(limits, names, borders))
        if more == limits:
            break
        limits = more
    rest = {
        row.key: row
        for row in found.rows
        if is_compared
        or known[row.values].is_by_row
        or not all(known[row.values].holds(template, dict(zip(names, each, strict=True))) for each in row.others)
    }
    rows = [row for row in found.rows if row.key not in rest]
    rows += _kinds_of(template, ranges, found, rest, is_compared=is_compared) if rest else ()
    return replace(found, rows=tuple(sorted(rows, key=lambda row: row.key)))


def _kinds_of(
    template: Template, ranges: Ranges, found: Examples, rest: Mapping[int, Example], *, is_compared: bool
) -> Iterator[Example]:
    """A row of each kind among the rows of some keys, which are read one by one, with what the rules say of each where
    they compare its words. Raises FamilyError for too many."""
    count = sum(row.count for row in rest.values())
    if count > MOST_BY_ROW:
        told = join([called(name) for name in ranges.values])
        raise FamilyError(
            f"each value of {told} decides how its row is read; these are {count:,} rows, read one by one; "
            f"take at most {MOST_BY_ROW:,}"
        )
    names = list(ranges.values)
    places = {} if is_compared else {key: dict(zip(names, row.values, strict=True)) for key, row in rest.items()}
    likes = {key: place_of_contour(template, values) for key, values in places.items()}
    kinds: dict[tuple[int, Alike], Example] = {}
    for first, last in stretches(ranges.count, LONGEST):
        part = ranges.rows(first, last)
        keys = found.keys_of(part)
        for row in numpy.flatnonzero(numpy.isin(keys, [*rest])).tolist():
            key, values = int(keys[row]), {name: float(column[row]) for name, column in part.values.items()}
            kind = key, read_alone(template, values, likes.get(key), is_kept=True).kind
            before = kinds.get(kind) or Example(key, tuple(values.values()), 0, is_by_row=True, is_compared=is_compared)
            kinds[kind] = replace(before, count=before.count + 1)
    yield from kinds.values()


def reading_of(template: Template, values: Mapping[str, float]) -> Reading:
    """The reading of the row of these values. Raises FamilyError as `Template.solve`."""
    return trace_reading(template, values, template.solve(values))


def _examples_between(limits: tuple[WordLimits, ...], ranges: Ranges) -> Examples:
    """A row for each set of intervals in which the values lie, and others of it that show where it reads otherwise."""
    if prod(each.count for each in limits) >= 2**63:
        raise FamilyError(f"{len(limits)} words are too many to vary at once")
    words = list(ranges.values.values())
    numbers = [each.intervals(values) for each, values in zip(limits, words, strict=True)]
    parts = (
        [_groups(_key_of(numbers, limits), words)]
        if ranges.is_paired
        else [_groups(own, [each], at % 2 + 1) for at, (own, each) in enumerate(zip(numbers, words, strict=True))]
    )
    rows: list[Example] = []
    for choice in product(*parts):
        own, counts, places = zip(*choice, strict=True)
        key = own[0] if ranges.is_paired else int(_key_of(own, limits))
        values, *others = (
            tuple(float(each[at]) for each, at in zip(words, row * (len(words) // len(row)), strict=True))
            for row in zip(*places, strict=True)
        )
        others = [each for each in dict.fromkeys(others) if each != values]
        rows.append(Example(key, values, prod(counts), others=tuple(others)))
    return Examples(limits, tuple(rows))


def _groups(numbers: NDArray[Any], words: Sequence[Array], step: int = 0) -> list[tuple[int, int, list[int]]]:
    """Of each number that rows have: itself, how many have it, and which: the first, the middle one, and those where a
    word is least or greatest; on an axis of a grid twice, by `step` in such an order that extremes of axes meet."""
    order = numpy.argsort(numbers, kind="stable")
    own, starts, counts = numpy.unique(numbers[order], return_index=True, return_counts=True)
    found: list[tuple[int, int, list[int]]] = []
    for number, start, count in zip(own.tolist(), starts.tolist(), counts.tolist(), strict=True):
        rows = order[start : start + count]
        ends = [int(rows[end(values[rows])]) for values in words for end in (numpy.argmin, numpy.argmax)]
        again = (ends if step == 1 else ends[::-1]) if step else []
        found.append((number, count, [int(rows[0]), int(rows[count // 2]), *ends, *again]))
    return found


def _key_of(numbers: Sequence[NDArray[Any]] | tuple[int, ...], limits: Sequence[WordLimits]) -> Places:
    """The numbers of the intervals of all words as one, row by row."""
    return numpy.ravel_multi_index(tuple(numbers), tuple(each.count for each in limits))


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
    limits = zip(chosen, limits_of(template, chosen), strict=True) if chosen else ()
    for name, each in limits:
        for value in _probes(each.bounds):
            tried = {**chosen, name: value / each.scale}
            try:
                found = _refusals(template.solve(tried))
            except FamilyError:  # with this value it is no single contour
                continue
            if _weight(found) < _weight(left):
                left, chosen = found, tried
            if not left:
                return
    raise template.refused(chosen)


def _refusals(answer: Answer) -> Refusals:
    """The errors that refuse a block by its text, its words or the structure of its equations."""
    if answer.status not in _REFUSED:
        return frozenset()
    return frozenset(
        (each.code, each.span.line, each.addresses)
        for each in errors_of(answer)
        if each.basis is not Basis.NUMERICAL or each.about in _USELESS
    )


_REFUSED = (Status.REJECTED, Status.CONFLICTING, Status.UNDERDETERMINED)
"""Statuses that a block may have without its values."""


def _weight(refusals: Refusals) -> tuple[int, int]:
    """The size of refusals: findings, and the words that they name."""
    return len(refusals), sum(len(words) for _, _, words in refusals)


_USELESS = (ReadIssue.FACT_UNREADABLE, ReadIssue.FACT_IMPOSSIBLE)
"""Findings about facts that cannot be used, whatever they rest on."""


def _probes(bounds: tuple[float, ...]) -> Iterator[float]:
    """A value on each limit of the rules and between each two, as far as values are read."""
    inner = [each for each in bounds if abs(each) < LARGEST]
    yield from inner
    # Near the least of them, for what is large may fit nowhere.
    for low, high in pairwise((-LARGEST, *inner, LARGEST)):
        step = min(1.0, (high - low) / 2)
        yield low + step if low >= 0 else high - step
