"""Values that the program asks for: what the result answers, against what the claimed elements say."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import degrees
from typing import cast

from contoursolve.tolerance import LENGTH, RESIDUAL
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedAsked
from contoursolve.verification.drawing import Drawing, UnmeasurableError
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import PRINTED, ROUNDING
from contoursolve.verification.quantity import Quantity, Valued, quantity


@dataclass(frozen=True, slots=True)
class _Question:
    """What the program asks for, and what the elements answer; None if it has no answer there."""

    text: str
    label: str
    line: int
    answer: Quantity | None


def check_asked(case: Case, ledger: Ledger, values: Mapping[str, Quantity], drawing: Drawing) -> None:
    """Every question has its answer in the result, and no other has.

    `values` are what the words of the form would have to say, by their names.
    """
    if case.claimed.asked is None:
        return
    rest = list(case.claimed.asked)
    for question in _questions(case, values, drawing):
        matching = [each for each in rest if (each.word, each.line) == (question.text, question.line)]
        remark = "the result does not mention it"
        if ledger.require("the result answers what is asked for", [question.label], bool(matching), remark):
            rest.remove(matching[0])
            _check_answer(case, ledger, question, matching[0])
    names = [each.word for each in rest]
    ledger.require("the program asks for what the result answers", names, not rest, "it does not")


def _questions(case: Case, values: Mapping[str, Quantity], drawing: Drawing) -> Iterator[_Question]:
    for name in case.asked:
        word = case.claim.words[name]
        if name in values:
            yield _Question(word.text, word.text, word.span.line, values[name])
    for each in case.facts:
        if each.is_asked:
            try:
                answer = quantity(cast("Valued", each.fact), drawing, case.origin)
            except UnmeasurableError:
                answer = None
            yield _Question(each.text, each.label, each.line, answer)


def _check_answer(case: Case, ledger: Ledger, question: _Question, asked: ClaimedAsked) -> None:
    name, words, answer = "the value that is asked for is that of the elements", [question.label], question.answer
    if answer is not None and answer.is_angle and answer.reach <= LENGTH:
        ledger.omit(question.label, "what has no length has no direction")
        return
    if answer is None or asked.value is None:
        ledger.require(name, words, answer is None and asked.value is None, "only one of them has a value")
        return
    wanted = "deg" if answer.is_angle else "mm"
    if not ledger.require(
        "its unit is what it measures", words, asked.unit == wanted, f"it is {asked.unit}, not {wanted}"
    ):
        return
    off = asked.value - answer.value
    if answer.is_angle:
        unsure = degrees((2 * PRINTED + ROUNDING * case.size + 2 * case.grain) / answer.reach)
        ledger.measure(name, words, (off + 180) % 360 - 180, RESIDUAL + unsure, "deg")
    else:
        ledger.measure(name, words, off, case.limit)
