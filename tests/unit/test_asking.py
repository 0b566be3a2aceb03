"""Values asked for with `?`, and further facts instead of words: the drawing that the words made comes back.

Each drawing is made by the oracle from its words. Then a word is erased, something is measured on the drawing
with the geometry of this file, and stated with 12 decimals: the drawing must be among the solutions, every
solution must satisfy words and facts, and where there is only one, what was erased must be told.
"""

import re
from cmath import phase, rect
from functools import partial
from math import degrees, pi, remainder
from random import Random

import pytest
from generate_g111 import B_AND_ONE, ENDS, SHAPES, draw_g111
from oracle import elements_of, g111

from contoursolve import Status, solve

TOLERANCE = 1e-6
"""mm. What 12 decimals of a fact leave of a drawing that is not close to a singular one."""
ANGLES, CORNERS = ("A", "B"), ("corner 1", "corner 2")
LINES = {"line 1": ("S", "V1"), "line 2": ("V1", "V2")}
OWN = [each for each in SHAPES if len(each.line1) == 2 and each.line2 in (*B_AND_ONE, *ENDS)]


def drawing_of(start, points, names, elements):
    """The places of a drawing by their names, mm, X as radius, and what else it has by the text of its fact."""
    drawn = {"S": start, **points}
    for name, (tail, head) in LINES.items():
        drawn[f"length of {name}"] = abs(drawn[head] - drawn[tail])
        drawn[f"direction of {name}"] = degrees(phase(drawn[head] - drawn[tail]))
    drawn["angle from line 1 to line 2"] = degrees(phase((drawn["V2"] - drawn["V1"]) / (drawn["V1"] - start)))
    for name, each in zip(names, elements, strict=True):
        if name in LINES:
            drawn[f"straight part of {name}"] = abs(each.end - each.start)
            continue
        drawn |= {f"begin of {name}": each.start, f"end of {name}": each.end}
        drawn[f"radius of {name}"] = each.radius or abs((each.end - each.start).real)
        if each.center is None:
            drawn[f"length of {name}"] = abs(each.end - each.start)
        else:
            drawn[f"center of {name}"] = each.center
    return drawn


def solutions_of(answer, start):
    for each in answer.solutions.solutions if answer.solutions else ():
        if each.contour:
            points = {name: complex(*at) for name, at in each.contour.points.items()}
            yield drawing_of(start, points, [part.name for part in each.contour.elements], elements_of(each))


def wrapped(angle):
    return remainder(angle, 360.0)


def is_angle(name):
    return name in ANGLES or name.startswith(("direction", "angle"))


def gap_between(one, other):
    """The largest difference of any two things that correspond, mm; infinite if the drawings differ in kind."""
    if one.keys() != other.keys():
        return float("inf")
    return max(abs(one[name] - other[name]) for name in one if not is_angle(name))


def beside(line, place, drawn):
    """How far a place lies to the left of a line."""
    tail, head = (drawn[name] for name in LINES[line])
    return ((head - tail).conjugate() * (place - tail)).imag / abs(head - tail)


def missed(name, value, axis, drawn):
    if isinstance(found := drawn.get(name, 0.0), complex):
        found = found.imag if axis else found.real
    return wrapped(found - value) if is_angle(name) else found - value


def facts_of(drawn, rng, in_mm):
    """Everything that is told of a drawing: the text, and by how much another drawing misses it, mm or degrees."""

    def length(mm):
        return f"{mm / in_mm:.12f}"

    def at(place):
        return f"Z{length(place.real)} X{length(2 * place.imag)}"

    for name, value in drawn.items():
        if isinstance(value, complex) and name != "S":
            for axis, letter, part in ((0, "Z", value.real), (1, "X", value.imag)):
                text = f"{letter} of {name} = {length(part * (1 + axis))}"
                yield text, partial(missed, name, part, axis)
        elif is_angle(name):
            turned = value + (rng.choice((-360, 0, 360)) if "direction" in name else 0)
            yield f"{name} = {turned:.12f}", partial(missed, name, value, 0)
        elif name != "S":
            yield f"{name} = {length(value)}", partial(missed, name, value, 0)
    for name, (tail, head) in LINES.items():
        along = drawn[head] - drawn[tail]
        place = drawn[tail] + along * rng.choice(
            (rng.uniform(-0.7, -0.3), rng.uniform(0.3, 0.7), rng.uniform(1.3, 1.7))
        )
        radius = rng.uniform(1, 20)
        center = place + rng.choice((1j, -1j)) * radius * along / abs(along)
        yield f"{name} passes through ({at(place)})", partial(beside, name, place)
        touches = f"{name} tangent to circle ({at(center)} R{length(radius)})"
        yield touches, lambda d, line=name, c=center, r=radius: abs(beside(line, c, d)) - r
    for middle, size in ((f"center of {name}", f"radius of {name}") for name in CORNERS):
        if middle not in drawn:
            continue
        name, radius, spoke = middle[10:], drawn[size], rect(1, rng.uniform(-pi, pi))
        on = drawn[middle] + radius * spoke
        place = on + spoke * 1j * rng.uniform(-10, 10)
        yield f"{name} passes through {at(on)}", lambda d, m=middle, s=size, on=on: abs(on - d[m]) - d[s]
        yield (
            f"{name} tangent to line ({at(place)} A{degrees(phase(spoke * 1j)):.12f})",
            lambda d, m=middle, s=size, place=place, spoke=spoke: abs((spoke.conjugate() * (d[m] - place)).real) - d[s],
        )
        other, way = radius * rng.uniform(0.3, 0.8), rng.choice((1, -1))
        there = drawn[middle] + (radius + way * other) * spoke
        yield (
            f"{name} tangent to circle {at(there)} R{length(other)}",
            lambda d, m=middle, s=size, at=there, r=other: min(
                (abs(at - d[m]) - abs(d[s] + side * r) for side in (1, -1)), key=abs
            ),
        )


def random_taper(rng):
    """The start, the words (mm, degrees, X and U as diameters) and the drawing of a block of two words a line."""
    while True:
        case = draw_g111(rng, rng.choice(OWN), rng.randrange(4), rng.choice((1, -1)), (False, False))
        if case is None or case.outcome.status != "solved" or case.outcome.is_near:
            continue
        x, z = (float(each) for each in re.findall(r"-?\d+\.\d+", case.program[0]))
        words = {name: float(value) for name, value in re.findall(r"([A-Z])(-?\d+\.\d+)", case.program[1])}
        names = ["line 1", "corner 1", "line 2", "corner 2"]
        names = [name for name, own in zip(names, ("AIK", "CP", "BXUZW", "DQ"), strict=True) if {*own} & {*words}]
        start, outcome = complex(z, x / 2), case.outcome
        return start, words, drawing_of(start, outcome.points, names, outcome.elements), outcome.end, names


def is_moved(start, words, names, erased, miss):
    """Whether a fact says anything about an erased word: a change of the word changes what the fact measures."""
    rates = []
    for step in (1e-4, -1e-4):
        outcome = g111(start, {**words, erased: words[erased] + step})
        if outcome.status != "solved" or len(outcome.elements) != len(names):
            return False
        rates.append(abs(miss(drawing_of(start, outcome.points, names, outcome.elements))) / 1e-4)
    return min(rates) > 0.02 * (0.1 if erased in ANGLES else 1)


def is_quick(words, erased, text):
    """Facts on a corner are searched for where a line has no direction of its own: only some are tried then."""
    headings = {*ANGLES} & (words.keys() - {erased})
    is_searched = text.startswith("corner") or re.search(r"(begin|end|center) of|straight part", text)
    return len(headings) == 2 or not (is_searched or (text.startswith("angle") and not headings))


def value_of(word, drawn):
    s, v1, v2 = drawn["S"], drawn["V1"], drawn["V2"]
    return {
        "A": drawn["direction of line 1"], "B": drawn["direction of line 2"], "I": (v1 - s).imag, "K": (v1 - s).real,
        "X": 2 * v2.imag, "U": 2 * (v2 - s).imag, "Z": v2.real, "W": (v2 - s).real,
    }[word]  # fmt: skip


@pytest.mark.parametrize("seed", range(16))
def test_a_taper_comes_back_from_a_fact_instead_of_a_word(seed):
    rng, count = Random(seed), 0
    start, words, drawn, end, names = random_taper(rng)
    units, in_mm = rng.choice((("mm", 1.0), ("inch", 25.4)))
    for text, miss in facts_of(drawn, rng, in_mm):
        able = [word for word in words if is_quick(words, word, text) and is_moved(start, words, names, word, miss)]
        if not able:
            continue
        erased = rng.choice(able)
        mark = "?" if erased in "CPDQ" else rng.choice(("?", ""))
        facts = [text]
        if erased in "XUZW" and "corner 2" in names:
            facts.append(f"corner 2 meets line at {90 * round(degrees(phase(end - drawn['V2'])) / 90)}")
        if not mark and rng.random() < 0.5:
            facts.insert(0, "length of line 1 = ?")
        own = {name: f"{value / (1 if name in ANGLES else in_mm):.12f}" for name, value in words.items()}
        own[erased] = mark
        block = " ".join(["G111", *(name + value for name, value in own.items() if value)])
        place = f"Z{start.real / in_mm:.12f} X{2 * start.imag / in_mm:.12f}"
        (answer,) = solve(block, start=place, units=units, facts=facts, depth="verdict").answers
        found, told = [*solutions_of(answer, start)], (block, place, units, facts)
        for each in found:
            assert abs(miss(each)) < 1e-7, told
            for word in words.keys() - {erased, *"CPDQ"}:
                off = value_of(word, each) - words[word]
                assert abs(wrapped(off) if word in ANGLES else off) < 1e-7, (told, word)
        nearest = min((gap_between(each, drawn) for each in found), default=1e9)
        assert nearest < TOLERANCE or (answer.solutions is not None and not answer.solutions.is_complete), told
        if answer.status is Status.SOLVED:
            assert len(found) == 1
            for asked in answer.asked:
                is_own = asked.question.word.text == f"{erased}?"
                value = asked.value * (2 if is_own and erased in "XU" else 1)
                off = value - (words[erased] if is_own else drawn["length of line 1"])
                assert abs(wrapped(off) if is_own and erased in ANGLES else off) < TOLERANCE, told
        else:
            assert answer.status is Status.AMBIGUOUS, told
            assert len(found) > 1
            assert all(each.value is None for each in answer.asked)
        count += 1
    assert count >= 4


def test_a_refused_fact_leaves_a_system_that_can_be_looked_at():
    (answer,) = solve(
        "G111 X100. A180. K-30. B120. P?", start="X40. Z0.", facts=["length of corner 1 = 12"], depth="verdict"
    ).answers
    assert answer.status is Status.REJECTED
    assert [each.value for each in answer.system.unknowns] == [None] * 4
    assert len(answer.system.equations) == 4


SEARCHED = [
    # The direction of a line that a corner stands on is not known.
    ("A180. K-30. B? X100. P5.", "straight part of line 1 = 27.113248654052", 120.0),
    ("A180. K-30. B? X100. P5.", "Z of end of corner 1 = -31.443375672974", 120.0),
    ("A? K-30. B120. X100. P5.", "X of center of corner 1 = 50", 180.0),
    ("A? I0. X100. Z-47.320508075689", "angle from line 1 to line 2 = -60", 180.0),
]


@pytest.mark.parametrize(("words", "fact", "value"), SEARCHED)
def test_a_direction_is_found_from_a_fact_about_a_corner(words, fact, value):
    (answer,) = solve(f"G111 {words}", start="X40. Z0.", facts=[fact], depth="verdict").answers
    assert any(abs(drawn["V1"] - (-30 + 20j)) < TOLERANCE for drawn in solutions_of(answer, 20j))
    if answer.status is Status.SOLVED:
        assert wrapped((answer.asked[0].value or 0.0) - value) == pytest.approx(0, abs=TOLERANCE)
