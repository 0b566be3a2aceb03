"""Facts about drawings: laws of every equation, at random places, whether or not the fact is true there."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import cos, pi, sin
from random import Random
from typing import Any

import casadi
import numpy
import pytest
from examples import law
from hypothesis import strategies as st
from records import replace

from contoursolve import geometry
from contoursolve.numeric import Functions

POINTS, RADII, LINES = "PQRSCD", "rs", "LM"
CIRCLES = ("C", "r"), ("D", "s")
CW, CCW = geometry.Turn.CW, geometry.Turn.CCW
ALONG, AROUND = geometry.Along("L"), geometry.Tangent("P", "C", "r", CCW)

FACTS: tuple[Any, ...] = (
    *(geometry.Coordinate("length", "P", axis) for axis in (0, 1)),
    *(geometry.Offset("length", "P", "Q", axis) for axis in (0, 1)),
    *(geometry.Level("P", "Q", axis) for axis in (0, 1)),
    geometry.Collinear("P", "Q", "R"),
    geometry.Heading("angle", "P", "Q"),
    geometry.Ray("angle", "P", "Q"),
    geometry.Distance("length", "P", "Q"),
    geometry.EqualDistances("", ("P", "Q"), ("R", "S")),
    geometry.EqualDistances("", ("P", "Q"), ("Q", "R")),
    geometry.OnCircle("P", "C", "r"),
    geometry.Radius("length", "r"),
    geometry.RadiusStep("length", "r", "s"),
    *(geometry.Leaving("L", "P", "C", turn) for turn in geometry.Turn),
    geometry.ParallelTangent("L", "P", "C"),
    *(geometry.Spoke("angle", "C", "P", "r", axis, quarters) for axis in (0, 1) for quarters in (0, 3)),
    geometry.EqualRadii("", "r", "s"),
    *(kind(*CIRCLES, side) for kind in (geometry.TangentCircles, geometry.PointBeside) for side in (1, -1, "side")),
    *(geometry.Contact("P", "C", "D", side) for side in (1, -1)),
    *(geometry.ArcLength("length", "P", "Q", "C", "r", turn) for turn in geometry.Turn),
    geometry.UnitDirection("L"),
    geometry.Directed("angle", "L"),
    geometry.Through("L", "P"),
    geometry.ParallelLines("L", "M"),
    *(geometry.Parallel("L", axis, (("P", "Q"),)) for axis in (0, 1)),
    geometry.Foot("L", "P", "C"),
    *(geometry.Foot("L", "P", "C", corner="Q", way=way) for way in (1, -1)),
    *(geometry.TangentLine("L", "C", "r", side) for side in (1, -1, "side")),
    geometry.Extent("length", "L", "P", "Q"),
    *(geometry.TangentArc(("D", "s"), turn, "C", "r", side) for turn in geometry.Turn for side in (1, -1, "side")),
    *(geometry.ArcContact("P", ("D", "s"), turn, "C", "r", 1, "Q", way) for turn in geometry.Turn for way in (1, -1)),
    *(geometry.Setback("L", "P", "Q", "r", way) for way in (1, -1)),
    *(geometry.ChordSetback("C", turn, "P", "Q", "r", way) for turn in geometry.Turn for way in (1, -1)),
    *(geometry.ChamferLeg("P", "Q", "r", "side", axis, (("R", "S"),), share=0.25) for axis in (0, 1)),
    *(geometry.ChamferLeg("P", "Q", "r", "side", axis, (), ("L", "M")) for axis in (0, 1)),
    geometry.TurnBetween("angle", ALONG, geometry.Along("M")),
    geometry.TurnBetween("angle", ALONG, AROUND),
    geometry.TurnBetween("angle", AROUND, ALONG),
    geometry.TurnBetween("angle", AROUND, geometry.Tangent("P", "D", "s", CW)),
    geometry.TurnBetween("angle", geometry.Chord("P", "Q"), AROUND),
)
WITHOUT_LENGTH = (
    geometry.UnitDirection,
    geometry.Directed,
    geometry.Parallel,
    geometry.ParallelLines,
    geometry.TurnBetween,
)
"""Their residual is a sine, or close to one; all others' are in mm."""


@dataclass(frozen=True)
class Place:
    """Everything that a fact may look at; a point is a complex number, a line is its direction and its offset."""

    points: Mapping[str, complex]
    radii: Mapping[str, float]
    lines: Mapping[str, tuple[complex, float]]
    length: float
    angle: float
    side: int

    def scalars(self) -> dict[str, float]:
        found = dict(self.radii)
        for name, point in self.points.items():
            found |= {f"{name}.0": point.real, f"{name}.1": point.imag}
        for name, (along, offset) in self.lines.items():
            found |= {f"{name}.cos": along.real, f"{name}.sin": along.imag, f"{name}.off": offset}
        return found

    def at(self, scalars: Mapping[str, float]) -> "Place":
        return replace(
            self,
            points={name: complex(scalars[f"{name}.0"], scalars[f"{name}.1"]) for name in self.points},
            radii={name: scalars[name] for name in self.radii},
            lines={
                name: (complex(scalars[f"{name}.cos"], scalars[f"{name}.sin"]), scalars[f"{name}.off"])
                for name in self.lines
            },
        )

    def lookup(self, scalars: Mapping[str, Any] | None = None, functions: Functions | None = None) -> geometry.Values:
        return geometry.Values(
            self.scalars() if scalars is None else scalars,
            {"length": self.length},
            {"angle": (cos(self.angle), sin(self.angle))},
            signs={"side": self.side},
            functions=functions or Functions(),
        )


def random_place(seed: int) -> Place:
    rng = Random(seed)

    def turned(size: float) -> complex:
        angle = rng.uniform(-pi, pi)
        return size * complex(cos(angle), sin(angle))

    return Place(
        {name: complex(rng.uniform(-50, 50), rng.uniform(-50, 50)) for name in POINTS},
        {name: rng.uniform(5, 40) for name in RADII},
        {name: (turned(rng.uniform(0.8, 1.2)), rng.uniform(-50, 50)) for name in LINES},
        length=rng.uniform(5, 60),
        angle=rng.uniform(-pi, pi),
        side=rng.choice((1, -1)),
    )


def residual(fact: Any, place: Place) -> float:
    return float(fact.residual(place.lookup()))


def senses(fact: Any, place: Place) -> list[float]:
    return [float(each) for each in fact.senses(place.lookup())]


def gradient(formula: Callable[[geometry.Values], Any], place: Place) -> dict[str, float]:
    """By central differences, over every scalar there is."""
    scalars, found = place.scalars(), {}
    for name, value in scalars.items():
        step = 1e-5 * max(1.0, abs(value))
        above, below = (formula(place.lookup({**scalars, name: value + way * step})) for way in (1, -1))
        found[name] = float(above - below) / (2 * step)
    return found


def name_of(fact: Any) -> str:
    details = [str(getattr(fact, name)) for name in ("axis", "side", "turn", "way") if hasattr(fact, name)]
    between = (
        [type(each).__name__ for each in (fact.first, fact.second)] if isinstance(fact, geometry.TurnBetween) else []
    )
    return "-".join([type(fact).__name__, *details, *between])


def of_each_fact(*exceptions: type) -> Callable[[Any], Any]:
    facts = [fact for fact in FACTS if not isinstance(fact, exceptions)]
    return pytest.mark.parametrize("fact", facts, ids=name_of)


def test_every_kind_of_equation_has_its_laws_tested() -> None:
    exported = {getattr(geometry, name) for name in geometry.__all__}
    assert {kind for kind in exported - {geometry.Fact} if hasattr(kind, "residual")} == {type(fact) for fact in FACTS}


@of_each_fact()
def test_a_residual_depends_on_every_scalar_that_is_listed_and_on_no_other(fact: Any) -> None:
    moving = set()
    for seed in range(5):
        rates = gradient(fact.residual, random_place(seed))
        moving |= {name for name, rate in rates.items() if abs(rate) > 1e-6}
    assert moving == set(fact.reads())
    assert len(fact.reads()) == len(set(fact.reads()))


@of_each_fact()
def test_an_equation_and_a_sense_look_up_nothing_that_is_not_listed(fact: Any) -> None:
    place = random_place(1)
    for formula, listed in ((fact.equation, fact.reads()), (fact.senses, fact.sense_reads())):
        known = {name: value for name, value in place.scalars().items() if name in listed}
        assert formula(place.lookup(known)) == formula(place.lookup())


@of_each_fact()
def test_the_derivative_of_casadi_is_the_central_difference(fact: Any) -> None:
    names = tuple(random_place(0).scalars())
    symbols = {name: casadi.SX.sym(name) for name in names}
    for seed in range(5):
        place = random_place(seed)
        functions = Functions(casadi.sqrt, casadi.cos, casadi.sin, vanishes=lambda _: False)
        formula = fact.residual(place.lookup(symbols, functions))
        values = casadi.vertcat(*symbols.values())
        slopes = casadi.Function("slopes", [values], [casadi.jacobian(formula, values)])
        found = numpy.array(slopes(list(place.scalars().values()))).flatten()
        expected = gradient(fact.residual, place)
        for name, slope in zip(names, found, strict=True):
            assert slope == pytest.approx(expected[name], abs=1e-6, rel=1e-6), name


@of_each_fact()
def test_the_equation_is_the_residual_times_something_positive(fact: Any) -> None:
    """So that both are zero at the same places, and have the same sign everywhere else."""
    for seed in range(20):
        place = random_place(seed)
        assert float(fact.equation(place.lookup())) / residual(fact, place) > 1e-3


@of_each_fact()
def test_the_equation_is_zero_where_the_residual_is(fact: Any) -> None:
    for seed in range(2):
        place = random_place(seed)
        for _ in range(50):
            off, rates = residual(fact, place), gradient(fact.residual, place)
            size = sum(rate**2 for rate in rates.values())
            place = place.at({name: value - off * rates[name] / size for name, value in place.scalars().items()})
        assert abs(residual(fact, place)) < 1e-11
        assert abs(float(fact.equation(place.lookup()))) < 1e-8


# An oracle of complex numbers ---------------------------------------------------------------------------------------


def along(first: complex, second: complex) -> float:
    return (first.conjugate() * second).real


def left(first: complex, second: complex) -> float:
    return (first.conjugate() * second).imag


def oracle(fact: Any, at: Place) -> tuple[float, tuple[float, ...]]:  # noqa: C901 - a case for each kind of fact
    """What is zero where a fact holds, and what is positive where it holds in its sense."""
    p, q, r, s, c, d = (at.points[name] for name in POINTS)
    radius, other = at.radii["r"], at.radii["s"]
    (line, off), (second, _) = at.lines["L"], at.lines["M"]
    angle, length = complex(cos(at.angle), sin(at.angle)), at.length
    turn = getattr(getattr(fact, "turn", None), "sign", 0)
    side = at.side if getattr(fact, "side", 0) == "side" else getattr(fact, "side", 0)
    way, axis = getattr(fact, "way", 0), getattr(fact, "axis", 0)

    def part(place: complex) -> float:
        return (place.real, place.imag)[axis]

    def vector(direction: Any) -> complex:
        match direction:
            case geometry.Along(line=name):
                return at.lines[name][0]
            case geometry.Chord():
                return q - p
        return direction.turn.sign * 1j * (p - at.points[direction.center])

    match fact:
        case geometry.Coordinate():
            return part(p) - length, ()
        case geometry.Offset():
            return part(p - q) - length, ()
        case geometry.Level():
            return part(p - q), ()
        case geometry.Collinear():
            return left(q - p, r - p), ()
        case geometry.Heading():
            return left(q - p, angle), (along(q - p, angle),) * isinstance(fact, geometry.Ray)
        case geometry.Distance():
            return abs(q - p) ** 2 - length**2, ()
        case geometry.EqualDistances(second=(_, end)):
            return abs(q - p) ** 2 - abs((s - r) if end == "S" else (r - q)) ** 2, ()
        case geometry.OnCircle():
            return abs(p - c) ** 2 - radius**2, ()
        case geometry.Radius():
            return radius - length, ()
        case geometry.RadiusStep():
            return radius - other - length, ()
        case geometry.Leaving():
            return along(line, p - c), (turn * left(p - c, line),)
        case geometry.ParallelTangent():
            return along(line, p - c), ()
        case geometry.Spoke(quarters=quarters):
            return part(p - c) - radius * part(angle * 1j**quarters), ()
        case geometry.EqualRadii():
            return radius - other, ()
        case geometry.TangentCircles():
            inside = (2.0 if side == 1 else 2 * (other - radius),)
            return abs(d - c) ** 2 - (radius + side * other) ** 2, inside * isinstance(fact, geometry.PointBeside)
        case geometry.Contact():
            return left(p - c, d - c), (side * along(p - c, d - p),)
        case geometry.ArcLength():
            end = (p - c) * complex(cos(length / radius), turn * sin(length / radius))
            return left(end, q - c), (along(end, q - c), 710 / 113 * radius - length)
        case geometry.UnitDirection():
            return abs(line) ** 2 - 1, ()
        case geometry.Directed():
            return left(line, angle), (along(line, angle),)
        case geometry.Through():
            return left(line, p) - off, ()
        case geometry.ParallelLines():
            return left(line, second), ()
        case geometry.Parallel():
            return (line.imag, line.real)[axis], (part(line) * part(q - p),)
        case geometry.Foot(corner=corner):
            return along(line, p - c), (way * along(line, q - p),) * bool(corner)
        case geometry.TangentLine():
            return left(line, c) - off - side * radius, ()
        case geometry.Extent():
            return along(line, q - p) - length, ()
        case geometry.TangentArc():
            return abs(c - d) ** 2 - (other - turn * side * radius) ** 2, ()
        case geometry.ArcContact():
            reach = other - turn * side * radius
            return left(p - d, c - d), (reach * along(p - d, c - d), way * turn * left(p - d, q - d))
        case geometry.Setback():
            return way * along(line, q - p) - radius, ()
        case geometry.ChordSetback():
            return abs(q - p) ** 2 - radius**2, (way * turn * left(p - c, q - c),)
        case geometry.ChamferLeg(share=share):
            ahead = part(line + second) if fact.between else part(s - r)
            return part(q - p) - share * side * radius, (side * ahead,)
    first, last = vector(fact.first) * angle, vector(fact.second)
    return left(first, last), (along(first, last),)


@of_each_fact()
def test_an_equation_and_its_senses_are_those_of_the_oracle(fact: Any) -> None:
    for seed in range(20):
        place = random_place(seed)
        equation, expected = oracle(fact, place)
        assert float(fact.equation(place.lookup())) == pytest.approx(equation, abs=1e-9)
        assert senses(fact, place) == pytest.approx(list(expected), abs=1e-9)


def scaled(place: Place, by: float) -> Place:
    return replace(
        place,
        points={name: at * by for name, at in place.points.items()},
        radii={name: radius * by for name, radius in place.radii.items()},
        lines={name: (u, off * by) for name, (u, off) in place.lines.items()},
        length=place.length * by,
    )


@of_each_fact()
def test_the_residual_scales_with_the_drawing(fact: Any) -> None:
    factor = 1.0 if isinstance(fact, WITHOUT_LENGTH) else 3.0
    for place in map(random_place, range(20)):
        assert residual(fact, scaled(place, 3.0)) == pytest.approx(factor * residual(fact, place), abs=1e-9)


class Incidences:
    """All points are on all lines and circles, and in Q each line touches its circle."""

    read = frozenset(RADII)

    def is_on(self, *_names: str) -> bool:
        return True

    def radius_of(self, center: str, _point: str) -> str:
        return dict(CIRCLES)[center]

    def on_line(self, _line: str) -> set[str]:
        return {"P", "Q"}

    def points(self, _line: str) -> list[str]:
        return ["P", "Q"]

    def touched(self, _line: str, _center: str) -> list[str]:
        return ["Q"]


def true_place(seed: int, facts: Sequence[Any]) -> Place | None:
    """A place near a random one where facts are true in their senses, by the method of Newton."""
    place, names = random_place(seed), list(random_place(seed).scalars())
    for _ in range(9):
        rates = [gradient(fact.residual, place) for fact in facts]
        matrix = numpy.array([[each[name] for name in names] for each in rates])
        off = numpy.linalg.lstsq(matrix, numpy.array([residual(fact, place) for fact in facts]), rcond=None)[0]
        place = place.at({name: place.scalars()[name] - by for name, by in zip(names, off, strict=True)})
    is_true = max(abs(residual(fact, place)) for fact in facts) < 1e-10 and min(place.radii.values()) > 1
    return place if is_true and all(each > 0 for fact in facts for each in senses(fact, place)) else None


ON_CIRCLE = (geometry.OnCircle("P", "C", "r"), geometry.OnCircle("Q", "C", "r"))
UNIT = geometry.UnitDirection("L")
FOLLOWING: tuple[tuple[Any, ...], ...] = (
    (geometry.Extent("length", "L", "P", "Q"), UNIT, geometry.Through("L", "P"), geometry.Through("L", "Q")),
    *(
        (
            geometry.TangentLine("L", "C", "r", side),
            UNIT,
            geometry.Through("L", "P"),
            geometry.Through("L", "Q"),
            geometry.Foot("L", "Q", "C"),
        )
        for side in (1, -1, "side")
    ),
    *((kind(*CIRCLES, side),) for kind in (geometry.TangentCircles, geometry.PointBeside) for side in (1, -1, "side")),
    *((geometry.Contact("P", "C", "D", side), ON_CIRCLE[0], geometry.OnCircle("P", "D", "s")) for side in (1, -1)),
    *((geometry.ArcLength("length", "P", "Q", "C", "r", turn), *ON_CIRCLE) for turn in geometry.Turn),
    (geometry.TurnBetween("angle", ALONG, geometry.Along("M")), UNIT, geometry.UnitDirection("M")),
    (geometry.TurnBetween("angle", ALONG, AROUND), UNIT, ON_CIRCLE[0]),
    (
        geometry.TurnBetween("angle", AROUND, geometry.Tangent("P", "D", "s", CW)),
        ON_CIRCLE[0],
        geometry.OnCircle("P", "D", "s"),
    ),
)
"""Facts from which something follows, each with what puts points on its lines and circles."""


@pytest.mark.parametrize("facts", FOLLOWING, ids=lambda facts: name_of(facts[0]))
def test_what_follows_from_a_fact_is_zero_where_it_is_true_and_not_elsewhere(facts: tuple[Any, ...]) -> None:
    seen = 0
    for seed in range(40):
        place, elsewhere = true_place(seed, facts), random_place(seed)
        if place is not None:
            following = list(facts[0].follows(Incidences(), place.lookup()))
            assert following == pytest.approx([0] * len(following), abs=1e-6)
            assert max(abs(each) for each in facts[0].follows(Incidences(), elsewhere.lookup())) > 1e-3
            seen += 1
        if seen == 4:
            return
    pytest.fail(f"{seen} places were found")


HELD: tuple[tuple[Any, ...], ...] = (
    (geometry.Through("L", "P"), UNIT),
    ON_CIRCLE[:1],
    *((geometry.TangentLine("L", "C", "r", side), UNIT) for side in (1, -1)),
    *((geometry.TangentCircles(*CIRCLES, side),) for side in (1, -1)),
)


@pytest.mark.parametrize("facts", HELD, ids=lambda facts: name_of(facts[0]))
def test_a_fact_holds_where_it_says_on_each_of_its_lines_and_circles(facts: tuple[Any, ...]) -> None:
    seen = 0
    for place in filter(None, (true_place(seed, facts) for seed in range(20))):
        seen += 1
        for name, at in facts[0].places(place.lookup()):
            there = replace(place, points={**place.points, "S": complex(*at)})
            on = (
                geometry.OnCircle("S", name, dict(CIRCLES)[name])
                if name in dict(CIRCLES)
                else geometry.Through(name, "S")
            )
            assert abs(residual(on, there)) < 1e-9
    assert seen >= 4


@pytest.mark.parametrize(
    "fact",
    [each for each in FACTS if isinstance(each, geometry.Coordinate | geometry.Offset | geometry.Heading)],
    ids=name_of,
)
def test_a_fact_reaches_as_far_as_its_words_and_coordinates_move_it(fact: Any) -> None:
    """By the last digits of each coordinate, of three increments, and of the word."""
    digits = {"0": 0.001, "1": 0.0005, "length": 0.004, "angle": 0.002}
    for place in filter(None, (true_place(seed, (fact,)) for seed in range(20))):
        rates = gradient(fact.residual, place)
        moves = sum(abs(rate) * digits.get(name[-1], 0.0) for name, rate in rates.items())
        word = digits[fact.given] * (
            1 if fact.given == "length" else abs(place.points["Q"] - place.points["P"]) * pi / 180
        )
        assert fact.reach(place.lookup(), digits.__getitem__) == pytest.approx(moves + word, rel=1e-6)
    assert geometry.Radius("length", "r").reach(place.lookup(), digits.__getitem__) == 0.008


@pytest.mark.parametrize("fact", [geometry.OnCircle("P", "C", "r"), geometry.Distance("length", "P", "Q")], ids=name_of)
def test_an_excess_is_a_distance_less_what_it_is_to_be(fact: Any) -> None:
    place = random_place(3)
    to, wanted = ("C", place.radii["r"]) if isinstance(fact, geometry.OnCircle) else ("Q", place.length)
    assert fact.excess(place.lookup()) == pytest.approx(abs(place.points["P"] - place.points[to]) - wanted)


@law(st.integers(0, 2**32))
def test_the_implied_value_makes_a_fact_true_in_its_sense(seed: int) -> None:
    place = random_place(seed)
    for fact in FACTS:
        if not fact.given:
            continue
        at = place
        if isinstance(fact, geometry.ArcLength | geometry.Spoke):  # on this circle alone
            spoke = place.points["P"] - place.points["C"]
            on = place.points["C"] + spoke / abs(spoke) * place.radii["r"]
            spoke = place.points["Q"] - place.points["C"]
            other = place.points["C"] + spoke / abs(spoke) * place.radii["r"]
            at = replace(place, points={**place.points, "P": on, "Q": other})
        value = fact.implied(at.lookup())
        assert value is not None
        there = replace(at, angle=value * pi / 180) if fact.given == "angle" else replace(at, length=value)
        assert abs(residual(fact, there)) < 1e-9, fact
        assert all(each > 0 for each in senses(fact, there)), fact


@of_each_fact()
def test_what_states_no_value_implies_none(fact: Any) -> None:
    assert fact.given or fact.implied(random_place(1).lookup()) is None


def test_a_heading_between_equal_points_implies_nothing() -> None:
    place = random_place(1)
    together = replace(place, points={**place.points, "Q": place.points["P"]})
    assert geometry.Heading("angle", "P", "Q").implied(together.lookup()) is None
