from .compose import (
    compose as compose,
    describe as describe,
)
from .drawing import (
    Drawable as Drawable,
    draw as draw,
    draw_answer as draw_answer,
    draw_drawings as draw_drawings,
    draw_family_fan as draw_family_fan,
    draw_family_map as draw_family_map,
    draw_range as draw_range,
    draw_region as draw_region,
    draw_result as draw_result,
    draw_sweep as draw_sweep,
)
from .known_points import (
    Known as Known,
)
from .layout import (
    lay_out as lay_out,
    path_data as path_data,
)
from .maps import (
    lay_out_map as lay_out_map,
    lay_out_region as lay_out_region,
)
from .overview import (
    compose_fan as compose_fan,
    compose_overview as compose_overview,
    describe_overview as describe_overview,
    plain_trail as plain_trail,
)
from .page import (
    About as About,
)
from .scene import (
    Viewport as Viewport,
)
from .sheet import stack_sheets as stack_sheets
from .sketches import (
    compose_drawings as compose_drawings,
    compose_drawn as compose_drawn,
)
from .subject import (
    corner_segment as corner_segment,
    find_known as find_known,
    list_trails as list_trails,
    named_words as named_words,
)
from .svg import (
    Picture as Picture,
    finish as finish,
)
from .sweeps import (
    count_statuses as count_statuses,
    solve_shown as solve_shown,
    sweep_title as sweep_title,
)
from .theme import (
    CHAINS as CHAINS,
    DARK_COLORS as DARK_COLORS,
    LIGHT_COLORS as LIGHT_COLORS,
    Role as Role,
    Theme as Theme,
)
from .value_axes import (
    lay_out_range as lay_out_range,
)
from .vectors import (
    SAME as SAME,
    along as along,
    direction as direction,
    distance as distance,
    middle as middle,
    minus as minus,
)
