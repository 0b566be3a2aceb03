"""Further facts about a drawing: statements, their textual form, and the draft that they add to.

A text such as `length of line 1 = 30` comes in, facts of a profile go out. Begin with `statement`.
"""

from contoursolve.geometry.statements.apply import UnusedFact, apply_statements
from contoursolve.geometry.statements.draft import Draft, StatementError
from contoursolve.geometry.statements.grammar import GrammarError, Vocabulary, read_statement, write_statement
from contoursolve.geometry.statements.statement import (
    ChordIs,
    CircleAt,
    DirectionIs,
    EqualLengths,
    EqualSizes,
    LengthIs,
    LineAt,
    Meeting,
    MeetsLine,
    ParallelTo,
    PassesBeside,
    PassesThrough,
    PointIs,
    PolarAngleIs,
    RadiusIs,
    Statement,
    StraightIs,
    Touches,
    TurnIs,
)

__all__ = [
    "ChordIs",
    "CircleAt",
    "DirectionIs",
    "Draft",
    "EqualLengths",
    "EqualSizes",
    "GrammarError",
    "LengthIs",
    "LineAt",
    "Meeting",
    "MeetsLine",
    "ParallelTo",
    "PassesBeside",
    "PassesThrough",
    "PointIs",
    "PolarAngleIs",
    "RadiusIs",
    "Statement",
    "StatementError",
    "StraightIs",
    "Touches",
    "TurnIs",
    "UnusedFact",
    "Vocabulary",
    "apply_statements",
    "read_statement",
    "write_statement",
]
