"""Chains, circles and lines of the oracles as sketches of the package, and its drawings back as chains."""

from collections.abc import Sequence

from chains import Arc, Chain, Fact

from contoursolve import Sketch
from contoursolve.sketch import Drawn


def sketch_of(chain: Chain, facts: Sequence[Fact]) -> Sketch:
    """A chain's form with facts; of its places only the start is told."""
    start = chain.points[0]
    sketch = Sketch((start.real, start.imag))
    for number, element in enumerate(chain.elements, 1):
        if isinstance(element, Arc):
            sketch.arc(f"E{number}", element.turn)
        else:
            sketch.line(f"E{number}")
    for fact in facts:
        sketch.state(fact.text)
    return sketch


def chain_of(drawn: Drawn, form: Chain) -> Chain:
    """A drawing as a chain of the same form."""
    places = [place for number in form.numbers for place in drawn.points[f"P{number}"]]
    for number in form.arcs:
        places += [*drawn.points[f"E{number}.center"], drawn.radii[f"E{number}.radius"]]
    return form.at(places)
