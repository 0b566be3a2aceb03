"""Blocks and words as typed."""

from contoursolve.syntax.lexer import parse, parse_block, read_directive
from contoursolve.syntax.text import STANDARD_INPUT, UnreadableProgramError, decode, read_bytes
from contoursolve.syntax.word import FACT, Block, Directive, Fault, FaultKind, Macro, Program, Word

__all__ = [
    "FACT",
    "STANDARD_INPUT",
    "Block",
    "Directive",
    "Fault",
    "FaultKind",
    "Macro",
    "Program",
    "UnreadableProgramError",
    "Word",
    "decode",
    "parse",
    "parse_block",
    "read_bytes",
    "read_directive",
]
