from . import editing as editing, errors as errors, pictures as pictures, tables as tables
from .api import (
    check as check,
    convert as convert,
    expand as expand,
    fix as fix,
    parse as parse,
    solve as solve,
    system as system,
)
from .comparing import (
    diff as diff,
    verify as verify,
)
from .comparison import (
    Comparison as Comparison,
    Receipt as Receipt,
)
from .controls import (
    CONTROLS as CONTROLS,
)
from .diagnosis import (
    Answer as Answer,
    EquationSystem as EquationSystem,
    Solution as Solution,
    Solutions as Solutions,
)
from .diagnostics import (
    Basis as Basis,
    Diagnosis as Diagnosis,
    Diagnostic as Diagnostic,
    Fix as Fix,
    Severity as Severity,
)
from .families import (
    Family as Family,
    FeasibleRange as FeasibleRange,
    FeasibleRegion as FeasibleRegion,
    FoundValues as FoundValues,
    Sensitivity as Sensitivity,
    ToleranceRange as ToleranceRange,
    Tolerances as Tolerances,
    find as find,
    sensitivity as sensitivity,
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
)
from .outcomes import (
    draw as draw,
    explain as explain,
    export as export,
    report as report,
)
from .pictures import (
    Picture as Picture,
)
from .postprocess import (
    Conversion as Conversion,
    Expansion as Expansion,
    WrittenContours as WrittenContours,
)
from .program import (
    FixedProgram as FixedProgram,
    OpenProgram as OpenProgram,
    Result as Result,
)
from .questions import (
    family as family,
    ranges as ranges,
    tolerances as tolerances,
)
from .reading import (
    Control as Control,
)
from .sketches import (
    ContourSketch as ContourSketch,
    SketchCorner as SketchCorner,
    SketchElement as SketchElement,
    read_dxf as read_dxf,
    read_sketch as read_sketch,
    write as write,
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
    ToolReport as ToolReport,
)

__version__: str
