"""Examples in docstrings as blocks of code: what begins with >>> and ends at an empty line."""

import re
from typing import Any

from griffe import Extension, Object

EXAMPLE = re.compile(r"^(>>> .*(?:\n.+)*)", re.MULTILINE)


class Doctests(Extension):
    """Puts the examples of each docstring between fences, before it is read as Markdown."""

    def on_object(self, *, obj: Object, **_: Any) -> None:
        """One function, record, attribute or module."""
        if obj.docstring:
            obj.docstring.value = re.sub(
                r"^>>> (?:.+\n?)*",
                lambda code: f"```pycon\n{code[0].rstrip()}\n```\n",
                obj.docstring.value,
                flags=re.MULTILINE,
            )
