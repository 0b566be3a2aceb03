"""Klartext: Q parameters, labels, jumps, calls and contours of cycles."""

import re
from collections.abc import Iterable, Iterator
from functools import cache

from contoursolve.execution.line_reader import (
    PROGRAM_END,
    LineForm,
    LineReader,
    Spelling,
    nothing,
    number_of,
    strange,
    word,
)
from contoursolve.execution.macro_language import (
    MACHINES,
    UNSET,
    Call,
    CallKind,
    Forget,
    Jump,
    MacroLanguage,
    MacroStatement,
    ProgramEnd,
    Return,
    VariableScope,
)
from contoursolve.execution.notation import KLARTEXT
from contoursolve.numeric import Apply, Variable

_CONDITIONS = {9: ("EQU", "equal"), 10: ("NE", "unequal"), 11: ("GT", "greater"), 12: ("LT", "less")}
"""Jumps, by the number of FN: the sign, and what it means."""
_FORMULAS = (*range(9), 13)
"""FN that set a parameter to a formula."""
_MACHINES = range(100, 200)
"""Parameters that the control sets."""


def _assign(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    yield line.assignment()


def _function(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    number = int(found["fn"])
    if number in _FORMULAS:
        yield line.assignment()
    elif number in _CONDITIONS:
        sign, meaning = _CONDITIONS[number]
        line.need("IF")
        first = line.term()
        line.need(sign)
        condition = Apply(meaning, (first, line.term()))
        line.need(r"GOTO[ \t]*+LBL")
        yield Jump(line.target(), condition)
    else:
        result = line.take(r"[^=]*?(Q[LRS]?\d++)[ \t]*+=")
        line.at = len(line.text)
        if result is not None:
            yield Forget(Variable(result[1].upper()), f"FN {number} reads it from the control")


def _label(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    name = found["text"].upper() if found["text"] is not None else number_of(found["digits"])
    if name == "0":
        yield Return()
        return
    line.labels.append(name)
    line.hide(found.start(), found.end())


def _call_label(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    target = line.target()
    # What stands behind the slash counts down on the screen.
    if line.take(r"REP[ \t]*+(?=[-+\dQ])"):
        count = line.term(is_value=True)
        line.take(r"/[ \t]*+\d++")
        yield Call(CallKind.SECTION, target, count=count)
    else:
        yield Call(CallKind.LABEL, target)


def _program_name(text: str) -> str:
    """The name of a program without folder and ending."""
    name = re.split(r"[\\/:]", text.strip().strip('"'))[-1]
    return name.partition(".")[0].upper()


def _call_program(_: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    yield Call(CallKind.PROGRAM, _program_name(found["file"]), is_local=True)


def _contours(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    """A profile for each label or program that is named."""
    cycle, rest = " ".join(found[0].upper().split()).partition(".")[0], line.text[line.at :]
    line.at = len(line.text)
    for name in re.finditer(_LABEL if "CYCL" in cycle else _NAMED, rest, re.IGNORECASE):
        label = _program_name(name[1]) if name[1] is not None else number_of(name[2])
        is_program = name[1] is not None and "CYCL" not in cycle
        yield Call(CallKind.PROFILE, label, cycle=cycle, is_local=is_program)


_LABEL = r'"([^"]*+)"|(?<!Q)(?<!Q[LRS])(?<!\d)(\d++)'
_NAMED = r'"([^"]*+)"|LBL[ \t]*+(\d++)'


def _begin(line: LineReader, found: re.Match[str]) -> Iterable[MacroStatement]:
    line.begins, line.unit = found["name"].upper() or None, found["unit"].upper()
    return ()


_TABLE = (
    Spelling(r"\*.*+", nothing),
    Spelling(r"(?<![A-Z])(?=Q[LRS]?\d++[ \t]*+=)", _assign),
    Spelling(r"(?<![A-Z])FN[ \t]*+(?P<fn>\d++)[ \t]*+:", _function),
    Spelling(r"(?<![A-Z])CALL[ \t]++LBL(?![A-Z])", _call_label),
    Spelling(r"(?<![A-Z])CALL[ \t]++PGM[ \t]*+(?P<file>\"[^\"]*+\"|[^ \t]++)", _call_program),
    Spelling(r"(?<![A-Z])CALL[ \t]++SELECTED.*+", lambda line, found: [strange(line.text[found.start() :])]),
    Spelling(r"(?<![A-Z])LBL[ \t]*+(?:\"(?P<text>[^\"]*+)\"|(?P<digits>\d++))", _label),
    Spelling(
        r"(?<![A-Z])(?:CYCL[ \t]++DEF[ \t]++14(?>(?:\.\d++)?)(?!\d)|CONTOUR[ \t]++DEF|(?:DECLARE|SEL)[ \t]++CONTOUR)",
        _contours,
    ),
    Spelling(r"(?<![A-Z])BEGIN[ \t]++PGM[ \t]*+(?P<name>[^ \t]*+)[ \t]++(?P<unit>MM|INCH)(?![A-Z])", _begin),
    Spelling(PROGRAM_END, lambda *_: [ProgramEnd()], stays=True),
    Spelling(r"(?=[-+][ \t]*+Q[LRS]?\d|Q[LRS]?\d)", word, stays=True),
)
_FORM = LineForm(
    KLARTEXT,
    head=r"[ \t/\ufeff]*+(?>(?:N?+(?P<number>\d++)(?![.,\w])[ \t]*+)?)",
    comment=r";.*+|~",
    table=_TABLE,
    skip=r"[ \t]++|\"[^\"]*+\"?+|[\d.,]++|.",
    behind_value=r"Q[LRS]?\d++[ \t]*+=",
    says=r"Q[LRS]?+\d|LBL|CALL[ \t]++(?:PGM|SEL)|M0*+(?:2|30)(?!\d)|FN[ \t]*+\d|CYCL[ \t]++DEF[ \t]++14(?!\d)"
    r"|CONTOUR|BEGIN[ \t]++PGM",
)


def _files(name: str) -> tuple[str, ...]:
    return f"{name}.H", f"{name}.I", name


def _unknown(name: str) -> str:
    digits = name.lstrip("QLRS")
    is_machines = name[1:] == digits and digits.isdigit() and int(digits) in _MACHINES
    return f"{name}{MACHINES}" if is_machines else f"{name}{UNSET}"


def _scope(name: str) -> VariableScope:
    # Printed: TNC 640 03/2014 p. 265. A label of the same program sees them: recalled.
    return VariableScope.LEVEL if name.startswith("QL") else VariableScope.EVERYWHERE


@cache
def klartext() -> MacroLanguage:
    """The statements of HEIDENHAIN's programs."""
    return MacroLanguage(
        "klartext",
        _FORM.may_say,
        _FORM.read,
        _files,
        _unknown,
        jumps_to_numbers=False,
        variables=r"Q[LRS]?\d+",
        examples="Q100, QL1 or QR1",
        passes_return=True,
        scope=_scope,
        made_by=klartext,
    )
