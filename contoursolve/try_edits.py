"""Trials: a block with words dropped, added, changed or completed; and the examples of rules."""

import shlex
from collections.abc import Iterable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from msgspec import Struct

from contoursolve import gcode
from contoursolve.api import follow_program, parse, solve
from contoursolve.controls import CONTROLS, ControlName
from contoursolve.diagnosis import Edit, EditKind, change, drop, edited, find_repairs
from contoursolve.diagnostics import checked
from contoursolve.gcode import Program
from contoursolve.program import Result, Rules, Units, choose
from contoursolve.reading import THIS_CONTROL, Control, Rule
from contoursolve.solving import Contour


class Completion(Struct, frozen=True):
    """A word that completes a block.

    Attributes:
        word: the word; it ends with `?` where its number is still to be chosen.
        block: the whole block with it.
        contour: the contour that it then has; None while the number is open.
    """

    word: str
    block: str
    contour: Contour | None


@checked
def what_if(
    block: str,
    *,
    drop: Iterable[str] = (),
    add: Iterable[str] = (),
    change: Mapping[str, str] | None = None,
    control: ControlName | Control | None = None,
    start: str | Mapping[str, float] | None = None,
    units: Units = "mm",
    rules: Rules = "enforce",
    settings: Mapping[str, str] | None = None,
) -> Result:
    """Solve a block with words dropped (by address), added, or changed (address to the new word).

    Other arguments and errors as for `solve`; raises ValueError if a word to drop or change is not there,
    or there more than once.

    >>> block = "G111 A135. I10. K-12. B180. Z-40."
    >>> what_if(block, drop=["A"], start="X40. Z0.").diagnostics
    ()
    >>> what_if(block, change={"K": "K-10."}, start="X40. Z0.", rules="off").answers[0].status.value
    'overdetermined'
    """
    program = gcode.parse(block)
    dialect = choose(control, program, settings)
    program = gcode.spelled(program, dialect.modes.syntax) if dialect else program
    edits = [_edit(program, address, "") for address in drop]
    edits += [_edit(program, address, word) for address, word in (change or {}).items()]
    last = next((each for each in reversed(program.blocks) if each.words), None)
    if last is None:
        raise ValueError("the block has no words")
    edits += [Edit(EditKind.ADD, word, text=word, line=last.line) for word in add]
    text = edited(program.blocks, edits)
    return solve(text, control=control, start=start, units=units, rules=rules, settings=settings)


def _edit(program: Program, address: str, text: str) -> Edit:
    if not isinstance(text, str):
        raise TypeError(f"the new word for {address} is a text such as '{address}5.', not {text!r}")
    words = [word for block in program.blocks for word in block.words if word.address == address.upper()]
    if len(words) != 1:
        raise ValueError(f"the block has {len(words)} words {address}; exactly one can be dropped or changed")
    return change(words[0], text) if text else drop(words[0])


@checked
def completions(
    block: str,
    *,
    control: ControlName | Control | None = None,
    start: str | Mapping[str, float] | None = None,
    units: Units = "mm",
) -> tuple[Completion, ...]:
    """Every single word that would complete a block, with its value where the geometry fixes it already.

    Arguments and errors as for `solve`. A word whose number is still to be chosen ends with `?`.

    >>> [each.word for each in completions("G111 A135. B180. Z-40.", start="X40. Z0.")]
    ['I?', 'K?', 'X?', 'U?']
    """
    program = gcode.parse(block)
    dialect = choose(control, program)
    result = solve(block, control=control, start=start, units=units)
    repairs = (repair for answer in result.answers if dialect for repair in find_repairs(answer, dialect).repairs)
    return tuple(
        Completion(repair.edits[0].text, repair.replacement, repair.contour)
        for repair in repairs
        if len(repair.edits) == 1 and repair.edits[0].kind is EditKind.ADD
    )


_KEYWORDS = {"--start": "start", "--rules": "rules", "--units": "units"}


def try_example(dialect: Control, rule: Rule, program: str, depth: str = "full") -> Result:
    """The result of an example of a rule of a control, with the findings about every line; `depth` as for `solve`."""
    words = shlex.split(rule.options.replace(THIS_CONTROL, dialect.name))
    options: dict[str, Any] = {"depth": depth} | {
        _KEYWORDS[name]: words[at + 1] for at, name in enumerate(words) if name in _KEYWORDS
    }
    for keyword, option in (("settings", "--set"), ("variables", "--let")):
        options[keyword] = dict(words[at + 1].split("=", 1) for at, name in enumerate(words) if name == option)
    name, _, text = rule.file.partition("\n")
    with TemporaryDirectory() as folder:
        if name:
            (Path(folder) / name).write_text(text, encoding="utf-8")
        # A name: what is concluded of a program on a control is concluded then.
        control = next((each for each in CONTROLS if each == dialect.name and CONTROLS[each] is dialect), dialect)
        return follow_program(parse(program), control=control, strict=True, folders=[folder], **options).collect()
