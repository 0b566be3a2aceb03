"""The forms of a language: any number of blocks in a row that are solved together, composed of their elements."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

from msgspec import Struct

from contoursolve.controls.chain.language import (
    AIMED,
    CENTER_AT,
    LINE_LINE,
    NEGATIVE,
    POINT,
    SIGNED,
    TURN,
    WAY,
    Element,
    Joining,
    Language,
    pair_role,
)
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    BlockRole,
    Chord,
    Collinear,
    Coordinate,
    CornerShape,
    Heading,
    Line,
    Offset,
    Radius,
    TurnBetween,
    direction_at,
    make_smooth,
    make_tangent,
    put_on,
)
from contoursolve.reading import ContourForm, CornerRow, FactRow, Modes, Outline, WordTable

START = "S"

_ORDERS = (("first", FIRST), ("second", SECOND))


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


def compose(language: Language, elements: tuple[Element, ...], modes: Modes) -> ContourForm:
    """The form of blocks in a row with the settings of a control."""
    options = _Options(
        slack=modes.radius_difference,
        counts_from_origin=modes.arcs is not None and modes.arcs.counts_from_origin,
        counts_clockwise=language.meeting.counts_clockwise(modes),
        is_ray=language.angle.is_ray(modes),
        guard=language.corner.guard(modes),
        refuses=language.corner.refuses(modes),
        contact=language.meeting.contact(modes),
    )
    return _compose(language, elements, options)


def _shape(element: Element, names: Names) -> Line | Arc:
    """The line or circle that an element is part of."""
    if element.turn is None:
        return Line(names.element, names.tail, names.head)
    return Arc(names.element, names.tail, names.head, names.center, names.radius, element.turn)


class _Options(Struct, frozen=True):
    """The decisions of settings: by how much the radii at two points of an arc may differ, whether the words of a
    centre are its coordinates, whether the intersections of two circles count clockwise, whether lines must run as
    their angles say, how smooth a joint has no corner, by how much two circles may miss a contact, and whether a corner
    on such a joint is refused."""

    slack: float
    counts_from_origin: bool
    counts_clockwise: bool
    is_ray: bool
    guard: float
    contact: float
    refuses: bool


@lru_cache(maxsize=4096)
def _compose(language: Language, elements: tuple[Element, ...], options: _Options) -> ContourForm:
    names = names_of(elements)
    name = _form_name(elements)
    pairs = list(zip(pairwise(elements), pairwise(names), strict=True))
    meeting = [(pair_role(*blocks), each) for blocks, each in pairs if blocks[1].is_over]
    facts = (
        *_stated(language, elements, names, options),
        *_touching(language, elements, names),
        *_checked(elements, names, options.slack),
        *_met(elements, names, options),
    )
    arcs = [each for element, each in zip(elements, names, strict=True) if element.turn is not None]
    return ContourForm(
        name=name,
        title=language.titles[name],
        roles=(
            *(BlockRole(element.role, (each.prefix,)) for element, each in zip(elements, names, strict=True)),
            *(BlockRole(role, (first.prefix, second.prefix)) for role, (first, second) in meeting),
        ),
        outline=Outline(
            start=START,
            points=tuple(dict.fromkeys(point for each in names for point in (each.center, each.own, each.head))),
            radii=tuple(each.radius for each in arcs),
            facts=facts,
            path=tuple(
                _path(language, element, each, options, is_directed=is_directed)
                for element, each, is_directed in zip(elements, names, _directed(elements), strict=True)
            ),
            corners=tuple(
                CornerRow(
                    f"corner {number}",
                    first.head,
                    first.element,
                    second.element,
                    {f"{first.prefix}{word}": shape for word, shape in language.corner.shapes.items()},
                )
                for number, (first, second) in enumerate(pairwise(names), 1)
            ),
            intersections=tuple(each.head for each in names[:-1]),
            guard=options.guard,
            refuses=options.refuses,
        ),
        allowed=language.allowed,
        table=WordTable(
            combinations=tuple(
                _combinations(language, elements, number, each.prefix) for number, each in enumerate(names)
            ),
            sample=language.samples.get(elements),
        ),
        choices=tuple(
            f"{second.prefix}{language.meeting.selector}" for role, (_, second) in meeting if role != LINE_LINE
        ),
        meanings=dict(_meanings(language, elements, names)),
        corner_note=language.corner.note,
        assumptions=language.assumptions,
        is_contour=name != "arc",
    )


def forms_of(language: Language, modes: Modes) -> tuple[ContourForm, ...]:
    """A form of each kind, for tables."""
    return tuple(compose(language, elements, modes) for elements in language.samples)


def _form_name(elements: Sequence[Element]) -> str:
    if len(elements) == 1:
        return "line-angle" if elements[0].turn is None else "arc"
    if any(element.is_smooth for element in elements):
        return "tangent"
    if not any(element.is_over for element in elements):
        return "corners"
    return pair_role(*elements) if len(elements) == 2 else "chain"  # noqa: PLR2004 - a pair


def _directed(elements: Sequence[Element]) -> Iterator[bool]:
    """For each element, whether it touches the one before it or behind it: a line does so in the way in which it
    runs."""
    touching = [*(element.touches for element in elements), False]
    return (any(each) for each in pairwise(touching))


def _path(language: Language, element: Element, names: Names, options: _Options, *, is_directed: bool) -> Line | Arc:
    if element.turn is None:
        is_alone = language.angle.is_ray_alone and not (element.is_over or element.is_followed)
        toward = names.own if element.is_followed and not element.is_over else None
        if element.aim is not None:
            return Line(
                names.element, names.tail, names.head, names.prefix + WAY, toward, bool(language.meeting.picks), True
            )
        heading = (
            f"{names.prefix}{language.angle.address}"
            if (options.is_ray or is_directed or is_alone) and language.angle.address
            else None
        )
        return Line(names.element, names.tail, names.head, heading, toward, bool(language.meeting.picks))
    counts = options.counts_clockwise and element.is_over
    return Arc(names.element, names.tail, names.head, names.center, names.radius, element.turn, counts)


def _stated(
    language: Language, elements: Sequence[Element], names: Sequence[Names], options: _Options
) -> Iterator[FactRow]:
    """The facts that the blocks state, in the order in which they are believed."""
    previous: tuple[Element, Names] | None = None
    for element, each in zip(elements, names, strict=True):
        yield from _own_facts(language, element, each, previous[1].tail if previous else START, options)
        if element.is_smooth and previous and element.turn is not None:
            yield _smooth(*previous, element, each)
        previous = element, each
    for element, each, is_directed in zip(elements, names, _directed(elements), strict=True):
        if element.turn is not None:
            # That it passes a point where it touches another element follows from the contact.
            points = (each.tail, each.head)[is_directed and element.touches : 1 + element.is_followed - is_directed]
            for point in points:
                yield FactRow(put_on(_shape(element, each), point, slack=options.slack), ())


def _smooth(before: Element, first: Names, element: Element, second: Names) -> FactRow:
    """That an arc begins in the direction in which the element before it ends."""
    ways = [direction_at(_shape(*each), second.tail) for each in ((before, first), (element, second))]
    begin = Chord(first.tail, first.head) if before.turn is None else ways[0]
    name = second.prefix + TURN
    return FactRow(TurnBetween(name, begin, ways[1]), (name,))


def _touching(language: Language, elements: Sequence[Element], names: Sequence[Names]) -> Iterator[FactRow]:
    """The facts of elements that touch. Two circles of which both centres are known are taken as they are."""
    for (before, after), (first, second) in zip(pairwise(elements), pairwise(names), strict=True):
        if not after.touches:
            continue
        one, other = _shape(before, first), _shape(after, second)
        joint, needs = make_smooth(one, other, second.tail), tuple[str, ...]()
        if isinstance(one, Arc) and isinstance(other, Arc):
            tangent = make_tangent(one, other, -1 if one.turn is other.turn else 1)
            yield from (FactRow(tangent, (f"{each.prefix}R",)) for each in (first, second))
            joint = *joint, put_on(one, second.tail)
        else:
            line = first if before.turn is None else second
            needs = (line.prefix + language.angle.address,)
        yield from (FactRow(fact, needs) for fact in joint)


def _met(elements: Sequence[Element], names: Sequence[Names], options: _Options) -> Iterator[FactRow]:
    """That a contact lies on a circle: it follows, but where both circles are known without it."""
    for (before, after), (first, second) in zip(pairwise(elements), pairwise(names), strict=True):
        if after.touches:
            arc = _shape(before, first) if after.turn is None else _shape(after, second)
            slack = options.contact if before.turn is not None and after.turn is not None else options.slack
            yield FactRow(put_on(arc, second.tail, slack=slack), ())


def _checked(elements: Sequence[Element], names: Sequence[Names], slack: float) -> Iterator[FactRow]:
    """A point of a circle whose centre and radius may be known without it."""
    for element, each in zip(elements, names, strict=True):
        if element.turn is not None:
            needs = (each.prefix + POINT,) if element.is_followed and not element.is_over else ()
            yield FactRow(put_on(_shape(element, each), each.own, slack=slack), needs)


def _own_facts(language: Language, element: Element, names: Names, start: str, options: _Options) -> Iterator[FactRow]:
    """The facts that a block states; `start` is where the one before it begins."""
    q = names.prefix
    yield from _own_center(language, element, names, options)
    for order, axis in _ORDERS:
        yield FactRow(Coordinate(f"{q}{order}", names.own, axis), (f"{q}{order}",))
        if not element.is_over or language.meeting.joining is Joining.PAIRED:
            yield FactRow(Offset(f"{q}{order}-step", names.own, names.tail, axis), (f"{q}{order}-step",))
        elif language.meeting.closes_by_steps:
            yield FactRow(Offset(f"{q}{order}-step", names.own, start, axis), (f"{q}{order}-step",))
    if element.aim is not None:
        yield FactRow(Heading(q + WAY, names.tail, names.head), (q + WAY,))
    elif element.turn is None and language.angle.address:
        angle = f"{q}{language.angle.address}"
        if element.is_over:
            yield FactRow(Heading(angle, names.tail, names.own), (angle,))
            if element.is_followed:
                yield FactRow(Heading(angle, names.own, names.head), (angle,))
        else:
            yield FactRow(Heading(angle, names.tail, names.head), (angle,))
            if element.is_followed:
                yield FactRow(Heading(angle, names.tail, names.own), (angle, q + AIMED))
                yield FactRow(Collinear(names.tail, names.own, names.head), (q + POINT,))


def _own_center(language: Language, element: Element, names: Names, options: _Options) -> Iterator[FactRow]:
    """The facts that the block of an arc states of its centre and radius."""
    if element.turn is None:
        return
    q = names.prefix
    for order, axis in _ORDERS:
        given = f"{q}center-{order}"
        if element.is_over and language.meeting.joining is Joining.OVER_DEFINED:
            yield FactRow(Coordinate(given, names.center, axis), (given,))
            continue
        if options.counts_from_origin and not element.is_over:
            yield FactRow(Coordinate(given, names.center, axis), (given,))
            continue
        origin = names.head if element.is_over else names.tail
        yield FactRow(Offset(given, names.center, origin, axis), (given,))
    for given, (_, axis) in zip(CENTER_AT, _ORDERS, strict=True) if language.arc.centers else ():
        yield FactRow(Coordinate(q + given, names.center, axis), (q + given,))
    yield FactRow(Radius(f"{q}R", names.radius), (f"{q}R",))


def _combinations(
    language: Language, elements: Sequence[Element], number: int, prefix: str
) -> tuple[tuple[str, ...], ...]:
    """The names that a block may state, as far as the equations tell it apart."""
    element = elements[number]
    if language.meeting.joining is Joining.PAIRED and (element.is_over or element.is_followed):
        other = elements[number - 1 if element.is_over else number + 1]
        centers, radius = ("center-first", "center-second"), ("R",)
        shapes: tuple[tuple[str, ...], ...] = ((language.angle.address,),)
        if element.turn is not None:
            is_touching = element.touches or other.touches
            at = (CENTER_AT,) if language.arc.centers and element.is_followed else ()
            shapes = (centers, *at) if not is_touching else (radius,) if other.turn is None else (centers, radius)
        place = ("first", "second") if element.is_over else ()
        return tuple(tuple(prefix + name for name in (*place, *shape)) for shape in shapes)
    point = (POINT,) if element.is_followed and not element.is_over else ()

    def ways(order: str) -> tuple[str, ...]:
        return (order, f"{order}-step") if not element.is_over or language.meeting.closes_by_steps else (order,)

    ends = tuple((first, second, *point) for first in ways("first") for second in ways("second"))
    options: tuple[tuple[str, ...], ...]
    if element.aim is not None:
        options = tuple((name, WAY) for name in ways(_ORDERS[element.aim][0]))
    elif element.turn is None:
        angle = language.angle.address
        one = ((name, angle) for order, _ in _ORDERS for name in ways(order))
        aimed = (AIMED,) if element.is_followed else ()
        options = (*ends, (angle,), *((*ways, *aimed) for ways in one)) if angle else ends
        if element.is_over:
            options = tuple((first, second, angle) for first in ways("first") for second in ways("second"))
    elif element.is_over:
        options = (("center-first", "center-second", "R", "first", "second"),)
    elif element.is_smooth:
        options = tuple((*end, TURN) for end in ends)
    else:
        centers = ("center-first", "center-second")
        options = (*((*end, *more) for end in ends for more in (centers, ("R",))), *((centers,) if point else ()))
    return tuple(tuple(prefix + name for name in option) for option in options)


def _meanings(language: Language, elements: Sequence[Element], names: Sequence[Names]) -> Iterator[tuple[str, str]]:
    for element, each in zip(elements, names, strict=True):
        thing = "line" if element.turn is None else "circle"
        numbered = each.element if each.element[-1].isdigit() else f"the {each.element}"
        what = f"a point of the {thing}" if element.is_followed else f"end of {numbered}"
        for order, _ in _ORDERS:
            yield f"{each.prefix}{order}", what + (", absolute" if element.is_over else "")
            yield f"{each.prefix}{order}-step", what + ", from the start point"
            if element.is_over:
                is_from_end = language.meeting.joining is not Joining.OVER_DEFINED
                yield f"{each.prefix}center-{order}", f"centre, {'from where it ends' if is_from_end else 'absolute'}"
        if element.turn is not None and element.is_over:
            yield f"{each.prefix}R", "radius"
    for name in (name for name in language.corner.shapes if name.startswith(SIGNED)):
        what = "rounding" if language.corner.shapes[name] is CornerShape.FILLET else "chamfer"
        told = f"{what} before a line along the other axis; its sign tells which way that runs"
        yield from ((each.prefix + name, told) for each in names)
    for name, shape in language.corner.negative.items():
        told = f"{'rounding' if shape is CornerShape.FILLET else 'chamfer'}, of a negative number"
        yield from ((each.prefix + NEGATIVE + name, told) for each in names)
    if language.corner.codes:
        # The word that states the size in a block of its own has another meaning elsewhere.
        rows = language.lexicon.addresses
        yield from ((each.prefix + word, rows[word].meaning) for each in names for word in language.corner.words)
    for (before, after), (_, each) in zip(pairwise(elements), pairwise(names), strict=True):
        if after.is_over and language.meeting.selector:
            yield f"{each.prefix}{language.meeting.selector}", language.meeting.selects[pair_role(before, after)]
