"""How often general solvers find a chain from its facts, and from a guess that is off by a millimetre or so.

    python tests/benchmarks/peers.py 500 7

prints a table for 500 chains of seed 7. A peer is given the facts as its user would give them; what it answers is
judged by `chains.measure` alone. `pip install -e '.[test]' --group peers` has them all but planegcs:
`by_planegcs.py` says how to install it. What is not installed is named below the others.
"""

import importlib.util
import signal
import sys
from cmath import exp
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from math import radians
from pathlib import Path
from random import Random
from statistics import median
from time import perf_counter
from typing import Any, NamedTuple, Protocol

import numpy
from scipy.optimize import least_squares

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from by_planegcs import solve_in_plane
from chains import (
    Chain,
    Fact,
    distance_between,
    perturbed,
    random_chain,
    random_facts,
    residuals,
    wrapped,
)
from sketches import chain_of, sketch_of

TRUE = 1e-6
"""mm and degrees. A chain is a solution if no residual is larger."""
SAME = 1e-3
"""Of a chain's extent. Two solutions this close are one, that an iteration has not quite reached."""


class Case(NamedTuple):
    chain: Chain
    facts: tuple[Fact, ...]
    guess: Chain


class Attempt(NamedTuple):
    chains: tuple[Chain, ...]
    """Every solution that it offers; a general solver offers one."""
    says_solved: bool
    seconds: float
    """Of the call that solves, without building the problem."""
    says_all: bool = False
    """Whether it claims that there is no other solution."""


class NotExpressibleError(Exception):
    """The peer has no constraint that says a fact."""


class Adapter(Protocol):
    name: str

    def solve(self, case: Case) -> Attempt: ...


def random_cases(
    count: int,
    seed: int,
    sizes: Sequence[int] = (1, 2, 3, 4, 5, 6, 7, 8),
    *,
    by: float = 1.0,
    share: float = 0.01,
    offset: float = 0.0,
    floor: float = 1e-6,
    swapped: float | None = None,
) -> list[Case]:
    """
    Chains of every size; a guess is off by up to `by` mm and `share` of a value.

    Of the standard facts, the share `swapped` is replaced by others, or any number of them.
    """
    random = Random(seed)
    found = []
    for place in range(count):
        chain = random_chain(random, sizes[place % len(sizes)], offset=offset)
        swaps = random.randint(0, chain.freedom) if swapped is None else round(swapped * chain.freedom)
        facts = random_facts(chain, random, swaps, floor=floor)
        found.append(Case(chain, tuple(facts), perturbed(chain, random, by, share)))
    return found


# SolveSpace


FIXED, FREE = 1, 2
"""Groups: what is given, and what is solved."""


class Sketch:
    """A chain's guess as SolveSpace's entities. There is one sketch in a process, so one of these at a time."""

    def __init__(self, guess: Chain) -> None:
        import slvs  # noqa: PLC0415 its entities are plain dicts, its sketch is global

        self.slvs = slvs
        self.guess = guess
        slvs.clear_sketch()
        self.normal = slvs.add_normal_3d(FIXED, 1, 0, 0, 0)
        self.plane = slvs.add_workplane(FIXED, slvs.add_point_3d(FIXED, 0, 0, 0), self.normal)
        self.points = [self.point(place, FREE if number else FIXED) for number, place in enumerate(guess.points)]
        self.centers = {number: self.point(guess.arc(number).center, FREE) for number in guess.arcs}
        self.elements = {number: self.element(number) for number in guess.numbers}
        self.x_axis = self.line(0j, 1j)  # what is to the right of a line is at a positive distance from it
        self.y_axis = self.line(0j, -1 + 0j)

    def point(self, place: complex, group: int) -> Any:
        return self.slvs.add_point_2d(group, place.real, place.imag, self.plane)

    def line(self, start: complex, end: complex) -> Any:
        """A fixed one."""
        return self.between(self.point(start, FIXED), self.point(end, FIXED), FIXED)

    def between(self, start: Any, end: Any, group: int = FREE) -> Any:
        return self.slvs.add_line_2d(group, start, end, self.plane)

    def element(self, number: int) -> Any:
        start, end = self.points[number - 1], self.points[number]
        if not self.guess.is_arc(number):
            return self.between(start, end)
        if self.guess.arc(number).turn == "cw":
            start, end = end, start
        return self.slvs.add_arc(FREE, self.normal, self.centers[number], start, end, self.plane)

    def is_second_end(self, number: int, *, at_end: bool) -> int:
        """Whether an end of an arc is the second in SolveSpace, where all arcs run counter-clockwise."""
        return int(at_end == (self.guess.arc(number).turn == "ccw"))

    def say(
        self, name: str, value: float = 0.0, points: Sequence[Any] = (), entities: Sequence[Any] = (), *ends: int
    ) -> None:
        none = self.slvs.E_NONE
        kind = self.slvs.ConstraintType[name]
        points = [*points, none, none][:2]
        entities = [*entities, none, none, none, none][:4]
        self.slvs.add_constraint(FREE, kind, self.plane, value, *points, *entities, *([*ends, 0, 0][:2]))

    def spoke(self, number: int, *, at_end: bool) -> tuple[Any, int]:
        """A line, and by how many degrees an element's direction of travel is turned from it."""
        if not self.guess.is_arc(number):
            return self.elements[number], 0
        line = self.between(self.centers[number], self.points[number if at_end else number - 1])
        return line, 90 * self.guess.arc(number).sign

    def place_of(self, point: Any) -> complex:
        return complex(*(self.slvs.get_param_value(handle) for handle in point["param"][:2]))

    def result(self) -> Chain:
        points = [self.place_of(point) for point in self.points]
        variables = [part for point in points[1:] for part in (point.real, point.imag)]
        for number in self.guess.arcs:
            center = self.place_of(self.centers[number])
            radius = (abs(points[number - 1] - center) + abs(points[number] - center)) / 2
            variables += (center.real, center.imag, radius)
        return self.guess.at(variables)


def state(sketch: Sketch, fact: Fact) -> None:
    """One fact as SolveSpace's constraints, with helping points and lines where its user would draw them."""
    WORDS.get(fact.kind, not_expressible)(sketch, fact)


def not_expressible(sketch: Sketch, fact: Fact) -> None:
    raise NotExpressibleError(fact.kind)


def state_coordinate(sketch: Sketch, fact: Fact) -> None:
    axis = sketch.x_axis if fact.kind.startswith("x") else sketch.y_axis
    first = fact.elements[0]
    point = sketch.points[first] if fact.kind.endswith("point") else sketch.centers[first]
    sketch.say("PT_LINE_DISTANCE", fact.values[0], [point], [axis])


def state_radius(sketch: Sketch, fact: Fact) -> None:
    sketch.say("DIAMETER", 2 * fact.values[0], [], [sketch.elements[fact.elements[0]]])


def state_direction(sketch: Sketch, fact: Fact) -> None:
    ray = sketch.line(0j, exp(1j * radians(fact.values[0])))
    sketch.say("PARALLEL", 0, [], [sketch.elements[fact.elements[0]], ray])


def state_length(sketch: Sketch, fact: Fact) -> None:
    number, length = fact.elements[0], fact.values[0]
    if sketch.guess.is_arc(number):
        sketch.say("EQUAL_LINE_ARC_LEN", 0, [], [sketch.line(0j, complex(length)), sketch.elements[number]])
    else:
        sketch.say("PT_PT_DISTANCE", length, sketch.points[number - 1 : number + 1])


def state_angle(sketch: Sketch, fact: Fact) -> None:
    first, second = fact.elements
    if fact.values[0] == 0 and second == first + 1:
        state_tangent(sketch, fact)
        return
    (before, turned), (after, turned_too) = sketch.spoke(first, at_end=True), sketch.spoke(second, at_end=False)
    angle = abs(wrapped(fact.values[0] + turned - turned_too))
    if min(angle, 180 - angle) < 1e-9:
        sketch.say("PARALLEL", 0, [], [before, after])
    else:
        sketch.say("ANGLE", angle, [], [before, after])


def state_tangent(sketch: Sketch, fact: Fact) -> None:
    first, second = fact.elements
    one, other = sketch.elements[first], sketch.elements[second]
    is_arc, is_arc_too = sketch.guess.is_arc(first), sketch.guess.is_arc(second)
    if is_arc and is_arc_too:
        ends = sketch.is_second_end(first, at_end=True), sketch.is_second_end(second, at_end=False)
        sketch.say("CURVE_CURVE_TANGENT", 0, [], [one, other], *ends)
    elif is_arc:
        sketch.say("ARC_LINE_TANGENT", 0, [], [one, other], sketch.is_second_end(first, at_end=True))
    elif is_arc_too:
        sketch.say("ARC_LINE_TANGENT", 0, [], [other, one], sketch.is_second_end(second, at_end=False))
    else:
        sketch.say("PARALLEL", 0, [], [one, other])


def state_passing(sketch: Sketch, fact: Fact) -> None:
    number = fact.elements[0]
    place = sketch.point(complex(*fact.values), FIXED)
    kind = "PT_ON_CIRCLE" if sketch.guess.is_arc(number) else "PT_ON_LINE"
    sketch.say(kind, 0, [place], [sketch.elements[number]])


def state_circle(sketch: Sketch, fact: Fact) -> None:
    number = fact.elements[0]
    x, y, radius = fact.values
    place = complex(x, y)
    center = sketch.point(place, FIXED)
    if not sketch.guess.is_arc(number):
        start, travel = sketch.guess.line(number)
        side = 1 if (travel.conjugate() * (place - start)).imag < 0 else -1
        sketch.say("PT_LINE_DISTANCE", side * radius, [center], [sketch.elements[number]])
        return
    # A point on both circles, in one line with their centres.
    arc = sketch.guess.arc(number)
    spoke = (arc.center - place) / abs(arc.center - place) * radius
    guesses = place + spoke, place - spoke
    touch = sketch.point(min(guesses, key=lambda guess: abs(abs(guess - arc.center) - arc.radius)), FREE)
    sketch.say("PT_PT_DISTANCE", radius, [center, touch])
    sketch.say("PT_ON_CIRCLE", 0, [touch], [sketch.elements[number]])
    sketch.say("PT_ON_LINE", 0, [touch], [sketch.between(center, sketch.centers[number])])


def state_line(sketch: Sketch, fact: Fact) -> None:
    # A point on circle and line, whose spoke is square to the line.
    number = fact.elements[0]
    x, y, angle = fact.values
    place, travel = complex(x, y), exp(1j * radians(angle))
    line = sketch.line(place, place + travel)
    along = (travel.conjugate() * (sketch.guess.arc(number).center - place)).real
    touch = sketch.point(place + along * travel, FREE)
    sketch.say("PT_ON_LINE", 0, [touch], [line])
    sketch.say("PT_ON_CIRCLE", 0, [touch], [sketch.elements[number]])
    sketch.say("PERPENDICULAR", 0, [], [sketch.between(sketch.centers[number], touch), line])


def state_equal_length(sketch: Sketch, fact: Fact) -> None:
    sketch.say("EQUAL_LENGTH_LINES", 0, [], [sketch.elements[number] for number in fact.elements])


def state_equal_radius(sketch: Sketch, fact: Fact) -> None:
    sketch.say("EQUAL_RADIUS", 0, [], [sketch.elements[number] for number in fact.elements])


WORDS: dict[str, Callable[[Sketch, Fact], None]] = {
    "x of point": state_coordinate,
    "y of point": state_coordinate,
    "x of center": state_coordinate,
    "y of center": state_coordinate,
    "radius": state_radius,
    "direction": state_direction,
    "length": state_length,
    "angle": state_angle,
    "tangent": state_tangent,
    "passes through": state_passing,
    "tangent to circle": state_circle,
    "tangent to line": state_line,
    "equal length": state_equal_length,
    "equal radius": state_equal_radius,
}


class SolveSpace:
    name = "slvs (SolveSpace)"

    def solve(self, case: Case) -> Attempt:
        sketch = Sketch(case.guess)
        for fact in case.facts:
            state(sketch, fact)
        slvs = sketch.slvs
        begin = perf_counter()
        result = slvs.solve_sketch(FREE, False)
        seconds = perf_counter() - begin
        says_solved = result["result"] in (slvs.ResultFlag.OKAY, slvs.ResultFlag.REDUNDANT_OKAY)
        return Attempt((sketch.result(),), says_solved, seconds)


# FreeCAD


@dataclass(frozen=True)
class PlaneGCS:
    algorithm: str = "DogLeg"

    @property
    def name(self) -> str:
        return f"planegcs {version('planegcs')} (FreeCAD) {self.algorithm}"

    def solve(self, case: Case) -> Attempt:
        found, says_solved, seconds = solve_in_plane(case.guess, case.facts, self.algorithm)
        return Attempt((found,), says_solved, seconds)


# SciPy


@dataclass(frozen=True)
class LeastSquares:
    """`success` says that a minimum was reached; who looks at the residuals as well is `is_checking`."""

    method: str = "lm"
    is_checking: bool = False

    @property
    def name(self) -> str:
        return f"scipy least_squares {self.method}" + (", residuals checked" if self.is_checking else "")

    def solve(self, case: Case) -> Attempt:
        form = case.guess

        def vector(variables: numpy.ndarray) -> numpy.ndarray:
            return numpy.array(residuals(form.at(variables), case.facts))

        begin = perf_counter()
        found = least_squares(
            vector, numpy.array(form.variables), method=self.method, xtol=1e-14, ftol=1e-14, gtol=1e-14
        )
        seconds = perf_counter() - begin
        says_solved = bool(found.success) and (not self.is_checking or bool(abs(found.fun).max() < TRUE))
        return Attempt((form.at(found.x),), says_solved, seconds)


# contoursolve


PATIENCE = 10.0
"""Seconds after which our own solver is interrupted, and has failed."""


class LateError(Exception):
    """The time is over."""


@contextmanager
def at_most(seconds: float) -> Iterator[None]:
    """Raise LateError in here when the time is over (main thread of a POSIX system only)."""

    def late(*_: object) -> None:
        raise LateError

    before = signal.signal(signal.SIGALRM, late)
    # Again and again, for an exception that is raised while an object is deleted is lost.
    signal.setitimer(signal.ITIMER_REAL, seconds, 0.1)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


class Ours:
    """It is given no guess, and offers every drawing that it can prove."""

    name = "contoursolve"

    def solve(self, case: Case) -> Attempt:
        sketch = sketch_of(case.chain, case.facts)
        begin = perf_counter()
        try:
            with at_most(PATIENCE):
                drawings = sketch.solve()
        except Exception:
            # An exception that a signal raises inside of CasADi may come out as another one.
            if perf_counter() - begin < PATIENCE:
                raise
            return Attempt((), says_solved=False, seconds=perf_counter() - begin)
        seconds = perf_counter() - begin
        proven = [drawn for drawn in drawings if drawn.certificate.proof.value in ("exact", "unique")]
        chains = tuple(chain_of(drawn, case.chain) for drawn in proven)
        return Attempt(chains, bool(chains) or drawings.is_complete, seconds, drawings.is_complete)


OPTIONAL: dict[str, list[Adapter]] = {"slvs": [SolveSpace()], "planegcs": [PlaneGCS(), PlaneGCS("LevenbergMarquardt")]}
"""By the package that they need."""
MISSING = [package for package in OPTIONAL if importlib.util.find_spec(package) is None]
ADAPTERS: list[Adapter] = [
    *(adapter for package, adapters in OPTIONAL.items() if package not in MISSING for adapter in adapters),
    LeastSquares(),
    LeastSquares(is_checking=True),
    LeastSquares("trf"),
    Ours(),
]
"""Append to it what has a `name` and a `solve`."""


# The table


RIGHT, ANOTHER, WRONG, FAILED, MUTE = "right", "another", "wrong", "failed", "not expressible"
CLASSES = (RIGHT, ANOTHER, WRONG, FAILED, MUTE)


def is_true(case: Case, chain: Chain) -> bool:
    return chain.is_proper and all(abs(miss) < TRUE for miss in residuals(chain, case.facts))


def analyse(case: Case, attempt: Attempt) -> str:
    """
    `right`: what it offers is true, and the original is among it. `another`: true, but not the original.
    `wrong`: said to be solved, and some of it is not true; or said to be all, without the original.
    `failed`: said not to be solved.
    """
    if not attempt.says_solved or not (attempt.chains or attempt.says_all):
        return FAILED
    if not all(is_true(case, chain) for chain in attempt.chains):
        return WRONG
    near = SAME * case.chain.extent
    if any(distance_between(case.chain, chain) < near for chain in attempt.chains):
        return RIGHT
    return WRONG if attempt.says_all else ANOTHER


class Row(NamedTuple):
    peer: str
    cases: int
    right: int
    another: int
    wrong: int
    failed: int
    not_expressible: int
    median_ms: float
    slowest_ms: float


def run_peer(cases: Iterable[Case], adapter: Adapter) -> tuple[list[str], list[float]]:
    """What came of each case, and the seconds of those that were expressible."""
    classes, seconds = [], []
    for case in cases:
        try:
            attempt = adapter.solve(case)
        except NotExpressibleError:
            classes.append(MUTE)
        else:
            classes.append(analyse(case, attempt))
            seconds.append(attempt.seconds)
    return classes, seconds


def run_peers(cases: Sequence[Case], adapters: Sequence[Adapter] = ADAPTERS) -> list[Row]:
    rows = []
    for adapter in adapters:
        classes, seconds = run_peer(cases, adapter)
        count = Counter(classes)
        times = [1e3 * median(seconds), 1e3 * max(seconds)] if seconds else [0.0, 0.0]
        rows.append(Row(adapter.name, len(cases), *(count[name] for name in CLASSES), *times))
    return rows


def table(rows: Sequence[Row]) -> str:
    """Rows as Markdown."""
    lines = [f"| peer | cases | {' | '.join(CLASSES)} | median ms | slowest ms |", "|---" * 9 + "|"]
    lines += [f"| {' | '.join(map(str, row[:-2]))} | {row.median_ms:.2f} | {row.slowest_ms:.2f} |" for row in rows]
    lines += [f"| {package} | not installed |{' |' * 7}" for package in MISSING]
    return "\n".join(lines)


if __name__ == "__main__":
    print(table(run_peers(random_cases(*(map(int, sys.argv[1:3]) if sys.argv[2:] else (200, 1))))))  # noqa: T201 a script
