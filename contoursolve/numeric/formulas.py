"""Instructions of CasADi as formulas of a macro language: sympy folds them and names what they have in common."""

from collections.abc import Mapping, Sequence
from math import sqrt
from typing import Any

import sympy
from msgspec import Struct

from contoursolve.numeric.expressions import Tape
from contoursolve.numeric.functions import Functions
from contoursolve.numeric.given_angle import COSINE, SINE, direction
from contoursolve.numeric.interpreter import Replay
from contoursolve.numeric.terms import Affine, Apply, Constant, Term, Variable

ZERO = 1e-6
"""mm, or the sine of an angle. What is not larger is zero for a control, whose cosine of 90 degrees is not; the sine of
the least angle is 17 times as large."""

AT_MOST, LESS, SIGN, TURNED = "at_most", "less", "sign", "arctangent2"
"""Functions that are not written in the middle of an expression in all macro languages."""
ROOT = "square_root"
COMMON = "common:"
"""Beginning of the names of common subexpressions."""


_LONGEST = 40
"""Operations of an expression that has no name."""


class Formulas(Struct, frozen=True):
    """Values in the order in which they are needed: every step uses only steps before it."""

    steps: Mapping[str, Term]
    results: tuple[Term, ...]
    rooted: frozenset[str]
    """Steps of which a root is taken: below zero there is none."""


def formulas_of(
    tape: Tape, outputs: Sequence[Any], inputs: Mapping[str, Affine], signs: Mapping[str, Affine]
) -> Formulas:
    """Expressions of a tape as formulas; the inputs of angles go by the name of the angle. `signs` are inputs that are
    the sign of a value."""
    kept = tape.keep()
    for number, output in enumerate(outputs):
        kept.output(str(number), output)
    known = [_sign(_affine(signs[name])) if name in signs else _input(name, inputs) for name in kept.inputs]
    parts = _Parts(kept.function(), _SYMBOLS, _number)
    results = parts(known)
    everything = [_rounded(sympy.sympify(each)) for each in (*parts.named.values(), *results)]
    named, reduced = sympy.cse(everything, sympy.numbered_symbols(COMMON, real=True), order="none")
    writer = _Writer()
    for symbol, expression in (*named, *zip(parts.named, reduced, strict=False)):
        if expression.is_number:
            writer.known[symbol.name] = expression
        else:
            writer.steps[symbol.name] = writer.term(expression, is_step=True)
    return Formulas(writer.steps, tuple(map(writer.term, reduced[len(parts.named) :])), frozenset(writer.rooted))


class _Parts(Replay):
    """Instructions of which long results get names: sympy walks through an expression as often as it is used."""

    named: dict[Any, Any]

    def __call__(self, inputs: Sequence[Any]) -> list[Any]:
        work, self.named = self._constants.copy(), {}
        for source, target in self._inputs:
            work[target] = inputs[source]
        for operation, first, second, target in self._steps:
            found = operation(work[first], work[second]) if second >= 0 else operation(work[first])
            if found.count_ops() > _LONGEST:
                symbol = sympy.Symbol(f"{COMMON}part of {target}", real=True)
                self.named[symbol], found = found, symbol
            work[target] = found
        return self.results(work)


def _input(name: str, inputs: Mapping[str, Affine]) -> Any:
    """The expression of an input."""
    for part, function in ((COSINE, "cosine"), (SINE, "sine")):
        angle = inputs.get(name.removesuffix(part)) if name.endswith(part) else None
        if angle is not None and not angle.factors:
            return _number(direction(angle.constant)[part == SINE])
        if angle is not None:
            return sympy.Function(function, real=True)(_affine(angle))
    return _affine(inputs[name])


def _affine(value: Affine) -> Any:
    parts = (_number(float(factor)) * sympy.Symbol(name, real=True) for name, factor in value.factors.items())
    return sum(parts, _number(float(value.constant)))


def _rounded(expression: Any) -> Any:
    """An expression in which numbers that differ by rounding are the same."""
    return expression.xreplace({each: _number(float(f"{float(each):.13g}")) for each in expression.atoms(sympy.Float)})


def _number(value: float) -> Any:
    return sympy.Integer(int(value)) if value == int(value) else sympy.Float(value, 17)


"""The functions of instructions; truth is 1 or 0, which is multiplied."""


def _root(value: Any) -> Any:
    if value.is_number:
        return _number(sqrt(float(value)))
    if value.is_Pow and value.exp == 2:  # noqa: PLR2004 - a square
        return sympy.Abs(value.base)
    # A root of sympy's is real only where it knows that.
    return sympy.Function(ROOT, real=True, nonnegative=True)(value)


def _sign(value: Any) -> Any:
    if value.is_number:
        return sympy.Integer(0 if abs(value) <= ZERO else 1 if value > 0 else -1)
    return sympy.Function(SIGN, real=True)(value)


def _angle(sine: Any, cosine: Any) -> Any:
    return sympy.Function(TURNED, real=True)(sine, cosine) * sympy.Float(sympy.pi.evalf(20) / 180, 17)


def _larger(first: Any, second: Any) -> Any:
    if first.is_number and second.is_number:
        return max(first, second)
    return (first + second + sympy.Abs(first - second)) / 2


def _at_most(first: Any, second: Any) -> Any:
    if (first - second).is_number:
        return sympy.Integer(bool(first - second <= 0))
    return sympy.Function(AT_MOST, real=True)(first, second)


def _below(first: Any, second: Any) -> Any:
    if (first - second).is_number:
        return sympy.Integer(bool(first - second < 0))
    return sympy.Function(LESS, real=True)(first, second)


def _equal(first: Any, second: Any) -> Any:
    return _at_most(sympy.Abs(first - second), _number(ZERO))


def _opposite(condition: Any) -> Any:
    return 1 - condition


def _chosen(condition: Any, value: Any) -> Any:
    return condition * value


_SYMBOLS = Functions(
    _root,
    magnitude=sympy.Abs,
    sign=_sign,
    angle=_angle,
    larger=_larger,
    at_most=_at_most,
    below=_below,
    equal=_equal,
    opposite=_opposite,
    chosen=_chosen,
)
"""Of expressions of sympy; truth is 1 or 0, which is multiplied."""


class _Writer:
    """Expressions as terms; comparisons, signs and what is under a root are steps of their own."""

    def __init__(self) -> None:
        self.steps: dict[str, Term] = {}
        self.known: dict[str, Any] = {}
        """Common subexpressions that are numbers."""
        self.rooted: set[str] = set()
        self._names: dict[Any, str] = {}

    def term(self, expression: Any, *, is_step: bool = False) -> Term:
        """An expression as a term; `is_step` tells that it gets a name in any case."""
        if expression.is_number:
            return Constant(float(expression))
        if expression.is_Symbol:
            return (
                Constant(float(self.known[expression.name]))
                if expression.name in self.known
                else Variable(expression.name)
            )
        if expression.is_Add:
            return self._sum(expression)
        if expression.is_Mul:
            return self._product(expression)
        if expression.is_Pow:
            return self._power(expression.base, expression.exp)
        name = expression.func.__name__
        if name == ROOT:
            (base,) = expression.args
            return Apply(ROOT, (self.term(base) if self._is_squares(base) else self._root_of(base),))
        found = Apply(_NAMES.get(name, name), tuple(map(self.term, expression.args)))
        return self._named(expression, found) if name in (AT_MOST, LESS, SIGN, TURNED) and not is_step else found

    def _named(self, expression: Any, term: Term) -> Variable:
        """A step of its own, once for each expression."""
        if expression not in self._names:
            self._names[expression] = f"{COMMON}{SIGN}{len(self._names)}"
            self.steps[self._names[expression]] = term
        return Variable(self._names[expression])

    def _sum(self, expression: Any) -> Term:
        parts = sorted(expression.as_ordered_terms(), key=lambda part: (_is_negative(part), not part.is_number))
        found = self.term(parts[0])
        for part in parts[1:]:
            kind, own = ("subtract", -part) if _is_negative(part) else ("add", part)
            found = Apply(kind, (found, self.term(own)))
        return found

    def _product(self, expression: Any) -> Term:
        factors = list(expression.as_ordered_factors())
        above = [each for each in factors if not _is_below(each)]
        below = [1 / each for each in factors if _is_below(each)]
        number = [each for each in above if each.is_number]
        is_minus = bool(number) and number[0] == -1 and len(above) > 1
        if is_minus:
            above.remove(number[0])
        found = self._chain(above) if above else Constant(1.0)
        if below:
            found = Apply("divide", (found, self._chain(below)))
        return Apply("negate", (found,)) if is_minus else found

    def _chain(self, factors: Sequence[Any]) -> Term:
        found = self.term(factors[0])
        for each in factors[1:]:
            found = Apply("multiply", (found, self.term(each)))
        return found

    def _power(self, base: Any, exponent: Any) -> Term:
        if exponent.is_negative:
            return Apply("divide", (Constant(1.0), self._power(base, -exponent)))
        if exponent == 1:
            return self.term(base)
        if exponent == 2 and not base.is_Symbol:  # noqa: PLR2004 - a square
            own = self._named(base, self.term(base))
            return Apply("multiply", (own, own))
        return Apply("multiply", (self.term(base), self._power(base, exponent - 1)))

    def _root_of(self, base: Any) -> Variable:
        """A step of its own, of which a root is taken."""
        is_step = base.is_Symbol and base.name.startswith(COMMON)
        found = Variable(base.name) if is_step else self._named(base, self.term(base))
        self.rooted.add(found.name)
        return found

    def _is_squares(self, base: Any) -> bool:
        """Whether an expression is never negative, so that it always has a root."""
        return all(part.is_nonnegative for part in (base.args if base.is_Add else (base,)))


_NAMES = {"Abs": "absolute"}


def _is_negative(part: Any) -> bool:
    """Whether a part of a sum is written with a minus."""
    return bool(part.could_extract_minus_sign()) and part.as_coeff_Mul()[0].is_negative is True


def _is_below(factor: Any) -> bool:
    """Whether a factor stands below the bar of a fraction."""
    return bool(factor.is_Pow and factor.exp.is_negative)
