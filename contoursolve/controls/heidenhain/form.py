"""The form of a chain: all facts that its words may state, and the words that may be added."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

from msgspec.structs import replace

from contoursolve.controls.chain.language import TITLES
from contoursolve.controls.heidenhain.circumstances import FULL
from contoursolve.controls.heidenhain.elements import (
    ALONG,
    ARC,
    BESIDE,
    CORNERS,
    LINE,
    PLAIN,
    POINTS,
    POLAR,
    POLE,
    START,
    TANGENCY,
    Chain,
    FkElement,
    PlacedElement,
    facts_of,
    is_aimed,
    parallel_rows,
    point_rows,
)
from contoursolve.controls.heidenhain.lexicon import (
    BOOK,
    CHAMFER,
    FREE,
    IN_KLARTEXT,
    LEXICON,
    TANGENT,
    PlaneWords,
)
from contoursolve.geometry import (
    BlockRole,
    Coordinate,
    Line,
    put_on,
)
from contoursolve.reading import Assumption, ContourForm, CornerRow, FactRow, FreeFactWords, Outline, WordTable, some


def _aimed_by(chain: Chain, place: PlacedElement) -> tuple[str, ...]:
    """The words that state the direction in which an element begins."""
    if not is_aimed(chain, place):
        return ()
    before = chain.places[place.number - 2]
    if not before.element.is_ended:
        return (f"{place.prefix}AN",)
    return (f"{before.prefix}CCA", *([place.prefix + ALONG] if place.element.is_line else []))


def _rows(chain: Chain) -> Iterator[FactRow]:
    places, words, facts = chain.places, chain.words, facts_of(chain.words.axes)
    for pole in dict.fromkeys(place.element.pole for place in places if place.element.pole):
        for axis, letter in enumerate(words.axes):
            yield FactRow(Coordinate(f"{pole}:{letter}", pole, axis), (f"{pole}:{letter}",))
    for place in places:
        own = words.of_lines if place.element.is_line else words.of_arcs
        for word in (*own, "CLSD-", TANGENCY):
            given = place.prefix + word
            needs = (given, *((f"{place.element.pole}:{axis}") for axis in words.axes if word in POLAR))
            needs += tuple(name for name in _aimed_by(chain, place) if word == TANGENCY)
            if word not in POLAR or place.element.pole:
                yield from (FactRow(fact, needs) for fact in facts[word](chain, place, given))
        yield from point_rows(place, words.axes)
        yield from parallel_rows(chain, place)
        if place.element.is_line:
            continue
        after = places[place.number] if place.number < len(places) else None
        for point, is_met in ((place.tail, _is_met(chain, place, place)), (place.head, _is_met(chain, place, after))):
            if not is_met:
                yield FactRow(put_on(place.shape, point, slack=words.slack), ())


def _is_met(chain: Chain, arc: PlacedElement, second: PlacedElement | None) -> bool:
    """Whether that an arc passes its begin (`second` is itself) or its end follows from other facts: where a line
    touches it, or where its radius has a direction. Of an arc by its centre or radius and its end, all is known."""
    if arc.element.function not in (*FREE, *TANGENT):
        return False
    if arc.element.is_entered if second is arc else arc.element.is_ended:
        return True
    if second is None or second.number == 1 or second.element.function not in TANGENT:
        return False
    other = chain.places[second.number - 2] if second is arc else second
    if other is second and arc.element.is_placed:
        # Its end is where it is, and the line leaves it there.
        return False
    return other.element.is_line or is_aimed(chain, second)


def _heading(chain: Chain, place: PlacedElement) -> str | None:
    """The given that states the direction of a line, if one does."""
    if place.element.is_entered:
        return f"{place.prefix}AN"
    return place.prefix + ALONG if is_aimed(chain, place) else None


ASSUMPTIONS = tuple(
    Assumption(name, meaning, source, roles, some(*words))
    for name, meaning, source, roles, words in (
        ("chord", "LEN of an arc is its chord", BOOK.assumed("LEN"), (ARC,), ("LEN",)),
        ("end-angle", "CCA counts from +X, counter-clockwise", BOOK.assumed("CCA"), (ARC,), ("CCA",)),
        ("turn", "IAN counts counter-clockwise", BOOK.assumed("IAN"), (LINE, ARC), ("IAN",)),
        (
            "tangency",
            "FLT and FCT begin in the direction of travel of the element before",
            BOOK.assumed("tangential connection"),
            (LINE, ARC),
            (TANGENCY,),
        ),
        ("angle", "AN counts from +X, counter-clockwise", BOOK.derived("the printed programs"), (LINE, ARC), ("AN",)),
        ("sense", "DR+ is counter-clockwise", BOOK.derived("the printed programs"), (ARC,), ("DR",)),
        ("centre", "ICCX and ICCY count from where the arc begins", BOOK.assumed("centres"), (ARC,), ("ICCX", "ICCY")),
        (
            "full-circle",
            "C and CP that end where they begin are a full circle",
            BOOK.assumed("path functions"),
            (PLAIN,),
            (FULL,),
        ),
        ("parallel", "PAR says nothing of the direction of travel", BOOK.derived("FKEXAMP1"), (LINE,), ("PAR",)),
    )
)
"""The meanings that the control is taken to have, although no page that we have says so."""

_OF_DIRECTION = ("AN", "IAN")


def _has_direction(element: FkElement) -> bool:
    """Whether the direction of an arc is that of the element before it, which need not be said again."""
    return element.function in TANGENT and not element.is_line


@lru_cache(maxsize=2048)
def compose(
    elements: tuple[FkElement, ...],
    labels: tuple[str, ...],
    stated_poles: tuple[str, ...] = (),
    words: PlaneWords = IN_KLARTEXT,
) -> ContourForm:
    """The form of a chain: everything that its words may state; `labels` are the numbers of its blocks,
    `stated_poles` the poles that these state, though no word may count from one."""
    points = [START, *(f"P{label}" for label in labels)]
    named = zip(labels, elements, points, points[1:], strict=False)
    chain = Chain(tuple(PlacedElement(n, *each) for n, each in enumerate(named, 1)), words)
    places = chain.places
    rows = tuple(_rows(chain))
    headings = {each.name: _heading(chain, each) for each in places}
    shapes = [each.shape for each in places]
    path = tuple(replace(each, heading=headings[each.name]) if isinstance(each, Line) else each for each in shapes)
    poles = tuple(dict.fromkeys(each.element.pole for each in places if each.element.pole))
    beside = tuple(f"{each.prefix}{point}" for each in places for point in (*POINTS, BESIDE))
    arcs = [each for each in places if not each.element.is_line]
    radii = [name for row in rows for name in row.fact.reads() if name.endswith((" distance", " from", " to"))]
    name = _form_name(elements)
    return ContourForm(
        name=name,
        title=_TITLES[name],
        roles=(
            *(BlockRole(each.element.role, (each.prefix,)) for each in places),
            *(BlockRole(POLE, (f"{pole}:",)) for pole in dict.fromkeys((*poles, *stated_poles))),
        ),
        outline=Outline(
            start=START,
            points=(*points[1:], *(each.center for each in arcs), *poles, *beside),
            radii=tuple(dict.fromkeys((*(each.radius for each in arcs), *radii))),
            facts=rows,
            path=path,
            corners=tuple(
                CornerRow(
                    f"corner {first.label}",
                    first.head,
                    first.name,
                    second.name,
                    {first.prefix + word: shape for word, shape in {**CORNERS, CHAMFER: words.chamfer}.items()},
                )
                for first, second in pairwise(places)
            ),
            intersections=tuple(points[1:-1]),
        ),
        allowed=frozenset(LEXICON.addresses),
        table=WordTable(
            combinations=tuple(((),) for _ in places),
        ),
        assumptions=ASSUMPTIONS,
        is_general=True,
        free=FreeFactWords(
            usual=tuple(
                f"{each.prefix}{word}"
                for word in words.usual
                for each in places
                if each.element.function in FREE and not (word in _OF_DIRECTION and _has_direction(each.element))
            ),
            picking="FSELECT",
            companions=dict(_companions(chain)),
            poles=poles,
        ),
    )


_TITLES = {**TITLES, "free-contour": "free contour FK"}


def _form_name(elements: Sequence[FkElement]) -> str:
    """The name of the form: by its free elements, or else as other controls call conventional moves in a row."""
    if any(each.function in FREE for each in elements):
        return "free-contour"
    return "tangent" if any(each.function in TANGENT for each in elements) else "corners"


def _companions(chain: Chain) -> Iterator[tuple[str, str]]:
    """Words that say from where another one counts, or that repeat what its fact says already."""
    # What tells of which thing a distance of 0 is.
    partners = {"D": chain.words.beside[1], "DP": "PAR"}
    for place in chain.places:
        q = place.prefix
        yield from ((f"{q}I{name}", f"{q}R{name}") for name in chain.words.referred)
        yield from ((q + partners[name], q + name) for name in place.element.touching)
        if place.element.closes:
            yield f"{q}CLSD-", f"{place.element.closes}:CLSD+"
