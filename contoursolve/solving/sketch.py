"""The arguments of a sketch's calls: names that facts can mention, and numbers; what is none is refused by name."""

import re
from collections.abc import Iterable, Mapping
from copy import deepcopy
from decimal import Decimal, InvalidOperation
from numbers import Integral, Real
from types import MappingProxyType
from typing import Any

from contoursolve.diagnostics import Shown, from_above
from contoursolve.gcode import read_directive
from contoursolve.geometry import (
    ANGLES,
    Arc,
    Circle,
    Draft,
    Fact,
    Figure,
    GrammarError,
    Length,
    Line,
    Plane,
    PointIs,
    Profile,
    RadiusIs,
    Start,
    Statement,
    StatementError,
    Touches,
    Turn,
    Unit,
    Vocabulary,
    assemble,
    put_on,
    rank,
    read_statement,
    word_of,
)
from contoursolve.solving.alternatives import decide, find_alternatives
from contoursolve.solving.contour import trace
from contoursolve.solving.determinacy import analyse
from contoursolve.solving.drawn import Asked, Drawing, Drawings, Stated, worded
from contoursolve.solving.events import RefusalKind, Status
from contoursolve.solving.numbers import lookup, scalars_of
from contoursolve.solving.solution import Alternative, Alternatives
from contoursolve.tolerance import LARGEST

Number = Decimal | float | int | str
"""A value in mm or degrees; a float is taken as the decimal that Python prints for it."""

Place = tuple[Decimal, Decimal]

PLANE = Plane("", ("X", "Y"), ("I", "J"))
"""The axes of every sketch."""

_INTERNAL = re.compile(r"fact \d+", re.IGNORECASE)
"""The names of facts among the givens."""


def checked_element(call: str, name: str, taken: Iterable[str]) -> str:
    """A name for a new element. Raises ValueError if it cannot be one, or is taken."""
    _check_text(call, "the name", name)
    words = Vocabulary((name,), (), PLANE, Length.MM)
    try:
        is_clear = read_statement(f"radius of {name} = 1", words) == RadiusIs(name, Decimal(1))
        is_clear &= read_statement(f"{name} tangent to {name}", words) == Touches(name, name)
    except GrammarError:
        is_clear = False
    if not is_clear or _INTERNAL.fullmatch(name):
        raise ValueError(f"{call}: no fact could mention an element of the name {name!r}; choose another one")
    _check_free(call, "an element", name, taken)
    return name


def checked_point(call: str, name: str, taken: Iterable[str]) -> str:
    """A name for a new point. Raises ValueError if it cannot be one, or is taken."""
    _check_text(call, "the name of a point", name)
    try:
        is_clear = read_statement(f"X of {name} = 1", Vocabulary((), (name,), PLANE, Length.MM)) == PointIs(
            "", name, 0, Decimal(1)
        )
    except GrammarError:
        is_clear = False
    if not is_clear or _INTERNAL.fullmatch(name):
        raise ValueError(f"{call}: no fact could mention a point of the name {name!r}; choose another one")
    _check_free(call, "a point", name, taken)
    return name


def _check_text(call: str, what: str, name: object) -> None:
    if not isinstance(name, str) or not name.strip():
        raise ValueError(f"{call}: {what} is a text, not {name!r}")
    if "." in name:
        raise ValueError(
            f"{call}: {name!r} has a dot, as the names have that a sketch gives (`k.center`); leave it out"
        )


def _check_free(call: str, what: str, name: str, taken: Iterable[str]) -> None:
    same = next((each for each in taken if each.lower() == name.lower()), None)
    if same is not None:
        as_well = "" if same == name else f" ({same!r}: capitals do not matter)"
        raise ValueError(f"{call}: there is {what} of the name {name!r} already{as_well}; choose another one")


def checked_place(call: str, what: str, place: object) -> Place:
    """A pair of coordinates, mm. Raises ValueError if it is none."""
    if not isinstance(place, tuple | list) or len(place) != 2:  # noqa: PLR2004 - the plane has two axes
        raise ValueError(f"{call}: {what} is a pair of numbers such as (10, 20), not {place!r}")
    return checked_number(call, f"X of {what}", place[0]), checked_number(call, f"Y of {what}", place[1])


def checked_number(call: str, what: str, value: object) -> Decimal:
    """A number. Raises ValueError if it is none, is not finite, or is larger than any drawing."""
    try:
        number = _decimal(value)
    except InvalidOperation:
        number = None
    if number is None:
        raise ValueError(f"{call}: {what} is a number, not {value!r}")
    if not number.is_finite():
        raise ValueError(f"{call}: {what} is a finite number, not {value!r}")
    if abs(number) > Decimal(LARGEST):
        raise ValueError(f"{call}: {what} is {value!r}; the largest number that is read is {LARGEST:.0f}")
    return number


def _decimal(value: object) -> Decimal | None:
    """Raises InvalidOperation for a text that is no number."""
    if isinstance(value, bool):
        return None
    if isinstance(value, Decimal | str):
        return Decimal(value)
    if isinstance(value, Integral):
        return Decimal(int(value))
    return Decimal(repr(float(value))) if isinstance(value, Real) else None


Questions = Mapping[str, tuple[Fact, Unit]]
"""The questions, by the name of the fact."""


class Sketch(Shown):
    """A drawing under construction, in the axes X and Y. Lines and arcs make one path, in the order in which they
    are added; circles and infinite lines stand beside it. In a notebook it shows every way to draw it.

    Every call raises ValueError for an argument that makes no sense, and names it. A name is a text without dots
    that no other element (or point) has; capitals do not matter. A fact is read when the sketch is solved: it may
    mention what is added later.
    """

    def __init__(self, start: tuple[Number, Number] = (0, 0), *, name: str = "P0") -> None:
        """A sketch whose path begins at `start`, mm; `name` names this point."""
        self._start = Start(checked_place("Sketch", "start", start))
        self._here = self._first = checked_point("Sketch", name, ())
        self._path: list[Line | Arc] = []
        self._points: list[str] = []
        self._radii: list[str] = []
        self._facts: list[Fact] = []
        self._beside: list[tuple[str, Place | None, Decimal | None]] = []
        self._free_lines: list[Line] = []
        self._statements: dict[str, str | Statement] = {}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sketch) and vars(self) == vars(other)

    __hash__ = None  # type: ignore[assignment]  # it grows

    def line(self, name: str, to: str = "") -> None:
        """Add a line to the path; `to` names its end, P1, P2, ... otherwise. The name of the start closes the path:
        nothing can follow then."""
        call = f"line {name!r}"
        checked_element(call, name, self._names)
        tail, head = self._here, self._end(call, to)
        self._path.append(Line(name, tail, head))

    def arc(self, name: str, turn: str, to: str = "") -> None:
        """Add an arc to the path; `turn` is `cw` or `ccw`, `to` as for a line. Its centre is the point
        `name.center`."""
        call = f"arc {name!r}"
        checked_element(call, name, self._names)
        senses = [each.value for each in Turn]
        if turn not in senses:
            raise ValueError(f"{call}: turn is {' or '.join(senses)}, not {turn!r}")
        tail, head = self._here, self._end(call, to)
        center, radius = f"{name}.center", f"{name}.radius"
        arc = Arc(name, tail, head, center, radius, Turn(turn))
        self._path.append(arc)
        self._points.append(center)
        self._radii.append(radius)
        self._facts += [put_on(arc, end) for end in (tail, head)]

    def circle(self, name: str, center: tuple[Number, Number] | None = None, radius: Number | None = None) -> None:
        """Add a circle beside the path: given, if both its centre and its radius are, else unknown."""
        call = f"circle {name!r}"
        checked_element(call, name, self._names)
        if (center is None) != (radius is None):
            raise ValueError(f"{call}: give both center and radius, or neither and state facts about it")
        place = None if center is None else checked_place(call, "center", center)
        size = None if radius is None else checked_number(call, "radius", radius)
        if size is not None and size <= 0:
            raise ValueError(f"{call}: radius is larger than 0, not {radius!r}; a circle may pass through a place")
        self._beside.append((name, place, size))

    def infinite_line(self, name: str) -> None:
        """Add a whole line beside the path, to be found by facts; it is taken to run to the right, or upwards."""
        checked_element(f"infinite_line {name!r}", name, self._names)
        self._free_lines.append(Line(name, "", ""))

    def state(self, fact: str | Statement) -> None:
        """State a fact, as text (see `contoursolve facts`; the axes are X and Y) or as a statement. One with `?`, or
        with None for its value, asks for it."""
        if not (isinstance(fact, str) and fact.strip()) and not hasattr(fact, "state"):
            raise ValueError(f"state: a fact is a text or a statement, not {fact!r}")
        last = next(reversed(self._statements), "fact 0")
        self._statements[f"fact {int(last.removeprefix('fact ')) + 1}"] = fact

    @property
    def facts(self) -> Mapping[str, str | Statement]:
        """Its facts by name: `fact 1`, `fact 2` and so on."""
        return MappingProxyType(self._statements)

    def with_facts(self, facts: Mapping[str, str | Statement]) -> "Sketch":
        """The same lines, arcs and circles, of which this is stated in place of its own facts, by names as in
        `facts`."""
        found = deepcopy(self)
        found._statements = {}
        for name, fact in facts.items():
            if not _INTERNAL.fullmatch(name):
                raise ValueError(f"with_facts: the names of facts are `fact 1`, `fact 2` and so on, not {name!r}")
            found.state(fact)
            found._statements[name.lower()] = found._statements.popitem()[1]
        return found

    def system(self) -> Any:
        """Its equations, an `EquationSystem`. Facts are their words, by what they give the value of:
        `sketch.system().subs({"length of a": 30})`. Raises as `profile`."""
        return from_above("sketch_system", self)

    @property
    def _names(self) -> list[str]:
        """The names of all elements."""
        beside = [name for name, _, _ in self._beside]
        return [*(each.name for each in self._path), *beside, *(each.name for each in self._free_lines)]

    def profile(self) -> Profile:
        """The sketch as a profile. Raises GrammarError or StatementError (both are ValueErrors) for a fact that makes
        no sense, and names it."""
        return self._stated()[0]

    def _stated(self) -> tuple[Profile, Questions]:
        """The sketch as a profile, and what is asked for."""
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
        elements = (*draft.figure.path, *draft.figure.lines, *draft.figure.circles)
        words = Vocabulary([each.name for each in elements], (self._first, *self._points), PLANE, Length.MM)
        read = [(name, _read(name, fact, words)) for name, fact in self._statements.items()]
        questions: dict[str, tuple[Fact, Unit]] = {}
        for name, statement in sorted(read, key=lambda each: rank(each[1])):
            text = str(self._statements[name])
            draft.word = word_of(read_directive(text, -int(name.removeprefix("fact "))))
            try:
                fact = statement.state(draft, name)
            except StatementError as error:
                raise StatementError(f"{name} `{text}`: {error}") from None
            if name not in draft.givens and fact.given == name:
                questions[name] = fact, Unit.DEGREE if isinstance(statement, ANGLES) else Unit.MM
        draft.word = None
        for line in self._free_lines:
            draft.line(line.name)
        profile = Profile(
            form="sketch",
            blocks=(),
            plane=PLANE,
            unit=Length.MM,
            layout=draft.layout(),
            start=self._start,
            givens=draft.givens,
            intersections=(),
            is_extended=True,
        )
        return profile, {name: questions[name] for name in self._statements if name in questions}

    def solve(self) -> Drawings:
        """Every way to draw the sketch. Raises ValueError for one without elements, and GrammarError or StatementError
        as `profile`."""
        if not (self._path or self._beside or self._free_lines):
            raise ValueError("the sketch is empty; add a line, an arc or a circle")
        profile, questions = self._stated()
        texts = {name: str(fact) for name, fact in self._statements.items()}
        stated = Stated(profile, texts, questions)
        system = assemble(profile)
        verdict = analyse(system)
        numbers = [fact.given.removeprefix("fact ") for fact in (system.facts[index] for index in verdict.tied)]
        ties = tuple(sorted({int(number) - 1 for number in numbers if number.isdigit()}))
        if not verdict.is_determined:
            return Drawings(Status.UNDERDETERMINED, (), False, (), None, verdict.free, ties, stated)
        alternatives = find_alternatives(profile)
        items = [item for item in alternatives.items if item.is_path]
        return Drawings(
            status=decide(alternatives, profile).status,
            drawings=tuple(_drawn(item, stated) for item in items),
            is_complete=alternatives.is_complete and not _far(alternatives),
            doubts=(*_doubts(alternatives), *_far(alternatives)),
            reach=alternatives.reach,
            free=(),
            ties=ties,
            stated=stated,
        )

    def _end(self, call: str, to: str) -> str:
        """The end of a new element of the path, which becomes where the path is."""
        if self._path and self._here == self._first:
            raise ValueError(f"{call}: the path is closed at its start {self._first}; nothing can follow")
        if isinstance(to, str) and to.lower() == self._first.lower():
            if not self._path:
                raise ValueError(f"{call}: an element from {self._first} to {self._first} has no length; use circle()")
            self._here = self._first
            return self._first
        end = checked_point(call, f"P{len(self._path) + 1}" if to == "" else to, (self._first, *self._points))
        self._points.append(end)
        self._here = end
        return end


def _read(name: str, fact: str | Statement, words: Vocabulary) -> Statement:
    if not isinstance(fact, str):
        return fact
    try:
        return read_statement(fact, words)
    except GrammarError as error:
        raise GrammarError(f"{name} `{fact}`: {error}", error.begin, error.end) from None


def _drawn(item: Alternative, stated: Stated) -> Drawing:
    profile, texts, solution = stated.profile, stated.texts, item.solution
    figure = profile.figure
    lines = {line: tuple(item.scalars[f"{line}.{part}"] for part in ("cos", "sin", "off")) for line in figure.carriers}
    at = lookup(profile, {**solution.scalars, **scalars_of(solution.points), **solution.radii})
    return Drawing(
        points={name: at for name, at in solution.points.items() if figure.path or name != figure.start},
        radii=dict(solution.radii),
        lines={name: (cosine, sine, offset) for name, (cosine, sine, offset) in lines.items()},
        contour=trace(profile, solution) if figure.path else None,
        certificate=item.certificate,
        name=worded(item.name, texts),
        asked=tuple(Asked(texts[name], unit, fact.implied(at)) for name, (fact, unit) in stated.questions.items()),
        stated=stated,
    )


def _doubts(alternatives: Alternatives) -> tuple[str, ...]:
    return tuple(f"{', '.join(doubt.unknowns)}: {doubt.obstacle.value}" for doubt in alternatives.doubts)


def _far(alternatives: Alternatives) -> list[str]:
    """The remark on drawings that are left out because they reach too far."""
    kinds = {refusal.kind for item in alternatives.items for refusal in item.solution.refusals}
    is_far = RefusalKind.OUT_OF_RANGE in kinds
    return [f"a drawing that reaches farther than {LARGEST:,.0f} mm is left out"] if is_far else []
