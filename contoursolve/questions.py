"""Questions about many values of words: families, ranges and tolerances, of the words of a block or of a tool."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, Unpack, overload

# What these rooms hold is imported when it is asked for, by `help` and `typing.get_type_hints`, too.
from contoursolve import families, tool_radius
from contoursolve.diagnostics import LateModule, check_type
from contoursolve.families import (
    BlockOptions,
    BranchesName,
    Family,
    FamilyError,
    FeasibleRange,
    FeasibleRegion,
    ToleranceRange,
    Tolerances,
)
from contoursolve.program import takes
from contoursolve.tool_radius import ToolOptions

if TYPE_CHECKING:
    from concurrent import futures

    from numpy import typing as arrays
else:
    arrays, futures = LateModule("numpy.typing"), LateModule("concurrent.futures")

_OF_TOOL = ("side", "tip", "outside")


@takes(ToolOptions)
def family(
    block: str,
    *,
    vary: Mapping[str, arrays.ArrayLike],
    paired: bool = False,
    workers: int | None = None,
    executor: futures.Executor | None = None,
    branches: BranchesName = "chosen",
    **options: Unpack[ToolOptions],
) -> Family:
    """Solve a contour for many values of some of its words.

    Args:
        block: the block, or the blocks of one contour; their words stand for one of the values.
        vary: the values of each free word, as written in the block, by its name: its letter (`A`, `,A`), with its
            line where several have it (`2:,A`); `start X` of the start point; for a fact, what it gives the value of
            (`length of line 1`). The values of `tool` are radii of tools, in the unit of the block.
        paired: the values stand side by side, a row each; without it, every combination is a row, with the tool as the
            last axis.
        workers: threads; with an executor, how many stretches of rows it has under way at once.
        executor: any `concurrent.futures.Executor` (processes, loky, Dask's `Client.get_executor()`); its workers get
            plain data and need this package.
        branches: `chosen`, or `all`: each solution of every row, in a last dimension `solution`, where no word chooses
            one; a block that lacks such a word is not refused then. See `Family.solutions`.
        start: words that give the start point, such as `"X40. Z0."`, as the control reads them; or `{"X": 40, "Z": 0}`.
        control: its name, or a control of your own as its tables; found from the block where it is clear.
        facts: further facts, as for `solve`.
        units: `mm` or `inch`, for numbers before any G20 or G21.
        rules: `enforce`, `warn` or `off`.
        settings: conventions of the controls by `control.name`; the default ones without.
        variables: values of the variables in the block that do not vary, by name.
        side: of the tool, `left` or `right`; without it what the program's G41 or G42 (RL, RR) says.
        tip: the number of the imaginary tip of a turning tool, 0 to 9.
        outside: the way around an outside corner, `roll` or `intersect`; without it as the program or the control says.

    Every row has the status, the branch and the contour that `solve` gives the block with these values; the result is
    the same, byte for byte, for any number of workers and any executor. With tools there are three arrays more:
    `tool.fits` (bool; False without a contour), `tool.largest` (mm; the largest of the given radii that cuts this
    contour, NaN where none does), and `tool.fault` (text, such as `arc_too_small`; what stops the tool, or else what it
    is warned of, empty for nothing).

    Raises:
        FamilyError: a word is not there, it has no values, or the blocks are no single contour with a known start.
        RefusedError: a FamilyError; the blocks cannot be read, break a rule or lack words, whatever the values. Its
            message has the first finding with its fix, its `result` has all.
        UnknownControlError: the control is unknown, or the block does not tell it.
        FactPlaceError: facts for a program of several contours.
        SettingError: there is no such setting, or it has no such value.
        NotClosedError: a FamilyError; all branches are asked for, and there is no closed form that has them.
        ToolError: there cannot be such a tool, nothing says its side, or there is no cutting move.
        ValueError: units, rules or branches is none of its choices.

    >>> block = "G111 X100. A180. K-30. B120. P5."
    >>> found = family(block, start="X40. Z0.", vary={"A": [180, 170], "P": [5, 20, 60]})
    >>> found["status"].tolist()
    [[0, 0, 6], [0, 0, 0]]
    >>> [f"{value:.4f}" for value in found["corner 1.end X"][:, 0]]
    ['45.0000', '54.6180']
    >>> vary = {"P": [0.4, 0.8, 1.2], "tool": [0.4, 0.8]}
    >>> family(block + " Q5.", start="X40. Z0.", side="right", tip=3, vary=vary)["tool.fits"].tolist()
    [[True, False], [True, True], [True, True]]
    """
    check_type("vary", vary, Mapping, 'the values of words by their names, such as {"A": [170, 180]}')
    if not any(str(each).lower() == families.TOOL for each in vary):
        _check_toolless(options, "a value of `tool` in vary")
        several: dict[str, Any] = {"executor": executor, "branches": branches}
        return families.family(block, vary=vary, paired=paired, workers=workers, **several, **_of_block(options))
    if executor is not None or branches != "chosen":
        raise FamilyError("a family of tools has no executor, and the branch that the words choose")
    return tool_radius.family_of_tools(block, vary=vary, paired=paired, workers=workers, **options)


@overload
def ranges(  # type: ignore[overload-overlap]  # of all words, only the tool is asked for in a whole program
    block: str,
    word: Literal["tool"],
    within: tuple[float, float] | None = None,
    **options: Unpack[ToolOptions],
) -> Mapping[tuple[int, ...], FeasibleRange]: ...


@overload
def ranges(
    block: str, word: str, within: tuple[float, float] | None = None, **options: Unpack[ToolOptions]
) -> FeasibleRange: ...


@overload
def ranges(
    block: str,
    word: tuple[str, str],
    within: tuple[tuple[float, float], tuple[float, float]],
    **options: Unpack[ToolOptions],
) -> FeasibleRegion: ...


@takes(ToolOptions)
def ranges(block: str, word: Any, within: Any = None, **options: Unpack[ToolOptions]) -> Any:
    """The values of a word, as it is written, with which the contour is solved; or of two words at once.

    Args:
        block: the block, or the blocks of one contour.
        word: the word by its letter (`P`, `,A`), or with its line where several have it (`2:,A`); a word of the start
            point as `start X`; a fact by what it gives the value of (`length of line 1`). Two of these give a region.
            `tool` is the radius of the tool that cuts it.
        within: the range to search, lower value first; of two words, one for each. Without it, one turn of an angle:
            0 to 360, or -360 to 0 for a negative one. Of a length, 1 m to either side; of a tool, up to 1 m.
        options: as for `family`, with the same errors. Raises FamilyError, too, where facts or `?` leave no closed
            form, and names them: `family` solves such a block value by value.

    Of one word it gives every range, and what ends it (`FeasibleRange`). Intervals bound all checks of a contour, so
    that no part is overlooked; each end is computed, and the block solved on both sides. Where an open choice leaves
    several solutions, it follows all.

    Two words give a `FeasibleRegion`. Values all over the box are solved. Around each change of the outcome, so are all
    that a picture can tell apart. Between them nothing is proven.

    Tools give the radii for each contour of a program, by its lines. They are in the unit of the program. Every run of
    cutting moves is a contour, with contour words or without. A smaller tool is taken to fit wherever a larger one
    does, and both sides of each end are tried; there may be two ranges.

    >>> block = "G111 X100. A180. K-30. B120. P5. Q5."
    >>> found = ranges(block, "P", start="X40. Z0.")
    >>> [(round(each.low.value, 4), round(each.high.value, 4)) for each in found.intervals]
    [(0.0, 51.9615)]
    >>> found.intervals[0].high.reason.text
    'P is too large for the first straight: P at most 51.961 mm'
    >>> found = ranges(block, ("A", "P"), within=((150, 210), (1, 60)), start="X40. Z0.")
    >>> len(found.boundaries)
    2
    >>> blocks = "G01 X20. Z-14.6\\nG02 X20.8 Z-15. R0.4\\nG01 X40. Z-15."
    >>> tools = ranges(blocks, "tool", side="right", tip=3, start="X20. Z0.", control="fanuc-lathe")
    >>> tools[1, 2, 3].intervals[0].high.value
    0.4
    """
    if isinstance(word, str) and word.lower() == families.TOOL:
        return tool_radius.find_tools(block, within=within, **options)
    _check_toolless(options, "the word tool")
    check_type("word", word, str | Sequence, "a word, such as 'P', or two, such as ('A', 'P')")
    if isinstance(word, str):
        return families.feasible(block, word, within=within, **_of_block(options))
    if within is None:
        raise FamilyError("two words take a range for each of them: within=((150, 210), (1, 60))")
    return families.region(block, word, within, **_of_block(options))


@overload
def tolerances(
    block: str, *, allowed: Mapping[str, float] | None = None, point: str = "end", **options: Unpack[BlockOptions]
) -> Tolerances: ...


@overload
def tolerances(
    block: str, word: str, *, keep: str, within: float, **options: Unpack[BlockOptions]
) -> ToleranceRange: ...


@takes(BlockOptions)
def tolerances(
    block: str,
    word: str | None = None,
    *,
    allowed: Mapping[str, float] | None = None,
    point: str = "end",
    keep: str | None = None,
    within: float | None = None,
    **options: Unpack[BlockOptions],
) -> Tolerances | ToleranceRange:
    """The effect of tolerances on a point; or the other way round, how far a word may be off.

    Args:
        block: the block, or the blocks of one contour.
        allowed: how far words may be off, as written, by name (`{"P": 0.05}`); of a fact by what it gives the value of.
        point: a point as a `Family` names it (`V2`, `corner 1.center`), or `end`.
        word: the word by its letter (`A`, `,A`), or with its line where several have it (`2:,A`); a word of the start
            point as `start X`; a fact by what it gives the value of (`length of line 1`).
        keep: a coordinate of a point (`end Z`, `corner 1.center X`), or a point (`end`, `V1`); a word that is asked for
            with `?` (`P`); what a fact gives the value of (`length of line 2`, `direction of line 2`).
        within: by how much that may move, as the control writes it: mm or inches, X of a lathe as diameter; degrees.
        options: as for `family`, with the same errors. Raises FamilyError for a word or a point that is not there, and
            for a tolerance below 0. The block must have a contour as it stands.

    Without a word it gives `Tolerances`: by how much each word moves the point. It tells what all of them come to at
    worst, statistically (RSS), and at all combinations of their limits.

    With a word it gives a `ToleranceRange`: the values around its own with which `keep` moves by at most `within`. In
    closed form, interval arithmetic isolates each value with which a point has moved so far. All else is solved value
    by value, which `doubts` say. The contour may end before; then the end says why.

    >>> block = "G111 X100. A180. K-30. B120. P5."
    >>> found = tolerances(block + " Q5.", allowed={"A": 0.1, "K": 0.02}, start="X40. Z0.")
    >>> [(each.word, round(each.moves, 4)) for each in found.effects[:2]]
    [('A', 0.0302), ('K', 0.02)]
    >>> found = tolerances(block, "B", keep="end Z", within=0.01, start="X40. Z0.")
    >>> round(found.minus, 4), round(found.plus, 4), round(found.linear, 4)
    (0.0143, 0.0143, 0.0143)
    >>> found.high.reason.text
    'end Z moves by 0.01 mm'
    """
    if isinstance(word, Mapping):
        raise TypeError(f"tolerances of several words are allowed={word!r}; by itself stands the name of one word")
    if word is None:
        if keep is not None or within is not None:
            raise FamilyError("keep and within are about one word: tolerances(block, 'B', keep='end Z', within=0.01)")
        return families.tolerances(block, allowed, point=point, **options)
    if keep is None or within is None or allowed is not None:
        raise FamilyError(f'how far {word} may be off takes keep, such as "end Z", and within, and no allowed')
    return families.tolerance_for(block, word, keep=keep, within=within, **options)


def _of_block(options: ToolOptions) -> Any:
    """The options that are not about a tool."""
    return {name: value for name, value in options.items() if name not in _OF_TOOL}


def _check_toolless(options: ToolOptions, what: str) -> None:
    stated = [name for name, value in options.items() if name in _OF_TOOL and value is not None]
    if stated:
        raise FamilyError(f"{stated[0]} is about a tool, and goes with {what}")
