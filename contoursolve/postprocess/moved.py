"""A program whose blocks move along other elements than they state: beside what they cut, as a tool's centre does."""

from collections.abc import Iterator, Mapping, Set
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Answer
from contoursolve.diagnostics import Diagnostic
from contoursolve.gcode import Block, Passage, Word, comment_out, parse_block, remark
from contoursolve.postprocess.emit import MotionBlock, emit, plane_of
from contoursolve.postprocess.expander import Expander
from contoursolve.postprocess.expansion_report import Left
from contoursolve.postprocess.restating import InOwnWords
from contoursolve.program import Lines, Step
from contoursolve.reading import Effect, State, advance, apply_modes, blocks_of, codes_of
from contoursolve.solving import Point, Segment

Move = tuple[Segment, bool, Mapping[str, tuple[float, float]]]
"""An element, whether it is a rapid, and axes outside its plane: from where to where (mm) they move along."""


class MovedProgram(Struct, frozen=True):
    """The elements that blocks make instead of their own, by program line; the lines that stay as they are, with the
    reason at the first of each; and remarks above lines. All other words of compensation are taken out."""

    moves: Mapping[int, tuple[Move, ...]]
    left: Mapping[int, Left]
    kept: Set[int]
    remarks: Mapping[int, str]
    warnings: Mapping[int, tuple[Diagnostic, ...]]
    """The warnings about the moves that begin at a line."""
    leaving: Set[int]
    """The lines behind which the tool is where the program has it."""
    keeps_d: bool
    """Whether D stays."""

    def lines(self, *args: Any, **options: Any) -> Lines:
        """The lines of the program on their way."""
        return Lines(*args, **options)

    def expander(self, *args: Any) -> "MovedExpander":
        """The pass over the program."""
        found = (MovedExpander if args[0].writing is None else MovedInOwnWords)(*args)
        found.moved = self
        return found


_PLAIN = (Effect.MOTION, Effect.COMPENSATION, Effect.NONE)
"""Codes beside which coordinates are a move."""


class MovedExpander(Expander):
    """One pass over one program."""

    moved: MovedProgram
    here: Point | None = None
    """Place of the tool, as long as that is not where the program has it."""

    def _pass(self, passage: Passage, state: State) -> Iterator[str | object]:
        numbers = range(passage.line, passage.line + len(passage.lines))
        is_touched = not (self.moved.moves.keys() | self.moved.left.keys()).isdisjoint(numbers)
        if not is_touched and self.here is None:
            yield from super()._pass(passage, state)
            return
        for number, line in zip(numbers, passage.lines, strict=True):
            block = parse_block(line.rstrip("\r\n"), number, self.modes.syntax)
            yield from self._keep(block, state)
            state = advance(state, block, self.modes)

    def _keep(self, block: Block, state: State, there: int | None = None) -> Iterator[str]:
        left = self.moved.left.get(block.line)
        if left is not None:
            self.summary.left.append(left)
            yield remark(left.reason, self._syntax_of(block)) + self.lines.end
        moves = self.moved.moves.get(block.line)
        if moves is None and self.here is not None and self._stays(block, state):
            moves = ()
        if moves is not None:
            yield from self._move(block, apply_modes(state, block, self.modes), moves)
            return
        if block.line not in self.moved.kept:
            bare = self._without_compensation(block)
            if block.words and not bare.words and not bare.text.strip(" /"):
                self.lines.take_end(block.line)
                return
            block = bare
        yield from super()._keep(block, state, there)

    def _replace(self, step: Step, answer: Answer) -> Iterator[str]:
        lines = {block.line for block in step.blocks}
        if lines <= self.moved.kept:
            state = step.before
            for block in step.blocks:
                yield from self._keep(block, state)
                state = apply_modes(state, block, self.modes)
            return
        if lines.isdisjoint(self.moved.moves):
            yield from super()._replace(step, answer)
            return
        parts = {part.block.line: part for part in blocks_of(answer.claim, step.before, self.modes)}
        for block in step.blocks:
            part = parts.get(block.line)
            own = answer.contour.elements if part is not None and answer.contour is not None else ()
            elements: tuple[Move, ...] = tuple(
                (each, part.is_rapid, {}) for each in own if part is not None and part.makes(each.name)
            )
            state = part.state if part is not None else step.before
            if part is None and block.line not in self.moved.moves:
                yield from self._keep(block, state)
            else:
                moves = self.moved.moves.get(block.line, elements)
                yield from self._move(block, replace(state, plane=plane_of(answer.plane, state)), moves)
        self.summary.warn(answer.diagnostics)

    def _move(self, block: Block, state: State, moves: tuple[Move, ...]) -> Iterator[str]:
        """The lines in place of a block."""
        if block.line in self.moved.remarks:
            self.summary.replaced += 1
            self.summary.warn(self.moved.warnings.get(block.line, ()))
            yield comment_out(self.moved.remarks[block.line], self._syntax_of(block))[0] + self.lines.end
        form, written = self._format(state), list[MotionBlock]()
        for segment, is_rapid, along in moves:
            for move in emit(segment, self.here or segment.start, form, is_rapid=is_rapid, beside=along):
                self.here = move.end
                self.summary.deviation = max(self.summary.deviation, move.deviation)
                written += [move] if move.words else []
            self.offsets.leave(state.plane.axes, self.here or segment.end, segment.end)
        axes = self.modes.lexicon.addresses
        rows = ((word, axes.get(word.address)) for word in block.words)
        made = {*state.plane.axes, *(axis for _, _, along in moves for axis in along)}
        beside = [word for word, row in rows if row and row.axis and row.axis not in made]
        if beside:
            texts = [self._as_written(word, form, state) for word in beside]
            last = written.pop() if written else MotionBlock(state.motion or 0, (), self.here or (0.0, 0.0), 0.0)
            written.append(last._replace(words=(*last.words, *texts)))
        bare = self._without_compensation(block)
        # An absolute centre, I=AC(20), is a part of the arc.
        bare = replace(bare, words=tuple(word for word in bare.words if not word.address.endswith("=AC")))
        end = self.lines.take_end(block.line)
        text = self._write(block, written, end, state, bare)
        yield block.text + end if text.endswith("\n" + block.text + end) else text
        self.is_marked = False
        self.here = None if block.line in self.moved.leaving else self.here
        self.motion = None if not written or written[-1].code == state.motion else written[-1].code

    def _stays(self, block: Block, state: State) -> bool:
        """Whether a block states where the tool is already: said again, it would lead to the contour itself."""
        after, codes = advance(state, block, self.modes), codes_of(block, self.modes)
        is_plain = all(not isinstance(code, Word) and code.effect in _PLAIN for code in codes)
        rows = (self.modes.lexicon.addresses.get(word.address) for word in block.words)
        return is_plain and after.start() == state.start() and any(row and row.axis in after.plane.axes for row in rows)

    def _without_compensation(self, block: Block) -> Block:
        """A block without G40, G41, G42 and D."""
        rows = iter(codes_of(block, self.modes) if block.words else ())
        text, kept = block.text, list[Word]()
        for word, row in [(word, next(rows) if word.address == "G" else None) for word in block.words][::-1]:
            is_code = row is not None and not isinstance(row, Word) and row.effect is Effect.COMPENSATION
            if not is_code and (word.address != "D" or self.moved.keeps_d):
                kept.insert(0, word)
                continue
            left, right = text[: word.span.column - 1], text[word.span.end_column - 1 :]
            is_apart = left[-1:] == " " and right[:1] not in ("", " ")
            text = left.rstrip(" ") + " " * is_apart + right if left.strip() else left + right.lstrip(" ")
        return block if len(kept) == len(block.words) else replace(block, text=text, words=tuple(kept))


class MovedInOwnWords(MovedExpander, InOwnWords):
    """The same in the plain words of a control that is not programmed in G codes."""

    def _behind(self, block: Block, state: State) -> State | None:
        return state if block.line in self.moved.leaving else None
