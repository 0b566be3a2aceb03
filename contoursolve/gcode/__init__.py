"""Characters into blocks and words, exactly as typed.

A text or a file comes in, blocks of words with their places go out; no word has a meaning yet. Begin with `word`,
then `lexer`.
"""

from contoursolve.gcode.lexer import (
    LONGEST_BLOCK,
    find_words,
    looks_like,
    parse,
    parse_block,
    read_directive,
    spelled,
    split_lines,
    words_as,
)
from contoursolve.gcode.lookalikes import (
    Lookalike,
    find_lookalikes,
    has_lookalike_code,
    lookalike_at,
    mended,
)
from contoursolve.gcode.syntax import ISO, Syntax, long_parts
from contoursolve.gcode.text import STANDARD_INPUT, UnreadableProgramError, read_bytes
from contoursolve.gcode.word import (
    FACT,
    Block,
    Caller,
    Directive,
    Fault,
    FaultKind,
    Macro,
    Passage,
    Program,
    Substitution,
    Word,
    call,
    number_of,
    spell,
)

__all__ = [
    "FACT",
    "ISO",
    "LONGEST_BLOCK",
    "STANDARD_INPUT",
    "Block",
    "Caller",
    "Directive",
    "Fault",
    "FaultKind",
    "Lookalike",
    "Macro",
    "Passage",
    "Program",
    "Substitution",
    "Syntax",
    "UnreadableProgramError",
    "Word",
    "call",
    "find_lookalikes",
    "find_words",
    "has_lookalike_code",
    "long_parts",
    "lookalike_at",
    "looks_like",
    "mended",
    "number_of",
    "parse",
    "parse_block",
    "read_bytes",
    "read_directive",
    "spell",
    "spelled",
    "split_lines",
    "words_as",
]
