"""All real solutions of a few polynomial equations of degree 2, in closed form, with proof of their number."""

from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from itertools import combinations

from msgspec import Struct

from contoursolve.numeric import PRIME, Number, ball
from contoursolve.solving.determinacy import witness_of
from contoursolve.solving.solution import Obstacle
from contoursolve.solving.step_equations import (
    Coefficient,
    Monomial,
    Polynomial,
    Polynomials,
    known,
    polynomial,
    rational,
)

SHEAR = 0.4140625
"""Two conics are turned by this much (as a shear) before one unknown is eliminated, so that no two of their
intersections have the same abscissa in ordinary drawings."""


class ObstacleError(Exception):
    """A step that cannot be solved in closed form."""

    def __init__(self, obstacle: Obstacle) -> None:
        super().__init__(obstacle.value)
        self.obstacle = obstacle


class Root(Struct, frozen=True):
    """One solution: numbers by index of the unknown; a double one is where two have become one."""

    values: Mapping[int, Number]
    is_double: bool = False


FARTHEST = 1e12
"""mm. A thousand times around the earth: where a determinant may be zero, a solution that would be farther away is
none."""


class Close(Enum):
    """The treatment of two solutions that cannot be told apart, or from none."""

    REFUSE = "raise an error"
    DOUBLE = "take them for one double solution"


def solve_step(step: Polynomials, parameters: Sequence[Coefficient], close: Close = Close.REFUSE) -> list[Root]:
    """All real solutions of a step at the values of its parameters. Raises ObstacleError where they cannot be told."""
    equations = equations_of(step, parameters)
    return list(_solve(equations, frozenset(range(len(equations))), close))


def _solve(equations: list[Polynomial], unknowns: frozenset[int], close: Close) -> Iterator[Root]:
    pending: list[tuple[int, Polynomial]] = []
    """Unknowns as polynomials in those that are eliminated later."""
    equations, unknowns = _eliminate(equations, unknowns, pending)
    if not unknowns:
        if _is_consistent(equations):
            yield _back(pending, {}, is_double=False)
        return
    equations = [each for each in equations if each.degree > 0] if _is_consistent(equations) else []
    if not equations:
        return
    single = next((each for each in equations if len(each.unknowns) == 1), None)
    if single is not None:
        (unknown,) = single.unknowns
        rest = [each for each in equations if each is not single]
        for value, is_double in _roots(single, unknown, close):
            replacement = known(value)
            for root in _solve([each.substitute(unknown, replacement) for each in rest], unknowns - {unknown}, close):
                yield _back(pending, {**root.values, unknown: value}, is_double or root.is_double)
        return
    pairs = combinations(equations, 2)
    pair = next((pair for pair in pairs if len(pair[0].unknowns | pair[1].unknowns) == 2), None)  # noqa: PLR2004
    if pair is None:
        raise ObstacleError(Obstacle.NO_CLOSED_FORM)
    used = pair[0].unknowns | pair[1].unknowns
    first, second = sorted(used)
    rest = [each for each in equations if each is not pair[0] and each is not pair[1]]
    for values in _conics(*pair, (first, second)):
        replaced = rest
        for unknown, value in values.items():
            replaced = [each.substitute(unknown, known(value)) for each in replaced]
        for root in _solve(replaced, unknowns - used, close):
            yield _back(pending, {**root.values, **values}, root.is_double)


def _eliminate(
    equations: list[Polynomial], unknowns: frozenset[int], pending: list[tuple[int, Polynomial]]
) -> tuple[list[Polynomial], frozenset[int]]:
    """Solve affine equations one after the other, and make affine ones by combining the others."""
    while True:
        linear = [each for each in equations if each.degree == 1]
        if not linear:
            combined = _combine(equations)
            if combined is None:
                return equations, unknowns
            if not _is_consistent(combined):
                return [constant for constant in combined if constant.degree <= 0], unknowns
            equations = combined
            continue
        found = [
            (abs(each.terms[monomial].value), -number, -monomial[0], each, monomial)
            for number, each in enumerate(linear)
            for monomial in each.terms
            if monomial and ball.sign(each.terms[monomial].value)
        ]
        if not found and any(map(_is_beyond, linear)):
            return [polynomial({(): Coefficient(ball.exact(1.0), 1)})], unknowns
        if not found:
            raise ObstacleError(Obstacle.UNDECIDED)
        _, _, _, pivot, monomial = max(found, key=lambda each: (ball.middle(each[0]), each[1], each[2]))
        lead = pivot.terms[monomial]
        rest = {key: -each / lead for key, each in pivot.terms.items() if key != monomial}
        replacement = polynomial(rest)
        pending.append((monomial[0], replacement))
        equations = [each.substitute(monomial[0], replacement) for each in equations if each is not pivot]
        unknowns -= {monomial[0]}
        if not _is_consistent(equations):
            return [constant for constant in equations if constant.degree <= 0], unknowns
        equations = [each for each in equations if each.degree > 0]


def _is_consistent(equations: Sequence[Polynomial]) -> bool:
    """Whether no equation is a constant other than zero.

    Raises ObstacleError for a constant that may be zero: then an equation is missing.
    """
    for each in equations:
        if each.degree <= 0:
            value = each.constant
            if value is None:
                raise ObstacleError(Obstacle.SINGULAR)
            if ball.sign(value.value) is None:
                raise ObstacleError(Obstacle.UNDECIDED)
            return False
    return True


def _combine(equations: Sequence[Polynomial]) -> list[Polynomial] | None:
    """The equations with squares and products eliminated among them; None if that makes no affine one."""
    rows, done = list(equations), []
    while True:
        candidates = [
            (number, monomial)
            for number, row in enumerate(rows)
            for monomial in row.terms
            if len(monomial) > 1 and ball.sign(row.terms[monomial].value)
        ]
        if not candidates:
            break
        number, monomial = min(candidates, key=lambda each: (each[1], each[0]))
        pivot = rows.pop(number)
        done.append(pivot)
        rows = [_without(row, monomial, pivot) for row in rows]
    return [*rows, *done] if any(row.degree <= 1 for row in rows) else None


def _without(row: Polynomial, monomial: Monomial, pivot: Polynomial) -> Polynomial:
    if monomial not in row.terms:
        return row
    factor = -row.terms[monomial] / pivot.terms[monomial]
    combined = row + pivot.scaled(factor)
    return Polynomial({key: each for key, each in combined.terms.items() if key != monomial})


def equations_of(step: Polynomials, inputs: Sequence[Coefficient]) -> list[Polynomial]:
    """The equations of a step as polynomials, at the values of its parameters."""
    count = max(row for row, _ in step.terms) + 1
    rows: list[dict[Monomial, Coefficient]] = [{} for _ in range(count)]
    for (row, monomial), value in zip(step.terms, step.coefficients(inputs), strict=True):
        rows[row][monomial] = value
    return [polynomial(row) for row in rows]


def has_closed_form(step: Polynomials) -> bool:
    """Whether a step has a closed form, apart from special values.

    Found at random values, which are the same for all drawings.
    """
    inputs = [Coefficient(ball.around(witness_of(name) / PRIME, 0.0), witness_of(name)) for name in step.parameters]
    try:
        equations = equations_of(step, inputs)
        equations, unknowns = _eliminate(equations, frozenset(range(len(equations))), [])
    except ObstacleError:
        return False
    singles = {unknown for each in equations if len(each.unknowns) == 1 for unknown in each.unknowns}
    others = unknowns - singles
    pairs = any(each.unknowns == others for each in equations)
    return not others or (len(others) == 2 and pairs)  # noqa: PLR2004 - a pair


def _is_beyond(equation: Polynomial) -> bool:
    """Whether an equation can hold only if an unknown is larger than `FARTHEST`."""
    if equation.constant is None:
        return False
    most: Number = ball.exact(0.0)
    for monomial, each in equation.terms.items():
        if monomial:
            most = most + ball.magnitude(each.value) * ball.exact(FARTHEST ** len(monomial))
    return ball.sign(ball.magnitude(equation.constant.value) - most) == 1


def _roots(equation: Polynomial, unknown: int, close: Close) -> list[tuple[Number, bool]]:
    """The real roots of a polynomial of degree 2 in one unknown, each with whether it is double."""
    zero = ball.exact(0.0)
    a, b, c = (
        equation.terms[monomial].value if monomial in equation.terms else zero
        for monomial in ((unknown, unknown), (unknown,), ())
    )
    if ball.sign(a) is None and _is_beyond(equation):
        return []
    if ball.sign(a) is None:
        raise ObstacleError(Obstacle.UNDECIDED)
    discriminant = b * b - 4 * a * c
    match ball.sign(discriminant):
        case None:
            if close is Close.DOUBLE:
                return [((-b + ball.both_roots(discriminant)) / (2 * a), True)]
            raise ObstacleError(Obstacle.TOUCHING)
        case -1:
            return []
        case 0:
            return [(-b / (2 * a), True)]
    spread = ball.root(discriminant)
    # The sum without cancellation, then the other root by their product.
    negative = ball.sign(b) == -1
    larger = (-b + spread) / (2 * a) if negative else (-b - spread) / (2 * a)
    smaller = (-b - spread) / (2 * a) if negative else (-b + spread) / (2 * a)
    if ball.sign(larger) and ball.sign(b):
        smaller = c / (a * larger)
    return sorted(((larger, False), (smaller, False)), key=lambda each: ball.middle(each[0]))


def _conics(first: Polynomial, second: Polynomial, unknowns: tuple[int, int]) -> Iterator[dict[int, Number]]:
    """The common points of two conics: the roots of a quartic in one unknown, and the other one from each."""
    x, y = unknowns
    sheared = polynomial({(x,): rational(1.0), (y,): rational(SHEAR)})
    p, q = (_by_power(each.substitute(x, sheared), x, y) for each in (first, second))
    # y**2 * p2 + y * p1 + p0 = 0 and the same with q: the resultant, and the line that they have in common.
    zero: list[Coefficient] = []
    p0, p1, p2 = (p.get(power, zero) for power in range(3))
    q0, q1, q2 = (q.get(power, zero) for power in range(3))
    a = _difference(_times(p2, q0), _times(q2, p0))
    b = _difference(_times(p2, q1), _times(q2, p1))
    c = _difference(_times(p1, q0), _times(q1, p0))
    resultant = _difference(_times(a, a), _times(b, c))
    while resultant and resultant[-1].is_zero:
        resultant.pop()
    if not resultant:
        raise ObstacleError(Obstacle.SINGULAR)
    if len(resultant) == 1:
        return
    if ball.sign(resultant[-1].value) is None:
        raise ObstacleError(Obstacle.UNDECIDED)
    roots = ball.real_roots([each.value for each in resultant])
    if roots is None:
        raise ObstacleError(Obstacle.TOUCHING)
    for root in roots:
        slope, rise = _at(b, root), _at(a, root)
        if not ball.sign(slope):
            raise ObstacleError(Obstacle.UNDECIDED)
        other = -rise / slope
        yield {x: root + ball.exact(SHEAR) * other, y: other}


def _by_power(equation: Polynomial, x: int, y: int) -> dict[int, list[Coefficient]]:
    """The coefficients of the powers of y, as polynomials in x (constant first)."""
    table: dict[int, list[Coefficient]] = {}
    for monomial, each in equation.terms.items():
        row = table.setdefault(monomial.count(y), [])
        power = monomial.count(x)
        row.extend(_ZERO for _ in range(power + 1 - len(row)))
        row[power] = row[power] + each
    return table


_ZERO = Coefficient(ball.exact(0.0), 0)


def _times(a: Sequence[Coefficient], b: Sequence[Coefficient]) -> list[Coefficient]:
    product = [_ZERO] * (len(a) + len(b) - 1) if a and b else []
    for i, first in enumerate(a):
        for j, second in enumerate(b):
            product[i + j] = product[i + j] + first * second
    return product


def _difference(a: Sequence[Coefficient], b: Sequence[Coefficient]) -> list[Coefficient]:
    size = max(len(a), len(b))
    first, second = [*a, *[_ZERO] * (size - len(a))], [*b, *[_ZERO] * (size - len(b))]
    return [one - other for one, other in zip(first, second, strict=True)]


def _at(coefficients: Sequence[Coefficient], x: Number) -> Number:
    value: Number = ball.exact(0.0)
    for each in reversed(coefficients):
        value = value * x + (ball.exact(0.0) if each.witness == 0 else each.value)
    return value


def _back(pending: Sequence[tuple[int, Polynomial]], values: Mapping[int, Number], is_double: bool) -> Root:
    """All unknowns, from the last eliminated to the first."""
    found = dict(values)
    for unknown, expression in reversed(pending):
        total: Number = ball.exact(0.0)
        for monomial, each in expression.terms.items():
            total = total + (each.value * found[monomial[0]] if monomial else each.value)
        found[unknown] = total
    return Root(found, is_double)
