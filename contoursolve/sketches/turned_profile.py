"""The profile of a turned part from its drawing: one side of the axis, without what is only drawn."""

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from contoursolve.sketches.dxf_chain import DrawnCurve, DxfError, Net, turned_round
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment, is_on, middle
from contoursolve.tool_radius import crossings, split


def axis_of(curves: Sequence[DrawnCurve], near: float, drawing: Sequence[DrawnCurve]) -> tuple[float, list[str]]:
    """The height of the axis in the drawing, and what is told of it: in the middle of a whole profile, else Y0. A line
    of the `drawing` may show it. Raises DxfError where the profile lies on both sides of Y0 and differs, and where it
    may be a whole one or a half."""
    low, high = _reach(curves)
    middle = (low + high) / 2
    is_whole = high - low > near and _is_symmetrical(curves, middle, near)
    is_drawn = any(
        isinstance(each.segment, LineSegment) and all(abs(at[1] - middle) <= near for at in each.points())
        for each in drawing
    )
    is_across, is_beside = low < -near and high > near, low > near or high < -near
    if is_whole and is_beside and not is_drawn:
        raise DxfError(
            f"the profile is the same on both sides of Y{middle:.6g}, and lies beside Y0: it may be a whole part, or "
            f"the half of a ring; say where the axis is, Y{middle:.6g} or Y0 (zero)"
        )
    if is_whole and (is_across or is_beside):
        return middle, [f"the profile is drawn whole: the half above the axis Y{middle:.6g} is taken"]
    if is_across:
        raise DxfError(
            f"the profile lies on both sides of Y0, from Y{low:.6g} to Y{high:.6g}, and is not the same on both; "
            "choose the layer of the profile, or say where the axis is (zero)"
        )
    return 0.0, ["the axis is Y0 of the drawing"]


def one_side(curves: Sequence[DrawnCurve], near: float) -> tuple[list[DrawnCurve], list[str]]:
    """The profile above the axis Y0, and what is told of it: of a whole profile the upper half, of one below the axis
    its mirror image. Raises DxfError for a profile that is not the same on both sides."""
    low, high = _reach(curves)
    notes, on_axis = list[str](), [each for each in curves if all(abs(at[1]) <= near for at in each.points())]
    curves = [each for each in curves if each not in on_axis]
    if low < -near and high <= near:
        notes.append("the profile lies below the axis: it is taken above it")
        curves = [replace(each, segment=_mirrored(each.segment)) for each in curves]
    elif low < -near:
        if not _is_symmetrical(curves, 0.0, near):
            raise DxfError("the profile lies on both sides of the axis, and is not the same on both; say where it is")
        curves = [replace(each, segment=part) for each in curves for part in _above(each.segment, near)]
    net = Net(curves, near)
    edges = [each for each in curves if _is_edge(each, near) and max(map(len, map(net.meeting, each.ends))) > _ON]
    for left, what in ((on_axis, "on the axis"), (edges, "from the contour to the axis, an edge that is seen")):
        notes += dict.fromkeys(f"left out: {each.segment.name}, {what}" for each in left)
    left_over = [each for each in curves if each not in edges]
    if not left_over:
        raise DxfError("all lines of the profile lie on the axis; say where it is (zero)")
    return left_over, notes


_ON = 2
"""Lines and arcs that meet where a contour goes on; of more, one is none of it."""


def _is_edge(curve: DrawnCurve, near: float) -> bool:
    """Whether it is a line straight to the axis."""
    (first, low), (second, high) = curve.ends
    return isinstance(curve.segment, LineSegment) and abs(first - second) <= near >= min(abs(low), abs(high))


def _reach(curves: Sequence[DrawnCurve]) -> tuple[float, float]:
    heights = [at[1] for curve in curves for at in curve.points()]
    return min(heights), max(heights)


def _mirrored(segment: Segment, axis: float = 0.0) -> Segment:
    def over(at: Point) -> Point:
        return at[0], 2 * axis - at[1]

    found = replace(segment, start=over(segment.start), end=over(segment.end))
    if isinstance(found, ArcSegment):
        # Seen in a mirror it turns the other way: as it does from its end to its begin.
        found = turned_round(replace(found, start=found.end, end=found.start, center=over(found.center)))
    return found


def _is_symmetrical(curves: Sequence[DrawnCurve], axis: float, near: float) -> bool:
    once = Net(curves, near).curves
    both = Net([*once, *(replace(each, segment=_mirrored(each.segment, axis)) for each in once)], near)
    return len(both.curves) == len(once)


def _above(segment: Segment, near: float) -> Iterator[Segment]:
    """The parts of a line or an arc above the axis Y0."""
    axis = LineSegment("axis", (0.0, 0.0), (1.0, 0.0))
    parts = split(segment, (at for at in crossings(segment, axis) if is_on(segment, at)))
    yield from (part for part in parts if middle(part)[0][1] > near)
