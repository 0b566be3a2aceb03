"""How long a sweep takes, and how much room its file and parts take, before it is begun."""

from time import perf_counter

import numpy

from contoursolve.families.evaluate import STRETCH
from contoursolve.families.parts import Parts
from contoursolve.families.prepared import Sweep

MOST_ROWS = 100_000_000
"""Rows that are begun at a word: a minute or two where there is a closed form, and a file of some 20 GB. More come of a
step that is too small more often than of a wish."""

ENOUGH = 0.2
"""Seconds. So long rows are measured, without waiting for a sweep whose rows take milliseconds each."""

FEWEST = 64
"""Rows that are measured first; the function that they need is compiled then."""

NUMBER = 20
"""Bytes of a number in CSV: 17 digits, a sign, a point and a comma."""


def seconds_of(ready: Sweep) -> float:
    """The seconds that all rows take on one thread, if they take as long as the first ones."""
    most, rows = min(STRETCH, ready.ranges.count), FEWEST
    while True:
        rows = min(rows, most)
        begin = perf_counter()
        ready.evaluate(0, rows, ready.empty(rows))
        took = perf_counter() - begin
        if took >= ENOUGH or rows == most:
            return took / rows * ready.ranges.count
        rows *= 2


def room_of(parts: Parts, *, is_text: bool) -> int:
    """The bytes that the file (as CSV: `is_text`) and the parts that are still to come take at most, while both are
    there."""
    kinds, words = parts.ready.columns(), len(parts.ready.ranges.values)
    part = sum(numpy.dtype(kind).itemsize for kind in kinds.values())
    row = NUMBER * (len(kinds) + words) if is_text else part + 8 * words
    rows = parts.ready.ranges.count
    return rows * row + (rows - parts.rows_done) * part
