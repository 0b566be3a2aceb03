"""Writes expressions for a control, by the tables with which they are read."""

import re
from collections.abc import Callable, Mapping

from contoursolve.execution.evaluate import CONDITIONS, written
from contoursolve.execution.notation import FANUC, HAAS, ISG, KLARTEXT, LINUXCNC, SINUMERIK, Notation
from contoursolve.numeric import Apply, Constant, Indexed, Quoted, Term, Variable

NOTATIONS: Mapping[str, Notation] = {
    "fanuc": FANUC,
    "haas": HAAS,
    "linuxcnc": LINUXCNC,
    "sinumerik": SINUMERIK,
    "isg": ISG,
    "klartext": KLARTEXT,
}


class UnwritableTermError(ValueError):
    """A language has no way to say an expression."""


_DIGITS_OF_PI = 3.141592654
_MOST_FACTORS = 8


def _call(function: str) -> Callable[..., Term]:
    return lambda *arguments: Apply(function, arguments)


_ADD, _SUBTRACT, _MULTIPLY, _DIVIDE = _call("add"), _call("subtract"), _call("multiply"), _call("divide")
_TRUNCATE, _ROOT, _SIGN = _call("truncate"), _call("square_root"), _call("sign")


def _direction(y: Term, x: Term) -> Term:
    """The direction of x and y by an arccosine, which is negative below: SGN 0 counts as above."""
    above = _TRUNCATE(_DIVIDE(_ADD(_SIGN(y), Constant(2.0)), Constant(2.0)))
    side = _SUBTRACT(_MULTIPLY(Constant(2.0), above), Constant(1.0))
    return _MULTIPLY(_call("arccosine")(_DIVIDE(x, _call("length")(y, x))), side)


def _product(base: Term, exponent: Term) -> Term:
    if not isinstance(exponent, Constant) or exponent.value not in range(1, _MOST_FACTORS + 1):
        raise UnwritableTermError("a power")
    found = base
    for _ in range(1, int(exponent.value)):
        found = _MULTIPLY(found, base)
    return found


_LOGICAL = {"and": "bits_and", "or": "bits_or", "exclusive_or": "bits_exclusive_or"}
_COUNTERPARTS = _LOGICAL | {bits: logical for logical, bits in _LOGICAL.items()}
"""Of conditions, whose value is 0 or 1, both say the same."""


_INSTEAD: Mapping[str, Callable[..., Term]] = {
    "square": lambda a: _MULTIPLY(a, a),
    "length": lambda a, b: _ROOT(_ADD(_call("square")(a), _call("square")(b))),
    "arctangent": lambda a: Apply("arctangent2", (a, Constant(1.0))),
    "arctangent2": _direction,
    "modulo": lambda a, b: _SUBTRACT(a, _MULTIPLY(b, _TRUNCATE(_DIVIDE(a, b)))),
    "integer_divide": lambda a, b: _TRUNCATE(_DIVIDE(a, b)),
    "fraction": lambda a: _SUBTRACT(a, _TRUNCATE(a)),
    "pi": lambda: Constant(_DIGITS_OF_PI),
    "power": _product,
    "not": lambda a: Apply("equal", (a, Constant(0.0))),
}
"""Terms in the place of a function that a language lacks."""


def write_term(term: Term, target: str) -> str:
    """An expression as a control reads it: `fanuc`, `haas`, `linuxcnc`, `sinumerik`, `isg` or `klartext`.

    Raises UnwritableTermError for what the language cannot say. Variables are written by their names.
    """
    return _Writer(NOTATIONS[target]).write(term)


def write_in_full(term: Term, target: str) -> str:
    """The same with brackets about each operation in another one, as it is computed."""
    return re.sub(r"(?<=\d)\.(?!\d)", "", _FullWriter(NOTATIONS[target]).write(term))


def _is_condition(term: Term) -> bool:
    return isinstance(term, Apply) and (term.function in CONDITIONS or term.function in _COUNTERPARTS)


class _Writer:
    """Writes with one notation. How tightly a text binds counts from its loosest operators; what needs no brackets
    anywhere binds tightest."""

    def __init__(self, notation: Notation) -> None:
        self._notation = notation
        self._tightest = len(notation.operators) + 1
        # A sign stands where a sum may stand, and nowhere else: controls do not agree about 2 * -3 and -2 ** 2.
        self._sum = notation.signs["add"][1]

    def write(self, term: Term) -> str:
        return self._text(term)[0]

    def _operand(self, term: Term, level: int) -> str:
        """An expression in brackets, unless it binds as tightly as a level."""
        text, own = self._text(term)
        return text if own >= level else self._bracket(text)

    def _bracket(self, text: str) -> str:
        return f"{self._notation.brackets[0]}{text}{self._notation.brackets[1]}"

    def _text(self, term: Term) -> tuple[str, int]:
        match term:
            case Constant():
                text = written(term.value)
                text = text if self._notation.writes_point else text.removesuffix(".")
                return text, self._sum if text.startswith("-") else self._tightest
            case Quoted():
                return f'"{term.value}"', self._tightest
            case Variable():
                return term.name, self._tightest
            case Indexed():
                if self._notation is KLARTEXT:
                    raise self._lacks("variables whose number is computed")
                return f"{term.prefix}[{','.join(map(self.write, term.indices))}]{term.suffix}", self._tightest
        return self._applied(term)

    def _applied(self, term: Apply) -> tuple[str, int]:
        notation, function = self._notation, term.function
        other = _COUNTERPARTS.get(function, "")
        if other in notation.signs and function not in notation.signs and all(map(_is_condition, term.arguments)):
            function = other
        if function == "negate":
            return f"-{self._operand(term.arguments[0], self._tightest)}", self._sum
        if function in notation.signs and function not in notation.names and not self._is_apart(function):
            sign, level = notation.signs[function]
            # From the left, but comparisons and powers: those have no other one beside them.
            first = level + 1 if function in (*CONDITIONS[:6], "power") else level
            blank = " " if sign[-1].isalpha() or not notation.functions_need_brackets else ""
            operands = map(self._operand, term.arguments, (first, level + 1))
            return f"{blank}{sign}{blank}".join(operands), level
        if function == "not" and notation.inverts:
            return f"{notation.inverts} {self._operand(term.arguments[0], self._tightest)}", self._tightest - 1
        if function == "arctangent2" and notation.has_quotient_of_arctangent:
            quotient = "/".join(self._bracket(self.write(each)) for each in term.arguments)
            return f"ATAN{quotient}", self._tightest - 1
        if function == "pi" and "PI" in notation.fields:
            return "$PI" if notation is SINUMERIK else "PI", self._tightest
        if function not in notation.names:
            return self._text(self._instead(term))
        name = notation.names[function]
        if notation.functions_need_brackets:
            return f"{name}{self._bracket(','.join(map(self.write, term.arguments)))}", self._tightest
        return f"{name} {self._operand(term.arguments[0], self._tightest)}", self._tightest - 1

    def _is_apart(self, function: str) -> bool:
        """Whether an operation stands in statements of its own alone: FN 8 and FN 13."""
        return self._notation is KLARTEXT and function in self._notation.operators[0].values()

    def _instead(self, term: Apply) -> Term:
        try:
            return _INSTEAD[term.function](*term.arguments)
        except KeyError:
            raise self._lacks(term.function.replace("_", " ")) from None
        except UnwritableTermError as error:
            raise self._lacks(str(error)) from None

    def _lacks(self, what: str) -> UnwritableTermError:
        return UnwritableTermError(f"{self._notation.name} has no {what}")


class _FullWriter(_Writer):
    """Writes each operation in another one in brackets."""

    def _operand(self, term: Term, level: int) -> str:
        return super()._operand(term, self._tightest if isinstance(term, Apply) else level)
