"""One function for many rows at once: its instructions replayed over columns, called through a buffer."""

from collections.abc import Collection, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import casadi
import numpy
from msgspec import Struct

from contoursolve.numeric.expressions import Tape
from contoursolve.numeric.functions import Functions
from contoursolve.numeric.interpreter import Replay
from contoursolve.numeric.linear_algebra import Array

ROWS = 32_768
"""Rows of one call: so many that threads seldom wait for the interpreter's lock."""

_NOWHERE: Mapping[str, Array] = MappingProxyType({})

PART = 1_024
"""Rows that go through all instructions before the next ones, within one call: few enough for what lies between the
instructions to stay in the processor's nearest caches (three quarters of the time of `ROWS` at once)."""


SIZES = (PART, 8 * PART, ROWS)
"""Numbers of rows that are computed at once; the small ones save time where there are few rows."""


class ColumnFunction(Struct, frozen=True, eq=False):
    """A function of columns: its inputs that are single numbers and those that vary, its outputs that are single
    numbers, as they follow from those alone, and those that vary."""

    functions: tuple[Any, ...]
    """One for each of `SIZES`."""
    fixed: tuple[str, ...]
    varied: tuple[str, ...]
    single: tuple[str, ...]
    many: Mapping[str, int]
    """Column of each result; several results may share one."""
    given: Mapping[str, int]
    """Index of the input that each result repeats, for results that are inputs."""


def compile_columns(tape: Tape, names: Collection[str]) -> ColumnFunction:
    """The function of a tape for columns of the inputs of these names; some milliseconds."""
    return columns_of(tape.shared(), tape.inputs, tuple(tape.outputs), names)


def columns_of(function: Any, inputs: Sequence[str], outputs: Sequence[str], names: Collection[str]) -> ColumnFunction:
    """The function of one vector to one vector for columns of the inputs of these names."""
    fixed = tuple(name for name in inputs if name not in names)
    varied = tuple(name for name in inputs if name in names)
    # An argument for each column: parts of one would be copied first.
    scalars, columns = casadi.MX.sym("fixed", len(fixed)), [casadi.MX.sym("varied", PART) for _ in varied]
    places = {name: scalars[number] for number, name in enumerate(fixed)}
    places |= dict(zip(varied, columns, strict=True))
    results = _replay(function, [places[name] for name in inputs])
    named = dict(zip(outputs, results, strict=True))
    single = tuple(name for name, each in named.items() if each.size1() == 1)
    # The same expression under several names is computed, and written, once.
    sources = {places[name].__hash__(): number for number, name in enumerate(varied)}
    given = {name: sources[each.__hash__()] for name, each in named.items() if each.__hash__() in sources}
    unique: dict[int, Any] = {}
    many: dict[str, int] = {}
    for name, each in named.items():
        if name not in single and name not in given:
            unique.setdefault(each.__hash__(), each)
            many[name] = list(unique).index(each.__hash__())
    results = [casadi.vertcat(casadi.MX(0, 1), *(named[name] for name in single)), *unique.values()]
    replayed = casadi.Function("columns", [scalars, *columns], [casadi.densify(each) for each in results])
    functions = tuple(replayed.map(size // PART) for size in SIZES)
    return ColumnFunction(functions, fixed, varied, single, many, given)


class Columns:
    """A function of columns with buffers of its own; every thread needs one. CasADi lets go of the interpreter lock
    while it evaluates."""

    def __init__(self, compiled: ColumnFunction) -> None:
        self.compiled = compiled
        self.inputs = numpy.zeros((len(compiled.varied), ROWS))
        # Every part has the single numbers again.
        self._numbers = numpy.zeros((ROWS // PART, len(compiled.fixed)))
        self._single = numpy.zeros((ROWS // PART, len(compiled.single)))
        self._many = list(numpy.zeros((max(compiled.many.values(), default=-1) + 1, ROWS)))
        self._elsewhere: frozenset[int] = frozenset()
        """The results that the last call wrote elsewhere."""
        arguments = (self._numbers, *self.inputs)
        self._buffers: dict[int, tuple[Any, Any]] = {}
        for size, function in zip(SIZES, compiled.functions, strict=True):
            buffer, _ = self._buffers[size] = function.buffer()
            for number, argument in enumerate(arguments):
                buffer.set_arg(number, _memory(argument))
            for number, result in enumerate((self._single, *self._many)):
                buffer.set_res(number, _memory(result))

    def fix(self, places: int | slice | Sequence[int], numbers: float | Sequence[float]) -> None:
        """Set some fixed inputs."""
        self._numbers[:, places] = numbers

    def evaluate(self, rows: int, into: Mapping[str, Array] = _NOWHERE) -> dict[str, Array]:
        """The outputs of the first rows of `inputs` (varied input, row) at the fixed inputs, by name: of what does not
        vary, one number; of the others views, true until the next call. Those that are named in `into` are written
        there."""
        compiled = self.compiled
        # As many rows as a call has are written in place, once.
        direct = {compiled.many[name]: into[name] for name in into if name in compiled.many and rows == ROWS}
        size = next(size for size in SIZES if rows <= size)
        buffer, trigger = self._buffers[size]
        if size == ROWS:
            for number in self._elsewhere | direct.keys():
                buffer.set_res(1 + number, _memory(direct.get(number, self._many[number])))
            self._elsewhere = frozenset(direct)
        trigger()
        found = {name: self._single[0, number : number + 1] for number, name in enumerate(compiled.single)}
        found |= {name: self.inputs[number, :rows] for name, number in compiled.given.items()}
        found |= {name: direct.get(number, self._many[number])[:rows] for name, number in compiled.many.items()}
        for name, array in into.items():
            if direct.get(compiled.many.get(name, -1)) is not array:
                array[:] = found[name]
        return found


def _memory(array: Any) -> Any:
    """The numbers of an array, which CasADi reads and writes in place."""
    return memoryview(array.reshape(-1))


def _replay(function: Any, inputs: list[Any]) -> list[Any]:
    """The outputs of a function of scalars for matrices in place of its inputs."""
    work: dict[int, Any] = {}
    results = [casadi.MX(0)] * function.nnz_out(0)
    for number in range(function.n_instructions()):
        kind = function.instruction_id(number)
        read, target = function.instruction_input(number), function.instruction_output(number)
        if kind == casadi.OP_OUTPUT:
            results[target[1]] = work[read[0]]
        elif kind == casadi.OP_INPUT:
            work[target[0]] = inputs[read[1]]
        elif kind == casadi.OP_CONST:
            work[target[0]] = casadi.MX(function.instruction_constant(number))
        elif len(read) == 1:
            work[target[0]] = casadi.MX.unary(kind, work[read[0]])
        else:
            work[target[0]] = casadi.MX.binary(kind, work[read[0]], work[read[1]])
    return results


def directions(degrees: Array) -> tuple[Array, Array]:
    """(cosine, sine) of angles in degrees, exact where they are exact; see `numeric.given_angle.direction`.

    Angles of at most nine decimals are folded into 0 to 45 degrees as whole numbers, without rounding.
    """
    scaled = numpy.rint(degrees * _BILLION)
    is_decimal = scaled / _BILLION == degrees
    quarter = numpy.rint(scaled / (90 * _BILLION))
    whole = numpy.where(is_decimal, scaled - quarter * (90 * _BILLION), 0.0) / _BILLION
    rest = numpy.where(is_decimal, whole, degrees - 90 * quarter)
    size = numpy.abs(numpy.radians(rest))
    cosine, sine = numpy.cos(size), numpy.copysign(numpy.sin(size), rest)
    is_half = numpy.abs(rest) == 45  # noqa: PLR2004 - both are then the same number
    cosine = numpy.where(is_half, numpy.sqrt(0.5), cosine)
    sine = numpy.where(is_half, numpy.copysign(numpy.sqrt(0.5), rest), sine)
    turns = quarter.astype(numpy.int64) % 4
    return (
        numpy.choose(turns, (cosine, -sine, -cosine, sine)) + 0.0,
        numpy.choose(turns, (sine, cosine, -sine, -cosine)) + 0.0,
    )


def difference(value: Array | float, other: Array | float) -> Array:
    """The difference of two numbers, rounded once where both have at most nine decimals: 0.3 - 0.1 is 0.2."""
    one, two = numpy.rint(numpy.multiply(value, _BILLION)), numpy.rint(numpy.multiply(other, _BILLION))
    is_decimal = (
        (one / _BILLION == value) & (two / _BILLION == other) & (numpy.abs(one) < _WHOLE) & (numpy.abs(two) < _WHOLE)
    )
    return numpy.asarray(numpy.where(is_decimal, (one - two) / _BILLION, numpy.subtract(value, other)))


_BILLION = 1e9
_WHOLE = 2.0**52
"""Whole numbers below this have exact differences."""


ROW_FUNCTIONS = Functions(
    numpy.sqrt,
    numpy.cos,
    numpy.sin,
    magnitude=numpy.abs,
    larger=numpy.fmax,
    at_most=numpy.less_equal,
    below=numpy.less,
    opposite=lambda condition: numpy.equal(condition, 0),
    sign=numpy.sign,
    angle=numpy.arctan2,
    equal=numpy.equal,
    chosen=lambda condition, value: numpy.where(numpy.equal(condition, 0), 0.0, value),
)
"""Of columns of which few rows are computed once: compiling would take longer."""


def replay_rows(tape: Tape) -> Replay:
    """The outputs of a tape for columns of its inputs, without compiling them."""
    return Replay(tape.shared(), ROW_FUNCTIONS, float)
