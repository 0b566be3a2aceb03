"""The picture of a contour inside HTML."""

from contoursolve.examine import Answer
from contoursolve.pictures import Theme, draw_answer


def picture_of(answer: Answer) -> str:
    """The picture as one SVG element that takes the colours of its page."""
    return draw_answer(answer, theme=Theme.PAGE).svg
