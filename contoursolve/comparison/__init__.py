"""Whether two programs describe the same path.

Two programs come in, their first difference goes out. Begin with `compare`.
"""

from contoursolve.comparison.compare import Comparison, Difference, compare
from contoursolve.comparison.follow import Path, follow
from contoursolve.comparison.travel import Motion, Place, Step, Travel, Unfollowed

__all__ = [
    "Comparison",
    "Difference",
    "Motion",
    "Path",
    "Place",
    "Step",
    "Travel",
    "Unfollowed",
    "compare",
    "follow",
]
