"""Advice of the command line in the words of the page, which has panes and a list in the place of options."""

import re

from contoursolve.gcode import Syntax, comment_out

_VALUE = r'(?:"([^"]*)"|([\w.#$?+=-]*[\w?]))'

_SETTING = re.compile(r"--setting ([\w-]+)\.([\w-]+)=([\w.+-]*\w)")

_OPTIONS = (
    (
        re.compile(r"by --control,? (?:[\w-]+, )?(?:in contoursolve\.toml )?or in the workbench's list"),
        r"in the list above",
    ),
    (re.compile(r"try --control with one of them"), r"choose one of them in the list above"),
    (re.compile(r"try --control ([\w-]+)"), r"choose \1 in the list above"),
    (re.compile(r"with --control ([\w-]+)"), r"with \1 in the list above"),
    (re.compile(r"with --start\b"), r"under Variables"),
    (re.compile(f"--start {_VALUE}"), r"\1\2 as the start point under Variables"),
    (re.compile(r"by --variable\b"), r"under Variables"),
    (re.compile(f"--variable {_VALUE}"), r"\1\2 under Variables"),
    (re.compile(r"with --tool\b"), r"under Tool"),
)
"""Options, and what stands for each on the page: a list of controls above the program, and panes with names."""


def in_page_words(text: str, syntax: Syntax) -> str:
    """A text with the options that it names as the page has them; a setting is a comment of the program.

    >>> from contoursolve.gcode import ISO
    >>> in_page_words('write the number, or state the value: --variable "#100=60."', ISO)
    'write the number, or state the value: #100=60. under Variables'
    """
    if "--" not in text:
        return text

    def comment(found: re.Match[str]) -> str:
        control, name, value = found.groups()
        stated = comment_out(f"contoursolve control: {control}, {name}: {value}", syntax)
        return f"the comment {' '.join(stated)} in the first lines"

    text = _SETTING.sub(comment, text)
    for option, words in _OPTIONS:
        text = option.sub(words, text)
    return text
