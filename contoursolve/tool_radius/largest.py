"""The largest tool: up to which radius tools cut contours, and what ends it."""

from collections.abc import Iterator, Mapping
from decimal import Decimal
from typing import Unpack

from msgspec.structs import replace

from contoursolve.diagnosis import DECIMALS, Depth, limit_text
from contoursolve.diagnostics import choice_of
from contoursolve.families import (
    TOOL,
    BlockOptions,
    End,
    FeasibleRange,
    Interval,
    Reason,
    RefusedError,
    Way,
    errors_of,
    limits_of,
    range_end,
    read_limits,
    spec_of,
)
from contoursolve.geometry import Length
from contoursolve.program import Request, Result, takes
from contoursolve.reading import join_premises
from contoursolve.tolerance import LARGEST
from contoursolve.tool_radius.faults import ToolFault, ToolFaultKind
from contoursolve.tool_radius.findings import ToolFindings, runs_beside, with_radius
from contoursolve.tool_radius.offset import GOUGE, FittingRadii
from contoursolve.tool_radius.runs import ToolRequest, nothing_cut
from contoursolve.tool_radius.tool import (
    OutsideCorner,
    OutsideName,
    SideName,
    Tool,
    ToolError,
    ToolSide,
    make_tool,
)

_REACH = 1000.0
"""mm. Up to which a radius is looked for where no range is given, as for any length."""

_ASIDE = 1e-6
"""mm. How far below the least radius a tool is tried, to tell what stops it."""

_TRIED = "a smaller tool is taken to fit wherever a larger one does, with the same elements in its way"

_UNSTATED = Tool(Decimal(1))
"""The tool with which runs are found where none is stated."""


class ToolTrials:
    """The runs of a solved program, and what keeps tools of any radius from each. Raises ToolError."""

    def __init__(self, result: Result, asked: Request, wanted: ToolRequest) -> None:
        control, self.path, self.rules, self.runs = runs_beside(result, asked, replace(wanted, default=_UNSTATED))
        for each in (word for own in self.runs for word in own.added if word.number):
            told = f"{each.text} in program line {each.line} {each.row.meaning}"
            raise ToolError(f"{told}, so that no radius is that of the tool alone; take it out")
        self.told = ToolFindings(result, control, asked, wanted)
        self.premises = join_premises([each.premises for each in result.answers], control.name)

    def radii(self, number: int, within: tuple[float, float] | None) -> FeasibleRange:
        """The radii that fit a run. Raises FamilyError, ToolError."""
        own = self.runs[number]
        unit, scale = own.unit.value, float(own.unit.in_mm)
        low, high = (0.0, _REACH / scale) if within is None else read_limits(TOOL, within, LARGEST / scale, unit)
        if low < 0:
            raise ToolError(f"the radius of a tool is not below 0; search from 0, such as 0:{high:g}")
        every = self.rules.fitting(own, high * scale)
        found = [each for each in every if each.high >= max(low * scale, GOUGE)]
        ends = ((self._end(number, each, low, -1), self._end(number, each, high, 1)) for each in found)
        intervals = tuple(Interval(*each) for each in ends)
        is_open = own.tool.radius is _UNSTATED.radius
        about = TOOL, unit, 0.0 if is_open else own.radius / scale, (low, high), intervals, (_TRIED,)
        reason = None if found else self._end(number, every[-1], high, 1).reason
        refusal = "" if reason is None else reason.text
        held = "of tools that cut the contour"
        return FeasibleRange(*about, refusal, False, is_open, self.premises, held, tuple(self._warnings(number)))

    def _end(self, number: int, fits: FittingRadii, bound: float, way: int) -> End:
        """The upper (`way` 1) or the lower end (-1) of radii that fit, within a bound of the search."""
        own = self.runs[number]
        unit, scale = own.unit.value, float(own.unit.in_mm)
        other, limit = (fits.low, fits.high)[::way]
        beyond = fits.beyond if way > 0 else limit - _ASIDE
        if beyond is None or (way < 0 and limit <= bound * scale):
            return range_end(bound, other / scale, unit)
        value = round(limit / scale, 12)
        limits = limits_of(value, other / scale, unit, lambda radius: not self.rules.stops(own, radius * scale))
        # What stops the next radius that can be typed is plainer.
        typed = (float(limits[0]) + way * 10 ** -DECIMALS[unit]) * scale
        stopped = typed if self.rules.stops(own, typed) else beyond
        reason = self._reason(number, limits[0] if limit >= GOUGE else None, stopped, way)
        return End(value, Way.BISECTION if way > 0 else Way.CLOSED_FORM, reason, True, value, beyond / scale, *limits)

    def _warnings(self, number: int) -> Iterator[str]:
        """The warnings about the tool, whatever its radius."""
        own = self.runs[number]
        for fault in self.warned(number):
            message = fault.kind.value.message.format(**self.told.texts(own, fault))
            yield f"program line {own.travels[fault.element].line}: {message}"

    def warned(self, number: int) -> list[ToolFault]:
        """The faults of the tip of a tool, which no radius ends, and which leave a path."""
        return [each for each in self.rules.at(self.runs[number]).stops if each.kind is ToolFaultKind.TIP_AGAINST_SIDE]

    def _reason(self, number: int, limit: Decimal | None, beyond: float, way: int) -> Reason:
        """The finding about a tool beyond the largest (`way` 1) or below the least one (-1), with its place; None where
        no tool fits."""
        fault, made = self.rules.stops(self.runs[number], beyond)[0], with_radius(self.runs[number], beyond)
        word = self.told.word(made, fault) if fault.kind is ToolFaultKind.ARC_TOO_SMALL else None
        where = f"program line {made.travels[fault.element].line}{f', {word.text}' if word is not None else ''}"
        message = fault.kind.value.message.format(**self.told.texts(made, fault))
        most = "most" if way > 0 else "least"
        told = "no tool fits" if limit is None else f"tool at {most} {limit_text(limit, made.unit.value)}"
        return Reason(f"{where}: {message}: {told}", fault.kind.code, message)


def largest_tools(
    trials: ToolTrials, result: Result, within: tuple[float, float] | None
) -> dict[tuple[int, ...], FeasibleRange]:
    """The tools that cut each contour of a program, by its lines. Raises ToolError, FamilyError, RefusedError."""
    if errors_of(result) or any(each.contour is None for each in result.answers):
        raise RefusedError(result)
    if not trials.runs:
        raise nothing_cut(trials.path)
    found = dict[tuple[int, ...], FeasibleRange]()
    for number, own in enumerate(trials.runs):
        each = trials.radii(number, within)
        # A contour that runs several times may begin elsewhere each time.
        found[own.lines] = min(found.get(own.lines, each), each, key=lambda one: one.largest)
    return found


def least_of(found: Mapping[tuple[int, ...], FeasibleRange]) -> FeasibleRange:
    """The tools that cut all contours: those that cut the one with the smallest limit."""
    return min(found.values(), key=lambda each: each.largest * float(Length(each.unit).in_mm))


class ToolOptions(BlockOptions, total=False):
    """Options of every question about tools beside a block (see `find_tools`)."""

    side: SideName | None
    tip: int | None
    outside: OutsideName | None


@takes(ToolOptions)
def find_tools(
    text: str, *, within: tuple[float, float] | None = None, **options: Unpack[ToolOptions]
) -> Mapping[tuple[int, ...], FeasibleRange]:
    """The radii of tools that cut each contour of a program, by its lines, and what ends them; see
    `contoursolve.ranges`.

    A smaller tool is taken to fit wherever a larger one does, and both sides of each end are tried. Run-in and run-off
    may cross: where a large tool reaches over both, less is in its way than in that of a small one. There may be two
    ranges. What no path shows, such as a cycle, is left out; `contoursolve find` lists it.
    """
    wanted, rest = request_of(options)
    template = spec_of(text, **rest).template()
    result = template.examined(Depth.VERDICT)
    return largest_tools(ToolTrials(result, template.asked, wanted), result, within)


def request_of(options: ToolOptions) -> tuple[ToolRequest, BlockOptions]:
    """A tool of any radius, and the options about the block. Raises ToolError, ValueError."""
    side, tip = options.pop("side", None), options.pop("tip", None)
    make_tool(Decimal(0), tip)
    way = options.pop("outside", None)
    outside = choice_of(OutsideCorner, way, "outside") if way is not None else None
    chosen = choice_of(ToolSide, side, "side") if side is not None else None
    return ToolRequest(None, tip, chosen, outside), options
