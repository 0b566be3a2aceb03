"""A page while it is filled: what is on it, and where there is room."""

from collections.abc import Sequence

from contoursolve.pictures.arrows import line
from contoursolve.pictures.labels import Grid, nearest, needs_leader, place_label
from contoursolve.pictures.metrics import ASCENT, DESCENT, width_of
from contoursolve.pictures.sheet import Anchor, Box, Item, Run, Shape, Spot, Stroke, Sweep, Text
from contoursolve.pictures.svg import points_on
from contoursolve.pictures.theme import Role
from contoursolve.pictures.view import View

SIZE = 12.0
"""Pixels. Font size of labels."""

PATH_WEIGHT, THIN_WEIGHT, FAINT_WEIGHT = 40.0, 4.0, 1.5
"""How little a label likes to stand on a path, on a thin line of a word, and on a line of construction."""

_PIECES = 10


class Canvas:
    """Items in the order in which they are painted: thin lines, paper behind labels, the path, labels."""

    def __init__(self, view: View, frame: Box) -> None:
        self.view, self.frame = view, frame
        self.grid = Grid(frame)
        self.thin: list[Item] = []
        self.papers: list[Item] = []
        self.thick: list[Item] = []
        self.texts: list[Text] = []
        self.homeless: list[str] = []
        """Labels for which there was no room."""

    def draw(self, item: Stroke, weight: float = THIN_WEIGHT) -> None:
        """A stroke, with what it weighs against labels; what weighs most is painted over the paper of labels."""
        (self.thick if weight >= PATH_WEIGHT else self.thin).append(item)
        here = item.start
        for step in item.steps:
            spots = points_on(here, step, _PIECES) if isinstance(step, Sweep) else [step]
            for spot in spots:
                self.grid.mark(here, spot, weight)
                here = spot

    def fill(self, shape: Shape) -> None:
        """An arrowhead."""
        self.thick.append(shape)
        first = shape.corners[0]
        for corner in shape.corners[1:]:
            self.grid.mark(first, corner, THIN_WEIGHT)

    def write(self, text: Text) -> bool:
        """A text where it is wanted, if nothing is there yet; tells whether it stands."""
        box = text.box.grow(1.0)
        if not self.frame.holds(box) or any(box.meets(other) for other in self.grid.taken):
            return False
        self._add(text, box)
        return True

    def _add(self, text: Text, box: Box) -> None:
        """A text on paper, so that thin lines stop at it."""
        self.texts.append(text)
        self.papers.append(
            Shape(
                ((box.left, box.top), (box.right, box.top), (box.right, box.bottom), (box.left, box.bottom)), Role.PAPER
            )
        )
        self.grid.take(box)

    @property
    def items(self) -> tuple[Item, ...]:
        """Everything, in the order in which it is painted."""
        return (*self.thin, *self.papers, *self.thick, *self.texts)

    def label(
        self, at: Spot, choices: Sequence[tuple[Run, ...]], away: Spot, role: Role, *, leads: bool = False
    ) -> Box | None:
        """A label near a place, in the first of these wordings that finds room; with a leader where it is far, or
        always if it `leads`. The box where it stands; None if there is no room."""
        wordings = [runs for runs in choices if runs]
        if not wordings:
            return None
        sizes = [
            (width_of("".join(run.text for run in runs), SIZE) + 4.0, SIZE * (ASCENT + DESCENT) + 2.0)
            for runs in wordings
        ]
        found = place_label(self.grid, at, sizes, away, leads)
        if found is None:
            self.homeless.append("".join(run.text for run in wordings[0]))
            return None
        index, box = found
        if leads or needs_leader(box, at):
            self.draw(line(nearest(box, at), at, role, 0.9, is_dashed=leads))
        self._add(
            Text(((box.left + box.right) / 2, box.bottom - 1.0 - DESCENT * SIZE), wordings[index], SIZE, Anchor.MIDDLE),
            box,
        )
        return box
