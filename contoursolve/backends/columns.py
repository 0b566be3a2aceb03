"""One function for many rows at once: its instructions replayed over columns, called through a buffer."""

from collections.abc import Collection
from typing import Any

import casadi
import numpy
from numpy.typing import NDArray

from contoursolve.backends.numeric import Tape

Array = NDArray[numpy.float64]

ROWS = 4096
"""Rows of one call: what is in use then stays in the processor's cache."""


class Columns:
    """A tape as a function of columns of `ROWS` rows; inputs that do not vary, and what follows from them alone, are
    single numbers.

    It owns its buffers, so that every thread needs one of its own. CasADi lets go of the interpreter lock while it
    evaluates.
    """

    def __init__(self, tape: Tape, varied: Collection[str]) -> None:
        self.fixed = tuple(name for name in tape.inputs if name not in varied)
        self.varied = tuple(name for name in tape.inputs if name in varied)
        scalars, columns = casadi.MX.sym("fixed", len(self.fixed)), casadi.MX.sym("varied", ROWS, len(self.varied))
        places = {name: scalars[number] for number, name in enumerate(self.fixed)}
        places |= {name: columns[:, number] for number, name in enumerate(self.varied)}
        results = _replay(tape.shared(), [places[name] for name in tape.inputs])
        named = dict(zip(tape.outputs, results, strict=True))
        self._single = tuple(name for name, each in named.items() if each.size1() == 1)
        self._many = tuple(name for name, each in named.items() if each.size1() != 1)
        outputs = [
            casadi.vertcat(casadi.MX(0, 1), *(named[name] for name in self._single)),
            casadi.horzcat(casadi.MX(ROWS, 0), *(named[name] for name in self._many)),
        ]
        function: Any = casadi.Function("columns", [scalars, columns], [casadi.densify(each) for each in outputs])
        self.inputs = numpy.zeros((len(self.varied), ROWS))
        self.numbers = numpy.zeros(len(self.fixed))
        self._results = numpy.zeros(len(self._single)), numpy.zeros((len(self._many), ROWS))
        self._buffer, self._trigger = function.buffer()
        for number, argument in enumerate((self.numbers, self.inputs)):
            self._buffer.set_arg(number, _memory(argument))
        for number, result in enumerate(self._results):
            self._buffer.set_res(number, _memory(result))

    def evaluate(self, rows: int) -> dict[str, Array]:
        """The outputs of the first rows of `inputs` (varied input, row) at `numbers` (fixed input): views by name,
        true until the next call; of what does not vary, one number."""
        self._trigger()
        single, many = self._results
        found = {name: single[number : number + 1] for number, name in enumerate(self._single)}
        return found | {name: many[number, :rows] for number, name in enumerate(self._many)}


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
    """(cosine, sine) of angles in degrees, exact where they are exact; see `backends.angle.direction`.

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


_BILLION = 1e9
