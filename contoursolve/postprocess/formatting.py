"""Programs with one blank between words, and their blocks numbered anew if so asked: all else byte for byte."""

import re
from collections import defaultdict
from collections.abc import Container, Mapping

from msgspec.structs import replace

from contoursolve.controls import DIALECTS
from contoursolve.diagnosis import Meanings
from contoursolve.gcode import Block, Syntax, parse_block
from contoursolve.postprocess.block_numbers import LONG, Directory, ProgramLine, Replacement, dialect_of, read_lines
from contoursolve.postprocess.numbering import Numbers
from contoursolve.reading import Dialect

LARGEST_STEP = 1_000
"""From one block number to the next."""

_BLANKS = " \t"
_NAMED = re.compile(r"[A-Za-z]{2,}[ \t]+[-+\dA-Za-z]")
"""A word of Klartext whose name and number stand apart, as in `RX 13`."""
_BLANK = re.compile(r"[ \t]+")
_LABEL = re.compile(r"[A-Za-z_]\w+:|:\d+", re.ASCII)
"""Labels, in a syntax that has them: neither a word nor a blank."""


def format_program(
    text: str,
    *,
    control: str | Dialect | None = None,
    settings: Mapping[str, str] | None = None,
    block_numbers: int = 0,
) -> str:
    """A program with one blank between words, none inside a word, and none at the end of a line.

    Words, comments, line ends and indents stay as they are, and so do the blanks before a comment. So do lines that
    are no plain words: faulty and too long ones, macro statements, and those with a `%`.

    Args:
        text: the program, with its line ends.
        control: its name, or its tables; found from the program where it is clear. Where not, as ISO 6983 has it.
        settings: as for `solve`.
        block_numbers: the step from one block number to the next; 0 leaves all of them. Every block with words has a
            number then, and every jump follows. Each program of a file begins anew.

    Raises:
        UnknownControlError: there is no such control.
        SettingError: there is no such setting, or it has no such value.
        ValueError: a jump is computed, or its block is not there; or numbers have too many digits.

    >>> format_program("N5G01X 40.Z0 ,A30.(ROUGH)  \\nGOTO5")
    'N5 G01 X40. Z0 ,A30. (ROUGH)\\nGOTO5'
    >>> print(format_program("G00 X0\\nN5 G01 X40.\\nGOTO5", block_numbers=10))
    N10 G00 X0
    N20 G01 X40.
    GOTO20
    """
    if isinstance(block_numbers, bool) or block_numbers not in range(LARGEST_STEP + 1):
        raise ValueError(f"block_numbers cannot be {block_numbers!r}; choose a step from 1 to {LARGEST_STEP:,}, or 0")
    dialect = dialect_of(text, control, settings)
    lines = read_lines(text, dialect)
    if block_numbers:
        lines = _numbered(lines, dialect, block_numbers)
    addresses = _addresses(dialect)
    pieces, before = [""], ""
    for line in lines:
        # Without its blanks, an empty line between CR and LF would be none.
        is_between = before == "\r" and line.end == "\n"
        pieces += [_spaced(line, addresses) or line.block.text * is_between, line.end]
        before = line.end
    return "".join(pieces)


def _addresses(dialect: Dialect | None) -> frozenset[str]:
    """Addresses that begin a word on a control; those of all controls if it is not known."""
    known = [dialect] if dialect else DIALECTS.values()
    return frozenset(address for each in known for address in each.modes.lexicon.addresses)


def _spaced(line: ProgramLine, addresses: Container[str]) -> str:
    """A line with its blanks in their places; as it is where a control could read it otherwise."""
    block = line.block
    if line.is_comment or block.faults or block.macro or _is_doubtful(block, addresses):
        return block.text
    text = _join(block)
    if text is None:
        return block.text if block.syntax.comment.search(block.text) else block.text.rstrip(_BLANKS)
    return text if text == block.text or _same(block, _retyped(block, text)) else block.text


def _is_doubtful(block: Block, addresses: Container[str]) -> bool:
    """Whether several words of a block may be one that is mistyped: `X1O5.`, or `A180,K-30.`, whose comma may be meant
    as the point of A180."""
    ends = {word.span.end_column for word in block.words}
    commas = [word for word in block.words if word.address.startswith(",") and word.span.column in ends]
    return any(word.address not in addresses for word in commas) or bool(Meanings(block))


def _same(one: Block, other: Block) -> bool:
    """Whether two blocks say the same, with other blanks."""
    if other.faults or other.macro or one.is_skippable != other.is_skippable:
        return False
    return _BLANK.sub("", one.text) == _BLANK.sub("", other.text) and _meanings(one) == _meanings(other)


def _meanings(block: Block) -> list[tuple[object, ...]]:
    """The words of a block, each with its value and its text without blanks."""
    words = block.words
    return [(each.address, each.number, each.has_point, each.is_asked, _BLANK.sub("", each.text)) for each in words]


def _join(block: Block) -> str | None:
    """The pieces of a block with the blanks between them; None if it has any that is not known."""
    text, here, skip = block.text, 0, block.syntax.skip.match(block.text)
    joined = text[: len(text) - len(text.lstrip(_BLANKS))]
    if skip:
        joined, here = joined + skip[0].strip(_BLANKS), skip.end()
    for token in block.syntax.token.finditer(text, here):
        is_comment = token.lastgroup == "comment"
        piece = token[0] if is_comment else token[0].strip(_BLANKS)
        if not piece:
            continue
        if token.lastgroup == "blank" and not _LABEL.fullmatch(piece):
            return None
        begin = token.start() if is_comment else token.start() + token[0].index(piece)
        if joined.strip(_BLANKS) not in ("", "/"):
            joined += (is_comment and text[here:begin]) or " "
        joined += _without_blanks(piece, block.syntax) if token.lastgroup == "word" else piece
        here = begin + len(piece)
    return joined if joined.strip(_BLANKS) else ""


def _without_blanks(word: str, syntax: Syntax) -> str:
    """A word without blanks inside it, if it is a number's and reads the same."""
    bare = _BLANK.sub("", word)
    if bare == word or _NAMED.match(word):
        return word
    was, now = parse_block(word, 1, syntax), parse_block(bare, 1, syntax)
    is_number = all(each.number is not None or each.is_asked for each in was.words)
    return bare if is_number and not now.faults and _meanings(was) == _meanings(now) else word


def _numbered(lines: list[ProgramLine], dialect: Dialect | None, step: int) -> list[ProgramLine]:
    """Lines with their block numbers anew, and jumps that follow them. Raises ValueError."""
    numbers = Directory(lines, dialect)
    if numbers.doubts:
        raise ValueError(numbers.doubts[0].message)
    counts: dict[int, int] = defaultdict(int)
    new: dict[int, int] = {}
    for line in lines:
        number = line.block.line
        if number in numbers.own or (line.is_read and _takes_number(line.block)):
            counts[numbers.sections[number]] += step
            new[number] = counts[numbers.sections[number]]
    last, highest = max(counts.values(), default=0), Numbers(line.block.text for line in lines).highest
    if last > highest:
        raise ValueError(f"block numbers would go to N{last}, and the highest is N{highest}: choose a smaller step")
    digits: dict[int, list[Replacement]] = defaultdict(list)
    for own in numbers.own.values():
        digits[own.span.line].append(Replacement(own.span, own.spell(new[own.span.line])))
    for jump in numbers.jumps:
        number = new[numbers.target(jump).span.line]
        digits[jump.span.line].append(Replacement(jump.span, jump.spell(number)))
    like = next(iter(numbers.own.values()), None)
    found = []
    for line in lines:
        block = line.block
        for each in sorted(digits[block.line], key=lambda each: each.span, reverse=True):
            _, begin, end = each.span
            block = _retyped(block, block.text[: begin - 1] + each.text + block.text[end - 1 :])
        if block.line in new and block.line not in numbers.own:
            number = new[block.line]
            block = _with_number(block, like.spell(number) if like else str(number))
        found.append(replace(line, block=block))
    return found


def _takes_number(block: Block) -> bool:
    """Whether a block without a number may have one: it is plain words, and begins no program."""
    if block.faults or block.macro or not block.words or block.find("N") or block.find("O") or _join(block) is None:
        return False
    numbered = _with_number(block, str(LONG))
    return not numbered.faults and _meanings(numbered)[1:] == _meanings(block)


def _with_number(block: Block, digits: str) -> Block:
    """A block with a number before all that it says."""
    skip = block.syntax.skip.match(block.text)
    begin = skip.end() if skip else len(block.text) - len(block.text.lstrip(_BLANKS))
    return _retyped(block, f"{block.text[:begin]}N{digits} {block.text[begin:]}")


def _retyped(block: Block, text: str) -> Block:
    return parse_block(text, block.line, block.syntax)
