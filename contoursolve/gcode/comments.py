"""Comments in a program: blocks kept as comments, remarks, and what comments a block has."""

import re

_COMMENT = re.compile(r"\([^)]*\)|;.*")
_DIRECTIVE = re.compile(r"\(\s*contoursolve\s*:", re.IGNORECASE)
_NOT_PRINTED = re.compile(r"[\x00-\x1f\x7f\ufeff%]")
_BRACKETS = str.maketrans("()", "[]")
_LONGEST_COMMENT = 200
"""Characters; LinuxCNC reads lines of up to 255."""

LEFT_MARK = "(NOT EXPANDED: "
"""Begins the remark above a contour that is left as it is."""


def comment_out(text: str) -> list[str]:
    """A text as comments, without what would end them or be read on a tape."""
    text = _NOT_PRINTED.sub(" ", text.translate(_BRACKETS)).strip()
    if 0 < len(text) <= _LONGEST_COMMENT:
        return [f"({text})"]
    parts = (text[at : at + _LONGEST_COMMENT] for at in range(0, len(text), _LONGEST_COMMENT))
    return [f"({part})" for part in parts]


def remark(reason: str) -> str:
    """Why a contour is not expanded, as one comment."""
    text = LEFT_MARK.removeprefix("(") + reason
    return comment_out(text if len(text) <= _LONGEST_COMMENT else text[: _LONGEST_COMMENT - 3] + "...")[0]


def own_comments(text: str) -> list[str]:
    """The comments of a block, without those for contoursolve alone."""
    return [comment for comment in _COMMENT.findall(text) if not _DIRECTIVE.match(comment)]
