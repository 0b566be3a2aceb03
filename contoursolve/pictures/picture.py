"""A picture that is finished: its SVG, its title and description, and its PNG on demand."""

from dataclasses import dataclass, field

from contoursolve.extras import importing
from contoursolve.pictures.sheet import Sheet
from contoursolve.pictures.svg import write_svg
from contoursolve.pictures.theme import Theme

DPI = 144.0
"""Pixels in an inch of a PNG; a page has 96."""


@dataclass(frozen=True, slots=True)
class Picture:
    """A drawing; `width` and `height` are in pixels of CSS. `svg` is one element without an XML declaration."""

    svg: str = field(repr=False)
    title: str
    description: str
    width: float
    height: float
    sheet: Sheet = field(repr=False)
    theme: Theme = Theme.LIGHT

    def _repr_svg_(self) -> str:
        """The drawing, as a notebook asks for it."""
        return self.svg

    def png(self, dpi: float = DPI) -> bytes:
        """The drawing as PNG. Raises MissingExtraError without matplotlib, ValueError for a resolution out of range."""
        with importing("picture", "a PNG picture"):
            from contoursolve.pictures.png import write_png  # noqa: PLC0415 - an extra, and slow to import
        return write_png(self.sheet, self.theme, self.title, dpi)


def finish(sheet: Sheet, theme: Theme, title: str, description: str) -> Picture:
    """The picture of a page."""
    return Picture(
        write_svg(sheet, theme, title, description), title, description, sheet.width, sheet.height, sheet, theme
    )
