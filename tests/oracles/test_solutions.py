"""Every way to draw a thing, and no other: the engine for all solutions, held against oracles that do not import it.

An answer is right, or an honest doubt (`is_complete` is False); a wrong number of drawings is neither.
"""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from itertools import pairwise, product
from math import sqrt
from random import Random
from typing import Any, NamedTuple

import oracle_apollonius as oracle
import pytest
from chains import Arc, Chain, solutions
from click.testing import CliRunner
from mpmath import mp, mpf
from oracle_apollonius import KNOWN, Circle, EndlessError, Line, Point, Thing
from sketches import chain_case, chain_of, is_among, is_drawing, sketch_of

import contoursolve
from contoursolve import Answer, Sketch
from contoursolve.cli import main
from contoursolve.diagnosis.examine import list_alternatives
from contoursolve.diagnosis.solutions import printed_certificate
from contoursolve.geometry import assemble
from contoursolve.numeric import ball
from contoursolve.solving import DECIMALS, Drawing, Drawings, analyse, order
from contoursolve.solving.branch_and_prune import search
from contoursolve.solving.enumerate import enumerate_solutions
from contoursolve.solving.exact_inputs import ground_of
from contoursolve.solving.solution import Proof
from contoursolve.solving.step_equations import Local, make_kernel

NAMES = "abc"
"""Of the given things."""


def text(value: Any) -> str:
    """A number as its user writes it: a string as it is, a float as its shortest decimal."""
    return value if isinstance(value, str) else format(Decimal(repr(value + 0.0)), "f")


def written(things: Sequence[Thing]) -> tuple[Thing, ...]:
    """The same things in decimals, which both the oracle and the package take exactly as they are."""
    return tuple(type(thing)(*map(text, thing)) for thing in things)


def state_touching(sketch: Sketch, what: str, things: Sequence[Thing]) -> None:
    """`what` touches all the things, of which the circles are drawn beside it."""
    for name, thing in zip(NAMES, things, strict=False):
        if isinstance(thing, Circle):
            sketch.circle(name, center=(thing.x, thing.y), radius=thing.r)
    for name, thing in zip(NAMES, things, strict=False):
        match thing:
            case Circle():
                sketch.state(f"{what} tangent to {name}")
            case Line():
                sketch.state(f"{what} tangent to line (X{thing.x} Y{thing.y} A{thing.a})")
            case Point():
                sketch.state(f"{what} passes through (X{thing.x} Y{thing.y})")


def circles_touching(things: Sequence[Thing]) -> Drawings:
    sketch = Sketch()
    sketch.circle("k")
    state_touching(sketch, "k", things)
    return sketch.solve()


def lines_touching(things: Sequence[Thing]) -> Drawings:
    sketch = Sketch()
    sketch.infinite_line("t")
    state_touching(sketch, "t", things)
    return sketch.solve()


def circle_of(drawn: Drawing) -> Circle:
    return Circle(*drawn.points["k.center"], drawn.radii["k.radius"])


def miss(one: Sequence[Any], other: Sequence[Any]) -> float:
    """Largest difference of two circles or vectors, in 110 digits."""
    with mp.workdps(oracle.DIGITS):
        return float(max(abs(mpf(a) - mpf(b)) for a, b in zip(one, other, strict=True)))


def vector_of(line: Line) -> tuple[Any, Any, Any]:
    """An oracle's line as the package has it: to the right or upwards, and how far the origin is to the right."""
    with mp.workdps(oracle.DIGITS):
        n, m, height = oracle.normal_of(line)
        cosine, sine = m, -n
        flip = cosine < -oracle.ZERO or (abs(cosine) < oracle.ZERO and sine < 0)
        return (-cosine, -sine, -height) if flip else (cosine, sine, height)


def assert_each_is_one_of(found: Sequence[Sequence[float]], wanted: Sequence[Sequence[Any]], room: float) -> None:
    """Every drawing is one of the oracle's, and every one of the oracle's is drawn."""
    assert len(found) == len(wanted)
    for drawn in found:
        assert min(miss(drawn, exact) for exact in wanted) <= room
    for exact in wanted:
        assert min(miss(drawn, exact) for drawn in found) <= room


def size_of(things: Sequence[Thing]) -> float:
    return max(abs(float(part)) for thing in things for part in (thing if isinstance(thing, Circle) else thing[:2]))


# Circles that touch three things ----------------------------------------------------------------------------

KINDS = ("CCC", "CCL", "CCP", "CLL", "CLP", "CPP", "LLL", "LLP", "LPP", "PPP")


def compare_circles(things: Sequence[Thing]) -> str:
    """`right`, or `open` for a doubt; everything else fails."""
    wanted = oracle.tangent_circles(*things, keep_given=True)
    drawings = circles_touching(things)
    if not drawings.is_complete:
        return "open"
    # A solution may be far larger than what it touches.
    reach = max([size_of(things), *(float(max(map(abs, circle))) for circle in wanted)])
    assert_each_is_one_of([circle_of(drawn) for drawn in drawings], wanted, 1e-12 * reach)
    return "right"


@pytest.mark.parametrize("kinds", KINDS)
@pytest.mark.parametrize("count", [3, 25])
def test_as_many_circles_touch_three_things_as_there_are_and_they_are_those(kinds: str, count: int) -> None:
    random = Random(f"circles {kinds}")
    results = Counter(compare_circles(written(oracle.random_things(random, kinds))) for _ in range(count))
    assert results == {"right": count}


@pytest.mark.parametrize("kinds", KINDS)
@pytest.mark.parametrize("count", [1, 12])
def test_a_circle_is_found_among_those_that_touch_what_touches_it(kinds: str, count: int) -> None:
    """The things are where rounding has put them: two solutions may be close together, or just vanished."""
    random = Random(f"touching {kinds}")
    for _ in range(count):
        circle, given = oracle.touching_things(random, kinds)
        things = written(given)
        assert compare_circles(things) == "right"
        exact = [
            each for each in oracle.tangent_circles(*things, keep_given=True) if miss(each, circle) < 1e-3 * circle.r
        ]
        drawn = [circle_of(each) for each in circles_touching(things)]
        assert sum(miss(each, circle) < 1e-3 * circle.r for each in drawn) == len(exact)


@pytest.mark.parametrize("name", [name for name, *_ in KNOWN])
def test_classical_places_of_three_things(name: str) -> None:
    """Whole numbers: what touches does so exactly."""
    things = next(three for known, three, _ in KNOWN if known == name)
    try:
        oracle.tangent_circles(*things, keep_given=True)
    except EndlessError:
        drawings = circles_touching(things)
        assert (len(drawings), drawings.is_complete) == (0, False)
    else:
        # No ball tells a radius of exactly 0 from a small one, where sines of 50 degrees are about.
        assert compare_circles(things) == ("open" if name == "three lines through one point" else "right")


def test_a_circle_of_radius_zero_is_no_drawing() -> None:
    drawings = circles_touching((Line(1, 1, 0), Line(1, 1, 50), Line(1, 1, 90)))
    assert not drawings.is_complete
    assert len(drawings) == 0


def test_each_of_three_circles_that_touch_one_another_is_a_double_solution() -> None:
    drawings = circles_touching((Circle(0, 0, 1), Circle(3, 0, 2), Circle(0, 4, 3)))
    doubles = {circle_of(drawn) for drawn in drawings if drawn.certificate.is_double}
    assert doubles == {(0, 0, 1), (3, 0, 2), (0, 4, 3)}
    assert len(drawings) == 5


# Lines that touch two circles -------------------------------------------------------------------------------


def compare_lines(things: Sequence[Thing]) -> int | None:
    """How many lines there are; None for a doubt."""
    drawings = lines_touching(things)
    wanted = oracle.tangent_lines(*things)
    if not drawings.is_complete:
        return None
    room = 1e-12 * max(1.0, size_of(things))  # a cosine and a sine are beside the place
    assert_each_is_one_of([drawn.lines["t"] for drawn in drawings], list(map(vector_of, wanted)), room)
    return len(drawings)


@pytest.mark.parametrize(
    "turn", [(1, 0), (0, 1), (Fraction(3, 5), Fraction(4, 5)), (Fraction(-7, 25), Fraction(24, 25))]
)
def test_a_circle_moves_through_another_and_has_4_3_2_1_and_0_tangents_with_it(turn: tuple[Fraction, Fraction]) -> None:
    for apart, count in ((60, 4), (50, 3), (30, 2), (10, 1), (5, 0)):
        x, y = (str(float(apart * part)) for part in turn)
        assert Fraction(x) == apart * turn[0]
        assert Fraction(y) == apart * turn[1]
        things = Circle("7", "-3", 30), Circle(str(Decimal(x) + 7), str(Decimal(y) - 3), 20)
        assert compare_lines(things) == count
        doubles = [drawn.certificate for drawn in lines_touching(things) if drawn.certificate.is_double]
        assert [(each.gap, each.proof) for each in doubles] == [(0.0, Proof.EXACT)] * (count % 2)


@pytest.mark.parametrize("kinds", ["CC", "CP"])
@pytest.mark.parametrize("count", [15, 60])
def test_as_many_lines_touch_two_things_as_there_are(kinds: str, count: int) -> None:
    random = Random(f"lines {kinds}")
    counts = Counter(compare_lines(written(oracle.random_things(random, kinds))) for _ in range(count))
    assert None not in counts
    assert set(counts) == ({0, 2, 4} if kinds == "CC" else {0, 2})


# Where a line meets a circle, and a circle a circle ----------------------------------------------------------


def crossing(height: str, turned: str = "0") -> Drawings:
    """A line in the stated direction, towards a circle of radius 50 that a point of it at (30, -40) fixes."""
    sketch = Sketch(("-100", height))
    sketch.line("E1")
    sketch.arc("E2", "cw")
    for fact in (
        f"direction of E1 = {turned}",
        "X of center of E2 = 0",
        "Y of center of E2 = 0",
        "X of P2 = 30",
        "Y of P2 = -40",
    ):
        sketch.state(fact)
    return sketch.solve()


def center_between(radius: str) -> Drawings:
    """An arc of a radius over a chord of 50: its centre is where two circles meet."""
    sketch = Sketch()
    sketch.arc("E1", "ccw")
    for fact in ("X of P1 = 30", "Y of P1 = 40", f"radius of E1 = {radius}"):
        sketch.state(fact)
    return sketch.solve()


def test_a_line_meets_a_circle_in_two_places_in_one_or_in_none() -> None:
    assert [len(crossing(height)) for height in ("30", "-14", "50", "-50", "50.001")] == [2, 2, 1, 1, 0]
    assert [len(center_between(radius)) for radius in ("26", "25", "24")] == [2, 1, 0]


def solve_json(*blocks: str, rules: str = "off") -> Any:
    given = [part for block in blocks for part in ("--block", block)]
    arguments = ["solve", *given, "--control", "nct-99m", "--rules", rules, "--format", "json"]
    return json.loads(CliRunner().invoke(main, arguments).stdout)["contours"][0]


@pytest.mark.parametrize(
    ("arc", "line", "count"),
    [
        ("I50 J0", "X60 Y100 ,A90", 2),
        ("I50 J0", "X100 Y100 ,A90", 1),
        ("I50 J0", "X101 Y100 ,A90", 0),
        ("I30 J40", "X30 Y100 ,A90", 2),
        ("I30 J40", "X300 Y90 ,A0", 1),
        ("I30 J40", "X300 Y90.5 ,A0", 0),
        # Centres where two circles meet, each with two, one or no intersection with the line.
        ("X60 Y0 R50", "X200 Y5 ,A0", 4),
        ("X60 Y0 R50", "X200 Y10 ,A0", 3),
        ("X60 Y0 R30", "X200 Y10 ,A0", 2),
        ("X60 Y0 R30", "X200 Y30 ,A0", 1),
        ("X60 Y0 R29", "X200 Y10 ,A0", 0),
        ("X60 Y0 R50", "X200 Y90 ,A0", 1),
        ("X60 Y0 R50", "X200 Y-10 ,A0", 3),
        ("X60 Y0 R50", "X200 Y50 ,A0", 2),
    ],
)
def test_the_command_line_counts_the_intersections_of_a_pair_without_q(arc: str, line: str, count: int) -> None:
    """Radii have no sign here for lack of a word; a centre on either side of the chord is a solution."""
    contour = solve_json("G17 G90 G41 G0 X0 Y0", f"G3 {arc}", f"G1 {line}")
    first, second, *radius = (float(word[1:]) for word in arc.split())
    centers = [Point(first, second)]
    if radius:
        centers = oracle.intersections(Circle(0, 0, *radius), Circle(first, second, *radius))
    things = [Circle(*each, *(radius or [50])) for each in centers]
    x, y, angle = (float(word.strip(",")[1:]) for word in line.split())
    wanted = [place for thing in things for place in oracle.intersections(thing, Line(x, y, angle))]
    assert len(wanted) == count, "the table is wrong"
    assert (contour["count"]["solutions"], contour["count"]["is_complete"]) == (count, True)
    found = [each["points"]["P1"] for each in contour["solutions"] if each["is_path"]]
    assert all(min(miss(place, exact) for exact in wanted) < 1e-9 for place in found)
    assert contour["count"]["contours"] == len(found)


# Close to where two solutions meet ---------------------------------------------------------------------------

LADDER = tuple(sign * Decimal(10) ** -power for power in range(1, 15) for sign in (1, -1))
"""Distances from an exact contact, mm: from 0.1 to 1e-14, on both sides."""

FEW_OR_MANY_RUNGS = pytest.mark.parametrize(
    "ladder", [LADDER[::27], pytest.param(LADDER[::3], marks=pytest.mark.slow)], ids=["few", "many"]
)


def assert_count(drawings: Drawings, count: int) -> bool:
    """The right count, which is True, or an honest doubt."""
    assert len(drawings) == count or not drawings.is_complete
    return drawings.is_complete


def test_a_line_near_a_tangent_meets_the_circle_twice_or_never() -> None:
    for step in LADDER:
        assert assert_count(crossing(str(50 - step)), 2 if step > 0 else 0)
        assert assert_count(crossing(str(-50 - step)), 2 if step < 0 else 0)


def test_an_oblique_line_near_a_tangent_meets_the_circle_twice_or_never() -> None:
    """By 30 degrees it passes the centre in a distance that is no rational number."""
    with mp.workdps(40):
        # The line through (-100, y) at 30 degrees has the height y cos 30 + 100 sin 30 over the centre.
        exact = (50 - 100 * mp.sin(mp.pi / 6)) / mp.cos(mp.pi / 6)
        assert abs(exact) < 1e-30
        for step in LADDER:
            assert assert_count(crossing(str(-step), "30"), 2 if step > 0 else 0)
            far = Decimal(mp.nstr(-100 / mp.cos(mp.pi / 6), 30)) + step
            assert assert_count(crossing(str(far), "30"), 2 if step > 0 else 0)
    # Exactly tangent, which no ball can know: one of them, or a doubt.
    touching = crossing("0", "30")
    assert len(touching) == 1 or not touching.is_complete
    assert all(drawn.certificate.is_double for drawn in touching)


def test_two_circles_near_a_contact_have_as_many_common_tangents_as_there_are() -> None:
    for step in LADDER:
        outside = lines_touching((Circle(0, 0, 30), Circle(str(50 + step), 0, 20)))
        assert assert_count(outside, 4 if step > 0 else 2)
        inside = lines_touching((Circle(0, 0, 30), Circle(str(10 + step), 0, 20)))
        assert assert_count(inside, 2 if step > 0 else 0)


@FEW_OR_MANY_RUNGS
@pytest.mark.slow
def test_two_rods_near_their_farthest_reach_have_two_places_or_none(ladder: Sequence[Decimal]) -> None:
    """There is no closed form: the second rod, 30 long, touches a circle, and the first, 40 long, turns to lead far."""

    def reach(turn: Any) -> Any:
        end = 40 * mp.expj(turn)
        to_center = mp.mpc(50, 10) - end
        return (end + 30 * mp.expj(mp.arg(to_center) - mp.asin(15 / abs(to_center)))).real

    with mp.workdps(50):
        turn = mp.findroot(lambda each: mp.diff(reach, each), -0.116)
        farthest = Decimal(mp.nstr(reach(turn), 40))
    for step in ladder:
        is_known = assert_count(two_rods(farthest - step).solve(), 2 if step > 0 else 0)
        assert is_known or abs(step) < Decimal("1e-10")


@pytest.mark.parametrize(
    "things",
    [
        lambda step: (Circle(0, 0, 30), Circle(str(50 + step), 0, 20), Circle(20, 90, 10)),
        lambda step: (Circle(0, 0, 50), Circle(str(20 + step), 0, 30), Circle(20, 90, 10)),
        lambda step: (Circle(0, 0, 30), Line(0, str(30 + step), 0), Circle(90, 5, 10)),
        lambda step: (Circle(0, 0, 50), Point(str(30 + step), 40), Circle(90, 5, 10)),
        lambda step: (Point(0, str(1 + step)), Point(4, 1), Line(0, 0, 0)),
        lambda step: (Point(0, str(step)), Point(4, 9), Line(0, 0, 0)),
        lambda step: (Point(str(step), 3), Line(0, 0, 90), Line(0, 0, 0)),
        lambda step: (Line(str(step), 0, 0), Line(0, 0, 90), Line(0, str(step), 45)),
    ],
)
@FEW_OR_MANY_RUNGS
def test_circles_that_touch_what_nearly_touches_are_counted(things: Any, ladder: Sequence[Decimal]) -> None:
    for step in (*ladder, 0):
        three = tuple(things(step))
        is_known = assert_count(circles_touching(three), len(oracle.tangent_circles(*three, keep_given=True)))
        # Three lines through one point: no ball of a sine of 45 degrees tells a radius of exactly 0.
        assert is_known or (step == 0 and isinstance(three[0], Line))


def pair(
    x: Decimal | int, y: Decimal | int = 100, word: str = "Q1", angle: str = "90", *, rules: str = "off"
) -> Answer:
    """A circle of radius 50 about (50, 0) from its point at 0, and a line."""
    program = f"G17 G90 G41 G0 X0 Y0\nG3 I50 J0\nG1 X{Decimal(x):f} Y{Decimal(y):f} ,A{angle} {word}"
    return contoursolve.solve(program, control="nct-99m", rules=rules, depth="verdict").answers[0]


@pytest.mark.parametrize("rules", ["enforce", "off"])
@FEW_OR_MANY_RUNGS
def test_a_pair_near_a_tangent_is_solved_or_refused_and_nothing_between(rules: str, ladder: Sequence[Decimal]) -> None:
    """For example X60 Y49.99999999999999 at 180 degrees, of which the exact tangent is at Y50."""
    for step in ladder:
        inside = step > 0
        for answer in (
            pair(100 - step, rules=rules),
            pair(200, 50 - step, "Q-1", "0", rules=rules),
            pair(-200, step - 50, "Q-1", "180", rules=rules),
        ):
            assert answer.status.value == ("solved" if inside else "no-solution")
            certificate = answer.certificate
            assert (
                certificate is not None and certificate.proof is Proof.UNIQUE and not certificate.is_double
            ) == inside
    for answer in (pair(100, rules=rules), pair(200, 50, angle="0", rules=rules, word="Q-1")):
        assert answer.status.value == "solved"
        assert answer.certificate is not None
        assert (answer.certificate.proof, answer.certificate.gap) == (Proof.EXACT, 0.0)


@FEW_OR_MANY_RUNGS
def test_a_pair_without_q_near_a_tangent_has_two_solutions_one_or_none(ladder: Sequence[Decimal]) -> None:
    for step in (*ladder, Decimal(0)):
        alternatives = list_alternatives(pair(100 - step, word=""))
        assert alternatives is not None
        assert alternatives.is_complete
        assert len(alternatives.items) == (2 if step > 0 else 0 if step < 0 else 1)


# Whatever the first guess ------------------------------------------------------------------------------------


class Stage(NamedTuple):
    """One group of a sketch, with all that it may know, and its solutions for each choice of sides."""

    kernel: Any
    inputs: Any
    signs: tuple[dict[str, int], ...]
    ranges: Mapping[str, tuple[float, float]]
    known: tuple[Any, ...]


def stage_of(sketch: Sketch) -> Stage:
    """The last group of a sketch whose other groups have one solution."""
    profile = sketch.profile()
    system = assemble(profile)
    groups = order(system, tuple(system.facts[index] for index in analyse(system).basis))
    kernel, ground = make_kernel(Local(system, groups[-1])), ground_of(profile)
    enumeration = enumerate_solutions(profile, system)
    before = {name: enumeration.found[0].scalars[name] for group in groups[:-1] for name in group.unknowns}
    signs = tuple(dict(zip(kernel.sides, each, strict=True)) for each in product((1, -1), repeat=len(kernel.sides)))

    def inputs(sides: Mapping[str, int]) -> dict[str, Any]:
        return {name: ground.number(name, before, sides) for name in kernel.arguments[len(kernel.unknowns) :]}

    return Stage(kernel, inputs, signs, ground.reach(system, ground.nearby(system)), enumeration.found)


def three_circles() -> Sketch:
    sketch = Sketch()
    sketch.circle("k")
    state_touching(sketch, "k", (Circle(0, 0, 10), Circle(45, 5, 14), Circle(12, 50, 7)))
    return sketch


def two_rods(x: Decimal = Decimal(60)) -> Sketch:
    """Two lines of known length, of which one touches a circle; there is no closed form."""
    sketch = Sketch()
    sketch.line("E1")
    sketch.line("E2")
    for fact in ("length of E1 = 40", "E2 tangent to circle (X50 Y10 R15)", "length of E2 = 30", f"X of P2 = {x:f}"):
        sketch.state(fact)
    return sketch


def search_from(stage: Stage, guesses: int, random: Random) -> None:
    with ball.precision(ball.WORKING):
        for signs in stage.signs:
            known = [each for each in stage.known if all(each.signs[side] == way for side, way in signs.items())]
            places = [[each.scalars[name] for name in stage.kernel.unknowns] for each in known]
            inputs, hits = stage.inputs(signs), set[int]()
            for _ in range(guesses // len(stage.signs)):
                guess = [random.uniform(*stage.ranges[name]) / 4 for name in stage.kernel.unknowns]
                box = search(stage.kernel, guess, inputs)
                if box is None:
                    continue
                named = zip(stage.kernel.unknowns, box, strict=True)
                if all(ball.middle(value) > 0 for name, value in named if name.endswith(".radius")):
                    hit = [
                        number
                        for number, place in enumerate(places)
                        if all(ball.intersects(one, two) for one, two in zip(box, place, strict=True))
                    ]
                    assert len(hit) == 1, "a proven box that is no known solution"
                    hits.add(hit[0])
            assert hits == set(range(len(places)))


@pytest.mark.parametrize("count", [150, 500])
def test_guesses_lead_to_the_certified_solutions_and_to_no_other(count: int) -> None:
    search_from(stage_of(three_circles()), count, Random(1000))


@pytest.mark.parametrize("count", [50, 200])
def test_guesses_for_a_step_without_closed_form_lead_to_the_solutions_that_dividing_finds(count: int) -> None:
    search_from(stage_of(two_rods()), count, Random(200))


# A value that moves ------------------------------------------------------------------------------------------


class Family(NamedTuple):
    """Blocks with one `{}` for a value that moves from `first` to `last`; a contour moves at most `slope` mm for each
    unit of it, or, where a tangent is on the way, as a square root does."""

    program: str
    control: str
    first: float
    last: float
    slope: float
    root: float = 0.0


FAMILIES = (
    Family("G17 G90 G41 G0 X0 Y0\nG3 I50 J0\nG1 X{} Y100 ,A90 Q1", "nct-99m", 20, 80, 4),
    Family("G17 G90 G41 G0 X0 Y0\nG3 I50 J0\nG1 X{} Y100 ,A90 Q1", "nct-99m", 60, 105, 4, 50),
    Family("G17 G90 G42 G0 X0 Y0\nG2 I50 J0\nG1 X200 Y30 ,A{} Q-1", "nct-99m", 0, 20, 12),
    Family("G17 G90 G42 G0 X0 Y0\nG2 I50 J0\nG1 X200 Y30 ,A{} Q-1", "nct-99m", -12, 30, 30, 250),
    Family("G18 G90 G41 G0 Z0 X0\nG3 Z60 X0 R{}\nG1 Z150 X10 ,A0 Q-1", "nct-99m", 31, 90, 12),
    Family("G18 G90 G41 G0 Z0 X0\nG3 Z60 X0 R{}\nG1 Z150 X10 ,A0 Q-1", "nct-99m", 29, 90, 8, 90),
    Family("G00 X40. Z0.\nG111 X100. A180. K-30. B{} P5. Q5.", "yasnac-lx3", 100, 150, 12),
    Family("G00 X40. Z0.\nG111 X100. A180. K-30. B{} P5.", "yasnac-lx3", 91, 178, 3_000),
    Family("G00 X40. Z0.\nG111 X{} A180. K-30. B120. P5. Q5.", "yasnac-lx3", 80, 160, 2),
    Family("G00 X40. Z0.\nG111 I5. A{} B120. X100. P1.", "yasnac-lx3", 125, 178, 300),
    Family("G00 X40. Z0.\nG111 A{} X100. Z-60. B120.", "yasnac-lx3", 130, 178, 20),
)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("steps", [25, pytest.param(200, marks=pytest.mark.slow)])
def test_a_contour_follows_a_value_that_moves_without_a_jump_or_says_why_it_ends(family: Family, steps: int) -> None:
    step = (family.last - family.first) / steps
    answers = []
    for number in range(steps + 1):
        value = format(Decimal(repr(round(family.first + number * step, 9))), "f")
        value += "" if "." in value else "."
        answers.append(
            contoursolve.solve(family.program.format(value), control=family.control, depth="verdict").answers[0]
        )
    assert sum(answer.contour is not None for answer in answers) > steps / 2
    for before, after in pairwise(answers):
        if before.diagnostics or after.diagnostics:
            continue
        assert before.contour is not None
        assert after.contour is not None
        assert before.sides == after.sides
        assert len(before.contour.elements) == len(after.contour.elements)
        room = family.slope * abs(step) + sqrt(family.root * abs(step))
        assert jump(before.contour, after.contour) <= room
    lost = [answer for answer in answers if answer.contour is None]
    assert all(answer.diagnostics for answer in lost)


def jump(one: Any, other: Any) -> float:
    """The largest distance that an end of an element moves."""
    pairs = zip(one.elements, other.elements, strict=True)
    return max(abs(complex(*a.end) - complex(*b.end)) for a, b in pairs)


# Drawing first, stated afterwards ------------------------------------------------------------------------------

LONG_SEARCHES = (86,)
"""Seeds of which all solutions nearby are found, while the search of 100 m is given up, and says so."""


@pytest.mark.parametrize(
    "seeds", [range(2), *(pytest.param(range(n, n + 52), marks=pytest.mark.slow) for n in range(2, 106, 52))], ids=str
)
def test_a_chain_is_found_again_from_facts_that_are_true_of_it(seeds: range) -> None:
    for seed in seeds:
        chain, facts = chain_case(seed)
        drawings = sketch_of(chain, facts).solve()
        drawn = [chain_of(each, chain) for each in drawings]
        assert is_among(chain, drawn), f"seed {seed}: the drawing is missing"
        told = ("farther than", *(["all that lies farther away"] if seed in LONG_SEARCHES else []))
        doubts = [doubt for doubt in drawings.doubts if not any(text in doubt for text in told)]
        assert not doubts, f"seed {seed}: there may be others"
        assert all(is_drawing(each, facts) for each in drawn), f"seed {seed}: a drawing is none"
        if len(chain.elements) <= 3:
            # Newton's method may run off to where rounding hides what is not true.
            others = [each for each in solutions(chain, facts, Random(seed), starts=2) if is_drawing(each, facts)]
            assert all(is_among(other, drawn) for other in others), f"seed {seed}: another solution is missing"


def test_an_arc_is_not_longer_than_its_circle() -> None:
    sketch = Sketch((10, 0))
    sketch.arc("E1", "ccw")
    for fact in ("X of center of E1 = 0", "Y of center of E1 = 0", "length of E1 = 100"):
        sketch.state(fact)
    drawings = sketch.solve()
    assert (len(drawings), drawings.is_complete) == (0, True)


def line_and_arc() -> Drawings:
    sketch = Sketch()
    sketch.line("E1")
    sketch.arc("E2", "ccw")
    for fact in (
        "direction of E1 = -70",
        "angle from E1 to E2 = -45",
        "X of P2 = 50",
        "Y of P2 = -60",
        "E2 passes through (X85 Y-30)",
    ):
        sketch.state(fact)
    return sketch.solve()


def test_a_proven_solution_is_drawn() -> None:
    drawings = line_and_arc()
    assert (len(drawings), drawings.is_complete) == (1, True)


# What is proven ----------------------------------------------------------------------------------------------


def exact_direction(degrees: Decimal) -> Any:
    """As a complex number of 60 digits; exact along the axes."""
    quarter, rest = divmod(degrees, 90)
    return mp.mpc(0, 1) ** (int(quarter) % 4) * mp.expj(mpf(str(rest)) * mp.pi / 180)


def meet(place: Any, way: Any, other: Any, other_way: Any) -> Any:
    return place + way * ((other - place).conjugate() * other_way).imag / (way.conjugate() * other_way).imag


def rounded(at: Any, before: Any, after: Any, radius: Any) -> list[Any]:
    """Where a rounding begins and ends, and its centre."""
    half = mp.arg(after / before) / 2
    cut = radius * abs(mp.tan(half))
    begin = at - cut * before
    return [begin, at + cut * after, begin + radius * before * (1j if half > 0 else -1j)]


def exact_g111(start: tuple[Decimal, Decimal], words: Mapping[str, Decimal]) -> list[Any]:
    """V1 and V2, and the places of the roundings P and Q: two words for each line."""
    number = {name: mpf(str(value)) for name, value in words.items()}
    begin = mp.mpc(str(start[0]), str(start[1]))
    across, along = mp.mpc(1), mp.mpc(0, 1)
    loci = {
        "I": (begin + 1j * number.get("I", 0), across),
        "K": (begin + number.get("K", 0), along),
        "A": (begin, exact_direction(words.get("A", Decimal(0)))),
    }
    one, other = (loci[name] for name in "AIK" if name in words)
    first = meet(*one, *other)
    ends = {
        "X": (1j * number.get("X", 0) / 2, across),
        "U": (begin + 1j * number.get("U", 0) / 2, across),
        "Z": (mp.mpc(number.get("Z", 0)), along),
        "W": (begin + number.get("W", 0), along),
        "B": (first, exact_direction(words.get("B", Decimal(0)))),
    }
    one, other = (ends[name] for name in "BXUZW" if name in words)
    second = meet(*one, *other)
    ways = [(first - begin) / abs(first - begin), (second - first) / abs(second - first)]
    places = [first, second]
    if "P" in words:
        places += rounded(first, *ways, number["P"])
    if "Q" in words:
        lands_along_z = "X" in words or "U" in words
        landing = mp.mpc(mp.sign(ways[1].real)) if lands_along_z else mp.mpc(0, mp.sign(ways[1].imag))
        places += rounded(second, ways[1], landing, number["Q"])
    return places


G111_RANGES = {
    "A": (150, 170),
    "I": (1, 4),
    "K": (-30, -20),
    "B": (100, 130),
    "X": (90, 110),
    "U": (50, 70),
    "Z": (-60, -50),
    "W": (-60, -50),
}


def test_the_exact_places_of_a_g111_contour_are_within_the_certified_radius() -> None:
    random = Random(111)
    with mp.workdps(60):
        for _ in range(150):
            line1 = random.choice((("A", "I"), ("A", "K"), ("I", "K")))
            line2 = random.choice((("B", "X"), ("B", "U"), ("B", "Z"), ("X", "Z"), ("U", "W"), ("X", "W")))
            places = random.choice((0, 3, 9))
            names = *line1, *line2
            words = {name: round(Decimal(random.uniform(*G111_RANGES[name])), places) for name in names}
            if "B" in words:
                words["P"] = Decimal(2)
            if "B" in words and random.random() < 0.5:
                words["Q"] = Decimal(3)
            start = round(Decimal(random.uniform(-10, 10)), places), Decimal(random.randint(36, 44))
            block = " ".join(f"{name}{value:f}" + ("" if "." in f"{value:f}" else ".") for name, value in words.items())
            z, x = (f"{value:f}" + ("" if "." in f"{value:f}" else ".") for value in start)
            answer = contoursolve.solve(f"G00 X{x} Z{z}\nG111 {block}", depth="verdict").answers[0]
            assert answer.contour is not None, block
            exact = exact_g111((start[0], start[1] / 2), words)
            assert_certified(answer, exact)


def places_of(answer: Answer) -> list[tuple[float, float]]:
    """Every point, end and centre of a contour."""
    assert answer.contour is not None
    elements = answer.contour.elements
    places = [*answer.contour.points.values(), *(element.end for element in elements)]
    return places + [element.center for element in elements if hasattr(element, "center")]


def assert_certified(answer: Answer, exact: Sequence[Any], *, is_printed: bool = True) -> None:
    """Each exact place is as close to one of the contour, as printed or as computed, as the certificate says."""
    certificate = printed_certificate(answer.certificate) if is_printed else answer.certificate
    assert certificate is not None
    assert certificate.proof in (Proof.UNIQUE, Proof.EXACT)
    found = places_of(answer)
    for place in exact:
        near = min(found, key=lambda each: abs(complex(*each) - place))
        for value, wanted in zip(near, (place.real, place.imag), strict=True):
            off = abs((mpf(f"{value:.{DECIMALS}f}") if is_printed else mpf(value)) - wanted)
            # What is compared has sixty digits of its own.
            assert off <= certificate.radius + mpf("1e-50"), (answer.profile.blocks, certificate, float(off))


def test_the_numbers_of_the_python_interface_are_within_the_certified_radius() -> None:
    answer = contoursolve.solve("G00 X38. Z4.493\nG111 I3.465 K-22.854 X97.563 Z-51.937").answers[0]
    with mp.workdps(60):
        assert_certified(answer, [mp.mpc("-18.361", "22.465"), mp.mpc("-51.937", "48.7815")], is_printed=False)


def test_the_end_of_a_line_is_within_the_certified_radius_wherever_the_sketch_begins() -> None:
    sketch = Sketch(("-17.036", "-27.768"))
    sketch.line("E1")
    sketch.state("direction of E1 = 0")
    sketch.state("length of E1 = 46.379")
    (drawn,) = sketch.solve()
    off = abs(Fraction(drawn.points["P1"][0]) - Fraction("46.379") + Fraction("17.036"))
    assert off <= Fraction(drawn.certificate.radius)


@pytest.mark.slow
@pytest.mark.parametrize("count", [9, 40])
def test_the_exact_intersection_of_a_pair_is_within_the_certified_radius(count: int) -> None:
    random = Random(1633)
    with mp.workdps(60):
        for number in range(count):
            places = (0, 3, 9)[number % 3]
            start, center, end = (
                tuple(round(Decimal(random.uniform(-reach, reach)), places) for _ in range(2))
                for reach in (50, 40, 150)
            )
            angle = (
                Decimal(random.randrange(-180, 180, 15)) if number % 2 else round(Decimal(random.uniform(-180, 180)), 6)
            )
            i, j = (value - begin for value, begin in zip(center, start, strict=True))
            program = (
                f"G17 G90 G41 G0 X{start[0]:f} Y{start[1]:f}\nG3 I{i:f} J{j:f}\n"
                f"G1 X{end[0]:f} Y{end[1]:f} ,A{angle:f} Q{random.choice((1, -1))}"
            )
            answer = contoursolve.solve(program, control="nct-99m", depth="verdict").answers[0]
            if answer.contour is None:
                continue
            x, y = (mpf(str(value)) for value in center)
            radius = mp.hypot(mpf(str(i)), mpf(str(j)))
            way, place = exact_direction(angle), mp.mpc(str(end[0]), str(end[1]))
            # From the foot of the centre on the line, as far to both sides as the circle reaches.
            spoke = mp.mpc(x, y) - place
            foot = place + way * (way.conjugate() * spoke).real
            reach = mp.sqrt(radius**2 - abs(mp.mpc(x, y) - foot) ** 2)
            crossing = complex(*answer.contour.points["P1"])
            exact = min((foot + reach * way, foot - reach * way), key=lambda each: abs(each - crossing))
            assert_certified(answer, [exact])


def test_a_word_said_twice_leaves_the_certificate_as_it_is() -> None:
    """Both ways to an answer, the closed form and the list of all solutions, prove the same of the same contour."""
    random, proofs = Random(52), Counter[Proof]()
    for _ in range(25):
        x, z, w, i, p = (round(random.uniform(*each), 3) for each in ((20, 400), (-60, 40), (10, 40), (1, 5), (0.5, 4)))
        far, end = round(x + 60, 3), round(z - w - 50, 3)
        for block, fact in (
            (f"G01 W{w} I{i}", f"Z of V1 = {z + w:.3f}"),
            (f"G111 I{i} K-{w} X{far} Z{end} P{p}", f"Z of V2 = {end}"),
            (f"G111 I{i} K-{w} X{far} Z{end}", f"X of V2 = {far}"),
        ):
            program = f"G00 X{x} Z{z}\n{block}"
            plain, stated = (
                contoursolve.solve(text, control="yasnac-lx3").answers[0]
                for text in (program, f"{program} (contoursolve: {fact})")
            )
            assert plain.contour is not None, program
            certificate = printed_certificate(plain.certificate)
            assert certificate == printed_certificate(stated.certificate), program
            assert certificate is not None
            proofs[certificate.proof] += 1
            # Exact are numbers of three decimals, or of four for a radius that is half a diameter.
            is_short = all(round(value, 4) == round(value, DECIMALS) for at in places_of(plain) for value in at)
            assert (certificate.proof is Proof.EXACT) is is_short, program
            assert (certificate.radius == 0) is is_short, program
    assert proofs == {Proof.EXACT: 50, Proof.UNIQUE: 25}


@pytest.mark.slow
def test_what_the_command_line_prints_is_within_the_radius_that_it_prints() -> None:
    random = Random(12)
    with mp.workdps(60):
        for _ in range(20):
            x, y = (round(Decimal(random.uniform(20, 80)), 4), round(Decimal(random.uniform(70, 120)), 4))
            contour = solve_json("G17 G90 G41 G0 X0.1 Y0.2", "G3 I50 J0", f"G1 X{x} Y{y} ,A90")
            for each in contour["solutions"]:
                rise = mp.sqrt(2500 - (mpf(str(x)) - mpf("50.1")) ** 2)
                x1, y1 = each["points"]["P1"]
                radius = each["certificate"]["radius"]
                assert abs(mpf(x1) - mpf(str(x))) <= radius
                assert min(abs(mpf(y1) - mpf("0.2") - way * rise) for way in (1, -1)) <= radius


@pytest.mark.parametrize("kinds", KINDS)
@pytest.mark.parametrize("count", [3, 15])
def test_the_exact_circle_is_within_the_certified_radius(kinds: str, count: int) -> None:
    random = Random(f"certified {kinds}")
    for _ in range(count):
        things = written(oracle.random_things(random, kinds))
        wanted = oracle.tangent_circles(*things, keep_given=True)
        for drawn in circles_touching(things):
            certificate = drawn.certificate
            assert certificate.proof in (Proof.EXACT, Proof.UNIQUE)
            assert min(miss(circle_of(drawn), exact) for exact in wanted) <= certificate.radius


def fraction_gap(circle: Circle, thing: Thing) -> Fraction:
    """0 if a circle touches a thing, in rational numbers; lines along the axes only."""
    x, y, r = map(Fraction, circle)
    if isinstance(thing, Line):
        far = y - Fraction(thing.y) if thing.a in (0, 180) else x - Fraction(thing.x)
        return abs(far) - r
    other = Fraction(thing.r) if isinstance(thing, Circle) else Fraction(0)
    square = (x - Fraction(thing.x)) ** 2 + (y - Fraction(thing.y)) ** 2
    return min(square - (r + other) ** 2, square - (r - other) ** 2, key=abs)


@pytest.mark.parametrize("count", [50, 150])
def test_a_circle_is_exact_only_if_it_touches_exactly(count: int) -> None:
    """Whole numbers and quarters: some of the circles have a rational place, most have not."""
    random = Random(60)
    proofs: Counter[Proof] = Counter()
    for _ in range(count):
        things: list[Thing] = [Point(random.randint(-8, 8), random.randint(-8, 8)) for _ in range(3)]
        for place, kind in enumerate(random.choice(("PPP", "PPP", "PPL", "PLL", "CLL", "CPL", "CPP"))):
            x, y = things[place][:2]
            if kind == "C":
                things[place] = Circle(x, y, random.choice((0.25, 1, 2, 5)))
            if kind == "L":
                things[place] = Line(x, y, random.choice((0, 90)))
        for drawn in circles_touching(things):
            proofs[drawn.certificate.proof] += 1
            is_true = all(fraction_gap(circle_of(drawn), thing) == 0 for thing in things)
            if drawn.certificate.proof is Proof.EXACT and drawn.certificate.radius == 0:
                assert is_true, things
            if drawn.certificate.proof is not Proof.EXACT:
                assert not is_true, things
    assert min(proofs[Proof.EXACT], proofs[Proof.UNIQUE]) > count / 8


@pytest.mark.parametrize("turn", ["cw", "ccw"])
def test_the_two_arcs_of_one_radius_between_two_points_are_named_by_their_length(turn: str) -> None:
    sketch = Sketch()
    sketch.arc("E1", turn)
    for fact in ("X of P1 = 30", "Y of P1 = 10", "radius of E1 = 20"):
        sketch.state(fact)
    form = Chain((0j, 1j), (Arc(turn, 0j, 1.0),))
    sweeps = {drawn.name: chain_of(drawn, form).sweep(1) for drawn in sketch.solve()}
    assert sweeps.keys() == {"E1 short arc", "E1 long arc"}
    assert sweeps["E1 short arc"] < 180 < sweeps["E1 long arc"]


def test_a_double_point_of_the_circle_is_not_taken_for_a_line_that_touches() -> None:
    program = "G17 G41 G0 X50 Y0\nG3 X? Y50 R50 (contoursolve: X of C = 0)\nG1 X-50 Y42.857 ,A171.87 Q-1"
    (answer,) = contoursolve.solve(program, control="nct-99m").answers
    (finding,) = (each for each in answer.diagnostics if each.severity.value == "warning" and "one" in each.message)
    assert (finding.code, finding.message.partition(":")[0]) == ("nct-double", "N1")
    assert "P1" in answer.sides


def test_a_double_solution_is_one_whose_two_solutions_are_one_exactly() -> None:
    for things in (
        (Circle(0, 0, 30), Circle(50, 0, 20)),
        (Circle(0, 0, 30), Circle(10, 0, 20)),
        (Circle("0.1", "0.2", "0.3"), Circle("0.4", "0.6", "0.2")),
    ):
        doubles = [drawn.certificate for drawn in lines_touching(things) if drawn.certificate.is_double]
        assert [(each.proof, each.gap) for each in doubles] == [(Proof.EXACT, 0.0)]
        assert str(doubles[0]).endswith("(an element only touches)")
    for step in LADDER:
        near = lines_touching((Circle(0, 0, 30), Circle(str(50 + step), 0, 20)))
        assert not any(drawn.certificate.is_double for drawn in near)
