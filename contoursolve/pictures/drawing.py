"""Pictures: a contour with its words as dimensions, whatever its status; SVG, and PNG with the extra `picture`.

An answer or a family comes in, one page of shapes goes out. Begin with `compose`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from msgspec.structs import replace

from contoursolve.diagnosis import Answer, EquationSystem
from contoursolve.pictures.compose import compose, describe, told_of
from contoursolve.pictures.layout import lay_out
from contoursolve.pictures.scene import Dimension, Part, ToolDrawing, Trail, Weight
from contoursolve.pictures.sheet import stack_sheets
from contoursolve.pictures.svg import Picture, finish
from contoursolve.pictures.theme import Role, Theme
from contoursolve.program import Result

if TYPE_CHECKING:
    from contoursolve.comparison import Comparison
    from contoursolve.families import CompiledSweep, Family, FeasibleRange, FeasibleRegion
    from contoursolve.solving import Drawing, Drawings, Sketch

Drawable: TypeAlias = (
    "Answer | EquationSystem | Result | Comparison | Family | FeasibleRange | FeasibleRegion | Sketch | Drawings"
    " | Drawing"
)
"""Types that `draw` accepts."""


def draw(record: Drawable, *, theme: Theme = Theme.LIGHT, **options: Any) -> Picture:
    """The picture of a contour, of all contours of a program, of two programs, of where a block has one by one or two
    of its words, of every way to draw a sketch, or of the matrix of a system. The options are those of the function for
    such a record.

    Raises TypeError for an option that such a record does not have, ValueError for a family over more than two words,
    and for a sketch whose facts make no sense.
    """
    kind = type(record).__name__
    if kind not in _DRAWN:
        raise TypeError(f"{kind} has no picture by itself; one is drawn of {', '.join(_DRAWN)}")
    make, known = _DRAWN[kind]
    unknown = next((name for name in options if name not in known), None)
    if unknown is not None:
        raise TypeError(f"a picture of {kind} has no option {unknown!r}; it has theme, {', '.join(known)}")
    return make(record, theme=theme, **options)


def draw_answer(
    answer: Answer,
    *,
    theme: Theme = Theme.LIGHT,
    title: str | None = None,
    like: Picture | None = None,
    has_remarks: bool = True,
    beside: Sequence[ToolDrawing] = (),
) -> Picture:
    """The picture of one contour: its path where there is one, and what is missing or wrong where there is none.

    `like` is a picture of the contour before a word was moved: scale, origin and height stay, labels keep their sides.
    Without remarks, the findings are not written below. `beside` is what else is drawn in its plane, such as a tool.

    >>> import contoursolve
    >>> answer = contoursolve.solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").answer
    >>> draw_answer(answer).title
    'G111 (taper multiple cornering), program line 1: solved'
    """
    scene = compose(answer, title, beside)
    scene = scene if has_remarks else replace(scene, remarks=())
    told = " ".join((describe(answer), *told_of(beside)))
    return finish(lay_out(scene, like.sheet.placement if like else None), theme, told)


def draw_sketched(
    answer: Answer,
    path: Sequence[Part],
    title: str,
    told: str,
    *,
    spell: Callable[[str], str] = str,
    meanings: Mapping[Role, str] = {},
    theme: Theme = Theme.LIGHT,
) -> Picture:
    """The picture of a contour with another path than that of its answer, such as one that is not finished: its words
    as dimensions, without its program. Where several contours fit, a dimension stands only where all of them have it.
    `told` is the description, `spell` makes the text of a dimension of its words, and `meanings` are the legend's words
    for roles."""
    scene = compose(answer, title, is_shared=True)
    others = (
        replace(each, text=spell(each.text)) if isinstance(each, Dimension) else each
        for each in scene.parts
        if not isinstance(each, Trail) or each.weight is not Weight.MAIN
    )
    scene = replace(scene, parts=(*path, *others), lines=(), remarks=(), meanings=meanings)
    return finish(lay_out(scene), theme, told)


def draw_result(
    result: Result,
    *,
    theme: Theme = Theme.LIGHT,
    title: str | None = None,
    is_whole: bool | None = None,
    beside: Sequence[ToolDrawing] = (),
) -> Picture:
    """The picture of a whole program: its only contour, or all of them in one drawing for each plane, with what else is
    drawn there.

    `is_whole` draws turned parts with both halves, or only with the programmed one; without it, with both where the
    contours stay at least half as large.
    """
    from contoursolve.pictures.overview import compose_overview, describe_overview  # noqa: PLC0415 - not needed for one contour

    if len(result.answers) == 1 and all(each.plane == result.answers[0].plane for each in beside):
        return draw_answer(result.answers[0], theme=theme, title=title, beside=beside)
    return finish(
        stack_sheets([*map(lay_out, compose_overview(result, title, is_whole=is_whole, beside=beside))]),
        theme,
        " ".join((describe_overview(result), *told_of(beside))),
    )


def draw_comparison(comparison: Comparison, *, theme: Theme = Theme.LIGHT, title: str | None = None) -> Picture:
    """The picture of two programs' paths, one drawing for each plane: what both have, what one of them has, and each
    difference by its number, enlarged where it is small."""
    from contoursolve.pictures.two_paths import compose_comparison  # noqa: PLC0415 - not needed for one contour

    return finish(stack_sheets([*map(lay_out, compose_comparison(comparison, title))]), theme)


def draw_family_fan(
    word: str,
    values: Sequence[float],
    answers: Sequence[Answer],
    *,
    theme: Theme = Theme.LIGHT,
    title: str | None = None,
) -> Picture:
    """The picture of a block for several values of one of its words, each with its answer.

    Raises ValueError for no contour, or for more than can be told apart.
    """
    from contoursolve.pictures.overview import compose_fan  # noqa: PLC0415 - not needed for one contour

    return finish(lay_out(compose_fan(word, values, answers, title)), theme)


def draw_family(
    family: Family,
    words: tuple[str, str] | None = None,
    *,
    result: str | None = None,
    theme: Theme = Theme.LIGHT,
    title: str | None = None,
) -> Picture:
    """The picture of a family: the contours of one word that varies, or the map of two; see `draw_family_map`."""
    from contoursolve.pictures.sweeps import fan_of_family, sweep_title  # noqa: PLC0415 - numpy

    fan = fan_of_family(family) if words is None and result is None else None
    if fan is None:
        return draw_family_map(family, words, result=result, theme=theme, title=title)
    told = title if title is not None else sweep_title(family.ranges, family.summary())
    return draw_family_fan(*fan, theme=theme, title=told)


def draw_family_map(
    family: Family,
    words: tuple[str, str] | None = None,
    *,
    result: str | None = None,
    theme: Theme = Theme.LIGHT,
    title: str | None = None,
) -> Picture:
    """The picture of what becomes of a block over two of its words: a field for each status, and the lines between the
    values with a contour and without, with what fails beyond them.

    `words` go to the right and up; without them, the two words of the family. `result` colours the contours by one of
    the family's `results`, with lines of equal value: `"V2 Z"`, `"end X"`, `"length"`. Raises ValueError where
    these are not two words of a grid, FamilyError for a result that is none.
    """
    from contoursolve.pictures.maps import lay_out_map  # noqa: PLC0415 - numpy

    return finish(lay_out_map(family, words, title, result=result), theme)


def draw_range(found: FeasibleRange, *, theme: Theme = Theme.LIGHT, title: str | None = None) -> Picture:
    """The picture of the values of a word with which a block has a contour: a bar with what ends each range."""
    from contoursolve.pictures.value_axes import lay_out_range  # noqa: PLC0415 - as above

    return finish(lay_out_range(found, title), theme)


def draw_region(
    region: FeasibleRegion, *, result: str | None = None, theme: Theme = Theme.LIGHT, title: str | None = None
) -> Picture:
    """The picture of the values of two words with which a block has a contour: the lines that bound them, each with
    what fails beyond it, and a field for each status, as they were sampled; with a `result`, as `draw_family_map`."""
    from contoursolve.pictures.maps import lay_out_region  # noqa: PLC0415 - as above

    return finish(lay_out_region(region, title, result), theme)


def draw_matrix(system: EquationSystem, *, theme: Theme = Theme.LIGHT, title: str | None = None) -> Picture:
    """The picture of the Jacobian of a system: a row for each word, a column for each unknown, in the order of its
    `blocks`. Raises ValueError for a system that is too large to be read."""
    from contoursolve.pictures.matrix import describe_matrix, lay_out_matrix  # noqa: PLC0415 - as above

    return finish(lay_out_matrix(system, title), theme, describe_matrix(system))


def draw_drawings(drawings: Drawings | Drawing, *, theme: Theme = Theme.LIGHT, title: str | None = None) -> Picture:
    """The picture of every way to draw a sketch, or of one: what is given, the facts as dimensions, and each drawing by
    its number, with what tells it from the others below."""
    from contoursolve.pictures.sketches import compose_drawings, compose_drawn  # noqa: PLC0415 - as above
    from contoursolve.solving import Drawing  # noqa: PLC0415 - as above

    scene = compose_drawn(drawings, title) if isinstance(drawings, Drawing) else compose_drawings(drawings, title)
    return finish(lay_out(scene), theme, str(drawings))


def draw_sweep(
    ready: CompiledSweep, *, result: str | None = None, theme: Theme = Theme.LIGHT, title: str | None = None
) -> Picture:
    """The picture of a sweep: the fan of contours where one word varies, the map of outcomes where two do.

    Of too many values, some are drawn. The title counts all contours, and solves them for that; with a title of your
    own, only those that are drawn. A map may show a `result`, as `draw_family_map`. Raises FamilyError for paired
    words, where none or more than two vary, and for a result that is none, or of one word.
    """
    from contoursolve.families import FamilyError  # noqa: PLC0415 - as above
    from contoursolve.pictures.maps import lay_out_map  # noqa: PLC0415 - as above
    from contoursolve.pictures.sweeps import count_statuses, solve_shown, sweep_title  # noqa: PLC0415 - as above

    shown = solve_shown(ready)
    if result is not None and isinstance(shown, tuple):
        raise FamilyError(f"a map of {result} takes two words that vary; this family has {shown[0]}")
    told = title if title is not None else sweep_title(ready.ranges, count_statuses(ready))
    if isinstance(shown, tuple):
        return draw_family_fan(*shown, theme=theme, title=told)
    return finish(lay_out_map(shown, None, told, ready.ranges, result), theme)


def _draw_sketch(sketch: Sketch, **options: Any) -> Picture:
    return draw_drawings(sketch.solve(), **options)


_DRAWN: Mapping[str, tuple[Callable[..., Picture], tuple[str, ...]]] = {
    "Answer": (draw_answer, ("title", "like", "has_remarks", "beside")),
    "Result": (draw_result, ("title", "is_whole", "beside")),
    "Comparison": (draw_comparison, ("title",)),
    "Family": (draw_family, ("title", "words", "result")),
    "FeasibleRange": (draw_range, ("title",)),
    "FeasibleRegion": (draw_region, ("title", "result")),
    "EquationSystem": (draw_matrix, ("title",)),
    "Sketch": (_draw_sketch, ("title",)),
    "Drawings": (draw_drawings, ("title",)),
    "Drawing": (draw_drawings, ("title",)),
}
"""The function for each kind of record, by its name, for its room need not be imported; and its options beside the
theme."""
