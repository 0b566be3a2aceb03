"""NCT 16.3.3 where further facts are stated or values asked for: an arc, then a line, with whatever words there are.

Points count from the start point: real is the plane's first axis, imaginary its second.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import sqrt

from contoursolve.model import FIRST, SECOND
from contoursolve.tolerance import LENGTH, RADIUS_DIFFERENCE
from contoursolve.verification.asked import check_asked
from contoursolve.verification.case import Case, Circle, turn_of
from contoursolve.verification.determination import check_statements
from contoursolve.verification.drawing import Drawing, Round, Straight
from contoursolve.verification.facts import STEP, Sight, slopes, statements
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import angle_between, cross, direction, dot, unit
from contoursolve.verification.quantity import Quantity
from contoursolve.verification.statement import Statement, displacement

CENTER = ("1:center-first", "1:center-second")
POINT = ("1:first", "1:first-step", "1:second", "1:second-step")
END, ANGLE, CHOICE = ("2:first", "2:second"), "2:,A", "2:Q"
KNOWN = "1:point"
"""Stated as soon as the arc has a coordinate."""

ITERATIONS = 20
"""Of Newton's method, from a point that is right to the least increment."""


@dataclass(frozen=True, slots=True)
class _Numbers:
    """The unknowns: the centre C, the radius, the intersection P1, the line's end N2, the point N1 of the circle."""

    center: complex
    radius: float
    crossing: complex
    end: complex
    point: complex | None

    def listed(self) -> tuple[float, ...]:
        """All coordinates and the radius, mm."""
        points = (self.center, self.crossing, self.end, *(() if self.point is None else (self.point,)))
        return (self.radius, *(value for at in points for value in (at.real, at.imag)))

    def changed(self, values: Sequence[float]) -> "_Numbers":
        """The same with other values, in the order of `listed`."""
        points = [complex(*pair) for pair in zip(values[1::2], values[2::2], strict=True)]
        return _Numbers(points[0], values[0], points[1], points[2], points[3] if self.point is not None else None)


def check(case: Case, ledger: Ledger) -> None:
    """Everything that words and facts say about the path."""
    names = ", ".join(sorted(map(ascii, case.points))) or "none"
    shapes = [move.circle is not None for move in case.moves]
    found = ", ".join("arc" if shape else "line" for shape in shapes) or "nothing"
    known = ledger.require("the point is P1", (), case.points.keys() == {"P1"}, names)
    made = ledger.require("the elements are an arc and a line", (), shapes in ([True, False], [True]), found)
    circle = case.moves[0].circle if case.moves else None
    if not (known and made and circle):
        ledger.omit("the words of the blocks", "they are about an arc, a line and P1")
        return
    turn = turn_of(case)
    ledger.require("the arc turns as its G code says", (), circle.turn is turn, circle.turn.value)
    ledger.measure("the arc ends at P1", (), abs(case.moves[0].end - case.points["P1"]), case.limit)
    numbers = _Numbers(circle.center, circle.radius, case.points["P1"], case.moves[-1].end, _point(case, circle))
    sight = Sight(_draw(case, numbers), numbers.listed(), _redraw(case, numbers), case.origin, case.reach)
    of_words = list(_statements(case, numbers))
    of_facts = list(statements(case.facts, sight, ledger))
    needed = _needed(case, ledger, of_words, of_facts, len(sight.unknowns))
    check_statements(case, ledger, needed, sight.unknowns)
    _check_choices(case, ledger, numbers)
    check_asked(case, ledger, _values(case, numbers), sight.claimed)


def redo(case: Case) -> Drawing | None:
    """The contour of the words alone, near the claimed one; None if they do not fix it, or choose another."""
    circle = case.moves[0].circle
    if circle is None:
        return None
    numbers = _Numbers(circle.center, circle.radius, case.points["P1"], case.moves[-1].end, _point(case, circle))
    for _ in range(ITERATIONS):
        values = numbers.listed()
        moved = displacement(list(_statements(case, numbers)), len(values))
        if moved.rank < len(values) or moved.distance > case.reach:
            return None
        numbers = numbers.changed([value - off for value, off in zip(values, moved.moves, strict=True)])
        if moved.distance <= LENGTH / 1000:
            break
    chosen = Ledger()
    _check_choices(case, chosen, numbers)
    return None if chosen.failures else _draw(case, numbers)


def _point(case: Case, circle: Circle) -> complex | None:
    """The point of the circle that the arc's block speaks about; a coordinate that is asked for is the claimed one.

    Where nothing claims it, it is taken from the circle.
    """
    if not case.states(KNOWN):
        return None
    found: list[float | None] = []
    for axis, absolute, step in ((FIRST, *POINT[:2]), (SECOND, *POINT[2:])):
        if case.states(absolute):
            found.append(case.coordinate(absolute, axis))
        elif case.states(step):
            found.append(case.amount(step))
        else:
            found.append(_claimed_coordinate(case, (absolute, step), axis))
    first, second = found
    if first is None:
        first = _on_circle(circle.radius, circle.center.real, (second or 0.0) - circle.center.imag)
    if second is None:
        second = _on_circle(circle.radius, circle.center.imag, first - circle.center.real)
    return complex(first, second)


def _claimed_coordinate(case: Case, names: tuple[str, str], axis: int) -> float | None:
    """A coordinate that the program asks for, as the result answers it."""
    for name, is_absolute in zip(names, (True, False), strict=True):
        word = case.claim.words.get(name)
        for asked in case.claimed.asked or ():
            if word and (asked.word, asked.line) == (word.text, word.span.line) and asked.value is not None:
                return asked.value - (float(case.origin[axis]) if is_absolute else 0.0)
    return None


def _on_circle(radius: float, middle: float, off: float) -> float:
    """Where a circle is, `off` from its centre along the other axis; where it comes closest, if it is nowhere."""
    return middle + sqrt(max(0.0, (radius - off) * (radius + off)))


def _draw(case: Case, numbers: _Numbers) -> Drawing:
    run = unit(numbers.end - numbers.crossing)
    along = direction(case.value(ANGLE)) if case.states(ANGLE) and not run else run
    turn = turn_of(case)
    if turn is None:
        raise ValueError("an arc has a turn")
    arc = Round(0j, numbers.crossing, numbers.center, numbers.radius, turn)
    line = Straight(numbers.crossing, numbers.end, numbers.crossing, numbers.end, along)
    points = {"S": 0j, "C": numbers.center, "P1": numbers.crossing, "N2": numbers.end}
    if numbers.point is not None:
        points["N1"] = numbers.point
    return Drawing(points, {"arc": arc, "line": line}, ("arc", "line"))


def _redraw(case: Case, numbers: _Numbers) -> Callable[[Sequence[float]], Drawing]:
    return lambda at: _draw(case, numbers.changed(at))


def _statements(case: Case, numbers: _Numbers) -> Iterator[Statement]:
    """What the form and the words say about the unknowns."""

    def state(name: str, given: str, residual: Callable[[_Numbers], float], against: float = 0.0) -> Statement:
        (word,) = case.texts(given) or ("",)

        def value(at: Sequence[float]) -> float:
            return residual(numbers.changed(at))

        slope = slopes(value, numbers.listed(), STEP * case.reach)
        return Statement(name, word, slope, residual(numbers), against=against, value=value)

    yield state("the start lies on the circle", "", lambda at: abs(at.center) - at.radius)
    yield state("P1 lies on the circle", "", lambda at: abs(at.crossing - at.center) - at.radius)
    for axis, name in enumerate(CENTER):
        if case.states(name):
            yield state("the centre is where its word puts it", name, _part(case, name, axis, lambda at: at.center))
    if case.states("1:R"):
        size = abs(case.amount("1:R"))
        yield state("the radius is the one given", "1:R", lambda at: at.radius - size)
    for name, axis in zip(POINT, (FIRST, FIRST, SECOND, SECOND), strict=True):
        if case.states(name) and numbers.point is not None:
            yield state("the point is where its word puts it", name, _part(case, name, axis, lambda at: at.point or 0j))
    if numbers.point is not None:
        yield state(ON_CIRCLE, "", lambda at: abs((at.point or 0j) - at.center) - at.radius)
    for axis, name in enumerate(END):
        if case.states(name):
            yield state("the line ends where its word says", name, _part(case, name, axis, lambda at: at.end))
    if case.states(ANGLE):
        along = direction(case.value(ANGLE))
        run = numbers.end - numbers.crossing
        against = max(0.0, -dot(along, run))
        each = state("the line runs at its angle", ANGLE, lambda at: cross(along, at.end - at.crossing), against)
        yield replace(each, degrees=angle_between(along, run))


ON_CIRCLE = "the given point lies on the circle"


def _part(case: Case, name: str, axis: int, of: Callable[[_Numbers], complex]) -> Callable[[_Numbers], float]:
    """How far a coordinate is from its word; center words and steps count from the start."""
    is_absolute = name in (*END, "1:first", "1:second")
    value = case.coordinate(name, axis) if is_absolute else case.amount(name)
    return lambda at: (of(at).real, of(at).imag)[axis] - value


def _needed(
    case: Case, ledger: Ledger, of_words: list[Statement], of_facts: list[Statement], unknowns: int
) -> list[Statement]:
    """The statements without the one about the given point, where the circle is known without it: what differs
    less than a machine parameter is then accepted (alarm 3011)."""
    others = [each for each in (*of_words, *of_facts) if each.name != ON_CIRCLE]
    holding = [each for each in others if abs(each.residual) <= case.limit]
    given = [each for each in of_words if each.name == ON_CIRCLE]
    if not given or displacement(holding, unknowns).rank < unknowns:
        return [*of_words, *of_facts]
    ledger.measure(ON_CIRCLE, case.texts(*POINT), given[0].residual, RADIUS_DIFFERENCE)
    return others


def _check_choices(case: Case, ledger: Ledger, numbers: _Numbers) -> None:
    """Q chooses the nearer or the farther intersection along ,A; the sign of R the shorter or the longer arc to the
    given point (printed)."""
    branch, is_double = case.claimed.branch, bool(case.claimed.certificate.double)
    sign = case.choices.get(CHOICE, 0)
    run = numbers.end - numbers.crossing
    allowed: tuple[str | None, ...] = (None,)
    if sign and (case.states(ANGLE) or abs(run) > case.limit):
        meant = "nearer" if sign < 0 else "farther"
        # Where no ,A is stated, the line runs from the intersection to its end.
        along = direction(case.value(ANGLE)) if case.states(ANGLE) else unit(run)
        ahead = dot(along, numbers.crossing - numbers.center)
        off = max(0.0, -sign * ahead)
        ledger.measure("P1 is the intersection that Q chooses", case.texts(CHOICE), off, case.limit)
        # A line that just touches leaves Q nothing to choose.
        touches = is_double or (not case.states(ANGLE) and abs(ahead) <= case.limit)
        allowed = (meant, None) if touches else (meant,)
    elif case.states(CHOICE):
        ledger.omit(" ".join(case.texts(CHOICE)), "the line has no direction along which it would choose")
    if not case.is_listed:
        ledger.require(
            "the branch is the one that Q chooses", case.texts(CHOICE), branch in allowed, f"{branch!a}"[:60]
        )
    size, turn = case.choices.get("1:R", 0), turn_of(case)
    # Without an answer, nothing tells at which of two places a point is whose coordinate is asked for.
    is_known = case.claimed.asked is not None or not set(case.asked) & set(POINT)
    if size and is_known and numbers.point is not None and turn is not None:
        side = size * turn.sign
        off = max(0.0, -side * cross(unit(numbers.point), numbers.center))
        ledger.measure("the centre is on the side that R chooses", case.texts("1:R", *POINT), off, case.limit)


def _values(case: Case, numbers: _Numbers) -> Mapping[str, Quantity]:
    """What every word that may be asked for would have to say."""
    run, (first, second) = numbers.end - numbers.crossing, (float(value) for value in case.origin)
    found = {
        "1:center-first": Quantity(numbers.center.real),
        "1:center-second": Quantity(numbers.center.imag),
        "1:R": Quantity(numbers.radius),
        "2:first": Quantity(numbers.end.real + first),
        "2:second": Quantity(numbers.end.imag + second),
        ANGLE: Quantity(angle_between(1, run), is_angle=True, reach=abs(run)),
    }
    if numbers.point is not None:
        found |= {
            "1:first": Quantity(numbers.point.real + first),
            "1:first-step": Quantity(numbers.point.real),
            "1:second": Quantity(numbers.point.imag + second),
            "1:second-step": Quantity(numbers.point.imag),
        }
    return found
