"""Derivatives of a contour that has no closed form, by the implicit function theorem: the equations hold at its points,
and go on to hold while a value changes a little."""

from collections.abc import Iterable
from functools import lru_cache
from itertools import product

import numpy

from contoursolve.analysis import judge
from contoursolve.backends.angle import direction
from contoursolve.backends.inputs import COSINE, SIDE, SINE, lookup
from contoursolve.backends.intervals import Array
from contoursolve.backends.numeric import Compiled, Tape
from contoursolve.constraints import System, assemble
from contoursolve.families.ranges import FamilyError
from contoursolve.model import FIRST, SECOND, Profile, Unit, scalar
from contoursolve.solving import Solution
from contoursolve.solving.compile import compile_path
from contoursolve.tolerance import RESIDUAL

SINGULAR = 1e12
"""1. Condition of the equations, each unknown in mm, above which they are taken for singular."""


class Implicit:
    """The derivatives of all numbers of one solved contour by everything that is stated of it."""

    def __init__(self, profile: Profile, solution: Solution) -> None:
        self.profile, self.system = profile, assemble(profile)
        self.tape, self.equations = _compile(self.system)
        self.inputs = tuple(name for name in self.tape.inputs if name not in self.system.unknowns)
        self.values = _values(profile, solution, self.tape.inputs)
        self.unknowns = self._unknowns()

    def _unknowns(self) -> Array:
        """The rates of the unknowns by the inputs: the Jacobian's inverse times the derivatives by the inputs."""
        names, size = self.system.unknowns, len(self.system.unknowns)
        slopes = self._with_signs()
        matrix = numpy.array([[slopes[f"{row} by {name}"] for name in names] for row in range(size)])
        right = numpy.array([[slopes[f"{row} by {name}"] for name in self.inputs] for row in range(size)])
        if not numpy.linalg.cond(matrix) < SINGULAR:  # true for NaN
            raise FamilyError("two solutions have become one, so that no derivative exists")
        found: Array = -numpy.linalg.solve(matrix, right.reshape(size, len(self.inputs)))
        return found

    def _with_signs(self) -> dict[str, float]:
        """The derivatives of the equations on the sides on which they hold."""
        sides = [name for name in self.tape.inputs if name.startswith(SIDE)]
        basis = [f"{row}" for row in range(len(self.system.unknowns))]
        outputs = self.tape.finish()
        for signs in product((1.0, -1.0), repeat=len(sides)):
            values = self.values | dict(zip(sides, signs, strict=True))
            if all(abs(outputs(values)[row]) <= 10 * RESIDUAL for row in basis):
                return self.equations(values)
        raise FamilyError("the equations do not hold at the points of the contour to nine decimals")

    def rates(self, outputs: Iterable[str]) -> dict[str, dict[str, float]]:
        """The derivatives of some outputs by the inputs: of unknowns, and of what follows from them on the path."""
        machine, found = compile_path(self.system), dict[str, dict[str, float]]()
        places = {name: row for row, name in enumerate(self.system.unknowns)}
        wanted = [name for name in outputs if name not in places]
        read = machine.tape.inputs
        values = {name: self._path_value(name) for name in read}
        slopes = machine.tape.slopes(wanted, read)(values) if wanted else {}
        for name in outputs:
            if name in places:
                found[name] = dict(zip(self.inputs, self.unknowns[places[name]].tolist(), strict=True))
                continue
            total = numpy.zeros(len(self.inputs))
            own: dict[str, float] = {}
            for each in read:
                slope = slopes[f"{name} by {each}"]
                unknown = self._size_of(each) or each
                if unknown in places:
                    total = total + slope * self.unknowns[places[unknown]] if slope else total
                else:
                    own[each] = slope
            rates = dict(zip(self.inputs, total.tolist(), strict=True))
            found[name] = {each: rates.get(each, 0.0) + own.get(each, 0.0) for each in {**rates, **own}}
        return found

    def _size_of(self, name: str) -> str:
        """The unknown that the size of a corner is."""
        sizes = (corner.name for corner in self.profile.figure.corners if corner.size == name)
        return next((f"{each}.radius" for each in sizes if f"{each}.radius" in self.system.unknowns), "")

    def _path_value(self, name: str) -> float:
        """An input of the path, in which coordinates count from the start point."""
        start = {scalar(self.system.figure.start, axis): axis for axis in (FIRST, SECOND)}
        if name in start:
            return 0.0
        value = self.values.get(self._size_of(name) or name)
        if value is None:
            value = _given(self.profile, name)
        point, _, axis = name.rpartition(".")
        if point in (*self.system.figure.points, *self.system.figure.places):
            value -= float(self.profile.start.values[int(axis)] or 0)
        return value


@lru_cache(maxsize=256)
def _compile(system: System) -> tuple[Tape, Compiled]:
    """The equations of a system, and their derivatives by the unknowns and everything that is stated."""
    tape = Tape()
    for name in system.unknowns:
        tape.input(name)
    at = lookup(system, tape, {})
    basis = [system.facts[index] for index in judge(system).basis]
    for row, fact in enumerate(basis):
        tape.output(f"{row}", fact.residual(at))
    return tape, tape.slopes([f"{row}" for row in range(len(basis))], tape.inputs)


def _values(profile: Profile, solution: Solution, names: Iterable[str]) -> dict[str, float]:
    """The inputs of the equations at a solution, but for sides."""
    found = dict(solution.scalars)
    for name in names:
        if name not in found and not name.startswith(SIDE):
            found[name] = _given(profile, name)
    return found


def _given(profile: Profile, name: str) -> float:
    """The value of what is stated, mm, or the cosine or sine of an angle."""
    point, _, axis = name.rpartition(".")
    if point == profile.figure.start:
        return float(profile.start.values[int(axis)] or 0)
    for ending, part in ((COSINE, 0), (SINE, 1)):
        angle = profile.givens.get(name.removesuffix(ending))
        if name.endswith(ending) and angle is not None and angle.unit is Unit.DEGREE:
            return direction(angle.value)[part]
    return float(profile.givens[name].value)
