from . import families as families, pictures as pictures
from .api import (
    UnreadableProgramError as UnreadableProgramError,
    apply_fixes as apply_fixes,
    check as check,
    check_file as check_file,
    convert as convert,
    expand as expand,
    parse as parse,
    read_program as read_program,
    solve as solve,
    solve_file as solve_file,
    solve_program as solve_program,
    solve_with_tool as solve_with_tool,
    system as system,
)
from .controls import (
    DIALECTS as DIALECTS,
)
from .diagnosis import (
    Answer as Answer,
    Depth as Depth,
    EquationSystem as EquationSystem,
    Policy as Policy,
    Solution as Solution,
    Solutions as Solutions,
)
from .diagnostics import (
    Basis as Basis,
    Diagnosis as Diagnosis,
    Diagnostic as Diagnostic,
    Fix as Fix,
    MissingExtraError as MissingExtraError,
    Severity as Severity,
)
from .families import (
    Family as Family,
    FamilyError as FamilyError,
    Feasible as Feasible,
    Found as Found,
    Region as Region,
    Sensitivity as Sensitivity,
    Tolerances as Tolerances,
    WordTolerance as WordTolerance,
    family as family,
    feasible as feasible,
    find_word as find_word,
    region as region,
    sensitivity as sensitivity,
    tolerance_for as tolerance_for,
    tolerances as tolerances,
)
from .gcode import (
    Block as Block,
    Program as Program,
    Word as Word,
)
from .notebook import (
    explore as explore,
    explore_map as explore_map,
)
from .output import (
    beside_of as beside_of,
    map_page as map_page,
    report_page as report_page,
    rule_page as rule_page,
    to_dxf as to_dxf,
)
from .postprocess import (
    Conversion as Conversion,
    Expansion as Expansion,
    NumberGround as NumberGround,
    Written as Written,
    WrittenBlock as WrittenBlock,
    WrittenContour as WrittenContour,
    WrittenWord as WrittenWord,
)
from .program import (
    Mended as Mended,
    OpenContour as OpenContour,
    OpenProgram as OpenProgram,
    Result as Result,
    SettingError as SettingError,
    UnknownControlError as UnknownControlError,
    changes_of as changes_of,
    find_settings as find_settings,
    find_tool_table as find_tool_table,
    likely_fixes as likely_fixes,
    mend_open as mend_open,
    safe_fixes as safe_fixes,
)
from .reading import (
    Dialect as Dialect,
)
from .sketches import (
    ContourSketch as ContourSketch,
    DxfError as DxfError,
    DxfSketch as DxfSketch,
    SketchCorner as SketchCorner,
    SketchElement as SketchElement,
    UnfinishedError as UnfinishedError,
    draw_sketch as draw_sketch,
    read_dxf as read_dxf,
    read_sketch as read_sketch,
    sketch_view as sketch_view,
    write as write,
    write_for_all as write_for_all,
)
from .solving import (
    ArcSegment as ArcSegment,
    Contour as Contour,
    Drawings as Drawings,
    Drawn as Drawn,
    LineSegment as LineSegment,
    Sketch as Sketch,
    Status as Status,
)
from .tool_radius import (
    ToolError as ToolError,
    ToolReport as ToolReport,
    family_of_tools as family_of_tools,
    find_tools as find_tools,
)

__version__: str
