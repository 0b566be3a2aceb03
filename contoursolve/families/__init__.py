"""Families: one block with some words free, a million contours at once.

A block with free words comes in; rows, ranges, regions and sensitivities go out. Begin with `spec`, then
`compiled_sweep`.
"""

from contoursolve.families.checkpoints import MOST_ROWS, Parts, others, parts_of, room_of, seconds_of
from contoursolve.families.compiled_sweep import CompiledSweep
from contoursolve.families.evaluate import THREADS, FailureSummary, Tally, failure_summary, family, pieces, sweep
from contoursolve.families.export import Family, Measure, csv_lines, summary_of, write_parquet
from contoursolve.families.feasible_ranges import End, Feasible, Interval, Reason, Way, feasible
from contoursolve.families.inverse import Found, Hit, find_word
from contoursolve.families.point_tolerances import Effect, Limits, Missing, Tolerances, tolerances
from contoursolve.families.regions import Boundary, Region, region, region_of
from contoursolve.families.sensitivities import Sensitivity, Spread, sensitivity
from contoursolve.families.spec import FamilyError, RefusedError, name_of
from contoursolve.families.targets import Goal
from contoursolve.solving.row_outcome import REASONS, Code

Sweep = CompiledSweep
"""The name that a sweep had before."""

__all__ = [
    "MOST_ROWS",
    "REASONS",
    "THREADS",
    "Boundary",
    "Code",
    "CompiledSweep",
    "Effect",
    "End",
    "FailureSummary",
    "Family",
    "FamilyError",
    "Feasible",
    "Found",
    "Goal",
    "Hit",
    "Interval",
    "Limits",
    "Measure",
    "Missing",
    "Parts",
    "Reason",
    "RefusedError",
    "Region",
    "Sensitivity",
    "Spread",
    "Sweep",
    "Tally",
    "Tolerances",
    "Way",
    "csv_lines",
    "failure_summary",
    "family",
    "feasible",
    "find_word",
    "name_of",
    "others",
    "parts_of",
    "pieces",
    "region",
    "region_of",
    "room_of",
    "seconds_of",
    "sensitivity",
    "summary_of",
    "sweep",
    "tolerances",
    "write_parquet",
]
