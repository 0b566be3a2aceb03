from .compose import (
    compose as compose,
    describe as describe,
    remarks_of as remarks_of,
)
from .drawing import (
    Drawable as Drawable,
    draw as draw,
    draw_answer as draw_answer,
    draw_comparison as draw_comparison,
    draw_drawings as draw_drawings,
    draw_family_fan as draw_family_fan,
    draw_family_map as draw_family_map,
    draw_matrix as draw_matrix,
    draw_range as draw_range,
    draw_region as draw_region,
    draw_result as draw_result,
    draw_sketched as draw_sketched,
    draw_sweep as draw_sweep,
)
from .fields import words_of as words_of
from .known_points import (
    Known as Known,
    in_part as in_part,
)
from .layout import (
    path_data as path_data,
)
from .maps import (
    MapPlane as MapPlane,
    plane_of as plane_of,
)
from .overview import (
    plain_trail as plain_trail,
)
from .page import (
    About as About,
    TextRun as TextRun,
)
from .plots import plot_record as plot_record
from .scene import (
    Closeup as Closeup,
    Leader as Leader,
    Mark as Mark,
    MarkKind as MarkKind,
    Part as Part,
    ToolDrawing as ToolDrawing,
    Trail as Trail,
    Viewport as Viewport,
    Weight as Weight,
    number as number,
)
from .subject import (
    corner_segment as corner_segment,
    find_known as find_known,
    list_trails as list_trails,
    named_words as named_words,
)
from .svg import (
    Picture as Picture,
)
from .sweeps import (
    sweep_title as sweep_title,
)
from .theme import (
    CHAINS as CHAINS,
    DARK_COLORS as DARK_COLORS,
    LEVELS as LEVELS,
    LIGHT_COLORS as LIGHT_COLORS,
    TOOLS as TOOLS,
    Role as Role,
    Theme as Theme,
)
from .value_axes import MAP_BOX as MAP_BOX
