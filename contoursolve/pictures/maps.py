"""The map of a family over two words: a field for each outcome with its name in it, and the boundaries between them;
and what a picture of a sweep shows of all its values."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from math import floor

import numpy
from numpy.typing import NDArray

from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.wording import statuses_text
from contoursolve.families import CompiledSweep, Family, FamilyError, region_of, units_of
from contoursolve.families.evaluate import compile_sweep, solve_sweep
from contoursolve.families.spec import Ranges
from contoursolve.numeric.columns import Array
from contoursolve.pictures.curves import Curve, curves_of, names_of, near, strokes
from contoursolve.pictures.page import PAD, SIZE, WIDTH, Anchor, Box, Item, Sheet, Spot, Stroke, Text, TextRun, wrap
from contoursolve.pictures.theme import Role
from contoursolve.pictures.value_axes import BELOW, HIGH, LEFT, TOP, WIDE, ValuePlane, axis_text, over_cells, page_of
from contoursolve.solving import Status
from contoursolve.solving.row_outcome import REASONS, Code

COLUMNS, ROWS = 305, 200
"""Cells of a map; of more values, the one nearest to the middle of each cell is shown."""

_FIELDS = {Code.SOLVED: Role.SOLVED_FIELD, Code.OVERDETERMINED: Role.SOLVED_FIELD, Code.NO_SOLUTION: Role.REFUSED_FIELD}
"""How an outcome without a reason against it is painted; with one, there is no contour."""
_OVER = 0.6
"""Pixels by which a field reaches under the next, so that the paper does not shine through between them."""

_LINE = 3.0
"""Pixels of an exact line; it covers the steps of the cells under it."""

_MOST_RUNS = 9_000

Outcomes = NDArray[numpy.int64]
Mask = NDArray[numpy.bool_]


def _title(statuses: Mapping[Status, int], words: tuple[str, ...]) -> str:
    """What a map shows."""
    told = ", ".join(f"{number:,} {status.value}" for status, number in statuses.items())
    return f"{' and '.join(words)}: {told}"


def lay_out_map(family: Family, chosen: tuple[str, str] | None, title: str | None) -> Sheet:
    """The page of a map, of the words that vary unless others are chosen. Raises ValueError where these are not two
    words of a grid of two."""
    several = [word for word, values in family.ranges.values.items() if values.size > 1]
    words = chosen if chosen is not None else tuple(several or family.ranges.values)[:2]
    own = [word for word, values in family.ranges.values.items() if values.size > 1 or word in words]
    if family.ranges.is_paired or len(own) != 2 or sorted(words) != sorted(own):  # noqa: PLR2004 - a plane
        raise ValueError(f"a map needs a grid of two words; this family has {' and '.join(own)}, not {words!r}")
    across, up = (family.ranges.values[word] for word in words)
    outcomes = family["status"].astype(numpy.int64) * len(REASONS) + family["reason"]
    # The other words have one value each.
    outcomes = outcomes.reshape([family.ranges.values[word].size for word in own])
    outcomes = outcomes if own == list(words) else outcomes.T
    columns, rows = _picks(across, COLUMNS), _picks(up, ROWS)
    shown = outcomes[numpy.ix_(columns, rows)].T[::-1]
    first, second = map(axis_text, words, units_of(family, words))
    chart = ValuePlane((first, second), over_cells(across[columns]), over_cells(up[rows]))
    curves = _curves(family, (words[0], words[1]), chart)
    fields, others = _names(shown)
    borders = _boundaries(shown, curves)
    lines, unnamed = names_of(curves, chart, [each.box for each in fields], borders)
    items: list[Item] = [*_fields(shown), *borders]
    items += [*strokes(curves, _LINE), *chart.axes(), *fields, *lines]
    remarks = [
        (told, Role.MUTED)
        for start, several in (("too narrow to be named", others), ("lines without room for a name", unnamed))
        for told in (wrap(f"{start}: {'; '.join(several)}", WIDTH - 2 * PAD, SIZE, 3) if several else ())
    ]
    told = title if title is not None else _title(family.summary(), words)
    return page_of(told, items, remarks, TOP + HIGH + BELOW, 4.0)


def _curves(family: Family, words: tuple[str, str], chart: ValuePlane) -> list[Curve]:
    """The exact lines between where the contour exists and where not; none where they cannot be told, as for facts that
    leave no closed form."""
    if any(scale.values[0] == scale.values[-1] for scale in (chart.across, chart.up)):
        return []
    try:
        return curves_of(region_of(family, words), chart)
    except FamilyError:
        return []


def _picks(values: NDArray[numpy.float64], most: int) -> NDArray[numpy.int64]:
    """Which values are shown, in rising order."""
    order = numpy.argsort(values, kind="stable")
    if order.size <= most:
        return order
    return order[((numpy.arange(most) + 0.5) * order.size / most).astype(numpy.int64)]


def _cell(shown: Outcomes | Mask) -> tuple[float, float]:
    return WIDE / shown.shape[1], HIGH / shown.shape[0]


def _fields(shown: Outcomes) -> list[Item]:
    """A rectangle for each run of equal outcomes in a row, of several rows where these are alike."""
    wide, high = _cell(shown)
    items: list[Item] = []
    begin = 0
    for row in range(1, shown.shape[0] + 1):
        if row < shown.shape[0] and (shown[row] == shown[begin]).all():
            continue
        cuts = [0, *(numpy.flatnonzero(numpy.diff(shown[begin])) + 1).tolist(), shown.shape[1]]
        top, bottom = TOP + begin * high, min(TOP + row * high + _OVER, TOP + HIGH)
        for first, last in pairwise(cuts):
            role = _field(int(shown[begin, first]))
            left, right = LEFT + first * wide, min(LEFT + last * wide + _OVER, LEFT + WIDE)
            items.append(Box(left, top, right, bottom).filled(role))
        begin = row
    return items


def _field(outcome: int) -> Role:
    """How an outcome is painted."""
    code, reason = divmod(outcome, len(REASONS))
    role = _FIELDS.get(Code(code), Role.OTHER_FIELD)
    return Role.REFUSED_FIELD if reason and role is Role.SOLVED_FIELD else role


def _boundaries(shown: Outcomes, curves: Sequence[Curve]) -> list[Stroke]:
    """Lines between fields, each as long as it is straight; where an exact line says the same, only that."""
    wide, high = _cell(shown)
    close = near(curves, *shown.shape)
    has_contour = numpy.isin(shown, [each for each in numpy.unique(shown) if _field(int(each)) is Role.SOLVED_FIELD])
    role, width = (Role.MUTED, 1.0) if curves else (Role.INK, 1.4)
    items: list[Stroke] = []
    for row, first, last in _edges(shown, close, has_contour):
        y = TOP + (row + 1) * high
        items.append(Stroke((LEFT + first * wide, y), ((LEFT + last * wide, y),), role, width))
    for column, first, last in _edges(shown.T, close.T, has_contour.T):
        x = LEFT + (column + 1) * wide
        items.append(Stroke((x, TOP + first * high), ((x, TOP + last * high),), role, width))
    return items[:_MOST_RUNS]


def _edges(shown: Outcomes, close: Mask, has_contour: Mask) -> Iterator[tuple[int, int, int]]:
    """Between each row of cells and the next one, from where to where they differ and no exact line is close that parts
    cells with a contour from others."""
    is_exact = (close[1:] | close[:-1]) & (has_contour[1:] != has_contour[:-1])
    for row, edges in enumerate((shown[1:] != shown[:-1]) & ~is_exact):
        ends = numpy.flatnonzero(numpy.diff(edges.astype(numpy.int8), prepend=0, append=0)).tolist()
        yield from ((row, first, last) for first, last in zip(ends[::2], ends[1::2], strict=True))


def _names(shown: Outcomes) -> tuple[list[Text], list[str]]:
    """The name of each field in it, where there is room, and the names of the others."""
    items: list[Text] = []
    others: list[str] = []
    counts = {int(each): int((shown == each).sum()) for each in numpy.unique(shown)}
    for outcome in sorted(counts, key=lambda each: -counts[each]):
        code, reason = Code(outcome // len(REASONS)), REASONS[outcome % len(REASONS)]
        words = [code.status.value.replace("-", " "), *([reason.value.replace("-", " ")] if reason is not None else [])]
        found = _fitting(words, shown == outcome)
        items += found
        if not found:
            others.append(f"{', '.join(words)} ({counts[outcome] / shown.size:.1%})")
    return items, others


def _fitting(words: list[str], mask: Mask) -> list[Text]:
    """A name as texts that lie in their field: in lines, or turned in one line; nothing where neither does."""
    for is_turned in (False, True):
        x, y = _deepest(mask, *((1, 4) if is_turned else (4, 1)))
        if is_turned:
            runs = (TextRun(", ".join(words), Role.INK),)
            texts = [Text((x + 4.0, y), runs, SIZE, Anchor.MIDDLE, is_turned=True)]
        else:
            first = y + 4.0 - 7.5 * (len(words) - 1)
            texts = [
                Text((x, first + 15.0 * number), (TextRun(word, Role.INK),), SIZE, Anchor.MIDDLE)
                for number, word in enumerate(words)
            ]
        if all(_holds(mask, text.box) for text in texts):
            return list(texts)
    return []


def _holds(mask: Mask, box: Box) -> bool:
    """Whether a box lies in a field."""
    wide, high = _cell(mask)
    left, right = floor((box.left - LEFT) / wide), floor((box.right - LEFT) / wide)
    top, bottom = floor((box.top - TOP) / high), floor((box.bottom - TOP) / high)
    is_inside = left >= 0 and top >= 0 and right < mask.shape[1] and bottom < mask.shape[0]
    return is_inside and bool(mask[top : bottom + 1, left : right + 1].all())


def _deepest(mask: Mask, across: int, up: int) -> Spot:
    """The middle of the place that is farthest from all other fields, where being far counts in a ratio across and
    up, for a text is longer one way."""
    wide, high = _cell(mask)
    inner, last = mask, mask
    while inner.any():
        last = inner
        wider = numpy.pad(inner, ((up, up), (across, across)))
        inner = (
            inner
            & wider[: -2 * up, across:-across]
            & wider[2 * up :, across:-across]
            & wider[up:-up, : -2 * across]
            & wider[up:-up, 2 * across :]
        )
    rows, columns = numpy.nonzero(last)
    pick = len(rows) // 2
    return LEFT + (int(columns[pick]) + 0.5) * wide, TOP + (int(rows[pick]) + 0.5) * high


# Sweeps ------------------------------------------------------------------------------------------------------

MOST_VALUES = 21
"""Values of one word whose contours are drawn."""

Fan = tuple[str, Sequence[float], Sequence[Answer]]
"""A word, some of its values, and the answer for each."""


def solve_shown(ready: CompiledSweep) -> Fan | Family:
    """What is drawn of a sweep, solved: no more values than there is room for, evenly chosen.

    Raises FamilyError where not one word or two vary, or where they are paired.
    """
    ranges = ready.ranges
    varying = [name for name, values in ranges.values.items() if values.size > 1]
    if ranges.is_paired or not 1 <= len(varying) <= 2:  # noqa: PLR2004 - a line or a plane
        told = "paired words" if ranges.is_paired else f"{len(varying)} words with several values"
        raise FamilyError(f"a picture takes one word, or every combination of two; this sweep has {told}")
    if len(varying) == 1:
        (word,) = varying
        values = [float(value) for value in _chosen(ranges.values[word], MOST_VALUES)]
        fixed = {name: float(column[0]) for name, column in ranges.values.items()}
        return word, values, [ready.template.solve({**fixed, word: value}) for value in values]
    alone = {name: column for name, column in ranges.values.items() if name not in varying}
    shown = {name: _chosen(ranges.values[name], most) for name, most in zip(varying, (COLUMNS, ROWS), strict=True)}
    return solve_sweep(compile_sweep(ready.spec, Ranges({**alone, **shown}, is_paired=False)))


def sweep_title(ranges: Ranges, statuses: Mapping[Status, int]) -> str:
    """What the picture of a sweep shows, and what became of all its rows, drawn or not."""
    varying = {name: numpy.unique(values) for name, values in ranges.values.items() if values.size > 1}
    if len(varying) > 1:
        return _title(statuses, tuple(varying))
    ((word, values),) = varying.items()
    drawn = f" ({MOST_VALUES} drawn)" if values.size > MOST_VALUES else ""
    span = f"{word} from {values[0]:g} to {values[-1]:g}, {ranges.count:,} contours{drawn}"
    return f"{span}: {statuses_text(statuses)}"


def _chosen(values: Array, most: int) -> Array:
    """At most so many of the values in rising order, the first and the last among them."""
    rising = numpy.unique(values)
    if rising.size <= most:
        return rising
    places = numpy.linspace(0, rising.size - 1, most).round().astype(numpy.int64)
    chosen: Array = rising[places]
    return chosen
