"""The language in which a control writes lines and arcs in a row, and the names that its rules and assumptions use."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum

from msgspec import Struct

from contoursolve.gcode import Block, Word
from contoursolve.geometry import CornerShape, Plane, Side, Turn
from contoursolve.reading import (
    Assumption,
    Condition,
    ContourForm,
    Convention,
    Lexicon,
    Modes,
    Sample,
    Setting,
    State,
    Stated,
)

LINE, ARC = "line", "arc"
OVER_LINE, OVER_CIRCLE = "over-defined line", "over-defined circle"
"""The roles of single blocks; the over-defined ones begin in a computed intersection."""
LINE_LINE, LINE_CIRCLE, CIRCLE_LINE, CIRCLE_CIRCLE = "line-line", "line-circle", "circle-line", "circle-circle"
"""The roles of two blocks that meet in a computed intersection."""

ALONE, OTHER_PLANE, RAPID = "@alone", "@other-plane", "@rapid"
OTHER_ZERO = "@other-zero"
"""The coordinate system is another one than where the contour begins."""
OTHER_DIAMETER = "@other-diameter"
"""X is a diameter here and a radius where the contour begins, or the other way round."""
FOLLOWED = "@followed"
"""This block ends in a computed intersection with the next one."""
LAST = "@last"
"""It has a corner, and no G1, G2 or G3 block follows."""
FEED, NEGATIVE_RADIUS, ONE_CENTER = "@feed", "@negative-radius", "@one-center"
"""A feed in the block; an over-defined circle with a negative R; one of the two distances to the centre."""
ON_PARALLEL_AXES = "@parallel"
"""A parallel axis stands for an axis of the plane."""
ONLY = "@only"
"""The only block of its contour."""
SMOOTH, NO_TANGENT = "@smooth", "@no-tangent"
"""An arc that begins in the direction of the element before it; one that has none before it."""
CORNER_BOTH = "@corner-both"
"""A block of its own behind it makes a chamfer and a rounding."""
CORNER_CROWDED = "@corner-crowded"
"""A block of its own behind it that makes a corner says more than the size."""
CORNER_TWICE = "@corner-twice"
"""A block and one of its own behind it state the same kind of corner."""
RAPID_CORNER = "@rapid-corner"
"""Its corner may stand beside a rapid."""
LEFT_OUT = "@left-out"
"""The control leaves out a corner behind which no move follows."""
CORNER_ALONE = "@corner-alone"
"""A block of its own that makes a corner, behind no move."""
BESIDE_ARC = "@beside-arc"
"""Its element or the next one is an arc."""
THREAD = "@thread"
"""It cuts a thread."""
ORDINARY = "@ordinary"
"""The control calculates nothing for it."""

POINT = "point"
"""Stated as soon as a block that ends in an intersection has a coordinate: then it states a point of its element."""
AIMED = "aimed"
"""Stated instead of it if the same line has an angle, too: both then say where it runs."""

TURN = "turn"
"""By how much the direction changes where an arc begins: nothing."""

WAY = "way"
"""The direction of a line behind a corner whose sign tells it, in degrees."""

SIGNED = "corner-"
"""The begin of the names of corner words whose sign tells which way the next line runs."""
NEGATIVE = "negative-"
"""The begin of the names of corner words whose sign tells the shape, where it is a minus."""
LEAVES = ("@leaves-first", "@leaves-second")
"""Behind such a corner, this block must move this axis of the plane alone."""

STATED_POINT = ("first", "first-step", "second", "second-step")
STATED_CENTER = ("center-first", "center-second")
"""The names of a block's coordinates and of its I, J and K, by the axes of the plane; steps are increments."""
CENTER_AT = ("center-at-first", "center-at-second")
"""The names of the coordinates of a centre."""


class Element(Struct, frozen=True):
    """One block: a line, or an arc of a sense.

    `is_over` tells that it begins in a computed intersection or contact, `is_followed` that it ends in one.
    """

    turn: Turn | None = None
    is_over: bool = False
    is_followed: bool = False
    touches: bool = False
    """Whether it touches the element before it where it begins."""
    is_smooth: bool = False
    """Whether it is an arc that begins in the direction of the element before it, and has neither centre nor radius."""
    aim: int | None = None
    """The axis along which it runs, if the sign of the corner before it tells which way."""

    @property
    def role(self) -> str:
        """The role by which rules speak about it."""
        if self.turn is None:
            return OVER_LINE if self.is_over else LINE
        return OVER_CIRCLE if self.is_over else ARC


A_LINE, AN_ARC = Element(), Element(Turn.CCW)
OPEN_LINE, OPEN_ARC = Element(is_followed=True), Element(Turn.CCW, is_followed=True)
CLOSING_LINE, CLOSING_ARC = Element(is_over=True), Element(Turn.CCW, is_over=True)
"""Those of which samples are made: between known points, with an end that is computed, and behind one of these."""


def pair_role(first: Element, second: Element) -> str:
    """The role of two blocks that meet in a computed intersection, by which rules speak about them."""
    if first.turn is None:
        return LINE_LINE if second.turn is None else LINE_CIRCLE
    return CIRCLE_LINE if second.turn is None else CIRCLE_CIRCLE


class Member(Struct, frozen=True):
    """One block of a contour: its element, the states before and after its G codes, whether it can stand here."""

    block: Block
    element: Element
    before: State
    here: State
    is_alone: bool = False
    """Over-defined, but no G1, G2 or G3 block is right before it."""
    is_last: bool = False
    """No G1, G2 or G3 block follows."""
    is_joined: bool = False
    """Another block of the contour follows."""
    unread: Word | None = None
    """The word that shapes the block behind it in a way that is not read."""
    corner: Block | None = None
    """The block of its own that states the corner behind it."""
    is_straight: bool = False
    """The next element begins in the direction in which it ends, so that a word that stays in force makes no corner."""
    is_signed: bool = False
    """Whether the sign of its corner word tells which way the next line runs."""
    leaves: tuple[int, ...] = ()
    """Behind such a corner: the axis that it must move alone; both if it is none that may stand there."""
    way: int = 0
    """Its sense along that axis, +1 or -1."""


_CENTERS = ("I", "J", "K")


class Premise(Struct, frozen=True):
    """A setting on which the reading of a contour rests where a condition holds for one of its blocks: for what that
    states, its addresses, and what else holds of it.

    Of one that is only told where it was set, the default one has a finding of its own, or goes without saying.
    """

    setting: Setting
    when: Condition
    is_told_where_set: bool = False

    def is_told(self, blocks: Iterable[Stated], modes: Modes) -> bool:
        """Whether it is told of a contour of blocks of which this holds."""
        if self.is_told_where_set and modes.has(self.setting, self.setting.default):
            return False
        return any(map(self.when.holds, blocks))


WITHOUT_POINT = "@without-point"
"""It has a number without a decimal point, which is not 0."""
OPEN_ARC_END = "@open-arc"
"""An arc that ends where it meets the next block."""
IN_ZX = "@in-zx"
"""In the plane of Z and X."""


class Joining(Enum):
    """The reason for which two blocks meet in a computed intersection."""

    OVER_DEFINED = "the second block states more than an element from a known point needs"
    OPEN = "the first block is a line by its angle alone"
    PAIRED = "the first block is a line by its angle alone, or an arc without an end"


TITLES: Mapping[str, str] = {
    LINE_LINE: "vertex of two lines by their angles",
    "line-angle": "line by its angle and one coordinate",
    "corners": "chamfers and roundings",
    "chain": "chain of lines by their angles",
    "arc": "arc",
    "tangent": "arcs that begin tangentially",
}
"""The titles of forms, by the role of two blocks or the name of the form."""


def sense_conventions(sense: Setting, form: ContourForm, modes: Modes) -> Iterator[Convention]:
    """The convention on lines against their angle: where there is one, and if that was set."""
    convention = modes.convention(sense)
    if convention.value == "ray" and any(row.fact.heading for row in form.outline.facts):
        yield convention


def _nothing(*_: object) -> Iterable[str]:
    return ()


def _no_conventions(*_: object) -> Iterable[Convention]:
    return ()


def _never(_: Modes) -> bool:
    return False


def _no_guard(_: Modes) -> float:
    return 0.0


@dataclass(frozen=True, slots=True, eq=False)
class AngleWords:
    """The words that state how a line runs."""

    address: str = ",A"
    """The name of an angle, and its address unless `synonyms` state it; empty where there is none."""
    synonyms: tuple[str, ...] = ()
    """The addresses that state it, if there are several: of two in a block, the last of these does."""
    parallel: Mapping[str, str] = field(default_factory=dict)
    """The parallel axis of each axis, where it may stand beside an angle."""
    sense: Setting | None = None
    """The setting that decides whether an angle is the direction of travel (`ray`), or a line may run against it, too;
    without such a setting it is."""
    stays: bool = False
    """Whether an angle stays in force, for lines with one coordinate."""
    is_ray_alone: bool = False
    """Whether a line by its angle and one coordinate runs as its angle says, whatever `is_ray` tells of others."""

    def is_ray(self, modes: Modes) -> bool:
        """Whether an angle is the direction of travel."""
        return self.sense is None or modes.has(self.sense, "ray")

    @property
    def addresses(self) -> tuple[str, ...]:
        """The addresses that state an angle; of two in a block, the last of these does."""
        return self.synonyms or (self.address,)


@dataclass(frozen=True, slots=True, eq=False)
class CornerWords:
    """The words that make corners, and where the control makes none."""

    words: Mapping[str, CornerShape] = field(
        default_factory=lambda: {",C": CornerShape.CHAMFER_SETBACK, ",R": CornerShape.FILLET}
    )
    """The shape that each corner word gives the corner behind its block."""
    stays: Mapping[str, str] = field(default_factory=dict)
    """Words that stay in force and make corners, each with the corner word whose size they state."""
    codes: Mapping[int, str] = field(default_factory=dict)
    """G codes of blocks that make a corner between two others, each with the corner word whose size they state."""
    size: str = "I"
    """The word of such a block that states the size."""
    signed: Mapping[str, CornerShape] = field(default_factory=dict)
    """Words of a line along one axis that make a corner before a line along the other axis: the sign tells which way
    that one runs. I, J and K state a distance along their own axis."""
    is_signed_by_shape: bool = False
    """Whether these words have a sign only between two such lines, and are other corner words elsewhere."""
    negative: Mapping[str, CornerShape] = field(default_factory=dict)
    """The shape that a corner word gives with a negative number, whose size is the number without its sign."""
    words_in_rapid: Callable[[Modes], bool] = _never
    """Tells whether its words make corners beside rapids, too."""
    codes_in_rapid: bool = False
    """Whether blocks of their own do."""
    leaves_out: Callable[[Modes], bool] = _never
    """Tells whether it leaves out a corner behind which no move follows in the same plane, without an alarm."""
    note: str = ""
    """The action of the control at each corner that it inserts, half a sentence without a full stop."""
    guard: Callable[[Modes], float] = _no_guard
    """Sine of the change of direction up to which the control makes no corner."""
    refuses: Callable[[Modes], bool] = _never
    """Tells whether it refuses such a corner; else it leaves it out."""

    def signed_name(self, address: str, plane: Plane) -> str:
        """The name of a corner word with a sign; empty for the distance along an axis outside the plane."""
        if address not in _CENTERS:
            return SIGNED + address
        orders = dict(zip(plane.centers, ("first", "second"), strict=True))
        return SIGNED + orders[address] if address in orders else ""

    @property
    def shapes(self) -> Mapping[str, CornerShape]:
        """The shape of a corner by the name of its word."""
        shapes = dict(self.words)
        for address, shape in self.signed.items():
            orders = ("first", "second") if address in _CENTERS else (address,)
            shapes |= {SIGNED + order: shape for order in orders}
        return shapes | {NEGATIVE + name: shape for name, shape in self.negative.items()}


@dataclass(frozen=True, slots=True, eq=False)
class BlockMeeting:
    """The intersections that the control computes between two blocks, and the words that choose one of two."""

    joining: Joining
    closes_by_steps: bool = False
    """Whether a line that meets one without an end may give its end by increments: from where that one begins."""
    selector: str = ""
    """The address whose sign chooses an intersection."""
    selects: Mapping[str, str] = field(default_factory=dict)
    """The choice that it makes, by the role of two blocks."""
    choose_side: Callable[[str, bool, Modes], Side] | None = None
    """(role of two blocks, whether the selector is negative, modes) to the intersection that it chooses."""
    counts_clockwise: Callable[[Modes], bool] = _never
    """Tells whether the intersections of two circles count clockwise along the first."""
    picks: str = ""
    """The address that chooses an intersection by its value in either of two blocks: 0 or 1, the shorter or the longer
    line."""
    contact: Callable[[Modes], float] = _no_guard
    """By how much, mm, two circles that are both known may miss a contact."""


@dataclass(frozen=True, slots=True, eq=False)
class ArcWords:
    """The words of arcs that other controls do not have."""

    centers: tuple[str, str] | tuple[()] = ()
    """The addresses of the coordinates of a centre, of an arc without an end: for I and J, for I and K, or J and K."""
    closes: bool = False
    """Whether an arc about its centre without an end is a full circle, unless the word that picks an intersection is in
    its block."""
    tangent: int | None = None
    """The motion of an arc that begins in the direction of the element before it."""
    radius_wins: bool = False
    """Whether a centre counts for nothing beside a radius."""

    def centers_at(self, plane: Plane) -> Mapping[str, str]:
        """The names of these addresses in a plane."""
        orders = dict(zip(plane.centers, CENTER_AT, strict=True))
        return dict(zip(self.centers, (orders[each] for each in sorted(plane.centers)), strict=False))


@dataclass(frozen=True, slots=True, eq=False)
class BlockOrder:
    """The blocks that may follow each other in one contour."""

    passes: frozenset[int] = frozenset()
    """G codes of blocks that may stand between two blocks of a contour."""
    between: int = 0
    """The number of blocks that move nothing and may stand there."""
    threads: frozenset[int] = frozenset()
    """The motions of threads, in which the control computes no angle and no corner, and says so."""
    runs_in_rapid: bool = False
    """Whether two lines in rapid may meet."""


@dataclass(frozen=True, slots=True, eq=False)
class LanguageBasis:
    """The circumstances that rules and assumptions look at, and the settings on which a reading rests."""

    circumstances: Callable[[Member, Sequence[State], Modes], Iterable[str]] = _nothing
    """(member, states before the block before it, before it and behind it, modes) to what else holds of it."""
    where_set: Mapping[str, tuple[Setting, str]] = field(default_factory=dict)
    """The circumstances of every block where a setting has a value."""
    conventions: Callable[[ContourForm, Collection[str], Modes], Iterable[Convention]] = _no_conventions
    """(form, circumstances, modes) to the settings on which the reading rests."""
    premises: tuple[Premise, ...] = ()
    """Further ones, with what must be there."""


@dataclass(frozen=True, slots=True, eq=False)
class Language:
    """The language in which a control writes lines and arcs in a row.

    `planes` by their G code, where a parallel axis may stand for an axis of them; `allowed` are the addresses that may
    stand in a block of a contour. `titles` are those of forms, by role or form name.
    """

    lexicon: Lexicon
    allowed: frozenset[str]
    meeting: BlockMeeting
    angle: AngleWords = field(default_factory=AngleWords)
    corner: CornerWords = field(default_factory=CornerWords)
    arc: ArcWords = field(default_factory=ArcWords)
    order: BlockOrder = field(default_factory=BlockOrder)
    basis: LanguageBasis = field(default_factory=LanguageBasis)
    planes: Mapping[str, Plane] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)
    """Addresses that state what is called otherwise here: `CR` the radius `R`."""
    titles: Mapping[str, str] = field(default_factory=lambda: TITLES)
    assumptions: tuple[Assumption, ...] = ()
    samples: Mapping[tuple[Element, ...], Sample] = field(default_factory=dict)
    """Programs for the tables of words, one for each kind of form."""

    def address_of(self, name: str) -> str:
        """The address that states what has this name."""
        return next((address for address, called in self.names.items() if called == name), name)

    def names_in(self, *, is_arc: bool) -> Mapping[str, str]:
        """`names` in a block; R of an arc is always its radius."""
        return {address: name for address, name in self.names.items() if address != "R"} if is_arc else self.names

    @property
    def own(self) -> frozenset[str]:
        """The addresses of angles and corners."""
        return frozenset({*map(self.address_of, (*self.angle.addresses, *self.corner.words)), *self.corner.stays})

    @property
    def axes(self) -> tuple[str, ...]:
        """The addresses of its axes, and of increments along them."""
        return tuple(row.address for row in self.lexicon.addresses.values() if row.axis)
