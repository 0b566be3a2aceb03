"""The oracles of the constraint engine, held against each other and against drawings that need no computer."""

import re
from collections import Counter
from itertools import pairwise
from math import hypot, sqrt
from random import Random

import numpy
import pytest
from chains import (
    KINDS,
    Arc,
    Chain,
    Fact,
    Line,
    all_facts,
    condition,
    distance_between,
    fact_of,
    form_residuals,
    measure,
    newton,
    perturbed,
    random_chain,
    random_facts,
    rank,
    residuals,
    solutions,
    standard_facts,
    turn_between,
    with_values,
)
from oracle_apollonius import (
    KNOWN,
    Circle,
    EndlessError,
    Line as Endless,
    Point,
    Thing,
    circles_of_radius,
    gap,
    intersections,
    random_things,
    relative_gap,
    tangent_circles,
    tangent_lines,
    touching_things,
)

BRACKET = Chain(
    (0j, 10 + 0j, 15 + 5j, 15 + 15j, 11 + 13j),
    (Line(), Arc("ccw", 10 + 5j, 5.0), Line(), Arc("cw", 10 + 15j, 5.0)),
)
"""To the right, a quarter to the left, up; then back, on a part of a circle, clockwise, whose end misses it."""


def many(count: int, first: int = 0) -> list[tuple[Random, Chain]]:
    found = []
    for seed in range(first, first + count):
        random = Random(seed)
        scale = 10 ** random.choice((0, 0, 0, random.uniform(-3, 3)))
        size = random.randint(1, 8)
        found.append((random, random_chain(random, size, offset=random.choice((0, 1e3)) * min(1, scale), scale=scale)))
    return found


# Chains


@pytest.mark.parametrize(
    ("kind", "elements", "values", "misses"),
    [
        ("x of point", (2,), (15,), 0),
        ("y of point", (2,), (4.5,), 0.5),
        ("x of center", (2,), (9,), 1),
        ("y of center", (4,), (15,), 0),
        ("radius", (2,), (5.25,), -0.25),
        ("direction", (1,), (350,), 10),
        ("direction", (3,), (-270,), 0),
        ("length", (3,), (12,), -2),
        ("length", (2,), (2.5 * numpy.pi,), 0),
        ("angle", (1, 3), (90,), 0),
        ("angle", (3, 1), (-80,), -10),
        ("angle", (1, 2), (3,), -3),
        ("angle", (3, 4), (-179,), -1),
        ("tangent", (2, 3), (), 0),
        ("tangent", (3, 4), (), 180),
        ("passes through", (1,), (-100, 0), 0),
        ("passes through", (3,), (14, 99), 1),
        ("passes through", (2,), (2, 5), 3),
        ("tangent to circle", (1,), (7, -3, 3), 0),
        ("tangent to circle", (1,), (7, 3, 2), 1),
        ("tangent to circle", (2,), (18, 5, 3), 0),
        ("tangent to circle", (2,), (12, 5, 3), 0),
        ("tangent to circle", (2,), (0, 5, 16), -1),
        ("tangent to line", (2,), (77, 0, 180), 0),
        ("tangent to line", (4,), (4, 0, 90), 1),
        ("equal length", (1, 3), (), 0),
        ("equal radius", (2, 4), (), 0),
    ],
)
def test_a_drawing_that_needs_no_computer_is_measured_right(
    kind: str, elements: tuple[int, ...], values: tuple[float, ...], misses: float
) -> None:
    assert measure(BRACKET, fact_of(kind, elements, [float(value) for value in values])) == pytest.approx(
        misses, abs=1e-12
    )


def test_the_ends_of_arcs_are_measured_against_their_circles() -> None:
    assert form_residuals(BRACKET) == pytest.approx([0, 0, 0, sqrt(5) - 5])


def test_every_fact_that_is_said_to_be_true_of_a_chain_is() -> None:
    kinds = Counter[str]()
    for random, chain in many(200):
        facts = all_facts(chain, random)
        kinds.update(fact.kind for fact in facts)
        reach = max(map(abs, chain.points)) / chain.extent
        for fact in facts:
            assert abs(measure(chain, fact)) < 1e-13 * reach * 100 * max(1, chain.extent), fact
        assert max(map(abs, form_residuals(chain)), default=0) < 1e-14 * reach * chain.extent * 10
    assert set(kinds) == set(KINDS)


def test_a_fact_with_another_number_is_missed_by_the_difference() -> None:
    scalars = {"x of point", "y of point", "x of center", "y of center", "radius", "length", "direction", "angle"}
    for random, chain in many(20):
        for fact in all_facts(chain, random):
            if not fact.values:
                continue
            step = 1e-3 * chain.extent
            other = measure(chain, with_values(fact, [*fact.values[:-1], fact.values[-1] + step]))
            if fact.kind in scalars:
                assert other == pytest.approx(-step, rel=1e-6)
            elif fact.kind == "tangent to circle":
                assert abs(other) == pytest.approx(step, rel=1e-6)


def test_a_text_holds_its_numbers_to_the_last_bit() -> None:
    for random, chain in many(50):
        for fact in all_facts(chain, random):
            names = re.compile(r"\b[PE]\d+")
            numbers = re.findall(r"-?\d+(?:\.\d+)?", names.sub("", fact.text))
            assert tuple(map(float, numbers)) == fact.values, fact
            assert "e" not in "".join(numbers)


def test_chains_are_without_accidents() -> None:
    smooth = 0
    for seed in range(200):
        chain = random_chain(Random(seed), 1 + seed % 8, scale=2.0)
        assert all(10 <= chain.length(n) * (1 + 1e-9) <= 121 for n in chain.lines)
        assert all(10 <= chain.arc(n).radius <= 80 and 19.9 < chain.sweep(n) < 300.1 for n in chain.arcs)
        for first, second in pairwise(chain.numbers):
            turn = abs(turn_between(chain, first, second))
            smooth += turn < 1e-9
            assert turn < 1e-9 or 14.9 < turn < 150.1
    assert 100 < smooth < 400


def test_standard_facts_are_as_many_as_determine_a_chain() -> None:
    for _, chain in many(60):
        facts = standard_facts(chain)
        assert len(facts) == chain.freedom
        assert condition(chain, facts) > 1e-4
        assert condition(chain, facts[1:]) == 0.0
        assert rank(chain, facts[1:]) == len(chain.variables) - 1


@pytest.mark.slow
def test_random_facts_determine_the_chain_and_come_again_with_their_seed() -> None:
    kinds = Counter[str]()
    for random, chain in many(60, 1000):
        swaps, seed = random.randint(0, chain.freedom), random.random()
        facts = random_facts(chain, Random(seed), swaps)
        assert facts == random_facts(chain, Random(seed), swaps)
        assert len({fact.text for fact in facts}) == len(facts) == chain.freedom
        assert condition(chain, facts) > 1e-6
        standard = {fact.text for fact in standard_facts(chain)}
        assert sum(fact.text not in standard for fact in facts) <= swaps
        if len(chain.elements) > 1:
            assert sum(fact.text not in standard for fact in facts) == swaps
        kinds.update(fact.kind for fact in facts)
    assert set(kinds) == set(KINDS)


def test_newton_comes_back_to_the_chain_and_finds_others() -> None:
    others = 0
    for seed in range(12):
        random = Random(seed)
        chain = random_chain(random, random.randint(1, 3))
        facts = random_facts(chain, random, 4, floor=1e-3)
        found = newton(perturbed(chain, random, 1e-5, 0.0), facts)
        assert found is not None
        assert distance_between(found, chain) < 1e-7
        known = solutions(chain, facts, random, starts=5)
        assert known[0] is chain
        others += len(known) - 1
        for other in known:
            assert max(map(abs, residuals(other, facts))) < 1e-7
    assert others


def test_an_unknown_fact_is_an_error() -> None:
    with pytest.raises(ValueError, match="colour"):
        measure(BRACKET, Fact("colour", (1,), (), ""))


# Circles and lines that touch


@pytest.mark.parametrize(
    ("things", "count"), [(things, count) for _, things, count in KNOWN], ids=[k[0] for k in KNOWN]
)
def test_known_configurations_have_their_number_of_circles(things: tuple[Thing, ...], count: int | None) -> None:
    for order in ((0, 1, 2), (2, 0, 1), (1, 0, 2)):
        three = [things[place] for place in order]
        if count is None:
            with pytest.raises(EndlessError):
                tangent_circles(*three)
        else:
            assert len(tangent_circles(*three)) == count


def test_soddys_circles_of_radii_1_2_3() -> None:
    """Descartes: the curvatures are 1 + 1/2 + 1/3 and twice the root of their products, added or taken away."""
    three = Circle(0, 0, 1), Circle(3, 0, 2), Circle(0, 4, 3)
    assert sorted(float(c.r) for c in tangent_circles(*three)) == pytest.approx([6 / 23, 6])
    assert len(tangent_circles(*three, keep_given=True)) == 5


KINDS_OF_THREE = ("CCC", "CCL", "CLL", "LLL", "PPP", "PPL", "PLL", "PCC", "PPC", "PCL")


@pytest.mark.parametrize("kinds", KINDS_OF_THREE)
def test_circles_touch_what_they_have_to(kinds: str) -> None:
    for seed in range(12):
        things = random_things(Random(f"{kinds} {seed}"), kinds)
        found = tangent_circles(*things)
        assert len(found) <= 2 ** sum(kind != "P" for kind in kinds)
        for circle in found:
            assert all(relative_gap(circle, thing) < 1e-30 for thing in things)
            rounded = Circle(*map(float, circle))
            assert all(relative_gap(rounded, thing) < 1e-9 for thing in things)


@pytest.mark.parametrize("kinds", KINDS_OF_THREE)
def test_a_circle_that_touches_by_construction_is_found(kinds: str) -> None:
    for seed in range(12):
        circle, things = touching_things(Random(f"{kinds} {seed}"), kinds)
        size = max(map(abs, circle))
        misses = [max(abs(a - b) for a, b in zip(circle, one, strict=True)) for one in tangent_circles(*things)]
        assert min(misses) < 1e-7 * size


@pytest.mark.parametrize("count", [1, pytest.param(12, marks=pytest.mark.slow)])
def test_no_search_finds_a_circle_that_the_closed_form_does_not(count: int) -> None:
    hits = 0
    for kinds in KINDS_OF_THREE:
        random = Random(kinds)
        things = [
            Circle(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 0.6))
            if kind == "C"
            else Point(random.uniform(-1, 1), random.uniform(-1, 1))
            if kind == "P"
            else Endless(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 180))
            for kind in kinds
        ]
        known = tangent_circles(*things)
        for _ in range(count):
            found = searched([random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0.1, 2)], things)
            if found is not None:
                hits += 1
                assert any(max(abs(a - b) for a, b in zip(found, one, strict=True)) < 1e-6 for one in known), things
    assert hits > 2 * count


def searched(start: list[float], things: list[Thing]) -> Circle | None:
    def gaps(place: numpy.ndarray) -> numpy.ndarray:
        return numpy.array([float(gap(Circle(*map(float, place)), thing)) for thing in things])

    place = numpy.array(start)
    for _ in range(25):
        rows = numpy.column_stack([(gaps(place + s) - gaps(place - s)) / 2e-6 for s in 1e-6 * numpy.eye(3)])
        step = numpy.linalg.lstsq(rows, -gaps(place), rcond=None)[0]
        place = place + step * min(1, 1 / hypot(*step)) if step.any() else place
    is_same = any(isinstance(thing, Circle) and hypot(*(place - thing)) < 1e-6 for thing in things)
    return Circle(*place) if abs(gaps(place)).max() < 1e-10 and 1e-3 < place[2] < 100 and not is_same else None


@pytest.mark.parametrize(
    ("one", "other", "count"),
    [
        (Circle(0, 0, 1), Circle(4, 0, 2), 4),
        (Circle(0, 0, 1), Circle(4, 0, 3), 3),
        (Circle(0, 0, 1), Circle(4, 3, 4), 3),
        (Circle(0, 0, 2), Circle(2, 0, 1), 2),
        (Circle(0, 0, 3), Circle(2, 0, 1), 1),
        (Circle(0, 0, 3), Circle(1, 0, 1), 0),
        (Circle(0, 0, 3), Circle(0, 0, 1), 0),
        (Circle(0, 0, 1), Circle(3, 0, 1), 4),
        (Circle(0, 0, 1), Point(3, 0), 2),
        (Circle(0, 0, 5), Point(3, 4), 1),
        (Point(0, 0), Circle(0.5, 0.5, 1), 0),
        (Point(0, 0), Point(1, 7), 1),
    ],
)
def test_lines_that_touch_two_circles_are_4_3_2_1_or_none(
    one: Circle | Point, other: Circle | Point, count: int
) -> None:
    for first, second in ((one, other), (other, one)):
        found = tangent_lines(first, second)
        assert len(found) == count
        for line in found:
            assert relative_gap(line, first) < 1e-30
            assert relative_gap(line, second) < 1e-30


@pytest.mark.parametrize(
    ("one", "other", "count"),
    [
        (Circle(0, 0, 5), Endless(0, 4, 0), 2),
        (Circle(0, 0, 5), Endless(9, 5, 180), 1),
        (Circle(0, 0, 5), Endless(9, 5 + 1e-15, 180), 0 if 5 + 1e-15 > 5 else 1),
        (Circle(0, 0, 5), Endless(0, 6, 0), 0),
        (Circle(0, 0, 5), Circle(8, 0, 5), 2),
        (Circle(0, 0, 1), Circle(3, 4, 4), 1),
        (Circle(0, 0, 6), Circle(3, 4, 1), 1),
        (Circle(0, 0, 6), Circle(3, 4, 0.5), 0),
        (Circle(0, 0, 6), Circle(0, 0, 5), 0),
        (Endless(0, 0, 30), Endless(5, 0, 100), 1),
        (Endless(0, 0, 30), Endless(5, 0, -150), 0),
    ],
)
def test_intersections_are_2_1_or_none(one: Thing, other: Thing, count: int) -> None:
    for first, second in ((one, other), (other, one)):
        found = intersections(first, second)
        assert len(found) == count
        assert all(abs(gap(thing, point)) < 1e-14 for point in found for thing in (one, other))


def test_what_is_one_has_no_count() -> None:
    with pytest.raises(EndlessError):
        intersections(Circle(1, 2, 3), Circle(1, 2, 3))
    with pytest.raises(EndlessError):
        intersections(Endless(1, 2, 90), Endless(1, 5, -90))
    with pytest.raises(EndlessError):
        tangent_lines(Circle(1, 2, 3), Circle(1, 2, 3))


@pytest.mark.parametrize(
    ("radius", "one", "other", "count"),
    [
        (1, Endless(0, 0, 0), Endless(0, 0, 50), 4),
        (1, Endless(0, 0, 0), Endless(0, 4, 0), 0),
        (1, Circle(0, 0, 2), Endless(0, 2.5, 0), 2),
        (1, Circle(0, 0, 2), Endless(0, 1.5, 0), 6),
        (1, Circle(0, 0, 2), Endless(0, 4, 0), 1),
        (1, Circle(0, 0, 2), Circle(5, 0, 2), 2),
        (5, Circle(0, 0, 2), Circle(5, 0, 2), 8),
        (1, Point(0, 0), Point(2, 0), 1),
        (1, Point(0, 0), Endless(0, 1.5, 0), 2),
    ],
)
def test_roundings_of_a_given_radius(radius: float, one: Thing, other: Thing, count: int) -> None:
    found = circles_of_radius(radius, one, other)
    assert len(found) == count
    for circle in found:
        assert circle.r == radius
        assert relative_gap(circle, one) < 1e-30
        assert relative_gap(circle, other) < 1e-30
