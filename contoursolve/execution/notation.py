"""Spelling of expressions in each language: one table each, by which they are read and written."""

import re
from collections.abc import Mapping
from functools import cache, cached_property

from msgspec import Struct
from msgspec.structs import replace


@cache
def compiled(pattern: str) -> re.Pattern[str]:
    """A pattern for letters of both cases, compiled when it is first needed."""
    return re.compile(pattern, re.IGNORECASE | re.ASCII)


class Notation(Struct, frozen=True, eq=False, dict=True):
    """Spelling of a language's expressions.

    `operators` are by how tightly they bind, the loosest first. Where several names mean the same, the first is
    written. `fields` is what its grammar says of variables and of functions.
    """

    name: str
    operators: tuple[Mapping[str, str], ...]
    functions: Mapping[str, str]
    fields: str
    variable: str = r"#\d++"
    """A pattern of variables by their number."""
    brackets: str = "[]"
    number: str = r"\d+\.?\d*|\.\d+"
    power: str = ""
    """The sign of a power."""
    inverts: str = ""
    """Name of the operator that inverts a condition."""
    functions_need_brackets: bool = True
    compares_last: bool = False
    """Whether comparisons bind least, so that one may be compared with another."""
    has_quotient_of_arctangent: bool = False
    """Whether `ATAN[y]/[x]` is the direction of x and y."""
    writes_point: bool = True
    """Whether whole numbers are written with a point."""

    @cached_property
    def signs(self) -> Mapping[str, tuple[str, int]]:
        """The sign of each operation, and how tightly it binds."""
        rows = [(meaning, (sign, level)) for level, row in enumerate(self.operators) for sign, meaning in row.items()]
        return dict(reversed(rows)) | ({"power": (self.power, len(self.operators))} if self.power else {})

    @cached_property
    def meanings(self) -> Mapping[str, str]:
        """The meaning of each sign and name."""
        rows = (*self.operators, self.functions, {self.power: "power", self.inverts: "not"})
        return {sign: meaning for row in rows for sign, meaning in row.items()}

    @cached_property
    def names(self) -> Mapping[str, str]:
        """The name of each function."""
        return {meaning: name for name, meaning in reversed([*self.functions.items()])}


_ADDITIVE = {"+": "add", "-": "subtract"}
_MULTIPLICATIVE = {"*": "multiply", "/": "divide"}
_SIGNS = {
    "==": "equal",
    "<>": "unequal",
    ">=": "at_least",
    "<=": "at_most",
    ">": "greater",
    "<": "less",
}
_LETTERS = {
    "EQ": "equal",
    "NE": "unequal",
    "GT": "greater",
    "GE": "at_least",
    "LT": "less",
    "LE": "at_most",
}
_ARCS = {"SIN": "sine", "COS": "cosine", "TAN": "tangent", "ASIN": "arcsine", "ACOS": "arccosine"}
_USUAL = {**_ARCS, "SQRT": "square_root", "ABS": "absolute", "LN": "logarithm", "EXP": "exponential"}

_HASH = r"""
    VARIABLE.2: /#\s*(\d+|<[^<>]*>)/
    HASH: /#(?=\s*[#\[])/
    FUNCTION.3: /@FUNCTIONS@(?=\s*\[)/
    ARCTANGENT.4: /ATAN(?=\s*\[)/
    OVER.3: /\/\s*\[/
    ?atom: VARIABLE -> variable | numbered | FUNCTION OPEN arguments CLOSE -> call
        | ARCTANGENT OPEN arguments CLOSE (OVER term CLOSE)? -> arctangent
    numbered: HASH number
    ?number: VARIABLE -> variable | numbered | OPEN term CLOSE -> bracket
"""
FANUC = Notation(
    "Fanuc",
    operators=(
        _LETTERS,
        {**_ADDITIVE, "OR": "bits_or", "XOR": "bits_exclusive_or"},
        {**_MULTIPLICATIVE, "AND": "bits_and", "MOD": "modulo"},
    ),
    functions={
        **_USUAL,
        "SQR": "square_root",
        "ATAN": "arctangent",
        "ROUND": "round",
        "RND": "round",
        "FIX": "truncate",
        "FUP": "round_away",
        "POW": "power",
    },
    fields=_HASH,
    power="**",
    has_quotient_of_arctangent=True,
)
HAAS = replace(
    FANUC, name="Haas", functions={name: meaning for name, meaning in FANUC.functions.items() if name != "POW"}
)
LINUXCNC = Notation(
    "LinuxCNC",
    operators=(
        {"AND": "and", "OR": "or", "XOR": "exclusive_or"},
        _LETTERS,
        _ADDITIVE,
        _MULTIPLICATIVE,
    ),
    functions={**_USUAL, "ROUND": "round", "FIX": "floor", "FUP": "ceiling"},
    fields=_HASH,
    power="**",
    has_quotient_of_arctangent=True,
)
SINUMERIK = Notation(
    "SINUMERIK",
    # As the manual prints it: comparisons bind loosest.
    operators=(
        _SIGNS,
        {"OR": "or"},
        {"XOR": "exclusive_or"},
        {"AND": "and"},
        {"B_OR": "bits_or"},
        {"B_XOR": "bits_exclusive_or"},
        {"B_AND": "bits_and"},
        _ADDITIVE,
        {**_MULTIPLICATIVE, "DIV": "integer_divide", "MOD": "modulo"},
    ),
    functions={
        **_USUAL,
        "ATAN2": "arctangent2",
        "POT": "square",
        "TRUNC": "truncate",
        "ROUND": "round",
        "ROUNDUP": "round_away",
        "MINVAL": "minimum",
        "MAXVAL": "maximum",
    },
    fields=r"""
    SYSTEM.4: /\$[A-Z_]\w*(\[[^\[\]]*\])?/
    CONSTANT.5: /(TRUE|FALSE|\$PI)\b/
    NAME: /[A-Z_]{2}\w*|[A-Z_]\d*/
    LEFT: "["
    RIGHT: "]"
    FUNCTION.3: /@FUNCTIONS@(?=\s*\()/
    ?atom: NAME -> variable | NAME LEFT arguments RIGHT -> indexed | SYSTEM -> variable | CONSTANT -> constant
        | FUNCTION OPEN arguments CLOSE -> call
    """,
    variable=r"R\d++(?![\w.\[])",
    brackets="()",
    number=r"(\d+\.?\d*|\.\d+)(EX[+-]?\d+)?",
    inverts="NOT",
    compares_last=True,
)
ISG = Notation(
    "ISG",
    variable=r"P\d++(?![\w.\[])",
    operators=(
        {"OR": "or", "||": "or"},
        {"XOR": "exclusive_or"},
        {"AND": "and", "&&": "and"},
        {**_SIGNS, "!=": "unequal"},
        _ADDITIVE,
        {**_MULTIPLICATIVE, "MOD": "modulo"},
    ),
    power="**",
    functions={
        **_USUAL,
        "ATAN": "arctangent",
        "ATAN2": "arctangent2",
        "SQR": "square",
        "INT": "truncate",
        "FRACT": "fraction",
        "ROUND": "round",
        "MIN": "minimum",
        "MAX": "maximum",
        "NOT": "not",
    },
    fields=r"""
    VARIABLE.4: /P\s*\d+|V\.[A-Z]+\.[A-Z_][\w.]*(?![\w.]|\s*\[)/
    FIELD.3: /(P|V\.[A-Z]+\.[A-Z_][\w.]*)(?=\s*\[)/
    SUFFIX: /\.[A-Z_][\w.]*/
    CONSTANT.4: /(TRUE|FALSE|PI)\b/
    FUNCTION.3: /@FUNCTIONS@(?=\s*\[)/
    ?atom: VARIABLE -> variable | FIELD OPEN arguments CLOSE SUFFIX? -> indexed | CONSTANT -> constant
        | FUNCTION OPEN arguments CLOSE -> call
    """,
)
KLARTEXT = Notation(
    "Klartext",
    # LEN and ANG stand in FN 8 and FN 13 alone.
    operators=({"LEN": "length", "ANG": "arctangent2"}, _ADDITIVE, {**_MULTIPLICATIVE, "DIV": "divide"}),
    power="^",
    functions={
        **_USUAL,
        "ATAN": "arctangent",
        "SQ": "square",
        "INT": "truncate",
        "FRAC": "fraction",
        "NEG": "negate",
        "SGN": "sign",
    },
    fields=r"""
    VARIABLE.4: /Q[LRS]?\d+/
    CONSTANT.4: /PI(?![A-Z])/
    FUNCTION.3: /@FUNCTIONS@(?![A-Z])/
    ?atom: VARIABLE -> variable | CONSTANT -> constant
    """,
    variable=r"Q[LRS]?+\d++(?![\w.,])",
    brackets="()",
    number=r"\d+([.,]\d*)?|[.,]\d+",
    functions_need_brackets=False,
    writes_point=False,
)


class UnreadableTermError(ValueError):
    """The text is no expression."""
