"""Further facts about a drawing: statements, their textual form, and the draft that they add to."""

from contoursolve.statements.apply import Fault, Flaw, apply_statements
from contoursolve.statements.draft import Draft, StatementError
from contoursolve.statements.grammar import GrammarError, Vocabulary, read_statement
from contoursolve.statements.meeting import Meeting, MeetsLine
from contoursolve.statements.statement import (
    CircleAt,
    DirectionIs,
    EqualLengths,
    EqualSizes,
    LengthIs,
    LineAt,
    PassesThrough,
    PointIs,
    RadiusIs,
    Statement,
    StraightIs,
    Touches,
    TurnIs,
)
from contoursolve.statements.text import write_statement

__all__ = [
    "CircleAt",
    "DirectionIs",
    "Draft",
    "EqualLengths",
    "EqualSizes",
    "Fault",
    "Flaw",
    "GrammarError",
    "LengthIs",
    "LineAt",
    "Meeting",
    "MeetsLine",
    "PassesThrough",
    "PointIs",
    "RadiusIs",
    "Statement",
    "StatementError",
    "StraightIs",
    "Touches",
    "TurnIs",
    "Vocabulary",
    "apply_statements",
    "read_statement",
    "write_statement",
]
