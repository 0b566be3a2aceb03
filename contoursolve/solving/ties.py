"""Facts that say the same: the left null space of their Jacobian, at the values of a block or for all values."""

from collections.abc import Mapping
from functools import lru_cache
from math import cos, sin, tau

from msgspec import Struct

from contoursolve.geometry import Fact, Profile, System, assemble
from contoursolve.numeric import COSINE, FLOATS, PRIME, SINE, draw
from contoursolve.solving.affine import (
    NO_CIRCUITS,
    AffineFacts,
    Circuit,
    Circuits,
    affine_facts,
    linearise,
    rows_at,
)
from contoursolve.solving.ambiguity import headings_of, nearest_of_determined, restrict
from contoursolve.solving.compare import is_conflict
from contoursolve.solving.construction import is_closed
from contoursolve.solving.determinacy import analyse, circuits_of
from contoursolve.solving.inputs import input_values
from contoursolve.tolerance import REGULAR


class Ties(Struct, frozen=True):
    """The smallest sets of facts of a profile that say the same at its values, as `rows` of a matrix.

    Where not all are affine (`is_affine`), the rows are those at the solution with which most facts agree; without any
    solution there are none, and the circuits are those for all values.
    """

    profile: Profile
    rows: AffineFacts | None
    circuits: Circuits
    is_affine: bool = True

    def is_conflict(self, circuit: Circuit) -> bool:
        """Whether facts that are affine and say the same disagree, see `compare.is_conflict`."""
        return self.rows is not None and is_conflict(circuit, self.profile, self.rows)

    def off_by(self, circuit: Circuit) -> float:
        """By how much facts that are affine and say the same disagree at most, mm."""
        return max(circuit.off)

    def givens(self, circuit: Circuit) -> tuple[str, ...]:
        """The givens of the facts of a circuit, see `givens_of_facts`."""
        return givens_of_facts(circuit.facts, assemble(self.profile))


def find_ties(profile: Profile, *, is_told: bool) -> Ties:
    """The ties of the facts of a profile, whose start is known.

    Where they are not affine, they are looked for at the values that the solution of what is determined has; it is
    searched for only where `is_told` that facts say something again, which takes the same search.
    """
    rows = affine_facts(profile, (*profile.facts, *profile.ignored))
    if rows is not None:
        return Ties(profile, rows, rows.circuits())
    system = assemble(profile)
    generic = circuits_of(system)
    if not generic:
        return Ties(profile, None, NO_CIRCUITS)
    found = None
    if is_told or (analyse(system).is_determined and is_closed(system)):
        tied = {
            name for last, others in generic.items() for fact in (*others, last) for name in system.unknowns_of(fact)
        }
        found = nearest_of_determined(profile) or nearest_of_determined(restrict(profile, tied))
    if found is None:
        # What words of one form say twice is told without values; of facts of all kinds, it would tell of too many.
        told = {} if profile.is_extended else generic
        unknown = (Circuit((*others, last), (0.0,) * (len(others) + 1)) for last, others in told.items())
        return Ties(profile, None, Circuits(tuple(unknown), is_complete=False))
    part, item = found
    own = assemble(part)
    rows = linearise(part, part.facts, item.scalars)
    circuits = rows.circuits()
    kept = [each for each in circuits.found if _is_for_certain(each, part, rows)]
    # Where facts that bend only touch, what ties them whatever the values are does so here.
    known, off = {each.facts[-1] for each in kept}, abs(rows.off_at(item.scalars))
    for last, others in circuits_of(own).items():
        if last not in known:
            kept.append(Circuit((*others, last), (*(0.0 for _ in others), float(off[rows.places[last]]))))
    return Ties(part, rows, Circuits(tuple(kept), circuits.is_complete and part is profile), is_affine=False)


def _is_for_certain(circuit: Circuit, profile: Profile, rows: AffineFacts) -> bool:
    """Whether facts that say the same to first order do so at all: where each has the same derivatives elsewhere, or
    they say the same whatever the values are."""
    elsewhere = linearise(profile, circuit.facts, {name: draw(name) / PRIME for name in rows.unknowns})
    here = rows.matrix_of([rows.places[fact] for fact in circuit.facts])
    if bool((abs(elsewhere.matrix_of(range(len(circuit.facts))) - here) <= REGULAR).all()):
        return True
    return analyse(assemble(profile).keep(circuit.facts)).rank < len(circuit.facts)


def circuits_for_all_values(system: System) -> Circuits:
    """The smallest sets of facts of a system that say the same whatever the values are; of facts that are affine."""
    return rows_at(system, system.facts, input_values(system.headed, _Somewhere(), {}, FLOATS)).circuits()


class _Somewhere:
    """Numbers that have nothing to do with each other, and directions."""

    def input(self, name: str) -> float:
        """The value of an input, mm, or the part of a direction."""
        for ending, part in ((COSINE, cos), (SINE, sin)):
            if name.endswith(ending):
                return part(tau * draw(name.removesuffix(ending)) / PRIME)
        return draw(name) / PRIME


def tied_with(system: System, fact: Fact) -> tuple[str, ...]:
    """The givens of a smallest set of facts from which, for all values, a fact of the system follows, with its own, in
    the order of the facts.

    A fact beside the basis can replace exactly those facts of the basis that it is tied with. A fact of the basis
    is tied with the first fact beside it that can replace it.
    """
    return _ties(system).get(fact, ())


@lru_cache(maxsize=256)
def _ties(system: System) -> Mapping[Fact, tuple[str, ...]]:
    """The answers of `tied_with` for every fact that is tied with others."""
    found: dict[Fact, tuple[str, ...]] = {}
    for fact, others in circuits_of(system).items():
        found[fact] = givens_of_facts((*others, fact), system)
        for each in others:
            found.setdefault(each, found[fact])
    return found


def givens_of_facts(facts: tuple[Fact, ...], system: System) -> tuple[str, ...]:
    """The givens of some facts. Of one without unknowns, which is about the givens alone, the angles among them
    tell."""
    return tuple(dict.fromkeys(name for fact in facts for name in (*headings_of(fact, system), fact.given) if name))
