from .arc_table import (
    CENTRES as CENTRES,
    ArcIssue as ArcIssue,
    ArcTable as ArcTable,
    Beyond as Beyond,
    BothStated as BothStated,
)
from .call_arguments import (
    ARGUMENTS as ARGUMENTS,
    machine_in as machine_in,
    unit_of_calls as unit_of_calls,
)
from .contour_builder import (
    ContourBuilder as ContourBuilder,
)
from .contour_form import (
    AT_ITS_LIMIT as AT_ITS_LIMIT,
    Assumption as Assumption,
    ContourForm as ContourForm,
    Convention as Convention,
    CornerRow as CornerRow,
    FactRow as FactRow,
    FreeFactWords as FreeFactWords,
    Outline as Outline,
    Premises as Premises,
    Sample as Sample,
    Setting as Setting,
    WordTable as WordTable,
    join_premises as join_premises,
    lay_out as lay_out,
    stated_sets as stated_sets,
)
from .control_flow import (
    Paths as Paths,
    TakenBlocks as TakenBlocks,
    Ways as Ways,
)
from .dialect import (
    POLAR_WORDS as POLAR_WORDS,
    SEMICOLON_COMMENT as SEMICOLON_COMMENT,
    SINUMERIK_FILE as SINUMERIK_FILE,
    Y_AXIS as Y_AXIS,
    Behind as Behind,
    Dialect as Dialect,
    Taken as Taken,
)
from .doubtful_words import doubtful_words as doubtful_words
from .follow import (
    ContourBlock as ContourBlock,
    End as End,
    Finder as Finder,
    blocks_of as blocks_of,
    contours_as_run as contours_as_run,
    contours_of as contours_of,
    reach_of as reach_of,
    state_facts as state_facts,
)
from .lexicon import (
    TURNED as TURNED,
    Address as Address,
    Bearing as Bearing,
    Beside as Beside,
    Code as Code,
    Diameter as Diameter,
    Effect as Effect,
    Lexicon as Lexicon,
    NumberFormat as NumberFormat,
    WithoutPoint as WithoutPoint,
)
from .modal_dependence import (
    MOTIONS as MOTIONS,
    STANDING_ALONE as STANDING_ALONE,
    Carried as Carried,
    Reliance as Reliance,
    carried as carried,
    frame_of as frame_of,
    reliance as reliance,
    restate as restate,
    why_unmet as why_unmet,
)
from .modal_state import (
    COMMENTED as COMMENTED,
    Awaited as Awaited,
    Mode as Mode,
    Modes as Modes,
    PlainLines as PlainLines,
    Position as Position,
    State as State,
    advance as advance,
    advance_plainly as advance_plainly,
    apply_modes as apply_modes,
    axis_words as axis_words,
    codes_of as codes_of,
    is_plain as is_plain,
    not_read as not_read,
    positions as positions,
    rows_of as rows_of,
    state_moved as state_moved,
    unread_state as unread_state,
)
from .moved_zero import (
    LENGTH as LENGTH,
    TOOL as TOOL,
    WORK as WORK,
    Entry as Entry,
    Offset as Offset,
    ZeroMove as ZeroMove,
    ZeroRow as ZeroRow,
    ZeroTable as ZeroTable,
    shift_zero as shift_zero,
    table_of as table_of,
)
from .parsed_contour import (
    ParsedContour as ParsedContour,
    ReadIssue as ReadIssue,
    Selector as Selector,
    leave as leave,
    next_place as next_place,
    offences_of as offences_of,
    read as read,
    stating as stating,
    unused_words as unused_words,
)
from .plain_arcs import (
    TURNS as TURNS,
    ArcFault as ArcFault,
    ArcWord as ArcWord,
    PlainArc as PlainArc,
    arc_of as arc_of,
    faults_of as faults_of,
    suspected as suspected,
    table_in as table_in,
)
from .rules import (
    THIS_CONTROL as THIS_CONTROL,
    VERBS as VERBS,
    AngleAlong as AngleAlong,
    AnglesParallel as AnglesParallel,
    Condition as Condition,
    Count as Count,
    Offence as Offence,
    Rule as Rule,
    Stated as Stated,
    Value as Value,
    all_of as all_of,
    at_least as at_least,
    at_most as at_most,
    check as check,
    is_refused_by_values as is_refused_by_values,
    some as some,
)
from .writer import (
    NOTHING as NOTHING,
    Around as Around,
    Plain as Plain,
    Restated as Restated,
    Writing as Writing,
)
