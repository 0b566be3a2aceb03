"""ISG kernel: parameters, variables, control blocks and subprograms."""

import re
from collections.abc import Iterable, Iterator
from functools import cache

from contoursolve.execution.line_reader import (
    ONE,
    PROGRAM_END,
    LineForm,
    LineReader,
    Spelling,
    nothing,
    number_of,
    strange,
)
from contoursolve.execution.macro_language import (
    MACHINES,
    UNSET,
    Assign,
    Call,
    CallKind,
    Definitions,
    Else,
    ElseIf,
    EndIf,
    EndLoop,
    For,
    If,
    Jump,
    Loop,
    MacroLanguage,
    MacroStatement,
    ProgramEnd,
    Return,
    VariableScope,
)
from contoursolve.execution.notation import ISG, UnreadableTermError
from contoursolve.gcode import IN_BRACKETS, nested
from contoursolve.numeric import Apply, Term

COMMENT = nested(r"\(", r"(?:\)|$)", "[^()]++", 4)
"""A comment in which others may be nested; each may stay open to the end of the line."""
_MACHINES = ("V.A.", "V.E.", "V.G.", "V.SYS.")
"""First characters of variables that belong to the machine, or to programs outside the control."""


def _assign(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    yield line.assignment()


def _if(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    condition = line.term()
    jump = line.take(r"\$GOTO")
    yield Jump(_target(line), condition) if jump else If(condition)


def _target(line: LineReader) -> Term | str:
    found = line.need(r"(?:N[ \t]*+(?P<number>\d++)|\[(?P<label>[^\[\]]++)\])")
    return number_of(found["number"]) if found["number"] else found["label"].strip().upper()


def _jump(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    yield Jump(_target(line))


def _while(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    yield Loop("WHILE", line.term())


def _until(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    """It runs again while the condition holds; for ever, where there is none."""
    yield EndLoop("DO", Apply("not", (line.term(),)) if line.take(r"(?=\S)") else None)


def _for(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    first = line.assignment()
    if not isinstance(first, Assign):
        raise UnreadableTermError
    line.need(",")
    last = line.term()
    yield For(first.variable, first.value, last, line.term() if line.take(",") else ONE, "FOR")


def _call(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    if found["bare"] and found["bare"].upper() == "CYCLE":
        line.at = len(line.text)
        yield strange(line.text[found.start() :])
        return
    yield Call(CallKind.PROGRAM, (found["quoted"] or found["bare"]).upper(), is_local=True)


def _label(line: LineReader, found: re.Match[str]) -> Iterable[MacroStatement]:
    line.labels.append(found["label"].upper())
    line.hide(found.start(), found.end())
    return ()


def _word(line: LineReader, _: re.Match[str]) -> Iterable[MacroStatement]:
    line.word(is_value=False)
    return ()


_OWN = r"\#[ \t]*+(?:ANG|RND|CHR|CHF|FRC)(?!\w)"
_NUMBERED = rf"[SM][ \t]*+{IN_BRACKETS}[ \t]*+="
_LETTER = rf"(?!{_NUMBERED})[A-Z](?![A-Z_])"
_VARIABLE = rf"(?:P[ \t]*+\d++|P[ \t]*+{IN_BRACKETS}|V\.[A-Z]++\.(?>(?:[\w.]++|{IN_BRACKETS})+))"
_TABLE = (
    Spelling(r"%.*+", nothing),
    Spelling(r"\#[ \t]*+(?P<end>END)?VAR(?!\w).*+", lambda _, found: [Definitions(not found["end"])], stays=True),
    Spelling(rf"\#(?!{_OWN[2:]}).*+", nothing),
    Spelling(rf"(?={_VARIABLE}[ \t]*+=(?!=))", _assign),
    Spelling(r"\$IF(?!\w)", _if),
    Spelling(r"\$ELSEIF(?!\w)", lambda line, _: [ElseIf(line.term())]),
    Spelling(r"\$ELSE(?!\w)", lambda *_: [Else()]),
    Spelling(r"\$ENDIF(?!\w)", lambda *_: [EndIf()]),
    Spelling(r"\$WHILE(?!\w)", _while),
    Spelling(r"\$ENDWHILE(?!\w)", lambda *_: [EndLoop("WHILE")]),
    Spelling(r"\$FOR(?!\w)", _for),
    Spelling(r"\$ENDFOR(?!\w)", lambda *_: [EndLoop("FOR")]),
    Spelling(r"\$DO(?!\w)", lambda *_: [Loop("DO")]),
    Spelling(r"\$ENDDO(?!\w)", _until),
    Spelling(r"\$GOTO(?!\w)", _jump),
    Spelling(r"\$[A-Z]++.*+", lambda _, found: [strange(found[0])]),
    Spelling(r"\[[ \t]*+(?P<label>[A-Z_]\w*+)[ \t]*+\]", _label),
    Spelling(r"LL?+[ \t]++(?:\"(?P<quoted>[^\"]++)\"|(?P<bare>[^\s\[\"();,#$=]++))", _call),
    Spelling(r"M0*+(?:17|29)(?![\w.])", lambda *_: [Return()], stays=True),
    Spelling(PROGRAM_END, lambda *_: [ProgramEnd()], stays=True),
    Spelling(rf"(?:{_OWN}|{_LETTER})[ \t]*+=?+(?=[ \t]*+[-+]?+[ \t]*+[\d.PV\[A-Z])", _word, stays=True),
)
_FORM = LineForm(
    ISG,
    head=r"(?:[ \t\ufeff]*+%(?>(?P<part>L[ \t]++)?)[ \t]*+(?P<program>[\w.]++))?[ \t]*+(?>(?:/\d*+)?)[ \t]*+"
    r"(?>(?:N[ \t]*+(?P<number>\d++):?+(?!\.))?)",
    comment=rf"{COMMENT}|;.*+",
    table=_TABLE,
    skip=r"[ \t]++|\"[^\"]*+\"?+|[A-Z_]{2}\w*+|[\d.]++|.",
    behind_value=r"[A-Z#$,\\]",
    says=r"[\[$%]|V\.|\#[ \t]*+(?>(?:END)?)VAR|P[ \t]*+\d|M0*+(?:2|17|29|30)(?!\d)|(?<![A-Z])LL?+[ \t]++[\"\w]"
    r"|\d\.?+[ \t]*+(?:[*/]|[-+][ \t]*+[\d.])",
)


def _files(name: str) -> tuple[str, ...]:
    return tuple(f"{name}{ending}" for ending in ("", ".nc", ".cnc", ".sub", ".txt"))


def _unknown(name: str) -> str:
    return f"{name}{MACHINES}" if name.startswith(_MACHINES) else f"{name}{UNSET}"


def _scope(name: str) -> VariableScope:
    # Printed: TF5200 programming manual, 207981323.
    return VariableScope.NESTED if name.startswith("V.L.") else VariableScope.EVERYWHERE


_NAMES = r"P\d+|V\.[A-Z]+\.[A-Z_][\w.\[\],]*"


@cache
def isg() -> MacroLanguage:
    """The statements of the ISG kernel."""
    return MacroLanguage(
        "isg",
        _FORM.may_say,
        _FORM.read,
        _files,
        _unknown,
        variables=_NAMES,
        moving=r"V\.G\.(?:NP|WZ_AKT).*",
        examples="P100 or V.P.X",
        scope=_scope,
        made_by=isg,
    )
