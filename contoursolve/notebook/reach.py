"""Where on its slider each word has a contour."""

from typing import Any

from contoursolve.notebook.exploration import Exploration, words_of
from contoursolve.syntax import Word


def frames_of(exploration: Exploration) -> dict[str, str]:
    """The text around each word with a value, by the word's key: its range stays as long as this does."""
    answer = exploration.answer
    if answer is None:
        return {}
    return {key: _frame(exploration, word) for key, word in words_of(answer).items() if word.number is not None}


def _frame(exploration: Exploration, word: Word) -> str:
    blocks = exploration.result.program.blocks
    return "\n".join(
        block.text[: word.span.column - 1] + "\0" + block.text[word.span.end_column - 1 :]
        if block.line == word.span.line
        else block.text
        for block in blocks
    )


def range_of(exploration: Exploration, key: str) -> dict[str, Any]:
    """The ranges of one word."""
    return {}
