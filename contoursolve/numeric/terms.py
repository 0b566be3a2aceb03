"""Expressions of a program as trees: constants, variables, functions."""

from collections.abc import Mapping
from decimal import Decimal

from msgspec import Struct


class Constant(Struct, frozen=True, tag=True):
    """A number as it is written."""

    value: float


class Quoted(Struct, frozen=True, tag=True):
    """A text in quotes."""

    value: str


class Variable(Struct, frozen=True, tag=True):
    """A variable by its name in upper case: `#100`, `R1`, `_ANG`, `V.P.X`, `Q30`."""

    name: str


class Indexed(Struct, frozen=True, tag=True):
    """A variable whose number is computed: `#[#1+2]` has the prefix `#`, `R[R2]` has `R`. A field `A[2]` of SINUMERIK
    has the prefix `A` and several indices; its elements are variables such as `A[2]`."""

    prefix: str
    indices: tuple["Term", ...]
    suffix: str = ""


class Apply(Struct, frozen=True, tag=True):
    """A function or an operation of other expressions; angles are in degrees."""

    function: str
    """One of the names in `evaluate.FUNCTIONS`: `add`, `sine`, `equal`, ..."""
    arguments: tuple["Term", ...]


Term = Constant | Quoted | Variable | Indexed | Apply


class Affine(Struct, frozen=True):
    """A value that follows variables: so much of each, by its name, and what is added."""

    factors: Mapping[str, Decimal]
    constant: Decimal
