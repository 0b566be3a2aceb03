"""Comments in a program: blocks kept as comments, remarks, and what comments a block has."""

import re

from contoursolve.gcode.syntax import ISO, Syntax
from contoursolve.gcode.word import Block

_DIRECTIVE = re.compile(r"[(;\[]\s*contoursolve\s*:", re.IGNORECASE)
_NOT_PRINTED = re.compile(r"[\x00-\x1f\x7f\ufeff%]")
_BRACKETS = {")": str.maketrans("()", "[]"), "]": str.maketrans("[]", "()")}
"""Brackets that stand for those that would end a comment, by these."""
_LONGEST_COMMENT = 200
"""Characters; LinuxCNC reads lines of up to 255."""

LEFT_MARK = "NOT EXPANDED: "
"""Begins the remark above a contour that is left as it is."""


def comment_out(text: str, syntax: Syntax = ISO) -> list[str]:
    """A text as comments, without what would end them or be read on a tape."""
    text = text.translate(_BRACKETS.get(syntax.remark[-1], {}))
    text = _NOT_PRINTED.sub(" ", text).strip()
    parts = (text[at : at + _LONGEST_COMMENT] for at in range(0, len(text), _LONGEST_COMMENT))
    return [syntax.remark.format(part) for part in parts]


def remark(reason: str, syntax: Syntax = ISO) -> str:
    """A comment with the reason why a contour is not expanded."""
    text = LEFT_MARK + reason
    return comment_out(text if len(text) <= _LONGEST_COMMENT else text[: _LONGEST_COMMENT - 3] + "...", syntax)[0]


def is_remark(line: str) -> bool:
    """Whether a line is such a remark."""
    return line.startswith(LEFT_MARK, 1)


def with_comments_of(text: str, syntax: Syntax, other: Syntax) -> str:
    """A block with its comments as another syntax has them, if it could not read them."""
    found = list(syntax.comment.finditer(text))
    unread = [match for match in found if other.comment.fullmatch(match[0]) is None]
    if not unread:
        return text
    inner = [match[0][1:].removesuffix({"(": ")", "[": "]"}.get(match[0][0], "")).strip() for match in found]
    bare = syntax.comment.sub("", text).rstrip()
    return " ".join([*([bare] if bare else []), *(comment_out("; ".join(inner), other))])


def own_comments(block: Block) -> list[str]:
    """The comments of a block, without those for contoursolve alone."""
    found = (match[0] for match in block.syntax.comment.finditer(block.text))
    return [comment for comment in found if not _DIRECTIVE.match(comment)]
