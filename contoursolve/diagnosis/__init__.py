"""Why a contour is refused, and what to write instead."""

from contoursolve.diagnosis.affine import AffineFacts, Circuit, affine_facts
from contoursolve.diagnosis.diagnose import diagnose
from contoursolve.diagnosis.edits import Edit, EditKind
from contoursolve.diagnosis.repairs import Repair, Repairs, find_repairs

__all__ = [
    "AffineFacts",
    "Circuit",
    "Edit",
    "EditKind",
    "Repair",
    "Repairs",
    "affine_facts",
    "diagnose",
    "find_repairs",
]
