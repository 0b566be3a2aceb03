"""Chains of lines and arcs that begin in the direction of each other, drawn forwards, and written in FK words."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import cos, degrees, dist, pi, radians, sin
from random import Random

import numpy

Point = tuple[float, float]


@dataclass(frozen=True)
class Step:
    """One element by what makes it: the length of a line; or the radius, sweep (radians) and sense of an arc."""

    length: float = 0.0
    radius: float = 0.0
    sweep: float = 0.0
    sense: int = 0


@dataclass(frozen=True)
class Drawn:
    """One element where it is: its ends, its direction where it begins and where it ends, and its centre."""

    step: Step
    tail: Point
    head: Point
    begin: float
    end: float
    center: Point


Datum = Callable[[Sequence[Drawn]], float]
"""What a word, or the words of a point, measure on a chain."""


@dataclass(frozen=True)
class FreeChain:
    """A drawn chain, a program with just so many data that they determine it, and these data with their values."""

    drawn: tuple[Drawn, ...]
    text: str
    data: tuple[tuple[Datum, float], ...]
    angles: tuple[bool, ...]
    """Which of the data are angles, in degrees."""


def draw(start: Point, direction: float, steps: list[Step]) -> list[Drawn]:
    """The elements one behind the other."""
    here, way, found = start, direction, []
    for step in steps:
        if step.sense:
            center = (here[0] - step.sense * step.radius * sin(way), here[1] + step.sense * step.radius * cos(way))
            end = way + step.sense * step.sweep
            head = (center[0] + step.sense * step.radius * sin(end), center[1] - step.sense * step.radius * cos(end))
        else:
            center, end = here, way
            head = here[0] + step.length * cos(way), here[1] + step.length * sin(way)
        found.append(Drawn(step, here, head, way, end, center))
        here, way = head, end
    return found


def _data(chain: list[Drawn], pole: Point, random: Random) -> Iterator[tuple[int, str, Datum]]:
    """What may be stated: the number of the element, the words with `{}` for their value, and what they measure."""
    for number, each in enumerate(chain):

        def of(measure: Callable[[Drawn], float], n: int = number) -> Datum:
            return lambda found: measure(found[n])

        yield number, "X{}", of(lambda at: at.head[0])
        yield number, "Y{}", of(lambda at: at.head[1])
        if random.random() < 0.3:
            yield number, "IX{}", of(lambda at: at.head[0] - at.tail[0])
        if random.random() < 0.2:
            yield from _polar(number, "", lambda at: at.head, pole, random)
        if each.step.sense and random.random() < 0.2:
            yield from _polar(number, "CC", lambda at: at.center, pole, random)
        if each.step.sense:
            yield number, "R{}", of(lambda at: dist(at.tail, at.center))
            yield number, "CCX{}", of(lambda at: at.center[0])
            yield number, "CCY{}", of(lambda at: at.center[1])
            yield number, "CCA{}", of(lambda at: degrees(at.end - at.step.sense * pi / 2))
            yield number, "LEN{}", of(lambda at: dist(at.tail, at.head))
            continue
        yield number, "AN{}", of(lambda at: degrees(at.begin))
        yield number, "LEN{}", of(lambda at: dist(at.tail, at.head))
        for words, aside in (("P1X{:+.9f} P1Y{:+.9f}", 0.0), ("PDX{:+.9f} PDY{:+.9f} D", random.uniform(1, 9))):
            if random.random() < 0.3:
                place = _beside(each, random.uniform(0.2, 0.8), random.choice((-1, 1)) * aside)
                text = words.format(*place) + (f"{aside:.9f}" if aside else "")
                yield number, text, of(lambda at, place=place: _left(at, place))


def _polar(
    number: int, of: str, place: Callable[[Drawn], Point], pole: Point, random: Random
) -> Iterator[tuple[int, str, Datum]]:
    """How far from the pole the end or the centre of an element is, or how much farther than the end of another one."""
    if number == 0 or random.random() < 0.3:
        yield number, f"{of}PR{{}}", lambda found: dist(place(found[number]), pole)
    else:
        other = random.randrange(number)
        words = f"I{of}PR{{}} R{of}PR {other + FIRST}"
        yield number, words, lambda found: dist(place(found[number]), pole) - dist(found[other].head, pole)


def _beside(each: Drawn, share: float, aside: float) -> Point:
    """A point at a share of a line's length, so far to its left."""
    way = cos(each.begin), sin(each.begin)
    along = share * dist(each.tail, each.head)
    return each.tail[0] + along * way[0] - aside * way[1], each.tail[1] + along * way[1] + aside * way[0]


def _left(each: Drawn, place: Point) -> float:
    """How far to the left of a line a point lies."""
    return cos(each.begin) * (place[1] - each.tail[1]) - sin(each.begin) * (place[0] - each.tail[0])


def random_chain(random: Random, least: int = 3, most: int = 15) -> FreeChain:
    """A random chain, whose data determine it well enough for their nine decimals."""
    while True:
        steps, was_line = list[Step](), random.random() < 0.5
        for _ in range(random.randint(least, most)):
            was_line = not was_line and random.random() < 0.7
            if was_line:
                steps.append(Step(length=round(random.uniform(5, 60), 3)))
            else:
                radius, sweep = round(random.uniform(3, 40), 3), radians(random.uniform(20, 200))
                steps.append(Step(radius=radius, sweep=sweep, sense=random.choice((-1, 1))))
        start = round(random.uniform(-50, 50), 3), round(random.uniform(-50, 50), 3)
        drawn = draw(start, radians(random.uniform(-180, 180)), steps)
        pole = round(random.uniform(-80, 80), 3), round(random.uniform(-80, 80), 3)
        data = list(_data(drawn, pole, random))
        random.shuffle(data)
        kept = _enough(drawn, [datum for _, _, datum in data])
        if kept:
            chosen = [data[index] for index in kept]
            measured = tuple((each, each(drawn)) for _, _, each in chosen)
            angles = tuple(text.startswith(("AN", "CCA")) for _, text, _ in chosen)
            return FreeChain(tuple(drawn), _program(drawn, pole, chosen), measured, angles)


def _enough(drawn: list[Drawn], data: Sequence[Datum]) -> list[int]:
    """The indices of the first data that determine a chain, in order; none if they do not do so well enough."""
    values = [drawn[0].begin, *(value for each in drawn for value in _sizes(each.step))]

    def measured(index: int, by: float) -> list[float]:
        numbers = iter([value + by * (place == index) for place, value in enumerate(values)])
        way = next(numbers)
        steps = [replace(each.step, **{name: next(numbers) for name in _names(each.step)}) for each in drawn]
        again = draw(drawn[0].tail, way, steps)
        return [datum(again) for datum in data]

    step = 1e-6
    columns = [numpy.subtract(measured(n, step), measured(n, -step)) / (2 * step) for n in range(len(values))]
    rows = numpy.array(columns).T
    rows /= numpy.maximum(numpy.linalg.norm(rows, axis=1, keepdims=True), 1e-12)
    kept, basis = list[int](), numpy.zeros((0, len(values)))
    for index, row in enumerate(rows):
        rest = row - basis.T @ (basis @ row)
        if numpy.linalg.norm(rest) > LEAST and len(kept) < len(values):
            basis = numpy.vstack([basis, rest / numpy.linalg.norm(rest)])
            kept.append(index)
    is_enough = len(kept) == len(values) and numpy.linalg.svd(rows[kept], compute_uv=False)[-1] > LEAST
    return sorted(kept) if is_enough else []


LEAST = 1e-3
"""The least share by which data must tell chains apart."""


def _names(step: Step) -> tuple[str, ...]:
    return ("radius", "sweep") if step.sense else ("length",)


def _sizes(step: Step) -> tuple[float, ...]:
    return tuple(getattr(step, name) for name in _names(step))


FIRST = 3
"""The block number of the first element."""


def _program(drawn: list[Drawn], pole: Point, data: Sequence[tuple[int, str, Datum]]) -> str:
    start = drawn[0].tail
    lines = ["0 BEGIN PGM CHAIN MM", f"1 L X{start[0]:+} Y{start[1]:+}", f"2 FPOL X{pole[0]:+} Y{pole[1]:+}"]
    for number, each in enumerate(drawn):
        function = ("FC" if each.step.sense else "FL") + ("T" if number else "")
        sense = [f"DR{'+' if each.step.sense > 0 else '-'}"] if each.step.sense else []
        words = [text.format(f"{datum(drawn):+.9f}") if "{" in text else text for n, text, datum in data if n == number]
        lines.append(" ".join([str(number + FIRST), function, *sense, *words]))
    return "\n".join([*lines, f"{len(drawn) + FIRST} END PGM CHAIN MM", ""])
