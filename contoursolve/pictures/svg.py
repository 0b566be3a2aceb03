"""A page as SVG and as PNG: a few hundred short elements, the same bytes for the same page.

Texts stay texts, so that they can be found and read aloud. Colours are attributes that every viewer knows; for a page
of HTML a style sheet overrules them, under an identity that is made of the picture itself.
"""

import struct
from base64 import b64encode
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from hashlib import sha256
from math import pi, tau
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape, quoteattr
from zlib import crc32

from contoursolve.diagnostics import MissingExtraError, importing
from contoursolve.numeric import trimmed
from contoursolve.pictures.page import ANYTHING, WIDTH, About, Dot, Item, Shape, Spot, Stroke, Sweep, Text, TextRun
from contoursolve.pictures.sheet import Sheet
from contoursolve.pictures.theme import CHAINS, DARK_COLORS, LEVELS, LIGHT_COLORS, TOOLS, Role, Theme

SANS = "'DejaVu Sans', Verdana, 'Liberation Sans', Arial, sans-serif"
MONO = "'DejaVu Sans Mono', Menlo, Consolas, 'Liberation Mono', monospace"

PIXELS, DPI = 96.0, 144.0
"""Pixels in an inch: of a page, as in CSS, and of a PNG."""

_LARGEST = 12_000
"""Pixels of a side; a larger picture is no use to anybody and fills the memory."""

_FLAT = 3_000.0
"""Pixels. Viewers round large numbers: an arc of a larger radius is drawn in straight pieces."""

_PIECES = 48


@dataclass(frozen=True, slots=True)
class Picture:
    """A drawing.

    Attributes:
        svg: one element of SVG, without an XML declaration.
        title: its title.
        description: what it shows, in words, for who cannot see it.
        width: pixels of CSS, a unit of length.
        height: the same.
        sheet: the parts that it is made of.
        theme: its colours.
    """

    svg: str = field(repr=False)
    title: str
    description: str
    width: float
    height: float
    sheet: Sheet = field(repr=False)
    theme: Theme = Theme.LIGHT

    @property
    def frame(self) -> dict[str, Any]:
        """The place of the plane's zero, pixels for each mm, and the size of the page, for what a page draws over it;
        empty for a picture of no plane."""
        if self.sheet.placement is None:
            return {}
        view = self.sheet.placement.view
        return {"origin": [*view.place((0.0, 0.0))], "scale": view.scale, "width": self.width, "height": self.height}

    def _repr_svg_(self) -> str:
        """The drawing, as a notebook asks for it."""
        return self.svg

    def _repr_html_(self) -> str:
        """The drawing as an image. A notebook that nobody trusts shows it, and takes elements of SVG out."""
        drawn = b64encode(self.svg.encode()).decode()
        told = quoteattr(_known(self.description))
        return f'<img src="data:image/svg+xml;base64,{drawn}" width="{self.width:.0f}" alt={told}>'

    def png(self, dpi: float = DPI) -> bytes:
        """The drawing as PNG, light for a page. Raises MissingExtraError without resvg or without a font for it,
        ValueError for a resolution out of range."""
        if not 1 <= dpi <= _LARGEST * PIXELS / max(self.width, self.height):
            raise ValueError(
                f"a picture of {self.width:.0f} x {self.height:.0f} pixels cannot be painted at {dpi:g} dpi"
            )
        is_page = self.theme is Theme.PAGE
        svg = write_svg(self.sheet, Theme.LIGHT, self.description) if is_page else self.svg
        if not _has_fonts():
            raise MissingExtraError("a PNG picture needs a font for its texts, such as DejaVu Sans; none is installed")
        png, meter = _painted(svg, dpi / PIXELS), round(dpi / 0.0254)
        # Behind the 33 bytes of signature and header: the resolution, and the title (PNG, third edition, 11.3).
        size = _chunk(b"pHYs", struct.pack(">IIB", meter, meter, 1))
        return png[:33] + size + _chunk(b"iTXt", b"Title\0\0\0\0\0" + _known(self.title).encode()) + png[33:]

    def save(self, path: str | Path, dpi: float = DPI) -> None:
        """Write the drawing: as SVG or, at a resolution, as PNG, by the ending of the file's name. Raises ValueError
        for another ending, and as `png`."""
        target = Path(path)
        match target.suffix.lower():
            case ".svg":
                target.write_text(self.svg + "\n", encoding="utf-8", newline="\n")
            case ".png":
                target.write_bytes(self.png(dpi))
            case ending:
                told = "; contoursolve.export(result, path) makes a drawing for CAD" if ending == ".dxf" else ""
                raise ValueError(f"{target}: a picture ends in .svg or .png{told}")


def _painted(svg: str, zoom: float = 1.0) -> bytes:
    with importing("picture", "a PNG picture"):
        from resvg_py import svg_to_bytes  # noqa: PLC0415 - an extra
    return bytes(svg_to_bytes(svg_string=svg, zoom=zoom))


@cache
def _has_fonts() -> bool:
    """Whether texts are painted in both of our fonts: without one, resvg leaves them out and says nothing."""
    frame = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">{}</svg>'
    texts = (frame.format(f'<text y="9" font-family="{family}">X</text>') for family in (SANS, MONO))
    return all(_painted(text) != _painted(frame.format("")) for text in texts)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", crc32(kind + data))


def finish(sheet: Sheet, theme: Theme, description: str = "") -> Picture:
    """The picture of a page; what its title says is description enough where there is no other one."""
    told = description or sheet.title
    return Picture(write_svg(sheet, theme, told), sheet.title, told, WIDTH, sheet.height, sheet, theme)


def write_svg(sheet: Sheet, theme: Theme, description: str) -> str:
    """The page as one SVG element, without an XML declaration, so that it can stand in HTML."""
    drawing, around = ("".join(_element(item, theme) for item in items) for items in (sheet.drawing, sheet.around))
    body = drawing + around
    about = "\0".join((theme.value, sheet.title, description, body)).encode(errors="backslashreplace")
    name = "cs-" + sha256(about).hexdigest()[:12]
    wide, high = _number(WIDTH), _number(sheet.height)
    frame = sheet.frame
    clip = (
        f'<clipPath id="{name}-frame"><rect x="{_number(frame.left)}" y="{_number(frame.top)}" '
        f'width="{_number(frame.right - frame.left)}" height="{_number(frame.bottom - frame.top)}"/></clipPath>'
    )
    style = _style(name, body) if theme is Theme.PAGE else ""
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" id="{name}" role="img" aria-labelledby="{name}-title {name}-text" '
        f'width="{wide}" height="{high}" viewBox="0 0 {wide} {high}" font-family="{SANS}" fill="none">'
        f'<title id="{name}-title">{_clean(sheet.title)}</title><desc id="{name}-text">{_clean(description)}</desc>'
        f"<defs>{clip}</defs>{style}"
        f'<rect width="{wide}" height="{high}" {_paint("fill", Role.PAPER, theme)}/>'
        f'<g clip-path="url(#{name}-frame)">{drawing}</g>{around}</svg>\n'
    )


def _style(name: str, body: str) -> str:
    """Rules that colour one picture as the page or its reader wants it."""
    roles = [role for role in Role if role not in (*CHAINS, *TOOLS, *LEVELS) or f'-{role.value}"' in body]
    light = "".join(_rule(f"#{name}", role, LIGHT_COLORS[role]) for role in roles)
    dark = "".join(_rule(f"#{name}", role, DARK_COLORS[role]) for role in roles)
    return f"<style>{light}@media (prefers-color-scheme:dark){{{dark}}}</style>"


def _rule(name: str, role: Role, color: str) -> str:
    value = f"var(--cs-{role.value},{color})"
    return f"{name} .s-{role.value}{{stroke:{value}}}{name} .f-{role.value}{{fill:{value}}}"


def _paint(what: str, role: Role, theme: Theme) -> str:
    """A colour as an attribute, and as a class where the page may change it."""
    attribute = f'{what}="{theme.colors[role]}"'
    return f'{attribute} class="{what[0]}-{role.value}"' if theme is Theme.PAGE else attribute


def _names(about: About, theme: Theme) -> str:
    """The attributes that name what an element shows, for whoever styles a page."""
    if theme is not Theme.PAGE or about == ANYTHING:
        return ""
    named = ((kind, getattr(about, kind)) for kind in About.__struct_fields__)
    return "".join(f" data-{kind}={quoteattr(_known(name))}" for kind, name in named if name)


def _element(item: Item, theme: Theme) -> str:
    told = _names(item.about, theme)
    if isinstance(item, Stroke):
        dash = f' stroke-dasharray="{" ".join(map(_number, item.dash))}"' if item.dash else ""
        shape = steps_text(item)
        join = ' stroke-linejoin="round" stroke-linecap="round"' if not item.dash else ""
        paint = f'{_paint("stroke", item.role, theme)} stroke-width="{_number(item.width)}"'
        return f'<path d="{shape}" {paint}{join}{dash}{told}/>'
    if isinstance(item, Shape):
        places = " ".join(map(_place, item.corners))
        return f'<polygon points="{places}" {_paint("fill", item.role, theme)}{told}/>'
    if isinstance(item, Dot):
        fill = _paint("fill", item.role, theme) if item.is_filled else ""
        circle = f'<circle cx="{_number(item.at[0])}" cy="{_number(item.at[1])}" r="{_number(item.radius)}" '
        if item.is_filled:
            return f"{circle}{fill}{told}/>"
        ring = f'{_paint("stroke", item.role, theme)} stroke-width="1.4"'
        disc = f"{circle}{_paint('fill', Role.PAPER, theme)}/>"
        return f"{disc}{circle}{ring}{told}/>"
    return _text(item, theme)


def _text(text: Text, theme: Theme) -> str:
    kind = ' font-weight="bold"' if text.is_bold else ""
    if text.is_mono:
        kind += f' font-family="{MONO}"'
    if text.anchor.value != "start":
        kind += f' text-anchor="{text.anchor.value}"'
    if text.is_turned:
        kind += f' transform="rotate(-90 {_place(text.at, " ")})"'
    place = f'x="{_number(text.at[0])}" y="{_number(text.at[1])}" font-size="{_number(text.size)}"{kind}'
    looks = {(run.role, run.is_underlined, *([run.about] if theme is Theme.PAGE else ())) for run in text.runs}
    told, fill = _names(text.about, theme), ""
    if len(looks) == 1:
        run = text.runs[0]
        inside, fill = _clean(text.words), f" {_paint('fill', run.role, theme)}{_underline(run)}"
        told = told or _names(run.about, theme)
    else:
        inside = "".join(_span(run, theme) for run in text.runs if run.text)
    blanks = ' xml:space="preserve"' if "  " in text.words or text.words != text.words.strip() else ""
    return f"<text {place}{blanks}{fill}{told}>{inside}</text>"


def _span(run: TextRun, theme: Theme) -> str:
    look = f"{_paint('fill', run.role, theme)}{_underline(run)}{_names(run.about, theme)}"
    return f"<tspan {look}>{_clean(run.text)}</tspan>"


def _underline(run: TextRun) -> str:
    return ' text-decoration="underline"' if run.is_underlined else ""


def steps_text(stroke: Stroke) -> str:
    """A stroke as the data of a path."""
    return "".join(_steps(stroke))


def _steps(stroke: Stroke) -> Iterator[str]:
    yield f"M{_place(stroke.start)}"
    here = stroke.start
    for step in stroke.steps:
        if not isinstance(step, Sweep):
            yield f"L{_place(step)}"
            here = step
            continue
        yield from _arc(here, step)
        here = step.end


def _arc(here: Spot, sweep: Sweep) -> Iterator[str]:
    if sweep.radius > _FLAT:
        yield from (f"L{_place(spot)}" for spot in sweep.spots(here, _PIECES))
        return
    flag = 1 if sweep.angle > 0 else 0
    radius = _number(sweep.radius)
    if abs(sweep.angle) > tau * 0.99:
        # The end of an arc command may not be its beginning.
        middle = 2 * sweep.center[0] - here[0], 2 * sweep.center[1] - here[1]
        yield f"A{radius} {radius} 0 0 {flag} {_place(middle)}A{radius} {radius} 0 0 {flag} {_place(sweep.end)}"
        return
    large = 1 if abs(sweep.angle) > pi else 0
    yield f"A{radius} {radius} 0 {large} {flag} {_place(sweep.end)}"


def _place(spot: Spot, between: str = ",") -> str:
    return f"{_number(spot[0])}{between}{_number(spot[1])}"


def _number(value: float) -> str:
    """A number of pixels to a hundredth, without a negative zero."""
    return trimmed(value, 2)


def _clean(text: str) -> str:
    """A text as XML holds it."""
    return escape(_known(text))


def _known(text: str) -> str:
    """A text without the characters that XML does not know."""
    return "".join(each if _is_character(ord(each)) else "�" for each in text)


def _is_character(code: int) -> bool:
    """Char of XML 1.0, section 2.2."""
    return code in (9, 10, 13) or 0x20 <= code <= 0xD7FF or 0xE000 <= code <= 0xFFFD or 0x10000 <= code <= 0x10FFFF  # noqa: PLR2004
