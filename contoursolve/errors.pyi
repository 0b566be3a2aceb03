from .comparison import (
    CannotVerifyError as CannotVerifyError,
    NotComparedError as NotComparedError,
)
from .diagnostics import (
    MissingExtraError as MissingExtraError,
    UserError as UserError,
)
from .families import (
    FamilyError as FamilyError,
    NotClosedError as NotClosedError,
    RefusedError as RefusedError,
)
from .gcode import (
    CannotWriteError as CannotWriteError,
    UnreadableProgramError as UnreadableProgramError,
)
from .postprocess import (
    ConversionError as ConversionError,
)
from .program import (
    FactPlaceError as FactPlaceError,
    NamedWordError as NamedWordError,
    SettingError as SettingError,
    SeveralControlsError as SeveralControlsError,
    StartError as StartError,
    UnknownControlError as UnknownControlError,
)
from .sketches import (
    DxfError as DxfError,
    SketchError as SketchError,
    UnfinishedError as UnfinishedError,
)
from .tool_radius import (
    ToolError as ToolError,
)
