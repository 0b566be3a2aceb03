from .drawn_system import (
    sketch_system as sketch_system,
)
from .dxf_chain import (
    DxfChain as DxfChain,
    DxfError as DxfError,
)
from .dxf_in import (
    DxfSketch as DxfSketch,
    read_dxf as read_dxf,
)
from .finishing import (
    SketchEntry as SketchEntry,
)
from .in_file import (
    read_sketch_file as read_sketch_file,
    sketch_result as sketch_result,
)
from .known_part import (
    PartState as PartState,
    SketchAnswer as SketchAnswer,
    SketchFinding as SketchFinding,
    SketchFix as SketchFix,
    SketchPart as SketchPart,
    SketchSolution as SketchSolution,
    solve_sketch as solve_sketch,
)
from .sketch import (
    ASKED as ASKED,
    ContourSketch as ContourSketch,
    SketchCorner as SketchCorner,
    SketchElement as SketchElement,
    SketchError as SketchError,
)
from .sketch_file import (
    plain_sketch as plain_sketch,
    read_sketch as read_sketch,
    sketch_of as sketch_of,
    sketch_schema as sketch_schema,
    write_sketch as write_sketch,
)
from .view import (
    draw_sketch as draw_sketch,
    sketch_view as sketch_view,
    state_text as state_text,
)
from .words_out import (
    UnfinishedError as UnfinishedError,
    write as write,
)
