from .controls import (
    COMMON_RULES as COMMON_RULES,
    GEOMETRY_RULES as GEOMETRY_RULES,
    AngleWords as AngleWords,
    ArcWords as ArcWords,
    BlockMeeting as BlockMeeting,
    BlockOrder as BlockOrder,
    ChainFinder as ChainFinder,
    CornerWords as CornerWords,
    Joining as Joining,
    Language as Language,
    LanguageBasis as LanguageBasis,
    forms_of as forms_of,
)
from .diagnostics import (
    Evidence as Evidence,
    Source as Source,
)
from .geometry import (
    CornerShape as CornerShape,
    Length as Length,
    Plane as Plane,
    Unit as Unit,
)
from .postprocess import (
    Post as Post,
)
from .reading import (
    Address as Address,
    Code as Code,
    Effect as Effect,
    Lexicon as Lexicon,
    Modes as Modes,
    NumberFormat as NumberFormat,
    Rule as Rule,
    WithoutPoint as WithoutPoint,
    all_of as all_of,
    some as some,
)
