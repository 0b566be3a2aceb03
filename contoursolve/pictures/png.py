"""A page as PNG, painted by matplotlib without a window or any state: the same bytes for the same page."""

import io
from typing import Any
from warnings import catch_warnings, simplefilter

from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch, Polygon, Rectangle
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from contoursolve.pictures.metrics import width_of
from contoursolve.pictures.sheet import Anchor, Dot, Shape, Sheet, Stroke, Sweep, Text
from contoursolve.pictures.svg import points_on
from contoursolve.pictures.theme import Role, Theme

PIXELS = 96.0
"""Of a page in an inch, as in CSS."""

_POINTS = 72.0 / PIXELS
_PIECES = 96
_MOST = 12_000
"""Pixels of a side; a larger picture is no use to anybody and fills the memory."""


def write_png(sheet: Sheet, theme: Theme, title: str, dpi: float) -> bytes:
    """The page as PNG. Raises ValueError for a resolution out of range."""
    if not 1 <= dpi <= _MOST * PIXELS / max(sheet.width, sheet.height):
        raise ValueError(f"a picture of {sheet.width:.0f} x {sheet.height:.0f} pixels cannot be painted at {dpi:g} dpi")
    # A user's own settings change nothing.
    with catch_warnings(), rc_context({"path.simplify": False, "font.family": ["DejaVu Sans"], "text.usetex": False}):
        simplefilter("ignore")  # about characters that the font lacks; they are boxes then
        figure = Figure(figsize=(sheet.width / PIXELS, sheet.height / PIXELS), facecolor=theme.colors[Role.PAPER])
        canvas = FigureCanvasAgg(figure)
        _Painter(figure, sheet, theme).paint()
        stream = io.BytesIO()
        canvas.print_figure(
            stream, format="png", dpi=dpi, metadata={"Software": None, "Title": title}, facecolor=figure.get_facecolor()
        )
    return stream.getvalue()


class _Painter:
    """Adds what is on a page to a figure."""

    def __init__(self, figure: Figure, sheet: Sheet, theme: Theme) -> None:
        self.figure, self.sheet, self.colors = figure, sheet, theme.colors
        to_inches = Affine2D().scale(1 / PIXELS, -1 / PIXELS).translate(0, sheet.height / PIXELS)
        self.transform = to_inches + figure.dpi_scale_trans
        frame = sheet.frame
        self.clip = Rectangle(
            (frame.left, frame.top), frame.right - frame.left, frame.bottom - frame.top, transform=self.transform
        )

    def paint(self) -> None:
        """Everything, each item over those before it."""
        inside = len(self.sheet.drawing)
        for number, item in enumerate((*self.sheet.drawing, *self.sheet.around)):
            if isinstance(item, Stroke):
                self._stroke(item, number, is_clipped=number < inside)
            elif isinstance(item, Text):
                self._text(item, number)
            else:
                self._patch(item, number)

    def _add(self, artist: Any, number: int) -> None:
        artist.set_zorder(number)
        self.figure.add_artist(artist)

    def _stroke(self, stroke: Stroke, number: int, *, is_clipped: bool) -> None:
        places = [stroke.start]
        for step in stroke.steps:
            places += points_on(places[-1], step, _PIECES) if isinstance(step, Sweep) else [step]
        dash = [each / stroke.width for each in stroke.dash]
        patch = PathPatch(
            Path(places),
            fill=False,
            edgecolor=self.colors[stroke.role],
            linewidth=stroke.width * _POINTS,
            linestyle=(0, dash) if dash else "solid",
            capstyle="butt" if dash else "round",
            joinstyle="round",
            transform=self.transform,
        )
        self._add(patch, number)
        if is_clipped:
            patch.set_clip_path(self.clip)

    def _patch(self, item: Shape | Dot, number: int) -> None:
        color, paper = self.colors[item.role], self.colors[Role.PAPER]
        if isinstance(item, Shape):
            self._add(Polygon(item.corners, facecolor=color, edgecolor="none", transform=self.transform), number)
            return
        filled = color if item.is_filled else paper
        edge, width = ("none", 0.0) if item.is_filled else (color, 1.4 * _POINTS)
        disc = Circle(item.at, item.radius, facecolor=filled, edgecolor=edge, linewidth=width, transform=self.transform)
        self._add(disc, number)

    def _text(self, text: Text, number: int) -> None:
        x, y = text.at
        wide = width_of(text.words, text.size, is_bold=text.is_bold, is_mono=text.is_mono)
        several = len({run.role for run in text.runs}) > 1
        anchor = text.anchor
        if several:
            # Texts of several colours are painted one after the other.
            x -= {Anchor.START: 0.0, Anchor.MIDDLE: wide / 2, Anchor.END: wide}[anchor]
            anchor = Anchor.START
        align = {Anchor.START: "left", Anchor.MIDDLE: "center", Anchor.END: "right"}[anchor]
        pieces = [(run.text, run.role) for run in text.runs] if several else [(text.words, text.runs[0].role)]
        for words, role in pieces:
            self.figure.text(
                x,
                y,
                words,
                fontsize=text.size * _POINTS,
                fontfamily="DejaVu Sans Mono" if text.is_mono else "DejaVu Sans",
                fontweight="bold" if text.is_bold else "normal",
                color=self.colors[role],
                ha=align,
                va="baseline",
                rotation=90 if text.is_turned else 0,
                rotation_mode="anchor",
                transform=self.transform,
                parse_math=False,
                zorder=number,
            )
            x += width_of(words, text.size, is_bold=text.is_bold, is_mono=text.is_mono)
