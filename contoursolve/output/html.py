"""HTML of contours, findings and tables, escaped by htpy, with its style sheet: for notebooks and the report alike."""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import htpy as h
from markupsafe import Markup

from contoursolve.diagnosis import Answer, certificate_text, list_solutions
from contoursolve.diagnostics import Diagnostic, Severity
from contoursolve.output.contours import (
    check_table,
    count_text,
    given_table,
    path_of,
    small,
    solution_rows,
)
from contoursolve.output.findings import Piece, finding_pieces
from contoursolve.output.listing import beside_of
from contoursolve.output.plain_text import NAMELESS, Excerpt, Folded, Name, RecordView, Table, printable
from contoursolve.output.premises import premise_texts
from contoursolve.pictures import CHAINS, DARK_COLORS, LEVELS, LIGHT_COLORS, TOOLS, Drawable, Role, Theme, draw

if TYPE_CHECKING:
    from contoursolve.tool_radius import ToolReport

WIDEST, LONGEST = 200, 400
"""Characters of a cell, and of a line."""

MOST_ROWS = 200
"""Rows of a table on a page."""


def html_text(element: h.Element) -> str:
    """An element as a plain `str`: marimo sends a subclass, which htpy makes, as an object."""
    return str.__str__(str(element))


# Tables ------------------------------------------------------------------------------------------------------


def table_of(rows: Table, *, identity: str = "") -> h.Element:
    """A table as every format shows it, with as many rows as a page holds; with an `identity`, its rows are places on
    the page."""
    return table(rows.caption, rows.header, _cut(rows.rows), numbers=rows.numbers, names=rows.names, identity=identity)


def table(
    caption: str,
    header: Sequence[str],
    rows: Sequence[Sequence[h.Node]],
    *,
    numbers: Sequence[int] = (),
    names: Sequence[Name] = (),
    identity: str = "",
) -> h.Element:
    """A table whose first column heads its rows; the columns named in `numbers` are aligned right. A row with a name
    says what it shows of a picture; with an `identity`, it is a place on the page, to which its first cell leads."""
    own = [*names, *[NAMELESS] * (len(rows) - len(names))]
    places = [f"{identity}-{number}" if identity and name != NAMELESS else None for number, name in enumerate(own, 1)]
    kinds = ["number" if place in numbers else None for place in range(len(header))]
    return h.div(".scroll", tabindex="0", role="group", aria_label=caption)[
        h.table[
            h.caption[caption],
            h.thead[h.tr[(h.th(scope="col", class_=kind)[text] for kind, text in zip(kinds, header, strict=True))]],
            h.tbody[
                (
                    h.tr(named_as([name]), id=place)[
                        h.th(scope="row", class_=kinds[0])[
                            h.a(href=f"#{place}")[_cell(row[0])] if place else _cell(row[0])
                        ],
                        (h.td(class_=kind)[_cell(text)] for kind, text in zip(kinds[1:], row[1:], strict=True)),
                    ]
                    for row, name, place in zip(rows, own, places, strict=False)
                )
            ],
        ]
    ]


def named_as(names: Iterable[Name]) -> dict[str, str]:
    """The attributes of an element that shows what pictures name so."""
    by_kind: dict[str, dict[str, None]] = {}
    for kind, name in names:
        if kind:
            by_kind.setdefault(f"data-{kind}", {})[name] = None
    return {kind: " ".join(own) for kind, own in by_kind.items()}


def _cell(content: h.Node) -> h.Node:
    """A text as it can be printed and not too long; elements stay."""
    return short(content) if isinstance(content, str) and not hasattr(content, "__html__") else content


def _cut(rows: Sequence[Sequence[Any]]) -> Sequence[Sequence[Any]]:
    """The rows that a page holds, and in the last one how many more there are."""
    if len(rows) <= MOST_ROWS:
        return rows
    return [*rows[:MOST_ROWS], (f"and {len(rows) - MOST_ROWS} more", *[""] * (len(rows[0]) - 1))]


def short(text: str, most: int = WIDEST) -> str:
    """A text without control characters, cut where it is too long for a cell."""
    shown = printable(text)
    return shown if len(shown) <= most else f"{shown[: most - 4]} ..."


def view_element(view: RecordView) -> Iterator[h.Node]:
    """A record in words: its picture, its title, and the parts below it, each text as a sentence."""
    if view.picture is not None:
        yield figure(view.picture)
    if view.title:
        yield h.p[short(view.title, LONGEST)]
    for part in view.parts:
        if isinstance(part, Excerpt):
            yield h.h4[_begun(part.title)]
            yield h.pre["\n".join(map(short, part.text.split("\n")))]
        elif isinstance(part, Folded):
            yield h.details[h.summary[part.title], map(_part, part.parts)]
        else:
            yield _part(part)


def _part(part: str | Table) -> h.Node:
    """A text as a sentence, or a table; nothing of one that is empty."""
    if isinstance(part, Table):
        return table_of(part.without_empty()) if part.rows else None
    return h.p[short(f"{_begun(part)}.", LONGEST)] if part else None


def _begun(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}"


def figure(record: Drawable, *, is_inline: bool = False, tool: "ToolReport | None" = None) -> h.Element:
    """The picture with its tool, as an image or as an element of SVG; where it cannot be drawn the page says so, and
    its tables say the same."""
    try:
        beside = beside_of(tool, record if isinstance(record, Answer) else None)
        drawn = draw(record, theme=Theme.PAGE, **({"beside": beside} if beside else {}))
        if is_inline:  # so that arrow keys scroll it
            return h.figure(tabindex="0", aria_label="Picture")[Markup(drawn.svg)]  # our own painter escapes
        return h.figure[Markup(drawn._repr_html_())]
    except Exception as error:  # numbers that nobody draws must not keep the rest from the reader
        return h.p[f"This cannot be drawn ({type(error).__name__})."]


# Contours ----------------------------------------------------------------------------------------------------


def words_table(answer: Answer, *, identity: str = "") -> h.Element:
    """The table of a contour's given words."""
    given = given_table(answer)
    return table(given.caption, given.header, given.rows, numbers=given.numbers, names=given.names, identity=identity)


def path_element(answer: Answer, *, identity: str = "") -> h.Element | None:
    """Every named point and every element of the path, in the unit and the axes of the program."""
    if answer.contour is None:
        return None
    return table_of(path_of(answer, answer.contour), identity=identity)


def solutions_table(answer: Answer) -> Iterator[h.Node]:
    """All solutions and what selects each, where there are several or may be more."""
    listing = list_solutions(answer)
    if listing is None or listing.is_single:
        return
    header = ("solution", "chosen", "where it differs", "what selects it", "certificate")
    rows = [
        (name, "yes" if each.is_chosen else "", f"{label} {where}".strip(), selects, certificate)
        for each, (name, label, where, selects, certificate) in solution_rows(answer, listing)
    ]
    yield table_of(Table("All solutions", header, rows, left=range(len(header))).without_empty())
    yield h.p[short(f"{count_text(listing)}.")]
    yield from (h.p[short(f"Not decided: {doubt}.")] for doubt in listing.doubts)


def checks_table(answer: Answer) -> h.Element | None:
    """The checks that a contour without a path went through."""
    is_shown = answer.diagnosis is not None and answer.contour is None
    return table_of(check_table(answer.diagnosis)) if is_shown and answer.diagnosis is not None else None


def remarks(answer: Answer, control: str) -> Iterator[h.Element]:
    """Paragraphs below a path: the block with its asked values filled in, the certificate, and the premises."""
    if answer.filled:
        yield h.p[f"Filled in (the contour moves by {small(answer.filled.deviation)}):"]
        yield h.pre["\n".join(short(text.strip()) for text in answer.filled.blocks)]
    if answer.contour is not None:
        if known := certificate_text(answer.certificate):
            yield h.p[short(f"Certificate: {known}.")]
        yield from (h.p[short(text)] for text in premise_texts(answer.premises, control))


# Findings ----------------------------------------------------------------------------------------------------

Anchor = Callable[[int], str | None]
"""The address of a line of the program on the page, if it has one."""


def finding_element(
    finding: Diagnostic,
    name: str,
    sources: Mapping[int, str],
    *,
    anchor: Anchor | None = None,
    identity: str = "",
    heading: h.Element = h.h4,
    names: Sequence[Name] = (),
) -> h.Element:
    """One finding in the layout of the terminal: its title, and below it everything else, its place as a link. `names`
    is what it shows of a picture."""
    title, *rest = finding_pieces(finding, name, sources)
    target = anchor(finding.span.line) if anchor else None
    return h.section(named_as(names), class_=f"finding {finding.severity.value}", id=identity or None)[
        heading[(_piece(piece, None) for piece in bounded(title))],
        h.pre(tabindex="0")[([*(_piece(piece, target) for piece in bounded(line)), "\n"] for line in rest if line)],
    ]


def bounded(line: Sequence[Piece]) -> list[Piece]:
    """The pieces of a line as far as it is not too long."""
    shown: list[Piece] = []
    room = LONGEST
    for text, role in line:
        shown.append((text if len(text) <= room else f"{text[:room]} ...", role))
        room -= len(text)
        if room <= 0:
            break
    return shown


def _piece(piece: Piece, target: str | None) -> h.Node:
    text, role = piece
    if role == "place" and target:
        return h.a(href=target)[text]
    return h.span(class_=role)[text] if role else text


def worst_of(findings: Iterable[Diagnostic]) -> str:
    """The worst severity of findings; `fine` without any."""
    found = {each.severity for each in findings}
    return next((each.value for each in Severity if each in found), "fine")


# One identity ------------------------------------------------------------------------------------------------

MOST_NAMES = 2_000
"""Names that a page lights; each has a rule of its own."""

_LIT = {"element": "stroke-width:4px", "word": "stroke-width:2.2px"}


def lighting_rules(names: Iterable[Name], scope: str) -> str:
    """Rules that light everything in an element that has one of these names, where anything with this name is pointed
    at, has the focus or is the target of a link; `scope` selects such elements. No script is needed. Raises ValueError
    for more names than a page lights.

    >>> lighting_rules([("word", "P")], "article")
    'article:has([data-word~="P"]:is(:hover,:focus-within,:target)) [data-word~="P"]{stroke-width:2.2px;...}\\n'
    """
    distinct = [each for each in dict.fromkeys(names) if each != NAMELESS]
    if len(distinct) > MOST_NAMES:
        raise ValueError(f"a page lights at most {MOST_NAMES} names; there are {len(distinct)}")
    rules = []
    for kind, name in distinct:
        # Names of elements have blanks, and stand alone.
        own = f'[data-{kind}{"" if kind == "element" else "~"}="{_NOT_PLAIN.sub(_escaped, name)}"]'
        look = ";".join(filter(None, (_LIT.get(kind), "font-weight:700", "background:var(--cs-shade)")))
        rules.append(f"{scope}:has({own}:is(:hover,:focus-within,:target)) {own}{{{look}}}\n")
    return "".join(rules)


_NOT_PLAIN = re.compile(r"[^\w-]", re.ASCII)


def _escaped(found: re.Match[str]) -> str:
    """A character as style sheets write any."""
    return f"\\{ord(found[0]):x} "


# The style sheet ---------------------------------------------------------------------------------------------

_SURFACES = {"light": {"shade": "#f3f4f6", "line": "#cbd0d8"}, "dark": {"shade": "#1b2230", "line": "#3a4454"}}
"""Colours that no picture has: behind texts, and of thin lines between rows."""

LIGHT, DARK = (
    {role.value: color for role, color in colors.items() if role not in LEVELS} | _SURFACES[scheme]
    for scheme, colors in (("light", LIGHT_COLORS), ("dark", DARK_COLORS))
)
"""Colours of a page, by their names; `map_style` has those of levels."""

_TOOLS = [role.value for role in TOOLS]

_NOTEBOOK_COLORS = {
    Role.INK.value: "--jp-content-font-color1, var(--vscode-editor-foreground, {})",
    Role.PAPER.value: "--jp-layout-color0, var(--vscode-editor-background, {})",
}
"""Names that JupyterLab and VS Code give to the colours of their themes."""

_LIGHT_PAGES = ('[data-jp-theme-light="true"]', ".vscode-light", '[data-theme="light"]')
_DARK_PAGES = ('[data-jp-theme-light="false"]', ".vscode-dark", '[data-theme="dark"]', ".dark")
"""Selectors of a dark theme in notebooks, whatever the reader's system prefers."""


@lru_cache
def style_rules(name: str = "style.css") -> str:
    """The style sheet for everything inside an element of the class `contoursolve`."""
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


@lru_cache
def notebook_style(*, has_tool: bool = False) -> str:
    """The style sheet for an output of a notebook, in the notebook's own theme."""
    light, dark = (
        f"color-scheme: {scheme}; {_declarations(colors, () if has_tool else _TOOLS, _NOTEBOOK_COLORS)}"
        for scheme, colors in (("light", LIGHT), ("dark", DARK))
    )
    themed = "".join(
        f"{', '.join(f'{page} .contoursolve' for page in pages)} {{ {declared} }}\n"
        for pages, declared in ((_LIGHT_PAGES, light), (_DARK_PAGES, dark))
    )
    return (
        f".contoursolve {{ {light} }}\n@media (prefers-color-scheme: dark) {{ .contoursolve {{ {dark} }} }}\n"
        f"{themed}{style_rules()}"
    )


@lru_cache
def page_style(*, has_chains: bool = True, has_tool: bool = False) -> str:
    """The style sheet for a page of its own: as the reader prefers, and light on paper."""
    left_out = [*([] if has_chains else [role.value for role in CHAINS]), *([] if has_tool else _TOOLS)]
    light, dark = (_declarations(colors, left_out) for colors in (LIGHT, DARK))
    return (
        f":root {{ color-scheme: light dark; {light} }}\n"
        f"@media screen and (prefers-color-scheme: dark) {{ :root {{ {dark} }} }}\n{style_rules()}"
    )


def _declarations(colors: Mapping[str, str], left_out: Collection[str], page: Mapping[str, str] | None = None) -> str:
    values = {
        name: f"var({page[name].format(color)})" if page and name in page else color
        for name, color in colors.items()
        if name not in left_out
    }
    return " ".join(f"--cs-{name}: {value};" for name, value in values.items())
