"""Reads expressions with Lark, by the table of their language. Importing it takes a tenth of a second."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache

from lark import Lark, Token, Transformer, v_args
from lark.exceptions import UnexpectedInput

from contoursolve.execution.evaluate import ARGUMENTS, name_of_indexed
from contoursolve.execution.notation import Notation, UnreadableTermError, compiled
from contoursolve.numeric import Apply, Constant, Indexed, Quoted, Term, Variable

LONGEST_TERM = 250
"""Signs of an expression; a longer one is not read."""


def _choice(words: Iterable[str]) -> str:
    """A pattern for some words or signs; no letter stands behind a word."""
    ends = ((re.escape(word) + r"(?![A-Z_])" * word[-1].isalpha()) for word in sorted(words, key=len, reverse=True))
    return f"({'|'.join(ends)})".replace("/", r"\/")


def _grammar(notation: Notation) -> str:
    """Lark's grammar of a notation: a rule for each row of its operators, the loosest first."""
    rules = ["?term: level0", "?value: SIGN value -> sign | primary"]
    for place, row in enumerate(notation.operators):
        # A comparison has no other one beside it, but where comparisons come last.
        left = place + 1 if "equal" in row.values() and not notation.compares_last else place
        rules += (
            f"?level{place}: level{place + 1} | level{left} OPERATOR{place} level{place + 1} -> operation",
            f"OPERATOR{place}.2: /{_choice(row)}/",
        )
    signed, raised = "SIGN signed -> sign | raised", "primary"
    if notation.inverts:
        signed += " | INVERT signed -> call"
        rules.append(f"INVERT.4: /{_choice([notation.inverts])}/")
    if not notation.functions_need_brackets:
        signed += " | FUNCTION signed -> call"
    if notation.power:
        raised += " | primary POWER signed -> operation"
        rules.append(f"POWER.3: /{re.escape(notation.power)}/")
    opening, closing = map(re.escape, notation.brackets)
    return "\n".join(
        (
            *rules,
            f"?level{len(notation.operators)}: signed",
            f"?signed: {signed}",
            f"?raised: {raised}",
            "?primary: NUMBER -> number | TEXT -> text | OPEN term CLOSE -> bracket | atom",
            'arguments: term ("," term)*',
            f"OPEN: /{opening}/",
            f"CLOSE: /{closing}/",
            "SIGN: /[+-]/",
            f"NUMBER: /{notation.number}/",
            'TEXT: /"[^"]*"/',
            "BLANK: /[ \t]+/",
            "%ignore BLANK",
            notation.fields.replace("@FUNCTIONS@", _choice(notation.functions)),
        )
    )


_CONSTANTS: Mapping[str, Term] = {"TRUE": Constant(1.0), "FALSE": Constant(0.0)}


def apply(function: str, arguments: Sequence[Term]) -> Term:
    """A function of so many arguments as it takes; a negative number is a constant."""
    if ARGUMENTS[function] != len(arguments):
        raise UnreadableTermError(function)
    if function == "negate" and isinstance(arguments[0], Constant):
        return Constant(-arguments[0].value)
    return Apply(function, tuple(arguments))


def indexed(prefix: str, indices: Sequence[Term], suffix: str = "") -> Variable | Indexed:
    """A variable by its number; by its name, if that is a number as it stands."""
    numbers = [each.value for each in indices if isinstance(each, Constant)]
    name = name_of_indexed(prefix, numbers, suffix) if len(numbers) == len(indices) else None
    return Variable(name) if isinstance(name, str) else Indexed(prefix, tuple(indices), suffix)


_R_NUMBER = re.compile(r"\A(?:\$?R0*(?=\d+\Z)|\$R\[[ \t]*0*(?=\d+[ \t]*\]\Z))")
"""R01 is R1: printed, SINUMERIK fundamentals 11/2006 p. 62. $R1 and $R[1] are recalled."""


@v_args(inline=True)
class _Builder(Transformer):  # type: ignore[type-arg]
    """Makes expressions of what Lark finds; a method for each rule."""

    def __init__(self, meanings: Mapping[str, str]) -> None:
        super().__init__()
        self._meanings = meanings

    def number(self, text: str) -> Term:
        digits = text.upper().replace(",", ".").replace("X", "")
        return Constant(float(digits))

    def text(self, text: str) -> Term:
        return Quoted(text[1:-1])

    def variable(self, name: str) -> Term:
        name = "".join(name.upper().split())
        return Variable(_R_NUMBER.sub("R", name).rstrip("]") if name.startswith("$R[") else _R_NUMBER.sub("R", name))

    def constant(self, name: str) -> Term:
        return _CONSTANTS.get(name.upper()) or Apply("pi", ())

    def bracket(self, _: str, term: Term, __: str) -> Term:
        return term

    def sign(self, sign: str, term: Term) -> Term:
        return term if sign == "+" else apply("negate", [term])

    def operation(self, left: Term, sign: str, right: Term) -> Term:
        return apply(self._meanings[sign.upper()], [left, right])

    def arguments(self, *terms: Term) -> tuple[Term, ...]:
        return terms

    def call(self, name: str, *rest: Term | str | tuple[Term, ...]) -> Term:
        arguments = next((each for each in rest if isinstance(each, tuple)), None)
        return apply(self._meanings[name.upper()], arguments or [each for each in rest if isinstance(each, Term)])

    def arctangent(self, _: str, __: str, given: tuple[Term, ...], *over: Term | str) -> Term:
        terms = [*given, *(each for each in over if isinstance(each, Term))]
        return apply("arctangent" if len(terms) == 1 else "arctangent2", terms)

    def numbered(self, _: str, number: Term) -> Term:
        return indexed("#", [number])

    def indexed(self, prefix: str, _: str, indices: tuple[Term, ...], __: str, suffix: str = "") -> Term:
        return indexed(prefix.upper(), indices, suffix.upper())


@cache
def _parser(notation: Notation) -> Lark:
    return Lark(
        _grammar(notation),
        parser="lalr",
        start=["term", "value"],
        transformer=_Builder(notation.meanings),
        g_regex_flags=re.IGNORECASE | re.ASCII,
        maybe_placeholders=False,
    )


@cache
def _usual(notation: Notation, *, is_value: bool) -> re.Pattern[str]:
    """A number or a variable, or two with a sign between them, behind which no expression goes on; or of a value the
    first alone."""
    one = rf"[ \t]*+([+-]?+)[ \t]*+(?:(\d++\.?+\d*+|\.\d++)|({notation.variable}))"
    if is_value:
        return compiled(rf"{one}(?(3)|(?![\w.,]))")
    return compiled(rf"{one}(?>(?:[ \t]*+([-+*/]){one})?)(?=[ \t]*+(?:\Z|[;)\]]))")


def _operand(sign: str, number: str | None, name: str) -> Term:
    """A number or a variable with its sign."""
    term = Variable(_R_NUMBER.sub("R", name.upper())) if number is None else Constant(float(number))
    return apply("negate", [term]) if sign == "-" else term


def read_term(notation: Notation, text: str, begin: int = 0, *, is_value: bool = False) -> tuple[Term, int]:
    """The longest expression that begins there, and where it ends; with `is_value`, no sum without brackets.

    Raises UnreadableTermError where none begins, and for one that is too long.
    """
    found = _usual(notation, is_value=is_value).match(text, begin)
    if found is not None:
        # Most need no grammar.
        term = _operand(*found.group(1, 2, 3))
        if not is_value and found[4]:
            term = apply(notation.meanings[found[4]], [term, _operand(*found.group(5, 6, 7))])
        return term, found.end()
    parser, start = _parser(notation), "value" if is_value else "term"
    reader = parser.parse_interactive(text[begin:], start)
    tokens: Iterator[Token] = reader.lexer_thread.lex(reader.parser_state)  # type: ignore[no-untyped-call]
    end, is_refused = 0, False
    try:
        for count, token in enumerate(tokens):
            if count > LONGEST_TERM:
                raise UnreadableTermError("it is too long")
            is_refused = True
            reader.feed_token(token)
            end, is_refused = token.end_pos or 0, False
    except UnexpectedInput:
        pass  # what follows belongs to no expression
    try:
        # A token that is refused may have closed what it cannot follow.
        term: Term = parser.parse(text[begin : begin + end], start) if is_refused else reader.feed_eof()  # type: ignore
    except UnexpectedInput:
        raise UnreadableTermError(text[begin:]) from None
    return term, begin + end
