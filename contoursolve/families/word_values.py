"""Values of free words: columns side by side or the axes of a grid, and what names of words mean."""

from collections.abc import Iterable, Iterator, Mapping
from math import isfinite
from typing import Any

import numpy
from msgspec import Struct
from msgspec.structs import asdict
from numpy.typing import ArrayLike, NDArray

from contoursolve.families.errors import FamilyError
from contoursolve.families.results import check_text
from contoursolve.numeric import Array
from contoursolve.tolerance import LARGEST

Places = NDArray[numpy.int64]

LONGEST = 262_144
"""Values of one word of a grid that are prepared once for all rows; of more, a stretch at a time."""


_FEW = 64
"""Rows whose places are computed one by one where they lie far apart."""


def are_same(one: Any, other: Any) -> bool:
    """Whether two values, or what is in two mappings, are the same: arrays by their elements, NaN being like itself."""
    if isinstance(one, Mapping):
        is_alike = isinstance(other, Mapping) and [*one] == [*other]
        return is_alike and all(are_same(value, other[name]) for name, value in one.items())
    if isinstance(one, numpy.ndarray):
        is_alike = isinstance(other, numpy.ndarray) and one.dtype == other.dtype
        return is_alike and numpy.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    return bool(one == other)


class Ranges(Struct, frozen=True, eq=False):
    """The values of each free word, by its name: as columns side by side (`is_paired`), or as the axes of a grid whose
    last word varies fastest."""

    values: Mapping[str, Array]
    is_paired: bool

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Ranges) and are_same(asdict(self), asdict(other))

    def __hash__(self) -> int:
        return hash((tuple(self.values), self.shape))

    def named(self, names: Iterable[str]) -> "Ranges":
        """The same by other names of the words, in their order."""
        return Ranges(dict(zip(names, self.values.values(), strict=True)), self.is_paired)

    @property
    def shape(self) -> tuple[int, ...]:
        """(rows,) for columns, one size for each word for a grid."""
        sizes = tuple(each.size for each in self.values.values())
        return sizes[:1] if self.is_paired else sizes

    @property
    def count(self) -> int:
        """Rows altogether."""
        total = 1
        for size in self.shape:
            total *= size
        return total

    def places(self, word: str, first: int, last: int) -> Places:
        """The places of the values of a word for the rows from `first` to before `last`."""
        if self.is_paired:
            return numpy.arange(first, last)
        number = list(self.values).index(word)
        size, stride = self.shape[number], 1
        for other in self.shape[number + 1 :]:
            stride *= other
        if stride > last - first and last - first <= _FEW:
            # A stride, and the number of a row, may be beyond all that fits into memory.
            return numpy.array([row // stride % size for row in range(first, last)], numpy.intp)
        # Repeating what is there takes a tenth of the time of dividing row numbers.
        if stride == 1:
            skipped = first % size
            return numpy.resize(numpy.arange(size), skipped + last - first)[skipped:]
        wholes = numpy.arange(first // stride, (last - 1) // stride + 1) % size
        skipped = first % stride
        return numpy.repeat(wholes, stride)[skipped : skipped + last - first]

    def at(self, places: Mapping[str, Places]) -> dict[str, Array]:
        """The values at some places."""
        return {word: values[places[word]] for word, values in self.values.items()}

    def rows(self, first: int, last: int) -> "Ranges":
        """The rows from `first` to before `last` as columns."""
        return Ranges(self.at({word: self.places(word, first, last) for word in self.values}), True)

    def row(self, places: Mapping[str, Places], number: int) -> dict[str, float]:
        """The values of one row, from where those of some rows are."""
        return {word: float(values[places[word][number]]) for word, values in self.values.items()}

    @property
    def is_long(self) -> bool:
        """Whether there are too many values to prepare all of them beforehand."""
        return self.is_paired or max(self.shape, default=0) > LONGEST


def name_of(text: str) -> str:
    """The name of a word as it is printed, upper case: `A`, `2:A`; of a word of the start point, `start X`; of a fact,
    its text; of a tool, TOOL. Raises TypeError for what is no text."""
    check_text("word", text)
    parts = text.split()
    head, dot, rest = " ".join(parts).partition("." if len(parts) == 1 else " ")
    if dot and head.lower() == START:
        return f"{START} {rest.upper()}"
    if len(parts) > 1:
        return " ".join(parts)
    line, colon, address = text.strip().upper().partition(":")
    if colon and line.isdecimal():
        return f"{int(line)}:{address}"
    return TOOL if head.lower() == TOOL and not dot else text.strip().upper()


START = "start"
TOOL = "tool"
"""The name that stands for the radius of a tool among words."""


def ranges_of(vary: Mapping[str, ArrayLike], *, is_paired: bool) -> Ranges:
    """The ranges of a mapping. Raises FamilyError for what is no list of numbers."""
    if not isinstance(vary, Mapping):
        raise TypeError(f"vary is a mapping of words to their values, such as {{'A': [170, 180]}}, not {vary!r}")
    if not vary:
        raise FamilyError("no word varies; name one with its values, such as A with 170 to 190")
    values: dict[str, Array] = {}
    for name, each in vary.items():
        word = name_of(name)
        try:
            array = numpy.atleast_1d(numpy.asarray(each, dtype=numpy.float64))
        except (TypeError, ValueError):
            raise FamilyError(f"the values of {name} are not numbers") from None
        if array.ndim != 1 or not array.size:
            raise FamilyError(f"{name} needs a list of one or more numbers, not an array of shape {array.shape}")
        if not numpy.isfinite(array).all():
            raise FamilyError(f"the values of {name} must be finite numbers")
        if numpy.abs(array).max() > LARGEST:
            value = array[numpy.abs(array).argmax()]
            raise FamilyError(
                f"{name} goes to {value:g}, beyond {LARGEST:,.0f}, the largest value that contoursolve reads"
            )
        if word in values:
            raise FamilyError(f"{name} is named twice")
        values[word] = array
    sizes = {word: array.size for word, array in values.items()}
    if is_paired and len(set(sizes.values())) > 1:
        told = ", ".join(f"{word} has {size:,}" for word, size in sizes.items())
        raise FamilyError(f"paired words need equally many values: {told}")
    return Ranges(values, is_paired)


def read_limits(word: str, within: tuple[float, float], largest: float, unit: str) -> tuple[float, float]:
    """The range in which a word is looked at, as it is written. Raises FamilyError for one that is none, or that goes
    beyond the largest value that is read."""
    try:
        low, high = map(float, within)
    except (TypeError, ValueError):
        raise FamilyError(f"the range of {word} is two numbers, the smaller one first, not {within!r}") from None
    told = f"{word} from {low:g} to {high:g}"
    if not (isfinite(low) and isfinite(high)):
        raise FamilyError(f"{told} is no range; give two finite numbers")
    if low >= high:
        raise FamilyError(f"{told} is no range; the smaller number comes first")
    if low < -largest or high > largest:
        raise FamilyError(
            f"{told} goes beyond {largest:,.0f} {unit}, the largest value that contoursolve reads; give a smaller range"
        )
    return low, high


def stretches(count: int, size: int) -> Iterator[tuple[int, int]]:
    """The rows from 0 to `count` in stretches of at most `size`."""
    return ((first, min(first + size, count)) for first in range(0, count, size))
