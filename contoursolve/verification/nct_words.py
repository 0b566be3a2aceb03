"""NCT chapter 16 by its sheet: what the words of a contour's blocks say, element by element.

Points count from the start point: real is the plane's first axis, imaginary its second.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal, localcontext
from itertools import pairwise

from contoursolve.model import FIRST, SECOND, Arc, Turn
from contoursolve.reading import Claim
from contoursolve.tolerance import LENGTH, REGULAR, RESIDUAL
from contoursolve.verification.case import Case
from contoursolve.verification.course import Bend, Course, Shape
from contoursolve.verification.measure import ROUNDING, direction, unit
from contoursolve.verification.rails import LEFT, RIGHT, LooseError, Rail, Ray, Ring, UnmakeableError, leg, meet, off

ENDS = (("first", "first-step"), ("second", "second-step"))
"""What states a coordinate of an element, absolute and as an increment."""
CENTERS = ("center-first", "center-second")
CORNERS = {",C": Shape.SETBACK, ",R": Shape.ROUNDING}
POINT = "point"
"""Stated as soon as a block that ends in an intersection has a coordinate."""

_OVER = ("over-defined line", "over-defined circle")


@dataclass(frozen=True, slots=True)
class Element:
    """One block: its number, the names of its element, of its ends, of the point that its coordinates state, and of
    centre and radius; `turn` is None for a line.

    `is_over` tells that it begins in a computed intersection, `is_followed` that it ends in one.
    """

    number: int
    name: str
    tail: str
    head: str
    own: str
    center: str
    radius: str
    turn: Turn | None
    is_over: bool
    is_followed: bool

    def given(self, name: str) -> str:
        """The name of what its block states."""
        return f"{self.number}:{name}"


def elements_of(claim: Claim) -> tuple[Element, ...]:
    """The elements of a contour, one for each block."""
    roles = {role.prefixes[0]: role.name for role in claim.form.roles if len(role.prefixes) == 1}
    found = []
    for number, each in enumerate(claim.form.path, 1):
        is_followed = f"{number}:@followed" in claim.circumstances
        center, radius, turn = (each.center, each.radius, each.turn) if isinstance(each, Arc) else ("", "", None)
        found.append(
            Element(
                number=number,
                name=each.name,
                tail=each.tail,
                head=each.head,
                own=f"N{number}" if is_followed else each.head,
                center=center,
                radius=radius,
                turn=turn,
                is_over=roles.get(f"{number}:") in _OVER,
                is_followed=is_followed,
            )
        )
    return tuple(found)


def choosing_pairs(claim: Claim) -> list[tuple[Element, Element]]:
    """The neighbours that meet in a computed intersection and are not both lines."""
    return [each for each in pairwise(elements_of(claim)) if each[1].is_over and (each[0].turn or each[1].turn)]


def choosing(claim: Claim) -> tuple[str, ...]:
    """The givens whose sign chooses between two places, in the order of their blocks: Q of an intersection that is
    not of two lines, R of an ordinary arc."""
    names: list[str] = []
    before: Element | None = None
    for each in elements_of(claim):
        if each.is_over and before is not None and (each.turn is not None or before.turn is not None):
            names.append(each.given("Q"))
        if each.turn is not None and not each.is_over:
            names.append(each.given("R"))
        before = each
    return tuple(names)


def reads(claim: Claim) -> frozenset[str]:
    """The givens that are looked at."""
    names: set[str] = set()
    chosen = choosing(claim)
    for each in elements_of(claim):
        own = {name for pair in ENDS for name in pair} | ({",A"} if each.turn is None else {*CENTERS, "R"})
        names |= {each.given(name) for name in own}
        names |= {each.given(name) for name in CORNERS if each.number < len(claim.form.path)}
    return frozenset(names | {name for name in chosen if name.endswith("Q")})


def is_plain(case: Case) -> bool:
    """Whether every element has just the words that it needs, so that one follows from the other."""
    return not case.is_extended and all(_has_its_words(case, each) for each in elements_of(case.claim))


def _has_its_words(case: Case, each: Element) -> bool:
    coordinates = [bool(case.states(*map(each.given, names))) for names in ENDS]
    if each.turn is not None:
        has_center, has_radius = bool(case.states(*map(each.given, CENTERS))), bool(case.states(each.given("R")))
        if each.is_over:
            return all((*coordinates, has_radius, *(bool(case.states(each.given(name))) for name in CENTERS)))
        return has_center != has_radius and (all(coordinates) or (has_center and each.is_followed))
    has_angle = bool(case.states(each.given(",A")))
    if each.is_over:
        return has_angle and all(coordinates)
    if each.is_followed:
        return has_angle != all(coordinates) and has_angle != any(coordinates)
    return has_angle + sum(coordinates) == 2  # noqa: PLR2004 - a plane has two axes


def lacks_words(case: Case) -> bool:
    """Whether some element has fewer words than it needs."""
    for each in elements_of(case.claim):
        coordinates = [bool(case.states(*map(each.given, names))) for names in ENDS]
        has_angle, has_radius = bool(case.states(each.given(",A"))), bool(case.states(each.given("R")))
        if each.turn is not None and not each.is_over:
            if not (case.states(*map(each.given, CENTERS)) or (has_radius and all(coordinates))):
                return True
        elif each.turn is None and has_angle + sum(coordinates) < (3 if each.is_over else 1 if each.is_followed else 2):
            return True
    return False


Signs = Mapping[str, int]


def course_of(case: Case, signs: Signs, near: Mapping[str, complex] | None = None) -> Course:
    """The course that the words state, where signs choose as given; where one is missing, the place that is `near`.

    Raises UnmakeableError where there is none.
    """
    base = case.start_error
    rails: list[Rail] = []
    joints, unsure = [0j], [case.start_error]
    touching: dict[int, bool | None] = {}
    gaps: dict[int, float] = {}
    moot: set[str] = set()
    elements = elements_of(case.claim)
    for index, each in enumerate(elements):
        if each.is_over:
            rail = _absolute(case, each, base)
            if index:
                place, blur, touches = _joint(case, each, rails[-1], rail, base, joints[-1], signs, near)
                joints.append(place)
                unsure.append(blur)
                if elements[index - 1].turn is not None or each.turn is not None:
                    touching[index] = touches
                    moot |= {each.given("Q")} if touches else set()
        else:
            rail = _ordinary(case, each, joints[-1], unsure[-1], base, signs, moot)
        point = own_point(case, each, joints[-1])
        if point is not None and isinstance(rail, Ring):
            gaps[index] = off(rail, point)
        rails.append(rail)
        if not each.is_followed:
            joints.append(_end(case, each, joints[-1], rail, point))
            unsure.append(unsure[-1] if _is_incremental(case, each) else base)
    names = tuple(each.name for each in elements)
    return Course(
        names, tuple(rails), tuple(joints), _bends(case), None, tuple(unsure), touching, frozenset(moot), gaps
    )


def _joint(
    case: Case,
    each: Element,
    first: Rail,
    second: Rail,
    base: float,
    start: complex,
    signs: Signs,
    near: Mapping[str, complex] | None,
) -> tuple[complex, float, bool | None]:
    """The intersection in which an element begins; the one before it starts at `start`."""
    meeting = meet(first, second, base)
    if 0 in meeting.places:
        return meeting.places[0], meeting.unsure, False
    sign = signs.get(each.given("Q"), 0)
    if meeting.touches:
        return next(iter(meeting.places.values())), meeting.unsure, True
    if sign:
        if isinstance(first, Ring) and isinstance(second, Ring):
            sign, _ = circle_side(case, sign, start, second.center, second.radius)
        return meeting.places[sign], meeting.unsure, meeting.touches
    if near is None or each.tail not in near:
        raise UnmakeableError("Q is zero or missing")
    place = min(meeting.places.values(), key=lambda at: abs(at - near[each.tail]))
    return place, meeting.unsure, meeting.touches


def circle_side(case: Case, sign: int, start: complex, center: complex, radius: float) -> tuple[int, str]:
    """Which intersection of two circles a sign of Q stands for by the setting, left or right of the way between the
    centres, and its name; `start` is where the first arc starts, the rest is the second circle's."""
    values = {each.setting.name: each.value for each in case.claim.conventions}
    if values.get("circle-circle-q") == "first-met-clockwise":
        # Clockwise from outside the second circle, one enters it on the left.
        is_left = (sign < 0) == (abs(start - center) >= radius)
        return (LEFT if is_left else RIGHT), ("first" if sign < 0 else "second")
    side = sign * (LEFT if values.get("circle-circle-q") == "right-is-negative" else RIGHT)
    return side, "left" if side == LEFT else "right"


def _absolute(case: Case, each: Element, base: float) -> Rail:
    """The line or circle of an over-defined block."""
    if each.turn is None:
        at = complex(*(case.coordinate(each.given(names[0]), axis) for axis, names in enumerate(ENDS)))
        return Ray(at, direction(case.value(each.given(",A"))), base)
    center = complex(*(case.coordinate(each.given(name), axis) for axis, name in enumerate(CENTERS)))
    radius = case.amount(each.given("R"))
    if radius <= 0:
        raise UnmakeableError("a circle of radius 0 meets nothing")
    return Ring(center, radius, each.turn, base)


def _ordinary(
    case: Case,
    each: Element,
    tail: complex,
    unsure: float,
    base: float,
    signs: Signs,
    moot: set[str],
) -> Rail:
    """The line or circle of a block that begins where the one before it ends."""
    point = own_point(case, each, tail)
    if each.turn is None:
        if case.states(each.given(",A")):
            return Ray(tail, direction(case.value(each.given(",A"))), unsure)
        run = (tail if point is None else point) - tail
        if each.is_followed and abs(run) <= LENGTH:
            raise UnmakeableError("its two points are one")
        return Ray(tail, unit(run), unsure, (unsure + base) / abs(run) if run else 0.0)
    if case.states(*map(each.given, CENTERS)):
        step = complex(*(case.amount(each.given(name)) for name in CENTERS))
        if abs(step) <= LENGTH:
            raise UnmakeableError("the centre is where the arc begins")
        return Ring(tail + step, abs(step), each.turn, unsure)
    return _ring_by_radius(case, each, tail, tail if point is None else point, unsure + base, signs, moot)


def _ring_by_radius(
    case: Case,
    each: Element,
    tail: complex,
    point: complex,
    unsure: float,
    signs: Signs,
    moot: set[str],
) -> Ring:
    """R > 0 makes the arc from its begin to the point shorter than half a turn, R < 0 longer (printed)."""
    radius, way, turn = case.amount(each.given("R")), point - tail, each.turn
    chord = abs(way)
    rest = _rest(case, each)
    if rest == 0 and turn is not None:
        moot.add(each.given("R"))
        return Ring(tail + way / 2, radius, turn, unsure)
    if turn is not None and 2 * radius < chord <= 2 * (radius + half_circle(case, each.given("R"), way)):
        moot |= {each.given("R"), ROUNDED}
        return Ring(tail + way / 2, chord / 2, turn, unsure)
    if turn is None or not LENGTH < chord <= 2 * radius + case.limit + unsure:
        raise UnmakeableError(f"no circle of this radius passes through two points {chord:g} mm apart")
    rise, blur = leg(radius, chord / 2, ROUNDING * (radius + chord) + unsure)
    if rise <= blur:
        moot.add(each.given("R"))
        return Ring(tail + way / 2, radius, turn, rise + blur)
    places = {sign: tail + way / 2 + sign * turn.sign * rise * way / chord * 1j for sign in (1, -1)}
    sign = signs.get(each.given("R"), 0)
    if not sign:
        raise UnmakeableError("R has no sign")
    return Ring(places[sign], radius, turn, blur)


ROUNDED = "a half circle within the least increments"
"""No circle of exactly the stated radius has its ends, so that a result does not list the other solutions."""


def half_circle(case: Case, radius: str, chord: complex) -> float:
    """How much more than the radius half of a chord may be, mm: the ends and the radius are exact to half their
    increments."""
    across = abs(chord.real) * case.increment("0") + abs(chord.imag) * case.increment("1")
    return (across / abs(chord) + case.increment(radius)) / 2 + RESIDUAL if chord else 0.0


def _rest(case: Case, each: Element) -> Decimal | None:
    """By how much the square of twice the radius is more than that of the chord, exactly; None if it is not known."""
    with localcontext(prec=100):
        parts = []
        for axis, (absolute, step) in zip((FIRST, SECOND), ENDS, strict=True):
            if case.states(each.given(step)):
                parts.append(case.value(each.given(step)))
            elif case.states(each.given(absolute)) and each.number == 1:
                parts.append(case.value(each.given(absolute)) - case.origin[axis])
        rest = 4 * case.value(each.given("R")) ** 2 - sum(part * part for part in parts)
    return rest if len(parts) == 2 and any(parts) else None  # noqa: PLR2004 - a plane has two axes


def own_point(case: Case, each: Element, tail: complex) -> complex | None:
    """The point that an element's coordinates state; None if they do not state both."""
    found = []
    for axis, (absolute, step) in zip((FIRST, SECOND), ENDS, strict=True):
        if case.states(each.given(absolute)):
            found.append(case.coordinate(each.given(absolute), axis))
        elif case.states(each.given(step)):
            found.append(case.amount(each.given(step)) + (tail.real, tail.imag)[axis])
    return complex(*found) if len(found) == 2 else None  # noqa: PLR2004 - a plane has two axes


def _is_incremental(case: Case, each: Element) -> bool:
    return bool(case.states(*(each.given(step) for _, step in ENDS), each.given(",A")))


def _end(case: Case, each: Element, tail: complex, rail: Rail, point: complex | None) -> complex:
    """Where an element ends that ends in no intersection: at its point, or where a line has its one coordinate."""
    if point is not None:
        return point
    for axis, (absolute, step) in zip((FIRST, SECOND), ENDS, strict=True):
        is_absolute = bool(case.states(each.given(absolute)))
        if not isinstance(rail, Ray) or not (is_absolute or case.states(each.given(step))):
            continue
        begin, ahead = (tail.real, tail.imag)[axis], (rail.along.real, rail.along.imag)[axis]
        there = case.coordinate(each.given(absolute), axis) if is_absolute else begin + case.amount(each.given(step))
        if abs(ahead) <= REGULAR:
            if abs(there - begin) <= case.limit:
                raise LooseError("the line runs along the only coordinate that it is given, and is at it already")
            raise UnmakeableError("the line runs along the only coordinate that it is given")
        place = tail + (there - begin) / ahead * rail.along
        return complex(there, place.imag) if axis == FIRST else complex(place.real, there)
    raise UnmakeableError("its end is not stated")


def _bends(case: Case) -> dict[int, Bend]:
    """The corners that words make; a word of 0 makes none."""
    found = {}
    for each in elements_of(case.claim)[:-1]:
        for word, shape in CORNERS.items():
            name = each.given(word)
            if case.states(name) and case.value(name):
                size = case.amount(name)
                if size < 0 or each.number - 1 in found:
                    raise UnmakeableError(f"corner {each.number} is negative, or stated twice")
                found[each.number - 1] = Bend(f"corner {each.number}", shape, size, case.texts(name))
    return found
