"""Families: one block with some words free, a million contours at once."""

from contoursolve.families.export import MissingExtraError, parquet_writer, to_arrow
from contoursolve.families.family import STRETCH, Family, family, summary_of, sweep
from contoursolve.families.ranges import FamilyError, stretches
from contoursolve.families.sweep import Sweep
from contoursolve.families.verdict import REASONS, Code

__all__ = [
    "REASONS",
    "STRETCH",
    "Code",
    "Family",
    "FamilyError",
    "MissingExtraError",
    "Sweep",
    "family",
    "parquet_writer",
    "stretches",
    "summary_of",
    "sweep",
    "to_arrow",
]
