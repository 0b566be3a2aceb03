"""The line that a last corner meets, stated instead of the axis-parallel one of the manual."""

from dataclasses import dataclass, replace
from decimal import Decimal

from contoursolve.constraints import Through
from contoursolve.model import Corner, Fact, Line, Unit
from contoursolve.statements.draft import Draft, StatementError


@dataclass(frozen=True, slots=True)
class Meeting:
    """A line from the corner's virtual intersection: to a place, or at an angle; neither where the next block tells."""

    to: tuple[Decimal, Decimal] | None
    angle: Decimal | None


@dataclass(frozen=True, slots=True)
class MeetsLine:
    """A last corner joins its line to this one.

    A 45 degree chamfer runs in the quadrant of the direction midway between the two lines: of the four, the one
    that is nearest to equal setbacks, and the only one that fits unless the path turns by more than 90 degrees. For a
    line parallel to an axis this is what the manual's tables say. Where the two directions cancel along an axis, so
    that two quadrants are equally near, it goes on there as the line before it; if the size is asked for, that stays
    undecided. A line to a place must be long
    enough for the corner.
    """

    corner: str
    line: Meeting

    def state(self, draft: Draft, name: str) -> Fact:
        corner = draft.element(self.corner)
        if not isinstance(corner, Corner) or corner.after is not None:
            raise StatementError(f"{self.corner} is no last corner")
        line = f"{self.corner}.landing"
        if any(each.name == line for each in draft.figure.lines):
            raise StatementError(f"the line that {self.corner} meets is stated twice")
        if self.line.angle is not None:
            heading = draft.give(name, self.line.angle, Unit.DEGREE)
            added = Line(line, corner.at, "", heading)
        elif self.line.to is not None:
            draft.give(name, Decimal(0), Unit.SIGN)
            added = Line(line, corner.at, draft.place(f"{name}.place", self.line.to))
        else:
            raise StatementError("there is no next block with a line whose end is known")
        corners = tuple(
            replace(each, lands_on=line, lands_parallel_to=None) if each.name == self.corner else each
            for each in draft.figure.corners
        )
        draft.figure = replace(draft.figure, lines=(*draft.figure.lines, added), corners=corners)
        draft.line(line)
        return Through(line, corner.at, name)
