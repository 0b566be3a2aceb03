from .clearance import (
    crossings as crossings,
    nearest as nearest,
    split as split,
)
from .faults import (
    ToolFault as ToolFault,
    ToolFaultKind as ToolFaultKind,
)
from .findings import (
    ToolReport as ToolReport,
    ToolRun as ToolRun,
    look_at_tool as look_at_tool,
)
from .largest import (
    ToolOptions as ToolOptions,
    ToolTrials as ToolTrials,
    find_tools as find_tools,
    largest_tools as largest_tools,
    least_of as least_of,
)
from .moves import (
    lines_of as lines_of,
    moves_of as moves_of,
    path_of_tool as path_of_tool,
    title_of as title_of,
)
from .offset import (
    NOTICED as NOTICED,
    OffsetElement as OffsetElement,
    OffsetPath as OffsetPath,
    UncutRest as UncutRest,
    uncompensated as uncompensated,
)
from .runs import (
    CuttingRun as CuttingRun,
    ToolRequest as ToolRequest,
    is_compensated as is_compensated,
)
from .stated import (
    FROM_PROGRAM as FROM_PROGRAM,
    result_beside_tool as result_beside_tool,
    wanted_tool as wanted_tool,
)
from .tool import (
    OutsideCorner as OutsideCorner,
    OutsideName as OutsideName,
    SideName as SideName,
    Tool as Tool,
    ToolError as ToolError,
    ToolSide as ToolSide,
    make_tool as make_tool,
    radius_in as radius_in,
    read_tool as read_tool,
    tool_in as tool_in,
    tool_of as tool_of,
)
from .tool_sweep import (
    ToolSweep as ToolSweep,
    family_of_tools as family_of_tools,
    sweep_tools as sweep_tools,
)
from .written_out import (
    written_out as written_out,
)
