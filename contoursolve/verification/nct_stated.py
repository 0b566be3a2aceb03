"""NCT chapter 16 where further facts are stated, values asked for, or words say more or less than they need to.

Points count from the start point: real is the plane's first axis, imaginary its second.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise

from contoursolve.model import FIRST, SECOND
from contoursolve.verification.asked import check_asked
from contoursolve.verification.case import Case
from contoursolve.verification.chain import Words, check_pieces
from contoursolve.verification.course import trace
from contoursolve.verification.determination import check_statements
from contoursolve.verification.facts import STEP, Sight, slopes, statements
from contoursolve.verification.ledger import Ledger, fewest
from contoursolve.verification.measure import ROUNDING, angle_between, cross, direction, dot, unit
from contoursolve.verification.nct_figure import Figure, Slots, course_at, drawing_at, figure_of, makers, slots_of
from contoursolve.verification.nct_words import CENTERS, ENDS, Element, circle_side, elements_of, half_circle
from contoursolve.verification.quantity import Quantity
from contoursolve.verification.rails import UnmakeableError
from contoursolve.verification.statement import Statement, displacement

ON_CIRCLE, RADIUS = "the given point lies on its circle", "the radius is the one given"

Sides = dict[str, set[str | None]]


def check(case: Case, ledger: Ledger, words: Words, check_sides: Callable[[Sides, Ledger], None]) -> None:
    """Everything that words and facts say about the path; `check_sides` takes the branches that are possible."""
    readings = list(slots_of(case))
    shown = ", ".join("arc" if move.circle else "line" for move in case.moves) or "nothing"
    if ledger.require("the elements are those that the words make", (), bool(readings), f"the result has {shown}"):
        ledger.add(fewest([partial(_reading, case, each, words, check_sides) for each in readings]))
    else:
        ledger.omit("the words of the blocks", "they are about other elements")


def _reading(case: Case, slots: Slots, words: Words, check_sides: Callable[[Sides, Ledger], None]) -> Ledger:
    """The checks of the elements by these names."""
    ledger, figure = Ledger(), figure_of(case, slots)
    try:
        course = course_at(case, figure)
        traced = trace(course)
        drawing = drawing_at(case, figure)
    except UnmakeableError as error:
        ledger.require("the elements and corners can be made", (), False, str(error))
        return ledger
    for name, room in traced.room.items():
        ledger.measure(f"{name} has room for its corners, and runs ahead", words[name], max(0.0, -room), case.limit)
    check_pieces(
        case, ledger, traced, traced.condition * ROUNDING * case.reach + 2 * _PRINTED * traced.condition, words
    )
    sight = Sight(drawing, figure.listed(), lambda at: drawing_at(case, figure.changed(at)), case.origin, case.reach)
    of_words, of_facts = list(_statements(case, figure)), list(statements(case.facts, sight, ledger))
    needed = _needed(case, ledger, of_words, of_facts, len(sight.unknowns))
    check_statements(case, ledger, needed, sight.unknowns)
    check_sides(_check_choices(case, ledger, figure), ledger)
    check_asked(case, ledger, _values(case, figure), drawing)
    return ledger


_PRINTED = 1e-12
"""mm. The rounding of a point and of a radius to 12 decimals."""


def _statements(case: Case, figure: Figure) -> Iterator[Statement]:
    """What the form and the words say about the unknowns."""

    def state(name: str, given: str, residual: Callable[[Figure], float], against: float = 0.0) -> Statement:
        (word,) = case.texts(given) or ("",)

        def value(at: Sequence[float]) -> float:
            return residual(figure.changed(at))

        slope = slopes(value, figure.listed(), STEP * case.reach)
        return Statement(name, word, slope, residual(figure), against=against, value=value)

    for each in elements_of(case.claim):
        for name, given, residual in _coordinates(case, each, figure):
            yield state(name, given, residual)
        if each.turn is None:
            yield from _of_line(case, each, figure, state)
            continue
        for end in (each.tail, *([each.head] if each.is_followed else [])):
            yield state(f"{each.name} passes through {end}", "", _ring_off(each, end))
        if each.own in figure.points:
            yield state(ON_CIRCLE, "", _ring_off(each, each.own))
        if case.states(each.given("R")):
            size = _stated_radius(case, each, figure)
            yield state(RADIUS, each.given("R"), _size_off(each, size))


Residual = Callable[[Figure], float]
State = Callable[..., Statement]


def _ring_off(each: Element, name: str) -> Residual:
    return lambda at: abs(at.at(name) - at.at(each.center)) - at.numbers[each.radius]


def _stated_radius(case: Case, each: Element, figure: Figure) -> float:
    """The radius that R gives; of a half circle half of its chord, which may be more by as little as words are exact
    to."""
    size, head = abs(case.amount(each.given("R"))), each.own if each.own in figure.points else each.head
    chord = figure.at(head) - figure.at(each.tail)
    is_half = not each.is_over and 0 < abs(chord) / 2 - size <= half_circle(case, each.given("R"), chord)
    return abs(chord) / 2 if is_half else size


def _size_off(each: Element, size: float) -> Residual:
    return lambda at: at.numbers[each.radius] - size


def _coordinates(case: Case, each: Element, figure: Figure) -> Iterator[tuple[str, str, Residual]]:
    """Every coordinate that a word states, of a point or of a centre."""
    for axis in (FIRST, SECOND):
        for name, is_step in zip(ENDS[axis], (False, True), strict=True):
            given = each.given(name)
            if case.states(given) and each.own in figure.points:
                value = case.amount(given) if is_step else case.coordinate(given, axis)
                base = each.tail if is_step else "S"
                yield f"{each.own} is where its word puts it", given, _part(each.own, base, axis, value)
        given = each.given(CENTERS[axis])
        if case.states(given) and each.center:
            value = case.coordinate(given, axis) if each.is_over else case.amount(given)
            base = "S" if each.is_over else each.tail
            yield "the centre is where its word puts it", given, _part(each.center, base, axis, value)


def _part(name: str, base: str, axis: int, value: float) -> Residual:
    def residual(at: Figure) -> float:
        step = at.at(name) - at.at(base)
        return (step.real, step.imag)[axis] - value

    return residual


def _of_line(case: Case, each: Element, figure: Figure, state: State) -> Iterator[Statement]:
    """A line runs at its angle, or through its point."""
    given = each.given(",A")
    run = figure.at(each.head) - figure.at(each.tail)
    if case.states(given):
        along = direction(case.value(given))
        name, against = f"{each.name} runs at its angle", max(0.0, -dot(along, run))
        ends = [(each.tail, each.own), (each.own, each.head)] if each.is_over else [(each.tail, each.head)]
        for begin, end in ends:
            if begin != end:
                stated = state(name, given, lambda at, b=begin, e=end: cross(along, at.at(e) - at.at(b)), against)
                off = figure.at(end) - figure.at(begin)
                yield replace(stated, degrees=angle_between(along, off))
    elif each.is_followed and each.own in figure.points:
        stated = state(
            f"{each.name} runs through its point",
            "",
            lambda at: cross(unit(at.at(each.own) - at.at(each.tail)), at.at(each.head) - at.at(each.tail)),
        )
        yield replace(stated, against=max(0.0, -dot(unit(figure.at(each.own) - figure.at(each.tail)), run)))


def _needed(
    case: Case, ledger: Ledger, of_words: list[Statement], of_facts: list[Statement], unknowns: int
) -> list[Statement]:
    """The statements without those about a given point, or a radius, whose circle is known without it: what differs
    less than a machine parameter is then accepted (alarm 3011)."""
    needed = [*of_words, *of_facts]
    for given in [each for each in of_words if each.name in (ON_CIRCLE, RADIUS)]:
        others = [each for each in needed if each is not given]
        holding = [each for each in others if abs(each.residual) <= case.limit]
        if displacement(holding, unknowns).rank == unknowns:
            ledger.measure(given.name, (), given.residual, case.slack + case.limit)
            needed = others
    return needed


def _check_choices(case: Case, ledger: Ledger, figure: Figure) -> Sides:
    """Q chooses one of two intersections; the sign of R the shorter or the longer arc to the given point (printed).

    The branches that are possible are returned, by the point.
    """
    possible: Sides = {}
    elements = elements_of(case.claim)
    for before, each in pairwise(elements):
        if each.is_over and (before.turn or each.turn):
            possible[each.tail] = _check_side(case, ledger, figure, before, each)
    for each in elements:
        size, turn = case.choices.get(each.given("R"), 0), each.turn
        # Without an answer, nothing tells at which of two places a point is whose coordinate is asked for.
        asks = {each.given(name) for pair in ENDS for name in pair} & set(case.asked)
        if size and turn and not each.is_over and each.own in figure.points and not (asks and not case.claimed.asked):
            tail = figure.at(each.tail)
            side = size * turn.sign * cross(unit(figure.at(each.own) - tail), figure.at(each.center) - tail)
            words = case.texts(*(each.given(name) for pair in ENDS for name in pair), each.given("R"))
            ledger.measure("the centre is on the side that R chooses", words, max(0.0, -side), case.limit)
    return possible


def _check_side(case: Case, ledger: Ledger, figure: Figure, before: Element, each: Element) -> set[str | None]:
    """How far an intersection is on the wrong side of the other one."""
    sign, place, words = case.choices.get(each.given("Q"), 0), figure.at(each.tail), case.texts(each.given("Q"))
    is_double = bool(case.claimed.certificate.double)
    if before.turn is not None and each.turn is not None:
        first, second = figure.at(before.center), figure.at(each.center)
        ahead, is_stated = -cross(unit(second - first), place - first), True
        if sign:
            start, radius = figure.at(before.tail), figure.numbers[each.radius]
            sign, name = circle_side(case, sign, start, second, radius)
    else:
        line, arc = (before, each) if before.turn is None else (each, before)
        run = figure.at(line.head) - figure.at(line.tail)
        is_stated = bool(case.states(line.given(",A")))
        if not is_stated and abs(run) <= case.limit:
            ledger.omit(" ".join(words), "the line has no direction along which it would choose")
            return {None}
        along = direction(case.value(line.given(",A"))) if is_stated else unit(run)
        ahead, name = dot(along, place - figure.at(arc.center)), "farther" if sign > 0 else "nearer"
    if not sign:
        return {None}
    ledger.measure(f"{each.tail} is the intersection that Q chooses", words, max(0.0, -sign * ahead), case.limit)
    # What just touches leaves Q nothing to choose.
    touches = is_double or (not is_stated and abs(ahead) <= case.limit)
    return {name, None} if touches else {name}


def _values(case: Case, figure: Figure) -> Mapping[str, Quantity]:
    """What every word that may be asked for would have to say."""
    found: dict[str, Quantity] = {}
    origin = complex(*(float(value) for value in case.origin))
    for each in elements_of(case.claim):
        tail, run = figure.at(each.tail), figure.at(each.head) - figure.at(each.tail)
        places = {"first": 0j, "first-step": 0j, "second": 0j, "second-step": 0j}
        if each.own in figure.points:
            own = figure.at(each.own)
            places = {name: own - tail if name.endswith("step") else own + origin for name in places}
            found |= {
                each.given(name): Quantity(at.real if name.startswith("first") else at.imag)
                for name, at in places.items()
            }
        if each.center:
            center = figure.at(each.center) + (origin if each.is_over else -tail)
            found[each.given(CENTERS[FIRST])] = Quantity(center.real)
            found[each.given(CENTERS[SECOND])] = Quantity(center.imag)
            found[each.given("R")] = Quantity(figure.numbers[each.radius])
        else:
            found[each.given(",A")] = Quantity(angle_between(1, run), is_angle=True, reach=abs(run))
        found |= {name: Quantity(figure.numbers[name]) for name in makers(case, each) if name in case.asked}
    return found
