"""Values, places and names as messages say them: in the program's unit, with the axes of its plane."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal
from enum import Enum
from functools import lru_cache

from contoursolve.diagnostics import Span
from contoursolve.gcode import FACT, Word, call
from contoursolve.geometry import Arc, CornerShape, Given, Layout, Length, Plane, Profile, Unit
from contoursolve.reading import ParsedContour
from contoursolve.solving import Status

LEAST_SHOWN = 0.00025
"""mm. Coordinates of a place that are nearer to zero are shown as zero, diameters, too."""

PROBABLY = "probably "
"""Leads the label of a word that the first fix of a finding changes."""

MOST_FIXES = 4
"""Fixes of one finding that are told, beside the choices among solutions."""

SHOWN = 60
"""Characters of a word or a list of words in a message; the listing shows the rest."""


def length_text(value: float, unit: Length, more: int = 0) -> str:
    """A length of so many mm in the program's unit, with so many decimals more than usual."""
    return value_text(value / 25.4 if unit is Length.INCH else value, unit.value, more)


def length_limit(value: float, unit: Length, way: int = 1) -> Decimal:
    """A length (mm) that is the largest (`way` 1) or the least one (-1) in the program's unit, as the shown decimals
    have it: not beyond the limit."""
    return inward(Decimal(repr(value)) / unit.in_mm, DECIMALS[unit.value], way)


def limit_text(limit: Decimal, unit: str) -> str:
    """A limit that is typed like that, in mm, inch or deg."""
    return f"{limit:f} {short_name(unit)}"


def inward(value: Decimal, decimals: int, way: int) -> Decimal:
    """An upper (`way` 1) or a lower limit (-1) rounded into its range."""
    return value.quantize(Decimal(1).scaleb(-decimals), ROUND_FLOOR if way > 0 else ROUND_CEILING)


DECIMALS = {Length.MM.value: 3, Length.INCH.value: 4, "deg": 3}
"""Decimals of a value in a message, by its unit; listings show one more."""


def angle_text(value: float, more: int = 0) -> str:
    """An angle in degrees, with so many decimals more than usual."""
    return value_text(value, "deg", more)


def value_text(value: float, unit: str, more: int = 0) -> str:
    """A value as its word has it, in mm, inch or deg, with so many decimals more than usual."""
    return f"{_number(value, DECIMALS[unit] + more)} {short_name(unit)}"


def number_text(value: float, kind: Unit, unit: Length) -> str:
    """A value in mm or degrees as a word of the program would have it: `12.` or `140.194`."""
    is_inch = kind is not Unit.DEGREE and unit is Length.INCH
    return (f"{value / 25.4:z.4f}" if is_inch else f"{value:z.3f}").rstrip("0")


def statement_text(given: Given, value: float, profile: Profile) -> str:
    """A word or a fact as it would be written with another value (mm, a diameter for what is one, or degrees), with
    its line where there are several."""
    number, word = number_text(value, given.unit, profile.unit), given.word
    if word is None or word.address == FACT:
        return f"{word.text.partition('=')[0].strip() if word else given.name} = {number}"
    lines = {each.word.span.line for each in profile.givens.values() if each.word}
    text = profile.blocks[0].syntax.words.spell(word.address, number)
    return f"{text} (program line {word.span.line})" if len(lines) > 1 else text


def meaning_of(name: str, word: Word, claim: ParsedContour) -> str:
    """The meaning of the word that states a given of a contour."""
    row = claim.lexicon.addresses.get(word.address)
    return claim.form.meanings.get(name) or (row.meaning if row else "")


def word_keys(words: Iterable[Word]) -> dict[Span, str]:
    """The key of each word of a contour by its place: its address, with the line where several have it."""
    ordered = sorted({word.span: word for word in words if word.address != FACT}.values(), key=lambda word: word.span)
    return {word.span: call(word, ordered) for word in ordered}


def by_line(texts: Iterable[tuple[str, int]]) -> str:
    """Words with their program lines, each line said once: `X30 (program line 2) and Y20 (program line 3)`."""
    lines: dict[int, dict[str, None]] = {}
    for text, line in texts:
        lines.setdefault(line, {})[text] = None
    return join([f"{join(list(own))} (program line {line})" for line, own in lines.items()])


def element_text(name: str) -> str:
    """An element in a sentence: `line 1`, `the arc`."""
    return f"the {name}" if name in ("arc", "line") else name


MOST_DECIMALS = 12
"""Decimals more than usual; beyond them, values differ by rounding alone."""


def tell_apart(values: Sequence[float], write: Callable[[float, int], str]) -> list[str]:
    """Values with as many decimals more than usual as it takes that no two different ones look the same."""
    for more in range(MOST_DECIMALS + 1):
        texts = [write(value, more) for value in values]
        if len({*texts}) == len({*values}):
            return texts
    return [write(value, 0) for value in values]


_PARTS = {"cos": "direction", "sin": "direction", "off": "place", "radius": "radius"}


def unknowns_text(names: Sequence[str], profile: Profile) -> str:
    """Unknown scalars in the user's words: `V1 (Z and X)`, `line 2 (direction)`."""
    parts = _things(names, profile)
    return join([f"{thing} ({join(list(shown))})" if shown else thing for thing, shown in parts.items()])


def _things(names: Sequence[str], profile: Profile) -> dict[str, dict[str, None]]:
    """The parts of each thing that unknown scalars are; none of what is a thing itself."""
    things: dict[str, dict[str, None]] = {}
    called, sized = _called(profile.layout), _shapes(profile.layout)
    for name in names:
        thing, _, part = name.rpartition(".")
        shown = profile.plane.axes[int(part)] if part.isdigit() else _PARTS.get(part, "")
        shapes = sized.get(thing, ())
        if part == "radius" and shapes and CornerShape.FILLET not in shapes:
            shown = "size"
        own = thing if shown else name
        things.setdefault(called.get(own, own), {}).update({shown: None} if shown else {})
    return things


@lru_cache(maxsize=64)
def _called(layout: Layout) -> Mapping[str, str]:
    """The names of unknowns that are called by what they belong to: the end, the radii of arcs, the centres of corners
    and the lines on which these land."""
    figure = layout.figure
    called = {"end": "the end"}
    called |= {arc.radius: f"the radius of {element_text(arc.name)}" for arc in figure.path if isinstance(arc, Arc)}
    called |= {f"{each.name}.center": f"the centre of {each.name}" for each in figure.corners}
    return called | {f"{each.name}.landing": f"the line on which {each.name} lands" for each in figure.corners}


@lru_cache(maxsize=64)
def _shapes(layout: Layout) -> Mapping[str, Set[CornerShape]]:
    """The shapes of each corner; several where words contradict each other."""
    found: dict[str, set[CornerShape]] = {}
    for corner in layout.figure.corners:
        found.setdefault(corner.name, set()).add(corner.shape)
    return found


def open_text(names: Sequence[str], profile: Profile) -> str:
    """That unknown scalars are still open: `V1 is still open in Z and X`, `the direction of line 2 is still open`."""
    parts = _things(names, profile)
    axes = {*profile.plane.axes}
    for thing, shown in parts.items() if len(parts) == 1 else ():
        if shown and {*shown} <= axes:
            return f"{thing} is still open in {join(list(shown))}"
    texts = [
        f"{thing} ({join(list(shown))})" if {*shown} <= axes else f"the {join(list(shown))} of {thing}"
        for thing, shown in parts.items()
        if shown
    ] + [thing for thing, shown in parts.items() if not shown]
    return f"{join(texts)} {'is' if len(texts) == 1 else 'are'} still open"


def place_text(profile: Profile, scalars: dict[str, float]) -> str:
    """Coordinates in the user's terms: `Z-10.000 X60.000` (mm or inches, X of a lathe as diameter)."""
    texts = []
    for name, value in sorted(scalars.items(), key=lambda item: item[0].partition(".")[2]):
        axis = int(name.partition(".")[2])
        # What is less than a place shows is zero there.
        shown = 0.0 if abs(value) < LEAST_SHOWN else value * (2 if profile.plane.diameters[axis] else 1)
        texts.append(f"{profile.plane.axes[axis]}{length_text(shown, profile.unit)}")
    return " ".join(texts)


NUMBERS = {1: "one", 2: "two", 3: "three", 4: "four"}
"""As a sentence has them; larger ones are written in digits."""


def join(texts: Sequence[str]) -> str:
    """Texts as a list in a sentence: `A, B and C`."""
    return " and ".join(filter(None, (", ".join(texts[:-1]), *texts[-1:])))


def either(texts: Sequence[str]) -> str:
    """Texts as a choice in a sentence: `A, B or C`."""
    return " or ".join(filter(None, (", ".join(texts[:-1]), *texts[-1:])))


def shorten(text: str) -> str:
    """A text for a message, cut where it is very long."""
    return text if len(text) <= SHOWN else text[: SHOWN - 4] + " ..."


def _number(value: float, decimals: int) -> str:
    smallest = 0.5 * 10.0**-decimals
    value += 0.0  # -0.0 is 0
    return f"{value:.{decimals}f}" if abs(value) >= smallest or value == 0 else f"{value:.1e}"


# As listings show them, with a decimal more than messages ----------------------------------------------------

_INCH = float(Length.INCH.in_mm)


def length_of(mm: float, unit: Length) -> str:
    """A length in the unit of a program: four decimals of a millimetre, five of an inch; no negative zero."""
    return f"{mm:z.4f}" if unit is Length.MM else f"{mm / _INCH:z.5f}"


def length_in(mm: float, unit: Length) -> str:
    """A length in the unit of a program, with that unit."""
    return f"{length_of(mm, unit)} {short_name(unit.value)}"


def written(value: float, unit: str) -> str:
    """A value as its word has it, with its unit (mm, inch or deg); decimals as for lengths."""
    return f"{Decimal(repr(round(value, 10))):z.{DECIMALS[unit] + 1}f} {short_name(unit)}"


def coordinate_texts(place: Sequence[float], plane: Plane, unit: Length) -> list[str]:
    """Coordinates (mm, X of a lathe as radius) as numbers of the program, one for each axis."""
    return [
        length_of(value * (2 if is_diameter else 1), unit)
        for value, is_diameter in zip(place, plane.diameters, strict=True)
    ]


def coordinates(place: Sequence[float | None], plane: Plane, unit: Length) -> str:
    """Coordinates (mm, X of a lathe as radius) as the control writes them; of a place with one coordinate, that one."""
    texts = coordinate_texts([value or 0.0 for value in place], plane, unit)
    shown = zip(plane.axes, place, texts, strict=True)
    return " ".join(f"{letter}{text}" for letter, value, text in shown if value is not None)


def measured(place: Sequence[float | None], plane: Plane, unit: Length) -> str:
    """Coordinates as the control writes them, with their unit."""
    return f"{coordinates(place, plane, unit)} {short_name(unit.value)}"


def axis_labels(plane: Plane, what: str = "dia") -> list[str]:
    """The axes, with what is said of one that is programmed as a diameter."""
    return [
        f"{axis} {what}" if is_diameter else axis for axis, is_diameter in zip(plane.axes, plane.diameters, strict=True)
    ]


def short_name(unit: str) -> str:
    """A unit as it stands behind a number."""
    return "in" if unit == "inch" else unit


def count(number: int, noun: str, several: str = "") -> str:
    """A number with its noun: `1 error`, `2 errors`."""
    return f"{number} {noun if number == 1 else several or noun + 's'}"


class ContourState(Enum):
    """The state of a contour, as a reader sees it: after a colon. What is to be done differs between them, and between
    statuses of one state as its findings say."""

    SOLVED = "solved"
    NOT_DECIDED = "not decided"
    NOT_ENOUGH = "not enough given"
    CANNOT_BE_CUT = "cannot be cut"


_STATES = {
    Status.SOLVED: ContourState.SOLVED,
    Status.OVERDETERMINED: ContourState.SOLVED,
    Status.UNDECIDED: ContourState.NOT_DECIDED,
    Status.UNDERDETERMINED: ContourState.NOT_ENOUGH,
    Status.AMBIGUOUS: ContourState.NOT_ENOUGH,
    Status.REJECTED: ContourState.CANNOT_BE_CUT,
    Status.CONFLICTING: ContourState.CANNOT_BE_CUT,
    Status.NO_SOLUTION: ContourState.CANNOT_BE_CUT,
}


def state_of(status: Status | str, *, has_path: bool = True) -> ContourState:
    """The state that a status, or its value in a record, stands for. Words may repeat others in a contour that has no
    path for another reason."""
    state = _STATES[Status(status)]
    return ContourState.CANNOT_BE_CUT if state is ContourState.SOLVED and not has_path else state


def status_text(status: Status | str) -> str:
    """A status, or its value in a record, as a reader sees it: after a colon."""
    return state_of(status).value


def states_in(statuses: Mapping[Status, int]) -> dict[ContourState, int]:
    """The number of contours in each state, the best first, of those with each status."""
    numbers = Counter[ContourState]()
    for status, number in statuses.items():
        numbers[state_of(status)] += number
    return {state: numbers[state] for state in ContourState if numbers[state]}


def statuses_text(statuses: Mapping[Status, int]) -> str:
    """The number of contours in each state, the best first."""
    return ", ".join(f"{number:,} {state.value}" for state, number in states_in(statuses).items())
