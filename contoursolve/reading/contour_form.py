"""A contour form as tables: its points, the facts that words state, its path; and settings and assumptions."""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from functools import lru_cache
from itertools import product
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Evidence, Source, hash_of
from contoursolve.geometry import (
    Arc,
    BlockRole,
    Corner,
    CornerShape,
    Distance,
    Extent,
    Fact,
    Figure,
    Layout,
    Line,
    carry,
    names_of_roles,
)
from contoursolve.reading.rules import Condition, Stated


@dataclass(frozen=True, slots=True)
class Setting:
    """One convention: what it decides, its values with what each means, the one in force unless told otherwise,
    and why.

    The value of one with `bounds` is a number between them, both in `unit`, and its values are the default one alone; a
    number of blocks is a whole one. So they are where `names` are its value: several with commas between them.
    """

    name: str
    meaning: str
    values: Mapping[str, str]
    default: str
    source: Source
    bounds: tuple[Decimal, Decimal] | None = None
    changes: Mapping[str, Callable[[Any], Any]] = field(default_factory=dict)
    """The changes of values that are about more than its contours: from the control to the control with it, by the
    value."""
    unit: str = "mm"
    """Of a number: `mm`, `deg` or `blocks`."""
    names: Callable[[Any, tuple[str, ...]], Any] | None = None
    """From the control and some names to the control with them."""

    def change(self, control: Any, value: str) -> Any:
        """The control with a value of it."""
        if self.names is not None and value != self.default:
            return self.names(control, tuple(value.upper().split(",")))
        return self.changes[value](control) if value in self.changes else control

    def choices(self, value: str) -> str:
        """The values that it can have, if it cannot have this one; else empty."""
        if self.names is not None:
            is_one = value == self.default or _NAMES.fullmatch(value) is not None
            return "" if is_one else f"it is {self.default}, or names with commas between them, such as CLAMP,V9"
        if self.bounds is None:
            return "" if value in self.values else f"values are: {', '.join(self.values)}"
        least, most = self.bounds
        pattern = _WHOLE if self.unit == "blocks" else _NUMBER
        is_number = pattern.fullmatch(value) is not None
        return (
            ""
            if is_number and least <= Decimal(value) <= most
            else f"it is a number from {least} to {most} {self.unit}"
        )

    def meaning_of(self, value: str) -> str:
        """The meaning of a value."""
        if value in self.values and self.bounds is None:
            return self.values[value]
        return f"{self.meaning}: {value}{'' if self.names else f' {self.unit}'}"


_WHOLE = re.compile(r"\d{1,9}", re.ASCII)
_NAMES = re.compile(r"#?[A-Za-z_]\w*(?:,#?[A-Za-z_]\w*)*", re.ASCII)
_NUMBER = re.compile(r"\d{1,9}(\.\d{0,9})?|\.\d{1,9}", re.ASCII)


@dataclass(frozen=True, slots=True)
class Convention:
    """A setting with the value that was used."""

    setting: Setting
    value: str

    @property
    def meaning(self) -> str:
        """The meaning of the value."""
        return self.setting.meaning_of(self.value)

    @property
    def evidence(self) -> Evidence:
        """The grade of the knowledge that the control means this: of another value than the default one, not at all."""
        return self.setting.source.evidence if self.value == self.setting.default else Evidence.ASSUMED


AT_ITS_LIMIT = "@at its limit"
"""The circumstance that a 45 degree bevel begins or ends at its virtual intersection."""


@dataclass(frozen=True, slots=True)
class Assumption:
    """A thing that a control is taken to accept, or to mean, although no page that we have says so.

    `meaning` is half a sentence without a full stop. A contour rests on it where `when` holds for what the blocks of
    one of its `roles` state: values and circumstances by name, and in a form of one block every address.
    """

    name: str
    meaning: str
    source: Source
    roles: tuple[str, ...]
    when: Condition

    def __hash__(self) -> int:
        return hash(self.name)

    def carries(self, roles: Iterable[BlockRole], stated: Stated) -> bool:
        """Whether a contour of these roles, which states this, rests on it."""
        own = [role for role in roles if role.name in self.roles]
        return any(
            self.when.holds({call: stated[name] for call, name in names.items()})
            for _, names in (names_of_roles(own, stated) if own else ())
        )


class Premises(Struct, frozen=True):
    """The ground on which contours rest beside their words: settings with the values that were used, and what the
    control is taken to accept. `control` is the one whose settings these are, empty where it is told elsewhere."""

    conventions: tuple[Convention, ...] = ()
    assumptions: tuple[Assumption, ...] = ()
    control: str = ""

    __hash__ = hash_of


def join_premises(several: Iterable[Premises], control: str) -> Premises:
    """The premises of several contours of a control, each once."""
    every = tuple(several)
    return Premises(
        tuple({(each.setting.name, each.value): each for one in every for each in one.conventions}.values()),
        tuple(dict.fromkeys(each for one in every for each in one.assumptions)),
        control,
    )


@dataclass(frozen=True, slots=True)
class FactRow:
    """A fact, and the givens that must be stated for it to hold."""

    fact: Fact
    needs: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class CornerRow:
    """A corner, the shape that each word gives it, and what it lands on if the path ends there: an axis-parallel
    line, with the givens that tell which axis that is parallel to, or a line of the form beside the path."""

    name: str
    at: str
    before: str
    after: str | None
    shapes: Mapping[str, CornerShape]
    landing: tuple[tuple[tuple[str, ...], int], ...] = ()
    lands_on: str | None = None


@dataclass(frozen=True, slots=True)
class Sample:
    """A program that states a contour of a form, for tables of its words: `before` leads to the start point,
    and each word in braces in `blocks` may be left out."""

    before: str
    blocks: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Outline:
    """The drawing of a form: its points, the facts that words state about them, its path and its corners.

    `points` and `radii` are unknown as soon as some fact mentions them. `facts` are in order of precedence: where words
    say too much, the first ones are solved for. `intersections` are the points that the control computes; `lines` are
    lines of given direction beside the path.
    """

    start: str
    points: tuple[str, ...]
    radii: tuple[str, ...]
    facts: tuple[FactRow, ...]
    path: tuple[Line | Arc, ...]
    corners: tuple[CornerRow, ...]
    intersections: tuple[str, ...]
    lines: tuple[Line, ...] = ()
    guard: float = 0.0
    """Sine of the change of direction up to which the control makes no corner."""
    refuses: bool = False
    """Whether it refuses such a corner; else it leaves it out."""

    @property
    def shapes(self) -> dict[str, CornerShape]:
        """The names of words that give corners a size, each with its shape."""
        return {name: shape for row in self.corners for name, shape in row.shapes.items()}


@dataclass(frozen=True, slots=True)
class WordTable:
    """The combinations of words that a form may be stated by, and a program with all of them.

    `combinations` are slots, each with the sets of givens that may fill it: their product is every combination of words
    that the equations can tell apart.
    """

    combinations: tuple[tuple[tuple[str, ...], ...], ...]
    sample: Sample | None = None


@dataclass(frozen=True, slots=True)
class FreeFactWords:
    """The words of a form whose facts may be of any kind, as they complete, choose and correct it."""

    usual: tuple[str, ...] = ()
    """The words that a block may get, those first that a drawing usually has."""
    picking: str = ""
    """The word that chooses one of several solutions by its number, in a block of its own behind that of its element;
    empty if there is none."""
    companions: Mapping[str, str] = field(default_factory=dict)
    """Givens whose words are read together with the word of another one, which states nothing by itself."""
    poles: tuple[str, ...] = ()
    """The points from which polar data count."""


@dataclass(frozen=True, slots=True)
class ContourForm:
    """One way of describing a contour.

    `roles` tells which rules its blocks obey; `allowed` are the addresses that may stand in its blocks.
    """

    name: str
    title: str
    roles: tuple[BlockRole, ...]
    outline: Outline
    allowed: frozenset[str]
    table: WordTable
    choices: tuple[str, ...] = ()
    """Givens whose sign alone chooses between two solutions."""
    meanings: Mapping[str, str] = field(default_factory=dict)
    """The meaning of a given in this form, where its address does not say it."""
    is_literal: bool = False
    """Whether each word states one value, whatever the values are."""
    is_contour: bool = True
    """False for what a control calculates nothing for: it is checked, and not listed."""
    needs_values: bool = True
    """Whether what is no contour is checked by its values, so that its start point must be known."""
    corner_note: str = ""
    """The action of the control at each corner that it inserts, half a sentence without a full stop."""
    assumptions: tuple[Assumption, ...] = ()
    """The assumptions on which its blocks may rest."""
    is_general: bool = False
    """Whether its facts may be of any kind, and no rule tells which of them make a contour."""
    free: FreeFactWords = field(default_factory=FreeFactWords)

    def __hash__(self) -> int:
        return hash(self.name)


def stated_sets(form: ContourForm) -> Iterator[frozenset[str]]:
    """Every combination of givens that a form may be stated by."""
    for choice in product(*form.table.combinations):
        yield frozenset(name for names in choice for name in names)


@lru_cache(maxsize=8192)
def lay_out(
    form: ContourForm, stated: frozenset[str], sharp: frozenset[str], asked: frozenset[str] = frozenset()
) -> Layout:
    """The layout that a form makes of the givens that are stated; a corner whose size is asked for is there, too.

    `sharp` are the corner words of value 0, which make no corner.
    """
    facts = tuple(row.fact for row in form.outline.facts if stated.issuperset(row.needs))
    if form.is_general:
        facts = tuple(_with_lengths(form.outline.path, facts))
    read = {name for fact in facts for name in fact.reads()}
    mentioned = read | {name.rpartition(".")[0] for name in read}
    stating = {fact.given for fact in facts}
    path: list[Line | Arc] = []
    for element in form.outline.path:
        if isinstance(element, Line):
            heading = element.heading if element.heading in stating else None
            toward = element.toward if element.toward in mentioned and heading is None else None
            path.append(replace(element, heading=heading, toward=toward))
        else:
            path.append(element)
    ends = {end for element in path for end in (element.tail, element.head)} - {form.outline.start}
    figure = Figure(
        form.outline.start,
        tuple(point for point in form.outline.points if point in mentioned or point in ends),
        tuple(radius for radius in form.outline.radii if radius in mentioned),
        tuple(path),
        tuple(corner for row in form.outline.corners for corner in _corners(form, row, stated, asked, sharp)),
        lines=tuple(line for line in form.outline.lines if line.heading is None or line.heading in stated),
    )
    if not form.is_general:
        return Layout(figure, facts)
    wanted = {name for row in form.outline.facts if row.fact.given in asked for name in row.fact.reads()}
    return Layout(*_with_carriers(figure, facts, mentioned | {name.rpartition(".")[0] for name in wanted}))


def _with_lengths(path: Iterable[Line | Arc], facts: tuple[Fact, ...]) -> Iterator[Fact]:
    """The facts; the length of a line along the direction that a word states, if one does. Where nothing else is said
    about the direction, it is the distance of the ends, which needs no unknowns for that."""
    stating = {fact.given for fact in facts}
    headed = {each.name for each in path if isinstance(each, Line) and each.heading in stating}
    told = Counter(line for fact in facts for line in {name.rpartition(".")[0] for name in fact.reads()})
    for fact in facts:
        if not isinstance(fact, Extent):
            yield fact
        elif fact.line in headed:
            yield replace(fact, is_headed=True)
        else:
            yield Distance(fact.given, fact.tail, fact.head) if told[fact.line] == 1 else fact


def _with_carriers(figure: Figure, facts: tuple[Fact, ...], mentioned: set[str]) -> tuple[Figure, tuple[Fact, ...]]:
    """The figure and its facts, with those that lines have whose direction facts speak about and no word states."""
    lines = [each for each in figure.path if isinstance(each, Line) and each.heading is None and each.name in mentioned]
    more = [fact for line in lines for fact in carry(line)]
    return replace(figure, carriers=tuple(line.name for line in lines)), (*more, *facts)


def _corners(
    form: ContourForm, row: CornerRow, stated: frozenset[str], asked: frozenset[str], sharp: frozenset[str]
) -> list[Corner]:
    """The corner of a row: none without its word, several if several words are stated."""
    told = [[axis for names, axis in row.landing if which & set(names)] for which in (stated, asked)]
    landing = told[0] or told[1]
    axis = landing[0] if len(landing) == 1 else None
    guard, least = (0.0, form.outline.guard) if form.outline.refuses else (form.outline.guard, 0.0)
    return [
        Corner(row.name, row.at, shape, word, row.before, row.after, axis, row.lands_on, guard, least)
        for word, shape in row.shapes.items()
        if (word in stated or word in asked) and word not in sharp
    ]
