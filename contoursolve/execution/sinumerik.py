"""SINUMERIK: R parameters and variables, jumps, loops, calls, and profiles of cycles."""

import itertools
import re
from collections.abc import Iterable, Iterator

from contoursolve.execution.line_reader import ONE, PROGRAM_END, LineForm, LineReader, Spelling, nothing, strange
from contoursolve.execution.macro_language import (
    MACHINES,
    UNSET,
    Assign,
    Call,
    CallKind,
    Else,
    EndIf,
    EndLoop,
    For,
    Forget,
    FormalParameter,
    If,
    Jump,
    JumpWay,
    Loop,
    MacroLanguage,
    MacroStatement,
    ModalCall,
    ProgramEnd,
    Refused,
    Return,
    Strange,
    VariableType,
)
from contoursolve.execution.notation import SINUMERIK, UnreadableTermError
from contoursolve.gcode import IN_BRACKETS, IN_PARENTHESES
from contoursolve.numeric import Apply, Constant, Indexed, Quoted, Term, Variable

_WAYS = {"": JumpWay.ANYWHERE, "C": JumpWay.ANYWHERE, "F": JumpWay.FORWARD, "B": JumpWay.BACKWARD}
_MOST_ELEMENTS = 200
"""Elements of a field that are set one by one."""
_LABEL = r"(?:(?!R\d)[A-Z_]\w++|:[ \t]*+\d++)"
_BEHIND = r"(?![\w$])"
_NAME_OF_FILE = re.compile(r"(?:.*/)?(?:_N_)?(?P<name>\w+?)(?:_SPF|_MPF|\.\w+)?$", re.IGNORECASE)


def _program_name(text: str) -> str:
    """The name of a program without folder and ending."""
    found = _NAME_OF_FILE.match(text.strip())
    return (found["name"] if found else text).upper()


def _target(line: LineReader) -> Term | str:
    found = line.take(_LABEL + r"(?![\w(\[])")
    if found is not None:
        return re.sub(r"[ \t]", "", found[0].upper()).replace(":", "N")
    return line.target()


def _jump(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    target = _target(line)
    if line.take("<<"):
        # The name is put together.
        line.at = len(line.text)
        yield Strange(strange(line.text[found.start() :]).reason, jumps=True)
        return
    yield Jump(target, way=_WAYS[found["way"].upper()])


def _if(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    condition = line.term()
    jump = line.take(rf"GOTO(?P<way>[BFC]?){_BEHIND}")
    yield Jump(_target(line), condition, _WAYS[jump["way"].upper()]) if jump else If(condition)


def _while(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    yield Loop("WHILE", line.term())


def _until(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    yield EndLoop("REPEAT", line.term())


def _for(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    line.take(r"INT(?=[ \t])")
    first = line.assignment()
    line.need("TO" + _BEHIND)
    if not isinstance(first, Assign):
        raise UnreadableTermError
    yield For(first.variable, first.value, line.term(), name="FOR")


def _case(line: LineReader, _: re.Match[str]) -> Iterator[MacroStatement]:
    value = line.term()
    line.need("OF" + _BEHIND)
    while line.text[line.at :].strip():
        condition = None if line.take("DEFAULT" + _BEHIND) else Apply("equal", (value, line.term(is_value=True)))
        way = line.need(r"GOTO([BFC]?)(?=[ \t\"])")[1].upper()
        yield Jump(_target(line), condition, _WAYS[way])


def _count(line: LineReader) -> Term:
    return line.term(is_value=True) if line.take(r"P[ \t]*+=?+[ \t]*+(?=\d|R\d|\(|[A-Z_]{2})") else ONE


def _repeat(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    names = [
        each[0].strip().upper() for _ in range(2) if (each := line.take(r"(?!P[ \t]*+[=\d])" + _LABEL + r"(?![\w=])"))
    ]
    count = _count(line)
    if not names:
        yield Loop("REPEAT")
    elif found["block"]:
        yield Call(CallKind.LABEL, names[0], names[0], count)
    elif len(names) == 1:
        yield Call(CallKind.SECTION, names[0], count=count)
    else:
        yield Call(CallKind.LABEL, names[0], names[1], count)


def _given(line: LineReader) -> Iterator[tuple[str, Term]]:
    """The arguments of a call, by their places; 0 for one that is left out."""
    if line.take(r"\([ \t]*+\)") or not line.take(r"\("):
        return
    for place in itertools.count(1):
        yield str(place), Constant(0.0) if line.take(r"(?=[,)])") else line.term()
        if line.need(r"[,)]")[0].strip() == ")":
            return


def _call(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    name = found["name"].upper()
    if name in line.names:
        line.take(IN_PARENTHESES)
        return
    if _MOVES.search(line.text):
        # A call stands in a block of its own: it is a command that is not known.
        return
    arguments = tuple(_given(line))
    yield Call(CallKind.PROGRAM, name, count=_count(line), arguments=arguments, is_local=True)


def _call_letter(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    yield Call(CallKind.PROGRAM, found["name"].upper(), arguments=tuple(_given(line)), is_local=True)


_MOVES = re.compile(r"(?<![A-Z_$])[XYZ](?:[ \t]*+=|[ \t]*+[-+.\d])", re.IGNORECASE)
"""A coordinate in a line."""


def _call_by_name(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    begin = line.at
    name = line.take(r"\(?[ \t]*+(?:\"(?P<text>[^\"]*+)\"|(?P<bare>[\w/]++))[ \t]*+\)?")
    section = line.take(rf"BLOCK[ \t]++(?P<first>{_LABEL})[ \t]++TO[ \t]++(?P<last>{_LABEL})")
    if name is None or section or line.take(r"<<"):
        line.at = len(line.text)
        yield strange(found[0] + line.text[begin:])
        return
    arguments, program = tuple(_given(line)), _program_name(name["text"] or name["bare"])
    yield Call(CallKind.PROGRAM, program, count=_count(line), arguments=arguments, is_local=True)


def _between(_: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    yield Call(CallKind.LABEL, found["first"].upper(), found["last"].upper())


def _return(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    yield strange(found[0]) if line.take(IN_PARENTHESES) else Return()


def _profile(_: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    """The contour of a cycle: a program, or two labels."""
    cycle, given = found["cycle"].upper(), found["given"]
    texts = [each.upper() for each in re.findall(r'"([^"]*)"', given)]
    name, *labels = texts or [""]
    if given[1:].lstrip().startswith(","):
        # CYCLE62(,2,"A","B"): labels alone.
        name, labels = "", texts
    elif cycle == "CYCLE95":
        labels = name.split(":") if ":" in name else []
    elif not labels and re.match(r"\([^,]*,[ \t]*1\b", given):
        labels = [f"E_LAB_{end}_{name}" for end in "AE"]
    if len(labels) == 2 and (cycle == "CYCLE95" or not name or labels[0].startswith("E_LAB_A")):  # noqa: PLR2004
        yield Call(CallKind.PROFILE, labels[0], labels[1], cycle=cycle)
    elif name and not labels:
        yield Call(CallKind.PROFILE, _program_name(name), cycle=cycle, is_local=True)
    else:
        yield strange(found[0])


_TYPES = "REAL|INT|BOOL|CHAR|STRING|AXIS|FRAME"
_PARAMETER = re.compile(
    rf"(?:(?P<var>VAR)[ \t]++)?(?:(?P<type>{_TYPES})\b[ \t]*+(?:\[[^\]]*\][ \t]*+)?)?"
    r"(?P<name>[A-Z_]\w*+)[ \t]*+(?:\[[^\]]*\][ \t]*+)?(?P<default>=[^,]*)?\Z",
    re.IGNORECASE,
)
_BETWEEN_PARAMETERS = re.compile(r",(?![^\[]*\])")


def _procedure(line: LineReader, found: re.Match[str]) -> Iterable[MacroStatement]:
    line.begins, line.is_part = found["name"].upper(), True
    line.saves = re.search(r"\bSAVE\b", found["words"], re.IGNORECASE) is not None
    formal = (_PARAMETER.search(each) for each in _BETWEEN_PARAMETERS.split((found["formal"] or "")[1:-1]))
    line.parameters += [
        FormalParameter(
            each["name"].upper(),
            VariableType[(each["type"] or "REAL").upper()],
            each["var"] is not None,
            each["default"] is not None,
        )
        for each in formal
        if each
    ]
    line.hide(found.start(), found.end())
    return ()


def _define(line: LineReader, kind: re.Match[str]) -> Iterator[MacroStatement]:
    """Variables and fields are 0, and texts empty, where nothing else is said."""
    of_type = VariableType[kind["type"].upper()]
    empty = Quoted("") if of_type is VariableType.STRING else Constant(0.0)
    while True:
        found = line.need(r"(?P<name>[A-Z_]\w*+)[ \t]*+(?>(?P<size>\[[\d, \t]++\])?)")
        name = found["name"].upper()
        ends = [range(int(each)) for each in re.findall(r"\d+", found["size"] or "")]
        elements = [f"{name}[{','.join(map(str, each))}]" for each in itertools.product(*ends)] if ends else [name]
        if not _IS_NAME.match(name) or name in line.names:
            told = f"DEF {name}: the first two characters of a variable's name are letters or underscores"
            if _IS_NAME.match(name):
                told = f"DEF {name}: {name} is a word of the control; give the variable another name"
            line.at = len(line.text)
            yield Forget(Variable(name), told)
            yield Refused(told)
            return
        if of_type in (VariableType.AXIS, VariableType.FRAME):
            line.take(r"=[^,]*+")
        if ends:
            yield Assign(Variable(name), empty, of_type)
        if line.take("="):
            yield from _initial(line, elements, of_type)
        elif len(elements) <= _MOST_ELEMENTS:
            yield from (Assign(Variable(each), empty, of_type) for each in elements)
        if not line.take(","):
            return


_IS_NAME = re.compile("[A-Z_]{2}")


def _initial(line: LineReader, elements: list[str], of_type: VariableType) -> Iterator[MacroStatement]:
    is_list = line.take(r"(?:SET|REP)?[ \t]*+(?=\()") if len(elements) > 1 else None
    values = [value for _, value in _given(line)] if is_list else [line.term()]
    if is_list and is_list[0].strip().upper() == "REP":
        values = values[:1] * min(len(elements), _MOST_ELEMENTS)
    for name, value in zip(elements, values, strict=False):
        yield Assign(Variable(name), value, of_type)


def _equals(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    """A word with a value, or a variable that gets one."""
    name = found["name"].upper()
    # In synchronous actions, R parameters have this sign, and elsewhere they may have it.
    own = name.removeprefix("$")
    is_parameter = own[0] == "R" and (own[1:].isdigit() or (own == "R" and found["index"] is not None))
    is_address = len(name) == 1 or name[1:].isdigit()
    if not is_parameter and (name.startswith("$") or name in line.names or is_address):
        line.take(r"(?:[DR]?[AI]C|DC|ACP|ACN|CAC|CIC|CDC)[ \t]*+\(")
        line.word(is_value=False)
        return
    line.at = found.start() + (len(name) - len(own) if is_parameter else 0)
    said = line.assignment()
    if isinstance(said, Forget) and isinstance(said.variable, Variable | Indexed) and found["index"]:
        # A field that gets several values: A[0]=SET(1,2,3).
        yield Strange(said.reason)
        return
    yield said


def _label(line: LineReader, found: re.Match[str]) -> Iterable[MacroStatement]:
    line.labels.append(found["label"].upper())
    line.hide(found.start(), found.end())
    return ()


def _key(word: str) -> str:
    return word + _BEHIND


_OWN_CYCLES = r"(?:CYCLE\d++|HOLES\d|POCKET\d|SLOT\d|LONGHOLE)"
"""Recalled: the maker's cycles begin with PROC NAME SAVE."""


def _modal_call(_: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    reason = "contoursolve does not read MCALL yet: it calls a subprogram after each move"
    yield ModalCall(reason, "MCALL", found["cycle"] is not None)


SYNCHRONOUS = r"(?:IDS?[ \t]*+=[ \t]*+\d++[ \t]*+)?(?:WHEN|WHENEVER|FROM|EVERY|DO)\b"
"""Beginning of a synchronous action, which runs beside the program whenever its condition holds."""
MOVES_BESIDE = r".*\b(?:(?:POSA?|MOV)[ \t]*+\[|DO\b.*(?<![A-Z_$\[])[XYZ][ \t]*+=?+[ \t]*+[-+.\d])"
"""Synchronous action that moves an axis."""


def _synchronous(line: LineReader, found: re.Match[str]) -> Iterator[MacroStatement]:
    """Statements for a synchronous action: the axes and variables that it changes are not known from here on."""
    shown = strange(found[0]).reason.removesuffix(" cannot be read")
    line.hide(found.start(), found.end())
    if found["moves"]:
        yield Strange(f"{shown} moves an axis beside the program", is_beside=True)
    for name in re.findall(r"(?<!\w)R\d+(?=[ \t]*=(?!=))", found[0], re.IGNORECASE):
        yield Forget(Variable(name.upper()), f"{shown} sets {name.upper()} beside the program")
    # What else it does bears on nothing that is known.
    yield Forget(Variable("$ACTION"), shown)


_TABLE = (
    Spelling(rf"{SYNCHRONOUS}(?>(?P<moves>{MOVES_BESIDE})?).*+", _synchronous),
    Spelling(r"%.*+", nothing),
    Spelling(r"(?P<label>[A-Z_]\w++):(?!=)", _label),
    Spelling(
        _key(
            r"DEF[ \t]++(?>(?:(?:NCK|CHAN|SYN[RW]{1,2})[ \t]++)*)"
            r"(?P<type>REAL|INT|BOOL|CHAR|AXIS|FRAME|STRING(?=[ \t]*+\[))(?>(?:(?<=STRING)[ \t]*+\[[^\]]*+\])?)"
        ),
        _define,
    ),
    Spelling(rf"PROC[ \t]++(?P<name>\w++)[ \t]*+(?>(?P<formal>{IN_PARENTHESES})?)(?P<words>.*+)", _procedure),
    Spelling(_key("(?:DEF|EXTERN|REDEF|DEFINE)") + ".*+", nothing),
    Spelling(_key("IF"), _if),
    Spelling(_key("ELSE"), lambda *_: [Else()]),
    Spelling(_key("ENDIF"), lambda *_: [EndIf()]),
    Spelling(_key("WHILE"), _while),
    Spelling(_key("ENDWHILE"), lambda *_: [EndLoop("WHILE")]),
    Spelling(_key("FOR"), _for),
    Spelling(_key("ENDFOR"), lambda *_: [EndLoop("FOR")]),
    Spelling(_key("LOOP"), lambda *_: [Loop("LOOP")]),
    Spelling(_key("ENDLOOP"), lambda *_: [EndLoop("LOOP")]),
    Spelling(_key("REPEAT(?P<block>B?)"), _repeat),
    Spelling(_key("UNTIL"), _until),
    Spelling(_key("GOTO(?P<way>[BFC]?)"), _jump),
    Spelling(_key("GOTOS"), lambda _, found: [Strange(strange(found[0]).reason, jumps=True)]),
    Spelling(_key("CASE"), _case),
    Spelling(_key(rf"CALL[ \t]++BLOCK[ \t]++(?P<first>{_LABEL})[ \t]++TO[ \t]++(?P<last>{_LABEL})"), _between),
    Spelling(_key("(?:CALL|PCALL|EXTCALL)"), _call_by_name),
    Spelling(_key("MCALL") + rf"(?=[ \t]*+[A-Z])[ \t]*+(?P<cycle>{_OWN_CYCLES}(?!\w))?.*+", _modal_call),
    Spelling(_key("MCALL"), lambda *_: [ModalCall()]),
    Spelling(_key("RET"), _return),
    Spelling(rf"(?P<cycle>CYCLE(?:95|62))[ \t]*+(?P<given>{IN_PARENTHESES})", _profile),
    Spelling(r"M0*+17(?![\w.=])", lambda *_: [Return()], stays=True),
    Spelling(PROGRAM_END, lambda *_: [ProgramEnd()], stays=True),
    Spelling(
        r"(?P<name>\$?(?:[A-Z_]{2}\w*+|[A-Z]\d*+))[ \t]*+(?>(?P<index>" + IN_BRACKETS + r")?)[ \t]*+=(?!=)[ \t]*+",
        _equals,
    ),
    Spelling(r"(?P<name>L\d++)(?![\w.])", _call),
    # A program of one letter, which no control admits: what stands alone with arguments can be nothing else.
    Spelling(rf"(?<![^ \t])(?P<name>[A-Z])(?=[ \t]*+{IN_PARENTHESES}[ \t]*+$)", _call_letter),
    Spelling(r"(?P<name>[A-Z_]{2}\w*+)(?![\[=])", _call),
)
_RESERVED = (
    "TO",
    "OF",
    "DEFAULT",
    "SAVE",
    "ENDLABEL",
    "AC",
    "IC",
    "DAC",
    "DIC",
    "RAC",
    "RIC",
    "DC",
    "ACP",
    "ACN",
    "REAL",
    "INT",
    "BOOL",
    "CHAR",
)
_FRAMES = ("CTRANS", "CFINE", "CROT", "CROTS", "CSCALE", "CMIRROR")
"""Functions that make a frame."""
_KINDS = ("STRING", "AXIS", "FRAME", "PROC", "BLOCK", "PRIO", "ASUP")
_ENDINGS = (".SPF", ".MPF", ".ARC", "", ".txt")


def _files(name: str) -> tuple[str, ...]:
    return (*(f"{name}{ending}" for ending in _ENDINGS), f"_N_{name}_SPF")


def _unknown(name: str) -> str:
    return f"{name}{MACHINES}" if name.startswith("$") else f"{name}{UNSET}"


_NAMES = r"R\d+|\$?[A-Z_]{2}\w*|\$?[A-Z_]\w*\[\d+(?:,\d+)*\]"
_DECLARED = r"[A-Z_]\w*"
"""DEF and PROC may give any name to a variable, also one letter, which is an address elsewhere."""


def sinumerik(names: Iterable[str]) -> MacroLanguage:
    """The statements of SINUMERIK. The names are those of words and commands: others call subprograms."""
    known = frozenset(name.upper() for name in (*names, *_RESERVED, *_KINDS, *_FRAMES))
    long = "|".join(sorted((re.escape(name) for name in known if len(name) > 1), key=len, reverse=True))
    form = LineForm(
        SINUMERIK,
        head=r"(?:%_N_(?P<program>\w+?)_(?:(?P<part>SPF)|[A-Z]{3})(?!\w))?[ \t\ufeff]*+(?>(?:/[0-9]?+)?)[ \t]*+"
        r"(?>(?:[N:][ \t]*+(?P<number>\d++)(?!\.))?)",
        # A line in braces is the head that a simulator writes.
        comment=r";.*+|\A[ \t\ufeff]*+\{.*+",
        table=_TABLE,
        skip=r"[ \t]++|\"[^\"]*+\"?+|[A-Z](?![A-Z_])[\d.]*+|[A-Z_$]\w*+|[\d.]++|.",
        behind_value="[A-Z_$]",
        says=rf"(?<![A-Z_])(?=[A-Z_]{{2}})(?!(?:{long})(?![A-Z_]|\d\w*+[ \t]*+=))"
        rf"|(?<![A-Z_\d]){SYNCHRONOUS}"
        r"|(?<![A-Z_])(?:DEF|PROC)[ \t]|(?<![A-Z_\d])[A-Z][ \t]*+\(|[A-Z_]\w++:(?!=)"
        r"|=[ \t]*+[-+]?+(?:[^-+.\d \t]|[\d.,]++[ \t]*+[-+*/])"
        r"|(?<![A-Z_])(?:[RL]\d|R[ \t]*+\[|MCALL(?![A-Z_])|M0*+(?:2|17|30)(?!\d|[ \t]*+=))|%_N_|\$",
        names=known,
    )
    return MacroLanguage(
        "sinumerik",
        form.may_say,
        form.read,
        _files,
        _unknown,
        variables=_NAMES,
        declared=_DECLARED,
        own_cycles=_OWN_CYCLES,
        examples="R100 or a name such as _ANG",
    )
