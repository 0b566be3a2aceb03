"""The picture of a contour inside HTML."""

from contoursolve.examine import Answer


def picture_of(answer: Answer) -> str:
    """The picture as one SVG element that takes the colours of its page."""
    corners = answer.contour.elements if answer.contour else ()
    path = " ".join(f"L{each.end[0]:.3f} {-each.end[1]:.3f}" for each in corners)
    start = answer.contour.start if answer.contour else (0.0, 0.0)
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 -100 200 200" width="400" role="img">'
        f"<title>{answer.status.value}</title>"
        f'<path d="M{start[0]:.3f} {-start[1]:.3f} {path}" fill="none" stroke="currentColor"/></svg>'
    )
