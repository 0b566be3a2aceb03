"""What stands above and below a drawing: its title and the program's lines; the axes, the legend and remarks."""

import re
from collections.abc import Iterator, Sequence

from contoursolve.model import FIRST, SECOND
from contoursolve.pictures.arrows import head, line
from contoursolve.pictures.canvas import SIZE
from contoursolve.pictures.metrics import MONO, shorten, width_of, wrap
from contoursolve.pictures.scene import Scene
from contoursolve.pictures.sheet import Item, Run, Text
from contoursolve.pictures.theme import MEANINGS, Role
from contoursolve.pictures.wording import visible

WIDTH = 760.0
"""Pixels of a page."""

_PAD = 18.0
_TITLE, _LINE, _SMALL = 14.0, 17.0, 11.0
_MOST_ROWS = 3
"""Rows that a line of a program takes."""


def head_of(scene: Scene) -> Iterator[Text]:
    """The title and the program's lines."""
    y = _PAD + 6.0
    yield Text(
        (_PAD, y),
        (Run(shorten(visible(scene.title), WIDTH - 2 * _PAD, _TITLE, is_bold=True), Role.INK),),
        _TITLE,
        is_bold=True,
    )
    y += 3.0
    for runs in scene.lines:
        for row, shown in enumerate(_rows(runs)):
            y += _LINE
            yield Text((_PAD + (14.0 if row else 0.0), y), shown, SIZE, is_mono=True)


def _rows(runs: tuple[Run, ...]) -> list[tuple[Run, ...]]:
    """A line of a program in as many rows as it takes, up to `_MOST_ROWS`."""
    most = (WIDTH - 2 * _PAD - 14.0) / (MONO * SIZE)
    rows: list[list[Run]] = [[]]
    used = 0.0
    for run in runs:
        # Broken before a word where it does not fit, or anywhere where it is longer than a row.
        for piece in re.split(r"(?<=\s)(?=\S)", run.text):
            wide = width_of(piece, 1.0, is_mono=True) / MONO
            if used and used + wide > most:
                rows.append([])
                used = 0.0
            rows[-1].append(Run(shorten(piece, most * MONO, 1.0, is_mono=True), run.role))
            used += wide
    kept = [row for row in rows if row][:_MOST_ROWS]
    if len(rows) > _MOST_ROWS:
        kept[-1] = [*kept[-1][:-1], Run("…", Role.MUTED)]
    return [_merged(row) for row in kept]


def _merged(row: list[Run]) -> tuple[Run, ...]:
    """Neighbours in one role as one run."""
    found: list[Run] = []
    for run in row:
        if found and found[-1].role is run.role:
            found[-1] = Run(found[-1].text + run.text, run.role)
        else:
            found.append(run)
    return tuple(found)


def foot_of(scene: Scene, homeless: Sequence[str], top: float) -> Iterator[Item]:
    """The axes, the legend, and remarks."""
    corner = _PAD + 12.0, top + 34.0
    ways = (((1.0, 0.0), scene.axes[FIRST]), ((0.0, -1.0), scene.axes[SECOND])) if any(scene.axes) else ()
    for way, name in ways:
        tip = corner[0] + way[0] * 30.0, corner[1] + way[1] * 30.0
        yield line(corner, tip, Role.INK, 1.2)
        yield head(tip, way, Role.INK)
        at = (tip[0] + 5.0, tip[1] + 4.0) if way[0] else (tip[0] + 7.0, tip[1] + 8.0)
        yield Text(at, (Run(name, Role.INK),), _SMALL)
    x = corner[0] + 30.0 + 5.0 + max(width_of(name, _SMALL) for name in scene.axes) + 26.0
    y = corner[1] + 4.0
    begin = x
    for role in _legend(scene):
        text = scene.meanings.get(role, MEANINGS[role])
        wide = 34.0 + width_of(text, _SMALL) + 18.0
        if x + wide > WIDTH - _PAD and x > begin:
            x, y = begin, y + 16.0
        yield line((x, y - 4.0), (x + 28.0, y - 4.0), role, 1.6)
        yield Text((x + 34.0, y), (Run(text, role),), _SMALL)
        x += wide
    y += 20.0
    remarks = list(scene.remarks)
    if homeless:
        remarks.append((Run("no room for: " + ", ".join(homeless), Role.MUTED),))
    for runs in remarks:
        for text in wrap("".join(run.text for run in runs), WIDTH - 2 * _PAD, SIZE, 2):
            yield Text((_PAD, y), (Run(text, runs[0].role),), SIZE)
            y += 16.0


_STATES = (Role.GIVEN, Role.DERIVED, Role.IGNORED, Role.CONFLICTING, Role.FREE, Role.GHOST)


def _legend(scene: Scene) -> list[Role]:
    """The states that are used."""
    used = {each.role for each in (*scene.trails, *scene.thins, *scene.rings, *scene.dimensions)}
    used |= {run.role for mark in scene.marks for run in mark.label}
    used |= {run.role for runs in scene.lines for run in runs}
    used |= {Role.FREE} if scene.slides else set()
    return [role for role in _STATES if role in used]
