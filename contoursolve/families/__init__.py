"""Families: one block with some words free, a million contours at once."""

from contoursolve.families.evaluate import family, pieces, sweep
from contoursolve.families.export import MissingExtraError, csv_lines, need, write_parquet
from contoursolve.families.parts import WHOLE, Parts, others, parts_of
from contoursolve.families.prepared import Sweep
from contoursolve.families.ranges import FamilyError, name_of
from contoursolve.families.result import Family, summary_of
from contoursolve.families.slopes import Sensitivity, Spread, sensitivity
from contoursolve.families.verdict import REASONS, Code

__all__ = [
    "REASONS",
    "WHOLE",
    "Code",
    "Family",
    "FamilyError",
    "MissingExtraError",
    "Parts",
    "Sensitivity",
    "Spread",
    "Sweep",
    "csv_lines",
    "family",
    "name_of",
    "need",
    "others",
    "parts_of",
    "pieces",
    "sensitivity",
    "summary_of",
    "sweep",
    "write_parquet",
]
