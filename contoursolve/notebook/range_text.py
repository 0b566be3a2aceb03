"""The ranges of a word as one reads them: all of them to the increment, and short enough for a line beside a slider."""

from collections.abc import Iterable, Sequence
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import DECIMALS
from contoursolve.families import End, FeasibleRange, Interval, Way

LONGEST = 42
"""Characters of a line beside a slider."""

MOST_PIECES = 2
"""Ranges that such a line tells one by one."""

SHARE = Decimal("0.005")
"""Share of a range that fewer digits may leave out at an end."""


class _Piece(Struct, frozen=True):
    """A range to the increment; an end that only the search has is None. `holes` are values inside it without a
    contour, each as text."""

    low: Decimal | None
    high: Decimal | None
    has_low: bool
    has_high: bool
    width: Decimal
    holes: tuple[str, ...] = ()

    def text(self, name: str) -> str:
        """The range in a line, such as `0 ≤ P ≤ 51.961`."""
        low, high = self.low, self.high
        if low is not None and low == high:
            told = f"{name} = {_shown(low)}"
        elif low is not None and high is not None:
            signs = ["≤" if each else "<" for each in (self.has_low, self.has_high)]
            told = f"{_shown(low)} {signs[0]} {name} {signs[1]} {_shown(high)}"
        elif low is not None:
            told = f"{name} {'≥' if self.has_low else '>'} {_shown(low)}"
        elif high is not None:
            told = f"{name} {'≤' if self.has_high else '<'} {_shown(high)}"
        else:
            told = f"any {name}"
        return f"{told} but {', '.join(self.holes)}" if self.holes else told


def range_texts(found: FeasibleRange, name: str, value: float | None) -> tuple[str, str]:
    """The ranges of a word in a short line, and all of them where the line says less; else an empty text.

    The line has fewer digits where that leaves out little of a range, and tells those next to the value of the word; it
    says how many there are besides.
    """
    known = "" if found.is_complete else " (at least)"
    if not found.intervals:
        return f"no contour for any {name}{known}", ""
    pieces = _joined([_piece(each, found.unit) for each in found.intervals], found.unit)
    whole = _told(pieces, name) + known
    if len(whole) <= LONGEST:
        return whole, ""
    at = Decimal(repr(value)) if value is not None else None
    fewer = [_with_fewer_digits(each, at, found.unit) for each in pieces]
    near = sorted(range(len(fewer)), key=lambda number: _distance(fewer[number], at))[:MOST_PIECES]
    left = len(fewer) - len(near)
    short = _told([fewer[number] for number in sorted(near)], name) + (f" and {left} more" if left else "") + known
    return (short, whole) if short != whole else (whole, "")


def _told(pieces: Iterable[_Piece], name: str) -> str:
    return " or ".join(each.text(name) for each in pieces)


def _piece(interval: Interval, unit: str) -> _Piece:
    (low, has_low), (high, has_high) = _limit(interval.low, unit), _limit(interval.high, unit)
    return _Piece(low, high, has_low, has_high, Decimal(repr(interval.high.value)) - Decimal(repr(interval.low.value)))


def _limit(end: End, unit: str) -> tuple[Decimal | None, bool]:
    """An end as it is typed, and whether it belongs to its range; None where only the search ended."""
    exact = Decimal(repr(end.value))
    if end.way is Way.RANGE:
        return None, True
    return (exact, False) if not end.is_included and exact == round(exact, DECIMALS[unit]) else (end.typed, True)


def _joined(pieces: Sequence[_Piece], unit: str) -> list[_Piece]:
    """The ranges with those joined that one value at most of the control's increment parts."""
    joined = [pieces[0]]
    step = Decimal(1).scaleb(-DECIMALS[unit])
    for each in pieces[1:]:
        last = joined[-1]
        gap = each.low - last.high if each.low is not None and last.high is not None else None
        if gap is None or gap > 2 * step or gap < 0 or _is_value(each) or _is_value(last):
            joined.append(each)
            continue
        assert last.high is not None
        hole = last.high + gap / 2
        # Between two values that follow one another a contour is lost that nobody can ask for.
        text = _shown(hole) if gap != step else f"about {_shown(last.high)}"
        width, holes = last.width + each.width, (*last.holes, text)
        joined[-1] = _Piece(last.low, each.high, last.has_low, each.has_high, width, holes)
    return joined


def _is_value(piece: _Piece) -> bool:
    """Whether a range is one value, or none of the increment."""
    return piece.low is not None and piece.high is not None and piece.low >= piece.high


def _with_fewer_digits(piece: _Piece, value: Decimal | None, unit: str) -> _Piece:
    """A range with as few digits as leave almost all of it, and its value."""
    low, high = piece.low, piece.high
    if _is_value(piece) or (low is None and high is None):
        return piece
    size = max(abs(low or high or Decimal(0)), Decimal(1))
    width = high - low if low is not None and high is not None else min(size, piece.width)

    def fewer(end: Decimal | None, rounding: str) -> Decimal | None:
        if end is None:
            return None
        for digits in range(DECIMALS[unit]):
            tried = end.quantize(Decimal(1).scaleb(-digits), rounding)
            is_left_out = value is not None and min(tried, end) < value < max(tried, end)
            if abs(tried - end) <= SHARE * width and not is_left_out and tried != value:
                return tried
        return end

    return replace(
        piece,
        low=(new := fewer(low, ROUND_CEILING)),
        high=(top := fewer(high, ROUND_FLOOR)),
        has_low=piece.has_low or new != low,
        has_high=piece.has_high or top != high,
    )


def _distance(piece: _Piece, value: Decimal | None) -> Decimal:
    """The distance of a value from a range, 0 inside."""
    if value is None:
        return Decimal(0)
    below = piece.low - value if piece.low is not None else Decimal(0)
    above = value - piece.high if piece.high is not None else Decimal(0)
    return max(below, above, Decimal(0))


def _shown(number: Decimal) -> str:
    return f"{number.normalize() + 0:f}"
