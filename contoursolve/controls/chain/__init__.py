"""Contours of lines and arcs in a row, one element a block, as most controls write them.

A `Language` of a control comes in: its words, and what makes two blocks meet in a computed intersection. Its reader and
its forms go out. Begin with `language`.
"""

from contoursolve.controls.chain.find import ChainFinder, reading
from contoursolve.controls.chain.form import forms_of
from contoursolve.controls.chain.language import (
    A_LINE,
    AN_ARC,
    CLOSING_LINE,
    OPEN_LINE,
    AngleWords,
    ArcWords,
    BlockMeeting,
    BlockOrder,
    CornerWords,
    Element,
    Joining,
    Language,
    LanguageBasis,
    Member,
)

__all__ = [
    "AN_ARC",
    "A_LINE",
    "CLOSING_LINE",
    "OPEN_LINE",
    "AngleWords",
    "ArcWords",
    "BlockMeeting",
    "BlockOrder",
    "ChainFinder",
    "CornerWords",
    "Element",
    "Joining",
    "Language",
    "LanguageBasis",
    "Member",
    "forms_of",
    "reading",
]
