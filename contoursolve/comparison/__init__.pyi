from .claims import (
    CannotVerifyError as CannotVerifyError,
    ClaimCheck as ClaimCheck,
    ContourReceipt as ContourReceipt,
    Document as Document,
    Receipt as Receipt,
    ReceiptVerdict as ReceiptVerdict,
    read_document as read_document,
)
from .compare import (
    Comparison as Comparison,
    NotComparedError as NotComparedError,
    changes_beside as changes_beside,
    compare as compare,
)
from .detours import (
    Difference as Difference,
)
from .follow import (
    FINISHING as FINISHING,
    ROUGHING as ROUGHING,
    ToolPath as ToolPath,
    along as along,
    follow as follow,
    in_cycle as in_cycle,
)
from .travel import (
    Motion as Motion,
    Place as Place,
    Step as Step,
    Travel as Travel,
    Unfollowed as Unfollowed,
)
from .verify import (
    verify as verify,
)
from .words import (
    KEPT as KEPT,
    Change as Change,
    Quote as Quote,
)
