"""All chains that have the data of a free contour, by Newton's method from many starts: it shares no code with the
package, and never finds more than there are."""

from collections.abc import Iterator
from dataclasses import replace
from math import exp, hypot, log, pi, remainder
from random import Random

import numpy
from free_chains import Drawn, FreeChain, Point, Step, draw

FARTHEST = 100_000.0
"""mm. How far from the start points and centres may lie."""

STEPS, ARRIVED = 40, 1e-10


def other_chains(chain: FreeChain, random: Random, starts: int) -> list[list[Drawn]]:
    """The chains that are found, each once."""
    found: list[list[Drawn]] = []
    for _ in range(starts):
        size = exp(random.uniform(log(5), log(FARTHEST)))
        values = [random.uniform(-pi, pi)]
        for each in chain.drawn:
            length = log(random.uniform(1, 60)) if random.random() < 0.7 else log(random.uniform(1, size))
            values += [length, random.uniform(0.1, 6)] if each.step.sense else [length]
        drawn = _arrived(chain, values)
        if drawn is not None and _is_possible(drawn) and not any(_are_one(drawn, other) for other in found):
            found.append(drawn)
    return found


def _drawn(chain: FreeChain, values: list[float]) -> list[Drawn]:
    """The chain with these values: the first direction, and the logarithms of lengths and radii with the sweeps."""
    numbers = iter(values)
    way, steps = next(numbers), list[Step]()
    for each in chain.drawn:
        if each.step.sense:
            steps.append(replace(each.step, radius=exp(next(numbers)), sweep=next(numbers)))
        else:
            steps.append(replace(each.step, length=exp(next(numbers))))
    return draw(chain.drawn[0].tail, way, steps)


def _off(chain: FreeChain, values: list[float]) -> list[float]:
    """By how much each datum is off, as the program states it: mm, or degrees up to full turns."""
    drawn = _drawn(chain, values)
    return [
        remainder(measure(drawn) - value, 360) if is_angle else measure(drawn) - value
        for (measure, value), is_angle in zip(chain.data, chain.angles, strict=True)
    ]


def _arrived(chain: FreeChain, values: list[float]) -> list[Drawn] | None:
    size = len(values)
    for _ in range(STEPS):
        if max(values[1:]) > log(10 * FARTHEST):
            return None
        off = numpy.array(_off(chain, values))
        slopes = numpy.empty((size, size))
        for index in range(size):
            step = 1e-6
            ahead, behind = (
                _off(chain, [value + by * (place == index) for place, value in enumerate(values)])
                for by in (step, -step)
            )
            slopes[:, index] = numpy.subtract(ahead, behind) / (2 * step)
        try:
            change = numpy.linalg.solve(slopes, off)
        except numpy.linalg.LinAlgError:
            return None
        largest = float(numpy.abs(change).max())
        if not largest < 1e9:
            return None
        values = [
            value - float(by) * min(1.0, 1.0 / max(largest, 1e-300)) for value, by in zip(values, change, strict=True)
        ]
        if largest < ARRIVED and float(numpy.abs(off).max()) < 1e-7:
            return _drawn(chain, values)
    return None


def _is_possible(drawn: list[Drawn]) -> bool:
    """Whether every arc is shorter than its circle, and all lies within reach."""
    begin = drawn[0].tail
    sweeps = (each.step.sweep for each in drawn if each.step.sense)
    places = (place for each in drawn for place in (each.head, each.center))
    sizes = (each.step.radius or each.step.length for each in drawn)
    return (
        all(1e-3 < sweep < 2 * pi - 1e-3 for sweep in sweeps)
        and all(max(abs(x - begin[0]), abs(y - begin[1])) < FARTHEST for x, y in places)
        and all(size > 1e-2 for size in sizes)
    )


def _are_one(one: list[Drawn], other: list[Drawn]) -> bool:
    return all(_near(first.head, second.head) for first, second in zip(one, other, strict=True))


def _near(one: Point, other: Point) -> bool:
    return hypot(one[0] - other[0], one[1] - other[1]) <= 1e-6 * (1 + hypot(*one))


def heads(drawn: list[Drawn]) -> Iterator[Point]:
    """Where the elements end."""
    return (each.head for each in drawn)
