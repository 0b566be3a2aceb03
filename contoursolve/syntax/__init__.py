"""Blocks and words as typed."""

from contoursolve.syntax.lexer import parse, parse_block
from contoursolve.syntax.word import Block, Fault, FaultKind, Macro, Program, Word

__all__ = ["Block", "Fault", "FaultKind", "Macro", "Program", "Word", "parse", "parse_block"]
