"""The values that a block asked for, written into it, and the block tried again as the control would read it."""

from dataclasses import replace as replace_fields
from math import hypot

from msgspec.structs import replace

from contoursolve.diagnosis.answer_records import Filled
from contoursolve.diagnosis.edits import change, write_word
from contoursolve.diagnosis.examine import Answer, Policy, examine
from contoursolve.gcode import FACT
from contoursolve.solving import Contour

FARTHEST = 0.01
"""mm. A block with rounded values whose contour is farther from the exact one is not offered."""


def fill_in(answer: Answer) -> Filled | None:
    """The blocks of an answer with the values that they ask for; None if they do not stand alone then.

    The further facts are left out: the control does not read them.
    """
    edits = []
    for word, value in ((each.question.word, each.value) for each in answer.asked):
        if word.address == FACT:
            continue
        if value is None:
            return None
        edits.append(change(word, write_word(word.address, value, answer.claim.lexicon, answer.unit)))
    claim = answer.read_by.read(answer.claim, edits) if edits else None
    if claim is None or answer.contour is None:
        return None
    bare = replace_fields(claim, blocks=tuple(replace(each, directives=()) for each in claim.blocks))
    again = examine(bare, answer.read_by.control, Policy.ENFORCE)
    if again.contour is None:
        return None
    deviation = _deviation(again.contour, answer.contour)
    return Filled(tuple(each.text for each in bare.blocks), deviation) if deviation <= FARTHEST else None


def _deviation(first: Contour, second: Contour) -> float:
    """The largest distance between the ends of corresponding elements, mm; infinite where they differ in kind."""
    if [type(each) for each in first.elements] != [type(each) for each in second.elements]:
        return float("inf")
    pairs = zip(first.elements, second.elements, strict=True)
    return max((hypot(one.end[0] - two.end[0], one.end[1] - two.end[1]) for one, two in pairs), default=0.0)
