"""Which word moves a point most, as text and as plain data."""

from collections.abc import Iterator
from math import isnan
from typing import Any

from contoursolve.families import Effect, Tolerances
from contoursolve.model import Length
from contoursolve.output.layout import columns, count, length_in, measured, short_name, written


def tolerances_lines(found: Tolerances) -> Iterator[str]:
    """The words, the one that moves the point most first, and what their tolerances come to."""
    yield tolerances_title(found)
    yield from columns(effect_rows(found))
    yield from (f"  {line}" for line in spread_lines(found))


def tolerances_title(found: Tolerances) -> str:
    """The point, and where it is."""
    return f"{found.point}: {measured(found.place, found.plane, found.length)}; moved by each word, the most first"


def effect_rows(found: Tolerances) -> list[list[str]]:
    """A header, and what each word does; all lengths in the unit of the program."""
    has_tolerances = _has_tolerances(found)
    head = ["word", "value", *(f"{letter} per unit" for letter in _letters(found))]
    head += ["tolerance", "moves it by"] if has_tolerances else []
    rows = [_row(each, found, has_tolerances) for each in found.effects]
    return [[*head, "half an increment"], *rows]


def spread_lines(found: Tolerances) -> Iterator[str]:
    """What the tolerances come to, and what rounding does; first of all at which limits there is no contour."""
    limits, unit = found.limits, found.length
    for missing in limits.missing if limits is not None else ():
        place = ", ".join(f"{word} {value:g}" for word, value in missing.values.items())
        which = f"such as {place}" if missing.count > 1 else f"at {place}"
        many = f"{missing.count} of {count(limits.count, 'combination')}" if limits is not None else ""
        yield f"no contour at {many} of the limits, {which}: {missing.message}"
    if _has_tolerances(found):
        pairs = zip(_letters(found), found.spread, found.plane.diameters, strict=True)
        spreads = [(letter, each, 2 if is_diameter else 1) for letter, each, is_diameter in pairs]
        worst = ", ".join(f"{letter} {length_in(each.worst * times, unit)}" for letter, each, times in spreads)
        typical = ", ".join(f"{letter} {length_in(each.typical * times, unit)}" for letter, each, times in spreads)
        yield f"off by at worst {worst}; in the root of the sum of squares {typical}"
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


def _has_tolerances(found: Tolerances) -> bool:
    return found.limits is not None or any(each.tolerance is not None for each in found.effects)


def _letters(found: Tolerances) -> list[str]:
    return [
        letter + (" dia" if is_diameter else "")
        for letter, is_diameter in zip(found.plane.axes, found.plane.diameters, strict=True)
    ]


def _row(each: Effect, found: Tolerances, has_tolerances: bool) -> list[str]:
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
"""What stands where no derivative exists."""


def tolerances_data(found: Tolerances) -> dict[str, Any]:
    """The same as plain data: schema contoursolve/sensitivity/1. Points are in mm, X of a lathe as radius; slopes in mm
    for each unit of the word as written."""
    limits = found.limits
    is_placed = limits is not None and not isnan(limits.low[0])
    return {
        "schema": "contoursolve/sensitivity/1",
        "point": found.point,
        "plane": list(found.plane.axes),
        "at": list(found.place),
        "words": [
            {
                "word": each.word,
                "unit": each.unit or None,
                "value": each.stated,
                "slope": None if isnan(each.slope[0]) else list(each.slope),
                "tolerance": each.tolerance,
                "moves_mm": None if isnan(each.moves) else each.moves,
                "increment": each.increment,
                "half_increment_mm": each.by_half,
                "rounded": each.rounded,
                "rounding_mm": each.by_rounding,
                "rounding_linear_mm": None if isnan(each.by_rounding_linear) else each.by_rounding_linear,
            }
            for each in found.effects
        ],
        "spread": [
            None if isnan(each.worst) else {"worst": each.worst, "typical": each.typical} for each in found.spread
        ],
        "limits": {
            "low": list(limits.low) if is_placed else None,
            "high": list(limits.high) if is_placed else None,
            "combinations": limits.count,
            "without_contour": limits.without,
            "missing": [
                {"count": each.count, "values": dict(each.values), "message": each.message} for each in limits.missing
            ],
        }
        if limits is not None
        else None,
    }
