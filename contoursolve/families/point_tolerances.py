"""Tolerances of a point of a contour: the word that moves it most, to first order and solved again."""

from collections.abc import Iterator, Mapping, Sequence
from decimal import ROUND_HALF_EVEN, Decimal
from math import hypot, isnan, nan
from typing import Unpack

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Answer
from contoursolve.diagnostics import Shown
from contoursolve.families.block_template import BlockOptions, Template, first_error, read_word, spec_of, unit_word
from contoursolve.families.case_classes import premises_of
from contoursolve.families.errors import FamilyError
from contoursolve.families.evaluate import Tally, compile_sweep, solve_sweep
from contoursolve.families.export import Family
from contoursolve.families.free_words import check_block, kind_of, value_of
from contoursolve.families.goals import place_of
from contoursolve.families.results import ResultNames, base_name, coordinate_name, factors_of, read_point
from contoursolve.families.sensitivities import Spread, read_tolerances, slopes_of, stated_words
from contoursolve.families.word_values import ranges_of
from contoursolve.gcode import Word, call
from contoursolve.geometry import PATH_END, Length, Plane, Unit
from contoursolve.numeric import Array
from contoursolve.program import takes
from contoursolve.reading import Premises
from contoursolve.solving import Point, Status

MOST_WORDS = 10
"""Words with a tolerance of which all combinations of limits are solved; each doubles them."""


class Contribution(Struct, frozen=True):
    """Contribution of one word or fact to the move of the point.

    `slope` is by how much it moves on each axis, mm (X as radius) for each unit of the word as written, in `unit` (mm,
    inch or deg); NaN where two places have become one. `tolerance` is what the word may be off by,
    None where nothing was said, and `moves` how far that moves the point to first order, mm. `increment` is the
    control's least increment of the word (None for a fact), and `by_half` how far half of it moves the point at most,
    solved again, None where that has no contour. `rounded` is the value rounded to least increments, and `by_rounding`
    how far that moves the point, solved again, beside `by_rounding_linear` from the derivatives; None where it has no
    contour.
    """

    word: str
    unit: str
    stated: float
    slope: Point
    tolerance: float | None
    moves: float
    increment: float | None
    by_half: float | None
    rounded: float | None
    by_rounding: float | None
    by_rounding_linear: float


class Missing(Struct, frozen=True):
    """Combinations of the limits without a contour for one reason: how many, the values of one of them as written, and
    what `solve` says of that one."""

    count: int
    values: Mapping[str, float]
    message: str


class Limits(Struct, frozen=True):
    """Bounds of the point on each axis, mm, at all combinations of the limits of the tolerances,
    each solved; `without` counts those that have no contour, `missing` says which and why."""

    low: Point
    high: Point
    count: int
    without: int
    missing: tuple[Missing, ...] = ()


class Tolerances(Shown, Struct, frozen=True):
    """Moves of a point of a contour by words.

    Attributes:
        point: the point by its name.
        place: its coordinates, mm, X of a lathe as radius.
        plane: their axes, first and second.
        length: the unit of the program.
        effects: what each word does to the point, the one that moves it most first.
        spread: how far it may be off on each axis to first order, mm.
        limits: where it lies at all combinations of the limits, mm; None without tolerances or with too many of them.
        premises: what the contour assumes besides its words.
    """

    point: str
    place: Point
    plane: Plane
    length: Length
    effects: tuple[Contribution, ...]
    spread: tuple[Spread, Spread]
    limits: Limits | None
    premises: Premises = Premises()


@takes(BlockOptions)
def tolerances(
    block: str,
    allowed: Mapping[str, float] | None = None,
    *,
    point: str = "end",
    **options: Unpack[BlockOptions],
) -> Tolerances:
    """The effect of each word on a point, and of tolerances; see `contoursolve.tolerances`."""
    spec = spec_of(block, **options)
    template = spec.template()
    check_block(template)
    answer = template.solve({})
    found = slopes_of(answer)
    slopes, axes, factors = found.slopes, answer.plane.axes, factors_of(answer.plane)
    names, figure = ResultNames(answer.profile, slopes), answer.profile.figure
    named = read_point(point, names)
    point, name = named.text, base_name(named, figure)
    columns = [coordinate_name(name, axis) for axis in axes]
    if answer.contour is None or any(column not in slopes for column in columns):
        raise FamilyError(f"the contour has no point {point}; there are {', '.join(names.points)}")
    # Points of records have X of a lathe as radius.
    first, second = (
        {word: slope / factor for word, slope in slopes[column].items()}
        for column, factor in zip(columns, factors, strict=True)
    )
    study = _Study(template, answer, point if named == PATH_END else name)
    by_word = {word: (first[word] * study.unit(word), second[word] * study.unit(word)) for word in first}
    allowed = read_tolerances({} if allowed is None else allowed, found.spelled)
    effects = [study.effect(word, slope, allowed.get(word)) for word, slope in by_word.items()]
    effects.sort(key=lambda each: (not isnan(each.moves), -each.moves, -(each.by_half or 0.0)))
    parts = [[abs(by_word[word][axis]) * value for word, value in allowed.items()] for axis in (0, 1)]
    limits = None
    if allowed and len(allowed) <= MOST_WORDS:
        values = {word: study.value(word) for word in allowed}
        vary = {study.name(word): [values[word] - off, values[word] + off] for word, off in allowed.items()}
        grid = solve_sweep(compile_sweep(spec, ranges_of(vary, is_paired=False)))
        # A family without any contour has no points.
        none = numpy.full(len(grid), nan)
        limits = _limits(
            *(grid.columns.get(column, none) / factor for column, factor in zip(columns, factors, strict=True))
        )
        limits = replace(limits, missing=tuple(_missing(template, grid, list(allowed))))
    spread = Spread(sum(parts[0]), hypot(*parts[0])), Spread(sum(parts[1]), hypot(*parts[1]))
    premises = premises_of((), template, [answer.premises])
    return Tolerances(point, study.place, answer.plane, answer.unit, tuple(effects), spread, limits, premises)


def _missing(template: Template, found: Family, words: Sequence[str]) -> Iterator[Missing]:
    """The rows without a contour, each reason once, the most frequent first; `words` are the names to tell."""
    free, tally = template.with_words(list(found.ranges.values)), Tally(tuple(found.ranges.values))
    tally.add({name: found[name].reshape(-1) for name in found.names})
    for kind, values in sorted(tally.firsts.items(), key=lambda each: -tally.counts[each[0]]):
        if kind[0] > Status.OVERDETERMINED.code:
            told = dict(zip(words, values.values(), strict=True))
            yield Missing(int(tally.counts[kind]), told, first_error(free.solve(values)))


def _limits(first: Array, second: Array) -> Limits:
    """The places of a point at all combinations, NaN without one."""
    has = ~numpy.isnan(first)
    count = int(has.sum())
    if not count:
        return Limits((nan, nan), (nan, nan), first.size, first.size)
    low, high = ((float(each(first[has])), float(each(second[has]))) for each in (numpy.min, numpy.max))
    return Limits(low, high, first.size, first.size - count)


class _Study:
    """One point of one contour, and where it is when a word changes."""

    def __init__(self, template: Template, answer: Answer, point: str) -> None:
        self.template, self.answer, self.point = template, answer, point
        at = place_of(point, answer.contour)
        if at is None:
            raise FamilyError(f"{point} is on an element of no length; name another point")
        self.place = at
        self.words = stated_words(answer)

    def _typed(self, word: str) -> Word:
        return self.words[word] if word in self.words else read_word(word, self.template)[1]

    def name(self, word: str) -> str:
        """The name of a word among all words of the text, of which some may stand before the contour."""
        every = [each for block in self.template.program.blocks for each in block.words]
        return call(self.words[word], every) if word in self.words else word

    def value(self, word: str) -> float:
        """The value of a word or a fact, as it would be written with a decimal point."""
        return value_of(self._typed(word), self.answer)

    def unit(self, word: str) -> float:
        """By how many units of a word as written its value changes, for one of it with a decimal point."""
        if word not in self.words:
            return 1.0
        typed = self.words[word]
        if typed.number:
            return float(typed.number) / self.value(word)
        return 1.0 / value_of(unit_word(typed, has_point=typed.has_point), self.answer)

    def effect(self, word: str, slope: Point, tolerance: float | None) -> Contribution:
        """The effect of a word."""
        moves, typed = hypot(*slope) * tolerance if tolerance else 0.0, self.words.get(word)
        lexicon, value = self.answer.claim.lexicon, self.value(word)
        stated = kind_of(self._typed(word), self.answer)[0]
        unit = "deg" if stated is Unit.DEGREE else self.answer.unit.value
        effect = Contribution(word, unit, value, slope, tolerance, moves, None, None, None, None, 0.0)
        if typed is None:
            return effect
        exact, step = Decimal(repr(value)), lexicon.numbers.step(stated, self.answer.unit)
        halves = [self._moved(word, float(exact + way * step / 2)) for way in (-1, 1)]
        rounded = exact.quantize(step, ROUND_HALF_EVEN)
        return replace(
            effect,
            increment=float(step),
            by_half=None if None in halves else max(each for each in halves if each is not None),
            rounded=float(rounded),
            by_rounding=self._moved(word, float(rounded)) if rounded != exact else 0.0,
            by_rounding_linear=hypot(*slope) * float(abs(rounded - exact)),
        )

    def _moved(self, word: str, value: float) -> float | None:
        """The way that the point moves when a word gets another value, mm; None where there is no contour then."""
        at = place_of(self.point, replace(self.template, words={word: self._typed(word)}).solve({word: value}).contour)
        return None if at is None else hypot(at[0] - self.place[0], at[1] - self.place[1])
