"""What is known of a sketch: states, what is missing, guesses, contradictions; each through the public door."""

from decimal import Decimal
from pathlib import Path

import pytest
from msgspec.structs import replace

import contoursolve

EXAMPLES = Path(__file__).parents[1] / "sketches"

ENDS = {
    "turned_shaft": ("line 3", (-49.4142, 39.4142)),
    "turned_ball": ("arc 1", (-36.0, 12.0)),
    "turned_taper_by_length": ("line 2", (-25 - (22.5**2 - 8**2) ** 0.5, 23.0)),
    "turned_recess_inch": ("line 5", (-63.5, 25.4)),
    "milled_plate": ("line 4", (0.0, 30 + 40 / 3**0.5)),
    "milled_distances": ("line 4", (11.0041, 60.0)),
    "milled_slot": ("arc 2", (40.0, 6.0)),
    "milled_chord": ("arc 2", (44.9071, 13.3333)),
    "fk_cam": ("arc 2", (28.2528, 60.8475)),
    "fk_two_circles": ("arc 3", (98.0, -5.0)),
    "guessed_length": ("line 2", ((40**2 - 25**2) ** 0.5 + 20, 25.0)),
    "guessed_meeting": ("line 1", (-35 + (20**2 - 10**2) ** 0.5, 15.0)),
}


def sketch(name: str) -> contoursolve.ContourSketch:
    return contoursolve.read_sketch((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"))


def changed(whole: contoursolve.ContourSketch, number: int, **fields: object) -> contoursolve.ContourSketch:
    """A sketch with other fields of an element; None takes one away."""
    element = whole.elements[number - 1]
    own = {name: fields.pop(name) for name in tuple(fields) if name in element.__struct_fields__}
    words = {name: value for name, value in {**element.words, **fields}.items() if value is not None}
    elements = list(whole.elements)
    elements[number - 1] = replace(element, words={n: Decimal(str(v)) for n, v in words.items()}, **own)
    return replace(whole, elements=tuple(elements))


def states(found) -> dict[str, str]:
    return {each.name: each.state.value for each in found.elements}


@pytest.mark.parametrize("name", sorted(ENDS))
def test_what_a_drawing_gives_is_solved(name):
    found = contoursolve.solve_sketch(sketch(name))
    element, end = ENDS[name]
    assert found.is_finished
    assert found.missing == ""
    at = next(each.segment.end for each in found.elements if each.name == element)
    assert at == pytest.approx(end, abs=1e-4)
    is_guessed = len(found.solutions) > 1
    assert ("guessed" in states(found).values()) is is_guessed
    assert {*states(found).values()} <= {"known", "guessed"}
