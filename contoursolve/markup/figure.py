"""A picture in HTML."""

import htpy as h
from markupsafe import Markup

from contoursolve.markup.picture import Drawable, picture_of


def figure(record: Drawable) -> h.Element:
    """The picture; where it cannot be drawn the page says so, and its tables say the same."""
    try:
        return h.figure[Markup(picture_of(record))]  # our own painter escapes
    except Exception as error:  # numbers that nobody draws must not keep the rest from the reader
        return h.p[f"This cannot be drawn ({type(error).__name__})."]
