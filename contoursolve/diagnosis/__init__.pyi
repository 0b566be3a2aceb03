from .additions import (
    completions as completions,
    legal_blocks as legal_blocks,
    ways_to_complete as ways_to_complete,
    words_to_add as words_to_add,
)
from .answer_records import (
    Addition as Addition,
    AskedValue as AskedValue,
    Completion as Completion,
    Solution as Solution,
    Solutions as Solutions,
    StatedWord as StatedWord,
)
from .block_behind import report_behind as report_behind
from .chosen_solution import chosen_solution as chosen_solution
from .diagnose import (
    diagnose as diagnose,
    mend_points as mend_points,
    with_words as with_words,
)
from .edits import (
    Edit as Edit,
    EditKind as EditKind,
    apply_edits as apply_edits,
    change as change,
    drop as drop,
    edited as edited,
    typed_text as typed_text,
    with_value as with_value,
    write_word as write_word,
)
from .equation_records import (
    BlockState as BlockState,
    CornerSystem as CornerSystem,
    Equation as Equation,
    SystemBlock as SystemBlock,
    SystemCondition as SystemCondition,
    SystemStep as SystemStep,
    SystemUnknown as SystemUnknown,
    SystemValue as SystemValue,
    TiedWords as TiedWords,
)
from .equation_system import EquationSystem as EquationSystem
from .examine import (
    MOST_CHOICES as MOST_CHOICES,
    Answer as Answer,
    Depth as Depth,
    Policy as Policy,
    answer_question as answer_question,
    count_choices as count_choices,
    examine as examine,
    list_alternatives as list_alternatives,
    may_be_suspected as may_be_suspected,
    may_have_odd_points as may_have_odd_points,
    rank as rank,
)
from .explain import (
    Context as Context,
    absent_words as absent_words,
    context_of as context_of,
    report as report,
    spans_of as spans_of,
)
from .explain_arcs import explain_arc as explain_arc
from .fact_words import (
    fact_key as fact_key,
    fact_subject as fact_subject,
    fact_text as fact_text,
)
from .fill import (
    FARTHEST as FARTHEST,
    fill_in as fill_in,
)
from .hand_sheet import (
    Calculation as Calculation,
    CalculationLine as CalculationLine,
    Derivation as Derivation,
)
from .legality_table import (
    legal_samples as legal_samples,
    tabulate as tabulate,
)
from .line_slips import (
    mend_line as mend_line,
)
from .names_in_program import (
    called_in_program as called_in_program,
    labels_of as labels_of,
    named_in_program as named_in_program,
)
from .odd_points import has_odd_points as has_odd_points
from .references import (
    compare_reference as compare_reference,
)
from .sample_drawing import (
    helping_words as helping_words,
)
from .slip_kinds import (
    misreadings as misreadings,
    mistyped_codes as mistyped_codes,
)
from .solutions import (
    certificate_text as certificate_text,
    decimals_of as decimals_of,
    list_solutions as list_solutions,
    printed_certificate as printed_certificate,
)
from .solved_contours import mend_behind as mend_behind
from .spelling import (
    are_points_usual as are_points_usual,
    counted_text as counted_text,
    counts_few as counts_few,
    explain_asked_outside as explain_asked_outside,
    explain_faults as explain_faults,
    explain_lost as explain_lost,
    explain_start_diameter as explain_start_diameter,
    explain_start_units as explain_start_units,
    explain_unmarked as explain_unmarked,
    explain_words as explain_words,
    is_counted_start as is_counted_start,
    lost_points as lost_points,
    move_without_point as move_without_point,
    readings as readings,
    without_point as without_point,
)
from .suspicion import (
    suspect as suspect,
)
from .typo_fixes import (
    explain_commas as explain_commas,
    explain_letters as explain_letters,
)
from .vocabulary import (
    corner_words as corner_words,
    explain_call as explain_call,
    explain_codes_by_name as explain_codes_by_name,
    explain_corners as explain_corners,
    explain_vocabulary as explain_vocabulary,
    has_corners as has_corners,
    is_corner_word as is_corner_word,
    is_known as is_known,
    like_corners as like_corners,
    moves as moves,
    name_of as name_of,
    not_read_yet as not_read_yet,
)
from .window import (
    Window as Window,
    WindowPart as WindowPart,
)
from .wording import (
    DECIMALS as DECIMALS,
    NUMBERS as NUMBERS,
    PROBABLY as PROBABLY,
    ContourState as ContourState,
    angle_text as angle_text,
    axis_labels as axis_labels,
    coordinate_texts as coordinate_texts,
    coordinates as coordinates,
    count as count,
    either as either,
    element_text as element_text,
    inward as inward,
    join as join,
    length_in as length_in,
    length_limit as length_limit,
    length_of as length_of,
    length_text as length_text,
    limit_text as limit_text,
    meaning_of as meaning_of,
    measured as measured,
    place_text as place_text,
    short_name as short_name,
    state_of as state_of,
    states_in as states_in,
    status_text as status_text,
    statuses_text as statuses_text,
    unknowns_text as unknowns_text,
    value_text as value_text,
    word_keys as word_keys,
    written as written,
)
