"""Statements of a program besides words with numbers: variables, jumps, loops and calls, for every control."""

import re
from collections.abc import Callable, Mapping
from enum import Enum
from typing import Any

from msgspec import Struct

from contoursolve.numeric import Constant, Indexed, Term, Variable

UNSET = " is set by nothing before"
"""Reason why a variable of the user has no value."""

MACHINES = " is the machine's"
"""Reason why a variable that only the machine knows has no value."""

ARGUMENT = " is an argument of "
"""Reason why a variable that each call gives has no value."""


class Unknown(Struct, frozen=True):
    """No value, and why: `#5041 is the machine's position`."""

    reason: str


class Vacant(Struct, frozen=True):
    """The value of a variable that is empty: `#0`, and what a call of a macro does not give. A word with it is left
    out, a variable that gets it is empty too, and in a formula it is 0; of comparisons, EQ and NE alone tell it from
    0. Printed of Fanuc, assumed of its kin."""


VACANT = Vacant()
Known = float | str | Unknown | Vacant
"""Value of a variable."""


class WordFormula(Struct, frozen=True):
    """A word of a line whose value is an expression: the place of the value in the line, counted from 0, and of the
    value alone (`#100` in `X#100`, `[#1+2.]` in `X[#1+2.]`, `-_ANG` in `ANG=-_ANG`)."""

    begin: int
    end: int
    value: Term

    def put(self, number: str, line: str) -> str:
        """The line with a number in the place of its value; what is behind it moves."""
        return line[: self.begin] + number + line[self.end :]


class VariableType(Enum):
    """Type of a variable that a program defines."""

    REAL = "REAL"
    INT = "INT"
    BOOL = "BOOL"
    CHAR = "CHAR"
    STRING = "STRING"
    AXIS = "AXIS"
    FRAME = "FRAME"


class VariableScope(Enum):
    """The levels at which a variable is known that no program defines by its type."""

    EVERYWHERE = "everywhere"
    LEVEL = "in one level of calls"
    """Each call has its own, empty unless it gives them: #1 to #33 of Fanuc."""
    NESTED = "in one level and in those that it calls"
    """V.L. of the ISG kernel."""


class FormalParameter(Struct, frozen=True):
    """A variable that a call sets by its place; one by reference is the caller's own under another name."""

    name: str
    of_type: VariableType = VariableType.REAL
    is_reference: bool = False
    has_default: bool = False
    """Whether it has a value of its own where a call leaves it out, instead of 0."""


class Assign(Struct, frozen=True, tag=True):
    """A variable gets a value; with a type, it is defined here: the program that runs has it for itself."""

    variable: Variable | Indexed
    value: Term
    of_type: VariableType | None = None


class Forget(Struct, frozen=True, tag=True):
    """A variable gets a value that the program does not say: `FN 18`, a result of probing; with a type, it is defined
    here."""

    variable: Variable | Indexed
    reason: str
    of_type: VariableType | None = None


class Definitions(Struct, frozen=True, tag=True):
    """Definitions begin or end: of one name in several levels, an assignment there means that of its own level."""

    begin: bool


SKIP_SWITCH = Variable("/")
"""Switch at the machine that decides if blocks with / run; no program reads it."""


LENGTH_INCREMENT, ANGLE_INCREMENT = Variable("@LENGTH"), Variable("@ANGLE")
"""The value of 1 in an argument without a decimal point counts, in the program's units; no program names them."""


class JumpWay(Enum):
    """Direction in which a jump looks for its label."""

    ANYWHERE = "anywhere"
    FORWARD = "forward"
    BACKWARD = "backward"


class Jump(Struct, frozen=True, tag=True):
    """Execution goes on at a label or a block number, always or if a condition holds."""

    target: "Term | str"
    """A label as it is written, or an expression that is the block number."""
    condition: Term | None = None
    way: JumpWay = JumpWay.ANYWHERE


class CallKind(Enum):
    """Target of a call."""

    PROGRAM = "program"
    """A subprogram by its number or name, in the same file or in one of its own: M98 P, `L10`, `NAME`, CALL PGM."""
    LINES = "lines"
    """From a block number of the same program to the end of the subprogram: M97 P."""
    LABEL = "label"
    """A section from a label to its end: CALL LBL; or from a label to another: REPEAT A B."""
    SECTION = "section"
    """From a label to the block before the call itself: CALL LBL REP, REPEAT A."""
    PROFILE = "profile"
    """The profile of a cycle: G71 P Q, CYCLE95, CYCL DEF 14."""


class Call(Struct, frozen=True, tag=True):
    """Other lines run, so many times, and then what is behind the call."""

    kind: CallKind
    target: "Term | str"
    """The number, or the name in upper case."""
    last: "Term | str | None" = None
    """The last block of a section or of a profile, where it is named."""
    count: Term = Constant(1.0)
    arguments: tuple[tuple[str, Term], ...] = ()
    """Variables of the subprogram that the call sets, by name: G65 P100 A5. sets `#1`."""
    counted: str = ""
    """The letters of arguments without a decimal point, which count least increments of their address."""
    is_local: bool = False
    """Whether the subprogram has local variables of its own: G65, a call of SINUMERIK."""
    cycle: str = ""
    """The cycle that runs a profile: `G71`."""


class Return(Struct, frozen=True, tag=True):
    """The subprogram ends: M99, M17, RET, LBL 0; `to` is the block number behind M99 P. In a main program, M99 begins
    it again."""

    to: Term | None = None


class ProgramEnd(Struct, frozen=True, tag=True):
    """The program ends: M2, M30."""


class If(Struct, frozen=True, tag=True):
    """Run the lines up to Else, ElseIf or EndIf if a condition holds."""

    condition: Term


class ElseIf(Struct, frozen=True, tag=True):
    """As If, where no condition before it held."""

    condition: Term


class Else(Struct, frozen=True, tag=True):
    """Run the next lines if no condition before them held."""


class EndIf(Struct, frozen=True, tag=True):
    """The end of what If began."""


class Loop(Struct, frozen=True, tag=True):
    """Run the lines up to its EndLoop of the same name while a condition holds; without one, for ever."""

    name: str = ""
    condition: Term | None = None


class For(Struct, frozen=True, tag=True):
    """Run the lines up to EndLoop with a variable that counts from `first` to `last`."""

    variable: Variable | Indexed
    first: Term
    last: Term
    step: Term = Constant(1.0)
    name: str = ""


class EndLoop(Struct, frozen=True, tag=True):
    """The end of a loop; with a condition (`UNTIL`), it ends where that holds."""

    name: str = ""
    until: Term | None = None


class When(Struct, frozen=True, tag=True):
    """Other statements of the same line run if a condition holds: `IF [#1 GT 0] THEN #2=5`."""

    condition: Term
    then: tuple["MacroStatement", ...]
    has_words: bool = False
    """Whether the words of the line run only then: `IF [#1 GT 0] THEN G01 X5.`"""


class Strange(Struct, frozen=True, tag=True):
    """A statement that cannot be followed, and why; what it may change is not known behind it. `unread` is the word of
    the control that is not read, where it is one."""

    reason: str
    unread: str = ""
    jumps: bool = False
    """Whether it jumps, so that any block with a number or a label may follow."""
    is_beside: bool = False
    """Whether it runs beside the program, and moves an axis."""


class Refused(Struct, frozen=True, tag=True):
    """A statement that the control refuses with an alarm, and why; what follows is read as if it went on."""

    told: str


class ReadAs(Struct, frozen=True, tag=True):
    """A condition that is read otherwise than it seems, and how."""

    told: str


class ModalCall(Struct, frozen=True, tag=True):
    """A call behind each move from here on, which is not followed, and why; without a reason, it ends."""

    reason: str = ""
    name: str = ""
    """The word of the control that makes it."""
    keeps_modes: bool = False
    """Whether it leaves the modes as they were."""
    counted: str = ""
    """The letters of arguments without a decimal point, as of a call."""


MacroStatement = (
    Assign
    | Forget
    | Definitions
    | Jump
    | Call
    | Return
    | ProgramEnd
    | If
    | ElseIf
    | Else
    | EndIf
    | Loop
    | For
    | EndLoop
    | When
    | Strange
    | Refused
    | ReadAs
    | ModalCall
)


class CodeLine(Struct, frozen=True):
    """Statements of one line besides its words.

    `rest` is the line with statements blanked out, each character of them a blank, so that columns stay: `G0 X40. M98
    P100` leaves `G0 X40.`. Values of `words` stand in it still.
    """

    rest: str
    number: str = ""
    """Its block number without leading zeros, by which jumps and cycles name it."""
    labels: tuple[str, ...] = ()
    """Names by which it is called, in upper case: `LBL 1` is `1`, `LBL "A"` is `A`, SINUMERIK's `MARK:` is `MARK`."""
    begins: str | None = None
    """The program that begins with it: `O0100` is `100`, `%_N_L10_SPF` is `L10`, `BEGIN PGM A` is `A`."""
    is_part: bool = False
    """Whether that is a subprogram by its first line: `%_N_L10_SPF`, `%L SUB`, PROC."""
    statements: tuple[MacroStatement, ...] = ()
    words: tuple[WordFormula, ...] = ()
    parameters: tuple[FormalParameter, ...] = ()
    """The variables that a call's arguments set, in order: PROC NAME(REAL A, VAR INT B)."""
    saves: bool = False
    """Whether the modes at a call are in force again where the subprogram ends: PROC NAME SAVE."""
    unit: str = ""
    """The unit of the program that begins with it, where its head states that: BEGIN PGM NAME INCH."""


class MacroLanguage(Struct, frozen=True, eq=False):
    """The statements of a control, its variables, calls and jumps."""

    name: str
    may_say: Callable[[str], bool]
    """Quick test that a line may have more than words with numbers; it is run on every line of every program."""
    read: Callable[[str], CodeLine]
    """Read the statements of a line. Never raises: an unreadable statement is Strange."""
    files: Callable[[str], tuple[str, ...]]
    """The names of files in which a subprogram may be, without folder: 100 is in `O0100.nc`, `O100`, `0100.NC`, ..."""
    unknown: Callable[[str], str]
    """The reason why a variable that nothing set has no value: `#5041 is the machine's position`, `#100 is set by
    nothing before`."""
    jumps_to_numbers: bool = True
    """Whether a jump names a block number; Klartext knows labels alone."""
    declares: bool = False
    """Whether variables with names have to be declared: SINUMERIK's DEF."""
    variables: str = ""
    """Pattern of variables' names, in upper case; any name if it is empty."""
    declared: str = ""
    """Pattern of further names that a program may declare; none if it is empty."""
    examples: str = ""
    """Names of variables, for a reader: the first one has a number."""
    moving: str = ""
    """Pattern of variables of the machine whose values move the coordinate system; none if it is empty."""
    always_empty: str = ""
    """The variable that is always empty, where variables may be: `#0`."""
    passes_return: bool = False
    """Whether the end of a subprogram does nothing where none was called: LBL 0."""
    scope: Callable[[str], VariableScope] = lambda _: VariableScope.EVERYWHERE
    """The levels at which a variable is known that no program defines by its type."""
    shows_main: bool = True
    """Whether subprograms know what the main program defines."""
    own_cycles: str = ""
    """Pattern of names of the maker's own cycles, which leave the modes as they were; none if it is empty."""
    with_names: "Callable[[tuple[str, ...]], MacroLanguage] | None" = None
    """The same where some more names are those of commands, which call no subprogram; None where a name calls none."""
    made_by: Callable[[], "MacroLanguage"] | None = None
    """The function that makes it, by whose name it is sent to another process."""

    def may_move(self, name: str) -> bool:
        """Whether a variable of this name moves the coordinate system; any may be one whose index is not known, which
        has no name."""
        return bool(self.moving) and (not name or re.fullmatch(self.moving, name) is not None)

    def value_of(self, name: str, values: Mapping[str, Known]) -> Known:
        """The value of a variable by its name, given those of others."""
        if name == self.always_empty:
            return VACANT
        found = values.get(name)
        return found if found is not None else Unknown(self.unknown(name))

    def __reduce__(self) -> Any:
        return self.made_by, ()
