"""Macro B: Fanuc, and controls that follow it."""

import re
from collections.abc import Iterator
from functools import cache

from msgspec import structs

from contoursolve.execution.line_reader import (
    O_WORD,
    ONE,
    PROGRAM_END,
    LineForm,
    LineReader,
    Spelling,
    nothing,
    number_of,
    word,
)
from contoursolve.execution.macro_language import (
    ANGLE_INCREMENT,
    LENGTH_INCREMENT,
    MACHINES,
    UNSET,
    Assign,
    Call,
    CallKind,
    Else,
    EndIf,
    EndLoop,
    If,
    Jump,
    Loop,
    MacroLanguage,
    MacroStatement,
    ModalCall,
    ProgramEnd,
    Return,
    Strange,
    VariableScope,
    When,
)
from contoursolve.execution.notation import FANUC
from contoursolve.numeric import Apply, Constant, Term, Variable

_ARGUMENTS = dict(zip("ABCIJKDEFHMQRSTUVWXYZ", (*range(1, 10), 11, 13, *range(17, 27)), strict=True))
"""The variable that each word of G65 sets; I, J and K may stand several times."""
_COUNTED = {
    **dict.fromkeys("EIJKQRUVWXYZ", LENGTH_INCREMENT),
    **dict.fromkeys("ABC", ANGLE_INCREMENT),
}
"""The unit that arguments without a decimal point count: the least increment of their address. D, F, H, M, S and T are
whole numbers."""
_WHOLE = re.compile(r"[ \t]*+[-+]?+[ \t]*+\d++")
_ALARM = "#3000"
_LONGEST_NUMBER = 4
"""Digits of a program's number. More of them behind M98 P: those before the last four say how often."""
_FIRST_OF_MACHINE = 1000


def _assign(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    said = line.assignment()
    yield ProgramEnd() if isinstance(said, Assign) and said.variable == Variable(_ALARM) else said


def _block(line: LineReader) -> Term | str:
    line.take("N(?=[ \t]*+[0-9#\\[])")
    return line.target()


def _if(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    condition = line.term()
    if line.take("GOTO"):
        yield Jump(_block(line), condition)
        line.hide(found.start(), line.at)
        return
    line.need("THEN")
    line.hide(found.start(), line.at)
    begin = line.at
    then = line.read_statements()
    has_words = line.keeps(begin)
    yield When(condition, tuple(then), has_words) if then or has_words else If(condition)


def _while(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    condition = line.term()
    yield Loop(number_of(line.need(r"DO[ \t]*+(\d++)")[1]), condition)


def _words(line: LineReader, letters: str) -> Iterator[tuple[str, Term | str, str]]:
    """The words that stand next, each with what is typed behind its letter."""
    while found := line.take(rf"([{letters}])(?=[ \t]*+[-+.\d#\[])"):
        is_name, begin = found[1].upper() == "P", line.at
        value = line.target() if is_name else line.term(is_value=True)
        yield found[1].upper(), value, line.text[begin : line.at]


def _term(value: Term | str | None) -> Term:
    if value is None or isinstance(value, str):
        return ONE if value is None else Constant(float(value))
    return value


def _call(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    begin = line.at
    words = {letter: value for letter, value, _ in _words(line, "PLKQH")}
    target, repeated = words.get("P"), words.get("L", words.get("K"))
    if target is None or words.keys() & set("QH"):
        yield Strange(f"{found[0].strip()}{line.text[begin : line.at]} cannot be followed")
        return
    count = _term(repeated)
    if repeated is None and isinstance(target, str) and len(target) > _LONGEST_NUMBER:
        count, target = Constant(float(target[:-_LONGEST_NUMBER])), number_of(target[-_LONGEST_NUMBER:])
    yield Call(CallKind.PROGRAM if found["kind"] == "8" else CallKind.LINES, target, count=count)


def _macro_call(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    begin = line.at
    target: Term | str | None = None
    count: Term = ONE
    arguments, given, counted = list[tuple[str, Term]](), list[str](), ""
    for letter, value, typed in _words(line, "A-Z"):
        if letter == "P":
            target = value
        elif letter == "L":
            count = _term(value)
        elif letter in _ARGUMENTS:
            place = _ARGUMENTS[letter] + (3 * given.count(letter) if letter in "IJK" else 0)
            term = _term(value)
            if letter in _COUNTED and _WHOLE.fullmatch(typed) and term != Constant(0.0):
                counted += letter
                term = Apply("multiply", (term, _COUNTED[letter]))
            arguments.append((f"#{place}", term))
            given.append(letter)
    # G65 H is macro A: a computation by number.
    if not isinstance(target, str) and (target is None or "H" in given):
        yield Strange(f"{found[0].strip()}{line.text[begin : line.at]} cannot be followed")
        return
    yield Call(CallKind.PROGRAM, target, count=count, arguments=tuple(arguments), counted=counted, is_local=True)


def _modal_call(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    begin = line.at
    counted = "".join(each.counted for each in _macro_call(line, found) if isinstance(each, Call))
    line.at = begin
    yield ModalCall("contoursolve does not read G66 yet: it calls a macro after each move", counted=counted)


def _return(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    end = line.at
    if line.take("P(?=[ \t]*+[0-9#\\[])"):
        yield Return(line.term(is_value=True))
        line.hide(found.start(), line.at)
        return
    line.at = end
    yield Return()


def _profile(_: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    first, last = (number_of(found[group]) for group in ("first", "last"))
    yield Call(CallKind.PROFILE, first, last, cycle=f"G{found['cycle']}")


_TABLE = (
    # Behind a number sign, what is typed like a word of another control is no variable: #RND=5, #R5.
    Spelling(
        r"(?=#(?!(?-i:[A-Za-z]{2})\w*+[ \t]*+=[ \t]*+[-+.\d]|[A-Z]++[ \t]*+[-+.\d][\d.]*+(?![\w=\[]|[ \t]*+=)))",
        _assign,
    ),
    Spelling(r"[BD]PRNT[ \t]*+\[.*+", nothing),
    Spelling(r"IF[ \t]*+(?=[\[#])", _if, stays=True),
    Spelling(r"WHILE[ \t]*+(?=[\[#])", _while),
    Spelling(r"DO[ \t]*+(\d++)", lambda _, found: [Loop(number_of(found[1]))]),
    Spelling(r"END[ \t]*+(\d++)", lambda _, found: [EndLoop(number_of(found[1]))]),
    Spelling(r"ELSE(?![A-Z])", lambda *_: [Else()]),
    Spelling(r"ENDIF(?![A-Z])", lambda *_: [EndIf()]),
    Spelling(r"GOTO", lambda line, _: [Jump(_block(line))]),
    Spelling(r"M0*+9(?P<kind>8)(?![\d.])", _call),
    Spelling(r"G0*+65(?![\d.])", _macro_call),
    Spelling(r"G0*+66(?>(?:\.\d)?)(?!\d)", _modal_call, stays=True),
    Spelling(r"G0*+67(?![\d.])", lambda *_: [ModalCall()], stays=True),
    Spelling(r"M0*+99(?![\d.])", _return, stays=True),
    Spelling(PROGRAM_END, lambda *_: [ProgramEnd()], stays=True),
    Spelling(
        r"G0*+(?P<cycle>7[0-3])(?![\d.])(?![^\n]*[XYZ][ \t]*+[-+.\d#\[])"
        r"(?=[^\n]*?P[ \t]*+(?P<first>\d++)(?!\.))(?=[^\n]*?Q[ \t]*+(?P<last>\d++)(?!\.))",
        _profile,
        stays=True,
    ),
    Spelling(r",?+[A-Z][ \t]*+(?=[-+]?+[ \t]*+[#\[])", word, stays=True),
)
_FORM = LineForm(
    FANUC,
    head=rf"[ \t\f\v\x11-\x14\ufeff%]*+(?!{O_WORD})(?>(?:[O:][ \t]*+(?P<program>\d++))?)[ \t]*+(?>(?:/[1-9]?+)?)[ \t]*+"
    r"(?>(?:N[ \t]*+(?P<number>\d++)(?!\.))?)",
    comment=r"\([^)]*+\)?+|;.*+",
    table=_TABLE,
    skip=r"[ \t]++|[\d.+-]++|.",
    behind_value="[A-Z,#/]",
    says=r"[#\[]|M0*+(?:2|30|9[789])(?!\d)|G0*+(?:6[567](?!\d)|7[0-3](?!\d).*?[PQ][ \t]*+\d)|GOTO|DO[ \t]*+\d"
    r"|END[ \t]*+[\dI]|ELSE|\A[ \t\f\v\x11-\x14\ufeff%]*+[O:][ \t]*+\d",
)

_ENDINGS = ("", ".nc", ".txt", ".cnc", ".tap", ".prg", ".min", ".eia")


def program_files(name: str) -> tuple[str, ...]:
    """The files in which a program may be: 100 in `O0100.nc`, `O100`, `0100.txt`, ..."""
    stems = (f"O{name:0>4}", f"O{name}", f"{name:0>4}", f"O{name:0>5}", name) if name.isdigit() else (name,)
    return tuple(dict.fromkeys(f"{stem}{ending}" for stem in stems for ending in _ENDINGS[1:] + _ENDINGS[:1]))


def counts_in(letter: str) -> str:
    """The variable that says what an argument of a call with this letter counts without a decimal point."""
    return _COUNTED[letter].name


def _unknown(name: str) -> str:
    if name in (LENGTH_INCREMENT.name, ANGLE_INCREMENT.name):
        return "an argument has no decimal point, and the program changes between mm and inches"
    digits = name[1:]
    if digits.isdigit() and int(digits) >= _FIRST_OF_MACHINE:
        return f"{name}{MACHINES}"
    return f"{name}{UNSET}"


_LAST_LOCAL = 33


def _scope(name: str) -> VariableScope:
    is_local = name[1:].isdigit() and 1 <= int(name[1:]) <= _LAST_LOCAL
    return VariableScope.LEVEL if is_local else VariableScope.EVERYWHERE


_MOVING = r"#(?:2\d{3}|5[23]\d\d|7\d{3}|1\d{4})"
"""Variables of work and tool offsets: #2001 and up, #5201 and up, #7001 and up, #10001 and up."""
_NAMES = r"#(?!0+\Z)(?:\d+|<[^<>]+>)"


@cache
def fanuc() -> MacroLanguage:
    """Macro B, and the calls, jumps and profiles of the controls that follow Fanuc."""
    return MacroLanguage(
        "fanuc",
        _FORM.may_say,
        _FORM.read,
        program_files,
        _unknown,
        variables=_NAMES,
        moving=_MOVING,
        examples="#100",
        always_empty="#0",
        scope=_scope,
        made_by=fanuc,
    )


_HAAS = structs.replace(_FORM, table=(Spelling(r"M0*+9(?P<kind>7)(?![\d.])", _call), *_TABLE))


@cache
def haas() -> MacroLanguage:
    """The same with M97, which calls lines of the same program; on a Fanuc, M97 is the machine's own."""
    return MacroLanguage(
        "haas",
        _HAAS.may_say,
        _HAAS.read,
        program_files,
        _unknown,
        variables=_NAMES,
        moving=_MOVING,
        examples="#100",
        always_empty="#0",
        scope=_scope,
        made_by=haas,
    )
