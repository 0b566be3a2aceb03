"""The value of a formula of numbers and known Q parameters."""

import re
from collections.abc import Callable, Iterator, Mapping
from decimal import Decimal
from math import acos, asin, atan, cos, degrees, exp, isfinite, log, pi, radians, sin, sqrt, tan

_TOKEN = re.compile(
    r"\s*(?:(?P<number>\d+(?:[.,]\d*)?|[.,]\d+)|(?P<name>[A-Z]+\d*)|(?P<sign>[-+*/^()]))", re.IGNORECASE
)
_FUNCTIONS: Mapping[str, Callable[[float], float]] = {
    "SIN": lambda x: sin(radians(x)),
    "COS": lambda x: cos(radians(x)),
    "TAN": lambda x: tan(radians(x)),
    "ASIN": lambda x: degrees(asin(x)),
    "ACOS": lambda x: degrees(acos(x)),
    "ATAN": lambda x: degrees(atan(x)),
    "SQRT": sqrt,
    "SQ": lambda x: x * x,
    "ABS": abs,
    "INT": lambda x: float(int(x)),
    "NEG": lambda x: -x,
    "LN": log,
    "EXP": exp,
}


def evaluate(formula: str, values: Mapping[str, Decimal]) -> Decimal | None:
    """The value of a formula, angles in degrees; None if it cannot be read, or rests on what is not known."""
    try:
        reader = _Reader(list(_tokens(formula)), values)
        value = reader.sum()
        if reader.tokens or not isfinite(value):
            return None
    except (ValueError, LookupError, ArithmeticError, TypeError):  # the root of a negative number is complex
        return None
    return Decimal(repr(value))


def _tokens(formula: str) -> Iterator[str]:
    at, text = 0, formula.strip()
    while at < len(text):
        token = _TOKEN.match(text, at)
        if token is None:
            raise ValueError(text[at:])
        yield token[token.lastgroup or 0].upper().replace(",", ".")
        at = token.end()


class _Reader:
    """Reads tokens from the left; powers bind most, then products, then sums."""

    def __init__(self, tokens: list[str], values: Mapping[str, Decimal]) -> None:
        self.tokens, self.values = tokens, values

    def _accept(self, signs: str) -> str:
        return self.tokens.pop(0) if self.tokens and self.tokens[0] in list(signs) else ""

    def sum(self) -> float:
        value = self._product()
        while sign := self._accept("+-"):
            value = value + self._product() if sign == "+" else value - self._product()
        return value

    def _product(self) -> float:
        value = self._signed()
        while sign := self._accept("*/"):
            value = value * self._signed() if sign == "*" else value / self._signed()
        return value

    def _signed(self) -> float:
        if sign := self._accept("+-"):
            return -self._signed() if sign == "-" else self._signed()
        return self._power()

    def _power(self) -> float:
        value = self._value()
        if self._accept("^"):
            return float(value ** self._signed())
        return value

    def _value(self) -> float:
        if self._accept("("):
            value = self.sum()
            if not self._accept(")"):
                raise ValueError(")")
            return value
        token = self.tokens.pop(0)
        if token in _FUNCTIONS:
            return _FUNCTIONS[token](self._signed())
        if token == "PI":
            return pi
        return float(self.values[token]) if token in self.values else float(Decimal(token))
