"""Why a contour is refused, and what to write instead."""

from contoursolve.diagnosis.affine import AffineFacts, Circuit, Freedom, affine_facts
from contoursolve.diagnosis.edits import Edit, EditKind
from contoursolve.diagnosis.repairs import Repair, Repairs, find_repairs

__all__ = ["AffineFacts", "Circuit", "Edit", "EditKind", "Freedom", "Repair", "Repairs", "affine_facts", "find_repairs"]
