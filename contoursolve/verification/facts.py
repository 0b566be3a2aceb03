"""The further facts of a contour, as the program's comments and the result state them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import cast

from contoursolve.reading import Claim
from contoursolve.statements import GrammarError, MeetsLine, Vocabulary, read_statement
from contoursolve.tolerance import LARGEST
from contoursolve.verification.drawing import Drawing, UnmeasurableError
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.quantity import Fact, Origin, gap, numbers
from contoursolve.verification.statement import Statement

STEP = 1e-6
"""1 (share of the reach). How far unknowns are moved to see how a fact changes: far enough above the rounding
of a difference, and far enough below the radius of any curve."""


@dataclass(frozen=True, slots=True)
class StatedFact:
    """A fact of a contour. `fact` is None if it cannot be read; `problem` then says why.

    `is_known` tells that the program states it, or that it was given with the program; otherwise only the result
    states it. What is not in the program itself has a line below zero.
    """

    text: str
    line: int
    fact: Fact | None
    is_known: bool
    problem: str = ""

    @property
    def label(self) -> str:
        """What checks call it."""
        return self.text if self.is_known else f"{self.text} (stated in the result only)"

    @property
    def is_asked(self) -> bool:
        """Whether its value is asked for."""
        return self.fact is not None and getattr(self.fact, "value", 0) is None

    @property
    def is_stated(self) -> bool:
        """Whether it says something about the points."""
        return self.fact is not None and not self.is_asked and not isinstance(self.fact, MeetsLine)


def read_facts(claim: Claim, elements: Sequence[str], points: Sequence[str], apart: int) -> tuple[StatedFact, ...]:
    """The facts of a contour whose elements and points have these names; so many were given apart."""
    words = Vocabulary(elements, points, claim.after.plane, claim.after.unit)
    found = []
    for directive in claim.directives:
        fact, problem = None, ""
        try:
            fact = cast("Fact", read_statement(directive.text, words))
        except GrammarError as error:
            problem = str(error)
        if fact and any(abs(value) > LARGEST for value in numbers(fact)):
            fact, problem = None, "a number is too large"
        line = directive.span.line
        found.append(StatedFact(directive.text, line, fact, line >= -apart, problem))
    return tuple(found)


def check_readable(facts: Sequence[StatedFact], ledger: Ledger) -> bool:
    """Every fact can be read; those that nothing but the result has are listed."""
    for each in facts:
        if not each.is_known:
            ledger.omit(f"the fact {each.text}", "stated in the result only: checked, but not known from the program")
    unreadable = [each for each in facts if each.fact is None]
    remark = "; ".join(f"{each.text}: {each.problem}" for each in unreadable)
    return not facts or ledger.require(
        "every fact can be read", [each.label for each in unreadable], not unreadable, remark
    )


@dataclass(frozen=True, slots=True)
class Sight:
    """How facts are looked at: the claimed drawing, the unknowns (mm) that it has, and how it changes with them."""

    claimed: Drawing
    unknowns: tuple[float, ...]
    redraw: Callable[[Sequence[float]], Drawing]
    origin: Origin
    reach: float


def statements(facts: Sequence[StatedFact], sight: Sight, ledger: Ledger) -> Iterator[Statement]:
    """What the facts say about the unknowns; one about something that is not there fails."""
    for each in facts:
        if each.fact is None or not each.is_stated:
            continue
        value = _value(each.fact, sight)
        try:
            here, there = gap(each.fact, sight.claimed, sight.origin), value(sight.unknowns)
            slope = slopes(value, sight.unknowns, STEP * sight.reach)
        except UnmeasurableError as error:
            ledger.require("the fact is about the contour", [each.label], False, str(error))
            continue
        yield Statement("the fact holds", each.label, slope, here.residual, here.degrees, there, here.against, value)


def _value(fact: Fact, sight: Sight) -> Callable[[Sequence[float]], float]:
    """A fact's residual (mm) as a function of the unknowns."""
    return lambda at: gap(fact, sight.redraw(at), sight.origin).residual


def slopes(value: Callable[[Sequence[float]], float], at: Sequence[float], step: float) -> tuple[float, ...]:
    """How a value changes with each of several numbers, by central differences."""
    found = []
    for index in range(len(at)):
        low, high = ((*at[:index], at[index] + off, *at[index + 1 :]) for off in (-step, step))
        found.append((value(high) - value(low)) / (2 * step))
    return tuple(found)
