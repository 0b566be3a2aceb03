"""Programs of a control that is not programmed in G codes: contours in its plain words, or all of it in G codes."""

from collections.abc import Iterator, Mapping, Sequence
from math import atan2, ceil, cos, dist, radians, sin
from typing import cast

from msgspec.structs import replace

from contoursolve.diagnosis import Answer
from contoursolve.gcode import Block, Word, comment_out, own_comments, remark
from contoursolve.geometry import Turn
from contoursolve.postprocess.emit import MotionBlock, emit, longest
from contoursolve.postprocess.expander import NAMES, Expander
from contoursolve.postprocess.expansion_report import ExpansionOptions, Left, Summary
from contoursolve.postprocess.numbering import Numbers
from contoursolve.program import Lines, Step
from contoursolve.reading import (
    NOTHING,
    Around,
    Carried,
    ContourBlock,
    Control,
    ParsedContour,
    Restated,
    State,
    Writing,
    advance,
    frame_of,
)
from contoursolve.solving import ArcSegment


class _Expander(Expander):
    """Base of both expanders: no motion stays in force."""

    has_motions = False

    def __init__(
        self, control: Control, options: ExpansionOptions, summary: Summary, lines: Lines, numbers: Numbers | None
    ) -> None:
        super().__init__(control, options, summary, lines, numbers)
        self.writing = cast("Writing", control.writing)

    def _relying(self, *_: object) -> str:
        return ""

    def _kept(self, _: Block) -> list[Word]:
        return []

    def _aside(self, part: ContourBlock | None, claim: ParsedContour, state: State) -> State | None:
        """A move of other axes alone may stand between the blocks of a contour, too."""
        if part is None:
            return state
        if part.names or not claim.beside_plane(part.block):
            return None
        state = claim.before
        for block in claim.blocks[: claim.blocks.index(part.block)]:
            state = advance(state, block, self.modes) if claim.beside_plane(block) else state
        return state


class InOwnWords(_Expander):
    """Contours in the plain words of the control; everything else stays."""

    has_absolute_centers = True

    def __init__(
        self, control: Control, options: ExpansionOptions, summary: Summary, lines: Lines, numbers: Numbers | None
    ) -> None:
        super().__init__(control, options, summary, lines, numbers)
        self.own = self.writing.own()
        self.center_decimals = self.writing.center_decimals
        self.numberer.prefix = self.writing.number_prefix

    def _keep(self, block: Block, state: State, there: int | None = None) -> Iterator[str]:
        self.own.keep(block)
        yield from super()._keep(block, state, there)

    def _replace(self, step: Step, answer: Answer) -> Iterator[str]:
        self.claim = answer.claim
        yield from super()._replace(step, answer)

    def _behind(self, block: Block, _state: State) -> State | None:
        """The state behind the last block of what is written."""
        return self.claim.after if block.line == self.claim.blocks[-1].line else None

    def _write(self, block: Block, moves: list[MotionBlock], end: str, state: State, solved: Block) -> str:
        texts = self.own.write(solved, [(move.code, move.words) for move in moves])
        after = self._behind(block, state)
        behind = self.own.close(after) if after is not None else []
        frame, number = frame_of(block.text), block.find("N")
        comments = comment_out(block.text, block.syntax) if self.options.has_comments else []
        beside = [] if comments else own_comments(block)
        if texts:
            self._tell(block, self.numberer.number(block, [number.text.strip()] if number else [], texts))
            texts[0] += beside
        written = [frame.skip + " ".join(text) for text in (*texts, *behind)] or beside
        lines = [frame.indent + text for text in (*comments, *written)]
        return (end or self.lines.end).join(lines) + end if lines else ""


class InGCodes(_Expander):
    """All of a program in G codes; what has none is a comment."""

    def __init__(
        self, control: Control, options: ExpansionOptions, summary: Summary, lines: Lines, numbers: Numbers | None
    ) -> None:
        super().__init__(control, options, summary, lines, numbers)
        self.plain = self.writing.plain()

    def _keep(self, block: Block, state: State, _there: int | None = None) -> Iterator[str]:
        """A block in G codes, or as a comment."""
        after, end = advance(state, block, self.modes), self.lines.take_end(block.line)
        is_said = bool(block.words or block.macro or block.faults)
        said = self.plain.restate(block, state, after) if is_said else Restated()
        moves = list(self._moves(said, state))
        if is_said:
            if self.summary.unit not in (None, after.unit):
                unit = self.options.post.code_of(after.unit)
                said = replace(said, says=said.says._replace(codes=(unit, *said.says.codes)))
            self.summary.unit = after.unit if self.summary.unit is None else self.summary.unit
            self.summary.restated += 1
        yield from self._say_left(block, said.reason)
        yield self._lines(block, said.says, moves, end, is_kept=bool(said.reason) and not moves)

    def _leave(self, step: Step, answer: Answer, reason: str) -> Iterator[str]:
        lines, sources = tuple(block.line for block in answer.claim.blocks), {b.line: b.text for b in step.blocks}
        self.summary.left.append(Left(lines, reason, answer.diagnostics, sources))
        yield remark(reason, self._syntax_of(step.blocks[0])) + self.lines.end
        for block in step.blocks:
            yield self._lines(block, NOTHING, (), self.lines.take_end(block.line), is_kept=True)

    def _obstacle(self, answer: Answer) -> str:
        rows = self.modes.lexicon.addresses
        beside = (word for block in answer.claim.blocks[:1] for word in answer.claim.beside_plane(block))
        steps = [word.text for word in beside if rows[word.address].is_increment]
        reason = f"{steps[0]} moves an axis outside the plane: move it in a block of its own" if steps else ""
        return super()._obstacle(answer) or reason

    def _steps(self, part: ContourBlock, answer: Answer) -> tuple[str, ...] | None:
        return None if answer.start.is_relative else super()._steps(part, answer)

    def _is_rapid(self, part: ContourBlock) -> bool:
        return self.plain.is_rapid(part.block)

    def _write(self, block: Block, moves: list[MotionBlock], end: str, state: State, _solved: Block) -> str:
        said = self.plain.beside(block, state)
        self.summary.unit = self.summary.unit or state.unit
        return "".join(self._say_left(block, said.reason)) + self._lines(block, said.says, moves, end)

    def _say_left(self, block: Block, reason: str) -> Iterator[str]:
        """Lines with the reason why a block, or some of it, is not written. Blocks in a row with the same reason are
        one entry."""
        if not reason:
            return
        left = self.summary.left
        before = left[-1] if left and left[-1].reason == reason and left[-1].lines[-1] == block.line - 1 else None
        if before is None:
            self._tell(block, reason)
            yield remark(reason, self._syntax_of(block)) + self.lines.end
        else:
            sources = {**before.sources, block.line: block.text}
            left[-1] = replace(before, lines=(*before.lines, block.line), sources=sources)

    def _moves(self, said: Restated, before: State) -> Iterator[MotionBlock]:
        """The moves of a block: a line to its end, or its arc."""
        if said.around is not None:
            yield from self._arc(said.around, said.ends, before)
        elif said.ends:
            form = self._format(before)
            self.offsets.keep([axis for axis in self.modes.axes if axis not in said.ends])
            words = tuple(axis + form.number(end / form.mm) for axis, end in said.ends.items())
            yield MotionBlock(0 if said.is_rapid else 1, words, (0.0, 0.0), 0.0)

    def _arc(self, around: Around, ends: Mapping[str, float], before: State) -> Iterator[MotionBlock]:
        """An arc, and how far other axes go along with each of its moves."""
        form, axes, (center, sweep) = self._format(before), before.plane.axes, around
        first, second = (float(before.axes[axis].value or 0) for axis in axes)
        one, two = self.offsets.take(axes)
        here, at, turn = (first + one, second + two), (first, second), Turn.CCW if sweep > 0 else Turn.CW
        radius, begin = dist(at, center), atan2(second - center[1], first - center[0])
        beside = {axis: (float(before.axes[axis].value or 0), end) for axis, end in ends.items() if axis not in axes}
        parts = ceil(abs(sweep) / (longest(form) - 1.0))
        for number in range(1, parts + 1):
            share = number / parts
            angle = begin + radians(sweep) * share
            end = (center[0] + radius * cos(angle), center[1] + radius * sin(angle))
            end = (ends[axes[0]], ends[axes[1]]) if number == parts else end
            rises = {axis: (low, low + (high - low) * share) for axis, (low, high) in beside.items()}
            for move in emit(ArcSegment("", at, end, center, radius, turn), here, form, beside=rises):
                here = move.end
                yield move
            at = end
        self.offsets.leave(axes, here, at)

    def _lines(
        self, block: Block, says: Carried, moves: Sequence[MotionBlock], end: str, *, is_kept: bool = False
    ) -> str:
        """The lines in place of a block; `is_kept` where it has to be a comment."""
        syntax = self._syntax_of(block)
        texts = [[NAMES[move.code], *move.words] for move in moves if move.words]
        texts = texts or ([[]] if says.codes or says.words or says.last else [])
        is_remark_alone = not (block.words or block.macro or block.faults)
        is_shown = (self.options.has_comments or is_kept or not texts) and not is_remark_alone
        comments = [text for each in own_comments(block) for text in comment_out(each.strip("; "), syntax)]
        if texts:
            texts[0] = [*says.codes, *texts[0], *says.words]
            texts[-1] += says.last
            self._tell(block, self.numberer.number(block, list(says.numbers), texts))
            texts[0] += comments if not is_shown else []
        lines = comment_out(block.text, syntax) if is_shown else comments if not texts else []
        lines += [("/" if block.is_skippable else "") + " ".join(text) for text in texts]
        return (end or self.lines.end).join(lines) + end if lines or not block.text.strip() else ""
