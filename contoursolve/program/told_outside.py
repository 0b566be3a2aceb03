"""Choice of findings about blocks outside contours: those on which a contour depends are told.

Programs of other people hold much that no table knows and no contour minds. So a finding about a block outside contours
waits. It is told

* at once, if it is about a contour by itself: a slip whose fix makes a block one, a block or a fault with a word by
  which contours are known, a word of a corner or an angle that the control has not, a block too long to be read, a
  fact, an arc that leads to a contour, a start point apart;
* where the program has a contour, before or behind: words that may be meant for one, and questions; what cannot be read
  in a block that moves an axis of the plane; and what contoursolve does not know or does not follow;
* at the next contour behind it: a G word that cannot be read, a comment that is not closed, text outside the %. Nobody
  knows then which plane, units and mode are in force;
* at a contour whose start rests on its line: the last one that set an axis of the plane, or a word that stays in force,
  or made it unknown. A start that is counted in increments rests on all lines before;
* in the block right behind a contour, at which the contour may end.

What waits in vain is passed over; `check --strict` tells all.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import Enum

from contoursolve.diagnosis import Answer, are_points_usual, corner_words, moves, spans_of
from contoursolve.diagnostics import Diagnostic, Fix, Span
from contoursolve.gcode import Block, FaultKind, Passage, Word, parse_block, words_of
from contoursolve.program.lookahead import Line, each_block
from contoursolve.reading import Control, ReadIssue, State, apply_modes

_BESIDE_CONTOURS: frozenset[Enum | None] = frozenset(
    {ReadIssue.COMMA_MISSING, ReadIssue.COMMA_WORD_UNKNOWN, ReadIssue.ASKED_NOTHING, ReadIssue.FACT_UNMARKED}
    | {ReadIssue.WORD_UNKNOWN, ReadIssue.WORD_IDLE, ReadIssue.CODE_UNKNOWN, ReadIssue.NOT_READ}
)
_BEFORE_CONTOURS: frozenset[Enum | None] = frozenset({ReadIssue.TEXT_OUTSIDE, FaultKind.COMMENT_NOT_CLOSED})
_WAITING = frozenset(
    {*FaultKind, ReadIssue.REPEATED_ADDRESS, ReadIssue.VALUE_TOO_LARGE, *_BESIDE_CONTOURS, *_BEFORE_CONTOURS}
) - {FaultKind.BLOCK_TOO_LONG}


class Outside:
    """One pass over the findings outside the contours of one program, which tells some of them."""

    def __init__(self, control: Control | None, *, is_strict: bool = False) -> None:
        self.is_strict = is_strict
        self._signs = control.signs if control else _no_signs
        self._modes = control.modes if control else None
        own = [each for each in control.modes.lexicon.addresses if len(each) > 1] if control else []
        self._long = {*own, *(control.modes.lexicon.spell(each, "").split(" ")[0] for each in own if control)}
        """Addresses with a comma or several letters: those of contours."""
        self._corners = {*corner_words(control.modes.lexicon)} if control else set[str]()
        self._held: list[Diagnostic] = []
        self._contour = 0
        """The first line of the last contour; 0 if there is none yet."""
        self._is_behind = False
        self._uncertain: list[Diagnostic] = []
        """Moves in increments, which are told once a contour shows that the program writes points."""
        self._is_pointed = False
        self._before: State | None = None
        self._torn: set[Span] = set()
        """Where something cannot be read in a block that moves an axis of the plane."""

    def take(
        self,
        findings: Sequence[Diagnostic],
        line: int,
        lines: Callable[[], Iterable[Line]],
        answer: Answer | None,
        before: State,
    ) -> Iterator[Diagnostic]:
        """The findings to be told once the next lines are known, from line `line` on. They are outside contours, or a
        contour with its answer; `before` is the state before them."""
        if self.is_strict:
            self._before = before
            self._uncertain += [each for each in findings if each.about is ReadIssue.MOVE_IN_INCREMENTS]
            yield from (each for each in findings if each.about is not ReadIssue.MOVE_IN_INCREMENTS)
            if answer is not None:
                yield from self._settle_points(answer)
            return
        blocks = tuple(each_block(tuple(lines()), 0)) if findings else ()
        shown = {block.line - line for block in blocks if self._shows(block)}
        is_torn = any(isinstance(each.about, FaultKind) for each in findings)
        moved = {block.line for block in blocks if self._moves(block, before)} if is_torn else set[int]()
        for each in findings:
            is_moved = isinstance(each.about, FaultKind) and each.span.line in moved
            self._torn |= {each.span} if is_moved else set()
            if self._is_behind or each.span.line - line in shown or self._is_told(each):
                yield each
            else:
                self._held.append(each)
        if answer is not None:
            self._contour = line
            if self._held:
                yield from self._settle(answer, before)
        self._is_behind = answer is not None or (self._is_behind and not _says_something(lines()))

    @property
    def is_waiting(self) -> bool:
        """Whether a contour may tell of findings before it."""
        return self.is_strict or bool(self._held)

    def pass_by(self, contour: int, blocks: Callable[[], Iterable[Block]]) -> None:
        """Pass lines without findings while none waits: the last contour in them began at a line (0: there is none),
        and some blocks follow it, or the lines are these blocks."""
        self._contour = contour or self._contour
        self._is_behind = (contour > 0 or self._is_behind) and not _says_something(blocks())

    def _settle_points(self, answer: Answer) -> Iterator[Diagnostic]:
        """Moves in increments before a contour, but for those of which it tells, where the program is known to write
        points."""
        self._is_pointed = self._is_pointed or are_points_usual(answer.claim, answer.diagnostics)
        own = spans_of(answer.diagnostics, ReadIssue.START_IN_INCREMENTS)
        self._uncertain = [each for each in self._uncertain if each.span not in own]
        if self._is_pointed:
            yield from self._uncertain
            self._uncertain = []

    def rest(self) -> tuple[tuple[Diagnostic, ...], State | None]:
        """Findings that waited for the end of the program, with the last state."""
        return (tuple(self._uncertain) if self._is_pointed else ()), self._before

    def _shows(self, block: Block) -> bool:
        """Whether a block has a word by which contours are known, or one of a corner or an angle."""
        words = (word for word in block.words if self._modes is not None and len(word.address) > 1)
        return bool(self._signs(block)) or any(word.address in self._corners for word in words)

    def _makes_contour(self, fix: Fix) -> bool:
        """Whether a block has with a fix a word by which contours are known; any, where no control is known."""
        if self._modes is None:
            return True
        blocks = (parse_block(text, 1, self._modes.syntax) for text in fix.replacement.split("\n"))
        return any(map(self._shows, blocks))

    def _moves(self, block: Block, before: State) -> bool:
        """Whether a block moves an axis of the plane."""
        modes = self._modes
        return modes is not None and moves(block, apply_modes(before, block, modes), modes, ())

    def _settle(self, answer: Answer, before: State) -> Iterator[Diagnostic]:
        """Of what waits, that on which a contour rests; what no other one can rest on is told no more."""
        lines, is_counted = _rests_on(answer, before)
        held, self._held = self._held, []
        # What no axis has from a line now, it never will.
        later = {place.span.line for place in before.axes.values() if place.span is not None}
        for each in held:
            if is_counted or each.span.line in lines or _waits_for_any(each) or each.span in self._torn:
                yield each
            elif each.span.line in later:
                self._held.append(each)

    def _is_corner(self, finding: Diagnostic) -> bool:
        """Whether it is about a word of a corner that the control has not, and says which one is meant; or which no
        control has, so that nothing else tells of it."""
        if finding.about is not ReadIssue.COMMA_WORD_UNKNOWN or not finding.is_error:
            return False
        return "if that is meant" in finding.help or all(len(each) > 2 and each[0] == "," for each in finding.addresses)  # noqa: PLR2004 - a comma and a letter

    def _is_told(self, finding: Diagnostic) -> bool:
        """Whether a finding waits for nothing."""
        # A word of another control shows that the program may be for that one, whatever else it may have been.
        is_of_own = finding.about is not ReadIssue.COMMA_WORD_UNKNOWN
        is_mended = is_of_own and any(map(self._makes_contour, finding.fixes))
        if is_mended or finding.about not in _WAITING or finding.span.line <= 0:
            return True
        if isinstance(finding.about, FaultKind) and not self._long.isdisjoint(finding.addresses):
            return True
        if finding.about in _BESIDE_CONTOURS or finding.span in self._torn:
            is_unread = finding.about is ReadIssue.NOT_READ and finding.is_error
            return self._contour > 0 or is_unread or self._is_corner(finding)
        return finding.span.line <= self._contour and _waits_for_any(finding)


def _says_something(lines: Iterable[Line]) -> bool:
    return any(isinstance(line, Block | Passage) and words_of(line.text) for line in lines)


def _no_signs(_: Block) -> tuple[Word, ...]:
    return ()


def _waits_for_any(finding: Diagnostic) -> bool:
    """Whether a finding is told at any contour behind it."""
    return "G" in finding.addresses or finding.about in _BESIDE_CONTOURS | _BEFORE_CONTOURS


def _rests_on(answer: Answer, before: State) -> tuple[set[int], bool]:
    """The lines on which the start of a contour rests, and whether it is counted in increments."""
    places = [before.axes[axis] for axis in answer.claim.before.plane.axes]
    lines = {place.span.line for place in places if place.span is not None}
    lines |= {word.span.line for word in before.memory.values()}
    addresses = answer.claim.lexicon.addresses
    words = [place.word for place in places if place.word is not None and place.word.address in addresses]
    return lines, any(addresses[word.address].is_step(is_incremental=before.is_incremental) for word in words)
