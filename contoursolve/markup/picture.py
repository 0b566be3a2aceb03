"""Pictures for a page: SVG elements that take its colours."""

from contoursolve.examine import Answer
from contoursolve.families import Family, Feasible, Region
from contoursolve.pictures import Theme, draw_answer, draw_family_map, draw_range, draw_region, draw_result
from contoursolve.pipeline import Result

Drawable = Answer | Result | Family | Feasible | Region
"""What has a picture."""


def picture_of(record: Drawable) -> str:
    """The picture of a contour, of all contours of a program, or of where a block has one by one or two of its words.

    Raises ValueError for a family that is no grid of two words.
    """
    if isinstance(record, Result):
        return draw_result(record, theme=Theme.PAGE).svg
    if isinstance(record, Family):
        return draw_family_map(record, theme=Theme.PAGE).svg
    if isinstance(record, Feasible):
        return draw_range(record, theme=Theme.PAGE).svg
    if isinstance(record, Region):
        return draw_region(record, theme=Theme.PAGE).svg
    return draw_answer(record, theme=Theme.PAGE).svg
