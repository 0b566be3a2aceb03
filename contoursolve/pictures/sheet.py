"""A page that is laid out, and pages under each other."""

from dataclasses import dataclass, field

from msgspec.structs import replace

from contoursolve.pictures.margins import Placement
from contoursolve.pictures.page import WIDTH, Box, Item, Shape, Spot, Stroke, Sweep, Text


@dataclass(frozen=True, slots=True)
class Sheet:
    """A page, as wide as all are: the drawing, which ends at its frame, and what stands around it, as it is painted."""

    title: str
    height: float
    frame: Box
    drawing: tuple[Item, ...] = field(repr=False)
    around: tuple[Item, ...] = field(default=(), repr=False)
    placement: Placement | None = field(default=None, repr=False, compare=False)
    """The layout of the drawing, if there is one."""

    @property
    def texts(self) -> tuple[Text, ...]:
        """All texts."""
        return tuple(item for item in (*self.drawing, *self.around) if isinstance(item, Text))


def stack_sheets(sheets: list[Sheet]) -> Sheet:
    """Pages under each other as one."""
    if len(sheets) == 1:
        return sheets[0]
    drawing: list[Item] = []
    around: list[Item] = []
    height = 0.0
    for sheet in sheets:
        drawing += [_shift(item, height) for item in sheet.drawing]
        around += [_shift(item, height) for item in sheet.around]
        height += sheet.height
    frame = Box(4.0, sheets[0].frame.top, WIDTH - 4.0, height)
    return Sheet(sheets[0].title, round(height, 1), frame, tuple(drawing), tuple(around))


def _shift(item: Item, by: float) -> Item:
    """An item farther down the page."""

    def down(spot: Spot) -> Spot:
        return spot[0], spot[1] + by

    if isinstance(item, Shape):
        return replace(item, corners=tuple(map(down, item.corners)))
    if isinstance(item, Stroke):
        steps = (
            replace(step, center=down(step.center), end=down(step.end)) if isinstance(step, Sweep) else down(step)
            for step in item.steps
        )
        return replace(item, start=down(item.start), steps=tuple(steps))
    return replace(item, at=down(item.at))
