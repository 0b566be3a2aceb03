"""NCT chapter 16: the forms, composed of their elements: any number of blocks in a row that are solved together."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls.nct_99m.lexicon import (
    AIMED,
    ASSUMPTIONS,
    AXES,
    CHAMFER,
    CIRCLE_CIRCLE,
    CIRCLE_LINE,
    LINE_CIRCLE,
    LINE_LINE,
    POINT,
    ROUNDING,
    SINGLE_BLOCK,
    Element,
    pair_role,
)
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Collinear,
    Coordinate,
    CornerShape,
    Heading,
    Line,
    Offset,
    OnCircle,
    Radius,
    Role,
    Turn,
)
from contoursolve.reading import ContourForm, CornerRow, FactRow, Sample
from contoursolve.tolerance import RADIUS_DIFFERENCE

START = "S"

ALLOWED = frozenset({"N", "G", "F", "S", "T", "M", "D", "H", *AXES, "I", "J", "K", "R", ",A", ",C", ",R", "Q"})

_ORDERS = (("first", FIRST), ("second", SECOND))

_TITLES = {
    LINE_LINE: "linear-linear intersection",
    LINE_CIRCLE: "linear-circular intersection",
    CIRCLE_LINE: "circular-linear intersection",
    CIRCLE_CIRCLE: "circular-circular intersection",
    "line-angle": "line by its angle and one coordinate",
    "corners": "chamfers and roundings",
    "chain": "chain of intersections",
    "arc": "arc",
}


_SIGNS = {
    LINE_LINE: "chooses nothing",
    LINE_CIRCLE: "which intersection along the line before: negative the nearer, positive the farther",
    CIRCLE_LINE: "which intersection along the line: negative the nearer, positive the farther",
    CIRCLE_CIRCLE: "which intersection of the two circles",
}
"""What the sign of Q chooses."""


class Names(Struct, frozen=True):
    """The names of one element and of its points: where it begins, the point that its own coordinates state, where
    it ends, its centre and its radius."""

    prefix: str
    element: str
    tail: str
    own: str
    head: str
    center: str
    radius: str


def names_of(elements: Sequence[Element]) -> tuple[Names, ...]:
    """The names of all elements. Computed intersections are P1, P2, ..., other inner ends V1, V2, ...; N and the
    number of its block is a point that the block states."""
    joints, intersections = [START], 0
    for number, following in enumerate(elements[1:], 1):
        intersections += following.is_over
        joints.append(f"P{intersections}" if following.is_over else f"V{number - intersections}")
    joints.append(f"N{len(elements)}")
    found: list[Names] = []
    counts = {kind: sum((each.turn is None) is kind for each in elements) for kind in (True, False)}
    seen = {True: 0, False: 0}
    for number, element in enumerate(elements, 1):
        kind = element.turn is None
        seen[kind] += 1
        mark = str(seen[kind]) if counts[kind] > 1 else ""
        head = joints[number]
        found.append(
            Names(
                prefix=f"{number}:",
                element=f"{'line' if kind else 'arc'} {mark}".rstrip(),
                tail=joints[number - 1],
                own=f"N{number}" if element.is_followed else head,
                head=head,
                center=f"C{mark}",
                radius=f"r{mark}",
            )
        )
    return tuple(found)


@lru_cache(maxsize=4096)
def compose(elements: tuple[Element, ...], slack: float, *, counts_clockwise: bool) -> ContourForm:
    """The form of blocks in a row, where the radii at two points of an arc may differ by so much (mm), and where Q of
    two circles may count clockwise."""
    names = names_of(elements)
    name = _form_name(elements)
    pairs = list(zip(pairwise(elements), pairwise(names), strict=True))
    meeting = [(pair_role(*blocks), each) for blocks, each in pairs if blocks[1].is_over]
    facts = (*_stated(elements, names, slack), *_checked(elements, names, slack))
    arcs = [each for element, each in zip(elements, names, strict=True) if element.turn is not None]
    return ContourForm(
        name=name,
        title=_TITLES[name],
        roles=(
            *(Role(element.role, (each.prefix,)) for element, each in zip(elements, names, strict=True)),
            *(Role(role, (first.prefix, second.prefix)) for role, (first, second) in meeting),
        ),
        start=START,
        points=tuple(dict.fromkeys(point for each in names for point in (each.center, each.own, each.head))),
        radii=tuple(each.radius for each in arcs),
        facts=facts,
        path=tuple(
            _path(element, each, counts_clockwise=counts_clockwise)
            for element, each in zip(elements, names, strict=True)
        ),
        corners=tuple(
            CornerRow(
                f"corner {number}",
                first.head,
                first.element,
                second.element,
                {
                    f"{first.prefix}{CHAMFER}": CornerShape.CHAMFER_SETBACK,
                    f"{first.prefix}{ROUNDING}": CornerShape.FILLET,
                },
            )
            for number, (first, second) in enumerate(pairwise(names), 1)
        ),
        intersections=tuple(each.head for each in names[:-1]),
        allowed=ALLOWED,
        combinations=tuple(_combinations(element, each.prefix) for element, each in zip(elements, names, strict=True)),
        choices=tuple(f"{second.prefix}Q" for role, (_, second) in meeting if role != LINE_LINE),
        sample=_SAMPLES.get(elements),
        meanings=dict(_meanings(elements, names)),
        corner_note=SINGLE_BLOCK,
        assumptions=ASSUMPTIONS,
        is_contour=name != "arc",
    )


def _form_name(elements: Sequence[Element]) -> str:
    if len(elements) == 1:
        return "line-angle" if elements[0].turn is None else "arc"
    if not any(element.is_over for element in elements):
        return "corners"
    return pair_role(*elements) if len(elements) == 2 else "chain"  # noqa: PLR2004 - a pair


def _path(element: Element, names: Names, *, counts_clockwise: bool) -> Line | Arc:
    if element.turn is None:
        toward = names.own if element.is_followed and not element.is_over else None
        return Line(names.element, names.tail, names.head, f"{names.prefix},A", toward)
    counts = counts_clockwise and element.is_over
    return Arc(names.element, names.tail, names.head, names.center, names.radius, element.turn, counts)


def _stated(elements: Sequence[Element], names: Sequence[Names], slack: float) -> Iterator[FactRow]:
    """What the blocks state, in the order in which it is believed."""
    for element, each in zip(elements, names, strict=True):
        yield from _own_facts(element, each)
    for element, each in zip(elements, names, strict=True):
        if element.turn is not None:
            for point in (each.tail, each.head)[: 1 + element.is_followed]:
                yield FactRow(OnCircle(point, each.center, each.radius, slack=slack), ())


def _checked(elements: Sequence[Element], names: Sequence[Names], slack: float) -> Iterator[FactRow]:
    """A point of a circle whose centre and radius may be known without it."""
    for element, each in zip(elements, names, strict=True):
        if element.turn is not None:
            needs = (each.prefix + POINT,) if element.is_followed and not element.is_over else ()
            yield FactRow(OnCircle(each.own, each.center, each.radius, slack=slack), needs)


def _own_facts(element: Element, names: Names) -> Iterator[FactRow]:
    q = names.prefix
    if element.turn is not None:
        for order, axis in _ORDERS:
            given = f"{q}center-{order}"
            fact = (
                Coordinate(given, names.center, axis)
                if element.is_over
                else Offset(given, names.center, names.tail, axis)
            )
            yield FactRow(fact, (given,))
        yield FactRow(Radius(f"{q}R", names.radius), (f"{q}R",))
    for order, axis in _ORDERS:
        yield FactRow(Coordinate(f"{q}{order}", names.own, axis), (f"{q}{order}",))
        if not element.is_over:
            yield FactRow(Offset(f"{q}{order}-step", names.own, names.tail, axis), (f"{q}{order}-step",))
    if element.turn is None:
        angle = f"{q},A"
        if element.is_over:
            yield FactRow(Heading(angle, names.tail, names.own), (angle,))
            if element.is_followed:
                yield FactRow(Heading(angle, names.own, names.head), (angle,))
        else:
            yield FactRow(Heading(angle, names.tail, names.head), (angle,))
            if element.is_followed:
                yield FactRow(Heading(angle, names.tail, names.own), (angle, q + AIMED))
                yield FactRow(Collinear(names.tail, names.own, names.head), (q + POINT,))


def _combinations(element: Element, prefix: str) -> tuple[tuple[str, ...], ...]:
    """What a block may state, as far as the equations tell it apart."""
    point = (POINT,) if element.is_followed and not element.is_over else ()
    ends = tuple((first, second, *point) for first in _ways("first", element) for second in _ways("second", element))
    if element.turn is None:
        one = ((name, ",A") for order, _ in _ORDERS for name in _ways(order, element))
        aimed = (AIMED,) if element.is_followed else ()
        options = (*ends, (",A",), *((*ways, *aimed) for ways in one))
        if element.is_over:
            options = (("first", "second", ",A"),)
    elif element.is_over:
        options = (("center-first", "center-second", "R", "first", "second"),)
    else:
        centers = ("center-first", "center-second")
        options = (*((*end, *more) for end in ends for more in (centers, ("R",))), *((centers,) if point else ()))
    return tuple(tuple(prefix + name for name in option) for option in options)


def _ways(order: str, element: Element) -> tuple[str, ...]:
    return (order,) if element.is_over else (order, f"{order}-step")


def _meanings(elements: Sequence[Element], names: Sequence[Names]) -> Iterator[tuple[str, str]]:
    for element, each in zip(elements, names, strict=True):
        thing = "line" if element.turn is None else "circle"
        numbered = each.element if each.element[-1].isdigit() else f"the {each.element}"
        what = f"a point of the {thing}" if element.is_followed else f"end of {numbered}"
        for order, _ in _ORDERS:
            yield f"{each.prefix}{order}", what + (", absolute" if element.is_over else "")
            yield f"{each.prefix}{order}-step", what + ", from the start point"
            if element.is_over:
                yield f"{each.prefix}center-{order}", "centre, absolute"
        if element.turn is not None and element.is_over:
            yield f"{each.prefix}R", "radius"
    for (before, after), (_, each) in zip(pairwise(elements), pairwise(names), strict=True):
        if after.is_over:
            yield f"{each.prefix}Q", _SIGNS[pair_role(before, after)]


_LINE, _ARC = Element(None, False, False), Element(Turn.CCW, False, False)
_TO_LINE, _TO_ARC = replace(_LINE, is_followed=True), replace(_ARC, is_followed=True)
_OVER_LINE, _OVER_CIRCLE = replace(_LINE, is_over=True), replace(_ARC, is_over=True)
_FROM = "G17 G90 G41 G0 X50 Y0"

_N1_ARC = "G3 {X-50.0} {Y0} {I-50} {J0} {R50} {,C2} {,R2}"

_SAMPLES: dict[tuple[Element, ...], Sample] = {
    (_LINE,): Sample(_FROM, ("G1 {X90} {Y40.0} ,A45",)),
    (_LINE, _ARC): Sample(_FROM, ("G1 {X80} {Y0} {,A0} {,C2} ,R8", "G3 X50 {Y30} {I-30} {J0} {R30}")),
    (_TO_LINE, _OVER_LINE): Sample(
        "G17 G90 G41 G0 X90 Y10", ("G1 {X50} {Y33.094} {,A150} {,C2} {,R2}", "G1 X10 Y20 ,A225 {Q1}")
    ),
    (_TO_LINE, _OVER_CIRCLE): Sample(
        "G17 G90 G42 G0 X100 Y20", ("G1 {X-30} {Y-20} {,A197.103} {,C2} {,R2}", "G3 X20 Y40 I20 J-10 R50 {Q-1}")
    ),
    (_TO_ARC, _OVER_LINE): Sample(_FROM, (_N1_ARC, "G1 X-50 Y42.857 ,A171.87 {Q-1}")),
    (_TO_ARC, _OVER_CIRCLE): Sample(_FROM, (_N1_ARC, "G3 X-40 Y60 I-40 J20 R40 {Q-1}")),
    (_TO_LINE, replace(_OVER_LINE, is_followed=True), _OVER_CIRCLE): Sample(
        "G17 G90 G41 G0 X90 Y10",
        ("G1 {X50} {Y33.094} {,A150} {,R2}", "G1 X10 Y20 ,A225 {Q1.0} {,C2}", "G3 X-40 Y-20 I-20 J-20 R20 {Q1}"),
    ),
}
"""Programs for the tables of words, one for each kind of form."""

FORMS = tuple(compose(elements, RADIUS_DIFFERENCE, counts_clockwise=False) for elements in _SAMPLES)
