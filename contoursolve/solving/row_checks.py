"""The values of some words with which a contour passes its checks, as far as floats can tell."""

from collections.abc import Mapping
from functools import lru_cache

import numpy

from contoursolve.geometry import Profile, System, Unit, assemble
from contoursolve.numeric import COSINE, SINE, Array, Replay, difference, directions, replay_rows
from contoursolve.solving.checks import compile_checks
from contoursolve.solving.construction import is_closed
from contoursolve.solving.determinacy import analyse
from contoursolve.solving.moved_part import moved_part
from contoursolve.solving.numbers import axes_of, inputs_of


def passed_rows(profile: Profile, values: Mapping[str, Array]) -> numpy.ndarray | None:
    """For each row of values of some givens (mm, X as radius, or degrees), whether every check is passed that they have
    a part in, as far as floats can tell. None where no one function answers all rows: there is no closed form, or a
    point may lie in two places between which nothing chooses. Raises ValueError without a start."""
    found = _replay(profile, values, is_whole=False)
    return None if found is None else numpy.equal(found[-1], 1)


def agreement_rows(profile: Profile, values: Mapping[str, Array]) -> numpy.ndarray | None:
    """For each row, by how much the facts that were not needed agree more closely than they must (mm; below 0 if one of
    them does not agree, and NaN where that is not known). None as above, and where every fact is needed."""
    found = _replay(profile, values, is_whole=True)
    return None if found is None or len(found) == 1 else numpy.min(found[:-1], axis=0)


def _replay(profile: Profile, values: Mapping[str, Array], *, is_whole: bool) -> list[numpy.ndarray] | None:
    """The outputs of the checks, a column each: of the whole contour, or of what the values move."""
    system = assemble(profile)
    if not analyse(system).is_determined or not is_closed(system):
        return None
    system, known = (None if is_whole else moved_part(profile, frozenset(values))) or (system, {})
    names, replay = _compile(system)
    inputs: dict[str, float | Array] = {**inputs_of(profile, system), **known}
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
    """The inputs of the checks of a system, and as a function of these the margins of the facts that were not needed,
    and whether all checks are passed."""
    checked = compile_checks(system)
    tape = checked.tape.keep(checked.outputs.margins.values())
    tape.output("clear", checked.is_clear)
    return tape.inputs, replay_rows(tape)
