"""The equations of one step of a plan, as polynomials where they are, for exact numbers and balls."""

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

from msgspec import Struct

from contoursolve.geometry import Fact, System
from contoursolve.numeric import (
    PRIME,
    Functions,
    Number,
    Replay,
    Tape,
    ball,
    draw,
    draw_direction,
    expressions,
    modular_rank,
)
from contoursolve.solving.inputs import headed_of, input_values
from contoursolve.solving.partition import Group


class Coefficient:
    """A number and what it is modulo `PRIME` at other values of the inputs: zero there is zero for all values."""

    __slots__ = ("value", "witness")

    def __init__(self, value: Number, witness: int) -> None:
        self.value = value
        self.witness = witness

    def __add__(self, other: "Coefficient") -> "Coefficient":
        return Coefficient(self.value + other.value, (self.witness + other.witness) % PRIME)

    def __sub__(self, other: "Coefficient") -> "Coefficient":
        return Coefficient(self.value - other.value, (self.witness - other.witness) % PRIME)

    def __mul__(self, other: "Coefficient") -> "Coefficient":
        return Coefficient(self.value * other.value, self.witness * other.witness % PRIME)

    def __truediv__(self, other: "Coefficient") -> "Coefficient":
        return Coefficient(self.value / other.value, self.witness * pow(other.witness, -1, PRIME) % PRIME)

    def __pow__(self, exponent: int) -> "Coefficient":
        return Coefficient(self.value**exponent, pow(self.witness, exponent, PRIME))

    def __neg__(self) -> "Coefficient":
        return Coefficient(-self.value, -self.witness % PRIME)

    def __rtruediv__(self, one: int) -> "Coefficient":
        return Coefficient(one / self.value, one * pow(self.witness, -1, PRIME) % PRIME)

    @property
    def is_zero(self) -> bool:
        """Whether the coefficient is zero: for all values, or exactly at these."""
        return self.witness == 0 or (ball.is_exact(self.value) and self.value == 0)


def rational(value: float) -> Coefficient:
    """A number that is the same for all values."""
    return Coefficient(ball.exact(value), modular_rank.rational(value))


def _apart(function: Callable[[Number], Number], name: str) -> Callable[[Coefficient], Coefficient]:
    """A function of a coefficient, whose witness has nothing to do with any other."""
    return lambda each: Coefficient(function(each.value), draw(f"{name} {each.witness}"))


def _rotation(part: int) -> Callable[[Coefficient], Coefficient]:
    function = (ball.cosine, ball.sine)[part]
    return lambda each: Coefficient(function(each.value), draw_direction(str(each.witness))[part])


COEFFICIENTS = Functions(_apart(ball.root, "root"), _rotation(0), _rotation(1))


Monomial = tuple[int, ...]
"""Indices of the unknowns that are multiplied, in order; empty for the constant."""


class Polynomial(Struct, frozen=True):
    """Coefficients by monomial, without those that are zero."""

    terms: Mapping[Monomial, Coefficient]

    @property
    def degree(self) -> int:
        """The largest number of unknowns that are multiplied; -1 for the zero polynomial."""
        return max(map(len, self.terms), default=-1)

    @property
    def unknowns(self) -> frozenset[int]:
        """The unknowns that occur."""
        return frozenset(index for monomial in self.terms for index in monomial)

    @property
    def constant(self) -> Coefficient | None:
        """The constant term."""
        return self.terms.get(())

    def __add__(self, other: "Polynomial") -> "Polynomial":
        terms = dict(self.terms)
        for monomial, each in other.terms.items():
            terms[monomial] = terms[monomial] + each if monomial in terms else each
        return polynomial(terms)

    def scaled(self, factor: Coefficient) -> "Polynomial":
        """Every coefficient times a factor."""
        return polynomial({monomial: each * factor for monomial, each in self.terms.items()})

    def __mul__(self, other: "Polynomial") -> "Polynomial":
        terms: dict[Monomial, Coefficient] = {}
        for first, a in self.terms.items():
            for second, b in other.terms.items():
                monomial = tuple(sorted(first + second))
                terms[monomial] = terms[monomial] + a * b if monomial in terms else a * b
        return polynomial(terms)

    def substitute(self, unknown: int, replacement: "Polynomial") -> "Polynomial":
        """The polynomial with one unknown replaced."""
        if unknown not in self.unknowns:
            return self
        result = polynomial({})
        for monomial, each in self.terms.items():
            count = monomial.count(unknown)
            term = polynomial({tuple(index for index in monomial if index != unknown): each})
            for _ in range(count):
                term = term * replacement
            result = result + term
        return result


def polynomial(terms: Mapping[Monomial, Coefficient]) -> Polynomial:
    """A polynomial without its zero terms."""
    return Polynomial({monomial: each for monomial, each in terms.items() if not each.is_zero})


def known(value: Any) -> Polynomial:
    """A number that was found for an unknown, as a polynomial; it is like no other number."""
    return polynomial({(): Coefficient(value, draw(str(value)))})


class Kernel(Struct, frozen=True, eq=False):
    """Equations and unknowns of one step.

    `equations` gives the equations and then their derivatives, row by row, at the values of
    `arguments`, which are the unknowns and then other inputs. `function` is the same in CasADi.
    """

    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]
    sides: tuple[str, ...]
    arguments: tuple[str, ...]
    equations: Replay
    function: Any
    is_affine: bool
    """Whether the derivatives are free of the unknowns."""


class Polynomials(Struct, frozen=True, eq=False):
    """The equations of a group as polynomials of degree 2 in its unknowns: `coefficients` gives what stands before
    `terms` (equation, monomial) at the values of `parameters`."""

    parameters: tuple[str, ...]
    terms: tuple[tuple[int, Monomial], ...]
    coefficients: Replay


class Local:
    """A group of facts of a system; equal to that of another system whose equations for it are the same ones."""

    def __init__(self, system: System, group: Group) -> None:
        self.system, self.group = system, group
        radii = frozenset(name for name in group.unknowns if name in system.figure.radii)
        self._key = group, headed_of(system, group.facts), system.figure.start, radii
        self._hash = hash(self._key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Local) and self._key == other._key

    def __hash__(self) -> int:
        return self._hash


@lru_cache(maxsize=8192)
def local_of(system: System, group: Group) -> Local:
    """The group by itself, the same object each time."""
    return Local(system, group)


@lru_cache(maxsize=8192)
def polynomials_of(local: Local) -> Polynomials | None:
    """The polynomials of a group of facts of a system; None if an equation is none, or of higher degree."""
    symbols = {name: expressions.symbol(name) for name in local.group.unknowns}
    tape = Tape()
    parts = expressions.quadratic_parts(
        [fact.equation(input_values(local.system.headed, tape, symbols)) for fact in local.group.facts],
        list(symbols.values()),
    )
    if parts is None:
        return None
    for number, expression in enumerate(parts.values()):
        tape.output(str(number), expression)
    return Polynomials(tape.inputs, tuple(parts), Replay(tape.function(), COEFFICIENTS, rational))


@lru_cache(maxsize=8192)
def make_kernel(local: Local) -> Kernel:
    """The kernel of a group of facts of a system."""
    system, group = local.system, local.group
    sides = tuple(dict.fromkeys(side for fact in group.facts for side in fact.sides()))
    at = Tape()
    unknowns = [at.input(name) for name in group.unknowns]
    outputs = [fact.equation(input_values(system.headed, at, {})) for fact in group.facts]
    vector, is_affine = expressions.with_slopes(outputs, unknowns)
    at.output("equations and slopes", vector)
    function = at.function()
    return Kernel(
        facts=group.facts,
        unknowns=group.unknowns,
        sides=sides,
        arguments=at.inputs,
        equations=Replay(function, ball.FUNCTIONS, ball.exact),
        function=function,
        is_affine=is_affine,
    )
