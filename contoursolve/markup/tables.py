"""Tables of HTML from the rows that a listing has."""

from collections.abc import Callable, Sequence

import htpy as h

from contoursolve.output.layout import printable

WIDEST = 200
"""Characters of a cell."""


def table(
    caption: str,
    header: Sequence[str],
    rows: Sequence[Sequence[h.Node]],
    *,
    numbers: Sequence[int] = (),
    identity: Callable[[int], str] | None = None,
) -> h.Element:
    """A table whose first column heads its rows; the columns named in `numbers` are aligned right."""
    kinds = ["number" if place in numbers else None for place in range(len(header))]
    return h.div(".scroll", tabindex="0", role="region", aria_label=caption)[
        h.table[
            h.caption[caption],
            h.thead[h.tr[(h.th(scope="col", class_=kind)[text] for kind, text in zip(kinds, header, strict=True))]],
            h.tbody[
                (
                    h.tr(id=identity(place) if identity else None)[
                        h.th(scope="row", class_=kinds[0])[_cell(row[0])],
                        (h.td(class_=kind)[_cell(text)] for kind, text in zip(kinds[1:], row[1:], strict=True)),
                    ]
                    for place, row in enumerate(rows)
                )
            ],
        ]
    ]


def _cell(content: h.Node) -> h.Node:
    """A text as it can be printed and not too long; elements stay."""
    return short(content) if isinstance(content, str) and not hasattr(content, "__html__") else content


def short(text: str) -> str:
    """A text without control characters, cut where it is too long for a cell."""
    shown = printable(text)
    return shown if len(shown) <= WIDEST else f"{shown[: WIDEST - 4]} ..."
