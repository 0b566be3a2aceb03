"""Facts about drawings: laws of every equation, and drawings told backwards by statements of every kind.

The laws hold at random places, whether or not the fact is true there. The drawings are the chains of the
oracle, and it is the oracle that measures what comes back.
"""

import json
from cmath import phase
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from functools import cache
from itertools import combinations, permutations, product
from math import cos, degrees, pi, sin
from random import Random
from typing import Any

import casadi
import numpy
import pytest
from chains import (
    KINDS,
    Chain,
    Fact,
    distance_between,
    form_residuals,
    measure,
    random_chain,
    random_facts,
    standard_facts,
)
from examples import law
from hypothesis import strategies as st
from records import replace
from sketches import chain_of, sketch_of

from contoursolve import Sketch, solve
from contoursolve.geometry import (
    Along,
    ArcContact,
    ArcLength,
    ChamferLeg,
    ChordIs,
    ChordSetback,
    CircleAt,
    Collinear,
    Contact,
    Coordinate,
    Directed,
    DirectionIs,
    Distance,
    EqualDistances,
    EqualLengths,
    EqualRadii,
    EqualSizes,
    Extent,
    Foot,
    Heading,
    Leaving,
    Length,
    LengthIs,
    Level,
    LiesOn,
    LineAt,
    Meeting,
    MeetsLine,
    Offset,
    OnCircle,
    Parallel,
    ParallelLines,
    ParallelTo,
    PassesBeside,
    PassesThrough,
    Plane,
    PointBeside,
    PointIs,
    PolarAngleIs,
    Radius,
    RadiusIs,
    RadiusStep,
    Ray,
    Setback,
    Spoke,
    StraightIs,
    Tangent,
    TangentArc,
    TangentCircles,
    TangentLine,
    Through,
    Touches,
    Turn,
    TurnBetween,
    TurnIs,
    UnitDirection,
    Values,
    Vocabulary,
    assemble,
    read_statement,
    write_statement,
)
from contoursolve.geometry.statements.apply import vocabulary_of
from contoursolve.numeric import Functions
from contoursolve.output.document import to_json
from contoursolve.solving import NoClosedFormError, analyse, is_closed, solve as solve_in_closed_form

# Laws of equations ----------------------------------------------------------------------------------------

POINTS, RADII, LINES = "PQRSCD", "rs", "LM"
CIRCLES = ("C", "r"), ("D", "s")
CW, CCW = Turn.CW, Turn.CCW
ALONG, AROUND = Along("L"), Tangent("P", "C", "r", CCW)

FACTS: tuple[Any, ...] = (
    *(Coordinate("length", "P", axis) for axis in (0, 1)),
    *(Offset("length", "P", "Q", axis) for axis in (0, 1)),
    *(Level("P", "Q", axis) for axis in (0, 1)),
    Collinear("P", "Q", "R"),
    Heading("angle", "P", "Q"),
    Ray("angle", "P", "Q"),
    Distance("length", "P", "Q"),
    EqualDistances("", ("P", "Q"), ("R", "S")),
    EqualDistances("", ("P", "Q"), ("Q", "R")),
    OnCircle("P", "C", "r"),
    Radius("length", "r"),
    RadiusStep("length", "r", "s"),
    *(Leaving("L", "P", "C", turn) for turn in Turn),
    *(Spoke("angle", "C", "P", "r", axis, quarters) for axis in (0, 1) for quarters in (0, 3)),
    EqualRadii("", "r", "s"),
    *(kind(*CIRCLES, side) for kind in (TangentCircles, PointBeside) for side in (1, -1, "side")),
    *(Contact("P", "C", "D", side) for side in (1, -1)),
    *(ArcLength("length", "P", "Q", "C", "r", turn) for turn in Turn),
    UnitDirection("L"),
    Directed("angle", "L"),
    Through("L", "P"),
    ParallelLines("L", "M"),
    *(Parallel("L", axis, (("P", "Q"),)) for axis in (0, 1)),
    Foot("L", "P", "C"),
    *(Foot("L", "P", "C", corner="Q", way=way) for way in (1, -1)),
    *(TangentLine("L", "C", "r", side) for side in (1, -1, "side")),
    Extent("length", "L", "P", "Q"),
    *(TangentArc(("D", "s"), turn, "C", "r", side) for turn in Turn for side in (1, -1, "side")),
    *(ArcContact("P", ("D", "s"), turn, "C", "r", 1, "Q", way) for turn in Turn for way in (1, -1)),
    *(Setback("L", "P", "Q", "r", way) for way in (1, -1)),
    *(ChordSetback("C", turn, "P", "Q", "r", way) for turn in Turn for way in (1, -1)),
    *(ChamferLeg("P", "Q", "r", "side", axis, (("R", "S"),)) for axis in (0, 1)),
    TurnBetween("angle", ALONG, Along("M")),
    TurnBetween("angle", ALONG, AROUND),
    TurnBetween("angle", AROUND, ALONG),
    TurnBetween("angle", AROUND, Tangent("P", "D", "s", CW)),
)
OF_AN_AXIS = (Coordinate, Offset, Level, Parallel, ChamferLeg, Spoke)
WITHOUT_LENGTH = (UnitDirection, Directed, Parallel, ParallelLines, TurnBetween)
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

    def lookup(self, scalars: Mapping[str, Any] | None = None, functions: Functions | None = None) -> Values:
        return Values(
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


def gradient(formula: Callable[[Values], Any], place: Place) -> dict[str, float]:
    """By central differences, over every scalar there is."""
    scalars, found = place.scalars(), {}
    for name, value in scalars.items():
        step = 1e-5 * max(1.0, abs(value))
        above, below = (formula(place.lookup({**scalars, name: value + way * step})) for way in (1, -1))
        found[name] = float(above - below) / (2 * step)
    return found


def name_of(fact: Any) -> str:
    details = [str(getattr(fact, name)) for name in ("axis", "side", "turn", "way") if hasattr(fact, name)]
    between = [type(each).__name__ for each in (fact.first, fact.second)] if isinstance(fact, TurnBetween) else []
    return "-".join([type(fact).__name__, *details, *between])


def of_each_fact(*exceptions: type) -> Callable[[Any], Any]:
    facts = [fact for fact in FACTS if not isinstance(fact, exceptions)]
    return pytest.mark.parametrize("fact", facts, ids=name_of)


def test_every_kind_of_equation_has_its_laws_tested() -> None:
    from contoursolve import geometry  # noqa: PLC0415 - only here

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
def test_an_equation_looks_up_nothing_that_is_not_listed(fact: Any) -> None:
    place = random_place(1)
    known = {name: value for name, value in place.scalars().items() if name in fact.reads()}
    assert fact.equation(place.lookup(known)) == fact.equation(place.lookup())


@of_each_fact()
def test_a_sense_looks_up_nothing_that_is_not_listed(fact: Any) -> None:
    place = random_place(1)
    known = {name: value for name, value in place.scalars().items() if name in fact.sense_reads()}
    assert fact.senses(place.lookup(known)) == fact.senses(place.lookup())


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


def moved(place: Place, fact: Any, by: complex) -> Place:
    lines = {name: (u, off + (u.conjugate() * by).imag) for name, (u, off) in place.lines.items()}
    absolute = (by.real, by.imag)[fact.axis] if isinstance(fact, Coordinate) else 0.0
    points = {name: at + by for name, at in place.points.items()}
    return replace(place, points=points, lines=lines, length=place.length + absolute)


def rotated(place: Place, fact: Any, by: float) -> Place:
    turn = complex(cos(by), sin(by))
    points = {name: at * turn for name, at in place.points.items()}
    lines = {name: (u * turn, off) for name, (u, off) in place.lines.items()}
    absolute = 0.0 if isinstance(fact, TurnBetween) else by
    return replace(place, points=points, lines=lines, angle=place.angle + absolute)


def mirrored(place: Place, fact: Any) -> tuple[Place, Any]:
    """The second axis the other way round; what lies on the left is then on the right, and turns are swapped."""
    swaps_side = isinstance(fact, TangentLine | TangentArc | ArcContact) or (
        isinstance(fact, ChamferLeg) and fact.axis == 1
    )
    if swaps_side and isinstance(fact.side, int):
        fact = replace(fact, side=-fact.side)
    if isinstance(fact, ArcLength | TangentArc | ArcContact | ChordSetback | Leaving):
        fact = replace(fact, turn=CW if fact.turn is CCW else CCW)
    if isinstance(fact, Spoke):
        fact = replace(fact, quarters=-fact.quarters)
    if isinstance(fact, TurnBetween):
        fact = replace(fact, first=other_way(fact.first), second=other_way(fact.second))
    negates = isinstance(fact, Coordinate | Offset) and fact.axis == 1
    return (
        replace(
            place,
            points={name: at.conjugate() for name, at in place.points.items()},
            lines={name: (u.conjugate(), -off) for name, (u, off) in place.lines.items()},
            angle=-place.angle,
            length=-place.length if negates else place.length,
            side=-place.side if swaps_side else place.side,
        ),
        fact,
    )


def other_way(direction: Any) -> Any:
    return (
        replace(direction, turn=CW if direction.turn is CCW else CCW) if isinstance(direction, Tangent) else direction
    )


def scaled(place: Place, by: float) -> Place:
    return replace(
        place,
        points={name: at * by for name, at in place.points.items()},
        radii={name: radius * by for name, radius in place.radii.items()},
        lines={name: (u, off * by) for name, (u, off) in place.lines.items()},
        length=place.length * by,
    )


@of_each_fact()
def test_a_shift_of_everything_changes_nothing(fact: Any) -> None:
    for seed in range(20):
        place = random_place(seed)
        there = moved(place, fact, complex(70.25, -33.5))
        assert residual(fact, there) == pytest.approx(residual(fact, place), abs=1e-9)
        assert senses(fact, there) == pytest.approx(senses(fact, place), abs=1e-9)


@of_each_fact(*OF_AN_AXIS)
def test_a_rotation_of_everything_changes_nothing(fact: Any) -> None:
    for seed in range(20):
        place = random_place(seed)
        there = rotated(place, fact, 2.0)
        assert residual(fact, there) == pytest.approx(residual(fact, place), abs=1e-9)
        assert senses(fact, there) == pytest.approx(senses(fact, place), abs=1e-9)


@of_each_fact()
def test_a_mirror_image_with_its_sides_swapped_is_as_true(fact: Any) -> None:
    for seed in range(20):
        place = random_place(seed)
        there, swapped = mirrored(place, fact)
        assert abs(residual(swapped, there)) == pytest.approx(abs(residual(fact, place)), abs=1e-9)
        assert senses(swapped, there) == pytest.approx(senses(fact, place), abs=1e-9)


@of_each_fact()
def test_the_residual_scales_with_the_drawing(fact: Any) -> None:
    for seed in range(20):
        place = random_place(seed)
        factor = 1.0 if isinstance(fact, WITHOUT_LENGTH) else 3.0
        assert residual(fact, scaled(place, 3.0)) == pytest.approx(factor * residual(fact, place), abs=1e-9)
        there = scaled(place, 3.0)
        assert [each > 0 for each in senses(fact, there)] == [each > 0 for each in senses(fact, place)]


@law(st.integers(0, 2**32))
def test_the_implied_value_makes_a_fact_true_in_its_sense(seed: int) -> None:
    place = random_place(seed)
    for fact in FACTS:
        if not fact.given:
            continue
        at = place
        if isinstance(fact, ArcLength | Spoke):  # on this circle alone
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
    assert Heading("angle", "P", "Q").implied(together.lookup()) is None


# Drawings told backwards by statements --------------------------------------------------------------------

ENOUGH = 10
"""Drawings of each kind of fact that must come back, of all that are drawn."""
FEW_OR_ENOUGH = pytest.mark.parametrize("enough", [1, pytest.param(ENOUGH, marks=pytest.mark.slow)])

ARC_LENGTH = "length of an arc"
PAIRED = ("angle", "tangent", "equal length", "equal radius")


Told = tuple[Chain, list[Fact]]


def told(seed: int, size: int, swaps: int) -> Told:
    rng = Random(seed)
    chain = random_chain(rng, size, offset=rng.choice((0, 100)))
    return chain, random_facts(chain, rng, swaps)


def drawn(size: int, swaps: Callable[[int], int], kinds: Collection[str], limit: int) -> list[Told]:
    """Drawings with facts, as many as there are until each of the kinds was told `limit` times."""
    found, counts = [], Counter[str]()
    for seed in range(3_000):
        chain, facts = told(seed, size, swaps(seed))
        new = {kind_of(chain, fact) for fact in facts} & set(kinds)
        if new and min(counts[kind] for kind in new) < limit:
            counts.update(new)
            found.append((chain, facts))
            if min(counts[kind] for kind in kinds) >= limit:
                break
    return found


def kind_of(chain: Chain, fact: Fact) -> str:
    return ARC_LENGTH if fact.kind == "length" and chain.is_arc(fact.elements[0]) else fact.kind


def misses(chain: Chain, facts: list[Fact], drawing: Chain) -> float:
    return max(map(abs, [*form_residuals(drawing), *(measure(drawing, fact) for fact in facts)]))


@cache
def singles() -> tuple[tuple[Chain, tuple[Fact, ...]], ...]:
    return tuple((chain, tuple(facts)) for chain, facts in (told(seed, 1, 1 + seed % 3) for seed in range(330)))


@cache
def doubles() -> tuple[tuple[Chain, tuple[Fact, ...]], ...]:
    """Two elements each, with one fact about both."""
    found = []
    counts = Counter[str]()
    for seed in range(3_000):
        chain, facts = told(seed, 2, 1)
        kinds = {fact.kind for fact in facts} & set(PAIRED)
        if kinds and min(counts[kind] for kind in kinds) < ENOUGH + 8:
            counts.update(kinds)
            found.append((chain, tuple(facts)))
            if min(counts[kind] for kind in PAIRED) >= ENOUGH + 8:
                break
    return tuple(found)


def come_back(cases: Iterable[Told]) -> Counter[str]:
    """How often each kind of fact was part of a drawing that came back; a list without doubt has the drawing."""
    kinds = Counter[str]()
    for chain, facts in cases:
        texts = [fact.text for fact in facts]
        drawings = sketch_of(chain, facts).solve()
        found = [chain_of(drawing, chain) for drawing in drawings]
        assert all(misses(chain, facts, drawing) < 1e-7 for drawing in found), texts
        nearest = min((distance_between(drawing, chain) for drawing in found), default=1e9)
        assert nearest < 1e-6 or not drawings.is_complete, texts
        if nearest < 1e-6:
            kinds.update({kind_of(chain, fact) for fact in facts})
    return kinds


@FEW_OR_ENOUGH
def test_a_drawing_of_one_element_comes_back_from_facts_of_every_kind(enough: int) -> None:
    kinds = [*(kind for kind in KINDS if kind not in PAIRED), ARC_LENGTH]
    count = come_back(drawn(1, lambda seed: 1 + seed % 3, kinds, enough + 1))
    assert min(count[kind] for kind in kinds) >= enough, count


@FEW_OR_ENOUGH
def test_a_drawing_of_two_elements_comes_back_from_a_fact_about_both(enough: int) -> None:
    count = come_back(drawn(2, lambda _: 1, PAIRED, enough + 1))
    assert min(count[kind] for kind in PAIRED) >= enough, count


def beside(chain: Chain, number: int, rng: Random) -> str:
    """A place that an element passes at some distance, and the distance as it is."""
    place = complex(rng.randint(-60, 60), rng.randint(-60, 60))
    if chain.is_arc(number):
        arc = chain.arc(number)
        distance = abs(abs(place - arc.center) - arc.radius)
    else:
        start, travel = chain.line(number)
        distance = abs((travel.conjugate() * (place - start)).imag) / abs(travel)
    return f"E{number} passes beside [X{place.real} Y{place.imag}] at {distance:.12f}"


def measured(chain: Chain, rng: Random) -> list[str]:
    """Facts of further kinds, with what is measured of a drawing."""
    facts = [beside(chain, number, rng) for number in chain.numbers]
    for number in chain.arcs:
        center, ends = chain.arc(number).center, chain.points[number - 1 : number + 1]
        facts.append(f"chord of E{number} = {abs(ends[1] - ends[0]):.12f}")
        for part, end in zip(("begin of ", ""), ends, strict=True):
            facts.append(f"polar angle of {part}E{number} = {degrees(phase(end - center)):.12f}")
    return facts


@law(st.integers(0, 2**32), few=2, many=13)
def test_a_fact_that_is_measured_on_a_drawing_is_true_of_it_and_adds_nothing(seed: int) -> None:
    rng = Random(seed)
    chain = random_chain(rng, rng.randint(1, 3))
    facts = standard_facts(chain)
    before = sketch_of(chain, facts).solve()
    for text in measured(chain, rng):
        sketch = sketch_of(chain, facts)
        sketch.state(text)
        after = sketch.solve()
        assert min(distance_between(chain_of(drawing, chain), chain) for drawing in after) < 1e-6, text
        assert not before.ties, text
        assert len(facts) in after.ties, text  # the last one repeats others
        # What is measured asks for the same value, but for whole turns.
        asking = sketch_of(chain, facts)
        if "=" in text:
            asking.state(f"{text.partition('=')[0]}= ?")
            values = [drawing.asked[0].value or 0.0 for drawing in asking.solve()]
            assert min(abs(value - float(text.partition("=")[2])) for value in values) < 1e-6, text


@law(st.integers(0, 2**32), few=2, many=13)
def test_a_point_beside_an_element_is_as_far_from_it_as_stated_on_either_side(seed: int) -> None:
    rng = Random(seed)
    radius, distance, place = rng.randint(5, 30), rng.randint(1, 40), complex(rng.randint(-60, 60), 0)
    line, circle = Sketch(), Sketch()
    line.infinite_line("e")
    line.state(f"direction of e = {rng.randint(-89, 89)}")
    circle.circle("e")
    for fact in (f"radius of e = {radius}", f"X of center of e = {rng.randint(-60, 60)}"):
        circle.state(fact)
    for sketch in (line, circle):
        sketch.state(f"e passes [X{place.real} Y0] at {distance}")
        for drawn in sketch.solve():
            if drawn.radii:
                off = abs(abs(complex(*drawn.points["e.center"]) - place) - radius)
            else:
                cosine, sine, offset = drawn.lines["e"]
                off = abs(cosine * place.imag - sine * place.real - offset)
            assert off == pytest.approx(distance, abs=1e-9)
    assert len(line.solve()) == 2


@law(st.integers(0, 2**32), few=2, many=6)
def test_a_parallel_line_is_as_far_away_as_measured(seed: int) -> None:
    """Of four corners the last one is left open, and comes back from how far its side is from the first."""
    rng = Random(seed)
    corners = [complex(rng.uniform(-60, 60), rng.uniform(-60, 60)) for _ in range(3)]
    way = corners[1] - corners[0]
    share = rng.choice((1, -1)) * rng.uniform(0.2, 2)
    apart = abs((way.conjugate() * (corners[2] - corners[0])).imag) / abs(way)
    last = corners[2] + share * way
    if min(apart, abs(way), abs(corners[2] - corners[1])) < 1:
        return
    for fact in ("c parallel to a", f"c parallel to a at {apart:.12f}"):
        sketch = Sketch((corners[0].real, corners[0].imag))
        for name in "abc":
            sketch.line(name)
        for name, at in (("P1", corners[1]), ("P2", corners[2])):
            sketch.state(f"X of {name} = {at.real:.12f}")
            # The distance says where P2 is, but for the side.
            if not (name == "P2" and "at" in fact):
                sketch.state(f"Y of {name} = {at.imag:.12f}")
        sketch.state(f"X of P3 = {last.real:.12f}")
        sketch.state(fact)
        drawings = sketch.solve()
        assert drawings.is_complete
        assert min(abs(complex(*drawn.points["P3"]) - last) for drawn in drawings) < 1e-6
        sketch.state(f"c parallel to a at {apart:.12f}")
        assert min(abs(complex(*drawn.points["P3"]) - last) for drawn in sketch.solve()) < 1e-6


def test_a_fact_against_the_direction_that_a_word_states_is_no_repetition() -> None:
    for fact in ("direction of line 2 = -60", "angle from line 1 to line 2 = 120"):
        (answer,) = solve("G111 A180. K-30. B120. X100.", start=START, facts=[fact]).answers
        assert answer.status.value == "conflicting"


def test_no_arc_is_longer_than_its_circle() -> None:
    """A circle of radius 3 about a given centre through the start: its arcs are shorter than 18.85 mm."""
    sketch = Sketch()
    sketch.arc("E1", "ccw")
    for fact in ("X of center of E1 = 0", "Y of center of E1 = 3", "length of E1 = 30"):
        sketch.state(fact)
    assert [drawing.contour.elements[0].length for drawing in sketch.solve() if drawing.contour] == []


def test_two_lines_come_back_from_the_angle_between_them() -> None:
    """X of P1 is close to 10.3: at 10 the turn is 18.4 degrees, at 11 it is 23.6."""
    sketch = Sketch()
    sketch.line("E1")
    sketch.line("E2")
    for fact in ("Y of P1 = 5", "X of P2 = 20", "Y of P2 = 15", "angle from E1 to E2 = 20"):
        sketch.state(fact)
    drawings = sketch.solve()
    assert len(drawings) > 0 or not drawings.is_complete
    assert any(10 < drawing.points["P1"][0] < 11 for drawing in drawings)


# What may change without changing the drawing -------------------------------------------------------------

START = "X40. Z0."
PROGRAMS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("G111 X100. A180. K-30. B120. P?", ("straight part of line 2 = 30", "length of line 1 = ?")),
    ("G111 A180. B120. X100. P5. Q2.", ("Z of V1 = -30", "direction of line 2 = ?")),
    ("G111 X100. Z-47. B120.", ("length of line 1 = 30",)),
    ("G111 A180. K-30. B120. X100. P? Q?", ("radius of corner 1 = 3", "radius of corner 1 = radius of corner 2")),
    ("G111 A180. K-30. B120. P4. Q?", ("Z of center of corner 2 = -50", "X of V2 = 100", "corner 2 meets line at 180")),
    ("G111 A180. K-30. B? X100. P4.", ("line 2 passes through (Z-40. X70.)", "radius of corner 1 = ?")),
    ("G111 A180. K-30. B120. X100.", ("length of line 1 = 30", "X of S = 40")),
    ("G111 A180. K-30. B120. X100.", ("length of line 1 = 31",)),
    ("G111 A180. K-30. B120.", ("length of line 1 = ?",)),
    ("G111 A180. K-30. B120. P3.", ("length of line 2 = 20", "radius of line 2 = 4")),
)
STATEMENTS: Mapping[str, Any] = {
    "straight part of line 2 = 30": StraightIs("line 2", Decimal(30)),
    "length of line 1 = ?": LengthIs("line 1", None),
    "Z of V1 = -30": PointIs("", "V1", 0, Decimal(-30)),
    "direction of line 2 = ?": DirectionIs("line 2", None),
    "length of line 1 = 30": LengthIs("line 1", Decimal(30)),
    "radius of corner 1 = 3": RadiusIs("corner 1", Decimal(3)),
    "radius of corner 1 = radius of corner 2": EqualSizes("corner 1", "corner 2"),
    "Z of center of corner 2 = -50": PointIs("center", "corner 2", 0, Decimal(-50)),
    "X of V2 = 100": PointIs("", "V2", 1, Decimal(50)),
    "corner 2 meets line at 180": MeetsLine("corner 2", Meeting(None, Decimal(180))),
    "line 2 passes through (Z-40. X70.)": PassesThrough("line 2", (Decimal(-40), Decimal(35))),
    "radius of corner 1 = ?": RadiusIs("corner 1", None),
    "X of S = 40": PointIs("", "S", 1, Decimal(20)),
    "length of line 1 = 31": LengthIs("line 1", Decimal(31)),
    "length of line 2 = 20": LengthIs("line 2", Decimal(20)),
    "radius of line 2 = 4": RadiusIs("line 2", Decimal(4)),
}


MORE_STATEMENTS = (
    "line 2 passes beside [Z-40. X80.] at 5",
    "line 2 parallel to line 1",
    "line 2 parallel to line 1 at 10.5",
    "chord of corner 1 = 6",
    "chord of corner 1 = ?",
    "polar angle of corner 1 = 90",
    "polar angle of begin of corner 1 = ?",
    "angle from line 1 to line 2 = -60.5",
    "X of begin of corner 1 = 44",
    "length of line 1 = length of line 2",
    "line 1 tangent to line 2",
    "line 2 tangent to circle [Z-40. X120. R10.]",
    "corner 1 tangent to line [Z0. X30. A180.]",
    "corner 2 meets next line",
    "corner 2 meets line to [Z-60. X130.]",
)


def essence(program: str, *facts: Any, start: str = START) -> dict[str, Any]:
    """The document without what tells where and in which words something was stated."""
    document = json.loads(to_json(solve(program, start=start, facts=facts)))
    (contour,) = document["contours"]
    asked = sorted((each["unit"], str(each["value"])) for each in contour.pop("asked"))
    for name in ("facts", "lines", "line", "diagnosis", "filled"):
        contour.pop(name)
    for solution in contour["solutions"]:
        solution["asked"] = sorted((each["unit"], str(each["value"])) for each in solution.get("asked", ()))
    codes = sorted((each["code"], each["severity"]) for each in document["diagnostics"])
    return {**contour, "asked": asked, "codes": codes}


@pytest.mark.parametrize(("block", "facts"), PROGRAMS)
def test_the_order_of_words_and_facts_does_not_matter(block: str, facts: tuple[str, ...]) -> None:
    expected = essence(block, *facts)
    code, *words = block.split()
    for order in permutations(facts):
        assert essence(" ".join((code, *reversed(words))), *order) == expected


@pytest.mark.parametrize(("block", "facts"), PROGRAMS)
def test_facts_mean_the_same_in_a_comment_apart_and_as_objects(block: str, facts: tuple[str, ...]) -> None:
    expected = essence(block, *facts)
    inside = [fact.replace("(", "[").replace(")", "]") for fact in facts]
    assert essence(f"{block} (contoursolve: {'; '.join(inside)})") == expected
    assert essence(block + "".join(f" (Contoursolve :{fact})" for fact in inside)) == expected
    assert essence(f"(contoursolve: {inside[0]}) {block}", *facts[1:]) == expected
    assert essence(block, *(STATEMENTS[fact] for fact in facts)) == expected
    assert essence(block, *(fact.upper() for fact in facts)) == expected


@pytest.mark.parametrize(("fact", "statement"), [*STATEMENTS.items()])
def test_a_statement_is_what_its_text_says(fact: str, statement: Any) -> None:
    profile = solve("G111 A180. K-30. B120. X100. P5. Q5.", start=START).answers[0].profile
    assert read_statement(fact, vocabulary_of(profile)) == statement


@pytest.mark.parametrize(("block", "facts"), PROGRAMS)
def test_a_shift_of_everything_shifts_the_contour(block: str, facts: tuple[str, ...]) -> None:
    """By 7 mm along Z and 6 mm of diameter along X; words and facts that state a place move with it."""

    def shifted(text: str) -> str:
        for axis, at, there in (("X of ", "100", "106"), ("X of ", "40", "46"), ("Z of ", "-30", "-23")):
            text = text.replace(f" = {at}", f" = {there}") if text.startswith(axis) else text
        text = text.replace("Z of center of corner 2 = -50", "Z of center of corner 2 = -43")
        return text.replace("X100.", "X106.").replace("Z-47.", "Z-40.").replace("Z-40. X70.", "Z-33. X76.")

    here, there = essence(block, *facts), essence(shifted(block), *map(shifted, facts), start="X46. Z7.")
    assert (there["status"], there["codes"]) == (here["status"], here["codes"])
    assert len(there["solutions"]) == len(here["solutions"])
    for mine, theirs in zip(here["solutions"], there["solutions"], strict=True):
        for one, other in zip(mine["elements"], theirs["elements"], strict=True):
            assert other["end"] == pytest.approx([one["end"][0] + 7, one["end"][1] + 3], abs=1e-9)
            assert one["kind"] == other["kind"]
            assert one.get("turn") == other.get("turn")


@pytest.mark.parametrize("unit", Length)
@pytest.mark.parametrize("fact", [*STATEMENTS, *MORE_STATEMENTS])
def test_a_statement_is_written_as_a_text_that_reads_as_itself(fact: str, unit: Length) -> None:
    profile = solve("G111 A180. K-30. B120. X100. P5. Q5.", start=START).answers[0].profile
    words = replace(vocabulary_of(profile), unit=unit)
    statement = read_statement(fact, words)
    text = write_statement(statement, words.plane, unit)
    assert read_statement(text, words) == statement
    assert not set("()") & set(text)


NAMES = "line 1", "line 2", "arc", "corner 1", "k"
VALUE = st.integers(-9_999_999, 9_999_999).map(lambda thousandths: Decimal(thousandths) * Decimal("0.0254"))
"""mm: with few digits in inches, too."""
NAME = st.sampled_from(NAMES)
GIVEN = st.builds(CircleAt, st.tuples(VALUE, VALUE), VALUE.map(abs)) | st.builds(LineAt, st.tuples(VALUE, VALUE), VALUE)
ALL_STATEMENTS = st.one_of(
    st.builds(PassesBeside, NAME, st.tuples(VALUE, VALUE), VALUE),
    st.builds(PassesThrough, NAME, st.tuples(VALUE, VALUE)),
    st.builds(ParallelTo, NAME, NAME, st.none() | VALUE),
    *(st.builds(kind, NAME, st.none() | VALUE) for kind in (ChordIs, DirectionIs, LengthIs, RadiusIs, StraightIs)),
    st.builds(PolarAngleIs, NAME, st.none() | VALUE, st.sampled_from(("begin", "end"))),
    st.builds(TurnIs, NAME, NAME, st.none() | VALUE),
    st.builds(PointIs, st.sampled_from(("", "begin", "end", "center")), NAME, st.integers(0, 1), st.none() | VALUE),
    st.builds(EqualLengths, NAME, NAME),
    st.builds(EqualSizes, NAME, NAME),
    st.builds(Touches, NAME, NAME | GIVEN),
    st.builds(LiesOn, st.sampled_from(("begin", "end", "center")), NAME, NAME | GIVEN),
    st.builds(MeetsLine, NAME, st.builds(Meeting, st.none(), st.none() | VALUE)),
    st.builds(MeetsLine, NAME, st.builds(Meeting, st.tuples(VALUE, VALUE), st.none())),
)


@law(ALL_STATEMENTS, st.sampled_from(Length), st.booleans(), few=6, many=66)
def test_every_statement_is_written_as_a_text_that_reads_as_itself(statement: Any, unit: Length, turned: bool) -> None:
    axes = ("Z", "X") if turned else ("X", "Y")
    words = Vocabulary(NAMES, NAMES, Plane("", axes, ("K", "I"), (False, turned)), unit)
    text = write_statement(statement, words.plane, unit)
    assert read_statement(text, words) == statement


def test_statements_as_objects_are_shown_as_text() -> None:
    facts = [STATEMENTS["X of V2 = 100"], STATEMENTS["length of line 1 = 31"]]
    result = solve("G111 A180. K-30. B120.", start=START, facts=facts)
    assert [each.text for each in result.facts] == ["X of V2 = 100", "length of line 1 = 31"]
    assert "length of line 1 = 31 disagrees with" in result.diagnostics[0].message


STATING = ("A180.", "K-30.", "B120.", "X100.", "P5.")
STATED = (
    "length of line 1 = 30",
    "length of line 2 = 40",
    "length of line 1 = length of line 2",
    "distance from S to V2 = 60",
    "straight part of line 2 = 20",
    "angle between line 1 and line 2 = 60",
    "line 2 passes through [Z-40. X80.]",
    "X of V1 = 44",
)


@pytest.mark.parametrize("stride", [31, pytest.param(3, marks=pytest.mark.slow)])
def test_whatever_has_a_closed_form_is_solved_by_it_and_nothing_else_is_said_to_have_one(stride: int) -> None:
    seen: Counter[bool] = Counter()
    every = [words for size in range(2, 6) for words in combinations(STATING, size)]
    facts = [*((each,) for each in STATED), *combinations(STATED[:6], 2)]
    for words, stated in list(product(every, facts))[::stride]:
        text = " ".join(("G111", *words, *(f"(contoursolve: {each})" for each in stated)))
        (answer,) = solve(text, start="X40. Z0.", rules="off", depth="verdict").answers
        system = assemble(answer.profile)
        if not analyse(system).is_determined:
            continue
        seen[is_closed(system)] += 1
        if is_closed(system):
            solution = solve_in_closed_form(answer.profile, is_proven=False)
            assert solution.points or solution.refusals
        else:
            with pytest.raises(NoClosedFormError):
                solve_in_closed_form(answer.profile, is_proven=False)
    assert min(seen[True], seen[False]) > 50 // stride
