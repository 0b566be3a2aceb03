"""Rows of a family that the rules treat alike: one system, one choice of branches, one function."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from decimal import Decimal

import numpy

from contoursolve.analysis import judge
from contoursolve.backends.columns import Array, directions
from contoursolve.backends.inputs import COSINE, SINE
from contoursolve.constraints import Coordinate, System, assemble
from contoursolve.diagnostic import Basis, Severity
from contoursolve.examine import MOST_CHOICES, Answer, count_choices
from contoursolve.families.ranges import FamilyError, Ranges
from contoursolve.families.template import Template
from contoursolve.families.verdict import Codes
from contoursolve.model import Given, Profile, Unit
from contoursolve.reading import Trouble
from contoursolve.rules import Rule, Value
from contoursolve.solving import RemarkKind, Solution, Status, is_closed, points_with_two_solutions
from contoursolve.solving.compile import Machine, compile_system
from contoursolve.solving.solve import inputs_of, solve
from contoursolve.syntax import Word
from contoursolve.tolerance import LARGEST


@dataclass(frozen=True, slots=True, eq=False)
class Kind:
    """Rows that share a profile but for the values of the free words.

    `status` is the verdict where it does not depend on the values. `free` has, by the name of each value that follows
    from a free word, the name of the word, and the mm or degrees for each unit of it.
    """

    profile: Profile
    status: Status | None
    free: Mapping[str, tuple[str, Decimal]]

    @property
    def system(self) -> System:
        """The equations."""
        return assemble(self.profile)

    @property
    def machine(self) -> Machine:
        """The function of a single solve."""
        return compile_system(self.system)

    def numbers(self) -> dict[str, float]:
        """The inputs of the function that stay."""
        return inputs_of(self.profile, self.system)

    def columns(self, ranges: Ranges) -> dict[str, tuple[str, Array]]:
        """The inputs of the function that vary: the word that each follows, and its values in the order of that
        word's."""
        absolute = {fact.given: fact.axis for fact in self.system.facts if isinstance(fact, Coordinate)}
        found: dict[str, tuple[str, Array]] = {}
        for given, (word, factor) in self.free.items():
            values = ranges.values[word] * float(factor)
            if self.profile.givens[given].unit is Unit.DEGREE:
                for name, part in zip((COSINE, SINE), directions(values), strict=True):
                    found[given + name] = word, part
            elif given in absolute:
                found[given] = word, values - float(self.profile.start.values[absolute[given]] or 0)
            else:
                found[given] = word, values
        return found

    def solve(self, values: Mapping[str, float]) -> Solution:
        """A single solve of one row, as `examine` does it, without a proof."""
        givens = dict(self.profile.givens)
        for name, (word, factor) in self.free.items():
            givens[name] = replace(givens[name], value=Decimal(repr(values[word])) * factor)
        profile = replace(self.profile, givens=givens)
        solution = solve(profile, is_proven=False)
        touches = any(remark.kind is RemarkKind.TOUCHES for remark in solution.remarks)
        if not touches or count_choices(profile) > MOST_CHOICES:
            return solution
        from contoursolve.settling import settle  # noqa: PLC0415 - few rows touch

        return settle(profile).solution


def classify(template: Template, ranges: Ranges) -> dict[str, Codes]:
    """For each free word, the number of the interval between two limits of the rules in which each value lies; a limit
    is an interval of its own. Raises FamilyError where the limits of two words depend on each other."""
    answer = template.solve({name: float(values[0]) for name, values in ranges.values.items()})
    claim, found, tied = answer.claim, dict[str, Codes](), list[str]()
    for name, word in template.words.items():
        if word.address not in claim.lexicon.addresses:
            raise FamilyError(f"{word.text} is no word of the contour")
        limits = {Decimal(0), -Decimal(LARGEST), Decimal(LARGEST), *_limits(template.dialect.rules)}
        for given in _stated_by(word, answer.profile):
            if given.name in claim.limits:
                limits.add(claim.limits[given.name])
                tied.append(word.text)
        one = claim.lexicon.value(replace(word, number=Decimal(1), has_point=True), answer.unit)
        bounds, values = numpy.array(sorted(map(float, limits))), ranges.values[name] * float(one or 1)
        places = numpy.searchsorted(bounds, values, "left") + numpy.searchsorted(bounds, values, "right")
        found[name] = places.astype(numpy.uint8)
    if len(tied) > 1:
        raise FamilyError(f"{' and '.join(tied)} are read together: vary one of them at a time")
    return found


def _limits(rules: Iterable[Rule]) -> Iterable[Decimal]:
    for rule in rules:
        if isinstance(rule.when, Value):
            for limit in (rule.when.least, rule.when.most, rule.when.excluding):
                if limit is not None and limit.is_finite():
                    yield limit


def kind_of(template: Template, values: Mapping[str, float]) -> Kind:
    """The kind of the row with these values. Raises FamilyError where its equations need a search or leave a choice."""
    return kind_in(template.solve(values), template.words, values)


def kind_in(answer: Answer, words: Mapping[str, Word], values: Mapping[str, float]) -> Kind:
    """The kind of a contour that was solved at these values of its free words. Raises FamilyError as `kind_of`."""
    profile = answer.profile
    status = _verdict(answer)
    free: dict[str, tuple[str, Decimal]] = {}
    for word, typed in words.items():
        number, stated = Decimal(repr(values[word])), list(_stated_by(typed, profile))
        if not stated and status is None:
            raise FamilyError(f"{typed.text} cannot vary: the contour has no value of it")
        for given in stated:
            one = replace(typed, number=Decimal(1), has_point=given.word is None or given.word.has_point)
            factor = given.value / number if number else answer.claim.lexicon.value(one, answer.unit)
            free[given.name] = word, factor or Decimal(1)
    if status is None:
        system = assemble(profile)
        if not is_closed(system):
            raise FamilyError("these words have no closed form; a family needs one, so solve such blocks one by one")
        chosen = {choice.point for choice in profile.choices}
        open_points = [point for point in points_with_two_solutions(system) if point not in chosen]
        if open_points:
            raise FamilyError(f"nothing chooses between the two places of {open_points[0]}; add the word that does")
    return Kind(profile, status, free)


def _stated_by(typed: Word, profile: Profile) -> Iterable[Given]:
    """The values that follow from a word, wherever it now stands in its line."""
    for given in profile.givens.values():
        word = given.word
        if word is not None and (word.span.line, word.address) == (typed.span.line, typed.address):
            yield given


def alike(one: Kind, other: Kind) -> bool:
    """Whether rows of two kinds can be evaluated together."""
    if one.status is not None or other.status is not None:
        return one.status is other.status
    return (
        one.profile.layout is other.profile.layout
        and one.profile.choices == other.profile.choices
        and one.free == other.free
        and _fixed(one) == _fixed(other)
    )


def _fixed(kind: Kind) -> dict[str, Decimal]:
    return {name: given.value for name, given in kind.profile.givens.items() if name not in kind.free}


def _verdict(answer: Answer) -> Status | None:
    """The status that all rows of the kind have, if the equations are not solved."""
    errors = [each for each in answer.diagnostics if each.severity is Severity.ERROR]
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
