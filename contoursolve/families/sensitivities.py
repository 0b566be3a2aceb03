"""By how much each word of a block moves each coordinate of its contour: from a closed form by CasADi, or from the
equations at its points by the implicit function theorem.
"""

from collections.abc import Iterable, Mapping, Sequence
from decimal import Decimal
from functools import lru_cache
from itertools import product
from math import hypot, inf, nan, pi
from typing import Unpack

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Answer, fact_key, fact_subject
from contoursolve.diagnostics import Shown, hash_of
from contoursolve.families.block_template import BlockOptions, first_error, spec_of
from contoursolve.families.branch_rows import add_path
from contoursolve.families.case_classes import CaseClass, ShownOutput, case_in, results_of
from contoursolve.families.errors import FamilyError
from contoursolve.families.free_words import check_block, factor_of
from contoursolve.families.results import LENGTH, NamedResults, ResultNames, lengths_of
from contoursolve.families.word_values import name_of
from contoursolve.gcode import Word, call
from contoursolve.geometry import Given, Plane, Profile, System, Unit, assemble, scalar
from contoursolve.numeric import COSINE, SIDE, SINE, Compiled, Tape, condition, direction
from contoursolve.program import takes
from contoursolve.solving import NoteKind, Status, StepKind, SystemSolution, analyse, basis_of, input_values
from contoursolve.tolerance import RESIDUAL

SINGULAR = 1e-9
"""mm for each mm or degree. A word that changes the gap between two circles by less keeps them touching."""

SINGULAR_CONDITION = 1e12
"""1. Condition of the equations, each unknown in mm, above which they are taken for singular."""

Rates = Mapping[str, Mapping[str, float]]
"""The derivatives of outputs by inputs."""


class Spread(Struct, frozen=True):
    """Move of a coordinate, mm, to first order: if all words are off in the worst way, and if they are off
    independently of each other (root of the sum of squares)."""

    worst: float
    typical: float


class Sensitivity(Shown, Struct, frozen=True):
    """The derivatives of a contour.

    Attributes:
        slopes: `slopes[result][word]` in mm for each unit of the word as it is written, so that a diameter counts as
            such. The results have the names that they have in a `Family`, and go by all that these go by; X of a lathe
            as diameter. NaN where a word parts two places that have become one, as in a half circle.
        plane: the axes of the points, first and second.
    """

    slopes: Mapping[str, Mapping[str, float]]
    plane: Plane
    spelled: Mapping[str, str] = {}
    """The words by all their names."""

    __hash__ = hash_of

    def spread(self, tolerances: Mapping[str, float]) -> dict[str, Spread]:
        """The move of each result, by all the names that `slopes` takes, when the words are off by up to these
        tolerances, as written. Raises FamilyError for a word that is not there, and a tolerance below 0."""
        tolerances = read_tolerances(tolerances, self.spelled)
        found: dict[str, Spread] = {}
        for result, slopes in self.slopes.items():
            parts = [abs(slopes[word] * tolerance) for word, tolerance in tolerances.items()]
            found[result] = Spread(sum(parts), hypot(*parts))
        return NamedResults(self.slopes.names, found) if isinstance(self.slopes, NamedResults) else found


def read_tolerances(allowed: Mapping[str, float], spelled: Mapping[str, str]) -> dict[str, float]:
    """Tolerances by the names of the words, of which `spelled` has all. Raises FamilyError."""
    if not isinstance(allowed, Mapping):
        raise TypeError(f"tolerances are a mapping of words to numbers, such as {{'A': 0.1}}, not {allowed!r}")
    found: dict[str, float] = {}
    for word, value in allowed.items():
        name = spelled.get(_key(word))
        if name is None:
            raise FamilyError(f"no word {word}; there are {', '.join(dict.fromkeys(spelled.values()))}")
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


def _key(word: str) -> str:
    """The name of a word, or of a fact, however it is spelled."""
    return fact_key(name_of(word))


def _spelled(slopes: Rates, words: Mapping[str, Word]) -> dict[str, str]:
    """The words that results have derivatives by, by all their names: with their line, and without where that tells."""
    names = {name: name for name in next(iter(slopes.values()), {})}
    names |= {f"{word.span.line}:{word.address}": name for name, word in words.items()}
    return {_key(spelling): name for spelling, name in names.items()}


@takes(BlockOptions)
def sensitivity(block: str, **options: Unpack[BlockOptions]) -> Sensitivity:
    """The derivatives of a contour by all words that it follows from.

    CasADi differentiates its closed form. Where it has facts, `?` or no closed form, they follow from the equations at
    its points (implicit function theorem).

    Arguments and errors as for `family`; a fact goes by what it gives the value of (`length of line 1`). Also raises
    FamilyError if the block has no contour or says something twice. Where a line touches its circle, no derivative
    exists: the same error.

    >>> slopes = sensitivity("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").slopes
    >>> {word: f"{slope:.3f}" for word, slope in slopes["V2 Z"].items()}
    {'X': '-0.289', 'A': '-0.302', 'K': '1.000', 'B': '-0.698', 'P': '0.000', 'Q': '0.000'}
    """
    template = spec_of(block, **options).template()
    check_block(template)
    return slopes_of(template.solve({}))


def slopes_of(answer: Answer, *, is_twice_fine: bool = False) -> Sensitivity:
    """The derivatives of a contour that was solved; errors as for `sensitivity`. Where it may say something twice,
    words that do have none (NaN): one of them alone cannot move."""
    words = stated_words(answer)
    values = {name: float(word.number or 0) for name, word in words.items()}
    case = case_in(answer, words, values)
    if not case.is_closed or case.profile.is_extended:
        return _implicit(answer, words, is_twice_fine=is_twice_fine)
    _check(case.solve(values) if case.status is None else None, answer)
    inputs = {name: value for name, value in case.numbers().items() if name in case.machine.tape.inputs}
    outputs, singular = results_of(case), _singular(case, inputs)
    rates = _slopes(case.machine.tape, [each.output for each in outputs.values()], inputs)
    stated = [
        (case.profile.givens[name], each.word, nan if each.word in singular else float(each.factor))
        for name, each in case.free.items()
    ]
    slopes = {result: _by_word(rates[each.output], stated, words) for result, each in outputs.items()}
    at = case.machine.function(inputs)
    values = {result: at[each.output] for result, each in outputs.items()}
    return _sensitivity(slopes, outputs, values, answer, words)


def _sensitivity(
    slopes: Rates,
    results: Mapping[str, ShownOutput],
    values: Mapping[str, float],
    answer: Answer,
    words: Mapping[str, Word],
) -> Sensitivity:
    """The derivatives of results as a person reads them, from those of their outputs, and from their values that of the
    length."""
    found = {
        name: {word: slope * results[name].factor for word, slope in each.items()} for name, each in slopes.items()
    }
    here = {name: values[name] * results[name].factor for name in found}
    found[LENGTH] = {word: _of_length(here, found, word, answer.plane) for word in next(iter(found.values()), {})}
    return Sensitivity(NamedResults(ResultNames(answer.profile, found), found), answer.plane, _spelled(found, words))


def _of_length(values: Mapping[str, float], slopes: Rates, word: str, plane: Plane) -> float:
    """The derivative of the length of the path: of all results by one word, a little to either side. The first order of
    them is exact, and what is beyond it cancels out."""
    largest = max((abs(each[word]) for each in slopes.values()), default=0.0)
    if not 0 < largest < inf:
        # Nothing moves, or without limit, and so does the length.
        return largest
    step = LENGTH_STEP / largest
    sides = numpy.array([step, -step])
    there = {name: value + sides * slopes[name][word] for name, value in values.items()}
    ahead, behind = lengths_of(there, plane)
    return float(ahead - behind) / (2 * step)


LENGTH_STEP = 1e-3
"""mm by which the result that moves most is moved: cancelling costs 1e-10 of a slope of 1 then."""


def _slopes(tape: Tape, outputs: Sequence[str], inputs: Mapping[str, float]) -> Rates:
    """The derivatives of some outputs of a tape, where it has these inputs."""
    at = _differentiated(tape, tuple(outputs), tuple(inputs))(inputs)
    return {output: {name: at.get(f"{output} by {name}", 0.0) for name in inputs} for output in outputs}


@lru_cache(maxsize=64)
def _differentiated(tape: Tape, outputs: tuple[str, ...], inputs: tuple[str, ...]) -> Compiled:
    """The derivatives as a function; whoever moves a contour asks for the same again and again."""
    return tape.slopes(outputs, inputs)


def _by_word(
    rates: Mapping[str, float], stated: Iterable[tuple[Given, str, float]], words: Iterable[str]
) -> dict[str, float]:
    """The derivatives by words from those by inputs; `stated` are values, the word that states each, and the mm or
    degrees for each unit of it."""
    found = dict.fromkeys(words, 0.0)
    for given, word, factor in stated:
        found[word] = found.get(word, 0.0) + _by_given(given, rates) * factor
    return found


def _by_given(given: Given, rates: Mapping[str, float]) -> float:
    """The derivative by a value, mm or degrees, from those by the inputs that follow from it."""
    if given.unit is not Unit.DEGREE:
        return rates.get(given.name, 0.0)
    cosine, sine = direction(given.value)
    by_cosine, by_sine = rates.get(given.name + COSINE, 0.0), rates.get(given.name + SINE, 0.0)
    return (by_sine * cosine - by_cosine * sine) * pi / 180


def _singular(case: CaseClass, inputs: Mapping[str, float]) -> frozenset[str]:
    """The words by which there is no derivative: they would part the two places of a centre that have become one, as
    in a half circle."""
    found, out = set[str](), case.machine.function(inputs)
    for step, measures in zip(case.machine.steps, case.machine.measures, strict=True):
        if step.kind is StepKind.TWO_CIRCLES and measures.is_touching(out):
            rates = _slopes(case.machine.tape, [measures.radius, measures.offset], inputs)
            for name, each in case.free.items():
                radius, offset = (_by_given(case.profile.givens[name], own) for own in rates.values())
                found |= {each.word} if abs(radius - offset) > SINGULAR else set()
    return frozenset(found)


def stated_words(answer: Answer) -> dict[str, Word]:
    """The words of a block that state a value of its contour, by their names."""
    typed = [word for each in answer.claim.blocks for word in each.words]
    stating = [given.word for given in answer.profile.givens.values() if given.word and given.unit is not Unit.SIGN]
    return {call(word, typed): word for word in typed if word in stating}


def _implicit(answer: Answer, words: Mapping[str, Word], *, is_twice_fine: bool) -> Sensitivity:
    """The derivatives where there is no closed form, or more is stated than words."""
    from contoursolve.solving import settle  # noqa: PLC0415 - few blocks need it

    solution = settle(answer.profile).solution if answer.contour is not None else None
    is_twice = is_twice_fine and solution is not None and solution.status is Status.OVERDETERMINED
    _check(replace(solution, status=Status.SOLVED) if solution is not None and is_twice else solution, answer)
    if solution is None:
        raise FamilyError("the block is not solved")
    profile = answer.profile
    tied = _tied(assemble(profile)) if is_twice else frozenset[str]()
    results = results_of(CaseClass(profile, None, {}, is_closed=False))
    outputs = {name: each.output for name, each in results.items()}
    rates, here = _implicit_rates(profile, solution, tuple(outputs.values()))
    names = {id(word): name for name, word in words.items()}
    stated = []
    for given in profile.givens.values():
        own = profile.givens[given.follows] if given.follows else given
        if own.word is not None and given.unit is not Unit.SIGN:
            name = names.get(id(own.word)) or _fact_name(own, own.word, profile)
            factor = float(factor_of(answer, own.word, own, own.word.number or Decimal(0)))
            stated.append((given, name, nan if given.name in tied else factor))
    slopes = {name: _by_word(rates[output], stated, ()) for name, output in outputs.items()}
    values = {name: here[output] for name, output in outputs.items()}
    return _sensitivity(slopes, results, values, answer, words)


def _tied(system: System) -> frozenset[str]:
    """The givens of facts of which each follows from others."""
    from contoursolve.solving import headings_of  # noqa: PLC0415 - few blocks need it

    facts = [system.facts[index] for index in analyse(system).tied]
    return frozenset(name for fact in facts for name in (fact.given, *headings_of(fact, system)) if name)


def _fact_name(given: Given, word: Word, profile: Profile) -> str:
    """The subject of a fact; of a place, with the axis."""
    axis = given.name.rpartition(".")[2]
    name = fact_subject(word.text)
    return f"{name} [{profile.plane.axes[int(axis)]}]" if "=" not in word.text and axis.isdigit() else name


def _implicit_rates(
    profile: Profile, solution: SystemSolution, outputs: tuple[str, ...]
) -> tuple[Rates, Mapping[str, float]]:
    """The derivatives of some outputs by all that is stated: of unknowns, and of what follows from them on the path;
    and the values of all."""
    system = assemble(profile)
    unknowns = system.unknowns
    equations, slopes = _compile(system, frozenset(profile.givens), outputs)
    inputs = [name for name in equations.inputs if name not in unknowns]
    known = _on_their_sides({**_known(profile), **solution.scalars}, equations)
    at = slopes(known)
    matrix, right = (
        numpy.array([[at[f"{row} by {name}"] for name in by] for row in range(len(unknowns))])
        for by in (unknowns, inputs)
    )
    if condition(matrix) >= SINGULAR_CONDITION:
        raise FamilyError("two solutions have become one, so that no derivative exists")
    rows = dict(zip(unknowns, -numpy.linalg.solve(matrix, right), strict=True))
    found: dict[str, dict[str, float]] = {}
    for name in outputs:
        total = rows[name] if name in rows else numpy.zeros(len(inputs))
        if name not in rows:
            for each in unknowns:
                if slope := at[f"{name} by {each}"]:
                    total = total + slope * rows[each]
            total = total + [at[f"{name} by {each}"] for each in inputs]
        found[name] = dict(zip(inputs, total.tolist(), strict=True))
    return found, {**known, **equations(known)}


def _on_their_sides(known: Mapping[str, float], equations: Compiled) -> dict[str, float]:
    """All inputs, on the sides on which the equations hold."""
    sides = [name for name in equations.inputs if name.startswith(SIDE)]
    for signs in product((1.0, -1.0), repeat=len(sides)):
        values = {**known, **dict(zip(sides, signs, strict=True))}
        if all(abs(value) <= 10 * RESIDUAL for name, value in equations(values).items() if name.isdigit()):
            return values
    raise FamilyError("the equations do not hold at the points of the contour to nine decimals")


@lru_cache(maxsize=256)
def _compile(system: System, givens: frozenset[str], outputs: tuple[str, ...]) -> tuple[Compiled, Compiled]:
    """The equations of a system and the path through its points; and the derivatives of the equations and of some
    outputs by the unknowns and everything that is stated."""
    tape = Tape()
    for name in system.unknowns:
        tape.input(name)
    at = input_values(system.headed, tape, {})
    basis = basis_of(system)
    for row, fact in enumerate(basis):
        tape.output(f"{row}", fact.residual(at))
    add_path(tape, system, givens)
    wanted = [name for name in outputs if name not in system.unknowns]
    return tape.finish(), tape.slopes([*map(str, range(len(basis))), *wanted], tape.inputs)


def _known(profile: Profile) -> dict[str, float]:
    """All that is stated, mm, and of angles the cosine and the sine."""
    start = profile.figure.start
    found = {scalar(start, axis): float(value or 0) for axis, value in enumerate(profile.start.values)}
    for name, given in profile.givens.items():
        if given.unit is Unit.DEGREE:
            found[name + COSINE], found[name + SINE] = direction(given.value)
        else:
            found[name] = float(given.value)
    return found | profile.increments


def _check(solution: SystemSolution | None, answer: Answer) -> None:
    status = solution.status if solution is not None else answer.status
    if solution is None or status is not Status.SOLVED:
        error = first_error(answer)
        raise FamilyError(
            f"{_UNSOLVED[status]}{f': {error}' if error else ''}; only a contour that is solved has derivatives"
        )
    if any(remark.kind in (NoteKind.TOUCHES, NoteKind.DOUBLE) for remark in solution.remarks):
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
"""Statuses in words about a block."""
