"""The value of an expression, for every control alike: what is not known stays so, with its reason."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from decimal import Decimal

from contoursolve.execution.macro_language import VACANT, Known, Unknown, Vacant
from contoursolve.numeric import Apply, Constant, Indexed, Quoted, Term, Variable

_NEAR = 1e-12
"""Numbers that differ less, as a part of the larger, are equal: SINUMERIK's manual prints it for comparisons and TRUNC,
assumed for the others. Without it, ten times 0.1 is less than 1."""
_DECIMALS = 9
_LARGEST_BITS = 2.0**53
"""Up to there, every whole number is a float."""


def _snap(number: float) -> float:
    """The whole number that it almost is, or the number itself."""
    whole = float(round(number))
    return whole if abs(number - whole) <= _NEAR * abs(number) else number


def _is_equal(first: float, second: float) -> bool:
    return first == second or abs(first - second) <= _NEAR * max(abs(first), abs(second))


_TURN, _QUARTER = 360.0, 90.0


def _trigonometric(function: Callable[[float], float]) -> Callable[[float], float]:
    """A function of an angle in degrees; exact at right angles."""

    def compute(angle: float) -> float:
        turned = math.fmod(angle, _TURN)
        value = function(math.radians(turned))
        return float(round(value)) if math.fmod(turned, _QUARTER) == 0 else value

    return compute


def _tangent(angle: float) -> float:
    if math.fmod(angle, 2 * _QUARTER) in (_QUARTER, -_QUARTER):
        raise ValueError
    return _trigonometric(math.tan)(angle)


def _bits(combine: Callable[[int, int], int]) -> Callable[[float, float], float]:
    def compute(first: float, second: float) -> float:
        if max(abs(first), abs(second)) > _LARGEST_BITS:
            raise OverflowError
        return float(combine(round(first), round(second)))

    return compute


def _power(base: float, exponent: float) -> float:
    return math.pow(base, exponent) if base or exponent >= 0 else 1 / base


def _round(number: float) -> float:
    """The nearest whole number; from the middle, the one farther from 0."""
    return float(math.floor(_snap(abs(number) + 0.5))) * (-1 if number < 0 else 1)


FUNCTIONS: Mapping[str, Callable[..., float]] = {
    "add": lambda a, b: a + b,
    "subtract": lambda a, b: a - b,
    "multiply": lambda a, b: a * b,
    "divide": lambda a, b: a / b,
    "integer_divide": lambda a, b: float(math.trunc(_snap(a / b))),
    "modulo": lambda a, b: a - b * math.trunc(_snap(a / b)),
    "power": _power,
    "negate": lambda a: -a,
    "sine": _trigonometric(math.sin),
    "cosine": _trigonometric(math.cos),
    "tangent": _tangent,
    "arcsine": lambda a: math.degrees(math.asin(_snap(a))),
    "arccosine": lambda a: math.degrees(math.acos(_snap(a))),
    "arctangent": lambda a: math.degrees(math.atan(a)),
    "arctangent2": lambda y, x: math.degrees(math.atan2(y, x)),
    "length": math.hypot,
    "square_root": math.sqrt,
    "square": lambda a: a * a,
    "absolute": abs,
    "sign": lambda a: float((a > 0) - (a < 0)),
    "round": _round,
    "truncate": lambda a: float(math.trunc(_snap(a))),
    "round_away": lambda a: float(math.ceil(_snap(abs(a)))) * (-1 if a < 0 else 1),
    "fraction": lambda a: a - math.trunc(_snap(a)),
    "floor": lambda a: float(math.floor(_snap(a))),
    "ceiling": lambda a: float(math.ceil(_snap(a))),
    "logarithm": math.log,
    "exponential": math.exp,
    "minimum": min,
    "maximum": max,
    "pi": lambda: math.pi,
    "equal": _is_equal,
    "unequal": lambda a, b: not _is_equal(a, b),
    "greater": lambda a, b: a > b and not _is_equal(a, b),
    "at_least": lambda a, b: a > b or _is_equal(a, b),
    "less": lambda a, b: a < b and not _is_equal(a, b),
    "at_most": lambda a, b: a < b or _is_equal(a, b),
    "and": lambda a, b: a != 0 and b != 0,
    "or": lambda a, b: a != 0 or b != 0,
    "exclusive_or": lambda a, b: (a != 0) != (b != 0),
    "not": lambda a: a == 0,
    "bits_and": _bits(lambda a, b: a & b),
    "bits_or": _bits(lambda a, b: a | b),
    "bits_exclusive_or": _bits(lambda a, b: a ^ b),
}
"""Definitions of functions and operations, angles in degrees; a condition that holds is 1."""

_TWO = (
    "add",
    "subtract",
    "multiply",
    "divide",
    "integer_divide",
    "modulo",
    "power",
    "arctangent2",
    "length",
    "minimum",
    "maximum",
    "equal",
    "unequal",
    "greater",
    "at_least",
    "less",
    "at_most",
    "and",
    "or",
    "exclusive_or",
    "bits_and",
    "bits_or",
    "bits_exclusive_or",
)
ARGUMENTS = dict.fromkeys(FUNCTIONS, 1) | dict.fromkeys(_TWO, 2) | {"pi": 0}
"""Number of arguments of each."""
CONDITIONS = ("equal", "unequal", "greater", "at_least", "less", "at_most", "and", "or", "exclusive_or", "not")
"""Functions whose value is 0 or 1."""

_REASONS = {
    "square_root": "it takes the root of a negative number",
    "power": "it takes a power of a negative number that is not whole",
    "logarithm": "it takes the logarithm of a number that is not positive",
    "arcsine": "it takes the arcsine of a number beyond 1",
    "arccosine": "it takes the arccosine of a number beyond 1",
    "tangent": "it takes the tangent of a right angle",
}


def evaluate(term: Term, look_up: Callable[[str], Known]) -> Known:
    """The value of an expression. What is not known stays so for the first reason; so does what has no value."""
    match term:
        case Constant() | Quoted():
            return term.value
        case Variable():
            return look_up(term.name)
        case Indexed():
            name = name_of_indexed(term.prefix, [evaluate(each, look_up) for each in term.indices], term.suffix)
            return look_up(name) if isinstance(name, str) else name
    values = [evaluate(each, look_up) for each in term.arguments]
    return next((each for each in values if isinstance(each, Unknown)), None) or _apply(term.function, values)


def _apply(function: str, values: Sequence[Known]) -> Known:
    if VACANT in values and function in ("equal", "unequal"):
        return float((values[0] == values[1]) == (function == "equal"))
    values = [0.0 if isinstance(each, Vacant) else each for each in values]
    numbers = [each for each in values if isinstance(each, float)]
    if len(numbers) < len(values):
        if function in ("equal", "unequal") and not numbers:
            return float((values[0] == values[1]) == (function == "equal"))
        return Unknown("it computes with a text")
    try:
        value = float(FUNCTIONS[function](*numbers))
    except ZeroDivisionError:
        return Unknown("it divides by 0")
    except OverflowError:
        return Unknown("its value is too large")
    except ValueError:
        return Unknown(_REASONS.get(function, "it has no value"))
    return value if math.isfinite(value) else Unknown("its value is too large")


def is_true(value: float | str | Vacant) -> bool:
    """Whether a condition of this value holds."""
    return value not in (0.0, "", VACANT)


_NUMBERED = ("#", "R", "P", "Q", "QL", "QR", "QS")
"""First characters of variables' names whose number follows without brackets."""


def name_of_indexed(prefix: str, indices: Sequence[Known], suffix: str = "") -> str | Unknown:
    """The name of a variable whose number is computed: `#101`, `R5`, `A[2,0]`, `V.P.A[3].X`."""
    indices = [0.0 if isinstance(each, Vacant) else each for each in indices]
    for index in indices:
        if isinstance(index, Unknown):
            return index
        if isinstance(index, float) and _snap(index) != round(index):
            return Unknown(f"{written(index)} is no number of a variable")
    number = ",".join(f"{index:.0f}" if isinstance(index, float) else str(index) for index in indices)
    return f"{prefix}{number}" if prefix in _NUMBERED and not suffix else f"{prefix}[{number}]{suffix}"


def variables_of(term: Term) -> Iterator[Variable | Indexed]:
    """The variables of an expression, from the left; those in an index too."""
    match term:
        case Variable():
            yield term
        case Indexed():
            yield term
            for each in term.indices:
                yield from variables_of(each)
        case Apply():
            for each in term.arguments:
                yield from variables_of(each)


def place_in(term: Term, known: Mapping[str, Term]) -> Term:
    """A term with others in place of variables."""
    if isinstance(term, Variable):
        return known.get(term.name, term)
    if isinstance(term, Apply):
        return Apply(term.function, tuple(place_in(each, known) for each in term.arguments))
    return term


def written(value: float) -> str:
    """A number as a program has it: with a point, without an exponent, and with 9 decimals at most."""
    number = Decimal(repr(float(value)))
    exponent = number.as_tuple().exponent
    if isinstance(exponent, int) and exponent < -_DECIMALS:
        number = Decimal(f"{value:.{_DECIMALS}f}")
    whole, _, decimals = format(number, "f").partition(".")
    decimals = decimals.rstrip("0")
    return f"{'0' if whole == '-0' and not decimals else whole}.{decimals}"
