"""Sketches made backwards from contours at random, with fields taken away: solved, or what is missing is told truly."""

from decimal import Decimal
from math import atan2, cos, degrees, dist, hypot, radians, sin
from typing import Any

from examples import law
from hypothesis import strategies as st
from msgspec.structs import replace

import contoursolve
from contoursolve import ContourSketch, SketchElement
from contoursolve.sketches import write_sketch

DETERMINING = {
    "line": (
        "first second",
        "angle first",
        "angle second",
        "angle length",
        "step1 second",
        "first step2",
        "step1 step2",
    ),
    "arc": ("center1 center2 end", "center1 center2 first second", "radius angle end", "angle first second"),
}
"""Words that determine an element behind a known point; for most values, in one way."""


class Drawn:
    """A contour of integer coordinates, and the true value of each word of each element."""

    def __init__(self, part: str, pieces: list[tuple[bool, int, int, int]]) -> None:
        self.axes = ("Z", "X") if part == "turned" else ("X", "Y")
        self.factor = (1, 2) if part == "turned" else (1, 1)
        here, self.elements, self.ends = (0.0, 10.0), list[tuple[str, str, dict[str, Decimal]]](), []
        for is_arc, first, second, sweep in pieces:
            values: dict[str, float] = {}
            if is_arc:
                center = here[0] + first, here[1] + second
                radius, begin = hypot(first, second), degrees(atan2(-second, -first))
                end = begin + sweep
                there = center[0] + radius * cos(radians(end)), center[1] + radius * sin(radians(end))
                values |= {"R": radius, "CCA": end, "AN": begin + (90 if sweep > 0 else -90)}
                values |= {f"CC{axis}": center[n] * self.factor[n] for n, axis in enumerate(self.axes)}
            else:
                there = here[0] + first, here[1] + second
                values |= {"AN": degrees(atan2(second, first)), "LEN": hypot(first, second)}
            values |= {axis: there[n] * self.factor[n] for n, axis in enumerate(self.axes)}
            values |= {f"I{axis}": (there[n] - here[n]) * self.factor[n] for n, axis in enumerate(self.axes)}
            kind = "arc" if is_arc else "line"
            self.elements.append(
                (kind, "ccw" if sweep > 0 else "cw", {n: Decimal(f"{v:.8f}") for n, v in values.items()})
            )
            self.ends.append(there)
            here = there

    def named(self, names: str) -> list[str]:
        one, two = self.axes
        words = {"first": one, "second": two, "angle": "AN", "length": "LEN", "radius": "R", "end": "CCA"}
        words |= {"step1": f"I{one}", "step2": f"I{two}", "center1": f"CC{one}", "center2": f"CC{two}"}
        return [words[name] for name in names.split()]


NUMBER = st.integers(-40, 40).filter(lambda number: abs(number) > 4)
PIECE = st.tuples(st.booleans(), NUMBER, NUMBER, st.integers(30, 200) | st.integers(-200, -30))


@st.composite
def drawings(draw: st.DrawFn) -> tuple[Drawn, ContourSketch, int]:
    """A contour, a sketch of it with some fields left out, and how many."""
    part = draw(st.sampled_from(("turned", "milled")))
    drawn = Drawn(part, draw(st.lists(PIECE, min_size=1, max_size=5)))
    chosen = [drawn.named(draw(st.sampled_from(DETERMINING[kind]))) for kind, _, _ in drawn.elements]
    gone = 0
    for words in chosen:
        if gone < 2 and draw(st.integers(0, 3)) == 0:
            del words[draw(st.integers(0, len(words) - 1))]
            gone += 1
    elements = (
        SketchElement(kind, {name: values[name] for name in names}, turn if kind == "arc" else None)
        for (kind, turn, values), names in zip(drawn.elements, chosen, strict=True)
    )
    return (
        drawn,
        ContourSketch(
            part, tuple(elements), {drawn.axes[0]: Decimal(0), drawn.axes[1]: 10 * drawn.factor[1] * Decimal(1)}
        ),
        gone,
    )


def is_true(drawn: Drawn, segments: Any) -> bool:
    """Whether lines and arcs end where those of the contour do."""
    return len(segments) == len(drawn.ends) and all(
        dist(each.end, end) < 1e-3 for each, end in zip(segments, drawn.ends, strict=True)
    )


@law(drawings(), few=4, many=50)
def test_what_is_known_is_true_and_what_is_missing_finishes(made: tuple[Drawn, ContourSketch, int]) -> None:
    drawn, sketch, gone = made
    found = sketch.solve()
    assert contoursolve.read_sketch(write_sketch(sketch)) == sketch
    if found.is_finished:
        assert is_true(drawn, [each.segment for each in found.elements])
    elif found.solutions:
        assert any(is_true(drawn, each.segments) for each in found.solutions)
    else:
        assert found.status == "underdetermined"
        assert gone
        assert found.missing
        for each in found.elements:
            if each.state.value == "known":
                assert dist(each.segment.end, drawn.ends[each.number - 1]) < 1e-3
        for entry in found.entries[:3]:
            elements = list(sketch.elements)
            element = elements[entry.number - 1]
            true = drawn.elements[entry.number - 1][2].get(entry.field)
            if true is None:
                continue
            elements[entry.number - 1] = replace(element, words={**element.words, entry.field: true})
            other = replace(sketch, elements=tuple(elements)).solve()
            if found.missing.startswith("one"):
                assert other.is_finished or other.solutions
            else:
                assert other.missing != found.missing


@law(drawings(), st.randoms(use_true_random=False), few=2, many=10)
def test_the_order_of_fields_changes_no_verdict(made: tuple[Drawn, ContourSketch, int], random: Any) -> None:
    _, sketch, _ = made
    turned = [
        replace(each, words=dict(random.sample([*each.words.items()], len(each.words)))) for each in sketch.elements
    ]
    one, other = (contoursolve.editing.sketch_view(each) for each in (sketch, replace(sketch, elements=tuple(turned))))
    assert one == other
