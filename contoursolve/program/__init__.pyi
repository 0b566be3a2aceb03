from .agreeing_controls import (
    choose_alike as choose_alike,
)
from .batch import (
    Batch as Batch,
)
from .called_files import (
    blocks_of_called_files as blocks_of_called_files,
    names_called as names_called,
)
from .calls import (
    machine_for as machine_for,
    path_of as path_of,
)
from .cycle_profiles import (
    CycleProfile as CycleProfile,
)
from .lines import (
    Lines as Lines,
)
from .lookahead import (
    Line as Line,
    each_block as each_block,
)
from .mending import (
    DECLINED as DECLINED,
    Changes as Changes,
    Examined as Examined,
    FixedProgram as FixedProgram,
    Mend as Mend,
    changed as changed,
    changes_of as changes_of,
    examined_result as examined_result,
    likely_fixes as likely_fixes,
    mend as mend,
    mend_open as mend_open,
    safe_fixes as safe_fixes,
)
from .named_words import NamedWordError as NamedWordError
from .no_contour import (
    conclusions as conclusions,
)
from .open_program import (
    OpenContour as OpenContour,
    OpenProgram as OpenProgram,
)
from .pipeline import (
    ELSEWHERE as ELSEWHERE,
    FactPlaceError as FactPlaceError,
    Result as Result,
    Run as Run,
    attach as attach,
    run as run,
    walk as walk,
)
from .project_file import (
    CONTROL as CONTROL,
    SettingError as SettingError,
    check_settings as check_settings,
    configure as configure,
    find_baseline as find_baseline,
    find_settings as find_settings,
    find_tool_table as find_tool_table,
    read_setting as read_setting,
    restate_control as restate_control,
    stated_settings as stated_settings,
)
from .recognise import (
    Recogniser as Recogniser,
    SeveralControlsError as SeveralControlsError,
    UnknownControlError as UnknownControlError,
    choose as choose,
    find_control as find_control,
    for_kind as for_kind,
    for_machine as for_machine,
    named_control as named_control,
    what_shows as what_shows,
)
from .renumbering import (
    renumbered as renumbered,
)
from .request import (
    CheckKeywords as CheckKeywords,
    Depths as Depths,
    FollowKeywords as FollowKeywords,
    ProgramKeywords as ProgramKeywords,
    ReadingKeywords as ReadingKeywords,
    Request as Request,
    Rules as Rules,
    SolveKeywords as SolveKeywords,
    SolveOptions as SolveOptions,
    StartKeywords as StartKeywords,
    Units as Units,
    start_text as start_text,
    takes as takes,
)
from .running import (
    lines_alone as lines_alone,
)
from .solve_queue import (
    Step as Step,
)
from .start_point import (
    StartError as StartError,
    check_start as check_start,
)
