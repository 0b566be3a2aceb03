"""Values asked for with `?`, and further facts instead of words: the drawing that the words made comes back.

Each drawing is made by the oracle from its words. Then a word is erased, something is measured on the drawing
with the geometry of this file, and stated with 12 decimals: the drawing must be among the solutions, every
solution must satisfy words and facts, and where there is only one, what was erased must be told.
"""

import json
from cmath import phase, rect
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import acos, copysign, degrees, hypot, isclose, pi, radians, remainder, tan
from random import Random
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest
from click.testing import CliRunner
from oracle import PLANES, Outcome, circle_line, g111, largest_gap

from contoursolve import Answer, ArcSegment, Contour, Status, solve
from contoursolve.cli import main
from contoursolve.diagnosis.solutions import list_solutions
from contoursolve.program.pipeline import FactPlaceError
from contoursolve.solving.enumerate import Effort

OFTEN = 20
"""Cases of a kind after which there is no need for more."""

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


def drawing_of(contour: Contour, start: str = "S") -> Drawing:
    points = {name: complex(*at) for name, at in contour.points.items()}
    parts = {}
    for each in contour.elements:
        ends = complex(*each.start), complex(*each.end)
        is_arc = isinstance(each, ArcSegment)
        parts[each.name] = Part(*ends, complex(*each.center), each.radius, each.turn.value) if is_arc else Part(*ends)
    return Drawing({start: complex(*contour.start)} | points, parts)


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
        rates.append(abs(fact.miss(drawing_of_outcome(outcome, taper.start, list(taper.drawn.parts)))) / 1e-4)
    return min(rates) > 0.02 * (0.1 if erased in ANGLES else 1)


class Case(NamedTuple):
    """A block with a word erased, and facts instead; `erased` is none of its words where nothing is."""

    program: str
    arguments: dict[str, Any]
    facts: list[Fact]
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
        yield Case(taper.block(units, {erased: mark}), arguments, [fact], taper, erased)


def solutions_of(answer: Answer, start: str = "S") -> list[Drawing]:
    listing = list_solutions(answer)
    contours = [each.contour for each in listing.solutions if each.contour] if listing else []
    return [drawing_of(contour, start) for contour in contours]


def assert_words_hold(taper: Taper, erased: str, drawing: Drawing) -> None:
    start, v1, v2 = (drawing.points[name] for name in ("S", "V1", "V2"))
    found = {"A": direction(v1 - start), "B": direction(v2 - v1), "I": (v1 - start).imag, "K": (v1 - start).real}
    found |= {"X": 2 * v2.imag, "Z": v2.real, "U": 2 * (v2 - start).imag, "W": (v2 - start).real}
    for word in taper.words.keys() & found.keys() - {erased}:
        off = found[word] - taper.words[word]
        assert abs(wrapped(off) if word in ANGLES else off) < 1e-7, word


@pytest.mark.parametrize(("seeds", "least"), [(1, 0), pytest.param(36, 10, marks=pytest.mark.slow)])
def test_a_taper_comes_back_from_a_fact_instead_of_a_word(seeds: int, least: int) -> None:
    kinds, erased = Counter[str](), Counter[str]()
    for case in (case for seed in range(seeds) for case in taper_cases(seed)):
        if kinds[case.facts[0].kind] >= OFTEN and erased[case.erased] >= OFTEN:
            continue
        (answer,) = solve(case.program, **case.arguments).answers
        found, told = solutions_of(answer), (case.program, case.arguments)
        for drawing in found:
            assert all(abs(fact.miss(drawing)) < 1e-7 for fact in case.facts), told
            assert_words_hold(case.taper, case.erased, drawing)
        nearest = min((gap_between(drawing, case.taper.drawn) for drawing in found), default=1e9)
        listing = list_solutions(answer)
        assert nearest < TOLERANCE or (listing is not None and not listing.is_complete), told
        if answer.status is Status.SOLVED:
            assert answer.contour is not None
            assert nearest == gap_between(drawing_of(answer.contour), case.taper.drawn)
            assert_asked(case, answer)
        else:
            assert answer.status is Status.AMBIGUOUS, told
            assert len(found) > 1
            assert all(each.value is None for each in answer.answers)
        kinds.update(fact.kind for fact in case.facts)
        erased[case.erased] += 1
    assert kinds.total() > 5 * seeds
    if least:
        assert len(kinds) == 17, kinds
        assert min(kinds.values()) >= least, kinds
        assert min(erased.values()) >= least, erased
        assert erased.keys() == set("AIKBXUZWCPDQ")


def assert_asked(case: Case, answer: Answer) -> None:
    """What is told for each question is the erased word, or the length of line 1."""
    for asked in answer.answers:
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
    ("G111 A180. K-30. B? X100. P5.", "straight part of line 1 = 27.113248654052", 120.0),
    ("G111 A180. K-30. B? X100. P5.", "Z of center of corner 1 = -27.113248654052", 120.0),
    ("G111 A? K-30. B120. X100. P5.", "X of center of corner 1 = 50", 180.0),
    ("G111 A180. K-30. B? X100. P5.", "Z of end of corner 1 = -31.443375672974", 120.0),
    ("G111 A? I0. X100. Z-47.320508075689", "angle from line 1 to line 2 = -60", 180.0),
]


@pytest.mark.parametrize(("block", "fact", "value"), SEARCHED)
def test_a_direction_is_found_from_a_fact_about_a_corner(block: str, fact: str, value: float) -> None:
    (answer,) = solve(block, start="X40. Z0.", facts=[fact], depth="verdict").answers
    assert any(abs(drawing.points["V1"] - (-30 + 20j)) < TOLERANCE for drawing in solutions_of(answer))
    if answer.status is Status.SOLVED:
        assert wrapped((answer.answers[0].value or 0.0) - value) == pytest.approx(0, abs=TOLERANCE)


# The line that the last corner meets ----------------------------------------------------------------------


LANDINGS = [
    (word, how, lands)
    for word in "QD"
    for how in ("at", "to", "next")
    for lands in ((0.0, 35.0, 90.0, 150.0, 180.0, -100.0, -170.0) if word == "Q" else (150.0, 180.0, -170.0))
]


@pytest.mark.parametrize(("word", "how", "lands"), LANDINGS)
def test_the_last_corner_meets_the_line_that_is_stated(word: str, how: str, lands: float) -> None:
    v2, before, after = complex(-30 - 30 / 3**0.5, 50), rect(1, radians(120)), rect(1, radians(lands))
    place = v2 + 25 * after
    at = f"(Z{place.real:.12f} X{2 * place.imag:.12f})"
    fact = {"at": f"line at {lands}", "to": f"line to {at}", "next": "next line"}[how]
    program = f"G111 A180. K-30. B120. X100. {word}2.\nG01 {at.strip('()')} F0.2"
    (answer,) = solve(program, start="X40. Z0.", facts=[f"corner 2 meets {fact}"], depth="verdict").answers
    assert answer.status is Status.SOLVED, [each.message for each in answer.diagnostics]
    assert answer.contour is not None
    corner = drawing_of(answer.contour).parts["corner 2"]
    reach = abs(corner.end - v2)
    assert corner.end == pytest.approx(v2 + reach * after, abs=1e-9)
    assert corner.start == pytest.approx(v2 - abs(corner.start - v2) * before, abs=1e-9)
    if word == "Q":
        assert corner.radius == pytest.approx(2)
        assert reach == pytest.approx(2 * abs(tan(radians(wrapped(lands - 120)) / 2)))
        assert corner.turn == ("ccw" if wrapped(lands - 120) > 0 else "cw")
    else:
        across = corner.end - corner.start
        assert (abs(across.real), abs(across.imag)) == pytest.approx((2, 2))


def setbacks(before: complex, after: complex, diagonal: complex) -> tuple[float, float]:
    """By how much a segment takes of the lines before and after it: s * before + t * after = diagonal."""
    turn = (before.conjugate() * after).imag
    return (diagonal.conjugate() * after).imag / turn, (before.conjugate() * diagonal).imag / turn


@pytest.mark.parametrize("lands", [*range(-170, 181, 10), -167, 29, 31, 97, 163])
@pytest.mark.parametrize("asks", [False, True])
@pytest.mark.parametrize("way", [120, 160])
def test_a_bevel_onto_a_line_is_the_one_with_the_most_equal_setbacks(lands: int, asks: bool, way: int) -> None:
    """Of the four segments at 45 degrees, those that fit take a length of both lines that is not negative."""
    before, after = rect(1, radians(way)), rect(1, radians(lands))
    v2 = -30 + 30 / before.imag * before + 20j
    if abs((before.conjugate() * after).imag) < 1e-9:
        return
    fitting = {}
    for diagonal in (2 * complex(z, x) for z in (1, -1) for x in (1, -1)):
        first, second = setbacks(before, after, diagonal)
        if min(first, second) > 1e-9:
            fitting[diagonal] = abs(first - second)
    facts = [f"corner 2 meets line at {lands}", *(["radius of corner 2 = 2"] if asks else [])]
    block = f"G111 A180. K-30. B{way}. X100. {'D?' if asks else 'D2.'}"
    (answer,) = solve(block, start="X40. Z0.", facts=facts, depth="verdict").answers
    is_even = len({round(each, 9) for each in fitting.values()}) < len(fitting)
    if not fitting or (asks and is_even):
        # A direction that is a sum of sines is not known to be zero where the size is an unknown, too.
        assert answer.contour is None
        return
    assert answer.status is Status.SOLVED, [each.message for each in answer.diagnostics]
    assert answer.contour is not None
    corner = drawing_of(answer.contour).parts["corner 2"]
    # Where two are equally near, it goes on along line 2.
    wanted = min(fitting, key=lambda each: (round(fitting[each], 9), -(each.conjugate() * before).real))
    assert corner.end - corner.start == pytest.approx(wanted, abs=1e-9)
    assert corner.start == pytest.approx(v2 - setbacks(before, after, wanted)[0] * before, abs=1e-9)


@pytest.mark.parametrize("word", ["Q5.", "D5."])
@pytest.mark.parametrize("how", ["to", "next"])
def test_a_corner_that_ends_beyond_the_line_that_it_meets_is_refused(word: str, how: str) -> None:
    v2, lands = complex(-30 - 30 / 3**0.5, 50), 170
    needed = 5 * tan(radians(25))
    if word[0] == "D":
        needed = setbacks(rect(1, radians(120)), rect(1, radians(lands)), complex(-5, 5))[1]
    for length, fits in ((needed + 1e-6, True), (needed - 1e-6, False), (needed / 2, False), (0.0, False)):
        place = v2 + rect(length, radians(lands))
        at = f"Z{place.real:.12f} X{2 * place.imag:.12f}"
        fact = {"to": f"line to ({at})", "next": "next line"}[how]
        program = f"G111 A180. K-30. B120. X100. {word}\nG01 {at} F0.2"
        (answer,) = solve(program, start="X40. Z0.", facts=[f"corner 2 meets {fact}"], depth="verdict").answers
        assert answer.status is (Status.SOLVED if fits else Status.NO_SOLUTION)
        if not fits:
            (finding,) = [each for each in answer.diagnostics if each.code == "g111-corner-too-large"]
            assert finding.values["limit"] == pytest.approx(5 * length / needed, abs=1e-6)


# NCT ------------------------------------------------------------------------------------------------------


class Pair(NamedTuple):
    """A circle and a line by their words, and the drawing that they make."""

    plane: int
    start: complex
    turn: str
    arc: dict[str, float]
    line: dict[str, float]
    drawn: Drawing

    def program(self, units: Units, erased: Mapping[str, str] = MappingProxyType({})) -> str:
        def text(address: str, value: float, mark: str | None) -> str:
            if mark is not None:
                return address + mark if mark else ""
            is_plain = address in (",A", "Q")
            return f"{address}{value if is_plain else value / units.in_mm:.12f}"

        arc = [text(address, value, erased.get("1" + address)) for address, value in self.arc.items()]
        line = [text(address, value, erased.get("2" + address)) for address, value in self.line.items()]
        code = "G3" if self.turn == "ccw" else "G2"
        return f"G{self.plane} G41 G0 {units.place(self.start)}\n{code} {' '.join(arc)}\nG1 {' '.join(line)}"

    def units(self, in_mm: float) -> Units:
        first, second, _, _ = PLANES[self.plane]
        return Units(in_mm, (first, second), is_diameter=False)


def random_pair(rng: Random) -> Pair:
    while True:
        plane, turn = rng.choice(tuple(PLANES)), rng.choice(("cw", "ccw"))
        first, second, i, j = PLANES[plane]
        start, radius = complex(rng.uniform(-60, 60), rng.uniform(-60, 60)), rng.uniform(10, 40)
        center = start + rect(radius, rng.uniform(-pi, pi))
        on = center + rect(radius, rng.uniform(-pi, pi))
        arc = {first: on.real, second: on.imag}
        if rng.random() < 0.5:
            sweep = phase((on - center) / (start - center)) * (1 if turn == "ccw" else -1)
            arc["R"] = radius if sweep > 0 else -radius
        else:
            arc |= {i: (center - start).real, j: (center - start).imag}
        crossing, along = center + rect(radius, rng.uniform(-pi, pi)), rng.uniform(-180, 180)
        end = crossing + rect(rng.uniform(10, 50), radians(along))
        q = 1.0 if ((crossing - center) * rect(1, radians(along)).conjugate()).real > 0 else -1.0
        line = {first: end.real, second: end.imag, ",A": along, "Q": q}
        outcome = circle_line(plane, start, turn, arc, line)
        if outcome.status != "solved" or outcome.is_near or len(outcome.elements) != 2:
            continue
        parts = dict(zip(("arc", "line"), (Part(*each[1:]) for each in outcome.elements), strict=True))
        if abs(parts["line"].end - parts["line"].start) < 1 or abs(parts["arc"].end - start) < 1 or abs(on - start) < 5:
            continue
        points = {"S": start, "P1": parts["line"].start, "N2": end}
        return Pair(plane, start, turn, arc, line, Drawing(points, parts))


def pair_drawing(contour: Contour) -> Drawing:
    found = drawing_of(contour)
    return Drawing({**found.points, "N2": complex(*contour.end)}, found.parts)


def pair_facts(pair: Pair, units: Units, rng: Random) -> Iterator[Fact]:
    drawn = pair.drawn
    yield from line_facts("line", "P1", "N2", drawn, units, rng)
    yield from round_facts("arc", drawn, units, rng)
    yield quantity(
        "size", "radius of arc", units.length(drawn.parts["arc"].radius), lambda d: d.parts["arc"].radius, drawn
    )
    yield from coordinates("P1", "point", lambda d: d.points["P1"], drawn, units)
    yield from coordinates("N2", "point", lambda d: d.points["N2"], drawn, units)


def pair_erasures(pair: Pair) -> list[str]:
    """The words of which one fact can take the place."""
    first, second, _, _ = PLANES[pair.plane]
    return [*(word for word in ("1R",) if "R" in pair.arc), f"2{first}", f"2{second}", "2,A"]


def is_moved_pair(pair: Pair, erased: str, fact: Fact) -> bool:
    which, address = ("arc", erased[1:]) if erased[0] == "1" else ("line", erased[1:])
    rates = []
    for step in (1e-4, -1e-4):
        words = {"arc": dict(pair.arc), "line": dict(pair.line)}
        words[which][address] += step
        outcome = circle_line(pair.plane, pair.start, pair.turn, words["arc"], words["line"])
        if outcome.status != "solved" or len(outcome.elements) != 2:
            return False
        parts = dict(zip(("arc", "line"), (Part(*each[1:]) for each in outcome.elements), strict=True))
        points = {"S": pair.start, "P1": parts["line"].start, "N2": parts["line"].end}
        rates.append(abs(fact.miss(Drawing(points, parts))) / 1e-4)
    return min(rates) > 0.02 * (0.1 if address == ",A" else 1)


@pytest.mark.parametrize(("seeds", "least"), [(1, 1), pytest.param(30, 10, marks=pytest.mark.slow)])
def test_a_circle_and_a_line_come_back_from_a_fact_instead_of_a_word(seeds: int, least: int) -> None:
    kinds, words, unfinished = Counter[str](), Counter[str](), 0
    for seed in range(seeds):
        rng = Random(seed)
        pair, name = random_pair(rng), rng.choice(("mm", "inch"))
        units = pair.units(25.4 if name == "inch" else 1.0)
        for fact in pair_facts(pair, units, rng):
            candidates = [word for word in pair_erasures(pair) if is_moved_pair(pair, word, fact)]
            if not candidates or kinds[fact.kind] >= OFTEN:
                continue
            erased = rng.choice(candidates)
            mark = rng.choice(("?", "")) if erased[0] == "2" else "?"
            program = pair.program(units, {erased: mark})
            arguments = {"control": "nct-99m", "units": name, "facts": [fact.text], "depth": "verdict"}
            (answer,) = solve(program, **arguments).answers
            listing = list_solutions(answer)
            assert listing is not None, (program, arguments, [each.message for each in answer.diagnostics])
            found = [pair_drawing(each.contour) for each in listing.solutions if each.contour]
            assert all(abs(fact.miss(drawing)) < 1e-7 for drawing in found), (program, arguments)
            nearest = min((gap_between(drawing, pair.drawn) for drawing in found), default=1e9)
            assert nearest < TOLERANCE or not listing.is_complete, (program, arguments)
            unfinished += nearest >= TOLERANCE
            kinds[fact.kind] += nearest < TOLERANCE
            words[erased[1:]] += 1
            if answer.status is Status.SOLVED and nearest < TOLERANCE and mark:
                (asked,) = answer.answers
                assert asked.value is not None
                assert answer.contour is not None
                if gap_between(pair_drawing(answer.contour), pair.drawn) < TOLERANCE:
                    true = abs(pair.arc["R"]) if erased == "1R" else pair.line[erased[1:]]
                    off = asked.value - true
                    assert abs(wrapped(off) if erased == "2,A" else off) < TOLERANCE, (program, arguments)
    assert min(kinds.values()) >= least, kinds
    assert min(words.values()) >= least, words
    assert unfinished == 0


def test_without_q_both_intersections_are_listed_each_with_its_q() -> None:
    seen = Counter[tuple[str, ...]]()
    for seed in range(40):
        rng = Random(seed)
        pair = random_pair(rng)
        units = pair.units(1.0)
        (answer,) = solve(pair.program(units, {"2Q": "?"}), control="nct-99m", depth="verdict").answers
        listing = list_solutions(answer)
        assert listing is not None
        assert listing.is_complete
        at_center = [each for each in listing.solutions if each.contour]
        for each in at_center:
            (q,) = [word for word in each.selects if word.startswith("Q")]
            r = [word for word in each.selects if word.startswith("R")]
            line = {**pair.line, "Q": float(q[1:])}
            arc = {**pair.arc, "R": copysign(pair.arc["R"], -1 if r[0][1] == "-" else 1)} if r else pair.arc
            outcome = circle_line(pair.plane, pair.start, pair.turn, arc, line)
            assert outcome.status == "solved"
            assert each.contour is not None
            assert largest_gap(outcome, each.contour) < TOLERANCE
            seen[each.selects] += 1
        mine = [pair_drawing(each.contour) for each in at_center if each.contour]
        assert min(gap_between(drawing, pair.drawn) for drawing in mine) < TOLERANCE
        lines = [{**pair.line, "Q": q} for q in (1.0, -1.0)]
        outcomes = [circle_line(pair.plane, pair.start, pair.turn, pair.arc, line) for line in lines]
        legal = [outcome for outcome in outcomes if outcome.status == "solved"]
        assert (answer.status is Status.AMBIGUOUS) == (len(legal) > 1)
    assert len({selects for selects in seen if "Q1" in selects}) > 0
    assert len({selects for selects in seen if "Q-1" in selects}) > 0


def test_a_tangent_line_has_its_direction_and_its_point() -> None:
    """From the circle's far side to a given end: the tangents touch where the angle from the centre says."""
    for seed in range(30):
        rng = Random(seed)
        radius, turn = rng.uniform(10, 40), rng.choice(("cw", "ccw"))
        start = rect(radius, rng.uniform(-pi, pi))
        end = rect(radius * rng.uniform(1.2, 3), rng.uniform(-pi, pi))
        # It is tangent on the side from which the arc goes on into the line.
        way = 1 if turn == "ccw" else -1
        touch = radius * end / abs(end) * rect(1, -way * acos(radius / abs(end)))
        program = (
            f"G17 G41 G0 X{start.real:.12f} Y{start.imag:.12f}\n"
            f"{'G3' if turn == 'ccw' else 'G2'} I{-start.real:.12f} J{-start.imag:.12f}\n"
            f"G1 X{end.real:.12f} Y{end.imag:.12f} ,A?"
        )
        (answer,) = solve(program, facts=["line tangent to arc"], depth="verdict").answers
        assert answer.status is Status.SOLVED, program
        assert answer.contour is not None
        assert abs(complex(*answer.contour.points["P1"]) - touch) < TOLERANCE, program
        (asked,) = answer.answers
        assert wrapped((asked.value or 0.0) - direction(end - touch)) == pytest.approx(0, abs=1e-6), program


def test_an_unknown_centre_comes_back_from_two_facts() -> None:
    for seed in range(30):
        rng = Random(seed)
        pair = random_pair(rng)
        _, _, i, j = PLANES[pair.plane]
        units = pair.units(1.0)
        facts = [*coordinates("center of arc", "center", lambda d: d.parts["arc"].center or 0j, pair.drawn, units)]
        if rng.random() < 0.5:
            size, axis = pair.drawn.parts["arc"].radius, rng.choice((0, 1))
            radius = units.length(size)
            facts[axis] = quantity("size", "radius of arc", radius, lambda d: d.parts["arc"].radius, pair.drawn)
        asked = replace_words(pair, {i: "?", j: "?"})
        (answer,) = solve(asked, control="nct-99m", facts=[fact.text for fact in facts], depth="verdict").answers
        found = [pair_drawing(each.contour) for each in solutions_listed(answer) if each.contour]
        assert min(gap_between(drawing, pair.drawn) for drawing in found) < TOLERANCE, asked
        assert all(abs(fact.miss(drawing)) < 1e-7 for drawing in found for fact in facts)
        if answer.status is Status.SOLVED and facts[0].kind == facts[1].kind:
            center = (pair.drawn.parts["arc"].center or 0j) - pair.start
            assert [each.value for each in answer.answers] == pytest.approx([center.real, center.imag], abs=TOLERANCE)


def replace_words(pair: Pair, arc: dict[str, str]) -> str:
    """The pair's program with an arc that states nothing but these words."""
    lines = pair.program(pair.units(1.0)).split("\n")
    lines[1] = " ".join([lines[1].split()[0], *(address + text for address, text in arc.items())])
    return "\n".join(lines)


def solutions_listed(answer: Answer) -> list[Any]:
    listing = list_solutions(answer)
    assert listing is not None
    return list(listing.solutions)


# The command line -----------------------------------------------------------------------------------------

START = ("--start", "X40. Z0.")
ONE = "G111 A180. K-30. B120. X100. P5. Q5."
PAIR_TEXT = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"


def run(*arguments: str) -> tuple[int, str, str]:
    done = CliRunner().invoke(main, list(arguments))
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    assert "Traceback" not in done.output
    return done.exit_code, done.stdout, done.stderr


def options(facts: Iterable[str]) -> list[str]:
    return [part for fact in facts for part in ("--fact", fact)]


def document(block: str, *facts: str) -> dict[str, Any]:
    lines = [part for line in block.splitlines() for part in ("--block", line)]
    start = START if "G111" in block else ()
    status, output, errors = run("solve", *lines, *start, *options(facts), "--format", "json")
    found = json.loads(output)
    assert errors == ""
    assert status == any(each["severity"] == "error" for each in found["diagnostics"])
    return dict(found)


def contour_of(block: str, *facts: str) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
    found = document(block, *facts)
    (contour,) = found["contours"]
    return contour, {each["code"]: each for each in found["diagnostics"]}


@pytest.mark.parametrize(
    "program", [f"G00 X40. Z0.\n{ONE}\nG00 X40. Z0.\n{ONE}", f"{PAIR_TEXT}\nG0 X50 Y0\n" + PAIR_TEXT]
)
@pytest.mark.parametrize("command", ["solve", "check"])
def test_a_fact_for_one_of_two_contours_is_refused(command: str, program: str) -> None:
    blocks = [part for line in program.splitlines() for part in ("--block", line)]
    status, output, errors = run(command, *blocks, "--fact", "length of line 1 = 30")
    assert status == 2
    assert output == ""
    assert "2 contours" in errors
    assert "(contoursolve: ...)" in errors
    with pytest.raises(FactPlaceError, match="2 contours"):
        solve(program, facts=["length of line 1 = 30"])


def test_a_fact_in_a_comment_is_about_its_own_contour() -> None:
    first, second = (
        f"{ONE} (contoursolve: length of line 1 = ?)",
        "G111 A180. B120. X160. (contoursolve: Z of V1 = -80)",
    )
    result = solve(f"G00 X40. Z0.\n{first}\n{second}")
    assert [answer.status.value for answer in result.answers] == ["solved", "solved"]
    assert [len(answer.claim.directives) for answer in result.answers] == [1, 1]
    assert result.answers[1].contour is not None
    assert result.answers[1].contour.points["V1"][0] == -80


TAPER_ADDRESSES = {
    "A": ("A180.", 180.0),
    "K": ("K-30.", -30.0),
    "B": ("B120.", 120.0),
    "X": ("X100.", 50.0),
    "P": ("P5.", 5.0),
    "Q": ("Q5.", 5.0),
}


@pytest.mark.parametrize("address", TAPER_ADDRESSES)
def test_a_word_that_is_asked_for_alone_names_what_is_missing(address: str) -> None:
    word, _ = TAPER_ADDRESSES[address]
    contour, found = contour_of(ONE.replace(word, address + "?"))
    assert contour["status"] == "underdetermined"
    assert contour["asked"] == [
        {"word": address + "?", "line": 1, "unit": "deg" if address in "AB" else "mm", "value": None}
    ]
    assert found["words-missing"]["severity"] == "error"
    missing = {"A": "V1", "K": "V1", "B": "V2", "X": "V2", "P": "corner 1", "Q": "corner 2"}[address]
    assert missing in found["words-missing"]["message"]


ASKED_OF_A_WHOLE_BLOCK = [("I", 0.0), ("U", 30.0), ("Z", -47.320508075689), ("W", -47.320508075689)]


@pytest.mark.parametrize(
    ("address", "value"),
    [
        *ASKED_OF_A_WHOLE_BLOCK,
    ],
)
def test_a_word_that_the_others_determine_can_be_asked_for(address: str, value: float) -> None:
    contour, _ = contour_of(f"G111 A180. K-30. B120. X100. {address}?")
    assert contour["status"] == "solved"
    assert contour["asked"][0]["value"] == pytest.approx(value)


MILL_ADDRESSES = [
    ("X-50 Y0 R50", "X? Y0 R50"),
    ("X-50 Y0 R50", "X-50 Y? R50"),
    ("X-50 Y0 R50", "X-50 Y0 R?"),
    ("X-50 Y0 R50", "I? J0"),
    ("X-50 Y0 R50", "I-50 J?"),
    ("G1 X-50", "G1 X?"),
    ("Y42.857", "Y?"),
    (",A171.87", ",A?"),
]


@pytest.mark.parametrize(("old", "new"), MILL_ADDRESSES)
def test_a_word_of_a_pair_that_is_asked_for_alone_is_missing(old: str, new: str) -> None:
    contour, found = contour_of(PAIR_TEXT.replace(old, new))
    assert contour["status"] == "underdetermined"
    assert [each["value"] for each in contour["asked"]] == [None]
    assert "words-missing" in found


def test_q_may_be_asked_for_and_both_of_its_values_are_told() -> None:
    contour, found = contour_of(PAIR_TEXT.replace("Q-1", "Q?"))
    assert contour["status"] == "ambiguous"
    assert found["several-contours"]["severity"] == "error"
    paths = [each for each in contour["solutions"] if each["is_path"]]
    assert sorted(each["selects"] for each in paths) == [["Q-1"], ["Q1"]]
    assert contour["count"]["contours"] == 2
    assert contour["count"]["is_complete"]
    assert not any(each["is_chosen"] for each in contour["solutions"])


# Findings -------------------------------------------------------------------------------------------------

CONTRADICTIONS = [
    ("length of line 1 = 31", "31.000"),
    ("Z of V1 = -29", "-29.000"),
    ("X of S = 41", "41.000"),
    ("radius of corner 1 = 6", "6.000"),
    ("direction of line 2 = 60", "60.000"),
    ("angle from line 1 to line 2 = -50", "-50.000"),
    ("straight part of line 1 = 20", "20.000"),
    ("Z of center of corner 1 = -28", "-28.000"),
]


@pytest.mark.parametrize(("fact", "value"), CONTRADICTIONS)
def test_a_fact_that_contradicts_the_words_is_named(fact: str, value: str) -> None:
    contour, found = contour_of(ONE, fact)
    assert contour["status"] == "conflicting"
    assert contour["elements"] == []
    assert fact in found["words-conflict"]["message"]
    assert value in found["words-conflict"]["message"]
    assert (found["words-conflict"]["line"], found["words-conflict"]["end_column"]) == (1, len(ONE) + 1)
    assert found["words-conflict"]["fact"] == {"number": 1, "column": 1, "end_column": len(fact) + 1}


VALUELESS = [
    "length of line 1 = length of line 2",
    "radius of corner 1 = radius of corner 2",
    "line 1 passes through (Z-10. X41.)",
    "corner 1 passes through (Z-28. X50.)",
    "line 1 tangent to circle (Z-10. X46. R4.)",
    "corner 1 tangent to circle (Z-10. X46. R4.)",
    "corner 1 tangent to line (Z-10. X46. A0.)",
]


@pytest.mark.slow
@pytest.mark.parametrize("fact", VALUELESS)
def test_a_fact_without_a_value_that_contradicts_the_words_is_named(fact: str) -> None:
    contour, found = contour_of(ONE.replace("Q5.", "Q4."), fact)
    assert contour["status"] in ("conflicting", "no-solution")
    assert contour["elements"] == []
    assert any(fact in each["message"] for each in found.values())


AGREEMENTS = [
    "length of line 1 = 30",
    "Z of V1 = -30",
    "X of S = 40",
    "radius of corner 1 = 5",
    "direction of line 2 = -240",
    "angle from line 1 to line 2 = -60",
    "line 1 passes through (Z-10. X40.)",
    "radius of corner 1 = radius of corner 2",
    "line 1 tangent to circle (Z-10. X46. R3.)",
    "corner 1 tangent to line (Z-10. X40. A0.)",
]


@pytest.mark.parametrize("fact", AGREEMENTS)
def test_a_fact_that_the_words_say_already_is_redundant_and_named(fact: str) -> None:
    contour, found = contour_of(ONE, fact)
    assert contour["status"] == "overdetermined"
    assert contour["elements"] == contour_of(ONE)[0]["elements"]
    assert fact in found["words-redundant"]["message"]
    assert found["words-redundant"]["severity"] == "warning"


def test_facts_that_contradict_one_another_have_no_contour() -> None:
    contour, found = contour_of("G111 X100. Z-47. B120.", "length of line 1 = 3")
    assert contour["status"] == "no-solution"
    assert contour["solutions"] == []
    assert contour["count"]["is_complete"]
    assert "no-point" in found


@pytest.mark.parametrize(
    ("block", "facts", "free"),
    [
        ("G111 A180. B120. X100.", ["X of V2 = 100"], "V1"),
        ("G111 A180. K-30. B120.", ["length of line 1 = 30"], "V2"),
        ("G111 A180. K-30. B120. X100. P? Q?", ["straight part of line 2 = 20"], "corner 1"),
        ("G111 A180. K-30. B120.", ["direction of line 2 = 120"], "V2"),
    ],
)
def test_what_words_and_facts_leave_free_is_named(block: str, facts: list[str], free: str) -> None:
    contour, found = contour_of(block, *facts)
    assert contour["status"] == "underdetermined"
    assert free in found["words-missing"]["message"]


def test_several_contours_are_listed_and_each_is_selected_by_what_is_offered() -> None:
    """The circle of 30 mm about the start meets the line of 120 degrees through V2 twice."""
    contour, found = contour_of("G111 X100. Z-47. B120.", "length of line 1 = 30")
    assert contour["status"] == "ambiguous"
    assert contour["elements"] == []
    assert "2 contours" in found["several-contours"]["message"]
    assert (contour["count"]["solutions"], contour["count"]["contours"]) == (2, 2)
    assert contour["count"]["is_complete"]
    # V1 = V2 - t * u, at 30 mm from the start: t**2 - 2 t (V2 - S) u + |V2 - S|**2 - 30**2 = 0
    gap, along = complex(-47, 30), rect(1, radians(120))
    half = (gap * along.conjugate()).real
    roots = [half - way * (half**2 - abs(gap) ** 2 + 900) ** 0.5 for way in (1, -1)]
    true = sorted(((complex(-47, 50) - root * along) for root in roots), key=lambda at: at.real)
    listed = sorted((complex(*each["points"]["V1"]) for each in contour["solutions"]), key=lambda at: at.real)
    assert listed == pytest.approx(true, abs=1e-9)
    for each in contour["solutions"]:
        (fact,) = each["selects"]
        chosen, _ = contour_of(f"G111 X100. Z-47. B120. {fact}", "length of line 1 = 30")
        assert chosen["status"] in ("solved", "overdetermined")
        assert chosen["points"]["V1"] == pytest.approx(each["points"]["V1"], abs=1e-3)


def test_what_was_asked_for_is_filled_in_and_the_block_stands_alone() -> None:
    contour, _ = contour_of("G111 X100. A180. K-30. B120. P? Q5.", "straight part of line 2 = 30")
    (block,) = contour["filled"]["blocks"]
    alone, found = contour_of(block)
    assert alone["status"] == "solved"
    assert found == {}
    for mine, theirs in zip(alone["elements"], contour["elements"], strict=True):
        assert hypot(mine["end"][0] - theirs["end"][0], mine["end"][1] - theirs["end"][1]) <= (
            contour["filled"]["deviation_mm"] + 1e-12
        )


@pytest.mark.parametrize("fact", ["length of line 1 = 1e999", "length of line 1 = 1e300", "length of line 1 = 1000001"])
def test_a_value_beyond_all_travel_is_named_as_one_of_a_word_is(fact: str) -> None:
    contour, found = contour_of("G111 A180. B120. X100.", fact)
    assert contour["status"] == "rejected"
    assert "larger than a control can travel" in found["fact-unreadable"]["message"]


@pytest.mark.parametrize(
    ("block", "fact"),
    [
        ("G111 A180. K-30. B120. X100. P?", "Z of begin of corner 1 = 29.9"),
        ("G111 A180. K-30. B120. X100. C?", "Z of begin of corner 1 = -5"),
        ("G111 A180. K-30. B120. X100. P2. D?", "straight part of line 2 = -5"),
    ],
)
def test_a_size_that_would_have_to_be_too_large_or_negative_is_refused(block: str, fact: str) -> None:
    contour, found = contour_of(block, fact)
    assert contour["status"] == "no-solution"
    assert any(each["severity"] == "error" for each in found.values())


ZERO = "length of line 1 = 0"
UNUSUAL = [
    ("G111 A180. K-30. B120. X100. P2.", ["corner 1 tangent to line 2"]),
    ("G111 A180. K-30. B120. X100. P?", ["corner 1 passes through (Z-28. X41.)", "corner 1 tangent to line 2"]),
    ("G111 K-30. I0. B120. X100. P2.", [ZERO]),
    ("G111 A180. B120. X100. Q2.", ["Z of end of corner 2 = -50"]),
    ("G111 K-30. I0. B120. X100. P? Q2.", ["corner 1 tangent to corner 2"]),
    ("G111 A180. K-30. X100. Z?", ["length of line 1 = length of line 2"]),
    ("G111 A? K? B? X? Z? P? Q? C? D? I? U? W?", []),
    ("G111 A180. K-30. X100. C2.", ["Z of begin of corner 1 = -28"]),
    ("G111 A180. K-30. B120. X100. Q5.", ["corner 2 meets line to (Z-40. X100.)"]),
]


@pytest.mark.parametrize(("block", "facts"), UNUSUAL)
def test_unusual_facts_are_answered_without_blaming_the_package(block: str, facts: list[str]) -> None:
    _, found = contour_of(block, *facts)
    assert "not-verified" not in found


def test_a_conflict_can_be_explained() -> None:
    block = ("--block", "G111 A180. K-30. B120. X100.", "--start", "X40. Z0.")
    status, _, _ = run("solve", *block, "--fact", "length of line 2 = 30", "--explain")
    assert status == 1


def test_a_turn_of_nothing_between_neighbours_is_a_tangent() -> None:
    program = "G17 G41 G0 X50 Y0\nG3 I-50 J?\nG1 X-50 Y42.857 ,A171.87 Q-1"
    tangent, _ = contour_of(program, "line tangent to arc")
    smooth, _ = contour_of(program, "angle from arc to line = 0")
    assert [each["is_path"] for each in smooth["solutions"]] == [each["is_path"] for each in tangent["solutions"]]
    assert smooth["status"] == tangent["status"]


# What is said twice, what cannot be, and what to write instead ----------------------------------------------

TWICE = [
    # block, fact, finding, what it is held against, by how much, what is missing elsewhere
    ("G111 A180. K-30. B120. X100.", "direction of line 2 = 120", "words-redundant", "B120.", "", ""),
    ("G111 A180. K-30. B120. X100.", "direction of line 2 = 121.5", "words-conflict", "B120.", "1.500 deg", ""),
    ("G111 A180. K-30. B120.", "direction of line 2 = 121.5", "words-conflict", "B120.", "1.500 deg", "V2"),
    ("G111 A180. B120. X100.", "direction of line 1 = 180", "words-redundant", "A180.", "", "V1"),
    ("G111 A180. K-30. B120.", "length of line 1 = 31", "words-conflict", "K-30. and A180.", "1.000 mm", "V2"),
    ("G111 A180. K-30. B120.", "angle from line 1 to line 2 = -60", "words-redundant", "A180. and B120.", "", "V2"),
    ("G111 A180. B120. X100.", "X of V2 = 102", "words-conflict", "X100.", "2.000 mm", "V1"),
    ("G111 A180. I0 B120. X100.", "length of line 1 = 30", "words-redundant", "I0 and length of line 1", "", ""),
]


@pytest.mark.parametrize(("block", "fact", "code", "others", "off", "missing"), TWICE)
def test_a_fact_that_says_again_what_words_say_is_held_against_just_these(
    block: str, fact: str, code: str, others: str, off: str, missing: str
) -> None:
    contour, found = contour_of(block, fact)
    status = {"words-redundant": "overdetermined", "words-conflict": "conflicting"}[code]
    assert contour["status"] == ("underdetermined" if missing and code == "words-redundant" else status)
    assert others in found[code]["message"]
    assert off in found[code]["message"]
    assert missing in found.get("words-missing", {"message": ""})["message"]
    assert not {"search-unfinished", "no-point", "line-vanishes"} & found.keys()


@pytest.mark.parametrize(
    ("block", "fact", "code", "named"),
    [
        ("G111 X100. Z-47. B120.", "length of line 1 = 3", "no-point", ["B120.", "length of line 1 = 3"]),
        ("G111 A180. K-30. B120. X100. P?", "corner 1 passes through [Z-10. X30.]", "no-point", ["Z-10. X30."]),
        ("G111 I0 B120. X100.", "direction of line 1 = 180", "facts-singular", ["I0", "direction of line 1 = 180"]),
        ("G111 A180. B180. X100. Z-50. P?", "straight part of line 1 = 2", "g111-parallel", ["A180.", "B180."]),
        ("G111 A180. I0 B120. X100. P?", "straight part of line 1 = 2", "g111-not-fixed", ["A180.", "I0"]),
    ],
)
def test_words_and_facts_that_do_not_go_together_are_named(block: str, fact: str, code: str, named: list[str]) -> None:
    _, found = contour_of(block, fact)
    assert all(each in found[code]["message"] for each in named), found[code]["message"]
    assert found[code]["fixes"]


def test_a_search_that_is_given_up_is_undecided_and_says_what_was_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("contoursolve.solving.enumerate.DRAWING", Effort(200, 100, is_guessing=True))
    block, fact = "G111 X100. K-30. B120. P? Q5.", "straight part of line 2 = 5"
    contour, found = contour_of(block, fact, "corner 1 tangent to line [Z-70. X30. A90.]")
    assert contour["status"] == "undecided"
    assert found["search-unfinished"]["message"].startswith("undecided: ")
    assert "corner 1 tangent to line [Z-70. X30. A90.]" in found["search-unfinished"]["message"]
    tried, open_part, *_ = found["search-unfinished"]["notes"]
    assert tried.startswith("tried: every combination of sides, by a search within")
    assert open_part.startswith("not decided: ")
    assert found["search-unfinished"]["help"].startswith("state a simpler fact")


FACT_FIXES = [
    ("G111 A180. K-30. B120. X100. (contoursolve: length of line 1 = 31)", "delete length of line 1 = 31"),
    ("G111 A180. K-30. B120. X100. (contoursolve: length of line 1 = 31)", "write length of line 1 = 30 for"),
    ("G111 A180. K-30. B120. X100. (contoursolve: length of line 1 = 31)", "write K-31. for K-30."),
    ("G111 A180. K-30. B120. X100. (contoursolve: X of V2 = 100; X of V1 = 40)", "delete X of V2 = 100; delete X of"),
    ("G111 A180. K-30. B120. (contoursolve: X of V2 = 100; X of V1 = 40)", "delete X of V1 = 40"),
    ("G111 A180. K-30. X100. (contoursolve: line 2 passes through (Z-40. X80.))", "write [Z-40. X80.] for"),
    ("G111 A180. K-30. B120. (contoursolve X of V2 = 100)", "write (contoursolve: X of V2 = 100) for"),
    ("G111 A180. K-30. B120. X100. F?", "delete F?"),
    ("G111 A180. K-30. B120. X100. (contoursolve: length of line 3 = 1)", "delete length of line 3 = 1"),
]


@pytest.mark.parametrize(("block", "wanted"), FACT_FIXES)
def test_a_fix_of_a_block_with_facts_is_solved_as_it_is_shown(block: str, wanted: str) -> None:
    found = document(block)
    fixes = [fix for each in found["diagnostics"] for fix in each["fixes"]]
    (fix,) = [each for each in fixes if each["description"].startswith(wanted)]
    for each in (each for each in fixes if each["applicability"] != "placeholder"):
        after = document(each["replacement"])
        assert [contour["status"] in ("solved", "overdetermined") for contour in after["contours"]] == [True]
    after = document(fix["replacement"])
    assert not any(each["severity"] == "error" for each in after["diagnostics"])
    z, x = after["contours"][0]["end"]
    assert fix["description"].endswith(f"the contour ends at Z{z:.3f} mm X{2 * x:.3f} mm")


def test_a_word_that_is_missing_besides_facts_is_offered_and_settles_the_block() -> None:
    found = document("G111 A180. B120. X100. P?", "straight part of line 1 = 20")
    fixes = [fix for each in found["diagnostics"] for fix in each["fixes"]]
    asked = {each["description"].removesuffix(" (no number was tried)") for each in fixes}
    assert asked == {"add I?", "add K?", "add Z?", "add W?"}
    after = document(fixes[1]["replacement"].replace("K?", "K-30."), "straight part of line 1 = 20")
    assert [each["status"] for each in after["contours"]] == ["solved"]


def test_a_size_that_is_asked_for_has_no_limit_to_write_but_what_it_follows_from() -> None:
    _, found = contour_of("G111 A180. K-30. B120. X100. P?", "radius of corner 1 = 80")
    assert found["g111-corner-too-large"]["help"].startswith("change radius of corner 1 = 80:")
    assert [each["text"] for each in found["g111-corner-too-large"]["labels"]] == [""]


def test_a_coordinate_that_is_asked_for_tells_where_the_last_corner_lands() -> None:
    asked, _ = contour_of("G111 X? A180. K-30. B120. Q5.", "Z of V2 = -47.")
    stated, _ = contour_of(f"G111 X{2 * asked['points']['V2'][1]:.9f} A180. K-30. B120. Q5.")
    assert asked["status"] == stated["status"] == "solved"
    assert asked["end"] == pytest.approx(stated["end"], abs=1e-6)


@pytest.mark.parametrize("word", ["F?", "N?", "M?", "S?", "T?"])
def test_a_question_about_what_is_no_part_of_the_contour_is_refused(word: str) -> None:
    contour, found = contour_of(f"G111 A180. K-30. B120. X100. {word}")
    assert contour["status"] == "rejected"
    assert word in found.get("asked-nothing", found.get("address-unknown"))["message"]


@pytest.mark.parametrize(
    ("block", "fact", "is_beyond"),
    [
        ("G111 A180. K-30. X100.", "line 2 passes through [Z-60. X160.]", True),
        ("G111 A180. K-30. X100.", "line 2 passes through [Z-40. X80.]", False),
        ("G111 A180. K-30. X100.", "line 2 passes through [Z-45. X100.]", False),
        ("G111 A180. K-30. B120. X100. P?", "corner 1 tangent to line [Z0. X46. A180.]", True),
        ("G111 A180. K-30. B120. X100. P?", "corner 1 passes through [Z-28. X40.5]", False),
        ("G111 A180. K-30. X100.", "line 2 tangent to circle [Z-40. X120. R10.]", False),
    ],
)
def test_a_fact_that_holds_where_nothing_is_cut_is_pointed_out(block: str, fact: str, is_beyond: bool) -> None:
    found = document(block, fact)
    assert ("fact-beyond" in {each["code"] for each in found["diagnostics"]}) is is_beyond, found["contours"]


BESIDE = "G00 X40. Z0.\nG111 A180. K-30. B120. X100. P5. Q? (contoursolve: corner 1 passes beside {})"
CHAIN = "G17 G90 G42 G0 X100 Y20\n{}\n{} (contoursolve: arc tangent to line 1)"


@pytest.mark.parametrize(
    ("text", "control", "status"),
    [
        # The centre of corner 1 lies at Z-27.113, X50: 10 mm beside the place, and 4.910 mm beside the other one.
        (BESIDE.format("[Z-27.1132487 X70.] at 5"), "yasnac-lx3", Status.UNDERDETERMINED),
        (BESIDE.format("[Z-31. X44.] at 0.5"), "yasnac-lx3", Status.CONFLICTING),
        (CHAIN.format("G3 X27 Y28 R50 ,R?", "G3 X-45 Y26 R40"), "nct-99m", Status.REJECTED),
    ],
)
def test_a_fact_that_nothing_needs_is_compared_beside_a_size_that_nothing_tells(text, control, status):
    assert solve(text, control=control).answers[0].status is status


def test_a_word_that_asks_where_it_is_missing_is_to_get_a_value():
    block = "G111 A90. C2. B180. Z-30. Q3."
    (found,) = solve(f"{block} I?", start="X20. Z0.").diagnostics
    assert found.message.endswith(": give I? a value; or add one of X, U")


@pytest.mark.parametrize("length", ["10", "41.2", "41.3", "77"])
def test_a_length_that_is_not_that_of_two_stated_ends_disagrees(length):
    block = f"G17 G90 G0 X0 Y0\nG1 X30 RND=5\nX40 Y40 ; contoursolve: length of line 2 = {length}"
    (finding,) = solve(block, control="siemens-840d").diagnostics
    assert finding.code == "words-conflict"
    off = abs(float(length) - 1700**0.5)
    assert f"by {off:.3f} mm: it states {float(length):.3f} mm, they give 41.231 mm" in finding.message
