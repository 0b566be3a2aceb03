"""The solutions of a kind of contour, each as a function of its free words: one where the words choose it, several
where further facts, values that are asked for, or choices that nothing makes leave several."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product

import numpy

from contoursolve.backends.chart import Chart
from contoursolve.backends.inputs import lookup
from contoursolve.constraints import System
from contoursolve.families.ends import about_of
from contoursolve.families.isolate import LEVEL
from contoursolve.families.kinds import Follows, Kind
from contoursolve.families.margins import Margins, compile_margins, compile_results
from contoursolve.families.ranges import NotClosedError
from contoursolve.model import Choice, Fact
from contoursolve.settling import orders_of, settled_by
from contoursolve.solving import RefusalKind
from contoursolve.solving.checks import Check, Checks, Source, Test, at_origin, check_facts, check_path, check_range
from contoursolve.solving.closed import ROOT, ClosedForm, Need, NoFormulaError, close
from contoursolve.tolerance import REGULAR
from contoursolve.wording import join

INSTEAD = "solve it value by value with `family` (`contoursolve sweep`)"
"""What to do where no range can be told."""

PLACES = 64
"""Places drawn at random at which what must not be zero is looked at."""


@dataclass(frozen=True, slots=True, eq=False)
class Branch:
    """One of the solutions of a kind: its checks as margins, and the values of their other inputs."""

    kind: Kind
    words: tuple[str, ...]
    margins: Margins
    fixed: tuple[float, ...]
    signs: tuple[tuple[str, float], ...] = ()

    def results(self, names: Sequence[str], *, is_rate: bool = False) -> tuple[Chart, list[float]]:
        """Some outputs as functions of the words, or their derivatives by the first, with the other inputs."""
        follows = self.kind.follows(self.words)
        if self.kind.is_closed:
            chart = compile_results(self.kind.system, len(self.words), follows, tuple(names), is_rate=is_rate)
        else:
            chart = _results(self.kind.system, len(self.words), follows, tuple(names), is_rate=is_rate)
        return chart, self.kind.fixed(chart.fixed, dict(self.signs))


def branches_of(kind: Kind, words: Sequence[str], low: Sequence[float], high: Sequence[float]) -> tuple[Branch, ...]:
    """The branches of a kind that is solved, in a box of its words. Raises NotClosedError where there is no closed
    form."""
    try:
        return _distinct(_branches(kind, words), low, high)
    except NotClosedError:
        # Facts that are singular at their values may have another in their place, as in a single solve.
        for profile in orders_of(kind.profile):
            try:
                return _distinct(_branches(replace(kind, profile=profile), words), low, high)
            except NotClosedError:
                continue
        raise


def _branches(kind: Kind, words: Sequence[str]) -> tuple[Branch, ...]:
    follows = kind.follows(words)
    if kind.is_closed:
        margins = compile_margins(kind.system, len(words), follows)
        return (Branch(kind, tuple(words), margins, tuple(kind.fixed(margins.chart.fixed))),)
    try:
        form, margins = _compile(kind.system, len(words), follows, kind.profile.choices)
    except NoFormulaError as error:
        blamed = _texts(kind, _givens(kind, error.facts, error.unknowns)) or "the block"
        raise NotClosedError(f"{blamed}: {error.why}; {INSTEAD}") from None
    margins = replace(margins, checks=tuple(_named(form, margins.checks, kind)))
    found = []
    for values in product((1.0, -1.0), repeat=len(form.signs)):
        signs = tuple(zip(form.signs, values, strict=True))
        found.append(Branch(kind, tuple(words), margins, tuple(kind.fixed(margins.chart.fixed, dict(signs))), signs))
    return tuple(found)


def _distinct(branches: Sequence[Branch], low: Sequence[float], high: Sequence[float]) -> tuple[Branch, ...]:
    """The branches without those that are another one for all values in a box, as the two places of the centre of a
    half circle. Raises NotClosedError where what is divided by is zero for all of them."""
    if branches[0].kind.is_closed:
        return tuple(branches)
    form, found = close(branches[0].kind.system), list[Branch]()
    rng = numpy.random.default_rng(PLACES)
    places = [rng.uniform(*each, PLACES) for each in zip(low, high, strict=True)]
    for branch in branches:
        values = branch.margins.chart.at(places, branch.fixed)[: len(form.conditions)]
        again = False
        for condition, row in zip(form.conditions, values, strict=True):
            if condition.need is Need.REGULAR and (numpy.abs(row) <= REGULAR).all():
                blamed = _texts(branch.kind, _givens(branch.kind, condition.facts, condition.unknowns))
                raise NotClosedError(f"{blamed} do not fix what they speak about, whatever the value; {INSTEAD}")
            is_double = condition.need is Need.REAL and (numpy.abs(row) <= LEVEL).all()
            again = again or (is_double and dict(branch.signs)[ROOT + ",".join(condition.unknowns)] < 0)
        if not again:
            found.append(branch)
    return tuple(found)


def _texts(kind: Kind, givens: Sequence[str]) -> str:
    """The words and facts that state values, and those that ask."""
    stated = about_of(kind.free, kind.profile).words(givens)
    asked = join(list(dict.fromkeys(question.word.text for question in kind.profile.questions)))
    return f"{stated} with {asked}" if stated and asked else stated or asked


def _givens(kind: Kind, facts: Sequence[Fact], unknowns: Sequence[str]) -> tuple[str, ...]:
    """The values that some facts state; where one states none, also what they build on."""
    found = [fact.given for fact in facts if fact.given]
    for name in unknowns if len(found) < len(facts) or not found else ():
        found += settled_by(kind.profile, name)
    return tuple(dict.fromkeys(found))


def _named(form: ClosedForm, checks: Sequence[Check], kind: Kind) -> Iterator[Check]:
    """The checks, with the values that their conditions are about."""
    count = len(form.conditions)
    for condition, check in zip(form.conditions, checks[:count], strict=True):
        yield replace(check, givens=_givens(kind, condition.facts, condition.unknowns))
    yield from checks[count:]


@lru_cache(maxsize=64)
def _compile(system: System, words: int, follows: Follows, choices: tuple[Choice, ...]) -> tuple[ClosedForm, Margins]:
    """The closed form of a system, and the margins of all its branches as functions of some words."""
    form = close(system)
    tape = form.machine.tape.copy()
    known = {name: tape.expression(name) for name in system.unknowns}
    source = Source(system.figure, tape, lookup(system, tape, known | at_origin(system.figure)))
    plan = form.machine.plan
    facts = check_facts(source, plan.checks, len(plan.basis))
    found = [*_conditions(form), *_sides(form, choices), *facts, check_range(source), *check_path(source)]
    outputs = {str(number): expression for number, (_, expression) in enumerate(found)}
    return form, Margins(tuple(each for each, _ in found), Chart(tape, outputs, words, dict(follows)))


@lru_cache(maxsize=256)
def _results(system: System, words: int, follows: Follows, names: tuple[str, ...], *, is_rate: bool) -> Chart:
    tape = close(system).machine.tape
    return Chart(tape, {name: tape.expression(name) for name in names}, words, dict(follows), is_rate=is_rate)


def _conditions(form: ClosedForm) -> Checks:
    for condition in form.conditions:
        test, limit = (Test.APART, REGULAR) if condition.need is Need.REGULAR else (Test.AT_LEAST, 0.0)
        if condition.need is Need.POSITIVE:
            limit = REGULAR
        margin = Check(RefusalKind.NO_POINT, ",".join(condition.unknowns), "", test, limit)
        yield margin, form.machine.tape.expression(condition.output)


def _sides(form: ClosedForm, choices: Sequence[Choice]) -> Checks:
    """The sides that the words or the form choose."""
    for choice in choices:
        if choice.point in form.sides:
            output, positive = form.sides[choice.point]
            value = form.machine.tape.expression(output)
            givens = (choice.given,) if choice.given else ()
            yield (
                Check(RefusalKind.NO_POINT, choice.point, "", Test.AT_LEAST, 0.0, givens),
                value if choice.side.value == positive else -value,
            )
