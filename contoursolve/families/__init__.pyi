from .block_template import (
    BlockOptions as BlockOptions,
    Branches as Branches,
    BranchesName as BranchesName,
    RefusedError as RefusedError,
    Template as Template,
    called as called,
    errors_of as errors_of,
    first_error as first_error,
    spec_of as spec_of,
)
from .case_classes import (
    ORIGIN as ORIGIN,
    verdict_of as verdict_of,
)
from .checkpoints import (
    MOST_ROWS as MOST_ROWS,
    Checkpoints as Checkpoints,
    others as others,
    parts_of as parts_of,
    room_of as room_of,
    seconds_of as seconds_of,
)
from .compiled_sweep import (
    CompiledSweep as CompiledSweep,
)
from .errors import FamilyError as FamilyError, NotClosedError as NotClosedError
from .evaluate import (
    CUT as CUT,
    THREADS as THREADS,
    FailureSummary as FailureSummary,
    Tally as Tally,
    compile_sweep as compile_sweep,
    failure_summary as failure_summary,
    family as family,
    pieces as pieces,
    solve_sweep as solve_sweep,
    sweep as sweep,
)
from .export import (
    Family as Family,
    Measure as Measure,
    csv_lines as csv_lines,
    origin_of as origin_of,
    summary_of as summary_of,
    write_parquet as write_parquet,
)
from .feasible_ranges import (
    End as End,
    FeasibleRange as FeasibleRange,
    Interval as Interval,
    Reason as Reason,
    Way as Way,
    feasible as feasible,
    limits_of as limits_of,
    range_end as range_end,
)
from .free_words import (
    limits_beside as limits_beside,
)
from .goals import (
    Goal as Goal,
)
from .inverse import (
    FoundValues as FoundValues,
    Hit as Hit,
    find as find,
)
from .point_tolerances import (
    Contribution as Contribution,
    Limits as Limits,
    Missing as Missing,
    Tolerances as Tolerances,
    tolerances as tolerances,
)
from .regions import (
    FeasibleRegion as FeasibleRegion,
    region as region,
)
from .sampled_lines import (
    Boundary as Boundary,
    Outcomes as Outcomes,
    boundaries_of as boundaries_of,
    crossings_of as crossings_of,
    is_contour as is_contour,
    level_line as level_line,
    outcomes_of as outcomes_of,
)
from .sensitivities import (
    Sensitivity as Sensitivity,
    Spread as Spread,
    sensitivity as sensitivity,
    slopes_of as slopes_of,
)
from .variables import (
    with_numbers as with_numbers,
)
from .word_tolerance import (
    ToleranceRange as ToleranceRange,
    tolerance_for as tolerance_for,
)
from .word_values import (
    TOOL as TOOL,
    Ranges as Ranges,
    name_of as name_of,
    ranges_of as ranges_of,
    read_limits as read_limits,
)
