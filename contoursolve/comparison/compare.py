"""Compares two paths: every difference with its words, the largest first; and what changed besides."""

from collections.abc import Iterator, Sequence
from functools import cache
from itertools import chain
from math import inf
from typing import Any

from msgspec import Struct

from contoursolve.comparison.align import Alignment, align
from contoursolve.comparison.detours import DetourDifferences, Difference, joined
from contoursolve.comparison.follow import ToolPath
from contoursolve.comparison.travel import Travel
from contoursolve.comparison.words import (
    BlockUse,
    Change,
    Quote,
    beside_path,
    changed_comments,
    changes_between,
    mode_words,
    news_of,
)
from contoursolve.diagnostics import Shown, UserError, hash_of
from contoursolve.gcode import Block
from contoursolve.program import Request, Result


class NotComparedError(UserError):
    """A program that has errors, so that it has no path; the message has the first one of each program.

    `results` are both programs as they were solved, `asked` how they were read.
    """

    def __init__(self, results: Sequence[Result], asked: Sequence[Request]) -> None:
        self.results, self.asked = tuple(results), tuple(asked)
        told: list[str] = []
        for each in results:
            error = next((one for one in each.diagnostics if one.is_error), None)
            if error is not None:
                told.append(f"{each.program.name}, program line {error.span.line}: {error.message}")
        super().__init__("not compared: a program that has errors has no path\n" + "\n".join(told))

    def __reduce__(self) -> Any:
        return type(self), (self.results, self.asked)


class Comparison(Shown, Struct, frozen=True):
    """Two paths, and all their differences.

    Attributes:
        old: the path of the first program.
        new: that of the second one.
        tolerance: the distance up to which two paths are the same, mm.
        differences: all differences, the largest first; those that are no distance come last, as they run.
        difference: the first one along the path; None where the paths are the same.
        deviation: the distance to within which they are the same, mm.
        lines: the lines of the first and of the second program where the deviation is largest.
        alignment: the moves of both that belong together.
    """

    old: ToolPath
    new: ToolPath
    tolerance: float
    differences: tuple[Difference, ...]
    difference: Difference | None
    deviation: float
    lines: tuple[int, int] | None
    alignment: Alignment

    __hash__ = hash_of

    @property
    def is_equal(self) -> bool:
        """Whether there is no difference."""
        return self.difference is None


def compare(old: ToolPath, new: ToolPath, tolerance: float) -> Comparison:
    """Compare two paths to within a tolerance, mm. A move that only one of them has shifts nothing behind it.

    It makes no difference into how many collinear lines or arcs of one circle a cut is divided.
    """
    alignment = align(old.steps, new.steps, tolerance)
    modes = cache(lambda: _mode_changes(old, new, alignment))
    detours = (DetourDifferences(old, new, each, tolerance, modes) for each in alignment.detours)
    found = joined(each for detour in detours for each in detour.differences())
    # Sorting keeps what is equal in the order of the path.
    ordered = sorted(found, key=lambda each: inf if each.distance is None else -each.distance)
    first = found[0] if found else None
    return Comparison(old, new, tolerance, tuple(ordered), first, alignment.deviation, alignment.lines, alignment)


def _mode_changes(old: ToolPath, new: ToolPath, alignment: Alignment) -> list[tuple[int, Change]]:
    """The codes that change how the blocks behind them are read, by the step of OLD before which they stand."""
    sides, found = [_Blocks(path) for path in (old, new)], list[tuple[int, Change]]()
    for first, second in alignment.shared:
        words = [
            [word for _, block in side.until(at) if path.modes for word in mode_words(block, path.modes)]
            for side, path, at in zip(sides, (old, new), (first, second), strict=True)
        ]
        found += [(first, each) for each in changes_between(*words)]
    return found


class _Blocks:
    """The blocks of a program as they run, from step to step, with their places."""

    def __init__(self, path: ToolPath) -> None:
        self.path, self.place = path, 0

    def until(self, step: int) -> Iterator[tuple[int, Block]]:
        """Those behind the step before, up to that of this one."""
        path, first = self.path, self.place
        stop = len(path.blocks) if step >= len(path.steps) else path.steps[step].number + 1
        self.place = max(first, stop)
        return enumerate(path.blocks[first:stop], first)


# Besides the path --------------------------------------------------------------------------------------------


def changes_beside(comparison: Comparison) -> tuple[Change, ...]:
    """List what changed besides the path, in the order of the programs: tools, their offsets, feeds, speeds, functions
    and dwells, as they run, and behind them the comments."""
    old, new = comparison.old, comparison.new
    if old.modes is None or new.modes is None or not old.program or not new.program:
        return ()
    told = {change for each in comparison.differences for change in each.changes}
    sides = [_Beside(path) for path in (old, new)]
    changes = list[Change]()
    for first, second in comparison.alignment.shared:
        changes += changes_between(sides[0].until(first), sides[1].until(second))
    changes += changed_comments(old.program.blocks, new.program.blocks, (old.blocks, new.blocks))
    return tuple(dict.fromkeys(each for each in changes if each not in told))


class _Beside:
    """The words of a program besides its path, from step to step."""

    def __init__(self, path: ToolPath) -> None:
        self.modes, self.blocks, self.lasting = path.modes, _Blocks(path), dict[str, object]()
        self.roles = {each.number: BlockUse.UNFOLLOWED for each in path.unfollowed}
        contours = (each for each in path.steps if isinstance(each, Travel) and each.element)
        self.roles |= {each.number: BlockUse.CONTOUR for each in contours}

    def until(self, step: int) -> list[Quote]:
        """The words behind the step before, up to the block of this one."""
        if self.modes is None:
            return []
        roles, blocks = self.roles, self.blocks.until(step)
        words = (beside_path(block, self.modes, roles.get(number, BlockUse.PLAIN)) for number, block in blocks)
        return [*news_of(chain.from_iterable(words), self.lasting)]
