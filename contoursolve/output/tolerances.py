"""Which word moves a point most, as text and as plain data."""

from collections.abc import Iterator
from math import isnan
from typing import Any

from contoursolve.families import Effect, Tolerances
from contoursolve.output.layout import columns, coordinates, written


def tolerances_lines(found: Tolerances) -> Iterator[str]:
    """The words, the one that moves the point most first, and what their tolerances come to."""
    yield tolerances_title(found)
    yield from columns(effect_rows(found))
    yield from (f"  {line}" for line in spread_lines(found))


def tolerances_title(found: Tolerances) -> str:
    """The point, and where it is."""
    return f"{found.point}: {coordinates(found.place, found.plane, found.length)}; moved by each word, the most first"


def effect_rows(found: Tolerances) -> list[list[str]]:
    """A header, and what each word does."""
    has_tolerances = _has_tolerances(found)
    head = ["word", "value", *(f"{letter} [mm per unit]" for letter in _letters(found))]
    head += ["tolerance", "moves it by [mm]"] if has_tolerances else []
    rows = [_row(each, found, has_tolerances) for each in found.effects]
    return [[*head, "half an increment [mm]"], *rows]


def spread_lines(found: Tolerances) -> Iterator[str]:
    """What the tolerances come to, and what rounding does."""
    if _has_tolerances(found):
        pairs = zip(_letters(found), found.spread, found.plane.diameters, strict=True)
        spreads = [(letter, each, 2 if is_diameter else 1) for letter, each, is_diameter in pairs]
        worst = ", ".join(f"{letter} {each.worst * times:.4f} mm" for letter, each, times in spreads)
        typical = ", ".join(f"{letter} {each.typical * times:.4f} mm" for letter, each, times in spreads)
        yield f"off by at worst {worst}; in the root of the sum of squares {typical}"
    if found.limits is not None:
        low, high, count = found.limits.low, found.limits.high, found.limits.count
        without = f"; {found.limits.without} of them have no contour" if found.limits.without else ""
        lowest, highest = (coordinates(at, found.plane, found.length) for at in (low, high))
        span = "" if isnan(low[0]) else f": from {lowest} to {highest}"
        yield f"solved at all {count} combinations of the limits{span}{without}"
    for each in found.effects:
        if each.rounded is not None and each.rounded != each.stated:
            moved = "leaves no contour" if each.by_rounding is None else f"moves it by {each.by_rounding:.4f} mm"
            linear = f"{each.by_rounding_linear:.4f} mm by the derivatives"
            yield f"{each.word} rounded to {written(each.rounded, each.unit)} {moved} ({linear})"


def _has_tolerances(found: Tolerances) -> bool:
    return found.limits is not None or any(each.tolerance is not None for each in found.effects)


def _letters(found: Tolerances) -> list[str]:
    return [
        letter + (" dia" if is_diameter else "")
        for letter, is_diameter in zip(found.plane.axes, found.plane.diameters, strict=True)
    ]


def _row(each: Effect, found: Tolerances, has_tolerances: bool) -> list[str]:
    value = written(each.stated, each.unit) if each.unit else f"{each.stated:.4f}"
    slopes = [
        "none" if isnan(slope) else f"{slope * (2 if is_diameter else 1) + 0.0:.4f}"
        for slope, is_diameter in zip(each.slope, found.plane.diameters, strict=True)
    ]
    row = [each.word, value, *slopes]
    if has_tolerances:
        row += ["" if each.tolerance is None else f"{each.tolerance:g}", _length(each.moves) if each.tolerance else ""]
    return [*row, "" if each.increment is None else "no contour" if each.by_half is None else f"{each.by_half:.4f}"]


def _length(value: float) -> str:
    return "none" if isnan(value) else f"{value:.4f}"


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
        }
        if limits is not None
        else None,
    }
