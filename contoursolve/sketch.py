"""A drawing stated freely: points, lines, arcs and circles with facts about them, and every way to draw it.

>>> sketch = Sketch()
>>> for name, x, y in (("a", 0, 0), ("b", 10, 0), ("c", 4, 8)):
...     sketch.circle(name, center=(x, y), radius=2)
>>> sketch.circle("k")
>>> for name in "abc":
...     sketch.state(f"k tangent to {name}")
>>> solutions = sketch.solve()
>>> len(solutions), solutions.is_complete
(8, True)
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal

from contoursolve.analysis import judge
from contoursolve.constraints import OnCircle, assemble
from contoursolve.contour import Contour, trace
from contoursolve.model import Arc, Circle, Figure, Length, Line, Plane, Profile, Start, Turn
from contoursolve.solving.alternatives import Alternative, Alternatives, find_alternatives
from contoursolve.solving.certificate import Certificate
from contoursolve.solving.decide import decide
from contoursolve.solving.solution import Status
from contoursolve.statements import Draft, Statement, Vocabulary, read_statement
from contoursolve.statements.apply import rank

Number = Decimal | float | int | str
"""A value in mm or degrees; a float is taken as the decimal that Python prints for it."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """One way to draw a sketch, in mm: points, radii, and lines by their direction (cosine, sine) and how far the
    origin lies to the right of them. `contour` is the path, if there is one that runs as it must."""

    points: dict[str, tuple[float, float]]
    radii: dict[str, float]
    lines: dict[str, tuple[float, float, float]]
    contour: Contour | None
    certificate: Certificate
    name: str


@dataclass(frozen=True, slots=True)
class Drawings(Sequence[Drawn]):
    """All ways to draw a sketch.

    The list is complete, with proof, if `is_complete`; else `doubts` says what could not be decided. `reach` is how
    far from the start solutions were searched for where there is no closed form, mm. `free` are the unknowns that
    nothing determines; then there are no drawings. `ties` are facts of which each follows from others, by number
    from 0; where they disagree, there are no drawings either.
    """

    status: Status
    drawings: tuple[Drawn, ...]
    is_complete: bool
    doubts: tuple[str, ...]
    reach: float | None
    free: tuple[str, ...]
    ties: tuple[int, ...]

    def __len__(self) -> int:
        return len(self.drawings)

    def __getitem__(self, index):  # type: ignore[no-untyped-def]
        return self.drawings[index]

    def __iter__(self) -> Iterator[Drawn]:
        return iter(self.drawings)


class Sketch:
    """A drawing under construction, in the axes X and Y. Lines and arcs make one path, in the order in which they
    are added; circles and infinite lines stand beside it."""

    def __init__(self, start: tuple[Number, Number] = (0, 0), *, name: str = "P0") -> None:
        """A sketch whose path begins at `start`, mm."""
        self._start = Start((_decimal(start[0]), _decimal(start[1])))
        self._here = self._first = name
        self._path: list[Line | Arc] = []
        self._points: list[str] = []
        self._radii: list[str] = []
        self._facts: list[OnCircle] = []
        self._beside: list[tuple[str, tuple[Decimal, Decimal] | None, Decimal | None]] = []
        self._free_lines: list[Line] = []
        self._statements: list[str | Statement] = []

    def line(self, name: str, to: str = "") -> None:
        """Add a line to the path; `to` names its end, P1, P2, ... otherwise."""
        tail, self._here = self._here, self._end(to)
        self._path.append(Line(name, tail, self._here))

    def arc(self, name: str, turn: str, to: str = "") -> None:
        """Add an arc to the path; `turn` is `cw` or `ccw`. Its centre is the point `name.center`."""
        tail, self._here = self._here, self._end(to)
        center, radius = f"{name}.center", f"{name}.radius"
        self._path.append(Arc(name, tail, self._here, center, radius, Turn(turn)))
        self._points.append(center)
        self._radii.append(radius)
        self._facts += [OnCircle(end, center, radius) for end in (tail, self._here)]

    def circle(self, name: str, center: tuple[Number, Number] | None = None, radius: Number | None = None) -> None:
        """Add a circle beside the path: given, if both its centre and its radius are, else unknown."""
        if (center is None) != (radius is None):
            raise ValueError("give both center and radius of a circle, or neither and state facts about it")
        place = (_decimal(center[0]), _decimal(center[1])) if center is not None else None
        self._beside.append((name, place, None if radius is None else _decimal(radius)))

    def infinite_line(self, name: str) -> None:
        """Add a whole line beside the path, to be found by facts; it is taken to run to the right, or upwards."""
        self._free_lines.append(Line(name, "", ""))

    def state(self, fact: str | Statement) -> None:
        """State a fact, as text (see `contoursolve facts`; the axes are X and Y) or as a statement."""
        self._statements.append(fact)

    def profile(self) -> Profile:
        """The sketch as a profile. Raises GrammarError or StatementError for a fact that makes no sense."""
        unknown = [(name, f"{name}.center", f"{name}.radius") for name, center, _ in self._beside if center is None]
        figure = Figure(
            self._first,
            (*self._points, *(center for _, center, _ in unknown)),
            (*self._radii, *(radius for _, _, radius in unknown)),
            tuple(self._path),
            lines=tuple(self._free_lines),
            circles=tuple(Circle(*each) for each in unknown),
        )
        draft = Draft(figure, self._facts, {})
        for name, place, size in self._beside:
            if place is not None and size is not None:
                draft.circle(name, place, size)
        plane = Plane("", ("X", "Y"), ("I", "J"))
        elements = (*draft.figure.path, *draft.figure.lines, *draft.figure.circles)
        words = Vocabulary([each.name for each in elements], (self._first, *self._points), plane, Length.MM)
        read = [read_statement(each, words) if isinstance(each, str) else each for each in self._statements]
        for number, statement in sorted(enumerate(read), key=lambda each: rank(each[1])):
            statement.state(draft, f"fact {number + 1}")
        for line in self._free_lines:
            draft.line(line.name)
        return Profile(
            form="sketch",
            blocks=(),
            plane=plane,
            unit=Length.MM,
            layout=draft.layout(),
            start=self._start,
            givens=draft.givens,
            intersections=(),
            is_extended=True,
        )

    def solve(self) -> Drawings:
        """Every way to draw the sketch. Raises GrammarError or StatementError for a fact that makes no sense."""
        profile = self.profile()
        system = assemble(profile)
        verdict = judge(system)
        numbers = [fact.given.removeprefix("fact ") for fact in (system.facts[index] for index in verdict.tied)]
        ties = tuple(sorted({int(number) - 1 for number in numbers if number.isdigit()}))
        if not verdict.is_determined:
            return Drawings(Status.UNDERDETERMINED, (), True, (), None, verdict.free, ties)
        alternatives = find_alternatives(profile)
        items = [item for item in alternatives.items if item.is_path]
        return Drawings(
            status=decide(alternatives, profile).status,
            drawings=tuple(_drawn(item, profile) for item in items),
            is_complete=alternatives.is_complete,
            doubts=_doubts(alternatives),
            reach=alternatives.reach,
            free=(),
            ties=ties,
        )

    def _end(self, name: str) -> str:
        end = name or f"P{len(self._path) + 1}"
        self._points.append(end)
        return end


def _drawn(item: Alternative, profile: Profile) -> Drawn:
    figure = profile.figure
    lines = {line: tuple(item.scalars[f"{line}.{part}"] for part in ("cos", "sin", "off")) for line in figure.carriers}
    return Drawn(
        points=dict(item.solution.points),
        radii=dict(item.solution.radii),
        lines={name: (cosine, sine, offset) for name, (cosine, sine, offset) in lines.items()},
        contour=trace(profile, item.solution) if figure.path else None,
        certificate=item.certificate,
        name=item.name,
    )


def _doubts(alternatives: Alternatives) -> tuple[str, ...]:
    return tuple(f"{', '.join(doubt.unknowns)}: {doubt.obstacle.value}" for doubt in alternatives.doubts)


def _decimal(value: Number) -> Decimal:
    number = Decimal(repr(value)) if isinstance(value, float) else Decimal(value)
    if not number.is_finite():
        raise ValueError(f"{value} is not a finite number")
    return number
