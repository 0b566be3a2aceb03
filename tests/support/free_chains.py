"""Chains of lines and arcs that begin in the direction of each other, drawn forwards, and written in FK words."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import atan2, cos, degrees, hypot, pi, radians, sin
from random import Random

import numpy

Point = tuple[float, float]


@dataclass(frozen=True)
class Step:
    """One element by what makes it: the length of a line, or the radius, the sweep (radians) and the sense of an arc."""

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


@dataclass(frozen=True)
class FreeChain:
    """A drawn chain, and a program with just so many data that they determine it; how well they do so."""

    drawn: tuple[Drawn, ...]
    text: str
    least: float


def draw(start: Point, direction: float, steps: list[Step]) -> list[Drawn]:
    """The elements one behind the other."""
    here, way, found = start, direction, []
    for step in steps:
        if step.sense:
            center = (
                here[0] - step.sense * step.radius * sin(way),
                here[1] + step.sense * step.radius * cos(way),
            )
            end = way + step.sense * step.sweep
            head = (
                center[0] + step.sense * step.radius * sin(end),
                center[1] - step.sense * step.radius * cos(end),
            )
        else:
            center, end = here, way
            head = here[0] + step.length * cos(way), here[1] + step.length * sin(way)
        found.append(Drawn(step, here, head, way, end, center))
        here, way = head, end
    return found


Datum = Callable[[list[Drawn]], tuple[float, ...]]


def _data(chain: list[Drawn], random: Random) -> Iterator[tuple[int, str, Datum]]:
    """What may be stated: the number of the element, the words with `{}` for their values, and what they measure."""
    for number, each in enumerate(chain):
        at = lambda found, n=number: found[n]  # noqa: E731 - the element in any chain
        yield number, "X{}", lambda found, at=at: (at(found).head[0],)
        yield number, "Y{}", lambda found, at=at: (at(found).head[1],)
        if random.random() < 0.3:
            yield number, "IX{}", lambda found, at=at: (at(found).head[0] - at(found).tail[0],)
        if each.step.sense:
            yield number, "R{}", lambda found, at=at: (at(found).step.radius,)
            yield number, "CCX{}", lambda found, at=at: (at(found).center[0],)
            yield number, "CCY{}", lambda found, at=at: (at(found).center[1],)
            yield number, "CCA{}", lambda found, at=at: (degrees(at(found).end - at(found).step.sense * pi / 2),)
            yield number, "LEN{}", lambda found, at=at: (hypot(*_way(at(found))),)
        else:
            yield number, "AN{}", lambda found, at=at: (degrees(at(found).begin),)
            yield number, "LEN{}", lambda found, at=at: (at(found).step.length,)
            share, aside = random.uniform(0.2, 0.8), random.choice((-1, 1)) * random.uniform(1, 9)
            if random.random() < 0.3:
                yield number, _point(each, share, 0.0, "P1X{:+.9f} P1Y{:+.9f}"), _passed(number, each, share, 0.0)
            if random.random() < 0.3:
                text = _point(each, share, aside, "PDX{:+.9f} PDY{:+.9f} D") + f"{abs(aside):.9f}"
                yield number, text, _passed(number, each, share, aside)


def _way(each: Drawn) -> Point:
    return each.head[0] - each.tail[0], each.head[1] - each.tail[1]


def _beside(each: Drawn, share: float, aside: float) -> Point:
    way = _way(each)
    length = hypot(*way)
    return (
        each.tail[0] + share * way[0] - aside * way[1] / length,
        each.tail[1] + share * way[1] + aside * way[0] / length,
    )


def _point(each: Drawn, share: float, aside: float, words: str) -> str:
    return words.format(*_beside(each, share, aside))


def _passed(number: int, drawn: Drawn, share: float, aside: float) -> Datum:
    place = _beside(drawn, share, aside)

    def measure(found: list[Drawn]) -> tuple[float, ...]:
        each = found[number]
        off = place[0] - each.tail[0], place[1] - each.tail[1]
        return (cos(each.begin) * off[1] - sin(each.begin) * off[0],)

    return measure


def random_chain(random: Random, least: int = 3, most: int = 15) -> FreeChain:
    """A random chain, whose data determine it well enough for their nine decimals."""
    while True:
        count, steps, was_line = random.randint(least, most), list[Step](), random.random() < 0.5
        for _ in range(count):
            if was_line or random.random() < 0.3:
                sweep = radians(random.uniform(20, 200))
                steps.append(Step(0.0, round(random.uniform(3, 40), 3), sweep, random.choice((-1, 1))))
                was_line = False
            else:
                steps.append(Step(round(random.uniform(5, 60), 3)))
                was_line = True
        start = round(random.uniform(-50, 50), 3), round(random.uniform(-50, 50), 3)
        found = _write(random, start, radians(random.uniform(-180, 180)), steps)
        if found is not None:
            return found


def _write(random: Random, start: Point, direction: float, steps: list[Step]) -> FreeChain | None:
    drawn = draw(start, direction, steps)
    data = list(_data(drawn, random))
    random.shuffle(data)
    values = [direction]
    for step in steps:
        values += [step.radius, step.sweep] if step.sense else [step.length]

    def rebuilt(numbers: list[float]) -> list[Drawn]:
        rest, again = iter(numbers), []
        way = next(rest)
        for step in steps:
            if step.sense:
                again.append(Step(0.0, next(rest), next(rest), step.sense))
            else:
                again.append(Step(next(rest)))
        return draw(start, way, again)

    scale = [1.0 if index == 0 else 1.0 for index in range(len(values))]
    columns = []
    for index in range(len(values)):
        moved = [[*values], [*values]]
        for sign, each in zip((1, -1), moved, strict=True):
            each[index] += sign * 1e-6 * scale[index]
        sides = [[datum(rebuilt(each)) for _, _, datum in data] for each in moved]
        columns.append([(one[0] - other[0]) / 2e-6 for one, other in zip(*sides, strict=True)])
    rows = numpy.array(columns).T
    rows /= numpy.maximum(numpy.linalg.norm(rows, axis=1, keepdims=True), 1e-12)
    kept: list[int] = []
    basis: list[numpy.ndarray] = []
    for index, row in enumerate(rows):
        rest = row.copy()
        for each in basis:
            rest -= (rest @ each) * each
        if numpy.linalg.norm(rest) > 1e-3:
            basis.append(rest / numpy.linalg.norm(rest))
            kept.append(index)
        if len(kept) == len(values):
            break
    if len(kept) < len(values):
        return None
    least = float(numpy.linalg.svd(rows[kept], compute_uv=False)[-1])
    if least < 1e-3:
        return None
    words: dict[int, list[str]] = {number: [] for number in range(len(steps))}
    for index in sorted(kept):
        number, text, datum = data[index]
        words[number].append(text.format(*(f"{value:+.9f}" for value in datum(drawn))) if "{" in text else text)
    lines = ["0 BEGIN PGM CHAIN MM", f"1 L X{start[0]:+} Y{start[1]:+}"]
    for number, step in enumerate(steps):
        function = ("FC" if step.sense else "FL") + ("T" if number else "")
        sense = [f"DR{'+' if step.sense > 0 else '-'}"] if step.sense else []
        lines.append(" ".join([str(number + 2), function, *sense, *words[number]]))
    lines.append(f"{len(steps) + 2} END PGM CHAIN MM")
    return FreeChain(tuple(drawn), "\n".join(lines) + "\n", least)


def bearing(point: Point, center: Point) -> float:
    """The direction from a centre to a point, degrees."""
    return degrees(atan2(point[1] - center[1], point[0] - center[0]))
