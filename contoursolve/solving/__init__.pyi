from .affine import (
    AffineFacts as AffineFacts,
    Circuit as Circuit,
    IndependentFacts as IndependentFacts,
    affine_facts as affine_facts,
    values_at as values_at,
)
from .alternatives import (
    choose as choose,
    drawn_at as drawn_at,
    find_alternatives as find_alternatives,
)
from .ambiguity import (
    before as before,
    headings_of as headings_of,
    is_found_at_once as is_found_at_once,
    is_given_up as is_given_up,
    nearest_of_determined as nearest_of_determined,
    orders_of as orders_of,
    restrict as restrict,
    said_twice as said_twice,
    settle as settle,
    settled_by as settled_by,
)
from .certify import (
    certify as certify,
)
from .checks import (
    Check as Check,
    Checked as Checked,
    CheckOutputs as CheckOutputs,
    Checks as Checks,
    MeasuredFigure as MeasuredFigure,
    Stage as Stage,
    Test as Test,
    add_checks as add_checks,
    at_origin as at_origin,
    check_facts as check_facts,
    check_path as check_path,
    check_range as check_range,
    check_residuals as check_residuals,
    compile_checked as compile_checked,
    compile_checks as compile_checks,
    measured_figure as measured_figure,
    plain_checks as plain_checks,
)
from .closed_steps import is_searched as is_searched
from .compare import (
    compare as compare,
    compare_affine as compare_affine,
    increments_of as increments_of,
    is_conflict as is_conflict,
    opposes as opposes,
    runs_against as runs_against,
)
from .compile import (
    compile_branches as compile_branches,
    compile_path as compile_path,
    compile_system as compile_system,
)
from .construction import (
    Construction as Construction,
    ConstructionStep as ConstructionStep,
    NoClosedFormError as NoClosedFormError,
    StepKind as StepKind,
    is_closed as is_closed,
    points_with_two_solutions as points_with_two_solutions,
    steps_of as steps_of,
)
from .contour import (
    ArcSegment as ArcSegment,
    Contour as Contour,
    LineSegment as LineSegment,
    Segment as Segment,
    against_angles as against_angles,
    center_by_radius as center_by_radius,
    dropped_corners as dropped_corners,
    extremes as extremes,
    is_on as is_on,
    shifted as shifted,
    trace as trace,
    way_to as way_to,
)
from .contour_function import (
    TypedValues as TypedValues,
    build_function as build_function,
    rows_of as rows_of,
)
from .corner_definition import (
    corner_equations as corner_equations,
    ends_somewhere as ends_somewhere,
)
from .determinacy import (
    Determinacy as Determinacy,
    StepCondition as StepCondition,
    analyse as analyse,
    basis_of as basis_of,
    blocks_of as blocks_of,
    circuits_of as circuits_of,
    conditions_of as conditions_of,
    derive as derive,
    groups_of as groups_of,
    is_known as is_known,
    jacobian_of as jacobian_of,
    rank_of as rank_of,
    spare_of as spare_of,
    survey as survey,
)
from .drawn import (
    Drawing as Drawing,
    Drawings as Drawings,
    Stated as Stated,
)
from .enumerate import (
    Enumeration as Enumeration,
    enumerate_each as enumerate_each,
)
from .events import (
    BESIDE as BESIDE,
    STATUSES as STATUSES,
    GeometricEvent as GeometricEvent,
    GeometricEventKind as GeometricEventKind,
    NoteKind as NoteKind,
    PointsAt as PointsAt,
    RefusalKind as RefusalKind,
    Status as Status,
    Topic as Topic,
    events_about as events_about,
    refusals_about as refusals_about,
)
from .exact_inputs import (
    SMALLEST as SMALLEST,
)
from .fitting import (
    LEAST as LEAST,
    largest_fitting as largest_fitting,
    last_holding as last_holding,
    typed_limit as typed_limit,
)
from .free_cuts import (
    joints_among as joints_among,
    place_cuts as place_cuts,
)
from .identities import (
    derive_identity as derive_identity,
    is_affine as is_affine,
    tie_of as tie_of,
)
from .inputs import (
    input_values as input_values,
    symbolic_values as symbolic_values,
)
from .motions import (
    NaturalDrawing as NaturalDrawing,
    NullMotion as NullMotion,
    drawings as drawings,
    first_drawing as first_drawing,
    open_at_values as open_at_values,
)
from .natural_layout import told_by as told_by
from .newton import (
    RANK as RANK,
    Equations as Equations,
    null_space as null_space,
)
from .numbers import (
    axes_of as axes_of,
    corner_of as corner_of,
    inputs_of as inputs_of,
    lookup as lookup,
    scalars_of as scalars_of,
    sizes_of as sizes_of,
    solution_at as solution_at,
)
from .partition import (
    Group as Group,
    decompose as decompose,
    order as order,
)
from .picks import (
    numbers_of as numbers_of,
    pick as pick,
    resolved_later as resolved_later,
)
from .row_checks import agreement_rows as agreement_rows, passed_rows as passed_rows
from .row_outcome import (
    REASONS as REASONS,
    UNVERIFIED as UNVERIFIED,
    RowOutcome as RowOutcome,
    reason_of as reason_of,
)
from .sides import (
    ARCS as ARCS,
)
from .sketch import (
    Sketch as Sketch,
)
from .solution import (
    DECIMALS as DECIMALS,
    Alternative as Alternative,
    Alternatives as Alternatives,
    Certificate as Certificate,
    CornerSolution as CornerSolution,
    Note as Note,
    Point as Point,
    Proof as Proof,
    Refusal as Refusal,
    SystemSolution as SystemSolution,
    up_to_one_digit as up_to_one_digit,
)
from .solve import (
    ROUNDING as ROUNDING,
    solve as solve,
)
from .step_outputs import (
    Need as Need,
)
from .ties import (
    Ties as Ties,
    circuits_for_all_values as circuits_for_all_values,
    find_ties as find_ties,
    givens_of_facts as givens_of_facts,
    tied_with as tied_with,
)
from .vectors import (
    ALONG_AXIS as ALONG_AXIS,
    DIAGONAL as DIAGONAL,
    SAME as SAME,
    along as along,
    direction as direction,
    distance as distance,
    foot as foot,
    foot_on as foot_on,
    middle as middle,
    minus as minus,
    on_arc as on_arc,
    sweep_of as sweep_of,
    toward as toward,
    unit as unit,
    with_coordinate as with_coordinate,
)
