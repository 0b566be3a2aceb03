"""All solutions of one contour, for a person and for JSON: which there are, what selects each, how well it is known."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor, inf, log10
from typing import TYPE_CHECKING

from contoursolve.diagnosis.answer_records import AskedValue, Solution, Solutions
from contoursolve.diagnosis.examine import (
    Answer,
    answer_question,
    count_choices,
    is_rounded,
    list_alternatives,
)
from contoursolve.gcode import FACT
from contoursolve.geometry import Length, Pick, assemble
from contoursolve.solving import (
    DECIMALS,
    Certificate,
    Proof,
    groups_of,
    trace,
    up_to_one_digit,
)
from contoursolve.tolerance import LENGTH

if TYPE_CHECKING:
    from contoursolve.solving import Alternative, Alternatives


def list_solutions(answer: Answer) -> Solutions | None:
    """Every solution of a contour, each with what selects it and how sure it is."""
    alternatives = list_alternatives(answer)
    if alternatives is None:
        if answer.contour is None or answer.certificate is None:
            return None
        only = Solution("", answer.contour, answer.asked, (), (), is_chosen=True, certificate=answer.certificate)
        choices = count_choices(answer.profile)
        why = "a half circle is one within the least increments" if is_rounded(answer) else "too many to list"
        doubts = (f"the other sides of {choices} points: {why}",) if choices else ()
        return Solutions((only,), not doubts, "closed form", doubts, chosen_by="", steps=_steps(answer))
    from contoursolve.solving import choose, pick  # noqa: PLC0415 - most contours need no choice

    eligible = choose(alternatives, answer.profile.choices)
    paths, _ = pick([item for item in eligible if item.is_path], answer.profile)
    chosen = paths[0] if len(paths) == 1 and answer.contour is not None else None
    words = [
        answer.claim.words[choice.given].text for choice in answer.profile.choices if choice.given in answer.claim.words
    ]
    method = "closed form"
    if alternatives.reach is not None:
        from contoursolve.solving import SMALLEST  # noqa: PLC0415 - most contours need no search

        method = f"search within {alternatives.reach:.0f} mm of the start point, for elements of at least {SMALLEST} mm"
    return Solutions(
        solutions=tuple(_listed(item, item is chosen, alternatives, answer) for item in alternatives.items),
        is_complete=alternatives.is_complete,
        method=method,
        doubts=tuple(f"{', '.join(doubt.unknowns)}: {doubt.obstacle.value}" for doubt in alternatives.doubts),
        chosen_by=" and ".join(words) if chosen and len(alternatives.items) > 1 else "",
        within=alternatives.reach,
        steps=_steps(answer),
        boxes=alternatives.boxes,
    )


def _steps(answer: Answer) -> int:
    return len(groups_of(assemble(answer.profile)))


def _listed(item: Alternative, is_chosen: bool, alternatives: Alternatives, answer: Answer) -> Solution:
    profile = answer.profile
    contour = trace(profile, item.solution) if item.is_path else None
    asked = tuple(answer_question(question, profile, item.solution) for question in profile.questions)
    name = item.name
    for key, given in profile.givens.items():
        if given.word is not None and given.word.address == FACT:
            # A side that a fact leaves open is told by the fact.
            name = name.replace(f"{key} ", f"{given.word.text.partition(' [')[0].partition(' (')[0]} ")
    return Solution(
        name=name,
        contour=contour,
        asked=asked,
        reasons=tuple(f"{refusal.kind.value} {refusal.subject}".strip() for refusal in item.solution.refusals),
        selects=tuple(_selecting(item, asked, alternatives, answer)),
        is_chosen=is_chosen,
        certificate=item.certificate,
        picks=tuple(_picks_of(item, alternatives, answer)),
    )


def _selecting(item: Alternative, asked: Sequence[AskedValue], alternatives: Alternatives, answer: Answer) -> list[str]:
    """The words, or else the fact, that would select a solution."""
    if len(alternatives.items) == 1:
        return []
    if answer.claim.form.free.picking:
        from contoursolve.diagnosis.names_in_program import block_numbers  # noqa: PLC0415 - few controls count so

        word, path = answer.claim.form.free.picking, answer.profile.figure.path
        picks = _picks_of(item, alternatives, answer)
        numbered = {number: f"block {number}" for number in block_numbers(answer.claim.blocks).values()}
        labels = [(each.number, path[each.element - 1].name) for each in picks]
        return [
            f"{answer.claim.lexicon.spell(word, str(number))} after {numbered.get(name.partition(' ')[2], name)}"
            for number, name in labels
        ]
    words = [
        selector.word
        for selector in answer.claim.selectors
        if item.sides.get(selector.point) == selector.side.value
        and len({other.sides.get(selector.point) for other in alternatives.items}) > 1
    ]
    if words:
        return words
    written = [_written(each, answer) for each in asked if each.value is not None]
    if any(written):
        return [word for word in written if word]
    plane, unit = answer.profile.plane, answer.unit
    for point in answer.profile.figure.points:
        for axis in (0, 1):
            name = f"{point}.{axis}"
            others = [other.scalars[name] for other in alternatives.items if other is not item]
            if all(abs(item.scalars[name] - value) > 10 * LENGTH for value in others) and "." not in point:
                value = item.scalars[name] * (2 if plane.diameters[axis] else 1)
                shown = value / 25.4 if unit is Length.INCH else value
                fact = f"contoursolve: {plane.axes[axis]} of {point} = {shown:.3f}"
                return [answer.claim.blocks[0].syntax.remark.format(fact)]
    return []


def _picks_of(item: Alternative, alternatives: Alternatives, answer: Answer) -> list[Pick]:
    """The numbers that choose a solution, each with its element; none where the control has no word for them."""
    if not answer.claim.form.free.picking or not item.is_path:
        return []
    from contoursolve.solving import numbers_of  # noqa: PLC0415 - few controls have such words

    return numbers_of(item, alternatives.paths, answer.profile)


def _written(asked: AskedValue, answer: Answer) -> str:
    """An asked word with its value; empty for what is no word."""
    word = asked.question.word
    if asked.value is None or word.address == FACT:
        return ""
    from contoursolve.diagnosis.edits import write_word  # noqa: PLC0415 - few contours have several solutions

    return write_word(word.address, asked.value, answer.claim.lexicon, answer.unit)


def printed_certificate(certificate: Certificate | None) -> Certificate | None:
    """A certificate of the numbers as they are printed: rounded to `decimals_of` it."""
    if certificate is None:
        return None
    if certificate.proof is Proof.EXACT:
        return Certificate(certificate.proof, 0.0, certificate.reason, certificate.gap)
    rounding = 0.5 * 10.0 ** -decimals_of(certificate)
    radius = up_to_one_digit(certificate.radius + rounding)
    return Certificate(certificate.proof, radius, certificate.reason, certificate.gap)


def certificate_text(certificate: Certificate | None) -> str:
    """A certificate of the numbers as they are printed, in one short sentence; empty if it is the usual one."""
    printed = printed_certificate(certificate)
    return "" if printed is None or printed.is_usual else str(printed)


def decimals_of(certificate: Certificate | None, most: int = DECIMALS) -> int:
    """The number of decimals of a coordinate in mm that mean something: the radius is not larger than the last one."""
    if certificate is None or not 0 < certificate.radius < inf:
        return most
    return max(0, min(most, floor(-log10(certificate.radius))))
