"""Addresses and G codes as rows of tables: what a word means, in which unit, and what a code does."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from decimal import Decimal
from enum import Enum

from contoursolve.diagnostics import Source
from contoursolve.gcode import PLAIN, Word, WordSpelling
from contoursolve.geometry import Given, Length, Plane, Unit

END_OF = "end of "
"""The begin of the meaning of a code that ends what the rest of it says."""


class Effect(Enum):
    """The effect of a G code, as far as contours are concerned."""

    NONE = "none"
    """Changes nothing that matters here; axis words in its block are a motion as always."""
    MOTION = "motion"
    """A motion that ends at the block's coordinates; stays in force."""
    CYCLE = "cycle"
    """A cycle; stays in force until another motion; where it ends is not followed."""
    SINGLE = "single"
    """Acts in its block only and uses the axis words in its own way; where it ends is not known."""
    NO_MOTION = "no-motion"
    """Acts in its block only, and the axis words in it are not coordinates (a dwell, data input)."""
    PRESET = "preset"
    """Declares the coordinates of the present position: afterwards they are the block's."""
    SHIFT = "shift"
    """Changes the coordinate system: all coordinates are unknown afterwards."""
    FRAME = "frame"
    """Changes the coordinate system with the axis words of its block: all coordinates are unknown."""
    PLANE = "plane"
    UNITS = "units"
    ABSOLUTE = "absolute"
    INCREMENTAL = "incremental"
    COMPENSATION = "compensation"
    CONTOUR = "contour"
    """Begins a contour block."""
    CORNER = "corner"
    """Makes a corner between the blocks beside its own."""
    CANCEL = "cancel"
    """Ends a cycle."""


class Diameter(Enum):
    """The words of X that are diameters, where codes switch that."""

    OFF = "none"
    ON = "all"
    ABSOLUTE = "coordinates, but no increments"
    BY_PLANE = "all while the plane of Z and X is selected, else none"


@dataclass(frozen=True, slots=True)
class Code:
    """One row: the G code and its effect; `plane`, `unit` or `diameter` is what it selects. `name` is how it is
    written where that is not G and its number."""

    number: int
    effect: Effect
    meaning: str
    source: Source
    plane: Plane | None = None
    unit: Length | None = None
    diameter: Diameter | None = None
    name: str = ""
    comes_back: bool = False
    """Whether it is a cycle that ends where the tool was before it."""
    needs_axes: bool = False
    """Whether it does nothing without axis words in its block."""
    leaves_motion: bool = False
    """Whether it moves in a way of its own, as to a reference point, and leaves the motion in force."""
    says_all: bool = False
    """Whether it is a cycle of which every block says all that it needs. The others keep words from one block to the
    next, and a motion between them ends that."""
    is_read: bool = True
    """Whether contoursolve follows what it does; else it is told, and a contour that depends on it is refused."""
    group: str = ""
    """The codes of which one is in force, this one among them, where nothing else is known of them."""

    @property
    def text(self) -> str:
        """The text that is written."""
        return self.name or f"G{self.number:02}"

    @property
    def ends_frame(self) -> bool:
        """Whether it ends what turns, mirrors or scales axes."""
        return self.effect is Effect.FRAME and self.meaning.startswith(END_OF)


@dataclass(frozen=True, slots=True)
class Address:
    """One row: the address, what its value means, and the axis that it programs, if any."""

    address: str
    meaning: str
    unit: Unit
    source: Source
    axis: str = ""
    is_increment: bool = False
    """Always an increment, whatever G90 and G91 say."""
    is_diameter: bool = False
    is_absolute: bool = False
    """Always a coordinate, whatever G90 and G91 say."""
    keeps_diameter: bool = False
    """Whether it is a diameter, or none, whatever codes say of X."""
    clockwise_from: Decimal | None = None
    """Of an angle that counts clockwise: the direction from which, degrees from the plane's first axis."""

    def is_step(self, *, is_incremental: bool) -> bool:
        """Whether it states an increment where increments are in force, or where they are not."""
        return self.is_increment or (is_incremental and not self.is_absolute)

    @property
    def follows_increments(self) -> bool:
        """Whether increments that are in force make it one."""
        return not self.is_increment and not self.is_absolute


class Bearing(Enum):
    """The bearing on the path of a word that draws no contour."""

    NONE = "none"
    """Nothing: a feed, a speed, a tool."""
    AXIS = "axis"
    """It moves an axis that no plane has, or names it."""
    ARGUMENT = "argument"
    """It belongs to a G or M code of its block; beside a line or an arc alone it means nothing."""
    UNREAD = "unread"
    """It shapes the path in a way that contoursolve does not read; its block ends at its coordinates."""
    END = "end"
    """It states where its block ends, in a way that contoursolve does not read."""


@dataclass(frozen=True, slots=True)
class Beside:
    """One row: words of a control beside those that draw contours, what they mean, and what they have to do with the
    path. A number or an index may stand behind a name: `S2=500`, `SPOS[1]=90`."""

    names: tuple[str, ...]
    meaning: str
    source: Source
    bearing: Bearing = Bearing.NONE


TURNED = "X"
"""The axis that may count diameters."""

_HALF, _ONE = Decimal("0.5"), Decimal(1)


class WithoutPoint(Enum):
    """The meaning of a number without a decimal point."""

    LEAST_INCREMENTS = "least increments"
    AS_WRITTEN = "as written"


@dataclass(frozen=True, slots=True)
class NumberFormat:
    """Least increments of a control, and whether numbers without a point count in them."""

    without_point: WithoutPoint
    source: Source
    mm: Decimal = Decimal("0.001")
    inch: Decimal = Decimal("0.0001")
    degree: Decimal = Decimal("0.001")

    def step(self, unit: Unit, length: Length) -> Decimal:
        """The least increment of a word of some unit."""
        if unit is Unit.DEGREE:
            return self.degree
        return self.inch if length is Length.INCH else self.mm


@dataclass(frozen=True, slots=True)
class Lexicon:
    """The addresses of a control by name, and how it reads numbers."""

    addresses: Mapping[str, Address]
    numbers: NumberFormat
    beside: tuple[Beside, ...] = ()
    """The other words of the control; of two rows for one word, the later one counts."""
    unknown: Source | None = None
    """By what it is told that the control stops at a word that it does not know; None where it leaves it out."""
    spelling: WordSpelling = PLAIN
    """The spelling of its words."""
    rows: dict[str, Beside | None] = field(default_factory=dict, init=False, repr=False, compare=False)
    """The rows of those, as far as they were asked for, by address."""
    factors: dict[tuple[str, bool, bool], Decimal] = field(default_factory=dict, init=False, repr=False, compare=False)
    """The factors of numbers, as far as that was asked for, by address, whether they have a point, and whether they are
    in inches."""
    others: dict[tuple[bool, bool, bool], "Lexicon"] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )
    """The same lexicon with X as diameter or not, as far as that was asked for."""
    after_comma: frozenset[str] = field(init=False, repr=False, compare=False)
    """The letters of words that have a comma before them."""

    def __post_init__(self) -> None:
        letters = frozenset(name[1:] for name in self.addresses if name.startswith(","))
        object.__setattr__(self, "after_comma", letters)

    def spell(self, address: str, number: str) -> str:
        """A word of an address and a number, as the control has it."""
        return self.spelling.spell(address, number)

    def number_of(self, text: str, address: str) -> str:
        """The number of a word that is spelled so, as it is written."""
        return self.spelling.number_of(text, address)

    def turned(self, *, absolute: bool, increment: bool, word: bool) -> "Lexicon":
        """The same where X is a diameter or not: as a coordinate or an increment that is always one, and by a plain
        word."""
        key = (absolute, increment, word)
        if key not in self.others:
            rows = {
                name: replace(row, is_diameter=increment if row.is_increment else absolute if row.is_absolute else word)
                for name, row in self.addresses.items()
                if row.axis == TURNED and not row.keeps_diameter
            }
            self.others[key] = replace(self, addresses={**self.addresses, **rows})
        return self.others[key]

    def row_beside(self, address: str) -> Beside | None:
        """The row of a word that draws no contour: by its name, without the number or the index behind it."""
        if address in self.addresses:
            return None
        if address not in self.rows:
            name = address.partition("[")[0].partition("=")[0]
            stems = (address, name, name.rstrip("0123456789")) if len(name) > 1 else (name,)
            found = (row for stem in stems for row in reversed(self.beside) if stem in row.names)
            self.rows[address] = next(found, None)
        return self.rows[address]

    def is_beside(self, address: str) -> bool:
        """Whether a word may stand in any block that moves, whatever else it means in contours."""
        rows = [row for row in self.beside if address in row.names] if address in self.addresses else []
        row = rows[-1] if rows else self.row_beside(address)
        return row is not None and row.bearing in (Bearing.NONE, Bearing.AXIS)

    def bearing(self, address: str) -> Bearing | None:
        """The bearing on the path of a word that draws no contour; None if the control has no such word."""
        row = self.row_beside(address)
        return row.bearing if row else None

    def plain_names(self) -> tuple[str, ...]:
        """The names of all words of the control, without those for which an argument of a code stands."""
        return tuple(dict.fromkeys((*self.addresses, *(name for row in self.beside for name in row.names))))

    def value(self, word: Word, unit: Length) -> Decimal | None:
        """The value of a word in mm (diameters halved) or degrees; None for a variable."""
        if word.number is None:
            return None
        value, origin = word.number * self.factor(word, unit), self.addresses[word.address].clockwise_from
        return value if origin is None else value + origin

    def factor(self, word: Word, unit: Length, *, has_point: bool = False) -> Decimal:
        """The mm (diameters halved) or degrees for each unit of a word as it is written, or as if it had a point."""
        key = word.address, word.has_point or has_point, unit is Length.INCH
        factor = self.factors.get(key)
        if factor is None:
            factor = self.factors[key] = self._factor(self.addresses[word.address], key[1], unit)
        return factor

    def given(self, name: str, word: Word, unit: Length) -> Given | None:
        """The value of a word as a given; None for a variable."""
        value = self.value(word, unit)
        if value is None:
            return None
        row = self.addresses[word.address]
        return Given(name, value, row.unit, word, row.is_diameter, clockwise_from=row.clockwise_from)

    def _factor(self, row: Address, has_point: bool, unit: Length) -> Decimal:
        factor = _HALF if row.is_diameter else _ONE if row.clockwise_from is None else -_ONE
        if row.unit is Unit.MM:
            factor *= unit.in_mm
        if has_point or self.numbers.without_point is WithoutPoint.AS_WRITTEN or row.unit is Unit.SIGN:
            return factor
        if row.unit is Unit.DEGREE:
            return factor * self.numbers.degree
        return factor * (self.numbers.inch if unit is Length.INCH else self.numbers.mm)
