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
from contoursolve.solving.checks import Role, compile_checks
from contoursolve.solving.numbers import axes_of, inputs_of
from contoursolve.solving.plan import is_closed


def passed_rows(profile: Profile, values: Mapping[str, Array]) -> numpy.ndarray | None:
    """For each row of values of some givens (mm, X as radius, or degrees), whether every check is passed, as far as
    floats can tell. None where no one function answers all rows: there is no closed form, or a point may lie in two
    places between which nothing chooses. Raises ValueError without a start."""
    found = _replay(profile, values)
    return None if found is None else numpy.equal(found[0], 1)


def agreement_rows(profile: Profile, values: Mapping[str, Array]) -> numpy.ndarray | None:
    """For each row, by how much the facts that were not needed agree more closely than they must (mm; below 0 if one of
    them does not agree, and NaN where that is not known). None as above, and where every fact is needed."""
    found = _replay(profile, values)
    return None if found is None or len(found) == 1 else numpy.min(found[1:], axis=0)


def _replay(profile: Profile, values: Mapping[str, Array]) -> list[numpy.ndarray] | None:
    """The outputs of the checks, a column each."""
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
    count = len(next(iter(values.values())))
    with numpy.errstate(all="ignore"):
        # Numbers of NumPy, because those of Python do not divide by zero.
        return [numpy.broadcast_to(each, count) for each in replay([numpy.float64(inputs[name]) for name in names])]


@lru_cache(maxsize=256)
def _compile(system: System) -> tuple[tuple[str, ...], Replay]:
    """The inputs of the checks of a system, and as a function of these whether all of them are passed, and the margins
    of the facts that were not needed."""
    checked = compile_checks(system)
    tape = checked.tape.keep((), ())
    tape.output("clear", checked.is_clear)
    for number, (check, margin) in enumerate(zip(checked.checks, checked.margins, strict=True)):
        if check.role is Role.FACT:
            tape.output(f"margin:{number}", margin)
    return tape.inputs, replay_rows(tape)
