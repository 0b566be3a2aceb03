"""Families: one block with some words free, a million contours at once."""

from contoursolve.families.checkpoints import MOST_ROWS, Parts, others, parts_of, room_of, seconds_of
from contoursolve.families.compiled_sweep import CompiledSweep
from contoursolve.families.evaluate import THREADS, Tally, Telling, family, pieces, sweep, telling_of
from contoursolve.families.export import Family, Measure, csv_lines, summary_of, units_of, write_parquet
from contoursolve.families.feasible_ranges import End, Feasible, Interval, Way, feasible
from contoursolve.families.inverse import Found, Hit, find_word
from contoursolve.families.limit_reasons import Reason
from contoursolve.families.point_tolerances import Effect, Limits, Missing, Tolerances, tolerances
from contoursolve.families.regions import Boundary, Region, region, region_of
from contoursolve.families.sensitivities import Sensitivity, Spread, sensitivity
from contoursolve.families.spec import FamilyError, RefusedError, name_of
from contoursolve.families.targets import Goal
from contoursolve.solving.verdict import REASONS, Code

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
    "Telling",
    "Tolerances",
    "Way",
    "csv_lines",
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
    "telling_of",
    "tolerances",
    "units_of",
    "write_parquet",
]
