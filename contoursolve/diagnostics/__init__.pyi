from .choices import (
    check_type as check_type,
    checked as checked,
    choice_of as choice_of,
    did_you_mean as did_you_mean,
    names_like as names_like,
    typing_distance as typing_distance,
)
from .display import (
    Shown as Shown,
    from_above as from_above,
    hash_of as hash_of,
    register_functions as register_functions,
)
from .errors import (
    ProgramError as ProgramError,
    UserError as UserError,
)
from .extras import (
    LateModule as LateModule,
    MissingExtraError as MissingExtraError,
    importing as importing,
    need as need,
)
from .finding import (
    Alarm as Alarm,
    Applicability as Applicability,
    Basis as Basis,
    Diagnosis as Diagnosis,
    Diagnostic as Diagnostic,
    Fix as Fix,
    Freedom as Freedom,
    Label as Label,
    Layer as Layer,
    LineChange as LineChange,
    NumberRange as NumberRange,
    OpenNumber as OpenNumber,
    Severity as Severity,
    Tie as Tie,
    Verdict as Verdict,
)
from .json_text import (
    json_text as json_text,
    members as members,
    plain as plain,
)
from .source import (
    DRAWN as DRAWN,
    OWN as OWN,
    Book as Book,
    Evidence as Evidence,
    Source as Source,
    Span as Span,
)
