"""Opens the explorer of a contour or a map, where its packages are installed."""

from typing import TYPE_CHECKING, Any, Unpack, overload

from contoursolve.diagnostics import LateModule, importing
from contoursolve.families import BlockOptions, Family, FeasibleRegion, with_numbers
from contoursolve.notebook.exploration import begin, rewrite_block
from contoursolve.program import takes
from contoursolve.tool_radius import SideName

if TYPE_CHECKING:
    from contoursolve.notebook import explorer, map_explorer
else:
    explorer, map_explorer = (
        LateModule("contoursolve.notebook.explorer"),
        LateModule("contoursolve.notebook.map_explorer"),
    )


@overload
def explore(block: Family | FeasibleRegion, *, result: str | None = None) -> "map_explorer.MapExplorer": ...


@overload
def explore(
    block: str,
    *,
    line: int | None = None,
    tool: str | None = None,
    side: SideName | None = None,
    **options: Unpack[BlockOptions],
) -> "explorer.Explorer": ...


@takes(BlockOptions)
def explore(
    block: str | Family | FeasibleRegion,
    *,
    line: int | None = None,
    tool: str | None = None,
    side: SideName | None = None,
    result: str | None = None,
    **options: Unpack[BlockOptions],
) -> "explorer.Explorer | map_explorer.MapExplorer":
    """A contour to move, in a notebook: a slider for each word, the picture, the findings and their fixes.

    Arguments and errors as for `solve`; `block` may be several lines, with one contour. With `line`, it is a program,
    and the contour is the one to which that line belongs; all other lines stay as they are, and each change goes back
    into the program. The widget's traits `text` and `values` are what it is now, and may be set; `answer` and `result`
    are what it comes to, and can be observed. Without a kernel the notebook shows the picture as it last was.
    Numbers take the place of variables, and the words that hold them have the sliders. A `tool`, such as
    `"R0.8, tip 3"`, is written into the block as a comment and has a slider for its radius; `side` is `left` or `right`
    where the program has no G41 or G42.

    A family over two words, or a region, is a map: point at it, or press arrow keys, and the contour of these values is
    drawn beside it. A click opens the contour below. `result` colours the map, as for `draw`. Without a kernel, as in
    exported HTML, the map still answers: it holds at most 800 contours, and tells where they are.

    Raises FamilyError for a variable without a value, and MissingExtraError without the packages of
    `contoursolve[notebook]`. Raises ValueError for several contours without `line`, and for a line that belongs to
    none. A family must be a grid of two words.
    """
    if not isinstance(block, str):
        with importing("notebook", "exploring a map"):
            from contoursolve.notebook.map_explorer import MapExplorer  # noqa: PLC0415 - needs an extra
        return MapExplorer(block, result)
    with importing("notebook", "exploring a contour"):
        from contoursolve.notebook.explorer import Explorer  # noqa: PLC0415 - needs an extra
    asked: dict[str, Any] = {**options}
    facts, variables = asked.pop("facts", ()), asked.pop("variables", None)
    if variables and line is not None:
        now = begin(block, line=line, variables=variables, **asked)
        own = with_numbers(now.block, now.options["control"], asked.get("settings"), variables)
        return Explorer(begin(rewrite_block(now, own).text, facts, line, tool, side, variables=variables, **asked))
    if variables:
        block = with_numbers(block, asked.get("control"), asked.get("settings"), variables)
    return Explorer(begin(block, facts, line, tool, side, **asked))
