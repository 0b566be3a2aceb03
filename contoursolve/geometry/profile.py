"""The drawing of one contour with the values that its blocks give: what reading makes of words."""

from collections.abc import Iterable, Mapping
from decimal import Decimal
from enum import Enum
from functools import cached_property

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.gcode import Block, Word
from contoursolve.geometry.fact import Fact
from contoursolve.geometry.figure import Figure
from contoursolve.tolerance import INCREMENT, INCREMENT_ANGLE, INCREMENT_INCH, TRAVEL

INCREMENT_OF = "increment:"
"""The beginning of the name of a least increment."""

_MM, _INCH = Decimal(1), Decimal("25.4")


class Unit(Enum):
    """The quantity that a value measures."""

    MM = "mm"
    DEGREE = "deg"
    SIGN = "sign"
    """Only the sign counts."""


class Length(Enum):
    """The unit in which a program is written."""

    MM = "mm"
    INCH = "inch"

    @property
    def in_mm(self) -> Decimal:
        """Millimetres in one unit."""
        return _INCH if self is Length.INCH else _MM


class Plane(Struct, frozen=True):
    """A working plane: its G code, its two axes, its centre addresses, and which axes are diameters."""

    code: str
    axes: tuple[str, str]
    centers: tuple[str, str]
    diameters: tuple[bool, bool] = (False, False)


class Given(Struct, frozen=True):
    """A value that the block states: `name` is its name in the equations, `value` is in mm (radius)
    or degrees. `word` is None for a value that the control supplies by itself. `is_diameter` tells that
    the word is written as twice the value. `follows` is the name of another value from which the control makes it, by
    adding the same whatever that is. An angle that the word counts clockwise from a direction (degrees) has that as
    `clockwise_from`."""

    name: str
    value: Decimal
    unit: Unit
    word: Word | None
    is_diameter: bool = False
    follows: str = ""
    clockwise_from: Decimal | None = None

    def as_typed(self, value: float) -> float:
        """A value, mm or degrees, as the word counts it: a diameter, or an angle from another direction."""
        return float(self.clockwise_from) - value if self.clockwise_from is not None else value * (1 + self.is_diameter)

    def of_typed(self, value: float) -> float:
        """The value, mm or degrees, of what is as the word counts it."""
        return float(self.clockwise_from) - value if self.clockwise_from is not None else value / (1 + self.is_diameter)


class Question(Struct, frozen=True):
    """A value that is asked for: its name, the fact that tells it, and how it is written."""

    name: str
    fact: Fact
    unit: Unit
    word: Word
    is_diameter: bool = False


class Start(Struct, frozen=True):
    """The start point of a contour: a value in mm (X as radius) per axis, None where unknown.

    On an axis that is `free` it is not known either, and nothing depends on it: coordinates count from the start, which
    is 0 there.
    """

    values: tuple[Decimal | None, Decimal | None]
    free: tuple[bool, bool] = (False, False)

    @property
    def is_relative(self) -> bool:
        """Whether coordinates count from it on an axis: the contour has a shape, and no place."""
        return any(self.free)

    @property
    def is_known(self) -> bool:
        """Whether both coordinates are known."""
        return None not in self.values


class Side(Enum):
    """The one of two solutions of a step that is meant, named by the geometry."""

    NEARER = "nearer"
    """First of the two points on the line, counted along its direction."""
    FARTHER = "farther"
    LEFT = "left"
    """Left of the chord from the first point to the second."""
    RIGHT = "right"
    FIRST = "first"
    """Met first where an arc is travelled clockwise from its start."""
    SECOND = "second"
    SHORTER = "shorter"
    """With it, the line that ends or begins there is the shorter one."""
    LONGER = "longer"

    @property
    def sign(self) -> int:
        """-1 for nearer, right, second and shorter, +1 for the others: the sign of the root."""
        return -1 if self in (Side.NEARER, Side.RIGHT, Side.SECOND, Side.SHORTER) else 1


class Choice(Struct, frozen=True):
    """The control's choice between two solutions for `point`, and the given that makes it; empty for one that the
    form itself makes, so that no block has the other solution."""

    point: str
    side: Side
    given: str


class Pick(Struct, frozen=True):
    """The solution that is meant at an element of the path: the number of the element and of the solution there, from
    1, in the order of travel; and the given that says so, empty for one that nothing says. One of `most` chooses by
    where the element ends, whichever block determines that, and among no more than so many."""

    element: int
    number: int
    given: str
    most: int = 0


class Layout(Struct, frozen=True, dict=True):
    """A figure with the facts that some combination of words states about it.

    Every block with these words shares one object: caches go by it.
    """

    figure: Figure
    facts: tuple[Fact, ...]

    @cached_property
    def _hash(self) -> int:
        # Layouts differ by the names of their facts, mostly: all that is in them takes ten times as long.
        return hash((self.figure.points, tuple(fact.given for fact in self.facts)))

    def __hash__(self) -> int:
        return self._hash


class Profile(Struct, frozen=True, dict=True):
    """One contour, partly unknown.

    The layout's facts are what the words state and the control uses; `ignored` are facts that the
    control drops by a rule of its manual. `givens` holds every value by its name. `intersections` are the points
    that a user wants to see.
    """

    form: str
    blocks: tuple[Block, ...]
    plane: Plane
    unit: Length
    layout: Layout
    start: Start
    givens: Mapping[str, Given]
    intersections: tuple[str, ...]
    ignored: tuple[Fact, ...] = ()
    choices: tuple[Choice, ...] = ()
    questions: tuple[Question, ...] = ()
    picks: tuple[Pick, ...] = ()
    is_extended: bool = False
    """Whether it states or asks more than its form provides for."""
    travel: float = TRAVEL
    """mm. How far from the start point the control can make a contour."""

    @property
    def figure(self) -> Figure:
        """The drawing without its values."""
        return self.layout.figure

    @cached_property
    def increments(self) -> dict[str, float]:
        """The least increments of the control, mm (radius) or degrees: those of coordinates by `increment:0` and
        `increment:1`, those of values by `increment:` and their names; 0 for a value that no word states."""
        return least_increments(self.unit, self.plane, self.givens)

    def words_of(self, facts: Iterable[Fact]) -> list[Word]:
        """The words that state these facts; what the form or the control states by itself has none."""
        words = (self.givens[fact.given].word for fact in facts if fact.given)
        return [word for word in words if word]

    @property
    def facts(self) -> tuple[Fact, ...]:
        """The facts that the words state, as far as the control uses them."""
        return self.layout.facts

    def with_free_start(self) -> "Profile":
        """The same with its start at 0 along each axis on which it is not known, if nothing is stated or asked of where
        anything is; else with what is known."""
        start = self.start
        if start.is_known and not start.is_relative:
            return self
        facts = (*self.facts, *self.ignored, *(question.fact for question in self.questions))
        is_placed = any(fact.placed is not None and not fact.placed.origin for fact in facts)
        rest = None if is_placed or self.figure.places else Decimal(0)
        unknown = [at is None or is_free for at, is_free in zip(start.values, start.free, strict=True)]
        first, second = (rest if is_open else at for at, is_open in zip(start.values, unknown, strict=True))
        free = (unknown[0] and rest is not None, unknown[1] and rest is not None)
        return replace(self, start=Start((first, second), free))


def least_increments(unit: Length, plane: Plane, givens: Mapping[str, Given]) -> dict[str, float]:
    """The least increments of a program's coordinates and values, see `Profile.increments`."""
    length = INCREMENT_INCH if unit is Length.INCH else INCREMENT
    found = {f"{INCREMENT_OF}{axis}": length / (1 + is_half) for axis, is_half in enumerate(plane.diameters)}
    for name, given in givens.items():
        step = INCREMENT_ANGLE if given.unit is Unit.DEGREE else length / (1 + given.is_diameter)
        found[INCREMENT_OF + name] = step if given.word is not None else 0.0
    return found
