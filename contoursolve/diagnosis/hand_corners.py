"""The calculation of corners by hand: the right triangle of half the turn, or circles beside arcs."""

from collections.abc import Mapping
from math import tau
from typing import Any

from contoursolve.diagnosis.hand_sheet import Calculation, HandSheet, Pair
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Corner,
    CornerShape,
    Line,
)
from contoursolve.solving import CornerSolution


class HandCorners(HandSheet):
    """The corners of a contour whose points are found."""

    _landing: Any = None
    """The angle of the line on which a corner lands where no element follows."""

    def _corner(self, corner: Corner) -> Calculation:
        self._number += 1
        solved = self._corners[corner.name]
        if solved.begin == solved.end:
            return self._done(f"{corner.name}: the control leaves it out, for the path hardly turns")
        found = self._checked(lambda: self._by_its_shape(corner, solved))
        if found is not None:
            return found
        at = [(pair, getattr(solved, place)) for place, pair in self._places[corner.name].items()]
        coordinates = [each for pair, point in at if point for each in zip(pair, point, strict=True)]
        return self._taken(corner.name, ((symbol, value, "mm") for symbol, value in coordinates))

    def _by_its_shape(self, corner: Corner, solved: CornerSolution) -> Calculation | None:
        """A corner by its definition; None for a chamfer of given face beside an arc."""
        vertex = self._point(corner.at)
        elements = {each.name: each for each in self._system.figure.path}
        before, after, size = elements[corner.before], self._after(corner, elements, solved), self._size(corner)
        if isinstance(before, Line) and isinstance(after, Line):
            one, other = self._angle_of(before), self._angle_of(after)
            return self._between_lines(corner, solved, vertex, one, other, size)
        if corner.shape is CornerShape.FILLET:
            return self._fillet_of_arcs(corner, solved, before, after, size)
        if corner.shape is CornerShape.CHAMFER_SETBACK:
            return self._setbacks(corner, solved, before, after, size)
        return self._bevel_of_arc(corner, solved, before, after, size) if corner.shape.share else None

    def _extent(self, corner: Corner, solved: CornerSolution, size: Any) -> Pair:
        """The way from the begin to the end of a chamfer at 45 degrees to the axes."""
        share = self._hand.root(2) / 2 if corner.shape is CornerShape.CHAMFER_LENGTH_45 else 1
        first, second = (1 if end > begin else -1 for begin, end in zip(solved.begin, solved.end, strict=True))
        return size * share * first, size * share * second

    def _size(self, corner: Corner) -> Any:
        return self._symbols.scalar(corner.radius if corner.radius in self._system.unknowns else corner.size)

    def _angle_of(self, line: Line) -> Any:
        if not line.name:
            return self._landing
        if line.heading is not None:
            return self._symbols.angle(line.heading)
        (a, b), (c, d) = self._point(line.tail), self._point(line.toward or line.head)
        return self._put(
            f"w{line.name.replace(' ', '')}", self._hand.heading(d - b, c - a), "deg", f"angle of {line.name}"
        )

    def _after(self, corner: Corner, elements: Mapping[str, Line | Arc], solved: CornerSolution) -> Line | Arc:
        """The element behind a corner; where none follows, the line on which it lands, with its angle."""
        if corner.after is not None:
            return elements[corner.after]
        if corner.lands_on is not None:
            return self._system.figure.line(corner.lands_on)
        axis = FIRST if corner.lands_parallel_to == FIRST else SECOND
        vertex = self._place(self._point(corner.at))
        turns = (0 if axis == FIRST else 1) + (0 if solved.end[axis] > vertex[axis] else 2)
        letter = self._profile.plane.axes[axis]
        told = f"angle of the line that it lands on, along {letter}"
        self._landing = self._put("w", turns * self._hand.PI / 2, "deg", told)
        return Line("", corner.at, corner.at)

    def _between_lines(
        self, corner: Corner, solved: CornerSolution, vertex: Pair, one: Any, other: Any, size: Any
    ) -> Calculation:
        """A corner between two lines, by the right triangle of half the turn."""
        sine, cosine = self._hand.sine, self._hand.cosine
        turn = self._put("u", self._turn(one, other), "deg", "the turn from one line to the next")
        back = ahead = size
        why = "as far from the intersection on both lines"
        if corner.shape is CornerShape.FILLET:
            back = ahead = self._put("t", abs(size * self._hand.tangent(turn / 2)), meaning="from the intersection")
            why = "right triangle of the radius and half the turn"
        elif corner.shape is CornerShape.CHAMFER_FACE:
            back = ahead = self._put("t", size / (2 * cosine(turn / 2)), meaning="from the intersection")
            why = "right triangle of half the face and half the turn"
        elif corner.shape.share:
            step = self._extent(corner, solved, size)
            back = self._put(
                "t", (step[0] * sine(other) - step[1] * cosine(other)) / sine(turn), meaning="on the first line"
            )
            ahead = self._put(
                "v", (step[1] * cosine(one) - step[0] * sine(one)) / sine(turn), meaning="on the second line"
            )
            why = "triangle with two angles of 45 degrees to the axes"
        places = self._places[corner.name]
        self._put_pair(places["begin"], (vertex[0] - back * cosine(one), vertex[1] - back * sine(one)))
        self._put_pair(places["end"], (vertex[0] + ahead * cosine(other), vertex[1] + ahead * sine(other)))
        third = ("centre", solved.center) if solved.center else ("end", solved.end)
        self._triangle = ("begin", solved.begin), (corner.at, self._place(vertex)), third
        if corner.shape is CornerShape.FILLET:
            reach, (first, second) = (1 if solved.turn > 0 else -1) * size, places["begin"]
            self._put_pair(places["center"], (first - reach * sine(one), second + reach * cosine(one)))
        return self._done(f"{corner.name}: {why}")

    def _fillet_of_arcs(
        self, corner: Corner, solved: CornerSolution, before: Line | Arc, after: Line | Arc, size: Any
    ) -> Calculation:
        """A rounding beside an arc: its centre lies on a line or a circle beside each of the two."""
        if solved.center is None:
            raise ValueError("a rounding has a centre")
        side = 1 if solved.turn > 0 else -1
        vertex, edges = self._point(corner.at), (before, after)
        reaches = [self._reach(each, side, size) if isinstance(each, Arc) else None for each in edges]
        if isinstance(before, Arc) and isinstance(after, Arc):
            center = self._meeting(
                self._point(before.center), self._point(after.center), reaches[0], reaches[1], solved.center
            )
        else:
            line, arc = (before, after) if isinstance(before, Line) else (after, before)
            if not isinstance(line, Line) or not isinstance(arc, Arc):
                raise ValueError("one of two is a line, the other one an arc")
            angle, reach = self._angle_of(line), reaches[edges.index(arc)]
            sine, cosine = self._hand.sine(angle), self._hand.cosine(angle)
            beside = vertex[0] - side * size * sine, vertex[1] + side * size * cosine
            way = self._crossing(beside, angle, self._point(arc.center), reach, solved.center)
            center = beside[0] + way * cosine, beside[1] + way * sine
        places = self._places[corner.name]
        self._put_pair(places["center"], center)
        first, second = places["center"]
        for place, edge, reach in zip(("begin", "end"), edges, reaches, strict=True):
            if isinstance(edge, Arc):
                (x, y), share = self._point(edge.center), self._at.radius(edge.radius) / reach
                found = x + (first - x) * share, y + (second - y) * share
            else:
                angle = self._angle_of(edge)
                found = first + side * size * self._hand.sine(angle), second - side * size * self._hand.cosine(angle)
            self._put_pair(places[place], found)
        return self._done(f"{corner.name}: its centre is as far from both elements as its radius")

    def _setbacks(
        self, corner: Corner, solved: CornerSolution, before: Line | Arc, after: Line | Arc, size: Any
    ) -> Calculation:
        """A chamfer beside an arc whose ends are so far from the intersection, on an arc along the chord."""
        vertex = self._point(corner.at)
        for place, edge, way, meant in (("begin", before, -1, solved.begin), ("end", after, 1, solved.end)):
            if isinstance(edge, Arc):
                found = self._meeting(self._point(edge.center), vertex, self._at.radius(edge.radius), size, meant)
            else:
                angle = self._angle_of(edge)
                found = (
                    vertex[0] + way * size * self._hand.cosine(angle),
                    vertex[1] + way * size * self._hand.sine(angle),
                )
            self._put_pair(self._places[corner.name][place], found)
        return self._done(f"{corner.name}: each end is so far from the intersection, on an arc along the chord")

    def _bevel_of_arc(
        self, corner: Corner, solved: CornerSolution, before: Line | Arc, after: Line | Arc, size: Any
    ) -> Calculation:
        """A chamfer at 45 degrees to the axes, whose one end is on a line and the other one on an arc."""
        line, arc = (before, after) if isinstance(before, Line) else (after, before)
        if not isinstance(line, Line) or not isinstance(arc, Arc):
            raise ValueError("no control makes a 45 degree chamfer between two arcs")
        vertex, center = self._point(corner.at), self._point(arc.center)
        steps = self._extent(corner, solved, size)
        way = 1 if line is before else -1
        moved = center[0] - way * steps[0], center[1] - way * steps[1]
        angle, meant = self._angle_of(line), solved.begin if line is before else solved.end
        along = self._crossing(vertex, angle, moved, self._at.radius(arc.radius), meant)
        begin, end = (self._places[corner.name][place] for place in ("begin", "end"))
        on_line, on_arc = (begin, end) if line is before else (end, begin)
        there = vertex[0] + along * self._hand.cosine(angle), vertex[1] + along * self._hand.sine(angle)
        self._put_pair(on_line, there)
        self._put_pair(on_arc, (on_line[0] + way * steps[0], on_line[1] + way * steps[1]))
        return self._done(f"{corner.name}: the circle, moved by the chamfer, meets the line")

    def _reach(self, arc: Arc, side: int, size: Any) -> Any:
        """The distance of the centre of a rounding from that of an arc beside it."""
        outward = self._at.radius(arc.radius) - arc.turn.sign * side * size
        return self._put(f"q{arc.name.rpartition(' ')[2]}", outward, meaning=f"from {arc.center} to the centre")

    def _turn(self, one: Any, other: Any) -> Any:
        """The turn between two angles, by whole turns between half of one to either side."""
        turns = round((self._sheet.value(other) - self._sheet.value(one)) / tau)
        return other - one - 2 * turns * self._hand.PI
