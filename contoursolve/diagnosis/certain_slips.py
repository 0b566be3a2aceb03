"""Slips that leave hardly a doubt of what was meant: a lost comma, a letter for a digit, a word of another control.
They are mended in thought, so that what else is wrong with a contour is found as well; and the way back to the text."""

from collections.abc import Iterable, Iterator

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.edits import Edit, EditKind, apply_edits, change, edited, mend
from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.explain import spans_of
from contoursolve.diagnosis.slips_around import touches
from contoursolve.diagnosis.slips_of_blocks import rewritten
from contoursolve.diagnosis.spelling import meant_words, respelled, torn_codes
from contoursolve.diagnosis.window import Window
from contoursolve.diagnostics import Diagnostic, Label, LineChange, Span
from contoursolve.gcode import Block, Substitution, parse_block, typed_span


def certain_slips(answer: Answer, window: Window) -> tuple[Edit, ...]:
    """The edits that undo the slips of a contour that are certain, by their places; none where facts are stated, or
    where its text is not what the lines say."""
    claim = answer.claim
    if torn_codes(claim):
        # Without its letters the code is another one: what its words are is not known.
        return ()
    if claim.trusted or claim.directives or any(block.callers or block.substituted for block in claim.blocks):
        return ()
    found = [mend(each) for each in meant_words(claim)]

    def add(edit: Edit) -> None:
        if edit.span is not None and not any(touches(each, edit.span) for each in found):
            found.append(edit)

    torn = [fault.span for block in claim.blocks for fault in block.faults]
    torn += [word.span for word in claim.unknown]
    for edit in rewritten(window, claim.blocks) if torn else ():
        if any(touches(edit, span) for span in torn):
            add(edit)
    for word in claim.unknown:
        if text := respelled(word, claim):
            add(change(word, text))
    return tuple(sorted(found, key=lambda edit: edit.span or Span(edit.line, 0, 0)))


class MendedText(Struct, frozen=True):
    """Blocks with changes of words that are made in thought, and the way back from places in their text to the blocks
    as they are typed; the first `count` of them are the contour as it is typed."""

    blocks: tuple[Block, ...]
    edits: tuple[Edit, ...]
    count: int = 0

    @property
    def own(self) -> tuple[Block, ...]:
        """The blocks of the contour as it is typed."""
        return self.blocks[: self.count]

    def read(self) -> tuple[Block, ...]:
        """The blocks with the changes made."""
        texts = zip(self.blocks, apply_edits(self.blocks, self.edits), strict=True)
        return tuple(
            block if text == block.text else parse_block(text, block.line, block.syntax).with_points(block.pointed)
            for block, text in texts
        )

    def _changes(self, line: int) -> tuple[Substitution, ...]:
        own = [(edit, edit.span) for edit in self.edits if edit.span is not None and edit.span.line == line]
        return tuple(Substitution(span.column - 1, span.end_column - 1, edit.old, edit.text) for edit, span in own)

    def place(self, span: Span) -> Span:
        """The place of a stretch of the mended text in the text as it is typed."""
        return typed_span(span, self._changes(span.line))

    def typed(self, edit: Edit) -> Edit:
        """A change of the mended text as one of the text as it is typed."""
        if edit.span is None or not (changes := self._changes(edit.span.line)):
            return edit
        text, shift, begin, end = edit.text, 0, edit.span.column - 1, edit.span.end_column - 1
        for each in changes:
            first = each.begin + shift
            last = first + len(each.number)
            shift = last - each.end
            if begin < last and first < end:
                # Of a word that was mended, what stays.
                text = (
                    each.number[: max(begin - first, 0)] + text + each.number[len(each.number) - max(last - end, 0) :]
                )
        span = self.place(edit.span)
        block = next(each for each in self.blocks if each.line == span.line)
        kind = EditKind.CHANGE if text else edit.kind
        old = block.text[span.column - 1 : span.end_column - 1]
        return Edit(kind, edit.address, span, old, text, edit.line, edit.why)

    def edited(self, edits: Iterable[Edit]) -> str:
        """The lines of the contour as they are typed, with some changes of the mended text that are in them."""
        lines = {block.line for block in self.own}
        return edited(self.own, [self.typed(edit) for edit in edits if edit.place in lines])

    def beside(self, edits: Iterable[Edit]) -> Iterator[LineChange]:
        """The changes of the blocks behind it."""
        behind = self.blocks[self.count :]
        lines = {block.line for block in behind}
        texts = apply_edits(behind, [self.typed(edit) for edit in edits if edit.place in lines])
        for block, text in zip(behind, texts, strict=True):
            if text != block.text:
                yield LineChange(block.span, text, block.text)

    def told(self, finding: Diagnostic) -> Diagnostic:
        """A finding about the mended text with its places in the text as it is typed."""
        labels = tuple(Label(self.place(each.span), each.text) for each in finding.labels)
        return replace(finding, span=self.place(finding.span), labels=labels)


def about(finding: Diagnostic, edits: Iterable[Edit]) -> tuple[Edit, ...]:
    """The edits that change what a finding marks."""
    spans = spans_of([finding])
    return tuple(edit for edit in edits if any(touches(edit, span) for span in spans))
