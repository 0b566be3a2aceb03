from .comments import (
    comment_out as comment_out,
    is_remark as is_remark,
    own_comments as own_comments,
    remark as remark,
    with_comments_of as with_comments_of,
)
from .decoding import (
    decode as decode,
    encoding_of as encoding_of,
)
from .files import (
    ANY_TEXT as ANY_TEXT,
    ENDINGS as ENDINGS,
    SHARED_ENDINGS as SHARED_ENDINGS,
    CannotWriteError as CannotWriteError,
    OpenFile as OpenFile,
    check_target as check_target,
    check_unprotected as check_unprotected,
    file_in_memory as file_in_memory,
    open_program_file as open_program_file,
    open_whole as open_whole,
    program_file_of as program_file_of,
    write_whole as write_whole,
)
from .late_pattern import (
    late_pattern as late_pattern,
)
from .lexer import (
    Blocks as Blocks,
    blocks_in as blocks_in,
    in_passages as in_passages,
    looks_like as looks_like,
    parse as parse,
    parse_block as parse_block,
    read_directive as read_directive,
    read_named as read_named,
    spelled as spelled,
    telling as telling,
    words_as as words_as,
)
from .lookalikes import (
    Lookalike as Lookalike,
    find_lookalikes as find_lookalikes,
    has_lookalike_code as has_lookalike_code,
    lookalike_at as lookalike_at,
    mended as mended,
)
from .plain_lines import (
    Passage as Passage,
    motion_of as motion_of,
    split_lines as split_lines,
    words_of as words_of,
)
from .plain_spelling import (
    AXES as AXES,
    MOST_TOGETHER as MOST_TOGETHER,
    NUMBER as NUMBER,
    lines_and_arcs as lines_and_arcs,
    plain_spelling as plain_spelling,
)
from .syntax import (
    IN_BRACKETS as IN_BRACKETS,
    IN_PARENTHESES as IN_PARENTHESES,
    ISO as ISO,
    PLAIN as PLAIN,
    Syntax as Syntax,
    WordSpelling as WordSpelling,
    long_parts as long_parts,
    nested as nested,
)
from .text import (
    MOST_OF_OTHERS as MOST_OF_OTHERS,
    MOST_OF_PROGRAM as MOST_OF_PROGRAM,
    STANDARD_INPUT as STANDARD_INPUT,
    UnreadableProgramError as UnreadableProgramError,
    open_regular as open_regular,
    read_bytes as read_bytes,
    read_toml as read_toml,
)
from .word import (
    FACT as FACT,
    Block as Block,
    Caller as Caller,
    Directive as Directive,
    Fault as Fault,
    FaultKind as FaultKind,
    Macro as Macro,
    Named as Named,
    NamedAs as NamedAs,
    Program as Program,
    Substitution as Substitution,
    TypedPlace as TypedPlace,
    Word as Word,
    call as call,
    typed_places as typed_places,
    typed_span as typed_span,
    words_called as words_called,
)
