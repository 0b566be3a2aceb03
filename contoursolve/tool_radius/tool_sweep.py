"""Families of contours and tools: for each contour and each radius, whether the tool cuts it, and what stops it."""

from collections.abc import Callable, Mapping
from decimal import Decimal
from functools import cache
from typing import Any, Unpack

import numpy
from msgspec.structs import asdict
from numpy.typing import ArrayLike, NDArray

from contoursolve.diagnosis import Depth
from contoursolve.families import (
    TOOL,
    CompiledSweep,
    Family,
    FamilyError,
    Ranges,
    compile_sweep,
    ranges_of,
    solve_sweep,
    spec_of,
)
from contoursolve.program import takes
from contoursolve.solving import Status
from contoursolve.tool_radius.faults import ToolFaultKind
from contoursolve.tool_radius.largest import ToolOptions, ToolTrials, request_of
from contoursolve.tool_radius.tool import make_tool

Stop = tuple[int, ToolFaultKind] | None
"""The number of the first run that a tool does not cut, and why; None where it cuts all."""

_TEXT = numpy.dtype(f"<U{max(len(each.name) for each in ToolFaultKind)}")


class ToolSweep(CompiledSweep, eq=False, kw_only=True):
    """A sweep of contours and, as the last word of the grid or side by side with them, radii of tools."""

    contours: CompiledSweep
    """The sweep without tools."""
    scale: float
    """mm of a unit of the program."""

    def columns(self) -> dict[str, Any]:
        about = {"tool.fits": numpy.bool_, "tool.largest": numpy.float64, "tool.fault": _TEXT}
        return {**self.contours.columns(), **about}

    def evaluate(self, first: int, last: int, table: Mapping[str, NDArray[Any]]) -> None:
        """Fill in the results of the rows from `first` to before `last`: those of each contour once."""
        radii, many = self.ranges.values[TOOL], self.ranges.count // self.contours.ranges.count
        begin, end = first // many, -(-last // many)
        found = self.contours.empty(end - begin)
        self.contours.evaluate(begin, end, found)
        contour = numpy.arange(first, last) // many - begin
        for name, column in found.items():
            table[name][:] = column[contour]
        table["tool.fits"][:], table["tool.largest"][:], table["tool.fault"][:] = False, numpy.nan, ""
        values = self.contours.ranges.rows(begin, end).values
        is_solved = (found["status"] <= Status.OVERDETERMINED.code) & (found["reason"] == 0)
        for number in numpy.flatnonzero(is_solved).tolist():
            here = numpy.flatnonzero(contour == number)
            own = radii[[begin + number]] if self.ranges.is_paired else radii
            stops, warned = self._stops({word: float(each[number]) for word, each in values.items()}, own)
            own = own[(here + first) % many]
            table["tool.fits"][here] = [stops[radius] is None for radius in own]
            table["tool.fault"][here] = [
                each[1].name.lower() if (each := stops[radius] or warned) else "" for radius in own
            ]
            cut = (radius for radius, stop in stops.items() if stop is None)
            table["tool.largest"][here] = max(cut, default=numpy.nan) * self.scale

    def _stops(self, values: Mapping[str, float], radii: NDArray[numpy.float64]) -> tuple[dict[float, Stop], Stop]:
        """The reasons that stop each tool at one contour, and what all tools are warned of."""
        filled = self.template.filled(values)
        trials = ToolTrials(filled.examined(Depth.VERDICT), filled.asked, self.tool)

        @cache
        def stop_of(radius: float) -> Stop:
            every, stops = enumerate(trials.runs), trials.rules.stops
            return next(((at, each.kind) for at, own in every for each in stops(own, radius * self.scale)), None)

        # Where a tool reaches from the run-in to the run-off, a larger one may fit where a smaller one does not.
        crossings = (trials.rules.crossing(own) for own in trials.runs)
        ends = [each.least / self.scale for each in crossings if each is not None]
        rising = numpy.unique(radii)
        parts = numpy.split(rising, numpy.searchsorted(rising, sorted(ends)))
        stops = {radius: stop for part in parts if len(part) for radius, stop in _fill(part.tolist(), stop_of).items()}
        warned = next(
            ((number, each.kind) for number in range(len(trials.runs)) for each in trials.warned(number)), None
        )
        return stops, warned


def _fill(rising: list[float], stop_of: Callable[[float], Stop]) -> dict[float, Stop]:
    """The reasons that stop each of some rising radii, for which the same lines and arcs are in the way. What stops one
    stops all that are larger, and the kinds are told in one order, so all are alike between two that are alike."""
    low, high = stop_of(rising[0]), stop_of(rising[-1])
    if low == high or len(rising) <= 2:  # noqa: PLR2004 - there is none between
        return dict.fromkeys(rising, low) | {rising[-1]: high}
    middle = len(rising) // 2
    return _fill(rising[: middle + 1], stop_of) | _fill(rising[middle:], stop_of)


def sweep_tools(
    block: str, *, vary: Mapping[str, ArrayLike], paired: bool = False, **options: Unpack[ToolOptions]
) -> ToolSweep:
    """A family of contours and tools that is ready to be evaluated; arguments and errors as for `family_of_tools`."""
    (wanted, rest), values = request_of(options), dict(ranges_of(vary, is_paired=paired).values)
    if (radii := values.pop(TOOL, None)) is None:
        raise FamilyError("no tool varies; name its radii as tool")
    make_tool(Decimal(repr(float(radii.min()))), None)
    spec, is_paired = spec_of(block, values, **rest), paired and bool(values)
    template = spec.template()
    as_it_stands = template.examined(Depth.VERDICT)
    # What is wrong with the tool is told before anything is solved.
    ToolTrials(as_it_stands, template.asked, wanted)
    if not values and not as_it_stands.answers:
        raise FamilyError("the block has no contour words; contoursolve ranges --word tool tells which tools cut it")
    contours = compile_sweep(spec, Ranges(values, is_paired=is_paired))
    unit = contours.template.solve({word: float(each[0]) for word, each in contours.ranges.values.items()}).unit
    ranges = Ranges({**contours.ranges.values, TOOL: radii}, is_paired=is_paired)
    own = asdict(contours) | {"ranges": ranges, "tool": wanted}
    return ToolSweep(**own, contours=contours, scale=float(unit.in_mm))


@takes(ToolOptions)
def family_of_tools(
    block: str,
    *,
    vary: Mapping[str, ArrayLike],
    paired: bool = False,
    workers: int | None = None,
    **options: Unpack[ToolOptions],
) -> Family:
    """A family of contours, and of the tools that cut them; see `contoursolve.family`."""
    return solve_sweep(sweep_tools(block, vary=vary, paired=paired, **options), workers)
