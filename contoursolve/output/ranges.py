"""Ranges of values with a contour, as text and as plain data."""

from collections.abc import Iterator
from typing import Any

from contoursolve.families import End, Feasible
from contoursolve.output.layout import columns, count


def range_lines(found: Feasible) -> Iterator[str]:
    """The ranges of a word, each with what ends it."""
    low, high = (written(value, found.unit) for value in found.within)
    number = count(len(found.intervals), "range")
    proof = "proven to be all" if found.is_complete else "at least; that these are all is not proven"
    if not found.intervals:
        number, proof = "no range", "proven" if found.is_complete else "none was found, which is no proof"
    stated = written(found.stated, found.unit)
    yield f"{found.word}, now {stated}, from {low} to {high}: {number} with a contour ({proof})"
    rows = []
    for place, each in enumerate(found.intervals, 1):
        rows.append((f"{place}.", "from", *_row(each.low, found.unit)))
        rows.append(("", "to", *_row(each.high, found.unit)))
    yield from columns(rows, left=(0, 1, 3)) if rows else ()


def _row(end: End, unit: str) -> tuple[str, str]:
    if end.reason is None:
        return written(end.value, unit), "the range that was looked at"
    text = end.reason.text if end.is_verified else f"{end.reason.text} (not confirmed on both sides)"
    return written(end.value, unit), text if end.is_included else f"{text}; this value itself has none"


def written(value: float, unit: str) -> str:
    """A value of a word with its unit."""
    return f"{value + 0.0:.5f} in" if unit == "inch" else f"{value + 0.0:.4f} {unit}"


def range_data(found: Feasible) -> dict[str, Any]:
    """The ranges of a word as plain data: schema contoursolve/range/1. Values are as the word is written."""
    return {
        "schema": "contoursolve/range/1",
        "word": found.word,
        "unit": found.unit,
        "stated": found.stated,
        "within": list(found.within),
        "complete": found.is_complete,
        "ranges": [{"low": _end(each.low), "high": _end(each.high)} for each in found.intervals],
    }


def _end(end: End) -> dict[str, Any]:
    return {
        "value": end.value,
        "included": end.is_included,
        "found_by": end.way.value,
        "inside": end.inside,
        "outside": end.outside,
        "reason": {"text": end.reason.text, "code": end.reason.code or None, "message": end.reason.message or None}
        if end.reason
        else None,
    }
