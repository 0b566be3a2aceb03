"""Drawings as they come out of a sketch: all their numbers, and what is proven of them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import atan2, degrees
from typing import overload

from msgspec import Struct

from contoursolve.diagnostics import Shown
from contoursolve.geometry import Fact, Profile, Unit
from contoursolve.solving.contour import ArcSegment, Contour
from contoursolve.solving.events import Status
from contoursolve.solving.solution import Certificate


class Stated(Struct, frozen=True):
    """The content of a sketch: its profile, the texts of its facts by the names of what they give, and the facts that
    ask for a value by the same names."""

    profile: Profile
    texts: Mapping[str, str]
    questions: Mapping[str, tuple[Fact, Unit]]


class Asked(Struct, frozen=True):
    """A value that was asked for: mm or degrees, as `unit` says; None while it is open."""

    fact: str
    unit: Unit
    value: float | None

    def __str__(self) -> str:
        shown = "still open" if self.value is None else f"{_shown(self.value)} {self.unit.value}"
        return f"{self.fact.rstrip(' =?')} = {shown}"


@dataclass(frozen=True, slots=True, repr=False)
class Drawing(Shown):
    """One way to draw a sketch.

    Attributes:
        points: the coordinates (X, Y) of each point by name, mm; the start among them if a path begins there.
        radii: the radii by name, mm.
        lines: of each line its direction (cosine, sine), and how far the origin lies to the right of it, mm.
        contour: the path, if there is one.
        certificate: what is proven of it.
        name: what tells it from the others; empty for the only one.
        asked: the values of the facts that ask for one, in the order of these facts.
        stated: the sketch, which its picture shows.
    """

    points: dict[str, tuple[float, float]]
    radii: dict[str, float]
    lines: dict[str, tuple[float, float, float]]
    contour: Contour | None
    certificate: Certificate
    name: str
    asked: tuple[Asked, ...] = ()
    stated: Stated | None = field(default=None, compare=False)

    def __hash__(self) -> int:
        return hash((self.name, self.contour, tuple(self.points)))

    def __repr__(self) -> str:
        parts = [f"{name} {_place(at)}" for name, at in self.points.items()]
        parts += [f"{name} {_shown(radius)} mm" for name, radius in self.radii.items()]
        parts += map(str, self.asked)
        return f"<Drawing {self.name or 'only drawing'}: {', '.join(parts)}>"

    def __str__(self) -> str:
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        yield self.name or "only drawing"
        for name, at in self.points.items():
            yield f"  {name}: {_place(at)}"
        for name, radius in self.radii.items():
            yield f"  {name}: {_shown(radius)} mm"
        for name, (cosine, sine, offset) in self.lines.items():
            angle = degrees(atan2(sine, cosine))
            yield f"  {name}: at {_shown(angle)} deg, the origin {_shown(offset)} mm to the right of it"
        for element in self.contour.elements if self.contour else ():
            arc = (
                f", radius {_shown(element.radius)} mm, {element.turn.value}" if isinstance(element, ArcSegment) else ""
            )
            yield f"  {element.name}: from {_place(element.start)} to {_place(element.end)}{arc}"
        for asked in self.asked:
            yield f"  {asked}"
        if not self.certificate.is_usual:
            yield f"  certificate: {self.certificate}"


@dataclass(frozen=True, slots=True, repr=False)
class Drawings(Shown, Sequence[Drawing]):
    """All ways to draw a sketch.

    Attributes:
        status: what came of it.
        drawings: the ways to draw it, each in mm.
        is_complete: whether the list is complete, with proof.
        doubts: what could not be decided, where it is not.
        reach: how far from the start solutions were searched for, mm; None where a closed form gives them.
        free: the unknowns that are still open; then there are no drawings, and the list is not complete.
        ties: facts that repeat others, by number from 0; where they disagree, there are no drawings either.
        stated: the sketch, which the picture shows.
    """

    status: Status
    drawings: tuple[Drawing, ...]
    is_complete: bool
    doubts: tuple[str, ...]
    reach: float | None
    free: tuple[str, ...]
    ties: tuple[int, ...]
    stated: Stated | None = field(default=None, compare=False)

    def __len__(self) -> int:
        return len(self.drawings)

    @overload
    def __getitem__(self, index: int) -> Drawing: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Drawing, ...]: ...

    def __getitem__(self, index: int | slice) -> Drawing | tuple[Drawing, ...]:
        return self.drawings[index]

    def __iter__(self) -> Iterator[Drawing]:
        return iter(self.drawings)

    def __repr__(self) -> str:
        return f"<Drawings {self.status.value}: {self.summary}>"

    def __str__(self) -> str:
        return "\n".join((f"{self.status.value}: {self.summary}", *map(str, self.drawings)))

    @property
    def summary(self) -> str:
        """The number of them, and whether these are all."""
        if self.free:
            return f"still open: {', '.join(map(_unknown, self.free))}"
        shown = "closed form" if self.reach is None else f"search within {self.reach:.0f} mm of the start point"
        number = f"{len(self)} drawing{'' if len(self) == 1 else 's'}"
        if self.is_complete:
            return f"{number}; these are all (by {shown})"
        return f"at least {number}; there may be more (by {shown}); not decided: {'; '.join(self.doubts)}"


def worded(name: str, texts: Mapping[str, str]) -> str:
    """A name with facts in their own words: the side that a fact leaves open is told by the fact."""
    for fact, text in texts.items():
        name = name.replace(f"{fact} ", f"{text} ")
    return name


def _unknown(name: str) -> str:
    """An unknown in words: `X of P1`."""
    of, _, part = name.rpartition(".")
    words = {"0": "X of", "1": "Y of", "radius": "radius of", "off": "place of"}
    return f"{words.get(part, 'direction of')} {of}"


def _place(at: tuple[float, float]) -> str:
    return f"X{_shown(at[0])} Y{_shown(at[1])} mm"


def _shown(value: float) -> str:
    text = f"{value:.4f}"
    return "0.0000" if text == "-0.0000" else text
