"""Every solution of a system with further facts as a function of its values: one for each choice of signs."""

from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from functools import lru_cache
from typing import Any

from msgspec import Struct

from contoursolve.geometry import (
    FIRST,
    SECOND,
    ChamferLeg,
    Fact,
    Line,
    Parallel,
    Radius,
    System,
    Values,
    moves_of,
    scalar,
)
from contoursolve.numeric import (
    SIDE,
    Expression,
    Tape,
    is_number,
    is_zero,
    larger,
    quadratic_parts,
    sqrt,
    symbol,
    where,
)
from contoursolve.solving.alternatives import side_values
from contoursolve.solving.compile import Machine, compile_path
from contoursolve.solving.determinacy import basis_of, groups_of, spare_of
from contoursolve.solving.inputs import input_values
from contoursolve.solving.partition import Group
from contoursolve.solving.plan import NoClosedFormError, Plan

ROOT = "root:"
"""What the input for the sign of a root begins with."""

MOST_SIGNS = 6
"""Roots and sides with two signs each; every one doubles the solutions."""

MOST_ROWS = 6
"""Affine equations that are solved at once, by determinants."""

Monomial = tuple[int, ...]
Row = dict[Monomial, Expression]
"""A polynomial: its coefficients by monomial, without those that are always zero."""


class Need(Enum):
    """What must hold of a step besides its equations."""

    REGULAR = "its determinant is not zero"
    REAL = "its discriminant is not negative"
    POSITIVE = "a radius, or what tells a sense, is positive"


class Condition(Struct, frozen=True):
    """What must hold of a solution besides the equations: the output that is compared with zero, the facts that it is
    about, and the unknowns that they give."""

    need: Need
    output: str
    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]


class ClosedForm(Struct, frozen=True, eq=False):
    """The solutions of a system, by the inputs `signs` (each +1 or -1): the unknowns, the residuals of facts that were
    not needed, and the path are outputs of the machine, whose plan has no steps.

    `sides` are the outputs that tell on which side a point lies between whose places a control chooses, by the point,
    with the name of the side where it is positive.
    """

    machine: Machine
    signs: tuple[str, ...]
    conditions: tuple[Condition, ...]
    sides: Mapping[str, tuple[str, str]]


class NoFormulaError(NoClosedFormError):
    """A step without a closed form, or that is not looked at as one; its facts, and why."""

    def __init__(self, why: str, facts: Sequence[Fact], unknowns: Sequence[str]) -> None:
        super().__init__(why)
        self.why, self.facts, self.unknowns = why, tuple(facts), tuple(unknowns)


@lru_cache(maxsize=256)
def close(system: System) -> ClosedForm:
    """The closed form of a determined system. Raises NoFormulaError."""
    return _Closing(system).run()


class _Closing:
    def __init__(self, system: System) -> None:
        self.system, self.tape = system, Tape()
        self.basis, self.checks = basis_of(system), spare_of(system)
        self.scalars: dict[str, Any] = {
            scalar(system.figure.start, axis): self.tape.input(scalar(system.figure.start, axis))
            for axis in (FIRST, SECOND)
        }
        self.signs: list[str] = []
        self.conditions: list[Condition] = []

    def run(self) -> ClosedForm:
        system = self.system
        for group in groups_of(system):
            self._solve(group)
        self._check_senses()
        for fact in self.checks:
            if any(SIDE + side not in self.signs for side in fact.sides()):
                raise NoFormulaError("on which side it touches follows from nothing else", (fact,), ())
        for name in system.unknowns:
            self.tape.output(name, self.scalars[name])
        at = self._at()
        for number, fact in enumerate((*self.basis, *self.checks)):
            self.tape.output(f"residual:{number}", fact.residual(at))
        sides = dict(self._sides(at))
        residuals = tuple(f"residual:{number}" for number in range(len(self.basis)))
        corner_residuals = self._path()
        if len(self.signs) > MOST_SIGNS:
            raise NoFormulaError(f"it has {2 ** len(self.signs):,} solutions to look at", self.basis, ())
        plan = Plan((), self.basis, self.checks)
        machine = Machine(plan, self.tape.finish(), residuals, (), corner_residuals, self.tape)
        return ClosedForm(machine, tuple(self.signs), tuple(self.conditions), sides)

    def _at(self, symbols: Mapping[str, Any] | None = None) -> Values:
        return input_values(self.system, self.tape, {**self.scalars, **(symbols or {})})

    def _need(self, need: Need, value: Any, facts: Sequence[Fact], unknowns: Sequence[str]) -> None:
        output = f"condition:{len(self.conditions)}"
        self.tape.output(output, value)
        self.conditions.append(Condition(need, output, tuple(facts), tuple(unknowns)))

    def _solve(self, group: Group) -> None:
        """One step: the affine equations, and at most one quadratic one on the line that these leave."""
        for side in dict.fromkeys(SIDE + side for fact in group.facts for side in fact.sides()):
            if side not in self.signs:
                self.signs.append(side)
        names = {name: symbol(name) for name in group.unknowns}
        at = self._at(names)
        parts = quadratic_parts([fact.equation(at) for fact in group.facts], list(names.values()))
        if parts is None:
            raise NoFormulaError("they have no closed form together", group.facts, group.unknowns)
        rows: list[Row] = [{} for _ in group.facts]
        for (row, monomial), value in parts.items():
            if not is_number(value, 0):
                rows[row][monomial] = value
        affine, curved = _separated(rows)
        size = len(group.unknowns)
        if len(curved) > 1 or size > MOST_ROWS:
            raise NoFormulaError("they have no closed form together", group.facts, group.unknowns)
        matrix = [[row.get((column,)) for column in range(size)] for row in affine]
        constants = [row.get(()) for row in affine]
        if not curved:
            values = self._affine(matrix, constants, group)
        else:
            values = self._on_line(matrix, constants, curved[0], group)
        self.scalars.update(zip(group.unknowns, values, strict=True))
        for name in group.unknowns:
            if name in self.system.figure.radii:
                self._need(Need.POSITIVE, self.scalars[name], group.facts, (name,))

    def _affine(self, matrix: "_Matrix", constants: "_Column", group: Group) -> list[Any]:
        determinant = _determinant(matrix)
        if determinant is None:
            raise NoFormulaError("they do not fix what they speak about", group.facts, group.unknowns)
        self._need(Need.REGULAR, determinant, group.facts, group.unknowns)
        return [_known(_replaced(matrix, constants, column)) / determinant for column in range(len(matrix))]

    def _on_line(self, matrix: "_Matrix", constants: "_Column", curve: Row, group: Group) -> list[Any]:
        """The two places of a quadratic equation on the line on which affine ones hold."""
        size = len(group.unknowns)
        way = [_cofactor(matrix, column) for column in range(size)]
        if all(each is None for each in way):
            raise NoFormulaError("they do not fix what they speak about", group.facts, group.unknowns)
        square = _sum(each * each for each in way if each is not None)
        if size > 1:
            self._need(Need.REGULAR, sqrt(square), group.facts, group.unknowns)
        whole: _Matrix = [*matrix, way]
        through = [_known(_replaced(whole, [*constants, None], column)) / square for column in range(size)]
        along = [_known(each) / sqrt(square) for each in way]
        leading, middle, last = _on(curve, along, through)
        half, rest = middle / (2 * leading), last / leading
        discriminant = half * half - rest
        self._need(Need.REAL, discriminant, group.facts, group.unknowns)
        sign = f"{ROOT}{','.join(group.unknowns)}"
        self.signs.append(sign)
        # Of a half circle it is zero, and rounding may make it less.
        far = self.tape.input(sign) * sqrt(larger(discriminant, 0)) - half
        return [one + far * step for one, step in zip(through, along, strict=True)]

    def _check_senses(self) -> None:
        """What must run in its stated sense, as `enumerate` says."""
        at, figure = self._at(), self.system.figure
        for fact in self.system.facts:
            for value in self._senses(fact, at):
                self._need(Need.POSITIVE, value, (fact,), self.system.unknowns_among(fact.sense_reads()))
        for line in (*figure.path, *figure.lines):
            if not isinstance(line, Line) or line.name not in figure.carriers:
                continue
            if not line.tail:
                raise NoFormulaError(f"the sense of {line.name} is open", (), ())
            if line.head:
                cosine, sine = at.bearing(line.name)
                first, second = (at.coordinate(line.head, axis) - at.coordinate(line.tail, axis) for axis in (0, 1))
                self._need(Need.POSITIVE, first * cosine + second * sine, (), (line.name,))

    def _senses(self, fact: Fact, at: Values) -> Iterator[Any]:
        """What must be positive; which of several lines tells how a path advances follows from the values."""
        if not isinstance(fact, Parallel | ChamferLeg) or len(fact.advance) < 2:  # noqa: PLR2004 - several lines
            yield from fact.senses(at)
            return
        way, *others = reversed(moves_of(at, fact.advance, fact.axis))
        for move in others:
            way = where(is_zero(move), way, move)
        yield way * (at.bearing(fact.line)[fact.axis] if isinstance(fact, Parallel) else at.side(fact.side))

    def _sides(self, at: Values) -> Iterator[tuple[str, tuple[str, str]]]:
        chosen = set(self.system.choices)
        for point, (value, positive, _) in side_values(self.system, at, chosen).items():
            if point in chosen:
                self.tape.output(f"beside:{point}", value)
                yield point, (f"beside:{point}", positive)

    def _path(self) -> tuple[str, ...]:
        """The outputs of the path, and the names of the corners' residuals."""
        path = compile_path(self.system)
        stated = {fact.given for fact in self.system.facts if isinstance(fact, Radius)}
        known = dict(self.scalars)
        for corner in self.system.figure.corners:
            if corner.size not in stated and f"{corner.name}.radius" in self.scalars:
                known[corner.size] = self.scalars[f"{corner.name}.radius"]
        inputs = {name: known[name] if name in known else self.tape.input(name) for name in path.tape.inputs}
        outputs = {name: path.tape.expression(name) for name in path.tape.outputs}
        _, expressions = path.tape.replaced(inputs, outputs)
        for name, expression in zip(outputs, expressions, strict=True):
            if name != "start":
                self.tape.output(name, expression)
        return path.corner_residuals


_Matrix = list[list[Expression | None]]
_Column = list[Expression | None]
"""None is zero."""


def _separated(rows: Sequence[Row]) -> tuple[list[Row], list[Row]]:
    """Affine equations, made of the others as far as numbers alone can, and those that are left."""
    affine = [row for row in rows if _degree(row) < 2]  # noqa: PLR2004 - affine
    rest, done = [row for row in rows if _degree(row) == 2], []  # noqa: PLR2004 - quadratic
    while rest:
        pivots = ((n, key) for n, row in enumerate(rest) for key in row if len(key) > 1 and is_number(row[key]))
        number, monomial = next(pivots, (0, ()))
        pivot = rest.pop(number)
        done.append(pivot)
        if monomial:
            rest = [_without(row, monomial, pivot) for row in rest]
        affine += [row for row in rest if _degree(row) < 2]  # noqa: PLR2004 - affine
        rest = [row for row in rest if _degree(row) == 2]  # noqa: PLR2004 - quadratic
    return affine, done


def _degree(row: Row) -> int:
    return max((len(monomial) for monomial in row), default=0)


def _without(row: Row, monomial: Monomial, pivot: Row) -> Row:
    if monomial not in row:
        return row
    factor = row[monomial] / pivot[monomial]
    found = dict(row)
    for key, value in pivot.items():
        found[key] = found[key] - factor * value if key in found else -(factor * value)
    return {key: value for key, value in found.items() if key != monomial and not is_number(value, 0)}


def _determinant(matrix: _Matrix) -> Expression | None:
    """By the first row; None if it is zero by structure."""
    if not matrix:
        return Expression(1.0)
    terms = []
    for column, each in enumerate(matrix[0]):
        if each is None:
            continue
        minor = _determinant([[*row[:column], *row[column + 1 :]] for row in matrix[1:]])
        if minor is not None:
            terms.append(each * minor if column % 2 == 0 else -(each * minor))
    return _sum(terms) if terms else None


def _cofactor(matrix: _Matrix, column: int) -> Expression | None:
    """That of a last row which the matrix lacks."""
    minor = _determinant([[*row[:column], *row[column + 1 :]] for row in matrix])
    return minor if minor is None or (len(matrix) + column) % 2 == 0 else -minor


def _replaced(matrix: _Matrix, constants: _Column, column: int) -> Expression | None:
    """The determinant with the right sides in place of a column (Cramer's rule)."""
    pairs = zip(matrix, constants, strict=True)
    return _determinant([[*row[:column], None if end is None else -end, *row[column + 1 :]] for row, end in pairs])


def _on(curve: Row, along: Sequence[Any], through: Sequence[Any]) -> tuple[Any, Any, Any]:
    """The coefficients of a quadratic equation at `through + t * along`: of the square of t, of t, and without it."""
    parts: tuple[list[Any], list[Any], list[Any]] = ([], [], [])
    for monomial, value in curve.items():
        if len(monomial) > 1:
            i, j = monomial
            parts[0].append(value * (along[i] * along[j]))
            parts[1].append(value * (along[i] * through[j] + along[j] * through[i]))
            parts[2].append(value * (through[i] * through[j]))
        elif monomial:
            parts[1].append(value * along[monomial[0]])
            parts[2].append(value * through[monomial[0]])
        else:
            parts[2].append(value)
    leading, middle, last = map(_sum, parts)
    return leading, middle, last


def _sum(values: Any) -> Any:
    total: Any = Expression(0.0)
    for each in values:
        total = total + each
    return total


def _known(value: Expression | None) -> Expression:
    return Expression(0.0) if value is None else value
