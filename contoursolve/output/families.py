"""Answers about a family as text and as plain data: ranges, regions, values that reach a goal, tolerances."""

from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from math import isnan
from typing import Any

from contoursolve.comparison import Unfollowed
from contoursolve.diagnosis import (
    axis_labels,
    certificate_text,
    count,
    length_in,
    limit_text,
    measured,
    printed_certificate,
    short_name,
    written,
)
from contoursolve.diagnostics import members
from contoursolve.families import (
    CompiledSweep,
    Contribution,
    End,
    Family,
    FeasibleRange,
    FeasibleRegion,
    FoundValues,
    Hit,
    Reason,
    ToleranceRange,
    Tolerances,
    Way,
)
from contoursolve.geometry import Length
from contoursolve.output.plain_text import RecordView, Table, columns
from contoursolve.output.premises import premise_data, premise_texts
from contoursolve.tool_radius import least_of

# Ranges of a word --------------------------------------------------------------------------------------------


def range_view(found: FeasibleRange) -> RecordView:
    """The ranges of a word, two rows for each: its number, which end, the value, and what ends it there. Below, what is
    not proven, the refusal of the block as it stands, and the premises."""
    low, high = (written(value, found.unit) for value in found.within)
    number, proof = count(len(found.intervals), "range"), _proof(is_complete=found.is_complete)
    if not found.intervals:
        number, proof = "no range", "proven" if found.is_complete else "none was found, which is no proof"
    now = "" if found.is_open else f" now {written(found.stated, found.unit)},"
    title = f"{found.word},{now} from {low} to {high}: {number} {found.holds} ({proof})"
    rows = []
    for place, each in enumerate(found.intervals, 1):
        rows.append((f"{place}.", "from", *_end_cells(each.low, found.unit)))
        rows.append(("", "to", *_end_cells(each.high, found.unit)))
    header = ("range", "end", "value", "what ends it")
    table = Table("Where the contour exists", header, rows, left=(0, 1, 3), is_headed=False)
    warnings = [f"warning: {each}" for each in found.warnings]
    refusal = [f"as it stands, the block has none: {found.refusal}"] if found.refusal else []
    return RecordView(title, [table, *_doubts(found), *warnings, *refusal, *rest_lines(found)], found)


def _doubts(found: FeasibleRange | FoundValues | ToleranceRange) -> Iterator[str]:
    yield from (f"not proven: {each}" for each in found.doubts)


def rest_lines(
    found: FeasibleRange | FeasibleRegion | FoundValues | Tolerances | ToleranceRange | CompiledSweep | Family,
) -> Iterator[str]:
    """Lines of the premises of an answer: settings and assumptions beside the words."""
    yield from premise_texts(found.premises, found.premises.control)


def _proof(*, is_complete: bool) -> str:
    return "proven to be all" if is_complete else "at least; that these are all is not proven"


def _end_cells(end: End, unit: str) -> tuple[str, str]:
    text = end.reason.text if end.reason is not None else "end of the range searched"
    return limit_text(end.listed, unit), f"{text} (not confirmed on both sides)" if not end.is_verified else text


def range_data(found: FeasibleRange) -> dict[str, Any]:
    """The ranges of a word as plain data: schema contoursolve/range/1. Values are as the word is written."""
    return {
        "schema": "contoursolve/range/1",
        **members(found, "word unit stated within complete=is_complete doubts warnings"),
        **({"stated": None} if found.is_open else {}),
        "refusal": found.refusal or None,
        **premise_data(found.premises),
        "ranges": [{"low": _end_data(each.low), "high": _end_data(each.high)} for each in found.intervals],
    }


def _end_data(end: End) -> dict[str, Any]:
    reason = _reason_data(end.reason) if end.reason else None
    return {**members(end, "value included=is_included found_by=way inside outside"), "reason": reason}


def _reason_data(reason: Reason) -> dict[str, str | None]:
    return {"text": reason.text, "code": reason.code or None, "message": reason.message or None}


def tools_lines(found: Mapping[tuple[int, ...], FeasibleRange], unfollowed: Sequence[Unfollowed]) -> Iterator[str]:
    """The largest tool for all contours of a program, that for each contour, by its lines, and what is left out."""
    least, rows = least_of(found), []
    whole = f"all {len(found)} contours" if len(found) > 1 else "the contour"
    largest = "".join(limit_text(each.high.listed, least.unit) for each in least.intervals[:1])
    yield f"largest tool for {whole}: {largest}" if least.largest else f"no tool of the range searched cuts {whole}"
    for place, (lines, each) in enumerate(found.items(), 1):
        where = f"program lines {lines[0]} to {lines[-1]}" if len(lines) > 1 else f"program line {lines[0]}"
        rows += [(f"{place}.", where, "none", each.refusal)] * (not each.intervals)
        for number, part in enumerate(each.intervals):
            ends = [_end_cells(part.high, each.unit)]
            if part.low.reason is not None:
                ends = [
                    (f"{word} {value}", text)
                    for word, (value, text) in (("from", _end_cells(part.low, each.unit)), ("to", *ends))
                ]
            rows += [(*(("", "") if number or row else (f"{place}.", where)), *end) for row, end in enumerate(ends)]
    yield from columns(rows, left=(0, 1, 3))
    warnings = dict.fromkeys(text for each in found.values() for text in each.warnings)
    yield from (f"  warning: {each}" for each in warnings)
    for reason in dict.fromkeys(each.reason for each in unfollowed):
        places = ", ".join(str(each.line) for each in unfollowed if each.reason == reason)
        yield f"  not looked at: program line {places} ({reason})"
    yield from (f"  {each}" for each in rest_lines(least))


def tools_data(found: Mapping[tuple[int, ...], FeasibleRange], unfollowed: Sequence[Unfollowed]) -> dict[str, Any]:
    """The same as plain data: schema contoursolve/find-tool/1."""
    contours = [{"lines": [*lines], **range_data(each)} for lines, each in found.items()]
    least, left_out = least_of(found), [members(each, "line text reason") for each in unfollowed]
    largest = {"schema": "contoursolve/find-tool/1", "largest": least.largest or None, "unit": least.unit}
    return {**largest, "contours": contours, "not_followed": left_out}


# Regions of two words ----------------------------------------------------------------------------------------


def region_view(found: FeasibleRegion) -> RecordView:
    """The lines that bound the region of two words, a row each: its ends, how many points it has, and what fails beyond
    it. Below, how finely it was sampled, and the premises."""
    spans = zip(found.words, found.within, found.units, strict=True)
    box = ", ".join(f"{word} from {written(low, unit)} to {written(high, unit)}" for word, (low, high), unit in spans)
    number = count(len(found.boundaries), "line") if found.boundaries else "no line"
    whole = "" if found.boundaries else f"; {'all' if found.exists else 'none'} of the values sampled have a contour"
    title = f"{box}: {number} between where the contour exists and where not (sampled, not proven){whole}"
    rows = []
    for place, each in enumerate(found.boundaries, 1):
        first, last = (_pair(point, found) for point in (each.points[0], each.points[-1]))
        rows.append((f"{place}.", f"{first} to {last}", f"{len(each.points)} points", f"beyond it: {each.reason.text}"))
    header = ("line", "from and to", "points", "where there is no contour")
    table = Table("The lines that bound it", header, rows, left=(0, 1, 3), is_headed=False)
    return RecordView(title, [table, found.fineness, *rest_lines(found)], found)


def _pair(point: tuple[float, float], found: FeasibleRegion) -> str:
    pairs = zip(found.words, point, found.units, strict=True)
    return " ".join(f"{word} {written(value, unit)}" for word, value, unit in pairs)


def region_data(found: FeasibleRegion) -> dict[str, Any]:
    """The region of two words as plain data: schema contoursolve/region/2. Values are as the words are written."""
    return {
        "schema": "contoursolve/region/2",
        **members(found, "words units stated within exists"),
        "sampled": members(found, "edges_within=cell narrower_may_be_missing=seen"),
        **premise_data(found.premises),
        "boundaries": [
            {"reason": _reason_data(each.reason), **members(each, "outside points")} for each in found.boundaries
        ],
    }


# Values that bring a point where it is wanted ----------------------------------------------------------------


def found_view(found: FoundValues) -> RecordView:
    """The values that bring a point where it is wanted: where it is then, the certificate if there is one, the block to
    write, and what rounding does."""
    low, high = (written(value, found.unit) for value in found.within)
    number = count(len(found.hits), "value") if found.hits else "no value"
    aim, proof = "nearest to" if found.goal.is_nearest else "at", _proof(is_complete=found.is_complete)
    goal = measured(found.goal.place, found.plane, found.length)
    title = f"{found.goal.point} {aim} {goal}, by {found.word} from {low} to {high}: {number} ({proof})"
    header = (found.word, "the point is then at", "certificate", "the block", "what rounding does")
    rows = [_hit_cells(hit, found) for hit in found.hits]
    table = Table("Values", header, rows, left=(1, 2, 3, 4), is_listed=True)
    remark = [found.remark] if found.remark else []
    return RecordView(title, [*remark, *_doubts(found), table, *rest_lines(found)])


def _hit_cells(hit: Hit, found: FoundValues) -> tuple[str, str, str, str, str]:
    away = f", {length_in(hit.away, found.length)} away" if found.goal.is_nearest else ""
    at = f"{measured(hit.point, found.plane, found.length)}{away}"
    rounding = "rounded like this, the block has no contour"
    if hit.rounded_away is not None:
        off = "away" if found.goal.is_nearest else "off"
        rounding = f"rounded like this, the point is {length_in(hit.rounded_away, found.length)} {off}"
    return written(hit.value, found.unit), at, certificate_text(hit.certificate), hit.block, rounding


def found_data(found: FoundValues) -> dict[str, Any]:
    """The values as plain data: schema contoursolve/find/1. Points are in mm, X of a lathe as radius."""
    return {
        "schema": "contoursolve/find/1",
        **members(found, "word unit stated within"),
        **members(found.plane, "plane=axes"),
        **members(found.goal, "point goal=place"),
        "aim": "nearest" if found.goal.is_nearest else "reach",
        **members(found, "complete=is_complete doubts"),
        "remark": found.remark or None,
        **premise_data(found.premises),
        "values": [_hit_data(hit) for hit in found.hits],
    }


def _hit_data(hit: Hit) -> dict[str, Any]:
    certificate = printed_certificate(hit.certificate)
    return {
        **members(hit, "value at=point away_mm=away"),
        "certificate": members(certificate, "kind=proof radius") if certificate else None,
        **members(hit, "rounded block rounded_away_mm=rounded_away"),
    }


# Which word moves a point most -------------------------------------------------------------------------------


def tolerances_view(found: Tolerances) -> RecordView:
    """The words, the one that moves the point most first: its derivatives and what its tolerance moves, in the unit of
    the program. Below, what all tolerances come to."""
    place, has_tolerances = measured(found.place, found.plane, found.length), _has_tolerances(found)
    head = ["word", "value", *(f"{label} per unit" for label in axis_labels(found.plane))]
    head += ["tolerance", "moves it by"] if has_tolerances else []
    rows = [_effect_cells(each, found, has_tolerances) for each in found.effects]
    table = Table("What each word does", [*head, "half an increment"], rows)
    title = f"{found.point}: {place}; moved by each word, the most first"
    return RecordView(title, [table, *_spread_lines(found)])


def _spread_lines(found: Tolerances) -> Iterator[str]:
    """Lines about tolerances: limits without a contour first, then the spread of the point, then rounding."""
    limits, unit = found.limits, found.length
    for missing in limits.missing if limits is not None else ():
        place = ", ".join(f"{word} {value:g}" for word, value in missing.values.items())
        which = f"such as {place}" if missing.count > 1 else f"at {place}"
        many = f"{missing.count} of {count(limits.count, 'combination')}" if limits is not None else ""
        yield f"no contour at {many} of the limits, {which}: {missing.message}"
    if _has_tolerances(found):
        pairs = zip(axis_labels(found.plane), found.spread, found.plane.diameters, strict=True)
        spreads = [(label, each, 2 if is_diameter else 1) for label, each, is_diameter in pairs]
        worst = ", ".join(f"{label} {length_in(each.worst * times, unit)}" for label, each, times in spreads)
        typical = ", ".join(f"{label} {length_in(each.typical * times, unit)}" for label, each, times in spreads)
        yield f"off by at worst {worst}; statistically (RSS) {typical}"
    if limits is not None and not isnan(limits.low[0]):
        lowest, highest = (measured(at, found.plane, unit) for at in (limits.low, limits.high))
        solved = f"{limits.count - limits.without} of {limits.count}" if limits.without else f"all {limits.count}"
        yield f"solved at {solved} combinations of the limits: from {lowest} to {highest}"
    for each in found.effects:
        if each.rounded is not None and each.rounded != each.stated:
            by = "" if each.by_rounding is None else length_in(each.by_rounding, unit)
            moved = f"moves it by {by}" if by else "leaves no contour"
            linear = f"{length_in(each.by_rounding_linear, unit)} by the derivatives"
            yield f"{each.word} rounded to {written(each.rounded, each.unit)} {moved} ({linear})"
    yield from rest_lines(found)


def _has_tolerances(found: Tolerances) -> bool:
    return found.limits is not None or any(each.tolerance is not None for each in found.effects)


def _effect_cells(each: Contribution, found: Tolerances, has_tolerances: bool) -> list[str]:
    slopes = [
        _length(slope * (2 if is_diameter else 1), found.length)
        for slope, is_diameter in zip(each.slope, found.plane.diameters, strict=True)
    ]
    slopes = [slope if slope == _NONE else f"{slope}/{short_name(each.unit)}" for slope in slopes]
    row = [each.word, written(each.stated, each.unit), *slopes]
    if has_tolerances and each.tolerance is not None:
        row += [f"{each.tolerance:g} {short_name(each.unit)}", _length(each.moves, found.length)]
    elif has_tolerances:
        row += ["", ""]
    half = "no contour" if each.by_half is None else _length(each.by_half, found.length)
    return [*row, "" if each.increment is None else half]


def _length(value: float, unit: Length) -> str:
    return _NONE if isnan(value) else length_in(value, unit)


_NONE = "none"
"""Text in place of a derivative that does not exist."""


def tolerances_data(found: Tolerances) -> dict[str, Any]:
    """The same as plain data: schema contoursolve/sensitivity/1. Points are in mm, X of a lathe as radius; slopes in mm
    for each unit of the word as written."""
    limits = found.limits
    return {
        "schema": "contoursolve/sensitivity/1",
        "point": found.point,
        "plane": list(found.plane.axes),
        "at": list(found.place),
        **premise_data(found.premises),
        "words": [_effect_data(each) for each in found.effects],
        "spread": [None if isnan(each.worst) else members(each, "worst typical") for each in found.spread],
        "limits": {
            **({"low": None, "high": None} if isnan(limits.low[0]) else members(limits, "low high")),
            **members(limits, "combinations=count without_contour=without missing"),
        }
        if limits is not None
        else None,
    }


def _effect_data(each: Contribution) -> dict[str, Any]:
    rounding = "half_increment_mm=by_half rounded rounding_mm=by_rounding rounding_linear_mm=by_rounding_linear"
    return {
        "word": each.word,
        "unit": each.unit or None,
        "value": each.stated,
        "slope": None if isnan(each.slope[0]) else list(each.slope),
        **members(each, f"tolerance moves_mm=moves increment {rounding}"),
    }


# How far a word may be off -----------------------------------------------------------------------------------


def word_tolerance_view(found: ToleranceRange) -> RecordView:
    """The tolerance of a word, a row for each end: the value, how far it is from that of the block, and what ends it.
    Below, the linear estimate, what is not proven, and the premises."""
    most, proof = f"{found.most:g} {short_name(found.kept_unit)}", "proven" if found.is_complete else "not proven"
    title = f"{found.word}, now {written(found.stated, found.unit)}: {found.kept} moves by at most {most} ({proof})"
    rows = []
    for name, end in (("from", found.low), ("to", found.high)):
        value, text = _end_cells(end, found.unit)
        off = end.listed - Decimal(repr(found.stated))
        rows.append((name, value, f"{'+' * (off > 0)}{limit_text(off, found.unit)}", text))
    header = ("end", "value", "off by", "what ends it")
    table = Table("How far it may be off", header, rows, left=(0, 3), is_headed=False)
    first = [f"to first order: +-{written(found.linear, found.unit)}"] if found.linear is not None else []
    if found.linear is None and Way.MOVED not in (found.low.way, found.high.way):
        first = [f"{found.word} does not move {found.kept} so far"]
    return RecordView(title, [table, *first, *_doubts(found), *rest_lines(found)])


def word_tolerance_data(found: ToleranceRange) -> dict[str, Any]:
    """The tolerance of a word as plain data, in the units in which it and what is kept are written."""
    return {
        **members(found, "word unit stated keep=kept keep_unit=kept_unit within=most linear"),
        **members(found, "complete=is_complete doubts"),
        **premise_data(found.premises),
        "low": _end_data(found.low),
        "high": _end_data(found.high),
    }
