from .evaluate import (
    evaluate as evaluate,
    place_in as place_in,
    variables_of as variables_of,
    written as written,
)
from .events import (
    EventKind as EventKind,
    Follower as Follower,
    ProgramEvent as ProgramEvent,
    WrittenBack as WrittenBack,
)
from .fanuc import (
    counts_in as counts_in,
    fanuc as fanuc,
    haas as haas,
)
from .isg import (
    COMMENT as COMMENT,
    isg as isg,
)
from .klartext import (
    klartext as klartext,
)
from .machine import (
    MOST_BLOCKS as MOST_BLOCKS,
    Limit as Limit,
    Machine as Machine,
    ProgramKind as ProgramKind,
    kind_of as kind_of,
    machine_of as machine_of,
    needs_running as needs_running,
    says_end as says_end,
)
from .macro_language import (
    ANGLE_INCREMENT as ANGLE_INCREMENT,
    ARGUMENT as ARGUMENT,
    LENGTH_INCREMENT as LENGTH_INCREMENT,
    MACHINES as MACHINES,
    Assign as Assign,
    Call as Call,
    CallKind as CallKind,
    CodeLine as CodeLine,
    Known as Known,
    MacroLanguage as MacroLanguage,
    ModalCall as ModalCall,
    ProgramEnd as ProgramEnd,
    Unknown as Unknown,
    Vacant as Vacant,
    When as When,
    WordFormula as WordFormula,
)
from .sinumerik import (
    MOVES_BESIDE as MOVES_BESIDE,
    SYNCHRONOUS as SYNCHRONOUS,
    sinumerik as sinumerik,
)
from .subprograms import (
    ALONE as ALONE,
    Library as Library,
    Surroundings as Surroundings,
    surroundings_of as surroundings_of,
)
from .term_writer import (
    write_term as write_term,
)
from .variables import (
    NamedVariable as NamedVariable,
    check_names as check_names,
    named_variables as named_variables,
)
