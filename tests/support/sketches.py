"""Chains as sketches of the package, and its drawings back as chains."""

from collections.abc import Sequence
from random import Random

from chains import Arc, Chain, Fact, distance_between, form_residuals, measure, random_chain, random_facts

from contoursolve import Sketch
from contoursolve.solving import Drawing


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


def chain_of(drawn: Drawing, form: Chain) -> Chain:
    """A drawing as a chain of the same form."""
    places = [place for number in form.numbers for place in drawn.points[f"P{number}"]]
    for number in form.arcs:
        places += [*drawn.points[f"E{number}.center"], drawn.radii[f"E{number}.radius"]]
    return form.at(places)


def chain_case(seed: int) -> tuple[Chain, list[Fact]]:
    """A chain of 1 to 8 elements, with up to all of its facts swapped if it is short, else up to three."""
    random = Random(seed)
    chain = random_chain(random, 1 + seed % 8)
    swaps = random.randint(1, chain.freedom if len(chain.elements) <= 2 else 3)
    return chain, random_facts(chain, random, swaps)


def is_drawing(chain: Chain, facts: Sequence[Fact]) -> bool:
    """Whether a chain satisfies all its facts, and its arcs meet its points, by a measure of its own."""
    misses = [*form_residuals(chain), *(measure(chain, fact) for fact in facts)]
    return chain.is_proper and all(abs(each) <= 1e-6 for each in misses)


def is_among(chain: Chain, drawn: Sequence[Chain]) -> bool:
    """Whether a chain is one of those that were drawn."""
    return any(distance_between(chain, each) <= 1e-6 * chain.extent for each in drawn)
