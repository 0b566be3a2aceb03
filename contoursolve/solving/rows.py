"""Which of many values of some words make a contour: every check at once, and nothing of the contours is kept."""

from collections.abc import Mapping
from functools import lru_cache

import numpy

from contoursolve.analysis import judge
from contoursolve.backends.columns import Array, difference, directions, replay_rows
from contoursolve.backends.inputs import COSINE, SINE
from contoursolve.backends.replay import Replay
from contoursolve.constraints import System, assemble
from contoursolve.model import Profile, Unit
from contoursolve.solving.checks import compile_checks
from contoursolve.solving.numbers import axes_of, inputs_of
from contoursolve.solving.plan import is_closed


def passed_rows(profile: Profile, values: Mapping[str, Array]) -> numpy.ndarray | None:
    """For each row of values of some givens (mm, X as radius, or degrees), whether every check is passed, as far as
    floats can tell. None where no one function answers all rows: there is no closed form, or a point may lie in two
    places between which nothing chooses. Raises ValueError without a start."""
    system = assemble(profile)
    if not judge(system).is_determined or not is_closed(system):
        return None
    names, replay = _compile(system)
    inputs: dict[str, float | Array] = {**inputs_of(profile, system)}
    if not inputs.keys() >= {*names}:
        return None
    axes, start = axes_of(system), profile.start.values
    for name, column in values.items():
        if profile.givens[name].unit is Unit.DEGREE:
            inputs[name + COSINE], inputs[name + SINE] = directions(column)
        else:
            inputs[name] = difference(column, float(start[axes[name]] or 0)) if name in axes else column
    with numpy.errstate(all="ignore"):
        # Numbers of NumPy, because those of Python do not divide by zero.
        (is_clear,) = replay([numpy.float64(inputs[name]) for name in names])
    return numpy.broadcast_to(numpy.equal(is_clear, 1), len(next(iter(values.values()))))


@lru_cache(maxsize=256)
def _compile(system: System) -> tuple[tuple[str, ...], Replay]:
    """The inputs of the checks of a system, and whether all of them are passed as a function of these."""
    checked = compile_checks(system)
    tape = checked.tape.keep((), ())
    tape.output("clear", checked.is_clear)
    return tape.inputs, replay_rows(tape)
