"""A page while it is filled: what is on it, and where labels find room: off the path, off other labels, near what
they belong to."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from math import ceil, cos, hypot, inf, pi, sin

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.pictures.page import (
    ANYTHING,
    ASCENT,
    DESCENT,
    SIZE,
    About,
    Anchor,
    Box,
    Item,
    Shape,
    Spot,
    Stroke,
    Sweep,
    Text,
    TextRun,
    line,
    width_of,
)
from contoursolve.pictures.scene import Viewport
from contoursolve.pictures.theme import Role
from contoursolve.solving import along, distance, minus

PATH_WEIGHT, THIN_WEIGHT, FAINT_WEIGHT = 40.0, 4.0, 1.5
"""Costs of a cell under a label: on a path, on a thin line of a word, and on a construction line."""

_PIECES = 10

CELL = 6.0
"""Pixels of a side of a cell in which what is drawn is counted."""

_SAMPLED = 0.3
"""1. How far apart, in sides of a cell, the places of a line are that are counted."""

_FAR = (9.0, 15.0, 24.0, 36.0, 52.0, 72.0, 100.0, 140.0, 190.0)
"""Pixels from a place to the nearest point of its label, tried in this order."""

_BESIDE = 36.0
"""Pixels. A label of a part's drawing that is farther had better be short."""

_WAYS = 16
_TURNS = tuple(
    (cos(number * 2 * pi / _WAYS), sin(number * 2 * pi / _WAYS), min(number, _WAYS - number) * 2 * pi / _WAYS)
    for number in sorted(range(_WAYS), key=lambda number: (min(number, _WAYS - number), number))
)
"""Cosine and sine of the turns from the wanted direction that are tried, and their sizes (radians), in order."""

_PER_PIXEL = 0.35
"""Cost of a pixel of distance."""

_BACKWARDS, _ELSEWHERE = 6.3, 5.0
"""Costs of a label on the other side of its place, and of one that points at a further place."""

_ILLEGIBLE = 400.0
"""Cost above which a label would hide something illegibly: ten cells of a path."""

_TOUCHING = 20.0
"""Pixels. A label that is no farther needs no leader."""


def clip(a: Spot, b: Spot, box: Box) -> tuple[Spot, Spot] | None:
    """The part of a line inside a box (Liang and Barsky 1984); None if it is outside."""
    low, high = 0.0, 1.0
    step = minus(b, a)
    for start, way, least, most in zip(a, step, (box.left, box.top), (box.right, box.bottom), strict=True):
        if way == 0:
            if not least <= start <= most:
                return None
            continue
        near, far = sorted(((least - start) / way, (most - start) / way))
        low, high = max(low, near), min(high, far)
    if low > high:
        return None
    return along(a, step, low), along(a, step, high)


def _boxes_around(at: Spot, width: float, height: float, away: Spot) -> Iterable[tuple[Box, float, float]]:
    """Boxes of a size near a place with their distance and how far they are turned from the wanted direction
    (radians), nearest first."""
    ways = [
        ((away[0] * cosine - away[1] * sine, away[0] * sine + away[1] * cosine), turned)
        for cosine, sine, turned in _TURNS
    ]
    for far in _FAR:
        for way, turned in ways:
            # The box stands so that its nearest point is as far as it should be.
            middle = at[0] + way[0] * (far + width / 2), at[1] + way[1] * (far + height / 2)
            shifts: tuple[float, ...] = (0.0,)
            if abs(way[0]) < 0.2:  # noqa: PLR2004 - right above or below
                middle, shifts = (at[0], middle[1]), (0.0, width / 2 - 8.0, 8.0 - width / 2)
            for shift in shifts:
                x, y = middle[0] + shift, middle[1]
                yield Box(x - width / 2, y - height / 2, x + width / 2, y + height / 2), far, turned


def _place_label(
    canvas: "Canvas", at: Spot, sizes: Sequence[tuple[float, float]], away: Spot, leads: bool
) -> tuple[int, Box] | None:
    """The best box for a label near a place, with the index of its size; the first size is preferred. None without
    room. `leads` tells that the label always has a leader."""
    for index, (width, height) in enumerate(sizes):
        best: tuple[float, Box] | None = None
        for box, far, turned in _boxes_around(at, width, height, away):
            if leads and far < _TOUCHING:
                continue
            is_last = index == len(sizes) - 1
            if (best is not None and far * _PER_PIXEL >= best[0]) or (far > canvas.farthest and not is_last):
                break
            own = far * _PER_PIXEL + turned * 2.0 + (8.0 if far > _TOUCHING and not leads else 0.0)
            if best is not None and own >= best[0]:
                continue
            cost = own + canvas.cost(box.grow(1.5))
            if cost - own >= canvas.most or (far > _TOUCHING and canvas.is_crossed(at, _nearest(box, at))):
                continue
            if far > _TOUCHING:
                cost += canvas.crossings(_nearest(box, at), at)
            if best is None or cost < best[0]:
                best = cost, box
        if best is not None:
            return index, best[1]
    return None


def _nearest(box: Box, at: Spot) -> Spot:
    """The point of a box where a leader from a place ends: the middle of a side, or a point of the nearer side."""
    x = min(max(at[0], box.left), box.right)
    y = min(max(at[1], box.top), box.bottom)
    if at[0] < box.left or at[0] > box.right:
        return x, (box.top + box.bottom) / 2
    return x, y


def _needs_leader(box: Box, at: Spot) -> bool:
    """Whether a label is so far from its place that a line must join them."""
    return distance(_nearest(box, at), at) > _TOUCHING


def _on_ray(box: Box, at: Spot, way: Spot) -> Spot | None:
    """The point of a box that is nearest to a place on the line through it along a direction; None beside the line."""
    reach = 2 * (distance(at, (box.left, box.top)) + box.right - box.left)
    ends = clip(along(at, way, -reach), along(at, way, reach), box)
    return min(ends, key=lambda end: distance(end, at)) if ends is not None else None


def _boxes_on_ray(at: Spot, width: float, height: float, way: Spot) -> Iterator[tuple[Box, float]]:
    """Boxes of a size at which a ray ends, with how little they are wanted: beyond the place, then before it; with the
    middle on the ray, or beside its end."""
    half = min(size / 2 / abs(step) for size, step in zip((width, height), way, strict=True) if step)
    for far in (far for far in _FAR if far > _TOUCHING):
        for sign in (1.0, -1.0):
            own, end = far * _PER_PIXEL + (_BACKWARDS if sign < 0 else 0.0), along(at, way, sign * far)
            beside = [(end[0] + side * width / 2, end[1]) for side in (1.0, -1.0)]
            for number, (x, y) in enumerate((along(end, way, sign * half), *beside)):
                yield Box(x - width / 2, y - height / 2, x + width / 2, y + height / 2), own + 2.0 * number


class LabelSpot(Struct, frozen=True):
    """Position of a label beside its place, pixels: `way` is the distance to its nearer edge, across and down. `sides`
    tells on which side that edge is (-1, 1; 0 for a label over the place, by its middle)."""

    way: Spot
    sides: tuple[int, int]

    def box(self, at: Spot, width: float, height: float) -> Box:
        """The box of a label of another size beside another place."""
        x, y = (at[axis] + self.way[axis] + self.sides[axis] * size / 2 for axis, size in enumerate((width, height)))
        return Box(x - width / 2, y - height / 2, x + width / 2, y + height / 2)


class Grip(Struct, frozen=True):
    """The handle of a word on a page: the tip of its arrow, and the centre about which that turns."""

    word: str
    at: Spot
    center: Spot | None = None


def spot_of(at: Spot, box: Box) -> LabelSpot:
    """The position of a label's box relative to a place."""
    middles, sizes = (
        ((box.left + box.right) / 2, (box.top + box.bottom) / 2),
        (box.right - box.left, box.bottom - box.top),
    )
    off = minus(middles, at)
    first, second = (0 if abs(way) < size / 2 else 1 if way > 0 else -1 for way, size in zip(off, sizes, strict=True))
    way = off[0] - first * sizes[0] / 2, off[1] - second * sizes[1] / 2
    return LabelSpot(way, (first, second))


class Canvas:
    """Items in the order in which they are painted: thin lines, paper behind labels, the path, labels."""

    def __init__(self, view: Viewport, frame: Box, held: Mapping[tuple[About, int], LabelSpot] | None = None) -> None:
        self.view, self.frame = view, frame
        self.held = held or {}
        """Where labels stood in the picture before."""
        self.labels: dict[tuple[About, int], LabelSpot] = {}
        """Where they stand now, by what they show and their number of those that show the same."""
        self.columns = ceil((frame.right - frame.left) / CELL) + 1
        rows = ceil((frame.bottom - frame.top) / CELL) + 1
        self.cells = [0.0] * (self.columns * rows)
        """How much is drawn in each cell of the frame."""
        self.taken: list[Box] = []
        """Where texts stand."""
        self.signs: list[Box] = []
        """Where centres and virtual intersections are marked, which no text covers."""
        self.grips: list[Grip] = []
        self.thin: list[Item] = []
        self.papers: list[Item] = []
        self.thick: list[Item] = []
        self.texts: list[Text] = []
        self.most = _ILLEGIBLE
        """Cost above which a label would hide something illegibly."""
        self.farthest = inf
        """Pixels from a place to its label; farther, a shorter one comes first."""
        self.head_weight = THIN_WEIGHT
        """What an arrowhead weighs against labels."""
        self.homeless: list[str] = []
        """Labels for which there was no room."""
        self.named = ANYTHING
        """What is being drawn."""

    def keep_clear(self) -> None:
        """From now on no text stands on a path, an arrowhead or a sign of a point, whatever that costs."""
        self.most, self.head_weight, self.farthest = PATH_WEIGHT, PATH_WEIGHT, _BESIDE

    @contextmanager
    def about(self, named: About) -> Iterator[None]:
        """Mark everything drawn within as showing `named`."""
        self.named = named
        yield
        self.named = ANYTHING

    def draw(self, item: Stroke, weight: float = THIN_WEIGHT) -> None:
        """A stroke, with what it weighs against labels; what weighs most is painted over the paper of labels."""
        item = replace(item, about=self.named)
        (self.thick if weight >= PATH_WEIGHT else self.thin).append(item)
        here = item.start
        for step in item.steps:
            spots = step.spots(here, _PIECES) if isinstance(step, Sweep) else [step]
            for spot in spots:
                self._mark(here, spot, weight)
                here = spot

    def fill(self, shape: Shape) -> None:
        """An arrowhead."""
        self.thick.append(replace(shape, about=self.named))
        first = shape.corners[0]
        for corner in shape.corners[1:]:
            self._mark(first, corner, self.head_weight)

    def write(self, text: Text) -> bool:
        """A text where it is wanted, if nothing is there yet; tells whether it stands."""
        box = text.box.grow(1.0)
        if not self.frame.holds(box) or any(box.meets(other) for other in (*self.taken, *self.signs)):
            return False
        self._add(text, box)
        return True

    def _add(self, text: Text, box: Box) -> None:
        """A text on paper, so that thin lines stop at it."""
        is_named = self.named != ANYTHING
        runs = tuple(
            replace(run, is_underlined=run.role is Role.CONFLICTING and (is_named or run.about != ANYTHING))
            for run in text.runs
        )
        self.texts.append(replace(text, runs=runs, about=self.named))
        self.papers.append(box.filled(Role.PAPER))
        self.taken.append(box)

    @property
    def items(self) -> tuple[Item, ...]:
        """Everything, in the order in which it is painted."""
        return (*self.thin, *self.papers, *self.thick, *self.texts)

    def label(
        self, at: Spot, choices: Sequence[tuple[TextRun, ...]], away: Spot, role: Role, *, leads: bool = False
    ) -> Box | None:
        """A label near a place, in the first of these wordings that finds room; with a leader where it is far, or
        always if it `leads`. The box where it stands; None if there is no room."""
        wordings = [runs for runs in choices if runs]
        if not wordings or (self.held and not self.frame.holds(Box(*at, *at))):
            return None  # what moved out of a picture that is held is named again when the picture is fitted
        high = SIZE * (ASCENT + DESCENT) + 2.0
        sizes = [(width_of("".join(run.text for run in runs), SIZE) + 4.0, high) for runs in wordings]
        name = self._next_name()
        found = self._place_as_before(at, sizes, name) or _place_label(self, at, sizes, away, leads)
        if found is None:
            self.homeless.append("".join(run.text for run in wordings[0]))
            return None
        index, box = found
        self.labels[name] = spot_of(at, box)
        if leads or _needs_leader(box, at):
            self.draw(line(_nearest(box, at), at, role, 0.9, is_dashed=leads))
        self._write_in(box, wordings[index])
        return box

    def point(self, places: Sequence[tuple[Spot, Spot]], told: TextRun) -> tuple[Box, Spot] | None:
        """A label with a leader on a ray: at one of some places, each with the direction of its ray, the wanted one
        first. The box where it stands, and the place; None if there is no room."""
        at, way = places[0]
        if self.held and not self.frame.holds(Box(*at, *at)):
            return None  # as above
        size = width_of(told.text, SIZE) + 4.0, SIZE * (ASCENT + DESCENT) + 2.0
        name = self._next_name()
        before = self._place_as_before(at, [size], name)
        found = (before[1], at, way) if before and _on_ray(before[1], at, way) else self._best_on_ray(places, size)
        if found is None:
            self.homeless.append(told.text)
            return None
        box, at, way = found
        self.labels[name] = spot_of(at, box)
        self.draw(line(_on_ray(box, at, way) or _nearest(box, at), at, told.role, 0.9))
        self._write_in(box, (told,))
        return box, at

    def _best_on_ray(
        self, places: Sequence[tuple[Spot, Spot]], size: tuple[float, float]
    ) -> tuple[Box, Spot, Spot] | None:
        """The cheapest box for a label on one of several rays, with the end of its leader and the place."""
        best: tuple[float, Box, Spot, Spot] | None = None
        for number, (at, way) in enumerate(places):
            if not self.frame.holds(Box(*at, *at)):
                continue
            for box, own in _boxes_on_ray(at, *size, way):
                if best is not None and own + number * _ELSEWHERE >= best[0]:
                    continue
                end = _on_ray(box, at, way) or at
                cost = own + number * _ELSEWHERE + self.cost(box.grow(1.5))
                if cost - own - number * _ELSEWHERE < self.most and not self.is_crossed(at, end):
                    cost += self.crossings(end, at)
                    if best is None or cost < best[0]:
                        best = cost, box, at, way
        return best[1:] if best is not None else None

    def _write_in(self, box: Box, runs: tuple[TextRun, ...]) -> None:
        """The text of a label."""
        at = (box.left + box.right) / 2, box.bottom - 1.0 - DESCENT * SIZE
        self._add(Text(at, runs, SIZE, Anchor.MIDDLE), box)

    def _next_name(self) -> tuple[About, int]:
        """The name of the next label, and the count of labels with the same name so far."""
        return self.named, sum(about == self.named for about, _ in self.labels)

    def _place_as_before(
        self, at: Spot, sizes: Sequence[tuple[float, float]], name: tuple[About, int]
    ) -> tuple[int, Box] | None:
        """The box of a label on the side where it stood before, if nothing is there now; else None."""
        if name not in self.held:
            return None
        boxes = (self.held[name].box(at, *size) for size in sizes)
        return next(((index, box) for index, box in enumerate(boxes) if self.cost(box.grow(1.5)) < inf), None)

    def _cell(self, at: Spot, step: Spot, share: float) -> int:
        """The number of the cell after a share of a step from a place."""
        column = int((at[0] + step[0] * share - self.frame.left) / CELL)
        return int((at[1] + step[1] * share - self.frame.top) / CELL) * self.columns + column

    def _mark(self, a: Spot, b: Spot, weight: float) -> None:
        """A line is drawn."""
        clipped = clip(a, b, self.frame)
        if clipped is None:
            return
        step = minus(clipped[1], clipped[0])
        steps = max(1, ceil(hypot(*step) / (CELL * _SAMPLED)))
        for number in range(steps + 1):
            place = self._cell(clipped[0], step, number / steps)
            if 0 <= place < len(self.cells):
                self.cells[place] = max(self.cells[place], weight)

    def cost(self, box: Box) -> float:
        """The cost of a text in a box; infinite over another text, or outside the page."""
        if not self.frame.holds(box):
            return inf
        for boxes in (self.taken, self.signs):
            for other in boxes:
                if box.meets(other):
                    return inf
        total = 0.0
        first, last = int((box.left - self.frame.left) / CELL), int((box.right - self.frame.left) / CELL)
        for row in range(int((box.top - self.frame.top) / CELL), int((box.bottom - self.frame.top) / CELL) + 1):
            total += sum(self.cells[row * self.columns + first : row * self.columns + last + 1])
        return total

    def crossings(self, a: Spot, b: Spot) -> float:
        """The cost of a line to a place `b`, without the cells right beside it."""
        length, step = distance(b, a), minus(b, a)
        total = 0.0
        for number in range(int((length - CELL * 1.5) / CELL)):
            place = self._cell(a, step, number * CELL / length)
            total += self.cells[place] if 0 <= place < len(self.cells) else 0.0
        return total

    def is_crossed(self, a: Spot, b: Spot) -> bool:
        """Whether a line would run through a text."""
        (left, right), (top, bottom) = sorted((a[0], b[0])), sorted((a[1], b[1]))
        return any(
            clip(a, b, box) is not None
            for box in self.taken
            if box.left <= right and left <= box.right and box.top <= bottom and top <= box.bottom
        )
