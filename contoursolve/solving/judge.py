"""The refusals of a path in numbers: the checks that fail first, with the values that a refusal states."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import groupby, islice
from math import isnan, nan

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import Arc, Corner, Figure, Line, Profile
from contoursolve.solving.checks import (
    Check,
    MeasuredFigure,
    Stage,
    check_path,
    check_range,
    check_residuals,
    check_room,
    elements_at,
    is_failing,
    setbacks_of,
    unverified,
)
from contoursolve.solving.events import BESIDE, NoteKind, RefusalKind
from contoursolve.solving.fitting import LEAST, NEAR, largest_fitting
from contoursolve.solving.path_outputs import PathOutputs
from contoursolve.solving.solution import Note, Refusal
from contoursolve.tolerance import LARGEST, LENGTH

Failing = list[tuple[Check, float]]
"""Checks with their margins."""

Sizes = Mapping[str, float]
"""Of corners by the words that state them, mm."""


class MeasuredPath(Struct, frozen=True, eq=False):
    """A path in numbers, mm, which count from its start point, and its measures at other sizes of its corners."""

    profile: Profile
    measured: MeasuredFigure
    sizes: Sizes
    resize: Callable[[Sizes], PathOutputs]


def judge_range(path: MeasuredPath) -> list[Refusal]:
    """The point of a path that lies farthest from the start, if no word reaches it."""
    check, margin = check_range(path.measured)
    is_there = margin >= check.limit or not path.profile.figure.path
    return [] if is_there else _judge(path, [(check, margin)])


def judge_path(path: MeasuredPath) -> list[Refusal]:
    """Everything that speaks against the path between points that satisfy the equations and lie within reach."""
    residuals = [abs(each) for each in path.measured.path.residuals]
    worst = nan if isnan(sum(residuals)) else max(residuals, default=0.0)
    return _judge(path, [*check_path(path.measured), check_residuals(worst)])


def vanishing_lines(figure: Figure, path: PathOutputs) -> list[Note]:
    """The lines of a path in numbers that have no length."""
    lines = (each.name for each in figure.path if isinstance(each, Line))
    return [Note(NoteKind.LINE_VANISHES, name) for name in lines if abs(path.lengths[name]) <= LENGTH]


def _judge(path: MeasuredPath, checks: Sequence[tuple[Check, float]]) -> list[Refusal]:
    """The refusals of the first stage of which a check fails."""
    failing = [pair for pair in checks if is_failing(*pair)]
    stages = groupby(failing, lambda pair: pair[0].stage)
    return [refusal for stage, pairs in islice(stages, 1) for refusal in _Told(path).refusals(stage, list(pairs))]


class _Told:
    """The refusals by the checks of one stage that fail."""

    def __init__(self, path: MeasuredPath) -> None:
        self.path, self.measures = path, path.measured.path
        self.figure = path.profile.figure
        self.corners = {corner.name: corner for corner in self.figure.corners}

    def refusals(self, stage: Stage, failing: Failing) -> Iterator[Refusal]:
        """A refusal for each subject, by the first of its checks."""
        if stage is Stage.ROOM:
            yield from self._without_room(failing)
            return
        by_subject: dict[str, Failing] = {}
        for check, margin in failing:
            by_subject.setdefault(check.subject, []).append((check, margin))
        for found in by_subject.values():
            first = found[0][0]
            yield self._refusal(first, [pair for pair in found if pair[0].kind is first.kind])

    def _refusal(self, check: Check, failing: Failing) -> Refusal:
        kind, subject, margin = check.kind, check.subject, failing[0][1]
        match kind:
            case RefusalKind.OUT_OF_RANGE:
                way, start = self.path.measured.way, self.figure.start
                away, name = max((abs(at), name) for name in self.figure.points for at in way(start, name))
                return Refusal(kind, name, (), {"limit": LARGEST, "actual": away})
            case RefusalKind.NOT_VERIFIED:
                return unverified(-margin)
            case RefusalKind.ARC_EMPTY:
                return Refusal(kind, subject)
            case RefusalKind.LINE_BACKWARDS | RefusalKind.LINE_REVERSED | RefusalKind.CORNER_SIGN:
                return self._reversed(kind, self.figure.line(subject), -margin)
        corner = self.corners[subject]
        size = corner.size
        match kind:
            case RefusalKind.CORNER_TOO_LARGE:
                values = {"limit": 0.0, "actual": self.path.sizes[size]}
                return Refusal(kind, subject, (size,), values, (), (check.element, check.element))
            case RefusalKind.BEVEL_OUTSIDE:
                increment, axes = self.path.measured.increment, self.path.profile.plane.axes
                off, axis = max((increment(each.element) - own, axes[int(each.element)]) for each, own in failing)
                return Refusal(kind, subject, (size,), {"off_by_mm": off}, (), (axis,))
            case RefusalKind.BEVEL_IN_BAND:
                values = {"actual": min(own for _, own in failing)}
                if self._touches_arc(corner):
                    # Between two lines no size has a bevel; on an arc a smaller one may.
                    limit, *_ = self._largest(corner)
                    values |= {"limit": limit} if limit >= LEAST else {}
                return Refusal(kind, subject, (size,), values)
        is_ahead = self.measures.corners[subject].cosine > 0
        return Refusal(kind if is_ahead or check.opposite is None else check.opposite, subject, (size,))

    def _reversed(self, kind: RefusalKind, line: Line, off: float) -> Refusal:
        """A line that runs against what is stated of it."""
        givens, values = tuple[str, ...](), dict[str, float]()
        if kind is RefusalKind.CORNER_SIGN:
            givens = tuple(corner.size for corner in self.figure.corners if corner.at == line.tail)
        elif line.heading is not None and self.path.profile.givens[line.heading].word is not None:
            angle, givens = float(self.path.profile.givens[line.heading].value), (line.heading,)
            values = {"actual": angle, "expected": angle - 180 if angle > 0 else angle + 180}
        return Refusal(kind, line.name, givens, {**values, "off_by_mm": off})

    def _touches_arc(self, corner: Corner) -> bool:
        arcs = {each.name for each in self.figure.path if isinstance(each, Arc)}
        return not arcs.isdisjoint(elements_at(corner, self.measures))

    def _without_room(self, failing: Failing) -> Iterator[Refusal]:
        """Corners that are too large for an element, and those that overlap on one, with what fits."""
        alone: dict[str, list[str]] = {}
        """The elements on which each corner alone has no room."""
        for check, _ in failing:
            if check.kind is RefusalKind.CORNER_TOO_LARGE:
                alone.setdefault(check.subject, []).append(check.element)
        refused = {name for names in alone.values() for name in names}
        found = [(RefusalKind.CORNER_TOO_LARGE, name, [self.corners[name]]) for name in self.corners if name in alone]
        for check, _ in failing:
            if check.kind is RefusalKind.CORNERS_OVERLAP and check.subject not in refused:
                found.append((check.kind, check.subject, self._corners_at(check.subject)))
        blamed = {corner.name: corner for *_, corners in found for corner in corners}
        limits = {name: self._largest(corner) for name, corner in blamed.items()}
        full = {size for limit, beside, _ in limits.values() if limit < LEAST for size in beside}
        together: dict[str, float] = {}
        if full:
            crowd = [each for each in self.figure.corners if each.name in blamed or each.size in full]
            together = {"together": self._largest_together(crowd)}
        for kind, subject, corners in found:
            givens = tuple(corner.size for corner in corners)
            if kind is RefusalKind.CORNER_TOO_LARGE:
                (limit, beside, element), short = limits[subject], alone[subject][0]
                setback, length = setbacks_of(corners[0], self.measures)[short], self.measures.lengths[short]
                values = {"actual": self.path.sizes[givens[0]], "needed": setback, "available": length, "limit": limit}
                yield Refusal(kind, subject, givens, _numbers(values | together), beside, (short, element or short))
                continue
            room, length = self.measures.rooms[subject], self.measures.lengths[subject]
            values = {"limit": length, "actual": length - room, "off_by_mm": -room}
            for key, corner in zip(BESIDE, corners, strict=False):
                # What fits beside a corner that cannot stay as it is tells nothing.
                if not any(other is not corner and other.name in alone for other in corners):
                    values[key] = limits[corner.name][0]
            yield Refusal(kind, subject, givens, _numbers(values | together))

    def _corners_at(self, element: str) -> list[Corner]:
        return [corner for corner in self.figure.corners if element in setbacks_of(corner, self.measures)]

    def _largest(self, corner: Corner) -> tuple[float, tuple[str, ...], str | None]:
        """The largest size of a corner that passes the checks while its neighbours stay as they are (mm; 0 if none
        does), the sizes of the neighbours that limit it, and the element on which they do."""

        known = {self.path.sizes[corner.size]: self._left(self.measures, [corner])}

        def left(size: float) -> tuple[float, str | None]:
            if size not in known:
                known[size] = self._left(self.path.resize({corner.size: size}), [corner])
            return known[size]

        limit = largest_fitting(lambda size: left(size)[0], self.path.sizes[corner.size])
        _, element = left(limit + max(NEAR, NEAR * limit))
        others = (other for other in self.figure.corners if other is not corner)
        beside = tuple(other.size for other in others if element in elements_at(other, self.measures))
        return limit, beside, element

    def _largest_together(self, corners: Sequence[Corner]) -> float:
        """The size (mm) to which the larger ones of some corners must come down for all to fit; 0 if there is none."""
        sizes = {corner.size: self.path.sizes[corner.size] for corner in corners}

        def left(size: float) -> float:
            path = self.path.resize({name: min(own, size) for name, own in sizes.items()})
            return self._left(path, self.figure.corners)[0]

        return largest_fitting(left, max(sizes.values()))

    def _left(self, path: PathOutputs, corners: Sequence[Corner]) -> tuple[float, str | None]:
        """The least that some corners leave above what the checks ask for, mm, and the first element on which they
        leave less; not a number where a corner is none."""
        names = {corner.name for corner in corners}
        elements = {name for corner in corners for name in elements_at(corner, path)}
        room = check_room(replace(self.path.measured, path=path))
        left = [(path.corners[corner.name].setback_out + LENGTH, corner.before) for corner in corners]
        left += [
            (margin - check.limit, check.element) for check, margin in room if {check.subject} & (names | elements)
        ]
        least = min((each for each, _ in left), key=lambda each: (each >= 0, each))
        return least, next((name for each, name in left if not each >= 0), None)


def _numbers(values: Mapping[str, float]) -> dict[str, float]:
    """The values without what is no number."""
    return {name: value for name, value in values.items() if value == value}
