"""The targets that a contour can be written for: one row each, and what each of them reads in another way."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Literal

from contoursolve.controls import FANUC_MILL as FANUC_CONTROL, PLAIN
from contoursolve.geometry import Length
from contoursolve.reading import Code, Control, Effect, Modes, NumberFormat, WithoutPoint

ArcsName = Literal["center", "radius"]
NumberingName = Literal["first", "all"]
PostName = Literal["same", "linuxcnc", "fanuc", "haas", "sinumerik", "klartext"]
"""The values of `Arcs` and `Numbering`, and the names of targets, as users write them; the last three are for formulas
alone."""


class Arcs(Enum):
    """Statement of an arc's centre."""

    CENTER = "center"
    """By I J K, counted from where the arc begins."""
    RADIUS = "radius"
    """By R; an arc of more than 120 degrees is written as several."""


class Numbering(Enum):
    """Choice of the lines that get a number, among those in the place of a block with one."""

    FIRST = "first"
    """The first one has that of the block; in the last block of a profile that a cycle calls, the last one."""
    ALL = "all"
    """All, the others with numbers that the program does not use."""


class MachineKind(Enum):
    """Kind of machine; lathes of the family of G-code system A share their codes."""

    LATHE = "lathe"
    MILL = "mill"


class Risk(Enum):
    """Consequence of a word that a target reads in another way."""

    TOLD = "told"
    """The tool goes the same way, or the target stops there with an alarm: it is told."""
    PATH = "path"
    """The tool may go another way without an alarm: nothing is written, unless that is asked for."""


@dataclass(frozen=True, slots=True)
class Other:
    """Another meaning of a code or an address on a target.

    `effect` is what the code does there: on a source control on which it does the same, it is not read otherwise.
    """

    meaning: str
    risk: Risk = Risk.TOLD
    effect: Effect | None = None


@dataclass(frozen=True, slots=True)
class SupportedCodes:
    """Codes that a target reads as the program's own control does, and those that it reads otherwise.

    `g` and `m` are the codes that it knows and that mean the same there; `otherwise` says of a code (`G90`) or of an
    address (`U`) what it means there instead. At any other code it stops with an alarm.
    """

    g: frozenset[int]
    m: frozenset[int]
    otherwise: Mapping[str, Other] = field(default_factory=dict)
    has_macros: bool = True
    """Whether IF, WHILE and GOTO are read."""
    flat_compensation: bool = False
    """Whether there is no cutter compensation in G19."""


@dataclass(frozen=True, slots=True)
class Post:
    """One target: how it writes numbers, what must stand before the first block of a program, and what it reads.

    `decimals` is None where the source control's own least increment counts; `opening` and `readings` go by the kind
    of machine. `without_point` is what a number without a decimal point means; None: as on the source control.
    """

    name: str
    title: str
    decimals: Mapping[Length, int] | None
    without_point: WithoutPoint | None
    opening: Mapping[MachineKind, str] = field(default_factory=dict)
    readings: Mapping[MachineKind, SupportedCodes] = field(default_factory=dict)
    modes: Modes | None = None
    """The tables of the target: its codes for units and for X as a diameter, and how its comments look."""

    def switch(self, code: Code) -> str:
        """The target's code for units, or for X as a diameter. Empty for another code, and if it has none or the same
        one."""
        own = self.modes.codes.values() if self.modes and (code.unit or code.diameter) else ()
        same = [each for each in own if (each.unit, each.diameter) == (code.unit, code.diameter)]
        return same[0].text if same and all(each.text != code.text for each in same) else ""

    def code_of(self, unit: Length) -> str:
        """The code that sets a unit on the target: its own first one, else that of ISO programs."""
        own = self.modes.code_of(unit) if self.modes else ""
        return own or {Length.INCH: "G20", Length.MM: "G21"}[unit]

    def digits(self, unit: Length, source: NumberFormat) -> int:
        """Decimals of a length."""
        if self.decimals is not None:
            return self.decimals[unit]
        step = source.inch if unit is Length.INCH else source.mm
        exponent = step.normalize().as_tuple().exponent
        return max(0, -exponent) if isinstance(exponent, int) else 0

    def writes_point(self, source: NumberFormat) -> bool:
        """Whether a whole number is written with a point: wherever, here or there, it would else count in least
        increments."""
        return WithoutPoint.LEAST_INCREMENTS in (self.without_point, source.without_point)


def _span(*parts: int | range) -> frozenset[int]:
    return frozenset(number for part in parts for number in (part if isinstance(part, range) else (part,)))


_LINUXCNC_M = _span(range(10), 30, 48, 49, 98, 99)

# LinuxCNC 2.9: each row is what its interpreter does. Risk.TOLD is for what it stops at, or what changes no path.
_PAUSE = Other("takes its time as P in seconds (without P it is an alarm)")
_STORED = Other("goes to a stored position (the machine's zero by default)")
"""The same motion as to a reference point, if that is what is stored (G28.1, G30.1)."""
_LOCAL = Other("sets coordinates like G92, and ends what G92 has set")
"""Alone, it is the same local coordinate system."""
_NO_COUNTERPART = Other("is an axis of its own (an alarm where there is none)")
_DATA = Other("sets tool data and coordinate systems, with L and P", Risk.PATH)
"""G10 L10 R is the length of a tool elsewhere, and its radius there."""
_LEAD = Other("takes its lead as K (without K it is an alarm)")
_FEEDS = {
    "G61": Other("is the exact path", Risk.PATH, Effect.NONE),
    "G64": Other("is blending", Risk.PATH, Effect.NONE),
    "G93": Other("is inverse time feed", Risk.PATH, Effect.NONE),
}
_STACK = {f"M{code}": Other("saves or restores what is in force", Risk.PATH) for code in range(70, 74)}

_LINUXCNC_LATHE = SupportedCodes(
    g=_span(range(5), 7, 18, 20, 21, 30, 40, 41, 42, 53, range(54, 60), 96, 97),
    m=_LINUXCNC_M,
    otherwise={
        "G4": _PAUSE,
        "G8": Other("makes X a radius", Risk.PATH),
        "G10": _DATA,
        "G17": Other("selects the plane of X and Y", Risk.PATH, Effect.PLANE),
        "G19": Other("selects the plane of Y and Z", Risk.PATH, Effect.PLANE),
        "G28": _STORED,
        "G30": _STORED,
        "G33": _LEAD,
        "G43": Other("takes the offset of a tool", Risk.PATH, Effect.NONE),
        "G49": Other("ends the offset of a tool", Risk.PATH, Effect.NONE),
        "G52": _LOCAL,
        **_FEEDS,
        "G70": Other("is the finishing pass of a subprogram", Risk.PATH),
        "G71": Other("is roughing by a subprogram", Risk.PATH),
        "G72": Other("is roughing by a subprogram", Risk.PATH),
        "G73": Other("is a drilling cycle", Risk.PATH),
        "G74": Other("is a tapping cycle", Risk.PATH),
        "G76": Other("is a threading cycle with other words", Risk.PATH),
        "G80": Other("ends a drilling cycle", effect=Effect.CANCEL),
        **{f"G{code}": Other("is a drilling cycle", Risk.PATH, Effect.CYCLE) for code in range(81, 90)},
        "G90": Other("is absolute coordinates", Risk.PATH, Effect.ABSOLUTE),
        "G91": Other("is incremental coordinates", Risk.PATH, Effect.INCREMENTAL),
        "G92": Other("sets coordinates", Risk.PATH, Effect.PRESET),
        "G94": Other("is feed a minute", Risk.PATH, Effect.NONE),
        "G95": Other("is feed a revolution", Risk.PATH, Effect.NONE),
        "G98": Other("is about the return of drilling cycles; feed a minute is G94"),
        "G99": Other("is about the return of drilling cycles; feed a revolution is G95"),
        "F": Other("is a feed a minute as long as no G95 is in force"),
        "T": Other("is the number of a tool alone; its offset is taken with G43"),
        "U": _NO_COUNTERPART,
        "W": _NO_COUNTERPART,
        **_STACK,
    },
    has_macros=False,
)

_LINUXCNC_MILL = SupportedCodes(
    g=_span(range(5), range(17, 22), 28, 30, range(40, 44), 49, range(53, 60), 61, 64, 73, range(80, 93), 94)
    | _span(range(95, 100)) - {87},
    m=_LINUXCNC_M,
    otherwise={
        "G4": _PAUSE,
        "G7": Other("makes X a diameter", Risk.PATH),
        "G8": Other("makes X a radius", Risk.PATH, Effect.NONE),
        "G10": _DATA,
        "G33": _LEAD,
        "G52": _LOCAL,
        "G74": Other("is a tapping cycle"),
        "G76": Other("is a threading cycle", Risk.PATH),
        "G84": Other("is a tapping cycle"),
        "G87": Other("is back boring with other words", Risk.PATH),
        "G88": Other("is a boring cycle with a stop"),
        "G93": _FEEDS["G93"],
        **_STACK,
    },
    has_macros=False,
    flat_compensation=True,
)

_POLAR = Other("begins polar coordinates", Risk.PATH)

_FANUC_LATHE = SupportedCodes(
    g=_span(range(5), 10, 18, 20, 21, 22, 23, 27, 28, 30, 31, 32, 34, 36, 37, 40, 41, 42, 50, range(53, 60), 65, 66, 67)
    | _span(range(70, 77), 90, 92, 94, range(96, 100)),
    m=_span(range(10), 19, 30, 98, 99),
    otherwise={
        "G11": Other("ends the setting of data", Risk.PATH, Effect.NONE),
        "G12": _POLAR,
        "G112": _POLAR,
    },
)

_FANUC_MILL = SupportedCodes(
    g=_span(range(5), 9, 10, range(15, 24), range(27, 32), 33, 37, range(40, 45), range(49, 60), 61, range(64, 70))
    | _span(73, 74, 76, range(80, 93), range(94, 100)),
    m=_span(range(10), 19, 30, 98, 99),
    otherwise={},
)

SAME = Post("same", "the control that the program is written for", None, None)

LINUXCNC = Post(
    "linuxcnc",
    "LinuxCNC 2.9",
    {Length.MM: 4, Length.INCH: 5},
    WithoutPoint.AS_WRITTEN,
    opening={MachineKind.LATHE: "G7 G18 {unit} G90 G91.1", MachineKind.MILL: "G8 G17 {unit} G90 G91.1"},
    readings={MachineKind.LATHE: _LINUXCNC_LATHE, MachineKind.MILL: _LINUXCNC_MILL},
    modes=PLAIN["linuxcnc"].modes,
)
"""G7: X is a diameter, G8: a radius; G91.1: I J K are counted from where the arc begins."""

FANUC = Post(
    "fanuc",
    "Fanuc 0i and relatives; lathes in G-code system A",
    {Length.MM: 3, Length.INCH: 4},
    WithoutPoint.LEAST_INCREMENTS,
    readings={MachineKind.LATHE: _FANUC_LATHE, MachineKind.MILL: _FANUC_MILL},
    modes=FANUC_CONTROL.modes,
)

POSTS = {post.name: post for post in (SAME, LINUXCNC, FANUC)}


def machine_of(control: Control) -> MachineKind:
    """The kind of machine of a control."""
    return MachineKind.LATHE if control.plane.code == "G18" else MachineKind.MILL


_SINUMERIK_LATHE = {
    "G50": Other("is not known: write LIMS= for the highest spindle speed"),
    "G92": Other("is not known as a limit of the spindle: write LIMS= for that"),
    "G98": Other("is not known: write G94 for a feed a minute"),
    "G99": Other("is not known: write G95 for a feed a revolution"),
}
"""Substitutes that SINUMERIK has for codes of the G-code system A."""

_NAMED_BY_FILE = {"O": Other("is no program number: the program has the name of its file")}
"""Word of controls that number their programs, on those that name them."""

_INSTEAD = {
    name: {MachineKind.LATHE: _SINUMERIK_LATHE | _NAMED_BY_FILE, MachineKind.MILL: _NAMED_BY_FILE}
    for name in ("siemens-840d", "siemens-808d")
} | {"isg": dict.fromkeys(MachineKind, _NAMED_BY_FILE)}


def post_of(target: Control) -> Post:
    """A control as a target: it reads the codes of its tables, and any M."""
    codes, numbers = target.modes.codes, target.modes.lexicon.numbers
    reading = SupportedCodes(
        g=frozenset(codes),
        m=_span(range(1000)),
        otherwise={
            **{f"G{number}": Other(f"is {code.meaning}", Risk.PATH, code.effect) for number, code in codes.items()},
            **_INSTEAD.get(target.name, {}).get(machine_of(target), {}),
        },
    )
    steps = {Length.MM: numbers.mm, Length.INCH: numbers.inch}
    decimals = {unit: -int(step.normalize().as_tuple().exponent) for unit, step in steps.items()}
    readings = {machine_of(target): reading}
    without_point = numbers.without_point
    return Post(
        target.name,
        target.title,
        decimals,
        without_point,
        readings=readings,
        modes=target.modes,
    )


def find_post(name: str | Post) -> Post:
    """The target of this name, or that is given as its table. Raises ValueError, which lists the choices."""
    if isinstance(name, Post):
        return name
    if name not in POSTS:
        raise ValueError(f"unknown post {name!r}; choose from {', '.join(POSTS)}")
    return POSTS[name]
