"""The style sheet of our HTML: the colours of the pictures, light and dark, and the rules that use them."""

from collections.abc import Mapping
from functools import lru_cache
from importlib.resources import files

from contoursolve.pictures.theme import DARK_COLORS, LIGHT_COLORS, Role

_SURFACES = {"light": {"shade": "#f3f4f6", "line": "#cbd0d8"}, "dark": {"shade": "#1b2230", "line": "#3a4454"}}
"""Colours that no picture has: behind texts, and of thin lines between rows."""

LIGHT: Mapping[str, str] = {role.value: color for role, color in LIGHT_COLORS.items()} | _SURFACES["light"]
DARK: Mapping[str, str] = {role.value: color for role, color in DARK_COLORS.items()} | _SURFACES["dark"]

_NOTEBOOK_COLORS = {
    Role.INK.value: "--jp-content-font-color1, var(--vscode-editor-foreground, {})",
    Role.PAPER.value: "--jp-layout-color0, var(--vscode-editor-background, {})",
}
"""What JupyterLab and VS Code call the colours of their themes."""

_LIGHT_PAGES = ('[data-jp-theme-light="true"]', ".vscode-light", '[data-theme="light"]')
_DARK_PAGES = ('[data-jp-theme-light="false"]', ".vscode-dark", '[data-theme="dark"]', ".dark")
"""How notebooks mark the theme that they show, whatever the reader's system prefers."""


@lru_cache
def rules() -> str:
    """What everything inside an element of the class `contoursolve` looks like."""
    return files("contoursolve.markup").joinpath("style.css").read_text(encoding="utf-8")


@lru_cache
def notebook_style() -> str:
    """The style sheet for an output of a notebook, in the notebook's own theme."""
    light, dark = (_declarations(colors, _NOTEBOOK_COLORS) for colors in (LIGHT, DARK))
    themed = "".join(
        f"{', '.join(f'{page} .contoursolve' for page in pages)} {{ {declared} }}\n"
        for pages, declared in ((_LIGHT_PAGES, light), (_DARK_PAGES, dark))
    )
    return (
        f".contoursolve {{ {light} }}\n@media (prefers-color-scheme: dark) {{ .contoursolve {{ {dark} }} }}\n"
        f"{themed}{rules()}"
    )


@lru_cache
def page_style() -> str:
    """The style sheet for a page of its own: as the reader prefers, and light on paper."""
    light, dark = _declarations(LIGHT), _declarations(DARK)
    return (
        f":root {{ color-scheme: light dark; {light} }}\n"
        f"@media screen and (prefers-color-scheme: dark) {{ :root {{ {dark} }} }}\n{rules()}"
    )


def _declarations(colors: Mapping[str, str], page: Mapping[str, str] | None = None) -> str:
    values = {
        name: f"var({page[name].format(color)})" if page and name in page else color for name, color in colors.items()
    }
    return " ".join(f"--cs-{name}: {value};" for name, value in values.items())
