"""A map that answers to the pointer as HTML: an element for a page or a notebook, and a page of its own. It asks no
other host for anything.
"""

import json
from functools import lru_cache
from hashlib import sha256
from importlib.resources import files

import htpy as h
from markupsafe import Markup

from contoursolve.families import Family, FeasibleRegion
from contoursolve.output.html import notebook_style, page_style, short, style_rules
from contoursolve.output.map_frames import LiveMap
from contoursolve.output.plain_text import printable
from contoursolve.pictures import DARK_COLORS, LEVELS, LIGHT_COLORS

_POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:"
"""Tells the browser to load nothing, and to run what stands in the page."""

_DARK = ('[data-jp-theme-light="false"]', ".vscode-dark", '[data-theme="dark"]', ".dark")
_LIGHT = ('[data-jp-theme-light="true"]', ".vscode-light", '[data-theme="light"]')
"""Selectors of the themes of notebooks."""


@lru_cache
def map_script() -> str:
    """The function `showMap` of the front end."""
    return files(__package__).joinpath("map.js").read_text(encoding="utf-8")


@lru_cache
def map_style() -> str:
    """The style sheet of maps, with the colours of levels."""
    light, dark = (
        " ".join(f"--cs-{role.value}: {colors[role]};" for role in LEVELS) for colors in (LIGHT_COLORS, DARK_COLORS)
    )
    themed = "".join(
        f"{', '.join(f'{page} .contoursolve.map' for page in pages)} {{ {declared} }}\n"
        for pages, declared in ((_LIGHT, light), (_DARK, dark))
    )
    dark_rule = f"@media screen and (prefers-color-scheme: dark) {{ .contoursolve.map {{ {dark} }} }}"
    return f".contoursolve.map {{ {light} }}\n{dark_rule}\n{themed}{style_rules('map.css')}"


def map_element(live: LiveMap, *, is_inline: bool = False) -> h.Element:
    """The map as an element with its data and its script; without scripts, its picture. An image is shown by notebooks
    that nobody trusts, an element of SVG (`is_inline`) has the colours of its page."""
    # In a script, only `<` could end it.
    told = json.dumps(live.data(), ensure_ascii=True, separators=(",", ":")).replace("<", "\\u003c")
    name = sha256((told + live.picture.svg).encode()).hexdigest()[:12]
    begin = (
        f"for (const root of document.querySelectorAll('[data-map=\"{name}\"]:not([data-live])')) "
        '{ root.dataset.live = ""; showMap(root, JSON.parse(root.querySelector("script").textContent), null); }'
    )
    picture = live.picture.svg if is_inline else live.picture._repr_html_()
    style = "" if is_inline else notebook_style() + map_style()
    return h.div(".contoursolve.map", data_map=name)[
        h.style[Markup(style)] if style else None,
        h.figure[h.div(".paper")[Markup(picture)]],  # our own painter escapes
        h.script(type="application/json")[Markup(told)],
        h.script[Markup(f"(() => {{\n{map_script()}{begin}\n}})();")],
    ]


def map_page(record: Family | FeasibleRegion, result: str | None = None, *, version: str = "") -> str:
    """A page of HTML with the map of a family over two words, or of a region. Pointer and arrow keys choose values, and
    the page draws their contour. `result` colours the map, as for `draw_family_map`.

    The page asks no other host for anything. It holds some of the contours, and says where they are. Raises ValueError
    for a family that is no grid of two words, and FamilyError for a result that is none.
    """
    live = LiveMap(record, result)
    title, by = live.picture.title, f"contoursolve {version}".strip()
    page = h.html(lang="en")[
        h.head[
            h.meta(charset="utf-8"),
            h.meta(http_equiv="Content-Security-Policy", content=_POLICY),
            h.meta(name="viewport", content="width=device-width, initial-scale=1"),
            h.meta(name="color-scheme", content="light dark"),
            h.meta(name="generator", content=by),
            h.title[title],
            h.style[Markup(page_style(has_chains=False) + map_style() + _PAGE)],
        ],
        h.body(".contoursolve")[
            h.main[
                h.h1[f"Map of {' and '.join(map(printable, live.plane.words))}"],
                h.pre["\n".join(short(line) for line in live.spec.block.splitlines())],
                h.p["Point at the map, or press arrow keys on it: the contour of these values is drawn beside it."],
                map_element(live, is_inline=True),
                h.noscript[h.p["Without scripts this page shows the map only."]],
            ],
            h.footer[h.p[f"{by}. X is a diameter where it says so."]],
        ],
    ]
    return f"{page}\n"


_PAGE = "body.contoursolve { margin: 0 auto; padding: 12px 20px; max-width: 1220px; } h1 { font-size: 1.2em; }\n"
