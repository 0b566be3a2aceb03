"""By how much each word of a block moves each coordinate of its contour."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import hypot, inf, nan, pi

from contoursolve.backends.angle import direction
from contoursolve.backends.inputs import COSINE, SINE
from contoursolve.diagnostic import Severity
from contoursolve.dialects import Dialect
from contoursolve.examine import Answer
from contoursolve.families.implicit import Implicit
from contoursolve.families.kinds import Kind, kind_in
from contoursolve.families.ranges import FamilyError
from contoursolve.families.recipe import recipe_of
from contoursolve.families.refusal import check_block
from contoursolve.families.results import results_of
from contoursolve.families.template import call
from contoursolve.model import Given, Profile, Unit
from contoursolve.shown import Shown
from contoursolve.solving import RemarkKind, Solution, Status
from contoursolve.solving.plan import TwoCirclesStep
from contoursolve.syntax import Word
from contoursolve.tolerance import TOUCHING

SINGULAR = 1e-9
"""mm for each mm or degree. A word that changes the gap between two circles by less keeps them touching."""


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
    recipe = recipe_of(block, start=start, control=control, facts=facts, units=units, rules=rules, settings=settings)
    template = recipe.template()
    check_block(template)
    return slopes_of(template.solve({}))


def slopes_of(answer: Answer) -> Sensitivity:
    """The derivatives of a contour that was solved; errors as for `sensitivity`."""
    words = stated_words(answer)
    values = {name: float(word.number or 0) for name, word in words.items()}
    kind = kind_in(answer, words, values)
    if not kind.is_closed or kind.profile.is_extended:
        return Sensitivity(_implicit(answer))
    _check(kind.solve(values) if kind.status is None else None, answer)
    results, tape = results_of(kind), kind.machine.tape
    inputs = {name: value for name, value in kind.numbers().items() if name in tape.inputs}
    at = tape.slopes([output for output, _ in results.values()], list(inputs))(inputs)
    found: dict[str, dict[str, float]] = {}
    singular = _singular(kind, inputs)
    for result, (output, _) in results.items():
        found[result] = dict.fromkeys(words, 0.0)
        for given, (word, factor) in kind.free.items():
            rates = {name: at.get(f"{output} by {name}", 0.0) for name in inputs}
            slope = nan if word in singular else _by_given(kind.profile.givens[given], rates)
            found[result][word] += slope * float(factor)
    return Sensitivity(found)


def _singular(kind: Kind, inputs: Mapping[str, float]) -> frozenset[str]:
    """The words by which there is no derivative: they would part the two places of a centre that have become one, as
    in a half circle."""
    machine, found = kind.machine, set[str]()
    out = machine.function(inputs)
    for number, step in enumerate(machine.plan.steps):
        if isinstance(step, TwoCirclesStep):
            gap = out[f"radius:{number}"] - abs(out[f"offset:{number}"])
            if abs(gap) <= TOUCHING * out[f"scale:{number}"]:
                names = [f"radius:{number}", f"offset:{number}"]
                at = machine.tape.slopes(names, list(inputs))(inputs)
                for given, (word, _) in kind.free.items():
                    radius, offset = (
                        _by_given(kind.profile.givens[given], {each: at[f"{name} by {each}"] for each in inputs})
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
    kind = Kind(profile, None, {}, is_closed=False)
    results = results_of(kind)
    results = {name: each for name, each in results.items() if not name.endswith(".room")}
    rates = Implicit(profile, solution).rates([output for output, _ in results.values()])
    names = {id(word): name for name, word in stated_words(answer).items()}
    found: dict[str, dict[str, float]] = {}
    for result, (output, _) in results.items():
        found[result] = {}
        for given in profile.givens.values():
            if given.word is None or given.unit is Unit.SIGN:
                continue
            name = names.get(id(given.word)) or _fact_name(given, profile)
            slope = _by_given(given, rates[output])
            found[result][name] = found[result].get(name, 0.0) + slope * _scale(given, answer)
    return found


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
        error = next((each.message for each in answer.diagnostics if each.severity is Severity.ERROR), "")
        why = f": {error}" if error else ""
        raise FamilyError(f"{_UNSOLVED[status]}{why}; only a contour that is solved has derivatives")
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
