"""Families: one block with some words free, a million contours at once."""

from contoursolve.families.boundary import End, Feasible, Interval, Way, feasible
from contoursolve.families.distribute import THREADS
from contoursolve.families.ends import Reason
from contoursolve.families.estimate import MOST_ROWS, room_of, seconds_of
from contoursolve.families.evaluate import family, pieces, sweep
from contoursolve.families.export import csv_lines, write_parquet
from contoursolve.families.goals import Goal
from contoursolve.families.inverse import Found, Hit, find_word
from contoursolve.families.measures import Measure
from contoursolve.families.parts import Parts, others, parts_of
from contoursolve.families.prepared import Sweep
from contoursolve.families.ranges import FamilyError, name_of
from contoursolve.families.regions import Boundary, Region, region, region_of, units_of
from contoursolve.families.result import Family, summary_of
from contoursolve.families.slopes import Sensitivity, Spread, sensitivity
from contoursolve.families.telling import Tally, Telling, telling_of
from contoursolve.families.template import RefusedError
from contoursolve.families.tolerance import Effect, Limits, Missing, Tolerances, tolerances
from contoursolve.solving.verdict import REASONS, Code

__all__ = [
    "MOST_ROWS",
    "REASONS",
    "THREADS",
    "Boundary",
    "Code",
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
