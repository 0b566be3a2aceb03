"""Why a contour is refused, and what to write instead."""

from contoursolve.diagnosis.attempt import Repair, Repairs
from contoursolve.diagnosis.diagnose import diagnose, mend_points
from contoursolve.diagnosis.edits import Edit, EditKind, apply_edits
from contoursolve.diagnosis.repairs import find_repairs
from contoursolve.diagnosis.table import Row, tabulate
from contoursolve.solving.affine import AffineFacts, Circuit, affine_facts

__all__ = [
    "AffineFacts",
    "Circuit",
    "Edit",
    "EditKind",
    "Repair",
    "Repairs",
    "Row",
    "affine_facts",
    "apply_edits",
    "diagnose",
    "find_repairs",
    "mend_points",
    "tabulate",
]
