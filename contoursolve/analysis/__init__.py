"""What a system of facts determines, before any number is put in.

A system comes in, its determinacy goes out: what is free, what is tied. Begin with `determinacy`.
"""

from contoursolve.analysis.determinacy import Determinacy, analyse, basis_of, circuits_of, derive, groups_of, spare_of
from contoursolve.analysis.partition import Group, Parts, decompose, match, order

__all__ = [
    "Determinacy",
    "Group",
    "Parts",
    "analyse",
    "basis_of",
    "circuits_of",
    "decompose",
    "derive",
    "groups_of",
    "match",
    "order",
    "spare_of",
]
