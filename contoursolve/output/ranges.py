"""Ranges of values with a contour, as text and as plain data."""

from collections.abc import Iterator
from typing import Any

from contoursolve.families import Boundary, End, Feasible, Region
from contoursolve.output.layout import columns, count, written


def range_lines(found: Feasible) -> Iterator[str]:
    """The ranges of a word, each with what ends it."""
    yield range_title(found)
    rows = range_rows(found)
    yield from columns(rows, left=(0, 1, 3)) if rows else ()
    yield from range_notes(found)


def range_notes(found: Feasible) -> Iterator[str]:
    """What is not proven, and why the block has no contour as it stands, if it has none."""
    yield from (f"  not proven: {each}" for each in found.doubts)
    if found.refusal:
        yield f"  as it stands, the block has none: {found.refusal}"


def range_title(found: Feasible) -> str:
    """What was looked at, and how many ranges there are."""
    low, high = (written(value, found.unit) for value in found.within)
    number = count(len(found.intervals), "range")
    proof = "proven to be all" if found.is_complete else "at least; that these are all is not proven"
    if not found.intervals:
        number, proof = "no range", "proven" if found.is_complete else "none was found, which is no proof"
    stated = written(found.stated, found.unit)
    return f"{found.word}, now {stated}, from {low} to {high}: {number} with a contour ({proof})"


def range_rows(found: Feasible) -> list[tuple[str, str, str, str]]:
    """Two rows for each range: its number, which end, the value, and what ends it there."""
    rows = []
    for place, each in enumerate(found.intervals, 1):
        rows.append((f"{place}.", "from", *_row(each.low, found.unit, -1)))
        rows.append(("", "to", *_row(each.high, found.unit, 1)))
    return rows


def _row(end: End, unit: str, way: int) -> tuple[str, str]:
    if end.reason is None:
        return written(end.value, unit, way), "the range that was looked at"
    text = end.reason.text if end.is_verified else f"{end.reason.text} (not confirmed on both sides)"
    return written(end.value, unit, way), text if end.is_included else f"{text}; this value itself has none"


def range_data(found: Feasible) -> dict[str, Any]:
    """The ranges of a word as plain data: schema contoursolve/range/1. Values are as the word is written."""
    return {
        "schema": "contoursolve/range/1",
        "word": found.word,
        "unit": found.unit,
        "stated": found.stated,
        "within": list(found.within),
        "complete": found.is_complete,
        "doubts": list(found.doubts),
        "refusal": found.refusal or None,
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


def region_lines(found: Region) -> Iterator[str]:
    """The lines that bound the region of two words."""
    yield region_title(found)
    rows = region_rows(found)
    yield from columns(rows, left=(0, 1, 3)) if rows else ()
    yield from (f"  not proven: {each}" for each in found.doubts)


def region_title(found: Region) -> str:
    """What was looked at, and how many lines there are."""
    spans = zip(found.words, found.within, found.units, strict=True)
    box = ", ".join(f"{word} from {written(low, unit)} to {written(high, unit)}" for word, (low, high), unit in spans)
    proof = "proven to be all" if found.is_complete else "at least; that these are all is not proven"
    number = count(len(found.boundaries), "line") if found.boundaries else "no line"
    whole = "" if found.boundaries else f"; there is {'a' if found.exists else 'no'} contour everywhere"
    return f"{box}: {number} between where the contour exists and where not ({proof}){whole}"


def region_rows(found: Region) -> list[tuple[str, str, str, str]]:
    """A row for each line: its number, its ends, how many points it has, and what fails beyond it."""
    rows = []
    for place, each in enumerate(found.boundaries, 1):
        first, last = (_pair(point, found) for point in (each.points[0], each.points[-1]))
        where = "on it" if each.is_gap else "beyond it"
        doubt = f"; {each.unverified} points not confirmed on both sides" if each.unverified else ""
        points = f"{len(each.points)} points"
        rows.append((f"{place}.", f"{first} to {last}", points, f"{where}: {each.reason.text}{doubt}"))
    return rows


def _pair(point: tuple[float, float], found: Region) -> str:
    pairs = zip(found.words, point, found.units, strict=True)
    return " ".join(f"{word} {written(value, unit)}" for word, value, unit in pairs)


def region_data(found: Region) -> dict[str, Any]:
    """The region of two words as plain data: schema contoursolve/region/1. Values are as the words are written."""
    return {
        "schema": "contoursolve/region/1",
        "words": list(found.words),
        "units": list(found.units),
        "stated": list(found.stated),
        "within": [list(each) for each in found.within],
        "exists": found.exists,
        "complete": found.is_complete,
        "doubts": list(found.doubts),
        "cell": list(found.cell),
        "boundaries": [_boundary(each) for each in found.boundaries],
    }


def _boundary(each: Boundary) -> dict[str, Any]:
    return {
        "reason": {"text": each.reason.text, "code": each.reason.code or None, "message": each.reason.message or None},
        "found_by": each.way.value,
        "gap": each.is_gap,
        "inside": list(each.inside) if each.inside else None,
        "outside": list(each.outside) if each.outside else None,
        "unverified": each.unverified,
        "points": [list(point) for point in each.points],
    }
