"""Stands in for CasADi where it cannot be installed: what `contoursolve.numeric` uses of its interface, in Python.

Expressions are shared: equal ones are one object. A function is the list of its operations, run on floats or, for a
function of columns, on arrays.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import chain
from typing import Any
from weakref import WeakValueDictionary

import numpy

# Operations, by CasADi's own numbers ------------------------------------------------------------------------------

OP_ASSIGN, OP_ADD, OP_SUB, OP_MUL, OP_DIV, OP_NEG = 0, 1, 2, 3, 4, 5
OP_POW, OP_CONSTPOW, OP_SQRT, OP_SQ, OP_TWICE, OP_SIN, OP_COS = 8, 9, 10, 11, 12, 13, 14
OP_LT, OP_LE, OP_EQ, OP_NOT, OP_FABS, OP_SIGN, OP_IF_ELSE_ZERO = 19, 20, 21, 23, 29, 30, 32
OP_FMAX, OP_INV, OP_ATAN2, OP_CONST, OP_INPUT, OP_OUTPUT = 35, 36, 43, 44, 45, 46


def _divided(a: float, b: float) -> float:
    if b:
        return a / b
    return math.nan if not a or a != a else math.copysign(math.inf, a) * math.copysign(1.0, b)


def _power(a: float, b: float) -> float:
    try:
        found = a**b
    except (OverflowError, ZeroDivisionError):
        return math.inf
    return math.nan if isinstance(found, complex) else found


def _larger(a: float, b: float) -> float:
    return b if a != a or b > a else a


FLOATS: Mapping[int, Callable[..., float]] = {
    OP_ADD: lambda a, b: a + b,
    OP_SUB: lambda a, b: a - b,
    OP_MUL: lambda a, b: a * b,
    OP_DIV: _divided,
    OP_NEG: lambda a: -a,
    OP_POW: _power,
    OP_CONSTPOW: _power,
    OP_SQRT: lambda a: math.sqrt(a) if a >= 0 else math.nan,
    OP_SQ: lambda a: a * a,
    OP_TWICE: lambda a: a + a,
    OP_SIN: lambda a: math.sin(a) if math.isfinite(a) else math.nan,
    OP_COS: lambda a: math.cos(a) if math.isfinite(a) else math.nan,
    OP_LT: lambda a, b: float(a < b),
    OP_LE: lambda a, b: float(a <= b),
    OP_EQ: lambda a, b: float(a == b),
    OP_NOT: lambda a: float(not a),
    OP_FABS: abs,
    OP_SIGN: lambda a: a if a != a else float((a > 0) - (a < 0)),
    OP_IF_ELSE_ZERO: lambda a, b: b if a else 0.0,
    OP_FMAX: _larger,
    OP_INV: lambda a: _divided(1.0, a),
    OP_ATAN2: math.atan2,
}
ARRAYS: Mapping[int, Callable[..., Any]] = {
    OP_ADD: numpy.add,
    OP_SUB: numpy.subtract,
    OP_MUL: numpy.multiply,
    OP_DIV: numpy.divide,
    OP_NEG: numpy.negative,
    OP_POW: numpy.power,
    OP_CONSTPOW: numpy.power,
    OP_SQRT: numpy.sqrt,
    OP_SQ: numpy.square,
    OP_TWICE: lambda a: a + a,
    OP_SIN: numpy.sin,
    OP_COS: numpy.cos,
    OP_LT: lambda a, b: numpy.less(a, b) * 1.0,
    OP_LE: lambda a, b: numpy.less_equal(a, b) * 1.0,
    OP_EQ: lambda a, b: numpy.equal(a, b) * 1.0,
    OP_NOT: lambda a: numpy.equal(a, 0) * 1.0,
    OP_FABS: numpy.abs,
    OP_SIGN: numpy.sign,
    OP_IF_ELSE_ZERO: lambda a, b: numpy.where(numpy.equal(a, 0), 0.0, b),
    OP_FMAX: numpy.fmax,
    OP_INV: lambda a: numpy.divide(1.0, a),
    OP_ATAN2: numpy.arctan2,
}


# Expressions ---------------------------------------------------------------------------------------------------


class Node:
    """A symbol, a constant, or an operation on other nodes."""

    __slots__ = ("__weakref__", "operands", "operation", "value")

    def __init__(self, operation: int, operands: tuple["Node", ...] = (), value: float = 0.0) -> None:
        self.operation, self.operands, self.value = operation, operands, value

    @property
    def number(self) -> float | None:
        """The value of a constant."""
        return self.value if self.operation == OP_CONST else None


_shared: WeakValueDictionary[Any, Node] = WeakValueDictionary()


def _constant(value: float) -> Node:
    key = (value, math.copysign(1.0, value))
    found = _shared.get(key)
    if found is None or value != value:
        found = _shared[key] = Node(OP_CONST, (), value)
    return found


ZERO, ONE, TWO = _constant(0.0), _constant(1.0), _constant(2.0)


def _make(operation: int, *operands: Node) -> Node:
    numbers = [each.value for each in operands if each.operation == OP_CONST]
    if len(numbers) == len(operands):
        return _constant(FLOATS[operation](*numbers))
    key = (operation, *map(id, operands))
    found = _shared.get(key)
    if found is None:
        found = _shared[key] = Node(operation, operands)
    return found


def _one(operation: int, a: Node) -> Node:
    """An operation on one, simplified."""
    inner = a.operation
    if operation == OP_NEG and inner == OP_NEG:
        return a.operands[0]
    if operation in (OP_SQ, OP_FABS) and inner in (OP_NEG, OP_FABS):
        return _one(operation, a.operands[0])
    if operation == OP_FABS and inner in (OP_SQ, OP_SQRT):
        return a
    if operation == OP_SQRT and inner == OP_SQ:
        return _one(OP_FABS, a.operands[0])
    return _make(operation, a)


def _two(operation: int, a: Node, b: Node) -> Node:
    """An operation on two, simplified."""
    found = None if a.number is not None and b.number is not None else _SIMPLER.get(operation, _as_it_is)(a, b)
    return found or _make(operation, a, b)


def _as_it_is(_a: Node, _b: Node) -> Node | None:
    return None


def _sum(a: Node, b: Node) -> Node | None:
    if a.number == 0:
        return b
    if b.number == 0:
        return a
    if b.operation == OP_NEG:
        return _two(OP_SUB, a, b.operands[0])
    return _make(OP_TWICE, a) if a is b else None


def _difference(a: Node, b: Node) -> Node | None:
    if b.number == 0:
        return a
    if a.number == 0:
        return _one(OP_NEG, b)
    if b.operation == OP_NEG:
        return _two(OP_ADD, a, b.operands[0])
    return ZERO if a is b else None


def _product(a: Node, b: Node) -> Node | None:
    for one, other in ((a, b), (b, a)):
        if one.number == 0:
            return ZERO
        if one.number == 1:
            return other
        if one.number == -1:
            return _one(OP_NEG, other)
        if one.operation == OP_NEG:
            return _one(OP_NEG, _two(OP_MUL, one.operands[0], other))
    return _one(OP_SQ, a) if a is b else None


def _quotient(a: Node, b: Node) -> Node | None:
    if a.number == 0:
        return ZERO
    if b.number == 1:
        return a
    if a.number == 1:
        return _make(OP_INV, b)
    return ONE if a is b else None


def _raised(a: Node, b: Node) -> Node | None:
    if b.number == 0:
        return ONE
    if b.number == 1:
        return a
    if b.number == 2:
        return _one(OP_SQ, a)
    return _make(OP_CONSTPOW, a, b) if b.number is not None else None


def _chosen(a: Node, b: Node) -> Node | None:
    if a.number is not None:
        return b if a.number else ZERO
    return ZERO if b.number == 0 else None


_SIMPLER: Mapping[int, Callable[[Node, Node], Node | None]] = {
    OP_ADD: _sum,
    OP_SUB: _difference,
    OP_MUL: _product,
    OP_DIV: _quotient,
    OP_POW: _raised,
    OP_IF_ELSE_ZERO: _chosen,
    OP_EQ: lambda a, b: ONE if a is b else None,
    OP_LE: lambda a, b: ONE if a is b else None,
    OP_LT: lambda a, b: ZERO if a is b else None,
    OP_FMAX: lambda a, b: a if a is b else None,
}


def _slopes(node: Node) -> tuple[Node, ...]:
    """The derivative of an operation by each of its operands."""
    kind, (a, *rest) = node.operation, node.operands
    b = rest[0] if rest else a
    if kind == OP_DIV:
        return _make(OP_INV, b) if b.number is None else _constant(1 / b.value), _one(OP_NEG, _two(OP_DIV, node, b))
    if kind == OP_ATAN2:
        square = _two(OP_ADD, _one(OP_SQ, a), _one(OP_SQ, b))
        return _two(OP_DIV, b, square), _one(OP_NEG, _two(OP_DIV, a, square))
    if kind == OP_FMAX:
        is_a, is_b = _two(OP_LE, b, a), _two(OP_LE, a, b)
        both = _two(OP_ADD, is_a, is_b)
        return _two(OP_DIV, is_a, both), _two(OP_DIV, is_b, both)
    if kind == OP_CONSTPOW:
        return _two(OP_MUL, b, _two(OP_POW, a, _constant(b.value - 1))), ZERO
    return _SLOPES[kind](a, b, node)


_SLOPES: Mapping[int, Callable[[Node, Node, Node], tuple[Node, ...]]] = {
    OP_ADD: lambda _a, _b, _: (ONE, ONE),
    OP_SUB: lambda _a, _b, _: (ONE, _constant(-1.0)),
    OP_MUL: lambda a, b, _: (b, a),
    OP_NEG: lambda _a, _b, _: (_constant(-1.0),),
    OP_SQRT: lambda _a, _b, root: (_make(OP_INV, _make(OP_TWICE, root)),),
    OP_SQ: lambda a, _b, _: (_two(OP_ADD, a, a),),
    OP_TWICE: lambda _a, _b, _: (TWO,),
    OP_INV: lambda _a, _b, inverse: (_one(OP_NEG, _one(OP_SQ, inverse)),),
    OP_SIN: lambda a, _b, _: (_make(OP_COS, a),),
    OP_COS: lambda a, _b, _: (_one(OP_NEG, _make(OP_SIN, a)),),
    OP_FABS: lambda a, _b, _: (_make(OP_SIGN, a),),
    OP_IF_ELSE_ZERO: lambda a, _b, _: (ZERO, a),
    **{each: lambda _a, _b, _: (ZERO, ZERO) for each in (OP_SIGN, OP_NOT, OP_EQ, OP_LE, OP_LT)},
}


def _in_order(nodes: Iterable[Node]) -> list[Node]:
    """All that nodes are made of, operands first."""
    found: dict[int, Node] = {}
    waiting = [(node, False) for node in reversed(list(nodes))]
    while waiting:
        node, is_ready = waiting.pop()
        if id(node) in found:
            continue
        if is_ready or not node.operands:
            found[id(node)] = node
        else:
            waiting.append((node, True))
            waiting += [(each, False) for each in reversed(node.operands)]
    return list(found.values())


def _replaced(nodes: Sequence[Node], new: Mapping[int, Node]) -> list[Node]:
    """The same expressions with others in place of some symbols."""
    known: dict[int, Node] = dict(new)
    for node in _in_order(nodes):
        if id(node) not in known:
            operands = [known[id(each)] for each in node.operands]
            is_same = all(one is other for one, other in zip(operands, node.operands, strict=True))
            make = (_one, _two)[len(operands) - 1] if operands else None
            known[id(node)] = node if is_same or make is None else make(node.operation, *operands)
    return [known[id(node)] for node in nodes]


# Matrices ------------------------------------------------------------------------------------------------------


class SX:
    """A matrix of expressions; an entry that is not there is zero for certain."""

    __slots__ = ("columns", "entries", "rows")

    def __init__(self, value: Any, columns: int | None = None) -> None:
        """A number, the same matrix, or one of so many rows and columns without entries."""
        self.entries: dict[tuple[int, int], Node]
        if isinstance(value, SX):
            self.rows, self.columns, self.entries = value.rows, value.columns, value.entries
        elif columns is None:
            self.rows, self.columns, self.entries = 1, 1, {(0, 0): _constant(float(value))}
        else:
            self.rows, self.columns, self.entries = value, columns, {}

    @staticmethod
    def sym(name: str, rows: int = 1) -> "SX":
        """A column of fresh symbols."""
        return _column([Node(OP_INPUT) for _ in range(rows)])

    @staticmethod
    def zeros(rows: int) -> "SX":
        """A column of zeros."""
        return _column([ZERO] * rows)

    @staticmethod
    def unary(operation: int, value: Any) -> "SX":
        """An operation on a scalar."""
        return _column([_one(operation, _node(value))])

    @staticmethod
    def binary(operation: int, first: Any, second: Any) -> "SX":
        """An operation on two scalars."""
        return _column([_two(operation, _node(first), _node(second))])

    def is_scalar(self) -> bool:
        """Whether it has one row and one column."""
        return self.rows == self.columns == 1

    def is_constant(self) -> bool:
        """Whether all entries are numbers."""
        return all(node.operation == OP_CONST for node in self.entries.values())

    def is_zero(self) -> bool:
        """Whether all entries are zero."""
        return all(node.number == 0 for node in self.entries.values())

    def __float__(self) -> float:
        return _node(self).value

    @property
    def nodes(self) -> list[Node]:
        """All entries, column by column."""
        return [self.entries.get((row, column), ZERO) for column in range(self.columns) for row in range(self.rows)]

    def __getitem__(self, place: Any) -> "SX":
        if isinstance(place, slice):
            return _column(self.nodes[place])
        row, column = place if isinstance(place, tuple) else (place, 0)
        return _column([self.entries.get((row, column), ZERO)])

    @property
    def T(self) -> "SX":  # noqa: N802 - CasADi's name
        """Transposed."""
        return _matrix(self.columns, self.rows, {(column, row): node for (row, column), node in self.entries.items()})

    def sparsity(self) -> "SX":
        """Where entries are."""
        return self

    def get_triplet(self) -> tuple[list[int], list[int]]:
        """The rows and the columns of all entries."""
        places = sorted(self.entries, key=lambda place: place[::-1])
        return [row for row, _ in places], [column for _, column in places]

    def row(self) -> list[int]:
        """The rows of all entries."""
        return self.get_triplet()[0]


def _node(value: Any) -> Node:
    if isinstance(value, SX):
        return value.entries.get((0, 0), ZERO)
    return _constant(float(value))


def _matrix(rows: int, columns: int, entries: Mapping[tuple[int, int], Node]) -> SX:
    found = SX(rows, columns)
    found.entries = dict(entries)
    return found


def _column(nodes: Sequence[Node]) -> SX:
    return _matrix(len(nodes), 1, {(row, 0): node for row, node in enumerate(nodes)})


def if_else(condition: Any, then: Any, otherwise: Any) -> SX:
    """One of two scalars."""
    opposite = _one(OP_NOT, _node(condition))
    return _column(
        [
            _two(
                OP_ADD,
                _two(OP_IF_ELSE_ZERO, _node(condition), _node(then)),
                _two(OP_IF_ELSE_ZERO, opposite, _node(otherwise)),
            )
        ]
    )


def densify(value: Any) -> Any:
    """The matrix with all its entries."""
    if isinstance(value, MX):
        return value
    places = ((row, column) for row in range(value.rows) for column in range(value.columns))
    return _matrix(value.rows, value.columns, {place: value.entries.get(place, ZERO) for place in places})


def vec(value: SX) -> SX:
    """The columns below one another."""
    entries = {(row + column * value.rows, 0): node for (row, column), node in value.entries.items()}
    return _matrix(value.rows * value.columns, 1, entries)


def vertcat(*values: Any) -> Any:
    """Columns below one another."""
    if any(isinstance(value, MX) for value in values):
        return MX([node for value in values for node in value.nodes], sum(value.size1() for value in values))
    return _column([node for value in values for node in (value.nodes if isinstance(value, SX) else [_node(value)])])


def cse(value: Any) -> Any:
    """The same: what several expressions have in common is one object anyway."""
    return value


def substitute(value: SX, old: SX, new: SX) -> SX:
    """Expressions with others in place of symbols."""
    places = list(value.entries)
    known = {id(symbol): node for symbol, node in zip(old.nodes, new.nodes, strict=True)}
    nodes = _replaced([value.entries[place] for place in places], known)
    return _matrix(value.rows, value.columns, dict(zip(places, nodes, strict=True)))


def jacobian(values: SX, symbols: SX) -> SX:
    """The derivatives of a column by a column of symbols."""
    slopes: dict[int, dict[int, Node]] = {id(symbol): {number: ONE} for number, symbol in enumerate(symbols.nodes)}
    rows = values.nodes
    for node in _in_order(rows):
        if id(node) in slopes:
            continue
        found = slopes[id(node)] = dict[int, Node]()
        inner = [slopes[id(each)] for each in node.operands]
        if not any(inner):
            continue
        for factor, known in zip(_slopes(node), inner, strict=False):
            for column, slope in known.items():
                part = _two(OP_MUL, factor, slope)
                found[column] = _two(OP_ADD, found[column], part) if column in found else part
    entries = {(row, column): slope for row, node in enumerate(rows) for column, slope in slopes[id(node)].items()}
    return _matrix(len(rows), symbols.rows, {place: slope for place, slope in entries.items() if slope is not ZERO})


def hessian(value: SX, symbols: SX) -> tuple[SX, SX]:
    """The second and the first derivatives of a scalar."""
    gradient = jacobian(SX(value), symbols).T
    second = jacobian(gradient, symbols)
    return second, gradient


def depends_on(values: SX, symbols: SX) -> bool:
    """Whether any entry has any of the symbols."""
    wanted = set(map(id, symbols.nodes))
    return any(id(node) in wanted for node in _in_order(values.nodes))


def which_depends(values: SX, symbols: SX, order: int, is_by_value: bool) -> list[bool]:
    """Which symbols occur, or which values have them; with order 2 otherwise than linearly."""
    if order == 1 and not is_by_value:
        wanted = {id(node) for node in _in_order(values.nodes)}
        return [id(symbol) in wanted for symbol in symbols.nodes]
    slopes = jacobian(values, symbols)
    return [
        any(depends_on(slopes[row, column], symbols) for column in range(symbols.rows)) for row in range(values.rows)
    ]


def sprank(matrix: SX) -> int:
    """The largest rank that the entries allow."""
    taken: dict[int, int] = {}

    def finds(row: int, seen: set[int]) -> bool:
        for _, column in filter(lambda place: place[0] == row, matrix.entries):
            if column not in seen:
                seen.add(column)
                if column not in taken or finds(taken[column], seen):
                    taken[column] = row
                    return True
        return False

    return sum(finds(row, set()) for row in range(matrix.rows))


class MX:
    """A column, or scalars below one another, as expressions of arguments that are columns."""

    def __init__(self, value: Any, columns: int | None = None) -> None:
        """A number, or with a second argument no row at all."""
        self.nodes: list[Node] = [] if columns is not None else [_constant(float(value))]
        self._rows = len(self.nodes)

    @staticmethod
    def sym(name: str, rows: int) -> "MX":
        """A fresh argument."""
        return _Argument(rows)

    @staticmethod
    def unary(operation: int, value: "MX") -> "MX":
        """An operation on all rows."""
        return _rows_of([_one(operation, value.nodes[0])], value.size1())

    @staticmethod
    def binary(operation: int, first: "MX", second: "MX") -> "MX":
        """An operation on all rows."""
        return _rows_of([_two(operation, first.nodes[0], second.nodes[0])], max(first.size1(), second.size1()))

    def size1(self) -> int:
        """How many rows."""
        return self._rows

    def __hash__(self) -> int:
        return id(self.nodes[0])


class _Argument(MX):
    """An argument: all its rows are one symbol, and each has its own."""

    def __init__(self, rows: int) -> None:
        self.nodes, self._rows = [Node(OP_INPUT)], rows
        self.each = [Node(OP_INPUT) for _ in range(rows)]

    def __getitem__(self, row: int) -> MX:
        return _rows_of([self.each[row]], 1)


def _rows_of(nodes: list[Node], rows: int) -> MX:
    found = MX(0, 1)
    found.nodes, found._rows = nodes, rows
    return found


# Functions -----------------------------------------------------------------------------------------------------


class Function:
    """Outputs as a function of inputs; the first output of the first input is a list of instructions."""

    def __init__(self, name: str, inputs: Sequence[Any], outputs: Sequence[Any]) -> None:
        self._inputs, self._outputs = inputs, outputs
        self._results = [each.nodes for each in outputs]
        order = _in_order(chain.from_iterable(self._results))
        self._place = {id(node): place for place, node in enumerate(order)}
        self._start: list[Any] = [node.number for node in order]
        self._steps = [
            (node.operation, *(self._place[id(each)] for each in node.operands), place)
            for place, node in enumerate(order)
            if node.operands
        ]
        self._reads = [
            (argument, number, self._place[id(symbol)])
            for argument, each in enumerate(inputs)
            if isinstance(each, SX)
            for number, symbol in enumerate(each.nodes)
            if id(symbol) in self._place
        ]
        read = {place: (argument, number) for argument, number, place in self._reads}
        self._instructions: list[tuple[int, list[int], list[int], float]] = [
            (
                node.operation,
                list(read[place]) if place in read else [self._place[id(each)] for each in node.operands],
                [place],
                node.value,
            )
            for place, node in enumerate(order)
        ]
        self._instructions += [
            (OP_OUTPUT, [self._place[id(node)]], [output, number], 0.0)
            for output, nodes in enumerate(self._results)
            for number, node in enumerate(nodes)
        ]

    def n_instructions(self) -> int:
        """How many instructions."""
        return len(self._instructions)

    def instruction_id(self, number: int) -> int:
        """The operation of an instruction."""
        return self._instructions[number][0]

    def instruction_input(self, number: int) -> list[int]:
        """The places that it reads; of an input which argument, and which entry of it."""
        return self._instructions[number][1]

    def instruction_output(self, number: int) -> list[int]:
        """The place that it writes; of an output which result, and which entry of it."""
        return self._instructions[number][2]

    def instruction_constant(self, number: int) -> float:
        """The number of a constant."""
        return self._instructions[number][3]

    def nnz_out(self, output: int) -> int:
        """How many entries an output has."""
        return len(self._results[output])

    def numel_in(self, argument: int) -> int:
        """How many entries an input has."""
        return len(self._inputs[argument].nodes)

    def __call__(self, *arguments: Any) -> Any:
        """The outputs as expressions of others, or as numbers."""
        if isinstance(arguments[0], SX):
            return substitute(self._outputs[0], self._inputs[0], arguments[0])
        work = self._run([[float(each) for each in argument] for argument in arguments])
        found = [
            DM([work[self._place[id(node)]] for node in nodes], each.rows)
            for nodes, each in zip(self._results, self._outputs, strict=True)
        ]
        return found[0] if len(found) == 1 else found

    def _run(self, arguments: Sequence[Sequence[float]]) -> list[float]:
        """The values at all places."""
        work = self._start.copy()
        for argument, number, place in self._reads:
            work[place] = arguments[argument][number]
        for operation, *operands, place in self._steps:
            work[place] = FLOATS[operation](*(work[each] for each in operands))
        return work

    def buffer(self) -> tuple["Buffer", Callable[[], None]]:
        """Where its numbers are read and written, and what evaluates it."""
        found = Buffer()
        return found, lambda: self._trigger(found)

    def map(self, parts: int) -> "Mapped":
        """The same for so many parts of rows at once."""
        return Mapped(self, parts)

    def _trigger(self, buffer: "Buffer") -> None:
        work = self._run([buffer.arguments[number] for number in range(len(self._inputs))])
        for output, nodes in enumerate(self._results):
            for number, node in enumerate(nodes):
                buffer.results[output][number] = work[self._place[id(node)]]

    def evaluate_rows(self, buffer: "Buffer", parts: int) -> None:
        """The outputs of all rows of so many parts; what is one number is the same in every part."""
        work: list[Any] = self._start.copy()
        for number, argument in enumerate(self._inputs):
            given = numpy.asarray(buffer.arguments[number])
            for row, symbol in enumerate(argument.each):
                if id(symbol) in self._place:
                    work[self._place[id(symbol)]] = given[row]
            if id(argument.nodes[0]) in self._place:
                work[self._place[id(argument.nodes[0])]] = given[: parts * argument.size1()]
        with numpy.errstate(all="ignore"):
            for operation, *operands, place in self._steps:
                work[place] = ARRAYS[operation](*(work[each] for each in operands))
        for number, (nodes, each) in enumerate(zip(self._results, self._outputs, strict=True)):
            into = numpy.asarray(buffer.results[number])[: parts * each.size1()]
            values = [work[self._place[id(node)]] for node in nodes]
            if len(values) == 1:
                into[:] = values[0]
            elif values:
                into[:] = numpy.tile(values, parts)


class Mapped:
    """A function of columns, for so many parts at once."""

    def __init__(self, function: Function, parts: int) -> None:
        self._function, self._parts = function, parts

    def buffer(self) -> tuple["Buffer", Callable[[], None]]:
        """Where its numbers are read and written, and what evaluates it."""
        found = Buffer()
        return found, lambda: self._function.evaluate_rows(found, self._parts)


class Buffer:
    """Where a function reads its arguments and writes its results."""

    def __init__(self) -> None:
        self.arguments: dict[int, Any] = {}
        self.results: dict[int, Any] = {}

    def set_arg(self, number: int, memory: Any) -> None:
        """From where an argument is read."""
        self.arguments[number] = memory

    def set_res(self, number: int, memory: Any) -> None:
        """To where a result is written."""
        self.results[number] = memory


class DM:
    """A matrix of numbers, column by column."""

    def __init__(self, numbers: Sequence[float], rows: int) -> None:
        self._numbers, self._rows = numbers, rows

    def full(self) -> Any:
        """As an array."""
        return numpy.array(self._numbers, dtype=float).reshape(-1, self._rows).T


def rootfinder(name: str, method: str, problem: Mapping[str, SX], options: Mapping[str, Any]) -> Callable[..., DM]:
    """Newton's method, whose steps are halved as long as that makes the equations smaller."""
    unknowns, residuals = problem["x"], problem["g"]
    function = Function(name, [unknowns, problem["p"]], [densify(residuals), densify(jacobian(residuals, unknowns))])

    def find(guess: Sequence[float], given: Sequence[float]) -> DM:
        point = numpy.array(list(guess), dtype=float)
        value, slopes = (each.full() for each in function(point, given))
        for _ in range(options["max_iter"]):
            step = numpy.linalg.solve(slopes, value)[:, 0]
            share = 1.0
            while True:
                nearer, steeper = (each.full() for each in function(point - share * step, given))
                if numpy.linalg.norm(nearer) < numpy.linalg.norm(value) or share < 1e-3:
                    break
                share /= 2
            if not numpy.linalg.norm(nearer) < numpy.linalg.norm(value):
                break
            point, value, slopes = point - share * step, nearer, steeper
        return DM(point.tolist(), len(point))

    return find
