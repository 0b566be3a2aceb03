"""Lines and arcs of a DXF drawing, and the chain that they make, ordered by their ends."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import dist, floor, hypot
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import UserError
from contoursolve.geometry import Turn
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment, extremes, middle

JOINED = 0.001
"""mm. Ends so near are the same place: the least increment of controls. Drawings of CAD are far better."""
_FLAT = 1e-6
"""1. A normal whose other components are less lies along Z; an ellipse with such a ratio is a circle."""
_NEAR, _MOST = 5.0, 5
"""mm, and how many. Gaps up to this between open ends are told, the smallest first."""
_BESIDE = frozenset(
    ("TEXT", "MTEXT", "ATTRIB", "ATTDEF", "POINT", "HATCH", "LEADER", "MULTILEADER", "TOLERANCE", "VIEWPORT", "IMAGE")
)
"""Entities that are no lines of a contour."""
_NO_POLYLINE = 2 | 4 | 16 | 64
"""Flags of a POLYLINE that is a curve through its points, a spline or a mesh."""


class DxfError(UserError, ValueError):
    """A DXF drawing that gives no chain; the message says why and what to do.

    Attributes:
        layers: how many lines and arcs each layer has.
        chains: the chains to choose from.
    """

    def __init__(self, message: str, layers: Mapping[str, int] = {}, chains: Sequence["DxfChain"] = ()) -> None:
        super().__init__(message)
        self.layers, self.chains = dict(layers), tuple(chains)


class DxfChain(Struct, frozen=True):
    """Lines and arcs, each beginning where the one before it ends, with the names of the drawing's entities. Lengths
    are in the unit of the sketch; `size` is how far it reaches along both axes of the drawing."""

    elements: tuple[Segment, ...]
    layers: tuple[str, ...]
    is_closed: bool
    size: Point


class DrawnCurve(Struct, frozen=True):
    """A line or an arc of the drawing, its layer, and its height above the plane."""

    segment: Segment
    layer: str
    height: float = 0.0

    @property
    def ends(self) -> tuple[Point, Point]:
        """Its begin and its end."""
        return self.segment.start, self.segment.end

    def points(self) -> list[Point]:
        """Its begin, its middle, where an arc goes farthest along the axes, and its end."""
        begin, *far = extremes(self.segment, 0, 1)
        return [begin, middle(self.segment)[0], *far]


def turned_round(segment: Segment) -> Segment:
    """The same line or arc, travelled from its end to its begin."""
    if isinstance(segment, LineSegment):
        return replace(segment, start=segment.end, end=segment.start)
    turn = Turn.CW if segment.turn is Turn.CCW else Turn.CCW
    return replace(segment, start=segment.end, end=segment.start, turn=turn)


Strange = tuple[str, str, list[Point]]
"""A curve that is no line and no arc: its name, its layer, its ends as far as it tells them."""


class Contents(Struct, frozen=True):
    """The entities of a drawing: lines and arcs, dimensions, curves of other kinds, and what else there is, by kind and
    layer."""

    curves: list[DrawnCurve] = []
    dimensions: list[Any] = []
    strange: list[Strange] = []
    beside: list[tuple[str, str]] = []


def read_contents(entities: Iterable[Any], place: Callable[[Any], Point], scale: float, hidden: set[str]) -> Contents:
    """The contents of a model space, blocks taken apart. `place` gives the place of the sketch for one of the drawing,
    `scale` is that of lengths; layers in `hidden` are left out."""
    found = Contents()
    for entity, layer, name in _entities(entities, "0", "", found):
        kind = entity.dxftype()
        if layer.lower() in hidden:
            found.beside.append((f"{kind} on a layer that is off", layer))
        elif kind in ("DIMENSION", "ARC_DIMENSION"):
            found.dimensions.append(entity)
        elif kind in _BESIDE:
            found.beside.append((kind, layer))
        else:
            read = _segment(entity, kind, name, place, scale)
            if read is None:
                found.strange.append((name, layer, [place(at) for at in _ends(entity, kind)]))
            else:
                found.curves.append(DrawnCurve(read[0], layer, read[1] * scale))
    return found


def _entities(entities: Iterable[Any], layer: str, inside: str, found: Contents) -> Iterator[tuple[Any, str, str]]:
    """Each entity with its layer and its name; blocks and polylines taken apart."""
    for entity in entities:
        kind = entity.dxftype()
        # What is on layer 0 of a block lies on the layer of its reference.
        own = layer if entity.dxf.layer == "0" and inside else entity.dxf.layer
        name = f"{kind}{inside}" if inside else f"{kind} {entity.dxf.handle}"
        if kind == "INSERT":
            block = f" in block {entity.dxf.name} ({inside.strip() or name})"
            own_block, lost = entity.block(), list[Any]()
            if own_block is None or own_block.block.is_xref:
                found.strange.append((f"{name}: block {entity.dxf.name} is not in the file", own, []))
                continue
            if f" {entity.dxf.name} (" in inside:
                raise DxfError(f"block {entity.dxf.name} of the drawing contains itself")
            for each in entity.multi_insert() if entity.mcount > 1 else [entity]:
                parts = each.virtual_entities(skipped_entity_callback=lambda part, _, lost=lost: lost.append(part))
                yield from _entities(list(parts), own, block, found)
            found.strange.extend((f"{part.dxftype()}{block}", own, []) for part in lost)
        elif kind == "LWPOLYLINE" or (kind == "POLYLINE" and not entity.dxf.flags & _NO_POLYLINE):
            yield from ((part, own, name) for part in entity.virtual_entities())
        else:
            yield entity, own, name


def _segment(
    entity: Any, kind: str, name: str, place: Callable[[Any], Point], scale: float
) -> tuple[Segment, float] | None:
    """A line or an arc and its height in the drawing; None for all else, and for what lies askew."""
    dxf = entity.dxf
    if kind == "LINE":
        is_level = abs(dxf.start.z - dxf.end.z) * scale <= JOINED
        return (LineSegment(name, place(dxf.start), place(dxf.end)), dxf.start.z) if is_level else None
    if kind not in ("ARC", "CIRCLE", "ELLIPSE") or (kind == "ELLIPSE" and abs(dxf.ratio - 1) > _FLAT):
        return None
    normal = dxf.extrusion.normalize()
    if hypot(normal.x, normal.y) > _FLAT:
        return None
    turn = Turn.CCW if normal.z > 0 else Turn.CW
    center = dxf.center if kind == "ELLIPSE" else entity.ocs().to_wcs(dxf.center)
    radius = dxf.major_axis.magnitude if kind == "ELLIPSE" else dxf.radius
    begin = end = (center.x + radius, center.y)
    if kind != "CIRCLE":
        begin, end = entity.start_point, entity.end_point
    return ArcSegment(name, place(begin), place(end), place(center), radius * scale, turn), center.z


def _ends(entity: Any, kind: str) -> list[Any]:
    """The ends of a curve of another kind, as far as it tells them."""
    if kind == "SPLINE":
        points = [*entity.control_points] or [*entity.fit_points]
        return [points[0], points[-1]] if points else []
    return [entity.start_point, entity.end_point] if kind in ("ELLIPSE", "ARC") else []


def snapping(near: float) -> Callable[[Point], Point]:
    """A function that gives the first place that it met so near to a place, or else that place."""
    cells: defaultdict[tuple[int, int], list[Point]] = defaultdict(list)

    def snap(at: Point) -> Point:
        first, second = floor(at[0] / near), floor(at[1] / near)
        around = ((first + a, second + b) for a in (-1, 0, 1) for b in (-1, 0, 1))
        known = next((each for cell in around for each in cells.get(cell, ()) if dist(each, at) <= near), None)
        if known is None:
            cells[first, second].append(at)
        return known or at

    return snap


class Net:
    """Lines and arcs that meet where their ends are near; what is drawn twice or has no length is left out, and
    told."""

    def __init__(self, curves: Iterable[DrawnCurve], near: float) -> None:
        from ezdxf.edgeminer import Deposit, make_edge  # noqa: PLC0415 - an extra

        snap, snap_middle, off = snapping(near), snapping(near), 0.0
        found = dict[tuple[frozenset[Point], Point], DrawnCurve]()
        twice, empty = list[str](), list[str]()
        # Arcs first: where ends do not quite meet, an arc keeps its own, and a line ends there.
        for curve in sorted(curves, key=lambda each: isinstance(each.segment, LineSegment)):
            begin, halfway, *_, end = curve.points()
            start, head = snap(begin), snap(end)
            key = frozenset((start, head)), snap_middle(halfway)
            if start == head and dist(begin, halfway) <= near:
                empty.append(curve.segment.name)
            elif key in found:
                twice.append(curve.segment.name)
            else:
                off = max(off, dist(begin, start), dist(end, head))
                found[key] = replace(curve, segment=replace(curve.segment, start=start, end=head))
        self.curves = [*found.values()]
        self.edges = [make_edge(*each.ends, payload=each) for each in self.curves]
        # Lines first, in the order of the drawing.
        self.rank = {each.id: (isinstance(each.payload.segment, ArcSegment), n) for n, each in enumerate(self.edges)}
        open_ = [each for each in self.edges if each.start != each.end]
        self.deposit = Deposit(open_, gap_tol=near) if open_ else None
        self.notes = [f"ends are joined that lie up to {off:.3g} apart"] if off > _FLAT else []
        self.notes += [f"drawn twice, taken once: {several(twice)}"] if twice else []
        self.notes += [f"left out, without length: {several(empty)}"] if empty else []

    def meeting(self, at: Point) -> list[DrawnCurve]:
        """The curves that end at a place; a full circle does nowhere."""
        return [each.payload for each in self.deposit.edges_linked_to(at)] if self.deposit else []

    def chains(self) -> list[DxfChain]:
        """All chains, the largest first. Raises DxfError where three ends meet."""
        from ezdxf.edgeminer import find_all_simple_chains  # noqa: PLC0415 - an extra

        for at in (end for each in self.curves for end in each.ends):
            names = [each.segment.name for each in self.meeting(at)]
            if len(names) > 2:  # noqa: PLR2004 - one that comes and one that goes
                raise DxfError(
                    f"{len(names)} lines and arcs meet at {told(at)}: {several(names)}; a chain goes on one way only: "
                    "choose the layer of the contour, or delete what does not belong to it"
                )
        found: list[Sequence[Any]] = [[each] for each in self.edges if each.start == each.end]
        found += find_all_simple_chains(self.deposit) if self.deposit else []
        chains = [_chain(edges) for _, edges in sorted(map(self._ordered, found))]
        return sorted(chains, key=lambda each: -hypot(*each.size))

    def _ordered(self, edges: Sequence[Any]) -> tuple[int, list[Any]]:
        """A chain in the direction of the first line that the drawing has of it, and begun there if it is closed: arcs
        of DXF have no direction; and the place of that line in the drawing."""
        first = min(edges, key=lambda each: self.rank[each.id])
        ordered = [each.reversed() for each in reversed(edges)] if first.is_reverse else [*edges]
        if edges[0].start == edges[-1].end:
            place = ordered.index(first)
            ordered = ordered[place:] + ordered[:place]
        return min(self.rank[each.id][1] for each in edges), ordered


def _chain(edges: Sequence[Any]) -> DxfChain:
    segments = (turned_round(each.payload.segment) if each.is_reverse else each.payload.segment for each in edges)
    points = [at for each in edges for at in each.payload.points()]
    width, height = (max(at[axis] for at in points) - min(at[axis] for at in points) for axis in (0, 1))
    layers = tuple(dict.fromkeys(each.payload.layer for each in edges))
    return DxfChain(tuple(segments), layers, edges[0].start == edges[-1].end, (width, height))


def gaps(chains: Sequence[DxfChain], per_mm: float) -> list[str]:
    """Open ends that lie near to each other, the nearest first: how far, and between which lines and arcs."""
    ends = [
        (at, each.name)
        for chain in chains
        if not chain.is_closed and (len(chain.elements) > 1 or len(chains) > 1)
        for each, at in ((chain.elements[0], chain.elements[0].start), (chain.elements[-1], chain.elements[-1].end))
    ]
    near = sorted(
        (dist(at, other) / per_mm, at, name, further)
        for place, (at, name) in enumerate(ends)
        for other, further in ends[place + 1 :]
        if dist(at, other) <= _NEAR * per_mm and name != further
    )
    return [
        f"a gap of {size:.6g} mm between {name} and {further} at {told(at)}" for size, at, name, further in near[:_MOST]
    ]


def told(at: Point) -> str:
    """A place of the drawing."""
    return f"({round(at[0], 6) + 0.0:.6g}, {round(at[1], 6) + 0.0:.6g})"


def several(names: Sequence[str]) -> str:
    """Names, and how often each occurs."""
    counted = [name if times == 1 else f"{name} ({times} times)" for name, times in Counter(names).items()]
    return ", ".join(counted[:_MOST]) + (f" and {len(counted) - _MOST} more" if len(counted) > _MOST else "")
