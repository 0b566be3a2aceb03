"""By how much each word of a block moves each coordinate of its contour, which word moves a point most, and what
tolerances come to: to first order and solved again.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from decimal import ROUND_HALF_EVEN, Decimal
from functools import lru_cache
from itertools import product
from math import hypot, inf, isnan, nan, pi

import numpy

from contoursolve.analysis import judge
from contoursolve.backends.angle import direction
from contoursolve.backends.inputs import COSINE, SIDE, SINE, lookup
from contoursolve.backends.intervals import Array
from contoursolve.backends.numeric import Compiled, Tape
from contoursolve.constraints import System, assemble
from contoursolve.dialects import Dialect
from contoursolve.examine import Answer
from contoursolve.families.case_classes import CaseClass, case_in, check_block, results_of, unit_of, value_of
from contoursolve.families.evaluate import compile_sweep, solve_sweep
from contoursolve.families.export import Family
from contoursolve.families.spec import FamilyError, Template, call, find_words, first_error, ranges_of, spec_of
from contoursolve.families.targets import end_name, place_of
from contoursolve.model import FIRST, SECOND, Given, Length, Plane, Profile, Unit, scalar
from contoursolve.shown import Shown
from contoursolve.solving import Point, RemarkKind, Solution, Status
from contoursolve.solving.compile import compile_path
from contoursolve.solving.plan import TwoCirclesStep
from contoursolve.solving.verdict import Code
from contoursolve.syntax import Word
from contoursolve.tolerance import RESIDUAL, TOUCHING

SINGULAR = 1e-9
"""mm for each mm or degree. A word that changes the gap between two circles by less keeps them touching."""

MOST_WORDS = 10
"""Words with a tolerance of which all combinations of limits are solved; each doubles them."""


SINGULAR_CONDITION = 1e12
"""1. Condition of the equations, each unknown in mm, above which they are taken for singular."""


class Implicit:
    """The derivatives of all numbers of one solved contour by everything that is stated of it."""

    def __init__(self, profile: Profile, solution: Solution) -> None:
        self.profile, self.system = profile, assemble(profile)
        self.tape, self.equations = _compile(self.system)
        self.inputs = tuple(name for name in self.tape.inputs if name not in self.system.unknowns)
        self.values = _values(profile, solution, self.tape.inputs)
        self.unknowns = self._unknowns()

    def _unknowns(self) -> Array:
        """The rates of the unknowns by the inputs: the Jacobian's inverse times the derivatives by the inputs."""
        names, size = self.system.unknowns, len(self.system.unknowns)
        slopes = self._with_signs()
        matrix = numpy.array([[slopes[f"{row} by {name}"] for name in names] for row in range(size)])
        right = numpy.array([[slopes[f"{row} by {name}"] for name in self.inputs] for row in range(size)])
        if not numpy.linalg.cond(matrix) < SINGULAR_CONDITION:  # true for NaN
            raise FamilyError("two solutions have become one, so that no derivative exists")
        found: Array = -numpy.linalg.solve(matrix, right.reshape(size, len(self.inputs)))
        return found

    def _with_signs(self) -> dict[str, float]:
        """The derivatives of the equations on the sides on which they hold."""
        sides = [name for name in self.tape.inputs if name.startswith(SIDE)]
        basis = [f"{row}" for row in range(len(self.system.unknowns))]
        outputs = self.tape.finish()
        for signs in product((1.0, -1.0), repeat=len(sides)):
            values = self.values | dict(zip(sides, signs, strict=True))
            if all(abs(outputs(values)[row]) <= 10 * RESIDUAL for row in basis):
                return self.equations(values)
        raise FamilyError("the equations do not hold at the points of the contour to nine decimals")

    def rates(self, outputs: Iterable[str]) -> dict[str, dict[str, float]]:
        """The derivatives of some outputs by the inputs: of unknowns, and of what follows from them on the path."""
        machine, found = compile_path(self.system), dict[str, dict[str, float]]()
        places = {name: row for row, name in enumerate(self.system.unknowns)}
        wanted = [name for name in outputs if name not in places]
        read = machine.tape.inputs
        values = {name: self._path_value(name) for name in read}
        slopes = machine.tape.slopes(wanted, read)(values) if wanted else {}
        for name in outputs:
            if name in places:
                found[name] = dict(zip(self.inputs, self.unknowns[places[name]].tolist(), strict=True))
                continue
            total = numpy.zeros(len(self.inputs))
            own: dict[str, float] = {}
            for each in read:
                slope = slopes[f"{name} by {each}"]
                unknown = self._size_of(each) or each
                if unknown in places:
                    total = total + slope * self.unknowns[places[unknown]] if slope else total
                else:
                    own[each] = slope
            rates = dict(zip(self.inputs, total.tolist(), strict=True))
            found[name] = {each: rates.get(each, 0.0) + own.get(each, 0.0) for each in {**rates, **own}}
        return found

    def _size_of(self, name: str) -> str:
        """The unknown that the size of a corner is."""
        sizes = (corner.name for corner in self.profile.figure.corners if corner.size == name)
        return next((f"{each}.radius" for each in sizes if f"{each}.radius" in self.system.unknowns), "")

    def _path_value(self, name: str) -> float:
        """An input of the path, in which coordinates count from the start point."""
        start = {scalar(self.system.figure.start, axis): axis for axis in (FIRST, SECOND)}
        if name in start:
            return 0.0
        value = self.values.get(self._size_of(name) or name)
        if value is None:
            value = _given(self.profile, name)
        point, _, axis = name.rpartition(".")
        if point in (*self.system.figure.points, *self.system.figure.places):
            value -= float(self.profile.start.values[int(axis)] or 0)
        return value


@lru_cache(maxsize=256)
def _compile(system: System) -> tuple[Tape, Compiled]:
    """The equations of a system, and their derivatives by the unknowns and everything that is stated."""
    tape = Tape()
    for name in system.unknowns:
        tape.input(name)
    at = lookup(system, tape, {})
    basis = [system.facts[index] for index in judge(system).basis]
    for row, fact in enumerate(basis):
        tape.output(f"{row}", fact.residual(at))
    return tape, tape.slopes([f"{row}" for row in range(len(basis))], tape.inputs)


def _values(profile: Profile, solution: Solution, names: Iterable[str]) -> dict[str, float]:
    """The inputs of the equations at a solution, but for sides."""
    found = dict(solution.scalars)
    for name in names:
        if name not in found and not name.startswith(SIDE):
            found[name] = _given(profile, name)
    return found


def _given(profile: Profile, name: str) -> float:
    """The value of what is stated, mm, or the cosine or sine of an angle."""
    point, _, axis = name.rpartition(".")
    if point == profile.figure.start:
        return float(profile.start.values[int(axis)] or 0)
    for ending, part in ((COSINE, 0), (SINE, 1)):
        angle = profile.givens.get(name.removesuffix(ending))
        if name.endswith(ending) and angle is not None and angle.unit is Unit.DEGREE:
            return direction(angle.value)[part]
    return float(profile.givens[name].value)


@dataclass(frozen=True, slots=True)
class Spread:
    """How far a coordinate moves, mm, to first order: if all words are off in the worst way, and if they are off
    independently of each other (root of the sum of squares)."""

    worst: float
    typical: float


@dataclass(frozen=True, slots=True)
class Sensitivity(Shown):
    """The derivatives of a contour: `slopes[result][word]` in mm for each unit of the word as it is written, so that a
    diameter counts as such; NaN where a word parts two places that have become one, as in a half circle. The results
    have the names that they have in a `Family`."""

    slopes: Mapping[str, Mapping[str, float]]

    def spread(self, tolerances: Mapping[str, float]) -> dict[str, Spread]:
        """How far each result moves when the words are off by up to these tolerances, as written. Raises FamilyError
        for a word that is not there, and a tolerance below 0."""
        tolerances = read_tolerances(tolerances, next(iter(self.slopes.values())))
        found: dict[str, Spread] = {}
        for result, slopes in self.slopes.items():
            parts = [abs(slopes[word] * tolerance) for word, tolerance in tolerances.items()]
            found[result] = Spread(sum(parts), hypot(*parts))
        return found


def read_tolerances(allowed: Mapping[str, float], known: Iterable[str]) -> dict[str, float]:
    """Tolerances by the names of the words. Raises FamilyError."""
    if not isinstance(allowed, Mapping):
        raise TypeError(f"tolerances are a mapping of words to numbers, such as {{'A': 0.1}}, not {allowed!r}")
    found: dict[str, float] = {}
    for word, value in allowed.items():
        name = _named(word, known)
        if name in found:
            raise FamilyError(f"{name} has two tolerances; name it once")
        try:
            found[name] = float(value)
        except (TypeError, ValueError):
            raise FamilyError(f"the tolerance of {name} is a number, not {value!r}") from None
        if not 0 <= found[name] < inf:
            told = "it is a finite number, not below 0"
            if -inf < found[name] < 0:
                told = f"a tolerance is positive: {-found[name]:g} means +-{-found[name]:g}"
            raise FamilyError(f"the tolerance of {name} is {value}; {told}")
    return found


def _named(word: str, known: Iterable[str]) -> str:
    """The name of a word among those that there are. Raises FamilyError."""
    names = {name.lower(): name for name in known}
    found = names.get(" ".join(word.lower().split()))
    if found is None:
        raise FamilyError(f"no word {word}; there are {', '.join(names.values())}")
    return found


def sensitivity(
    block: str,
    *,
    start: str | None = None,
    control: str | Dialect | None = None,
    facts: Iterable[str] = (),
    units: str = "mm",
    rules: str = "enforce",
    settings: Mapping[str, str] | None = None,
) -> Sensitivity:
    """The derivatives of a contour by all words that it follows from: by CasADi's differentiation of its closed form,
    or where it has facts, `?` or no closed form, by the implicit function theorem from the equations at its points.

    Arguments and errors as for `family`; a fact goes by what it gives the value of (`length of line 1`). Also raises
    FamilyError if the block has no contour, says something twice, or has a line that touches its circle, where no
    derivative exists.

    >>> slopes = sensitivity("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").slopes
    >>> {word: f"{slope:.3f}" for word, slope in slopes["V2.Z"].items()}
    {'X': '-0.289', 'A': '-0.302', 'K': '1.000', 'B': '-0.698', 'P': '0.000', 'Q': '0.000'}
    """
    spec = spec_of(block, start=start, control=control, facts=facts, units=units, rules=rules, settings=settings)
    template = spec.template()
    check_block(template)
    return slopes_of(template.solve({}))


def slopes_of(answer: Answer) -> Sensitivity:
    """The derivatives of a contour that was solved; errors as for `sensitivity`."""
    words = stated_words(answer)
    values = {name: float(word.number or 0) for name, word in words.items()}
    case = case_in(answer, words, values)
    if not case.is_closed or case.profile.is_extended:
        return Sensitivity(_implicit(answer))
    _check(case.solve(values) if case.status is None else None, answer)
    results, tape = results_of(case), case.machine.tape
    inputs = {name: value for name, value in case.numbers().items() if name in tape.inputs}
    outputs, singular = [output for output, _ in results.values()], _singular(case, inputs)
    at = tape.slopes(outputs, list(inputs))(inputs)
    rates = {output: {name: at.get(f"{output} by {name}", 0.0) for name in inputs} for output in outputs}
    givens = case.profile.givens
    stated = [
        (givens[given], word, nan if word in singular else float(factor)) for given, (word, factor) in case.free.items()
    ]
    return Sensitivity({result: _by_word(rates[output], stated, words) for result, (output, _) in results.items()})


def _by_word(
    rates: Mapping[str, float], stated: Iterable[tuple[Given, str, float]], words: Iterable[str]
) -> dict[str, float]:
    """The derivatives by words from those by inputs; `stated` are values, the word that states each, and the mm or
    degrees for each unit of it."""
    found = dict.fromkeys(words, 0.0)
    for given, word, factor in stated:
        found[word] = found.get(word, 0.0) + _by_given(given, rates) * factor
    return found


def _singular(case: CaseClass, inputs: Mapping[str, float]) -> frozenset[str]:
    """The words by which there is no derivative: they would part the two places of a centre that have become one, as
    in a half circle."""
    machine, found = case.machine, set[str]()
    out = machine.function(inputs)
    for number, step in enumerate(machine.plan.steps):
        if isinstance(step, TwoCirclesStep):
            gap = out[f"radius:{number}"] - abs(out[f"offset:{number}"])
            if abs(gap) <= TOUCHING * out[f"scale:{number}"]:
                names = [f"radius:{number}", f"offset:{number}"]
                at = machine.tape.slopes(names, list(inputs))(inputs)
                for given, (word, _) in case.free.items():
                    radius, offset = (
                        _by_given(case.profile.givens[given], {each: at[f"{name} by {each}"] for each in inputs})
                        for name in names
                    )
                    found |= {word} if abs(radius - offset) > SINGULAR else set()
    return frozenset(found)


def stated_words(answer: Answer) -> dict[str, Word]:
    """The words of a block that state a value of its contour, by their names."""
    typed = [word for each in answer.claim.blocks for word in each.words]
    stating = [given.word for given in answer.profile.givens.values() if given.word and given.unit is not Unit.SIGN]
    return {call(word, typed): word for word in typed if word in stating}


def _by_given(given: Given, rates: Mapping[str, float]) -> float:
    """The derivative by a value, mm or degrees, from those by the inputs that follow from it."""
    if given.unit is not Unit.DEGREE:
        return rates.get(given.name, 0.0)
    cosine, sine = direction(given.value)
    by_cosine, by_sine = rates.get(given.name + COSINE, 0.0), rates.get(given.name + SINE, 0.0)
    return (by_sine * cosine - by_cosine * sine) * pi / 180


def _implicit(answer: Answer) -> dict[str, dict[str, float]]:
    """The derivatives where there is no closed form, or more is stated than words."""
    from contoursolve.settling import settle  # noqa: PLC0415 - few blocks need it

    solution = settle(answer.profile).solution if answer.contour is not None else None
    _check(solution, answer)
    if solution is None:
        raise FamilyError("the block is not solved")
    profile = answer.profile
    results = results_of(CaseClass(profile, None, {}, is_closed=False))
    outputs = {name: output for name, (output, _) in results.items() if not name.endswith(".room")}
    rates = Implicit(profile, solution).rates(outputs.values())
    names = {id(word): name for name, word in stated_words(answer).items()}
    stated = [
        (given, names.get(id(given.word)) or _fact_name(given, profile), _scale(given, answer))
        for given in profile.givens.values()
        if given.word is not None and given.unit is not Unit.SIGN
    ]
    return {name: _by_word(rates[output], stated, ()) for name, output in outputs.items()}


def _scale(given: Given, answer: Answer) -> float:
    """The mm or degrees of a value for each unit of the word or fact that states it."""
    if given.word is not None and given.word.number:
        return float(given.value / given.word.number)
    if given.unit is Unit.DEGREE:
        return 1.0
    return float(answer.unit.in_mm) * (0.5 if given.is_diameter else 1.0)


def _fact_name(given: Given, profile: Profile) -> str:
    """What a fact gives the value of; of a place, with the axis."""
    text = given.word.text if given.word is not None else given.name
    axis = given.name.rpartition(".")[2]
    name = " ".join(text.partition("=")[0].split()).lower()
    return f"{name} [{profile.plane.axes[int(axis)]}]" if "=" not in text and axis.isdigit() else name


def _check(solution: Solution | None, answer: Answer) -> None:
    status = solution.status if solution is not None else answer.status
    if solution is None or status is not Status.SOLVED:
        error = first_error(answer)
        raise FamilyError(
            f"{_UNSOLVED[status]}{f': {error}' if error else ''}; only a contour that is solved has derivatives"
        )
    if any(remark.kind in (RemarkKind.TOUCHES, RemarkKind.DOUBLE) for remark in solution.remarks):
        raise FamilyError("two solutions have become one, so that no derivative exists")


_UNSOLVED = {
    Status.REJECTED: "the control refuses the block",
    Status.CONFLICTING: "the words of the block disagree",
    Status.UNDERDETERMINED: "the block lacks words",
    Status.OVERDETERMINED: "the block says something twice",
    Status.AMBIGUOUS: "several contours satisfy the block",
    Status.NO_SOLUTION: "the block has no contour",
    Status.UNDECIDED: "no contour was found, and that there is none is not proven",
}
"""What the statuses say of a block."""


@dataclass(frozen=True, slots=True)
class Effect:
    """What one word or fact does to the point.

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


@dataclass(frozen=True, slots=True)
class Missing:
    """Combinations of the limits without a contour for one reason: how many, the values of one of them as written, and
    what `solve` says of that one."""

    count: int
    values: Mapping[str, float]
    message: str


@dataclass(frozen=True, slots=True)
class Limits:
    """Where the point lies on each axis at most and at least, mm, at all combinations of the limits of the tolerances,
    each solved; `without` counts those that have no contour, `missing` says which and why."""

    low: Point
    high: Point
    count: int
    without: int
    missing: tuple[Missing, ...] = ()


@dataclass(frozen=True, slots=True)
class Tolerances(Shown):
    """How words move a point of a contour: the words, the one that moves it most first; how far it may be off on each
    axis to first order; and where it lies at the limits, None without tolerances or with too many of them."""

    point: str
    place: Point
    plane: Plane
    length: Length
    effects: tuple[Effect, ...]
    spread: tuple[Spread, Spread]
    limits: Limits | None


def tolerances(
    block: str,
    allowed: Mapping[str, float] | None = None,
    *,
    point: str = "end",
    start: str | None = None,
    control: str | Dialect | None = None,
    facts: Iterable[str] = (),
    units: str = "mm",
    rules: str = "enforce",
    settings: Mapping[str, str] | None = None,
) -> Tolerances:
    """What each word does to a point, and what tolerances come to: at worst, in the root of the sum of squares, and at
    all combinations of their limits.

    Args:
        block: the block, or the blocks of one contour.
        allowed: how far words may be off, as written, by name (`{"P": 0.05}`); of a fact by what it gives the value of.
        point: a point as a `Family` names it (`V2`, `corner 1.center`), or `end`.
        start: and all others as for `sensitivity`, with the same errors; also raises FamilyError for a word or a point
            that is not there, and a tolerance below 0.

    >>> found = tolerances("G111 X100. A180. K-30. B120. P5. Q5.", {"A": 0.1, "K": 0.02}, start="X40. Z0.")
    >>> [(each.word, round(each.moves, 4)) for each in found.effects[:2]]
    [('A', 0.0302), ('K', 0.02)]
    """
    spec = spec_of(block, start=start, control=control, facts=facts, units=units, rules=rules, settings=settings)
    template = spec.template()
    check_block(template)
    answer = template.solve({})
    slopes, axes = slopes_of(answer).slopes, answer.plane.axes
    name = end_name(answer.profile.figure) if point == "end" else point
    if answer.contour is None or any(f"{name}.{axis}" not in slopes for axis in axes):
        points = dict.fromkeys(each.removesuffix(f".{axes[0]}") for each in slopes if each.endswith(f".{axes[0]}"))
        raise FamilyError(f"the contour has no point {point}; there are {', '.join(('end', *points))}")
    first, second = (slopes[f"{name}.{axis}"] for axis in axes)
    study = _Study(template, answer, point)
    by_word = {word: (first[word] * study.unit(word), second[word] * study.unit(word)) for word in first}
    allowed = read_tolerances({} if allowed is None else allowed, by_word)
    effects = [study.effect(word, slope, allowed.get(word)) for word, slope in by_word.items()]
    effects.sort(key=lambda each: (not isnan(each.moves), -each.moves, -(each.by_half or 0.0)))
    parts = [[abs(by_word[word][axis]) * value for word, value in allowed.items()] for axis in (0, 1)]
    limits = None
    if allowed and len(allowed) <= MOST_WORDS:
        values = {word: study.value(word) for word in allowed}
        vary = {word: [values[word] - off, values[word] + off] for word, off in allowed.items()}
        found = solve_sweep(compile_sweep(spec, ranges_of(vary, is_paired=False)))
        # A family without any contour has no points.
        none = numpy.full(len(found), nan)
        limits = _limits(*(found.columns.get(f"{name}.{axis}", none) for axis in axes))
        limits = replace(limits, missing=tuple(_missing(template, found)))
    spread = Spread(sum(parts[0]), hypot(*parts[0])), Spread(sum(parts[1]), hypot(*parts[1]))
    return Tolerances(point, study.place, answer.plane, answer.unit, tuple(effects), spread, limits)


def _missing(template: Template, found: Family) -> Iterator[Missing]:
    """The rows without a contour, each reason once, the most frequent first."""
    free = template.with_words(list(found.ranges.values))
    kinds = numpy.stack([found.columns["status"], found.columns["reason"]], axis=1)
    reasons, firsts, counts = numpy.unique(kinds, axis=0, return_index=True, return_counts=True)
    for number in numpy.argsort(-counts, kind="stable").tolist():
        if reasons[number, 0] > Code.OVERDETERMINED:
            values = {word: float(found[word].reshape(-1)[firsts[number]]) for word in found.ranges.values}
            yield Missing(int(counts[number]), values, first_error(free.solve(values)))


def _limits(first: Array, second: Array) -> Limits:
    """Where a point lies at all combinations, NaN where it does not."""
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

    def value(self, word: str) -> float:
        """The value of a word or a fact, as it would be written with a decimal point."""
        return value_of(find_words(self.template, [word])[word], self.answer)

    def unit(self, word: str) -> float:
        """By how many units of a word as written its value changes, for one of it with a decimal point."""
        number = self.words[word].number if word in self.words else None
        return float(number) / self.value(word) if number else 1.0

    def effect(self, word: str, slope: Point, tolerance: float | None) -> Effect:
        """What a word does."""
        moves, typed = hypot(*slope) * tolerance if tolerance else 0.0, self.words.get(word)
        lexicon, value = self.answer.claim.lexicon, self.value(word)
        stated = unit_of(find_words(self.template, [word])[word], self.answer)
        unit = "deg" if stated is Unit.DEGREE else self.answer.unit.value
        effect = Effect(word, unit, value, slope, tolerance, moves, None, None, None, None, 0.0)
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
        """How far the point moves when a word gets another value, mm; None where there is no contour then."""
        at = place_of(self.point, self.template.with_words([word]).solve({word: value}).contour)
        return None if at is None else hypot(at[0] - self.place[0], at[1] - self.place[1])
