"""By how much each word of a block moves each coordinate of its contour."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import hypot, pi

from contoursolve.backends.inputs import COSINE, SINE
from contoursolve.dialects import Dialect
from contoursolve.families.evaluate import template_of
from contoursolve.families.kinds import Kind, kind_in
from contoursolve.families.prepared import results_of
from contoursolve.families.ranges import FamilyError
from contoursolve.families.template import call
from contoursolve.model import Unit
from contoursolve.solving import RemarkKind, Status
from contoursolve.syntax import Program, Word


@dataclass(frozen=True, slots=True)
class Spread:
    """How far a coordinate moves, mm, to first order: if all words are off in the worst way, and if they are off
    independently of each other (root of the sum of squares)."""

    worst: float
    typical: float


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """The derivatives of a contour: `slopes[result][word]` in mm for each unit of the word as it is written, so that a
    diameter counts as such. The results have the names that they have in a `Family`."""

    slopes: Mapping[str, Mapping[str, float]]

    def spread(self, tolerances: Mapping[str, float]) -> dict[str, Spread]:
        """How far each result moves when the words are off by up to these tolerances, as written."""
        unknown = [word for word in tolerances if word not in next(iter(self.slopes.values()))]
        if unknown:
            raise FamilyError(f"no word {unknown[0]}; there are {', '.join(next(iter(self.slopes.values())))}")
        found: dict[str, Spread] = {}
        for result, slopes in self.slopes.items():
            parts = [abs(slopes[word] * tolerance) for word, tolerance in tolerances.items()]
            found[result] = Spread(sum(parts), hypot(*parts))
        return found


def sensitivity(
    block: str,
    *,
    start: str | None = None,
    control: str | Dialect | None = None,
    units: str = "mm",
    rules: str = "enforce",
    settings: Mapping[str, str] | None = None,
) -> Sensitivity:
    """The derivatives of a contour by all words that it follows from, by CasADi's differentiation of its closed form.

    Arguments and errors as for `family`; also raises FamilyError if the block has no contour, says something twice, or
    has a line that touches its circle, where no derivative exists.

    >>> slopes = sensitivity("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").slopes
    >>> {word: f"{slope:.3f}" for word, slope in slopes["V2.Z"].items()}
    {'X': '-0.289', 'A': '-0.302', 'K': '1.000', 'B': '-0.698', 'P': '0.000', 'Q': '0.000'}
    """
    answer = template_of(block, start, control, units, rules, settings, _none).solve({})
    typed = [word for each in answer.claim.blocks for word in each.words]
    stating = [given.word for given in answer.profile.givens.values() if given.word and given.unit is not Unit.SIGN]
    words = {call(word, typed): word for word in typed if word in stating}
    values = {name: float(word.number or 0) for name, word in words.items()}
    kind = kind_in(answer, words, values)
    _check(kind, values)
    results, tape = results_of(kind), kind.machine.tape
    inputs = {name: value for name, value in kind.numbers().items() if name in tape.inputs}
    function = tape.slopes([output for output, _ in results.values()], list(inputs))
    at = function(inputs)
    found: dict[str, dict[str, float]] = {}
    for result, (output, _) in results.items():
        found[result] = dict.fromkeys(words, 0.0)
        for given, (word, factor) in kind.free.items():
            if kind.profile.givens[given].unit is Unit.DEGREE:
                cosine, sine = given + COSINE, given + SINE
                slope = at.get(f"{output} by {sine}", 0.0) * inputs.get(cosine, 0.0)
                slope = (slope - at.get(f"{output} by {cosine}", 0.0) * inputs.get(sine, 0.0)) * pi / 180
            else:
                slope = at.get(f"{output} by {given}", 0.0)
            found[result][word] += slope * float(factor)
    return Sensitivity(found)


def _none(_program: Program) -> dict[str, Word]:
    """No word is free while the block is read."""
    return {}


def _check(kind: Kind, values: Mapping[str, float]) -> None:
    if not kind.is_closed:
        raise FamilyError("the block has facts, ? or a choice that nothing makes; derivatives need a closed form")
    solution = kind.solve(values) if kind.status is None else None
    status = solution.status if solution is not None else kind.status
    if solution is None or status is not Status.SOLVED:
        raise FamilyError(f"the block is {status.value if status else 'not solved'}; only a solved one has derivatives")
    if any(remark.kind in (RemarkKind.TOUCHES, RemarkKind.DOUBLE) for remark in solution.remarks):
        raise FamilyError("two solutions have become one, so that no derivative exists")
