"""Blocks and words as typed."""

from contoursolve.syntax.lexer import parse, parse_block, read_directive
from contoursolve.syntax.word import FACT, Block, Directive, Fault, FaultKind, Macro, Program, Word

__all__ = [
    "FACT",
    "Block",
    "Directive",
    "Fault",
    "FaultKind",
    "Macro",
    "Program",
    "Word",
    "parse",
    "parse_block",
    "read_directive",
]
