"""Options of an expansion, and its account of the contours of the program."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from msgspec import Struct, field

from contoursolve.diagnosis import join
from contoursolve.diagnostics import Diagnostic, LateModule, ProgramError, Severity, hash_of
from contoursolve.gcode import Block, FaultKind
from contoursolve.geometry import Length
from contoursolve.postprocess.post_processors import SAME, Arcs, Numbering, Post, Risk
from contoursolve.postprocess.untranslatable import Unfamiliar

if TYPE_CHECKING:
    from contoursolve import comparison as paths
else:
    paths = LateModule("contoursolve.comparison")

_KEPT_WARNINGS = 20
"""Warnings that are kept to be shown."""


class ExpansionOptions(Struct, frozen=True):
    """Options of an expansion: the target, its arcs, its decimals (None: the target's own), and block numbers.
    `has_comments` keeps the original blocks as comments, `is_inline` writes calls out."""

    post: Post = SAME
    arcs: Arcs = Arcs.CENTER
    decimals: int | None = None
    has_comments: bool = True
    numbering: Numbering = Numbering.FIRST
    is_inline: bool = False


class Left(Struct, frozen=True):
    """A contour that was left as it is: its lines with their texts, why, and the findings about it."""

    lines: tuple[int, ...]
    reason: str
    diagnostics: tuple[Diagnostic, ...]
    sources: Mapping[int, str]
    is_end: bool = False
    """Whether the program is not followed beyond these lines, so that nothing may be written."""


class FixedWords(Struct, frozen=True):
    """Words with variables on a line, and the words with numbers that are written for them."""

    line: int
    words: tuple[str, ...]
    numbers: tuple[str, ...]

    @property
    def sentence(self) -> str:
        """The words, the numbers that stand for them in what is written, and the meaning of that."""
        words, numbers = join(self.words), join(self.numbers)
        are = "is" if len(self.words) == 1 else "are"
        return f"{words} {are} written as {numbers}: other values of the variables no longer count"


class Summary(Struct):
    """Account of a program's contours, as far as it has been read; `deviation` is the largest distance of the written
    path from the exact contours, mm."""

    replaced: int = 0
    in_words: int = 0
    """Number of replaced contours that are in the target's own words for contours."""
    written_out: list[int] = field(default_factory=list)
    """The first lines of those that the target has no words for, where that was asked for."""
    warnings: int = 0
    """Number of warnings about replaced contours, and about lines that may be meant otherwise."""
    warned: list[Diagnostic] = field(default_factory=list)
    """The first of them."""
    deviation: float = 0.0
    left: list[Left] = field(default_factory=list)
    concluded: list[Diagnostic] = field(default_factory=list)
    """Conclusions about the control, where the program does not name it."""
    elsewhere: list[Diagnostic] = field(default_factory=list)
    """Findings about contours of called files, which stay as they are."""
    unfamiliar: list[Unfamiliar] = field(default_factory=list)
    fixed: list[FixedWords] = field(default_factory=list)
    """Words of replaced contours whose variables have the values of one run."""
    restated: int = 0
    """Blocks outside contours that were written in G codes, where the program is in other words."""
    unit: Length | None = None
    """The unit at its begin, where it says so itself."""
    counts_diameters: bool | None = None
    """The use of X as a diameter in contours of a program that does not state it; None without such contours."""
    line_end: str = "\n"
    """The end of the first line that has one."""

    @property
    def has_end(self) -> bool:
        """Whether the program is not followed to its end, so that nothing may be written."""
        return any(each.is_end for each in self.left)

    @property
    def misread(self) -> list[Unfamiliar]:
        """Of what the target reads in another way, that by which the tool may go another way without an alarm."""
        return [each for each in self.unfamiliar if each.risk is Risk.PATH]

    def warn(self, findings: Sequence[Diagnostic]) -> None:
        """Note the warnings among the findings about a contour that was replaced, or about lines that stay."""
        warnings = [each for each in findings if each.severity is Severity.WARNING]
        self.warnings += len(warnings)
        self.warned += warnings[: max(0, _KEPT_WARNINGS - len(self.warned))]


class Expansion(Struct, frozen=True):
    """A program in plain G-code.

    Attributes:
        text: the program; None where a contour fails, or where the target would run something along another path.
        control: the control that it was for; None where nothing tells it.
        summary: how many contours were replaced, and what was left and why.
    """

    text: str | None
    control: str | None
    summary: Summary

    __hash__ = hash_of


class ConversionError(ProgramError, ValueError):
    """A program cannot be written for a control at all."""


class NotConverted(Struct, frozen=True):
    """Something of a program that has no counterpart on another control.

    Attributes:
        line: its line in the program, from 1.
        text: the words, as they are typed.
        reason: why they are not converted.
        is_block: whether it is a whole block, with its motion if it has one.
        times: how many times it stands in the new program, as of a loop that is written out.
        called: the file of a subprogram that has it, with its line; empty for the program itself.
    """

    line: int
    text: str
    reason: str
    is_block: bool = False
    times: int = 1
    called: str = ""

    @property
    def sentence(self) -> str:
        """The words that stand as a comment, and the reason."""
        place, often = f" in {self.called}" * bool(self.called), f" ({self.times} times)" * (self.times > 1)
        return f"{self.text}{place} is not converted{often}: {self.reason}"


class Conversion(Struct, frozen=True):
    """A program in another control's own words.

    Attributes:
        text: the program; None where its path would not be the same.
        control: the control that it was for.
        to: the name of the other control.
        summary: how many contours it has, how many of them in words of the other control, and which are written out.
        comparison: that of both paths, with its `deviation` (mm), without the blocks that are not converted; None where
            nothing could be compared.
        not_converted: what has no counterpart, in the order of the program. It stands as a comment in its place.
        notes: what the program does not say and is written, and what is assumed.
        lines: for each line of the text, the line of the program for which it stands; 0 for its frame.
    """

    text: str | None
    control: str | None
    to: str
    summary: Summary
    comparison: "paths.Comparison | None"
    not_converted: tuple[NotConverted, ...] = ()
    notes: tuple[str, ...] = ()
    lines: tuple[int, ...] = ()

    __hash__ = hash_of


def left_unread(block: Block) -> Left | None:
    """A block that is too long to be read, and may be a contour."""
    if all(fault.kind is not FaultKind.BLOCK_TOO_LONG for fault in block.faults):
        return None
    return Left((block.line,), f"the block has {len(block.text):,} characters and was not read", (), {})
