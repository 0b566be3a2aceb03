"""Where on its slider each word has a contour."""

from collections.abc import Mapping
from decimal import Decimal
from typing import Any

from contoursolve.families import End, FamilyError, Feasible, Interval, Way, feasible
from contoursolve.notebook.exploration import Exploration, words_of
from contoursolve.reading import Trouble
from contoursolve.syntax import Word
from contoursolve.wording import inward

_MARGIN = 0.1
"""Share of a range that a slider shows beyond its ends."""

Data = dict[str, Any]


def frames_of(exploration: Exploration) -> dict[str, str]:
    """The text around each word with a value, by the word's key: its range stays as long as this does."""
    answer = exploration.answer
    if answer is None:
        return {}
    return {key: _frame(exploration, word) for key, word in words_of(answer).items() if word.number is not None}


def _frame(exploration: Exploration, word: Word) -> str:
    blocks = exploration.result.program.blocks
    return "\n".join(
        block.text[: word.span.column - 1] + "\0" + block.text[word.span.end_column - 1 :]
        if block.line == word.span.line
        else block.text
        for block in blocks
    )


def range_of(exploration: Exploration, field: Mapping[str, Any]) -> Data:
    """The ranges of the word of a field, and the ends that its slider needs to show them; nothing for a word of which
    no range can be told."""
    if any(finding.about is Trouble.UNDERDETERMINED for finding in exploration.result.diagnostics):
        return {}  # whatever this word says, others are missing
    low, high = field["low"], field["high"]
    within = (low - (high - low) / 2, high + (high - low) / 2) if field["unit"] == "deg" else None
    try:
        found = feasible(exploration.text, field["key"], within=within, **exploration.options)
    except FamilyError:  # facts without a closed form, words that only choose
        return {}
    # An end that is far away on the scale of the contour is not worth a slider that is too coarse.
    near = (field["value"] - field["size"], field["value"] + field["size"])
    margin = _MARGIN * (high - low)
    for each in found.intervals:
        if field["value"] in each:
            low = min(low, each.low.value - margin) if each.low.value > near[0] else low
            high = max(high, each.high.value + margin) if each.high.value < near[1] else high
    return {
        "intervals": [[each.low.value, each.high.value] for each in found.intervals],
        "low": max(low, found.within[0]),
        "high": min(high, found.within[1]),
        "note": _note(found, field["key"].rpartition(":")[2]),
        "reason": "; ".join(_reasons(found)),
    }


def _note(found: Feasible, name: str) -> str:
    """The ranges in a line, such as `0 ≤ P ≤ 51.961`."""
    shown = " or ".join(filter(None, (_interval(each, name, found.unit) for each in found.intervals)))
    known = "" if found.is_complete else " (at least)"
    if not found.intervals:
        return f"no contour for any {name}{known}"
    return f"{shown or f'any {name}'}{known}"


def _interval(interval: Interval, name: str, unit: str) -> str:
    least, most = (
        inward(Decimal(repr(each.value)), unit, way) for each, way in ((interval.low, -1), (interval.high, 1))
    )
    if least > most or interval.low.value == interval.high.value:
        # No value of the control's increment lies between them.
        return f"{name} = {(interval.low.value + interval.high.value) / 2:.9g}"
    low, high = _end(interval.low, least, -1), _end(interval.high, most, 1)
    if not low and high:
        return f"{name} {high}"
    if low and not high:
        value, _, sign = low.rpartition(" ")
        return f"{name} {'>' if sign == '<' else '≥'} {value}"
    return f"{low} {name} {high}" if low and high else ""


def _end(end: End, rounded: Decimal, way: int) -> str:
    """An end rounded into its range, with the sign that says whether it belongs to it."""
    if end.way is Way.RANGE:
        return ""
    sign = "<" if rounded == Decimal(repr(end.value)) and not end.is_included else "≤"
    text = f"{rounded.normalize() + 0:f}"
    return f"{text} {sign}" if way < 0 else f"{sign} {text}"


def _reasons(found: Feasible) -> list[str]:
    """What fails beyond the ends."""
    ends = (end for each in found.intervals for end in (each.low, each.high))
    return list(dict.fromkeys(end.reason.text for end in ends if end.reason is not None))
