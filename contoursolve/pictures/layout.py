"""Lays a scene out on a page: how large it is drawn, what stands in its margins, head and foot."""

import re
from collections.abc import Iterable, Iterator, Sequence
from math import floor, log10, tau

from msgspec.structs import replace

from contoursolve.geometry import FIRST, SECOND, Length
from contoursolve.pictures.callouts import draw_callouts, keep_signs
from contoursolve.pictures.closeups import ROW, Detail, choose_details, draw_details, mark_details
from contoursolve.pictures.labels import FAINT_WEIGHT, PATH_WEIGHT, THIN_WEIGHT, Canvas, clip
from contoursolve.pictures.margins import Placement, arrange, draw_margins, placement_of
from contoursolve.pictures.page import (
    ANYTHING,
    MONO,
    PAD,
    SIZE,
    THICK,
    WIDTH,
    About,
    Anchor,
    Box,
    Item,
    Spot,
    Stroke,
    Sweep,
    Text,
    TextRun,
    arc,
    head,
    heading,
    line,
    shorten,
    width_of,
    wrap,
)
from contoursolve.pictures.scene import Dimension, Leader, Mark, Ring, Scene, Slide, Thin, Trail, Viewport, Weight
from contoursolve.pictures.sheet import Sheet
from contoursolve.pictures.svg import steps_text
from contoursolve.pictures.theme import CHAINS, DASHES, MEANINGS, TOOLS, Role
from contoursolve.solving import ArcSegment, Segment, along, direction, distance, middle, sweep_of

_ARROWED = 34.0
"""Pixels of an element that is long enough for an arrow."""

_GAP = 0.5
_LEAST = 0.4
"""Pixels. Elements that are smaller are drawn with the next one."""

_MOST_NAMES = 6
"""Names of parts that are too small to be read."""

_CORNER = 130.0
"""Pixels that the axes take of the width."""

_GAP_ABOVE = 4.0
_BAR, _ALONE = 140.0, 44.0
"""Pixels above what stands below a drawing, of the longest bar that is its scale, and of axes that are not there."""


def lay_out(scene: Scene, held: Placement | None = None) -> Sheet:
    """The page of one scene; one that is held has scale and origin, sides of labels and height of the page before."""
    whole, scene = scene, _thinned(scene)
    top = list(_head_of(scene))
    margins = arrange(scene, max(item.box.bottom for item in top) + 6.0, held)
    frame, canvas = margins.frame, Canvas(margins.view, margins.frame, held.labels if held else None)
    if scene.is_part:
        canvas.keep_clear()
    _draw_path(canvas, scene)
    keep_signs(canvas, scene)
    draw_margins(canvas, margins)
    details, small = choose_details(scene.closeups, margins.view)
    has_row = bool(details) and (held is None or held.foot >= frame.bottom + ROW)
    mark_details(canvas, details if has_row else ())
    draw_callouts(canvas, _without(scene, details, margins.view) if scene.is_part and has_row else scene)
    # The axes stand beside the drawing's lower end where nothing else is.
    is_free = canvas.cost(Box(frame.left, frame.bottom - 34.0, _CORNER, frame.bottom)) == 0.0
    under = ROW + _GAP_ABOVE if has_row else -26.0 if is_free else _GAP_ABOVE
    below = held.foot if held else frame.bottom + under if scene.parts or any(scene.axes) else frame.top - _ALONE
    enlarged = [*draw_details(whole, margins.view, details, frame.bottom + _GAP_ABOVE)] if has_row else []
    told = {item.words for item in enlarged if isinstance(item, Text)}
    homeless = [each for each in canvas.homeless if each not in told]
    told |= {text.words for text in canvas.texts}
    small = [each for each in small if not (scene.is_part and each in told)]
    foot = [*enlarged, *_foot_of(scene, homeless, small, below, margins.view.scale)]
    height = round(max((item.box.bottom for item in foot if isinstance(item, Text)), default=frame.bottom) + 12.0, 1)
    height = max(height, held.height if held else 0.0)
    placement = placement_of(margins, canvas, below, height)
    return Sheet(scene.title, height, frame, canvas.items, (*top, *foot), placement)


def _without(scene: Scene, details: Sequence[Detail], view: Viewport) -> Scene:
    """The scene without what its details tell."""
    told = [
        each
        for each in scene.each(Leader)
        if any(detail.box.grow(1.0).holds(Box(*view.place(each.at), *view.place(each.at))) for detail in details)
    ]
    return replace(scene, parts=tuple(each for each in scene.parts if each not in told))


def _thinned(scene: Scene) -> Scene:
    """The scene as far as it can be read: of a crowded one, words that are not simply given, and names."""
    dimensions, marks = scene.dimensions, scene.each(Mark)
    if len(dimensions) + sum(bool(mark.label) for mark in marks) <= scene.most_labels:
        return scene
    special = [each for each in dimensions if each.role is not Role.GIVEN][: scene.most_labels]
    left = max(scene.most_labels - len(special), 2)
    short = (replace(m, label=m.short if number < left else (), short=()) for number, m in enumerate(marks))
    others = (part for part in scene.parts if not isinstance(part, Dimension | Mark))
    dropped = len(dimensions) - len(special)
    told = (TextRun(f"{dropped} words are not drawn: there is no room for so many", Role.MUTED),)
    remarks = (*scene.remarks, *([told] if dropped else []))
    return replace(scene, parts=(*others, *short, *special), remarks=remarks)


def _draw_path(canvas: Canvas, scene: Scene) -> None:
    """Construction, other contours, and the path over them."""
    view, trails = canvas.view, scene.each(Trail)
    if scene.has_turning_axis and trails:
        y = view.place((0.0, 0.0))[1]
        if canvas.frame.top + 4.0 < y < canvas.frame.bottom - 4.0:
            canvas.draw(line((canvas.frame.left, y), (canvas.frame.right, y), Role.MUTED, 0.9), FAINT_WEIGHT)
    for ring in scene.each(Ring):
        radius = ring.radius * view.scale
        if radius < 20 * WIDTH:
            stroke = arc(view.place(ring.center), radius, tau, ring.role)
            canvas.draw(stroke, FAINT_WEIGHT if ring.role is Role.MUTED else THIN_WEIGHT)
    for thin in scene.each(Thin):
        ends = _ends_of(canvas, thin)
        if ends is not None:
            width = 1.0 if thin.role is Role.MUTED else 1.4
            canvas.draw(line(*ends, thin.role, width, is_dashed=thin.is_dashed))
    for trail in sorted(trails, key=lambda each: each.weight is Weight.MAIN):
        is_outline = trail.weight is Weight.MAIN or (scene.is_part and trail.weight is Weight.MIRRORED)
        weight = PATH_WEIGHT if is_outline else THIN_WEIGHT
        is_named = scene.is_one_contour and trail.weight is Weight.MAIN
        for part in [replace(trail, segments=(each,)) for each in trail.segments] if is_named else [trail]:
            own = About(line=str(part.line)) if part.line else ANYTHING
            with canvas.about(About(element=part.segments[0].name) if is_named else own):
                for stroke in _strokes(view, part) if part.weight is not Weight.PASSING else _passing(canvas, part):
                    canvas.draw(stroke, weight)
    for trail in () if scene.is_part else (trail for trail in trails if trail.weight is Weight.MAIN):
        for segment in _pointed(trail.segments, view):
            at, way = middle(segment)
            step = way[0], -way[1]
            with canvas.about(About(element=segment.name) if scene.is_one_contour else ANYTHING):
                canvas.fill(head(along(view.place(at), step, 5.0), step, trail.role, 11.0, 4.6))


def _pointed(segments: tuple[Segment, ...], view: Viewport) -> list[Segment]:
    """The elements that are long enough for an arrow, or the longest; corners have their size there."""
    others = [segment for segment in segments if not segment.name.startswith("corner")]
    long = [segment for segment in others if segment.length * view.scale > _ARROWED]
    return long or ([max(others, key=lambda each: each.length)] if others else [])


def _ends_of(canvas: Canvas, thin: Thin) -> tuple[Spot, Spot] | None:
    """The ends of a thin line on the page; None if none of it is there."""
    a, b = canvas.view.place(thin.start), canvas.view.place(thin.end)
    if not thin.is_endless:
        return a, b
    way, reach = direction(a, b), 4 * WIDTH
    return clip(along(a, way, -reach), along(a, way, reach), canvas.frame) if distance(a, b) > 0 else None


def _strokes(view: Viewport, trail: Trail) -> Iterator[Stroke]:
    """A path as strokes; one where it has no gap."""
    is_ink = trail.role in (Role.INK, Role.DETERMINED)
    width = (THICK if is_ink else THICK - 0.4) if trail.weight is Weight.MAIN else 1.4
    dash = () if is_ink or trail.weight is Weight.MIRRORED else DASHES.get(trail.role, ())
    steps: list[Spot | Sweep] = []
    begin = last = view.place(trail.segments[0].start)
    for segment in trail.segments:
        start, end = view.place(segment.start), view.place(segment.end)
        if distance(start, last) > _GAP:
            if steps:
                yield Stroke(begin, tuple(steps), trail.role, width, dash)
            begin, steps = start, []
        last = end
        if segment.length * view.scale >= _LEAST or segment is trail.segments[-1]:
            steps.append(_step(view, segment, end))
    if steps:
        yield Stroke(begin, tuple(steps), trail.role, width, dash)


def _passing(canvas: Canvas, trail: Trail) -> Iterator[Stroke]:
    """The lines of a path as far as the frame goes."""
    for segment in trail.segments:
        ends = clip(canvas.view.place(segment.start), canvas.view.place(segment.end), canvas.frame)
        if ends is not None and distance(*ends) > _LEAST:
            yield line(*ends, trail.role, 1.2)


def path_data(trails: Iterable[Trail], view: Viewport) -> list[str]:
    """Paths as the data of SVG's paths, where a part of the plane is shown."""
    return [steps_text(stroke) for trail in trails for stroke in _strokes(view, trail)]


def _step(view: Viewport, segment: Segment, end: Spot) -> Spot | Sweep:
    if not isinstance(segment, ArcSegment):
        return end
    return Sweep(view.place(segment.center), segment.radius * view.scale, end, -sweep_of(segment))


# Head and foot -----------------------------------------------------------------------------------------------

_LINE, _SMALL = 17.0, 11.0
"""Pixels from one line of the program to the next, and of the font of legends."""

_MOST_ROWS = 3
"""Rows that a line of a program takes."""


def _head_of(scene: Scene) -> Iterator[Text]:
    """The title and the program's lines."""
    y = PAD + 6.0
    yield heading(scene.title, y)
    y += 3.0
    for runs in scene.lines:
        for row, shown in enumerate(_rows(runs)):
            y += _LINE
            yield Text((PAD + (14.0 if row else 0.0), y), shown, SIZE, is_mono=True)


def _rows(runs: tuple[TextRun, ...]) -> list[tuple[TextRun, ...]]:
    """A line of a program in as many rows as it takes, up to `_MOST_ROWS`."""
    most = (WIDTH - 2 * PAD - 14.0) / (MONO * SIZE)
    rows: list[list[TextRun]] = [[]]
    used = 0.0
    for run in runs:
        # Broken before a word where it does not fit, or anywhere where it is longer than a row.
        for piece in re.split(r"(?<=\s)(?=\S)", run.text):
            wide = width_of(piece, 1.0, is_mono=True) / MONO
            if used and used + wide > most:
                rows.append([])
                used = 0.0
            rows[-1].append(replace(run, text=shorten(piece, most * MONO, 1.0, is_mono=True)))
            used += wide
    kept = [row for row in rows if row][:_MOST_ROWS]
    if len(rows) > _MOST_ROWS:
        kept[-1] = [*kept[-1][:-1], TextRun("…", Role.MUTED)]
    return [_merged(row) for row in kept]


def _merged(row: list[TextRun]) -> tuple[TextRun, ...]:
    """Neighbours in one role as one run."""
    found: list[TextRun] = []
    for run in row:
        if found and found[-1] == replace(run, text=found[-1].text):
            found[-1] = replace(run, text=found[-1].text + run.text)
        else:
            found.append(run)
    return tuple(found)


def _foot_of(scene: Scene, homeless: Sequence[str], small: Sequence[str], top: float, scale: float) -> Iterator[Item]:
    """The axes, the legend, the scale, and remarks."""
    corner = PAD + 12.0, top + 34.0
    ways = (((1.0, 0.0), scene.axes[FIRST]), ((0.0, -1.0), scene.axes[SECOND])) if any(scene.axes) else ()
    for way, name in ways:
        tip = corner[0] + way[0] * 30.0, corner[1] + way[1] * 30.0
        yield line(corner, tip, Role.INK, 1.2)
        yield head(tip, way, Role.INK)
        at = (tip[0] + 5.0, tip[1] + 4.0) if way[0] else (tip[0] + 7.0, tip[1] + 8.0)
        yield Text(at, (TextRun(name, Role.INK),), _SMALL)
    x = corner[0] + 30.0 + 5.0 + max(width_of(name, _SMALL) for name in scene.axes) + 26.0
    y = corner[1] + 4.0
    begin, right = x, WIDTH - PAD
    if scene.scale_unit is not None and scene.each(Trail):
        bar = list(_bar(scene.scale_unit, scale, y))
        yield from bar
        right = min(item.box.left for item in bar if isinstance(item, Text)) - 18.0
    for role in _legend(scene):
        text = scene.meanings.get(role) or MEANINGS[role]
        wide = 34.0 + width_of(text, _SMALL) + 18.0
        if x + wide > right and x > begin:
            x, y = begin, y + 16.0
        yield line((x, y - 4.0), (x + 28.0, y - 4.0), role, THICK if role in CHAINS else 1.6)
        yield Text((x + 34.0, y), (TextRun(text, role),), _SMALL)
        x += wide
    y += 20.0
    remarks = list(scene.remarks)
    if small:
        more = f" and {len(small) - _MOST_NAMES} more" if len(small) > _MOST_NAMES else ""
        remarks.append((TextRun("too small to be read here: " + ", ".join(small[:_MOST_NAMES]) + more, Role.MUTED),))
    if homeless:
        remarks.append((TextRun("no room for: " + ", ".join(homeless), Role.MUTED),))
    for runs in remarks:
        for text in wrap("".join(run.text for run in runs), WIDTH - 2 * PAD, SIZE, 2):
            yield Text((PAD, y), (replace(runs[0], text=text),), SIZE)
            y += 16.0


def _bar(unit: Length, scale: float, y: float) -> Iterator[Item]:
    """A bar of a round length at the right edge, with its length before it."""
    most = _BAR / (scale * float(unit.in_mm))
    power = 10.0 ** floor(log10(most))
    length = max(each for each in (power, 2 * power, 5 * power) if each <= most)
    right, left = WIDTH - PAD, WIDTH - PAD - length * scale * float(unit.in_mm)
    yield line((left, y - 4.0), (right, y - 4.0), Role.INK, 1.6)
    yield from (line((x, y - 8.0), (x, y), Role.INK, 1.2) for x in (left, right))
    yield Text((left - 8.0, y), (TextRun(f"{length:g} {unit.value}", Role.INK),), _SMALL, Anchor.END)


_STATES = (
    Role.INK,
    *CHAINS,
    *TOOLS,
    Role.RAPID,
    Role.GIVEN,
    Role.DERIVED,
    Role.IGNORED,
    Role.CONFLICTING,
    Role.CANDIDATE,
    Role.FREE,
    Role.GHOST,
)


def _legend(scene: Scene) -> list[Role]:
    """The states that are used."""
    used = {part.role for part in scene.parts if not isinstance(part, Mark | Slide)}
    used |= {run.role for mark in scene.each(Mark) for run in mark.label}
    used |= {run.role for runs in scene.lines for run in runs}
    used |= {Role.FREE} if scene.each(Slide) else set()
    return [role for role in _STATES if role in used and (role in MEANINGS or role in scene.meanings)]
