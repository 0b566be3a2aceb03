from .all_controls import (
    CONTROLS as CONTROLS,
    ControlName as ControlName,
)
from .chain.find import (
    ChainFinder as ChainFinder,
)
from .chain.form import (
    compose as compose,
    forms_of as forms_of,
    names_of as names_of,
)
from .chain.language import (
    AngleWords as AngleWords,
    ArcWords as ArcWords,
    BlockMeeting as BlockMeeting,
    BlockOrder as BlockOrder,
    CornerWords as CornerWords,
    Element as Element,
    Joining as Joining,
    Language as Language,
    LanguageBasis as LanguageBasis,
)
from .cnc_pilot import (
    CNC_PILOT as CNC_PILOT,
)
from .common import (
    COMMON_RULES as COMMON_RULES,
)
from .drawing import (
    DRAWINGS as DRAWINGS,
    words_of_drawing as words_of_drawing,
)
from .fanuc import (
    FANUC_LATHE as FANUC_LATHE,
    FANUC_MILL as FANUC_MILL,
    HAAS_LATHE as HAAS_LATHE,
    HAAS_MILL as HAAS_MILL,
)
from .geometry_rules import (
    GEOMETRY_RULES as GEOMETRY_RULES,
)
from .heidenhain import (
    HEIDENHAIN as HEIDENHAIN,
)
from .isg import (
    ISG as ISG,
)
from .mitsubishi import (
    MITSUBISHI as MITSUBISHI,
)
from .nct_99m import (
    NCT_99M as NCT_99M,
)
from .plain import (
    CENTERS as CENTERS,
    PLAIN as PLAIN,
    Centers as Centers,
)
from .siemens import (
    SIEMENS_808D as SIEMENS_808D,
    SIEMENS_840D as SIEMENS_840D,
)
from .tool_facts import (
    TOOL_FACTS as TOOL_FACTS,
    ToolEffect as ToolEffect,
    ToolFacts as ToolFacts,
    ToolWord as ToolWord,
)
from .yasnac_lx3 import (
    YASNAC_LX3 as YASNAC_LX3,
)
