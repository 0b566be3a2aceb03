"""Trials of the examples of rules."""

import shlex
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from contoursolve.api import follow_program, parse
from contoursolve.controls import CONTROLS
from contoursolve.program import Result
from contoursolve.reading import THIS_CONTROL, Control, Rule

_KEYWORDS = {"--start": "start", "--rules": "rules", "--units": "units"}


def try_example(control: Control, rule: Rule, program: str, depth: str = "full") -> Result:
    """The result of an example of a rule of a control, with the findings about every line; `depth` as for `solve`."""
    words = shlex.split(rule.options.replace(THIS_CONTROL, control.name))
    options: dict[str, Any] = {"depth": depth} | {
        _KEYWORDS[name]: words[at + 1] for at, name in enumerate(words) if name in _KEYWORDS
    }
    for keyword, option in (("settings", "--setting"), ("variables", "--variable")):
        options[keyword] = dict(words[at + 1].split("=", 1) for at, name in enumerate(words) if name == option)
    name, _, text = rule.file.partition("\n")
    with TemporaryDirectory() as folder:
        if name:
            (Path(folder) / name).write_text(text, encoding="utf-8")
        # A name: what is concluded of a program on a control is concluded then.
        given = next((each for each in CONTROLS if each == control.name and CONTROLS[each] is control), control)
        return follow_program(parse(program), control=given, strict=True, folders=[folder], **options).collect()
