"""Values asked for with `?`, and further facts instead of words: the drawing that the words made comes back.

Each drawing is made by the oracle from its words. Then a word is erased, something is measured on the drawing
with the geometry of this file, and stated with 12 decimals: the drawing must be among the solutions, every
solution must satisfy words and facts, and where there is only one, what was erased must be told.
"""

from cmath import phase, rect
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from math import copysign, degrees, isclose, pi, radians, remainder
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pytest
from oracle import Outcome, g111

from contoursolve import Answer, ArcSegment, Contour, Status, solve

TOLERANCE = 1e-6
"""mm. What 12 decimals of a fact leave of a drawing that is not close to a singular one."""


# Drawings and what can be measured on them ----------------------------------------------------------------


class Part(NamedTuple):
    start: complex
    end: complex
    center: complex | None = None
    radius: float = 0.0
    turn: str = ""


@dataclass(frozen=True)
class Drawing:
    """mm, X of a lathe as radius; `points` are the named ones, `parts` are the elements by name."""

    points: Mapping[str, complex]
    parts: Mapping[str, Part]


def drawing_of(contour: Contour) -> Drawing:
    points = {name: complex(*at) for name, at in contour.points.items()}
    parts = {}
    for each in contour.elements:
        ends = complex(*each.start), complex(*each.end)
        is_arc = isinstance(each, ArcSegment)
        parts[each.name] = Part(*ends, complex(*each.center), each.radius, each.turn.value) if is_arc else Part(*ends)
    return Drawing({"S": complex(*contour.start)} | points, parts)


def gap_between(one: Drawing, other: Drawing) -> float:
    """The largest distance of any two corresponding points, mm; infinite if the drawings differ in kind."""
    if one.parts.keys() != other.parts.keys():
        return float("inf")
    pairs = [(one.points[name], other.points[name]) for name in one.points.keys() & other.points.keys()]
    for name, mine in one.parts.items():
        theirs = other.parts[name]
        if mine.turn != theirs.turn:
            return float("inf")
        pairs += [(mine.start, theirs.start), (mine.end, theirs.end)]
        pairs += [(mine.center or 0, theirs.center or 0), (mine.radius, theirs.radius)]
    return max(abs(a - b) for a, b in pairs)


def wrapped(angle: float) -> float:
    return remainder(angle, 360.0)


def direction(vector: complex) -> float:
    return degrees(phase(vector))


def left_of(place: complex, tail: complex, head: complex) -> float:
    return ((head - tail).conjugate() * (place - tail)).imag / abs(head - tail)


class Fact(NamedTuple):
    """A fact's text, and by how much a drawing misses it (mm or degrees)."""

    kind: str
    text: str
    miss: Callable[[Drawing], float]


@dataclass(frozen=True)
class Units:
    """How a program writes lengths: its unit in mm, its axes, and whether the second is a diameter."""

    in_mm: float = 1.0
    axes: tuple[str, str] = ("Z", "X")
    is_diameter: bool = True

    def length(self, mm: float) -> str:
        return f"{mm / self.in_mm:.12f}"

    def axis(self, place: complex, axis: int) -> str:
        value = (place.imag * (2 if self.is_diameter else 1)) if axis else place.real
        return self.length(value)

    def place(self, place: complex) -> str:
        return " ".join(self.axes[axis] + self.axis(place, axis) for axis in (0, 1))


def on_axis(place: complex, axis: int) -> float:
    return place.imag if axis else place.real


def quantity(kind: str, text: str, written: str, of: Callable[[Drawing], float], drawn: Drawing) -> Fact:
    value = of(drawn)
    return Fact(kind, f"{text} = {written}", lambda drawing: of(drawing) - value)


def coordinates(text: str, kind: str, of: Callable[[Drawing], complex], drawn: Drawing, units: Units) -> Iterator[Fact]:
    for axis in (0, 1):
        yield quantity(
            kind,
            f"{units.axes[axis]} of {text}",
            units.axis(of(drawn), axis),
            lambda drawing, axis=axis: on_axis(of(drawing), axis),
            drawn,
        )


def line_facts(name: str, tail: str, head: str, drawn: Drawing, units: Units, rng: Random) -> Iterator[Fact]:
    """About a line between two named points."""

    def ends(drawing: Drawing) -> tuple[complex, complex]:
        return drawing.points[tail], drawing.points[head]

    def vector(drawing: Drawing) -> complex:
        return drawing.points[head] - drawing.points[tail]

    start, along = drawn.points[tail], vector(drawn)
    size = abs(along)
    yield quantity("length of line", f"length of {name}", units.length(size), lambda d: abs(vector(d)), drawn)
    straight = drawn.parts[name]
    yield quantity(
        "straight part",
        f"straight part of {name}",
        units.length(abs(straight.end - straight.start)),
        lambda d: abs(d.parts[name].end - d.parts[name].start) if name in d.parts else 0.0,
        drawn,
    )
    angle = direction(along)
    turned = angle + rng.choice((-360, 0, 360))
    yield Fact("direction", f"direction of {name} = {turned:.12f}", lambda d: wrapped(direction(vector(d)) - angle))
    place = start + along * rng.choice((rng.uniform(-0.7, -0.3), rng.uniform(0.3, 0.7), rng.uniform(1.3, 1.7)))
    yield Fact("line through", f"{name} passes through ({units.place(place)})", lambda d: left_of(place, *ends(d)))
    radius = rng.uniform(1, 20)
    center = place + rng.choice((1j, -1j)) * radius * along / size
    yield Fact(
        "line tangent to circle",
        f"{name} tangent to circle ({units.place(center)} R{units.length(radius)})",
        lambda d: abs(left_of(center, *ends(d))) - radius,
    )


def round_facts(name: str, drawn: Drawing, units: Units, rng: Random) -> Iterator[Fact]:
    """About the circle of a rounding or an arc."""

    def circle(drawing: Drawing) -> tuple[complex, float]:
        part = drawing.parts[name]
        assert part.center is not None
        return part.center, part.radius

    center, radius = circle(drawn)
    yield from coordinates(f"center of {name}", "center", lambda d: circle(d)[0], drawn, units)
    spoke = rect(1, rng.uniform(-pi, pi))
    on = center + radius * spoke
    yield Fact(
        "circle through",
        f"{name} passes through {units.place(on)}",
        lambda d: abs(on - circle(d)[0]) - circle(d)[1],
    )
    angle = direction(spoke * 1j)
    place = on + spoke * 1j * rng.uniform(-10, 10)
    yield Fact(
        "circle tangent to line",
        f"{name} tangent to line ({units.place(place)} A{angle:.12f})",
        lambda d: abs(((spoke * 1j).conjugate() * (circle(d)[0] - place)).imag) - circle(d)[1],
    )
    size, way = radius * rng.uniform(0.3, 0.8), rng.choice((1, -1))
    other = center + (radius + way * size) * spoke

    def touching(d: Drawing) -> float:
        apart = abs(other - circle(d)[0])
        return min((apart - abs(circle(d)[1] + side * size) for side in (1, -1)), key=abs)

    yield Fact("circles tangent", f"{name} tangent to circle {units.place(other)} R{units.length(size)}", touching)


# G111 -----------------------------------------------------------------------------------------------------

ANGLES = ("A", "B")
LATHE = {"mm": Units(), "inch": Units(25.4)}


class Taper(NamedTuple):
    """A G111 block by its words, and the drawing that they make."""

    start: complex
    words: Mapping[str, float]
    """mm, degrees, X and U as diameters."""
    drawn: Drawing
    lands: float
    """The direction of the line that corner 2 lands on."""

    def block(self, units: Units, erased: Mapping[str, str]) -> str:
        texts = []
        for address, value in self.words.items():
            if address in erased:
                texts += [address + erased[address]] * bool(erased[address])
            else:
                texts.append(f"{address}{value if address in ANGLES else value / units.in_mm:.12f}")
        return " ".join(["G111", *texts])


def drawing_of_outcome(outcome: Outcome, start: complex, names: list[str]) -> Drawing:
    parts = {
        name: Part(each.start, each.end, each.center, each.radius, each.turn)
        for name, each in zip(names, outcome.elements, strict=True)
    }
    return Drawing({"S": start, **outcome.points}, parts)


WITH_B = ("BX", "BU", "BZ", "BW")
"""Words that let a second corner follow."""


def random_taper(rng: Random) -> Taper:
    """A taper without accidents: nothing short, no turn close to 0 or 180 degrees."""
    while True:
        start = complex(rng.uniform(-60, 60), rng.uniform(0, 60))
        first = rect(rng.uniform(15, 60), radians(rng.uniform(-180, 180)))
        second = rect(rng.uniform(15, 60), phase(first) + radians(copysign(rng.uniform(15, 150), rng.uniform(-1, 1))))
        if rng.random() < 0.4:
            second *= abs(first) / abs(second)
        pairs = rng.choice(("AI", "AK", "IK")), rng.choice((*WITH_B, *WITH_B, "XZ", "XW", "UZ", "UW"))
        v2 = start + first + second
        true = {"A": direction(first), "I": first.imag, "K": first.real, "B": direction(second)}
        true |= {"X": 2 * v2.imag, "Z": v2.real, "U": 2 * (v2 - start).imag, "W": (v2 - start).real}
        words = {name: true[name] for name in "".join(pairs)}
        sizes = [rng.uniform(0.5, 4), rng.uniform(0.5, 4)]
        if rng.random() < 0.8:
            sizes[1] = sizes[0]
        corners = dict(zip((rng.choice("CP"), rng.choice("DQ")), sizes, strict=True))
        has_first, has_second = rng.random() < 0.9, "B" in words and rng.random() < 0.9
        words |= {name: value for name, value in corners.items() if (has_first if name in "CP" else has_second)}
        outcome = g111(start, words)
        names = ["line 1", "corner 1", "line 2", "corner 2"]
        names = [name for name, has in zip(names, (True, has_first, True, has_second), strict=True) if has]
        if outcome.status != "solved" or outcome.is_near or len(outcome.elements) != len(names):
            continue
        drawn = drawing_of_outcome(outcome, start, names)
        if min(abs(part.end - part.start) for part in drawn.parts.values()) < 0.3:
            continue
        beyond = outcome.end - v2
        lands = 90.0 * round(direction(beyond) / 90) if has_second else 0.0
        return Taper(start, words, drawn, lands)


def taper_facts(taper: Taper, units: Units, rng: Random) -> Iterator[Fact]:
    drawn = taper.drawn
    yield from line_facts("line 1", "S", "V1", drawn, units, rng)
    yield from line_facts("line 2", "V1", "V2", drawn, units, rng)

    def turn(drawing: Drawing) -> float:
        s, v1, v2 = (drawing.points[name] for name in ("S", "V1", "V2"))
        return direction((v2 - v1) / (v1 - s))

    angle = turn(drawn)
    yield Fact("angle", f"angle from line 1 to line 2 = {angle:.12f}", lambda d: wrapped(turn(d) - angle))
    for name in ("V1", "V2"):
        yield from coordinates(name, "point", lambda d, name=name: d.points[name], drawn, units)
    sizes = {}
    for name in ("corner 1", "corner 2"):
        if name not in drawn.parts:
            continue
        yield from coordinates(f"begin of {name}", "begin", lambda d, name=name: d.parts[name].start, drawn, units)
        yield from coordinates(f"end of {name}", "end", lambda d, name=name: d.parts[name].end, drawn, units)

        def size(drawing: Drawing, name: str = name) -> float:
            part = drawing.parts[name]
            return part.radius or abs((part.end - part.start).real)

        sizes[name] = size(drawn)
        yield quantity("size", f"radius of {name}", units.length(size(drawn)), size, drawn)
        if drawn.parts[name].center is not None:
            yield from round_facts(name, drawn, units, rng)
        else:
            length = abs(drawn.parts[name].end - drawn.parts[name].start)
            yield quantity(
                "length of chamfer",
                f"length of {name}",
                units.length(length),
                lambda d, name=name: abs(d.parts[name].end - d.parts[name].start),
                drawn,
            )
    if len(sizes) == 2 and isclose(*sizes.values(), abs_tol=1e-9):

        def difference(drawing: Drawing) -> float:
            parts = drawing.parts["corner 1"], drawing.parts["corner 2"]
            first, second = (part.radius or abs((part.end - part.start).real) for part in parts)
            return first - second

        yield Fact("equal sizes", "radius of corner 1 = radius of corner 2", difference)
    lengths = [abs(drawn.points["V1"] - drawn.points["S"]), abs(drawn.points["V2"] - drawn.points["V1"])]
    if isclose(*lengths, abs_tol=1e-9):
        yield Fact(
            "equal lengths",
            "length of line 1 = length of line 2",
            lambda d: abs(d.points["V1"] - d.points["S"]) - abs(d.points["V2"] - d.points["V1"]),
        )


def is_moved(taper: Taper, erased: str, fact: Fact) -> bool:
    """Whether a fact says anything about an erased word: a change of the word changes what the fact measures."""
    rates = []
    for step in (1e-4, -1e-4):
        outcome = g111(taper.start, {**taper.words, erased: taper.words[erased] + step})
        if outcome.status != "solved" or len(outcome.elements) != len(taper.drawn.parts):
            return False
        rates.append(abs(fact.miss(drawing_of_outcome(outcome, taper.start, [*taper.drawn.parts]))) / 1e-4)
    return min(rates) > 0.02 * (0.1 if erased in ANGLES else 1)


class Case(NamedTuple):
    """A block with a word erased, and facts instead; `erased` is none of its words where nothing is."""

    program: str
    arguments: dict[str, Any]
    fact: Fact
    taper: Taper
    erased: str


ON_A_CORNER = ("begin", "end", "center", "circle through", "circle tangent to line", "circles tangent", "straight part")
"""Facts that are searched for where a line has no direction of its own: only some are tried then."""


def is_quick(taper: Taper, erased: str, kind: str) -> bool:
    headings = {"A", "B"} & (taper.words.keys() - {erased})
    return len(headings) == 2 or not (kind in ON_A_CORNER or (kind == "angle" and not headings))


def taper_cases(seed: int) -> Iterator[Case]:
    """One drawing with every fact that can stand for one of its words."""
    rng = Random(seed)
    taper, name = random_taper(rng), rng.choice(tuple(LATHE))
    units = LATHE[name]
    for fact in taper_facts(taper, units, rng):
        words = [word for word in taper.words if is_quick(taper, word, fact.kind) and is_moved(taper, word, fact)]
        if not words:
            continue
        erased = rng.choice(words)
        mark = "?" if erased in "CPDQ" else rng.choice(("?", ""))
        facts = [fact.text]
        if erased in "XUZW" and "corner 2" in taper.drawn.parts:
            facts.append(f"corner 2 meets line at {taper.lands}")
        if not mark and rng.random() < 0.5:
            facts.insert(0, "length of line 1 = ?")
        arguments = {"start": units.place(taper.start), "units": name, "facts": facts, "depth": "verdict"}
        yield Case(taper.block(units, {erased: mark}), arguments, fact, taper, erased)


def solutions_of(answer: Answer) -> list[Drawing]:
    listing = answer.solutions
    return [drawing_of(each.contour) for each in listing.solutions if each.contour] if listing else []


def assert_words_hold(taper: Taper, erased: str, drawing: Drawing) -> None:
    start, v1, v2 = (drawing.points[name] for name in ("S", "V1", "V2"))
    found = {"A": direction(v1 - start), "B": direction(v2 - v1), "I": (v1 - start).imag, "K": (v1 - start).real}
    found |= {"X": 2 * v2.imag, "Z": v2.real, "U": 2 * (v2 - start).imag, "W": (v2 - start).real}
    for word in taper.words.keys() & found.keys() - {erased}:
        off = found[word] - taper.words[word]
        assert abs(wrapped(off) if word in ANGLES else off) < 1e-7, word


@pytest.mark.parametrize("seed", range(36))
def test_a_taper_comes_back_from_a_fact_instead_of_a_word(seed: int) -> None:
    count = 0
    for case in taper_cases(seed):
        (answer,) = solve(case.program, **case.arguments).answers
        found, told = solutions_of(answer), (case.program, case.arguments)
        for drawing in found:
            assert abs(case.fact.miss(drawing)) < 1e-7, told
            assert_words_hold(case.taper, case.erased, drawing)
        nearest = min((gap_between(drawing, case.taper.drawn) for drawing in found), default=1e9)
        listing = answer.solutions
        assert nearest < TOLERANCE or (listing is not None and not listing.is_complete), told
        if answer.status is Status.SOLVED:
            assert answer.contour is not None
            assert nearest == gap_between(drawing_of(answer.contour), case.taper.drawn)
            assert_asked(case, answer)
        else:
            assert answer.status is Status.AMBIGUOUS, told
            assert len(found) > 1
            assert all(each.value is None for each in answer.asked)
        count += 1
    assert count >= 4


@pytest.mark.parametrize(
    "seeds",
    [pytest.param([24], id="some"), pytest.param(range(0, 24, 6), id="more", marks=pytest.mark.slow)],
)
def test_a_system_with_facts_has_every_symbol_and_its_function_is_what_is_solved(
    seeds: Iterable[int],
) -> None:
    count = 0
    cases = (case for seed in seeds for case in taper_cases(seed))
    for case in islice(cases, 0, None, 3):
        (answer,) = solve(case.program, **case.arguments).answers
        if answer.contour is None:
            continue
        system, told = answer.system, (case.program, case.arguments)
        known = {each.symbol for each in system.unknowns} | system.values.keys()
        assert {symbol for each in system.equations for symbol in each.free_symbols} <= known, told
        assert system.margin is not None or system.condition is None, told
        found = {key: np.array(value) for key, value in system.function()(**system.inputs).items()}
        rows = dict(zip(system.rows["elements"], found["elements"], strict=True))
        for element in answer.contour.elements:
            assert np.allclose(rows[element.name], [*element.start, *element.end], rtol=0, atol=1e-7), told
        assert abs(found["residuals"]).max() < 1e-7, told
        count += 1
    assert count > 1


def test_a_refused_fact_leaves_a_system_that_can_be_looked_at() -> None:
    (answer,) = solve(
        "G111 X100. A180. K-30. B120. P?", start="X40. Z0.", facts=["length of corner 1 = 12"], depth="verdict"
    ).answers
    system = answer.system
    assert answer.status is Status.REJECTED
    assert [each.value for each in system.unknowns] == [None] * 4
    assert len(system.equations) == 4


def assert_asked(case: Case, answer: Answer) -> None:
    """What is told for each question is the erased word, or the length of line 1."""
    for asked in answer.asked:
        word, value = asked.question.word.text, asked.value
        assert value is not None
        if word == case.erased + "?":
            off = value * (2 if case.erased in "XU" else 1) - case.taper.words[case.erased]
            assert abs(wrapped(off) if case.erased in ANGLES else off) < TOLERANCE, case
        else:
            points = case.taper.drawn.points
            assert value == pytest.approx(abs(points["V1"] - points["S"]), abs=TOLERANCE), case


SEARCHED = [
    # The direction of a line that a corner stands on is not known.
    ("A180. K-30. B? X100. P5.", "straight part of line 1 = 27.113248654052", 120.0),
    ("A180. K-30. B? X100. P5.", "Z of end of corner 1 = -31.443375672974", 120.0),
    ("A? K-30. B120. X100. P5.", "X of center of corner 1 = 50", 180.0),
    ("A? I0. X100. Z-47.320508075689", "angle from line 1 to line 2 = -60", 180.0),
]


@pytest.mark.parametrize(("words", "fact", "value"), SEARCHED)
def test_a_direction_is_found_from_a_fact_about_a_corner(words: str, fact: str, value: float) -> None:
    (answer,) = solve(f"G111 {words}", start="X40. Z0.", facts=[fact], depth="verdict").answers
    assert any(abs(drawing.points["V1"] - (-30 + 20j)) < TOLERANCE for drawing in solutions_of(answer))
    if answer.status is Status.SOLVED:
        assert wrapped((answer.asked[0].value or 0.0) - value) == pytest.approx(0, abs=TOLERANCE)
