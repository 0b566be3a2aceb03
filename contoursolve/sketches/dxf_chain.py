"""Lines and arcs of a DXF drawing, and the chain that they make, ordered by their ends."""

from cmath import exp
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import atan2, dist, floor, hypot, radians, tau
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import UserError
from contoursolve.geometry import Turn
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment

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

    def points(self) -> list[Point]:
        """Its begin, its middle, its end, and where an arc goes farthest along the axes."""
        segment = self.segment
        if isinstance(segment, LineSegment):
            middle = (segment.start[0] + segment.end[0]) / 2, (segment.start[1] + segment.end[1]) / 2
            return [segment.start, middle, segment.end]
        begin = atan2(segment.start[1] - segment.center[1], segment.start[0] - segment.center[0])
        swept = [((quarter * tau / 4 - begin) * segment.turn.sign) % tau * 360 / tau for quarter in range(4)]
        far = [each for each in swept if each < segment.sweep]
        return [segment.start, *(_on(segment, each) for each in (segment.sweep / 2, *far)), segment.end]


def _on(arc: ArcSegment, swept: float) -> Point:
    """The place on an arc behind so many degrees."""
    spoke = complex(arc.start[0] - arc.center[0], arc.start[1] - arc.center[1])
    at = complex(*arc.center) + spoke * exp(1j * arc.turn.sign * radians(swept))
    return at.real, at.imag


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


class Places:
    """Places that count as the same where they are nearer than a tolerance: each is known by its number."""

    def __init__(self, near: float) -> None:
        self.near, self.at = near, list[Point]()
        self._cells: defaultdict[tuple[int, int], list[int]] = defaultdict(list)

    def number(self, at: Point) -> int:
        """The number of a place."""
        first, second = floor(at[0] / self.near), floor(at[1] / self.near)
        for cell in ((first + a, second + b) for a in (-1, 0, 1) for b in (-1, 0, 1)):
            for known in self._cells.get(cell, ()):
                if dist(self.at[known], at) <= self.near:
                    return known
        self._cells[first, second].append(len(self.at))
        self.at.append(at)
        return len(self.at) - 1


_Key = tuple[frozenset[int], int]
"""A curve: the numbers of the places of its ends, and of its middle."""


class Net:
    """Lines and arcs by the places of their ends; what is drawn twice or has no length is left out, and told."""

    def __init__(self, curves: Iterable[DrawnCurve], near: float) -> None:
        self.places, self.curves, middles = Places(near), dict[_Key, DrawnCurve](), Places(near)
        twice, empty = list[str](), list[str]()
        # Arcs first: where ends do not quite meet, an arc keeps its own, and a line ends there.
        for curve in sorted(curves, key=lambda each: isinstance(each.segment, LineSegment)):
            begin, middle, *_, end = curve.points()
            key = frozenset(map(self.places.number, (begin, end))), middles.number(middle)
            if len(key[0]) == 1 and dist(begin, middle) <= near:
                empty.append(curve.segment.name)
            elif key in self.curves:
                twice.append(curve.segment.name)
            else:
                self.curves[key] = curve
        ends = [end for curve in self.curves.values() for end in (curve.segment.start, curve.segment.end)]
        off = max((dist(end, self.places.at[self.places.number(end)]) for end in ends), default=0.0)
        self.notes = [f"ends are joined that lie up to {off:.3g} apart"] if off > _FLAT else []
        self.notes += [f"drawn twice, taken once: {several(twice)}"] if twice else []
        self.notes += [f"left out, without length: {several(empty)}"] if empty else []

    def meeting(self) -> dict[int, list[_Key]]:
        """The curves at each place; a full circle is at none."""
        found: defaultdict[int, list[_Key]] = defaultdict(list)
        for key in self.curves:
            for end in key[0] if len(key[0]) > 1 else ():
                found[end].append(key)
        return found

    def chains(self) -> list[DxfChain]:
        """All chains, the largest first. Raises DxfError where three ends meet."""
        meeting = self.meeting()
        for place, keys in meeting.items():
            if len(keys) > 2:  # noqa: PLR2004 - one that comes and one that goes
                names = several([self.curves[key].segment.name for key in keys])
                raise DxfError(
                    f"{len(keys)} lines and arcs meet at {told(self.places.at[place])}: {names}; a chain goes on one "
                    "way only: choose the layer of the contour, or delete what does not belong to it"
                )
        rest, found = dict.fromkeys(self.curves), list[DxfChain]()
        # From open ends first, so that what is left are loops.
        begins = [(keys[0], place) for place, keys in meeting.items() if len(keys) == 1]
        begins += [(key, self._begin(key)) for key in self.curves]
        for first, begin in begins:
            chain, here, key = list[tuple[_Key, bool]](), begin, first if first in rest else None
            while key is not None:
                del rest[key]
                chain.append((key, self._begin(key) == here))
                here = next(iter(key[0] - {here}), here)
                key = next((each for each in meeting.get(here, ()) if each in rest), None)
            if chain:
                found.append(self._chain(chain, is_closed=here == begin))
        return sorted(found, key=lambda each: -hypot(*each.size))

    def _begin(self, key: _Key) -> int:
        return self.places.number(self.curves[key].segment.start)

    def _chain(self, keys: list[tuple[_Key, bool]], *, is_closed: bool) -> DxfChain:
        """The chain of curves, in the direction of the first line that the drawing has of it, and begun there if it is
        closed: arcs of DXF have no direction."""
        order = {key: number for number, key in enumerate(self.curves)}
        first = min(keys, key=lambda each: (isinstance(self.curves[each[0]].segment, ArcSegment), order[each[0]]))
        if not first[1]:
            keys = [(key, not is_on) for key, is_on in reversed(keys)]
            first = first[0], True
        if is_closed:
            keys = keys[keys.index(first) :] + keys[: keys.index(first)]
        elements = []
        for key, is_on in keys:
            segment = self.curves[key].segment
            start, end = (self.places.at[self.places.number(at)] for at in (segment.start, segment.end))
            segment = replace(segment, start=start, end=end)
            elements.append(segment if is_on else turned_round(segment))
        points = [at for key, _ in keys for at in self.curves[key].points()]
        width, height = (max(at[axis] for at in points) - min(at[axis] for at in points) for axis in (0, 1))
        layers = tuple(dict.fromkeys(self.curves[key].layer for key, _ in keys))
        return DxfChain(tuple(elements), layers, is_closed, (width, height))


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
