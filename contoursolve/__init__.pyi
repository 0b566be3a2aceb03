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
    CONTROLS as CONTROLS,
)
from .diagnosis import (
    Addition as Addition,
    Answer as Answer,
    Depth as Depth,
    EquationSystem as EquationSystem,
    LegalBlock as LegalBlock,
    Policy as Policy,
    Solutions as Solutions,
    called_in_program as called_in_program,
    legal_blocks as legal_blocks,
    list_solutions as list_solutions,
    status_text as status_text,
    ways_to_complete as ways_to_complete,
    words_to_add as words_to_add,
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
    FeasibleRange as FeasibleRange,
    FeasibleRegion as FeasibleRegion,
    FoundValues as FoundValues,
    Sensitivity as Sensitivity,
    ToleranceRange as ToleranceRange,
    Tolerances as Tolerances,
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
    Exercise as Exercise,
    exercise as exercise,
    explore as explore,
    explore_map as explore_map,
    standing_alone as standing_alone,
)
from .output import (
    StatedWord as StatedWord,
    beside_of as beside_of,
    construction_lines as construction_lines,
    end_text as end_text,
    equations_of as equations_of,
    form_text as form_text,
    map_page as map_page,
    path_of as path_of,
    path_table as path_table,
    report_page as report_page,
    rule_page as rule_page,
    start_text as start_text,
    stated_words as stated_words,
    systems_to_json as systems_to_json,
    to_dxf as to_dxf,
    to_smt as to_smt,
    tool_text as tool_text,
)
from .postprocess import (
    Conversion as Conversion,
    Expansion as Expansion,
    NumberGround as NumberGround,
    WrittenBlock as WrittenBlock,
    WrittenContour as WrittenContour,
    WrittenContours as WrittenContours,
    WrittenWord as WrittenWord,
)
from .program import (
    FixedProgram as FixedProgram,
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
    Control as Control,
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
    solve_sketch as solve_sketch,
    write as write,
    write_for_all as write_for_all,
    write_sketch as write_sketch,
)
from .solving import (
    ArcSegment as ArcSegment,
    Contour as Contour,
    Drawing as Drawing,
    Drawings as Drawings,
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
from .try_edits import (
    Completion as Completion,
    completions as completions,
    what_if as what_if,
)

__version__: str
