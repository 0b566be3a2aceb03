"""Values of a word that bring a point where it is wanted, as text and as plain data."""

from collections.abc import Iterator
from typing import Any

from contoursolve.families import Found, Hit
from contoursolve.output.layout import count, length_in, measured, written
from contoursolve.output.solutions import printed_certificate


def found_lines(found: Found) -> Iterator[str]:
    """The values, each with where the point is then, and the block to write."""
    yield found_title(found)
    if found.remark:
        yield f"  {found.remark}"
    yield from (f"  not proven: {each}" for each in found.doubts)
    for place, hit in enumerate(found.hits, 1):
        value, point, certificate, block, rounding = hit_row(hit, found)
        yield f"  {place}. {found.word} {value}: {point}"
        if certificate:
            yield f"     {certificate}"
        yield from (f"     {line}" for line in block.split("\n"))
        yield f"     {rounding}"


def found_title(found: Found) -> str:
    """What was asked, and how many values there are."""
    low, high = (written(value, found.unit) for value in found.within)
    number = count(len(found.hits), "value") if found.hits else "no value"
    proof = "proven to be all" if found.is_complete else "at least; that these are all is not proven"
    aim = "nearest to" if found.goal.is_nearest else "at"
    goal = measured(found.goal.place, found.plane, found.length)
    return f"{found.goal.point} {aim} {goal}, by {found.word} from {low} to {high}: {number} ({proof})"


def hit_row(hit: Hit, found: Found) -> tuple[str, str, str, str, str]:
    """A value, where the point is then, the certificate (may be empty), the block to write, and what rounding does."""
    away = f", {length_in(hit.away, found.length)} away" if found.goal.is_nearest else ""
    certificate = str(printed_certificate(hit.certificate) or "")
    at = f"{measured(hit.point, found.plane, found.length)}{away}"
    return written(hit.value, found.unit), at, certificate, hit.block, _rounding(hit, found)


def _rounding(hit: Hit, found: Found) -> str:
    if hit.rounded_away is None:
        return "rounded like this, the block has no contour"
    off = "away" if found.goal.is_nearest else "off"
    return f"rounded like this, the point is {length_in(hit.rounded_away, found.length)} {off}"


def found_data(found: Found) -> dict[str, Any]:
    """The values as plain data: schema contoursolve/find/1. Points are in mm, X of a lathe as radius."""
    return {
        "schema": "contoursolve/find/1",
        "word": found.word,
        "unit": found.unit,
        "stated": found.stated,
        "within": list(found.within),
        "plane": list(found.plane.axes),
        "point": found.goal.point,
        "goal": list(found.goal.place),
        "aim": "nearest" if found.goal.is_nearest else "reach",
        "complete": found.is_complete,
        "doubts": list(found.doubts),
        "remark": found.remark or None,
        "values": [_hit(hit) for hit in found.hits],
    }


def _hit(hit: Hit) -> dict[str, Any]:
    certificate = printed_certificate(hit.certificate)
    return {
        "value": hit.value,
        "at": list(hit.point),
        "away_mm": hit.away,
        "certificate": {"kind": certificate.proof.value, "radius": certificate.radius} if certificate else None,
        "rounded": hit.rounded,
        "block": hit.block,
        "rounded_away_mm": hit.rounded_away,
    }
