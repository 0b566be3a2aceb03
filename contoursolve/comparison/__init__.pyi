from .compare import (
    Comparison as Comparison,
    Difference as Difference,
    compare as compare,
)
from .follow import (
    ToolPath as ToolPath,
    follow as follow,
)
from .travel import (
    Motion as Motion,
    Place as Place,
    Step as Step,
    Travel as Travel,
    Unfollowed as Unfollowed,
)
